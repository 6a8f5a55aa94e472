//! Peers that break off, stall, lie about lengths, or ask for other types: a run goes on.

mod common;

use std::io::{Read as _, Write as _};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::std_msgs;
use periplus_os::sleep;
use periplus_ros1::{
    Header, Master, MasterClient, MasterUse, Ros1Transport, RpcError, Settings, XmlRpcValue, ask,
    message_definition,
};

use common::{PATIENCE, wait_for};

/// A node that publishes texts on `/chatter`.
struct Talker {
    // Declared first, so that the master is left before it ends.
    wire: Ros1Transport,
    publisher: Publisher<std_msgs::String>,
    uri: String,
    _graph: Graph,
    _node: periplus_graph::Node,
    _master: Master,
}

impl Talker {
    fn new() -> Self {
        let master = Master::open([127, 0, 0, 1].into(), "localhost", 0).expect("a port");
        let settings = Settings { master_uri: master.uri().to_owned(), ..Settings::default() };
        let graph = Graph::live();
        let wire = Ros1Transport::open(&settings, MasterUse::Join).expect("a master");
        wire.attach(&graph).expect("a graph");
        let node = graph.node(NodeSettings::new("talker").bare()).expect("a name");
        let publisher = node.publisher("/chatter", Qos::reliable(10)).expect("a topic");
        let client = MasterClient::new(master.uri(), "/test");
        let uri = wait_for(|| client.node("/talker").ok());
        Self { wire, publisher, uri, _graph: graph, _node: node, _master: master }
    }

    fn say(&self, text: &str) {
        self.publisher.publish(std_msgs::String { data: text.into() });
    }

    /// Port that `requestTopic` names.
    fn port(&self, protocol: &str) -> Result<XmlRpcValue, RpcError> {
        let protocols = XmlRpcValue::List(vec![XmlRpcValue::List(vec![protocol.into()])]);
        let params = vec!["/test".into(), "/chatter".into(), protocols];
        ask(&self.uri, "requestTopic", params, PATIENCE)
    }

    fn connect(&self) -> TcpStream {
        let Ok(XmlRpcValue::List(place)) = self.port("TCPROS") else { panic!("no place") };
        let Some(XmlRpcValue::Int(port)) = place.get(2) else { panic!("no port") };
        let stream = TcpStream::connect(("127.0.0.1", u16::try_from(*port).expect("a port")));
        let stream = stream.expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
        stream
    }

    fn subscribe(&self, name: &str, md5: &str) -> TcpStream {
        let stream = self.connect();
        let header = Header::new(&[
            ("callerid", name),
            ("topic", "/chatter"),
            ("type", "std_msgs/String"),
            ("md5sum", md5),
        ]);
        (&stream).write_all(&header.write()).expect("sent");
        stream
    }

    fn subscribers(&self) -> usize {
        self.wire.subscribers_of("/chatter").map_or(0, |all| all.len())
    }
}

fn read_frame(mut stream: &TcpStream) -> Vec<u8> {
    let mut length = [0; 4];
    stream.read_exact(&mut length).expect("a length");
    let mut bytes = vec![0; u32::from_le_bytes(length) as usize];
    stream.read_exact(&mut bytes).expect("as many bytes");
    bytes
}

fn md5() -> String {
    message_definition("std_msgs/String").expect("a known type").md5
}

#[test]
fn twenty_subscribers_hear_everything_beside_stalled_ones() {
    let talker = Talker::new();
    let readers: Vec<TcpStream> =
        (0..20).map(|number| talker.subscribe(&format!("/reader_{number}"), &md5())).collect();
    // Two that never read.
    let stalled = [talker.subscribe("/stalled_1", &md5()), talker.subscribe("/stalled_2", &md5())];
    wait_for(|| (talker.subscribers() == 22).then_some(()));
    let text = "x".repeat(100_000);
    let reading: Vec<_> = readers
        .into_iter()
        .map(|stream| {
            std::thread::spawn(move || {
                assert_eq!(
                    Header::read(&read_frame(&stream)).expect("a header").get("latching"),
                    "0"
                );
                (0..100).map(|_| read_frame(&stream).len()).sum::<usize>()
            })
        })
        .collect();
    for _ in 0..100 {
        talker.say(&text);
        sleep(Duration::from_millis(5));
    }
    for reader in reading {
        assert_eq!(reader.join().expect("it reads"), 100 * 100_004);
    }
    drop(stalled);
    // Those that broke off are forgotten.
    wait_for(|| {
        talker.say("?");
        (talker.subscribers() == 0).then_some(())
    });
}

#[test]
fn a_wrong_sum_is_refused_with_both_sums() {
    let talker = Talker::new();
    let stream = talker.subscribe("/reader", "0123456789abcdef0123456789abcdef");
    let answer = Header::read(&read_frame(&stream)).expect("a header");
    let error = answer.get("error");
    assert!(error.contains(&md5()) && error.contains("0123456789abcdef"), "{error}");
    let stream = talker.connect();
    let header = Header::new(&[("callerid", "/reader"), ("topic", "/other"), ("md5sum", "*")]);
    (&stream).write_all(&header.write()).expect("sent");
    let answer = Header::read(&read_frame(&stream)).expect("a header");
    assert_eq!(answer.get("error"), "/talker does not publish [/other]");
}

