//! Publishing settings of a sensor: those of a plugin, or Gazebo's defaults.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::Message;
use periplus_plugin_specs::{Family, InterpretedPlugin, Role, Support, interpret, topics};

use super::SensorContext;
use crate::{device_node, plugin_node, publisher_qos};

/// Conventions for topics, frames and QoS.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Convention {
    /// Plugins of Classic for ROS 1.
    Ros1,
    /// Plugins of Classic for ROS 2.
    Ros2,
    /// Gazebo, bridged to ROS 2.
    Gz,
}

/// Publishing settings of a sensor.
pub(super) struct SensorPort {
    pub(super) convention: Convention,
    pub(super) node: Node,
    plugin: Option<InterpretedPlugin>,
    /// Topics that the plugin publishes, by their names inside it, in the order of its table.
    outs: Vec<String>,
    /// Frame of the messages.
    pub(super) frame: String,
}

/// Returns one port per publishing plugin of a sensor; without plugins, one port with Gazebo's
/// defaults.
pub(super) fn ports(
    sensor_context: &SensorContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<SensorPort>, GraphError> {
    let mut ports = Vec::new();
    for site in sensor_context.sites {
        // Problems of parameters were reported when the file was checked.
        let read = interpret(site.plugin, &site.context, &mut Diagnostics::new());
        let Some(plugin) = read else { continue };
        let known = plugin.known;
        let convention = match known.family {
            Family::ClassicRos1 => Convention::Ros1,
            Family::ClassicRos2 => Convention::Ros2,
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
        let frame = sensor_context.frame_id(named, diagnostics);
        let node = plugin_node(sensor_context.setting, &plugin)?;
        ports.push(SensorPort { convention, node, plugin: Some(plugin), outs, frame });
    }
    if ports.is_empty() {
        let node = device_node(sensor_context.setting, &sensor_context.sensor.name)?;
        let frame = sensor_context.frame_id(None, diagnostics);
        ports.push(SensorPort {
            convention: Convention::Gz,
            node,
            plugin: None,
            outs: Vec::new(),
            frame,
        });
    }
    Ok(ports)
}

impl SensorPort {
    /// Returns the first topic of the plugin, or Gazebo's topic with its suffix (`/scan`).
    pub(super) fn topic(&self, sensor_context: &SensorContext<'_>, suffix: &str) -> String {
        self.outs.first().cloned().unwrap_or_else(|| sensor_context.gz_topic(suffix))
    }

    /// Returns a topic of the plugin by its index in the table.
    pub(super) fn out(&self, place: usize) -> Option<&str> {
        self.outs.get(place).map(String::as_str)
    }

    /// Returns the default quality of service: ROS 2 plugins keep five and are reliable
    /// (`SensorDataQoS().reliable()`), ROS 1 queues one, the bridge keeps ten.
    pub(super) fn fallback(&self) -> Qos {
        match self.convention {
            Convention::Ros1 => Qos::reliable(1),
            Convention::Ros2 => Qos::reliable(5),
            Convention::Gz => Qos::reliable(10),
        }
    }

    /// Creates a publisher with the default quality of service unless `<ros><qos>` changes it.
    pub(super) fn publisher<T: Message>(&self, topic: &str) -> Result<Publisher<T>, GraphError> {
        self.publisher_with(topic, self.fallback())
    }

    pub(super) fn publisher_with<T: Message>(
        &self,
        topic: &str,
        fallback: Qos,
    ) -> Result<Publisher<T>, GraphError> {
        let qos = match &self.plugin {
            Some(plugin) => publisher_qos(&plugin.ros, topic, fallback),
            None => fallback,
        };
        self.node.publisher(topic, qos)
    }

    /// Returns the rate of a ROS 1 plugin [Hz].
    pub(super) fn rate_hz(&self) -> Option<f64> {
        let names = ["updateRate", "updateRateHZ"];
        let asked = names.into_iter().find_map(|name| self.given(name));
        asked.filter(|rate_hz| *rate_hz > 0.0)
    }

    /// Returns a number that the file contains.
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

    /// Returns a number or its default; 0 where the plugin has no such parameter.
    pub(super) fn number(&self, name: &str) -> f64 {
        let known = self.plugin.as_ref().filter(|_| self.has(name));
        known.and_then(|plugin| plugin.values.number(name)).unwrap_or_default()
    }

    pub(super) fn numbers(&self, name: &str) -> Vec<f64> {
        let known = self.plugin.as_ref().filter(|_| self.has(name));
        known.map(|plugin| plugin.values.numbers(name)).unwrap_or_default()
    }

    /// Returns the plugin's topic with this suffix.
    pub(super) fn out_named(&self, end: &str) -> Option<&str> {
        self.outs.iter().map(String::as_str).find(|topic| topic.ends_with(end))
    }
}
