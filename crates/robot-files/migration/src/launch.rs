//! Launch files of ROS 1 with Gazebo Classic as launch files of ROS 2 in Python with `ros_gz_sim`.
//!
//! Structure and arguments are kept: `$(arg x)` becomes `LaunchConfiguration('x')`, `<group>` a `GroupAction`, `<include>` an
//! `IncludeLaunchDescription`. `gazebo_ros` is replaced by `gz_sim.launch.py`, `create` and `parameter_bridge` of `ros_gz`.

mod command;
mod nodes;
mod python;
mod ros2;
mod scan;
mod simulator;

use periplus_diagnostics::{Diagnostics, SourceFile, SourceMap};
use periplus_xml::Element;

use crate::entry::{MigrationEntry, MigrationOutcome};
use python::{ActionText, call, expression, quoted};

pub use ros2::migrate_python_launch;

/// Options of `spawn_entity.py`: old name, name in `create`, number of values of those without one.
const SPAWN_NAMES: [(&str, Option<&str>, usize); 10] = [
    ("-entity", Some("-name"), 0),
    ("-database", None, 1),
    ("-timeout", None, 1),
    ("-robot_namespace", None, 1),
    ("-reference_frame", None, 1),
    ("-gazebo_namespace", None, 1),
    ("-unpause", None, 0),
    ("-wait", None, 1),
    ("-package_to_model", None, 0),
    ("-b", None, 0),
];

/// Converted launch file.
#[derive(Clone, Debug)]
pub struct MigratedLaunch {
    /// Python source of the new launch file.
    pub text: String,
    /// Converted elements, in file order.
    pub entries: Vec<MigrationEntry>,
    /// Files of robots and worlds that it names, as `package://NAME/PATH` or paths; without those that depend on arguments
    /// without a default.
    pub references: Vec<String>,
    /// Launch files that it includes, in the same form.
    pub includes: Vec<String>,
}

/// Converts a launch file of ROS 1; `path` is its name in the report. `None` if it is not a `<launch>` in XML.
#[must_use]
pub fn migrate_launch(text: &str, path: &str) -> Option<MigratedLaunch> {
    let mut sources = SourceMap::new();
    let file = sources.add(path, text);
    let document = periplus_xml::parse(file, &sources, &mut Diagnostics::new())?;
    if document.root.name != "launch" {
        return None;
    }
    let mut launch = LaunchWriter {
        file: sources.file(file),
        entries: Vec::new(),
        defaults: Vec::new(),
        references: Vec::new(),
        includes: Vec::new(),
        needs_words: false,
        is_simulating: false,
        modules: Vec::new(),
    };
    let mut scope = Scope::default();
    let mut actions = launch.actions(&document.root, &mut scope);
    if launch.is_simulating {
        actions.push(launch.bridge());
    }
    let text = launch.module(&actions);
    launch.entries.sort_by_key(|entry| (entry.line, entry.column));
    Some(MigratedLaunch {
        text,
        entries: launch.entries,
        references: launch.references,
        includes: launch.includes,
    })
}

/// World of Gazebo Classic without anything in it.
const EMPTY_WORLD: &str = "$(find gazebo_ros)/worlds/empty.world";

/// Values that hold for the following elements of a scope.
#[derive(Clone, Debug, Default)]
struct Scope {
    /// Python expression of the robot description, and whether a node publishes it.
    description: Option<String>,
    is_published: bool,
}

struct LaunchWriter<'a> {
    file: &'a SourceFile,
    entries: Vec<MigrationEntry>,
    /// Defaults and values of arguments.
    defaults: Vec<(String, String)>,
    references: Vec<String>,
    includes: Vec<String>,
    /// True if arguments of nodes are split when they are known.
    needs_words: bool,
    /// True if the file starts or fills a simulation.
    is_simulating: bool,
    /// Names to import: module, name.
    modules: Vec<(&'static str, &'static str)>,
}

