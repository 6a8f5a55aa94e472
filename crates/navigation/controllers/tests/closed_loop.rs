//! Each controller drives a kinematic robot around a corner to its goal, and stops for an obstacle with a reason.

#![allow(clippy::unwrap_used, reason = "tests")]

use periplus_controllers::ros1::create_local_goal_checker;
use periplus_controllers::{
    ControlError, ControlInput, Controller, GivenParameters, GoalChecker, GoalQuery, GoalStatus,
    PathHandler, PluginSetup, create_controller, create_goal_checker,
};
use periplus_costmap::{Costmap, CostmapView, Footprint, InflationLaw, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2};
use periplus_grid::GridInfo;
use periplus_params::Given;

const PERIOD_S: f64 = 0.05;
const RADIUS_M: f64 = 0.2;

const RPP: &str = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController";
const GRACEFUL: &str = "nav2_graceful_controller::GracefulController";
const SHIM: &str = "nav2_rotation_shim_controller::RotationShimController";
const DWB: &str = "dwb_core::DWBLocalPlanner";
const DWA: &str = "dwa_local_planner/DWAPlannerROS";
const ROLLOUT: &str = "base_local_planner/TrajectoryPlannerROS";
const TEB: &str = "teb_local_planner/TebLocalPlannerROS";

/// DWB as in the stock file of Humble.
const STOCK_DWB: &[(&str, &str)] = &[
    ("max_vel_x", "0.26"),
    ("max_vel_theta", "1.0"),
    ("max_speed_xy", "0.26"),
    ("acc_lim_x", "2.5"),
    ("acc_lim_theta", "3.2"),
    ("decel_lim_x", "-2.5"),
    ("decel_lim_theta", "-3.2"),
    ("linear_granularity", "0.05"),
    (
        "critics",
        "[RotateToGoal, Oscillation, BaseObstacle, GoalAlign, PathAlign, PathDist, GoalDist]",
    ),
    ("BaseObstacle.scale", "0.02"),
    ("PathAlign.scale", "32.0"),
    ("PathAlign.forward_point_distance", "0.1"),
    ("GoalAlign.scale", "24.0"),
    ("GoalAlign.forward_point_distance", "0.1"),
    ("PathDist.scale", "32.0"),
    ("GoalDist.scale", "24.0"),
    ("RotateToGoal.scale", "32.0"),
];

/// A plan of 2 m along x and then 2 m along y.
fn corner() -> Vec<Pose2> {
    let along = |step: i32| 0.05 * f64::from(step);
    let first = (0..40).map(|step| Pose2::new(along(step), 0.0, 0.0));
    let yaw_rad = std::f64::consts::FRAC_PI_2;
    first.chain((0..=40).map(|step| Pose2::new(2.0, along(step), yaw_rad))).collect()
}

/// A costmap around the plan with obstacles at points, inflated to the radius of the robot.
fn costmap(obstacles: &[(f64, f64)]) -> Costmap {
    let info = GridInfo::new(0.05, 160, 160, Pose2::new(-3.0, -3.0, 0.0)).unwrap();
    let mut costmap = Costmap::new(info, 0);
    for index in 0..info.len() {
        let cell = info.cell(index);
        let (x_m, y_m) = info.centre_of(cell);
        let away = |&(ox_m, oy_m): &(f64, f64)| libm::hypot(x_m - ox_m, y_m - oy_m);
        let nearest_m = obstacles.iter().map(away).fold(f64::INFINITY, f64::min);
        if nearest_m < 0.05 {
            costmap.set(cell, 254);
        } else if nearest_m <= RADIUS_M {
            costmap.set(cell, 253);
        }
    }
    costmap
}

struct World {
    costmap: Costmap,
    footprint: Footprint,
}

impl World {
    fn new(obstacles: &[(f64, f64)]) -> Self {
        Self { costmap: costmap(obstacles), footprint: Footprint::circle(RADIUS_M) }
    }

    fn view(&self) -> CostmapView<'_> {
        CostmapView {
            costs: &self.costmap,
            footprint: &self.footprint,
            is_circular: true,
            tracks_unknown: true,
            inflation: Some(InflationLaw { radius_m: RADIUS_M, scaling_per_m: 3.0 }),
        }
    }
}

struct Robot {
    controller: Box<dyn Controller>,
    goal_checker: Box<dyn GoalChecker>,
    path_handler: PathHandler,
}

