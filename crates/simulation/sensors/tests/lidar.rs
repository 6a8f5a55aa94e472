//! Lidars against closed forms, brute force, and the rules of REP 117.

use periplus_geometry::{DVec3, Pose, Rpy, Stream};
use periplus_raycast::{InstanceId, RaycastShape, RaycastWorld, Tags};
use periplus_scene::{NoiseKind, NoiseSpec, ScanAxis};
use periplus_sensors::{LidarSensor, RayView, Streams, Sweep};
use proptest::prelude::*;

/// Required accuracy [m].
const EXACT_M: f64 = 1e-5;

fn axis(samples: u32, min_angle_rad: f64, max_angle_rad: f64) -> ScanAxis {
    ScanAxis { samples, resolution: 1.0, min_angle_rad, max_angle_rad }
}

fn spec(horizontal: ScanAxis, vertical: ScanAxis) -> periplus_scene::LidarSpec {
    periplus_scene::LidarSpec {
        horizontal,
        vertical,
        range_min_m: 0.1,
        range_max_m: 30.0,
        range_resolution_m: 0.01,
        noise: NoiseSpec::default(),
        visibility_mask: u32::MAX,
        extra: Vec::new(),
    }
}

fn flat(samples: u32) -> periplus_scene::LidarSpec {
    let pi = std::f64::consts::PI;
    spec(axis(samples, -pi, pi), axis(1, 0.0, 0.0))
}

fn lidar(spec: &periplus_scene::LidarSpec) -> LidarSensor {
    LidarSensor::new(spec, &Streams::new(3, "robot::base::lidar")).expect("a sound lidar")
}

fn world(shapes: &[(RaycastShape, Pose)]) -> RaycastWorld {
    let mut builder = RaycastWorld::builder();
    for (shape, pose) in shapes {
        builder.add_shape(shape, pose, Tags::default()).expect("a sound shape");
    }
    builder.build(1).expect("few shapes")
}

fn turned(xyz: [f64; 3], roll: f64, pitch: f64, yaw: f64) -> Pose {
    Pose::from_xyz_rpy(xyz, Rpy { roll, pitch, yaw })
}

fn ranges(lidar: &mut LidarSensor, world: &RaycastWorld, pose: Pose) -> Vec<f32> {
    let mut stream = Stream::keyed(0, "", 0);
    lidar.scan(&RayView::of(world), Sweep::AtOnce(pose), &mut stream).ranges_m.clone()
}

/// Every range of a scan from the origin against a closed form: azimuth and elevation to metres.
fn check(
    spec: &periplus_scene::LidarSpec,
    world: &RaycastWorld,
    form: impl Fn(f64, f64) -> Option<f64>,
) {
    let mut lidar = lidar(spec);
    let measured = ranges(&mut lidar, world, Pose::IDENTITY);
    let mut hits = 0;
    for (measured, [azimuth, elevation]) in measured.iter().zip(lidar.beams().range_angles()) {
        match form(azimuth, elevation) {
            Some(expected) => {
                hits += 1;
                let error = (f64::from(*measured) - expected).abs();
                assert!(error < EXACT_M, "{azimuth} {elevation}: {measured} {expected}");
            }
            None => assert_eq!(*measured, f32::INFINITY, "{azimuth} {elevation}"),
        }
    }
    assert!(hits > 0);
}

/// Returns the first intersection of a line from the origin with a sphere.
fn sphere(middle: DVec3, radius_m: f64, direction: DVec3) -> Option<f64> {
    let along = middle.dot(direction);
    let square = along * along - middle.length_squared() + radius_m * radius_m;
    (square > 0.0 && along > 0.0).then(|| along - square.sqrt())
}

fn direction(azimuth: f64, elevation: f64) -> DVec3 {
    let (up, out) = libm::sincos(elevation);
    DVec3::new(out * libm::cos(azimuth), out * libm::sin(azimuth), up)
}

