//! Graceful: a smooth control law to the farthest pose of the plan that can be reached without a collision.
//!
//! Source: `nav2_graceful_controller`. In Humble the target is the first pose at a fixed distance.

mod approach;
mod law;
mod params;
mod simulation;

use std::f64::consts::PI;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_params::{ParamValue, ParamValues};

pub use law::{EgoPolar, SmoothControlLaw};
pub use params::{GRACEFUL, GracefulParams};
use simulation::{SimulatedMotion, Simulation};

use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::{distance_m, plan_length_m};
use crate::rpp::{LookaheadRule, lookahead_point};
use crate::{
    BlockedCell, ControlError, ControlInput, ControlReport, Controller, ParameterGroup, PathRules,
    PluginSetup,
};

/// Difference of headings below which a plan has no headings \[rad\]; `validateOrientations`.
const EQUAL_HEADING_RAD: f64 = 1e-6;

/// Intermediate results of a cycle, which the server publishes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GracefulReport {
    /// Target in the base frame (topic `motion_target`, and with `slowdown_radius` the marker `slowdown`).
    pub motion_target: Option<Pose2>,
    /// Simulated motion in the base frame (topic `local_plan`).
    pub local_plan: Vec<Pose2>,
    /// Cell with which the motion to the first target collides.
    pub blocked: Option<BlockedCell>,
}

/// The controller Graceful.
#[derive(Clone, Debug)]
pub struct Graceful {
    release: Nav2Release,
    values: ParamValues,
    params: GracefulParams,
    /// Maximum speed with the speed limit \[m/s\].
    max_speed_m_s: f64,
    max_rate_rad_s: f64,
    was_at_goal: bool,
    needs_initial_rotation: bool,
    /// Heading of the last safe approach to the goal \[rad\].
    safe_approach_rad: Option<f64>,
    report: GracefulReport,
}

/// A target with its distance along the plan.
#[derive(Clone, Copy, Debug)]
struct Target {
    pose: Pose2,
    along_m: f64,
}

/// Motion to a target.
struct Approach {
    target: Pose2,
    motion: SimulatedMotion,
}

/// Creates the controller from parameters of [`GRACEFUL`].
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let values = setup.read(&GRACEFUL, diagnostics);
    Some(Box::new(Graceful::new(values, setup.release)))
}

impl Graceful {
    /// Creates the controller from values of [`GRACEFUL`].
    #[must_use]
    pub fn new(mut values: ParamValues, release: Nav2Release) -> Self {
        params::set_release_defaults(&mut values, release);
        let params = GracefulParams::from_values(&values).effective(release);
        Self {
            release,
            values,
            max_speed_m_s: params.v_linear_max_m_s,
            max_rate_rad_s: params.v_angular_max_rad_s,
            params,
            was_at_goal: false,
            needs_initial_rotation: true,
            safe_approach_rad: None,
            report: GracefulReport::default(),
        }
    }

    fn law(&self, max_speed_m_s: f64) -> SmoothControlLaw {
        SmoothControlLaw::new(&self.params, max_speed_m_s, self.max_rate_rad_s)
    }

    /// Returns true if the robot is at the position of the goal. Before main Nav2 compares the rest of the plan only,
    /// which may be shorter than the distance of the robot: it then rotates and never arrives. Here both must be short.
    fn is_at_goal(&mut self, input: &ControlInput<'_>, rest_m: f64) -> bool {
        if self.release == Nav2Release::Main {
            return input.is_position_reached;
        }
        let away_m = distance_m(input.pose, input.goal);
        self.was_at_goal |=
            input.tolerance.xy_m.is_some_and(|tolerance_m| rest_m.max(away_m) < tolerance_m);
        self.was_at_goal
    }

    /// Returns the rotation in place to the heading of the goal, unless it collides.
    fn final_rotation(&self, simulation: &Simulation<'_>, angle_rad: f64) -> Option<Twist2> {
        let count = angle_rad.abs() / self.params.in_place_collision_resolution_rad;
        let count = (count as usize).clamp(1, 1000);
        let is_free = (1..=count).all(|index| {
            let yaw_rad = index as f64 / count as f64 * angle_rad;
            simulation.collision(Pose2::new(0.0, 0.0, yaw_rad), 1.0).is_none()
        });
        is_free.then(|| simulation.rotation(angle_rad))
    }

    /// Returns the targets in the order in which they are tried.
    fn targets(&self, plan_in_base: &[Pose2]) -> Vec<Target> {
        let mut along_m = plan_in_base.first().map_or(0.0, |pose| libm::hypot(pose.x_m, pose.y_m));
        let mut targets = Vec::with_capacity(plan_in_base.len());
        for (index, pose) in plan_in_base.iter().enumerate() {
            if index > 0 {
                along_m += distance_m(plan_in_base[index - 1], *pose);
            }
            targets.push(Target { pose: *pose, along_m });
        }
        targets.reverse();
        let max_m = self.params.max_lookahead_m;
        if self.release == Nav2Release::Main
            && let Some(pose) =
                lookahead_point(LookaheadRule::AlongPath, plan_in_base, max_m, true, false)
            && let Some(first) = targets.first_mut()
        {
            *first = Target { pose, along_m: max_m.min(plan_length_m(plan_in_base)) };
        }
        targets
    }

