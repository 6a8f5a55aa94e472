//! The layers.

mod container;
mod denoise;
mod inflate;
mod obstacle;
mod range;
mod repeats;
mod sight;
mod static_map;
mod voxel;

pub use container::ContainerLayer;
pub use denoise::{DenoiseLayer, denoise};
pub use inflate::InflationLayer;
pub use obstacle::ObstacleLayer;
pub use range::{RangeCounters, RangeLayer, RangeReading, probability};
pub use static_map::{MapMeaning, StaticLayer};
pub use voxel::VoxelLayer;
