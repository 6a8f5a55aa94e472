//! Layer plugins.

mod container;
mod denoise;
mod inflate;
mod observed;
mod obstacle;
mod range;
mod ray_dedup;
mod static_map;
mod voxel;

pub use container::ContainerLayer;
pub use denoise::{DenoiseLayer, denoise};
pub use inflate::InflationLayer;
pub use obstacle::ObstacleLayer;
pub use range::{RangeCounters, RangeLayer, RangeReading, probability};
pub use static_map::{MapMeaning, StaticLayer};
pub use voxel::VoxelLayer;
