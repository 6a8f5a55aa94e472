//! Localization against SLAM, scan by scan.

use std::fmt::Write as _;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_grid::{occupancy, squared_distances};

use crate::files::{Found, Half, Seen, Way};

/// Poses of the map near to a place lay SLAM's way over the map there, farther ones less: half at this
/// distance \[m\].
const NEARBY_M: f64 = 4.0;
/// With less of them, counted so, the motion of the whole log counts.
const LEAST_NEARBY: f64 = 2.0;
/// Ends so near to a wall of the map are on it \[m\].
const ON_WALL_M: f64 = 0.15;
/// The map covers a scan of which such a part is on its walls.
const COVERED: f64 = 0.5;
/// Agreement with SLAM that was asked for \[m\].
pub(crate) const ASKED_M: f64 = 0.1;

/// A scan that both have.
pub(crate) struct Row {
    /// Since the first scan of the half \[s\].
    pub(crate) after_s: f64,
    pub(crate) state: String,
    /// Where SLAM has the robot, laid over the map nearby.
    pub(crate) slam: Pose2,
    /// Where localization has it, if anywhere.
    pub(crate) found: Option<Pose2>,
    /// How far apart they are: as they are, after one motion, after that of the poses nearby \[m\].
    off_m: [f64; 3],
    off_rad: f64,
    /// Which part of the ends is on walls where SLAM has the robot.
    on_walls: f64,
    /// Whether SLAM has the robot on a free cell, and enough of the scan is on walls.
    pub(crate) is_covered: bool,
}

impl Row {
    pub(crate) fn is_sure(&self) -> bool {
        self.state == "tracking"
    }

    /// After the motion of the poses nearby \[m\].
    pub(crate) fn nearby_m(&self) -> f64 {
        self.off_m[2]
    }
}

/// All of them, in the order of time.
pub(crate) struct Compared {
    pub(crate) rows: Vec<Row>,
    scans: usize,
}

/// Both maps have a frame and a shape of their own: SLAM's way on the whole log is laid over the map by
/// scans of the first half, which both have. No pose that is judged has a part in it.
pub(crate) fn compare(half: &Half, found: &Found) -> Compared {
    let both: Vec<(Pose2, Pose2)> = half
        .first
        .iter()
        .filter_map(|(stamp, &in_map)| Some((*half.whole.get(stamp)?, in_map)))
        .collect();
    let all = motion(&both, |_| 1.0);
    let walls = squared_distances(&half.map, |&value| value == occupancy::OCCUPIED).cells;
    let begin_us = half.scans.first().map_or(0, |seen| seen.stamp_us);
    let row = |seen: &Seen| {
        let whole = *half.whole.get(&seen.stamp_us)?;
        let weight = |it: Pose2| 0.5_f64.powf((apart_m(it, whole) / NEARBY_M).powi(2));
        let is_near = both.iter().map(|(it, _)| weight(*it)).sum::<f64>() >= LEAST_NEARBY;
        let local = if is_near { motion(&both, weight) } else { all };
        let places = [Pose2::IDENTITY, all, local].map(|motion| motion * whole);
        let (on_walls, is_free) = covered(half, &walls, seen, all * whole);
        let at = pose(&found.poses, seen.stamp_us);
        Some(Row {
            after_s: (seen.stamp_us - begin_us) as f64 * 1e-6,
            state: found.state(seen.stamp_us).to_owned(),
            slam: places[2],
            found: at,
            off_m: places.map(|place| at.map_or(f64::NAN, |at| apart_m(at, place))),
            off_rad: at.map_or(f64::NAN, |at| normalize_angle(at.yaw_rad - places[2].yaw_rad)),
            on_walls,
            is_covered: is_free && on_walls >= COVERED,
        })
    };
    Compared { rows: half.scans.iter().filter_map(row).collect(), scans: half.scans.len() }
}

fn pose(way: &Way, stamp_us: i64) -> Option<Pose2> {
    way.get(&stamp_us).copied()
}

fn apart_m(a: Pose2, b: Pose2) -> f64 {
    (a.x_m - b.x_m).hypot(a.y_m - b.y_m)
}

