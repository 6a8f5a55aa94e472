//! Publishers and subscriptions.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::sync::{Arc, Mutex};

use periplus_graph::{
    Durability, Graph, GraphError, NodeSettings, Publisher, Qos, Reliability, Sample, Sink,
    TopicInfo,
};
use periplus_msgs::std_msgs;
use periplus_msgs::{Message, geometry_msgs::Twist, std_msgs::Int32, std_msgs::UInt8};

fn number(data: i32) -> Int32 {
    Int32 { data }
}

fn numbers(messages: &[Arc<Int32>]) -> Vec<i32> {
    messages.iter().map(|message| message.data).collect()
}

fn pair(qos: Qos, asked: Qos) -> (Graph, Publisher<Int32>, periplus_graph::Mailbox<Int32>) {
    let graph = Graph::new();
    let a = graph.node(NodeSettings::new("a").bare()).unwrap();
    let b = graph.node(NodeSettings::new("b").bare()).unwrap();
    let publisher = a.publisher("x", qos).unwrap();
    let mailbox = b.mailbox("x", asked).unwrap();
    (graph, publisher, mailbox)
}

#[test]
fn the_newest_wait_and_the_others_are_counted() {
    let (_graph, publisher, mailbox) = pair(Qos::reliable(1), Qos::reliable(2));
    for data in 1..=5 {
        publisher.publish(number(data));
    }
    assert_eq!(numbers(&mailbox.drain()), [4, 5]);
    assert_eq!(mailbox.drain().len(), 0);
    let counts = mailbox.counts();
    assert_eq!((counts.received, counts.dropped), (5, 3));
    publisher.publish(number(6));
    publisher.publish(number(7));
    assert_eq!(mailbox.latest().unwrap().data, 7);
    assert!(mailbox.latest().is_none());
}

#[test]
fn all_are_kept_for_who_keeps_all() {
    let (_graph, publisher, mailbox) = pair(Qos::reliable(1), Qos::reliable(1).keep_all());
    for data in 0..1000 {
        publisher.publish(number(data));
    }
    assert_eq!(mailbox.drain().len(), 1000);
    assert_eq!(mailbox.counts().dropped, 0);
}

#[test]
fn latecomers_get_what_is_latched() {
    let graph = Graph::new();
    let a = graph.node(NodeSettings::new("a")).unwrap();
    let latched = a.publisher("map", Qos::latched(2)).unwrap();
    for data in 1..=3 {
        latched.publish(number(data));
    }
    let late = a.mailbox::<Int32>("map", Qos::latched(10)).unwrap();
    assert_eq!(numbers(&late.drain()), [2, 3]);
    // A volatile subscription gets only new messages.
    let volatile = a.mailbox::<Int32>("map", Qos::reliable(10)).unwrap();
    assert!(volatile.drain().is_empty());
    latched.publish(number(4));
    assert_eq!(numbers(&volatile.drain()), [4]);
    assert_eq!(numbers(&late.drain()), [4]);
    // Retained messages are removed with their publisher.
    drop(latched);
    let _again = a.publisher::<Int32>("map", Qos::latched(2)).unwrap();
    assert!(a.mailbox::<Int32>("map", Qos::latched(10)).unwrap().drain().is_empty());
}

#[test]
fn several_share_one_message_and_it_is_encoded_once() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("a")).unwrap();
    let publisher = node.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
    let one = node.mailbox::<Int32>("x", Qos::reliable(1)).unwrap();
    let two = node.mailbox::<Int32>("x", Qos::reliable(1)).unwrap();
    let raw = node.raw_mailbox("x", "std_msgs/msg/Int32", None, Qos::reliable(1)).unwrap();
    publisher.publish(number(1));
    assert!(Arc::ptr_eq(&one.latest().unwrap(), &two.latest().unwrap()));
    let sample = raw.drain().remove(0);
    let bytes = sample.cdr().unwrap();
    assert_eq!(bytes, [0, 1, 0, 0, 1, 0, 0, 0]);
    assert!(std::ptr::eq(bytes, sample.clone().cdr().unwrap()));
}

