//! A recording played on a graph.

mod ahead;

use std::collections::BTreeSet;

use crate::{Selection, Target, Translation};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, Node, NodeSettings, Publisher, Qos, RawPublisher};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rosgraph_msgs::Clock;

use crate::files::profile::offer;
use crate::files::{Bag, BagError};
use ahead::Ahead;

/// How a recording is played.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaySettings {
    /// Seconds of the recording per second.
    pub rate: f64,
    /// Whether it begins again at its end.
    pub is_looped: bool,
    /// Which topics and times, by the names and times in the recording.
    pub selection: Selection,
    /// Rules `from:=to` for the names of topics.
    pub remaps: Vec<String>,
    /// How often `/clock` is told \[Hz of the recording's seconds\]; none for never.
    pub clock_hz: Option<f64>,
    /// Whether it waits for [`Player::set_paused`].
    pub is_paused: bool,
    /// So many messages are read ahead, but not more than 256 MiB.
    pub read_ahead: usize,
}

impl Default for PlaySettings {
    /// All of it, once, at its own pace, without a clock.
    fn default() -> Self {
        Self {
            rate: 1.0,
            is_looped: false,
            selection: Selection::default(),
            remaps: Vec::new(),
            clock_hz: None,
            is_paused: false,
            read_ahead: 1000,
        }
    }
}

/// Plays a recording. It reads no clock: it is told the time and publishes what is due.
pub struct Player {
    bag: Bag,
    settings: PlaySettings,
    node: Node,
    /// By topic of the recording.
    outlets: Vec<Option<(Translation, RawPublisher)>>,
    clock: Option<(Publisher<Clock>, i64)>,
    ahead: Ahead,
    /// Time of the caller and time of the recording that belong together \[ns\].
    anchor: Option<(i64, i64)>,
    start_ns: i64,
    /// Time of the recording \[ns\].
    now_ns: i64,
    /// When the clock is told next, in times of the recording \[ns\].
    tick_ns: i64,
    published: u64,
    findings: Diagnostics,
}

impl Player {
    /// Makes the publishers of a recording's topics, as they were offered. Topics that cannot be
    /// played are left out, and the findings say why.
    ///
    /// # Errors
    /// When a name or rule is not valid, a topic has another type already, or the rate is none.
    pub fn new(bag: Bag, graph: &Graph, settings: PlaySettings) -> Result<Self, BagError> {
        if !(settings.rate.is_finite() && settings.rate > 0.0) {
            let why = format!("{} is no rate: it has to be above 0", settings.rate);
            return Err(BagError::Settings(why));
        }
        if settings.clock_hz.is_some_and(|hz| !(hz.is_finite() && hz > 0.0 && hz <= 1e6)) {
            return Err(BagError::Settings("the clock needs a rate above 0".into()));
        }
        let mut node = NodeSettings::new("rosbag2_player");
        for rule in &settings.remaps {
            node = node.rule(rule);
        }
        let node = graph.node(node)?;
        let mut findings = Diagnostics::new();
        let selection = &settings.selection;
        let mut outlets = Vec::new();
        for topic in bag.topics() {
            let wanted = selection.topics.as_ref().is_none_or(|names| names.contains(&topic.name));
            if wanted && settings.clock_hz.is_some() && topic.name == "/clock" {
                let wrong = "the recording has a `/clock` of its own, which is not played";
                findings.push(
                    Diagnostic::warning("two-clocks", wrong)
                        .help("leave out --clock to play the one of the recording"),
                );
                outlets.push(None);
                continue;
            }
            let way =
                if wanted { Translation::new(topic, Target::Ros2, &mut findings) } else { None };
            outlets.push(match way {
                Some(way) if way.topic().encoding == "cdr" => {
                    let publisher = outlet(&node, &way)?;
                    Some((way, publisher))
                }
                _ => None,
            });
        }
        let clock = match settings.clock_hz {
            Some(hz) => Some((node.publisher("/clock", Qos::clock())?, (1e9 / hz).round() as i64)),
            None => None,
        };
        let (first_ns, _) = bag.span_ns().unwrap_or_default();
        let start_ns = first_ns.max(*selection.span_ns.start());
        let names = bag.topics().iter().zip(&outlets).filter(|(_, outlet)| outlet.is_some());
        let names: BTreeSet<String> = names.map(|(topic, _)| topic.name.clone()).collect();
        let mut settings = settings;
        settings.selection.topics = Some(names);
        let ahead = Ahead::start(bag.messages(settings.selection.clone()), settings.read_ahead);
        Ok(Self {
            bag,
            settings,
            node,
            outlets,
            clock,
            ahead,
            anchor: None,
            start_ns,
            now_ns: start_ns,
            tick_ns: start_ns,
            published: 0,
            findings,
        })
    }

