//! Yaws at the end of a path.

use periplus_geometry::Pose2;

/// Distance below which two poses count as equal \[m\].
const EQUAL_POSES_M: f64 = 1e-4;

/// Returns the only pose of a path whose start and goal are at one point.
pub(crate) fn single_pose(start: Pose2, goal: Pose2, keeps_start_yaw: bool) -> Pose2 {
    let yaw_rad = if keeps_start_yaw { start.yaw_rad } else { goal.yaw_rad };
    Pose2 { yaw_rad, ..start }
}

/// Returns the direction of travel at the end of a path \[rad\]; none for a single pose.
pub(crate) fn approach_yaw_rad(poses: &[Pose2]) -> Option<f64> {
    let (last, before) = match poses {
        [.., earlier, before, last] => {
            let is_doubled = (last.x_m - before.x_m).abs() < EQUAL_POSES_M
                && (last.y_m - before.y_m).abs() < EQUAL_POSES_M;
            (last, if is_doubled { earlier } else { before })
        }
        [before, last] => (last, before),
        _ => return None,
    };
    Some(libm::atan2(last.y_m - before.y_m, last.x_m - before.x_m))
}
