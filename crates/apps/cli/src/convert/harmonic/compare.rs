//! The same drive of both descriptions, topic by topic.

use std::collections::{BTreeMap, BTreeSet};

use periplus_migration::{ALL_TOPICS, BridgeFlow, TopicAspect};
use periplus_os::Overlay;
use serde::Serialize;

use super::difference::{Deviation, Difference, Verdict};
use super::drive::DRIVE_WORDS;
use super::measure::measure;
use super::project::{Project, folders};
use super::record::{RunKind, RunLog, RunSetup, TopicLog, record};
use crate::options::SearchOptions;

/// Tolerance of rates, as a fraction.
const RATE_TOLERANCE_FRACTION: f64 = 0.02;

/// Tolerance of the poses of links before the first step \[m\].
const POSE_TOLERANCE_M: f64 = 1e-4;

/// A topic of both runs.
#[derive(Debug, Serialize)]
pub(super) struct TopicComparison {
    /// Name on ROS.
    pub(super) topic: String,
    /// Name in the new simulation.
    pub(super) gz_topic: String,
    /// Types of both; empty for a missing topic.
    pub(super) types: [String; 2],
    /// Messages per second of both.
    pub(super) rates_hz: [f64; 2],
    /// Frames of both.
    pub(super) frames: [String; 2],
    /// Number of compared pairs of messages.
    pub(super) pairs: usize,
    pub(super) deviations: Vec<Deviation>,
    pub(super) differences: Vec<Difference>,
    pub(super) verdict: Verdict,
}

/// Comparison run.
#[derive(Debug, Serialize)]
#[serde(tag = "state", rename_all = "snake_case")]
pub(super) enum Comparison {
    /// Both were simulated.
    Run(Box<ComparisonRun>),
    /// Left out, with the reason.
    NotRun { reason: String },
}

/// Results of both simulations.
#[derive(Debug, Serialize)]
pub(super) struct ComparisonRun {
    /// Simulated time \[s\].
    pub(super) duration_s: i64,
    /// Drive in words; empty if nothing listens to velocities.
    pub(super) drive: &'static str,
    /// Topics of commands of both.
    pub(super) command_topics: [Vec<String>; 2],
    /// Number of links whose poses were compared before the first step.
    pub(super) links: usize,
    /// Differences of the links and of the run itself.
    pub(super) differences: Vec<Difference>,
    pub(super) topics: Vec<TopicComparison>,
    /// Differences of the simulators that were removed for a second, controlled run.
    pub(super) equalized: Vec<&'static str>,
    /// Verdict of all.
    pub(super) verdict: Verdict,
}

impl Comparison {
    pub(super) fn not_run(reason: impl Into<String>) -> Self {
        Self::NotRun { reason: reason.into() }
    }

    pub(super) fn not_needed() -> Self {
        Self::not_run("nothing was converted")
    }

    /// Simulates both descriptions.
    pub(super) fn run(project: &Project, search: &SearchOptions) -> Self {
        let Some(scene) = &project.loaded.scene else {
            return Self::not_run(
                "the file is for inclusion by others and describes no robot itself",
            );
        };
        let links = scene.models.iter().map(|model| model.links.len()).sum::<usize>();
        if scene.worlds.is_empty() && links == 0 {
            return Self::not_run("the file has no link to simulate");
        }
        let folders = folders(search);
        let setup = |is_driven: bool, kind: RunKind| RunSetup {
            file: &project.loaded.path,
            arguments: &project.arguments,
            folders: &folders,
            is_robot: project.is_robot(),
            is_driven,
            kind,
        };
        let old = record(&setup(true, RunKind::Usual), Overlay::default());
        // A drive that Periplus does not simulate in the old file does not move in the new one.
        let is_driven = !old.command_topics.is_empty();
        let new = record(&setup(is_driven, RunKind::Usual), project.overlay());
        let mut run = ComparisonRun::new(project, &old, &new);
        for kind in [RunKind::Controlled, RunKind::Kinematic] {
            if run.verdict != Verdict::Unexplained {
                break;
            }
            let old = record(&setup(is_driven, kind), Overlay::default());
            let new = record(&setup(is_driven, kind), project.overlay());
            run.explain(&ComparisonRun::new(project, &old, &new), &old, &new);
        }
        Self::Run(Box::new(run))
    }

