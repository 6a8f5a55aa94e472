//! Shapes with intersections in closed form.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_raycast::{Filter, Hit, InstanceError, Ray, RaycastShape, RaycastWorld, Tags};

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn world(shape: &RaycastShape) -> RaycastWorld {
    let mut builder = RaycastWorld::builder();
    builder.add_shape(shape, &Pose::IDENTITY, Tags::default()).unwrap();
    builder.build(1).unwrap()
}

fn cast(shape: &RaycastShape, origin: DVec3, direction: DVec3) -> Option<Hit> {
    world(shape).cast(&Ray::new(origin, direction), Filter::default())
}

/// Distance, face and normal.
#[track_caller]
fn check(
    shape: &RaycastShape,
    origin: DVec3,
    direction: DVec3,
    distance: f64,
    face: u32,
    normal: DVec3,
) {
    let hit = cast(shape, origin, direction).expect("a hit");
    assert!((hit.distance_m - distance).abs() <= 1e-12 * (1.0 + distance), "{hit:?}");
    assert_eq!(hit.primitive, face, "{hit:?}");
    assert!(hit.normal.distance(normal) < 1e-9, "{hit:?}");
}

const BOX: RaycastShape = RaycastShape::Box { size_m: DVec3::new(2.0, 4.0, 6.0) };
const BALL: RaycastShape = RaycastShape::Sphere { radius_m: 0.1 };
const CAN: RaycastShape = RaycastShape::Cylinder { radius_m: 1.0, length_m: 2.0 };
const PILL: RaycastShape = RaycastShape::Capsule { radius_m: 1.0, length_m: 2.0 };
const HAT: RaycastShape = RaycastShape::Cone { radius_m: 1.0, length_m: 2.0 };
const EGG: RaycastShape = RaycastShape::Ellipsoid { radii_m: DVec3::new(1.0, 2.0, 3.0) };

#[test]
fn planes() {
    let endless = RaycastShape::Plane { size_m: None };
    check(&endless, v(0.0, 0.0, 2.0), DVec3::NEG_Z, 2.0, 0, DVec3::Z);
    check(&endless, v(1e6, 0.0, -2.0), DVec3::Z, 2.0, 0, DVec3::NEG_Z);
    assert_eq!(cast(&endless, v(0.0, 0.0, 2.0), DVec3::X), None);
    let small = RaycastShape::Plane { size_m: Some([2.0, 4.0]) };
    check(&small, v(0.5, 1.5, 2.0), DVec3::NEG_Z, 2.0, 0, DVec3::Z);
    check(&small, v(1.0, 2.0, 2.0), DVec3::NEG_Z, 2.0, 0, DVec3::Z);
    assert_eq!(cast(&small, v(1.1, 0.0, 2.0), DVec3::NEG_Z), None);
}

#[test]
fn boxes() {
    check(&BOX, v(-3.0, 0.5, 0.5), DVec3::X, 2.0, 0, DVec3::NEG_X);
    check(&BOX, v(3.0, 0.5, 0.5), DVec3::NEG_X, 2.0, 1, DVec3::X);
    check(&BOX, v(0.0, 5.0, 0.5), DVec3::NEG_Y, 3.0, 3, DVec3::Y);
    check(&BOX, v(0.0, 0.0, -5.0), DVec3::Z, 2.0, 4, DVec3::NEG_Z);
    assert_eq!(cast(&BOX, v(-3.0, 2.1, 0.0), DVec3::X), None);
    // Along a face, and into a corner.
    assert!(cast(&BOX, v(-3.0, 2.0, 0.0), DVec3::X).is_some());
    assert!(cast(&BOX, v(-2.0, -3.0, -4.0), v(1.0, 1.0, 1.0).normalize()).is_some());
}

#[test]
fn round_shapes() {
    check(&BALL, v(-1.0, 0.0, 0.0), DVec3::X, 0.9, 0, DVec3::NEG_X);
    check(&CAN, v(-3.0, 0.0, 0.5), DVec3::X, 2.0, 0, DVec3::NEG_X);
    check(&CAN, v(0.5, 0.0, 3.0), DVec3::NEG_Z, 2.0, 2, DVec3::Z);
    check(&CAN, v(0.5, 0.0, -3.0), DVec3::Z, 2.0, 1, DVec3::NEG_Z);
    assert_eq!(cast(&CAN, v(-3.0, 0.0, 1.1), DVec3::X), None);
    check(&PILL, v(-3.0, 0.0, 0.5), DVec3::X, 2.0, 0, DVec3::NEG_X);
    check(&PILL, v(0.0, 0.0, 5.0), DVec3::NEG_Z, 3.0, 2, DVec3::Z);
    check(&PILL, v(0.0, 0.0, -5.0), DVec3::Z, 3.0, 1, DVec3::NEG_Z);
    // Half way up the dome of radius 1 about z = 1.
    check(&PILL, v(-3.0, 0.0, 1.6), DVec3::X, 2.2, 2, v(-0.8, 0.0, 0.6));
    assert_eq!(cast(&PILL, v(-3.0, 0.9, 1.9), DVec3::X), None);
    check(&EGG, v(-3.0, 0.0, 0.0), DVec3::X, 2.0, 0, DVec3::NEG_X);
    check(&EGG, v(0.0, 5.0, 0.0), DVec3::NEG_Y, 3.0, 0, DVec3::Y);
    check(&EGG, v(0.0, 0.0, 5.0), DVec3::NEG_Z, 2.0, 0, DVec3::Z);
}

