//! `CostCritic`: costs of the costmap along a trajectory.

use periplus_costmap::{Nav2Release, cost};

use super::{CriticContext, Evaluation, Weighting};
use crate::mppi::lanes::{LANES, ZEROS};
use crate::mppi::params::CostParams;
use crate::mppi::samples::Samples;

/// Mean cost of the points, with a high cost of collisions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CostCritic {
    weighting: Weighting,
    critical_cost: f32,
    near_collision_cost: f32,
    collision_cost: f32,
    near_goal_distance: f32,
    considers_footprint: bool,
    point_step: usize,
}

impl CostCritic {
    pub(crate) fn new(params: &CostParams) -> Self {
        Self {
            // Costs count as fractions of the highest.
            weighting: Weighting::new(&params.common, params.weight / f64::from(cost::LETHAL)),
            critical_cost: params.critical_cost as f32,
            near_collision_cost: params.near_collision_cost as f32,
            collision_cost: params.collision_cost as f32,
            near_goal_distance: params.near_goal_distance_m as f32,
            considers_footprint: params.considers_footprint,
            point_step: params.point_step,
        }
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
        let (step, points) = match context.release {
            Nav2Release::Humble => (1, samples.steps),
            Nav2Release::Main => {
                (self.point_step, samples.steps.saturating_sub(1) / self.point_step + 1)
            }
            _ => (self.point_step, samples.steps / self.point_step),
        };
        let near = if context.release == Nav2Release::Humble {
            f32::from(cost::INSCRIBED)
        } else {
            self.near_collision_cost
        };
        let is_near_goal = context.is_goal_within(self.near_goal_distance);
        let far_factor = if is_near_goal { 0.0 } else { 1.0 };
        let rule = CollisionRule::new(context, self.considers_footprint, true);
        let mut is_free_anywhere = false;
        for (block, costs) in evaluation.costs.iter_mut().enumerate() {
            let (x, y) = (samples.x.block(block), samples.y.block(block));
            let yaw = samples.yaw.block(block);
            let mut total = ZEROS;
            let mut collides = [false; LANES];
            for at in (0..samples.steps).step_by(step).take(points) {
                let cells = context.grid.costs(&x[at], &y[at]);
                let mut cell_costs = ZEROS;
                for lane in 0..LANES {
                    cell_costs[lane] = f32::from(cells[lane]);
                }
                for lane in 0..LANES {
                    let cost = cell_costs[lane];
                    let added = if cost >= near { self.critical_cost } else { cost * far_factor };
                    total[lane] += if cost < 1.0 { 0.0 } else { added };
                }
                if self.considers_footprint {
                    for lane in 0..LANES {
                        if cell_costs[lane] >= 1.0 && !collides[lane] {
                            let pose = [x[at][lane], y[at][lane], yaw[at][lane]];
                            collides[lane] = rule.collides(context, cells[lane], pose);
                        }
                    }
                } else {
                    for lane in 0..LANES {
                        collides[lane] |= cells[lane] >= rule.lowest && cells[lane] <= rule.highest;
                    }
                }
            }
            let measures = std::array::from_fn(|lane| {
                let cost = if collides[lane] { self.collision_cost } else { total[lane] };
                cost / points as f32
            });
            self.weighting.add(costs, &measures);
            is_free_anywhere |= collides[..samples.in_block(block)].contains(&false);
            merge(&mut evaluation.collisions[block], &collides);
        }
        evaluation.has_failed = !is_free_anywhere;
    }
}

/// Adds collisions to those of other critics.
pub(super) fn merge(collisions: &mut [bool; LANES], found: &[bool; LANES]) {
    for lane in 0..LANES {
        collisions[lane] |= found[lane];
    }
}

/// Rule that decides if a pose collides.
#[derive(Clone, Copy, Debug)]
pub(super) struct CollisionRule {
    /// Lowest cost that is a collision.
    pub(super) lowest: u8,
    /// Highest cost that is a collision.
    pub(super) highest: u8,
    /// Cost from which the outline is tested.
    pub(super) outline_from: f32,
}

impl CollisionRule {
    /// `needs_radius` demands on main that the inflation covers the robot.
    pub(super) fn new(
        context: &CriticContext<'_>,
        considers_footprint: bool,
        needs_radius: bool,
    ) -> Self {
        let needs_radius = needs_radius && context.release == Nav2Release::Main;
        Self {
            lowest: if considers_footprint { cost::LETHAL } else { cost::INSCRIBED },
            highest: if context.grid.tracks_unknown { cost::LETHAL } else { cost::UNKNOWN },
            outline_from: context.grid.circumscribed_cost(needs_radius),
        }
    }

    /// Returns true if the outline decides about a cell.
    pub(super) fn needs_outline(&self, cell: u8) -> bool {
        self.outline_from < 1.0 || f32::from(cell) >= self.outline_from
    }

    /// Returns true if a pose in a cell collides, by the outline where it may.
    fn collides(&self, context: &CriticContext<'_>, cell: u8, [x, y, yaw]: [f32; 3]) -> bool {
        let cost =
            if self.needs_outline(cell) { context.grid.footprint_cost(x, y, yaw) } else { cell };
        cost >= self.lowest && cost <= self.highest
    }
}
