//! Shortest curves of bounded curvature for a car that only drives forwards.
//!
//! Source: L. E. Dubins, "On curves of minimal length with a constraint on average curvature", 1957; formulas
//! of A. M. Shkel and V. Lumelsky, "Classification of the Dubins set", 2001.

use std::f64::consts::PI;

use periplus_geometry::Pose2;

use super::curve::{CurvePart, MAX_PART_COUNT, NO_PART, Steer, positive_angle};

use Steer::{Left, Right, Straight};

/// Start and goal in the frame in which the goal is on the x axis, scaled by the radius.
struct Relative {
    distance: f64,
    /// Angle of the start and of the goal to the line between them \[rad\].
    alpha: f64,
    beta: f64,
    sin_alpha: f64,
    cos_alpha: f64,
    sin_beta: f64,
    cos_beta: f64,
}

/// Angle of the first arc, middle part, angle of the last arc.
type Lengths = Option<[f64; 3]>;

/// Returns the parts of the shortest curve.
pub(super) fn shortest(from: Pose2, to: Pose2, radius: f64) -> [CurvePart; MAX_PART_COUNT] {
    let (dx, dy) = (to.x_m - from.x_m, to.y_m - from.y_m);
    let direction_rad = libm::atan2(dy, dx);
    let alpha = positive_angle(from.yaw_rad - direction_rad);
    let beta = positive_angle(to.yaw_rad - direction_rad);
    let (sin_alpha, cos_alpha) = libm::sincos(alpha);
    let (sin_beta, cos_beta) = libm::sincos(beta);
    let distance = libm::hypot(dx, dy) / radius;
    let at = Relative { distance, alpha, beta, sin_alpha, cos_alpha, sin_beta, cos_beta };
    let words = [
        ([Left, Straight, Left], lsl(&at)),
        ([Right, Straight, Right], rsr(&at)),
        ([Right, Straight, Left], rsl(&at)),
        ([Left, Straight, Right], lsr(&at)),
        ([Right, Left, Right], rlr(&at)),
        ([Left, Right, Left], lrl(&at)),
    ];
    let found = words.into_iter().filter_map(|(steers, lengths)| Some((steers, lengths?)));
    let total = |lengths: &[f64; 3]| lengths.iter().sum::<f64>();
    let best = found.min_by(|(_, a), (_, b)| total(a).total_cmp(&total(b)));
    let mut parts = [NO_PART; MAX_PART_COUNT];
    if let Some((steers, lengths)) = best {
        for (part, (steer, length)) in parts.iter_mut().zip(steers.into_iter().zip(lengths)) {
            *part = CurvePart { steer, length };
        }
    }
    parts
}

/// Square root of a number that may miss zero by rounding.
fn root(square: f64) -> Option<f64> {
    const ROUNDING: f64 = -1e-9;
    (square >= ROUNDING).then(|| square.max(0.0).sqrt())
}

fn lsl(at: &Relative) -> Lengths {
    let d = at.distance;
    let inner =
        at.cos_alpha * at.cos_beta + at.sin_alpha * at.sin_beta - d * (at.sin_alpha - at.sin_beta);
    let straight = root(2.0 + d * d - 2.0 * inner)?;
    let theta = libm::atan2(at.cos_beta - at.cos_alpha, d + at.sin_alpha - at.sin_beta);
    Some([positive_angle(theta - at.alpha), straight, positive_angle(at.beta - theta)])
}

fn rsr(at: &Relative) -> Lengths {
    let d = at.distance;
    let inner =
        at.cos_alpha * at.cos_beta + at.sin_alpha * at.sin_beta - d * (at.sin_beta - at.sin_alpha);
    let straight = root(2.0 + d * d - 2.0 * inner)?;
    let theta = libm::atan2(at.cos_alpha - at.cos_beta, d - at.sin_alpha + at.sin_beta);
    Some([positive_angle(at.alpha - theta), straight, positive_angle(theta - at.beta)])
}

fn rsl(at: &Relative) -> Lengths {
    let d = at.distance;
    let inner =
        at.cos_alpha * at.cos_beta + at.sin_alpha * at.sin_beta - d * (at.sin_alpha + at.sin_beta);
    let straight = root(d * d - 2.0 + 2.0 * inner)?;
    let theta = libm::atan2(at.cos_alpha + at.cos_beta, d - at.sin_alpha - at.sin_beta)
        - libm::atan2(2.0, straight);
    Some([positive_angle(at.alpha - theta), straight, positive_angle(at.beta - theta)])
}

fn lsr(at: &Relative) -> Lengths {
    let d = at.distance;
    let inner =
        at.cos_alpha * at.cos_beta + at.sin_alpha * at.sin_beta + d * (at.sin_alpha + at.sin_beta);
    let straight = root(d * d - 2.0 + 2.0 * inner)?;
    let theta = libm::atan2(-at.cos_alpha - at.cos_beta, d + at.sin_alpha + at.sin_beta)
        - libm::atan2(-2.0, straight);
    Some([positive_angle(theta - at.alpha), straight, positive_angle(theta - at.beta)])
}

fn rlr(at: &Relative) -> Lengths {
    let d = at.distance;
    let inner =
        at.cos_alpha * at.cos_beta + at.sin_alpha * at.sin_beta + d * (at.sin_alpha - at.sin_beta);
    let cosine = 0.125 * (6.0 - d * d + 2.0 * inner);
    let middle = (cosine.abs() < 1.0).then(|| 2.0 * PI - libm::acos(cosine))?;
    let theta = libm::atan2(at.cos_alpha - at.cos_beta, d - at.sin_alpha + at.sin_beta);
    let first = positive_angle(at.alpha - theta + 0.5 * middle);
    Some([first, middle, positive_angle(at.alpha - at.beta - first + middle)])
}

fn lrl(at: &Relative) -> Lengths {
    let d = at.distance;
    let inner =
        at.cos_alpha * at.cos_beta + at.sin_alpha * at.sin_beta - d * (at.sin_alpha - at.sin_beta);
    let cosine = 0.125 * (6.0 - d * d + 2.0 * inner);
    let middle = (cosine.abs() < 1.0).then(|| 2.0 * PI - libm::acos(cosine))?;
    let theta = libm::atan2(at.cos_beta - at.cos_alpha, d + at.sin_alpha - at.sin_beta);
    let first = positive_angle(theta - at.alpha + 0.5 * middle);
    Some([first, middle, positive_angle(at.beta - at.alpha - first + middle)])
}
