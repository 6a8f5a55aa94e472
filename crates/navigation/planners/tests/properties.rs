//! Properties of all planners on random maps.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod common;

use common::{at, plan, plan_with};
use periplus_costmap::{Costmap, Nav2Release};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_params::{ParamValue, ParamValues};
use periplus_planners::{
    PlanErrorKind, Planner, PlannerKind, SmoothRequest, SmootherKind, navfn_cell_of,
};
use proptest::prelude::*;

fn planners() -> Vec<(&'static str, Box<dyn Planner>)> {
    let mut all: Vec<(&str, Box<dyn Planner>)> = PlannerKind::classes()
        .map(|class| {
            let kind = PlannerKind::of_class(class).unwrap();
            let values = ParamValues::defaults(kind.table());
            (class, kind.build(values, Nav2Release::Main))
        })
        .collect();
    let kind = PlannerKind::SmacHybrid;
    let mut reversing = kind.build(ParamValues::defaults(kind.table()), Nav2Release::Jazzy);
    let model = ParamValue::Text("REEDS_SHEPP".to_owned());
    reversing.set_parameter("motion_model_for_search", &model).unwrap();
    all.push(("reversing", reversing));
    all
}

fn map(width: usize, costs: &[u8]) -> Costmap {
    let height = costs.len() / width;
    let info = GridInfo::new(0.1, width, height, Pose2::new(-1.0, 2.0, 0.0)).unwrap();
    let mut map = Costmap::new(info, 0);
    map.costs_mut().copy_from_slice(&costs[..width * height]);
    map
}

fn cost() -> impl Strategy<Value = u8> {
    prop_oneof![40 => Just(0_u8), 4 => Just(254), 3 => Just(253), 2 => Just(255), 6 => 1..253_u8]
}

/// Every fifth pose may be outside the map.
fn pose() -> impl Strategy<Value = [f64; 3]> {
    [-0.2..1.2, -0.2..1.2, -7.0..7.0]
}

fn placed(map: &Costmap, [x, y, yaw_rad]: [f64; 3]) -> Pose2 {
    let (width_m, height_m) = map.info().size_m();
    Pose2::new(-1.0 + x * width_m, 2.0 + y * height_m, yaw_rad)
}

