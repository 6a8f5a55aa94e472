//! The search for a scan on all of a map, which can be done in parts.
//!
//! Branch and bound, the most promising first (Hess et al. 2016, "Real-time loop closure in 2D LIDAR
//! SLAM"). Where nothing is free the robot cannot be.

use std::f64::consts::PI;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Peak;

use crate::pyramid::{FULL, Pyramid, Reach, Square, TOP, Turned};

/// To keep the order of nodes costs as much as so many lookups.
const POPPED: u64 = 10;
/// So many headings can be told apart, and so many points do not exceed the largest sum.
const MOST_HEADINGS: usize = 2048;
const MOST_POINTS: usize = 256;
/// So many points that follow each other in a search come from all sides.
const SIDES: usize = 12;

/// Which places are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// No more than so many.
    pub(crate) most: usize,
    /// Of places nearer to each other than this the better one counts: \[m\], \[rad\].
    pub(crate) apart: (f64, f64),
}

/// Where it is looked.
#[derive(Clone, Copy, Debug)]
enum Region {
    /// Where the robot can be.
    Free,
    /// In a box of cells, whether or not anything is known to be free there.
    Box { low: [u16; 2], high: [u16; 2] },
}

/// A search that is under way.
#[derive(Clone, Debug)]
pub(crate) struct Hunt {
    /// For each heading, the points in cells, relative to the robot.
    offsets: Vec<[i32; 2]>,
    /// For each heading, the box around them.
    reaches: Vec<Reach>,
    /// How many points.
    count: usize,
    region: Region,
    /// The first of headings, how many are wanted, and how many were begun.
    first: usize,
    wanted: usize,
    begun: usize,
    share: f64,
    threshold: u32,
    nodes: Queue,
    sums: Vec<u16>,
    /// Lookups so far.
    work: u64,
    best: u32,
    /// The best first.
    peaks: Vec<Peak>,
    is_done: bool,
    completeness: Completeness,
}

/// How much of what was wanted a search has found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Completeness {
    /// Some of it.
    Part,
    /// All that fits nearly as well as the best.
    Best,
    /// All.
    Whole,
}

impl Hunt {
    /// Begins to look for where points fit, in the frame of the base \[m\]. Of places that fit less than
    /// `least` (0 to 1) nothing is wanted, nor of those below `share` of the best.
    ///
    /// Near a pose, not farther along each axis and in heading, the robot may also be where nothing is
    /// known to be free: \[m\], \[rad\].
    pub(crate) fn new(
        pyramid: &Pyramid,
        points: &[[f32; 2]],
        step_rad: f64,
        (least, share): (f64, f64),
        near: Option<(Pose2, f64, f64)>,
    ) -> Self {
        let headings = (libm::ceil(2.0 * PI / step_rad) as usize).clamp(1, MOST_HEADINGS);
        // In an order in which the first ones come from all sides, so that a few tell enough.
        let points = &points[..points.len().min(MOST_POINTS)];
        let stride = (points.len() / SIDES).max(1);
        let ordered: Vec<[f32; 2]> = (0..stride)
            .flat_map(|first| points.iter().skip(first).step_by(stride))
            .copied()
            .collect();
        let count = ordered.len();
        let (region, first, wanted) = near.map_or((Region::Free, 0, headings), |near| {
            let (pose, half_m, half_rad) = near;
            let (low, high) = (pose.x_m - half_m, pose.x_m + half_m);
            let low = pyramid.cell_near((low, pose.y_m - half_m));
            let high = pyramid.cell_near((high, pose.y_m + half_m));
            let each_rad = 2.0 * PI / headings as f64;
            let first = libm::floor((pose.yaw_rad - half_rad) / each_rad);
            let last = libm::ceil((pose.yaw_rad + half_rad) / each_rad);
            let wanted = ((last - first) as usize + 1).min(headings);
            let first = first.rem_euclid(headings as f64) as usize % headings;
            (Region::Box { low, high }, first, wanted)
        });
        let mut offsets = vec![[0; 2]; headings * count];
        let mut reaches = vec![Reach::of(&[]); headings];
        let scale = (1.0 / pyramid.cell_m) as f32;
        for number in 0..wanted {
            let heading = (first + number) % headings;
            let (sine, cosine) = libm::sincos(2.0 * PI * heading as f64 / headings as f64);
            let (sine, cosine) = (sine as f32 * scale, cosine as f32 * scale);
            let cell = |value: f32| libm::floorf(value + 0.5) as i32;
            let offsets = &mut offsets[heading * count..(heading + 1) * count];
            for (offset, p) in offsets.iter_mut().zip(&ordered) {
                *offset = [cell(cosine * p[0] - sine * p[1]), cell(sine * p[0] + cosine * p[1])];
            }
            reaches[heading] = Reach::of(offsets);
        }
        Self {
            offsets,
            reaches,
            count,
            region,
            first,
            wanted,
            begun: 0,
            share,
            threshold: (least.clamp(0.0, 1.0) * f64::from(FULL) * count as f64) as u32,
            nodes: Queue::new(FULL as usize * count),
            sums: Vec::new(),
            work: 0,
            best: 0,
            peaks: Vec::new(),
            is_done: count == 0,
            completeness: Completeness::Whole,
        }
    }

