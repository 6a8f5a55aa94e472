//! `twist_mux`: the velocity command of the source with the highest priority.
//!
//! Source: `twist_mux.cpp` and `topic_handle.hpp` of `twist_mux`.

use std::collections::BTreeMap;

use periplus_graph::{Mailbox, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::std_msgs::Bool;
use serde_json::Value;

use super::{Done, Task, TaskContext};
use crate::bringup::parameters::{NamedParameters, number_of, text_of};

/// A source of commands, or a lock.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct MuxTopic {
    pub(crate) name: String,
    pub(crate) topic: String,
    /// Time after which a message expires \[s\]; 0 for never.
    pub(crate) timeout_s: f64,
    pub(crate) priority: i64,
}

/// Sources and locks of a `twist_mux`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct MuxTopics {
    pub(crate) topics: Vec<MuxTopic>,
    pub(crate) locks: Vec<MuxTopic>,
}

impl MuxTopics {
    /// Reads the parameters of ROS 2: `topics.<name>.topic`, `timeout`, `priority`.
    pub(crate) fn of_parameters(named: &NamedParameters) -> Self {
        let group = |group: &str| {
            let mut names: Vec<&str> = named
                .keys()
                .filter_map(|key| key.strip_prefix(group)?.strip_prefix('.')?.split('.').next())
                .collect();
            names.dedup();
            let one = |name: &str| {
                let of = |part: &str| format!("{group}.{name}.{part}");
                let number = |part: &str| number_of(named, &of(part)).unwrap_or_default();
                #[expect(clippy::cast_possible_truncation, reason = "priorities are 0 to 255")]
                let priority = number("priority") as i64;
                MuxTopic {
                    name: name.to_owned(),
                    topic: text_of(named, &of("topic")).unwrap_or_default(),
                    timeout_s: number("timeout"),
                    priority,
                }
            };
            names.into_iter().map(one).filter(|one| !one.topic.is_empty()).collect()
        };
        Self { topics: group("topics"), locks: group("locks") }
    }

    /// Reads the lists of ROS 1 in the parameter server.
    pub(crate) fn of_server(server: &BTreeMap<String, Value>, node: &str) -> Self {
        let list = |name: &str| {
            let items = server.get(&format!("{node}/{name}")).and_then(Value::as_array);
            let one = |item: &Value| MuxTopic {
                name: item["name"].as_str().unwrap_or_default().to_owned(),
                topic: item["topic"].as_str().unwrap_or_default().to_owned(),
                timeout_s: item["timeout"].as_f64().unwrap_or_default(),
                priority: item["priority"].as_i64().unwrap_or_default(),
            };
            items.into_iter().flatten().map(one).filter(|one| !one.topic.is_empty()).collect()
        };
        Self { topics: list("topics"), locks: list("locks") }
    }
}

/// Input of one type.
enum MuxInput {
    Plain(Mailbox<Twist>),
    Stamped(Mailbox<TwistStamped>),
}

enum MuxOutput {
    Plain(Publisher<Twist>),
    Stamped(Publisher<TwistStamped>),
}

/// A source with the time of its last message \[ns\].
struct Source {
    topic: MuxTopic,
    input: MuxInput,
    last_ns: Option<i64>,
}

struct Lock {
    topic: MuxTopic,
    input: Mailbox<Bool>,
    last_ns: Option<i64>,
    is_set: bool,
}

/// Multiplexer of velocity commands.
pub(crate) struct TwistMux {
    sources: Vec<Source>,
    locks: Vec<Lock>,
    output: MuxOutput,
}

impl TwistMux {
    /// Creates the multiplexer; with `is_stamped` its commands are `TwistStamped`.
    ///
    /// # Errors
    /// A message when a topic cannot be created.
    pub(crate) fn new(node: &Node, topics: MuxTopics, is_stamped: bool) -> Result<Self, String> {
        let qos = Qos::reliable(10);
        let made = || -> Result<Self, periplus_graph::GraphError> {
            let source = |topic: MuxTopic| {
                let input = if is_stamped {
                    MuxInput::Stamped(node.mailbox(&topic.topic, qos)?)
                } else {
                    MuxInput::Plain(node.mailbox(&topic.topic, qos)?)
                };
                Ok(Source { topic, input, last_ns: None })
            };
            let lock = |topic: MuxTopic| {
                let input = node.mailbox(&topic.topic, Qos::reliable(1))?;
                Ok(Lock { topic, input, last_ns: None, is_set: false })
            };
            Ok(Self {
                sources: topics.topics.into_iter().map(source).collect::<Result<_, _>>()?,
                locks: topics.locks.into_iter().map(lock).collect::<Result<_, _>>()?,
                output: if is_stamped {
                    MuxOutput::Stamped(node.publisher("cmd_vel_out", qos)?)
                } else {
                    MuxOutput::Plain(node.publisher("cmd_vel_out", qos)?)
                },
            })
        };
        made().map_err(|error| error.to_string())
    }

    /// Returns the highest priority of the active locks.
    fn lock_priority(&self, now_ns: i64) -> i64 {
        let active = self.locks.iter().filter(|lock| {
            // A lock with a timeout locks also when its messages stop.
            lock.is_set || is_expired(&lock.topic, lock.last_ns, now_ns)
        });
        active.map(|lock| lock.topic.priority).max().unwrap_or(0)
    }

