//! Matching of a scan against the map of a particle.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::{Point, Symmetric3};

use super::cells::Cells;
use super::settings::GmappingSettings;

/// Prior of a pose: the pose, and standard deviations of position \[m\] and heading \[rad\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    pub(super) map_from_base: Pose2,
    pub(super) sigma_m: f64,
    pub(super) sigma_rad: f64,
    /// Covariance of the front end's motion, along the axes of its start; `None` if unknown.
    pub(super) front: Option<Symmetric3>,
    /// Heading of the robot there \[rad\].
    pub(super) began_rad: f64,
    /// Slowly varying errors in standard deviations, along the same axes.
    pub(super) lasting: [f64; 3],
}

/// A point of the scan and what the map has near it.
#[derive(Clone, Copy)]
struct Pair {
    /// The point as seen from the base, in the directions of the map \[m\].
    arm: [f64; 2],
    /// From the map's point to it \[m\].
    off: [f64; 2],
    /// Direction in which that counts; 0 when it counts in all.
    normal: [f64; 2],
}

/// Match of a scan at a pose.
pub(super) struct Fit {
    pub(super) map_from_base: Pose2,
    /// Number of points, and what the map has near them.
    points: usize,
    pairs: Vec<Pair>,
}

/// Steps with a wider kernel that come before the others, and how much wider it is.
const WIDE_STEPS: usize = 3;
const WIDER_FACTOR: usize = 2;
/// No step is longer \[m, rad\], and a shorter one is the last.
const MAX_STEP_M_RAD: [f64; 2] = [0.1, 0.06];
const MIN_STEP_M_RAD: [f64; 2] = [2e-4, 1e-4];
/// Cost of a beam without a match: that of one this many times `lsigma` away.
const UNMATCHED_FACTOR: f64 = 0.5;

/// Moves a scan to where it fits best near a guess: least squares with weights, from each point along
/// its normal to the nearest of the map's (Gauss and Newton; the weights are those of the score
/// `sum exp(-d^2 / sigma)`, which thereby grows).
pub(super) fn climb(
    cells: &Cells,
    points: &[Point],
    guess: &Guess,
    settings: &GmappingSettings,
) -> Fit {
    let mut pose = guess.map_from_base;
    let prior = [1.0 / (guess.sigma_m * guess.sigma_m), 1.0 / (guess.sigma_rad * guess.sigma_rad)];
    let kernel = settings.kernel_cells;
    let mut pairs = Vec::with_capacity(points.len());
    for step in 0..WIDE_STEPS + settings.steps {
        let is_wide = step < WIDE_STEPS;
        let reach = if is_wide { kernel + WIDER_FACTOR } else { kernel };
        find(cells, points, pose, reach, &mut pairs);
        let mut information = Symmetric3::diagonal(prior[0], prior[0], prior[1]);
        let mut pull = [
            prior[0] * (pose.x_m - guess.map_from_base.x_m),
            prior[0] * (pose.y_m - guess.map_from_base.y_m),
            prior[1] * normalize_angle(pose.yaw_rad - guess.map_from_base.yaw_rad),
        ];
        for pair in &pairs {
            pair.add(settings, &mut information, &mut pull);
        }
        let Some(change) = information.solve(pull) else { break };
        let bound = |change: f64, most: f64| change.clamp(-most, most);
        let change = [
            bound(change[0], MAX_STEP_M_RAD[0]),
            bound(change[1], MAX_STEP_M_RAD[0]),
            bound(change[2], MAX_STEP_M_RAD[1]),
        ];
        pose = Pose2::new(
            pose.x_m - change[0],
            pose.y_m - change[1],
            normalize_angle(pose.yaw_rad - change[2]),
        );
        let is_settled = change[0].abs() + change[1].abs() < MIN_STEP_M_RAD[0]
            && change[2].abs() < MIN_STEP_M_RAD[1];
        if is_settled && !is_wide {
            break;
        }
    }
    find(cells, points, pose, kernel, &mut pairs);
    Fit { map_from_base: pose, points: points.len(), pairs }
}

/// Finds what the map has near each point.
fn find(cells: &Cells, points: &[Point], pose: Pose2, kernel: usize, pairs: &mut Vec<Pair>) {
    pairs.clear();
    let (s, c) = libm::sincos(pose.yaw_rad);
    let (per_m, side_m) = (cells.per_m(), cells.resolution_m());
    let (x, y) = (pose.x_m * per_m, pose.y_m * per_m);
    for point in points {
        let (px, py) = (f64::from(point.x), f64::from(point.y));
        let arm = [c * px - s * py, s * px + c * py];
        let near = cells.nearest(arm[0] * per_m + x, arm[1] * per_m + y, kernel as i32);
        let Some(off) = near else { continue };
        let (nx, ny) = (f64::from(point.nx), f64::from(point.ny));
        let normal = [c * nx - s * ny, s * nx + c * ny];
        pairs.push(Pair { arm, off: off.map(|it| it * side_m), normal });
    }
}

impl Pair {
    fn is_on_line(&self) -> bool {
        self.normal != [0.0; 2]
    }

