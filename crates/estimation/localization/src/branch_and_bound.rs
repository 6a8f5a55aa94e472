//! Branch-and-bound scan matching over a whole map, in slices of bounded work.
//!
//! Best-first search (Hess et al. 2016, "Real-time loop closure in 2D LIDAR SLAM", algorithm 2),
//! restricted to the free space of the map.

use std::f64::consts::PI;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Peak;

use crate::likelihood_pyramid::{
    CellBox, LikelihoodPyramid, MAX_SCORE_PER_POINT, RotatedPoints, Square, TOP_LEVEL_INDEX,
};
use crate::pose_threshold::PoseThreshold;

/// Cost of a queue operation \[lookups\].
const QUEUE_LOOKUP_COUNT: u64 = 10;
/// Limits that keep headings and score sums in 16 bits.
const MAX_HEADING_COUNT: usize = 2048;
const MAX_POINTS: usize = 256;
/// Number of consecutive points in the search order that cover all bearings.
const BEARING_COUNT: usize = 12;

/// Number and separation of the candidates of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CandidateLimits {
    /// Maximum number of candidates.
    pub(crate) max_count: usize,
    /// Candidates closer than this to a better one are dropped.
    pub(crate) separation: PoseThreshold,
}

/// Search region.
#[derive(Clone, Copy, Debug)]
enum Region {
    /// Free space.
    Free,
    /// Box of cells, free or not.
    Box { low: [u16; 2], high: [u16; 2] },
}

/// State of a search.
#[derive(Clone, Debug)]
pub(crate) struct BranchAndBound {
    /// Per heading, the points relative to the base \[cells\].
    offsets: Vec<[i32; 2]>,
    /// Per heading, the bounding box of the points.
    bounding_boxes: Vec<CellBox>,
    /// Number of points.
    count: usize,
    region: Region,
    /// First heading, number of headings to search, number of headings started.
    first_heading: usize,
    heading_count: usize,
    started_count: usize,
    min_fraction: f64,
    threshold: u32,
    nodes: BucketQueue,
    sums: Vec<u16>,
    /// Number of lookups so far.
    lookup_count: u64,
    best: u32,
    /// Candidates, best first.
    peaks: Vec<Peak>,
    is_done: bool,
    completeness: Completeness,
}

/// Completeness of a search result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Completeness {
    /// The search was cut off.
    Partial,
    /// All candidates that score nearly as high as the best.
    NearBest,
    /// All candidates.
    Complete,
}

impl BranchAndBound {
    /// Starts a search for poses that fit points in the base frame \[m\]. Candidates need a score
    /// of at least `min_score` (0 to 1) and the fraction `min_fraction` of the best score.
    ///
    /// With a window, the search covers the poses around its center, free or not; otherwise the
    /// free space of the whole map.
    pub(crate) fn new(
        pyramid: &LikelihoodPyramid,
        points: &[[f32; 2]],
        step_rad: f64,
        (min_score, min_fraction): (f64, f64),
        window: Option<(Pose2, PoseThreshold)>,
    ) -> Self {
        let headings = (libm::ceil(2.0 * PI / step_rad) as usize).clamp(1, MAX_HEADING_COUNT);
        // Interleaved, so that the first points come from all bearings and bound the score early.
        let points = &points[..points.len().min(MAX_POINTS)];
        let stride = (points.len() / BEARING_COUNT).max(1);
        let ordered: Vec<[f32; 2]> = (0..stride)
            .flat_map(|first| points.iter().skip(first).step_by(stride))
            .copied()
            .collect();
        let count = ordered.len();
        let (region, first_heading, heading_count) =
            window.map_or((Region::Free, 0, headings), |(pose, half_window)| {
                let PoseThreshold { distance_m: half_m, angle_rad: half_rad } = half_window;
                let (low, high) = (pose.x_m - half_m, pose.x_m + half_m);
                let low = pyramid.cell_near((low, pose.y_m - half_m));
                let high = pyramid.cell_near((high, pose.y_m + half_m));
                let each_rad = 2.0 * PI / headings as f64;
                let first = libm::floor((pose.yaw_rad - half_rad) / each_rad);
                let last = libm::ceil((pose.yaw_rad + half_rad) / each_rad);
                let count = ((last - first) as usize + 1).min(headings);
                let first = first.rem_euclid(headings as f64) as usize % headings;
                (Region::Box { low, high }, first, count)
            });
        let mut offsets = vec![[0; 2]; headings * count];
        let mut bounding_boxes = vec![CellBox::around(&[]); headings];
        let scale = (1.0 / pyramid.cell_m) as f32;
        for number in 0..heading_count {
            let heading = (first_heading + number) % headings;
            let (sine, cosine) = libm::sincos(2.0 * PI * heading as f64 / headings as f64);
            let (sine, cosine) = (sine as f32 * scale, cosine as f32 * scale);
            let cell = |value: f32| libm::floorf(value + 0.5) as i32;
            let offsets = &mut offsets[heading * count..(heading + 1) * count];
            for (offset, p) in offsets.iter_mut().zip(&ordered) {
                *offset = [cell(cosine * p[0] - sine * p[1]), cell(sine * p[0] + cosine * p[1])];
            }
            bounding_boxes[heading] = CellBox::around(offsets);
        }
        Self {
            offsets,
            bounding_boxes,
            count,
            region,
            first_heading,
            heading_count,
            started_count: 0,
            min_fraction,
            threshold: (min_score.clamp(0.0, 1.0) * f64::from(MAX_SCORE_PER_POINT) * count as f64)
                as u32,
            nodes: BucketQueue::new(MAX_SCORE_PER_POINT as usize * count),
            sums: Vec::new(),
            lookup_count: 0,
            best: 0,
            peaks: Vec::new(),
            is_done: count == 0,
            completeness: Completeness::Complete,
        }
    }

