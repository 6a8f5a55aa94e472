//! Playback of a bag on a graph.

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

/// Settings of playback.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaySettings {
    /// Playback rate: seconds of the bag per second.
    pub rate: f64,
    /// True to restart at the end.
    pub is_looped: bool,
    /// Topics and times to play, by their names and times in the bag.
    pub selection: Selection,
    /// Remapping rules `from:=to` for topic names.
    pub remaps: Vec<String>,
    /// Rate of `/clock` \[Hz in bag time\]; none for no clock.
    pub clock_hz: Option<f64>,
    /// True to start paused.
    pub is_paused: bool,
    /// Maximum number of messages read ahead; at most 256 MiB.
    pub read_ahead: usize,
}

impl Default for PlaySettings {
    /// The whole bag once, at rate 1, without a clock.
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

/// Plays a bag. It reads no clock: the caller advances its time.
pub struct Player {
    bag: Bag,
    settings: PlaySettings,
    node: Node,
    /// Conversion and publisher of each topic of the bag.
    outlets: Vec<Option<(Translation, RawPublisher)>>,
    clock: Option<(Publisher<Clock>, i64)>,
    ahead: Ahead,
    /// Corresponding caller time and bag time \[ns\].
    anchor: Option<(i64, i64)>,
    start_ns: i64,
    /// Current bag time \[ns\].
    now_ns: i64,
    /// Bag time of the next clock message \[ns\].
    tick_ns: i64,
    published: u64,
    findings: Diagnostics,
}

impl Player {
    /// Creates the publishers of the topics with their recorded QoS. Topics that cannot be played
    /// are skipped with a finding.
    ///
    /// # Errors
    /// When a name or rule is not valid, a topic has another type already, or the rate is
    /// not positive.
    pub fn new(bag: Bag, graph: &Graph, settings: PlaySettings) -> Result<Self, BagError> {
        if !(settings.rate.is_finite() && settings.rate > 0.0) {
            let why = format!("the rate {} is not valid: it must be above 0", settings.rate);
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
                let wrong = "the bag has its own `/clock`, which is not played";
                findings.push(
                    Diagnostic::warning("two-clocks", wrong)
                        .help("omit --clock to play the one of the bag"),
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

    /// Publishes what is due at a caller time \[ns\]; the first call starts playback. Returns the
    /// caller time of the next call: `i64::MAX` while paused, none at the end.
    ///
    /// # Errors
    /// When the bag becomes unreadable.
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
        // Rounded up: at an earlier time nothing would be due.
        wall_ns.saturating_add(ahead.ceil() as i64)
    }

    /// Publishes the clock.
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
    /// When the bag becomes unreadable.
    pub fn step(&mut self) -> Result<bool, BagError> {
        self.anchor = None;
        self.publish()
    }

    /// Pauses or resumes.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.settings.is_paused = is_paused;
        self.anchor = None;
    }

    /// True while paused.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.settings.is_paused
    }

    /// Changes the rate; invalid rates are ignored.
    pub fn set_rate(&mut self, rate: f64) {
        if rate.is_finite() && rate > 0.0 {
            self.settings.rate = rate;
            self.anchor = None;
        }
    }

    /// Playback rate.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.settings.rate
    }

    /// Current bag time \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.now_ns
    }

    /// Number of messages published.
    #[must_use]
    pub fn published(&self) -> u64 {
        self.published
    }

    /// The bag.
    #[must_use]
    pub fn bag(&self) -> &Bag {
        &self.bag
    }

    /// The player's node.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.node
    }

    /// Returns the findings since the last call.
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
