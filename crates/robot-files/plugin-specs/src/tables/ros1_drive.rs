//! Drives of `gazebo_ros_pkgs`, branch `noetic-devel`.

use periplus_params::{NamedEntity, Parameter, choice, flag, number, text};

use super::of_ros1;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const UPDATE_RATE: Parameter =
    number("updateRate", "Hz", "Steps of the controller per second; 0: each step.")
        .or("100")
        .min(0.0);

const COMMAND_TOPIC: Parameter =
    text("commandTopic", "Topic of velocity commands.").or("cmd_vel").naming(NamedEntity::Topic);

const ODOMETRY_TOPIC: Parameter =
    text("odometryTopic", "Topic of the odometry.").or("odom").naming(NamedEntity::Topic);

const ODOMETRY_FRAME: Parameter = text("odometryFrame", "Frame of the odometry.").or("odom");

const ODOMETRY_SOURCE: Parameter =
    choice("odometrySource", &["encoder", "world"], "Wheel turns, or the true pose.").or("world");

const ROBOT_BASE_FRAME: Parameter = text("robotBaseFrame", "Child frame of the odometry.")
    .or("base_footprint")
    .naming(NamedEntity::Frame);

const ROS_DEBUG_LEVEL: Parameter = text("rosDebugLevel", "Verbosity of the log.").or("na");

const PUBLISH_WHEEL_TF: Parameter =
    flag("publishWheelTF", "If true, the transforms of the wheels are published.").or("false");

const PUBLISH_WHEEL_JOINT_STATE: Parameter =
    flag("publishWheelJointState", "If true, the wheels' joint states are published.").or("false");

const fn joint(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Joint)
}

