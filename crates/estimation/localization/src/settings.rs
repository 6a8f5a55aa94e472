//! Settings from parameters.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose2;
use periplus_params::{Given, ParamValues};

use crate::kld_sampling::KldSampling;
use crate::likelihood_map::{CellAlignment, LikelihoodMapSettings};
use crate::motion_model::{MotionModel, MotionNoise};
use crate::parameters::AMCL;
use crate::particles::Covariance2;
use crate::pose_threshold::PoseThreshold;
use crate::scan::BeamLimits;
use crate::sensor_model::{BeamMixture, BeamSkip, SensorModel};

/// Compatibility: `compat`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AmclCompat {
    /// Correct behaviour.
    #[default]
    None,
    /// Behaviour of Nav2, including its defects.
    Nav2,
}

/// Settings of [`Amcl`](crate::Amcl); [`Settings::from_values`] reads them from parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Compatibility with Nav2.
    pub compat: AmclCompat,
    /// Frame of the map.
    pub global_frame: String,
    /// Motion model.
    pub motion_model: MotionModel,
    /// Noise of the motion model.
    pub motion_noise: MotionNoise,
    /// Selection of beams.
    pub beams: BeamLimits,
    /// Sensor model.
    pub sensor_model: SensorModel,
    /// Parameters of the sensor model.
    pub mixture: BeamMixture,
    /// Beam skipping; none to use all beams.
    pub beam_skip: Option<BeamSkip>,
    /// Maximum distance of the likelihood field \[m\].
    pub distance_max_m: f64,
    /// Number of particles.
    pub kld_sampling: KldSampling,
    /// `recovery_alpha_slow` and `recovery_alpha_fast`; 0 to disable.
    pub recovery_alphas: [f64; 2],
    /// Number of updates between resamplings.
    pub resample_interval: u64,
    /// Resample only when the effective sample size is below half of the particles.
    pub resamples_selectively: bool,
    /// Minimum motion between updates of the filter.
    pub update_threshold: PoseThreshold,
    /// Ignore maps after the first.
    pub first_map_only: bool,
    /// Use every second row and column of free cells for random poses.
    pub downsamples_free_space: bool,
    /// Run global localization when no initial pose is given.
    pub localizes_globally: bool,
    /// Refine estimates by scan matching.
    pub refines_by_scan_matching: bool,
    /// Run global localization when the robot is lost.
    pub searches_when_lost: bool,
    /// Initial pose and its covariance.
    pub initial_pose: Option<(Pose2, Covariance2)>,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self::from_values(&AMCL.check([], None, &mut Diagnostics::new()))
    }
}

