//! Work in the background, in slices that are short whatever the map.

mod state;

use std::collections::VecDeque;

use periplus_geometry::Pose2;
use periplus_scan_matching::Agreement;

use super::Slam;
use crate::graph::{ConstraintKind, Edge, Outcome, Saved, Size, Solver};
use crate::local::{apart, both_ways};
use crate::loops::Loops;
use crate::proximity::proximity;

/// Queues and state of the background work.
#[derive(Default)]
pub(super) struct Work {
    /// Keys whose ties to old ones are to be looked for.
    pub(super) proximity: VecDeque<usize>,
    /// Keys for which older ones may go.
    pub(super) prunable: VecDeque<usize>,
    /// Path length at the last proximity constraint \[m\].
    pub(super) proximity_m: f64,
    solving: Option<Solving>,
    /// Ties since the map was last solved for, and whether one of them pulls.
    loose: usize,
    is_strained: bool,
    /// Keys when the map was last solved for.
    solved_at: usize,
    pub(super) proximity_count: usize,
    pub(super) searches: usize,
    pub(super) slices: usize,
    /// Number of optimization steps so far.
    pub(super) map_revision: usize,
    solves: usize,
}

/// An optimization in progress.
struct Solving {
    solver: Option<Solver>,
    /// Without a solver, what it was when a session was saved.
    resumed: Option<Saved>,
    steps: usize,
    /// Poses and edges for which the solver was made.
    size: Size,
    /// State to return to if the result is worse: poses before, and the edges on trial.
    trial: Option<(Vec<Pose2>, Vec<usize>)>,
}

/// A tie that is off by more pulls (squared Mahalanobis distance).
const TENSION_SQUARED_SIGMAS: f64 = 6.0;
/// Minimum number of keyframes between two optimizations for proximity constraints, and number of keyframes
/// for which it grows by one.
const MIN_SOLVE_INTERVAL_KEYFRAMES: usize = 4;
const SOLVE_INTERVAL_GROWTH_KEYFRAMES: usize = 60;
/// Number of satisfied proximity constraints after which the map is optimized anyway.
const MAX_UNSOLVED_CONSTRAINT_COUNT: usize = 60;
/// Products of blocks in one slice of a step: some 4 ms.
const BLOCK_PRODUCTS_PER_SLICE_COUNT: usize = 1_000_000;
/// A step that moves less is the last \[m\].
const SETTLED_M: f64 = 1e-3;
/// Ties whose squared Mahalanobis distance is far above this count little.
const OUTLIER_SQUARED_SIGMAS: f64 = 100.0;
/// Minimum fraction of newly overlapping points that must agree after a closure, and minimum number of
/// points for a verdict.
const MIN_AGREEMENT_RATIO: f64 = 0.65;
const MIN_JUDGED_POINTS: u32 = 600;
/// Number of newest keyframes checked after a closure, and maximum distance of the others \[m\].
const CHECKED_KEYFRAMES: usize = 40;
const NEAR_M: f64 = 4.0;
/// Minimum path to an old keyframe \[m\].
const OLD_M: f64 = 10.0;

/// Weight of an edge by its squared Mahalanobis distance: sequential and loop closure edges have weight 1,
/// proximity edges the weight of Geman and McClure.
fn robust(kind: ConstraintKind, chi2: f64) -> f64 {
    match kind {
        ConstraintKind::Proximity => {
            let shrink = OUTLIER_SQUARED_SIGMAS / (OUTLIER_SQUARED_SIGMAS + chi2);
            shrink * shrink
        }
        _ => 1.0,
    }
}

impl Slam {
    /// Runs at most `most` slices of background work.
    pub fn work_slices(&mut self, most: usize) {
        for _ in 0..most {
            if !self.work_slice() {
                break;
            }
        }
    }

