//! Conversion to and from ROS messages.
//!
//! Source: the table and the conversions of `ros_gz_bridge` (branch `jazzy`). In frames `::` of Gazebo
//! becomes `/`. Data without an equivalent is dropped.

mod basic;
mod entities;
mod geometry;
mod sensors;

use periplus_msgs::{
    builtin_interfaces, geometry_msgs, nav_msgs, ros_gz_interfaces, rosgraph_msgs, sensor_msgs,
    std_msgs, tf2_msgs, trajectory_msgs,
};

use crate::Message;

/// Conversion of a Gazebo message to and from a ROS message.
pub trait AsRos<R>: Message {
    /// Converts to ROS; `None` if ROS has no equivalent, such as for some pixel formats.
    fn to_ros(&self) -> Option<R>;

    /// Converts from ROS; `None` if Gazebo has no equivalent.
    fn from_ros(ros: &R) -> Option<Self>;
}

/// Visitor of all pairs of equivalent types.
pub trait Pairs {
    /// Pair of a ROS type and a Gazebo type. If a ROS type has several, the first is the default.
    fn pair<R: periplus_msgs::Message, G: AsRos<R>>(&mut self);
}

macro_rules! pairs {
    ($pairs:ident: $($ros:path = $gz:ident;)*) => {
        $($pairs.pair::<$ros, crate::$gz>();)*
    };
}

/// Visits all pairs.
pub fn each_pair(pairs: &mut impl Pairs) {
    pairs! { pairs:
        builtin_interfaces::Time = Time;
        geometry_msgs::Point = Vector3d;
        geometry_msgs::Pose = Pose;
        geometry_msgs::PoseArray = PoseV;
        geometry_msgs::PoseStamped = Pose;
        geometry_msgs::PoseWithCovariance = PoseWithCovariance;
        geometry_msgs::PoseWithCovarianceStamped = PoseWithCovariance;
        geometry_msgs::Quaternion = Quaternion;
        geometry_msgs::Transform = Pose;
        geometry_msgs::TransformStamped = Pose;
        geometry_msgs::Twist = Twist;
        geometry_msgs::TwistStamped = Twist;
        geometry_msgs::TwistWithCovariance = TwistWithCovariance;
        geometry_msgs::TwistWithCovarianceStamped = TwistWithCovariance;
        geometry_msgs::Vector3 = Vector3d;
        geometry_msgs::Wrench = Wrench;
        geometry_msgs::WrenchStamped = Wrench;
        nav_msgs::Odometry = Odometry;
        nav_msgs::Odometry = OdometryWithCovariance;
        ros_gz_interfaces::Altimeter = Altimeter;
        ros_gz_interfaces::Contact = Contact;
        ros_gz_interfaces::Contacts = Contacts;
        ros_gz_interfaces::Entity = Entity;
        ros_gz_interfaces::EntityFactory = EntityFactory;
        ros_gz_interfaces::EntityWrench = EntityWrench;
        ros_gz_interfaces::Float32Array = FloatV;
        ros_gz_interfaces::GuiCamera = GuiCamera;
        ros_gz_interfaces::JointWrench = JointWrench;
        ros_gz_interfaces::Light = Light;
        ros_gz_interfaces::LogicalCameraImage = LogicalCameraImage;
        ros_gz_interfaces::SensorNoise = SensorNoise;
        ros_gz_interfaces::StringVec = StringMsgV;
        ros_gz_interfaces::TrackVisual = TrackVisual;
        ros_gz_interfaces::VideoRecord = VideoRecord;
        ros_gz_interfaces::WorldControl = WorldControl;
        ros_gz_interfaces::WorldStatistics = WorldStatistics;
        rosgraph_msgs::Clock = Clock;
        sensor_msgs::BatteryState = BatteryState;
        sensor_msgs::CameraInfo = CameraInfo;
        sensor_msgs::FluidPressure = FluidPressure;
        sensor_msgs::Image = Image;
        sensor_msgs::Imu = Imu;
        sensor_msgs::Imu = ImuFortress;
        sensor_msgs::JointState = Model;
        sensor_msgs::Joy = Joy;
        sensor_msgs::LaserScan = LaserScan;
        sensor_msgs::MagneticField = Magnetometer;
        sensor_msgs::NavSatFix = NavSat;
        sensor_msgs::PointCloud2 = PointCloudPacked;
        std_msgs::Bool = Boolean;
        std_msgs::ColorRGBA = Color;
        std_msgs::Empty = Empty;
        std_msgs::Float32 = Float;
        std_msgs::Float64 = Double;
        std_msgs::Header = Header;
        std_msgs::Int32 = Int32;
        std_msgs::String = StringMsg;
        std_msgs::UInt32 = UInt32;
        tf2_msgs::TFMessage = PoseV;
        trajectory_msgs::JointTrajectory = JointTrajectory;
    }
}

/// Missing messages have default values, as in protobuf.
fn part<R: Default, G: AsRos<R>>(part: Option<&G>) -> R {
    part.and_then(AsRos::to_ros).unwrap_or_default()
}

/// Converts all elements that have an equivalent in ROS.
fn to_all<R, G: AsRos<R>>(all: &[G]) -> Vec<R> {
    all.iter().filter_map(AsRos::to_ros).collect()
}

/// Converts all elements that have an equivalent in Gazebo.
fn from_all<R, G: AsRos<R>>(all: &[R]) -> Vec<G> {
    all.iter().filter_map(AsRos::from_ros).collect()
}

/// Array with missing elements set to 0.
fn array<const N: usize>(numbers: impl Iterator<Item = f64>) -> [f64; N] {
    let mut array = [0.0; N];
    for (place, number) in array.iter_mut().zip(numbers) {
        *place = number;
    }
    array
}

/// ROS name of a Gazebo frame: `robot::link` is `robot/link`.
fn frame(name: &str) -> String {
    name.replace("::", "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default)]
    struct Check(usize);

    impl Pairs for Check {
        fn pair<R: periplus_msgs::Message, G: AsRos<R>>(&mut self) {
            self.0 += 1;
            let Some(gazebo) = G::from_ros(&R::default()) else {
                // Only images, which need a pixel format.
                assert_eq!(R::TYPE_NAME, "sensor_msgs/msg/Image");
                return;
            };
            let back = gazebo.to_ros().expect("it came from there");
            let again = G::from_ros(&back);
            assert_eq!(again.as_ref(), Some(&gazebo), "{} {}", R::TYPE_NAME, G::NAME);
        }
    }

    #[test]
    fn what_goes_there_and_back_stays() {
        let mut check = Check::default();
        each_pair(&mut check);
        assert!(check.0 > 55, "{}", check.0);
    }
}
