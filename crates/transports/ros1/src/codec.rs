//! Conversion of messages and services between ROS 2, as the graph has them, and ROS 1.

mod log;

use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_msgs::{Format, Layout, RecodeError, Recoding, TypeRegistry};
use periplus_rosidl::{InterfaceDialect, TypeName};

/// Log messages of ROS 2.
const LOG: &str = "rcl_interfaces/msg/Log";

/// Converts messages of one type in one direction.
#[derive(Debug)]
pub(crate) enum Codec {
    /// The same fields, or another revision of them.
    Fields(Recoding),
    /// Log messages, whose levels differ.
    LogToRos1,
    LogToRos2,
}

impl Codec {
    /// To ROS 1, from the type of the graph; none if a type is unknown.
    pub(crate) fn to_ros1(ros2: &str) -> Option<Self> {
        if ros2 == LOG {
            return Some(Self::LogToRos1);
        }
        let source = TypeRegistry::builtin().layout(ros2)?;
        let target = TypeRegistry::ros1().layout(ros2)?;
        Some(Self::Fields(Recoding::new(source, Format::CDR, target, Format::Ros1)))
    }

    /// From ROS 1 to the type of the graph; none if a type is unknown.
    pub(crate) fn to_ros2(ros2: &str) -> Option<Self> {
        if ros2 == LOG {
            return Some(Self::LogToRos2);
        }
        let source = TypeRegistry::ros1().layout(ros2)?;
        let target = TypeRegistry::builtin().layout(ros2)?;
        Some(Self::Fields(Recoding::new(source, Format::Ros1, target, Format::CDR)))
    }

    /// From ROS 1 to the type of the graph, for a type that this program knows only from the definition in a
    /// publisher's header; none if the definition cannot be read.
    pub(crate) fn from_definition(ros2: &str, definition: &str) -> Option<Self> {
        let types = TypeRegistry::of_schema(ros2, definition, InterfaceDialect::Ros1);
        let source = types.layout(ros2)?;
        let other = TypeRegistry::new(types.registry().for_ros2(), &mut Diagnostics::new());
        let target = TypeRegistry::builtin().layout(ros2).or_else(|| other.layout(ros2))?;
        Some(Self::Fields(Recoding::new(source, Format::Ros1, target, Format::CDR)))
    }

    /// Appends a converted message to `out`.
    pub(crate) fn convert(&self, message: &[u8], out: &mut Vec<u8>) -> Result<(), RecodeError> {
        match self {
            Self::Fields(recoding) => recoding.convert(message, out),
            Self::LogToRos1 => log::to_ros1(message, out),
            Self::LogToRos2 => log::to_ros2(message, out),
        }
    }
}

/// Converts the requests and responses of a service.
#[derive(Debug)]
pub(crate) struct ServiceCodec {
    request: [Recoding; 2],
    response: [Recoding; 2],
}

/// Target of a conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Into {
    Ros1,
    Ros2,
}

impl ServiceCodec {
    /// Conversion of a service by its type in ROS 2; none if it is unknown.
    pub(crate) fn new(ros2: &str) -> Option<Self> {
        let both = |part: &str| {
            let name = TypeName::read(ros2)?.implied(part).to_string();
            let one: &Arc<Layout> = TypeRegistry::ros1().layout(&name)?;
            let two = TypeRegistry::builtin().layout(&name)?;
            let to_one = Recoding::new(two, Format::CDR, one, Format::Ros1);
            Some([to_one, Recoding::new(one, Format::Ros1, two, Format::CDR)])
        };
        Some(Self { request: both("Request")?, response: both("Response")? })
    }

    pub(crate) fn request(&self, into: Into, bytes: &[u8]) -> Result<Vec<u8>, RecodeError> {
        run(&self.request, into, bytes)
    }

    pub(crate) fn response(&self, into: Into, bytes: &[u8]) -> Result<Vec<u8>, RecodeError> {
        run(&self.response, into, bytes)
    }
}

fn run(both: &[Recoding; 2], into: Into, bytes: &[u8]) -> Result<Vec<u8>, RecodeError> {
    let recoding = match into {
        Into::Ros1 => &both[0],
        Into::Ros2 => &both[1],
    };
    let mut out = Vec::new();
    recoding.convert(bytes, &mut out)?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_msgs::{Message, sensor_msgs, std_msgs, std_srvs};

    #[test]
    fn a_string_has_its_length_in_ros_1() {
        let message = std_msgs::String { data: "hi".into() };
        let codec = Codec::to_ros1("std_msgs/msg/String").expect("a known type");
        let mut out = Vec::new();
        codec.convert(&message.to_cdr().expect("CDR"), &mut out).expect("a message");
        assert_eq!(out, [2, 0, 0, 0, b'h', b'i']);
        let mut back = Vec::new();
        let codec = Codec::to_ros2("std_msgs/msg/String").expect("a known type");
        codec.convert(&out, &mut back).expect("a message");
        assert_eq!(std_msgs::String::decode_cdr(&back), Ok(message));
    }

    #[test]
    fn fields_of_another_case_keep_their_values() {
        let mut info = sensor_msgs::CameraInfo::default();
        info.k[0] = 7.0;
        let codec = Codec::to_ros1("sensor_msgs/msg/CameraInfo").expect("a known type");
        let (mut out, mut back) = (Vec::new(), Vec::new());
        codec.convert(&info.to_cdr().expect("CDR"), &mut out).expect("a message");
        let codec = Codec::to_ros2("sensor_msgs/msg/CameraInfo").expect("a known type");
        codec.convert(&out, &mut back).expect("a message");
        assert_eq!(sensor_msgs::CameraInfo::decode_cdr(&back), Ok(info));
    }

    #[test]
    fn an_empty_request_has_no_bytes_in_ros_1() {
        let codec = ServiceCodec::new("std_srvs/srv/Trigger").expect("a known type");
        let empty = std_srvs::TriggerRequest::default().to_cdr().expect("CDR");
        assert_eq!(codec.request(Into::Ros1, &empty), Ok(vec![]));
        assert_eq!(codec.request(Into::Ros2, &[]), Ok(empty));
        let response = codec.response(Into::Ros2, &[1, 2, 0, 0, 0, b'o', b'k']).expect("bytes");
        let response = std_srvs::TriggerResponse::decode_cdr(&response).expect("a response");
        assert_eq!((response.success, response.message.as_str()), (true, "ok"));
    }

    #[test]
    fn a_type_is_read_from_its_definition() {
        let codec = Codec::from_definition("mine_msgs/msg/Pair", "Header header\nint32 a\n");
        let mut out = Vec::new();
        let message = [1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0];
        // A header needs its own definition, as ROS 1 sends it.
        assert!(codec.is_none());
        let definition = format!(
            "Header header\nint32 a\n{}\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n",
            "=".repeat(80)
        );
        let codec = Codec::from_definition("mine_msgs/msg/Pair", &definition).expect("a type");
        codec.convert(&message, &mut out).expect("a message");
        assert_eq!(out[4..], [2, 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0]);
    }
}
