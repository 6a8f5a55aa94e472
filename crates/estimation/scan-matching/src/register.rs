//! Local registration of clouds from a good initial pose.

use periplus_geometry::{Pose2, normalize_angle};

use crate::cloud::Cloud;
use crate::symmetric::Symmetric3;

/// Cloud with its pose in a rigid group.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// Cloud.
    pub cloud: &'a Cloud,
    /// Pose of the cloud in the group frame.
    pub group_from_cloud: Pose2,
}

impl<'a> Placed<'a> {
    /// Creates a group of one cloud.
    #[must_use]
    pub fn alone(cloud: &'a Cloud) -> Self {
        Self { cloud, group_from_cloud: Pose2::IDENTITY }
    }
}

/// Prior of the pose.
#[derive(Clone, Copy, Debug)]
pub struct Prior {
    /// Expected pose.
    pub target_from_moving: Pose2,
    /// Information matrix of the prior.
    pub information: Symmetric3,
}

/// Settings of a registration.
#[derive(Clone, Copy, Debug)]
pub struct RegisterSettings {
    /// Maximum distance of correspondences \[m\]: at the start, at the end.
    pub reach_m: [f32; 2],
    /// Scale of the robust kernel \[m\]: at the start, at the end. The influence of a residual is
    /// greatest at 0.58 of it.
    pub scale_m: [f32; 2],
    /// Number of Gauss-Newton iterations.
    pub steps: usize,
    /// Standard deviation of the distance of a point from its line \[m\], for the information.
    pub sigma_m: f64,
    /// Fraction of the points that count as independent, since the errors of adjacent beams are
    /// correlated.
    pub independent: f64,
    /// Ratio of the information along the weakest direction to that along the strongest below which
    /// the weakest one is attributed to the roughness of walls and dropped.
    pub degenerate: f64,
}

impl Default for RegisterSettings {
    fn default() -> Self {
        Self {
            reach_m: [0.5, 0.2],
            scale_m: [0.3, 0.1],
            steps: 8,
            sigma_m: 0.03,
            independent: 0.2,
            degenerate: 0.02,
        }
    }
}

/// Result of a registration.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// Registered pose.
    pub target_from_moving: Pose2,
    /// Information from the points, without the prior. Errors are a translation along the axes of
    /// the target and a rotation about the origin of the moving cloud.
    pub information: Symmetric3,
    /// Fraction of the points with a correspondence.
    pub matched: f64,
    /// Weighted root mean square distance of matched points from their lines \[m\].
    pub rms_m: f64,
    /// Robust cost over all points and the prior, in squared standard deviations: comparable
    /// between initial poses of the same clouds.
    pub cost: f64,
    /// Observability: 0 if the points leave some direction undetermined, 1 if they determine all.
    pub firmness: f64,
}