    /// Does one slice of work; false when there is none.
    fn work_slice(&mut self) -> bool {
        // Proximity constraints first: without them the path would be searched for loops.
        if let Some(keyframe) = self.work.proximity.pop_front() {
            self.tie(keyframe);
        } else if self.work.solving.is_some() {
            self.solve_step();
        } else if self.is_to_be_solved() {
            self.solve(None);
        } else if self.loops.is_busy() {
            self.search();
        } else if let Some(keyframe) = self.work.prunable.pop_front() {
            self.prune(keyframe);
        } else {
            // Not counted: it changes nothing of the map.
            return self.settings.audits_live
                && self.live_audit.work(&self.keyframes, &self.graph, self.work.map_revision);
        }
        self.work.slices += 1;
        true
    }

    /// True if the map is to be optimized for proximity constraints in tension; the larger the map, the
    /// more keyframes share an optimization.
    fn is_to_be_solved(&self) -> bool {
        let keyframes = self.keyframes.len();
        let is_due = keyframes
            >= self.work.solved_at
                + MIN_SOLVE_INTERVAL_KEYFRAMES
                + keyframes / SOLVE_INTERVAL_GROWTH_KEYFRAMES;
        (self.work.is_strained && is_due)
            || self.work.loose
                >= MAX_UNSOLVED_CONSTRAINT_COUNT + keyframes / SOLVE_INTERVAL_GROWTH_KEYFRAMES
    }

    fn tie(&mut self, keyframe: usize) {
        for edge in proximity(&self.keyframes, &self.graph, keyframe, &self.settings) {
            self.work.is_strained |= edge.chi2(&self.graph.poses) > TENSION_SQUARED_SIGMAS;
            self.work.loose += 1;
            self.work.proximity_count += 1;
            self.work.proximity_m = self.work.proximity_m.max(self.keyframes[keyframe].travel_m);
            self.graph.add_edge(edge);
        }
        if self.settings.is_lifelong {
            self.work.prunable.push_back(keyframe);
        }
    }

    fn search(&mut self) {
        self.work.searches += 1;
        let edges = self.loops.work(&self.keyframes, &self.graph, &self.settings);
        if edges.is_empty() {
            return;
        }
        let poses = self.graph.poses.clone();
        self.align_components(&edges);
        let added = edges.into_iter().map(|edge| self.graph.add_edge(edge)).collect();
        self.solve(Some((poses, added)));
    }

    /// Starts an optimization.
    pub(super) fn solve(&mut self, trial: Option<(Vec<Pose2>, Vec<usize>)>) {
        self.work.loose = 0;
        self.work.is_strained = false;
        self.work.solved_at = self.keyframes.len();
        let size = (self.graph.poses.len(), self.graph.edges.len());
        let solving = Solving { solver: None, resumed: None, steps: 0, size, trial };
        self.work.solving = Some(solving);
    }

    /// Requests an optimization, after the current one if there is one.
    pub(super) fn solve_soon(&mut self) {
        self.work.loose +=
            MAX_UNSOLVED_CONSTRAINT_COUNT + self.keyframes.len() / SOLVE_INTERVAL_GROWTH_KEYFRAMES;
    }

    fn solve_step(&mut self) {
        let Some(mut solving) = self.work.solving.take() else { return };
        let resumed = solving.resumed.take();
        let solver = solving.solver.take();
        let solver = solver.or_else(|| {
            resumed.and_then(|it| Solver::resumed(&self.graph, solving.size, &robust, it))
        });
        let Some(mut solver) = solver else {
            // Building the solver takes one slice.
            solving.solver = Some(Solver::new(&self.graph, solving.size, self.work.solves));
            self.work.solves += 1;
            self.work.solving = Some(solving);
            return;
        };
        let outcome = solver.advance(&mut self.graph, &robust, BLOCK_PRODUCTS_PER_SLICE_COUNT);
        solving.solver = Some(solver);
        let Some(outcome) = outcome else {
            self.work.solving = Some(solving);
            return;
        };
        solving.steps += 1;
        self.work.map_revision += 1;
        let goes_on = matches!(outcome, Outcome::Moved(by) if by > SETTLED_M);
        if goes_on && solving.steps < self.settings.solve_steps {
            self.work.solving = Some(solving);
        } else if let Some((poses, edges)) = solving.trial {
            self.judge(poses, &edges);
        }
    }

