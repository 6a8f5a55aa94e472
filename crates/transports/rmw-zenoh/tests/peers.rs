//! Interoperability with PyPI's `eclipse-zenoh`, which speaks the keys, tokens and attachments of
//! `rmw_zenoh`. A second such program is the router. A missing peer is skipped with a message.
//! `cargo xtask zenoh` installs it and runs this.
#![cfg(feature = "zenoh")]
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::String as Text;
use periplus_msgs::std_srvs::{Trigger, TriggerRequest, TriggerResponse};
use periplus_rmw_zenoh::{EntityKind, Settings, ZenohTransport};

const LONG: Duration = Duration::from_secs(40);

/// Python with the packages of the peer.
fn python() -> Option<&'static PathBuf> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    let found = PYTHON.get_or_init(|| {
        let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../.venv/bin/python");
        let has = |python: &PathBuf| {
            let mut asked = Command::new(python);
            asked.args(["-c", "import zenoh, xxhash"]).stderr(Stdio::null());
            asked.status().is_ok_and(|status| status.success())
        };
        ["python3".into(), own].into_iter().find(has)
    });
    if found.is_none() {
        eprintln!("SKIPPED: no Zenoh to test against; pip install eclipse-zenoh==1.10.2 xxhash");
    }
    found.as_ref()
}

/// A running peer; it is killed when this is dropped.
struct Running {
    child: Child,
    lines: Receiver<String>,
    what: String,
}

