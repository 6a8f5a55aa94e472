//! A campus of 300 m by 200 m: few houses far apart, trees, hedges, parked cars, lawns where little is
//! in range.

use periplus_geometry::Stream;

use super::rig::{RIG, Rig};
use super::solid::{HIGH, Post, Scene, Surface, Wall};
use super::{Moment, Robot};

/// Paths run along these \[m\].
const ACROSS_M: [f64; 4] = [20.0, 105.0, 195.0, 280.0];
const UP_M: [f64; 3] = [15.0, 100.0, 185.0];

pub(crate) fn campus(seed: u64, is_short: bool) -> Vec<Moment> {
    let scene = grounds(seed);
    let node = |column: usize, row: usize| (ACROSS_M[column], UP_M[row]);
    let mut corners = vec![node(0, 0)];
    if is_short {
        corners.extend([node(1, 0), node(1, 1), node(0, 1), node(0, 0), node(1, 0)]);
    } else {
        corners.extend([node(3, 0), node(3, 1), node(0, 1), node(0, 2), node(2, 2), node(2, 0)]);
        corners.extend([node(0, 0), node(0, 1), node(1, 1), node(1, 0), node(0, 0)]);
    }
    let range_max_m = if seed.is_multiple_of(2) { 30.0 } else { 80.0 };
    let degrees = if (seed / 2).is_multiple_of(2) { 270 } else { 180 };
    let rig = RIG.with_scanner(degrees, range_max_m);
    let is_bad = seed / 4 % 2 == 1;
    // Wheels on a road turn aside less than those of a robot that skids through corridors.
    let (error, bias_rad_per_m) = if is_bad { (0.08, 0.004) } else { (0.03, 0.001) };
    let robot = Robot {
        range_sigma_m: 0.02,
        way_error: error,
        turn_error: error,
        bias_rad_per_m,
        ..rig.robot
    };
    let way_scale = if is_bad { 1.03 } else { 1.0 };
    let rig = Rig { robot, height_m: 0.5, bounce_rad: 0.004, way_scale, ..rig };
    rig.drive(scene, &corners, seed)
}

fn grounds(seed: u64) -> Scene {
    let mut stream = Stream::keyed(seed, "campus", 0);
    let mut scene = Scene::default();
    // Some houses between the paths, off the middle of their lawns; a few more around.
    let mut lots: Vec<[f64; 4]> = Vec::new();
    for column in 0..3 {
        for row in 0..2 {
            lots.push([ACROSS_M[column], UP_M[row], ACROSS_M[column + 1], UP_M[row + 1]]);
        }
    }
    for lot in &lots {
        if stream.unit() < 0.75 {
            house(&mut scene, &mut stream, *lot);
        } else {
            wood(&mut scene, &mut stream, *lot);
        }
    }
    for middle in [[60.0, -14.0], [230.0, -16.0], [312.0, 60.0], [150.0, 214.0], [-12.0, 140.0]] {
        if stream.unit() < 0.5 {
            let (wide, deep) = (14.0 + 16.0 * stream.unit(), 8.0);
            let [x, y] = middle;
            scene.block([x - wide * 0.5, y - deep * 0.5, x + wide * 0.5, y + deep * 0.5], HIGH);
        }
    }
    for &y in &UP_M {
        roadside(&mut scene, &mut stream, |along, aside| [along, y + aside], 300.0);
    }
    for &x in &ACROSS_M {
        roadside(&mut scene, &mut stream, |along, aside| [x + aside, along], 200.0);
    }
    scene
}

/// A house with bays, on a part of its lot.
fn house(scene: &mut Scene, stream: &mut Stream, [x0, y0, x1, y1]: [f64; 4]) {
    let (wide, deep) = (22.0 + 24.0 * stream.unit(), 12.0 + 16.0 * stream.unit());
    let x = x0 + 9.0 + (x1 - x0 - 18.0 - wide) * stream.unit();
    let y = y0 + 9.0 + (y1 - y0 - 18.0 - deep) * stream.unit();
    scene.block([x, y, x + wide, y + deep], HIGH);
    let mut at = x + 2.0;
    while at < x + wide - 4.0 {
        let (long, out) = (1.0 + 3.0 * stream.unit(), 0.4 + 1.2 * stream.unit());
        scene.block([at, y - out, at + long, y], HIGH);
        scene.block([at + 1.0, y + deep, at + 1.0 + long, y + deep + out], HIGH);
        at += 6.0 + 8.0 * stream.unit();
    }
    // Cars before it.
    let mut at = x;
    while at < x + wide - 2.0 {
        if stream.unit() < 0.6 {
            let y = y - 7.0 + 0.5 * stream.unit();
            scene.block([at, y, at + 1.75, y + 4.3], [0.2, 1.4]);
        }
        at += 2.6;
    }
}

/// Trees, some together.
fn wood(scene: &mut Scene, stream: &mut Stream, [x0, y0, x1, y1]: [f64; 4]) {
    for _ in 0..12 {
        let x = x0 + 6.0 + (x1 - x0 - 12.0) * stream.unit();
        let y = y0 + 6.0 + (y1 - y0 - 12.0) * stream.unit();
        tree(scene, stream, [x, y]);
    }
}

fn tree(scene: &mut Scene, stream: &mut Stream, middle: [f64; 2]) {
    scene.posts.push(Post { middle, radius_m: 0.1 + 0.2 * stream.unit(), z_m: HIGH });
}

/// Roadside: lamp posts on one side, trees, hedges, cars, and long empty parts.
fn roadside(
    scene: &mut Scene,
    stream: &mut Stream,
    place: impl Fn(f64, f64) -> [f64; 2],
    long_m: f64,
) {
    let mut at = 8.0 * stream.unit();
    while at < long_m {
        let middle = place(at, 3.0);
        scene.posts.push(Post { middle, radius_m: 0.08, z_m: HIGH });
        at += 24.0 + 6.0 * stream.unit();
    }
    let mut at = 0.0;
    while at < long_m {
        let kind = stream.unit();
        let long = 10.0 + 25.0 * stream.unit();
        let side = if stream.unit() < 0.5 { -1.0 } else { 1.0 };
        if kind < 0.2 {
            hedge(scene, stream, &place, [at, (at + long).min(long_m)], side * 4.5);
        } else if kind < 0.5 {
            let mut along = at;
            while along < at + long {
                let aside = side * (4.0 + 4.0 * stream.unit());
                tree(scene, stream, place(along, aside));
                along += 5.0 + 6.0 * stream.unit();
            }
        } else if kind < 0.65 {
            let mut along = at;
            while along < at + long {
                if stream.unit() < 0.7 {
                    let ([x0, y0], [x1, y1]) =
                        (place(along, side * 3.2), place(along + 4.3, side * 5.0));
                    scene.block([x0.min(x1), y0.min(y1), x0.max(x1), y0.max(y1)], [0.2, 1.4]);
                }
                along += 5.5 + stream.unit();
            }
        }
        at += long;
    }
}

/// A hedge: not straight, and readings of its leaves scatter.
fn hedge(
    scene: &mut Scene,
    stream: &mut Stream,
    place: &impl Fn(f64, f64) -> [f64; 2],
    [from, to]: [f64; 2],
    aside: f64,
) {
    let mut before = place(from, aside);
    let mut at = from;
    while at < to {
        at += 0.8;
        let next = place(at, aside + 0.12 * stream.normal());
        let thing = Some(scene.walls.len());
        let ends = [before[0], before[1], next[0], next[1]];
        scene.walls.push(Wall { ends, z_m: [0.0, 1.6], surface: Surface::Rough(0.08), thing });
        before = next;
    }
}
