//! Global planners of ROS 1.
//!
//! Source: `navfn_ros.cpp`, `planner_core.cpp`, `orientation_filter.cpp` (Noetic).

use std::f64::consts::{FRAC_PI_2, PI};

use periplus_costmap::CostmapView;
use periplus_diagnostics::{Diagnostics, closest};
use periplus_geometry::{Pose2, normalize_angle};
use periplus_params::{ParamValue, ParamValues, Table, params};
use periplus_planners::tables::NAVFN;
use periplus_planners::{NavFnPlanner, PlanError, PlanRequest, PlannedPath, Planner};

use super::cell_costs::{converted_costmap, grid_path};
use super::values::{PrivateParameters, reading};

params! {
    /// The global planner NavfnROS.
    #[table(NAVFN_ROS, "NavfnROS")]
    pub struct NavfnRosParams {
        /// Maximum distance of the end of the path from a goal that cannot be reached.
        #[param("default_tolerance", unit("m"), min(0.0))]
        default_tolerance_m: f64 = 0,
        /// Plans through unknown cells.
        #[param("allow_unknown")]
        allow_unknown: bool = true,
        /// Unused; the potentials are not published.
        #[param("visualize_potential")]
        _: bool = false,
        /// Unused, also in ROS.
        #[param("planner_window_x", unit("m"))]
        _: f64 = 0,
        /// Unused, also in ROS.
        #[param("planner_window_y", unit("m"))]
        _: f64 = 0,
    }
}

params! {
    /// The global planner GlobalPlanner.
    #[table(GLOBAL_PLANNER, "GlobalPlanner")]
    pub struct GlobalPlannerParams {
        /// Maximum distance of the end of the path from a goal that cannot be reached.
        #[param("default_tolerance", unit("m"), min(0.0))]
        default_tolerance_m: f64 = 0,
        /// Plans through unknown cells.
        #[param("allow_unknown")]
        allow_unknown: bool = true,
        /// Searches in all directions (Dijkstra) instead of towards the goal (A*).
        #[param("use_dijkstra")]
        use_dijkstra: bool = true,
        /// Headings on the path: 0 none, 1 forward, 2 from that of the start to that of the goal, 3 forward and then
        /// towards that of the goal, 4 backward, 5 leftward, 6 rightward.
        #[param("orientation_mode", within(0.0, 6.0))]
        orientation_mode: i64 = 0,
        /// Number of poses before and behind between which a direction is measured.
        #[param("orientation_window_size", within(1.0, 255.0))]
        orientation_window_size: usize = 1,
        /// Cost from which a cell, or one less, is an obstacle.
        #[param("lethal_cost", within(1.0, 255.0))]
        lethal_cost: i64 = 253,
        /// Cost of a free cell.
        #[param("neutral_cost", within(1.0, 255.0))]
        neutral_cost: i64 = 50,
        /// Factor of the costs of the costmap.
        #[param("cost_factor", within(0.01, 5.0))]
        cost_factor: f64 = 3,
        /// Leads the path from cell to cell instead of down the gradient.
        #[param("use_grid_path")]
        use_grid_path: bool = false,
        /// Unused; the potential is always computed by the quadratic formula.
        #[param("use_quadratic")]
        _: bool = true,
        /// Unused; a cell is at its lower left corner, as in NavFn.
        #[param("old_navfn_behavior")]
        _: bool = false,
        /// Unused; the outermost cells are never on a path.
        #[param("outline_map")]
        _: bool = true,
        /// Unused; the potentials are not published.
        #[param("publish_potential")]
        _: bool = true,
        /// Unused; the potentials are not published.
        #[param("publish_scale")]
        _: i64 = 100,
        /// Unused; the potentials are not published.
        #[param("visualize_potential")]
        _: bool = false,
        /// Unused, also in ROS.
        #[param("planner_window_x", unit("m"))]
        _: f64 = 0,
        /// Unused, also in ROS.
        #[param("planner_window_y", unit("m"))]
        _: f64 = 0,
    }
}

