//! Which images a camera publishes, and where.

use std::f64::consts::FRAC_PI_2;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{Pose, Rpy};
use periplus_graph::{GraphError, Publisher, Qos, valid_topic_name};
use periplus_msgs::sensor_msgs::{CameraInfo, Image, PointCloud2};
use periplus_msgs::std_msgs::Header;
use periplus_rendering::{ImageOutputs, RenderedImages};
use periplus_scene::{Camera, CameraKind};
use periplus_sensors::{Calibration, Pinhole};

use super::super::Post;
use super::super::port::{Port, Style};
use super::info::{calibration, message};
use super::pixels::{Encoding, colour_image, depth_image, label_image, millimetre_image};
use super::points::{Cloud, cloud};

/// One thing that a camera publishes.
pub(super) struct Out {
    frame: String,
    to: To,
}

enum To {
    Colour(Publisher<Image>, Encoding),
    Depth(Publisher<Image>),
    Millimetres(Publisher<Image>),
    Points(Publisher<PointCloud2>, Cloud),
    ColouredLabels(Publisher<Image>),
    Labels(Publisher<Image>),
    Info(Publisher<CameraInfo>, Box<Calibration>),
}

impl Out {
    pub(super) fn is_heard(&self) -> bool {
        match &self.to {
            To::Colour(out, _)
            | To::Depth(out)
            | To::Millimetres(out)
            | To::ColouredLabels(out)
            | To::Labels(out) => out.is_heard(),
            To::Points(out, _) => out.is_heard(),
            To::Info(out, _) => out.is_heard(),
        }
    }

    pub(super) fn needs(&self) -> ImageOutputs {
        match &self.to {
            To::Colour(..) => ImageOutputs { colour: true, ..ImageOutputs::default() },
            To::Depth(_) | To::Millimetres(_) => {
                ImageOutputs { depth: true, ..ImageOutputs::default() }
            }
            To::Points(..) => ImageOutputs { colour: true, depth: true, ..ImageOutputs::default() },
            To::ColouredLabels(_) | To::Labels(_) => {
                ImageOutputs { labels: true, ..ImageOutputs::default() }
            }
            To::Info(..) => ImageOutputs::default(),
        }
    }

    /// Topic and frame of a point cloud, and the axes of its points: along the camera in today's
    /// Gazebo, optical (z ahead) in Classic.
    pub(super) fn points(&self) -> Option<(String, String, Pose)> {
        let To::Points(out, layout) = &self.to else { return None };
        let camera_from_points = match layout {
            Cloud::Gz => Pose::IDENTITY,
            Cloud::Classic | Cloud::ClassicSwapped => {
                let optical = Rpy { roll: -FRAC_PI_2, pitch: 0.0, yaw: -FRAC_PI_2 };
                Pose::from_xyz_rpy([0.0; 3], optical)
            }
        };
        Some((out.topic().to_owned(), self.frame.clone(), camera_from_points))
    }

    pub(super) fn publish(&self, picture: &RenderedImages, pinhole: &Pinhole, time_ns: i64) {
        if !self.is_heard() {
            return;
        }
        let header = Header::at(time_ns, &self.frame);
        match &self.to {
            To::Colour(out, encoding) => out.publish(colour_image(header, picture, *encoding)),
            To::Depth(out) => out.publish(depth_image(header, picture)),
            To::Millimetres(out) => out.publish(millimetre_image(header, picture)),
            To::Points(out, layout) => out.publish(cloud(header, picture, pinhole, *layout)),
            To::ColouredLabels(out) => out.publish(label_image(header, picture, true)),
            To::Labels(out) => out.publish(label_image(header, picture, false)),
            To::Info(out, calibration) => out.publish(message(header, pinhole, calibration)),
        }
    }
}

/// Least and greatest depth that a plugin tells \[m\].
pub(super) fn depth_range_m(port: &Port) -> Option<[f64; 2]> {
    match port.style {
        Style::Ros2 => Some([port.number("min_depth"), port.number("max_depth")]),
        Style::Ros1 => port
            .has("pointCloudCutoff")
            .then(|| [port.number("pointCloudCutoff"), port.number("pointCloudCutoffMax")])
            .map(|[min, max]| [min, if max > min { max } else { f64::INFINITY }]),
        Style::Gz => None,
    }
}