    /// True if something differs for no known reason.
    pub(super) fn is_unexplained(&self) -> bool {
        matches!(self, Self::Run(run) if run.verdict == Verdict::Unexplained)
    }

    /// One line for the terminal.
    pub(super) fn summary(&self) -> String {
        match self {
            Self::NotRun { reason } => format!("comparison: not run, {reason}"),
            Self::Run(run) => {
                let count = |verdict: Verdict| {
                    run.topics.iter().filter(|topic| topic.verdict == verdict).count()
                };
                format!(
                    "comparison over {} s: {} topics equal, {} explained, {} not explained",
                    run.duration_s,
                    count(Verdict::Equal),
                    count(Verdict::Explained),
                    count(Verdict::Unexplained)
                )
            }
        }
    }
}

impl ComparisonRun {
    fn new(project: &Project, old: &RunLog, new: &RunLog) -> Self {
        let mut differences = Vec::new();
        links(old, new, &mut differences);
        for (words, log) in [("old", old), ("new", new)] {
            if let Some(failure) = &log.failure {
                let text = format!("the {words} run ended early: {failure}");
                differences.push(Difference::new(TopicAspect::Values, text));
            }
        }
        if old.failure.is_some() && old.failure == new.failure {
            for difference in &mut differences {
                difference.reason = Some("both fail in the same way".to_owned());
            }
        }
        let commands = |log: &RunLog| log.command_topics.clone();
        let mut run = Self {
            duration_s: old.duration_s.max(new.duration_s),
            drive: if old.command_topics.is_empty() { "" } else { DRIVE_WORDS },
            command_topics: [commands(old), commands(new)],
            links: old.link_poses.len(),
            differences,
            topics: topics(project, old, new),
            equalized: Vec::new(),
            verdict: Verdict::Equal,
        };
        if old.command_topics.is_empty() != new.command_topics.is_empty() {
            let text = format!(
                "velocity commands on {} and {}",
                shown(&old.command_topics),
                shown(&new.command_topics)
            );
            let mut difference = Difference::new(TopicAspect::Presence, text);
            if old.command_topics.is_empty() {
                difference.reason = Some(
                    "Periplus does not simulate the old drive, which listens to Gazebo's transport; nothing was driven"
                        .to_owned(),
                );
            }
            let is_removed = |entry: &&periplus_migration::MigrationEntry| {
                entry.outcome != periplus_migration::MigrationOutcome::Converted
                    && (entry.old.contains("rive") || entry.old.contains("control"))
            };
            if difference.reason.is_none() {
                difference.reason = project
                    .entries
                    .iter()
                    .find(is_removed)
                    .map(|entry| format!("{}: {}", entry.old, entry.remarks.join("; ")));
                // Without its drive the new robot stands, and publishes nothing of it.
                for topic in &mut run.topics {
                    for other in topic.differences.iter_mut().filter(|other| other.reason.is_none())
                    {
                        other.reason.clone_from(&difference.reason);
                    }
                }
            }
            run.differences.push(difference);
        }
        run.judge();
        run
    }

    /// Sets all verdicts.
    fn judge(&mut self) {
        for topic in &mut self.topics {
            topic.verdict = verdict(&topic.differences);
        }
        let worst = self.topics.iter().map(|topic| topic.verdict).max();
        self.verdict = verdict(&self.differences).max(worst.unwrap_or(Verdict::Equal));
    }

