//! Adaptive Monte Carlo localization.

use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, DiagnosticCause};
use periplus_geometry::{LaserScan2, Pose2, Stream};
use periplus_grid::OccupancyGrid;
use periplus_scan_matching::Peak;

mod global_search;
mod kidnap_recovery;
mod local_search;
mod mode;
mod pose_verification;
mod tracking;
mod update;

use self::global_search::GlobalSearch;
use self::mode::Mode;
use self::pose_verification::PoseVerification;
use crate::branch_and_bound::Completeness;
use crate::hypotheses::Hypotheses;
use crate::initial_pose::{InitialPose, check_position, scatter};
use crate::kld_sampling::{Cluster, clusters};
use crate::likelihood_map::LikelihoodMap;
use crate::parameters::AmclCompat;
use crate::particles::{Covariance2, Moments, Particles};
use crate::recovery::LikelihoodAverages;
use crate::scan::{Beams, MatchingScan};
use crate::settings::Settings;
use crate::shared_maps::{PreparedMap, SharedMaps};
use crate::status::{ConvergenceMonitor, LocalizationStatus};

/// Estimated pose of the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseEstimate {
    /// `map_from_base`: the mean of the cluster of largest weight, refined by scan matching.
    pub pose: Pose2,
    /// Covariance of all particles around `pose`.
    pub covariance: Covariance2,
    /// Clusters in order of decreasing weight.
    pub clusters: Vec<Cluster>,
}

/// Result of an update of the filter.
#[derive(Clone, Debug, PartialEq)]
pub struct AmclUpdate {
    /// Estimated pose.
    pub estimate: PoseEstimate,
    /// Correction of odometry: `map_from_base` times the inverse of `odom_from_base`.
    pub map_from_odom: Pose2,
    /// Mean likelihood of the scan over the particles.
    pub likelihood: f64,
    /// Probability with which particles were drawn from the whole map.
    pub random_fraction: f64,
    /// True if the particles were resampled.
    pub is_resampled: bool,
    /// Status of localization.
    pub status: LocalizationStatus,
}

/// Adaptive Monte Carlo localization: a particle filter with KLD-sampling, scan matching and global
/// localization.
///
/// No clock, no threads, no files; the same calls with the same seed give the same bits.
#[derive(Clone, Debug)]
pub struct Amcl {
    settings: Settings,
    maps: Arc<SharedMaps>,
    map: Option<PreparedMap>,
    mode: Mode,
    /// Particles; none in [`Mode::Uninitialized`].
    particles: Particles,
    recovery: LikelihoodAverages,
    /// Odometry at the last update; none if the next scan is to be used.
    odom_from_base: Option<Pose2>,
    is_update_requested: bool,
    /// Number of random streams drawn.
    draw_count: u64,
    /// Number of updates since the last initial pose.
    update_count: u64,
    search: GlobalSearch,
    verification: PoseVerification,
    monitor: ConvergenceMonitor,
    /// Distance since the last matching scan \[m\].
    unmatched_distance_m: f64,
    has_pose: bool,
    status: LocalizationStatus,
    /// Status of the filter where scans or verification put it in doubt.
    status_before_doubt: Option<LocalizationStatus>,
    estimate: Option<PoseEstimate>,
    map_from_odom: Option<Pose2>,
}

