//! Teleoperation that avoids collisions.

use periplus_geometry::{Pose2, Twist2};

/// Simulated motion of a teleoperated robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TeleopProjection {
    /// Time for which the motion is simulated \[s\].
    pub projection_time_s: f64,
    /// Step of the simulation \[s\].
    pub time_step_s: f64,
}

/// Scales a command by the time to a collision: a robot that collides at once stops, otherwise the
/// speed is reduced by the fraction of the simulated time without collision.
///
/// ```
/// use periplus_geometry::{Pose2, Twist2};
/// use periplus_motion::behaviors::{TeleopProjection, limit_teleop};
///
/// let projection = TeleopProjection { projection_time_s: 1.0, time_step_s: 0.25 };
/// let ahead = Twist2::new(1.0, 0.0, 0.0);
/// let command = limit_teleop(ahead, Pose2::IDENTITY, projection, |pose| pose.x_m < 0.6);
/// assert_eq!(command.vx_m_s, 0.75);
/// ```
#[must_use]
pub fn limit_teleop(
    command: Twist2,
    pose: Pose2,
    projection: TeleopProjection,
    mut is_free: impl FnMut(Pose2) -> bool,
) -> Twist2 {
    let step_s = projection.time_step_s;
    if step_s <= 0.0 {
        return if is_free(pose) { command } else { Twist2::ZERO };
    }
    let (mut pose, mut time_s) = (pose, step_s);
    while time_s < projection.projection_time_s {
        let (x, y) = pose.transform_point(command.vx_m_s * step_s, command.vy_m_s * step_s);
        pose = Pose2::new(x, y, pose.yaw_rad + command.wz_rad_s * step_s);
        if !is_free(pose) {
            let is_first = time_s == step_s;
            let factor = if is_first { 0.0 } else { time_s / projection.projection_time_s };
            return command.scaled(factor);
        }
        time_s += step_s;
    }
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn teleoperation_slows_down_before_obstacles() {
        let projection = TeleopProjection { projection_time_s: 1.0, time_step_s: 0.25 };
        let check = |command: (f64, f64, f64), is_free: fn(Pose2) -> bool, expected: f64| {
            let command = Twist2::new(command.0, command.1, command.2);
            let limited = limit_teleop(command, Pose2::IDENTITY, projection, is_free);
            assert_eq!(limited, command.scaled(expected));
        };
        check((1.0, 0.0, 0.0), |_| true, 1.0);
        check((1.0, 0.0, 0.0), |pose| pose.x_m < 0.4, 0.5);
        check((1.0, 0.0, 0.0), |_| false, 0.0);
        // The side to which it is commanded counts.
        check((0.0, 1.0, 0.0), |pose| pose.y_m < 0.4, 0.5);
        check((0.0, 1.0, 0.0), |pose| pose.y_m > -0.4, 1.0);
        check((0.0, 0.0, 1.0), |pose| pose.yaw_rad < 0.6, 0.75);
    }

    #[test]
    fn a_step_of_zero_checks_the_present_pose() {
        let projection = TeleopProjection { projection_time_s: 1.0, time_step_s: 0.0 };
        let ahead = Twist2::new(1.0, 0.0, 0.0);
        assert_eq!(limit_teleop(ahead, Pose2::IDENTITY, projection, |_| false), Twist2::ZERO);
        assert_eq!(limit_teleop(ahead, Pose2::IDENTITY, projection, |_| true), ahead);
    }
}