    /// Explains values that agree once the known differences of the simulators are removed.
    fn explain(&mut self, controlled: &Self, old: &RunLog, new: &RunLog) {
        let reasons: BTreeSet<&str> = old.equalized.iter().chain(&new.equalized).copied().collect();
        if reasons.is_empty() {
            return;
        }
        self.equalized = reasons.into_iter().collect();
        for topic in &mut self.topics {
            let Some(other) = controlled.topics.iter().find(|other| other.topic == topic.topic)
            else {
                continue;
            };
            let agrees = other.differences.iter().all(|difference| {
                difference.aspect != TopicAspect::Values || difference.reason.is_some()
            });
            if !agrees {
                continue;
            }
            let words: Vec<String> = other.deviations.iter().map(Deviation::words).collect();
            for difference in &mut topic.differences {
                if difference.aspect == TopicAspect::Values && difference.reason.is_none() {
                    difference.reason = Some(format!(
                        "the limits and geometry below, which differ; without them both agree: {}",
                        words.join(", ")
                    ));
                }
            }
        }
        self.judge();
    }
}

fn verdict(differences: &[Difference]) -> Verdict {
    let of = |difference: &Difference| match difference.reason {
        Some(_) => Verdict::Explained,
        None => Verdict::Unexplained,
    };
    differences.iter().map(of).max().unwrap_or(Verdict::Equal)
}

fn shown(topics: &[String]) -> String {
    if topics.is_empty() { "no topic".to_owned() } else { topics.join(", ") }
}

/// Links at the start: every link of the old description is in the new one, at the same pose.
fn links(old: &RunLog, new: &RunLog, differences: &mut Vec<Difference>) {
    let missing: Vec<&str> = old
        .link_poses
        .keys()
        .filter(|name| !new.link_poses.contains_key(*name))
        .map(String::as_str)
        .collect();
    if !missing.is_empty() {
        let text = format!("links are missing: {}", missing.join(", "));
        differences.push(Difference::new(TopicAspect::Presence, text));
    }
    for (name, pose) in &old.link_poses {
        let Some(new) = new.link_poses.get(name) else { continue };
        let (metres, radians) = pose.distance_to(*new);
        if metres > POSE_TOLERANCE_M || radians > POSE_TOLERANCE_M {
            let text = format!("link {name} starts {metres:.4} m and {radians:.4} rad away");
            differences.push(Difference::new(TopicAspect::Values, text));
        }
    }
}

/// All topics of the old description beside those of the new one.
fn topics(project: &Project, old: &RunLog, new: &RunLog) -> Vec<TopicComparison> {
    let bridged = project.bridge.iter().filter(|entry| entry.direction == BridgeFlow::GzToRos);
    let names: BTreeMap<&str, &str> = bridged
        .map(|entry| (entry.ros_topic_name.as_str(), entry.gz_topic_name.as_str()))
        .collect();
    let mut rows = Vec::new();
    for (topic, log) in &old.topics {
        let gz_topic = names.get(topic.as_str()).copied().unwrap_or(topic);
        let other = new
            .topics
            .get(gz_topic)
            .or_else(|| new.topics.get(periplus_sim_topic(gz_topic).as_str()));
        let mut row = compared(topic, gz_topic, log, other);
        for difference in &mut row.differences {
            difference.reason =
                reason(project, topic, difference).or_else(|| shared(project, topic));
        }
        rows.push(row);
    }
    rows
}

/// Name of a Gazebo topic in the simulation: a valid name of ROS.
fn periplus_sim_topic(name: &str) -> String {
    periplus_graph::valid_topic_name(name)
}

/// Reason for the differences of a topic that several sensors publish.
fn shared(project: &Project, topic: &str) -> Option<String> {
    let sources: BTreeSet<&str> = project
        .bridge
        .iter()
        .filter(|entry| entry.direction == BridgeFlow::GzToRos && entry.ros_topic_name == topic)
        .map(|entry| entry.gz_topic_name.as_str())
        .collect();
    (sources.len() > 1).then(|| {
        format!(
            "several old sensors publish this topic; in the new file these are {}, of which one was compared",
            sources.into_iter().collect::<Vec<_>>().join(", ")
        )
    })
}

