//! Hybrid-A*: paths that a car can drive.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod common;

use std::f64::consts::PI;

use common::{at, plan};
use periplus_costmap::Costmap;
use periplus_geometry::{Pose2, normalize_angle};
use periplus_grid::GridInfo;
use periplus_params::{ParamValue, ParamValues};
use periplus_planners::{Lattice, PlanErrorKind, Planner, SmacHybridPlanner, tables};
use proptest::prelude::*;

const RADIUS_M: f64 = 0.4;
/// Share by which the relaxation may tighten a turn at its ends, where the boundary curves join it.
const SMOOTHER_TOLERANCE_RATIO: f64 = 0.6;

fn planner(settings: &[(&str, ParamValue)]) -> SmacHybridPlanner {
    let values = ParamValues::defaults(&tables::SMAC_HYBRID);
    let mut planner = SmacHybridPlanner::new(values, periplus_costmap::Nav2Release::Main);
    for (name, value) in settings {
        planner.set_parameter(name, value).unwrap();
    }
    planner
}

fn reeds_shepp() -> (&'static str, ParamValue) {
    ("motion_model_for_search", ParamValue::Text("REEDS_SHEPP".to_owned()))
}

fn open_map() -> Costmap {
    Costmap::new(GridInfo::new(0.05, 160, 160, Pose2::IDENTITY).unwrap(), 0)
}

/// Map with random blocks, with the cost that the inflation of Nav2 gives at their sides.
fn blocks(cells: &[(usize, usize)]) -> Costmap {
    let mut map = open_map();
    for (column, row) in cells {
        for (dx, dy) in (0..12).flat_map(|dx| (0..12).map(move |dy| (dx, dy))) {
            let edge = [dx, dy].into_iter().map(|at: usize| at.min(11 - at)).min().unwrap();
            map.set((column + dx, row + dy), if edge < 3 { 253 } else { 254 });
        }
    }
    map
}

/// Highest curvature of the circles through three poses in a row, without cusps \[1/m\].
fn max_curvature(path: &[Pose2]) -> f64 {
    let curvature = |triple: &[Pose2]| {
        let side = |a: Pose2, b: Pose2| (b.x_m - a.x_m, b.y_m - a.y_m);
        let (a, b) = (side(triple[0], triple[1]), side(triple[1], triple[2]));
        let chord = (a.0 + b.0, a.1 + b.1);
        let length = |side: (f64, f64)| libm_hypot(side);
        let product = length(a) * length(b) * length(chord);
        let is_cusp = a.0 * b.0 + a.1 * b.1 < 0.0;
        // Poses closer than a tenth of a cell do not determine a circle.
        if is_cusp || length(a) < 0.005 || length(b) < 0.005 {
            return 0.0;
        }
        2.0 * (a.0 * b.1 - a.1 * b.0).abs() / product
    };
    path.windows(3).map(curvature).fold(0.0, f64::max)
}

fn libm_hypot((x, y): (f64, f64)) -> f64 {
    (x * x + y * y).sqrt()
}

#[test]
fn a_straight_path_is_straight() {
    let plan = plan(&mut planner(&[]), &open_map(), at(1.0, 2.0), at(7.0, 2.0)).unwrap();
    assert!((plan.length_m() - 6.0).abs() < 1e-6, "{}", plan.length_m());
    assert!(plan.poses.iter().all(|pose| (pose.y_m - 2.0).abs() < 1e-6));
}

#[test]
fn a_turn_ends_with_the_heading_of_the_goal() {
    let goal = Pose2::new(2.0, 5.0, PI);
    let plan = plan(&mut planner(&[]), &open_map(), at(4.0, 2.0), goal).unwrap();
    let last = plan.poses.last().unwrap();
    assert!(libm_hypot((last.x_m - goal.x_m, last.y_m - goal.y_m)) < 1e-6);
    assert!(normalize_angle(last.yaw_rad - PI).abs() < 1e-6, "{last:?}");
}