    /// Goes on for about so many lookups.
    pub(crate) fn go_on(&mut self, pyramid: &Pyramid, most: u64, wanted: &Wanted) {
        let end = self.work.saturating_add(most);
        while self.work < end && self.begun < self.wanted {
            self.begin(pyramid, (self.first + self.begun) % self.reaches.len());
            self.begun += 1;
        }
        if self.begun < self.wanted {
            return;
        }
        while self.work < end {
            let Some(node) = self.nodes.pop() else {
                self.is_done = true;
                return;
            };
            self.work += POPPED;
            if node.bound <= self.threshold {
                self.nodes.clear();
            } else if node.square.level == 0 {
                self.take(pyramid, node, wanted);
            } else if node.square.level > 2 || !self.is_shadowed(pyramid, node, wanted) {
                self.split(pyramid, node);
            }
        }
    }

    /// Points at a heading.
    fn turned(&self, heading: usize) -> Turned<'_> {
        let offsets = &self.offsets[heading * self.count..(heading + 1) * self.count];
        Turned { offsets, reach: self.reaches[heading] }
    }

    /// Begins with the largest squares at a heading.
    fn begin(&mut self, pyramid: &Pyramid, heading: usize) {
        let number = heading as u16;
        match self.region {
            Region::Free => {
                let mut sums = std::mem::take(&mut self.sums);
                let mut nodes = std::mem::take(&mut self.nodes);
                let points = self.turned(heading);
                let work = pyramid.sweep(&points, self.threshold, &mut sums, |square, bound| {
                    nodes.push(Node { bound, heading: number, square });
                });
                (self.sums, self.nodes) = (sums, nodes);
                self.work += work;
            }
            Region::Box { low, high } => {
                let bound = FULL * self.count as u32;
                for y in (low[1]..=high[1]).step_by(1 << TOP) {
                    for x in (low[0]..=high[0]).step_by(1 << TOP) {
                        let square = Square { x, y, level: TOP as u8 };
                        self.nodes.push(Node { bound, heading: number, square });
                    }
                }
            }
        }
    }

    /// Keeps the quarters of a square in which anything may be worth a look.
    fn split(&mut self, pyramid: &Pyramid, node: Node) {
        let quarters = node.square.quarters();
        let is_possible = quarters.map(|it| match self.region {
            Region::Free => pyramid.is_free(it),
            Region::Box { high, .. } => it.x <= high[0] && it.y <= high[1],
        });
        let points = self.turned(node.heading.into());
        let (bounds, work) = pyramid.bounds(quarters[0], &points, self.threshold);
        self.work += work;
        for ((square, bound), is_possible) in quarters.into_iter().zip(bounds).zip(is_possible) {
            if is_possible && bound > self.threshold {
                self.nodes.push(Node { bound, square, ..node });
            }
        }
    }

    fn pose(&self, pyramid: &Pyramid, node: Node) -> Pose2 {
        let yaw_rad = 2.0 * PI * f64::from(node.heading) / self.reaches.len() as f64;
        pyramid.pose(node.square, yaw_rad)
    }

    /// Whether all of a square is near a better place.
    fn is_shadowed(&self, pyramid: &Pyramid, node: Node, wanted: &Wanted) -> bool {
        let low = self.pose(pyramid, node);
        let more_m = f64::from((1_u16 << node.square.level) - 1) * pyramid.cell_m;
        let (near_m, near_rad) = wanted.apart;
        self.peaks.iter().any(|peak| {
            let (dx, dy) = (low.x_m - peak.pose.x_m, low.y_m - peak.pose.y_m);
            dx > -near_m
                && dy > -near_m
                && dx + more_m < near_m
                && dy + more_m < near_m
                && normalize_angle(low.yaw_rad - peak.pose.yaw_rad).abs() < near_rad
        })
    }

    /// Takes a place; better ones came before.
    fn take(&mut self, pyramid: &Pyramid, node: Node, wanted: &Wanted) {
        if self.is_shadowed(pyramid, node, wanted) {
            return;
        }
        let score = f64::from(node.bound) / (f64::from(FULL) * self.count as f64);
        self.peaks.push(Peak { pose: self.pose(pyramid, node), score });
        self.best = self.best.max(node.bound);
        let least = (f64::from(self.best) * self.share) as u32;
        self.threshold = self.threshold.max(least);
        if self.peaks.len() >= wanted.most {
            self.nodes.clear();
            self.completeness = Completeness::Part;
        }
    }

    pub(crate) fn is_done(&self) -> bool {
        self.is_done
    }

    /// Lookups so far.
    pub(crate) fn work(&self) -> u64 {
        self.work
    }

    /// From now on only what reaches such a share of the best, and fits as well as `least`.
    pub(crate) fn narrow(&mut self, share: f64, least: f64) {
        self.share = self.share.max(share);
        let least = (least * f64::from(FULL) * self.count as f64) as u32;
        let share = (f64::from(self.best) * self.share) as u32;
        self.threshold = self.threshold.max(share).max(least);
        self.completeness = self.completeness.min(Completeness::Best);
    }

    /// What has not been found yet is given up.
    pub(crate) fn give_up(&mut self) {
        if !self.is_done {
            self.nodes.clear();
            self.is_done = true;
            self.completeness = Completeness::Part;
        }
    }

    /// What was found, the best first, and how much of all that is.
    pub(crate) fn into_peaks(self) -> (Vec<Peak>, Completeness) {
        (self.peaks, self.completeness)
    }
}

