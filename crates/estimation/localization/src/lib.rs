//! Adaptive Monte Carlo localization (AMCL) on a known map.
//!
//! [`Amcl`] is a particle filter with the parameters of Nav2's AMCL ([`AMCL`]), written from the
//! equations of *Probabilistic Robotics* (Thrun, Burgard, Fox): an odometry motion model
//! ([`MotionModel`]), a sensor model ([`SensorModel`]), KLD-sampling ([`KldSampling`]) and recovery
//! by likelihood averages ([`LikelihoodAverages`]). In addition, scan matching refines the estimate,
//! global localization finds the robot without an initial pose ([`Amcl::localize_globally`]) or after
//! kidnapping, and a status reports how certain the pose is ([`LocalizationStatus`]).
//!
//! Values in, values out: no clock, no threads, no files, no ROS types; the same calls with the same
//! seed give the same bits.
//!
//! ```
//! use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};
//! use periplus_grid::{Grid, GridInfo, occupancy};
//! use periplus_localization::{Amcl, Covariance2, Settings};
//!
//! // A room of 4 m by 3 m; the robot in its center has a wall 1.9 m ahead and 1.4 m to its left.
//! let mut map = Grid::new(GridInfo::new(0.1, 40, 30, Pose2::IDENTITY)?, occupancy::FREE);
//! let walls = (0..1200).filter(|index| index % 40 % 39 == 0 || index / 40 % 29 == 0);
//! walls.for_each(|index| map.cells[index] = occupancy::OCCUPIED);
//! let initial_pose = Some((Pose2::new(2.0, 1.5, 0.0), Covariance2::default()));
//! let mut amcl = Amcl::new(Settings { initial_pose, ..Settings::default() });
//! amcl.set_map("map", &map).map_err(|it| it.message)?;
//! let scan = LaserScan2 { time_ns: 0, mounting: ScannerMounting::upright(Pose2::IDENTITY),
//!     angle_min_rad: 0.0, angle_increment_rad: 1.57, time_increment_s: 0.0, range_min_m: 0.1,
//!     range_max_m: 9.0, ranges_m: vec![1.9, 1.4] };
//! let update = amcl.update(Pose2::IDENTITY, &scan).map_err(|it| it.message)?;
//! assert!(update.is_some_and(|it| (it.estimate.pose.x_m - 2.0).abs() < 0.1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod amcl;
mod branch_and_bound;
mod global_localization;
mod hypotheses;
mod initial_pose;
mod kld_sampling;
mod likelihood_map;
mod likelihood_pyramid;
mod motion_model;
mod parameters;
mod particles;
mod pose_file;
mod pose_threshold;
mod recovery;
mod scan;
mod scan_likelihood;
mod scan_refinement;
mod sensor_model;
mod settings;
mod shared_maps;
mod status;

pub use amcl::{Amcl, AmclUpdate, PoseEstimate};
pub use initial_pose::InitialPose;
pub use kld_sampling::{BIN_M, BIN_RAD, Cluster, KldSampling, YAW_BIN_COUNT};
pub use likelihood_map::{
    CellAlignment, CellState, CellTransform, LikelihoodMap, LikelihoodMapSettings,
};
pub use motion_model::{
    MotionModel, MotionNoise, OmniMotion, OmniMotionNoise, RotTransRot, RotTransRotNoise,
};
pub use parameters::{AMCL, AmclCompat, AmclParams};
pub use particles::{Covariance2, Particles};
pub use periplus_scan_matching::Peak;
pub use pose_file::{PoseFileError, SavedPose};
pub use pose_threshold::{PoseThreshold, has_moved};
pub use recovery::LikelihoodAverages;
pub use scan::{BeamLimits, BeamStep};
pub use sensor_model::{
    BeamMixture, BeamSkip, SensorModel, expected_range_m, product_weight, sum_of_cubes_weight,
};
pub use settings::Settings;
pub use shared_maps::SharedMaps;
pub use status::{LocalizationState, LocalizationStatus};
