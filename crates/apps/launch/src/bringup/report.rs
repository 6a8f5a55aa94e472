//! Outcomes and log messages of a launch.

use periplus_graph::Level;
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
}

impl LaunchLog {
    pub(crate) fn info(text: impl Into<String>) -> Self {
        Self { level: Level::Info, text: text.into() }
    }

    pub(crate) fn warning(text: impl Into<String>) -> Self {
        Self { level: Level::Warn, text: text.into() }
    }

    pub(crate) fn error(text: impl Into<String>) -> Self {
        Self { level: Level::Error, text: text.into() }
    }
}
