//! Scenes in three dimensions: upright walls and posts, sloping floor, doors, and walking people.

use std::collections::BTreeSet;

use periplus_geometry::{Pose2, Stream};

/// Interaction of a ray with a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Surface {
    Solid,
    /// Foliage: standard deviation of readings \[m\].
    Rough(f64),
    /// A pane: only rays that meet it nearly squarely come back.
    Glass,
}

/// Rays that meet a pane at less than this from its normal come back \[rad\].
const SQUARE_RAD: f64 = 0.1;

/// An upright wall over a straight line, from z to z \[m\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    pub(crate) ends: [f64; 4],
    pub(crate) z_m: [f64; 2],
    pub(crate) surface: Surface,
    /// Number of the object it is a side of: the sides of one object are removed together. `None` for
    /// buildings.
    pub(crate) thing: Option<usize>,
}

/// An upright cylinder: a trunk, a lamp post, a person.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Post {
    pub(crate) middle: [f64; 2],
    pub(crate) radius_m: f64,
    pub(crate) z_m: [f64; 2],
}

/// Sloping floor: a rectangle in the plane whose height rises along x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// Least x, least y, largest x, largest y \[m\].
    pub(crate) area: [f64; 4],
    /// Height at the least x \[m\], and how much it rises a metre.
    pub(crate) z_m: f64,
    pub(crate) rise: f64,
}

/// A door leaf that rotates about the first of two ends: closed it is on the line between them, open it is
/// perpendicular. It moves at given times, and is open while the robot is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Door {
    pub(crate) ends: [f64; 4],
    pub(crate) seed: u64,
    /// Part of the time that it is open, and how long it stays as it is \[s\].
    pub(crate) open: f64,
    pub(crate) period_s: f64,
}

/// A walking person.
#[derive(Clone, Debug)]
pub(crate) enum Walker {
    /// To and fro along a line of corners at a speed \[m/s\], from somewhere on it.
    Along { corners: Vec<[f64; 2]>, speed_m_s: f64, start_m: f64 },
    /// Beside the robot, from one time to another \[s\].
    With { beside: [f64; 2], from_s: f64, to_s: f64 },
}

/// All of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scene {
    pub(crate) walls: Vec<Wall>,
    pub(crate) posts: Vec<Post>,
    pub(crate) patches: Vec<Patch>,
    pub(crate) doors: Vec<Door>,
    pub(crate) walkers: Vec<Walker>,
}

/// Default height range of walls: from below all floors to above all rays.
pub(crate) const HIGH: [f64; 2] = [-5.0, 9.0];
/// A robot this near to a door keeps it open \[m\].
const HELD_OPEN_M: f64 = 1.6;
/// Half width of a cleared path; longer objects are not removed \[m\].
const CLEAR_M: f64 = 0.5;
const LARGE_M: f64 = 6.0;
/// Half the girth of a person \[m\].
const PERSON_M: f64 = 0.2;

/// Hit of a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) range_m: f64,
    pub(crate) surface: Surface,
}

/// Distance of a position from a line between two ends \[m\].
fn beside_m([x0, y0, x1, y1]: [f64; 4], [x, y]: [f64; 2]) -> f64 {
    let (ux, uy, rx, ry) = (x1 - x0, y1 - y0, x - x0, y - y0);
    let part = ((rx * ux + ry * uy) / (ux * ux + uy * uy).max(1e-12)).clamp(0.0, 1.0);
    libm::hypot(rx - part * ux, ry - part * uy)
}

impl Wall {
    pub(crate) fn new(ends: [f64; 4]) -> Self {
        Self { ends, z_m: HIGH, surface: Surface::Solid, thing: None }
    }

