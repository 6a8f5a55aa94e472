use super::*;
use crate::{ControllerManager, Hardware, SwitchRequest};

const MS: i64 = 1_000_000;

fn settings(kind: JointInterfaceKind) -> JointTrajectorySettings {
    let joints = vec!["one".to_owned(), "two".to_owned()];
    JointTrajectorySettings {
        command_joints: joints.clone(),
        joints,
        command_interfaces: vec![kind],
        state_interfaces: vec![JointInterfaceKind::Position, JointInterfaceKind::Velocity],
        is_continuous: vec![false; 2],
        gains: vec![PidGains { p: 10.0, ..PidGains::default() }; 2],
        feed_forward: vec![1.0; 2],
        interpolates: true,
        ..JointTrajectorySettings::default()
    }
}

type Running = ControllerManager<JointTrajectoryController>;

fn running(settings: JointTrajectorySettings) -> Running {
    let mut hardware = Hardware::default();
    for joint in ["one", "two"] {
        for kind in JointInterfaceKind::ALL {
            hardware.add_command(kind.of(joint));
            hardware.add_state(kind.of(joint), 0.0);
        }
    }
    let mut manager = ControllerManager::new(hardware);
    manager.load("arm", "", JointTrajectoryController::new(settings)).unwrap();
    manager.configure("arm").unwrap();
    let activate = vec!["arm".to_owned()];
    manager.switch(&SwitchRequest { activate, ..Default::default() }, at(0)).unwrap();
    manager
}

fn at(time_ms: i64) -> ControlCycle {
    ControlCycle { time_ns: time_ms * MS, period_s: 0.01 }
}

fn arm(manager: &mut Running) -> &mut JointTrajectoryController {
    &mut manager.controllers_mut().next().unwrap().controller
}

/// A trajectory with the joints in the other order.
fn to(two: f64, one: f64, time_ms: i64) -> JointTrajectory {
    let point = TrajectoryPoint {
        positions: vec![two, one],
        time_from_start_ns: time_ms * MS,
        ..TrajectoryPoint::default()
    };
    JointTrajectory { joints: vec!["two".into(), "one".into()], points: vec![point], start_ns: 0 }
}

/// Updates, and moves the joints as an ideal hardware: positions are reached at once.
fn step(manager: &mut Running, time_ms: i64) {
    assert!(manager.update(at(time_ms)).is_empty());
    for joint in ["one", "two"] {
        let name = JointInterfaceKind::Position.of(joint);
        if let Some(position) = manager.hardware.claimed_command(&name) {
            manager.hardware.set_state(&name, position);
        }
    }
}

fn position(manager: &Running, joint: &str) -> f64 {
    manager.hardware.state(&JointInterfaceKind::Position.of(joint)).unwrap()
}

#[test]
fn a_trajectory_reaches_its_points() {
    let mut manager = running(settings(JointInterfaceKind::Position));
    let mut trajectory = to(1.0, 2.0, 1000);
    trajectory.points.push(TrajectoryPoint {
        positions: vec![0.0, 4.0],
        time_from_start_ns: 2000 * MS,
        ..TrajectoryPoint::default()
    });
    arm(&mut manager).start(&trajectory, None, 0).unwrap();
    step(&mut manager, 500);
    assert_eq!((position(&manager, "one"), position(&manager, "two")), (1.0, 0.5));
    step(&mut manager, 1000);
    assert_eq!((position(&manager, "one"), position(&manager, "two")), (2.0, 1.0));
    step(&mut manager, 1500);
    assert_eq!((position(&manager, "one"), position(&manager, "two")), (3.0, 0.5));
    assert!(arm(&mut manager).is_following());
    step(&mut manager, 2000);
    assert_eq!(arm(&mut manager).take_outcome(), Some(TrajectoryOutcome::Reached));
    // The end is held.
    step(&mut manager, 3000);
    assert_eq!((position(&manager, "one"), position(&manager, "two")), (4.0, 0.0));
    assert!(!arm(&mut manager).is_following());
}

#[test]
fn velocities_are_commanded_by_gain_and_feed_forward() {
    let mut manager = running(settings(JointInterfaceKind::Velocity));
    arm(&mut manager).start(&to(0.0, 2.0, 1000), None, 0).unwrap();
    manager.update(at(100));
    // The speed of the line is 2, and the position 0.2 behind: 10 * 0.2.
    let command = manager.hardware.claimed_command("one/velocity").unwrap();
    assert!((command - 4.0).abs() < 1e-12, "{command}");
}

#[test]
fn a_continuous_joint_takes_the_shorter_direction() {
    let free = JointTrajectorySettings {
        is_continuous: vec![true, false],
        feed_forward: vec![0.0; 2],
        ..settings(JointInterfaceKind::Velocity)
    };
    let mut manager = running(free);
    manager.hardware.set_state("one/position", 2.0 * PI);
    manager.update(at(0));
    arm(&mut manager).start(&to(0.0, 0.1, 0), None, 0).unwrap();
    manager.update(at(10));
    let command = manager.hardware.claimed_command("one/velocity").unwrap();
    assert!((command - 1.0).abs() < 1e-9, "{command}");
}

