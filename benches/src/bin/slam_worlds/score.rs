//! Trajectory and map against the truth.

use std::collections::BTreeMap;
use std::path::Path;

use periplus_evaluation::{AlignmentMethod, PosePair, align};
use periplus_geometry::{Pose2, normalize_angle};
use periplus_grid::{Grid, GridInfo, OccupancyGrid, squared_distances};
use periplus_maps::{Distro, load};
use periplus_os::Machine;
use serde_json::Value;

use crate::drive::Drive;
use crate::stage::{Stage, laser};

/// Side of the cells in which true walls are kept \[m\].
const FINE_M: f64 = 0.005;
/// Number of rays around a position.
const RAYS: usize = 2880;
/// Spacing of the positions \[m\].
const EVERY_M: f64 = 0.5;
/// Maximum range of walls \[m\].
const FARTHEST_M: f64 = 29.5;
/// Neighbouring rays whose ends are nearer are on one surface \[m\].
const JOINED_M: f64 = 0.08;
/// Cells of at least this are walls.
const OCCUPIED: i8 = 65;

/// Accuracy of a map.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Score {
    pub(crate) scans: usize,
    pub(crate) way_m: f64,
    /// Root mean square of the position error, aligned by the first pose \[m\].
    pub(crate) ate_m: f64,
    /// Root mean square of the position error with the best alignment \[m\].
    pub(crate) ate_best_m: f64,
    pub(crate) worst_m: f64,
    /// Root mean square of the error of heading, as seen from the first pose \[deg\].
    pub(crate) turn_deg: f64,
    /// Occupied cells: distance of their middles from true walls, mean \[m\]; part of those through
    /// or within half a cell of which a true wall goes.
    pub(crate) wall_m: f64,
    pub(crate) right: f64,
    /// The same after the best alignment.
    pub(crate) right_best: f64,
    /// Part of the true walls that were seen which are within half a cell of an occupied one.
    pub(crate) found: f64,
    /// CPU for each scan \[ms\], and the most memory \[MB\].
    pub(crate) scan_ms: f64,
    pub(crate) p99_ms: f64,
    pub(crate) memory_mb: f64,
    pub(crate) closures: u64,
}

pub(crate) fn score(stage: &Stage, drive: &Drive, out: &Path) -> Result<Score, String> {
    let text = std::fs::read_to_string(out.join("trajectory.txt")).map_err(|it| it.to_string())?;
    let truth: BTreeMap<i64, Pose2> =
        drive.truth.iter().map(|(time_ns, pose)| (time_ns / 1000, *pose)).collect();
    let mut pairs: Vec<(Pose2, Pose2)> = Vec::new();
    for line in text.lines() {
        let numbers: Vec<f64> =
            line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [time_s, x_m, y_m, yaw_rad] = numbers[..] else {
            return Err(format!("`{line}` is not a line of a trajectory"));
        };
        let time_us = (time_s * 1e6).round() as i64;
        let there = truth.get(&time_us).ok_or_else(|| format!("nothing is known of {time_s} s"))?;
        pairs.push((*there, Pose2::new(x_m, y_m, yaw_rad)));
    }
    let Some((first, _)) = pairs.split_first() else { return Err("no trajectory".into()) };
    let world_from_map = first.0 * first.1.inverse();
    let best_from_map = aligned(&pairs)?;
    let rms = |world_from_map: Pose2| {
        let squares = pairs.iter().map(|(truth, found)| {
            let (x, y) = world_from_map.transform_point(found.x_m, found.y_m);
            (truth.x_m - x).powi(2) + (truth.y_m - y).powi(2)
        });
        let squares: Vec<f64> = squares.collect();
        let worst = squares.iter().copied().fold(0.0, f64::max).sqrt();
        ((squares.iter().sum::<f64>() / squares.len() as f64).sqrt(), worst)
    };
    let turns = pairs.iter().map(|(truth, found)| {
        normalize_angle(truth.yaw_rad - found.yaw_rad - world_from_map.yaw_rad).powi(2)
    });
    let turn_rad = (turns.sum::<f64>() / pairs.len() as f64).sqrt();
    let path = out.join("map.yaml").display().to_string();
    let map = load(&path, Distro::Jazzy, &Machine).map.ok_or(format!("{path} is not a map"))?.grid;
    let walls = Walls::of(stage, drive);
    let (wall_m, right) = walls.hold(&map, world_from_map);
    let (_, right_best) = walls.hold(&map, best_from_map);
    let report = std::fs::read_to_string(out.join("report.json")).map_err(|it| it.to_string())?;
    let report: Value = serde_json::from_str(&report).map_err(|why| why.to_string())?;
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let cpu_s = number(&report["cpu_s"]) - number(&report["load_s"]);
    Ok(Score {
        scans: pairs.len(),
        way_m: drive.way_m(),
        ate_m: rms(world_from_map).0,
        worst_m: rms(world_from_map).1,
        ate_best_m: rms(best_from_map).0,
        turn_deg: turn_rad.to_degrees(),
        wall_m,
        right,
        right_best,
        found: walls.found(&map, best_from_map),
        scan_ms: 1e3 * cpu_s / pairs.len() as f64,
        p99_ms: number(&report["scan_ms"]["p99"]),
        memory_mb: number(&report["peak_memory_bytes"]) * 1e-6,
        closures: report["loop_closures"].as_u64().unwrap_or(0),
    })
}

