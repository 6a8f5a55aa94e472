//! Creation of controllers by their classes.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_graph::Arguments;
use periplus_msgs::rcl_interfaces::ParameterType;
use periplus_params::{ParamValues, Table};
use periplus_ros2_control::{
    ControllerKind, DIFF_DRIVE, DIFF_DRIVE_ROS1, FORWARD_COMMAND, IMU_BROADCASTER,
    JOINT_CONSTRAINTS, JOINT_GAINS, JOINT_STATE_BROADCASTER, JOINT_TRAJECTORY, MECANUM,
    SINGLE_JOINT, STEERING, TRICYCLE,
};

use super::joints::ModelJoint;
use super::nodes;
use super::plugin::{ControlPlugin, GivenParameters, texts_of};
use super::ros_controller::{ControllerNode, RosController};

/// Joints of the model, for controllers that need its dimensions.
pub(super) type KnownJoints = Arc<BTreeMap<String, ModelJoint>>;

/// Creates a controller with its node.
///
/// # Errors
/// The reason, when the class is not built in or its node cannot be created.
pub(super) fn make(
    plugin: &ControlPlugin,
    name: &str,
    class: &str,
    given: GivenParameters,
    extra: &Arguments,
    joints: &KnownJoints,
) -> Result<Box<dyn RosController>, String> {
    let release = plugin.release;
    let Some(kind) = ControllerKind::of_class(release, class) else {
        let classes = ControllerKind::classes(release);
        let near = periplus_diagnostics::closest(class, classes.iter().map(|(name, _)| *name));
        let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
        return Err(format!("the class `{class}` of `{name}` is not built in{near}"));
    };
    let given = as_lists(given);
    let mut values = ParamValues::defaults(table(kind, release.is_ros1()));
    if kind == ControllerKind::JointTrajectory {
        for joint in texts_of(&given, "joints") {
            values.add_group(
                format!("constraints.{joint}"),
                ParamValues::defaults(&JOINT_CONSTRAINTS),
            );
            values.add_group(format!("gains.{joint}"), ParamValues::defaults(&JOINT_GAINS));
        }
    }
    let text = |error: periplus_graph::GraphError| error.to_string();
    let node = plugin.node(name, extra, &given, false).map_err(text)?;
    let parameters = node.parameters(values).map_err(text)?;
    let namespace = plugin.namespace.clone();
    let part = ControllerNode { node, parameters, kind, release, namespace, given };
    Ok(nodes::make(part, joints))
}

fn table(kind: ControllerKind, is_ros1: bool) -> &'static Table {
    match kind {
        ControllerKind::JointStateBroadcaster => &JOINT_STATE_BROADCASTER,
        ControllerKind::ImuBroadcaster => &IMU_BROADCASTER,
        ControllerKind::DiffDrive if is_ros1 => &DIFF_DRIVE_ROS1,
        ControllerKind::DiffDrive => &DIFF_DRIVE,
        ControllerKind::AckermannSteering
        | ControllerKind::BicycleSteering
        | ControllerKind::TricycleSteering => &STEERING,
        ControllerKind::Tricycle => &TRICYCLE,
        ControllerKind::Mecanum => &MECANUM,
        ControllerKind::Forward
        | ControllerKind::GroupPosition
        | ControllerKind::GroupVelocity
        | ControllerKind::GroupEffort => &FORWARD_COMMAND,
        ControllerKind::JointPosition
        | ControllerKind::JointVelocity
        | ControllerKind::JointEffort
        | ControllerKind::JointPositionByEffort
        | ControllerKind::JointVelocityByEffort => &SINGLE_JOINT,
        ControllerKind::JointTrajectory => &JOINT_TRAJECTORY,
    }
}

/// Converts the parameters that ROS 1 accepts as a name or a list of names to lists.
fn as_lists(mut given: GivenParameters) -> GivenParameters {
    for name in ["left_wheel", "right_wheel", "joints"] {
        if let Some(value) = given.get_mut(name)
            && value.r#type == ParameterType::PARAMETER_STRING
        {
            value.r#type = ParameterType::PARAMETER_STRING_ARRAY;
            value.string_array_value = vec![std::mem::take(&mut value.string_value)];
        }
    }
    given
}
