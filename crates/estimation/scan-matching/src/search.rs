//! The best place in all of a window.

use periplus_geometry::{Pose2, normalize_angle};

use crate::field::Field;

/// Where to search: around a middle, so far to either side.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// The middle.
    pub middle: Pose2,
    /// To either side along x and y \[m\].
    pub half_m: [f64; 2],
    /// To either side \[rad\].
    pub half_rad: f64,
    /// From one heading to the next \[rad\].
    pub step_rad: f64,
}

/// A place where points fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The place.
    pub pose: Pose2,
    /// Mean likelihood of the points there, 0 to 1.
    pub score: f64,
}

/// Which peaks are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Lower scores are none.
    pub least: f64,
    /// Nor are those below this share of the best.
    pub share: f64,
    /// No more than so many.
    pub most: usize,
    /// Of places nearer to each other than this the better one counts: \[m\], \[rad\].
    pub apart: (f64, f64),
    /// So many lookups, and the share is raised, so that the end comes soon.
    pub most_work: u64,
}

/// A square of shifts at one heading.
#[derive(Clone, Copy)]
struct Node {
    heading: u32,
    x: i32,
    y: i32,
    bound: u32,
}

/// A place, and how near others count as the same: \[m\], \[rad\].
pub(crate) type Zone = (Pose2, f64, f64);

impl Field {
    /// The place in a window where points have the highest mean likelihood, if any reaches `least`:
    /// with certainty the best of all on the lattice of cells and headings. With `avoid` places
    /// nearer than so many metres and radians to a pose do not count: so a second peak is found.
    ///
    /// Branch and bound: the largest value over a square of cells bounds what any shift within it
    /// can reach (Hess et al. 2016, "Real-time loop closure in 2D LIDAR SLAM").
    ///
    /// The number beside is the work done, in lookups.
    #[must_use]
    pub fn search(
        &self,
        points: &[[f32; 2]],
        window: &Window,
        least: f64,
        avoid: Option<(Pose2, f64, f64)>,
    ) -> (Option<Peak>, u64) {
        if points.is_empty() {
            return (None, 0);
        }
        let mut search = Search::new(self, points, window, least, avoid);
        search.run();
        (search.best(), search.work)
    }
}

impl Field {
    /// All peaks in a window, the best first, by the same search; the best is among them whatever
    /// the work. The number beside is the work done, in lookups.
    #[must_use]
    pub fn peaks(&self, points: &[[f32; 2]], window: &Window, wanted: &Wanted) -> (Vec<Peak>, u64) {
        if points.is_empty() || wanted.most == 0 {
            return (Vec::new(), 0);
        }
        let mut search = Search::new(self, points, window, wanted.least, None);
        search.several = Some(Several { wanted: *wanted, share: wanted.share, peaks: Vec::new() });
        search.run();
        let peaks = search.several.map_or_else(Vec::new, |several| several.peaks);
        (peaks.into_iter().map(|(_, peak)| peak).collect(), search.work)
    }
}

/// Peaks so far, the best first, with their bounds.
struct Several {
    wanted: Wanted,
    share: f64,
    peaks: Vec<(u32, Peak)>,
}

impl Several {
    /// Takes a place; gives what others have to exceed from now on.
    fn take(&mut self, bound: u32, peak: Peak, work: u64, least: u32) -> u32 {
        let (metres, radians) = self.wanted.apart;
        let is_near = |other: &Peak| {
            (other.pose.x_m - peak.pose.x_m).abs() < metres
                && (other.pose.y_m - peak.pose.y_m).abs() < metres
                && normalize_angle(other.pose.yaw_rad - peak.pose.yaw_rad).abs() < radians
        };
        let is_new = self.peaks.iter().all(|(other, it)| *other < bound || !is_near(it));
        if is_new {
            self.peaks.retain(|(_, it)| !is_near(it));
            let at = self.peaks.partition_point(|(other, _)| *other >= bound);
            self.peaks.insert(at, (bound, peak));
            self.peaks.truncate(self.wanted.most);
        }
        if work > self.wanted.most_work {
            self.share += 0.5 * (1.0 - self.share);
            self.wanted.most_work = self.wanted.most_work.saturating_mul(2);
        }
        let best = self.peaks.first().map_or(0, |(best, _)| *best);
        let full = self.peaks.len() == self.wanted.most;
        let worst = self.peaks.last().filter(|_| full).map_or(0, |(worst, _)| *worst);
        // One less, since only what exceeds it is looked into.
        least.max(worst).max(((f64::from(best) * self.share) as u32).saturating_sub(1))
    }
}

/// More cells than any field has on a side, and few enough to leave a float its fractions.
const FAR: f32 = 16384.0;

/// After so many points it is seen whether the rest can matter.
const POINTS: usize = 12;

struct Search<'a> {
    field: &'a Field,
    window: &'a Window,
    avoid: Option<Zone>,
    count: usize,
    /// Shifts to either side in cells.
    reach: [i32; 2],
    headings: u32,
    /// For each heading, the points in cells.
    cells: Vec<(i32, i32)>,
    found: Option<Node>,
    /// Where all peaks are wanted.
    several: Option<Several>,
    threshold: u32,
    work: u64,
}

