//! Scans of a recording, with odometry from its transforms.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use periplus_bags::files::{Bag, BagError};
use periplus_bags::{BagTopic, Selection, Target, Translation};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::{DQuat, DVec3, Pose, Pose2};
use periplus_msgs::Message;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::{Buffer, StampedTransform, TransformKind};
use periplus_tf_ros::laser_scan;

use super::{Log, LogOptions, LoggedScan};
use crate::error::CliError;
use crate::terminal;

/// Common names of the base frame, in order of preference.
const BASE_FRAMES: [&str; 2] = ["base_footprint", "base_link"];

/// Reads a recording and prints its findings.
pub(super) fn read(path: &Path, options: &LogOptions) -> Result<Log, CliError> {
    let bag = crate::paths::bag(path)?;
    let findings = bag.findings();
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())?;
    Ok(scans(&bag, path, options)?)
}

fn scans(bag: &Bag, path: &Path, options: &LogOptions) -> Result<Log, String> {
    let topic = scan_topic(bag, path, options)?;
    let frames = Frames::read(bag).map_err(|why| why.to_string())?;
    let mut log = Log { kind: format!("recording, {topic}"), ..Log::default() };
    if !bag.is_whole() {
        log.faults.push(format!("{} was not closed properly", path.display()));
    }
    log.faults.extend(frames.faults.iter().cloned());
    let base = options
        .base_frame
        .clone()
        .or_else(|| frames.base(&options.odom_frame, options.told_base.as_deref()));
    if base.is_none() {
        log.warnings.push(format!(
            "no transform leads from `{}` to `base_footprint` or `base_link`: the scans have to do \
             without odometry (see `--odom-frame` and `--base-frame`)",
            options.odom_frame
        ));
    }
    let mut missing: BTreeMap<String, usize> = BTreeMap::new();
    let faults = each::<LaserScan>(bag, &[topic.as_str()], |_, message| {
        let time_ns = message.header.stamp.ns();
        let frame = message.header.frame_id.trim_start_matches('/').to_owned();
        let base_from_laser = base.as_ref().and_then(|base| {
            let found = frames.buffer.lookup(base, &frame, time_ns);
            // Static transforms may be published after the first scan.
            let found = found.or_else(|_| frames.buffer.lookup(base, &frame, 0));
            if found.is_err() {
                *missing.entry(format!("{base} <- {frame}")).or_default() += 1;
            }
            found.ok()
        });
        let base_from_laser = base_from_laser.map_or(Pose::IDENTITY, |it| it.target_from_source);
        let odom_from_base = base.as_ref().and_then(|base| {
            let found = frames.buffer.lookup(&options.odom_frame, base, time_ns);
            if found.is_err() {
                *missing.entry(format!("{} <- {base}", options.odom_frame)).or_default() += 1;
            }
            Some(Pose2::from(found.ok()?.target_from_source))
        });
        log.scans.push(LoggedScan { scan: laser_scan(&message, base_from_laser), odom_from_base });
    });
    log.faults.extend(faults.map_err(|why| why.to_string())?);
    for (edge, count) in missing {
        log.warnings.push(format!("{count} scans have no transform {edge} at their stamp"));
    }
    Ok(log)
}

/// Topic with the most scans, or the requested one.
fn scan_topic(bag: &Bag, path: &Path, options: &LogOptions) -> Result<String, String> {
    let with_scans = || {
        let topics = bag.topics().iter().zip(bag.counts());
        topics.filter(|(topic, _)| has_type(topic, "LaserScan"))
    };
    let names: Vec<&str> = with_scans().map(|(topic, _)| topic.name.as_str()).collect();
    let named = |wanted: &str| {
        let same = |name: &&&str| name.trim_start_matches('/') == wanted.trim_start_matches('/');
        names.iter().find(same).map(|name| (*name).to_owned())
    };
    let told = options.told_topic.as_deref().filter(|_| options.scan_topic.is_none());
    if let Some(told) = told.and_then(named) {
        return Ok(told);
    }
    match &options.scan_topic {
        Some(wanted) => named(wanted).ok_or_else(|| {
            format!("no scans on `{wanted}`; topics with scans: {}", names.join(", "))
        }),
        None => with_scans()
            .max_by_key(|(_, count)| **count)
            .map(|(topic, _)| topic.name.clone())
            .ok_or_else(|| format!("{} has no scans", path.display())),
    }
}

/// Compares the last part of the type; ROS 1 and ROS 2 differ in the rest.
pub(crate) fn has_type(topic: &BagTopic, name: &str) -> bool {
    topic.type_name.rsplit('/').next() == Some(name)
}

/// Transforms of the whole recording.
pub(crate) struct Frames {
    pub(crate) buffer: Buffer,
    pub(crate) faults: Vec<String>,
}

impl Frames {
    /// Reads all transforms, and odometry of frames without transforms.
    pub(crate) fn read(bag: &Bag) -> Result<Self, BagError> {
        let mut buffer = Buffer::new(i64::MAX);
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
                // Repeated and invalid transforms are refused, as in tf2.
                let _ = buffer.set(&stamped, topic, kind);
            }
        })?;
        let has_parent = |frame: &&str| buffer.parent_of(frame).is_some();
        let told: BTreeSet<String> =
            buffer.frames().filter(has_parent).map(str::to_owned).collect();
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
            let _ = buffer.set(&stamped, topic, TransformKind::Moving);
        })?);
        Ok(Self { buffer, faults })
    }

    /// Base frame that is connected to odometry: the given one, or one of the common names.
    pub(crate) fn base(&self, odom: &str, told: Option<&str>) -> Option<String> {
        let leads = |base: &&str| self.buffer.chain(odom, base).is_some();
        told.into_iter().chain(BASE_FRAMES).find(leads).map(str::to_owned)
    }
}

/// Decodes all messages of some topics; undecodable ones become faults.
pub(crate) fn each<M: Message>(
    bag: &Bag,
    names: &[&str],
    mut take: impl FnMut(&str, M),
) -> Result<Vec<String>, BagError> {
    each_at(bag, names, |topic, _, message| take(topic, message))
}

/// As [`each`], with the time of recording \[ns\].
pub(crate) fn each_at<M: Message>(
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
