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
pub use joint::{Calibration, Dynamics, Joint, JointType, Limit, Mimic, SafetyController};
pub use link::{Collision, Geometry, Inertial, Link, Visual};
pub use material::{ColourAsWritten, Material, Texture};
pub use placement::{Placement, Rotation};

/// A whole URDF file.
///
/// The content defined by ROS and Gazebo is typed; the rest is kept verbatim, so [`crate::write`] loses
/// only comments and the relative order of elements of different kinds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// Format version as written; `None` means `1.0`.
    pub version: Option<String>,
    /// Initial pose in Gazebo: the `<origin>` directly in the robot, which ROS does not define.
    pub origin_in_world: Option<Placement>,
    /// Links, in file order.
    pub links: Vec<Link>,
    /// Joints, in file order.
    pub joints: Vec<Joint>,
    /// Materials that visuals may name.
    pub materials: Vec<Material>,
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

impl Robot {
    /// A link by name.
    #[must_use]
    pub fn link(&self, name: &str) -> Option<&Link> {
        self.links.iter().find(|link| link.name == name)
    }

    /// A joint by name.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<&Joint> {
        self.joints.iter().find(|joint| joint.name == name)
    }

    /// Definition of a material: the one among the robot's materials, or else the first visual that defines
    /// it in place (ROS's rule of resolution).
    #[must_use]
    pub fn material(&self, name: &str) -> Option<&Material> {
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
