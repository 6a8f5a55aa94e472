//! Parameters that cannot work together are explained; stock parameters are not complained about.

#![allow(clippy::unwrap_used, reason = "tests")]

use periplus_controllers::consistency::{
    CostmapFacts, check_controller, check_goal_checker, check_progress_checker,
};
use periplus_controllers::{
    Controller, GivenParameters, PluginSetup, ProgressChecker, create_controller,
    create_goal_checker,
};
use periplus_costmap::{InflationLaw, Nav2Release};
use periplus_diagnostics::{Diagnostics, Severity};
use periplus_params::Given;

const RPP: &str = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController";
const GRACEFUL: &str = "nav2_graceful_controller::GracefulController";
const SHIM: &str = "nav2_rotation_shim_controller::RotationShimController";
const DWB: &str = "dwb_core::DWBLocalPlanner";
const DWA: &str = "dwa_local_planner/DWAPlannerROS";
const ROLLOUT: &str = "base_local_planner/TrajectoryPlannerROS";

/// A costmap of 3 x 3 m around a TurtleBot, as in the stock files.
const FACTS: CostmapFacts = CostmapFacts {
    resolution_m: 0.05,
    extent_m: 1.5,
    inscribed_radius_m: 0.22,
    circumscribed_radius_m: 0.22,
    is_circular: true,
    inflation: Some(InflationLaw { radius_m: 0.7, scaling_per_m: 3.0 }),
    control_period_s: 0.05,
};

const DWB_LIMITS: &[(&str, &str)] = &[
    ("max_vel_x", "0.26"),
    ("max_vel_theta", "1.0"),
    ("max_speed_xy", "0.26"),
    ("acc_lim_x", "2.5"),
    ("acc_lim_theta", "3.2"),
    ("decel_lim_x", "-2.5"),
    ("decel_lim_theta", "-3.2"),
    ("linear_granularity", "0.05"),
    ("critics", "[RotateToGoal, BaseObstacle, PathDist, GoalDist]"),
];

fn setup<'a>(given: &'a [(&'a str, &'a str)], release: Nav2Release) -> PluginSetup<'a> {
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    PluginSetup { release, given: GivenParameters::new(given), ..PluginSetup::new("FollowPath") }
}

fn controller(class: &str, given: &[(&str, &str)], release: Nav2Release) -> Box<dyn Controller> {
    create_controller(class, &setup(given, release), &mut Diagnostics::new()).unwrap()
}

/// Codes of the findings, hints aside.
fn codes(diagnostics: &Diagnostics) -> Vec<&'static str> {
    let loud = diagnostics.iter().filter(|finding| finding.severity > Severity::Hint);
    loud.map(|finding| finding.code).collect()
}

#[track_caller]
fn check(class: &str, given: &[(&str, &str)], release: Nav2Release, expected: &[&str]) {
    let controller = controller(class, given, release);
    let mut diagnostics = Diagnostics::new();
    check_controller("FollowPath", &*controller, release, &FACTS, &mut diagnostics);
    assert_eq!(codes(&diagnostics), expected, "{diagnostics:?}");
}

#[test]
fn defaults_and_stock_parameters_are_fine() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        check(RPP, &[], release, &[]);
        check(GRACEFUL, &[], release, &[]);
        check(DWB, DWB_LIMITS, release, &[]);
    }
    check(SHIM, &[("primary_controller", RPP)], Nav2Release::Jazzy, &[]);
    check(DWA, &[], Nav2Release::Main, &[]);
    check(ROLLOUT, &[], Nav2Release::Main, &[]);
}

