//! Tracks: association, confirmation, deletion.

use std::collections::VecDeque;

use nalgebra::Matrix3;
use periplus_geometry::DVec3;

use crate::association::nearest_neighbours;
use crate::cluster::{Cluster, clusters};
use crate::{ConstantVelocityFilter, RadarCells, RadarPoint, ReturnNoise, ego_velocity};

/// Weight of the newest cluster in the mean size of a track, and in its mean speed in the world.
const NEWEST_RATIO: f64 = 0.3;

/// Radial speed in the world from which on an object moves, in cells of radial velocity.
const MOVING_CELLS_RATIO: f64 = 2.0;

/// Settings of a [`RadarTracker`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerSettings {
    /// Number M of scans that must find a track before it is reported (default 3).
    pub confirm_hits: usize,
    /// Number N of scans within which they must find it (default 5).
    pub confirm_window: usize,
    /// Number of scans without the object after which a confirmed track ends (default 5).
    pub max_misses: usize,
    /// Maximum squared Mahalanobis distance of a cluster to its track (default 18.47, which is exceeded by one of a
    /// thousand with four degrees of freedom: position and radial velocity).
    pub gate: f64,
    /// Standard deviation of accelerations that are not modelled, over one second \[m/s²\] (default 1.5, that of people
    /// that start and stop).
    pub acceleration_stddev_m_per_s2: f64,
    /// Standard deviation of the velocity of a new track across the line of sight \[m/s\] (default 5).
    pub velocity_stddev_m_per_s: f64,
    /// Maximum difference of the radial velocities of neighbouring returns of one object \[m/s\] (default 0.5): limbs
    /// move against the body.
    pub cluster_doppler_m_per_s: f64,
}

impl Default for TrackerSettings {
    fn default() -> Self {
        Self {
            confirm_hits: 3,
            confirm_window: 5,
            max_misses: 5,
            gate: 18.47,
            acceleration_stddev_m_per_s2: 1.5,
            velocity_stddev_m_per_s: 5.0,
            cluster_doppler_m_per_s: 0.5,
        }
    }
}

/// Motion of a tracked object in the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackClass {
    /// The velocity of the radar itself was never found.
    Unknown,
    /// At rest.
    Static,
    /// Moving.
    Dynamic,
}

/// An object that a tracker follows.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedObject {
    id: u64,
    filter: ConstantVelocityFilter,
    size_m: DVec3,
    /// Mean radial speed in the world \[m/s\].
    ground_speed_m_per_s: Option<f64>,
    class: TrackClass,
    /// The last scans, the newest last: true if they found the object.
    history: VecDeque<bool>,
    misses: usize,
    is_confirmed: bool,
}

impl TrackedObject {
    /// Number of the track, unique in its tracker.
    #[must_use]
    pub fn id(&self) -> u64 {
        self.id
    }

    /// Position in the frame of the sensor \[m\].
    #[must_use]
    pub fn position_m(&self) -> DVec3 {
        self.filter.position_m()
    }

    /// Velocity relative to the sensor, in its frame \[m/s\].
    #[must_use]
    pub fn velocity_m_per_s(&self) -> DVec3 {
        self.filter.velocity_m_per_s()
    }

    /// Filter with the covariances.
    #[must_use]
    pub fn filter(&self) -> &ConstantVelocityFilter {
        &self.filter
    }

    /// Extent along the axes of the sensor \[m\].
    #[must_use]
    pub fn size_m(&self) -> DVec3 {
        self.size_m
    }

    /// Motion in the world.
    #[must_use]
    pub fn class(&self) -> TrackClass {
        self.class
    }
}

/// Tracker of the returns of one radar. Positions and velocities are relative to the sensor, so that it needs no
/// odometry; a radar that turns quickly lowers the accuracy of velocities across the line of sight.
#[derive(Clone, Debug, PartialEq)]
pub struct RadarTracker {
    cells: RadarCells,
    noise: ReturnNoise,
    settings: TrackerSettings,
    tracks: Vec<TrackedObject>,
    next_id: u64,
    last_ns: Option<i64>,
}

