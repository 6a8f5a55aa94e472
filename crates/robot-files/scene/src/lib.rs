//! Scene description as plain data.
//!
//! The meaning of a robot or world file, independent of its format: every pose resolved to one fixed
//! parent, every default filled in, names scoped with `::`. Uninterpreted content is kept verbatim in the
//! `extra` lists and in [`Plugin::content`], so writing a scene loses nothing.
//!
//! Two scenes are equal if they have the same meaning; [`Origin`]s are not compared.
//!
//! ```
//! use periplus_scene::{Joint, JointKind, Link, Model, Pose, tf_tree};
//!
//! let mut cart = Model::new("cart");
//! let model_from_link = Pose::from_xyz(0.2, 0.0, 0.3);
//! cart.links = vec![Link::new("base"), Link { model_from_link, ..Link::new("lidar") }];
//! cart.joints.push(Joint::new("mount", JointKind::Fixed, "base", "lidar"));
//! let edges = tf_tree(&cart);
//! assert_eq!((edges[0].parent.as_str(), edges[0].child.as_str()), ("base", "lidar"));
//! assert_eq!(edges[0].parent_from_child.translation.x, 0.2);
//! ```

mod actor;
mod joint;
mod json;
mod light;
mod link;
mod material;
mod model;
mod outline;
mod physics;
mod plugin;
mod sensor;
mod shape;
mod surface;
mod tree;
mod world;

pub use actor::Actor;
pub use joint::{Axis, Joint, JointKind, Mimic};
pub use light::{Attenuation, Light, LightKind, Spot};
pub use link::{Collision, Inertial, Link, Visual};
pub use material::{
    Colour, Material, MaterialScript, Pbr, builtin_material, builtin_material_names,
};
pub use model::{FrameRole, Model, NamedFrame};
pub use outline::{OutlineEdge, OutlineError, Trapezoid, edges, trapezoids};
pub use periplus_diagnostics::Origin;
pub use periplus_geometry::{DVec3, Pose};
pub use periplus_xml::Element;
pub use physics::Physics;
pub use plugin::Plugin;
pub use sensor::{
    Camera, CameraKind, Distortion, ImuSpec, LidarSpec, NoiseKind, NoiseSpec, RadarNoise,
    RadarSpec, ScanAxis, Sensor, SensorKind,
};
pub use shape::{Heightmap, ImageShape, MeshShape, Polyline, Shape};
pub use surface::{ContactProperties, Friction, SurfaceProperties};
pub use tree::{TfEdge, carrying_link, tf_tree};
pub use world::{Gui, Scene, SphericalCoordinates, World};
