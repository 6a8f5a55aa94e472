//! Analytic expansion: the rest of a path as one curve to the goal.
//!
//! Source of the rules: `nav2_smac_planner/analytic_expansion_impl.hpp`.

use std::f64::consts::{PI, SQRT_2};

use periplus_geometry::Pose2;

use super::collision::CollisionChecker;
use super::curve::CurveFamily;

/// Number of attempts to begin earlier on the path, and the nodes between them.
pub(super) const EARLIER_START_COUNT: usize = 8;
pub(super) const EARLIER_START_STEP_COUNT: usize = 5;
/// Largest radius that is tried, in multiples of the minimum, and the step \[cells\].
const MAX_RADIUS_FACTOR: f64 = 4.0;
const RADIUS_STEP_CELLS: f64 = 0.5;

/// Minimum distance of a sample from a cusp, in intervals.
const CUSP_DISTANCE_RATIO: f64 = 0.25;

/// Settings of analytic expansions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AnalyticSettings {
    pub(crate) family: CurveFamily,
    /// Minimum turning radius \[cells\].
    pub(crate) radius: f64,
    /// Maximum length of a curve \[cells\].
    pub(crate) max_length: f64,
    /// Cost above which a curve must not enter a region again.
    pub(crate) max_cost: f64,
    /// True if short curves are accepted in spite of `max_cost`.
    pub(crate) overrides_max_cost: bool,
    /// Weight of the costs of cells.
    pub(crate) cost_penalty: f64,
    /// Length that a cusp costs \[cells\].
    pub(crate) cusp_cost: f64,
}

/// Collision-free curve to a goal.
#[derive(Clone, Debug)]
pub(super) struct AnalyticPath {
    /// Poses between the start and the goal \[cells, rad\], without both.
    pub(super) poses: Vec<Pose2>,
    /// Sum of length and weighted costs; infinite for curves that are too short to compare.
    pub(super) score: f64,
    reversal_count: usize,
}

/// Returns the curve from a pose to a goal \[cells, rad\]; none if it is too long, too short, collides or
/// passes through regions of high cost without need.
pub(super) fn expand(
    from: Pose2,
    goal: Pose2,
    radius: f64,
    settings: &AnalyticSettings,
    checker: &CollisionChecker<'_>,
) -> Option<AnalyticPath> {
    let curve = settings.family.cheapest(from, goal, radius, settings.cusp_cost);
    let length = curve.length();
    if length > settings.max_length || length < SQRT_2 {
        return None;
    }
    let interval_count = (length / SQRT_2) as usize;
    let cusps: Vec<f64> = curve.cusps().collect();
    let mut poses = Vec::with_capacity(interval_count + cusps.len());
    let mut costs = Vec::with_capacity(interval_count + cusps.len());
    for fraction in fractions(interval_count, &cusps) {
        let pose = curve.pose_at(from, fraction);
        costs.push(f64::from(checker.free_cost_at(pose)?));
        poses.push(pose);
    }
    let is_short = length < 2.0 * PI * settings.radius && settings.overrides_max_cost;
    if !is_short && reenters_high_cost(&costs, settings.max_cost) {
        return None;
    }
    let score = match poses.as_slice() {
        [first, second, ..] => {
            let step = libm::hypot(second.x_m - first.x_m, second.y_m - first.y_m);
            costs.iter().map(|cost| step * (1.0 + settings.cost_penalty * cost / 252.0)).sum()
        }
        _ => f64::INFINITY,
    };
    poses.pop();
    Some(AnalyticPath { poses, score, reversal_count: cusps.len() })
}

/// Returns the fractions of a curve at which it is sampled: in equal intervals, as in Nav2, and at its cusps,
/// which Nav2 leaves out. Samples close to a cusp are left out.
fn fractions(interval_count: usize, cusps: &[f64]) -> Vec<f64> {
    let count = interval_count as f64;
    let is_clear = |fraction: &f64| {
        cusps.iter().all(|cusp| (fraction - cusp).abs() * count > CUSP_DISTANCE_RATIO)
    };
    let regular = (1..interval_count).map(|interval| interval as f64 / count).filter(is_clear);
    let mut all: Vec<f64> = regular.chain(cusps.iter().copied()).collect();
    all.sort_by(f64::total_cmp);
    all.push(1.0);
    all
}

/// Returns true if, seen from the goal, the cost leaves the region above a limit and enters it again.
fn reenters_high_cost(costs: &[f64], max_cost: f64) -> bool {
    let mut from_goal = costs.iter().rev().skip_while(|cost| **cost > max_cost);
    from_goal.any(|cost| *cost > max_cost)
}

/// Improves a curve: begins at earlier nodes of the path, then on wider arcs. `earlier` lists nodes of the
/// path with their poses, from the latest to the earliest. Returns the node at which the curve begins.
pub(super) fn refine(
    start: (usize, Pose2),
    earlier: impl Iterator<Item = (usize, Pose2)>,
    goal: Pose2,
    first: AnalyticPath,
    settings: &AnalyticSettings,
    checker: &CollisionChecker<'_>,
) -> (usize, AnalyticPath) {
    let (mut node, mut from, mut best) = (start.0, start.1, first);
    for (candidate, pose) in earlier.take(EARLIER_START_COUNT) {
        let Some(path) = expand(pose, goal, settings.radius, settings, checker) else { break };
        if path.reversal_count <= best.reversal_count {
            (node, from, best) = (candidate, pose, path);
        }
    }
    let original_score = best.score;
    let mut best_score = original_score;
    let mut radius = settings.radius;
    while radius < MAX_RADIUS_FACTOR * settings.radius {
        radius += RADIUS_STEP_CELLS;
        let Some(path) = expand(from, goal, radius, settings, checker) else { continue };
        let is_better = path.score <= best_score && path.reversal_count <= best.reversal_count;
        let is_simpler = path.score <= original_score && path.reversal_count < best.reversal_count;
        if is_better || is_simpler {
            best_score = path.score;
            best = path;
        }
    }
    (node, AnalyticPath { score: best_score, ..best })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_of_high_cost_may_only_be_at_the_end() {
        assert!(!reenters_high_cost(&[0.0, 10.0, 220.0, 230.0], 200.0));
        assert!(reenters_high_cost(&[0.0, 220.0, 10.0, 230.0], 200.0));
        assert!(reenters_high_cost(&[0.0, 220.0, 10.0], 200.0));
        assert!(!reenters_high_cost(&[], 200.0));
    }
}
