//! Samples, trajectories and critics of DWB.

use periplus_controllers::GivenParameters;
use periplus_controllers::dwb::critics::{CriticInput, create_trajectory_critic};
use periplus_controllers::dwb::{
    AxisLimits, DWB, DwbParams, KinematicLimits, OBSTACLE_CRITIC, PREFER_FORWARD_CRITIC,
    ROTATE_TO_GOAL_CRITIC, SampledTrajectory, TrajectoryGenerator, step_count,
};
use periplus_costmap::{CostmapView, Footprint};
use periplus_diagnostics::Diagnostics;
use periplus_params::{Given, Table};
use serde_json::{Value, json};

use super::{costmap, path, pose, release_of, values_of, velocity};
use crate::kinds::Setting;
use crate::{Case, CaseReader, Differences, Unreadable};

/// Reachable velocities of one axis.
pub(in crate::kinds) fn check_samples(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let number = |name: &str| given.get(name)?.number();
    let limits = AxisLimits {
        min: number("min")?,
        max: number("max")?,
        acceleration: number("accel")?,
        deceleration: number("decel")?,
    };
    let count = given.get("samples")?.count()?;
    let samples = limits.samples(number("current")?, number("time")?, count);
    differences.compare_members(&[(&["velocities"], json!(samples))], &case.expect());
    Ok(())
}

/// Poses and times of a trajectory.
pub(in crate::kinds) fn check_trajectory(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let name = given.get("generator")?;
    let class = format!("dwb_plugins::{}", name.text()?);
    let Some(generator) = TrajectoryGenerator::of_class(&class) else {
        return Err(name.unreadable("a trajectory generator"));
    };
    let mut params = DwbParams::default().trajectories;
    let number = |name: &str| given.get(name)?.number();
    params.sim_time_s = number("sim_time")?;
    params.discretize_by_time = given.get("discretize_by_time")?.truth()?;
    params.time_granularity_s = number("time_granularity")?;
    params.linear_granularity_m = number("linear_granularity")?;
    params.angular_granularity_rad = number("angular_granularity")?;
    params.include_last_point = given.get("include_last_point")?.truth()?;
    let accelerations: [f64; 3] = given.get("acc_lim")?.array()?;
    let decelerations: [f64; 3] = given.get("decel_lim")?.array()?;
    let axis = |index: usize| AxisLimits {
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
        acceleration: accelerations[index],
        deceleration: decelerations[index],
    };
    let limits = KinematicLimits {
        x: axis(0),
        y: axis(1),
        theta: axis(2),
        min_speed_m_s: -1.0,
        max_speed_m_s: -1.0,
        min_turn_rate_rad_s: -1.0,
    };
    let command = velocity(&given.get("command")?)?;
    let found = generator.simulate(
        &params,
        &limits,
        pose(&given.get("start_pose")?)?,
        velocity(&given.get("start_velocity")?)?,
        command,
    );
    let poses: Vec<[f64; 3]> =
        found.poses.iter().map(|pose| [pose.x_m, pose.y_m, pose.yaw_rad]).collect();
    differences.compare_members(
        &[
            (&["steps"], json!(step_count(&params, command))),
            (&["poses"], json!(poses)),
            (&["time_offsets"], json!(found.times_s)),
        ],
        &case.expect(),
    );
    Ok(())
}

/// Tables of the parameters that cases of critics may have.
const CRITIC_TABLES: [&Table; 4] =
    [&DWB, &OBSTACLE_CRITIC, &PREFER_FORWARD_CRITIC, &ROTATE_TO_GOAL_CRITIC];

/// The parameters that belong to one critic.
fn critic_texts<'v>(
    critic: &str,
    params: &CaseReader<'v>,
) -> Result<Vec<(&'v str, String)>, Unreadable> {
    let table: Option<&Table> = match critic {
        "PreferForward" => Some(&PREFER_FORWARD_CRITIC),
        "RotateToGoal" => Some(&ROTATE_TO_GOAL_CRITIC),
        "BaseObstacle" => Some(&OBSTACLE_CRITIC),
        _ => None,
    };
    let mut texts = Vec::new();
    for (name, value) in params.members()? {
        if table.is_some_and(|table| table.find(name).is_some()) {
            texts.push((name, value.written()));
        }
    }
    Ok(texts)
}

/// Score of a trajectory by one critic.
pub(in crate::kinds) fn check_critic(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let (name, params) = (given.get("critic")?, given.get("params")?);
    let planner = DwbParams::from_values(&values_of(&DWB, &CRITIC_TABLES, &params)?);
    let texts = critic_texts(name.text()?, &params)?;
    let texts =
        GivenParameters::new(texts.iter().map(|(name, text)| Given::new(name, text.as_str())));
    let mut diagnostics = Diagnostics::new();
    let release = release_of(distro)?;
    let critic =
        create_trajectory_critic(name.text()?, &texts, &planner, release, &mut diagnostics);
    let (Some(mut critic), None) = (critic, diagnostics.iter().next()) else {
        return Err(name.unreadable("a critic"));
    };
    let (costs, plan) = (costmap(&given.get("costmap")?)?, path(&given.get("plan")?)?);
    let footprint = Footprint::default();
    let input = CriticInput {
        time_ns: 0,
        pose: pose(&given.get("pose")?)?,
        velocity: velocity(&given.get("velocity")?)?,
        goal: pose(&given.get("goal")?)?,
        plan: &plan,
        costmap: CostmapView {
            costs: &costs,
            footprint: &footprint,
            is_circular: true,
            tracks_unknown: true,
            inflation: None,
        },
    };
    let trajectory = given.get("trajectory")?;
    let trajectory = SampledTrajectory {
        velocity: velocity(&trajectory.get("velocity")?)?,
        poses: trajectory.get("poses")?.each(pose)?,
        times_s: Vec::new(),
    };
    critic.prepare(&input);
    let (score, illegal): (Value, Value) = match critic.score(&input, &trajectory) {
        Ok(score) => (json!(score), json!("")),
        Err(illegal) => (json!(-1.0), json!(illegal.reason)),
    };
    differences.compare_members(&[(&["score"], score), (&["illegal"], illegal)], &case.expect());
    Ok(())
}
