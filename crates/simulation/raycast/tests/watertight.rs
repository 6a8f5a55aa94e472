//! No ray leaves a closed mesh from inside, not even through edges and corners.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod support;

use periplus_geometry::{DVec3, Stream};
use periplus_raycast::{Filter, Ray};
use support::{Solid, fixed, unit};

/// A box whose faces are grids of `n` by `n` squares, two triangles each.
fn grid_box(size: DVec3, n: u32) -> Solid {
    let mut solid = Solid::default();
    for axis in 0..3 {
        for side in [-0.5, 0.5] {
            let start = u32::try_from(solid.positions_m.len()).unwrap();
            for i in 0..=n {
                for j in 0..=n {
                    let mut p = [0.0; 3];
                    p[axis] = side * size[axis];
                    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                    p[u] = (f64::from(i) / f64::from(n) - 0.5) * size[u];
                    p[v] = (f64::from(j) / f64::from(n) - 0.5) * size[v];
                    solid.positions_m.push(p);
                }
            }
            for i in 0..n {
                for j in 0..n {
                    let a = start + i * (n + 1) + j;
                    let (b, c, d) = (a + n + 1, a + n + 2, a + 1);
                    solid.triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    solid
}

/// A dented ball of rings and sectors.
fn ball(rings: u32, sectors: u32, radius: f64, shift: DVec3) -> Solid {
    let mut solid = Solid::default();
    let mut stream = Stream::keyed(1, "dents", 0);
    let mut push = |solid: &mut Solid, p: DVec3| {
        let dent = 1.0 - 0.2 * stream.unit();
        solid.positions_m.push((p * radius * dent + shift).to_array());
    };
    push(&mut solid, DVec3::Z);
    for ring in 1..rings {
        let (s, c) = libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
        for sector in 0..sectors {
            let rotate_into_world = std::f64::consts::TAU * f64::from(sector) / f64::from(sectors);
            push(
                &mut solid,
                DVec3::new(s * libm::cos(rotate_into_world), s * libm::sin(rotate_into_world), c),
            );
        }
    }
    push(&mut solid, DVec3::NEG_Z);
    let last = u32::try_from(solid.positions_m.len()).unwrap() - 1;
    let at = |ring: u32, sector: u32| 1 + ring * sectors + sector % sectors;
    for sector in 0..sectors {
        solid.triangles.push([0, at(0, sector), at(0, sector + 1)]);
        solid.triangles.push([last, at(rings - 2, sector + 1), at(rings - 2, sector)]);
        for ring in 0..rings - 2 {
            let (a, b) = (at(ring, sector), at(ring, sector + 1));
            let (c, d) = (at(ring + 1, sector + 1), at(ring + 1, sector));
            solid.triangles.extend([[a, d, b], [b, d, c]]);
        }
    }
    solid
}

/// Returns the number of rays that escape from inside.
fn leaks(solid: &Solid, inside: impl Fn(&mut Stream) -> DVec3, count: usize) -> usize {
    let world = fixed(solid);
    let mut stream = Stream::keyed(2, "leaks", 0);
    let corner = |triangle: usize, which: usize| {
        DVec3::from_array(solid.positions_m[solid.triangles[triangle][which % 3] as usize])
    };
    let mut open = 0;
    let mut rays = Vec::new();
    let mut distances = Vec::new();
    for _ in 0..count.div_ceil(64) {
        rays.clear();
        let origin = inside(&mut stream);
        for _ in 0..64 {
            let triangle = usize::try_from(stream.bits() % solid.triangles.len() as u64).unwrap();
            let which = usize::try_from(stream.bits() % 3).unwrap();
            let (a, b) = (corner(triangle, which), corner(triangle, which + 1));
            let along = if stream.bits().is_multiple_of(3) { 0.0 } else { stream.unit() };
            let target = a + (b - a) * along;
            rays.push(Ray::new(origin, (target - origin).normalize()));
        }
        distances.resize(rays.len(), 0.0);
        world.cast_batch(&rays, Filter::default(), 1, &mut distances);
        open += distances.iter().filter(|distance| distance.is_infinite()).count();
        // Neighbours go together as packets; here each goes alone.
        open +=
            rays.iter().step_by(4).filter(|ray| !world.occluded(ray, Filter::default())).count();
    }
    open
}

fn all(count: usize) {
    let room = DVec3::new(40.0, 30.0, 3.0);
    for n in [1, 3, 16] {
        // Somewhere, and on the grid's own planes, where rays run along edges.
        let somewhere = |stream: &mut Stream| {
            DVec3::new(stream.unit() - 0.5, stream.unit() - 0.5, stream.unit() - 0.5) * room * 0.99
        };
        assert_eq!(leaks(&grid_box(room, n), somewhere, count), 0, "box of {n}");
        let on_lines = |stream: &mut Stream| {
            let mut step = || (stream.bits() % 15) as f64 / 16.0 - 0.4375;
            DVec3::new(step(), step(), step()) * room
        };
        assert_eq!(leaks(&grid_box(room, n), on_lines, count), 0, "box of {n}, on its lines");
    }
    for shift in [DVec3::ZERO, DVec3::new(1000.0, -2000.0, 500.0)] {
        let inside = |stream: &mut Stream| shift + unit(stream) * (2.0 * stream.unit());
        assert_eq!(leaks(&ball(40, 60, 5.0, shift), inside, count), 0, "ball");
        assert_eq!(
            leaks(&ball(3, 5, 5.0, shift), |s| shift + unit(s) * s.unit() * 0.2, count),
            0,
            "coarse ball"
        );
    }
}

#[test]
fn nothing_leaks() {
    all(40_000);
}

/// More than ten million rays; about three seconds.
#[test]
fn nothing_leaks_of_ten_million() {
    all(1_300_000);
}
