//! Nodes.

use periplus_xml::Element;

use super::python::{ActionText, LaunchPart, call, parts, quoted};
use super::{LaunchWriter, Scope};
use crate::entry::MigrationOutcome;

/// Programs with another name in ROS 2: package, program, new package, new program.
const RENAMED: [(&str, &str, &str, &str); 9] = [
    ("robot_state_publisher", "state_publisher", "robot_state_publisher", "robot_state_publisher"),
    ("rviz", "rviz", "rviz2", "rviz2"),
    ("tf", "static_transform_publisher", "tf2_ros", "static_transform_publisher"),
    ("map_server", "map_server", "nav2_map_server", "map_server"),
    ("amcl", "amcl", "nav2_amcl", "amcl"),
    ("gmapping", "slam_gmapping", "slam_toolbox", "async_slam_toolbox_node"),
    ("robot_localization", "ekf_localization_node", "robot_localization", "ekf_node"),
    (
        "joint_state_publisher",
        "joint_state_publisher_gui",
        "joint_state_publisher_gui",
        "joint_state_publisher_gui",
    ),
    (
        "teleop_twist_keyboard",
        "teleop_twist_keyboard.py",
        "teleop_twist_keyboard",
        "teleop_twist_keyboard",
    ),
];

/// Options of `spawn_model` with a value that `create` has too: old, new.
const SPAWN_OPTIONS: [(&str, &str); 9] = [
    ("-model", "-name"),
    ("-param", "-topic"),
    ("-file", "-file"),
    ("-x", "-x"),
    ("-y", "-y"),
    ("-z", "-z"),
    ("-R", "-R"),
    ("-P", "-P"),
    ("-Y", "-Y"),
];

/// Options of `spawn_model` without a counterpart, with the number of their values.
const DROPPED_OPTIONS: [(&str, usize); 10] = [
    ("-urdf", 0),
    ("-sdf", 0),
    ("-gazebo", 0),
    ("-trimesh", 0),
    ("-unpause", 0),
    ("-b", 0),
    ("-wait", 1),
    ("-reference_frame", 1),
    ("-robot_namespace", 1),
    ("-J", 2),
];

