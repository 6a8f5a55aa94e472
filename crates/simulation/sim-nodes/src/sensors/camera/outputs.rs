//! Topics of a camera.

use std::f64::consts::FRAC_PI_2;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{Pose, Rpy};
use periplus_graph::{GraphError, Publisher, Qos, valid_topic_name};
use periplus_msgs::sensor_msgs::{CameraInfo, Image, PointCloud2};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::vision_msgs::{Detection2DArray, Detection3DArray};
use periplus_rendering::{ImageOutputs, RenderedImages};
use periplus_scene::{Camera, CameraKind};
use periplus_sensors::{CameraCalibration, Pinhole};

use super::super::port::{Convention, SensorPort};
use super::super::{SensorBuildError, SensorContext};
use super::boxes::{BoxKind, Detections};
use super::info::{calibration, message};
use super::pixels::{Encoding, colour_image, depth_image, label_image, millimetre_image};
use super::points::{Cloud, cloud};

/// A publisher of a camera.
pub(super) struct CameraOutput {
    frame: String,
    to: OutputKind,
}

enum OutputKind {
    Colour(Publisher<Image>, Encoding),
    Depth(Publisher<Image>),
    Millimetres(Publisher<Image>),
    Points(Publisher<PointCloud2>, Cloud),
    ColouredLabels(Publisher<Image>),
    Labels(Publisher<Image>),
    Info(Publisher<CameraInfo>, Box<CameraCalibration>),
    Boxes(Publisher<Detection2DArray>, BoxKind),
    OrientedBoxes(Publisher<Detection3DArray>),
}

impl CameraOutput {
    pub(super) fn has_subscribers(&self) -> bool {
        match &self.to {
            OutputKind::Colour(out, _)
            | OutputKind::Depth(out)
            | OutputKind::Millimetres(out)
            | OutputKind::ColouredLabels(out)
            | OutputKind::Labels(out) => out.is_heard(),
            OutputKind::Points(out, _) => out.is_heard(),
            OutputKind::Info(out, _) => out.is_heard(),
            OutputKind::Boxes(out, _) => out.is_heard(),
            OutputKind::OrientedBoxes(out) => out.is_heard(),
        }
    }

    /// Returns the boxes that a subscriber needs.
    pub(super) fn boxes(&self) -> Option<BoxKind> {
        match &self.to {
            OutputKind::Boxes(out, kind) => out.is_heard().then_some(*kind),
            OutputKind::OrientedBoxes(out) => out.is_heard().then_some(BoxKind::Oriented),
            _ => None,
        }
    }

    pub(super) fn needs(&self) -> ImageOutputs {
        match &self.to {
            OutputKind::Colour(..) => ImageOutputs { colour: true, ..ImageOutputs::default() },
            OutputKind::Depth(_) | OutputKind::Millimetres(_) => {
                ImageOutputs { depth: true, ..ImageOutputs::default() }
            }
            OutputKind::Points(..) => {
                ImageOutputs { colour: true, depth: true, ..ImageOutputs::default() }
            }
            OutputKind::ColouredLabels(_)
            | OutputKind::Labels(_)
            | OutputKind::Boxes(..)
            | OutputKind::OrientedBoxes(_) => {
                ImageOutputs { labels: true, ..ImageOutputs::default() }
            }
            OutputKind::Info(..) => ImageOutputs::default(),
        }
    }

    /// Returns topic and frame of a point cloud, and the axes of its points: along the camera in
    /// Gazebo, optical (z forward) in Classic.
    pub(super) fn points(&self) -> Option<(String, String, Pose)> {
        let OutputKind::Points(out, layout) = &self.to else { return None };
        let camera_from_points = match layout {
            Cloud::Gz => Pose::IDENTITY,
            Cloud::Classic | Cloud::ClassicSwapped => {
                let optical = Rpy { roll: -FRAC_PI_2, pitch: 0.0, yaw: -FRAC_PI_2 };
                Pose::from_xyz_rpy([0.0; 3], optical)
            }
        };
        Some((out.topic().to_owned(), self.frame.clone(), camera_from_points))
    }

