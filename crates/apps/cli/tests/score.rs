//! `periplus score` and `periplus compare`.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::Folder;
use serde_json::Value;

fn periplus(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_periplus")).args(arguments).output().unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let done = periplus(arguments);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    serde_json::from_slice(&done.stdout).unwrap()
}

/// Trajectories along x at 1 Hz.
fn write(folder: &Folder, name: &str, positions_m: &[f64]) -> String {
    let line = |(stamp, x): (usize, &f64)| format!("{stamp} {x} 0 0 0 0 0 1\n");
    let path = folder.path(name);
    std::fs::write(&path, positions_m.iter().enumerate().map(line).collect::<String>()).unwrap();
    path.display().to_string()
}

#[test]
fn trajectories_in_files_are_scored_and_compared() {
    let folder = Folder::new("score-files");
    let truth = write(&folder, "truth.tum", &[0.0, 1.0, 2.0, 3.0, 4.0]);
    let first = write(&folder, "first.tum", &[0.0, 1.0, 2.0, 3.0, 4.5]);
    let second = write(&folder, "second.tum", &[0.0, 1.0, 2.0, 3.0, 4.0]);
    let common = ["--truth", &truth, "--align", "none", "--json"];
    let scores = json(&[&["score", first.as_str()], &common[..]].concat());
    assert_eq!(scores["scores"]["estimate.ape_max_m"], 0.5);
    assert_eq!(scores["scores"]["estimate.ape_sse_m2"], 0.25);
    assert_eq!(scores["scores"]["estimate.rpe_mean_m"], 0.125);
    // A file of results is compared as its run is.
    let results = folder.path("first.json");
    std::fs::write(&results, scores.to_string()).unwrap();
    for first in [first.as_str(), results.to_str().unwrap()] {
        let compared = json(&[&["compare", first, second.as_str()], &common[..]].concat());
        assert_eq!(compared["b_minus_a"]["estimate.ape_max_m"], -0.5, "{first}");
        assert_eq!(compared["b"]["scores"]["estimate.ape_max_m"], 0.0, "{first}");
    }
}

#[test]
fn errors_name_the_position_and_the_remedy() {
    let folder = Folder::new("score-errors");
    let truth = write(&folder, "truth.tum", &[0.0, 1.0]);
    let broken = folder.path("broken.tum");
    std::fs::write(&broken, "0 0 0 0 0 0 0 1\n1 2 three 0 0 0 0 1\n").unwrap();
    let check = |arguments: &[&str], code: i32, expected: &str| {
        let done = periplus(arguments);
        let message = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(code), "{message}");
        assert!(message.contains(expected), "{message}");
    };
    check(&["score", broken.to_str().unwrap(), "--truth", &truth], 1, "broken.tum:2:5: `three`");
    check(&["score", &truth], 2, "--truth FILE");
    check(&["score", &truth, "--truth", &truth, "--delta", "1km"], 2, "expected a distance");
    check(&["score", &truth, "--truth", &truth, "--align", "se3"], 1, "do not determine");
}

/// A recorded drive in a circle: SLAM and odometry are near the truth, and the picture shows both runs.
#[test]
fn a_recording_has_its_truth() {
    let folder = Folder::new("score-recording");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let at = |path: &str| root.join(path).display().to_string();
    let (world, drive) = (at("worlds/demo_room.sdf"), at("worlds/drives/circle.yaml"));
    let robot = at("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let path = |name: &str| folder.path(name).display().to_string();
    let (with, without) = (path("with.mcap"), path("without.mcap"));
    // Without the camera, which is slow in a test.
    let topics = "--topics=/(tf|tf_static|scan|odom|map|pose|model_states)$";
    let runs =
        [(&with, "--duration=3", Some("--record-truth")), (&without, "--duration=0.2", None)];
    for (file, duration, truth) in runs {
        let common = ["sim", &world, "--robot", &robot, "--cmd", &drive, "--pose=0,0.8,0"];
        let more =
            ["--slam", duration, topics, "--ros2=off", "--rtf=max", "--quiet", "--record", file];
        let truth: Vec<&str> = truth.into_iter().collect();
        let done = periplus(&[&common[..], &more, &truth].concat());
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    }
    let scores = json(&["score", &with, "--json"]);
    let score = |name: &str| scores["scores"][name].as_f64().unwrap();
    // 0.3 m/s for 3 s, without the time to accelerate.
    assert!((0.6..1.0).contains(&score("run.length_m")), "{scores}");
    assert!(score("localization.ape_rmse_m") < 0.03, "{scores}");
    assert!(score("odometry.ape_rmse_m") < 0.1, "{scores}");
    assert!(score("odometry.pose_count") > 100.0, "{scores}");
    let picture = path("paths.png");
    let done = periplus(&["compare", &with, &with, "--picture", &picture]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    assert!(std::fs::read(&picture).unwrap().starts_with(b"\x89PNG"));
    let refused = periplus(&["score", &without]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("--record-truth"));
}
