//! Removal of keyframes that newer ones make redundant: lifelong mapping in a bounded area.

use std::collections::{BTreeSet, VecDeque};

use periplus_scan_matching::{Symmetric3, agreement};

use super::Slam;
use crate::graph::{ConstraintKind, Edge, Graph};
use crate::local::apart;

/// Minimum path between two visits of the same area \[m\].
const VISIT_M: f64 = 10.0;
/// Maximum distance of two points of the same surface \[m\].
const TOLERANCE_M: f32 = 0.2;
/// Minimum fraction of the points of a scan that the newer scan must observe, present or gone.
const MIN_COVERED_RATIO: f64 = 0.75;
/// Maximum distance between redundant keyframes, relative to the keyframe distance.
const REDUNDANT_DISTANCE_FACTOR: f64 = 1.2;
/// Ties and closures of one key, at most.
const MAX_CONSTRAINT_COUNT: usize = 8;
/// Number of recent trajectory nodes kept besides those of keyframes.
const RECENT_TRAJECTORY_NODES: usize = 1000;

impl Slam {
    /// Removes keyframes of earlier visits that a newer one makes redundant. The newer one must have a
    /// constraint besides its sequential one; otherwise its pose is only as good as odometry.
    pub(super) fn prune(&mut self, keyframe: usize) {
        if keyframe >= self.keyframes.len() || !self.graph.is_held(keyframe) {
            return;
        }
        let here = self.graph.poses[keyframe];
        let reach_m = REDUNDANT_DISTANCE_FACTOR * self.settings.keyframe_distance_m;
        let is_gone = |&old: &usize| {
            self.keyframes[keyframe].travel_m - self.keyframes[old].travel_m > VISIT_M
                && apart(here, self.graph.poses[old]).0 < reach_m
                && self.is_covered(old, keyframe)
        };
        // Where the map began stays: it holds the rest in place.
        let gone: BTreeSet<usize> = (1..keyframe).filter(is_gone).collect();
        if !gone.is_empty() {
            self.let_go(&gone);
        }
    }

    /// True if one scan observes all that another one saw, present or gone.
    fn is_covered(&self, old: usize, new: usize) -> bool {
        let (cloud, by) = (self.keyframes[old].cloud(), self.keyframes[new].cloud());
        let sum = agreement(&cloud, &by, self.graph.between(new, old), TOLERANCE_M);
        f64::from(sum.judged()) >= MIN_COVERED_RATIO * cloud.points().len() as f64
    }

    /// Removes keyframes; their constraints pass to their neighbours.
    fn let_go(&mut self, gone: &BTreeSet<usize>) {
        for &keyframe in gone {
            bypass(&mut self.graph, keyframe);
        }
        let mut number = vec![None; self.keyframes.len()];
        let left = (0..self.keyframes.len()).filter(|keyframe| !gone.contains(keyframe));
        for (new, old) in left.enumerate() {
            number[old] = Some(new);
        }
        let old = std::mem::take(&mut self.graph);
        for (keyframe, pose) in old.poses.into_iter().enumerate() {
            if number[keyframe].is_some() {
                self.graph.add_pose(pose);
            }
        }
        for edge in old.edges {
            if let (Some(from), Some(to)) = (number[edge.from], number[edge.to]) {
                self.graph.add_edge(Edge { from, to, ..edge });
            }
        }
        let mut keyframe = 0;
        self.keyframes.retain(|_| {
            keyframe += 1;
            number[keyframe - 1].is_some()
        });
        let recent = self.nodes.len().saturating_sub(RECENT_TRAJECTORY_NODES);
        let mut at = 0;
        let mut first_of = 0;
        self.nodes.retain_mut(|node| {
            at += 1;
            let Some(new) = number[node.keyframe] else { return false };
            node.keyframe = new;
            // Every key keeps the line that it came with.
            let is_first = new == first_of;
            first_of += usize::from(is_first);
            is_first || at > recent
        });
        self.component = number[self.component..].iter().find_map(|it| *it).unwrap_or(0);
        if let Some(last) = &mut self.last
            && let Some(new) = number[last.keyframe]
        {
            last.keyframe = new;
        }
        let renumber = |queue: &mut VecDeque<usize>| {
            *queue = queue.iter().filter_map(|&keyframe| *number.get(keyframe)?).collect();
        };
        renumber(&mut self.work.proximity);
        renumber(&mut self.work.prunable);
        self.work.renumbered(gone.len());
        self.loops.renumber(&number);
        self.live_audit.renumber(&number);
    }
}

