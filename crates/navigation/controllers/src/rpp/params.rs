//! Parameters of RegulatedPurePursuit.

use periplus_costmap::Nav2Release;
use periplus_params::{ParamValue, ParamValues, params};

use crate::parameters::set_default;

params! {
    /// The controller RegulatedPurePursuit.
    #[table(REGULATED_PURE_PURSUIT, "RegulatedPurePursuit")]
    pub struct PurePursuitParams {
        /// Maximum speed (main).
        #[param("max_linear_vel", unit("m/s"))]
        max_linear_vel_m_s: f64 = 0.5,
        /// Maximum speed (Humble, Jazzy; a deprecated name of `max_linear_vel` in main).
        #[param("desired_linear_vel", unit("m/s"))]
        desired_linear_vel_m_s: Option<f64>,
        /// Minimum velocity of the dynamic window; negative.
        #[param("min_linear_vel", unit("m/s"))]
        min_linear_vel_m_s: f64 = -0.5,
        /// Maximum turn rate of the dynamic window.
        #[param("max_angular_vel", unit("rad/s"))]
        max_angular_vel_rad_s: f64 = 2.5,
        /// Minimum turn rate of the dynamic window; negative.
        #[param("min_angular_vel", unit("rad/s"))]
        min_angular_vel_rad_s: f64 = -2.5,
        /// Acceleration of the dynamic window.
        #[param("max_linear_accel", unit("m/s^2"))]
        max_linear_accel_m_s2: f64 = 2.5,
        /// Deceleration of the dynamic window; negative.
        #[param("max_linear_decel", unit("m/s^2"))]
        max_linear_decel_m_s2: f64 = -2.5,
        /// Angular acceleration of rotations in place and of the dynamic window.
        #[param("max_angular_accel", unit("rad/s^2"))]
        max_angular_accel_rad_s2: f64 = 3.2,
        /// Angular deceleration of the dynamic window; negative.
        #[param("max_angular_decel", unit("rad/s^2"))]
        max_angular_decel_rad_s2: f64 = -3.2,
        /// Selects velocities that are reachable within the accelerations (main).
        #[param("use_dynamic_window")]
        use_dynamic_window: bool = false,
        /// Lookahead distance.
        #[param("lookahead_dist", unit("m"))]
        lookahead_dist_m: f64 = 0.6,
        /// Minimum of a lookahead distance that is scaled with the speed.
        #[param("min_lookahead_dist", unit("m"))]
        min_lookahead_dist_m: f64 = 0.3,
        /// Maximum of a lookahead distance that is scaled with the speed.
        #[param("max_lookahead_dist", unit("m"))]
        max_lookahead_dist_m: f64 = 0.9,
        /// Time by which the speed is multiplied for the lookahead distance.
        #[param("lookahead_time", unit("s"))]
        lookahead_time_s: f64 = 1.5,
        /// Scales the lookahead distance with the speed.
        #[param("use_velocity_scaled_lookahead_dist")]
        use_velocity_scaled_lookahead_dist: bool = false,
        /// Computes the curvature at `curvature_lookahead_dist` (Jazzy and later).
        #[param("use_fixed_curvature_lookahead")]
        use_fixed_curvature_lookahead: bool = false,
        /// Lookahead distance of the curvature.
        #[param("curvature_lookahead_dist", unit("m"))]
        curvature_lookahead_dist_m: f64 = 0.6,
        /// Extends the plan beyond the goal for the curvature.
        #[param("interpolate_curvature_after_goal")]
        interpolate_curvature_after_goal: bool = false,
        /// Interpolates the lookahead point between poses (Humble).
        #[param("use_interpolation")]
        use_interpolation: bool = true,
        /// Reduces the speed on curves.
        #[param("use_regulated_linear_velocity_scaling")]
        use_regulated_linear_velocity_scaling: bool = true,
        /// Radius below which curves reduce the speed.
        #[param("regulated_linear_scaling_min_radius", unit("m"))]
        regulated_linear_scaling_min_radius_m: f64 = 0.9,
        /// Minimum speed that curves and obstacles leave.
        #[param("regulated_linear_scaling_min_speed", unit("m/s"))]
        regulated_linear_scaling_min_speed_m_s: f64 = 0.25,
        /// Reduces the speed near obstacles.
        #[param("use_cost_regulated_linear_velocity_scaling")]
        use_cost_regulated_linear_velocity_scaling: bool = true,
        /// `cost_scaling_factor` of the inflation layer, from which distances to obstacles are computed.
        #[param("inflation_cost_scaling_factor", unit("1/m"))]
        inflation_cost_scaling_factor_per_m: f64 = 3,
        /// Distance to obstacles below which the speed is reduced.
        #[param("cost_scaling_dist", unit("m"))]
        cost_scaling_dist_m: f64 = 0.6,
        /// Factor on the reduced speed.
        #[param("cost_scaling_gain")]
        cost_scaling_gain: f64 = 1,
        /// Length of the rest of the plan below which the speed is reduced.
        #[param("approach_velocity_scaling_dist", unit("m"))]
        approach_velocity_scaling_dist_m: f64 = 0.6,
        /// Minimum speed near the goal.
        #[param("min_approach_linear_velocity", unit("m/s"))]
        min_approach_linear_velocity_m_s: f64 = 0.05,
        /// Rotates in place to the start of the plan and to the goal's heading.
        #[param("use_rotate_to_heading")]
        use_rotate_to_heading: bool = true,
        /// Minimum angle to the plan of a rotation in place.
        #[param("rotate_to_heading_min_angle", unit("rad"))]
        rotate_to_heading_min_angle_rad: f64 = 0.785,
        /// Turn rate of rotations in place.
        #[param("rotate_to_heading_angular_vel", unit("rad/s"))]
        rotate_to_heading_angular_vel_rad_s: f64 = 1.8,
        /// Drives backwards where the plan does.
        #[param("allow_reversing")]
        allow_reversing: bool = false,
        /// Stops for collisions ahead (always on in Humble).
        #[param("use_collision_detection")]
        use_collision_detection: bool = true,
        /// Maximum time ahead of the collision check.
        #[param("max_allowed_time_to_collision_up_to_carrot", unit("s"))]
        max_time_to_collision_s: f64 = 1,
        /// Minimum distance ahead of the collision check; not positive for none (main).
        #[param("min_distance_to_obstacle", unit("m"))]
        min_distance_to_obstacle_m: f64 = -1,
        /// Checks for collisions beyond the end of the plan (main).
        #[param("allow_obstacle_checking_beyond_goal")]
        allow_obstacle_checking_beyond_goal: bool = false,
        /// Decelerates when a goal is cancelled, instead of stopping at once (Jazzy and later).
        #[param("use_cancel_deceleration")]
        use_cancel_deceleration: bool = false,
        /// Deceleration of cancelled goals.
        #[param("cancel_deceleration", unit("m/s^2"))]
        cancel_deceleration_m_s2: f64 = 3.2,
        /// Remembers that the position of the goal was reached (Jazzy).
        #[param("stateful")]
        stateful: bool = true,
        /// Length of the plan in which the nearest pose is searched (Humble, Jazzy; default: half of the longer side
        /// of the costmap).
        #[param("max_robot_pose_search_dist", unit("m"))]
        max_robot_pose_search_dist_m: Option<f64>,
        /// Unused; the caller passes the transform (Humble, Jazzy).
        #[param("transform_tolerance", unit("s"))]
        _: f64 = 0.1,
    }
}

