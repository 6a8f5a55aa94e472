//! The parameters of `slam_gmapping`.
//!
//! Source of names and defaults: its wiki page and the documentation in its source (ROS 1, noetic).
//! The wiki has `srt` and `str` the other way round than the program: what it does counts.

use periplus_diagnostics::Diagnostic;
use periplus_params::{NamedEntity, ParamValues, params};

use super::{Idle, MountingParams};
use crate::gmapping::{GmappingSettings, Noise};

params! {
    /// Particle filter SLAM from laser scans and odometry, with one map per particle.
    #[table(GMAPPING, "slam_gmapping")]
    pub struct GmappingParams {
        // Frames, topics, time.
        /// Frame of the robot base.
        #[param("base_frame", naming(NamedEntity::Frame))]
        base_frame: String = "base_link",
        /// Frame of the map.
        #[param("map_frame", naming(NamedEntity::Frame))]
        map_frame: String = "map",
        /// Frame of odometry.
        #[param("odom_frame", naming(NamedEntity::Frame))]
        odom_frame: String = "odom",
        /// Use every Nth scan.
        #[param("throttle_scans", min(1.0))]
        throttle_scans: usize = 1,
        /// Period of the published map.
        #[param("map_update_interval", unit("s"), min(0.0))]
        map_update_interval_s: f64 = 5,
        /// Period of the transform `map -> odom`; 0: never published.
        #[param("transform_publish_period", unit("s"), min(0.0))]
        transform_publish_period_s: f64 = 0.05,
        /// Time by which the stamp of `map -> odom` is ahead (default: the publication period).
        #[param("tf_delay", unit("s"), min(0.0))]
        tf_delay_s: Option<f64>,
        /// If true, the scanner is mounted upside down.
        #[param("inverted_laser")]
        _: bool = false,
        /// If true, use simulated time (`/clock`).
        #[param("use_sim_time")]
        use_sim_time: bool = false,
        // What is used of scans.
        /// Maximum range for drawing the map and for scan matching (default: `maxRange`).
        #[param("maxUrange", unit("m"), above(0.0))]
        max_urange_m: Option<f64>,
        /// Maximum range of valid readings (default: that of the scans minus 0.01 m).
        #[param("maxRange", unit("m"), above(0.0))]
        max_range_m: Option<f64>,
        /// Minimum range of readings that are used.
        #[param("minUrange", unit("m"), min(0.0))]
        min_urange_m: f64 = 0,
        /// Number of beams skipped after each beam in scan matching.
        #[param("lskip", within(0.0, 10_000.0))]
        lskip: usize = 0,
        /// Correction of the mounting.
        #[shared]
        mounting: MountingParams,
        // When scans are used.
        /// Minimum distance between scans that are used ...
        #[param("linearUpdate", unit("m"), min(0.0))]
        linear_update_m: f64 = 1,
        /// ... or minimum rotation ...
        #[param("angularUpdate", unit("rad"), min(0.0))]
        angular_update_rad: f64 = 0.5,
        /// ... or minimum time; negative: never.
        #[param("temporalUpdate", unit("s"))]
        temporal_update_s: f64 = -1,
        // How scans are laid onto maps.
        /// Scan matching: a beam that ends at distance d from an occupied cell counts exp(-d^2 / sigma).
        #[param("sigma", unit("m^2"), above(0.0))]
        sigma_m2: f64 = 0.05,
        /// Number of cells around the end of a beam that are searched.
        #[param("kernelSize", within(1.0, 8.0))]
        kernel_size: usize = 1,
        /// Initial step of the position search.
        #[param("lstep", unit("m"))]
        _: f64 = 0.05,
        /// Initial step of the heading search.
        #[param("astep", unit("rad"))]
        _: f64 = 0.05,
        /// Number of steps of the search for the best match.
        #[param("iterations", within(1.0, 100.0))]
        iterations: usize = 5,
        /// Minimum sum of the beam scores of a match.
        #[param("minimumScore", min(0.0))]
        minimum_score: f64 = 0,
        // How likely a scan is.
        /// Variance of the beam likelihood exp(-d^2 / lsigma).
        #[param("lsigma", unit("m^2"), above(0.0))]
        lsigma_m2: f64 = 0.075,
        /// Factor by which likelihoods are flattened for weights, because beams are not independent.
        #[param("ogain", above(0.0))]
        ogain: f64 = 3,
        /// Half-width of the position sampling around the best match ...
        #[param("llsamplerange", unit("m"), within(0.0, 1.0))]
        llsamplerange_m: f64 = 0.01,
        /// ... and its step.
        #[param("llsamplestep", unit("m"), above(0.0))]
        llsamplestep_m: f64 = 0.01,
        /// Half-width of the heading sampling around the best match ...
        #[param("lasamplerange", unit("rad"), within(0.0, 1.0))]
        lasamplerange_rad: f64 = 0.005,
        /// ... and its step.
        #[param("lasamplestep", unit("rad"), above(0.0))]
        lasamplestep_rad: f64 = 0.005,
        // How odometry errs.
        /// Odometry noise: standard deviation of position per metre of distance.
        #[param("srr", min(0.0))]
        srr: f64 = 0.1,
        /// Odometry noise: standard deviation of heading per metre of distance.
        #[param("srt", unit("rad/m"), min(0.0))]
        srt_rad_per_m: f64 = 0.2,
        /// Odometry noise: standard deviation of position per radian of rotation.
        #[param("str", unit("m/rad"), min(0.0))]
        str_m_per_rad: f64 = 0.1,
        /// Odometry noise: standard deviation of heading per radian of rotation.
        #[param("stt", min(0.0))]
        stt: f64 = 0.2,
        // Particles.
        /// Number of particles.
        #[param("particles", within(1.0, 10_000.0))]
        particles: usize = 30,
        /// Effective fraction of particles below which they are resampled.
        #[param("resampleThreshold", within(0.0, 1.0))]
        resample_threshold: f64 = 0.5,
        /// Seed of the random numbers.
        #[param("random_seed")]
        random_seed: i64 = 0,
        /// Number of threads; results do not depend on it.
        #[param("threads", within(1.0, 256.0))]
        threads: usize = 1,
        // The map.
        /// Cell size of the map.
        #[param("delta", unit("m"), within(0.005, 2.0))]
        delta_m: f64 = 0.05,
        /// Minimum fraction of hits of an occupied cell.
        #[param("occ_thresh", within(0.0, 1.0))]
        occ_thresh: f64 = 0.25,
        /// Initial bounds of the map; it grows as needed.
        #[param("xmin", unit("m"))]
        xmin_m: f64 = -100,
        /// Initial bounds of the map; it grows as needed.
        #[param("ymin", unit("m"))]
        ymin_m: f64 = -100,
        /// Initial bounds of the map; it grows as needed.
        #[param("xmax", unit("m"))]
        xmax_m: f64 = 100,
        /// Initial bounds of the map; it grows as needed.
        #[param("ymax", unit("m"))]
        ymax_m: f64 = 100,
    }
}

