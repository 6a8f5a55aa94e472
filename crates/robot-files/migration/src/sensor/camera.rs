//! Cameras.

use crate::bridge::{CAMERA_INFO, CLOUD, IMAGE, TRIGGER};
use crate::entry::{MigrationOutcome, TopicAspect};
use crate::old_plugin::{Flag, OldPlugin};
use crate::replacement::{Replacement, SensorChange, leaf};
use crate::sensor::{frame, limit_rate, publishing};
use crate::template;

/// Topics of a camera plugin on ROS.
struct OldTopics {
    image: String,
    info: String,
    depth: String,
    depth_info: String,
    points: String,
    /// Prefix of all of them.
    base: String,
}

impl OldTopics {
    fn read(plugin: &OldPlugin<'_>) -> Self {
        let name = plugin.text(&["camera_name", "cameraName"]).unwrap_or_default();
        let topic = |parameter: &str, default: &str| {
            let given = if plugin.is_ros1() { plugin.text(&[parameter]) } else { None };
            let inside = given.unwrap_or_else(|| default.to_owned());
            if inside.starts_with('/') || name.is_empty() {
                plugin.ros_topic(&inside)
            } else {
                plugin.ros_topic(&format!("{name}/{inside}"))
            }
        };
        Self {
            image: topic("imageTopicName", "image_raw"),
            info: topic("cameraInfoTopicName", "camera_info"),
            depth: topic("depthImageTopicName", "depth/image_raw"),
            depth_info: topic("depthImageCameraInfoTopicName", "depth/camera_info"),
            points: topic("pointCloudTopicName", "points"),
            base: plugin.ros_topic(&name),
        }
    }
}

pub(super) fn plugin(plugin: &OldPlugin<'_>) -> Replacement {
    let kind =
        plugin.surroundings.sensor.and_then(|sensor| sensor.value("type")).unwrap_or_default();
    let topics = OldTopics::read(plugin);
    let mut replacement = match kind {
        "depth" | "depth_camera" | "rgbd" | "rgbd_camera" => depth(plugin, &topics),
        "multicamera" => return several(),
        _ => colour(plugin, &topics),
    };
    if plugin.is_nonzero(&["hackBaseline", "hack_baseline"]) {
        replacement.differs(
            "the baseline in the camera info has no counterpart in the plugin: set <Tx> in \
             <lens><projection> to -focal length * baseline",
        );
        for info in [&topics.info, &topics.depth_info] {
            replacement.expects(
                info,
                TopicAspect::Fields,
                "the baseline is not in the projection matrix",
            );
        }
    }
    let distortion = ["k1", "k2", "k3", "t1", "t2"].iter().any(|name| {
        let names = [format!("distortion_{name}"), format!("distortion{}", name.to_uppercase())];
        names.iter().any(|name| {
            plugin.text(&[name]).is_some_and(|text| {
                template::number(&text).is_none_or(|value| value.abs() > SMALLEST_DISTORTION)
            })
        })
    });
    if distortion && plugin.is_ros1() {
        replacement.differs(
            "distortion coefficients of the plugin were in the camera info only; write them into \
             <distortion> of the <camera>, which distorts the image too",
        );
    }
    for info in [&topics.info, &topics.depth_info] {
        replacement.expects(info, TopicAspect::Fields, CAMERA_INFO_DIFFERENCE);
    }
    replacement
}

/// Difference of the camera info.
pub(super) const CAMERA_INFO_DIFFERENCE: &str = "gz computes the principal point as half of the image, the old plugin as \
                                                 (size + 1) / 2 or from its parameters";

/// Topics of images and camera info of one of several cameras, and their frame.
pub(super) fn topics_of_one(
    plugin: &OldPlugin<'_>,
    camera: &str,
) -> (String, String, Option<String>) {
    let topics = OldTopics::read(plugin);
    let within = |topic: &str| {
        let rest = topic.strip_prefix(topics.base.as_str()).unwrap_or(topic);
        template::topic(&format!("{}/{camera}{rest}", topics.base))
    };
    (within(&topics.image), within(&topics.info), frame(plugin))
}

/// Coefficients below are the placeholders of the tutorials.
const SMALLEST_DISTORTION: f64 = 1e-6;

