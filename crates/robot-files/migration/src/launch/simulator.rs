//! Includes: the simulator itself, and other launch files.

use periplus_xml::Element;

use super::LaunchWriter;
use super::python::{ActionText, call, quoted};
use crate::entry::MigrationOutcome;

/// Launch files of `gazebo_ros` with their worlds.
const WORLDS: [(&str, &str); 7] = [
    ("empty_world.launch", "empty.sdf"),
    ("shapes_world.launch", "shapes.sdf"),
    ("elevator_world.launch", ""),
    ("mud_world.launch", ""),
    ("range_world.launch", ""),
    ("rubble_world.launch", ""),
    ("willowgarage_world.launch", ""),
];

impl LaunchWriter<'_> {
    pub(super) fn include(&mut self, element: &Element) -> Option<ActionText> {
        let file = element.value("file")?;
        if let Some(name) = file.strip_prefix("$(find gazebo_ros)/launch/") {
            return Some(self.simulator(element, name));
        }
        self.includes(file);
        let class = self.name("launch.actions", "IncludeLaunchDescription");
        let mut arguments = vec![self.launch_file(file)];
        let given: Vec<String> = element
            .named("arg")
            .filter_map(|argument| {
                let value = argument.value("value").or(argument.value("default"))?;
                // Files that an include names by an argument are robots and worlds, too.
                let known = self.with_defaults(value);
                if [".xacro", ".urdf", ".world", ".sdf"].iter().any(|end| known.ends_with(end)) {
                    self.refer(value);
                }
                let value = self.text(value);
                Some(format!("{}: {value}", quoted(argument.value("name")?)))
            })
            .collect();
        if !given.is_empty() {
            arguments.push(format!("launch_arguments={{{}}}.items()", given.join(", ")));
        }
        arguments.extend(self.condition(element));
        let old = format!("include {file}");
        let remark = "the included file must be converted, too: its new name ends with .launch.py";
        self.entry(
            element,
            old,
            "IncludeLaunchDescription",
            MigrationOutcome::Converted,
            &[remark],
        );
        let include = call(class, arguments);
        Some(match element.value("ns") {
            Some(namespace) => {
                let group = self.name("launch.actions", "GroupAction");
                let push = self.name("launch_ros.actions", "PushRosNamespace");
                let namespace = self.text(namespace);
                ActionText::group(group, vec![call(push, vec![namespace]), include], None)
            }
            None => include,
        })
    }

    /// Description source of a converted launch file.
    fn launch_file(&mut self, file: &str) -> String {
        let file = match file.strip_suffix(".launch.xml").or_else(|| file.strip_suffix(".launch")) {
            Some(stem) => format!("{stem}.launch.py"),
            None => file.to_owned(),
        };
        let source =
            self.name("launch.launch_description_sources", "PythonLaunchDescriptionSource");
        let file = self.text(&file);
        format!("{source}({file})")
    }

    /// `gz_sim.launch.py` in place of a launch file of `gazebo_ros`.
    fn simulator(&mut self, element: &Element, name: &str) -> ActionText {
        self.is_simulating = true;
        let mut remarks = Vec::new();
        let given = |name: &str| {
            element
                .named("arg")
                .find(|argument| argument.value("name") == Some(name))
                .and_then(|argument| argument.value("value").or(argument.value("default")))
        };
        let usual = WORLDS.iter().find(|(file, _)| *file == name).map_or("", |(_, world)| *world);
        let world = match given("world_name") {
            Some("worlds/empty.world") => "empty.sdf".to_owned(),
            Some(world) => {
                self.refer(world);
                if !world.contains("$(") {
                    remarks.push("worlds of Gazebo Classic's own folder are not part of Harmonic");
                }
                world.to_owned()
            }
            None if usual.is_empty() => {
                remarks.push(
                    "this world of Gazebo Classic is not part of Harmonic: the empty one is used",
                );
                "empty.sdf".to_owned()
            }
            None => usual.to_owned(),
        };
        // `-r` runs from the start, `-s` has no GUI.
        let mut options = vec![self.switch(given("paused"), "", "-r ")];
        options.push(self.switch(given("gui"), "", "-s "));
        if given("headless").is_some_and(|value| value != "false") {
            remarks
                .push("`headless` had no effect; `--headless-rendering` renders without a display");
        }
        if given("verbose").is_some() {
            options.push(self.switch(given("verbose"), "-v 4 ", ""));
        }
        let world = self.text(&world);
        let mut parts: Vec<String> = options.into_iter().filter(|option| option != "''").collect();
        match world.strip_prefix('[').and_then(|inner| inner.strip_suffix(']')) {
            Some(inner) => parts.push(inner.to_owned()),
            None => parts.push(world),
        }
        let class = self.name("launch.actions", "IncludeLaunchDescription");
        let source =
            self.name("launch.launch_description_sources", "PythonLaunchDescriptionSource");
        let share = self.name("launch_ros.substitutions", "FindPackageShare");
        let mut arguments = vec![
            format!("{source}([{share}('ros_gz_sim'), '/launch/gz_sim.launch.py'])"),
            format!("launch_arguments={{'gz_args': [{}]}}.items()", parts.join(", ")),
        ];
        arguments.extend(self.condition(element));
        let new = "gz_sim.launch.py of ros_gz_sim, parameter_bridge";
        let outcome = if remarks.is_empty() {
            MigrationOutcome::Converted
        } else {
            MigrationOutcome::Approximated
        };
        self.entry(element, format!("include gazebo_ros/{name}"), new, outcome, &remarks);
        call(class, arguments)
    }

    /// Option for a flag that may be an argument: `yes` if it is true, `no` if it is false; the default is false for
    /// `paused` and true for `gui`.
    fn switch(&mut self, value: Option<&str>, yes: &str, no: &str) -> String {
        let Some(value) = value else {
            // Without the argument Gazebo runs, and shows its GUI.
            return quoted(if no == "-r " { no } else { yes });
        };
        match value {
            "true" | "1" => quoted(yes),
            "false" | "0" => quoted(no),
            _ => {
                let class = self.name("launch.substitutions", "PythonExpression");
                let value = self.text(value);
                let value = value.trim_start_matches('[').trim_end_matches(']').to_owned();
                format!(
                    "{class}([\"'{yes}' if '\", {value}, \"'.lower() in ('true', '1') else '{no}'\"])"
                )
            }
        }
    }
}
