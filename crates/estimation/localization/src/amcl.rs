//! The particle filter.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Stream};
use periplus_grid::OccupancyGrid;
use periplus_scan_matching::Peak;

mod astray;
mod finer;
mod trust;

use self::finer::Seen;
use self::trust::Trust;
use crate::anywhere::Everywhere;
use crate::bins::{Cluster, Taken, clusters};
use crate::guess::{Guess, check_place, scatter};
use crate::hunt::{Completeness, Hunt};
use crate::known_map::KnownMap;
use crate::motion::move_all;
use crate::particles::{Covariance2, Moments, Particles};
use crate::polish::Known;
use crate::recovery::Recovery;
use crate::rivals::Rivals;
use crate::scan::{Beams, Scan};
use crate::settings::{Compat, Settings};
use crate::status::{State, Status, Watch};
use crate::weigh::{Said, Terms};

/// Particles nearer to their mean than this agree, so that beams may be skipped \[m\].
const CONVERGED_M: f64 = 0.5;

const FITS_NOWHERE: &str = "fits-nowhere";

/// Where the robot is.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// `map_from_base`: the mean of the heaviest cluster.
    pub pose: Pose2,
    /// Of all particles.
    pub covariance: Covariance2,
    /// The heaviest first.
    pub clusters: Vec<Cluster>,
}

/// What came of a scan.
#[derive(Clone, Debug, PartialEq)]
pub struct Update {
    /// Where the robot is.
    pub estimate: Estimate,
    /// Where odometry began, on the map.
    pub map_from_odom: Pose2,
    /// How likely the scan is, averaged over particles.
    pub likelihood: f64,
    /// Which share of the particles was drawn anew from all of the map.
    pub random_share: f64,
    /// Whether particles were drawn anew.
    pub is_resampled: bool,
    /// Whether the robot knows where it is.
    pub status: Status,
}

/// Adaptive Monte Carlo localization: particles that odometry moves, scans weigh, and chance renews.
///
/// No clock, no threads, no files; the same calls with the same seed give the same bits.
#[derive(Clone, Debug)]
pub struct Amcl {
    settings: Settings,
    grid: Option<OccupancyGrid>,
    map: Option<KnownMap>,
    terms: Option<Terms>,
    particles: Particles,
    /// A start that waits for a map.
    waiting: Option<(Pose2, Covariance2)>,
    /// `odom_from_base` at the last scan that was used; none when the next one is.
    odom_from_base: Option<Pose2>,
    is_forced: bool,
    /// How often chance was asked: each time it gets a stream of its own.
    draws: u64,
    /// Scans used since the last start.
    scans: u64,
    recovery: Recovery,
    watch: Watch,
    status: Status,
    estimate: Option<Estimate>,
    map_from_odom: Option<Pose2>,
    /// Where odometry had the robot when it was looked for in vain, and what was said.
    sought: Option<(Pose2, Box<Diagnostic>)>,
    /// Whether somebody has said where the robot is, or it has found out.
    is_settled: bool,
    /// The map, prepared for the search on all of it.
    everywhere: Option<Everywhere>,
    /// A search on all of the map that is not at its end, and where odometry had the robot at its scan.
    search: Option<(Hunt, Pose2)>,
    /// What one has found, and the same.
    found: Option<(Vec<Peak>, Completeness, Pose2)>,
    /// With how many scans it was searched on this map.
    searches: u64,
    /// How many lookups that was with the last one.
    searched: u64,
    /// What the beams measured with which it was looked for last \[m\].
    sought_m: Vec<f32>,
    /// What speaks for the place that is told.
    trust: Trust,
    /// Places of which one is the right one.
    rivals: Option<Rivals>,
    /// The refined pose, and where odometry had the robot then.
    fine: Option<(Known, Pose2)>,
    /// Where scans have the robot while odometry stands still.
    ahead: Option<Known>,
    /// The last step of the refined pose, from scan to scan.
    stride: Option<Pose2>,
    /// How far a scan contradicts odometry: \[m\], \[rad\].
    jump: Option<(f64, f64)>,
    /// What the status was before that.
    undoubted: Option<Status>,
    /// The same from before other places came into question.
    home: Option<(Known, Pose2)>,
    /// How often a lost robot was looked for in vain.
    vain: u32,
    /// How far the robot went since a scan fitted \[m\].
    astray_m: f64,
}

