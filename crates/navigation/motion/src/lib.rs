//! Velocity smoother, collision monitor and recovery motions with the behaviour of Nav2.
//!
//! [`VelocitySmoother`] limits the acceleration of commands, [`collision_monitor`] slows them down
//! near obstacles, [`behaviors`] has the motions of the behavior server, and [`CommandExecution`] is
//! the order in which a lifecycle manager starts and stops its nodes. All of them are plain
//! calculations: the caller passes the time, the poses and the data of the sensors.
//!
//! ```
//! use periplus_motion::behaviors::{Spin, SpinLimits};
//!
//! let limits = SpinLimits { min_rad_s: 0.4, max_rad_s: 1.0, acc_rad_s2: 3.2 };
//! let mut spin = Spin::new(1.57, 0.0);
//! let mut yaw_rad = 0.0;
//! while let Some(velocity_rad_s) = spin.velocity_rad_s(&limits) {
//!     yaw_rad += 0.1 * velocity_rad_s;
//!     spin.update(yaw_rad);
//! }
//! assert!((1.57..1.57 + 0.04).contains(&yaw_rad));
//! ```

pub mod behaviors;
pub mod collision_monitor;
mod lifecycle;
mod mean_velocity;
mod outline;
pub mod tables;
mod velocity_smoother;

pub use lifecycle::{CommandExecution, ManagedState, ManagedTransition, ManagerCommand};
pub use mean_velocity::MeanVelocity;
pub use tables::VelocitySmootherParams;
pub use velocity_smoother::{
    ComponentLimits, LimitError, VELOCITY_COMPONENT_COUNT, Velocity6, VelocityFeedback,
    VelocitySmoother, VelocitySmootherSettings,
};
