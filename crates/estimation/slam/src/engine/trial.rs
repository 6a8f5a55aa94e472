//! Final decision on closures after the last scan: those that lacked a witness are tried, and those in
//! conflict with the rest of the map are removed one after another, if that makes the map more consistent.

use super::Slam;
use crate::audit::{audit, overlap};
use crate::graph::{ConstraintKind, Edge};
use crate::local::apart;
use crate::offsets::{Offset, compare};

/// Closures that are tried, and that are left out, at most.
const MAX_TRIED_COUNT: usize = 8;
const MAX_EXCLUDED_COUNT: usize = 8;
/// Path around a closure over which its scans are compared \[m\]; number of points that must be judged (or
/// fraction of all points, if there are few); minimum fraction of them that must agree.
const AROUND_M: f64 = 6.0;
const MIN_JUDGED_POINTS: u32 = 600;
const MIN_JUDGED_RATIO: f64 = 0.15;
const MIN_AGREEMENT_RATIO: f64 = 0.9;
/// Undecided closures nearer to each other than this get one remark \[m\].
const SAME_STRETCH_M: f64 = 60.0;
/// A closure that differs from the map by less is not tried \[m, rad\].
const KNOWN_M: f64 = 0.3;
const KNOWN_RAD: f64 = 0.1;
/// A closure that is off by more is pulled at (squared Mahalanobis distance: 99.99 % for 3 degrees of
/// freedom).
const TENSION_SQUARED_SIGMAS: f64 = 21.1;

/// A kept scan around which two closures that contradict each other passed the same trial.
pub(super) struct Undecided {
    pub(super) keyframe: usize,
    /// Distance between the two poses \[m\].
    pub(super) apart_m: f64,
}

/// Result of the trial of a closure.
enum Outcome {
    Kept,
    Refused,
    Undecided { apart_m: f64 },
}

impl Slam {
    /// Tries closures that wait, the best supported first; returns those that nothing decides.
    pub(super) fn try_waiting(&mut self) -> Vec<Undecided> {
        let mut refused: Vec<(usize, usize)> = Vec::new();
        let mut undecided: Vec<Undecided> = Vec::new();
        for _ in 0..MAX_TRIED_COUNT {
            let waiting = self.loops.waiting(&self.keyframes, &self.graph);
            let next = waiting.into_iter().find(|edge| {
                let known = self.graph.between(edge.from, edge.to);
                let (metres, radians) = apart(known, edge.from_from_to);
                let is_other = metres > KNOWN_M || radians > KNOWN_RAD;
                is_other && !refused.contains(&(edge.from, edge.to))
            });
            let Some(edge) = next else { break };
            match self.try_closure(edge) {
                Outcome::Kept => continue,
                Outcome::Refused => {}
                Outcome::Undecided { apart_m } => {
                    let here_m = self.keyframes[edge.to].travel_m;
                    let is_near = |it: &Undecided| {
                        (self.keyframes[it.keyframe].travel_m - here_m).abs() < SAME_STRETCH_M
                    };
                    if !undecided.iter().any(is_near) {
                        undecided.push(Undecided { keyframe: edge.to, apart_m });
                    }
                }
            }
            refused.push((edge.from, edge.to));
        }
        undecided
    }

    /// Adds a closure and keeps it if both passes agree along it and there are no more contradictions
    /// elsewhere.
    ///
    /// In repetitive environments the best supported closure that contradicts it passes the same test: then
    /// the decision is ambiguous, and neither is kept.
    fn try_closure(&mut self, edge: Edge) -> Outcome {
        let worse = audit(&self.keyframes, &self.graph).len();
        let rival = self.loops.rival_of(&edge, &self.keyframes, &self.graph);
        let rival = rival.filter(|rival| self.trial(*rival, worse, false).is_some());
        match (self.trial(edge, worse, rival.is_none()), rival) {
            (None, _) => Outcome::Refused,
            (Some(how), None) => {
                self.loops.accept(&edge, how);
                Outcome::Kept
            }
            (Some(_), Some(rival)) => {
                let graph = &self.graph;
                let by_edge = graph.poses[edge.from] * edge.from_from_to;
                let by_rival =
                    graph.poses[rival.from] * rival.from_from_to * graph.between(rival.to, edge.to);
                let (apart_m, _) = apart(by_edge, by_rival);
                self.loops.leave_undecided(&edge, apart_m);
                Outcome::Undecided { apart_m }
            }
        }
    }