impl Amcl {
    /// Without a map yet. Where settings say where to start, it does as soon as there is one.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self {
            waiting: settings.start,
            settings,
            grid: None,
            map: None,
            terms: None,
            particles: Particles::default(),
            odom_from_base: None,
            is_forced: false,
            draws: 0,
            scans: 0,
            recovery: Recovery::default(),
            watch: Watch::default(),
            status: Status::default(),
            estimate: None,
            map_from_odom: None,
            sought: None,
            is_settled: false,
            everywhere: None,
            search: None,
            found: None,
            searches: 0,
            searched: 0,
            sought_m: Vec::new(),
            trust: Trust::default(),
            rivals: None,
            fine: None,
            ahead: None,
            stride: None,
            jump: None,
            undoubted: None,
            vain: 0,
            astray_m: 0.0,
            home: None,
        }
    }

    /// What holds.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The map.
    #[must_use]
    pub fn map(&self) -> Option<&KnownMap> {
        self.map.as_ref()
    }

    /// Guesses of where the robot is; none before anybody said so.
    #[must_use]
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// Where the robot was at the last scan that was used.
    #[must_use]
    pub fn estimate(&self) -> Option<&Estimate> {
        self.estimate.as_ref()
    }

    /// Where odometry began, on the map; none before the first scan.
    #[must_use]
    pub fn map_from_odom(&self) -> Option<Pose2> {
        self.map_from_odom
    }

    /// Whether the robot knows where it is.
    #[must_use]
    pub fn status(&self) -> &Status {
        &self.status
    }

    /// Whether a pose is known: somebody has said where the robot is, or after a start anywhere one
    /// place was left over. Before, [`Amcl::estimate`] is one guess among others.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.is_settled
    }

    /// Forgets where odometry was: it began anew, or is another one.
    pub fn forget_odometry(&mut self) {
        self.odom_from_base = None;
        self.sought = None;
        self.fine = None;
        self.home = None;
        self.search = None;
        self.found = None;
    }

    /// How much was done with the last scan to look for the robot on all of the map, in lookups of
    /// points. It is bounded, whatever the map: a search that takes more goes on with the next scans.
    #[must_use]
    pub fn searched(&self) -> u64 {
        self.searched
    }

    /// How well scans fit, as recovery sees it.
    #[must_use]
    pub fn recovery(&self) -> Recovery {
        self.recovery
    }

    /// Changes settings while running. Particles stay; the next scan follows the new ones.
    ///
    /// # Errors
    /// When the map cannot be prepared in the new way; the old settings stay.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), Box<Diagnostic>> {
        if let Some(grid) = &self.grid
            && settings.map() != self.settings.map()
        {
            self.map = Some(KnownMap::new(grid, settings.map())?);
            self.terms = None;
            self.everywhere = None;
            self.search = None;
            self.found = None;
        }
        self.settings = settings;
        Ok(())
    }

    /// Takes a map. A robot whose place is known stays there. False when `first_map_only` holds and
    /// there is one already.
    ///
    /// # Errors
    /// When the map is in another frame, has no cells or no walls: the map before stays. When the robot
    /// or a start that waited would be outside of it: the map is taken, and somebody must say where the
    /// robot is.
    pub fn set_map(&mut self, frame: &str, grid: &OccupancyGrid) -> Result<bool, Box<Diagnostic>> {
        if self.settings.first_map_only && self.map.is_some() {
            return Ok(false);
        }
        let wanted = &self.settings.global_frame;
        if frame != wanted && self.settings.compat != Compat::Nav2 {
            return Err(Diagnostic::error(
                "map-in-other-frame",
                format!("the map is in frame `{frame}`, `global_frame_id` is `{wanted}`"),
            )
            .help(format!("set `global_frame_id: {frame}`, or have the map server say `{wanted}`"))
            .into());
        }
        let map = KnownMap::new(grid, self.settings.map())?;
        self.grid = Some(grid.clone());
        self.everywhere = self.settings.searches().then(|| Everywhere::new(&map));
        self.map = Some(map);
        self.terms = None;
        self.search = None;
        self.found = None;
        self.searches = 0;
        let known = self.estimate.as_ref().map(|it| (it.pose, it.covariance));
        match self.waiting.take().or(known) {
            Some((pose, covariance)) => {
                // If that fails, particles of another map mean nothing.
                self.particles = Particles::default();
                self.start_at(pose, covariance).map(|_| true)
            }
            None => Ok(true),
        }
    }

    /// Starts where somebody says that the robot is. Without a map this waits for one. What is
    /// doubtful about the place is told.
    ///
    /// # Errors
    /// When the guess makes no sense: another frame, no numbers, outside of the map. Nothing changes.
    pub fn set_pose(&mut self, guess: &Guess) -> Result<Option<Diagnostic>, Box<Diagnostic>> {
        guess.check(&self.settings.global_frame, self.settings.compat)?;
        let (pose, covariance) = (guess.now(), Covariance2::from_rows(&guess.covariance));
        if self.map.is_none() {
            self.waiting = Some((pose, covariance));
            return Ok(Some(
                Diagnostic::warning("no-map", "the initial pose waits for a map")
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
        let doubt = check_place(map, pose, self.settings.compat)?;
        let mut stream = self.stream("start");
        let mut particles = Particles::default();
        scatter(&mut particles, self.settings.size.most, pose, covariance, &mut stream);
        self.begin(particles);
        self.is_settled = true;
        Ok(doubt)
    }

    /// Spreads particles over all free cells: the robot may be anywhere.
    ///
    /// # Errors
    /// When there is no map, or no free cell on it.
    pub fn spread(&mut self) -> Result<(), Box<Diagnostic>> {
        let mut stream = self.stream("spread");
        let map = self.map.as_ref().ok_or_else(no_map)?;
        let mut particles = Particles::default();
        for _ in 0..self.settings.size.most {
            particles.push(map.random_pose(&mut stream).ok_or_else(nothing_free)?);
        }
        self.begin(particles);
        self.is_settled = true;
        self.trust.open(0);
        Ok(())
    }

    /// Starts where the scan fits best in all of the map, and wherever it fits nearly as well: by a
    /// search that misses no place of its lattice. Returns these places, the best first; when there
    /// are several, each is followed until one is left over.
    ///
    /// # Errors
    /// When there is no map, the scan is useless, or it fits nowhere.
    pub fn start_anywhere(&mut self, scan: &Scan) -> Result<Vec<Peak>, Box<Diagnostic>> {
        if self.map.is_none() {
            return Err(no_map());
        }
        let seen = Seen::new(scan, &self.settings)?;
        let peaks = self.look_everywhere(&seen);
        self.start_at_peaks(&seen, &peaks, Completeness::Best)?;
        Ok(peaks)
    }

    /// Starts at places that a search has found.
    fn start_at_peaks(
        &mut self,
        seen: &Seen,
        peaks: &[Peak],
        completeness: Completeness,
    ) -> Result<(), Box<Diagnostic>> {
        let Some(map) = &self.map else { return Err(no_map()) };
        let poses = peaks.iter().map(|peak| peak.pose);
        let Some(rivals) = Rivals::new(map, &seen.beams, &seen.ends, poses, completeness) else {
            let (hits, beams) = (seen.ends.len(), seen.beams.beams.len());
            return Err(Diagnostic::error(FITS_NOWHERE, "the scan fits nowhere on the map")
                .note(format!("{hits} of its {beams} beams hit anything"))
                .help("move the robot to where it sees walls, or check that this is the right map")
                .into());
        };
        let particles = self.drawn_from(&rivals);
        self.begin(particles);
        self.trust.open(0);
        self.rivals = Some(rivals);
        Ok(())
    }

    /// Uses the next scan whether or not the robot moved.
    pub fn request_update(&mut self) {
        self.is_forced = true;
    }

    fn begin(&mut self, mut particles: Particles) {
        particles.level();
        self.particles = particles;
        self.odom_from_base = None;
        self.scans = 0;
        self.recovery = Recovery::default();
        self.watch = Watch::default();
        self.waiting = None;
        self.sought = None;
        self.search = None;
        self.found = None;
        self.trust = Trust::default();
        self.vain = 0;
        self.is_settled = false;
        self.rivals = None;
        self.fine = None;
        self.ahead = None;
        self.stride = None;
        self.jump = None;
        self.undoubted = None;
        self.home = None;
        self.astray_m = 0.0;
        self.estimate = Some(self.sum_up());
        self.status =
            Status { reason: "no scan has been used since the start".into(), ..Status::default() };
    }

    /// How likely a scan is at each particle, up to a common factor; nothing changes.
    ///
    /// # Errors
    /// When there is no map, or the scan is useless.
    pub fn likelihoods(&mut self, scan: &Scan) -> Result<Vec<f64>, Box<Diagnostic>> {
        let map = self.map.as_ref().ok_or_else(no_map)?;
        let settings = &self.settings;
        let beams = Beams::new(scan, &settings.beams, settings.model.thinning())?;
        let terms = terms_for(self.terms.take(), map, settings, beams.range_max_m);
        let said = terms.weigh(map, settings.skip, &beams, &self.particles);
        self.terms = Some(terms);
        Ok(said.factors)
    }

    /// Takes a scan and where odometry has the robot at its time. Nothing when the robot has hardly
    /// moved since the last scan that was used.
    ///
    /// # Errors
    /// When there is no map, nobody has said where the robot is, or the scan or odometry is useless.
    /// Nothing changes.
    pub fn update(
        &mut self,
        odom_from_base: Pose2,
        scan: &Scan,
    ) -> Result<Option<Update>, Box<Diagnostic>> {
        if self.map.is_none() {
            return Err(no_map());
        }
        if !odom_from_base.is_finite() {
            return Err(Diagnostic::error(
                "bad-odometry",
                "a number of the robot's pose in the frame of odometry is not finite",
            )
            .help("check what publishes `odom_frame_id` to `base_frame_id`")
            .into());
        }
        self.searched = 0;
        if self.particles.is_empty() && !self.seek(odom_from_base, scan)? {
            return Ok(None);
        }
        self.go_on();
        self.is_forced |= self.found.is_some();
        if let Some(old) = self.odom_from_base
            && !self.is_forced
            && !has_moved(old, odom_from_base, self.settings.update_min)
        {
            self.refine(odom_from_base, scan);
            return Ok(None);
        }
        let Some(map) = &self.map else { return Err(no_map()) };
        let settings = &self.settings;
        let beams = Beams::new(scan, &settings.beams, settings.model.thinning())?;
        self.jump = None;
        let range_max_m = beams.range_max_m;
        let terms = self.terms.take();
        let terms = terms_for(terms, map, settings, range_max_m);

        let old_from_new = self.odom_from_base.map(|old| old.inverse() * odom_from_base);
        if let Some(old) = self.odom_from_base {
            let mut stream = Stream::keyed(settings.seed, "amcl motion", self.draws);
            let particles = &mut self.particles;
            let (drive, alphas) = (settings.drive, &settings.alphas);
            move_all(particles, drive, alphas, old, odom_from_base, &mut stream);
        }
        // While particles are apart, most of them contradict any beam.
        let skip = settings.skip.filter(|_| self.particles.is_within(CONVERGED_M));
        let said = terms.weigh(map, skip, &beams, &self.particles);
        let likelihood = apply(&mut self.particles, &said);
        if likelihood > 0.0 {
            let count = self.particles.len() as f64;
            let mean =
                if settings.compat == Compat::Nav2 { likelihood / count } else { likelihood };
            self.recovery.take(mean, settings.recovery_alphas);
        }
        self.terms = Some(terms);
        self.odom_from_base = Some(odom_from_base);
        self.is_forced = false;
        self.draws += 1;
        self.scans += 1;

        let few_count = || self.particles.effective() <= 0.5 * self.particles.len() as f64;
        let is_due = self.scans.is_multiple_of(self.settings.resample_interval.max(1));
        let is_resampled = is_due && (!self.settings.is_selective || few_count());
        let random_share = if is_resampled { self.resample() } else { 0.0 };

        let mut estimate = self.sum_up();
        let seen = Seen::new(scan, &self.settings)?;
        self.follow(&mut estimate, &seen, old_from_new, odom_from_base);
        self.polish(&mut estimate, &seen, odom_from_base);
        let fit = self.fit_of_best(&estimate, &seen.beams);
        self.status = self.watch.judge(&estimate.clusters, fit, self.rivals.is_some());
        if self.look_out(&mut estimate, &seen, random_share, odom_from_base) {
            self.watch.forgive();
            let fit = self.fit_of_best(&estimate, &seen.beams);
            self.status = self.watch.judge(&estimate.clusters, fit, self.rivals.is_some());
        }
        self.see_at(&seen, estimate.pose, odom_from_base);
        self.undoubted = None;
        self.doubt();
        if self.status.state == State::Tracking {
            self.is_settled = true;
            self.vain = 0;
        }
        let map_from_odom = (estimate.pose * odom_from_base.inverse()).normalized();
        self.map_from_odom = Some(map_from_odom);
        self.estimate = Some(estimate.clone());
        let status = self.status.clone();
        Ok(Some(Update { estimate, map_from_odom, likelihood, random_share, is_resampled, status }))
    }

    /// Looks for the robot on all of the map, once for each place where odometry has it; whether there
    /// are places where it may be. A search that takes longer goes on with the next scan.
    fn seek(&mut self, odom_from_base: Pose2, scan: &Scan) -> Result<bool, Box<Diagnostic>> {
        if !self.settings.starts_anywhere {
            return Err(no_pose());
        }
        let seen = Seen::new(scan, &self.settings)?;
        if self.search.is_some() {
            self.go_on();
        } else {
            if let Some((_, why)) = &self.sought
                && !self.is_forced
                && !self.is_elsewhere(&seen, odom_from_base)
            {
                return Err(why.clone());
            }
            self.begin_search(&seen, odom_from_base, 0.0);
        }
        let Some((peaks, completeness)) = self.take_found(odom_from_base) else {
            self.status.reason = "the robot is being looked for on all of the map".into();
            return Ok(false);
        };
        let place = self.sought.take().map_or(odom_from_base, |(place, _)| place);
        let found = self.start_at_peaks(&seen, &peaks, completeness);
        if let Err(why) = &found
            && why.code == FITS_NOWHERE
        {
            self.sought = Some((place, why.clone()));
            self.vain += 1;
        }
        found.map(|()| true)
    }

    /// Draws particles anew, each as often as it counts, until there are enough for the bins they
    /// fill. Returns the share that came from all of the map.
    fn resample(&mut self) -> f64 {
        let share = self.recovery.share();
        let mut stream = self.stream("resample");
        let mut sums = Vec::with_capacity(self.particles.len());
        let mut sum = 0.0;
        for weight in &self.particles.weight {
            sum += weight;
            sums.push(sum);
        }
        let size = self.settings.size;
        let mut drawn = Particles::default();
        let mut taken = Taken::default();
        while drawn.len() < size.most {
            let anywhere = if !self.settings.seeks_when_lost && stream.unit() < share {
                self.map.as_ref().and_then(|map| map.random_pose(&mut stream))
            } else {
                None
            };
            let pose = anywhere.unwrap_or_else(|| {
                let level = sum * stream.unit();
                let index = sums.partition_point(|&sum| sum <= level);
                self.particles.pose(index.min(sums.len() - 1))
            });
            drawn.push(pose);
            if drawn.len() > size.needed(taken.take(pose)) {
                break;
            }
        }
        drawn.level();
        self.particles = drawn;
        if share > 0.0 {
            // Otherwise ever more particles would be drawn from anywhere.
            self.recovery = Recovery::default();
        }
        share
    }

    fn sum_up(&self) -> Estimate {
        let particles = &self.particles;
        let clusters = clusters(particles);
        let pose = clusters.first().map_or(Pose2::IDENTITY, |cluster| cluster.mean);
        let mut all = Moments::around(pose);
        for index in 0..particles.len() {
            all.add(particles.pose(index), particles.weight[index]);
        }
        Estimate { pose, covariance: all.covariance(), clusters }
    }

    fn stream(&mut self, name: &str) -> Stream {
        self.draws += 1;
        Stream::keyed(self.settings.seed, &format!("amcl {name}"), self.draws)
    }
}

/// Whether the robot moved further along x or y of odometry, or turned further, than the least.
#[must_use]
pub fn has_moved(old: Pose2, new: Pose2, (least_m, least_rad): (f64, f64)) -> bool {
    let turn = periplus_geometry::normalize_angle(new.yaw_rad - old.yaw_rad);
    (new.x_m - old.x_m).abs() > least_m
        || (new.y_m - old.y_m).abs() > least_m
        || turn.abs() > least_rad
}

/// What is known of the map for a model, made anew only when it has to be.
fn terms_for(terms: Option<Terms>, map: &KnownMap, settings: &Settings, range_max_m: f64) -> Terms {
    let Settings { model, mixture, compat, .. } = settings;
    terms
        .filter(|terms| terms.is_for(*model, mixture, range_max_m, *compat))
        .unwrap_or_else(|| Terms::new(map, *model, mixture, range_max_m, *compat))
}

/// Multiplies weights by what the scan says, and brings their sum back to one. Returns the mean of
/// what the scan says, 0 when it is impossible everywhere: then all count alike.
fn apply(particles: &mut Particles, said: &Said) -> f64 {
    let mut total = 0.0;
    for (weight, factor) in particles.weight.iter_mut().zip(&said.factors) {
        *weight *= if factor.is_nan() { 0.0 } else { *factor };
        total += *weight;
    }
    if !(total > 0.0 && total.is_finite()) {
        particles.level();
        return 0.0;
    }
    let share = 1.0 / total;
    for weight in &mut particles.weight {
        *weight *= share;
    }
    total * libm::exp(said.scale)
}

fn no_map() -> Box<Diagnostic> {
    Diagnostic::error("no-map", "there is no map yet")
        .help("start a map server, and check `map_topic`")
        .into()
}

fn no_pose() -> Box<Diagnostic> {
    Diagnostic::error("no-initial-pose", "nobody has said where the robot is")
        .help(
            "set the initial pose: in RViz by `2D Pose Estimate`, by parameter with \
               `set_initial_pose: true`, or ask for a start anywhere",
        )
        .into()
}

fn nothing_free() -> Box<Diagnostic> {
    Diagnostic::error("nothing-free", "no cell of the map is free, so the robot can be nowhere")
        .help("check `free_thresh` and `negate` in the map's YAML")
        .into()
}
