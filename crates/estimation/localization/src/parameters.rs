//! Parameters of AMCL with the names and defaults of Nav2, and the names of ROS 1.
//!
//! Sources: `nav2_amcl/src/amcl_node.cpp` (main, 2026); `amcl/cfg/AMCL.cfg` and the ROS 1 wiki.

use periplus_params::{NamedEntity, Table, choice, flag, integer, number, text};

/// Parameters of the node.
pub static AMCL: Table = Table {
    name: "AMCL",
    doc: "Adaptive Monte Carlo localization on a known map.",
    parameters: &[
        number("alpha1", "", "Rotation noise from rotation.").or("0.2").min(0.0).also(&["odom_alpha1"]),
        number("alpha2", "", "Rotation noise from translation.").or("0.2").min(0.0).also(&["odom_alpha2"]),
        number("alpha3", "", "Translation noise from translation.").or("0.2").min(0.0).also(&["odom_alpha3"]),
        number("alpha4", "", "Translation noise from rotation.").or("0.2").min(0.0).also(&["odom_alpha4"]),
        number("alpha5", "", "Strafe noise of the omnidirectional model.")
            .or("0.2")
            .min(0.0)
            .also(&["odom_alpha5"]),
        text("base_frame_id", "Frame of the robot base.").or("base_footprint").naming(NamedEntity::Frame),
        number("beam_skip_distance", "m", "Maximum distance to a wall for a beam that agrees.")
            .or("0.5")
            .min(0.0),
        number("beam_skip_error_threshold", "", "Fraction of skipped beams from which on all are used.")
            .or("0.9")
            .within(0.0, 1.0),
        number("beam_skip_threshold", "", "Minimum fraction of particles that agree with a beam.")
            .or("0.3")
            .within(0.0, 1.0),
        flag("do_beamskip", "Enable beam skipping in `likelihood_field_prob`.").or("false"),
        text("global_frame_id", "Frame of the map.").or("map").naming(NamedEntity::Frame),
        number("lambda_short", "1/m", "Decay rate of short readings in the beam model.")
            .or("0.1")
            .min(0.0)
            .also(&["laser_lambda_short"]),
        number("laser_likelihood_max_dist", "m", "Maximum distance of the likelihood field.")
            .or("2")
            .above(0.0),
        number("laser_max_range", "m", "Maximum range; -1 for the maximum range of the scan.")
            .or("100"),
        number("laser_min_range", "m", "Minimum range; -1 for the minimum range of the scan.")
            .or("-1"),
        choice(
            "laser_model_type",
            &["likelihood_field", "beam", "likelihood_field_prob"],
            "Sensor model.",
        )
        .or("likelihood_field"),
        flag("set_initial_pose", "Start at `initial_pose`.").or("false"),
        number("initial_pose.x", "m", "Initial x in the map.").or("0").also(&["initial_pose_x"]),
        number("initial_pose.y", "m", "Initial y in the map.").or("0").also(&["initial_pose_y"]),
        number("initial_pose.z", "m", "Unused: poses are planar.").or("0"),
        number("initial_pose.yaw", "rad", "Initial yaw in the map.").or("0").also(&["initial_pose_a"]),
        number("initial_cov_xx", "m^2", "Variance of the initial x.").or("0.25").min(0.0),
        number("initial_cov_yy", "m^2", "Variance of the initial y.").or("0.25").min(0.0),
        number("initial_cov_aa", "rad^2", "Variance of the initial yaw.")
            .or("0.06853891909122467")
            .min(0.0),
        flag("always_reset_initial_pose", "Reset to the initial pose at each activation.").or("false"),
        integer("max_beams", "Approximate number of beams used per scan.")
            .or("60")
            .within(2.0, 100_000.0)
            .also(&["laser_max_beams"]),
        integer("max_particles", "Maximum number of particles.").or("2000").within(1.0, 10_000_000.0),
        integer("min_particles", "Minimum number of particles.").or("500").within(1.0, 10_000_000.0),
        text("odom_frame_id", "Frame of odometry.").or("odom").naming(NamedEntity::Frame),
        number("pf_err", "", "Maximum error of the sampled distribution (KLD-sampling).")
            .or("0.05")
            .above(0.0)
            .also(&["kld_err"]),
        number("pf_z", "", "Standard normal quantile for `pf_err`.")
            .or("0.99")
            .min(0.0)
            .also(&["kld_z"]),
        number("recovery_alpha_fast", "", "Gain of the short-term likelihood average; 0 to disable.")
            .or("0")
            .within(0.0, 1.0),
        number("recovery_alpha_slow", "", "Gain of the long-term likelihood average; 0 to disable.")
            .or("0")
            .within(0.0, 1.0),
        integer("resample_interval", "Number of updates between resamplings.")
            .or("1")
            .within(1.0, 1_000_000.0),
        choice(
            "robot_model_type",
            &[
                "nav2_amcl::DifferentialMotionModel",
                "nav2_amcl::OmniMotionModel",
                "differential",
                "omnidirectional",
                "diff",
                "omni",
                "diff-corrected",
                "omni-corrected",
            ],
            "Motion model.",
        )
        .or("nav2_amcl::DifferentialMotionModel")
        .also(&["odom_model_type"]),
        number("save_pose_rate", "Hz", "Rate at which the pose is saved; 0 to disable.").or("0.5"),
        flag("initialize_at_saved_pose", "Start at the saved pose.").or("false"),
        text("saved_pose_filepath", "File of the saved pose.").or(""),
        number("sigma_hit", "m", "Standard deviation of hits.")
            .or("0.2")
            .above(0.0)
            .also(&["laser_sigma_hit"]),
        flag("tf_broadcast", "Publish the transform from `global_frame_id` to `odom_frame_id`.").or("true"),
        number("transform_tolerance", "s", "Time by which the published transform is post-dated.").or("1").min(0.0),
        number("update_min_a", "rad", "Minimum rotation between updates.")
            .or("0.2")
            .min(0.0),
        number("update_min_d", "m", "Minimum translation between updates.")
            .or("0.25")
            .min(0.0),
        number("z_hit", "", "Weight of hits of mapped obstacles.")
            .or("0.5")
            .within(0.0, 1.0)
            .also(&["laser_z_hit"]),
        number("z_max", "", "Weight of maximum range readings.")
            .or("0.05")
            .within(0.0, 1.0)
            .also(&["laser_z_max"]),
        number("z_rand", "", "Weight of random readings.")
            .or("0.5")
            .within(0.0, 1.0)
            .also(&["laser_z_rand"]),
        number("z_short", "", "Weight of short readings.")
            .or("0.05")
            .within(0.0, 1.0)
            .also(&["laser_z_short"]),
        flag("first_map_only", "Ignore maps after the first.").or("false"),
        text("scan_topic", "Topic of scans.").or("scan").naming(NamedEntity::Topic),
        text("map_topic", "Topic of the map.").or("map").naming(NamedEntity::Topic),
        flag("freespace_downsampling", "Draw random poses from every second row and column of free cells.")
            .or("false"),
        integer("random_seed", "Seed of the random numbers; -1 for a default seed.")
            .or("-1"),
        flag("selective_resampling", "Resample only when the effective sample size is low.")
            .or("false"),
        flag("global_start", "Run global localization when no initial pose is set.")
            .or("true"),
        flag("scan_match", "Refine estimates by scan matching.")
            .or("true"),
        flag("search_when_lost", "Run global localization when the robot is lost.")
            .or("true"),
        flag("use_map_topic", "Receive the map on `map_topic`; otherwise call the service `static_map`.")
            .or("true"),
        flag("use_sim_time", "Use the time of `/clock`.").or("false"),
        choice(
            "compat",
            &["none", "nav2"],
            "Compatibility with defects of Nav2: a map half a cell off, averages that depend on the \
             number of particles, initial poses far outside of the map.",
        )
        .or("none"),
    ],
};

#[cfg(test)]
mod tests {
    #[test]
    fn the_table_has_no_slips() {
        assert_eq!(super::AMCL.faults(), [""; 0]);
    }
}
