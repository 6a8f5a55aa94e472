//! Rao-Blackwellized particle filter: each particle has its own map.
//!
//! Written from the equations of Grisetti, Stachniss, Burgard 2007, "Improved Techniques for Grid Mapping
//! With Rao-Blackwellized Particle Filters"; equation numbers in comments are theirs. Processing of a scan:
//! 1. A graph SLAM front end estimates the motion by scan matching (Haehnel et al. 2003 do the same before
//!    sampling).
//! 2. After enough motion each particle is moved, matches the scan against its own map (`fit`), and samples
//!    a pose from the proposal distribution (`proposal`).
//! 3. The scan is inserted into its map, which shares unchanged tiles with other maps (`cells`).
//! 4. Particles are resampled if the effective sample size is low (`resample`).
//! 5. Each trajectory that a loop closure of the front end gives is offered to some of the particles and
//!    weighted against theirs (`offers`); at the end its closures decide where the particles' map violates
//!    them and nothing contradicts the graph's map (`fallback`).
//!
//! Along corridors, where only odometry measures the distance, particles are spread as widely as the front
//! end is uncertain, each with its own slowly varying errors (`proposal`). Memory is bounded: if the
//! maps share too little, fewer particles continue, with a remark.
//!
//! The result is the map of the particle with the highest weight over its whole trajectory (`ways`).

mod beams;
mod cells;
mod fallback;
mod fit;
mod nodes;
mod offers;
mod proposal;
mod resample;
mod settings;
mod spread;
mod trace;
mod ways;

use std::thread;

use periplus_geometry::{LaserScan2, Pose2, Stream};

use crate::engine::{Counts, ScanOutcome, Slam, Update};
use crate::keyframe::TrajectoryNode;
use crate::local::apart;
use crate::map::Plan;
use crate::method::{Mapper, Method};
use crate::remark::{Remark, RemarkKind};
use crate::settings::Settings;

use beams::Beams;
use cells::Cells;
use fit::{Guess, climb};
use nodes::Node;
use offers::Offered;
use trace::Trace;
use ways::{Tip, Ways};

pub use settings::{GmappingSettings, Noise};

/// Scans are laid onto cells in which at least this part of the beams ended.
const SOLID_CELL_RATIO: f64 = 0.1;
/// Scans of fewer points cannot be laid onto a map.
const LEAST_POINTS: usize = 12;
/// Part of the points that the map must have something near for a scan to fit.
const MIN_MATCHED_RATIO: f64 = 0.3;
/// Minimum standard deviation of odometry \[m, rad\].
const MIN_SIGMAS_M_RAD: [f64; 2] = [0.01, 0.005];
/// Kept scans that the front end remembers; it lays new ones onto no more.
const FRONT_END_SCANS: usize = 30;
/// Bytes that the front end and the scans that were used may take \[bytes\]: some 5 km. Without them the
/// particles go on alone.
const MAX_FRONT_END_BYTES: usize = 64 << 20;
/// Bytes that the maps of all particles may take, and after how many scans that are used these are weighed.
const MAX_MAPS_BYTES: usize = 80 << 20;
const SIZE_CHECK_INTERVAL_SCANS: u64 = 4;
/// Number of scans for whose unshared tiles memory is reserved per particle.
const RESERVED_SCANS: usize = 2;
/// Errors that last do so for about this way \[m\].
const LASTING_M: f64 = 20.0;
/// Path length equivalent of a rotation by one radian \[m\].
const TURN_WAY_M: f64 = 0.3;
/// Longest interval between scans over which the motion within a scan is interpolated \[s\].
const RECENT_S: f64 = 1.0;

/// State of one particle.
#[derive(Clone)]
struct Particle {
    map_from_base: Pose2,
    cells: Cells,
    tip: Tip,
    /// Logarithm of the weight since the last resampling, and over the whole trajectory.
    log: f64,
    log_of_way: f64,
    /// True if its last scan matched.
    is_matched: bool,
    /// Slowly varying errors of the front end that it assumes, in standard deviations.
    lasting: [f64; 3],
}

/// Pose of the robot at a scan relative to the last one used.
struct Step {
    time_ns: i64,
    update: u32,
    update_from_base: Pose2,
}