/// Hangs everything at a key on the one before it: edges that lead through it become edges past it.
fn bypass(graph: &mut Graph, keyframe: usize) {
    let at: Vec<usize> = graph.at[keyframe].iter().map(|&index| index as usize).collect();
    let before = at
        .iter()
        .map(|&index| graph.edges[index])
        .find(|it| it.kind == ConstraintKind::Sequential && it.to == keyframe && it.weight > 0.0);
    for index in at {
        let edge = graph.edges[index];
        // The edge is removed with the keyframe, and must not be passed on again with the next one.
        if std::mem::replace(&mut graph.edges[index].weight, 0.0) <= 0.0 {
            continue;
        }
        let Some(before) = before else { continue };
        let other = if edge.from == keyframe { edge.to } else { edge.from };
        if other == before.from {
            continue;
        }
        // Chains must not break; of the rest a few are enough.
        let is_chain = edge.kind == ConstraintKind::Sequential && edge.from == keyframe;
        let is_known = graph.at[before.from].iter().any(|&index| {
            let it = &graph.edges[index as usize];
            it.weight > 0.0 && (it.from == other || it.to == other)
        });
        let is_full = |graph: &Graph, keyframe: usize| {
            let at = graph.at[keyframe].iter().map(|&index| &graph.edges[index as usize]);
            at.filter(|it| it.kind != ConstraintKind::Sequential && it.weight > 0.0).count()
                >= MAX_CONSTRAINT_COUNT
        };
        let is_needless = is_known || is_full(graph, before.from) || is_full(graph, other);
        if is_chain || !is_needless {
            let past = joined(&before, &edge, keyframe);
            graph.add_edge(past);
        }
    }
}

/// The edge from where one leads to a key to where another leads on from it.
fn joined(before: &Edge, edge: &Edge, keyframe: usize) -> Edge {
    let (keyframe_from_other, other, beyond) = if edge.from == keyframe {
        (edge.from_from_to, edge.to, edge.covariances[0])
    } else {
        (edge.from_from_to.inverse().normalized(), edge.from, edge.covariances[1])
    };
    let start_from_keyframe = before.from_from_to;
    let start_from_other = (start_from_keyframe * keyframe_from_other).normalized();
    let sum = |first: &Symmetric3, second: &Symmetric3| {
        first.compounded(start_from_keyframe, keyframe_from_other, second)
    };
    let known = |edge: &Edge, is_along: bool| {
        let covariance = edge.information.inverse().unwrap_or(edge.covariances[0]);
        if is_along { covariance } else { crate::drift::reversed(&covariance, edge.from_from_to) }
    };
    let covariance = sum(&known(before, true), &known(edge, edge.from == keyframe));
    let doubted = sum(&before.covariances[0], &beyond);
    let inverse = |it: &Symmetric3| it.inverse().unwrap_or(Symmetric3::diagonal(1.0, 1.0, 1.0));
    let (start, information) = (before.from, inverse(&covariance));
    // From the earlier to the later one, as everywhere.
    if start < other {
        let edge = Edge::new((start, other), start_from_other, information, edge.kind);
        edge.doubting(&inverse(&doubted))
    } else {
        let other_from_start = start_from_other.inverse().normalized();
        let back = |it: &Symmetric3| inverse(&crate::drift::reversed(it, start_from_other));
        let edge = Edge::new((other, start), other_from_start, back(&covariance), edge.kind);
        edge.doubting(&back(&doubted))
    }
}
