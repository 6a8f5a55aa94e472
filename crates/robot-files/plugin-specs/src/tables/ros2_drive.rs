//! Drives of `gazebo_ros_pkgs`, branch `ros2`.

use periplus_params::{NamedEntity, Parameter, flag, integer, number, numbers, text};

use super::of_ros2;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const UPDATE_RATE: Parameter =
    number("update_rate", "Hz", "Steps of the controller per second; 0: each step.")
        .or("100")
        .min(0.0);

const ODOMETRY_FRAME: Parameter = text("odometry_frame", "Frame of the odometry.").or("odom");

const ROBOT_BASE_FRAME: Parameter = text("robot_base_frame", "Child frame of the odometry.")
    .or("base_footprint")
    .naming(NamedEntity::Frame);

const PUBLISH_ODOM: Parameter = flag("publish_odom", "If true, odometry is published.").or("false");

const PUBLISH_ODOM_TF: Parameter =
    flag("publish_odom_tf", "If true, the transform from odometry to base is published.")
        .or("false");

const PUBLISH_WHEEL_TF: Parameter =
    flag("publish_wheel_tf", "If true, the transforms of the wheels are published.").or("false");

const fn covariance(name: &'static str, unit: &'static str, default: &'static str) -> Parameter {
    number(name, unit, "Entry of the covariance of pose and velocity.").or(default).min(0.0)
}

