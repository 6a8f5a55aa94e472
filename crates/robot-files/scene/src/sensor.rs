//! Sensors as files describe them.

mod camera;
mod imu;
mod lidar;
mod noise;

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

pub use camera::{Camera, CameraKind, Distortion};
pub use imu::Imu;
pub use lidar::{Lidar, ScanAxis};
pub use noise::{Noise, NoiseKind};

use crate::Plugin;

/// A sensor on a link or joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sensor {
    /// Its name, unique on its parent.
    pub name: String,
    /// Its frame in the link's or joint's.
    pub parent_from_sensor: Pose,
    /// The `type` as written: `ray`, `gpu_lidar`, `depth`, ...
    pub type_name: String,
    /// What it measures, and how.
    pub kind: SensorKind,
    /// Measurements per second [Hz]; 0 is one each step.
    pub update_rate_hz: f64,
    /// Whether it measures though nobody listens.
    pub always_on: bool,
    /// Whether a viewer should draw it.
    pub visualize: bool,
    /// Whether it reports how it performs.
    pub enable_metrics: bool,
    /// The topic, where the file names one.
    pub topic: Option<String>,
    /// The frame of its messages, where the file names one (`gz_frame_id` and its older
    /// spellings).
    pub frame_id: Option<String>,
    /// Plugins.
    pub plugins: Vec<Plugin>,
    /// What nobody here interprets inside the element of its kind, such as `<navsat>`, for kinds
    /// without a list of their own.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub kind_extra: Vec<Element>,
    /// What nobody here interprets.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}

/// What a sensor measures.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorKind {
    /// Distances along rays: `ray`, `gpu_ray`, `lidar`, `gpu_lidar`.
    Lidar(Box<Lidar>),
    /// Images: every kind of camera.
    Camera(Box<Camera>),
    /// Turn rates and accelerations.
    Imu(Box<Imu>),
    /// Position on Earth: `gps`, `navsat`. Noise of position (horizontal, vertical) and velocity
    /// (horizontal, vertical).
    NavSat {
        /// Horizontal position [m].
        position_horizontal: Noise,
        /// Vertical position [m].
        position_vertical: Noise,
        /// Horizontal velocity [m/s].
        velocity_horizontal: Noise,
        /// Vertical velocity [m/s].
        velocity_vertical: Noise,
    },
    /// Magnetic field: noise along x, y, z [T].
    Magnetometer([Noise; 3]),
    /// Height above the start.
    Altimeter {
        /// Noise of the height [m].
        vertical_position: Noise,
        /// Noise of the speed [m/s].
        vertical_velocity: Noise,
    },
    /// Pressure of the air.
    AirPressure {
        /// Height of the world's origin above the sea [m].
        reference_altitude_m: f64,
        /// Noise [Pa].
        pressure: Noise,
    },
    /// Touch.
    Contact {
        /// The collisions that it watches.
        collisions: Vec<String>,
        /// The topic, where the file names one.
        topic: Option<String>,
    },
    /// Forces in a joint.
    ForceTorque {
        /// `child`, `parent` or `sensor`.
        frame: String,
        /// `child_to_parent` or `parent_to_child`.
        measure_direction: String,
        /// Noise along x, y, z [N].
        force: Box<[Noise; 3]>,
        /// Noise about x, y, z [N m].
        torque: Box<[Noise; 3]>,
    },
    /// The nearest distance in a cone.
    Sonar {
        /// `cone` or `sphere`.
        geometry: String,
        /// Nearest [m].
        min_m: f64,
        /// Farthest [m].
        max_m: f64,
        /// Radius of the cone's end [m].
        radius_m: f64,
    },
    /// The models in a frustum.
    LogicalCamera {
        /// Nearest [m].
        near_m: f64,
        /// Farthest [m].
        far_m: f64,
        /// Width over height.
        aspect_ratio: f64,
        /// Angle across [rad].
        horizontal_fov_rad: f64,
    },
    /// A kind that nobody here interprets; its elements are in [`Sensor::extra`].
    Other,
}
