//! Lines of a node's log, on `/rosout`.

use std::fmt;
use std::panic::Location;
use std::sync::atomic::Ordering;

use periplus_diagnostics::{Diagnostic, Severity};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rcl_interfaces::Log;

use crate::node::Node;

/// How much a line of a log matters. The order is that of weight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// For who looks into the node.
    Debug,
    /// What goes as it should.
    #[default]
    Info,
    /// What may be wrong.
    Warn,
    /// What is wrong.
    Error,
    /// After this the node does nothing more.
    Fatal,
}

impl Level {
    /// All of them, from the least.
    pub const ALL: [Self; 5] = [Self::Debug, Self::Info, Self::Warn, Self::Error, Self::Fatal];

    /// As `rcl_interfaces/msg/Log` counts.
    #[must_use]
    pub fn number(self) -> u8 {
        match self {
            Self::Debug => Log::DEBUG,
            Self::Info => Log::INFO,
            Self::Warn => Log::WARN,
            Self::Error => Log::ERROR,
            Self::Fatal => Log::FATAL,
        }
    }

    /// The level of a line that came from elsewhere: numbers between two levels count as the lower.
    #[must_use]
    pub fn of_number(number: u8) -> Self {
        let known = Self::ALL.into_iter().rev().find(|level| level.number() <= number);
        known.unwrap_or(Self::Debug)
    }

    /// The level of a name, in any case: `warn`, `WARN`, `WARNING`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "debug" => Some(Self::Debug),
            "info" => Some(Self::Info),
            "warn" | "warning" => Some(Self::Warn),
            "error" => Some(Self::Error),
            "fatal" => Some(Self::Fatal),
            _ => None,
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Debug => "DEBUG",
            Self::Info => "INFO",
            Self::Warn => "WARN",
            Self::Error => "ERROR",
            Self::Fatal => "FATAL",
        })
    }
}

impl Node {
    /// Writes a line into the log of the node: on `/rosout`, under the name of the node. Lines below
    /// its level ([`Node::set_log_level`]) are not even put together.
    ///
    /// ```
    /// use periplus_graph::{Graph, Level, NodeSettings};
    ///
    /// let node = Graph::new().node(NodeSettings::new("scan"))?;
    /// node.log(Level::Warn, format_args!("{} of {} beams hit the robot itself", 3, 360));
    /// # Ok::<(), periplus_graph::GraphError>(())
    /// ```
    #[track_caller]
    pub fn log(&self, level: Level, text: impl fmt::Display) {
        if self.logs(level) {
            let place = Location::caller();
            let standard = self.0.standard();
            standard.publish_log(Log {
                stamp: Time::of_ns(self.now_ns()),
                level: level.number(),
                name: self.logger(),
                msg: text.to_string(),
                file: place.file().to_owned(),
                function: String::new(),
                line: place.line(),
            });
        }
    }

    /// Writes a finding into the log of the node, with what to do about it.
    #[track_caller]
    pub fn log_finding(&self, finding: &Diagnostic) {
        let level = match finding.severity {
            Severity::Error => Level::Error,
            Severity::Warning => Level::Warn,
            Severity::Hint => Level::Info,
        };
        let helps: String = finding.help.iter().map(|help| format!("; {help}")).collect();
        self.log(level, format_args!("{}{helps}", finding.message));
    }

    /// Whether a line of this level is logged.
    #[must_use]
    pub fn logs(&self, level: Level) -> bool {
        self.0.standard().logs(level)
    }

    /// The least level that is logged; at first [`Level::Info`].
    pub fn set_log_level(&self, least: Level) {
        self.0.standard().least_level.store(least.number(), Ordering::Relaxed);
    }

    /// The name under which the node logs: `/demo/scan` is `demo.scan`.
    #[must_use]
    pub fn logger(&self) -> String {
        self.full_name().trim_start_matches('/').replace('/', ".")
    }
}
