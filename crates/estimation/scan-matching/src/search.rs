//! Global search for the best pose in a window.

use periplus_geometry::{Pose2, normalize_angle};

use crate::field::ScoreField;

/// Search window.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// Center.
    pub middle: Pose2,
    /// Half width along x and y \[m\].
    pub half_m: [f64; 2],
    /// Half width in yaw \[rad\].
    pub half_rad: f64,
    /// Heading step \[rad\].
    pub step_rad: f64,
}

/// Local maximum of the score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Pose.
    pub pose: Pose2,
    /// Mean likelihood of the points, 0 to 1.
    pub score: f64,
}

/// Settings of a search for several peaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Minimum score.
    pub least: f64,
    /// Minimum score as a fraction of the best one.
    pub share: f64,
    /// Maximum number of peaks.
    pub most: usize,
    /// Minimum separation of peaks \[m\], \[rad\]; of closer ones the better is kept.
    pub apart: (f64, f64),
    /// Number of lookups after which `share` is raised, to end the search soon.
    pub most_work: u64,
}

/// Square of translations at one heading.
#[derive(Clone, Copy)]
struct Node {
    heading: u32,
    x: i32,
    y: i32,
    bound: u32,
}

/// Pose, and the distance \[m\] and angle \[rad\] within which others count as the same.
pub(crate) type Zone = (Pose2, f64, f64);

impl ScoreField {
    /// Finds the pose in a window with the highest mean likelihood of the points, if any reaches
    /// `least`: the global maximum on the grid of cells and headings. Poses close to `avoid` (pose,
    /// distance \[m\], angle \[rad\]) do not count, so that a second peak can be found.
    ///
    /// Branch and bound: the maximum over a square of cells bounds the score of every translation
    /// within it (Hess et al. 2016, "Real-time loop closure in 2D LIDAR SLAM").
    ///
    /// Also returns the number of lookups.
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

impl ScoreField {
    /// Finds all peaks in a window, best first, by the same search. The best one is found whatever
    /// the work. Also returns the number of lookups.
    #[must_use]
    pub fn peaks(&self, points: &[[f32; 2]], window: &Window, wanted: &Wanted) -> (Vec<Peak>, u64) {
        if points.is_empty() || wanted.most == 0 {
            return (Vec::new(), 0);
        }
        let mut search = Search::new(self, points, window, wanted.least, None);
        search.several = Some(PeakList { wanted: *wanted, share: wanted.share, peaks: Vec::new() });
        search.run();
        let peaks = search.several.map_or_else(Vec::new, |several| several.peaks);
        (peaks.into_iter().map(|(_, peak)| peak).collect(), search.work)
    }
}

/// Peaks found so far with their bounds, best first.
struct PeakList {
    wanted: Wanted,
    share: f64,
    peaks: Vec<(u32, Peak)>,
}

impl PeakList {
    /// Adds a candidate and returns the new threshold.
    fn insert(&mut self, bound: u32, peak: Peak, work: u64, least: u32) -> u32 {
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
        // One less, since only bounds above it are expanded.
        least.max(worst).max(((f64::from(best) * self.share) as u32).saturating_sub(1))
    }
}

/// Offset that is larger than any field and leaves a float its fraction.
const OFFSET_CELL_COUNT: f32 = 16384.0;

/// Number of points between checks whether the rest can still reach the threshold.
const CHECK_POINTS: usize = 12;

struct Search<'a> {
    field: &'a ScoreField,
    window: &'a Window,
    avoid: Option<Zone>,
    count: usize,
    /// Half width of the window \[cells\].
    reach: [i32; 2],
    headings: u32,
    /// Per heading, the points \[cells\].
    cells: Vec<(i32, i32)>,
    found: Option<Node>,
    /// State of a search for several peaks.
    several: Option<PeakList>,
    threshold: u32,
    work: u64,
}

impl<'a> Search<'a> {
    fn new(
        field: &'a ScoreField,
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
            // Rounds down, including negative values, without a function call.
            let cell =
                |value: f32| (value * scale + OFFSET_CELL_COUNT) as i32 - OFFSET_CELL_COUNT as i32;
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
        // Coarsest level that is not larger than the window.
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

    /// Expands squares, the most promising first.
    fn descend(&mut self, mut nodes: Vec<Node>, level: usize) {
        nodes.sort_by_key(|node| std::cmp::Reverse(node.bound));
        for node in nodes {
            if node.bound <= self.threshold {
                break;
            }
            if level == 0 {
                if self.several.is_some() {
                    self.add_peak(node);
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

    /// Adds a candidate as one of several peaks.
    fn add_peak(&mut self, node: Node) {
        let (peak, work, least) = (self.peak(node), self.work, self.threshold);
        if let Some(several) = &mut self.several {
            self.threshold = several.insert(node.bound, peak, work, least);
        }
    }

    /// Upper bound of the score of the translations in a square, summed over points.
    fn bound(&mut self, node: Node, level: usize) -> u32 {
        self.work += self.count as u64;
        let values = &self.field.levels[level];
        let (width, height) = (self.field.width as u32, self.field.height as u32);
        let start = node.heading as usize * self.count;
        let (mut sum, mut rest) = (0, 255 * self.count as u32);
        for points in self.cells[start..start + self.count].chunks(CHECK_POINTS) {
            for &(column, row) in points {
                // Negative values wrap to values above the size.
                let (column, row) = ((column + node.x) as u32, (row + node.y) as u32);
                if column < width && row < height {
                    sum += u32::from(values[(row * width + column) as usize]);
                }
            }
            rest -= 255 * points.len() as u32;
            // Even with full scores of the rest, the square will not be expanded.
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
    fn the_best_pose_is_the_global_maximum() {
        for seed in 0..4 {
            let points = scattered(seed);
            let field = ScoreField::new(&points, [0.0, 0.0], &FieldSettings::default());
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
            // Exhaustive search.
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
                                // As in the search: cells first, then whole cells of translation.
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
        let field = ScoreField::new(&points, [0.0, 0.0], &FieldSettings::default());
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
