//! Interoperability with other implementations: PyPI's `cyclonedds` with its own CDR, Debian's Fast
//! DDS with Fast CDR, and real ROS 2 from PyPI. Missing peers are skipped with a message.
//!
//! Each test has its own domains, so that all can run in parallel.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use periplus_dds::{DdsTransport, Settings};
use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Quaternion, TransformStamped};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::sensor_msgs::{Image, LaserScan, PointCloud2, PointField};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::std_srvs::{Trigger, TriggerRequest, TriggerResponse};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Message, builtin_interfaces::Time};

const LONG: Duration = Duration::from_secs(40);

/// Another DDS implementation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Peer {
    Cyclone,
    Fast,
    /// rclpy on rmw_fastrtps_cpp.
    Ros,
}

/// Installed peers, with a number for their domains.
fn peers() -> Vec<(u32, Peer)> {
    let all = [(0, Peer::Cyclone), (1, Peer::Fast), (2, Peer::Ros)];
    all.into_iter().filter(|(_, peer)| peer.program().is_some()).collect()
}

impl Peer {
    /// Command that starts the peer.
    fn program(self) -> Option<&'static Vec<PathBuf>> {
        static CYCLONE: OnceLock<Option<Vec<PathBuf>>> = OnceLock::new();
        static FAST: OnceLock<Option<Vec<PathBuf>>> = OnceLock::new();
        static ROS: OnceLock<Option<Vec<PathBuf>>> = OnceLock::new();
        let found = match self {
            Self::Cyclone => CYCLONE.get_or_init(python),
            Self::Fast => FAST.get_or_init(compiled),
            Self::Ros => ROS.get_or_init(ros),
        };
        if found.is_none() {
            let how = match self {
                Self::Cyclone => "pip install cyclonedds==11.0.1",
                Self::Fast => "apt-get install g++ libfastrtps-dev libfastcdr-dev",
                Self::Ros => {
                    "python3.12 -m venv target/peers/ros2 && \
                     target/peers/ros2/bin/pip install -r .ci/ros2.txt"
                }
            };
            eprintln!("SKIPPED: no {self:?} DDS to test against; {how}");
        }
        found.as_ref()
    }

    fn start(self, domain_id: u32, multicast: bool, words: &[&str]) -> Running {
        let program = self.program().unwrap();
        // As configured by rmw_cyclonedds for this machine only.
        let peer = if multicast { "" } else { "<Peers><Peer Address=\"127.0.0.1\"/></Peers>" };
        let uri = format!(
            "<General><Interfaces><NetworkInterface address=\"127.0.0.1\" \
             multicast=\"{multicast}\"/></Interfaces><AllowMulticast>{multicast}</AllowMulticast>\
             </General><Discovery><ParticipantIndex>auto</ParticipantIndex>{peer}</Discovery>"
        );
        let mut child = Command::new(&program[0])
            .args(&program[1..])
            .arg(domain_id.to_string())
            .args(words)
            .env("CYCLONEDDS_URI", uri)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (send, lines) = channel();
        let output = BufReader::new(child.stdout.take().unwrap());
        std::thread::spawn(move || {
            output.lines().map_while(Result::ok).try_for_each(|line| send.send(line))
        });
        Running { child, lines, what: format!("{self:?} {words:?}") }
    }
}

/// A running peer; it is killed when this is dropped.
struct Running {
    child: Child,
    lines: Receiver<String>,
    what: String,
}

impl Running {
    #[track_caller]
    fn line(&self) -> String {
        let line = self.lines.recv_timeout(LONG);
        line.unwrap_or_else(|_| panic!("{} has no more output", self.what))
    }

