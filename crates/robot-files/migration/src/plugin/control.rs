//! `ros_control` and `ros2_control`.

use periplus_xml::Element;

use crate::entry::MigrationOutcome;
use crate::old_plugin::OldPlugin;
use crate::replacement::{Replacement, leaf};

/// Library and class of `gz_ros2_control`.
const LIBRARY: &str = "gz_ros2_control-system";
const CLASS: &str = "gz_ros2_control::GazeboSimROS2ControlPlugin";

/// `gazebo_ros_control`, `gazebo_ros2_control`.
pub(super) fn ros_control(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let mut control =
        Element::new("plugin").with_attribute("filename", LIBRARY).with_attribute("name", CLASS);
    if plugin.is_ros1() {
        let namespace = plugin.text(&["robotNamespace"]).filter(|text| text != "/");
        if let Some(namespace) = namespace {
            control.push(Element::new("ros").with_child(leaf("namespace", namespace)));
        }
        replacement.differs(
            "ros2_control reads its controllers from a parameter file of ROS 2: translate the file \
             of ROS 1 (controller types are in `controller_manager.ros__parameters`) and name it in \
             <parameters> of this plugin",
        );
        replacement.remark(
            "<transmission> elements become <ros2_control>; start the controllers with `ros2 run \
             controller_manager spawner NAME`",
        );
        if plugin.text(&["controlPeriod"]).is_some() {
            replacement.remark("the control period is `update_rate` of the controller manager");
        }
        if plugin.text(&["robotSimType"]).is_some_and(|kind| !kind.contains("DefaultRobotHWSim")) {
            replacement.differs("the own hardware interface must be ported to gz_ros2_control");
        }
    } else {
        // All parameters have kept their names.
        for parameter in &plugin.plugin.content {
            if parameter.name == "robot_sim_type" || parameter.name == "control_period" {
                continue;
            }
            control.push(parameter.clone());
        }
    }
    replacement.elements.push(control);
    replacement
}
