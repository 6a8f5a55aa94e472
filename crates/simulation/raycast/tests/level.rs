//! Level scans, which are traced through separate trees: the same bits as of single rays.

use periplus_geometry::{DVec3, Pose, Stream};
use periplus_raycast::{Filter, Hit, Ray, RaycastWorld, Tags};
use proptest::prelude::*;

/// A floor, and axis-aligned boxes on it whose faces and edges are at round heights, as scans like to
/// graze them; or loose triangles in space.
fn world(seed: u64, count: u32, loose: bool) -> RaycastWorld {
    let mut stream = Stream::keyed(seed, "level", 0);
    let mut builder = RaycastWorld::builder();
    let (tags, pose) = (Tags::default(), Pose::IDENTITY);
    let floor = [[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [9.0, 9.0, 0.0], [-9.0, 9.0, 0.0]];
    builder.add_fixed(&floor, &[[0, 1, 2], [0, 2, 3]], &pose, tags).expect("sound");
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let mut number = |size: f64| ((stream.unit() - 0.5) * size * 10.0).round() / 10.0;
        let [x, y, z] = [number(16.0), number(16.0), number(1.0)];
        let first = u32::try_from(positions.len()).expect("sound");
        if loose {
            for _ in 0..3 {
                positions.push([x + number(3.0), y + number(3.0), z + number(1.0)]);
            }
            triangles.push([first, first + 1, first + 2]);
            continue;
        }
        let half = [number(1.0).abs() + 0.1, number(1.0).abs() + 0.1, number(0.8).abs() + 0.1];
        for corner in 0..8 {
            let side = |axis: usize| if corner >> axis & 1 == 0 { -half[axis] } else { half[axis] };
            positions.push([x + side(0), y + side(1), z + side(2)]);
        }
        for [a, b, c, d] in
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
        {
            triangles.push([first + a, first + b, first + c]);
            triangles.push([first + a, first + c, first + d]);
        }
    }
    builder.add_fixed(&positions, &triangles, &pose, tags).expect("sound");
    builder.build(1).expect("sound")
}

/// Fans of `beams` from some poses at a height, the first along the x axis, each raised by `rise`.
fn fans(seed: u64, height_m: f64, beams: u32, rise: f64) -> Vec<Ray> {
    let mut stream = Stream::keyed(seed, "fans", 0);
    let mut rays = Vec::new();
    for pose in 0..6 {
        let mut number = || (stream.unit() - 0.5) * if pose == 5 { 60.0 } else { 18.0 };
        let origin = DVec3::new(number(), number(), height_m);
        for beam in 0..beams {
            let angle = f64::from(beam) * std::f64::consts::TAU / f64::from(beams);
            let ray = Ray::new(origin, DVec3::new(libm::cos(angle), libm::sin(angle), rise));
            rays.push(Ray { max_m: if beam % 11 == 10 { 3.0 } else { ray.max_m }, ..ray });
        }
    }
    rays
}

fn one_by_one(world: &RaycastWorld, rays: &[Ray]) -> Vec<Option<Hit>> {
    rays.iter().map(|ray| world.cast(ray, Filter::default())).collect()
}

fn together(world: &RaycastWorld, rays: &[Ray], threads: usize) -> Vec<Option<Hit>> {
    let mut hits = vec![None; rays.len()];
    world.hits_grid(rays, rays.len(), Filter::default(), threads, &mut hits);
    hits
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn level_scans_equal_single_rays(
        seed in any::<u64>(),
        count in 10_u32..120,
        loose in any::<bool>(),
        height in prop_oneof![Just(0.0), Just(0.2), Just(0.3), Just(-0.1), -0.6..0.6],
        beams in prop_oneof![Just(8_u32), Just(37), Just(90), Just(360)],
        rise in prop_oneof![Just(0.0), Just(-0.0), Just(1e-5), Just(-1e-4), Just(2e-4), Just(0.01)],
    ) {
        let world = world(seed, count, loose);
        let rays = fans(seed, height, beams, rise);
        let wanted = one_by_one(&world, &rays);
        // Twice: once before, once after trees for the slabs are certain to exist.
        prop_assert_eq!(&together(&world, &rays, 1), &wanted);
        prop_assert_eq!(&together(&world, &rays, 1), &wanted);
    }

    /// Slabs change from beam to beam, and other rays lie between.
    #[test]
    fn mixed_heights_equal_single_rays(seed in any::<u64>(), count in 10_u32..80) {
        let world = world(seed, count, false);
        let mut rays = Vec::new();
        for number in 0..12_u32 {
            let rise = if number % 3 == 2 { 0.2 } else { 0.0 };
            rays.extend(fans(seed ^ u64::from(number), f64::from(number % 5) * 0.05, 40, rise));
        }
        let wanted = one_by_one(&world, &rays);
        for _ in 0..3 {
            prop_assert_eq!(&together(&world, &rays, 1), &wanted);
        }
    }
}

#[test]
fn level_scans_do_not_depend_on_threads() {
    let world = world(7, 60, false);
    let rays: Vec<Ray> = (0..10).flat_map(|seed| fans(seed, 0.2, 360, 0.0)).collect();
    let wanted = one_by_one(&world, &rays);
    for threads in [3, 1, 2] {
        assert_eq!(together(&world, &rays, threads), wanted);
    }
}

/// A wall that is removed is no longer in the tree of its slab.
#[test]
fn removed_walls_are_gone_from_level_scans() {
    let wall = |x: f64| [[x, -1.0, -1.0], [x, 1.0, -1.0], [x, 1.0, 1.0], [x, -1.0, 1.0]];
    let (tags, pose) = (Tags::default(), Pose::IDENTITY);
    let mut builder = RaycastWorld::builder();
    let near = builder.add_fixed(&wall(1.0), &[[0, 1, 2], [0, 2, 3]], &pose, tags).expect("sound");
    builder.add_fixed(&wall(2.0), &[[0, 1, 2], [0, 2, 3]], &pose, tags).expect("sound");
    // Above the scan, so that its slab leaves something out.
    for level in 0..100 {
        let z = 3.0 + f64::from(level);
        let roof = [[-9.0, -9.0, z], [9.0, -9.0, z], [9.0, 9.0, z]];
        builder.add_fixed(&roof, &[[0, 1, 2]], &pose, tags).expect("sound");
    }
    let mut world = builder.build(1).expect("sound");
    let rays = [Ray::new(DVec3::ZERO, DVec3::X); 360];
    let mut distances_m = [0.0_f32; 360];
    world.cast_batch(&rays, Filter::default(), 1, &mut distances_m);
    assert_eq!(distances_m, [1.0; 360]);
    world.remove(&[near]).expect("sound");
    world.cast_batch(&rays, Filter::default(), 1, &mut distances_m);
    assert_eq!(distances_m, [2.0; 360]);
}