#[test]
fn a_sphere_by_16_360_and_1440_beams() {
    let middle = DVec3::new(3.0, 0.5, 0.0);
    let pose = Pose::from_xyz(3.0, 0.5, 0.0);
    let world = world(&[(RaycastShape::Sphere { radius_m: 1.0 }, pose)]);
    for samples in [16, 360, 1440] {
        check(&flat(samples), &world, |a, e| sphere(middle, 1.0, direction(a, e)));
    }
}

/// The walls of a square room 8 m wide, from its middle: 4 / max(|cos|, |sin|).
#[test]
fn a_room_by_16_360_and_1440_beams() {
    let room = world(&[(RaycastShape::Box { size_m: DVec3::new(8.0, 8.0, 3.0) }, Pose::IDENTITY)]);
    for samples in [16, 360, 1440] {
        check(&flat(samples), &room, |a, _| Some(4.0 / libm::cos(a).abs().max(libm::sin(a).abs())));
    }
}

/// A wall at an angle: x cos t + y sin t = 2.
#[test]
fn a_wall_at_an_angle() {
    let tilt = 0.4_f64;
    let (x, y) = (2.0 * libm::cos(tilt), 2.0 * libm::sin(tilt));
    let pose = turned([x, y, 0.0], 0.0, std::f64::consts::FRAC_PI_2, 0.0);
    let pose = Pose { rotation: turned([0.0; 3], 0.0, 0.0, tilt).rotation * pose.rotation, ..pose };
    let world = world(&[(RaycastShape::Plane { size_m: None }, pose)]);
    for samples in [16, 360, 1440] {
        check(&flat(samples), &world, |a, _| {
            let distance = 2.0 / libm::cos(a - tilt);
            (distance > 0.0 && distance < 30.0).then_some(distance)
        });
    }
}

/// 64 rows of 1024 in a hall with a column: a cylinder about z, and the floor 1 m below.
#[test]
fn a_column_and_the_floor_by_64_by_1024() {
    let world = world(&[
        (RaycastShape::Cylinder { radius_m: 0.5, length_m: 100.0 }, Pose::from_xyz(2.0, 0.0, 0.0)),
        (RaycastShape::Plane { size_m: None }, Pose::from_xyz(0.0, 0.0, -1.0)),
    ]);
    let pi = std::f64::consts::PI;
    let spec = spec(axis(1024, -pi, pi), axis(64, -0.4, 0.3));
    check(&spec, &world, |azimuth, elevation| {
        let floor = (elevation < 0.0).then(|| -1.0 / libm::sin(elevation));
        // In the plane, a circle; then along the slope.
        let flat = sphere(DVec3::X * 2.0, 0.5, direction(azimuth, 0.0));
        let column = flat.map(|distance| distance / libm::cos(elevation));
        let nearest = floor.into_iter().chain(column).fold(f64::INFINITY, f64::min);
        (nearest < 30.0).then_some(nearest)
    });
}

#[test]
fn angles_run_from_end_to_end() {
    let full = spec(axis(360, 0.0, 6.25), axis(1, 0.0, 0.0));
    let beams = *lidar(&full).beams();
    let [across, up] = beams.steps_rad(periplus_sensors::Quirks::NONE);
    assert_eq!((across, up), (6.25 / 359.0, 0.0));
    assert!(beams.steps_rad(periplus_sensors::Quirks::GAZEBO)[1].is_nan());
    let tall = spec(axis(4, 0.0, 1.0), axis(16, -0.1, 0.1));
    assert_eq!(lidar(&tall).beams().middle_row(), 32..36);
    for (samples, angle) in [(4000, 1.0), (1, 0.5)] {
        let one = spec(axis(samples, 0.0, 1.0), axis(1, 0.0, 0.0));
        assert_eq!(lidar(&one).beams().last_rad[0], angle);
    }
}

#[test]
fn out_of_range_is_told_by_rep_117() {
    let ball = |x: f64| {
        let world =
            world(&[(RaycastShape::Sphere { radius_m: 0.02 }, Pose::from_xyz(x, 0.0, 0.0))]);
        ranges(&mut lidar(&spec(axis(1, 0.0, 0.0), axis(1, 0.0, 0.0))), &world, Pose::IDENTITY)[0]
    };
    assert_eq!(ball(0.05), f32::NEG_INFINITY);
    assert!((ball(1.02) - 1.0).abs() < 1e-6);
    assert_eq!(ball(30.5), f32::INFINITY);
}