/// A map made by particles.
pub struct Gmapping {
    settings: GmappingSettings,
    front: Slam,
    particles: Vec<Particle>,
    ways: Ways,
    steps: Vec<Step>,
    /// Scans that were used; empty once memory for them is short.
    nodes: Vec<Node>,
    /// Bytes of them, about.
    nodes_size: usize,
    offered: Offered,
    /// Front end nodes of the last scan used, and of the one before.
    used: Option<TrajectoryNode>,
    last: Option<TrajectoryNode>,
    way_m: f64,
    update_from_base: Pose2,
    best: usize,
    counts: Counts,
    resamplings: usize,
    /// Remarks made so far, how many came from the front end, and remarks to be made.
    remarks: Vec<Remark>,
    told_of_front: usize,
    told_of_memory: Option<usize>,
    /// One for each thread, to be filled again.
    traces: Vec<Trace>,
}

impl Gmapping {
    /// An empty map.
    #[must_use]
    pub fn new(settings: GmappingSettings) -> Self {
        let front = Settings {
            slices_per_scan: settings.slices_per_scan,
            keeps_each_pose: false,
            drawn_beams: 1,
            range_min_m: settings.range_min_m,
            range_max_m: settings
                .range_max_m
                .unwrap_or(f32::INFINITY)
                .min(Settings::default().range_max_m),
            ..Settings::default()
        };
        // WebAssembly has no threads; results do not depend on their number.
        let max_threads = if cfg!(target_family = "wasm") { 1 } else { settings.particles.max(1) };
        let threads = settings.threads.clamp(1, max_threads);
        Self {
            front: Slam::new(front),
            particles: Vec::new(),
            ways: Ways::default(),
            steps: Vec::new(),
            nodes: Vec::new(),
            nodes_size: 0,
            offered: Offered::default(),
            used: None,
            last: None,
            way_m: 0.0,
            update_from_base: Pose2::IDENTITY,
            best: 0,
            counts: Counts::default(),
            resamplings: 0,
            remarks: Vec::new(),
            told_of_front: 0,
            told_of_memory: None,
            traces: std::iter::repeat_with(Trace::default).take(threads).collect(),
            settings,
        }
    }

    /// Takes a scan that the front end has placed; whether it was used.
    fn take(&mut self, scan: &LaserScan2, here: TrajectoryNode) -> bool {
        // The front end's map may have been revised: use its present poses.
        let front_from_base = self.front.pose_of(&here);
        let since = |node: &TrajectoryNode| {
            (self.front.pose_of(node).inverse() * front_from_base).normalized()
        };
        let motion = self.last.as_ref().and_then(|last| {
            let seconds = scan.time_ns.saturating_sub(last.time_ns) as f64 * 1e-9;
            let motion = since(last);
            let per = 1.0 / seconds;
            (seconds > 0.0 && seconds < RECENT_S)
                .then(|| Pose2::new(motion.x_m * per, motion.y_m * per, motion.yaw_rad * per))
        });
        let used = self.used.map(|used| (used.time_ns, since(&used)));
        self.last = Some(here);
        let Some((used_ns, moved)) = used else {
            let beams = Beams::new(scan, None, &self.settings);
            self.begin(&beams, front_from_base);
            self.keep(here, &beams);
            return true;
        };
        self.update_from_base = moved;
        let (metres, radians) = apart(moved, Pose2::IDENTITY);
        let seconds = scan.time_ns.saturating_sub(used_ns) as f64 * 1e-9;
        let is_due = metres >= self.settings.update_shift_m
            || radians >= self.settings.update_turn_rad
            || self.settings.update_time_s.is_some_and(|most| seconds >= most);
        if !is_due {
            return false;
        }
        let beams = Beams::new(scan, motion, &self.settings);
        if beams.points.len() < LEAST_POINTS {
            return false;
        }
        self.update_from_base = Pose2::IDENTITY;
        self.way_m += metres + TURN_WAY_M * radians;
        self.update(&beams, moved);
        self.keep(here, &beams);
        true
    }

    /// Keeps a scan that was used, to be drawn again.
    fn keep(&mut self, here: TrajectoryNode, beams: &Beams) {
        self.used = Some(here);
        if self.nodes.len() + 1 < self.counts.kept {
            return;
        }
        let node = Node::new(here, self.way_m, beams);
        self.nodes_size += node.size();
        self.nodes.push(node);
        if self.nodes_size + self.front.size() > MAX_FRONT_END_BYTES {
            self.nodes = Vec::new();
            self.nodes_size = 0;
        }
    }

