//! Exit codes and messages of every command for missing and wrong arguments: 1 for a job that failed, 2 for
//! wrong usage; error numbers of the system are never shown, and similar names are proposed.
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests write files")]

mod common;

use std::path::Path;
use std::process::Command;

use common::Folder;

/// Exit code and all output.
fn run(folder: &Path, line: &str) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_periplus"))
        .args(line.split(' ').filter(|word| !word.is_empty()))
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .env("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
        .output()
        .unwrap();
    let text = [&output.stdout[..], &output.stderr[..]].concat();
    (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&text).into_owned())
}

#[track_caller]
fn check(folder: &Path, code: i32, line: &str) -> String {
    let (got, text) = run(folder, line);
    assert_eq!(got, code, "periplus {line}\n{text}");
    assert!(!text.contains("os error"), "periplus {line}\n{text}");
    assert!(!text.trim().is_empty(), "periplus {line} says nothing");
    text
}

/// A missing file fails the job, for every command that reads it.
#[test]
fn a_missing_file_is_1_everywhere() {
    let folder = Folder::new("usage-missing");
    let sound = "image: room.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n\
                 occupied_thresh: 0.65\nfree_thresh: 0.2\n";
    std::fs::write(folder.path("room.yaml"), sound).unwrap();
    std::fs::write(folder.path("room.pgm"), "P2\n1 1\n255\n254\n").unwrap();
    std::fs::write(folder.path("bot.urdf"), "<robot name=\"b\"><link name=\"l\"/></robot>")
        .unwrap();
    for line in [
        "check no.urdf",
        "view --no-browser --page=0 no.mcap",
        "convert no.urdf --to sdf",
        "sim no.sdf",
        "sim no.sdf --robot bot.urdf",
        "sim bot.urdf --robot no.urdf --duration 0.1",
        "sim bot.urdf --cmd no.yaml --duration 0.1",
        "sim bot.urdf --slam no.yaml --duration 0.1",
        "sim bot.urdf --costmap no.yaml --duration 0.1",
        "sim bot.urdf --localize no.yaml --duration 0.1",
        "launch no.launch.py",
        "launch no_package no.launch.py",
        "doctor no.urdf",
        "doctor no.yaml",
        "doctor no.launch.py",
        "doctor costmap no.yaml",
        "costmap no.yaml",
        "slam no.mcap --out out",
        "slam no.clf --out out",
        "slam no.bag --out out --params-file no.yaml",
        "localize no.mcap --map room.yaml --out out",
        "map info no.yaml",
        "map convert no.yaml -o other",
        "map diff room.yaml no.yaml",
        "bag info no.mcap",
        "bag check no.mcap",
        "bag play no.mcap",
        "bag cut no.mcap -o part.mcap --topics /scan",
        "bag convert no.mcap -o other.mcap",
        "bag reindex no",
        "tf tree no.mcap",
        "conformance no",
        "bridge --config no.yaml",
        "param load /node no.yaml",
    ] {
        check(&folder.0, 1, line);
    }
}

/// Unknown arguments are wrong usage, for every command.
#[test]
fn wrong_words_are_2_everywhere() {
    let folder = Folder::new("usage-words");
    for line in [
        "foo",
        "ros2 foo",
        "ros2",
        "gz foo",
        "ign foo",
        "gz",
        "ros2 bag foo",
        "ros2 topic foo",
        "rostopic foo",
        "rosbag foo",
        "rosnode foo",
        "sim",
        "sim a.sdf b.sdf",
        "sim a.sdf --duration nothing",
        "sim a.sdf --foo",
        "launch",
        "check",
        "check name:=value",
        "convert a.sdf",
        "slam a.mcap",
        "localize",
        "map foo",
        "map info",
        "bag foo",
        "bag info",
        "topic foo",
        "topic echo",
        "topic echo /x --qos-reliability bst",
        "topic echo /x --qos-durability transient",
        "topic pub",
        "node info",
        "param get /x",
        "service call",
        "action send_goal /x",
        "lifecycle set /x",
        "interface show",
        "tf echo map",
        "new",
        "new robot",
        "new robot Wrong-Name",
        "doctor a.sdf b.sdf",
        "completions nushell2",
        "teleop --foo",
        "costmap",
        "conformance",
    ] {
        check(&folder.0, 2, line);
    }
}

