//! RegulatedPurePursuit: an arc to a point ahead on the plan, at a speed regulated by curvature, obstacles and goal.
//!
//! Source: `nav2_regulated_pure_pursuit_controller`; S. Macenski, S. Singh, F. Martin, J. Gines, "Regulated Pure Pursuit
//! for Robot Path Tracking", Autonomous Robots 47, 2023.

mod collision;
mod dynamic_window;
mod lookahead;
mod params;
mod regulation;

use std::f64::consts::PI;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_params::{ParamValue, ParamValues};

pub use collision::{CollisionHorizon, arc_collision};
pub use dynamic_window::dynamic_window_velocity;
pub use lookahead::{LookaheadRule, curvature_per_m, lookahead_distance_m, lookahead_point};
pub use params::{PurePursuitParams, REGULATED_PURE_PURSUIT};
pub use regulation::{
    Regulation, RegulationInput, RotationLimits, SpeedRule, limited_speed_m_s, regulate,
};

use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::{cusp_distance_m, plan_length_m};
use crate::{
    BlockedCell, ControlError, ControlInput, ControlReport, Controller, ParameterGroup, PathRules,
    PluginSetup,
};

/// Intermediate results of a cycle, which the server publishes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PurePursuitReport {
    /// Lookahead point in the base frame (topic `lookahead_point`).
    pub lookahead_point: Pose2,
    /// Lookahead point of the curvature in the base frame (topic `curvature_lookahead_point`).
    pub curvature_lookahead_point: Option<Pose2>,
    /// Poses of the collision check in the frame of the costmap (topic `lookahead_collision_arc`).
    pub collision_arc: Vec<Pose2>,
    /// True while the robot rotates in place (topic `is_rotating_to_heading`).
    pub is_rotating_to_heading: bool,
    /// Rule that decided about the speed; none while the robot rotates in place.
    pub speed_rule: Option<SpeedRule>,
    /// Cell for which the robot stops.
    pub blocked: Option<BlockedCell>,
}

/// Progress of the deceleration after a goal was cancelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cancellation {
    None,
    Decelerating,
    Stopped,
}

/// The controller RegulatedPurePursuit.
#[derive(Clone, Debug)]
pub struct RegulatedPurePursuit {
    release: Nav2Release,
    period_s: f64,
    values: ParamValues,
    params: PurePursuitParams,
    /// Maximum speed with the speed limit \[m/s\].
    max_speed_m_s: f64,
    last_command: Twist2,
    cancellation: Cancellation,
    was_at_goal: bool,
    report: PurePursuitReport,
}

/// Creates the controller from parameters of [`REGULATED_PURE_PURSUIT`].
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let values = setup.read(&REGULATED_PURE_PURSUIT, diagnostics);
    Some(Box::new(RegulatedPurePursuit::new(values, setup.release, setup.control_period_s)))
}

impl RegulatedPurePursuit {
    /// Creates the controller from values of [`REGULATED_PURE_PURSUIT`] for a period of the control loop \[s\].
    #[must_use]
    pub fn new(mut values: ParamValues, release: Nav2Release, period_s: f64) -> Self {
        params::set_release_defaults(&mut values, release);
        let params = PurePursuitParams::from_values(&values).effective(release);
        Self {
            release,
            period_s,
            values,
            max_speed_m_s: params.max_speed_m_s(),
            params,
            last_command: Twist2::ZERO,
            cancellation: Cancellation::None,
            was_at_goal: false,
            report: PurePursuitReport::default(),
        }
    }

    /// Returns the report of the last cycle.
    #[must_use]
    pub fn last_report(&self) -> &PurePursuitReport {
        &self.report
    }

    fn rule(&self) -> LookaheadRule {
        if self.release == Nav2Release::Main {
            LookaheadRule::AlongPath
        } else {
            LookaheadRule::Circle
        }
    }

    /// Returns the lookahead distances for the path and for the curvature \[m\].
    fn lookahead_m(&self, plan_in_base: &[Pose2], velocity: Twist2) -> (f64, f64) {
        let lookahead_m = lookahead_distance_m(&self.params, velocity);
        let curvature_m = self.params.curvature_lookahead_dist_m;
        // Main's path handler ends the plan at cusps instead.
        if self.release == Nav2Release::Main || !self.params.allow_reversing {
            return (lookahead_m, curvature_m);
        }
        let with_rotations = self.release > Nav2Release::Humble;
        let cusp_m = cusp_distance_m(plan_in_base, with_rotations).unwrap_or(f64::INFINITY);
        (lookahead_m.min(cusp_m), curvature_m.min(cusp_m))
    }

