//! Distances along paths, in the plane.

use periplus_behavior_tree::PathGeometry;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Pose, PoseStamped};
use periplus_msgs::nav_msgs::Path;

/// Distance of two poses in the plane \[m\].
pub(super) fn distance_m(a: &Pose, b: &Pose) -> f64 {
    libm::hypot(a.position.x - b.position.x, a.position.y - b.position.y)
}

/// Square of the distance of two poses in the plane \[m^2\], to compare distances.
pub(super) fn squared_distance_m2(a: &Pose, b: &Pose) -> f64 {
    let (dx_m, dy_m) = (a.position.x - b.position.x, a.position.y - b.position.y);
    dx_m * dx_m + dy_m * dy_m
}

/// Length of a path from a pose on \[m\].
pub(super) fn length_m(path: &Path, from: usize) -> f64 {
    let rest = path.poses.get(from..).unwrap_or_default();
    rest.windows(2).map(|pair| distance_m(&pair[0].pose, &pair[1].pose)).sum()
}

/// Geometry of a path.
pub(super) fn geometry(path: &Path) -> PathGeometry {
    let Some(end) = path.poses.last() else { return PathGeometry::default() };
    let Pose { position: p, orientation: q } = &end.pose;
    PathGeometry {
        pose_count: path.poses.len(),
        length_m: length_m(path, 0),
        end_position_m: [p.x, p.y, p.z],
        end_pose: [p.x, p.y, p.z, q.x, q.y, q.z, q.w],
    }
}

/// Lengths of a path from each of its poses on, kept while the path is the same.
#[derive(Default)]
pub(super) struct RemainingLengths {
    /// Stamp, number of poses, first and last pose.
    path: Option<(Time, usize, [PoseStamped; 2])>,
    from_pose_m: Vec<f64>,
}

impl RemainingLengths {
    /// Length of a path from a pose on \[m\]; 0 behind its end.
    pub(super) fn remaining_m(&mut self, path: &Path, pose: usize) -> f64 {
        let [Some(first), Some(last)] = [path.poses.first(), path.poses.last()] else { return 0.0 };
        let is_same = self.path.as_ref().is_some_and(|(stamp, count, ends)| {
            (stamp, *count, &ends[0], &ends[1])
                == (&path.header.stamp, path.poses.len(), first, last)
        });
        if !is_same {
            let ends = [first.clone(), last.clone()];
            self.path = Some((path.header.stamp.clone(), path.poses.len(), ends));
            self.from_pose_m.clear();
            self.from_pose_m.resize(path.poses.len(), 0.0);
            for index in (0..path.poses.len() - 1).rev() {
                let step_m = distance_m(&path.poses[index].pose, &path.poses[index + 1].pose);
                self.from_pose_m[index] = self.from_pose_m[index + 1] + step_m;
            }
        }
        self.from_pose_m.get(pose).copied().unwrap_or(0.0)
    }
}

/// Index of the first pose whose distance along the path from the first one is above a limit \[m\]; the
/// number of poses if there is none.
///
/// Source: `first_after_integrated_distance` in `nav2_util/geometry_utils.hpp`.
pub(super) fn first_after_m<'a>(
    poses: impl IntoIterator<Item = &'a PoseStamped>,
    limit_m: f64,
) -> usize {
    let mut travelled_m = 0.0;
    let mut last: Option<&PoseStamped> = None;
    let mut count = 0;
    for pose in poses {
        if let Some(last) = last {
            travelled_m += distance_m(&last.pose, &pose.pose);
            if travelled_m > limit_m {
                return count;
            }
        }
        last = Some(pose);
        count += 1;
    }
    count
}

/// Index of the pose with the least measure, the first one on ties.
pub(super) fn min_by(poses: &[PoseStamped], measure: impl Fn(&PoseStamped) -> f64) -> usize {
    let mut best = (0, f64::INFINITY);
    for (index, pose) in poses.iter().enumerate() {
        let value = measure(pose);
        if value < best.1 {
            best = (index, value);
        }
    }
    best.0
}

