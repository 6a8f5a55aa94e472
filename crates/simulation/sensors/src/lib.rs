//! What sensors measure: ideal readings as plain numbers, then noise.
//!
//! No messages and no clock: a reading is a function of a specification, the true state of the
//! world and a random stream named by (seed, sensor, tick). Where the time since the last reading
//! matters it is handed in.
//!
//! Out of range is told as REP 117 says: `-inf` too near, `+inf` nothing there.

mod camera;
mod field;
mod force_torque;
mod geodesy;
mod imu;
mod lidar;
mod logical;
mod motion;
mod navsat;
mod noise;
mod quirks;
mod schedule;
mod sonar;
mod sweep;
mod touch;
mod view;

pub use camera::{Calibration, ImageNoise, MOST_PIXELS, Pinhole, clip_depths};
pub use field::{Altimeter, AltimeterReading, Barometer, Magnetometer, standard_pressure_pa};
pub use force_torque::{ForceFrame, ForceTorque, Wrench};
pub use geodesy::{Ellipsoid, Geodetic, Globe};
pub use imu::{Imu, ImuReading, OrientationReference};
pub use lidar::{Beams, Lidar, MOST_BEAMS, Scan};
pub use logical::LogicalCamera;
pub use motion::Motion;
pub use navsat::{NavSat, NavSatNoise, NavSatReading};
pub use noise::{NoiseModel, Streams};
pub use quirks::Quirks;
pub use schedule::Schedule;
pub use sonar::Sonar;
pub use sweep::Sweep;
pub use touch::touches;
pub use view::View;