    /// Returns true if the robot is at the position of the goal, so that only its heading counts.
    fn is_at_goal(&mut self, input: &ControlInput<'_>, lookahead_point: Pose2) -> bool {
        if !self.params.use_rotate_to_heading {
            return false;
        }
        if self.release == Nav2Release::Main {
            return input.is_position_reached;
        }
        let away_m = libm::hypot(lookahead_point.x_m, lookahead_point.y_m);
        let is_near = input.tolerance.xy_m.is_some_and(|tolerance_m| away_m < tolerance_m);
        let remembers = self.release > Nav2Release::Humble && self.params.stateful;
        self.was_at_goal = is_near || remembers && self.was_at_goal;
        self.was_at_goal
    }

    /// Returns the angle to the path, if it is so large that the robot rotates in place first \[rad\].
    fn angle_to_path_rad(&self, point: Pose2, direction: f64) -> Option<f64> {
        let mut angle_rad = libm::atan2(point.y_m, point.x_m);
        if direction < 0.0 {
            angle_rad = normalize_angle(angle_rad + PI);
        }
        let is_large = angle_rad.abs() > self.params.rotate_to_heading_min_angle_rad;
        (self.params.use_rotate_to_heading && is_large).then_some(angle_rad)
    }

    fn rotation(&self, angle_rad: f64, velocity: Twist2) -> Twist2 {
        let limits = RotationLimits {
            rate_rad_s: self.params.rotate_to_heading_angular_vel_rad_s,
            acceleration_rad_s2: self.params.max_angular_accel_rad_s2,
            period_s: self.period_s,
        };
        Twist2::new(0.0, 0.0, limits.turn_rate_rad_s(angle_rad, velocity.wz_rad_s))
    }

    /// Returns the velocity along the arc with this curvature.
    fn tracking(
        &mut self,
        input: &ControlInput<'_>,
        plan_in_base: &[Pose2],
        curvature_per_m: f64,
        direction: f64,
    ) -> Result<Twist2, ControlError> {
        let Some(pose_cost) = input.costmap.costs.cost_at(input.pose.x_m, input.pose.y_m) else {
            return Err(ControlError::Unknown(format!(
                "RegulatedPurePursuitController: Dimensions of the costmap are too small to encapsulate the robot \
                 footprint at current speeds! The robot at ({:.2}, {:.2}) m is outside of the local costmap",
                input.pose.x_m, input.pose.y_m
            )));
        };
        let regulation = regulate(
            &self.params,
            &RegulationInput {
                speed_m_s: self.max_speed_m_s,
                max_speed_m_s: self.max_speed_m_s,
                curvature_per_m,
                pose_cost,
                inscribed_radius_m: input.costmap.footprint.inscribed_radius_m,
                plan_in_base,
                direction,
            },
        );
        self.report.speed_rule = Some(regulation.rule);
        let mut linear_m_s = regulation.linear_m_s;
        if self.cancellation != Cancellation::None {
            let step_m_s = direction * self.period_s * self.params.cancel_deceleration_m_s2;
            linear_m_s = input.velocity.vx_m_s - step_m_s;
            if linear_m_s * direction <= 0.0 {
                linear_m_s = 0.0;
                self.cancellation = Cancellation::Stopped;
            }
        }
        if self.params.use_dynamic_window {
            return Ok(dynamic_window_velocity(
                &self.params,
                self.max_speed_m_s,
                self.last_command,
                linear_m_s,
                curvature_per_m,
                direction,
                self.period_s,
            ));
        }
        Ok(Twist2::new(linear_m_s, 0.0, linear_m_s * curvature_per_m))
    }

    /// Checks the arc of a command for collisions.
    fn check_collision(
        &mut self,
        input: &ControlInput<'_>,
        command: Twist2,
        lookahead_point: Pose2,
        plan_length_m: f64,
    ) -> Result<(), ControlError> {
        if !self.params.use_collision_detection {
            return Ok(());
        }
        let lookahead_m = libm::hypot(lookahead_point.x_m, lookahead_point.y_m);
        let horizon = CollisionHorizon::new(&self.params, command, lookahead_m, plan_length_m);
        let arc = &mut self.report.collision_arc;
        let Some(collision) = arc_collision(&input.costmap, input.pose, command, horizon, arc)
        else {
            return Ok(());
        };
        self.report.blocked = Some(collision.blocked);
        Err(ControlError::NoValidControl(format!(
            "RegulatedPurePursuitController detected collision ahead! {collision}"
        )))
    }
}

