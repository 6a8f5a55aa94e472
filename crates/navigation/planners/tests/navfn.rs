//! NavFn on small maps.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod common;

use common::{at, costmap, plan};
use periplus_geometry::Pose2;
use periplus_params::ParamValue;
use periplus_planners::{NavFnPlanner, ParameterRejected, PlanErrorKind, Planner};

const ROOM: [&str; 8] = [
    "............",
    ".....##.....",
    ".....##.....",
    ".....##.....",
    ".....##.....",
    ".....##.....",
    "............",
    "............",
];

#[test]
fn a_path_leads_around_a_wall_and_ends_at_the_goal() {
    let goal = Pose2::new(0.9, 0.4, 1.5);
    let plan = plan(&mut NavFnPlanner::default(), &costmap(&ROOM), at(0.2, 0.4), goal).unwrap();
    assert_eq!(plan.poses.last(), Some(&goal));
    assert_eq!(plan.poses[0], at(0.2, 0.4), "the corner of the cell of the robot");
    assert_eq!(plan.cleared_cell, Some((2, 4)));
    assert!(plan.poses.iter().any(|pose| pose.y_m < 0.2), "below the wall");
    assert!(plan.length_m() > 0.85 && plan.length_m() < 1.1, "{}", plan.length_m());
}

#[test]
fn a_goal_behind_walls_is_explained() {
    let closed =
        costmap(&["............", ".....####...", ".....#..#...", ".....####...", "............"]);
    let mut planner = NavFnPlanner::default();
    planner.set_parameter("tolerance", &ParamValue::Number(0.05)).unwrap();
    let error = plan(&mut planner, &closed, at(0.15, 0.25), at(0.65, 0.25)).unwrap_err();
    assert_eq!(error.kind, PlanErrorKind::NoValidPath);
    assert_eq!(error.kind.code_to_pose(), Some(208));
    assert_eq!(error.message, "Failed to create plan with tolerance of: 0.050000");
    let blocking = error.obstruction.blocking.unwrap();
    assert_eq!((blocking.cell, blocking.cost), ((6, 1), 254));
    let nearest = error.obstruction.nearest.unwrap();
    assert!((nearest.distance_m - 0.2).abs() < 1e-9, "{nearest:?}");
    assert_eq!(
        error.to_string(),
        "Failed to create plan with tolerance of: 0.050000; the direct line to the goal is blocked by cell (6, 1) \
         at (0.65, 0.15) with cost 254 (an obstacle); the nearest reachable position is (0.65, 0.05), 0.20 m from \
         the goal"
    );
}

#[test]
fn a_robot_beside_a_wall_gets_a_path_away() {
    let costs = costmap(&["#iiii.......", "#iiii.......", "#iiii.......", "#iiii......."]);
    for (use_astar, start) in [(false, at(0.2, 0.2)), (true, at(0.3, 0.1))] {
        let mut planner = NavFnPlanner::default();
        planner.set_parameter("use_astar", &ParamValue::Bool(use_astar)).unwrap();
        let plan = plan(&mut planner, &costs, start, at(0.9, 0.2)).unwrap();
        assert!(plan.length_m() < 0.75, "{}", plan.length_m());
    }
}

#[test]
fn poses_outside_the_map_are_named() {
    let room = costmap(&ROOM);
    let mut planner = NavFnPlanner::default();
    let kind = |start, goal, planner: &mut NavFnPlanner| {
        plan(planner, &room, start, goal).unwrap_err().kind
    };
    assert_eq!(kind(at(-0.1, 0.4), at(0.9, 0.4), &mut planner), PlanErrorKind::StartOutsideMap);
    assert_eq!(kind(at(0.2, 0.4), at(0.9, 9.4), &mut planner), PlanErrorKind::GoalOutsideMap);
    assert_eq!(kind(at(0.2, f64::NAN), at(0.9, 0.4), &mut planner), PlanErrorKind::StartOutsideMap);
}

#[test]
fn equal_positions_give_one_pose() {
    let goal = Pose2::new(0.2, 0.4, 1.0);
    let room = costmap(&ROOM);
    let plan = plan(&mut NavFnPlanner::default(), &room, at(0.2, 0.4), goal).unwrap();
    assert_eq!((plan.poses, plan.cleared_cell), (vec![goal], None));
}

#[test]
fn dijkstra_and_a_star_agree_on_short_paths() {
    let (start, goal) = (at(0.2, 0.4), at(0.9, 0.4));
    let dijkstra = plan(&mut NavFnPlanner::default(), &costmap(&ROOM), start, goal).unwrap();
    let mut planner = NavFnPlanner::default();
    planner.set_parameter("use_astar", &ParamValue::Bool(true)).unwrap();
    let a_star = plan(&mut planner, &costmap(&ROOM), start, goal).unwrap();
    assert!((dijkstra.length_m() - a_star.length_m()).abs() < 0.1);
}

#[test]
fn changes_follow_the_rules_of_nav2() {
    let mut planner = NavFnPlanner::default();
    let zero = planner.set_parameter("tolerance", &ParamValue::Number(0.0)).unwrap_err();
    assert_eq!(zero.to_string(), "`tolerance`: it must be above 0 while the node runs");
    let factor = planner.set_parameter("max_cycles_factor", &ParamValue::Integer(0));
    assert!(matches!(factor, Err(ParameterRejected::Value("max_cycles_factor", _))));
    let unknown = planner.set_parameter("tolerence", &ParamValue::Number(0.1)).unwrap_err();
    assert_eq!(unknown.to_string(), "there is no parameter `tolerence`; did you mean `tolerance`?");
}