#[test]
fn cones() {
    let slope = v(-2.0, 0.0, 1.0).normalize();
    check(&HAT, v(-3.0, 0.0, 0.0), DVec3::X, 2.5, 0, slope);
    check(&HAT, v(0.0, 0.0, 5.0), DVec3::NEG_Z, 4.0, 0, DVec3::Z);
    check(&HAT, v(0.5, 0.0, -5.0), DVec3::Z, 4.0, 1, DVec3::NEG_Z);
    // Up through the base and out of the side, seen from inside.
    check(&HAT, v(0.5, 0.0, -0.5), DVec3::Z, 0.5, 0, -v(2.0, 0.0, 1.0).normalize());
    // Nothing of the mirror image above the tip.
    assert_eq!(cast(&HAT, v(-3.0, 0.0, 1.5), DVec3::X), None);
    assert_eq!(cast(&HAT, v(0.5, 0.0, 3.0), DVec3::Z), None);
    check(&HAT, v(0.5, 0.0, 3.0), DVec3::NEG_Z, 3.0, 0, v(2.0, 0.0, 1.0).normalize());
}

#[test]
fn from_inside_the_far_wall_is_hit() {
    check(&BOX, DVec3::ZERO, DVec3::X, 1.0, 1, DVec3::NEG_X);
    check(&BALL, DVec3::ZERO, DVec3::Y, 0.1, 0, DVec3::NEG_Y);
    check(&CAN, DVec3::ZERO, DVec3::Z, 1.0, 2, DVec3::NEG_Z);
    check(&PILL, DVec3::ZERO, DVec3::Z, 2.0, 2, DVec3::NEG_Z);
    check(&HAT, DVec3::ZERO, DVec3::NEG_Z, 1.0, 1, DVec3::Z);
    check(&EGG, DVec3::ZERO, DVec3::Z, 3.0, 0, DVec3::NEG_Z);
}

#[test]
fn ranges_count() {
    let world = world(&BALL);
    let mut ray = Ray::new(v(-1.0, 0.0, 0.0), DVec3::X);
    let mut distance = |min_m, max_m| {
        (ray.min_m, ray.max_m) = (min_m, max_m);
        assert_eq!(
            world.occluded(&ray, Filter::default()),
            world.cast(&ray, Filter::default()).is_some()
        );
        world.cast(&ray, Filter::default()).map(|hit| (hit.distance_m * 1e9).round() / 1e9)
    };
    assert_eq!(distance(0.0, 0.90001), Some(0.9));
    assert_eq!(distance(0.0, 0.8999), None);
    assert_eq!(distance(0.95, 9.0), Some(1.1));
    assert_eq!(distance(1.2, 9.0), None);
    assert_eq!(distance(2.0, 1.0), None);
    assert_eq!(distance(f64::NAN, 1.0), Some(0.9));
}

#[test]
fn no_size_no_shape_and_flat_is_fine() {
    let mut builder = RaycastWorld::builder();
    let mut add = |shape: RaycastShape| builder.add_shape(&shape, &Pose::IDENTITY, Tags::default());
    for size in [f64::NAN, -1.0, f64::INFINITY, 0.0] {
        assert!(matches!(
            add(RaycastShape::Sphere { radius_m: size }),
            Err(InstanceError::Size(_))
        ));
        let cone = RaycastShape::Cone { radius_m: 1.0, length_m: size };
        assert!(matches!(add(cone), Err(InstanceError::Size(_))));
    }
    let sheet = RaycastShape::Box { size_m: v(0.0, 1.0, 1.0) };
    check(&sheet, v(-1.0, 0.2, 0.2), DVec3::X, 1.0, 0, DVec3::NEG_X);
    let coin = RaycastShape::Cylinder { radius_m: 1.0, length_m: 0.0 };
    assert_eq!(cast(&coin, v(0.5, 0.0, 1.0), DVec3::NEG_Z).map(|hit| hit.distance_m), Some(1.0));
    let ball = RaycastShape::Capsule { radius_m: 1.0, length_m: 0.0 };
    assert_eq!(cast(&ball, v(-2.0, 0.0, 0.0), DVec3::X).map(|hit| hit.distance_m), Some(1.0));
}

