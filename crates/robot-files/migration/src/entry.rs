//! Report of a conversion: one entry for each element of the old file that matters.

use serde::Serialize;

/// Result of the conversion of one element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MigrationOutcome {
    /// Has a counterpart with the same behaviour.
    Converted,
    /// Has a counterpart whose behaviour differs, as the remarks explain.
    Approximated,
    /// Not needed in current Gazebo, which has the function built in.
    BuiltIn,
    /// Stays as it is, but has no effect in current Gazebo.
    NoEffect,
    /// Has no counterpart; the remarks give the reason and advice.
    NoCounterpart,
}

impl MigrationOutcome {
    /// Words for a report.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Converted => "converted",
            Self::Approximated => "approximated",
            Self::BuiltIn => "built in",
            Self::NoEffect => "without effect",
            Self::NoCounterpart => "no counterpart",
        }
    }
}

/// Old element, and the elements that replace it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MigrationEntry {
    /// File of the old element.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// Old element in words: `plugin libgazebo_ros_imu.so`.
    pub old: String,
    /// New elements in words; empty if there are none.
    pub new: String,
    /// Result.
    pub outcome: MigrationOutcome,
    /// Differences and advice, one sentence or more each.
    pub remarks: Vec<String>,
}

/// Difference of a ROS topic that the conversion causes knowingly.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ExpectedDifference {
    /// Name of the topic on ROS.
    pub topic: String,
    /// Part of the topic that differs.
    pub aspect: TopicAspect,
    /// Reason.
    pub reason: String,
}

/// Part of a topic that can differ between two descriptions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TopicAspect {
    /// The topic is missing.
    Presence,
    /// Message type.
    Type,
    /// Messages per second.
    Rate,
    /// Frame of the messages.
    Frame,
    /// Covariances and other fields that do not measure.
    Fields,
    /// Measured values.
    Values,
}
