//! Through what a sensor publishes: a plugin, or nothing but the graph.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::Message;
use periplus_plugin_specs::{Family, Interpreted, Role, Support, interpret, topics};

use super::Post;
use crate::{node_of, plain_node, publisher_qos};

/// Whose customs a port keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// Plugins of Classic for ROS 1.
    Ros1,
    /// Plugins of Classic for ROS 2.
    Ros2,
    /// Today's Gazebo, bridged to ROS 2.
    Gz,
}

/// Through what a sensor publishes.
pub(super) struct Port {
    pub(super) style: Style,
    pub(super) node: Node,
    plugin: Option<Interpreted>,
    /// Topics that the plugin publishes, as named inside it, in the order of its table.
    outs: Vec<String>,
    /// Frame of the messages.
    pub(super) frame: String,
}

/// One port for each plugin on a sensor that publishes it; without any, one of today's Gazebo.
pub(super) fn ports(
    post: &Post<'_>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Port>, GraphError> {
    let mut ports = Vec::new();
    for site in post.sites {
        // What is wrong with a parameter was told when the file was checked.
        let read = interpret(site.plugin, &site.context, &mut Diagnostics::new());
        let Some(plugin) = read else { continue };
        let known = plugin.known;
        let style = match known.family {
            Family::ClassicRos1 => Style::Ros1,
            Family::ClassicRos2 => Style::Ros2,
            Family::Classic | Family::Gz => continue,
        };
        if known.role != Role::Sensor || known.support != Support::Simulated {
            continue;
        }
        let outs = topics(&plugin, &site.context).into_iter().map(|topic| topic.inside).collect();
        let frame_names = ["frame_name", "frameName"].into_iter();
        let named = frame_names
            .filter(|name| plugin.values.table().find(name).is_some())
            .find(|name| plugin.values.is_given(name))
            .and_then(|name| plugin.values.text(name))
            .filter(|text| !text.is_empty());
        let frame = post.frame_id(named, diagnostics);
        let node = node_of(post.setting, &plugin)?;
        ports.push(Port { style, node, plugin: Some(plugin), outs, frame });
    }
    if ports.is_empty() {
        let node = plain_node(post.setting, &post.sensor.name)?;
        let frame = post.frame_id(None, diagnostics);
        ports.push(Port { style: Style::Gz, node, plugin: None, outs: Vec::new(), frame });
    }
    Ok(ports)
}

impl Port {
    /// The first topic of the plugin, or the one of today's Gazebo with its suffix (`/scan`).
    pub(super) fn topic(&self, post: &Post<'_>, suffix: &str) -> String {
        self.outs.first().cloned().unwrap_or_else(|| post.gz_topic(suffix))
    }

    /// A topic of the plugin by its place in the table.
    pub(super) fn out(&self, place: usize) -> Option<&str> {
        self.outs.get(place).map(String::as_str)
    }

    /// The usual quality of service: ROS 2 plugins keep five and are reliable
    /// (`SensorDataQoS().reliable()`), ROS 1 queues one, the bridge keeps ten.
    pub(super) fn usual(&self) -> Qos {
        match self.style {
            Style::Ros1 => Qos::reliable(1),
            Style::Ros2 => Qos::reliable(5),
            Style::Gz => Qos::reliable(10),
        }
    }

    /// Publishes on a topic, with the usual quality of service unless `<ros><qos>` has another.
    pub(super) fn publisher<T: Message>(&self, topic: &str) -> Result<Publisher<T>, GraphError> {
        self.publisher_with(topic, self.usual())
    }

    pub(super) fn publisher_with<T: Message>(
        &self,
        topic: &str,
        usual: Qos,
    ) -> Result<Publisher<T>, GraphError> {
        let qos = match &self.plugin {
            Some(plugin) => publisher_qos(&plugin.ros, topic, usual),
            None => usual,
        };
        self.node.publisher(topic, qos)
    }

    /// The rate that a plugin of ROS 1 asks for [Hz].
    pub(super) fn rate_hz(&self) -> Option<f64> {
        let names = ["updateRate", "updateRateHZ"];
        let asked = names.into_iter().find_map(|name| self.given(name));
        asked.filter(|rate_hz| *rate_hz > 0.0)
    }

    /// A number that somebody wrote.
    pub(super) fn given(&self, name: &str) -> Option<f64> {
        let plugin = self.plugin.as_ref()?;
        plugin.values.table().find(name).filter(|_| plugin.values.is_given(name))?;
        plugin.values.number(name)
    }

    pub(super) fn flag(&self, name: &str) -> bool {
        let known = self.plugin.as_ref().filter(|it| it.values.table().find(name).is_some());
        known.and_then(|plugin| plugin.values.flag(name)).unwrap_or_default()
    }

    pub(super) fn text(&self, name: &str) -> String {
        let known = self.plugin.as_ref().filter(|it| it.values.table().find(name).is_some());
        known.and_then(|plugin| plugin.values.text(name)).unwrap_or_default()
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.plugin.as_ref().is_some_and(|it| it.values.table().find(name).is_some())
    }

    /// A number with its default; 0 where the plugin has no such parameter.
    pub(super) fn number(&self, name: &str) -> f64 {
        let known = self.plugin.as_ref().filter(|_| self.has(name));
        known.and_then(|plugin| plugin.values.number(name)).unwrap_or_default()
    }

    pub(super) fn numbers(&self, name: &str) -> Vec<f64> {
        let known = self.plugin.as_ref().filter(|_| self.has(name));
        known.map(|plugin| plugin.values.numbers(name)).unwrap_or_default()
    }

    /// The topic of the plugin that ends so.
    pub(super) fn out_named(&self, end: &str) -> Option<&str> {
        self.outs.iter().map(String::as_str).find(|topic| topic.ends_with(end))
    }
}
