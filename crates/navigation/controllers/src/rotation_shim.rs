//! RotationShim: rotates in place to the start of the plan, then another controller follows it.
//!
//! Source: `nav2_rotation_shim_controller`.

use periplus_costmap::{CostmapView, Nav2Release, cost};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_params::{Given, ParamValue, ParamValues, params};

use crate::collision::blocking_cell;
use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change, set_default};
use crate::path::distance_m;
use crate::rpp::RotationLimits;
use crate::{
    ControlError, ControlInput, ControlReport, Controller, ParameterGroup, PathRules, PluginSetup,
    create_controller,
};

params! {
    /// The controller RotationShim.
    #[table(ROTATION_SHIM, "RotationShim")]
    pub struct RotationShimParams {
        /// Class of the controller that follows the plan; in main `primary_controller.plugin`.
        #[param("primary_controller")]
        primary_controller: String = "",
        /// Minimum angle to the plan of a rotation in place.
        #[param("angular_dist_threshold", unit("rad"))]
        angular_dist_threshold_rad: f64 = 0.785,
        /// Angle to the plan at which a rotation ends (Humble: 0.785).
        #[param("angular_disengage_threshold", unit("rad"))]
        angular_disengage_threshold_rad: f64 = 0.3925,
        /// Distance from the start of the plan of the point to which the robot rotates.
        #[param("forward_sampling_distance", unit("m"))]
        forward_sampling_distance_m: f64 = 0.5,
        /// Turn rate.
        #[param("rotate_to_heading_angular_vel", unit("rad/s"))]
        rotate_to_heading_angular_vel_rad_s: f64 = 1.8,
        /// Angular acceleration.
        #[param("max_angular_accel", unit("rad/s^2"))]
        max_angular_accel_rad_s2: f64 = 3.2,
        /// Minimum cost of the footprint that stops a rotation (Jazzy and later).
        #[param("max_cost_threshold")]
        max_cost_threshold: f64 = 254,
        /// Time ahead of the collision check.
        #[param("simulate_ahead_time", unit("s"))]
        simulate_ahead_time_s: f64 = 1,
        /// Rotates in place to the heading of the goal.
        #[param("rotate_to_goal_heading")]
        rotate_to_goal_heading: bool = false,
        /// Rotates to the start of the plan for a new goal only, not for each new plan (Jazzy and later).
        #[param("rotate_to_heading_once")]
        rotate_to_heading_once: bool = false,
        /// Accelerates from the measured turn rate, not from the last command.
        #[param("closed_loop")]
        closed_loop: bool = true,
        /// Rotates to the heading of the point, not towards it (Jazzy and later).
        #[param("use_path_orientations")]
        use_path_orientations: bool = false,
    }
}

/// Group of the primary controller's parameters in main.
const PRIMARY_GROUP: &str = "primary_controller";

/// The controller RotationShim.
pub struct RotationShim {
    release: Nav2Release,
    period_s: f64,
    values: ParamValues,
    params: RotationShimParams,
    primary: Box<dyn Controller>,
    /// Group of the parameters of the primary controller; empty if they are in that of the shim.
    primary_group: &'static str,
    is_plan_new: bool,
    is_rotating: bool,
    was_at_goal: bool,
    /// Last pose of the plan, in its frame.
    goal: Option<Pose2>,
    last_rate_rad_s: Option<f64>,
}

/// Creates the controller with its primary controller.
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let mut own = setup.clone();
    let mut nested = own.given.take_group(PRIMARY_GROUP);
    let nested_class = nested.take("plugin");
    let is_nested = nested_class.is_some();
    let class = match nested_class.or_else(|| own.given.take(PRIMARY_GROUP)) {
        Some(class) if !class.text.trim().is_empty() => class,
        _ => {
            diagnostics.push(missing_primary(setup));
            return None;
        }
    };
    if !is_nested && setup.release >= Nav2Release::Kilted {
        diagnostics.push(old_form(setup, &class));
    }
    // Before Kilted the parameters of the primary controller are beside those of the shim.
    let primary_group = if is_nested { PRIMARY_GROUP } else { "" };
    let mut primary_setup = setup.clone().at(class.origin);
    if primary_group.is_empty() {
        primary_setup.given = own.given.clone();
        primary_setup.neighbours.push(&ROTATION_SHIM);
    } else {
        primary_setup.given = nested;
    }
    let primary = create_controller(&class.text, &primary_setup, diagnostics)?;
    if primary_group.is_empty() {
        let tables = primary.parameters().into_iter().map(|group| group.values.table());
        own.neighbours.extend(tables);
        // Nested parameters were checked with the primary controller.
        own.given.retain(|name| !name.contains('.'));
    }
    let values = own.read(&ROTATION_SHIM, diagnostics);
    let mut shim = RotationShim::new(values, setup.release, setup.control_period_s, primary);
    shim.primary_group = primary_group;
    shim.values.set(PRIMARY_GROUP, ParamValue::Text(class.text.trim().to_owned()));
    Some(Box::new(shim))
}