/// A camera of colour images.
fn colour(plugin: &OldPlugin<'_>, topics: &OldTopics) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    publishing(plugin, &topics.image, &mut replacement);
    replacement.bridge_to_ros(&topics.image, &topics.image, IMAGE);
    replacement.bridge_to_ros(&topics.info, &topics.info, CAMERA_INFO);
    let usual = topics.image.rsplit_once('/').map_or("", |(above, _)| above);
    if format!("{usual}/camera_info") != topics.info {
        replacement.sensor.push(SensorChange::Setting {
            group: "camera",
            element: leaf("camera_info_topic", &topics.info),
        });
    }
    let is_triggered =
        plugin.library().contains("triggered") || plugin.flag(&["triggered"], false) != Flag::No;
    if is_triggered {
        let trigger = if plugin.is_ros1() {
            plugin.topic(&["triggerTopicName"], "image_trigger")
        } else {
            template::topic(&format!("{}/image_trigger", topics.base))
        };
        for element in [leaf("triggered", "true"), leaf("trigger_topic", &trigger)] {
            replacement.sensor.push(SensorChange::Setting { group: "camera", element });
        }
        replacement.bridge_to_gz(&trigger, &trigger, TRIGGER);
        replacement.differs("triggers are std_msgs/msg/Bool instead of std_msgs/msg/Empty");
        for topic in [&topics.image, &topics.info] {
            for aspect in [TopicAspect::Presence, TopicAspect::Rate] {
                replacement.expects(
                    topic,
                    aspect,
                    "the camera publishes on a trigger only, and none is sent",
                );
            }
        }
        replacement.expects(&trigger, TopicAspect::Type, "gz reads triggers as gz.msgs.Boolean");
    }
    if plugin.library() == "gazebo_ros_prosilica" {
        replacement
            .differs("images on request have no counterpart; the camera publishes all the time");
    }
    replacement
}

/// A depth camera: colours, depths and points.
fn depth(plugin: &OldPlugin<'_>, topics: &OldTopics) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    replacement.sensor.push(SensorChange::Type("rgbd_camera"));
    let base = &topics.base;
    replacement.elements.push(leaf("topic", base));
    let link = plugin.surroundings.reference;
    if let Some(link) = link {
        replacement.elements.push(leaf("gz_frame_id", link));
    }
    let sensor = plugin.surroundings.sensor;
    if sensor.is_some_and(|sensor| sensor.child("always_on").is_none()) {
        replacement.elements.push(leaf("always_on", "true"));
    }
    limit_rate(plugin, &mut replacement);
    if let Some(optical) = frame(plugin) {
        replacement.sensor.push(SensorChange::Setting {
            group: "camera",
            element: leaf("optical_frame_id", optical),
        });
    }
    let below = |name: &str| format!("{base}/{name}");
    replacement.bridge_to_ros(&topics.image, &below("image"), IMAGE);
    replacement.bridge_to_ros(&topics.info, &below("camera_info"), CAMERA_INFO);
    replacement.bridge_to_ros(&topics.depth, &below("depth_image"), IMAGE);
    replacement.bridge_to_ros(&topics.depth_info, &below("camera_info"), CAMERA_INFO);
    replacement.bridge_to_ros(&topics.points, &below("points"), CLOUD);
    let reason = "points of gz are along the axes of the sensor (x forward) in the frame of its link, \
                  those of the old plugin along the optical axes (z forward)";
    replacement.remark(reason);
    replacement.expects(&topics.points, TopicAspect::Frame, reason);
    replacement.expects(&topics.points, TopicAspect::Fields, reason);
    let reason = "the old plugin cut depths off (by default below 0.4 m); <clip> of <depth_camera> does so, too, but would cut \
                  the colours as well, so it is not written";
    replacement.remark(reason);
    for topic in [&topics.depth, &topics.points] {
        replacement.expects(topic, TopicAspect::Values, reason);
    }
    if plugin.flag(&["useDepth16UC1Format"], false) != Flag::No {
        replacement.differs("depths are metres in 32-bit floats instead of millimetres in 16 bits");
        replacement.expects(&topics.depth, TopicAspect::Fields, "the encoding of depths is 32FC1");
    }
    if plugin.library() == "gazebo_ros_depth_camera" {
        replacement.remark("surface normals and reflectances have no counterpart");
    }
    replacement
}

/// A sensor with several cameras.
fn several() -> Replacement {
    Replacement::without(
        MigrationOutcome::NoCounterpart,
        "gz-sim has no multicamera: write one `camera` sensor for each <camera>, with its pose and \
         its topic; sensors of the same rate are measured in the same steps",
    )
}
