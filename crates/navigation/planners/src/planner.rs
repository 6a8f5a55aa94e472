//! Interface of all planners.

use std::fmt;

use periplus_costmap::CostmapView;
use periplus_geometry::Pose2;
use periplus_grid::Cell;
use periplus_params::{ParamValue, ParamValues};

use crate::{ParameterRejected, PlanError};

/// Inputs of one plan. Start and goal are poses of the base in the frame of the costmap.
pub struct PlanRequest<'a> {
    /// Global costmap with the footprint of the robot.
    pub costmap: CostmapView<'a>,
    /// Pose of the robot.
    pub start: Pose2,
    /// Pose to reach.
    pub goal: Pose2,
    /// Returns true when the client cancelled the goal. A planner calls it about every 5000 expansions.
    pub is_cancelled: &'a mut dyn FnMut() -> bool,
    /// Returns true when [`Planner::max_planning_time_s`] has passed. Planners read no clock: the caller
    /// decides, and in lockstep the time of a plan is never over.
    pub is_out_of_time: &'a mut dyn FnMut() -> bool,
}

impl fmt::Debug for PlanRequest<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PlanRequest")
            .field("start", &self.start)
            .field("goal", &self.goal)
            .finish_non_exhaustive()
    }
}

/// A path from start to goal, and facts about its search.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlannedPath {
    /// Poses in the frame of the costmap, from the start to the goal or to the nearest pose within the
    /// tolerance. NavFn and Theta* leave the yaw of all but the last at 0, as Nav2 does.
    pub poses: Vec<Pose2>,
    /// Cell that Nav2 sets free in the costmap itself before it plans; the caller may do the same.
    pub cleared_cell: Option<Cell>,
    /// Path before smoothing, from the start to the goal; empty for planners that do not smooth.
    pub unsmoothed: Vec<Pose2>,
    /// Number of cells or nodes that the search expanded.
    pub expansion_count: usize,
}

impl PlannedPath {
    /// Returns the length of the path \[m\].
    #[must_use]
    pub fn length_m(&self) -> f64 {
        let steps = self.poses.windows(2);
        steps.map(|pair| libm::hypot(pair[1].x_m - pair[0].x_m, pair[1].y_m - pair[0].y_m)).sum()
    }
}

/// A global planner: finds a path on a costmap. It keeps buffers from one plan to the next, but its result
/// depends on the request and the parameters only.
pub trait Planner: Send {
    /// Returns a path from start to goal.
    ///
    /// # Errors
    /// The reason why there is none, with the error code of Nav2.
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError>;

    /// Changes a parameter between two plans. The name is the one in the planner's table, without the id
    /// of the plugin.
    ///
    /// # Errors
    /// When there is no such parameter, or Nav2 rejects the change. The planner is unchanged then.
    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected>;

    /// Returns the parameters with their values, which the server declares; none for planners of Nav2, whose table
    /// is known by their class.
    fn parameters(&self) -> Option<&ParamValues> {
        None
    }

    /// Returns the maximum duration of one plan \[s\]; none without a limit.
    fn max_planning_time_s(&self) -> Option<f64> {
        None
    }
}
