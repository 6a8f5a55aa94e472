//! Lights.

use periplus_diagnostics::Origin;
use periplus_geometry::{DVec3, Pose};
use periplus_xml::Element;
use serde::Serialize;

use crate::Colour;

/// Type of a light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LightKind {
    /// Emits in all directions.
    Point,
    /// Parallel rays from infinity.
    Directional,
    /// Emits in a cone.
    Spot(Spot),
}

/// The cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spot {
    /// Full brightness within this angle [rad].
    pub inner_angle_rad: f64,
    /// No light outside this angle [rad].
    pub outer_angle_rad: f64,
    /// Exponent of the falloff between them; 1 is linear.
    pub falloff: f64,
}

/// A light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Light {
    /// Its name.
    pub name: String,
    /// Light frame in the world's or the link's frame.
    pub parent_from_light: Pose,
    /// Type of the light.
    pub kind: LightKind,
    /// Direction of the light in its own frame, of any length.
    pub direction_in_light: DVec3,
    /// True if it is on.
    pub is_on: bool,
    /// True if a viewer should draw it.
    pub visualize: bool,
    /// True if it casts shadows.
    pub cast_shadows: bool,
    /// Factor on its colours.
    pub intensity: f64,
    /// Colour.
    pub diffuse: Colour,
    /// Colour of highlights.
    pub specular: Colour,
    /// Attenuation with distance.
    pub attenuation: Attenuation,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// Brightness at distance d [m]: `1 / (constant + linear d + quadratic d²)` within the range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Attenuation {
    /// Range of the light [m].
    pub range_m: f64,
    /// Constant term of the formula.
    pub constant: f64,
    /// Linear term of the formula [1/m].
    pub linear: f64,
    /// Quadratic term of the formula [1/m²].
    pub quadratic: f64,
}
