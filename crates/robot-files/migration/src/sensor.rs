//! Sensors of Gazebo Classic, and the plugins that publish their data.

mod camera;
mod inertial;
mod lidar;
mod other;

use periplus_xml::Element;

use crate::entry::{ExpectedDifference, MigrationOutcome, TopicAspect};
use crate::old_plugin::OldPlugin;
use crate::replacement::{Replacement, SensorChange, leaf};
use crate::template;

/// Replacement of a plugin in a sensor.
pub(crate) fn plugin(plugin: &OldPlugin<'_>) -> Replacement {
    match plugin.library().as_str() {
        "gazebo_ros_ray_sensor"
        | "gazebo_ros_laser"
        | "gazebo_ros_gpu_laser"
        | "gazebo_ros_block_laser"
        | "gazebo_ros_range" => lidar::plugin(plugin),
        "gazebo_ros_camera"
        | "gazebo_ros_depth_camera"
        | "gazebo_ros_openni_kinect"
        | "gazebo_ros_triggered_camera"
        | "gazebo_ros_prosilica"
        | "gazebo_ros_multicamera"
        | "gazebo_ros_triggered_multicamera" => camera::plugin(plugin),
        "gazebo_ros_imu_sensor" => inertial::plugin(plugin),
        "gazebo_ros_gps_sensor" => other::satellite(plugin),
        "gazebo_ros_bumper" => other::bumper(plugin),
        _ => Replacement::without(
            MigrationOutcome::NoCounterpart,
            "the sensor publishes on its Gazebo topic without a plugin; what this plugin did with \
             the data must be done by a node",
        ),
    }
}

/// Replacement of a plugin of a model that contains a sensor.
pub(crate) fn of_body(plugin: &OldPlugin<'_>) -> Replacement {
    match plugin.library().as_str() {
        "gazebo_ros_imu" | "hector_gazebo_ros_imu" => inertial::of_body(plugin),
        "gazebo_ros_ft_sensor" => other::force_torque(plugin),
        "hector_gazebo_ros_gps" => other::satellite_of_body(plugin),
        _ => other::magnetometer_of_body(plugin),
    }
}

/// Type of a sensor in current Gazebo, with a remark about the difference; `None` if it stays.
pub(crate) fn new_type(old: &str) -> Option<(&'static str, &'static str)> {
    Some(match old {
        "ray" => ("gpu_lidar", lidar::GEOMETRY),
        "lidar" => ("gpu_lidar", "gz-sim simulates lidars on the GPU only"),
        "gpu_ray" => ("gpu_lidar", ""),
        "depth" => ("depth_camera", ""),
        "gps" => ("navsat", ""),
        "wideanglecamera" => ("wide_angle_camera", ""),
        _ => return None,
    })
}

/// Reason why gz-sim does not simulate a sensor of this type.
pub(crate) fn missing_type(old: &str) -> Option<&'static str> {
    Some(match old {
        "sonar" => "gz-sim has no sonar; a gpu_lidar with a few beams measures the nearest range",
        "rfid" | "rfidtag" => "gz-sim has no RFID sensors",
        "wireless_receiver" | "wireless_transmitter" => {
            "gz-sim has no wireless sensors; the system RFComms simulates ranges of radios"
        }
        _ => return None,
    })
}

/// Frame of the messages: the plugin's, else the link of the sensor.
fn frame(plugin: &OldPlugin<'_>) -> Option<String> {
    let link = plugin.surroundings.reference.map(str::to_owned);
    plugin.frame(&["frame_name", "frameName", "frameId"]).or(link)
}

/// Topic and frame of a sensor, and always on, since ROS subscribers do not start sensors by themselves.
fn publishing(plugin: &OldPlugin<'_>, topic: &str, replacement: &mut Replacement) {
    replacement.elements.push(leaf("topic", topic));
    if let Some(frame) = frame(plugin) {
        replacement.elements.push(leaf("gz_frame_id", frame));
    }
    let sensor = plugin.surroundings.sensor;
    if sensor.is_some_and(|sensor| sensor.child("always_on").is_none()) {
        replacement.elements.push(leaf("always_on", "true"));
    }
    limit_rate(plugin, replacement);
}

/// The rate of a ROS 1 plugin throttles its sensor.
fn limit_rate(plugin: &OldPlugin<'_>, replacement: &mut Replacement) {
    if !plugin.is_ros1() {
        return;
    }
    let Some(rate_hz) = plugin.text(&["updateRate", "updateRateHZ"]) else { return };
    if template::number(&rate_hz) == Some(0.0) {
        return;
    }
    replacement.sensor.push(SensorChange::MaxRate(rate_hz));
}

/// Gaussian noise with a standard deviation, for an axis or a sensor.
fn gaussian(stddev: &str) -> Element {
    Element::new("noise")
        .with_attribute("type", "gaussian")
        .with_child(leaf("mean", "0.0"))
        .with_child(leaf("stddev", stddev))
}

/// Topics of images and camera info of one of several cameras, and their frame.
pub(crate) fn topics_of_one(
    plugin: &OldPlugin<'_>,
    camera: &str,
) -> (String, String, Option<String>) {
    camera::topics_of_one(plugin, camera)
}

/// Expected difference of a camera info.
pub(crate) fn other_camera_info(topic: &str) -> ExpectedDifference {
    ExpectedDifference {
        topic: topic.to_owned(),
        aspect: TopicAspect::Fields,
        reason: camera::CAMERA_INFO_DIFFERENCE.to_owned(),
    }
}

/// Expected difference of noise, which is keyed by the name of the sensor.
pub(crate) fn other_noise(topic: &str) -> ExpectedDifference {
    ExpectedDifference {
        topic: topic.to_owned(),
        aspect: TopicAspect::Values,
        reason: "noise is keyed by the name of the sensor, which is new".to_owned(),
    }
}
