//! `periplus localize` on logs: global localization, and errors of all inputs.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

use common::Folder;
use serde_json::Value;

/// Cell size \[m\].
const SIDE_M: f64 = 0.05;
const WIDTH: usize = 120;
const HEIGHT: usize = 80;

/// A room of 6 by 4 metres with a pillar and a corner cut off, so that no two poses look alike. Its corner is
/// at (-1, -1).
fn is_wall(column: usize, row: usize) -> bool {
    let boxes = [
        (0, 0, 120, 2),
        (0, 78, 120, 80),
        (0, 0, 2, 80),
        (118, 0, 120, 80),
        (30, 50, 38, 58),
        (90, 0, 120, 16),
    ];
    boxes.iter().any(|&(left, low, right, high)| {
        (left..right).contains(&column) && (low..high).contains(&row)
    })
}

/// Writes the map, with walls where this function returns true.
fn write_map(folder: &Folder, walls: impl Fn(usize, usize) -> bool) {
    let mut image = format!("P5 {WIDTH} {HEIGHT} 255\n").into_bytes();
    for row in (0..HEIGHT).rev() {
        image.extend((0..WIDTH).map(|column| if walls(column, row) { 0 } else { 254 }));
    }
    std::fs::write(folder.path("room.pgm"), image).unwrap();
    let yaml = "image: room.pgm\nresolution: 0.05\norigin: [-1.0, -1.0, 0.0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.25\n";
    std::fs::write(folder.path("room.yaml"), yaml).unwrap();
}

/// Scan of a lidar that looks along x: 180 beams over half a turn.
fn look(x_m: f64, y_m: f64) -> Vec<f64> {
    let beam = |index: usize| {
        let angle = (index as f64 - 90.0).to_radians();
        let hits = |step: &usize| {
            let range_m = 0.02 * *step as f64;
            let cell = |at: f64| ((at + 1.0) / SIDE_M) as usize;
            is_wall(cell(x_m + range_m * angle.cos()), cell(y_m + range_m * angle.sin()))
        };
        0.02 * (1..400).find(hits).unwrap() as f64
    };
    (0..180).map(beam).collect()
}

/// A drive of two metres along x in CARMEN's format; odometry begins at (0, 0).
fn log() -> String {
    let mut log = String::new();
    for step in 0..40_u32 {
        let x_m = 0.05 * f64::from(step);
        let ranges: Vec<String> =
            look(x_m + 0.5, 0.7).iter().map(|range| format!("{range:.2}")).collect();
        let time_s = 1000.0 + 0.1 * f64::from(step);
        writeln!(
            log,
            "FLASER 180 {} {x_m:.4} 0 0 {x_m:.4} 0 0 {time_s:.3} robot 0",
            ranges.join(" ")
        )
        .unwrap();
    }
    log
}

/// A folder with the map and the log.
fn stage(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_map(&folder, is_wall);
    std::fs::write(folder.path("drive.log"), log()).unwrap();
    folder
}

fn localize(folder: &Folder, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.current_dir(&folder.0).arg("localize").args(words).output().unwrap()
}

const USUAL: [&str; 5] = ["drive.log", "--map", "room.yaml", "--out", "out"];

fn report(folder: &Folder) -> Value {
    serde_json::from_slice(&std::fs::read(folder.path("out/report.json")).unwrap()).unwrap()
}

#[test]
fn a_robot_finds_itself_and_says_when() {
    let folder = stage("localize");
    let output = localize(&folder, &USUAL);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let trajectory = std::fs::read_to_string(folder.path("out/trajectory.txt")).unwrap();
    let last: Vec<f64> =
        trajectory.lines().last().unwrap().split(' ').map(|it| it.parse().unwrap()).collect();
    // Odometry began at (0.5, 0.7), and the last of 40 steps ends 1.95 m further.
    assert!((last[1] - 2.45).hypot(last[2] - 0.7) < 0.06, "{last:?}");
    let report = report(&folder);
    assert!(report["settled_after_m"].as_f64().unwrap() < 1.0, "{report:#}");
    assert!(Path::new(&folder.path("out/trajectory.png")).is_file());
}

/// Errors and their exit codes.
#[track_caller]
fn refused(folder: &Folder, words: &[&str], code: i32, expected: &[&str]) {
    let output = localize(folder, words);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{words:?}: {said}");
    for part in expected {
        assert!(said.contains(part), "{words:?} has to say `{part}`, and says: {said}");
    }
}

#[test]
fn what_is_wrong_with_the_map_is_said() {
    let folder = stage("localize-map");
    let words = ["drive.log", "--map", "none.yaml", "--out", "out"];
    refused(&folder, &words, 1, &["none.yaml"]);
    refused(&folder, &["drive.log", "--out", "out"], 2, &["--map <MAP.yaml>"]);
    std::fs::remove_file(folder.path("room.pgm")).unwrap();
    // The finding is located at the name of the image.
    refused(&folder, &USUAL, 1, &["room.yaml:1", "room.pgm"]);
    write_map(&folder, |_, _| false);
    refused(
        &folder,
        &USUAL,
        1,
        &["no cell of the map is occupied, so scans cannot be matched", "occupied_thresh"],
    );
}

#[test]
fn what_is_wrong_with_the_log_is_said() {
    let folder = stage("localize-log");
    let words = ["none.log", "--map", "room.yaml", "--out", "out"];
    refused(&folder, &words, 1, &["cannot read none.log"]);
    std::fs::write(folder.path("drive.log"), "# CARMEN Logfile\nPARAM robot_width 0.5\n").unwrap();
    refused(&folder, &USUAL, 1, &["`drive.log` is not a bag"]);
    // Scans without ranges are left out, and nothing is made up from them.
    std::fs::write(folder.path("drive.log"), "FLASER 0 0 0 0 0 0 0 1000.0 robot 0\n".repeat(20))
        .unwrap();
    let output = localize(&folder, &USUAL);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let report = report(&folder);
    assert!(report["settled_after_s"].is_null(), "{report:#}");
    assert!(!report.to_string().contains("tracking"), "{report:#}");
}

#[test]
fn what_is_wrong_with_the_initial_pose_is_said() {
    let folder = stage("localize-pose");
    let with = |more: &[&'static str]| -> Vec<&str> { USUAL.iter().chain(more).copied().collect() };
    refused(
        &folder,
        &with(&["--initial-pose", "nan,0,0"]),
        2,
        &["`nan,0,0` is not a pose; write X,Y,YAW"],
    );
    refused(
        &folder,
        &with(&["--initial-pose", "77,0,0"]),
        1,
        &["the initial pose (77.000, 0.000) is outside of the map", "the map extends from"],
    );
    refused(&folder, &with(&["-p", "max_particles:=many"]), 2, &["max_particles"]);
    // A right one is taken.
    let output = localize(&folder, &with(&["--initial-pose", "0.5,0.7,0"]));
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}
