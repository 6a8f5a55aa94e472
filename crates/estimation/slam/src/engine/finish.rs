//! End of a run: closures on trial, last refinement, warnings about the map as a whole.

use super::trial::Undecided;
use super::{LiveAudit, MapContradiction, Slam};
use crate::audit::audit;
use crate::offsets::compare;
use crate::refine::refine;
use crate::remark::{Remark, RemarkKind};

/// A map is unreliable if more scans than this, and a larger fraction, have no match.
const MIN_UNMATCHED_COUNT: usize = 5;
const MAX_UNMATCHED_RATIO: f64 = 0.1;

/// Unconfirmed path through mapped areas beyond which a map may be wrong.
struct UnconfirmedLimit {
    path_m: f64,
    /// Fraction of the whole path through mapped areas.
    ratio: f64,
}

/// Chosen in experiments 46 to 48.
const UNCONFIRMED_LIMITS: [UnconfirmedLimit; 2] =
    [UnconfirmedLimit { path_m: 25.0, ratio: 0.3 }, UnconfirmedLimit { path_m: 5.0, ratio: 0.4 }];

impl Slam {
    /// Finishes the background work, then refines all poses together. More scans may follow.
    pub fn finish(&mut self) {
        self.work_slices(usize::MAX);
        let end_ns = self.nodes.last().map_or(0, |it| it.time_ns);
        self.diagnostics.leave_corridor(end_ns);
        self.settle();
        let mut undecided = Vec::new();
        if self.settings.closes_loops && self.keyframes.len() > 1 {
            undecided = self.try_waiting();
            self.doubt_closures();
            self.join_offsets();
        }
        if self.keyframes.len() > 1 {
            // The fields of the searches are not needed after this, and the equations need much memory.
            self.loops.forget();
            refine(&self.keyframes, &mut self.graph, &self.settings);
        }
        self.conclude(end_ns, &undecided);
    }

    /// Adds remarks about the map as a whole.
    fn conclude(&mut self, end_ns: i64, undecided: &[Undecided]) {
        if self.counts.scans > 1 && self.last.as_ref().is_some_and(|it| it.odom_from_base.is_none())
        {
            self.diagnostics.remark(end_ns, RemarkKind::NoOdometry);
        }
        let ratio = self.counts.lost as f64 / self.counts.scans.max(1) as f64;
        if self.counts.lost > MIN_UNMATCHED_COUNT && ratio > MAX_UNMATCHED_RATIO {
            self.diagnostics.remark(end_ns, RemarkKind::UnmatchedScans(ratio));
        }
        match self.disconnected().len() {
            0 => {}
            count => self.diagnostics.remark(end_ns, RemarkKind::Disconnected(count)),
        }
        self.live_audit = LiveAudit::concluded(audit(&self.keyframes, &self.graph));
        self.is_finished = true;
        for Remark { time_ns, kind } in self.contradictions().iter().map(MapContradiction::remark) {
            self.diagnostics.remark(time_ns, kind);
        }
        for it in undecided {
            let time_ns = self.time_of(it.keyframe).unwrap_or(end_ns);
            let pose = self.graph.poses[it.keyframe];
            let kind = RemarkKind::AmbiguousClosure(pose.x_m, pose.y_m, it.apart_m);
            self.diagnostics.remark(time_ns, kind);
        }
        if self.settings.closes_loops {
            self.conclude_passes(end_ns);
        }
    }

    /// Adds remarks about passes through the same area that differ or confirm nothing.
    fn conclude_passes(&mut self, end_ns: i64) {
        let passes = compare(&self.keyframes, &self.graph, &self.settings);
        let open_m = passes.whole_m - passes.confirmed_m;
        let is_over = |limit: &UnconfirmedLimit| {
            open_m > limit.path_m && open_m > limit.ratio * passes.whole_m
        };
        if UNCONFIRMED_LIMITS.iter().any(is_over) {
            self.diagnostics.remark(end_ns, RemarkKind::UnconfirmedPath(open_m, passes.whole_m));
        }
        for it in passes.offsets {
            let time_ns = self.time_of(it.edge.to).unwrap_or(end_ns);
            let pose = it.map_from_base;
            let kind = RemarkKind::DoubledWalls(pose.x_m, pose.y_m, it.shift_m);
            self.diagnostics.remark(time_ns, kind);
        }
    }
}