    /// Continues the search by about `max_lookups` lookups.
    pub(crate) fn advance(
        &mut self,
        pyramid: &LikelihoodPyramid,
        max_lookups: u64,
        limits: &CandidateLimits,
    ) {
        let end = self.lookup_count.saturating_add(max_lookups);
        while self.lookup_count < end && self.started_count < self.heading_count {
            self.start_heading(
                pyramid,
                (self.first_heading + self.started_count) % self.bounding_boxes.len(),
            );
            self.started_count += 1;
        }
        if self.started_count < self.heading_count {
            return;
        }
        while self.lookup_count < end {
            let Some(node) = self.nodes.pop() else {
                self.is_done = true;
                return;
            };
            self.lookup_count += QUEUE_LOOKUP_COUNT;
            if node.bound <= self.threshold {
                self.nodes.clear();
            } else if node.square.level == 0 {
                self.accept(pyramid, node, limits);
            } else if node.square.level > 2 || !self.is_near_better(pyramid, node, limits) {
                self.split(pyramid, node);
            }
        }
    }

    /// Points rotated to a heading.
    fn rotated_points(&self, heading: usize) -> RotatedPoints<'_> {
        let offsets = &self.offsets[heading * self.count..(heading + 1) * self.count];
        RotatedPoints { offsets, bounding_box: self.bounding_boxes[heading] }
    }

    /// Queues the squares of the coarsest level at a heading.
    fn start_heading(&mut self, pyramid: &LikelihoodPyramid, heading: usize) {
        let number = heading as u16;
        match self.region {
            Region::Free => {
                let mut sums = std::mem::take(&mut self.sums);
                let mut nodes = std::mem::take(&mut self.nodes);
                let points = self.rotated_points(heading);
                let work =
                    pyramid.visit_bounds(&points, self.threshold, &mut sums, |square, bound| {
                        nodes.push(Node { bound, heading: number, square });
                    });
                (self.sums, self.nodes) = (sums, nodes);
                self.lookup_count += work;
            }
            Region::Box { low, high } => {
                let bound = MAX_SCORE_PER_POINT * self.count as u32;
                for y in (low[1]..=high[1]).step_by(1 << TOP_LEVEL_INDEX) {
                    for x in (low[0]..=high[0]).step_by(1 << TOP_LEVEL_INDEX) {
                        let square = Square { x, y, level: TOP_LEVEL_INDEX as u8 };
                        self.nodes.push(Node { bound, heading: number, square });
                    }
                }
            }
        }
    }

    /// Queues the quarters of a square whose bound exceeds the threshold.
    fn split(&mut self, pyramid: &LikelihoodPyramid, node: Node) {
        let quarters = node.square.quarters();
        let is_possible = quarters.map(|it| match self.region {
            Region::Free => pyramid.is_free(it),
            Region::Box { high, .. } => it.x <= high[0] && it.y <= high[1],
        });
        let points = self.rotated_points(node.heading.into());
        let (bounds, work) = pyramid.bounds(quarters[0], &points, self.threshold);
        self.lookup_count += work;
        for ((square, bound), is_possible) in quarters.into_iter().zip(bounds).zip(is_possible) {
            if is_possible && bound > self.threshold {
                self.nodes.push(Node { bound, square, ..node });
            }
        }
    }

    fn pose(&self, pyramid: &LikelihoodPyramid, node: Node) -> Pose2 {
        let yaw_rad = 2.0 * PI * f64::from(node.heading) / self.bounding_boxes.len() as f64;
        pyramid.pose(node.square, yaw_rad)
    }

    /// True if a better candidate covers the whole square.
    fn is_near_better(
        &self,
        pyramid: &LikelihoodPyramid,
        node: Node,
        limits: &CandidateLimits,
    ) -> bool {
        let low = self.pose(pyramid, node);
        let side_m = f64::from((1_u16 << node.square.level) - 1) * pyramid.cell_m;
        let PoseThreshold { distance_m, angle_rad } = limits.separation;
        self.peaks.iter().any(|peak| {
            let (dx, dy) = (low.x_m - peak.pose.x_m, low.y_m - peak.pose.y_m);
            dx > -distance_m
                && dy > -distance_m
                && dx + side_m < distance_m
                && dy + side_m < distance_m
                && normalize_angle(low.yaw_rad - peak.pose.yaw_rad).abs() < angle_rad
        })
    }

    /// Accepts a candidate. Candidates come in order of decreasing score.
    fn accept(&mut self, pyramid: &LikelihoodPyramid, node: Node, limits: &CandidateLimits) {
        if self.is_near_better(pyramid, node, limits) {
            return;
        }
        let score = f64::from(node.bound) / (f64::from(MAX_SCORE_PER_POINT) * self.count as f64);
        self.peaks.push(Peak { pose: self.pose(pyramid, node), score });
        self.best = self.best.max(node.bound);
        let threshold = (f64::from(self.best) * self.min_fraction) as u32;
        self.threshold = self.threshold.max(threshold);
        if self.peaks.len() >= limits.max_count {
            self.nodes.clear();
            self.completeness = Completeness::Partial;
        }
    }

    pub(crate) fn is_done(&self) -> bool {
        self.is_done
    }

    /// Number of lookups so far.
    pub(crate) fn lookup_count(&self) -> u64 {
        self.lookup_count
    }

    /// Restricts the rest of the search to candidates with a score of at least `min_score` and the
    /// fraction `min_fraction` of the best score.
    pub(crate) fn narrow(&mut self, min_fraction: f64, min_score: f64) {
        self.min_fraction = self.min_fraction.max(min_fraction);
        let by_score = (min_score * f64::from(MAX_SCORE_PER_POINT) * self.count as f64) as u32;
        let by_best = (f64::from(self.best) * self.min_fraction) as u32;
        self.threshold = self.threshold.max(by_best).max(by_score);
        self.completeness = self.completeness.min(Completeness::NearBest);
    }

    /// Ends the search with the candidates found so far.
    pub(crate) fn stop(&mut self) {
        if !self.is_done {
            self.nodes.clear();
            self.is_done = true;
            self.completeness = Completeness::Partial;
        }
    }

    /// Returns the candidates, best first, and their completeness.
    pub(crate) fn into_peaks(self) -> (Vec<Peak>, Completeness) {
        (self.peaks, self.completeness)
    }
}

