//! Layered costmaps with the behaviour of `nav2_costmap_2d`.
//!
//! A [`LayeredCostmap`] holds an ordered list of [`Layer`]s. An update first calls
//! [`Layer::bounds`] of each layer for the area that has changed, and then [`Layer::costs`] of each
//! layer, which writes costs into the window of cells over that area. The crate has no clock and no
//! inputs: time, the pose of the robot, transforms and sensor readings are arguments.
//!
//! Parameters are names and texts; [`CostmapConfig::read_yaml`] reads them from a file.
//!
//! ```
//! use periplus_costmap::{CostmapConfig, NoTransforms};
//! use periplus_diagnostics::Diagnostics;
//! use periplus_geometry::{Pose, Pose2};
//! use periplus_params::Given;
//!
//! let given = [
//!     Given::new("plugins", "obstacle_layer"),
//!     Given::new("obstacle_layer.plugin", "nav2_costmap_2d::ObstacleLayer"),
//!     Given::new("obstacle_layer.observation_sources", "scan"),
//! ];
//! let mut costmap = CostmapConfig::read(given, None, &mut Diagnostics::new()).build();
//! let sensor = Pose::from_xyz(1.0, 1.0, 0.0);
//! let scan = costmap.source_mut("obstacle_layer", "scan").expect("the source");
//! scan.insert(0, 0, sensor, sensor.translation, [[2.0, 0.0, 0.0]]);
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
mod error;
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
mod view;
mod voxel_grid;

pub use advice::Advice;
pub use area::{CellWindow, UpdateBounds};
pub use combine::Combination;
pub use compat::{Nav2Release, RangeMeasure};
pub use config::{CostmapConfig, LayerConfig, LayerKind, SourceConfig};
pub use costmap::Costmap;
pub use error::{
    ChangeError, ClearError, FootprintError, MapError, UnclearableLayer, UnknownPlugin,
};
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
pub use view::{CostmapView, InflationLaw};
pub use voxel_grid::{MAX_VOXEL_COUNT, Voxel, VoxelGrid, VoxelLine};
