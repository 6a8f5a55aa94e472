//! Cameras.

use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::NoiseSpec;

/// Content of the pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CameraKind {
    /// Colour.
    Colour,
    /// Depth along the optical axis.
    Depth,
    /// Colour and depth.
    Rgbd,
    /// Temperature.
    Thermal,
    /// Semantic labels.
    Segmentation,
    /// Bounding boxes of labelled objects.
    BoundingBox,
    /// Colour with a wide-angle lens.
    WideAngle,
    /// Several cameras in one sensor (Classic).
    Multi,
}

/// Camera. Its frame has x along the optical axis, y to the left and z up.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Camera {
    /// Name, if given.
    pub name: Option<String>,
    /// Content of the pixels.
    pub kind: CameraKind,
    /// Camera frame in the sensor frame.
    pub sensor_from_camera: Pose,
    /// Horizontal field of view [rad].
    pub horizontal_fov_rad: f64,
    /// Width [px].
    pub width: u32,
    /// Height [px].
    pub height: u32,
    /// Pixel format: `R8G8B8`, `L8`, `R_FLOAT32`, ...
    pub format: String,
    /// Near clip distance [m].
    pub near_m: f64,
    /// Far clip distance [m].
    pub far_m: f64,
    /// Near and far clip distance of the depth part [m], if given.
    pub depth_clip_m: Option<[f64; 2]>,
    /// Noise of a channel, in 0..1.
    pub noise: NoiseSpec,
    /// Distortion of the lens.
    pub distortion: Option<Distortion>,
    /// Topic of its camera info, if given.
    pub camera_info_topic: Option<String>,
    /// Frame of its images, if given.
    pub optical_frame_id: Option<String>,
    /// True if it captures on a trigger.
    pub triggered: bool,
    /// Mask of the visuals that it renders.
    pub visibility_mask: u32,
    /// Type of labels: `semantic`, `instance`, `panoptic`; or `2d`, `visible_2d`, `full_2d`, `3d` of boxes.
    pub label_type: Option<String>,
    /// More cameras of a multi-camera.
    pub others: Vec<Self>,
    /// Lens, saving and other elements.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Brown's distortion (plumb bob).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distortion {
    /// Radial coefficient.
    pub k1: f64,
    /// Radial coefficient.
    pub k2: f64,
    /// Radial coefficient.
    pub k3: f64,
    /// Tangential coefficient.
    pub p1: f64,
    /// Tangential coefficient.
    pub p2: f64,
    /// Centre as a fraction of the image size.
    pub center: [f64; 2],
}