impl Amcl {
    /// Creates a filter without a map. An initial pose of the settings is applied with the first
    /// map.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self::sharing(settings, Arc::default())
    }

    /// Creates a filter that shares its maps and their tables with others.
    #[must_use]
    pub fn sharing(settings: Settings, maps: Arc<SharedMaps>) -> Self {
        Self {
            maps,
            map: None,
            mode: Mode::Uninitialized { initial_pose: settings.initial_pose },
            settings,
            particles: Particles::default(),
            recovery: LikelihoodAverages::default(),
            odom_from_base: None,
            is_update_requested: false,
            draw_count: 0,
            update_count: 0,
            search: GlobalSearch::default(),
            verification: PoseVerification::default(),
            monitor: ConvergenceMonitor::default(),
            unmatched_distance_m: 0.0,
            has_pose: false,
            status: LocalizationStatus::default(),
            status_before_doubt: None,
            estimate: None,
            map_from_odom: None,
        }
    }

    /// Present settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Present map.
    #[must_use]
    pub fn map(&self) -> Option<&LikelihoodMap> {
        self.map.as_ref().map(PreparedMap::field)
    }

    /// Particles; none before an initial pose or global localization.
    #[must_use]
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// Estimate of the last update.
    #[must_use]
    pub fn estimate(&self) -> Option<&PoseEstimate> {
        self.estimate.as_ref()
    }

    /// Correction of odometry; none before the first scan.
    #[must_use]
    pub fn map_from_odom(&self) -> Option<Pose2> {
        self.map_from_odom
    }

    /// Status of localization.
    #[must_use]
    pub fn status(&self) -> &LocalizationStatus {
        &self.status
    }

    /// True once an initial pose was set or global localization converged. Before,
    /// [`Amcl::estimate`] is one hypothesis among others.
    #[must_use]
    pub fn has_pose(&self) -> bool {
        self.has_pose
    }

    /// Work of the last scan on a search of the map \[lookups\]. The work per scan is bounded for
    /// all maps; a longer search continues with the next scans.
    #[must_use]
    pub fn search_lookup_count(&self) -> u64 {
        self.search.lookup_count
    }

    /// Averages of the measurement likelihood.
    #[must_use]
    pub fn recovery(&self) -> LikelihoodAverages {
        self.recovery
    }

    /// Resets odometry: its origin changed.
    pub fn reset_odometry(&mut self) {
        self.odom_from_base = None;
        self.search.reset_odometry();
        self.mode.reset_odometry();
    }

    /// Changes settings while running. Particles stay; the next scan uses the new settings.
    ///
    /// # Errors
    /// The map cannot be prepared with the new settings; the old settings stay.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), Box<Diagnostic>> {
        if let Some(map) = &mut self.map
            && settings.map_settings() != self.settings.map_settings()
        {
            *map = self.maps.prepare(map.grid(), settings.map_settings())?;
            self.search.cancel();
        }
        self.settings = settings;
        Ok(())
    }

    /// True if there is a map.
    #[must_use]
    pub fn has_map(&self) -> bool {
        self.map.is_some()
    }

    /// Sets the map. A known pose stays. False if `first_map_only` is set and there is a map
    /// already.
    ///
    /// # Errors
    /// The map is in another frame, or has no cells or no obstacles: the map before stays. Or the
    /// known or initial pose is outside of it: the map is set, and needs a new initial pose.
    pub fn set_map(&mut self, frame: &str, grid: &OccupancyGrid) -> Result<bool, Box<Diagnostic>> {
        if self.settings.first_map_only && self.map.is_some() {
            return Ok(false);
        }
        let expected = &self.settings.global_frame;
        if frame != expected && self.settings.compat != AmclCompat::Nav2 {
            return Err(Diagnostic::error(
                "map-in-other-frame",
                format!("the map is in frame `{frame}`, `global_frame_id` is `{expected}`"),
            )
            .help(format!(
                "set `global_frame_id: {frame}`, or publish the map in frame `{expected}`"
            ))
            .into());
        }
        let map = self.maps.prepare(grid, self.settings.map_settings())?;
        if self.settings.uses_global_localization() {
            map.localizer();
        }
        self.map = Some(map);
        self.search.reset_map();
        let initial_pose = match &mut self.mode {
            Mode::Uninitialized { initial_pose } => initial_pose.take(),
            _ => None,
        };
        let known = self.estimate.as_ref().map(|it| (it.pose, it.covariance));
        if let Some((pose, covariance)) = initial_pose.or(known) {
            // Particles of the map before mean nothing if the pose is outside of this one.
            self.particles = Particles::default();
            self.mode = Mode::Uninitialized { initial_pose: None };
            self.start_at(pose, covariance)?;
        }
        Ok(true)
    }

    /// Sets the initial pose. Without a map, the pose waits for one. Returns a warning about a
    /// doubtful pose.
    ///
    /// # Errors
    /// The pose is invalid: another frame, not finite, outside of the map. Nothing changes.
    pub fn set_pose(
        &mut self,
        initial_pose: &InitialPose,
    ) -> Result<Option<Diagnostic>, Box<Diagnostic>> {
        initial_pose.check(&self.settings.global_frame, self.settings.compat)?;
        let pose = initial_pose.map_from_base();
        let covariance = Covariance2::from_rows(&initial_pose.covariance);
        if self.map.is_none() {
            self.mode = Mode::Uninitialized { initial_pose: Some((pose, covariance)) };
            return Ok(Some(
                Diagnostic::warning("no-map", "the initial pose waits for a map")
                    .caused_by(DiagnosticCause::MissingMap)
                    .help("start a map server, and check `map_topic`"),
            ));
        }
        self.start_at(pose, covariance)
    }

    fn start_at(
        &mut self,
        pose: Pose2,
        covariance: Covariance2,
    ) -> Result<Option<Diagnostic>, Box<Diagnostic>> {
        let Some(map) = &self.map else { return Ok(None) };
        let warning = check_position(map.field(), pose, self.settings.compat)?;
        let mut stream = self.random_stream("start");
        let mut particles = Particles::default();
        let count = self.settings.kld_sampling.max_particles;
        scatter(&mut particles, count, pose, covariance, &mut stream);
        self.start(particles, Mode::Tracking { refined: None });
        self.has_pose = true;
        Ok(warning)
    }

    /// Distributes particles uniformly over the free cells of the map, as the service
    /// `reinitialize_global_localization` of Nav2.
    ///
    /// # Errors
    /// There is no map, or no free cell on it.
    pub fn distribute_uniformly(&mut self) -> Result<(), Box<Diagnostic>> {
        let mut stream = self.random_stream("spread");
        let map = self.map.as_ref().ok_or_else(no_map)?;
        let mut particles = Particles::default();
        for _ in 0..self.settings.kld_sampling.max_particles {
            particles.push(map.field().random_pose(&mut stream).ok_or_else(no_free_cell)?);
        }
        self.start(particles, Mode::Tracking { refined: None });
        self.has_pose = true;
        self.verification.require(0);
        Ok(())
    }

    /// Localizes the robot globally: finds all poses on the map that fit a scan about as well as the
    /// best one, and tracks them until one remains. Returns the poses, best first.
    ///
    /// # Errors
    /// There is no map, the scan is invalid, or it fits nowhere.
    pub fn localize_globally(&mut self, scan: &LaserScan2) -> Result<Vec<Peak>, Box<Diagnostic>> {
        let map = self.map.as_ref().ok_or_else(no_map)?;
        let scan = MatchingScan::new(scan, &self.settings.beams)?;
        let peaks = map.localizer().1.peaks(&scan.ends);
        if !self.start_at_candidates(&scan, &peaks, Completeness::NearBest) {
            return Err(fits_nowhere(&scan));
        }
        Ok(peaks)
    }

    /// Starts to track the candidates of a search. False if there are none.
    fn start_at_candidates(
        &mut self,
        scan: &MatchingScan,
        peaks: &[Peak],
        completeness: Completeness,
    ) -> bool {
        let Some(map) = &self.map else { return false };
        let poses = peaks.iter().map(|peak| peak.pose);
        let Some(hypotheses) = Hypotheses::new(map.field(), scan, poses, completeness) else {
            return false;
        };
        let particles = self.particles_at(&hypotheses);
        self.start(particles, Mode::Hypotheses(hypotheses));
        self.verification.require(0);
        true
    }

    /// Uses the next scan even if the robot did not move.
    pub fn request_update(&mut self) {
        self.is_update_requested = true;
    }

    fn start(&mut self, mut particles: Particles, mode: Mode) {
        particles.set_uniform_weights();
        self.particles = particles;
        self.mode = mode;
        self.odom_from_base = None;
        self.update_count = 0;
        self.recovery = LikelihoodAverages::default();
        self.monitor = ConvergenceMonitor::default();
        self.verification = PoseVerification::default();
        self.search.reset();
        self.unmatched_distance_m = 0.0;
        self.has_pose = false;
        self.status_before_doubt = None;
        self.estimate = Some(self.summarize());
        self.status = LocalizationStatus {
            reason: "no scan was used since the start".into(),
            ..LocalizationStatus::default()
        };
    }

    /// Likelihoods of a scan at all particles, up to a common factor. Nothing changes.
    ///
    /// # Errors
    /// There is no map, or the scan is invalid.
    pub fn likelihoods(&mut self, scan: &LaserScan2) -> Result<Vec<f64>, Box<Diagnostic>> {
        let map = self.map.as_mut().ok_or_else(no_map)?;
        let settings = &self.settings;
        let beams = Beams::new(scan, &settings.beams, settings.sensor_model.beam_step())?;
        let (field, sensor) = map.sensor(settings, beams.range_max_m);
        let scan = sensor.evaluate(field, settings.beam_skip, &beams, &self.particles);
        Ok(scan.likelihoods)
    }

    /// Summarizes the particles.
    fn summarize(&self) -> PoseEstimate {
        let particles = &self.particles;
        let clusters = clusters(particles);
        let pose = clusters.first().map_or(Pose2::IDENTITY, |cluster| cluster.mean);
        let mut moments = Moments::around(pose);
        for index in 0..particles.len() {
            moments.add(particles.pose(index), particles.weight[index]);
        }
        PoseEstimate { pose, covariance: moments.covariance(), clusters }
    }

    /// Stream of random numbers that is used for one purpose once.
    fn random_stream(&mut self, purpose: &str) -> Stream {
        self.draw_count += 1;
        Stream::keyed(self.settings.seed, &format!("amcl {purpose}"), self.draw_count)
    }
}

