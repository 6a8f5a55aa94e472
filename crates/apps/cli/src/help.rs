//! The command line with its help: groups of commands, examples, full stops.

mod examples;

use std::fmt::Write as _;

use clap::builder::StyledStr;
use clap::{Command, CommandFactory as _, FromArgMatches as _};

use crate::options::Options;
use examples::{EXAMPLES, Example};

/// Commands by what they are for, in the order of the help.
const GROUPS: [(&str, &[&str]); 6] = [
    ("Start here", &["demo", "new", "doctor"]),
    ("Simulate", &["sim", "launch", "run", "teleop", "view"]),
    ("Maps, localization, costmaps", &["slam", "localize", "map", "costmap"]),
    ("Robots and worlds", &["check", "convert"]),
    (
        "ROS 2 and Gazebo",
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
        ],
    ),
    ("This program", &["completions", "man", "conformance", "help"]),
];

/// Commands of ROS and Gazebo that are translated, for the help.
const TRANSLATED: &str = "ros2, gz, ign, gazebo, rosrun, roslaunch, rostopic, rosnode, rosservice, rosparam, \
                          rosbag, rviz2, xacro, colcon ...";

/// Most examples under a group of commands.
const MOST_OF_GROUP: usize = 6;

/// The whole command line, with its help.
pub(crate) fn command() -> Command {
    let command = finished(Options::command(), "");
    let template = top(&command);
    command.help_template(template)
}

/// Parses words; a usage error ends the program with exit code 2.
pub(crate) fn parse(words: Vec<String>) -> Options {
    let matches = command().get_matches_from(words);
    Options::from_arg_matches(&matches).unwrap_or_else(|error| error.format(&mut command()).exit())
}

/// A command and all below it, with examples and full stops.
fn finished(command: Command, path: &str) -> Command {
    let command = command.mut_subcommands(|below| {
        let path = format!("{path} {}", below.get_name());
        finished(below, path.trim())
    });
    let command = with_full_stop(command);
    let examples = examples_of(path);
    if examples.is_empty() { command } else { command.after_help(shown(&examples)) }
}

/// Puts a full stop behind a first line that other sentences follow.
fn with_full_stop(command: Command) -> Command {
    let Some(text) = command.get_long_about().map(ToString::to_string) else { return command };
    match text.split_once("\n\n") {
        Some((first, rest)) if !first.ends_with('.') => {
            command.long_about(format!("{first}.\n\n{rest}"))
        }
        _ => command,
    }
}

/// Examples of a command, or the first of each command below a group.
fn examples_of(path: &str) -> Vec<Example> {
    if path.is_empty() {
        return Vec::new();
    }
    if let Some((_, own)) = EXAMPLES.iter().find(|(of, _)| *of == path) {
        return own.to_vec();
    }
    let below = EXAMPLES.iter().filter(|(of, _)| of.starts_with(&format!("{path} ")));
    below.filter_map(|(_, examples)| examples.first().copied()).take(MOST_OF_GROUP).collect()
}

fn shown(examples: &[Example]) -> StyledStr {
    let bold = clap::builder::styling::Style::new().bold().underline();
    let mut text = format!("{bold}Examples:{bold:#}");
    for (line, purpose) in examples {
        let _ = write!(text, "\n  {line}\n      {purpose}");
    }
    text.into()
}

/// Template of the top help: the groups in the place of clap's one list.
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
        "\n{title}Commands of ROS and Gazebo, translated:{title:#}\n  {TRANSLATED}\n  \
         as in `periplus ros2 topic list`, `periplus gz sim world.sdf`\n\n{title}Options:{title:#}\n\
         {{options}}\n\n{title}Examples:{title:#}\n  \
         periplus                              a robot in a room, in the browser\n  \
         periplus new package my_bot           a robot of your own, with a room and a launch file\n  \
         periplus launch my_bot simulation.launch.py\n  \
         periplus sim --help                   the options of a command\n"
    );
    text.into()
}

/// A description up to its first colon, as far as it does not fit into a line.
fn first_clause(about: &str) -> &str {
    const LONGEST: usize = 84;
    if about.chars().count() <= LONGEST {
        return about;
    }
    about.split_once(": ").map_or(about, |(first, _)| first)
}

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;
