//! Goal checkers with a circle around the goal.
//!
//! Source: `simple_goal_checker.cpp`, `stopped_goal_checker.cpp`, `position_goal_checker.cpp`.

use periplus_costmap::Nav2Release;
use periplus_params::{ParamValue, ParamValues, params};

use super::{GoalChecker, GoalQuery, GoalStatus};
use crate::GoalTolerance;
use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::plan_length_m;

params! {
    /// A goal checker for position and heading.
    #[table(SIMPLE_GOAL_CHECKER, "a simple goal checker")]
    pub struct SimpleGoalParams {
        /// Maximum distance to the goal.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.25,
        /// Distance beyond the tolerance at which a reached position counts as left; 0 for never (main).
        #[param("xy_goal_tolerance_buffer", unit("m"))]
        xy_goal_tolerance_buffer_m: f64 = 0,
        /// Maximum difference to the heading of the goal.
        #[param("yaw_goal_tolerance", unit("rad"))]
        yaw_goal_tolerance_rad: f64 = 0.25,
        /// Maximum length of the rest of the plan (main).
        #[param("path_length_tolerance", unit("m"))]
        path_length_tolerance_m: f64 = 1,
        /// Checks only the heading once the position was reached.
        #[param("stateful")]
        stateful: bool = true,
        /// Accepts the opposite heading.
        #[param("symmetric_yaw_tolerance")]
        symmetric_yaw_tolerance: bool = false,
    }
}

params! {
    /// A goal checker for position, heading and standstill.
    #[table(STOPPED_GOAL_CHECKER, "a stopped goal checker")]
    pub struct StoppedGoalParams {
        /// Maximum distance to the goal.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.25,
        /// Distance beyond the tolerance at which a reached position counts as left; 0 for never (main).
        #[param("xy_goal_tolerance_buffer", unit("m"))]
        xy_goal_tolerance_buffer_m: f64 = 0,
        /// Maximum difference to the heading of the goal.
        #[param("yaw_goal_tolerance", unit("rad"))]
        yaw_goal_tolerance_rad: f64 = 0.25,
        /// Maximum length of the rest of the plan (main).
        #[param("path_length_tolerance", unit("m"))]
        path_length_tolerance_m: f64 = 1,
        /// Checks only the heading once the position was reached.
        #[param("stateful")]
        stateful: bool = true,
        /// Accepts the opposite heading.
        #[param("symmetric_yaw_tolerance")]
        symmetric_yaw_tolerance: bool = false,
        /// Maximum speed of translation.
        #[param("trans_stopped_velocity", unit("m/s"))]
        trans_stopped_velocity_m_s: f64 = 0.25,
        /// Maximum turn rate.
        #[param("rot_stopped_velocity", unit("rad/s"))]
        rot_stopped_velocity_rad_s: f64 = 0.25,
    }
}

params! {
    /// A goal checker for the position.
    #[table(POSITION_GOAL_CHECKER, "a position goal checker")]
    pub struct PositionGoalParams {
        /// Maximum distance to the goal.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.25,
        /// Distance beyond the tolerance at which a reached position counts as left; 0 for never (main).
        #[param("xy_goal_tolerance_buffer", unit("m"))]
        xy_goal_tolerance_buffer_m: f64 = 0,
        /// Maximum length of the rest of the plan (main).
        #[param("path_length_tolerance", unit("m"))]
        path_length_tolerance_m: f64 = 1,
        /// Counts the position as reached until the next goal.
        #[param("stateful")]
        stateful: bool = true,
    }
}

/// Condition besides the position.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Heading {
    Any,
    Within { tolerance_rad: f64, is_symmetric: bool },
}

/// Maximum speeds of a robot at a standstill.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Standstill {
    translation_m_s: f64,
    rotation_rad_s: f64,
}

/// `SimpleGoalChecker`, `StoppedGoalChecker` and `PositionGoalChecker`: a circle around the goal, and then heading and
/// standstill.
#[derive(Clone, Debug)]
pub struct SimpleGoalChecker {
    values: ParamValues,
    release: Nav2Release,
    position: PositionGoalParams,
    heading: Heading,
    standstill: Option<Standstill>,
    was_at_position: bool,
}

impl SimpleGoalChecker {
    /// Creates a checker from values of [`SIMPLE_GOAL_CHECKER`], [`STOPPED_GOAL_CHECKER`] or
    /// [`POSITION_GOAL_CHECKER`].
    #[must_use]
    pub fn new(values: ParamValues, release: Nav2Release) -> Self {
        let mut checker = Self {
            position: PositionGoalParams::from_values(&values),
            values,
            release,
            heading: Heading::Any,
            standstill: None,
            was_at_position: false,
        };
        checker.read_values();
        checker
    }

    fn read_values(&mut self) {
        let values = &self.values;
        self.position = PositionGoalParams::from_values(values);
        if self.release < Nav2Release::Main {
            self.position.path_length_tolerance_m = f64::INFINITY;
            self.position.xy_goal_tolerance_buffer_m = 0.0;
        }
        if *values.table() == POSITION_GOAL_CHECKER {
            return;
        }
        let simple = SimpleGoalParams::from_values(values);
        self.heading = Heading::Within {
            tolerance_rad: simple.yaw_goal_tolerance_rad,
            is_symmetric: simple.symmetric_yaw_tolerance,
        };
        if *values.table() == STOPPED_GOAL_CHECKER {
            let stopped = StoppedGoalParams::from_values(values);
            self.standstill = Some(Standstill {
                translation_m_s: stopped.trans_stopped_velocity_m_s,
                rotation_rad_s: stopped.rot_stopped_velocity_rad_s,
            });
        }
    }