fn old_form(setup: &PluginSetup<'_>, class: &Given<'_>) -> Diagnostic {
    let name = setup.name;
    Diagnostic::warning(
        "old-form",
        format!("`{name}.primary_controller` is a class, as before Kilted; it is accepted here, and Nav2 refuses it"),
    )
    .at(class.origin)
    .help(format!(
        "write under `primary_controller:` the line `plugin: \"{}\"`, and the parameters of that controller",
        class.text.trim()
    ))
}

fn missing_primary(setup: &PluginSetup<'_>) -> Diagnostic {
    let name = setup.name;
    let (key, help) = if setup.release == Nav2Release::Main {
        (
            "primary_controller.plugin",
            "write under it `primary_controller:` with `plugin:` and its parameters",
        )
    } else {
        ("primary_controller", "set it to a class, and write its parameters beside it")
    };
    Diagnostic::error("missing-parameter", format!("RotationShim `{name}` needs `{name}.{key}`"))
        .at(setup.class_origin)
        .note("the primary controller follows the plan after the rotation")
        .help(help)
}

impl RotationShim {
    /// Creates the controller from values of [`ROTATION_SHIM`] around a primary one, for a period of the control loop
    /// \[s\].
    #[must_use]
    pub fn new(
        mut values: ParamValues,
        release: Nav2Release,
        period_s: f64,
        primary: Box<dyn Controller>,
    ) -> Self {
        if release == Nav2Release::Humble {
            set_default(&mut values, "angular_disengage_threshold", ParamValue::Number(0.785));
        }
        Self {
            release,
            period_s,
            params: RotationShimParams::from_values(&values),
            values,
            primary,
            primary_group: "",
            is_plan_new: false,
            is_rotating: false,
            was_at_goal: false,
            goal: None,
            last_rate_rad_s: None,
        }
    }

    /// Returns true if the robot is at the position of the goal; before main that is remembered.
    fn is_at_goal(&mut self, input: &ControlInput<'_>) -> bool {
        if self.release == Nav2Release::Main {
            return input.is_position_reached;
        }
        let away_m = distance_m(input.pose, input.goal);
        self.was_at_goal |= input.tolerance.xy_m.is_some_and(|tolerance_m| away_m <= tolerance_m);
        self.was_at_goal
    }

    /// Returns the angle to the point on the plan to which the robot rotates \[rad\]; none for plans that are too
    /// short.
    fn angle_to_plan_rad(&self, input: &ControlInput<'_>) -> Option<f64> {
        let [start, rest @ ..] = input.plan else { return None };
        let min_m = self.params.forward_sampling_distance_m;
        let far = rest.iter().find(|pose| distance_m(**pose, *start) >= min_m);
        let point = match far {
            Some(point) => *point,
            None if self.release == Nav2Release::Humble => return None,
            None => *rest.last()?,
        };
        if self.params.use_path_orientations {
            return Some(normalize_angle(point.yaw_rad - input.pose.yaw_rad));
        }
        let (x_m, y_m) = input.pose.inverse().transform_point(point.x_m, point.y_m);
        Some(libm::atan2(y_m, x_m))
    }

    /// Returns the rotation in place towards an angle; none if it would collide.
    fn rotation(&self, input: &ControlInput<'_>, angle_rad: f64) -> Option<Twist2> {
        let limits = RotationLimits {
            rate_rad_s: self.params.rotate_to_heading_angular_vel_rad_s,
            acceleration_rad_s2: self.params.max_angular_accel_rad_s2,
            period_s: self.period_s,
        };
        let present_rad_s = if self.params.closed_loop {
            input.velocity.wz_rad_s
        } else {
            self.last_rate_rad_s.unwrap_or(0.0)
        };
        let rate_rad_s = if self.release == Nav2Release::Humble {
            // Humble does not slow down before the angle.
            limits.turn_rate_rad_s(libm::copysign(f64::INFINITY, angle_rad), present_rad_s)
        } else {
            limits.turn_rate_rad_s(angle_rad, present_rad_s)
        };
        let is_free = self.is_free(&input.costmap, input.pose, rate_rad_s, angle_rad);
        is_free.then_some(Twist2::new(0.0, 0.0, rate_rad_s))
    }

