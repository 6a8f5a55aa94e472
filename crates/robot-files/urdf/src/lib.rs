//! URDF with Gazebo's extensions.
//!
//! [`read`] turns a document into a [`Robot`]: plain data close to the file, checked as
//! `check_urdf` checks. [`write()`] goes back.

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
