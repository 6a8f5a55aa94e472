//! Live mode: nodes with their own threads.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_graph::{Graph, NodeSettings, Qos, Sample, Sink, TopicInfo};
use periplus_msgs::std_msgs::Int32;
use periplus_msgs::std_srvs::{Trigger, TriggerResponse};

/// A generous timeout; it passes only when a test fails.
const LONG: Duration = Duration::from_secs(30);

fn number(data: i32) -> Int32 {
    Int32 { data }
}

#[test]
fn who_is_slow_loses_messages_and_holds_up_nobody() {
    let graph = Graph::live();
    let node = graph.node(NodeSettings::new("source")).unwrap();
    let x = node.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
    let (heard, hears): (Sender<i32>, Receiver<i32>) = channel();
    let (go, wait) = channel::<()>();
    let mut slow = graph.node(NodeSettings::new("slow")).unwrap().actor(());
    slow.subscribe("x", Qos::reliable(2), move |(), message: Arc<Int32>, _| {
        heard.send(message.data).unwrap();
        wait.recv_timeout(LONG).unwrap();
    })
    .unwrap();
    let (fast_heard, fast_hears) = channel();
    let mut fast = graph.node(NodeSettings::new("fast")).unwrap().actor(());
    fast.subscribe("x", Qos::reliable(1), move |(), message: Arc<Int32>, _| {
        fast_heard.send(message.data).unwrap();
    })
    .unwrap();

    x.publish(number(1));
    assert_eq!(hears.recv_timeout(LONG).unwrap(), 1);
    assert_eq!(fast_hears.recv_timeout(LONG).unwrap(), 1);
    // `slow` is busy with the first; two are queued, and the others displace each other.
    for data in 2..=6 {
        x.publish(number(data));
        assert_eq!(fast_hears.recv_timeout(LONG).unwrap(), data);
    }
    for _ in 0..3 {
        go.send(()).unwrap();
    }
    let rest = [hears.recv_timeout(LONG).unwrap(), hears.recv_timeout(LONG).unwrap()];
    assert_eq!(rest, [5, 6]);
    let traffic = graph.traffic().into_iter().find(|topic| topic.topic == "/x").unwrap();
    let slow = traffic.subscriptions.iter().find(|end| end.node == "/slow").unwrap();
    assert_eq!((slow.counts.received, slow.counts.dropped), (6, 3));
}

#[test]
fn timers_follow_the_clock_and_leave_out_what_they_miss() {
    let graph = Graph::live();
    let (ticked, ticks) = channel();
    let mut actor = graph.node(NodeSettings::new("a")).unwrap().actor(());
    actor.timer(10, move |(), io| ticked.send(io.now_ns()).unwrap()).unwrap();
    graph.advance_to(10);
    assert_eq!(ticks.recv_timeout(LONG).unwrap(), 10);
    // Late by five periods: one tick now, the next in phase.
    graph.advance_to(65);
    assert_eq!(ticks.recv_timeout(LONG).unwrap(), 65);
    graph.advance_to(70);
    assert_eq!(ticks.recv_timeout(LONG).unwrap(), 70);
    // A reset.
    graph.advance_to(0);
    graph.advance_to(10);
    assert_eq!(ticks.recv_timeout(LONG).unwrap(), 10);
    assert!(ticks.try_recv().is_err());
}

#[test]
fn calls_go_from_thread_to_thread() {
    let graph = Graph::live();
    let mut server = graph.node(NodeSettings::new("server")).unwrap().actor(());
    server
        .serve::<Trigger>("hello", |(), _, _| TriggerResponse {
            success: true,
            message: "hi".into(),
        })
        .unwrap();
    let node = graph.node(NodeSettings::new("caller")).unwrap();
    let client = node.client::<Trigger>("hello").unwrap();
    let (answered, answers) = channel();
    let mut caller = node.actor(());
    caller
        .timer(10, move |(), io| {
            let answered = answered.clone();
            io.call(&client, Default::default(), move |(), answer, _| {
                answered.send(answer.unwrap().message.clone()).unwrap();
            });
        })
        .unwrap();
    graph.advance_to(10);
    assert_eq!(answers.recv_timeout(LONG).unwrap(), "hi");
}

