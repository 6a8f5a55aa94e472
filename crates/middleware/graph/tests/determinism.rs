//! Events are executed in the same order, in whatever order the nodes were created.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use periplus_graph::{Actor, Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::std_msgs::Int32;
use proptest::prelude::*;

/// A node that forwards the messages it receives with a smaller number, down to zero, and publishes
/// from a timer.
#[derive(Clone, Debug)]
struct Plan {
    hears: Vec<usize>,
    says: Vec<usize>,
    depth: usize,
    period_ns: i64,
}

fn plan() -> impl Strategy<Value = Plan> {
    let topics = || prop::collection::vec(0..4usize, 0..3);
    (topics(), topics(), 1..4usize, 3..20i64).prop_map(|(hears, says, depth, period_ns)| Plan {
        hears,
        says,
        depth,
        period_ns,
    })
}

type Log = Arc<Mutex<Vec<String>>>;

fn make(graph: &Graph, index: usize, plan: &Plan, log: &Log) -> Actor<Log> {
    let node = graph.node(NodeSettings::new(format!("node{index}"))).unwrap();
    let outs: Arc<[Publisher<Int32>]> = plan
        .says
        .iter()
        .map(|topic| node.publisher(&format!("topic{topic}"), Qos::reliable(1)).unwrap())
        .collect();
    let mut actor = node.actor(log.clone());
    for topic in &plan.hears {
        let (outs, topic) = (outs.clone(), *topic);
        actor
            .subscribe(
                &format!("topic{topic}"),
                Qos::reliable(plan.depth),
                move |log, message: Arc<Int32>, io| {
                    let line = format!("{} node{index} {topic} {}", io.now_ns(), message.data);
                    log.lock().unwrap().push(line);
                    // Two copies from each would grow without bound; a third of the number remains.
                    for out in outs.iter().filter(|_| message.data > 0) {
                        out.publish(Int32 { data: message.data / 3 });
                    }
                },
            )
            .unwrap();
    }
    actor
        .timer(plan.period_ns, move |log, io| {
            log.lock().unwrap().push(format!("{} node{index} tick", io.now_ns()));
            for out in outs.iter() {
                out.publish(Int32 { data: 9 });
            }
        })
        .unwrap();
    actor
}

/// Everything that happened in 60 ns, and the numbers of dropped messages.
fn run(plans: &[Plan], order: &[usize], storm: &[(i64, usize, i32)]) -> (Vec<String>, Vec<String>) {
    let graph = Graph::new();
    let log = Log::default();
    let mut actors: BTreeMap<usize, Actor<Log>> = BTreeMap::new();
    for index in order {
        actors.insert(*index, make(&graph, *index, &plans[*index], &log));
    }
    let outside = graph.node(NodeSettings::new("outside")).unwrap();
    let outs: Vec<Publisher<Int32>> = (0..4)
        .map(|topic| outside.publisher(&format!("topic{topic}"), Qos::reliable(1)).unwrap())
        .collect();
    for (time_ns, topic, data) in storm {
        graph.advance_to((*time_ns).max(graph.now_ns()));
        outs[*topic].publish(Int32 { data: *data });
    }
    graph.advance_to(60.max(graph.now_ns()));
    let mut counts = Vec::new();
    for topic in graph.traffic() {
        let mut ends = topic.subscriptions;
        ends.sort_by(|a, b| a.node.cmp(&b.node));
        for end in ends {
            counts.push(format!("{} {} {:?}", topic.topic, end.node, end.counts));
        }
    }
    let log = std::mem::take(&mut *log.lock().unwrap());
    (log, counts)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_order_of_making_nodes_does_not_matter(
        (plans, order) in prop::collection::vec(plan(), 1..5).prop_flat_map(|plans| {
            let order = Just((0..plans.len()).collect::<Vec<_>>()).prop_shuffle();
            (Just(plans), order)
        }),
        storm in prop::collection::vec((0..60i64, 0..4usize, 0..30i32), 0..20),
    ) {
        let straight: Vec<usize> = (0..plans.len()).collect();
        let (log, counts) = run(&plans, &straight, &storm);
        prop_assert_eq!(run(&plans, &order, &storm), (log, counts));
    }
}
