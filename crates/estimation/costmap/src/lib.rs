//! Layered costmaps with the behaviour of `nav2_costmap_2d`.
//!
//! A [`LayeredCostmap`] holds an ordered list of [`Layer`]s. An update first calls
//! [`Layer::bounds`] of each layer for the area that has changed, and then [`Layer::costs`] of each
//! layer, which writes costs into the window of cells over that area. The crate has no clock and no
//! inputs: time, the pose of the robot, transforms and sensor readings are arguments.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose, Pose2};
//! use periplus_costmap::{CostmapConfig, NoTransforms};
//! use periplus_diagnostics::Diagnostics;
//! use periplus_params::Given;
//!
//! // Parameters as names and texts; `CostmapConfig::read_yaml` reads them from a file.
//! let given = [
//!     Given::new("plugins", "obstacle_layer inflation_layer"),
//!     Given::new("obstacle_layer.plugin", "nav2_costmap_2d::ObstacleLayer"),
//!     Given::new("obstacle_layer.observation_sources", "scan"),
//!     Given::new("obstacle_layer.scan.max_obstacle_height", "2.0"),
//!     Given::new("inflation_layer.plugin", "nav2_costmap_2d::InflationLayer"),
//! ];
//! let mut diagnostics = Diagnostics::new();
//! let config = CostmapConfig::read(given, None, &mut diagnostics);
//! assert!(diagnostics.is_empty());
//!
//! let mut costmap = config.build();
//! let source = costmap.source_mut("obstacle_layer", "scan").unwrap();
//! let global_from_sensor = Pose::from_xyz(1.0, 1.0, 0.2);
//! source.insert(0, 0, global_from_sensor, global_from_sensor.translation, [[2.0, 0.0, 0.0]]);
//! costmap.update(0, Pose2::new(1.0, 1.0, 0.0), &NoTransforms);
//! assert_eq!(costmap.cost_at(Pose2::new(3.0, 1.0, 0.0), false), 254);
//! ```
//!
//! Source of the rules: `nav2_costmap_2d` of Nav2 (main, 2026-08; jazzy; humble), reimplemented;
//! [`Nav2Release`] selects the release where they differ.

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
pub use area::{CellWindow, UpdateBounds};
pub use combine::Combination;
pub use compat::{Nav2Release, RangeMeasure};
pub use config::{CostmapConfig, LayerConfig, LayerKind, SourceConfig};
pub use costmap::Costmap;
pub use footprint::Footprint;
pub use inspect::{CellReport, Explanation, LayerReport};
pub use layer::{Layer, NoTransforms, TransformSource, UpdateContext};
pub use layered::{CostmapSettings, LayeredCostmap};
pub use observation::{
    Counters, DataType, Observation, ObservationSource, RangeLimits, SourceSettings,
};
pub use projection::{Projector, ScanGeometry};
pub use publication::{CostmapMessage, PublicationState};
pub use trace::Cause;
pub use voxel_grid::{MAX_VOXEL_COUNT, Voxel, VoxelGrid, VoxelLine};
