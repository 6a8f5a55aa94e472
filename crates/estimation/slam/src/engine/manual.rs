//! Input from the user: initial poses and manually moved keyframes.

use std::collections::BTreeMap;

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{Placed, Prior, Symmetric3, register};

use super::{MIN_POINTS_COUNT, ScanOutcome, Slam};
use crate::graph::{ConstraintKind, Edge};
use crate::local::{apart, close_by, floored, grouped, match_locally};
use crate::loops::Closure;
use crate::scan::Ends;

/// Scans this near look at the same things \[m\].
const REACH_M: f64 = 5.0;
/// Scans within this way of each other belong together anyway \[m\].
const SAME_VISIT_M: f64 = 3.0;
/// Standard deviations of a manually moved keyframe: of the search window, and of the constraint if no scan
/// matches \[m, rad\].
const SEARCH_SIGMAS_M_RAD: [f64; 2] = [0.3, 0.15];
const CONSTRAINT_SIGMAS_M_RAD: [f64; 2] = [0.1, 0.05];
/// Minimum fraction of matched points for which the match overrides the user's pose.
const MIN_MATCHED_RATIO: f64 = 0.5;

fn diagonal([shift_m, turn_rad]: [f64; 2]) -> Symmetric3 {
    let (place, heading) = (shift_m * shift_m, turn_rad * turn_rad);
    Symmetric3::diagonal(1.0 / place, 1.0 / place, 1.0 / heading)
}

impl Slam {
    /// Sets the pose of the robot in the map with its covariance along the axes of the map, as
    /// `/initialpose` does. The next scan is matched around it and mapping continues from there. Before the
    /// first scan it defines the origin of the map.
    pub fn place(&mut self, map_from_base: Pose2, covariance: Symmetric3) {
        if map_from_base.is_finite() {
            self.start = Some((map_from_base.normalized(), covariance));
        }
    }

    /// Processes a scan at a pose set by the user.
    pub(super) fn process_scan_at(
        &mut self,
        scan: &LaserScan2,
        odom_from_base: Option<Pose2>,
        start: Pose2,
        covariance: Symmetric3,
    ) -> ScanOutcome {
        let Some(last) = &self.last else { return self.begin(scan, odom_from_base, start) };
        let ends = Ends::new(scan, None, self.settings.used_m());
        let cloud = ends.cloud(&self.settings.cloud);
        if cloud.points().len() < MIN_POINTS_COUNT {
            // Nothing to match; the next scan may do.
            self.start = Some((start, covariance));
            return ScanOutcome::NoMatch;
        }
        let near = nearest(&self.graph.poses, start, self.settings.local_scans);
        let keyframe = near.first().copied().unwrap_or(last.keyframe);
        let map_from_keyframe = self.graph.poses[keyframe];
        let expected = (map_from_keyframe.inverse() * start).normalized();
        let turned = covariance.turned(-map_from_keyframe.yaw_rad);
        let claim = turned.inverse().unwrap_or(diagonal(SEARCH_SIGMAS_M_RAD));
        let (keyframe_from_base, information, doubted, is_matched) = if near.is_empty() {
            (expected, claim, claim, false)
        } else {
            let group = grouped(&self.keyframes, &self.graph, &near, keyframe);
            let group = group.placed();
            let found = match_locally(
                &cloud,
                &group,
                expected,
                &turned,
                &self.settings,
                true,
                self.inlier_ratio,
            );
            (found.fit.target_from_moving, found.information, found.doubted, found.is_matched)
        };
        let pose = (map_from_keyframe * keyframe_from_base).normalized();
        let new = self.insert_disconnected((scan.time_ns, odom_from_base), (&cloud, &ends), pose);
        let edge = Edge::new(
            (keyframe, new),
            keyframe_from_base,
            floored(&information),
            ConstraintKind::Sequential,
        );
        self.graph.add_edge(edge.doubting(&floored(&doubted)));
        self.work.proximity.push_back(new);
        // A scan without a match is inserted all the same: the user knows the pose.
        if is_matched || near.is_empty() { ScanOutcome::Inserted } else { ScanOutcome::NoMatch }
    }

