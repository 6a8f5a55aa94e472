//! The search for a scan on all of a map, which can be done in parts.
//!
//! Branch and bound, the most promising first (Hess et al. 2016, "Real-time loop closure in 2D LIDAR
//! SLAM"): the largest likelihood over a square of cells bounds what any place of the robot within it
//! can reach. Besides, upper levels take several headings together, with squares that are wider by as
//! much as points move between them, and where nothing is free the robot cannot be.

use std::collections::BinaryHeap;
use std::f64::consts::PI;

use periplus_base::{Pose2, normalize_angle};
use periplus_matching::Peak;

/// The coarsest squares have 2 to the power of this cells on a side.
const TOP: usize = 6;
/// Squares of that many levels below it stand for several headings.
const FANNED: usize = 2;
/// So many headings, one more than twice this to either side.
const ASIDE: usize = 2;
/// By so many cells points move between them at most, and one for rounding.
const PAD: usize = ASIDE + 1;
/// After so many points it is seen whether the rest can matter.
const AT_ONCE: usize = 12;
/// To keep the order of nodes costs as much as so many lookups.
const POPPED: u64 = 30;
/// So many headings can be told apart, and so many points do not exceed the largest bound.
const MOST_HEADINGS: usize = 2048;
const MOST_POINTS: usize = 256;
/// How far from a wall a point may be that belongs to it: one standard deviation, in cells.
const SIGMA_CELLS: f32 = 1.2;
/// Farther it does not count.
const REACH_CELLS: usize = 2;

/// Likelihoods of points over a map, with the largest over ever larger squares.
#[derive(Clone, Debug)]
pub(crate) struct Pyramid {
    pub(crate) cell_m: f64,
    /// Corner of cell (0, 0) \[m\].
    corner_m: [f64; 2],
    width: usize,
    height: usize,
    /// `levels[k]` at a cell is the largest over the square of 2^k cells that begins there.
    levels: Vec<Vec<u8>>,
    /// The same of the upper levels, over squares wider by [`PAD`] to each side.
    fanned: Vec<Vec<u8>>,
    /// Whether the robot can be anywhere in such a square.
    free: Vec<Vec<u8>>,
}

impl Pyramid {
    /// Of walls and free places within a box \[m\].
    pub(crate) fn new(
        walls: impl Iterator<Item = (f64, f64)>,
        free: impl Iterator<Item = (f64, f64)>,
        [low_m, high_m]: [[f64; 2]; 2],
        cell_m: f64,
    ) -> Self {
        // On the low side there is room for squares that begin outside and reach in.
        let before = (1 << TOP) + PAD + REACH_CELLS;
        let after = PAD + REACH_CELLS + 1;
        let cells = |axis: usize| ((high_m[axis] - low_m[axis]) / cell_m) as usize + before + after;
        let (width, height) = (cells(0), cells(1));
        let corner_m = low_m.map(|low| low - before as f64 * cell_m);
        let cell_of = |(x, y): (f64, f64)| {
            let column = (((x - corner_m[0]) / cell_m) as usize).clamp(REACH_CELLS, width - 3);
            let row = (((y - corner_m[1]) / cell_m) as usize).clamp(REACH_CELLS, height - 3);
            (column, row)
        };
        let mut finest = vec![0_u8; width * height];
        for wall in walls {
            let (column, row) = cell_of(wall);
            finest[row * width + column] = 255;
        }
        let is_wall = finest.clone();
        let side = 2 * REACH_CELLS + 1;
        for index in (0..is_wall.len()).filter(|it| is_wall[*it] > 0) {
            for near in 0..side * side {
                let (right, up) = (near % side, near / side);
                let (x, y) = (right as f32 - REACH_CELLS as f32, up as f32 - REACH_CELLS as f32);
                let squared = (x * x + y * y) / (SIGMA_CELLS * SIGMA_CELLS);
                let value = (255.0 * libm::expf(-0.5 * squared)) as u8;
                let cell = index + up * width + right - REACH_CELLS * (width + 1);
                finest[cell] = finest[cell].max(value);
            }
        }
        let mut places = vec![0_u8; width * height];
        for place in free {
            let (column, row) = cell_of(place);
            places[row * width + column] = 1;
        }
        // A map may have a piece of furniture where the robot can be by now.
        let known = places.clone();
        for index in (0..known.len()).filter(|it| known[*it] > 0) {
            let (column, row) = (index % width, index / width);
            let around = [index - 1, index + 1, index - width, index + width];
            if around.iter().all(|it| known[*it] > 0) {
                continue;
            }
            for up in row - REACH_CELLS..=row + REACH_CELLS {
                let begin = up * width + column - REACH_CELLS;
                places[begin..=begin + 2 * REACH_CELLS].fill(1);
            }
        }
        let raised = |finest: Vec<u8>| {
            let mut levels = vec![finest];
            for level in 1..=TOP {
                let mut next = levels[level - 1].clone();
                widen(&mut next, width, 1 << (level - 1));
                levels.push(next);
            }
            levels
        };
        let levels = raised(finest);
        let fanned = (TOP - FANNED..=TOP)
            .map(|level| {
                let mut wider = levels[level].clone();
                // Each makes the square one cell wider.
                (0..2 * PAD).for_each(|_| widen(&mut wider, width, 1));
                wider
            })
            .collect();
        let free = raised(places);
        Self { cell_m, corner_m, width, height, levels, fanned, free }
    }

