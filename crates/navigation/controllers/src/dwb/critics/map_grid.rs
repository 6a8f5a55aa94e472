//! PathDist, GoalDist, PathAlign and GoalAlign: distances on the grid to the plan and to its end.
//!
//! Source: `path_dist.cpp`, `goal_dist.cpp`, `path_align.cpp`, `goal_align.cpp`, `map_grid.cpp`.

use periplus_geometry::Pose2;
use periplus_params::ParamValues;

use super::grid::{densified, plan_cells};
use super::{CellDistances, CriticInput, IllegalTrajectory, TrajectoryCritic};
use crate::dwb::SampledTrajectory;
use crate::dwb::params::{MapGridCriticParams, ScoreAggregation};
use crate::path::distance_m;

/// Cells to which distances are measured, and the point that is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapGridTarget {
    /// The plan, from the robot (PathDist).
    Path,
    /// The end of the plan, from the robot (GoalDist).
    Goal,
    /// The plan, from a point ahead of the robot (PathAlign).
    PathAhead,
    /// A point ahead of the end of the plan, from a point ahead of the robot (GoalAlign).
    GoalAhead,
}

/// Factor on the scale, besides the resolution; the value of Nav2.
const SCALE_RATIO: f64 = 0.5;

/// Critic with distances on the grid.
#[derive(Clone, Debug)]
pub struct MapGridCritic {
    params: MapGridCriticParams,
    target: MapGridTarget,
    distances: CellDistances,
    /// False near the goal, where PathAlign has no effect.
    is_active: bool,
}

impl MapGridCritic {
    /// Creates the critic from values of [`crate::dwb::MAP_GRID_CRITIC`].
    #[must_use]
    pub fn new(values: &ParamValues, target: MapGridTarget) -> Self {
        let params = MapGridCriticParams::from_values(values);
        Self { params, target, distances: CellDistances::default(), is_active: true }
    }

    /// Distance of the point that is measured ahead of the robot \[m\].
    fn ahead_m(&self) -> f64 {
        match self.target {
            MapGridTarget::Path | MapGridTarget::Goal => 0.0,
            _ => self.params.forward_point_distance_m,
        }
    }

    /// True if trajectories that leave the distances are illegal.
    fn is_strict(&self) -> bool {
        matches!(self.target, MapGridTarget::Path | MapGridTarget::Goal)
    }

    fn pose_score(&self, input: &CriticInput<'_>, pose: Pose2) -> Result<f64, IllegalTrajectory> {
        let ahead_m = self.ahead_m();
        let point = if ahead_m == 0.0 {
            pose
        } else {
            let (sine, cosine) = libm::sincos(pose.yaw_rad);
            Pose2::new(pose.x_m + ahead_m * cosine, pose.y_m + ahead_m * sine, pose.yaw_rad)
        };
        let Some(cell) = input.costmap.costs.info().cell_of(point.x_m, point.y_m) else {
            return Err(IllegalTrajectory::off_grid("Trajectory Goes Off Grid.", point));
        };
        let distance = self.distances.distance(cell);
        if self.is_strict() && self.distances.is_unreached(distance) {
            return Err(IllegalTrajectory::new("Trajectory Hits Unreachable Area."));
        }
        Ok(f64::from(distance))
    }
}

impl TrajectoryCritic for MapGridCritic {
    fn prepare(&mut self, input: &CriticInput<'_>) -> bool {
        let costs = input.costmap.costs;
        let mut plan = input.plan.to_vec();
        match self.target {
            MapGridTarget::PathAhead => {
                self.is_active =
                    distance_m(input.pose, input.goal) > self.params.forward_point_distance_m;
                if !self.is_active {
                    return true;
                }
            }
            MapGridTarget::GoalAhead => {
                let (dx_m, dy_m) =
                    (input.goal.x_m - input.pose.x_m, input.goal.y_m - input.pose.y_m);
                let (sine, cosine) = libm::sincos(libm::atan2(dy_m, dx_m));
                if let Some(last) = plan.last_mut() {
                    last.x_m += self.params.forward_point_distance_m * cosine;
                    last.y_m += self.params.forward_point_distance_m * sine;
                }
            }
            MapGridTarget::Path | MapGridTarget::Goal => {}
        }
        let mut targets = plan_cells(costs, &densified(&plan, costs.resolution_m()));
        if matches!(self.target, MapGridTarget::Goal | MapGridTarget::GoalAhead) {
            targets = targets.split_off(targets.len().saturating_sub(1));
        }
        let info = costs.info();
        self.distances = CellDistances::new(info.width, info.height, &targets);
        !targets.is_empty()
    }

    fn scale(&self, input: &CriticInput<'_>) -> f64 {
        if !self.is_active {
            return 0.0;
        }
        input.costmap.costs.resolution_m() * SCALE_RATIO * self.params.critic.scale
    }

    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let aggregation = self.params.aggregation;
        let poses = match aggregation {
            ScoreAggregation::Last if !self.is_strict() => {
                &trajectory.poses[trajectory.poses.len().saturating_sub(1)..]
            }
            _ => &trajectory.poses,
        };
        let mut total = if aggregation == ScoreAggregation::Product { 1.0 } else { 0.0 };
        for pose in poses {
            let score = self.pose_score(input, *pose)?;
            total = match aggregation {
                ScoreAggregation::Last => score,
                ScoreAggregation::Sum => total + score,
                ScoreAggregation::Product if total > 0.0 => total * score,
                ScoreAggregation::Product => total,
            };
        }
        Ok(total)
    }

    fn cell_scores(&self, _input: &CriticInput<'_>) -> Option<Vec<f32>> {
        Some(self.distances.distances().iter().map(|distance| *distance as f32).collect())
    }
}
