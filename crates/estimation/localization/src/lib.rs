//! Where a robot is on a map that is known.
//!
//! [`Amcl`] is adaptive Monte Carlo localization as Nav2 has it, by the same parameters ([`AMCL`]),
//! written from the equations: particles moved by odometry ([`Drive`]), weighed by scans ([`Model`]),
//! drawn anew in numbers that fit ([`SampleSize`]), with a way back from being carried away
//! ([`Recovery`]). It says when it is not sure ([`Status`]), and can start without being told where
//! ([`Amcl::start_anywhere`]).
//!
//! Values in, values out: no clock, no threads, no files, no ROS types; the same calls with the same
//! seed give the same bits.
//!
//! ```
//! use periplus_geometry::Pose2;
//! use periplus_grid::{Grid, Lattice, occupancy};
//! use periplus_localization::{Amcl, Guess, Scan, Settings, State};
//!
//! // A room of 4 by 3 metres; the robot is in its middle and sees the wall to the right, 2 m away.
//! let mut map = Grid::new(Lattice::new(0.1, 40, 30, Pose2::IDENTITY)?, occupancy::FREE);
//! for index in 0..map.cells.len() {
//!     let (column, row) = map.lattice.cell(index);
//!     if column % 39 == 0 || row % 29 == 0 {
//!         map.cells[index] = occupancy::OCCUPIED;
//!     }
//! }
//! let mut amcl = Amcl::new(Settings::default());
//! amcl.set_map("map", &map).map_err(|it| it.message)?;
//! let mut covariance = [0.0; 36];
//! (covariance[0], covariance[7], covariance[35]) = (0.01, 0.01, 0.01);
//! let pose = Pose2::new(2.0, 1.5, 0.0);
//! let guess = Guess { frame: "map".into(), pose, covariance, moved: Pose2::IDENTITY };
//! amcl.set_pose(&guess).map_err(|it| it.message)?;
//! let scan = Scan {
//!     base_from_laser: Pose2::IDENTITY,
//!     is_flipped: false,
//!     angle_min_rad: -0.1,
//!     angle_increment_rad: 0.1,
//!     range_min_m: 0.1,
//!     range_max_m: 10.0,
//!     ranges_m: vec![1.95; 3],
//! };
//! let update = amcl.update(Pose2::IDENTITY, &scan).map_err(|it| it.message)?;
//! let update = update.expect("the first scan is always used");
//! assert!((update.estimate.pose.x_m - 2.0).abs() < 0.1);
//! assert_eq!(update.status.state, State::Tracking);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod amcl;
mod anywhere;
mod bins;
mod evidence;
mod guess;
mod hunt;
mod known_map;
mod models;
mod motion;
mod particles;
mod polish;
mod pose_file;
mod pyramid;
mod ranges;
mod recovery;
mod rivals;
mod scan;
mod settings;
mod status;
mod tables;
mod weigh;

pub use amcl::{Amcl, Estimate, Update, has_moved};
pub use bins::{BIN_M, BIN_RAD, BINS_AROUND, Cluster, SampleSize};
pub use guess::Guess;
pub use known_map::{CellPlace, CellState, Finder, KnownMap, MapSettings};
pub use models::{BeamSkip, Mixture, Model, expected_range_m, weight_of_cubes, weight_of_product};
pub use motion::{Alphas, Drive, Glide, GlideSpread, TurnWayTurn, TurnWayTurnSpread};
pub use particles::{Covariance2, Particles};
pub use periplus_scan_matching::Peak;
pub use pose_file::{PoseFileError, SavedPose};
pub use recovery::Recovery;
pub use scan::{BeamLimits, Scan, Thinning};
pub use settings::{Compat, Settings};
pub use status::{State, Status};
pub use tables::AMCL;
