//! Differences of a topic between the two descriptions.

use periplus_migration::TopicAspect;
use serde::Serialize;

/// Result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Verdict {
    /// Equal within the tolerances.
    Equal,
    /// Different, for a reason in the report.
    Explained,
    /// Different without a known reason.
    Unexplained,
}

impl Verdict {
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Explained => "explained",
            Self::Unexplained => "NOT EXPLAINED",
        }
    }
}

/// A difference of a topic.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Difference {
    pub(super) aspect: TopicAspect,
    /// Both values in words.
    pub(super) text: String,
    /// Reason, if it is known.
    pub(super) reason: Option<String>,
}

impl Difference {
    pub(super) fn new(aspect: TopicAspect, text: impl Into<String>) -> Self {
        Self { aspect, text: text.into(), reason: None }
    }
}

/// Largest deviation of the values of a topic.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Deviation {
    /// Compared quantity.
    pub(super) quantity: &'static str,
    pub(super) value: f64,
    pub(super) tolerance: f64,
    pub(super) unit: &'static str,
}

impl Deviation {
    pub(super) fn is_within(&self) -> bool {
        self.value <= self.tolerance
    }

    pub(super) fn words(&self) -> String {
        let Self { quantity, value, tolerance, unit } = self;
        let value = if *value >= 0.01 || *value == 0.0 {
            format!("{value:.4}")
        } else {
            format!("{value:.1e}")
        };
        format!("{quantity} {value} {unit} (tolerance {tolerance} {unit})")
    }
}
