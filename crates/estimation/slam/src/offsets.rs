//! Doubled walls: passes through the same area whose walls are side by side in the map.
//!
//! Where two passes are within a few metres of each other and no constraint connects them, their scans are
//! registered. If they then match clearly better than at their poses in the map, the map draws those walls
//! twice, too near to each other for one pass to look through the walls of the other.

use std::ops::Range;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::{Fit, Placed, Prior, ScoreField, Symmetric3, Window, register};

use crate::audit::all_other_passes;
use crate::graph::{ConstraintKind, Edge, Graph};
use crate::keyframe::{Keyframe, between};
use crate::local::{
    against_nearest, apart, close_by, floored, grouped, heading_step, points_of, spread,
};
use crate::settings::Settings;

/// Relative pose of two passes that no constraint connects.
pub(crate) struct Offset {
    /// Pose of the later pass relative to the earlier one by their scans.
    pub(crate) edge: Edge,
    /// Distance from it to the relative pose in the map \[m\].
    pub(crate) shift_m: f64,
    /// Position in the map.
    pub(crate) map_from_base: Pose2,
}

/// Path over which scans of a pass are combined \[m\], and their minimum number.
const STRETCH_M: f64 = 3.0;
const LEAST_SCANS: usize = 3;
/// Path of the other pass before and after its nearest keyframe \[m\].
const AROUND_M: f64 = 3.0;
/// Ties within this way of both passes hold them together \[m\].
const TIED_M: f64 = 4.0;
/// Ties that leave more open than this in some direction do not count (one standard deviation) \[m\].
const FIRM_M: f64 = 0.3;
/// Search window around the pose in the map.
const WINDOW_M: f64 = 1.5;
const WINDOW_RAD: f64 = 0.15;
/// Points searched with: their spacing, and how far away they are at most \[m\].
const SPACING_M: f32 = 0.15;
const FAR_M: f32 = 14.0;
/// Offsets below this are what maps have \[m\].
const LEAST_M: f64 = 0.15;
/// Squared Mahalanobis distance of an offset that scans are sure of.
const CERTAIN_SQUARED_SIGMAS: f64 = 30.0;

/// Minimum overlap and agreement of a stretch with another pass.
#[derive(Clone, Copy)]
struct Least {
    /// Share of the points that find partners.
    matched: f64,
    /// Points that one sees of the other, both ways, for each point of the stretch.
    judged: f64,
    /// Share of those that agree.
    agreeing: f64,
}

/// Limits at the pose in the map, and at another pose.
const HERE: Least = Least { matched: 0.5, judged: 0.4, agreeing: 0.85 };
const ELSEWHERE: Least = Least { matched: 0.6, judged: 0.6, agreeing: 0.9 };
/// Maximum distance of two points on the same wall \[m\]; minimum increase of the fraction of such points
/// over the pose in the map.
const SAME_M: f32 = 0.1;
const CLEAR_DIFFERENCE_RATIO: f64 = 0.15;
/// Mean likelihood of points that are where they were searched, at least.
const MIN_SCORE_RATIO: f64 = 0.5;
/// A second pose in the window is ambiguous with this fraction of the likelihood, at least this far away.
const SECOND_POSE_SCORE_RATIO: f64 = 0.9;
const OTHER_M: f64 = 0.5;
const OTHER_RAD: f64 = 0.5;

/// Comparison of the passes through the same areas.
#[derive(Default)]
pub(crate) struct Passes {
    /// Doubled walls, in path order.
    pub(crate) offsets: Vec<Offset>,
    /// Path through the area of another pass: confirmed by constraints or scans, and all \[m\].
    pub(crate) confirmed_m: f64,
    pub(crate) whole_m: f64,
}

/// Result of comparing a stretch with another pass.
enum Consistency {
    /// They fit where the map has them.
    Fits,
    /// They fit clearly better elsewhere.
    Apart(Box<Offset>),
    /// Too little of one is seen from the other.
    Uninformative,
}

/// Holds all stretches against the passes that the map has within a few metres.
pub(crate) fn compare(keyframes: &[Keyframe], graph: &Graph, settings: &Settings) -> Passes {
    let mut found = Passes::default();
    let mut next_m = f64::NEG_INFINITY;
    for (new, others) in all_other_passes(keyframes, graph).into_iter().enumerate() {
        if keyframes[new].travel_m < next_m || others.is_empty() {
            continue;
        }
        next_m = keyframes[new].travel_m + STRETCH_M;
        let mut is_confirmed = false;
        for old in others {
            if is_tied(keyframes, graph, old, new) {
                is_confirmed = true;
                continue;
            }
            match word(keyframes, graph, (old, new), settings) {
                Consistency::Fits => is_confirmed = true,
                Consistency::Apart(offset) => found.offsets.push(*offset),
                Consistency::Uninformative => {}
            }
        }
        found.whole_m += STRETCH_M;
        found.confirmed_m += if is_confirmed { STRETCH_M } else { 0.0 };
    }
    found
}

/// True if a constraint connects two passes around two keyframes.
fn is_tied(keyframes: &[Keyframe], graph: &Graph, old: usize, new: usize) -> bool {
    let is_near =
        |a: usize, b: usize| (keyframes[a].travel_m - keyframes[b].travel_m).abs() < TIED_M;
    around(keyframes, new, TIED_M).any(|keyframe| {
        graph.at[keyframe].iter().any(|&edge| {
            let edge = &graph.edges[edge as usize];
            edge.kind != ConstraintKind::Sequential
                && edge.weight > 0.5
                && is_firm(edge)
                && (is_near(edge.from, old) || is_near(edge.to, old))
        })
    })
}

