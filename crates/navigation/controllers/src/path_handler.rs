//! Path handler: the part of the plan that a controller follows in a cycle.
//!
//! In main one plugin does it for all controllers (`feasible_path_handler.cpp`); before, each controller does it
//! itself by its own parameters: [`PathRules`].

use periplus_costmap::Nav2Release;
use periplus_geometry::{Pose2, normalize_angle};
use periplus_grid::GridInfo;
use periplus_params::{ParamValue, ParamValues, params};

use crate::ControlError;
use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::{distance_m, first_beyond, first_constraint, nearest_index, plan_length_m};

params! {
    /// A path handler.
    #[table(FEASIBLE_PATH_HANDLER, "a feasible path handler")]
    pub struct FeasiblePathParams {
        /// Length of the plan from the robot on that controllers get.
        #[param("prune_distance", unit("m"))]
        prune_distance_m: f64 = 2,
        /// Length of the plan in which the pose nearest to the robot is searched; negative for the whole plan
        /// (default: half of the longer side of the costmap).
        #[param("max_robot_pose_search_dist", unit("m"))]
        max_robot_pose_search_dist_m: Option<f64>,
        /// Ends the plan at a cusp until the robot has reached it.
        #[param("enforce_path_inversion")]
        enforce_path_inversion: bool = false,
        /// Ends the plan at a rotation in place until the robot has reached it.
        #[param("enforce_path_rotation")]
        enforce_path_rotation: bool = false,
        /// Distance to a cusp at which it is reached.
        #[param("inversion_xy_tolerance", unit("m"))]
        inversion_xy_tolerance_m: f64 = 0.2,
        /// Difference to the heading of a cusp at which it is reached.
        #[param("inversion_yaw_tolerance", unit("rad"))]
        inversion_yaw_tolerance_rad: f64 = 0.4,
        /// Minimum angle of a rotation in place.
        #[param("minimum_rotation_angle", unit("rad"))]
        minimum_rotation_angle_rad: f64 = 0.785,
        /// Refuses plans with one pose.
        #[param("reject_unit_path")]
        reject_unit_path: bool = false,
        /// Unused; the caller passes the transform.
        #[param("transform_tolerance", unit("s"))]
        _: f64 = 0.1,
    }
}

/// Rules by which the local part of a plan is selected.
#[derive(Clone, Debug, PartialEq)]
pub enum PathRules {
    /// Main's path handler, and MPPI's own one before.
    Feasible {
        /// Parameters.
        params: FeasiblePathParams,
        /// Keeps at least two poses of a plan (main).
        keeps_two_poses: bool,
    },
    /// RegulatedPurePursuit and Graceful before main: up to half of the longer side of the costmap from the robot.
    WithinCostmap {
        /// Length of the plan in which the nearest pose is searched \[m\]; none for half of the longer side of the
        /// costmap, negative for the whole plan.
        max_search_m: Option<f64>,
        /// Refuses plans with one pose (`interpolate_curvature_after_goal`).
        rejects_single_pose: bool,
        /// Keeps at least two poses of a plan (Jazzy).
        keeps_two_poses: bool,
    },
    /// DWB before main.
    Dwb {
        /// Distance behind the robot up to which poses are kept \[m\].
        prune_distance_m: f64,
        /// Distance ahead of the robot up to which poses are used \[m\].
        forward_prune_distance_m: f64,
        /// Removes poses that were passed.
        prunes: bool,
        /// Limits the plan to the forward distance.
        shortens: bool,
    },
    /// The local planners of ROS 1: up to half of the longer side of the costmap from the robot.
    MoveBase {
        /// Removes poses that are farther than 1 m behind the robot.
        prunes: bool,
    },
}

/// Distance to the robot at which the local planners of ROS 1 keep poses that were passed \[m\]; `prunePlan` of
/// `goal_functions.cpp`.
const MOVE_BASE_PRUNE_M: f64 = 1.0;

impl Default for PathRules {
    /// Main's path handler with its defaults.
    fn default() -> Self {
        Self::Feasible { params: FeasiblePathParams::default(), keeps_two_poses: true }
    }
}

