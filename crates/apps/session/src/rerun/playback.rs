//! Sensor data of a recording on the graph of the estimators.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};

use periplus_bags::files::{Bag, BagMessages, Now};
use periplus_bags::{BagTopic, Selection, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_graph::{Graph, Node, NodeSettings, Publisher, Qos, RawPublisher};
use periplus_msgs::Message as _;
use periplus_msgs::geometry_msgs::{Transform, TransformStamped, Vector3};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::tf2_msgs::TFMessage;

use super::error::RerunError;
use super::parameters::RerunKind;
use super::robot::RecordedRobot;
use super::timeline::{RerunClock, Timeline, stamp_of};
use crate::recorded::has_type;

/// Topics that control a node and that no rerun takes from a recording.
const CONTROL_TOPICS: [&str; 5] =
    ["/parameter_events", "/clock", "/rosout", "/slam_toolbox/feedback", "/bond"];

/// Node that plays.
const PLAYER: &str = "rerun_player";

/// Depth of the queues of `/tf` and `/tf_static`.
const TRANSFORM_DEPTH: usize = 1000;

/// Messages are counted in steps of this size before the caller is called again.
const MESSAGES_PER_STEP: u64 = 64;

/// Use of the messages of a topic.
enum Outlet {
    /// Transforms, without those of other estimators.
    Transforms { is_static: bool },
    /// Odometry, which becomes a transform.
    Odometry,
    /// Published as they are.
    Same(RawPublisher),
}

/// Player of a recording.
pub(super) struct Playback {
    graph: Graph,
    topics: Vec<BagTopic>,
    outlets: BTreeMap<usize, (Vec<Outlet>, Translation)>,
    messages: BagMessages,
    moving: Publisher<TFMessage>,
    fixed: Publisher<TFMessage>,
    robot: RecordedRobot,
    /// True to keep the transform that leads to the odometry frame.
    keeps_localization: bool,
    timeline: Timeline,
    /// Time of recording of the message that was played last \[ns\].
    log_ns: Arc<AtomicI64>,
    played: u64,
    broken: BTreeMap<usize, u64>,
    _node: Node,
}

impl Playback {
    /// Plays the transforms of a recording and all topics to which the nodes of the graph subscribe.
    pub(super) fn new(
        graph: &Graph,
        bag: &Bag,
        (kind, robot): (RerunKind, &RecordedRobot),
        timeline: Timeline,
    ) -> Result<Self, RerunError> {
        let subscribed: BTreeSet<String> = graph
            .topics()
            .into_iter()
            .filter(|topic| !topic.subscriptions.is_empty())
            .map(|topic| topic.name)
            .collect();
        let node = graph.node(NodeSettings::new(PLAYER).keep_names())?;
        let mut outlets = BTreeMap::new();
        let has_own_tf = |topic: &BagTopic| {
            ["tf", "tf_static"].contains(&topic.name.rsplit('/').next().unwrap_or_default())
        };
        let of_transforms =
            |topic: &BagTopic| has_type(topic, "TFMessage") || has_type(topic, "tfMessage");
        let has_tf = bag.topics().iter().any(|topic| of_transforms(topic) && has_own_tf(topic));
        for (index, topic) in bag.topics().iter().enumerate() {
            let Some(translation) = Translation::new(topic, Target::Ros2, &mut Diagnostics::new())
            else {
                continue;
            };
            let mut found = Vec::new();
            if of_transforms(topic) {
                if has_own_tf(topic) || !has_tf {
                    found.push(Outlet::Transforms { is_static: topic.name.ends_with("tf_static") });
                }
            } else {
                if robot.needs_odometry && has_type(topic, "Odometry") {
                    found.push(Outlet::Odometry);
                }
                // The costmaps take the map where Nav2 has it, whatever its name was.
                let is_map = robot.map_topic.as_ref() == Some(&topic.name);
                let name: &str =
                    if is_map && kind == RerunKind::Costmap { "/map" } else { &topic.name };
                if subscribed.contains(name) && is_input(kind, topic, robot) {
                    let own = translation.topic();
                    let hash = own.metadata.get("topic_type_hash").filter(|it| !it.is_empty());
                    let qos = if has_type(topic, "OccupancyGrid") {
                        Qos::latched(1)
                    } else {
                        Qos::reliable(100)
                    };
                    let publisher =
                        node.raw_publisher(name, &own.type_name, hash.map(String::as_str), qos);
                    // A topic of that name with another type is not the one that the nodes mean.
                    if let Ok(publisher) = publisher {
                        found.push(Outlet::Same(publisher));
                    }
                }
            }
            if !found.is_empty() {
                outlets.insert(index, (found, translation));
            }
        }
        let names = outlets.keys().map(|index| bag.topics()[*index].name.as_str());
        let messages = bag.messages(Selection::topics(names));
        Ok(Self {
            topics: bag.topics().to_vec(),
            outlets,
            messages,
            moving: node.publisher("/tf", Qos::reliable(TRANSFORM_DEPTH))?,
            fixed: node.publisher("/tf_static", Qos::latched(TRANSFORM_DEPTH))?,
            robot: robot.clone(),
            keeps_localization: kind == RerunKind::Costmap,
            timeline,
            log_ns: Arc::new(AtomicI64::new(timeline.span_ns.0)),
            played: 0,
            broken: BTreeMap::new(),
            graph: graph.clone(),
            _node: node,
        })
    }

    /// Returns the names of topics that the result does not repeat: sensor data, but not the map.
    pub(super) fn input_topics(&self) -> BTreeSet<String> {
        let names = self.outlets.values().flat_map(|(found, _)| found);
        names
            .filter_map(|outlet| match outlet {
                Outlet::Same(publisher) if !publisher.topic().ends_with("map") => {
                    Some(publisher.topic().to_owned())
                }
                _ => None,
            })
            .collect()
    }

    /// Returns the clock of the result; none if it is that of the graph.
    pub(super) fn log_clock(&self) -> Option<Now> {
        let log_ns = Arc::clone(&self.log_ns);
        match self.timeline.clock {
            RerunClock::Log => None,
            RerunClock::Stamps => Some(Box::new(move || log_ns.load(Ordering::Relaxed))),
        }
    }

    /// Plays some messages. Returns false at the end.
    pub(super) fn step(&mut self) -> Result<bool, RerunError> {
        for _ in 0..MESSAGES_PER_STEP {
            if !self.play_next()? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn play_next(&mut self) -> Result<bool, RerunError> {
        let Some(message) = self.messages.next().map_err(RerunError::Recording)? else {
            return Ok(false);
        };
        let (index, log_ns) = (message.topic, message.log_ns);
        let Some((outlets, translation)) = self.outlets.get_mut(&index) else { return Ok(true) };
        let Ok(data) = translation.translate(message.data) else {
            *self.broken.entry(index).or_default() += 1;
            return Ok(true);
        };
        let now_ns = self.graph.now_ns();
        let time_ns = match self.timeline.clock {
            RerunClock::Log => log_ns,
            RerunClock::Stamps => stamp_of(&self.topics[index], data).unwrap_or(now_ns),
        };
        self.log_ns.store(log_ns, Ordering::Relaxed);
        self.graph.advance_to(time_ns.max(now_ns));
        self.played += 1;
        for outlet in outlets {
            let is_whole = match outlet {
                Outlet::Same(publisher) => {
                    publisher.publish(data.to_vec());
                    true
                }
                Outlet::Transforms { is_static } => {
                    let message = TFMessage::decode_cdr(data).ok();
                    let publisher = if *is_static { &self.fixed } else { &self.moving };
                    let is_whole = message.is_some();
                    let kept = message.map(|it| kept(it, &self.robot, self.keeps_localization));
                    if let Some(kept) = kept.filter(|it| !it.transforms.is_empty()) {
                        publisher.publish(kept);
                    }
                    is_whole
                }
                Outlet::Odometry => match Odometry::decode_cdr(data) {
                    Ok(odometry) => {
                        if let Some(transform) = transform_of(odometry, &self.robot) {
                            self.moving.publish(TFMessage { transforms: vec![transform] });
                        }
                        true
                    }
                    Err(_) => false,
                },
            };
            if !is_whole {
                *self.broken.entry(index).or_default() += 1;
            }
        }
        self.graph.settle();
        Ok(true)
    }

    /// Returns the part of the recording that was played, 0 to 1.
    pub(super) fn part(&self) -> f32 {
        self.timeline.part(self.log_ns.load(Ordering::Relaxed))
    }

    /// Number of messages that were played.
    pub(super) fn count(&self) -> u64 {
        self.played
    }

    /// Returns damaged parts of the recording.
    pub(super) fn faults(&self) -> Vec<String> {
        let mut faults = self.messages.faults().to_vec();
        for (index, count) in &self.broken {
            faults.push(format!(
                "{count} messages on {} cannot be decoded",
                self.topics[*index].name
            ));
        }
        faults
    }
}

/// Returns true for a topic that is sensor data, not an estimate or a command of the recorded run.
fn is_input(kind: RerunKind, topic: &BagTopic, robot: &RecordedRobot) -> bool {
    if CONTROL_TOPICS.contains(&topic.name.as_str()) {
        return false;
    }
    match kind {
        RerunKind::Slam => topic.name == robot.scan_topic,
        // A pose that a user set is an input. The map is published once, before the first scan.
        RerunKind::Amcl => topic.name == robot.scan_topic || topic.name.ends_with("initialpose"),
        RerunKind::Costmap => true,
    }
}

/// Removes what another estimator has published: the transform that leads to the odometry frame.
fn kept(message: TFMessage, robot: &RecordedRobot, keeps_localization: bool) -> TFMessage {
    let plain = |frame: String| match frame.strip_prefix('/') {
        Some(rest) => rest.to_owned(),
        None => frame,
    };
    let transforms = message.transforms.into_iter().map(|mut it| {
        it.header.frame_id = plain(it.header.frame_id);
        it.child_frame_id = plain(it.child_frame_id);
        it
    });
    let is_kept =
        |it: &TransformStamped| keeps_localization || it.child_frame_id != robot.odom_frame;
    TFMessage { transforms: transforms.filter(is_kept).collect() }
}

/// Returns odometry as a transform; none for another robot's.
fn transform_of(odometry: Odometry, robot: &RecordedRobot) -> Option<TransformStamped> {
    let mut header = odometry.header;
    header.frame_id = header.frame_id.trim_start_matches('/').to_owned();
    if header.frame_id != robot.odom_frame {
        return None;
    }
    let pose = odometry.pose.pose;
    let translation = Vector3 { x: pose.position.x, y: pose.position.y, z: pose.position.z };
    Some(TransformStamped {
        header,
        child_frame_id: odometry.child_frame_id.trim_start_matches('/').to_owned(),
        transform: Transform { translation, rotation: pose.orientation },
    })
}

#[cfg(test)]
mod tests {
    use periplus_msgs::std_msgs::Header;

    use super::*;

    #[test]
    fn transforms_of_other_estimators_are_left_out() {
        let robot = RecordedRobot {
            scan_topic: "/scan".into(),
            odom_frame: "odom".into(),
            base_frame: "base".into(),
            needs_odometry: false,
            map_topic: None,
        };
        let edge = |parent: &str, child: &str| TransformStamped {
            header: Header::at(0, parent),
            child_frame_id: child.into(),
            transform: Transform::default(),
        };
        let message = TFMessage { transforms: vec![edge("map", "/odom"), edge("/odom", "base")] };
        let children = |keeps| {
            let kept = kept(message.clone(), &robot, keeps).transforms.into_iter();
            kept.map(|it| format!("{}/{}", it.header.frame_id, it.child_frame_id))
                .collect::<Vec<_>>()
        };
        assert_eq!(children(false), ["odom/base"]);
        assert_eq!(children(true), ["map/odom", "odom/base"]);
    }
}
