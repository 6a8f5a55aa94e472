//! Triangles compared with brute force in double precision, and all kinds of queries with each other.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod support;

use std::sync::Arc;

use periplus_geometry::{DVec3, Pose, Rpy, Stream};
use periplus_raycast::{
    Filter, Heightfield, Hit, Ray, RaycastShape, RaycastWorld, Tags, TriangleMesh,
};
use proptest::prelude::*;
use support::{Solid, fixed, unit};

/// Nearest distances to slightly smaller and to slightly larger triangles.
fn brute_force(solid: &Solid, ray: &Ray, grow: f64) -> f64 {
    let mut nearest = f64::INFINITY;
    for triangle in &solid.triangles {
        let [a, b, c] =
            triangle.map(|corner| DVec3::from_array(solid.positions_m[corner as usize]));
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - ray.origin_m) / normal.dot(ray.direction);
        let p = ray.at(t);
        let size = [a.distance(b), b.distance(c), c.distance(a)].into_iter().fold(0.0, f64::max);
        let off = |p0: DVec3, p1: DVec3| {
            normal.cross(p1 - p0).normalize_or_zero().dot(p - p0) + grow * size.max(p.length())
        };
        let inside = off(a, b) >= 0.0 && off(b, c) >= 0.0 && off(c, a) >= 0.0;
        // Seen edge on a triangle may or may not be met.
        let flat = normal.dot(ray.direction).abs() < 1e-4 * normal.length();
        if t >= 0.0 && inside && !(flat && grow < 0.0) {
            nearest = nearest.min(t);
        }
    }
    nearest
}

fn soup(count: usize, seed: u64) -> Solid {
    let mut stream = Stream::keyed(seed, "soup", 0);
    let mut solid = Solid::default();
    for number in 0..count {
        let middle = unit(&mut stream) * 5.0 * stream.unit();
        let size = if number % 10 == 0 { 4.0 } else { 0.5 };
        let start = u32::try_from(solid.positions_m.len()).unwrap();
        for _ in 0..3 {
            let corner = middle + unit(&mut stream) * size * stream.unit();
            solid.positions_m.push(corner.to_array());
        }
        solid.triangles.push([start, start + 1, start + 2]);
    }
    solid
}

fn ray(stream: &mut Stream) -> Ray {
    let origin = unit(stream) * 8.0 * stream.unit();
    let mut direction = unit(stream);
    // Many real rays are level or upright.
    let kind = stream.bits() % 8;
    if kind < 3 {
        direction[usize::try_from(kind).unwrap()] = 0.0;
    }
    Ray::new(origin, direction.normalize())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn as_brute_force_finds_them(count in 1_usize..400, seed in any::<u64>()) {
        let solid = soup(count, seed);
        let world = fixed(&solid);
        let mut stream = Stream::keyed(seed, "rays", 0);
        for _ in 0..60 {
            let ray = ray(&mut stream);
            let ours = world.cast(&ray, Filter::default());
            let distance = ours.map_or(f64::INFINITY, |hit| hit.distance_m);
            let (low, high) = (brute_force(&solid, &ray, 1e-5), brute_force(&solid, &ray, -1e-5));
            prop_assert!(low - 1e-3 <= distance && (distance <= high + 1e-3 || high.is_infinite()),
                "{distance} not in {low}..{high}");
            if low == high && low.is_finite() {
                prop_assert!((distance - low).abs() < 2e-4);
            }
            prop_assert_eq!(world.occluded(&ray, Filter::default()), ours.is_some());
            if let Some(hit) = ours {
                prop_assert!(hit.normal.dot(ray.direction) <= 0.0);
                let mut short = ray;
                short.max_m = hit.distance_m;
                prop_assert_eq!(world.cast(&short, Filter::default()), ours);
            }
        }
    }

    /// Single rays, batches, packets, and any number of threads give the same bits.
    #[test]
    fn many_rays_equal_single_rays(seed in any::<u64>(), columns in 1_usize..40, narrow in any::<bool>()) {
        let world = everything(seed);
        let mut stream = Stream::keyed(seed, "fan", 0);
        let eye = unit(&mut stream) * 3.0;
        let ahead = unit(&mut stream);
        let mut rays: Vec<Ray> = (0..20 * columns).map(|_| {
            let width = if narrow { 0.05 } else { 1.0 };
            Ray::new(eye, (ahead + unit(&mut stream) * width).normalize_or(DVec3::X))
        }).collect();
        // Some that break the row.
        for _ in 0..3 {
            let place = usize::try_from(stream.bits() % rays.len() as u64).unwrap();
            rays[place] = ray(&mut stream);
            rays[(place + 5) % (20 * columns)].max_m = 2.0;
            rays[(place + 7) % (20 * columns)].min_m = 2.0;
        }
        rays[0].direction = DVec3::ZERO;
        for filter in [Filter::default(), Filter { mask: 1, except_group: 3 }] {
            let to_f32: Vec<Option<Hit>> = rays.iter().map(|ray| world.cast(ray, filter)).collect();
            let mut hits = vec![None; rays.len()];
            world.hits_grid(&rays, columns, filter, 1, &mut hits);
            prop_assert_eq!(&hits, &to_f32);
            let mut distances = vec![0.0; rays.len()];
            world.cast_batch(&rays, filter, 2, &mut distances);
            #[expect(clippy::cast_possible_truncation)]
            let expected: Vec<f32> = to_f32
                .iter()
                .map(|hit| hit.map_or(f32::INFINITY, |hit| hit.distance_m as f32))
                .collect();
            prop_assert_eq!(&distances, &expected);
        }
    }
}