/// Selection of the local part of a plan, which passes over the plan with the robot.
///
/// ```
/// use periplus_controllers::{PathHandler, PathRules};
/// use periplus_geometry::Pose2;
/// use periplus_grid::GridInfo;
///
/// let mut handler = PathHandler::new(PathRules::default());
/// handler.set_plan((0..100).map(|i| Pose2::new(0.1 * f64::from(i), 0.0, 0.0)).collect());
/// // A costmap of 3 m around the robot, in the frame of the plan.
/// let costmap = GridInfo::new(0.05, 60, 60, Pose2::new(-0.48, -1.5, 0.0))?;
/// let robot = Pose2::new(1.02, 0.1, 0.0);
/// let plan = handler.local_plan(robot, Pose2::IDENTITY, &costmap)?;
/// assert_eq!(plan[0].x_m, 1.0);
/// assert!((plan[plan.len() - 1].x_m - 2.5).abs() < 1e-9, "the border of the costmap");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PathHandler {
    rules: PathRules,
    /// Values of [`FEASIBLE_PATH_HANDLER`] of a handler that is a plugin itself.
    values: Option<ParamValues>,
    plan: Vec<Pose2>,
    /// First pose that was not passed.
    begin: usize,
    /// End of the poses up to the next constraint.
    end: usize,
}

impl PathHandler {
    /// Creates a handler without a plan.
    #[must_use]
    pub fn new(rules: PathRules) -> Self {
        Self { rules, values: None, plan: Vec::new(), begin: 0, end: 0 }
    }

    /// Creates main's plugin from values of [`FEASIBLE_PATH_HANDLER`].
    #[must_use]
    pub fn from_values(values: ParamValues, release: Nav2Release) -> Self {
        let params = FeasiblePathParams::from_values(&values);
        let rules = PathRules::Feasible { params, keeps_two_poses: release == Nav2Release::Main };
        Self { values: Some(values), ..Self::new(rules) }
    }

    /// Replaces the rules, as after a change of a controller's parameters.
    pub fn set_rules(&mut self, rules: PathRules) {
        self.rules = rules;
    }

    /// Returns the parameters of a plugin; none for a handler with the rules of a controller.
    #[must_use]
    pub fn parameters(&self) -> Option<&ParamValues> {
        self.values.as_ref()
    }

    /// Changes a parameter of a plugin.
    ///
    /// # Errors
    /// When the name is unknown, or the value has another type or is negative.
    pub fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        let Some(values) = &mut self.values else {
            return Err(ParameterRefusal::Unknown(name.to_owned()));
        };
        let rules = ChangeRules { fixed: &["reject_unit_path"], signed: &[] };
        let change = change(values, rules, name, value)?;
        if let PathRules::Feasible { params, .. } = &mut self.rules {
            *params = FeasiblePathParams::from_values(values);
        }
        Ok(change)
    }

    /// Sets a new plan, in its own frame.
    pub fn set_plan(&mut self, plan: Vec<Pose2>) {
        self.plan = plan;
        self.begin = 0;
        self.find_end();
    }

    /// Returns the poses that were not passed, in the frame of the plan.
    #[must_use]
    pub fn remaining(&self) -> &[Pose2] {
        &self.plan[self.begin..]
    }

    /// Returns the length of the rest of the plan \[m\].
    #[must_use]
    pub fn remaining_length_m(&self) -> f64 {
        plan_length_m(self.remaining())
    }

    /// Returns the last pose of the plan, in its frame.
    #[must_use]
    pub fn goal(&self) -> Option<Pose2> {
        self.plan.last().copied()
    }

    /// Returns the part of the plan ahead of the robot within the costmap, in the frame of the costmap. Poses
    /// that were passed are removed.
    ///
    /// # Errors
    /// [`ControlError::InvalidPath`] if there are no such poses.
    pub fn local_plan(
        &mut self,
        costmap_from_base: Pose2,
        costmap_from_plan: Pose2,
        costmap: &GridInfo,
    ) -> Result<Vec<Pose2>, ControlError> {
        let robot = costmap_from_plan.inverse() * costmap_from_base;
        let segment = &self.plan[self.begin..self.end];
        if segment.is_empty() {
            return Err(ControlError::InvalidPath("Received plan with zero length".to_owned()));
        }
        if segment.len() == 1 && self.rules.rejects_single_pose() {
            return Err(ControlError::InvalidPath("Received plan with length of one".to_owned()));
        }
        let (first, last) = self.rules.range(segment, robot, costmap);
        let local = segment[first..last].iter().map(|pose| costmap_from_plan * *pose);
        let stops_at_border = matches!(self.rules, PathRules::Feasible { .. });
        let is_inside = |pose: &Pose2| costmap.cell_of(pose.x_m, pose.y_m).is_some();
        let local: Vec<Pose2> =
            local.take_while(|pose| !stops_at_border || is_inside(pose)).collect();
        let nearest = segment.get(first).copied();
        if self.rules.prunes() {
            self.begin += first;
        }
        self.pass_constraint(robot);
        if local.is_empty() {
            return Err(empty_plan(
                nearest.map(|pose| costmap_from_plan * pose),
                costmap_from_base,
            ));
        }
        Ok(local)
    }

    /// Finds the end of the poses up to the next constraint.
    fn find_end(&mut self) {
        let rest = &self.plan[self.begin..];
        let constraint = match &self.rules {
            PathRules::Feasible { params, .. } => {
                let min_rotation_rad =
                    params.enforce_path_rotation.then_some(params.minimum_rotation_angle_rad);
                first_constraint(rest, params.enforce_path_inversion, min_rotation_rad)
            }
            _ => None,
        };
        self.end = self.begin + constraint.unwrap_or(rest.len());
    }

    /// Goes on behind the constraint once the robot has reached it.
    fn pass_constraint(&mut self, robot: Pose2) {
        let PathRules::Feasible { params, .. } = &self.rules else { return };
        if self.end >= self.plan.len() {
            return;
        }
        let Some(last) = self.plan[self.begin..self.end].last() else { return };
        let off_rad = normalize_angle(last.yaw_rad - robot.yaw_rad).abs();
        if distance_m(robot, *last) <= params.inversion_xy_tolerance_m
            && off_rad <= params.inversion_yaw_tolerance_rad
        {
            self.begin = self.end;
            self.find_end();
        }
    }
}

