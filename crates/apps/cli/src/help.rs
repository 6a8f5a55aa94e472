//! Help of the command line: groups of commands, examples, full stops.

mod examples;

use std::fmt::Write as _;
use std::process::ExitCode;

use clap::builder::StyledStr;
use clap::{Command, CommandFactory as _, FromArgMatches as _};

use crate::options::Options;
use examples::{EXAMPLES, Example};

/// Groups of commands, in the order of the help.
const GROUPS: [(&str, &[&str]); 7] = [
    ("Start here", &["demo", "new", "doctor"]),
    ("Simulate", &["sim", "launch", "run", "teleop", "view"]),
    ("Maps, localization, navigation", &["slam", "localize", "map", "costmap", "navigate"]),
    (
        "Tests and results",
        &["scenario", "sweep", "score", "compare", "rerun", "report", "calibrate"],
    ),
    ("Robots and worlds", &["check", "look", "dataset", "convert"]),
    (
        "ROS and Gazebo",
        &[
            "topic",
            "node",
            "service",
            "param",
            "action",
            "lifecycle",
            "interface",
            "tf",
            "bag",
            "bridge",
            "ros1",
        ],
    ),
    ("This program", &["mcp", "completions", "man", "schema", "conformance", "help"]),
];

/// ROS and Gazebo commands that are translated, for the help.
const TRANSLATED: &str = "ros2, gz, ign, gazebo, rosrun, roslaunch, rostopic, rosnode, rosservice, rosparam, \
                          rosbag, rviz2, xacro, colcon ...";

/// Maximum number of examples of a group of commands.
const MAX_EXAMPLES: usize = 6;

/// Command line with its help.
pub(crate) fn command() -> Command {
    let command = finished(Options::command(), "");
    let template = top(&command);
    command.help_template(template)
}

/// Parses words. The error is the exit code after help (0) or a usage error (2) was printed.
pub(crate) fn parse(words: Vec<String>) -> Result<Options, ExitCode> {
    let parsed = command().try_get_matches_from(words);
    let parsed = parsed.and_then(|matches| Options::from_arg_matches(&matches));
    parsed.map_err(|error| {
        let error = error.format(&mut command());
        // A reader that has closed its end wants no more help.
        let _ = error.print();
        ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
    })
}

/// Adds examples and full stops to a command and its subcommands.
fn finished(command: Command, path: &str) -> Command {
    let command = command.mut_subcommands(|below| {
        let path = format!("{path} {}", below.get_name());
        finished(below, path.trim())
    });
    let command = with_full_stop(command);
    let examples = examples_of(path);
    if examples.is_empty() { command } else { command.after_help(shown(&examples)) }
}

/// Adds a full stop to a first line that is followed by other sentences.
fn with_full_stop(command: Command) -> Command {
    let Some(text) = command.get_long_about().map(ToString::to_string) else { return command };
    match text.split_once("\n\n") {
        Some((first, rest)) if !first.ends_with('.') => {
            command.long_about(format!("{first}.\n\n{rest}"))
        }
        _ => command,
    }
}

/// Examples of a command; for a group, the first example of each of its commands.
fn examples_of(path: &str) -> Vec<Example> {
    if path.is_empty() {
        return Vec::new();
    }
    if let Some((_, own)) = EXAMPLES.iter().find(|(of, _)| *of == path) {
        return own.to_vec();
    }
    let below = EXAMPLES.iter().filter(|(of, _)| of.starts_with(&format!("{path} ")));
    below.filter_map(|(_, examples)| examples.first().copied()).take(MAX_EXAMPLES).collect()
}

fn shown(examples: &[Example]) -> StyledStr {
    let bold = clap::builder::styling::Style::new().bold().underline();
    let mut text = format!("{bold}Examples:{bold:#}");
    for (line, purpose) in examples {
        let _ = write!(text, "\n  {line}\n      {purpose}");
    }
    text.into()
}

/// Template of the top-level help, with groups in place of clap's single list.
fn top(command: &Command) -> StyledStr {
    let bold = clap::builder::styling::Style::new().bold();
    let title = bold.underline();
    let mut text = String::from("{about-with-newline}\n{usage-heading} {usage}\n");
    for (group, names) in GROUPS {
        let _ = write!(text, "\n{title}{group}:{title:#}\n");
        for name in names {
            let about = match command.find_subcommand(name).and_then(Command::get_about) {
                Some(about) => about.to_string(),
                None => "Print this message or the help of a command".to_owned(),
            };
            let _ = writeln!(text, "  {bold}{name:<12}{bold:#} {}", first_clause(&about));
        }
    }
    let _ = write!(
        text,
        "\n{title}ROS and Gazebo commands, translated:{title:#}\n  {TRANSLATED}\n  \
         as in `periplus ros2 topic list`, `periplus gz sim world.sdf`\n\n{title}Options:{title:#}\n\
         {{options}}\n\n{title}Examples:{title:#}\n  \
         periplus                              a robot in a room, in the browser\n  \
         periplus new package my_bot           a new robot package, with a room and a launch file\n  \
         periplus launch my_bot simulation.launch.py\n  \
         periplus sim --help                   the options of a command\n"
    );
    text.into()
}

/// Truncates a description at its first colon if it does not fit on a line.
fn first_clause(about: &str) -> &str {
    const MAX_LINE_CHARS: usize = 84;
    if about.chars().count() <= MAX_LINE_CHARS {
        return about;
    }
    about.split_once(": ").map_or(about, |(first, _)| first)
}

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;