/// A lidar inside its housing measures beyond it; a mast of the same model is measured; a cable of
/// another link within the minimum range is too near.
#[test]
fn the_own_housing_is_not_seen() {
    let scene = |cable_group: u32| {
        let mut builder = RaycastWorld::builder();
        let own = Tags { group: 1, ..Tags::default() };
        let housing = RaycastShape::Cylinder { radius_m: 0.05, length_m: 0.06 };
        builder.add_shape(&housing, &Pose::IDENTITY, own).unwrap();
        let mast = RaycastShape::Cylinder { radius_m: 0.02, length_m: 1.0 };
        builder.add_shape(&mast, &Pose::from_xyz(-0.3, 0.0, 0.0), own).unwrap();
        let cable = Tags { group: cable_group, ..Tags::default() };
        let thin = RaycastShape::Cylinder { radius_m: 0.01, length_m: 1.0 };
        builder.add_shape(&thin, &Pose::from_xyz(0.0, 0.07, 0.0), cable).unwrap();
        builder.build(1).expect("few shapes")
    };
    let four = spec(axis(5, -std::f64::consts::PI, std::f64::consts::PI), axis(1, 0.0, 0.0));
    let scan = |cable_group| {
        let world = scene(cable_group);
        let view = RayView { own_group: 1, ..RayView::of(&world) };
        let mut lidar = lidar(&four);
        lidar.scan(&view, Sweep::AtOnce(Pose::IDENTITY), &mut Stream::keyed(0, "", 0)).clone()
    };
    let [back, right, ahead, left, _] = scan(2).ranges_m[..] else { panic!() };
    assert!((back - 0.28).abs() < 1e-6, "{back}");
    assert_eq!((right, ahead, left), (f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY));
    assert_eq!(scan(1).ranges_m[3], f32::INFINITY, "a cable of its own model");
}

#[test]
fn intensities_are_those_of_what_was_met() {
    let world = world(&[
        (RaycastShape::Sphere { radius_m: 1.0 }, Pose::from_xyz(3.0, 0.0, 0.0)),
        (RaycastShape::Sphere { radius_m: 1.0 }, Pose::from_xyz(-3.0, 0.0, 0.0)),
    ]);
    let retro = |InstanceId(number)| if number == 0 { 100.0 } else { 2000.0 };
    let view = RayView { retro: Some(&retro), ..RayView::of(&world) };
    let mut lidar = lidar(&spec(axis(3, 0.0, std::f64::consts::PI), axis(1, 0.0, 0.0)));
    let scan = lidar.scan(&view, Sweep::AtOnce(Pose::IDENTITY), &mut Stream::keyed(0, "", 0));
    assert_eq!(scan.intensities, [100.0, 0.0, 2000.0]);
    assert_eq!(scan.ranges_m[1], f32::INFINITY);
}

#[test]
fn noise_stays_within_the_range_and_leaves_infinities() {
    let noise =
        NoiseSpec { kind: NoiseKind::Gaussian, mean: 0.05, stddev: 0.1, ..NoiseSpec::default() };
    let spec = periplus_scene::LidarSpec { noise, ..flat(20_000) };
    let wall = RaycastShape::Plane { size_m: None };
    let ahead = turned([2.0, 0.0, 0.0], 0.0, std::f64::consts::FRAC_PI_2, 0.0);
    let world = world(&[(wall, ahead)]);
    let mut lidar = lidar(&spec);
    let noisy = ranges(&mut lidar, &world, Pose::IDENTITY);
    let mut off = Vec::new();
    for (range, [azimuth, _]) in noisy.iter().zip(lidar.beams().range_angles()) {
        let distance = 2.0 / libm::cos(azimuth);
        if distance > 0.0 && distance < 29.0 {
            off.push(f64::from(*range) - distance);
        } else if !(0.0..=30.0).contains(&distance) {
            assert_eq!(*range, f32::INFINITY);
        }
        assert!(*range == f32::INFINITY || (0.1..=30.0).contains(range));
    }
    let count = off.len() as f64;
    let mean = off.iter().sum::<f64>() / count;
    let sigma = (off.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count).sqrt();
    assert!((mean - 0.05).abs() < 0.005 && (sigma - 0.1).abs() < 0.005, "{mean} {sigma}");
}