#[test]
fn bytes_are_decoded_once_and_wrong_ones_are_counted() {
    let graph = Graph::new();
    let wire = graph.node(NodeSettings::new("wire")).unwrap();
    let node = graph.node(NodeSettings::new("node")).unwrap();
    let hash = Some(Int32::TYPE_HASH);
    let raw = wire.raw_publisher("x", "std_msgs/msg/Int32", hash, Qos::reliable(5)).unwrap();
    let one = node.mailbox::<Int32>("x", Qos::reliable(5)).unwrap();
    let two = node.mailbox::<Int32>("x", Qos::reliable(5)).unwrap();
    raw.publish(vec![0, 1, 0, 0, 7, 0, 0, 0]);
    let message = one.latest().unwrap();
    assert_eq!(message.data, 7);
    assert!(Arc::ptr_eq(&message, &two.latest().unwrap()));

    raw.publish(vec![0, 1, 0, 0, 7]);
    raw.publish(vec![]);
    raw.publish(vec![0, 1, 0, 0, 8, 0, 0, 0]);
    assert_eq!(numbers(&one.drain()), [8]);
    assert_eq!(one.counts().undecodable, 2);
    let findings = graph.take_findings();
    assert_eq!(findings.iter().count(), 1);
    let finding = findings.iter().next().unwrap();
    assert_eq!(finding.code, "undecodable-message");
    assert!(finding.message.contains("`/node`") && finding.message.contains("`/x`"));
}

#[test]
fn a_topic_has_one_type() {
    let graph = Graph::new();
    let a = graph.node(NodeSettings::new("a")).unwrap();
    let b = graph.node(NodeSettings::new("b")).unwrap();
    let first = a.publisher::<Int32>("x", Qos::default()).unwrap();
    let error = b.mailbox::<Twist>("x", Qos::default()).err().unwrap();
    assert_eq!(
        error.to_string(),
        "the topic `/x` is a std_msgs/msg/Int32 (`/a`), but `/b` requests a \
         geometry_msgs/msg/Twist; rename one of the two with a remapping `/x:=...`"
    );
    let hash = Some("RIHS01_00");
    let error = b.raw_publisher("x", "std_msgs/msg/Int32", hash, Qos::default()).err().unwrap();
    assert!(error.to_string().contains("with the hash RIHS01_00"), "{error}");
    drop(first);
    assert!(b.mailbox::<Twist>("x", Qos::default()).is_ok());
}

#[test]
fn ends_that_do_not_fit_are_not_heard_and_recorded() {
    let (graph, publisher, mailbox) = pair(Qos::sensor_data(), Qos::latched(1));
    assert!(!publisher.is_heard());
    publisher.publish(number(1));
    assert!(mailbox.latest().is_none());
    let topics = graph.topics();
    assert_eq!(topics[0].mismatches[0].policies.len(), 2);
    let findings = graph.take_findings();
    let finding = findings.iter().next().unwrap();
    assert_eq!(
        finding.message,
        "`/b` receives nothing from `/a` on the topic `/x`: the publisher offers reliability \
         best_effort, requested is reliable; offers durability volatile, requested is \
         transient_local"
    );
}

#[test]
fn who_goes_is_gone() {
    let (graph, publisher, mailbox) = pair(Qos::reliable(1), Qos::reliable(1));
    assert!(publisher.is_heard());
    assert_eq!(graph.nodes()[1].subscribes, ["/x"]);
    let before = graph.generation();
    drop(mailbox);
    assert!(before < graph.generation());
    assert!(!publisher.is_heard());
    assert_eq!(graph.nodes().len(), 1);
    drop(publisher);
    assert_eq!(graph.topics().len(), 0);
    assert_eq!(graph.nodes().len(), 0);
}

