//! Lights.

use periplus_diagnostics::Origin;
use periplus_geometry::{DVec3, Pose};
use periplus_xml::Element;
use serde::Serialize;

use crate::Colour;

/// How a light spreads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LightKind {
    /// In all directions.
    Point,
    /// In parallel, from far away.
    Directional,
    /// In a cone.
    Spot(Spot),
}

/// The cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spot {
    /// Full brightness within this angle [rad].
    pub inner_angle_rad: f64,
    /// Dark outside this angle [rad].
    pub outer_angle_rad: f64,
    /// How it fades between them; 1 is linear.
    pub falloff: f64,
}

/// A light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Light {
    /// Its name.
    pub name: String,
    /// Its frame in the world's or the link's.
    pub parent_from_light: Pose,
    /// How it spreads.
    pub kind: LightKind,
    /// Where it shines, in its own frame, of any length.
    pub direction_in_light: DVec3,
    /// Whether it is lit.
    pub is_on: bool,
    /// Whether a viewer should draw it.
    pub visualize: bool,
    /// Whether it casts shadows.
    pub cast_shadows: bool,
    /// Factor on its colours.
    pub intensity: f64,
    /// Colour.
    pub diffuse: Colour,
    /// Colour of highlights.
    pub specular: Colour,
    /// How it fades with distance.
    pub attenuation: Attenuation,
    /// What nobody here interprets.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}

/// Brightness at distance d [m]: `1 / (constant + linear d + quadratic d²)` within the range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Attenuation {
    /// It ends here [m].
    pub range_m: f64,
    /// See the formula.
    pub constant: f64,
    /// See the formula [1/m].
    pub linear: f64,
    /// See the formula [1/m²].
    pub quadratic: f64,
}
