//! Settings of drives from their parameters.

use periplus_params::ParamValues;
use periplus_ros2_control::{
    ControlRelease, ControllerKind, DiffDriveController, DiffDriveGeometry, DiffDriveParams,
    DiffDriveRos1Params, DiffDriveSettings, MecanumController, MecanumGeometry, MecanumParams,
    MecanumSettings, SteeringController, SteeringGeometry, SteeringKind, SteeringParams,
    SteeringSettings, TricycleController, TricycleParams, TricycleSettings, limiter_of,
};

use super::drive::DriveTopics;
use super::odometry_output::OdometryTopics;
use crate::control::factory::KnownJoints;
use crate::control::ros_controller::ControllerNode;

/// Rate of a publisher that publishes in each update.
const EACH_UPDATE_HZ: f64 = 0.0;

/// `diff_drive_controller` of ROS 2.
pub(super) fn diff_drive(
    part: &ControllerNode,
    _: &KnownJoints,
) -> Result<(DiffDriveController, DriveTopics), String> {
    let values = part.values();
    let params = DiffDriveParams::from_values(&values);
    let radius_m = params.wheel_radius_m;
    let settings = DiffDriveSettings {
        left_joints: params.left_wheel_names.clone(),
        right_joints: params.right_wheel_names.clone(),
        geometry: DiffDriveGeometry {
            separation_m: params.wheel_separation_m * params.wheel_separation_multiplier,
            left_radius_m: radius_m * params.left_wheel_radius_multiplier,
            right_radius_m: radius_m * params.right_wheel_radius_multiplier,
        },
        open_loop: params.open_loop,
        position_feedback: params.position_feedback,
        velocity_window: params.velocity_rolling_window_size,
        timeout_s: params.cmd_vel_timeout_s,
        linear: limiter_of(&values, "linear.x", part.release),
        angular: limiter_of(&values, "angular.z", part.release),
    };
    let frame =
        |frame: &str| part.frame(frame, &params.tf_frame_prefix, params.tf_frame_prefix_enable);
    let mut topics = DriveTopics {
        stamped: Some("~/cmd_vel"),
        plain: None,
        limited: params.publish_limited_velocity.then_some("~/cmd_vel_out"),
        reset: None,
        odometry: OdometryTopics {
            odometry: "~/odom",
            tf: params.enable_odom_tf.then_some("/tf"),
            odom_frame: frame(&params.odom_frame_id),
            base_frame: frame(&params.base_frame_id),
            pose_variances: params.pose_covariance_diagonal,
            twist_variances: params.twist_covariance_diagonal,
            rate_hz: params.publish_rate_hz,
            has_pose: true,
        },
        notes: Vec::new(),
    };
    if part.release <= ControlRelease::Humble && !params.use_stamped_vel {
        (topics.stamped, topics.plain) = (None, Some("~/cmd_vel_unstamped"));
    } else if values.is_given("use_stamped_vel") && !params.use_stamped_vel {
        topics.plain = Some("~/cmd_vel_unstamped");
        topics.notes.push(
            "`use_stamped_vel: false` has no effect since Jazzy: `~/cmd_vel` is a TwistStamped. \
             Twist is received on `~/cmd_vel_unstamped`, as in Humble"
                .into(),
        );
    }
    Ok((DiffDriveController::new(settings), topics))
}

/// `diff_drive_controller` of ROS 1.
pub(super) fn diff_drive_ros1(
    part: &ControllerNode,
    joints: &KnownJoints,
) -> Result<(DiffDriveController, DriveTopics), String> {
    let values = part.values();
    let params = DiffDriveRos1Params::from_values(&values);
    let first = |names: &[String]| names.first().and_then(|name| joints.get(name)).copied();
    let (left, right) = (first(&params.left_wheel), first(&params.right_wheel));
    let measured_m = left.zip(right).map(|(left, right)| (left.at_m - right.at_m).length());
    let separation_m = params.wheel_separation_m.or(measured_m).ok_or(
        "`wheel_separation` is not set, and the wheels `left_wheel` and `right_wheel` are not in \
         the robot's description",
    )?;
    let measured_m = left.and_then(|left| left.wheel_radius_m);
    let radius_m = params.wheel_radius_m.or(measured_m).ok_or(
        "`wheel_radius` is not set, and the link of `left_wheel` has no cylinder or sphere",
    )?;
    let both = params.wheel_radius_multiplier;
    let settings = DiffDriveSettings {
        left_joints: params.left_wheel.clone(),
        right_joints: params.right_wheel.clone(),
        geometry: DiffDriveGeometry {
            separation_m: separation_m * params.wheel_separation_multiplier,
            left_radius_m: radius_m * params.left_wheel_radius_multiplier.unwrap_or(both),
            right_radius_m: radius_m * params.right_wheel_radius_multiplier.unwrap_or(both),
        },
        open_loop: params.open_loop,
        position_feedback: true,
        velocity_window: params.velocity_rolling_window_size,
        timeout_s: params.cmd_vel_timeout_s,
        linear: limiter_of(&values, "linear.x", part.release),
        angular: limiter_of(&values, "angular.z", part.release),
    };
    let topics = DriveTopics {
        stamped: None,
        plain: Some("~/cmd_vel"),
        limited: params.publish_cmd.then_some("~/cmd_vel_out"),
        reset: None,
        odometry: OdometryTopics {
            odometry: "~/odom",
            tf: params.enable_odom_tf.then_some("/tf"),
            odom_frame: params.odom_frame_id,
            base_frame: params.base_frame_id,
            pose_variances: params.pose_covariance_diagonal,
            twist_variances: params.twist_covariance_diagonal,
            rate_hz: params.publish_rate_hz,
            has_pose: true,
        },
        notes: Vec::new(),
    };
    Ok((DiffDriveController::new(settings), topics))
}

