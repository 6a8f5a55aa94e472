//! Drives.

use periplus_xml::Element;

use crate::bridge::{JOINT_STATES, ODOMETRY, TRANSFORMS, TWIST};
use crate::entry::{MigrationOutcome, TopicAspect};
use crate::old_plugin::{Flag, OldPlugin};
use crate::replacement::{Replacement, leaf, system};
use crate::{MigrationContext, template};

/// Odometry of a drive.
struct OldOdometry {
    topic: String,
    frame: String,
    base: String,
    rate_hz: String,
    is_published: Flag,
    has_transform: Flag,
    is_truth: bool,
}

impl OldOdometry {
    fn read(plugin: &OldPlugin<'_>, rate_hz: String, is_truth: bool) -> Self {
        let base = if plugin.library() == "gazebo_ros_ackermann_drive" {
            "base_link"
        } else {
            "base_footprint"
        };
        let frame = |names: &[&str], default: &str| {
            plugin.frame(names).unwrap_or_else(|| default.to_owned())
        };
        let (odometry_topic, is_published, has_transform) = if plugin.is_ros1() {
            let transform = match plugin.library().as_str() {
                "gazebo_ros_skid_steer_drive" => plugin.flag(&["broadcastTF"], false),
                "gazebo_ros_planar_move" => plugin.flag(&["publishTF"], true),
                _ if plugin.flag(&["publishTf"], true) == Flag::No => Flag::No,
                _ => plugin.flag(&["publishOdomTF"], true),
            };
            let published = plugin.flag(&["publishOdometry"], true);
            (plugin.topic(&["odometryTopic"], "odom"), published, transform)
        } else {
            let default = plugin.library() == "gazebo_ros_planar_move";
            let published = plugin.flag(&["publish_odom"], default);
            (plugin.ros_topic("odom"), published, plugin.flag(&["publish_odom_tf"], default))
        };
        Self {
            topic: odometry_topic,
            frame: frame(&["odometry_frame", "odometryFrame"], "odom"),
            base: frame(&["robot_base_frame", "robotBaseFrame"], base),
            rate_hz,
            is_published,
            has_transform,
            is_truth,
        }
    }

    /// True if anything is published, or may be.
    fn is_needed(&self) -> bool {
        self.is_published != Flag::No || self.has_transform != Flag::No
    }

    /// Adds the topics of a publisher. Where an expression decides, so does it in the new file.
    fn add_topics(&self, publisher: &mut Element, replacement: &mut Replacement) {
        let mut add = |flag: &Flag, name: &str, topic: &str| match flag {
            Flag::No => false,
            Flag::Yes => {
                publisher.push(leaf(name, topic));
                true
            }
            Flag::Unknown(expression) => {
                let condition =
                    Element::new("xacro:if").with_attribute("value", expression.as_str());
                publisher.push(condition.with_child(leaf(name, topic)));
                true
            }
        };
        if add(&self.is_published, "odom_topic", &self.topic) {
            replacement.bridge_to_ros(&self.topic, &self.topic, ODOMETRY);
            replacement.expects(&self.topic, TopicAspect::Fields, COVARIANCE);
        }
        if add(&self.has_transform, "tf_topic", "/tf") {
            replacement.bridge_to_ros("/tf", "/tf", TRANSFORMS);
        }
    }

    /// Topics of a drive system's own odometry.
    fn of_wheels(&self, drive: &mut Element, replacement: &mut Replacement) {
        drive.push(leaf("odom_publish_frequency", &self.rate_hz));
        self.add_topics(drive, replacement);
        drive.push(leaf("frame_id", &self.frame));
        drive.push(leaf("child_frame_id", &self.base));
    }

    /// System that publishes the true pose.
    fn of_truth(&self, replacement: &mut Replacement) {
        let mut truth = system("odometry-publisher", "OdometryPublisher");
        truth.push(leaf("dimensions", "3"));
        truth.push(leaf("odom_frame", &self.frame));
        truth.push(leaf("robot_base_frame", &self.base));
        truth.push(leaf("odom_publish_frequency", &self.rate_hz));
        self.add_topics(&mut truth, replacement);
        replacement.elements.push(truth);
    }
}

