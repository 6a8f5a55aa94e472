//! `periplus new`: its files pass every check, drive, map, launch and localize; and the first steps of a new
//! user with deliberate mistakes.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::Folder;
use periplus_bags::Selection;
use periplus_bags::files::Bag;
use periplus_msgs::Message as _;
use periplus_msgs::nav_msgs::Odometry;

/// The program in a folder, without the ROS installation of the machine.
fn periplus(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).current_dir(folder).env("NO_COLOR", "1");
    command.env_remove("AMENT_PREFIX_PATH").env_remove("ROS_PACKAGE_PATH");
    command.output().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&[&output.stdout[..], &output.stderr[..]].concat()).into_owned()
}

/// Runs it successfully; returns its output.
#[track_caller]
fn well(folder: &Path, words: &[&str]) -> String {
    let output = periplus(folder, words);
    assert!(output.status.success(), "periplus {}:\n{}", words.join(" "), told(&output));
    told(&output)
}

/// Runs it to this exit code; returns its output.
#[track_caller]
fn fails(folder: &Path, code: i32, words: &[&str]) -> String {
    let output = periplus(folder, words);
    assert_eq!(
        output.status.code(),
        Some(code),
        "periplus {}:\n{}",
        words.join(" "),
        told(&output)
    );
    told(&output)
}

fn has(program: &str, words: &[&str]) -> bool {
    let output = Command::new(program).args(words).output();
    let has = output.is_ok_and(|output| output.status.success());
    if !has {
        eprintln!("SKIPPED: `{program} {}` does not run here", words.join(" "));
    }
    has
}

/// The last pose of a recorded odometry: x and y \[m\].
fn end_of_drive(bag: &Path) -> (f64, f64) {
    let bag = Bag::open(bag).unwrap();
    let mut messages = bag.messages(Selection::topics(["/odom"]));
    let mut last = None;
    while let Some(message) = messages.next().unwrap() {
        last = Some(Odometry::decode_cdr(message.data).unwrap());
    }
    let place = last.expect("odometry").pose.pose.position;
    (place.x, place.y)
}

const STRAIGHT: &str = "- {at: 1, until: 5, rate: 10, linear: 0.25}\n- {at: 5}\n";
const AROUND: &str = "- {at: 1, until: 5, rate: 10, linear: 0.25}\n\
                      - {at: 5, until: 30, rate: 10, linear: 0.25, angular: 0.25}\n- {at: 30}\n";

#[test]
fn robots_of_every_kind_pass_the_strict_check_and_drive_a_metre() {
    let folder = Folder::new("new-robot");
    std::fs::write(folder.path("straight.yaml"), STRAIGHT).unwrap();
    for (name, more) in [
        ("all", &[][..]),
        ("classic", &["--sim", "classic"][..]),
        ("bare", &["--without", "lidar", "--without", "imu", "--without", "camera"][..]),
    ] {
        well(&folder.0, &[&["new", "robot", name][..], more].concat());
        let file = format!("{name}.urdf.xacro");
        well(&folder.0, &["check", "--strict", &file]);
        for argument in ["sim:=gz", "sim:=classic", "lidar:=true", "camera:=false"] {
            let said = well(&folder.0, &["check", "--strict", &file, argument]);
            assert!(said.contains("no findings"), "{name} {argument}: {said}");
        }
        let bag = format!("{name}.mcap");
        let run = ["sim", &file, "--cmd", "straight.yaml", "--duration", "6", "--record", &bag];
        well(&folder.0, &[&run[..], &["--topics", "/odom"]].concat());
        let (x, y) = end_of_drive(&folder.path(&bag));
        assert!((x - 1.0).abs() < 0.05 && y.abs() < 0.02, "{name} ends at {x}, {y}");
    }
    let said = well(&folder.0, &["doctor", "all.urdf.xacro"]);
    assert!(said.contains("no problems found"), "{said}");
}

#[test]
fn worlds_of_both_simulators_pass_the_strict_check() {
    let folder = Folder::new("new-world");
    for (name, simulator) in [("modern", "gz"), ("classic", "classic")] {
        well(&folder.0, &["new", "world", name, "--sim", simulator]);
        let said = well(&folder.0, &["check", "--strict", &format!("{name}.sdf")]);
        assert!(said.contains("no findings"), "{said}");
        let text = std::fs::read_to_string(folder.path(&format!("{name}.sdf"))).unwrap();
        assert_eq!(text.contains("gz::sim::systems::Sensors"), simulator == "gz");
        assert!(!text.contains('@'), "a placeholder is left over");
    }
}

