//! `periplus bag record`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use periplus_bags::files::{BagError, RecordSettings, Recorder, Storage, WriteSettings};
use periplus_graph::{Arguments, Node, NodeSettings, Policy, Qos, RawMailbox};
use periplus_msgs::TypeRegistry;
use periplus_os::{Machine, sleep, unix_ns};
use periplus_resources::Host as _;
use periplus_ros1::ros2_type;
use periplus_session::{LiveGraph, stop, with_version};

use super::options::RecordOptions;
use crate::error::CliError;
use crate::offered_qos::strongest_request;
use crate::terminal;

/// Period of discovery of new topics and of flushing old messages to the disk.
const POLL_PERIOD: Duration = Duration::from_millis(100);

/// Polling period of the clock.
const CLOCK_POLL_PERIOD: Duration = Duration::from_millis(2);

pub(super) fn run(options: &RecordOptions) -> Result<ExitCode, CliError> {
    if !options.all && options.topics.is_empty() && options.regex.is_none() {
        return Err(CliError::usage(
            "name topics, or record all with --all; see `periplus bag record --help`",
        ));
    }
    let mut live = options.network.open(Arguments::default())?;
    record(options, &mut live)?;
    Ok(ExitCode::SUCCESS)
}

fn record(options: &RecordOptions, live: &mut LiveGraph) -> Result<(), BagError> {
    let output = options.output.clone().unwrap_or_else(named_by_time);
    let offers = PublisherQos::default();
    let known = offers.clone();
    let settings = RecordSettings {
        // This node publishes nothing, so every received message was subscribed to.
        wanted: Box::new(|_| true),
        clock: (!options.use_sim_time).then(|| Box::new(unix_ns) as periplus_bags::files::Now),
        offered: Some(Box::new(move |topic| known.of(topic))),
        ..RecordSettings::all(WriteSettings {
            // The name that rosbag2 gives to the recorder.
            ros_distro: Machine.variable("ROS_DISTRO").unwrap_or_default(),
            custom_data: with_version(BTreeMap::new()),
            ..options.write.settings(&output, Storage::Mcap)
        })
    };
    let node = live.graph.node(NodeSettings::new("rosbag2_recorder"))?;
    if options.use_sim_time {
        live.follow_clock(&node)?;
    }
    let stop = stop::on_signal();
    let recorder = Recorder::start(&live.graph, &output, settings)?;
    let mut subscriptions = RecorderSubscriptions { node, offers, mailboxes: BTreeMap::new() };
    terminal::say(&format!("{}: recording; Ctrl-C ends it", output.display()));
    let mut ticks = 0;
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        if ticks % (POLL_PERIOD.as_millis() / CLOCK_POLL_PERIOD.as_millis()) == 0 {
            subscriptions.follow(options, &offered_topics(live))?;
            recorder.keep()?;
            live.print_findings();
        }
        ticks += 1;
        subscriptions.drop_read();
        sleep(CLOCK_POLL_PERIOD);
    }
    let recording = recorder.finish()?;
    live.print_findings();
    let (messages, topics) = (recording.info.messages(), recording.info.topics.len());
    terminal::say(&format!("{}: {messages} messages on {topics} topics", output.display()));
    if recording.dropped > 0 {
        terminal::complain(&format!(
            "{} messages were dropped: they arrived faster than the disk writes",
            recording.dropped
        ));
    }
    Ok(())
}

/// A topic with publishers on the network.
struct OfferedTopic {
    name: String,
    type_name: String,
    type_hash: Option<String>,
    /// QoS of its publishers.
    qos: Vec<Qos>,
}

