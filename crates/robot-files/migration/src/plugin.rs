//! Plugins of Gazebo Classic and their replacements.

mod control;
mod drive;
mod effect;
mod state;

use periplus_plugin_specs::{Family, Role};

use crate::entry::MigrationOutcome;
use crate::old_plugin::OldPlugin;
use crate::replacement::Replacement;
use crate::{MigrationContext, sensor};

/// Replacement of a plugin. `None` for plugins of current Gazebo, which stay.
pub(crate) fn replacement(
    plugin: &OldPlugin<'_>,
    context: &MigrationContext<'_>,
) -> Option<Replacement> {
    if !is_classic(plugin) {
        return None;
    }
    let Some(spec) = plugin.spec else { return Some(unknown(plugin)) };
    let mut replacement = match spec.id {
        "gazebo_ros_diff_drive" | "gazebo_ros_skid_steer_drive" => {
            drive::differential(plugin, context)
        }
        "gazebo_ros_planar_move" => drive::planar(plugin),
        "DiffDrivePlugin" | "SkidSteerDrivePlugin" => drive::classic(plugin, context),
        "gazebo_ros_ackermann_drive" | "gazebo_ros_tricycle_drive" => drive::steered(plugin),
        "gazebo_ros_joint_state_publisher" => state::joint_states(plugin),
        "gazebo_ros_p3d" => state::true_pose(plugin),
        "gazebo_ros_control" | "gazebo_ros2_control" => control::ros_control(plugin),
        "gazebo_ros_imu"
        | "hector_gazebo_ros_imu"
        | "hector_gazebo_ros_gps"
        | "hector_gazebo_ros_magnetic"
        | "gazebo_ros_ft_sensor" => sensor::of_body(plugin),
        "gazebo_ros_wheel_slip" | "WheelSlipPlugin" => effect::wheel_slip(plugin),
        "LiftDragPlugin" => effect::lift_drag(plugin),
        _ if spec.role == Role::Sensor && plugin.surroundings.sensor.is_some() => {
            sensor::plugin(plugin)
        }
        _ if spec.role == Role::World && spec.family != Family::Classic => built_in(spec.id),
        _ => none(plugin),
    };
    if plugin.has_conditions {
        replacement.differs(
            "the plugin has parameters inside of <xacro:if>; the new elements contain the first \
             value of each, without the condition: put the condition around them",
        );
    }
    Some(replacement)
}

/// True for a plugin of Gazebo Classic, or an unknown one.
pub(crate) fn is_classic(plugin: &OldPlugin<'_>) -> bool {
    match plugin.spec {
        Some(spec) => spec.family != Family::Gz,
        None => !is_current(&plugin.plugin.filename),
    }
}

/// True for libraries of current Gazebo that are not in the tables.
fn is_current(filename: &str) -> bool {
    let name = filename.trim().trim_start_matches("lib");
    ["gz-sim", "gz_", "ignition-gazebo", "ign_", "gz-gui"].iter().any(|part| name.starts_with(part))
        || name.contains("_gz_")
        || name.contains("gz_ros2_control")
}

fn unknown(plugin: &OldPlugin<'_>) -> Replacement {
    Replacement::without(
        MigrationOutcome::NoCounterpart,
        format!(
            "{} is a plugin of the project or of another one, built against Gazebo Classic: port \
             its code to a system of gz-sim (gz::sim::System), then load it here",
            plugin.plugin.filename
        ),
    )
}

fn built_in(id: &str) -> Replacement {
    let remark = match id {
        "gazebo_ros_state" => {
            "poses of all entities are on /world/<world>/pose/info, the service \
             /world/<world>/set_pose sets them; bridge them if your nodes need them"
        }
        "gazebo_ros_factory" => "`ros2 run ros_gz_sim create` spawns models",
        "gazebo_ros_template" => "an empty example",
        _ => {
            "UserCommands and SceneBroadcaster have these functions as services below \
             /world/<world>"
        }
    };
    Replacement::without(MigrationOutcome::BuiltIn, remark)
}

/// Known plugins without a counterpart, with advice.
fn none(plugin: &OldPlugin<'_>) -> Replacement {
    let library = plugin.library();
    let advice = match library.as_str() {
        "gazebo_ros_vacuum_gripper" => {
            "DetachableJoint holds an object from a topic; it does not pull at a distance"
        }
        "gazebo_ros_force" => {
            "ApplyLinkWrench applies forces from /world/<world>/wrench; bridge it as \
             ros_gz_interfaces/msg/EntityWrench"
        }
        "gazebo_ros_joint_pose_trajectory" | "gazebo_ros_joint_trajectory" => {
            "use joint_trajectory_controller of gz_ros2_control, or JointTrajectoryController"
        }
        "gazebo_ros_elevator" | "ElevatorPlugin" => {
            "the system Elevator exists, but it takes its floors from joints of the model: rewrite \
             the model as its tutorial shows"
        }
        "gazebo_ros_f3d" => "add a force_torque sensor to the joint that carries the link",
        "gazebo_ros_projector" => "a <projector> works without plugin; it cannot be switched",
        "BuoyancyPlugin" => {
            "use the world plugin gz::sim::systems::Buoyancy, with <enable> for this model"
        }
        "ActorPlugin" | "gazebo_ros_hand_of_god" => "there is no such system",
        "JointControlPlugin" => "use one JointPositionController or JointController for each joint",
        _ => {
            "there is no such system in Gazebo Harmonic; leave the function out, or write a system"
        }
    };
    Replacement::without(MigrationOutcome::NoCounterpart, advice)
}