fn no_map() -> Box<Diagnostic> {
    Diagnostic::error("no-map", "there is no map yet")
        .caused_by(DiagnosticCause::MissingMap)
        .help("start a map server, and check `map_topic`")
        .into()
}

fn no_initial_pose() -> Box<Diagnostic> {
    Diagnostic::error("no-initial-pose", "no initial pose is set")
        .caused_by(DiagnosticCause::MissingInitialPose)
        .help(
            "set the initial pose: in RViz with `2D Pose Estimate`, by parameter with \
             `set_initial_pose: true`, or enable global localization with `global_start: true`",
        )
        .into()
}

fn no_free_cell() -> Box<Diagnostic> {
    Diagnostic::error("nothing-free", "no cell of the map is free, so no pose is possible")
        .caused_by(DiagnosticCause::NoPossiblePose)
        .help("check `free_thresh` and `negate` in the map's YAML")
        .into()
}

fn fits_nowhere(scan: &MatchingScan) -> Box<Diagnostic> {
    let (hit_count, beam_count) = (scan.ends.len(), scan.beams.beams.len());
    Diagnostic::error("fits-nowhere", "the scan fits nowhere on the map")
        .caused_by(DiagnosticCause::NoPossiblePose)
        .note(format!("{hit_count} of its {beam_count} beams hit anything"))
        .help("move the robot to where it sees walls, or check that this is the right map")
        .into()
}
