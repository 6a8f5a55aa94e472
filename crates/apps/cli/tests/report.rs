//! `periplus report` and `periplus rerun`.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::path::Path;
use std::process::Command;

use common::Folder;

fn periplus(arguments: &[&str]) -> String {
    let done = Command::new(env!("CARGO_BIN_EXE_periplus")).args(arguments).output().unwrap();
    assert!(done.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).unwrap()
}

/// A drive in a circle, its map with coarser cells, and the reports on one and on both.
#[test]
fn a_report_is_one_file_without_script_and_network() {
    let folder = Folder::new("report");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let at = |path: &str| root.join(path).display().to_string();
    let path = |name: &str| folder.path(name).display().to_string();
    let (run, coarse) = (path("run<1>.mcap"), path("coarse.mcap"));
    let (world, drive) = (at("worlds/demo_room.sdf"), at("worlds/drives/circle.yaml"));
    let robot = at("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let topics =
        "--topics=/(tf|tf_static|scan|odom|map|pose|rosout|robot_description|model_states)$";
    periplus(&[
        "sim",
        &world,
        "--robot",
        &robot,
        "publish_odom_tf:=true",
        "--cmd",
        &drive,
        "--slam",
        "--duration",
        "8",
        "--quiet",
        "--record",
        &run,
        "--record-truth",
        topics,
    ]);
    periplus(&["rerun", "slam", &run, "-p", "resolution:=0.1", "-o", &coarse, "--quiet"]);
    periplus(&["report", &run]);
    let one = std::fs::read_to_string(path("run<1>.html")).unwrap();
    for part in ["Run run&lt;1&gt;.mcap", "sam_bot", "localization.ape_rmse_m", "Speed [m/s]"] {
        assert!(one.contains(part), "{part}");
    }
    let both = path("both.html");
    let printed = periplus(&["report", &run, &coarse, "-o", &both, "--json"]);
    let printed: serde_json::Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(printed["report"], both);
    assert!(printed["runs"][0]["scores"]["localization.ape_rmse_m"].is_f64(), "{printed}");
    let scored = serde_json::from_str::<serde_json::Value>(&periplus(&["score", &run, "--json"]));
    assert_eq!(printed["runs"][0]["scores"], scored.unwrap()["scores"]);
    assert_eq!(printed["runs"].as_array().unwrap().len(), 2);
    let both = std::fs::read_to_string(both).unwrap();
    assert!(both.contains("Cells that both maps know") && both.contains("m RMS"));
    for html in [one, both] {
        assert!(!html.contains("<script") && !html.contains("http:") && !html.contains("https:"));
        assert_eq!(html.matches("<svg").count(), html.matches("</svg>").count());
        assert_eq!(html.matches("<figure>").count(), html.matches("</figure>").count());
    }
}
