//! Relaxation of a path: every pose moves towards its neighbours and its original position.

use periplus_geometry::Pose2;

/// Weights and limits of a relaxation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Relaxation {
    /// Weight of the original position.
    pub(crate) data_weight: f64,
    /// Weight of the mean of both neighbours.
    pub(crate) smooth_weight: f64,
    /// Sum of all movements of a pass at which it ends \[m\].
    pub(crate) tolerance_m: f64,
    /// Limit of passes, not reached.
    pub(crate) max_pass_count: usize,
    /// Number of repetitions on the result.
    pub(crate) refinement_count: usize,
}

/// End of a relaxation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relaxed {
    /// The poses do not move any more.
    Converged,
    /// The limit of passes was reached; the path is that of the last pass.
    Unfinished,
    /// A pass was not admissible; the path is that of the pass before.
    Stopped,
    /// The time is over; the path is that of the last pass.
    OutOfTime,
}

/// Relaxes the inner poses of a path of one direction; yaws stay. `is_admissible` judges the path after each
/// pass.
pub(crate) fn relax(
    path: &mut [Pose2],
    how: &Relaxation,
    is_admissible: &mut dyn FnMut(&[Pose2]) -> bool,
    is_out_of_time: &mut dyn FnMut() -> bool,
) -> Relaxed {
    let mut result = relax_once(path, how, is_admissible, is_out_of_time);
    for _ in 0..how.refinement_count {
        if result != Relaxed::Converged {
            break;
        }
        // The refinement keeps what it has reached, however it ends.
        match relax_once(path, how, is_admissible, is_out_of_time) {
            Relaxed::Converged => {}
            Relaxed::OutOfTime => result = Relaxed::OutOfTime,
            _ => break,
        }
    }
    result
}

fn relax_once(
    path: &mut [Pose2],
    how: &Relaxation,
    is_admissible: &mut dyn FnMut(&[Pose2]) -> bool,
    is_out_of_time: &mut dyn FnMut() -> bool,
) -> Relaxed {
    let original = path.to_vec();
    let mut last = path.to_vec();
    let mut change_m = how.tolerance_m;
    let mut pass = 0;
    while change_m >= how.tolerance_m {
        pass += 1;
        change_m = 0.0;
        let end = if pass >= how.max_pass_count {
            Some(Relaxed::Unfinished)
        } else {
            is_out_of_time().then_some(Relaxed::OutOfTime)
        };
        if let Some(end) = end {
            return end;
        }
        for index in 1..path.len().saturating_sub(1) {
            let (before, after) = (path[index - 1], path[index + 1]);
            let step = |original: f64, at: f64, before: f64, after: f64| {
                at + (how.data_weight * (original - at)
                    + how.smooth_weight * (after + before - 2.0 * at))
            };
            let pose = &mut path[index];
            let x_m = step(original[index].x_m, pose.x_m, before.x_m, after.x_m);
            let y_m = step(original[index].y_m, pose.y_m, before.y_m, after.y_m);
            change_m += (x_m - pose.x_m).abs() + (y_m - pose.y_m).abs();
            (pose.x_m, pose.y_m) = (x_m, y_m);
        }
        if !is_admissible(path) {
            path.copy_from_slice(&last);
            return Relaxed::Stopped;
        }
        last.copy_from_slice(path);
    }
    Relaxed::Converged
}
