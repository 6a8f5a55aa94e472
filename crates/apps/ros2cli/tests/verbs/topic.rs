//! `topic`.

use std::time::Duration;

use expect_test::{Expect, expect};
use periplus_graph::{Publisher, Qos};
use periplus_msgs::{geometry_msgs, sensor_msgs, std_msgs, tf2_msgs};
use periplus_ros2cli::QosRequest;
use periplus_ros2cli::show::Form;
use periplus_ros2cli::topic::{self, Publish, Rate, TopicEchoOptions, TopicListOptions};

use crate::bench::Bench;

/// A robot that publishes scans and subscribes to velocity commands.
struct Robot {
    bench: Bench,
    scan: Publisher<sensor_msgs::LaserScan>,
    _parts: Vec<Box<dyn std::any::Any>>,
}

fn robot() -> Robot {
    let bench = Bench::new();
    let lidar =
        bench.graph.node(periplus_graph::NodeSettings::new("lidar").namespace("/bot").bare());
    let lidar = lidar.unwrap();
    let scan = lidar.publisher("/scan", Qos::sensor_data()).unwrap();
    let wheels = bench.graph.node(periplus_graph::NodeSettings::new("wheels").bare()).unwrap();
    let commands = wheels.mailbox::<geometry_msgs::Twist>("/cmd_vel", Qos::reliable(1)).unwrap();
    let viewer = wheels.mailbox::<sensor_msgs::LaserScan>("/scan", Qos::sensor_data()).unwrap();
    let hidden = wheels.publisher::<std_msgs::Empty>("/_alive", Qos::latched(1)).unwrap();
    let parts: Vec<Box<dyn std::any::Any>> = vec![
        Box::new(lidar),
        Box::new(wheels),
        Box::new(commands),
        Box::new(viewer),
        Box::new(hidden),
    ];
    Robot { bench, scan, _parts: parts }
}

