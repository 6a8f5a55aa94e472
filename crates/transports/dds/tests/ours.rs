//! Two transports in one program, connected over the loopback interface as two programs are.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test with a network waits")]

use std::sync::Arc;
use std::time::{Duration, Instant};

use periplus_dds::{DdsTransport, Settings};
use periplus_graph::{Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2};
use periplus_msgs::std_msgs::String as Text;
use periplus_msgs::std_srvs::{SetBool, SetBoolRequest, SetBoolResponse};

const LONG: Duration = Duration::from_secs(20);

/// Polls until there is a value; a timeout fails the test.
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

/// A transport with a graph in live mode.
fn join(domain_id: u32) -> (DdsTransport, Graph) {
    let wire = DdsTransport::open(&Settings { domain_id, ..Settings::default() }).unwrap();
    let graph = Graph::live();
    wire.attach(&graph).unwrap();
    (wire, graph)
}

fn text(data: &str) -> Text {
    Text { data: data.to_owned() }
}

#[test]
fn messages_go_both_ways_and_none_comes_back() {
    let (here, graph_here) = join(70);
    let (there, graph_there) = join(70);
    let node = graph_here.node(NodeSettings::new("talker").namespace("/a")).unwrap();
    let other = graph_there.node(NodeSettings::new("listener")).unwrap();
    let out: Publisher<Text> = node.publisher("/chatter", Qos::reliable(10)).unwrap();
    let own = node.mailbox::<Text>("/chatter", Qos::reliable(10)).unwrap();
    assert!(out.is_heard(), "its own node listens");
    let heard = other.mailbox::<Text>("/chatter", Qos::reliable(10)).unwrap();
    let back: Publisher<Text> = other.publisher("/chatter", Qos::reliable(10)).unwrap();
    wait("both to listen", || {
        let topics = graph_here.topics();
        let feeds = topics.iter().find(|topic| topic.name == "/chatter").unwrap().publishers.len();
        (feeds == 2 && back.is_heard() && graph_there.topics()[0].publishers.len() == 2)
            .then_some(())
    });
    // The graphs know each other before the writer has matched the reader.
    wait("the writer to match", || {
        out.publish(text("first"));
        heard.latest()
    });
    let sent = own.counts().received;
    out.publish(text("there"));
    wait("the message there", || heard.latest().filter(|message| message.data == "there"));
    assert_eq!(own.counts().received, sent + 1);
    let received = heard.counts().received;
    back.publish(text("here"));
    wait("the message here", || (own.counts().received == sent + 2).then_some(()));
    // The listener also receives from its own side; messages do not circulate.
    std::thread::sleep(Duration::from_millis(200));
    assert_eq!((own.counts().received, heard.counts().received), (sent + 2, received + 1));

    assert!(there.wait_for(LONG, |remote| remote.has_node("/a/talker")));
    let remote = there.remote();
    let topic = remote.topic("/chatter").unwrap();
    assert_eq!(topic.type_names, ["std_msgs/msg/String"]);
    assert_eq!(topic.publishers[0].node.as_deref(), Some("/a/talker"));
    assert_eq!(
        topic.publishers[0].type_hash.as_deref(),
        Some("RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18")
    );
    assert_eq!(topic.publishers[0].qos, Qos::reliable(10));
    assert!(here.flush(LONG));
    assert!(here.take_findings().iter().all(|one| one.code == "dds"));
}

#[test]
fn what_nobody_hears_is_not_heard() {
    let (_wire, graph) = join(71);
    let node = graph.node(NodeSettings::new("lidar")).unwrap();
    let out: Publisher<LaserScan> = node.publisher("/scan", Qos::sensor_data()).unwrap();
    std::thread::sleep(Duration::from_millis(300));
    assert!(!out.is_heard());
    let (there, graph_there) = join(71);
    let other = graph_there.node(NodeSettings::new("slam")).unwrap();
    let scans = other.mailbox::<LaserScan>("/scan", Qos::sensor_data()).unwrap();
    wait("a subscriber", || out.is_heard().then_some(()));
    drop((scans, other));
    wait("no subscriber", || (!out.is_heard()).then_some(()));
    drop(there);
}

#[test]
fn a_latecomer_gets_what_is_latched() {
    let (_here, graph_here) = join(72);
    let node = graph_here.node(NodeSettings::new("map_server")).unwrap();
    let out: Publisher<Text> = node.publisher("/map", Qos::latched(1)).unwrap();
    out.publish(text("old"));
    out.publish(text("map"));
    std::thread::sleep(Duration::from_millis(300));
    let (_there, graph_there) = join(72);
    let other = graph_there.node(NodeSettings::new("rviz")).unwrap();
    let maps = other.mailbox::<Text>("/map", Qos::latched(1)).unwrap();
    assert_eq!(wait("the map", || maps.latest()).data, "map");
    // A second subscriber on the same side gets it from there.
    let more = other.mailbox::<Text>("/map", Qos::latched(1)).unwrap();
    assert_eq!(wait("the map again", || more.latest()).data, "map");
    assert_eq!(maps.counts().received, 1);
}