#[test]
fn deadlines_and_lifespans_are_watched() {
    let offered = Qos::reliable(5).with_deadline_ns(10).with_lifespan_ns(15);
    let (graph, publisher, mailbox) = pair(offered, Qos::reliable(5).with_deadline_ns(20));
    for time_ns in [0, 10, 45] {
        graph.advance_to(time_ns);
        publisher.publish(number(1));
    }
    // The gap of 35 ns has deadlines at 10, 20 and 30 for the one and at 20 for the other.
    assert_eq!(graph.traffic()[0].publishers[0].missed_deadlines, 3);
    assert_eq!(mailbox.counts().missed_deadlines, 1);
    assert_eq!(mailbox.drain().len(), 1);
    assert_eq!(mailbox.counts().stale, 2);
}

#[test]
fn rates_are_differences_of_counts() {
    let (graph, publisher, _mailbox) = pair(Qos::reliable(1), Qos::reliable(1));
    let before = graph.traffic().remove(0);
    for _ in 0..10 {
        graph.advance_to(graph.now_ns() + 50_000_000);
        publisher.publish(number(0));
    }
    assert_eq!(graph.traffic()[0].rate_hz_since(&before), Some(20.0));
    assert_eq!(before.rate_hz_since(&before), None);
}

#[derive(Default, Clone)]
struct Notes(Arc<Mutex<Vec<String>>>);

impl Sink for Notes {
    fn wants(&self, topic: &TopicInfo) -> bool {
        !topic.name.starts_with("/secret")
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let line = format!("{} {} #{}", sample.time_ns, topic.name, sample.sequence);
        self.0.lock().unwrap().push(line);
    }
}

#[test]
fn taps_hear_what_they_choose_in_order() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("a")).unwrap();
    let latched = node.publisher::<Int32>("map", Qos::latched(1)).unwrap();
    latched.publish(number(0));
    let notes = Notes::default();
    let tap = graph.tap(Box::new(notes.clone()));
    let x = node.publisher::<Int32>("x", Qos::sensor_data()).unwrap();
    let y = node.publisher::<UInt8>("y", Qos::sensor_data()).unwrap();
    let secret = node.publisher::<UInt8>("secret", Qos::sensor_data()).unwrap();
    assert!(x.is_heard() && y.is_heard() && !secret.is_heard());
    graph.advance_to(7);
    y.publish(UInt8::default());
    secret.publish(UInt8::default());
    x.publish(number(1));
    y.publish(UInt8::default());
    graph.untap(tap);
    assert!(!x.is_heard());
    x.publish(number(2));
    assert_eq!(*notes.0.lock().unwrap(), ["0 /map #1", "7 /y #1", "7 /x #1", "7 /y #2"]);
    assert_eq!(Arc::strong_count(&notes.0), 1);
}

#[test]
fn a_sink_may_publish() {
    struct Echo(Mutex<Option<Publisher<std_msgs::String>>>, Notes);
    impl Sink for Echo {
        fn wants(&self, topic: &TopicInfo) -> bool {
            topic.name == "/x" || topic.name == "/echo"
        }
        fn take(&self, topic: &TopicInfo, sample: &Sample) {
            self.1.take(topic, sample);
            let publisher = self.0.lock().unwrap().take();
            if let Some(publisher) = publisher {
                publisher.publish(std_msgs::String::default());
            }
        }
    }
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("a")).unwrap();
    let x = node.publisher::<Int32>("x", Qos::default()).unwrap();
    let echo = node.publisher("echo", Qos::default()).unwrap();
    let notes = Notes::default();
    graph.tap(Box::new(Echo(Mutex::new(Some(echo)), notes.clone())));
    x.publish(number(1));
    assert_eq!(*notes.0.lock().unwrap(), ["0 /x #1", "0 /echo #1"]);
}

