//! Log messages: the levels are 10, 20, ... in ROS 2, and 1, 2, 4, 8, 16 in ROS 1.

use periplus_msgs::rcl_interfaces::Log;
use periplus_msgs::{DynamicMessage, Format, Message, Number, RecodeError, TypeRegistry, Value};

/// Level in ROS 2 by that in ROS 1.
const LEVELS: [(u8, u8); 5] = [(1, 10), (2, 20), (4, 30), (8, 40), (16, 50)];

pub(super) fn to_ros1(message: &[u8], out: &mut Vec<u8>) -> Result<(), RecodeError> {
    let log = Log::decode_cdr(message).map_err(RecodeError::Decode)?;
    let level = LEVELS.iter().rev().find(|(_, two)| *two <= log.level).map_or(1, |(one, _)| *one);
    // std_msgs/Header: number, time, frame.
    out.extend_from_slice(&0_u32.to_le_bytes());
    out.extend_from_slice(&log.stamp.sec.to_le_bytes());
    out.extend_from_slice(&log.stamp.nanosec.to_le_bytes());
    text(out, "");
    out.push(level);
    for part in [&log.name, &log.msg, &log.file, &log.function] {
        text(out, part);
    }
    out.extend_from_slice(&log.line.to_le_bytes());
    // Topics of the node, which are known from its registrations.
    out.extend_from_slice(&0_u32.to_le_bytes());
    Ok(())
}

fn text(out: &mut Vec<u8>, text: &str) {
    out.extend_from_slice(&u32::try_from(text.len()).unwrap_or(u32::MAX).to_le_bytes());
    out.extend_from_slice(text.as_bytes());
}

pub(super) fn to_ros2(message: &[u8], out: &mut Vec<u8>) -> Result<(), RecodeError> {
    let Some(layout) = TypeRegistry::ros1().layout("rosgraph_msgs/msg/Log") else { return Ok(()) };
    let read =
        DynamicMessage::decode(layout, Format::Ros1, message).map_err(RecodeError::Decode)?;
    let number = |path: &str| match read.get(path) {
        Some(Value::Number(Number::I8(number))) => number.into(),
        Some(Value::Number(Number::U8(number))) => number.into(),
        Some(Value::Number(Number::I32(number))) => number.into(),
        Some(Value::Number(Number::U32(number))) => number.into(),
        _ => 0_i64,
    };
    let words = |path: &str| match read.get(path) {
        Some(Value::Text(text)) => text,
        _ => String::new(),
    };
    let mut log = Log::default();
    log.stamp.sec = i32::try_from(number("header.stamp.sec")).unwrap_or_default();
    log.stamp.nanosec = u32::try_from(number("header.stamp.nanosec")).unwrap_or_default();
    let level = u8::try_from(number("level")).unwrap_or_default();
    log.level = LEVELS.iter().rev().find(|(one, _)| *one <= level).map_or(10, |(_, two)| *two);
    log.name = words("name");
    log.msg = words("msg");
    log.file = words("file");
    log.function = words("function");
    log.line = u32::try_from(number("line")).unwrap_or_default();
    log.encode_cdr(out).map_err(RecodeError::Encode)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_stays_a_warning() {
        let mut log = Log { level: 30, name: "/slam".into(), msg: "late".into(), ..Log::default() };
        (log.stamp.sec, log.stamp.nanosec, log.line) = (5, 7, 9);
        let (mut there, mut back) = (Vec::new(), Vec::new());
        to_ros1(&log.to_cdr().expect("CDR"), &mut there).expect("a message");
        assert_eq!(there[16], 4);
        to_ros2(&there, &mut back).expect("a message");
        assert_eq!(Log::decode_cdr(&back), Ok(log));
    }
}
