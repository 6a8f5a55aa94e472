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
pub use convert::{Options, to_model, to_sdf};
pub use export::from_model;
pub use read::read;
pub use robot::{
    Calibration, Collision, ColourAsWritten, Dynamics, Extra, GazeboBlock, Geometry, Inertial,
    Joint, JointType, Limit, Link, Material, Mimic, Placement, Robot, Rotation, SafetyController,
    Texture, Visual,
};
pub use write::write;
