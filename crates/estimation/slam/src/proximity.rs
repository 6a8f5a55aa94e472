//! Proximity constraints: direct matches with old keyframes whose relative pose is known well enough.

use periplus_geometry::normalize_angle;
use periplus_scan_matching::{Agreement, Placed, Prior, ScoreField, Symmetric3, Window, register};

use crate::drift::{RelativeUncertainty, within};
use crate::graph::{ConstraintKind, Edge, Graph};
use crate::keyframe::Keyframe;
use crate::local::{
    apart, both_ways, close_by, floored, grouped, heading_step, points_of, sampled,
};
use crate::settings::Settings;

/// Maximum uncertainty of the relative pose \[m\], rotation included.
const MOST_M: f64 = 0.6;
/// Maximum distance of paths to them, besides the path since the last constraint \[m\].
const NEAR_M: f64 = 12.0;
/// Scans this near look at the same things \[m\].
const REACH_M: f64 = 4.0;
/// A scan is old when the robot has gone so far since \[m\].
const OLD_M: f64 = 10.0;
/// Points that the other scans must judge, the part of them that must agree, and the part of all
/// points that must find partners.
const MIN_JUDGED_POINTS: u32 = 50;
const MIN_AGREEMENT_RATIO: f64 = 0.85;
const MIN_MATCHED_RATIO: f64 = 0.6;
/// Uncertainties (3 standard deviations) beyond which the pose is searched for.
const KNOWN_M: f64 = 0.2;
const KNOWN_RAD: f64 = 0.06;
/// A match is ambiguous if another pose at least this far away has this fraction of its likelihood.
const OTHER_M: f64 = 0.5;
const SECOND_POSE_SCORE_RATIO: f64 = 0.8;
/// Squared Mahalanobis distance of what is possible: 99.9 % for 3 degrees of freedom.
const POSSIBLE_SQUARED_SIGMAS: f64 = 16.3;
/// Maximum distance of two points of the same surface \[m\].
const TOLERANCE_M: f32 = 0.2;
/// Old scans on either side of the one that is compared with.
const NEIGHBOUR_SCANS: usize = 2;
/// Ties of one scan to different visits.
const MAX_VISIT_COUNT: usize = 2;

/// Ties a key to old ones nearby whose place it knows well; gives the new edges.
pub(crate) fn proximity(
    keyframes: &[Keyframe],
    graph: &Graph,
    keyframe: usize,
    settings: &Settings,
) -> Vec<Edge> {
    // Paths to nearby old keyframes lead back to the last constraint and along an old path.
    let held =
        (0..keyframe).rev().find(|&it| graph.is_held(it)).map_or(0.0, |it| keyframes[it].travel_m);
    let reach_m = NEAR_M + (keyframes[keyframe].travel_m - held).max(0.0);
    let seen = within(graph, keyframe, MOST_M, reach_m);
    let here = graph.poses[keyframe];
    let mut candidates: Vec<(f64, RelativeUncertainty)> = seen
        .into_iter()
        .filter(|it| keyframes[keyframe].travel_m - keyframes[it.keyframe].travel_m > OLD_M)
        .filter_map(|it| {
            let (metres, radians) = apart(here, graph.poses[it.keyframe]);
            (metres < REACH_M).then_some((metres + 1.2 * radians, it))
        })
        .collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.keyframe.cmp(&b.1.keyframe)));
    let mut edges: Vec<Edge> = Vec::new();
    let mut tried: Vec<usize> = Vec::new();
    for (_, candidate) in candidates {
        let is_same_visit = |&other: &usize| {
            (keyframes[other].travel_m - keyframes[candidate.keyframe].travel_m).abs() < OLD_M
        };
        if tried.iter().any(is_same_visit) {
            continue;
        }
        let is_tied = |&edge: &u32| {
            let edge = &graph.edges[edge as usize];
            edge.kind == ConstraintKind::Proximity
                && edge.to == keyframe
                && is_same_visit(&edge.from)
        };
        if graph.at[keyframe].iter().any(is_tied) {
            tried.push(candidate.keyframe);
            continue;
        }
        tried.push(candidate.keyframe);
        edges.extend(tie(keyframes, graph, keyframe, &candidate, settings));
        if edges.len() >= MAX_VISIT_COUNT || tried.len() >= 2 * MAX_VISIT_COUNT {
            break;
        }
    }
    edges
}

