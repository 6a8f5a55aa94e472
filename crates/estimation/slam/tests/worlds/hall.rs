//! A hall of 100 m by 60 m: columns in a grid, racks in rows that are all the same, and a scanner that
//! sees 12 m.

use periplus_geometry::Stream;

use super::Moment;
use super::rig::RIG;
use super::solid::{HIGH, Scene};

const LONG_M: f64 = 100.0;
const DEEP_M: f64 = 60.0;
const GRID_M: f64 = 10.0;
/// Racks: how long, from one to the next, and where the first row begins.
const RACK_M: f64 = 34.0;
const ROW_M: f64 = 5.0;
const RACKS_AT: [f64; 2] = [58.0, 8.0];
const ROWS: usize = 9;

pub(crate) fn hall(seed: u64, is_short: bool) -> Vec<Moment> {
    let mut stream = Stream::keyed(seed, "hall", 0);
    let mut scene = Scene::default();
    scene.block([0.0, 0.0, LONG_M, DEEP_M], HIGH);
    // Gates and cabinets along the walls.
    let mut x = 4.0;
    while x < LONG_M - 6.0 {
        let (wide, deep) = (0.8 + 2.0 * stream.unit(), 0.3 + 0.5 * stream.unit());
        scene.block([x, 0.0, x + wide, deep], HIGH);
        scene.block([x + 2.0, DEEP_M - deep, x + 2.0 + wide, DEEP_M], HIGH);
        x += 6.0 + 10.0 * stream.unit();
    }
    for column in 1..5 {
        for row in 1..6 {
            let (x, y) = (GRID_M * f64::from(column), GRID_M * f64::from(row));
            scene.block([x - 0.2, y - 0.2, x + 0.2, y + 0.2], HIGH);
        }
    }
    // In every other hall some bays of the racks are filled at random, in the others all are the same.
    let is_filled = seed.is_multiple_of(2);
    for row in 0..ROWS {
        let y = RACKS_AT[1] + ROW_M * row as f64;
        let mut x = RACKS_AT[0];
        while x < RACKS_AT[0] + RACK_M {
            for side in [-0.5, 0.4] {
                scene.block([x, y + side, x + 0.1, y + side + 0.1], HIGH);
            }
            if is_filled && stream.unit() < 0.6 {
                let back = 0.1 * stream.unit();
                scene.block([x + 0.4, y - 0.45 + back, x + 2.2, y + 0.45 - back], HIGH);
            } else if !is_filled {
                scene.block([x + 0.4, y - 0.4, x + 2.2, y + 0.4], HIGH);
            }
            x += 2.7;
        }
    }
    let aisle = |row: usize| RACKS_AT[1] + ROW_M * (row as f64 - 0.5);
    let (near, far) = (RACKS_AT[0] - 3.0, RACKS_AT[0] + RACK_M + 3.0);
    let mut corners = vec![(5.0, 4.0), (near, 4.0)];
    let count = if is_short { 2 } else { ROWS };
    for row in (1..count).step_by(2) {
        corners.extend([(near, aisle(row)), (far, aisle(row))]);
        corners.extend([(far, aisle(row + 1)), (near, aisle(row + 1))]);
    }
    // Through the bare half, and over what was driven before.
    if is_short {
        corners.extend([(near, 25.0), (5.0, 25.0), (5.0, 4.0), (near, 4.0)]);
    } else {
        corners.extend([(near, 56.0), (5.0, 56.0), (5.0, 35.0), (near, 35.0)]);
        corners.extend([(near, 15.0), (25.0, 15.0), (25.0, 45.0), (5.0, 45.0), (5.0, 4.0)]);
        corners.extend([(near, 4.0), (near, aisle(3)), (far, aisle(3)), (far, 4.0), (near, 4.0)]);
    }
    let rig = RIG.with_scanner(if (seed / 2).is_multiple_of(2) { 270 } else { 180 }, 12.0);
    rig.with_wheels(seed / 4 % 2 == 1).drive(scene, &corners, seed)
}
