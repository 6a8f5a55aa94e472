//! RotateToGoal: slows down at the position of the goal, then rotates to its heading.
//!
//! Source: `rotate_to_goal.cpp`.

use periplus_costmap::Nav2Release;
use periplus_geometry::normalize_angle;
use periplus_params::ParamValues;

use super::{CriticInput, IllegalTrajectory, TrajectoryCritic};
use crate::dwb::params::RotateToGoalCriticParams;
use crate::dwb::{DwbParams, SampledTrajectory};
use crate::path::{distance_m, plan_length_m};

/// Phase at the goal. It never goes back until the next plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum GoalPhase {
    Away,
    SlowingDown,
    Rotating,
}

/// Critic for the heading of the goal.
#[derive(Clone, Debug)]
pub struct RotateToGoalCritic {
    params: RotateToGoalCriticParams,
    tolerance_m: f64,
    path_length_tolerance_m: f64,
    stopped_m_s: f64,
    phase: GoalPhase,
    speed_m_s: f64,
}

impl RotateToGoalCritic {
    /// Creates the critic from values of [`crate::dwb::ROTATE_TO_GOAL_CRITIC`] and tolerances of the planner.
    #[must_use]
    pub fn new(values: &ParamValues, planner: &DwbParams, release: Nav2Release) -> Self {
        let path_length_tolerance_m = match release {
            Nav2Release::Main => planner.path_length_tolerance_m,
            _ => f64::INFINITY,
        };
        Self {
            params: RotateToGoalCriticParams::from_values(values),
            tolerance_m: planner.xy_goal_tolerance_m,
            path_length_tolerance_m,
            stopped_m_s: planner.trans_stopped_velocity_m_s,
            phase: GoalPhase::Away,
            speed_m_s: 0.0,
        }
    }

    /// Difference of the heading to that of the goal \[rad\].
    fn heading_score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let time_s = match self.params.lookahead_time_s {
            ..0.0 => f64::INFINITY,
            time_s => time_s,
        };
        let heading_rad = trajectory.heading_at(time_s);
        let heading_rad = heading_rad.ok_or(IllegalTrajectory::new("Empty trajectory."))?;
        Ok(normalize_angle(input.goal.yaw_rad - heading_rad).abs())
    }
}

impl TrajectoryCritic for RotateToGoalCritic {
    fn prepare(&mut self, input: &CriticInput<'_>) -> bool {
        let is_at_goal = distance_m(input.pose, input.goal) <= self.tolerance_m
            && plan_length_m(input.plan) <= self.path_length_tolerance_m;
        self.speed_m_s = input.velocity.speed_m_s();
        if is_at_goal {
            self.phase = self.phase.max(GoalPhase::SlowingDown);
        }
        if self.phase == GoalPhase::SlowingDown && self.speed_m_s <= self.stopped_m_s {
            self.phase = GoalPhase::Rotating;
        }
        true
    }

    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.critic.scale
    }

    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let speed_m_s = trajectory.velocity.speed_m_s();
        match self.phase {
            GoalPhase::Away => Ok(0.0),
            GoalPhase::SlowingDown if speed_m_s >= self.speed_m_s => {
                Err(IllegalTrajectory::new("Not slowing down near goal."))
            }
            GoalPhase::SlowingDown => {
                let slowing = speed_m_s * speed_m_s * self.params.slowing_factor;
                Ok(slowing + self.heading_score(input, trajectory)?)
            }
            GoalPhase::Rotating if speed_m_s > 0.0 => {
                Err(IllegalTrajectory::new("Nonrotation command near goal."))
            }
            GoalPhase::Rotating => self.heading_score(input, trajectory),
        }
    }

    fn reset(&mut self) {
        self.phase = GoalPhase::Away;
    }
}
