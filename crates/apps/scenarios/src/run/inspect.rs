//! Inspection of a scenario before it runs: the parameters of its nodes.

use periplus_graph::{ParameterRejection, parameter_from_yaml};
use periplus_msgs::rcl_interfaces::Parameter;
use periplus_session::SimulationSession;

use super::task::ScenarioTask;
use super::{ScenarioRunOptions, begin};
use crate::error::ScenarioError;
use crate::file::Scenario;

/// A scenario that has started and makes no step: its nodes exist, and its files are read.
pub struct ScenarioInspection {
    session: SimulationSession,
    _task: ScenarioTask,
}

/// Starts a scenario without running it. All files are read that a run may need, also those of models that events insert.
///
/// # Errors
/// As for [`super::run`], and when a model of an event cannot be inserted.
pub fn inspect(
    scenario: &Scenario,
    options: &ScenarioRunOptions,
) -> Result<ScenarioInspection, ScenarioError> {
    let seed = options.seed_of(scenario);
    let mut session = begin(scenario, options, seed)?;
    let task = ScenarioTask::new(scenario, &mut session, options, seed)?;
    task.spawn_all(session.simulation_mut()).map_err(ScenarioError::Failed)?;
    Ok(ScenarioInspection { session, _task: task })
}

impl ScenarioInspection {
    /// Full names of the nodes and the names of their parameters, both sorted.
    #[must_use]
    pub fn parameters(&self) -> Vec<(String, Vec<String>)> {
        let nodes = self.session.graph().parameters().into_iter();
        nodes.map(|(node, all)| (node, all.into_iter().map(|it| it.name).collect())).collect()
    }

    /// Checks a value, written as in a parameter file, for a parameter of a node.
    ///
    /// # Errors
    /// The reason: the node or parameter does not exist, another type, or a value out of its range.
    pub fn check(
        &self,
        node: &str,
        parameter: &str,
        value: &str,
    ) -> Result<(), ParameterRejection> {
        let value = parameter_from_yaml(value)
            .map_err(|error| ParameterRejection::new(error.to_string()))?;
        let parameter = Parameter { name: parameter.to_owned(), value };
        self.session.graph().check_parameter(node, parameter)
    }
}