fn reason(project: &Project, topic: &str, difference: &Difference) -> Option<String> {
    let expected = project.expected.iter().filter(|expected| expected.aspect == difference.aspect);
    let mut own =
        expected.filter(|expected| expected.topic == topic && expected.topic != ALL_TOPICS);
    if let Some(expected) = own.next() {
        return Some(expected.reason.clone());
    }
    if difference.aspect == TopicAspect::Presence {
        let mut missing = project.entries.iter().filter(|entry| {
            entry.outcome == periplus_migration::MigrationOutcome::NoCounterpart
                && entry.old.starts_with("plugin")
        });
        return missing.next().map(|entry| {
            format!("{} has no counterpart: {}", entry.old, entry.remarks.join("; "))
        });
    }
    None
}

fn compared(
    topic: &str,
    gz_topic: &str,
    old: &TopicLog,
    new: Option<&TopicLog>,
) -> TopicComparison {
    let mut row = TopicComparison {
        topic: topic.to_owned(),
        gz_topic: gz_topic.to_owned(),
        types: [old.type_name.clone(), String::new()],
        rates_hz: [rate_hz(old), 0.0],
        frames: Default::default(),
        pairs: 0,
        deviations: Vec::new(),
        differences: Vec::new(),
        verdict: Verdict::Equal,
    };
    let Some(new) = new else {
        row.differences.push(Difference::new(TopicAspect::Presence, "no message in the new run"));
        return row;
    };
    row.types[1].clone_from(&new.type_name);
    row.rates_hz[1] = rate_hz(new);
    let [old_hz, new_hz] = row.rates_hz;
    if (old_hz - new_hz).abs() > RATE_TOLERANCE_FRACTION * old_hz.max(new_hz) {
        let text = format!("{old_hz:.1} Hz and {new_hz:.1} Hz");
        row.differences.push(Difference::new(TopicAspect::Rate, text));
    }
    if old.type_name != new.type_name {
        let text = format!("{} and {}", old.type_name, new.type_name);
        row.differences.push(Difference::new(TopicAspect::Type, text));
        return row;
    }
    let measured = measure(old, new);
    row.frames = measured.frames;
    row.pairs = measured.pairs;
    row.deviations = measured.deviations;
    row.differences.extend(measured.differences);
    row
}

/// Messages per second; 0 for a single message.
fn rate_hz(log: &TopicLog) -> f64 {
    let (Some(first), Some(last)) = (log.samples.first(), log.samples.last()) else { return 0.0 };
    let span_ns = last.time_ns - first.time_ns;
    if span_ns <= 0 {
        return 0.0;
    }
    #[expect(clippy::cast_precision_loss, reason = "a run has less than 2^53 messages and ns")]
    let rate_hz = (log.samples.len() - 1) as f64 * 1e9 / span_ns as f64;
    rate_hz
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_difference_without_a_reason_decides() {
        let mut differences = vec![Difference::new(TopicAspect::Rate, "10 Hz and 20 Hz")];
        assert_eq!(verdict(&[]), Verdict::Equal);
        assert_eq!(verdict(&differences), Verdict::Unexplained);
        differences[0].reason = Some("known".to_owned());
        assert_eq!(verdict(&differences), Verdict::Explained);
        differences.push(Difference::new(TopicAspect::Values, "far"));
        assert_eq!(verdict(&differences), Verdict::Unexplained);
    }

    #[test]
    fn a_missing_topic_and_another_rate_are_differences() {
        let log = TopicLog { type_name: "a/msg/B".to_owned(), samples: Vec::new() };
        let missing = compared("/a", "/a", &log, None);
        assert_eq!(missing.differences[0].aspect, TopicAspect::Presence);
        let other = TopicLog { type_name: "a/msg/C".to_owned(), samples: Vec::new() };
        let retyped = compared("/a", "/a", &log, Some(&other));
        assert_eq!(retyped.differences[0].aspect, TopicAspect::Type);
    }
}
