//! Log of a launch.

use std::io::{self, Write as _};

use periplus_graph::Level;
use periplus_launch::bringup::{LaunchRunner, PartOutcomeKind, PartReport};
use periplus_session::ProgressLine;

/// Prints the log of a launch.
pub(super) struct LogPrinter {
    /// Number of printed outcomes of parts.
    printed: usize,
    is_quiet: bool,
    /// True if a part of the launch failed.
    pub(super) has_failed: bool,
}

impl LogPrinter {
    pub(super) fn new(is_quiet: bool) -> Self {
        Self { printed: 0, is_quiet, has_failed: false }
    }

    /// Prints new lines, beside the progress bar if there is one.
    pub(super) fn print(&mut self, bringup: &mut LaunchRunner, bar: Option<&ProgressLine>) {
        let log = bringup.take_log();
        let lines = &bringup.lines()[self.printed..];
        if log.is_empty() && lines.is_empty() {
            return;
        }
        self.printed = bringup.lines().len();
        self.has_failed |= log.iter().any(|one| one.level >= Level::Error && !one.is_of_node);
        let is_quiet = self.is_quiet;
        let write = || -> io::Result<()> {
            let mut err = anstream::stderr().lock();
            for line in lines.iter().filter(|_| !is_quiet) {
                write_outcome(&mut err, line)?;
            }
            for one in log.iter().filter(|one| !is_quiet || one.level >= Level::Error) {
                match one.level {
                    _ if one.is_of_node => writeln!(err, "{}", one.text)?,
                    level if level >= Level::Error => writeln!(err, "error: {}", one.text)?,
                    Level::Warn => writeln!(err, "warning: {}", one.text)?,
                    _ => writeln!(err, "{}", one.text)?,
                }
            }
            Ok(())
        };
        match bar {
            Some(bar) => bar.aside(write),
            // A closed terminal must not end a run.
            None => drop(write()),
        }
    }
}

/// Writes the outcome of a part on a line: `+` it runs, `=` nothing to do, `-` it is missing.
pub(in crate::launch) fn write_outcome(
    out: &mut dyn io::Write,
    line: &PartReport,
) -> io::Result<()> {
    let sign = match line.outcome.kind {
        PartOutcomeKind::World
        | PartOutcomeKind::BuiltIn
        | PartOutcomeKind::Python
        | PartOutcomeKind::Program => "+",
        PartOutcomeKind::Needless => "=",
        PartOutcomeKind::Missing => "-",
    };
    let node = line.outcome.node.as_deref();
    let node = node.map(|node| format!("{node}: ")).unwrap_or_default();
    writeln!(out, "{sign} {}: {node}{}", short(&line.asked), line.outcome.told)
}

/// Truncates a long text.
fn short(text: &str) -> String {
    const MAX_CHARS: usize = 80;
    if text.chars().count() <= MAX_CHARS {
        return text.to_owned();
    }
    text.chars().take(MAX_CHARS).chain("...".chars()).collect()
}
