//! Points of one scan.

use crate::surface::{Beam, normal};

/// Point of a scan with its surface normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// x in the cloud frame \[m\].
    pub x: f32,
    /// y in the cloud frame \[m\].
    pub y: f32,
    /// Unit normal of the surface, towards the scanner; (0, 0) where it is unknown.
    pub nx: f32,
    /// See `nx`.
    pub ny: f32,
}

impl Point {
    /// True if the surface normal is known.
    #[must_use]
    pub fn is_on_line(&self) -> bool {
        self.nx != 0.0 || self.ny != 0.0
    }
}

/// Settings of a cloud.
#[derive(Clone, Copy, Debug)]
pub struct CloudSettings {
    /// Minimum distance between consecutive points \[m\].
    pub spacing_m: f32,
    /// Maximum number of points; with more, the spacing grows.
    pub most_points: usize,
}

impl Default for CloudSettings {
    fn default() -> Self {
        Self { spacing_m: 0.03, most_points: 360 }
    }
}

/// Visibility along a bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sight {
    /// Outside of the view, or no return.
    Unknown,
    /// Free up to `near`, occluded behind `far` \[m\].
    Surface { near: f32, far: f32 },
}

/// Points of one scan in order of their bearing from the scanner.
#[derive(Clone, Debug)]
pub struct Cloud {
    points: Vec<Point>,
    /// Range of each point \[m\].
    ranges: Vec<f32>,
    /// Bearing of each point, as [`pseudo_angle`].
    turns: Vec<f32>,
    /// True if the space between a point and the next was seen.
    is_followed: Vec<bool>,
    origin: [f32; 2],
    /// Per bin of the full circle, the index of the first point in or after it, and the end.
    starts: Vec<u16>,
}

/// Number of bearing bins.
const BINS: usize = 256;
/// Bins per unit of the pseudo-angle.
const BINS_PER_UNIT_RATIO: f32 = BINS as f32 / 4.0;

/// Half-width of a window of bearings \[pseudo-angle\] that holds all points within a reach, as a
/// multiple of the reach over |x| + |y|, and the half-width up to which this is true. For points
/// beside a ray the multiple is 1; across an axis it grows to 1.155 at 60 degrees.
const WINDOW_FACTOR: f32 = 1.15;
const MAX_HALF_WINDOW_RATIO: f32 = 0.6;

/// Maximum number of points, which are counted in 16 bits.
const MAX_POINTS: usize = 60_000;

impl Cloud {
    /// Creates a cloud from the beams of one scan in order: end points in the cloud frame, none for
    /// beams without a return. `origin` is the scanner in that frame \[m\], `step_rad` the angle
    /// between beams.
    #[must_use]
    pub fn new(
        beams: impl IntoIterator<Item = Option<[f32; 2]>>,
        origin: [f32; 2],
        step_rad: f32,
        settings: &CloudSettings,
    ) -> Self {
        let beams: Vec<Beam> = beams
            .into_iter()
            .enumerate()
            .filter_map(|(index, end)| end.map(|[x, y]| Beam { x, y, index }))
            .filter(|beam| beam.x.is_finite() && beam.y.is_finite())
            .collect();
        let kept = decimate(&beams, settings);
        let mut all: Vec<(f32, f32, Point, bool)> = Vec::with_capacity(kept.len());
        for (place, &at) in kept.iter().enumerate() {
            let beam = beams[at];
            let [nx, ny] = normal(&beams, at, origin, step_rad.abs());
            let (x, y) = (beam.x - origin[0], beam.y - origin[1]);
            // A single lost beam between two others leaves no gap.
            let next = kept.get(place + 1).map(|&next| (next, beams[next].index));
            let is_followed = next.is_some_and(|(next, index)| {
                index - beam.index <= next - at + 1
                    && (index - beam.index) as f32 * step_rad.abs() < 0.2
            });
            let point = Point { x: beam.x, y: beam.y, nx, ny };
            all.push((pseudo_angle(x, y), (x * x + y * y).sqrt(), point, is_followed));
        }
        // In clockwise scans, the next point is the one before.
        if step_rad < 0.0 {
            for place in (1..all.len()).rev() {
                all[place].3 = all[place - 1].3;
            }
            if let Some(first) = all.first_mut() {
                first.3 = false;
            }
        }
        Self::from_entries(all, origin)
    }

    /// Creates a cloud from points in any order with their visibility flags.
    pub(crate) fn sorted(points: impl Iterator<Item = (Point, bool)>, origin: [f32; 2]) -> Self {
        let all = points.map(|(point, is_followed)| {
            let (x, y) = (point.x - origin[0], point.y - origin[1]);
            (pseudo_angle(x, y), (x * x + y * y).sqrt(), point, is_followed)
        });
        Self::from_entries(all.collect(), origin)
    }