#[test]
fn nothing_is_overwritten_and_names_are_those_of_packages() {
    let folder = Folder::new("new-twice");
    std::fs::write(folder.path("mine.sdf"), "mine").unwrap();
    std::fs::create_dir_all(folder.path("pack")).unwrap();
    assert!(fails(&folder.0, 1, &["new", "world", "mine"]).contains("is not overwritten"));
    assert_eq!(std::fs::read_to_string(folder.path("mine.sdf")).unwrap(), "mine");
    assert!(fails(&folder.0, 1, &["new", "package", "pack"]).contains("is not overwritten"));
    assert!(std::fs::read_dir(folder.path("pack")).unwrap().next().is_none());
    assert!(fails(&folder.0, 2, &["new", "robot", "My-Bot"]).contains("try `my_bot`"));
    let said = well(&folder.0, &["new", "robot", "bot", "--output", "deep/er"]);
    assert!(said.contains("wrote deep/er/bot.urdf.xacro"), "{said}");
}

#[test]
fn a_package_launches_maps_and_localizes() {
    if !has("python3", &["--version"]) {
        return;
    }
    for simulator in ["gz", "classic"] {
        let folder = Folder::new(&format!("new-package-{simulator}"));
        well(&folder.0, &["new", "package", "kart", "--sim", simulator]);
        let files = ["kart/urdf/kart.urdf.xacro", "kart/worlds/room.sdf"];
        well(&folder.0, &[&["check", "--strict"][..], &files].concat());
        let said = well(&folder.0, &["doctor", "kart/config/nav2_params.yaml"]);
        assert!(said.contains("no problems found"), "{said}");
        let launch = ["launch", "kart", "simulation.launch.py", "nav:=true", "--duration", "3"];
        let said = well(
            &folder.0,
            &[&launch[..], &["--record", "run.mcap", "--exclude", "camera"]].concat(),
        );
        assert!(!said.contains("nothing-fits") && !said.contains("error"), "{said}");
        let said = well(&folder.0, &["bag", "info", "run.mcap"]);
        for topic in
            ["/scan", "/imu", "/odometry/filtered", "/map", "/global_costmap/costmap", "/tf"]
        {
            assert!(
                said.contains(&format!("Topic: {topic} |")),
                "{simulator}: no {topic} in {said}"
            );
        }
        // On a map that is there, instead of drawing one.
        std::fs::write(folder.path("room.pgm"), format!("P2\n4 4\n255\n{}", "254 ".repeat(16)))
            .unwrap();
        let map = "image: room.pgm\nresolution: 2.0\norigin: [-4, -4, 0]\nnegate: 0\n\
                   occupied_thresh: 0.65\nfree_thresh: 0.196\n";
        std::fs::write(folder.path("room.yaml"), map).unwrap();
        let map = format!("map:={}", folder.path("room.yaml").display());
        let launch = ["launch", "kart", "simulation.launch.py", "slam:=false", &map];
        let said = well(&folder.0, &[&launch[..], &["--duration", "2"]].concat());
        assert!(said.contains("/amcl: the built-in node"), "{said}");
    }
}

/// The files as read by the programs that use them.
#[test]
fn others_read_the_files() {
    let folder = Folder::new("new-others");
    well(&folder.0, &["new", "package", "kart"]);
    let robot = folder.path("kart/urdf/kart.urdf.xacro").display().to_string();
    let script = "import sys, xacro; print(xacro.process_file(sys.argv[1], mappings=dict(a.split(':=') for a in sys.argv[2:])).toxml())";
    if has("python3", &["-c", "import xacro"]) {
        for argument in ["sim:=gz", "sim:=classic", "lidar:=false", "publish_odom_tf:=false"] {
            let output =
                Command::new("python3").args(["-c", script, &robot, argument]).output().unwrap();
            assert!(output.status.success(), "{argument}: {}", told(&output));
            if has("check_urdf", &["/dev/null"]) || Path::new("/usr/bin/check_urdf").exists() {
                let urdf = folder.path("expanded.urdf");
                std::fs::write(&urdf, &output.stdout).unwrap();
                let output = Command::new("check_urdf").arg(&urdf).output().unwrap();
                assert!(output.status.success(), "{argument}: {}", told(&output));
            }
        }
    }
    if has("python3", &["-c", "import yaml"]) {
        for name in ["ekf", "slam", "nav2_params", "bridge"] {
            let file = folder.path(&format!("kart/config/{name}.yaml"));
            let script = "import sys, yaml; assert yaml.safe_load(open(sys.argv[1]))";
            let output = Command::new("python3").args(["-c", script]).arg(file).output().unwrap();
            assert!(output.status.success(), "{name}: {}", told(&output));
        }
    }
}