    /// Begins to look for where points fit, in the frame of the base \[m\]. Of places that fit less than
    /// `least` (0 to 1) nothing is wanted, nor of those below `share` of the best.
    ///
    /// Near a pose, not farther along each axis and in heading, the robot may also be where nothing is
    /// known to be free: \[m\], \[rad\].
    pub(crate) fn hunt(
        &self,
        points: &[[f32; 2]],
        step_rad: f64,
        (least, share): (f64, f64),
        near: Option<(Pose2, f64, f64)>,
    ) -> Hunt {
        let fan = 2 * ASIDE + 1;
        let fans = (libm::ceil(2.0 * PI / step_rad / fan as f64) as usize).max(1);
        let fans = fans.min(MOST_HEADINGS / fan);
        let headings = fans * fan;
        // In an order in which the first ones come from all sides, so that a few tell enough.
        let points = &points[..points.len().min(MOST_POINTS)];
        let stride = (points.len() / AT_ONCE).max(1);
        let ordered: Vec<[f32; 2]> = (0..stride)
            .flat_map(|first| points.iter().skip(first).step_by(stride))
            .copied()
            .collect();
        let mut offsets = Vec::with_capacity(headings * ordered.len());
        let scale = (1.0 / self.cell_m) as f32;
        for heading in 0..headings {
            let (sine, cosine) = libm::sincos(2.0 * PI * heading as f64 / headings as f64);
            let (sine, cosine) = (sine as f32 * scale, cosine as f32 * scale);
            let cell = |value: f32| libm::floorf(value + 0.5) as i32;
            offsets.extend(
                ordered.iter().map(|p| {
                    [cell(cosine * p[0] - sine * p[1]), cell(sine * p[0] + cosine * p[1])]
                }),
            );
        }
        let region = near.map_or_else(
            || Region {
                low: [0, 0],
                high: [self.width - 1, self.height - 1],
                fans: [0, fans],
                level: TOP,
                is_free: true,
            },
            |(pose, half_m, half_rad)| {
                let middle = [pose.x_m - self.corner_m[0], pose.y_m - self.corner_m[1]];
                let most = [self.width - 1, self.height - 1];
                let cell = |axis: usize, more_m: f64| {
                    (((middle[axis] + more_m) / self.cell_m).max(0.0) as usize).min(most[axis])
                };
                let fan_rad = 2.0 * PI / fans as f64;
                let first = libm::floor((pose.yaw_rad - half_rad) / fan_rad);
                let last = libm::floor((pose.yaw_rad + half_rad) / fan_rad);
                let first_fan = first.rem_euclid(fans as f64) as usize % fans;
                Region {
                    low: [cell(0, -half_m), cell(1, -half_m)],
                    high: [cell(0, half_m), cell(1, half_m)],
                    fans: [first_fan, ((last - first) as usize + 1).min(fans)],
                    level: TOP - FANNED,
                    is_free: false,
                }
            },
        );
        let count = ordered.len();
        let threshold = (least.clamp(0.0, 1.0) * 255.0 * count as f64) as u32;
        Hunt {
            offsets,
            count,
            headings,
            region,
            share,
            threshold,
            nodes: BinaryHeap::new(),
            roots: 0,
            work: 0,
            best: 0,
            peaks: Vec::new(),
            is_done: count == 0,
            completeness: Completeness::Whole,
        }
    }