    /// Publishes what is due at a time of the caller \[ns\]; the first call begins. Returns when there
    /// is something to do again, on the same clock: never while it is paused, as far as it knows
    /// (`i64::MAX`); none when it has come to its end.
    ///
    /// # Errors
    /// When the recording cannot be read on.
    pub fn advance_to(&mut self, wall_ns: i64) -> Result<Option<i64>, BagError> {
        if self.settings.is_paused {
            self.anchor = None;
            return Ok(Some(i64::MAX));
        }
        let mut anchor = *self.anchor.get_or_insert((wall_ns, self.now_ns));
        loop {
            let due_ns = self.bag_time(anchor, wall_ns);
            let next_ns = self.ahead.peek_ns()?;
            let Some(next_ns) = next_ns else {
                if !self.settings.is_looped || self.published == 0 {
                    self.now_ns = due_ns;
                    return Ok(None);
                }
                let messages = self.bag.messages(self.settings.selection.clone());
                self.ahead = Ahead::start(messages, self.settings.read_ahead);
                anchor = (wall_ns, self.start_ns);
                self.anchor = Some(anchor);
                self.tick_ns = self.start_ns;
                continue;
            };
            let tick_ns = if self.clock.is_some() { self.tick_ns } else { i64::MAX };
            let first_ns = next_ns.min(tick_ns);
            if first_ns > due_ns {
                self.now_ns = due_ns;
                return Ok(Some(self.wall_time(anchor, first_ns)));
            }
            if tick_ns <= next_ns {
                self.tick();
            } else {
                self.now_ns = next_ns;
                self.publish()?;
            }
        }
    }

    fn bag_time(&self, (wall_ns, bag_ns): (i64, i64), now_ns: i64) -> i64 {
        let passed = (now_ns - wall_ns) as f64 * self.settings.rate;
        bag_ns.saturating_add(passed as i64)
    }

    fn wall_time(&self, (wall_ns, bag_ns): (i64, i64), time_ns: i64) -> i64 {
        let ahead = time_ns.saturating_sub(bag_ns) as f64 / self.settings.rate;
        // Rounded up: a moment too early would find nothing due.
        wall_ns.saturating_add(ahead.ceil() as i64)
    }

    /// Tells the clock.
    fn tick(&mut self) {
        let Some((publisher, period_ns)) = &self.clock else { return };
        publisher.publish(Clock { clock: Time::of_ns(self.tick_ns) });
        self.tick_ns = self.tick_ns.saturating_add((*period_ns).max(1));
    }

    /// Publishes the next message.
    fn publish(&mut self) -> Result<bool, BagError> {
        let Some(message) = self.ahead.next()? else { return Ok(false) };
        self.now_ns = message.time_ns;
        let Some(Some((way, publisher))) = self.outlets.get_mut(message.topic) else {
            return Ok(true);
        };
        self.published += 1;
        if way.is_same() {
            publisher.publish(message.data);
            return Ok(true);
        }
        match way.translate(&message.data) {
            Ok(data) => publisher.publish(data.to_vec()),
            Err(error) => {
                let wrong =
                    format!("a message of `{}` cannot be played: {error}", way.topic().name);
                self.findings.push(Diagnostic::warning("bad-message", wrong));
            }
        }
        Ok(true)
    }

    /// Publishes the next message at once, also while paused. False at the end.
    ///
    /// # Errors
    /// When the recording cannot be read on.
    pub fn step(&mut self) -> Result<bool, BagError> {
        self.anchor = None;
        self.publish()
    }

    /// Stops or goes on.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.settings.is_paused = is_paused;
        self.anchor = None;
    }

    /// Whether it stands still.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.settings.is_paused
    }

    /// Goes on at another rate; one that is no number above 0 changes nothing.
    pub fn set_rate(&mut self, rate: f64) {
        if rate.is_finite() && rate > 0.0 {
            self.settings.rate = rate;
            self.anchor = None;
        }
    }

    /// Seconds of the recording per second.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.settings.rate
    }

    /// How far it is, as time of the recording \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.now_ns
    }

    /// How many messages it published.
    #[must_use]
    pub fn published(&self) -> u64 {
        self.published
    }

    /// The recording.
    #[must_use]
    pub fn bag(&self) -> &Bag {
        &self.bag
    }

    /// Its node.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.node
    }

    /// What was wrong since the last call.
    pub fn take_findings(&mut self) -> Diagnostics {
        std::mem::take(&mut self.findings)
    }
}

fn outlet(node: &Node, way: &Translation) -> Result<RawPublisher, BagError> {
    let topic = way.topic();
    let hash = topic.metadata.get("topic_type_hash").filter(|hash| !hash.is_empty());
    let qos = offer(&topic.offered_qos());
    Ok(node.raw_publisher(&topic.name, &topic.type_name, hash.map(String::as_str), qos)?)
}
