//! The parameters of `slam_gmapping`.
//!
//! Source of names and defaults: its wiki page and the documentation in its source (ROS 1, noetic).
//! The wiki has `srt` and `str` the other way round than the program: what it does counts.

use periplus_diagnostics::Diagnostic;
use periplus_params::{Names, Table, Values, flag, integer, number, text};

use super::{CORRECT_MOUNTING, Idle};
use crate::gmapping::{GmappingSettings, Noise};

/// Of the node.
pub static GMAPPING: Table = Table {
    name: "slam_gmapping",
    doc: "A map from scans and odometry, by particles that each have a map of their own.",
    parameters: &[
        // Frames, topics, time.
        text("base_frame", "The frame of the robot.").or("base_link").naming(Names::Frame),
        text("map_frame", "The frame of the map.").or("map").naming(Names::Frame),
        text("odom_frame", "The frame of odometry.").or("odom").naming(Names::Frame),
        integer("throttle_scans", "Every so manieth scan is used.").or("1").min(1.0),
        number("map_update_interval", "s", "How often the map is sent.").or("5").min(0.0),
        number("transform_publish_period", "s", "How often `map -> odom` is sent; 0 for never.")
            .or("0.05")
            .min(0.0),
        number(
            "tf_delay",
            "s",
            "How far ahead `map -> odom` is stamped; the period of sending \
                                 when it is not set.",
        )
        .min(0.0),
        flag("inverted_laser", "Whether the scanner hangs upside down.").or("false"),
        flag("use_sim_time", "Whether time comes from `/clock`.").or("false"),
        // What is used of scans.
        number(
            "maxUrange",
            "m",
            "The map is drawn and scans are laid onto it up to here; `maxRange` \
                                  when it is not set.",
        )
        .above(0.0),
        number(
            "maxRange",
            "m",
            "Readings beyond say nothing at all; when it is not set, what scans \
                                 say less a centimetre.",
        )
        .above(0.0),
        number("minUrange", "m", "Nearer readings are not used.").or("0").min(0.0),
        integer(
            "lskip",
            "So many beams are left out after each one, when scans are laid onto \
                          maps.",
        )
        .or("0")
        .within(0.0, 10_000.0),
        flag("correct_mounting", CORRECT_MOUNTING).or("true"),
        // When scans are used.
        number("linearUpdate", "m", "A scan is used after so much motion ...").or("1").min(0.0),
        number("angularUpdate", "rad", "... or turn ...").or("0.5").min(0.0),
        number("temporalUpdate", "s", "... or time since the last one; below 0 for never.")
            .or("-1"),
        // How scans are laid onto maps.
        number(
            "sigma",
            "m^2",
            "In the match of a scan a beam counts exp(-d^2 / sigma) when it ends \
                                a distance d from what the map has.",
        )
        .or("0.05")
        .above(0.0),
        integer("kernelSize", "So many cells around the end of a beam are looked at.")
            .or("1")
            .within(1.0, 8.0),
        number("lstep", "m", "First step of a search up the hill.").or("0.05"),
        number("astep", "rad", "First step of a search up the hill.").or("0.05"),
        integer("iterations", "Steps towards the best fit.").or("5").within(1.0, 100.0),
        number("minimumScore", "", "A scan fits when its beams count more than this together.")
            .or("0")
            .min(0.0),
        // How likely a scan is.
        number("lsigma", "m^2", "A beam is likely by exp(-d^2 / lsigma).").or("0.075").above(0.0),
        number(
            "ogain",
            "",
            "How much likelihoods are flattened for weights: beams are not \
                             independent.",
        )
        .or("3")
        .above(0.0),
        number("llsamplerange", "m", "Around the best fit the likelihood is sampled so far ...")
            .or("0.01")
            .within(0.0, 1.0),
        number("llsamplestep", "m", "... in such steps ...").or("0.01").above(0.0),
        number("lasamplerange", "rad", "... and so far in heading ...")
            .or("0.005")
            .within(0.0, 1.0),
        number("lasamplestep", "rad", "... in such steps.").or("0.005").above(0.0),
        // How odometry errs.
        number("srr", "", "Error of the place by way: a standard deviation per metre.")
            .or("0.1")
            .min(0.0),
        number("srt", "rad/m", "Error of the heading by way.").or("0.2").min(0.0),
        number("str", "m/rad", "Error of the place by turn.").or("0.1").min(0.0),
        number("stt", "", "Error of the heading by turn.").or("0.2").min(0.0),
        // Particles.
        integer("particles", "How many there are.").or("30").within(1.0, 10_000.0),
        number(
            "resampleThreshold",
            "",
            "They are drawn anew when fewer than this part of them \
                                         count.",
        )
        .or("0.5")
        .within(0.0, 1.0),
        integer("random_seed", "Seed of all randomness.").or("0"),
        integer("threads", "On so many threads; the result is the same.")
            .or("1")
            .within(1.0, 256.0),
        // The map.
        number("delta", "m", "Side of a cell of the map.").or("0.05").within(0.005, 2.0),
        number("occ_thresh", "", "A cell is occupied from this share of hits on.")
            .or("0.25")
            .within(0.0, 1.0),
        number("xmin", "m", "The map reaches at least from here ...").or("-100"),
        number("ymin", "m", "... and here ...").or("-100"),
        number("xmax", "m", "... to here ...").or("100"),
        number("ymax", "m", "... and here. It grows beyond as needed.").or("100"),
    ],
};

pub(super) const IDLE: &[Idle] = &[
    Idle {
        names: &["lstep", "astep"],
        because: "the best fit is found by derivatives, from where the scans just before have the \
                  robot, and not by steps of a given length",
    },
    Idle {
        names: &["inverted_laser"],
        because: "which way up the scanner hangs is read from its transform",
    },
];

pub(super) fn conflicts(values: &Values) -> Vec<Diagnostic> {
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
                .note("the map is as large as what was seen"),
            );
        }
    }
    findings
}

impl GmappingSettings {
    /// What values of [`GMAPPING`] say. The bounds of the map count only where they were given: by
    /// default it is as large as what was seen.
    #[must_use]
    pub fn of(values: &Values) -> Self {
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
