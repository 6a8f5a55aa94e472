//! Parameters of Graceful.

use periplus_costmap::Nav2Release;
use periplus_params::{ParamValue, ParamValues, params};

use crate::parameters::set_default;

params! {
    /// The controller Graceful.
    #[table(GRACEFUL, "Graceful")]
    pub struct GracefulParams {
        /// Gain of the heading on the path to the target (Humble: 3).
        #[param("k_phi")]
        k_phi: f64 = 2,
        /// Gain of the error of the heading (Humble: 2).
        #[param("k_delta")]
        k_delta: f64 = 1,
        /// Reduction of the speed on curves (Humble: 0.2).
        #[param("beta")]
        beta: f64 = 0.4,
        /// Exponent of the curvature in that reduction.
        #[param("lambda")]
        lambda: f64 = 2,
        /// Minimum speed.
        #[param("v_linear_min", unit("m/s"))]
        v_linear_min_m_s: f64 = 0.1,
        /// Maximum speed.
        #[param("v_linear_max", unit("m/s"))]
        v_linear_max_m_s: f64 = 0.5,
        /// Maximum turn rate.
        #[param("v_angular_max", unit("rad/s"))]
        v_angular_max_rad_s: f64 = 1,
        /// Minimum turn rate of rotations in place (Jazzy and later).
        #[param("v_angular_min_in_place", unit("rad/s"))]
        v_angular_min_in_place_rad_s: f64 = 0.25,
        /// Distance to the target below which the speed is reduced.
        #[param("slowdown_radius", unit("m"))]
        slowdown_radius_m: f64 = 1.5,
        /// Deceleration by which the speed falls before the target (main).
        #[param("deceleration_max", unit("m/s^2"))]
        deceleration_max_m_s2: f64 = 2.5,
        /// Minimum distance of the target along the plan (Jazzy).
        #[param("min_lookahead", unit("m"))]
        min_lookahead_m: f64 = 0.25,
        /// Maximum distance of the target along the plan (Jazzy and later).
        #[param("max_lookahead", unit("m"))]
        max_lookahead_m: f64 = 1,
        /// Distance of the target from the robot (Humble).
        #[param("motion_target_dist", unit("m"))]
        motion_target_dist_m: f64 = 0.6,
        /// Rotates in place to the start of a new plan.
        #[param("initial_rotation")]
        initial_rotation: bool = true,
        /// Angle to the target at which the first rotation ends (Jazzy and later).
        #[param("initial_rotation_tolerance", unit("rad"))]
        initial_rotation_tolerance_rad: f64 = 0.75,
        /// Minimum angle to the target of a rotation in place (Humble).
        #[param("initial_rotation_min_angle", unit("rad"))]
        initial_rotation_min_angle_rad: f64 = 0.75,
        /// Approaches the goal without regard to its heading, and rotates there (Jazzy and later).
        #[param("prefer_final_rotation")]
        prefer_final_rotation: bool = true,
        /// Rotates in place at the goal (Humble).
        #[param("final_rotation")]
        final_rotation: bool = true,
        /// Part of the angle that a rotation in place covers in a second, at a maximum turn rate of 1 rad/s.
        #[param("rotation_scaling_factor")]
        rotation_scaling_factor: f64 = 0.5,
        /// Drives backwards to targets behind the robot.
        #[param("allow_backward")]
        allow_backward: bool = false,
        /// Step of the collision check of rotations in place.
        #[param("in_place_collision_resolution", unit("rad"))]
        in_place_collision_resolution_rad: f64 = 0.1,
        /// Checks for collisions (always on before main).
        #[param("use_collision_detection")]
        use_collision_detection: bool = true,
        /// Speed above which the footprint of the collision check grows (main).
        #[param("footprint_scaling_linear_vel", unit("m/s"))]
        footprint_scaling_linear_vel_m_s: f64 = 0.5,
        /// Growth of the footprint at the maximum speed (main).
        #[param("footprint_scaling_factor")]
        footprint_scaling_factor: f64 = 0.25,
        /// Step by which the speed is reduced when the grown footprint collides (main).
        #[param("footprint_scaling_step", unit("m/s"))]
        footprint_scaling_step_m_s: f64 = 0.1,
        /// Distance from the maximum cost at which another approach to the goal is searched (main).
        #[param("obstacle_cost_margin")]
        obstacle_cost_margin: i64 = 1,
        /// Step of that search.
        #[param("final_rotation_search_step", unit("rad"))]
        final_rotation_search_step_rad: f64 = 0.1,
        /// Length of the plan in which the nearest pose is searched (Humble, Jazzy; default: half of the longer side
        /// of the costmap).
        #[param("max_robot_pose_search_dist", unit("m"))]
        max_robot_pose_search_dist_m: Option<f64>,
        /// Unused; the caller passes the transform (Humble, Jazzy).
        #[param("transform_tolerance", unit("s"))]
        _: f64 = 0.1,
    }
}

/// Sets the defaults of a release.
pub(super) fn set_release_defaults(values: &mut ParamValues, release: Nav2Release) {
    if release == Nav2Release::Humble {
        for (name, number) in [("k_phi", 3.0), ("k_delta", 2.0), ("beta", 0.2)] {
            set_default(values, name, ParamValue::Number(number));
        }
    }
}

impl GracefulParams {
    /// Returns the parameters with those switched off that a release does not have or that exclude each other.
    pub(super) fn effective(mut self, release: Nav2Release) -> Self {
        self.allow_backward &= !self.initial_rotation;
        if release < Nav2Release::Main {
            self.use_collision_detection = true;
            self.footprint_scaling_linear_vel_m_s = f64::INFINITY;
            self.deceleration_max_m_s2 = f64::INFINITY;
        }
        self
    }
}
