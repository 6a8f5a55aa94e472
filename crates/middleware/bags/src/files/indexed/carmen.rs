//! CARMEN logs as recordings.

use std::io::{BufReader, BufWriter};
use std::path::Path;

use super::progress::{OpenProgress, WatchedFile};
use crate::files::BagError;
use crate::files::temporary::Temporary;
use crate::{Settings, Stamp, Topic, WriteError, Writer, read_carmen_from};

use periplus_geometry::{LaserScan2, Pose2};
use periplus_msgs::geometry_msgs::{Quaternion, TransformStamped};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{EncodeError, Message};
use periplus_os::fs::File;

/// A message of the log.
enum Line {
    Scan(LaserScan2, Pose2),
    Odometry(Pose2),
}

/// Lines with errors: number, from 1, and error.
pub(crate) type LineFaults = Vec<(usize, String)>;

/// Writes a log as a temporary MCAP file: `/scan` (the scans of the first kind), `/odom`, and `/tf`
/// with the poses of the robot and of the scanner.
pub(crate) fn convert(
    path: &Path,
    progress: &OpenProgress,
) -> Result<(Temporary, LineFaults), BagError> {
    let file = File::open(path).map_err(BagError::file(path))?;
    let watched = WatchedFile { file, progress, position: 0 };
    let log = read_carmen_from(&mut BufReader::new(watched)).map_err(BagError::file(path))?;
    let faults = log.faults.clone();
    let mut lines: Vec<(i64, Line)> = Vec::new();
    for one in &log.odometry {
        lines.push((stamp_ns(one.time_s), Line::Odometry(one.odom_from_base)));
    }
    let (_, scans) = log.scans_of_first_kind();
    for scan in scans {
        let base_from_laser = scan.base_from_laser;
        let scan = LaserScan2::from(scan);
        lines.push((scan.time_ns, Line::Scan(scan, base_from_laser)));
    }
    lines.sort_by_key(|(time_ns, _)| *time_ns);
    let copy = Temporary::new();
    let file = File::create_new(copy.path()).map_err(BagError::file(copy.path()))?;
    write(file, lines).map_err(BagError::write(copy.path()))?;
    Ok((copy, faults))
}

fn write(file: File, lines: Vec<(i64, Line)>) -> Result<(), WriteError> {
    let mut bag = Writer::new(BufWriter::new(file), Settings::new("carmen.mcap"))?;
    let scans = bag.topic(Topic::of::<LaserScan>("/scan", &[]))?;
    let odometry = bag.topic(Topic::of::<Odometry>("/odom", &[]))?;
    let frames = bag.topic(Topic::of::<TFMessage>("/tf", &[]))?;
    for (time_ns, line) in lines {
        // Recordings start at 0; logs have the time since 1970.
        let stamp = Stamp::at(time_ns.max(0));
        match line {
            Line::Scan(scan, base_from_laser) => {
                let mounting = transform(time_ns, "base_link", "laser", base_from_laser);
                bag.write(frames, stamp, &cdr(&TFMessage { transforms: vec![mounting] })?)?;
                bag.write(scans, stamp, &cdr(&scan_message(scan))?)?;
            }
            Line::Odometry(pose) => {
                let step = transform(time_ns, "odom", "base_link", pose);
                bag.write(frames, stamp, &cdr(&TFMessage { transforms: vec![step] })?)?;
                bag.write(odometry, stamp, &cdr(&odometry_message(time_ns, pose))?)?;
            }
        }
    }
    bag.finish().map(|_| ())
}

#[expect(clippy::cast_possible_truncation, reason = "a stamp fits for 292 years")]
fn stamp_ns(time_s: f64) -> i64 {
    ((time_s * 1e6).round() as i64).saturating_mul(1000)
}

fn cdr<T: Message>(message: &T) -> Result<Vec<u8>, WriteError> {
    message.to_cdr().map_err(|error: EncodeError| WriteError::TooLong(error.to_string()))
}

#[expect(clippy::cast_possible_truncation, reason = "rounds to the types of the message")]
fn scan_message(scan: LaserScan2) -> LaserScan {
    let steps = scan.ranges_m.len().saturating_sub(1) as f64;
    LaserScan {
        header: Header::at(scan.time_ns, "laser"),
        angle_min: scan.angle_min_rad as f32,
        angle_max: (scan.angle_min_rad + steps * scan.angle_increment_rad) as f32,
        angle_increment: scan.angle_increment_rad as f32,
        time_increment: scan.time_increment_s as f32,
        range_min: scan.range_min_m,
        range_max: scan.range_max_m,
        ranges: scan.ranges_m,
        ..LaserScan::default()
    }
}

fn rotation(pose: Pose2) -> Quaternion {
    let (z, w) = (pose.yaw_rad / 2.0).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z, w }
}

fn odometry_message(time_ns: i64, odom_from_base: Pose2) -> Odometry {
    let mut odometry = Odometry {
        header: Header::at(time_ns, "odom"),
        child_frame_id: "base_link".into(),
        ..Odometry::default()
    };
    odometry.pose.pose.position.x = odom_from_base.x_m;
    odometry.pose.pose.position.y = odom_from_base.y_m;
    odometry.pose.pose.orientation = rotation(odom_from_base);
    odometry
}

fn transform(time_ns: i64, parent: &str, child: &str, pose: Pose2) -> TransformStamped {
    let mut transform = TransformStamped {
        header: Header::at(time_ns, parent),
        child_frame_id: child.into(),
        ..TransformStamped::default()
    };
    transform.transform.translation.x = pose.x_m;
    transform.transform.translation.y = pose.y_m;
    transform.transform.rotation = rotation(pose);
    transform
}