#[test]
fn fits_are_those_of_dds() {
    let (weak, strong) = (Reliability::BestEffort, Reliability::Reliable);
    let (volatile, latched) = (Durability::Volatile, Durability::TransientLocal);
    for (offer, ask, fits) in
        [(weak, weak, true), (weak, strong, false), (strong, weak, true), (strong, strong, true)]
    {
        let qos = Qos::default();
        assert_eq!(
            qos.with_reliability(offer)
                .incompatible_policies(&qos.with_reliability(ask))
                .is_empty(),
            fits
        );
    }
    for (offer, ask, fits) in [
        (volatile, volatile, true),
        (volatile, latched, false),
        (latched, volatile, true),
        (latched, latched, true),
    ] {
        let qos = Qos::default();
        assert_eq!(
            qos.with_durability(offer).incompatible_policies(&qos.with_durability(ask)).is_empty(),
            fits
        );
    }
    for (offer, ask, fits) in [
        (None, None, true),
        (None, Some(5), false),
        (Some(5), None, true),
        (Some(5), Some(5), true),
        (Some(6), Some(5), false),
        (Some(4), Some(5), true),
    ] {
        let with = |deadline_ns| Qos { deadline_ns, ..Qos::default() };
        assert_eq!(with(offer).incompatible_policies(&with(ask)).is_empty(), fits);
        let with = |lease_ns| Qos { lease_ns, ..Qos::default() };
        assert_eq!(with(offer).incompatible_policies(&with(ask)).is_empty(), fits);
    }
}

#[test]
fn two_graphs_know_nothing_of_each_other() {
    let (one, publisher, _) = pair(Qos::reliable(1), Qos::reliable(1));
    let (two, _, mailbox) = pair(Qos::reliable(1), Qos::reliable(1));
    publisher.publish(number(1));
    assert!(mailbox.latest().is_none());
    one.advance_to(5);
    assert_eq!((one.now_ns(), two.now_ns()), (5, 0));
}

#[test]
fn handles_go_from_thread_to_thread() {
    fn check<T: Send + Sync>() {}
    check::<Graph>();
    check::<Publisher<Int32>>();
    check::<periplus_graph::Mailbox<Int32>>();
    check::<Sample>();
    check::<periplus_graph::Actor<Int32>>();
    check::<periplus_graph::Parameters>();
}

#[test]
fn node_names_are_unique() {
    let graph = Graph::new();
    let _first = graph.node(NodeSettings::new("a")).unwrap();
    let error = graph.node(NodeSettings::new("a")).err().unwrap();
    assert_eq!(error, GraphError::NodeExists { node: "/a".into() });
    assert!(graph.node(NodeSettings::new("a").namespace("b")).is_ok());
}

#[test]
fn an_end_that_is_made_to_fit_is_heard_from_then_on() {
    let (graph, publisher, mailbox) = pair(Qos::sensor_data(), Qos::latched(1));
    let ends = &graph.topics()[0];
    let (offer, asked) = (&ends.publishers[0], &ends.subscriptions[0]);
    let generation = graph.generation();
    assert!(graph.set_qos(offer.id, offer.qos.strengthened_for(&asked.qos)));
    assert_ne!(graph.generation(), generation, "wires see it");
    assert!(publisher.is_heard() && graph.topics()[0].mismatches.is_empty());
    publisher.publish(number(2));
    assert_eq!(mailbox.latest().map(|heard| heard.data), Some(2));
    // Late subscribers get it, too.
    let late = graph.node(NodeSettings::new("late")).unwrap();
    let late = late.mailbox::<Int32>("x", Qos::latched(1)).unwrap();
    assert_eq!(late.latest().map(|heard| heard.data), Some(2));
}

#[test]
fn a_subscription_that_asks_for_less_gets_what_is_kept_once() {
    let asked = Qos::latched(1).with_deadline_ns(1_000);
    let (graph, publisher, mailbox) = pair(Qos::latched(1), asked);
    publisher.publish(number(1));
    let id = graph.topics()[0].subscriptions[0].id;
    assert!(graph.set_qos(id, asked.weakened_for(&Qos::latched(1))));
    assert_eq!(mailbox.drain().len(), 1);
    assert!(graph.set_qos(id, Qos::latched(1)), "once more, with nothing new");
    assert!(mailbox.drain().is_empty());
    drop(mailbox);
    assert!(!graph.set_qos(id, asked), "it is gone");
}
