//! The parameters of `slam_gmapping`.
//!
//! Source of names and defaults: its wiki page and the documentation in its source (ROS 1, noetic).
//! The wiki has `srt` and `str` the other way round than the program: what it does counts.

use periplus_diagnostics::Diagnostic;
use periplus_params::{NamedEntity, ParamValues, Table, flag, integer, number, text};

use super::{CORRECT_MOUNTING, Idle};
use crate::gmapping::{GmappingSettings, Noise};

/// Parameters of the node `slam_gmapping`.
pub static GMAPPING: Table = Table {
    name: "slam_gmapping",
    doc: "Particle filter SLAM from laser scans and odometry, with one map per particle.",
    parameters: &[
        // Frames, topics, time.
        text("base_frame", "Frame of the robot base.").or("base_link").naming(NamedEntity::Frame),
        text("map_frame", "Frame of the map.").or("map").naming(NamedEntity::Frame),
        text("odom_frame", "Frame of odometry.").or("odom").naming(NamedEntity::Frame),
        integer("throttle_scans", "Use every Nth scan.").or("1").min(1.0),
        number("map_update_interval", "s", "Period of the published map.").or("5").min(0.0),
        number("transform_publish_period", "s", "Period of the transform `map -> odom`; 0: never published.")
            .or("0.05")
            .min(0.0),
        number(
            "tf_delay",
            "s",
            "Time by which the stamp of `map -> odom` is ahead (default: the publication period).",
        )
        .min(0.0),
        flag("inverted_laser", "If true, the scanner is mounted upside down.").or("false"),
        flag("use_sim_time", "If true, use simulated time (`/clock`).").or("false"),
        // What is used of scans.
        number(
            "maxUrange",
            "m",
            "Maximum range for drawing the map and for scan matching (default: `maxRange`).",
        )
        .above(0.0),
        number(
            "maxRange",
            "m",
            "Maximum range of valid readings (default: that of the scans minus 0.01 m).",
        )
        .above(0.0),
        number("minUrange", "m", "Minimum range of readings that are used.").or("0").min(0.0),
        integer(
            "lskip",
            "Number of beams skipped after each beam in scan matching.",
        )
        .or("0")
        .within(0.0, 10_000.0),
        flag("correct_mounting", CORRECT_MOUNTING).or("true"),
        // When scans are used.
        number("linearUpdate", "m", "Minimum distance between scans that are used ...").or("1").min(0.0),
        number("angularUpdate", "rad", "... or minimum rotation ...").or("0.5").min(0.0),
        number("temporalUpdate", "s", "... or minimum time; negative: never.")
            .or("-1"),
        // How scans are laid onto maps.
        number(
            "sigma",
            "m^2",
            "Scan matching: a beam that ends at distance d from an occupied cell counts exp(-d^2 / sigma).",
        )
        .or("0.05")
        .above(0.0),
        integer("kernelSize", "Number of cells around the end of a beam that are searched.")
            .or("1")
            .within(1.0, 8.0),
        number("lstep", "m", "Initial step of the position search.").or("0.05"),
        number("astep", "rad", "Initial step of the heading search.").or("0.05"),
        integer("iterations", "Number of steps of the search for the best match.").or("5").within(1.0, 100.0),
        number("minimumScore", "", "Minimum sum of the beam scores of a match.")
            .or("0")
            .min(0.0),
        // How likely a scan is.
        number("lsigma", "m^2", "Variance of the beam likelihood exp(-d^2 / lsigma).").or("0.075").above(0.0),
        number(
            "ogain",
            "",
            "Factor by which likelihoods are flattened for weights, because beams are not independent.",
        )
        .or("3")
        .above(0.0),
        number("llsamplerange", "m", "Half-width of the position sampling around the best match ...")
            .or("0.01")
            .within(0.0, 1.0),
        number("llsamplestep", "m", "... and its step.").or("0.01").above(0.0),
        number("lasamplerange", "rad", "Half-width of the heading sampling around the best match ...")
            .or("0.005")
            .within(0.0, 1.0),
        number("lasamplestep", "rad", "... and its step.").or("0.005").above(0.0),
        // How odometry errs.
        number("srr", "", "Odometry noise: standard deviation of position per metre of distance.")
            .or("0.1")
            .min(0.0),
        number("srt", "rad/m", "Odometry noise: standard deviation of heading per metre of distance.").or("0.2").min(0.0),
        number("str", "m/rad", "Odometry noise: standard deviation of position per radian of rotation.").or("0.1").min(0.0),
        number("stt", "", "Odometry noise: standard deviation of heading per radian of rotation.").or("0.2").min(0.0),
        // Particles.
        integer("particles", "Number of particles.").or("30").within(1.0, 10_000.0),
        number(
            "resampleThreshold",
            "",
            "Effective fraction of particles below which they are resampled.",
        )
        .or("0.5")
        .within(0.0, 1.0),
        integer("random_seed", "Seed of the random numbers.").or("0"),
        integer("threads", "Number of threads; results do not depend on it.")
            .or("1")
            .within(1.0, 256.0),
        // The map.
        number("delta", "m", "Cell size of the map.").or("0.05").within(0.005, 2.0),
        number("occ_thresh", "", "Minimum fraction of hits of an occupied cell.")
            .or("0.25")
            .within(0.0, 1.0),
        number("xmin", "m", "Initial bounds of the map; it grows as needed.").or("-100"),
        number("ymin", "m", "Initial bounds of the map; it grows as needed.").or("-100"),
        number("xmax", "m", "Initial bounds of the map; it grows as needed.").or("100"),
        number("ymax", "m", "Initial bounds of the map; it grows as needed.").or("100"),
    ],
};

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
    let number = |name: &str| values.number(name);
    if let (Some(used), Some(most)) = (number("maxUrange"), number("maxRange"))
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
    for (low, high) in [("xmin", "xmax"), ("ymin", "ymax")] {
        let (from, to) = (number(low).unwrap_or_default(), number(high).unwrap_or_default());
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
        let number = |name: &str| values.number(name).unwrap_or_default();
        let count = |name: &str| usize::try_from(values.integer(name).unwrap_or(1)).unwrap_or(1);
        let range_max_m = values.number("maxRange");
        let used_m = values.number("maxUrange").or(range_max_m);
        let given = |name: &str| values.number(name).filter(|_| values.is_given(name));
        Self {
            particles: count("particles"),
            seed: values.integer("random_seed").unwrap_or(0).cast_unsigned(),
            threads: count("threads"),
            range_min_m: number("minUrange") as f32,
            range_used_m: used_m.map_or(f32::INFINITY, |it| it as f32),
            range_max_m: range_max_m.map(|it| it as f32),
            skipped_beams: count("lskip"),
            update_shift_m: number("linearUpdate"),
            update_turn_rad: number("angularUpdate"),
            update_time_s: Some(number("temporalUpdate")).filter(|it| *it >= 0.0),
            match_sigma_m2: number("sigma"),
            kernel_cells: count("kernelSize"),
            steps: count("iterations"),
            least_score: number("minimumScore"),
            likelihood_sigma_m2: number("lsigma"),
            gain: number("ogain"),
            sample_range: [number("llsamplerange"), number("lasamplerange")],
            sample_step: [number("llsamplestep"), number("lasamplestep")],
            noise: Noise {
                place_by_way: number("srr"),
                place_by_turn: number("str"),
                heading_by_way: number("srt"),
                heading_by_turn: number("stt"),
            },
            resample_share: number("resampleThreshold"),
            resolution_m: number("delta"),
            occupied_share: number("occ_thresh"),
            bounds_m: [given("xmin"), given("ymin"), given("xmax"), given("ymax")],
            slices_per_scan: usize::MAX,
            keeps_each_pose: true,
        }
    }
}
