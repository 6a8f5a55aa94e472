//! What each plugin makes of its parameters.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Node;
use periplus_physics::JointId;
use periplus_physics::drives::{ClassicDiffDrive, WheelPair};

use crate::drives::body::Body;
use crate::drives::order::Order;
use crate::drives::wheel_frames::WheelFrames;
use crate::states::{JointStates, Teller, planar_covariance};

/// What differs from plugin to plugin.
pub(super) struct Parts {
    pub(super) pairs: Vec<[JointId; 2]>,
    pub(super) drive: ClassicDiffDrive,
    pub(super) command_topic: String,
    pub(super) counts_wheels: bool,
    pub(super) node: Node,
    pub(super) teller: Teller,
    pub(super) wheel_frames: Option<WheelFrames>,
    pub(super) joint_states: Option<JointStates>,
}

/// `libgazebo_ros_diff_drive.so` of ROS 2.
pub(super) fn diff_drive_of_ros2(
    order: &Order<'_>,
    node: Node,
    diagnostics: &mut Diagnostics,
) -> Option<Parts> {
    let left = order.joints("left_joint", diagnostics);
    let right = order.joints("right_joint", diagnostics);
    let (left, right) = (left?, right?);
    let values = &order.plugin.values;
    let count = usize::try_from(values.integer("num_wheel_pairs").unwrap_or(1)).unwrap_or(1);
    if left.len() != count || right.len() != count {
        let message = format!(
            "plugin `{}` has {} left and {} right joints for {count} pairs of wheels",
            order.site.plugin.name,
            left.len(),
            right.len()
        );
        diagnostics.push(
            Diagnostic::error("wheel-pairs", message)
                .at(order.origin())
                .note("the plugin does nothing; the rest of the model runs")
                .help("give `left_joint` and `right_joint` once for each of `num_wheel_pairs`"),
        );
        return None;
    }
    let separations_m = values.numbers("wheel_separation");
    let diameters_m = values.numbers("wheel_diameter");
    let separations_m = one_for_each(order, "wheel_separation", separations_m, count, diagnostics)?;
    let diameters_m = one_for_each(order, "wheel_diameter", diameters_m, count, diagnostics)?;
    let pairs = separations_m.into_iter().zip(diameters_m);
    let drive = ClassicDiffDrive {
        pairs: pairs
            .map(|(separation_m, diameter_m)| WheelPair { separation_m, diameter_m })
            .collect(),
        max_wheel_acceleration_m_s2: order.number("max_wheel_acceleration"),
        max_wheel_torque_n_m: order.number("max_wheel_torque"),
        update_rate_hz: order.number("update_rate"),
    };
    let mut teller = Teller::between(order.text("odometry_frame"), order.text("robot_base_frame"));
    teller.pose_covariance = planar_covariance(
        order.number("covariance_x"),
        order.number("covariance_y"),
        order.number("covariance_yaw"),
    );
    teller.twist_covariance = teller.pose_covariance;
    if order.flag("publish_odom") {
        teller = teller.on(order, &node, "odom", diagnostics)?;
    }
    if order.flag("publish_odom_tf") {
        teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
    }
    let joints = ["left_joint", "right_joint"];
    let wheel_frames = order
        .flag("publish_wheel_tf")
        .then(|| WheelFrames::new(order, &node, &joints, diagnostics))
        .flatten();
    Some(Parts {
        pairs: left.into_iter().zip(right).map(|(left, right)| [left, right]).collect(),
        drive,
        command_topic: "cmd_vel".into(),
        counts_wheels: values.integer("odometry_source") == Some(0),
        node,
        teller,
        wheel_frames,
        joint_states: None,
    })
}

/// Values for each pair; one value, written or default, serves all of them. Classic asks for one
/// each.
fn one_for_each(
    order: &Order<'_>,
    parameter: &str,
    mut values: Vec<f64>,
    count: usize,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let given = order.plugin.values.is_given(parameter);
    if values.len() != count && (given && values.len() != 1 || values.is_empty()) {
        let message = format!(
            "plugin `{}` has {} values of `{parameter}` for {count} pairs of wheels",
            order.site.plugin.name,
            values.len()
        );
        diagnostics.push(
            Diagnostic::error("wheel-pairs", message)
                .at(order.plugin.values.origin(parameter))
                .note("the plugin does nothing; the rest of the model runs")
                .help(format!("give `{parameter}` once, or once for each pair")),
        );
        return None;
    }
    values.resize(count, values.first().copied()?);
    Some(values)
}

