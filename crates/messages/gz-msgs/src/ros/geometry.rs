//! Poses, velocities and forces.

use periplus_msgs::builtin_interfaces::Duration as RosDuration;
use periplus_msgs::{geometry_msgs as ros, nav_msgs, std_msgs, tf2_msgs, trajectory_msgs};

use super::{AsRos, array, frame, from_all, part, to_all};
use crate::{
    Duration, FloatV, Header, JointTrajectory, JointTrajectoryPoint, Odometry,
    OdometryWithCovariance, Pose, PoseV, PoseWithCovariance, Quaternion, Twist,
    TwistWithCovariance, Vector3d, Wrench,
};

macro_rules! vectors {
    ($($ros:ident)*) => {$(
        impl AsRos<ros::$ros> for Vector3d {
            fn to_ros(&self) -> Option<ros::$ros> {
                Some(ros::$ros { x: self.x, y: self.y, z: self.z })
            }

            fn from_ros(ros: &ros::$ros) -> Option<Self> {
                Some(Self::new(ros.x, ros.y, ros.z))
            }
        }
    )*};
}

vectors!(Point Vector3);

impl AsRos<ros::Quaternion> for Quaternion {
    fn to_ros(&self) -> Option<ros::Quaternion> {
        Some(ros::Quaternion { x: self.x, y: self.y, z: self.z, w: self.w })
    }

    fn from_ros(ros: &ros::Quaternion) -> Option<Self> {
        Some(Self::new(ros.x, ros.y, ros.z, ros.w))
    }
}

impl AsRos<ros::Pose> for Pose {
    fn to_ros(&self) -> Option<ros::Pose> {
        let (position, orientation) = (self.position.as_ref(), self.orientation.as_ref());
        // In ROS an unset quaternion is the identity, in protobuf it is all zeros.
        Some(ros::Pose {
            position: part(position),
            orientation: orientation.map_or_else(ros::Quaternion::default, |it| part(Some(it))),
        })
    }

    fn from_ros(ros: &ros::Pose) -> Option<Self> {
        let (position, orientation) =
            (Vector3d::from_ros(&ros.position), Quaternion::from_ros(&ros.orientation));
        Some(Self { position, orientation, ..Self::default() })
    }
}

impl AsRos<ros::Transform> for Pose {
    fn to_ros(&self) -> Option<ros::Transform> {
        let pose: ros::Pose = self.to_ros()?;
        Some(ros::Transform {
            translation: part(self.position.as_ref()),
            rotation: pose.orientation,
        })
    }

    fn from_ros(ros: &ros::Transform) -> Option<Self> {
        let (position, orientation) =
            (Vector3d::from_ros(&ros.translation), Quaternion::from_ros(&ros.rotation));
        Some(Self { position, orientation, ..Self::default() })
    }
}

impl AsRos<ros::PoseStamped> for Pose {
    fn to_ros(&self) -> Option<ros::PoseStamped> {
        Some(ros::PoseStamped { header: part(self.header.as_ref()), pose: self.to_ros()? })
    }

    fn from_ros(ros: &ros::PoseStamped) -> Option<Self> {
        let pose = <Self as AsRos<ros::Pose>>::from_ros(&ros.pose)?;
        Some(Self { header: Header::from_ros(&ros.header), ..pose })
    }
}

/// The child frame of a message is an entry of its header.
fn child_frame(header: Option<&Header>) -> Option<String> {
    header?.word("child_frame_id").map(frame)
}

fn with_child(header: &std_msgs::Header, child_frame_id: &str) -> Option<Header> {
    Some(Header::from_ros(header)?.with("child_frame_id", child_frame_id))
}

impl AsRos<ros::TransformStamped> for Pose {
    fn to_ros(&self) -> Option<ros::TransformStamped> {
        Some(ros::TransformStamped {
            header: part(self.header.as_ref()),
            child_frame_id: child_frame(self.header.as_ref()).unwrap_or_default(),
            transform: self.to_ros()?,
        })
    }

