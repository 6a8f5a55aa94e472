//! Conversion of messages to readings.

use periplus_ekf::{ImuReading, PoseReading, TwistReading};
use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_msgs::geometry_msgs::{
    self, PoseWithCovariance, Quaternion, TwistWithCovariance, Vector3,
};
use periplus_msgs::sensor_msgs::Imu;

/// Minimum norm of a valid quaternion.
const LEAST_LENGTH: f64 = 1e-3;

pub(crate) fn vector(vector: &Vector3) -> DVec3 {
    DVec3::new(vector.x, vector.y, vector.z)
}

fn rotation(it: &Quaternion) -> Option<DQuat> {
    let rotation = DQuat::from_xyzw(it.x, it.y, it.z, it.w);
    let length = rotation.length();
    (length.is_finite() && length > LEAST_LENGTH).then(|| rotation.normalize())
}

/// Converts a pose; none with an invalid quaternion.
pub(crate) fn pose(pose: &geometry_msgs::Pose) -> Option<Pose> {
    let translation = DVec3::new(pose.position.x, pose.position.y, pose.position.z);
    Some(Pose { translation, rotation: rotation(&pose.orientation)? })
}

/// Converts a pose reading; none with an invalid quaternion.
pub(crate) fn of_pose(
    message: &PoseWithCovariance,
    time_ns: i64,
    world_from_frame: Pose,
) -> Option<PoseReading> {
    let frame_from_base = pose(&message.pose)?;
    Some(PoseReading { time_ns, frame_from_base, covariance: message.covariance, world_from_frame })
}

pub(crate) fn of_twist(
    message: &TwistWithCovariance,
    time_ns: i64,
    base_from_sensor: Pose,
) -> TwistReading {
    TwistReading {
        time_ns,
        linear: vector(&message.twist.linear),
        angular: vector(&message.twist.angular),
        covariance: message.covariance,
        base_from_sensor,
    }
}

/// A covariance that begins with -1 marks a missing measurement.
pub(crate) fn of_imu(message: &Imu, base_from_sensor: Pose) -> ImuReading {
    let is_there = |covariance: &[f64; 9]| covariance[0] != -1.0;
    let (turn, rate, push) = (
        message.orientation_covariance,
        message.angular_velocity_covariance,
        message.linear_acceleration_covariance,
    );
    ImuReading {
        time_ns: message.header.stamp.ns(),
        world_from_sensor: rotation(&message.orientation)
            .filter(|_| is_there(&turn))
            .map(|rotation| (rotation, turn)),
        angular: is_there(&rate).then(|| (vector(&message.angular_velocity), rate)),
        acceleration: is_there(&push).then(|| (vector(&message.linear_acceleration), push)),
        base_from_sensor,
    }
}
