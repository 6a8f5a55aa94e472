//! Messages. Names, numbers and types of fields are those of `gz-msgs`.

mod basic;
mod geometry;
mod scene;
mod sensors;
mod wire;
mod world;

pub use basic::*;
pub use geometry::*;
pub use scene::*;
pub use sensors::*;
pub use wire::*;
pub use world::*;

use crate::Message;

/// Visitor of all messages that occur in topics or services.
pub(crate) trait Each {
    fn message<M: Message>(&mut self);
}

macro_rules! each {
    ($each:ident: $($name:ident)*) => {{
        $($each.message::<$name>();)*
    }};
}

pub(crate) fn each(each: &mut impl Each) {
    each!(each: Actuators Altimeter Any BatteryState Boolean Bytes CameraInfo Clock Color Contact
        Contacts Double Duration Empty Entity EntityFactory EntityFactoryV EntityWrench Float FloatV
        FluidPressure Gui GuiCamera Header Image Imu Int32 Int64 JointTrajectory JointWrench Joy
        LaserScan Light Link LogicalCameraImage Magnetometer Model NavSat Odometry
        OdometryWithCovariance Param ParamV Physics PointCloudPacked Pose PoseV PoseWithCovariance
        Quaternion Scene SdfGeneratorConfig SensorNoise SphericalCoordinates StringMsg StringMsgV
        Time TrackVisual Twist TwistWithCovariance UInt32 UInt32V UInt64 Vector2d Vector3d
        VideoRecord Visual WorldControl WorldStatistics Wrench);
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Names(Vec<&'static str>);

    impl Each for Names {
        fn message<M: Message>(&mut self) {
            self.0.push(M::NAME);
            assert_eq!(M::decode(&M::default().encode()), Ok(M::default()), "{}", M::NAME);
        }
    }

    #[test]
    fn all_have_names_of_their_own() {
        let mut names = Names(Vec::new());
        each(&mut names);
        let mut names = names.0;
        names.sort_unstable();
        let all = names.len();
        names.dedup();
        assert_eq!(names.len(), all);
        for name in ["Pose_V", "IMU", "StringMsg_V", "EntityFactory_V", "GUI"] {
            assert!(names.contains(&name), "{name}");
        }
    }
}