const COVARIANCE: &str = "the systems of gz-sim publish odometry with zero covariance; set it in the node that uses it, \
                          or bridge `odometry_with_covariance` of OdometryPublisher";

/// `gazebo_ros_diff_drive`, `gazebo_ros_skid_steer_drive`.
pub(super) fn differential(plugin: &OldPlugin<'_>, context: &MigrationContext<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let mut drive = system("diff-drive", "DiffDrive");
    let [left, right] = wheels(plugin, context, &mut replacement);
    for joint in &left {
        drive.push(leaf("left_joint", joint));
    }
    for joint in &right {
        drive.push(leaf("right_joint", joint));
    }
    let is_skid = plugin.library() == "gazebo_ros_skid_steer_drive";
    let fallback = if is_skid { "0.4" } else { "0.34" };
    let separation =
        first(plugin, &["wheel_separation", "wheelSeparation"], fallback, &mut replacement);
    let diameter = first(plugin, &["wheel_diameter", "wheelDiameter"], "0.15", &mut replacement);
    drive.push(leaf("wheel_separation", &separation));
    match template::half(&diameter) {
        Some(radius) => drive.push(leaf("wheel_radius", radius)),
        None => {
            replacement.differs(format!(
                "the wheel diameter `{diameter}` cannot be halved as text; write half of it into \
                 <wheel_radius>, which has the default of 0.2 m now"
            ));
        }
    }
    let command = plugin.topic(&["commandTopic"], "cmd_vel");
    let command = if plugin.is_ros1() { command } else { plugin.ros_topic("cmd_vel") };
    drive.push(leaf("topic", &command));
    replacement.bridge_to_gz(&command, &command, TWIST);
    // `updateRate` has no effect on ROS 2.
    let rate = if plugin.is_ros1() { "updateRate" } else { "update_rate" };
    let rate_hz = plugin.text(&[rate]).unwrap_or_else(|| "100".to_owned());
    let source = plugin.text(&["odometry_source", "odometrySource"]);
    let is_truth = match source.as_deref() {
        Some("encoder" | "0") => false,
        Some(source) if template::is_template(source) => {
            replacement
                .differs("the source of the odometry is an expression; the true pose is published");
            true
        }
        _ => true,
    };
    let odometry = OldOdometry::read(plugin, rate_hz, is_truth);
    accelerate(plugin, &separation, &mut drive, &mut replacement);
    if !odometry.is_truth {
        odometry.of_wheels(&mut drive, &mut replacement);
    }
    replacement.elements.push(drive);
    if odometry.is_truth && odometry.is_needed() {
        odometry.of_truth(&mut replacement);
        replacement.remark(
            "the old odometry was the true pose in the world (its source is `world`), which \
             OdometryPublisher publishes; for the odometry of wheels delete OdometryPublisher and \
             give DiffDrive <odom_topic>, <tf_topic>, <frame_id> and <child_frame_id>",
        );
    }
    if let Some(torque) = plugin.text(&["max_wheel_torque", "wheelTorque", "torque"]) {
        replacement.remark(format!(
            "the maximum torque ({torque} N m) has no counterpart in DiffDrive; set \
             <limit effort=\"...\"> of the wheel joints"
        ));
    }
    if plugin.flag(&["publish_wheel_tf", "publishWheelTF"], false) != Flag::No {
        replacement.remark(
            "transforms of the wheels come from robot_state_publisher and the joint states",
        );
        for aspect in [TopicAspect::Frame, TopicAspect::Rate] {
            replacement.expects(
                "/tf",
                aspect,
                "DiffDrive publishes no transforms of wheels: they come from robot_state_publisher, which needs \
                 the joint states of the wheels",
            );
        }
    }
    if plugin.flag(&["publishWheelJointState"], false) != Flag::No {
        let mut states = system("joint-state-publisher", "JointStatePublisher");
        let topic = plugin.ros_topic("joint_states");
        states.push(leaf("topic", &topic));
        if let Some(rate_hz) = plugin.text(&["updateRate"]) {
            states.push(leaf("update_rate", rate_hz));
        }
        for joint in left.iter().chain(&right) {
            states.push(leaf("joint_name", joint));
        }
        replacement.elements.push(states);
        replacement.bridge_to_ros(&topic, &topic, JOINT_STATES);
        replacement.expects(&topic, TopicAspect::Fields, super::state::EFFORTS);
    }
    replacement
}

