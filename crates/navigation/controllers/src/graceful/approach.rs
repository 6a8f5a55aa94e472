//! Search for a safe approach to the goal (main).
//!
//! Source: `findBestApproachTrajectory` of `graceful_controller.cpp`.

use std::f64::consts::PI;

use periplus_costmap::cost;
use periplus_geometry::Pose2;

use super::simulation::Simulation;
use super::{Approach, Graceful};
use crate::path::distance_m;

/// Speed that durations assume at least \[m/s\].
const MIN_SPEED_M_S: f64 = 1e-3;

/// Maximum number of headings that are tried.
const MAX_HEADING_COUNT: usize = 10_000;

impl Graceful {
    /// Returns an approach, or if it passes nearer to obstacles than `obstacle_cost_margin` allows, the fastest one with
    /// another final heading that does not.
    pub(super) fn safest_approach(
        &mut self,
        simulation: &Simulation<'_>,
        found: Approach,
    ) -> Approach {
        let max_cost =
            if simulation.view.is_circular { cost::MAX_NON_OBSTACLE } else { cost::INSCRIBED };
        let margin = self.params.obstacle_cost_margin;
        if i64::from(simulation.max_cost(&found.motion.poses)) < i64::from(max_cost) - margin {
            return found;
        }
        let step_rad = self.params.final_rotation_search_step_rad;
        if step_rad <= 0.0 {
            return found;
        }
        let count = (libm::ceil(2.0 * PI / step_rad) as usize).min(MAX_HEADING_COUNT);
        let known_rad = self.safe_approach_rad;
        let mut best = found;
        let mut best_s = f64::INFINITY;
        for index in 0..count {
            // The heading of the last cycle comes first, so that the robot does not waver.
            let yaw_rad = known_rad.unwrap_or(0.0) + index as f64 * step_rad;
            let target = Pose2 { yaw_rad, ..best.target };
            let Ok(candidate) = self.try_target(simulation, target) else { continue };
            let duration_s = self.duration_s(&candidate);
            if duration_s >= best_s {
                continue;
            }
            best_s = duration_s;
            if simulation.max_cost(&candidate.motion.poses) >= max_cost {
                continue;
            }
            best = candidate;
            if known_rad == Some(yaw_rad) {
                break;
            }
            self.safe_approach_rad = Some(yaw_rad);
        }
        best
    }

    /// Duration of a simulated motion at the speeds of the control law \[s\].
    fn duration_s(&self, approach: &Approach) -> f64 {
        let target = approach.target;
        let is_backward = self.params.allow_backward && target.x_m < 0.0;
        let law = self.law(self.max_speed_m_s);
        let step_s = |pair: &[Pose2]| {
            let speed_m_s = law.velocity(target, pair[0], is_backward).vx_m_s.abs();
            distance_m(pair[0], pair[1]) / speed_m_s.max(MIN_SPEED_M_S)
        };
        approach.motion.poses.windows(2).map(step_s).sum()
    }
}