/// Square of positions at one heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Node {
    /// Upper bound of the score of its positions; [`MAX_SCORE_PER_POINT`] per point.
    bound: u32,
    heading: u16,
    square: Square,
}

/// Bucket queue of nodes by bound. Bounds of popped nodes never increase, so that one list per
/// bound suffices.
#[derive(Clone, Debug, Default)]
struct BucketQueue {
    /// Per bound, the index of the last node, or [`NO_INDEX`].
    lists: Vec<u32>,
    /// Nodes with the index of the previous node of the same bound or of the free list.
    nodes: Vec<(Node, u32)>,
    free: u32,
    /// Upper limit of the bounds in the queue.
    top: usize,
}

const NO_INDEX: u32 = u32::MAX;

impl BucketQueue {
    /// Creates a queue for bounds up to `max_bound`.
    fn new(max_bound: usize) -> Self {
        Self { lists: vec![NO_INDEX; max_bound + 1], nodes: Vec::new(), free: NO_INDEX, top: 0 }
    }

    fn push(&mut self, node: Node) {
        let bound = node.bound as usize;
        let entry = (node, self.lists[bound]);
        let index = if self.free == NO_INDEX {
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
        while *self.lists.get(self.top)? == NO_INDEX {
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
        self.lists.fill(NO_INDEX);
        self.nodes.clear();
        (self.free, self.top) = (NO_INDEX, 0);
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;

    use super::*;

    #[test]
    fn the_best_pose_is_found_in_slices() {
        for seed in 0..6 {
            let mut stream = Stream::keyed(seed, "hunt", 0);
            let (wide_m, high_m) = (7.0, 4.6);
            let walls: Vec<(f64, f64)> =
                (0..400).map(|_| (wide_m * stream.unit(), high_m * stream.unit())).collect();
            let free: Vec<(f64, f64)> =
                (0..3000).map(|_| (wide_m * stream.unit(), high_m * stream.unit())).collect();
            let corners = [[0.0, 0.0], [wide_m, high_m]];
            let pyramid =
                LikelihoodPyramid::new(walls.iter().copied(), free.iter().copied(), corners, 0.1);
            // Some points are outside of the map.
            let point = |stream: &mut Stream| (6.0 * (stream.unit() - 0.5)) as f32;
            let points: Vec<[f32; 2]> =
                (0..30).map(|_| [point(&mut stream), point(&mut stream)]).collect();
            let mut search = BranchAndBound::new(&pyramid, &points, 0.1, (0.0, 1.0), None);
            let limits =
                CandidateLimits { max_count: 1, separation: PoseThreshold::new(0.01, 0.01) };
            let mut slices = 0;
            while !search.is_done() {
                search.advance(&pyramid, 20_000, &limits);
                slices += 1;
            }
            assert!(slices > 1);
            let best = search.best;
            let mut most = 0;
            for heading in 0..search.bounding_boxes.len() {
                let points = search.rotated_points(heading);
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