/// Joints of the left and right wheels.
fn wheels(
    plugin: &OldPlugin<'_>,
    context: &MigrationContext<'_>,
    replacement: &mut Replacement,
) -> [Vec<String>; 2] {
    let one =
        |name: &str, default: &str| plugin.text(&[name]).unwrap_or_else(|| default.to_owned());
    if plugin.library() == "gazebo_ros_skid_steer_drive" {
        return [
            vec![
                one("leftFrontJoint", "left_front_joint"),
                one("leftRearJoint", "left_rear_joint"),
            ],
            vec![
                one("rightFrontJoint", "right_front_joint"),
                one("rightRearJoint", "right_rear_joint"),
            ],
        ];
    }
    if plugin.is_ros1() {
        let mut sides =
            [vec![one("leftJoint", "left_joint")], vec![one("rightJoint", "right_joint")]];
        match plugin.text(&["legacyMode"]).map(|text| template::flag(&text)) {
            Some(Some(true)) => {
                sides.swap(0, 1);
                replacement
                    .remark("legacyMode swapped left and right; the joints are swapped here");
            }
            Some(None) => replacement.differs("legacyMode is an expression and was taken as false"),
            Some(Some(false)) => {}
            None => {
                if context.is_left_of(&sides[1][0], &sides[0][0]) == Some(true) {
                    sides.swap(0, 1);
                    replacement.remark(
                        "the joints are swapped: without `legacyMode` the old plugin swapped left and right, and \
                         this robot has its joints the other way round to compensate",
                    );
                } else {
                    replacement.differs(
                        "the plugin has no `legacyMode`, with which Gazebo swaps left and right; the joints \
                         are taken as named",
                    );
                }
            }
        }
        return sides;
    }
    [plugin.texts("left_joint"), plugin.texts("right_joint")]
}

/// First value of a parameter that was given once for each pair of wheels.
fn first(
    plugin: &OldPlugin<'_>,
    names: &[&str],
    default: &str,
    replacement: &mut Replacement,
) -> String {
    let values: Vec<String> = names.iter().flat_map(|name| plugin.texts(name)).collect();
    if values.windows(2).any(|pair| pair[0] != pair[1]) {
        replacement.differs(format!(
            "DiffDrive has one <{}> for all pairs of wheels: the first of {} is used",
            names[0],
            values.join(", ")
        ));
    }
    values.into_iter().next().unwrap_or_else(|| default.to_owned())
}

/// Limits of the acceleration at the rim as limits of the robot: a turn in place moves the rim by half of the separation
/// for each radian.
fn accelerate(
    plugin: &OldPlugin<'_>,
    separation: &str,
    drive: &mut Element,
    replacement: &mut Replacement,
) {
    let Some(limit) = plugin.text(&["max_wheel_acceleration", "wheelAcceleration"]) else { return };
    if template::number(&limit) == Some(0.0) {
        return;
    }
    let angular = template::twice_quotient(&limit, separation);
    let (Some(back), Some(angular)) = (template::negative(&limit), angular) else {
        replacement.differs(format!("the acceleration limit `{limit}` was not converted"));
        return;
    };
    let Some(angular_back) = template::negative(&angular) else { return };
    drive.push(leaf("min_linear_acceleration", back));
    drive.push(leaf("max_linear_acceleration", &limit));
    drive.push(leaf("min_angular_acceleration", angular_back));
    drive.push(leaf("max_angular_acceleration", angular));
    replacement.differs(
        "the old limit of acceleration was that of each wheel's rim; the new limits are those of the \
         robot, equal for straight drives and turns in place",
    );
    replacement.expects(ANY_MOTION, TopicAspect::Values, ACCELERATION);
}