    fn from_ros(ros: &ros::TransformStamped) -> Option<Self> {
        let pose = <Self as AsRos<ros::Transform>>::from_ros(&ros.transform)?;
        Some(Self { header: with_child(&ros.header, &ros.child_frame_id), ..pose })
    }
}

impl AsRos<tf2_msgs::TFMessage> for PoseV {
    fn to_ros(&self) -> Option<tf2_msgs::TFMessage> {
        Some(tf2_msgs::TFMessage { transforms: to_all(&self.pose) })
    }

    fn from_ros(ros: &tf2_msgs::TFMessage) -> Option<Self> {
        let first = ros.transforms.first();
        let header = first.and_then(|transform| Header::from_ros(&transform.header));
        Some(Self { header, pose: from_all(&ros.transforms) })
    }
}

impl AsRos<ros::PoseArray> for PoseV {
    fn to_ros(&self) -> Option<ros::PoseArray> {
        Some(ros::PoseArray { header: part(self.header.as_ref()), poses: to_all(&self.pose) })
    }

    fn from_ros(ros: &ros::PoseArray) -> Option<Self> {
        Some(Self { header: Header::from_ros(&ros.header), pose: from_all(&ros.poses) })
    }
}

impl AsRos<ros::Twist> for Twist {
    fn to_ros(&self) -> Option<ros::Twist> {
        Some(ros::Twist {
            linear: part(self.linear.as_ref()),
            angular: part(self.angular.as_ref()),
        })
    }

    fn from_ros(ros: &ros::Twist) -> Option<Self> {
        let (linear, angular) = (Vector3d::from_ros(&ros.linear), Vector3d::from_ros(&ros.angular));
        Some(Self { header: None, linear, angular })
    }
}

impl AsRos<ros::TwistStamped> for Twist {
    fn to_ros(&self) -> Option<ros::TwistStamped> {
        Some(ros::TwistStamped { header: part(self.header.as_ref()), twist: self.to_ros()? })
    }

    fn from_ros(ros: &ros::TwistStamped) -> Option<Self> {
        let twist = <Self as AsRos<ros::Twist>>::from_ros(&ros.twist)?;
        Some(Self { header: Header::from_ros(&ros.header), ..twist })
    }
}

impl AsRos<ros::Wrench> for Wrench {
    fn to_ros(&self) -> Option<ros::Wrench> {
        let (force, torque) = (part(self.force.as_ref()), part(self.torque.as_ref()));
        Some(ros::Wrench { force, torque })
    }

    fn from_ros(ros: &ros::Wrench) -> Option<Self> {
        let (force, torque) = (Vector3d::from_ros(&ros.force), Vector3d::from_ros(&ros.torque));
        Some(Self { force, torque, ..Self::default() })
    }
}

impl AsRos<ros::WrenchStamped> for Wrench {
    fn to_ros(&self) -> Option<ros::WrenchStamped> {
        Some(ros::WrenchStamped { header: part(self.header.as_ref()), wrench: self.to_ros()? })
    }

    fn from_ros(ros: &ros::WrenchStamped) -> Option<Self> {
        let wrench = <Self as AsRos<ros::Wrench>>::from_ros(&ros.wrench)?;
        Some(Self { header: Header::from_ros(&ros.header), ..wrench })
    }
}

/// Elements of a matrix, as far as given.
pub(super) fn matrix<const N: usize>(numbers: Option<&FloatV>) -> [f64; N] {
    array(numbers.into_iter().flat_map(|numbers| &numbers.data).map(|&number| number.into()))
}

#[expect(clippy::cast_possible_truncation, reason = "Gazebo has them in single precision")]
pub(super) fn numbers(matrix: &[f64]) -> Option<FloatV> {
    let data = matrix.iter().map(|&number| number as f32).collect();
    Some(FloatV { header: None, data })
}

