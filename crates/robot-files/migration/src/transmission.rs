//! `<transmission>` of `ros_control` as `<ros2_control>`.

use periplus_xml::Element;

use crate::replacement::leaf;

/// Hardware of `gz_ros2_control`.
pub(crate) const HARDWARE: &str = "gz_ros2_control/GazeboSimSystem";

/// `<ros2_control>` with the joints of a transmission; `None` if it names no interface.
pub(crate) fn ros2_control(transmission: &Element) -> Option<Element> {
    let name = transmission.value("name").unwrap_or("transmission");
    let hardware = Element::new("hardware").with_child(leaf("plugin", HARDWARE));
    let mut control = Element::new("ros2_control")
        .with_attribute("name", name)
        .with_attribute("type", "system")
        .with_child(hardware);
    let interface_in = |element: &Element| {
        element.child("hardwareInterface").map(|interface| interface.text().into_owned())
    };
    let of_actuator = transmission.named("actuator").find_map(interface_in);
    let mut has_joint = false;
    for joint in transmission.named("joint") {
        let name = joint.value("name")?;
        let written = interface_in(joint).or_else(|| of_actuator.clone())?;
        let command = command_interface(&written)?;
        let mut states = vec!["position", "velocity"];
        if command == "effort" {
            states.push("effort");
        }
        let mut element = Element::new("joint").with_attribute("name", name);
        element.push(Element::new("command_interface").with_attribute("name", command));
        for state in states {
            element.push(Element::new("state_interface").with_attribute("name", state));
        }
        control.push(element);
        has_joint = true;
    }
    has_joint.then_some(control)
}

/// Command interface of `ros2_control` for one of `ros_control`; an expression of xacro is not translated.
fn command_interface(written: &str) -> Option<&'static str> {
    let name = written.trim().rsplit('/').next().unwrap_or_default();
    match name {
        "EffortJointInterface" => Some("effort"),
        "VelocityJointInterface" => Some("velocity"),
        "PositionJointInterface" => Some("position"),
        _ => None,
    }
}
