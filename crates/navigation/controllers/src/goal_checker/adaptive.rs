//! Goal checker whose tolerance grows when the robot comes no nearer (main).
//!
//! Source: `adaptive_tolerance_goal_checker.cpp`.

use std::fmt;

use periplus_params::{ParamValue, ParamValues, params};

use super::{GoalChecker, GoalQuery, GoalStatus};
use crate::GoalTolerance;
use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::plan_length_m;

params! {
    /// A goal checker with a fine tolerance, and a coarse one for robots that come no nearer.
    #[table(ADAPTIVE_GOAL_CHECKER, "an adaptive tolerance goal checker")]
    pub struct AdaptiveGoalParams {
        /// Distance to the goal that is accepted at once.
        #[param("fine_xy_goal_tolerance", unit("m"))]
        fine_xy_goal_tolerance_m: f64 = 0.1,
        /// Distance to the goal that is accepted when the robot comes no nearer.
        #[param("coarse_xy_goal_tolerance", unit("m"))]
        coarse_xy_goal_tolerance_m: f64 = 0.25,
        /// Distance beyond the tolerance at which a reached position counts as left; 0 for never.
        #[param("xy_goal_tolerance_buffer", unit("m"))]
        xy_goal_tolerance_buffer_m: f64 = 0,
        /// Maximum difference to the heading of the goal.
        #[param("yaw_goal_tolerance", unit("rad"))]
        yaw_goal_tolerance_rad: f64 = 0.25,
        /// Maximum length of the rest of the plan.
        #[param("path_length_tolerance", unit("m"))]
        path_length_tolerance_m: f64 = 1,
        /// Checks only the heading once the position was reached.
        #[param("stateful")]
        stateful: bool = true,
        /// Accepts the opposite heading.
        #[param("symmetric_yaw_tolerance")]
        symmetric_yaw_tolerance: bool = false,
        /// Maximum speed of translation of a robot that stands still.
        #[param("trans_stopped_velocity", unit("m/s"))]
        trans_stopped_velocity_m_s: f64 = 0.1,
        /// Maximum turn rate of a robot that stands still.
        #[param("rot_stopped_velocity", unit("rad/s"))]
        rot_stopped_velocity_rad_s: f64 = 0.1,
        /// Number of cycles without motion or without a smaller distance.
        #[param("required_stagnation_cycles", within(1.0, 1e9))]
        required_stagnation_cycles: usize = 15,
    }
}

/// Reason for which a position was accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdaptiveAcceptance {
    /// Within the fine tolerance.
    Fine,
    /// Within the coarse tolerance, and past the goal.
    FinishLine,
    /// Within the coarse tolerance, and standing still.
    Stopped,
    /// Within the coarse tolerance, and not coming nearer.
    NoNearer,
}

impl fmt::Display for AdaptiveAcceptance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fine => "fine tolerance",
            Self::FinishLine => "coarse tolerance, past the goal",
            Self::Stopped => "coarse tolerance, standing still",
            Self::NoNearer => "coarse tolerance, not coming nearer",
        })
    }
}

/// Observations since the robot came within the coarse tolerance.
#[derive(Clone, Copy, Debug)]
struct Approach {
    best_m2: f64,
    /// From the robot to the goal when it entered \[m\].
    entry_m: (f64, f64),
    stopped_count: usize,
    no_nearer_count: usize,
}

/// `AdaptiveToleranceGoalChecker`.
#[derive(Clone, Debug)]
pub struct AdaptiveGoalChecker {
    values: ParamValues,
    params: AdaptiveGoalParams,
    approach: Option<Approach>,
    acceptance: Option<AdaptiveAcceptance>,
}

