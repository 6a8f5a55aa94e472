//! What is told to whoever launched.

use periplus_graph::Level;
use serde::Serialize;

/// What became of a part of a plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// The step of the plan.
    pub step: usize,
    /// As the launch file calls it.
    pub asked: String,
    /// What it is here.
    #[serde(flatten)]
    pub became: Became,
}

/// What stands for a part of a plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Became {
    /// Which kind of thing.
    pub kind: Kind,
    /// The full name of its node, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
    /// In words.
    pub told: String,
}

/// Which kind of thing stands for a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The simulation.
    World,
    /// A node or a deed of ours.
    #[default]
    BuiltIn,
    /// A program of the machine's.
    Program,
    /// Nothing, for nothing is missing.
    Needless,
    /// Nothing, and it is missing.
    Missing,
}

/// Something that is said while a plan runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Said {
    /// How grave it is.
    pub level: Level,
    /// What.
    pub text: String,
}

impl Said {
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
