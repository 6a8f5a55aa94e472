//! Translation of ROS and Gazebo commands: `periplus ros2 launch ...`, `periplus gz sim ...`,
//! `periplus rosrun map_server map_saver -f room`.
//!
//! A plain table from words to words, before anything is parsed. What needs nothing done (installing,
//! building) and what the shell does is answered; so is what Periplus does not have, with what there is
//! instead. `docs/ros-and-gazebo-commands.md` is made from the examples in its tests.

mod answers;
mod gazebo;
mod packages;
mod programs;
mod ros1;
mod ros2;
mod shell;
#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use tests::words as words_of_line;

use std::io;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::terminal;

/// True after a `ros2` command was translated.
static IS_ROS2: AtomicBool = AtomicBool::new(false);

/// Returns true for a `ros2` command behind `periplus`, whose exit codes are those of `ros2`.
pub(crate) fn is_ros2() -> bool {
    IS_ROS2.load(Ordering::Relaxed)
}

/// Result of translating a command line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Reading {
    /// The command is one of Periplus.
    Ours,
    /// Equivalent command, and notes for the user.
    Words { words: Vec<String>, notes: Vec<String> },
    /// Nothing to run.
    Answer(Answer),
}

/// Explanation printed instead of running a command.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Answer {
    pub(crate) text: String,
    /// True to list the packages found.
    pub(crate) lists_packages: bool,
    /// 0 when nothing is missing, 1 for missing features, 2 for commands that belong elsewhere.
    pub(crate) code: u8,
}

/// Translates the words behind `periplus`.
pub(crate) fn read(words: &[String]) -> Reading {
    // A line with `&&` that was passed as it is.
    if let Some(at) = words.iter().position(|word| word == "&&" || word == ";") {
        return match read(&words[..at]) {
            Reading::Answer(answer) if answer.code == 0 => read(&words[at + 1..]),
            first => first,
        };
    }
    let [program, rest @ ..] = words else { return Reading::Ours };
    match program.as_str() {
        "ros2" => ros2::read(rest),
        "gz" | "ign" => gazebo::read(program, rest),
        "gazebo" | "gzserver" | "gzclient" => gazebo::classic(program, rest),
        _ => ros1::read(program, rest)
            .or_else(|| programs::alone(program, rest))
            .or_else(|| shell::read(program, rest))
            .unwrap_or(Reading::Ours),
    }
}

/// Concatenates an own command with further words.
pub(crate) fn become_words(ours: &[&str], rest: Vec<String>) -> Reading {
    let words = ours.iter().map(|word| (*word).to_owned()).chain(rest).collect();
    Reading::Words { words, notes: Vec::new() }
}

impl Reading {
    /// Uses ROS 1 if a master answers: the option comes after the verbs of the command.
    pub(crate) fn on_ros1(mut self, verbs: usize) -> Self {
        if let Self::Words { words, .. } = &mut self {
            words.insert(verbs, "--ros1=auto".to_owned());
        }
        self
    }

    /// Adds a note, if there is a command to run.
    pub(crate) fn noting(mut self, note: impl Into<String>) -> Self {
        if let Self::Words { notes, .. } = &mut self {
            notes.push(note.into());
        }
        self
    }
}

/// Prints the translation; returns the words to parse, or the exit code.
pub(crate) fn translate(words: Vec<String>) -> io::Result<Result<Vec<String>, ExitCode>> {
    IS_ROS2.store(words.get(1).is_some_and(|word| word == "ros2"), Ordering::Relaxed);
    match read(words.get(1..).unwrap_or_default()) {
        Reading::Ours => Ok(Ok(words)),
        Reading::Words { words: ours, notes } => {
            terminal::say(&format!("running: periplus {}", shown(&ours)));
            for note in notes {
                terminal::say(&format!("note: {note}"));
            }
            let program = words.into_iter().next();
            Ok(Ok(program.into_iter().chain(ours).collect()))
        }
        Reading::Answer(answer) => {
            terminal::say(&answer.text);
            if answer.lists_packages {
                packages::list(&mut io::stdout().lock())?;
            }
            Ok(Err(ExitCode::from(answer.code)))
        }
    }
}

/// Words quoted for a shell.
pub(crate) fn shown(words: &[String]) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./:=@,+~%[]".contains(letter);
    let quoted = words.iter().map(|word| {
        if !word.is_empty() && word.chars().all(is_plain) {
            word.clone()
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    });
    quoted.collect::<Vec<_>>().join(" ")
}
