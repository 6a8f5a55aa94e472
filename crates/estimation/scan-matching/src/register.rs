//! Registration of a cloud onto others, from a good start.

use periplus_geometry::{Pose2, normalize_angle};

use crate::cloud::Cloud;
use crate::symmetric::Symmetric3;

/// A cloud in a group that is rigid.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// Its points.
    pub cloud: &'a Cloud,
    /// Where they are in the frame of the group.
    pub group_from_cloud: Pose2,
}

impl<'a> Placed<'a> {
    /// A cloud that is a group of its own.
    #[must_use]
    pub fn alone(cloud: &'a Cloud) -> Self {
        Self { cloud, group_from_cloud: Pose2::IDENTITY }
    }
}

/// What is known of the pose from elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct Prior {
    /// The pose that is expected.
    pub target_from_moving: Pose2,
    /// How surely.
    pub information: Symmetric3,
}

/// How a registration runs.
#[derive(Clone, Copy, Debug)]
pub struct RegisterSettings {
    /// Points farther from their nearest than this have no partner \[m\]: at the start, at the end.
    pub reach_m: [f32; 2],
    /// Where the pull of a residual is greatest is at 0.58 of this \[m\]: at the start, at the end.
    pub scale_m: [f32; 2],
    /// Steps of Gauss and Newton.
    pub steps: usize,
    /// Standard deviation of a point from the line \[m\], for the information.
    pub sigma_m: f64,
    /// Neighbouring beams err alike: this part of the points counts as independent.
    pub independent: f64,
    /// Where the information along the weakest direction is less than this part of that along the
    /// strongest, it is taken for the roughness of walls, and nothing is known along it.
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

/// What came of a registration.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// Where the cloud fits best.
    pub target_from_moving: Pose2,
    /// What the points say, without the prior; errors are a shift along the target's axes and a turn
    /// about the origin of the moving cloud.
    pub information: Symmetric3,
    /// The part of the points that found a partner.
    pub matched: f64,
    /// How far matched points are from their lines, root mean square, weighted \[m\].
    pub rms_m: f64,
    /// Robust sum over all points, and the prior, in squared standard deviations: to compare fits of
    /// the same clouds from different starts.
    pub cost: f64,
    /// 0 where the points tell nothing along some direction, 1 where they tell enough along all.
    pub firmness: f64,
}

/// Moves a group of clouds onto another group: each point towards the line through the nearest point of each
/// reference (or the point itself, where no line is clear), least squares with the weights of Geman
/// and McClure, whose width shrinks from step to step. Surfaces that face away from each other are
/// the two sides of a wall, and no partners.
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
    let mut pairs = Pairs::default();
    let steps = settings.steps.max(1);
    for step in 0..steps {
        let (reach_m, scale_m) = schedule(settings, step, steps);
        // The first steps need not be exact.
        let every = if 2 * step < steps { 2 } else { 1 };
        pairs.begin(pose, reach_m, every);
        let mut sums = Sums::collect(moving, &frames, pose, reach_m, scale_m, every, &mut pairs);
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
        // So that a step is finite where nothing at all is known.
        information += Symmetric3::diagonal(1e-3, 1e-3, 1e-3);
        let Some(change) = information.solve(gradient) else { break };
        pose = Pose2::new(
            pose.x_m - change[0].clamp(-0.5, 0.5),
            pose.y_m - change[1].clamp(-0.5, 0.5),
            normalize_angle(pose.yaw_rad - change[2].clamp(-0.3, 0.3)),
        );
        let is_settled =
            change[0].abs() + change[1].abs() < SETTLED_M && change[2].abs() < SETTLED_RAD;
        if is_settled && every == 1 {
            break;
        }
    }
    let [_, reach_m] = settings.reach_m;
    let [_, scale_m] = settings.scale_m;
    pairs.begin(pose, reach_m, 1);
    let mut sums = Sums::collect(moving, &frames, pose, reach_m, scale_m, 1, &mut pairs);
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
    // The second half of the steps is at the final width.
    let part = (2.0 * step as f32 / steps as f32).min(1.0);
    let between = |[from, to]: [f32; 2]| from + (to - from) * part;
    (between(settings.reach_m), between(settings.scale_m))
}

