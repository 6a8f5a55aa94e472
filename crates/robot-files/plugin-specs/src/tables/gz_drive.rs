//! Drives and joint controllers of current Gazebo.

use periplus_params::{
    NamedEntity, Parameter, choice, flag, group, integer, number, numbers, text,
};

use super::system;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const fn joint(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Joint)
}

const fn wheels(name: &'static str, doc: &'static str) -> Parameter {
    joint(name, doc).required().repeated()
}

const TOPIC: Parameter = text("topic", "Topic of commands.").naming(NamedEntity::Topic);

const SUB_TOPIC: Parameter = text("sub_topic", "Topic of commands below `/model/<name>/`.");

const ODOM_TOPIC: Parameter =
    text("odom_topic", "Topic of the odometry.").naming(NamedEntity::Topic);

const TF_TOPIC: Parameter =
    text("tf_topic", "Topic of the transform from odometry to base.").naming(NamedEntity::Topic);

const FRAME_ID: Parameter = text("frame_id", "Frame of the odometry (default: `<model>/odom`).");

const CHILD_FRAME_ID: Parameter =
    text("child_frame_id", "Child frame of the odometry (default: `<model>/<link>`).");

const ODOM_FREQUENCY: Parameter =
    number("odom_publish_frequency", "Hz", "Odometry messages per second; 0: one per step.")
        .or("50")
        .min(0.0);

const WHEEL_SEPARATION: Parameter =
    number("wheel_separation", "m", "Distance between left and right wheels.").or("1").above(0.0);

const WHEEL_RADIUS: Parameter =
    number("wheel_radius", "m", "Radius of the wheels.").or("0.2").above(0.0);

const fn limit(name: &'static str, unit: &'static str) -> Parameter {
    number(name, unit, "Limit of commands (default: none).")
}

/// Gains of a joint controller, with the defaults of Gazebo.
const fn gain(name: &'static str, default: &'static str) -> Parameter {
    number(name, "", "Gain of the controller.").or(default)
}

const JOINT_INDEX: Parameter = integer("joint_index", "Axis of the joint.").or("0").min(0.0);

const USE_ACTUATOR_MSG: Parameter =
    flag("use_actuator_msg", "If true, commands are `Actuators` messages.").or("false");

const ACTUATOR_NUMBER: Parameter =
    integer("actuator_number", "Index in an `Actuators` message.").min(0.0);

const DRIVE_TOPICS: &[crate::PluginTopic] = &[
    listens("/model/{model}/cmd_vel").set_by("topic"),
    publishes("/model/{model}/odometry").set_by("odom_topic"),
    publishes("/model/{model}/tf").set_by("tf_topic"),
];

