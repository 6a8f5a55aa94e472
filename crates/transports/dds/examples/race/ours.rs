//! Periplus as a sender and receiver; see [`super::peer`].

use std::io::{Read as _, Write as _};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

use periplus_dds::{DdsTransport, Settings};
use periplus_graph::{Graph, Io, Node, NodeSettings, Qos};
use periplus_msgs::Message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::PointStamped;
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2};

use super::load::Kind;

/// A message with a time stamp.
trait Stamped: Message + Clone {
    fn stamp(&mut self) -> &mut Time;
    fn time(&self) -> &Time;
}

macro_rules! stamped {
    ($($name:ty),*) => {$(
        impl Stamped for $name {
            fn stamp(&mut self) -> &mut Time {
                &mut self.header.stamp
            }
            fn time(&self) -> &Time {
                &self.header.stamp
            }
        }
    )*};
}

stamped!(PointStamped, LaserScan, PointCloud2);

/// Publishes or subscribes according to the arguments; with `loop COUNT PERIOD_US` it only wakes at
/// that rate.
pub(super) fn run(words: &[String]) -> Result<(), String> {
    if let [verb, count, period_us] = words
        && verb == "loop"
    {
        let number = |word: &String| word.parse::<u32>().map_err(|error| error.to_string());
        let period = Duration::from_micros(number(period_us)?.into());
        let count = number(count)?;
        repeat(count, period, || ());
        await_end();
        return Ok(());
    }
    let type_name = words.get(3).map_or("", String::as_str);
    match Kind::of_dds_type(type_name) {
        Some(Kind::Cloud) => take_part::<PointCloud2>(words),
        Some(Kind::Scan) => take_part::<LaserScan>(words),
        Some(Kind::Small) => take_part::<PointStamped>(words),
        None => Err(format!("there is no load of type `{type_name}`")),
    }
}

fn take_part<T: Stamped>(words: &[String]) -> Result<(), String> {
    let number = |place: usize| -> Result<u32, String> {
        let word = words.get(place).map_or("", String::as_str);
        word.parse().map_err(|_| format!("argument {place}, `{word}`, must be a number"))
    };
    let settings = Settings { domain_id: number(0)?, ..Settings::default() };
    let topic = words[2].trim_start_matches("rt").to_owned();
    let qos = Qos::reliable(number(4)? as usize);
    let failed = |error: periplus_graph::GraphError| error.to_string();
    let wire = DdsTransport::open(&settings).map_err(|error| error.to_string())?;
    let graph = Graph::live();
    wire.attach(&graph).map_err(|error| error.to_string())?;
    if words[1] == "sub" {
        let node = graph.node(NodeSettings::new("sub").bare()).map_err(failed)?;
        return subscribe::<T>(&node, &topic, qos);
    }
    let node = graph.node(NodeSettings::new("pub").bare()).map_err(failed)?;
    let publisher = node.publisher::<T>(&topic, qos).map_err(failed)?;
    let template = words.get(5).map_or("", String::as_str);
    let bytes = std::fs::read(template).map_err(|error| format!("{template}: {error}"))?;
    let mut message = T::decode_cdr(&bytes).map_err(|error| error.to_string())?;
    let (count, period) = (number(6)?, Duration::from_micros(number(7)?.into()));
    while !publisher.is_heard() {
        std::thread::sleep(Duration::from_millis(5));
    }
    // The other side may discover this program later than this program discovers it.
    std::thread::sleep(Duration::from_millis(700));
    repeat(count, period, || {
        let now_ns = unix_ns();
        let sec = i32::try_from(now_ns / 1_000_000_000).unwrap_or_default();
        *message.stamp() = Time { sec, nanosec: (now_ns % 1_000_000_000) as u32 };
        publisher.publish(message.clone());
    });
    await_end();
    for finding in wire.take_findings().iter() {
        eprintln!("{}", finding.message);
    }
    Ok(())
}

/// Calls a function `count` times and reports start and end.
fn repeat(count: u32, period: Duration, mut act: impl FnMut()) {
    say("begin");
    let mut next = Instant::now();
    for _ in 0..count {
        act();
        next += period;
        std::thread::sleep(next.saturating_duration_since(Instant::now()));
    }
    say(&format!("done {count}"));
}

#[derive(Default)]
struct Heard {
    latencies_us: Vec<f64>,
    span_ns: Option<(i64, i64)>,
}

fn subscribe<T: Stamped>(node: &Node, topic: &str, qos: Qos) -> Result<(), String> {
    let mut actor = node.actor(Heard::default());
    let react = |heard: &mut Heard, message: Arc<T>, _: &mut Io<'_, Heard>| {
        let now_ns = unix_ns();
        let Time { sec, nanosec } = *message.time();
        let sent_ns = i64::from(sec) * 1_000_000_000 + i64::from(nanosec);
        heard.latencies_us.push((now_ns - sent_ns) as f64 * 1e-3);
        heard.span_ns = Some((heard.span_ns.map_or(now_ns, |span| span.0), now_ns));
    };
    actor.subscribe::<T>(topic, qos, react).map_err(|error| error.to_string())?;
    say("ready");
    await_end();
    actor.with(|heard| {
        let (first_ns, last_ns) = heard.span_ns.unwrap_or_default();
        let latencies: String = heard.latencies_us.iter().map(|us| format!(" {us:.1}")).collect();
        say(&format!("got {}{latencies}", (last_ns - first_ns) as f64 * 1e-9));
    });
    Ok(())
}

fn unix_ns() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or_default()
}

fn say(words: &str) {
    println!("{words}");
    let _ = std::io::stdout().flush();
}

fn await_end() {
    let _ = std::io::stdin().read_to_end(&mut Vec::new());
}
