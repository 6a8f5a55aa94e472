//! Parameters of each plugin.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Node;
use periplus_physics::JointId;
use periplus_physics::drives::{ClassicDiffDrive, WheelPair};

use crate::drives::body::Body;
use crate::drives::build_context::BuildContext;
use crate::drives::wheel_frames::WheelFrames;
use crate::states::{JointStates, OdometryPublisher, planar_covariance};

/// Settings that differ between the plugins.
pub(super) struct Parts {
    pub(super) pairs: Vec<[JointId; 2]>,
    pub(super) drive: ClassicDiffDrive,
    pub(super) command_topic: String,
    pub(super) counts_wheels: bool,
    pub(super) node: Node,
    pub(super) odometry_publisher: OdometryPublisher,
    pub(super) wheel_frames: Option<WheelFrames>,
    pub(super) joint_states: Option<JointStates>,
}

/// `libgazebo_ros_diff_drive.so` of ROS 2.
pub(super) fn diff_drive_of_ros2(
    context: &BuildContext<'_>,
    node: Node,
    diagnostics: &mut Diagnostics,
) -> Option<Parts> {
    let left = context.joints("left_joint", diagnostics);
    let right = context.joints("right_joint", diagnostics);
    let (left, right) = (left?, right?);
    let values = &context.plugin.values;
    let count = usize::try_from(values.integer("num_wheel_pairs").unwrap_or(1)).unwrap_or(1);
    if left.len() != count || right.len() != count {
        let message = format!(
            "plugin `{}` has {} left and {} right joints for {count} pairs of wheels",
            context.site.plugin.name,
            left.len(),
            right.len()
        );
        diagnostics.push(
            Diagnostic::error("wheel-pairs", message)
                .at(context.origin())
                .note("the plugin is disabled; the rest of the model runs")
                .help("give `left_joint` and `right_joint` once for each of `num_wheel_pairs`"),
        );
        return None;
    }
    let separations_m = values.numbers("wheel_separation");
    let diameters_m = values.numbers("wheel_diameter");
    let separations_m =
        one_for_each(context, "wheel_separation", separations_m, count, diagnostics)?;
    let diameters_m = one_for_each(context, "wheel_diameter", diameters_m, count, diagnostics)?;
    let pairs = separations_m.into_iter().zip(diameters_m);
    let drive = ClassicDiffDrive {
        pairs: pairs
            .map(|(separation_m, diameter_m)| WheelPair { separation_m, diameter_m })
            .collect(),
        max_wheel_acceleration_m_s2: context.number("max_wheel_acceleration"),
        max_wheel_torque_n_m: context.number("max_wheel_torque"),
        update_rate_hz: context.number("update_rate"),
    };
    let odometry_publisher = OdometryPublisher::of_gazebo_ros(context, &node, diagnostics)?;
    let joints = ["left_joint", "right_joint"];
    let wheel_frames = context
        .flag("publish_wheel_tf")
        .then(|| WheelFrames::new(context, &node, &joints, diagnostics))
        .flatten();
    Some(Parts {
        pairs: left.into_iter().zip(right).map(|(left, right)| [left, right]).collect(),
        drive,
        command_topic: "cmd_vel".into(),
        counts_wheels: values.integer("odometry_source") == Some(0),
        node,
        odometry_publisher,
        wheel_frames,
        joint_states: None,
    })
}

/// Returns values for each pair of wheels; a single value, given or default, applies to all pairs.
/// Classic requires one each.
fn one_for_each(
    context: &BuildContext<'_>,
    parameter: &str,
    mut values: Vec<f64>,
    count: usize,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let given = context.plugin.values.is_given(parameter);
    if values.len() != count && (given && values.len() != 1 || values.is_empty()) {
        let message = format!(
            "plugin `{}` has {} values of `{parameter}` for {count} pairs of wheels",
            context.site.plugin.name,
            values.len()
        );
        diagnostics.push(
            Diagnostic::error("wheel-pairs", message)
                .at(context.plugin.values.origin(parameter))
                .note("the plugin is disabled; the rest of the model runs")
                .help(format!("give `{parameter}` once, or once for each pair")),
        );
        return None;
    }
    values.resize(count, values.first().copied()?);
    Some(values)
}