impl Running {
    fn start(python: &Path, port: u16, words: &[&str]) -> Self {
        let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peers/zenoh_peer.py");
        let mut child = Command::new(python)
            .arg(program)
            .arg(port.to_string())
            .args(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (send, lines) = channel();
        let output = BufReader::new(child.stdout.take().unwrap());
        std::thread::spawn(move || {
            output.lines().map_while(Result::ok).try_for_each(|line| send.send(line))
        });
        Self { child, lines, what: format!("{words:?}") }
    }

    #[track_caller]
    fn lines(&self, count: usize) -> Vec<String> {
        let line = || self.lines.recv_timeout(LONG);
        (0..count)
            .map(|_| line().unwrap_or_else(|_| panic!("{} has no output", self.what)))
            .collect()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
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

/// A router, and the programs connected through it.
struct Place {
    python: &'static Path,
    port: u16,
    _router: Running,
}

struct Ours {
    wire: ZenohTransport,
    node: Node,
}

impl Place {
    /// Each test has its own port; none without the peer.
    fn at(port: u16) -> Option<Self> {
        let python = python()?;
        let router = Running::start(python, port, &["router"]);
        assert_eq!(router.lines(1), ["ready"]);
        Some(Self { python, port, _router: router })
    }

    fn peer(&self, words: &[&str]) -> Running {
        Running::start(self.python, self.port, words)
    }

    fn join(&self, name: &str) -> Ours {
        let connect = vec![format!("tcp/127.0.0.1:{}", self.port)];
        let wire = ZenohTransport::open(&Settings { connect, ..Settings::default() }).unwrap();
        let graph = Graph::live();
        wire.attach(&graph).unwrap();
        let findings = wire.take_findings();
        assert_eq!(findings.iter().count(), 0, "{findings:?}");
        Ours { wire, node: graph.node(NodeSettings::new(name).bare()).unwrap() }
    }
}

fn text(number: u32) -> Text {
    Text { data: format!("from periplus {number}") }
}

#[test]
fn messages_go_both_ways() {
    let Some(place) = Place::at(17501) else { return };
    let ours = place.join("periplus");
    let out: Publisher<Text> = ours.node.publisher("/demo/there", Qos::reliable(10)).unwrap();
    let heard: Mailbox<Text> = ours.node.mailbox("/demo/back", Qos::reliable(10)).unwrap();
    let listener = place.peer(&["sub", "/demo/there", "3"]);
    let talker = place.peer(&["pub", "/demo/back", "3"]);
    wait("a listener", || out.is_heard().then_some(()));
    // It receives before it knows the publisher, and prints then.
    (1..=3).for_each(|number| out.publish(text(number)));
    let expected =
        (1..=3).map(|number| format!("from periplus {number} number {number}, its name"));
    assert_eq!(listener.lines(3), expected.collect::<Vec<_>>());
    let mut came = Vec::new();
    wait("their messages", || {
        came.extend(heard.drain().iter().map(|message| message.data.clone()));
        (came.len() == 3).then_some(())
    });
    assert_eq!(came, ["from zenoh 1", "from zenoh 2", "from zenoh 3"]);
    assert_eq!(talker.lines(1), ["done"]);
    // No subscribers left: the message is not computed.
    drop(listener);
    wait("the loss of the last subscriber", || (!out.is_heard()).then_some(()));
}

#[test]
fn others_see_who_we_are_and_we_see_them() {
    let Some(place) = Place::at(17502) else { return };
    let ours = place.join("lidar");
    let _scan: Publisher<LaserScan> = ours.node.publisher("/scan", Qos::sensor_data()).unwrap();
    let _map: Mailbox<OccupancyGrid> = ours.node.mailbox("/map", Qos::latched(1)).unwrap();
    let _serves = ours.node.server::<Trigger>("/reset").unwrap();
    let _calls = ours.node.client::<Trigger>("/theirs").unwrap();
    let looking = place.peer(&["tokens", "5"]);
    let scan = "sensor_msgs::msg::dds_::LaserScan_ \
                RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828";
    let grid = "nav_msgs::msg::dds_::OccupancyGrid_ \
                RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7";
    let trigger = "std_srvs::srv::dds_::Trigger_ \
                   RIHS01_eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f";
    let mut lines = looking.lines(5);
    lines.sort();
    assert_eq!(
        lines,
        [
            format!("0 MP % % lidar %scan {scan} 2::,5:,:,:,,"),
            format!("0 MS % % lidar %map {grid} :1:,1:,:,:,,"),
            "0 NN % % lidar".to_owned(),
            format!("0 SC % % lidar %theirs {trigger} ::,10:,:,:,,"),
            format!("0 SS % % lidar %reset {trigger} ::,10:,:,:,,"),
        ]
    );
    // They are discovered, and removed when they are killed.
    let serving = place.peer(&["serve", "/theirs", "1"]);
    let has_server = |others: &[periplus_rmw_zenoh::EntityToken]| {
        others.iter().any(|one| {
            let name = one.end.as_ref().map(|end| end.name.as_str());
            one.kind == EntityKind::Server && one.node == "/peer" && name == Some("/theirs")
        })
    };
    assert!(ours.wire.wait_for(LONG, has_server), "{:?}", ours.wire.remote());
    drop(serving);
    assert!(ours.wire.wait_for(LONG, |others| !has_server(others)));
}

#[test]
fn a_latecomer_gets_what_is_latched() {
    let Some(place) = Place::at(17503) else { return };
    let ours = place.join("map_server");
    let out: Publisher<Text> = ours.node.publisher("/there", Qos::latched(1)).unwrap();
    out.publish(text(1));
    out.publish(text(2));
    let talker = place.peer(&["pub", "/back", "2", "latched"]);
    assert_eq!(talker.lines(1), ["done"]);
    assert!(ours.wire.flush(LONG));
    // Both start late.
    let listener = place.peer(&["sub", "/there", "1", "latched"]);
    // The first message may have been dropped before the second was sent.
    let line = listener.lines(1).remove(0);
    assert!(line.starts_with("from periplus 2 number ") && line.ends_with(", its name"), "{line}");
    let late: Mailbox<Text> = ours.node.mailbox("/back", Qos::latched(1)).unwrap();
    assert_eq!(wait("what they latched", || late.latest()).data, "from zenoh 2");
}

#[test]
fn they_call_our_service() {
    let Some(place) = Place::at(17504) else { return };
    let ours = place.join("periplus");
    let calls = ours.node.server::<Trigger>("/demo/ours").unwrap();
    let running = place.peer(&["call", "/demo/ours", "5"]);
    for _ in 0..5 {
        let call = wait("a call", || calls.take());
        call.answer(TriggerResponse { success: true, message: "from periplus".to_owned() });
        assert_eq!(running.lines(1), ["answer 1 from periplus, mine"]);
    }
}

#[test]
fn we_call_their_service_and_hear_when_it_dies() {
    let Some(place) = Place::at(17505) else { return };
    let ours = place.join("periplus");
    let client = ours.node.client::<Trigger>("/demo/theirs").unwrap();
    let server = place.peer(&["serve", "/demo/theirs", "3"]);
    wait("a server", || client.is_ready().then_some(()));
    for _ in 0..3 {
        let pending = client.call(TriggerRequest::default());
        let answer = wait("an answer", || pending.take()).unwrap();
        assert_eq!((answer.success, answer.message.as_str()), (true, "from zenoh"));
    }
    let asked = "asked with 5 bytes, its name and number";
    assert_eq!(server.lines(4), [asked, asked, asked, "done"]);
    let pending = client.call(TriggerRequest::default());
    std::thread::sleep(Duration::from_millis(200));
    drop(server);
    assert!(wait("word that no answer will come", || pending.take()).is_err());
    wait("it to be gone", || (!client.is_ready()).then_some(()));
}

#[test]
fn two_of_ours_meet_and_a_large_map_comes_late() {
    let Some(place) = Place::at(17506) else { return };
    let server = place.join("map_server");
    let out: Publisher<OccupancyGrid> = server.node.publisher("/map", Qos::latched(1)).unwrap();
    let mut map = OccupancyGrid::default();
    (map.info.width, map.info.height) = (4000, 4000);
    map.data = (0..16_000_000).map(|at| (at % 101) as i8).collect();
    out.publish(map.clone());
    assert!(server.wire.flush(LONG));
    let client = place.join("planner");
    let start = Instant::now();
    let late: Mailbox<OccupancyGrid> = client.node.mailbox("/map", Qos::latched(1)).unwrap();
    assert_eq!(*wait("the map", || late.latest()), map);
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}

#[test]
fn types_that_differ_are_named() {
    let Some(place) = Place::at(17507) else { return };
    let one = place.join("one");
    let _out: Publisher<Text> = one.node.publisher("/mixed", Qos::reliable(1)).unwrap();
    let other = place.join("other");
    let _in: Mailbox<LaserScan> = other.node.mailbox("/mixed", Qos::reliable(1)).unwrap();
    let finding = wait("a word about it", || one.wire.take_findings().iter().next().cloned());
    let expected = "on the topic `/mixed` `/one` has the type std_msgs/msg/String, and `/other` \
                    sensor_msgs/msg/LaserScan";
    assert_eq!((finding.code, finding.message.as_str()), ("type-mismatch", expected));
}

#[test]
fn no_router_is_a_finding_and_bad_settings_are_errors() {
    let connect = vec!["tcp/127.0.0.1:17599".to_owned()];
    let alone = ZenohTransport::open(&Settings { connect: connect.clone(), ..Settings::default() })
        .unwrap();
    let findings = alone.take_findings();
    let told: Vec<&str> = findings.iter().map(|one| one.code).collect();
    assert_eq!(told, ["zenoh-router"]);
    for more in ["mode", "mode=\"king\"", "no/such/thing=1"] {
        let bad =
            Settings { connect: connect.clone(), more: more.to_owned(), ..Settings::default() };
        let error = ZenohTransport::open(&bad).unwrap_err().to_string();
        assert!(error.contains(more) && error.contains("ZENOH_CONFIG_OVERRIDE"), "{error}");
    }
    let missing = Settings { file: Some("/no/such/file.json5".to_owned()), ..Settings::default() };
    let error = ZenohTransport::open(&missing).unwrap_err().to_string();
    assert!(error.contains("/no/such/file.json5"), "{error}");
}
