//! Velocity smoother, collision monitor, behaviors and lifecycle manager.

use periplus_costmap::Nav2Release;
use periplus_geometry::Twist2;
use periplus_motion::behaviors::{DriveLimits, Spin, SpinLimits, StraightDrive};
use periplus_motion::collision_monitor::{
    ApproachLimits, CollisionPoint, MonitorAction, MonitorDecision, MonitorShape, MonitorZone,
    SourcePoints, ZoneAction, decide,
};
use periplus_motion::{
    CommandExecution, ManagedState, ManagerCommand, Velocity6, VelocityFeedback, VelocitySmoother,
    VelocitySmootherParams, VelocitySmootherSettings,
};
use periplus_params::ParamChoice;
use serde_json::{Value, json};

use super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

/// Kind `velocity_smoother`: the outputs of a command by timer ticks.
pub(super) fn check_smoother(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let numbers_of = |name: &str| given.get(name)?.numbers();
    let params = VelocitySmootherParams {
        smoothing_frequency_hz: given.get("smoothing_frequency")?.number()?,
        feedback: VelocityFeedback::of_word(given.get("feedback")?.text()?),
        scale_velocities: given.get("scale_velocities")?.truth()?,
        max_velocity: numbers_of("max_velocity")?,
        min_velocity: numbers_of("min_velocity")?,
        max_accel: numbers_of("max_accel")?,
        max_decel: numbers_of("max_decel")?,
        deadband_velocity: numbers_of("deadband_velocity")?,
        ..VelocitySmootherParams::default()
    };
    let settings = match VelocitySmootherSettings::new(&params) {
        Ok(settings) => settings,
        Err(error) => {
            differences.push(format!("the limits are refused: {error}"));
            return Ok(());
        }
    };
    let start = given.get("start")?;
    let mut smoother = VelocitySmoother::starting_from(settings, velocity6(&start)?);
    // In closed loop the robot is measured at the start of each step as it was commanded.
    smoother.set_command(velocity6(&given.get("command")?)?, 0);
    let mut measured = velocity6(&start)?;
    let mut outputs = Vec::new();
    for _ in 0..given.get("steps")?.count()? {
        let Some(output) = smoother.update(0, Some(measured)) else { break };
        measured = output;
        outputs.push(numbers([output[0], output[1], output[5]]));
    }
    differences.compare("outputs", &Value::Array(outputs), &expect.get("outputs")?);
    Ok(())
}

fn velocity6(value: &CaseReader<'_>) -> Result<Velocity6, Unreadable> {
    let [x, y, theta] = value.array()?;
    Ok([x, y, 0.0, 0.0, 0.0, theta])
}

/// Kind `collision_monitor`: the velocity that zones allow.
pub(super) fn check_monitor(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let release = release(distro)?;
    let mut zones = given.get("polygons")?.each(|polygon| zone(polygon, release))?;
    let [vx, vy, wz] = given.get("velocity")?.array()?;
    let points = given.get("points")?.each(|point| {
        let [x, y] = point.array()?;
        Ok(CollisionPoint::planar(x, y))
    })?;
    let seen = [SourcePoints { source: SOURCE.to_owned(), points }];
    let command = Twist2::new(vx, vy, wz);
    let decision = decide(&mut zones, &seen, command, MonitorDecision::pass(command));
    let action = match decision.action {
        MonitorAction::DoNothing => "do_nothing",
        MonitorAction::Stop => "stop",
        MonitorAction::Slowdown => "slowdown",
        MonitorAction::Approach => "approach",
        MonitorAction::Limit => "limit",
    };
    let name = decision.zone.and_then(|index| zones.get(index)).map_or("", |zone| &zone.name);
    let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = decision.velocity;
    differences.compare_members(
        &[
            (&["action"], json!(action)),
            (&["polygon"], json!(name)),
            (&["velocity"], numbers([vx_m_s, vy_m_s, wz_rad_s])),
        ],
        &expect,
    );
    Ok(())
}

/// Name of the only source.
const SOURCE: &str = "scan";

fn zone(polygon: &CaseReader<'_>, release: Nav2Release) -> Result<MonitorZone, Unreadable> {
    let value = |name: &str| polygon.get(name)?.number();
    let points = polygon.get("points")?.each(CaseReader::array::<2>)?;
    let radius_m = value("radius")?;
    let shape_type = polygon.get("type")?;
    let shape = match shape_type.text()? {
        "circle" => MonitorShape::Circle { radius_m },
        "polygon" => MonitorShape::Polygon(points),
        _ => return Err(shape_type.unreadable("`polygon` or `circle`")),
    };
    let slowdown = ZoneAction::Slowdown { ratio: value("slowdown_ratio")? };
    let limit = ZoneAction::Limit {
        linear_m_s: value("linear_limit")?,
        angular_rad_s: value("angular_limit")?,
    };
    let approach = ZoneAction::Approach(ApproachLimits {
        time_before_collision_s: value("time_before_collision")?,
        simulation_time_step_s: value("simulation_time_step")?,
    });
    let action_type = polygon.get("action_type")?;
    let action = match action_type.text()? {
        "stop" => ZoneAction::Stop,
        "slowdown" => slowdown,
        "limit" => limit,
        "approach" => approach,
        "none" => ZoneAction::None,
        _ => return Err(action_type.unreadable("an action")),
    };
    let min_points = polygon.get("min_points")?.count()?;
    let at_once = min_points - usize::from(release == Nav2Release::Humble && min_points > 0);
    Ok(MonitorZone {
        shape: Some(shape),
        sources: vec![SOURCE.to_owned()],
        min_points_at_once: at_once,
        ..MonitorZone::new(polygon.get("name")?.text()?, action, min_points)
    })
}

