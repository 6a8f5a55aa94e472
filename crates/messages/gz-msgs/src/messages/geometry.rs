//! Poses, velocities and forces.

use super::{FloatV, Header};
use crate::message::messages;

messages! {
    /// Vector with two elements.
    Vector2d { 1 header: Option<Header>, 2 x: f64, 3 y: f64 }
    /// Vector with three elements.
    Vector3d { 1 header: Option<Header>, 2 x: f64, 3 y: f64, 4 z: f64 }
    /// Rotation.
    Quaternion { 1 header: Option<Header>, 2 x: f64, 3 y: f64, 4 z: f64, 5 w: f64 }
    /// Pose, with the name of the entity.
    Pose {
        1 header: Option<Header>,
        2 name: String,
        3 id: u32,
        4 position: Option<Vector3d>,
        5 orientation: Option<Quaternion>,
    }
    /// Poses.
    PoseV = "Pose_V" { 1 header: Option<Header>, 2 pose: Vec<Pose> }
    /// Velocities.
    Twist { 1 header: Option<Header>, 2 linear: Option<Vector3d>, 3 angular: Option<Vector3d> }
    /// Forces.
    Wrench {
        1 header: Option<Header>,
        2 force: Option<Vector3d>,
        3 torque: Option<Vector3d>,
        4 force_offset: Option<Vector3d>,
    }
    /// Force on an entity.
    EntityWrench {
        1 header: Option<Header>,
        2 entity: Option<super::Entity>,
        3 wrench: Option<Wrench>,
    }
    /// Odometry of a robot.
    Odometry { 1 header: Option<Header>, 2 pose: Option<Pose>, 3 twist: Option<Twist> }
    /// Pose with its covariance: 36 numbers, row-major.
    PoseWithCovariance { 1 pose: Option<Pose>, 2 covariance: Option<FloatV> }
    /// Velocity with its covariance: 36 numbers, row-major.
    TwistWithCovariance { 1 twist: Option<Twist>, 2 covariance: Option<FloatV> }
    /// Odometry of a robot with covariance.
    OdometryWithCovariance {
        1 header: Option<Header>,
        2 pose_with_covariance: Option<PoseWithCovariance>,
        3 twist_with_covariance: Option<TwistWithCovariance>,
    }
    /// Commands for joints over time.
    JointTrajectory {
        1 header: Option<Header>,
        2 joint_names: Vec<String>,
        3 points: Vec<JointTrajectoryPoint>,
    }
    /// Joint positions at a time.
    JointTrajectoryPoint {
        1 positions: Vec<f64>,
        2 velocities: Vec<f64>,
        3 accelerations: Vec<f64>,
        4 effort: Vec<f64>,
        5 time_from_start: Option<super::Duration>,
    }
    /// Commands for motors.
    Actuators {
        1 header: Option<Header>,
        2 position: Vec<f64>,
        3 velocity: Vec<f64>,
        4 normalized: Vec<f64>,
    }
}

impl Vector3d {
    /// Vector of three numbers.
    #[must_use]
    pub fn new(x: f64, y: f64, z: f64) -> Self {
        Self { header: None, x, y, z }
    }
}

impl Quaternion {
    /// Quaternion of four numbers.
    #[must_use]
    pub fn new(x: f64, y: f64, z: f64, w: f64) -> Self {
        Self { header: None, x, y, z, w }
    }
}