    /// Keeps a closure when what now overlaps agrees, or goes back.
    fn judge(&mut self, before: Vec<Pose2>, edges: &[usize]) {
        let sum = self.overlap();
        let closed: Vec<Edge> = edges.iter().map(|&edge| self.graph.edges[edge]).collect();
        if sum.judged() > MIN_JUDGED_POINTS && sum.share() < MIN_AGREEMENT_RATIO {
            self.undo(&before, edges);
            let reason = format!(
                "undone: in the map that came of it {:.0} % of the points were seen through",
                100.0 * (1.0 - sum.share())
            );
            self.loops.reject(&closed, &reason);
            return;
        }
        let how = format!(
            "; then {} points overlap and {:.0} % agree",
            sum.judged(),
            100.0 * sum.share()
        );
        self.loops.closures_of(&closed).for_each(|told| told.reason.push_str(&how));
        // The uncertainty is gone: near scans can now be compared directly.
        self.loops.forget();
        let first = self.keyframes.len().saturating_sub(CHECKED_KEYFRAMES);
        self.work.proximity.extend(first..self.keyframes.len());
    }

    /// Goes back to the poses before some edges were on trial, which count no more.
    pub(super) fn undo(&mut self, before: &[Pose2], edges: &[usize]) {
        for &edge in edges {
            self.graph.edges[edge].weight = 0.0;
        }
        self.graph.poses[..before.len()].copy_from_slice(before);
        // Keyframes added meanwhile follow the sequential constraints.
        self.graph.hang(before.len());
    }

    /// Compares the newest keyframes with the old ones that they overlap now.
    fn overlap(&self) -> Agreement {
        let mut sum = Agreement::default();
        let first = self.keyframes.len().saturating_sub(CHECKED_KEYFRAMES);
        for keyframe in first..self.keyframes.len() {
            let here = self.graph.poses[keyframe];
            let mut near: Vec<(f64, usize)> = (0..first)
                .filter(|&old| {
                    self.keyframes[keyframe].travel_m - self.keyframes[old].travel_m > OLD_M
                })
                .map(|old| (apart(here, self.graph.poses[old]).0, old))
                .filter(|it| it.0 < NEAR_M)
                .collect();
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            for &(_, old) in near.iter().take(2) {
                let old_from_keyframe = self.graph.between(old, keyframe);
                let (a, b) = (self.keyframes[keyframe].cloud(), self.keyframes[old].cloud());
                sum += both_ways(&a, &b, old_from_keyframe, 0.25);
            }
        }
        sum
    }

    /// Adds proximity constraints that were missed while poses were uncertain, and optimizes until
    /// convergence.
    pub(super) fn settle(&mut self) {
        let is_held = |keyframe: &usize| self.graph.is_held(*keyframe);
        self.work.proximity.extend((0..self.keyframes.len()).filter(|keyframe| !is_held(keyframe)));
        self.work_slices(usize::MAX);
        self.solve(None);
        self.work_slices(usize::MAX);
        if self.settings.closes_loops {
            // Poses are known better now, except those of other components, which were searched before.
            for keyframe in Loops::unconstrained(&self.keyframes, &self.graph) {
                self.loops.ask(&self.keyframes, &self.graph, keyframe, false);
                self.work_slices(usize::MAX);
            }
        }
    }
}

impl Work {
    /// Adjusts counters after the removal of keyframes.
    pub(super) fn renumbered(&mut self, gone: usize) {
        self.solved_at = self.solved_at.saturating_sub(gone);
    }
}