    /// The first scan: all particles share its map.
    fn begin(&mut self, beams: &Beams, map_from_base: Pose2) {
        let mut cells = Cells::new(self.settings.resolution_m, SOLID_CELL_RATIO);
        let trace = &mut self.traces[0];
        trace.fill(beams, map_from_base, cells.per_m());
        cells.draw(trace);
        let tip = self.ways.begin(map_from_base);
        let first = Particle {
            map_from_base,
            cells,
            tip,
            log: 0.0,
            log_of_way: 0.0,
            is_matched: true,
            lasting: [0.0; 3],
        };
        for index in 0..self.settings.particles.max(1) {
            if index > 0 {
                self.ways.share(tip);
            }
            let seed = self.settings.seed;
            let mut stream = Stream::keyed(seed, "gmapping particle", index as u64);
            let lasting = [stream.normal(), stream.normal(), stream.normal()];
            self.particles.push(Particle { lasting, ..first.clone() });
        }
        self.counts.kept += 1;
    }

    /// Moves, weights and, if needed, resamples all particles.
    fn update(&mut self, beams: &Beams, moved: Pose2) {
        self.counts.kept += 1;
        self.drop_what_has_no_room(beams, moved);
        let (settings, number) = (&self.settings, self.counts.kept as u64);
        let (metres, radians) = apart(moved, Pose2::IDENTITY);
        let noise = settings.noise;
        let sigma_m = noise.place_by_way * metres + noise.place_by_turn * radians;
        let sigma_rad = noise.heading_by_way * metres + noise.heading_by_turn * radians;
        let front = self.used.as_ref().and_then(|used| self.front.covariance_since(used));
        let sigmas = (sigma_m.max(MIN_SIGMAS_M_RAD[0]), sigma_rad.max(MIN_SIGMAS_M_RAD[1]));
        let step = |index: usize, particle: &mut Particle, trace: &mut Trace| {
            // Particles are at most 10,000.
            let mut stream =
                Stream::keyed(settings.seed, "gmapping particle", number << 16 | index as u64);
            particle.go_on_lasting(metres, &mut stream);
            let guess = Guess {
                map_from_base: (particle.map_from_base * moved).normalized(),
                sigma_m: sigmas.0,
                sigma_rad: sigmas.1,
                front,
                began_rad: particle.map_from_base.yaw_rad,
                lasting: particle.lasting,
            };
            particle.go(&guess, beams, trace, settings, &mut stream);
        };
        let share = self.particles.len().div_ceil(self.traces.len());
        if let [trace] = self.traces.as_mut_slice() {
            for (index, particle) in self.particles.iter_mut().enumerate() {
                step(index, particle, trace);
            }
        } else {
            thread::scope(|scope| {
                let parts = self.particles.chunks_mut(share).zip(&mut self.traces);
                for (part, (particles, trace)) in parts.enumerate() {
                    let step = &step;
                    scope.spawn(move || {
                        for (index, particle) in particles.iter_mut().enumerate() {
                            step(part * share + index, particle, trace);
                        }
                    });
                }
            });
        }
        for particle in &mut self.particles {
            particle.tip = self.ways.go_on(particle.tip, particle.map_from_base);
        }
        self.best = self.foremost();
        self.counts.lost += usize::from(!self.particles[self.best].is_matched);
        self.resample(number);
        if number % SIZE_CHECK_INTERVAL_SCANS == 0 {
            self.save_memory();
        }
    }

    /// Each particle copies the tiles that a scan touches. If memory does not suffice for all, only the
    /// best remain.
    fn drop_what_has_no_room(&mut self, beams: &Beams, moved: Pose2) {
        let Some(best) = self.particles.get(self.best) else { return };
        let trace = &mut self.traces[0];
        trace.fill(beams, (best.map_from_base * moved).normalized(), best.cells.per_m());
        let copied = RESERVED_SCANS * trace.tiles() * cells::TILE_BYTES;
        let room = (MAX_MAPS_BYTES / copied.max(1)).max(1);
        if self.particles.len() > room {
            let mut order = self.order();
            order.truncate(room);
            self.go_on_from(&order, false);
            self.told_of_memory = Some(room);
        }
    }

