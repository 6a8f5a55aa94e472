//! `<ros2_control>` and `<transmission>` as plain data.

use std::str::FromStr;

use periplus_scene::Model;
use periplus_xml::Element;

/// Type of a hardware component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ComponentType {
    /// Joints and sensors.
    #[default]
    System,
    /// One joint.
    Actuator,
    /// Sensors only.
    Sensor,
}

impl ComponentType {
    /// Returns the word in the file.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::System => "system",
            Self::Actuator => "actuator",
            Self::Sensor => "sensor",
        }
    }
}

/// An interface of a joint or sensor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DescribedInterface {
    /// Name, such as `velocity`.
    pub name: String,
    /// Minimum of a command.
    pub min: Option<f64>,
    /// Maximum of a command.
    pub max: Option<f64>,
    /// Initial value of a state.
    pub initial_value: Option<f64>,
}

/// A joint of a component.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DescribedJoint {
    /// Name in the model.
    pub name: String,
    /// Command interfaces.
    pub commands: Vec<DescribedInterface>,
    /// State interfaces.
    pub states: Vec<DescribedInterface>,
}

/// A sensor or a GPIO of a component.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DescribedSensor {
    /// Name.
    pub name: String,
    /// Command interfaces, of a GPIO.
    pub commands: Vec<DescribedInterface>,
    /// State interfaces.
    pub states: Vec<DescribedInterface>,
}

/// A hardware component: a `<ros2_control>` element, or all `<transmission>` elements of ROS 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HardwareComponent {
    /// Name.
    pub name: String,
    /// Type.
    pub component_type: ComponentType,
    /// Class of its hardware plugin.
    pub plugin: String,
    /// Parameters of the hardware plugin.
    pub parameters: Vec<(String, String)>,
    /// Joints.
    pub joints: Vec<DescribedJoint>,
    /// Sensors and GPIOs.
    pub sensors: Vec<DescribedSensor>,
}

/// Returns the components of a model and its nested models: their `<ros2_control>` elements, which
/// the scene keeps verbatim.
#[must_use]
pub fn hardware_of_model(model: &Model) -> Vec<HardwareComponent> {
    let own = model.extra.iter().filter(|element| element.local_name() == "ros2_control");
    let nested = model.models.iter().flat_map(hardware_of_model);
    own.map(component).chain(nested).collect()
}

/// Returns the joints of the `<transmission>` elements of a model as one component, with a command
/// interface for each hardware interface, and all states; `None` without any.
#[must_use]
pub fn hardware_of_transmissions(model: &Model) -> Option<HardwareComponent> {
    let mut joints: Vec<DescribedJoint> = Vec::new();
    let elements = model.extra.iter().filter(|element| element.local_name() == "transmission");
    for joint in elements.flat_map(|element| children(element, "joint")) {
        let name = attribute(joint, "name");
        let place = joints.iter().position(|known| known.name == name).unwrap_or_else(|| {
            let states = ["position", "velocity", "effort"].map(interface_named).to_vec();
            joints.push(DescribedJoint { name, commands: Vec::new(), states });
            joints.len() - 1
        });
        for hardware in children(joint, "hardwareInterface") {
            let class = hardware.text().trim().to_owned();
            let class = class.rsplit('/').next().unwrap_or_default();
            let commands: &[&str] = match class {
                "PositionJointInterface" => &["position"],
                "VelocityJointInterface" => &["velocity"],
                "EffortJointInterface" => &["effort"],
                "PosVelJointInterface" => &["position", "velocity"],
                "PosVelAccJointInterface" => &["position", "velocity"],
                _ => &[],
            };
            for command in commands {
                if !joints[place].commands.iter().any(|known| known.name == *command) {
                    joints[place].commands.push(interface_named(command));
                }
            }
        }
    }
    (!joints.is_empty()).then(|| HardwareComponent {
        name: "transmissions".into(),
        plugin: "gazebo_ros_control/DefaultRobotHWSim".into(),
        joints,
        ..HardwareComponent::default()
    })
}

fn interface_named(name: &str) -> DescribedInterface {
    DescribedInterface { name: name.to_owned(), ..DescribedInterface::default() }
}

