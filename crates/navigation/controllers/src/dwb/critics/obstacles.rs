//! BaseObstacle and ObstacleFootprint: costs along trajectories.
//!
//! Source: `base_obstacle.cpp`, `obstacle_footprint.cpp`.

use periplus_costmap::cost;
use periplus_geometry::Pose2;
use periplus_params::ParamValues;

use super::{CriticInput, IllegalTrajectory, TrajectoryCritic};
use crate::BlockedCell;
use crate::collision::blocking_cell;
use crate::dwb::SampledTrajectory;
use crate::dwb::params::ObstacleCriticParams;

/// Adds the scores of poses, or takes the last one.
fn combine(
    trajectory: &SampledTrajectory,
    sums: bool,
    pose_cost: impl Fn(Pose2) -> Result<u8, IllegalTrajectory>,
) -> Result<f64, IllegalTrajectory> {
    let mut total = 0.0;
    for pose in &trajectory.poses {
        let cost = f64::from(pose_cost(*pose)?);
        total = if sums { total + cost } else { cost };
    }
    Ok(total)
}

/// Costs of all cells, for display.
fn cell_costs(input: &CriticInput<'_>) -> Option<Vec<f32>> {
    Some(input.costmap.costs.costs().iter().map(|cost| f32::from(*cost)).collect())
}

/// Critic with the cost at the centre of the robot.
#[derive(Clone, Debug)]
pub struct BaseObstacleCritic {
    params: ObstacleCriticParams,
}

impl BaseObstacleCritic {
    /// Creates the critic from values of [`crate::dwb::OBSTACLE_CRITIC`].
    #[must_use]
    pub fn new(values: &ParamValues) -> Self {
        Self { params: ObstacleCriticParams::from_values(values) }
    }
}

impl TrajectoryCritic for BaseObstacleCritic {
    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.critic.scale
    }

    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let costs = input.costmap.costs;
        let finder = costs.finder();
        combine(trajectory, self.params.sum_scores, |pose| {
            let Some(cell) = finder.cell_of(pose.x_m, pose.y_m) else {
                return Err(IllegalTrajectory::off_grid("Trajectory Goes Off Grid.", pose));
            };
            match costs.cost(cell).unwrap_or(cost::UNKNOWN) {
                cost @ (cost::LETHAL | cost::INSCRIBED | cost::UNKNOWN) => {
                    let position_m = costs.info().centre_of(cell);
                    let blocked = BlockedCell { pose, cell: Some(cell), position_m, cost };
                    Err(IllegalTrajectory::at("Trajectory Hits Obstacle.", blocked))
                }
                cost => Ok(cost),
            }
        })
    }

    fn cell_scores(&self, input: &CriticInput<'_>) -> Option<Vec<f32>> {
        cell_costs(input)
    }
}

/// Critic with the highest cost along the outline of the footprint.
#[derive(Clone, Debug)]
pub struct ObstacleFootprintCritic {
    params: ObstacleCriticParams,
}

impl ObstacleFootprintCritic {
    /// Creates the critic from values of [`crate::dwb::OBSTACLE_CRITIC`].
    #[must_use]
    pub fn new(values: &ParamValues) -> Self {
        Self { params: ObstacleCriticParams::from_values(values) }
    }
}

impl TrajectoryCritic for ObstacleFootprintCritic {
    fn prepare(&mut self, input: &CriticInput<'_>) -> bool {
        !input.costmap.footprint.points().is_empty()
    }

    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.critic.scale
    }

    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let view = &input.costmap;
        combine(trajectory, self.params.sum_scores, |pose| {
            if view.costs.info().cell_of(pose.x_m, pose.y_m).is_none() {
                return Err(IllegalTrajectory::off_grid("Trajectory Goes Off Grid.", pose));
            }
            let cost = view.footprint.cost(view.costs, pose);
            if cost < cost::LETHAL {
                return Ok(cost);
            }
            match blocking_cell(view, pose, |cost| cost >= cost::LETHAL) {
                Some(blocked) if blocked.cell.is_none() => {
                    Err(IllegalTrajectory::at("Footprint Goes Off Grid.", blocked))
                }
                Some(blocked) if blocked.cost == cost::UNKNOWN => {
                    Err(IllegalTrajectory::at("Trajectory Hits Unknown Region.", blocked))
                }
                Some(blocked) => Err(IllegalTrajectory::at("Trajectory Hits Obstacle.", blocked)),
                None => Err(IllegalTrajectory::new("Footprint Goes Off Grid.")),
            }
        })
    }

    fn cell_scores(&self, input: &CriticInput<'_>) -> Option<Vec<f32>> {
        cell_costs(input)
    }
}
