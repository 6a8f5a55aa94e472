//! Hardware interfaces, controller manager and controllers of `ros2_control` and `ros_control`.
//!
//! A [`Hardware`] has command and state interfaces by name (`left_wheel_joint/velocity`). A
//! [`ControllerManager`] loads controllers ([`ControllerInterface`]), checks that a command interface
//! is claimed by one active controller only, and updates the active ones in each [`ControlCycle`].
//! Controllers receive references and return plain numbers; nodes, topics and the joints of a
//! simulation are in `periplus-sim-nodes`.
//!
//! ```
//! use periplus_ros2_control::{DiffDriveGeometry, PlanarTwist};
//!
//! let geometry = DiffDriveGeometry { separation_m: 0.5, left_radius_m: 0.1, right_radius_m: 0.1 };
//! let twist = PlanarTwist { x_m_s: 0.5, y_m_s: 0.0, yaw_rad_s: 1.0 };
//! // (0.5 - 1.0 * 0.25) / 0.1 and (0.5 + 1.0 * 0.25) / 0.1.
//! assert_eq!(geometry.wheel_speeds(twist), [2.5, 7.5]);
//! ```

mod base_motion;
mod cycle;
mod description;
mod diff_drive;
mod error;
mod forward;
mod hardware;
mod imu;
mod joint_state;
mod joint_trajectory;
mod limits;
mod manager;
mod mecanum;
mod odometry;
mod pid;
mod release;
mod rolling;
mod rolling_mean;
mod single_joint;
mod steering;
mod steering_drive;
mod tables;
mod trajectory;
mod tricycle;
mod velocity_reference;

pub use base_motion::{BaseMotion, MotionCentre, PlanarTwist};
pub use cycle::ControlCycle;
pub use description::{
    ComponentType, DescribedInterface, DescribedJoint, DescribedSensor, HardwareComponent,
    hardware_of_model, hardware_of_transmissions,
};
pub use diff_drive::{DiffDriveController, DiffDriveGeometry, DiffDriveSettings};
pub use error::ControllerError;
pub use forward::ForwardController;
pub use hardware::{Hardware, JointInterfaceKind, LoanedInterfaces};
pub use imu::{ImuBroadcaster, ImuInterfaceValues};
pub use joint_state::{JointStateBroadcaster, JointStateReading};
pub use joint_trajectory::{
    GoalTolerances, JointTolerances, JointTrajectoryController, JointTrajectorySettings,
    TrajectoryErrorCode, TrajectoryOutcome, TrajectoryProgress, TrajectoryRejection,
};
pub use limits::{AccelerationLimits, SpeedLimiter};
pub use manager::{
    ControllerInterface, ControllerLifecycle, ControllerManager, InterfaceSelection,
    LoadedController, SwitchRefused, SwitchRequest, SwitchStrictness, UpdateFailure,
};
pub use mecanum::{MecanumController, MecanumGeometry, MecanumSettings};
pub use odometry::{DiffDriveOdometry, PlanarPose, SpeedMeans};
pub use pid::{PidController, PidGains};
pub use release::{ControlRelease, ControllerKind};
pub use rolling::{RollingWheel, rolling_twist};
pub use rolling_mean::RollingMeanAccumulator;
pub use single_joint::{JointTarget, SingleJointController};
pub use steering::{SteeringGeometry, SteeringKind, SteeringOdometry, WheelCommands};
pub use steering_drive::{SteeringController, SteeringSettings};
pub use tables::{
    CONTROLLER_MANAGER, DIFF_DRIVE, DIFF_DRIVE_ROS1, DiffDriveParams, DiffDriveRos1Params,
    FORWARD_COMMAND, ForwardCommandParams, IMU_BROADCASTER, ImuBroadcasterParams,
    JOINT_CONSTRAINTS, JOINT_GAINS, JOINT_STATE_BROADCASTER, JOINT_TRAJECTORY,
    JointConstraintParams, JointGainParams, JointStateBroadcasterParams, JointTrajectoryParams,
    MECANUM, ManagerParams, MecanumParams, SINGLE_JOINT, STEERING, SingleJointParams,
    SteeringParams, TRICYCLE, TricycleParams, limiter_of,
};
pub use trajectory::{JointTrajectory, SamplePhase, TrajectoryPoint, TrajectorySample};
pub use tricycle::{TricycleCommand, TricycleController, TricycleSettings, tricycle_command};
pub use velocity_reference::{ReferenceOutcome, VelocityReference};
