//! Commands over DDS with programs of other projects: a ROS 2 node of PyPI's `cyclonedds`
//! (`peers/robot.py`) and Fast DDS (`crates/transports/dds/tests/peers/fast.cpp`). Missing peers are skipped
//! with a message.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::io::{BufRead as _, BufReader, Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

const LONG: Duration = Duration::from_secs(40);

/// Cyclone on this machine's own interface, as rmw_cyclonedds sets it up for `LOCALHOST`.
const LOOPBACK: &str = "<General><Interfaces><NetworkInterface address=\"127.0.0.1\" \
     multicast=\"true\"/></Interfaces><AllowMulticast>true</AllowMulticast></General>\
     <Discovery><ParticipantIndex>auto</ParticipantIndex></Discovery>";

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

/// A Python with PyPI's `cyclonedds`.
fn python() -> Option<PathBuf> {
    let given = std::env::var_os("PERIPLUS_PYTHON").map(PathBuf::from);
    let own = here().join("../../../.venv/bin/python");
    let has = |python: &PathBuf| {
        let mut asked = Command::new(python);
        asked.args(["-c", "import cyclonedds"]).stderr(Stdio::null());
        asked.status().is_ok_and(|status| status.success())
    };
    let found = given.into_iter().chain(["python3".into(), own]).find(has);
    if found.is_none() {
        eprintln!("SKIPPED: no Cyclone DDS to test against; pip install cyclonedds==11.0.1");
    }
    found
}

/// Fast DDS, built as for the tests of the transport.
fn fast() -> Option<PathBuf> {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fast-peer-of-verbs");
    let source = here().join("../../transports/dds/tests/peers/fast.cpp");
    let age = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    if age(&program) < age(&source) {
        let mut compiler = Command::new("g++");
        compiler.args(["-std=c++14", "-O1", "-o"]).arg(&program).arg(&source);
        compiler.args(["-lfastrtps", "-lfastcdr"]).stderr(Stdio::null());
        if !compiler.status().is_ok_and(|status| status.success()) {
            eprintln!("SKIPPED: no Fast DDS; apt-get install g++ libfastrtps-dev libfastcdr-dev");
            return None;
        }
    }
    Some(program)
}

/// A program that runs until dropped, and its output lines.
struct Running {
    child: Child,
    lines: Receiver<String>,
}

impl Running {
    fn start(command: &mut Command) -> Self {
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let output = child.stdout.take().unwrap();
        Self::reading(child, output)
    }

    /// A program whose standard error is read.
    fn start_and_hear_errors(command: &mut Command) -> Self {
        let mut child = command.stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let output = child.stderr.take().unwrap();
        Self::reading(child, output)
    }

    fn reading(child: Child, output: impl Read + Send + 'static) -> Self {
        let (send, lines) = channel();
        let output = BufReader::new(output);
        std::thread::spawn(move || {
            output.lines().map_while(Result::ok).try_for_each(|line| send.send(line))
        });
        Self { child, lines }
    }

    /// Writes a line to its input.
    fn hears(&mut self, line: &str) {
        let input = self.child.stdin.as_mut().unwrap();
        writeln!(input, "{line}").and_then(|()| input.flush()).unwrap();
    }

