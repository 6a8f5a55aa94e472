//! Oscillation, PreferForward and Twirling: scores of the command alone.
//!
//! Source: `oscillation.cpp`, `prefer_forward.cpp`, `twirling.cpp`.

use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_params::ParamValues;

use super::{CriticInput, IllegalTrajectory, TrajectoryCritic};
use crate::dwb::SampledTrajectory;
use crate::dwb::params::{OscillationCriticParams, PlainCriticParams, PreferForwardCriticParams};
use crate::path::distance_m;

/// Signs of the commands along one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct CommandTrend {
    /// Sign of the last command that was not zero.
    last: f64,
    /// Sign that is allowed; 0 for both.
    allowed: f64,
}

impl CommandTrend {
    /// Notes a command, and returns true if its sign has changed.
    fn update(&mut self, velocity: f64) -> bool {
        if velocity == 0.0 {
            return false;
        }
        let sign = velocity.signum();
        let has_flipped = self.last != 0.0 && self.last != sign;
        if has_flipped {
            self.allowed = sign;
        }
        self.last = sign;
        has_flipped
    }

    fn forbids(&self, velocity: f64) -> bool {
        self.allowed * velocity < 0.0
    }
}

/// Critic that forbids a sign of velocity after it has changed, until the robot has moved.
#[derive(Clone, Debug)]
pub struct OscillationCritic {
    params: OscillationCriticParams,
    x: CommandTrend,
    y: CommandTrend,
    theta: CommandTrend,
    pose: Pose2,
    time_ns: i64,
    /// Pose and time of the last change of a sign.
    changed: (Pose2, i64),
}

impl OscillationCritic {
    /// Creates the critic from values of [`crate::dwb::OSCILLATION_CRITIC`].
    #[must_use]
    pub fn new(values: &ParamValues) -> Self {
        Self {
            params: OscillationCriticParams::from_values(values),
            x: CommandTrend::default(),
            y: CommandTrend::default(),
            theta: CommandTrend::default(),
            pose: Pose2::IDENTITY,
            time_ns: 0,
            changed: (Pose2::IDENTITY, 0),
        }
    }

    fn has_moved(&self) -> bool {
        let params = &self.params;
        let (pose, time_ns) = self.changed;
        let exceeds = |value: f64, limit: f64| limit >= 0.0 && value > limit;
        let turned_rad = normalize_angle(self.pose.yaw_rad - pose.yaw_rad).abs();
        let elapsed_s = (self.time_ns - time_ns) as f64 / 1e9;
        exceeds(distance_m(self.pose, pose), params.oscillation_reset_dist_m)
            || exceeds(turned_rad, params.oscillation_reset_angle_rad)
            || exceeds(elapsed_s, params.oscillation_reset_time_s)
    }
}

impl TrajectoryCritic for OscillationCritic {
    fn prepare(&mut self, input: &CriticInput<'_>) -> bool {
        self.pose = input.pose;
        self.time_ns = input.time_ns;
        true
    }

    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.critic.scale
    }

    fn score(
        &self,
        _input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let velocity = trajectory.velocity;
        let is_forbidden = self.x.forbids(velocity.vx_m_s)
            || self.y.forbids(velocity.vy_m_s)
            || self.theta.forbids(velocity.wz_rad_s);
        if is_forbidden {
            return Err(IllegalTrajectory::new("Trajectory is oscillating."));
        }
        Ok(0.0)
    }

    fn debrief(&mut self, command: Twist2) {
        let mut has_changed = self.x.update(command.vx_m_s);
        let threshold_m_s = self.params.x_only_threshold_m_s;
        if threshold_m_s < 0.0 || command.vx_m_s.abs() <= threshold_m_s {
            has_changed |= self.y.update(command.vy_m_s);
            has_changed |= self.theta.update(command.wz_rad_s);
        }
        if has_changed {
            self.changed = (self.pose, self.time_ns);
        }
        let is_restricted = [self.x, self.y, self.theta].iter().any(|trend| trend.allowed != 0.0);
        if is_restricted && self.has_moved() {
            self.reset();
        }
    }

    fn reset(&mut self) {
        self.x = CommandTrend::default();
        self.y = CommandTrend::default();
        self.theta = CommandTrend::default();
    }
}

/// Critic that prefers to drive forwards.
#[derive(Clone, Debug)]
pub struct PreferForwardCritic {
    params: PreferForwardCriticParams,
}

impl PreferForwardCritic {
    /// Creates the critic from values of [`crate::dwb::PREFER_FORWARD_CRITIC`].
    #[must_use]
    pub fn new(values: &ParamValues) -> Self {
        Self { params: PreferForwardCriticParams::from_values(values) }
    }
}

impl TrajectoryCritic for PreferForwardCritic {
    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.critic.scale
    }

    fn score(
        &self,
        _input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        let Twist2 { vx_m_s, wz_rad_s, .. } = trajectory.velocity;
        let params = &self.params;
        let is_slow = vx_m_s < params.strafe_x_m_s && wz_rad_s.abs() < params.strafe_theta_rad_s;
        if vx_m_s < 0.0 || is_slow {
            return Ok(params.penalty);
        }
        Ok(wz_rad_s.abs() * params.theta_scale)
    }
}

/// Critic that prefers not to turn.
#[derive(Clone, Debug)]
pub struct TwirlingCritic {
    params: PlainCriticParams,
}

impl TwirlingCritic {
    /// Creates the critic from values of [`crate::dwb::PLAIN_CRITIC`].
    #[must_use]
    pub fn new(values: &ParamValues) -> Self {
        Self { params: PlainCriticParams::from_values(values) }
    }
}

impl TrajectoryCritic for TwirlingCritic {
    fn scale(&self, _input: &CriticInput<'_>) -> f64 {
        self.params.critic.scale
    }

    fn score(
        &self,
        _input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory> {
        Ok(trajectory.velocity.wz_rad_s.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dwb::OSCILLATION_CRITIC;

    /// Poses along x with commands of a turn rate; returns which turn rate is forbidden afterwards.
    fn check(commands: &[(f64, f64)], expected: Option<f64>) {
        let mut critic = OscillationCritic::new(&ParamValues::defaults(&OSCILLATION_CRITIC));
        for (x_m, rate) in commands {
            critic.pose = Pose2::new(*x_m, 0.0, 0.0);
            critic.debrief(Twist2::new(0.0, 0.0, *rate));
        }
        let forbidden = [-1.0, 1.0].into_iter().find(|rate| critic.theta.forbids(*rate));
        assert_eq!(forbidden, expected);
    }

    #[test]
    fn a_changed_sign_is_kept_until_the_robot_has_moved() {
        check(&[(0.0, 1.0), (0.0, 1.0)], None);
        check(&[(0.0, 1.0), (0.0, -1.0)], Some(1.0));
        check(&[(0.0, 1.0), (0.0, -1.0), (0.05, -1.0)], Some(1.0));
        check(&[(0.0, 1.0), (0.0, -1.0), (0.06, -1.0)], None);
    }
}
