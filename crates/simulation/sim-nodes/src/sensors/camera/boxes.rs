//! Bounding boxes of labelled objects as `vision_msgs`, as the bounding box camera of gz-sensors has them.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose;
use periplus_msgs::geometry_msgs::Pose as PoseMessage;
use periplus_msgs::geometry_msgs::{Point, PoseWithCovariance, Quaternion, Vector3};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::vision_msgs::{
    BoundingBox2D, BoundingBox3D, Detection2D, Detection2DArray, Detection3D, Detection3DArray,
    ObjectHypothesis, ObjectHypothesisWithPose, Point2D, Pose2D,
};
use periplus_rendering::{DetectedObject, PixelBox};
use periplus_scene::Camera;

/// Boxes that a bounding box camera publishes: its `<box_type>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BoxKind {
    /// Boxes around the visible pixels: `2d` and `visible_2d`.
    Visible,
    /// Boxes around the pixels without occlusion: `full_2d`.
    Full,
    /// Oriented boxes in space: `3d`.
    Oriented,
}

impl BoxKind {
    /// Reads the `<box_type>` of a camera.
    ///
    /// # Errors
    /// An unknown type.
    pub(super) fn of(camera: &Camera) -> Result<Self, Box<Diagnostic>> {
        match camera.label_type.as_deref() {
            None | Some("2d" | "visible_2d" | "visible_box_2d") => Ok(Self::Visible),
            Some("full_2d" | "full_box_2d") => Ok(Self::Full),
            Some("3d") => Ok(Self::Oriented),
            Some(other) => Err(Diagnostic::error(
                "unknown-type",
                format!("`{other}` is not a box type of a bounding box camera"),
            )
            .help("write `<box_type>` as one of 2d, visible_2d, full_2d, 3d")
            .into()),
        }
    }
}

/// Objects of an image, with the pose of its camera.
pub(super) struct Detections {
    pub(super) objects: Vec<DetectedObject>,
    pub(super) camera_from_world: Pose,
}

impl Detections {
    pub(super) fn boxes_2d(&self, header: &Header, kind: BoxKind) -> Detection2DArray {
        let detection = |object: &DetectedObject| Detection2D {
            header: header.clone(),
            results: vec![self.hypothesis(object)],
            bbox: pixel_box(if kind == BoxKind::Full {
                object.full.bounds
            } else {
                object.visible.bounds
            }),
            id: object.object.model.clone(),
        };
        let detections = self.objects.iter().map(detection).collect();
        Detection2DArray { header: header.clone(), detections }
    }

    pub(super) fn boxes_3d(&self, header: &Header) -> Detection3DArray {
        let detection = |object: &DetectedObject| {
            let size_m = object.object.size_m;
            Detection3D {
                header: header.clone(),
                results: vec![self.hypothesis(object)],
                bbox: BoundingBox3D {
                    center: self.pose(object),
                    size: Vector3 { x: size_m.x, y: size_m.y, z: size_m.z },
                },
                id: object.object.model.clone(),
            }
        };
        let detections = self.objects.iter().map(detection).collect();
        Detection3DArray { header: header.clone(), detections }
    }

    /// The label in decimal, as `ros_gz_bridge` writes it, with the pose of the box.
    fn hypothesis(&self, object: &DetectedObject) -> ObjectHypothesisWithPose {
        ObjectHypothesisWithPose {
            hypothesis: ObjectHypothesis {
                class_id: object.object.label.class.to_string(),
                score: 1.0,
            },
            pose: PoseWithCovariance { pose: self.pose(object), covariance: [0.0; 36] },
        }
    }

    fn pose(&self, object: &DetectedObject) -> PoseMessage {
        let Pose { translation: t, rotation: q } =
            self.camera_from_world * object.object.world_from_box;
        PoseMessage {
            position: Point { x: t.x, y: t.y, z: t.z },
            orientation: Quaternion { x: q.x, y: q.y, z: q.z, w: q.w },
        }
    }
}

/// Converts whole pixels to edges: a box of one pixel has the size 1, and its centre is half a pixel inside.
fn pixel_box(pixels: PixelBox) -> BoundingBox2D {
    let PixelBox { left_px, top_px, width_px, height_px } = pixels;
    let (size_x, size_y) = (f64::from(width_px), f64::from(height_px));
    let position =
        Point2D { x: f64::from(left_px) + size_x / 2.0, y: f64::from(top_px) + size_y / 2.0 };
    BoundingBox2D { center: Pose2D { position, theta: 0.0 }, size_x, size_y }
}