/// `ackermann_steering_controller`, `bicycle_steering_controller` and `tricycle_steering_controller`.
pub(super) fn steering(
    part: &ControllerNode,
    _: &KnownJoints,
) -> Result<(SteeringController, DriveTopics), String> {
    let params = SteeringParams::from_values(&part.values());
    let kind = match part.kind {
        ControllerKind::BicycleSteering => SteeringKind::Bicycle,
        ControllerKind::TricycleSteering => SteeringKind::Tricycle,
        _ => SteeringKind::Ackermann,
    };
    let settings = steering_settings(kind, &params);
    let is_stamped =
        part.release > ControlRelease::Humble || params.use_stamped_vel.unwrap_or(false);
    let prefix = &params.tf_frame_prefix;
    let frame = |frame: &str| part.frame(frame, prefix, !prefix.is_empty());
    let topics = DriveTopics {
        stamped: is_stamped.then_some("~/reference"),
        plain: (!is_stamped).then_some("~/reference_unstamped"),
        limited: None,
        reset: None,
        odometry: OdometryTopics {
            odometry: "~/odometry",
            tf: params.enable_odom_tf.then_some("~/tf_odometry"),
            odom_frame: frame(&params.odom_frame_id),
            base_frame: frame(&params.base_frame_id),
            pose_variances: params.pose_covariance_diagonal,
            twist_variances: params.twist_covariance_diagonal,
            rate_hz: EACH_UPDATE_HZ,
            has_pose: true,
        },
        notes: Vec::new(),
    };
    Ok((SteeringController::new(settings), topics))
}

/// Reads the names of both generations: driven and steered wheels, or front and rear ones.
fn steering_settings(kind: SteeringKind, params: &SteeringParams) -> SteeringSettings {
    fn either<T: Clone>(is_front: bool, front: &T, rear: &T) -> T {
        if is_front { front.clone() } else { rear.clone() }
    }
    fn or(names: &[String], older: Vec<String>) -> Vec<String> {
        if names.is_empty() { older } else { names.to_vec() }
    }
    let is_steered_in_front = params.front_steering;
    let (front, rear) = (&params.front_wheels_names, &params.rear_wheels_names);
    let (front_states, rear_states) =
        (&params.front_wheels_state_names, &params.rear_wheels_state_names);
    let number = |newer: f64, older: f64| if newer > 0.0 { newer } else { older };
    let (front_radius_m, rear_radius_m) =
        (params.front_wheels_radius_m, params.rear_wheels_radius_m);
    let (front_track_m, rear_track_m) = (params.front_wheel_track_m, params.rear_wheel_track_m);
    // Before Jazzy one track, that of the driven wheels, was used for both axles.
    let older_track_m = either(is_steered_in_front, &rear_track_m, &front_track_m);
    let traction_track_m = number(params.traction_track_width_m, older_track_m);
    SteeringSettings {
        geometry: SteeringGeometry {
            kind,
            wheelbase_m: params.wheelbase_m,
            traction_radius_m: number(
                params.traction_wheels_radius_m,
                either(is_steered_in_front, &rear_radius_m, &front_radius_m),
            ),
            traction_track_m,
            steering_track_m: number(params.steering_track_width_m, traction_track_m),
        },
        traction_joints: or(
            &params.traction_joints_names,
            either(is_steered_in_front, rear, front),
        ),
        steering_joints: or(
            &params.steering_joints_names,
            either(is_steered_in_front, front, rear),
        ),
        traction_states: or(
            &params.traction_joints_state_names,
            either(is_steered_in_front, rear_states, front_states),
        ),
        steering_states: or(
            &params.steering_joints_state_names,
            either(is_steered_in_front, front_states, rear_states),
        ),
        open_loop: params.open_loop,
        position_feedback: params.position_feedback,
        slows_until_steered: params.reduce_wheel_speed_until_steering_reached,
        velocity_window: params.velocity_rolling_window_size,
        timeout_s: params.reference_timeout_s,
    }
}

