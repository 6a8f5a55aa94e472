//! Networks of a session.

mod gazebo;
mod ros1;
mod ros2;

pub(crate) use periplus_dds::DdsError;
pub(crate) use periplus_gz_transport::GzTransportError;

pub(crate) use gazebo::GazeboConnection;
pub use gazebo::GazeboSettings;
pub(crate) use periplus_ros1::Ros1Error;
pub use periplus_ros1::Ros1Reach;
pub use periplus_ros1::XmlRpcValue as Ros1Value;
pub(crate) use ros1::Ros1Connection;
pub use ros1::join_ros1;
pub(crate) use ros2::Ros2Connection;
pub use ros2::Ros2Reach;