/// Two rays at ±45 degrees to a wall 1 m ahead, both 1.414 m, and three ranges of them: the middle
/// one is interpolated, not the distance of the wall.
#[test]
fn resolution_makes_ranges_between_rays() {
    let quarter = std::f64::consts::FRAC_PI_4;
    let horizontal = ScanAxis { resolution: 1.5, ..axis(2, -quarter, quarter) };
    let wall = turned([1.0, 0.0, 0.0], 0.0, std::f64::consts::FRAC_PI_2, 0.0);
    let world = world(&[(RaycastShape::Plane { size_m: None }, wall)]);
    let mut lidar = lidar(&spec(horizontal, axis(1, 0.0, 0.0)));
    let scan = ranges(&mut lidar, &world, Pose::IDENTITY);
    assert_eq!(scan.len(), 3);
    assert!(scan.iter().all(|range| (range - 2_f32.sqrt()).abs() < 1e-6), "{scan:?}");
    let nothing = ranges(&mut lidar, &self::world(&[]), Pose::IDENTITY);
    assert_eq!(nothing, [f32::INFINITY; 3]);
}

/// A wall 2 m ahead, and a sensor that drives 0.1 m towards it during the scan.
#[test]
fn a_rolling_scan_is_distorted_by_motion() {
    let wall = turned([2.0, 0.0, 0.0], 0.0, std::f64::consts::FRAC_PI_2, 0.0);
    let world = world(&[(RaycastShape::Plane { size_m: None }, wall)]);
    let mut lidar = lidar(&spec(axis(11, 0.0, 0.0), axis(1, 0.0, 0.0)));
    let path = [(0.0, Pose::IDENTITY), (1.0, Pose::from_xyz(0.1, 0.0, 0.0))];
    let view = RayView::of(&world);
    let scan = lidar.scan(&view, Sweep::Moving(&path), &mut Stream::keyed(0, "", 0));
    for (column, range) in scan.ranges_m.iter().enumerate() {
        assert!((range - (2.0 - 0.01 * column as f32)).abs() < 1e-6, "{column}: {range}");
    }
}

#[test]
fn impossible_lidars_are_told() {
    let bad = |change: fn(&mut periplus_scene::LidarSpec)| {
        let mut spec = flat(360);
        change(&mut spec);
        LidarSensor::new(&spec, &Streams::new(0, "x")).err().unwrap().code
    };
    assert_eq!(bad(|spec| spec.horizontal.samples = 0), "out-of-range");
    assert_eq!(bad(|spec| spec.vertical.resolution = f64::NAN), "out-of-range");
    assert_eq!(bad(|spec| spec.horizontal.min_angle_rad = f64::NAN), "out-of-range");
    assert_eq!(bad(|spec| spec.range_max_m = 0.05), "out-of-range");
    assert_eq!(bad(|spec| spec.range_min_m = f64::NAN), "out-of-range");
    assert_eq!(bad(|spec| spec.horizontal.resolution = 1e12), "too-many-beams");
    assert_eq!(bad(|spec| spec.horizontal.samples = u32::MAX), "too-many-beams");
}

/// Any number of threads gives the same bits.
#[test]
fn threads_change_nothing() {
    let shapes = [
        (RaycastShape::Sphere { radius_m: 1.0 }, Pose::from_xyz(3.0, 0.5, 0.2)),
        (RaycastShape::Plane { size_m: None }, Pose::from_xyz(0.0, 0.0, -0.5)),
    ];
    let world = world(&shapes);
    let noise = NoiseSpec { kind: NoiseKind::Gaussian, stddev: 0.01, ..NoiseSpec::default() };
    let tall = spec(axis(512, -3.0, 3.0), axis(64, -0.4, 0.4));
    let scan = |threads| {
        let mut lidar = lidar(&periplus_scene::LidarSpec { noise, ..tall.clone() });
        let view = RayView { threads, ..RayView::of(&world) };
        let mut stream = Stream::keyed(9, "lidar", 4);
        lidar.scan(&view, Sweep::AtOnce(Pose::IDENTITY), &mut stream).clone()
    };
    assert_eq!(scan(1), scan(2));
    assert_eq!(scan(1), scan(8));
}