    #[track_caller]
    fn lines(&self, count: usize) -> Vec<String> {
        (0..count).map(|_| self.line()).collect()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

fn python() -> Option<Vec<PathBuf>> {
    let own = here().join("../../../.venv/bin/python");
    let has = |python: &PathBuf| {
        let mut asked = Command::new(python);
        asked.args(["-c", "import cyclonedds"]).stderr(Stdio::null());
        asked.status().is_ok_and(|status| status.success())
    };
    let python = ["python3".into(), own].into_iter().find(has)?;
    Some(vec![python, here().join("tests/peers/cyclone.py")])
}

fn ros() -> Option<Vec<PathBuf>> {
    let python = here().join("../../../target/peers/ros2/bin/python");
    let mut asked = Command::new(&python);
    asked.args(["-c", "import rclpy, std_srvs.srv, nav_msgs.msg"]).stderr(Stdio::null());
    let is_there = asked.status().is_ok_and(|status| status.success());
    is_there.then(|| vec![python, here().join("tests/peers/ros.py")])
}

fn compiled() -> Option<Vec<PathBuf>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (source, program) = (here().join("tests/peers/fast.cpp"), folder.join("fast-peer"));
    let age = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    if age(&program) < age(&source) {
        let made = folder.join(format!("fast-peer-{}", std::process::id()));
        let compiler = Command::new("g++")
            .args(["-std=c++14", "-O1", "-o"])
            .arg(&made)
            .arg(&source)
            .args(["-lfastrtps", "-lfastcdr"])
            .stderr(Stdio::null())
            .status();
        if !compiler.is_ok_and(|status| status.success()) {
            return None;
        }
        std::fs::rename(made, &program).unwrap();
    }
    Some(vec![program])
}

/// Polls until there is a value; a timeout fails the test.
#[track_caller]
fn wait<T>(what: &str, mut poll: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(start.elapsed() < LONG, "timeout while waiting for {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

struct Ours {
    wire: DdsTransport,
    node: Node,
}

fn join(domain_id: u32, multicast: bool) -> Ours {
    let settings = Settings { domain_id, multicast, ..Settings::default() };
    let wire = DdsTransport::open(&settings).unwrap();
    let graph = Graph::live();
    wire.attach(&graph).unwrap();
    Ours { wire, node: graph.node(NodeSettings::new("periplus")).unwrap() }
}

/// Messages that both sides generate from a number: see `make` in the peers.
trait Kind: Message {
    const NAME: &'static str;
    fn make(number: i32, side: u32) -> Self;
    /// Header, width, height, length and sum.
    fn told(&self) -> (&Header, u32, u32, usize, i64);

    fn line(&self) -> String {
        let (header, width, height, length, sum) = self.told();
        let (name, sec, frame) = (Self::NAME, header.stamp.sec, &header.frame_id);
        format!("{name} {sec} {frame} {width}x{height} {length} {sum}")
    }
}

fn header(kind: &str, number: i32) -> Header {
    Header { stamp: Time { sec: number, nanosec: 5 }, frame_id: format!("base_{kind}") }
}

fn data(number: i32, size: u32) -> Vec<u8> {
    (0..size).map(|i| ((i + number.unsigned_abs()) % 101) as u8).collect()
}

fn sum(data: &[u8]) -> i64 {
    data.iter().map(|byte| i64::from(*byte)).sum()
}

impl Kind for LaserScan {
    const NAME: &'static str = "scan";
    fn make(number: i32, _: u32) -> Self {
        let ranges = (0..360).map(|i| (i + number) as f32 * 0.25).collect();
        Self { header: header("scan", number), ranges, range_max: 1.0, ..Self::default() }
    }
    fn told(&self) -> (&Header, u32, u32, usize, i64) {
        let sum: f64 = self.ranges.iter().map(|range| f64::from(*range)).sum();
        (&self.header, 0, 0, self.ranges.len(), sum as i64)
    }
}

impl Kind for PointCloud2 {
    const NAME: &'static str = "cloud";
    fn make(number: i32, side: u32) -> Self {
        let field = |(name, offset): (&str, u32)| PointField {
            name: name.to_owned(),
            offset,
            datatype: PointField::FLOAT32,
            count: 1,
        };
        Self {
            header: header("cloud", number),
            height: side,
            width: side,
            fields: [("x", 0), ("y", 4), ("z", 8)].map(field).into(),
            point_step: 16,
            row_step: 16 * side,
            data: data(number, side * side * 16),
            is_dense: true,
            ..Self::default()
        }
    }
    fn told(&self) -> (&Header, u32, u32, usize, i64) {
        (&self.header, self.width, self.height, self.data.len(), sum(&self.data))
    }
}

impl Kind for Image {
    const NAME: &'static str = "image";
    fn make(number: i32, side: u32) -> Self {
        Self {
            header: header("image", number),
            height: side,
            width: side,
            encoding: "rgb8".to_owned(),
            step: side * 3,
            data: data(number, side * side * 3),
            ..Self::default()
        }
    }
    fn told(&self) -> (&Header, u32, u32, usize, i64) {
        (&self.header, self.width, self.height, self.data.len(), sum(&self.data))
    }
}

impl Kind for OccupancyGrid {
    const NAME: &'static str = "grid";
    fn make(number: i32, side: u32) -> Self {
        let mut grid = Self { header: header("grid", number), ..Self::default() };
        (grid.info.width, grid.info.height, grid.info.resolution) = (side, side, 1.0);
        grid.data = data(number, side * side).into_iter().map(|byte| byte as i8).collect();
        grid
    }
    fn told(&self) -> (&Header, u32, u32, usize, i64) {
        let sum = self.data.iter().map(|cell| i64::from(*cell)).sum();
        (&self.header, self.info.width, self.info.height, self.data.len(), sum)
    }
}

impl Kind for TFMessage {
    const NAME: &'static str = "tf";
    fn make(number: i32, _: u32) -> Self {
        let mut one = TransformStamped {
            header: header("tf", number),
            child_frame_id: "child".to_owned(),
            ..TransformStamped::default()
        };
        one.transform.translation.x = f64::from(number) * 0.5;
        one.transform.rotation = Quaternion { w: 1.0, ..Quaternion::default() };
        Self { transforms: vec![one] }
    }
    fn told(&self) -> (&Header, u32, u32, usize, i64) {
        let one = &self.transforms[0];
        (&one.header, 0, 0, 0, (one.transform.translation.x * 1000.0) as i64)
    }
}

const SIDE: u32 = 100;

/// Three messages in each direction.
fn both_ways<T: Kind>(ours: &Ours, peer: Peer, domain_id: u32, multicast: bool) {
    let name = T::NAME;
    let (there, back) = (format!("/{name}_there"), format!("/{name}_back"));
    let out: Publisher<T> = ours.node.publisher(&there, Qos::reliable(10)).unwrap();
    let heard: Mailbox<T> = ours.node.mailbox(&back, Qos::reliable(10)).unwrap();
    let listener = peer.start(domain_id, multicast, &["sub", name, &format!("rt{there}"), "3"]);
    let talker = peer.start(domain_id, multicast, &["pub", name, &format!("rt{back}"), "3", "20"]);
    wait(&format!("{peer:?} to listen to {name}"), || out.is_heard().then_some(()));
    let expected: Vec<String> = (0..3).map(|number| T::make(number, SIDE).line()).collect();
    (0..3).for_each(|number| out.publish(T::make(number, SIDE)));
    assert_eq!(listener.lines(3), expected, "{peer:?} hears");
    let mut lines = Vec::new();
    wait(&format!("{name} of {peer:?}"), || {
        lines.extend(heard.drain().iter().map(|message| message.line()));
        (lines.len() == 3).then_some(())
    });
    assert_eq!(lines, expected, "{peer:?} says");
    drop(talker);
}

#[test]
fn every_kind_of_message_goes_both_ways() {
    for (at, peer) in peers() {
        let domain_id = 68 + at;
        let ours = join(domain_id, true);
        std::thread::scope(|scope| {
            let ours = &ours;
            scope.spawn(move || both_ways::<LaserScan>(ours, peer, domain_id, true));
            scope.spawn(move || both_ways::<PointCloud2>(ours, peer, domain_id, true));
            scope.spawn(move || both_ways::<Image>(ours, peer, domain_id, true));
            scope.spawn(move || both_ways::<OccupancyGrid>(ours, peer, domain_id, true));
            // PyPI has no tf2_msgs of ROS.
            if peer != Peer::Ros {
                scope.spawn(move || both_ways::<TFMessage>(ours, peer, domain_id, true));
            }
        });
        // The lifespan drops a reliable sample that takes too long.
        let findings = ours.wire.take_findings();
        let bad: Vec<_> = findings.iter().filter(|one| one.code != "dds").collect();
        assert!(bad.is_empty(), "{bad:?}");
    }
}

#[test]
fn it_works_without_multicast() {
    for (at, peer) in peers() {
        let ours = join(71 + at, false);
        both_ways::<LaserScan>(&ours, peer, 71 + at, false);
    }
}

#[test]
fn a_latecomer_gets_a_large_map_at_once() {
    for (at, peer) in peers() {
        let domain_id = 74 + at;
        let ours = join(domain_id, true);
        let map = OccupancyGrid::make(7, 4000);
        let expected = map.line();
        let out: Publisher<OccupancyGrid> = ours.node.publisher("/map", Qos::latched(1)).unwrap();
        out.publish(map);
        let listener = peer.start(domain_id, true, &["sub", "grid", "rt/map", "1", "latched"]);
        let line = listener.line();
        assert!(line.starts_with(&expected), "{line}");
        // PyPI's cyclonedds takes longer to decode it as a list, and reports no time.
        if peer != Peer::Cyclone {
            let took_ms: u64 = line.rsplit(' ').next().unwrap().parse().unwrap();
            assert!(took_ms < 2000, "the map took {took_ms} ms to {peer:?}");
        }
    }
}

#[test]
fn their_latched_map_comes_to_us_too() {
    for (at, peer) in peers().into_iter().filter(|(_, peer)| *peer != Peer::Cyclone) {
        let words = ["pub", "grid", "rt/map", "1", "0", "latched"];
        let talker = peer.start(77 + at, true, &words);
        assert_eq!(talker.line(), "done");
        let ours = join(77 + at, true);
        let maps: Mailbox<OccupancyGrid> = ours.node.mailbox("/map", Qos::latched(1)).unwrap();
        let start = Instant::now();
        let map = wait("the map", || maps.latest());
        // Fast DDS announces retained samples every 3 s, or on request in its own form.
        assert!(start.elapsed() < Duration::from_millis(2500), "it took {:?}", start.elapsed());
        assert_eq!(map.line(), OccupancyGrid::make(0, 4000).line());
    }
}

/// Fast DDS discovers us before we discover it: what it writes then must not be lost. Examples are
/// `ros2 topic pub --once`, and a client that calls as soon as its service is available.
#[test]
fn what_is_published_the_moment_we_are_found_arrives() {
    for (at, peer) in peers().into_iter().filter(|(_, peer)| *peer != Peer::Cyclone) {
        let ours = join(80 + at, true);
        let mailbox = |number| {
            let topic = format!("/hasty{number}");
            ours.node.mailbox::<LaserScan>(&topic, Qos::reliable(10)).unwrap()
        };
        let heard: Vec<_> = (0..20).map(mailbox).collect();
        let _talker = peer.start(80 + at, true, &["hasty", "scan", "rt/hasty", "20"]);
        for (number, heard) in heard.iter().enumerate() {
            let scan = wait(&format!("the only message on /hasty{number}"), || heard.latest());
            assert_eq!(scan.line(), LaserScan::make(0, 0).line());
        }
    }
}

#[test]
fn they_call_our_service() {
    for (at, peer) in peers() {
        let ours = join(83 + at, true);
        let calls = ours.node.server::<Trigger>("/ours").unwrap();
        let running = peer.start(83 + at, true, &["call", "/ours", "5"]);
        for _ in 0..5 {
            let call = wait(&format!("a call of {peer:?}"), || calls.take());
            call.answer(TriggerResponse { success: true, message: "from periplus".to_owned() });
            assert_eq!(running.line(), "answer 1 from periplus", "{peer:?}");
        }
    }
}

#[test]
fn they_call_our_service_at_the_same_time() {
    let ours = join(86, true);
    let calls = ours.node.server::<Trigger>("/ours").unwrap();
    let running: Vec<_> = peers()
        .into_iter()
        .map(|(_, peer)| (peer, peer.start(86, true, &["call", "/ours", "20"])))
        .collect();
    let mut left = 20 * running.len();
    wait("all calls", || {
        while let Some(call) = calls.take() {
            call.answer(TriggerResponse { success: true, message: "from periplus".to_owned() });
            left -= 1;
        }
        (left == 0).then_some(())
    });
    for (peer, running) in &running {
        assert_eq!(running.lines(20), ["answer 1 from periplus"; 20], "{peer:?}");
    }
}

#[test]
fn we_call_their_services() {
    for (at, peer) in peers() {
        let ours = join(87 + at, true);
        let client = ours.node.client::<Trigger>("/theirs").unwrap();
        let server = peer.start(87 + at, true, &["serve", "/theirs", "5"]);
        wait(&format!("{peer:?} to serve"), || client.is_ready().then_some(()));
        let message = match peer {
            Peer::Cyclone => "from cyclone",
            Peer::Fast => "from fast",
            Peer::Ros => "from ros",
        };
        for _ in 0..5 {
            let pending = client.call(TriggerRequest::default());
            let answer = wait(&format!("the answer of {peer:?}"), || pending.take()).unwrap();
            assert_eq!((answer.success, answer.message.as_str()), (true, message));
        }
        assert_eq!(server.line(), "done");
    }
}

#[test]
fn what_two_vendors_serve_is_asked_of_one_in_its_own_way() {
    if !peers().iter().any(|(_, peer)| *peer == Peer::Cyclone)
        || !peers().iter().any(|(_, peer)| *peer == Peer::Fast)
    {
        return;
    }
    let ours = join(90, true);
    let mut servers: Vec<_> = [(Peer::Cyclone, "from cyclone"), (Peer::Fast, "from fast")]
        .into_iter()
        .map(|(peer, says)| (peer.start(90, true, &["serve", "/theirs", "1000"]), says))
        .collect();
    let client = ours.node.client::<Trigger>("/theirs").unwrap();
    // Time for both servers to be discovered before the call.
    wait("a server", || client.is_ready().then_some(()));
    std::thread::sleep(Duration::from_secs(2));
    let ask = || {
        wait("a server", || client.is_ready().then_some(()));
        let pending = client.call(TriggerRequest::default());
        wait("the answer, or that none will come", || pending.take())
    };
    let first = ask().unwrap().message.clone();
    for _ in 0..5 {
        assert_eq!(ask().unwrap().message, first);
    }
    // The active server is killed; then the other one takes over.
    servers.retain(|(_, says)| *says != first);
    assert_eq!(servers.len(), 1);
    let second = loop {
        if let Ok(answer) = ask() {
            break answer.message.clone();
        }
    };
    assert_eq!(second, servers[0].1);
}

#[test]
fn a_killed_peer_may_come_again() {
    for (at, peer) in peers() {
        let domain_id = 91 + at;
        let ours = join(domain_id, true);
        let out: Publisher<LaserScan> = ours.node.publisher("/there", Qos::reliable(10)).unwrap();
        let heard: Mailbox<LaserScan> = ours.node.mailbox("/back", Qos::reliable(10)).unwrap();
        for round in 0..2 {
            // More than it will live for.
            let listener = peer.start(domain_id, true, &["sub", "scan", "rt/there", "100000"]);
            let talker = peer.start(domain_id, true, &["pub", "scan", "rt/back", "100000", "10"]);
            let mut number = 0;
            let start = Instant::now();
            let mut is_heard = false;
            let _ = heard.drain();
            let mut hears = false;
            while !(is_heard && hears) {
                assert!(start.elapsed() < LONG, "{peer:?} in round {round}");
                out.publish(LaserScan::make(number, 0));
                number += 1;
                is_heard |= listener.lines.try_recv().is_ok();
                hears |= heard.latest().is_some();
                std::thread::sleep(Duration::from_millis(10));
            }
            // Dropped, which is `kill -9`.
            drop((listener, talker));
            let before = Instant::now();
            for number in 0..100 {
                out.publish(LaserScan::make(number, 0));
            }
            let took = before.elapsed();
            assert!(took < Duration::from_millis(50), "a dead peer held us up for {took:?}");
        }
    }
}
