//! Times, headers, single values.

use periplus_msgs::builtin_interfaces::Time as RosTime;
use periplus_msgs::{ros_gz_interfaces, rosgraph_msgs, std_msgs};

use super::{AsRos, frame, part};
use crate::{
    Boolean, Clock, Color, Double, Empty, Float, FloatV, Header, Int32, StringMsg, StringMsgV,
    Time, UInt32,
};

impl AsRos<RosTime> for Time {
    fn to_ros(&self) -> Option<RosTime> {
        Some(RosTime::of_ns(self.ns()))
    }

    fn from_ros(ros: &RosTime) -> Option<Self> {
        Some(Self::of_ns(ros.ns()))
    }
}

impl AsRos<std_msgs::Header> for Header {
    fn to_ros(&self) -> Option<std_msgs::Header> {
        let frame_id = self.word("frame_id").map(frame).unwrap_or_default();
        Some(std_msgs::Header { stamp: part(self.stamp.as_ref()), frame_id })
    }

    fn from_ros(ros: &std_msgs::Header) -> Option<Self> {
        Some(Self::at(ros.stamp.ns(), &ros.frame_id))
    }
}

impl AsRos<rosgraph_msgs::Clock> for Clock {
    fn to_ros(&self) -> Option<rosgraph_msgs::Clock> {
        Some(rosgraph_msgs::Clock { clock: part(self.sim.as_ref()) })
    }

    fn from_ros(ros: &rosgraph_msgs::Clock) -> Option<Self> {
        Some(Self { sim: Time::from_ros(&ros.clock), ..Self::default() })
    }
}

/// Messages with one value.
macro_rules! values {
    ($($gz:ident = $package:ident::$ros:ident;)*) => {$(
        impl AsRos<$package::$ros> for $gz {
            fn to_ros(&self) -> Option<$package::$ros> {
                Some($package::$ros { data: self.data.clone() })
            }

            fn from_ros(ros: &$package::$ros) -> Option<Self> {
                Some(Self { header: None, data: ros.data.clone() })
            }
        }
    )*};
}

values! {
    Boolean = std_msgs::Bool;
    Double = std_msgs::Float64;
    Float = std_msgs::Float32;
    FloatV = ros_gz_interfaces::Float32Array;
    Int32 = std_msgs::Int32;
    StringMsg = std_msgs::String;
    UInt32 = std_msgs::UInt32;
}

impl AsRos<ros_gz_interfaces::StringVec> for StringMsgV {
    fn to_ros(&self) -> Option<ros_gz_interfaces::StringVec> {
        Some(ros_gz_interfaces::StringVec {
            header: part(self.header.as_ref()),
            data: self.data.clone(),
        })
    }

    fn from_ros(ros: &ros_gz_interfaces::StringVec) -> Option<Self> {
        Some(Self { header: Header::from_ros(&ros.header), data: ros.data.clone() })
    }
}

impl AsRos<std_msgs::Empty> for Empty {
    fn to_ros(&self) -> Option<std_msgs::Empty> {
        Some(std_msgs::Empty::default())
    }

    fn from_ros(_: &std_msgs::Empty) -> Option<Self> {
        Some(Self::default())
    }
}

impl AsRos<std_msgs::ColorRGBA> for Color {
    fn to_ros(&self) -> Option<std_msgs::ColorRGBA> {
        let Self { r, g, b, a, .. } = *self;
        Some(std_msgs::ColorRGBA { r, g, b, a })
    }

    fn from_ros(ros: &std_msgs::ColorRGBA) -> Option<Self> {
        let std_msgs::ColorRGBA { r, g, b, a } = *ros;
        Some(Self { header: None, r, g, b, a })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_of_gazebo_has_slashes_in_ros() {
        let header = Header::at(1_500_000_000, "pong-bot::chassis::gpu_lidar").with("seq", "7");
        let ros: std_msgs::Header = header.to_ros().expect("a header");
        assert_eq!(ros, std_msgs::Header::at(1_500_000_000, "pong-bot/chassis/gpu_lidar"));
        let nameless: std_msgs::Header = Header::default().to_ros().expect("a header");
        assert_eq!(nameless, std_msgs::Header::default());
    }
}
