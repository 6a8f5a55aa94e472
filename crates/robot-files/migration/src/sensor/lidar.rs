//! Lidars and range finders.

use crate::bridge::{CLOUD, SCAN};
use crate::entry::{MigrationOutcome, TopicAspect};
use crate::old_plugin::OldPlugin;
use crate::replacement::{Replacement, SensorChange};
use crate::sensor::publishing;
use crate::template;

/// Difference of the geometry.
pub(super) const GEOMETRY: &str = "a `ray` sensor measures collisions on the CPU; gz-sim has lidars on the GPU only, which measure \
                                   visuals: where a visual differs from its collision, ranges differ";

/// Message of a lidar plugin.
enum OldMessage {
    Scan,
    Cloud,
    OldCloud,
    Range,
}

pub(super) fn plugin(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let (topic, message) = match plugin.library().as_str() {
        "gazebo_ros_ray_sensor" => {
            let topic = plugin.ros_topic("~/out");
            let kind = plugin.text(&["output_type"]).unwrap_or_default();
            let message = match kind.as_str() {
                "sensor_msgs/LaserScan" => OldMessage::Scan,
                "sensor_msgs/PointCloud" => OldMessage::OldCloud,
                "sensor_msgs/Range" => OldMessage::Range,
                kind if template::is_template(kind) => {
                    replacement
                        .differs("the type of the messages is an expression: scans are bridged");
                    OldMessage::Scan
                }
                _ => OldMessage::Cloud,
            };
            (topic, message)
        }
        "gazebo_ros_block_laser" => (plugin.topic(&["topicName"], "/world"), OldMessage::OldCloud),
        "gazebo_ros_range" => (plugin.topic(&["topicName"], "/range"), OldMessage::Range),
        _ => (plugin.topic(&["topicName"], "/world"), OldMessage::Scan),
    };
    replacement.sensor.push(SensorChange::Type("gpu_lidar"));
    publishing(plugin, &topic, &mut replacement);
    match message {
        OldMessage::Scan => {
            replacement.bridge_to_ros(&topic, &topic, SCAN);
            if plugin.is_ros1() {
                replacement.expects(
                    &topic,
                    TopicAspect::Fields,
                    "gazebo_ros_laser put all rows of beams into one scan; a LaserScan of gz has the middle row",
                );
            }
        }
        OldMessage::Cloud => cloud(plugin, &topic, &mut replacement),
        OldMessage::OldCloud => {
            cloud(plugin, &topic, &mut replacement);
            replacement
                .differs("the cloud is sensor_msgs/PointCloud2 instead of the old PointCloud");
            replacement.expects(
                &topic,
                TopicAspect::Type,
                "the bridge has no sensor_msgs/PointCloud",
            );
        }
        OldMessage::Range => {
            replacement.bridge_to_ros(&topic, &topic, SCAN);
            let reason = "the bridge has no sensor_msgs/Range: the beams arrive as sensor_msgs/LaserScan, \
                          whose smallest range is the old value";
            replacement.differs(reason);
            replacement.expects(&topic, TopicAspect::Type, reason);
        }
    }
    if plugin.is_nonzero(&["min_intensity", "hokuyoMinIntensity"]) {
        replacement.differs("a minimum of intensities has no counterpart");
        replacement.expects(
            &topic,
            TopicAspect::Fields,
            "a minimum of intensities has no counterpart",
        );
    }
    replacement
}

fn cloud(plugin: &OldPlugin<'_>, topic: &str, replacement: &mut Replacement) {
    replacement.bridge_to_ros(topic, &format!("{topic}/points"), CLOUD);
    let reason = "the cloud of gz has all beams in rows (also infinite ones) and the field `ring`; the \
                  old one had the returns only";
    replacement.remark(reason);
    replacement.expects(topic, TopicAspect::Fields, reason);
    if plugin.is_ros1() {
        replacement.expects(topic, TopicAspect::Fields, reason);
    }
}
