//! Sensors as described in files.

mod camera;
mod imu;
mod lidar;
mod noise;
mod radar;

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

pub use camera::{Camera, CameraKind, Distortion};
pub use imu::ImuSpec;
pub use lidar::{LidarSpec, ScanAxis};
pub use noise::{NoiseKind, NoiseSpec};
pub use radar::{RadarNoise, RadarSpec};

use crate::Plugin;

/// Sensor on a link or joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sensor {
    /// Its name, unique on its parent.
    pub name: String,
    /// Sensor frame in the link's or joint's frame.
    pub parent_from_sensor: Pose,
    /// The `type` as written: `ray`, `gpu_lidar`, `depth`, ...
    pub type_name: String,
    /// Measured quantity and settings.
    pub kind: SensorKind,
    /// Measurements per second [Hz]; 0 is one each step.
    pub update_rate_hz: f64,
    /// True if it measures without subscribers.
    pub always_on: bool,
    /// True if a viewer should draw it.
    pub visualize: bool,
    /// True if it publishes performance metrics.
    pub enable_metrics: bool,
    /// Topic, if given.
    pub topic: Option<String>,
    /// Frame of its messages, if given (`gz_frame_id` and its older names).
    pub frame_id: Option<String>,
    /// Plugins.
    pub plugins: Vec<Plugin>,
    /// Uninterpreted elements inside the settings of its type, such as `<navsat>`, for types without their
    /// own list.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub kind_extra: Vec<Element>,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// Measured quantity of a sensor with its settings.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorKind {
    /// Ranges along rays: `ray`, `gpu_ray`, `lidar`, `gpu_lidar`.
    Lidar(Box<LidarSpec>),
    /// Returns with range, angles and radial velocity.
    Radar(Box<RadarSpec>),
    /// Images: every type of camera.
    Camera(Box<Camera>),
    /// Angular velocity and linear acceleration.
    Imu(Box<ImuSpec>),
    /// Position on Earth: `gps`, `navsat`. Noise of position (horizontal, vertical) and velocity
    /// (horizontal, vertical).
    NavSat {
        /// Horizontal position [m].
        position_horizontal: NoiseSpec,
        /// Vertical position [m].
        position_vertical: NoiseSpec,
        /// Horizontal velocity [m/s].
        velocity_horizontal: NoiseSpec,
        /// Vertical velocity [m/s].
        velocity_vertical: NoiseSpec,
    },
    /// Magnetic field: noise along x, y, z [T].
    Magnetometer([NoiseSpec; 3]),
    /// Height relative to the initial height.
    Altimeter {
        /// Noise of the height [m].
        vertical_position: NoiseSpec,
        /// Noise of the speed [m/s].
        vertical_velocity: NoiseSpec,
    },
    /// Air pressure.
    AirPressure {
        /// Height of the world's origin above sea level [m].
        reference_altitude_m: f64,
        /// Noise [Pa].
        pressure: NoiseSpec,
    },
    /// Contacts.
    Contact {
        /// Collisions that it monitors.
        collisions: Vec<String>,
        /// Topic, if given.
        topic: Option<String>,
    },
    /// Force and torque in a joint.
    ForceTorque {
        /// `child`, `parent` or `sensor`.
        frame: String,
        /// `child_to_parent` or `parent_to_child`.
        measure_direction: String,
        /// Noise of the force along x, y, z [N].
        force: Box<[NoiseSpec; 3]>,
        /// Noise of the torque about x, y, z [N m].
        torque: Box<[NoiseSpec; 3]>,
    },
    /// Minimum distance in a cone.
    Sonar {
        /// `cone` or `sphere`.
        geometry: String,
        /// Minimum range [m].
        min_m: f64,
        /// Maximum range [m].
        max_m: f64,
        /// Radius at the end of the cone [m].
        radius_m: f64,
    },
    /// Models in a frustum.
    LogicalCamera {
        /// Near plane [m].
        near_m: f64,
        /// Far plane [m].
        far_m: f64,
        /// Width over height.
        aspect_ratio: f64,
        /// Horizontal field of view [rad].
        horizontal_fov_rad: f64,
    },
    /// Uninterpreted type; its elements are in [`Sensor::extra`].
    Other,
}
