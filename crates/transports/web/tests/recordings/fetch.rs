//! Fetches of messages and summaries.

use serde_json::{Value, json};

use crate::client::Server;
use crate::run::{ARM_TENTHS, COSTMAP, MARKERS, ODOM, TF, UPDATES};

const TENTH_NS: u64 = 100_000_000;

fn need(id: u32, history_tenths: u64, count: u32) -> Value {
    json!({"id": id, "historyNs": (history_tenths * TENTH_NS).to_string(), "count": count})
}

#[test]
fn the_list_describes_a_recording() {
    let server = Server::open("list");
    let mut client = server.join();
    client.list_when(|list| list["recordings"] == json!([]));
    let path = server.folder.join("run.mcap");
    crate::run::write(&path);
    server.recordings.open(&path).unwrap();
    let list = client.list_when(|list| list["recordings"][0]["state"] == "ready");
    let run = &list["recordings"][0];
    assert_eq!(
        (&run["id"], &run["name"], &run["kind"]),
        (&json!(1), &json!("run"), &json!("mcap"))
    );
    assert_eq!((&run["startNs"], &run["endNs"]), (&json!("0"), &json!("10000000000")));
    assert_eq!((&run["messageCount"], &run["progress"]), (&json!(318), &json!(1.0)));
    let odom = &run["topics"][0];
    assert_eq!(
        (&odom["id"], &odom["topic"], &odom["count"]),
        (&json!(ODOM), &json!("/odom"), &json!(101))
    );
    assert_eq!(
        (&odom["schemaName"], &odom["schemaEncoding"]),
        (&json!("nav_msgs/msg/Odometry"), &json!("ros2msg"))
    );
    let is_latched: Vec<bool> = run["topics"]
        .as_array()
        .unwrap()
        .iter()
        .map(|topic| topic["isLatched"].as_bool().unwrap())
        .collect();
    assert_eq!(is_latched, [false, false, true, false, false, true, false]);
    client.say(&json!({"op": "closeRecording", "requestId": 1, "recording": 1}));
    client.list_when(|list| list["recordings"] == json!([]));
}

#[test]
fn a_state_has_the_newest_messages_and_the_history() {
    let (_server, mut client) = Server::with_run("state");
    let times = client.state(1, 50, &[need(ODOM, 0, 1)]).times();
    assert_eq!(times, [(ODOM, 50 * TENTH_NS)]);
    let times = client.state(2, 50, &[need(ODOM, 3, 1)]).times();
    assert_eq!(times, [48, 49, 50].map(|tenths| (ODOM, tenths * TENTH_NS)));
    let answer = client.state(3, 50, &[need(ODOM, 0, 2)]);
    assert_eq!(answer.times(), [49, 50].map(|tenths| (ODOM, tenths * TENTH_NS)));
    assert_eq!((answer.reached_ns, answer.has_more), (50 * TENTH_NS, false));
    assert_eq!(client.state(4, -1, &[need(ODOM, 5, 9)]).times(), []);
    assert_eq!(client.state(5, 5, &[need(ODOM, 0, 0)]).times(), []);
    let unknown = [need(999, 0, 1), need(0, 0, 1)];
    assert_eq!(client.state(6, 5, &unknown).times(), []);
}

#[test]
fn a_state_has_every_transform_and_all_that_is_latched() {
    let (_server, mut client) = Server::with_run("latched");
    for id in [1, 2] {
        let times = client.state(id, 90, &[need(TF, 0, 1)]).times();
        assert!(times.contains(&(TF, ARM_TENTHS as u64 * TENTH_NS)), "{times:?}");
        assert!(times.contains(&(TF, 90 * TENTH_NS)), "{times:?}");
    }
    // Once the index is complete there is nothing else; marks are complete then, too.
    client.say(&json!({"op": "fetchMarks", "requestId": 3, "recording": 1}));
    while client.hears(&["marks"])["isComplete"] != true {}
    let times = client.state(4, 90, &[need(TF, 0, 1)]).times();
    assert_eq!(times, [(TF, TENTH_NS), (TF, TENTH_NS), (TF, 90 * TENTH_NS)]);
    assert_eq!(client.state(5, 19, &[need(COSTMAP, 0, 0)]).times(), []);
    assert_eq!(client.state(6, 90, &[need(COSTMAP, 0, 0)]).times(), [(COSTMAP, 20 * TENTH_NS)]);
    // Updates belong to the last complete grid.
    let times = client.state(7, 48, &[need(UPDATES, 0, 1)]).times();
    assert_eq!(times, [25, 35, 45].map(|tenths| (UPDATES, tenths * TENTH_NS)));
}

