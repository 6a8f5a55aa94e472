//! Consistency check of the map against its own scans.
//!
//! Where the robot passed the same position twice, each pass saw what the other saw, unless something moved
//! or the map is wrong there: then one pass looks through the walls of the other. Keyframes of different
//! passes that are near each other are compared in both directions, and the results are summed along the
//! path, so that a door or a person does not count as a wall.

use std::collections::BTreeMap;

use periplus_geometry::Pose2;
use periplus_scan_matching::Agreement;

use crate::graph::Graph;
use crate::keyframe::Keyframe;
use crate::local::{apart, both_ways};

/// A stretch of path that contradicts what another pass saw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contradiction {
    /// Kept scans at its ends.
    pub(crate) keyframes: (usize, usize),
    /// Kept scans at the ends of the stretch of the other pass.
    pub(crate) others: (usize, usize),
    /// The kept scan in its middle.
    pub(crate) middle: usize,
    /// Share of the points that both passes can judge and that agree.
    pub(crate) agreeing: f64,
}

/// Maximum distance of two keyframes of different passes that are compared; a rotation of a radian counts
/// as `TURN_M`.
pub(crate) const NEAR_M: f64 = 2.5;
const TURN_M: f64 = 0.5;
/// Minimum path between two keyframes of different passes \[m\].
const OTHER_PASS_M: f64 = 12.0;
/// Maximum distance of two points of the same surface \[m\].
const TOLERANCE_M: f32 = 0.2;
/// Length over which scans are summed \[m\], and points that are evidence.
const STRETCH_M: f64 = 3.0;
const MIN_JUDGED_POINTS: u32 = 400;
/// Maximum length of a stretch outdoors, where few points are judged \[m\].
const LONGEST_M: f64 = 20.0;
/// Stretches whose scans agree on less are contradictions.
const MIN_AGREEMENT_RATIO: f64 = 0.7;
/// Maximum number of passes that each keyframe is compared with.
const MAX_PASS_COUNT: usize = 2;

/// A keyframe compared with one of another pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConstraintResidual {
    pub(crate) keyframe: usize,
    pub(crate) other: usize,
    pub(crate) other_from_keyframe: Pose2,
    pub(crate) sum: Agreement,
}

/// Returns all stretches that contradict another pass, in path order.
pub(crate) fn audit(keyframes: &[Keyframe], graph: &Graph) -> Vec<Contradiction> {
    contradictions(&passes(keyframes, graph), keyframes)
}

/// Returns all contradictions among keyframes already compared, in path order.
pub(crate) fn contradictions(
    held: &[ConstraintResidual],
    keyframes: &[Keyframe],
) -> Vec<Contradiction> {
    let mut found: Vec<Contradiction> = Vec::new();
    let mut start = 0;
    while start < held.len() {
        let from_m = keyframes[held[start].keyframe].travel_m;
        let mut sum = Agreement::default();
        let mut end = start;
        let goes_on = |it: &ConstraintResidual, judged: u32| {
            let way_m = keyframes[it.keyframe].travel_m - from_m;
            way_m < STRETCH_M || (judged <= MIN_JUDGED_POINTS && way_m < LONGEST_M)
        };
        while end < held.len() && goes_on(&held[end], sum.judged()) {
            sum += held[end].sum;
            end += 1;
        }
        if sum.judged() > MIN_JUDGED_POINTS && sum.share() < MIN_AGREEMENT_RATIO {
            let next = Contradiction {
                keyframes: (held[start].keyframe, held[end - 1].keyframe),
                others: other_stretch(&held[start..end], keyframes),
                middle: held[(start + end) / 2].keyframe,
                agreeing: sum.share(),
            };
            match found.last_mut() {
                Some(last) if next.keyframes.0 <= last.keyframes.1 + 1 => {
                    last.keyframes.1 = next.keyframes.1;
                    if next.agreeing < last.agreeing {
                        *last = Contradiction { keyframes: last.keyframes, ..next };
                    }
                }
                _ => found.push(next),
            }
            start = end;
        } else {
            // Half a stretch on.
            let half_m = from_m + 0.5 * STRETCH_M;
            start += 1;
            while start < end && keyframes[held[start].keyframe].travel_m < half_m {
                start += 1;
            }
        }
    }
    found
}

/// The stretch of the other pass that a stretch contradicts most.
fn other_stretch(held: &[ConstraintResidual], keyframes: &[Keyframe]) -> (usize, usize) {
    let worst = held.iter().max_by_key(|it| it.sum.contradicting).map_or(0, |it| it.other);
    let is_same = |other: &usize| {
        (keyframes[*other].travel_m - keyframes[worst].travel_m).abs() < OTHER_PASS_M
    };
    let others = || held.iter().map(|it| it.other).filter(is_same);
    (others().min().unwrap_or(worst), others().max().unwrap_or(worst))
}

