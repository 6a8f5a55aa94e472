//! Trajectories of the local planners of ROS 1.
//!
//! Source: `simple_trajectory_generator.cpp`, `velocity_iterator.h`.

use periplus_geometry::{Pose2, Twist2};

use crate::dwb::{SampledTrajectory, moved};

/// Maximum number of steps of a trajectory.
const MAX_STEP_COUNT: usize = 100_000;

/// Returns evenly spaced velocities from a minimum to a maximum, at least two if there is a range. Zero is inserted
/// between a negative and a positive one.
pub(super) fn spread(min: f64, max: f64, count: usize) -> Vec<f64> {
    if min >= max {
        return vec![max];
    }
    let steps = count.max(2) - 1;
    let step = (max - min) / steps as f64;
    let mut samples = Vec::with_capacity(steps + 2);
    let mut next = min;
    for _ in 0..steps {
        let present = next;
        next += step;
        samples.push(present);
        if present < 0.0 && next > 0.0 {
            samples.push(0.0);
        }
    }
    samples.push(max);
    samples
}

/// Returns a velocity after a step towards a target.
fn approach(present: f64, target: f64, acceleration: f64, step_s: f64) -> f64 {
    if present < target {
        target.min(present + acceleration * step_s)
    } else {
        target.max(present - acceleration * step_s)
    }
}

/// Returns a velocity after a step towards a command; the accelerations are along x, y and around z.
pub(super) fn approach_command(
    present: Twist2,
    command: Twist2,
    accelerations: Twist2,
    step_s: f64,
) -> Twist2 {
    Twist2::new(
        approach(present.vx_m_s, command.vx_m_s, accelerations.vx_m_s, step_s),
        approach(present.vy_m_s, command.vy_m_s, accelerations.vy_m_s, step_s),
        approach(present.wz_rad_s, command.wz_rad_s, accelerations.wz_rad_s, step_s),
    )
}

/// Inputs of a trajectory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rollout {
    pub start: Pose2,
    pub present: Twist2,
    /// Accelerations by which the velocity approaches the command; none if it is reached at once.
    pub accelerations: Option<Twist2>,
    /// Duration \[s\].
    pub time_s: f64,
    /// Number of steps, at least 1.
    pub count: usize,
}

impl Rollout {
    /// Returns the trajectory of a command: the poses before each step.
    pub(super) fn run(&self, command: Twist2) -> SampledTrajectory {
        let count = self.count.clamp(1, MAX_STEP_COUNT);
        let step_s = self.time_s / count as f64;
        let mut trajectory = SampledTrajectory {
            velocity: command,
            poses: Vec::with_capacity(count),
            times_s: Vec::with_capacity(count),
        };
        let (mut pose, mut velocity) = (self.start, command);
        if self.accelerations.is_some() {
            velocity = self.present;
        }
        for index in 0..count {
            trajectory.poses.push(pose);
            trajectory.times_s.push(index as f64 * step_s);
            if let Some(accelerations) = self.accelerations {
                velocity = approach_command(velocity, command, accelerations, step_s);
            }
            pose = moved(pose, velocity, step_s);
        }
        trajectory
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_are_spread_with_zero() {
        assert_eq!(spread(-1.0, 1.0, 3), [-1.0, 0.0, 1.0]);
        assert_eq!(spread(-1.0, 1.0, 2), [-1.0, 0.0, 1.0]);
        assert_eq!(spread(0.2, 0.2, 5), [0.2]);
        assert_eq!(spread(0.0, 1.0, 0), [0.0, 1.0]);
    }

    #[test]
    fn a_trajectory_has_the_poses_before_each_step() {
        let rollout = Rollout {
            start: Pose2::IDENTITY,
            present: Twist2::ZERO,
            accelerations: None,
            time_s: 1.0,
            count: 4,
        };
        let xs = |rollout: Rollout| {
            let trajectory = rollout.run(Twist2::new(1.0, 0.0, 0.0));
            trajectory.poses.iter().map(|pose| pose.x_m).collect::<Vec<_>>()
        };
        assert_eq!(xs(rollout), [0.0, 0.25, 0.5, 0.75]);
        let accelerations = Some(Twist2::new(1.0, 1.0, 1.0));
        assert_eq!(xs(Rollout { accelerations, ..rollout }), [0.0, 0.0625, 0.1875, 0.375]);
    }
}
