//! Lost localization.

use periplus_bags::BagTopic;
use periplus_msgs::Message;
use periplus_msgs::diagnostic_msgs::DiagnosticStatus;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;

use super::{Mark, MarkKind};

/// Standard deviations of the position above which a pose is lost, and below which it is found
/// again \[m\]. Nav2's AMCL starts with 0.5 m.
const LOST_M: f64 = 1.0;
const FOUND_M: f64 = 0.5;

/// Localization by the topics of a node.
pub(in super::super) struct LocalizationMarks {
    source: Source,
    is_lost: bool,
}

/// Kind of a topic.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Source {
    /// Status of the built-in AMCL.
    Status,
    /// Pose of any AMCL.
    Pose,
}

impl LocalizationMarks {
    /// Poses are used only if no node publishes a status.
    pub(super) fn new(topic: &BagTopic, has_status: bool) -> Option<Self> {
        let last_part = topic.name.rsplit('/').next().unwrap_or_default();
        let is_pose =
            topic.type_name == PoseWithCovarianceStamped::TYPE_NAME && last_part == "amcl_pose";
        let source = if Self::is_status(topic) {
            Source::Status
        } else if is_pose && !has_status {
            Source::Pose
        } else {
            return None;
        };
        Some(Self { source, is_lost: false })
    }

    /// True for the topic with the status of the built-in AMCL.
    pub(super) fn is_status(topic: &BagTopic) -> bool {
        let last_part = topic.name.rsplit('/').next().unwrap_or_default();
        topic.type_name == DiagnosticStatus::TYPE_NAME && last_part == "localization_status"
    }

    pub(super) fn detect(&mut self, time_ns: i64, data: &[u8]) -> Vec<Mark> {
        let found = match self.source {
            Source::Status => of_status(data),
            Source::Pose => of_pose(data, self.is_lost),
        };
        let Some((is_lost, text)) = found else { return Vec::new() };
        if std::mem::replace(&mut self.is_lost, is_lost) == is_lost {
            return Vec::new();
        }
        let kind = if is_lost { MarkKind::LocalizationLost } else { MarkKind::LocalizationFound };
        vec![Mark::new(time_ns, kind, text)]
    }
}

fn of_status(data: &[u8]) -> Option<(bool, String)> {
    let status = DiagnosticStatus::decode_cdr(data).ok()?;
    let state = status.values.iter().find(|pair| pair.key == "state")?;
    match state.value.as_str() {
        "lost" => Some((true, status.message)),
        "tracking" => Some((false, status.message)),
        _ => None,
    }
}

fn of_pose(data: &[u8], is_lost: bool) -> Option<(bool, String)> {
    let pose = PoseWithCovarianceStamped::decode_cdr(data).ok()?;
    let variance_m2 = pose.pose.covariance[0].max(pose.pose.covariance[7]);
    let deviation_m = variance_m2.max(0.0).sqrt();
    let limit_m = if is_lost { FOUND_M } else { LOST_M };
    Some((deviation_m > limit_m, format!("standard deviation of the position {deviation_m:.2} m")))
}

#[cfg(test)]
mod tests {
    use periplus_msgs::diagnostic_msgs::KeyValue;

    use super::*;

    #[test]
    fn the_deviation_of_the_pose_has_two_limits() {
        let mut marks = LocalizationMarks { source: Source::Pose, is_lost: false };
        let mut kinds = Vec::new();
        for deviation_m in [0.1, 0.9, 1.1, 0.9, 1.2, 0.4, 0.9_f64] {
            let mut pose = PoseWithCovarianceStamped::default();
            pose.pose.covariance[7] = deviation_m * deviation_m;
            let found = marks.detect(0, &pose.to_cdr().unwrap());
            kinds.extend(found.into_iter().map(|mark| mark.kind));
        }
        assert_eq!(kinds, [MarkKind::LocalizationLost, MarkKind::LocalizationFound]);
    }

    #[test]
    fn the_status_of_amcl_says_when_it_is_lost() {
        let mut marks = LocalizationMarks { source: Source::Status, is_lost: false };
        let mut count = |state: &str| {
            let values = vec![KeyValue { key: "state".into(), value: state.into() }];
            let status = DiagnosticStatus { values, ..DiagnosticStatus::default() };
            marks.detect(0, &status.to_cdr().unwrap()).len()
        };
        assert_eq!(
            ["unset", "tracking", "lost", "ambiguous", "lost", "tracking"].map(&mut count),
            [0, 0, 1, 0, 0, 1]
        );
    }
}