impl PathRules {
    fn rejects_single_pose(&self) -> bool {
        match self {
            Self::Feasible { params, .. } => params.reject_unit_path,
            Self::WithinCostmap { rejects_single_pose, .. } => *rejects_single_pose,
            Self::Dwb { .. } | Self::MoveBase { .. } => false,
        }
    }

    fn prunes(&self) -> bool {
        !matches!(self, Self::Dwb { prunes: false, .. } | Self::MoveBase { prunes: false })
    }

    /// Returns first and end index of the local part of a plan; `robot` is in the frame of the plan.
    fn range(&self, plan: &[Pose2], robot: Pose2, costmap: &GridInfo) -> (usize, usize) {
        let (width_m, height_m) = costmap.size_m();
        let extent_m = width_m.max(height_m) / 2.0;
        let search_end = |max_search_m: Option<f64>| match max_search_m.unwrap_or(extent_m) {
            ..0.0 => plan.len(),
            length_m => first_beyond(plan, length_m),
        };
        let first_farther = |from: usize, than_m: f64| {
            let far = plan[from..].iter().position(|pose| distance_m(*pose, robot) > than_m);
            far.map_or(plan.len(), |index| from + index)
        };
        match self {
            Self::Feasible { params, keeps_two_poses } => {
                let end = search_end(params.max_robot_pose_search_dist_m);
                let mut first = nearest_index(&plan[..end], robot);
                if *keeps_two_poses && first + 1 == plan.len() {
                    first = first.saturating_sub(1);
                }
                (first, first + first_beyond(&plan[first..], params.prune_distance_m))
            }
            Self::WithinCostmap { max_search_m, keeps_two_poses, .. } => {
                let end = search_end(*max_search_m);
                let mut first = nearest_index(&plan[..end], robot);
                if *keeps_two_poses && first + 1 == end {
                    first = first.saturating_sub(1);
                }
                (first, first_farther(first, extent_m))
            }
            Self::Dwb { prune_distance_m, forward_prune_distance_m, prunes, shortens } => {
                let limit_m = |is_on: bool, length_m: f64| {
                    if is_on { extent_m.min(length_m) } else { extent_m }
                };
                let behind_m = limit_m(*prunes, *prune_distance_m);
                let end = first_beyond(plan, *forward_prune_distance_m);
                let near = plan[..end].iter().position(|pose| distance_m(*pose, robot) < behind_m);
                let first = near.unwrap_or(end);
                (first, first_farther(first, limit_m(*shortens, *forward_prune_distance_m)))
            }
            Self::MoveBase { prunes } => {
                let first_nearer = |from: usize, to: usize, than_m: f64| {
                    let near = plan[from..to].iter().position(|it| distance_m(*it, robot) < than_m);
                    near.map_or(to, |index| from + index)
                };
                let first = first_nearer(0, plan.len(), extent_m);
                // The first pose beyond is the last one.
                let end = (first_farther(first, extent_m) + 1).min(plan.len());
                let kept =
                    if *prunes { first_nearer(first, end, MOVE_BASE_PRUNE_M) } else { first };
                (kept, end)
            }
        }
    }
}

