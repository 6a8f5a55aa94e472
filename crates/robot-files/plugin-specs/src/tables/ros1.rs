//! Plugins of `gazebo_ros_pkgs`, branch `noetic-devel`, other than drives and sensors.

use periplus_params::{NamedEntity, Parameter, flag, group, integer, number, numbers, text};

use super::of_ros1;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const UPDATE_RATE: Parameter =
    number("updateRate", "Hz", "Messages per second; 0: one per step.").or("0").min(0.0);

const fn link(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Link)
}

const fn topic(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Topic)
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    of_ros1!(
        "gazebo_ros_p3d",
        State,
        Simulated,
        "Publishes the true pose of a link as odometry.",
        [
            link("bodyName", "Link whose pose is published.").required(),
            topic("topicName", "Topic of the odometry.").required(),
            text("frameName", "Reference link of the measurement, or `world` or `map`.")
                .or("world")
                .naming(NamedEntity::Frame),
            UPDATE_RATE,
            numbers("xyzOffset", "m", "Added to the position.").or("0 0 0").also(&["xyzOffsets"]),
            numbers("rpyOffset", "rad", "Offset that is added to the orientation.")
                .or("0 0 0")
                .also(&["rpyOffsets"]),
            number("gaussianNoise", "m/s", "Standard deviation of the noise of the velocity.")
                .or("0")
                .min(0.0),
        ]
    )
    .topics(&[publishes("p3d").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_joint_state_publisher",
        State,
        Simulated,
        "Publishes positions of joints.",
        [
            text("jointName", "The joints, separated by commas (default: all)."),
            number("updateRate", "Hz", "Messages per second.").or("100").min(0.0),
        ]
    )
    .topics(&[publishes("joint_states")]),
    of_ros1!(
        "gazebo_ros_joint_pose_trajectory",
        Control,
        Kept,
        "Sets joints to the positions of a trajectory.",
        [
            topic("topicName", "Topic of trajectories.").or("set_joint_trajectory"),
            topic("serviceName", "Service of trajectories.").or("set_joint_trajectory"),
            UPDATE_RATE,
        ]
    )
    .topics(&[listens("set_joint_trajectory").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_joint_trajectory",
        Control,
        Kept,
        "Older name of the pose trajectory.",
        [
            topic("topicName", "Topic of trajectories."),
            topic("serviceName", "Service of trajectories."),
            UPDATE_RATE,
        ]
    ),
    of_ros1!(
        "gazebo_ros_force",
        Effect,
        Kept,
        "Applies the force of a message to a link.",
        [
            link("bodyName", "The link.").required(),
            topic("topicName", "Topic of forces.").required(),
        ]
    )
    .topics(&[listens("force").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_control",
        Control,
        Simulated,
        "Runs ros_control on the model's joints.",
        [
            text("robotSimType", "Class of the hardware interface.")
                .or("gazebo_ros_control/DefaultRobotHWSim"),
            text("robotParam", "Parameter that holds the robot description.")
                .or("robot_description"),
            number("controlPeriod", "s", "Step of the controllers (default: each step).")
                .above(0.0),
            flag("legacyModeNS", "If true, PID gains are read from their location before Kinetic."),
            topic("eStopTopic", "Topic of an emergency stop."),
        ]
    ),
    of_ros1!(
        "gazebo_ros_wheel_slip",
        Effect,
        Kept,
        "Simulates wheel slip in proportion to the load.",
        [group("wheel", "A wheel's link and compliances.").repeated()]
    ),
    of_ros1!(
        "gazebo_ros_projector",
        Effect,
        Kept,
        "Switches a projector and its texture.",
        [
            text("projector", "The projector, as `link/name`."),
            text("textureName", "Texture at the start."),
            text("filterTextureName", "Texture of the filter."),
            topic("textureTopicName", "Topic of textures."),
            topic("projectorTopicName", "Topic of the switch."),
            UPDATE_RATE,
        ]
    ),
    of_ros1!(
        "gazebo_ros_harness",
        Effect,
        Kept,
        "Lowers a model on a rope and releases it.",
        [
            number("init_vel", "m/s", "Speed of the rope at the start.").or("0"),
            group("joint", "A joint that holds the model.").repeated(),
            group("winch", "Joint of the winch and gains of its controller."),
            text("detach", "Joint that is detached."),
        ]
    ),
    of_ros1!(
        "gazebo_ros_elevator",
        Effect,
        Kept,
        "Drives an elevator to a floor.",
        [
            text("lift_joint", "Joint of the lift."),
            text("door_joint", "The joint of the door."),
            number("floor_height", "m", "Height of a storey.").or("3").above(0.0),
            number("door_wait_time", "s", "Time for which the door stays open.").or("5").min(0.0),
            number("speed", "m/s", "Lifting speed."),
            numbers("force_pid", "", "Gains of the force."),
            integer("bottomFloor", "Number of the lowest floor."),
            integer("topFloor", "Number of the highest floor."),
            topic("topic", "Topic of commands."),
        ]
    ),
    of_ros1!(
        "gazebo_ros_hand_of_god",
        Effect,
        Kept,
        "Pulls a link to a frame by a spring.",
        [
            link("linkName", "The link.").required(),
            text("frameId", "The frame's parent.").or("hog"),
            number("kl", "N/m", "Linear spring constant.").or("200"),
            number("ka", "N m/rad", "Angular spring constant.").or("200"),
            number("cl", "N s/m", "Linear damping (default: critical)."),
            number("ca", "N m s/rad", "Angular damping (default: critical)."),
        ]
    ),
    of_ros1!(
        "gazebo_ros_vacuum_gripper",
        Effect,
        Kept,
        "Pulls nearby objects to a link.",
        [
            link("bodyName", "Link of the gripper.").required(),
            topic("topicName", "Topic of the gripper's state.").required(),
        ]
    ),
    of_ros1!(
        "gazebo_ros_video",
        Effect,
        Kept,
        "Shows images on a visual.",
        [
            topic("topicName", "Topic of images.").or("image_raw"),
            integer("height", "Rows of the texture.").or("240").min(1.0),
            integer("width", "Columns of the texture.").or("320").min(1.0),
        ]
    ),
    of_ros1!(
        "gazebo_ros_api_plugin",
        World,
        BuiltIn,
        "Publishes the clock and the states; spawns, deletes, pauses, resets.",
        [UPDATE_RATE]
    ),
    of_ros1!("gazebo_ros_paths_plugin", World, BuiltIn, "Adds ROS packages to the paths.", []),
    of_ros1!(
        "gazebo_ros",
        World,
        BuiltIn,
        "Older name of the plugin that publishes the clock and the states.",
        [UPDATE_RATE]
    ),
    of_ros1!("gazebo_ros_template", World, Kept, "An empty example.", []).open(),
    of_ros1!("gazebo_ros_controller_manager", Control, Kept, "Runs the PR2's controllers.", [])
        .open(),
    of_ros1!("gazebo_ros_power_monitor", State, Kept, "Publishes the PR2's battery.", []).open(),
    of_ros1!("gazebo_ros_srp", State, Kept, "Publishes a point of the PR2's body.", []).open(),
];
