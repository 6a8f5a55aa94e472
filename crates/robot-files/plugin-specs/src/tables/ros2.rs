//! Plugins of `gazebo_ros_pkgs`, branch `ros2`, other than drives.

use periplus_params::{NamedEntity, Parameter, choice, flag, integer, number, numbers, text};

use super::of_ros2;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const FRAME_NAME: Parameter =
    text("frame_name", "Frame of the messages (default: the sensor's link).")
        .naming(NamedEntity::Frame);

const BODY_NAME: Parameter =
    text("body_name", "Link whose pose is published.").naming(NamedEntity::Link);

pub(super) static PLUGINS: &[PluginSpec] = &[
    of_ros2!(
        "gazebo_ros_ray_sensor",
        Sensor,
        Simulated,
        "Publishes the measurements of a `ray` or `gpu_ray` sensor.",
        [
            choice(
                "output_type",
                &[
                    "sensor_msgs/LaserScan",
                    "sensor_msgs/PointCloud",
                    "sensor_msgs/PointCloud2",
                    "sensor_msgs/Range",
                ],
                "Type of the messages.",
            )
            .or("sensor_msgs/PointCloud2"),
            FRAME_NAME,
            number("min_intensity", "", "Intensities below are raised to this.").or("0"),
            choice("radiation_type", &["infrared", "ultrasound"], "Radiation type of the Range message.")
                .or("infrared"),
        ]
    )
    .topics(&[publishes("~/out")]),
    of_ros2!(
        "gazebo_ros_camera",
        Sensor,
        Simulated,
        "Publishes the images of a `camera`, `depth` or `multicamera` sensor.",
        [
            text("camera_name", "Prefix of every topic (default: the sensor's name)."),
            FRAME_NAME,
            flag("triggered", "If true, an image is taken only on a message on `image_trigger`.")
                .or("false"),
            number("cx", "px", "Column of the principal point (default: (width + 1) / 2)."),
            number("cy", "px", "Row of the principal point (default: (height + 1) / 2)."),
            number("focal_length", "px", "Default: width / (2 tan(horizontal_fov / 2)).")
                .min(0.0),
            flag("border_crop", "If true, the black border of a distortion is cut off.").or("true"),
            number("hack_baseline", "m", "Distance from the left camera of a stereo pair.").or("0"),
            numbers("rectification_matrix", "", "The nine numbers of the rectification, by row.")
                .or("1 0 0 0 1 0 0 0 1"),
            number("P_fx", "px", "First entry of the projection (default: the focal length)."),
            number("P_fy", "px", "Sixth entry of the projection (default: the focal length)."),
            number("P_cx", "px", "Third entry of the projection (default: `cx`)."),
            number("P_cy", "px", "Seventh entry of the projection (default: `cy`)."),
            number("Tx", "px m", "Fourth entry of the projection (default: from the baseline)."),
            number("Ty", "px m", "Eighth entry of the projection.").or("0"),
            number("min_depth", "m", "Minimum depth; pixels below are -inf.").or("0.4").min(0.0),
            number("max_depth", "m", "Maximum depth; pixels beyond are inf.").or("inf").min(0.0),
        ]
    )
    .topics(&[
        publishes("{camera_name}/image_raw"),
        publishes("{camera_name}/camera_info"),
        publishes("{camera_name}/depth/image_raw"),
        publishes("{camera_name}/depth/camera_info"),
        publishes("{camera_name}/points"),
        listens("{camera_name}/image_trigger").when("triggered"),
    ]),
    of_ros2!(
        "gazebo_ros_imu_sensor",
        Sensor,
        Simulated,
        "Publishes the measurements of an `imu` sensor.",
        [
            FRAME_NAME,
            flag(
                "initial_orientation_as_reference",
                "If true, orientations are relative to the start; REP 145 requires them relative to the world.",
            )
            .or("false"),
        ]
    )
    .topics(&[publishes("~/out")]),
    of_ros2!(
        "gazebo_ros_gps_sensor",
        Sensor,
        Simulated,
        "Publishes the measurements of a `gps` sensor.",
        [FRAME_NAME]
    )
    .topics(&[publishes("~/out"), publishes("~/vel")]),
    of_ros2!(
        "gazebo_ros_bumper",
        Sensor,
        Simulated,
        "Publishes the contacts of a `contact` sensor.",
        [text("frame_name", "Frame in which contacts are given.").or("world").naming(NamedEntity::Frame)]
    )
    .topics(&[publishes("bumper_states")]),
    of_ros2!(
        "gazebo_ros_joint_state_publisher",
        State,
        Simulated,
        "Publishes positions and velocities of joints.",
        [
            text("joint_name", "A joint to publish.").required().repeated().naming(NamedEntity::Joint),
            number("update_rate", "Hz", "Messages per second.").or("100").min(0.0),
        ]
    )
    .topics(&[publishes("joint_states")]),
    of_ros2!(
        "gazebo_ros_p3d",
        State,
        Simulated,
        "Publishes the true pose of a link as odometry.",
        [
            BODY_NAME.required(),
            text("frame_name", "Reference link of the measurement, or `world` or `map`.")
                .or("world")
                .naming(NamedEntity::Frame),
            number("update_rate", "Hz", "Messages per second; 0: one per step.")
                .or("0")
                .min(0.0),
            numbers("xyz_offset", "m", "Added to the position.").or("0 0 0").also(&["xyz_offsets"]),
            numbers("rpy_offset", "rad", "Offset that is added to the orientation.")
                .or("0 0 0")
                .also(&["rpy_offsets"]),
            number("gaussian_noise", "m/s", "Standard deviation of the noise of the velocity.")
                .or("0")
                .min(0.0),
        ]
    )
    .topics(&[publishes("odom")]),
    of_ros2!(
        "gazebo_ros_ft_sensor",
        Sensor,
        Simulated,
        "Publishes forces and torques on a link or in a joint.",
        [
            BODY_NAME,
            text("joint_name", "The joint to measure in, when no link is named.")
                .naming(NamedEntity::Joint),
            text("frame_name", "Frame of the messages of a link.").or("world").naming(NamedEntity::Frame),
            number("update_rate", "Hz", "Messages per second; 0: one per step.")
                .or("0")
                .min(0.0),
            number("gaussian_noise", "N", "Standard deviation of the noise.").or("0").min(0.0),
        ]
    )
    .topics(&[publishes("wrench")]),
    of_ros2!(
        "gazebo_ros_force",
        Effect,
        Kept,
        "Applies the force of a message to a link.",
        [
            text("link_name", "The link.").required().naming(NamedEntity::Link),
            choice("force_frame", &["world", "link"], "Axes in which forces are given.")
                .or("world"),
        ]
    )
    .topics(&[listens("gazebo_ros_force")]),
    of_ros2!(
        "gazebo_ros_wheel_slip",
        Effect,
        Kept,
        "Simulates wheel slip in proportion to the load.",
        [periplus_params::group("wheel", "A wheel's link and compliances.").repeated()]
    ),
    of_ros2!(
        "gazebo_ros_projector",
        Effect,
        Kept,
        "Switches a projector on a link.",
        [
            text("projector_link", "The projector's link.")
                .or("projector_link")
                .naming(NamedEntity::Link),
            text("projector_name", "The projector's name.").or("projector"),
        ]
    )
    .topics(&[listens("switch")]),
    of_ros2!(
        "gazebo_ros_harness",
        Effect,
        Kept,
        "Lowers a model on a rope and releases it.",
        [
            number("init_vel", "m/s", "Speed of the rope at the start.").or("0"),
            periplus_params::group("joint", "A joint that holds the model.").repeated(),
            periplus_params::group("winch", "Joint of the winch and gains of its controller."),
            text("detach", "Joint that is detached."),
        ]
    ),
    of_ros2!(
        "gazebo_ros_elevator",
        Effect,
        Kept,
        "Drives an elevator to a floor.",
        [
            text("lift_joint", "Joint of the lift.").naming(NamedEntity::Joint),
            text("door_joint", "The joint of the door.").naming(NamedEntity::Joint),
            number("floor_height", "m", "Height of a storey.").or("3").above(0.0),
            number("door_wait_time", "s", "Time for which the door stays open.").or("5").min(0.0),
            number("speed", "m/s", "Lifting speed."),
            numbers("force_pid", "", "Gains of the force."),
            integer("bottom_floor", "Number of the lowest floor."),
            integer("top_floor", "Number of the highest floor."),
            text("topic", "Gazebo topic of commands.").naming(NamedEntity::Topic),
        ]
    )
    .topics(&[listens("elevator")]),
    of_ros2!(
        "gazebo_ros_hand_of_god",
        Effect,
        Kept,
        "Pulls a link to a frame by a spring.",
        [
            text("link_name", "The link.").required().naming(NamedEntity::Link),
            text("frame_id", "The frame's parent.").or("world"),
            number("kl", "N/m", "Linear spring constant.").or("200"),
            number("ka", "N m/rad", "Angular spring constant.").or("200"),
            number("cl", "N s/m", "Linear damping (default: critical)."),
            number("ca", "N m s/rad", "Angular damping (default: critical)."),
        ]
    ),
    of_ros2!(
        "gazebo_ros_joint_pose_trajectory",
        Control,
        Kept,
        "Sets joints to the positions of a trajectory.",
        [number("update_rate", "Hz", "Steps per second; 0: one per step.").or("0").min(0.0)]
    )
    .topics(&[listens("set_joint_trajectory")]),
    of_ros2!(
        "gazebo_ros_vacuum_gripper",
        Effect,
        Kept,
        "Pulls nearby objects to a link.",
        [
            text("link_name", "Link of the gripper.").required().naming(NamedEntity::Link),
            text("fixed", "Object that is not pulled.").repeated(),
            number("max_distance", "m", "Maximum distance of a link that is attracted.").or("0.05").min(0.0),
        ]
    )
    .topics(&[publishes("grasping")]),
    of_ros2!(
        "gazebo_ros_video",
        Effect,
        Kept,
        "Shows images on a visual.",
        [
            integer("height", "Rows of the texture.").or("240").min(1.0),
            integer("width", "Columns of the texture.").or("320").min(1.0),
        ]
    )
    .topics(&[listens("~/image_raw")]),
    of_ros2!(
        "gazebo_ros_state",
        World,
        BuiltIn,
        "Publishes and sets the states of models and links.",
        [number("update_rate", "Hz", "Messages per second; 0: one per step.")
            .or("100")
            .min(0.0)]
    ),
    of_ros2!(
        "gazebo_ros_properties",
        World,
        BuiltIn,
        "Reads and sets properties of the world.",
        []
    ),
    of_ros2!("gazebo_ros_factory", World, BuiltIn, "Spawns and deletes models.", []),
    of_ros2!("gazebo_ros_init", World, BuiltIn, "Publishes the clock; pauses and resets.", []),
    of_ros2!("gazebo_ros_force_system", World, Kept, "Applies forces by service.", []),
    of_ros2!("gazebo_ros_template", World, Kept, "An empty example.", []).open(),
    of_ros2!(
        "gazebo_ros2_control",
        Control,
        Simulated,
        "Runs ros2_control on the model's joints.",
        [
            text("parameters", "Path of a parameter file.").repeated(),
            text("robot_param", "Parameter that holds the robot description.")
                .or("robot_description"),
            text("robot_param_node", "Node with that parameter.").or("robot_state_publisher"),
            flag("hold_joints", "If true, joints hold their position without a command.").or("true"),
            text("robot_sim_type", "Class of the hardware interface, before ros2_control."),
            number("control_period", "s", "Step of the controllers.").above(0.0),
            text("e_stop_topic", "Topic of an emergency stop.").naming(NamedEntity::Topic),
        ]
    ),
];
