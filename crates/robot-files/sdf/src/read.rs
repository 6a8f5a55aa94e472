//! Elements to drafts, drafts to a scene.

mod actor;
mod camera;
mod imu;
mod include;
pub(crate) mod joint;
mod lidar;
mod light;
mod link;
mod material;
mod merge;
mod model;
mod noise;
mod overrides;
mod physics;
mod plugin;
mod population;
mod radar;
mod root;
mod sensor;
pub(crate) mod shape;
mod state;
mod surface;
mod world;

pub use include::{IncludeResolver, IncludeTarget, NoIncludes};
pub use light::read_light;
pub use link::{read_collision, read_inertial, read_visual};
pub use material::read_material;
pub use plugin::read_plugin;
pub use root::{SdfContext, read_document};
pub use sensor::{PosedSensor, read_sensor};
pub use shape::read_geometry;
pub use surface::read_surface;
