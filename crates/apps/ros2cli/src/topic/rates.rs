//! `topic hz`, `bw` and `delay`: measured with the wall clock, printed once per second.

mod window;

use std::sync::Arc;
use std::time::Duration;

use periplus_graph::Node;
use periplus_msgs::{DynamicMessage, Format, Layout, Number, Value};
use serde_json::json;

use crate::failure::endless;
use crate::filter::Filter;
use crate::listen::{Listener, Next, await_any, hear, is_published};
use crate::session::full_name;
use crate::{Failure, Outcome, QosRequest, Seen, Session, clock};

use window::{Sizes, Spread, Window};

/// Polling period for messages, which limits the resolution of `hz`.
const POLL_PERIOD: Duration = Duration::from_millis(1);

/// Output period.
const REPORT_PERIOD: Duration = Duration::from_secs(1);

/// Options of `hz`, `bw` and `delay`.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    /// `-w`: maximum window size in messages.
    pub window: Option<usize>,
    /// `--filter`, of `hz`.
    pub filter: Option<String>,
    /// `--qos-...`.
    pub qos: QosRequest,
}

/// Default windows of `ros2 topic hz` and `bw`.
const DEFAULT_WINDOW: usize = 10_000;
const DEFAULT_BANDWIDTH_WINDOW: usize = 100;

/// Prints the rate of messages of one or several topics. Of several, it starts with those that are
/// published; the others are added when they appear.
///
/// # Errors
/// When a name or filter is not usable, or the output cannot be written.
pub fn hz(session: &mut Session<'_>, topics: &[String], options: &Rate) -> Outcome {
    let filter = options.filter.as_deref().map(Filter::read).transpose()?;
    let node = session.node(None)?;
    let size = options.window.unwrap_or(DEFAULT_WINDOW);
    let mut missing = match topics {
        [_] => Vec::new(),
        _ => await_any(session, topics)?,
    };
    let (mut listeners, mut measured) = (Vec::new(), Vec::new());
    for topic in topics.iter().filter(|topic| !missing.contains(topic)) {
        let listener = Listener::open(session, &node, topic, None, &options.qos, false)?;
        measured.push(Measured::new(session, &listener, filter.is_some(), size)?);
        listeners.push(listener);
    }
    let measured = std::cell::RefCell::new(measured);
    let mut told = Duration::ZERO;
    endless(hear(
        session,
        &mut listeners,
        POLL_PERIOD,
        |_, place, sample, at| {
            let one = &mut measured.borrow_mut()[place];
            if let (Some(filter), Some(layout)) = (&filter, &one.layout) {
                let Ok(cdr) = sample.cdr() else { return Ok(Next::Go) };
                let message = DynamicMessage::decode(layout, Format::CDR, cdr);
                if !message.is_ok_and(|message| filter.wants(&message).unwrap_or(false)) {
                    return Ok(Next::Go);
                }
            }
            one.window.arrive(at.as_secs_f64());
            Ok(Next::Go)
        },
        |session, listeners, now| {
            if now < told + REPORT_PERIOD {
                return Ok(Next::Go);
            }
            told = now;
            let mut measured = measured.borrow_mut();
            let spreads: Vec<_> =
                measured.iter_mut().map(|one| one.window.spread_if_new()).collect();
            tell_hz(session, listeners, &spreads, topics.len() > 1)?;
            let seen = if missing.is_empty() { Seen::default() } else { session.network.seen() };
            let (here, still) = std::mem::take(&mut missing)
                .into_iter()
                .partition(|name| is_published(&seen, &full_name(name)));
            missing = still;
            for topic in here {
                let listener = Listener::open(session, &node, &topic, None, &options.qos, false)?;
                measured.push(Measured::new(session, &listener, filter.is_some(), size)?);
                listeners.push(listener);
            }
            Ok(Next::Go)
        },
    ))
}

/// Topic of `hz`.
struct Measured {
    /// Message layout, for the filter.
    layout: Option<Arc<Layout>>,
    window: Window,
}

impl Measured {
    fn new(
        session: &Session<'_>,
        listener: &Listener,
        is_filtered: bool,
        size: usize,
    ) -> Outcome<Self> {
        let layout = match is_filtered {
            true => Some(session.types.message(&listener.type_name)?.clone()),
            false => None,
        };
        Ok(Self { layout, window: Window::new(size) })
    }
}

fn tell_hz(
    session: &mut Session<'_>,
    listeners: &[Listener],
    spreads: &[Option<Spread>],
    are_many: bool,
) -> Outcome {
    if session.json {
        for (listener, spread) in listeners.iter().zip(spreads) {
            let Some(spread) = spread else { continue };
            session.put(&json!({
                "topic": listener.topic,
                "rate_hz": spread.rate(),
                "min_s": spread.min,
                "max_s": spread.max,
                "std_dev_s": spread.deviation,
                "window": spread.count,
            }))?;
        }
        return Ok(());
    }
    match spreads {
        _ if are_many && spreads.iter().any(Option::is_some) => {
            session.out.write_all(table(listeners, spreads).as_bytes())?;
        }
        [Some(spread)] if !are_many => writeln!(
            session.out,
            "average rate: {:.3}\n\tmin: {:.3}s max: {:.3}s std dev: {:.5}s window: {}",
            spread.rate(),
            spread.min,
            spread.max,
            spread.deviation,
            spread.count
        )?,
        _ => {}
    }
    session.out.flush()?;
    Ok(())
}