/// A failed write is reported with its path, and the command fails.
#[test]
fn a_place_that_cannot_be_written_is_1() {
    let folder = Folder::new("usage-write");
    std::fs::write(folder.path("file"), "").unwrap();
    let robot = "<robot name=\"b\"><link name=\"l\"><inertial><mass value=\"1\"/>\
                 <inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link></robot>";
    std::fs::write(folder.path("bot.urdf"), robot).unwrap();
    std::fs::write(folder.path("log.clf"), "FLASER 3 1 1 1 0 0 0 0 0 0 1 h 1\n").unwrap();
    for line in [
        "convert bot.urdf --to sdf -o file/bot.sdf",
        "sim bot.urdf --duration 0.1 --record file/run.mcap",
        "slam log.clf --out file/out",
        "new robot other -o file/deeper",
        "man file/man",
        "demo --headless --duration 0.1 --out file/demo",
    ] {
        let text = check(&folder.0, 1, line);
        assert!(text.contains("file"), "periplus {line}\n{text}");
        assert!(!text.contains("are in file"), "periplus {line}\n{text}");
    }
}

/// Similar names of files and commands are proposed.
#[test]
fn slips_are_recognised() {
    let folder = Folder::new("usage-slips");
    let inner = folder.path("worlds");
    std::fs::create_dir_all(&inner).unwrap();
    std::fs::write(inner.join("house.sdf"), "<sdf version=\"1.9\"><world name=\"w\"/></sdf>")
        .unwrap();
    std::fs::write(folder.path("nav2_params.yaml"), "a: 1\n").unwrap();
    std::fs::write(folder.path("run.mcap"), "").unwrap();
    std::fs::write(folder.path("bot.launch.xml"), "<launch/>").unwrap();
    for (code, line, near) in [
        (1, "sim worlds/hous.sdf", "worlds/house.sdf"),
        (1, "check house.sdf", "worlds/house.sdf"),
        (1, "check world/house.sdf", "worlds/house.sdf"),
        (1, "doctor nav_params.yaml", "nav2_params.yaml"),
        (1, "doctor costmap nav_params.yaml", "nav2_params.yaml"),
        (1, "bag info rn.mcap", "run.mcap"),
        (1, "slam rum.mcap --out out", "run.mcap"),
        (1, "launch bt.launch.xml", "bot.launch.xml"),
        (2, "ros2 topc list", "ros2 topic"),
        (2, "gz topc -l", "gz topic"),
        (2, "slamm", "slam"),
        (2, "topic ech /scan", "echo"),
        (2, "topic echo /x --qos-reliability bst", "best_effort"),
    ] {
        let text = check(&folder.0, code, line);
        assert!(text.contains(near), "periplus {line}: no `{near}` in\n{text}");
    }
}

/// Manual pages are written to a folder, which is created.
#[test]
fn manual_pages_make_their_folder() {
    let folder = Folder::new("usage-man");
    check(&folder.0, 0, "man deep/er");
    assert!(folder.path("deep/er/periplus-sim.1").is_file());
    let page = std::fs::read_to_string(folder.path("deep/er/periplus-sim.1")).unwrap();
    assert!(page.contains("Examples") && !page.contains('\u{1b}'));
}

/// Old names of options work for one release, with a notice.
#[test]
fn deprecated_options_print_a_notice() {
    let folder = Folder::new("usage-deprecated");
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../worlds/closed_room.world");
    let line = format!("sim {} --duration 0.01 --ros2 off", world.display());
    let notice = "`--hear` is deprecated: use `--compute`";
    assert!(check(&folder.0, 0, &format!("{line} --hear scan")).contains(notice));
    assert!(!check(&folder.0, 0, &format!("{line} --compute scan")).contains(notice));
    check(&folder.0, 2, &format!("{line} --hear scan --compute scan"));
}

/// Files that are no recordings are reported; the page is not served.
#[test]
fn what_is_no_recording_is_not_replayed() {
    let folder = Folder::new("usage-view");
    std::fs::write(folder.path("notes.txt"), "hello").unwrap();
    std::fs::create_dir(folder.path("empty")).unwrap();
    let text = check(&folder.0, 1, "view --no-browser --page=0 notes.txt");
    assert!(text.contains("neither MCAP") && !text.contains("http://"), "{text}");
    let text = check(&folder.0, 1, "view --no-browser --page=0 empty");
    assert!(text.contains("no .mcap and no .db3 file"), "{text}");
    check(&folder.0, 2, "view --no-browser --page=robot notes.txt");
}
