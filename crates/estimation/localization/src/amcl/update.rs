//! Update of the filter with odometry and a scan.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{LaserScan2, Pose2, Stream};

use super::global_search::LastSearch;
use super::tracking::OdometrySlip;
use super::{Amcl, AmclUpdate, PoseEstimate, fits_nowhere, no_initial_pose, no_map};
use crate::kld_sampling::OccupiedBins;
use crate::motion_model::sample_motion;
use crate::parameters::AmclCompat;
use crate::particles::Particles;
use crate::pose_threshold::has_moved;
use crate::recovery::LikelihoodAverages;
use crate::scan::{Beams, MatchingScan};
use crate::scan_likelihood::inlier_ratios;
use crate::sensor_model::tables::ScanLikelihoods;
use crate::status::LocalizationState;

/// Distance of particles from their mean below which beams may be skipped \[m\], as in Nav2.
const CONVERGED_DISTANCE_M: f64 = 0.5;
/// Effective sample size, as a fraction of the particles, below which selective resampling happens.
const MIN_EFFECTIVE_FRACTION: f64 = 0.5;

impl Amcl {
    /// Updates the filter with a scan and odometry at its time. None if the robot hardly moved since
    /// the last update, or while global localization runs.
    ///
    /// One cycle of augmented MCL with KLD-sampling (*Probabilistic Robotics*, tables 8.3 and 8.4),
    /// with scan matching and a decision between pose hypotheses after it.
    ///
    /// # Errors
    /// There is no map or no initial pose, or the scan or odometry is invalid. Nothing changes.
    pub fn update(
        &mut self,
        odom_from_base: Pose2,
        scan: &LaserScan2,
    ) -> Result<Option<AmclUpdate>, Box<Diagnostic>> {
        self.check_inputs(odom_from_base)?;
        self.search.lookup_count = 0;
        if self.particles.is_empty() && !self.initialize(odom_from_base, scan)? {
            return Ok(None);
        }
        self.advance_search();
        if !self.is_update_due(odom_from_base) {
            self.refine_between_updates(odom_from_base, scan);
            return Ok(None);
        }
        let settings = &self.settings;
        let beams = Beams::new(scan, &settings.beams, settings.sensor_model.beam_step())?;
        let scan = MatchingScan::new(scan, &settings.beams)?;

        // Predict: sample the motion model (table 5.6).
        let old_from_new = self.predict(odom_from_base);
        // Weigh: evaluate the sensor model (tables 6.1 and 6.3), update w_slow and w_fast (table 8.3).
        let likelihood = self.weigh(&beams);
        // Resample: KLD-sampling (table 8.4) with random particles (table 8.3).
        let resampled = self.resample_if_due();
        let random_fraction = resampled.unwrap_or(0.0);
        // Decide: between hypotheses, or refine the only one; then check for kidnapping.
        let mut estimate = self.summarize();
        self.update_hypotheses(&mut estimate, &scan, old_from_new, odom_from_base);
        let slip = self.refine_estimate(&mut estimate, &scan, odom_from_base);
        self.update_status(&estimate, &scan);
        if self.relocalize(&mut estimate, &scan, random_fraction, odom_from_base) {
            self.monitor.reset_short_term();
            self.update_status(&estimate, &scan);
        }
        self.verify_at(&scan, estimate.pose, odom_from_base, slip.is_some());
        // Publish.
        let map_from_odom = self.publish(&estimate, odom_from_base, slip);
        Ok(Some(AmclUpdate {
            estimate,
            map_from_odom,
            likelihood,
            random_fraction,
            is_resampled: resampled.is_some(),
            status: self.status.clone(),
        }))
    }