impl<'a> Search<'a> {
    fn new(
        field: &'a Field,
        points: &[[f32; 2]],
        window: &'a Window,
        least: f64,
        avoid: Option<Zone>,
    ) -> Self {
        let step = window.step_rad.max(1e-4);
        let side = (window.half_rad / step).ceil().clamp(0.0, 4000.0) as i32;
        let headings = 2 * side as u32 + 1;
        let mut cells = Vec::with_capacity(points.len() * headings as usize);
        let scale = 1.0 / field.resolution_m;
        for heading in -side..=side {
            let (sine, cosine) = libm::sincos(window.middle.yaw_rad + f64::from(heading) * step);
            let (sine, cosine) = (sine as f32, cosine as f32);
            let x = window.middle.x_m as f32 - field.corner[0];
            let y = window.middle.y_m as f32 - field.corner[1];
            // Rounds down, also below zero, without a call.
            let cell = |value: f32| (value * scale + FAR) as i32 - FAR as i32;
            cells.extend(points.iter().map(|p| {
                (cell(cosine * p[0] - sine * p[1] + x), cell(sine * p[0] + cosine * p[1] + y))
            }));
        }
        let reach = window
            .half_m
            .map(|half| (half / f64::from(field.resolution_m)).ceil().clamp(0.0, 20_000.0) as i32);
        let threshold = (least.clamp(0.0, 1.0) * 255.0 * points.len() as f64) as u32;
        Self {
            field,
            window,
            avoid,
            count: points.len(),
            reach,
            headings,
            cells,
            found: None,
            several: None,
            threshold,
            work: 0,
        }
    }

    fn run(&mut self) {
        // Squares no larger than the window asks for.
        let mut top = self.field.levels.len() - 1;
        while top > 0 && (1 << (top - 1)) > 2 * self.reach[0].max(self.reach[1]) {
            top -= 1;
        }
        let stride = 1 << top;
        let mut roots = Vec::new();
        for heading in 0..self.headings {
            let mut y = -self.reach[1];
            while y <= self.reach[1] {
                let mut x = -self.reach[0];
                while x <= self.reach[0] {
                    let node = Node { heading, x, y, bound: 0 };
                    let bound = self.bound(node, top);
                    if bound > self.threshold {
                        roots.push(Node { bound, ..node });
                    }
                    x += stride;
                }
                y += stride;
            }
        }
        self.descend(roots, top);
    }

