//! Settings of a control plugin: names, parameter files, release and write rule.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Arguments, Graph, GraphError, Node, NodeSettings, valid_node_name};
use periplus_msgs::rcl_interfaces::{ParameterType, ParameterValue};
use periplus_params::ParamValue;
use periplus_ros2_control::ControlRelease;

use super::parameter_files::{ParameterFiles, arguments};
use crate::drives::BuildContext;

/// Parameters by name.
pub(super) type GivenParameters = BTreeMap<String, ParameterValue>;

/// Rule by which commands move joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WriteRule {
    /// `gz_ros2_control`: positions by speeds.
    Gz {
        /// Speed for a position error, relative to the update rate.
        position_gain: f64,
        /// True if joints without a controller are held.
        holds: bool,
    },
    /// Gazebo Classic: positions are set.
    Classic,
}

/// Names and parameters of a plugin's nodes.
#[derive(Clone)]
pub(super) struct ControlPlugin {
    pub(super) graph: Graph,
    pub(super) release: ControlRelease,
    pub(super) write_rule: WriteRule,
    pub(super) manager_name: String,
    /// Namespace in the plugin, without a slash at the end; empty for none.
    pub(super) namespace: String,
    pub(super) files: Arc<dyn ParameterFiles>,
    /// Namespace of the robot in this run, without a slash at the end; empty for none.
    around: String,
    /// True to put absolute names into that namespace, too.
    is_confined: bool,
    remaps: Vec<String>,
    /// Parameter files and remappings of the plugin.
    arguments: Arguments,
}

impl ControlPlugin {
    /// Reads the settings; problems of parameter files are reported.
    pub(super) fn read(context: &BuildContext<'_>, diagnostics: &mut Diagnostics) -> Self {
        let setting = context.setting;
        let written = context.site.plugin;
        let (release, write_rule) = match context.plugin.known.id {
            "gazebo_ros_control" => (ControlRelease::Noetic, WriteRule::Classic),
            "gazebo_ros2_control" => (ControlRelease::Humble, WriteRule::Classic),
            _ => {
                let is_fortress = [&written.name, &written.filename]
                    .iter()
                    .any(|name| name.contains("ign_ros2_control") || name.contains("IgnitionROS2"));
                let release =
                    if is_fortress { ControlRelease::Humble } else { ControlRelease::Jazzy };
                let rule = WriteRule::Gz {
                    position_gain: context.number("position_proportional_gain"),
                    holds: context.flag("hold_joints"),
                };
                (release, rule)
            }
        };
        let mut words = Vec::new();
        if !release.is_ros1() {
            for (value, _) in context.plugin.values.all("parameters") {
                if let ParamValue::Text(path) = value
                    && !path.trim().is_empty()
                {
                    words.extend(["--params-file".to_owned(), path.trim().to_owned()]);
                }
            }
        }
        let ros = &context.plugin.ros;
        for remapping in &ros.remappings {
            words.extend(["-r".to_owned(), format!("{}:={}", remapping.from, remapping.to)]);
        }
        let (arguments, problems) = arguments(&words, &**setting.parameter_files);
        for problem in problems {
            let message = format!("plugin `{}`: {problem}", written.name);
            diagnostics
                .push(Diagnostic::error("controller-parameters", message).at(context.origin()));
        }
        let manager_name = match context.plugin.known.id {
            "gz_ros2_control-system" => context.text("controller_manager_name"),
            _ => "controller_manager".to_owned(),
        };
        Self {
            graph: setting.graph.clone(),
            release,
            write_rule,
            manager_name: valid_node_name(&manager_name),
            namespace: slashed(&ros.namespace),
            files: Arc::clone(setting.parameter_files),
            around: slashed(setting.namespace),
            is_confined: setting.is_confined,
            remaps: setting.remaps.to_vec(),
            arguments,
        }
    }

    /// Returns the full name of a node of the plugin.
    pub(super) fn full_name(&self, node: &str) -> String {
        format!("{}{}/{node}", self.around, self.namespace)
    }

    /// Returns the parameters that the plugin's files and the arguments of the run give to a node.
    pub(super) fn parameters_of(&self, node: &str) -> GivenParameters {
        let mut given = self.graph.parameters_given_to(&self.full_name(node));
        given.extend(self.arguments.parameters_of(&format!("{}/{node}", self.namespace)));
        if !self.around.is_empty() {
            given.extend(self.arguments.parameters_of(&self.full_name(node)));
        }
        given
    }

    /// Returns the controllers of the plugin's files, and of the arguments of the run, with their classes, by name.
    pub(super) fn declared_controllers(&self) -> BTreeMap<String, String> {
        let mut found = BTreeMap::new();
        for (name, value) in self.parameters_of(&self.manager_name) {
            if let Some(controller) = name.strip_suffix(".type").filter(|it| !it.contains('.')) {
                found.insert(controller.to_owned(), value.string_value.trim().to_owned());
            }
        }
        let of_run = self.graph.arguments();
        for (pattern, _) in self.arguments.parameters().chain(of_run.parameters()) {
            let node = pattern.rsplit('/').next().unwrap_or_default();
            if node.contains('*') || node.is_empty() {
                continue;
            }
            if let Some(class) = text_of(&self.parameters_of(node), "type") {
                found.entry(node.to_owned()).or_insert(class);
            }
        }
        found
    }

    /// Creates a node of the plugin: the manager with `any` parameters, or a controller.
    pub(super) fn node(
        &self,
        name: &str,
        extra: &Arguments,
        given: &GivenParameters,
        any: bool,
    ) -> Result<Node, GraphError> {
        let mut number = 1;
        loop {
            let numbered = if number == 1 { name.to_owned() } else { format!("{name}_{number}") };
            let namespace = format!("{}{}", self.around, self.namespace);
            let mut settings = NodeSettings::new(valid_node_name(&numbered))
                .reads("type")
                .namespace(&namespace)
                .with_arguments(extra)
                .with_arguments(&self.arguments);
            for rule in &self.remaps {
                settings = settings.rule(rule);
            }
            if self.is_confined {
                settings = settings.confine(&self.around);
            }
            if !self.around.is_empty() {
                settings = settings.remap("/tf", &format!("{}/tf", self.around));
                settings = settings.remap("/tf_static", &format!("{}/tf_static", self.around));
            }
            for (name, value) in given {
                settings = settings.parameter(name, value.clone());
            }
            if any {
                settings = settings.any_parameters();
            }
            match self.graph.node(settings) {
                Err(GraphError::NodeExists { .. }) if number < 1000 => number += 1,
                made => return made,
            }
        }
    }
}

/// Returns a namespace with a slash before it; empty for none.
fn slashed(namespace: &str) -> String {
    let within = namespace.trim_matches('/');
    if within.is_empty() { String::new() } else { format!("/{within}") }
}

/// Returns a text among parameters.
pub(super) fn text_of(given: &GivenParameters, name: &str) -> Option<String> {
    let value = given.get(name).filter(|value| value.r#type == ParameterType::PARAMETER_STRING)?;
    Some(value.string_value.trim().to_owned()).filter(|text| !text.is_empty())
}

/// Returns texts among parameters: a list, or one text.
pub(super) fn texts_of(given: &GivenParameters, name: &str) -> Vec<String> {
    match given.get(name) {
        Some(value) if value.r#type == ParameterType::PARAMETER_STRING_ARRAY => {
            value.string_array_value.clone()
        }
        _ => text_of(given, name).into_iter().collect(),
    }
}
