//! Cost functions of DWAPlannerROS.
//!
//! Source: `obstacle_cost_function.cpp`, `map_grid_cost_function.cpp` of `base_local_planner`.

use periplus_costmap::{Footprint, cost};
use periplus_geometry::Pose2;

use super::DwaPlannerParams;
use super::wavefront::{WavefrontDistances, dense_plan_cells};
use crate::collision::blocking_cell;
use crate::dwb::SampledTrajectory;
use crate::dwb::critics::{CriticInput, IllegalTrajectory, MapGridTarget, TrajectoryCritic};
use crate::path::distance_m;

/// Highest cost of the footprint along a trajectory; the footprint grows with the speed.
#[derive(Clone, Debug)]
pub(super) struct FootprintCost {
    pub params: DwaPlannerParams,
}

impl FootprintCost {
    fn footprint(&self, footprint: &Footprint, speed_m_s: f64) -> Option<Footprint> {
        let from_m_s = self.params.scaling_speed_m_s;
        let range_m_s = self.params.max_vel_trans_m_s - from_m_s;
        if speed_m_s <= from_m_s || range_m_s <= 0.0 {
            return None;
        }
        let part = (speed_m_s - from_m_s) / range_m_s;
        let scaling = 1.0 + self.params.max_scaling_factor * part;
        let points = footprint.points().iter().map(|[x_m, y_m]| [x_m * scaling, y_m * scaling]);
        Some(Footprint::new(points.collect()))
    }
}

/// Returns the cost of the footprint and of the centre of a robot.
///
/// # Errors
/// If the robot would touch an obstacle, or leave the known part of the costmap.
pub(super) fn pose_cost(
    view: &periplus_costmap::CostmapView<'_>,
    pose: Pose2,
) -> Result<u8, IllegalTrajectory> {
    let Some(centre) = view.costs.cost_at(pose.x_m, pose.y_m) else {
        return Err(IllegalTrajectory::off_grid("Trajectory Goes Off Grid.", pose));
    };
    let outline = view.footprint.cost(view.costs, pose);
    if outline < cost::LETHAL {
        return Ok(outline.max(centre));
    }
    let reason = match outline {
        cost::UNKNOWN => "Trajectory Hits Unknown Region.",
        _ => "Trajectory Hits Obstacle.",
    };
    match blocking_cell(view, pose, |cost| cost >= cost::LETHAL) {
        Some(blocked) if blocked.cell.is_none() => {
            Err(IllegalTrajectory::at("Footprint Goes Off Grid.", blocked))
        }
        Some(blocked) => Err(IllegalTrajectory::at(reason, blocked)),
        None => Err(IllegalTrajectory::new(reason)),
    }
}

impl TrajectoryCritic for FootprintCost {
    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.occdist_scale
    }

    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let speed_m_s = trajectory.velocity.speed_m_s();
        let grown = self.footprint(input.costmap.footprint, speed_m_s);
        let mut view = input.costmap;
        if let Some(grown) = &grown {
            view.footprint = grown;
        }
        let mut total = 0.0_f64;
        for pose in &trajectory.poses {
            let cost = f64::from(pose_cost(&view, *pose)?);
            total = if self.params.sum_scores { total + cost } else { total.max(cost) };
        }
        Ok(total)
    }

    fn cell_scores(&self, input: &CriticInput<'_>) -> Option<Vec<f32>> {
        Some(input.costmap.costs.costs().iter().map(|cost| f32::from(*cost)).collect())
    }
}

/// Distance on the grid to the plan or its end, around obstacles.
#[derive(Clone, Debug)]
pub(super) struct PlanDistance {
    params: DwaPlannerParams,
    target: MapGridTarget,
    distances: WavefrontDistances,
    is_active: bool,
}

impl PlanDistance {
    pub(super) fn new(params: &DwaPlannerParams, target: MapGridTarget) -> Self {
        let distances = WavefrontDistances::default();
        Self { params: params.clone(), target, distances, is_active: true }
    }

    fn is_ahead(&self) -> bool {
        matches!(self.target, MapGridTarget::PathAhead | MapGridTarget::GoalAhead)
    }
}

impl TrajectoryCritic for PlanDistance {
    fn prepare(&mut self, input: &CriticInput<'_>) -> bool {
        let costs = input.costmap.costs;
        let mut plan = input.plan.to_vec();
        let Some(end) = plan.last_mut() else { return false };
        let ahead_m = self.params.forward_point_distance_m;
        match self.target {
            MapGridTarget::PathAhead => {
                let away_m = distance_m(input.pose, *end);
                self.is_active = away_m * away_m > ahead_m * ahead_m * self.params.cheat_factor;
            }
            MapGridTarget::GoalAhead => {
                let angle_rad = libm::atan2(end.y_m - input.pose.y_m, end.x_m - input.pose.x_m);
                let (sine, cosine) = libm::sincos(angle_rad);
                end.x_m += ahead_m * cosine;
                end.y_m += ahead_m * sine;
            }
            MapGridTarget::Path | MapGridTarget::Goal => {}
        }
        let mut targets = dense_plan_cells(costs, &plan);
        if matches!(self.target, MapGridTarget::Goal | MapGridTarget::GoalAhead) {
            targets = targets.split_off(targets.len().saturating_sub(1));
        }
        self.distances = WavefrontDistances::new(costs, &targets, |_| false);
        !targets.is_empty()
    }

    fn scale(&self, input: &CriticInput<'_>) -> f64 {
        if !self.is_active {
            return 0.0;
        }
        let bias = match self.target {
            MapGridTarget::Path | MapGridTarget::PathAhead => self.params.path_distance_bias,
            MapGridTarget::Goal | MapGridTarget::GoalAhead => self.params.goal_distance_bias,
        };
        input.costmap.costs.resolution_m() * bias
    }

    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let finder = input.costmap.costs.finder();
        let ahead_m = if self.is_ahead() { self.params.forward_point_distance_m } else { 0.0 };
        let mut last = 0;
        for pose in &trajectory.poses {
            let (sine, cosine) = libm::sincos(pose.yaw_rad);
            let (x_m, y_m) = (pose.x_m + ahead_m * cosine, pose.y_m + ahead_m * sine);
            let Some(cell) = finder.cell_of(x_m, y_m) else {
                let point = Pose2::new(x_m, y_m, pose.yaw_rad);
                return Err(IllegalTrajectory::off_grid("Trajectory Goes Off Grid.", point));
            };
            last = if self.is_ahead() {
                self.distances.distance(cell)
            } else {
                self.distances.reachable(cell)?
            };
        }
        Ok(f64::from(last))
    }

    fn cell_scores(&self, _input: &CriticInput<'_>) -> Option<Vec<f32>> {
        if self.is_ahead() {
            return None;
        }
        Some(self.distances.distances().iter().map(|distance| *distance as f32).collect())
    }
}