impl LaunchWriter<'_> {
    /// Imports a name.
    fn name(&mut self, module: &'static str, name: &'static str) -> &'static str {
        if !self.modules.contains(&(module, name)) {
            self.modules.push((module, name));
        }
        name
    }

    fn entry(
        &mut self,
        element: &Element,
        old: String,
        new: &str,
        outcome: MigrationOutcome,
        remarks: &[&str],
    ) {
        let position = element.origin.0.map(|span| self.file.position(span.start));
        self.entries.push(MigrationEntry {
            file: self.file.name.clone(),
            line: position.map_or(0, |position| position.line),
            column: position.map_or(0, |position| position.column),
            old,
            new: new.to_owned(),
            outcome,
            remarks: remarks.iter().map(|remark| (*remark).to_owned()).collect(),
        });
    }

    /// A text with substitutions as a Python expression.
    fn text(&mut self, text: &str) -> String {
        // The only world of Gazebo Classic's own folder that Harmonic has, too.
        let text = if text == EMPTY_WORLD { "empty.sdf" } else { text };
        let known: Vec<&str> = self.defaults.iter().map(|(name, _)| name.as_str()).collect();
        let (python, names) = expression(text, &known);
        for (module, name) in names {
            self.name(module, name);
        }
        python
    }

    /// Keyword argument of a condition.
    fn condition(&mut self, element: &Element) -> Option<String> {
        for (attribute, class) in [("if", "IfCondition"), ("unless", "UnlessCondition")] {
            if let Some(value) = element.value(attribute) {
                let class = self.name("launch.conditions", class);
                let value = self.text(value);
                return Some(format!("condition={class}({value})"));
            }
        }
        None
    }

    fn actions(&mut self, parent: &Element, scope: &mut Scope) -> Vec<ActionText> {
        let mut actions = Vec::new();
        for element in parent.elements() {
            let action = match element.name.as_str() {
                "arg" => self.argument(element),
                "param" => self.parameter(element, scope),
                "rosparam" => self.parameter_file(element),
                "node" => self.node(element, scope),
                "include" => self.include(element),
                "group" => self.group(element, scope),
                "remap" => Some(self.remapping(element)),
                "env" => Some(self.variable(element)),
                name => {
                    let old = format!("<{name}>");
                    let outcome = MigrationOutcome::NoCounterpart;
                    self.entry(element, old, "", outcome, &["launch of ROS 2 has no such element"]);
                    None
                }
            };
            actions.extend(action);
        }
        actions
    }

    fn argument(&mut self, element: &Element) -> Option<ActionText> {
        let name = element.value("name")?;
        let mut arguments = vec![quoted(name)];
        let condition = self.condition(element);
        let class = if let Some(value) = element.value("value") {
            self.defaults.push((name.to_owned(), value.to_owned()));
            arguments.push(self.text(value));
            self.name("launch.actions", "SetLaunchConfiguration")
        } else {
            // Without a default it is known, but has no value here.
            self.defaults
                .push((name.to_owned(), element.value("default").unwrap_or(UNKNOWN).to_owned()));
            if let Some(default) = element.value("default") {
                let default = self.text(default);
                arguments.push(format!("default_value={default}"));
            }
            if let Some(description) = element.value("doc") {
                arguments.push(format!("description={}", quoted(description)));
            }
            self.name("launch.actions", "DeclareLaunchArgument")
        };
        arguments.extend(condition);
        Some(call(class, arguments))
    }

    /// `<param>` outside of nodes: the robot description and simulated time have counterparts.
    fn parameter(&mut self, element: &Element, scope: &mut Scope) -> Option<ActionText> {
        let name = element.value("name").unwrap_or_default();
        let last = name.trim_start_matches('/').rsplit('/').next().unwrap_or_default().to_owned();
        if last == "use_sim_time" {
            let class = self.name("launch_ros.actions", "SetParameter");
            let value = self.text(element.value("value").unwrap_or("true"));
            self.entry(
                element,
                format!("param {name}"),
                "SetParameter",
                MigrationOutcome::Converted,
                &[],
            );
            return Some(call(class, vec!["'use_sim_time'".to_owned(), value]));
        }
        if last == "robot_description"
            && let Some(description) = self.description(element)
        {
            scope.description = Some(description);
            scope.is_published = false;
            let remark =
                "it is a parameter of robot_state_publisher, which publishes it as a topic";
            let outcome = MigrationOutcome::Converted;
            self.entry(element, format!("param {name}"), "robot_description", outcome, &[remark]);
            return None;
        }
        let remark = "ROS 2 has no global parameters: give it to the nodes that read it";
        self.entry(
            element,
            format!("param {name}"),
            "",
            MigrationOutcome::NoCounterpart,
            &[remark],
        );
        None
    }

    fn parameter_file(&mut self, element: &Element) -> Option<ActionText> {
        let file = element.value("file").unwrap_or("values in the file");
        let remark = "ROS 2 has no global parameters: translate the file to `NODE: ros__parameters:` and give it to the nodes \
                      that read it; parameters of controllers belong into the file that gz_ros2_control names in <parameters>";
        let outcome = MigrationOutcome::NoCounterpart;
        self.entry(element, format!("rosparam {file}"), "", outcome, &[remark]);
        None
    }

    fn group(&mut self, element: &Element, scope: &Scope) -> Option<ActionText> {
        let mut inner = scope.clone();
        let mut actions = Vec::new();
        if let Some(namespace) = element.value("ns") {
            let class = self.name("launch_ros.actions", "PushRosNamespace");
            let namespace = self.text(namespace);
            actions.push(call(class, vec![namespace]));
        }
        actions.extend(self.actions(element, &mut inner));
        if actions.is_empty() {
            return None;
        }
        let class = self.name("launch.actions", "GroupAction");
        let condition = self.condition(element);
        Some(ActionText::group(class, actions, condition))
    }

    fn remapping(&mut self, element: &Element) -> ActionText {
        let class = self.name("launch_ros.actions", "SetRemap");
        let from = self.text(element.value("from").unwrap_or_default());
        let to = self.text(element.value("to").unwrap_or_default());
        call(class, vec![from, to])
    }

    fn variable(&mut self, element: &Element) -> ActionText {
        let class = self.name("launch.actions", "SetEnvironmentVariable");
        let name = self.text(element.value("name").unwrap_or_default());
        let value = self.text(element.value("value").unwrap_or_default());
        call(class, vec![name, value])
    }

    /// Bridge with the topics that the conversion of the robots writes.
    fn bridge(&mut self) -> ActionText {
        let class = self.name("launch_ros.actions", "Node");
        self.name("launch.substitutions", "LaunchConfiguration");
        let arguments = vec![
            "package='ros_gz_bridge'".to_owned(),
            "executable='parameter_bridge'".to_owned(),
            "parameters=[{'config_file': LaunchConfiguration('bridge_config')}]".to_owned(),
            "output='screen'".to_owned(),
        ];
        call(class, arguments)
    }

    /// Source of the whole module.
    fn module(&mut self, actions: &[ActionText]) -> String {
        let mut declared = String::new();
        if self.is_simulating {
            let class = self.name("launch.actions", "DeclareLaunchArgument");
            let folder = self.name("launch.substitutions", "ThisLaunchFileDir");
            let bridge = call(
                class,
                vec![
                    "'bridge_config'".to_owned(),
                    format!("default_value=[{folder}(), '/ros_gz_bridge.yaml']"),
                    "description='Topics between Gazebo and ROS'".to_owned(),
                ],
            );
            bridge.write(2, &mut declared);
        }
        for action in actions {
            action.write(2, &mut declared);
        }
        self.modules.sort_unstable();
        let mut text = String::new();
        if self.needs_words {
            text.push_str("import shlex\n\n");
        }
        text.push_str("from launch import LaunchDescription\n");
        let mut modules: Vec<&str> = self.modules.iter().map(|(module, _)| *module).collect();
        modules.dedup();
        for module in modules {
            let names: Vec<&str> = self
                .modules
                .iter()
                .filter(|(other, _)| *other == module)
                .map(|(_, name)| *name)
                .collect();
            text.push_str(&format!("from {module} import {}\n", names.join(", ")));
        }
        if self.needs_words {
            text.push_str(python::WORDS);
        }
        text.push_str("\n\ndef generate_launch_description():\n    return LaunchDescription([\n");
        text.push_str(&declared);
        text.push_str("    ])\n");
        text
    }

    /// A text with the defaults of arguments, as far as they are known.
    fn with_defaults(&self, text: &str) -> String {
        let mut text = text.to_owned();
        // Defaults may name other arguments.
        for _ in 0..MAX_NESTED_DEFAULTS {
            for (name, value) in &self.defaults {
                text = text.replace(&format!("$(arg {name})"), value);
            }
        }
        text
    }

    /// Remembers a file of a robot or world.
    fn refer(&mut self, path: &str) {
        if self.with_defaults(path) == EMPTY_WORLD {
            return;
        }
        if let Some(uri) = self.uri(path).filter(|uri| !self.references.contains(uri)) {
            self.references.push(uri);
        }
    }

    /// Remembers an included launch file.
    fn includes(&mut self, path: &str) {
        if let Some(uri) = self.uri(path).filter(|uri| !self.includes.contains(uri)) {
            self.includes.push(uri);
        }
    }

    /// A path with the values of arguments; `None` if some are unknown.
    fn uri(&self, path: &str) -> Option<String> {
        let path = self.with_defaults(path);
        let path = path.trim().trim_matches(['\'', '"']);
        let uri = match path.strip_prefix("$(find ").and_then(|rest| rest.split_once(')')) {
            Some((package, rest)) => format!("package://{package}{rest}"),
            None => path.to_owned(),
        };
        (!uri.contains("$(")).then_some(uri)
    }
}

/// Value of an argument without a default, which no path contains.
const UNKNOWN: &str = "$(arg)";

/// Depth of defaults that name other arguments.
const MAX_NESTED_DEFAULTS: usize = 4;

#[cfg(test)]
mod tests;