#[test]
fn udpros_is_refused_with_what_there_is() {
    let talker = Talker::new();
    let why = "UDPROS is not supported; TCPROS is".to_owned();
    assert_eq!(talker.port("UDPROS"), Err(RpcError::Refused(why)));
}

#[test]
fn half_open_huge_and_senseless_connections_do_not_disturb() {
    let talker = Talker::new();
    let half_open: Vec<TcpStream> = (0..30).map(|_| talker.connect()).collect();
    for bytes in [
        // A header of 2 GB.
        vec![0xff, 0xff, 0xff, 0x7f, 1, 2, 3],
        // A field that is longer than its header.
        vec![8, 0, 0, 0, 0xff, 0xff, 0, 0, b'a', b'=', b'b', b'c'],
        b"GET / HTTP/1.1\r\n\r\n".to_vec(),
        b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n".to_vec(),
        b"POST / HTTP/1.1\r\nContent-Length: 5\r\n\r\n<<<<<".to_vec(),
    ] {
        let stream = talker.connect();
        // It may be closed before everything is sent.
        let _ = (&stream).write_all(&bytes);
        let _ = stream.shutdown(Shutdown::Write);
        let mut answer = Vec::new();
        // It is answered or closed, and does not hang.
        let _ = (&stream).read_to_end(&mut answer);
    }
    let reader = talker.subscribe("/reader", "*");
    let header = Header::read(&read_frame(&reader)).expect("a header");
    assert_eq!(header.get("callerid"), "/talker");
    wait_for(|| (talker.subscribers() == 1).then_some(()));
    talker.say("still here");
    assert_eq!(read_frame(&reader)[4..], *b"still here");
    drop(half_open);
}

#[test]
fn a_publisher_that_lies_about_lengths_is_left() {
    let talker = Talker::new();
    let settings =
        Settings { master_uri: talker.wire.client().uri().to_owned(), ..Settings::default() };
    // A publisher that announces a gigabyte and sends four bytes, behind a slave API that names its port.
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("an address").port();
    let api = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let uri = format!("http://127.0.0.1:{}/", api.local_addr().expect("an address").port());
    std::thread::spawn(move || {
        for stream in api.incoming().flatten() {
            let mut request = [0; 4096];
            let _ = (&stream).read(&mut request);
            let place = XmlRpcValue::List(vec![
                "TCPROS".into(),
                "127.0.0.1".into(),
                XmlRpcValue::Int(port.into()),
            ]);
            let body = periplus_ros1::write_response(&XmlRpcValue::List(vec![
                XmlRpcValue::Int(1),
                "".into(),
                place,
            ]));
            let head = format!("HTTP/1.1 200 OK\r\nContent-Length: {}\r\n\r\n", body.len());
            let _ = (&stream).write_all(format!("{head}{body}").as_bytes());
        }
    });
    let lies = Arc::new(std::sync::atomic::AtomicUsize::new(0));
    let counted = lies.clone();
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let _ = read_frame(&stream);
            let sum = md5();
            let header = Header::new(&[
                ("callerid", "/liar"),
                ("md5sum", &sum),
                ("type", "std_msgs/String"),
            ]);
            let _ = (&stream).write_all(&header.write());
            let _ = (&stream).write_all(&1_500_000_000_u32.to_le_bytes());
            let _ = (&stream).write_all(b"ab");
            counted.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        }
    });
    let params = ["/liar", "/lies", "std_msgs/String", &uri].map(XmlRpcValue::from);
    ask(&settings.master_uri, "registerPublisher", params.into(), PATIENCE).expect("registered");
    let graph = Graph::live();
    let wire = Ros1Transport::open(&settings, MasterUse::Join).expect("a master");
    wire.attach(&graph).expect("a graph");
    let node = graph.node(NodeSettings::new("listener").bare()).expect("a name");
    let _lies = node.mailbox::<std_msgs::String>("/lies", Qos::reliable(1)).expect("a topic");
    let heard = node.mailbox::<std_msgs::String>("/chatter", Qos::reliable(1)).expect("a topic");
    wait_for(|| (lies.load(std::sync::atomic::Ordering::Relaxed) > 0).then_some(()));
    let said = wait_for(|| {
        let findings = wire.take_findings();
        findings.iter().find(|one| one.message.contains("/lies")).map(|one| one.message.clone())
    });
    assert!(said.contains("1500000000 bytes are announced"), "{said}");
    // Messages of others arrive meanwhile.
    let text = wait_for(|| {
        talker.say("truth");
        heard.latest()
    });
    assert_eq!(text.data, "truth");
}
