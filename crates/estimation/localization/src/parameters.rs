//! Parameters of AMCL with the names and defaults of Nav2, and the names of ROS 1.
//!
//! Sources: `nav2_amcl/src/amcl_node.cpp` (main, 2026); `amcl/cfg/AMCL.cfg` and the ROS 1 wiki.

use periplus_params::{NamedEntity, ParamChoice, param_choice, params};

use crate::motion_model::MotionModel;
use crate::sensor_model::SensorModel;

param_choice! {
    /// Compatibility: `compat`.
    pub enum AmclCompat {
        /// Correct behaviour.
        #[default]
        None = "none",
        /// Behaviour of Nav2, including its defects.
        Nav2 = "nav2",
    }
}

/// Names of Nav2, its older names, and those of ROS 1.
impl ParamChoice for MotionModel {
    const WORDS: &'static [&'static str] = &[
        "nav2_amcl::DifferentialMotionModel",
        "nav2_amcl::OmniMotionModel",
        "differential",
        "omnidirectional",
        "diff",
        "omni",
        "diff-corrected",
        "omni-corrected",
    ];

    fn of_word(word: &str) -> Self {
        match word {
            "nav2_amcl::OmniMotionModel" | "omnidirectional" | "omni" | "omni-corrected" => {
                Self::Omnidirectional
            }
            _ => Self::Differential,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Differential => "nav2_amcl::DifferentialMotionModel",
            Self::Omnidirectional => "nav2_amcl::OmniMotionModel",
        }
    }
}

