//! `topic pub`.

use std::time::Duration;

use periplus_msgs::Format;
use periplus_os::{Stopwatch, sleep};
use serde_json::json;

use crate::session::{INTERRUPT_POLL_PERIOD, full_name};
use crate::{Failure, Outcome, QosRequest, Seen, Session, Values, clock, show};

/// Period of messages while waiting for subscribers.
const REPORT_PERIOD: Duration = Duration::from_secs(1);

/// Timeout for delivering the last message.
const FLUSH_TIMEOUT: Duration = Duration::from_secs(2);

/// Options of `topic pub`.
#[derive(Clone, Debug)]
pub struct Publish {
    /// `-r` \[Hz\].
    pub rate_hz: f64,
    /// `-t`, or 1 for `--once`; unlimited if `None`.
    pub times: Option<u64>,
    /// `-p`: print every Nth message; 0 for none.
    pub print: u64,
    /// `-w`: number of subscribers to wait for; defaults to one if `times` is set.
    pub wait_matching: Option<usize>,
    /// `--max-wait-time-secs`.
    pub most_wait: Option<Duration>,
    /// `--keep-alive`: time to stay alive after the last message.
    pub keep_alive: Duration,
    /// `-n`.
    pub node_name: Option<String>,
    /// `--qos-...`.
    pub qos: QosRequest,
}

impl Default for Publish {
    fn default() -> Self {
        Self {
            rate_hz: 1.0,
            times: None,
            print: 1,
            wait_matching: None,
            most_wait: None,
            keep_alive: Duration::from_millis(100),
            node_name: None,
            qos: QosRequest::default(),
        }
    }
}

/// Publishes a message once or periodically.
///
/// # Errors
/// When a name, type or value is unusable, no subscriber appears in time, or the output cannot be
/// written.
pub fn publish(
    session: &mut Session<'_>,
    topic: &str,
    type_name: &str,
    values: &str,
    options: &Publish,
) -> Outcome {
    let layout = session.types.message(type_name)?.clone();
    let values = Values::read(values)?;
    // Errors of the values are reported before the publisher is created.
    let mut message = values.message(&layout, clock::unix_ns())?;
    let topic = full_name(topic);
    let qos = options.qos.offer()?;
    let node = session.node(options.node_name.as_deref())?;
    let hash = session.types.registry().hash(layout.type_name());
    let publisher = node.raw_publisher(&topic, layout.type_name(), hash.as_deref(), qos)?;

    let wanted = options.wait_matching.unwrap_or(usize::from(options.times.is_some()));
    let listeners = |seen: &Seen| {
        let ends = seen.topic(&topic).map_or(&[][..], |topic| &topic.subscriptions);
        ends.iter().filter(|end| qos.incompatible_policies(&end.qos).is_empty()).count()
    };
    let is_met = |seen: &Seen| wanted == 0 || listeners(seen) >= wanted && publisher.is_heard();
    let waiting = Stopwatch::start();
    // No message during the first period.
    while !session.wait(Some(if wanted == 0 { Duration::ZERO } else { REPORT_PERIOD }), is_met)? {
        if options.most_wait.is_some_and(|most| waiting.elapsed() >= most) {
            return Err(Failure::failed(format!(
                "Timed out waiting for subscribers: expected {wanted} on {topic}, found {}",
                listeners(&session.network.seen())
            )));
        }
        session.say(&format!("Waiting for at least {wanted} matching subscription(s)..."));
    }

    if !session.json {
        writeln!(session.out, "publisher: beginning loop")?;
        session.out.flush()?;
    }
    let period = Duration::from_secs_f64(1.0 / options.rate_hz);
    let clock = Stopwatch::start();
    let mut count = 0_u64;
    while options.times.is_none_or(|times| count < times) {
        count += 1;
        message = values.message(&layout, clock::unix_ns()).unwrap_or(message);
        if options.print > 0 && count.is_multiple_of(options.print) {
            if session.json {
                session.put(&json!({ "count": count, "message": message.to_json() }))?;
            } else {
                writeln!(session.out, "publishing #{count}: {}\n", show::repr(&message))?;
                session.out.flush()?;
            }
        }
        let mut cdr = Vec::new();
        message
            .encode(Format::CDR, &mut cdr)
            .map_err(|error| Failure::failed(format!("the message cannot be sent: {error}")))?;
        publisher.publish(cdr);
        if options.times != Some(count) {
            let next = period.saturating_mul(u32::try_from(count).unwrap_or(u32::MAX));
            match pause(session, next.saturating_sub(clock.elapsed())) {
                Err(Failure::Interrupted) if options.times.is_none() => break,
                paused => paused?,
            }
        }
    }
    if !session.is_stopped() {
        pause(session, options.keep_alive)?;
    }
    let _ = session.network.flush(FLUSH_TIMEOUT);
    Ok(())
}

/// Waits for a time or an interrupt.
fn pause(session: &Session<'_>, time: Duration) -> Outcome {
    let clock = Stopwatch::start();
    loop {
        session.check_interrupted()?;
        let left = time.saturating_sub(clock.elapsed());
        if left.is_zero() {
            return Ok(());
        }
        sleep(left.min(INTERRUPT_POLL_PERIOD));
    }
}
