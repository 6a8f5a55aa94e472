//! From a plugin's settings to a node on the graph.

use periplus_graph::{
    Durability, GraphError, History, Liveliness, Node, NodeSettings, Qos, Reliability,
    valid_node_name, valid_topic_name,
};
use periplus_plugin_specs::{Family, Interpreted, RosSettings};

use crate::Setting;

/// Makes the node of a plugin: its name, namespace and remappings from `<ros>` (or
/// `robotNamespace`), inside the namespace of its robot.
///
/// # Errors
/// When a name is not valid.
pub fn node_of(setting: &Setting<'_>, interpreted: &Interpreted) -> Result<Node, GraphError> {
    let ros = &interpreted.ros;
    if interpreted.known.family != Family::ClassicRos2 {
        // These plugins have no node of their own, and share names freely.
        return free_node(setting, &ros.node, &ros.namespace);
    }
    let mut settings = own_settings(setting, &ros.node, &ros.namespace);
    for remapping in &ros.remappings {
        settings = settings.remap(&remapping.from, &remapping.to);
    }
    setting.graph.node(settings)
}

/// A node by this name, or the same with a number when that is taken.
fn free_node(setting: &Setting<'_>, name: &str, namespace: &str) -> Result<Node, GraphError> {
    // Classes as names: `gz::sim::systems::Imu`.
    let name = name.rsplit("::").next().unwrap_or(name);
    let mut made = setting.graph.node(own_settings(setting, name, namespace));
    let mut number = 1;
    while let Err(GraphError::NodeExists { .. }) = made {
        number += 1;
        let numbered = format!("{name}_{number}");
        made = setting.graph.node(own_settings(setting, &numbered, namespace));
    }
    made
}

/// Makes a node of the robot's own, inside its namespace; with a number behind its name when that
/// is taken.
///
/// # Errors
/// When a name is not valid.
pub fn plain_node(setting: &Setting<'_>, name: &str) -> Result<Node, GraphError> {
    free_node(setting, name, "/")
}

fn own_settings(setting: &Setting<'_>, name: &str, namespace: &str) -> NodeSettings {
    let around = setting.namespace.trim_end_matches('/');
    let within = namespace.trim_matches('/');
    let full = if within.is_empty() { around.to_owned() } else { format!("{around}/{within}") };
    let mut settings = NodeSettings::new(valid_node_name(name)).namespace(&full);
    for rule in setting.remaps {
        settings = settings.rule(rule);
    }
    if !around.is_empty() {
        // As Nav2 has it for several robots: each with transforms of its own.
        settings = settings.remap("/tf", &format!("{around}/tf"));
        settings = settings.remap("/tf_static", &format!("{around}/tf_static"));
    }
    settings
}

/// A topic of Gazebo's as ROS allows it: `/model/pong-bot/odometry` has a minus that becomes `_`.
#[must_use]
pub fn gz_topic(name: &str) -> String {
    let name = valid_topic_name(name);
    if name.starts_with('/') { name } else { format!("/{name}") }
}

/// Quality of service of a publisher, as `<ros><qos>` changes it. `inside` is the topic's name in
/// the plugin.
#[must_use]
pub fn publisher_qos(ros: &RosSettings, inside: &str, usual: Qos) -> Qos {
    let told = ros.qos.iter().find(|topic| ros.resolve(&topic.topic) == ros.resolve(inside));
    told.and_then(|topic| topic.publisher.as_ref()).map_or(usual, |told| changed(told, usual))
}

/// Quality of service of a subscription, as `<ros><qos>` changes it.
#[must_use]
pub fn subscription_qos(ros: &RosSettings, inside: &str, usual: Qos) -> Qos {
    let told = ros.qos.iter().find(|topic| ros.resolve(&topic.topic) == ros.resolve(inside));
    told.and_then(|topic| topic.subscription.as_ref()).map_or(usual, |told| changed(told, usual))
}

/// `system` leaves a policy to the middleware, whose own is reliable, volatile, keep last.
fn changed(told: &periplus_plugin_specs::Qos, usual: Qos) -> Qos {
    let ns = |ms: u64| i64::try_from(ms).unwrap_or(i64::MAX / 1_000_000).saturating_mul(1_000_000);
    Qos {
        reliability: match told.reliability.as_deref() {
            Some("best_effort") => Reliability::BestEffort,
            Some(_) => Reliability::Reliable,
            None => usual.reliability,
        },
        durability: match told.durability.as_deref() {
            Some("transient_local") => Durability::TransientLocal,
            Some(_) => Durability::Volatile,
            None => usual.durability,
        },
        history: match told.history.as_deref() {
            Some("keep_all") => History::KeepAll,
            Some(_) => History::KeepLast,
            None => usual.history,
        },
        depth: told.depth.map_or(usual.depth, |depth| depth as usize),
        deadline_ns: told.deadline_ms.map(ns).or(usual.deadline_ns),
        lifespan_ns: told.lifespan_ms.map(ns).or(usual.lifespan_ns),
        liveliness: match told.liveliness.as_deref() {
            Some("manual_by_topic") => Liveliness::ManualByTopic,
            Some(_) => Liveliness::Automatic,
            None => usual.liveliness,
        },
        lease_ns: told.liveliness_lease_ms.map(ns).or(usual.lease_ns),
    }
}