/// Index of the segment that is closest to a pose, from `start` on, within a length of path \[m\].
///
/// Source: `distance_from_path` in `nav2_util/path_utils.cpp`.
pub(super) fn closest_segment(path: &Path, pose: &Pose, start: usize, window_m: f64) -> usize {
    let mut best = (start, f64::INFINITY);
    let mut travelled_m = 0.0;
    for index in start..path.poses.len().saturating_sub(1) {
        let [a, b] = [&path.poses[index].pose, &path.poses[index + 1].pose];
        let distance = segment_distance_m(pose, a, b);
        if distance < best.1 {
            best = (index, distance);
        }
        travelled_m += distance_m(a, b);
        if travelled_m > window_m {
            break;
        }
    }
    best.0
}

fn segment_distance_m(pose: &Pose, a: &Pose, b: &Pose) -> f64 {
    let [ax, ay] = [a.position.x, a.position.y];
    let [dx, dy] = [b.position.x - ax, b.position.y - ay];
    let [px, py] = [pose.position.x - ax, pose.position.y - ay];
    let squared = dx * dx + dy * dy;
    let along = if squared > 0.0 { ((px * dx + py * dy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(px - along * dx, py - along * dy)
}

/// True for another path to the same position, by its number of poses.
///
/// Source: `isPathUpdated` in `nav2_util/path_utils.cpp`.
pub(super) fn is_path_updated(new: &Path, old: &Path) -> bool {
    let (Some(end), Some(old_end)) = (new.poses.last(), old.poses.last()) else { return false };
    new.poses.len() != old.poses.len() && end.pose.position == old_end.pose.position
}

/// True if the ends of two paths differ.
pub(super) fn is_goal_updated(new: &Path, old: &Path) -> bool {
    let (Some(end), Some(old_end)) = (new.poses.last(), old.poses.last()) else { return false };
    end.pose != old_end.pose
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(xs: &[f64]) -> Path {
        let poses = xs.iter().map(|x| {
            let mut pose = PoseStamped::default();
            pose.pose.position.x = *x;
            pose
        });
        Path { poses: poses.collect(), ..Path::default() }
    }

    #[test]
    fn lengths_and_indices_follow_the_path() {
        let path = line(&[0.0, 1.0, 3.0, 4.0]);
        assert_eq!(length_m(&path, 0), 4.0);
        assert_eq!(length_m(&path, 2), 1.0);
        assert_eq!(length_m(&path, 9), 0.0);
        let mut lengths = RemainingLengths::default();
        assert_eq!([0, 2, 3, 9].map(|pose| lengths.remaining_m(&path, pose)), [4.0, 1.0, 0.0, 0.0]);
        assert_eq!(lengths.remaining_m(&line(&[0.0, 2.0, 3.0, 5.0]), 0), 5.0);
        assert_eq!(lengths.remaining_m(&Path::default(), 0), 0.0);
        assert_eq!(first_after_m(&path.poses, 1.0), 2);
        assert_eq!(first_after_m(&path.poses, 9.0), 4);
        assert_eq!(first_after_m(&path.poses[..0], 9.0), 0);
        let at = |x: f64| line(&[x]).poses[0].pose.clone();
        assert_eq!(closest_segment(&path, &at(2.0), 0, 9.0), 1);
        assert_eq!(closest_segment(&path, &at(3.5), 0, 0.5), 0);
        assert_eq!(min_by(&path.poses, |pose| distance_m(&pose.pose, &at(2.9))), 2);
        assert!(is_path_updated(&path, &line(&[1.0, 4.0])));
        assert!(!is_path_updated(&path, &line(&[1.0, 5.0])));
        assert!(is_goal_updated(&path, &line(&[1.0, 5.0])));
    }
}
