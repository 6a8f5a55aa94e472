//! Topics between Gazebo and ROS, as `ros_gz_bridge` reads them from YAML.

use serde::Serialize;

/// Direction of a bridged topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum BridgeFlow {
    /// From Gazebo to ROS.
    #[serde(rename = "GZ_TO_ROS")]
    GzToRos,
    /// From ROS to Gazebo.
    #[serde(rename = "ROS_TO_GZ")]
    RosToGz,
}

/// A bridged topic.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct BridgeEntry {
    /// Name on ROS.
    pub ros_topic_name: String,
    /// Name on Gazebo Transport.
    pub gz_topic_name: String,
    /// Type on ROS: `sensor_msgs/msg/LaserScan`.
    pub ros_type_name: &'static str,
    /// Type on Gazebo Transport: `gz.msgs.LaserScan`.
    pub gz_type_name: &'static str,
    /// Direction.
    pub direction: BridgeFlow,
}

impl BridgeEntry {
    /// Topic from Gazebo to ROS.
    pub(crate) fn to_ros(ros: &str, gz: &str, types: BridgeTypes) -> Self {
        Self {
            ros_topic_name: absolute(ros),
            gz_topic_name: absolute(gz),
            ros_type_name: types.ros,
            gz_type_name: types.gz,
            direction: BridgeFlow::GzToRos,
        }
    }

    /// Topic from ROS to Gazebo.
    pub(crate) fn to_gz(ros: &str, gz: &str, types: BridgeTypes) -> Self {
        Self { direction: BridgeFlow::RosToGz, ..Self::to_ros(ros, gz, types) }
    }
}

fn absolute(topic: &str) -> String {
    format!("/{}", topic.trim_start_matches('/'))
}

/// Pair of types that the bridge converts into each other.
#[derive(Clone, Copy)]
pub(crate) struct BridgeTypes {
    ros: &'static str,
    gz: &'static str,
}

const fn types(ros: &'static str, gz: &'static str) -> BridgeTypes {
    BridgeTypes { ros, gz }
}

pub(crate) const SCAN: BridgeTypes = types("sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan");
pub(crate) const CLOUD: BridgeTypes =
    types("sensor_msgs/msg/PointCloud2", "gz.msgs.PointCloudPacked");
pub(crate) const IMAGE: BridgeTypes = types("sensor_msgs/msg/Image", "gz.msgs.Image");
pub(crate) const CAMERA_INFO: BridgeTypes =
    types("sensor_msgs/msg/CameraInfo", "gz.msgs.CameraInfo");
pub(crate) const IMU: BridgeTypes = types("sensor_msgs/msg/Imu", "gz.msgs.IMU");
pub(crate) const NAVSAT: BridgeTypes = types("sensor_msgs/msg/NavSatFix", "gz.msgs.NavSat");
pub(crate) const MAGNETOMETER: BridgeTypes =
    types("sensor_msgs/msg/MagneticField", "gz.msgs.Magnetometer");
pub(crate) const CONTACTS: BridgeTypes =
    types("ros_gz_interfaces/msg/Contacts", "gz.msgs.Contacts");
pub(crate) const WRENCH: BridgeTypes = types("geometry_msgs/msg/WrenchStamped", "gz.msgs.Wrench");
pub(crate) const TWIST: BridgeTypes = types("geometry_msgs/msg/Twist", "gz.msgs.Twist");
pub(crate) const ODOMETRY: BridgeTypes = types("nav_msgs/msg/Odometry", "gz.msgs.Odometry");
pub(crate) const TRANSFORMS: BridgeTypes = types("tf2_msgs/msg/TFMessage", "gz.msgs.Pose_V");
pub(crate) const JOINT_STATES: BridgeTypes = types("sensor_msgs/msg/JointState", "gz.msgs.Model");
pub(crate) const TRIGGER: BridgeTypes = types("std_msgs/msg/Bool", "gz.msgs.Boolean");

/// The clock of the simulation, which every node with `use_sim_time` needs.
#[must_use]
pub fn clock_bridge() -> BridgeEntry {
    BridgeEntry::to_ros("clock", "clock", types("rosgraph_msgs/msg/Clock", "gz.msgs.Clock"))
}

/// Text of the YAML file that `ros_gz_bridge`'s `parameter_bridge` reads with `config_file`.
#[must_use]
pub fn bridge_yaml(entries: &[BridgeEntry]) -> String {
    let mut text =
        String::from("# Topics between Gazebo and ROS, for parameter_bridge of ros_gz_bridge.\n");
    for entry in entries {
        let direction = match entry.direction {
            BridgeFlow::GzToRos => "GZ_TO_ROS",
            BridgeFlow::RosToGz => "ROS_TO_GZ",
        };
        text.push_str(&format!(
            "- ros_topic_name: \"{}\"\n  gz_topic_name: \"{}\"\n  ros_type_name: \"{}\"\n  \
             gz_type_name: \"{}\"\n  direction: {direction}\n",
            entry.ros_topic_name, entry.gz_topic_name, entry.ros_type_name, entry.gz_type_name
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_yaml_has_the_keys_of_ros_gz_bridge() {
        let text = bridge_yaml(&[BridgeEntry::to_gz("cmd_vel", "/cmd_vel", TWIST)]);
        let expected = "- ros_topic_name: \"/cmd_vel\"\n  gz_topic_name: \"/cmd_vel\"\n  \
                        ros_type_name: \"geometry_msgs/msg/Twist\"\n  gz_type_name: \
                        \"gz.msgs.Twist\"\n  direction: ROS_TO_GZ\n";
        assert!(text.ends_with(expected), "{text}");
    }
}
