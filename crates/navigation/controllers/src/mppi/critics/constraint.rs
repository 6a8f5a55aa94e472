//! `ConstraintCritic`: velocities beyond the limits.

use periplus_costmap::Nav2Release;

use super::{CriticContext, CriticLimits, Weighting, length};
use crate::mppi::lanes::{LANES, Row, ZEROS, max};
use crate::mppi::limits::MppiModel;
use crate::mppi::params::ConstraintParams;
use crate::mppi::samples::Samples;

/// Lowest turn rate by which a speed is divided \[rad/s\].
const MIN_TURN_RATE_RAD_PER_S: f32 = 1e-6;

/// Time integral of the excess of the velocity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ConstraintCritic {
    weighting: Weighting,
    /// Limits of the speed; before main that of both axes together, with the sign of the motion.
    fastest: f32,
    slowest: f32,
    vy_max: f32,
}

impl ConstraintCritic {
    pub(crate) fn new(
        params: &ConstraintParams,
        limits: CriticLimits,
        release: Nav2Release,
    ) -> Self {
        let CriticLimits { vx_max, vx_min, vy_max } = limits;
        let weighting = Weighting::new(&params.common, params.weight);
        if release == Nav2Release::Main {
            return Self { weighting, fastest: vx_max, slowest: vx_min, vy_max };
        }
        let sign = if vx_min > 0.0 { 1.0 } else { -1.0 };
        Self {
            weighting,
            fastest: length(vx_max, vy_max),
            slowest: sign * length(vx_min, vy_max),
            vy_max,
        }
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        if !self.weighting.is_enabled {
            return;
        }
        for (block, costs) in costs.iter_mut().enumerate() {
            let mut excess = match context.model {
                MppiModel::DiffDrive => self.forwards(samples, block),
                MppiModel::Omni if context.release == Nav2Release::Main => {
                    self.axes(samples, block)
                }
                MppiModel::Omni => self.total(samples, block),
                MppiModel::Ackermann { min_turning_radius_m, .. } => {
                    self.steered(samples, block, min_turning_radius_m)
                }
            };
            for lane in &mut excess {
                *lane *= context.step_s;
            }
            self.weighting.add(costs, &excess);
        }
    }

    #[inline(always)]
    fn excess(&self, speed: f32) -> f32 {
        max(speed - self.fastest, 0.0) + max(self.slowest - speed, 0.0)
    }

    fn forwards(&self, samples: &Samples, block: usize) -> Row {
        let mut total = ZEROS;
        for vx in samples.vx.velocities.block(block) {
            for lane in 0..LANES {
                total[lane] += self.excess(vx[lane]);
            }
        }
        total
    }

    fn axes(&self, samples: &Samples, block: usize) -> Row {
        let mut total = ZEROS;
        let rows =
            samples.vx.velocities.block(block).iter().zip(samples.vy.velocities.block(block));
        for (vx, vy) in rows {
            for lane in 0..LANES {
                total[lane] += self.excess(vx[lane]) + max(vy[lane].abs() - self.vy_max, 0.0);
            }
        }
        total
    }

    fn total(&self, samples: &Samples, block: usize) -> Row {
        let mut total = ZEROS;
        let rows =
            samples.vx.velocities.block(block).iter().zip(samples.vy.velocities.block(block));
        for (vx, vy) in rows {
            for lane in 0..LANES {
                let speed = length(vx[lane], vy[lane]);
                total[lane] += self.excess(if vx[lane] > 0.0 { speed } else { -speed });
            }
        }
        total
    }

    fn steered(&self, samples: &Samples, block: usize, radius: f32) -> Row {
        let mut total = ZEROS;
        let rows =
            samples.vx.velocities.block(block).iter().zip(samples.wz.velocities.block(block));
        for (vx, wz) in rows {
            for lane in 0..LANES {
                let curve = vx[lane].abs() / max(wz[lane].abs(), MIN_TURN_RATE_RAD_PER_S);
                total[lane] += self.excess(vx[lane]) + max(radius - curve, 0.0);
            }
        }
        total
    }
}