/// Formats several topics as a table.
fn table(listeners: &[Listener], spreads: &[Option<Spread>]) -> String {
    let widest = listeners.iter().map(|listener| listener.topic.len()).max().unwrap_or(0).max(5);
    let head = format!(
        "{:widest$} {:>10} {:>9} {:>9} {:>9} {:>7}",
        "topic", "rate", "min_delta", "max_delta", "stddev", "window"
    );
    let mut text = format!("{head}\n{}\n", "=".repeat(head.len()));
    for (listener, spread) in listeners.iter().zip(spreads) {
        let Some(spread) = spread else { continue };
        text.push_str(&format!(
            "{:widest$} {:>10.3} {:>9.5} {:>9.5} {:>9.5} {:>7}\n",
            listener.topic,
            spread.rate(),
            spread.min,
            spread.max,
            spread.deviation,
            spread.count
        ));
    }
    text.push('\n');
    text
}

/// Prints the bandwidth in bytes per second.
///
/// # Errors
/// When a name is not usable, or the output cannot be written.
pub fn bandwidth(session: &mut Session<'_>, topic: &str, options: &Rate) -> Outcome {
    let node = session.node(None)?;
    let mut listeners = open(session, &node, &[topic.to_owned()], options)?;
    if !session.json {
        writeln!(session.out, "Subscribed to [{}]", listeners[0].topic)?;
        session.out.flush()?;
    }
    let sizes =
        std::cell::RefCell::new(Sizes::new(options.window.unwrap_or(DEFAULT_BANDWIDTH_WINDOW)));
    let mut told = Duration::ZERO;
    endless(hear(
        session,
        &mut listeners,
        POLL_PERIOD,
        |_, _, sample, at| {
            let size = sample.cdr().map_or(0, <[u8]>::len);
            sizes.borrow_mut().arrive(at.as_secs_f64(), size);
            Ok(Next::Go)
        },
        |session, listeners, now| {
            if now < told + REPORT_PERIOD {
                return Ok(Next::Go);
            }
            told = now;
            let sizes = sizes.borrow();
            let Some(flow) = sizes.flow(now.as_secs_f64()) else { return Ok(Next::Go) };
            if session.json {
                session.put(&json!({
                    "topic": listeners[0].topic,
                    "bytes_per_s": flow.rate,
                    "mean_bytes": flow.mean,
                    "min_bytes": flow.min,
                    "max_bytes": flow.max,
                    "window": flow.count,
                }))?;
            } else {
                writeln!(session.out, "{}", flow.describe())?;
                session.out.flush()?;
            }
            Ok(Next::Go)
        },
    ))
}

/// Prints the age of messages on arrival, by the stamps in their headers.
///
/// # Errors
/// When a name is not usable, messages have no header, or the output cannot be written.
pub fn delay(session: &mut Session<'_>, topic: &str, options: &Rate) -> Outcome {
    let node = session.node(None)?;
    let mut listeners = open(session, &node, &[topic.to_owned()], options)?;
    let layout = session.types.message(&listeners[0].type_name)?.clone();
    if layout.nested("header").is_none() {
        return Err(Failure::failed(format!(
            "messages of {} are {}, which has no header with a stamp",
            listeners[0].topic,
            layout.type_name()
        )));
    }
    let window = std::cell::RefCell::new(Window::new(options.window.unwrap_or(DEFAULT_WINDOW)));
    let mut told = Duration::ZERO;
    endless(hear(
        session,
        &mut listeners,
        POLL_PERIOD,
        |_, _, sample, _| {
            let stamp = sample.cdr().ok();
            let stamp =
                stamp.and_then(|cdr| DynamicMessage::decode(&layout, Format::CDR, cdr).ok());
            if let Some(stamp_ns) = stamp.as_ref().and_then(stamp_of) {
                window.borrow_mut().take((clock::unix_ns() - stamp_ns) as f64 * 1e-9);
            }
            Ok(Next::Go)
        },
        |session, listeners, now| {
            if now < told + REPORT_PERIOD {
                return Ok(Next::Go);
            }
            told = now;
            let mut window = window.borrow_mut();
            let Some(spread) = window.spread_if_new() else { return Ok(Next::Go) };
            if session.json {
                session.put(&json!({
                    "topic": listeners[0].topic,
                    "delay_s": spread.mean,
                    "min_s": spread.min,
                    "max_s": spread.max,
                    "std_dev_s": spread.deviation,
                    "window": spread.count,
                }))?;
            } else {
                writeln!(
                    session.out,
                    "average delay: {:.3}\n\tmin: {:.3}s max: {:.3}s std dev: {:.5}s window: {}",
                    spread.mean, spread.min, spread.max, spread.deviation, spread.count
                )?;
                session.out.flush()?;
            }
            Ok(Next::Go)
        },
    ))
}

fn stamp_of(message: &DynamicMessage) -> Option<i64> {
    let part = |path| match message.get(path) {
        Some(Value::Number(Number::I32(number))) => Some(i64::from(number)),
        Some(Value::Number(Number::U32(number))) => Some(i64::from(number)),
        _ => None,
    };
    Some(part("header.stamp.sec")? * 1_000_000_000 + part("header.stamp.nanosec")?)
}

fn open(
    session: &mut Session<'_>,
    node: &Node,
    topics: &[String],
    options: &Rate,
) -> Outcome<Vec<Listener>> {
    let mut listeners = Vec::new();
    for topic in topics {
        listeners.push(Listener::open(session, node, topic, None, &options.qos, false)?);
    }
    Ok(listeners)
}
