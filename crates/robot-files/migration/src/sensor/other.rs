//! Bumpers, satellite receivers, force-torque sensors, magnetometers.

use periplus_xml::Element;

use crate::bridge::{CONTACTS, MAGNETOMETER, NAVSAT, WRENCH};
use crate::entry::{MigrationOutcome, TopicAspect};
use crate::old_plugin::OldPlugin;
use crate::replacement::{Attached, AttachmentParent, Replacement, SensorChange, leaf};
use crate::sensor::publishing;

/// `gazebo_ros_bumper`.
pub(super) fn bumper(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Approximated);
    let topic = if plugin.is_ros1() {
        plugin.topic(&["bumperTopicName"], "bumper_states")
    } else {
        plugin.ros_topic("bumper_states")
    };
    replacement
        .sensor
        .push(SensorChange::Setting { group: "contact", element: leaf("topic", &topic) });
    replacement.bridge_to_ros(&topic, &topic, CONTACTS);
    let reason = "contacts are ros_gz_interfaces/msg/Contacts instead of gazebo_msgs/ContactsState";
    replacement.remark(reason);
    replacement.expects(&topic, TopicAspect::Type, reason);
    replacement.expects(
        &topic,
        TopicAspect::Rate,
        "gz publishes contacts in steps in which there are some",
    );
    replacement
}

/// `gazebo_ros_gps_sensor`.
pub(super) fn satellite(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let topic = plugin.ros_topic("~/out");
    replacement.sensor.push(SensorChange::Type("navsat"));
    publishing(plugin, &topic, &mut replacement);
    replacement.bridge_to_ros(&topic, &topic, NAVSAT);
    let velocity = plugin.ros_topic("~/vel");
    replacement.differs(COORDINATES);
    replacement.expects(&topic, TopicAspect::Fields, "the bridge fills no covariance");
    replacement.expects(&velocity, TopicAspect::Presence, "the velocity is not bridged separately");
    replacement
}

const COORDINATES: &str = "the world needs <spherical_coordinates>; the velocity is part of gz.msgs.NavSat, and not bridged";

/// `hector_gazebo_ros_gps`.
pub(super) fn satellite_of_body(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Approximated);
    let topic = plugin.topic(&["topicName"], "fix");
    let Some(sensor) = body_sensor(plugin, "navsat", &topic, &mut replacement) else {
        return replacement;
    };
    replacement.bridge_to_ros(&topic, &topic, NAVSAT);
    replacement.attached.push(sensor);
    let latitude = plugin.text(&["referenceLatitude"]).unwrap_or_else(|| "49.9".to_owned());
    let longitude = plugin.text(&["referenceLongitude"]).unwrap_or_else(|| "8.9".to_owned());
    replacement.remark(format!(
        "put the reference into the world: <spherical_coordinates> with <latitude_deg>{latitude}</latitude_deg> and \
         <longitude_deg>{longitude}</longitude_deg>"
    ));
    replacement.remark("drift and offsets are not converted; the velocity is not bridged");
    replacement
}

/// `hector_gazebo_ros_magnetic`.
pub(super) fn magnetometer_of_body(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Approximated);
    let topic = plugin.topic(&["topicName"], "magnetic");
    let Some(sensor) = body_sensor(plugin, "magnetometer", &topic, &mut replacement) else {
        return replacement;
    };
    replacement.attached.push(sensor);
    replacement.bridge_to_ros(&topic, &topic, MAGNETOMETER);
    replacement.remark(
        "the field is that of <magnetic_field> in the world, in tesla (sensor_msgs/msg/MagneticField); \
         drift and offsets are not converted",
    );
    replacement
}

/// Sensor for the link that a plugin names.
fn body_sensor(
    plugin: &OldPlugin<'_>,
    kind: &str,
    topic: &str,
    replacement: &mut Replacement,
) -> Option<Attached> {
    let Some(body) = plugin.text(&["bodyName"]) else {
        *replacement = Replacement::without(
            MigrationOutcome::NoCounterpart,
            "the plugin names no link (<bodyName>), so there is none for the new sensor",
        );
        return None;
    };
    let frame = plugin.frame(&["frameId", "frameName"]).unwrap_or_else(|| body.clone());
    let rate_hz = plugin.text(&["updateRate"]).unwrap_or_else(|| "10".to_owned());
    let sensor = Element::new("sensor")
        .with_attribute("name", kind)
        .with_attribute("type", kind)
        .with_child(leaf("topic", topic))
        .with_child(leaf("gz_frame_id", frame))
        .with_child(leaf("always_on", "true"))
        .with_child(leaf("update_rate", rate_hz));
    Some(Attached { parent: AttachmentParent::Link(body), sensor })
}

/// `gazebo_ros_ft_sensor`.
pub(super) fn force_torque(plugin: &OldPlugin<'_>) -> Replacement {
    let Some(joint) = plugin.text(&["jointName", "joint_name"]) else {
        return Replacement::without(
            MigrationOutcome::NoCounterpart,
            "forces on a link have no counterpart: add a force_torque sensor to a joint of it",
        );
    };
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let topic = if plugin.is_ros1() {
        plugin.topic(&["topicName"], "wrench")
    } else {
        plugin.ros_topic("wrench")
    };
    let rate_hz = plugin.text(&["updateRate", "update_rate"]).unwrap_or_else(|| "0".to_owned());
    let settings = Element::new("force_torque")
        .with_child(leaf("frame", "child"))
        .with_child(leaf("measure_direction", "child_to_parent"));
    let sensor = Element::new("sensor")
        .with_attribute("name", "force_torque")
        .with_attribute("type", "force_torque")
        .with_child(leaf("topic", &topic))
        .with_child(leaf("always_on", "true"))
        .with_child(leaf("update_rate", rate_hz))
        .with_child(settings);
    replacement.attached.push(Attached { parent: AttachmentParent::Joint(joint), sensor });
    replacement.bridge_to_ros(&topic, &topic, WRENCH);
    if plugin.surroundings.is_urdf {
        replacement.remark(
            "a fixed joint keeps its sensor only with <preserveFixedJoint>true</preserveFixedJoint>",
        );
    }
    replacement.expects(&topic, TopicAspect::Frame, "the frame is the child link of the joint");
    replacement
}
