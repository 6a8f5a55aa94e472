//! Goal and progress checkers.

use periplus_controllers::goal_checker::{POSITION_GOAL_CHECKER, STOPPED_GOAL_CHECKER};
use periplus_controllers::{
    GivenParameters, GoalQuery, GoalStatus, POSE_PROGRESS_CHECKER, PluginSetup, ProgressChecker,
    create_goal_checker,
};
use periplus_diagnostics::Diagnostics;
use periplus_params::{Given, Table};
use serde_json::json;

use super::{path, pose, release_of, velocity};
use crate::kinds::Setting;
use crate::{Case, CaseReader, Differences, Unreadable};

/// The parameters in a table, as texts; others are skipped.
fn texts<'v>(
    params: &CaseReader<'v>,
    has: impl Fn(&str) -> bool,
) -> Result<Vec<(&'v str, String)>, Unreadable> {
    let mut texts = Vec::new();
    for (name, value) in params.members()? {
        if has(name) {
            texts.push((name, value.written()));
        } else {
            value.skip();
        }
    }
    Ok(texts)
}

/// Inputs from which a checker of a release is created.
fn setup<'a>(
    name: &'a str,
    given: &'a [(&'a str, String)],
    distro: &str,
) -> Result<PluginSetup<'a>, Unreadable> {
    let given = given.iter().map(|(name, text)| Given::new(name, text.as_str()));
    Ok(PluginSetup {
        release: release_of(distro)?,
        given: GivenParameters::new(given),
        ..PluginSetup::new(name)
    })
}

/// Checks of one goal checker, one after the other.
pub(in crate::kinds) fn check_goal(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let plugin = given.get("plugin")?;
    let table: &Table = match plugin.text()? {
        "PositionGoalChecker" => &POSITION_GOAL_CHECKER,
        // That of the stopped checker contains those of the simple one.
        _ => &STOPPED_GOAL_CHECKER,
    };
    let is_simple = plugin.text()? == "SimpleGoalChecker";
    let has = |name: &str| {
        table.find(name).is_some() && !(is_simple && name.ends_with("stopped_velocity"))
    };
    let params = texts(&given.get("params")?, has)?;
    let class = format!("nav2_controller::{}", plugin.text()?);
    let mut diagnostics = Diagnostics::new();
    let setup = setup("goal_checker", &params, distro)?;
    let Some(mut checker) = create_goal_checker(&class, &setup, &mut diagnostics) else {
        return Err(plugin.unreadable("a goal checker"));
    };
    if let Some(finding) = diagnostics.iter().next() {
        return Err(given.unreadable(&finding.message));
    }
    let mut reached = Vec::new();
    for check in given.get("checks")?.list()? {
        if check.get("reset")?.truth()? {
            checker.reset();
        }
        let plan = path(&check.get("path")?)?;
        let status = checker.check(&GoalQuery {
            pose: pose(&check.get("robot")?)?,
            goal: pose(&check.get("goal")?)?,
            velocity: velocity(&check.get("velocity")?)?,
            plan: &plan,
        });
        reached.push(status == GoalStatus::Reached);
    }
    differences.compare_members(&[(&["reached"], json!(reached))], &case.expect());
    Ok(())
}

/// Checks of one progress checker, one after the other.
pub(in crate::kinds) fn check_progress(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let plugin = given.get("plugin")?;
    let is_simple = plugin.text()? == "SimpleProgressChecker";
    let has = |name: &str| {
        POSE_PROGRESS_CHECKER.find(name).is_some()
            && !(is_simple && name == "required_movement_angle")
    };
    let mut params = Vec::new();
    for (name, value) in given.members()? {
        if has(name) {
            params.push((name, value.written()));
        } else if name == "required_movement_angle" {
            value.skip();
        }
    }
    let class = format!("nav2_controller::{}", plugin.text()?);
    let setup = setup("progress_checker", &params, distro)?;
    let Some(mut checker) = ProgressChecker::create(&class, &setup, &mut Diagnostics::new()) else {
        return Err(plugin.unreadable("a progress checker"));
    };
    let mut progress = Vec::new();
    for check in given.get("checks")?.list()? {
        let time_ns = (check.get("t")?.number()? * 1e9).round() as i64;
        progress.push(checker.check(time_ns, pose(&check.get("pose")?)?).is_ok());
    }
    differences.compare_members(&[(&["progress"], json!(progress))], &case.expect());
    Ok(())
}