#[test]
fn topics_are_listed() {
    let robot = robot();
    let check = |options: TopicListOptions, expected: Expect| {
        robot.bench.check(|session| topic::list(session, options), expected);
    };
    check(
        TopicListOptions::default(),
        expect![[r#"
        /cmd_vel
        /scan
    "#]],
    );
    check(
        TopicListOptions { show_types: true, include_hidden: true, ..TopicListOptions::default() },
        expect![[r#"
        /_alive [std_msgs/msg/Empty]
        /cmd_vel [geometry_msgs/msg/Twist]
        /scan [sensor_msgs/msg/LaserScan]
    "#]],
    );
    check(
        TopicListOptions { count: true, ..TopicListOptions::default() },
        expect![[r#"
        2
    "#]],
    );
    check(
        TopicListOptions { verbose: true, ..TopicListOptions::default() },
        expect![[r#"
        Published topics:
         * /scan [sensor_msgs/msg/LaserScan] 1 publisher

        Subscribed topics:
         * /cmd_vel [geometry_msgs/msg/Twist] 1 subscriber
         * /scan [sensor_msgs/msg/LaserScan] 1 subscriber

    "#]],
    );
    let json = Robot { bench: robot.bench.json(), ..robot };
    json.bench.check(|session| topic::list(session, TopicListOptions::default()), expect![[r#"
        {"topics":[{"name":"/cmd_vel","publishers":0,"subscriptions":1,"types":["geometry_msgs/msg/Twist"]},{"name":"/scan","publishers":1,"subscriptions":1,"types":["sensor_msgs/msg/LaserScan"]}]}
    "#]]);
}

#[test]
fn a_topic_is_described() {
    let robot = robot();
    let check = |name: &str, verbose: bool, expected: Expect| {
        robot.bench.check(|session| topic::info(session, name, verbose), expected);
    };
    check(
        "scan",
        false,
        expect![[r#"
        Type: sensor_msgs/msg/LaserScan
        Publisher count: 1
        Subscription count: 1
    "#]],
    );
    check(
        "/scan",
        true,
        expect![[r#"
        Type: sensor_msgs/msg/LaserScan

        Publisher count: 1

        Node name: lidar
        Node namespace: /bot
        Topic type: sensor_msgs/msg/LaserScan
        Topic type hash: RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828
        Endpoint type: PUBLISHER
        QoS profile:
          Reliability: BEST_EFFORT
          History (Depth): KEEP_LAST (5)
          Durability: VOLATILE
          Lifespan: Infinite
          Deadline: Infinite
          Liveliness: AUTOMATIC
          Liveliness lease duration: Infinite

        Subscription count: 1

        Node name: wheels
        Node namespace: /
        Topic type: sensor_msgs/msg/LaserScan
        Topic type hash: RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828
        Endpoint type: SUBSCRIPTION
        QoS profile:
          Reliability: BEST_EFFORT
          History (Depth): KEEP_LAST (5)
          Durability: VOLATILE
          Lifespan: Infinite
          Deadline: Infinite
          Liveliness: AUTOMATIC
          Liveliness lease duration: Infinite

    "#]],
    );
    check(
        "/scam",
        false,
        expect![[r#"
        ! Unknown topic '/scam'; did you mean `/scan`?
    "#]],
    );
    let json = Robot { bench: robot.bench.json(), ..robot };
    json.bench.check(|session| topic::info(session, "/cmd_vel", false), expect![[r#"
        {"name":"/cmd_vel","publishers":[],"subscriptions":[{"gid":"","node":"/wheels","qos":{"deadline_ns":null,"depth":1,"durability":"volatile","history":"keep_last","lease_ns":null,"lifespan_ns":null,"liveliness":"automatic","reliability":"reliable"},"type":"geometry_msgs/msg/Twist","type_hash":"RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"}],"types":["geometry_msgs/msg/Twist"]}
    "#]]);
}

#[test]
fn types_and_topics_are_found() {
    let robot = robot();
    let bench = &robot.bench;
    bench.check(
        |session| topic::type_of(session, "/scan"),
        expect![[r#"
        sensor_msgs/msg/LaserScan
    "#]],
    );
    bench.check(
        |session| topic::type_of(session, "/nothing"),
        expect![[r#"
        ! Unknown topic '/nothing'
    "#]],
    );
    bench.check(
        |session| topic::find(session, "geometry_msgs/Twist", false, false),
        expect![[r#"
        /cmd_vel
    "#]],
    );
    bench.check(
        |session| topic::find(session, "geometry_msgs/msg/Twist", true, false),
        expect![[r#"
        1
    "#]],
    );
    bench.check(
        |session| topic::find(session, "Twist", true, false),
        expect![[r#"
        ! `Twist` is not a valid message type; write `package/msg/Name`
    "#]],
    );
}

/// Echoes the messages that `publish` publishes periodically until the end.
fn echo(
    bench: &Bench,
    topic: &str,
    options: &TopicEchoOptions,
    mut publish: impl FnMut() + Send,
) -> String {
    let done = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(std::sync::atomic::Ordering::Relaxed) {
                publish();
                std::thread::sleep(Duration::from_millis(5));
            }
        });
        let text = bench.run(|session| topic::echo(session, topic, options));
        done.store(true, std::sync::atomic::Ordering::Relaxed);
        text
    })
}

fn once() -> TopicEchoOptions {
    TopicEchoOptions { once: true, ..TopicEchoOptions::default() }
}

#[test]
fn messages_are_shown_in_every_form() {
    let bench = Bench::new();
    let node = bench.node("tf");
    let publisher = node.publisher::<tf2_msgs::TFMessage>("/tf", Qos::reliable(10)).unwrap();
    let check = |change: &dyn Fn(&mut TopicEchoOptions), expected: Expect| {
        let mut options = once();
        change(&mut options);
        let text = echo(&bench, "/tf", &options, || {
            let mut one = geometry_msgs::TransformStamped::default();
            one.header.frame_id = "odom".into();
            one.child_frame_id = "it's".into();
            one.transform.translation.x = 0.25;
            publisher.publish(tf2_msgs::TFMessage { transforms: vec![one; 2] });
        });
        expected.assert_eq(&text);
    };
    check(
        &|_| {},
        expect![[r#"
        transforms:
        - header:
            stamp:
              sec: 0
              nanosec: 0
            frame_id: odom
          child_frame_id: it's
          transform:
            translation:
              x: 0.25
              y: 0.0
              z: 0.0
            rotation:
              x: 0.0
              y: 0.0
              z: 0.0
              w: 1.0
        - header:
            stamp:
              sec: 0
              nanosec: 0
            frame_id: odom
          child_frame_id: it's
          transform:
            translation:
              x: 0.25
              y: 0.0
              z: 0.0
            rotation:
              x: 0.0
              y: 0.0
              z: 0.0
              w: 1.0
        ---
    "#]],
    );
    check(
        &|options| options.show.style.flow = true,
        expect![[r#"
        {transforms: [{header: {stamp: {sec: 0, nanosec: 0}, frame_id: odom}, child_frame_id: it's, transform: {translation: {x: 0.25, y: 0.0, z: 0.0}, rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}}, {header: {stamp: {sec: 0, nanosec: 0}, frame_id: odom}, child_frame_id: it's, transform: {translation: {x: 0.25, y: 0.0, z: 0.0}, rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}}]}
        ---
    "#]],
    );
    check(
        &|options| options.show.style.longest = Some(1),
        expect![[r#"
        transforms:
        - header:
            stamp:
              sec: 0
              nanosec: 0
            frame_id: o...
          child_frame_id: i...
          transform:
            translation:
              x: 0.25
              y: 0.0
              z: 0.0
            rotation:
              x: 0.0
              y: 0.0
              z: 0.0
              w: 1.0
        - '...'
        ---
    "#]],
    );
    check(
        &|options| options.show.form = Form::Csv,
        expect![[r#"
        0,0,odom,it's,0.25,0.0,0.0,0.0,0.0,0.0,1.0,0,0,odom,it's,0.25,0.0,0.0,0.0,0.0,0.0,1.0
    "#]],
    );
    check(
        &|options| {
            options.show.form = Form::Csv;
            options.show.style.longest = Some(1);
        },
        expect![[r#"
        0,0,o...,i...,0.25,0.0,0.0,0.0,0.0,0.0,1.0,...
    "#]],
    );
    check(
        &|options| {
            options.show.form = Form::Json;
            options.show.style.longest = None;
        },
        expect![[r#"
        {"transforms":[{"header":{"stamp":{"sec":0,"nanosec":0},"frame_id":"odom"},"child_frame_id":"it's","transform":{"translation":{"x":0.25,"y":0.0,"z":0.0},"rotation":{"x":0.0,"y":0.0,"z":0.0,"w":1.0}}},{"header":{"stamp":{"sec":0,"nanosec":0},"frame_id":"odom"},"child_frame_id":"it's","transform":{"translation":{"x":0.25,"y":0.0,"z":0.0},"rotation":{"x":0.0,"y":0.0,"z":0.0,"w":1.0}}}]}
    "#]],
    );
    check(
        &|options| {
            options.show.form = Form::Json;
            options.show.style.longest = Some(1);
        },
        expect![[r#"
        {"transforms":[{"header":{"stamp":{"sec":0,"nanosec":0},"frame_id":"o..."},"child_frame_id":"i...","transform":{"translation":{"x":0.25,"y":0.0,"z":0.0},"rotation":{"x":0.0,"y":0.0,"z":0.0,"w":1.0}}}]}
    "#]],
    );
    let field = |path: &'static str| {
        move |options: &mut TopicEchoOptions| options.show.field = Some(path.into())
    };
    check(
        &field("transforms[1].transform.translation"),
        expect![[r#"
        x: 0.25
        y: 0.0
        z: 0.0
        ---
    "#]],
    );
    check(
        &field("transforms[-1].transform.translation.x"),
        expect![[r#"
        0.25
        ---
    "#]],
    );
    check(
        &field("transforms[0].child_frame_id"),
        expect![[r#"
        it's
        ---
    "#]],
    );
    check(
        &field("transforms[0].header.stam"),
        expect![[r#"
        ! tf2_msgs/msg/TFMessage has no field `transforms[0].header.stam`: there is no field `stam`, did you mean `stamp`? (at `transforms[0].header`)
    "#]],
    );
    check(
        &field("transforms[2]"),
        expect![[r#"
        ! tf2_msgs/msg/TFMessage has no field `transforms[2]`: expected an index below 2, found `2` (at `transforms`)
    "#]],
    );
    check(
        &|options| {
            options.show.style.no_arrays = true;
        },
        expect![[r#"
        transforms: '<array type: geometry_msgs/TransformStamped[2]>'
        ---
    "#]],
    );
}

#[test]
fn bytes_are_shown_raw() {
    let bench = Bench::new();
    let node = bench.node("talker");
    let publisher = node.publisher::<std_msgs::String>("/chatter", Qos::reliable(10)).unwrap();
    let options = TopicEchoOptions { raw: true, ..once() };
    let text = echo(&bench, "chatter", &options, || {
        publisher.publish(std_msgs::String { data: "it's".into() });
    });
    expect![[r#"
        b"\x00\x01\x00\x00\x05\x00\x00\x00it's\x00"
        ---
    "#]]
    .assert_eq(&text);
}

#[test]
fn messages_are_filtered() {
    let bench = Bench::new();
    let node = bench.node("counter");
    let publisher = node.publisher::<std_msgs::Int32>("/count", Qos::reliable(10)).unwrap();
    let filter = |filter: &str| TopicEchoOptions { filter: Some(filter.into()), ..once() };
    let mut data = 0;
    let text = echo(&bench, "/count", &filter("m.data % 7 == 6 and m.data > 6"), || {
        data += 1;
        publisher.publish(std_msgs::Int32 { data });
    });
    expect![[r#"
        data: 13
        ---
    "#]]
    .assert_eq(&text);
    let text = echo(&bench, "/count", &filter("m.date"), || {
        publisher.publish(std_msgs::Int32 { data: 0 });
    });
    expect![[r#"
        ! the filter `m.date` has no value: the namespace `m` has no `date`; did you mean `data`?
    "#]]
    .assert_eq(&text);
}

#[test]
fn who_comes_late_hears_latched_topics() {
    let bench = Bench::new();
    let node = bench.node("map");
    let publisher = node.publisher::<std_msgs::String>("/map_name", Qos::latched(1)).unwrap();
    publisher.publish(std_msgs::String { data: "hall".into() });
    bench.check(
        |session| topic::echo(session, "/map_name", &once()),
        expect![[r#"
        data: hall
        ---
    "#]],
    );
    // Explicit options take precedence.
    let volatile = QosRequest { durability: Some("volatile".into()), ..QosRequest::default() };
    let options =
        TopicEchoOptions { qos: volatile, timeout: Some(Duration::from_millis(50)), ..once() };
    bench.check(
        |session| topic::echo(session, "/map_name", &options),
        expect![[r#"
        ! no message received on /map_name in time
    "#]],
    );
    let wrong = QosRequest { reliability: Some("relaible".into()), ..QosRequest::default() };
    let options = TopicEchoOptions { qos: wrong, ..once() };
    bench.check(
        |session| topic::echo(session, "/map_name", &options),
        expect![[r#"
        ! --qos-reliability is `relaible`; expected one of reliable, best_effort
    "#]],
    );
}

#[test]
fn publishers_that_do_not_fit_are_named() {
    let robot = robot();
    let reliable = QosRequest { reliability: Some("reliable".into()), ..QosRequest::default() };
    let options =
        TopicEchoOptions { qos: reliable, timeout: Some(Duration::from_millis(30)), ..once() };
    robot.bench.check(|session| topic::echo(session, "/scan", &options), expect![[r#"
        | WARNING: /bot/lidar offers /scan with reliability best_effort, and reliable is requested: its messages are not received
        ! no message received on /scan in time
    "#]]);
}

#[test]
fn what_cannot_be_heard_is_told() {
    let robot = robot();
    robot.bench.check(|session| topic::echo(session, "/scn", &once()), expect![[r#"
        | WARNING: topic [/scn] does not appear to be published yet
        ! could not determine the type of /scn: it has no publisher and no subscriber; did you mean `/scan`? Give the type after the name to wait for it
    "#]]);
    let options = TopicEchoOptions { type_name: Some("my_msgs/Thing".into()), ..once() };
    robot.bench.check(|session| topic::echo(session, "/scan", &options), expect![[r#"
        ! the message type `my_msgs/msg/Thing` is unknown. If it is in a package of yours, give its folder with `--interfaces DIR`, or add the install prefix of `my_msgs` to AMENT_PREFIX_PATH
    "#]]);
    let options = TopicEchoOptions { type_name: Some("sensor_msgs/msg/LaserScn".into()), ..once() };
    robot.bench.check(|session| topic::echo(session, "/scan", &options), expect![[r#"
        ! the message type `sensor_msgs/msg/LaserScn` is unknown. Did you mean `sensor_msgs/msg/LaserScan`? If it is in a package of yours, give its folder with `--interfaces DIR`, or add the install prefix of `sensor_msgs` to AMENT_PREFIX_PATH
    "#]]);
}

#[test]
fn a_large_cloud_is_shown_at_once() {
    let bench = Bench::new();
    let node = bench.node("camera");
    let publisher =
        node.publisher::<sensor_msgs::PointCloud2>("/points", Qos::reliable(1)).unwrap();
    let cloud = sensor_msgs::PointCloud2 { data: vec![7; 9_830_400], ..Default::default() };
    let cloud = std::sync::Arc::new(cloud);
    let start = periplus_os::Stopwatch::start();
    let text = echo(&bench, "/points", &once(), || publisher.publish_shared(&cloud));
    assert_eq!(text.lines().filter(|line| *line == "- 7").count(), 128);
    assert!(text.lines().count() < 160, "{}", text.lines().count());
    assert!(start.elapsed() < Duration::from_secs(15), "{:?}", start.elapsed());
}

#[test]
fn rates_are_measured() {
    let robot = robot();
    let bench = Bench { stop_after: Some(Duration::from_millis(1_250)), ..robot.bench.json() };
    let scan = &robot.scan;
    let ten_ms = || {
        scan.publish(sensor_msgs::LaserScan { ranges: vec![1.0; 100], ..Default::default() });
    };
    let measure = |verb: &(
                        dyn Fn(&mut periplus_ros2cli::Session<'_>) -> periplus_ros2cli::Outcome
                            + Sync
                    )| {
        let done = std::sync::atomic::AtomicBool::new(false);
        let text = std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(std::sync::atomic::Ordering::Relaxed) {
                    ten_ms();
                    std::thread::sleep(Duration::from_millis(10));
                }
            });
            let text = bench.run(verb);
            done.store(true, std::sync::atomic::Ordering::Relaxed);
            text
        });
        let line = text.lines().next().unwrap_or_default();
        assert!(!text.contains('!'), "{text}");
        serde_json::from_str::<serde_json::Value>(line).unwrap()
    };
    let topics = ["/scan".to_owned()];
    let rate = measure(&|session| topic::hz(session, &topics, &Rate::default()));
    let hz = rate["rate_hz"].as_f64().unwrap();
    assert!((20.0..101.0).contains(&hz), "{rate}");
    let flow = measure(&|session| topic::bandwidth(session, "/scan", &Rate::default()));
    assert_eq!(flow["min_bytes"], flow["max_bytes"], "{flow}");
    assert!(flow["mean_bytes"].as_f64().unwrap() > 400.0, "{flow}");
    let age = measure(&|session| topic::delay(session, "/scan", &Rate::default()));
    // The stamps are in 1970.
    assert!(age["delay_s"].as_f64().unwrap() > 1.6e9, "{age}");
}

#[test]
fn messages_are_published() {
    let bench = Bench::new();
    let node = bench.node("wheels");
    let heard = node.mailbox::<geometry_msgs::Twist>("/cmd_vel", Qos::reliable(10)).unwrap();
    let options = Publish { times: Some(2), rate_hz: 100.0, ..Publish::default() };
    bench.check(
        |session| topic::publish(session, "cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}", &options),
        expect![[r#"
            publisher: beginning loop
            publishing #1: geometry_msgs.msg.Twist(linear=geometry_msgs.msg.Vector3(x=0.5, y=0.0, z=0.0), angular=geometry_msgs.msg.Vector3(x=0.0, y=0.0, z=0.0))

            publishing #2: geometry_msgs.msg.Twist(linear=geometry_msgs.msg.Vector3(x=0.5, y=0.0, z=0.0), angular=geometry_msgs.msg.Vector3(x=0.0, y=0.0, z=0.0))

        "#]],
    );
    let speeds: Vec<f64> = heard.drain().iter().map(|twist| twist.linear.x).collect();
    assert_eq!(speeds, [0.5, 0.5]);
    let options = Publish { times: Some(1), most_wait: Some(Duration::ZERO), ..Publish::default() };
    bench.check(
        |session| topic::publish(session, "/nobody", "std_msgs/Int8", "", &options),
        expect![[r#"
            ! Timed out waiting for subscribers: expected 1 on /nobody, found 0
        "#]],
    );
    bench.check(
        |session| {
            topic::publish(session, "/cmd_vel", "geometry_msgs/msg/Twist", "{x: 1}", &options)
        },
        expect![[r#"
            ! the values do not match geometry_msgs/msg/Twist: there is no field `x`
        "#]],
    );
    bench.check(
        |session| topic::publish(session, "/cmd_vel", "geometry_msgs/msg/Twist", "0.5", &options),
        expect![[r#"
            ! the values are a number; expected names and values, such as `{linear: {x: 0.5}}`; a colon needs a space after it
        "#]],
    );
    let json = bench.json();
    json.check(
        |session| topic::publish(session, "/cmd_vel", "geometry_msgs/Twist", "", &Publish { print: 1, ..options.clone() }),
        expect![[r#"
            {"count":1,"message":{"angular":{"x":0.0,"y":0.0,"z":0.0},"linear":{"x":0.0,"y":0.0,"z":0.0}}}
        "#]],
    );
}
