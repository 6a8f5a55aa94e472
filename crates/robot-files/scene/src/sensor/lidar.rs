//! Distances along rays.

use periplus_xml::Element;
use serde::Serialize;

use crate::Noise;

/// A lidar: a fan of rays, or a grid of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Lidar {
    /// Rays about z.
    pub horizontal: ScanAxis,
    /// Rays up and down.
    pub vertical: ScanAxis,
    /// Nearest [m].
    pub range_min_m: f64,
    /// Farthest [m].
    pub range_max_m: f64,
    /// Step of the ranges [m].
    pub range_resolution_m: f64,
    /// Noise of a range [m].
    pub noise: Noise,
    /// Which visuals it sees: those whose flags share a bit.
    pub visibility_mask: u32,
    /// What nobody here interprets.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Rays between two angles, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ScanAxis {
    /// Rays that are cast.
    pub samples: u32,
    /// Ranges per ray that are reported.
    pub resolution: f64,
    /// First angle [rad].
    pub min_angle_rad: f64,
    /// Last angle [rad].
    pub max_angle_rad: f64,
}
