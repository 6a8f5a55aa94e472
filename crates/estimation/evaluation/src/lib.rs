//! Scores of a run against the truth.
//!
//! - [`associate`], [`Similarity`]: poses of two trajectories at equal times, and their alignment
//! - [`ape`], [`rpe`]: absolute and relative pose errors, as the Python package `evo` computes them
//! - [`score_map`]: intersection over union of walls at a tolerance, and distances of walls
//! - [`Clearance`], [`Smoothness`], [`GoalRun`], [`spl`], [`shortest_path_m`]: quality of paths and of runs to goals
//! - [`LocalizationScore`]: errors of an estimator compared with its covariance
//!
//! An undefined score is none or NaN, never 0.
//!
//! ```
//! use periplus_evaluation::{ErrorStatistics, PoseRelation, Trajectory, ape, associate};
//!
//! let truth = Trajectory::from_tum("0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n")?;
//! let estimate = Trajectory::from_tum("0 0 0 0 0 0 0 1\n1 1 0.25 0 0 0 0 1\n")?;
//! let pairs = associate(&truth, &estimate, 0.01);
//! let errors_m = ape(&pairs, PoseRelation::TranslationM);
//! assert_eq!(ErrorStatistics::of(&errors_m).unwrap().max, 0.25);
//! # Ok::<(), periplus_evaluation::TumError>(())
//! ```

mod alignment;
mod association;
mod chi_square;
mod clearance;
mod consistency;
mod goal;
mod map;
mod pairs;
mod pose_error;
mod shortest_path;
mod smoothness;
mod statistics;
mod trajectory;
mod tum;

pub use alignment::{AlignmentMethod, Degenerate, Similarity, align};
pub use association::{PosePair, associate, associate_interpolated};
pub use chi_square::{chi_square_probability, chi_square_quantile};
pub use clearance::Clearance;
pub use consistency::{EstimateWithCovariance, LocalizationLimits, LocalizationScore};
pub use goal::{GoalRun, collision_count, spl};
pub use map::{MapScore, score_map};
pub use pairs::{PairSelection, RelativeDelta};
pub use pose_error::{PoseRelation, ape, rpe};
pub use shortest_path::shortest_path_m;
pub use smoothness::{Smoothness, SmoothnessSampling};
pub use statistics::{ErrorStatistics, quantile};
pub use trajectory::{StampedPose, Trajectory};
pub use tum::{MAX_POSE_COUNT, TumError, TumFault};
