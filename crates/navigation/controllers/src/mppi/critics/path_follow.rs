//! `PathFollowCritic`: progress along the path.

use super::{CriticContext, Weighting, length};
use crate::mppi::lanes::{LANES, Row, ZEROS};
use crate::mppi::params::PathFollowParams;
use crate::mppi::samples::Samples;

/// Distance between the end of a trajectory and a point of the path beyond those that samples reach.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathFollowCritic {
    weighting: Weighting,
    offset_points: usize,
    threshold: f32,
}

impl PathFollowCritic {
    pub(crate) fn new(params: &PathFollowParams) -> Self {
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            offset_points: params.offset_points,
            threshold: params.threshold_m as f32,
        }
    }

    /// Returns the index of the point to drive to: the first free one from the offset on.
    fn aim(&self, context: &CriticContext<'_>, samples: &Samples) -> Option<usize> {
        let path = context.path;
        if !self.weighting.is_enabled || path.len() < 2 || context.is_goal_within(self.threshold) {
            return None;
        }
        let last = path.last();
        let aim = context.furthest(samples).saturating_add(self.offset_points).min(last);
        let free = (aim..last - 1).find(|index| context.is_valid(*index));
        Some(free.unwrap_or(aim.max(last - 1)))
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        let Some(aim) = self.aim(context, samples) else { return };
        let [aim_x, aim_y, _] = context.path.pose(aim);
        for (block, costs) in costs.iter_mut().enumerate() {
            let (Some(x), Some(y)) = (samples.x.block(block).last(), samples.y.block(block).last())
            else {
                return;
            };
            let mut distances = ZEROS;
            for lane in 0..LANES {
                distances[lane] = length(x[lane] - aim_x, y[lane] - aim_y);
            }
            self.weighting.add(costs, &distances);
        }
    }
}
