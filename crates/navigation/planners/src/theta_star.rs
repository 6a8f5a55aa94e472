//! Theta*: A* whose paths leave the grid wherever there is a line of sight.
//!
//! Source of the rules: `nav2_theta_star_planner/src/theta_star.cpp`, `theta_star_planner.cpp`. Two defects
//! are not kept: the path ends at the goal and not a cell before it, and the open list stays in order when
//! the cost of a queued node falls.

mod search;

use periplus_costmap::cost::{LETHAL, MAX_NON_OBSTACLE};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};
use periplus_params::{ParamValue, ParamValues};

use crate::obstruction::{Passable, explain};
use crate::parameters::{ChangeRules, ParameterStore};
use crate::poses::{approach_yaw_rad, single_pose};
use crate::tables::{THETA_STAR, ThetaStarParams};
use crate::{
    ParameterRejected, PlanError, PlanErrorKind, PlanRequest, PlannedPath, Planner, outside,
};

use search::{SearchEnd, ThetaStarSearch};

const RULES: ChangeRules = ChangeRules { fixed: &[], allows_zero: false, unlimited: &[] };

/// The Theta* planner.
#[derive(Debug)]
pub struct ThetaStarPlanner {
    store: ParameterStore,
    params: ThetaStarParams,
    search: ThetaStarSearch,
}

impl Default for ThetaStarPlanner {
    fn default() -> Self {
        Self::new(ParamValues::defaults(&THETA_STAR))
    }
}

impl ThetaStarPlanner {
    /// Creates a planner with values of [`crate::tables::THETA_STAR`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let params = ThetaStarParams::from_values(&values);
        let search = ThetaStarSearch::default();
        Self { store: ParameterStore::new(values, &RULES), params, search }
    }
}

/// Returns poses at the distance of the resolution along the lines between cells, and the goal.
fn interpolate(info: &GridInfo, corners: &[Cell], goal: Pose2) -> Vec<Pose2> {
    let mut poses = Vec::new();
    for pair in corners.windows(2) {
        let (from, to) = (info.centre_of(pair[0]), info.centre_of(pair[1]));
        let (dx_m, dy_m) = (to.0 - from.0, to.1 - from.1);
        let distance_m = libm::hypot(dx_m, dy_m);
        // The last full step is left out, as in Nav2: the next corner follows.
        let count = ((distance_m / info.resolution_m) as usize).max(1);
        for step in 0..count {
            let ratio = step as f64 * info.resolution_m / distance_m;
            poses.push(Pose2::new(from.0 + ratio * dx_m, from.1 + ratio * dy_m, 0.0));
        }
    }
    poses.push(goal);
    poses
}

impl Planner for ThetaStarPlanner {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let PlanRequest { costmap, start, goal, is_cancelled, .. } = request;
        let (map, info) = (costmap.costs, costmap.costs.info());
        let start_cell = outside::start_cell(info, start)?;
        let goal_cell = outside::goal_cell(info, goal)?;
        let passable = Passable { max_cost: MAX_NON_OBSTACLE, unknown: self.params.allow_unknown };
        let explanation = || explain(map, start_cell, goal, passable);
        if map.cost(goal_cell) == Some(LETHAL) {
            return Err(outside::occupied(PlanErrorKind::GoalOccupied, goal).with(explanation()));
        }
        let keeps_direction = self.params.use_final_approach_orientation;
        if start_cell == goal_cell {
            let pose = single_pose(start, goal, keeps_direction);
            return Ok(PlannedPath { poses: vec![pose], ..PlannedPath::default() });
        }
        let is_safe = |cell| map.cost(cell).is_some_and(|cost| passable.contains(cost));
        if !is_safe(start_cell) || !is_safe(goal_cell) {
            let message = "Either of the start or goal pose are an obstacle!";
            return Err(PlanError::new(PlanErrorKind::Unknown, message).with(explanation()));
        }
        let end = self.search.run(map, &self.params, start_cell, goal_cell, is_cancelled);
        let (corners, expansion_count) = match end {
            SearchEnd::Found(corners, expansion_count) => (corners, expansion_count),
            SearchEnd::Cancelled => return Err(PlanError::cancelled()),
            SearchEnd::Exhausted => {
                let message = "Could not generate path between the given poses";
                return Err(PlanError::new(PlanErrorKind::NoValidPath, message).with(explanation()));
            }
        };
        let mut poses = interpolate(info, &corners, goal);
        if keeps_direction {
            let yaw_rad = approach_yaw_rad(&poses);
            if let (Some(last), Some(yaw_rad)) = (poses.last_mut(), yaw_rad) {
                last.yaw_rad = yaw_rad;
            }
        }
        Ok(PlannedPath { poses, expansion_count, ..PlannedPath::default() })
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        if let ("how_many_corners", ParamValue::Integer(count)) = (name, value)
            && ![4, 8].contains(count)
        {
            let reason = "it must be 4 or 8".to_owned();
            return Err(ParameterRejected::Value("how_many_corners", reason));
        }
        self.store.change(name, value)?;
        self.params = ThetaStarParams::from_values(self.store.values());
        Ok(())
    }
}
