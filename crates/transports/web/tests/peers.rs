//! Interoperability with npm's client of the protocol, and comparison with the server of PyPI's
//! `foxglove-sdk`. Missing peers are skipped with a message.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::collections::BTreeSet;
use std::io::{BufRead as _, BufReader, Lines};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_msgs::Message as _;
use periplus_msgs::std_msgs::String as Words;
use periplus_msgs::std_srvs::{SetBool, SetBoolResponse};
use periplus_web::foxglove::Hub;
use periplus_web::foxglove::Settings;
use periplus_web::server::{WebServer, WebServerSettings};
use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest as _;
use tungstenite::{Message, WebSocket};

const LONG: Duration = Duration::from_secs(30);

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peers")
}

/// Node packages with the client.
fn node_modules() -> Option<PathBuf> {
    let given = std::env::var_os("PERIPLUS_NODE_MODULES").map(PathBuf::from);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let folders = ["target/peers/node_modules", "viewer/node_modules", "node_modules"];
    let places = folders.map(|folder| root.join(folder));
    let has = |folder: &PathBuf| {
        folder.join("@foxglove/ws-protocol").is_dir() && folder.join("ws").is_dir()
    };
    let found = given.into_iter().chain(places).find(has);
    let runs = Command::new("node").arg("--version").stdout(Stdio::null()).status();
    if found.is_none() || !runs.is_ok_and(|status| status.success()) {
        eprintln!(
            "SKIPPED: no client to test with; npm install --prefix target/peers @foxglove/ws-protocol@0.8 ws@8"
        );
        return None;
    }
    found
}

/// A Python with PyPI's `foxglove-sdk`.
fn python() -> Option<PathBuf> {
    let given = std::env::var_os("PERIPLUS_PYTHON").map(PathBuf::from);
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../.venv/bin/python");
    let has = |python: &PathBuf| {
        let mut asked = Command::new(python);
        asked.args(["-c", "import foxglove.websocket"]).stderr(Stdio::null());
        asked.status().is_ok_and(|status| status.success())
    };
    let found = given.into_iter().chain(["python3".into(), own]).find(has);
    if found.is_none() {
        eprintln!("SKIPPED: no server to compare with; pip install foxglove-sdk==0.30.3");
    }
    found
}

/// A program that runs until this is dropped, with its output.
struct Peer {
    child: Child,
    lines: Lines<BufReader<ChildStdout>>,
}

impl Peer {
    fn start(command: &mut Command) -> Self {
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        Self { child, lines }
    }