    /// Adds constraints for keyframes that the user has moved: each is matched against the keyframes around
    /// its new pose. Returns the number of constraints. The optimization runs in the background.
    pub fn add_manual_constraints(&mut self, moved: &BTreeMap<usize, Pose2>) -> usize {
        let mut proximity_count = 0;
        for (&keyframe, &map_from_keyframe) in moved {
            if keyframe < self.keyframes.len() && map_from_keyframe.is_finite() {
                proximity_count +=
                    usize::from(self.tie_by_hand(keyframe, map_from_keyframe.normalized()));
            }
        }
        if proximity_count > 0 {
            self.solve_soon();
            self.work
                .proximity
                .extend(moved.keys().copied().filter(|&keyframe| keyframe < self.keyframes.len()));
        }
        proximity_count
    }

    fn tie_by_hand(&mut self, keyframe: usize, map_from_keyframe: Pose2) -> bool {
        let is_other = |&other: &usize| {
            (self.keyframes[keyframe].travel_m - self.keyframes[other].travel_m).abs()
                > SAME_VISIT_M
        };
        let near = nearest(&self.graph.poses, map_from_keyframe, self.keyframes.len());
        let near: Vec<usize> = near.into_iter().filter(is_other).take(3).collect();
        // Without keyframes nearby, the pose is relative to the first keyframe.
        let other = near.first().copied().unwrap_or(0);
        if other == keyframe {
            return false;
        }
        let expected = (self.graph.poses[other].inverse() * map_from_keyframe).normalized();
        let group = grouped(&self.keyframes, &self.graph, &near, other);
        let group = group.placed();
        let prior =
            Prior { target_from_moving: expected, information: diagonal(SEARCH_SIGMAS_M_RAD) };
        let cloud = self.keyframes[keyframe].cloud();
        let moving = [Placed::alone(&cloud)];
        let how = close_by(&self.settings.register);
        let fit = (!near.is_empty())
            .then(|| register(&moving, &group, expected, Some(&prior), &how))
            .filter(|fit| fit.matched >= MIN_MATCHED_RATIO);
        let (pose, information, words) = match &fit {
            Some(fit) => (
                fit.target_from_moving,
                floored(&fit.information),
                format!("{:.0} % of the points find partners there", 100.0 * fit.matched),
            ),
            None => (
                expected,
                diagonal(CONSTRAINT_SIGMAS_M_RAD),
                "no scan matches there; the pose set by hand is used".into(),
            ),
        };
        let (from, to) = if other < keyframe { (other, keyframe) } else { (keyframe, other) };
        let from_from_to = if other < keyframe { pose } else { pose.inverse().normalized() };
        let information =
            if other < keyframe { information } else { information.turned(from_from_to.yaw_rad) };
        self.graph.add_edge(Edge::new(
            (from, to),
            from_from_to,
            information,
            ConstraintKind::LoopClosure,
        ));
        self.loops.closures.push(Closure {
            keyframes: (from, to),
            old_from_new: from_from_to,
            is_accepted: true,
            region_m: 0.0,
            agreeing: fit.map_or(0.0, |fit| fit.matched),
            reason: format!("moved by hand; {words}"),
        });
        true
    }
}

/// Returns the keyframes near a pose, nearest first; a rotation adds to the distance.
pub(crate) fn nearest(poses: &[Pose2], place: Pose2, most: usize) -> Vec<usize> {
    let mut near: Vec<(f64, usize)> = poses
        .iter()
        .enumerate()
        .filter_map(|(keyframe, &pose)| {
            let (metres, radians) = apart(pose, place);
            (metres < REACH_M).then_some((metres + 0.6 * radians, keyframe))
        })
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.truncate(most);
    near.into_iter().map(|it| it.1).collect()
}