impl Controller for RegulatedPurePursuit {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        let base_from_costmap = input.pose.inverse();
        let plan_in_base: Vec<Pose2> =
            input.plan.iter().map(|pose| base_from_costmap * *pose).collect();
        let (lookahead_m, curvature_lookahead_m) = self.lookahead_m(&plan_in_base, input.velocity);
        let (rule, interpolates) = (self.rule(), self.params.use_interpolation);
        let (Some(point), Some(end)) = (
            lookahead_point(rule, &plan_in_base, lookahead_m, interpolates, false),
            plan_in_base.last().copied(),
        ) else {
            return Err(ControlError::InvalidPath("Resulting plan has 0 poses in it.".to_owned()));
        };
        let curvature_point = if self.params.use_fixed_curvature_lookahead {
            let extends = self.params.interpolate_curvature_after_goal;
            lookahead_point(rule, &plan_in_base, curvature_lookahead_m, interpolates, extends)
        } else {
            None
        };
        self.report = PurePursuitReport {
            lookahead_point: point,
            curvature_lookahead_point: curvature_point,
            ..PurePursuitReport::default()
        };
        let curved_point = curvature_point.unwrap_or(point);
        let direction = if self.params.allow_reversing && point.x_m < 0.0 { -1.0 } else { 1.0 };
        let rotation_rad = if self.is_at_goal(input, point) {
            Some(normalize_angle(end.yaw_rad))
        } else {
            self.angle_to_path_rad(curved_point, direction)
        };
        self.report.is_rotating_to_heading = rotation_rad.is_some();
        let command = match rotation_rad {
            Some(angle_rad) => self.rotation(angle_rad, input.velocity),
            None => {
                self.tracking(input, &plan_in_base, curvature_per_m(curved_point), direction)?
            }
        };
        self.check_collision(input, command, point, plan_length_m(&plan_in_base))?;
        self.last_command = command;
        Ok(command)
    }

    fn set_plan(&mut self, _plan: &[Pose2]) {
        self.was_at_goal = false;
    }

    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        self.max_speed_m_s = limited_speed_m_s(self.params.max_speed_m_s(), limit, is_percentage);
    }

    fn reset(&mut self) {
        self.cancellation = Cancellation::None;
        self.last_command = Twist2::ZERO;
        self.was_at_goal = false;
    }

    fn cancel(&mut self) -> bool {
        if !self.params.use_cancel_deceleration || self.cancellation == Cancellation::Stopped {
            return true;
        }
        self.cancellation = Cancellation::Decelerating;
        false
    }

    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        vec![ParameterGroup::own(&self.values)]
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        check_conflicts(&self.values, name, &value)?;
        let rules = ChangeRules { fixed: &["use_interpolation"], signed: params::SIGNED_NAMES };
        let change = change(&mut self.values, rules, name, value)?;
        let before_m_s = self.params.max_speed_m_s();
        self.params = PurePursuitParams::from_values(&self.values).effective(self.release);
        // A new maximum ends the speed limit, as in Nav2.
        if self.params.max_speed_m_s() != before_m_s {
            self.max_speed_m_s = self.params.max_speed_m_s();
        }
        Ok(change)
    }

    fn path_rules(&self) -> Option<PathRules> {
        (self.release < Nav2Release::Main).then_some(PathRules::WithinCostmap {
            max_search_m: self.params.max_robot_pose_search_dist_m,
            rejects_single_pose: self.params.interpolate_curvature_after_goal,
            keeps_two_poses: self.release > Nav2Release::Humble,
        })
    }

    fn report(&self) -> ControlReport<'_> {
        ControlReport::PurePursuit(&self.report)
    }
}

/// Refuses values that contradict others.
fn check_conflicts(
    values: &ParamValues,
    name: &str,
    value: &ParamValue,
) -> Result<(), ParameterRefusal> {
    let is_on = |name: &str| values.flag(name) == Some(true);
    let conflict = match (name, value) {
        ("allow_reversing", ParamValue::Bool(true)) if is_on("use_rotate_to_heading") => {
            "`allow_reversing` cannot be true while `use_rotate_to_heading` is; set that to false first"
        }
        ("use_rotate_to_heading", ParamValue::Bool(true)) if is_on("allow_reversing") => {
            "`use_rotate_to_heading` cannot be true while `allow_reversing` is; set that to false first"
        }
        ("inflation_cost_scaling_factor", ParamValue::Number(factor)) if *factor <= 0.0 => {
            "`inflation_cost_scaling_factor` must be above 0"
        }
        _ => return Ok(()),
    };
    Err(ParameterRefusal::Conflict(conflict.to_owned()))
}
