//! Simulated trajectories.
//!
//! Source: `standard_traj_generator.cpp`, `limited_accel_generator.cpp`, `trajectory_utils.cpp`.

use periplus_geometry::{Pose2, Twist2, normalize_angle};

use super::{KinematicLimits, TrajectoryParams};

/// Maximum number of steps of a trajectory.
const MAX_STEP_COUNT: usize = 100_000;

/// A trajectory with its command.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledTrajectory {
    /// Velocity that is commanded.
    pub velocity: Twist2,
    /// Poses from the present one on.
    pub poses: Vec<Pose2>,
    /// Times of the poses \[s\]; one fewer than poses.
    pub times_s: Vec<f64>,
}

impl SampledTrajectory {
    /// Returns the heading at a time \[s\], interpolated between poses.
    #[must_use]
    pub fn heading_at(&self, time_s: f64) -> Option<f64> {
        let (first, last) = (self.poses.first()?, self.poses.last()?);
        if self.times_s.first().is_none_or(|start_s| time_s <= *start_s) {
            return Some(first.yaw_rad);
        }
        let Some(index) = self.times_s.windows(2).position(|pair| time_s < pair[1]) else {
            return Some(last.yaw_rad);
        };
        let (start_s, end_s) = (self.times_s[index], self.times_s[index + 1]);
        let (start, end) = (self.poses[index], self.poses[index + 1]);
        let part = (time_s - start_s) / (end_s - start_s);
        Some(start.yaw_rad + part * normalize_angle(end.yaw_rad - start.yaw_rad))
    }
}

/// Rule by which velocities change along a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrajectoryGenerator {
    /// The velocity approaches the command within the accelerations (`StandardTrajectoryGenerator`).
    Standard,
    /// The command is reached within a control period, and kept (`LimitedAccelGenerator`).
    LimitedAccel,
}

impl TrajectoryGenerator {
    /// Classes with their generators.
    pub const CLASSES: [(&str, Self); 2] = [
        ("dwb_plugins::StandardTrajectoryGenerator", Self::Standard),
        ("dwb_plugins::LimitedAccelGenerator", Self::LimitedAccel),
    ];

    /// Returns the generator of a class, `package::Class` or `package/Class`.
    #[must_use]
    pub fn of_class(class: &str) -> Option<Self> {
        let class = class.trim().replace('/', "::");
        Self::CLASSES.iter().find(|(known, _)| *known == class).map(|(_, generator)| *generator)
    }

    /// Returns the velocities whose trajectories are simulated.
    #[must_use]
    pub fn samples(
        self,
        params: &TrajectoryParams,
        limits: &KinematicLimits,
        present: Twist2,
        control_period_s: f64,
    ) -> Vec<Twist2> {
        let time_s = match self {
            Self::Standard => params.sim_time_s,
            Self::LimitedAccel => params.sim_period_s.unwrap_or(control_period_s),
        };
        let counts = [params.vx_samples, params.vy_samples, params.vtheta_samples];
        limits.samples(present, time_s, counts)
    }

    /// Simulates the trajectory of a command from a pose and a velocity.
    #[must_use]
    pub fn simulate(
        self,
        params: &TrajectoryParams,
        limits: &KinematicLimits,
        start: Pose2,
        present: Twist2,
        command: Twist2,
    ) -> SampledTrajectory {
        let count = step_count(params, command);
        let step_s = params.sim_time_s / count as f64;
        let mut trajectory = SampledTrajectory {
            velocity: command,
            poses: Vec::with_capacity(count + 2),
            times_s: Vec::with_capacity(count + 1),
        };
        let (mut pose, mut velocity) = (start, present);
        let mut time_s = 0.0;
        trajectory.poses.push(pose);
        for index in 0..count {
            velocity = match self {
                Self::Standard => Twist2::new(
                    limits.x.approach(velocity.vx_m_s, step_s, command.vx_m_s),
                    limits.y.approach(velocity.vy_m_s, step_s, command.vy_m_s),
                    limits.theta.approach(velocity.wz_rad_s, step_s, command.wz_rad_s),
                ),
                Self::LimitedAccel => command,
            };
            if index == 0 && params.limit_vel_cmd_in_traj {
                trajectory.velocity = velocity;
            }
            pose = moved(pose, velocity, step_s);
            trajectory.poses.push(pose);
            trajectory.times_s.push(time_s);
            time_s += step_s;
        }
        if params.include_last_point {
            trajectory.poses.push(pose);
            trajectory.times_s.push(time_s);
        }
        trajectory
    }
}

