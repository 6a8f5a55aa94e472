//! Sensor systems and publishers of current Gazebo.

use periplus_params::{
    NamedEntity, Parameter, choice, flag, group, integer, number, numbers, text,
};

use super::system;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const fn topic(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Topic)
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    system!(
        "gz-sim-sensors-system",
        ["Sensors"],
        World,
        Simulated,
        "Runs cameras and lidars.",
        [
            choice("render_engine", &["ogre", "ogre2", "optix"], "Rendering engine.").or("ogre2"),
            text("render_engine_api_backend", "`opengl`, `vulkan` or `metal`."),
            numbers("background_color", "", "Red, green, blue of the sky."),
            numbers("ambient_light", "", "Red, green, blue."),
            flag("disable_on_drained_battery", "If true, sensors stop with the battery.")
                .or("false"),
            group("global_illumination", "Indirect light."),
        ]
    ),
    system!("gz-sim-imu-system", ["Imu"], World, Simulated, "Runs `imu` sensors.", []),
    system!(
        "gz-sim-magnetometer-system",
        ["Magnetometer"],
        World,
        Simulated,
        "Runs `magnetometer` sensors.",
        [
            flag("use_units_gauss", "If true, fields are in gauss instead of tesla.").or("true"),
            flag("use_earth_frame_ned", "If true, the field is given north, east, down.")
                .or("true"),
        ]
    ),
    system!(
        "gz-sim-altimeter-system",
        ["Altimeter"],
        World,
        Simulated,
        "Runs `altimeter` sensors.",
        []
    ),
    system!(
        "gz-sim-air-pressure-system",
        ["AirPressure"],
        World,
        Simulated,
        "Runs `air_pressure` sensors.",
        []
    ),
    system!("gz-sim-air-speed-system", ["AirSpeed"], World, Kept, "Runs `air_speed` sensors.", []),
    system!("gz-sim-navsat-system", ["NavSat"], World, Simulated, "Runs `navsat` sensors.", []),
    system!(
        "gz-sim-forcetorque-system",
        ["ForceTorque"],
        World,
        Simulated,
        "Runs `force_torque` sensors.",
        []
    ),
    system!("gz-sim-contact-system", ["Contact"], World, Simulated, "Runs `contact` sensors.", []),
    system!(
        "gz-sim-logical-camera-system",
        ["LogicalCamera"],
        World,
        Simulated,
        "Runs `logical_camera` sensors.",
        [text("render_engine", "Ignored.")]
    ),
    system!(
        "gz-sim-thermal-system",
        ["Thermal"],
        Effect,
        Kept,
        "Gives a visual a temperature.",
        [
            number("temperature", "K", "Temperature.").min(0.0),
            text("heat_signature", "Image of temperatures."),
            number("min_temp", "K", "Temperature of black.").min(0.0),
            number("max_temp", "K", "Temperature of white.").min(0.0),
        ]
    ),
    system!(
        "gz-sim-thermal-sensor-system",
        ["ThermalSensor"],
        Sensor,
        Kept,
        "Sets the resolution of a `thermal_camera`.",
        [
            number("min_temp", "K", "Minimum temperature."),
            number("max_temp", "K", "Maximum temperature."),
            number("resolution", "K", "Temperature of one step.").above(0.0),
        ]
    ),
    system!(
        "gz-sim-label-system",
        ["Label"],
        Effect,
        Simulated,
        "Gives a model or visual a label for segmentation.",
        [integer("label", "The label.").required().within(0.0, 255.0)]
    ),
    system!(
        "gz-sim-dvl-system",
        ["DopplerVelocityLogSystem"],
        World,
        Kept,
        "Runs Doppler velocity logs.",
        []
    ),
    system!(
        "gz-sim-environmental-sensor-system",
        ["EnvironmentalSystem"],
        World,
        Kept,
        "Runs `environmental_sensor` sensors.",
        []
    ),
    system!(
        "gz-sim-odometry-publisher-system",
        ["OdometryPublisher"],
        State,
        Simulated,
        "Publishes the true pose of a model as odometry.",
        [
            text("odom_frame", "Frame of the odometry (default: `<model>/odom`)."),
            text(
                "robot_base_frame",
                "Child frame of the odometry (default: `<model>/base_footprint`).",
            ),
            number("odom_publish_frequency", "Hz", "Messages per second; 0: one per step.")
                .or("50")
                .min(0.0),
            topic("odom_topic", "Topic of the odometry."),
            topic("odom_covariance_topic", "Topic of the odometry with covariance."),
            topic("tf_topic", "Topic of the transform."),
            integer("dimensions", "2 or 3.").or("2").within(2.0, 3.0),
            numbers("xyz_offset", "m", "Added to the position.").or("0 0 0"),
            numbers("rpy_offset", "rad", "Offset that is added to the orientation.").or("0 0 0"),
            number("gaussian_noise", "m/s", "Standard deviation of the noise of the velocity.")
                .or("0")
                .min(0.0),
        ]
    )
    .topics(&[
        publishes("/model/{model}/odometry").set_by("odom_topic"),
        publishes("/model/{model}/odometry_with_covariance").set_by("odom_covariance_topic"),
        publishes("/model/{model}/pose").set_by("tf_topic"),
    ]),
    system!(
        "gz-sim-joint-state-publisher-system",
        ["JointStatePublisher"],
        State,
        Simulated,
        "Publishes positions and velocities of joints.",
        [
            topic("topic", "Topic of the states."),
            text("joint_name", "A joint (default: all).").repeated().naming(NamedEntity::Joint),
            number("update_rate", "Hz", "Messages per second; 0: one per step.").or("0").min(0.0),
        ]
    )
    .topics(&[publishes("/world/{world}/model/{model}/joint_state").set_by("topic")]),
    system!(
        "gz-sim-pose-publisher-system",
        ["PosePublisher"],
        State,
        Simulated,
        "Publishes the poses of a model's parts.",
        [
            flag("publish_link_pose", "If true, links are published.").or("true"),
            flag("publish_visual_pose", "If true, visuals are published.").or("false"),
            flag("publish_collision_pose", "If true, collisions are published.").or("false"),
            flag("publish_sensor_pose", "If true, sensors are published.").or("false"),
            flag("publish_model_pose", "If true, the model itself is published.").or("false"),
            flag("publish_nested_model_pose", "If true, nested models are published.").or("false"),
            flag("use_pose_vector_msg", "If true, all poses come in one message.").or("false"),
            number("update_frequency", "Hz", "Messages per second; negative: one per step.")
                .or("-1"),
            flag("static_publisher", "If true, static poses have their own topic.").or("false"),
            number(
                "static_update_frequency",
                "Hz",
                "Messages per second there; negative: one per step.",
            )
            .or("-1"),
        ]
    )
    .topics(&[publishes("/model/{model}/pose")]),
    system!(
        "gz-sim-triggered-publisher-system",
        ["TriggeredPublisher"],
        State,
        Simulated,
        "Publishes messages when a message matches.",
        [
            group("input", "Topic and type to listen to, and what must match.").required(),
            group("output", "Topic, type and text to publish.").repeated(),
            group("service", "A service to call.").repeated(),
            integer("delay_ms", "Delay in simulated milliseconds.").or("0").min(0.0),
        ]
    ),
    system!(
        "gz-sim-touchplugin-system",
        ["TouchPlugin"],
        State,
        Simulated,
        "Publishes a message when a model has been in contact for some time.",
        [
            text("target", "Name, or part of the name, of the model or link that must be touched.")
                .required(),
            text("collision", "A collision that must touch (default: all).").repeated(),
            flag(
                "create_contact_sensor_for_collision",
                "If true, missing contact sensors are created.",
            )
            .or("false"),
            number("time", "s", "Minimum duration of the contact.").required().min(0.0),
            text("namespace", "Prefix of the topics.").required(),
            flag("enabled", "If true, it is active from the start.").or("false"),
        ]
    )
    .topics(&[publishes("/{namespace}/touched")]),
    system!(
        "gz-sim-logicalaudiosensorplugin-system",
        ["LogicalAudioSensorPlugin"],
        Sensor,
        Kept,
        "Reports the sound sources within range of a microphone.",
        [
            group("source", "A source of sound.").repeated(),
            group("microphone", "A microphone.").repeated(),
        ]
    ),
    system!(
        "gz-sim-opticaltactileplugin-system",
        ["OpticalTactilePlugin"],
        Sensor,
        Kept,
        "Publishes contacts on a skin in front of a depth camera.",
        [
            flag("enabled", "If true, it is active from the start.").or("true"),
            text("namespace", "Prefix of the topics.").or("optical_tactile_sensor"),
            integer("visualization_resolution", "Pixels between arrows.").or("30").min(1.0),
            flag("visualize_forces", "If true, forces are drawn.").or("false"),
            flag("visualize_contacts", "If true, contacts are drawn.").or("false"),
            flag("visualize_sensor", "If true, the skin is drawn.").or("false"),
            number("extended_sensing", "m", "Sensing distance beyond the skin.").or("0.001"),
            number("force_length", "m", "Length of an arrow.").or("0.01"),
        ]
    ),
    system!(
        "gz-sim-performer-detector-system",
        ["PerformerDetector"],
        State,
        Kept,
        "Reports performers that enter a volume.",
        [
            topic("topic", "Topic of the events."),
            group("geometry", "The volume."),
            numbers("pose", "m", "Pose of the volume."),
            group("header_data", "Added to the messages.").repeated(),
        ]
    ),
    system!(
        "gz-sim-kinetic-energy-monitor-system",
        ["KineticEnergyMonitor"],
        State,
        Kept,
        "Reports a sudden loss of energy of a link.",
        [
            text("link_name", "The link.").required().naming(NamedEntity::Link),
            number("kinetic_energy_threshold", "J", "Loss of energy that is reported.").or("7"),
            topic("topic", "Topic of the events."),
        ]
    ),
    system!(
        "gz-sim-breadcrumbs-system",
        ["Breadcrumbs"],
        Effect,
        Kept,
        "Drops models on command.",
        [
            topic("topic", "Topic of commands."),
            integer(
                "max_deployments",
                "Maximum number of models that are dropped; negative: unlimited."
            ),
            number("disable_physics_time", "s", "Time after which a dropped model is static."),
            group("performer_volume", "Volume of a performer."),
            flag("allow_renaming", "If true, a name in use is changed.").or("false"),
            text("topic_statistics", "If true, statistics are published."),
            group("breadcrumb", "The model."),
        ]
    ),
    system!(
        "gz-sim-comms-endpoint-system",
        ["CommsEndpoint"],
        State,
        Kept,
        "Gives a model an address for messages.",
        [
            text("address", "The address.").required(),
            topic("topic", "Topic of messages that arrive.").required(),
            group("broker", "Services of the broker."),
        ]
    )
    .topics(&[listens("/broker/msgs")]),
];