/// Names of numbers that may be negative.
pub(super) const SIGNED_NAMES: &[&str] =
    &["min_linear_vel", "min_angular_vel", "max_linear_decel", "max_angular_decel"];

/// Sets the defaults of a release.
pub(super) fn set_release_defaults(values: &mut ParamValues, release: Nav2Release) {
    if release < Nav2Release::Main {
        set_default(values, "desired_linear_vel", ParamValue::Number(0.5));
    }
}

impl PurePursuitParams {
    /// Returns the maximum speed of a release \[m/s\].
    #[must_use]
    pub fn max_speed_m_s(&self) -> f64 {
        self.desired_linear_vel_m_s.unwrap_or(self.max_linear_vel_m_s)
    }

    /// Returns the parameters with those switched off that a release does not have or that exclude each other.
    pub(super) fn effective(mut self, release: Nav2Release) -> Self {
        if release < Nav2Release::Main {
            self.use_dynamic_window = false;
            self.min_distance_to_obstacle_m = -1.0;
        }
        if release == Nav2Release::Humble {
            self.use_fixed_curvature_lookahead = false;
            self.use_cancel_deceleration = false;
            self.allow_reversing &= !self.use_rotate_to_heading;
        } else {
            self.use_interpolation = true;
        }
        self.interpolate_curvature_after_goal &= self.use_fixed_curvature_lookahead;
        self.use_cost_regulated_linear_velocity_scaling &=
            self.inflation_cost_scaling_factor_per_m > 0.0;
        self
    }
}