/// Topic of differences that concern the motion itself, and with it every measured value.
pub(crate) const ANY_MOTION: &str = crate::ALL_TOPICS;

const ACCELERATION: &str = "DiffDrive limits the acceleration of the robot, the old plugin that of each wheel in steps of \
                            the plugin's rate: after a change of the command the robots differ until both have the new speed";

/// `gazebo_ros_planar_move`.
pub(super) fn planar(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let command = if plugin.is_ros1() {
        plugin.topic(&["commandTopic"], "cmd_vel")
    } else {
        plugin.ros_topic("cmd_vel")
    };
    let mut control = system("velocity-control", "VelocityControl");
    control.push(leaf("topic", &command));
    replacement.elements.push(control);
    replacement.bridge_to_gz(&command, &command, TWIST);
    let rate = if plugin.is_ros1() { "odometryRate" } else { "publish_rate" };
    let rate_hz = plugin.text(&[rate]).unwrap_or_else(|| "20".to_owned());
    let odometry = OldOdometry::read(plugin, rate_hz, true);
    if odometry.is_needed() {
        odometry.of_truth(&mut replacement);
    }
    replacement.differs(
        "VelocityControl sets the velocity in every step, also the vertical one: the model neither \
         falls nor is pushed",
    );
    replacement.expects(
        ANY_MOTION,
        TopicAspect::Values,
        "VelocityControl holds the model's height from the first step; the old plugin lets it settle on its wheels",
    );
    if plugin
        .text(&["cmdTimeout"])
        .and_then(|text| template::number(&text))
        .is_some_and(|s| s >= 0.0)
    {
        replacement
            .differs("the timeout of commands has no counterpart; stop the robot by a command");
    }
    replacement
}

/// Gazebo Classic's own drives, which listen to Gazebo's transport.
pub(super) fn classic(plugin: &OldPlugin<'_>, context: &MigrationContext<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Approximated);
    let mut drive = system("diff-drive", "DiffDrive");
    let named = |names: [&str; 3]| -> Vec<String> {
        names.iter().flat_map(|name| plugin.texts(name)).collect()
    };
    let left = named(["left_joint", "left_front", "left_rear"]);
    let right = named(["right_joint", "right_front", "right_rear"]);
    for joint in &left {
        drive.push(leaf("left_joint", joint));
    }
    for joint in &right {
        drive.push(leaf("right_joint", joint));
    }
    let pair = left.first().zip(right.first());
    let separation_m = pair.and_then(|(left, right)| context.separation_m(left, right));
    let radius_m = left.first().and_then(|joint| context.joints?.get(joint)?.wheel_radius_m);
    match (separation_m, radius_m) {
        (Some(separation_m), Some(radius_m)) => {
            drive.push(leaf("wheel_separation", template::shown(separation_m)));
            drive.push(leaf("wheel_radius", template::shown(radius_m)));
            replacement.remark(
                "separation and radius of the wheels are those of the model, as the old plugin measured them",
            );
        }
        _ => replacement.remark(
            "the old plugin computed separation and radius of the wheels from the model; write them into \
             <wheel_separation> and <wheel_radius>, whose defaults are 1 m and 0.2 m",
        ),
    }
    replacement.elements.push(drive);
    replacement.remark(
        "commands come on /model/<model>/cmd_vel (gz.msgs.Twist) instead of ~/<model>/vel_cmd",
    );
    replacement
}

/// Drives with steered wheels.
pub(super) fn steered(plugin: &OldPlugin<'_>) -> Replacement {
    let advice = if plugin.library() == "gazebo_ros_ackermann_drive" {
        "use AckermannSteering; it needs <wheel_base>, <kingpin_width>, <wheel_separation> and \
         <wheel_radius>, which the old plugin measured in the model"
    } else {
        "there is no tricycle drive; use tricycle_controller of ros2_control with gz_ros2_control"
    };
    Replacement::without(MigrationOutcome::NoCounterpart, advice)
}