impl LaunchWriter<'_> {
    pub(super) fn node(&mut self, element: &Element, scope: &mut Scope) -> Option<ActionText> {
        let package = element.value("pkg").unwrap_or_default();
        let program = element.value("type").unwrap_or_default();
        let old = format!("node {package}/{program}");
        if package == "gazebo_ros" {
            return self.gazebo_node(element, scope, program, old);
        }
        let renamed = RENAMED.iter().find(|(old_package, old_program, ..)| {
            *old_package == package && *old_program == program
        });
        let (new_package, new_program) =
            renamed.map_or((package, program), |(.., package, program)| (*package, *program));
        let mut arguments = vec![
            format!("package={}", quoted(new_package)),
            format!("executable={}", quoted(new_program)),
        ];
        self.identity(element, &mut arguments);
        let mut parameters = self.parameters(element);
        if new_program == "robot_state_publisher"
            && let Some(description) = &scope.description
        {
            parameters.push(format!("{{'robot_description': {description}}}"));
            scope.is_published = true;
        }
        if !parameters.is_empty() {
            arguments.push(format!("parameters=[{}]", parameters.join(", ")));
        }
        self.remappings(element, &mut arguments);
        let mut words = words(element.value("args").unwrap_or_default());
        if package == "tf" && words.last().is_some_and(|word| word.parse::<f64>().is_ok()) {
            // The period in ms: static transforms are sent once.
            words.pop();
        }
        self.running(element, &mut arguments);
        let (outcome, remarks): (_, &[&str]) = match package {
            "controller_manager" => (
                MigrationOutcome::Converted,
                &["the controllers must be in the parameter file of gz_ros2_control"],
            ),
            "map_server" | "amcl" | "gmapping" | "robot_localization" => (
                MigrationOutcome::Approximated,
                &[
                    "the node of ROS 2 is a lifecycle node or has other parameters and arguments: see its documentation",
                ],
            ),
            _ if renamed.is_some() || package == "robot_state_publisher" => {
                (MigrationOutcome::Converted, &[])
            }
            _ => (
                MigrationOutcome::Approximated,
                &[
                    "the package must exist for ROS 2; parameters and topics may have other names there",
                ],
            ),
        };
        self.entry(element, old, &format!("node {new_package}/{new_program}"), outcome, remarks);
        Some(self.with_arguments(arguments, &words))
    }

    /// `spawn_model`, `gzserver`, `gzclient`.
    fn gazebo_node(
        &mut self,
        element: &Element,
        scope: &mut Scope,
        program: &str,
        old: String,
    ) -> Option<ActionText> {
        if !matches!(program, "spawn_model" | "spawn_urdf") {
            self.is_simulating = true;
            let remark = "start Gazebo by including gz_sim.launch.py of ros_gz_sim with `gz_args`";
            self.entry(element, old, "", MigrationOutcome::NoCounterpart, &[remark]);
            return None;
        }
        let mut remarks: Vec<&str> = Vec::new();
        let old_words = words(element.value("args").unwrap_or_default());
        let mut new_words: Vec<String> = Vec::new();
        let mut rest = old_words.iter();
        while let Some(word) = rest.next() {
            if let Some((_, new)) = SPAWN_OPTIONS.iter().find(|(old, _)| old == word) {
                new_words.push((*new).to_owned());
                if let Some(value) = rest.next() {
                    if word == "-file" {
                        self.refer(value);
                    }
                    // Topics are relative to the namespace, as the parameter was.
                    let value =
                        if *new == "-topic" { value.trim_start_matches('/') } else { value };
                    new_words.push(value.to_owned());
                }
            } else if let Some((option, count)) =
                DROPPED_OPTIONS.iter().find(|(old, _)| old == word)
            {
                for _ in 0..*count {
                    rest.next();
                }
                if *count > 0 {
                    remarks.push("`-wait`, `-reference_frame`, `-robot_namespace` and `-J` have no counterpart");
                } else if *option == "-unpause" {
                    remarks.push("`-unpause` is `-r` of gz sim");
                }
            } else if word == "-database" {
                rest.next();
                remarks.push("`-database` has no counterpart: give the model's file with `-file`");
            } else {
                new_words.push(word.clone());
            }
        }
        remarks.dedup();
        let mut arguments =
            vec!["package='ros_gz_sim'".to_owned(), "executable='create'".to_owned()];
        self.identity(element, &mut arguments);
        self.running(element, &mut arguments);
        let outcome = if remarks.is_empty() {
            MigrationOutcome::Converted
        } else {
            MigrationOutcome::Approximated
        };
        self.entry(element, old, "node ros_gz_sim/create", outcome, &remarks);
        if !self.is_simulating {
            let old = "topics of the spawned robot".to_owned();
            let remark = "the bridge is part of the launch file that starts Gazebo; start parameter_bridge of ros_gz_bridge \
                          with config_file:=ros_gz_bridge.yaml if there is none";
            self.entry(element, old, "", MigrationOutcome::Approximated, &[remark]);
        }
        let create = self.with_arguments(arguments, &new_words);
        // `create` receives the description as a topic.
        if let Some(description) = scope.description.clone().filter(|_| !scope.is_published)
            && !self.has_publisher(element)
        {
            scope.is_published = true;
            let node = self.name("launch_ros.actions", "Node");
            let publisher = call(
                node,
                vec![
                    "package='robot_state_publisher'".to_owned(),
                    "executable='robot_state_publisher'".to_owned(),
                    format!("parameters=[{{'robot_description': {description}}}]"),
                ],
            );
            let group = self.name("launch.actions", "GroupAction");
            return Some(ActionText::group(group, vec![publisher, create], None));
        }
        Some(create)
    }

    /// True if the file has a robot_state_publisher.
    fn has_publisher(&self, _: &Element) -> bool {
        self.file.text.contains("type=\"robot_state_publisher\"")
            || self.file.text.contains("type=\"state_publisher\"")
            || self.file.text.contains("type='robot_state_publisher'")
    }

    fn identity(&mut self, element: &Element, arguments: &mut Vec<String>) {
        if let Some(name) = element.value("name") {
            let name = self.text(name);
            arguments.push(format!("name={name}"));
        }
        if let Some(namespace) = element.value("ns") {
            let namespace = self.text(namespace);
            arguments.push(format!("namespace={namespace}"));
        }
    }

    fn parameters(&mut self, element: &Element) -> Vec<String> {
        let mut parameters = Vec::new();
        let values: Vec<String> = element
            .named("param")
            .filter_map(|parameter| {
                let name = parameter.value("name")?;
                let value = parameter.value("value")?;
                Some(format!("{}: {}", quoted(name), self.value(value, parameter.value("type"))))
            })
            .collect();
        if !values.is_empty() {
            parameters.push(format!("{{{}}}", values.join(", ")));
        }
        for file in element.named("rosparam") {
            if let Some(path) = file.value("file") {
                let path = self.text(path);
                parameters.push(path);
                let remark =
                    "the parameter file must have the form of ROS 2 (`NODE: ros__parameters:`)";
                let old = format!("rosparam {}", file.value("file").unwrap_or_default());
                self.entry(
                    file,
                    old,
                    "parameters of the node",
                    MigrationOutcome::Approximated,
                    &[remark],
                );
            }
        }
        parameters
    }

    /// Value of a parameter: roslaunch guesses types as YAML does.
    fn value(&mut self, value: &str, kind: Option<&str>) -> String {
        let is_text = matches!(kind, Some("str" | "string"));
        if is_text || value.contains("$(") {
            return self.text(value);
        }
        match value {
            "true" | "True" => "True".to_owned(),
            "false" | "False" => "False".to_owned(),
            _ if value.parse::<i64>().is_ok() && kind == Some("double") => format!("{value}.0"),
            _ if value.parse::<f64>().is_ok_and(f64::is_finite) => value.to_owned(),
            _ => quoted(value),
        }
    }

    fn remappings(&mut self, element: &Element, arguments: &mut Vec<String>) {
        let pairs: Vec<String> = element
            .named("remap")
            .map(|remap| {
                let from = self.text(remap.value("from").unwrap_or_default());
                let to = self.text(remap.value("to").unwrap_or_default());
                format!("({from}, {to})")
            })
            .collect();
        if !pairs.is_empty() {
            arguments.push(format!("remappings=[{}]", pairs.join(", ")));
        }
    }

    fn running(&mut self, element: &Element, arguments: &mut Vec<String>) {
        if let Some(output) = element.value("output") {
            arguments.push(format!("output={}", quoted(output)));
        }
        if let Some(prefix) = element.value("launch-prefix") {
            let prefix = self.text(prefix);
            arguments.push(format!("prefix={prefix}"));
        }
        if element.value("respawn") == Some("true") {
            arguments.push("respawn=True".to_owned());
        }
        arguments.extend(self.condition(element));
    }

    /// A node with arguments. Where a whole word is an argument of the launch file that may have several words, they are
    /// split when the value is known.
    fn with_arguments(&mut self, mut arguments: Vec<String>, words: &[String]) -> ActionText {
        let class = self.name("launch_ros.actions", "Node");
        if words.is_empty() {
            return call(class, arguments);
        }
        let is_open = words.iter().enumerate().any(|(index, word)| {
            let is_value = index > 0 && words[index - 1].starts_with('-');
            !is_value && matches!(parts(word).as_slice(), [LaunchPart::Substitution(_)])
        });
        if !is_open {
            let list: Vec<String> = words.iter().map(|word| self.text(word)).collect();
            arguments.push(format!("arguments=[{}]", list.join(", ")));
            return call(class, arguments);
        }
        self.needs_words = true;
        let line = self.text(&words.join(" "));
        arguments.push(format!("arguments=words(context, {line})"));
        let function = self.name("launch.actions", "OpaqueFunction");
        let node = format!("{class}({})", arguments.join(", "));
        call(function, vec![format!("function=lambda context: [{node}]")])
    }
}

/// Words of a line; blanks in substitutions do not separate.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    for part in parts(line) {
        match part {
            LaunchPart::Substitution(inner) => word.push_str(&format!("$({inner})")),
            LaunchPart::Literal(text) => {
                for character in text.chars() {
                    if character.is_whitespace() {
                        if !word.is_empty() {
                            words.push(std::mem::take(&mut word));
                        }
                    } else {
                        word.push(character);
                    }
                }
            }
        }
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}
