//! Scenarios: the engine behind `periplus.scenarios` and the plugin of pytest.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use periplus_scenarios::{Scenario, ScenarioError, ScenarioRunOptions, json_schema, run};
use periplus_sweeps::{SweepPlan, run_job};
use pyo3::prelude::*;
use pyo3::types::PyModule;

use crate::errors::{require_no_errors, runtime_error};
use crate::work::released;

/// Time between two looks at signals, and delay of the end of a run at most.
const SIGNAL_PERIOD: Duration = Duration::from_millis(5);

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(run_scenario, module)?)?;
    module.add_function(wrap_pyfunction!(run_sweep_job, module)?)?;
    module.add_function(wrap_pyfunction!(sweep_tree_name, module)?)?;
    module.add_function(wrap_pyfunction!(scenario_schema, module)?)
}

/// JSON schema of scenario files, as JSON.
#[pyfunction]
fn scenario_schema() -> String {
    json_schema().to_string()
}

/// Runs the scenario `text`, which is YAML or JSON, to its end, and returns the report as JSON. `path` is its name in
/// findings, and its folder the base of relative paths. `variables` replace those of the scenario. Artifacts of a run
/// that fails are written to the folder `artifacts`, with `keep` those of every run.
#[pyfunction]
#[pyo3(signature = (text, path, *, seed=None, variables=Vec::new(), artifacts=None, keep=false, digest=false, threads=1))]
#[expect(clippy::too_many_arguments, reason = "arguments by name")]
fn run_scenario(
    py: Python<'_>,
    text: String,
    path: PathBuf,
    seed: Option<u64>,
    variables: Vec<(String, String)>,
    artifacts: Option<PathBuf>,
    keep: bool,
    digest: bool,
    threads: usize,
) -> PyResult<String> {
    let scenario = match Scenario::read(&path, text, &variables) {
        Ok(scenario) => scenario,
        Err(error) => {
            require_no_errors(py, &error.diagnostics, &error.sources)?;
            return Err(runtime_error("the scenario cannot be read"));
        }
    };
    let stop = Arc::new(AtomicBool::new(false));
    let options = ScenarioRunOptions {
        seed,
        artifacts,
        keeps_artifacts: keep,
        has_digest: digest,
        threads,
        search: periplus_session::terminal::search(&[]),
        set: variables,
        stop: stop.clone(),
        ..ScenarioRunOptions::default()
    };
    let running = thread::spawn(move || {
        let report = run(&scenario, &options);
        report.map(|report| report.to_json().to_string())
    });
    let mut interrupted = None;
    while !running.is_finished() {
        if let (None, Err(error)) = (&interrupted, py.check_signals()) {
            stop.store(true, Ordering::Relaxed);
            interrupted = Some(error);
        }
        py.detach(|| thread::sleep(SIGNAL_PERIOD));
    }
    let outcome = released(py, "the scenario", || running.join())?;
    if let Some(error) = interrupted {
        return Err(error);
    }
    match outcome {
        Ok(report) => report.map_err(|error: ScenarioError| runtime_error(error)),
        Err(_) => Err(runtime_error("the scenario failed, which is a fault of Periplus")),
    }
}

/// Runs the job `index` of a sweep, whose plan is JSON, on the copy of its files in the folder `tree`. Returns the result as
/// JSON. Artifacts of a run that fails are written to the folder `artifacts`. Only one job at a time may run in a process.
#[pyfunction]
#[pyo3(signature = (plan, index, tree, artifacts=None))]
fn run_sweep_job(
    py: Python<'_>,
    plan: &str,
    index: usize,
    tree: PathBuf,
    artifacts: Option<PathBuf>,
) -> PyResult<String> {
    let plan = SweepPlan::from_json(plan).map_err(runtime_error)?;
    let run = move || run_job(&plan, index, &tree, artifacts.as_deref());
    let running = thread::spawn(run);
    match released(py, "the run", || running.join())? {
        Ok(result) => result.map(|result| result.to_json()).map_err(runtime_error),
        Err(_) => Err(runtime_error("the run failed, which is a fault of Periplus")),
    }
}

/// Name of the folder with the copy of a sweep's files, whose plan is JSON.
#[pyfunction]
fn sweep_tree_name(plan: &str) -> PyResult<String> {
    let plan = SweepPlan::from_json(plan).map_err(runtime_error)?;
    Ok(plan.inputs.tree_name())
}