fn empty_plan(nearest: Option<Pose2>, robot: Pose2) -> ControlError {
    let mut text = "Resulting plan has 0 poses in it.".to_owned();
    if let Some(nearest) = nearest {
        text += &format!(
            " The pose of the plan nearest to the robot, ({:.2}, {:.2}) m, is {:.2} m away from it and outside of \
             the local costmap; plan again from the pose of the robot, or enlarge the costmap",
            nearest.x_m,
            nearest.y_m,
            distance_m(nearest, robot)
        );
    }
    ControlError::InvalidPath(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(count: u32) -> Vec<Pose2> {
        (0..count).map(|index| Pose2::new(0.5 * f64::from(index), 0.0, 0.0)).collect()
    }

    fn costmap_around(x_m: f64) -> GridInfo {
        GridInfo::new(0.1, 60, 60, Pose2::new(x_m - 3.0, -3.0, 0.0)).unwrap()
    }

    /// Returns the first and last x of the local plan.
    fn local(handler: &mut PathHandler, x_m: f64) -> (f64, f64) {
        let robot = Pose2::new(x_m, 0.0, 0.0);
        let plan = handler.local_plan(robot, Pose2::IDENTITY, &costmap_around(x_m)).unwrap();
        (plan[0].x_m, plan[plan.len() - 1].x_m)
    }

    #[test]
    fn passed_poses_never_come_back() {
        let mut handler = PathHandler::new(PathRules::default());
        handler.set_plan(straight(21));
        assert_eq!(local(&mut handler, 0.0), (0.0, 2.0));
        assert_eq!(local(&mut handler, 1.1), (1.0, 3.0));
        assert_eq!(
            local(&mut handler, 0.0),
            (1.0, 2.5),
            "after the robot went back; the border is at 3 m"
        );
        assert_eq!(handler.remaining_length_m(), 9.0);
        handler.set_plan(straight(4));
        assert_eq!(local(&mut handler, 1.5), (1.0, 1.5), "two poses are kept");
    }

    #[test]
    fn the_plan_is_transformed_to_the_frame_of_the_costmap() {
        let mut handler = PathHandler::new(PathRules::default());
        handler.set_plan(straight(3));
        let costmap_from_plan = Pose2::new(1.0, 1.0, std::f64::consts::FRAC_PI_2);
        let robot = Pose2::new(1.0, 1.5, 0.0);
        let plan = handler.local_plan(robot, costmap_from_plan, &costmap_around(1.0)).unwrap();
        assert!((plan[0].x_m - 1.0).abs() < 1e-12 && (plan[0].y_m - 1.5).abs() < 1e-12);
    }

    #[test]
    fn a_plan_outside_of_the_costmap_is_an_error() {
        let mut handler = PathHandler::new(PathRules::default());
        let plan = |handler: &mut PathHandler| {
            handler.local_plan(Pose2::IDENTITY, Pose2::IDENTITY, &costmap_around(0.0))
        };
        let error = plan(&mut handler).unwrap_err();
        assert_eq!(error.to_string(), "Received plan with zero length");
        handler.set_plan(vec![Pose2::new(9.0, 0.0, 0.0)]);
        let error = plan(&mut handler).unwrap_err().to_string();
        assert!(error.starts_with("Resulting plan has 0 poses in it."), "{error}");
        assert!(error.contains("(9.00, 0.00) m, is 9.00 m away"), "{error}");
    }

    #[test]
    fn a_cusp_ends_the_plan_until_it_is_reached() {
        let params = FeasiblePathParams { enforce_path_inversion: true, ..Default::default() };
        let rules = PathRules::Feasible { params, keeps_two_poses: true };
        let mut handler = PathHandler::new(rules);
        let mut plan = straight(5);
        plan.extend(straight(4).into_iter().rev().map(|pose| Pose2 { y_m: 0.1, ..pose }));
        handler.set_plan(plan);
        assert_eq!(local(&mut handler, 1.0), (1.0, 2.0));
        assert_eq!(local(&mut handler, 1.9), (1.5, 2.0));
        assert_eq!(local(&mut handler, 1.9), (1.5, 0.0), "behind the cusp");
    }

    #[test]
    fn rules_of_older_releases() {
        let rules = PathRules::WithinCostmap {
            max_search_m: Some(0.7),
            rejects_single_pose: false,
            keeps_two_poses: false,
        };
        let mut handler = PathHandler::new(rules);
        handler.set_plan(straight(21));
        assert_eq!(local(&mut handler, 2.0), (0.5, 5.0), "searched up to 0.7 m only");
        let rules = PathRules::Dwb {
            prune_distance_m: 1.2,
            forward_prune_distance_m: 2.0,
            prunes: true,
            shortens: true,
        };
        let mut handler = PathHandler::new(rules);
        handler.set_plan(straight(21));
        assert_eq!(local(&mut handler, 2.0), (1.0, 4.0), "1.2 m behind to 2 m ahead");
    }
}
