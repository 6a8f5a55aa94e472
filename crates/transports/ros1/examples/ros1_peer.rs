//! A node of this project that publishes or counts messages, for `cargo xtask bench ros1`:
//!
//! ```text
//! ros1_peer pub|sub cloud|small SECONDS
//! ```
//!
//! A publisher waits for a subscriber. Both print one line of JSON: messages, CPU time \[s\].
#![allow(clippy::print_stdout, reason = "the output of the example")]
#![allow(clippy::disallowed_methods, reason = "a program at the edge: environment and sleeping")]

use std::error::Error;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::{Message, sensor_msgs, std_msgs};
use periplus_os::Machine;
use periplus_ros1::{MasterUse, Ros1Reach, Ros1Transport, Settings};

const TOPIC: &str = "/load";
const DEPTH: usize = 100;

/// CPU time of this process \[s\], in user and kernel.
fn cpu_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks: Vec<f64> = after.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    // The state is no number, so that `utime` and `stime` are 10 and 11.
    ticks.get(10..12).map_or(0.0, |both| both.iter().sum::<f64>() / 100.0)
}

fn publish<T: Message>(
    wire: &Ros1Transport,
    node: &Node,
    message: T,
    rate_hz: f64,
    duration: Duration,
) -> Result<(), Box<dyn Error>> {
    let publisher = node.publisher::<T>(TOPIC, Qos::reliable(DEPTH))?;
    while wire.subscribers_of(TOPIC).is_none_or(|all| all.is_empty()) {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(500));
    let before = cpu_s();
    let (start, message) = (Instant::now(), Arc::new(message));
    let mut count = 0_u32;
    while start.elapsed() < duration {
        publisher.publish_shared(&message);
        count += 1;
        let next = Duration::from_secs_f64(f64::from(count) / rate_hz);
        std::thread::sleep(next.saturating_sub(start.elapsed()));
    }
    std::thread::sleep(Duration::from_secs(1));
    println!("{{\"messages\": {count}, \"cpu_s\": {:.3}}}", cpu_s() - before);
    Ok(())
}

fn subscribe<T: Message>(
    node: &Node,
    bytes_of: impl Fn(&T) -> usize,
) -> Result<(), Box<dyn Error>> {
    let heard: Mailbox<T> = node.mailbox(TOPIC, Qos::reliable(DEPTH))?;
    let raw = node.raw_mailbox(TOPIC, T::TYPE_NAME, Some(T::TYPE_HASH), Qos::reliable(DEPTH))?;
    let bell = Arc::new((Mutex::new(false), Condvar::new()));
    let ringing = bell.clone();
    raw.on_message(move || {
        *ringing.0.lock().unwrap_or_else(PoisonError::into_inner) = true;
        ringing.1.notify_one();
    });
    let (count, bytes) = (AtomicU64::new(0), AtomicU64::new(0));
    let mut begun = None;
    let mut last: Option<Instant> = None;
    // It ends when no message came for two seconds.
    while last.is_none_or(|last| last.elapsed() < Duration::from_secs(2)) {
        let due = bell.0.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = bell.1.wait_timeout_while(due, Duration::from_millis(100), |due| !*due);
        *waited.unwrap_or_else(PoisonError::into_inner).0 = false;
        drop(raw.drain());
        for message in heard.drain() {
            begun.get_or_insert_with(cpu_s);
            last = Some(Instant::now());
            count.fetch_add(1, Ordering::Relaxed);
            bytes.fetch_add(bytes_of(&message) as u64, Ordering::Relaxed);
        }
    }
    let before = begun.unwrap_or_default();
    println!(
        "{{\"messages\": {}, \"cpu_s\": {:.3}, \"bytes\": {}}}",
        count.into_inner(),
        cpu_s() - before,
        bytes.into_inner()
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [way, load, seconds] = words.as_slice() else {
        return Err("ros1_peer pub|sub cloud|small SECONDS".into());
    };
    let duration = Duration::from_secs_f64(seconds.parse()?);
    let (settings, _) = Settings::from_environment(&Machine, Ros1Reach::Machine);
    let wire = Ros1Transport::open(&settings, MasterUse::Join)?;
    let graph = Graph::live();
    wire.attach(&graph)?;
    let node = graph.node(NodeSettings::new(format!("peer_{}", std::process::id())).bare())?;
    let cloud = || sensor_msgs::PointCloud2 {
        height: 1,
        width: 307_200,
        point_step: 32,
        row_step: 9_830_400,
        data: vec![7; 9_830_400],
        ..Default::default()
    };
    let small = || std_msgs::Float64MultiArray { data: vec![1.0; 8], ..Default::default() };
    match (way.as_str(), load.as_str()) {
        ("pub", "cloud") => publish(&wire, &node, cloud(), 30.0, duration),
        ("pub", _) => publish(&wire, &node, small(), 1000.0, duration),
        (_, "cloud") => subscribe(&node, |cloud: &sensor_msgs::PointCloud2| cloud.data.len()),
        _ => subscribe(&node, |one: &std_msgs::Float64MultiArray| 8 * one.data.len()),
    }
}
