//! Shortest curves of bounded curvature for a car that drives forwards and backwards.
//!
//! Source: J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both forwards and backwards",
//! 1990, sections 8.1 to 8.11. Every curve is one of eight words of arcs and straight parts, driven
//! backwards in time, mirrored, or in reverse order.

use std::f64::consts::{FRAC_PI_2, PI};

use periplus_geometry::Pose2;

use super::curve::{CurvePart, MAX_PART_COUNT, NO_PART, Steer};

use Steer::{Left, Right, Straight};

/// Size of lengths that are zero but for rounding.
const ROUNDING_RATIO: f64 = 1e-9;

type Parts = [CurvePart; MAX_PART_COUNT];

/// Goal in the frame of the start, scaled by the radius.
#[derive(Clone, Copy)]
struct Goal {
    x: f64,
    y: f64,
    phi: f64,
    sine: f64,
    cosine: f64,
}

impl Goal {
    fn new(x: f64, y: f64, phi: f64) -> Self {
        let (sine, cosine) = libm::sincos(phi);
        Self { x, y, phi, sine, cosine }
    }

    /// The goal of the same curve driven backwards in time.
    fn time_flipped(self) -> Self {
        Self { x: -self.x, phi: -self.phi, sine: -self.sine, ..self }
    }

    /// The goal of the mirrored curve.
    fn mirrored(self) -> Self {
        Self { y: -self.y, phi: -self.phi, sine: -self.sine, ..self }
    }

    /// The goal of the curve whose parts are in reverse order.
    fn reversed(self) -> Self {
        let x = self.x * self.cosine + self.y * self.sine;
        let y = self.x * self.sine - self.y * self.cosine;
        Self { x, y, ..self }
    }
}

/// Returns the parts of the curve with the lowest sum of its length and a length for each cusp.
pub(super) fn cheapest(from: Pose2, to: Pose2, radius: f64, cusp_cost: f64) -> Parts {
    let relative = from.inverse() * to;
    let goal = Goal::new(relative.x_m / radius, relative.y_m / radius, relative.yaw_rad);
    let mut best = Best {
        cost: f64::INFINITY,
        parts: [NO_PART; MAX_PART_COUNT],
        cusp_cost: cusp_cost / radius,
    };
    for is_time_flipped in [false, true] {
        for is_mirrored in [false, true] {
            let goal = if is_time_flipped { goal.time_flipped() } else { goal };
            let goal = if is_mirrored { goal.mirrored() } else { goal };
            let symmetry = Symmetry { is_time_flipped, is_mirrored };
            words(goal, &mut |parts: &[CurvePart]| best.offer(parts, symmetry));
        }
    }
    best.parts
}

#[derive(Clone, Copy)]
struct Symmetry {
    is_time_flipped: bool,
    is_mirrored: bool,
}

struct Best {
    cost: f64,
    parts: Parts,
    /// Length that a cusp costs, in multiples of the radius.
    cusp_cost: f64,
}

impl Best {
    fn offer(&mut self, parts: &[CurvePart], symmetry: Symmetry) {
        let length: f64 = parts.iter().map(|part| part.length.abs()).sum();
        let cost = if self.cusp_cost > 0.0 {
            length + self.cusp_cost * cusp_count(parts) as f64
        } else {
            length
        };
        if cost >= self.cost {
            return;
        }
        self.cost = cost;
        self.parts = [NO_PART; MAX_PART_COUNT];
        for (to, CurvePart { steer, length }) in self.parts.iter_mut().zip(parts) {
            to.steer = if symmetry.is_mirrored { steer.mirrored() } else { *steer };
            to.length = if symmetry.is_time_flipped { -length } else { *length };
        }
    }
}

/// Number of changes between forwards and backwards.
fn cusp_count(parts: &[CurvePart]) -> usize {
    let is_part = |length: &f64| length.abs() > ROUNDING_RATIO;
    let mut lengths = parts.iter().map(|part| part.length).filter(is_part);
    let Some(mut last) = lengths.next() else { return 0 };
    lengths.filter(|length| std::mem::replace(&mut last, *length) * length < 0.0).count()
}

