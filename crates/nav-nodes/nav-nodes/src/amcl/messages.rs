//! Conversions between messages and localization.

use periplus_geometry::{DQuat, Pose, Pose2};
use periplus_localization::{Covariance2, Particles};
use periplus_msgs::geometry_msgs::{self, PoseWithCovariance, PoseWithCovarianceStamped};
use periplus_msgs::nav2_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::pose;

/// Maximum difference of the norm of a quaternion from 1.
const MAX_NORM_ERROR: f64 = 0.01;

/// Converts a pose to a planar one. The error is a description of an invalid orientation.
pub(crate) fn pose2(pose: &geometry_msgs::Pose) -> Result<Pose2, String> {
    let geometry_msgs::Pose { position, orientation: q } = pose;
    let rotation = DQuat::from_xyzw(q.x, q.y, q.z, q.w);
    let length = rotation.length();
    // NaN is invalid, too.
    let is_rotation = (length - 1.0).abs() < MAX_NORM_ERROR;
    if !is_rotation {
        return Err(format!(
            "its orientation ({}, {}, {}, {}) is not a rotation: the norm of the quaternion is \
             {length:.3}, not 1",
            q.x, q.y, q.z, q.w
        ));
    }
    let xyz = [position.x, position.y, position.z];
    Ok(Pose2::from(Pose::from_xyz_quaternion(xyz, rotation)))
}

pub(crate) fn pose_with_covariance(
    map_from_base: Pose2,
    covariance: Covariance2,
    time_ns: i64,
    frame: &str,
) -> PoseWithCovarianceStamped {
    PoseWithCovarianceStamped {
        header: Header::at(time_ns, frame),
        pose: PoseWithCovariance { pose: pose(map_from_base), covariance: covariance.to_rows() },
    }
}

pub(crate) fn particle_cloud(
    particles: &Particles,
    time_ns: i64,
    frame: &str,
) -> nav2_msgs::ParticleCloud {
    let particle = |index: usize| nav2_msgs::Particle {
        pose: pose(particles.pose(index)),
        weight: particles.weight[index],
    };
    nav2_msgs::ParticleCloud {
        header: Header::at(time_ns, frame),
        particles: (0..particles.len()).map(particle).collect(),
    }
}

pub(crate) fn pose_array(
    all: impl Iterator<Item = Pose2>,
    time_ns: i64,
    frame: &str,
) -> geometry_msgs::PoseArray {
    geometry_msgs::PoseArray { header: Header::at(time_ns, frame), poses: all.map(pose).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_round_trip_and_invalid_rotations_are_errors() {
        let there = Pose2::new(1.0, -2.0, 3.0);
        let back = pose2(&pose(there)).unwrap_or_default();
        assert!((back.yaw_rad - 3.0).abs() < 1e-12 && back.x_m == 1.0, "{back:?}");
        let mut bad = pose(there);
        bad.orientation = geometry_msgs::Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 0.0 };
        assert!(pose2(&bad).is_err_and(|why| why.contains("is not a rotation")));
        bad.orientation.w = f64::NAN;
        assert!(pose2(&bad).is_err());
    }
}