/// Fixed triangles, meshes, shapes, height maps, overlapping each other.
fn everything(seed: u64) -> RaycastWorld {
    let mut stream = Stream::keyed(seed, "world", 0);
    let mut builder = RaycastWorld::builder();
    let mut place = || {
        let rotate_into_world =
            Rpy { roll: stream.unit(), pitch: stream.unit(), yaw: 6.0 * stream.unit() };
        let tags = Tags {
            mask: u32::try_from(stream.bits() % 4).unwrap(),
            group: u32::try_from(stream.bits() % 4).unwrap(),
        };
        (Pose::from_xyz_rpy((unit(&mut stream) * 3.0).to_array(), rotate_into_world), tags)
    };
    for number in 0..3 {
        let solid = soup(150, seed ^ number);
        let (pose, tags) = place();
        builder.add_fixed(&solid.positions_m, &solid.triangles, &pose, tags).unwrap();
        let mesh = TriangleMesh::new(&solid.positions_m, &solid.triangles, 1).unwrap();
        let (pose, tags) = place();
        builder.add_mesh(Arc::new(mesh), &pose, tags).unwrap();
    }
    for shape in [
        RaycastShape::Plane { size_m: None },
        RaycastShape::Plane { size_m: Some([1.0, 2.0]) },
        RaycastShape::Box { size_m: DVec3::new(1.0, 2.0, 0.3) },
        RaycastShape::Sphere { radius_m: 0.5 },
        RaycastShape::Cylinder { radius_m: 0.5, length_m: 1.0 },
        RaycastShape::Capsule { radius_m: 0.3, length_m: 1.0 },
        RaycastShape::Cone { radius_m: 0.5, length_m: 1.0 },
        RaycastShape::Ellipsoid { radii_m: DVec3::new(0.2, 0.5, 1.0) },
    ] {
        let (pose, tags) = place();
        builder.add_shape(&shape, &pose, tags).unwrap();
    }
    let heights = (0..99).map(|n| f64::from(n % 7) * 0.05).collect();
    let ground = Heightfield::new(11, 9, [4.0, 3.0], heights).unwrap();
    let (pose, tags) = place();
    builder.add_heightfield(Arc::new(ground), &pose, tags).unwrap();
    builder.build(1).unwrap()
}

#[test]
fn the_lower_numbers_win_ties() {
    let sheet = [[1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0]];
    let mut builder = RaycastWorld::builder();
    let shape = RaycastShape::Box { size_m: DVec3::new(2.0, 2.0, 2.0) };
    let mesh = TriangleMesh::new(&sheet, &[[0, 1, 2], [0, 2, 3], [0, 1, 2]], 1).unwrap();
    let there = Pose::from_xyz(2.0, 0.0, 0.0);
    let mut ids = vec![
        builder.add_mesh(Arc::new(mesh), &Pose::IDENTITY, Tags { mask: 1, group: 0 }).unwrap(),
    ];
    ids.push(builder.add_shape(&shape, &there, Tags { mask: 3, group: 0 }).unwrap());
    let corners = [[0, 1, 2], [0, 2, 3], [0, 1, 2]];
    ids.push(
        builder.add_fixed(&sheet, &corners, &Pose::IDENTITY, Tags { mask: 4, group: 0 }).unwrap(),
    );
    ids.push(builder.add_fixed(&sheet, &corners, &Pose::IDENTITY, Tags::default()).unwrap());
    let world = builder.build(1).unwrap();
    // On the diagonal, and below it: triangles 0 and 2 are the same.
    for (y, z) in [(0.0, 0.0), (0.5, -0.25)] {
        for (mask, expected) in [(1, ids[0]), (2, ids[1]), (4, ids[2]), (8, ids[3])] {
            let ray = Ray::new(DVec3::new(0.0, y, z), DVec3::X);
            let hit = world.cast(&ray, Filter { mask, except_group: 0 }).unwrap();
            assert_eq!((hit.instance, hit.primitive, hit.distance_m), (expected, 0, 1.0));
        }
    }
}

