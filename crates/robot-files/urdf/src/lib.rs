//! URDF with Gazebo's extensions.
//!
//! [`read`] turns a document into a [`UrdfRobot`]: plain data close to the file, checked as
//! `check_urdf` checks. [`write()`] goes back.
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, SourceMap};
//!
//! let text = "<robot name='cart'>
//!     <link name='base'/> <link name='lidar'/>
//!     <joint name='mount' type='fixed'><parent link='base'/><child link='lidar'/></joint>
//! </robot>";
//! let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
//! let file = sources.add("cart.urdf", text);
//! let document = periplus_xml::parse(file, &sources, &mut diagnostics).expect("XML");
//! let robot = periplus_urdf::read(&document, &mut diagnostics).expect("a robot");
//! assert!(!diagnostics.has_errors());
//! assert_eq!(robot.joints[0].child, "lidar");
//! ```

mod advice;
mod check;
mod convert;
mod export;
mod lump;
mod read;
mod robot;
mod tree;
mod write;

pub use advice::advise;
pub use convert::{ConversionOptions, to_model, to_sdf};
pub use export::from_model;
pub use read::read;
pub use robot::{
    ColourAsWritten, Dynamics, Extra, GazeboBlock, JointCalibration, JointType, Limit, Rotation,
    SafetyController, UrdfCollision, UrdfGeometry, UrdfInertial, UrdfJoint, UrdfLink, UrdfMaterial,
    UrdfMimic, UrdfOrigin, UrdfRobot, UrdfTexture, UrdfVisual,
};
pub use write::write;