/// `tricycle_controller`.
pub(super) fn tricycle(
    part: &ControllerNode,
    _: &KnownJoints,
) -> Result<(TricycleController, DriveTopics), String> {
    let values = part.values();
    let params = TricycleParams::from_values(&values);
    let sizes = |name: &str| size_range(&values, name);
    let settings = TricycleSettings {
        traction_joint: params.traction_joint_name.clone(),
        steering_joint: params.steering_joint_name.clone(),
        wheelbase_m: params.wheelbase_m,
        radius_m: params.wheel_radius_m,
        open_loop: params.open_loop,
        velocity_window: params.velocity_rolling_window_size,
        timeout_s: params.cmd_vel_timeout_ms as f64 * 1e-3,
        traction_velocity: sizes("traction.{}_velocity"),
        traction_acceleration: sizes("traction.{}_acceleration"),
        traction_deceleration: sizes("traction.{}_deceleration"),
        traction_jerk: sizes("traction.{}_jerk"),
        steering_position: params
            .steering_max_position
            .filter(|max| max.is_finite())
            .map(|max| [params.steering_min_position.unwrap_or(-max), max]),
        steering_velocity: sizes("steering.{}_velocity"),
        steering_acceleration: sizes("steering.{}_acceleration"),
    };
    let is_stamped = part.release > ControlRelease::Humble || params.use_stamped_vel;
    let mut notes = Vec::new();
    if params.publish_ackermann_command {
        notes.push(
            "`publish_ackermann_command` has no effect: `ackermann_msgs` is not built in".into(),
        );
    }
    let topics = DriveTopics {
        stamped: is_stamped.then_some("~/cmd_vel"),
        plain: (!is_stamped).then_some("~/cmd_vel"),
        limited: None,
        reset: Some("~/reset_odometry"),
        odometry: OdometryTopics {
            odometry: "~/odom",
            tf: params.enable_odom_tf.then_some("/tf"),
            odom_frame: params.odom_frame_id,
            base_frame: params.base_frame_id,
            pose_variances: params.pose_covariance_diagonal,
            twist_variances: params.twist_covariance_diagonal,
            rate_hz: EACH_UPDATE_HZ,
            has_pose: !params.odom_only_twist,
        },
        notes,
    };
    Ok((TricycleController::new(settings), topics))
}

/// Returns the range of a size; `{}` in the name is replaced by `min` and `max`. A missing minimum is
/// zero, and a missing maximum is 1000.
fn size_range(values: &ParamValues, name: &str) -> Option<[f64; 2]> {
    let bound =
        |which: &str| values.number(&name.replace("{}", which)).filter(|number| number.is_finite());
    match (bound("min"), bound("max")) {
        (None, None) => None,
        (min, max) => Some([min.unwrap_or(0.0), max.unwrap_or(1000.0)]),
    }
}

/// `mecanum_drive_controller`.
pub(super) fn mecanum(
    part: &ControllerNode,
    _: &KnownJoints,
) -> Result<(MecanumController, DriveTopics), String> {
    let values = part.values();
    let params = MecanumParams::from_values(&values);
    let joints = [
        params.front_left_wheel_command_joint_name.clone(),
        params.front_right_wheel_command_joint_name.clone(),
        params.rear_right_wheel_command_joint_name.clone(),
        params.rear_left_wheel_command_joint_name.clone(),
    ];
    let states = [
        &params.front_left_wheel_state_joint_name,
        &params.front_right_wheel_state_joint_name,
        &params.rear_right_wheel_state_joint_name,
        &params.rear_left_wheel_state_joint_name,
    ];
    let settings = MecanumSettings {
        state_joints: std::array::from_fn(|wheel| {
            if states[wheel].is_empty() { joints[wheel].clone() } else { states[wheel].clone() }
        }),
        joints,
        geometry: MecanumGeometry {
            radius_m: params.wheels_radius_m,
            sum_of_projections_m: params.sum_of_projections_m,
            centre_from_base: [
                params.base_frame_offset_x_m,
                params.base_frame_offset_y_m,
                params.base_frame_offset_theta_rad,
            ],
        },
        timeout_s: params.reference_timeout_s,
        limiters: ["linear.x", "linear.y", "angular.z"]
            .map(|prefix| limiter_of(&values, prefix, part.release)),
    };
    let is_stamped = part.release > ControlRelease::Humble || params.use_stamped_vel;
    let is_prefixed = part.release > ControlRelease::Humble && params.tf_frame_prefix_enable;
    let frame = |frame: &str| part.frame(frame, &params.tf_frame_prefix, is_prefixed);
    let topics = DriveTopics {
        stamped: is_stamped.then_some("~/reference"),
        plain: (!is_stamped).then_some("~/reference_unstamped"),
        limited: None,
        reset: None,
        odometry: OdometryTopics {
            odometry: "~/odometry",
            tf: params.enable_odom_tf.then_some("~/tf_odometry"),
            odom_frame: frame(&params.odom_frame_id),
            base_frame: frame(&params.base_frame_id),
            pose_variances: params.pose_covariance_diagonal,
            twist_variances: params.twist_covariance_diagonal,
            rate_hz: EACH_UPDATE_HZ,
            has_pose: true,
        },
        notes: Vec::new(),
    };
    Ok((MecanumController::new(settings), topics))
}
