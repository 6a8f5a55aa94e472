//! Wheels, IMU and poses in one estimate of where a robot is and how it moves: an extended Kalman
//! filter over 15 numbers, with the parameters of `robot_localization`'s `ekf_node`.
//!
//! The state is place and attitude in the world, velocity and turn rate in the robot's frame, and the
//! robot's acceleration ([`Variable`]). Every [`Measurement`] is of some of them, with a covariance. What
//! drivers tell becomes measurements in [`Intake`]; [`Ekf`] puts them in the order of their times,
//! moves its state along to each, and corrects it.
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
//! Source of names, defaults and of what is done with each kind of message: the documentation and the
//! commented `params/ekf.yaml` of `robot_localization`; the equations: Moore and Stouch, "A Generalized
//! Extended Kalman Filter Implementation for the Robot Operating System" (2014).

mod correct;
mod ekf;
mod intake;
mod motion;
mod settings;
mod state;

pub use ekf::{Ekf, Refusal};
pub use intake::{ImuReading, Intake, PoseReading, TwistReading};
pub use settings::{EKF, Kind, SOURCE, Settings, Source};
pub use state::{Covariance, Estimate, Measurement, SIZE, State, Variable};
