//! Error of a trajectory by known relations.
//!
//! The metric of Kümmerle et al. 2009, "On measuring the accuracy of SLAM algorithms": a relation gives the
//! relative pose of the robot between two times, and the error is the difference of the estimate. No
//! alignment of frames is needed, and an error made once counts once.

use periplus_geometry::{Pose2, normalize_angle};

/// Pose of the robot at `to_s` relative to its pose at `from_s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    /// Stamp \[s\].
    pub from_s: f64,
    /// Stamp \[s\].
    pub to_s: f64,
    /// The relation.
    pub from_from_to: Pose2,
}

/// Reads relations: `t1 t2 x y z roll pitch yaw` a line; `#` begins a remark.
///
/// # Errors
/// The number of the first line that is none, from 1.
pub fn read_relations(text: &str) -> Result<Vec<Relation>, usize> {
    let mut relations = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match words.as_deref() {
            Ok([]) => {}
            Ok([from_s, to_s, x, y, _, _, _, yaw]) => relations.push(Relation {
                from_s: *from_s,
                to_s: *to_s,
                from_from_to: Pose2::new(*x, *y, *yaw),
            }),
            _ => return Err(index + 1),
        }
    }
    Ok(relations)
}

/// Errors over some relations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Number of relations.
    pub count: usize,
    /// Mean shift \[m\].
    pub mean_m: f64,
    /// Its standard deviation \[m\].
    pub deviation_m: f64,
    /// The median shift \[m\].
    pub median_m: f64,
    /// The largest shift \[m\].
    pub most_m: f64,
    /// Mean turn \[deg\].
    pub mean_deg: f64,
}

/// Errors of a trajectory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Score {
    /// Over all relations.
    pub all: Errors,
    /// Over those within a minute.
    pub local: Errors,
    /// Over the others.
    pub loops: Errors,
    /// Number of relations at times that the trajectory does not cover.
    pub missed: usize,
}

/// A pose and its stamp \[s\].
pub type Stamped = (f64, Pose2);

/// Maximum duration of a local relation \[s\].
const LOCAL_S: f64 = 60.0;
/// A pose at a time this near is that of the time, and gaps up to that are bridged \[s\].
const SAME_S: f64 = 0.005;
const GAP_S: f64 = 5.0;

/// Scores a trajectory. `odometry` has the odometry of the log at each scan and between scans, in order of
/// time; it interpolates between poses of the trajectory.
#[must_use]
pub fn score(
    trajectory: &[Stamped],
    scans: &[Stamped],
    between: &[Stamped],
    relations: &[Relation],
) -> Score {
    let rows = misses(trajectory, scans, between, relations);
    let missed = relations.len() - rows.len();
    let rows = rows.iter().map(|it| (it.shift_m, it.turn_rad.to_degrees(), it.is_local));
    let rows: Vec<(f64, f64, bool)> = rows.collect();
    let errors = |wanted: Option<bool>| {
        let mut shifts: Vec<f64> = Vec::new();
        let mut turns = 0.0;
        for (shift, turn, is_local) in &rows {
            if wanted.is_none_or(|wanted| wanted == *is_local) {
                shifts.push(*shift);
                turns += turn;
            }
        }
        shifts.sort_by(f64::total_cmp);
        let count = shifts.len();
        if count == 0 {
            return Errors::default();
        }
        let mean = shifts.iter().sum::<f64>() / count as f64;
        let variance =
            shifts.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / count as f64;
        Errors {
            count,
            mean_m: mean,
            deviation_m: variance.sqrt(),
            median_m: 0.5 * (shifts[(count - 1) / 2] + shifts[count / 2]),
            most_m: shifts[count - 1],
            mean_deg: turns / count as f64,
        }
    };
    Score { all: errors(None), local: errors(Some(true)), loops: errors(Some(false)), missed }
}

/// By how much a trajectory misses one relation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// The relation.
    pub relation: Relation,
    /// Shift \[m\].
    pub shift_m: f64,
    /// Turn, without its sign \[rad\].
    pub turn_rad: f64,
    /// True if the two times are within a minute.
    pub is_local: bool,
    /// Time from its ends to the nearest poses of the trajectory, the longer one \[s\].
    pub beside_s: f64,
}

