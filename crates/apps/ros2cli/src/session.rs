//! Session: one use of the command.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_diagnostics::closest;
use periplus_graph::{Node, NodeSettings};
use periplus_os::{Stopwatch, sleep};
use serde_json::json;

use crate::network::{OWN_NODE, Progress};
use crate::{Failure, Network, Outcome, Seen, Types};

/// Minimum duration of discovery without `--spin-time`.
const MIN_DISCOVERY: Duration = Duration::from_millis(600);

/// Discovery continues until nothing has changed for this time.
const SETTLE_TIME: Duration = Duration::from_millis(200);

/// Maximum wait for participants on this machine that do not respond: they may be on another
/// network.
const MAX_UNANSWERED: Duration = Duration::from_millis(2_500);

/// Maximum wait for participants that were discovered incompletely.
const MAX_INCOMPLETE: Duration = Duration::from_secs(10);

/// Maximum time to find a node, topic or service, without `--spin-time`.
const MIN_SEARCH: Duration = Duration::from_millis(2_000);

/// Polling period of discovery.
const POLL_PERIOD: Duration = Duration::from_millis(20);

/// Polling period of the interrupt flag.
pub(crate) const INTERRUPT_POLL_PERIOD: Duration = Duration::from_millis(100);

/// One use of the command: its network, its types, and its output.
pub struct Session<'a> {
    /// Network of the session.
    pub network: &'a dyn Network,
    /// Message types.
    pub types: &'a Types,
    /// Output of results.
    pub out: &'a mut dyn Write,
    /// Output of notes and warnings.
    pub talk: &'a mut dyn Write,
    /// Interrupt flag.
    pub stop: &'a AtomicBool,
    /// True to print JSON: one object, or one per line of a stream.
    pub json: bool,
    /// Duration of discovery. If `None`, at least 0.6 s, and until every participant found has
    /// announced all its nodes, topics and services.
    pub spin_time: Option<Duration>,
}

impl Session<'_> {
    /// Returns nodes, topics and services after discovery, with a warning about participants that
    /// were discovered incompletely.
    pub fn look(&mut self) -> Seen {
        let progress = self.discover(MIN_DISCOVERY, |_| false);
        if progress.incomplete > 0 && !self.is_stopped() {
            let (count, programs) = match progress.incomplete {
                1 => ("one".to_owned(), "program"),
                count => (count.to_string(), "programs"),
            };
            self.say(&format!(
                "WARNING: {count} {programs} on the network did not announce all nodes, topics and services \
                 in time; the list is incomplete. Wait longer with `--spin-time SECONDS`"
            ));
        }
        self.network.seen()
    }

    /// Waits for discovery: for `--spin-time`, or at least `min` and until all participants found
    /// are completely known. Ends early if `is_found`.
    fn discover(&self, min: Duration, is_found: impl Fn(&Seen) -> bool) -> Progress {
        let clock = Stopwatch::start();
        let mut last = self.network.progress();
        let mut changed = Duration::ZERO;
        let mut is_new = true;
        loop {
            if is_new && is_found(&self.network.seen()) {
                return last;
            }
            let now = clock.elapsed();
            let is_done = match self.spin_time {
                Some(time) => now >= time,
                None => {
                    let is_settled = now >= changed + SETTLE_TIME
                        && last.incomplete == 0
                        && (last.unanswered == 0 || now >= MAX_UNANSWERED);
                    now >= MAX_INCOMPLETE || now >= min && is_settled
                }
            };
            if is_done || self.is_stopped() {
                return last;
            }
            sleep(POLL_PERIOD);
            let progress = self.network.progress();
            is_new = progress.changes != last.changes;
            if is_new {
                changed = clock.elapsed();
            }
            last = progress;
        }
    }

    /// Maximum time to find a node or service.
    pub(crate) fn found_within(&self) -> Duration {
        self.spin_time.unwrap_or(MIN_SEARCH)
    }

    /// Waits until something is found or discovery ends; returns the snapshot, and true if it was
    /// found.
    pub fn look_for(&self, wanted: impl Fn(&Seen) -> bool) -> (Seen, bool) {
        self.discover(self.found_within(), &wanted);
        let seen = self.network.seen();
        let is_there = wanted(&seen);
        (seen, is_there)
    }

    /// Waits for a condition, up to a timeout; returns true if it holds.
    ///
    /// # Errors
    /// When interrupted.
    pub fn wait(
        &self,
        timeout: Option<Duration>,
        mut wanted: impl FnMut(&Seen) -> bool,
    ) -> Outcome<bool> {
        let clock = Stopwatch::start();
        loop {
            let now = clock.elapsed();
            let rest = timeout.map_or(INTERRUPT_POLL_PERIOD, |timeout| {
                timeout.saturating_sub(now).min(INTERRUPT_POLL_PERIOD)
            });
            if self.network.wait(rest, &mut wanted) {
                return Ok(true);
            }
            self.check_interrupted()?;
            if timeout.is_some_and(|timeout| clock.elapsed() >= timeout) {
                return Ok(false);
            }
        }
    }

    /// Returns true when interrupted.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// # Errors
    /// When interrupted.
    pub fn check_interrupted(&self) -> Outcome {
        if self.is_stopped() { Err(Failure::Interrupted) } else { Ok(()) }
    }

    /// Creates the verb's own node, with a unique name.
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

    /// Prints a note.
    pub fn say(&mut self, words: &str) {
        let _ = writeln!(self.talk, "{words}");
    }

    /// Prints names, one per line, or their number.
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

    /// Prints names as [`Session::put_names`], with a note if there are none.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub(crate) fn put_list<N: std::fmt::Display>(
        &mut self,
        what: &str,
        names: &[N],
        count: bool,
    ) -> Outcome {
        if names.is_empty() && !count {
            self.say(&format!(
                "no {what} was found: no program on this network has one \
                 (`periplus doctor` examines the network)"
            ));
        }
        self.put_names(names, count)
    }

    /// Types as the network writes them.
    pub(crate) fn shown_types(&self, types: &[String]) -> Vec<String> {
        types.iter().map(|name| self.network.shown_type(name)).collect()
    }

    /// Prints the types of the entity of this name.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub(crate) fn put_types(&mut self, name: &str, types: &[String]) -> Outcome {
        if self.json {
            return self.put(&json!({ "name": name, "types": types }));
        }
        self.put_names(&self.shown_types(types), false)
    }

    /// Prints the names of the entities of this type, or their number.
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
        self.put_list(&format!("{} of this type", what.trim_end_matches('s')), names, count)
    }

    /// Prints one JSON object on a line.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn put(&mut self, json: &serde_json::Value) -> Outcome {
        writeln!(self.out, "{json}")?;
        self.out.flush()?;
        Ok(())
    }
}

/// Name, with its types if requested.
pub(crate) fn titled(name: &str, types: &[String], show_types: bool) -> String {
    if show_types { format!("{name} [{}]", types.join(", ")) } else { name.to_owned() }
}

/// Full name, as resolved by nodes in the root namespace.
pub(crate) fn full_name(name: &str) -> String {
    if name.starts_with('/') { name.to_owned() } else { format!("/{name}") }
}

/// Suggestion ` Did you mean ...?`, or the known names.
pub(crate) fn advice<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> String {
    let known: Vec<&str> = known.collect();
    match closest(name, known.iter().copied()) {
        Some(near) => format!("; did you mean `{near}`?"),
        None => String::new(),
    }
}