impl Settings {
    /// Reads parameters of [`AMCL`], including their ROS 1 names. Invalid values are reported and
    /// replaced by defaults; each ROS 1 name gets a hint.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &mut Diagnostics,
    ) -> (ParamValues, Self) {
        let given: Vec<Given<'a>> = given.into_iter().collect();
        for one in &given {
            if let Some(hint) = ros1_name(one) {
                diagnostics.push(hint);
            }
        }
        let values = AMCL.check(given, None, diagnostics);
        for finding in Self::conflicts(&values) {
            diagnostics.push(finding);
        }
        let settings = Self::from_values(&values);
        (values, settings)
    }

    /// Reports combinations of values that are valid one by one but make no sense together.
    /// [`Settings::from_values`] corrects them.
    #[must_use]
    pub fn conflicts(values: &ParamValues) -> Vec<Diagnostic> {
        let mut findings = Vec::new();
        let integer = |name: &str| values.integer(name).unwrap_or_default();
        let (min, max) = (integer("min_particles"), integer("max_particles"));
        if min > max {
            findings.push(
                Diagnostic::warning(
                    "more-least-than-most",
                    format!("`min_particles` is {min}, more than `max_particles`, {max}"),
                )
                .at(values.origin("min_particles"))
                .related(values.origin("max_particles"), "set here")
                .note(format!("`max_particles` is raised to {min}")),
            );
        }
        let number = |name: &str| values.number(name).unwrap_or_default();
        if number("z_hit") == 0.0 {
            findings.push(
                Diagnostic::warning(
                    "no-hits",
                    "`z_hit` is 0: scans have no influence on the estimate",
                )
                .at(values.origin("z_hit"))
                .help("set a weight above 0, such as 0.5"),
            );
        }
        let (fast, slow) = (number("recovery_alpha_fast"), number("recovery_alpha_slow"));
        if slow > 0.0 && fast <= slow {
            findings.push(
                Diagnostic::warning(
                    "slow-recovery",
                    format!(
                        "`recovery_alpha_fast` is {fast}, not above `recovery_alpha_slow`, {slow}: \
                         no random particles are added, so a kidnapped robot does not recover"
                    ),
                )
                .at(values.origin("recovery_alpha_fast"))
                .help("usual values are 0.1 and 0.001"),
            );
        }
        findings
    }

    /// Converts values of [`AMCL`].
    #[must_use]
    pub fn from_values(values: &ParamValues) -> Self {
        let number = |name: &str| values.number(name).unwrap_or_default();
        let flag = |name: &str| values.flag(name).unwrap_or_default();
        let count =
            |name: &str| usize::try_from(values.integer(name).unwrap_or_default()).unwrap_or(0);
        let text = |name: &str| values.text(name).unwrap_or_default();
        let min_particles = count("min_particles");
        let initial_pose = Pose2::new(
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
        let compat = if text("compat") == "nav2" { AmclCompat::Nav2 } else { AmclCompat::None };
        // With Nav2 compatibility, extensions are off unless they are set.
        let extension =
            |name: &str| flag(name) && (compat == AmclCompat::None || values.is_given(name));
        Self {
            compat,
            global_frame: text("global_frame_id"),
            motion_model: match text("robot_model_type").as_str() {
                "nav2_amcl::OmniMotionModel" | "omnidirectional" | "omni" | "omni-corrected" => {
                    MotionModel::Omnidirectional
                }
                _ => MotionModel::Differential,
            },
            motion_noise: ["alpha1", "alpha2", "alpha3", "alpha4", "alpha5"].map(number),
            beams: BeamLimits {
                max_beams: count("max_beams"),
                range_min_m: number("laser_min_range"),
                range_max_m: number("laser_max_range"),
            },
            sensor_model: match text("laser_model_type").as_str() {
                "beam" => SensorModel::Beam,
                "likelihood_field_prob" => SensorModel::LikelihoodFieldProb,
                _ => SensorModel::LikelihoodField,
            },
            mixture: BeamMixture {
                hit: number("z_hit"),
                short: number("z_short"),
                max: number("z_max"),
                random: number("z_rand"),
                sigma_hit_m: number("sigma_hit"),
                lambda_short_per_m: number("lambda_short"),
            },
            beam_skip: flag("do_beamskip").then(|| BeamSkip {
                distance_m: number("beam_skip_distance"),
                threshold: number("beam_skip_threshold"),
                error_threshold: number("beam_skip_error_threshold"),
            }),
            distance_max_m: number("laser_likelihood_max_dist"),
            kld_sampling: KldSampling {
                max_error: number("pf_err"),
                quantile: number("pf_z"),
                min_particles,
                max_particles: count("max_particles").max(min_particles),
            },
            recovery_alphas: [number("recovery_alpha_slow"), number("recovery_alpha_fast")],
            resample_interval: count("resample_interval") as u64,
            resamples_selectively: flag("selective_resampling"),
            update_threshold: PoseThreshold::new(number("update_min_d"), number("update_min_a")),
            first_map_only: flag("first_map_only"),
            downsamples_free_space: flag("freespace_downsampling"),
            localizes_globally: extension("global_start"),
            refines_by_scan_matching: extension("scan_match"),
            searches_when_lost: extension("search_when_lost"),
            initial_pose: flag("set_initial_pose").then_some((initial_pose, covariance)),
            // -1 becomes the largest seed.
            seed: values.integer("random_seed").unwrap_or(-1).cast_unsigned(),
        }
    }

    /// True if global localization may run.
    pub(crate) fn uses_global_localization(&self) -> bool {
        self.localizes_globally || self.searches_when_lost
    }

    /// Settings of the likelihood map.
    #[must_use]
    pub fn map_settings(&self) -> LikelihoodMapSettings {
        LikelihoodMapSettings {
            distance_max_m: self.distance_max_m,
            alignment: match self.compat {
                AmclCompat::None => CellAlignment::Corner,
                AmclCompat::Nav2 => CellAlignment::Centered,
            },
            downsamples_free_space: self.downsamples_free_space,
        }
    }
}

/// Hint for a parameter name or value of ROS 1 or an older Nav2.
fn ros1_name(given: &Given<'_>) -> Option<Diagnostic> {
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
        assert_eq!(settings.motion_noise, [0.2; 5]);
        assert_eq!(
            (settings.kld_sampling.min_particles, settings.kld_sampling.max_particles),
            (500, 2000)
        );
        assert_eq!(settings.update_threshold, PoseThreshold::new(0.25, 0.2));
        assert_eq!(
            (settings.sensor_model, settings.motion_model),
            (SensorModel::LikelihoodField, MotionModel::Differential)
        );
        assert_eq!((settings.beam_skip, settings.initial_pose), (None, None));
    }

    #[test]
    fn ros1_names_are_read_with_a_hint() {
        let (settings, codes) = read(&[
            ("odom_model_type", "omni"),
            ("odom_alpha1", "0.5"),
            ("laser_max_beams", "30"),
            ("kld_err", "0.01"),
        ]);
        assert_eq!(codes, ["ros1-name"; 4]);
        assert_eq!(
            (settings.motion_model, settings.beams.max_beams),
            (MotionModel::Omnidirectional, 30)
        );
        assert_eq!((settings.motion_noise[0], settings.kld_sampling.max_error), (0.5, 0.01));
    }

    #[test]
    fn old_and_new_names_of_motion_models() {
        assert_eq!(read(&[("robot_model_type", "omnidirectional")]).1, ["old-name"]);
        let (settings, codes) = read(&[("robot_model_type", "nav2_amcl::OmniMotionModel")]);
        assert_eq!((settings.motion_model, codes.len()), (MotionModel::Omnidirectional, 0));
    }

    #[test]
    fn contradictory_values_are_reported() {
        let (settings, codes) = read(&[("min_particles", "3000")]);
        assert_eq!(
            (settings.kld_sampling.max_particles, codes),
            (3000, vec!["more-least-than-most"])
        );
        assert_eq!(read(&[("z_hit", "0")]).1, ["no-hits"]);
        assert_eq!(read(&[("recovery_alpha_slow", "0.1")]).1, ["slow-recovery"]);
        assert_eq!(read(&[("sigma_hit", "0")]).1, ["out-of-range"]);
        assert_eq!(read(&[("alpha_1", "0.1")]).1, ["unknown-parameter"]);
    }
}
