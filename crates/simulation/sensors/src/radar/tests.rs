use periplus_raycast::{RaycastShape, RaycastWorld, Tags};

use super::*;

/// Cells of 0.4 m, 0.02 rad and 0.2 m/s, one row.
fn spec() -> RadarSpec {
    RadarSpec {
        horizontal_fov_rad: 1.0,
        vertical_fov_rad: 0.1,
        range_min_m: 0.5,
        range_max_m: 60.0,
        range_resolution_m: 0.4,
        azimuth_resolution_rad: 0.02,
        elevation_resolution_rad: 0.1,
        doppler_resolution_m_per_s: 0.2,
        ..RadarSpec::default()
    }
}

/// A box of 1 m with its centre here.
fn cube(x: f64, y: f64) -> RaycastWorld {
    let mut builder = RaycastWorld::builder();
    let shape = RaycastShape::Box { size_m: DVec3::ONE };
    builder.add_shape(&shape, &Pose::from_xyz(x, y, 0.0), Tags::default()).unwrap();
    builder.build(1).unwrap()
}

fn scan(
    spec: &RadarSpec,
    world: &RaycastWorld,
    motion: Motion,
    velocity_m_per_s: DVec3,
    seed: u64,
) -> Vec<RadarDetection> {
    let mut radar = RadarSensor::new(spec).unwrap();
    let mut stream = Stream::keyed(seed, "radar", 0);
    radar.scan(&RayView::of(world), &motion, &mut |_| velocity_m_per_s, &mut stream).to_vec()
}

fn strongest(detections: &[RadarDetection]) -> RadarDetection {
    let strongest = detections.iter().max_by(|a, b| a.amplitude_db.total_cmp(&b.amplitude_db));
    *strongest.unwrap()
}

/// The face of the box is 19.5 m ahead and comes nearer with 3.07 m/s.
#[test]
fn a_moving_box_has_its_range_azimuth_and_radial_velocity() {
    let at_rest = Motion::at_rest(Pose::IDENTITY);
    let found = scan(&spec(), &cube(20.0, 0.0), at_rest, DVec3::new(-3.07, 0.0, 0.0), 0);
    let best = strongest(&found);
    assert!((best.range_m - 19.5).abs() <= 0.2, "{best:?}");
    assert!(best.azimuth_rad.abs() <= 0.01 + 1e-12 && best.elevation_rad.abs() < 1e-12, "{best:?}");
    assert!((best.doppler_m_per_s + 3.07).abs() <= 0.1 + 1e-12, "{best:?}");
    // ±0.5 m at 19.5 m are ±0.0256 rad: the four cells within ±0.04 rad, all of one range and velocity.
    assert_eq!(found.len(), 4, "{found:?}");
    assert!(found.iter().all(|it| it.azimuth_rad.abs() < 0.04 && it.range_m == best.range_m));
}

/// A radar that drives with 5 m/s at a wall 60° to the left sees it come nearer with 5 cos 60° m/s.
#[test]
fn a_wall_at_rest_comes_nearer_by_the_cosine() {
    let turned = periplus_geometry::Rpy { roll: 0.0, pitch: 0.0, yaw: std::f64::consts::FRAC_PI_3 };
    let motion = Motion {
        world_from_sensor: Pose::from_xyz_rpy([0.0; 3], turned),
        linear_m_s: DVec3::X * 5.0,
        angular_rad_s: DVec3::Z,
    };
    let (sine, cosine) = libm::sincos(std::f64::consts::FRAC_PI_3);
    let world = cube(20.0 * cosine, 20.0 * sine);
    let found = scan(&spec(), &world, motion, DVec3::ZERO, 0);
    assert!(found.len() >= 4, "{found:?}");
    for seen in found {
        let angle_rad = std::f64::consts::FRAC_PI_3 + seen.azimuth_rad;
        let expected_m_per_s = -5.0 * libm::cos(angle_rad);
        // Half a cell of velocity, and the change of the velocity across half a cell of azimuth.
        let tolerance_m_per_s = 0.1 + 5.0 * 0.01;
        let error_m_per_s = (seen.doppler_m_per_s - expected_m_per_s).abs();
        assert!(error_m_per_s <= tolerance_m_per_s, "{seen:?} {expected_m_per_s}");
    }
}

