//! Behaviors that are classes of Python.

use std::sync::Arc;

use periplus::geometry::Twist2;
use periplus::msgs::builtin_interfaces::Duration;
use periplus::nav_nodes::behavior_server::{
    BehaviorAction, BehaviorGoal, BehaviorInput, BehaviorPlugin, CycleOutcome, FailureReason,
    MotionFailure,
};
use periplus::nav_nodes::navigation_plugins::NavigationPlugins;
use pyo3::exceptions::{PyStopIteration, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use super::plugin::{Factory, PluginError, Raised, call, create, poses, tuple, velocity};
use crate::work::in_plugin;

/// Registers a class of behaviors.
///
/// # Errors
/// `ValueError` for an action that behaviors cannot serve.
pub(super) fn add(
    plugins: NavigationPlugins,
    class: &str,
    factory: &Factory,
    raised: &Raised,
) -> PyResult<NavigationPlugins> {
    let action: Option<String> = Python::attach(|py| {
        factory.bind(py).getattr_opt("action").ok().flatten().and_then(|it| it.extract().ok())
    });
    let action = action.as_deref().and_then(BehaviorAction::of_name).ok_or_else(|| {
        PyValueError::new_err(format!(
            "the behavior `{class}` needs an attribute `action`: \"Spin\", \"BackUp\", \
             \"DriveOnHeading\" or \"Wait\""
        ))
    })?;
    let (factory, raised) = (Arc::clone(factory), raised.clone());
    Ok(plugins.behavior(class, action, move |setup, diagnostics| {
        let object = create(&factory, setup, "on_cycle", &raised, diagnostics)?;
        Some(Box::new(PythonBehavior { object, raised: raised.clone() }))
    }))
}

struct PythonBehavior {
    object: Py<PyAny>,
    raised: Raised,
}

/// An exception as a failure of the behavior.
fn failure(error: &PluginError) -> MotionFailure {
    MotionFailure { reason: FailureReason::InvalidInput, text: error.to_string() }
}

impl BehaviorPlugin for PythonBehavior {
    fn on_run(&mut self, goal: BehaviorGoal<'_>) -> Result<(), MotionFailure> {
        let called = call(&self.raised, |py| match self.object.bind(py).getattr_opt("on_run")? {
            Some(on_run) => on_run.call1((goal_dict(py, goal)?,)).map(drop),
            None => Ok(()),
        });
        called.map_err(|error| failure(&error))
    }

    fn on_cycle(&mut self, input: &mut BehaviorInput<'_>) -> CycleOutcome {
        let outcome = Python::attach(|py| {
            cycle(self.object.bind(py), input)
                .map_err(|error| PluginError::new(py, error, &self.raised))
        });
        outcome.unwrap_or_else(|error| CycleOutcome::Failed(failure(&error)))
    }

    fn on_end(&mut self) {
        let called = call(&self.raised, |py| match self.object.bind(py).getattr_opt("on_end")? {
            Some(on_end) => on_end.call0().map(drop),
            None => Ok(()),
        });
        // The goal has its result already.
        drop(called);
    }
}

fn seconds(duration: &Duration) -> f64 {
    duration.ns() as f64 * 1e-9
}

/// Fields of a goal, with times in seconds.
fn goal_dict<'py>(py: Python<'py>, goal: BehaviorGoal<'_>) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    match goal {
        BehaviorGoal::Spin(goal) => {
            fields.set_item("target_yaw", goal.target_yaw)?;
            fields.set_item("time_allowance", seconds(&goal.time_allowance))?;
        }
        BehaviorGoal::BackUp(goal) => {
            fields.set_item("target", (goal.target.x, goal.target.y, goal.target.z))?;
            fields.set_item("speed", goal.speed)?;
            fields.set_item("time_allowance", seconds(&goal.time_allowance))?;
        }
        BehaviorGoal::DriveOnHeading(goal) => {
            fields.set_item("target", (goal.target.x, goal.target.y, goal.target.z))?;
            fields.set_item("speed", goal.speed)?;
            fields.set_item("time_allowance", seconds(&goal.time_allowance))?;
        }
        BehaviorGoal::Wait(goal) => fields.set_item("time", seconds(&goal.time))?,
    }
    Ok(fields)
}

/// Calls `on_cycle(elapsed_s, pose)`; a generator asks whether poses are free by yielding them.
fn cycle(object: &Bound<'_, PyAny>, input: &mut BehaviorInput<'_>) -> PyResult<CycleOutcome> {
    let py = object.py();
    let pose = match input.pose() {
        Ok(pose) => tuple(pose),
        Err(failure) => return Ok(CycleOutcome::Failed(failure)),
    };
    let elapsed_s = input.elapsed_ns() as f64 * 1e-9;
    let mut result = in_plugin(|| object.call_method1("on_cycle", (elapsed_s, pose)))?;
    if result.hasattr("send")? {
        let generator = result;
        let mut answer = py.None().into_bound(py);
        result = loop {
            match in_plugin(|| generator.call_method1("send", (&answer,))) {
                Ok(asked) => {
                    let are_free = input.are_free(poses(&asked, "poses")?);
                    answer = are_free.into_pyobject(py)?.to_owned().into_any();
                }
                Err(error) if error.is_instance_of::<PyStopIteration>(py) => {
                    break error.value(py).getattr("value")?;
                }
                Err(error) => return Err(error),
            }
        };
    }
    outcome(&result)
}

/// Outcome of a cycle, from what `on_cycle` returns: a status, or (status, velocity), or (status, text) for a failure.
fn outcome(result: &Bound<'_, PyAny>) -> PyResult<CycleOutcome> {
    let (status, detail) = match result.cast::<PyTuple>() {
        Ok(pair) if pair.len() == 2 => (pair.get_item(0)?, Some(pair.get_item(1)?)),
        _ => (result.clone(), None),
    };
    let word = status.getattr_opt("value")?.unwrap_or_else(|| status.clone());
    let word: Option<String> = word.extract().ok();
    match (word.as_deref(), detail) {
        (Some("RUNNING"), Some(detail)) => Ok(CycleOutcome::Running(Some(velocity(&detail)?))),
        (Some("RUNNING"), None) => Ok(CycleOutcome::Running(Some(Twist2::ZERO))),
        (Some("SUCCESS"), _) => Ok(CycleOutcome::Succeeded),
        (Some("FAILURE"), detail) => {
            let text = detail.map(|it| it.str().map(|it| it.to_string())).transpose()?;
            let text = text.unwrap_or_else(|| "the behavior failed".to_owned());
            Ok(CycleOutcome::Failed(MotionFailure { reason: FailureReason::CollisionAhead, text }))
        }
        _ => Err(PyTypeError::new_err(format!(
            "`on_cycle` must return (Status.RUNNING, (vx, vy, wz)), Status.SUCCESS or \
             (Status.FAILURE, text), not {}",
            result.repr()?
        ))),
    }
}
