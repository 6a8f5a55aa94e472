//! The parameters of `slam_toolbox`.
//!
//! Sources of names and defaults: its README and the files in its `config` folder (humble to
//! rolling, 2026).

use periplus_params::{
    NamedEntity, ParamValues, Table, choice, flag, integer, number, numbers, text,
};

use super::{CORRECT_MOUNTING, Idle};
use crate::settings::Settings;

/// Parameters of the node `slam_toolbox`.
pub static SLAM_TOOLBOX: Table = Table {
    name: "slam_toolbox",
    doc: "Pose graph SLAM from laser scans and odometry.",
    parameters: &[
        // Frames, topics, time.
        text("odom_frame", "Frame of odometry.").or("odom").naming(NamedEntity::Frame),
        text("map_frame", "Frame of the map.").or("map").naming(NamedEntity::Frame),
        text("base_frame", "Frame of the robot base.")
            .or("base_footprint")
            .naming(NamedEntity::Frame),
        text("scan_topic", "Topic of the laser scans.").or("/scan").naming(NamedEntity::Topic),
        text("map_name", "Topic of the map.").or("/map").naming(NamedEntity::Topic),
        choice(
            "mode",
            &["mapping", "localization"],
            "`mapping`: the map grows; `localization`: the robot is localized on a stored map.",
        )
        .or("mapping"),
        flag("use_sim_time", "If true, use simulated time (`/clock`).").or("false"),
        flag("debug_logging", "If true, log debug messages.").or("false"),
        integer("throttle_scans", "Use every Nth scan.").or("1").min(1.0),
        integer("scan_queue_size", "Maximum number of scans that wait for their transforms.")
            .or("1")
            .within(1.0, 100_000.0),
        number("minimum_time_interval", "s", "Minimum time between two scans that are used.")
            .or("0.5")
            .min(0.0),
        number(
            "transform_publish_period",
            "s",
            "Period of the transform `map -> odom`; 0: never published.",
        )
        .or("0.02")
        .min(0.0),
        number("transform_timeout", "s", "Maximum time to wait for a transform.")
            .or("0.2")
            .min(0.0),
        number("tf_buffer_duration", "s", "Duration of the transform buffer.").or("30").above(0.0),
        flag("restamp_tf", "If true, `map -> odom` is stamped with the time of publication.")
            .or("false"),
        number("map_update_interval", "s", "Period of the published map.").or("5").min(0.0),
        flag("use_map_saver", "If true, the service `save_map` is offered.").or("true"),
        flag(
            "use_lifecycle_manager",
            "If true, a lifecycle manager configures and activates the node.",
        )
        .or("false"),
        flag("enable_interactive_mode", "If true, poses can be moved manually.").or("true"),
        flag("interactive_mode", "State: true while poses can be moved manually.").or("false"),
        flag("paused_new_measurements", "If true, new scans are ignored.").or("false"),
        flag("paused_processing", "State: true while waiting scans are not processed.").or("false"),
        text("map_file_name", "Stored pose graph to load at the start.").or(""),
        numbers("map_start_pose", "m, rad", "Pose of the robot on the stored map: x, y, yaw."),
        flag("map_start_at_dock", "If true, the robot is at the first pose of the stored graph."),
        number(
            "position_covariance_scale",
            "",
            "Scale applied to the position covariance published in `pose`.",
        )
        .or("1")
        .min(0.0),
        number(
            "yaw_covariance_scale",
            "",
            "Scale applied to the yaw covariance published in `pose`.",
        )
        .or("1")
        .min(0.0),
        integer("stack_size_to_use", "Stack size for storing maps [bytes].")
            .or("40000000")
            .min(0.0),
        // The map and what is used of scans.
        number("resolution", "m", "Cell size of the map.").or("0.05").within(0.005, 2.0),
        number("max_laser_range", "m", "Maximum range of readings that are used.")
            .or("60")
            .above(0.0),
        number("min_laser_range", "m", "Minimum range of readings that are used.").or("0").min(0.0),
        number("occupancy_threshold", "", "Minimum fraction of hits of an occupied cell.")
            .or("0.1")
            .within(0.0, 1.0),
        integer("min_pass_through", "Minimum number of beams through a known cell.")
            .or("2")
            .min(0.0),
        flag("use_scan_matching", "If true, scans are matched with each other.").or("true"),
        flag(
            "use_scan_barycenter",
            "If true, distances are measured between the centres of scans.",
        )
        .or("true"),
        number("minimum_travel_distance", "m", "Minimum distance between keyframes.")
            .or("0.35")
            .within(0.0, 1000.0),
        number("minimum_travel_heading", "rad", "Minimum rotation between keyframes.")
            .or("0.26")
            .within(0.0, 1000.0),
        flag(
            "check_min_dist_and_heading_precisely",
            "If true, motion is measured by scan matching instead of odometry.",
        )
        .or("true"),
        integer("scan_buffer_size", "Number of previous scans that a new scan is matched with.")
            .or("8")
            .within(1.0, 1000.0),
        number(
            "scan_buffer_maximum_scan_distance",
            "m",
            "Maximum distance of scans in the buffer.",
        )
        .or("10")
        .min(0.0),
        number("link_match_minimum_response_fine", "", "Minimum response of a link between scans.")
            .or("0.1"),
        number("link_scan_maximum_distance", "m", "Maximum distance between linked scans.")
            .or("1.5")
            .min(0.0),
        flag("correct_mounting", CORRECT_MOUNTING).or("true"),
        // Loops.
        flag("do_loop_closing", "If true, loops are closed.").or("true"),
        number("loop_search_maximum_distance", "m", "Maximum distance of loop candidates.")
            .or("3")
            .min(0.0),
        integer(
            "loop_match_minimum_chain_size",
            "Minimum number of consecutive scans of a loop candidate.",
        )
        .or("10")
        .min(0.0),
        number(
            "loop_match_maximum_variance_coarse",
            "",
            "Maximum variance of a coarse loop match that is refined.",
        )
        .or("3"),
        number(
            "loop_match_minimum_response_coarse",
            "",
            "Minimum response of a coarse loop match that is refined.",
        )
        .or("0.35"),
        number("loop_match_minimum_response_fine", "", "Minimum response of a loop closure.")
            .or("0.45"),
        // How scans are searched.
        number("correlation_search_space_dimension", "m", "Size of the search window.").or("0.5"),
        number("correlation_search_space_resolution", "m", "Resolution of the search.").or("0.01"),
        number("correlation_search_space_smear_deviation", "m", "Blur of the search.").or("0.1"),
        number("loop_search_space_dimension", "m", "Size of the search window of loops.").or("8"),
        number("loop_search_space_resolution", "m", "Resolution of the loop search.").or("0.05"),
        number("loop_search_space_smear_deviation", "m", "Blur of the loop search.").or("0.03"),
        number(
            "distance_variance_penalty",
            "",
            "Penalty of deviations from the odometry position.",
        )
        .or("0.5"),
        number("angle_variance_penalty", "", "Penalty of deviations from the odometry heading.")
            .or("1"),
        number("fine_search_angle_offset", "rad", "Angular range of the fine search.")
            .or("0.00349"),
        number("coarse_search_angle_offset", "rad", "Angular range of the coarse search.")
            .or("0.349"),
        number("coarse_angle_resolution", "rad", "Angular resolution of the coarse search.")
            .or("0.0349"),
        number("minimum_angle_penalty", "", "Minimum penalty factor of the heading.").or("0.9"),
        number("minimum_distance_penalty", "", "Minimum penalty factor of the position.").or("0.5"),
        flag(
            "use_response_expansion",
            "If true, the search window is enlarged when no match is found.",
        )
        .or("true"),
        // The solver.
        text("solver_plugin", "Solver of the pose graph.").or("solver_plugins::CeresSolver"),
        text("ceres_linear_solver", "Setting of Ceres.").or("SPARSE_NORMAL_CHOLESKY"),
        text("ceres_preconditioner", "Setting of Ceres.").or("SCHUR_JACOBI"),
        text("ceres_trust_strategy", "Setting of Ceres.").or("LEVENBERG_MARQUARDT"),
        text("ceres_dogleg_type", "Setting of Ceres.").or("TRADITIONAL_DOGLEG"),
        text("ceres_loss_function", "Setting of Ceres.").or("None"),
        // Lifelong mapping.
        flag("lifelong_search_use_tree", "If true, nearby poses are found with a tree.")
            .or("false"),
        number("lifelong_minimum_score", "", "Minimum score of a match.").or("0.1"),
        number("lifelong_iou_match", "", "Minimum overlap of scans that show the same area.")
            .or("0.85"),
        number("lifelong_node_removal_score", "", "Score below which a pose is removed.")
            .or("0.04"),
        number("lifelong_overlap_score_scale", "", "Weight of overlap in the score.").or("0.06"),
        number("lifelong_constraint_multiplier", "", "Weight of constraints in the score.")
            .or("0.08"),
        number("lifelong_nearby_penalty", "", "Weight of nearby poses in the score.").or("0.001"),
        number("lifelong_candidates_scale", "", "Weight of the number of candidates in the score.")
            .or("0.03"),
        flag(
            "localization_on_configure",
            "If true, localization starts when the node is configured.",
        )
        .or("false"),
    ],
};

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

pub(super) fn settings(values: &ParamValues) -> Settings {
    let mut settings = Settings::default();
    let number = |name: &str| values.number(name).filter(|_| values.is_given(name));
    if let Some(resolution_m) = number("resolution") {
        settings.resolution_m = resolution_m;
    }
    if let Some(range_m) = number("max_laser_range") {
        settings.range_max_m = range_m as f32;
    }
    if let Some(range_m) = number("min_laser_range") {
        settings.range_min_m = range_m as f32;
    }
    if let Some(shift_m) = number("minimum_travel_distance") {
        settings.keyframe_distance_m = shift_m;
    }
    if let Some(turn_rad) = number("minimum_travel_heading") {
        settings.keyframe_rotation_rad = turn_rad;
    }
    if let Some(scans) =
        values.integer("scan_buffer_size").filter(|_| values.is_given("scan_buffer_size"))
    {
        settings.local_scans = usize::try_from(scans).unwrap_or(1).max(1);
    }
    if let Some(closes_loops) = values.flag("do_loop_closing") {
        settings.closes_loops = closes_loops;
    }
    settings
}
