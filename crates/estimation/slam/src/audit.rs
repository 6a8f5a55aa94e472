//! The map held against itself after the last solve.
//!
//! Where the robot passed a place twice, each pass saw what the other saw, unless something moved or the
//! map is wrong there: then one pass looks through the walls of the other. Kept scans of different passes
//! that lie close together are held against each other both ways, and what they say is summed along the
//! way, so that a door or a person does not count as a wall.

use std::collections::BTreeMap;

use periplus_geometry::Pose2;
use periplus_scan_matching::Agreement;

use crate::graph::Graph;
use crate::key::Key;
use crate::local::{apart, both_ways};

/// A stretch of the way that contradicts what another pass saw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contradiction {
    /// Kept scans at its ends.
    pub(crate) keys: (usize, usize),
    /// Kept scans at the ends of the stretch of the other pass.
    pub(crate) others: (usize, usize),
    /// The kept scan in its middle.
    pub(crate) middle: usize,
    /// Share of the points that both passes can judge and that agree.
    pub(crate) agreeing: f64,
}

/// Scans of different passes this near to each other are held against each other \[m\]. A turn of a radian
/// counts as so much way \[m\].
pub(crate) const NEAR_M: f64 = 2.5;
const TURN_M: f64 = 0.5;
/// Way between two scans before they belong to different passes \[m\].
const OTHER_PASS_M: f64 = 12.0;
/// How near two points are the same \[m\].
const TOLERANCE_M: f32 = 0.2;
/// Length over which scans are summed \[m\], and points that are evidence.
const STRETCH_M: f64 = 3.0;
const JUDGED: u32 = 400;
/// Outdoors both judge few points: a stretch then grows up to so much way \[m\].
const LONGEST_M: f64 = 20.0;
/// Stretches whose scans agree on less are contradictions.
const AGREEING: f64 = 0.7;
/// Passes that each scan is held against.
const PASSES: usize = 2;

/// A scan held against another pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Held {
    pub(crate) key: usize,
    pub(crate) other: usize,
    pub(crate) other_from_key: Pose2,
    pub(crate) sum: Agreement,
}

/// All stretches that contradict another pass, in the order of the way.
pub(crate) fn audit(keys: &[Key], graph: &Graph) -> Vec<Contradiction> {
    contradictions(&passes(keys, graph), keys)
}

/// The same of scans that were held against each other before, in the order of the way.
pub(crate) fn contradictions(held: &[Held], keys: &[Key]) -> Vec<Contradiction> {
    let mut found: Vec<Contradiction> = Vec::new();
    let mut start = 0;
    while start < held.len() {
        let from_m = keys[held[start].key].travel_m;
        let mut sum = Agreement::default();
        let mut end = start;
        let goes_on = |it: &Held, judged: u32| {
            let way_m = keys[it.key].travel_m - from_m;
            way_m < STRETCH_M || (judged <= JUDGED && way_m < LONGEST_M)
        };
        while end < held.len() && goes_on(&held[end], sum.judged()) {
            sum += held[end].sum;
            end += 1;
        }
        if sum.judged() > JUDGED && sum.share() < AGREEING {
            let next = Contradiction {
                keys: (held[start].key, held[end - 1].key),
                others: other_stretch(&held[start..end], keys),
                middle: held[(start + end) / 2].key,
                agreeing: sum.share(),
            };
            match found.last_mut() {
                Some(last) if next.keys.0 <= last.keys.1 + 1 => {
                    last.keys.1 = next.keys.1;
                    if next.agreeing < last.agreeing {
                        *last = Contradiction { keys: last.keys, ..next };
                    }
                }
                _ => found.push(next),
            }
            start = end;
        } else {
            // Half a stretch on.
            let half_m = from_m + 0.5 * STRETCH_M;
            start += 1;
            while start < end && keys[held[start].key].travel_m < half_m {
                start += 1;
            }
        }
    }
    found
}

/// The stretch of the other pass that a stretch contradicts most.
fn other_stretch(held: &[Held], keys: &[Key]) -> (usize, usize) {
    let worst = held.iter().max_by_key(|it| it.sum.contradicting).map_or(0, |it| it.other);
    let is_same =
        |other: &usize| (keys[*other].travel_m - keys[worst].travel_m).abs() < OTHER_PASS_M;
    let others = || held.iter().map(|it| it.other).filter(is_same);
    (others().min().unwrap_or(worst), others().max().unwrap_or(worst))
}

/// Each scan against the nearest ones of earlier passes.
fn passes(keys: &[Key], graph: &Graph) -> Vec<Held> {
    let all = all_other_passes(keys, graph).into_iter().enumerate();
    all.flat_map(|(key, others)| others.into_iter().map(move |other| hold(keys, graph, key, other)))
        .collect()
}

