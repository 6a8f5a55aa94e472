//! Subscribers that are stopped with pending acknowledgements must cost the publisher neither time
//! nor CPU. A separate test program, since it measures its own CPU time.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use periplus_dds::{DdsTransport, Settings};
use periplus_graph::{Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2};

/// A depth camera of 640 x 480 points of 32 bytes.
const CLOUD_BYTES: usize = 640 * 480 * 32;
const ROUNDS: u32 = 15;
const PERIOD: Duration = Duration::from_millis(100);

/// A process that is killed when this is dropped.
struct Stopped(Child);

impl Drop for Stopped {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

/// CPU time so far \[s\].
fn cpu_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
    let (_, fields) = stat.rsplit_once(") ").unwrap();
    fields.split(' ').skip(11).take(2).map(|field| field.parse::<f64>().unwrap()).sum::<f64>()
        / 100.0
}

/// Publishes clouds and scans; returns the calls that took longer than half a period, and the CPU
/// time \[s\].
fn publish(clouds: &Publisher<PointCloud2>, scans: &Publisher<LaserScan>) -> (u32, f64) {
    let cpu = cpu_s();
    let mut slow = 0;
    let start = Instant::now();
    for round in 0..ROUNDS {
        let cloud = PointCloud2 { data: vec![7; CLOUD_BYTES], ..PointCloud2::default() };
        let scan = LaserScan { ranges: vec![1.0; 360], ..LaserScan::default() };
        let before = Instant::now();
        clouds.publish(cloud);
        scans.publish(scan);
        slow += u32::from(before.elapsed() > PERIOD / 2);
        std::thread::sleep((PERIOD * (round + 1)).saturating_sub(start.elapsed()));
    }
    (slow, cpu_s() - cpu)
}

#[test]
fn stopped_subscribers_cost_nothing() {
    let python =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../target/peers/ros2/bin/python");
    let peer = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peers/ros.py");
    let mut asked = Command::new(&python);
    asked.args(["-c", "import rclpy"]).stderr(Stdio::null());
    if !asked.status().is_ok_and(|status| status.success()) {
        eprintln!("SKIPPED: no ROS 2 to test against; see .ci/ros2.txt");
        return;
    }
    let wire = DdsTransport::open(&Settings { domain_id: 96, ..Settings::default() }).unwrap();
    let graph = Graph::live();
    wire.attach(&graph).unwrap();
    let node = graph.node(NodeSettings::new("periplus")).unwrap();
    let clouds: Publisher<PointCloud2> = node.publisher("/cloud", Qos::reliable(5)).unwrap();
    let scans: Publisher<LaserScan> = node.publisher("/scan", Qos::reliable(5)).unwrap();
    // The first subscriber works all the time, so that the work is the same with and without the
    // others.
    let topics = [
        ["cloud", "rt/cloud"],
        ["cloud", "rt/cloud"],
        ["scan", "rt/scan"],
        ["cloud", "rt/cloud"],
        ["scan", "rt/scan"],
    ];
    let mut started = topics.map(|[kind, topic]| {
        let mut command = Command::new(&python);
        command.arg(&peer).args(["96", "sub", kind, topic, "100000"]).stdin(Stdio::piped());
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let (send, lines) = channel();
        let output = BufReader::new(child.stdout.take().unwrap());
        std::thread::spawn(move || {
            output.lines().map_while(Result::ok).for_each(|line| drop(send.send(line)));
        });
        (Stopped(child), lines, false)
    });
    let end = Instant::now() + Duration::from_secs(60);
    while !started.iter().all(|(_, _, is_heard)| *is_heard) {
        assert!(Instant::now() < end, "a subscriber received nothing");
        clouds.publish(PointCloud2 { data: vec![7; 1000], ..PointCloud2::default() });
        scans.publish(LaserScan { ranges: vec![1.0], ..LaserScan::default() });
        std::thread::sleep(Duration::from_millis(20));
        for (_, lines, is_heard) in &mut started {
            *is_heard |= lines.try_recv().is_ok();
        }
    }
    let (slow, cpu) = publish(&clouds, &scans);
    eprintln!("control: {slow} slow calls of {ROUNDS}, {cpu:.2} s of processor");
    for (one, ..) in &started[1..] {
        signal(&one.0, "-STOP");
    }
    let (slow_beside, cpu_beside) = publish(&clouds, &scans);
    eprintln!("beside stopped: {slow_beside} slow calls, {cpu_beside:.2} s of processor");
    assert!(
        slow_beside <= slow + ROUNDS / 5,
        "{slow_beside} slow calls, {slow} without stopped ones"
    );
    assert!(cpu_beside < 1.3 * cpu + 0.3, "{cpu_beside:.2} s, alone {cpu:.2} s");
}