impl AsRos<ros::PoseWithCovariance> for PoseWithCovariance {
    fn to_ros(&self) -> Option<ros::PoseWithCovariance> {
        let (pose, covariance) = (part(self.pose.as_ref()), matrix(self.covariance.as_ref()));
        Some(ros::PoseWithCovariance { pose, covariance })
    }

    fn from_ros(ros: &ros::PoseWithCovariance) -> Option<Self> {
        let pose = <Pose as AsRos<ros::Pose>>::from_ros(&ros.pose);
        Some(Self { pose, covariance: numbers(&ros.covariance) })
    }
}

impl AsRos<ros::PoseWithCovarianceStamped> for PoseWithCovariance {
    fn to_ros(&self) -> Option<ros::PoseWithCovarianceStamped> {
        let header = self.pose.as_ref().and_then(|pose| pose.header.as_ref());
        Some(ros::PoseWithCovarianceStamped { header: part(header), pose: self.to_ros()? })
    }

    fn from_ros(ros: &ros::PoseWithCovarianceStamped) -> Option<Self> {
        let mut made = <Self as AsRos<ros::PoseWithCovariance>>::from_ros(&ros.pose)?;
        made.pose.as_mut()?.header = Header::from_ros(&ros.header);
        Some(made)
    }
}

impl AsRos<ros::TwistWithCovariance> for TwistWithCovariance {
    fn to_ros(&self) -> Option<ros::TwistWithCovariance> {
        let (twist, covariance) = (part(self.twist.as_ref()), matrix(self.covariance.as_ref()));
        Some(ros::TwistWithCovariance { twist, covariance })
    }

    fn from_ros(ros: &ros::TwistWithCovariance) -> Option<Self> {
        let twist = <Twist as AsRos<ros::Twist>>::from_ros(&ros.twist);
        Some(Self { twist, covariance: numbers(&ros.covariance) })
    }
}

impl AsRos<ros::TwistWithCovarianceStamped> for TwistWithCovariance {
    fn to_ros(&self) -> Option<ros::TwistWithCovarianceStamped> {
        let header = self.twist.as_ref().and_then(|twist| twist.header.as_ref());
        Some(ros::TwistWithCovarianceStamped { header: part(header), twist: self.to_ros()? })
    }

    fn from_ros(ros: &ros::TwistWithCovarianceStamped) -> Option<Self> {
        let mut made = <Self as AsRos<ros::TwistWithCovariance>>::from_ros(&ros.twist)?;
        made.twist.as_mut()?.header = Header::from_ros(&ros.header);
        Some(made)
    }
}

impl AsRos<nav_msgs::Odometry> for Odometry {
    fn to_ros(&self) -> Option<nav_msgs::Odometry> {
        let mut ros = nav_msgs::Odometry {
            header: part(self.header.as_ref()),
            child_frame_id: child_frame(self.header.as_ref()).unwrap_or_default(),
            ..nav_msgs::Odometry::default()
        };
        ros.pose.pose = part(self.pose.as_ref());
        ros.twist.twist = part(self.twist.as_ref());
        Some(ros)
    }

    fn from_ros(ros: &nav_msgs::Odometry) -> Option<Self> {
        Some(Self {
            header: with_child(&ros.header, &ros.child_frame_id),
            pose: <Pose as AsRos<ros::Pose>>::from_ros(&ros.pose.pose),
            twist: <Twist as AsRos<ros::Twist>>::from_ros(&ros.twist.twist),
        })
    }
}

impl AsRos<nav_msgs::Odometry> for OdometryWithCovariance {
    fn to_ros(&self) -> Option<nav_msgs::Odometry> {
        Some(nav_msgs::Odometry {
            header: part(self.header.as_ref()),
            child_frame_id: child_frame(self.header.as_ref()).unwrap_or_default(),
            pose: part(self.pose_with_covariance.as_ref()),
            twist: part(self.twist_with_covariance.as_ref()),
        })
    }