/// `libgazebo_ros_diff_drive.so` of ROS 1.
pub(super) fn diff_drive_of_ros1(
    order: &Order<'_>,
    node: Node,
    diagnostics: &mut Diagnostics,
) -> Option<Parts> {
    let left = order.joint("leftJoint", diagnostics);
    let right = order.joint("rightJoint", diagnostics);
    let (left, right) = (left?, right?);
    let pair = WheelPair {
        separation_m: order.number("wheelSeparation"),
        diameter_m: order.number("wheelDiameter"),
    };
    let drive = ClassicDiffDrive {
        pairs: vec![pair],
        max_wheel_acceleration_m_s2: order.number("wheelAcceleration"),
        max_wheel_torque_n_m: order.number("wheelTorque"),
        update_rate_hz: order.number("updateRate"),
    };
    let mut teller = Teller::between(order.text("odometryFrame"), order.text("robotBaseFrame"));
    teller.pose_covariance = planar_covariance(1e-5, 1e-5, 1e-3);
    if order.flag("publishTf") {
        teller = teller.on(order, &node, &order.text("odometryTopic"), diagnostics)?;
        if order.flag("publishOdomTF") {
            teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
        }
    }
    let joints = ["leftJoint", "rightJoint"];
    let wheel_frames = order
        .flag("publishWheelTF")
        .then(|| WheelFrames::new(order, &node, &joints, diagnostics))
        .flatten();
    let joint_states = order
        .flag("publishWheelJointState")
        .then(|| JointStates::of_wheels(order, &node, &[right, left], diagnostics))
        .flatten();
    let wheels =
        if swaps_sides(order, left, right, diagnostics) { [right, left] } else { [left, right] };
    Some(Parts {
        pairs: vec![wheels],
        drive,
        command_topic: order.text("commandTopic"),
        counts_wheels: order.text("odometrySource") == "encoder",
        node,
        teller,
        wheel_frames,
        joint_states,
    })
}

/// Whether the joints called left and right change places (`legacyMode`).
///
/// Until Kinetic the plugin turned its wheels the wrong way round, and robots named their joints the
/// wrong way round to make up for it. Since then `legacyMode` says which it is, and a missing one
/// means the old way, with an error in the log. Here a missing one means what makes the robot turn
/// left when told to: where the joints are decides.
fn swaps_sides(
    order: &Order<'_>,
    left: JointId,
    right: JointId,
    diagnostics: &mut Diagnostics,
) -> bool {
    if order.plugin.values.is_given("legacyMode") {
        return order.flag("legacyMode");
    }
    let Some(left_is_left) = is_left_of(order, left, right) else { return false };
    let wanted = !left_is_left;
    let message = format!(
        "plugin `{}` does not say `legacyMode`; taken as `{wanted}`, so that the robot turns left \
         when told to",
        order.site.plugin.name
    );
    let help =
        format!("write `<legacyMode>{wanted}</legacyMode>`: Gazebo takes it as true otherwise");
    diagnostics.push(Diagnostic::hint("legacy-mode", message).at(order.origin()).help(help));
    wanted
}

/// Whether the wheel of one joint stands to the left of the other's.
fn is_left_of(order: &Order<'_>, one: JointId, other: JointId) -> Option<bool> {
    let model_from_world =
        Body::of_model(order)?.state(order.setting.world)?.world_from_link.inverse();
    let y_m = |joint: JointId| {
        let name = order.setting.world.joint_name(joint)?;
        let child = periplus_scene::carrying_link(order.setting.root, name)?;
        let link = order.setting.world.find_link(order.setting.model, &child)?;
        let state = order.setting.world.link_state(link)?;
        Some((model_from_world * state.world_from_link).translation.y)
    };
    let apart_m = y_m(one)? - y_m(other)?;
    (apart_m.abs() > 1e-6).then_some(apart_m > 0.0)
}

/// `libgazebo_ros_skid_steer_drive.so` of ROS 1.
pub(super) fn skid_steer(
    order: &Order<'_>,
    node: Node,
    diagnostics: &mut Diagnostics,
) -> Option<Parts> {
    let names = ["leftFrontJoint", "rightFrontJoint", "leftRearJoint", "rightRearJoint"];
    let [left_front, right_front, left_rear, right_rear] =
        names.map(|name| order.joint(name, diagnostics));
    let pair = WheelPair {
        separation_m: order.number("wheelSeparation"),
        diameter_m: order.number("wheelDiameter"),
    };
    let drive =
        ClassicDiffDrive::skid_steer(pair, order.number("torque"), order.number("updateRate"));
    let mut teller = Teller::between(order.text("odometryFrame"), order.text("robotBaseFrame"));
    teller.pose_covariance = planar_covariance(
        order.number("covariance_x"),
        order.number("covariance_y"),
        order.number("covariance_yaw"),
    );
    teller.twist_covariance = teller.pose_covariance;
    teller = teller.on(order, &node, &order.text("odometryTopic"), diagnostics)?;
    if order.flag("broadcastTF") {
        teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
    }
    Some(Parts {
        pairs: vec![[left_front?, right_front?], [left_rear?, right_rear?]],
        drive,
        command_topic: order.text("commandTopic"),
        counts_wheels: false,
        node,
        teller,
        wheel_frames: None,
        joint_states: None,
    })
}