/// Class of a global planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PlannerClass {
    Navfn,
    Global,
}

const CLASSES: [(&str, PlannerClass); 2] = [
    ("navfn/NavfnROS", PlannerClass::Navfn),
    ("global_planner/GlobalPlanner", PlannerClass::Global),
];

impl PlannerClass {
    fn table(self) -> &'static Table {
        match self {
            Self::Navfn => &NAVFN_ROS,
            Self::Global => &GLOBAL_PLANNER,
        }
    }
}

/// A global planner with its parameters.
pub(super) struct GlobalPlanner {
    /// Name of the class, by which its parameters and topics are named.
    pub(super) name: String,
    class: PlannerClass,
    pub(super) values: ParamValues,
    planner: NavFnPlanner,
}

/// Returns the last part of the name of a class.
pub(super) fn short_name(class: &str) -> &str {
    class.trim().rsplit(['/', ':']).next().unwrap_or(class)
}

impl GlobalPlanner {
    /// Creates the planner of a class from the parameters of its node.
    ///
    /// # Errors
    /// A sentence with the known classes.
    pub(super) fn new(
        class: &str,
        node: &PrivateParameters,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, String> {
        let written = class.trim().replace("::", "/");
        let Some((_, class)) = CLASSES.iter().find(|(name, _)| *name == written) else {
            let near = closest(&written, CLASSES.iter().map(|(name, _)| *name));
            let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
            return Err(format!(
                "`base_global_planner` is `{class}`, which is not supported; known are `navfn/NavfnROS` and \
                 `global_planner/GlobalPlanner`{near}"
            ));
        };
        let name = short_name(&written).to_owned();
        let given = node.group(&name);
        let values = reading(diagnostics, |found| class.table().check(given.given(), None, found));
        let planner = navfn(*class, &values);
        Ok(Self { name, class: *class, values, planner })
    }

    /// Changes a parameter.
    pub(super) fn set(&mut self, name: &str, value: ParamValue) {
        self.values.set(name, value);
        self.planner = navfn(self.class, &self.values);
    }

    /// Returns a path from start to goal, in the frame of the costmap.
    pub(super) fn plan(
        &mut self,
        costmap: CostmapView<'_>,
        start: Pose2,
        goal: Pose2,
    ) -> Result<PlannedPath, PlanError> {
        let (is_cancelled, is_out_of_time) = (&mut || false, &mut || false);
        if self.class == PlannerClass::Navfn {
            let request = PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time };
            return self.planner.plan(request);
        }
        let params = GlobalPlannerParams::from_values(&self.values);
        let costs = converted_costmap(costmap.costs, &params);
        let costmap = CostmapView { costs: &costs, ..costmap };
        let request = PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time };
        let mut planned = self.planner.plan(request)?;
        if params.use_grid_path
            && let Some(end) = planned.poses.last()
            && let Some(poses) = grid_path(self.planner.potentials(), costs.info(), *end)
        {
            planned.poses = poses;
        }
        if let Some(first) = planned.poses.first_mut() {
            first.yaw_rad = start.yaw_rad;
        }
        orient(&mut planned.poses, &params);
        Ok(planned)
    }
}

fn navfn(class: PlannerClass, values: &ParamValues) -> NavFnPlanner {
    let (tolerance_m, allows_unknown, uses_astar) = match class {
        PlannerClass::Navfn => {
            let params = NavfnRosParams::from_values(values);
            (params.default_tolerance_m, params.allow_unknown, false)
        }
        PlannerClass::Global => {
            let params = GlobalPlannerParams::from_values(values);
            (params.default_tolerance_m, params.allow_unknown, !params.use_dijkstra)
        }
    };
    let mut own = ParamValues::defaults(&NAVFN);
    own.set("tolerance", ParamValue::Number(tolerance_m));
    own.set("allow_unknown", ParamValue::Bool(allows_unknown));
    own.set("use_astar", ParamValue::Bool(uses_astar));
    NavFnPlanner::new(own)
}

