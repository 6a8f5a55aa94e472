//! Maps of logs side by side in one picture: `maps LOGS RUNS PICTURE.png`.
//!
//! `RUNS/NAME/trajectory.txt` is what `periplus slam LOGS/NAME/raw.clf --out RUNS/NAME` wrote. Where a log
//! has a published trajectory (`rbpf_reference.txt`), both maps are drawn of the scans that it has poses
//! for, by the same rule and in the same frame, ours on the left. Other logs come after them, alone.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that reads logs and draws a picture"
)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use periplus_bags::{CarmenLog, CarmenScan, read_carmen};
use periplus_geometry::Pose2;
use periplus_grid::Line;
use periplus_images::{Layout, pack_png};

/// Side of a map in the picture, the space between maps, and how many are in a row \[px\].
const SIDE_PX: usize = 380;
const SPACE_PX: usize = 6;
const COLUMNS: usize = 4;
/// Fraction of the beam ends that may be outside of the picture on each side: stray readings.
const STRAY_RATIO: f64 = 0.004;
const MARGIN_M: f64 = 1.0;
/// A pixel is a wall when this part of the beams that reached it ended there.
const WALL_RATIO: f64 = 0.25;
/// Minimum motion between two drawn scans.
const SHIFT_M: f64 = 0.2;
const TURN_RAD: f64 = 0.2;
/// Longer readings are not drawn \[m\].
const RANGE_MAX_M: f32 = 40.0;
const OCCUPIED: u8 = 0;
const UNKNOWN: u8 = 214;
const FREE: u8 = 255;

fn main() {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [logs, runs, picture] = arguments.as_slice() else {
        println!("usage: maps LOGS RUNS PICTURE.png");
        return;
    };
    let mut names: Vec<PathBuf> =
        fs::read_dir(logs).unwrap().map(|it| it.unwrap().path()).collect();
    names.sort();
    let (mut pairs, mut alone) = (Vec::new(), Vec::new());
    for folder in names {
        let name = folder.file_name().unwrap();
        let Ok(text) = fs::read_to_string(runs.join(name).join("trajectory.txt")) else { continue };
        let Some(log) = log(&folder) else { continue };
        let (ours, peer) = (poses(&text), reference(&folder));
        match peer {
            Some(peer) => pairs.push(pair(&log, &ours, &peer)),
            None if is_alone(&log) => alone.push(draw(&log, &ours, &Frame::of(&log, &ours))),
            None => {}
        }
    }
    let maps: Vec<Map> = pairs.into_iter().flatten().chain(alone).collect();
    let rows = maps.len().div_ceil(COLUMNS);
    let across = |count: usize| count * (SIDE_PX + SPACE_PX) + SPACE_PX;
    let (width, height) = (across(COLUMNS), across(rows));
    let mut pixels = vec![FREE; width * height];
    for (index, map) in maps.iter().enumerate() {
        let (left, top) = (across(index % COLUMNS), across(index / COLUMNS));
        for (row, line) in map.chunks(SIDE_PX).enumerate() {
            pixels[(top + row) * width + left..][..SIDE_PX].copy_from_slice(line);
        }
    }
    let size = |it: usize| u32::try_from(it).unwrap();
    let png = pack_png(size(width), size(height), Layout::Grey, |out| out.write_all(&pixels));
    fs::write(picture, png.unwrap()).unwrap();
    println!("{} maps in {}", maps.len(), picture.display());
}

/// Grey values, the highest row first.
type Map = Vec<u8>;
type Poses = BTreeMap<i64, Pose2>;

fn log(folder: &Path) -> Option<CarmenLog> {
    Some(read_carmen(&fs::read(folder.join("raw.clf")).ok()?))
}

fn reference(folder: &Path) -> Option<Poses> {
    Some(poses(&fs::read_to_string(folder.join("rbpf_reference.txt")).ok()?))
}

/// Small logs of which a map shows nothing are left out.
fn is_alone(log: &CarmenLog) -> bool {
    log.scans.len() >= 1000
}

fn tick(time_s: f64) -> i64 {
    (time_s * 1e4).round() as i64
}

/// Lines `stamp x y theta`, by stamp.
fn poses(text: &str) -> Poses {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let pose = |line: &str| {
        let words: Vec<f64> = line.split_whitespace().map(|it| it.parse().unwrap()).collect();
        (tick(words[0]), Pose2::new(words[1], words[2], words[3]))
    };
    lines.map(pose).collect()
}

/// Both maps of a log, of the scans for which both have a pose, ours laid onto the other.
fn pair(log: &CarmenLog, ours: &Poses, peer: &Poses) -> [Map; 2] {
    let both: Vec<(i64, Pose2, Pose2)> =
        peer.iter().filter_map(|(at, peer)| Some((*at, *ours.get(at)?, *peer))).collect();
    let peer_from_ours = aligned(&both);
    let place = |(at, ours, _): &(i64, Pose2, Pose2)| (*at, peer_from_ours * *ours);
    let ours: Poses = both.iter().map(place).collect();
    let peer: Poses = both.iter().map(|(at, _, peer)| (*at, *peer)).collect();
    let frame = Frame::of(log, &peer);
    [draw(log, &ours, &frame), draw(log, &peer, &frame)]
}