/// Registers a group of clouds with another group: robust point-to-line ICP. The residual of a
/// point is its distance from the line through the nearest point of each reference, or from that
/// point where no line is known. The kernel (Geman-McClure) narrows from iteration to iteration.
/// Surfaces with opposite normals are two sides of a wall, and no correspondences.
#[must_use]
pub fn register(
    moving: &[Placed<'_>],
    target: &[Placed<'_>],
    start: Pose2,
    prior: Option<&Prior>,
    settings: &RegisterSettings,
) -> Fit {
    let frames: Vec<Frame<'_>> = target.iter().map(Frame::new).collect();
    let mut pose = start;
    let steps = settings.steps.max(1);
    for step in 0..steps {
        let (reach_m, scale_m) = schedule(settings, step, steps);
        // The first iterations need less accuracy.
        let every = if 2 * step < steps { 2 } else { 1 };
        let mut sums = Sums::collect(moving, &frames, pose, reach_m, scale_m, every);
        sums.weigh(settings);
        let mut information = sums.information;
        let mut gradient = sums.gradient;
        if let Some(prior) = prior {
            let error = difference(pose, prior.target_from_moving);
            let pull = prior.information.times(error);
            information += prior.information;
            for (sum, part) in gradient.iter_mut().zip(pull) {
                *sum += part;
            }
        }
        // Keeps the step finite where nothing is determined.
        information += Symmetric3::diagonal(1e-3, 1e-3, 1e-3);
        let Some(change) = information.solve(gradient) else { break };
        pose = Pose2::new(
            pose.x_m - change[0].clamp(-0.5, 0.5),
            pose.y_m - change[1].clamp(-0.5, 0.5),
            normalize_angle(pose.yaw_rad - change[2].clamp(-0.3, 0.3)),
        );
        let has_converged =
            change[0].abs() + change[1].abs() < MIN_STEP_M && change[2].abs() < MIN_STEP_RAD;
        if has_converged && every == 1 {
            break;
        }
    }
    let [_, reach_m] = settings.reach_m;
    let [_, scale_m] = settings.scale_m;
    let mut sums = Sums::collect(moving, &frames, pose, reach_m, scale_m, 1);
    sums.probe(moving, &frames, pose, settings);
    sums.weigh(settings);
    let from_prior = prior.map_or(0.0, |prior| {
        prior.information.quadratic(difference(pose, prior.target_from_moving))
    });
    Fit {
        target_from_moving: pose,
        information: sums.information,
        matched: sums.matched / sums.count.max(1.0),
        rms_m: (sums.squares / sums.weights.max(1e-9)).sqrt(),
        cost: sums.cost + from_prior,
        firmness: sums.firmness,
    }
}

fn schedule(settings: &RegisterSettings, step: usize, steps: usize) -> (f32, f32) {
    // The second half of the iterations uses the final values.
    let part = (2.0 * step as f32 / steps as f32).min(1.0);
    let between = |[from, to]: [f32; 2]| from + (to - from) * part;
    (between(settings.reach_m), between(settings.scale_m))
}

/// Translation along the parent's axes and rotation from `from` to `to`.
fn difference(to: Pose2, from: Pose2) -> [f64; 3] {
    [to.x_m - from.x_m, to.y_m - from.y_m, normalize_angle(to.yaw_rad - from.yaw_rad)]
}

/// Reference cloud with its rotation.
struct Frame<'a> {
    cloud: &'a Cloud,
    cloud_from_target: Pose2,
    sine: f64,
    cosine: f64,
}

impl<'a> Frame<'a> {
    fn new(placed: &Placed<'a>) -> Self {
        let (sine, cosine) = libm::sincos(placed.group_from_cloud.yaw_rad);
        let cloud_from_target = placed.group_from_cloud.inverse();
        Self { cloud: placed.cloud, cloud_from_target, sine, cosine }
    }
}

/// Correspondence of a point.
struct Correspondence {
    /// Normal of the line in the target frame; for a point, the offset from it.
    x: f64,
    y: f64,
    /// Distance from the line \[m\].
    error: f64,
    is_line: bool,
}

#[derive(Default)]
struct Sums {
    information: Symmetric3,
    gradient: [f64; 3],
    count: f64,
    matched: f64,
    squares: f64,
    weights: f64,
    cost: f64,
    firmness: f64,
}

/// Shift of a result to measure its resistance \[m\], and the ratio of the weakest to the strongest
/// information below which this is done.
const PROBE_M: f64 = 0.1;
const MAX_PROBED_RATIO: f64 = 0.3;
/// Step below which the iteration ends.
const MIN_STEP_M: f64 = 3e-4;
const MIN_STEP_RAD: f64 = 1e-4;
/// Minimum cosine between normals of a correspondence: 60 degrees.
const MIN_NORMAL_COSINE_RATIO: f32 = 0.5;
/// Weight of a point-to-point residual: the point may be anywhere on its surface.
const POINT_WEIGHT_FACTOR: f64 = 0.3;

impl Sums {
    fn collect(
        moving: &[Placed<'_>],
        frames: &[Frame<'_>],
        pose: Pose2,
        reach_m: f32,
        scale_m: f32,
        every: usize,
    ) -> Self {
        let mut sums = Self::default();
        for placed in moving {
            sums.collect_one(placed, frames, pose, [reach_m, scale_m], every);
        }
        sums
    }

    fn collect_one(
        &mut self,
        moving: &Placed<'_>,
        frames: &[Frame<'_>],
        target_from_group: Pose2,
        [reach_m, scale_m]: [f32; 2],
        every: usize,
    ) {
        let sums = self;
        let pose = target_from_group * moving.group_from_cloud;
        let (target_sine, target_cosine) = libm::sincos(pose.yaw_rad);
        // Lever arm from the origin of the group to that of the cloud, in the target frame.
        let lever = [pose.x_m - target_from_group.x_m, pose.y_m - target_from_group.y_m];
        let scale = f64::from(scale_m) * f64::from(scale_m);
        // Pose of the moving cloud in each reference.
        let placed: Vec<(f32, f32, f32, f32)> = frames
            .iter()
            .map(|frame| {
                let place = frame.cloud_from_target * pose;
                let (sine, cosine) = libm::sincos(place.yaw_rad);
                (place.x_m as f32, place.y_m as f32, sine as f32, cosine as f32)
            })
            .collect();
        let mut correspondences: Vec<Correspondence> = Vec::with_capacity(frames.len());
        for point in moving.cloud.points().iter().step_by(every) {
            correspondences.clear();
            // Lever arm from the origin of the moving group to the point, in the target frame.
            let (along, across) = (f64::from(point.x), f64::from(point.y));
            let arm_x = target_cosine * along - target_sine * across + lever[0];
            let arm_y = target_sine * along + target_cosine * across + lever[1];
            for (frame, &(x_m, y_m, sine, cosine)) in frames.iter().zip(&placed) {
                let x = cosine * point.x - sine * point.y + x_m;
                let y = sine * point.x + cosine * point.y + y_m;
                let Some((index, _)) = frame.cloud.nearest(x, y, reach_m) else { continue };
                let correspondence = frame.cloud.points()[index];
                let is_line = correspondence.is_on_line();
                if is_line && point.is_on_line() {
                    let nx = cosine * point.nx - sine * point.ny;
                    let ny = sine * point.nx + cosine * point.ny;
                    if nx * correspondence.nx + ny * correspondence.ny < MIN_NORMAL_COSINE_RATIO {
                        continue;
                    }
                }
                let (dx, dy) = (f64::from(x - correspondence.x), f64::from(y - correspondence.y));
                let (u, v, error) = if is_line {
                    let (nx, ny) = (f64::from(correspondence.nx), f64::from(correspondence.ny));
                    (nx, ny, nx * dx + ny * dy)
                } else {
                    (dx, dy, 0.0)
                };
                correspondences.push(Correspondence {
                    x: frame.cosine * u - frame.sine * v,
                    y: frame.sine * u + frame.cosine * v,
                    error,
                    is_line,
                });
            }
            sums.count += 1.0;
            if correspondences.is_empty() {
                // Cost of a correspondence at infinity.
                sums.cost += scale;
                continue;
            }
            sums.matched += 1.0;
            let share = 1.0 / correspondences.len() as f64;
            for correspondence in &correspondences {
                if correspondence.is_line {
                    let (nx, ny, error) =
                        (correspondence.x, correspondence.y, correspondence.error);
                    // Geman-McClure: rho = e² s / (s + e²), with weight (s / (s + e²))².
                    let shrink = scale / (scale + error * error);
                    sums.cost += share * error * error * shrink;
                    let row = [nx, ny, ny * arm_x - nx * arm_y];
                    sums.push(row, error, share * shrink * shrink);
                } else {
                    // One weight for both components, by the distance.
                    let squared =
                        correspondence.x * correspondence.x + correspondence.y * correspondence.y;
                    let shrink = scale / (scale + squared);
                    let weight = POINT_WEIGHT_FACTOR * share * shrink * shrink;
                    sums.push([1.0, 0.0, -arm_y], correspondence.x, weight);
                    sums.push([0.0, 1.0, arm_x], correspondence.y, weight);
                    sums.cost += POINT_WEIGHT_FACTOR * share * squared * shrink;
                }
            }
        }
    }

    fn push(&mut self, row: [f64; 3], error: f64, weight: f64) {
        self.information.add_outer(row, weight);
        for (sum, part) in self.gradient.iter_mut().zip(row) {
            *sum += weight * part * error;
        }
        self.squares += weight * error * error;
        self.weights += weight;
    }

    /// Reduces the information along the weakest direction to the measured resistance to a shift.
    /// Rough walls, and correspondences that move along with a point, make derivatives overestimate
    /// it; the cost after a real shift does not (Olson 2009 takes covariances from such responses).
    fn probe(
        &mut self,
        moving: &[Placed<'_>],
        frames: &[Frame<'_>],
        pose: Pose2,
        settings: &RegisterSettings,
    ) {
        let (low, high, [u, v]) = self.information.weakest_shift();
        if low <= 0.0 || low > MAX_PROBED_RATIO * high {
            return;
        }
        let turn = self.turn_along(u, v);
        let mut resistance = f64::MAX;
        for side in [-PROBE_M, PROBE_M] {
            let shifted =
                Pose2::new(pose.x_m + side * u, pose.y_m + side * v, pose.yaw_rad + side * turn);
            let (reach_m, scale_m) = (settings.reach_m[1], settings.scale_m[1]);
            let there = Sums::collect(moving, frames, shifted, reach_m, scale_m, 1);
            resistance = resistance.min(2.0 * (there.cost - self.cost) / (PROBE_M * PROBE_M));
        }
        let less = (low - resistance.max(0.0)).clamp(0.0, low);
        self.information.add_outer([u, v, 0.0], -less);
    }

    /// Rotation that accompanies a shift along the weakest direction.
    fn turn_along(&self, u: f64, v: f64) -> f64 {
        let Symmetric3 { xt, yt, tt, .. } = self.information;
        if tt > 0.0 { -(xt * u + yt * v) / tt } else { 0.0 }
    }

    /// Scales sums over points to units of standard deviations and drops information that stems
    /// from the roughness of walls.
    fn weigh(&mut self, settings: &RegisterSettings) {
        let weight = settings.independent / (settings.sigma_m * settings.sigma_m);
        self.information = self.information * weight;
        self.cost *= weight;
        for sum in &mut self.gradient {
            *sum *= weight;
        }
        let (low, high, [u, v]) = self.information.weakest_shift();
        let ratio = if high > 0.0 { low / high } else { 0.0 };
        // 0 at the bound, 1 at twice the bound.
        self.firmness = (ratio / settings.degenerate.max(1e-9) - 1.0).clamp(0.0, 1.0);
        if self.firmness < 1.0 {
            // A shift along (u, v) with its rotation is the direction of least resistance: the
            // information maps it to low times (u, v, 0).
            let turn = self.turn_along(u, v);
            let along = self.gradient[0] * u + self.gradient[1] * v + self.gradient[2] * turn;
            let part = 1.0 - self.firmness;
            self.information.add_outer([u, v, 0.0], -part * low);
            self.gradient[0] -= part * along * u;
            self.gradient[1] -= part * along * v;
        }
    }
}

/// Symmetric comparison of two clouds at a pose: one least-squares step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Comparison {
    /// Information about the pose of the moving cloud. Errors are a translation along the axes of
    /// the target and a rotation about the origin of the moving cloud.
    pub information: Symmetric3,
    /// Pose of the best fit, to first order.
    pub target_from_moving: Pose2,
    /// Fraction of the points with a correspondence, in both directions.
    pub matched: f64,
}

/// Compares two clouds at a pose: every `every`-th point of each with the lines of the other.
#[must_use]
pub fn compare(
    moving: &Cloud,
    target: &Cloud,
    target_from_moving: Pose2,
    reach_m: f32,
    scale_m: f32,
    every: usize,
    settings: &RegisterSettings,
) -> Comparison {
    let (moving, target) = (Placed::alone(moving), Placed::alone(target));
    let there = Frame::new(&target);
    let mut sums = Sums::collect(&[moving], &[there], target_from_moving, reach_m, scale_m, every);
    let back = Frame::new(&moving);
    let moving_from_target = target_from_moving.inverse();
    let other = Sums::collect(&[target], &[back], moving_from_target, reach_m, scale_m, every);
    // The reverse direction is in terms of `moving_from_target` q = (u, phi) with t = -R(-phi) u.
    // To first order, a change (du, dphi) of it is dt = -R du - perp(t) dphi and dtheta = -dphi.
    // Its information is transformed with the inverse of that: du = -R^T (dt - perp(t) dtheta).
    let (sine, cosine) = libm::sincos(target_from_moving.yaw_rad);
    let (x, y) = (target_from_moving.x_m, target_from_moving.y_m);
    let columns = [
        [-cosine, -sine, cosine * -y + sine * x],
        [sine, -cosine, -sine * -y + cosine * x],
        [0.0, 0.0, -1.0],
    ];
    sums.information += transformed(&other.information, &columns);
    for (i, sum) in sums.gradient.iter_mut().enumerate() {
        *sum += (0..3).map(|k| columns[k][i] * other.gradient[k]).sum::<f64>();
    }
    sums.weigh(settings);
    let points = sums.count + other.count;
    let matched = (sums.matched + other.matched) / points.max(1.0);
    let information = sums.information + Symmetric3::diagonal(1e-3, 1e-3, 1e-3);
    let change = information.solve(sums.gradient).unwrap_or_default();
    Comparison {
        // Both directions count the same surfaces.
        information: sums.information * 0.5,
        target_from_moving: Pose2::new(
            x - change[0].clamp(-0.2, 0.2),
            y - change[1].clamp(-0.2, 0.2),
            normalize_angle(target_from_moving.yaw_rad - change[2].clamp(-0.1, 0.1)),
        ),
        matched,
    }
}

/// `columns`ᵀ · m · `columns`.
fn transformed(m: &Symmetric3, columns: &[[f64; 3]; 3]) -> Symmetric3 {
    let full = [[m.xx, m.xy, m.xt], [m.xy, m.yy, m.yt], [m.xt, m.yt, m.tt]];
    let entry = |i: usize, j: usize| {
        let mut sum = 0.0;
        for (a, row) in full.iter().enumerate() {
            for (b, value) in row.iter().enumerate() {
                sum += columns[a][i] * value * columns[b][j];
            }
        }
        sum
    };
    Symmetric3 {
        xx: entry(0, 0),
        xy: entry(0, 1),
        xt: entry(0, 2),
        yy: entry(1, 1),
        yt: entry(1, 2),
        tt: entry(2, 2),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::CloudSettings;

    /// Scan of a rectangular room from a pose in it.
    fn room(from: Pose2, beams: usize) -> Cloud {
        let step = std::f64::consts::TAU / beams as f64;
        let ends = (0..beams).map(|i| {
            let angle = i as f64 * step;
            let (s, c) = libm::sincos(angle + from.yaw_rad);
            let x = if c > 0.0 { (4.0 - from.x_m) / c } else { (-3.0 - from.x_m) / c };
            let y = if s > 0.0 { (2.0 - from.y_m) / s } else { (-2.5 - from.y_m) / s };
            let range = x.min(y);
            let (s, c) = libm::sincos(angle);
            Some([(range * c) as f32, (range * s) as f32])
        });
        Cloud::new(ends, [0.0, 0.0], step as f32, &CloudSettings::default())
    }

    fn near(a: Pose2, b: Pose2, metres: f64, radians: f64) -> bool {
        let [x, y, t] = difference(a, b);
        x.abs() < metres && y.abs() < metres && t.abs() < radians
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn a_scan_is_registered(x in -0.25..0.25_f64, y in -0.25..0.25_f64, yaw in -0.15..0.15_f64) {
            let truth = Pose2::new(x, y, yaw);
            let (first, second) = (room(Pose2::IDENTITY, 360), room(truth, 360));
            let fit = register(
                &[Placed::alone(&second)], &[Placed::alone(&first)], Pose2::IDENTITY, None,
                &RegisterSettings { steps: 14, ..RegisterSettings::default() },
            );
            prop_assert!(near(fit.target_from_moving, truth, 5e-3, 2e-3), "{fit:?}");
            prop_assert!(fit.matched > 0.95 && fit.firmness == 1.0);
        }

        #[test]
        fn both_directions_agree(x in -0.04..0.04_f64, y in -0.04..0.04_f64, yaw in -0.02..0.02_f64) {
            let truth = Pose2::new(x, y, yaw);
            let (first, second) = (room(Pose2::IDENTITY, 360), room(truth, 360));
            let mut pose = Pose2::IDENTITY;
            for _ in 0..4 {
                let both = compare(&second, &first, pose, 0.3, 0.2, 1, &RegisterSettings::default());
                pose = both.target_from_moving;
            }
            prop_assert!(near(pose, truth, 5e-3, 2e-3), "{pose:?} {truth:?}");
        }
    }

    #[test]
    fn a_corridor_is_determined_across_but_not_along() {
        let beams = |shift: f32| {
            (0..360).map(move |i| {
                let (s, c) =
                    (libm::sinf((i as f32).to_radians()), libm::cosf((i as f32).to_radians()));
                // No returns from the far ends.
                let range = if s > 0.0 { (1.0 - shift) / s } else { (-1.2 - shift) / s };
                (range < 9.0).then_some([range * c, range * s])
            })
        };
        let cloud = |shift| {
            Cloud::new(beams(shift), [0.0; 2], 1f32.to_radians(), &CloudSettings::default())
        };
        let (first, second) = (cloud(0.0), cloud(0.1));
        let prior = Prior {
            target_from_moving: Pose2::new(0.3, 0.0, 0.0),
            information: Symmetric3::diagonal(100.0, 100.0, 400.0),
        };
        let fit = register(
            &[Placed::alone(&second)],
            &[Placed::alone(&first)],
            prior.target_from_moving,
            Some(&prior),
            &RegisterSettings::default(),
        );
        assert!(near(fit.target_from_moving, Pose2::new(0.3, 0.1, 0.0), 0.01, 0.005), "{fit:?}");
        assert!(fit.firmness < 0.1, "{fit:?}");
    }
}