    pub(super) fn publish(
        &self,
        picture: &RenderedImages,
        detections: Option<&Detections>,
        pinhole: &Pinhole,
        time_ns: i64,
    ) {
        if !self.has_subscribers() {
            return;
        }
        let header = Header::at(time_ns, &self.frame);
        match &self.to {
            OutputKind::Colour(out, encoding) => {
                out.publish(colour_image(header, picture, *encoding));
            }
            OutputKind::Depth(out) => out.publish(depth_image(header, picture)),
            OutputKind::Millimetres(out) => out.publish(millimetre_image(header, picture)),
            OutputKind::Points(out, layout) => {
                out.publish(cloud(header, picture, pinhole, *layout));
            }
            OutputKind::ColouredLabels(out) => out.publish(label_image(header, picture, true)),
            OutputKind::Labels(out) => out.publish(label_image(header, picture, false)),
            OutputKind::Boxes(out, kind) => {
                if let Some(found) = detections {
                    out.publish(found.boxes_2d(&header, *kind));
                }
            }
            OutputKind::OrientedBoxes(out) => {
                if let Some(found) = detections {
                    out.publish(found.boxes_3d(&header));
                }
            }
            OutputKind::Info(out, calibration) => {
                out.publish(message(header, pinhole, calibration));
            }
        }
    }
}

/// Returns the minimum and maximum depth that a plugin publishes \[m\].
pub(super) fn depth_range_m(port: &SensorPort) -> Option<[f64; 2]> {
    match port.convention {
        Convention::Ros2 => Some([port.number("min_depth"), port.number("max_depth")]),
        Convention::Ros1 => port
            .has("pointCloudCutoff")
            .then(|| [port.number("pointCloudCutoff"), port.number("pointCloudCutoffMax")])
            .map(|[min, max]| [min, if max > min { max } else { f64::INFINITY }]),
        Convention::Gz => None,
    }
}

