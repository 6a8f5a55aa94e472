//! Verification of a candidate by the scans of both stretches.

use periplus_geometry::Pose2;
use periplus_scan_matching::{Fit, Placed, Prior, Symmetric3, register};

use crate::local::{against_nearest, close_by};
use crate::settings::Settings;

/// Part of judged points that must agree; points to judge; part of points with partners.
const MIN_AGREEMENT_RATIO: f64 = 0.88;
const MIN_JUDGED_POINTS: u32 = 400;
pub(super) const MIN_MATCHED_RATIO: f64 = 0.6;
/// Number of scans of the old stretch that each of the new one is compared with.
const COMPARED_SCANS: usize = 3;
/// The same where two stretches were driven in opposite directions, and each shows a part that is
/// hidden from the other: fewer partners, but more points that both can judge and that agree.
const OPPOSITE_MIN_MATCHED_RATIO: f64 = 0.3;
const OPPOSITE_MIN_JUDGED_POINTS: u32 = 800;
const OPPOSITE_MIN_AGREEMENT_RATIO: f64 = 0.9;
/// Scans of a stretch that are laid onto others, and more where they have few points.
const FEW_SCANS: usize = 8;
const FEW_POINTS: usize = 800;

/// Result of a verification.
pub(super) struct Verdict {
    pub(super) fit: Fit,
    /// Part of the judged points that agree.
    pub(super) share: f64,
    /// Reason of a rejection.
    pub(super) fault: Option<String>,
}

/// Scans of a group, evenly, that have enough points together to be laid onto others.
fn few<'a>(group: &[Placed<'a>]) -> Vec<Placed<'a>> {
    let points: usize = group.iter().map(|it| it.cloud.points().len()).sum();
    let least = FEW_POINTS * group.len() / points.max(1);
    let every = group.len().div_ceil(least.max(FEW_SCANS)).max(1);
    group.iter().step_by(every).copied().collect()
}

/// Registers two stretches from a start and holds them against each other both ways.
pub(super) fn verify(
    start: Pose2,
    new: &[Placed<'_>],
    old: &[Placed<'_>],
    settings: &Settings,
) -> Verdict {
    // Far from the start it would be another hypothesis.
    let prior =
        Prior { target_from_moving: start, information: Symmetric3::diagonal(25.0, 25.0, 400.0) };
    let (new_few, old_few) = (few(new), few(old));
    let fit = register(&new_few, &old_few, start, Some(&prior), &close_by(&settings.register));
    let sum = against_nearest(new, old, fit.target_from_moving, COMPARED_SCANS);
    let share = sum.share();
    // Seen from the other end, most points of one are hidden from the other.
    let is_partial = fit.matched > OPPOSITE_MIN_MATCHED_RATIO
        && share > OPPOSITE_MIN_AGREEMENT_RATIO
        && sum.judged() > OPPOSITE_MIN_JUDGED_POINTS;
    let fault = if fit.matched < MIN_MATCHED_RATIO && !is_partial {
        Some(format!("only {:.0} % of the points find partners", 100.0 * fit.matched))
    } else if sum.judged() < MIN_JUDGED_POINTS {
        Some(format!("only {} points are seen from both", sum.judged()))
    } else if share < MIN_AGREEMENT_RATIO {
        Some(format!("{:.0} % of the points are seen through", 100.0 * (1.0 - share)))
    } else {
        None
    };
    Verdict { fit, share, fault }
}