#[test]
fn a_car_that_reverses_goes_back_a_short_distance() {
    let (start, goal) = (at(4.0, 4.0), at(3.0, 4.0));
    let forwards = plan(&mut planner(&[]), &open_map(), start, goal).unwrap();
    let reversing = plan(&mut planner(&[reeds_shepp()]), &open_map(), start, goal).unwrap();
    assert!((reversing.length_m() - 1.0).abs() < 0.05, "{}", reversing.length_m());
    assert!(forwards.length_m() > 2.0, "a loop: {}", forwards.length_m());
}

/// Number of changes between forwards and backwards.
fn cusp_count(path: &[Pose2]) -> usize {
    let is_cusp = |triple: &[Pose2]| {
        let [a, b, c] = [triple[0], triple[1], triple[2]];
        (b.x_m - a.x_m) * (c.x_m - b.x_m) + (b.y_m - a.y_m) * (c.y_m - b.y_m) < 0.0
    };
    path.windows(3).filter(|triple| is_cusp(triple)).count()
}

/// Regression test: a car left a pose across a corridor by many short strokes.
#[test]
fn a_car_drives_few_strokes_where_cusps_cost() {
    // A corridor of 1.6 m around y = 4 m, whose costs fall from its walls.
    let mut map = open_map();
    for (column, row) in (0..160).flat_map(|x| (0..160).map(move |y| (x, y))) {
        let room_m = 0.8 - (0.05 * row as f64 + 0.025 - 4.0).abs();
        let cost = match room_m {
            ..0.0 => 254,
            ..0.14 => 253,
            _ => (252.0 * libm::exp(-3.0 * (room_m - 0.14))) as u8,
        };
        map.set((column, row), cost);
    }
    let across = |x_m: f64| Pose2::new(x_m, 4.2, PI / 2.0);
    let cusps = |penalty_m: f64| {
        let settings = [
            reeds_shepp(),
            ("minimum_turning_radius", ParamValue::Number(0.55)),
            ("cusp_penalty", ParamValue::Number(penalty_m)),
        ];
        let path = plan(&mut planner(&settings), &map, across(2.5), across(6.0)).unwrap();
        assert!(path.length_m() < 4.5, "{}", path.length_m());
        cusp_count(&path.poses)
    };
    assert_eq!([cusps(0.0), cusps(0.5)], [4, 1]);
}

#[test]
fn the_goal_may_have_any_heading() {
    let mode = |mode: &str| ("goal_heading_mode", ParamValue::Text(mode.to_owned()));
    let goal = Pose2::new(6.0, 4.0, PI);
    let length =
        |mode| plan(&mut planner(&[mode]), &open_map(), at(2.0, 4.0), goal).unwrap().length_m();
    let (fixed, any) = (length(mode("DEFAULT")), length(mode("ALL_DIRECTION")));
    let either = length(mode("BIDIRECTIONAL"));
    assert!((any - 4.0).abs() < 0.1 && (either - 4.0).abs() < 0.1, "{any} {either}");
    assert!(fixed > 4.5, "{fixed}");
}

#[test]
fn blocked_ends_have_their_codes() {
    let mut map = open_map();
    for (column, row) in (60..100).flat_map(|x| (60..100).map(move |y| (x, y))) {
        map.set((column, row), 254);
    }
    let kind = |start, goal| plan(&mut planner(&[]), &map, start, goal).unwrap_err();
    let goal = kind(at(1.0, 1.0), at(4.0, 4.0));
    assert_eq!(goal.kind, PlanErrorKind::GoalOccupied);
    assert_eq!(goal.obstruction.blocking.unwrap().cost, 254);
    assert_eq!(kind(at(4.0, 4.0), at(1.0, 1.0)).kind, PlanErrorKind::StartOccupied);
}

#[test]
fn the_iterations_are_limited() {
    let limit = ("max_iterations", ParamValue::Integer(20));
    let length = ("analytic_expansion_max_length", ParamValue::Number(0.1));
    let error = plan(&mut planner(&[limit, length]), &open_map(), at(1.0, 1.0), at(7.0, 7.0));
    assert_eq!(error.unwrap_err().kind, PlanErrorKind::Timeout);
}

