//! Goal checkers: when a goal counts as reached.
//!
//! Source: `nav2_controller/plugins/*_goal_checker.cpp`.

mod adaptive;
mod axis;
mod simple;

use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_params::{ParamValue, ParamValues};

pub use adaptive::{
    ADAPTIVE_GOAL_CHECKER, AdaptiveAcceptance, AdaptiveGoalChecker, AdaptiveGoalParams,
};
pub use axis::{AXIS_GOAL_CHECKER, AxisGoalChecker, AxisGoalParams};
pub use simple::{
    POSITION_GOAL_CHECKER, PositionGoalParams, SIMPLE_GOAL_CHECKER, STOPPED_GOAL_CHECKER,
    SimpleGoalChecker, SimpleGoalParams, StoppedGoalParams,
};

use crate::GoalTolerance;
use crate::parameters::{ParameterChange, ParameterRefusal};

/// Inputs of a goal check. All poses are in one frame.
#[derive(Clone, Copy, Debug)]
pub struct GoalQuery<'a> {
    /// Pose of the robot.
    pub pose: Pose2,
    /// Goal.
    pub goal: Pose2,
    /// Measured velocity of the robot, in the base frame.
    pub velocity: Twist2,
    /// Rest of the plan within the costmap; may be empty.
    pub plan: &'a [Pose2],
}

impl GoalQuery<'_> {
    /// Squared distance to the goal \[m²\].
    pub(crate) fn squared_distance_m2(&self) -> f64 {
        let (dx_m, dy_m) = (self.pose.x_m - self.goal.x_m, self.pose.y_m - self.goal.y_m);
        dx_m * dx_m + dy_m * dy_m
    }

    /// Returns true if the heading is that of the goal, or with `is_symmetric` its opposite.
    pub(crate) fn has_heading(&self, tolerance_rad: f64, is_symmetric: bool) -> bool {
        let off_rad = normalize_angle(self.goal.yaw_rad - self.pose.yaw_rad).abs();
        let opposite_rad = std::f64::consts::PI - off_rad;
        off_rad <= tolerance_rad || is_symmetric && opposite_rad <= tolerance_rad
    }
}

/// State of a goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum GoalStatus {
    /// The robot is not at the position of the goal.
    Away,
    /// The robot is at the position of the goal; heading or standstill are missing.
    AtPosition,
    /// The goal is reached.
    Reached,
}

/// A goal checker. A cycle of the controller calls [`GoalChecker::check`] once, and passes the status on to the
/// controller ([`crate::ControlInput::is_position_reached`]).
pub trait GoalChecker: Send {
    /// Checks the goal. Stateful checkers remember that the position was reached.
    fn check(&mut self, query: &GoalQuery<'_>) -> GoalStatus;

    /// Forgets the state, as for a new goal.
    fn reset(&mut self);

    /// Returns the tolerances.
    fn tolerance(&self) -> GoalTolerance;

    /// Returns the parameters with their values.
    fn parameters(&self) -> &ParamValues;

    /// Changes a parameter.
    ///
    /// # Errors
    /// When the name is unknown, or the value has another type or is negative.
    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal>;
}
