//! Commands of a recording.

use std::collections::BTreeSet;
use std::io::{Read, Seek};

use periplus_bags::{ReadError, Reader, Selection};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::{DecodeError, Message};
use periplus_rosidl::TypeName;

use crate::script::command::{CommandMessage, VelocityCommand};

/// Minimum time stamp of a wall clock \[ns\]: the year 2001. Earlier ones are simulated time.
const MIN_WALL_TIME_NS: i64 = 1_000_000_000_000_000_000;

/// Returns all velocities of a recording, from every topic of type `Twist` or `TwistStamped`, at
/// their times. Wall-clock times are relative to the start of the recording.
///
/// # Errors
/// When the recording cannot be read. A damaged message is omitted and reported.
pub fn replay<R: Read + Seek>(
    bag: &mut Reader<R>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<VelocityCommand>, ReadError> {
    type Decode = fn(&[u8]) -> Result<CommandMessage, DecodeError>;
    let decoder = |type_name: &str, encoding: &str| -> Option<Decode> {
        let name = TypeName::read(type_name).filter(|_| encoding == "cdr")?.to_string();
        match name.as_str() {
            Twist::TYPE_NAME => Some(|data| Twist::decode_cdr(data).map(CommandMessage::Twist)),
            TwistStamped::TYPE_NAME => {
                Some(|data| TwistStamped::decode_cdr(data).map(CommandMessage::TwistStamped))
            }
            _ => None,
        }
    };
    let topics: Vec<(String, Option<Decode>)> = bag
        .topics()
        .iter()
        .map(|topic| (topic.name.clone(), decoder(&topic.type_name, &topic.encoding)))
        .collect();
    let wanted = topics.iter().filter(|(_, decode)| decode.is_some());
    let wanted: BTreeSet<String> = wanted.map(|(name, _)| name.clone()).collect();
    if wanted.is_empty() {
        let wrong = "the recording has no topic of type Twist or TwistStamped";
        diagnostics.push(Diagnostic::error("no-commands", wrong).help(
            "a script drives by geometry_msgs/msg/Twist or geometry_msgs/msg/TwistStamped; \
             record /cmd_vel",
        ));
        return Ok(Vec::new());
    }
    let start_ns = bag.span_ns().map_or(0, |(start_ns, _)| start_ns);
    let shift_ns = if start_ns >= MIN_WALL_TIME_NS { start_ns } else { 0 };
    let mut commands = Vec::new();
    let mut messages = bag.messages(Selection { topics: Some(wanted), ..Selection::default() });
    while let Some(message) = messages.next()? {
        let (topic, Some(decode)) = &topics[message.topic] else { continue };
        match decode(message.data) {
            Ok(body) => {
                let time_ns = message.log_ns - shift_ns;
                commands.push(VelocityCommand { time_ns, topic: Some(topic.clone()), body });
            }
            Err(error) => {
                let wrong = format!("a message of `{topic}` cannot be read: {error}");
                diagnostics.push(Diagnostic::warning("bad-message", wrong));
            }
        }
    }
    for fault in bag.faults() {
        diagnostics.push(Diagnostic::warning("damaged-bag", fault.to_string()));
    }
    Ok(commands)
}