pub(super) static PLUGINS: &[PluginSpec] = &[
    system!(
        "gz-sim-diff-drive-system",
        ["DiffDrive"],
        Drive,
        Simulated,
        "Drives wheels on the left and on the right.",
        [
            wheels("left_joint", "The joint of a left wheel."),
            wheels("right_joint", "The joint of a right wheel."),
            WHEEL_SEPARATION,
            WHEEL_RADIUS,
            ODOM_FREQUENCY,
            TOPIC,
            ODOM_TOPIC,
            TF_TOPIC,
            FRAME_ID,
            CHILD_FRAME_ID,
            limit("min_velocity", "m/s"),
            limit("max_velocity", "m/s"),
            limit("min_acceleration", "m/s^2"),
            limit("max_acceleration", "m/s^2"),
            limit("min_jerk", "m/s^3"),
            limit("max_jerk", "m/s^3"),
            limit("min_linear_velocity", "m/s"),
            limit("max_linear_velocity", "m/s"),
            limit("min_angular_velocity", "rad/s"),
            limit("max_angular_velocity", "rad/s"),
            limit("min_linear_acceleration", "m/s^2"),
            limit("max_linear_acceleration", "m/s^2"),
            limit("min_angular_acceleration", "rad/s^2"),
            limit("max_angular_acceleration", "rad/s^2"),
            limit("min_linear_jerk", "m/s^3"),
            limit("max_linear_jerk", "m/s^3"),
            limit("min_angular_jerk", "rad/s^3"),
            limit("max_angular_jerk", "rad/s^3"),
        ]
    )
    .topics(DRIVE_TOPICS),
    system!(
        "gz-sim-mecanum-drive-system",
        ["MecanumDrive"],
        Drive,
        Simulated,
        "Drives four wheels with slanted rollers.",
        [
            wheels("front_left_joint", "The joint of a front left wheel."),
            wheels("front_right_joint", "The joint of a front right wheel."),
            wheels("back_left_joint", "The joint of a back left wheel."),
            wheels("back_right_joint", "The joint of a back right wheel."),
            number("wheelbase", "m", "Distance between front and back wheels.").or("1").above(0.0),
            WHEEL_SEPARATION,
            WHEEL_RADIUS,
            ODOM_FREQUENCY,
            TOPIC,
            ODOM_TOPIC,
            TF_TOPIC,
            FRAME_ID,
            CHILD_FRAME_ID,
            limit("min_velocity", "m/s"),
            limit("max_velocity", "m/s"),
            limit("min_acceleration", "m/s^2"),
            limit("max_acceleration", "m/s^2"),
            limit("min_jerk", "m/s^3"),
            limit("max_jerk", "m/s^3"),
            limit("min_linear_velocity", "m/s"),
            limit("max_linear_velocity", "m/s"),
            limit("min_angular_velocity", "rad/s"),
            limit("max_angular_velocity", "rad/s"),
            limit("min_linear_acceleration", "m/s^2"),
            limit("max_linear_acceleration", "m/s^2"),
            limit("min_angular_acceleration", "rad/s^2"),
            limit("max_angular_acceleration", "rad/s^2"),
            limit("min_linear_jerk", "m/s^3"),
            limit("max_linear_jerk", "m/s^3"),
            limit("min_angular_jerk", "rad/s^3"),
            limit("max_angular_jerk", "rad/s^3"),
        ]
    )
    .topics(DRIVE_TOPICS),
    system!(
        "gz-sim-ackermann-steering-system",
        ["AckermannSteering"],
        Drive,
        Simulated,
        "Drives and steers a car.",
        [
            wheels("left_joint", "The joint of a left wheel.").unless("steering_only"),
            wheels("right_joint", "The joint of a right wheel.").unless("steering_only"),
            joint("left_steering_joint", "Steering joint of the left wheel.").required(),
            joint("right_steering_joint", "Steering joint of the right wheel.").required(),
            WHEEL_SEPARATION,
            number("kingpin_width", "m", "Distance between the steering axes.")
                .or("0.8")
                .above(0.0),
            number("wheel_base", "m", "Distance between front and back wheels.").or("1").above(0.0),
            number("steering_limit", "rad", "Maximum steering angle of a wheel.")
                .or("0.5")
                .above(0.0),
            WHEEL_RADIUS,
            number("steer_p_gain", "1/s", "Proportional gain from angle error to steering speed.")
                .or("1"),
            flag("steering_only", "If true, commands are steering angles.").or("false"),
            USE_ACTUATOR_MSG,
            ACTUATOR_NUMBER,
            ODOM_FREQUENCY,
            TOPIC,
            SUB_TOPIC,
            ODOM_TOPIC,
            TF_TOPIC,
            FRAME_ID,
            CHILD_FRAME_ID,
            limit("min_velocity", "m/s"),
            limit("max_velocity", "m/s"),
            limit("min_acceleration", "m/s^2"),
            limit("max_acceleration", "m/s^2"),
            limit("min_jerk", "m/s^3"),
            limit("max_jerk", "m/s^3"),
        ]
    )
    .topics(DRIVE_TOPICS),
    system!(
        "gz-sim-velocity-control-system",
        ["VelocityControl"],
        Drive,
        Simulated,
        "Sets the velocity of a model or of links.",
        [
            TOPIC,
            numbers("initial_linear", "m/s", "Velocity at the start.").or("0 0 0"),
            numbers("initial_angular", "rad/s", "Velocity at the start.").or("0 0 0"),
            text("link_name", "A link with its own topic.").repeated().naming(NamedEntity::Link),
        ]
    )
    .topics(&[listens("/model/{model}/cmd_vel").set_by("topic")]),
    system!(
        "gz-sim-tracked-vehicle-system",
        ["TrackedVehicle"],
        Drive,
        Kept,
        "Drives tracks on the left and on the right.",
        [
            group("left_track", "Link and settings of a left track.").repeated(),
            group("right_track", "Link and settings of a right track.").repeated(),
            number("tracks_separation", "m", "Distance between the tracks.").or("1").above(0.0),
            number("track_height", "m", "Height of the tracks.").or("0.2").above(0.0),
            number("steering_efficiency", "", "Fraction of a commanded turn that is executed.")
                .or("0.5")
                .within(0.0, 1.0),
            flag("debug", "If true, it draws its activity.").or("false"),
            group("linear_velocity", "Limits."),
            group("angular_velocity", "Limits."),
            ODOM_FREQUENCY,
            TOPIC,
            text("steering_efficiency_topic", "Topic of the efficiency.")
                .naming(NamedEntity::Topic),
            ODOM_TOPIC,
            TF_TOPIC,
            FRAME_ID,
            CHILD_FRAME_ID,
        ]
    )
    .topics(DRIVE_TOPICS),
    system!(
        "gz-sim-track-controller-system",
        ["TrackController"],
        Drive,
        Kept,
        "Moves the surface of a track or conveyor.",
        [
            text("link", "The link.").required().naming(NamedEntity::Link),
            flag("debug", "If true, it draws its activity.").or("false"),
            numbers("track_orientation", "rad", "Orientation of the track on the link.")
                .or("0 0 0"),
            text("velocity_topic", "Topic of speeds.").naming(NamedEntity::Topic),
            text("center_of_rotation_topic", "Topic of the centers of rotation.")
                .naming(NamedEntity::Topic),
            text("odometry_topic", "Topic of the distance run.").naming(NamedEntity::Topic),
            number("odometry_publish_frequency", "Hz", "Odometry messages per second.")
                .or("50")
                .min(0.0),
            limit("min_velocity", "m/s"),
            limit("max_velocity", "m/s"),
            limit("min_acceleration", "m/s^2"),
            limit("max_acceleration", "m/s^2"),
            limit("min_jerk", "m/s^3"),
            limit("max_jerk", "m/s^3"),
            number("max_command_age", "s", "Timeout of commands; 0: never.").or("0").min(0.0),
        ]
    ),
    system!(
        "gz-sim-joint-position-controller-system",
        ["JointPositionController"],
        Control,
        Simulated,
        "Moves a joint to a position.",
        [
            joint("joint_name", "The joint.").required().repeated(),
            JOINT_INDEX,
            USE_ACTUATOR_MSG,
            ACTUATOR_NUMBER.also(&["actuatorNumber"]),
            gain("p_gain", "1"),
            gain("i_gain", "0.1"),
            gain("d_gain", "0.01"),
            gain("i_max", "1"),
            gain("i_min", "-1"),
            gain("cmd_max", "1000"),
            gain("cmd_min", "-1000"),
            gain("cmd_offset", "0"),
            flag("use_velocity_commands", "If true, it moves without gains.").or("false"),
            TOPIC,
            SUB_TOPIC,
            number("initial_position", "rad", "Position at the start.").or("0"),
        ]
    )
    .topics(&[listens("/model/{model}/joint/{joint_name}/0/cmd_pos").set_by("topic")]),
    system!(
        "gz-sim-joint-controller-system",
        ["JointController"],
        Control,
        Simulated,
        "Turns a joint at a velocity.",
        [
            joint("joint_name", "The joint.").required().repeated(),
            JOINT_INDEX,
            flag("use_force_commands", "If true, it uses forces and gains.").or("false"),
            USE_ACTUATOR_MSG,
            ACTUATOR_NUMBER.also(&["actuatorNumber"]),
            TOPIC,
            SUB_TOPIC,
            number("initial_velocity", "rad/s", "Velocity at the start.").or("0"),
            gain("p_gain", "1"),
            gain("i_gain", "0"),
            gain("d_gain", "0"),
            gain("i_max", "1"),
            gain("i_min", "-1"),
            gain("cmd_max", "1000"),
            gain("cmd_min", "-1000"),
            gain("cmd_offset", "0"),
            flag("disable_braking", "If true, it never slows the joint.").or("false"),
        ]
    )
    .topics(&[listens("/model/{model}/joint/{joint_name}/cmd_vel").set_by("topic")]),
    system!(
        "gz-sim-joint-trajectory-controller-system",
        ["JointTrajectoryController"],
        Control,
        Simulated,
        "Moves joints along a trajectory.",
        [
            TOPIC,
            flag("use_header_start_time", "If true, it starts at the time of the message.")
                .or("false"),
            joint("joint_name", "A joint (default: all with one axis).").repeated(),
            number("initial_position", "rad", "Position at the start.").repeated(),
            gain("position_p_gain", "0").repeated(),
            gain("position_i_gain", "0").repeated(),
            gain("position_d_gain", "0").repeated(),
            gain("position_i_min", "0").repeated(),
            gain("position_i_max", "-1").repeated(),
            gain("position_cmd_min", "0").repeated(),
            gain("position_cmd_max", "-1").repeated(),
            gain("position_cmd_offset", "0").repeated(),
            gain("velocity_p_gain", "0").repeated(),
            gain("velocity_i_gain", "0").repeated(),
            gain("velocity_d_gain", "0").repeated(),
            gain("velocity_i_min", "0").repeated(),
            gain("velocity_i_max", "-1").repeated(),
            gain("velocity_cmd_min", "0").repeated(),
            gain("velocity_cmd_max", "-1").repeated(),
            gain("velocity_cmd_offset", "0").repeated(),
        ]
    )
    .topics(&[listens("/model/{model}/joint_trajectory").set_by("topic")]),
    system!(
        "gz-sim-apply-joint-force-system",
        ["ApplyJointForce"],
        Control,
        Kept,
        "Applies a force to a joint.",
        [joint("joint_name", "The joint.").required()]
    )
    .topics(&[listens("/model/{model}/joint/{joint_name}/cmd_force")]),
    system!(
        "gz_ros2_control-system",
        ["GazeboSimROS2ControlPlugin", "IgnitionROS2ControlPlugin"],
        Control,
        Simulated,
        "Runs ros2_control on the model's joints.",
        [
            text("parameters", "Path of a parameter file.").repeated(),
            group("ros", "Namespace and remappings of the controller manager."),
            text("robot_param", "Parameter that holds the robot description.")
                .or("robot_description"),
            text("robot_param_node", "Node with that parameter.").or("robot_state_publisher"),
            text("controller_manager_name", "Name of the controller manager's node.")
                .or("controller_manager"),
            flag("hold_joints", "If true, joints hold their position without a command.")
                .or("true"),
            number(
                "position_proportional_gain",
                "1/s",
                "Proportional gain from position error to speed."
            )
            .or("0.1"),
            text("controller_manager_prefix_node_name", "Prefix of the node's name."),
        ]
    ),
    system!(
        "gz-sim-multicopter-control-system",
        ["MulticopterVelocityControl"],
        Control,
        Kept,
        "Flies a multicopter at a velocity.",
        [
            text("robotNamespace", "Prefix of every topic."),
            text("commandSubTopic", "Topic of velocities.")
                .or("cmd_vel")
                .naming(NamedEntity::Topic),
            text("enableSubTopic", "Topic that switches it.")
                .or("enable")
                .naming(NamedEntity::Topic),
            text("comLinkName", "The link at the centre of mass.")
                .required()
                .naming(NamedEntity::Link),
            numbers("velocityGain", "", "Gains along x, y, z.").required(),
            numbers("attitudeGain", "", "Gains about x, y, z.").required(),
            numbers("angularRateGain", "", "Gains about x, y, z.").required(),
            numbers("maximumLinearVelocity", "m/s", "Along x, y, z."),
            numbers("maximumLinearAcceleration", "m/s^2", "Along x, y, z.").required(),
            numbers("maximumAngularVelocity", "rad/s", "Maximum about x, y, z."),
            numbers("linearVelocityNoiseMean", "m/s", "Along x, y, z."),
            numbers("linearVelocityNoiseStdDev", "m/s", "Along x, y, z."),
            numbers("angularVelocityNoiseMean", "rad/s", "Maximum about x, y, z."),
            numbers("angularVelocityNoiseStdDev", "rad/s", "Maximum about x, y, z."),
            group("rotorConfiguration", "Joint, force and direction of each rotor.").required(),
        ]
    ),
    system!(
        "gz-sim-multicopter-motor-model-system",
        ["MulticopterMotorModel"],
        Control,
        Kept,
        "Computes the forces of a rotor from thrust and drag.",
        [
            text("robotNamespace", "Prefix of every topic."),
            joint("jointName", "The rotor's joint.").required(),
            text("linkName", "The rotor's link.").required().naming(NamedEntity::Link),
            choice("turningDirection", &["cw", "ccw"], "Seen from above."),
            choice("motorType", &["velocity", "position", "force"], "What commands mean.")
                .or("velocity"),
            text("commandSubTopic", "Topic of commands.").naming(NamedEntity::Topic),
            text("motorSpeedPubTopic", "Topic of speeds.").naming(NamedEntity::Topic),
            integer("actuator_number", "Index in an `Actuators` message.")
                .also(&["motorNumber"])
                .min(0.0),
            text("actuatorType", "Field of an `Actuators` message that is read."),
            number("maxRotVelocity", "rad/s", "Maximum speed."),
            number("motorConstant", "N s^2", "Thrust per squared speed."),
            number("momentConstant", "m", "Torque per thrust."),
            number("rotorDragCoefficient", "", "Drag per speed."),
            number("rollingMomentCoefficient", "", "Rolling moment per speed."),
            number(
                "rotorVelocitySlowdownSim",
                "",
                "Factor by which the displayed rotor turns more slowly."
            )
            .or("10"),
            number("timeConstantUp", "s", "Time constant of acceleration."),
            number("timeConstantDown", "s", "Time constant of deceleration."),
        ]
    ),
    system!(
        "gz-sim-drive-to-pose-controller-system",
        ["DriveToPoseController"],
        Control,
        Kept,
        "Drives a model to a pose.",
        [
            number("linear_p_gain", "1/s", "Proportional gain from distance to speed.").or("1"),
            number("angular_p_gain", "1/s", "Turn rate per angle.").or("2"),
            number("linear_deviation", "m", "Distance at which the position counts as reached.")
                .or("0.1"),
            number("angular_deviation", "rad", "Tolerance of the heading.").or("0.05"),
        ]
    ),
    system!(
        "gz-sim-trajectory-follower-system",
        ["TrajectoryFollower"],
        Control,
        Kept,
        "Drives a model along waypoints.",
        [
            text("link_name", "Link on which the force acts.").naming(NamedEntity::Link),
            group("waypoints", "Waypoints."),
            flag("loop", "If true, it repeats.").or("false"),
            number("force", "N", "Force.").or("60"),
            number("torque", "N m", "Torque.").or("50"),
            number("range_tolerance", "m", "Distance at which a position counts as reached.")
                .or("0.5"),
            number("bearing_tolerance", "deg", "Tolerance of the bearing.").or("2"),
            flag("zero_vel_on_bearing_reached", "If true, it stops turning below the minimum.")
                .or("false"),
            group("circle", "A circle instead of waypoints."),
            group("line", "A line instead of waypoints."),
            text("topic", "Topic that switches it.").naming(NamedEntity::Topic),
        ]
    ),
];