/// `libgazebo_ros_diff_drive.so` of ROS 1.
pub(super) fn diff_drive_of_ros1(
    context: &BuildContext<'_>,
    node: Node,
    diagnostics: &mut Diagnostics,
) -> Option<Parts> {
    let left = context.joint("leftJoint", diagnostics);
    let right = context.joint("rightJoint", diagnostics);
    let (left, right) = (left?, right?);
    let pair = WheelPair {
        separation_m: context.number("wheelSeparation"),
        diameter_m: context.number("wheelDiameter"),
    };
    let drive = ClassicDiffDrive {
        pairs: vec![pair],
        max_wheel_acceleration_m_s2: context.number("wheelAcceleration"),
        max_wheel_torque_n_m: context.number("wheelTorque"),
        update_rate_hz: context.number("updateRate"),
    };
    let mut odometry_publisher =
        OdometryPublisher::between(context.text("odometryFrame"), context.text("robotBaseFrame"));
    odometry_publisher.pose_covariance = planar_covariance(1e-5, 1e-5, 1e-3);
    if context.flag("publishTf") {
        odometry_publisher =
            odometry_publisher.on(context, &node, &context.text("odometryTopic"), diagnostics)?;
        if context.flag("publishOdomTF") {
            odometry_publisher = odometry_publisher.with_tf(context, &node, "/tf", diagnostics)?;
        }
    }
    let joints = ["leftJoint", "rightJoint"];
    let wheel_frames = context
        .flag("publishWheelTF")
        .then(|| WheelFrames::new(context, &node, &joints, diagnostics))
        .flatten();
    let joint_states = context
        .flag("publishWheelJointState")
        .then(|| JointStates::of_wheels(context, &node, &[right, left], diagnostics))
        .flatten();
    let wheels =
        if swaps_sides(context, left, right, diagnostics) { [right, left] } else { [left, right] };
    Some(Parts {
        pairs: vec![wheels],
        drive,
        command_topic: context.text("commandTopic"),
        counts_wheels: context.text("odometrySource") == "encoder",
        node,
        odometry_publisher,
        wheel_frames,
        joint_states,
    })
}

/// Returns true if the left and right joints are swapped (`legacyMode`).
///
/// Until Kinetic the plugin rotated its wheels in the wrong direction, and robots swapped the names
/// of their joints to compensate. Since then `legacyMode` selects the behaviour; without it the
/// original uses the legacy one and logs an error. Here the positions of the joints decide, so that
/// a robot commanded to the left turns left.
fn swaps_sides(
    context: &BuildContext<'_>,
    left: JointId,
    right: JointId,
    diagnostics: &mut Diagnostics,
) -> bool {
    if context.plugin.values.is_given("legacyMode") {
        return context.flag("legacyMode");
    }
    let Some(left_is_left) = is_left_of(context, left, right) else { return false };
    let wanted = !left_is_left;
    let message = format!(
        "plugin `{}` has no `legacyMode`; taken as `{wanted}`, so that the robot turns left \
         when commanded to",
        context.site.plugin.name
    );
    let help = format!("add `<legacyMode>{wanted}</legacyMode>`: Gazebo assumes true otherwise");
    diagnostics.push(Diagnostic::hint("legacy-mode", message).at(context.origin()).help(help));
    wanted
}

/// Returns true if the wheel of one joint is to the left of the other's.
fn is_left_of(context: &BuildContext<'_>, one: JointId, other: JointId) -> Option<bool> {
    let model_from_world =
        Body::of_model(context)?.state(context.setting.world)?.world_from_link.inverse();
    let y_m = |joint: JointId| {
        let name = context.setting.world.joint_name(joint)?;
        let child = periplus_scene::carrying_link(context.setting.root, name)?;
        let link = context.setting.world.find_link(context.setting.model, &child)?;
        let state = context.setting.world.link_state(link)?;
        Some((model_from_world * state.world_from_link).translation.y)
    };
    let apart_m = y_m(one)? - y_m(other)?;
    (apart_m.abs() > 1e-6).then_some(apart_m > 0.0)
}

/// `libgazebo_ros_skid_steer_drive.so` of ROS 1.
pub(super) fn skid_steer(
    context: &BuildContext<'_>,
    node: Node,
    diagnostics: &mut Diagnostics,
) -> Option<Parts> {
    let names = ["leftFrontJoint", "rightFrontJoint", "leftRearJoint", "rightRearJoint"];
    let [left_front, right_front, left_rear, right_rear] =
        names.map(|name| context.joint(name, diagnostics));
    let pair = WheelPair {
        separation_m: context.number("wheelSeparation"),
        diameter_m: context.number("wheelDiameter"),
    };
    let drive =
        ClassicDiffDrive::skid_steer(pair, context.number("torque"), context.number("updateRate"));
    let mut odometry_publisher =
        OdometryPublisher::between(context.text("odometryFrame"), context.text("robotBaseFrame"));
    odometry_publisher.pose_covariance = planar_covariance(
        context.number("covariance_x"),
        context.number("covariance_y"),
        context.number("covariance_yaw"),
    );
    odometry_publisher.twist_covariance = odometry_publisher.pose_covariance;
    odometry_publisher =
        odometry_publisher.on(context, &node, &context.text("odometryTopic"), diagnostics)?;
    if context.flag("broadcastTF") {
        odometry_publisher = odometry_publisher.with_tf(context, &node, "/tf", diagnostics)?;
    }
    Some(Parts {
        pairs: vec![[left_front?, right_front?], [left_rear?, right_rear?]],
        drive,
        command_topic: context.text("commandTopic"),
        counts_wheels: false,
        node,
        odometry_publisher,
        wheel_frames: None,
        joint_states: None,
    })
}