    fn check_inputs(&self, odom_from_base: Pose2) -> Result<(), Box<Diagnostic>> {
        if self.map.is_none() {
            return Err(no_map());
        }
        if !odom_from_base.is_finite() {
            return Err(Diagnostic::error(
                "bad-odometry",
                "a number of the robot's pose in the odometry frame is not finite",
            )
            .help("check the publisher of the transform `odom_frame_id` to `base_frame_id`")
            .into());
        }
        Ok(())
    }

    /// True if the robot moved enough, or an update was requested.
    fn is_update_due(&mut self, odom_from_base: Pose2) -> bool {
        self.is_update_requested |= self.search.has_result();
        let threshold = self.settings.update_threshold;
        let has_moved = |old| has_moved(old, odom_from_base, threshold);
        self.is_update_requested || self.odom_from_base.is_none_or(has_moved)
    }

    /// Localizes the robot globally without an initial pose. A search that takes longer continues
    /// with the next scan. True once there are hypotheses.
    fn initialize(
        &mut self,
        odom_from_base: Pose2,
        scan: &LaserScan2,
    ) -> Result<bool, Box<Diagnostic>> {
        if !self.settings.localizes_globally {
            return Err(no_initial_pose());
        }
        let scan = MatchingScan::new(scan, &self.settings.beams)?;
        if self.search.is_running() {
            self.advance_search();
        } else {
            if let Some(last) = &self.search.last
                && !self.is_update_requested
                && !self.search.is_due(&scan, odom_from_base)
            {
                return Err(last.error.clone());
            }
            self.start_search(&scan, odom_from_base, 0.0);
        }
        let Some(result) = self.search.take_result(odom_from_base) else {
            self.status.reason = "global localization is searching the map".into();
            return Ok(false);
        };
        let last = self.search.last.take();
        if self.start_at_candidates(&scan, &result.peaks, result.completeness) {
            return Ok(true);
        }
        let error = fits_nowhere(&scan);
        self.search.last = Some(match last {
            Some(last) => last.with_error(error.clone()),
            None => LastSearch::new(odom_from_base, &scan, error.clone()),
        });
        self.search.failure_count += 1;
        Err(error)
    }

    /// Moves all particles by a sample of the motion model. Returns the step of odometry since the
    /// last update.
    fn predict(&mut self, odom_from_base: Pose2) -> Option<Pose2> {
        let old = self.odom_from_base.replace(odom_from_base)?;
        let settings = &self.settings;
        let mut stream = Stream::keyed(settings.seed, "amcl motion", self.draw_count);
        let (model, noise) = (settings.motion_model, &settings.motion_noise);
        sample_motion(&mut self.particles, model, noise, old, odom_from_base, &mut stream);
        Some(old.inverse() * odom_from_base)
    }

    /// Multiplies the weights of particles by the likelihood of the scan. Returns the mean
    /// likelihood.
    fn weigh(&mut self, beams: &Beams) -> f64 {
        let Some(map) = &mut self.map else { return 0.0 };
        let settings = &self.settings;
        // While particles are apart, most of them disagree with any beam.
        let has_converged = || self.particles.are_within(CONVERGED_DISTANCE_M);
        let beam_skip = settings.beam_skip.filter(|_| has_converged());
        let (field, sensor) = map.sensor(settings, beams.range_max_m);
        let likelihoods = sensor.evaluate(field, beam_skip, beams, &self.particles);
        let likelihood = apply(&mut self.particles, &likelihoods);
        if likelihood > 0.0 {
            let count = self.particles.len() as f64;
            let is_nav2 = settings.compat == AmclCompat::Nav2;
            let mean = if is_nav2 { likelihood / count } else { likelihood };
            self.recovery.update(mean, settings.recovery_alphas);
        }
        self.is_update_requested = false;
        self.draw_count += 1;
        self.update_count += 1;
        likelihood
    }

