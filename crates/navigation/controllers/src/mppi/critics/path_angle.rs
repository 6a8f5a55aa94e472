//! `PathAngleCritic`: heading towards the path.

use std::f32::consts::{FRAC_PI_2, PI};

use periplus_costmap::Nav2Release;

use super::{CriticContext, Weighting};
use crate::mppi::lane_math::{atan2, normalize_angle};
use crate::mppi::lanes::{LANES, Row, ZEROS};
use crate::mppi::params::PathAngleParams;
use crate::mppi::samples::Samples;

/// Lowest speed backwards that counts as reversing \[m/s\].
const MIN_REVERSE_M_PER_S: f32 = 1e-6;

/// Preferred direction of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PathAngleMode {
    /// Forwards.
    Forward,
    /// Forwards or backwards, whichever is nearer.
    Either,
    /// The direction of the path.
    OfPath,
}

/// Difference between the heading at the end of a trajectory and the direction to a point of the path, while
/// the robot does not face it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathAngleCritic {
    weighting: Weighting,
    offset_points: usize,
    threshold: f32,
    max_angle: f32,
    mode: PathAngleMode,
}

impl PathAngleCritic {
    pub(crate) fn new(params: &PathAngleParams, vx_min: f32, release: Nav2Release) -> Self {
        let can_reverse = vx_min <= -MIN_REVERSE_M_PER_S;
        let either = match release {
            Nav2Release::Humble => !params.prefers_forward,
            _ => params.mode == 1,
        };
        let mode = if either && can_reverse {
            PathAngleMode::Either
        } else if params.mode == 2 && release != Nav2Release::Humble {
            PathAngleMode::OfPath
        } else {
            PathAngleMode::Forward
        };
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            offset_points: params.offset_points,
            threshold: params.threshold_m as f32,
            max_angle: params.max_angle_rad as f32,
            mode,
        }
    }

    /// Returns the point of the path to face; none if the critic does not apply.
    fn aim(&self, context: &CriticContext<'_>, samples: &Samples) -> Option<[f32; 3]> {
        if !self.weighting.is_enabled || context.is_goal_within(self.threshold) {
            return None;
        }
        let aim = context.path.pose(context.furthest(samples).saturating_add(self.offset_points));
        let start = &context.start;
        let direction = atan2(aim[1] - start.y, aim[0] - start.x);
        (self.turn(direction, start.yaw, aim[2]) >= self.max_angle).then_some(aim)
    }

    /// Angle between a heading and a direction, by the mode.
    #[inline(always)]
    fn turn(&self, direction: f32, yaw: f32, path_yaw: f32) -> f32 {
        let is_backwards = match self.mode {
            PathAngleMode::Forward => false,
            PathAngleMode::Either => normalize_angle(direction - yaw).abs() >= FRAC_PI_2,
            PathAngleMode::OfPath => normalize_angle(direction - path_yaw).abs() >= FRAC_PI_2,
        };
        let direction = direction + if is_backwards { PI } else { 0.0 };
        normalize_angle(direction - yaw).abs()
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        let Some(aim) = self.aim(context, samples) else { return };
        let last = samples.steps.saturating_sub(1);
        // Humble compares all points.
        let first = if context.release == Nav2Release::Humble { 0 } else { last };
        let scale = 1.0 / (last - first + 1) as f32;
        for (block, costs) in costs.iter_mut().enumerate() {
            let (x, y) = (samples.x.block(block), samples.y.block(block));
            let yaw = samples.yaw.block(block);
            let mut total = ZEROS;
            for at in first..samples.steps {
                for lane in 0..LANES {
                    let direction = atan2(aim[1] - y[at][lane], aim[0] - x[at][lane]);
                    total[lane] += self.turn(direction, yaw[at][lane], aim[2]);
                }
            }
            self.weighting.add(costs, &total.map(|total| total * scale));
        }
    }
}
