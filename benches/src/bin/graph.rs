//! Cost of a message on the graph: `cargo run --release -p periplus-benches --bin graph [RESULT.json]`.
//!
//! Each figure is the fastest of several turns.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that measures"
)]

use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Publisher, Qos, Sample, Sink, TopicInfo};
use periplus_msgs::geometry_msgs::Twist;
use periplus_msgs::sensor_msgs::PointCloud2;
use serde_json::json;

const TURNS: usize = 7;

/// Bytes of a cloud of 640 x 480 points of 32 bytes.
const CLOUD_BYTES: usize = 640 * 480 * 32;

/// Nanoseconds of one of `count` calls, in the fastest turn.
fn fastest_ns(count: u32, mut call: impl FnMut()) -> f64 {
    let turn = |_| {
        let start = Instant::now();
        for _ in 0..count {
            call();
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(count)
    };
    (0..TURNS).map(turn).fold(f64::INFINITY, f64::min)
}

struct Counter(Arc<AtomicU64>);

impl Sink for Counter {
    fn wants(&self, topic: &TopicInfo) -> bool {
        topic.name == "/tapped"
    }

    fn take(&self, _: &TopicInfo, sample: &Sample) {
        self.0.fetch_add(sample.sequence, Ordering::Relaxed);
    }
}

fn twist() -> Twist {
    let mut twist = Twist::default();
    twist.linear.x = black_box(0.5);
    twist
}

fn main() -> Result<(), Box<dyn Error>> {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("source"))?;
    let publisher = |topic: &str| node.publisher::<Twist>(topic, Qos::reliable(10));
    let listen = |topic: &str| -> Result<Vec<Mailbox<Twist>>, Box<dyn Error>> {
        (0..3).map(|_| Ok(node.mailbox(topic, Qos::reliable(10))?)).collect()
    };

    let unheard = publisher("unheard")?;
    let unheard_ns = fastest_ns(1_000_000, || unheard.publish(twist()));

    let heard = publisher("heard")?;
    let boxes = listen("heard")?;
    let mailboxes_ns = fastest_ns(200_000, || heard.publish(twist()));
    let mailboxes_read_ns = fastest_ns(200_000, || {
        heard.publish(twist());
        for mailbox in &boxes {
            black_box(mailbox.latest());
        }
    });

    let taken = Arc::new(AtomicU64::new(0));
    graph.tap(Box::new(Counter(taken.clone())));
    let tapped = publisher("tapped")?;
    let tap_ns = fastest_ns(200_000, || tapped.publish(twist()));
    assert!(taken.load(Ordering::Relaxed) > 0, "the tap heard something");

    let reactions_ns = reactions(&graph, publisher("reacted")?)?;
    let cloud_ns = clouds(&node)?;

    let result = json!({
        "publish_unheard_ns": unheard_ns,
        "publish_to_3_mailboxes_ns": mailboxes_ns,
        "publish_to_3_mailboxes_and_read_ns": mailboxes_read_ns,
        "publish_to_a_tap_ns": tap_ns,
        "publish_to_3_callbacks_and_run_them_ns": reactions_ns,
        "publish_cloud_of_9.8_MB_to_3_mailboxes_ns": cloud_ns,
    });
    println!("{result:#}");
    if let Some(path) = std::env::args_os().nth(1) {
        std::fs::write(path, format!("{result:#}\n"))?;
    }
    Ok(())
}

/// A message to three nodes that react, and their reactions.
fn reactions(graph: &Graph, publisher: Publisher<Twist>) -> Result<f64, Box<dyn Error>> {
    let mut actors = Vec::new();
    for index in 0..3 {
        let mut actor = graph.node(NodeSettings::new(format!("listener{index}")))?.actor(0.0);
        actor.subscribe("reacted", Qos::reliable(10), |sum, message: Arc<Twist>, _| {
            *sum += message.linear.x;
        })?;
        actors.push(actor);
    }
    let ns = fastest_ns(100_000, || {
        publisher.publish(twist());
        graph.settle();
    });
    assert!(actors.iter().all(|actor| actor.with(|sum| *sum > 0.0)), "all reacted");
    Ok(ns)
}

/// A large message to three mailboxes; all get the one that was published.
fn clouds(node: &Node) -> Result<f64, Box<dyn Error>> {
    let publisher = node.publisher::<PointCloud2>("cloud", Qos::sensor_data())?;
    let boxes = (0..3)
        .map(|_| node.mailbox::<PointCloud2>("cloud", Qos::sensor_data()))
        .collect::<Result<Vec<_>, _>>()?;
    let cloud = PointCloud2 { data: vec![1; CLOUD_BYTES], ..PointCloud2::default() };
    let bytes = cloud.data.as_ptr();
    publisher.publish(cloud);
    let got: Vec<Arc<PointCloud2>> = boxes.iter().filter_map(Mailbox::latest).collect();
    assert!(
        got.len() == 3 && got.iter().all(|one| one.data.as_ptr() == bytes),
        "nothing is copied"
    );
    Ok(fastest_ns(100_000, || publisher.publish_shared(&got[0])))
}
