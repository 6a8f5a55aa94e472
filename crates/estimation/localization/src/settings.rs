//! What parameters say.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose2;
use periplus_params::{Given, ParamValues};

use crate::bins::SampleSize;
use crate::known_map::{CellPlace, MapSettings};
use crate::models::{BeamSkip, Mixture, Model};
use crate::motion::{Alphas, Drive};
use crate::particles::Covariance2;
use crate::scan::BeamLimits;
use crate::tables::AMCL;

/// Whose habits to keep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compat {
    /// What is right.
    #[default]
    None,
    /// Those of Nav2, also where they are faults.
    Nav2,
}

/// All that localization wants to know; [`Settings::of`] makes it of parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Whose habits to keep.
    pub compat: Compat,
    /// The frame of the map.
    pub global_frame: String,
    /// How the robot moves.
    pub drive: Drive,
    /// What odometry is wrong by.
    pub alphas: Alphas,
    /// Which beams are used.
    pub beams: BeamLimits,
    /// How scans are held against the map.
    pub model: Model,
    /// What beams are made of.
    pub mixture: Mixture,
    /// When beams are skipped; none when all are used.
    pub skip: Option<BeamSkip>,
    /// Distances to walls count up to here \[m\].
    pub distance_max_m: f64,
    /// How many particles.
    pub size: SampleSize,
    /// Memory of the long-term and the short-term likelihood; 0 for none.
    pub recovery_alphas: [f64; 2],
    /// Scans from one resampling to the next.
    pub resample_interval: u64,
    /// Whether to resample only when few particles count.
    pub is_selective: bool,
    /// No scan is used before the robot moved further along x or y \[m\], or turned further \[rad\].
    pub update_min: (f64, f64),
    /// Whether maps after the first are ignored.
    pub first_map_only: bool,
    /// Whether only every other row and column of free cells is kept for random poses.
    pub thins_free: bool,
    /// Whether a robot of which nobody says where it is looks for itself on all of the map.
    pub starts_anywhere: bool,
    /// Whether estimates are refined by drawing the scan to the walls.
    pub polishes: bool,
    /// Whether a robot that is lost looks for itself on all of the map.
    pub seeks_when_lost: bool,
    /// Where to start, and how uncertain that is.
    pub start: Option<(Pose2, Covariance2)>,
    /// Seed of all randomness.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self::of(&AMCL.check([], None, &mut Diagnostics::new()))
    }
}