#[test]
fn rays_do_not_depend_on_threads() {
    let world = everything(7);
    let mut stream = Stream::keyed(7, "fan", 0);
    let rays: Vec<Ray> = (0..20_011)
        .map(|n| {
            if n % 100 == 0 {
                return ray(&mut stream);
            }
            let (eye, slope) = (f64::from(n / 5000), f64::from(n % 100) * 0.01);
            Ray::new(DVec3::new(eye - 2.0, 0.0, 0.5), DVec3::new(1.0, slope, 0.1).normalize())
        })
        .collect();
    let to_f32: Vec<_> = rays.iter().map(|ray| world.cast(ray, Filter::default())).collect();
    for (threads, columns) in [(1, 100), (2, 100), (3, 7), (64, 20_011), (0, 1_000_000)] {
        let mut hits = vec![None; rays.len()];
        world.hits_grid(&rays, columns, Filter::default(), threads, &mut hits);
        assert!(hits == to_f32, "{threads} threads, {columns} columns");
    }
}

/// With many triangles, rays of different origins are cast alternately.
#[test]
fn rays_in_turns_equal_single_rays() {
    let solid = soup(60_000, 6);
    let (p, t) = (&solid.positions_m, &solid.triangles);
    let mut builder = RaycastWorld::builder();
    builder.add_fixed(p, t, &Pose::IDENTITY, Tags { mask: 1, group: 3 }).unwrap();
    let below = Pose::from_xyz(0.0, 0.0, -4.0);
    builder.add_shape(&RaycastShape::Plane { size_m: None }, &below, Tags::default()).unwrap();
    let ball = RaycastShape::Sphere { radius_m: 3.0 };
    builder.add_shape(&ball, &Pose::from_xyz(5.0, 0.0, 0.0), Tags::default()).unwrap();
    let world = builder.build(1).unwrap();
    let mut stream = Stream::keyed(6, "rays", 0);
    let mut rays: Vec<Ray> = (0..5003).map(|_| ray(&mut stream)).collect();
    for (number, ray) in rays.iter_mut().enumerate() {
        match number % 50 {
            0 => ray.direction = DVec3::ZERO,
            1 => ray.origin_m.x = f64::NAN,
            2 => ray.max_m = 0.2,
            3 => ray.min_m = 0.5,
            _ => {}
        }
    }
    for (filter, count) in [
        (Filter::default(), 5003),
        (Filter::default(), 5),
        (Filter { mask: 1, except_group: 3 }, 300),
    ] {
        let rays = &rays[..count];
        let to_f32: Vec<_> = rays.iter().map(|ray| world.cast(ray, filter)).collect();
        let mut hits = vec![None; count];
        world.hits_grid(rays, count, filter, 1, &mut hits);
        assert!(hits == to_f32, "{count} rays, {filter:?}");
    }
}

#[test]
fn trees_do_not_depend_on_threads() {
    let solid = soup(60_000, 5);
    let worlds = [1, 2, 7].map(|threads| {
        let mut builder = RaycastWorld::builder();
        let (p, t) = (&solid.positions_m, &solid.triangles);
        builder.add_fixed(p, t, &Pose::IDENTITY, Tags::default()).unwrap();
        builder.build(threads).unwrap()
    });
    let mut stream = Stream::keyed(5, "rays", 0);
    assert_eq!(worlds[0].size_bytes(), worlds[1].size_bytes());
    for _ in 0..2000 {
        let ray = ray(&mut stream);
        let hits = worlds.each_ref().map(|world| world.cast(&ray, Filter::default()));
        assert_eq!(hits[0], hits[1]);
        assert_eq!(hits[0], hits[2]);
    }
}

#[test]
fn equal_triangles_by_the_thousand_still_make_a_tree() {
    let mut solid = Solid {
        positions_m: vec![[1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [1.0, 0.0, 1.0]],
        ..Solid::default()
    };
    solid.triangles = vec![[0, 1, 2]; 5000];
    let hit = fixed(&solid).cast(&Ray::new(DVec3::ZERO, DVec3::X), Filter::default()).unwrap();
    assert_eq!((hit.distance_m, hit.primitive), (1.0, 0));
    // Each twice the one before: splits that take off one at a time.
    let mut solid = Solid::default();
    for number in 0..120_u32 {
        let size = libm::pow(2f64, f64::from(i32::try_from(number).unwrap() / 4 - 15));
        for (x, y) in [(1.0, 0.0), (2.0, 0.0), (1.0, 1.0)] {
            solid.positions_m.push([x * size, y * size, size]);
        }
        solid.triangles.push([3 * number, 3 * number + 1, 3 * number + 2]);
    }
    let world = fixed(&solid);
    let ray = Ray::new(DVec3::ZERO, DVec3::new(1.2, 0.2, 1.0));
    assert!(world.cast(&ray, Filter::default()).is_some());
}