    fn line(&mut self) -> String {
        self.lines.next().expect("the peer ended").unwrap()
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A server with a topic, a service and a file.
struct Ours {
    graph: Graph,
    server: WebServer,
}

impl Ours {
    fn open() -> Self {
        let graph = Graph::live();
        graph.advance_to(1_000_000_007);
        let hub = Hub::open(&graph, Settings { name: "ours".into(), ..Settings::default() });
        let hub = hub.unwrap();
        hub.serve_assets(|uri| {
            if uri == "package://arm/hand.stl" { Ok(b"solid".to_vec()) } else { Err("no".into()) }
        });
        let settings = WebServerSettings { address: "127.0.0.1:0".parse().unwrap(), token: None };
        let server = WebServer::open(Arc::new(hub), settings).unwrap();
        Self { graph, server }
    }
}

#[test]
fn the_client_of_npm_hears_publishes_calls_and_asks() {
    let Some(modules) = node_modules() else { return };
    let ours = Ours::open();
    let node = ours.graph.node(NodeSettings::new("talker")).unwrap();
    let words = node.publisher::<Words>("/words", Qos::latched(1)).unwrap();
    words.publish(Words { data: "yes".into() });
    let answers = node.mailbox::<Words>("/answers", Qos::reliable(10)).unwrap();
    let calls = node.server::<SetBool>("/lamp").unwrap();
    std::thread::spawn(move || {
        for _ in 0..3000 {
            while let Some(call) = calls.take() {
                let message = call.request.data.to_string();
                call.answer(SetBoolResponse { success: true, message });
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    let url = format!("ws://{}/", ours.server.address());
    let mut command = Command::new("node");
    command.arg(here().join("client.cjs")).arg(url).env("NODE_PATH", modules);
    let mut peer = Peer::start(&mut command);
    let wanted = [
        "serverInfo",
        "channel",
        "message",
        "service",
        "answer",
        "failure",
        "parameters",
        "graph",
        "asset",
        "time",
    ];
    let mut open: BTreeSet<&str> = wanted.into();
    while !open.is_empty() {
        let said: Value = serde_json::from_str(&peer.line()).unwrap();
        let what = said["what"].as_str().unwrap().to_owned();
        assert!(what != "error" && what != "status", "{said}");
        if !open.remove(what.as_str()) {
            continue;
        }
        let yes = "0001000004000000796573";
        match what.as_str() {
            "serverInfo" => assert_eq!(said["info"]["name"], "ours"),
            "channel" => assert_eq!(said["channel"]["schemaName"], "std_msgs/msg/String"),
            "message" => {
                assert_eq!(
                    (&said["topic"], &said["timestamp"]),
                    (&json!("/words"), &json!("1000000007"))
                );
                assert!(said["data"].as_str().unwrap().starts_with(yes), "{said}");
            }
            "service" => assert_eq!(said["service"]["type"], "std_srvs/srv/SetBool"),
            "answer" => {
                let response = SetBoolResponse { success: true, message: "true".into() };
                let bytes = response.to_cdr().unwrap();
                let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
                assert_eq!((&said["callId"], &said["data"]), (&json!(7), &json!(hex)));
            }
            "failure" => assert_eq!(said["callId"], 8),
            "parameters" => assert_eq!(said["id"], "all"),
            "graph" => assert!(said["update"].to_string().contains("/talker"), "{said}"),
            "asset" => {
                assert_eq!((&said["requestId"], &said["data"]), (&json!(5), &json!("736f6c6964")));
            }
            _ => {}
        }
    }
    let told = (0..3000).any(|_| {
        std::thread::sleep(Duration::from_millis(10));
        answers.latest().is_some_and(|answer| answer.data == "yes")
    });
    assert!(told, "what the client published did not arrive");
}

fn connect(port: u16) -> WebSocket<TcpStream> {
    let mut request = format!("ws://127.0.0.1:{port}/").into_client_request().unwrap();
    let name = "foxglove.sdk.v1".parse().unwrap();
    request.headers_mut().insert("Sec-WebSocket-Protocol", name);
    let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    stream.set_read_timeout(Some(LONG)).unwrap();
    tungstenite::client(request, stream).unwrap().0
}

/// Output of a server for `/words` and `/lamp`: server info, channel, service, message.
fn hear(port: u16) -> [Value; 4] {
    let mut socket = connect(port);
    let mut heard = [Value::Null, Value::Null, Value::Null, Value::Null];
    while heard.contains(&Value::Null) {
        match socket.read().unwrap() {
            Message::Text(text) => {
                let said: Value = serde_json::from_str(&text).unwrap();
                let find = |list: &str, key: &str, name: &str| {
                    let all = said[list].as_array().cloned().unwrap_or_default();
                    all.into_iter().find(|one| one[key] == name)
                };
                match said["op"].as_str().unwrap() {
                    "serverInfo" => heard[0] = said,
                    "advertise" => {
                        let Some(channel) = find("channels", "topic", "/words") else { continue };
                        let one = json!({"id": 77, "channelId": channel["id"]});
                        let wish = json!({"op": "subscribe", "subscriptions": [one]});
                        socket.send(Message::text(wish.to_string())).unwrap();
                        heard[1] = channel;
                    }
                    "advertiseServices" => {
                        heard[2] = find("services", "name", "/lamp").unwrap_or(Value::Null);
                    }
                    _ => {}
                }
            }
            Message::Binary(bytes) if bytes[0] == 1 => heard[3] = json!(bytes.to_vec()),
            _ => {}
        }
    }
    heard
}

/// Names in an object and the types of their values, recursively.
fn shape(value: &Value) -> Value {
    match value {
        Value::Object(object) => {
            object.iter().map(|(name, value)| (name.clone(), shape(value))).collect()
        }
        Value::Array(list) => list.first().map_or(json!([]), |first| json!([shape(first)])),
        Value::String(_) => json!("text"),
        Value::Number(_) => json!("number"),
        other => other.clone(),
    }
}

#[test]
fn the_sdk_says_the_same_of_the_same() {
    let Some(python) = python() else { return };
    let mut peer = Peer::start(Command::new(python).arg(here().join("server.py")));
    let port = peer.line().trim().parse().unwrap();
    let ours = Ours::open();
    let node = ours.graph.node(NodeSettings::new("talker")).unwrap();
    let words = node.publisher::<Words>("/words", Qos::latched(1)).unwrap();
    words.publish(Words { data: "yes".into() });
    let _lamp = node.server::<SetBool>("/lamp").unwrap();
    let theirs = hear(port);
    let own = hear(ours.server.address().port());

    for (one, other) in own.iter().zip(&theirs).take(3) {
        let (Value::Object(one), Value::Object(other)) = (shape(one), shape(other)) else {
            panic!("objects")
        };
        for (name, kind) in &other {
            // The content is specific to each server.
            if name != "metadata" && !kind.is_null() {
                assert_eq!(one.get(name), Some(kind), "{name}");
            }
        }
    }
    assert_eq!(own[1]["schemaName"], theirs[1]["schemaName"]);
    assert_eq!(own[1]["schemaEncoding"], theirs[1]["schemaEncoding"]);
    // Opcode, subscription, time and the message itself, byte for byte.
    assert_eq!(own[3], theirs[3]);
}