impl RadarTracker {
    /// Creates a tracker without tracks for a radar with these resolution cells.
    #[must_use]
    pub fn new(cells: RadarCells, settings: TrackerSettings) -> Self {
        let noise = ReturnNoise::default();
        Self { cells, noise, settings, tracks: Vec::new(), next_id: 0, last_ns: None }
    }

    /// Sets the noise of the returns.
    #[must_use]
    pub fn with_noise(self, noise: ReturnNoise) -> Self {
        Self { noise, ..self }
    }

    /// Returns the confirmed tracks, the oldest first.
    pub fn confirmed(&self) -> impl Iterator<Item = &TrackedObject> {
        self.tracks.iter().filter(|track| track.is_confirmed)
    }

    /// Ends all tracks. Numbers of tracks continue.
    pub fn clear(&mut self) {
        self.tracks.clear();
        self.last_ns = None;
    }

    /// Resets to the initial state; numbers of tracks start again.
    pub fn reset(&mut self) {
        self.clear();
        self.next_id = 0;
    }

    /// Updates the tracks by a scan at a time \[ns\]. Returns that are not finite are ignored; so is a scan that is older
    /// than the last.
    pub fn update(&mut self, time_ns: i64, points: &[RadarPoint]) {
        let elapsed_ns = self.last_ns.map_or(0, |last_ns| time_ns - last_ns);
        if elapsed_ns < 0 {
            return;
        }
        self.last_ns = Some(time_ns);
        #[expect(clippy::cast_precision_loss, reason = "a short time")]
        let dt_s = elapsed_ns as f64 * 1e-9;
        for track in &mut self.tracks {
            track.filter.predict(dt_s, self.settings.acceleration_stddev_m_per_s2);
        }
        let points: Vec<RadarPoint> =
            points.iter().copied().filter(RadarPoint::is_finite).collect();
        let ego_m_per_s = ego_velocity(&points, &self.cells);
        let found =
            clusters(&points, &self.cells, &self.noise, self.settings.cluster_doppler_m_per_s);
        let covariances: Vec<Matrix3<f64>> =
            found.iter().map(|cluster| covariance_m2(cluster, &self.cells, &self.noise)).collect();
        let variance = self.doppler_variance();
        let assigned = nearest_neighbours(
            self.tracks.len(),
            found.len(),
            self.settings.gate,
            |track, cluster| {
                let filter = &self.tracks[track].filter;
                filter.distance2(found[cluster].position_m, &covariances[cluster])
                    + doppler_distance2(filter, &found[cluster], variance)
            },
        );
        for (track, cluster) in self.tracks.iter_mut().zip(&assigned) {
            if let Some(cluster) = *cluster {
                track.filter.update_position(found[cluster].position_m, &covariances[cluster]);
                track.filter.update_doppler(found[cluster].doppler_m_per_s, variance);
                track.describe(&found[cluster], ego_m_per_s, &self.cells);
            }
            track.count(cluster.is_some(), &self.settings);
        }
        let settings = self.settings;
        self.tracks.retain(|track| !track.is_over(&settings));
        for (index, cluster) in found.iter().enumerate() {
            if !assigned.contains(&Some(index)) {
                self.begin(cluster, covariances[index], ego_m_per_s);
            }
        }
    }

    /// Variance of the radial velocity of a cluster: that of rounding to a cell, and that of noise.
    fn doppler_variance(&self) -> f64 {
        variance(self.cells.doppler_m_per_s, self.noise.doppler_m_per_s)
    }

    fn begin(
        &mut self,
        cluster: &Cluster,
        covariance_m2: Matrix3<f64>,
        ego_m_per_s: Option<[f64; 2]>,
    ) {
        let stddev_m_per_s = self.settings.velocity_stddev_m_per_s;
        let mut filter =
            ConstantVelocityFilter::new(cluster.position_m, covariance_m2, stddev_m_per_s);
        filter.update_doppler(cluster.doppler_m_per_s, self.doppler_variance());
        let mut track = TrackedObject {
            id: self.next_id,
            filter,
            size_m: cluster.size_m,
            ground_speed_m_per_s: None,
            class: TrackClass::Unknown,
            history: VecDeque::new(),
            misses: 0,
            is_confirmed: false,
        };
        self.next_id += 1;
        track.describe(cluster, ego_m_per_s, &self.cells);
        track.count(true, &self.settings);
        self.tracks.push(track);
    }
}