/// Shift along the parent's axes and turn from `from` to `to`.
fn difference(to: Pose2, from: Pose2) -> [f64; 3] {
    [to.x_m - from.x_m, to.y_m - from.y_m, normalize_angle(to.yaw_rad - from.yaw_rad)]
}

/// A reference with its sine and cosine.
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

/// Nearest points of the references, kept while the pose hardly changes: the search for them is most of the
/// work of a step.
#[derive(Default)]
struct Pairs {
    /// Of each moving point in turn, the index of the nearest point of each reference, if one is within reach.
    nearest: Vec<Option<u32>>,
    /// Pose, reach and step between points that they were searched with.
    of: Option<(Pose2, f32, usize)>,
    /// Pair to be used next; none where they are to be searched.
    next: Option<usize>,
}

/// Nearest points are searched again when the pose has changed by more \[m, rad\].
const PAIRED_M: f64 = 2e-3;
const PAIRED_RAD: f64 = 1e-3;

impl Pairs {
    /// Prepares a pass over all points.
    fn begin(&mut self, pose: Pose2, reach_m: f32, every: usize) {
        let serve = |&(from, reach, step): &(Pose2, f32, usize)| {
            let [x_m, y_m, rad] = difference(pose, from);
            let is_near = x_m.abs() < PAIRED_M && y_m.abs() < PAIRED_M && rad.abs() < PAIRED_RAD;
            is_near && reach == reach_m && step == every
        };
        if self.of.as_ref().is_some_and(serve) {
            self.next = Some(0);
        } else {
            self.nearest.clear();
            (self.next, self.of) = (None, Some((pose, reach_m, every)));
        }
    }

    fn nearest(&mut self, cloud: &Cloud, x: f32, y: f32, reach_m: f32) -> Option<usize> {
        if let Some(next) = &mut self.next {
            *next += 1;
            return self.nearest[*next - 1].map(|index| index as usize);
        }
        let index = cloud.nearest(x, y, reach_m).map(|it| it.0);
        self.nearest.push(index.map(|index| index as u32));
        index
    }
}

