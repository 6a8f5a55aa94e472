//! Plugins from the names of their classes, and changes of their parameters.

#![allow(clippy::unwrap_used, reason = "tests")]

use periplus_controllers::{
    GivenParameters, ParameterChange, PluginSetup, controller_classes, create_controller,
    create_goal_checker,
};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_params::{Given, ParamValue};

const RPP: &str = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController";

fn setup<'a>(given: &'a [(&'a str, &'a str)], release: Nav2Release) -> PluginSetup<'a> {
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    let given = GivenParameters::new(given);
    PluginSetup { release, given, ..PluginSetup::new("FollowPath") }
}

#[track_caller]
fn check_unknown(class: &str, expected: &str) {
    let mut diagnostics = Diagnostics::new();
    let setup = PluginSetup::new("FollowPath");
    assert!(create_controller(class, &setup, &mut diagnostics).is_none());
    let finding = diagnostics.iter().next().unwrap();
    assert_eq!(finding.help, [format!("did you mean `{expected}`?")]);
}

#[test]
fn classes_have_two_forms() {
    for class in controller_classes() {
        for class in [class.to_owned(), class.replace("::", "/")] {
            let critic = if class.contains("mppi") { "[CostCritic]" } else { "[BaseObstacle]" };
            let given = [("critics", critic), ("primary_controller", RPP)];
            let setup = setup(&given, Nav2Release::Jazzy);
            let created = create_controller(&class, &setup, &mut Diagnostics::new());
            assert!(created.is_some(), "{class}");
        }
    }
}

#[test]
fn unknown_classes_have_a_suggestion() {
    check_unknown("dwb_core::DWBLocalPlaner", "dwb_core::DWBLocalPlanner");
    check_unknown("dwb_core/DWBLocalPlaner", "dwb_core/DWBLocalPlanner");
    check_unknown("dwb_controller::DWBLocalPlanner", "dwb_core::DWBLocalPlanner");
    check_unknown("regulated_pure_pursuit::RegulatedPurePursuitControler", RPP);
    let mut diagnostics = Diagnostics::new();
    let setup = PluginSetup::new("goal_checker");
    assert!(create_goal_checker("SimpleGoalChecker", &setup, &mut diagnostics).is_none());
}

/// Returns the messages of creating a controller.
fn messages(class: &str, given: &[(&str, &str)], release: Nav2Release) -> Vec<String> {
    let mut diagnostics = Diagnostics::new();
    let _ = create_controller(class, &setup(given, release), &mut diagnostics);
    diagnostics.iter().map(|finding| finding.message.clone()).collect()
}

#[test]
fn mistakes_are_explained() {
    let jazzy = Nav2Release::Jazzy;
    let dwb = "dwb_core::DWBLocalPlanner";
    assert_eq!(messages(dwb, &[], jazzy), ["No critics defined for FollowPath"]);
    assert_eq!(
        messages(dwb, &[("critics", "[BaseObstacel]")], jazzy),
        ["critic `BaseObstacel`: DWB has no critic of the class `BaseObstacel`"]
    );
    let unlisted = [("critics", "[PathDist]"), ("GoalDist.scale", "2.0")];
    assert_eq!(
        messages(dwb, &unlisted, jazzy),
        ["`GoalDist` is not in `critics`; its parameters have no effect"]
    );
    let shim = "nav2_rotation_shim_controller::RotationShimController";
    assert_eq!(
        messages(shim, &[], jazzy),
        ["RotationShim `FollowPath` needs `FollowPath.primary_controller`"]
    );
    let typo = [("primary_controller", RPP), ("angular_dist_treshold", "0.5")];
    let typos = messages(shim, &typo, jazzy);
    assert!(typos.iter().any(|text| text.ends_with("`angular_dist_treshold`")), "{typos:?}");
    let teb = messages("teb_local_planner/TebLocalPlannerROS", &[("max_vel_x", "0.3")], jazzy);
    assert_eq!(
        teb,
        [
            "`FollowPath`: TebLocalPlannerROS is not supported, and DWBLocalPlanner drives in place of it"
        ]
    );
}

#[test]
fn neighbours_in_a_group_are_no_mistakes() {
    let given = [
        ("plugin", "nav2_rotation_shim_controller::RotationShimController"),
        ("primary_controller", RPP),
        ("angular_dist_threshold", "0.5"),
        ("lookahead_dist", "0.5"),
        ("max_angular_accel", "2.0"),
    ];
    let shim = "nav2_rotation_shim_controller::RotationShimController";
    assert_eq!(messages(shim, &given, Nav2Release::Jazzy), [""; 0]);
    // In main the primary controller has a group.
    let old = messages(shim, &given, Nav2Release::Main);
    assert!(old.len() == 1 && old[0].contains("as before Kilted"), "{old:?}");
    let nested = [
        ("primary_controller.plugin", RPP),
        ("primary_controller.lookahead_dist", "0.5"),
        ("angular_dist_threshold", "0.5"),
    ];
    assert_eq!(messages(shim, &nested, Nav2Release::Main), [""; 0]);
}

#[test]
fn parameters_change_by_the_rules_of_nav2() {
    let mut rpp =
        create_controller(RPP, &setup(&[], Nav2Release::Main), &mut Diagnostics::new()).unwrap();
    let mut change = |name: &str, value| rpp.change_parameter(name, value);
    assert_eq!(change("lookahead_dist", ParamValue::Number(0.4)), Ok(ParameterChange::Applied));
    assert!(change("lookahead_dist", ParamValue::Number(-0.4)).is_err());
    assert!(change("max_linear_decel", ParamValue::Number(-1.0)).is_ok());
    assert!(change("inflation_cost_scaling_factor", ParamValue::Number(0.0)).is_err());
    assert!(change("allow_reversing", ParamValue::Bool(true)).is_err(), "rotates to heading");
    assert!(change("use_rotate_to_heading", ParamValue::Bool(false)).is_ok());
    assert!(change("allow_reversing", ParamValue::Bool(true)).is_ok());
    assert!(change("lookahead", ParamValue::Number(0.4)).is_err());
    let given = [("critics", "[BaseObstacle]")];
    let setup = setup(&given, Nav2Release::Main);
    let class = "dwb_core::DWBLocalPlanner";
    let mut dwb = create_controller(class, &setup, &mut Diagnostics::new()).unwrap();
    let mut change = |name: &str, value| dwb.change_parameter(name, value);
    assert_eq!(change("max_vel_x", ParamValue::Number(0.4)), Ok(ParameterChange::Applied));
    assert!(change("decel_lim_x", ParamValue::Number(1.0)).is_err());
    assert!(change("acc_lim_x", ParamValue::Number(-1.0)).is_err());
    let restart = Ok(ParameterChange::AfterRestart);
    assert_eq!(change("sim_time", ParamValue::Number(1.0)), restart);
    assert_eq!(change("BaseObstacle.scale", ParamValue::Number(0.5)), restart);
    let names: Vec<String> =
        dwb.parameters().iter().flat_map(|it| it.names().collect::<Vec<_>>()).collect();
    assert!(names.contains(&"BaseObstacle.sum_scores".to_owned()), "{names:?}");
}
