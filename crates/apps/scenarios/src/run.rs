//! Runs of scenarios.

mod estimates;
mod events;
mod inspect;
mod observer;
mod setup;
mod task;
mod truth;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use periplus_os::Stopwatch;
use periplus_session::{RunSettings, SessionBuilder, SimulationSession};
use periplus_sim::Search;

use crate::artifacts::{self, Artifacts};
use crate::checks;
use crate::error::ScenarioError;
use crate::file::Scenario;
use crate::report::{RunOutcome, ScenarioReport};
use task::ScenarioTask;

pub use inspect::{ScenarioInspection, inspect};
pub(crate) use observer::{TopicRecord, is_light};
pub(crate) use task::RunRecord;

/// Options of a run.
#[derive(Clone, Debug, Default)]
pub struct ScenarioRunOptions {
    /// Seed, in place of that of the scenario.
    pub seed: Option<u64>,
    /// Folder for the artifacts of a run that fails; none are kept without it.
    pub artifacts: Option<PathBuf>,
    /// True to keep the artifacts of a run that passes, too.
    pub keeps_artifacts: bool,
    /// True to compute the digest of all messages.
    pub has_digest: bool,
    /// Number of threads for rays; results do not depend on it.
    pub threads: usize,
    /// Search paths of files.
    pub search: Search,
    /// Values of variables that were set for this run, for the command that runs it again.
    pub set: Vec<(String, String)>,
    /// Parameters of nodes besides those of the scenario: full or relative name, parameter, value.
    pub parameters: Vec<[String; 3]>,
    /// True to show the findings of the files and the progress on stderr.
    pub is_verbose: bool,
    /// Flag that interrupts the run; can be set from any thread.
    pub stop: Arc<AtomicBool>,
}

impl ScenarioRunOptions {
    /// Seed of a run.
    #[must_use]
    pub fn seed_of(&self, scenario: &Scenario) -> u64 {
        self.seed.unwrap_or(scenario.params.seed.unsigned_abs())
    }
}

/// Session of a scenario before its first step.
fn begin(
    scenario: &Scenario,
    options: &ScenarioRunOptions,
    seed: u64,
) -> Result<SimulationSession, ScenarioError> {
    let (composition, simulation) = setup::compose(scenario, options, seed)?;
    let session = SessionBuilder::new(composition, simulation, Stopwatch::start())
        .quiet(!options.is_verbose)
        .progress(options.is_verbose)
        .search(options.search.clone())
        .driver(setup::driver(scenario))
        .estimators(setup::estimators(scenario)?)
        .build()?;
    Ok(session)
}

/// Runs a scenario to its end and evaluates its assertions.
///
/// # Errors
/// When the world, the robot or a node cannot start, or an artifact cannot be written. A run that fails is a report.
pub fn run(
    scenario: &Scenario,
    options: &ScenarioRunOptions,
) -> Result<ScenarioReport, ScenarioError> {
    let seed = options.seed_of(scenario);
    let mut session = begin(scenario, options, seed)?;
    let artifacts = options.artifacts.as_deref().map(Artifacts::begin).transpose()?;
    let mut task = ScenarioTask::new(scenario, &mut session, options, seed)?;
    if let Some(artifacts) = &artifacts {
        artifacts.record(&mut session)?;
    }
    let settings = RunSettings {
        duration_s: Some(scenario.params.timeout_s),
        stop: &options.stop,
        is_paused: false,
    };
    session.run(settings, &mut task);
    let outcome = task.outcome(&session, &options.stop);
    let mut record = task.finish(&mut session);
    session.close_recording();
    let assertions = checks::evaluate(scenario, &mut session, &record);
    let mut report = ScenarioReport {
        name: scenario.name.clone(),
        path: scenario.path.clone(),
        seed,
        variables: scenario.variables.clone().into_iter().collect(),
        outcome,
        duration_s: session.simulation().time_ns() as f64 * 1e-9,
        scores: checks::scores(&record),
        goals: std::mem::take(&mut record.goals),
        assertions,
        problems: std::mem::take(&mut record.problems),
        faults: std::mem::take(&mut record.faults),
        digest: record.digest.map(|digest| format!("{digest:016x}")),
        replay: artifacts::replay_command(scenario, options, seed),
        artifacts: None,
    };
    if let Some(artifacts) = artifacts {
        let keeps = options.keeps_artifacts || !report.has_passed();
        artifacts.finish(keeps, scenario, &mut session, &record, &mut report)?;
    }
    if report.outcome == RunOutcome::Timeout && !scenario.has_goals() {
        report.outcome = RunOutcome::Complete;
    }
    Ok(report)
}