    /// The particles, the foremost first.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.particles.len()).collect();
        order.sort_by(|&a, &b| {
            let log = |it: usize| self.particles[it].log;
            // The best of all first, whatever it explained of late.
            (b == self.best).cmp(&(a == self.best)).then(log(b).total_cmp(&log(a))).then(a.cmp(&b))
        });
        order
    }

    /// Replaces other particles by the best ones if the maps need too much memory.
    fn save_memory(&mut self) {
        let mut order = self.order();
        while order.len() > 1 && self.maps_size() > MAX_MAPS_BYTES {
            order.truncate(order.len().div_ceil(2));
            let chosen = (0..self.particles.len()).map(|it| order[it % order.len()]);
            self.go_on_from(&chosen.collect::<Vec<_>>(), false);
            order = (0..order.len()).collect();
            self.told_of_memory = Some(order.len());
        }
    }

    /// Bytes of all maps, about.
    fn maps_size(&self) -> usize {
        self.particles.iter().map(|it| it.cells.size() + size_of::<Particle>()).sum()
    }

    /// Makes new remarks.
    fn tell(&mut self, time_ns: i64) {
        let front = self.front.remarks();
        self.remarks.extend_from_slice(&front[self.told_of_front..]);
        self.told_of_front = front.len();
        if let Some(count) = self.told_of_memory.take() {
            let remark = Remark { time_ns, kind: RemarkKind::ParticlesReduced(count) };
            let is_old = |it: &Remark| matches!(it.kind, RemarkKind::ParticlesReduced(least) if least <= count);
            if !self.remarks.iter().any(is_old) {
                self.remarks.push(remark);
            }
        }
    }

    /// Index of the particle with the highest weight over its whole trajectory.
    fn foremost(&self) -> usize {
        (0..self.particles.len()).fold(0, |best, other| {
            let is_better = self.particles[other].log_of_way > self.particles[best].log_of_way;
            if is_better { other } else { best }
        })
    }

    /// Resamples if the effective sample size is too low.
    fn resample(&mut self, number: u64) {
        let count = self.particles.len() as f64;
        let logs: Vec<f64> = self.particles.iter().map(|it| it.log).collect();
        let weights = resample::weights(&logs, self.settings.gain * count);
        if resample::effective(&weights) >= self.settings.resample_share * count {
            return;
        }
        self.resamplings += 1;
        let mut stream = Stream::keyed(self.settings.seed, "gmapping resampling", number);
        let chosen = resample::resample(&weights, &mut stream);
        self.go_on_from(&chosen, true);
    }

    /// For each particle which one it goes on from.
    fn go_on_from(&mut self, chosen: &[usize], is_drawn: bool) {
        for &index in chosen {
            self.ways.share(self.particles[index].tip);
        }
        for particle in &self.particles {
            self.ways.end(particle.tip);
        }
        // The best one stays the best, if it is still there.
        self.best = chosen.iter().position(|&it| it == self.best).unwrap_or_else(|| {
            let log = |place: usize| self.particles[chosen[place]].log_of_way;
            (0..chosen.len()).fold(0, |best, it| if log(it) > log(best) { it } else { best })
        });
        let particle = |&index: &usize| {
            let particle = self.particles[index].clone();
            // Drawn by their weights, they are alike.
            Particle { log: if is_drawn { 0.0 } else { particle.log }, ..particle }
        };
        self.particles = chosen.iter().map(particle).collect();
    }
}

impl Gmapping {
    /// Keeps the pose of a scan, in the place of the previous one unless each pose is kept.
    fn push_step(&mut self, step: Step) {
        if let [.., before, last] = self.steps.as_mut_slice()
            && !self.settings.keeps_each_pose
            && before.update == last.update
            && last.update == step.update
        {
            *last = step;
            return;
        }
        self.steps.push(step);
    }
}

impl Particle {
    /// Advances the slowly varying errors of each particle.
    fn go_on_lasting(&mut self, metres: f64, stream: &mut Stream) {
        let kept = libm::exp(-metres / LASTING_M);
        let fresh = (1.0 - kept * kept).sqrt();
        self.lasting = self.lasting.map(|it| kept * it + fresh * stream.normal());
    }

