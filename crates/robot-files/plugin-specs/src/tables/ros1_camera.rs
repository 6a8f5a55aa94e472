//! Cameras of `gazebo_ros_pkgs`, branch `noetic-devel`.

use periplus_params::{NamedEntity, Parameter, flag, number, text};

use super::of_ros1;
use crate::PluginSpec;
use crate::known::publishes;

const fn topic(name: &'static str, doc: &'static str, default: &'static str) -> Parameter {
    text(name, doc).or(default).naming(NamedEntity::Topic)
}

const fn distortion(name: &'static str, alias: &'static [&'static str]) -> Parameter {
    number(name, "", "Distortion in the camera info.").or("0").also(alias)
}

/// Parameters of all cameras.
macro_rules! camera {
    ($id:literal, $doc:literal, [$($parameter:expr),* $(,)?]) => {
        of_ros1!($id, Sensor, Simulated, $doc, [
            text("cameraName", "Prefix of every topic."),
            topic("imageTopicName", "Topic of images.", "image_raw"),
            topic("cameraInfoTopicName", "Topic of the camera info.", "camera_info"),
            text("frameName", "Frame of the messages.").or("world").naming(NamedEntity::Frame),
            number("updateRate", "Hz", "Images per second; 0: the sensor's rate.").or("0").min(0.0),
            number("CxPrime", "px", "Column of the rectified principal point; 0: the middle.")
                .or("0"),
            number("Cx", "px", "Column of the principal point; 0: the middle.").or("0"),
            number("Cy", "px", "Row of the principal point; 0: the middle.").or("0"),
            number("focalLength", "px", "Focal length; 0: computed from the field of view.").or("0").min(0.0),
            number("hackBaseline", "m", "Distance from the left camera of a stereo pair.").or("0"),
            distortion("distortionK1", &["distortion_k1"]),
            distortion("distortionK2", &["distortion_k2"]),
            distortion("distortionK3", &["distortion_k3"]),
            distortion("distortionT1", &["distortion_t1"]),
            distortion("distortionT2", &["distortion_t2"]),
            flag("autoDistortion", "If true, the sensor's distortion goes into the camera info."),
            flag("borderCrop", "If true, the black border of a distortion is cut off.").or("true"),
            $($parameter),*
        ])
        .topics(&[
            publishes("{cameraName}/image_raw").set_by("imageTopicName"),
            publishes("{cameraName}/camera_info").set_by("cameraInfoTopicName"),
        ])
    };
}

const DEPTH_TOPIC: Parameter = topic("depthImageTopicName", "Topic of depths.", "depth/image_raw");

const DEPTH_INFO_TOPIC: Parameter = topic(
    "depthImageCameraInfoTopicName",
    "Topic of the camera info of depths.",
    "depth/camera_info",
);

const CLOUD_TOPIC: Parameter = topic("pointCloudTopicName", "Topic of points.", "points");

const CUTOFF: Parameter = number("pointCloudCutoff", "m", "Minimum depth.").or("0.4").min(0.0);

const fn cutoff_max(default: &'static str) -> Parameter {
    number("pointCloudCutoffMax", "m", "Maximum depth.").or(default).min(0.0)
}

const BASELINE: Parameter =
    number("baseline", "m", "Distance of the infrared projector from the camera.");

pub(super) static PLUGINS: &[PluginSpec] = &[
    camera!("gazebo_ros_camera", "Publishes the images of a `camera` sensor.", []),
    camera!(
        "gazebo_ros_depth_camera",
        "Publishes images, depths and points of a `depth` sensor.",
        [
            DEPTH_TOPIC,
            DEPTH_INFO_TOPIC,
            CLOUD_TOPIC,
            CUTOFF,
            cutoff_max("5"),
            BASELINE,
            topic("normalsTopicName", "Topic of surface normals.", "normals"),
            topic("reflectanceTopicName", "Topic of reflectances.", "reflectance"),
            number("reduceNormals", "", "Every Nth normal is shown.").or("50"),
            flag("useDepth16UC1Format", "If true, depths are millimetres in 16 bits.").or("false"),
        ]
    ),
    camera!(
        "gazebo_ros_openni_kinect",
        "Publishes images, depths and points of a `depth` sensor like a Kinect.",
        [
            DEPTH_TOPIC,
            DEPTH_INFO_TOPIC,
            CLOUD_TOPIC,
            CUTOFF,
            cutoff_max("5"),
            BASELINE,
            flag("useDepth16UC1Format", "If true, depths are millimetres in 16 bits.").or("false"),
        ]
    ),
    camera!("gazebo_ros_multicamera", "Publishes the images of a `multicamera` sensor.", []),
    camera!(
        "gazebo_ros_triggered_camera",
        "Publishes an image of a `camera` sensor on each trigger.",
        [topic("triggerTopicName", "Topic of triggers.", "image_trigger")]
    ),
    camera!(
        "gazebo_ros_triggered_multicamera",
        "Publishes images of a `multicamera` sensor on each trigger.",
        [topic("triggerTopicName", "Topic of triggers.", "image_trigger")]
    ),
    camera!(
        "gazebo_ros_prosilica",
        "Publishes an image of a `camera` sensor on request.",
        [
            text("pollServiceName", "Service that triggers an image."),
            DEPTH_TOPIC,
            DEPTH_INFO_TOPIC,
            CLOUD_TOPIC,
            CUTOFF,
            text("mode", "`streaming` or `polled`."),
        ]
    ),
];