/// Rigid transform in the plane that best aligns the estimated positions with the true ones.
fn aligned(pairs: &[(Pose2, Pose2)]) -> Result<Pose2, String> {
    let pair = |&(truth, found): &(Pose2, Pose2)| PosePair {
        stamp_s: 0.0,
        reference: truth.into(),
        estimate: found.into(),
    };
    let pairs: Vec<PosePair> = pairs.iter().map(pair).collect();
    let found = align(&pairs, AlignmentMethod::Se2).map_err(|why| why.to_string())?;
    Ok(found.reference_from_estimate.into())
}

/// The walls that could be seen from where the robot was, in the plane of the laser.
struct Walls {
    /// Points on them \[m\].
    points: Vec<[f32; 2]>,
    /// Distance from them, squared, in fine cells.
    distances: Grid<u32>,
}

impl Walls {
    fn of(stage: &Stage, drive: &Drive) -> Self {
        let [x0, y0, x1, y1] = stage.bounds_m;
        let cells = |length: f64| (length / FINE_M).ceil() as usize;
        let info = GridInfo::new(FINE_M, cells(x1 - x0), cells(y1 - y0), Pose2::new(x0, y0, 0.0))
            .unwrap_or_else(|why| panic!("bounds of a world are sound: {why}"));
        let mut marks = Grid::new(info, false);
        let mut points: Vec<[f32; 2]> = Vec::new();
        let mut mark = |x: f64, y: f64| {
            let Some(cell) = info.cell_of(x, y) else { return };
            let index = info.index(cell);
            if !std::mem::replace(&mut marks.cells[index], true) {
                points.push([x as f32, y as f32]);
            }
        };
        let mut last: Option<Pose2> = None;
        for (_, pose) in &drive.truth {
            let is_near = |last: Pose2| (last.x_m - pose.x_m).hypot(last.y_m - pose.y_m) < EVERY_M;
            if last.is_some_and(is_near) {
                continue;
            }
            last = Some(*pose);
            let from = laser(*pose);
            let mut before: Option<[f64; 2]> = None;
            for ray in 0..=RAYS {
                let angle = std::f64::consts::TAU * ray as f64 / RAYS as f64;
                let end = stage
                    .cast(from, angle, FARTHEST_M)
                    .map(|range| [from[0] + range * angle.cos(), from[1] + range * angle.sin()]);
                if let Some([x, y]) = end {
                    mark(x, y);
                    if let Some([u, v]) = before {
                        let gap = (x - u).hypot(y - v);
                        let steps = (gap / FINE_M).ceil() as usize;
                        if gap < JOINED_M {
                            for step in 1..steps {
                                let part = step as f64 / steps as f64;
                                mark(u + part * (x - u), v + part * (y - v));
                            }
                        }
                    }
                }
                before = end;
            }
        }
        Self { points, distances: squared_distances(&marks, |it| *it) }
    }

    fn distance_m(&self, x: f64, y: f64) -> f64 {
        let squared = self.distances.at(x, y).copied().unwrap_or(u32::MAX);
        f64::from(squared).sqrt() * FINE_M
    }

    /// Mean distance of middles of occupied cells \[m\], and the part of the cells whose square is
    /// within half a cell of a true wall.
    fn hold(&self, map: &OccupancyGrid, world_from_map: Pose2) -> (f64, f64) {
        let side = map.info.resolution_m;
        let (mut sum, mut right, mut count) = (0.0, 0, 0);
        for (index, &value) in map.cells.iter().enumerate() {
            if value < OCCUPIED {
                continue;
            }
            let (x, y) = map.info.centre_of(map.info.cell(index));
            let at = |u: f64, v: f64| {
                let (x, y) = world_from_map.transform_point(x + u * side, y + v * side);
                self.distance_m(x, y)
            };
            let square = (-2..=2).flat_map(|u| (-2..=2).map(move |v| (u, v)));
            let off = square
                .map(|(u, v)| at(0.25 * f64::from(u), 0.25 * f64::from(v)))
                .fold(f64::INFINITY, f64::min);
            sum += at(0.0, 0.0).min(1.0);
            right += usize::from(off <= 0.5 * side);
            count += 1;
        }
        let count = f64::from(count.max(1));
        (sum / count, right as f64 / count)
    }

    /// Part of the points of true walls that are within half a cell of an occupied one.
    fn found(&self, map: &OccupancyGrid, world_from_map: Pose2) -> f64 {
        let map_from_world = world_from_map.inverse();
        let half = 0.5 * map.info.resolution_m;
        let is_found = |point: &&[f32; 2]| {
            let (x, y) = map_from_world.transform_point(point[0].into(), point[1].into());
            let around = (-1..=1).flat_map(|u| (-1..=1).map(move |v| (u, v)));
            around.into_iter().any(|(u, v)| {
                map.at(x + half * f64::from(u), y + half * f64::from(v))
                    .is_some_and(|&value| value >= OCCUPIED)
            })
        };
        let found = self.points.iter().filter(is_found).count();
        found as f64 / self.points.len().max(1) as f64
    }
}