    /// Optimizes the map with a closure; returns the reason if it passes the test. The result stays if
    /// `is_kept`.
    fn trial(&mut self, edge: Edge, worse: usize, is_kept: bool) -> Option<String> {
        let poses = self.graph.poses.clone();
        self.align_components(&[edge]);
        let index = self.solve_with(edge);
        let (sum, all) = overlap(&self.keyframes, &self.graph, edge.to, edge.from, AROUND_M);
        let has_passed = sum.judged()
            > MIN_JUDGED_POINTS.min((MIN_JUDGED_RATIO * f64::from(all)) as u32)
            && sum.share() > MIN_AGREEMENT_RATIO
            && audit(&self.keyframes, &self.graph).len() <= worse;
        if !has_passed || !is_kept {
            self.undo(&poses, &[index]);
        }
        has_passed.then(|| {
            format!(
                "kept on trial when the log had ended: {} points overlap and {:.0} % agree",
                sum.judged(),
                100.0 * sum.share()
            )
        })
    }

    /// Optimizes the map with one more edge; returns its index.
    fn solve_with(&mut self, edge: Edge) -> usize {
        let index = self.graph.add_edge(edge);
        self.solve(None);
        self.work_slices(usize::MAX);
        index
    }

    /// Adds constraints between passes whose walls are doubled, the largest offset first, as long as that
    /// leaves fewer of them and no more contradictions.
    pub(super) fn join_offsets(&mut self) {
        let found = |slam: &Self| compare(&slam.keyframes, &slam.graph, &slam.settings).offsets;
        let mut left = found(self);
        let mut worse = audit(&self.keyframes, &self.graph).len();
        let mut refused: Vec<(usize, usize)> = Vec::new();
        for _ in 0..MAX_TRIED_COUNT {
            let is_new = |it: &&Offset| !refused.contains(&(it.edge.from, it.edge.to));
            let next = left.iter().filter(is_new);
            let next =
                next.max_by(|a, b| a.shift_m.total_cmp(&b.shift_m).then(b.edge.to.cmp(&a.edge.to)));
            let Some((edge, shift_m)) = next.map(|it| (it.edge, it.shift_m)) else { return };
            let poses = self.graph.poses.clone();
            let index = self.solve_with(edge);
            let after = found(self);
            let contradictions = audit(&self.keyframes, &self.graph).len();
            if after.len() < left.len() && contradictions <= worse {
                (left, worse) = (after, contradictions);
                self.loops.join(&edge, shift_m);
            } else {
                self.undo(&poses, &[index]);
                refused.push((edge.from, edge.to));
            }
        }
    }

    /// Leaves out closures in turn where passes contradict each other, and those that the others pull at.
    pub(super) fn doubt_closures(&mut self) {
        for _ in 0..MAX_EXCLUDED_COUNT {
            let worse = audit(&self.keyframes, &self.graph).len();
            let graph = &self.graph;
            let is_closure =
                |edge: &Edge| edge.kind == ConstraintKind::LoopClosure && edge.weight > 0.0;
            let pulled = graph.edges.iter().enumerate().filter(|(_, edge)| is_closure(edge));
            let pulled = pulled.map(|(index, edge)| (index, edge.chi2(&graph.poses)));
            let most = pulled.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
            let Some((index, chi2)) = most.filter(|it| it.1 > TENSION_SQUARED_SIGMAS && worse > 0)
            else {
                return;
            };
            let (poses, edge) = (graph.poses.clone(), graph.edges[index]);
            self.graph.edges[index].weight = 0.0;
            self.solve(None);
            self.work_slices(usize::MAX);
            if audit(&self.keyframes, &self.graph).len() < worse {
                let reason = format!(
                    "left out when all scans were in: the others pulled at it (squared distance \
                     {chi2:.0}), and without it fewer passes contradict each other"
                );
                self.loops.reject(&[edge], &reason);
            } else {
                self.graph.edges[index].weight = edge.weight;
                self.graph.poses = poses;
                return;
            }
        }
    }
}
