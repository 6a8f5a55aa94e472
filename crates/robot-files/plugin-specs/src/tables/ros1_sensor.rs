//! Sensors of `gazebo_ros_pkgs`, branch `noetic-devel`, other than cameras; and those of
//! `hector_gazebo_plugins`.

use periplus_params::{NamedEntity, Parameter, choice, flag, number, numbers, text};

use super::of_ros1;
use crate::PluginSpec;
use crate::known::publishes;

const UPDATE_RATE: Parameter =
    number("updateRate", "Hz", "Messages per second; 0: one per step.").or("0").min(0.0);

const NOISE: Parameter =
    number("gaussianNoise", "", "Standard deviation of the noise.").or("0").min(0.0);

const XYZ_OFFSET: Parameter =
    numbers("xyzOffset", "m", "Added to the position.").or("0 0 0").also(&["xyzOffsets"]);

const RPY_OFFSET: Parameter =
    numbers("rpyOffset", "rad", "Offset that is added to the orientation.")
        .or("0 0 0")
        .also(&["rpyOffsets"]);

const BODY_NAME: Parameter =
    text("bodyName", "Link whose pose is published.").naming(NamedEntity::Link);

const fn frame(default: &'static str) -> Parameter {
    text("frameName", "Frame of the messages.").or(default).naming(NamedEntity::Frame)
}

const fn topic(default: &'static str) -> Parameter {
    text("topicName", "Topic of the messages.").or(default).naming(NamedEntity::Topic)
}

const REQUIRED_TOPIC: Parameter =
    text("topicName", "Topic of the messages.").required().naming(NamedEntity::Topic);

const DRIFT_FREQUENCY_OF_ACCELERATION: Parameter =
    numbers("accelDriftFrequency", "Hz", "Inverse of the time of the drift.")
        .or("0.000277778 0.000277778 0.000277778");

const DRIFT_FREQUENCY_OF_RATE: Parameter =
    numbers("rateDriftFrequency", "Hz", "Inverse of the time of the drift.")
        .or("0.000277778 0.000277778 0.000277778");

