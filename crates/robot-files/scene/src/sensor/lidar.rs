//! Lidars.

use periplus_xml::Element;
use serde::Serialize;

use crate::NoiseSpec;

/// Lidar with one or several rows of rays.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LidarSpec {
    /// Horizontal rays, about z.
    pub horizontal: ScanAxis,
    /// Vertical rays.
    pub vertical: ScanAxis,
    /// Minimum range [m].
    pub range_min_m: f64,
    /// Maximum range [m].
    pub range_max_m: f64,
    /// Resolution of the ranges [m].
    pub range_resolution_m: f64,
    /// Noise of a range [m].
    pub noise: NoiseSpec,
    /// Mask of the visuals that it detects: those whose flags have a bit in common.
    pub visibility_mask: u32,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Rays between two angles, both included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ScanAxis {
    /// Number of rays that are cast.
    pub samples: u32,
    /// Number of reported ranges per ray.
    pub resolution: f64,
    /// First angle [rad].
    pub min_angle_rad: f64,
    /// Last angle [rad].
    pub max_angle_rad: f64,
}