    /// Goes on for about so many lookups.
    pub(crate) fn go_on(&self, hunt: &mut Hunt, most: u64, wanted: &Wanted) {
        let end = hunt.work.saturating_add(most);
        let Region { low, high, fans: [first, count], level, .. } = hunt.region;
        let stride = 1 << level;
        let across = |axis: usize| (high[axis] - low[axis]) / stride + 1;
        let (wide, fans) = (across(0), hunt.headings / (2 * ASIDE + 1));
        let roots = wide * across(1) * count;
        while hunt.work < end && hunt.roots < roots {
            let (place, fan) = (hunt.roots / count, (first + hunt.roots % count) % fans);
            hunt.roots += 1;
            let (x, y) = (low[0] + place % wide * stride, low[1] + place / wide * stride);
            let heading = (fan * (2 * ASIDE + 1) + ASIDE) as u16;
            let (level, x, y) = (level as u8, x as u16, y as u16);
            self.push(hunt, Node { bound: 0, level, is_fan: true, heading, x, y });
        }
        if hunt.roots < roots {
            return;
        }
        while hunt.work < end {
            let Some(node) = hunt.nodes.pop() else {
                hunt.is_done = true;
                return;
            };
            let node = Node::unpacked(node);
            hunt.work += POPPED;
            if node.bound <= hunt.threshold {
                hunt.nodes.clear();
                continue;
            }
            if node.level == 0 {
                self.take(hunt, node, wanted);
                continue;
            }
            if node.level <= 2 && self.is_shadowed(hunt, node, wanted) {
                continue;
            }
            if node.is_fan && usize::from(node.level) == TOP - FANNED {
                for heading in node.heading - ASIDE as u16..=node.heading + ASIDE as u16 {
                    self.push(hunt, Node { heading, is_fan: false, ..node });
                }
                continue;
            }
            let half = 1 << (node.level - 1);
            for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
                let (x, y) = (node.x + dx, node.y + dy);
                self.push(hunt, Node { x, y, level: node.level - 1, ..node });
            }
        }
    }

    /// Keeps a node, if anything in it may be worth a look.
    fn push(&self, hunt: &mut Hunt, node: Node) {
        let (x, y) = (usize::from(node.x), usize::from(node.y));
        let Region { high, is_free, .. } = hunt.region;
        if x > high[0] || y > high[1] {
            return;
        }
        if is_free && self.free[usize::from(node.level)][y * self.width + x] == 0 {
            return;
        }
        let bound = self.bound(hunt, node);
        if bound > hunt.threshold {
            hunt.nodes.push(Node { bound, ..node }.packed());
        }
    }

    /// Most that any place in a square can reach, summed over points.
    fn bound(&self, hunt: &mut Hunt, node: Node) -> u32 {
        let level = usize::from(node.level);
        let (values, pad) = if node.is_fan {
            (&self.fanned[level - (TOP - FANNED)], PAD as i32)
        } else {
            (&self.levels[level], 0)
        };
        let (x, y) = (i32::from(node.x) - pad, i32::from(node.y) - pad);
        let (width, height) = (self.width as u32, self.height as u32);
        let start = usize::from(node.heading) * hunt.count;
        let (mut sum, mut rest) = (0, 255 * hunt.count as u32);
        for points in hunt.offsets[start..start + hunt.count].chunks(AT_ONCE) {
            for &[dx, dy] in points {
                // Below zero is far above the size.
                let (column, row) = ((x + dx) as u32, (y + dy) as u32);
                if column < width && row < height {
                    sum += u32::from(values[(row * width + column) as usize]);
                }
            }
            hunt.work += points.len() as u64;
            rest -= 255 * points.len() as u32;
            if sum + rest <= hunt.threshold {
                break;
            }
        }
        sum
    }

    fn pose(&self, hunt: &Hunt, node: Node) -> Pose2 {
        let at = |cell: u16, corner_m: f64| corner_m + (f64::from(cell) + 0.5) * self.cell_m;
        let yaw_rad = 2.0 * PI * f64::from(node.heading) / hunt.headings as f64;
        Pose2::new(
            at(node.x, self.corner_m[0]),
            at(node.y, self.corner_m[1]),
            normalize_angle(yaw_rad),
        )
    }

    /// Whether all of a square is near a better place.
    fn is_shadowed(&self, hunt: &Hunt, node: Node, wanted: &Wanted) -> bool {
        let low = self.pose(hunt, node);
        let more_m = f64::from((1_u16 << node.level) - 1) * self.cell_m;
        let (near_m, near_rad) = wanted.apart;
        hunt.peaks.iter().any(|peak| {
            let (dx, dy) = (low.x_m - peak.pose.x_m, low.y_m - peak.pose.y_m);
            dx > -near_m
                && dy > -near_m
                && dx + more_m < near_m
                && dy + more_m < near_m
                && normalize_angle(low.yaw_rad - peak.pose.yaw_rad).abs() < near_rad
        })
    }

    /// Takes a place; better ones came before.
    fn take(&self, hunt: &mut Hunt, node: Node, wanted: &Wanted) {
        if self.is_shadowed(hunt, node, wanted) {
            return;
        }
        let score = f64::from(node.bound) / (255.0 * hunt.count as f64);
        hunt.peaks.push(Peak { pose: self.pose(hunt, node), score });
        hunt.best = hunt.best.max(node.bound);
        let least = (f64::from(hunt.best) * hunt.share) as u32;
        hunt.threshold = hunt.threshold.max(least);
        if hunt.peaks.len() >= wanted.most {
            hunt.nodes.clear();
            hunt.completeness = Completeness::Part;
        }
    }

    /// Which part of points fits at a pose.
    pub(crate) fn score(&self, points: &[[f32; 2]], pose: Pose2) -> f64 {
        let at = |point: &[f32; 2]| {
            let (x, y) = pose.transform_point(point[0].into(), point[1].into());
            let (u, v) =
                ((x - self.corner_m[0]) / self.cell_m, (y - self.corner_m[1]) / self.cell_m);
            let is_inside = u >= 0.0 && v >= 0.0 && u < self.width as f64 && v < self.height as f64;
            let cell = if is_inside { v as usize * self.width + u as usize } else { 0 };
            f64::from(self.levels[0][cell]) / 255.0
        };
        points.iter().map(at).sum::<f64>() / points.len().max(1) as f64
    }
}

