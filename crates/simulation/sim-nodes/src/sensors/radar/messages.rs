//! Messages of a radar.

use periplus_geometry::DVec3;
use periplus_msgs::geometry_msgs::{Point, Vector3};
use periplus_msgs::radar_msgs::{RadarReturn, RadarTrack};
use periplus_msgs::unique_identifier_msgs::UUID;
use periplus_sensors::{RadarDetection, Streams};
use periplus_tracking::{RadarPoint, TrackClass, TrackedObject, TrackerSettings};

/// Indices of the upper triangle of a matrix of three rows, row by row.
const UPPER_TRIANGLE_INDEX: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

pub(super) fn return_of(detection: &RadarDetection) -> RadarReturn {
    RadarReturn {
        range: single(detection.range_m),
        azimuth: single(detection.azimuth_rad),
        elevation: single(detection.elevation_rad),
        doppler_velocity: single(detection.doppler_m_per_s),
        amplitude: single(detection.amplitude_db),
    }
}

pub(super) fn point_of(message: &RadarReturn) -> RadarPoint {
    RadarPoint {
        range_m: message.range.into(),
        azimuth_rad: message.azimuth.into(),
        elevation_rad: message.elevation.into(),
        doppler_m_per_s: message.doppler_velocity.into(),
        amplitude_db: message.amplitude.into(),
    }
}

/// Converts a track. Accelerations are not estimated: they are zero, with the variance that the tracker assumes.
pub(super) fn track_of(track: &TrackedObject, streams: &Streams) -> RadarTrack {
    let DVec3 { x, y, z } = track.position_m();
    let filter = track.filter();
    let (position, velocity) = (filter.position_covariance_m2(), filter.velocity_covariance());
    let acceleration = TrackerSettings::default().acceleration_stddev_m_per_s2;
    let diagonal = |variance: f64| {
        UPPER_TRIANGLE_INDEX.map(|[row, column]| if row == column { single(variance) } else { 0.0 })
    };
    RadarTrack {
        uuid: uuid_of(track.id(), streams),
        position: Point { x, y, z },
        velocity: vector(track.velocity_m_per_s()),
        acceleration: Vector3::default(),
        size: vector(track.size_m()),
        classification: match track.class() {
            TrackClass::Unknown => RadarTrack::NO_CLASSIFICATION,
            TrackClass::Static => RadarTrack::STATIC,
            TrackClass::Dynamic => RadarTrack::DYNAMIC,
        },
        position_covariance: UPPER_TRIANGLE_INDEX
            .map(|[row, column]| single(position[(row, column)])),
        velocity_covariance: UPPER_TRIANGLE_INDEX
            .map(|[row, column]| single(velocity[(row, column)])),
        acceleration_covariance: diagonal(acceleration * acceleration),
        // A size is known to a sixth of itself along each axis.
        size_covariance: UPPER_TRIANGLE_INDEX.map(|[row, column]| {
            let part_m = track.size_m()[row] / 6.0;
            if row == column { single(part_m * part_m) } else { 0.0 }
        }),
    }
}

/// Random identifier (version 4 of RFC 9562) that is the same in each run with the same seed.
fn uuid_of(id: u64, streams: &Streams) -> UUID {
    let mut stream = streams.once(&format!("track {id}"));
    let mut uuid = [0; 16];
    uuid[..8].copy_from_slice(&stream.bits().to_be_bytes());
    uuid[8..].copy_from_slice(&stream.bits().to_be_bytes());
    uuid[6] = uuid[6] & 0x0f | 0x40;
    uuid[8] = uuid[8] & 0x3f | 0x80;
    UUID { uuid }
}

fn vector(DVec3 { x, y, z }: DVec3) -> Vector3 {
    Vector3 { x, y, z }
}

#[expect(clippy::cast_possible_truncation, reason = "messages have single precision")]
fn single(value: f64) -> f32 {
    value as f32
}