#[test]
fn a_state_has_every_marker_that_is_shown() {
    let (_server, mut client) = Server::with_run("markers");
    client.say(&json!({"op": "fetchMarks", "requestId": 1, "recording": 1}));
    while client.hears(&["marks"])["isComplete"] != true {}
    let mut times = |id: u32, tenths: i64| {
        let times = client.state(id, tenths, &[need(MARKERS, 0, 1)]).times();
        times.into_iter().map(|(_, time_ns)| time_ns / TENTH_NS).collect::<Vec<_>>()
    };
    assert_eq!(times(2, 0), [0]);
    assert_eq!(times(3, 49), [1, 2, 49]);
    assert_eq!(times(4, 100), [1, 100]);
}

#[test]
fn a_span_is_fetched_in_parts_of_whole_times() {
    let (_server, mut client) = Server::with_run("span");
    let all = client.messages(1, &[ODOM, TF], [0, 3], 1 << 20);
    let expected: Vec<(u32, u64)> =
        vec![(ODOM, 0), (TF, 0), (ODOM, 1), (TF, 1), (TF, 1), (ODOM, 2), (TF, 2)];
    let tenths = |times: Vec<(u32, u64)>| -> Vec<(u32, u64)> {
        times.into_iter().map(|(topic, time_ns)| (topic, time_ns / TENTH_NS)).collect()
    };
    assert_eq!(tenths(all.times()), expected);
    assert_eq!((all.reached_ns, all.has_more), (3 * TENTH_NS - 1, false));
    let first = client.messages(2, &[TF, ODOM], [1, 3], 1);
    assert_eq!(tenths(first.times()), [(ODOM, 1), (TF, 1), (TF, 1)]);
    assert_eq!((first.reached_ns, first.has_more), (TENTH_NS, true));
    let none = client.messages(3, &[], [0, 50], 1 << 20);
    assert_eq!((none.times().len(), none.has_more), (0, false));
    assert_eq!(client.messages(4, &[ODOM], [5, 5], 10).times(), []);
    assert_eq!(client.messages(5, &[ODOM], [99, 200], 1 << 20).messages.len(), 2);
}

#[test]
fn density_counts_the_messages_of_each_bin() {
    let (_server, mut client) = Server::with_run("density");
    client.say(&json!({"op": "fetchDensity", "requestId": 1, "recording": 1, "bins": 4}));
    let topics = client.hears(&["density"])["topics"].clone();
    assert_eq!(topics[ODOM.to_string()], json!([25, 25, 25, 26]));
    assert_eq!(topics[COSTMAP.to_string()], json!([1, 0, 0, 0]));
}

#[test]
fn a_series_has_the_numbers_of_a_path() {
    let (_server, mut client) = Server::with_run("series");
    let series = |points: u32| {
        json!({"op": "fetchSeries", "requestId": points, "recording": 1, "topic": ODOM,
            "paths": ["twist.twist.linear.x", "nothing"], "startNs": "0", "endNs": "10000000000",
            "points": points})
    };
    client.say(&series(1000));
    let all = client.hears(&["series", "fetchFailure"]);
    assert_eq!(all["isReduced"], false);
    assert_eq!(all["timesNs"].as_array().unwrap().len(), 100);
    assert_eq!((&all["timesNs"][99], &all["values"][0][99]), (&json!("9900000000"), &json!(99.0)));
    assert_eq!(all["values"][1][0], Value::Null);
    client.say(&series(10));
    let few = client.hears(&["series", "fetchFailure"]);
    assert_eq!(few["isReduced"], true);
    let values = [0, 19, 20, 39, 40, 59, 60, 79, 80, 99].map(f64::from);
    assert_eq!(few["values"][0], json!(values));
    assert_eq!(few["timesNs"][3], json!("3900000000"));
}
