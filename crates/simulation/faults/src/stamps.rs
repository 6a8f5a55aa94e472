//! Stamps of serialized messages.

use periplus_msgs::TypeRegistry;
use periplus_msgs::builtin_interfaces::Time;

/// Returns the stamp \[ns\] of a message with a header, given as CDR; `None` if it is too short. The type must have a
/// header; see [`has_header`].
#[must_use]
pub fn header_stamp_ns(cdr: &[u8]) -> Option<i64> {
    read_stamp(cdr).map(|stamp| stamp.ns())
}

/// Returns true if the first field of a type is a header, so that its CDR begins with a stamp.
#[must_use]
pub fn has_header(type_name: &str) -> bool {
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

pub(crate) fn read_stamp(cdr: &[u8]) -> Option<Time> {
    let field = |at: usize| -> Option<[u8; 4]> { cdr.get(at..at + 4)?.try_into().ok() };
    let (sec, nanosec) = (field(ENCAPSULATION_BYTES)?, field(ENCAPSULATION_BYTES + 4)?);
    Some(if is_little_endian(cdr) {
        Time { sec: i32::from_le_bytes(sec), nanosec: u32::from_le_bytes(nanosec) }
    } else {
        Time { sec: i32::from_be_bytes(sec), nanosec: u32::from_be_bytes(nanosec) }
    })
}

pub(crate) fn write_stamp(cdr: &mut [u8], stamp: &Time) {
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
    use periplus_msgs::Message;
    use periplus_msgs::sensor_msgs::LaserScan;
    use periplus_msgs::std_msgs::Header;
    use periplus_msgs::tf2_msgs::TFMessage;

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