pub(super) const IDLE: &[Idle] = &[
    Idle {
        names: &["lstep", "astep"],
        because: "the best match is found by least squares from the predicted pose, and not by steps \
                  of a given length",
    },
    Idle {
        names: &["inverted_laser"],
        because: "the orientation of the scanner is read from its transform",
    },
];

pub(super) fn conflicts(values: &ParamValues) -> Vec<Diagnostic> {
    let mut findings = Vec::new();
    let params = GmappingParams::from_values(values);
    if let (Some(used), Some(most)) = (params.max_urange_m, params.max_range_m)
        && used > most
    {
        findings.push(
            Diagnostic::warning(
                "used-beyond-range",
                format!("`maxUrange` is {used} m, beyond `maxRange`, {most} m"),
            )
            .at(values.origin("maxUrange"))
            .related(values.origin("maxRange"), "set here")
            .note(format!("readings are used up to {most} m")),
        );
    }
    for (low, from, high, to) in [
        ("xmin", params.xmin_m, "xmax", params.xmax_m),
        ("ymin", params.ymin_m, "ymax", params.ymax_m),
    ] {
        if from >= to {
            findings.push(
                Diagnostic::warning(
                    "empty-map",
                    format!("`{low}` is {from} m and `{high}` {to} m: there is no map between"),
                )
                .at(values.origin(low))
                .related(values.origin(high), "set here")
                .note("the map is as large as the explored area"),
            );
        }
    }
    findings
}

impl GmappingSettings {
    /// Applies values of [`GMAPPING`]. The bounds of the map count only if given: by default it covers
    /// everything observed.
    #[must_use]
    pub fn of(values: &ParamValues) -> Self {
        let params = GmappingParams::from_values(values);
        let used_m = params.max_urange_m.or(params.max_range_m);
        let given = |bound_m: f64, name: &str| values.is_given(name).then_some(bound_m);
        Self {
            particles: params.particles,
            seed: params.random_seed.cast_unsigned(),
            threads: params.threads,
            range_min_m: params.min_urange_m as f32,
            range_used_m: used_m.map_or(f32::INFINITY, |it| it as f32),
            range_max_m: params.max_range_m.map(|it| it as f32),
            skipped_beams: params.lskip,
            update_shift_m: params.linear_update_m,
            update_turn_rad: params.angular_update_rad,
            update_time_s: Some(params.temporal_update_s).filter(|it| *it >= 0.0),
            match_sigma_m2: params.sigma_m2,
            kernel_cells: params.kernel_size,
            steps: params.iterations,
            least_score: params.minimum_score,
            likelihood_sigma_m2: params.lsigma_m2,
            gain: params.ogain,
            sample_range: [params.llsamplerange_m, params.lasamplerange_rad],
            sample_step: [params.llsamplestep_m, params.lasamplestep_rad],
            noise: Noise {
                place_by_way: params.srr,
                place_by_turn: params.str_m_per_rad,
                heading_by_way: params.srt_rad_per_m,
                heading_by_turn: params.stt,
            },
            resample_share: params.resample_threshold,
            resolution_m: params.delta_m,
            occupied_share: params.occ_thresh,
            bounds_m: [
                given(params.xmin_m, "xmin"),
                given(params.ymin_m, "ymin"),
                given(params.xmax_m, "xmax"),
                given(params.ymax_m, "ymax"),
            ],
            slices_per_scan: usize::MAX,
            keeps_each_pose: true,
        }
    }
}
