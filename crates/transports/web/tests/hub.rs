//! Clients of a hub, without sockets.

use std::time::Duration;

use periplus_graph::{Durability, Graph, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::Message;
use periplus_msgs::geometry_msgs::{TransformStamped, Twist};
use periplus_msgs::map_msgs::OccupancyGridUpdate;
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs;
use periplus_msgs::std_srvs::{SetBool, SetBoolRequest, SetBoolResponse};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_web::foxglove::{
    ClientLimits, ClientSession, FrameKind, Hub, NetworkEndpoint, NetworkEndpoints, NetworkTopic,
    OutboxItem, Settings, WebSocketFrame,
};
use serde_json::{Value, json};

/// Generous timeout for messages that must arrive.
const SOON: Duration = Duration::from_secs(10);

/// Timeout for messages that must not arrive.
const NOW: Duration = Duration::ZERO;

fn open(graph: &Graph) -> Hub {
    Hub::open(graph, Settings { name: "test".into(), ..Settings::default() }).expect("a name")
}

fn node(graph: &Graph, name: &str) -> Node {
    graph.node(NodeSettings::new(name)).expect("a name")
}

/// A client that reads its messages.
struct Client(ClientSession);

impl Client {
    fn join(hub: &Hub) -> Self {
        Self(hub.join().expect("room"))
    }

    fn say(&mut self, text: &Value) {
        self.0.text(&text.to_string());
    }

    fn next(&self, patience: Duration) -> Option<WebSocketFrame> {
        match self.0.outbox().take(patience) {
            OutboxItem::Frame(frame) => Some(frame),
            OutboxItem::Nothing | OutboxItem::End(_) => None,
        }
    }

    /// The next JSON message with this opcode; others are skipped.
    #[track_caller]
    fn hears(&self, op: &str) -> Value {
        loop {
            let frame = self.next(SOON).unwrap_or_else(|| panic!("no `{op}` came"));
            if frame.kind() == FrameKind::Text {
                let said: Value = serde_json::from_slice(frame.parts()[0]).expect("JSON");
                if said["op"] == op {
                    return said;
                }
            }
        }
    }

    /// The next binary message with this prefix.
    #[track_caller]
    fn gets(&self, op: u8) -> Vec<u8> {
        loop {
            let frame = self.next(SOON).expect("bytes");
            let bytes = frame.parts().concat();
            if frame.kind() == FrameKind::Binary && bytes[0] == op {
                return bytes;
            }
        }
    }

    /// The next message of a subscription.
    #[track_caller]
    fn message<T: Message>(&self) -> (u32, T) {
        let bytes = self.gets(1);
        let id = u32::from_le_bytes([bytes[1], bytes[2], bytes[3], bytes[4]]);
        (id, T::decode_cdr(&bytes[13..]).expect("a message"))
    }

    /// All messages that have arrived.
    fn drain(&self) -> Vec<WebSocketFrame> {
        std::iter::from_fn(|| self.next(NOW)).collect()
    }

    /// Subscribes to a topic as soon as it is announced.
    #[track_caller]
    fn subscribe(&mut self, id: u32, announced: &Value, topic: &str) {
        let channels = announced["channels"].as_array().expect("channels");
        let channel = channels.iter().find(|channel| channel["topic"] == topic).expect("the topic");
        let one = json!({"id": id, "channelId": channel["id"]});
        self.say(&json!({"op": "subscribe", "subscriptions": [one]}));
    }
}

fn transform(child: &str, second: i64) -> TFMessage {
    let header = std_msgs::Header::at(second * 1_000_000_000, "odom");
    let one = TransformStamped { header, child_frame_id: child.into(), ..Default::default() };
    TFMessage { transforms: vec![one] }
}

#[test]
fn who_comes_while_time_stands_still_gets_the_newest_transforms() {
    let graph = Graph::new();
    let (wheels, arm) = (node(&graph, "wheels"), node(&graph, "arm"));
    let wheels: Publisher<TFMessage> = wheels.publisher("/tf", Qos::reliable(10)).expect("a topic");
    let arm: Publisher<TFMessage> = arm.publisher("/tf", Qos::reliable(10)).expect("a topic");
    let hub = open(&graph);
    for second in 1..=3 {
        wheels.publish(transform("base_link", second));
    }
    arm.publish(transform("hand", 2));
    // No subscriber was present, and nothing more is published.
    let mut client = Client::join(&hub);
    let told = client.hears("advertise");
    client.subscribe(5, &told, "/tf");
    let mut newest = Vec::new();
    for _ in 0..2 {
        let (id, message) = client.message::<TFMessage>();
        assert_eq!(id, 5);
        let one = message.transforms.last().expect("a transform");
        newest.push((one.child_frame_id.clone(), one.header.stamp.sec));
    }
    newest.sort();
    assert_eq!(newest, [("base_link".to_owned(), 3), ("hand".to_owned(), 2)]);
}

fn scan(number: f32) -> LaserScan {
    LaserScan { range_max: number, ..LaserScan::default() }
}

#[test]
fn who_comes_is_told_who_is_here_and_what_there_is() {
    let graph = Graph::new();
    let _scans: Publisher<LaserScan> =
        node(&graph, "lidar").publisher("/scan", Qos::sensor_data()).expect("a topic");
    let hub = open(&graph);
    let client = Client::join(&hub);
    let info = client.hears("serverInfo");
    assert_eq!((&info["name"], &info["supportedEncodings"]), (&json!("test"), &json!(["cdr"])));
    let told = client.hears("advertise");
    let channels = told["channels"].as_array().expect("channels");
    let scan = channels.iter().find(|channel| channel["topic"] == "/scan").expect("the scan");
    assert_eq!(scan["schemaName"], "sensor_msgs/msg/LaserScan");
    assert_eq!((&scan["encoding"], &scan["schemaEncoding"]), (&json!("cdr"), &json!("ros2msg")));
    assert!(scan["schema"].as_str().expect("a text").contains("MSG: std_msgs/Header"));
}

#[test]
fn nobody_is_heard_before_a_client_subscribes_nor_after() {
    let graph = Graph::new();
    let scans: Publisher<LaserScan> =
        node(&graph, "lidar").publisher("/scan", Qos::sensor_data()).expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let told = client.hears("advertise");
    assert!(!scans.is_heard());
    client.subscribe(7, &told, "/scan");
    assert!(scans.is_heard());
    scans.publish(scan(1.0));
    let (id, heard) = client.message::<LaserScan>();
    assert_eq!((id, heard), (7, scan(1.0)));
    client.say(&json!({"op": "unsubscribe", "subscriptionIds": [7]}));
    assert!(!scans.is_heard());
    client.subscribe(8, &told, "/scan");
    assert!(scans.is_heard());
    drop(client);
    assert!(!scans.is_heard());
}

#[test]
fn the_newest_scan_waits_and_every_map() {
    let graph = Graph::new();
    let lidar = node(&graph, "lidar");
    let scans = lidar.publisher("/scan", Qos::sensor_data()).expect("a topic");
    let words = lidar.publisher("/words", Qos::latched(2)).expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let told = client.hears("advertise");
    client.subscribe(1, &told, "/scan");
    client.subscribe(2, &told, "/words");
    for number in 1..=5_u8 {
        scans.publish(scan(f32::from(number)));
        words.publish(std_msgs::String { data: number.to_string() });
    }
    let (_, heard) = client.message::<LaserScan>();
    assert_eq!(heard.range_max, 5.0);
    let both = [0; 2].map(|_| client.message::<std_msgs::String>().1.data);
    assert_eq!(both, ["4", "5"]);
}

#[test]
fn what_is_latched_comes_to_who_is_late_and_once() {
    let graph = Graph::new();
    let words = node(&graph, "talker").publisher("/words", Qos::latched(1)).expect("a topic");
    words.publish(std_msgs::String { data: "one".into() });
    let hub = open(&graph);
    let mut clients: Vec<Client> = (0..3).map(|_| Client::join(&hub)).collect();
    for client in &mut clients {
        let told = client.hears("advertise");
        client.subscribe(1, &told, "/words");
        assert_eq!(client.message::<std_msgs::String>().1.data, "one");
        let more = client.drain();
        assert!(more.iter().all(|frame| frame.parts()[0].first() != Some(&1)), "{more:?}");
    }
}

#[test]
fn topics_that_come_and_go_are_told() {
    let graph = Graph::new();
    let hub = open(&graph);
    let client = Client::join(&hub);
    client.hears("advertise");
    let talker = node(&graph, "talker");
    let words: Publisher<std_msgs::String> =
        talker.publisher("/words", Qos::reliable(1)).expect("a topic");
    // The node has topics, too; which of them arrive together depends on timing.
    let id = loop {
        let told = client.hears("advertise");
        let channels = told["channels"].as_array().expect("channels");
        if let Some(words) = channels.iter().find(|channel| channel["topic"] == "/words") {
            break words["id"].clone();
        }
    };
    drop(words);
    let gone = client.hears("unadvertise");
    assert_eq!(gone["channelIds"], json!([id]));
}

#[test]
fn clients_publish_and_are_told_what_they_may_not() {
    let graph = Graph::new();
    let wheels = node(&graph, "wheels").mailbox::<Twist>("/cmd_vel", Qos::reliable(1));
    let wheels = wheels.expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let channel = |id: u32, encoding: &str, schema: &str| {
        let one =
            json!({"id": id, "topic": "/cmd_vel", "encoding": encoding, "schemaName": schema});
        json!({"op": "advertise", "channels": [one]})
    };
    client.say(&channel(3, "cdr", "geometry_msgs/Twist"));
    let mut twist = Twist::default();
    twist.linear.x = 0.5;
    let mut bytes = vec![1, 3, 0, 0, 0];
    bytes.extend(twist.to_cdr().expect("bytes"));
    client.0.binary(&bytes);
    assert_eq!(wheels.latest().as_deref(), Some(&twist));

    client.say(&channel(4, "json", "geometry_msgs/Twist"));
    assert!(client.hears("status")["message"].as_str().expect("words").contains("only cdr"));
    client.say(&channel(3, "cdr", "geometry_msgs/Twist"));
    assert!(client.hears("status")["message"].as_str().expect("words").contains("in use"));
    client.say(&channel(5, "cdr", "std_msgs/String"));
    assert!(client.hears("status")["message"].as_str().expect("words").contains("std_msgs"));
    client.0.binary(&[1, 9, 0, 0, 0]);
    assert!(client.hears("status")["message"].as_str().expect("words").contains("channel 9"));
    client.0.binary(&[77]);
    client.hears("status");
    client.0.text("{");
    client.hears("status");
}

#[test]
fn services_are_called() {
    let graph = Graph::new();
    let calls = node(&graph, "lamp").server::<SetBool>("/lamp").expect("a service");
    let hub = open(&graph);
    let client = Client::join(&hub);
    let told = client.hears("advertiseServices");
    let services = told["services"].as_array().expect("services");
    let lamp = services.iter().find(|service| service["name"] == "/lamp").expect("the lamp");
    assert_eq!(lamp["type"], "std_srvs/srv/SetBool");
    assert_eq!(lamp["request"]["schemaName"], "std_srvs/srv/SetBool_Request");
    assert!(lamp["request"]["schema"].as_str().expect("a text").contains("bool data"));
    let id = u32::try_from(lamp["id"].as_u64().expect("a number")).expect("a small one");
    let ask = |client: &mut Client, service: u32| {
        let mut bytes = vec![2];
        bytes.extend(service.to_le_bytes());
        bytes.extend(5_u32.to_le_bytes());
        bytes.extend(3_u32.to_le_bytes());
        bytes.extend(b"cdr");
        bytes.extend(SetBoolRequest { data: true }.to_cdr().expect("bytes"));
        client.0.binary(&bytes);
    };
    let mut client = client;
    ask(&mut client, id);
    let call = calls.take().expect("a call");
    assert!(call.request.data);
    let response = SetBoolResponse { success: true, message: "on".into() };
    call.answer(response.clone());
    let bytes = client.gets(3);
    assert_eq!(bytes[1..5], id.to_le_bytes());
    assert_eq!(bytes[5..9], 5_u32.to_le_bytes());
    assert_eq!(&bytes[9..16], b"\x03\0\0\0cdr");
    assert_eq!(SetBoolResponse::decode_cdr(&bytes[16..]), Ok(response));
    ask(&mut client, 999);
    assert_eq!(client.hears("serviceCallFailure")["callId"], 5);
}

#[test]
fn of_a_map_only_what_is_new_comes_to_who_hears_its_updates() {
    let graph = Graph::new();
    let maps = node(&graph, "mapper").publisher("/map", Qos::latched(1)).expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let told = client.hears("advertise");
    let mut map = OccupancyGrid { data: vec![-1; 12], ..OccupancyGrid::default() };
    (map.info.width, map.info.height) = (4, 3);
    maps.publish(map.clone());
    client.subscribe(1, &told, "/map");
    client.subscribe(2, &told, "/map_updates");
    assert_eq!(client.message::<OccupancyGrid>(), (1, map.clone()));
    map.data[5] = 100;
    maps.publish(map.clone());
    let (id, part) = client.message::<OccupancyGridUpdate>();
    assert_eq!((id, part.x, part.y, part.width, part.height), (2, 1, 1, 1, 1));
    assert_eq!(part.data, [100]);
    // The next update includes the changes of dropped ones.
    map.data[0] = 0;
    maps.publish(map.clone());
    map.data[4] = 0;
    maps.publish(map.clone());
    let (_, part) = client.message::<OccupancyGridUpdate>();
    assert_eq!((part.x, part.y, part.width, part.height), (0, 0, 1, 2));
    map.info.origin.position.x = 1.0;
    maps.publish(map.clone());
    assert_eq!(client.message::<OccupancyGrid>(), (1, map));
}

#[test]
fn parameters_are_told_set_and_followed() {
    let graph = Graph::new();
    let _camera = node(&graph, "camera");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    client.hears("advertiseServices");
    let name = "/camera.use_sim_time";
    client.say(&json!({"op": "getParameters", "parameterNames": [], "id": "all"}));
    let settle = |client: &Client, op: &str| -> Value {
        for _ in 0..500 {
            graph.settle();
            for frame in client.drain() {
                if frame.kind() == FrameKind::Text {
                    let said: Value = serde_json::from_slice(frame.parts()[0]).expect("JSON");
                    if said["op"] == op {
                        return said;
                    }
                }
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        panic!("no `{op}` came");
    };
    let told = settle(&client, "parameterValues");
    assert_eq!(told["id"], "all");
    let parameters = told["parameters"].as_array().expect("parameters");
    assert!(parameters.contains(&json!({"name": name, "value": true})), "{parameters:?}");

    let one = json!({"name": name, "value": 3});
    client.say(&json!({"op": "setParameters", "parameters": [one], "id": "wrong"}));
    let words = settle(&client, "status")["message"].as_str().expect("words").to_owned();
    assert!(words.contains("another type"), "{words}");
    client.say(&json!({"op": "getParameters", "parameterNames": ["/nobody.x", "y"], "id": "none"}));
    let told = loop {
        let told = settle(&client, "parameterValues");
        if told["id"] == "none" {
            break told;
        }
    };
    assert_eq!(told["parameters"], json!([]));
}

#[test]
fn who_wants_to_know_is_told_who_uses_what() {
    let graph = Graph::new();
    let lidar = node(&graph, "lidar");
    let _scans: Publisher<LaserScan> =
        lidar.publisher("/scan", Qos::sensor_data()).expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    client.say(&json!({"op": "subscribeConnectionGraph"}));
    let told = client.hears("connectionGraphUpdate");
    let published = told["publishedTopics"].as_array().expect("topics");
    assert!(published.contains(&json!({"name": "/scan", "publisherIds": ["/lidar"]})));
    let _heard = node(&graph, "mapper").mailbox::<LaserScan>("/scan", Qos::sensor_data());
    let told = loop {
        let told = client.hears("connectionGraphUpdate");
        if told["subscribedTopics"].to_string().contains("/scan") {
            break told;
        }
    };
    assert!(told["subscribedTopics"].to_string().contains("/mapper"), "{told}");
}

#[test]
fn too_many_clients_and_too_much_that_waits_are_refused() {
    let graph = Graph::new();
    let limits =
        ClientLimits { clients: 1, entries: 2, waiting: 60_000, ..ClientLimits::default() };
    let hub = Hub::open(&graph, Settings { limits, ..Settings::default() }).expect("a name");
    let mut client = Client::join(&hub);
    assert!(hub.join().is_none());
    client.drain();
    let channels: Vec<Value> = (0..3)
        .map(|id| json!({"id": id, "topic": format!("/t{id}"), "encoding": "cdr", "schemaName": "std_msgs/String"}))
        .collect();
    client.say(&json!({"op": "advertise", "channels": channels}));
    assert!(client.hears("status")["message"].as_str().expect("words").contains("too many"));
    // A client that sends requests and never reads.
    for _ in 0..10_000 {
        client.0.text("{");
    }
    assert!(matches!(client.0.outbox().take(NOW), OutboxItem::End(why) if why.contains("is full")));
    drop(client);
    assert!(hub.join().is_some());
}

#[test]
fn files_come_from_whoever_gives_them() {
    let graph = Graph::new();
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let ask = json!({"op": "fetchAsset", "uri": "package://a/b.stl", "requestId": 9});
    client.say(&ask);
    let bytes = client.gets(4);
    assert_eq!((&bytes[1..5], bytes[5]), (&9_u32.to_le_bytes()[..], 1));
    hub.serve_assets(|uri| {
        if uri == "package://a/b.stl" { Ok(b"solid".to_vec()) } else { Err("no".into()) }
    });
    client.say(&ask);
    let bytes = client.gets(4);
    assert_eq!((bytes[5], &bytes[6..10], &bytes[10..]), (0, &[0; 4][..], &b"solid"[..]));
}

#[test]
fn triangles_of_a_mesh_come_beside_the_plain_file() {
    let graph = Graph::new();
    let hub = open(&graph);
    hub.serve_assets(|uri| match uri {
        "package://a/b.obj" => Ok(b"mtllib b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
        "package://a/bad.obj" => Ok(b"v 0 0 0\nf 1 2 3\n".to_vec()),
        _ => Err("not there".into()),
    });
    let mut client = Client::join(&hub);
    assert!(client.hears("serverInfo")["capabilities"].to_string().contains("\"meshes\""));
    let mut ask = |uri: &str| {
        client.say(&json!({"op": "fetchMesh", "uri": uri, "requestId": 9}));
        let bytes = client.gets(4);
        assert_eq!(&bytes[1..5], &9_u32.to_le_bytes());
        (bytes[5], bytes[10..].to_vec())
    };
    let (status, triangles) = ask("package://a/b.obj#submesh=x");
    assert_eq!((status, &triangles[..8]), (0, &b"PMSH\x01\0\0\0"[..]));
    let (status, why) = ask("package://a/bad.obj");
    let why = String::from_utf8(why).expect("words");
    assert!(status == 1 && why.contains("package://a/bad.obj") && why.contains("line 2"), "{why}");
    assert_eq!(ask("package://a/gone.obj"), (1, b"not there".to_vec()));
}

#[test]
fn a_hub_that_goes_sends_its_clients_away() {
    let graph = Graph::new();
    let hub = open(&graph);
    let client = Client::join(&hub);
    client.drain();
    drop(hub);
    assert!(matches!(client.0.outbox().take(SOON), OutboxItem::End(why) if why.contains("over")));
    drop(client);
    assert!(graph.node(NodeSettings::new("viewers")).is_ok(), "its node went too");
}

#[test]
fn ends_that_do_not_fit_are_told_and_made_to() {
    let graph = Graph::new();
    let (lidar, planner) = (node(&graph, "lidar"), node(&graph, "planner"));
    let scans: Publisher<LaserScan> =
        lidar.publisher("/scan", Qos::sensor_data()).expect("a topic");
    let heard = planner.mailbox::<LaserScan>("/scan", Qos::reliable(1)).expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    client.say(&json!({"op": "subscribeConnectionGraph"}));
    let told = client.hears("connectionGraphUpdate");
    let expected = json!([{
        "topic": "/scan",
        "publisher": {"node": "/lidar", "isOurs": true},
        "subscription": {"node": "/planner", "isOurs": true},
        "policies": [{"policy": "reliability", "offered": "best_effort", "asked": "reliable"}],
        "repair": "publisher",
        "advice": "make `/lidar` offer reliability reliable",
    }]);
    assert_eq!(told["mismatches"], expected);
    let wish = json!({
        "op": "repairQos", "id": 3, "topic": "/scan", "publisher": "/lidar", "subscription": "/planner",
    });
    client.say(&wish);
    assert_eq!(client.hears("connectionGraphUpdate")["mismatches"], json!([]));
    let done = client.hears("repairQosResult");
    let message = "`/lidar` now offers reliability reliable";
    assert_eq!(
        done,
        json!({"op": "repairQosResult", "id": 3, "isRepaired": true, "message": message})
    );
    scans.publish(scan(4.0));
    assert_eq!(heard.latest().map(|heard| heard.range_max), Some(4.0));
    // A second repair finds nothing to do.
    client.say(&wish);
    let done = client.hears("repairQosResult");
    assert_eq!(done["isRepaired"], false);
    assert!(
        done["message"].as_str().expect("words").contains("are compatible on `/scan`"),
        "{done}"
    );
}

#[test]
fn who_asks_for_times_gives_way() {
    let graph = Graph::new();
    let _scans: Publisher<LaserScan> =
        node(&graph, "lidar").publisher("/scan", Qos::sensor_data()).expect("a topic");
    let strict = Qos::latched(1).with_deadline_ns(1_000_000);
    let _heard = node(&graph, "planner").mailbox::<LaserScan>("/scan", strict).expect("a topic");
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    client.say(&json!({"op": "subscribeConnectionGraph"}));
    let told = client.hears("connectionGraphUpdate");
    assert_eq!(told["mismatches"][0]["repair"], "subscription");
    client.say(&json!({
        "op": "repairQos", "id": 0, "topic": "/scan", "publisher": "/lidar", "subscription": "/planner",
    }));
    let done = client.hears("repairQosResult");
    assert_eq!(
        done["message"],
        "`/planner` now requests reliability best_effort and durability volatile and deadline infinite"
    );
    assert!(graph.topics().iter().all(|topic| topic.mismatches.is_empty()));
}

/// A remote topic with one endpoint on each side.
fn far(name: &str, publisher: Option<Qos>, subscription: Option<Qos>) -> NetworkEndpoints {
    let end = |node: &str, qos| NetworkEndpoint { node: node.to_owned(), qos };
    let topic = NetworkTopic {
        name: name.to_owned(),
        type_name: "sensor_msgs/msg/LaserScan".to_owned(),
        type_hash: None,
        publishers: publisher.map(|qos| end("/talker", qos)).into_iter().collect(),
        subscriptions: subscription.map(|qos| end("/listener", qos)).into_iter().collect(),
    };
    NetworkEndpoints { topics: vec![topic], services: Vec::new() }
}

#[test]
fn of_others_it_is_said_what_to_change_there() {
    let graph = Graph::new();
    let hub = open(&graph);
    hub.set_network_endpoints(far("/scan", Some(Qos::sensor_data()), Some(Qos::reliable(1))));
    let mut client = Client::join(&hub);
    client.say(&json!({"op": "subscribeConnectionGraph"}));
    let told = client.hears("connectionGraphUpdate");
    let one = &told["mismatches"][0];
    assert_eq!((&one["repair"], &one["publisher"]["isOurs"]), (&json!(null), &json!(false)));
    let advice = "in `/listener`, request reliability best_effort; or in `/talker`, offer reliability \
                  reliable";
    assert_eq!(one["advice"], advice);
    client.say(&json!({
        "op": "repairQos", "id": 0, "topic": "/scan", "publisher": "/talker", "subscription": "/listener",
    }));
    let done = client.hears("repairQosResult");
    assert_eq!(done["isRepaired"], false);
    assert!(done["message"].as_str().expect("words").contains(advice), "{done}");
}

#[test]
fn what_a_client_publishes_is_made_to_fit_who_listens_elsewhere() {
    let graph = Graph::new();
    let hub = open(&graph);
    hub.set_network_endpoints(far("/scan", None, Some(Qos::latched(1))));
    let mut client = Client::join(&hub);
    client.say(&json!({"op": "subscribeConnectionGraph"}));
    client.hears("connectionGraphUpdate");
    let channel = json!({"id": 1, "topic": "/scan", "encoding": "cdr", "schemaName": "sensor_msgs/LaserScan"});
    client.say(&json!({"op": "advertise", "channels": [channel]}));
    let told = client.hears("connectionGraphUpdate");
    let one = &told["mismatches"][0];
    assert_eq!(
        (&one["publisher"]["node"], &one["repair"]),
        (&json!("/viewers"), &json!("publisher"))
    );
    client.say(&json!({
        "op": "repairQos", "id": 9, "topic": "/scan", "publisher": "/viewers", "subscription": "/listener",
    }));
    let done = client.hears("repairQosResult");
    let message = "`/viewers` now offers durability transient_local; earlier messages were not \
                   retained";
    assert_eq!((&done["id"], &done["message"]), (&json!(9), &json!(message)));
    let offered = graph.topics()[0].publishers[0].qos;
    assert!(offered.incompatible_policies(&Qos::latched(1)).is_empty());
}

#[test]
fn what_a_client_hears_of_others_follows_what_they_offer() {
    let graph = Graph::new();
    let hub = open(&graph);
    hub.set_network_endpoints(far("/scan", Some(Qos::latched(1)), None));
    let mut client = Client::join(&hub);
    let told = client.hears("advertise");
    client.subscribe(1, &told, "/scan");
    let asked = || graph.topics()[0].subscriptions[0].qos;
    assert_eq!(asked().durability, Durability::TransientLocal);
    hub.set_network_endpoints(far("/scan", Some(Qos::sensor_data()), None));
    assert!(Qos::sensor_data().incompatible_policies(&asked()).is_empty());
}

#[test]
fn definitions_of_types_come_from_the_program() {
    let graph = Graph::new();
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let mut ask = |name: &str| {
        client.say(&json!({"op": "fetchSchema", "requestId": 3, "schemaName": name}));
        client.hears("schema")
    };
    let twist = ask("geometry_msgs/Twist");
    assert!(twist["schema"].as_str().expect("a text").contains("linear"), "{twist}");
    assert_eq!(ask("x/msg/Nothing")["schema"], Value::Null);
    let names = ask("")["names"].as_array().expect("names").clone();
    assert!(names.contains(&json!("std_msgs/msg/String")), "{} names", names.len());
}

#[test]
fn a_topic_of_a_client_can_be_latched() {
    let graph = Graph::new();
    let hub = open(&graph);
    let mut client = Client::join(&hub);
    let text = periplus_msgs::std_msgs::String { data: "kept".into() };
    for (id, topic, is_latched) in [(1_u32, "/kept", true), (2, "/gone", false)] {
        client.say(
            &json!({"op": "advertise", "channels": [{"id": id, "topic": topic, "encoding": "cdr",
            "schemaName": "std_msgs/msg/String", "isLatched": is_latched}]}),
        );
        let mut message = vec![1];
        message.extend(id.to_le_bytes());
        message.extend(text.to_cdr().expect("CDR"));
        client.0.binary(&message);
    }
    graph.settle();
    let node = graph.node(NodeSettings::new("late")).expect("a node");
    let mailboxes = ["/kept", "/gone"].map(|topic| {
        let qos = if topic == "/kept" { Qos::latched(1) } else { Qos::reliable(1) };
        node.mailbox::<periplus_msgs::std_msgs::String>(topic, qos).expect("a mailbox")
    });
    graph.settle();
    let counts = mailboxes.map(|mailbox| mailbox.drain().len());
    assert_eq!(counts, [1, 0]);
}