#[test]
fn senseless_rays_hit_nothing() {
    let world = world(&BOX);
    for ray in [
        Ray::new(v(f64::NAN, 0.0, 0.0), DVec3::X),
        Ray::new(DVec3::ZERO, DVec3::ZERO),
        Ray::new(DVec3::ZERO, v(f64::INFINITY, 0.0, 0.0)),
        Ray::new(DVec3::splat(1e300), DVec3::X),
    ] {
        assert_eq!(world.cast(&ray, Filter::default()), None);
    }
}

/// A chord of the unit circle at height 1 - e is 2 √(e (2 - e)) long: exact in f64, while
/// `b² - ac` loses everything from e = 1e-16 on, and half the digits long before.
#[test]
fn near_tangents_keep_their_digits() {
    for exponent in 1..=52 {
        let height = 1.0 - libm::pow(2f64, f64::from(-exponent));
        let chord = ((1.0 - height) * (1.0 + height)).sqrt();
        for far in [2.0, 1000.0, 1e6] {
            let expected = far - chord;
            let one = |shape: &RaycastShape, origin: DVec3, what: &str| {
                let hit = cast(shape, origin, DVec3::X).expect(what);
                let off = (hit.distance_m - expected).abs();
                assert!(off < 1e-12 * far, "{what} at {height}: off by {off}");
            };
            let wide = RaycastShape::Cylinder { radius_m: 1.0, length_m: 1.0 };
            one(&RaycastShape::Sphere { radius_m: 1.0 }, v(-far, height, 0.0), "sphere");
            one(&wide, v(-far, height, 0.1), "cylinder");
            one(&PILL, v(-far, 0.0, 1.0 + height), "capsule");
            one(&EGG, v(-far, 2.0 * height, 0.0), "ellipsoid");
            let tall = RaycastShape::Ellipsoid { radii_m: v(1.0, 2.0, 4.0) };
            one(&tall, v(-far, 0.0, 4.0 * height), "ellipsoid upright");
        }
    }
    let ball = RaycastShape::Sphere { radius_m: 1.0 };
    assert!(cast(&ball, v(-1e6, 1.0 + libm::pow(2f64, -52.0), 0.0), DVec3::X).is_none());
}

#[test]
fn poses_move_shapes() {
    let mut builder = RaycastWorld::builder();
    let quarter = Rpy { roll: 0.0, pitch: std::f64::consts::FRAC_PI_2, yaw: 0.0 };
    let pose = Pose::from_xyz_rpy([5.0, 0.0, 0.0], quarter);
    let id = builder.add_shape(&CAN, &pose, Tags::default()).unwrap();
    let mut world = builder.build(1).unwrap();
    let ray = Ray::new(DVec3::ZERO, DVec3::X);
    let hit = world.cast(&ray, Filter::default()).unwrap();
    assert!((hit.distance_m - 4.0).abs() < 1e-12 && hit.normal.distance(DVec3::NEG_X) < 1e-12);
    world.move_to(&[(id, Pose::from_xyz(10.0, 0.0, 0.0))]).unwrap();
    let hit = world.cast(&ray, Filter::default()).unwrap();
    assert_eq!((hit.distance_m, hit.primitive), (9.0, 0));
}

#[test]
fn masks_and_groups_hide() {
    let mut builder = RaycastWorld::builder();
    let mut ball = |x: f64, mask: u32, group: u32| {
        builder.add_shape(&BALL, &Pose::from_xyz(x, 0.0, 0.0), Tags { mask, group }).unwrap()
    };
    let (own, low, high) = (ball(1.0, u32::MAX, 7), ball(2.0, 1, 0), ball(3.0, 2, 0));
    let wall = [[4.0, -1.0, -1.0], [4.0, 1.0, -1.0], [4.0, 0.0, 1.0]];
    let tags = Tags { mask: 4, group: 7 };
    let wall = builder.add_fixed(&wall, &[[0, 1, 2]], &Pose::IDENTITY, tags).unwrap();
    let world = builder.build(1).unwrap();
    let seen = |mask, except_group| {
        let ray = Ray::new(DVec3::ZERO, DVec3::X);
        world.cast(&ray, Filter { mask, except_group }).map(|hit| hit.instance)
    };
    assert_eq!(seen(u32::MAX, 0), Some(own));
    assert_eq!(seen(u32::MAX, 7), Some(low));
    assert_eq!(seen(2, 7), Some(high));
    assert_eq!(seen(4, 0), Some(own));
    assert_eq!(seen(4, 7), None);
    assert_eq!(seen(4, 8), Some(own));
    assert_eq!(seen(0, 0), None);
    let _ = wall;
}
