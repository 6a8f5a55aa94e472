//! Messages and transforms of a recording.

use std::collections::BTreeSet;
use std::fmt;
use std::path::PathBuf;

use periplus_bags::files::{Bag, BagError};
use periplus_bags::{BagTopic, Selection, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DQuat, DVec3, Pose2};
use periplus_msgs::Message;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::{Buffer, StampedTransform, TransformKind};

/// Minimum interval of the poses of a track \[ns\].
const MIN_TRACK_INTERVAL_NS: i64 = 20_000_000;

/// Common names of the base frame, in order of preference.
const BASE_FRAMES: [&str; 2] = ["base_footprint", "base_link"];

/// Reason for which a recording has no topic of scans.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScanTopicError {
    /// The recording has no scans.
    NoScans(PathBuf),
    /// The requested topic has no scans.
    NotOnTopic {
        /// Requested topic.
        topic: String,
        /// Topics with scans.
        others: Vec<String>,
    },
}

impl fmt::Display for ScanTopicError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoScans(path) => write!(f, "{} has no scans", path.display()),
            Self::NotOnTopic { topic, others } => {
                write!(f, "no scans on `{topic}`; topics with scans: {}", others.join(", "))
            }
        }
    }
}

impl std::error::Error for ScanTopicError {}

/// Returns the topic with the most scans, or the requested one. A preferred one is used if the recording has it.
///
/// # Errors
/// When there are no scans, or none on the requested topic; the message lists the topics with scans.
pub fn scan_topic(
    bag: &Bag,
    requested: Option<&str>,
    preferred: Option<&str>,
) -> Result<String, ScanTopicError> {
    let with_scans = || {
        let topics = bag.topics().iter().zip(bag.counts());
        topics.filter(|(topic, _)| has_type(topic, "LaserScan"))
    };
    let names: Vec<&str> = with_scans().map(|(topic, _)| topic.name.as_str()).collect();
    let named = |wanted: &str| {
        let same = |name: &&&str| name.trim_start_matches('/') == wanted.trim_start_matches('/');
        names.iter().find(same).map(|name| (*name).to_owned())
    };
    let preferred = preferred.filter(|_| requested.is_none());
    if let Some(topic) = preferred.and_then(named) {
        return Ok(topic);
    }
    match requested {
        Some(wanted) => named(wanted).ok_or_else(|| ScanTopicError::NotOnTopic {
            topic: wanted.to_owned(),
            others: names.iter().map(|name| (*name).to_owned()).collect(),
        }),
        None => with_scans()
            .max_by_key(|(_, count)| **count)
            .map(|(topic, _)| topic.name.clone())
            .ok_or_else(|| ScanTopicError::NoScans(bag.path().to_owned())),
    }
}

/// Compares the last part of the type; ROS 1 and ROS 2 differ in the rest.
#[must_use]
pub fn has_type(topic: &BagTopic, name: &str) -> bool {
    topic.type_name.rsplit('/').next() == Some(name)
}

/// Transforms of the whole recording.
pub struct RecordedFrames {
    /// The transforms.
    pub buffer: Buffer,
    /// Damaged parts.
    pub faults: Vec<String>,
    /// Child frames whose transforms are those of odometry messages, since no transform leads to them.
    pub from_odometry: BTreeSet<String>,
    /// First and last stamp of transforms that move \[ns\]; none without any.
    pub span_ns: Option<(i64, i64)>,
}

