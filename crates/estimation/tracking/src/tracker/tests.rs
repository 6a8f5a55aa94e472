use super::*;

const CELLS: RadarCells =
    RadarCells { range_m: 0.4, azimuth_rad: 0.02, elevation_rad: 0.1, doppler_m_per_s: 0.1 };

/// Interval of scans: 20 Hz \[ns\].
const INTERVAL_NS: i64 = 50_000_000;

/// Return of an object, rounded to cells.
fn seen(position_m: DVec3, velocity_m_per_s: DVec3) -> RadarPoint {
    let round = |value: f64, width: f64| (value / width).round() * width;
    let direction = position_m.normalize();
    RadarPoint {
        range_m: round(position_m.length(), CELLS.range_m),
        azimuth_rad: round(libm::atan2(position_m.y, position_m.x), CELLS.azimuth_rad),
        elevation_rad: 0.0,
        doppler_m_per_s: round(direction.dot(velocity_m_per_s), CELLS.doppler_m_per_s),
        amplitude_db: 0.0,
    }
}

/// Two objects that cross in front of the radar keep their tracks. In the end positions and radial velocities are within
/// a cell of the truth, and velocities across the line of sight within the tracker's own three standard deviations.
#[test]
fn crossing_objects_keep_their_tracks() {
    let starts = [DVec3::new(18.0, -4.0, 0.0), DVec3::new(12.0, 3.0, 0.0)];
    let velocities = [DVec3::new(-1.5, 1.0, 0.0), DVec3::new(0.5, -0.8, 0.0)];
    let at = |object: usize, time_s: f64| starts[object] + velocities[object] * time_s;
    let mut tracker = RadarTracker::new(CELLS, TrackerSettings::default());
    for scan in 0..100_i32 {
        let time_s = f64::from(scan) * 0.05;
        let points = [0, 1].map(|object| seen(at(object, time_s), velocities[object]));
        tracker.update(i64::from(scan) * INTERVAL_NS, &points);
    }
    let tracks: Vec<_> = tracker.confirmed().collect();
    assert_eq!(tracks.len(), 2);
    for (object, track) in tracks.iter().enumerate() {
        assert_eq!(track.id(), object as u64);
        let off_m = (track.position_m() - at(object, 4.95)).length();
        let off_m_per_s = track.velocity_m_per_s() - velocities[object];
        let radial_m_per_s = off_m_per_s.dot(track.position_m().normalize()).abs();
        let covariance = track.filter().velocity_covariance();
        let limit_m_per_s = 3.0 * (covariance[(0, 0)] + covariance[(1, 1)]).sqrt();
        assert!(off_m < 0.3 && radial_m_per_s < 0.1, "{object}: {off_m} m, {radial_m_per_s} m/s");
        assert!(off_m_per_s.length() < limit_m_per_s && limit_m_per_s < 2.0, "{off_m_per_s}");
    }
}

/// With 3 of 5: no track after two scans, one after the third, also with gaps; it ends after five misses.
#[test]
fn tracks_are_confirmed_after_m_of_n_and_end_after_misses() {
    let point = seen(DVec3::X * 10.0, DVec3::ZERO);
    let check = |pattern: &str, expected: &str| {
        let mut tracker = RadarTracker::new(CELLS, TrackerSettings::default());
        let mut counts = String::new();
        for (scan, letter) in (0..).zip(pattern.chars()) {
            let points = if letter == 'x' { vec![point] } else { Vec::new() };
            tracker.update(scan * INTERVAL_NS, &points);
            counts.push_str(&tracker.confirmed().count().to_string());
        }
        assert_eq!(counts, expected, "{pattern}");
    };
    check("xxx", "001");
    check("x.x.x", "00001");
    check("x...xx.", "0000000");
    check("xxx.....x", "001111100");
}

/// A radar that drives with 2 m/s: the posts are at rest, the object that keeps its distance moves.
#[test]
fn objects_at_rest_are_distinguished_from_moving_ones() {
    let ego = DVec3::X * 2.0;
    let mut tracker = RadarTracker::new(CELLS, TrackerSettings::default());
    let posts = [(12.0, -4.0), (14.0, -2.0), (13.0, 2.0), (12.0, 5.0), (20.0, 7.0)];
    for scan in 0..10_i32 {
        let time_s = f64::from(scan) * 0.05;
        let mut points: Vec<RadarPoint> =
            posts.iter().map(|&(x, y)| seen(DVec3::new(x, y, 0.0) - ego * time_s, -ego)).collect();
        points.push(seen(DVec3::new(8.0, 0.5, 0.0), DVec3::ZERO));
        tracker.update(i64::from(scan) * INTERVAL_NS, &points);
    }
    let moving: Vec<bool> =
        tracker.confirmed().map(|it| it.class() == TrackClass::Dynamic).collect();
    assert_eq!(moving, [false, false, false, false, false, true]);
    assert!(tracker.confirmed().all(|track| track.class() != TrackClass::Unknown));
}

/// Without returns of several objects the velocity of the radar is not known.
#[test]
fn one_object_alone_has_no_class() {
    let mut tracker = RadarTracker::new(CELLS, TrackerSettings::default());
    for scan in 0..5 {
        tracker.update(scan * INTERVAL_NS, &[seen(DVec3::X * 8.0, DVec3::ZERO)]);
    }
    let classes: Vec<TrackClass> = tracker.confirmed().map(TrackedObject::class).collect();
    assert_eq!(classes, [TrackClass::Unknown]);
}

/// The same scans give the same tracks; an older scan and returns that are not finite change nothing.
#[test]
fn updates_are_repeatable() {
    let run = |extra: &[RadarPoint]| {
        let mut tracker = RadarTracker::new(CELLS, TrackerSettings::default());
        for scan in 0..20_i32 {
            let at_m = DVec3::new(15.0 - f64::from(scan) * 0.1, 1.0, 0.0);
            let mut points = vec![seen(at_m, DVec3::new(-2.0, 0.0, 0.0))];
            points.extend(extra);
            tracker.update(i64::from(scan) * INTERVAL_NS, &points);
        }
        tracker
    };
    let mut tracker = run(&[]);
    assert_eq!(tracker, run(&[]));
    assert_eq!(tracker, run(&[RadarPoint { range_m: f64::NAN, ..RadarPoint::default() }]));
    let before = tracker.clone();
    tracker.update(0, &[]);
    assert_eq!(tracker, before);
}

/// Returns whose ranges scatter by up to 1.6 m are one object for a tracker that knows of it, and several for another.
#[test]
fn known_noise_joins_scattered_returns() {
    let count = |noise: ReturnNoise| {
        let mut tracker = RadarTracker::new(CELLS, TrackerSettings::default()).with_noise(noise);
        for scan in 0..10_i32 {
            let shift_m = if scan % 2 == 0 { 0.4 } else { -0.4 };
            let points = [-0.4, 0.4].map(|part| RadarPoint {
                range_m: 15.0 + shift_m * part / 0.4 + part,
                ..RadarPoint::default()
            });
            tracker.update(i64::from(scan) * INTERVAL_NS, &points);
        }
        tracker.confirmed().count()
    };
    assert_eq!(count(ReturnNoise { range_m: 0.6, ..ReturnNoise::default() }), 1);
    assert!(count(ReturnNoise::default()) > 1);
}
