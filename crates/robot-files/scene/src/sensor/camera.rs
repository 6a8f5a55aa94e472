//! Images.

use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::Noise;

/// What the pixels are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CameraKind {
    /// Colours.
    Colour,
    /// Distances along the optical axis.
    Depth,
    /// Both.
    Rgbd,
    /// Temperatures.
    Thermal,
    /// Labels.
    Segmentation,
    /// Boxes around labelled things.
    BoundingBox,
    /// Colours through a wide lens.
    WideAngle,
    /// Several cameras in one sensor (Classic).
    Multi,
}

/// A camera. It looks along x of its own frame, y to the left, z up.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Camera {
    /// Its name, where the file gives one.
    pub name: Option<String>,
    /// What the pixels are.
    pub kind: CameraKind,
    /// Its frame in the sensor's.
    pub sensor_from_camera: Pose,
    /// Angle across [rad].
    pub horizontal_fov_rad: f64,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixel format: `R8G8B8`, `L8`, `R_FLOAT32`, ...
    pub format: String,
    /// Nearest [m].
    pub near_m: f64,
    /// Farthest [m].
    pub far_m: f64,
    /// Nearest and farthest of the depth part [m], where the file gives them.
    pub depth_clip_m: Option<[f64; 2]>,
    /// Noise of a channel, in 0..1.
    pub noise: Noise,
    /// Distortion of the lens.
    pub distortion: Option<Distortion>,
    /// The topic of its camera info, where the file names one.
    pub camera_info_topic: Option<String>,
    /// The frame of its images, where the file names one.
    pub optical_frame_id: Option<String>,
    /// Whether it waits for a trigger.
    pub triggered: bool,
    /// Which visuals it sees.
    pub visibility_mask: u32,
    /// `semantic`, `instance`, `panoptic`; or `2d`, `visible_2d`, `full_2d`, `3d` of boxes.
    pub label_type: Option<String>,
    /// More cameras of a multi-camera.
    pub others: Vec<Self>,
    /// Lens, saving and the rest.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Brown's distortion (plumb bob).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distortion {
    /// Radial.
    pub k1: f64,
    /// Radial.
    pub k2: f64,
    /// Radial.
    pub k3: f64,
    /// Tangential.
    pub p1: f64,
    /// Tangential.
    pub p2: f64,
    /// Centre in 0..1 of the image.
    pub center: [f64; 2],
}
