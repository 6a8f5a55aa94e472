//! The command with real ROS 2 programs: rclpy on rmw_fastrtps_cpp, from PyPI. Missing peers are skipped with
//! a message.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use common::Folder;

mod common;

const LONG: Duration = Duration::from_secs(60);

/// A separate domain for each test.
#[derive(Clone, Copy)]
struct Domain(u32);

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

/// Python with ROS.
fn ros() -> Option<PathBuf> {
    let python = here().join("../../../target/peers/ros2/bin/python");
    let mut asked = Command::new(&python);
    asked.args(["-c", "import rclpy, std_srvs.srv, test_msgs.action"]).stderr(Stdio::null());
    if asked.status().is_ok_and(|status| status.success()) {
        return Some(python);
    }
    eprintln!(
        "SKIPPED: no ROS 2 to test against; python3.12 -m venv target/peers/ros2 && \
         target/peers/ros2/bin/pip install -r .ci/ros2.txt"
    );
    None
}

/// A program that runs; it is killed when this is dropped.
struct Running {
    child: Child,
    lines: Receiver<String>,
}

impl Running {
    /// Lines of stdout and stderr as one stream.
    fn start(command: &mut Command) -> Self {
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (send, lines) = channel();
        let outputs: [Box<dyn Read + Send>; 2] =
            [Box::new(child.stdout.take().unwrap()), Box::new(child.stderr.take().unwrap())];
        for output in outputs {
            let (output, send) = (BufReader::new(output), send.clone());
            std::thread::spawn(move || {
                output.lines().map_while(Result::ok).try_for_each(|line| send.send(line))
            });
        }
        Self { child, lines }
    }

    /// The next line that contains these words.
    #[track_caller]
    fn tells(&self, wanted: &str) {
        let end = Instant::now() + LONG;
        loop {
            let rest = end.saturating_duration_since(Instant::now());
            let line = self.lines.recv_timeout(rest);
            let line = line.unwrap_or_else(|_| panic!("no line has `{wanted}`"));
            if line.contains(wanted) {
                return;
            }
        }
    }

    /// The next line with this prefix.
    #[track_caller]
    fn says(&self, wanted: &str) -> String {
        let end = Instant::now() + LONG;
        loop {
            let rest = end.saturating_duration_since(Instant::now());
            let line = self.lines.recv_timeout(rest);
            let line = line.unwrap_or_else(|_| panic!("no line begins with `{wanted}`"));
            if line.starts_with(wanted) {
                return line;
            }
        }
    }

    /// CPU time so far, of all threads.
    fn processor(&self) -> Duration {
        let threads = std::fs::read_dir(format!("/proc/{}/task", self.child.id())).unwrap();
        let times = threads.map(|thread| {
            let text = std::fs::read_to_string(thread.unwrap().path().join("schedstat")).unwrap();
            text.split(' ').next().unwrap().parse::<u64>().unwrap()
        });
        Duration::from_nanos(times.sum())
    }

    /// Number of sleeps and wake-ups of threads.
    #[cfg(target_os = "linux")]
    fn wakes(&self) -> u64 {
        let threads = std::fs::read_dir(format!("/proc/{}/task", self.child.id())).unwrap();
        let counts = threads.map(|thread| {
            let status = std::fs::read_to_string(thread.unwrap().path().join("status")).unwrap();
            let count = status.lines().find_map(|it| it.strip_prefix("voluntary_ctxt_switches:"));
            count.unwrap().trim().parse::<u64>().unwrap()
        });
        counts.sum()
    }