    fn is_at_position(&mut self, query: &GoalQuery<'_>) -> bool {
        let position = &self.position;
        if plan_length_m(query.plan) > position.path_length_tolerance_m {
            return false;
        }
        let away_m2 = query.squared_distance_m2();
        let buffer_m = position.xy_goal_tolerance_buffer_m;
        if position.stateful && self.was_at_position {
            let limit_m = position.xy_goal_tolerance_m + buffer_m;
            self.was_at_position = buffer_m <= 0.0 || away_m2 <= limit_m * limit_m;
            return self.was_at_position;
        }
        let is_near = away_m2 <= position.xy_goal_tolerance_m * position.xy_goal_tolerance_m;
        self.was_at_position = is_near && position.stateful;
        is_near
    }
}

impl GoalChecker for SimpleGoalChecker {
    fn check(&mut self, query: &GoalQuery<'_>) -> GoalStatus {
        if !self.is_at_position(query) {
            return GoalStatus::Away;
        }
        let has_heading = match self.heading {
            Heading::Any => true,
            Heading::Within { tolerance_rad, is_symmetric } => {
                query.has_heading(tolerance_rad, is_symmetric)
            }
        };
        let is_still = self.standstill.is_none_or(|limit| {
            query.velocity.wz_rad_s.abs() <= limit.rotation_rad_s
                && query.velocity.speed_m_s() <= limit.translation_m_s
        });
        if has_heading && is_still { GoalStatus::Reached } else { GoalStatus::AtPosition }
    }

    fn reset(&mut self) {
        self.was_at_position = false;
    }

    fn tolerance(&self) -> GoalTolerance {
        GoalTolerance {
            xy_m: Some(self.position.xy_goal_tolerance_m),
            yaw_rad: match self.heading {
                Heading::Any => None,
                Heading::Within { tolerance_rad, .. } => Some(tolerance_rad),
            },
        }
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
        self.read_values();
        Ok(change)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use periplus_geometry::{Pose2, Twist2};
    use periplus_params::Table;

    use super::*;

    fn checker(table: &'static Table, changes: &[(&str, ParamValue)]) -> SimpleGoalChecker {
        let mut checker = SimpleGoalChecker::new(ParamValues::defaults(table), Nav2Release::Main);
        for (name, value) in changes {
            checker.change_parameter(name, value.clone()).unwrap();
        }
        checker
    }

    /// Checks robots at x with a heading and a speed, one after the other, with the goal at the origin.
    fn check(mut checker: SimpleGoalChecker, robots: &[(f64, f64, f64)], expected: &[GoalStatus]) {
        let statuses: Vec<GoalStatus> = robots
            .iter()
            .map(|&(x_m, yaw_rad, speed_m_s)| {
                checker.check(&GoalQuery {
                    pose: Pose2::new(x_m, 0.0, yaw_rad),
                    goal: Pose2::IDENTITY,
                    velocity: Twist2::new(speed_m_s, 0.0, 0.0),
                    plan: &[],
                })
            })
            .collect();
        assert_eq!(statuses, expected);
    }

    use GoalStatus::{AtPosition, Away, Reached};

    #[test]
    fn tolerances_include_their_limits() {
        let simple = checker(&SIMPLE_GOAL_CHECKER, &[("stateful", ParamValue::Bool(false))]);
        let robots = [(0.25, 0.25, 9.0), (0.2501, 0.0, 0.0), (0.0, 0.2501, 0.0)];
        check(simple, &robots, &[Reached, Away, AtPosition]);
    }

    #[test]
    fn a_reached_position_is_remembered() {
        let robots = [(0.2, 1.0, 0.0), (0.6, 1.0, 0.0), (0.6, 0.1, 0.0)];
        let simple = checker(&SIMPLE_GOAL_CHECKER, &[]);
        check(simple, &robots, &[AtPosition, AtPosition, Reached]);
        let buffer = ("xy_goal_tolerance_buffer", ParamValue::Number(0.1));
        check(checker(&SIMPLE_GOAL_CHECKER, &[buffer]), &robots, &[AtPosition, Away, Away]);
    }

    #[test]
    fn other_conditions() {
        let symmetric = ("symmetric_yaw_tolerance", ParamValue::Bool(true));
        check(checker(&SIMPLE_GOAL_CHECKER, &[symmetric]), &[(0.0, PI - 0.2, 0.0)], &[Reached]);
        let robots = [(0.0, 0.0, 0.3), (0.0, 0.0, 0.25)];
        check(checker(&STOPPED_GOAL_CHECKER, &[]), &robots, &[AtPosition, Reached]);
        check(checker(&POSITION_GOAL_CHECKER, &[]), &[(0.0, 3.0, 1.0)], &[Reached]);
    }

    #[test]
    fn a_long_rest_of_the_plan_counts_in_main_only() {
        let plan = [Pose2::new(0.1, 0.0, 0.0), Pose2::new(0.1, 2.0, 0.0), Pose2::IDENTITY];
        let velocity = Twist2::ZERO;
        let query = GoalQuery { pose: plan[0], goal: Pose2::IDENTITY, velocity, plan: &plan };
        let status = |release| {
            SimpleGoalChecker::new(ParamValues::defaults(&SIMPLE_GOAL_CHECKER), release)
                .check(&query)
        };
        assert_eq!(status(Nav2Release::Main), Away);
        assert_eq!(status(Nav2Release::Jazzy), Reached);
    }
}
