//! Tools from the table of commands: JSON schemas of their options, and words from JSON.

use std::any::TypeId;
use std::sync::Arc;

use clap::{Arg, ArgAction, Command};
use rmcp::model::Tool;
use serde_json::{Map, Value, json};

/// Commands that are no tools: they need a terminal or a browser, or speak with a shell.
const NOT_OFFERED: [&str; 7] =
    ["completions", "conformance", "help", "man", "mcp", "teleop", "view"];

/// Argument of every tool: maximum duration.
const TIMEOUT_ARGUMENT: &str = "timeout_s";

/// Argument of every tool: words that are added to the command line as they are.
const MORE_ARGUMENTS: &str = "more_arguments";

/// Default of `timeout_s` \[s\].
const DEFAULT_TIMEOUT_S: f64 = 300.0;

/// Largest `timeout_s` \[s\].
const MAX_TIMEOUT_S: f64 = 86_400.0;

/// Longest description of a tool or an argument \[characters\].
const MAX_DESCRIPTION: usize = 1500;

/// A command as a tool.
#[derive(Debug)]
pub(super) struct VerbTool {
    /// Words of the command, joined by `_`: `map_diff`.
    pub(super) name: String,
    path: Vec<String>,
    command: Command,
}

/// Command line of a call.
#[derive(Debug, PartialEq)]
pub(super) struct Call {
    /// Words after the name of the program.
    pub(super) words: Vec<String>,
    /// Maximum duration \[s\].
    pub(super) timeout_s: f64,
    /// True if standard output is JSON.
    pub(super) prints_json: bool,
}

/// Returns every command without subcommands as a tool.
pub(super) fn all(program: &Command) -> Vec<VerbTool> {
    let mut tools = Vec::new();
    collect(program, &[], &mut tools);
    tools
}

fn collect(command: &Command, path: &[String], tools: &mut Vec<VerbTool>) {
    for below in command.get_subcommands() {
        let name = below.get_name();
        if below.is_hide_set() || NOT_OFFERED.contains(&name) {
            continue;
        }
        let path: Vec<String> = path.iter().cloned().chain([name.to_owned()]).collect();
        let is_group = below.get_subcommands().any(|one| one.get_name() != "help");
        collect(below, &path, tools);
        if !is_group || !below.is_subcommand_required_set() {
            tools.push(VerbTool { name: path.join("_"), path, command: below.clone() });
        }
    }
}

impl VerbTool {
    /// Returns the tool for the list of a client.
    pub(super) fn to_tool(&self) -> Tool {
        Tool::new(self.name.clone(), self.description(), Arc::new(self.schema()))
    }

    fn description(&self) -> String {
        let text = self.command.get_long_about().or_else(|| self.command.get_about());
        shortened(&text.map(ToString::to_string).unwrap_or_default())
    }

    /// Arguments with their names in JSON.
    fn arguments(&self) -> impl Iterator<Item = (String, &Arg)> {
        let arguments = self.command.get_arguments().filter(|argument| {
            let action = argument.get_action();
            let is_help = matches!(
                action,
                ArgAction::Help | ArgAction::HelpShort | ArgAction::HelpLong | ArgAction::Version
            );
            !is_help && !argument.is_hide_set() && argument.get_id() != "colour"
        });
        arguments.map(|argument| (json_name(argument), argument))
    }

    /// JSON schema of the arguments.
    fn schema(&self) -> Map<String, Value> {
        let mut properties = Map::new();
        let mut required = Vec::new();
        for (name, argument) in self.arguments() {
            if argument.is_required_set() {
                required.push(name.clone());
            }
            properties.insert(name, property(argument));
        }
        properties.insert(
            TIMEOUT_ARGUMENT.to_owned(),
            json!({
                "type": "number",
                "exclusiveMinimum": 0,
                "maximum": MAX_TIMEOUT_S,
                "default": DEFAULT_TIMEOUT_S,
                "description": "Maximum duration [s]. Then the command is stopped as by Ctrl-C, and writes its report",
            }),
        );
        properties.insert(
            MORE_ARGUMENTS.to_owned(),
            json!({
                "type": "array",
                "items": { "type": "string" },
                "description": "Words added to the command line as they are, where their order matters: \
                                [\"--robot\", \"a.urdf\", \"--name\", \"a\", \"--robot\", \"b.urdf\"]",
            }),
        );
        let schema = json!({
            "type": "object",
            "properties": properties,
            "required": required,
            "additionalProperties": false,
        });
        match schema {
            Value::Object(schema) => schema,
            _ => Map::new(),
        }
    }

