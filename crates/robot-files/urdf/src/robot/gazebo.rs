//! Gazebo's extensions.

use periplus_diagnostics::Origin;
use periplus_xml::Element;

use super::Extra;

/// A `<gazebo>` block, its content word for word.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GazeboBlock {
    /// The link or joint it speaks about; none for the robot.
    pub reference: Option<String>,
    /// Settings, sensors, plugins.
    pub content: Vec<Element>,
    /// Further attributes.
    pub extra: Extra,
    /// Where the reference stands, or else the block.
    pub origin: Origin,
}