    /// Looks into squares, the most promising first.
    fn descend(&mut self, mut nodes: Vec<Node>, level: usize) {
        nodes.sort_by_key(|node| std::cmp::Reverse(node.bound));
        for node in nodes {
            if node.bound <= self.threshold {
                break;
            }
            if level == 0 {
                if self.several.is_some() {
                    self.take(node);
                } else if !self.is_avoided(node) {
                    self.threshold = node.bound;
                    self.found = Some(node);
                }
                continue;
            }
            let half = 1 << (level - 1);
            let mut children = Vec::with_capacity(4);
            for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
                let (x, y) = (node.x + dx, node.y + dy);
                if x > self.reach[0] || y > self.reach[1] {
                    continue;
                }
                let child = Node { x, y, ..node };
                let bound = self.bound(child, level - 1);
                if bound > self.threshold {
                    children.push(Node { bound, ..child });
                }
            }
            self.descend(children, level - 1);
        }
    }

    /// Takes a place as one of several.
    fn take(&mut self, node: Node) {
        let (peak, work, least) = (self.peak(node), self.work, self.threshold);
        if let Some(several) = &mut self.several {
            self.threshold = several.take(node.bound, peak, work, least);
        }
    }

    /// Most that any shift in a square can reach, summed over points.
    fn bound(&mut self, node: Node, level: usize) -> u32 {
        self.work += self.count as u64;
        let values = &self.field.levels[level];
        let (width, height) = (self.field.width as u32, self.field.height as u32);
        let start = node.heading as usize * self.count;
        let (mut sum, mut rest) = (0, 255 * self.count as u32);
        for points in self.cells[start..start + self.count].chunks(POINTS) {
            for &(column, row) in points {
                // Below zero is far above the size.
                let (column, row) = ((column + node.x) as u32, (row + node.y) as u32);
                if column < width && row < height {
                    sum += u32::from(values[(row * width + column) as usize]);
                }
            }
            rest -= 255 * points.len() as u32;
            // However well the others fit, nobody will look into it.
            if sum + rest <= self.threshold {
                break;
            }
        }
        sum
    }

    fn pose(&self, node: Node) -> Pose2 {
        let side = f64::from(self.headings / 2);
        let resolution_m = f64::from(self.field.resolution_m);
        let middle = self.window.middle;
        Pose2::new(
            middle.x_m + f64::from(node.x) * resolution_m,
            middle.y_m + f64::from(node.y) * resolution_m,
            normalize_angle(
                middle.yaw_rad + (f64::from(node.heading) - side) * self.window.step_rad.max(1e-4),
            ),
        )
    }

    fn is_avoided(&self, node: Node) -> bool {
        let Some((avoid, metres, radians)) = self.avoid else { return false };
        let pose = self.pose(node);
        (pose.x_m - avoid.x_m).abs() < metres
            && (pose.y_m - avoid.y_m).abs() < metres
            && normalize_angle(pose.yaw_rad - avoid.yaw_rad).abs() < radians
    }

    fn peak(&self, node: Node) -> Peak {
        let score = f64::from(node.bound) / (255.0 * self.count as f64);
        Peak { pose: self.pose(node), score }
    }

    fn best(&self) -> Option<Peak> {
        self.found.map(|node| self.peak(node))
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;

    use super::*;
    use crate::FieldSettings;

    fn scattered(seed: u64) -> Vec<[f32; 2]> {
        let mut stream = Stream::keyed(seed, "scattered", 0);
        let mut number = |span: f64| (span * (stream.unit() - 0.5)) as f32;
        (0..60).map(|_| [number(12.0), number(12.0)]).collect()
    }

    #[test]
    fn the_best_place_is_the_best_of_all_places() {
        for seed in 0..4 {
            let points = scattered(seed);
            let field = Field::new(&points, [0.0, 0.0], &FieldSettings::default());
            let truth = Pose2::new(1.23, -0.71, 0.3);
            let moved: Vec<[f32; 2]> = points
                .iter()
                .map(|p| {
                    let (x, y) = truth.inverse().transform_point(p[0].into(), p[1].into());
                    [x as f32, y as f32]
                })
                .collect();
            let window =
                Window { middle: Pose2::IDENTITY, half_m: [2.0; 2], half_rad: 0.5, step_rad: 0.01 };
            let (peak, _) = field.search(&moved, &window, 0.2, None);
            let peak = peak.unwrap();
            assert!((peak.pose.x_m - truth.x_m).abs() < 0.1, "{peak:?}");
            assert!((peak.pose.y_m - truth.y_m).abs() < 0.1, "{peak:?}");
            assert!((peak.pose.yaw_rad - truth.yaw_rad).abs() < 0.02, "{peak:?}");
            // Against looking everywhere.
            let mut best = 0.0_f64;
            for heading in -50..=50 {
                for x in -20..=20 {
                    for y in -20..=20 {
                        let at = Pose2::new(
                            f64::from(x) * 0.1,
                            f64::from(y) * 0.1,
                            f64::from(heading) * 0.01,
                        );
                        let (s, c) = libm::sincos(at.yaw_rad);
                        let (s, c) = (s as f32, c as f32);
                        let sum: f64 = moved
                            .iter()
                            .map(|p| {
                                let x = c * p[0] - s * p[1];
                                let y = s * p[0] + c * p[1];
                                // As the search does: cells first, then whole shifts.
                                let cell = |v: f32, corner: f32| {
                                    ((v - corner) / 0.1).floor() * 0.1 + corner + 0.05
                                };
                                let x = cell(x, field.corner[0]) + at.x_m as f32;
                                let y = cell(y, field.corner[1]) + at.y_m as f32;
                                f64::from(field.at(x, y))
                            })
                            .sum();
                        best = best.max(sum / moved.len() as f64);
                    }
                }
            }
            assert!((best - peak.score).abs() < 0.02, "{best} {}", peak.score);
        }
    }

    #[test]
    fn a_second_peak_is_elsewhere() {
        let mut points = scattered(9);
        let copy: Vec<[f32; 2]> = points.iter().map(|p| [p[0] + 3.0, p[1]]).collect();
        let moving = points.clone();
        points.extend(copy);
        let field = Field::new(&points, [0.0, 0.0], &FieldSettings::default());
        let window = Window {
            middle: Pose2::new(1.5, 0.0, 0.0),
            half_m: [3.0; 2],
            half_rad: 0.1,
            step_rad: 0.02,
        };
        let (first, _) = field.search(&moving, &window, 0.5, None);
        let first = first.unwrap();
        let (second, _) = field.search(&moving, &window, 0.5, Some((first.pose, 0.6, 1.0)));
        let second = second.unwrap();
        assert!(((first.pose.x_m - second.pose.x_m).abs() - 3.0).abs() < 0.15);
        assert!(second.score > 0.8 * first.score);
        let wanted =
            Wanted { least: 0.5, share: 0.8, most: 9, apart: (0.6, 1.0), most_work: u64::MAX };
        let (peaks, _) = field.peaks(&moving, &window, &wanted);
        assert_eq!(peaks.len(), 2, "{peaks:?}");
        assert_eq!(peaks[0].score, first.score);
        assert!((peaks[0].pose.x_m - peaks[1].pose.x_m).abs() > 2.8, "{peaks:?}");
        let (peaks, _) = field.peaks(&moving, &window, &Wanted { most: 1, ..wanted });
        assert_eq!(peaks.len(), 1);
    }
}
