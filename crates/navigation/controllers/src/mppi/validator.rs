//! Test of the optimal trajectory (main).
//!
//! Source: `nav2_mppi_controller` `optimal_trajectory_validator.hpp`.

use periplus_costmap::cost;

use super::cost_grid::CostGrid;
use super::params::ValidatorParams;

/// Settings of the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ValidatorSettings {
    /// Number of steps that must be free.
    pub(crate) steps: usize,
    /// Tests the outline of the robot instead of its centre.
    pub(crate) considers_footprint: bool,
}

impl ValidatorSettings {
    pub(crate) fn new(params: &ValidatorParams, step_s: f32) -> Self {
        Self {
            steps: (params.collision_lookahead_s as f32 / step_s) as usize,
            considers_footprint: params.considers_footprint,
        }
    }

    /// Index of the first pose in an obstacle.
    pub(crate) fn find_collision(&self, trajectory: &[[f32; 3]], grid: &CostGrid) -> Option<usize> {
        trajectory.iter().take(self.steps).position(|[x, y, yaw]| {
            if self.considers_footprint {
                grid.footprint_cost(*x, *y, *yaw) == cost::LETHAL
            } else {
                matches!(grid.find(*x, *y), Some(cost::INSCRIBED | cost::LETHAL))
            }
        })
    }
}
