//! QoS events.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use periplus_graph::{
    Graph, KEEP_ALL_MAX_MESSAGES, Liveliness, Mailbox, NodeSettings, Policy, Publisher, Qos,
    QosEvent,
};
use periplus_msgs::std_msgs::Int32;

fn pair(qos: Qos, asked: Qos) -> (Graph, Publisher<Int32>, Mailbox<Int32>) {
    let graph = Graph::new();
    let a = graph.node(NodeSettings::new("a")).unwrap();
    let b = graph.node(NodeSettings::new("b")).unwrap();
    let publisher = a.publisher("x", qos).unwrap();
    let mailbox = b.mailbox("x", asked).unwrap();
    (graph, publisher, mailbox)
}

const ALIVE: QosEvent = QosEvent::LivelinessChanged { alive: 1, silent: 0 };

#[test]
fn deadlines_pass_on_both_sides_without_a_message() {
    let qos = Qos::reliable(1).with_deadline_ns(10);
    let (graph, publisher, mailbox) = pair(qos, Qos::reliable(1).with_deadline_ns(20));
    graph.advance_to(100);
    assert_eq!((publisher.events(), mailbox.events()), (vec![], vec![ALIVE]), "none came yet");
    publisher.publish(Int32::default());
    graph.advance_to(110);
    assert_eq!(publisher.events(), []);
    graph.advance_to(135);
    assert_eq!(publisher.events(), [QosEvent::DeadlineMissed { new: 3, total: 3 }]);
    assert_eq!(mailbox.events(), [QosEvent::DeadlineMissed { new: 1, total: 1 }]);
    publisher.publish(Int32::default());
    graph.advance_to(146);
    assert_eq!(publisher.events(), [QosEvent::DeadlineMissed { new: 1, total: 4 }]);
    assert_eq!(mailbox.events(), []);
    let traffic = graph.traffic();
    let topic = traffic.iter().find(|topic| topic.topic == "/x").unwrap();
    assert_eq!(topic.publishers[0].missed_deadlines, 4);
    assert_eq!(topic.subscriptions[0].counts.missed_deadlines, 1);
}

#[test]
fn who_has_to_say_that_it_lives_is_missed() {
    let manual =
        Qos { liveliness: Liveliness::ManualByTopic, lease_ns: Some(10), ..Qos::reliable(1) };
    let (graph, publisher, mailbox) = pair(manual, Qos::reliable(1));
    assert_eq!(mailbox.events(), [ALIVE]);
    graph.advance_to(11);
    assert_eq!(publisher.events(), [QosEvent::LivelinessLost]);
    assert_eq!(publisher.events(), []);
    assert_eq!(mailbox.events(), [QosEvent::LivelinessChanged { alive: 0, silent: 1 }]);
    publisher.assert_liveliness();
    assert_eq!(mailbox.events(), [ALIVE]);
    graph.advance_to(20);
    publisher.publish(Int32::default());
    graph.advance_to(30);
    assert_eq!((publisher.events(), mailbox.events()), (vec![], vec![]));
    drop(publisher);
    assert_eq!(mailbox.events(), [QosEvent::LivelinessChanged { alive: 0, silent: 0 }]);
}

#[test]
fn ends_that_do_not_fit_are_told_with_both_policies() {
    let (_graph, publisher, mailbox) = pair(Qos::sensor_data(), Qos::latched(1));
    let QosEvent::Incompatible { node, policies } = publisher.events().remove(0) else {
        panic!("they do not fit")
    };
    assert_eq!((node.as_str(), policies[0].policy), ("/b", Policy::Reliability));
    assert_eq!(policies[1].to_string(), "offers durability volatile, requested is transient_local");
    assert!(matches!(&mailbox.events()[..], [QosEvent::Incompatible { node, .. }] if node == "/a"));
    assert!(publisher.events().is_empty() && mailbox.events().is_empty(), "once");
}

#[test]
fn what_is_lost_is_told_and_keeping_all_has_an_end() {
    let (graph, publisher, mailbox) = pair(Qos::reliable(1), Qos::reliable(1).keep_all());
    for data in 0..i32::try_from(KEEP_ALL_MAX_MESSAGES).unwrap() + 2 {
        publisher.publish(Int32 { data });
    }
    let lost = QosEvent::MessagesLost { new: 2, total: 2 };
    assert_eq!(mailbox.events(), [ALIVE, lost]);
    assert_eq!(mailbox.drain()[0].data, 2);
    let findings = graph.take_findings();
    let codes: Vec<&str> = findings.iter().map(|finding| finding.code).collect();
    assert_eq!(codes, ["slow-subscription"]);
}
