//! Launch files of ROS 2 in Python: the calls that start and fill Gazebo Classic are replaced, everything else stays.

use std::ops::Range;

use periplus_diagnostics::{SourceMap, TextEdit, apply_edits};

use super::scan::{PythonArgument, PythonCall, calls, items, literal};
use super::{MigratedLaunch, SPAWN_NAMES};
use crate::entry::{MigrationEntry, MigrationOutcome};

/// Imports of what is added, under separate names.
const IMPORTS: &str = "import os as _os\n\nfrom launch.actions import GroupAction as _GroupAction\nfrom launch_ros.actions import Node \
                       as _Node\n";

/// The bridge, with the topics beside the launch file.
const BRIDGE: &str = "_Node(\n    package='ros_gz_bridge', executable='parameter_bridge', output='screen',\n    parameters=[{'config_file': \
                      _os.path.join(_os.path.dirname(_os.path.abspath(__file__)), 'ros_gz_bridge.yaml')}])";

/// Converts a launch file of ROS 2 in Python; `path` is its name in the report. `None` if it has nothing of `gazebo_ros`.
#[must_use]
pub fn migrate_python_launch(text: &str, path: &str) -> Option<MigratedLaunch> {
    let mut editor =
        Editor { text, path, edits: Vec::new(), entries: Vec::new(), has_bridge: false };
    for call in calls(text, "IncludeLaunchDescription") {
        editor.include(&call);
    }
    for call in calls(text, "Node") {
        editor.node(&call);
    }
    for call in calls(text, "ExecuteProcess") {
        editor.process(&call);
    }
    if editor.edits.is_empty() {
        return None;
    }
    for function in ["get_package_share_directory", "FindPackageShare", "get_package_prefix"] {
        for call in calls(text, function) {
            editor.package(&call);
        }
    }
    if editor.has_bridge {
        let at = imports_start(text);
        editor.edits.push(TextEdit { range: at..at, text: IMPORTS.to_owned() });
    }
    let Editor { edits, mut entries, .. } = editor;
    entries.sort_by_key(|entry| (entry.line, entry.column));
    let text = apply_edits(text, edits)?;
    Some(MigratedLaunch { text, entries, references: Vec::new(), includes: Vec::new() })
}

/// Position of the first import.
fn imports_start(text: &str) -> usize {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let is_import = line.starts_with("import ") || line.starts_with("from ");
        if is_import && !line.starts_with("from __future__") {
            return at;
        }
        at += line.len();
    }
    0
}

struct Editor<'a> {
    text: &'a str,
    path: &'a str,
    edits: Vec<TextEdit>,
    entries: Vec<MigrationEntry>,
    has_bridge: bool,
}

