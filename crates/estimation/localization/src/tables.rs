//! The parameters of AMCL, by the names and with the defaults that Nav2 has for them. Names of ROS 1
//! are read as well.
//!
//! Sources: `nav2_amcl/src/amcl_node.cpp` (main, 2026); `amcl/cfg/AMCL.cfg` and the wiki of ROS 1 for
//! its names.

use periplus_params::{NamedEntity, Table, choice, flag, integer, number, text};

/// Of the node.
pub static AMCL: Table = Table {
    name: "AMCL",
    doc: "Where the robot is on a known map.",
    parameters: &[
        number("alpha1", "", "Error of turns by turns.").or("0.2").min(0.0).also(&["odom_alpha1"]),
        number("alpha2", "", "Error of turns by ways.").or("0.2").min(0.0).also(&["odom_alpha2"]),
        number("alpha3", "", "Error of ways by ways.").or("0.2").min(0.0).also(&["odom_alpha3"]),
        number("alpha4", "", "Error of ways by turns.").or("0.2").min(0.0).also(&["odom_alpha4"]),
        number("alpha5", "", "Error across the way, of robots that go in any direction.")
            .or("0.2")
            .min(0.0)
            .also(&["odom_alpha5"]),
        text("base_frame_id", "The frame of the robot.")
            .or("base_footprint")
            .naming(NamedEntity::Frame),
        number("beam_skip_distance", "m", "A beam agrees with a particle when it ends nearer.")
            .or("0.5")
            .min(0.0),
        number("beam_skip_error_threshold", "", "With such a share skipped, all are used.")
            .or("0.9")
            .within(0.0, 1.0),
        number("beam_skip_threshold", "", "Beams that agree with no larger share are skipped.")
            .or("0.3")
            .within(0.0, 1.0),
        flag("do_beamskip", "Whether `likelihood_field_prob` skips beams.").or("false"),
        text("global_frame_id", "The frame of the map.").or("map").naming(NamedEntity::Frame),
        number("lambda_short", "1/m", "How quickly early ends of beams become rare.")
            .or("0.1")
            .min(0.0)
            .also(&["laser_lambda_short"]),
        number("laser_likelihood_max_dist", "m", "Distances to walls count up to here.")
            .or("2")
            .above(0.0),
        number("laser_max_range", "m", "Longer readings saw nothing; -1 for what scans say.")
            .or("100"),
        number("laser_min_range", "m", "Shorter readings mean nothing; -1 for what scans say.")
            .or("-1"),
        choice(
            "laser_model_type",
            &["likelihood_field", "beam", "likelihood_field_prob"],
            "How scans are held against the map.",
        )
        .or("likelihood_field"),
        flag("set_initial_pose", "Whether to start at `initial_pose`.").or("false"),
        number("initial_pose.x", "m", "Where to start.").or("0").also(&["initial_pose_x"]),
        number("initial_pose.y", "m", "Where to start.").or("0").also(&["initial_pose_y"]),
        number("initial_pose.z", "m", "Unused; the robot is on the plane.").or("0"),
        number("initial_pose.yaw", "rad", "Where to start.").or("0").also(&["initial_pose_a"]),
        number("initial_cov_xx", "m^2", "How uncertain the start is.").or("0.25").min(0.0),
        number("initial_cov_yy", "m^2", "How uncertain the start is.").or("0.25").min(0.0),
        number("initial_cov_aa", "rad^2", "How uncertain the start is.")
            .or("0.06853891909122467")
            .min(0.0),
        flag("always_reset_initial_pose", "Whether each activation starts anew.").or("false"),
        integer("max_beams", "How many beams of a scan are used, about.")
            .or("60")
            .within(2.0, 100_000.0)
            .also(&["laser_max_beams"]),
        integer("max_particles", "Never more particles.").or("2000").within(1.0, 10_000_000.0),
        integer("min_particles", "Never fewer particles.").or("500").within(1.0, 10_000_000.0),
        text("odom_frame_id", "The frame of odometry.").or("odom").naming(NamedEntity::Frame),
        number("pf_err", "", "By how much particles may be wrong about the distribution.")
            .or("0.05")
            .above(0.0)
            .also(&["kld_err"]),
        number("pf_z", "", "Quantile for it, of the normal distribution.")
            .or("0.99")
            .min(0.0)
            .also(&["kld_z"]),
        number("recovery_alpha_fast", "", "Memory of the short-term likelihood; 0 for none.")
            .or("0")
            .within(0.0, 1.0),
        number("recovery_alpha_slow", "", "Memory of the long-term likelihood; 0 for none.")
            .or("0")
            .within(0.0, 1.0),
        integer("resample_interval", "Scans from one resampling to the next.")
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
            "How the robot can move.",
        )
        .or("nav2_amcl::DifferentialMotionModel")
        .also(&["odom_model_type"]),
        number("save_pose_rate", "Hz", "How often the pose is saved; 0 for never.").or("0.5"),
        flag("initialize_at_saved_pose", "Whether to start at the saved pose.").or("false"),
        text("saved_pose_filepath", "Where the pose is saved.").or(""),
        number("sigma_hit", "m", "Standard deviation of what hits the map's walls.")
            .or("0.2")
            .above(0.0)
            .also(&["laser_sigma_hit"]),
        flag("tf_broadcast", "Whether the transform from map to odometry is sent.").or("true"),
        number("transform_tolerance", "s", "How long the transform holds.").or("1").min(0.0),
        number("update_min_a", "rad", "No scan is used before the robot turned more.")
            .or("0.2")
            .min(0.0),
        number("update_min_d", "m", "No scan is used before the robot moved more.")
            .or("0.25")
            .min(0.0),
        number("z_hit", "", "Share of beams that hit what the map has.")
            .or("0.5")
            .within(0.0, 1.0)
            .also(&["laser_z_hit"]),
        number("z_max", "", "Share of beams that see nothing.")
            .or("0.05")
            .within(0.0, 1.0)
            .also(&["laser_z_max"]),
        number("z_rand", "", "Share of beams that measure anything.")
            .or("0.5")
            .within(0.0, 1.0)
            .also(&["laser_z_rand"]),
        number("z_short", "", "Share of beams that end early.")
            .or("0.05")
            .within(0.0, 1.0)
            .also(&["laser_z_short"]),
        flag("first_map_only", "Whether maps after the first are ignored.").or("false"),
        text("scan_topic", "Topic of scans.").or("scan").naming(NamedEntity::Topic),
        text("map_topic", "Topic of the map.").or("map").naming(NamedEntity::Topic),
        flag("freespace_downsampling", "Whether only every other free cell is kept each way.")
            .or("false"),
        integer("random_seed", "Seed of all randomness; -1 leaves the choice to the node.")
            .or("-1"),
        flag("selective_resampling", "Whether to resample only when few particles count.")
            .or("false"),
        flag("global_start", "Whether to look on all of the map when nobody says where to start.")
            .or("true"),
        flag("scan_match", "Whether estimates are refined by drawing the scan to the walls.")
            .or("true"),
        flag("search_when_lost", "Whether a robot that is lost is looked for on all of the map.")
            .or("true"),
        flag("use_map_topic", "Whether the map comes by its topic; else by service `static_map`.")
            .or("true"),
        flag("use_sim_time", "Whether time comes from `/clock`.").or("false"),
        choice(
            "compat",
            &["none", "nav2"],
            "Whether to keep habits of Nav2 that are faults: a map half a cell off, averages that \
             depend on the number of particles, starts far outside of the map.",
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