/// True if an edge constrains all directions; walls of a corridor do not constrain the one along it.
fn is_firm(edge: &Edge) -> bool {
    let covariance = edge.information.inverse();
    covariance.is_some_and(|it| it.largest_shift() < FIRM_M * FIRM_M)
}

fn around(keyframes: &[Keyframe], of: usize, way_m: f64) -> Range<usize> {
    between(keyframes, keyframes[of].travel_m - way_m, keyframes[of].travel_m + way_m)
}

/// Lays a stretch of one pass onto another.
fn word(
    keyframes: &[Keyframe],
    graph: &Graph,
    (old, new): (usize, usize),
    settings: &Settings,
) -> Consistency {
    let stretch: Vec<usize> = around(keyframes, new, 0.5 * STRETCH_M).collect();
    let place: Vec<usize> = around(keyframes, old, AROUND_M).collect();
    let (moving, target) =
        (grouped(keyframes, graph, &stretch, new), grouped(keyframes, graph, &place, old));
    let (moving, target) = (moving.placed(), target.placed());
    let expected = graph.between(old, new);
    // Along walls that do not hold it stays where the map has it.
    let information = Symmetric3::diagonal(
        1.0 / (WINDOW_M * WINDOW_M),
        1.0 / (WINDOW_M * WINDOW_M),
        1.0 / (WINDOW_RAD * WINDOW_RAD),
    );
    let prior = Prior { target_from_moving: expected, information };
    let how = close_by(&settings.register);
    let fit_from = |start: Pose2| register(&moving, &target, start, Some(&prior), &how);
    let all: u32 = moving.iter().map(|it| it.cloud.points().len() as u32).sum();
    // Whether both passes see the same there, and enough of it.
    let fits = |fit: &Fit, least: Least| {
        let sum = against_nearest(&moving, &target, fit.target_from_moving, 1);
        fit.matched > least.matched
            && f64::from(sum.judged()) > least.judged * f64::from(all)
            && sum.share() > least.agreeing
    };
    let near = fit_from(expected);
    // Along bare walls everything fits, wherever it is.
    let is_firm = near.firmness > 0.0;
    if is_firm && apart(expected, near.target_from_moving).0 < LEAST_M && fits(&near, HERE) {
        return Consistency::Fits;
    }
    if stretch.len() < LEAST_SCANS || place.len() < LEAST_SCANS {
        return Consistency::Uninformative;
    }
    let points = spread(&points_of(&moving), SPACING_M, FAR_M);
    let window = Window {
        middle: expected,
        half_m: [WINDOW_M; 2],
        half_rad: WINDOW_RAD,
        step_rad: heading_step(&points, settings.local_field.resolution_m),
    };
    let middle = [expected.x_m as f32, expected.y_m as f32];
    let field = ScoreField::new(&points_of(&target), middle, &settings.local_field);
    let Some(best) = field.search(&points, &window, MIN_SCORE_RATIO, None).0 else {
        return Consistency::Uninformative;
    };
    let fit = fit_from(best.pose);
    let there = fit.target_from_moving;
    let information = floored(&fit.information);
    let turn_rad = normalize_angle(there.yaw_rad - expected.yaw_rad);
    let off = [there.x_m - expected.x_m, there.y_m - expected.y_m, turn_rad];
    let shift_m = apart(expected, there).0;
    let is_sure = shift_m > LEAST_M
        && information.quadratic(off) > CERTAIN_SQUARED_SIGMAS
        && fits(&fit, ELSEWHERE);
    let same = |pose: Pose2| part_on_walls(&moving, &target, pose);
    if !is_sure || same(there) - same(expected) < CLEAR_DIFFERENCE_RATIO {
        return Consistency::Uninformative;
    }
    let elsewhere = (there, OTHER_M, OTHER_RAD);
    if field
        .search(&points, &window, SECOND_POSE_SCORE_RATIO * best.score, Some(elsewhere))
        .0
        .is_some()
    {
        return Consistency::Uninformative;
    }
    let edge = Edge::new((old, new), there, information, ConstraintKind::LoopClosure);
    let map_from_base = graph.poses[new];
    Consistency::Apart(Box::new(Offset { edge, shift_m, map_from_base }))
}

/// Part of the points of one group that lie on a wall of the other.
fn part_on_walls(new: &[Placed<'_>], old: &[Placed<'_>], old_from_new: Pose2) -> f64 {
    let (mut on, mut all) = (0u32, 0u32);
    let points = points_of(new);
    let (s, c) = libm::sincos(old_from_new.yaw_rad);
    for point in points.iter().step_by(points.len().div_ceil(600).max(1)) {
        let [x, y] = point.map(f64::from);
        let (x, y) = (c * x - s * y + old_from_new.x_m, s * x + c * y + old_from_new.y_m);
        let is_on = old.iter().any(|it| {
            let p = it.group_from_cloud.inverse() * Pose2::new(x, y, 0.0);
            it.cloud.nearest(p.x_m as f32, p.y_m as f32, SAME_M).is_some()
        });
        on += u32::from(is_on);
        all += 1;
    }
    f64::from(on) / f64::from(all.max(1))
}