/// Offers all words that reach a goal.
fn words(goal: Goal, offer: &mut dyn FnMut(&[CurvePart])) {
    let part = |steer, length| CurvePart { steer, length };
    let quarter = part(Right, -FRAC_PI_2);
    if let Some([t, u, v]) = lp_sp_lp(goal) {
        offer(&[part(Left, t), part(Straight, u), part(Left, v)]);
    }
    if let Some([t, u, v]) = lp_sp_rp(goal) {
        offer(&[part(Left, t), part(Straight, u), part(Right, v)]);
    }
    if let Some([t, u, v]) = lp_rup_lum_rm(goal) {
        offer(&[part(Left, t), part(Right, u), part(Left, -u), part(Right, v)]);
    }
    if let Some([t, u, v]) = lp_rum_lum_rp(goal) {
        offer(&[part(Left, t), part(Right, u), part(Left, u), part(Right, v)]);
    }
    if let Some([t, u, v]) = lp_rm_s_lm_rp(goal) {
        let middle = [quarter, part(Straight, u), part(Left, -FRAC_PI_2)];
        offer(&[part(Left, t), middle[0], middle[1], middle[2], part(Right, v)]);
    }
    let reversed = goal.reversed();
    if let Some([t, u, v]) = lp_rm_l(goal) {
        offer(&[part(Left, t), part(Right, u), part(Left, v)]);
    }
    if let Some([t, u, v]) = lp_rm_l(reversed) {
        offer(&[part(Left, v), part(Right, u), part(Left, t)]);
    }
    if let Some([t, u, v]) = lp_rm_sm_lm(goal) {
        offer(&[part(Left, t), quarter, part(Straight, u), part(Left, v)]);
    }
    if let Some([t, u, v]) = lp_rm_sm_lm(reversed) {
        offer(&[part(Left, v), part(Straight, u), quarter, part(Left, t)]);
    }
    if let Some([t, u, v]) = lp_rm_sm_rm(goal) {
        offer(&[part(Left, t), quarter, part(Straight, u), part(Right, v)]);
    }
    if let Some([t, u, v]) = lp_rm_sm_rm(reversed) {
        offer(&[part(Right, v), part(Straight, u), quarter, part(Left, t)]);
    }
}

/// Returns an equivalent angle in [-π, π] \[rad\].
fn wrapped(angle_rad: f64) -> f64 {
    libm::remainder(angle_rad, 2.0 * PI)
}

fn polar(x: f64, y: f64) -> (f64, f64) {
    (libm::hypot(x, y), libm::atan2(y, x))
}

fn is_forwards(length: f64) -> bool {
    length >= -ROUNDING_RATIO
}

fn is_backwards(length: f64) -> bool {
    length <= ROUNDING_RATIO
}

/// Formula 8.1.
fn lp_sp_lp(goal: Goal) -> Option<[f64; 3]> {
    let (u, t) = polar(goal.x - goal.sine, goal.y - 1.0 + goal.cosine);
    let v = wrapped(goal.phi - t);
    (is_forwards(t) && is_forwards(v)).then_some([t, u, v])
}

/// Formula 8.2.
fn lp_sp_rp(goal: Goal) -> Option<[f64; 3]> {
    let (distance, angle) = polar(goal.x + goal.sine, goal.y - 1.0 - goal.cosine);
    let square = distance * distance - 4.0;
    let u = (square >= 0.0).then(|| square.sqrt())?;
    let t = wrapped(angle + libm::atan2(2.0, u));
    let v = wrapped(t - goal.phi);
    (is_forwards(t) && is_forwards(v)).then_some([t, u, v])
}