/// What one camera publishes through a port. `name` is that of one of several.
pub(super) fn outs(
    post: &Post<'_>,
    port: &Port,
    camera: &Camera,
    pinhole: &Pinhole,
    name: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Out>, GraphError> {
    match port.style {
        Style::Gz => today(post, port, camera, pinhole),
        Style::Ros1 | Style::Ros2 => classic(post, port, camera, pinhole, name, diagnostics),
    }
}

/// Topics of today's Gazebo. Points are in the sensor's own frame: x ahead.
fn today(
    post: &Post<'_>,
    port: &Port,
    camera: &Camera,
    pinhole: &Pinhole,
) -> Result<Vec<Out>, GraphError> {
    let optical = camera.optical_frame_id.clone().unwrap_or_else(|| port.frame.clone());
    let image = |to| Out { frame: optical.clone(), to };
    let cloud = |to| Out { frame: port.frame.clone(), to };
    let info = |base: &str| -> Result<Out, GraphError> {
        let topic = match &camera.camera_info_topic {
            Some(topic) => crate::gz_topic(topic),
            None => match base.rsplit_once('/') {
                Some((above, _)) => format!("{above}/camera_info"),
                None => "camera_info".into(),
            },
        };
        let calibration = Box::new(Calibration::of_gz(pinhole, camera));
        Ok(image(To::Info(port.publisher(&topic)?, calibration)))
    };
    let encoding = Encoding::of(&camera.format);
    Ok(match camera.kind {
        CameraKind::Depth => {
            let topic = post.gz_topic("/depth_image");
            vec![
                image(To::Depth(port.publisher(&topic)?)),
                cloud(To::Points(port.publisher(&format!("{topic}/points"))?, Cloud::Gz)),
                info(&topic)?,
            ]
        }
        CameraKind::Rgbd => {
            let topic = post.gz_topic("");
            let below = |name: &str| format!("{}/{name}", topic.trim_end_matches('/'));
            vec![
                image(To::Colour(port.publisher(&below("image"))?, encoding)),
                image(To::Depth(port.publisher(&below("depth_image"))?)),
                cloud(To::Points(port.publisher(&below("points"))?, Cloud::Gz)),
                info(&below("image"))?,
            ]
        }
        CameraKind::Segmentation => {
            let topic = post.gz_topic("/segmentation");
            vec![
                image(To::ColouredLabels(port.publisher(&format!("{topic}/colored_map"))?)),
                image(To::Labels(port.publisher(&format!("{topic}/labels_map"))?)),
                info(&format!("{topic}/colored_map"))?,
            ]
        }
        _ => {
            let topic = post.gz_topic("/image");
            vec![image(To::Colour(port.publisher(&topic)?, encoding)), info(&topic)?]
        }
    })
}

/// Topics of Classic's plugins. Points are in the optical frame, as images are.
fn classic(
    post: &Post<'_>,
    port: &Port,
    camera: &Camera,
    pinhole: &Pinhole,
    name: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Out>, GraphError> {
    let Some(images) = port.out(0).map(str::to_owned) else {
        let told = "this plugin does not publish what a camera sees";
        diagnostics.push(Diagnostic::warning("wrong-plugin", told).at(post.sensor.origin));
        return Ok(Vec::new());
    };
    // One of several: `<camera_name>/<cam>/image_raw`.
    let named = |topic: &str| match (name, topic.rsplit_once('/')) {
        (Some(name), Some((above, last))) => format!("{above}/{}/{last}", valid_topic_name(name)),
        (Some(name), None) => format!("{}/{topic}", valid_topic_name(name)),
        (None, _) => topic.to_owned(),
    };
    let out = |to| Out { frame: port.frame.clone(), to };
    let numbers = Box::new(calibration(port, pinhole, camera));
    let information = port.out(1).unwrap_or("camera_info");
    let mut outs = vec![
        out(To::Colour(port.publisher(&named(&images))?, Encoding::of(&camera.format))),
        out(To::Info(port.publisher(&named(information))?, numbers.clone())),
    ];
    if !matches!(camera.kind, CameraKind::Depth | CameraKind::Rgbd) {
        return Ok(outs);
    }
    let above = images.rsplit_once('/').map_or(String::new(), |(above, _)| format!("{above}/"));
    // ROS 1 has parameters for these; in ROS 2 they are topics of the table.
    let topic = |place: usize, parameter: &str| match (port.style, port.text(parameter)) {
        (Style::Ros1, given) if given.starts_with('/') => Some(given),
        (Style::Ros1, given) if !given.is_empty() => Some(format!("{above}{given}")),
        (Style::Ros1, _) => None,
        _ => port.out(place).map(str::to_owned),
    };
    if let Some(topic) = topic(2, "depthImageTopicName") {
        let publisher = port.publisher(&topic)?;
        let millimetres = port.flag("useDepth16UC1Format");
        outs.push(out(if millimetres { To::Millimetres(publisher) } else { To::Depth(publisher) }));
    }
    if let Some(topic) = topic(3, "depthImageCameraInfoTopicName") {
        outs.push(out(To::Info(port.publisher_with(&topic, Qos::reliable(1))?, numbers)));
    }
    if let Some(topic) = topic(4, "pointCloudTopicName") {
        let layout = if post.setting.quirks.swapped_cloud_colours {
            Cloud::ClassicSwapped
        } else {
            Cloud::Classic
        };
        outs.push(out(To::Points(port.publisher_with(&topic, Qos::reliable(1))?, layout)));
    }
    Ok(outs)
}
