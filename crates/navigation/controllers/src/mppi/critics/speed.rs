//! `PreferForwardCritic`, `TwirlingCritic`, `VelocityDeadbandCritic`: preferred velocities.

use super::{CriticContext, Weighting};
use crate::mppi::lanes::{LANES, Row, ZEROS, max};
use crate::mppi::params::{MppiPreferForwardParams, MppiTwirlingParams, VelocityDeadbandParams};
use crate::mppi::samples::Samples;

/// Distance driven backwards.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PreferForwardCritic {
    weighting: Weighting,
    threshold: f32,
}

impl PreferForwardCritic {
    pub(crate) fn new(params: &MppiPreferForwardParams) -> Self {
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            threshold: params.threshold_m as f32,
        }
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        if !self.weighting.is_enabled || context.is_goal_within(self.threshold) {
            return;
        }
        for (block, costs) in costs.iter_mut().enumerate() {
            let mut total = ZEROS;
            for vx in samples.vx.velocities.block(block) {
                for lane in 0..LANES {
                    total[lane] += max(-vx[lane], 0.0);
                }
            }
            self.weighting.add(costs, &total.map(|total| total * context.step_s));
        }
    }
}

/// Mean turn rate.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwirlingCritic {
    weighting: Weighting,
}

impl TwirlingCritic {
    pub(crate) fn new(params: &MppiTwirlingParams) -> Self {
        Self { weighting: Weighting::new(&params.common, params.weight) }
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        let is_at_goal = context.goal_tolerance.is_some_and(|it| context.is_goal_within(it));
        if !self.weighting.is_enabled || is_at_goal {
            return;
        }
        let scale = 1.0 / samples.steps.max(1) as f32;
        for (block, costs) in costs.iter_mut().enumerate() {
            let mut total = ZEROS;
            for wz in samples.wz.velocities.block(block) {
                for lane in 0..LANES {
                    total[lane] += wz[lane].abs();
                }
            }
            self.weighting.add(costs, &total.map(|total| total * scale));
        }
    }
}

/// Time integral of the speed that is missing to the lowest that the robot can drive.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VelocityDeadbandCritic {
    weighting: Weighting,
    deadband: [f32; 3],
}

impl VelocityDeadbandCritic {
    pub(crate) fn new(params: &VelocityDeadbandParams) -> Self {
        let speed = |axis: usize| params.deadband.get(axis).map_or(0.0, |it| it.abs() as f32);
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            deadband: [speed(0), speed(1), speed(2)],
        }
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        if !self.weighting.is_enabled {
            return;
        }
        let axes = [&samples.vx, &samples.vy, &samples.wz];
        for (block, costs) in costs.iter_mut().enumerate() {
            let mut total = ZEROS;
            for (axis, deadband) in axes.into_iter().zip(self.deadband) {
                for row in axis.velocities.block(block) {
                    for lane in 0..LANES {
                        total[lane] += max(deadband - row[lane].abs(), 0.0);
                    }
                }
            }
            self.weighting.add(costs, &total.map(|total| total * context.step_s));
        }
    }
}