params! {
    /// Adaptive Monte Carlo localization on a known map.
    #[table(AMCL, "AMCL")]
    pub struct AmclParams {
        /// Rotation noise from rotation.
        #[param("alpha1", min(0.0), also(&["odom_alpha1"]))]
        alpha1: f64 = 0.2,
        /// Rotation noise from translation.
        #[param("alpha2", min(0.0), also(&["odom_alpha2"]))]
        alpha2: f64 = 0.2,
        /// Translation noise from translation.
        #[param("alpha3", min(0.0), also(&["odom_alpha3"]))]
        alpha3: f64 = 0.2,
        /// Translation noise from rotation.
        #[param("alpha4", min(0.0), also(&["odom_alpha4"]))]
        alpha4: f64 = 0.2,
        /// Strafe noise of the omnidirectional model.
        #[param("alpha5", min(0.0), also(&["odom_alpha5"]))]
        alpha5: f64 = 0.2,
        /// Frame of the robot base.
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_footprint",
        /// Maximum distance to a wall for a beam that agrees.
        #[param("beam_skip_distance", unit("m"), min(0.0))]
        beam_skip_distance_m: f64 = 0.5,
        /// Fraction of skipped beams from which on all are used.
        #[param("beam_skip_error_threshold", within(0.0, 1.0))]
        beam_skip_error_threshold: f64 = 0.9,
        /// Minimum fraction of particles that agree with a beam.
        #[param("beam_skip_threshold", within(0.0, 1.0))]
        beam_skip_threshold: f64 = 0.3,
        /// Enable beam skipping in `likelihood_field_prob`.
        #[param("do_beamskip")]
        do_beamskip: bool = false,
        /// Frame of the map.
        #[param("global_frame_id", naming(NamedEntity::Frame))]
        global_frame_id: String = "map",
        /// Decay rate of short readings in the beam model.
        #[param("lambda_short", unit("1/m"), min(0.0), also(&["laser_lambda_short"]))]
        lambda_short_per_m: f64 = 0.1,
        /// Maximum distance of the likelihood field.
        #[param("laser_likelihood_max_dist", unit("m"), above(0.0))]
        laser_likelihood_max_dist_m: f64 = 2,
        /// Maximum range; -1 for the maximum range of the scan.
        #[param("laser_max_range", unit("m"))]
        laser_max_range_m: f64 = 100,
        /// Minimum range; -1 for the minimum range of the scan.
        #[param("laser_min_range", unit("m"))]
        laser_min_range_m: f64 = -1,
        /// Sensor model.
        #[param("laser_model_type")]
        laser_model_type: SensorModel = "likelihood_field",
        /// Start at `initial_pose`.
        #[param("set_initial_pose")]
        set_initial_pose: bool = false,
        /// Initial x in the map.
        #[param("initial_pose.x", unit("m"), also(&["initial_pose_x"]))]
        initial_pose_x_m: f64 = 0,
        /// Initial y in the map.
        #[param("initial_pose.y", unit("m"), also(&["initial_pose_y"]))]
        initial_pose_y_m: f64 = 0,
        /// Unused: poses are planar.
        #[param("initial_pose.z", unit("m"))]
        _: f64 = 0,
        /// Initial yaw in the map.
        #[param("initial_pose.yaw", unit("rad"), also(&["initial_pose_a"]))]
        initial_pose_yaw_rad: f64 = 0,
        /// Variance of the initial x.
        #[param("initial_cov_xx", unit("m^2"), min(0.0))]
        initial_cov_xx_m2: f64 = 0.25,
        /// Variance of the initial y.
        #[param("initial_cov_yy", unit("m^2"), min(0.0))]
        initial_cov_yy_m2: f64 = 0.25,
        /// Variance of the initial yaw.
        #[param("initial_cov_aa", unit("rad^2"), min(0.0))]
        initial_cov_aa_rad2: f64 = 0.06853891909122467,
        /// Reset to the initial pose at each activation.
        #[param("always_reset_initial_pose")]
        always_reset_initial_pose: bool = false,
        /// Approximate number of beams used per scan.
        #[param("max_beams", within(2.0, 100_000.0), also(&["laser_max_beams"]))]
        max_beams: usize = 60,
        /// Maximum number of particles.
        #[param("max_particles", within(1.0, 10_000_000.0))]
        max_particles: usize = 2000,
        /// Minimum number of particles.
        #[param("min_particles", within(1.0, 10_000_000.0))]
        min_particles: usize = 500,
        /// Frame of odometry.
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Maximum error of the sampled distribution (KLD-sampling).
        #[param("pf_err", above(0.0), also(&["kld_err"]))]
        pf_err: f64 = 0.05,
        /// Standard normal quantile for `pf_err`.
        #[param("pf_z", min(0.0), also(&["kld_z"]))]
        pf_z: f64 = 0.99,
        /// Gain of the short-term likelihood average; 0 to disable.
        #[param("recovery_alpha_fast", within(0.0, 1.0))]
        recovery_alpha_fast: f64 = 0,
        /// Gain of the long-term likelihood average; 0 to disable.
        #[param("recovery_alpha_slow", within(0.0, 1.0))]
        recovery_alpha_slow: f64 = 0,
        /// Number of updates between resamplings.
        #[param("resample_interval", within(1.0, 1_000_000.0))]
        resample_interval: usize = 1,
        /// Motion model.
        #[param("robot_model_type", also(&["odom_model_type"]))]
        robot_model_type: MotionModel = "nav2_amcl::DifferentialMotionModel",
        /// Rate at which the pose is saved; 0 to disable.
        #[param("save_pose_rate", unit("Hz"))]
        save_pose_rate_hz: f64 = 0.5,
        /// Start at the saved pose.
        #[param("initialize_at_saved_pose")]
        initialize_at_saved_pose: bool = false,
        /// File of the saved pose.
        #[param("saved_pose_filepath")]
        saved_pose_filepath: String = "",
        /// Standard deviation of hits.
        #[param("sigma_hit", unit("m"), above(0.0), also(&["laser_sigma_hit"]))]
        sigma_hit_m: f64 = 0.2,
        /// Publish the transform from `global_frame_id` to `odom_frame_id`.
        #[param("tf_broadcast")]
        tf_broadcast: bool = true,
        /// Time by which the published transform is post-dated.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 1,
        /// Minimum rotation between updates.
        #[param("update_min_a", unit("rad"), min(0.0))]
        update_min_a_rad: f64 = 0.2,
        /// Minimum translation between updates.
        #[param("update_min_d", unit("m"), min(0.0))]
        update_min_d_m: f64 = 0.25,
        /// Weight of hits of mapped obstacles.
        #[param("z_hit", within(0.0, 1.0), also(&["laser_z_hit"]))]
        z_hit: f64 = 0.5,
        /// Weight of maximum range readings.
        #[param("z_max", within(0.0, 1.0), also(&["laser_z_max"]))]
        z_max: f64 = 0.05,
        /// Weight of random readings.
        #[param("z_rand", within(0.0, 1.0), also(&["laser_z_rand"]))]
        z_rand: f64 = 0.5,
        /// Weight of short readings.
        #[param("z_short", within(0.0, 1.0), also(&["laser_z_short"]))]
        z_short: f64 = 0.05,
        /// Ignore maps after the first.
        #[param("first_map_only")]
        first_map_only: bool = false,
        /// Topic of scans.
        #[param("scan_topic", naming(NamedEntity::Topic))]
        scan_topic: String = "scan",
        /// Topic of the map.
        #[param("map_topic", naming(NamedEntity::Topic))]
        map_topic: String = "map",
        /// Draw random poses from every second row and column of free cells.
        #[param("freespace_downsampling")]
        freespace_downsampling: bool = false,
        /// Seed of the random numbers; -1 for a default seed.
        #[param("random_seed")]
        random_seed: i64 = -1,
        /// Resample only when the effective sample size is low.
        #[param("selective_resampling")]
        selective_resampling: bool = false,
        /// Run global localization when no initial pose is set.
        #[param("global_start")]
        global_start: bool = true,
        /// Refine estimates by scan matching.
        #[param("scan_match")]
        scan_match: bool = true,
        /// Run global localization when the robot is lost.
        #[param("search_when_lost")]
        search_when_lost: bool = true,
        /// Receive the map on `map_topic`; otherwise call the service `static_map`.
        #[param("use_map_topic")]
        use_map_topic: bool = true,
        /// Use the time of `/clock`.
        #[param("use_sim_time")]
        use_sim_time: bool = false,
        /// Compatibility with defects of Nav2: a map half a cell off, averages that depend on the number
        /// of particles, initial poses far outside of the map.
        #[param("compat")]
        compat: AmclCompat = "none",
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_table_has_no_slips() {
        assert_eq!(super::AMCL.faults(), [""; 0]);
    }
}
