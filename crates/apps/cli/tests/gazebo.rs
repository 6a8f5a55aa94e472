//! A running world and the bridge, with programs of Gazebo: Debian's `ignition-transport` 11 if it is
//! installed, and this project's transport.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

#[path = "../../../transports/gz-transport/tests/common/mod.rs"]
mod gazebo;

use std::net::Ipv4Addr;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::channel;
use std::time::Duration;

use periplus_gz_msgs::{LaserScan, Message, Twist};
use periplus_gz_transport::{Settings, Transport};

use gazebo::{Gazebo, LONG, until};

/// A program that runs until the test ends.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn periplus(partition: &str, words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).env("ROS_DOMAIN_ID", (101 + std::process::id() % 100).to_string());
    for name in ["ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS", "CYCLONEDDS_URI"] {
        command.env_remove(name);
    }
    command.env("GZ_PARTITION", partition).env("GZ_IP", "127.0.0.1").stdin(Stdio::null());
    command
}

fn start(partition: &str, words: &[&str]) -> Running {
    let mut command = periplus(partition, words);
    Running(command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
}

fn pong() -> String {
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../worlds/pong.sdf");
    world.to_str().unwrap().to_owned()
}

/// Number after a name in a text message, searched after another name.
fn number(text: &str, after: &str, name: &str) -> f64 {
    let rest = text.split_once(after).map_or("", |(_, rest)| rest);
    let line = rest.lines().find_map(|line| line.trim().strip_prefix(name));
    line.and_then(|line| line.trim_start_matches(':').trim().parse().ok()).unwrap_or(0.0)
}

#[test]
fn gazebos_own_tools_see_drive_and_change_a_world() {
    let Some(gazebo) = Gazebo::new("world") else { return };
    let words = ["sim", &pong(), "--gz", "--gz-types", "ignition", "--ros2", "off", "-q"];
    let _world = start(gazebo.partition(), &words);
    // A list may be printed before all publishers are discovered.
    let wanted = ["/lidar", "/stats", "/world/pong/stats", "/world/pong/pose/info", "/clock"];
    let has = |list: &str, topic: &str| list.lines().any(|line| line == topic);
    let mut list = gazebo.tool("topic", &["-l"]);
    for _ in 0..11 {
        if !wanted.iter().all(|topic| has(&list, topic)) {
            list = gazebo.tool("topic", &["-l"]);
        }
    }
    for topic in wanted {
        assert!(has(&list, topic), "{topic} in {list}");
    }
    gazebo.tool_until("topic", &["-i", "-t", "/lidar"], "ignition.msgs.LaserScan");
    let echo = |topic: &str| gazebo.tool_until("topic", &["-e", "-t", topic, "-n", "1"], ":");
    let scan = LaserScan::from_text(&echo("/lidar")).unwrap();
    assert_eq!(scan.ranges.len(), usize::try_from(scan.count).unwrap());

    // A velocity drives the robot.
    let odometry = "/model/pong-bot/odometry";
    let driving = gazebo.peer(&["say-twist", "/cmd_vel", "0.5"]);
    until("the robot drives", || number(&echo(odometry), "position", "x") > 0.05);
    drop(driving);

    let call = |service: &str, request: &str, kinds: [&str; 2]| {
        let [asked, answered] = kinds.map(|kind| format!("ignition.msgs.{kind}"));
        let name = format!("/world/pong/{service}");
        let words = [
            "-s",
            &name,
            "--reqtype",
            &asked,
            "--reptype",
            &answered,
            "--timeout",
            "10000",
            "--req",
            request,
        ];
        gazebo.tool("service", &words)
    };
    gazebo.tool_until("service", &["-l"], "/world/pong/control");
    let control = ["WorldControl", "Boolean"];
    assert!(call("control", "pause: true", control).contains("data: true"));
    gazebo.tool_until("topic", &["-e", "-t", "/stats", "-n", "1"], "paused: true");

    let sdf = "<sdf version='1.9'><model name='crate'><static>true</static><link name='l'><visual \
               name='v'><geometry><box><size>1 1 1</size></box></geometry></visual></link></model></sdf>";
    let create = format!("sdf: \"{sdf}\" pose: {{position: {{x: 2, y: 3, z: 0.5}}}}");
    assert!(call("create", &create, ["EntityFactory", "Boolean"]).contains("data: true"));
    let moved = "name: \"crate\" position: {x: -2, y: 1, z: 0.5}";
    assert!(call("set_pose", moved, ["Pose", "Boolean"]).contains("data: true"));
    let scene = call("scene/info", "", ["Empty", "Scene"]);
    assert_eq!(number(&scene, "name: \"crate\"", "x"), -2.0, "{scene}");
    let saved = call("generate_world_sdf", "", ["SdfGeneratorConfig", "StringMsg"]);
    assert!(saved.contains("pong-bot"), "{saved}");
    let gone = ["Entity", "Boolean"];
    assert!(call("remove", "name: \"crate\" type: MODEL", gone).contains("data: true"));
    // It answers that it was not done; false is not written.
    assert!(!call("remove", "name: \"crate\" type: MODEL", gone).contains("data: true"));
    assert!(call("control", "pause: false", control).contains("data: true"));
}

#[test]
fn the_bridge_of_the_tutorial_brings_scans_to_ros_and_velocities_to_gazebo() {
    let alone = periplus("none", &["topic", "list", "--spin-time", "0"]).output().unwrap();
    if !alone.status.success() {
        eprintln!("SKIPPED: there is no network: {}", String::from_utf8_lossy(&alone.stderr));
        return;
    }
    let partition = format!("bridge-{}", std::process::id());
    let (world, partition) = (pong(), partition.as_str());
    let _world = start(partition, &["sim", &world, "--gz", "--ros2", "off", "-q"]);
    let _bridge = start(
        partition,
        &[
            "bridge",
            "/lidar@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan",
            "/velocity@geometry_msgs/msg/Twist]gz.msgs.Twist",
            "--ros-args",
            "-r",
            "/lidar:=/laser_scan",
        ],
    );
    let words =
        ["topic", "echo", "/laser_scan", "sensor_msgs/LaserScan", "--once", "--timeout", "40"];
    let heard = periplus(partition, &words).output().unwrap();
    let said = String::from_utf8_lossy(&heard.stdout);
    assert!(said.contains("ranges:") && said.contains("frame_id:"), "{heard:?}");

    let transport = Transport::open(&Settings {
        partition: partition.to_owned(),
        address: Some(Ipv4Addr::LOCALHOST),
        ..Settings::default()
    })
    .unwrap();
    let (send, came) = channel();
    let _ear = transport
        .subscribe("/velocity", "gz.msgs.Twist", move |arrival| {
            let twist = Twist::decode(arrival.bytes).unwrap();
            let _ = send.send(twist.linear.map(|linear| linear.x));
        })
        .unwrap();
    let twist = "linear: {x: 0.25}";
    let words =
        ["topic", "pub", "/velocity", "geometry_msgs/Twist", twist, "-r", "20", "-n", "driver"];
    let _driver = start(partition, &words);
    assert_eq!(came.recv_timeout(LONG + Duration::from_secs(20)), Ok(Some(0.25)));
}

#[test]
fn words_that_are_no_topic_are_answered_as_there() {
    let output = periplus("none", &["bridge", "/lidar"]).output().unwrap();
    assert_eq!(output.status.code(), Some(255));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("missing `@` after the name"), "{said}");
}
