//! The `<ros>` element of ROS 2 plugins.

use periplus_diagnostics::Origin;
use periplus_scene::{Element, Plugin};

/// Settings of a plugin's node in `<ros>`.
///
/// Source: `gazebo_ros/src/node.cpp` and `qos.cpp` of `gazebo_ros_pkgs`, branch `ros2`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RosSettings {
    /// Name of the node: the plugin's `name`.
    pub node: String,
    /// Namespace with a leading slash; `/` is the global namespace.
    pub namespace: String,
    /// `<remapping>` elements, in order.
    pub remappings: Vec<Remapping>,
    /// `<parameter>` elements, in order.
    pub parameters: Vec<RosParameter>,
    /// `<argument>` elements, in order.
    pub arguments: Vec<String>,
    /// QoS by topic, in order.
    pub qos: Vec<TopicQos>,
}

/// `from:=to`.
#[derive(Clone, Debug, PartialEq)]
pub struct Remapping {
    /// The name in the plugin.
    pub from: String,
    /// Name on the network.
    pub to: String,
    /// Source location.
    pub origin: Origin,
}

/// `<parameter name="" type="">value</parameter>`.
#[derive(Clone, Debug, PartialEq)]
pub struct RosParameter {
    /// Its name.
    pub name: String,
    /// `int`, `double`, `float`, `bool` or `string`.
    pub type_name: String,
    /// Its value as written.
    pub value: String,
    /// Source location.
    pub origin: Origin,
}

/// QoS of one topic.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicQos {
    /// The topic.
    pub topic: String,
    /// QoS of publishers.
    pub publisher: Option<QosPolicies>,
    /// QoS of subscriptions.
    pub subscription: Option<QosPolicies>,
}

/// QoS policies as written; `None` keeps the plugin's own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QosPolicies {
    /// `system`, `reliable` or `best_effort`.
    pub reliability: Option<String>,
    /// `system`, `volatile` or `transient_local`.
    pub durability: Option<String>,
    /// `system`, `keep_last` or `keep_all`.
    pub history: Option<String>,
    /// History depth for `keep_last`.
    pub depth: Option<u32>,
    /// Maximum time between messages, in milliseconds.
    pub deadline_ms: Option<u64>,
    /// Time after which a message expires, in milliseconds.
    pub lifespan_ms: Option<u64>,
    /// `system`, `automatic` or `manual_by_topic`.
    pub liveliness: Option<String>,
    /// Time after which a silent publisher is considered lost, in milliseconds.
    pub liveliness_lease_ms: Option<u64>,
}

impl RosSettings {
    /// Reads the `<ros>` element of a plugin; without one, returns default settings.
    #[must_use]
    pub fn read(plugin: &Plugin) -> Self {
        let mut settings =
            Self { node: plugin.name.clone(), namespace: "/".into(), ..Self::default() };
        let Some(ros) = plugin.content.iter().find(|element| element.name == "ros") else {
            return settings;
        };
        if let Some(namespace) = ros.child("namespace") {
            settings.namespace = absolute(&namespace.text());
        }
        for element in ros.named("remapping") {
            if let Some((from, to)) = element.text().split_once(":=") {
                settings.remappings.push(Remapping {
                    from: from.trim().to_owned(),
                    to: to.trim().to_owned(),
                    origin: element.origin,
                });
            }
        }
        for element in ros.named("parameter") {
            settings.parameters.push(RosParameter {
                name: element.value("name").unwrap_or_default().to_owned(),
                type_name: element.value("type").unwrap_or_default().to_owned(),
                value: element.text().into_owned(),
                origin: element.origin,
            });
        }
        settings.arguments =
            ros.named("argument").map(|element| element.text().into_owned()).collect();
        for topic in ros.child("qos").into_iter().flat_map(|qos| qos.named("topic")) {
            settings.qos.push(TopicQos {
                topic: topic.value("name").unwrap_or_default().to_owned(),
                publisher: topic.child("publisher").map(read_qos),
                subscription: topic.child("subscription").map(read_qos),
            });
        }
        settings
    }