impl AdaptiveGoalChecker {
    /// Creates a checker from values of [`ADAPTIVE_GOAL_CHECKER`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let params = AdaptiveGoalParams::from_values(&values);
        Self { values, params, approach: None, acceptance: None }
    }

    /// Returns the reason for which the position counts as reached; none if it does not.
    #[must_use]
    pub fn acceptance(&self) -> Option<AdaptiveAcceptance> {
        self.acceptance
    }

    fn is_at_position(&mut self, query: &GoalQuery<'_>) -> bool {
        let params = &self.params;
        if plan_length_m(query.plan) > params.path_length_tolerance_m {
            return false;
        }
        let away_m2 = query.squared_distance_m2();
        if params.stateful
            && let Some(acceptance) = self.acceptance
        {
            let tolerance_m = match acceptance {
                AdaptiveAcceptance::Fine => params.fine_xy_goal_tolerance_m,
                _ => params.coarse_xy_goal_tolerance_m,
            };
            let buffer_m = params.xy_goal_tolerance_buffer_m;
            let limit_m = tolerance_m + buffer_m;
            let is_left = buffer_m > 0.0 && away_m2 > limit_m * limit_m;
            if is_left {
                self.reset();
            }
            return !is_left;
        }
        self.acceptance = self.accept(query, away_m2);
        self.acceptance.is_some()
    }

    fn accept(&mut self, query: &GoalQuery<'_>, away_m2: f64) -> Option<AdaptiveAcceptance> {
        let params = &self.params;
        let square = |length_m: f64| length_m * length_m;
        if away_m2 <= square(params.fine_xy_goal_tolerance_m) {
            return Some(AdaptiveAcceptance::Fine);
        }
        if away_m2 > square(params.coarse_xy_goal_tolerance_m) {
            self.approach = None;
            return None;
        }
        let (dx_m, dy_m) = (query.pose.x_m - query.goal.x_m, query.pose.y_m - query.goal.y_m);
        let Some(approach) = &mut self.approach else {
            self.approach = Some(Approach {
                best_m2: away_m2,
                entry_m: (-dx_m, -dy_m),
                stopped_count: 0,
                no_nearer_count: 0,
            });
            return None;
        };
        if away_m2 < approach.best_m2 {
            approach.best_m2 = away_m2;
            approach.no_nearer_count = 0;
        } else {
            approach.no_nearer_count += 1;
        }
        let is_still = query.velocity.speed_m_s() <= params.trans_stopped_velocity_m_s
            && query.velocity.wz_rad_s.abs() <= params.rot_stopped_velocity_rad_s;
        approach.stopped_count = if is_still { approach.stopped_count + 1 } else { 0 };
        let required = params.required_stagnation_cycles;
        if dx_m * approach.entry_m.0 + dy_m * approach.entry_m.1 >= 0.0 {
            Some(AdaptiveAcceptance::FinishLine)
        } else if approach.stopped_count >= required {
            Some(AdaptiveAcceptance::Stopped)
        } else {
            (approach.no_nearer_count >= required).then_some(AdaptiveAcceptance::NoNearer)
        }
    }
}

impl GoalChecker for AdaptiveGoalChecker {
    fn check(&mut self, query: &GoalQuery<'_>) -> GoalStatus {
        if !self.is_at_position(query) {
            return GoalStatus::Away;
        }
        let params = &self.params;
        if query.has_heading(params.yaw_goal_tolerance_rad, params.symmetric_yaw_tolerance) {
            GoalStatus::Reached
        } else {
            GoalStatus::AtPosition
        }
    }

    fn reset(&mut self) {
        self.approach = None;
        self.acceptance = None;
    }

    fn tolerance(&self) -> GoalTolerance {
        GoalTolerance {
            xy_m: Some(self.params.coarse_xy_goal_tolerance_m),
            yaw_rad: Some(self.params.yaw_goal_tolerance_rad),
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
        self.params = AdaptiveGoalParams::from_values(&self.values);
        Ok(change)
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{Pose2, Twist2};

    use super::*;

    /// Returns the number of checks until the goal is reached by a robot at these x and speeds, the last forever.
    fn check(robots: &[(f64, f64)], expected: (usize, AdaptiveAcceptance)) {
        let mut checker = AdaptiveGoalChecker::new(ParamValues::defaults(&ADAPTIVE_GOAL_CHECKER));
        for index in 0..100 {
            let (x_m, speed_m_s) = robots[index.min(robots.len() - 1)];
            let status = checker.check(&GoalQuery {
                pose: Pose2::new(x_m, 0.0, 0.0),
                goal: Pose2::IDENTITY,
                velocity: Twist2::new(speed_m_s, 0.0, 0.0),
                plan: &[],
            });
            if status == GoalStatus::Reached {
                assert_eq!((index + 1, checker.acceptance().unwrap()), expected);
                return;
            }
        }
        panic!("the goal was not reached");
    }

    #[test]
    fn the_tolerance_grows_for_robots_that_come_no_nearer() {
        check(&[(-0.3, 0.5), (-0.1, 0.5)], (2, AdaptiveAcceptance::Fine));
        // The second check enters the zone; fifteen more follow.
        check(&[(-0.3, 0.5), (-0.2, 0.0)], (17, AdaptiveAcceptance::Stopped));
        check(&[(-0.3, 0.5), (-0.2, 0.5)], (17, AdaptiveAcceptance::NoNearer));
        check(&[(-0.2, 0.5), (0.15, 0.5)], (2, AdaptiveAcceptance::FinishLine));
    }
}
