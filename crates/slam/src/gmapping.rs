//! Particles that each have a map of their own: a Rao-Blackwellized particle filter.
//!
//! Written from the equations of Grisetti, Stachniss, Burgard 2007, "Improved Techniques for Grid
//! Mapping With Rao-Blackwellized Particle Filters"; numbers in comments are theirs. The way of a scan:
//! 1. how the robot has moved since the last one is found by laying scans onto those just before
//!    (Haehnel et al. 2003 do the same before they draw particles);
//! 2. after enough motion each particle moves along, lays the scan onto its own map (`fit`), and goes
//!    to a place drawn from what is likely around there (`proposal`);
//! 3. it draws the scan into its map, of which it shares with others what is the same (`cells`);
//! 4. when few particles explain most of what was seen, these are multiplied (`resample`).
//!
//! The map is that of the particle that has explained the most on its whole way (`ways`).

mod beams;
mod cells;
mod fit;
mod proposal;
mod resample;
mod settings;
mod spread;
mod trace;
mod ways;

use std::thread;

use periplus_base::{Pose2, Stream};
use periplus_grid::OccupancyGrid;

use crate::doubts::Remark;
use crate::engine::{Counts, Slam, Taken, Update};
use crate::local::apart;
use crate::method::{Mapper, Method};
use crate::scan::Scan;
use crate::settings::Settings;

use beams::Beams;
use cells::Cells;
use fit::{Guess, climb};
use trace::Trace;
use ways::{Tip, Ways};

pub use settings::{GmappingSettings, Noise};

/// Scans are laid onto cells in which at least this part of the beams ended.
const SOLID_SHARE: f64 = 0.1;
/// Scans of fewer points cannot be laid onto a map.
const LEAST_POINTS: usize = 12;
/// Part of the points that the map must have something near for a scan to fit.
const LEAST_MATCHED: f64 = 0.3;
/// How far odometry is off at least \[m, rad\].
const LEAST_SIGMA: [f64; 2] = [0.01, 0.005];
/// Kept scans that the front end remembers; it lays new ones onto no more.
const REMEMBERED: usize = 30;
/// Scans farther apart in time tell nothing of how beams of one scan are shifted \[s\].
const RECENT_S: f64 = 1.0;

/// What one particle believes.
#[derive(Clone)]
struct Particle {
    map_from_base: Pose2,
    cells: Cells,
    tip: Tip,
    /// Logarithm of its weight since particles were drawn anew, and of its whole way.
    log: f64,
    log_of_way: f64,
    /// Whether its last scan fit.
    is_matched: bool,
}

/// Where the robot was at a scan, from where it was at the last one that was used.
struct Track {
    time_ns: i64,
    update: u32,
    update_from_base: Pose2,
}

/// The scan that was used last.
struct Used {
    time_ns: i64,
    /// In the frame of the front end.
    front_from_base: Pose2,
}

/// A map made by particles.
pub struct Gmapping {
    settings: GmappingSettings,
    front: Slam,
    particles: Vec<Particle>,
    ways: Ways,
    tracks: Vec<Track>,
    used: Option<Used>,
    /// Time and place of the scan before, in the frame of the front end.
    last: Option<(i64, Pose2)>,
    update_from_base: Pose2,
    best: usize,
    counts: Counts,
    resamplings: usize,
    /// One for each thread, to be filled again.
    traces: Vec<Trace>,
}

impl Gmapping {
    /// An empty map.
    #[must_use]
    pub fn new(settings: GmappingSettings) -> Self {
        let front = Settings {
            closes_loops: false,
            slices_per_scan: 0,
            drawn_beams: 1,
            range_min_m: settings.range_min_m,
            range_max_m: settings
                .range_max_m
                .unwrap_or(f32::INFINITY)
                .min(Settings::default().range_max_m),
            ..Settings::default()
        };
        let threads = settings.threads.clamp(1, settings.particles.max(1));
        Self {
            front: Slam::new(front),
            particles: Vec::new(),
            ways: Ways::default(),
            tracks: Vec::new(),
            used: None,
            last: None,
            update_from_base: Pose2::IDENTITY,
            best: 0,
            counts: Counts::default(),
            resamplings: 0,
            traces: std::iter::repeat_with(Trace::default).take(threads).collect(),
            settings,
        }
    }

    /// Takes a scan that the front end has placed; whether it was used.
    fn take(&mut self, scan: &Scan, front_from_base: Pose2) -> bool {
        let motion = self.last.and_then(|(time_ns, before)| {
            let seconds = scan.time_ns.saturating_sub(time_ns) as f64 * 1e-9;
            let motion = (before.inverse() * front_from_base).normalized();
            let per = 1.0 / seconds;
            (seconds > 0.0 && seconds < RECENT_S)
                .then(|| Pose2::new(motion.x_m * per, motion.y_m * per, motion.yaw_rad * per))
        });
        self.last = Some((scan.time_ns, front_from_base));
        let Some(used) = &self.used else {
            self.begin(&Beams::new(scan, None, &self.settings), front_from_base);
            self.used = Some(Used { time_ns: scan.time_ns, front_from_base });
            return true;
        };
        let moved = (used.front_from_base.inverse() * front_from_base).normalized();
        self.update_from_base = moved;
        let (metres, radians) = apart(moved, Pose2::IDENTITY);
        let seconds = scan.time_ns.saturating_sub(used.time_ns) as f64 * 1e-9;
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
        self.used = Some(Used { time_ns: scan.time_ns, front_from_base });
        self.update_from_base = Pose2::IDENTITY;
        self.update(&beams, moved);
        true
    }

