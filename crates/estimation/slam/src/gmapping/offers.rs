//! Trajectories that the graph front end offers to particles, with the maps drawn from them.
//!
//! Sampling forward in time covers a long trajectory only with very many particles: after a loop of 300 m
//! none of thirty is at the right pose. The front end is a graph that closes loops, and each revision of
//! its map proposes a whole trajectory. The proposal is weighted like any other, by how well scans match
//! what was seen in the same area much earlier, against the best of the particles, and replaces some of
//! those that explain less. A wrong closure of the graph is outlived by the particles that did not adopt
//! it.

use periplus_geometry::Pose2;

use super::cells::{Cells, Seen};
use super::nodes::Node;
use super::trace::Trace;
use super::{Gmapping, GmappingSettings, Particle, SOLID_CELL_RATIO};
use crate::local::apart;

/// Minimum path to the older scans that a scan is compared with \[m\]: consecutive scans agree anyway.
const OLD_M: f64 = 10.0;
/// A trajectory is offered if some pose, relative to the newest, differs by more than this \[m\] ...
const ELSEWHERE_M: f64 = 0.08;
/// ... and this path after the previous offer \[m\], or this path if a loop was closed.
const EVERY_M: f64 = 20.0;
const LEAST_M: f64 = 2.0;
/// Every Nth particle keeps its own trajectory.
const OWN_TRAJECTORY_INTERVAL_PARTICLES: usize = 2;
/// Maximum number of beam ends compared with the map.
const MAX_COMPARED_BEAMS: usize = 120;
/// Logarithms of the likelihood of an end where nothing was seen, and where the map was seen through.
const UNKNOWN: f64 = -0.5;
const OPEN_END_NATS: f64 = -1.0;
/// The same for each solid cell that the scan sees through.
const SEEN_THROUGH_NATS: f64 = -0.3;

/// A map drawn along a trajectory, and the likelihood of what was seen twice.
pub(super) struct Drawn {
    pub(super) cells: Cells,
    log: f64,
}

/// Draws scans along a trajectory; each is compared with what older scans drew.
pub(super) fn draw(
    nodes: &[Node],
    way: &[Pose2],
    settings: &GmappingSettings,
    trace: &mut Trace,
) -> Drawn {
    let mut cells = Cells::new(settings.resolution_m, SOLID_CELL_RATIO);
    let mut log = 0.0;
    let mut old = 0;
    for (node, &pose) in nodes.iter().zip(way) {
        while nodes[old].way_m + OLD_M < node.way_m {
            trace.fill(&nodes[old].beams(), way[old], cells.per_m());
            cells.draw(trace);
            old += 1;
        }
        trace.fill(&node.beams(), pose, cells.per_m());
        log += judge(&cells, trace, settings);
    }
    for (node, &pose) in nodes.iter().zip(way).skip(old) {
        trace.fill(&node.beams(), pose, cells.per_m());
        cells.draw(trace);
    }
    Drawn { cells, log }
}

/// Logarithm of how likely a scan is on a map.
fn judge(cells: &Cells, trace: &Trace, settings: &GmappingSettings) -> f64 {
    let ends = trace.ends();
    let every = ends.len().div_ceil(MAX_COMPARED_BEAMS).max(1);
    let per_squared = settings.resolution_m * settings.resolution_m / settings.likelihood_sigma_m2;
    let kernel = settings.kernel_cells as i32;
    let one = |&[x, y]: &[f64; 2]| match cells.seen(x, y, kernel) {
        Seen::Near(squared) => (-squared * per_squared).max(UNKNOWN),
        Seen::Nothing => UNKNOWN,
        Seen::Through => OPEN_END_NATS,
    };
    let sum: f64 = ends.iter().step_by(every).map(one).sum();
    let passed = cells.passed(trace) as f64;
    sum * every as f64 + SEEN_THROUGH_NATS * passed
}

impl Gmapping {
    /// Offers the front end's trajectory if its map has been revised since the last offer.
    pub(super) fn offer(&mut self, is_last: bool) {
        let (Some(newest), Some(best)) = (self.nodes.last(), self.particles.get(self.best)) else {
            return;
        };
        let map_revision = self.front.map_revision();
        if map_revision == self.offered.map_revision {
            return;
        }
        let closures = self.front.closures().iter().filter(|it| it.is_accepted).count();
        let every_m = if closures == self.offered.closures { EVERY_M } else { LEAST_M };
        if !is_last && newest.way_m < self.offered.way_m + every_m {
            return;
        }
        self.offered.map_revision = map_revision;
        let way: Vec<Pose2> = self.nodes.iter().map(|it| self.front.pose_of(&it.node)).collect();
        let own = self.ways.to(best.tip);
        if !is_elsewhere(&way, &own) {
            return;
        }
        self.offered.way_m = newest.way_m;
        self.offered.closures = closures;
        let trace = &mut self.traces[0];
        let asked = draw(&self.nodes, &own, &self.settings, trace).log;
        let offer = draw(&self.nodes, &way, &self.settings, trace);
        let better = offer.log - asked;

        let (log, log_of_way) = (best.log + better, best.log_of_way + better);
        let chosen: Vec<usize> = (0..self.particles.len())
            .filter(|&it| self.particles[it].log_of_way < log_of_way)
            .filter(|&it| {
                it % OWN_TRAJECTORY_INTERVAL_PARTICLES
                    != self.offered.count % OWN_TRAJECTORY_INTERVAL_PARTICLES
                    || self.particles.len() == 1
            })
            .collect();
        self.offered.count += 1;
        if chosen.is_empty() {
            return;
        }
        self.offered.accepted_count += 1;
        let tip = self.ways.along(&way);
        for (number, &index) in chosen.iter().enumerate() {
            if number > 0 {
                self.ways.share(tip);
            }
            self.ways.end(self.particles[index].tip);
            self.particles[index] = Particle {
                map_from_base: way[way.len() - 1],
                cells: offer.cells.clone(),
                tip,
                log,
                log_of_way,
                is_matched: true,
                lasting: self.particles[index].lasting,
            };
        }
        self.best = self.foremost();
        self.resample(self.counts.kept as u64);
    }
}

/// True if two trajectories differ relative to their ends.
fn is_elsewhere(way: &[Pose2], own: &[Pose2]) -> bool {
    let (Some(end), Some(own_end)) = (way.last(), own.last()) else { return false };
    let (from_end, from_own_end) = (end.inverse(), own_end.inverse());
    way.iter()
        .zip(own)
        .any(|(pose, own)| apart(from_end * *pose, from_own_end * *own).0 > ELSEWHERE_M)
}

/// State at the last offer.
#[derive(Default)]
pub(super) struct Offered {
    map_revision: usize,
    way_m: f64,
    closures: usize,
    count: usize,
    /// Offers that some particle took.
    pub(super) accepted_count: usize,
}
