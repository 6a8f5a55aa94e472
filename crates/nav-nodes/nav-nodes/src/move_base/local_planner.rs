//! Local planners of ROS 1 with their path handlers and goal checkers.

use periplus_controllers::ros1::create_local_goal_checker;
use periplus_controllers::{
    Controller, GivenParameters, GoalChecker, PathHandler, PluginSetup, create_controller,
};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostics, Severity};
use periplus_geometry::Pose2;
use periplus_params::{ParamValue, ParamValues};

use super::global_planner::short_name;
use super::values::{PrivateParameters, reading};

/// A local planner.
pub(super) struct LocalPlanner {
    /// Name of the class, by which its parameters and topics are named.
    pub(super) name: String,
    pub(super) controller: Box<dyn Controller>,
    pub(super) handler: PathHandler,
    pub(super) checker: Box<dyn GoalChecker>,
}

impl LocalPlanner {
    /// Creates the local planner of a class from the parameters of its node.
    ///
    /// # Errors
    /// A sentence, if the class is not one of a local planner of ROS 1.
    pub(super) fn new(
        class: &str,
        control_period_s: f64,
        node: &PrivateParameters,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, String> {
        let name = short_name(class).to_owned();
        let group = node.group(&name);
        let setup = PluginSetup {
            name: &name,
            release: Nav2Release::Main,
            control_period_s,
            given: GivenParameters::new(group.given()),
            neighbours: Vec::new(),
            class_origin: node
                .entry("base_local_planner")
                .map(|entry| entry.origin)
                .unwrap_or_default(),
        };
        let mut found = Diagnostics::new();
        let controller =
            reading(&mut found, |found| create_controller(class.trim(), &setup, found));
        let first_error = || {
            let error = found.iter().find(|one| one.severity == Severity::Error);
            error.map_or_else(String::new, |error| error.message.clone())
        };
        let Some((controller, checker)) =
            controller.zip(create_local_goal_checker(class.trim(), &setup))
        else {
            return Err(format!(
                "`base_local_planner` is `{class}`, which is not a local planner of ROS 1 that is supported: \
                 TrajectoryPlannerROS, DWAPlannerROS, TebLocalPlannerROS. {}",
                first_error()
            ));
        };
        for one in found.iter() {
            diagnostics.push(one.clone());
        }
        let handler = PathHandler::new(controller.path_rules().unwrap_or_default());
        Ok(Self { name, controller, handler, checker })
    }

    /// Passes a plan on.
    pub(super) fn set_plan(&mut self, plan: &[Pose2]) {
        self.controller.set_plan(plan);
        self.handler.set_plan(plan.to_vec());
        self.checker.reset();
    }

    /// Values of its parameters; none without a table.
    pub(super) fn values(&self) -> Option<ParamValues> {
        self.controller.parameters().first().map(|group| group.values.clone())
    }

    /// Changes a parameter.
    ///
    /// # Errors
    /// The reason why it stays as it was.
    pub(super) fn change(&mut self, name: &str, value: ParamValue) -> Result<(), String> {
        self.controller.change_parameter(name, value).map_err(|error| error.to_string())?;
        if let Some(rules) = self.controller.path_rules() {
            self.handler.set_rules(rules);
        }
        Ok(())
    }
}