    /// Settings of a ROS 1 plugin, which has only a namespace.
    #[must_use]
    pub(crate) fn ros1(plugin: &Plugin) -> Self {
        let namespace = plugin.value("robotNamespace").unwrap_or_default();
        Self { node: plugin.name.clone(), namespace: absolute(&namespace), ..Self::default() }
    }

    /// Full name of a topic with remappings applied: `~/out` of the node `scan` in the namespace `demo` is
    /// `/demo/scan/out`.
    #[must_use]
    pub fn resolve(&self, name: &str) -> String {
        let full = self.expand(name);
        match self.remappings.iter().find(|remapping| self.expand(&remapping.from) == full) {
            Some(remapping) => self.expand(&remapping.to),
            None => full,
        }
    }

    fn expand(&self, name: &str) -> String {
        let namespace = self.namespace.trim_end_matches('/');
        match name.strip_prefix('~') {
            Some(rest) => {
                let rest = rest.trim_start_matches('/');
                let node = &self.node;
                format!("{namespace}/{node}{}{rest}", if rest.is_empty() { "" } else { "/" })
            }
            None if name.starts_with('/') => name.to_owned(),
            None => format!("{namespace}/{name}"),
        }
    }
}

fn absolute(namespace: &str) -> String {
    format!("/{}", namespace.trim().trim_matches('/'))
}

fn read_qos(element: &Element) -> QosPolicies {
    let word = |name: &str| element.child(name).map(|child| child.text().into_owned());
    let milliseconds = |name: &str| word(name).and_then(|text| text.parse().ok());
    QosPolicies {
        reliability: word("reliability"),
        durability: word("durability"),
        history: word("history"),
        depth: element
            .child("history")
            .and_then(|history| history.value("depth"))
            .and_then(|depth| depth.trim().parse().ok()),
        deadline_ms: milliseconds("deadline"),
        lifespan_ms: milliseconds("lifespan"),
        liveliness: word("liveliness"),
        liveliness_lease_ms: milliseconds("liveliness_lease_duration"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::plugin;

    #[test]
    fn names_are_resolved_as_ros_does() {
        let plugin = plugin(
            "<plugin name='scan' filename='libgazebo_ros_ray_sensor.so'><ros>
               <namespace>demo</namespace>
               <remapping>~/out:=front/scan</remapping>
               <remapping>odom:=/odom</remapping>
               <remapping>nonsense</remapping>
             </ros></plugin>",
        );
        let settings = RosSettings::read(&plugin);
        assert_eq!(settings.resolve("cmd_vel"), "/demo/cmd_vel");
        assert_eq!(settings.resolve("~/out"), "/demo/front/scan");
        assert_eq!(settings.resolve("~/other"), "/demo/scan/other");
        assert_eq!(settings.resolve("odom"), "/odom");
        assert_eq!(settings.resolve("/tf"), "/tf");
        assert_eq!(settings.remappings.len(), 2);
    }

    #[test]
    fn parameters_and_qos_are_read() {
        let plugin = plugin(
            "<plugin name='p' filename='f'><ros>
               <parameter name='rate' type='double'>5.0</parameter>
               <qos><topic name='~/out'><publisher>
                 <reliability>best_effort</reliability><history depth='7'>keep_last</history>
                 <deadline>20</deadline>
               </publisher></topic></qos>
             </ros></plugin>",
        );
        let settings = RosSettings::read(&plugin);
        assert_eq!(settings.namespace, "/");
        assert_eq!(settings.resolve("scan"), "/scan");
        assert_eq!(settings.parameters[0].value, "5.0");
        let qos = settings.qos[0].publisher.clone().unwrap();
        assert_eq!(qos.reliability.as_deref(), Some("best_effort"));
        assert_eq!((qos.depth, qos.deadline_ms), (Some(7), Some(20)));
        assert_eq!(settings.qos[0].subscription, None);
    }
}
