//! Controllers with their topics.

mod broadcasters;
mod drive;
mod drive_settings;
mod forward;
mod odometry_output;
mod single_joint;
mod trajectory;
mod trajectory_messages;

use periplus_ros2_control::ControllerKind;

use super::factory::KnownJoints;
use super::ros_controller::{ControllerNode, RosController};

/// Creates a controller for a node.
pub(super) fn make(part: ControllerNode, joints: &KnownJoints) -> Box<dyn RosController> {
    let joints = KnownJoints::clone(joints);
    match part.kind {
        ControllerKind::JointStateBroadcaster => {
            Box::new(broadcasters::JointStateNode::new(part, &joints))
        }
        ControllerKind::ImuBroadcaster => Box::new(broadcasters::ImuNode::new(part)),
        ControllerKind::DiffDrive if part.release.is_ros1() => {
            Box::new(drive::DriveNode::new(part, joints, drive_settings::diff_drive_ros1))
        }
        ControllerKind::DiffDrive => {
            Box::new(drive::DriveNode::new(part, joints, drive_settings::diff_drive))
        }
        ControllerKind::AckermannSteering
        | ControllerKind::BicycleSteering
        | ControllerKind::TricycleSteering => {
            Box::new(drive::DriveNode::new(part, joints, drive_settings::steering))
        }
        ControllerKind::Tricycle => {
            Box::new(drive::DriveNode::new(part, joints, drive_settings::tricycle))
        }
        ControllerKind::Mecanum => {
            Box::new(drive::DriveNode::new(part, joints, drive_settings::mecanum))
        }
        ControllerKind::Forward
        | ControllerKind::GroupPosition
        | ControllerKind::GroupVelocity
        | ControllerKind::GroupEffort => Box::new(forward::ForwardNode::new(part)),
        ControllerKind::JointPosition
        | ControllerKind::JointVelocity
        | ControllerKind::JointEffort
        | ControllerKind::JointPositionByEffort
        | ControllerKind::JointVelocityByEffort => {
            Box::new(single_joint::SingleJointNode::new(part))
        }
        ControllerKind::JointTrajectory => Box::new(trajectory::TrajectoryNode::new(part, joints)),
    }
}
