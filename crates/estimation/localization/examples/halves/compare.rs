//! Comparison of localization with SLAM, scan by scan.

use std::fmt::Write as _;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_grid::{occupancy, squared_distances};

use crate::files::{Found, Half, Seen, Way};

/// Distance at which the weight of a map pose in the local alignment with SLAM is one half \[m\].
const NEARBY_M: f64 = 4.0;
/// Minimum total weight; below it the alignment of the whole log is used.
const MIN_NEARBY_WEIGHT_FACTOR: f64 = 2.0;
/// Maximum distance of a beam end at a wall \[m\].
const ON_WALL_M: f64 = 0.15;
/// Minimum inlier ratio of a scan that the map covers.
const MIN_INLIER_RATIO: f64 = 0.5;
/// Required agreement with SLAM \[m\].
pub(crate) const ASKED_M: f64 = 0.1;

/// Scan with both poses.
pub(crate) struct Row {
    /// Time since the first scan of the half \[s\].
    pub(crate) after_s: f64,
    pub(crate) state: String,
    /// Pose by SLAM, aligned with the map nearby.
    pub(crate) slam: Pose2,
    /// Pose by localization, if any.
    pub(crate) found: Option<Pose2>,
    /// Difference: as is, after one alignment, after the alignment nearby \[m\].
    off_m: [f64; 3],
    off_rad: f64,
    /// Inlier ratio at the pose by SLAM.
    on_walls: f64,
    /// True if the pose by SLAM is in free space and the inlier ratio is sufficient.
    pub(crate) is_covered: bool,
}

impl Row {
    pub(crate) fn is_sure(&self) -> bool {
        self.state == "tracking"
    }

    /// Difference after the alignment nearby \[m\].
    pub(crate) fn nearby_m(&self) -> f64 {
        self.off_m[2]
    }
}

/// All scans in order of time.
pub(crate) struct Compared {
    pub(crate) rows: Vec<Row>,
    scans: usize,
}

/// Both maps have their own frame and distortion: the trajectory of SLAM on the whole log is
/// aligned with the map by the scans of the first half, which both contain. Poses under test take
/// no part in it.
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
        let is_near =
            both.iter().map(|(it, _)| weight(*it)).sum::<f64>() >= MIN_NEARBY_WEIGHT_FACTOR;
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
            is_covered: is_free && on_walls >= MIN_INLIER_RATIO,
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

/// Weighted rigid alignment of the first of each pair with the second: mean rotation, and center on
/// center.
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

/// Inlier ratio of a scan, and whether the robot is in free space.
fn covered(half: &Half, walls: &[u32], seen: &Seen, map_from_base: Pose2) -> (f64, bool) {
    let info = half.map.info;
    let cell_transform = info.finder();
    let scan = &seen.scan;
    let map_from_laser = map_from_base * scan.mounting.base_from_scanner;
    let reach = ON_WALL_M / info.resolution_m;
    let (mut count, mut on) = (0_usize, 0_usize);
    for (index, &range) in scan.ranges_m.iter().enumerate() {
        let range = f64::from(range);
        if !(range > scan.range_min_m.into() && range < scan.range_max_m.into()) {
            continue;
        }
        let angle = scan.beam_angle_rad(index);
        let (x, y) = map_from_laser.transform_point(range * angle.cos(), range * angle.sin());
        count += 1;
        let cell = cell_transform.cell_of(x, y).map(|cell| info.index(cell));
        on += usize::from(cell.is_some_and(|it| f64::from(walls[it]) < reach * reach));
    }
    let cell = cell_transform.cell_of(map_from_base.x_m, map_from_base.y_m);
    let is_free = cell.is_some_and(|cell| half.map[cell] == occupancy::FREE);
    (on as f64 / count.max(1) as f64, is_free)
}

impl Compared {
    /// CSV with a line per scan.
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

    /// Row of the table.
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
