//! The commands of a recording, driven again.

use std::collections::BTreeSet;
use std::io::{Read, Seek};

use periplus_bags::{ReadError, Reader, Selection};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::{DecodeError, Message};
use periplus_rosidl::TypeName;

use crate::script::command::{Body, Command};

/// Times from here on are those of a real clock \[ns\]: the year 2001. Earlier ones are simulated.
const REAL_TIMES_NS: i64 = 1_000_000_000_000_000_000;

/// All velocities of a recording, of every topic of type `Twist` or `TwistStamped`, at their times.
/// Times of a real clock are counted from the beginning of the recording.
///
/// # Errors
/// When the recording cannot be read. A message that is damaged is left out, and the findings tell.
pub fn replay<R: Read + Seek>(
    bag: &mut Reader<R>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Command>, ReadError> {
    type Decode = fn(&[u8]) -> Result<Body, DecodeError>;
    let decoder = |type_name: &str, encoding: &str| -> Option<Decode> {
        let name = TypeName::read(type_name).filter(|_| encoding == "cdr")?.to_string();
        match name.as_str() {
            Twist::TYPE_NAME => Some(|data| Twist::decode_cdr(data).map(Body::Twist)),
            TwistStamped::TYPE_NAME => {
                Some(|data| TwistStamped::decode_cdr(data).map(Body::TwistStamped))
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
    let shift_ns = if start_ns >= REAL_TIMES_NS { start_ns } else { 0 };
    let mut commands = Vec::new();
    let mut messages = bag.messages(Selection { topics: Some(wanted), ..Selection::default() });
    while let Some(message) = messages.next()? {
        let (topic, Some(decode)) = &topics[message.topic] else { continue };
        match decode(message.data) {
            Ok(body) => {
                let time_ns = message.log_ns - shift_ns;
                commands.push(Command { time_ns, topic: Some(topic.clone()), body });
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
