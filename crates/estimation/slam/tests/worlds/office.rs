//! An office: a ring of corridors with one across its middle, rooms along the long sides.

use periplus_geometry::Stream;

use super::solid::{Door, HIGH, Scene, Surface, Wall};

/// Corners of the ring \[m\].
pub(crate) const LONG_M: f64 = 36.0;
pub(crate) const DEEP_M: f64 = 20.0;
/// Width of a door, depth of a room \[m\].
const DOOR_M: f64 = 1.0;
const ROOM_M: f64 = 5.0;

/// Properties of the corridors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Style {
    /// Half the width of a corridor \[m\].
    pub(crate) half_m: f64,
    /// True if walls between corridors and rooms, and the one at the end, are of glass.
    pub(crate) is_glazed: bool,
    /// True if rooms have doors that move.
    pub(crate) has_doors: bool,
}

pub(crate) const PLAIN: Style = Style { half_m: 1.1, is_glazed: false, has_doors: false };

pub(crate) struct Office {
    pub(crate) scene: Scene,
    /// Middles of the doors on the lower and on the upper side, by x \[m\].
    pub(crate) lower: Vec<f64>,
    pub(crate) upper: Vec<f64>,
}

impl Office {
    pub(crate) fn new(seed: u64, style: Style) -> Self {
        let mut stream = Stream::keyed(seed, "office", 0);
        let mut scene = Scene::default();
        let half = style.half_m;
        // The core, with pilasters that are not the same anywhere.
        for [x0, x1] in [[half, 0.5 * LONG_M - half], [0.5 * LONG_M + half, LONG_M - half]] {
            scene.block([x0, half, x1, DEEP_M - half], HIGH);
            for y in [half, DEEP_M - half] {
                let mut x = x0 + 1.0 + stream.unit();
                while x < x1 - 1.5 {
                    let out =
                        (0.1 + 0.15 * stream.unit()) * if y < 2.0 * half { -1.0 } else { 1.0 };
                    scene.block(
                        [x, y.min(y + out), x + 0.3 + 0.5 * stream.unit(), y.max(y + out)],
                        HIGH,
                    );
                    x += 2.5 + 4.0 * stream.unit();
                }
            }
        }
        // The ends: one may be a front of glass.
        for x in [-half, LONG_M + half] {
            let ends = [x, -half, x, DEEP_M + half];
            if style.is_glazed && x > 0.0 {
                glazed(&mut scene, ends, 1.8);
                scene.wall([x + 9.0, -8.0, x + 9.0 + 3.0 * stream.unit(), 0.6 * DEEP_M]);
                continue;
            }
            scene.wall(ends);
            let mut y = 1.0 + stream.unit();
            while y < DEEP_M - 1.0 {
                let in_m = (0.1 + 0.2 * stream.unit()) * if x < 0.0 { 1.0 } else { -1.0 };
                scene.block(
                    [x.min(x + in_m), y, x.max(x + in_m), y + 0.3 + 0.4 * stream.unit()],
                    HIGH,
                );
                y += 2.0 + 4.0 * stream.unit();
            }
        }
        let lower = rooms(&mut scene, &mut stream, style, -half, -1.0, seed);
        let upper = rooms(&mut scene, &mut stream, style, DEEP_M + half, 1.0, seed);
        Self { scene, lower, upper }
    }