/// Topics with publishers on ROS 2, or on ROS 1.
fn offered_topics(live: &LiveGraph) -> Vec<OfferedTopic> {
    let Some(ros1) = &live.ros1 else {
        let topics = live.wire.remote().topics.into_iter();
        let offered = topics.filter(|topic| !topic.publishers.is_empty()).filter_map(|topic| {
            Some(OfferedTopic {
                type_name: topic.type_names.first()?.clone(),
                type_hash: topic.publishers.iter().find_map(|one| one.type_hash.clone()),
                qos: topic.publishers.iter().map(|one| one.qos).collect(),
                name: topic.name,
            })
        });
        return offered.collect();
    };
    // A master that does not answer has no new topics.
    let state = ros1.client().system_state().unwrap_or_default();
    let offered = state.publishers.into_iter().filter_map(|(name, _)| {
        let type_name = ros2_type(state.topic_types.get(&name)?)?;
        let type_hash = TypeRegistry::builtin().hash(&type_name);
        Some(OfferedTopic { name, type_name, type_hash, qos: vec![Qos::reliable(100)] })
    });
    offered.collect()
}

/// QoS of the publishers of each topic, from discovery.
#[derive(Clone, Default)]
struct PublisherQos(Arc<Mutex<BTreeMap<String, Vec<Qos>>>>);

impl PublisherQos {
    fn of(&self, topic: &str) -> Vec<Qos> {
        let offers = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        offers.get(topic).cloned().unwrap_or_default()
    }

    fn note(&self, topic: &OfferedTopic) {
        let offered = topic.qos.clone();
        let mut offers = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        offers.insert(topic.name.clone(), offered);
    }
}

/// Subscriptions of the recorder.
struct RecorderSubscriptions {
    node: Node,
    offers: PublisherQos,
    /// By topic: requested QoS, and the subscription.
    mailboxes: BTreeMap<String, (Qos, RawMailbox)>,
}

impl RecorderSubscriptions {
    /// Subscribes to selected topics that are new, and again when a publisher appears that offers
    /// less than the requested QoS.
    fn follow(
        &mut self,
        options: &RecordOptions,
        offered: &[OfferedTopic],
    ) -> Result<(), BagError> {
        for topic in offered {
            let type_name = &topic.type_name;
            if !options.wants(&topic.name) {
                continue;
            }
            // Noted before the subscription, because its first message needs it.
            self.offers.note(topic);
            let before = self.mailboxes.get(&topic.name).map(|(asked, _)| *asked);
            let is_heard = |asked: Qos| {
                topic.qos.iter().all(|offer| offer.incompatible_policies(&asked).is_empty())
            };
            if before.is_some_and(is_heard) {
                continue;
            }
            let hash = topic.type_hash.as_deref();
            let qos = strongest_request(topic.qos.iter());
            if before == Some(qos) {
                // Other incompatibilities cannot be solved by a weaker request.
                continue;
            }
            let mailbox = self.node.raw_mailbox(&topic.name, type_name, hash, qos)?;
            let (reliability, durability) =
                (qos.policy_value(Policy::Reliability), qos.policy_value(Policy::Durability));
            terminal::say(&if before.is_none() {
                format!("recording {} ({type_name})", topic.name)
            } else {
                format!(
                    "subscribed to {} again as {reliability} and {durability}: not all of its publishers \
                     offer more",
                    topic.name
                )
            });
            // The old subscription is dropped after the new one exists, to lose few messages.
            self.mailboxes.insert(topic.name.clone(), (qos, mailbox));
        }
        Ok(())
    }

    /// The recorder taps the messages itself; these subscriptions only request the topics.
    fn drop_read(&self) {
        for (_, mailbox) in self.mailboxes.values() {
            drop(mailbox.drain());
        }
    }
}

impl RecordOptions {
    fn wants(&self, name: &str) -> bool {
        let same = |typed: &String| typed.trim_start_matches('/') == name.trim_start_matches('/');
        let is_hidden = name.split('/').any(|part| part.starts_with('_'));
        let is_named = self.topics.iter().any(same);
        let is_chosen =
            self.all || is_named || self.regex.as_ref().is_some_and(|regex| regex.is_match(name));
        let is_excluded = self.exclude.as_ref().is_some_and(|regex| regex.is_match(name))
            || self.exclude_topics.iter().any(same);
        is_chosen && !is_excluded && (!is_hidden || is_named || self.include_hidden_topics)
    }
}

/// Default name: `rosbag2_` and the UTC time, as `ros2 bag record` names its folders.
fn named_by_time() -> PathBuf {
    PathBuf::from(format!("rosbag2_{}", periplus_bags::files::stamp_name(unix_ns())))
}
