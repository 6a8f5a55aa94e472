//! The demo in a tab.

use std::time::Duration;

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

/// Identifier of a service in the announcements.
fn service(texts: &[Value], name: &str) -> Option<u32> {
    let announced = texts.iter().filter(|text| text["op"] == "advertiseServices");
    let mut services = announced.flat_map(|text| text["services"].as_array().into_iter().flatten());
    let id = services.find(|service| service["name"] == name)?["id"].as_u64()?;
    u32::try_from(id).ok()
}

/// A reset by the client does not make up for the time before it.
#[test]
fn a_reset_ends_the_steps() {
    let mut tab = Tab::open_json(b"{}").unwrap();
    tab.step_until(1_000_000_000).unwrap();
    let id = service(&drain(&tab).0, "/reset_simulation").expect("the service is announced");
    let mut call = vec![2];
    call.extend(id.to_le_bytes());
    call.extend(1_u32.to_le_bytes());
    call.extend(3_u32.to_le_bytes());
    call.extend(b"cdr");
    call.extend([0, 1, 0, 0, 0]);
    tab.binary(&call);
    tab.step_until(1_100_000_000).unwrap();
    assert_eq!(tab.time_ns(), 0);
    tab.step_until(100_000_000).unwrap();
    assert_eq!(tab.time_ns(), 100_000_000);
}

/// Without a factor nothing waits: the budget ends the steps.
#[test]
fn an_unpaced_world_steps_for_its_budget() {
    let mut tab = Tab::open_json(b"{}").unwrap();
    assert_eq!(tab.run_paced(Duration::from_millis(1)).unwrap(), Duration::ZERO);
}

#[test]
fn one_program_drives_the_robot() {
    let options = br#"{"demo": {"explore": true, "navigation": true}}"#;
    let error = Tab::open_json(options).unwrap_err().to_string();
    assert!(error.contains("choose one of them"), "{error}");
}

#[test]
fn goals_can_be_sent_where_navigation_runs() {
    let mut tab = Tab::open_json(br#"{"demo": {"navigation": true}}"#).unwrap();
    tab.step_until(100_000_000).unwrap();
    let texts = drain(&tab).0;
    assert!(service(&texts, "/navigate_to_pose/_action/send_goal").is_some(), "{texts:?}");
}
