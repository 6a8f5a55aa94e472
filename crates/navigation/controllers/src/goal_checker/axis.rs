//! Goal checker with tolerances along and across the end of the plan (main).
//!
//! Source: `axis_goal_checker.cpp`.

use periplus_params::{ParamValue, ParamValues, params};

use super::{GoalChecker, GoalQuery, GoalStatus};
use crate::GoalTolerance;
use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::{distance_m, plan_length_m};

params! {
    /// A goal checker with tolerances along and across the end of the plan.
    #[table(AXIS_GOAL_CHECKER, "an axis goal checker")]
    pub struct AxisGoalParams {
        /// Maximum distance along the end of the plan.
        #[param("along_path_tolerance", unit("m"))]
        along_path_tolerance_m: f64 = 0.25,
        /// Maximum distance across the end of the plan.
        #[param("cross_track_tolerance", unit("m"))]
        cross_track_tolerance_m: f64 = 0.25,
        /// Maximum length of the rest of the plan.
        #[param("path_length_tolerance", unit("m"))]
        path_length_tolerance_m: f64 = 1,
        /// Distance from the goal of the pose that gives the direction of the end.
        #[param("direction_estimation_distance", unit("m"))]
        direction_estimation_distance_m: f64 = 0.15,
        /// Accepts any distance beyond the goal.
        #[param("is_overshoot_valid")]
        is_overshoot_valid: bool = false,
    }
}

/// Distance at which a robot is at the goal in any direction \[m\].
const AT_GOAL_M: f64 = 1e-6;

/// `AxisGoalChecker`: position only, in the directions of the end of the plan.
#[derive(Clone, Debug)]
pub struct AxisGoalChecker {
    values: ParamValues,
    params: AxisGoalParams,
}

impl AxisGoalChecker {
    /// Creates a checker from values of [`AXIS_GOAL_CHECKER`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        Self { params: AxisGoalParams::from_values(&values), values }
    }

    fn min_tolerance_m(&self) -> f64 {
        self.params.along_path_tolerance_m.min(self.params.cross_track_tolerance_m)
    }

    fn is_reached(&self, query: &GoalQuery<'_>) -> bool {
        let params = &self.params;
        if plan_length_m(query.plan) > params.path_length_tolerance_m {
            return false;
        }
        let away_m = distance_m(query.pose, query.goal);
        let before = query.plan.split_last().map_or(&[][..], |(_, before)| before);
        let is_far = |pose: &&periplus_geometry::Pose2| {
            distance_m(**pose, query.goal) >= params.direction_estimation_distance_m
        };
        let Some(start) = before.iter().rev().find(is_far) else {
            return away_m < self.min_tolerance_m();
        };
        if away_m < AT_GOAL_M {
            return true;
        }
        let (dx_m, dy_m) = (query.goal.x_m - start.x_m, query.goal.y_m - start.y_m);
        let length_m = libm::hypot(dx_m, dy_m);
        let (x, y) = (dx_m / length_m, dy_m / length_m);
        let (to_x_m, to_y_m) = (query.goal.x_m - query.pose.x_m, query.goal.y_m - query.pose.y_m);
        let along_m = to_x_m * x + to_y_m * y;
        let across_m = to_x_m * y - to_y_m * x;
        let ahead_m = if params.is_overshoot_valid { along_m } else { along_m.abs() };
        ahead_m < params.along_path_tolerance_m && across_m.abs() < params.cross_track_tolerance_m
    }
}

impl GoalChecker for AxisGoalChecker {
    fn check(&mut self, query: &GoalQuery<'_>) -> GoalStatus {
        if self.is_reached(query) { GoalStatus::Reached } else { GoalStatus::Away }
    }

    fn reset(&mut self) {}

    fn tolerance(&self) -> GoalTolerance {
        GoalTolerance { xy_m: Some(self.min_tolerance_m()), yaw_rad: None }
    }

    fn parameters(&self) -> &ParamValues {
        &self.values
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        let change = change(&mut self.values, ChangeRules::NON_NEGATIVE, name, value)?;
        self.params = AxisGoalParams::from_values(&self.values);
        Ok(change)
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{Pose2, Twist2};

    use super::*;

    /// The plan ends at the origin in direction x.
    fn check(robot: (f64, f64), changes: &[(&str, ParamValue)], expected: bool) {
        let mut checker = AxisGoalChecker::new(ParamValues::defaults(&AXIS_GOAL_CHECKER));
        for (name, value) in changes {
            checker.change_parameter(name, value.clone()).unwrap();
        }
        let plan = [Pose2::new(-0.5, 0.0, 0.0), Pose2::new(-0.1, 0.0, 0.0), Pose2::IDENTITY];
        let pose = Pose2::new(robot.0, robot.1, 0.0);
        let query = GoalQuery { pose, goal: Pose2::IDENTITY, velocity: Twist2::ZERO, plan: &plan };
        assert_eq!(checker.check(&query) == GoalStatus::Reached, expected, "{robot:?}");
    }

    #[test]
    fn axes_have_separate_tolerances() {
        let narrow = ("cross_track_tolerance", ParamValue::Number(0.1));
        let narrow = &[narrow];
        check((-0.2, 0.09), narrow, true);
        check((-0.2, 0.11), narrow, false);
        check((-0.26, 0.0), narrow, false);
        check((0.3, 0.0), &[], false);
        check((0.3, 0.0), &[("is_overshoot_valid", ParamValue::Bool(true))], true);
        check((0.0, 0.0), &[], true);
    }

    #[test]
    fn without_a_direction_the_smaller_tolerance_counts() {
        let mut checker = AxisGoalChecker::new(ParamValues::defaults(&AXIS_GOAL_CHECKER));
        let velocity = Twist2::ZERO;
        let mut status = |x_m| {
            let pose = Pose2::new(x_m, 0.0, 0.0);
            checker.check(&GoalQuery { pose, goal: Pose2::IDENTITY, velocity, plan: &[] })
        };
        assert_eq!(status(0.2), GoalStatus::Reached);
        assert_eq!(status(0.25), GoalStatus::Away);
    }
}
