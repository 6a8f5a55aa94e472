//! Parameters of the controllers, with the names and defaults of `ros2_controllers` and
//! `ros_controllers`.

mod diff_drive;
mod joint;
mod limits;
mod manager;
mod mecanum;
mod steering;

pub use diff_drive::{DIFF_DRIVE, DIFF_DRIVE_ROS1, DiffDriveParams, DiffDriveRos1Params};
pub use joint::{
    FORWARD_COMMAND, ForwardCommandParams, IMU_BROADCASTER, ImuBroadcasterParams,
    JOINT_CONSTRAINTS, JOINT_GAINS, JOINT_STATE_BROADCASTER, JOINT_TRAJECTORY,
    JointConstraintParams, JointGainParams, JointStateBroadcasterParams, JointTrajectoryParams,
    SINGLE_JOINT, SingleJointParams,
};
pub use limits::limiter_of;
pub use manager::{CONTROLLER_MANAGER, ManagerParams};
pub use mecanum::{MECANUM, MecanumParams};
pub use steering::{STEERING, SteeringParams, TRICYCLE, TricycleParams};