/// Compares a key with an old one and those around it.
pub(crate) fn tie(
    keyframes: &[Keyframe],
    graph: &Graph,
    keyframe: usize,
    old: &RelativeUncertainty,
    settings: &Settings,
) -> Option<Edge> {
    let (from, to) = (
        old.keyframe.saturating_sub(NEIGHBOUR_SCANS),
        (old.keyframe + NEIGHBOUR_SCANS).min(keyframes.len() - 1),
    );
    let group: Vec<usize> = (from..=to).collect();
    let group = grouped(keyframes, graph, &group, old.keyframe);
    let group = group.placed();
    let expected = graph.between(old.keyframe, keyframe);
    // The sighting is as seen from the key; its size is what matters here.
    let (shift_m, turn_rad) = (old.shift_m(), old.turn_rad());
    let cloud = &keyframes[keyframe].cloud();
    let moving = [Placed::alone(cloud)];
    let prior = Prior {
        target_from_moving: expected,
        information: Symmetric3::diagonal(
            1.0 / (shift_m * shift_m).max(1e-6),
            1.0 / (shift_m * shift_m).max(1e-6),
            1.0 / (turn_rad * turn_rad).max(1e-7),
        ),
    };
    let how = close_by(&settings.register);
    let mut fit = register(&moving, &group, expected, Some(&prior), &how);
    let mut rival = None;
    if 3.0 * shift_m > KNOWN_M || 3.0 * turn_rad > KNOWN_RAD {
        let points = sampled(cloud, 120);
        let window = Window {
            middle: expected,
            half_m: [3.0 * shift_m + 0.1; 2],
            half_rad: 3.0 * turn_rad + 0.02,
            step_rad: heading_step(&points, settings.local_field.resolution_m),
        };
        let middle = [expected.x_m as f32, expected.y_m as f32];
        let field = ScoreField::new(&points_of(&group), middle, &settings.local_field);
        if let (Some(peak), _) = field.search(&points, &window, 0.25, None) {
            let other = register(&moving, &group, peak.pose, Some(&prior), &how);
            if other.cost < fit.cost {
                fit = other;
            }
            let least = SECOND_POSE_SCORE_RATIO * peak.score;
            let elsewhere = (fit.target_from_moving, OTHER_M, 0.5);
            let (second, _) = field.search(&points, &window, least, Some(elsewhere));
            rival = second.map(|peak| register(&moving, &group, peak.pose, Some(&prior), &how));
        }
    }
    // The match must be possible by the known uncertainty, in every direction.
    let found = fit.target_from_moving;
    let off = graph.between(keyframe, old.keyframe).inverse() * found.inverse();
    let off = [off.x_m, off.y_m, normalize_angle(off.yaw_rad)];
    let loose = Symmetric3::diagonal(1e-3, 1e-3, 1e-4);
    let turned = old.covariance.turned(-graph.between(keyframe, old.keyframe).yaw_rad) + loose;
    let is_possible =
        turned.inverse().is_some_and(|known| known.quadratic(off) < POSSIBLE_SQUARED_SIGMAS);
    let is_ambiguous = rival.is_some_and(|rival| {
        apart(rival.target_from_moving, found).0 > 0.5 * OTHER_M
            && rival.matched > 0.85 * fit.matched
    });
    if fit.matched < MIN_MATCHED_RATIO || !is_possible || is_ambiguous {
        return None;
    }
    let mut sum = Agreement::default();
    for one in &group {
        let one_from_key = one.group_from_cloud.inverse() * found;
        sum += both_ways(cloud, one.cloud, one_from_key, TOLERANCE_M);
    }
    if sum.judged() < MIN_JUDGED_POINTS || sum.share() < MIN_AGREEMENT_RATIO {
        return None;
    }
    let information = floored(&fit.information);
    Some(Edge::new(
        (old.keyframe, keyframe),
        fit.target_from_moving,
        information,
        ConstraintKind::Proximity,
    ))
}