    /// Around the ring, across its middle and back, with a look into some rooms.
    pub(crate) fn rounds(&self, is_short: bool) -> Vec<(f64, f64)> {
        let mut corners = vec![(3.0, 0.0)];
        let visit = |corners: &mut Vec<(f64, f64)>, x: f64, y: f64, in_m: f64| {
            corners.extend([(x, y), (x, y + in_m), (x, y)]);
        };
        let every = if is_short { 4 } else { 2 };
        for &x in self.lower.iter().filter(|it| (5.0..LONG_M - 1.0).contains(*it)).step_by(every) {
            visit(&mut corners, x, 0.0, -3.0);
        }
        corners.extend([(LONG_M, 0.0), (LONG_M, DEEP_M)]);
        let inner = self.upper.iter().rev().filter(|it| (1.0..LONG_M - 1.0).contains(*it));
        for &x in inner.step_by(every) {
            visit(&mut corners, x, DEEP_M, 3.0);
        }
        corners.extend([(0.0, DEEP_M), (0.0, 0.0), (0.5 * LONG_M, 0.0), (0.5 * LONG_M, DEEP_M)]);
        if is_short {
            corners.push((0.75 * LONG_M, DEEP_M));
            return corners;
        }
        corners.extend([(LONG_M, DEEP_M), (LONG_M, 0.0), (0.0, 0.0), (0.0, DEEP_M)]);
        corners.extend([(0.5 * LONG_M, DEEP_M), (0.5 * LONG_M, 0.0), (0.75 * LONG_M, 0.0)]);
        corners
    }
}

/// A row of rooms behind a wall at `y`, away from the corridor; gives the middles of their doors.
fn rooms(
    scene: &mut Scene,
    stream: &mut Stream,
    style: Style,
    y: f64,
    away: f64,
    seed: u64,
) -> Vec<f64> {
    let (mut x, end) = (-style.half_m, LONG_M + style.half_m);
    let back = y + away * ROOM_M;
    scene.wall([x, back, end, back]);
    scene.wall([x, y, x, back]);
    let mut doors = Vec::new();
    while x < end - 1.0 {
        let mut next = x + 3.5 + 3.0 * stream.unit();
        if next > end - 3.0 {
            next = end;
        }
        let door = x + 0.6 + (next - x - 1.2 - DOOR_M) * stream.unit();
        for ends in [[x, y, door, y], [door + DOOR_M, y, next, y]] {
            if style.is_glazed {
                glazed(scene, ends, 1.2);
            } else {
                scene.wall(ends);
            }
        }
        if style.has_doors {
            let ends =
                if away < 0.0 { [door + DOOR_M, y, door, y] } else { [door, y, door + DOOR_M, y] };
            let seed = seed * 1000 + doors.len() as u64 + if away < 0.0 { 0 } else { 500 };
            let (open, period_s) = (0.3 + 0.4 * stream.unit(), 20.0 + 60.0 * stream.unit());
            scene.doors.push(Door { ends, seed, open, period_s });
        }
        doors.push(door + 0.5 * DOOR_M);
        scene.wall([next, y, next, back]);
        // Furniture along the back.
        let mut at = x + 0.2 + 0.5 * stream.unit();
        while at < next - 1.0 {
            let long = 0.5 + 0.9 * stream.unit();
            let deep = 0.4 + 0.6 * stream.unit();
            let (y0, y1) = (back - away * (deep + 0.05), back - away * 0.05);
            scene.block([at, y0.min(y1), (at + long).min(next - 0.1), y0.max(y1)], HIGH);
            at += long + 0.3 + 1.5 * stream.unit();
        }
        x = next;
    }
    doors
}

/// Panes between mullions.
fn glazed(scene: &mut Scene, [x0, y0, x1, y1]: [f64; 4], pane_m: f64) {
    let long = libm::hypot(x1 - x0, y1 - y0);
    let count = (long / pane_m).ceil().max(1.0) as usize;
    for pane in 0..=count {
        let at = |pane: usize| {
            let part = pane as f64 / count as f64;
            (x0 + part * (x1 - x0), y0 + part * (y1 - y0))
        };
        let (x, y) = at(pane);
        scene.block([x - 0.03, y - 0.03, x + 0.03, y + 0.03], HIGH);
        if pane < count {
            let (next_x, next_y) = at(pane + 1);
            let ends = [x, y, next_x, next_y];
            scene.walls.push(Wall { ends, z_m: HIGH, surface: Surface::Glass, thing: None });
        }
    }
}