/// What pulls at a point.
struct Partner {
    /// Normal of its line in the target; or where the point is from it.
    x: f64,
    y: f64,
    /// Distance from its line \[m\].
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

/// How far a fit is shifted to see what resists \[m\], and at which ratio of the information along
/// the weakest direction to that along the strongest this is asked.
const PROBE_M: f64 = 0.1;
const WEAK: f64 = 0.3;
/// A step that moves less is the last \[m, rad\].
const SETTLED_M: f64 = 3e-4;
const SETTLED_RAD: f64 = 1e-4;
/// Lines whose normals are farther apart than 60 degrees are not the same.
const ALIKE: f32 = 0.5;
/// A point without a line pulls as a point, but less: it may be anywhere along what it lies on.
const LOOSE: f64 = 0.3;

impl Sums {
    fn collect(
        moving: &[Placed<'_>],
        frames: &[Frame<'_>],
        pose: Pose2,
        reach_m: f32,
        scale_m: f32,
        every: usize,
        pairs: &mut Pairs,
    ) -> Self {
        let mut sums = Self::default();
        for placed in moving {
            sums.collect_one(placed, frames, pose, [reach_m, scale_m], every, pairs);
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
        pairs: &mut Pairs,
    ) {
        let sums = self;
        let pose = target_from_group * moving.group_from_cloud;
        let (target_sine, target_cosine) = libm::sincos(pose.yaw_rad);
        // From the origin of the group to that of the cloud, in the target.
        let lever = [pose.x_m - target_from_group.x_m, pose.y_m - target_from_group.y_m];
        let scale = f64::from(scale_m) * f64::from(scale_m);
        // The moving cloud in the frame of each reference.
        let placed: Vec<(f32, f32, f32, f32)> = frames
            .iter()
            .map(|frame| {
                let place = frame.cloud_from_target * pose;
                let (sine, cosine) = libm::sincos(place.yaw_rad);
                (place.x_m as f32, place.y_m as f32, sine as f32, cosine as f32)
            })
            .collect();
        let mut partners: Vec<Partner> = Vec::with_capacity(frames.len());
        for point in moving.cloud.points().iter().step_by(every) {
            partners.clear();
            // From the origin of the moving group to the point, in the target.
            let (along, across) = (f64::from(point.x), f64::from(point.y));
            let arm_x = target_cosine * along - target_sine * across + lever[0];
            let arm_y = target_sine * along + target_cosine * across + lever[1];
            for (frame, &(x_m, y_m, sine, cosine)) in frames.iter().zip(&placed) {
                let x = cosine * point.x - sine * point.y + x_m;
                let y = sine * point.x + cosine * point.y + y_m;
                let Some(index) = pairs.nearest(frame.cloud, x, y, reach_m) else { continue };
                let partner = frame.cloud.points()[index];
                let is_line = partner.is_on_line();
                if is_line && point.is_on_line() {
                    let nx = cosine * point.nx - sine * point.ny;
                    let ny = sine * point.nx + cosine * point.ny;
                    if nx * partner.nx + ny * partner.ny < ALIKE {
                        continue;
                    }
                }
                let (dx, dy) = (f64::from(x - partner.x), f64::from(y - partner.y));
                let (u, v, error) = if is_line {
                    let (nx, ny) = (f64::from(partner.nx), f64::from(partner.ny));
                    (nx, ny, nx * dx + ny * dy)
                } else {
                    (dx, dy, 0.0)
                };
                partners.push(Partner {
                    x: frame.cosine * u - frame.sine * v,
                    y: frame.sine * u + frame.cosine * v,
                    error,
                    is_line,
                });
            }
            sums.count += 1.0;
            if partners.is_empty() {
                // As much as a partner at infinity.
                sums.cost += scale;
                continue;
            }
            sums.matched += 1.0;
            let share = 1.0 / partners.len() as f64;
            for partner in &partners {
                if partner.is_line {
                    let (nx, ny, error) = (partner.x, partner.y, partner.error);
                    // Geman and McClure: rho = e² s / (s + e²), with weight (s / (s + e²))².
                    let shrink = scale / (scale + error * error);
                    sums.cost += share * error * error * shrink;
                    let row = [nx, ny, ny * arm_x - nx * arm_y];
                    sums.push(row, error, share * shrink * shrink);
                } else {
                    // One weight for both directions, by the whole distance.
                    let squared = partner.x * partner.x + partner.y * partner.y;
                    let shrink = scale / (scale + squared);
                    let weight = LOOSE * share * shrink * shrink;
                    sums.push([1.0, 0.0, -arm_y], partner.x, weight);
                    sums.push([0.0, 1.0, arm_x], partner.y, weight);
                    sums.cost += LOOSE * share * squared * shrink;
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

    /// What the points resist a shift along the weakest direction with, by doing it. Rough walls and
    /// partners that move along with a point make the derivatives claim more than there is: only the
    /// sums after a real shift tell (Olson 2009 takes covariances from such responses).
    fn probe(
        &mut self,
        moving: &[Placed<'_>],
        frames: &[Frame<'_>],
        pose: Pose2,
        settings: &RegisterSettings,
    ) {
        let (low, high, [u, v]) = self.information.weakest_shift();
        if low <= 0.0 || low > WEAK * high {
            return;
        }
        let turn = self.turn_along(u, v);
        let mut resistance = f64::MAX;
        for side in [-PROBE_M, PROBE_M] {
            let shifted =
                Pose2::new(pose.x_m + side * u, pose.y_m + side * v, pose.yaw_rad + side * turn);
            let (reach_m, scale_m) = (settings.reach_m[1], settings.scale_m[1]);
            let mut pairs = Pairs::default();
            let there = Sums::collect(moving, frames, shifted, reach_m, scale_m, 1, &mut pairs);
            resistance = resistance.min(2.0 * (there.cost - self.cost) / (PROBE_M * PROBE_M));
        }
        let less = (low - resistance.max(0.0)).clamp(0.0, low);
        self.information.add_outer([u, v, 0.0], -less);
    }

    /// The turn that goes with a shift along the weakest direction.
    fn turn_along(&self, u: f64, v: f64) -> f64 {
        let Symmetric3 { xt, yt, tt, .. } = self.information;
        if tt > 0.0 { -(xt * u + yt * v) / tt } else { 0.0 }
    }

    /// From sums over points to standard deviations, without what only walls' roughness says.
    fn weigh(&mut self, settings: &RegisterSettings) {
        let weight = settings.independent / (settings.sigma_m * settings.sigma_m);
        self.information = self.information * weight;
        self.cost *= weight;
        for sum in &mut self.gradient {
            *sum *= weight;
        }
        let (low, high, [u, v]) = self.information.weakest_shift();
        let ratio = if high > 0.0 { low / high } else { 0.0 };
        // From nothing at the bound to all at twice the bound.
        self.firmness = (ratio / settings.degenerate.max(1e-9) - 1.0).clamp(0.0, 1.0);
        if self.firmness < 1.0 {
            // Moving along (u, v), and turning as that asks for, is what the points resist least:
            // the information takes that direction to low times (u, v, 0).
            let turn = self.turn_along(u, v);
            let along = self.gradient[0] * u + self.gradient[1] * v + self.gradient[2] * turn;
            let part = 1.0 - self.firmness;
            self.information.add_outer([u, v, 0.0], -part * low);
            self.gradient[0] -= part * along * u;
            self.gradient[1] -= part * along * v;
        }
    }
}

/// What two clouds say about where one is in the other, both ways: the sums of a least-squares step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Comparison {
    /// The information about the pose of the moving cloud in the other; errors are a shift along the
    /// other's axes and a turn about the origin of the moving cloud.
    pub information: Symmetric3,
    /// The pose at which both fit best, to first order.
    pub target_from_moving: Pose2,
    /// Points that found partners among all, both ways.
    pub matched: f64,
}

/// Holds two clouds against each other at a pose: points of each (or one of `every`) against lines of
/// the other.
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
    let mut sums = Sums::collect(
        &[moving],
        &[there],
        target_from_moving,
        reach_m,
        scale_m,
        every,
        &mut Pairs::default(),
    );
    let back = Frame::new(&moving);
    let moving_from_target = target_from_moving.inverse();
    let other = Sums::collect(
        &[target],
        &[back],
        moving_from_target,
        reach_m,
        scale_m,
        every,
        &mut Pairs::default(),
    );
    // The other way speaks of `moving_from_target` q = (u, phi) with t = -R(-phi) u. To first order a
    // change (du, dphi) of it is dt = -R du - perp(t) dphi and dtheta = -dphi of ours; so its
    // information is carried over with the inverse of that, which is du = -R^T (dt - perp(t) dtheta).
    let (sine, cosine) = libm::sincos(target_from_moving.yaw_rad);
    let (x, y) = (target_from_moving.x_m, target_from_moving.y_m);
    let columns = [
        [-cosine, -sine, cosine * -y + sine * x],
        [sine, -cosine, -sine * -y + cosine * x],
        [0.0, 0.0, -1.0],
    ];
    sums.information += carried(&other.information, &columns);
    for (i, sum) in sums.gradient.iter_mut().enumerate() {
        *sum += (0..3).map(|k| columns[k][i] * other.gradient[k]).sum::<f64>();
    }
    sums.weigh(settings);
    let points = sums.count + other.count;
    let matched = (sums.matched + other.matched) / points.max(1.0);
    let information = sums.information + Symmetric3::diagonal(1e-3, 1e-3, 1e-3);
    let change = information.solve(sums.gradient).unwrap_or_default();
    Comparison {
        // Both ways count the same surfaces.
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
fn carried(m: &Symmetric3, columns: &[[f64; 3]; 3]) -> Symmetric3 {
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

    /// The walls of a rectangle, seen from a place in it.
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
        fn a_scan_finds_its_place(x in -0.25..0.25_f64, y in -0.25..0.25_f64, yaw in -0.15..0.15_f64) {
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
        fn both_ways_agree(x in -0.04..0.04_f64, y in -0.04..0.04_f64, yaw in -0.02..0.02_f64) {
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
    fn a_corridor_holds_across_and_lets_go_along() {
        let beams = |shift: f32| {
            (0..360).map(move |i| {
                let (s, c) =
                    (libm::sinf((i as f32).to_radians()), libm::cosf((i as f32).to_radians()));
                // Nothing comes back from the far ends.
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
