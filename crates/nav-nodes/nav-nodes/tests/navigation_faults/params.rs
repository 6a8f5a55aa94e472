//! Parameters of the servers: those of Jazzy, with a controller that needs little time.

/// Parameter file.
pub(crate) const YAML: &str = "
bt_navigator:
  ros__parameters:
    global_frame: map
    robot_base_frame: base_link
    odom_topic: /odom
    bt_loop_duration: 10
    default_server_timeout: 20
    error_code_names: [compute_path_error_code, follow_path_error_code]
controller_server:
  ros__parameters:
    controller_frequency: 20.0
    costmap_update_timeout: 0.30
    min_x_velocity_threshold: 0.001
    min_theta_velocity_threshold: 0.001
    failure_tolerance: 0.3
    progress_checker_plugins: [progress_checker]
    goal_checker_plugins: [general_goal_checker]
    controller_plugins: [FollowPath]
    progress_checker:
      plugin: 'nav2_controller::SimpleProgressChecker'
      required_movement_radius: 0.5
      movement_time_allowance: 10.0
    general_goal_checker:
      plugin: 'nav2_controller::SimpleGoalChecker'
      xy_goal_tolerance: 0.25
      yaw_goal_tolerance: 0.25
      stateful: true
    FollowPath:
      plugin: 'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController'
      desired_linear_vel: 0.5
      use_rotate_to_heading: true
local_costmap:
  local_costmap:
    ros__parameters:
      update_frequency: 5.0
      publish_frequency: 2.0
      global_frame: odom
      robot_base_frame: base_link
      rolling_window: true
      width: 3
      height: 3
      resolution: 0.05
      robot_radius: 0.22
      plugins: [obstacle_layer, inflation_layer]
      obstacle_layer:
        plugin: 'nav2_costmap_2d::ObstacleLayer'
        observation_sources: scan
        scan: {topic: /scan, data_type: LaserScan, max_obstacle_height: 2.0, expected_update_rate: LOCAL_RATE, raytrace_max_range: 3.0, obstacle_max_range: 2.5, clearing: true, marking: true}
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', cost_scaling_factor: 3.0, inflation_radius: 0.5}
global_costmap:
  global_costmap:
    ros__parameters:
      update_frequency: 5.0
      publish_frequency: 1.0
      global_frame: map
      robot_base_frame: base_link
      robot_radius: 0.22
      track_unknown_space: true
      plugins: [static_layer, obstacle_layer, inflation_layer]
      static_layer: {plugin: 'nav2_costmap_2d::StaticLayer', map_subscribe_transient_local: true}
      obstacle_layer:
        plugin: 'nav2_costmap_2d::ObstacleLayer'
        observation_sources: scan
        scan: {topic: /scan, data_type: LaserScan, max_obstacle_height: 2.0, expected_update_rate: GLOBAL_RATE, raytrace_max_range: 3.0, obstacle_max_range: 2.5, clearing: true, marking: true}
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', cost_scaling_factor: 3.0, inflation_radius: 0.5}
planner_server:
  ros__parameters:
    expected_planner_frequency: 20.0
    planner_plugins: [GridBased]
    costmap_update_timeout: 1.0
    GridBased: {plugin: 'nav2_navfn_planner::NavfnPlanner', tolerance: 0.5, use_astar: false, allow_unknown: true}
smoother_server:
  ros__parameters:
    smoother_plugins: [simple_smoother]
    simple_smoother: {plugin: 'nav2_smoother::SimpleSmoother', tolerance: 1.0e-10, max_its: 1000, do_refinement: true}
behavior_server:
  ros__parameters:
    local_costmap_topic: local_costmap/costmap_raw
    local_footprint_topic: local_costmap/published_footprint
    cycle_frequency: 10.0
    behavior_plugins: [spin, backup, drive_on_heading, assisted_teleop, wait]
    spin: {plugin: 'nav2_behaviors::Spin'}
    backup: {plugin: 'nav2_behaviors::BackUp'}
    drive_on_heading: {plugin: 'nav2_behaviors::DriveOnHeading'}
    wait: {plugin: 'nav2_behaviors::Wait'}
    assisted_teleop: {plugin: 'nav2_behaviors::AssistedTeleop'}
    local_frame: odom
    global_frame: map
    robot_base_frame: base_link
    transform_tolerance: 0.1
    simulate_ahead_time: 2.0
    max_rotational_vel: 1.0
    min_rotational_vel: 0.4
    rotational_acc_lim: 3.2
waypoint_follower:
  ros__parameters:
    loop_rate: 20
    stop_on_failure: false
    waypoint_task_executor_plugin: wait_at_waypoint
    wait_at_waypoint: {plugin: 'nav2_waypoint_follower::WaitAtWaypoint', enabled: true, waypoint_pause_duration: 200}
velocity_smoother:
  ros__parameters:
    smoothing_frequency: 20.0
    feedback: OPEN_LOOP
    max_velocity: [0.5, 0.0, 2.0]
    min_velocity: [-0.5, 0.0, -2.0]
    max_accel: [2.5, 0.0, 3.2]
    max_decel: [-2.5, 0.0, -3.2]
    velocity_timeout: 1.0
collision_monitor:
  ros__parameters:
    base_frame_id: base_link
    odom_frame_id: odom
    cmd_vel_in_topic: cmd_vel_smoothed
    cmd_vel_out_topic: cmd_vel
    state_topic: collision_monitor_state
    transform_tolerance: 0.2
    source_timeout: 1.0
    base_shift_correction: true
    stop_pub_timeout: 2.0
    polygons: [FootprintApproach]
    FootprintApproach:
      type: polygon
      action_type: approach
      footprint_topic: /local_costmap/published_footprint
      time_before_collision: 1.2
      simulation_time_step: 0.1
      min_points: 6
    observation_sources: [scan]
    scan: {type: scan, topic: scan, min_height: -1.0, max_height: 2.0}
";
