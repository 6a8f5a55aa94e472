//! Messages that an interceptor changes, holds and drops.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::sync::{Arc, Mutex};

use periplus_graph::{Graph, InterceptedMessage, Interceptor, NodeSettings, Qos, TopicInfo};
use periplus_msgs::std_msgs::Int32;

/// Doubles even numbers, drops multiples of three, and holds the rest.
#[derive(Default)]
struct Arithmetic {
    held: Mutex<Vec<InterceptedMessage>>,
}

impl Interceptor for Arithmetic {
    fn wants(&self, topic: &TopicInfo) -> bool {
        topic.name == "/numbers" && topic.type_name == "std_msgs/msg/Int32"
    }

    fn intercept(&self, message: InterceptedMessage) {
        let number = message.message::<Int32>().unwrap().data;
        match number {
            _ if number % 3 == 0 => {}
            _ if number % 2 == 0 => message.with_message(Int32 { data: 2 * number }).forward(),
            _ => self.held.lock().unwrap().push(message),
        }
    }
}

#[test]
fn an_interceptor_decides_what_subscribers_receive() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("counter")).unwrap();
    let numbers = node.publisher::<Int32>("numbers", Qos::reliable(10)).unwrap();
    let others = node.publisher::<Int32>("others", Qos::reliable(10)).unwrap();
    let mailbox = node.mailbox::<Int32>("numbers", Qos::reliable(10)).unwrap();
    let untouched = node.mailbox::<Int32>("others", Qos::reliable(10)).unwrap();
    let interceptor = Arc::new(Arithmetic::default());
    graph.set_interceptor(Some(interceptor.clone()));
    let received = || mailbox.drain().iter().map(|message| message.data).collect::<Vec<_>>();

    for data in 1..=4 {
        numbers.publish(Int32 { data });
        others.publish(Int32 { data });
    }
    assert_eq!(received(), [4, 8]);
    assert_eq!(untouched.drain().len(), 4);
    interceptor.held.lock().unwrap().iter().for_each(InterceptedMessage::forward);
    assert_eq!(received(), [1]);

    graph.set_interceptor(None);
    numbers.publish(Int32 { data: 3 });
    assert_eq!(received(), [3]);
}

/// A topic that appears after the interceptor is intercepted, too; a latched message is retained as it was forwarded.
#[test]
fn later_topics_are_intercepted() {
    let graph = Graph::new();
    graph.set_interceptor(Some(Arc::new(Arithmetic::default())));
    let node = graph.node(NodeSettings::new("counter")).unwrap();
    let numbers = node.publisher::<Int32>("/numbers", Qos::latched(1)).unwrap();
    numbers.publish(Int32 { data: 2 });
    let late = node.mailbox::<Int32>("/numbers", Qos::latched(1)).unwrap();
    assert_eq!(late.latest().map(|message| message.data), Some(4));
}
