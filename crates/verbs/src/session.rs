//! One use of the command.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_diagnostics::closest;
use periplus_graph::{Node, NodeSettings};
use periplus_host::Stopwatch;
use serde_json::json;

use crate::network::OWN_NODE;
use crate::{Failure, Network, Outcome, Seen, Types};

/// How long others have to be found, if it is not said: at least so long ...
const LEAST: Duration = Duration::from_millis(600);
/// ... then until nothing has changed for so long ...
const QUIET: Duration = Duration::from_millis(200);
/// ... and at most so long.
const MOST: Duration = Duration::from_millis(2_000);

/// How often a loop looks whether it is to stop.
pub(crate) const BREATH: Duration = Duration::from_millis(100);

/// One use of the command: its network, the types it knows, and where it writes.
pub struct Session<'a> {
    /// Who else is there.
    pub network: &'a dyn Network,
    /// Message types.
    pub types: &'a Types,
    /// Results.
    pub out: &'a mut dyn Write,
    /// What is said beside them.
    pub talk: &'a mut dyn Write,
    /// Set when it is to stop.
    pub stop: &'a AtomicBool,
    /// Whether results are JSON: one object, or one on each line of a stream.
    pub json: bool,
    /// How long others have to be found; by itself at least 0.6 s and until all is quiet.
    pub spin_time: Option<Duration>,
}

impl Session<'_> {
    /// Who is there, when they have had time to be found.
    pub fn look(&self) -> Seen {
        let clock = Stopwatch::start();
        let mut last = (self.network.seen(), Duration::ZERO);
        loop {
            let now = clock.elapsed();
            let is_done = match self.spin_time {
                Some(time) => now >= time,
                None => now >= MOST || now >= LEAST && now >= last.1 + QUIET,
            };
            if is_done || self.is_stopped() {
                return last.0;
            }
            let rest = self.spin_time.map_or(QUIET, |time| (time - now).min(QUIET));
            let before = last.0.clone();
            if self.network.wait(rest.min(BREATH), &mut |seen| *seen != before) {
                last = (self.network.seen(), clock.elapsed());
            }
        }
    }

    /// How long who is there may take to be found.
    pub(crate) fn found_within(&self) -> Duration {
        self.spin_time.unwrap_or(MOST)
    }

    /// Waits for something as long as others have to be found; what is there then.
    pub fn look_for(&self, wanted: impl Fn(&Seen) -> bool) -> (Seen, bool) {
        let is_there = self.wait(Some(self.found_within()), wanted).unwrap_or(false);
        (self.network.seen(), is_there)
    }

    /// Waits for something, at most so long or until it is told to stop; whether it is so.
    ///
    /// # Errors
    /// When it was told to stop.
    pub fn wait(
        &self,
        timeout: Option<Duration>,
        mut wanted: impl FnMut(&Seen) -> bool,
    ) -> Outcome<bool> {
        let clock = Stopwatch::start();
        loop {
            let now = clock.elapsed();
            let rest = timeout.map_or(BREATH, |timeout| timeout.saturating_sub(now).min(BREATH));
            if self.network.wait(rest, &mut wanted) {
                return Ok(true);
            }
            self.go_on()?;
            if timeout.is_some_and(|timeout| clock.elapsed() >= timeout) {
                return Ok(false);
            }
        }
    }

    /// Whether it was told to stop.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// # Errors
    /// When it was told to stop.
    pub fn go_on(&self) -> Outcome {
        if self.is_stopped() { Err(Failure::Interrupted) } else { Ok(()) }
    }

    /// The verb's own node, under a name that no other has.
    ///
    /// # Errors
    /// When the graph refuses the name.
    pub fn node(&self, name: Option<&str>) -> Outcome<Node> {
        let name = match name {
            Some(name) => name.to_owned(),
            None => format!("{OWN_NODE}_{}", std::process::id()),
        };
        Ok(self.network.graph().node(NodeSettings::new(name).bare())?)
    }

    /// Says something that is no result.
    pub fn say(&mut self, words: &str) {
        let _ = writeln!(self.talk, "{words}");
    }

    /// Writes names, one on a line, or how many there are.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub(crate) fn put_names<N: std::fmt::Display>(&mut self, names: &[N], count: bool) -> Outcome {
        if count {
            writeln!(self.out, "{}", names.len())?;
        } else {
            for name in names {
                writeln!(self.out, "{name}")?;
            }
        }
        self.out.flush()?;
        Ok(())
    }

    /// Writes the types of what has this name.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub(crate) fn put_types(&mut self, name: &str, types: &[String]) -> Outcome {
        if self.json {
            return self.put(&json!({ "name": name, "types": types }));
        }
        self.put_names(types, false)
    }

    /// Writes the names of what has this type, or how many have it.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub(crate) fn put_found(
        &mut self,
        type_name: &str,
        what: &str,
        names: &[&str],
        count: bool,
    ) -> Outcome {
        if self.json {
            return self.put(&json!({ "type": type_name, what: names }));
        }
        self.put_names(names, count)
    }

    /// Writes one JSON object on a line.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn put(&mut self, json: &serde_json::Value) -> Outcome {
        writeln!(self.out, "{json}")?;
        self.out.flush()?;
        Ok(())
    }
}

/// A name, with its types if they are to be shown.
pub(crate) fn titled(name: &str, types: &[String], show_types: bool) -> String {
    if show_types { format!("{name} [{}]", types.join(", ")) } else { name.to_owned() }
}

/// A name as nodes in the root namespace understand it.
pub(crate) fn full_name(name: &str) -> String {
    if name.starts_with('/') { name.to_owned() } else { format!("/{name}") }
}

/// ` Did you mean ...?`, or which there are.
pub(crate) fn advice<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> String {
    let known: Vec<&str> = known.collect();
    match closest(name, known.iter().copied()) {
        Some(near) => format!("; did you mean `{near}`?"),
        None => String::new(),
    }
}
