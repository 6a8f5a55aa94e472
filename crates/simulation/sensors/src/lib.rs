//! Sensor models: ideal readings as plain numbers, then noise.
//!
//! No messages and no clock: a reading is a function of a specification, the true state of the world
//! and a random stream keyed by (seed, sensor, tick). Time since the last reading is an argument.
//!
//! Out-of-range values follow REP 117: `-inf` for too near, `+inf` for no hit.

mod camera;
mod contact;
mod environment;
mod force_torque;
mod geodesy;
mod gz_quirks;
mod imu;
mod lidar;
mod logical_camera;
mod motion;
mod navsat;
mod noise;
mod scan_motion;
mod schedule;
mod sonar;
mod view;

pub use camera::{CameraCalibration, ImageNoise, MAX_PIXELS, Pinhole, clip_depths};
pub use contact::contacts_of;
pub use environment::{Altimeter, AltimeterReading, Barometer, Magnetometer, standard_pressure_pa};
pub use force_torque::{ForceFrame, ForceTorque, Wrench};
pub use geodesy::{Ellipsoid, GeodeticPosition, LocalTangentFrame};
pub use gz_quirks::Quirks;
pub use imu::{ImuMeasurement, ImuSensor, OrientationReference};
pub use lidar::{LidarBeams, LidarScan, LidarSensor, MAX_BEAMS};
pub use logical_camera::LogicalCamera;
pub use motion::Motion;
pub use navsat::{NavSat, NavSatNoise, NavSatReading};
pub use noise::{NoiseModel, Streams};
pub use scan_motion::Sweep;
pub use schedule::Schedule;
pub use sonar::Sonar;
pub use view::RayView;