/// Returns the error of the trajectory for each relation whose times it covers; see [`score`].
#[must_use]
pub fn misses(
    trajectory: &[Stamped],
    scans: &[Stamped],
    between: &[Stamped],
    relations: &[Relation],
) -> Vec<Miss> {
    let mut poses = densified(trajectory, scans, between);
    poses.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut stamps: Vec<f64> = trajectory.iter().map(|it| it.0).collect();
    stamps.sort_by(f64::total_cmp);
    let beside_s = |time_s: f64| {
        let after = stamps.partition_point(|it| *it < time_s);
        let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
        let near = near.filter_map(|index| stamps.get(index)).map(|it| (it - time_s).abs());
        near.fold(f64::INFINITY, f64::min)
    };
    let miss = |relation: &Relation| {
        let (a, b) = (pose_at(&poses, relation.from_s)?, pose_at(&poses, relation.to_s)?);
        let error = relation.from_from_to.inverse() * (a.inverse() * b);
        Some(Miss {
            relation: *relation,
            shift_m: libm::hypot(error.x_m, error.y_m),
            turn_rad: normalize_angle(error.yaw_rad).abs(),
            is_local: (relation.to_s - relation.from_s).abs() <= LOCAL_S,
            beside_s: beside_s(relation.from_s).max(beside_s(relation.to_s)),
        })
    };
    relations.iter().filter_map(miss).collect()
}

/// Returns the trajectory with interpolation by odometry; the remaining difference is distributed evenly
/// over time.
fn densified(trajectory: &[Stamped], scans: &[Stamped], between: &[Stamped]) -> Vec<Stamped> {
    if between.is_empty() {
        return trajectory.to_vec();
    }
    let mut between = between.to_vec();
    between.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The last of those with the same stamp counts.
    let tick = |seconds: f64| (seconds * 1e4).round() as i64;
    let known: std::collections::BTreeMap<i64, Pose2> =
        trajectory.iter().map(|(stamp, pose)| (tick(*stamp), *pose)).collect();
    let mut poses = Vec::new();
    for (index, (stamp, odometry)) in scans.iter().enumerate() {
        let Some(&here) = known.get(&tick(*stamp)) else { continue };
        poses.push((*stamp, here));
        let Some((next_stamp, next_odometry)) = scans.get(index + 1) else { break };
        let Some(&next) = known.get(&tick(*next_stamp)) else { continue };
        let moved = here * (odometry.inverse() * *next_odometry);
        let miss = (moved.inverse() * next).normalized();
        let first = between.partition_point(|it| it.0 <= *stamp);
        let last = between.partition_point(|it| it.0 < *next_stamp);
        for (time, pose) in between.get(first..last).unwrap_or_default() {
            let part = (time - stamp) / (next_stamp - stamp);
            let share = Pose2::new(miss.x_m * part, miss.y_m * part, miss.yaw_rad * part);
            poses.push((*time, here * (odometry.inverse() * *pose) * share));
        }
    }
    poses
}

fn pose_at(poses: &[Stamped], time_s: f64) -> Option<Pose2> {
    let after = poses.partition_point(|it| it.0 < time_s);
    let near = [after.checked_sub(1), Some(after)]
        .into_iter()
        .flatten()
        .filter_map(|index| poses.get(index))
        .filter(|it| (it.0 - time_s).abs() <= SAME_S)
        .min_by(|a, b| (a.0 - time_s).abs().total_cmp(&(b.0 - time_s).abs()));
    if let Some(near) = near {
        return Some(near.1);
    }
    let (a, b) = (poses.get(after.checked_sub(1)?)?, poses.get(after)?);
    if b.0 - a.0 > GAP_S {
        return None;
    }
    let part = (time_s - a.0) / (b.0 - a.0);
    Some(Pose2::new(
        a.1.x_m + part * (b.1.x_m - a.1.x_m),
        a.1.y_m + part * (b.1.y_m - a.1.y_m),
        a.1.yaw_rad + part * normalize_angle(b.1.yaw_rad - a.1.yaw_rad),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_error_counts_once() {
        let relations =
            read_relations("# a remark\n0 1 1 0 0 0 0 0\n1 2 1 0 0 0 0 0\n0 100 9 0 0 0 0 0.1\n")
                .unwrap();
        // The second step is 0.1 too long.
        let trajectory = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.1), (100.0, 9.0)]
            .map(|(stamp, x)| (stamp, Pose2::new(x, 0.0, 0.0)));
        let score = score(&trajectory, &[], &[], &relations);
        assert_eq!((score.local.count, score.loops.count, score.missed), (2, 1, 0));
        assert!((score.local.mean_m - 0.05).abs() < 1e-12);
        assert!((score.local.most_m - 0.1).abs() < 1e-12);
        assert!((score.loops.mean_deg - 0.1_f64.to_degrees()).abs() < 1e-9);
        assert_eq!(read_relations("1 2 3").unwrap_err(), 1);
    }
}