    /// Resamples if it is due. Returns the fraction of random particles, or none without resampling.
    fn resample_if_due(&mut self) -> Option<f64> {
        let interval = self.settings.resample_interval.max(1);
        let max_effective_count = MIN_EFFECTIVE_FRACTION * self.particles.len() as f64;
        let is_due = self.update_count.is_multiple_of(interval)
            && (!self.settings.resamples_selectively
                || self.particles.effective_count() <= max_effective_count);
        is_due.then(|| self.resample())
    }

    /// Draws particles in proportion to their weights until there are enough for the bins they
    /// occupy (KLD-sampling). Returns the fraction of particles from the whole map.
    fn resample(&mut self) -> f64 {
        let random_fraction = self.recovery.random_fraction();
        let mut stream = self.random_stream("resample");
        let mut cumulative = Vec::with_capacity(self.particles.len());
        let mut sum = 0.0;
        for weight in &self.particles.weight {
            sum += weight;
            cumulative.push(sum);
        }
        let sampling = self.settings.kld_sampling;
        let draws_random = !self.settings.searches_when_lost;
        let mut drawn = Particles::default();
        let mut bins = OccupiedBins::default();
        while drawn.len() < sampling.max_particles {
            let random = if draws_random && stream.unit() < random_fraction {
                self.map.as_ref().and_then(|map| map.field().random_pose(&mut stream))
            } else {
                None
            };
            let pose = random.unwrap_or_else(|| {
                let level = sum * stream.unit();
                let index = cumulative.partition_point(|&sum| sum <= level);
                self.particles.pose(index.min(cumulative.len() - 1))
            });
            drawn.push(pose);
            if drawn.len() > sampling.particle_count(bins.insert(pose)) {
                break;
            }
        }
        drawn.set_uniform_weights();
        self.particles = drawn;
        if random_fraction > 0.0 {
            // Otherwise the fraction of random particles would grow without bound.
            self.recovery = LikelihoodAverages::default();
        }
        random_fraction
    }

    /// Classifies the state by the clusters and the inlier ratio at the best hypothesis.
    fn update_status(&mut self, estimate: &PoseEstimate, scan: &MatchingScan) {
        let hypotheses = self.mode.hypotheses();
        let inlier_ratio = match (hypotheses, &self.map) {
            (Some(hypotheses), Some(map)) => {
                let best = hypotheses.best().belief.pose;
                inlier_ratios(map.field(), &scan.beams, best).map(|it| it.all)
            }
            _ => self.inlier_ratio(estimate.pose, &scan.beams),
        };
        let is_undecided = hypotheses.is_some();
        self.status = self.monitor.update(&estimate.clusters, inlier_ratio, is_undecided);
    }

    /// Stores estimate and status, and returns the correction of odometry.
    fn publish(
        &mut self,
        estimate: &PoseEstimate,
        odom_from_base: Pose2,
        slip: Option<OdometrySlip>,
    ) -> Pose2 {
        self.status_before_doubt = None;
        self.apply_doubt(slip);
        if self.status.state == LocalizationState::Tracking {
            self.has_pose = true;
            self.search.failure_count = 0;
        }
        let map_from_odom = (estimate.pose * odom_from_base.inverse()).normalized();
        self.map_from_odom = Some(map_from_odom);
        self.estimate = Some(estimate.clone());
        map_from_odom
    }
}

/// Multiplies weights by likelihoods and normalizes them (table 8.3, line 6). Returns the mean
/// likelihood; 0 if all likelihoods are zero: then all weights become equal.
fn apply(particles: &mut Particles, scan: &ScanLikelihoods) -> f64 {
    let mut total = 0.0;
    for (weight, likelihood) in particles.weight.iter_mut().zip(&scan.likelihoods) {
        *weight *= if likelihood.is_nan() { 0.0 } else { *likelihood };
        total += *weight;
    }
    if !(total > 0.0 && total.is_finite()) {
        particles.set_uniform_weights();
        return 0.0;
    }
    let scale = 1.0 / total;
    for weight in &mut particles.weight {
        *weight *= scale;
    }
    total * libm::exp(scan.log_factor)
}
