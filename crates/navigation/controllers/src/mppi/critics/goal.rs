//! `GoalCritic` and `GoalAngleCritic`: distance and heading at the goal.

use super::{CriticContext, Weighting, length};
use crate::mppi::lane_math::normalize_angle;
use crate::mppi::lanes::{LANES, Row, ZEROS, min};
use crate::mppi::params::{GoalAngleParams, GoalParams};
use crate::mppi::samples::Samples;

/// Mean distance of a trajectory to the goal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GoalCritic {
    weighting: Weighting,
    threshold: f32,
}

impl GoalCritic {
    pub(crate) fn new(params: &GoalParams) -> Self {
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            threshold: params.threshold_m as f32,
        }
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        if !self.weighting.is_enabled || !context.is_goal_near(self.threshold) {
            return;
        }
        let [goal_x, goal_y, _] = context.goal();
        let scale = 1.0 / samples.steps.max(1) as f32;
        for (block, costs) in costs.iter_mut().enumerate() {
            let mut total = ZEROS;
            for (x, y) in samples.x.block(block).iter().zip(samples.y.block(block)) {
                for lane in 0..LANES {
                    total[lane] += length(x[lane] - goal_x, y[lane] - goal_y);
                }
            }
            self.weighting.add(costs, &total.map(|total| total * scale));
        }
    }
}

/// Mean difference of a trajectory to the heading of the goal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GoalAngleCritic {
    weighting: Weighting,
    threshold: f32,
    is_symmetric: bool,
}

impl GoalAngleCritic {
    pub(crate) fn new(params: &GoalAngleParams) -> Self {
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            threshold: params.threshold_m as f32,
            is_symmetric: params.is_symmetric,
        }
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        let applies = self.weighting.is_enabled && !context.ignores_goal_heading;
        if !applies || !context.is_goal_near(self.threshold) {
            return;
        }
        let [_, _, goal_yaw] = context.goal();
        let half_turn = if self.is_symmetric { std::f32::consts::PI } else { f32::INFINITY };
        let scale = 1.0 / samples.steps.max(1) as f32;
        for (block, costs) in costs.iter_mut().enumerate() {
            let mut total = ZEROS;
            for yaw in samples.yaw.block(block) {
                for lane in 0..LANES {
                    let angle = normalize_angle(goal_yaw - yaw[lane]).abs();
                    // The other heading is half a turn away.
                    total[lane] += min(angle, half_turn - angle);
                }
            }
            self.weighting.add(costs, &total.map(|total| total * scale));
        }
    }
}