impl Editor<'_> {
    fn value(&self, argument: &PythonArgument) -> &str {
        &self.text[argument.value.clone()]
    }

    fn edit(&mut self, range: Range<usize>, text: impl Into<String>) {
        self.edits.push(TextEdit { range, text: text.into() });
    }

    fn entry(
        &mut self,
        at: usize,
        old: &str,
        new: &str,
        outcome: MigrationOutcome,
        remarks: Vec<String>,
    ) {
        let mut sources = SourceMap::new();
        let file = sources.add(self.path, self.text);
        let position = sources.file(file).position(u32::try_from(at).unwrap_or(u32::MAX));
        self.entries.push(MigrationEntry {
            file: self.path.to_owned(),
            line: position.line,
            column: position.column,
            old: old.to_owned(),
            new: new.to_owned(),
            outcome,
            remarks,
        });
    }

    /// Puts the bridge beside an action.
    fn bridged(&mut self, range: &Range<usize>) {
        if self.has_bridge {
            return;
        }
        self.has_bridge = true;
        self.edit(range.start..range.start, "_GroupAction([");
        self.edit(range.end..range.end, format!(", {BRIDGE}])"));
    }

    /// The package of Gazebo's launch files.
    fn package(&mut self, call: &PythonCall) {
        let named = call.keyword("package").or(call.keyword("package_name"));
        let Some(argument) = named.or(call.arguments.first()) else { return };
        let is_replaced = self.edits.iter().any(|edit| {
            edit.range.start <= argument.value.start && argument.value.end <= edit.range.end
        });
        if literal(self.value(argument)) == Some("gazebo_ros") && !is_replaced {
            self.edit(argument.value.clone(), "'ros_gz_sim'");
        }
    }

    /// `gazebo.launch.py`, `gzserver.launch.py`, `gzclient.launch.py`.
    fn include(&mut self, call: &PythonCall) {
        let body = &self.text[call.range.clone()];
        let file = ["gzserver.launch.py", "gzclient.launch.py", "gazebo.launch.py"]
            .into_iter()
            .find(|name| body.contains(*name));
        let Some(file) = file else { return };
        // An outer include contains inner ones, which are found, too.
        let inner = &body["IncludeLaunchDescription".len()..];
        if !calls(inner, "IncludeLaunchDescription").is_empty() {
            return;
        }
        let Some(at) = body.find(file).map(|at| call.range.start + at) else { return };
        self.edit(at..at + file.len(), "gz_sim.launch.py");
        let (flags, is_server) = match file {
            "gzclient.launch.py" => ("-g", false),
            "gzserver.launch.py" => ("-r -s ", true),
            _ => ("-r ", true),
        };
        let mut remarks = Vec::new();
        let given = call.keyword("launch_arguments");
        let mut world = None;
        let dictionary = given.and_then(|argument| {
            let value = self.value(argument);
            let close = super::scan::closing(value, 0).filter(|_| value.starts_with('{'))?;
            Some(argument.value.start + 1..argument.value.start + close)
        });
        if let Some(inner) = &dictionary {
            for pair in items(self.text, inner.clone()) {
                let text = self.value(&pair);
                let Some((key, value)) = text.split_once(':') else { continue };
                match literal(key.trim()) {
                    Some("world") => world = Some(value.trim().to_owned()),
                    Some(other) => remarks.push(format!(
                        "the argument `{other}` has no counterpart in gz_sim.launch.py"
                    )),
                    None => {}
                }
            }
        } else if given.is_some() {
            remarks.push(
                "the arguments are not a dictionary in place: write `gz_args` with the world by hand".to_owned(),
            );
        }
        let arguments = match (&world, is_server) {
            (_, false) => format!("{{'gz_args': '{flags}'}}.items()"),
            (Some(world), true) => {
                let inner = world.strip_prefix('[').and_then(|inner| inner.strip_suffix(']'));
                format!("{{'gz_args': ['{flags}', {}]}}.items()", inner.unwrap_or(world))
            }
            (None, true) => format!("{{'gz_args': '{flags}empty.sdf'}}.items()"),
        };
        match given {
            Some(argument) if dictionary.is_some() => self.edit(argument.value.clone(), arguments),
            Some(_) => {}
            None => {
                let at = call.arguments.last().map_or(call.range.end - 1, |last| last.value.end);
                self.edit(at..at, format!(", launch_arguments={arguments}"));
            }
        }
        if is_server {
            self.bridged(&call.range);
        }
        let outcome = if remarks.is_empty() {
            MigrationOutcome::Converted
        } else {
            MigrationOutcome::Approximated
        };
        let old = format!("include gazebo_ros/{file}");
        self.entry(call.range.start, &old, "gz_sim.launch.py of ros_gz_sim", outcome, remarks);
    }

    /// `spawn_entity.py`.
    fn node(&mut self, call: &PythonCall) {
        let is = |name: &str, value: &str| {
            call.keyword(name).is_some_and(|argument| literal(self.value(argument)) == Some(value))
        };
        if !is("package", "gazebo_ros") || !is("executable", "spawn_entity.py") {
            return;
        }
        let mut remarks = Vec::new();
        for (name, value) in [("package", "'ros_gz_sim'"), ("executable", "'create'")] {
            if let Some(argument) = call.keyword(name) {
                self.edit(argument.value.clone(), value);
            }
        }
        if let Some(argument) = call.keyword("arguments").cloned() {
            let value = self.value(&argument);
            if value.starts_with('[') && value.ends_with(']') {
                let list = items(self.text, argument.value.start + 1..argument.value.end - 1);
                let mut written = Vec::new();
                let mut rest = list.iter();
                while let Some(item) = rest.next() {
                    let text = self.value(item).to_owned();
                    match literal(&text)
                        .and_then(|flag| SPAWN_NAMES.iter().find(|(old, ..)| *old == flag))
                    {
                        Some((_, Some(new), _)) => written.push(format!("'{new}'")),
                        Some((old, None, count)) => {
                            for _ in 0..*count {
                                rest.next();
                            }
                            remarks
                                .push(format!("`{old}` has no counterpart in ros_gz_sim's create"));
                        }
                        None => written.push(text),
                    }
                }
                self.edit(argument.value.clone(), format!("[{}]", written.join(", ")));
            } else {
                remarks.push("write the arguments by hand: `-entity` is `-name`".to_owned());
            }
        }
        let outcome = if remarks.is_empty() {
            MigrationOutcome::Converted
        } else {
            MigrationOutcome::Approximated
        };
        self.entry(
            call.range.start,
            "node gazebo_ros/spawn_entity.py",
            "node ros_gz_sim/create",
            outcome,
            remarks,
        );
    }

    /// `gazebo`, `gzserver`, `gzclient` as processes.
    fn process(&mut self, call: &PythonCall) {
        let Some(argument) = call.keyword("cmd").cloned() else { return };
        let value = self.value(&argument);
        if !value.starts_with('[') || !value.ends_with(']') {
            return;
        }
        let list = items(self.text, argument.value.start + 1..argument.value.end - 1);
        let program = list.first().and_then(|item| literal(self.value(item))).map(str::to_owned);
        let Some(program) =
            program.filter(|name| ["gazebo", "gzserver", "gzclient"].contains(&name.as_str()))
        else {
            return;
        };
        let mut written = vec!["'gz'".to_owned(), "'sim'".to_owned()];
        let mut remarks = Vec::new();
        let (mut is_paused, mut is_verbose) = (false, false);
        let mut others = Vec::new();
        let mut rest = list.iter().skip(1);
        while let Some(item) = rest.next() {
            let text = self.value(item).to_owned();
            match literal(&text) {
                // Plugins of the server and of the GUI.
                Some("-s" | "-g" | "--server-plugin" | "--gui-client-plugin") => {
                    rest.next();
                }
                Some("--verbose") => is_verbose = true,
                Some("-u" | "--pause") => is_paused = true,
                Some(flag) if flag.starts_with('-') => {
                    remarks.push(format!("the option `{flag}` has no counterpart in gz sim"));
                }
                _ => others.push(text),
            }
        }
        match program.as_str() {
            "gzclient" => written.push("'-g'".to_owned()),
            program => {
                if !is_paused {
                    written.push("'-r'".to_owned());
                }
                if program == "gzserver" {
                    written.push("'-s'".to_owned());
                }
            }
        }
        if is_verbose {
            written.extend(["'-v'".to_owned(), "'4'".to_owned()]);
        }
        written.extend(others);
        self.edit(argument.value.clone(), format!("[{}]", written.join(", ")));
        if program != "gzclient" {
            self.bridged(&call.range);
        }
        let outcome = if remarks.is_empty() {
            MigrationOutcome::Converted
        } else {
            MigrationOutcome::Approximated
        };
        self.entry(
            call.range.start,
            &format!("process {program}"),
            "process gz sim, parameter_bridge",
            outcome,
            remarks,
        );
    }
}