impl TrackedObject {
    /// Updates size and class by a cluster.
    fn describe(&mut self, cluster: &Cluster, ego: Option<[f64; 2]>, cells: &RadarCells) {
        self.size_m += (cluster.size_m - self.size_m) * NEWEST_RATIO;
        let Some([vx, vy]) = ego else { return };
        let direction = cluster.position_m.normalize_or_zero();
        let speed = (cluster.doppler_m_per_s + direction.x * vx + direction.y * vy).abs();
        let mean = self.ground_speed_m_per_s.map_or(speed, |it| it + (speed - it) * NEWEST_RATIO);
        self.ground_speed_m_per_s = Some(mean);
        let moves = mean > MOVING_CELLS_RATIO * cells.doppler_m_per_s;
        self.class = if moves { TrackClass::Dynamic } else { TrackClass::Static };
    }

    /// Records whether a scan found the object.
    fn count(&mut self, is_found: bool, settings: &TrackerSettings) {
        self.history.push_back(is_found);
        while self.history.len() > settings.confirm_window {
            self.history.pop_front();
        }
        self.misses = if is_found { 0 } else { self.misses + 1 };
        let hits = self.history.iter().filter(|found| **found).count();
        self.is_confirmed |= hits >= settings.confirm_hits;
    }

    /// Returns true if the track ends: a confirmed one after too many misses, another once it can no longer be
    /// confirmed.
    fn is_over(&self, settings: &TrackerSettings) -> bool {
        if self.is_confirmed {
            return self.misses >= settings.max_misses;
        }
        let misses = self.history.iter().filter(|found| !**found).count();
        misses > settings.confirm_window.saturating_sub(settings.confirm_hits)
    }
}

/// Variance of rounding to a cell and of noise.
fn variance(width: f64, stddev: f64) -> f64 {
    width * width / 12.0 + stddev * stddev
}

/// Covariance of the position of a cluster: rounding to a cell and noise along and across the line of sight, and a sixth of
/// the extent of the cluster, whose visible part varies.
fn covariance_m2(cluster: &Cluster, cells: &RadarCells, noise: &ReturnNoise) -> Matrix3<f64> {
    let range_m = cluster.position_m.length();
    let direction = cluster.position_m.normalize_or_zero();
    let across = DVec3::Z.cross(direction).normalize_or(DVec3::Y);
    let up = direction.cross(across);
    let widths_m = [
        (direction, cells.range_m, noise.range_m),
        (across, range_m * cells.azimuth_rad, range_m * noise.azimuth_rad),
        (up, range_m * cells.elevation_rad, range_m * noise.elevation_rad),
    ];
    let mut covariance = Matrix3::zeros();
    for (axis, width_m, stddev_m) in widths_m {
        let axis = nalgebra::Vector3::new(axis.x, axis.y, axis.z);
        covariance += axis * axis.transpose() * variance(width_m, stddev_m);
    }
    for axis in 0..3 {
        let part_m = cluster.size_m[axis] / 6.0;
        covariance[(axis, axis)] += part_m * part_m;
    }
    covariance
}

/// Squared difference of the radial velocities of a track and a cluster, over their variances.
fn doppler_distance2(filter: &ConstantVelocityFilter, cluster: &Cluster, variance: f64) -> f64 {
    let direction = filter.position_m().normalize_or_zero();
    let axis = nalgebra::Vector3::new(direction.x, direction.y, direction.z);
    let predicted = direction.dot(filter.velocity_m_per_s());
    let spread = (axis.transpose() * filter.velocity_covariance() * axis)[0];
    let difference = cluster.doppler_m_per_s - predicted;
    difference * difference / (spread + variance)
}

#[cfg(test)]
mod tests;