/// The largest of each value and that `step` further, along both axes.
fn widen(cells: &mut [u8], width: usize, step: usize) {
    for row in cells.chunks_exact_mut(width) {
        for column in 0..width.saturating_sub(step) {
            row[column] = row[column].max(row[column + step]);
        }
    }
    for index in 0..cells.len().saturating_sub(step * width) {
        cells[index] = cells[index].max(cells[index + step * width]);
    }
}

/// Which places are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// No more than so many.
    pub(crate) most: usize,
    /// Of places nearer to each other than this the better one counts: \[m\], \[rad\].
    pub(crate) apart: (f64, f64),
}

/// A square of places at one heading, or a few of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Node {
    /// Most that any of them reaches; 255 for each point.
    bound: u32,
    is_fan: bool,
    level: u8,
    heading: u16,
    x: u16,
    y: u16,
}

impl Node {
    /// All in one number, in the order in which nodes are looked into.
    fn packed(self) -> u64 {
        u64::from(self.bound) << 47
            | u64::from(self.is_fan) << 46
            | u64::from(self.level) << 43
            | u64::from(self.heading) << 32
            | u64::from(self.x) << 16
            | u64::from(self.y)
    }

    fn unpacked(number: u64) -> Self {
        Self {
            bound: (number >> 47) as u32,
            is_fan: number >> 46 & 1 == 1,
            level: (number >> 43 & 7) as u8,
            heading: (number >> 32 & (MOST_HEADINGS as u64 - 1)) as u16,
            x: (number >> 16) as u16,
            y: number as u16,
        }
    }
}

/// Where it is looked.
#[derive(Clone, Copy, Debug)]
struct Region {
    /// Cells of the robot's place.
    low: [usize; 2],
    high: [usize; 2],
    /// The first of groups of headings, and how many they are.
    fans: [usize; 2],
    /// The size of squares with which it begins.
    level: usize,
    /// Whether only what is free counts.
    is_free: bool,
}

/// A search that is under way.
#[derive(Clone, Debug)]
pub(crate) struct Hunt {
    /// For each heading, the points in cells.
    offsets: Vec<[i32; 2]>,
    /// How many points.
    count: usize,
    headings: usize,
    region: Region,
    share: f64,
    threshold: u32,
    nodes: BinaryHeap<u64>,
    /// How many squares were looked at of those that make up the map.
    roots: usize,
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
        let least = (least * 255.0 * self.count as f64) as u32;
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
