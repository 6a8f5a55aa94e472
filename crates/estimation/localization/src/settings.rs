//! Settings from parameters.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose2;
use periplus_params::{Given, ParamValues};

use crate::kld_sampling::KldSampling;
use crate::likelihood_map::{CellAlignment, LikelihoodMapSettings};
use crate::motion_model::{MotionModel, MotionNoise};
use crate::parameters::{AMCL, AmclCompat, AmclParams};
use crate::particles::Covariance2;
use crate::pose_threshold::PoseThreshold;
use crate::scan::BeamLimits;
use crate::sensor_model::{BeamMixture, BeamSkip, SensorModel};

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
        Self::from_values(&ParamValues::defaults(&AMCL))
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

    /// Reports a minimum number of particles above the maximum.
    #[must_use]
    pub fn particle_conflict(values: &ParamValues) -> Option<Diagnostic> {
        let AmclParams { min_particles: min, max_particles: max, .. } =
            AmclParams::from_values(values);
        (min > max).then(|| {
            Diagnostic::warning(
                "more-least-than-most",
                format!("`min_particles` is {min}, more than `max_particles`, {max}"),
            )
            .at(values.origin("min_particles"))
            .related(values.origin("max_particles"), "set here")
            .note(format!("`max_particles` is raised to {min}"))
        })
    }

    /// Reports combinations of values that are valid one by one but make no sense together.
    /// [`Settings::from_values`] corrects them.
    #[must_use]
    pub fn conflicts(values: &ParamValues) -> Vec<Diagnostic> {
        let mut findings: Vec<Diagnostic> = Self::particle_conflict(values).into_iter().collect();
        let params = AmclParams::from_values(values);
        if params.z_hit == 0.0 {
            findings.push(
                Diagnostic::warning(
                    "no-hits",
                    "`z_hit` is 0: scans have no influence on the estimate",
                )
                .at(values.origin("z_hit"))
                .help("set a weight above 0, such as 0.5"),
            );
        }
        let (fast, slow) = (params.recovery_alpha_fast, params.recovery_alpha_slow);
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
        let params = AmclParams::from_values(values);
        let initial_pose = Pose2::new(
            params.initial_pose_x_m,
            params.initial_pose_y_m,
            params.initial_pose_yaw_rad,
        );
        let covariance = Covariance2 {
            xx: params.initial_cov_xx_m2,
            xy: 0.0,
            yy: params.initial_cov_yy_m2,
            yaw: params.initial_cov_aa_rad2,
        };
        let compat = params.compat;
        // With Nav2 compatibility, extensions are off unless they are set.
        let extension = |is_on: bool, name: &str| {
            is_on && (compat == AmclCompat::None || values.is_given(name))
        };
        Self {
            compat,
            motion_model: params.robot_model_type,
            motion_noise: [
                params.alpha1,
                params.alpha2,
                params.alpha3,
                params.alpha4,
                params.alpha5,
            ],
            beams: BeamLimits {
                max_beams: params.max_beams,
                range_min_m: params.laser_min_range_m,
                range_max_m: params.laser_max_range_m,
            },
            sensor_model: params.laser_model_type,
            mixture: BeamMixture {
                hit: params.z_hit,
                short: params.z_short,
                max: params.z_max,
                random: params.z_rand,
                sigma_hit_m: params.sigma_hit_m,
                lambda_short_per_m: params.lambda_short_per_m,
            },
            beam_skip: params.do_beamskip.then_some(BeamSkip {
                distance_m: params.beam_skip_distance_m,
                threshold: params.beam_skip_threshold,
                error_threshold: params.beam_skip_error_threshold,
            }),
            distance_max_m: params.laser_likelihood_max_dist_m,
            kld_sampling: KldSampling {
                max_error: params.pf_err,
                quantile: params.pf_z,
                min_particles: params.min_particles,
                max_particles: params.max_particles.max(params.min_particles),
            },
            recovery_alphas: [params.recovery_alpha_slow, params.recovery_alpha_fast],
            resample_interval: params.resample_interval as u64,
            resamples_selectively: params.selective_resampling,
            update_threshold: PoseThreshold::new(params.update_min_d_m, params.update_min_a_rad),
            first_map_only: params.first_map_only,
            downsamples_free_space: params.freespace_downsampling,
            localizes_globally: extension(params.global_start, "global_start"),
            refines_by_scan_matching: extension(params.scan_match, "scan_match"),
            searches_when_lost: extension(params.search_when_lost, "search_when_lost"),
            initial_pose: params.set_initial_pose.then_some((initial_pose, covariance)),
            // -1 becomes the largest seed.
            seed: params.random_seed.cast_unsigned(),
            global_frame: params.global_frame_id,
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
