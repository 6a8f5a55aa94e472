//! Collision check of motions, from the pose of the robot on.

use periplus_costmap::{Costmap, Footprint, cost};
use periplus_geometry::Pose2;

use super::is_pose_free;
use crate::outline::{SAME_OVERLAP_M, inside_m};

/// Distance between the centre of a cell and its corners, in sides of the cell.
const HALF_DIAGONAL_RATIO: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// True if a robot that moves over poses in the frame of the costmap, from the one at which it is, collides with no
/// obstacle.
///
/// A robot that touches an obstacle already cannot back up or turn in Nav2, since the first pose collides: no recovery
/// gets it away. Here it may leave the obstacle: the overlap with the cells that it touches must not grow from pose to
/// pose, and it must not touch others.
#[must_use]
pub fn is_motion_free(costmap: &Costmap, footprint: &Footprint, poses: &[Pose2]) -> bool {
    let Some(start) = poses.first() else { return true };
    let is_free = |pose: &Pose2| is_pose_free(costmap, footprint, *pose);
    if is_free(start) {
        return poses.iter().all(is_free);
    }
    let margin_m = HALF_DIAGONAL_RATIO * costmap.resolution_m();
    let overlap_m = |corners: &[[f64; 2]], [x_m, y_m]: [f64; 2]| {
        (inside_m(corners, x_m, y_m) + margin_m).max(0.0)
    };
    let (mut others, corners) = (costmap.clone(), footprint.placed(*start));
    let mut touched = Vec::new();
    for index in 0..costmap.info().len() {
        let cell = costmap.info().cell(index);
        let (x_m, y_m) = costmap.info().centre_of(cell);
        if costmap.cost(cell) == Some(cost::LETHAL) && overlap_m(&corners, [x_m, y_m]) > 0.0 {
            touched.push([x_m, y_m]);
            others.set(cell, cost::INSCRIBED);
        }
    }
    let mut last_m = f64::INFINITY;
    poses.iter().all(|pose| {
        let corners = footprint.placed(*pose);
        let next_m: f64 = touched.iter().map(|centre| overlap_m(&corners, *centre)).sum();
        let grows = next_m > last_m + SAME_OVERLAP_M;
        last_m = next_m;
        !grows && is_pose_free(&others, footprint, *pose)
    })
}

#[cfg(test)]
mod tests {
    use periplus_grid::GridInfo;

    use super::*;

    /// 2 m by 2 m around the origin, with obstacles.
    fn costmap(obstacles: &[(f64, f64)]) -> Costmap {
        let info = GridInfo::new(0.05, 40, 40, Pose2::new(-1.0, -1.0, 0.0)).unwrap();
        let mut costmap = Costmap::new(info, 0);
        for (x_m, y_m) in obstacles {
            costmap.set(costmap.finder().cell_of(*x_m, *y_m).unwrap(), cost::LETHAL);
        }
        costmap
    }

    fn check(obstacles: &[(f64, f64)], step: Pose2, expected: bool) {
        let square = Footprint::new(vec![[0.2, 0.2], [0.2, -0.2], [-0.2, -0.2], [-0.2, 0.2]]);
        let mut poses = vec![Pose2::IDENTITY];
        while poses.len() < 10 {
            poses.push(poses[poses.len() - 1] * step);
        }
        let is_free = is_motion_free(&costmap(obstacles), &square, &poses);
        assert_eq!(is_free, expected, "{obstacles:?} {step:?}");
    }

    #[test]
    fn a_robot_leaves_the_obstacle_that_it_touches() {
        let back = Pose2::new(-0.03, 0.0, 0.0);
        let ahead = Pose2::new(0.03, 0.0, 0.0);
        let turn = Pose2::new(0.0, 0.0, 0.1);
        let wall = [(0.21, -0.1), (0.21, 0.0), (0.21, 0.1)];
        check(&[], ahead, true);
        check(&wall, back, true);
        check(&wall, ahead, false);
        // The corner comes nearer.
        check(&wall, turn, false);
        // Another obstacle is behind.
        let between = [&wall[..], &[(-0.35, 0.0)]].concat();
        check(&between, back, false);
        check(&[(0.35, 0.0)], ahead, false);
    }

    #[test]
    fn a_robot_off_the_map_or_on_unknown_cells_stays() {
        let mut unknown = costmap(&[]);
        unknown.fill(cost::UNKNOWN);
        let circle = Footprint::circle(0.2);
        let poses = [Pose2::IDENTITY, Pose2::new(0.1, 0.0, 0.0)];
        assert!(!is_motion_free(&unknown, &circle, &poses));
        let outside = poses.map(|pose| Pose2::new(5.0, 0.0, 0.0) * pose);
        assert!(!is_motion_free(&costmap(&[]), &circle, &outside));
        assert!(is_motion_free(&unknown, &circle, &[]));
    }
}
