//! Admission and protection against malicious clients.
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests of sockets wait by the wall's clock")]

use std::io::{Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

use periplus_graph::{Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::std_msgs::{String as Words, UInt8MultiArray};
use periplus_web::foxglove::Hub;
use periplus_web::foxglove::{ClientLimits, Settings};
use periplus_web::server::{WebServer, WebServerSettings};
use tungstenite::client::IntoClientRequest as _;
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Error, Message, WebSocket};

const TOKEN: &str = "a secret of 25 characters";
const TOKEN_IN_ADDRESS: &str = "a%20secret%20of%2025%20characters";
const LONG: Duration = Duration::from_secs(20);

struct ServerFixture {
    graph: Graph,
    server: WebServer,
    hub: Arc<Hub>,
}

impl ServerFixture {
    fn open(token: Option<&str>, limits: ClientLimits) -> Self {
        let graph = Graph::live();
        let settings = Settings { name: "test".into(), limits, ..Settings::default() };
        let hub = Arc::new(Hub::open(&graph, settings).unwrap());
        let settings = WebServerSettings {
            address: "127.0.0.1:0".parse().unwrap(),
            token: token.map(Into::into),
        };
        let server = WebServer::open(hub.clone(), settings).unwrap();
        Self { graph, server, hub }
    }

    fn new() -> Self {
        Self::open(Some(TOKEN), ClientLimits::default())
    }

    fn address(&self) -> SocketAddr {
        self.server.address()
    }

    /// Sends bytes and reads until the peer closes the connection.
    fn send(&self, bytes: &[u8]) -> String {
        let mut stream = TcpStream::connect(self.address()).unwrap();
        stream.set_read_timeout(Some(LONG)).unwrap();
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// Requests a WebSocket; returns the status code.
    fn ask(&self, path: &str, origin: Option<&str>) -> u16 {
        match self.connect(path, origin) {
            Ok(_) => 101,
            Err(Error::Http(answer)) => answer.status().as_u16(),
            Err(other) => panic!("{other}"),
        }
    }

    fn connect(
        &self,
        path: &str,
        origin: Option<&str>,
    ) -> Result<WebSocket<MaybeTlsStream<TcpStream>>, Error> {
        let mut request = format!("ws://{}{path}", self.address()).into_client_request()?;
        let headers = request.headers_mut();
        headers.insert("Sec-WebSocket-Protocol", "foxglove.websocket.v1".parse().unwrap());
        if let Some(origin) = origin {
            headers.insert("Origin", origin.parse().unwrap());
        }
        let stream = TcpStream::connect(self.address()).unwrap();
        stream.set_read_timeout(Some(LONG)).unwrap();
        let stream = MaybeTlsStream::Plain(stream);
        let made = tungstenite::client(request, stream).map_err(|error| match error {
            tungstenite::HandshakeError::Failure(error) => error,
            tungstenite::HandshakeError::Interrupted(_) => panic!("it takes too long"),
        });
        made.map(|(socket, _)| socket)
    }

    /// Checks that other clients are still served.
    fn is_well(&self) {
        let mut socket = self.connect("/", None).unwrap();
        let hello = socket.read().unwrap();
        assert!(hello.to_text().unwrap().contains("serverInfo"));
    }
}

/// Channel of a topic, once it is announced.
fn channel_of(socket: &mut WebSocket<MaybeTlsStream<TcpStream>>, topic: &str) -> serde_json::Value {
    loop {
        let message = socket.read().unwrap();
        let text: serde_json::Value =
            serde_json::from_str(message.to_text().unwrap_or("{}")).unwrap_or_default();
        let channels = text["channels"].as_array().cloned().unwrap_or_default();
        if let Some(found) = channels.iter().find(|one| one["topic"] == topic) {
            return found["id"].clone();
        }
    }
}

/// Waits until a condition holds.
#[track_caller]
fn eventually(what: &str, mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < LONG, "{what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn foreign_origins_and_wrong_tokens_are_refused() {
    let fixture = ServerFixture::new();
    assert_eq!(fixture.ask("/", None), 101);
    assert_eq!(fixture.ask("/any/path", Some("http://localhost:5173")), 101);
    assert_eq!(fixture.ask("/", Some("https://example.org")), 403);
    assert_eq!(fixture.ask("/", Some("null")), 403);
    assert_eq!(fixture.ask("/?token=wrong", None), 403);
    let right = format!("/?token={TOKEN_IN_ADDRESS}");
    assert_eq!(fixture.ask(&right, Some("https://example.org")), 101);
    for lax in
        ["http://[::1].evil.example", "http://localhost:80@evil.example", "http://localhost/"]
    {
        assert_eq!(fixture.ask("/", Some(lax)), 403, "{lax}");
    }
}

#[test]
fn hosts_are_read_strictly() {
    let fixture = ServerFixture::new();
    let ask = |hosts: &str| {
        let text = format!(
            "GET / HTTP/1.1\r\n{hosts}Connection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\
             Sec-WebSocket-Protocol: chat\r\n\r\n"
        );
        fixture.send(text.as_bytes())[9..12].to_owned()
    };
    // An admitted client gets an error for an unknown subprotocol.
    assert_eq!(ask("Host: localhost:8765\r\n"), "400");
    assert_eq!(ask("Host: [::1].evil.example\r\n"), "403");
    assert_eq!(ask("Host: [::1]evil\r\n"), "403");
    assert_eq!(ask("Host: localhost\r\nHost: evil.example\r\n"), "403");
}

#[test]
fn a_host_in_the_target_counts() {
    let fixture = ServerFixture::new();
    let ask = |target: &str| {
        let text = format!(
            "GET {target} HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\
             Sec-WebSocket-Protocol: chat\r\n\r\n"
        );
        fixture.send(text.as_bytes())[9..12].to_owned()
    };
    // An admitted client gets an error for an unknown subprotocol.
    assert_eq!(ask("http://localhost:8765/"), "400");
    assert_eq!(ask("http://evil.example/"), "403");
}

#[test]
fn requests_that_two_parsers_could_divide_differently_are_refused() {
    let fixture = ServerFixture::new();
    for framing in [
        "Content-Length: 5\r\nContent-Length: 6\r\n",
        "Content-Length: +5\r\n",
        "Transfer-Encoding: chunked, identity\r\n",
        "Host : localhost\r\n",
        "X: a\r\n b\r\n",
    ] {
        let request = format!("GET / HTTP/1.1\r\n{framing}\r\nhello");
        let answer = fixture.send(request.as_bytes());
        assert!(answer.starts_with("HTTP/1.1 400"), "{framing}: {answer}");
    }
    fixture.is_well();
}

#[test]
fn frames_that_come_with_the_request_are_read() {
    let fixture = ServerFixture::new();
    let request = b"GET / HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n\
        Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
        Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\
        Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n";
    // A close frame without a code, masked.
    let close = [0x88, 0x80, 1, 2, 3, 4];
    let answer = fixture.send(&[request.as_slice(), &close].concat());
    assert!(answer.starts_with("HTTP/1.1 101 Switching Protocols\r\n"), "{answer}");
    assert!(answer.contains("Sec-Websocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n"), "{answer}");
    assert!(answer.contains("serverInfo"), "{answer}");
    eventually("the client is gone", || fixture.hub.clients() == 0);
}

#[test]
fn tokens_cannot_be_tried_out() {
    let fixture = ServerFixture::new();
    let wrong = (0..30).map(|n| fixture.ask(&format!("/?token=wrong{n}"), None));
    let answers: Vec<u16> = wrong.collect();
    assert_eq!(answers[..10], [403; 10]);
    assert_eq!(answers[10..], [429; 20]);
    // Local programs are admitted without a token.
    fixture.is_well();
}

#[test]
fn a_token_that_could_be_guessed_does_not_open_it_to_others() {
    let graph = Graph::live();
    let hub = Arc::new(Hub::open(&graph, Settings::default()).unwrap());
    let open = |address: &str, token: &str| {
        let address = address.parse().unwrap();
        WebServer::open(hub.clone(), WebServerSettings { address, token: Some(token.into()) })
    };
    let error = open("0.0.0.0:0", "a").unwrap_err().to_string();
    assert!(error.contains("too short") && error.contains("16 characters"), "{error}");
    assert!(open("0.0.0.0:0", "fifteen letters").is_err());
    assert!(open("127.0.0.1:0", "a").is_ok());
    let odd = open("0.0.0.0:0", "sixteen & more ü#?").unwrap();
    assert!(odd.url().ends_with("/?token=sixteen%20%26%20more%20%C3%BC%23%3F"), "{}", odd.url());
}

#[test]
fn the_page_connects_to_its_own_server_only() {
    let fixture = ServerFixture::new();
    let answer = fixture.send(b"GET / HTTP/1.1\r\nConnection: close\r\n\r\n");
    let policy = answer.lines().find(|line| line.starts_with("Content-Security-Policy:")).unwrap();
    let connect = policy.split(';').find(|part| part.contains("connect-src")).unwrap();
    assert_eq!(connect.trim(), "connect-src 'self' blob: data:");
}

#[test]
fn a_client_that_never_reads_is_disconnected_in_time() {
    let stalled = Duration::from_secs(2);
    let fixture = ServerFixture::open(None, ClientLimits { stalled, ..ClientLimits::default() });
    let node = fixture.graph.node(NodeSettings::new("camera")).unwrap();
    let pictures: Publisher<UInt8MultiArray> =
        node.publisher("/pictures", Qos::sensor_data()).unwrap();
    let mut socket = fixture.connect("/", None).unwrap();
    let channel = channel_of(&mut socket, "/pictures");
    let wanted = serde_json::json!({"op": "subscribe", "subscriptions": [
        {"id": 1, "channelId": channel},
    ]});
    socket.send(Message::text(wanted.to_string())).unwrap();
    eventually("there is a subscriber", || pictures.is_heard());
    let start = Instant::now();
    while fixture.hub.clients() > 0 {
        let data = vec![0; 1 << 20];
        pictures.publish(UInt8MultiArray { data, ..UInt8MultiArray::default() });
        std::thread::sleep(Duration::from_millis(20));
        assert!(start.elapsed() < LONG, "it is still there");
    }
    let (least, most) = (stalled, stalled + Duration::from_millis(1500));
    let after = start.elapsed();
    assert!(least <= after && after < most, "disconnected after {after:?} instead of {stalled:?}");
}

#[test]
fn an_address_that_others_reach_needs_a_token() {
    let graph = Graph::live();
    let hub = Arc::new(Hub::open(&graph, Settings::default()).unwrap());
    let open = |token: Option<&str>| {
        let address = "0.0.0.0:0".parse().unwrap();
        WebServer::open(hub.clone(), WebServerSettings { address, token: token.map(Into::into) })
    };
    assert!(open(None).is_err() && open(Some("")).is_err());
    let server = open(Some(TOKEN)).unwrap();
    let right = format!("/?token={TOKEN_IN_ADDRESS}");
    assert!(server.url().ends_with(&right), "{}", server.url());
    let port = server.address().port();
    let fixture = ServerFixture { graph, server, hub };
    let ask = |target: &str| {
        let text = format!(
            "GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\
             Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n"
        );
        let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.write_all(text.as_bytes()).unwrap();
        let mut answer = [0; 12];
        stream.read_exact(&mut answer).unwrap();
        String::from_utf8_lossy(&answer).into_owned()
    };
    assert_eq!(ask("/"), "HTTP/1.1 403");
    assert_eq!(ask(&right), "HTTP/1.1 101");
    drop(fixture);
}

#[test]
fn requests_that_are_none_are_answered_and_forgotten() {
    let fixture = ServerFixture::new();
    assert!(fixture.send(b"\x16\x03\x01\x02\x00\x01\x00\r\n\r\n").starts_with("HTTP/1.1 400"));
    let long = [b"GET / HTTP/1.1\r\nX: ".as_slice(), &[b'x'; 40_000]].concat();
    let answer = fixture.send(&long);
    assert!(answer.is_empty() || answer.starts_with("HTTP/1.1 431"), "{answer}");
    assert!(fixture.send(b"POST / HTTP/1.1\r\nContent-Length: 5\r\n\r\nhello").contains("405"));
    let answer = fixture.send(b"GET /../../etc/passwd HTTP/1.1\r\nConnection: close\r\n\r\n");
    assert!(answer.starts_with("HTTP/1.1 404"), "{answer}");
    let answer = fixture.send(b"HEAD / HTTP/1.1\r\nConnection: close\r\n\r\n");
    assert!(answer.starts_with("HTTP/1.1 200") && answer.ends_with("\r\n\r\n"), "{answer}");
    let upgrade = "GET / HTTP/1.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n";
    let other = format!("{upgrade}Sec-WebSocket-Protocol: chat\r\n\r\n");
    assert!(fixture.send(other.as_bytes()).starts_with("HTTP/1.1 400"));
    let keyless = format!("{upgrade}Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n");
    assert!(fixture.send(keyless.as_bytes()).starts_with("HTTP/1.1 426"));
    fixture.is_well();
}

#[test]
fn a_frame_of_a_gigabyte_is_refused_before_it_comes() {
    let fixture = ServerFixture::new();
    let mut socket = fixture.connect("/", None).unwrap();
    let MaybeTlsStream::Plain(stream) = socket.get_mut() else { panic!("no TLS here") };
    // The header of a masked binary frame of 2^30 bytes.
    let head = [0x82, 0xff, 0, 0, 0, 0, 0x40, 0, 0, 0, 1, 2, 3, 4];
    stream.write_all(&head).unwrap();
    let code = loop {
        match socket.read() {
            Ok(Message::Close(frame)) => break u16::from(frame.unwrap().code),
            Ok(_) => {}
            Err(error) => panic!("{error}"),
        }
    };
    assert_eq!(code, 1009);
    eventually("the client is gone", || fixture.hub.clients() == 0);
    fixture.is_well();
}

#[test]
fn broken_frames_end_only_who_sends_them() {
    let fixture = ServerFixture::new();
    let broken: [&[u8]; 5] = [
        // Not masked.
        &[0x82, 0x01, 0x00],
        // Unknown opcode.
        &[0x83, 0x80, 0, 0, 0, 0],
        // A fragmented ping.
        &[0x09, 0x80, 0, 0, 0, 0],
        // A continuation frame without a start.
        &[0x80, 0x80, 0, 0, 0, 0],
        // Invalid UTF-8.
        &[0x81, 0x82, 0, 0, 0, 0, 0xff, 0xfe],
    ];
    for bytes in broken {
        let mut socket = fixture.connect("/", None).unwrap();
        let MaybeTlsStream::Plain(stream) = socket.get_mut() else { panic!("no TLS here") };
        stream.write_all(bytes).unwrap();
        let code = loop {
            match socket.read() {
                Ok(Message::Close(frame)) => break u16::from(frame.unwrap().code),
                Ok(_) => {}
                Err(error) => panic!("{bytes:?}: {error}"),
            }
        };
        assert!(code == 1002 || code == 1007, "{bytes:?}: {code}");
    }
    eventually("all are gone", || fixture.hub.clients() == 0);
    fixture.is_well();
}

#[test]
fn malformed_messages_are_answered_in_words() {
    let fixture = ServerFixture::new();
    let mut socket = fixture.connect("/", None).unwrap();
    let wrong: [Message; 5] = [
        Message::text("{"),
        Message::text(r#"{"op":"dance"}"#),
        Message::binary(vec![]),
        Message::binary(vec![2, 1, 0, 0, 0, 1, 0, 0, 0, 255, 255, 255, 255]),
        Message::binary(vec![9; 1000]),
    ];
    let count = wrong.len();
    wrong.into_iter().for_each(|message| socket.send(message).unwrap());
    let mut told = 0;
    while told < count {
        if let Ok(text) = socket.read().unwrap().to_text() {
            told += usize::from(text.contains(r#""op":"status""#));
        }
    }
    socket.send(Message::Ping(vec![1, 2].into())).unwrap();
    while socket.read().unwrap() != Message::Pong(vec![1, 2].into()) {}
}

#[test]
fn a_client_that_does_not_read_delays_nobody_and_gets_the_last_map() {
    let fixture = ServerFixture::new();
    let node = fixture.graph.node(NodeSettings::new("camera")).unwrap();
    let pictures: Publisher<UInt8MultiArray> =
        node.publisher("/pictures", Qos::sensor_data()).unwrap();
    let maps: Publisher<Words> = node.publisher("/maps", Qos::latched(1)).unwrap();
    let subscribe = |socket: &mut WebSocket<MaybeTlsStream<TcpStream>>| {
        let channels = loop {
            let told: serde_json::Value =
                serde_json::from_str(socket.read().unwrap().to_text().unwrap_or("{}"))
                    .unwrap_or_default();
            let channels = told["channels"].as_array().cloned().unwrap_or_default();
            if channels.iter().any(|one| one["topic"] == "/pictures") {
                break channels;
            }
        };
        let id =
            |topic: &str| channels.iter().find(|one| one["topic"] == topic).unwrap()["id"].clone();
        let wanted = serde_json::json!({"op": "subscribe", "subscriptions": [
            {"id": 1, "channelId": id("/pictures")}, {"id": 2, "channelId": id("/maps")},
        ]});
        socket.send(Message::text(wanted.to_string())).unwrap();
    };
    let mut asleep = fixture.connect("/", None).unwrap();
    let mut awake = fixture.connect("/", None).unwrap();
    subscribe(&mut asleep);
    subscribe(&mut awake);
    eventually("both have subscribers", || pictures.is_heard() && maps.is_heard());
    // More than any buffer of the system; the sleeping client reads none of it.
    let start = Instant::now();
    for number in 0..200_u32 {
        let data = vec![0; 1 << 20];
        pictures.publish(UInt8MultiArray { data, ..UInt8MultiArray::default() });
        maps.publish(Words { data: number.to_string() });
    }
    assert!(start.elapsed() < LONG, "the publisher was held up");
    // A client that wakes up gets the last map, and few of the images.
    for socket in [&mut awake, &mut asleep] {
        let mut seen = 0;
        loop {
            let bytes = match socket.read().unwrap() {
                Message::Binary(bytes) if bytes[0] == 1 => bytes,
                _ => continue,
            };
            seen += usize::from(bytes[1] == 1);
            if bytes[1] == 2 && bytes.ends_with(b"199\0") {
                break;
            }
        }
        assert!(seen < 200, "{seen}");
    }
}

#[test]
fn only_so_many_come_in() {
    let fixture = ServerFixture::open(None, ClientLimits { clients: 2, ..ClientLimits::default() });
    let first = fixture.connect("/", None).unwrap();
    let _second = fixture.connect("/", None).unwrap();
    assert_eq!(fixture.ask("/", None), 503);
    drop(first);
    eventually("there is room again", || fixture.hub.clients() < 2);
    fixture.is_well();
}

#[test]
fn a_server_that_goes_says_so_and_frees_its_port() {
    let fixture = ServerFixture::new();
    let address = fixture.address();
    let mut socket = fixture.connect("/", None).unwrap();
    drop(fixture.server);
    let last = loop {
        match socket.read() {
            Ok(Message::Close(frame)) => break frame,
            Ok(_) => {}
            Err(error) => panic!("{error}"),
        }
    };
    assert_eq!(u16::from(last.unwrap().code), 1001);
    assert!(TcpStream::connect_timeout(&address, Duration::from_secs(1)).is_err());
}
