//! Passes through one place whose walls lie side by side in the map.
//!
//! Where the map has two passes within a few metres of each other and nothing ties them, their scans are
//! laid onto each other. When they then fit clearly better than where the map has them, the map draws
//! those walls twice, too near to each other for one pass to look through the walls of the other.

use std::ops::Range;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::{Field, Fit, Placed, Prior, Symmetric3, Window, register};

use crate::audit::all_other_passes;
use crate::graph::{ConstraintKind, Edge, Graph};
use crate::keyframe::{Keyframe, between};
use crate::local::{
    against_nearest, apart, close_by, floored, grouped, heading_step, points_of, spread,
};
use crate::settings::Settings;

/// What two passes say of each other where nothing ties them.
pub(crate) struct Offset {
    /// Where the later pass lies, as seen from the earlier one, by their scans.
    pub(crate) edge: Edge,
    /// How far the map is off from it \[m\].
    pub(crate) shift_m: f64,
    /// Where, in the map.
    pub(crate) map_from_base: Pose2,
}

/// Way over which scans of a pass are taken together \[m\], and at least so many.
const STRETCH_M: f64 = 3.0;
const LEAST_SCANS: usize = 3;
/// Scans of the other pass up to so much way before and after the nearest one \[m\].
const AROUND_M: f64 = 3.0;
/// Ties within this way of both passes hold them together \[m\].
const TIED_M: f64 = 4.0;
/// Ties that leave more open than this in some direction do not count (one standard deviation) \[m\].
const FIRM_M: f64 = 0.3;
/// So far beside where the map has it a pass is looked for \[m, rad\].
const WINDOW_M: f64 = 1.5;
const WINDOW_RAD: f64 = 0.15;
/// Points searched with: their spacing, and how far away they are at most \[m\].
const SPACING_M: f32 = 0.15;
const FAR_M: f32 = 14.0;
/// Offsets below this are what maps have \[m\].
const LEAST_M: f64 = 0.15;
/// Squared Mahalanobis distance of an offset that scans are sure of.
const SURE: f64 = 30.0;

/// How much of a stretch must be seen from another pass, and agree.
#[derive(Clone, Copy)]
struct Least {
    /// Share of the points that find partners.
    matched: f64,
    /// Points that one sees of the other, both ways, for each point of the stretch.
    judged: f64,
    /// Share of those that agree.
    agreeing: f64,
}

/// Where the map has it, and elsewhere.
const HERE: Least = Least { matched: 0.5, judged: 0.4, agreeing: 0.85 };
const ELSEWHERE: Least = Least { matched: 0.6, judged: 0.6, agreeing: 0.9 };
/// Points this near to a point of the other pass lie on the same wall \[m\]. So much more of them must lie
/// so near than where the map has them.
const SAME_M: f32 = 0.1;
const CLEARLY: f64 = 0.15;
/// Mean likelihood of points that are where they were searched, at least.
const LEAST_SCORE: f64 = 0.5;
/// Another place in the window with this part of the likelihood makes it ambiguous, when it is as far
/// away as this \[m, rad\].
const RIVAL: f64 = 0.9;
const OTHER_M: f64 = 0.5;
const OTHER_RAD: f64 = 0.5;

/// Passes through the same places, held against each other.
#[derive(Default)]
pub(crate) struct Passes {
    /// Where walls lie side by side, in the order of the way.
    pub(crate) offsets: Vec<Offset>,
    /// Way that leads through places of another pass: what ties or scans confirm, and all \[m\].
    pub(crate) confirmed_m: f64,
    pub(crate) whole_m: f64,
}

/// What scans say of a stretch and another pass.
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

/// Whether something ties two passes around two kept scans.
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

/// Whether an edge holds in all directions: walls of a corridor do not hold along it.
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
    let field = Field::new(&points_of(&target), middle, &settings.local_field);
    let Some(best) = field.search(&points, &window, LEAST_SCORE, None).0 else {
        return Consistency::Uninformative;
    };
    let fit = fit_from(best.pose);
    let there = fit.target_from_moving;
    let information = floored(&fit.information);
    let turn_rad = normalize_angle(there.yaw_rad - expected.yaw_rad);
    let off = [there.x_m - expected.x_m, there.y_m - expected.y_m, turn_rad];
    let shift_m = apart(expected, there).0;
    let is_sure = shift_m > LEAST_M && information.quadratic(off) > SURE && fits(&fit, ELSEWHERE);
    let same = |pose: Pose2| part_on_walls(&moving, &target, pose);
    if !is_sure || same(there) - same(expected) < CLEARLY {
        return Consistency::Uninformative;
    }
    let elsewhere = (there, OTHER_M, OTHER_RAD);
    if field.search(&points, &window, RIVAL * best.score, Some(elsewhere)).0.is_some() {
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
