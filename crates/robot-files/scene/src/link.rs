//! Rigid bodies.

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::{Light, Material, Plugin, Sensor, Shape, SurfaceProperties};

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Link {
    /// Its name, unique in its model.
    pub name: String,
    /// Link frame in the model frame.
    pub model_from_link: Pose,
    /// Mass and inertia.
    pub inertial: Inertial,
    /// True if gravity acts on it.
    pub gravity: bool,
    /// True if wind acts on it.
    pub enable_wind: bool,
    /// True if it collides with other links of its model.
    pub self_collide: bool,
    /// True if it moves only by its pose.
    pub kinematic: bool,
    /// Damping of its velocity, linear and angular [1/s].
    pub velocity_decay: [f64; 2],
    /// Collision shapes.
    pub collisions: Vec<Collision>,
    /// Visual shapes.
    pub visuals: Vec<Visual>,
    /// Sensors.
    pub sensors: Vec<Sensor>,
    /// Lights; poses are `link_from_light`.
    pub lights: Vec<Light>,
    /// Uninterpreted elements: batteries, projectors, emitters.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// Mass and inertia.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inertial {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Centre of mass and the axes of the inertia, in the link's frame.
    pub link_from_inertial: Pose,
    /// `xx, xy, xz, yy, yz, zz` about the centre of mass [kg m²].
    pub inertia_kg_m2: [f64; 6],
    /// True if mass and inertia are computed from the shapes and their densities (SDF 1.11).
    pub auto: bool,
    /// Fluid added mass, densities and other elements.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Shape for contacts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Collision {
    /// Its name, unique among the link's collisions.
    pub name: String,
    /// Collision frame in the link frame.
    pub link_from_collision: Pose,
    /// Its shape.
    pub shape: Shape,
    /// Friction and contact.
    pub surface: SurfaceProperties,
    /// Reflectance for lidars.
    pub laser_retro: f64,
    /// Maximum number of contact points.
    pub max_contacts: u32,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// Shape for rendering.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Visual {
    /// Its name, unique among the link's visuals.
    pub name: String,
    /// Visual frame in the link frame.
    pub link_from_visual: Pose,
    /// Its shape.
    pub shape: Shape,
    /// Material.
    pub material: Option<Material>,
    /// True if it casts shadows.
    pub cast_shadows: bool,
    /// 0 opaque to 1 invisible.
    pub transparency: f64,
    /// Reflectance for lidars.
    pub laser_retro: f64,
    /// Visible to cameras whose mask has a bit in common.
    pub visibility_flags: u32,
    /// Plugins: labels for segmentation and the like.
    pub plugins: Vec<Plugin>,
    /// Uninterpreted elements: `<meta>`.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

impl Default for Inertial {
    /// SDF's default: 1 kg and 1 kg m² about each axis.
    fn default() -> Self {
        Self {
            mass_kg: 1.0,
            link_from_inertial: Pose::IDENTITY,
            inertia_kg_m2: [1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
            auto: false,
            extra: Vec::new(),
        }
    }
}

impl Link {
    /// Returns a link with SDF's defaults and without content.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            model_from_link: Pose::IDENTITY,
            inertial: Inertial::default(),
            gravity: true,
            enable_wind: false,
            self_collide: false,
            kinematic: false,
            velocity_decay: [0.0; 2],
            collisions: Vec::new(),
            visuals: Vec::new(),
            sensors: Vec::new(),
            lights: Vec::new(),
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }
}

impl Collision {
    /// Returns a collision with SDF's defaults.
    #[must_use]
    pub fn new(name: impl Into<String>, shape: Shape) -> Self {
        Self {
            name: name.into(),
            link_from_collision: Pose::IDENTITY,
            shape,
            surface: SurfaceProperties::default(),
            laser_retro: 0.0,
            max_contacts: 10,
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }
}

impl Visual {
    /// Returns a visual with SDF's defaults.
    #[must_use]
    pub fn new(name: impl Into<String>, shape: Shape) -> Self {
        Self {
            name: name.into(),
            link_from_visual: Pose::IDENTITY,
            shape,
            material: None,
            cast_shadows: true,
            transparency: 0.0,
            laser_retro: 0.0,
            visibility_flags: u32::MAX,
            plugins: Vec::new(),
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }
}
