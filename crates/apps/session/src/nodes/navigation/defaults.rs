//! Default parameters of navigation, from what is known of the robot.

use std::fmt::Write as _;

use periplus_nav_nodes::bt_navigator::{NAVIGATE_CAR_TO_POSE_FILE, NAVIGATE_KEEPING_PATH_FILE};

use super::RobotProfile;

/// Motion that the wheels of a robot allow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RobotBase {
    /// Forwards, backwards, turning on the spot.
    #[default]
    Differential,
    /// In all directions.
    Omnidirectional,
    /// As a car.
    Ackermann {
        /// Smallest radius of a turn \[m\].
        min_turning_radius_m: f64,
    },
}

/// Controller that follows the path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathController {
    /// MPPI: it leads around obstacles, and takes about a hundred times the computing time.
    #[default]
    Mppi,
    /// Regulated pure pursuit: it stays on the path, and stops before obstacles until there is a new path.
    RegulatedPurePursuit,
}

/// Inputs of the default parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct NavigationDefaults {
    /// Controller.
    pub controller: PathController,
    /// Motion that the wheels allow.
    pub base: RobotBase,
    /// Maximum speed \[m/s\].
    pub max_speed_m_s: f64,
    /// Maximum turn rate \[rad/s\].
    pub max_turn_rate_rad_s: f64,
    /// Map on which paths are planned.
    pub map: PlanningMap,
}

/// Map on which paths are planned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanningMap {
    /// A whole map: goals outside of it are refused.
    Known,
    /// A map that SLAM builds while the robot drives: paths lead through unknown space.
    #[default]
    Growing,
    /// None: obstacles only, in the odometry frame.
    Absent,
}

impl Default for NavigationDefaults {
    fn default() -> Self {
        Self {
            controller: PathController::default(),
            base: RobotBase::default(),
            max_speed_m_s: 0.5,
            max_turn_rate_rad_s: 1.9,
            map: PlanningMap::default(),
        }
    }
}

/// Time over which the controller predicts the motion \[s\]: 56 steps of 0.05 s.
const HORIZON_S: f64 = 2.8;

/// Part of the range of a lidar at its end that marks no obstacles \[m\].
const RANGE_MARGIN_M: f64 = 0.1;

/// Cells of the costmaps, and distance of the points of a path \[m\].
const RESOLUTION_M: f64 = 0.05;

/// Period of the controller, and of the tree above one that takes little computing time \[ms\].
const CONTROL_PERIOD_MS: u32 = 50;

/// Side of the costmap around the robot where there is no whole map \[m\].
const UNMAPPED_SIDE_M: usize = 50;

/// Margin around the outline of a robot in the costmaps \[m\].
const PADDING_M: f64 = 0.01;

/// The same for a car, which cannot turn away from an obstacle beside it \[m\]. With 0.01 m a car touched a wall once in 130
/// goals in the house.
const CAR_PADDING_M: f64 = 0.03;

/// Length of path that a cusp costs a car, about the length of the car \[m\]. At a cusp it stops, which takes as long.
const CUSP_PENALTY_M: f64 = 0.5;

/// Critic of robots other than cars, whose paths lead backwards as well.
const PREFER_FORWARD: &str = "      PreferForwardCritic: {enabled: true, cost_power: 1, cost_weight: 5.0, \
                              threshold_to_consider: 0.5}\n";

impl NavigationDefaults {
    /// Defaults for this number of robots: several have the controller that takes little computing time.
    #[must_use]
    pub fn for_robots(count: usize) -> Self {
        let several = PathController::RegulatedPurePursuit;
        let controller = if count > 1 { several } else { PathController::default() };
        Self { controller, ..Self::default() }
    }

    /// Returns the parameter file for a robot.
    #[must_use]
    pub fn yaml(&self, profile: &RobotProfile) -> String {
        let mut text = String::new();
        self.write_controller(profile, &mut text);
        self.write_planner(profile, &mut text);
        self.write_behaviors(profile, &mut text);
        self.write_costmaps(profile, &mut text);
        text
    }

