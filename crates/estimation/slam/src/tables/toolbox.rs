//! The parameters of `slam_toolbox`.
//!
//! Sources of names and defaults: its README and the files in its `config` folder (humble to
//! rolling, 2026).

use periplus_params::{Names, Table, Values, choice, flag, integer, number, numbers, text};

use super::{CORRECT_MOUNTING, Idle};
use crate::settings::Settings;

/// Of the node.
pub static SLAM_TOOLBOX: Table = Table {
    name: "slam_toolbox",
    doc: "A map from scans and odometry, as a graph of poses.",
    parameters: &[
        // Frames, topics, time.
        text("odom_frame", "The frame of odometry.").or("odom").naming(Names::Frame),
        text("map_frame", "The frame of the map.").or("map").naming(Names::Frame),
        text("base_frame", "The frame of the robot.").or("base_footprint").naming(Names::Frame),
        text("scan_topic", "Topic of scans.").or("/scan").naming(Names::Topic),
        text("map_name", "Topic of the map.").or("/map").naming(Names::Topic),
        choice(
            "mode",
            &["mapping", "localization"],
            "Whether the map grows, or the robot is only found on a stored one.",
        )
        .or("mapping"),
        flag("use_sim_time", "Whether time comes from `/clock`.").or("false"),
        flag("debug_logging", "Whether the node tells more.").or("false"),
        integer("throttle_scans", "Every so manieth scan is used.").or("1").min(1.0),
        integer("scan_queue_size", "Scans that wait for their transforms, at most.")
            .or("1")
            .within(1.0, 100_000.0),
        number("minimum_time_interval", "s", "No scan is used sooner after the last one.")
            .or("0.5")
            .min(0.0),
        number("transform_publish_period", "s", "How often `map -> odom` is sent; 0 for never.")
            .or("0.02")
            .min(0.0),
        number("transform_timeout", "s", "How long a transform is waited for.").or("0.2").min(0.0),
        number("tf_buffer_duration", "s", "How long transforms are remembered.")
            .or("30")
            .above(0.0),
        flag("restamp_tf", "Whether `map -> odom` carries the time of sending.").or("false"),
        number("map_update_interval", "s", "How often the map is sent.").or("5").min(0.0),
        flag("use_map_saver", "Whether the service `save_map` is offered.").or("true"),
        flag("use_lifecycle_manager", "Whether a manager of lifecycles looks after the node.")
            .or("false"),
        flag("enable_interactive_mode", "Whether poses can be moved by hand.").or("true"),
        flag("interactive_mode", "State: true while poses can be moved by hand.").or("false"),
        flag("paused_new_measurements", "True while new scans are left out.").or("false"),
        flag("paused_processing", "State: true while waiting scans are not processed.").or("false"),
        text("map_file_name", "A stored pose graph to begin with.").or(""),
        numbers("map_start_pose", "m, rad", "Where on it the robot is: x, y, yaw."),
        flag("map_start_at_dock", "Whether the robot is where the stored graph began."),
        number("position_covariance_scale", "", "Times the covariance of the place in `pose`.")
            .or("1")
            .min(0.0),
        number("yaw_covariance_scale", "", "Times the covariance of the heading in `pose`.")
            .or("1")
            .min(0.0),
        integer("stack_size_to_use", "Bytes of stack for the storing of maps.")
            .or("40000000")
            .min(0.0),
        // The map and what is used of scans.
        number("resolution", "m", "Side of a cell of the map.").or("0.05").within(0.005, 2.0),
        number("max_laser_range", "m", "Readings from farther away are not used.")
            .or("60")
            .above(0.0),
        number("min_laser_range", "m", "Nearer readings are not used.").or("0").min(0.0),
        number("occupancy_threshold", "", "A cell is occupied from this share of hits.")
            .or("0.1")
            .within(0.0, 1.0),
        integer("min_pass_through", "A cell is known from so many beams.").or("2").min(0.0),
        flag("use_scan_matching", "Whether scans are laid onto each other.").or("true"),
        flag("use_scan_barycenter", "Whether distances are between the middles of scans.")
            .or("true"),
        number("minimum_travel_distance", "m", "A scan is kept after so much motion ...")
            .or("0.35")
            .within(0.0, 1000.0),
        number("minimum_travel_heading", "rad", "... or turn from the last one kept.")
            .or("0.26")
            .within(0.0, 1000.0),
        flag(
            "check_min_dist_and_heading_precisely",
            "Whether motion is measured by what scans say, and not by odometry.",
        )
        .or("true"),
        integer("scan_buffer_size", "Scans before that a new one is laid onto.")
            .or("8")
            .within(1.0, 1000.0),
        number("scan_buffer_maximum_scan_distance", "m", "Scans from farther away are not.")
            .or("10")
            .min(0.0),
        number("link_match_minimum_response_fine", "", "Response from which scans are linked.")
            .or("0.1"),
        number("link_scan_maximum_distance", "m", "Scans farther apart are not linked.")
            .or("1.5")
            .min(0.0),
        flag("correct_mounting", CORRECT_MOUNTING).or("true"),
        // Loops.
        flag("do_loop_closing", "Whether loops are closed.").or("true"),
        number("loop_search_maximum_distance", "m", "Loops are searched within.").or("3").min(0.0),
        integer("loop_match_minimum_chain_size", "Scans in a row of which a loop is made.")
            .or("10")
            .min(0.0),
        number("loop_match_maximum_variance_coarse", "", "Variance up to which a loop is refined.")
            .or("3"),
        number("loop_match_minimum_response_coarse", "", "Response from which it is refined.")
            .or("0.35"),
        number("loop_match_minimum_response_fine", "", "Response from which it is closed.")
            .or("0.45"),
        // How scans are searched.
        number("correlation_search_space_dimension", "m", "Width of the search.").or("0.5"),
        number("correlation_search_space_resolution", "m", "Step of the search.").or("0.01"),
        number("correlation_search_space_smear_deviation", "m", "Blur of the search.").or("0.1"),
        number("loop_search_space_dimension", "m", "Width of the search for loops.").or("8"),
        number("loop_search_space_resolution", "m", "Step of the search for loops.").or("0.05"),
        number("loop_search_space_smear_deviation", "m", "Blur of the search for loops.")
            .or("0.03"),
        number("distance_variance_penalty", "", "How leaving odometry's place is punished.")
            .or("0.5"),
        number("angle_variance_penalty", "", "How leaving odometry's heading is punished.").or("1"),
        number("fine_search_angle_offset", "rad", "Width of the fine search.").or("0.00349"),
        number("coarse_search_angle_offset", "rad", "Width of the coarse search.").or("0.349"),
        number("coarse_angle_resolution", "rad", "Step of the coarse search.").or("0.0349"),
        number("minimum_angle_penalty", "", "Least factor for heading.").or("0.9"),
        number("minimum_distance_penalty", "", "Least factor for place.").or("0.5"),
        flag("use_response_expansion", "Whether the search widens when nothing fits.").or("true"),
        // The solver.
        text("solver_plugin", "What solves the graph.").or("solver_plugins::CeresSolver"),
        text("ceres_linear_solver", "Of Ceres.").or("SPARSE_NORMAL_CHOLESKY"),
        text("ceres_preconditioner", "Of Ceres.").or("SCHUR_JACOBI"),
        text("ceres_trust_strategy", "Of Ceres.").or("LEVENBERG_MARQUARDT"),
        text("ceres_dogleg_type", "Of Ceres.").or("TRADITIONAL_DOGLEG"),
        text("ceres_loss_function", "Of Ceres.").or("None"),
        // Lifelong mapping.
        flag("lifelong_search_use_tree", "Whether near poses are found by a tree.").or("false"),
        number("lifelong_minimum_score", "", "Score below which a match is none.").or("0.1"),
        number("lifelong_iou_match", "", "Overlap from which scans show the same.").or("0.85"),
        number("lifelong_node_removal_score", "", "Score below which a pose goes.").or("0.04"),
        number("lifelong_overlap_score_scale", "", "Weight of overlap in the score.").or("0.06"),
        number("lifelong_constraint_multiplier", "", "Weight of links in the score.").or("0.08"),
        number("lifelong_nearby_penalty", "", "Weight of neighbours in the score.").or("0.001"),
        number("lifelong_candidates_scale", "", "Weight of how many compete.").or("0.03"),
        flag("localization_on_configure", "Whether to localize as soon as it is set up.")
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
        because: "the graph is solved by a sparse Cholesky factorization of its own; proximity that do \
                  not fit lose their weight by themselves, and closures of loops are verified before \
                  they count",
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
        because: "a scan is searched for in the window that the errors of this robot's odometry ask \
                  for; they are learnt as it drives",
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
        because: "loops are searched as far as the way since then can have erred, and are believed \
                  when scans do not contradict each other and other closures agree, not for a \
                  response",
    },
    Idle {
        names: &[
            "link_match_minimum_response_fine",
            "link_scan_maximum_distance",
            "scan_buffer_maximum_scan_distance",
            "use_scan_barycenter",
        ],
        because: "which scans are laid onto each other follows from how well their places are known",
    },
    Idle {
        names: &["use_scan_matching"],
        because: "without it there would be no map, only odometry; scans that do not fit are placed \
                  by odometry alone anyway",
    },
    Idle {
        names: &["check_min_dist_and_heading_precisely"],
        because: "motion is always measured by what scans say",
    },
    Idle {
        names: &["occupancy_threshold", "min_pass_through"],
        because: "cells hold log odds of hits and misses; a published map has a wall where more spoke \
                  for it than against it",
    },
    Idle {
        names: &["interactive_mode", "paused_processing"],
        because: "it shows a state, which begins as false; the service \
                  `slam_toolbox/toggle_interactive_mode` changes it",
    },
    Idle { names: &["stack_size_to_use"], because: "storing a map needs no large stack" },
];

pub(super) fn settings(values: &Values) -> Settings {
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
