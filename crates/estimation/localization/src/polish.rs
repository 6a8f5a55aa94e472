//! A pose refined by the scan: beams' ends are drawn to the walls of the map.
//!
//! Gauss-Newton over distances to walls with a kernel that lets go of what the map does not have
//! (Geman and McClure), and with what was known before as a prior, so that along corridors nothing is
//! made up.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

use crate::known_map::KnownMap;

/// Ends farther from walls than this hardly count: at first, and at last \[m\].
const SCALES_M: [f64; 7] = [0.3, 0.3, 0.2, 0.15, 0.1, 0.1, 0.1];
/// How far the walls of a map are from where they are, and readings from what is there \[m\].
const SIGMA_M: f64 = 0.04;
/// Neighbouring beams are wrong together: so many count as independent.
const INDEPENDENT: f64 = 40.0;
/// Smaller steps end it \[m\], \[rad\].
const SMALL: (f64, f64) = (2e-4, 1e-4);

/// A pose with what is known about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Known {
    /// `map_from_base`.
    pub(crate) pose: Pose2,
    /// How well it is known: inverse of the covariance.
    pub(crate) information: Symmetric3,
}

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Polished {
    pub(crate) known: Known,
    /// Which part of the ends is on walls, 0 to 1.
    pub(crate) fit: f64,
}

/// Refines a pose; the information of the prior is part of what comes out.
pub(crate) fn polish(map: &KnownMap, ends: &[[f32; 2]], prior: &Known) -> Polished {
    let finder = map.finder();
    let share = (INDEPENDENT / ends.len().max(1) as f64).min(1.0) / (SIGMA_M * SIGMA_M);
    let mut pose = prior.pose;
    let mut information = prior.information;
    let mut fit = 0.0;
    for (round, scale_m) in SCALES_M.into_iter().enumerate() {
        let (sine, cosine) = libm::sincos(pose.yaw_rad);
        let mut hessian = Symmetric3::ZERO;
        let mut pull = [0.0; 3];
        let mut agreeing = 0.0;
        for &[x, y] in ends {
            let (x, y) = (f64::from(x), f64::from(y));
            let (rx, ry) = (cosine * x - sine * y, sine * x + cosine * y);
            let found = map.slope(&finder, pose.x_m + rx, pose.y_m + ry);
            let Some((distance, [gx, gy])) = found else { continue };
            let squared = scale_m * scale_m;
            let kernel = squared / (squared + distance * distance);
            let weight = share * kernel * kernel;
            agreeing += kernel;
            let row = [gx, gy, gy * rx - gx * ry];
            hessian.add_outer(row, weight);
            for (sum, part) in pull.iter_mut().zip(row) {
                *sum += weight * distance * part;
            }
        }
        fit = agreeing / ends.len().max(1) as f64;
        let off = [
            pose.x_m - prior.pose.x_m,
            pose.y_m - prior.pose.y_m,
            normalize_angle(pose.yaw_rad - prior.pose.yaw_rad),
        ];
        let back = prior.information.times(off);
        information = hessian + prior.information;
        let sum = [-pull[0] - back[0], -pull[1] - back[1], -pull[2] - back[2]];
        let Some(step) = information.solve(sum) else { break };
        // No further than a step is good for.
        let length = libm::hypot(step[0], step[1]);
        let damp = (0.2 / length.max(1e-9)).min(0.1 / step[2].abs().max(1e-9)).min(1.0);
        pose = Pose2::new(
            pose.x_m + damp * step[0],
            pose.y_m + damp * step[1],
            normalize_angle(pose.yaw_rad + damp * step[2]),
        );
        if round >= 4 && length < SMALL.0 && step[2].abs() < SMALL.1 {
            break;
        }
    }
    Polished { known: Known { pose, information }, fit }
}

/// After a motion by odometry: the pose moves, and what is known about it becomes less by a tenth of
/// the way and of the turn.
pub(crate) fn moved(known: &Known, old_from_new: Pose2) -> Known {
    let way_m = libm::hypot(old_from_new.x_m, old_from_new.y_m);
    let turn_rad = normalize_angle(old_from_new.yaw_rad).abs();
    let (place, turn) = (0.01 + 0.1 * way_m, 0.003 + 0.1 * turn_rad + 0.05 * way_m);
    let spread = Symmetric3::diagonal(place * place, place * place, turn * turn);
    let covariance = known.information.inverse().unwrap_or_else(|| unknown(1.0, 0.5)) + spread;
    Known {
        pose: (known.pose * old_from_new).normalized(),
        information: covariance.inverse().unwrap_or_else(|| loosely(1.0, 0.5)),
    }
}

/// As if the robot had gone on somewhere near by.
pub(crate) fn loosened(known: &Known) -> Known {
    let covariance = known.information.inverse().unwrap_or_default() + unknown(0.1, 0.1);
    Known { information: covariance.inverse().unwrap_or(known.information), ..*known }
}

fn unknown(place_m: f64, turn_rad: f64) -> Symmetric3 {
    Symmetric3::diagonal(place_m * place_m, place_m * place_m, turn_rad * turn_rad)
}

/// The information of a pose that is known to so many metres and radians.
pub(crate) fn loosely(place_m: f64, turn_rad: f64) -> Symmetric3 {
    let place = 1.0 / (place_m * place_m);
    Symmetric3::diagonal(place, place, 1.0 / (turn_rad * turn_rad))
}
