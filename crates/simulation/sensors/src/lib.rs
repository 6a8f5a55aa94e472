//! Sensor models: ideal readings as plain numbers, then noise.
//!
//! No messages and no clock: a reading is a function of a specification, the true state of the world
//! and a random stream keyed by (seed, sensor, tick). Time since the last reading is an argument.
//!
//! Out-of-range values follow REP 117: `-inf` for too near, `+inf` for no hit.
//!
//! ```
//! use periplus_scene::{NoiseKind, NoiseSpec};
//! use periplus_sensors::{NoiseModel, Quirks, Schedule, Streams};
//!
//! // A range of 2 m, measured at 10 Hz for 100 s with a standard deviation of 0.01 m.
//! let streams = Streams::new(1, "cart::sonar");
//! let spec = NoiseSpec { kind: NoiseKind::Gaussian, stddev: 0.01, ..NoiseSpec::default() };
//! let mut noise = NoiseModel::new(&spec, &streams, "range");
//! let mut schedule = Schedule::new(10.0, 0, Quirks::default());
//! let (mut sum_m, mut count) = (0.0, 0.0);
//! for step in 0..10_000 {
//!     let Some(tick) = schedule.due(step * 10_000_000) else { continue };
//!     sum_m += noise.apply(2.0, schedule.period_s(), &mut streams.tick(tick));
//!     count += 1.0;
//! }
//! assert_eq!(count, 1000.0);
//! assert!(f64::abs(sum_m / count - 2.0) < 0.001);
//! ```

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
mod radar;
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
pub use radar::{RadarDetection, RadarEcho, RadarSensor};
pub use scan_motion::Sweep;
pub use schedule::Schedule;
pub use sonar::Sonar;
pub use view::RayView;
