//! Nodes, topics and quality of service from a plugin's settings.

use periplus_graph::{
    Durability, GraphError, History, Liveliness, Node, NodeSettings, Qos, Reliability,
    valid_node_name, valid_topic_name,
};
use periplus_plugin_specs::{Family, InterpretedPlugin, RosSettings};

use crate::DeviceContext;

/// Creates the node of a plugin: its name, namespace and remappings from `<ros>` (or
/// `robotNamespace`), inside the namespace of its robot.
///
/// # Errors
/// When a name is invalid.
pub fn plugin_node(
    setting: &DeviceContext<'_>,
    interpreted: &InterpretedPlugin,
) -> Result<Node, GraphError> {
    let ros = &interpreted.ros;
    if interpreted.known.family != Family::ClassicRos2 {
        // These plugins have no separate node, and their names need not be unique.
        return unique_node(setting, &ros.node, &ros.namespace);
    }
    let mut settings = node_settings(setting, &ros.node, &ros.namespace);
    for remapping in &ros.remappings {
        settings = settings.remap(&remapping.from, &remapping.to);
    }
    setting.graph.node(settings)
}

/// Creates a node of this name, with a number appended when the name is in use.
fn unique_node(
    setting: &DeviceContext<'_>,
    name: &str,
    namespace: &str,
) -> Result<Node, GraphError> {
    // Names can be classes: `gz::sim::systems::Imu`.
    let name = name.rsplit("::").next().unwrap_or(name);
    let mut made = setting.graph.node(node_settings(setting, name, namespace));
    let mut number = 1;
    while let Err(GraphError::NodeExists { .. }) = made {
        number += 1;
        let numbered = format!("{name}_{number}");
        made = setting.graph.node(node_settings(setting, &numbered, namespace));
    }
    made
}

/// Creates a node of the robot itself, inside its namespace, with a number appended when the name is
/// in use.
///
/// # Errors
/// When a name is invalid.
pub fn device_node(setting: &DeviceContext<'_>, name: &str) -> Result<Node, GraphError> {
    unique_node(setting, name, "/")
}

fn node_settings(setting: &DeviceContext<'_>, name: &str, namespace: &str) -> NodeSettings {
    let around = setting.namespace.trim_end_matches('/');
    let within = namespace.trim_matches('/');
    let full = if within.is_empty() { around.to_owned() } else { format!("{around}/{within}") };
    let mut settings = NodeSettings::new(valid_node_name(name)).namespace(&full);
    for rule in setting.remaps {
        settings = settings.rule(rule);
    }
    if setting.is_confined {
        settings = settings.confine(around);
    }
    if !around.is_empty() {
        // As in Nav2 with several robots: each has its own transforms.
        settings = settings.remap("/tf", &format!("{around}/tf"));
        settings = settings.remap("/tf_static", &format!("{around}/tf_static"));
    }
    settings
}

/// Converts a Gazebo topic to a valid ROS name: `/model/pong-bot/odometry` has a hyphen that becomes
/// `_`.
#[must_use]
pub fn gz_topic(name: &str) -> String {
    let name = valid_topic_name(name);
    if name.starts_with('/') { name } else { format!("/{name}") }
}

/// Returns the quality of service of a publisher, modified by `<ros><qos>`. `inside` is the topic's
/// name in the plugin.
/// the plugin.
#[must_use]
pub fn publisher_qos(ros: &RosSettings, inside: &str, fallback: Qos) -> Qos {
    let overrides = ros.qos.iter().find(|topic| ros.resolve(&topic.topic) == ros.resolve(inside));
    overrides
        .and_then(|topic| topic.publisher.as_ref())
        .map_or(fallback, |overrides| changed(overrides, fallback))
}

/// Returns the quality of service of a subscription, modified by `<ros><qos>`.
#[must_use]
pub fn subscription_qos(ros: &RosSettings, inside: &str, fallback: Qos) -> Qos {
    let overrides = ros.qos.iter().find(|topic| ros.resolve(&topic.topic) == ros.resolve(inside));
    overrides
        .and_then(|topic| topic.subscription.as_ref())
        .map_or(fallback, |overrides| changed(overrides, fallback))
}

/// `system` uses the middleware's default: reliable, volatile, keep last.
fn changed(overrides: &periplus_plugin_specs::QosPolicies, fallback: Qos) -> Qos {
    let ns = |ms: u64| i64::try_from(ms).unwrap_or(i64::MAX / 1_000_000).saturating_mul(1_000_000);
    Qos {
        reliability: match overrides.reliability.as_deref() {
            Some("best_effort") => Reliability::BestEffort,
            Some(_) => Reliability::Reliable,
            None => fallback.reliability,
        },
        durability: match overrides.durability.as_deref() {
            Some("transient_local") => Durability::TransientLocal,
            Some(_) => Durability::Volatile,
            None => fallback.durability,
        },
        history: match overrides.history.as_deref() {
            Some("keep_all") => History::KeepAll,
            Some(_) => History::KeepLast,
            None => fallback.history,
        },
        depth: overrides.depth.map_or(fallback.depth, |depth| depth as usize),
        deadline_ns: overrides.deadline_ms.map(ns).or(fallback.deadline_ns),
        lifespan_ns: overrides.lifespan_ms.map(ns).or(fallback.lifespan_ns),
        liveliness: match overrides.liveliness.as_deref() {
            Some("manual_by_topic") => Liveliness::ManualByTopic,
            Some(_) => Liveliness::Automatic,
            None => fallback.liveliness,
        },
        lease_ns: overrides.liveliness_lease_ms.map(ns).or(fallback.lease_ns),
    }
}
