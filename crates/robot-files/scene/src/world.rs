//! Scenes and worlds.

use periplus_diagnostics::Origin;
use periplus_geometry::{DVec3, Pose};
use periplus_xml::Element;
use serde::Serialize;

use crate::{Actor, Colour, Joint, Light, Model, NamedFrame, Physics, Plugin};

/// Content of one file: worlds, or models, lights and actors outside any world.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Scene {
    /// Worlds, in order.
    pub worlds: Vec<World>,
    /// Models outside any world, in order; a robot description is one.
    pub models: Vec<Model>,
    /// Lights outside any world.
    pub lights: Vec<Light>,
    /// Actors outside any world.
    pub actors: Vec<Actor>,
}

/// World with models and lights. Its frame is named `world`: x east, y north, z up (REP 103) unless
/// [`SphericalCoordinates::heading_rad`] rotates it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct World {
    /// Its name.
    pub name: String,
    /// Gravity in the world frame [m/s²].
    pub gravity_m_s2: DVec3,
    /// The Earth's magnetic field in the world frame [T].
    pub magnetic_field_t: DVec3,
    /// Wind in the world frame [m/s].
    pub wind_m_s: DVec3,
    /// Step sizes and solver settings. Never empty; the default comes first.
    pub physics: Vec<Physics>,
    /// Ambient light of the scene.
    pub ambient: Colour,
    /// Colour of the sky.
    pub background: Colour,
    /// True if lights cast shadows.
    pub shadows: bool,
    /// True if a viewer should draw a grid.
    pub grid: bool,
    /// Geographic position.
    pub spherical_coordinates: Option<SphericalCoordinates>,
    /// Settings of the GUI.
    pub gui: Option<Gui>,
    /// Frames attached to the world or to an entity in it; poses are `world_from_frame`.
    pub frames: Vec<NamedFrame>,
    /// Models.
    pub models: Vec<Model>,
    /// Joints between models (SDF 1.11); links are named `model::link`.
    pub joints: Vec<Joint>,
    /// Lights; poses are `world_from_light`.
    pub lights: Vec<Light>,
    /// People and other animated figures.
    pub actors: Vec<Actor>,
    /// World plugins (systems).
    pub plugins: Vec<Plugin>,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

impl World {
    /// Returns an empty world with the defaults of SDF: gravity 9.8 m/s² down, the Earth's magnetic field
    /// at Gazebo's default location, grey light.
    #[must_use]
    pub fn empty(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            gravity_m_s2: DVec3::new(0.0, 0.0, -9.8),
            magnetic_field_t: DVec3::new(5.5645e-6, 22.8758e-6, -42.3884e-6),
            wind_m_s: DVec3::ZERO,
            physics: Vec::new(),
            ambient: Colour([0.4, 0.4, 0.4, 1.0]),
            background: Colour([0.7, 0.7, 0.7, 1.0]),
            shadows: true,
            grid: true,
            spherical_coordinates: None,
            gui: None,
            frames: Vec::new(),
            models: Vec::new(),
            joints: Vec::new(),
            lights: Vec::new(),
            actors: Vec::new(),
            plugins: Vec::new(),
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }
}

/// Geographic position and orientation of a world.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SphericalCoordinates {
    /// `EARTH_WGS84`, `MOON_SCS` or `CUSTOM_SURFACE`.
    pub surface_model: String,
    /// `ENU`, `NED` or `NWU`.
    pub frame_orientation: String,
    /// Latitude of the world's origin [rad].
    pub latitude_rad: f64,
    /// Longitude of the world's origin [rad].
    pub longitude_rad: f64,
    /// Height of the world's origin above the surface [m].
    pub elevation_m: f64,
    /// Yaw of the world frame relative to east [rad].
    pub heading_rad: f64,
    /// Axes of a custom surface.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Settings of the GUI.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gui {
    /// True if it fills the screen.
    pub fullscreen: bool,
    /// Initial pose of the view's camera, with x forward.
    pub world_from_camera: Option<Pose>,
    /// Other elements of the view's camera.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub camera_extra: Vec<Element>,
    /// Plugins of the GUI.
    pub plugins: Vec<Plugin>,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}