#[test]
fn pure_pursuit() {
    let main = Nav2Release::Main;
    check(RPP, &[("inflation_cost_scaling_factor", "10.0")], main, &["other-inflation"]);
    check(RPP, &[("allow_reversing", "true")], Nav2Release::Humble, &["exclusive-modes"]);
    check(RPP, &[("lookahead_dist", "0.1")], main, &["short-lookahead"]);
    check(RPP, &[("lookahead_dist", "2.0")], main, &["long-lookahead"]);
    check(RPP, &[("approach_velocity_scaling_dist", "2.0")], main, &["permanent-slowdown"]);
    check(RPP, &[("max_linear_vel", "0.3")], Nav2Release::Jazzy, &["other-release"]);
    check(RPP, &[("max_linear_vel", "0.0")], main, &["no-motion"]);
    check(RPP, &[("interpolate_curvature_after_goal", "true")], main, &["without-effect"]);
}

#[test]
fn dwb() {
    let main = Nav2Release::Main;
    let with = |name, text| {
        let mut given = DWB_LIMITS.to_vec();
        given.retain(|(other, _)| *other != name);
        given.push((name, text));
        given
    };
    check(DWB, &[("critics", "[BaseObstacle]")], main, &["no-motion", "coarse-trajectories"]);
    check(DWB, &with("max_speed_xy", "0.0"), main, &["no-motion"]);
    check(DWB, &with("acc_lim_theta", "0.0"), main, &["no-acceleration"]);
    check(DWB, &with("decel_lim_x", "2.5"), main, &["positive-deceleration"]);
    check(DWB, &with("min_vel_x", "0.5"), main, &["empty-range"]);
    check(DWB, &with("sim_time", "9.0"), main, &["long-trajectories"]);
    check(DWB, &with("critics", "[PathDist]"), main, &["no-obstacle-critic"]);
}

#[test]
fn other_controllers() {
    let main = Nav2Release::Main;
    check(GRACEFUL, &[("allow_backward", "true")], main, &["exclusive-modes"]);
    check(GRACEFUL, &[("v_linear_min", "1.0")], main, &["no-motion"]);
    let shim = [("primary_controller", RPP), ("angular_disengage_threshold", "1.0")];
    check(SHIM, &shim, Nav2Release::Jazzy, &["wrong-order"]);
    let slow = [("min_vel_trans", "1.0")];
    check(DWA, &slow, main, &["empty-range", "empty-range", "cannot-start"]);
    check(DWA, &[("xy_goal_tolerance", "0.01")], main, &["small-tolerance"]);
    check(DWA, &[("acc_lim_x", "1.0")], main, &["cannot-start"]);
    check(ROLLOUT, &[("escape_vel", "0.1")], main, &["positive-escape"]);
}

#[test]
fn checkers() {
    let main = Nav2Release::Main;
    let dwb = controller(DWB, DWB_LIMITS, main);
    let codes_of = |given: &[(&str, &str)]| {
        let mut diagnostics = Diagnostics::new();
        let class = "nav2_controller::SimpleGoalChecker";
        let checker = create_goal_checker(class, &setup(given, main), &mut diagnostics).unwrap();
        let controllers: [(&str, &dyn Controller); 1] = [("FollowPath", &*dwb)];
        check_goal_checker("goal_checker", &*checker, &controllers, &FACTS, &mut diagnostics);
        codes(&diagnostics)
    };
    assert_eq!(codes_of(&[]), [""; 0]);
    assert_eq!(codes_of(&[("xy_goal_tolerance", "0.1")]), ["other-tolerance"]);
    assert_eq!(codes_of(&[("xy_goal_tolerance", "0.01")]), ["small-tolerance", "other-tolerance"]);
    let progress_codes = |max_speed_m_s| {
        let mut diagnostics = Diagnostics::new();
        let class = "nav2_controller::SimpleProgressChecker";
        let setup = PluginSetup::new("progress_checker");
        let checker = ProgressChecker::create(class, &setup, &mut diagnostics).unwrap();
        check_progress_checker("progress_checker", &checker, max_speed_m_s, &mut diagnostics);
        codes(&diagnostics)
    };
    assert_eq!(progress_codes(0.26), [""; 0]);
    assert_eq!(progress_codes(0.04), ["impossible-progress"], "0.5 m in 10 s");
}