/// The rigid motion that brings the first poses nearest to the second.
fn aligned(pairs: &[(i64, Pose2, Pose2)]) -> Pose2 {
    let count = pairs.len().max(1) as f64;
    let mean = |of: fn(&(i64, Pose2, Pose2)) -> f64| pairs.iter().map(of).sum::<f64>() / count;
    let (ax, ay) = (mean(|it| it.1.x_m), mean(|it| it.1.y_m));
    let (bx, by) = (mean(|it| it.2.x_m), mean(|it| it.2.y_m));
    let (mut along, mut across) = (0.0, 0.0);
    for (_, a, b) in pairs {
        let (ax, ay, bx, by) = (a.x_m - ax, a.y_m - ay, b.x_m - bx, b.y_m - by);
        along += ax * bx + ay * by;
        across += ax * by - ay * bx;
    }
    let turn = Pose2::new(0.0, 0.0, libm::atan2(across, along));
    let middle = turn * Pose2::new(ax, ay, 0.0);
    Pose2::new(bx - middle.x_m, by - middle.y_m, turn.yaw_rad)
}

/// The part of the plane that is drawn.
struct Frame {
    left_m: f64,
    bottom_m: f64,
    px_per_m: f64,
}

impl Frame {
    fn of(log: &CarmenLog, poses: &Poses) -> Self {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        for (pose, scan) in drawn(log, poses) {
            for [x, y] in ends(pose, scan) {
                xs.push(x);
                ys.push(y);
            }
        }
        let span = |values: &mut Vec<f64>| {
            values.sort_by(f64::total_cmp);
            let stray = (values.len() as f64 * STRAY_RATIO) as usize;
            let (low, high) = (values[stray], values[values.len() - 1 - stray]);
            (low - MARGIN_M, high + MARGIN_M)
        };
        let ((left, right), (bottom, top)) = (span(&mut xs), span(&mut ys));
        let side_m = (right - left).max(top - bottom);
        Self {
            left_m: 0.5 * (left + right - side_m),
            bottom_m: 0.5 * (bottom + top - side_m),
            px_per_m: SIDE_PX as f64 / side_m,
        }
    }

    fn pixel(&self, [x_m, y_m]: [f64; 2]) -> Option<(usize, usize)> {
        let (x, y) = ((x_m - self.left_m) * self.px_per_m, (y_m - self.bottom_m) * self.px_per_m);
        let is_inside = |it: f64| it >= 0.0 && it < SIDE_PX as f64;
        (is_inside(x) && is_inside(y)).then_some((x as usize, y as usize))
    }
}

/// Scans that have a pose, with enough motion between them.
fn drawn<'a>(log: &'a CarmenLog, poses: &Poses) -> Vec<(Pose2, &'a CarmenScan)> {
    let mut last: Option<Pose2> = None;
    let mut drawn = Vec::new();
    for scan in &log.scans {
        let Some(pose) = poses.get(&tick(scan.time_s)) else { continue };
        let is_far = last.is_none_or(|last| {
            let step = (last.inverse() * *pose).normalized();
            libm::hypot(step.x_m, step.y_m) >= SHIFT_M || step.yaw_rad.abs() >= TURN_RAD
        });
        if is_far {
            last = Some(*pose);
            drawn.push((*pose * scan.base_from_laser, scan));
        }
    }
    drawn
}

/// Ends of the beams that met something.
fn ends(map_from_laser: Pose2, scan: &CarmenScan) -> impl Iterator<Item = [f64; 2]> {
    let limit_m = scan.range_max_m.min(RANGE_MAX_M);
    scan.ranges_m
        .iter()
        .enumerate()
        .filter(move |(_, range)| **range > 0.05 && **range < limit_m)
        .map(move |(index, range)| {
            let angle = scan.angle_min_rad + index as f64 * scan.angle_increment_rad;
            let (s, c) = libm::sincos(map_from_laser.yaw_rad + angle);
            let range = f64::from(*range);
            [map_from_laser.x_m + c * range, map_from_laser.y_m + s * range]
        })
}

fn draw(log: &CarmenLog, poses: &Poses, frame: &Frame) -> Map {
    let mut counts = vec![(0_u32, 0_u32); SIDE_PX * SIDE_PX];
    for (pose, scan) in drawn(log, poses) {
        let Some(from) = frame.pixel([pose.x_m, pose.y_m]) else { continue };
        for end in ends(pose, scan) {
            let Some(to) = frame.pixel(end) else { continue };
            for (column, row) in Line::between(from, to) {
                let cell = &mut counts[row * SIDE_PX + column];
                cell.0 += u32::from((column, row) == to);
                cell.1 += 1;
            }
        }
    }
    let grey = |&(hits, all): &(u32, u32)| match all {
        0 => UNKNOWN,
        _ if f64::from(hits) >= WALL_RATIO * f64::from(all) => OCCUPIED,
        _ => FREE,
    };
    counts.chunks(SIDE_PX).rev().flatten().map(grey).collect()
}
