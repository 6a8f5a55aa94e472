//! Runs in ROS 1: with Debian's own programs of ROS Noetic (`roscore`, `rostopic`, `rosservice`, `rosparam`,
//! `rosnode`, `rosbag`) if they are installed, and between two programs of this project.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Longest wait for something that usually takes a second.
const LONG: Duration = Duration::from_secs(40);

/// A program that runs until the test ends.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // As Ctrl-C does: `roscore` ends its own processes then.
        let id = self.0.id().to_string();
        let _ = Command::new("kill").args(["-INT", &id]).status();
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(5) {
            if matches!(self.0.try_wait(), Ok(Some(_))) {
                return;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Port and folder of a master, which no other test uses.
struct Place {
    port: u16,
    folder: PathBuf,
}

impl Place {
    fn new(name: &str) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("ros1_{name}"));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self { port, folder }
    }

    fn command(&self, program: impl AsRef<std::ffi::OsStr>, words: &[&str]) -> Command {
        let mut command = Command::new(program);
        command
            .args(words)
            .env("ROS_MASTER_URI", format!("http://127.0.0.1:{}", self.port))
            .env("ROS_IP", "127.0.0.1")
            .env("ROS_HOME", &self.folder)
            .env("ROS_LOG_DIR", self.folder.join("log"))
            .env("PYTHONUNBUFFERED", "1")
            // Debian's programs take Debian's Python.
            .env("PATH", format!("/usr/bin:/bin:{}", std::env::var("PATH").unwrap_or_default()))
            .env_remove("PYTHONPATH")
            .env_remove("VIRTUAL_ENV")
            .env_remove("ROS_HOSTNAME")
            .env("ROS_DOMAIN_ID", (1 + std::process::id() % 100).to_string())
            .current_dir(&self.folder)
            .stdin(Stdio::null());
        command
    }

    fn ours(&self, words: &[&str]) -> Command {
        self.command(env!("CARGO_BIN_EXE_periplus"), words)
    }

    fn start(&self, mut command: Command) -> Running {
        let log = std::fs::File::create(self.folder.join("started.log")).unwrap();
        Running(command.stdout(Stdio::null()).stderr(log).spawn().unwrap())
    }

    /// Output of a program that ends; it is killed after a long time.
    #[track_caller]
    fn run(mut command: Command) -> Output {
        let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let id = child.id().to_string();
        let watch = std::thread::spawn(move || child.wait_with_output().unwrap());
        let start = Instant::now();
        while !watch.is_finished() {
            if start.elapsed() > LONG {
                let _ = Command::new("kill").args(["-KILL", &id]).status();
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        watch.join().unwrap()
    }

    #[track_caller]
    fn text_of(command: Command) -> String {
        let output = Self::run(command);
        let both = [output.stdout, output.stderr].concat();
        String::from_utf8_lossy(&both).into_owned()
    }

    /// Output of one of Debian's programs.
    #[track_caller]
    fn theirs(&self, program: &str, words: &[&str]) -> String {
        Self::text_of(self.command(Path::new("/usr/bin").join(program), words))
    }

    /// Repeats a command until its output has a text.
    #[track_caller]
    fn until(&self, command: impl Fn() -> Command, wanted: &str) -> String {
        let start = Instant::now();
        loop {
            let text = Self::text_of(command());
            if text.contains(wanted) {
                return text;
            }
            assert!(start.elapsed() < LONG, "`{wanted}` is missing in:\n{text}");
            std::thread::sleep(Duration::from_millis(200));
        }
    }

    #[track_caller]
    fn theirs_until(&self, program: &str, words: &[&str], wanted: &str) -> String {
        self.until(|| self.command(Path::new("/usr/bin").join(program), words), wanted)
    }

    #[track_caller]
    fn ours_until(&self, words: &[&str], wanted: &str) -> String {
        self.until(|| self.ours(words), wanted)
    }
}

/// True if Debian's ROS 1 is installed.
fn has_ros1() -> bool {
    let all = ["roscore", "rostopic", "rosnode", "rosservice", "rosparam", "rosbag"];
    let has = all.iter().all(|program| Path::new("/usr/bin").join(program).exists());
    if !has {
        eprintln!("SKIPPED: Debian's ROS 1 is not installed (python3-rostopic and others)");
    }
    has
}

fn pong() -> String {
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../worlds/pong.sdf");
    world.to_str().unwrap().to_owned()
}

#[test]
fn programs_of_debian_use_a_run() {
    if !has_ros1() {
        return;
    }
    let place = Place::new("run");
    let _run = place.start(place.ours(&["sim", &pong(), "--ros1", "--ros2", "off"]));
    place.theirs_until("rosnode", &["list"], "/rosout");
    let topics = place.theirs_until(
        "rostopic",
        &["list", "-v"],
        "/lidar [sensor_msgs/LaserScan] 1 publisher",
    );
    assert!(topics.contains("* /clock [rosgraph_msgs/Clock] 1 publisher"), "{topics}");
    let scan = place.theirs("rostopic", &["echo", "-n", "1", "/lidar"]);
    assert!(scan.contains("angle_increment:"), "{scan}");
    assert_eq!(place.theirs("rosparam", &["get", "/use_sim_time"]).trim(), "true");
    place.theirs("rosparam", &["set", "/lamp", "{lit: true, level: 0.5}"]);
    assert_eq!(place.theirs("rosparam", &["get", "/lamp/level"]).trim(), "0.5");

    // A velocity drives the robot.
    let drive = place.command(
        "/usr/bin/rostopic",
        &["pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}"],
    );
    let drive = place.start(drive);
    let odometry = ["echo", "-n", "1", "/model/pong_bot/odometry/twist/twist/linear/x"];
    let start = Instant::now();
    loop {
        let text = place.theirs("rostopic", &odometry);
        let speed_mps = text.lines().find_map(|line| line.trim().parse::<f64>().ok());
        if speed_mps.is_some_and(|speed| (speed - 0.5).abs() < 0.05) {
            break;
        }
        assert!(start.elapsed() < LONG, "{text}");
    }
    drop(drive);

    // What ends with the run is not ended by itself.
    let killed = place.theirs("rosnode", &["ping", "-c", "1", "/rosout"]);
    assert!(killed.contains("xmlrpc reply"), "{killed}");
    let bag = place.folder.join("run.bag");
    let name = bag.to_str().unwrap();
    let recorded =
        place.theirs("rosbag", &["record", "--duration", "3", "-O", name, "/lidar", "/clock"]);
    let info = place.theirs("rosbag", &["info", name]);
    assert!(
        info.contains("/lidar") && info.contains("90c7ef2dc6895d81024acba2ac42f369"),
        "{recorded}{info}"
    );
}

#[test]
fn the_words_of_ros_1_use_a_master_of_debian() {
    if !has_ros1() {
        return;
    }
    let place = Place::new("master");
    let core = place.start(place.command("/usr/bin/roscore", &["-p", &place.port.to_string()]));
    place.theirs_until("rosparam", &["get", "/rosversion"], "1.");
    let talker = place.command(
        "/usr/bin/rostopic",
        &["pub", "-r", "20", "/chatter", "std_msgs/String", "data: hello"],
    );
    let talker = place.start(talker);
    place.ours_until(&["rostopic", "list"], "/chatter");
    place.ours_until(&["rostopic", "echo", "-n", "1", "/chatter"], "data: hello");
    place.ours_until(&["rostopic", "type", "/chatter"], "std_msgs");
    place.ours_until(&["rosnode", "list"], "/rosout");
    place.ours_until(&["rosservice", "list"], "/rosout/get_loggers");
    place.ours_until(&["rosparam", "list"], "/rosdistro");
    place.ours_until(&["rosparam", "set", "/wheel/radius", "0.07"], "running");
    assert_eq!(place.theirs("rosparam", &["get", "/wheel/radius"]).trim(), "0.07");
    place.ours_until(&["rosnode", "ping", "-c", "1", "/rosout"], "reply from");

    // What we publish arrives there.
    let words =
        ["rostopic", "pub", "-r", "10", "/greeting", "std_msgs/String", "data: good morning"];
    let told = place.start(place.ours(&words));
    place.theirs_until("rostopic", &["echo", "-n", "1", "/greeting"], "data: \"good morning\"");
    drop(told);
    drop(talker);
    drop(core);
    // Without a master the commands print which network they use.
    place.ours_until(&["rostopic", "list"], "no ROS 1 master answers: using ROS 2");
    place.ours_until(&["rosparam", "list"], "does not answer");
}

#[test]
fn ros_1_and_ros_2_are_bridged() {
    let place = Place::new("bridge");
    let port = place.port.to_string();
    let _core = place.start(place.ours(&["roscore", "-p", &port]));
    place.ours_until(&["ros1", "param", "get", "/rosdistro"], "noetic");
    // Our `topic echo` waits for a publisher before it subscribes.
    let _bridge = place.start(place.ours(&["bridge", "ros1", "--all"]));
    let words = ["topic", "pub", "-r", "10", "/chatter", "std_msgs/msg/String", "{data: over}"];
    let _two = place.start(place.ours(&words));
    place.ours_until(
        &["topic", "echo", "--ros1", "--once", "/chatter", "std_msgs/msg/String"],
        "data: over",
    );
}
