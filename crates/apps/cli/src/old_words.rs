//! Words that hands know from ROS and Gazebo, in words of Periplus: `periplus ros2 launch ...`,
//! `periplus gz sim ...`, `periplus rosrun map_server map_saver -f room`.
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

use crate::terminal;

/// True for a command of `ros2` behind `periplus`, whose exit codes are those of `ros2`.
pub(crate) fn is_ros2() -> bool {
    std::env::args().nth(1).is_some_and(|word| word == "ros2")
}

/// What words mean.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Reading {
    /// They are Periplus' own.
    Ours,
    /// These do the same; and what is to be said besides.
    Words { words: Vec<String>, notes: Vec<String> },
    /// There is nothing to run.
    Answer(Answer),
}

/// What is said instead of doing something.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Answer {
    pub(crate) text: String,
    /// Whether the packages that can be found are listed.
    pub(crate) lists_packages: bool,
    /// 0 when nothing is missing, 1 for what is not there, 2 for what belongs elsewhere.
    pub(crate) code: u8,
}

/// Reads what was typed behind `periplus`.
pub(crate) fn read(words: &[String]) -> Reading {
    // A line with `&&`, handed over as it stands.
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

/// Puts words of ours behind each other.
pub(crate) fn become_words(ours: &[&str], rest: Vec<String>) -> Reading {
    let words = ours.iter().map(|word| (*word).to_owned()).chain(rest).collect();
    Reading::Words { words, notes: Vec::new() }
}

impl Reading {
    /// With a remark, where there are words to remark on.
    pub(crate) fn noting(mut self, note: impl Into<String>) -> Self {
        if let Self::Words { notes, .. } = &mut self {
            notes.push(note.into());
        }
        self
    }
}

/// Says what the words became; what is left to be parsed, or how it ends.
pub(crate) fn translate(words: Vec<String>) -> io::Result<Result<Vec<String>, ExitCode>> {
    match read(words.get(1..).unwrap_or_default()) {
        Reading::Ours => Ok(Ok(words)),
        Reading::Words { words: ours, notes } => {
            terminal::say(&format!("here this is: periplus {}", shown(&ours)));
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

/// Words as they would be typed.
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