    /// Adds the gradient and the information of this match.
    #[inline]
    fn add(&self, settings: &GmappingSettings, information: &mut Symmetric3, pull: &mut [f64; 3]) {
        let squared = self.off[0] * self.off[0] + self.off[1] * self.off[1];
        // Twice, as that of a normal distribution with the same exponent.
        let weight =
            2.0 / settings.likelihood_sigma_m2 * libm::exp(-squared / settings.match_sigma_m2);
        let mut along = |[nx, ny]: [f64; 2]| {
            let turn = nx * -self.arm[1] + ny * self.arm[0];
            let off = nx * self.off[0] + ny * self.off[1];
            information.add_outer([nx, ny, turn], weight);
            pull[0] += weight * nx * off;
            pull[1] += weight * ny * off;
            pull[2] += weight * turn * off;
        };
        if self.is_on_line() {
            along(self.normal);
        } else {
            along([1.0, 0.0]);
            along([0.0, 1.0]);
        }
    }

    /// Squared distance when the scan is shifted and turned a little \[m^2\].
    #[inline]
    fn squared(&self, shift: [f64; 3]) -> f64 {
        let x = self.off[0] + shift[0] - shift[2] * self.arm[1];
        let y = self.off[1] + shift[1] + shift[2] * self.arm[0];
        if self.is_on_line() {
            let off = self.normal[0] * x + self.normal[1] * y;
            off * off
        } else {
            x * x + y * y
        }
    }
}

impl Fit {
    /// Sum of the scores of the points, at most one each.
    pub(super) fn score(&self, settings: &GmappingSettings) -> f64 {
        let one = |pair: &Pair| libm::exp(-pair.squared([0.0; 3]) / settings.match_sigma_m2);
        self.pairs.iter().map(one).sum()
    }

    /// Information of the points about the pose.
    pub(super) fn information(&self, settings: &GmappingSettings) -> Symmetric3 {
        let mut information = Symmetric3::ZERO;
        let mut pull = [0.0; 3];
        for pair in &self.pairs {
            pair.add(settings, &mut information, &mut pull);
        }
        information
    }

    /// Part of the points that the map has something near.
    pub(super) fn matched(&self) -> f64 {
        self.pairs.len() as f64 / self.points.max(1) as f64
    }

    /// Logarithm of how likely the scan is when the robot is shifted and turned a little.
    pub(super) fn likelihood(&self, shift: [f64; 3], settings: &GmappingSettings) -> f64 {
        let most = UNMATCHED_FACTOR * settings.likelihood_sigma_m2;
        let near: f64 = self.pairs.iter().map(|pair| pair.squared(shift).min(most)).sum();
        let lost = (self.points - self.pairs.len()) as f64;
        -(near + lost * most) / settings.likelihood_sigma_m2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square room of 4 m around the origin, seen from its middle.
    fn room() -> (Cells, Vec<Point>) {
        let mut points = Vec::new();
        for side in 0..4_i8 {
            let (s, c) = libm::sincos(f64::from(side) * std::f64::consts::FRAC_PI_2);
            for along in -19..=19_i8 {
                let (x, y) = (1.98, 0.1 * f64::from(along));
                points.push(Point {
                    x: (c * x - s * y) as f32,
                    y: (s * x + c * y) as f32,
                    nx: -c as f32,
                    ny: -s as f32,
                });
            }
        }
        (Cells::of_points(&points), points)
    }

    fn guess(x_m: f64, y_m: f64, yaw_rad: f64) -> Guess {
        Guess {
            map_from_base: Pose2::new(x_m, y_m, yaw_rad),
            sigma_m: 10.0,
            sigma_rad: 10.0,
            front: None,
            began_rad: 0.0,
            lasting: [0.0; 3],
        }
    }

    #[test]
    fn a_scan_climbs_to_where_it_was_taken() {
        let (cells, points) = room();
        let settings = GmappingSettings::default();
        for start in [guess(0.06, -0.05, 0.03), guess(-0.08, 0.02, -0.03), guess(0.0, 0.0, 0.0)] {
            let fit = climb(&cells, &points, &start, &settings);
            let found = fit.map_from_base;
            assert!(found.x_m.abs() < 2e-3 && found.y_m.abs() < 2e-3, "{found:?}");
            assert!(found.yaw_rad.abs() < 1e-3, "{found:?}");
            assert_eq!(fit.matched(), 1.0);
            // Every one of the points counts almost 1.
            assert!(fit.score(&settings) > 0.99 * points.len() as f64);
        }
    }

    #[test]
    fn likelihood_is_what_the_formula_says() {
        let (cells, points) = room();
        let settings = GmappingSettings::default();
        let fit = climb(&cells, &points, &guess(0.0, 0.0, 0.0), &settings);
        // Shifted by 1 cm along x, the 78 points on two walls are off by 1 cm, the others by nothing.
        let off = fit.likelihood([0.01, 0.0, 0.0], &settings) - fit.likelihood([0.0; 3], &settings);
        let expected = -78.0 * 0.01 * 0.01 / settings.likelihood_sigma_m2;
        assert!((off - expected).abs() < 0.05 * expected.abs(), "{off} {expected}");
        // Where the map is empty, each point counts a half.
        let lost = climb(&cells, &points, &guess(30.0, 0.0, 0.0), &settings);
        assert_eq!(lost.matched(), 0.0);
        assert_eq!(lost.likelihood([0.0; 3], &settings), -0.5 * points.len() as f64);
    }
}
