//! Inertial measurement units.

use periplus_xml::Element;

use crate::bridge::IMU;
use crate::entry::{MigrationOutcome, TopicAspect};
use crate::old_plugin::{Flag, OldPlugin};
use crate::replacement::{Attached, AttachmentParent, Replacement, SensorChange, leaf};
use crate::sensor::{gaussian, publishing};

/// `gazebo_ros_imu_sensor`.
pub(super) fn plugin(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let topic = if plugin.is_ros1() {
        plugin.topic(&["topicName"], "/default_imu")
    } else {
        plugin.ros_topic("~/out")
    };
    publishing(plugin, &topic, &mut replacement);
    replacement.bridge_to_ros(&topic, &topic, IMU);
    let names = ["initial_orientation_as_reference", "initialOrientationAsReference"];
    match plugin.flag(&names, false) {
        Flag::Yes => {}
        unknown_or_no => {
            replacement
                .sensor
                .push(SensorChange::Setting { group: "imu", element: world_reference() });
            if matches!(unknown_or_no, Flag::Unknown(_)) {
                replacement
                    .differs("the reference of orientations is an expression: the world is used");
            }
        }
    }
    if plugin.is_ros1() && plugin.is_nonzero(&["gaussianNoise"]) {
        let stddev = plugin.text(&["gaussianNoise"]).unwrap_or_default();
        for element in
            noises(&[(stddev.clone(), "angular_velocity"), (stddev, "linear_acceleration")])
        {
            replacement.sensor.push(SensorChange::Setting { group: "imu", element });
        }
    }
    if plugin.is_nonzero(&["xyzOffset", "rpyOffset"]) {
        replacement.differs(
            "the offset of the plugin has no counterpart: put it into the <pose> of the sensor",
        );
        replacement.expects(
            &topic,
            TopicAspect::Values,
            "the offset of the plugin has no counterpart",
        );
    }
    replacement.expects(&topic, TopicAspect::Fields, COVARIANCE);
    replacement
}

const COVARIANCE: &str = "the bridge fills the covariances of gz-sensors 8, which are zero";

/// Orientation in the world, as REP 145 requires, instead of the initial one.
fn world_reference() -> Element {
    Element::new("orientation_reference_frame").with_child(leaf("localization", "ENU"))
}

/// Noise of all three axes of some quantities.
fn noises(quantities: &[(String, &str)]) -> Vec<Element> {
    let axes = |stddev: &str, name: &str| {
        let mut axes = Element::new(name);
        for axis in ["x", "y", "z"] {
            axes.push(Element::new(axis).with_child(gaussian(stddev)));
        }
        axes
    };
    quantities.iter().map(|(stddev, name)| axes(stddev, name)).collect()
}

/// `gazebo_ros_imu` and `hector_gazebo_ros_imu`: plugins of the model that measure a link.
pub(super) fn of_body(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let is_hector = plugin.library() == "hector_gazebo_ros_imu";
    let topic = plugin.topic(&["topicName"], if is_hector { "imu" } else { "/default_imu" });
    let Some(body) = plugin.text(&["bodyName"]) else {
        return Replacement::without(
            MigrationOutcome::NoCounterpart,
            "the plugin names no link (<bodyName>), so there is none for the new sensor",
        );
    };
    let frame = plugin.frame(&["frameName", "frameId"]).unwrap_or_else(|| body.clone());
    let mut sensor =
        Element::new("sensor").with_attribute("name", "imu").with_attribute("type", "imu");
    sensor.push(leaf("topic", &topic));
    sensor.push(leaf("gz_frame_id", &frame));
    sensor.push(leaf("always_on", "true"));
    let rate_hz = plugin.text(&["updateRate"]).unwrap_or_else(|| "0".to_owned());
    sensor.push(leaf("update_rate", rate_hz));
    let mut imu = Element::new("imu");
    let turn = three(plugin, &["rateGaussianNoise", "gaussianNoise"]);
    let push = three(plugin, &["accelGaussianNoise", "gaussianNoise"]);
    for (name, stddevs) in [("angular_velocity", turn), ("linear_acceleration", push)] {
        let Some(stddevs) = stddevs else { continue };
        let mut axes = Element::new(name);
        for (axis, stddev) in ["x", "y", "z"].into_iter().zip(&stddevs) {
            axes.push(Element::new(axis).with_child(gaussian(stddev)));
        }
        imu.push(axes);
    }
    imu.push(world_reference());
    sensor.push(imu);
    replacement.attached.push(Attached { parent: AttachmentParent::Link(body), sensor });
    replacement.bridge_to_ros(&topic, &topic, IMU);
    replacement.expects(&topic, TopicAspect::Fields, COVARIANCE);
    if is_hector {
        replacement.differs(
            "the drift of hector's IMU is not converted: gz has <dynamic_bias_stddev> and \
             <dynamic_bias_correlation_time> in each <noise>",
        );
        replacement.expects(
            &topic,
            TopicAspect::Values,
            "the drift and heading noise of hector's IMU are not converted",
        );
    }
    if plugin.is_nonzero(&["gaussianNoise"]) {
        replacement.expects(&topic, TopicAspect::Values, "noise of another sensor is other noise");
    }
    if plugin.is_nonzero(&["xyzOffset", "rpyOffset"]) {
        replacement
            .differs("the offset of the plugin has no counterpart: give the sensor a <pose>");
        replacement.expects(
            &topic,
            TopicAspect::Values,
            "the offset of the plugin has no counterpart",
        );
    }
    replacement
}

/// Standard deviations of three axes, from a parameter of one or three numbers; `None` without noise.
fn three(plugin: &OldPlugin<'_>, names: &[&str]) -> Option<[String; 3]> {
    if !plugin.is_nonzero(names) {
        return None;
    }
    let text = plugin.text(names)?;
    let parts: Vec<&str> = text.split_whitespace().collect();
    match parts.as_slice() {
        [x, y, z] => Some([x, y, z].map(|part| (*part).to_owned())),
        _ => Some([text.clone(), text.clone(), text]),
    }
}
