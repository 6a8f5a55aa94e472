//! Changes of readings and stamps in messages.

use periplus_graph::InterceptedMessage;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::sensor_msgs::{Imu, LaserScan, Range};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Message, TypeRegistry};

use crate::models::reported_range_m;

/// Reasons that a fault does not change a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unchanged {
    /// Messages of this type have no such reading.
    Type,
    /// The message cannot be decoded.
    Content,
}

/// Changes the main reading of a message: ranges \[m\], yaw rate \[rad/s\] or forward speed \[m/s\].
pub(super) fn with_readings(
    message: &InterceptedMessage,
    change: &mut dyn FnMut(f64) -> f64,
) -> Result<InterceptedMessage, Unchanged> {
    match message.type_name() {
        LaserScan::TYPE_NAME => {
            let mut scan = decoded::<LaserScan>(message)?;
            let (min_m, max_m) = (f64::from(scan.range_min), f64::from(scan.range_max));
            for range in scan.ranges.iter_mut().filter(|range| range.is_finite()) {
                *range = reported_range_m(change(f64::from(*range)), min_m, max_m) as f32;
            }
            Ok(message.with_message(scan))
        }
        Range::TYPE_NAME => {
            let mut reading = decoded::<Range>(message)?;
            if reading.range.is_finite() {
                let (min_m, max_m) = (f64::from(reading.min_range), f64::from(reading.max_range));
                let range_m = change(f64::from(reading.range));
                reading.range = reported_range_m(range_m, min_m, max_m) as f32;
            }
            Ok(message.with_message(reading))
        }
        Imu::TYPE_NAME => {
            let mut reading = decoded::<Imu>(message)?;
            reading.angular_velocity.z = change(reading.angular_velocity.z);
            Ok(message.with_message(reading))
        }
        Odometry::TYPE_NAME => {
            let mut reading = decoded::<Odometry>(message)?;
            reading.twist.twist.linear.x = change(reading.twist.twist.linear.x);
            Ok(message.with_message(reading))
        }
        _ => Err(Unchanged::Type),
    }
}

/// Sets the ranges of a scan between two angles \[rad\]; angles are compared modulo a full turn.
pub(super) fn with_sector(
    message: &InterceptedMessage,
    [from_rad, to_rad]: [f64; 2],
    range_m: f64,
) -> Result<InterceptedMessage, Unchanged> {
    if message.type_name() != LaserScan::TYPE_NAME {
        return Err(Unchanged::Type);
    }
    let mut scan = decoded::<LaserScan>(message)?;
    let (first_rad, step_rad) = (f64::from(scan.angle_min), f64::from(scan.angle_increment));
    for (index, range) in scan.ranges.iter_mut().enumerate() {
        let angle_rad = first_rad + step_rad * index as f64;
        let from_start_rad = (angle_rad - from_rad).rem_euclid(std::f64::consts::TAU);
        if from_start_rad <= to_rad - from_rad {
            *range = range_m as f32;
        }
    }
    Ok(message.with_message(scan))
}

/// Shifts the stamp of a message \[ns\]: that of its header, those of transforms, or the time of `/clock`.
pub(super) fn with_shifted_stamp(
    message: &InterceptedMessage,
    shift_ns: i64,
) -> Result<InterceptedMessage, Unchanged> {
    let shifted = |stamp: &Time| Time::of_ns(stamp.ns().saturating_add(shift_ns));
    match message.type_name() {
        TFMessage::TYPE_NAME => {
            let mut transforms = decoded::<TFMessage>(message)?;
            for transform in &mut transforms.transforms {
                transform.header.stamp = shifted(&transform.header.stamp);
            }
            Ok(message.with_message(transforms))
        }
        Clock::TYPE_NAME => {
            let mut clock = decoded::<Clock>(message)?;
            clock.clock = shifted(&clock.clock);
            Ok(message.with_message(clock))
        }
        type_name if has_header(type_name) => {
            let mut cdr = message.cdr().map_err(|_| Unchanged::Content)?.to_vec();
            let stamp = read_stamp(&cdr).ok_or(Unchanged::Content)?;
            write_stamp(&mut cdr, &shifted(&stamp));
            Ok(message.with_cdr(cdr))
        }
        _ => Err(Unchanged::Type),
    }
}

