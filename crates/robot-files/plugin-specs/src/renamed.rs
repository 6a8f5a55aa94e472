//! ROS 2 replacements of ROS 1 parameters.
//!
//! Names that only changed from camel case (`frameName`, `frame_name`) are not listed: the search for
//! similar names finds them. Source: the migration guides of `gazebo_ros_pkgs` and both branches' sources.

use crate::{PluginSpec, Role};

/// Replacement of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Instead {
    /// This parameter, with the same value.
    Parameter(&'static str),
    /// This parameter, with translated values.
    Translated(&'static str, &'static [(&'static str, &'static str)]),
    /// This element of the sensor.
    Sensor(&'static str),
    /// A remapping of this topic in `<ros>`.
    Remapping(&'static str),
    /// `<namespace>` in `<ros>`.
    Namespace,
    /// No replacement, with the reason.
    Nothing(&'static str),
}

use Instead::{Namespace, Nothing, Parameter, Remapping, Sensor, Translated};

/// Replacement of a ROS 1 parameter in a ROS 2 plugin (or of one in old ROS 2 documentation), unless the
/// names are similar.
pub(crate) fn renamed(known: &PluginSpec, name: &str, value: &str) -> Option<Instead> {
    let has = |parameter: &str| known.table.find(parameter).is_some();
    let sensor = known.role == Role::Sensor;
    let zero = value.parse() == Ok(0.0);
    let camera = known.id == "gazebo_ros_camera";
    let instead = match name {
        "robotNamespace" => Namespace,
        "distortionK1" | "distortion_k1" | "distortionK2" | "distortion_k2" | "distortionK3"
        | "distortion_k3" | "distortionT1" | "distortion_t1" | "distortionT2" | "distortion_t2"
            if zero =>
        {
            Nothing("0 is the default; write other values in the sensor's `<distortion>`")
        }
        "xyzOffset" | "xyzOffsets" | "rpyOffset" | "rpyOffsets" if sensor => {
            Nothing("the sensor's `<pose>` sets its position")
        }
        "updateRate" | "updateRateHZ" if sensor && zero => {
            Nothing("the sensor's `<update_rate>` decides")
        }
        "alwaysOn" if sensor => Sensor("always_on"),
        "alwaysOn" => Nothing("plugins always run"),
        "updateRate" | "updateRateHZ" if sensor => Sensor("update_rate"),
        "topicName" => Remapping(known.topics.first()?.name),
        "bodyName" if sensor && !has("body_name") => {
            Nothing("the plugin monitors the link of its sensor")
        }
        "gaussianNoise" if sensor && !has("gaussian_noise") => Sensor("noise"),
        "commandTopic" | "command_topic" | "cmd_vel_topic" => Remapping("cmd_vel"),
        "odometryTopic" | "odometry_topic" | "odom_topic" => Remapping("odom"),
        "bumperTopicName" => Remapping("bumper_states"),
        "wheel_radius" | "wheel_base" | "track_width"
            if known.id == "gazebo_ros_ackermann_drive" =>
        {
            Nothing("the plugin measures it in the model")
        }
        "wheelTorque" | "torque" => Parameter("max_wheel_torque"),
        "wheelAcceleration" => Parameter("max_wheel_acceleration"),
        "wheelDeceleration" => Parameter("max_wheel_deceleration"),
        "encoderWheelSeparation" => Parameter("wheel_separation"),
        "steeringSpeed" => Parameter("max_steering_speed"),
        "odometrySource" => Translated("odometry_source", &[("encoder", "0"), ("world", "1")]),
        "publishTf" | "publishTF" | "broadcastTF" => Parameter("publish_odom_tf"),
        "publishOdometry" => Parameter("publish_odom"),
        "odometryRate" | "odometry_rate" => Parameter("publish_rate"),
        "publishWheelJointState" => Nothing("`libgazebo_ros_joint_state_publisher.so` does it"),
        "rosDebugLevel" => Nothing("the log level is set when the program starts"),
        "legacyMode" => Nothing("ROS 2 does not swap the sides"),
        "hokuyoMinIntensity" => Parameter("min_intensity"),
        "radiation" => Parameter("radiation_type"),
        "fov" if sensor => Nothing("it follows from the sensor's `<scan>`"),
        "pointCloudCutoff" => Parameter("min_depth"),
        "pointCloudCutoffMax" => Parameter("max_depth"),
        "baseline" | "hackBaseline" => Parameter("hack_baseline"),
        "CxPrime" => Nothing("ROS 2 has no such parameter"),
        // In ROS 1 zero meant "from the image"; in ROS 2 zero would be used as is.
        "Cx" | "Cy" | "focalLength" if zero => {
            Nothing("0 meant to compute it from the image, which is the default")
        }
        "distortionK1" | "distortion_k1" => Sensor("camera><distortion><k1"),
        "distortionK2" | "distortion_k2" => Sensor("camera><distortion><k2"),
        "distortionK3" | "distortion_k3" => Sensor("camera><distortion><k3"),
        "distortionT1" | "distortion_t1" => Sensor("camera><distortion><p1"),
        "distortionT2" | "distortion_t2" => Sensor("camera><distortion><p2"),
        "autoDistortion" => Nothing("the sensor's `<distortion>` is always in the camera info"),
        "imageTopicName" if camera => Remapping("{camera_name}/image_raw"),
        "cameraInfoTopicName" if camera => Remapping("{camera_name}/camera_info"),
        "depthImageTopicName" if camera => Remapping("{camera_name}/depth/image_raw"),
        "depthImageCameraInfoTopicName" if camera => Remapping("{camera_name}/depth/camera_info"),
        "pointCloudTopicName" if camera => Remapping("{camera_name}/points"),
        "triggerTopicName" if camera => Remapping("{camera_name}/image_trigger"),
        "useDepth16UC1Format" | "reduceNormals" | "normalsTopicName" => {
            Nothing("ROS 2 has no such parameter")
        }
        _ => return None,
    };
    match instead {
        Parameter(parameter) | Translated(parameter, _) if !has(parameter) => None,
        Sensor(_) if !sensor => None,
        instead => Some(instead),
    }
}
