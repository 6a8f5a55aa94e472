//! Tests that the help is complete and that its examples parse.

use std::collections::BTreeSet;

use clap::Command;
use periplus_graph::split_arguments;

use super::{EXAMPLES, GROUPS, command, examples_of};
use crate::foreign_commands::words_of_line;

/// Paths of all commands without subcommands.
fn leaves(command: &Command, path: &str, found: &mut Vec<String>) {
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        let path = format!("{path} {}", below.get_name()).trim().to_owned();
        let is_group = below.is_subcommand_required_set();
        if !is_group {
            found.push(path.clone());
        }
        leaves(below, &path, found);
    }
}

#[test]
fn every_command_has_examples_and_no_other_has() {
    let mut found = Vec::new();
    leaves(&command(), "", &mut found);
    let all: BTreeSet<&str> = found.iter().map(String::as_str).collect();
    let with: BTreeSet<&str> = EXAMPLES.iter().map(|(path, _)| *path).collect();
    assert_eq!(all, with);
    assert!(!examples_of("topic").is_empty() && !examples_of("new").is_empty());
}

#[test]
fn every_example_can_be_typed() {
    for (path, examples) in EXAMPLES {
        for (line, purpose) in *examples {
            assert!(line.starts_with(&format!("periplus {path}")), "{line}");
            assert!(!purpose.ends_with('.'), "{purpose}");
            let (words, _) = split_arguments(words_of_line(line));
            if let Err(error) = command().try_get_matches_from(words) {
                panic!("`{line}`: {error}");
            }
        }
    }
}

#[test]
fn every_command_is_in_one_group() {
    let command = command();
    let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
    let mut all: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
    all.push("help");
    grouped.sort_unstable();
    all.sort_unstable();
    all.dedup();
    assert_eq!(grouped, all);
}

#[test]
fn commands_that_differ_are_described_differently() {
    fn check(command: &Command) {
        let abouts: Vec<String> = command
            .get_subcommands()
            .filter_map(|below| below.get_about().map(ToString::to_string))
            .collect();
        let distinct: BTreeSet<&String> = abouts.iter().collect();
        assert_eq!(distinct.len(), abouts.len(), "{abouts:?}");
        command.get_subcommands().for_each(check);
    }
    check(&command());
}

#[test]
fn help_of_every_command_ends_with_examples_and_its_first_line_is_a_sentence() {
    fn check(command: &mut Command) {
        command.build();
        for below in command.get_subcommands_mut().filter(|below| below.get_name() != "help") {
            if below.get_name() != "save" {
                let text = below.render_long_help().to_string();
                assert!(text.contains("Examples:\n  periplus "), "{}", below.get_name());
                let about = below.get_long_about().map(ToString::to_string).unwrap_or_default();
                if let Some((first, _)) = about.split_once("\n\n") {
                    assert!(first.ends_with('.'), "{first}");
                }
            }
            check(below);
        }
    }
    check(&mut command());
}

#[test]
fn words_of_others_are_in_the_top_help() {
    let text = command().render_long_help().to_string();
    for word in ["ros2", "gz", "rosrun", "roslaunch", "Start here:", "Options:", "--color", "new "]
    {
        assert!(text.contains(word), "no `{word}` in {text}");
    }
}