/// Returns the number of steps of the trajectory of a command.
#[must_use]
pub fn step_count(params: &TrajectoryParams, command: Twist2) -> usize {
    let count = if params.discretize_by_time {
        params.sim_time_s / params.time_granularity_s
    } else {
        let length_m = command.speed_m_s() * params.sim_time_s;
        let angle_rad = command.wz_rad_s.abs() * params.sim_time_s;
        (length_m / params.linear_granularity_m).max(angle_rad / params.angular_granularity_rad)
    };
    (libm::ceil(count) as usize).clamp(1, MAX_STEP_COUNT)
}

/// Returns a pose after a step \[s\]: the translation with the heading before.
#[must_use]
pub(crate) fn moved(pose: Pose2, velocity: Twist2, step_s: f64) -> Pose2 {
    let (sine, cosine) = libm::sincos(pose.yaw_rad);
    let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
    Pose2::new(
        pose.x_m + (vx_m_s * cosine - vy_m_s * sine) * step_s,
        pose.y_m + (vx_m_s * sine + vy_m_s * cosine) * step_s,
        pose.yaw_rad + wz_rad_s * step_s,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dwb::DwbParams;

    fn params() -> TrajectoryParams {
        TrajectoryParams {
            sim_time_s: 1.0,
            linear_granularity_m: 0.25,
            angular_granularity_rad: 0.5,
            ..DwbParams::default().trajectories
        }
    }

    fn limits() -> KinematicLimits {
        let mut limits = KinematicLimits::new(&DwbParams::default().kinematics);
        for axis in [&mut limits.x, &mut limits.y, &mut limits.theta] {
            (axis.acceleration, axis.deceleration) = (1.0, -1.0);
        }
        limits
    }

    #[test]
    fn the_finer_granularity_decides() {
        let count = |x, theta| step_count(&params(), Twist2::new(x, 0.0, theta));
        assert_eq!([count(0.5, 0.0), count(0.5, 2.0), count(0.0, 0.0)], [2, 4, 1]);
    }

    #[test]
    fn velocities_approach_the_command() {
        let command = Twist2::new(1.0, 0.0, 0.0);
        let run = |generator: TrajectoryGenerator| {
            generator.simulate(&params(), &limits(), Pose2::IDENTITY, Twist2::ZERO, command)
        };
        let standard = run(TrajectoryGenerator::Standard);
        // 0.25, 0.5, 0.75 and 1 m/s for a quarter of a second each.
        let xs: Vec<f64> = standard.poses.iter().map(|pose| pose.x_m).collect();
        assert_eq!(xs, [0.0, 0.0625, 0.1875, 0.375, 0.625, 0.625]);
        assert_eq!(standard.times_s, [0.0, 0.25, 0.5, 0.75, 1.0]);
        let limited = run(TrajectoryGenerator::LimitedAccel);
        assert_eq!(limited.poses[4].x_m, 1.0);
    }

    #[test]
    fn headings_are_interpolated() {
        let command = Twist2::new(0.0, 0.0, 1.0);
        let trajectory = TrajectoryGenerator::LimitedAccel.simulate(
            &params(),
            &limits(),
            Pose2::IDENTITY,
            Twist2::ZERO,
            command,
        );
        let heading = |time_s| trajectory.heading_at(time_s).unwrap();
        assert_eq!([heading(-1.0), heading(0.25), heading(9.0)], [0.0, 0.25, 1.0]);
    }
}
