//! Runs that end early: by signals, by a full disk.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files, processes and time")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use common::Folder;

fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

/// A program with the default action for the signals of these tests: one that was started by `nohup`, or
/// in the background of a script, inherits that they are ignored.
fn with_default_signals(program: &str) -> Command {
    if cfg!(target_os = "linux") {
        let mut command = Command::new("env");
        command.args(["--default-signal=HUP,INT,TERM", program]);
        return command;
    }
    Command::new(program)
}

fn start(words: &[&str], log: &Path) -> Child {
    let mut command = with_default_signals(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).current_dir(top()).env("NO_COLOR", "1");
    // No other process is signalled.
    command.env("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF");
    command.stdout(Stdio::null()).stderr(fs::File::create(log).unwrap());
    command.spawn().unwrap()
}

fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let since = Instant::now();
    while !is_so() {
        assert!(since.elapsed() < Duration::from_secs(60), "{what} has not come");
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn send(signal: &str, process: &Child) {
    let status = Command::new("kill").args([signal, &process.id().to_string()]).status();
    assert!(status.unwrap().success());
}

fn end_of(child: &mut Child) -> ExitStatus {
    let mut status = None;
    wait_until("the end", || {
        status = child.try_wait().unwrap();
        status.is_some()
    });
    status.unwrap()
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_default()
}

/// Exit code of a simulation that records and maps, after these signals; its bag and map must be complete.
fn ended_by(name: &str, signals: &[&str]) -> Option<i32> {
    let folder = Folder::new(name);
    let (bag, map, log) = (folder.path("run.mcap"), folder.path("map"), folder.path("log"));
    let mut child = start(
        &[
            "sim",
            "worlds/cube_and_sphere.sdf",
            "--robot",
            "robots/sam_bot/urdf/sam_bot.urdf.xacro",
            "publish_odom_tf:=true",
            "--ros2",
            "off",
            "--record",
            &bag.display().to_string(),
            "--exclude",
            "camera",
            "--slam",
            "--slam-out",
            &map.display().to_string(),
        ],
        &log,
    );
    wait_until("a bag", || fs::metadata(&bag).is_ok_and(|file| file.len() > 20_000));
    for signal in signals {
        send(signal, &child);
    }
    let status = end_of(&mut child);
    let checked =
        Command::new(env!("CARGO_BIN_EXE_periplus")).args(["bag", "check"]).arg(&bag).output();
    let checked = checked.unwrap();
    assert!(checked.status.success(), "{}{}", text(&log), String::from_utf8_lossy(&checked.stdout));
    assert!(
        map.join("map.yaml").is_file() || fs::read_dir(&map).unwrap().count() > 0,
        "{}",
        text(&log)
    );
    status.code()
}

#[test]
fn each_signal_closes_the_bag_and_writes_the_map() {
    assert_eq!(ended_by("ended_term", &["-TERM"]), Some(143));
    assert_eq!(ended_by("ended_hup", &["-HUP"]), Some(129));
    // GNU timeout signals the program and its group.
    assert_eq!(ended_by("ended_twice", &["-INT", "-INT"]), Some(0));
}

/// A launch file whose program starts another one in the background, and writes the ids of both to a file.
fn launch_with_children(folder: &Folder) -> (PathBuf, PathBuf) {
    let numbers = folder.path("numbers");
    let script = folder.path("work.sh");
    let lines =
        format!("sleep 1000 &\necho $! $$ > {0}.part\nmv {0}.part {0}\nwait\n", numbers.display());
    fs::write(&script, lines).unwrap();
    let launch = folder.path("a.launch.xml");
    let text = format!("<launch><executable cmd='sh {}'/></launch>", script.display());
    fs::write(&launch, text).unwrap();
    (launch, numbers)
}

fn is_running(number: &str) -> bool {
    let status = text(&PathBuf::from(format!("/proc/{number}/stat")));
    // A zombie has ended; its parent may be any process.
    !status.is_empty() && !status.rsplit(") ").next().unwrap_or_default().starts_with('Z')
}

#[test]
fn children_of_a_launch_end_with_it_however_it_ends() {
    for (signal, code) in
        [("-TERM", Some(143)), ("-HUP", Some(129)), ("-INT", Some(0)), ("-KILL", None)]
    {
        let folder = Folder::new(&format!("children{signal}"));
        let (launch, numbers) = launch_with_children(&folder);
        let log = folder.path("log");
        let mut child = start(&["launch", &launch.display().to_string(), "--ros2", "off"], &log);
        wait_until("the programs", || numbers.is_file());
        let numbers: Vec<String> = text(&numbers).split_whitespace().map(str::to_owned).collect();
        assert!(numbers.len() == 2 && numbers.iter().all(|one| is_running(one)));
        send(signal, &child);
        assert_eq!(end_of(&mut child).code(), code, "{signal}: {}", text(&log));
        wait_until("the end of the programs", || !numbers.iter().any(|one| is_running(one)));
    }
}

/// A limit on file sizes acts as a full disk for the bag alone. Its signal is ignored, since a full disk
/// sends none.
#[test]
fn a_full_disk_is_reported_while_the_run_goes_on() {
    let folder = Folder::new("full_disk");
    let (bag, map, log) = (folder.path("run.mcap"), folder.path("map"), folder.path("log"));
    let line = format!(
        "trap '' XFSZ; ulimit -f 100; exec {} sim worlds/cube_and_sphere.sdf \
         --robot robots/sam_bot/urdf/sam_bot.urdf.xacro publish_odom_tf:=true --duration 10 --rtf 4 --ros2 off \
         --record {} --exclude camera --slam --slam-out {}",
        env!("CARGO_BIN_EXE_periplus"),
        bag.display(),
        map.display()
    );
    let mut command = Command::new("sh");
    command.args(["-c", &line]).current_dir(top()).env("NO_COLOR", "1");
    command.stderr(fs::File::create(&log).unwrap());
    let mut child = command.spawn().unwrap();
    assert_eq!(end_of(&mut child).code(), Some(1), "{}", text(&log));
    let told = text(&log);
    let at = told.find("stopped at").unwrap_or_else(|| panic!("{told}"));
    assert!(at < told.find("the bag is incomplete").unwrap(), "{told}");
    assert!(told.contains("the run continues"), "{told}");
    assert!(fs::read_dir(&map).unwrap().count() > 0, "the map is written all the same: {told}");
    let info =
        Command::new(env!("CARGO_BIN_EXE_periplus")).args(["bag", "info"]).arg(&bag).output();
    let info = String::from_utf8_lossy(&info.unwrap().stdout).into_owned();
    assert!(info.contains("/scan"), "what is on the disk can be read: {info}");
}
