//! What a robot may drive through: layered costmaps as Nav2 has them.
//!
//! A [`LayeredCostmap`] holds [`Layer`]s, one over the other. An update asks each for the bounds of
//! what has changed, and then each to put its costs into the window that came of it. Values in, values
//! out: time, the robot's pose, transforms and readings are given.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose, Pose2};
//! use periplus_costmap::{Config, NoFrames};
//! use periplus_diagnostics::Diagnostics;
//! use periplus_params::Given;
//!
//! // What a user writes, as names and texts; `Config::read_yaml` takes it from a file.
//! let given = [
//!     Given::new("plugins", "obstacle_layer inflation_layer"),
//!     Given::new("obstacle_layer.plugin", "nav2_costmap_2d::ObstacleLayer"),
//!     Given::new("obstacle_layer.observation_sources", "scan"),
//!     Given::new("obstacle_layer.scan.max_obstacle_height", "2.0"),
//!     Given::new("inflation_layer.plugin", "nav2_costmap_2d::InflationLayer"),
//! ];
//! let mut diagnostics = Diagnostics::new();
//! let config = Config::read(given, None, &mut diagnostics);
//! assert!(diagnostics.is_empty());
//!
//! let mut costmap = config.build();
//! let source = costmap.source_mut("obstacle_layer", "scan").unwrap();
//! let global_from_sensor = Pose::from_xyz(1.0, 1.0, 0.2);
//! source.insert(0, 0, global_from_sensor, global_from_sensor.translation, [[2.0, 0.0, 0.0]]);
//! costmap.update(0, Pose2::new(1.0, 1.0, 0.0), &NoFrames);
//! assert_eq!(costmap.cost_at(Pose2::new(3.0, 1.0, 0.0), false), 254);
//! ```
//!
//! Source of the rules: `nav2_costmap_2d` of Nav2 (main, 2026-08; jazzy; humble), told again in our
//! own words; where the generations differ, [`Compat`] says which one is kept to.

mod advice;
mod area;
pub mod clear;
mod combine;
mod compat;
mod config;
pub mod cost;
mod costmap;
pub mod filters;
pub mod footprint;
pub mod inflation;
mod inspect;
mod layer;
mod layered;
pub mod layers;
mod observation;
mod polygon;
mod projection;
mod publication;
pub mod tables;
mod trace;
mod voxel_grid;

pub use advice::Advice;
pub use area::{Bounds, Window};
pub use combine::Combination;
pub use compat::{Compat, RangeMeasure};
pub use config::{Config, LayerConfig, LayerKind, SourceConfig};
pub use costmap::Costmap;
pub use footprint::Footprint;
pub use inspect::{CellReport, Explanation, LayerReport};
pub use layer::{Frames, Layer, Moment, NoFrames};
pub use layered::{Frame, LayeredCostmap};
pub use observation::{Counters, DataType, Observation, Source, SourceSettings, Span};
pub use projection::{Beams, Projector};
pub use publication::{Outgoing, Publication};
pub use trace::Cause;
pub use voxel_grid::{Line3, MOST_VOXELS, Voxel, VoxelGrid};
