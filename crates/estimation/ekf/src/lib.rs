//! Sensor fusion of odometry, IMU and poses: an extended Kalman filter over 15 variables, with the
//! parameters of `ekf_node` in `robot_localization`.
//!
//! The state consists of position and orientation in the world frame, linear and angular velocity
//! in the base frame, and linear acceleration ([`Variable`]). A [`Measurement`] has values of some
//! variables, with a covariance. [`Intake`] converts sensor readings to measurements; [`Ekf`] sorts
//! them by stamp, predicts the state to each stamp, and updates it.
//!
//! ```
//! use periplus_ekf::{Ekf, Measurement, Settings, Variable};
//!
//! let mut ekf = Ekf::new(Settings::default());
//! for tick in 0..50 {
//!     let forward = [(Variable::Vx, 0.4), (Variable::Vyaw, 0.0)];
//!     ekf.push(Measurement::of(tick * 20_000_000, &forward, 1e-4));
//! }
//! ekf.run_until(1_000_000_000);
//! let estimate = ekf.estimate().expect("something was measured");
//! // 49 intervals of 20 ms at 0.4 m/s.
//! assert!((estimate.get(Variable::X) - 0.392).abs() < 1e-3);
//! ```
//!
//! Source of names, defaults and message handling: the documentation and the commented
//! `params/ekf.yaml` of `robot_localization`; of the equations: Moore and Stouch, "A Generalized
//! Extended Kalman Filter Implementation for the Robot Operating System" (2014).

mod correct;
mod ekf;
mod intake;
mod motion;
mod settings;
mod state;

pub use ekf::{Ekf, Refusal};
pub use intake::{ImuReading, Intake, PoseReading, TwistReading};
pub use settings::{EKF, EkfParams, EkfSourceParams, Kind, SOURCE, Settings, Source};
pub use state::{Covariance, Estimate, Measurement, STATE_DIMENSIONS, State, Variable};
