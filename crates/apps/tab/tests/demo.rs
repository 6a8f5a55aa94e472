//! The demo in a tab.

use periplus_tab::{Tab, TabFrame};
use serde_json::{Value, json};

/// Messages to the client that wait: JSON, and the number of binary ones.
fn drain(tab: &Tab) -> (Vec<Value>, usize) {
    let (mut texts, mut binaries) = (Vec::new(), 0);
    while let Some(frame) = tab.take() {
        match frame {
            TabFrame::Text(text) => {
                texts.push(serde_json::from_slice(&text).expect("JSON of the protocol"));
            }
            TabFrame::Binary(_) => binaries += 1,
            TabFrame::End(why) => panic!("the client is disconnected: {why}"),
        }
    }
    (texts, binaries)
}

/// Channel of a topic in the announcements.
fn channel(texts: &[Value], topic: &str) -> Option<u64> {
    let announced = texts.iter().filter(|text| text["op"] == "advertise");
    let mut channels = announced.flat_map(|text| text["channels"].as_array().into_iter().flatten());
    channels.find(|channel| channel["topic"] == topic)?["id"].as_u64()
}

#[test]
fn a_client_subscribes_to_scans() {
    let mut tab = Tab::open_json(br#"{"demo": {"seed": 3}}"#).unwrap();
    tab.step_until(100_000_000).unwrap();
    let (texts, _) = drain(&tab);
    assert!(texts.iter().any(|text| text["op"] == "serverInfo"), "{texts:?}");
    let id = channel(&texts, "/scan").expect("the topic is announced");
    let subscriptions = json!([{"id": 1, "channelId": id}]);
    tab.text(&json!({"op": "subscribe", "subscriptions": subscriptions}).to_string());
    tab.step_until(1_100_000_000).unwrap();
    assert_eq!(tab.time_ns(), 1_100_000_000);
    assert!(drain(&tab).1 > 0, "scans arrive");
}

#[test]
fn unknown_options_are_named() {
    let error = Tab::open_json(br#"{"demo": {"sed": 3}}"#).unwrap_err().to_string();
    assert!(error.contains("unknown field `sed`"), "{error}");
}

/// Without a recording there is nothing to close, and no error.
#[test]
fn nothing_is_recorded_unless_asked() {
    let mut tab = Tab::open_json(b"{}").unwrap();
    assert_eq!(tab.close_recording().unwrap(), None);
}
