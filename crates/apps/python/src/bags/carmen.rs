//! CARMEN logs as messages.

#![allow(clippy::disallowed_methods, reason = "this is an edge: logs are read from disk")]

use std::fs::File;
use std::io::{self, BufReader, Read as _};
use std::path::{Path, PathBuf};

use periplus::bags::{BagTopic, read_carmen_from};
use periplus::geometry::{LaserScan2, Pose2};
use periplus::msgs::Message;
use periplus::msgs::builtin_interfaces::Time;
use periplus::msgs::geometry_msgs::{Quaternion, TransformStamped};
use periplus::msgs::nav_msgs::Odometry;
use periplus::msgs::sensor_msgs::LaserScan;
use periplus::msgs::std_msgs::Header;
use periplus::msgs::tf2_msgs::TFMessage;

/// Messages in memory, in the order of time.
pub(super) struct Memory {
    pub(super) path: PathBuf,
    pub(super) topics: Vec<BagTopic>,
    pub(super) counts: Vec<u64>,
    /// Topic, time [ns] and CDR of each message.
    pub(super) messages: Vec<(usize, i64, Vec<u8>)>,
    /// Lines with errors.
    pub(super) faults: Vec<(usize, String)>,
    pub(super) bytes: u64,
}

impl Memory {
    pub(super) fn span_ns(&self) -> Option<(i64, i64)> {
        Some((self.messages.first()?.1, self.messages.last()?.1))
    }
}

/// Start of a file.
pub(super) fn head(path: &Path) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    File::open(path)?.take(64 << 10).read_to_end(&mut head)?;
    Ok(head)
}

/// Reads a log: `/scan` (the scans of the first kind), `/odom`, and `/tf` with the poses of the robot and of the
/// scanner.
pub(super) fn read(path: &Path) -> io::Result<Memory> {
    let file = File::open(path)?;
    let bytes = file.metadata()?.len();
    let log = read_carmen_from(&mut BufReader::new(file))?;
    let faults = log.faults.clone();
    let odometry = log.odometry.clone();
    let (_, scans) = log.scans_of_first_kind();
    let mut messages = Vec::new();
    for scan in scans {
        let base_from_laser = scan.base_from_laser;
        let scan = LaserScan2::from(scan);
        let mounting = transform(scan.time_ns, "base_link", "laser", base_from_laser);
        messages.push((2, scan.time_ns, bytes_of(&TFMessage { transforms: vec![mounting] })));
        messages.push((0, scan.time_ns, bytes_of(&scan_message(scan))));
    }
    for one in odometry {
        #[allow(clippy::cast_possible_truncation, reason = "a stamp fits for 292 years")]
        let time_ns = ((one.time_s * 1e6).round() as i64).saturating_mul(1000);
        let pose = one.odom_from_base;
        let step = transform(time_ns, "odom", "base_link", pose);
        messages.push((2, time_ns, bytes_of(&TFMessage { transforms: vec![step] })));
        messages.push((1, time_ns, bytes_of(&odometry_message(time_ns, pose))));
    }
    messages.sort_by_key(|(topic, time_ns, _)| (*time_ns, std::cmp::Reverse(*topic)));
    let topics =
        vec![topic::<LaserScan>("/scan"), topic::<Odometry>("/odom"), topic::<TFMessage>("/tf")];
    let count = |topic| messages.iter().filter(|message| message.0 == topic).count() as u64;
    let counts = (0..topics.len()).map(count).collect();
    Ok(Memory { path: path.to_owned(), topics, counts, messages, faults, bytes })
}

fn topic<T: Message>(name: &str) -> BagTopic {
    BagTopic {
        name: name.into(),
        type_name: T::TYPE_NAME.into(),
        encoding: "cdr".into(),
        schema_encoding: "ros2msg".into(),
        schema: T::schema_text().into(),
        metadata: [("topic_type_hash".to_owned(), T::TYPE_HASH.to_owned())].into(),
    }
}

fn bytes_of<T: Message>(message: &T) -> Vec<u8> {
    // No field of these has a bound.
    message.to_cdr().unwrap_or_default()
}

fn header(time_ns: i64, frame: &str) -> Header {
    let sec = i32::try_from(time_ns.div_euclid(1_000_000_000)).unwrap_or(i32::MAX);
    let nanosec = u32::try_from(time_ns.rem_euclid(1_000_000_000)).unwrap_or_default();
    Header { stamp: Time { sec, nanosec }, frame_id: frame.into() }
}

#[allow(clippy::cast_possible_truncation, reason = "rounds to the types of the message")]
fn scan_message(scan: LaserScan2) -> LaserScan {
    let steps = scan.ranges_m.len().saturating_sub(1) as f64;
    LaserScan {
        header: header(scan.time_ns, "laser"),
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

fn odometry_message(time_ns: i64, pose: Pose2) -> Odometry {
    let mut odometry = Odometry {
        header: header(time_ns, "odom"),
        child_frame_id: "base_link".into(),
        ..Odometry::default()
    };
    odometry.pose.pose.position.x = pose.x_m;
    odometry.pose.pose.position.y = pose.y_m;
    odometry.pose.pose.orientation = rotation(pose);
    odometry
}

fn transform(time_ns: i64, parent: &str, child: &str, pose: Pose2) -> TransformStamped {
    let mut transform = TransformStamped {
        header: header(time_ns, parent),
        child_frame_id: child.into(),
        ..TransformStamped::default()
    };
    transform.transform.translation.x = pose.x_m;
    transform.transform.translation.y = pose.y_m;
    transform.transform.rotation = rotation(pose);
    transform
}