const fn joint(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Joint)
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    of_ros2!(
        "gazebo_ros_diff_drive",
        Drive,
        Simulated,
        "Drives wheels on the left and on the right.",
        [
            integer("num_wheel_pairs", "Number of pairs of left and right wheels.")
                .or("1")
                .min(1.0),
            joint("left_joint", "The joint of a left wheel, once for each pair.")
                .required()
                .repeated(),
            joint("right_joint", "The joint of a right wheel, once for each pair.")
                .required()
                .repeated(),
            number("wheel_separation", "m", "Distance between the wheels of a pair.")
                .or("0.34")
                .above(0.0)
                .repeated(),
            number("wheel_diameter", "m", "Diameter of the wheels of a pair.")
                .or("0.15")
                .above(0.0)
                .repeated(),
            number("max_wheel_torque", "N m", "Maximum torque of a wheel.").or("5").min(0.0),
            number(
                "max_wheel_acceleration",
                "m/s^2",
                "Maximum acceleration at the rim; 0: unlimited.",
            )
            .or("0")
            .min(0.0),
            UPDATE_RATE,
            integer("odometry_source", "0 counts wheel turns, 1 is the true pose.")
                .or("1")
                .within(0.0, 1.0),
            ODOMETRY_FRAME,
            ROBOT_BASE_FRAME,
            PUBLISH_ODOM,
            PUBLISH_ODOM_TF,
            PUBLISH_WHEEL_TF,
            covariance("covariance_x", "m^2", "0.00001"),
            covariance("covariance_y", "m^2", "0.00001"),
            covariance("covariance_yaw", "rad^2", "0.001"),
        ]
    )
    .topics(&[listens("cmd_vel"), publishes("odom").when("publish_odom")]),
    of_ros2!(
        "gazebo_ros_planar_move",
        Drive,
        Simulated,
        "Moves the whole model in the plane, without wheels.",
        [
            number("update_rate", "Hz", "Steps of the controller per second; 0: each step.")
                .or("20")
                .min(0.0),
            number("publish_rate", "Hz", "Odometry messages per second; 0: one per step.")
                .or("20")
                .min(0.0),
            flag("publish_odom", "If true, odometry is published.").or("true"),
            flag("publish_odom_tf", "If true, the transform from odometry to base is published.")
                .or("true"),
            ODOMETRY_FRAME,
            ROBOT_BASE_FRAME,
            covariance("covariance_x", "m^2", "0.00001"),
            covariance("covariance_y", "m^2", "0.00001"),
            covariance("covariance_yaw", "rad^2", "0.001"),
        ]
    )
    .topics(&[listens("cmd_vel"), publishes("odom").when("publish_odom")]),
    of_ros2!(
        "gazebo_ros_ackermann_drive",
        Drive,
        Simulated,
        "Drives and steers a car.",
        [
            UPDATE_RATE,
            joint("front_left_joint", "Joint of the front left wheel.").or("front_left_joint"),
            joint("front_right_joint", "Joint of the front right wheel.").or("front_right_joint"),
            joint("rear_left_joint", "Joint of the rear left wheel.").or("rear_left_joint"),
            joint("rear_right_joint", "Joint of the rear right wheel.").or("rear_right_joint"),
            joint("left_steering_joint", "Steering joint of the left wheel.")
                .or("left_steering_joint"),
            joint("right_steering_joint", "Steering joint of the right wheel.")
                .or("right_steering_joint"),
            joint("steering_wheel_joint", "Joint of the steering wheel, if there is one."),
            number("max_steer", "rad", "Maximum steering angle of a wheel.").or("0.6").above(0.0),
            number("max_steering_angle", "rad", "Maximum angle of the steering wheel.")
                .or("7.85")
                .above(0.0),
            number("max_speed", "m/s", "Maximum speed.").or("20").above(0.0),
            numbers("left_steering_pid_gain", "", "Gains p i d.").or("0 0 0"),
            numbers("left_steering_i_range", "", "Minimum and maximum of the integral term.")
                .or("0 0"),
            numbers("right_steering_pid_gain", "", "Gains p i d.").or("0 0 0"),
            numbers("right_steering_i_range", "", "Minimum and maximum of the integral term.")
                .or("0 0"),
            numbers("linear_velocity_pid_gain", "", "Gains p i d.").or("0 0 0"),
            numbers("linear_velocity_i_range", "", "Minimum and maximum of the integral term.")
                .or("0 0"),
            PUBLISH_ODOM,
            PUBLISH_ODOM_TF,
            PUBLISH_WHEEL_TF,
            flag("publish_distance", "If true, the distance driven is published.").or("false"),
            ODOMETRY_FRAME,
            text("robot_base_frame", "Child frame of the odometry.")
                .or("base_link")
                .naming(NamedEntity::Frame),
            covariance("covariance_x", "m^2", "0.00001"),
            covariance("covariance_y", "m^2", "0.00001"),
            covariance("covariance_yaw", "rad^2", "0.001"),
        ]
    )
    .topics(&[
        listens("cmd_vel"),
        publishes("odom").when("publish_odom"),
        publishes("distance").when("publish_distance"),
    ]),
    of_ros2!(
        "gazebo_ros_tricycle_drive",
        Drive,
        Simulated,
        "Drives and steers the front wheel of a tricycle.",
        [
            UPDATE_RATE,
            joint("steering_joint", "Steering joint of the front wheel.")
                .or("front_steering_joint"),
            joint("actuated_wheel_joint", "Joint of the driven wheel.").or("actuated_wheel_joint"),
            joint("encoder_wheel_left_joint", "Joint of the left encoder wheel.")
                .or("encoder_left_wheel_joint"),
            joint("encoder_wheel_right_joint", "Joint of the right encoder wheel.")
                .or("encoder_right_wheel_joint"),
            number("wheel_separation", "m", "Distance between the encoder wheels.")
                .or("0.5")
                .above(0.0),
            number("encoder_wheel_diameter", "m", "Diameter of the encoder wheels.")
                .or("0.15")
                .above(0.0),
            number("actuated_wheel_diameter", "m", "Diameter of the driven wheel.")
                .or("0.15")
                .above(0.0),
            number("max_wheel_torque", "N m", "Maximum torque of a wheel.").min(0.0),
            number("max_wheel_acceleration", "m/s^2", "0 is without limit.").or("0").min(0.0),
            number("max_wheel_deceleration", "m/s^2", "Default: equal to the acceleration.")
                .min(0.0),
            number("max_wheel_speed_tolerance", "m/s", "Tolerance of the speed.")
                .or("0.01")
                .min(0.0),
            number("max_steering_speed", "rad/s", "0 is without limit.").or("0").min(0.0),
            number("max_steering_angle_tolerance", "rad", "Tolerance of the angle.")
                .or("0.01")
                .min(0.0),
            integer("odometry_source", "0 counts wheel turns, 1 is the true pose.")
                .or("1")
                .within(0.0, 1.0),
            PUBLISH_ODOM,
            PUBLISH_WHEEL_TF,
            flag("publish_wheel_joint_state", "If true, the wheels' joint states are published.")
                .or("false"),
            ODOMETRY_FRAME,
            text("robot_base_frame", "Child frame of the odometry.")
                .or("base_link")
                .naming(NamedEntity::Frame),
        ]
    )
    .topics(&[
        listens("cmd_vel"),
        publishes("odom").when("publish_odom"),
        publishes("joint_states").when("publish_wheel_joint_state"),
    ]),
];
