//! The parameters of `slam_toolbox`.
//!
//! Sources of names and defaults: its README and the files in its `config` folder (humble to
//! rolling, 2026).

use periplus_params::{NamedEntity, param_choice, params};

use super::{Idle, MountingParams};

param_choice! {
    /// Mode of the node.
    pub enum ToolboxMode {
        /// The map grows.
        #[default]
        Mapping = "mapping",
        /// The robot is localized on a stored map.
        Localization = "localization",
    }
}

params! {
    /// Pose graph SLAM from laser scans and odometry.
    #[table(SLAM_TOOLBOX, "slam_toolbox")]
    pub struct SlamToolboxParams {
        // Frames, topics, time.
        /// Frame of odometry.
        #[param("odom_frame", naming(NamedEntity::Frame))]
        odom_frame: String = "odom",
        /// Frame of the map.
        #[param("map_frame", naming(NamedEntity::Frame))]
        map_frame: String = "map",
        /// Frame of the robot base.
        #[param("base_frame", naming(NamedEntity::Frame))]
        base_frame: String = "base_footprint",
        /// Topic of the laser scans.
        #[param("scan_topic", naming(NamedEntity::Topic))]
        scan_topic: String = "/scan",
        /// Topic of the map.
        #[param("map_name", naming(NamedEntity::Topic))]
        map_name: String = "/map",
        /// `mapping`: the map grows; `localization`: the robot is localized on a stored map.
        #[param("mode")]
        mode: ToolboxMode = "mapping",
        /// If true, use simulated time (`/clock`).
        #[param("use_sim_time")]
        use_sim_time: bool = false,
        /// If true, log debug messages.
        #[param("debug_logging")]
        debug_logging: bool = false,
        /// Use every Nth scan.
        #[param("throttle_scans", min(1.0))]
        throttle_scans: usize = 1,
        /// Maximum number of scans that wait for their transforms.
        #[param("scan_queue_size", within(1.0, 100_000.0))]
        scan_queue_size: usize = 1,
        /// Minimum time between two scans that are used.
        #[param("minimum_time_interval", unit("s"), min(0.0))]
        minimum_time_interval_s: f64 = 0.5,
        /// Period of the transform `map -> odom`; 0: never published.
        #[param("transform_publish_period", unit("s"), min(0.0))]
        transform_publish_period_s: f64 = 0.02,
        /// Maximum time to wait for a transform.
        #[param("transform_timeout", unit("s"), min(0.0))]
        transform_timeout_s: f64 = 0.2,
        /// Duration of the transform buffer.
        #[param("tf_buffer_duration", unit("s"), above(0.0))]
        tf_buffer_duration_s: f64 = 30,
        /// If true, `map -> odom` is stamped with the time of publication.
        #[param("restamp_tf")]
        restamp_tf: bool = false,
        /// Period of the published map.
        #[param("map_update_interval", unit("s"), min(0.0))]
        map_update_interval_s: f64 = 5,
        /// If true, the service `save_map` is offered.
        #[param("use_map_saver")]
        use_map_saver: bool = true,
        /// If true, a lifecycle manager configures and activates the node.
        #[param("use_lifecycle_manager")]
        use_lifecycle_manager: bool = false,
        /// If true, poses can be moved manually.
        #[param("enable_interactive_mode")]
        enable_interactive_mode: bool = true,
        /// State: true while poses can be moved manually.
        #[param("interactive_mode")]
        _: bool = false,
        /// If true, new scans are ignored.
        #[param("paused_new_measurements")]
        paused_new_measurements: bool = false,
        /// State: true while waiting scans are not processed.
        #[param("paused_processing")]
        _: bool = false,
        /// Stored pose graph to load at the start.
        #[param("map_file_name")]
        map_file_name: String = "",
        /// Pose of the robot on the stored map: x, y, yaw.
        #[param("map_start_pose", unit("m, rad"))]
        map_start_pose: Vec<f64>,
        /// If true, the robot is at the first pose of the stored graph.
        #[param("map_start_at_dock")]
        map_start_at_dock: Option<bool>,
        /// Scale applied to the position covariance published in `pose`.
        #[param("position_covariance_scale", min(0.0))]
        position_covariance_scale: f64 = 1,
        /// Scale applied to the yaw covariance published in `pose`.
        #[param("yaw_covariance_scale", min(0.0))]
        yaw_covariance_scale: f64 = 1,
        /// Stack size for storing maps [bytes].
        #[param("stack_size_to_use", min(0.0))]
        _: usize = 40000000,
        // The map and what is used of scans.
        /// Cell size of the map.
        #[param("resolution", unit("m"), within(0.005, 2.0))]
        resolution_m: f64 = 0.05,
        /// Maximum range of readings that are used.
        #[param("max_laser_range", unit("m"), above(0.0))]
        max_laser_range_m: f64 = 60,
        /// Minimum range of readings that are used.
        #[param("min_laser_range", unit("m"), min(0.0))]
        min_laser_range_m: f64 = 0,
        /// Minimum fraction of hits of an occupied cell.
        #[param("occupancy_threshold", within(0.0, 1.0))]
        _: f64 = 0.1,
        /// Minimum number of beams through a known cell.
        #[param("min_pass_through", min(0.0))]
        _: usize = 2,
        /// If true, scans are matched with each other.
        #[param("use_scan_matching")]
        _: bool = true,
        /// If true, distances are measured between the centres of scans.
        #[param("use_scan_barycenter")]
        _: bool = true,
        /// Minimum distance between keyframes.
        #[param("minimum_travel_distance", unit("m"), within(0.0, 1000.0))]
        minimum_travel_distance_m: f64 = 0.35,
        /// Minimum rotation between keyframes.
        #[param("minimum_travel_heading", unit("rad"), within(0.0, 1000.0))]
        minimum_travel_heading_rad: f64 = 0.26,
        /// If true, motion is measured by scan matching instead of odometry.
        #[param("check_min_dist_and_heading_precisely")]
        _: bool = true,
        /// Number of previous scans that a new scan is matched with.
        #[param("scan_buffer_size", within(1.0, 1000.0))]
        scan_buffer_size: usize = 8,
        /// Maximum distance of scans in the buffer.
        #[param("scan_buffer_maximum_scan_distance", unit("m"), min(0.0))]
        _: f64 = 10,
        /// Minimum response of a link between scans.
        #[param("link_match_minimum_response_fine")]
        _: f64 = 0.1,
        /// Maximum distance between linked scans.
        #[param("link_scan_maximum_distance", unit("m"), min(0.0))]
        _: f64 = 1.5,
        /// Correction of the mounting.
        #[shared]
        mounting: MountingParams,
        // Loops.
        /// If true, loops are closed.
        #[param("do_loop_closing")]
        do_loop_closing: bool = true,
        /// Maximum distance of loop candidates.
        #[param("loop_search_maximum_distance", unit("m"), min(0.0))]
        _: f64 = 3,
        /// Minimum number of consecutive scans of a loop candidate.
        #[param("loop_match_minimum_chain_size", min(0.0))]
        _: usize = 10,
        /// Maximum variance of a coarse loop match that is refined.
        #[param("loop_match_maximum_variance_coarse")]
        _: f64 = 3,
        /// Minimum response of a coarse loop match that is refined.
        #[param("loop_match_minimum_response_coarse")]
        _: f64 = 0.35,
        /// Minimum response of a loop closure.
        #[param("loop_match_minimum_response_fine")]
        _: f64 = 0.45,
        // How scans are searched.
        /// Size of the search window.
        #[param("correlation_search_space_dimension", unit("m"))]
        _: f64 = 0.5,
        /// Resolution of the search.
        #[param("correlation_search_space_resolution", unit("m"))]
        _: f64 = 0.01,
        /// Blur of the search.
        #[param("correlation_search_space_smear_deviation", unit("m"))]
        _: f64 = 0.1,
        /// Size of the search window of loops.
        #[param("loop_search_space_dimension", unit("m"))]
        _: f64 = 8,
        /// Resolution of the loop search.
        #[param("loop_search_space_resolution", unit("m"))]
        _: f64 = 0.05,
        /// Blur of the loop search.
        #[param("loop_search_space_smear_deviation", unit("m"))]
        _: f64 = 0.03,
        /// Penalty of deviations from the odometry position.
        #[param("distance_variance_penalty")]
        _: f64 = 0.5,
        /// Penalty of deviations from the odometry heading.
        #[param("angle_variance_penalty")]
        _: f64 = 1,
        /// Angular range of the fine search.
        #[param("fine_search_angle_offset", unit("rad"))]
        _: f64 = 0.00349,
        /// Angular range of the coarse search.
        #[param("coarse_search_angle_offset", unit("rad"))]
        _: f64 = 0.349,
        /// Angular resolution of the coarse search.
        #[param("coarse_angle_resolution", unit("rad"))]
        _: f64 = 0.0349,
        /// Minimum penalty factor of the heading.
        #[param("minimum_angle_penalty")]
        _: f64 = 0.9,
        /// Minimum penalty factor of the position.
        #[param("minimum_distance_penalty")]
        _: f64 = 0.5,
        /// If true, the search window is enlarged when no match is found.
        #[param("use_response_expansion")]
        _: bool = true,
        // The solver.
        /// Solver of the pose graph.
        #[param("solver_plugin")]
        _: String = "solver_plugins::CeresSolver",
        /// Setting of Ceres.
        #[param("ceres_linear_solver")]
        _: String = "SPARSE_NORMAL_CHOLESKY",
        /// Setting of Ceres.
        #[param("ceres_preconditioner")]
        _: String = "SCHUR_JACOBI",
        /// Setting of Ceres.
        #[param("ceres_trust_strategy")]
        _: String = "LEVENBERG_MARQUARDT",
        /// Setting of Ceres.
        #[param("ceres_dogleg_type")]
        _: String = "TRADITIONAL_DOGLEG",
        /// Setting of Ceres.
        #[param("ceres_loss_function")]
        _: String = "None",
        // Lifelong mapping.
        /// If true, nearby poses are found with a tree.
        #[param("lifelong_search_use_tree")]
        lifelong_search_use_tree: bool = false,
        /// Minimum score of a match.
        #[param("lifelong_minimum_score")]
        lifelong_minimum_score: f64 = 0.1,
        /// Minimum overlap of scans that show the same area.
        #[param("lifelong_iou_match")]
        lifelong_iou_match: f64 = 0.85,
        /// Score below which a pose is removed.
        #[param("lifelong_node_removal_score")]
        lifelong_node_removal_score: f64 = 0.04,
        /// Weight of overlap in the score.
        #[param("lifelong_overlap_score_scale")]
        lifelong_overlap_score_scale: f64 = 0.06,
        /// Weight of constraints in the score.
        #[param("lifelong_constraint_multiplier")]
        lifelong_constraint_multiplier: f64 = 0.08,
        /// Weight of nearby poses in the score.
        #[param("lifelong_nearby_penalty")]
        lifelong_nearby_penalty: f64 = 0.001,
        /// Weight of the number of candidates in the score.
        #[param("lifelong_candidates_scale")]
        lifelong_candidates_scale: f64 = 0.03,
        /// If true, localization starts when the node is configured.
        #[param("localization_on_configure")]
        localization_on_configure: bool = false,
    }
}

