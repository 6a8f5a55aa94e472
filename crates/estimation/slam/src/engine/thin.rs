//! Scans that a newer one has made superfluous go: a map that lives for ever in a bounded place.

use std::collections::{BTreeSet, VecDeque};

use periplus_scan_matching::{Symmetric3, agreement};

use super::Slam;
use crate::graph::{Edge, Graph, Kind};
use crate::local::apart;

/// Way after which another scan is of an earlier visit \[m\].
const VISIT_M: f64 = 10.0;
/// How near points must be to be the same \[m\].
const TOLERANCE_M: f32 = 0.2;
/// A scan shows what another one showed when it can tell of so many of its points whether they are
/// still there.
const COVERED: f64 = 0.75;
/// Scans are taken from the same place within so many times the way from key to key.
const BESIDE: f64 = 1.2;
/// Ties and closures of one key, at most.
const MOST_TIES: usize = 8;
/// Poses of scans that were not kept are remembered for the last so many.
const REMEMBERED: usize = 1000;

impl Slam {
    /// Lets go of kept scans of earlier visits that a newer one makes superfluous. It has to be tied
    /// to the map by more than its chain, or its place is no better known than odometry knows it.
    pub(super) fn thin(&mut self, key: usize) {
        if key >= self.keys.len() || !self.graph.is_held(key) {
            return;
        }
        let here = self.graph.poses[key];
        let reach_m = BESIDE * self.settings.key_shift_m;
        let is_gone = |&old: &usize| {
            self.keys[key].travel_m - self.keys[old].travel_m > VISIT_M
                && apart(here, self.graph.poses[old]).0 < reach_m
                && self.is_covered(old, key)
        };
        // Where the map began stays: it holds the rest in place.
        let gone: BTreeSet<usize> = (1..key).filter(is_gone).collect();
        if !gone.is_empty() {
            self.let_go(&gone);
        }
    }

    /// Whether one scan sees all that another one saw, or that it is there no more.
    fn is_covered(&self, old: usize, new: usize) -> bool {
        let (cloud, by) = (self.keys[old].cloud(), self.keys[new].cloud());
        let sum = agreement(&cloud, &by, self.graph.between(new, old), TOLERANCE_M);
        f64::from(sum.judged()) >= COVERED * cloud.points().len() as f64
    }

    /// Forgets keys. What they held together hangs on their neighbours from now on.
    fn let_go(&mut self, gone: &BTreeSet<usize>) {
        for &key in gone {
            bypass(&mut self.graph, key);
        }
        let mut number = vec![None; self.keys.len()];
        let left = (0..self.keys.len()).filter(|key| !gone.contains(key));
        for (new, old) in left.enumerate() {
            number[old] = Some(new);
        }
        let old = std::mem::take(&mut self.graph);
        for (key, pose) in old.poses.into_iter().enumerate() {
            if number[key].is_some() {
                self.graph.add_pose(pose);
            }
        }
        for edge in old.edges {
            if let (Some(from), Some(to)) = (number[edge.from], number[edge.to]) {
                self.graph.add_edge(Edge { from, to, ..edge });
            }
        }
        let mut key = 0;
        self.keys.retain(|_| {
            key += 1;
            number[key - 1].is_some()
        });
        let recent = self.tracks.len().saturating_sub(REMEMBERED);
        let mut at = 0;
        let mut first_of = 0;
        self.tracks.retain_mut(|track| {
            at += 1;
            let Some(new) = number[track.key] else { return false };
            track.key = new;
            // Every key keeps the line that it came with.
            let is_first = new == first_of;
            first_of += usize::from(is_first);
            is_first || at > recent
        });
        self.piece = number[self.piece..].iter().find_map(|it| *it).unwrap_or(0);
        if let Some(last) = &mut self.last
            && let Some(new) = number[last.key]
        {
            last.key = new;
        }
        let renumber = |queue: &mut VecDeque<usize>| {
            *queue = queue.iter().filter_map(|&key| *number.get(key)?).collect();
        };
        renumber(&mut self.work.ties);
        renumber(&mut self.work.thins);
        self.work.renumbered(gone.len());
        self.loops.renumber(&number);
        self.live_audit.renumber(&number);
    }
}

/// Hangs everything at a key on the one before it: edges that lead through it become edges past it.
fn bypass(graph: &mut Graph, key: usize) {
    let at: Vec<usize> = graph.at[key].iter().map(|&index| index as usize).collect();
    let before = at
        .iter()
        .map(|&index| graph.edges[index])
        .find(|it| it.kind == Kind::Chain && it.to == key && it.weight > 0.0);
    for index in at {
        let edge = graph.edges[index];
        // It is gone with the key, and must not be hung on again with the next one that goes.
        if std::mem::replace(&mut graph.edges[index].weight, 0.0) <= 0.0 {
            continue;
        }
        let Some(before) = before else { continue };
        let other = if edge.from == key { edge.to } else { edge.from };
        if other == before.from {
            continue;
        }
        // Chains must not break; of the rest a few are enough.
        let is_chain = edge.kind == Kind::Chain && edge.from == key;
        let is_known = graph.at[before.from].iter().any(|&index| {
            let it = &graph.edges[index as usize];
            it.weight > 0.0 && (it.from == other || it.to == other)
        });
        let is_full = |graph: &Graph, key: usize| {
            let at = graph.at[key].iter().map(|&index| &graph.edges[index as usize]);
            at.filter(|it| it.kind != Kind::Chain && it.weight > 0.0).count() >= MOST_TIES
        };
        let is_needless = is_known || is_full(graph, before.from) || is_full(graph, other);
        if is_chain || !is_needless {
            let past = joined(&before, &edge, key);
            graph.add_edge(past);
        }
    }
}

/// The edge from where one leads to a key to where another leads on from it.
fn joined(before: &Edge, edge: &Edge, key: usize) -> Edge {
    let (key_from_other, other, beyond) = if edge.from == key {
        (edge.from_from_to, edge.to, edge.covariances[0])
    } else {
        (edge.from_from_to.inverse().normalized(), edge.from, edge.covariances[1])
    };
    let start_from_key = before.from_from_to;
    let start_from_other = (start_from_key * key_from_other).normalized();
    let sum = |first: &Symmetric3, second: &Symmetric3| {
        first.compounded(start_from_key, key_from_other, second)
    };
    let known = |edge: &Edge, is_along: bool| {
        let covariance = edge.information.inverse().unwrap_or(edge.covariances[0]);
        if is_along { covariance } else { crate::drift::reversed(&covariance, edge.from_from_to) }
    };
    let covariance = sum(&known(before, true), &known(edge, edge.from == key));
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
