//! Delay between two clocks, from rotations that both have seen.

use crate::scans::ScannerDisplacement;
use crate::wheels::{DifferentialDrive, WheelTrack};

/// Step of the search \[s\].
const STEP_S: f64 = 0.005;

/// Returns the delay of the scans' stamps \[s\] within ±`max_delay_s`: the shift at which the rotations of the
/// scanner correlate best with those of the wheels, with a parabola through the best three. None if the
/// best shift is at the limit, or without rotations that vary.
pub(crate) fn delay_s(
    track: &WheelTrack,
    drive: &DifferentialDrive,
    displacements: &[ScannerDisplacement],
    max_delay_s: f64,
) -> Option<f64> {
    let yaw_at = |stamp_s: f64| {
        let (left_rad, right_rad) = track.angles_at(stamp_s)?;
        Some(drive.motion(left_rad, right_rad).yaw_rad)
    };
    let turn = |it: &ScannerDisplacement, delay_s: f64| {
        Some(yaw_at(it.to_s - delay_s)? - yaw_at(it.from_s - delay_s)?)
    };
    // The same pairs for all shifts.
    let is_inside = |it: &&ScannerDisplacement| {
        turn(it, max_delay_s).is_some() && turn(it, -max_delay_s).is_some()
    };
    let pairs: Vec<&ScannerDisplacement> = displacements.iter().filter(is_inside).collect();
    let count = (max_delay_s / STEP_S).floor() as i64;
    let rating = |step: i64| {
        let delay_s = step as f64 * STEP_S;
        let turns =
            pairs.iter().filter_map(|it| Some((it.from_from_to.yaw_rad, turn(it, delay_s)?)));
        correlation(&turns.collect::<Vec<_>>())
    };
    let ratings: Vec<f64> = (-count..=count).map(rating).collect::<Option<_>>()?;
    let best = (0..ratings.len()).max_by(|a, b| ratings[*a].total_cmp(&ratings[*b]))?;
    let (below, above) = (ratings.get(best.checked_sub(1)?)?, ratings.get(best + 1)?);
    let curvature = below - 2.0 * ratings[best] + above;
    if curvature >= 0.0 {
        return None;
    }
    let offset = 0.5 * (below - above) / curvature;
    Some((best as f64 - count as f64 + offset) * STEP_S)
}

/// Pearson's correlation; none without variation.
fn correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    let count = pairs.len() as f64;
    let (sum_a, sum_b) = pairs.iter().fold((0.0, 0.0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
    let (mean_a, mean_b) = (sum_a / count, sum_b / count);
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in pairs {
        let (a, b) = (a - mean_a, b - mean_b);
        aa += a * a;
        bb += b * b;
        ab += a * b;
    }
    let norm = (aa * bb).sqrt();
    (norm > 0.0).then(|| ab / norm)
}