/// Of each kept scan the nearest ones of earlier passes, one of each.
pub(crate) fn all_other_passes(keys: &[Key], graph: &Graph) -> Vec<Vec<usize>> {
    let cell =
        |pose: Pose2| ((pose.x_m / NEAR_M).floor() as i32, (pose.y_m / NEAR_M).floor() as i32);
    let mut cells: BTreeMap<(i32, i32), Vec<usize>> = BTreeMap::new();
    let mut all = Vec::with_capacity(keys.len());
    for key in 0..keys.len() {
        let (column, row) = cell(graph.poses[key]);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (column + x, row + y)));
        let near = around.filter_map(|there| cells.get(&there)).flatten().copied();
        all.push(other_passes(keys, graph, key, near));
        cells.entry((column, row)).or_default().push(key);
    }
    all
}

/// The nearest scans of earlier passes, one of each, among some.
pub(crate) fn other_passes(
    keys: &[Key],
    graph: &Graph,
    key: usize,
    among: impl Iterator<Item = usize>,
) -> Vec<usize> {
    let pose = graph.poses[key];
    let mut near: Vec<(f64, usize)> = among
        .filter_map(|other| {
            let (metres, radians) = apart(pose, graph.poses[other]);
            let is_other = keys[key].travel_m - keys[other].travel_m > OTHER_PASS_M;
            (is_other && metres < NEAR_M).then_some((metres + TURN_M * radians, other))
        })
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut chosen: Vec<usize> = Vec::new();
    for (_, other) in near {
        let is_same = |it: &usize| (keys[*it].travel_m - keys[other].travel_m).abs() < OTHER_PASS_M;
        if !chosen.iter().any(is_same) {
            chosen.push(other);
            if chosen.len() >= PASSES {
                break;
            }
        }
    }
    chosen
}

/// A scan held against one of another pass.
pub(crate) fn hold(keys: &[Key], graph: &Graph, key: usize, other: usize) -> Held {
    let other_from_key = graph.between(other, key);
    let (new, old) = (keys[key].cloud(), keys[other].cloud());
    let sum = both_ways(&new, &old, other_from_key, TOLERANCE_M);
    Held { key, other, other_from_key, sum }
}

/// Scans around one kept scan held against those around another, both ways; and how many points
/// that are.
pub(crate) fn overlap(
    keys: &[Key],
    graph: &Graph,
    new: usize,
    old: usize,
    around_m: f64,
) -> (Agreement, u32) {
    let beside = |of: usize| {
        let is_near = move |key: &usize| (keys[*key].travel_m - keys[of].travel_m).abs() < around_m;
        (0..keys.len()).filter(is_near)
    };
    let mut sum = Agreement::default();
    let mut all = 0;
    for key in beside(new) {
        let here = graph.poses[key];
        let distance = |other: &usize| apart(here, graph.poses[*other]).0;
        let nearest = beside(old).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(other) = nearest.filter(|it| distance(it) < 2.0 * NEAR_M) else { continue };
        let other_from_key = graph.between(other, key);
        let (a, b) = (keys[key].cloud(), keys[other].cloud());
        all += (a.points().len() + b.points().len()) as u32;
        sum += both_ways(&a, &b, other_from_key, TOLERANCE_M);
    }
    (sum, all)
}

#[cfg(test)]
mod tests {
    use periplus_scan_matching::{Cloud, CloudSettings};

    use super::*;

    #[test]
    fn scans_of_few_points_are_summed_over_more_way() {
        let check = |agreeing: u32, contradicting: u32, wanted: usize| {
            let nothing = Cloud::new([], [0.0; 2], 0.0, &CloudSettings::default());
            let keys: Vec<Key> =
                (0..60).map(|key| Key::new(&nothing, None, f64::from(key))).collect();
            let mut graph = Graph::default();
            keys.iter().for_each(|_| {
                graph.add_pose(Pose2::IDENTITY);
            });
            let sum = Agreement { agreeing, contradicting, unseen: 0 };
            let other_from_key = Pose2::IDENTITY;
            let held = (30..60).map(|key| Held { key, other: key - 30, other_from_key, sum });
            let held: Vec<Held> = held.collect();
            assert_eq!(contradictions(&held, &keys).len(), wanted);
        };
        // A scan a metre: three metres judge 600 points, 150, and 15.
        check(100, 100, 1);
        check(25, 25, 1);
        check(25, 5, 0);
        check(3, 2, 0);
    }
}