    /// Distance along a ray; none when it passes.
    fn range(&self, [x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> Option<f64> {
        let [x0, y0, x1, y1] = self.ends;
        let (ux, uy) = (x1 - x0, y1 - y0);
        let cross = dx * uy - dy * ux;
        if cross.abs() < 1e-12 {
            return None;
        }
        let (rx, ry) = (x0 - x, y0 - y);
        let range = (rx * uy - ry * ux) / cross;
        let along = (rx * dy - ry * dx) / cross;
        let at_z = z + range * dz;
        let is_met = range > 0.0
            && (0.0..=1.0).contains(&along)
            && (self.z_m[0]..=self.z_m[1]).contains(&at_z);
        let passes = self.surface == Surface::Glass
            && cross.abs() < libm::cos(SQUARE_RAD) * libm::hypot(ux, uy) * libm::hypot(dx, dy);
        (is_met && !passes).then_some(range)
    }
}

impl Post {
    fn range(&self, [x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> Option<f64> {
        let (rx, ry) = (self.middle[0] - x, self.middle[1] - y);
        let flat = dx * dx + dy * dy;
        let along = rx * dx + ry * dy;
        let root = along * along - flat * (rx * rx + ry * ry - self.radius_m * self.radius_m);
        if root < 0.0 {
            return None;
        }
        let range = (along - root.sqrt()) / flat;
        let at_z = z + range * dz;
        (range > 0.0 && (self.z_m[0]..=self.z_m[1]).contains(&at_z)).then_some(range)
    }
}

impl Patch {
    fn holds(&self, x: f64, y: f64) -> bool {
        let [x0, y0, x1, y1] = self.area;
        (x0..x1).contains(&x) && (y0..y1).contains(&y)
    }

    fn height_m(&self, x: f64) -> f64 {
        self.z_m + self.rise * (x - self.area[0])
    }
}

impl Door {
    fn leaf(&self, time_s: f64, robot: Pose2) -> Wall {
        let [x0, y0, x1, y1] = self.ends;
        let phase = Stream::keyed(self.seed, "door", 0).unit();
        let turn = (time_s / self.period_s + phase).floor().max(0.0) as u64;
        let near = libm::hypot(0.5 * (x0 + x1) - robot.x_m, 0.5 * (y0 + y1) - robot.y_m);
        let is_open =
            near < HELD_OPEN_M || Stream::keyed(self.seed, "door", 1 + turn).unit() < self.open;
        let (ux, uy) = (x1 - x0, y1 - y0);
        Wall::new(if is_open { [x0, y0, x0 - uy, y0 + ux] } else { self.ends })
    }
}

impl Walker {
    fn at(&self, time_s: f64, robot: Pose2) -> Option<[f64; 2]> {
        match self {
            Self::Along { corners, speed_m_s, start_m } => {
                let long = |pair: &[[f64; 2]]| {
                    libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1])
                };
                let whole: f64 = corners.windows(2).map(long).sum();
                let gone = (start_m + speed_m_s * time_s) % (2.0 * whole);
                let mut left = if gone > whole { 2.0 * whole - gone } else { gone };
                for pair in corners.windows(2) {
                    let length = long(pair);
                    if left <= length {
                        let part = left / length;
                        return Some(
                            [0, 1].map(|it| pair[0][it] + part * (pair[1][it] - pair[0][it])),
                        );
                    }
                    left -= length;
                }
                corners.last().copied()
            }
            Self::With { beside, from_s, to_s } => {
                // People do not keep step to the centimetre.
                let sway = 0.12 * libm::sin(2.0 * time_s + 7.0 * beside[0]);
                let (x, y) = robot.transform_point(beside[0] + sway, beside[1]);
                (*from_s..*to_s).contains(&time_s).then_some([x, y])
            }
        }
    }
}

impl Scene {
    /// A closed line of walls.
    pub(crate) fn fence(&mut self, corners: &[[f64; 2]], z_m: [f64; 2], surface: Surface) {
        let thing = self.walls.len();
        for (at, &[x0, y0]) in corners.iter().enumerate() {
            let [x1, y1] = corners[(at + 1) % corners.len()];
            self.walls.push(Wall { ends: [x0, y0, x1, y1], z_m, surface, thing: Some(thing) });
        }
    }

    /// A box with upright sides.
    pub(crate) fn block(&mut self, [x0, y0, x1, y1]: [f64; 4], z_m: [f64; 2]) {
        self.fence(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], z_m, Surface::Solid);
    }

    pub(crate) fn wall(&mut self, ends: [f64; 4]) {
        self.walls.push(Wall::new(ends));
    }

    /// Height of the floor \[m\].
    pub(crate) fn height_m(&self, x: f64, y: f64) -> f64 {
        self.patches.iter().find(|it| it.holds(x, y)).map_or(0.0, |it| it.height_m(x))
    }

    /// Removes small objects from the path of a robot.
    pub(crate) fn cleared(mut self, way: &[Pose2]) -> Self {
        let is_in_way = |ends: [f64; 4]| {
            let is_near = |it: &Pose2| beside_m(ends, [it.x_m, it.y_m]) < CLEAR_M;
            libm::hypot(ends[2] - ends[0], ends[3] - ends[1]) < LARGE_M && way.iter().any(is_near)
        };
        let gone: BTreeSet<usize> = self
            .walls
            .iter()
            .filter(|it| it.thing.is_some() && is_in_way(it.ends))
            .filter_map(|it| it.thing)
            .collect();
        self.walls.retain(|it| it.thing.is_none_or(|thing| !gone.contains(&thing)));
        self.posts.retain(|it| {
            let [x, y] = it.middle;
            !is_in_way([x, y, x, y])
        });
        self
    }

    /// Returns the objects within reach of the robot at a time, moving ones at their positions.
    pub(crate) fn around(&self, time_s: f64, robot: Pose2, reach_m: f64) -> Self {
        let is_near = |ends: [f64; 4]| beside_m(ends, [robot.x_m, robot.y_m]) < reach_m;
        let leaves = self.doors.iter().map(|it| it.leaf(time_s, robot));
        let walls = self.walls.iter().copied().chain(leaves);
        let people = self.walkers.iter().filter_map(|it| it.at(time_s, robot));
        let people = people.map(|middle| Post { middle, radius_m: PERSON_M, z_m: HIGH });
        let posts = self.posts.iter().copied().chain(people);
        Self {
            walls: walls.filter(|it| is_near(it.ends)).collect(),
            posts: posts
                .filter(|it| {
                    let [x, y] = it.middle;
                    libm::hypot(x - robot.x_m, y - robot.y_m) < reach_m + it.radius_m
                })
                .collect(),
            patches: self.patches.clone(),
            ..Self::default()
        }
    }

    /// The first thing that a ray meets.
    pub(crate) fn cast(&self, from: [f64; 3], to: [f64; 3]) -> Option<Hit> {
        let walls = self.walls.iter().map(|it| (it.range(from, to), it.surface));
        let posts = self.posts.iter().map(|it| (it.range(from, to), Surface::Solid));
        let hits = walls.chain(posts).filter_map(|(range, surface)| Some((range?, surface)));
        let hits = hits.chain(self.ground(from, to).map(|range| (range, Surface::Solid)));
        hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(range_m, surface)| Hit { range_m, surface })
    }

    /// Intersection of a ray with the floor.
    fn ground(&self, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        if to[2] == 0.0 && self.patches.is_empty() {
            return None;
        }
        let at = |range: f64| (from[0] + range * to[0], from[1] + range * to[1]);
        let level = (to[2] < 0.0).then(|| -from[2] / to[2]).filter(|&range| {
            let (x, y) = at(range);
            range > 0.0 && !self.patches.iter().any(|it| it.holds(x, y))
        });
        let sloping = self.patches.iter().filter_map(|it| {
            let falls = it.rise * to[0] - to[2];
            let above = from[2] - it.height_m(from[0]);
            let range = above / falls;
            let (x, y) = at(range);
            (falls > 0.0 && range > 0.0 && it.holds(x, y)).then_some(range)
        });
        sloping.chain(level).min_by(f64::total_cmp)
    }
}