/// A plate of 1 m² that faces the radar has a cross-section of 1 m², so that its amplitude is -40 log10(R).
#[test]
fn amplitudes_follow_the_radar_equation() {
    let fine = RadarSpec {
        horizontal_fov_rad: 0.2,
        vertical_fov_rad: 0.2,
        elevation_resolution_rad: 0.002,
        azimuth_resolution_rad: 0.002,
        min_cross_section_m2: 0.0,
        ..spec()
    };
    for distance_m in [10.0, 20.0, 40.0] {
        let world = cube(distance_m + 0.5, 0.0);
        let at_rest = Motion::at_rest(Pose::IDENTITY);
        let found = scan(&fine, &world, at_rest, DVec3::ZERO, 0);
        let power: f64 = found.iter().map(|it| libm::pow(10.0, it.amplitude_db / 10.0)).sum();
        let (seen_db, expected_db) = (10.0 * libm::log10(power), -40.0 * libm::log10(distance_m));
        assert!((seen_db - expected_db).abs() < 0.25, "{seen_db} {expected_db}");
    }
}

/// Two cells have half of the box each: 0.5 m² at 57.5 m is above a threshold of 0.2 m² at 60 m, and below 2 m².
#[test]
fn weak_returns_are_not_reported() {
    let at_rest = Motion::at_rest(Pose::IDENTITY);
    for (min_cross_section_m2, count) in [(0.2, 2), (2.0, 0)] {
        let spec = RadarSpec { min_cross_section_m2, ..spec() };
        let found = scan(&spec, &cube(58.0, 0.0), at_rest, DVec3::ZERO, 0);
        assert_eq!(found.len(), count, "{found:?}");
    }
}

/// Noise moves returns to other cells, by whole cells, and is the same for a seed.
#[test]
fn noise_is_repeatable_and_on_cells() {
    let noise =
        RadarNoise { range_stddev_m: 1.0, doppler_stddev_m_per_s: 0.5, ..RadarNoise::default() };
    let noisy = RadarSpec { noise, ..spec() };
    let at_rest = Motion::at_rest(Pose::IDENTITY);
    let run = |seed| scan(&noisy, &cube(20.0, 0.0), at_rest, DVec3::ZERO, seed);
    assert_eq!(run(7), run(7));
    assert_ne!(run(7), run(8));
    let mut ranges: Vec<f64> = (0..200).flat_map(run).map(|it| it.range_m).collect();
    for range_m in &ranges {
        let cells = range_m / 0.4;
        assert!((cells - cells.round()).abs() < 1e-9, "{range_m}");
    }
    let count = ranges.len() as f64;
    let mean_m = ranges.iter().sum::<f64>() / count;
    ranges.iter_mut().for_each(|it| *it = (*it - mean_m) * (*it - mean_m));
    let stddev_m = (ranges.iter().sum::<f64>() / count).sqrt();
    // Standard deviation 1 m and that of the rounding, 0.4 / √12.
    assert!((mean_m - 19.6).abs() < 0.12 && (stddev_m - 1.007).abs() < 0.08, "{mean_m} {stddev_m}");
}

#[test]
fn impossible_radars_are_rejected() {
    let spec = spec();
    for wrong in [
        RadarSpec { range_max_m: 0.1, ..spec.clone() },
        RadarSpec { range_max_m: f64::INFINITY, ..spec.clone() },
        RadarSpec { horizontal_fov_rad: 0.0, ..spec.clone() },
        RadarSpec { vertical_fov_rad: 4.0, ..spec.clone() },
        RadarSpec { azimuth_resolution_rad: 0.0, ..spec.clone() },
        RadarSpec { azimuth_resolution_rad: 1e-5, ..spec.clone() },
        RadarSpec { doppler_resolution_m_per_s: f64::NAN, ..spec },
    ] {
        assert!(RadarSensor::new(&wrong).is_err(), "{wrong:?}");
    }
}