    /// Checks the footprint during a rotation, up to the angle at which the primary controller takes over. Unknown cells
    /// always block.
    fn is_free(
        &self,
        view: &CostmapView<'_>,
        pose: Pose2,
        rate_rad_s: f64,
        angle_rad: f64,
    ) -> bool {
        let max_cost = match self.release {
            Nav2Release::Humble => f64::from(cost::LETHAL),
            _ => self.params.max_cost_threshold,
        };
        let end_rad = angle_rad.abs() - self.params.angular_dist_threshold_rad;
        let is_blocked = |cost: u8| cost == cost::UNKNOWN || f64::from(cost) >= max_cost;
        let mut time_s = 0.0;
        while time_s < self.params.simulate_ahead_time_s && self.period_s > 0.0 {
            time_s += self.period_s;
            let turned_rad = rate_rad_s * time_s;
            if turned_rad.abs() >= end_rad {
                break;
            }
            let turned = Pose2 { yaw_rad: pose.yaw_rad + turned_rad, ..pose };
            if blocking_cell(view, turned, is_blocked).is_some() {
                return false;
            }
        }
        true
    }

    /// Returns the rotation of this cycle, if the robot rotates in place.
    fn rotate(&mut self, input: &ControlInput<'_>) -> Option<Twist2> {
        if self.params.rotate_to_goal_heading && self.is_at_goal(input) {
            let angle_rad = normalize_angle(input.goal.yaw_rad - input.pose.yaw_rad);
            if let Some(rotation) = self.rotation(input, angle_rad) {
                return Some(rotation);
            }
        }
        // Main rotates in any cycle, before only after a new plan.
        self.is_plan_new |=
            self.release == Nav2Release::Main && !self.params.rotate_to_heading_once;
        if !self.is_plan_new {
            return None;
        }
        let threshold_rad = if self.is_rotating {
            self.params.angular_disengage_threshold_rad
        } else {
            self.params.angular_dist_threshold_rad
        };
        let angle_rad = self.angle_to_plan_rad(input).filter(|it| it.abs() > threshold_rad);
        let rotation = angle_rad.and_then(|angle_rad| {
            self.is_rotating = true;
            self.rotation(input, angle_rad)
        });
        self.is_plan_new = rotation.is_some();
        rotation
    }
}

impl Controller for RotationShim {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        let command = match self.rotate(input) {
            Some(rotation) => rotation,
            None => {
                self.is_rotating = false;
                self.primary.compute_velocity(input)?
            }
        };
        self.last_rate_rad_s = Some(command.wz_rad_s);
        Ok(command)
    }

    fn set_plan(&mut self, plan: &[Pose2]) {
        let is_goal_new = self.is_rotating || plan.last().copied() != self.goal;
        self.is_plan_new = !self.params.rotate_to_heading_once || is_goal_new;
        self.goal = plan.last().copied();
        self.was_at_goal = false;
        self.primary.set_plan(plan);
    }

    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        self.primary.set_speed_limit(limit, is_percentage);
    }

    fn reset(&mut self) {
        self.last_rate_rad_s = None;
        self.was_at_goal = false;
        self.primary.reset();
    }

    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        let mut groups = vec![ParameterGroup::own(&self.values)];
        groups.extend(
            self.primary.parameters().into_iter().map(|group| group.within(self.primary_group)),
        );
        groups
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        if let Some(rest) = name.strip_prefix(PRIMARY_GROUP).and_then(|it| it.strip_prefix('.')) {
            return self.primary.change_parameter(rest, value);
        }
        let rules = ChangeRules {
            fixed: &["primary_controller", "angular_disengage_threshold"],
            signed: &[],
        };
        let own = self.values.find(name).is_some();
        if !own {
            return self.primary.change_parameter(name, value);
        }
        let is_zero = matches!(value, ParamValue::Number(0.0)) && name != "simulate_ahead_time";
        if is_zero {
            return Err(ParameterRefusal::Conflict(format!("`{name}` must be above 0")));
        }
        let change = change(&mut self.values, rules, name, value.clone())?;
        self.params = RotationShimParams::from_values(&self.values);
        let is_shared = self.primary_group.is_empty()
            && self.primary.parameters().iter().any(|group| group.values.find(name).is_some());
        if is_shared {
            self.primary.change_parameter(name, value)?;
        }
        Ok(change)
    }

    fn path_rules(&self) -> Option<PathRules> {
        self.primary.path_rules()
    }

    fn report(&self) -> ControlReport<'_> {
        if self.is_rotating { ControlReport::None } else { self.primary.report() }
    }
}