#[test]
fn a_long_robot_needs_a_wide_door() {
    use periplus_costmap::{CostmapView, Footprint};
    use periplus_planners::PlanRequest;

    let mut map = open_map();
    for row in (0..160).filter(|row| !(76..84).contains(row)) {
        map.set((80, row), 254);
    }
    let found = |width_m: f64| {
        let (x, y) = (0.3, width_m / 2.0);
        let footprint = Footprint::new(vec![[x, y], [x, -y], [-x, -y], [-x, y]]);
        let costmap = CostmapView {
            costs: &map,
            footprint: &footprint,
            is_circular: false,
            tracks_unknown: true,
            inflation: None,
        };
        let (is_cancelled, is_out_of_time) = (&mut || false, &mut || false);
        let (start, goal) = (at(2.0, 4.0), at(6.0, 4.0));
        let request = PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time };
        planner(&[("max_iterations", ParamValue::Integer(20_000))]).plan(request).is_ok()
    };
    assert!(found(0.25) && !found(0.5), "the door is 0.4 m wide");
}

/// State Lattice planner with the default lattice, whose cells are those of the map.
fn lattice(reverses: bool) -> SmacHybridPlanner {
    let values = ParamValues::defaults(&tables::SMAC_LATTICE);
    let mut planner = SmacHybridPlanner::with_lattice(values, Lattice::ackermann(0.05, 0.5));
    planner.set_parameter("allow_reverse_expansion", &ParamValue::Bool(reverses)).unwrap();
    planner
}

#[test]
fn a_lattice_plans_as_a_car_drives() {
    let goal = Pose2::new(2.0, 6.0, PI / 2.0);
    let plan = plan(&mut lattice(false), &open_map(), at(5.0, 2.0), goal).unwrap();
    let last = plan.poses.last().unwrap();
    assert!(libm_hypot((last.x_m - goal.x_m, last.y_m - goal.y_m)) < 1e-6, "{last:?}");
    assert!(normalize_angle(last.yaw_rad - goal.yaw_rad).abs() < 1e-6, "{last:?}");
    assert!(plan.length_m() > 5.0 && plan.length_m() < 9.0, "{}", plan.length_m());
    let curvature = max_curvature(&plan.unsmoothed);
    assert!(curvature < 1.05 / 0.5, "{curvature}");
}

#[test]
fn a_lattice_reverses_only_where_allowed() {
    let (start, goal) = (at(4.0, 4.0), at(3.0, 4.0));
    let reversing = plan(&mut lattice(true), &open_map(), start, goal).unwrap();
    assert!((reversing.length_m() - 1.0).abs() < 0.1, "{}", reversing.length_m());
    let forwards = plan(&mut lattice(false), &open_map(), start, goal).unwrap();
    assert!(forwards.length_m() > 2.0, "{}", forwards.length_m());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn turns_are_not_tighter_than_the_minimum_radius(
        cells in proptest::collection::vec((30..120_usize, 30..120_usize), 0..8),
        start in -4.0..4.0_f64, goal in -4.0..4.0_f64, reverses: bool, interpolates: bool,
    ) {
        let map = blocks(&cells);
        let mut settings =
            vec![("allow_primitive_interpolation", ParamValue::Bool(interpolates))];
        settings.extend(reverses.then(reeds_shepp));
        let (start, goal) = (Pose2::new(0.8, 0.8, start), Pose2::new(7.2, 7.2, goal));
        if let Ok(plan) = plan(&mut planner(&settings), &map, start, goal) {
            let raw = max_curvature(&plan.unsmoothed);
            prop_assert!(raw <= 1.001 / RADIUS_M, "{raw} 1/m before smoothing");
            let smooth = max_curvature(&plan.poses);
            let limit = (1.0 + SMOOTHER_TOLERANCE_RATIO) / RADIUS_M;
            prop_assert!(smooth <= limit, "{smooth} 1/m after smoothing");
        }
    }
}