    /// Creates a cloud from bearing, range, point and visibility flag.
    fn from_entries(mut all: Vec<(f32, f32, Point, bool)>, origin: [f32; 2]) -> Self {
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let turns: Vec<f32> = all.iter().map(|it| it.0).collect();
        Self {
            points: all.iter().map(|it| it.2).collect(),
            ranges: all.iter().map(|it| it.1).collect(),
            starts: bin_starts(&turns),
            turns,
            is_followed: all.iter().map(|it| it.3).collect(),
            origin,
        }
    }

    /// Restores a cloud from its [`Cloud::points`], [`Cloud::followed`] and [`Cloud::origin`], to
    /// the bit. None if they are invalid: too many, not in order, or not finite.
    #[must_use]
    pub fn restored(points: Vec<Point>, is_followed: Vec<bool>, origin: [f32; 2]) -> Option<Self> {
        let is_finite = points
            .iter()
            .all(|p| p.x.is_finite() && p.y.is_finite() && p.nx.is_finite() && p.ny.is_finite())
            && origin.iter().all(|it| it.is_finite());
        if !is_finite || points.len() != is_followed.len() || points.len() > MAX_POINTS {
            return None;
        }
        let offset = |p: &Point| (p.x - origin[0], p.y - origin[1]);
        let turn = |p: &Point| {
            let (x, y) = offset(p);
            pseudo_angle(x, y)
        };
        let range = |p: &Point| {
            let (x, y) = offset(p);
            (x * x + y * y).sqrt()
        };
        let turns: Vec<f32> = points.iter().map(turn).collect();
        let ranges: Vec<f32> = points.iter().map(range).collect();
        let is_sorted = turns.windows(2).all(|pair| pair[0] <= pair[1]);
        if !is_sorted || !ranges.iter().all(|it| it.is_finite()) {
            return None;
        }
        Some(Self { starts: bin_starts(&turns), points, ranges, turns, is_followed, origin })
    }

    /// Visibility flags: true if the space up to the next point was seen.
    #[must_use]
    pub fn followed(&self) -> &[bool] {
        &self.is_followed
    }

    /// Points in order of bearing.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Scanner position in the cloud frame \[m\].
    #[must_use]
    pub fn origin(&self) -> [f32; 2] {
        self.origin
    }

    /// Approximate size in memory \[bytes\].
    #[must_use]
    pub fn size(&self) -> usize {
        self.points.len() * (size_of::<Point>() + 9) + self.starts.len() * 2
    }

    /// Nearest point within `reach_m` of a position: its index and squared distance.
    #[must_use]
    #[inline]
    pub fn nearest(&self, x: f32, y: f32, reach_m: f32) -> Option<(usize, f32)> {
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        let sum = dx.abs() + dy.abs();
        if !sum.is_finite() {
            return None;
        }
        let per_sum = 1.0 / sum.max(f32::MIN_POSITIVE);
        let half = reach_m * per_sum * WINDOW_FACTOR;
        let mut best = (usize::MAX, reach_m * reach_m);
        if half > MAX_HALF_WINDOW_RATIO {
            self.nearest_in(0, self.points.len(), x, y, &mut best);
        } else {
            let middle = turn_of(dx, dy, per_sum) * BINS_PER_UNIT_RATIO;
            let bins = BINS as i32;
            // Rounds down, including negative values, without a function call.
            let bin = |turn: f32| (turn + BINS as f32) as i32 - bins;
            let first = bin(middle - half * BINS_PER_UNIT_RATIO);
            let last = bin(middle + half * BINS_PER_UNIT_RATIO);
            let start = |bin: i32| usize::from(self.starts[bin as usize]);
            let (low, high) = (first.max(0), last.min(bins - 1));
            self.nearest_in(start(low), start(high + 1), x, y, &mut best);
            if first < 0 {
                self.nearest_in(start(first + bins), start(bins), x, y, &mut best);
            }
            if last >= bins {
                self.nearest_in(0, start(last - bins + 1), x, y, &mut best);
            }
        }
        (best.0 != usize::MAX).then_some(best)
    }

    #[inline]
    fn nearest_in(&self, start: usize, end: usize, x: f32, y: f32, best: &mut (usize, f32)) {
        for (place, point) in self.points[start..end].iter().enumerate() {
            let (dx, dy) = (point.x - x, point.y - y);
            let squared = dx * dx + dy * dy;
            if squared < best.1 {
                *best = (start + place, squared);
            }
        }
    }

    /// Visibility in the direction of a position, and its distance \[m\].
    pub(crate) fn sight(&self, x: f32, y: f32) -> (Sight, f32) {
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        let distance = (dx * dx + dy * dy).sqrt();
        if self.points.len() < 2 {
            return (Sight::Unknown, distance);
        }
        let turn = pseudo_angle(dx, dy);
        let bin = ((turn * BINS_PER_UNIT_RATIO) as usize).min(BINS - 1);
        let mut after = usize::from(self.starts[bin]);
        while after < self.turns.len() && self.turns[after] <= turn {
            after += 1;
        }
        let before = if after == 0 { self.points.len() - 1 } else { after - 1 };
        let after = if after == self.points.len() { 0 } else { after };
        if !self.is_followed[before] {
            return (Sight::Unknown, distance);
        }
        let (a, b) = (self.ranges[before], self.ranges[after]);
        (Sight::Surface { near: a.min(b), far: a.max(b) }, distance)
    }
}