    /// The first scan: all particles share its map.
    fn begin(&mut self, beams: &Beams, map_from_base: Pose2) {
        let mut cells = Cells::new(self.settings.resolution_m, SOLID_SHARE);
        let trace = &mut self.traces[0];
        trace.fill(beams, map_from_base, cells.per_m());
        cells.draw(trace);
        let tip = self.ways.begin(map_from_base);
        let first =
            Particle { map_from_base, cells, tip, log: 0.0, log_of_way: 0.0, is_matched: true };
        for _ in 1..self.settings.particles {
            self.ways.share(tip);
            self.particles.push(first.clone());
        }
        self.particles.push(first);
        self.counts.kept += 1;
    }

    /// Moves all particles, weighs them, and draws them anew when it is time.
    fn update(&mut self, beams: &Beams, moved: Pose2) {
        self.counts.kept += 1;
        let (settings, number) = (&self.settings, self.counts.kept as u64);
        let (metres, radians) = apart(moved, Pose2::IDENTITY);
        let noise = settings.noise;
        let sigma_m = noise.place_by_way * metres + noise.place_by_turn * radians;
        let sigma_rad = noise.heading_by_way * metres + noise.heading_by_turn * radians;
        let sigmas = (sigma_m.max(LEAST_SIGMA[0]), sigma_rad.max(LEAST_SIGMA[1]));
        let step = |index: usize, particle: &mut Particle, trace: &mut Trace| {
            // Particles are at most 10,000.
            let mut stream =
                Stream::keyed(settings.seed, "gmapping particle", number << 16 | index as u64);
            let guess = Guess {
                map_from_base: (particle.map_from_base * moved).normalized(),
                sigma_m: sigmas.0,
                sigma_rad: sigmas.1,
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
        self.best = (0..self.particles.len()).fold(0, |best, other| {
            let is_better = self.particles[other].log_of_way > self.particles[best].log_of_way;
            if is_better { other } else { best }
        });
        self.counts.lost += usize::from(!self.particles[self.best].is_matched);
        self.resample(number);
    }

    /// Draws particles anew when too few of them count.
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
        for &index in &chosen {
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
        self.particles = chosen
            .iter()
            .map(|&index| Particle { log: 0.0, ..self.particles[index].clone() })
            .collect();
    }
}

impl Gmapping {
    /// Keeps the pose of a scan, in the place of the previous one unless each pose is kept.
    fn push_track(&mut self, track: Track) {
        if let [.., before, last] = self.tracks.as_mut_slice()
            && !self.settings.keeps_each_pose
            && before.update == last.update
            && last.update == track.update
        {
            *last = track;
            return;
        }
        self.tracks.push(track);
    }
}

impl Particle {
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
            fit.matched() > LEAST_MATCHED && fit.score(settings) > settings.least_score;
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

    fn add_scan(&mut self, scan: &Scan, odom_from_base: Option<Pose2>) -> Update {
        self.counts.scans += 1;
        let before = self.particles.get(self.best).map(|it| it.map_from_base);
        let told = self.front.add_scan(scan, odom_from_base);
        let mut taken = told.taken;
        let mut is_map_bent = false;
        if let Taken::Ignored(_) = taken {
            self.counts.ignored += 1;
        } else {
            let best = self.best;
            taken = match (self.take(scan, told.map_from_base), taken) {
                (true, _) => Taken::Kept,
                (false, Taken::Kept) => Taken::Passed,
                (false, other) => other,
            };
            is_map_bent = before.is_some() && best != self.best;
            self.push_track(Track {
                time_ns: scan.time_ns,
                update: (self.counts.kept - 1) as u32,
                update_from_base: self.update_from_base,
            });
        }
        self.front.forget(REMEMBERED);
        let map_from_base = self.map_from_base();
        let odom_from_base = odom_from_base.filter(|pose| pose.is_finite());
        Update {
            taken,
            map_from_base,
            map_from_odom: odom_from_base
                .map_or(Pose2::IDENTITY, |odom| (map_from_base * odom.inverse()).normalized()),
            is_map_bent,
        }
    }

    /// Nothing was left for later.
    fn finish(&mut self) {}

    fn map_from_base(&self) -> Pose2 {
        self.particles.get(self.best).map_or(Pose2::IDENTITY, |best| {
            (best.map_from_base * self.update_from_base).normalized()
        })
    }

    fn trajectory(&self) -> Vec<(i64, Pose2)> {
        let Some(best) = self.particles.get(self.best) else { return Vec::new() };
        let way = self.ways.to(best.tip);
        let place = |track: &Track| {
            (track.time_ns, (way[track.update as usize] * track.update_from_base).normalized())
        };
        self.tracks.iter().map(place).collect()
    }

    fn map(&self) -> Option<OccupancyGrid> {
        let settings = &self.settings;
        match self.particles.get(self.best) {
            Some(best) => best.cells.to_grid(settings.occupied_share, settings.bounds_m),
            None => Cells::new(settings.resolution_m, SOLID_SHARE)
                .to_grid(settings.occupied_share, settings.bounds_m),
        }
    }

    fn counts(&self) -> Counts {
        self.counts
    }

    fn resamplings(&self) -> usize {
        self.resamplings
    }

    fn remarks(&self) -> &[Remark] {
        self.front.remarks()
    }

    fn size(&self) -> usize {
        let maps: usize =
            self.particles.iter().map(|it| it.cells.size() + size_of::<Particle>()).sum();
        maps + self.ways.size() + self.tracks.len() * size_of::<Track>() + self.front.size()
    }
}