#[test]
fn services_work_over_the_wire() {
    let (_here, graph_here) = join(73);
    let (there, graph_there) = join(73);
    let node = graph_here.node(NodeSettings::new("motor")).unwrap();
    let calls = node.server::<SetBool>("/motor/enable").unwrap();
    let other = graph_there.node(NodeSettings::new("panel")).unwrap();
    let client = other.client::<SetBool>("/motor/enable").unwrap();
    wait("the server", || client.is_ready().then_some(()));
    for on in [true, false, true] {
        let pending = client.call(SetBoolRequest { data: on });
        let call = wait("the call", || calls.take());
        assert_eq!(call.request.data, on);
        call.answer(SetBoolResponse { success: on, message: "done".to_owned() });
        let answer = wait("the answer", || pending.take()).unwrap();
        assert_eq!((answer.success, answer.message.as_str()), (on, "done"));
    }
    assert!(there.wait_for(LONG, |remote| {
        let service = remote.service("/motor/enable").unwrap();
        assert_eq!(service.type_names, ["std_srvs/srv/SetBool"]);
        service.servers == ["/motor"]
    }));

    // The server leaves while a call is pending.
    let pending = client.call(SetBoolRequest { data: true });
    let call = wait("the call", || calls.take());
    drop((_here, call, calls, node, graph_here));
    assert!(wait("the end", || pending.take()).is_err());
    wait("the server to be gone", || (!client.is_ready()).then_some(()));
}

#[test]
fn what_does_not_fit_is_named_with_both_policies() {
    let (_here, graph_here) = join(74);
    let (there, graph_there) = join(74);
    let node = graph_here.node(NodeSettings::new("lidar")).unwrap();
    let _out: Publisher<LaserScan> = node.publisher("/scan", Qos::sensor_data()).unwrap();
    let other = graph_there.node(NodeSettings::new("slam")).unwrap();
    let _scans = other.mailbox::<LaserScan>("/scan", Qos::latched(1)).unwrap();
    let _wrong: Publisher<Text> = node.publisher("/cloud", Qos::default()).unwrap();
    let _cloud = other.mailbox::<PointCloud2>("/cloud", Qos::default()).unwrap();
    let _hash = node
        .raw_publisher(
            "/more",
            "std_msgs/msg/String",
            Some("RIHS01_0000000000000000000000000000000000000000000000000000000000000000"),
            Qos::default(),
        )
        .unwrap();
    let _text = other.mailbox::<Text>("/more", Qos::default()).unwrap();
    let mut found = Vec::new();
    wait("the findings", || {
        let findings = there.take_findings();
        // DDS logs for the whole process, other tests included.
        let ours = findings.iter().filter(|one| one.code != "dds");
        found.extend(ours.map(|one| one.message.clone()));
        (found.len() == 3).then_some(())
    });
    found.sort();
    expect_test::expect![[r#"
        `/slam` receives nothing from `/lidar` on the topic `/scan`: the publisher offers reliability best_effort, requested is reliable; it offers durability volatile, requested is transient_local
        on the topic `/cloud` `/slam` has the type sensor_msgs/msg/PointCloud2, and `/lidar` std_msgs/msg/String
        on the topic `/more` `/slam` and `/lidar` both use std_msgs/msg/String, but with two definitions: RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18 and RIHS01_0000000000000000000000000000000000000000000000000000000000000000"#]]
    .assert_eq(&found.join("\n"));
}

#[test]
fn bad_samples_are_survived() {
    let (_here, graph_here) = join(75);
    let (_there, graph_there) = join(75);
    let node = graph_here.node(NodeSettings::new("liar")).unwrap();
    let out =
        node.raw_publisher("/scan", "sensor_msgs/msg/LaserScan", None, Qos::default()).unwrap();
    let other = graph_there.node(NodeSettings::new("slam")).unwrap();
    let scans = other.mailbox::<LaserScan>("/scan", Qos::default()).unwrap();
    wait("a subscriber", || out.is_heard().then_some(()));
    out.publish(vec![0, 1, 0, 0, 255, 255, 255, 255]);
    out.publish(Vec::new());
    out.publish(vec![9; 40_000]);
    out.publish(periplus_msgs::Message::to_cdr(&LaserScan::default()).unwrap());
    wait("the good one", || scans.drain().pop());
    assert_eq!(scans.counts().undecodable, 2, "the empty one never went out");
}

#[test]
fn a_large_message_waits_for_no_small_one() {
    let (here, graph_here) = join(76);
    let (_there, graph_there) = join(76);
    let node = graph_here.node(NodeSettings::new("camera")).unwrap();
    let cloud: Publisher<PointCloud2> = node.publisher("/cloud", Qos::reliable(5)).unwrap();
    let tick: Publisher<Text> = node.publisher("/tick", Qos::reliable(100)).unwrap();
    let other = graph_there.node(NodeSettings::new("sink")).unwrap();
    let clouds = other.mailbox::<PointCloud2>("/cloud", Qos::reliable(100)).unwrap();
    let ticks = other.mailbox::<Text>("/tick", Qos::reliable(100)).unwrap();
    wait("both to listen", || (cloud.is_heard() && tick.is_heard()).then_some(()));
    let large = Arc::new(PointCloud2 { data: vec![7; 10_000_000], ..PointCloud2::default() });
    let start = Instant::now();
    for _ in 0..5 {
        cloud.publish_shared(&large);
        tick.publish(text("tick"));
    }
    let published = start.elapsed();
    assert!(published < Duration::from_millis(50), "publishing took {published:?}");
    wait("all ticks", || (ticks.counts().received == 5).then_some(()));
    assert!(here.flush(LONG));
    wait("a cloud", || (clouds.counts().received == 5).then_some(()));
    assert_eq!(clouds.latest().unwrap().data.len(), 10_000_000);
}

#[test]
fn one_wire_takes_one_graph() {
    let (wire, _graph) = join(77);
    let error = wire.attach(&Graph::new()).unwrap_err();
    assert_eq!(error.to_string(), "the transport already has a graph; open another transport");
    let wrong = Settings { cyclone: "<CycloneDDS><Nonsense/>".into(), ..Settings::default() };
    let error = DdsTransport::open(&wrong).unwrap_err().to_string();
    assert!(error.contains("cannot join the ROS 2 network, domain 0"), "{error}");
}