impl Settings {
    /// Reads parameters by [`AMCL`], names of ROS 1 among them. What is wrong is told, and the default
    /// stands in for it; each old name gets a hint.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &mut Diagnostics,
    ) -> (ParamValues, Self) {
        let given: Vec<Given<'a>> = given.into_iter().collect();
        for one in &given {
            if let Some(hint) = old_name(one) {
                diagnostics.push(hint);
            }
        }
        let values = AMCL.check(given, None, diagnostics);
        for finding in Self::conflicts(&values) {
            diagnostics.push(finding);
        }
        let settings = Self::of(&values);
        (values, settings)
    }

    /// What values that are each fine say together and cannot mean. [`Settings::of`] makes the best of
    /// it.
    #[must_use]
    pub fn conflicts(values: &ParamValues) -> Vec<Diagnostic> {
        let mut findings = Vec::new();
        let integer = |name: &str| values.integer(name).unwrap_or_default();
        let (least, most) = (integer("min_particles"), integer("max_particles"));
        if least > most {
            findings.push(
                Diagnostic::warning(
                    "more-least-than-most",
                    format!("`min_particles` is {least}, more than `max_particles`, {most}"),
                )
                .at(values.origin("min_particles"))
                .related(values.origin("max_particles"), "set here")
                .note(format!("`max_particles` is taken as {least}, too")),
            );
        }
        let number = |name: &str| values.number(name).unwrap_or_default();
        if number("z_hit") == 0.0 {
            findings.push(
                Diagnostic::warning("no-hits", "`z_hit` is 0: no scan tells where the robot is")
                    .at(values.origin("z_hit"))
                    .help("give it a share above 0, such as 0.5"),
            );
        }
        let (fast, slow) = (number("recovery_alpha_fast"), number("recovery_alpha_slow"));
        if slow > 0.0 && fast <= slow {
            findings.push(
                Diagnostic::warning(
                    "slow-recovery",
                    format!(
                        "`recovery_alpha_fast` is {fast}, not above `recovery_alpha_slow`, {slow}: \
                         the robot is never found again after it was carried away"
                    ),
                )
                .at(values.origin("recovery_alpha_fast"))
                .help("usual values are 0.1 and 0.001"),
            );
        }
        findings
    }

    /// What values of [`AMCL`] say.
    #[must_use]
    pub fn of(values: &ParamValues) -> Self {
        let number = |name: &str| values.number(name).unwrap_or_default();
        let flag = |name: &str| values.flag(name).unwrap_or_default();
        let count =
            |name: &str| usize::try_from(values.integer(name).unwrap_or_default()).unwrap_or(0);
        let text = |name: &str| values.text(name).unwrap_or_default();
        let least = count("min_particles");
        let start = Pose2::new(
            number("initial_pose.x"),
            number("initial_pose.y"),
            number("initial_pose.yaw"),
        );
        let covariance = Covariance2 {
            xx: number("initial_cov_xx"),
            xy: 0.0,
            yy: number("initial_cov_yy"),
            yaw: number("initial_cov_aa"),
        };
        let compat = if text("compat") == "nav2" { Compat::Nav2 } else { Compat::None };
        // What Nav2 does not have is off with its habits, unless somebody wants it.
        let better = |name: &str| flag(name) && (compat == Compat::None || values.is_given(name));
        Self {
            compat,
            global_frame: text("global_frame_id"),
            drive: match text("robot_model_type").as_str() {
                "nav2_amcl::OmniMotionModel" | "omnidirectional" | "omni" | "omni-corrected" => {
                    Drive::Omnidirectional
                }
                _ => Drive::Differential,
            },
            alphas: ["alpha1", "alpha2", "alpha3", "alpha4", "alpha5"].map(number),
            beams: BeamLimits {
                most: count("max_beams"),
                range_min_m: number("laser_min_range"),
                range_max_m: number("laser_max_range"),
            },
            model: match text("laser_model_type").as_str() {
                "beam" => Model::Beam,
                "likelihood_field_prob" => Model::LikelihoodFieldProb,
                _ => Model::LikelihoodField,
            },
            mixture: Mixture {
                hit: number("z_hit"),
                short: number("z_short"),
                max: number("z_max"),
                random: number("z_rand"),
                sigma_m: number("sigma_hit"),
                lambda: number("lambda_short"),
            },
            skip: flag("do_beamskip").then(|| BeamSkip {
                distance_m: number("beam_skip_distance"),
                threshold: number("beam_skip_threshold"),
                error_threshold: number("beam_skip_error_threshold"),
            }),
            distance_max_m: number("laser_likelihood_max_dist"),
            size: SampleSize {
                error: number("pf_err"),
                quantile: number("pf_z"),
                least,
                most: count("max_particles").max(least),
            },
            recovery_alphas: [number("recovery_alpha_slow"), number("recovery_alpha_fast")],
            resample_interval: count("resample_interval") as u64,
            is_selective: flag("selective_resampling"),
            update_min: (number("update_min_d"), number("update_min_a")),
            first_map_only: flag("first_map_only"),
            thins_free: flag("freespace_downsampling"),
            starts_anywhere: better("global_start"),
            polishes: better("scan_match"),
            seeks_when_lost: better("search_when_lost"),
            start: flag("set_initial_pose").then_some((start, covariance)),
            // -1 becomes the largest seed, as good as any.
            seed: values.integer("random_seed").unwrap_or(-1).cast_unsigned(),
        }
    }

    /// Whether the robot may ever be looked for on all of the map.
    pub(crate) fn searches(&self) -> bool {
        self.starts_anywhere || self.seeks_when_lost
    }

    /// How a map is prepared.
    #[must_use]
    pub fn map(&self) -> MapSettings {
        MapSettings {
            most_m: self.distance_max_m,
            place: match self.compat {
                Compat::None => CellPlace::Corner,
                Compat::Nav2 => CellPlace::Centred,
            },
            thins_free: self.thins_free,
        }
    }
}