fn setup<'a>(given: &'a [(&'a str, &'a str)], release: Nav2Release) -> PluginSetup<'a> {
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    PluginSetup {
        release,
        control_period_s: PERIOD_S,
        given: GivenParameters::new(given),
        ..PluginSetup::new("FollowPath")
    }
}

fn robot(class: &str, given: &[(&str, &str)], release: Nav2Release) -> Robot {
    let mut diagnostics = Diagnostics::new();
    let setup = setup(given, release);
    let controller = create_controller(class, &setup, &mut diagnostics).unwrap();
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    let goal_checker = create_local_goal_checker(class, &setup).unwrap_or_else(|| {
        let setup = PluginSetup { release, ..PluginSetup::new("goal_checker") };
        create_goal_checker("nav2_controller::SimpleGoalChecker", &setup, &mut diagnostics).unwrap()
    });
    let rules = controller.path_rules().unwrap_or_default();
    Robot { controller, goal_checker, path_handler: PathHandler::new(rules) }
}

/// Drives along a plan, and returns the poses until the goal is reached.
fn drive(
    robot: &mut Robot,
    world: &World,
    plan: &[Pose2],
    start: Pose2,
) -> Result<Vec<Pose2>, ControlError> {
    let goal = plan[plan.len() - 1];
    robot.path_handler.set_plan(plan.to_vec());
    robot.controller.set_plan(plan);
    let (mut pose, mut velocity) = (start, Twist2::ZERO);
    let mut poses = vec![pose];
    for cycle in 0..2400_i64 {
        let view = world.view();
        let info = *view.costs.info();
        let local = robot.path_handler.local_plan(pose, Pose2::IDENTITY, &info)?;
        let status = robot.goal_checker.check(&GoalQuery { pose, goal, velocity, plan: &local });
        if status == GoalStatus::Reached {
            return Ok(poses);
        }
        let input = ControlInput {
            time_ns: cycle * 50_000_000,
            pose,
            velocity,
            costmap: view,
            plan: &local,
            goal,
            tolerance: robot.goal_checker.tolerance(),
            is_position_reached: status >= GoalStatus::AtPosition,
        };
        velocity = robot.controller.compute_velocity(&input)?;
        assert!(velocity.is_finite());
        let (sine, cosine) = libm::sincos(pose.yaw_rad);
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
        pose.x_m += (vx_m_s * cosine - vy_m_s * sine) * PERIOD_S;
        pose.y_m += (vx_m_s * sine + vy_m_s * cosine) * PERIOD_S;
        pose.yaw_rad += wz_rad_s * PERIOD_S;
        poses.push(pose);
    }
    panic!("the goal was not reached; the robot is at {pose:?}");
}

/// The robot follows the corner within a distance of it, and stops within a tolerance.
fn check(
    class: &str,
    given: &[(&str, &str)],
    release: Nav2Release,
    max_off_m: f64,
    tolerance_m: f64,
) {
    let world = World::new(&[(1.0, 1.2), (3.0, 1.0)]);
    let mut robot = robot(class, given, release);
    let plan = corner();
    let poses = drive(&mut robot, &world, &plan, Pose2::IDENTITY).unwrap();
    let away = |a: Pose2, b: Pose2| libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
    let off_m = poses
        .iter()
        .map(|pose| plan.iter().map(|at| away(*pose, *at)).fold(f64::INFINITY, f64::min))
        .fold(0.0, f64::max);
    assert!(off_m < max_off_m, "{class} was {off_m:.3} m off the plan");
    let end = poses[poses.len() - 1];
    assert!(away(end, plan[plan.len() - 1]) <= tolerance_m, "{class} ended at {end:?}");
    assert!((end.yaw_rad - std::f64::consts::FRAC_PI_2).abs() <= 0.26, "{class}: {end:?}");
}

#[test]
fn regulated_pure_pursuit() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        check(RPP, &[], release, 0.4, 0.25);
    }
    check(RPP, &[("use_dynamic_window", "true")], Nav2Release::Main, 0.4, 0.25);
    let curvature =
        [("use_fixed_curvature_lookahead", "true"), ("curvature_lookahead_dist", "0.4")];
    check(RPP, &curvature, Nav2Release::Jazzy, 0.4, 0.25);
}

