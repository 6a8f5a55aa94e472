//! Scans of a recording, with odometry from its transforms.

use std::collections::BTreeMap;
use std::path::Path;

use periplus_bags::files::Bag;
use periplus_diagnostics::SourceMap;
use periplus_geometry::{Pose, Pose2};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_session::recorded::{RecordedFrames, each, scan_topic};
use periplus_tf_ros::laser_scan;

use super::{Log, LogOptions, LoggedScan};
use crate::error::CliError;
use crate::terminal;

/// Reads a recording and prints its findings.
pub(super) fn read(path: &Path, options: &LogOptions) -> Result<Log, CliError> {
    let bag = crate::paths::bag(path)?;
    let findings = bag.findings();
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())?;
    Ok(scans(&bag, path, options)?)
}

fn scans(bag: &Bag, path: &Path, options: &LogOptions) -> Result<Log, String> {
    let topic = scan_topic(bag, options.scan_topic.as_deref(), options.told_topic.as_deref())
        .map_err(|error| error.to_string())?;
    let frames = RecordedFrames::read(bag).map_err(|why| why.to_string())?;
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
