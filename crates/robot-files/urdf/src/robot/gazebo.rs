//! Gazebo's extensions.

use periplus_diagnostics::Origin;
use periplus_xml::Element;

use super::Extra;

/// A `<gazebo>` block; its content is kept verbatim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GazeboBlock {
    /// Link or joint that it refers to; `None` for the robot.
    pub reference: Option<String>,
    /// Settings, sensors, plugins.
    pub content: Vec<Element>,
    /// Further attributes.
    pub extra: Extra,
    /// Source location of the reference, or else of the block.
    pub origin: Origin,
}
