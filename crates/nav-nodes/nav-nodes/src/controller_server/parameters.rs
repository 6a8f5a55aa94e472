//! Parameters of the controller server.

use periplus_geometry::Twist2;
use periplus_params::params;

params! {
    /// The controller server.
    #[table(CONTROLLER_SERVER, "controller_server")]
    pub struct ControllerServerParams {
        /// Rate of the control loop.
        #[param("controller_frequency", unit("Hz"), above(0.0))]
        controller_frequency_hz: f64 = 20,
        /// Speed along x up to which the odometry counts as 0.
        #[param("min_x_velocity_threshold", unit("m/s"), min(0.0))]
        min_x_velocity_threshold_m_s: f64 = 0.0001,
        /// Speed along y up to which the odometry counts as 0.
        #[param("min_y_velocity_threshold", unit("m/s"), min(0.0))]
        min_y_velocity_threshold_m_s: f64 = 0.0001,
        /// Turn rate up to which the odometry counts as 0.
        #[param("min_theta_velocity_threshold", unit("rad/s"), min(0.0))]
        min_theta_velocity_threshold_rad_s: f64 = 0.0001,
        /// Topic of speed limits.
        #[param("speed_limit_topic")]
        speed_limit_topic: String = "speed_limit",
        /// Time for which a controller may find no valid velocity; 0 for none, -1 without a limit.
        #[param("failure_tolerance", unit("s"), min(-1.0))]
        failure_tolerance_s: f64 = 0,
        /// Publishes a zero velocity at the end of a goal.
        #[param("publish_zero_velocity")]
        publish_zero_velocity: bool = true,
        /// Maximum time that a cycle waits for a current costmap (Humble waits without a limit).
        #[param("costmap_update_timeout", unit("s"))]
        costmap_update_timeout_s: f64 = 0.3,
        /// Names of the progress checkers.
        #[param("progress_checker_plugins")]
        progress_checker_plugins: Vec<String> = "progress_checker",
        /// Name of the progress checker (Humble).
        #[param("progress_checker_plugin")]
        progress_checker_plugin: Option<String>,
        /// Names of the goal checkers.
        #[param("goal_checker_plugins")]
        goal_checker_plugins: Vec<String> = "goal_checker",
        /// Names of the controllers.
        #[param("controller_plugins")]
        controller_plugins: Vec<String> = "FollowPath",
        /// Names of the path handlers (main).
        #[param("path_handler_plugins")]
        path_handler_plugins: Vec<String> = "PathHandler",
        /// Topic of the odometry.
        #[param("odom_topic")]
        odom_topic: String = "odom",
        /// Time over which the odometry is averaged; unused, controllers get the last velocity.
        #[param("odom_duration", unit("s"))]
        _: f64 = 0.3,
        /// Length of the path in which the nearest segment is searched for the feedback (main).
        #[param("search_window", unit("m"), min(0.0))]
        search_window_m: f64 = 2,
        /// Publishes velocities with a stamp (default: true from Kilted on).
        #[param("enable_stamped_cmd_vel")]
        enable_stamped_cmd_vel: Option<bool>,
        /// Priority of the loop; unused.
        #[param("use_realtime_priority")]
        _: bool = false,
        /// Time for which results are kept.
        #[param("action_server_result_timeout", unit("s"), min(0.0))]
        action_server_result_timeout_s: f64 = 10,
    }
}

impl ControllerServerParams {
    /// Sets components of a velocity that are not above their threshold to 0.
    pub(super) fn thresholded(&self, velocity: Twist2) -> Twist2 {
        let above = |value: f64, threshold: f64| if value.abs() > threshold { value } else { 0.0 };
        Twist2::new(
            above(velocity.vx_m_s, self.min_x_velocity_threshold_m_s),
            above(velocity.vy_m_s, self.min_y_velocity_threshold_m_s),
            above(velocity.wz_rad_s, self.min_theta_velocity_threshold_rad_s),
        )
    }
}

#[test]
fn thresholds_are_exclusive() {
    let params = ControllerServerParams { min_y_velocity_threshold_m_s: 0.5, ..Default::default() };
    let velocity = params.thresholded(Twist2::new(0.0001, -0.5, -0.0002));
    assert_eq!(velocity, Twist2::new(0.0, 0.0, -0.0002));
}
