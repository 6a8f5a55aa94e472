//! Estimators over a recording, with other parameters.
//!
//! A rerun plays the sensor data of a recording to the node of `slam_toolbox`, to `amcl` or to costmaps, and records what
//! they publish on the time base of the recording. Time is that of the messages, not of the machine: the same recording
//! and parameters give the same bytes. The recording's own estimates are left out: transforms that lead to the odometry frame
//! and, for mapping, its map.

mod error;
mod estimator;
mod jobs;
mod parameters;
mod playback;
mod robot;
mod timeline;
mod trajectory;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use periplus_bags::files::{Bag, RecordSettings, Recorder, Storage, WriteSettings};
use periplus_graph::{Graph, TopicInfo};
use serde_json::Value;

use crate::description::with_version;

pub use self::error::RerunError;
pub use self::jobs::{ReportWriter, RerunJobs};
pub use self::parameters::{MAP_FILE, RerunKind, job_parameters};

use self::estimator::Estimator;
use self::parameters::RerunParameters;
use self::playback::Playback;
use self::robot::RecordedRobot;
use self::timeline::Timeline;

/// Estimators to run over a recording.
#[derive(Clone, Debug)]
pub struct RerunRequest {
    /// Estimators.
    pub kind: RerunKind,
    /// The recording.
    pub recording: PathBuf,
    /// Parameters that differ from the defaults, by name; see [`job_parameters`].
    pub parameters: BTreeMap<String, Value>,
    /// MCAP file to write.
    pub out: PathBuf,
}

/// Result of a rerun.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RerunSummary {
    /// Number of messages that were played.
    pub played: u64,
    /// Number of messages that were recorded.
    pub recorded: u64,
    /// Faults of the recording, and problems of the estimators.
    pub faults: Vec<String>,
}

/// Topics that are never part of a result.
const OMITTED_TOPICS: [&str; 4] = ["/parameter_events", "/clock", "/bond", "/initialpose"];

/// Runs estimators over a recording. `progress` gets the part that is done, 0 to 1. After an error or a cancellation there is
/// no result file.
///
/// # Errors
/// When the recording has not what the estimators need, a parameter is not valid, the result cannot be written, or
/// `is_cancelled` became true.
pub fn rerun(
    request: &RerunRequest,
    progress: &dyn Fn(f32),
    is_cancelled: &AtomicBool,
) -> Result<RerunSummary, RerunError> {
    let bag = Bag::open_log(&request.recording).map_err(RerunError::Recording)?;
    let mut parameters = RerunParameters::read(request.kind, &request.parameters)?;
    let robot = RecordedRobot::of(&bag, &parameters)?;
    parameters.fill(&robot);
    let done = run(request, &bag, &parameters, &robot, (progress, is_cancelled));
    if done.is_err() {
        remove(&request.out);
    }
    done
}

fn run(
    request: &RerunRequest,
    bag: &Bag,
    parameters: &RerunParameters,
    robot: &RecordedRobot,
    (progress, is_cancelled): (&dyn Fn(f32), &AtomicBool),
) -> Result<RerunSummary, RerunError> {
    let graph = Graph::new();
    let timeline = Timeline::of(bag, robot)?;
    // Nodes with timers must not live through the time since 1970.
    graph.jump_to(timeline.start_ns());
    let mut estimator = Estimator::start(&graph, parameters, bag, robot)?;
    // Nodes subscribe when they are configured.
    graph.settle();
    let mut playback = Playback::new(&graph, bag, (parameters.kind(), robot), timeline)?;
    let omitted = playback.input_topics();
    let settings = RecordSettings {
        wanted: Box::new(move |topic: &TopicInfo| {
            !omitted.contains(&topic.name) && !OMITTED_TOPICS.contains(&topic.name.as_str())
        }),
        clock: playback.log_clock(),
        ..RecordSettings::all(WriteSettings {
            custom_data: facts(request),
            ..WriteSettings::new(Storage::Mcap)
        })
    };
    let recorder = Recorder::start(&graph, &request.out, settings).map_err(RerunError::Result)?;
    while playback.step()? {
        if is_cancelled.load(Ordering::Relaxed) {
            return Err(RerunError::Cancelled);
        }
        estimator.observe();
        progress(playback.part());
    }
    estimator.finish();
    graph.settle();
    let recorded = recorder.messages();
    recorder.finish().map_err(RerunError::Result)?;
    let mut faults = playback.faults();
    faults.extend(estimator.problems());
    progress(1.0);
    Ok(RerunSummary { played: playback.count(), recorded, faults })
}

/// Facts of a rerun that its result contains: the estimator, its recording by name, and the changed parameters.
fn facts(request: &RerunRequest) -> BTreeMap<String, String> {
    let name = request.recording.file_name().unwrap_or_default().to_string_lossy();
    let mut facts = BTreeMap::from([
        ("rerun".to_owned(), request.kind.name().to_owned()),
        ("source".to_owned(), name.into_owned()),
    ]);
    for (name, value) in &request.parameters {
        facts.insert(format!("param {name}"), value.to_string());
    }
    with_version(facts)
}

/// Removes the file of a run that did not end.
fn remove(out: &Path) {
    // Without a file there is nothing to remove.
    let _ = periplus_os::fs::remove_file(out);
}
