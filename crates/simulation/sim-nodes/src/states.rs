//! Publishers of states: odometry, joints, poses, frames and the clock.

mod body_imu;
mod clock;
mod frame_tree;
mod geometry;
mod gz_odometry;
mod gz_poses;
mod joint_state_publisher;
mod joint_states;
mod noise;
mod odometry;
mod p3d;
mod robot_state_publisher;
mod triggered;

pub use clock::ClockPublisher;
pub(crate) use geometry::{from_vector, planar_twist, pose, transform, vector};
pub use joint_state_publisher::{
    JOINT_STATE_PUBLISHER, JointStateOptions, JointStateParams, JointStateSource,
};
pub use joint_states::JointStatePublisher;
pub(crate) use joint_states::JointStates;
pub(crate) use odometry::{OdometryPublisher, TF_QOS, diagonal, planar_covariance};
pub(crate) use robot_state_publisher::RobotFrames;
pub use robot_state_publisher::{
    DescriptionError, ROBOT_STATE_PUBLISHER, RobotStateError, RobotStateParams, RobotStatePublisher,
};
pub(crate) use triggered::build as triggered;

use periplus_diagnostics::Diagnostics;

use crate::Device;
use crate::drives::BuildContext;

/// Builds the device of a plugin that publishes states. `Err` if the plugin is of another kind.
pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Result<Option<Box<dyn Device>>, ()> {
    fn boxed<D: Device + 'static>(device: Option<D>) -> Option<Box<dyn Device>> {
        device.map(|device| Box::new(device) as Box<dyn Device>)
    }
    Ok(match context.plugin.known.id {
        "gazebo_ros_joint_state_publisher" | "gz-sim-joint-state-publisher-system" => {
            boxed(joint_states::plugin(context, diagnostics))
        }
        "gazebo_ros_imu" | "hector_gazebo_ros_imu" => boxed(body_imu::build(context, diagnostics)),
        "gazebo_ros_p3d" => boxed(p3d::build(context, diagnostics)),
        "gz-sim-odometry-publisher-system" => boxed(gz_odometry::build(context, diagnostics)),
        "gz-sim-pose-publisher-system" => boxed(gz_poses::build(context, diagnostics)),
        "gz-sim-triggered-publisher-system" => {
            boxed(triggered::build(context.setting.graph, context.site.plugin, diagnostics))
        }
        _ => return Err(()),
    })
}
