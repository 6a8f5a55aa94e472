//! The command reference in `docs/cli`, one page for each command, made from the command line itself.
//! `UPDATE_EXPECT=1 cargo test -p periplus-cli reference` rewrites the pages.
#![allow(clippy::disallowed_methods, reason = "the pages are beside the sources")]

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Arg, Command};
use expect_test::expect_file;

use super::{GROUPS, command, examples_of, first_clause};

/// Options that every command has; the index lists them.
const COMMON: [&str; 3] = ["colour", "help", "version"];

#[test]
fn the_reference_has_every_command() {
    let mut program = command();
    program.build();
    let folder = folder();
    let mut written = BTreeSet::from(["index.md".to_owned()]);
    expect_file![folder.join("index.md")].assert_eq(&index(&program));
    for (name, below) in commands(&program) {
        let mut page = String::new();
        write_command(&mut page, below, name, 1);
        let file = format!("{name}.md");
        expect_file![folder.join(&file)].assert_eq(&page);
        written.insert(file);
    }
    let there: BTreeSet<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(there, written, "pages of `docs/cli` without a command are to be deleted");
}

/// Commands with a page, in the order of the help.
fn commands(program: &Command) -> impl Iterator<Item = (&'static str, &Command)> {
    let names = GROUPS.iter().flat_map(|(_, names)| names.iter().copied());
    names
        .filter_map(|name| Some((name, program.find_subcommand(name)?)))
        .filter(|it| it.0 != "help")
}

/// `docs/cli` at the root of the tree.
fn folder() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = own.ancestors().find(|folder| folder.join("Cargo.lock").is_file());
    root.unwrap().join("docs/cli")
}

/// The page with all commands.
fn index(program: &Command) -> String {
    let mut page = String::from(
        "# Commands\n\nThe pages of this folder are generated from the program: `UPDATE_EXPECT=1 cargo test \
         -p periplus-cli reference` rewrites them. `periplus COMMAND --help` prints the same text, \
         `periplus man DIR` writes manual pages, `periplus completions SHELL` prints shell completion.\n\n\
         Results go to standard output, everything else to standard error. Exit code 0: success; 1: the job \
         failed; 2: wrong usage; 130, 143, 129: stopped by Ctrl-C, SIGTERM, SIGHUP. Commands of ROS and \
         Gazebo are translated: see [ROS and Gazebo commands](../ros-and-gazebo-commands.md).\n",
    );
    for (group, names) in GROUPS {
        let _ = write!(page, "\n## {group}\n\n| Command | Purpose |\n|---|---|\n");
        for name in names.iter().filter(|name| **name != "help") {
            let about = program.find_subcommand(name).and_then(Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            let about = escaped(first_clause(&about)).replace('|', "\\|");
            let _ = writeln!(page, "| [`periplus {name}`]({name}.md) | {about} |");
        }
    }
    page.push_str("\n## Options of every command\n\n");
    for argument in program.get_arguments().filter(|it| COMMON.contains(&it.get_id().as_str())) {
        write_argument(&mut page, argument);
    }
    page
}

/// A command and all below it, under headings of a level.
fn write_command(page: &mut String, command: &Command, path: &str, level: usize) {
    let _ = writeln!(page, "{} periplus {path}", "#".repeat(level));
    if let Some(about) = command.get_long_about().or_else(|| command.get_about()) {
        let text = paragraphs(&about.to_string()).join("\n\n");
        let stop = if text.ends_with(['.', ':', '!', '?']) { "" } else { "." };
        let _ = write!(page, "\n{text}{stop}\n");
    }
    let usage = command.clone().render_usage().to_string();
    let usage: Vec<&str> = usage.trim_start_matches("Usage: ").lines().map(str::trim).collect();
    let _ = write!(page, "\n```text\n{}\n```\n", usage.join("\n"));
    let is_shown = |it: &&Arg| !it.is_hide_set() && !COMMON.contains(&it.get_id().as_str());
    let arguments: Vec<&Arg> = command.get_arguments().filter(is_shown).collect();
    let (positional, options): (Vec<&Arg>, Vec<&Arg>) =
        arguments.into_iter().partition(|argument| argument.is_positional());
    write_list(page, "Arguments", &positional);
    let mut headings: Vec<&str> = Vec::new();
    for option in &options {
        let heading = option.get_help_heading().unwrap_or("Options");
        if !headings.contains(&heading) {
            headings.push(heading);
        }
    }
    for heading in headings {
        let is_here = |option: &&Arg| option.get_help_heading().unwrap_or("Options") == heading;
        let here: Vec<&Arg> = options.iter().copied().filter(is_here).collect();
        write_list(page, heading, &here);
    }
    let is_group = command.is_subcommand_required_set();
    let examples = if is_group { Vec::new() } else { examples_of(path) };
    if !examples.is_empty() {
        page.push_str("\n**Examples**\n");
        for (line, purpose) in examples {
            let _ = write!(page, "\n{}:\n\n```sh\n{line}\n```\n", escaped(purpose));
        }
    }
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        page.push('\n');
        write_command(page, below, &format!("{path} {}", below.get_name()), level + 1);
    }
}