pub(super) static PLUGINS: &[PluginSpec] = &[
    of_ros1!(
        "gazebo_ros_laser",
        Sensor,
        Simulated,
        "Publishes the measurements of a `ray` sensor.",
        [
            topic("/world"),
            frame("/world"),
            UPDATE_RATE,
            NOISE,
            number("hokuyoMinIntensity", "", "Intensities below are raised to this."),
        ]
    )
    .topics(&[publishes("/world").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_gpu_laser",
        Sensor,
        Simulated,
        "Publishes the measurements of a `gpu_ray` sensor.",
        [topic("/world"), frame("/world"), UPDATE_RATE, NOISE]
    )
    .topics(&[publishes("/world").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_block_laser",
        Sensor,
        Simulated,
        "Publishes the points of a `ray` sensor with several rows.",
        [
            topic("/world"),
            frame("/world"),
            UPDATE_RATE,
            NOISE,
            number("hokuyoMinIntensity", "", "Intensities below are raised to this.").or("101"),
        ]
    )
    .topics(&[publishes("/world").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_range",
        Sensor,
        Simulated,
        "Publishes the nearest range of a `ray` sensor.",
        [
            topic("/range"),
            frame("/world"),
            UPDATE_RATE,
            NOISE,
            number("fov", "rad", "Field of view in the messages.").or("0.05").above(0.0),
            choice("radiation", &["ultrasound", "infrared"], "Kind in the messages.")
                .or("infrared"),
        ]
    )
    .topics(&[publishes("/range").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_imu",
        Sensor,
        Simulated,
        "Publishes angular velocity and acceleration of a link.",
        [
            BODY_NAME.required(),
            topic("/default_imu"),
            text("serviceName", "Service that calibrates.").naming(NamedEntity::Topic),
            UPDATE_RATE,
            NOISE,
            XYZ_OFFSET,
            RPY_OFFSET,
        ]
    )
    .topics(&[publishes("/default_imu").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_imu_sensor",
        Sensor,
        Simulated,
        "Publishes the measurements of an `imu` sensor.",
        [
            topic("/default_imu"),
            BODY_NAME,
            text("frameName", "Frame of the messages (default: the link).").naming(NamedEntity::Frame),
            number("updateRateHZ", "Hz", "Messages per second.").or("1").min(0.0),
            NOISE,
            XYZ_OFFSET,
            RPY_OFFSET,
            flag(
                "initialOrientationAsReference",
                "If true, orientations are relative to the start; REP 145 requires them relative to the world.",
            ),
        ]
    )
    .topics(&[publishes("/default_imu").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_bumper",
        Sensor,
        Simulated,
        "Publishes the contacts of a `contact` sensor.",
        [
            text("bumperTopicName", "Topic of the contacts.")
                .or("bumper_states")
                .naming(NamedEntity::Topic),
            frame("world"),
            UPDATE_RATE,
        ]
    )
    .topics(&[publishes("bumper_states").set_by("bumperTopicName")]),
    of_ros1!(
        "gazebo_ros_f3d",
        Sensor,
        Simulated,
        "Publishes the force on a link.",
        [BODY_NAME.required(), REQUIRED_TOPIC, frame("world"), UPDATE_RATE]
    )
    .topics(&[publishes("f3d").set_by("topicName")]),
    of_ros1!(
        "gazebo_ros_ft_sensor",
        Sensor,
        Simulated,
        "Publishes forces and torques in a joint.",
        [
            text("jointName", "The joint.").required().naming(NamedEntity::Joint),
            REQUIRED_TOPIC,
            NOISE,
            UPDATE_RATE,
        ]
    )
    .topics(&[publishes("wrench").set_by("topicName")]),
    of_ros1!(
        "hector_gazebo_ros_imu",
        Sensor,
        Simulated,
        "Publishes angular velocity, acceleration and orientation of a link, with drift.",
        [
            BODY_NAME,
            text("frameId", "Frame of the messages (default: the link).").naming(NamedEntity::Frame),
            topic("imu"),
            text("serviceName", "Service that calibrates.").naming(NamedEntity::Topic),
            UPDATE_RATE,
            NOISE,
            RPY_OFFSET,
            numbers("accelOffset", "m/s²", "Constant error of the acceleration.").or("0 0 0"),
            numbers("accelDrift", "m/s²", "Deviation of the drift of the acceleration.").or("0 0 0"),
            DRIFT_FREQUENCY_OF_ACCELERATION,
            numbers("accelGaussianNoise", "m/s²", "Noise of the acceleration.").or("0 0 0"),
            numbers("rateOffset", "rad/s", "Constant error of the angular velocity.").or("0 0 0"),
            numbers("rateDrift", "rad/s", "Deviation of the drift of the angular velocity.").or("0 0 0"),
            DRIFT_FREQUENCY_OF_RATE,
            numbers("rateGaussianNoise", "rad/s", "Noise of the angular velocity.").or("0 0 0"),
            number("headingOffset", "rad", "Constant error of the heading.").or("0"),
            number("headingDrift", "rad", "Deviation of the drift of the heading.").or("0"),
            number("headingDriftFrequency", "Hz", "Inverse of the time of the drift.").or("0.000277778"),
            number("headingGaussianNoise", "rad", "Noise of the heading.").or("0"),
        ]
    )
    .open()
    .topics(&[publishes("imu").set_by("topicName")]),
    of_ros1!(
        "hector_gazebo_ros_gps",
        Sensor,
        Kept,
        "Publishes the geographic position of a link, with drift.",
        []
    )
    .open(),
    of_ros1!("hector_gazebo_ros_magnetic", Sensor, Kept, "Publishes the magnetic field.", [])
        .open(),
    of_ros1!("hector_gazebo_ros_sonar", Sensor, Kept, "Publishes the range of a sonar.", []).open(),
];
