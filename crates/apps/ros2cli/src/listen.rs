//! Subscriptions of verbs.

use std::time::Duration;

use periplus_graph::{Node, Qos, RawMailbox, Sample};
use periplus_os::{Stopwatch, sleep};
use periplus_rosidl::InterfaceKind;

use crate::session::{advice, full_name};
use crate::types::full_type;
use crate::{Failure, Outcome, QosRequest, Seen, SeenTopic, Session};

/// Time without a publisher after which a warning is printed.
const WARNING_DELAY: Duration = Duration::from_millis(1_000);

/// Subscription to a topic.
pub(crate) struct Listener {
    /// Full name.
    pub(crate) topic: String,
    /// Message type.
    pub(crate) type_name: String,
    mailbox: RawMailbox,
    lost: u64,
}

impl Listener {
    /// Subscribes to a topic once it is published. Without a type, the type of the topic is used,
    /// and waiting times out if `is_impatient`.
    pub(crate) fn open(
        session: &mut Session<'_>,
        node: &Node,
        name: &str,
        type_name: Option<&str>,
        wish: &QosRequest,
        is_impatient: bool,
    ) -> Outcome<Self> {
        let topic = full_name(name);
        let given = type_name.map(|name| full_type(name, InterfaceKind::Message)).transpose()?;
        let found = await_topic(session, &topic, given.is_some(), is_impatient)?;
        let type_name = match given {
            Some(given) => given,
            None => only_type(&found)?,
        };
        if !found.types.is_empty() && !found.types.contains(&type_name) {
            session.say(&format!(
                "WARNING: {topic} is published as {}, not as {type_name}: no message will be received",
                found.types.join(", ")
            ));
        }
        let (qos, words) = wish.ask(Some(&found))?;
        if let Some(words) = words {
            session.say(&format!("WARNING: {words}"));
        }
        warn_of_misfits(session, &found, &qos);
        let hash = hash_of(session, &found, &type_name);
        let mailbox = node.raw_mailbox(&topic, &type_name, hash.as_deref(), qos)?;
        Ok(Self { topic, type_name, mailbox, lost: 0 })
    }

    /// Returns the messages received since the last call.
    pub(crate) fn drain(&self) -> Vec<Sample> {
        self.mailbox.drain()
    }

    /// Number of dropped messages, since the last call and in total.
    pub(crate) fn losses(&mut self) -> (u64, u64) {
        let all = self.mailbox.counts().dropped;
        let new = all - self.lost;
        self.lost = all;
        (new, all)
    }
}

/// Waits until at least one of the topics is published; returns those that are not yet, after a
/// warning. The wait is bounded if at least one is published.
pub(crate) fn await_any(session: &mut Session<'_>, topics: &[String]) -> Outcome<Vec<String>> {
    let is_there = |seen: &Seen, name: &String| is_published(seen, &full_name(name));
    if !session.wait(Some(WARNING_DELAY), |seen| topics.iter().all(|name| is_there(seen, name)))? {
        let seen = session.network.seen();
        for name in topics.iter().filter(|name| !is_there(&seen, name)) {
            let name = full_name(name);
            session.say(&format!("WARNING: topic [{name}] does not appear to be published yet"));
        }
        session.wait(None, |seen| topics.iter().any(|name| is_there(seen, name)))?;
    }
    let seen = session.network.seen();
    Ok(topics.iter().filter(|name| !is_there(&seen, name)).cloned().collect())
}

/// Returns true if the topic of this full name has a publisher.
pub(crate) fn is_published(seen: &Seen, topic: &str) -> bool {
    seen.topic(topic).is_some_and(|topic| !topic.publishers.is_empty())
}

/// Waits for a publisher of the topic.
fn await_topic(
    session: &mut Session<'_>,
    topic: &str,
    is_typed: bool,
    is_impatient: bool,
) -> Outcome<SeenTopic> {
    let is_published = |seen: &Seen| is_published(seen, topic);
    let is_known = |seen: &Seen| seen.topic(topic).is_some();
    if !session.wait(Some(WARNING_DELAY), is_published)? {
        session.say(&format!("WARNING: topic [{topic}] does not appear to be published yet"));
        if is_impatient && !is_typed && !session.look_for(is_known).1 {
            session.check_interrupted()?;
            let seen = session.network.seen();
            let near = advice(topic, seen.topics.iter().map(|topic| topic.name.as_str()));
            return Err(Failure::failed(format!(
                "could not determine the type of {topic}: it has no publisher and no \
                 subscriber{near} Give the type after the name to wait for it"
            )));
        }
        session.wait(None, is_published)?;
    }
    Ok(session.network.seen().topic(topic).cloned().unwrap_or_default())
}

/// Type of a topic with a single type.
pub(crate) fn only_type(topic: &SeenTopic) -> Outcome<String> {
    match topic.types.as_slice() {
        [one] => Ok(one.clone()),
        types => Err(Failure::failed(format!(
            "{} has more than one type, {}: give one of them after the name",
            topic.name,
            types.join(", ")
        ))),
    }
}

/// Warns about publishers whose QoS is incompatible with the requested one.
fn warn_of_misfits(session: &mut Session<'_>, topic: &SeenTopic, qos: &Qos) {
    for publisher in &topic.publishers {
        for policy in publisher.qos.incompatible_policies(qos) {
            let node = publisher.node.as_deref().unwrap_or("a program");
            session.say(&format!(
                "WARNING: {node} offers {} with {policy} {}, and {} is requested: its messages are not received",
                topic.name,
                publisher.qos.policy_value(policy),
                qos.policy_value(policy)
            ));
        }
    }
}

/// Type hash of the publishers; warns if it differs from ours.
fn hash_of(session: &mut Session<'_>, topic: &SeenTopic, type_name: &str) -> Option<String> {
    let ours = session.types.registry().hash(type_name);
    let theirs = topic.publishers.iter().find_map(|end| end.type_hash.clone());
    match (ours, theirs) {
        (Some(ours), Some(theirs)) if ours != theirs => {
            session.say(&format!(
                "WARNING: {type_name} is defined differently by the publishers of {} ({theirs}, here \
                 {ours}): what is shown may be wrong; give its package with `--interfaces DIR`",
                topic.name
            ));
            Some(theirs)
        }
        (ours, theirs) => theirs.or(ours),
    }
}

/// Result of handling a message.
pub(crate) enum Next {
    /// Continue.
    Go,
    /// Stop.
    Done,
}

/// Receives messages until `hear` stops or an interrupt. `hear` gets the index of the listener and
/// the time since the start; `tick` is called periodically, and may add listeners.
pub(crate) fn hear(
    session: &mut Session<'_>,
    listeners: &mut Vec<Listener>,
    pause: Duration,
    mut hear: impl FnMut(&mut Session<'_>, usize, &Sample, Duration) -> Outcome<Next>,
    mut tick: impl FnMut(&mut Session<'_>, &mut Vec<Listener>, Duration) -> Outcome<Next>,
) -> Outcome {
    let clock = Stopwatch::start();
    loop {
        for (place, listener) in listeners.iter().enumerate() {
            for sample in listener.drain() {
                if let Next::Done = hear(session, place, &sample, clock.elapsed())? {
                    return Ok(());
                }
            }
        }
        if let Next::Done = tick(session, listeners, clock.elapsed())? {
            return Ok(());
        }
        session.check_interrupted()?;
        sleep(pause);
    }
}