#[test]
fn a_slow_tap_loses_the_oldest_and_says_so() {
    struct Slow(Mutex<(Sender<u64>, Receiver<()>)>);
    impl Sink for Slow {
        fn wants(&self, topic: &TopicInfo) -> bool {
            topic.name == "/x"
        }
        fn depth(&self) -> usize {
            2
        }
        fn take(&self, _: &TopicInfo, sample: &Sample) {
            let ends = self.0.lock().unwrap();
            ends.0.send(sample.sequence).unwrap();
            ends.1.recv_timeout(LONG).unwrap();
        }
    }
    let graph = Graph::live();
    let (taken, takes) = channel();
    let (go, wait) = channel();
    let tap = graph.tap(Box::new(Slow(Mutex::new((taken, wait)))));
    let node = graph.node(NodeSettings::new("a")).unwrap();
    let x = node.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
    x.publish(number(0));
    assert_eq!(takes.recv_timeout(LONG).unwrap(), 1);
    for data in 0..4 {
        x.publish(number(data));
    }
    assert_eq!(graph.tap_dropped(tap), 2);
    for sequence in [4, 5] {
        go.send(()).unwrap();
        assert_eq!(takes.recv_timeout(LONG).unwrap(), sequence);
    }
    go.send(()).unwrap();
    assert_eq!(graph.take_findings().iter().next().unwrap().code, "slow-tap");
}

#[test]
fn a_quick_tap_is_fed_by_who_publishes() {
    struct Quick(Sender<(u64, std::thread::ThreadId)>);
    impl Sink for Quick {
        fn wants(&self, topic: &TopicInfo) -> bool {
            topic.name == "/x"
        }
        fn is_quick(&self) -> bool {
            true
        }
        fn take(&self, _: &TopicInfo, sample: &Sample) {
            self.0.send((sample.sequence, std::thread::current().id())).unwrap();
        }
    }
    let graph = Graph::live();
    let (taken, takes) = channel();
    graph.tap(Box::new(Quick(taken)));
    let node = graph.node(NodeSettings::new("a")).unwrap();
    let x = node.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
    for sequence in 1..4 {
        x.publish(number(7));
        assert_eq!(takes.try_recv(), Ok((sequence, std::thread::current().id())));
    }
}

#[test]
fn a_node_that_panics_is_reported_and_the_others_go_on() {
    let graph = Graph::live();
    let node = graph.node(NodeSettings::new("source")).unwrap();
    let x = node.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
    let (heard, hears) = channel();
    let mut bad = graph.node(NodeSettings::new("bad")).unwrap().actor(());
    let (fell, falls) = channel::<()>();
    bad.subscribe("x", Qos::reliable(5), move |(), _: Arc<Int32>, _| {
        fell.send(()).unwrap();
        std::panic::resume_unwind(Box::new("on purpose"));
    })
    .unwrap();
    let mut good = graph.node(NodeSettings::new("good")).unwrap().actor(());
    good.subscribe("x", Qos::reliable(5), move |(), message: Arc<Int32>, _| {
        heard.send(message.data).unwrap();
    })
    .unwrap();
    x.publish(number(1));
    x.publish(number(2));
    assert_eq!(hears.recv_timeout(LONG).unwrap(), 1);
    assert_eq!(hears.recv_timeout(LONG).unwrap(), 2);
    falls.recv_timeout(LONG).unwrap();
    drop(bad);
    // The closure is dropped with its node.
    assert!(falls.recv_timeout(LONG).is_err());
    let code = loop {
        if let Some(finding) = graph.take_findings().iter().next() {
            break finding.code;
        }
        std::thread::yield_now();
    };
    assert_eq!(code, "node-panicked");
}