    /// Returns the command line of a call.
    ///
    /// # Errors
    /// The argument that is not known, missing or of another type.
    pub(super) fn words(&self, arguments: &Map<String, Value>) -> Result<Call, String> {
        let known: Vec<(String, &Arg)> = self.arguments().collect();
        let is_known = |name: &str| {
            name == TIMEOUT_ARGUMENT
                || name == MORE_ARGUMENTS
                || known.iter().any(|(own, _)| own == name)
        };
        if let Some(unknown) = arguments.keys().find(|name| !is_known(name)) {
            let names: Vec<&str> = known.iter().map(|(name, _)| name.as_str()).collect();
            return Err(format!(
                "`{}` has no argument `{unknown}`; it has {}",
                self.name,
                names.join(", ")
            ));
        }
        let mut words = self.path.clone();
        let mut positional = Vec::new();
        let mut prints_json = false;
        for (name, argument) in &known {
            let is_json = argument.get_long() == Some("json");
            let value = match arguments.get(name).filter(|value| !value.is_null()) {
                Some(value) => value,
                // Reports for scripts are what a client can read best.
                None if is_json => &Value::Bool(true),
                None => continue,
            };
            prints_json |= is_json && value == &Value::Bool(true);
            let found = words_of(name, argument, value)?;
            if argument.is_positional() { positional.extend(found) } else { words.extend(found) }
        }
        match arguments.get(MORE_ARGUMENTS) {
            Some(Value::Array(more)) => {
                for word in more {
                    words.push(scalar(MORE_ARGUMENTS, word)?);
                }
            }
            Some(Value::Null) | None => {}
            Some(_) => return Err(format!("`{MORE_ARGUMENTS}` is a list of words")),
        }
        // A file after `--robot FILE` would be read as an argument of the robot.
        if !positional.is_empty() {
            words.push("--".to_owned());
            words.extend(positional);
        }
        let timeout_s = match arguments.get(TIMEOUT_ARGUMENT) {
            Some(Value::Null) | None => DEFAULT_TIMEOUT_S,
            Some(value) => value
                .as_f64()
                .filter(|seconds| *seconds > 0.0 && *seconds <= MAX_TIMEOUT_S)
                .ok_or_else(|| {
                    format!("`{TIMEOUT_ARGUMENT}` is a number above 0 and at most {MAX_TIMEOUT_S}")
                })?,
        };
        Ok(Call { words, timeout_s, prints_json })
    }
}

/// Name in JSON: that of the option with `_`, or of the value of a positional argument.
fn json_name(argument: &Arg) -> String {
    if let Some(long) = argument.get_long() {
        return long.replace('-', "_");
    }
    let value = argument.get_value_names().and_then(|names| names.first());
    let word: String = value
        .map(|name| name.to_lowercase())
        .unwrap_or_default()
        .chars()
        .take_while(|letter| letter.is_ascii_alphanumeric() || *letter == '_')
        .collect();
    if word.is_empty() { argument.get_id().as_str().to_owned() } else { word }
}