/// Cost of the cell in which a planner assumes a pose.
fn cost_of(map: &Costmap, class: &str, pose: Pose2) -> Option<u8> {
    if class.contains("Navfn") {
        navfn_cell_of(map.info(), pose.x_m, pose.y_m).and_then(|cell| map.cost(cell))
    } else {
        map.cost_at(pose.x_m, pose.y_m)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn paths_are_free_and_failures_have_reasons(
        width in 1..30_usize, costs in proptest::collection::vec(cost(), 30..600),
        start in pose(), goal in pose(),
    ) {
        let map = map(width, &costs);
        let (start, goal) = (placed(&map, start), placed(&map, goal));
        for (class, mut planner) in planners() {
            match plan(planner.as_mut(), &map, start, goal) {
                Ok(plan) => {
                    prop_assert!(!plan.poses.is_empty());
                    // The pose of the robot may be in an obstacle, and a goal may be within the tolerance.
                    let inner = plan.poses.len().saturating_sub(1).max(1);
                    for pose in &plan.poses[1..inner] {
                        prop_assert!(pose.is_finite());
                        prop_assert!(cost_of(&map, class, *pose) != Some(254), "{class}: {pose:?}");
                    }
                    let again = planner.plan_again(&map, start, goal);
                    prop_assert_eq!(again, Some(plan.poses), "{} repeats its plan", class);
                }
                Err(error) => {
                    let is_outside = |pose: Pose2| map.info().cell_of(pose.x_m, pose.y_m).is_none();
                    match error.kind {
                        PlanErrorKind::StartOutsideMap => prop_assert!(is_outside(start)),
                        PlanErrorKind::GoalOutsideMap => prop_assert!(is_outside(goal)),
                        _ => prop_assert!(error.obstruction.nearest.is_some(), "{class}: {error}"),
                    }
                }
            }
        }
    }
}

trait PlanAgain {
    fn plan_again(&mut self, map: &Costmap, start: Pose2, goal: Pose2) -> Option<Vec<Pose2>>;
}

impl PlanAgain for Box<dyn Planner> {
    fn plan_again(&mut self, map: &Costmap, start: Pose2, goal: Pose2) -> Option<Vec<Pose2>> {
        plan(self.as_mut(), map, start, goal).ok().map(|plan| plan.poses)
    }
}

/// Only every second pose of a motion was checked, as in Nav2.
#[test]
fn a_lattice_passes_through_no_obstacle_between_two_checks() {
    let mut map = map(20, &[0; 20 * 22]);
    for cell in [211, 271, 291, 293] {
        map.costs_mut()[cell] = 254;
    }
    let start = placed(&map, [0.879_407_029_926_381_9, 0.959_539_387_002_326_4, -1.882_779]);
    let goal = placed(&map, [0.843_914_594_269_059_6, 0.216_272_073_466_171_83, 0.0]);
    let kind = PlannerKind::of_class("nav2_smac_planner::SmacPlannerLattice").unwrap();
    let mut planner = kind.build(ParamValues::defaults(kind.table()), Nav2Release::Main);
    // A car that only drives forwards has no other way.
    for pose in plan(planner.as_mut(), &map, start, goal).map_or(Vec::new(), |plan| plan.poses) {
        assert_ne!(map.cost_at(pose.x_m, pose.y_m), Some(254), "{pose:?}");
    }
}

#[test]
fn special_maps_do_not_panic() {
    for (width, height) in [(1, 1), (1, 9), (9, 1), (2, 2), (3, 3), (40, 40)] {
        for cost in [0, 100, 252, 253, 254, 255] {
            let info = GridInfo::new(0.1, width, height, Pose2::IDENTITY).unwrap();
            let map = Costmap::new(info, cost);
            let last = at((width as f64 - 0.5) * 0.1, (height as f64 - 0.5) * 0.1);
            let far = at((width as f64 - 1e-9) * 0.1, (height as f64 - 1e-9) * 0.1);
            for (class, mut planner) in planners() {
                for (start, goal) in [(at(0.0, 0.0), last), (last, at(0.0, 0.0)), (far, far)] {
                    let result = plan(planner.as_mut(), &map, start, goal);
                    let is_blocked = cost == 253 || cost == 254;
                    // On the small maps the goal of NavFn is within its tolerance of the robot.
                    if is_blocked && start != goal && width == 40 {
                        assert!(result.is_err(), "{class} {width}x{height} {cost}");
                    }
                }
            }
        }
    }
}

#[test]
fn empty_maps_contain_no_start() {
    let map = Costmap::empty(0);
    for (class, mut planner) in planners() {
        let error = plan(planner.as_mut(), &map, at(0.0, 0.0), at(1.0, 0.0)).unwrap_err();
        assert_eq!(error.kind, PlanErrorKind::StartOutsideMap, "{class}");
    }
}

#[test]
fn unknown_space_is_passed_only_where_allowed() {
    let info = GridInfo::new(0.1, 60, 60, Pose2::IDENTITY).unwrap();
    let map = Costmap::new(info, 255);
    for (class, mut planner) in planners() {
        assert!(plan(planner.as_mut(), &map, at(1.5, 1.5), at(4.5, 4.0)).is_ok(), "{class}");
        planner.set_parameter("allow_unknown", &ParamValue::Bool(false)).unwrap();
        assert!(plan(planner.as_mut(), &map, at(1.5, 1.5), at(4.5, 4.0)).is_err(), "{class}");
    }
}

#[test]
fn hooks_end_a_plan() {
    let info = GridInfo::new(0.1, 60, 60, Pose2::IDENTITY).unwrap();
    let map = Costmap::new(info, 0);
    let ends = [at(1.0, 1.0), at(5.0, 5.0)];
    for (class, mut planner) in planners() {
        let _ = planner.set_parameter("terminal_checking_interval", &ParamValue::Integer(1));
        let error = plan_with(planner.as_mut(), &map, ends, [true, false]).unwrap_err();
        assert_eq!(error.kind, PlanErrorKind::Cancelled, "{class}");
        assert_eq!(error.kind.code_to_pose(), None);
        let result = plan_with(planner.as_mut(), &map, ends, [false, true]);
        match planner.max_planning_time_s() {
            Some(_) => assert_eq!(result.unwrap_err().kind, PlanErrorKind::Timeout, "{class}"),
            None => assert!(result.is_ok(), "{class} has no limit of time"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn smoothers_keep_the_ends_and_the_number_of_poses(
        points in proptest::collection::vec([-3.0..3.0, -3.0..3.0, -4.0..4.0_f64], 1..40),
    ) {
        let path: Vec<Pose2> = points.iter().map(|[x, y, yaw]| Pose2::new(*x, *y, *yaw)).collect();
        for class in SmootherKind::classes() {
            let kind = SmootherKind::of_class(class).unwrap();
            let mut smoother = kind.build(ParamValues::defaults(kind.table()));
            let is_out_of_time = &mut || false;
            let request = SmoothRequest { path: &path, costmap: None, is_out_of_time };
            let smoothed = smoother.smooth(request).unwrap();
            prop_assert_eq!(smoothed.len(), path.len());
            let ends = |path: &[Pose2]| [path[0], path[path.len() - 1]].map(|pose| (pose.x_m, pose.y_m));
            prop_assert_eq!(ends(&smoothed), ends(&path));
            prop_assert!(smoothed.iter().all(|pose| pose.is_finite()));
        }
    }
}