#[test]
fn tolerances_end_a_trajectory() {
    let tolerances = GoalTolerances {
        path: vec![JointTolerances { position: 0.5, velocity: 0.0 }; 2],
        goal: vec![JointTolerances { position: 0.1, velocity: 0.0 }; 2],
        goal_time_s: 0.5,
    };
    // Effort commands do not move this hardware.
    let stuck = JointTrajectorySettings { tolerances, ..settings(JointInterfaceKind::Effort) };
    let mut manager = running(stuck.clone());
    arm(&mut manager).start(&to(0.0, 1.0, 1000), None, 0).unwrap();
    manager.update(at(500));
    assert_eq!(arm(&mut manager).take_outcome(), None);
    manager.update(at(501));
    let code = TrajectoryErrorCode::PathToleranceViolated;
    let reason = "one: position error 0.501000 is beyond 0.5".to_owned();
    assert_eq!(arm(&mut manager).take_outcome(), Some(TrajectoryOutcome::Failed(code, reason)));

    let mut manager = running(stuck);
    arm(&mut manager).start(&to(0.0, 0.2, 1000), None, 0).unwrap();
    manager.update(at(1500));
    assert_eq!(arm(&mut manager).take_outcome(), None);
    manager.update(at(1501));
    let failed = arm(&mut manager).take_outcome();
    let code = TrajectoryErrorCode::GoalToleranceViolated;
    assert!(matches!(failed, Some(TrajectoryOutcome::Failed(found, _)) if found == code));
}

fn refused(trajectory: &JointTrajectory, change: impl Fn(&mut JointTrajectorySettings)) -> String {
    let mut settings = settings(JointInterfaceKind::Position);
    change(&mut settings);
    let mut manager = running(settings);
    match arm(&mut manager).start(trajectory, None, 5000 * MS) {
        Ok(()) => "accepted".into(),
        Err(rejection) => format!("{}: {}", rejection.code.number(), rejection.reason),
    }
}

#[test]
fn wrong_trajectories_are_refused() {
    let as_is = |_: &mut JointTrajectorySettings| {};
    assert_eq!(refused(&to(0.0, 1.0, 1000), as_is), "accepted");
    let mut other = to(0.0, 1.0, 1000);
    other.joints[0] = "three".into();
    let text = "-2: the joint `three` is none of the controller's: one, two";
    assert_eq!(refused(&other, as_is), text);
    let mut part = to(0.0, 1.0, 1000);
    part.joints.pop();
    part.points[0].positions.pop();
    assert!(refused(&part, as_is).starts_with("-2: the joint `one` is missing"));
    assert_eq!(refused(&part, |settings| settings.allows_partial_goals = true), "accepted");
    let old = JointTrajectory { start_ns: 1, ..to(0.0, 1.0, 1000) };
    assert!(refused(&old, as_is).starts_with("-3: "));
    let mut same_time = to(0.0, 1.0, 1000);
    same_time.points.push(same_time.points[0].clone());
    assert!(refused(&same_time, as_is).starts_with("-1: the time of point 1"));
    let mut fast = to(0.0, 1.0, 1000);
    fast.points[0].velocities = vec![0.0, 0.5];
    assert!(refused(&fast, as_is).starts_with("-1: the last point has a velocity"));
    assert_eq!(refused(&fast, |settings| settings.allows_velocity_at_end = true), "accepted");
    let mut few = to(0.0, 1.0, 1000);
    few.points[0].positions.pop();
    assert!(refused(&few, as_is).starts_with("-1: point 0 has 1 finite values for 2 joints"));
    few.points.clear();
    assert_eq!(refused(&few, as_is), "-1: the trajectory has no points");
}

#[test]
fn positions_are_integrated_from_velocities() {
    let integrating =
        JointTrajectorySettings { integrates: true, ..settings(JointInterfaceKind::Position) };
    let mut manager = running(integrating);
    let point = |ms: i64, speed: f64| TrajectoryPoint {
        velocities: vec![0.0, speed],
        time_from_start_ns: ms * MS,
        ..TrajectoryPoint::default()
    };
    let points = vec![point(1000, 1.0), point(2000, 0.0)];
    let joints = vec!["two".into(), "one".into()];
    let trajectory = JointTrajectory { joints, points, start_ns: 0 };
    arm(&mut manager).start(&trajectory, None, 0).unwrap();
    step(&mut manager, 2000);
    // The mean of 0 and 1 for a second, and of 1 and 0 for another.
    assert_eq!(position(&manager, "one"), 1.0);
}
