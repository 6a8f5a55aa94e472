//! A robot description as plain data, close to the file: numbers parsed, nothing resolved.

mod extra;
mod gazebo;
mod joint;
mod link;
mod material;
mod placement;

use periplus_diagnostics::Origin;
use periplus_xml::Element;

pub use extra::Extra;
pub use gazebo::GazeboBlock;
pub(crate) use joint::DEFAULT_AXIS;
pub use joint::{
    Dynamics, JointCalibration, JointType, Limit, SafetyController, UrdfJoint, UrdfMimic,
};
pub use link::{UrdfCollision, UrdfGeometry, UrdfInertial, UrdfLink, UrdfVisual};
pub use material::{ColourAsWritten, UrdfMaterial, UrdfTexture};
pub use placement::{Rotation, UrdfOrigin};

/// A whole URDF file.
///
/// The content defined by ROS and Gazebo is typed; the rest is kept verbatim, so [`crate::write`] loses
/// only comments and the relative order of elements of different kinds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfRobot {
    /// Its name.
    pub name: String,
    /// Format version as written; `None` means `1.0`.
    pub version: Option<String>,
    /// Initial pose in Gazebo: the `<origin>` directly in the robot, which ROS does not define.
    pub origin_in_world: Option<UrdfOrigin>,
    /// Links, in file order.
    pub links: Vec<UrdfLink>,
    /// Joints, in file order.
    pub joints: Vec<UrdfJoint>,
    /// Materials that visuals may name.
    pub materials: Vec<UrdfMaterial>,
    /// `<gazebo>` blocks.
    pub gazebo: Vec<GazeboBlock>,
    /// `<transmission>` blocks, verbatim.
    pub transmissions: Vec<Element>,
    /// `<ros2_control>` blocks, verbatim.
    pub ros2_controls: Vec<Element>,
    /// `<sensor>` blocks of URDF itself, which no simulator reads, verbatim.
    pub sensors: Vec<Element>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

impl UrdfRobot {
    /// A link by name.
    #[must_use]
    pub fn link(&self, name: &str) -> Option<&UrdfLink> {
        self.links.iter().find(|link| link.name == name)
    }

    /// A joint by name.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<&UrdfJoint> {
        self.joints.iter().find(|joint| joint.name == name)
    }

    /// Definition of a material: the one among the robot's materials, or else the first visual that defines
    /// it in place (ROS's rule of resolution).
    #[must_use]
    pub fn material(&self, name: &str) -> Option<&UrdfMaterial> {
        let in_place = || {
            let visuals = self.links.iter().flat_map(|link| &link.visuals);
            visuals.filter_map(|visual| visual.material.as_ref())
        };
        self.materials
            .iter()
            .chain(in_place())
            .find(|material| material.name == name && material.is_definition())
    }
}