    /// Goes where a scan has it, and draws it.
    fn go(
        &mut self,
        guess: &Guess,
        beams: &Beams,
        trace: &mut Trace,
        settings: &GmappingSettings,
        stream: &mut Stream,
    ) {
        let fit = climb(&self.cells, &beams.points, guess, settings);
        self.is_matched =
            fit.matched() > MIN_MATCHED_RATIO && fit.score(settings) > settings.least_score;
        let drawn = if self.is_matched {
            proposal::around(&fit, guess, settings, stream)
        } else {
            proposal::blind(&fit, guess, settings, stream)
        };
        self.map_from_base = drawn.map_from_base;
        self.log += drawn.likelihood;
        self.log_of_way += drawn.likelihood;
        trace.fill(beams, self.map_from_base, self.cells.per_m());
        self.cells.draw(trace);
    }
}

impl Mapper for Gmapping {
    fn method(&self) -> Method {
        Method::Gmapping
    }

    fn add_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> Update {
        self.counts.scans += 1;
        let before = self.particles.get(self.best).map(|it| it.map_from_base);
        let told = self.front.add_scan(scan, odom_from_base);
        let mut outcome = told.outcome;
        let mut is_map_revised = false;
        if let ScanOutcome::Rejected(_) = outcome {
            self.counts.ignored += 1;
        } else {
            let (best, offers) = (self.best, self.offered.accepted_count);
            if let Some(here) = self.front.newest() {
                outcome = match (self.take(scan, here), outcome) {
                    (true, _) => ScanOutcome::Inserted,
                    (false, ScanOutcome::Inserted) => ScanOutcome::BelowMotionThreshold,
                    (false, other) => other,
                };
            }
            self.offer(false);
            is_map_revised =
                before.is_some() && (best != self.best || offers != self.offered.accepted_count);
            self.push_step(Step {
                time_ns: scan.time_ns,
                update: self.counts.kept.saturating_sub(1) as u32,
                update_from_base: self.update_from_base,
            });
        }
        if self.nodes.len() < self.counts.kept {
            self.front.forget(FRONT_END_SCANS);
        }
        self.tell(scan.time_ns);
        let map_from_base = self.map_from_base();
        let odom_from_base = odom_from_base.filter(|pose| pose.is_finite());
        Update {
            outcome,
            map_from_base,
            map_from_odom: odom_from_base
                .map_or(Pose2::IDENTITY, |odom| (map_from_base * odom.inverse()).normalized()),
            is_map_revised,
        }
    }

    fn finish(&mut self) {
        if !self.nodes.is_empty() {
            self.front.finish();
            self.offer(true);
            self.fall_back();
        }
        self.tell(self.steps.last().map_or(0, |it| it.time_ns));
    }

    fn map_from_base(&self) -> Pose2 {
        self.particles.get(self.best).map_or(Pose2::IDENTITY, |best| {
            (best.map_from_base * self.update_from_base).normalized()
        })
    }

    fn trajectory(&self) -> Vec<(i64, Pose2)> {
        let Some(best) = self.particles.get(self.best) else { return Vec::new() };
        let way = self.ways.to(best.tip);
        let place = |step: &Step| {
            (step.time_ns, (way[step.update as usize] * step.update_from_base).normalized())
        };
        self.steps.iter().map(place).collect()
    }

    fn plan(&self) -> Option<Box<dyn Plan + '_>> {
        let settings = &self.settings;
        let cells = match self.particles.get(self.best) {
            Some(best) => best.cells.clone(),
            None => Cells::new(settings.resolution_m, SOLID_CELL_RATIO),
        };
        Some(Box::new(cells.plan(settings.occupied_share, settings.bounds_m)?))
    }

    fn counts(&self) -> Counts {
        self.counts
    }

    fn resamplings(&self) -> usize {
        self.resamplings
    }

    fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    fn current_remarks(&self) -> Vec<Remark> {
        self.front.current_remarks()
    }

    fn size(&self) -> usize {
        self.maps_size()
            + self.ways.size()
            + self.nodes_size
            + self.steps.len() * size_of::<Step>()
            + self.front.size()
    }
}
