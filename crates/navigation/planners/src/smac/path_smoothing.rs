//! Smoother of the Smac planners: relaxation, and curves that keep the yaws at the ends.
//!
//! Source of the rules: `nav2_smac_planner/src/smoother.cpp`.

use std::f64::consts::PI;
use std::ops::Range;

use periplus_costmap::cost::{INSCRIBED, MAX_NON_OBSTACLE, UNKNOWN};
use periplus_costmap::{Costmap, CostmapView};
use periplus_geometry::Pose2;

use super::curve::CurveFamily;
use crate::smoothing::relaxation::{Relaxation, Relaxed, relax};
use crate::smoothing::segments::{directional_segments, is_reversing, set_yaws_along};

/// Minimum number of poses of a part that is smoothed.
const MIN_POSE_COUNT: usize = 12;
/// Maximum length of a boundary curve, in multiples of the part of the path that it replaces.
const MAX_LENGTH_RATIO: f64 = 2.0;
/// Parts of the path that a boundary curve may replace, in multiples of the radius.
const BOUNDARY_LENGTH_RATIOS: [f64; 4] = [1.0, 2.0, PI, 2.0 * PI];

/// Smoother of one planner.
#[derive(Clone, Copy, Debug)]
pub(super) struct SmacSmoother {
    pub(super) relaxation: Relaxation,
    /// Minimum turning radius \[m\]; none for a robot that turns in place, whose ends stay as they are.
    pub(super) radius_m: Option<f64>,
}

/// Smooths a path in place. The relaxation of a part ends before a collision.
pub(super) fn smooth(
    path: &mut [Pose2],
    how: &SmacSmoother,
    view: &CostmapView<'_>,
    map: &Costmap,
    is_out_of_time: &mut dyn FnMut() -> bool,
) {
    if how.relaxation.max_pass_count == 0 || path.is_empty() {
        return;
    }
    let is_holonomic = how.radius_m.is_none();
    let segments: Vec<Range<usize>> = if is_holonomic {
        std::iter::once(0..path.len()).collect()
    } else {
        directional_segments(path)
    };
    for segment in segments.into_iter().filter(|segment| segment.len() >= MIN_POSE_COUNT) {
        let part = &mut path[segment];
        let (start, end) = (part[0], part[part.len() - 1]);
        let is_reversing = is_reversing(part, is_holonomic);
        let mut is_admissible = |path: &[Pose2]| is_free(path, view, map, is_reversing);
        let relaxed = relax(part, &how.relaxation, &mut is_admissible, is_out_of_time);
        set_yaws_along(part, is_reversing);
        if let (Some(radius_m), Relaxed::Converged) = (how.radius_m, relaxed) {
            let boundary = Boundary { radius_m, is_reversing, map };
            boundary.keep_start(start, part);
            boundary.keep_end(end, part);
        }
    }
}

/// Returns true if no inner pose is in a collision.
fn is_free(path: &[Pose2], view: &CostmapView<'_>, map: &Costmap, is_reversing: bool) -> bool {
    let is_passable = |cost: u8| cost <= MAX_NON_OBSTACLE || cost == UNKNOWN;
    let centres_only = view.is_circular || view.footprint.points().len() < 3;
    path.windows(2).skip(1).all(|pair| {
        let (pose, next) = (pair[0], pair[1]);
        let Some(cost) = map.cost_at(pose.x_m, pose.y_m) else { return false };
        if centres_only {
            return is_passable(cost);
        }
        let direction_rad = libm::atan2(next.y_m - pose.y_m, next.x_m - pose.x_m);
        let yaw_rad = if is_reversing { direction_rad + PI } else { direction_rad };
        is_passable(view.footprint.cost(map, Pose2 { yaw_rad, ..pose }))
    })
}

/// Curves at the ends of a part.
struct Boundary<'a> {
    radius_m: f64,
    is_reversing: bool,
    map: &'a Costmap,
}

impl Boundary<'_> {
    /// Replaces the beginning of a part by a curve that leaves the start in its yaw.
    fn keep_start(&self, start: Pose2, part: &mut [Pose2]) {
        let candidates = self.candidates(part.iter());
        let curve = |count: usize| {
            let end = part[count];
            if self.is_reversing { (end, start) } else { (start, end) }
        };
        if let Some(poses) = self.shortest(&candidates, curve) {
            part[..poses.len()].copy_from_slice(&poses);
        }
    }

    /// Replaces the end of a part by a curve that reaches the end in its yaw.
    fn keep_end(&self, end: Pose2, part: &mut [Pose2]) {
        let candidates = self.candidates(part.iter().rev());
        let curve = |count: usize| {
            let start = part[part.len() - 1 - count];
            if self.is_reversing { (end, start) } else { (start, end) }
        };
        if let Some(poses) = self.shortest(&candidates, curve) {
            let first = part.len() - poses.len();
            part[first..].copy_from_slice(&poses);
        }
    }

    /// Returns the numbers of steps that may be replaced, each with the length of its part of the path \[m\].
    fn candidates<'p>(&self, poses: impl Iterator<Item = &'p Pose2>) -> Vec<(usize, f64)> {
        let mut wanted =
            BOUNDARY_LENGTH_RATIOS.iter().map(|ratio| ratio * self.radius_m).peekable();
        let mut found = Vec::new();
        let mut length_m = 0.0;
        let mut last: Option<&Pose2> = None;
        for (count, pose) in poses.enumerate() {
            if let Some(last) = last {
                length_m += libm::hypot(pose.x_m - last.x_m, pose.y_m - last.y_m);
            }
            last = Some(pose);
            // One candidate for each pose, as in Nav2.
            if wanted.next_if(|wanted_m| length_m >= *wanted_m).is_some() && count > 0 {
                found.push((count, length_m));
            }
        }
        found
    }

    /// Returns the poses of the shortest curve of all candidates that is free and not a loop, in the order of
    /// the path. `ends` gives the poses between which a candidate drives forwards.
    fn shortest(
        &self,
        candidates: &[(usize, f64)],
        ends: impl Fn(usize) -> (Pose2, Pose2),
    ) -> Option<Vec<Pose2>> {
        let mut best: Option<(f64, Vec<Pose2>)> = None;
        for (count, original_m) in candidates {
            let (from, to) = ends(*count);
            let curve = CurveFamily::Dubins.shortest(from, to, self.radius_m);
            let length_m = curve.length();
            let is_shorter = best.as_ref().is_none_or(|(best_m, _)| length_m < *best_m);
            if length_m > MAX_LENGTH_RATIO * original_m || length_m <= 0.0 || !is_shorter {
                continue;
            }
            let fraction = |step: usize| step as f64 / *count as f64;
            let poses: Vec<Pose2> =
                (0..=*count).map(|step| curve.pose_at(from, fraction(step)).normalized()).collect();
            let is_free = |pose: &Pose2| {
                self.map.cost_at(pose.x_m, pose.y_m).is_some_and(|cost| cost < INSCRIBED)
            };
            if poses.iter().all(is_free) {
                best = Some((length_m, poses));
            }
        }
        let (_, mut poses) = best?;
        if self.is_reversing {
            poses.reverse();
        }
        Some(poses)
    }
}