/// Each scan against the nearest ones of earlier passes.
fn passes(keyframes: &[Keyframe], graph: &Graph) -> Vec<ConstraintResidual> {
    let all = all_other_passes(keyframes, graph).into_iter().enumerate();
    all.flat_map(|(keyframe, others)| {
        others.into_iter().map(move |other| hold(keyframes, graph, keyframe, other))
    })
    .collect()
}

/// Returns, for each keyframe, the nearest keyframes of earlier passes, one per pass.
pub(crate) fn all_other_passes(keyframes: &[Keyframe], graph: &Graph) -> Vec<Vec<usize>> {
    let cell =
        |pose: Pose2| ((pose.x_m / NEAR_M).floor() as i32, (pose.y_m / NEAR_M).floor() as i32);
    let mut cells: BTreeMap<(i32, i32), Vec<usize>> = BTreeMap::new();
    let mut all = Vec::with_capacity(keyframes.len());
    for keyframe in 0..keyframes.len() {
        let (column, row) = cell(graph.poses[keyframe]);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (column + x, row + y)));
        let near = around.filter_map(|there| cells.get(&there)).flatten().copied();
        all.push(other_passes(keyframes, graph, keyframe, near));
        cells.entry((column, row)).or_default().push(keyframe);
    }
    all
}

/// The nearest scans of earlier passes, one of each, among some.
pub(crate) fn other_passes(
    keyframes: &[Keyframe],
    graph: &Graph,
    keyframe: usize,
    among: impl Iterator<Item = usize>,
) -> Vec<usize> {
    let pose = graph.poses[keyframe];
    let mut near: Vec<(f64, usize)> = among
        .filter_map(|other| {
            let (metres, radians) = apart(pose, graph.poses[other]);
            let is_other = keyframes[keyframe].travel_m - keyframes[other].travel_m > OTHER_PASS_M;
            (is_other && metres < NEAR_M).then_some((metres + TURN_M * radians, other))
        })
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut chosen: Vec<usize> = Vec::new();
    for (_, other) in near {
        let is_same =
            |it: &usize| (keyframes[*it].travel_m - keyframes[other].travel_m).abs() < OTHER_PASS_M;
        if !chosen.iter().any(is_same) {
            chosen.push(other);
            if chosen.len() >= MAX_PASS_COUNT {
                break;
            }
        }
    }
    chosen
}

/// Compares a keyframe with one of another pass.
pub(crate) fn hold(
    keyframes: &[Keyframe],
    graph: &Graph,
    keyframe: usize,
    other: usize,
) -> ConstraintResidual {
    let other_from_keyframe = graph.between(other, keyframe);
    let (new, old) = (keyframes[keyframe].cloud(), keyframes[other].cloud());
    let sum = both_ways(&new, &old, other_from_keyframe, TOLERANCE_M);
    ConstraintResidual { keyframe, other, other_from_keyframe, sum }
}

/// Compares the scans around two keyframes with each other in both directions; also returns the number of
/// their points.
pub(crate) fn overlap(
    keyframes: &[Keyframe],
    graph: &Graph,
    new: usize,
    old: usize,
    around_m: f64,
) -> (Agreement, u32) {
    let beside = |of: usize| {
        let is_near = move |keyframe: &usize| {
            (keyframes[*keyframe].travel_m - keyframes[of].travel_m).abs() < around_m
        };
        (0..keyframes.len()).filter(is_near)
    };
    let mut sum = Agreement::default();
    let mut all = 0;
    for keyframe in beside(new) {
        let here = graph.poses[keyframe];
        let distance = |other: &usize| apart(here, graph.poses[*other]).0;
        let nearest = beside(old).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(other) = nearest.filter(|it| distance(it) < 2.0 * NEAR_M) else { continue };
        let other_from_keyframe = graph.between(other, keyframe);
        let (a, b) = (keyframes[keyframe].cloud(), keyframes[other].cloud());
        all += (a.points().len() + b.points().len()) as u32;
        sum += both_ways(&a, &b, other_from_keyframe, TOLERANCE_M);
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
            let keyframes: Vec<Keyframe> = (0..60)
                .map(|keyframe| Keyframe::new(&nothing, None, f64::from(keyframe)))
                .collect();
            let mut graph = Graph::default();
            keyframes.iter().for_each(|_| {
                graph.add_pose(Pose2::IDENTITY);
            });
            let sum = Agreement { agreeing, contradicting, unseen: 0 };
            let other_from_keyframe = Pose2::IDENTITY;
            let held = (30..60).map(|keyframe| ConstraintResidual {
                keyframe,
                other: keyframe - 30,
                other_from_keyframe,
                sum,
            });
            let held: Vec<ConstraintResidual> = held.collect();
            assert_eq!(contradictions(&held, &keyframes).len(), wanted);
        };
        // A scan a metre: three metres judge 600 points, 150, and 15.
        check(100, 100, 1);
        check(25, 25, 1);
        check(25, 5, 0);
        check(3, 2, 0);
    }
}