fn component(element: &Element) -> HardwareComponent {
    let hardware = children(element, "hardware").next();
    let plugin = hardware.and_then(|hardware| children(hardware, "plugin").next());
    let parameters = hardware.into_iter().flat_map(|hardware| children(hardware, "param"));
    let parts = |name: &'static str| {
        let parts = children(element, name);
        parts.map(|part| DescribedSensor {
            name: attribute(part, "name"),
            commands: interfaces(part, "command_interface"),
            states: interfaces(part, "state_interface"),
        })
    };
    let joints = parts("joint").map(|DescribedSensor { name, commands, states }| DescribedJoint {
        name,
        commands,
        states,
    });
    HardwareComponent {
        name: attribute(element, "name"),
        component_type: match attribute(element, "type").as_str() {
            "actuator" => ComponentType::Actuator,
            "sensor" => ComponentType::Sensor,
            _ => ComponentType::System,
        },
        plugin: plugin.map(|plugin| plugin.text().trim().to_owned()).unwrap_or_default(),
        parameters: parameters
            .map(|one| (attribute(one, "name"), one.text().trim().to_owned()))
            .collect(),
        joints: joints.collect(),
        sensors: parts("sensor").chain(parts("gpio")).collect(),
    }
}

fn interfaces(part: &Element, kind: &str) -> Vec<DescribedInterface> {
    let of = |element: &Element| {
        let number = |name: &str| {
            let found = children(element, "param").find(|one| attribute(one, "name") == name)?;
            f64::from_str(found.text().trim()).ok().filter(|number| number.is_finite())
        };
        DescribedInterface {
            name: attribute(element, "name"),
            min: number("min"),
            max: number("max"),
            initial_value: number("initial_value"),
        }
    };
    children(part, kind).map(of).collect()
}

fn children<'a>(element: &'a Element, name: &'a str) -> impl Iterator<Item = &'a Element> {
    element.elements().filter(move |child| child.local_name() == name)
}

fn attribute(element: &Element, name: &str) -> String {
    element.value(name).map(|value| value.trim().to_owned()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(element: &str, name: &str) -> Element {
        Element::new(element).with_attribute("name", name)
    }

    fn param(name: &str, value: &str) -> Element {
        named("param", name).with_text(value)
    }

    #[test]
    fn a_component_of_ros2_control() {
        let command = named("command_interface", "velocity")
            .with_child(param("min", "-5"))
            .with_child(param("max", "5"));
        let state = named("state_interface", "position").with_child(param("initial_value", "1.5"));
        let joint = named("joint", "wheel").with_child(command).with_child(state);
        let sensor = named("sensor", "imu").with_child(named("state_interface", "orientation.x"));
        let hardware = Element::new("hardware")
            .with_child(Element::new("plugin").with_text(" gz_ros2_control/GazeboSimSystem "))
            .with_child(param("rate", "10"));
        let element = named("ros2_control", "robot")
            .with_attribute("type", "system")
            .with_child(hardware)
            .with_child(joint)
            .with_child(sensor);
        let mut model = Model::new("robot");
        model.extra.push(element);
        let [component] = &hardware_of_model(&model)[..] else { panic!("one component") };
        assert_eq!(component.plugin, "gz_ros2_control/GazeboSimSystem");
        assert_eq!(component.parameters, [("rate".to_owned(), "10".to_owned())]);
        let joint = &component.joints[0];
        assert_eq!((joint.commands[0].min, joint.commands[0].max), (Some(-5.0), Some(5.0)));
        assert_eq!(joint.states[0].initial_value, Some(1.5));
        assert_eq!(component.sensors[0].states[0].name, "orientation.x");
    }

    #[test]
    fn transmissions_of_ros_1() {
        let mut model = Model::new("robot");
        for (joint, class) in
            [("left", "hardware_interface/VelocityJointInterface"), ("arm", "EffortJointInterface")]
        {
            let class = Element::new("hardwareInterface").with_text(class);
            let joint = named("joint", joint).with_child(class);
            model.extra.push(named("transmission", "t").with_child(joint));
        }
        let joints = hardware_of_transmissions(&model).unwrap().joints;
        let commands: Vec<(&str, &str)> = joints
            .iter()
            .map(|joint| (joint.name.as_str(), joint.commands[0].name.as_str()))
            .collect();
        assert_eq!(commands, [("left", "velocity"), ("arm", "effort")]);
        assert_eq!(joints[0].states.len(), 3);
        assert!(hardware_of_transmissions(&Model::new("bare")).is_none());
    }
}
