//! Scans of a recording, with odometry from its transforms.

use std::collections::BTreeMap;
use std::path::Path;

use periplus_bags::files::Bag;
use periplus_diagnostics::SourceMap;
use periplus_geometry::{Pose, Pose2};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_tf_ros::laser_scan;

use super::{LogSelection, LoggedScan, ScanLog, ScanLogError};
use crate::recorded::{RecordedFrames, each, scan_topic};
use crate::terminal;

/// Reads a recording and prints its findings.
pub(super) fn read(path: &Path, selection: &LogSelection) -> Result<ScanLog, ScanLogError> {
    let unreadable = |error| ScanLogError::Recording(path.to_owned(), error);
    let bag = Bag::open(path).map_err(unreadable)?;
    let findings = bag.findings();
    terminal::diagnostics(&mut terminal::messages(), findings, &SourceMap::new())
        .map_err(ScanLogError::Output)?;
    scans(&bag, path, selection)
}

fn scans(bag: &Bag, path: &Path, selection: &LogSelection) -> Result<ScanLog, ScanLogError> {
    let unreadable = |error| ScanLogError::Recording(path.to_owned(), error);
    let topic =
        scan_topic(bag, selection.scan_topic.as_deref(), selection.preferred_topic.as_deref())
            .map_err(ScanLogError::Topic)?;
    let frames = RecordedFrames::read(bag).map_err(unreadable)?;
    let mut log = ScanLog { kind: format!("recording, {topic}"), ..ScanLog::default() };
    if !bag.is_whole() {
        log.faults.push(format!("{} was not closed properly", path.display()));
    }
    log.faults.extend(frames.faults.iter().cloned());
    let base = selection
        .base_frame
        .clone()
        .or_else(|| frames.base(&selection.odom_frame, selection.preferred_base.as_deref()));
    if base.is_none() {
        log.warnings.push(format!(
            "no transform leads from `{}` to `base_footprint` or `base_link`: the scans have to do \
             without odometry (see `--odom-frame` and `--base-frame`)",
            selection.odom_frame
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
            let found = frames.buffer.lookup(&selection.odom_frame, base, time_ns);
            if found.is_err() {
                *missing.entry(format!("{} <- {base}", selection.odom_frame)).or_default() += 1;
            }
            Some(Pose2::from(found.ok()?.target_from_source))
        });
        log.scans.push(LoggedScan { scan: laser_scan(&message, base_from_laser), odom_from_base });
    });
    log.faults.extend(faults.map_err(unreadable)?);
    for (edge, count) in missing {
        log.warnings.push(format!("{count} scans have no transform {edge} at their stamp"));
    }
    Ok(log)
}
