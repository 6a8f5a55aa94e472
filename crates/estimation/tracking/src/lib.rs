//! Tracks of objects from the returns of a radar.
//!
//! A [`RadarTracker`] reads the returns of one scan after the other ([`RadarPoint`]) and nothing else. It
//! joins returns in neighbouring resolution cells to clusters, associates each with the nearest track inside its gate,
//! and updates a Kalman filter with constant velocity by the position and radial velocity of the cluster. A
//! track is reported once M of its last N scans have found it.
//!
//! ```
//! use periplus_tracking::{RadarCells, RadarPoint, RadarTracker, TrackerSettings};
//!
//! let cells = RadarCells { range_m: 0.4, azimuth_rad: 0.02, elevation_rad: 0.1, doppler_m_per_s: 0.1 };
//! let mut tracker = RadarTracker::new(cells, TrackerSettings::default());
//! for scan in 0..20_i32 {
//!     // Ahead, and 2 m/s nearer, at 10 Hz.
//!     let range_m = 30.0 - 0.2 * f64::from(scan);
//!     let point = RadarPoint { range_m, doppler_m_per_s: -2.0, ..RadarPoint::default() };
//!     tracker.update(i64::from(scan) * 100_000_000, &[point]);
//! }
//! let track = tracker.confirmed().next().expect("a track");
//! assert!((track.position_m().x - 26.2).abs() < 0.2 && (track.velocity_m_per_s().x + 2.0).abs() < 0.1);
//! ```

mod association;
mod cluster;
mod ego_velocity;
mod filter;
mod tracker;

pub use ego_velocity::ego_velocity;
pub use filter::ConstantVelocityFilter;
pub use tracker::{RadarTracker, TrackClass, TrackedObject, TrackerSettings};

use periplus_geometry::DVec3;

/// Return of a radar, as `radar_msgs/RadarReturn` has it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RadarPoint {
    /// Distance \[m\].
    pub range_m: f64,
    /// Angle to the left of x \[rad\].
    pub azimuth_rad: f64,
    /// Angle above the plane of x and y \[rad\].
    pub elevation_rad: f64,
    /// Radial velocity, positive away from the sensor \[m/s\].
    pub doppler_m_per_s: f64,
    /// Received power \[dB\].
    pub amplitude_db: f64,
}

impl RadarPoint {
    /// Returns the direction in the frame of the sensor.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        let (up, level) = libm::sincos(self.elevation_rad);
        let (left, ahead) = libm::sincos(self.azimuth_rad);
        DVec3::new(level * ahead, level * left, up)
    }

    /// Returns the position in the frame of the sensor \[m\].
    #[must_use]
    pub fn position_m(&self) -> DVec3 {
        self.direction() * self.range_m
    }

    fn is_finite(&self) -> bool {
        let numbers = [self.range_m, self.azimuth_rad, self.elevation_rad, self.doppler_m_per_s];
        numbers.iter().all(|number| number.is_finite()) && self.amplitude_db.is_finite()
    }
}

/// Standard deviations of the returns of a radar beside rounding to cells; zero by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReturnNoise {
    /// Range \[m\].
    pub range_m: f64,
    /// Azimuth \[rad\].
    pub azimuth_rad: f64,
    /// Elevation \[rad\].
    pub elevation_rad: f64,
    /// Radial velocity \[m/s\].
    pub doppler_m_per_s: f64,
}

/// Widths of the resolution cells of a radar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadarCells {
    /// Range \[m\].
    pub range_m: f64,
    /// Azimuth \[rad\].
    pub azimuth_rad: f64,
    /// Elevation \[rad\].
    pub elevation_rad: f64,
    /// Radial velocity \[m/s\].
    pub doppler_m_per_s: f64,
}
