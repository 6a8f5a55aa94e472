//! Requests of a hostile client.

use serde_json::{Value, json};

use crate::client::Server;
use crate::run::{ODOM, TF};

#[test]
fn a_server_without_recordings_says_so() {
    let graph = periplus_graph::Graph::new();
    let hub = periplus_web::foxglove::Hub::open(&graph, Default::default()).unwrap();
    let mut client = crate::client::Client(hub.join().unwrap());
    assert!(!client.hears(&["serverInfo"])["capabilities"].to_string().contains("recordings"));
    client.say(&json!({"op": "fetchMarks", "requestId": 5, "recording": 1}));
    assert!(client.failure().contains("no recordings"));
    client.say(&json!({"op": "subscribeRecordings"}));
    client.hears(&["status"]);
    client.0.binary(&[0x11, 1, 0, 0, 0, 1]);
    client.hears(&["status"]);
}

#[test]
fn huge_and_wrong_requests_are_refused_or_cut() {
    let (_server, mut client) = Server::with_run("huge");
    let state = |topics: Value, time: &str| json!({"op": "fetchState", "requestId": 1, "recording": 1, "timeNs": time, "topics": topics});
    let many: Vec<Value> = vec![json!({"id": 1, "historyNs": "0", "count": 1}); 5000];
    client.say(&state(json!(many), "0"));
    assert!(client.failure().contains("too many topics"));
    let huge = json!([{"id": ODOM, "historyNs": i64::MAX.to_string(), "count": u32::MAX}]);
    client.say(&state(huge.clone(), &i64::MAX.to_string()));
    assert_eq!(client.answer(1).messages.len(), 101);
    client.say(&state(huge, &i64::MIN.to_string()));
    assert_eq!(client.answer(1).messages.len(), 0);
    client.say(
        &json!({"op": "fetchMessages", "requestId": 1, "recording": 1, "topics": [ODOM, ODOM],
        "startNs": i64::MIN.to_string(), "endNs": i64::MAX.to_string(), "maxBytes": u64::MAX}),
    );
    assert_eq!(client.answer(1).messages.len(), 101);
    client.say(&json!({"op": "fetchDensity", "requestId": 1, "recording": 1, "bins": u32::MAX}));
    let density = client.hears(&["density"])["topics"].clone();
    assert_eq!(density["1"].as_array().unwrap().len(), 10_000);
    client.say(
        &json!({"op": "fetchSeries", "requestId": 1, "recording": 1, "topic": 99, "paths": [],
        "startNs": "0", "endNs": "1", "points": 1}),
    );
    assert!(client.failure().contains("no topic 99"));
    client.say(&json!({"op": "fetchMarks", "requestId": 1, "recording": 9}));
    assert!(client.failure().contains("no recording 9"));
    client.say(&json!({"op": "closeRecording", "requestId": 1, "recording": 0}));
    assert!(client.failure().contains("no recording 0"));
    client.say(&json!({"op": "openRecording", "requestId": 1, "upload": 3}));
    assert!(client.failure().contains("no upload 3"));
    for wrong in [r#"{"op":"fetchState"}"#, r#"{"op":"fetchState","requestId":-1}"#] {
        client.0.text(wrong);
        client.hears(&["status"]);
    }
}

#[test]
fn a_cancelled_fetch_ends_with_its_last_frame() {
    let (_server, mut client) = Server::with_run("cancelled");
    client.say(&json!({"op": "cancelFetch", "requestIds": [1, 2, 3]}));
    client
        .say(&json!({"op": "fetchMessages", "requestId": 1, "recording": 1, "topics": [ODOM, TF],
        "startNs": "0", "endNs": "10000000000", "maxBytes": 1_000_000}));
    client.say(&json!({"op": "cancelFetch", "requestIds": [1]}));
    let answer = client.answer(1);
    assert!(answer.messages.len() <= 201);
    assert_eq!(answer.has_more, answer.messages.len() < 201);
    // Its id can be used again.
    assert_eq!(client.messages(1, &[ODOM], [0, 1], 10).messages.len(), 1);
}

#[test]
fn requests_that_nobody_reads_are_bounded() {
    let (_server, mut client) = Server::with_run("unread");
    for id in 0..2000 {
        client.say(&json!({"op": "fetchMessages", "requestId": id, "recording": 1,
            "topics": [ODOM, TF], "startNs": "0", "endNs": "10000000000", "maxBytes": 1 << 30}));
    }
    // The client is still served, and gets one answer for each request.
    let mut answered = 0;
    let mut refused = 0;
    while answered + refused < 2000 {
        use periplus_web::foxglove::{FrameKind, OutboxItem};
        let OutboxItem::Frame(frame) = client.0.outbox().take(std::time::Duration::from_secs(20))
        else {
            panic!("{answered} answers, {refused} refusals")
        };
        let bytes = frame.parts().concat();
        match frame.kind() {
            FrameKind::Binary if bytes[0] == 0x10 => answered += usize::from(bytes[5] & 1 == 1),
            FrameKind::Text => {
                let said: Value = serde_json::from_slice(&bytes).unwrap();
                refused += usize::from(said["op"] == "fetchFailure");
            }
            _ => {}
        }
    }
    assert!(answered >= 256, "{answered}");
}