    /// Fraction of a core that the program uses during a window.
    fn load_ratio(&self) -> f64 {
        const WINDOW: Duration = Duration::from_secs(3);
        let (start, clock) = (self.processor(), Instant::now());
        std::thread::sleep(WINDOW);
        self.processor().saturating_sub(start).as_secs_f64() / clock.elapsed().as_secs_f64()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Domain {
    fn set(self, mut command: Command, range: Option<&str>) -> Command {
        command.env("ROS_DOMAIN_ID", self.0.to_string());
        for name in ["ROS_LOCALHOST_ONLY", "ROS_STATIC_PEERS", "ROS_AUTOMATIC_DISCOVERY_RANGE"] {
            command.env_remove(name);
        }
        if let Some(range) = range {
            command.env("ROS_AUTOMATIC_DISCOVERY_RANGE", range);
        }
        command
    }

    fn peer(self, python: &Path, range: Option<&str>, words: &[&str]) -> Running {
        let mut command = Command::new(python);
        command.arg(here().join("tests/peers/rclpy_peer.py")).args(words);
        Running::start(&mut self.set(command, range))
    }

    fn periplus(self, range: Option<&str>, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
        command.args(words);
        self.set(command, range)
    }

    /// Exit code, standard output and standard error.
    fn ends(self, words: &[&str]) -> (Option<i32>, String, String) {
        let Output { status, stdout, stderr } = self.periplus(None, words).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (status.code(), text(stdout), text(stderr))
    }

    fn gives(self, words: &[&str]) -> String {
        let Output { status, stdout, stderr } = self.periplus(None, words).output().unwrap();
        let stderr = String::from_utf8_lossy(&stderr);
        assert!(status.success(), "{words:?}: {stderr}");
        assert!(!stderr.contains("incomplete"), "{words:?}: {stderr}");
        String::from_utf8(stdout).unwrap()
    }

    /// A server of a small map.
    fn map_server(self) -> (Running, Folder) {
        let folder = Folder::new(&format!("ros2-{}", self.0));
        let map = write_map(&folder);
        (Running::start(&mut self.periplus(None, &["map", "serve", &map])), folder)
    }
}

/// Writes a small map; returns the path of its YAML.
fn write_map(folder: &Folder) -> String {
    std::fs::write(folder.path("map.pgm"), b"P2 2 2 255 0 254 254 0 ").unwrap();
    let yaml = "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.25\n";
    let map = folder.path("map.yaml");
    std::fs::write(&map, yaml).unwrap();
    map.to_string_lossy().into_owned()
}

/// Regression test: each service had two response writers, for two vendors, and no client of rmw_fastrtps
/// found it ready. After the first call a thread of the server never slept again.
#[test]
fn every_service_is_ready_and_answers_and_the_server_rests_afterwards() {
    let Some(python) = ros() else { return };
    let domain = Domain(111);
    let (server, _folder) = domain.map_server();
    // Services that answer others are there before the window begins.
    domain.gives(&["node", "list"]);
    let before = server.load_ratio();
    let caller = domain.peer(&python, None, &["call", "100"]);
    let mut called = Vec::new();
    let slowest = loop {
        let line = caller.lines.recv_timeout(LONG).unwrap();
        if let Some(slowest) = line.strip_prefix("slowest ") {
            break slowest.parse::<u64>().unwrap();
        }
        assert!(!line.starts_with("FAILED "), "{line}");
        if line.starts_with("called ") {
            called.push(line);
        }
    };
    assert!(called.len() >= 10, "{called:?}");
    assert!(called.contains(&"called /map_server/list_parameters".to_owned()), "{called:?}");
    // A client that finds no service ready waits the whole 5 s of the peer.
    assert!(slowest < 4000, "the slowest took {slowest} ms");
    drop(caller);
    // Another program's noise may disturb one window, a thread that never sleeps shows in each.
    let after: Vec<f64> = (0..3)
        .map(|_| server.load_ratio())
        .scan(false, |is_over, ratio| {
            let go_on = !*is_over;
            *is_over = ratio <= before + 0.01;
            go_on.then_some(ratio)
        })
        .collect();
    eprintln!("fraction of a core: {before:.4} before, {after:.4?} after 100 calls");
    assert!(after.iter().any(|ratio| *ratio <= before + 0.01), "{before} before, {after:?} after");
}

/// Regression test: every step of the clock, 200 per second, woke the threads of all nodes of a program,
/// which took more than half of the CPU time of `localize --live`.
#[test]
#[cfg(target_os = "linux")]
fn a_filter_without_scans_rarely_wakes() {
    /// 250 wake-ups of the filter (which polls for scans at 50 Hz), the transport and DDS; 520 to 590 before.
    const MAX_WAKES_PER_S: f64 = 400.0;
    const WINDOW: Duration = Duration::from_secs(2);
    let domain = Domain(123);
    let folder = Folder::new("wakes");
    let map = write_map(&folder);
    let words = ["localize", "--live", "--map", &map, "--initial-pose", "0,0,0"];
    let filter = Running::start(&mut domain.periplus(None, &words));
    filter.tells("received a map of 2 by 2 cells");
    let (before, start) = (filter.wakes(), Instant::now());
    std::thread::sleep(WINDOW);
    let wakes_per_s = (filter.wakes() - before) as f64 / start.elapsed().as_secs_f64();
    assert!(wakes_per_s < MAX_WAKES_PER_S, "{wakes_per_s:.0} wakes per second");
}

/// Regression test: lists were printed after 0.7 s, but nodes of Fast DDS announce their names only on a
/// request of Fast DDS, or after 3 s.
#[test]
fn lists_name_all_nodes_of_ros() {
    let Some(python) = ros() else { return };
    let domain = Domain(112);
    let peer = domain.peer(&python, None, &["nodes", "5", "n"]);
    peer.says("ready");
    let all: String = (0..5).map(|number| format!("/n{number}\n")).collect();
    for _ in 0..3 {
        assert_eq!(domain.gives(&["node", "list"]), all);
    }
    let services = domain.gives(&["service", "list"]);
    assert_eq!(services.matches("/trigger\n").count(), 5, "{services}");
    let info = domain.gives(&["topic", "info", "-v", "/chatter"]);
    assert_eq!(info.matches("Node name: n").count(), 5, "{info}");
    let parameters = domain.gives(&["param", "list"]);
    assert_eq!(parameters.matches("  number\n").count(), 5, "{parameters}");
}

#[test]
fn verbs_work_with_a_node_of_ros() {
    let Some(python) = ros() else { return };
    let domain = Domain(113);
    let robot = domain.peer(&python, None, &["robot"]);
    robot.says("ready");
    assert_eq!(domain.gives(&["topic", "echo", "--once", "/chatter"]), "data: hello\n---\n");
    domain.gives(&["topic", "pub", "--once", "/commands", "std_msgs/msg/String", "data: go"]);
    robot.says("heard go");
    let answer = domain.gives(&["service", "call", "/trigger", "std_srvs/srv/Trigger"]);
    assert!(answer.contains("message='from ros'"), "{answer}");
    assert_eq!(domain.gives(&["param", "get", "/robot", "speed"]), "Double value is: 0.5\n");
    domain.gives(&["param", "set", "/robot", "speed", "1.5"]);
    assert_eq!(domain.gives(&["param", "get", "/robot", "speed"]), "Double value is: 1.5\n");
    let info = domain.gives(&["action", "info", "/fibonacci"]);
    assert!(info.contains("Action servers: 1\n    /robot\n"), "{info}");
    // PyPI has test_msgs of ROS, whose action is that of example_interfaces under another name.
    let files = here().join("tests/peers/interfaces");
    let interfaces = files.to_string_lossy();
    let goal = domain.gives(&[
        "action",
        "send_goal",
        "--interfaces",
        &interfaces,
        "--feedback",
        "/fibonacci",
        "test_msgs/action/Fibonacci",
        "order: 5",
    ]);
    for part in [
        "Waiting for an action server to become available...\nSending goal:",
        "Goal accepted",
        "sequence:\n- 0\n- 1\n- 1\n- 2\n- 3\n- 5\n",
        "SUCCEEDED",
    ] {
        assert!(goal.contains(part), "{goal}");
    }
    // A refusal is a failure of ours; `ros2` prints it and exits with 0.
    let send = ["action", "send_goal", "--interfaces", &interfaces, "/fibonacci"];
    let send = [&send[..], &["test_msgs/action/Fibonacci", "order: 50"]].concat();
    let (code, stdout, stderr) = domain.ends(&send);
    assert_eq!(code, Some(1), "{stdout}{stderr}");
    assert!(stderr.contains("error: Goal was rejected."), "{stderr}");
    let (code, stdout, stderr) = domain.ends(&[&["ros2"], &send[..]].concat());
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    assert!(stdout.ends_with("Goal was rejected.\n"), "{stdout}");
    let set = ["param", "set", "/robot", "fixed", "2"];
    let (code, _, stderr) = domain.ends(&set);
    assert_eq!(code, Some(1), "{stderr}");
    assert!(stderr.contains("error: Setting parameter failed: "), "{stderr}");
    let (code, _, stderr) = domain.ends(&[&["ros2"], &set[..]].concat());
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.lines().any(|line| line.starts_with("Setting parameter failed: ")), "{stderr}");
}

/// A ROS node in the range LOCALHOST receives no multicast, and announces only addresses of this machine.
#[test]
fn ranges_meet_on_one_machine() {
    let Some(python) = ros() else { return };
    let cases =
        [(114, "SUBNET", "LOCALHOST"), (115, "LOCALHOST", "SUBNET"), (116, "SUBNET", "SUBNET")];
    let peers = cases.map(|(number, ours, theirs)| {
        let peer = Domain(number).peer(&python, Some(theirs), &["meet", "/there", "/back"]);
        (Domain(number), ours, peer)
    });
    for (domain, ours, hears) in peers {
        let words = ["topic", "pub", "-r", "20", "/there", "std_msgs/msg/String", "data: hello"];
        let _talks = Running::start(&mut domain.periplus(Some(ours), &words));
        let echo = ["topic", "echo", "/back", "std_msgs/msg/String"];
        let echo = Running::start(&mut domain.periplus(Some(ours), &echo));
        hears.says("heard hello");
        echo.says("data: hello");
    }
}

/// In the range OFF no program is found, not even by a node that searches all ports of the machine.
#[test]
fn nobody_is_found_in_the_range_off() {
    let Some(python) = ros() else { return };
    let domain = Domain(117);
    let hears = domain.peer(&python, Some("LOCALHOST"), &["meet", "/there", "/back"]);
    hears.says("ready");
    let words = ["topic", "pub", "-r", "50", "/there", "std_msgs/msg/String", "data: hello"];
    let talks = Running::start(&mut domain.periplus(Some("OFF"), &words));
    talks.says("publishing #100:");
    while let Ok(line) = hears.lines.try_recv() {
        assert!(!line.starts_with("heard "), "{line}");
    }
}

/// The range of this machine applies to the ports too.
#[test]
#[cfg(target_os = "linux")]
fn ports_of_this_machine_only_are_bound_to_it() {
    let domain = Domain(118);
    let (server, _folder) = domain.map_server();
    let first = 7400 + 250 * domain.0;
    let end = Instant::now() + LONG;
    let bound = loop {
        let udp = std::fs::read_to_string(format!("/proc/{}/net/udp", server.child.id())).unwrap();
        let local = udp.lines().filter_map(|line| line.split_whitespace().nth(1)?.split_once(':'));
        let bound: Vec<_> = local
            .filter_map(|(address, port)| {
                Some((address.to_owned(), u32::from_str_radix(port, 16).ok()?))
            })
            .filter(|(_, port)| (first..first + 250).contains(port))
            .collect();
        // Multicast, discovery and data.
        if bound.len() >= 3 || Instant::now() > end {
            break bound;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    assert!(bound.len() >= 3, "{bound:?}");
    // 127.0.0.1, and for multicast the group 239.255.0.1.
    assert!(bound.iter().all(|(at, _)| at == "0100007F" || at == "0100FFEF"), "{bound:?}");
}

/// A Python with PyPI's `cyclonedds`: PyPI's ROS 2 has no messages of `bond`.
fn cyclone() -> Option<PathBuf> {
    let own = here().join("../../../.venv/bin/python");
    let has = |python: &PathBuf| {
        let mut asked = Command::new(python);
        asked.args(["-c", "import cyclonedds"]).stderr(Stdio::null());
        asked.status().is_ok_and(|status| status.success())
    };
    let found = ["python3".into(), own].into_iter().find(has);
    if found.is_none() {
        eprintln!("SKIPPED: no Cyclone DDS to test against; pip install cyclonedds==11.0.1");
    }
    found
}

impl Domain {
    fn bond(self, python: &Path, role: &str, name: &str) -> Running {
        let mut command = Command::new(python);
        command.arg(here().join("tests/peers/bond.py"));
        command.args([&self.0.to_string(), role, name]).env(
            "CYCLONEDDS_URI",
            "<General><Interfaces><NetworkInterface address=\"127.0.0.1\" multicast=\"true\"/>\
             </Interfaces></General><Discovery><ParticipantIndex>auto</ParticipantIndex></Discovery>",
        );
        Running::start(&mut command)
    }

    /// Periplus' lifecycle manager of one node, with additional parameters and an optional world.
    fn manager_with(self, name: &str, more: &[&str], world: Option<&Path>) -> (Running, Folder) {
        let folder = Folder::new(&format!("manager-{}", self.0));
        let parameters = folder.path("manager.yaml");
        let mut yaml = format!(
            "/lifecycle_manager:\n  ros__parameters:\n    autostart: true\n    node_names: \
             [\"{name}\"]\n    bond_timeout: 2.0\n"
        );
        for line in more {
            yaml.push_str(&format!("    {line}\n"));
        }
        std::fs::write(&parameters, yaml).unwrap();
        let launch = folder.path("manager.launch.xml");
        let simulated = world.map_or_else(String::new, |world| {
            format!("<executable cmd=\"gz sim -r -s {}\"/>", world.display())
        });
        let xml = format!(
            "<launch>{simulated}<node pkg=\"nav2_lifecycle_manager\" exec=\"lifecycle_manager\" \
             name=\"lifecycle_manager\"><param from=\"{}\"/></node></launch>",
            parameters.display()
        );
        std::fs::write(&launch, xml).unwrap();
        let words = ["launch", &launch.to_string_lossy()];
        (Running::start(&mut self.periplus(None, &words)), folder)
    }

    fn manager(self, name: &str) -> (Running, Folder) {
        self.manager_with(name, &[], None)
    }
}

fn world() -> PathBuf {
    here().join("../../../worlds/demo_room.sdf")
}

/// Longer than the timeout of any heartbeat.
const PAUSE: Duration = Duration::from_secs(6);

/// Regression test: heartbeats ran on simulated time, so that a pause broke the bond with every external
/// lifecycle manager, which then shut the whole system down.
#[test]
fn bonds_hold_while_the_simulation_is_paused() {
    let Some(python) = cyclone() else { return };
    // A managed node of a simulation, and a manager outside.
    let domain = Domain(131);
    let (world, slam) = (world(), here().join("../../../robots/kbot/urdf/kbot.urdf.xacro"));
    let (world, slam) = (world.to_string_lossy(), slam.to_string_lossy());
    let words = ["sim", &*world, "--robot", &*slam, "--slam", "--rtf", "1"];
    let _simulation = Running::start(&mut domain.periplus(None, &words));
    let manager = domain.bond(&python, "manager", "slam_toolbox");
    // Our manager in a simulation, and a managed node outside.
    let other = Domain(124);
    let node = other.bond(&python, "node", "alpha");
    node.says("ready");
    let (own_manager, _folder) = other.manager_with("alpha", &[], Some(Path::new(&*world)));
    manager.says("formed");
    node.says("formed");
    own_manager.tells("managed nodes are active");
    for domain in [domain, other] {
        domain.gives(&["service", "call", "/pause_physics", "std_srvs/srv/Empty"]);
    }
    std::thread::sleep(PAUSE);
    for end in [&manager, &node] {
        while let Ok(line) = end.lines.try_recv() {
            assert!(!line.starts_with("broken") && !line.starts_with("ended"), "{line}");
        }
    }
    while let Ok(line) = own_manager.lines.try_recv() {
        assert!(!line.contains("is down"), "{line}");
    }
    // While paused, too, an end that stops is noticed.
    drop(node);
    own_manager.tells("`alpha` is down");
}

/// Nav2's `attempt_respawn_reconnection` (default true): the system restarts when a node has been restarted.
#[test]
fn a_lifecycle_manager_starts_again_when_its_nodes_come_back() {
    let Some(python) = cyclone() else { return };
    let start = |domain: Domain, more: &[&str]| {
        let node = domain.bond(&python, "node", "alpha");
        node.says("ready");
        let (manager, folder) = domain.manager_with("alpha", more, None);
        manager.tells("managed nodes are active");
        drop(node);
        manager.tells("`alpha` is down");
        (manager, folder)
    };
    let domain = Domain(125);
    let (manager, _folder) = start(domain, &[]);
    let node = domain.bond(&python, "node", "alpha");
    manager.tells("all nodes respond again after a bond broke");
    node.says("formed");
    manager.tells("managed nodes are active");

    let (manager, _folder) = start(Domain(126), &["bond_respawn_max_duration: 1.0"]);
    manager.tells("not all nodes came back after a bond broke");

    let domain = Domain(127);
    let (manager, _folder) = start(domain, &["attempt_respawn_reconnection: false"]);
    let node = domain.bond(&python, "node", "alpha");
    node.says("ready");
    std::thread::sleep(Duration::from_secs(3));
    assert!(!node.lines.try_iter().any(|line| line.starts_with("asked")));
    assert!(!manager.lines.try_iter().any(|line| line.contains("restarting the system")));
}

/// Tools request the definitions of a node's types, which every node of ROS 2 has provided since Jazzy.
#[test]
fn nodes_describe_their_types_as_nodes_of_ros_do() {
    let Some(python) = ros() else { return };
    let domain = Domain(128);
    let (_server, _folder) = domain.map_server();
    let peer = domain.peer(&python, None, &["describe", "/map_server"]);
    for name in [
        "nav_msgs/msg/OccupancyGrid",
        "rcl_interfaces/msg/ParameterEvent",
        "rcl_interfaces/srv/SetParameters",
        "type_description_interfaces/srv/GetTypeDescription",
    ] {
        assert_eq!(peer.says(&format!("{name} ")), format!("{name} same"));
    }
    peer.says("other Type not currently in use by this node");
    peer.says("nonsense Failed to parse type hash");
}

/// `rosbag2` records the distribution, and the QoS announced by publishers.
#[test]
fn recordings_note_the_distribution_and_the_qos_of_publishers() {
    let Some(python) = ros() else { return };
    let domain = Domain(129);
    let robot = domain.peer(&python, None, &["robot"]);
    robot.says("ready");
    let (_server, folder) = domain.map_server();
    let output = folder.path("bag").to_string_lossy().into_owned();
    let mut record = domain.periplus(None, &["bag", "record", "-o", &output, "/chatter", "/map"]);
    let mut recording = Running::start(record.env("ROS_DISTRO", "jazzy"));
    // Until Ctrl-C; and both topics, in any order.
    (0..3).for_each(|_| recording.tells("recording"));
    std::thread::sleep(Duration::from_secs(2));
    let id = recording.child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert!(recording.child.wait().unwrap().success());
    let metadata = std::fs::read_to_string(folder.path("bag/metadata.yaml")).unwrap();
    assert!(metadata.contains("ros_distro: jazzy"), "{metadata}");
    let offered = |topic: &str| {
        let at = metadata.find(&format!("name: {topic}\n")).unwrap();
        let history = metadata[at..].find("history: ").unwrap() + at;
        metadata[history..].lines().take(2).map(str::trim).collect::<Vec<_>>().join(" ")
    };
    eprintln!("{} | {}", offered("/chatter"), offered("/map"));
    assert_eq!(offered("/chatter"), "history: unknown depth: 0");
    assert_eq!(offered("/map"), "history: keep_last depth: 1");
}

/// Regression test: byte arrays became lists of integers.
#[test]
fn byte_arrays_of_a_node_of_ros_survive_a_dump() {
    let Some(python) = ros() else { return };
    let domain = Domain(130);
    let robot = domain.peer(&python, None, &["bytes"]);
    robot.says("ready");
    let dump = domain.gives(&["param", "dump", "/bytes"]);
    let folder = Folder::new("ros2-bytes");
    let file = folder.path("dump.yaml").to_string_lossy().into_owned();
    std::fs::write(&file, &dump).unwrap();
    // PyYAML, by which `ros2 param` reads and writes, has the same values.
    let same = "import sys, yaml; d = yaml.safe_load(open(sys.argv[1])); \
                assert d['/bytes']['ros__parameters']['key'] == [b'\\x01', b'\\xff'], d";
    let read = Command::new(&python).args(["-c", same, &file]).output().unwrap();
    assert!(read.status.success(), "{dump}{}", String::from_utf8_lossy(&read.stderr));
    domain.gives(&["param", "set", "/bytes", "key", "!!binary AAA="]);
    assert!(domain.gives(&["param", "dump", "/bytes"]) != dump);
    // One of its parameters is read-only, which `load` reports.
    domain.ends(&["param", "load", "/bytes", &file]);
    assert_eq!(domain.gives(&["param", "dump", "/bytes"]), dump);
}

/// A lifecycle manager of Nav2 shuts a node down that has no bond with it.
#[test]
fn a_managed_node_keeps_a_bond_while_it_is_active() {
    let Some(python) = cyclone() else { return };
    let domain = Domain(119);
    let (_server, _folder) = domain.map_server();
    let manager = domain.bond(&python, "manager", "map_server");
    assert_eq!(manager.says("formed"), "formed 0.1 4.0");
    assert_eq!(
        domain.gives(&["param", "get", "/map_server", "bond_heartbeat_period"]),
        "Double value is: 0.1\n"
    );
    domain.gives(&["lifecycle", "set", "/map_server", "deactivate"]);
    manager.says("ended");
}

#[test]
fn a_lifecycle_manager_keeps_bonds_with_its_nodes() {
    let Some(python) = cyclone() else { return };
    let domain = Domain(120);
    let node = domain.bond(&python, "node", "alpha");
    node.says("ready");
    let (manager, _folder) = domain.manager("alpha");
    node.says("formed");
    manager.tells("managed nodes are active");
    drop(node);
    manager.tells("`alpha` is down");

    let domain = Domain(121);
    let _node = domain.bond(&python, "silent", "beta");
    let (manager, _folder) = domain.manager("beta");
    manager.tells("`beta` was unable to be reached after 2.00 s by bond");
}

/// Regression test: parameters after `--ros-args` did not reach a manager started by `periplus run`, which had
/// no nodes.
#[test]
fn a_manager_that_runs_alone_knows_its_nodes() {
    let folder = Folder::new("manager-alone");
    std::fs::write(
        folder.path("manager.yaml"),
        "/lifecycle_manager:\n  ros__parameters:\n    node_names: [alpha, beta]\n",
    )
    .unwrap();
    let file = folder.path("manager.yaml").to_string_lossy().into_owned();
    let run = ["run", "nav2_lifecycle_manager", "lifecycle_manager", "--ros-args"];
    for given in [["-p", "node_names:=[alpha, beta]"], ["--params-file", &file]] {
        let words = [&run[..], &given].concat();
        let manager = Running::start(&mut Domain(122).periplus(None, &words));
        manager.tells("manages alpha, beta");
    }
}

/// Parameters of navigation whose controller is cheap: these tests may run without optimization.
const CHEAP_NAVIGATION: &str = "\
controller_server:
  ros__parameters:
    controller_frequency: 10.0
    odom_topic: /demo/odom
    costmap_update_timeout: 5.0
    progress_checker_plugins: [progress_checker]
    goal_checker_plugins: [goal_checker]
    controller_plugins: [FollowPath]
    progress_checker: {plugin: \"nav2_controller::SimpleProgressChecker\", movement_time_allowance: 30.0}
    goal_checker: {plugin: \"nav2_controller::SimpleGoalChecker\", yaw_goal_tolerance: 3.2}
    FollowPath:
      plugin: nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController
      desired_linear_vel: 0.3
planner_server:
  ros__parameters:
    planner_plugins: [GridBased]
    GridBased: {plugin: \"nav2_navfn_planner::NavfnPlanner\", allow_unknown: true}
bt_navigator:
  ros__parameters: {default_server_timeout: 2000, default_cancel_timeout: 2000, odom_topic: /demo/odom}
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      rolling_window: true
      width: 4
      height: 4
      plugins: [obstacle_layer, inflation_layer]
      obstacle_layer:
        plugin: nav2_costmap_2d::ObstacleLayer
        observation_sources: scan
        scan: {topic: /scan, data_type: LaserScan, marking: true, clearing: true}
      inflation_layer: {plugin: \"nav2_costmap_2d::InflationLayer\", inflation_radius: 0.5}
global_costmap:
  global_costmap:
    ros__parameters:
      global_frame: map
      rolling_window: true
      width: 20
      height: 20
      plugins: [static_layer, inflation_layer]
      static_layer: {plugin: \"nav2_costmap_2d::StaticLayer\", map_subscribe_transient_local: true}
      inflation_layer: {plugin: \"nav2_costmap_2d::InflationLayer\", inflation_radius: 0.5}
";

/// Goals of a client of ROS: sent, followed, preempted, canceled, reached.
#[test]
fn a_client_of_ros_drives_the_robot_to_goals() {
    let Some(python) = ros() else { return };
    let domain = Domain(119);
    let folder = Folder::new("navigation-client");
    let parameters = folder.path("navigation.yaml");
    std::fs::write(&parameters, CHEAP_NAVIGATION).unwrap();
    let root = here().join("../../..");
    let world = root.join("worlds/closed_room.world");
    let robot = root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let navigation = format!("--navigation={}", parameters.display());
    let (world, robot) = (world.to_string_lossy(), robot.to_string_lossy());
    let words = ["sim", &*world, "--robot", &*robot, &*navigation, "--rtf", "1"];
    let _simulation = Running::start(&mut domain.periplus(None, &words));
    let mut client = Command::new(python);
    client.arg(here().join("tests/peers/navigation.py")).arg("/demo/odom");
    let client = Running::start(&mut domain.set(client, None));
    for step in [
        "ready",
        "executing",
        "planned",
        "moving",
        "preempted",
        "canceled",
        "stopped",
        "reached",
        "done",
    ] {
        client.step(step);
    }
}

impl Running {
    /// Waits for a line; a line `FAILED ...` ends the test.
    #[track_caller]
    fn step(&self, wanted: &str) {
        let end = Instant::now() + 2 * LONG;
        loop {
            let rest = end.saturating_duration_since(Instant::now());
            let line = self.lines.recv_timeout(rest).unwrap_or_else(|_| panic!("no `{wanted}`"));
            assert!(!line.starts_with("FAILED"), "{line}");
            if line == wanted {
                return;
            }
        }
    }
}
