//! Releases, and the classes of controllers.

/// Release of ROS whose controllers are reproduced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum ControlRelease {
    /// `ros_control` of ROS 1.
    Noetic,
    /// Humble and Iron.
    Humble,
    /// Jazzy and Kilted.
    #[default]
    Jazzy,
    /// Rolling and later releases.
    Main,
}

impl ControlRelease {
    /// Returns true for `ros_control` of ROS 1.
    #[must_use]
    pub fn is_ros1(self) -> bool {
        self == Self::Noetic
    }
}

/// Class of a controller, of ROS 1 and ROS 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControllerKind {
    /// Publisher of joint states.
    JointStateBroadcaster,
    /// Publisher of an inertial sensor.
    ImuBroadcaster,
    /// Differential drive.
    DiffDrive,
    /// Two steered and two driven wheels.
    AckermannSteering,
    /// One steered and one driven wheel.
    BicycleSteering,
    /// One steered and two driven wheels.
    TricycleSteering,
    /// One wheel that is steered and driven.
    Tricycle,
    /// Four mecanum wheels.
    Mecanum,
    /// Commands forwarded to one interface of several joints.
    Forward,
    /// Commands forwarded to the positions of several joints.
    GroupPosition,
    /// Commands forwarded to the velocities of several joints.
    GroupVelocity,
    /// Commands forwarded to the efforts of several joints.
    GroupEffort,
    /// Position of one joint (ROS 1).
    JointPosition,
    /// Velocity of one joint (ROS 1).
    JointVelocity,
    /// Effort of one joint (ROS 1).
    JointEffort,
    /// Position of one joint by a PID controller with efforts (ROS 1).
    JointPositionByEffort,
    /// Velocity of one joint by a PID controller with efforts (ROS 1).
    JointVelocityByEffort,
    /// Trajectories.
    JointTrajectory,
}

/// Classes by their names in ROS 2.
const CLASSES_ROS2: &[(&str, ControllerKind)] = &[
    ("joint_state_broadcaster/JointStateBroadcaster", ControllerKind::JointStateBroadcaster),
    ("imu_sensor_broadcaster/IMUSensorBroadcaster", ControllerKind::ImuBroadcaster),
    ("diff_drive_controller/DiffDriveController", ControllerKind::DiffDrive),
    (
        "ackermann_steering_controller/AckermannSteeringController",
        ControllerKind::AckermannSteering,
    ),
    ("bicycle_steering_controller/BicycleSteeringController", ControllerKind::BicycleSteering),
    ("tricycle_steering_controller/TricycleSteeringController", ControllerKind::TricycleSteering),
    ("tricycle_controller/TricycleController", ControllerKind::Tricycle),
    ("mecanum_drive_controller/MecanumDriveController", ControllerKind::Mecanum),
    ("forward_command_controller/ForwardCommandController", ControllerKind::Forward),
    ("position_controllers/JointGroupPositionController", ControllerKind::GroupPosition),
    ("velocity_controllers/JointGroupVelocityController", ControllerKind::GroupVelocity),
    ("effort_controllers/JointGroupEffortController", ControllerKind::GroupEffort),
    ("joint_trajectory_controller/JointTrajectoryController", ControllerKind::JointTrajectory),
];

/// Classes by their names in ROS 1.
const CLASSES_ROS1: &[(&str, ControllerKind)] = &[
    ("joint_state_controller/JointStateController", ControllerKind::JointStateBroadcaster),
    ("imu_sensor_controller/ImuSensorController", ControllerKind::ImuBroadcaster),
    ("diff_drive_controller/DiffDriveController", ControllerKind::DiffDrive),
    ("position_controllers/JointPositionController", ControllerKind::JointPosition),
    ("velocity_controllers/JointVelocityController", ControllerKind::JointVelocity),
    ("effort_controllers/JointEffortController", ControllerKind::JointEffort),
    ("effort_controllers/JointPositionController", ControllerKind::JointPositionByEffort),
    ("effort_controllers/JointVelocityController", ControllerKind::JointVelocityByEffort),
    ("position_controllers/JointGroupPositionController", ControllerKind::GroupPosition),
    ("velocity_controllers/JointGroupVelocityController", ControllerKind::GroupVelocity),
    ("effort_controllers/JointGroupEffortController", ControllerKind::GroupEffort),
    ("position_controllers/JointTrajectoryController", ControllerKind::JointTrajectory),
    ("velocity_controllers/JointTrajectoryController", ControllerKind::JointTrajectory),
    ("effort_controllers/JointTrajectoryController", ControllerKind::JointTrajectory),
    ("pos_vel_controllers/JointTrajectoryController", ControllerKind::JointTrajectory),
];

impl ControllerKind {
    /// Returns the classes of a release by their names.
    #[must_use]
    pub fn classes(release: ControlRelease) -> &'static [(&'static str, Self)] {
        if release.is_ros1() { CLASSES_ROS1 } else { CLASSES_ROS2 }
    }

    /// Returns the class of a name; `None` if it is not built in.
    #[must_use]
    pub fn of_class(release: ControlRelease, class: &str) -> Option<Self> {
        let found = Self::classes(release).iter().find(|(name, _)| *name == class.trim());
        found.map(|(_, kind)| *kind)
    }

    /// Returns true if it moves the base of a robot.
    #[must_use]
    pub fn is_drive(self) -> bool {
        matches!(
            self,
            Self::DiffDrive
                | Self::AckermannSteering
                | Self::BicycleSteering
                | Self::TricycleSteering
                | Self::Tricycle
                | Self::Mecanum
        )
    }

    /// Returns true if it only publishes.
    #[must_use]
    pub fn is_broadcaster(self) -> bool {
        matches!(self, Self::JointStateBroadcaster | Self::ImuBroadcaster)
    }
}