    fn global_frame<'a>(&self, profile: &'a RobotProfile) -> &'a str {
        if self.map == PlanningMap::Absent { profile.odom() } else { "map" }
    }

    fn write_controller(&self, profile: &RobotProfile, text: &mut String) {
        let stamped = profile.takes_stamped_velocities();
        let _ = write!(
            text,
            "controller_server:\n  ros__parameters:\n    use_sim_time: true\n\
             \x20   controller_frequency: 20.0\n    enable_stamped_cmd_vel: {stamped}\n\
             \x20   odom_topic: {odom}\n    costmap_update_timeout: 0.3\n\
             \x20   min_x_velocity_threshold: 0.001\n    min_y_velocity_threshold: 0.001\n\
             \x20   min_theta_velocity_threshold: 0.001\n    failure_tolerance: 0.5\n\
             \x20   progress_checker_plugins: [progress_checker]\n\
             \x20   goal_checker_plugins: [goal_checker]\n    controller_plugins: [FollowPath]\n\
             \x20   progress_checker:\n      plugin: nav2_controller::PoseProgressChecker\n\
             \x20     required_movement_radius: 0.3\n      required_movement_angle: 0.5\n\
             \x20     movement_time_allowance: 10.0\n\
             \x20   goal_checker:\n      plugin: nav2_controller::SimpleGoalChecker\n\
             \x20     xy_goal_tolerance: 0.25\n      yaw_goal_tolerance: 0.25\n      stateful: true\n\
             {path_handler}\
             \x20   FollowPath:\n",
            path_handler = self.path_handler(),
            odom = profile.odometry.as_deref().unwrap_or("odom"),
        );
        match self.controller {
            PathController::Mppi => self.write_mppi(profile, text),
            PathController::RegulatedPurePursuit => self.write_pure_pursuit(text),
        }
    }

    /// Writes the parameters of regulated pure pursuit: those of Nav2's documentation at the speed of the robot.
    fn write_pure_pursuit(&self, text: &mut String) {
        let turns = !self.is_car();
        let _ = write!(
            text,
            "      plugin: nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController\n\
             \x20     desired_linear_vel: {speed}\n      lookahead_dist: 0.6\n      min_lookahead_dist: 0.3\n\
             \x20     max_lookahead_dist: 0.9\n      lookahead_time: 1.5\n\
             \x20     use_velocity_scaled_lookahead_dist: true\n      min_approach_linear_velocity: 0.05\n\
             \x20     approach_velocity_scaling_dist: 0.6\n      use_collision_detection: true\n\
             \x20     max_allowed_time_to_collision_up_to_carrot: 1.0\n\
             \x20     use_regulated_linear_velocity_scaling: true\n\
             \x20     regulated_linear_scaling_min_radius: 0.9\n      regulated_linear_scaling_min_speed: 0.25\n\
             \x20     use_cost_regulated_linear_velocity_scaling: false\n      transform_tolerance: 0.1\n\
             \x20     use_rotate_to_heading: {turns}\n      rotate_to_heading_min_angle: 0.785\n\
             \x20     rotate_to_heading_angular_vel: {turn:.2}\n      max_angular_accel: 3.2\n\
             \x20     allow_reversing: {backwards}\n",
            speed = self.max_speed_m_s,
            turn = self.max_turn_rate_rad_s.min(1.8),
            backwards = self.is_car(),
        );
    }

    fn write_mppi(&self, profile: &RobotProfile, text: &mut String) {
        let (speed, turn) = (self.max_speed_m_s, self.max_turn_rate_rad_s);
        let (model, side_speed, least_speed) = match self.base {
            RobotBase::Differential => ("DiffDrive", 0.0, -0.35 * speed),
            RobotBase::Omnidirectional => ("Omni", speed, -0.35 * speed),
            RobotBase::Ackermann { .. } => ("Ackermann", 0.0, -0.5 * speed),
        };
        let _ = write!(
            text,
            "      plugin: nav2_mppi_controller::MPPIController\n\
             \x20     time_steps: 56\n      model_dt: 0.05\n      batch_size: 1000\n\
             \x20     vx_std: {vx_std:.3}\n      vy_std: {vy_std:.3}\n      wz_std: 0.4\n\
             \x20     vx_max: {speed}\n      vx_min: {least_speed}\n      vy_max: {side_speed}\n\
             \x20     wz_max: {turn}\n      ax_max: 3.0\n      ax_min: -3.0\n      ay_max: 3.0\n      az_max: 3.5\n\
             \x20     iteration_count: 1\n      prune_distance: {prune:.2}\n      transform_tolerance: 0.1\n\
             \x20     temperature: 0.3\n      gamma: 0.015\n      motion_model: {model}\n",
            vx_std = (0.4 * speed).max(0.2),
            vy_std = (0.4 * speed).max(0.2),
            prune = self.prune_distance_m(),
        );
        if let RobotBase::Ackermann { min_turning_radius_m } = self.base {
            let _ = write!(
                text,
                "      AckermannConstraints:\n        min_turning_r: {min_turning_radius_m}\n\
                 \x20       sample_curvatures: true\n"
            );
        }
        self.write_critics(profile, text);
    }

    fn is_car(&self) -> bool {
        matches!(self.base, RobotBase::Ackermann { .. })
    }

    /// Length of the path that the controller gets \[m\].
    fn prune_distance_m(&self) -> f64 {
        (1.2 * HORIZON_S * self.max_speed_m_s).max(1.5)
    }

    /// Parameters of the path handler: a car drives to each cusp of its path, and only then follows the rest. Other robots
    /// have the defaults of Nav2. Before main the controller has `enforce_path_inversion`.
    fn path_handler(&self) -> String {
        if !self.is_car() {
            return String::new();
        }
        format!(
            "    PathHandler:\n      plugin: nav2_controller::FeasiblePathHandler\n\
             \x20     prune_distance: {:.2}\n      enforce_path_inversion: true\n",
            self.prune_distance_m()
        )
    }

    /// Writes the critics of MPPI. The path of a car has the heading of each of its points and leads forwards and
    /// backwards: it is followed point by point, also up to a cusp that is nearer than the 20 points from which
    /// `PathAlignCritic` applies in Nav2.
    fn write_critics(&self, profile: &RobotProfile, text: &mut String) {
        let is_car = self.is_car();
        let speed = self.max_speed_m_s;
        let forward = if is_car { "" } else { ", PreferForwardCritic" };
        let critics = "ConstraintCritic, CostCritic, GoalCritic, GoalAngleCritic, PathAlignCritic, \
                       PathFollowCritic, PathAngleCritic";
        let _ = write!(
            text,
            "      critics: [{critics}{forward}]\n\
             \x20     ConstraintCritic: {{enabled: true, cost_power: 1, cost_weight: 4.0}}\n\
             \x20     GoalCritic: {{enabled: true, cost_power: 1, cost_weight: 5.0, threshold_to_consider: {near}}}\n\
             \x20     GoalAngleCritic: {{enabled: true, cost_power: 1, cost_weight: 3.0, threshold_to_consider: {turns_within}}}\n\
             {prefers_forward}\
             \x20     CostCritic: {{enabled: true, cost_power: 1, cost_weight: 3.81, critical_cost: 300.0, \
             consider_footprint: {shaped}, collision_cost: 1000000.0, near_goal_distance: 1.0, trajectory_point_step: 2}}\n\
             \x20     PathAlignCritic: {{enabled: true, cost_power: 1, cost_weight: 14.0, max_path_occupancy_ratio: 0.05, \
             trajectory_point_step: 4, threshold_to_consider: {follows_until}, offset_from_furthest: {follows_from}, \
             use_path_orientations: {is_car}}}\n\
             \x20     PathFollowCritic: {{enabled: true, cost_power: 1, cost_weight: 5.0, offset_from_furthest: {aim}, threshold_to_consider: {near}}}\n\
             \x20     PathAngleCritic: {{enabled: true, cost_power: 1, cost_weight: 2.0, offset_from_furthest: 4, \
             threshold_to_consider: 0.5, max_angle_to_furthest: 1.0, mode: {mode}}}\n\
             \x20     enforce_path_inversion: {is_car}\n",
            prefers_forward = if is_car { "" } else { PREFER_FORWARD },
            shaped = profile.footprint.is_some(),
            follows_until = if is_car { 0.1 } else { 0.5 },
            follows_from = if is_car { 1 } else { 20 },
            near = if is_car { 0.3 } else { 1.4 },
            turns_within = if is_car { 0.5 } else { 0.25 },
            mode = if is_car { 2 } else { 0 },
            // A tenth of what the fastest sample drives, in points of the path.
            aim = (0.1 * HORIZON_S * speed / RESOLUTION_M).ceil().max(5.0) as usize,
        );
    }

    fn write_planner(&self, profile: &RobotProfile, text: &mut String) {
        let _ = write!(
            text,
            "planner_server:\n  ros__parameters:\n    use_sim_time: true\n\
             \x20   expected_planner_frequency: 1.0\n    planner_plugins: [GridBased]\n\
             \x20   costmap_update_timeout: 1.0\n    GridBased:\n"
        );
        match self.base {
            RobotBase::Ackermann { min_turning_radius_m } => {
                let _ = write!(
                    text,
                    "      plugin: nav2_smac_planner::SmacPlannerHybrid\n      tolerance: 0.25\n\
                     \x20     allow_unknown: true\n      motion_model_for_search: REEDS_SHEPP\n\
                     \x20     minimum_turning_radius: {:.3}\n      angle_quantization_bins: 72\n\
                     \x20     cusp_penalty: {CUSP_PENALTY_M}\n",
                    // The controller needs some room to correct.
                    1.1 * min_turning_radius_m
                );
            }
            RobotBase::Differential | RobotBase::Omnidirectional => text.push_str(
                "      plugin: nav2_navfn_planner::NavfnPlanner\n      tolerance: 0.25\n\
                 \x20     use_astar: false\n      allow_unknown: true\n",
            ),
        }
        let _ = write!(
            text,
            "bt_navigator:\n  ros__parameters:\n    use_sim_time: true\n    global_frame: {}\n\
             \x20   robot_base_frame: {}\n    odom_topic: {}\n{}\
             waypoint_follower:\n  ros__parameters:\n    use_sim_time: true\n    stop_on_failure: false\n\
             smoother_server:\n  ros__parameters:\n    use_sim_time: true\n",
            self.global_frame(profile),
            profile.base(),
            profile.odometry.as_deref().unwrap_or("odom"),
            self.tree(),
        );
    }

    /// Tree of a car, and of robots that follow a path without deviation; others have that of Nav2.
    fn tree(&self) -> String {
        let file = match (self.is_car(), self.controller) {
            (true, _) => NAVIGATE_CAR_TO_POSE_FILE,
            (false, PathController::RegulatedPurePursuit) => NAVIGATE_KEEPING_PATH_FILE,
            (false, PathController::Mppi) => return String::new(),
        };
        let mut text = format!("    default_nav_to_pose_bt_xml: {file}\n");
        if self.controller == PathController::RegulatedPurePursuit {
            let _ = writeln!(text, "    bt_loop_duration: {CONTROL_PERIOD_MS}");
        }
        text
    }

    /// Update rates of the local and the global costmap \[Hz\]. A robot that only stops before obstacles needs no more than
    /// the defaults of Nav2.
    fn costmap_rates_hz(&self) -> [f64; 2] {
        match self.controller {
            PathController::Mppi => [10.0, 2.0],
            PathController::RegulatedPurePursuit => [5.0, 1.0],
        }
    }

    fn write_behaviors(&self, profile: &RobotProfile, text: &mut String) {
        let _ = write!(
            text,
            "behavior_server:\n  ros__parameters:\n    use_sim_time: true\n\
             \x20   behavior_plugins: [spin, backup, drive_on_heading, assisted_teleop, wait]\n\
             \x20   spin: {{plugin: \"nav2_behaviors::Spin\"}}\n    backup: {{plugin: \"nav2_behaviors::BackUp\"}}\n\
             \x20   drive_on_heading: {{plugin: \"nav2_behaviors::DriveOnHeading\"}}\n\
             \x20   assisted_teleop: {{plugin: \"nav2_behaviors::AssistedTeleop\"}}\n\
             \x20   wait: {{plugin: \"nav2_behaviors::Wait\"}}\n\
             \x20   local_frame: {odom}\n    global_frame: {global}\n    robot_base_frame: {base}\n\
             \x20   enable_stamped_cmd_vel: {stamped}\n    max_rotational_vel: {turn:.2}\n\
             \x20   min_rotational_vel: 0.4\n    rotational_acc_lim: 3.2\n",
            odom = profile.odom(),
            global = self.global_frame(profile),
            base = profile.base(),
            stamped = profile.takes_stamped_velocities(),
            turn = self.max_turn_rate_rad_s.min(1.0),
        );
    }

    fn write_costmaps(&self, profile: &RobotProfile, text: &mut String) {
        let radius_m = profile.radius_m;
        // Circle around the robot.
        let corners = profile.footprint.iter().flatten();
        let distances = corners.map(|[x_m, y_m]| (x_m * x_m + y_m * y_m).sqrt());
        let circumscribed_m = distances.reduce(f64::max).unwrap_or(radius_m);
        let circle = format!("robot_radius: {circumscribed_m:.3}");
        let shape = match &profile.footprint {
            Some(corners) => {
                let corners: Vec<String> =
                    corners.iter().map(|[x, y]| format!("[{x:.4}, {y:.4}]")).collect();
                format!("footprint: \"[{}]\"", corners.join(", "))
            }
            None => circle.clone(),
        };
        let scan = profile.scan.as_deref().unwrap_or("/scan");
        // A beam that hits nothing clears up to the largest range, and would mark an obstacle there.
        let marked_m = profile
            .scan_range_max_m
            .map_or(5.0, |range_m| (range_m - RANGE_MARGIN_M).clamp(0.1, 5.0));
        // Paths keep this distance where there is room for it.
        let inflation_m = (radius_m + 0.35).max(0.5);
        let layers = format!(
            "      obstacle_layer:\n        plugin: nav2_costmap_2d::ObstacleLayer\n\
             \x20       observation_sources: scan\n\
             \x20       scan: {{topic: {scan}, data_type: LaserScan, marking: true, clearing: true, \
             max_obstacle_height: 2.0, obstacle_max_range: {marked_m:.2}, raytrace_max_range: 6.0, inf_is_valid: true}}\n\
             \x20     inflation_layer:\n        plugin: nav2_costmap_2d::InflationLayer\n\
             \x20       cost_scaling_factor: 3.0\n        inflation_radius: {inflation_m:.3}\n"
        );
        // A robot that drives in all directions comes to a gap with any heading, and MPPI does not turn it to fit.
        let planned_shape = if self.base == RobotBase::Omnidirectional { &circle } else { &shape };
        let padding_m = if self.is_car() { CAR_PADDING_M } else { PADDING_M };
        let common = |frame: &str, rate_hz: f64, shape: &str| {
            format!(
                "      use_sim_time: true\n      global_frame: {frame}\n      robot_base_frame: {}\n\
                 \x20     {shape}\n      footprint_padding: {padding_m}\n      resolution: {RESOLUTION_M}\n\
                 \x20     update_frequency: {rate_hz:.1}\n      publish_frequency: 2.0\n",
                profile.base()
            )
        };
        let [local_hz, global_hz] = self.costmap_rates_hz();
        let side_m = (2.0 * (HORIZON_S * self.max_speed_m_s + 1.0)).max(4.0).ceil() as usize;
        let _ = write!(
            text,
            "local_costmap:\n  local_costmap:\n    ros__parameters:\n{}\
             \x20     rolling_window: true\n      width: {side_m}\n      height: {side_m}\n\
             \x20     plugins: [obstacle_layer, inflation_layer]\n{layers}\
             global_costmap:\n  global_costmap:\n    ros__parameters:\n{}",
            common(profile.odom(), local_hz, &shape),
            common(self.global_frame(profile), global_hz, planned_shape),
        );
        let rolling = format!(
            "      rolling_window: true\n      width: {UNMAPPED_SIDE_M}\n      height: {UNMAPPED_SIDE_M}\n"
        );
        let static_layer = "      track_unknown_space: true\n\
             \x20     plugins: [static_layer, obstacle_layer, inflation_layer]\n\
             \x20     static_layer:\n        plugin: nav2_costmap_2d::StaticLayer\n\
             \x20       map_subscribe_transient_local: true\n";
        text.push_str(&match self.map {
            PlanningMap::Known => format!("{static_layer}{layers}"),
            PlanningMap::Growing => format!("{rolling}{static_layer}{layers}"),
            PlanningMap::Absent => format!(
                "{rolling}      track_unknown_space: false\n\
                 \x20     plugins: [obstacle_layer, inflation_layer]\n{layers}"
            ),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn yaml(base: RobotBase) -> String {
        NavigationDefaults { base, ..NavigationDefaults::default() }.yaml(&RobotProfile::default())
    }

    /// Regression test: the path of a car was not cut at its cusps, and was replanned each second.
    #[test]
    fn a_car_follows_its_path_from_cusp_to_cusp() {
        let rules = [
            "PathHandler:\n      plugin: nav2_controller::FeasiblePathHandler",
            "      enforce_path_inversion: true",
            "sample_curvatures: true",
            "offset_from_furthest: 1,",
            "cusp_penalty: 0.5",
            "footprint_padding: 0.03",
            "default_nav_to_pose_bt_xml: navigate_car_to_pose.xml",
        ];
        let car = yaml(RobotBase::Ackermann { min_turning_radius_m: 0.5 });
        for base in [RobotBase::Differential, RobotBase::Omnidirectional] {
            let other = yaml(base);
            for rule in rules {
                assert!(car.contains(rule) && !other.contains(rule), "{rule}");
            }
        }
    }
}
