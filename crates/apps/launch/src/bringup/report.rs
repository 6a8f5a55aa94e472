//! Outcomes and log messages of a launch.

use periplus_graph::Level;
use periplus_msgs::rcl_interfaces::Log;
use serde::Serialize;

/// Outcome of a part of a plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartReport {
    /// Step of the plan.
    pub step: usize,
    /// Name in the launch file.
    pub asked: String,
    /// Replacement of the part.
    #[serde(flatten)]
    pub outcome: PartOutcome,
}

/// Replacement of a part of a plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartOutcome {
    /// Kind of replacement.
    pub kind: PartOutcomeKind,
    /// Full name of its node, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
    /// Description.
    pub told: String,
}

/// Kind of replacement of a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PartOutcomeKind {
    /// Simulation.
    World,
    /// Built-in node or task.
    #[default]
    BuiltIn,
    /// User's own node in Python, in a process.
    Python,
    /// External program.
    Program,
    /// Nothing needed.
    Needless,
    /// Missing.
    Missing,
}

/// Log message of a running plan.
#[derive(Clone, Debug, PartialEq)]
pub struct LaunchLog {
    /// Severity.
    pub level: Level,
    /// Text.
    pub text: String,
    /// True if a node wrote it, not the launch: its errors are not failures of the launch.
    pub is_of_node: bool,
}

impl LaunchLog {
    pub(crate) fn info(text: impl Into<String>) -> Self {
        Self::of_launch(Level::Info, text)
    }

    pub(crate) fn warning(text: impl Into<String>) -> Self {
        Self::of_launch(Level::Warn, text)
    }

    pub(crate) fn error(text: impl Into<String>) -> Self {
        Self::of_launch(Level::Error, text)
    }

    pub(crate) fn of_launch(level: Level, text: impl Into<String>) -> Self {
        Self { level, text: text.into(), is_of_node: false }
    }

    /// Message of a node, written as the logger of ROS 2 writes it.
    pub(crate) fn of_node(level: Level, log: &Log) -> Self {
        let Log { stamp, name, msg, .. } = log;
        let text = format!("[{name}] [{level}] [{}.{:09}]: {msg}", stamp.sec, stamp.nanosec);
        Self { level, text, is_of_node: true }
    }
}