    fn from_ros(ros: &nav_msgs::Odometry) -> Option<Self> {
        Some(Self {
            header: with_child(&ros.header, &ros.child_frame_id),
            pose_with_covariance: AsRos::from_ros(&ros.pose),
            twist_with_covariance: AsRos::from_ros(&ros.twist),
        })
    }
}

impl AsRos<RosDuration> for Duration {
    fn to_ros(&self) -> Option<RosDuration> {
        let sec = i32::try_from(self.sec).unwrap_or(i32::MAX);
        Some(RosDuration { sec, nanosec: u32::try_from(self.nsec).unwrap_or_default() })
    }

    fn from_ros(ros: &RosDuration) -> Option<Self> {
        let nsec = i32::try_from(ros.nanosec).unwrap_or_default();
        Some(Self { header: None, sec: ros.sec.into(), nsec })
    }
}

impl AsRos<trajectory_msgs::JointTrajectoryPoint> for JointTrajectoryPoint {
    fn to_ros(&self) -> Option<trajectory_msgs::JointTrajectoryPoint> {
        Some(trajectory_msgs::JointTrajectoryPoint {
            positions: self.positions.clone(),
            velocities: self.velocities.clone(),
            accelerations: self.accelerations.clone(),
            effort: self.effort.clone(),
            time_from_start: part(self.time_from_start.as_ref()),
        })
    }

    fn from_ros(ros: &trajectory_msgs::JointTrajectoryPoint) -> Option<Self> {
        Some(Self {
            positions: ros.positions.clone(),
            velocities: ros.velocities.clone(),
            accelerations: ros.accelerations.clone(),
            effort: ros.effort.clone(),
            time_from_start: Duration::from_ros(&ros.time_from_start),
        })
    }
}

impl AsRos<trajectory_msgs::JointTrajectory> for JointTrajectory {
    fn to_ros(&self) -> Option<trajectory_msgs::JointTrajectory> {
        Some(trajectory_msgs::JointTrajectory {
            header: part(self.header.as_ref()),
            joint_names: self.joint_names.clone(),
            points: to_all(&self.points),
        })
    }

    fn from_ros(ros: &trajectory_msgs::JointTrajectory) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            joint_names: ros.joint_names.clone(),
            points: from_all(&ros.points),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odometry_keeps_the_frame_that_it_places() {
        let header = Header::at(5, "bot::odom").with("child_frame_id", "bot::chassis");
        let pose = Pose { position: Some(Vector3d::new(1.0, 2.0, 0.0)), ..Pose::default() };
        let odometry = Odometry { header: Some(header), pose: Some(pose), twist: None };
        let ros = odometry.to_ros().expect("odometry");
        assert_eq!(
            (ros.header.frame_id.as_str(), ros.child_frame_id.as_str()),
            ("bot/odom", "bot/chassis")
        );
        assert_eq!((ros.pose.pose.position.x, ros.pose.pose.position.y), (1.0, 2.0));
    }

    #[test]
    fn poses_with_frames_are_transforms() {
        let placed = |child: &str, x| Pose {
            header: Some(Header::at(7, "odom").with("child_frame_id", child)),
            position: Some(Vector3d::new(x, 0.0, 0.0)),
            ..Pose::default()
        };
        let poses = PoseV { header: None, pose: vec![placed("a", 1.0), placed("b::c", 2.0)] };
        let ros: tf2_msgs::TFMessage = poses.to_ros().expect("transforms");
        let told: Vec<(&str, &str, f64)> = ros
            .transforms
            .iter()
            .map(|it| {
                (
                    it.header.frame_id.as_str(),
                    it.child_frame_id.as_str(),
                    it.transform.translation.x,
                )
            })
            .collect();
        assert_eq!(told, [("odom", "a", 1.0), ("odom", "b/c", 2.0)]);
    }
}
