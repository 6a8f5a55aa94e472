//! Each kind of fault makes the assertion fail that it should. Without the fault the same run passes.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::disallowed_methods,
    clippy::print_stdout,
    reason = "tests"
)]

mod common;

use std::collections::BTreeSet;

use common::{fault_kinds, run_text};

/// A robot on a floor, driven by a script.
struct Base {
    robot: &'static str,
    /// Top level of the scenario, without faults and assertions.
    head: &'static str,
    /// Assertions that hold without a fault.
    assertions: &'static [&'static str],
}

/// A robot whose IMU and wheels an EKF combines.
const SAM_BOT: &str = "robot: {file: ../robots/sam_bot/urdf/sam_bot.urdf.xacro, pose: [0, 0, 0], \
                       arguments: {drive_wheel_separation: 0.36}}\n";

/// A robot whose odometry counts the turns of its wheels.
const KBOT: &str = "robot: {file: ../robots/kbot/urdf/kbot.urdf.xacro, pose: [0, 0, 0], \
                    arguments: {odometry: encoder, laser_beams: 90}}\n";

/// A circle with scans, without nodes.
const SCANS: Base = Base {
    head: "physics: kinematic\ntimeout: 7\n\
           drive: [{at: 0, until: 7, rate: 10, linear: 0.2, angular: 0.4}]\n",
    assertions: &[
        "rate: {topic: /scan, hz: 5, tolerance: 0.05}",
        "latency: {topic: /scan, max: 0.05}",
        "in_order: {topic: /scan}",
    ],
    robot: SAM_BOT,
};

/// AMCL on the true map, on a circle.
const LOCALIZED: Base = Base {
    head: "physics: kinematic\ntimeout: 16\nnodes: [localization]\n\
           drive: [{at: 0, until: 16, rate: 10, linear: 0.25, angular: 0.4}]\n",
    assertions: &["localization_error: {max: 0.15, from: 3}"],
    robot: SAM_BOT,
};

/// SLAM on a circle.
const MAPPED: Base = Base {
    head: "physics: kinematic\ntimeout: 16\nnodes: [slam]\n\
           drive: [{at: 0, until: 16, rate: 10, linear: 0.25, angular: 0.4}]\n",
    assertions: &["map_iou: 0.9"],
    robot: SAM_BOT,
};

/// An EKF of wheels and IMU.
const FILTERED: Base = Base {
    head: "physics: kinematic\ntimeout: 6\ndrive: [{at: 0, until: 6, rate: 10, linear: 0.2}]\n",
    assertions: &["odometry_error: 0.08"],
    robot: SAM_BOT,
};

/// The navigator drives around the cube, which is on the straight line to the goal.
const AROUND: Base = Base {
    head: "physics: kinematic\ntimeout: 20\nnodes: [navigation]\nevents:\n  \
           - teleport: {model: cube, pose: [0.9, -0.45]}\n  - goal: [1.8, -0.9]\n",
    assertions: &["no_collision", "reached: {within: 0.4}"],
    robot: SAM_BOT,
};

/// Wheels on a floor, and a script that knows the true pose.
const WHEELS: Base = Base {
    head: "timeout: 6\ndrive: [{goto: [1.0, -0.6], speed: 0.4}]\n",
    assertions: &[
        "odometry_error: 0.08",
        "reached: {goal: [1.0, -0.6], within: 0.2}",
        "no_collision",
    ],
    robot: KBOT,
};

/// A drive through the door of the room.
const DOOR: Base = Base {
    head: "physics: kinematic\ntimeout: 14\n\
           drive: [{goto: [0.5, -1.05], speed: 0.6}, {goto: [4.0, -1.05], speed: 0.6}]\n",
    assertions: &["no_collision", "reached: {goal: [4.0, -1.05], within: 0.2}"],
    robot: SAM_BOT,
};

