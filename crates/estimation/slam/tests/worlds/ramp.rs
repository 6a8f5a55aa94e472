//! Ramps of 5 degrees: the scanner pitches, sees the floor in front of it, and over low obstacles.

use periplus_geometry::Stream;

use super::Moment;
use super::rig::{RIG, Rig};
use super::solid::{HIGH, Patch, Scene, Surface, Wall};

const RISE: f64 = 0.087_488_663_5;
/// Length of a ramp, and the height that it gains \[m\].
const RAMP_M: f64 = 14.0;
const UP_M: f64 = RISE * RAMP_M;
const BOUNCE_RAD: f64 = 0.002;

fn rig(seed: u64) -> Rig {
    let rig = RIG.with_scanner(if seed.is_multiple_of(2) { 270 } else { 180 }, 30.0);
    Rig { bounce_rad: BOUNCE_RAD, ..rig.with_wheels(seed / 2 % 2 == 1) }
}

/// A ring of corridors of which one half lies higher than the other: two ramps lead up and down.
pub(crate) fn corridors(seed: u64, is_short: bool) -> Vec<Moment> {
    let (long, deep, half) = (46.0, if is_short { 12.0 } else { 20.0 }, 1.2);
    let foot = 12.0;
    let mut stream = Stream::keyed(seed, "ramp", 0);
    let mut scene = Scene::default();
    let (low, high) = (-half - 9.0, deep + half + 9.0);
    scene.patches.push(Patch { area: [foot, low, foot + RAMP_M, high], z_m: 0.0, rise: RISE });
    scene.patches.push(Patch { area: [foot + RAMP_M, low, 99.0, high], z_m: UP_M, rise: 0.0 });
    scene.block([-half, -half, long + half, deep + half], HIGH);
    scene.block([half, half, long - half, deep - half], HIGH);
    let mut x = 2.0;
    while x < long - 3.0 {
        let (out, wide) = (0.15 + 0.25 * stream.unit(), 0.4 + 0.8 * stream.unit());
        scene.block([x, -half, x + wide, -half + out], HIGH);
        let out = 0.15 + 0.25 * stream.unit();
        scene.block([x + 1.0, deep + half - out, x + 1.0 + wide, deep + half], HIGH);
        x += 2.5 + 4.0 * stream.unit();
    }
    let mut y = 2.0;
    while y < deep - 2.0 {
        let (out, wide) = (0.15 + 0.25 * stream.unit(), 0.4 + 0.8 * stream.unit());
        scene.block([-half, y, -half + out, y + wide], HIGH);
        scene.block([long + half - out, y + 0.7, long + half, y + 0.7 + wide], HIGH);
        y += 2.5 + 3.0 * stream.unit();
    }
    let mut corners = vec![(4.0, 0.0), (long, 0.0), (long, deep), (0.0, deep), (0.0, 0.0)];
    if is_short {
        corners.push((20.0, 0.0));
    } else {
        // Once more the other way round.
        corners.extend([
            (20.0, 0.0),
            (0.0, 0.0),
            (0.0, deep),
            (long, deep),
            (long, 0.0),
            (8.0, 0.0),
        ]);
    }
    rig(seed).drive(scene, &corners, seed)
}

/// Two decks side by side, open to the outside above low walls, with two ramps between.
pub(crate) fn car_park(seed: u64, is_short: bool) -> Vec<Moment> {
    let (long, deep, foot) = (62.0, 40.0, 22.0);
    let top = foot + RAMP_M;
    let ramps = [[4.0, 10.0], [30.0, 36.0]];
    let mut stream = Stream::keyed(seed, "car park", 0);
    let mut scene = Scene::default();
    scene.patches.push(Patch { area: [top, 0.0, long, deep], z_m: UP_M, rise: 0.0 });
    // Sides of the ramps: a curb, or a parapet.
    let side = if seed.is_multiple_of(3) { 1.0 } else { 0.4 };
    for [y0, y1] in ramps {
        scene.patches.push(Patch { area: [foot, y0, top, y1], z_m: 0.0, rise: RISE });
        for step in 0..RAMP_M as usize {
            let x = foot + step as f64;
            let z_m = [-1.0, RISE * (step as f64 + 0.5) + side];
            for y in [y0, y1] {
                scene.walls.push(Wall {
                    ends: [x, y, x + 1.0, y],
                    z_m,
                    surface: Surface::Solid,
                    thing: None,
                });
            }
        }
    }
    // Between the decks, and around them.
    let low = |ends: [f64; 4], top_m: f64| Wall {
        ends,
        z_m: [-1.0, top_m],
        surface: Surface::Solid,
        thing: None,
    };
    for [y0, y1] in [[0.0, 4.0], [10.0, 30.0], [36.0, deep]] {
        scene.walls.push(low([top, y0, top, y1], UP_M + 1.0));
    }
    for ends in [[0.0, 0.0, top, 0.0], [0.0, 0.0, 0.0, deep], [0.0, deep, top, deep]] {
        scene.walls.push(low(ends, 1.1));
    }
    for ends in [[top, 0.0, long, 0.0], [long, 0.0, long, deep], [top, deep, long, deep]] {
        scene.walls.push(low(ends, UP_M + 1.1));
    }
    for column in 1..8 {
        for row in 0..6 {
            let (x, y) = (8.0 * f64::from(column) - 2.0, 8.0 * f64::from(row) - 0.2);
            if !(foot..top).contains(&x) {
                scene.block([x, y, x + 0.4, y + 0.4], HIGH);
            }
        }
    }
    // Cars along the outer walls and in the middle of each deck.
    let rows = [0.4, 12.0, 24.0, deep - 5.0];
    for y in rows {
        let mut x = 3.0;
        while x < long - 4.0 {
            let is_on_deck = !(foot - 4.0..top + 4.0).contains(&x);
            if is_on_deck && stream.unit() < 0.6 {
                let z = if x > top { UP_M } else { 0.0 };
                let (x, y) = (x + 0.3 * stream.unit(), y + 0.4 * stream.unit());
                if !(5.0 - 4.4..9.0).contains(&y) || y < 1.0 {
                    scene.block([x, y, x + 1.75, y + 3.6], [z + 0.15, z + 1.4]);
                }
            }
            x += 2.6;
        }
    }
    // Houses beyond.
    for [x, y] in [[-20.0, 5.0], [15.0, -22.0], [45.0, 52.0], [80.0, 20.0]] {
        let (x, y) = (x + 4.0 * stream.unit(), y + 4.0 * stream.unit());
        scene.block([x, y, x + 12.0, y + 8.0], HIGH);
    }
    let mut corners = vec![(10.0, 7.0), (57.0, 7.0), (57.0, 33.0), (4.0, 33.0), (4.0, 7.0)];
    if is_short {
        corners.push((30.0, 7.0));
    } else {
        corners.extend([(46.0, 7.0), (46.0, 33.0), (16.0, 33.0), (16.0, 20.0), (4.0, 20.0)]);
        corners.extend([(4.0, 7.0), (57.0, 7.0), (57.0, 20.0)]);
    }
    rig(seed).drive(scene, &corners, seed)
}
