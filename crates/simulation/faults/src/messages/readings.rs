//! Changes of readings and stamps in messages.

use periplus_graph::InterceptedMessage;
use periplus_msgs::Message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::sensor_msgs::{Imu, LaserScan, Range};
use periplus_msgs::tf2_msgs::TFMessage;

use crate::models::reported_range_m;
use crate::stamps::{has_header, read_stamp, write_stamp};

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