/// First steps of a new user: a robot and a room, three mistakes, `check`, a drive with a map,
/// localization on that map, and both with `--stack`.
#[test]
fn the_walk_of_a_new_user() {
    let folder = Folder::new("walk");
    let here = &folder.0;
    well(here, &["new", "robot", "my_bot", "--without", "camera"]);
    well(here, &["new", "world", "room"]);

    let path = folder.path("my_bot.urdf.xacro");
    let sound = std::fs::read_to_string(&path).unwrap();
    let mistaken = sound
        .replacen("<collision>", "<colision>", 1)
        .replacen("</collision>", "</colision>", 1)
        .replacen("<child link=\"lidar_link\"/>", "<child link=\"lidar_lnk\"/>", 1)
        .replace("wheel_separation>", "wheel_seperation>");
    assert_ne!(sound, mistaken);
    std::fs::write(&path, mistaken).unwrap();
    let said = fails(here, 1, &["check", "my_bot.urdf.xacro"]);
    for help in [
        "did you mean `collision`?",
        "did you mean `lidar_link`?",
        "did you mean `wheel_separation`?",
    ] {
        assert!(said.contains(help), "no `{help}` in\n{said}");
    }
    std::fs::write(&path, sound).unwrap();
    well(here, &["check", "--strict", "my_bot.urdf.xacro"]);

    let said = fails(here, 1, &["sim", "rom.sdf", "--robot", "my_bot.urdf.xacro"]);
    assert!(said.contains("did you mean `room.sdf`?"), "{said}");
    std::fs::write(folder.path("drive.yaml"), AROUND).unwrap();
    let run = ["sim", "room.sdf", "--robot", "my_bot.urdf.xacro", "--cmd", "drive.yaml"];
    let results = ["--duration", "30", "--slam", "--slam-out", "map", "--record", "run.mcap"];
    let said = well(here, &[&run[..], &results].concat());
    assert!(said.contains("map: map"), "{said}");
    let said = well(here, &["map", "info", "map/map.yaml"]);
    assert!(said.contains("8.") && said.contains("cells of 0.05 m"), "{said}");
    let said = well(here, &["localize", "run.mcap", "--map", "map/map.yaml", "--out", "found"]);
    let share = said.lines().find_map(|line| line.trim().strip_prefix("tracking "));
    let share: f64 = share.unwrap().trim_end_matches(" %").parse().unwrap();
    assert!(share > 95.0, "{said}");

    // The usual stack in one option: filter, mapping and costmaps; the map is saved, and the robot is
    // found on it.
    let results = ["--duration", "30", "--stack", "--slam-out", "stack", "--record", "stack.mcap"];
    let said = well(here, &[&run[..], &results].concat());
    assert!(said.contains("stack: scans on /scan"), "{said}");
    assert!(said.contains("map: stack"), "{said}");
    let said = well(here, &["bag", "info", "stack.mcap"]);
    for topic in ["/map", "/local_costmap/costmap", "/global_costmap/costmap"] {
        assert!(said.contains(&format!("Topic: {topic} |")), "no {topic} in {said}");
    }
    let results = ["--duration", "30", "--stack", "--localize", "stack/map.yaml"];
    let said = well(here, &[&run[..], &results].concat());
    assert!(said.contains("localization: (") && said.contains(": Tracking"), "{said}");
    let said = well(here, &["localize", "stack.mcap", "--map", "stack/map.yaml", "--out", "again"]);
    let share = said.lines().find_map(|line| line.trim().strip_prefix("tracking "));
    let share: f64 = share.unwrap().trim_end_matches(" %").parse().unwrap();
    assert!(share > 95.0, "{said}");
}