fn write_list(page: &mut String, title: &str, arguments: &[&Arg]) {
    if arguments.is_empty() {
        return;
    }
    let _ = write!(page, "\n**{title}**\n\n");
    arguments.iter().for_each(|argument| write_argument(page, argument));
}

/// One argument with its values, default and help.
fn write_argument(page: &mut String, argument: &Arg) {
    let takes_values = argument.get_action().takes_values();
    let mut names: Vec<String> = Vec::new();
    names.extend(argument.get_short().map(|short| format!("-{short}")));
    names.extend(argument.get_long().map(|long| format!("--{long}")));
    let values: Vec<String> = argument
        .get_value_names()
        .filter(|_| takes_values)
        .unwrap_or_default()
        .iter()
        .map(|name| if argument.is_positional() { name.to_string() } else { format!("<{name}>") })
        .collect();
    if let (Some(last), false) = (names.last_mut(), values.is_empty()) {
        let _ = write!(last, " {}", values.join(" "));
    }
    if argument.is_positional() {
        names = values;
    }
    let _ = write!(page, "- `{}`", names.join("`, `"));
    let text = argument.get_long_help().or_else(|| argument.get_help());
    let mut text = text.map(|help| paragraphs(&help.to_string()).join(" ")).unwrap_or_default();
    if !text.is_empty() && !text.ends_with(['.', ':', '!', '?']) {
        text.push('.');
    }
    if !text.is_empty() {
        let _ = write!(page, ": {text}");
    }
    let defaults: Vec<String> = argument
        .get_default_values()
        .iter()
        .filter(|value| takes_values && !value.is_empty())
        .map(|value| format!("`{}`", value.to_string_lossy()))
        .collect();
    if !defaults.is_empty() {
        let _ = write!(page, " Default: {}.", defaults.join(", "));
    }
    let possible = if takes_values { argument.get_possible_values() } else { Vec::new() };
    if possible.iter().any(|value| value.get_help().is_some()) {
        page.push('\n');
        for value in possible.iter().filter(|value| !value.is_hide_set()) {
            let help = value.get_help().map(|help| escaped(&help.to_string())).unwrap_or_default();
            let _ = writeln!(page, "  - `{}`: {help}", value.get_name());
        }
        return;
    }
    if !possible.is_empty() {
        let shown: Vec<String> = possible
            .iter()
            .filter(|value| !value.is_hide_set())
            .map(|value| format!("`{}`", value.get_name()))
            .collect();
        let _ = write!(page, " Values: {}.", shown.join(", "));
    }
    page.push('\n');
}

/// Paragraphs of a help text, each on one line; lines that are indented stay as they are.
fn paragraphs(text: &str) -> Vec<String> {
    let joined = |paragraph: &str| {
        let lines: Vec<String> = paragraph.lines().map(|line| escaped(line.trim())).collect();
        lines.join(" ")
    };
    text.split("\n\n").map(joined).filter(|paragraph| !paragraph.is_empty()).collect()
}

/// Text with `<`, `>` and `*` as such, apart from code.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for (at, part) in text.split('`').enumerate() {
        if at > 0 {
            out.push('`');
        }
        for letter in part.chars() {
            if at % 2 == 0 && "<>*".contains(letter) {
                out.push('\\');
            }
            out.push(letter);
        }
    }
    out
}

#[test]
fn signs_of_markdown_are_escaped_outside_of_code() {
    assert_eq!(escaped("a <b> `<c>` *d*"), "a \\<b\\> `<c>` \\*d\\*");
    assert_eq!(paragraphs("one\ntwo\n\nthree"), ["one two", "three"]);
}
