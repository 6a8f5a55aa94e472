//! The navigation stack with robots that have no configuration, and scripts without topics.
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::Folder;

const SAM_BOT: &str = "robots/sam_bot/urdf/sam_bot.urdf.xacro";
const KBOT: &str = "robots/kbot/urdf/kbot.urdf.xacro";
const DRIVE: &str = "- {at: 0.5, until: 5, linear: 0.3, angular: 0.2}\n";

fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

fn periplus(words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).current_dir(top()).env("NO_COLOR", "1").output().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn topics(bag: &str) -> String {
    String::from_utf8_lossy(&periplus(&["bag", "info", bag]).stdout).into_owned()
}

/// A script of commands in a folder.
fn script(folder: &Folder, text: &str) -> String {
    let path = folder.path("drive.yaml");
    fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// The command of the README: a script without a topic, and a map.
#[test]
fn a_script_and_a_map_with_both_robots() {
    let folder = Folder::new("stack_readme");
    let script = script(&folder, DRIVE);
    for (robot, world, has_filter) in
        [(SAM_BOT, "worlds/cube_and_sphere.sdf", true), (KBOT, "worlds/closed_room.world", false)]
    {
        let out = folder.path(if has_filter { "sam_bot" } else { "kbot" });
        let words = [
            "sim",
            world,
            "--robot",
            robot,
            "--cmd",
            &script,
            "--slam",
            "--duration",
            "6",
            "--slam-out",
            &out.display().to_string(),
        ];
        let output = periplus(&words);
        let told = told(&output);
        assert!(output.status.success(), "{robot}: {told}");
        assert_eq!(told.contains("the EKF of robot_localization"), has_filter, "{robot}: {told}");
        assert!(!told.contains("the map contains"), "{robot}: {told}");
        // The first scan arrives before the first message of the filter.
        let lost =
            told.lines().find_map(|line| line.trim().strip_suffix(" scans had no transforms"));
        let lost: u32 = lost.map_or(0, |count| count.parse().unwrap());
        assert!(lost <= 2, "{robot}: {told}");
        assert!(out.join("map.yaml").is_file(), "{robot}: {told}");
    }
}

#[test]
fn one_option_brings_filter_map_and_costmaps() {
    let folder = Folder::new("stack_all");
    let script = script(&folder, DRIVE);
    for (robot, world) in
        [(SAM_BOT, "worlds/cube_and_sphere.sdf"), (KBOT, "worlds/closed_room.world")]
    {
        let name = robot.split('/').nth(1).unwrap();
        let bag = folder.path(&format!("{name}.mcap")).display().to_string();
        let words = [
            "sim",
            world,
            "--robot",
            robot,
            "--cmd",
            &script,
            "--stack",
            "--duration",
            "4",
            "--record",
            &bag,
            "--topics",
            "map|costmap|filtered",
        ];
        let output = periplus(&words);
        assert!(output.status.success(), "{robot}: {}", told(&output));
        let topics = topics(&bag);
        for wanted in ["/map ", "/local_costmap/costmap ", "/global_costmap/costmap "] {
            assert!(topics.contains(wanted), "{robot}: no {wanted} in {topics}");
        }
        assert!(!told(&output).contains("no update"), "{robot}: {}", told(&output));
        assert_eq!(topics.contains("/odometry/filtered"), name == "sam_bot", "{topics}");
    }
}

#[test]
fn a_map_of_a_robot_that_stands_still_is_warned_of() {
    let words = [
        "sim",
        "worlds/closed_room.world",
        "--robot",
        KBOT,
        "--slam",
        "--duration",
        "2",
        "--quiet",
    ];
    let output = periplus(&words);
    assert!(!told(&output).contains("error"), "{}", told(&output));
    let words = &words[..words.len() - 1];
    assert!(told(&periplus(words)).contains("the map contains one scan"));
}

#[test]
fn commands_that_nobody_takes() {
    let folder = Folder::new("stack_commands");
    let run = |text: &str, robot: &[&str]| {
        let script = script(&folder, text);
        let mut words =
            vec!["sim", "worlds/closed_room.world", "--cmd", &script, "--duration", "0.1"];
        words.extend(robot);
        let output = periplus(&words);
        (output.status.code(), told(&output))
    };
    let (code, told) = run(DRIVE, &[]);
    assert!(
        code == Some(1) && told.contains("no robot of this world subscribes to velocities"),
        "{told}"
    );
    let (code, told) = run("- {at: 0, topic: /cmd_vel, linear: 1}\n", &["--robot", KBOT]);
    assert_eq!(code, Some(0), "{told}");
    assert!(told.contains("nothing subscribes to `/cmd_vel`"), "{told}");
    assert!(told.contains("`/kbot/base_controller/cmd_vel`"), "{told}");
    let (code, told) = run(DRIVE, &["--robot", KBOT]);
    assert!(code == Some(0) && !told.contains("nothing subscribes"), "{told}");
}

#[test]
fn two_copies_of_a_robot() {
    let folder = Folder::new("stack_copies");
    let bag = folder.path("run.mcap").display().to_string();
    let words = [
        "sim",
        "worlds/cube_and_sphere.sdf",
        "--robot",
        SAM_BOT,
        "--robot",
        SAM_BOT,
        "--pose",
        "0,2,0",
        "--duration",
        "0.5",
        "--record",
        &bag,
        "--topics",
        "imu|odom",
    ];
    let output = periplus(&words);
    assert!(output.status.success(), "{}", told(&output));
    let topics = topics(&bag);
    assert!(topics.contains("/sam_bot/") && topics.contains("/sam_bot_1/"), "{topics}");
}

#[test]
fn words_that_are_not_what_they_seem() {
    let words = ["sim", "--robot", KBOT, "worlds/closed_room.world", "--duration", "0.1"];
    let output = periplus(&words);
    assert!(output.status.success(), "{}", told(&output));
    let output =
        periplus(&["sim", "worlds/closed_room.world", "--record", "x.bag", "--duration", "1"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(told(&output).contains("periplus bag convert x.mcap x.bag"), "{}", told(&output));
    let output = periplus(&["sim", "--robot", KBOT, "--duration", "0.1"]);
    assert_eq!(output.status.code(), Some(2), "{}", told(&output));
    let folder = Folder::new("stack_words");
    let file = folder.path("other.yaml");
    fs::write(&file, "talker:\n  ros__parameters:\n    rate: 3\n").unwrap();
    let file = file.display().to_string();
    let words = ["sim", "worlds/closed_room.world", "--robot", KBOT, "--duration", "0.1"];
    let output = periplus(&[&words[..], &["--costmap", &file]].concat());
    assert!(output.status.code() == Some(1) && told(&output).contains("has no costmap"));
    for (text, code, part) in [
        ("talker:\n  ros__parameters:\n    rate: 3\n", 1, "has no parameters for slam_toolbox"),
        ("a: [1, 2\n", 1, "this is not YAML"),
        ("just some words\n", 1, "has no parameters"),
        ("slam_toolbox: {ros__parameters: {resolutoin: 0.1}}\n", 0, "did you mean `resolution`?"),
    ] {
        fs::write(&file, text).unwrap();
        let output = periplus(&[&words[..], &["--slam", &file]].concat());
        assert_eq!(output.status.code(), Some(code), "{text}: {}", told(&output));
        assert!(told(&output).contains(part), "{text}: {}", told(&output));
    }
}

/// Regression test: with the port in use `launch` continued without a page and `sim` stopped; both use another
/// port unless one was named.
#[test]
fn a_page_takes_another_port_where_the_usual_one_is_taken() {
    // Where it cannot be had, another program has it already.
    let _usual = std::net::TcpListener::bind(("127.0.0.1", 8765));
    let page = ["--page", "--no-browser", "--duration", "0.1"];
    let output = periplus(&[&["sim", "worlds/closed_room.world"][..], &page].concat());
    assert!(output.status.success(), "{}", told(&output));
    assert!(
        told(&output).contains("port 8765 is in use; the page uses another port"),
        "{}",
        told(&output)
    );
    let named = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let page = format!("--page={}", named.local_addr().unwrap().port());
    let words = ["sim", "worlds/closed_room.world", &page, "--no-browser", "--duration", "0.1"];
    let output = periplus(&words);
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(
        told(&output).contains("choose another port, such as --page=8766"),
        "{}",
        told(&output)
    );
}

/// Regression test: `launch` warned of these; `sim --robot` and `check` accepted them silently.
#[test]
fn misspelt_arguments_of_xacro_are_named() {
    let world = "worlds/closed_room.world";
    let run = |words: &[&str]| {
        let output = periplus(words);
        let all = format!("{}{}", told(&output), String::from_utf8_lossy(&output.stdout));
        (output.status.code(), all)
    };
    let robot = ["sim", world, "--duration", "0.1", "--robot", KBOT];
    let (code, told) = run(&[&robot[..], &["laser_beams:=180"]].concat());
    assert!(code == Some(0) && !told.contains("has no argument"), "{told}");
    let (code, told) = run(&[&robot[..], &["laser_beem:=180"]].concat());
    assert!(code == Some(0) && told.contains("has no argument `laser_beem`"), "{told}");
    assert!(told.contains("did you mean `laser_beams`?"), "{told}");
    let (_, told) = run(&["sim", world, "speed:=1", "--duration", "0.1"]);
    assert!(told.contains("`closed_room.world` has no argument `speed`"), "{told}");
    assert!(told.contains("only xacro files take arguments"), "{told}");
    let (_, told) = run(&["check", KBOT, "laser_beem:=180"]);
    assert!(told.contains("did you mean `laser_beams`?"), "{told}");
    // Files that are checked together share the arguments.
    let (_, told) = run(&["check", KBOT, world, "laser_beams:=180"]);
    assert!(!told.contains("has no argument"), "{told}");
}