pub(super) const IDLE: &[Idle] = &[
    Idle {
        names: &[
            "solver_plugin",
            "ceres_linear_solver",
            "ceres_preconditioner",
            "ceres_trust_strategy",
            "ceres_dogleg_type",
            "ceres_loss_function",
        ],
        because: "the graph is solved by a built-in sparse Cholesky factorization; constraints that \
                  do not fit are down-weighted, and loop closures are verified first",
    },
    Idle {
        names: &[
            "correlation_search_space_dimension",
            "correlation_search_space_resolution",
            "correlation_search_space_smear_deviation",
            "distance_variance_penalty",
            "angle_variance_penalty",
            "fine_search_angle_offset",
            "coarse_search_angle_offset",
            "coarse_angle_resolution",
            "minimum_angle_penalty",
            "minimum_distance_penalty",
            "use_response_expansion",
        ],
        because: "the search window follows from the odometry noise of this robot, which is \
                  estimated while it drives",
    },
    Idle {
        names: &[
            "loop_search_maximum_distance",
            "loop_search_space_dimension",
            "loop_search_space_resolution",
            "loop_search_space_smear_deviation",
            "loop_match_minimum_chain_size",
            "loop_match_maximum_variance_coarse",
            "loop_match_minimum_response_coarse",
            "loop_match_minimum_response_fine",
        ],
        because: "the search region of loops follows from the uncertainty of the path; a loop is \
                  closed if scans do not contradict each other and other closures agree, and not by \
                  its response",
    },
    Idle {
        names: &[
            "link_match_minimum_response_fine",
            "link_scan_maximum_distance",
            "scan_buffer_maximum_scan_distance",
            "use_scan_barycenter",
        ],
        because: "the scans to match follow from the uncertainty of their poses",
    },
    Idle {
        names: &["use_scan_matching"],
        because: "without it there would be no map, only odometry; scans without a match are placed \
                  by odometry anyway",
    },
    Idle {
        names: &["check_min_dist_and_heading_precisely"],
        because: "motion is always measured by scan matching",
    },
    Idle {
        names: &["occupancy_threshold", "min_pass_through"],
        because: "cells hold log odds of hits and misses; a cell is published as occupied if its log \
                  odds are positive",
    },
    Idle {
        names: &["interactive_mode", "paused_processing"],
        because: "it is a state, initially false; the service \
                  `slam_toolbox/toggle_interactive_mode` changes it",
    },
    Idle { names: &["stack_size_to_use"], because: "storing a map needs no large stack" },
];