/// The rigid motion that lays the first of each pair over the second, as far as it counts: turned by
/// the mean of their turns, and middle upon middle.
fn motion(pairs: &[(Pose2, Pose2)], weight: impl Fn(Pose2) -> f64) -> Pose2 {
    let (mut sine, mut cosine, mut all) = (0.0, 0.0, 0.0);
    let mut sums = [0.0; 4];
    for (from, to) in pairs {
        let weight = weight(*from);
        let turn = to.yaw_rad - from.yaw_rad;
        (sine, cosine) = (sine + weight * turn.sin(), cosine + weight * turn.cos());
        for (sum, value) in sums.iter_mut().zip([from.x_m, from.y_m, to.x_m, to.y_m]) {
            *sum += weight * value;
        }
        all += weight;
    }
    if all == 0.0 {
        return Pose2::IDENTITY;
    }
    let middles = sums.map(|sum| sum / all);
    let turn = Pose2::new(0.0, 0.0, sine.atan2(cosine));
    let (x, y) = turn.transform_point(middles[0], middles[1]);
    Pose2::new(middles[2] - x, middles[3] - y, turn.yaw_rad)
}

/// Which part of a scan's ends is on walls of the map, and whether the robot stands where it can.
fn covered(half: &Half, walls: &[u32], seen: &Seen, map_from_base: Pose2) -> (f64, bool) {
    let lattice = half.map.lattice;
    let finder = lattice.finder();
    let scan = &seen.scan;
    let map_from_laser = map_from_base * scan.base_from_laser;
    let reach = ON_WALL_M / lattice.resolution_m;
    let (mut count, mut on) = (0_usize, 0_usize);
    for (index, &range) in scan.ranges_m.iter().enumerate() {
        let range = f64::from(range);
        if !(range > scan.range_min_m && range < scan.range_max_m) {
            continue;
        }
        let angle = scan.angle_min_rad + index as f64 * scan.angle_increment_rad;
        let (x, y) = map_from_laser.transform_point(range * angle.cos(), range * angle.sin());
        count += 1;
        let cell = finder.cell_of(x, y).map(|cell| lattice.index(cell));
        on += usize::from(cell.is_some_and(|it| f64::from(walls[it]) < reach * reach));
    }
    let cell = finder.cell_of(map_from_base.x_m, map_from_base.y_m);
    let is_free = cell.is_some_and(|cell| half.map[cell] == occupancy::FREE);
    (on as f64 / count.max(1) as f64, is_free)
}

impl Compared {
    /// A line for every scan.
    pub(crate) fn csv(&self) -> String {
        let mut text = String::from(
            "after_s,state,on_map,on_walls,x_m,y_m,yaw_rad,slam_x_m,slam_y_m,slam_yaw_rad,\
             as_is_m,one_motion_m,nearby_m,nearby_deg\n",
        );
        for row in &self.rows {
            let found = row.found.unwrap_or(Pose2::new(f64::NAN, f64::NAN, f64::NAN));
            let _ = writeln!(
                text,
                "{:.3},{},{},{:.2},{:.3},{:.3},{:.4},{:.3},{:.3},{:.4},{:.3},{:.3},{:.3},{:.2}",
                row.after_s,
                row.state,
                u8::from(row.is_covered),
                row.on_walls,
                found.x_m,
                found.y_m,
                found.yaw_rad,
                row.slam.x_m,
                row.slam.y_m,
                row.slam.yaw_rad,
                row.off_m[0],
                row.off_m[1],
                row.off_m[2],
                row.off_rad.to_degrees(),
            );
        }
        text
    }

    /// A line of a table.
    pub(crate) fn line(&self, name: &str) -> String {
        let covered = self.rows.iter().filter(|row| row.is_covered).count();
        let sure: Vec<&Row> =
            self.rows.iter().filter(|row| row.is_covered && row.is_sure()).collect();
        let outside: Vec<&Row> =
            self.rows.iter().filter(|row| !row.is_covered && row.is_sure()).collect();
        let most = |which: usize, rows: &[&Row]| {
            rows.iter().map(|row| row.off_m[which]).fold(0.0, f64::max)
        };
        let rms = |which: usize| {
            let squares = sure.iter().map(|row| row.off_m[which].powi(2)).sum::<f64>();
            (squares / sure.len().max(1) as f64).sqrt()
        };
        let turn = sure.iter().map(|row| row.off_rad.abs().to_degrees()).fold(0.0, f64::max);
        let beyond = sure.iter().filter(|row| row.nearby_m() > ASKED_M).count();
        format!(
            "| {name} | {} of {} | {} | {:.3} | {:.3}, {:.3} | {:.3}, {:.3} | {turn:.2} | {beyond} | {}, {:.3} |",
            covered,
            self.scans,
            sure.len(),
            most(0, &sure),
            rms(1),
            most(1, &sure),
            rms(2),
            most(2, &sure),
            outside.len(),
            most(2, &outside),
        )
    }
}
