//! Rewards of a step.

use periplus_geometry::Twist2;

use crate::parameters::NavigationRewardParams;
use crate::robot::EnvironmentRobot;

/// Names of the terms, in the order of [`reward_terms`].
pub const REWARD_TERMS: [&str; 6] =
    ["progress", "goal", "collision", "time", "turning", "clearance"];

/// State of an agent within its episode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AgentState {
    /// Driving to its goal.
    #[default]
    Driving,
    /// At its goal.
    Reached,
    /// Stopped by an obstacle or by another robot.
    Collided,
}

/// Result of a step, from which its reward is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepResult {
    /// Distance by which the robot came nearer to the goal \[m\].
    pub progress_m: f64,
    /// State after the step.
    pub state: AgentState,
    /// Velocity in the step.
    pub velocity: Twist2,
    /// Distance between footprint and obstacles, at most `clearance_distance` \[m\].
    pub clearance_m: f64,
}

/// Returns the terms of the reward, each already multiplied by its weight.
#[must_use]
pub fn reward_terms(
    result: &StepResult,
    robot: &EnvironmentRobot,
    weights: &NavigationRewardParams,
) -> [f64; 6] {
    let one_if = |condition: bool| if condition { 1.0 } else { 0.0 };
    [
        weights.progress * result.progress_m,
        weights.goal * one_if(result.state == AgentState::Reached),
        weights.collision * one_if(result.state == AgentState::Collided),
        weights.time,
        weights.turning * (result.velocity.wz_rad_s / robot.params().max_turn_rate_rad_s).abs(),
        weights.clearance * (1.0 - result.clearance_m / weights.clearance_distance_m).max(0.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::EnvironmentRobotParams;

    #[test]
    fn terms_are_weighted() {
        let robot = EnvironmentRobot::new(EnvironmentRobotParams::default()).expect("a robot");
        let weights = NavigationRewardParams {
            progress: 2.0,
            goal: 10.0,
            collision: -5.0,
            time: -0.5,
            turning: -1.0,
            clearance: -4.0,
            clearance_distance_m: 0.5,
        };
        let result = StepResult {
            progress_m: 0.25,
            state: AgentState::Reached,
            velocity: Twist2::new(0.5, 0.0, -0.75),
            clearance_m: 0.125,
        };
        // Half of the maximum turn rate of 1.5 rad/s; three quarters of the way to contact.
        assert_eq!(reward_terms(&result, &robot, &weights), [0.5, 10.0, 0.0, -0.5, -0.5, -3.0]);
        let hit = StepResult { state: AgentState::Collided, clearance_m: 0.0, ..result };
        assert_eq!(reward_terms(&hit, &robot, &weights), [0.5, 0.0, -5.0, -0.5, -0.5, -4.0]);
    }
}