fn release(distro: &str) -> Result<Nav2Release, Unreadable> {
    distro.parse().map_err(Unreadable)
}

/// Kind `behavior_velocity`: the velocity of one cycle of a spin or drive.
pub(super) fn check_behavior(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let value = |name: &str| given.get(name)?.number();
    let (target, travelled) = (value("target")?, value("travelled")?);
    let (speed, last) = (value("speed")?, value("last_velocity")?);
    let frequency_hz = value("cycle_frequency")?;
    let spin_limits = SpinLimits {
        min_rad_s: value("min_rotational_vel")?,
        max_rad_s: value("max_rotational_vel")?,
        acc_rad_s2: value("rotational_acc_lim")?,
    };
    let (acceleration, deceleration) = (value("acceleration_limit")?, value("deceleration_limit")?);
    let drive_limits =
        DriveLimits::new(release(distro)?, acceleration, deceleration, value("minimum_speed")?);
    let behavior = given.get("behavior")?;
    let target_m = [target, 0.0, 0.0];
    let drive = match behavior.text()? {
        "spin" => None,
        "backup" => Some(StraightDrive::backward(target_m, speed)),
        "drive_on_heading" => Some(StraightDrive::on_heading(target_m, speed)),
        _ => return Err(behavior.unreadable("`spin`, `backup` or `drive_on_heading`")),
    };
    let velocity = match drive {
        None => Spin::after(target, travelled).velocity_rad_s(&spin_limits),
        Some(Ok(drive)) => drive.velocity_m_s(travelled, last, frequency_hz, &drive_limits),
        Some(Err(error)) => {
            differences.push(format!("the command is refused: {error}"));
            return Ok(());
        }
    };
    let present = velocity.unwrap_or(0.0);
    let (linear, angular) = if drive.is_some() { (present, 0.0) } else { (0.0, present) };
    differences.compare_members(
        &[
            (&["done"], json!(velocity.is_none())),
            (&["linear_vel"], number(linear)),
            (&["angular_vel"], number(angular)),
        ],
        &expect,
    );
    Ok(())
}

/// Kind `lifecycle_order`: the transitions of a command to a lifecycle manager.
pub(super) fn check_lifecycle(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let names = given.get("node_names")?.each(|name| Ok(name.text()?.to_owned()))?;
    let fails = given.get("fails")?.each(|word| Ok(word.text()?.to_owned()))?;
    let fails = (fails.first().cloned(), fails.get(1).map(|label| transition_name(label)));
    let word = given.get("command")?;
    let command = match word.text()? {
        "STARTUP" => ManagerCommand::Startup,
        "PAUSE" => ManagerCommand::Pause,
        "RESUME" => ManagerCommand::Resume,
        "RESET" => ManagerCommand::Reset,
        "SHUTDOWN" => ManagerCommand::Shutdown,
        "CONFIGURE" => ManagerCommand::Configure,
        "CLEANUP" => ManagerCommand::Cleanup,
        _ => return Err(word.unreadable("a command of ManageLifecycleNodes")),
    };
    let mut execution = CommandExecution::new(command, &names);
    let mut made = Vec::new();
    while let Some((name, transition)) = execution.next_step() {
        let label = transition.label();
        let has_failed = (Some(name), Some(label)) == (fails.0.as_deref(), fails.1);
        made.push(json!([name, label]));
        execution.finish_step(!has_failed);
    }
    let Some((success, state)) = execution.outcome() else {
        differences.push("the command does not end");
        return Ok(());
    };
    let expected = expect.get("transitions")?;
    let made = Value::Array(made);
    differences.hold("transitions", &made, &expected, |stated| with_short_names(stated) == made);
    differences.compare("success", &json!(success), &expect.get("success")?);
    let state = match state {
        ManagedState::Unknown => "UNKNOWN",
        ManagedState::Unconfigured => "UNCONFIGURED",
        ManagedState::Inactive => "INACTIVE",
        ManagedState::Active => "ACTIVE",
        ManagedState::Finalized => "FINALIZED",
    };
    differences.compare("state", &json!(state), &expect.get("state")?);
    Ok(())
}

/// Short name of a transition: shutdowns are also named by the state that they start from.
fn transition_name(label: &str) -> &str {
    if label == "unconfigured_shutdown" { "shutdown" } else { label }
}

fn with_short_names(steps: &Value) -> Value {
    match steps {
        Value::Array(list) => list.iter().map(with_short_names).collect(),
        Value::String(text) => json!(transition_name(text)),
        other => other.clone(),
    }
}