/// Kinds of faults, each with its parameters, its base, and the assertion that it breaks.
const FAULTS: [(&str, &str, &Base, &str); 20] = [
    ("dropout", "{topic: /scan, probability: 0.4}", &SCANS, "rate"),
    ("packet_loss", "{topic: /scan, enter: 0.3, leave: 0.3}", &SCANS, "rate"),
    ("latency", "{topic: /scan, mean: 0.2, jitter: 0.05}", &SCANS, "latency"),
    ("duplicate", "{topic: /scan, probability: 0.5}", &SCANS, "rate"),
    ("reorder", "{topic: /scan, probability: 0.3, delay: 0.3}", &SCANS, "in_order"),
    ("clock_jump", "{topic: /scan, offset: -1, from: 3, until: 4}", &SCANS, "latency"),
    ("bias", "{topic: /scan, scale: 1.4}", &LOCALIZED, "localization_error"),
    ("noise", "{topic: /scan, stddev: 2}", &LOCALIZED, "localization_error"),
    ("stuck_readings", "{topic: /scan, from: 2}", &LOCALIZED, "localization_error"),
    ("kidnap", "{pose: [-1, 1], from: 8}", &LOCALIZED, "localization_error"),
    (
        "blocked_sector",
        "{topic: /scan, min_angle: -2.8, max_angle: 2.8, range: 1}",
        &LOCALIZED,
        "localization_error",
    ),
    ("glass", "{topic: /scan, model: cube}", &AROUND, "no_collision"),
    ("mirror", "{topic: /scan, model: walls}", &MAPPED, "map_iou"),
    ("gyro_drift", "{topic: /demo/imu, rate: 0.2}", &FILTERED, "odometry_error"),
    (
        "wheel_slip",
        "{links: [left_wheel, right_wheel], friction: 0.01, until: 3}",
        &WHEELS,
        "odometry_error",
    ),
    ("low_friction", "{friction: 0.003}", &WHEELS, "odometry_error"),
    ("stuck_wheel", "{joints: [left_wheel_joint]}", &WHEELS, "reached"),
    ("box", "{pose: [2.2, -1.05]}", &DOOR, "no_collision"),
    ("closed_door", "{left: [3, -0.5], right: [3, -1.6]}", &DOOR, "no_collision"),
    ("moved_model", "{model: cube, pose: [2.0, -1.05], from: 1}", &DOOR, "no_collision"),
];

/// Words of the assertions that fail.
fn failing(base: &Base, faults: &str) -> BTreeSet<String> {
    let assertions: String = base.assertions.iter().map(|it| format!("  - {it}\n")).collect();
    let text = format!(
        "world: ../worlds/demo_room.sdf\n{}{}faults: {faults}\nassertions:\n{assertions}",
        base.robot, base.head
    );
    let report = run_text(&text);
    assert!(report.problems.is_empty(), "{faults}: {:?}", report.problems);
    for assertion in &report.assertions {
        println!("{faults}: {}", assertion.message);
    }
    let failed = report.assertions.iter().filter(|it| !it.has_passed);
    failed.map(|it| it.text.split('(').next().unwrap_or_default().to_owned()).collect()
}

fn check(base: &Base) {
    assert_eq!(failing(base, "[]"), BTreeSet::new(), "without a fault");
    for (kind, parameters, of, assertion) in FAULTS {
        if std::ptr::eq(of, base) {
            let failed = failing(base, &format!("[{{{kind}: {parameters}}}]"));
            assert!(failed.contains(assertion), "`{kind}` leaves `{assertion}`: {failed:?}");
        }
    }
}

#[test]
fn faults_of_messages() {
    check(&SCANS);
}

#[test]
fn faults_of_readings_mislead_localization() {
    check(&LOCALIZED);
}

#[test]
fn faults_of_readings_spoil_the_map() {
    check(&MAPPED);
}

#[test]
fn faults_of_a_gyroscope_mislead_the_filter() {
    check(&FILTERED);
}

#[test]
fn glass_hides_an_obstacle_from_the_navigator() {
    check(&AROUND);
}

#[test]
fn faults_of_wheels() {
    check(&WHEELS);
}

#[test]
fn faults_of_the_world() {
    check(&DOOR);
}

#[test]
fn every_kind_is_tested() {
    let tested: BTreeSet<&str> = FAULTS.iter().map(|(kind, ..)| *kind).collect();
    assert_eq!(tested, fault_kinds());
}
