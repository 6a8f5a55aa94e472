//! Node logs on `/rosout`.

use std::fmt;
use std::panic::Location;
use std::sync::atomic::Ordering;

use periplus_diagnostics::{Diagnostic, Severity};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rcl_interfaces::Log;

use crate::node::Node;

/// Severity of a log message, in ascending order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Details for debugging.
    Debug,
    /// Normal operation.
    #[default]
    Info,
    /// Possible problem.
    Warn,
    /// Error.
    Error,
    /// The node cannot continue.
    Fatal,
}

impl Level {
    /// All levels, in ascending order.
    pub const ALL: [Self; 5] = [Self::Debug, Self::Info, Self::Warn, Self::Error, Self::Fatal];

    /// Number of the level in `rcl_interfaces/msg/Log`.
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

    /// Level of a number; numbers between two levels give the lower one.
    #[must_use]
    pub fn of_number(number: u8) -> Self {
        let known = Self::ALL.into_iter().rev().find(|level| level.number() <= number);
        known.unwrap_or(Self::Debug)
    }

    /// Level of a name, in any case: `warn`, `WARN`, `WARNING`.
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
    /// Logs a message to `/rosout` under the node's name. Messages below the level
    /// ([`Node::set_log_level`]) are not formatted.
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

    /// Logs a finding with its help text.
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

    /// True if messages of this level are logged.
    #[must_use]
    pub fn logs(&self, level: Level) -> bool {
        self.0.standard().logs(level)
    }

    /// Sets the minimum log level (default [`Level::Info`]).
    pub fn set_log_level(&self, least: Level) {
        self.0.standard().min_level.store(least.number(), Ordering::Relaxed);
    }

    /// Logger name of the node: `demo.scan` for `/demo/scan`.
    #[must_use]
    pub fn logger(&self) -> String {
        self.full_name().trim_start_matches('/').replace('/', ".")
    }
}
