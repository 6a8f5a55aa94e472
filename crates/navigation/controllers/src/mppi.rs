//! Model predictive path integral control (`nav2_mppi_controller::MPPIController`).
//!
//! Each cycle samples control sequences around the last one, predicts their trajectories, lets critics score
//! them, and takes a mean weighted by the scores. All loops work on rows of samples in single precision; sums
//! have a fixed order and noise has a key, so that equal inputs give equal bytes on every platform.
//!
//! [`create`] reads the parameters of Nav2; [`advice()`] reports parameters that bound each other. Results for
//! publication are returned by [`Mppi::candidates`], [`Mppi::optimal_trajectory`] and [`Mppi::statistics`].
//!
//! Sources: Williams, Drews, Goldfain, Rehg, Theodorou, "Information-theoretic model predictive control: theory
//! and applications to autonomous driving" (2018); behaviour of `nav2_mppi_controller` (humble, jazzy, kilted,
//! main 2026-08), reimplemented.

mod advice;
mod config;
mod context;
mod controller;
mod cost_grid;
mod critics;
mod explain;
mod filter;
mod lane_math;
mod lanes;
mod limits;
mod noise;
mod noise_thread;
mod optimizer;
pub mod params;
mod path;
mod plugin;
pub mod probe;
mod rollout;
mod samples;
mod sequence;
mod stall;
mod statistics;
mod surroundings;
mod update;
mod validator;

pub use advice::{advice, check_costmap};
pub use config::{MppiConfig, MppiSetup};
pub use controller::{Mppi, create};
pub use critics::CriticKind;
pub use filter::ControlHistory;
pub use limits::{MppiAccelerationLimits, MppiModel, MppiVelocityLimits};
pub(crate) use plugin::create_plugin;
pub use sequence::{ControlSequence, MppiControl};
pub use statistics::{CandidateTrajectory, CriticStatistics, MppiTrajectoryPoint};