/// JSON schema of an argument.
fn property(argument: &Arg) -> Value {
    let mut schema = if !argument.get_action().takes_values() {
        json!({ "type": if matches!(argument.get_action(), ArgAction::Count) { "integer" } else { "boolean" } })
    } else if is_list(argument) {
        json!({ "type": "array", "items": item(argument) })
    } else if is_optional_value(argument) {
        json!({ "anyOf": [{ "type": "boolean" }, item(argument)] })
    } else {
        item(argument)
    };
    let help = argument.get_long_help().or_else(|| argument.get_help());
    let mut text = help.map(ToString::to_string).unwrap_or_default();
    if argument.get_long() == Some("json") {
        text.push_str(" (here true unless set to false)");
    }
    if let Some(names) = argument.get_value_names() {
        let names: Vec<&str> = names.iter().map(|name| name.as_str()).collect();
        text = format!("{text}: {}", names.join(" ")).trim_start_matches(": ").to_owned();
    }
    if argument.get_action().takes_values() {
        let defaults: Vec<String> = argument
            .get_default_values()
            .iter()
            .map(|it| it.to_string_lossy().into_owned())
            .collect();
        if !defaults.is_empty() {
            text = format!("{text} [default: {}]", defaults.join(" "));
        }
    }
    schema["description"] = json!(shortened(&text));
    schema
}

/// JSON schema of one value.
fn item(argument: &Arg) -> Value {
    let options: Vec<String> = argument
        .get_possible_values()
        .iter()
        .filter(|value| !value.is_hide_set())
        .map(|value| value.get_name().to_owned())
        .collect();
    if !options.is_empty() {
        return json!({ "type": "string", "enum": options });
    }
    let kind = argument.get_value_parser().type_id();
    let is = |types: &[TypeId]| types.iter().any(|one| kind == *one);
    if is(&[TypeId::of::<f64>(), TypeId::of::<f32>()]) {
        json!({ "type": "number" })
    } else if is(&[
        TypeId::of::<u8>(),
        TypeId::of::<u16>(),
        TypeId::of::<u32>(),
        TypeId::of::<u64>(),
        TypeId::of::<usize>(),
        TypeId::of::<i32>(),
        TypeId::of::<i64>(),
    ]) {
        json!({ "type": "integer" })
    } else {
        json!({ "type": "string" })
    }
}

fn is_list(argument: &Arg) -> bool {
    let several = argument.get_num_args().is_some_and(|count| count.max_values() > 1);
    several || matches!(argument.get_action(), ArgAction::Append)
}

/// An option whose value may be left out, such as `--gz`.
fn is_optional_value(argument: &Arg) -> bool {
    !argument.is_positional()
        && argument.get_num_args().is_some_and(|count| count.min_values() == 0)
}

/// Words of one argument.
fn words_of(name: &str, argument: &Arg, value: &Value) -> Result<Vec<String>, String> {
    let flag = argument.get_long().map(|long| format!("--{long}"));
    let flag = flag.or_else(|| argument.get_short().map(|short| format!("-{short}")));
    if !argument.get_action().takes_values() {
        return match (flag, value) {
            (Some(flag), Value::Bool(true)) => Ok(vec![flag]),
            (_, Value::Bool(false)) => Ok(Vec::new()),
            (Some(flag), Value::Number(count))
                if matches!(argument.get_action(), ArgAction::Count) =>
            {
                Ok(vec![flag; usize::try_from(count.as_u64().unwrap_or(0).min(9)).unwrap_or(0)])
            }
            _ => Err(format!("`{name}` is true or false")),
        };
    }
    let values: &[Value] = match value {
        Value::Array(values) if is_list(argument) => values,
        one => std::slice::from_ref(one),
    };
    let Some(flag) = flag else {
        return values.iter().map(|value| scalar(name, value)).collect();
    };
    let is_group = argument.get_num_args().is_some_and(|count| count.max_values() > 1);
    let mut words = Vec::new();
    for value in values {
        match value {
            Value::Bool(true) if is_optional_value(argument) => words.push(flag.clone()),
            Value::Bool(false) if is_optional_value(argument) => {}
            // One occurrence with several words: `--robot FILE NAME:=VALUE`.
            Value::Array(group) if is_group => {
                words.push(flag.clone());
                for word in group {
                    words.push(scalar(name, word)?);
                }
            }
            one if is_group => words.extend([flag.clone(), scalar(name, one)?]),
            one => words.push(format!("{flag}={}", scalar(name, one)?)),
        }
    }
    Ok(words)
}