/// A triangle in double precision (Möller and Trumbore 1997).
fn meets(origin: DVec3, direction: DVec3, corners: [DVec3; 3]) -> Option<f64> {
    let [a, b, c] = corners;
    let (one, two) = (b - a, c - a);
    let p = direction.cross(two);
    let det = one.dot(p);
    if det.abs() < 1e-14 {
        return None;
    }
    let s = origin - a;
    let u = s.dot(p) / det;
    let q = s.cross(one);
    let v = direction.dot(q) / det;
    let t = two.dot(q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Random scenes of balls and triangles, from a random pose, against brute force.
    #[test]
    fn any_scene_agrees_with_brute_force(seed: u64) {
        let mut stream = Stream::keyed(seed, "scene", 0);
        let mut draw = |size: f64| DVec3::from_array([0; 3].map(|_| (stream.unit() - 0.5) * size));
        let balls: Vec<DVec3> = (0..8).map(|_| draw(12.0)).collect();
        let corners: Vec<DVec3> = (0..60).flat_map(|_| {
            let middle = draw(12.0);
            [middle + draw(3.0), middle + draw(3.0), middle + draw(3.0)]
        }).collect();
        let mut builder = RaycastWorld::builder();
        for ball in &balls {
            let pose = Pose { translation: *ball, ..Pose::IDENTITY };
            builder.add_shape(&RaycastShape::Sphere { radius_m: 0.4 }, &pose, Tags::default()).unwrap();
        }
        let positions: Vec<[f64; 3]> = corners.iter().map(|corner| corner.to_array()).collect();
        let triangles: Vec<[u32; 3]> = (0..60).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
        builder.add_fixed(&positions, &triangles, &Pose::IDENTITY, Tags::default()).unwrap();
        let world = builder.build(1).unwrap();
        let angles = draw(6.0);
        let pose = turned(draw(4.0).to_array(), angles.x, angles.y / 2.0, angles.z);
        let mut lidar = lidar(&spec(axis(90, -3.0, 3.0), axis(8, -0.5, 0.5)));
        let measured = ranges(&mut lidar, &world, pose);
        let origin = pose.translation;
        let nearest = |way: DVec3| {
            let round = balls.iter().filter_map(|&ball| {
                let middle = ball - origin;
                if middle.length() < 0.4 {
                    // From inside, the far wall.
                    let along = middle.dot(way);
                    return Some(along + (along * along - middle.length_squared() + 0.16).sqrt());
                }
                sphere(middle, 0.4, way)
            });
            let plane = corners.chunks(3).filter_map(|c| meets(origin, way, [c[0], c[1], c[2]]));
            let nearest = round.chain(plane).filter(|d| *d >= 0.1).fold(f64::INFINITY, f64::min);
            if nearest >= 30.0 { f64::INFINITY } else { nearest }
        };
        for (measured, direction) in measured.iter().zip(lidar.beams().range_directions()) {
            if measured.is_infinite() && *measured < 0.0 {
                continue;
            }
            let (measured, way) = (f64::from(*measured), pose.rotation * direction);
            let error = nearest(way);
            if measured == error || (measured - error).abs() < EXACT_M {
                continue;
            }
            // Along an edge, or nearly along a face, it may be what a neighbour meets, or lie between
            // what neighbours meet, that passes 10 micrometres beside, and as much for each metre.
            let beside = 1e-5 * (1.0 + 1.0 / measured);
            let around = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| {
                [-beside, beside].map(|off| nearest((way + axis * off).normalize()))
            });
            let (low, high) = around.fold((error, error), |(low, high), d| (low.min(d), high.max(d)));
            let is_between = low - EXACT_M <= measured && measured <= high + EXACT_M;
            prop_assert!(is_between, "{measured} is not within {low} and {high}, but {error}");
        }
    }
}