#[test]
fn graceful() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        check(GRACEFUL, &[], release, 0.6, 0.25);
    }
    check(GRACEFUL, &[("prefer_final_rotation", "false")], Nav2Release::Main, 0.6, 0.25);
}

#[test]
fn rotation_shim() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy] {
        check(SHIM, &[("primary_controller", RPP)], release, 0.4, 0.25);
    }
    let main = [("primary_controller.plugin", RPP), ("primary_controller.lookahead_dist", "0.5")];
    check(SHIM, &main, Nav2Release::Main, 0.4, 0.25);
    let mut dwb = STOCK_DWB.to_vec();
    dwb.push(("primary_controller", DWB));
    check(SHIM, &dwb, Nav2Release::Jazzy, 0.3, 0.25);
}

#[test]
fn a_robot_that_looks_away_rotates_first() {
    let world = World::new(&[]);
    let mut robot = robot(SHIM, &[("primary_controller", RPP)], Nav2Release::Jazzy);
    let poses = drive(&mut robot, &world, &corner(), Pose2::new(0.0, 0.0, 3.0)).unwrap();
    let turning = poses.iter().take_while(|pose| pose.x_m == 0.0).count();
    // From 3 rad to 0.39 rad at 1.8 rad/s and 3.2 rad/s^2, in cycles of 0.05 s.
    assert!((30..60).contains(&turning), "{turning} cycles");
}

#[test]
fn dwb() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        check(DWB, STOCK_DWB, release, 0.25, 0.25);
    }
    let mut limited = STOCK_DWB.to_vec();
    limited.push(("trajectory_generator_name", "dwb_plugins::LimitedAccelGenerator"));
    check(DWB, &limited, Nav2Release::Jazzy, 0.25, 0.25);
}

#[test]
fn dwa_planner() {
    let dwa = [
        ("max_vel_y", "0.0"),
        ("min_vel_y", "0.0"),
        ("path_distance_bias", "32.0"),
        ("goal_distance_bias", "24.0"),
    ];
    check(DWA, &dwa, Nav2Release::Main, 0.4, 0.1);
}

#[test]
fn trajectory_planner() {
    let given = [("holonomic_robot", "false"), ("meter_scoring", "true")];
    check(ROLLOUT, &given, Nav2Release::Main, 0.5, 0.1);
}

#[test]
fn replacement_of_teb() {
    check(TEB, &[], Nav2Release::Main, 0.5, 0.2);
    let car = [("min_turning_radius", "0.2"), ("yaw_goal_tolerance", "0.25")];
    check(TEB, &car, Nav2Release::Main, 0.5, 0.2);
}

/// A wall ahead ends the control with a reason that names the cell.
fn check_obstacle(class: &str, given: &[(&str, &str)], release: Nav2Release, starts_with: &str) {
    let wall: Vec<(f64, f64)> = (-40..40).map(|step| (1.0, 0.05 * f64::from(step))).collect();
    let world = World::new(&wall);
    let mut robot = robot(class, given, release);
    let error = drive(&mut robot, &world, &corner(), Pose2::IDENTITY).unwrap_err();
    let ControlError::NoValidControl(text) = &error else { panic!("{error:?}") };
    assert!(text.starts_with(starts_with), "{text}");
    assert!(text.contains("cell (") && text.contains("with cost 25"), "{text}");
    assert!(robot.controller.report().blocked().is_some_and(|blocked| blocked.cell.is_some()));
}

#[test]
fn obstacles_are_named() {
    let main = Nav2Release::Main;
    let rpp = "RegulatedPurePursuitController detected collision ahead! ";
    check_obstacle(RPP, &[], main, rpp);
    check_obstacle(RPP, &[], Nav2Release::Humble, rpp);
    check_obstacle(GRACEFUL, &[], main, "Collision detected in trajectory: ");
    check_obstacle(GRACEFUL, &[], Nav2Release::Humble, "Collision detected in the trajectory: ");
    // Rotations in place stay valid for DWB, so its critics are only those of obstacles and motion forwards.
    let mut forward = STOCK_DWB.to_vec();
    forward.retain(|(name, _)| *name != "max_vel_theta");
    forward.extend([("max_vel_theta", "0.0"), ("min_vel_x", "0.1")]);
    check_obstacle(
        DWB,
        &forward,
        main,
        "Could not find a legal trajectory: No valid trajectories out of ",
    );
}