fn scalar(name: &str, value: &Value) -> Result<String, String> {
    match value {
        Value::String(text) => Ok(text.clone()),
        Value::Number(number) => Ok(number.to_string()),
        Value::Bool(truth) => Ok(truth.to_string()),
        _ => Err(format!("`{name}` is a text or a number, or a list of them, not {value}")),
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(MAX_DESCRIPTION) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::help;

    fn tool(name: &str) -> VerbTool {
        all(&help::command()).into_iter().find(|tool| tool.name == name).unwrap()
    }

    fn words(name: &str, arguments: &Value) -> Result<Vec<String>, String> {
        Ok(tool(name).words(arguments.as_object().unwrap())?.words)
    }

    #[test]
    fn every_command_that_needs_no_terminal_is_a_tool() {
        let names: Vec<String> = all(&help::command()).into_iter().map(|tool| tool.name).collect();
        for name in ["check", "look", "sim", "slam", "navigate", "map_diff", "bag_info", "doctor"] {
            assert!(names.iter().any(|one| one == name), "{name}: {names:?}");
        }
        assert!(!names.iter().any(|name| NOT_OFFERED.contains(&name.as_str())));
    }

    #[test]
    fn options_become_words() {
        let call = json!({ "world": ["room.sdf"], "duration": 2.5, "seed": 7, "stack": true, "json": false });
        let expected = ["sim", "--duration=2.5", "--seed=7", "--stack", "--", "room.sdf"];
        assert_eq!(words("sim", &call).unwrap(), expected);
    }

    #[test]
    fn a_robot_with_its_arguments_is_one_occurrence() {
        let call = json!({ "world": "w.sdf", "robot": [["r.xacro", "lidar:=true"], "s.urdf"], "json": false });
        let expected =
            ["sim", "--robot", "r.xacro", "lidar:=true", "--robot", "s.urdf", "--", "w.sdf"];
        assert_eq!(words("sim", &call).unwrap(), expected);
    }

    #[test]
    fn reports_are_json_unless_refused() {
        assert_eq!(
            words("check", &json!({ "file": ["a.sdf"] })).unwrap(),
            ["check", "--json", "--", "a.sdf"]
        );
        assert!(tool("check").words(&Map::new()).unwrap().prints_json);
        let refused = json!({ "json": false });
        assert!(!tool("check").words(refused.as_object().unwrap()).unwrap().prints_json);
    }

    #[test]
    fn an_option_without_its_value_is_true() {
        let call = json!({ "world": "w.sdf", "gz": true, "json": false });
        assert_eq!(words("sim", &call).unwrap(), ["sim", "--gz", "--", "w.sdf"]);
    }

    #[test]
    fn wrong_arguments_are_named() {
        let unknown = words("check", &json!({ "files": [] })).unwrap_err();
        assert!(unknown.starts_with("`check` has no argument `files`; it has file, "), "{unknown}");
        let wrong = words("check", &json!({ "strict": "yes" })).unwrap_err();
        assert_eq!(wrong, "`strict` is true or false");
        let late = words("check", &json!({ "timeout_s": -1 })).unwrap_err();
        assert!(late.starts_with("`timeout_s` is a number above 0"), "{late}");
    }

    #[test]
    fn schemas_have_types_defaults_and_requirements() {
        let schema = Value::Object(tool("sim").schema());
        assert_eq!(schema["properties"]["seed"]["type"], "integer");
        assert_eq!(schema["properties"]["duration"]["type"], "number");
        assert_eq!(schema["properties"]["dynamics"]["enum"], json!(["rigid", "kinematic"]));
        assert_eq!(schema["properties"]["robot"]["type"], "array");
        assert_eq!(Value::Object(tool("look").schema())["required"], json!(["output"]));
    }

    #[test]
    fn names_of_arguments_are_unique() {
        for tool in all(&help::command()) {
            let mut names: Vec<String> = tool.arguments().map(|(name, _)| name).collect();
            let count = names.len();
            names.sort();
            names.dedup();
            assert_eq!(names.len(), count, "{}: {names:?}", tool.name);
            assert!(
                !names.iter().any(|name| name == TIMEOUT_ARGUMENT || name == MORE_ARGUMENTS),
                "{}",
                tool.name
            );
        }
    }
}
