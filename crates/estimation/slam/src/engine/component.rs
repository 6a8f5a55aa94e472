//! Components of the map: when scans suddenly fit nothing that was seen before, the robot was carried, or a part
//! of the log is missing. Then a new component begins, and only closures connect it to the rest.

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{Cloud, Symmetric3};

use super::{Last, OdometryStep, ROTATION_ARM_M, ScanMatch, ScanOutcome, Slam, drawn_ends};
use crate::graph::{ConstraintKind, Edge};
use crate::keyframe::{Keyframe, TrajectoryNode};
use crate::local::apart;
use crate::remark::RemarkKind;
use crate::scan::Ends;

/// Path length added at the start of a component, so that earlier scans count as old and can be closed with
/// \[m\].
const CARRIED_M: f64 = 30.0;
/// Longest interruption of the scans across which matching is trusted \[s\].
const GAP_S: f64 = 10.0;
/// Maximum agreement with the scans before of a scan that belongs elsewhere, after an interruption or an
/// odometry jump; [`ScanMatch::contradicts`] otherwise.
const MAX_INTERRUPTED_AGREEMENT_RATIO: f64 = 0.8;
/// Minimum path and number of consecutive scans that belong elsewhere.
const STRANGE_M: f64 = 1.5;
const STRANGE_SCANS: usize = 4;

/// Scans in a row that fit nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct UnmatchedRun {
    scans: usize,
    way_m: f64,
}

crate::session::packed!(UnmatchedRun { scans, way_m });

impl Slam {
    /// True if a scan does not belong to the scans before it: the robot was carried, or scans are missing.
    pub(super) fn is_kidnapped(&mut self, scan_match: &ScanMatch, step: &OdometryStep) -> bool {
        if scan_match.is_blank || !self.settings.closes_loops {
            return false;
        }
        let is_interrupted = step.jump_m.is_some() || step.seconds > GAP_S;
        if is_interrupted && scan_match.agreeing < MAX_INTERRUPTED_AGREEMENT_RATIO {
            return true;
        }
        if !scan_match.contradicts() {
            self.unmatched = UnmatchedRun::default();
            return false;
        }
        let (metres, radians) = apart(scan_match.motion, Pose2::IDENTITY);
        self.unmatched.scans += 1;
        self.unmatched.way_m += metres + ROTATION_ARM_M * radians;
        self.unmatched.scans >= STRANGE_SCANS && self.unmatched.way_m > STRANGE_M
    }

    /// Begins a component with a scan, at the pose by odometry.
    pub(super) fn begin_component(
        &mut self,
        scan: &LaserScan2,
        odom_from_base: Option<Pose2>,
        scan_match: &ScanMatch,
    ) -> ScanOutcome {
        let Some(last) = &self.last else { return ScanOutcome::NoMatch };
        self.unmatched = UnmatchedRun::default();
        let keyframe_from_base = (last.keyframe_from_base * scan_match.motion).normalized();
        let before = last.keyframe;
        let pose = (self.graph.poses[before] * keyframe_from_base).normalized();
        let new = self.insert_disconnected(
            (scan.time_ns, odom_from_base),
            (&scan_match.cloud, &scan_match.ends),
            pose,
        );
        self.graph.add_edge(Edge::gap((before, new), keyframe_from_base));
        self.component = new;
        self.diagnostics.remark(scan.time_ns, RemarkKind::Kidnapped);
        ScanOutcome::Inserted
    }

    /// Inserts a keyframe at a pose that the robot did not drive to and continues from there; returns its
    /// index.
    pub(super) fn insert_disconnected(
        &mut self,
        (time_ns, odom_from_base): (i64, Option<Pose2>),
        (cloud, ends): (&Cloud, &Ends),
        map_from_base: Pose2,
    ) -> usize {
        let new = self.graph.add_pose(map_from_base);
        let travel_m = self.keyframes[self.keyframes.len() - 1].travel_m + CARRIED_M;
        self.keyframes.push(Keyframe::new(cloud, drawn_ends(ends, &self.settings), travel_m));
        self.diagnostics.begin(odom_from_base);
        self.loops.restart(new, travel_m);
        let here = Pose2::IDENTITY;
        self.nodes.push(TrajectoryNode { time_ns, keyframe: new, keyframe_from_base: here });
        self.last = Some(Last {
            time_ns,
            odom_from_base,
            keyframe: new,
            keyframe_from_base: here,
            motion: None,
            covariance: Symmetric3::ZERO,
        });
        new
    }

    /// First keyframes of all components that no closure connects to those before.
    pub(super) fn disconnected(&self) -> Vec<usize> {
        let edges = &self.graph.edges;
        let starts = edges.iter().filter(|edge| edge.is_gap()).map(|edge| edge.to);
        let is_across = |start: usize| {
            move |edge: &Edge| {
                let joins = edge.kind != ConstraintKind::Sequential && edge.weight > 0.5;
                joins && edge.from.min(edge.to) < start && edge.from.max(edge.to) >= start
            }
        };
        starts.filter(|&start| !edges.iter().any(is_across(start))).collect()
    }

    /// Moves the components that new closures connect, and everything after them, to the poses that the
    /// closures imply; optimization alone would not converge from so far.
    pub(super) fn align_components(&mut self, closures: &[Edge]) {
        let starts = self.disconnected();
        for edge in closures {
            let (old, new) = (edge.from.min(edge.to), edge.from.max(edge.to));
            let Some(&start) = starts.iter().rfind(|&&start| old < start && start <= new) else {
                continue;
            };
            let poses = &mut self.graph.poses;
            let place = if edge.from < edge.to {
                poses[edge.from] * edge.from_from_to
            } else {
                poses[edge.to] * edge.from_from_to.inverse()
            };
            let to_there = (place * poses[new].inverse()).normalized();
            for pose in &mut poses[start..] {
                *pose = (to_there * *pose).normalized();
            }
            return;
        }
    }
}