/// A square of positions at one heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Node {
    /// Most that any of them reaches; [`FULL`] for each point.
    bound: u32,
    heading: u16,
    square: Square,
}

/// Nodes, the largest bound first. No node is worth more than one that was taken before, so that a list
/// for each bound suffices.
#[derive(Clone, Debug, Default)]
struct Queue {
    /// Of each bound the node that came last, or [`NONE`].
    lists: Vec<u32>,
    /// Each with the one before of the same bound, or of those that are free.
    nodes: Vec<(Node, u32)>,
    free: u32,
    /// No list above this has any.
    top: usize,
}

const NONE: u32 = u32::MAX;

impl Queue {
    /// For bounds up to this.
    fn new(most: usize) -> Self {
        Self { lists: vec![NONE; most + 1], nodes: Vec::new(), free: NONE, top: 0 }
    }

    fn push(&mut self, node: Node) {
        let bound = node.bound as usize;
        let entry = (node, self.lists[bound]);
        let index = if self.free == NONE {
            self.nodes.push(entry);
            self.nodes.len() - 1
        } else {
            let index = self.free as usize;
            self.free = self.nodes[index].1;
            self.nodes[index] = entry;
            index
        };
        self.lists[bound] = index as u32;
        self.top = self.top.max(bound);
    }

    fn pop(&mut self) -> Option<Node> {
        while *self.lists.get(self.top)? == NONE {
            self.top = self.top.checked_sub(1)?;
        }
        let index = self.lists[self.top];
        let (node, before) = self.nodes[index as usize];
        self.lists[self.top] = before;
        self.nodes[index as usize].1 = self.free;
        self.free = index;
        Some(node)
    }

    fn clear(&mut self) {
        self.lists.fill(NONE);
        self.nodes.clear();
        (self.free, self.top) = (NONE, 0);
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;

    use super::*;

    #[test]
    fn the_best_of_all_places_is_found_in_parts() {
        for seed in 0..6 {
            let mut stream = Stream::keyed(seed, "hunt", 0);
            let (wide_m, high_m) = (7.0, 4.6);
            let walls: Vec<(f64, f64)> =
                (0..400).map(|_| (wide_m * stream.unit(), high_m * stream.unit())).collect();
            let free: Vec<(f64, f64)> =
                (0..3000).map(|_| (wide_m * stream.unit(), high_m * stream.unit())).collect();
            let corners = [[0.0, 0.0], [wide_m, high_m]];
            let pyramid = Pyramid::new(walls.iter().copied(), free.iter().copied(), corners, 0.1);
            // Far enough that many are off the map.
            let point = |stream: &mut Stream| (6.0 * (stream.unit() - 0.5)) as f32;
            let points: Vec<[f32; 2]> =
                (0..30).map(|_| [point(&mut stream), point(&mut stream)]).collect();
            let mut hunt = Hunt::new(&pyramid, &points, 0.1, (0.0, 1.0), None);
            let wanted = Wanted { most: 1, apart: (0.01, 0.01) };
            let mut parts = 0;
            while !hunt.is_done() {
                hunt.go_on(&pyramid, 20_000, &wanted);
                parts += 1;
            }
            assert!(parts > 1);
            let best = hunt.best;
            let mut most = 0;
            for heading in 0..hunt.reaches.len() {
                let points = hunt.turned(heading);
                for cell in 0..100 * 80_u16 {
                    let square = Square { x: cell % 100, y: cell / 100, level: 0 };
                    let is_inside = pyramid.cell_near((wide_m, high_m));
                    if square.x <= is_inside[0] + 2
                        && square.y <= is_inside[1] + 2
                        && pyramid.is_free(square)
                    {
                        most = most.max(pyramid.bounds(square, &points, 0).0[0]);
                    }
                }
            }
            assert_eq!(best, most, "seed {seed}");
        }
    }
}