    /// Simulates the motion to a target, in main at reduced speeds if the grown footprint collides.
    fn try_target(
        &mut self,
        simulation: &Simulation<'_>,
        target: Pose2,
    ) -> Result<Approach, BlockedCell> {
        let is_backward = self.params.allow_backward && target.x_m < 0.0;
        let reversal_rad = if is_backward { PI } else { 0.0 };
        let target = Pose2 { yaw_rad: target.yaw_rad + reversal_rad, ..target };
        let angle_rad = libm::atan2(target.y_m, target.x_m);
        self.needs_initial_rotation &=
            angle_rad.abs() >= self.params.initial_rotation_tolerance_rad;
        let rotates_first = self.needs_initial_rotation && self.params.initial_rotation;
        let mut speed_m_s = self.max_speed_m_s;
        loop {
            let law = self.law(speed_m_s);
            match simulation.run(&law, target, rotates_first, is_backward) {
                Ok(motion) => return Ok(Approach { target, motion }),
                Err(blocked) => {
                    speed_m_s -= self.params.footprint_scaling_step_m_s;
                    let is_last = self.params.footprint_scaling_step_m_s <= 0.0
                        || speed_m_s < self.params.footprint_scaling_linear_vel_m_s;
                    if is_last {
                        return Err(blocked);
                    }
                }
            }
        }
    }

    /// Returns the motion to the first target that is reached without a collision.
    fn follow(
        &mut self,
        simulation: &Simulation<'_>,
        plan_in_base: &[Pose2],
        rest_m: f64,
    ) -> Option<Approach> {
        let is_close = rest_m < self.params.max_lookahead_m;
        for target in self.targets(plan_in_base) {
            if target.along_m > self.params.max_lookahead_m {
                continue;
            }
            if self.release < Nav2Release::Main
                && !is_close
                && target.along_m < self.params.min_lookahead_m
            {
                break;
            }
            // Near the end of the plan its heading would cause a large curve.
            let ignores_heading = is_close && self.params.prefer_final_rotation;
            let sight_rad = libm::atan2(target.pose.y_m, target.pose.x_m);
            let yaw_rad = if ignores_heading { sight_rad } else { target.pose.yaw_rad };
            match self.try_target(simulation, Pose2 { yaw_rad, ..target.pose }) {
                Ok(found) if ignores_heading && self.release == Nav2Release::Main => {
                    return Some(self.safest_approach(simulation, found));
                }
                Ok(found) => return Some(found),
                Err(blocked) => {
                    self.report.blocked.get_or_insert(blocked);
                }
            }
        }
        None
    }

    /// Humble's rule: the law leads to the first pose at a fixed distance.
    fn follow_fixed_target(
        &mut self,
        input: &ControlInput<'_>,
        simulation: &Simulation<'_>,
        plan_in_base: &[Pose2],
        rest_m: f64,
    ) -> Result<Twist2, ControlError> {
        let [.., last] = *plan_in_base else { return Err(empty_plan()) };
        let is_far =
            |pose: &&Pose2| libm::hypot(pose.x_m, pose.y_m) >= self.params.motion_target_dist_m;
        let mut target = plan_in_base.iter().find(is_far).copied().unwrap_or(last);
        let angle_rad = libm::atan2(target.y_m, target.x_m);
        if self.params.final_rotation
            && rest_m < self.params.motion_target_dist_m
            && let [.., before, last] = *plan_in_base
        {
            target.yaw_rad = libm::atan2(last.y_m - before.y_m, last.x_m - before.x_m);
        }
        let is_backward = self.params.allow_backward && target.x_m < 0.0;
        target.yaw_rad += if is_backward { PI } else { 0.0 };
        let law = self.law(self.max_speed_m_s);
        let is_at_goal = self.is_at_goal(input, rest_m);
        let command = if self.params.final_rotation && is_at_goal {
            simulation.rotation(normalize_angle(last.yaw_rad))
        } else if self.params.initial_rotation
            && angle_rad.abs() > self.params.initial_rotation_min_angle_rad
        {
            simulation.rotation(angle_rad)
        } else {
            law.velocity(target, Pose2::IDENTITY, is_backward)
        };
        self.report.motion_target = Some(target);
        let start = simulation.collision(Pose2::IDENTITY, 1.0).map_or(Ok(()), Err);
        match start.and_then(|()| simulation.run(&law, target, false, is_backward)) {
            Ok(motion) => {
                self.report.local_plan = motion.poses;
                Ok(command)
            }
            Err(blocked) => {
                self.report.blocked = Some(blocked);
                Err(collision_error("Collision detected in the trajectory", Some(blocked)))
            }
        }
    }
}