/// Returns the content of `first` with the stamp of `message`, if its type has a header.
pub(super) fn with_content_of(
    message: &InterceptedMessage,
    first: &[u8],
) -> Result<InterceptedMessage, Unchanged> {
    let mut cdr = first.to_vec();
    if has_header(message.type_name()) {
        let now = message.cdr().map_err(|_| Unchanged::Content)?;
        let stamp = read_stamp(now).ok_or(Unchanged::Content)?;
        write_stamp(&mut cdr, &stamp);
    }
    Ok(message.with_cdr(cdr))
}

/// Decodes a message.
pub(super) fn decoded<T: Message + Clone>(message: &InterceptedMessage) -> Result<T, Unchanged> {
    message.message::<T>().map(|shared| (*shared).clone()).map_err(|_| Unchanged::Content)
}

/// Returns true if the first field of a type is a header, so that its CDR begins with a stamp.
fn has_header(type_name: &str) -> bool {
    let schema = TypeRegistry::builtin().schema_text(type_name).unwrap_or_default();
    let mut lines = schema.lines().map(str::trim);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| {
        line.starts_with("std_msgs/Header ") || line.starts_with("std_msgs/msg/Header ")
    })
}

/// Length of the encapsulation header of CDR.
const ENCAPSULATION_BYTES: usize = 4;

/// True for little endian, by the second byte of the encapsulation header.
fn is_little_endian(cdr: &[u8]) -> bool {
    cdr.get(1).is_some_and(|byte| byte & 1 == 1)
}

fn read_stamp(cdr: &[u8]) -> Option<Time> {
    let field = |at: usize| -> Option<[u8; 4]> { cdr.get(at..at + 4)?.try_into().ok() };
    let (sec, nanosec) = (field(ENCAPSULATION_BYTES)?, field(ENCAPSULATION_BYTES + 4)?);
    Some(if is_little_endian(cdr) {
        Time { sec: i32::from_le_bytes(sec), nanosec: u32::from_le_bytes(nanosec) }
    } else {
        Time { sec: i32::from_be_bytes(sec), nanosec: u32::from_be_bytes(nanosec) }
    })
}

fn write_stamp(cdr: &mut [u8], stamp: &Time) {
    let is_little = is_little_endian(cdr);
    let Some(field) = cdr.get_mut(ENCAPSULATION_BYTES..ENCAPSULATION_BYTES + 8) else { return };
    let (sec, nanosec) = if is_little {
        (stamp.sec.to_le_bytes(), stamp.nanosec.to_le_bytes())
    } else {
        (stamp.sec.to_be_bytes(), stamp.nanosec.to_be_bytes())
    };
    field[..4].copy_from_slice(&sec);
    field[4..].copy_from_slice(&nanosec);
}

#[cfg(test)]
mod tests {
    use periplus_msgs::std_msgs::Header;

    use super::*;

    #[test]
    fn types_with_a_header_are_known() {
        assert!(has_header(LaserScan::TYPE_NAME) && has_header("nav_msgs/msg/OccupancyGrid"));
        assert!(!has_header(TFMessage::TYPE_NAME) && !has_header("std_msgs/msg/String"));
    }

    #[test]
    fn a_stamp_is_read_and_written_in_place() {
        let scan = LaserScan { header: Header::at(1_500_000_000, "lidar"), ..LaserScan::default() };
        let mut cdr = scan.to_cdr().unwrap();
        let stamp = read_stamp(&cdr).unwrap();
        assert_eq!(stamp.ns(), 1_500_000_000);
        write_stamp(&mut cdr, &Time::of_ns(-250_000_000));
        let changed = LaserScan::decode_cdr(&cdr).unwrap();
        assert_eq!((changed.header.stamp.ns(), &*changed.header.frame_id), (-250_000_000, "lidar"));
    }
}