/// Formulas 8.3 and 8.4.
fn lp_rm_l(goal: Goal) -> Option<[f64; 3]> {
    let (distance, angle) = polar(goal.x - goal.sine, goal.y - 1.0 + goal.cosine);
    let u = (distance <= 4.0).then(|| -2.0 * libm::asin(0.25 * distance))?;
    let t = wrapped(angle + 0.5 * u + PI);
    let v = wrapped(goal.phi - t + u);
    (is_forwards(t) && is_backwards(u)).then_some([t, u, v])
}

/// First and last arc of four arcs whose inner ones are known (page 389).
fn outer_arcs(u: f64, v: f64, xi: f64, eta: f64, phi: f64) -> (f64, f64) {
    let delta = wrapped(u - v);
    let (sin_u, cos_u) = libm::sincos(u);
    let (sin_delta, cos_delta) = libm::sincos(delta);
    let (a, b) = (sin_u - sin_delta, cos_u - cos_delta - 1.0);
    let angle = libm::atan2(eta * a - xi * b, xi * a + eta * b);
    let side = 2.0 * (cos_delta - libm::cos(v) - cos_u) + 3.0;
    let first = if side < 0.0 { wrapped(angle + PI) } else { wrapped(angle) };
    (first, wrapped(first - u + v - phi))
}

/// Formula 8.7.
fn lp_rup_lum_rm(goal: Goal) -> Option<[f64; 3]> {
    let (xi, eta) = (goal.x + goal.sine, goal.y - 1.0 - goal.cosine);
    let rho = 0.25 * (2.0 + libm::hypot(xi, eta));
    let u = (rho <= 1.0).then(|| libm::acos(rho))?;
    let (t, v) = outer_arcs(u, -u, xi, eta, goal.phi);
    (is_forwards(t) && is_backwards(v)).then_some([t, u, v])
}

/// Formula 8.8.
fn lp_rum_lum_rp(goal: Goal) -> Option<[f64; 3]> {
    let (xi, eta) = (goal.x + goal.sine, goal.y - 1.0 - goal.cosine);
    let rho = (20.0 - xi * xi - eta * eta) / 16.0;
    let u = (0.0..=1.0).contains(&rho).then(|| -libm::acos(rho))?;
    let (t, v) = outer_arcs(u, u, xi, eta, goal.phi);
    (is_forwards(t) && is_forwards(v)).then_some([t, u, v])
}

/// Formula 8.9.
fn lp_rm_sm_lm(goal: Goal) -> Option<[f64; 3]> {
    let (rho, theta) = polar(goal.x - goal.sine, goal.y - 1.0 + goal.cosine);
    let r = (rho >= 2.0).then(|| (rho * rho - 4.0).sqrt())?;
    let u = 2.0 - r;
    let t = wrapped(theta + libm::atan2(r, -2.0));
    let v = wrapped(goal.phi - FRAC_PI_2 - t);
    (is_forwards(t) && is_backwards(u) && is_backwards(v)).then_some([t, u, v])
}

/// Formula 8.10.
fn lp_rm_sm_rm(goal: Goal) -> Option<[f64; 3]> {
    let (xi, eta) = (goal.x + goal.sine, goal.y - 1.0 - goal.cosine);
    let (rho, t) = polar(-eta, xi);
    let u = (rho >= 2.0).then_some(2.0 - rho)?;
    let v = wrapped(t + FRAC_PI_2 - goal.phi);
    (is_forwards(t) && is_backwards(u) && is_backwards(v)).then_some([t, u, v])
}

/// Formula 8.11.
fn lp_rm_s_lm_rp(goal: Goal) -> Option<[f64; 3]> {
    let (xi, eta) = (goal.x + goal.sine, goal.y - 1.0 - goal.cosine);
    let rho = libm::hypot(xi, eta);
    let u = (rho >= 2.0).then(|| 4.0 - (rho * rho - 4.0).sqrt())?;
    if !is_backwards(u) {
        return None;
    }
    let t = wrapped(libm::atan2((4.0 - u) * xi - 2.0 * eta, -2.0 * xi + (u - 4.0) * eta));
    let v = wrapped(t - goal.phi);
    (is_forwards(t) && is_forwards(v)).then_some([t, u, v])
}