fn empty_plan() -> ControlError {
    ControlError::InvalidPath("Resulting plan has 0 poses in it.".to_owned())
}

fn collision_error(text: &str, blocked: Option<BlockedCell>) -> ControlError {
    let reason = blocked.map(|blocked| format!(": {blocked}")).unwrap_or_default();
    ControlError::NoValidControl(format!("{text}{reason}"))
}

/// Points each pose of a plan to the next one, if all between the first and the last have the same heading.
fn add_headings(plan: &mut [Pose2]) {
    let [_, inner @ .., _] = &*plan else { return };
    let Some(first) = inner.first().copied() else { return };
    let is_turned =
        |pose: &Pose2| normalize_angle(first.yaw_rad - pose.yaw_rad).abs() > EQUAL_HEADING_RAD;
    if inner.iter().any(is_turned) {
        return;
    }
    for index in 1..plan.len() {
        let (dx_m, dy_m) =
            (plan[index].x_m - plan[index - 1].x_m, plan[index].y_m - plan[index - 1].y_m);
        plan[index - 1].yaw_rad = libm::atan2(dy_m, dx_m);
    }
}

impl Controller for Graceful {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        self.report = GracefulReport::default();
        let base_from_costmap = input.pose.inverse();
        let mut plan_in_base: Vec<Pose2> =
            input.plan.iter().map(|pose| base_from_costmap * *pose).collect();
        let Some(end) = plan_in_base.last().copied() else { return Err(empty_plan()) };
        let is_humble = self.release == Nav2Release::Humble;
        if !is_humble {
            add_headings(&mut plan_in_base);
        }
        let params = self.params.clone();
        let simulation = Simulation {
            params: &params,
            view: &input.costmap,
            costmap_from_base: input.pose,
            max_speed_m_s: self.max_speed_m_s,
            max_rate_rad_s: self.max_rate_rad_s,
            min_rate_rad_s: if is_humble { 0.0 } else { params.v_angular_min_in_place_rad_s },
        };
        let rest_m = plan_length_m(&plan_in_base);
        if is_humble {
            return self.follow_fixed_target(input, &simulation, &plan_in_base, rest_m);
        }
        if self.is_at_goal(input, rest_m)
            && let Some(rotation) = self.final_rotation(&simulation, normalize_angle(end.yaw_rad))
        {
            return Ok(rotation);
        }
        match self.follow(&simulation, &plan_in_base, rest_m) {
            Some(found) => {
                self.report.blocked = None;
                self.report.motion_target = Some(found.target);
                self.report.local_plan = found.motion.poses;
                Ok(found.motion.command)
            }
            None => Err(collision_error("Collision detected in trajectory", self.report.blocked)),
        }
    }

    fn set_plan(&mut self, _plan: &[Pose2]) {
        self.was_at_goal = false;
        self.needs_initial_rotation = true;
        self.safe_approach_rad = None;
    }

    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        let (full_m_s, full_rad_s) =
            (self.params.v_linear_max_m_s, self.params.v_angular_max_rad_s);
        let ratio = if limit == 0.0 {
            1.0
        } else if is_percentage {
            limit / 100.0
        } else {
            limit / full_m_s
        };
        self.max_speed_m_s = full_m_s * ratio;
        if limit != 0.0 {
            self.max_speed_m_s = self.max_speed_m_s.max(self.params.v_linear_min_m_s);
        }
        self.max_rate_rad_s = full_rad_s * ratio;
    }

    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        vec![ParameterGroup::own(&self.values)]
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        let other = match name {
            "allow_backward" => Some("initial_rotation"),
            "initial_rotation" => Some("allow_backward"),
            _ => None,
        };
        if let Some(other) = other
            && value == ParamValue::Bool(true)
            && self.values.flag(other) == Some(true)
        {
            return Err(ParameterRefusal::Conflict(format!(
                "`{name}` cannot be true while `{other}` is; set that to false first"
            )));
        }
        let change = change(&mut self.values, ChangeRules::NON_NEGATIVE, name, value)?;
        let params = GracefulParams::from_values(&self.values).effective(self.release);
        // New maxima end the speed limit, as in Nav2.
        if params.v_linear_max_m_s != self.params.v_linear_max_m_s
            || params.v_angular_max_rad_s != self.params.v_angular_max_rad_s
        {
            self.max_speed_m_s = params.v_linear_max_m_s;
            self.max_rate_rad_s = params.v_angular_max_rad_s;
        }
        self.params = params;
        Ok(change)
    }

    fn path_rules(&self) -> Option<PathRules> {
        (self.release < Nav2Release::Main).then_some(PathRules::WithinCostmap {
            max_search_m: self.params.max_robot_pose_search_dist_m,
            rejects_single_pose: false,
            keeps_two_poses: false,
        })
    }

    fn report(&self) -> ControlReport<'_> {
        ControlReport::Graceful(&self.report)
    }
}