/// Per bin of the full circle, the index of the first point in or after it, and the end.
fn bin_starts(turns: &[f32]) -> Vec<u16> {
    let mut starts = Vec::with_capacity(BINS + 1);
    let mut at = 0;
    for bin in 0..=BINS {
        while at < turns.len() && ((turns[at] * BINS_PER_UNIT_RATIO) as usize) < bin {
            at += 1;
        }
        starts.push(at as u16);
    }
    if let Some(end) = starts.last_mut() {
        *end = turns.len() as u16;
    }
    starts
}

/// Pseudo-angle of a direction: 0 to 4 (exclusive), increasing with the angle, without
/// trigonometric functions. One unit is between one and two radians.
#[inline]
fn pseudo_angle(x: f32, y: f32) -> f32 {
    turn_of(x, y, 1.0 / (x.abs() + y.abs()).max(f32::MIN_POSITIVE))
}

/// Pseudo-angle by the reciprocal of |x| + |y|, without a branch.
#[inline]
fn turn_of(x: f32, y: f32, per_sum: f32) -> f32 {
    let part = y * per_sum;
    let (x_sign, y_sign) = (x.to_bits() & (1 << 31), y.to_bits() & (1 << 31));
    // The angle at which the half-plane of x, or the quadrant, begins.
    let quadrant = (x_sign >> 30 | y_sign >> 31) as usize;
    let turn = [0.0, 4.0, 2.0, 2.0][quadrant] + f32::from_bits(part.to_bits() ^ x_sign);
    // Rounding may reach 4.
    if turn >= 4.0 { 0.0 } else { turn }
}

/// Indices of the beams that are kept.
fn decimate(beams: &[Beam], settings: &CloudSettings) -> Vec<usize> {
    let most = settings.most_points.clamp(8, MAX_POINTS);
    let mut spacing = settings.spacing_m.max(1e-3);
    loop {
        let mut kept: Vec<usize> = Vec::with_capacity(most.min(beams.len()));
        for (at, beam) in beams.iter().enumerate() {
            let is_near = kept.last().is_some_and(|&last| {
                let (dx, dy) = (beam.x - beams[last].x, beam.y - beams[last].y);
                dx * dx + dy * dy < spacing * spacing
            });
            if !is_near {
                kept.push(at);
            }
        }
        if kept.len() <= most {
            return kept;
        }
        spacing *= 1.25;
    }
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn pseudo_angle_is_a_quarter_per_axis() {
        let ends = [[1.0, 0.0], [2.0, 2.0], [0.0, 3.0], [-1.0, 0.0], [0.0, -1.0], [1.0, -1.0]];
        let turns = ends.map(|[x, y]: [f32; 2]| pseudo_angle(x, y));
        assert_eq!(turns, [0.0, 0.5, 1.0, 2.0, 3.0, 3.5]);
        assert_eq!(pseudo_angle(1.0, -1e-12), 0.0);
        assert_eq!(pseudo_angle(0.0, 0.0), 0.0);
    }

    #[test]
    fn no_point_is_near_a_position_that_is_not_finite() {
        let points =
            [[1.0, 0.0], [0.0, 1.0]].map(|[x, y]| (Point { x, y, nx: 0.0, ny: 0.0 }, false));
        let cloud = Cloud::sorted(points.into_iter(), [0.0, 0.0]);
        let values = [0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
        for (x, y) in values.into_iter().flat_map(|x| values.map(|y| (x, y))) {
            assert_eq!(cloud.nearest(x, y, 0.5), None, "({x}, {y})");
        }
    }

    proptest! {
        #[test]
        fn windows_of_bearings_miss_no_nearest_point(
            ends in vec((-4.0_f32..4.0, -4.0_f32..4.0), 0..400),
            queries in vec((-5.0_f32..5.0, -5.0_f32..5.0, 0.05_f32..2.0), 80),
        ) {
            let flat = ends.iter().map(|&(x, y)| (Point { x, y, nx: 0.0, ny: 0.0 }, false));
            let cloud = Cloud::sorted(flat, [0.5, -0.25]);
            for (x, y, reach_m) in queries {
                let squared = |p: &Point| (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y);
                let least = cloud.points().iter().map(squared).fold(reach_m * reach_m, f32::min);
                let expected = (least < reach_m * reach_m).then_some(least);
                prop_assert_eq!(cloud.nearest(x, y, reach_m).map(|(_, squared)| squared), expected);
            }
        }
    }
}