/// The hint for a name or a word that ROS 1 or an older Nav2 had.
fn old_name(given: &Given<'_>) -> Option<Diagnostic> {
    let parameter = AMCL.find(given.name)?;
    if parameter.name != given.name {
        let (old, new) = (given.name, parameter.name);
        let message = format!("`{old}` is the name in ROS 1; it is read as `{new}`");
        return Some(Diagnostic::hint("ros1-name", message).replace(
            given.name_origin,
            new,
            format!("write `{new}`"),
        ));
    }
    let new = match (parameter.name, given.text.as_ref()) {
        ("robot_model_type", "differential" | "diff" | "diff-corrected") => {
            "nav2_amcl::DifferentialMotionModel"
        }
        ("robot_model_type", "omnidirectional" | "omni" | "omni-corrected") => {
            "nav2_amcl::OmniMotionModel"
        }
        _ => return None,
    };
    let message = format!("`{}` is an old name of `{new}`", given.text);
    let hint = Diagnostic::hint("old-name", message);
    Some(hint.replace(given.origin, new, format!("write `{new}`")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(given: &[(&'static str, &'static str)]) -> (Settings, Vec<&'static str>) {
        let mut diagnostics = Diagnostics::new();
        let given = given.iter().map(|&(name, text)| Given::new(name, text));
        let (_, settings) = Settings::read(given, &mut diagnostics);
        (settings, diagnostics.iter().map(|it| it.code).collect())
    }

    #[test]
    fn defaults_are_those_of_nav2() {
        let settings = Settings::default();
        assert_eq!(settings.alphas, [0.2; 5]);
        assert_eq!((settings.size.least, settings.size.most), (500, 2000));
        assert_eq!(settings.update_min, (0.25, 0.2));
        assert_eq!((settings.model, settings.drive), (Model::LikelihoodField, Drive::Differential));
        assert_eq!((settings.skip, settings.start), (None, None));
    }

    #[test]
    fn names_of_ros_1_are_read_with_a_hint() {
        let (settings, codes) = read(&[
            ("odom_model_type", "omni"),
            ("odom_alpha1", "0.5"),
            ("laser_max_beams", "30"),
            ("kld_err", "0.01"),
        ]);
        assert_eq!(codes, ["ros1-name"; 4]);
        assert_eq!((settings.drive, settings.beams.most), (Drive::Omnidirectional, 30));
        assert_eq!((settings.alphas[0], settings.size.error), (0.5, 0.01));
    }

    #[test]
    fn old_and_new_names_of_motion_models() {
        assert_eq!(read(&[("robot_model_type", "omnidirectional")]).1, ["old-name"]);
        let (settings, codes) = read(&[("robot_model_type", "nav2_amcl::OmniMotionModel")]);
        assert_eq!((settings.drive, codes.len()), (Drive::Omnidirectional, 0));
    }

    #[test]
    fn what_cannot_be_meant_is_told() {
        let (settings, codes) = read(&[("min_particles", "3000")]);
        assert_eq!((settings.size.most, codes), (3000, vec!["more-least-than-most"]));
        assert_eq!(read(&[("z_hit", "0")]).1, ["no-hits"]);
        assert_eq!(read(&[("recovery_alpha_slow", "0.1")]).1, ["slow-recovery"]);
        assert_eq!(read(&[("sigma_hit", "0")]).1, ["out-of-range"]);
        assert_eq!(read(&[("alpha_1", "0.1")]).1, ["unknown-parameter"]);
    }
}
