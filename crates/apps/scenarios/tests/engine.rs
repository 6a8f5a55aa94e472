//! Events, artifacts, determinism and errors of scenarios.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::disallowed_methods,
    clippy::print_stdout,
    reason = "tests"
)]

mod common;

use std::path::Path;

use common::{options, read_text, run_text};
use expect_test::{Expect, expect};
use periplus_diagnostics::{RenderStyle, render};
use periplus_scenarios::{Scenario, ScenarioRunOptions, junit_xml, run};

const HEAD: &str = "world: ../worlds/demo_room.sdf\n\
    robot: {file: ../robots/sam_bot/urdf/sam_bot.urdf.xacro, pose: [0, 0, 0]}\nphysics: kinematic\n";

/// Findings of a scenario with mistakes.
fn check(text: &str, expected: Expect) {
    let Err(error) = Scenario::read(Path::new("room.yaml"), text.to_owned(), &[]) else {
        panic!("the scenario has no mistakes");
    };
    let findings = error.diagnostics.iter();
    let texts = findings.map(|it| render(it, &error.sources, RenderStyle::Plain));
    expected.assert_eq(&texts.collect::<String>());
}

#[test]
fn mistakes_are_located_and_corrected() {
    check(
        "world: a.sdf\ntimeot: 3\nnodes: [slamm]\nevents:\n  - {at: 3, gaol: [1, 2]}\nassertions:\n  \
         - min_clearence: 0.2\n  - rate: {topic: /scan, hz: fast}\n  - map_iou: 0.9\n",
        expect![[r#"
            error[unknown-section]: a scenario has no `timeot`
             --> room.yaml:2:1
              |
            2 | timeot: 3
              | ^^^^^^
              |
              = note: it has name, description, world, seed, physics, timeout, region, robot, nodes, parameters, variables, faults, drive, events, assertions
            help: did you mean `timeout`?
              |
            2 | timeout: 3
              |      +
            error[unknown-word]: there is no node `slamm`
             --> room.yaml:3:9
              |
            3 | nodes: [slamm]
              |         ^^^^^
              |
              = note: known: slam, localization, costmaps, navigation
            help: did you mean `slam`?
              |
            3 - nodes: [slamm]
            3 + nodes: [slam]
              |
            error[unknown-word]: an event has no `gaol`
             --> room.yaml:5:13
              |
            5 |   - {at: 3, gaol: [1, 2]}
              |             ^^^^
              |
              = note: known: goal, teleport, spawn, remove, set_parameter, publish, name, at, near, on, count, after, delay, fault
            help: did you mean `goal`?
              |
            5 -   - {at: 3, gaol: [1, 2]}
            5 +   - {at: 3, goal: [1, 2]}
              |
            error[unknown-word]: there is no assertion `min_clearence`
             --> room.yaml:7:5
              |
            7 |   - min_clearence: 0.2
              |     ^^^^^^^^^^^^^
              |
              = note: known: reached, no_collision, min_clearance, map_iou, tracking_error, localization_error, odometry_error, rate, latency, in_order, path_ratio, spl
            help: did you mean `min_clearance`?
              |
            7 -   - min_clearence: 0.2
            7 +   - min_clearance: 0.2
              |
            error[bad-value]: `hz`: the value `fast` is not a number
             --> room.yaml:8:30
              |
            8 |   - rate: {topic: /scan, hz: fast}
              |                              ^^^^
            error[missing-node]: `map_iou` needs `nodes: {slam: }`
             --> room.yaml:9:5
              |
            9 |   - map_iou: 0.9
              |     ^^^^^^^
        "#]],
    );
}

#[test]
fn a_scenario_without_assertions_is_refused() {
    check(
        "world: a.sdf\n",
        expect![[r#"
        error[no-assertions]: the scenario asserts nothing
         --> room.yaml:1:1
          |
        1 | world: a.sdf
          | ^^^^^^^^^^^^
          |
          = help: add `assertions`, such as `- no_collision`
    "#]],
    );
}

#[test]
fn unknown_variables_are_reported() {
    check(
        "world: a.sdf\nvariables: {speed: 1}\ntimeout: $(sped)\nassertions: [no_collision]\n",
        expect![[r#"
            error[unknown-variable]: there is no variable `sped`
             --> room.yaml:3:10
              |
            3 | timeout: $(sped)
              |          ^^^^^^^
              |
              = help: declare it in the section `variables`
            help: did you mean `speed`?
              |
            3 - timeout: $(sped)
            3 + timeout: speed
              |
            error[bad-value]: `timeout`: the value `$(sped)` is not a number
             --> room.yaml:3:10
              |
            3 | timeout: $(sped)
              |          ^^^^^^^
              |
              = note: the default is used: 60 s
              = help: this is a xacro expression: name the file `.xacro` so that it is evaluated
        "#]],
    );
}

/// Events by time, position and message, and events that follow others.
#[test]
fn events_happen_by_time_position_and_message() {
    let report = run_text(&format!(
        "{HEAD}timeout: 4\nevents:\n\
         \x20 - {{at: 0.5, teleport: [1, -1], name: first}}\n\
         \x20 - {{near: [1, -1, 0.1], delay: 0.5, publish: {{topic: /go, type: std_msgs/msg/String, message: {{data: now}}}}}}\n\
         \x20 - {{on: /go, teleport: [0, 2, 1]}}\n\
         \x20 - {{after: first, delay: 2, remove: {{model: cube}}}}\n\
         assertions:\n  - reached: {{goal: [1, -1], within: 0.01, before: 0.6}}\n  \
         - reached: {{goal: [0, 2], within: 0.01, before: 1.2}}\n"
    ));
    assert!(report.has_passed(), "{:?}", report.failures());
    let failing = run_text(&format!(
        "{HEAD}timeout: 1\nevents:\n  - remove: {{model: cupe}}\n  \
         - {{set_parameter: {{node: nobody, parameter: a, value: 1}}}}\nassertions: [no_collision]\n"
    ));
    assert_eq!(failing.problems.len(), 2, "{:?}", failing.problems);
    assert!(failing.problems[0].contains("there is no model `cupe`"));
    assert!(!failing.has_passed());
}

/// The same seed gives the same bytes at any number of threads; another seed does not.
#[test]
fn runs_are_equal_to_the_byte() {
    let scenario = read_text(&format!(
        "{HEAD}timeout: 4\nnodes: [slam]\nfaults:\n  - dropout: {{topic: /scan, probability: 0.5}}\n  \
         - latency: {{topic: /demo/odom, mean: 0.05, jitter: 0.02}}\n\
         drive: [{{at: 0, until: 4, rate: 10, linear: 0.2, angular: 0.3}}]\nassertions: [no_collision]\n"
    ));
    let digest = |seed: u64, threads: usize| {
        let options =
            ScenarioRunOptions { seed: Some(seed), has_digest: true, threads, ..options() };
        let report = run(&scenario, &options).unwrap();
        assert!(report.has_passed(), "{:?}", report.failures());
        report.digest.unwrap()
    };
    let first = digest(1, 1);
    assert_eq!(first, digest(1, 2));
    assert_ne!(first, digest(2, 1));
}

/// Artifacts of a run that fails are kept, and its results are in JUnit XML.
#[test]
fn a_failure_leaves_its_artifacts() {
    let folder = std::env::temp_dir().join(format!("periplus-scenario-{}", std::process::id()));
    let with = |distance: f64| {
        let scenario = read_text(&format!(
            "{HEAD}timeout: 1\nnodes: [slam]\nassertions: [min_clearance: {distance}]\n"
        ));
        let options = ScenarioRunOptions { artifacts: Some(folder.clone()), ..options() };
        run(&scenario, &options).unwrap()
    };
    let passed = with(0.1);
    assert!(passed.has_passed() && passed.artifacts.is_none() && !folder.exists());
    let failed = with(3.0);
    assert!(!failed.has_passed());
    for name in ["run.mcap", "run.png", "map.yaml", "log.txt", "report.json", "replay.txt"] {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        assert!(!bytes.is_empty(), "{name}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
    let xml = junit_xml(&[passed, failed]);
    assert!(
        xml.contains("tests=\"2\" failures=\"1\"") && xml.contains("smallest clearance"),
        "{xml}"
    );
}
