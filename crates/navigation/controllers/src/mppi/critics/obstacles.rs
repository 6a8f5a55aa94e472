//! `ObstaclesCritic`: distance to obstacles, by the law of the inflation.

use periplus_costmap::{InflationLaw, Nav2Release};

use super::cost::{CollisionRule, merge};
use super::{CriticContext, Evaluation, Weighting};
use crate::mppi::lanes::{LANES, ZEROS, min, power};
use crate::mppi::params::ObstaclesParams;
use crate::mppi::samples::Samples;

/// Repulsion from obstacles, a margin around them, and a high cost of collisions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ObstaclesCritic {
    weighting: Weighting,
    repulsion_weight: f32,
    collision_cost: f32,
    margin: f32,
    near_goal_distance: f32,
    considers_footprint: bool,
    /// Inflation as the parameters of Humble give it.
    given_law: InflationLaw,
}

/// Costs of a point by the cost of its cell.
struct PointTable {
    /// Penetration of the margin \[m\].
    margin: [f32; 256],
    /// Repulsion \[m\].
    repulsion: [f32; 256],
}

impl ObstaclesCritic {
    pub(crate) fn new(params: &ObstaclesParams) -> Self {
        Self {
            weighting: Weighting::new(&params.common, params.critical_weight),
            repulsion_weight: params.repulsion_weight as f32,
            collision_cost: params.collision_cost as f32,
            margin: params.margin_m as f32,
            near_goal_distance: params.near_goal_distance_m as f32,
            considers_footprint: params.considers_footprint,
            given_law: InflationLaw {
                radius_m: params.inflation_radius_m,
                scaling_per_m: params.scaling_per_m,
            },
        }
    }

    /// Table of a cell's costs. The cost of the centre includes the inscribed radius, that of the outline
    /// does not.
    fn table(&self, context: &CriticContext<'_>, is_outline: bool) -> PointTable {
        let mut table = PointTable { margin: [0.0; 256], repulsion: [0.0; 256] };
        let given = context.release == Nav2Release::Humble;
        let law = context.grid.inflation.map(|law| if given { self.given_law } else { law });
        let Some(law) = law.filter(|law| law.radius_m != 0.0 && law.scaling_per_m != 0.0) else {
            return table;
        };
        let is_near_goal = context.is_goal_within(self.near_goal_distance);
        let inscribed_m = if is_outline { context.grid.inscribed_m } else { 0.0 };
        for cost in 1..256 {
            let decay = (libm::log(253.0) - libm::log(cost as f64)) / law.scaling_per_m;
            let distance = (decay + inscribed_m) as f32;
            let is_within = distance < self.margin;
            if is_within {
                table.margin[cost] = self.margin - distance;
            }
            let is_covered_by_margin = given && is_within;
            if !(is_near_goal || is_covered_by_margin) {
                table.repulsion[cost] = law.radius_m as f32 - distance;
            }
        }
        table
    }

    pub(crate) fn score(
        &self,
        context: &CriticContext<'_>,
        samples: &Samples,
        evaluation: &mut Evaluation,
    ) {
        if !self.weighting.is_enabled {
            return;
        }
        let rule = CollisionRule::new(context, self.considers_footprint, false);
        let (centre, outline) = (self.table(context, false), self.table(context, true));
        let mut measures = Vec::with_capacity(samples.blocks());
        let mut is_free_anywhere = false;
        let mut lowest = f32::INFINITY;
        for block in 0..samples.blocks() {
            let (x, y) = (samples.x.block(block), samples.y.block(block));
            let yaw = samples.yaw.block(block);
            let (mut margin, mut repulsion) = (ZEROS, ZEROS);
            let mut collides = [false; LANES];
            for at in 0..samples.steps {
                let cells = context.grid.costs(&x[at], &y[at]);
                for lane in 0..LANES {
                    if collides[lane] {
                        continue;
                    }
                    let (mut cell, mut table) = (cells[lane], &centre);
                    // Humble and later: a cell outside the costmap has no outline.
                    let is_inside = cell != periplus_costmap::cost::UNKNOWN
                        || context.grid.find(x[at][lane], y[at][lane]).is_some();
                    if self.considers_footprint && is_inside && rule.needs_outline(cell) {
                        cell = context.grid.footprint_cost(x[at][lane], y[at][lane], yaw[at][lane]);
                        table = &outline;
                    }
                    if cell >= rule.lowest && cell <= rule.highest {
                        collides[lane] = true;
                    } else {
                        margin[lane] += table.margin[usize::from(cell)];
                        repulsion[lane] += table.repulsion[usize::from(cell)];
                    }
                }
            }
            for lane in 0..samples.in_block(block) {
                is_free_anywhere |= !collides[lane];
                lowest = min(lowest, repulsion[lane]);
            }
            for lane in 0..LANES {
                if collides[lane] {
                    margin[lane] = self.collision_cost;
                }
            }
            merge(&mut evaluation.collisions[block], &collides);
            measures.push((margin, repulsion));
        }
        if context.release == Nav2Release::Humble {
            lowest = 0.0;
        }
        let scale = self.repulsion_weight / samples.steps.max(1) as f32;
        for (costs, (margin, repulsion)) in evaluation.costs.iter_mut().zip(&measures) {
            for lane in 0..LANES {
                let critical = self.weighting.weight * margin[lane];
                let cost = critical + scale * (repulsion[lane] - lowest);
                costs[lane] += power(cost, self.weighting.power);
            }
        }
        evaluation.has_failed = !is_free_anywhere;
    }
}
