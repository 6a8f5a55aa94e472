//! Networks of a session.

mod gazebo;
mod ros2;

pub(crate) use periplus_dds::DdsError;
pub(crate) use periplus_gz_transport::GzTransportError;

pub(crate) use gazebo::GazeboConnection;
pub use gazebo::GazeboSettings;
pub(crate) use ros2::Ros2Connection;
pub use ros2::Ros2Reach;