/// Maximum difference of direction within the last straight part of a path \[rad\]; the value of ROS.
const STRAIGHT_RAD: f64 = 0.35;

/// Sets the headings of a path before its end, which has the heading of the goal.
fn orient(poses: &mut [Pose2], params: &GlobalPlannerParams) {
    let Some((last, before_last)) = poses.split_last().map(|(last, rest)| (*last, rest.len()))
    else {
        return;
    };
    let (positions, window) = (poses.to_vec(), params.orientation_window_size);
    let direction = |index: usize| {
        let before = positions[index.saturating_sub(window)];
        let behind = positions[index.saturating_add(window).min(before_last)];
        libm::atan2(behind.y_m - before.y_m, behind.x_m - before.x_m)
    };
    let interpolated = |index: usize, (first, from_rad): (usize, f64)| {
        let part = (index - first) as f64 / (before_last - first) as f64;
        from_rad + part * normalize_angle(last.yaw_rad - from_rad)
    };
    let end = straight_end(before_last, &direction);
    for (index, pose) in poses.iter_mut().enumerate().take(before_last) {
        let yaw_rad = match params.orientation_mode {
            1 => direction(index),
            2 => interpolated(index, (0, positions[0].yaw_rad)),
            3 if index >= end => interpolated(index, (end, direction(end))),
            3 => direction(index),
            4 => direction(index) + PI,
            5 => direction(index) - FRAC_PI_2,
            6 => direction(index) + FRAC_PI_2,
            _ => return,
        };
        pose.yaw_rad = normalize_angle(yaw_rad);
    }
}

/// Index of the first pose of the last straight part of a path.
fn straight_end(before_last: usize, direction: &impl Fn(usize) -> f64) -> usize {
    let mut first = before_last.saturating_sub(2);
    let last_rad = direction(first);
    while first > 0 && normalize_angle(direction(first - 1) - last_rad).abs() <= STRAIGHT_RAD {
        first -= 1;
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(orientation_mode: i64, expected: [f64; 5]) {
        // Two metres east, then two north, to a goal that looks west.
        let mut poses = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0)]
            .map(|(x_m, y_m)| Pose2::new(x_m, y_m, 0.0));
        poses[4].yaw_rad = PI;
        orient(&mut poses, &GlobalPlannerParams { orientation_mode, ..Default::default() });
        for (pose, expected) in poses.iter().zip(expected) {
            let away_rad = normalize_angle(pose.yaw_rad - expected).abs();
            assert!(away_rad < 1e-12, "{orientation_mode}: {poses:?}");
        }
    }

    #[test]
    fn headings_by_the_mode() {
        const EIGHTH: f64 = std::f64::consts::FRAC_PI_4;
        check(0, [0.0, 0.0, 0.0, 0.0, PI]);
        check(1, [0.0, 0.0, EIGHTH, 2.0 * EIGHTH, PI]);
        check(2, [0.0, EIGHTH, 2.0 * EIGHTH, 3.0 * EIGHTH, PI]);
        check(3, [0.0, 0.0, EIGHTH, 2.5 * EIGHTH, PI]);
        check(4, [PI, PI, 5.0 * EIGHTH, 6.0 * EIGHTH, PI]);
        check(6, [2.0 * EIGHTH, 2.0 * EIGHTH, 3.0 * EIGHTH, 4.0 * EIGHTH, PI]);
    }

    #[test]
    fn an_unknown_class_is_an_error_with_the_nearest() {
        let node = PrivateParameters::default();
        let why = GlobalPlanner::new("navfn/NavFnROS", &node, &mut Diagnostics::new()).err();
        assert!(why.is_some_and(|why| why.contains("did you mean `navfn/NavfnROS`")));
    }
}