const fn covariance(name: &'static str, unit: &'static str, default: &'static str) -> Parameter {
    number(name, unit, "Entry of the covariance of pose and velocity.").or(default).min(0.0)
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    of_ros1!(
        "gazebo_ros_diff_drive",
        Drive,
        Simulated,
        "Drives a wheel on the left and one on the right.",
        [
            joint("leftJoint", "The joint of the left wheel.").or("left_joint"),
            joint("rightJoint", "The joint of the right wheel.").or("right_joint"),
            number("wheelSeparation", "m", "Distance between the wheels.").or("0.34").above(0.0),
            number("wheelDiameter", "m", "Diameter of the wheels.").or("0.15").above(0.0),
            number("wheelTorque", "N m", "Maximum torque of a wheel.").or("5").min(0.0),
            number("wheelAcceleration", "m/s^2", "Maximum acceleration at the rim; 0: unlimited.",)
                .or("0")
                .min(0.0),
            UPDATE_RATE,
            COMMAND_TOPIC,
            ODOMETRY_TOPIC,
            ODOMETRY_FRAME,
            ODOMETRY_SOURCE,
            ROBOT_BASE_FRAME,
            PUBLISH_WHEEL_TF,
            PUBLISH_WHEEL_JOINT_STATE,
            flag("publishOdomTF", "If true, the transform from odometry to base is published.")
                .or("true"),
            flag("publishTf", "If true, transforms are published at all.").or("true"),
            flag("legacyMode", "If true, left and right are swapped, as before Indigo."),
            ROS_DEBUG_LEVEL,
        ]
    )
    .topics(&[
        listens("cmd_vel").set_by("commandTopic"),
        publishes("odom").set_by("odometryTopic"),
        publishes("joint_states").when("publishWheelJointState"),
    ]),
    of_ros1!(
        "gazebo_ros_skid_steer_drive",
        Drive,
        Simulated,
        "Drives two wheels on the left and two on the right.",
        [
            joint("leftFrontJoint", "The joint of the wheel.").or("left_front_joint"),
            joint("rightFrontJoint", "The joint of the wheel.").or("right_front_joint"),
            joint("leftRearJoint", "The joint of the wheel.").or("left_rear_joint"),
            joint("rightRearJoint", "The joint of the wheel.").or("right_rear_joint"),
            number("wheelSeparation", "m", "Distance between the wheels.").or("0.4").above(0.0),
            number("wheelDiameter", "m", "Diameter of the wheels.").or("0.15").above(0.0),
            number("torque", "N m", "Maximum torque of a wheel.").or("5").min(0.0),
            UPDATE_RATE,
            COMMAND_TOPIC,
            ODOMETRY_TOPIC,
            ODOMETRY_FRAME,
            ROBOT_BASE_FRAME,
            flag("broadcastTF", "If true, the transform from odometry to base is published.")
                .or("false"),
            covariance("covariance_x", "m^2", "0.0001"),
            covariance("covariance_y", "m^2", "0.0001"),
            covariance("covariance_yaw", "rad^2", "0.01"),
        ]
    )
    .topics(&[
        listens("cmd_vel").set_by("commandTopic"),
        publishes("odom").set_by("odometryTopic"),
    ]),
    of_ros1!(
        "gazebo_ros_planar_move",
        Drive,
        Simulated,
        "Moves the whole model in the plane, without wheels.",
        [
            COMMAND_TOPIC,
            ODOMETRY_TOPIC,
            ODOMETRY_FRAME,
            ROBOT_BASE_FRAME,
            number("odometryRate", "Hz", "Odometry messages per second.").or("20").min(0.0),
            number("cmdTimeout", "s", "Timeout of commands; negative: never.").or("-1"),
            flag("publishOdometry", "If true, odometry is published.").or("true"),
            flag("publishTF", "If true, the transform from odometry to base is published.")
                .or("true"),
        ]
    )
    .topics(&[
        listens("cmd_vel").set_by("commandTopic"),
        publishes("odom").set_by("odometryTopic"),
    ]),
    of_ros1!(
        "gazebo_ros_tricycle_drive",
        Drive,
        Simulated,
        "Drives and steers the front wheel of a tricycle.",
        [
            joint("steeringJoint", "Steering joint of the front wheel.").or("front_steering_joint"),
            joint("actuatedWheelJoint", "Joint of the driven wheel.").or("actuated_wheel_joint"),
            joint("encoderWheelLeftJoint", "Joint of the left encoder wheel.")
                .or("encoder_left_wheel_joint"),
            joint("encoderWheelRightJoint", "Joint of the right encoder wheel.")
                .or("encoder_right_wheel_joint"),
            number("actuatedWheelDiameter", "m", "Diameter of the driven wheel.")
                .or("0.15")
                .above(0.0),
            number("encoderWheelDiameter", "m", "Diameter of the encoder wheels.")
                .or("0.15")
                .above(0.0),
            number("encoderWheelSeparation", "m", "Distance between the encoder wheels.")
                .or("0.5")
                .above(0.0),
            number("wheelAcceleration", "m/s^2", "0 is without limit.").or("0").min(0.0),
            number("wheelDeceleration", "m/s^2", "Default: equal to the acceleration.").min(0.0),
            number("wheelSpeedTolerance", "m/s", "Tolerance of the speed.").or("0.01").min(0.0),
            number("wheelTorque", "N m", "Maximum torque of a wheel.").or("5").min(0.0),
            number("steeringSpeed", "rad/s", "0 is without limit.").or("0").min(0.0),
            number("steeringAngleTolerance", "rad", "Tolerance of the angle.").or("0.01").min(0.0),
            UPDATE_RATE,
            COMMAND_TOPIC,
            ODOMETRY_TOPIC,
            ODOMETRY_FRAME,
            ODOMETRY_SOURCE,
            ROBOT_BASE_FRAME,
            PUBLISH_WHEEL_TF,
            PUBLISH_WHEEL_JOINT_STATE,
            ROS_DEBUG_LEVEL,
        ]
    )
    .topics(&[
        listens("cmd_vel").set_by("commandTopic"),
        publishes("odom").set_by("odometryTopic"),
        publishes("joint_states").when("publishWheelJointState"),
    ]),
];