impl RecordedFrames {
    /// Reads all transforms, and odometry of frames without transforms.
    ///
    /// # Errors
    /// When the recording cannot be read.
    pub fn read(bag: &Bag) -> Result<Self, BagError> {
        let mut buffer = Buffer::new(i64::MAX);
        let mut span_ns: Option<(i64, i64)> = None;
        let mut extend = |stamp_ns: i64| {
            let (from, to) = span_ns.unwrap_or((stamp_ns, stamp_ns));
            span_ns = Some((from.min(stamp_ns), to.max(stamp_ns)));
        };
        let named = |name: &str| -> Vec<&str> {
            let topics = bag.topics().iter().filter(|topic| has_type(topic, name));
            topics.map(|topic| topic.name.as_str()).collect()
        };
        let mut transforms = named("TFMessage");
        transforms.extend(named("tfMessage"));
        let mut faults = each::<TFMessage>(bag, &transforms, |topic, message| {
            let kind = if topic.ends_with("tf_static") {
                TransformKind::Fixed
            } else {
                TransformKind::Moving
            };
            for it in message.transforms {
                let (t, q) = (it.transform.translation, it.transform.rotation);
                let stamped = StampedTransform {
                    parent: it.header.frame_id,
                    child: it.child_frame_id,
                    stamp_ns: it.header.stamp.ns(),
                    translation: DVec3::new(t.x, t.y, t.z),
                    rotation: DQuat::from_xyzw(q.x, q.y, q.z, q.w),
                };
                if kind == TransformKind::Moving {
                    extend(stamped.stamp_ns);
                }
                // Repeated and invalid transforms are refused, as in tf2.
                let _ = buffer.set(&stamped, topic, kind);
            }
        })?;
        let has_parent = |frame: &&str| buffer.parent_of(frame).is_some();
        let told: BTreeSet<String> =
            buffer.frames().filter(has_parent).map(str::to_owned).collect();
        let mut from_odometry = BTreeSet::new();
        faults.extend(each::<Odometry>(bag, &named("Odometry"), |topic, message| {
            let child = message.child_frame_id.trim_start_matches('/');
            // Transforms, if present, contain odometry and more.
            if told.contains(child) {
                return;
            }
            let (t, q) = (message.pose.pose.position, message.pose.pose.orientation);
            let stamped = StampedTransform {
                parent: message.header.frame_id.clone(),
                child: child.to_owned(),
                stamp_ns: message.header.stamp.ns(),
                translation: DVec3::new(t.x, t.y, t.z),
                rotation: DQuat::from_xyzw(q.x, q.y, q.z, q.w),
            };
            extend(stamped.stamp_ns);
            let _ = buffer.set(&stamped, topic, TransformKind::Moving);
            if !from_odometry.contains(child) {
                from_odometry.insert(child.to_owned());
            }
        })?);
        Ok(Self { buffer, faults, from_odometry, span_ns })
    }

    /// Poses of `frame` in `reference` at equal intervals, at most this number; none where transforms are missing.
    #[must_use]
    pub fn track(&self, reference: &str, frame: &str, max_count: usize) -> Vec<(i64, Pose2)> {
        let Some((from_ns, to_ns)) = self.span_ns else { return Vec::new() };
        if self.buffer.chain(reference, frame).is_none() {
            return Vec::new();
        }
        let intervals = i64::try_from(max_count.max(2) - 1).unwrap_or(i64::MAX);
        let step_ns = ((to_ns - from_ns) / intervals).max(MIN_TRACK_INTERVAL_NS);
        let mut poses = Vec::new();
        let mut time_ns = from_ns;
        while time_ns <= to_ns {
            // A lookup at zero is the latest transform.
            if let Ok(found) = self.buffer.lookup(reference, frame, time_ns.max(1)) {
                poses.push((time_ns, Pose2::from(found.target_from_source)));
            }
            time_ns += step_ns;
        }
        poses
    }

    /// Base frame that is connected to odometry: the given one, or one of the common names.
    #[must_use]
    pub fn base(&self, odom: &str, told: Option<&str>) -> Option<String> {
        let leads = |base: &&str| self.buffer.chain(odom, base).is_some();
        told.into_iter().chain(BASE_FRAMES).find(leads).map(str::to_owned)
    }
}

/// Decodes all messages of some topics; undecodable ones are counted in the returned faults.
///
/// # Errors
/// When the recording cannot be read.
pub fn each<M: Message>(
    bag: &Bag,
    names: &[&str],
    mut take: impl FnMut(&str, M),
) -> Result<Vec<String>, BagError> {
    each_at(bag, names, |topic, _, message| take(topic, message))
}

/// As [`each`], with the time of recording \[ns\].
///
/// # Errors
/// When the recording cannot be read.
pub fn each_at<M: Message>(
    bag: &Bag,
    names: &[&str],
    mut take: impl FnMut(&str, i64, M),
) -> Result<Vec<String>, BagError> {
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let mut findings = Diagnostics::new();
    let mut ways: Vec<Option<Translation>> = bag
        .topics()
        .iter()
        .map(|topic| {
            let is_wanted = names.contains(&topic.name.as_str());
            is_wanted.then(|| Translation::new(topic, Target::Ros2, &mut findings)).flatten()
        })
        .collect();
    let mut broken = 0;
    let mut messages = bag.messages(Selection::topics(names.iter().copied()));
    while let Some(message) = messages.next()? {
        let Some(way) = &mut ways[message.topic] else { continue };
        let decoded = way.translate(message.data).ok().and_then(|data| M::decode_cdr(data).ok());
        match decoded {
            Some(decoded) => take(&bag.topics()[message.topic].name, message.log_ns, decoded),
            None => broken += 1,
        }
    }
    let mut faults = messages.faults().to_vec();
    if broken > 0 {
        faults.push(format!("{broken} messages on {} cannot be decoded", names.join(", ")));
    }
    Ok(faults)
}
