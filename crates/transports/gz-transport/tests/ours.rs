//! Two transports of this crate with each other.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests of a network wait for it")]

mod common;

use std::net::Ipv4Addr;
use std::sync::mpsc::channel;
use std::time::Duration;

use periplus_gz_msgs::{Boolean, Message, StringMsg};
use periplus_gz_transport::{ServiceCallError, Settings, Transport};

use common::{LONG, until};

fn open(partition: &str) -> Transport {
    Transport::open(&Settings {
        partition: format!("{partition}-{}", std::process::id()),
        address: Some(Ipv4Addr::LOCALHOST),
        ..Settings::default()
    })
    .unwrap()
}

#[test]
fn a_topic_is_found_heard_and_gone() {
    let (a, b) = (open("topic"), open("topic"));
    let (send, came) = channel();
    let ear = b
        .subscribe("/lamp", "gz.msgs.Boolean", move |arrival| {
            let message = Boolean::decode(arrival.bytes).map(|message| message.data);
            let _ = send.send((arrival.type_name.to_owned(), message));
        })
        .unwrap();
    let publisher = a.advertise("lamp", "gz.msgs.Boolean").unwrap();
    let before = a.hearings();
    until("somebody hears", || publisher.is_heard());
    assert!(a.hearings() > before);
    publisher.publish(Boolean::from(true).encode());
    assert_eq!(came.recv_timeout(LONG).unwrap(), ("gz.msgs.Boolean".into(), Ok(true)));
    assert_eq!(ear.publishers(), 1);
    let seen = b.topics();
    assert_eq!((seen[0].name.as_str(), seen[0].types[0].as_str()), ("/lamp", "gz.msgs.Boolean"));
    drop(publisher);
    until("it is gone", || b.topics().is_empty());
    drop(ear);
    // Messages without subscribers are not sent. The end of a subscription arrives on a separate connection,
    // so it may come after the advertisement.
    let again = a.advertise("/lamp", "gz.msgs.Boolean").unwrap();
    until("it is there again", || b.topics().len() == 1);
    until("nobody subscribes", || !again.is_heard());
}

#[test]
fn who_leaves_is_forgotten() {
    let (a, b) = (open("bye"), open("bye"));
    let _publisher = a.advertise("/x", "gz.msgs.Boolean").unwrap();
    let _server = a.serve("/y", "gz.msgs.Empty", "gz.msgs.Boolean", |_| {}).unwrap();
    until("both are there", || b.topics().len() == 1 && b.services().len() == 1);
    drop(a);
    until("both are gone", || b.topics().is_empty() && b.services().is_empty());
}

#[test]
fn partitions_do_not_hear_each_other() {
    let (a, b, c) = (open("here"), open("there"), open("here"));
    let _publisher = a.advertise("/x", "gz.msgs.Boolean").unwrap();
    until("it is seen", || c.topics().len() == 1);
    assert_eq!(b.topics(), []);
}

#[test]
fn large_messages_come_whole_and_in_order() {
    let (a, b) = (open("large"), open("large"));
    let (send, came) = channel();
    let _ear = b
        .subscribe("/cloud", "gz.msgs.Bytes", move |arrival| {
            let _ = send.send((arrival.bytes.len(), arrival.bytes[0]));
        })
        .unwrap();
    let publisher = a.advertise("/cloud", "gz.msgs.Bytes").unwrap();
    until("somebody hears", || publisher.is_heard());
    for number in 0..5 {
        publisher.publish(vec![number; 10_000_000]);
    }
    for number in 0..5 {
        assert_eq!(came.recv_timeout(LONG).unwrap(), (10_000_000, number));
    }
}

#[test]
fn a_call_is_answered_refused_or_late() {
    let (a, b) = (open("call"), open("call"));
    let _server = a
        .serve("/echo", "gz.msgs.StringMsg", "gz.msgs.StringMsg", |call| {
            let asked = StringMsg::decode(&call.request).unwrap().data;
            match asked.as_str() {
                "refuse" => call.answer.send(None),
                "wait" => {}
                _ => call.answer.send(Some(&StringMsg::from(asked + "!").encode())),
            }
        })
        .unwrap();
    let types = ["gz.msgs.StringMsg", "gz.msgs.StringMsg"];
    let ask = |text: &str, timeout| {
        let request = StringMsg::from(text.to_owned()).encode();
        let answer = b.call("/echo", types[0], types[1], &request, timeout)?;
        Ok(StringMsg::decode(&answer).unwrap().data)
    };
    assert_eq!(ask("hello", LONG), Ok("hello!".to_owned()));
    assert_eq!(ask("again", LONG), Ok("again!".to_owned()));
    assert_eq!(ask("refuse", LONG), Err(ServiceCallError::Refused));
    assert_eq!(ask("wait", Duration::from_millis(200)), Err(ServiceCallError::Late));
    let short = Duration::from_millis(100);
    let other = b.call("/nobody", types[0], types[1], &[], short);
    assert_eq!(other, Err(ServiceCallError::Nobody));
    let other = b.call("/echo", "gz.msgs.Boolean", types[1], &[], short);
    assert_eq!(other, Err(ServiceCallError::Nobody));
}
