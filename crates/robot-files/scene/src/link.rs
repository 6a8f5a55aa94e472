//! Rigid bodies.

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::{Light, Material, Plugin, Sensor, Shape, Surface};

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Link {
    /// Its name, unique in its model.
    pub name: String,
    /// Its frame in the model's.
    pub model_from_link: Pose,
    /// Mass and inertia.
    pub inertial: Inertial,
    /// Whether gravity pulls it.
    pub gravity: bool,
    /// Whether wind moves it.
    pub enable_wind: bool,
    /// Whether it collides with other links of its model.
    pub self_collide: bool,
    /// Whether it is moved by its pose alone.
    pub kinematic: bool,
    /// Damping of its velocity, linear and angular [1/s].
    pub velocity_decay: [f64; 2],
    /// What touches.
    pub collisions: Vec<Collision>,
    /// What is seen.
    pub visuals: Vec<Visual>,
    /// What senses.
    pub sensors: Vec<Sensor>,
    /// What shines; poses are `link_from_light`.
    pub lights: Vec<Light>,
    /// What nobody here interprets: batteries, projectors, emitters.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
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
    /// Whether the file leaves mass and inertia to the shapes and their densities (SDF 1.11).
    pub auto: bool,
    /// Added mass of the water around it, densities and more.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// A shape that touches.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Collision {
    /// Its name, unique among the link's collisions.
    pub name: String,
    /// Its frame in the link's.
    pub link_from_collision: Pose,
    /// Its shape.
    pub shape: Shape,
    /// Friction and contact.
    pub surface: Surface,
    /// Brightness to a laser.
    pub laser_retro: f64,
    /// Most contact points.
    pub max_contacts: u32,
    /// What nobody here interprets.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}

/// A shape that is seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Visual {
    /// Its name, unique among the link's visuals.
    pub name: String,
    /// Its frame in the link's.
    pub link_from_visual: Pose,
    /// Its shape.
    pub shape: Shape,
    /// Its look.
    pub material: Option<Material>,
    /// Whether it casts shadows.
    pub cast_shadows: bool,
    /// 0 opaque to 1 invisible.
    pub transparency: f64,
    /// Brightness to a laser.
    pub laser_retro: f64,
    /// Which cameras see it: those whose mask shares a bit.
    pub visibility_flags: u32,
    /// Plugins: labels for segmentation and the like.
    pub plugins: Vec<Plugin>,
    /// What nobody here interprets: `<meta>`.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
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
    /// A link with SDF's defaults and nothing on it.
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
    /// A collision with SDF's defaults.
    #[must_use]
    pub fn new(name: impl Into<String>, shape: Shape) -> Self {
        Self {
            name: name.into(),
            link_from_collision: Pose::IDENTITY,
            shape,
            surface: Surface::default(),
            laser_retro: 0.0,
            max_contacts: 10,
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }
}

impl Visual {
    /// A visual with SDF's defaults.
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