/// Creates the publishers of a camera on a port. `name` is set for one of several cameras.
pub(super) fn outputs(
    sensor_context: &SensorContext<'_>,
    port: &SensorPort,
    camera: &Camera,
    pinhole: &Pinhole,
    name: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<CameraOutput>, SensorBuildError> {
    match port.convention {
        Convention::Gz => today(sensor_context, port, camera, pinhole),
        Convention::Ros1 | Convention::Ros2 => {
            Ok(classic(sensor_context, port, camera, pinhole, name, diagnostics)?)
        }
    }
}

/// Topics of Gazebo. Points are in the sensor's own frame: x forward.
fn today(
    sensor_context: &SensorContext<'_>,
    port: &SensorPort,
    camera: &Camera,
    pinhole: &Pinhole,
) -> Result<Vec<CameraOutput>, SensorBuildError> {
    let optical = camera.optical_frame_id.clone().unwrap_or_else(|| port.frame.clone());
    let image = |to| CameraOutput { frame: optical.clone(), to };
    let cloud = |to| CameraOutput { frame: port.frame.clone(), to };
    let info = |base: &str| -> Result<CameraOutput, GraphError> {
        let topic = match &camera.camera_info_topic {
            Some(topic) => crate::gz_topic(topic),
            None => match base.rsplit_once('/') {
                Some((above, _)) => format!("{above}/camera_info"),
                None => "camera_info".into(),
            },
        };
        let calibration = Box::new(CameraCalibration::of_gz(pinhole, camera));
        Ok(image(OutputKind::Info(port.publisher(&topic)?, calibration)))
    };
    let encoding = Encoding::of(&camera.format);
    Ok(match camera.kind {
        CameraKind::Depth => {
            let topic = sensor_context.gz_topic("/depth_image");
            vec![
                image(OutputKind::Depth(port.publisher(&topic)?)),
                cloud(OutputKind::Points(port.publisher(&format!("{topic}/points"))?, Cloud::Gz)),
                info(&topic)?,
            ]
        }
        CameraKind::Rgbd => {
            let topic = sensor_context.gz_topic("");
            let below = |name: &str| format!("{}/{name}", topic.trim_end_matches('/'));
            vec![
                image(OutputKind::Colour(port.publisher(&below("image"))?, encoding)),
                image(OutputKind::Depth(port.publisher(&below("depth_image"))?)),
                cloud(OutputKind::Points(port.publisher(&below("points"))?, Cloud::Gz)),
                info(&below("image"))?,
            ]
        }
        CameraKind::Segmentation => {
            let topic = sensor_context.gz_topic("/segmentation");
            vec![
                image(OutputKind::ColouredLabels(port.publisher(&format!("{topic}/colored_map"))?)),
                image(OutputKind::Labels(port.publisher(&format!("{topic}/labels_map"))?)),
                info(&format!("{topic}/colored_map"))?,
            ]
        }
        CameraKind::BoundingBox => {
            let topic = sensor_context.gz_topic("/boundingbox");
            let kind = BoxKind::of(camera)?;
            let boxes = match kind {
                BoxKind::Oriented => OutputKind::OrientedBoxes(port.publisher(&topic)?),
                BoxKind::Visible | BoxKind::Full => {
                    OutputKind::Boxes(port.publisher(&topic)?, kind)
                }
            };
            let images = port.publisher(&format!("{topic}_image"))?;
            vec![
                // Positions of boxes are along the axes of the camera: x forward.
                cloud(boxes),
                image(OutputKind::Colour(images, encoding)),
                info(&topic)?,
            ]
        }
        _ => {
            let topic = sensor_context.gz_topic("/image");
            vec![image(OutputKind::Colour(port.publisher(&topic)?, encoding)), info(&topic)?]
        }
    })
}

/// Topics of Classic's plugins. Points are in the optical frame, like images.
fn classic(
    sensor_context: &SensorContext<'_>,
    port: &SensorPort,
    camera: &Camera,
    pinhole: &Pinhole,
    name: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<CameraOutput>, GraphError> {
    let Some(images) = port.out(0).map(str::to_owned) else {
        let message = "this plugin does not publish camera images";
        diagnostics
            .push(Diagnostic::warning("wrong-plugin", message).at(sensor_context.sensor.origin));
        return Ok(Vec::new());
    };
    // One of several cameras: `<camera_name>/<cam>/image_raw`.
    let named = |topic: &str| match (name, topic.rsplit_once('/')) {
        (Some(name), Some((above, last))) => format!("{above}/{}/{last}", valid_topic_name(name)),
        (Some(name), None) => format!("{}/{topic}", valid_topic_name(name)),
        (None, _) => topic.to_owned(),
    };
    let out = |to| CameraOutput { frame: port.frame.clone(), to };
    let numbers = Box::new(calibration(port, pinhole, camera));
    let information = port.out(1).unwrap_or("camera_info");
    let mut outputs = vec![
        out(OutputKind::Colour(port.publisher(&named(&images))?, Encoding::of(&camera.format))),
        out(OutputKind::Info(port.publisher(&named(information))?, numbers.clone())),
    ];
    if !matches!(camera.kind, CameraKind::Depth | CameraKind::Rgbd) {
        return Ok(outputs);
    }
    let above = images.rsplit_once('/').map_or(String::new(), |(above, _)| format!("{above}/"));
    // ROS 1 has parameters for these; in ROS 2 they are topics of the plugin's table.
    let topic = |place: usize, parameter: &str| match (port.convention, port.text(parameter)) {
        (Convention::Ros1, given) if given.starts_with('/') => Some(given),
        (Convention::Ros1, given) if !given.is_empty() => Some(format!("{above}{given}")),
        (Convention::Ros1, _) => None,
        _ => port.out(place).map(str::to_owned),
    };
    if let Some(topic) = topic(2, "depthImageTopicName") {
        let publisher = port.publisher(&topic)?;
        let millimetres = port.flag("useDepth16UC1Format");
        outputs.push(out(if millimetres {
            OutputKind::Millimetres(publisher)
        } else {
            OutputKind::Depth(publisher)
        }));
    }
    if let Some(topic) = topic(3, "depthImageCameraInfoTopicName") {
        outputs
            .push(out(OutputKind::Info(port.publisher_with(&topic, Qos::reliable(1))?, numbers)));
    }
    if let Some(topic) = topic(4, "pointCloudTopicName") {
        let layout = if sensor_context.setting.quirks.swapped_cloud_colours {
            Cloud::ClassicSwapped
        } else {
            Cloud::Classic
        };
        outputs
            .push(out(OutputKind::Points(port.publisher_with(&topic, Qos::reliable(1))?, layout)));
    }
    Ok(outputs)
}
