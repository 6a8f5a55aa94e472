//! Publishers of joint states and true poses.

use crate::bridge::{JOINT_STATES, ODOMETRY};
use crate::entry::{MigrationOutcome, TopicAspect};
use crate::old_plugin::OldPlugin;
use crate::replacement::{Replacement, leaf, system};

/// `gazebo_ros_joint_state_publisher`.
pub(super) fn joint_states(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let topic = plugin.ros_topic("joint_states");
    let mut states = system("joint-state-publisher", "JointStatePublisher");
    states.push(leaf("topic", &topic));
    let rate = if plugin.is_ros1() { "updateRate" } else { "update_rate" };
    let rate_hz = plugin.text(&[rate]).unwrap_or_else(|| "100".to_owned());
    states.push(leaf("update_rate", rate_hz));
    let names = plugin.texts(if plugin.is_ros1() { "jointName" } else { "joint_name" });
    // ROS 1 has one list with commas.
    for joint in names.iter().flat_map(|names| names.split(',')).map(str::trim) {
        if !joint.is_empty() {
            states.push(leaf("joint_name", joint));
        }
    }
    replacement.elements.push(states);
    replacement.bridge_to_ros(&topic, &topic, JOINT_STATES);
    replacement.expects(&topic, TopicAspect::Fields, EFFORTS);
    replacement
}

/// Difference of joint states.
pub(super) const EFFORTS: &str = "JointStatePublisher publishes velocities and efforts, too";

/// `gazebo_ros_p3d`.
pub(super) fn true_pose(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let topic = if plugin.is_ros1() {
        plugin.topic(&["topicName"], "p3d")
    } else {
        plugin.ros_topic("odom")
    };
    let frame = plugin.frame(&["frame_name", "frameName"]).unwrap_or_else(|| "world".to_owned());
    let body = plugin.frame(&["body_name", "bodyName"]).unwrap_or_default();
    let mut truth = system("odometry-publisher", "OdometryPublisher");
    truth.push(leaf("dimensions", "3"));
    truth.push(leaf("odom_frame", &frame));
    truth.push(leaf("robot_base_frame", &body));
    let rate_hz = plugin.text(&["update_rate", "updateRate"]).unwrap_or_else(|| "0".to_owned());
    truth.push(leaf("odom_publish_frequency", rate_hz));
    truth.push(leaf("odom_topic", &topic));
    for (new, old) in
        [("xyz_offset", ["xyz_offset", "xyzOffset"]), ("rpy_offset", ["rpy_offset", "rpyOffset"])]
    {
        if let Some(offset) =
            plugin.text(&[old[0], old[1], &format!("{}s", old[0]), &format!("{}s", old[1])])
            && plugin.is_nonzero(&[
                old[0],
                old[1],
                &format!("{}s", old[0]),
                &format!("{}s", old[1]),
            ])
        {
            truth.push(leaf(new, offset));
        }
    }
    if let Some(noise) = plugin.text(&["gaussian_noise", "gaussianNoise"])
        && plugin.is_nonzero(&["gaussian_noise", "gaussianNoise"])
    {
        truth.push(leaf("gaussian_noise", noise));
    }
    replacement.elements.push(truth);
    replacement.bridge_to_ros(&topic, &topic, ODOMETRY);
    let reason = format!(
        "OdometryPublisher publishes the pose of the model, gazebo_ros_p3d that of the link `{body}`; \
         they are equal if this link is the model's first one, or fixed to it at its origin"
    );
    replacement.differs(reason.clone());
    replacement.expects(&topic, TopicAspect::Values, reason);
    replacement.expects(
        &topic,
        TopicAspect::Fields,
        "the child frame of gazebo_ros_p3d is that of its link, and its velocities are those of the world's axes",
    );
    replacement.expects(
        &topic,
        TopicAspect::Frame,
        "gazebo_ros_p3d leaves the child frame as it finds it",
    );
    if !matches!(frame.as_str(), "world" | "map" | "odom") {
        replacement.differs(format!(
            "poses relative to the link `{frame}` have no counterpart: the pose in the world is \
             published"
        ));
    }
    replacement
}
