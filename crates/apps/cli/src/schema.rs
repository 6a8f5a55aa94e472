//! `periplus schema`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Args;

use crate::error::CliError;

/// Print the JSON Schema of what a command prints with `--json`
///
/// Without a command it lists those that have a schema. A later version may add properties, and removes or changes none
/// without a note in the changelog. Where a command prints one object per line, the schema is that of a line.
#[derive(Debug, Args)]
pub(crate) struct SchemaOptions {
    /// Words of the command, such as `map diff`
    #[arg(value_name = "COMMAND")]
    words: Vec<String>,
}

macro_rules! schemas {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../schemas/", $name, ".json")))),*]
    };
}

/// Schemas by the words of the command, joined by `-`.
static SCHEMAS: [(&str, &str); 61] = schemas![
    "action-find",
    "action-info",
    "action-list",
    "action-send_goal",
    "action-type",
    "bag-check",
    "bag-info",
    "calibrate",
    "check",
    "compare",
    "conformance",
    "convert",
    "dataset",
    "doctor",
    "interface-list",
    "interface-package",
    "interface-packages",
    "interface-proto",
    "interface-show",
    "launch",
    "lifecycle-get",
    "lifecycle-list",
    "lifecycle-nodes",
    "lifecycle-set",
    "look",
    "map-convert",
    "map-diff",
    "map-info",
    "navigate",
    "node-info",
    "node-list",
    "param-delete",
    "param-describe",
    "param-dump",
    "param-get",
    "param-list",
    "param-load",
    "param-set",
    "report",
    "scenario",
    "score",
    "service-call",
    "service-echo",
    "service-find",
    "service-info",
    "service-list",
    "service-type",
    "sim",
    "sweep",
    "tf-echo",
    "tf-monitor",
    "tf-tree",
    "topic-bw",
    "topic-delay",
    "topic-echo",
    "topic-find",
    "topic-hz",
    "topic-info",
    "topic-list",
    "topic-pub",
    "topic-type",
];

pub(crate) fn run(options: &SchemaOptions) -> Result<ExitCode, CliError> {
    let mut out = io::stdout().lock();
    if options.words.is_empty() {
        for (name, _) in SCHEMAS {
            writeln!(out, "{}", name.replacen('-', " ", 1))?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let name = options.words.join("-");
    let Some((_, schema)) = SCHEMAS.iter().find(|(known, _)| *known == name) else {
        return Err(CliError::usage(format!(
            "`{}` has no schema; `periplus schema` lists the commands with `--json`",
            options.words.join(" ")
        )));
    };
    out.write_all(schema.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    fn with_json(command: &clap::Command, path: &[&str], names: &mut Vec<String>) {
        let prints = |argument: &clap::Arg| argument.get_long() == Some("json");
        if !command.has_subcommands() || command.get_name() == "doctor" {
            names.extend(command.get_arguments().any(prints).then(|| path.join("-")));
        }
        for below in command.get_subcommands() {
            with_json(below, &[path, &[below.get_name()]].concat(), names);
        }
    }

    #[test]
    fn every_command_that_prints_json_has_a_schema() {
        let mut names = Vec::new();
        with_json(&crate::options::Options::command(), &[], &mut names);
        names.sort();
        assert_eq!(names, SCHEMAS.map(|(name, _)| name));
        for (name, schema) in SCHEMAS {
            let schema: serde_json::Value = serde_json::from_str(schema).unwrap();
            assert_eq!(
                schema["title"].as_str().unwrap().replace(' ', "-"),
                format!("periplus-{name}---json")
            );
        }
    }
}