    /// Returns true if a source is the one whose commands pass.
    fn passes(&self, index: usize, now_ns: i64) -> bool {
        let lock = self.lock_priority(now_ns);
        let fresh = self.sources.iter().enumerate().filter(|(_, source)| {
            source.last_ns.is_some()
                && !is_expired(&source.topic, source.last_ns, now_ns)
                && source.topic.priority >= lock
        });
        let best = fresh.max_by_key(|(index, source)| {
            // Of equal priorities the first one passes.
            (source.topic.priority, std::cmp::Reverse(*index))
        });
        best.is_some_and(|(best, _)| best == index)
    }
}

fn is_expired(topic: &MuxTopic, last_ns: Option<i64>, now_ns: i64) -> bool {
    #[expect(clippy::cast_precision_loss, reason = "seconds")]
    let age_s = last_ns.map_or(f64::INFINITY, |last_ns| (now_ns - last_ns) as f64 * 1e-9);
    topic.timeout_s > 0.0 && age_s > topic.timeout_s
}

impl Task for TwistMux {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        for lock in &mut self.locks {
            if let Some(message) = lock.input.latest() {
                (lock.is_set, lock.last_ns) = (message.data, Some(stage.now_ns));
            }
        }
        for index in 0..self.sources.len() {
            let (plain, stamped) = match &self.sources[index].input {
                MuxInput::Plain(inbox) => (inbox.latest(), None),
                MuxInput::Stamped(inbox) => (None, inbox.latest()),
            };
            if plain.is_none() && stamped.is_none() {
                continue;
            }
            self.sources[index].last_ns = Some(stage.now_ns);
            if !self.passes(index, stage.now_ns) {
                continue;
            }
            match &self.output {
                MuxOutput::Plain(output) => {
                    plain.iter().for_each(|twist| output.publish_shared(twist));
                }
                MuxOutput::Stamped(output) => {
                    stamped.iter().for_each(|twist| output.publish_shared(twist));
                }
            }
        }
        Done::No
    }

    fn time_went_back(&mut self, by_ns: i64) {
        let lasts = self.sources.iter_mut().map(|source| &mut source.last_ns);
        let locks = self.locks.iter_mut().map(|lock| &mut lock.last_ns);
        lasts.chain(locks).flatten().for_each(|last_ns| *last_ns -= by_ns);
    }
}

#[cfg(test)]
mod tests {
    use periplus_graph::{Graph, NodeSettings};

    use super::*;

    fn topic(name: &str, priority: i64) -> MuxTopic {
        MuxTopic { name: name.into(), topic: name.into(), timeout_s: 0.5, priority }
    }

    #[test]
    fn the_higher_priority_passes_until_it_expires() {
        let graph = Graph::new();
        let node = graph.node(NodeSettings::new("twist_mux")).unwrap();
        let other = graph.node(NodeSettings::new("other")).unwrap();
        let lock = MuxTopic { timeout_s: 0.0, ..topic("stop", 255) };
        let topics =
            MuxTopics { topics: vec![topic("joy", 10), topic("nav", 1)], locks: vec![lock] };
        let mut mux = TwistMux::new(&node, topics, false).unwrap();
        let qos = Qos::reliable(10);
        let joy = other.publisher::<Twist>("joy", qos).unwrap();
        let nav = other.publisher::<Twist>("nav", qos).unwrap();
        let stop = other.publisher::<Bool>("stop", qos).unwrap();
        let out = other.mailbox::<Twist>("cmd_vel_out", qos).unwrap();
        let speed = |x: f64| {
            let mut twist = Twist::default();
            twist.linear.x = x;
            twist
        };
        let search = periplus_sim::Search::default();
        let mut run = |ms: i64| -> Vec<f64> {
            let mut said = Vec::new();
            graph.settle();
            let mut stage = TaskContext {
                graph: &graph,
                now_ns: ms * 1_000_000,
                simulation: None,
                search: &search,
                said: &mut said,
                has_printed: false,
            };
            mux.work(&mut stage);
            graph.settle();
            out.drain().iter().map(|twist| twist.linear.x).collect()
        };
        nav.publish(speed(1.0));
        assert_eq!(run(1000), [1.0]);
        joy.publish(speed(2.0));
        nav.publish(speed(1.0));
        assert_eq!(run(1100), [2.0]);
        nav.publish(speed(1.0));
        assert!(run(1600).is_empty());
        nav.publish(speed(1.0));
        assert_eq!(run(1601), [1.0]);
        stop.publish(Bool { data: true });
        nav.publish(speed(1.0));
        assert!(run(1700).is_empty());
    }

    #[test]
    fn lists_of_ros_1() {
        let list = serde_json::json!([{"name": "joy", "topic": "joy_vel", "timeout": 0.5, "priority": 10}]);
        let server = [("/twist_mux/topics".to_owned(), list)].into();
        let topics = MuxTopics::of_server(&server, "/twist_mux").topics;
        assert_eq!((topics[0].topic.as_str(), topics[0].priority), ("joy_vel", 10));
    }
}