    /// The next line that contains this text.
    #[track_caller]
    fn says(&self, wanted: &str) -> String {
        let start = Instant::now();
        while start.elapsed() < LONG {
            match self.lines.recv_timeout(Duration::from_millis(100)) {
                Ok(line) if line.contains(wanted) => return line,
                _ => {}
            }
        }
        panic!("nothing was said of `{wanted}`");
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A domain without other participants, for the tests of one run.
#[derive(Clone, Copy)]
struct Domain(u32);

impl Domain {
    fn robot(self, python: &Path, node: &str) -> Running {
        let mut robot = Command::new(python);
        robot.env("PYTHONDONTWRITEBYTECODE", "1");
        robot.arg(here().join("tests/peers/robot.py")).arg(self.0.to_string()).arg(node);
        let robot = Running::start(robot.env("CYCLONEDDS_URI", LOOPBACK));
        robot.says("ready");
        robot
    }

    fn periplus(self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
        command.args(words).env("ROS_DOMAIN_ID", self.0.to_string());
        for name in ["ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS", "CYCLONEDDS_URI"] {
            command.env_remove(name);
        }
        command
    }

    fn run(self, line: &str) -> Output {
        // YAML is one word.
        let (words, yaml) = line
            .split_once(" {")
            .map_or((line, None), |(words, yaml)| (words, Some(format!("{{{yaml}"))));
        let words: Vec<&str> = words.split(' ').chain(yaml.as_deref()).collect();
        self.periplus(&words).output().unwrap()
    }

    /// Standard output of a command.
    #[track_caller]
    fn gives(self, line: &str) -> String {
        let output = self.run(line);
        assert!(output.status.success(), "{line}: {output:?}");
        String::from_utf8(output.stdout).unwrap()
    }

    #[track_caller]
    fn check(self, line: &str, expected: &str) {
        assert_eq!(self.gives(line), expected, "{line}");
    }

    /// Standard error of a command.
    #[track_caller]
    fn fails(self, line: &str) -> String {
        let output = self.run(line);
        assert_eq!(output.status.code(), Some(1), "{line}: {output:?}");
        String::from_utf8(output.stderr).unwrap()
    }
}

#[test]
fn topics_and_nodes_of_a_ros_2_node_are_seen_and_heard() {
    let Some(python) = python() else { return };
    let domain = Domain(101);
    let robot = domain.robot(&python, "robot");
    domain.check("node list", "/robot\n");
    let info = domain.gives("node info /robot");
    for part in [
        "  Subscribers:\n    /cmd_vel: geometry_msgs/msg/Twist\n    /commands: std_msgs/msg/String\n",
        "  Publishers:\n    /chatter: std_msgs/msg/String\n    /slow: std_msgs/msg/String\n",
        "    /robot/get_parameters: rcl_interfaces/srv/GetParameters\n",
        "    /trigger: std_srvs/srv/Trigger\n",
        "  Action Servers:\n    /fibonacci: example_interfaces/action/Fibonacci\n",
    ] {
        assert!(info.contains(part), "{info}");
    }
    domain.check(
        "topic list -t",
        "/chatter [std_msgs/msg/String]\n/cmd_vel [geometry_msgs/msg/Twist]\n\
         /commands [std_msgs/msg/String]\n/slow [std_msgs/msg/String]\n",
    );
    let info = domain.gives("topic info -v /chatter");
    for part in [
        "Publisher count: 1\n",
        "Node name: robot\nNode namespace: /\nTopic type: std_msgs/msg/String\n",
        "Reliability: RELIABLE\n  History (Depth): KEEP_LAST (100)\n  Durability: VOLATILE\n",
    ] {
        assert!(info.contains(part), "{info}");
    }
    let heard = domain.gives("topic echo /chatter --once --timeout 30");
    assert!(heard.starts_with("data: hello ") && heard.ends_with("\n---\n"), "{heard}");
    let heard = domain.gives("topic echo /chatter --once --json --timeout 30");
    assert!(heard.starts_with("{\"data\":\"hello "), "{heard}");
    domain.gives("topic pub --once /commands std_msgs/msg/String {data: go}");
    assert_eq!(robot.says("heard"), "heard go");

    // One topic, and another without a publisher: the verb does not wait for it.
    let hz = ["topic", "hz", "/chatter", "/late", "--json"];
    let hz = Running::start(&mut domain.periplus(&hz));
    let rate_of = |line: &str| -> f64 {
        serde_json::from_str::<serde_json::Value>(line).unwrap()["rate_hz"].as_f64().unwrap()
    };
    let chatter = rate_of(&hz.says("/chatter"));
    assert!((10.0..30.0).contains(&chatter), "20 a second, and it says {chatter}");
    let late = ["topic", "pub", "/late", "std_msgs/String", "data: x", "-r", "50", "-p", "0"];
    let _late = Running::start(&mut domain.periplus(&late));
    let late = rate_of(&hz.says("/late"));
    assert!((25.0..75.0).contains(&late), "50 a second, and it says {late}");
}

#[test]
fn services_parameters_and_the_life_of_a_ros_2_node_are_at_hand() {
    let Some(python) = python() else { return };
    let domain = Domain(102);
    let _robot = domain.robot(&python, "robot");
    let services = domain.gives("service list");
    assert!(services.contains("/robot/set_parameters\n/trigger\n"), "{services}");
    domain.check("service type /trigger", "std_srvs/srv/Trigger\n");
    let answer = domain.gives("service call /trigger std_srvs/srv/Trigger");
    let wanted = "std_srvs.srv.Trigger_Response(success=True, message='from robot')\n";
    assert!(answer.contains(wanted), "{answer}");

    domain.check("param list /robot", "  frame\n  speed\n  use_sim_time\n  wheels\n");
    domain.check("param get /robot speed", "Double value is: 0.5\n");
    domain.check("param set /robot speed 1.5", "Set parameter successful\n");
    domain.check("param get /robot speed --hide-type", "1.5\n");
    domain.check("param get /robot frame", "String value is: base_link\n");
    let refused = domain.fails("param set /robot wheels 3");
    assert!(refused.contains("wheels are where they are"), "{refused}");
    let described = domain.gives("param describe /robot speed");
    assert!(described.contains("Type: double\n  Description: of speed\n"), "{described}");

    domain.check("lifecycle nodes", "/robot\n");
    domain.check("lifecycle get /robot", "unconfigured [1]\n");
    let refused = domain.fails("lifecycle set /robot activate");
    assert!(refused.contains("- configure [1]"), "{refused}");
    domain.check("lifecycle set /robot configure", "Transitioning successful\n");
    domain.check("lifecycle set /robot activate", "Transitioning successful\n");
    domain.check("lifecycle get /robot", "active [3]\n");
}

#[test]
fn a_ros_2_node_works_on_goals() {
    let Some(python) = python() else { return };
    let domain = Domain(103);
    let _robot = domain.robot(&python, "robot");
    domain.check("action list -t", "/fibonacci [example_interfaces/action/Fibonacci]\n");
    domain.check(
        "action info /fibonacci",
        "Action: /fibonacci\nAction clients: 0\nAction servers: 1\n    /robot\n",
    );
    let send = "action send_goal /fibonacci example_interfaces/action/Fibonacci";
    let done = domain.gives(&format!("{send} --feedback {{order: 5}}"));
    for part in [
        "Goal accepted with ID: ",
        "Feedback:\n    sequence:\n- 0\n- 1\n- 1\n",
        "Result:\n    sequence:\n- 0\n- 1\n- 1\n- 2\n- 3\n- 5\n",
        "Goal finished with status: SUCCEEDED\n",
    ] {
        assert!(done.contains(part), "{done}");
    }
    let said = domain.fails(&format!("{send} {{order: 50}}"));
    assert!(said.contains("Goal was rejected."), "{said}");
}

#[test]
fn keys_drive_a_ros_2_node() {
    let Some(python) = python() else { return };
    let terminal = Command::new("script").arg("--version").output();
    if !terminal.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED: no `script`, which makes terminals; apt-get install util-linux");
        return;
    }
    let domain = Domain(104);
    let robot = domain.robot(&python, "robot");
    let mut teleop = Command::new("script");
    teleop.args(["-qec", &format!("{} teleop", env!("CARGO_BIN_EXE_periplus")), "/dev/null"]);
    teleop.env("ROS_DOMAIN_ID", domain.0.to_string());
    let mut teleop = Running::start(&mut teleop);
    teleop.says("Keys drive the robot");
    let mut keys = teleop.child.stdin.take().unwrap();
    let mut press = |key: &[u8]| keys.write_all(key).and_then(|()| keys.flush()).unwrap();
    // Before discovery no subscriber receives the keys.
    let start = Instant::now();
    let first = loop {
        press(b"i");
        if let Ok(line) = robot.lines.recv_timeout(Duration::from_millis(300)) {
            break line;
        }
        assert!(start.elapsed() < LONG, "the key is not heard");
    };
    assert_eq!(first, "driven 0.50 0.00");
    press(b"j");
    robot.says("driven 0.00 1.00");
    press(b"q,");
    robot.says("driven -0.55 0.00");
    // Ctrl-C: the last word is that it stands still.
    press(&[3]);
    robot.says("driven 0.00 0.00");
    assert!(teleop.child.wait().unwrap().success());
}

/// A robot on a known map, simulated by another program (`peers/localize.py`).
fn lost_robot(domain: Domain, python: &Path) -> Running {
    let mut robot = Command::new(python);
    robot.env("PYTHONDONTWRITEBYTECODE", "1");
    robot.arg(here().join("tests/peers/localize.py")).arg(domain.0.to_string());
    let robot = Running::start(robot.env("CYCLONEDDS_URI", LOOPBACK));
    robot.says("ready");
    robot
}

#[test]
fn a_ros_2_robot_finds_itself_and_is_told_where() {
    let Some(python) = python() else { return };
    let domain = Domain(106);
    let mut robot = lost_robot(domain, &python);
    robot.hears("map map");
    let amcl = Running::start_and_hear_errors(&mut domain.periplus(&["localize", "--live"]));
    amcl.says("global localization found the pose (");
    robot.says("pose near");
    robot.says("tf near");
    let cloud = robot.says("cloud");
    assert!(cloud.ends_with(" map"), "{cloud}");
    robot.hears("anywhere");
    robot.says("answered");
    amcl.says("particles are distributed over the whole map");
    // A person knows better.
    robot.hears("true");
    amcl.says("initial pose set to");
    robot.says("pose near");
}

#[test]
fn what_a_ros_2_robot_says_wrong_is_told_and_survived() {
    let Some(python) = python() else { return };
    let domain = Domain(107);
    let mut robot = lost_robot(domain, &python);
    let words = ["localize", "--live", "-p", "global_start:=false"];
    let amcl = Running::start_and_hear_errors(&mut domain.periplus(&words));
    amcl.says("no map received yet on `/map`");
    robot.hears("map world");
    amcl.says("the map is in frame `world`, `global_frame_id` is `map`");
    robot.hears("map map");
    amcl.says("received a map of 120 by 80 cells");
    robot.hears("pose 77 0 0");
    amcl.says("the initial pose (77.000, 0.000) is outside of the map");
    robot.hears("doubt 1 1 0");
    amcl.says("entry 7 of the covariance");
    // No wrong pose was published, and a right one can still follow.
    assert!(
        robot.lines.try_iter().all(|line| !line.starts_with("pose") && !line.starts_with("tf"))
    );
    robot.hears("true");
    robot.says("pose near");
    robot.hears("empty");
    amcl.says("the scan has no ranges");
    robot.hears("scan nowhere");
    amcl.says("the frame `nowhere` is not published on /tf");
    robot.hears("scan laser");
    robot.hears("true");
    amcl.says("initial pose set to");
    robot.says("pose near");
}

#[test]
fn fast_dds_is_heard_and_called() {
    let Some(fast) = fast() else { return };
    let domain = Domain(105);
    let start =
        |words: &[&str]| Running::start(Command::new(&fast).arg(domain.0.to_string()).args(words));
    let _talker = start(&["pub", "scan", "rt/scan", "100000", "20"]);
    let heard = domain.gives("topic echo /scan --once --field header.frame_id --timeout 30");
    assert_eq!(heard, "base_scan\n---\n");
    let listener = start(&["sub", "tf", "rt/tf", "1"]);
    domain.gives(
        "topic pub --once /tf tf2_msgs/msg/TFMessage {transforms: [{header: {stamp: {sec: 3, \
         nanosec: 5}, frame_id: base_tf}, child_frame_id: child, transform: {translation: {x: 1.5}}}]}",
    );
    assert_eq!(listener.says("tf"), "tf 3 base_tf 0x0 0 1500");
    let _server = start(&["serve", "/theirs", "100000"]);
    let answer = domain.gives("service call /theirs std_srvs/srv/Trigger");
    assert!(answer.contains("success=True, message='from fast'"), "{answer}");
    let info = domain.gives("topic info -v /scan");
    assert!(info.contains("Reliability: RELIABLE"), "{info}");
}
