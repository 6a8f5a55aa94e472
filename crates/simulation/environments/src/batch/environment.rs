//! One environment: its episodes and its agents.

use periplus_geometry::{Pose2, Stream, Twist2};

use super::{NavigationSettings, Scratch};
use crate::free_space::StartAndGoal;
use crate::plane::squared_distance;
use crate::reward::{AgentState, StepResult, reward_terms};
use crate::world::NavigationWorld;

/// Number of starts that are drawn for a robot until one is far from the robots before it.
const MAX_START_DRAW_COUNT: usize = 256;
/// Minimum gap between two robots at the start \[m\].
const MIN_START_GAP_M: f64 = 0.2;

/// Phase of an environment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Phase {
    /// Never reset.
    #[default]
    New,
    /// In an episode.
    Running,
    /// After the end of an episode.
    Ended,
}

/// State of an environment without its agents.
#[derive(Clone, Debug, Default)]
pub(super) struct EnvironmentRecord {
    pub(super) seed: u64,
    /// Number of the episode since the seed was set.
    pub(super) episode: u64,
    pub(super) steps: usize,
    /// Index of the world.
    pub(super) world: usize,
    pub(super) phase: Phase,
}

impl EnvironmentRecord {
    pub(super) fn seed_with(&mut self, seed: u64) {
        (self.seed, self.episode) = (seed, 0);
    }

    pub(super) fn next_episode(&mut self) {
        if self.phase != Phase::New {
            self.episode += 1;
        }
    }

    /// Stream of random numbers of this step for a purpose.
    pub(super) fn stream(&self, name: &str, agent: usize) -> Stream {
        let mut keyed = Stream::keyed(self.seed, name, self.episode);
        let mut draw = Stream::keyed(keyed.bits(), name, agent as u64);
        Stream::keyed(draw.bits(), name, self.steps as u64)
    }
}

/// A robot in an environment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agent {
    /// Pose in the world.
    pub pose: Pose2,
    /// Velocity in its own frame.
    pub velocity: Twist2,
    /// Start of the episode.
    pub start: Pose2,
    /// Goal \[m\].
    pub goal_m: [f64; 2],
    /// Distance to the goal \[m\].
    pub goal_distance_m: f64,
    /// Length of the path since the start \[m\].
    pub path_length_m: f64,
    /// Distance between footprint and obstacles, at most the `clearance_distance` of the reward \[m\].
    pub clearance_m: f64,
    /// State.
    pub state: AgentState,
    /// Last action; zeros after a reset.
    pub action: [f32; 3],
    /// Terms of the last reward, weighted.
    pub reward_terms: [f64; 6],
}

impl Agent {
    /// Distance from a point to the goal \[m\].
    fn distance_from_m(&self, pose: Pose2) -> f64 {
        squared_distance([pose.x_m, pose.y_m], self.goal_m).sqrt()
    }

    pub(super) fn set_goal(&mut self, goal_m: [f64; 2]) {
        self.goal_m = goal_m;
        self.goal_distance_m = self.distance_from_m(self.pose);
    }

    /// Sets the start; returns false in collision.
    pub(super) fn set_start(
        &mut self,
        start: Pose2,
        settings: &NavigationSettings,
        world: &NavigationWorld,
        scratch: &mut Scratch,
    ) -> bool {
        (self.start, self.pose) = (start, start);
        self.goal_distance_m = self.distance_from_m(start);
        let placed = settings.robot.footprint().placed(start, &mut scratch.corners);
        if world.obstacles().distance_to_footprint_m(&placed, f64::MIN_POSITIVE) == 0.0 {
            return false;
        }
        self.clearance_m = clearance_m(start, settings, world, scratch);
        true
    }
}

/// Draws the world, the starts and the goals of an episode.
pub(super) fn reset(
    record: &mut EnvironmentRecord,
    agents: &mut [Agent],
    settings: &NavigationSettings,
    scratch: &mut Scratch,
) {
    (record.steps, record.phase) = (0, Phase::Running);
    let mut stream = record.stream("navigation episode", 0);
    let count = settings.worlds.len();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "worlds are few"
    )]
    let chosen = ((stream.unit() * count as f64) as usize).min(count - 1);
    record.world = chosen;
    let world = &settings.worlds[record.world];
    let gap_m = 2.0 * settings.robot.footprint().circumscribed_radius_m() + MIN_START_GAP_M;
    for at in 0..agents.len() {
        let (before, rest) = agents.split_at_mut(at);
        let is_apart = |drawn: &StartAndGoal| {
            let apart_m = |from: [f64; 2], to: [f64; 2]| squared_distance(from, to).sqrt();
            before.iter().all(|other| {
                let start = [drawn.start.x_m, drawn.start.y_m];
                apart_m(start, [other.start.x_m, other.start.y_m]) > gap_m
                    && apart_m(drawn.goal_m, other.goal_m) > gap_m
            })
        };
        let (min_m, max_m) = (settings.task.min_goal_distance_m, settings.task.max_goal_distance_m);
        let mut draw = || world.free_space().draw(&mut stream, min_m, max_m);
        let mut drawn = draw();
        for _ in 0..MAX_START_DRAW_COUNT {
            if drawn.as_ref().is_none_or(is_apart) {
                break;
            }
            drawn = draw();
        }
        let nowhere = StartAndGoal { start: Pose2::IDENTITY, goal_m: [0.0; 2] };
        let StartAndGoal { start, goal_m } = drawn.unwrap_or(nowhere);
        rest[0] = Agent { start, goal_m, ..Agent::default() };
        rest[0].set_start(start, settings, world, scratch);
    }
}

/// Arrays of one environment: an entry for each agent.
pub(super) struct EnvironmentOutputs<'a> {
    pub(super) rewards: &'a mut [f64],
    pub(super) terminated: &'a mut [bool],
    pub(super) truncated: &'a mut [bool],
}

/// Steps an environment, or resets it after the end of an episode.
pub(super) fn step(
    record: &mut EnvironmentRecord,
    agents: &mut [Agent],
    actions: &[f32],
    settings: &NavigationSettings,
    scratch: &mut Scratch,
    outputs: EnvironmentOutputs<'_>,
) {
    outputs.rewards.fill(0.0);
    outputs.terminated.fill(false);
    outputs.truncated.fill(false);
    if record.phase == Phase::Ended && settings.resets_in_next_step {
        record.next_episode();
        reset(record, agents, settings, scratch);
        return;
    }
    record.steps += 1;
    let world = &*settings.worlds[record.world];
    for at in 0..agents.len() {
        if agents[at].state == AgentState::Driving {
            let action = &actions[at * settings.robot.action_size()..];
            drive(&mut agents[at], action, settings, world, scratch);
        } else {
            // An agent that has arrived, or was stopped before, gets nothing more.
            agents[at].velocity = Twist2::ZERO;
            agents[at].reward_terms = [0.0; 6];
        }
    }
    if agents.len() > 1 {
        collide_with_each_other(agents, settings, scratch);
    }
    let is_cut = record.steps >= settings.task.max_steps;
    for (at, agent) in agents.iter_mut().enumerate() {
        outputs.terminated[at] = agent.state != AgentState::Driving;
        // Also of an episode that ends in its last step, as gymnasium's `TimeLimit` does.
        outputs.truncated[at] = is_cut;
        outputs.rewards[at] = agent.reward_terms.iter().sum();
    }
    if is_cut || agents.iter().all(|agent| agent.state != AgentState::Driving) {
        record.phase = Phase::Ended;
    }
}

/// Moves one agent and computes its state and reward.
fn drive(
    agent: &mut Agent,
    action: &[f32],
    settings: &NavigationSettings,
    world: &NavigationWorld,
    scratch: &mut Scratch,
) {
    let (robot, dt_s) = (&settings.robot, settings.task.step_period_s);
    let count = robot.action_size();
    for (kept, given) in agent.action.iter_mut().zip(&action[..count]) {
        *kept = given.clamp(-1.0, 1.0);
    }
    let command = robot.commanded(&agent.action[..count]);
    agent.velocity = robot.accelerated(agent.velocity, command, dt_s);
    let motion = robot.moved(world, agent.pose, agent.velocity, dt_s, &mut scratch.corners);
    let (from, to) = ([agent.pose.x_m, agent.pose.y_m], [motion.end.x_m, motion.end.y_m]);
    agent.path_length_m += squared_distance(from, to).sqrt();
    agent.pose = motion.end;
    let before_m = agent.goal_distance_m;
    agent.goal_distance_m = agent.distance_from_m(agent.pose);
    agent.state = if motion.is_collision {
        AgentState::Collided
    } else if agent.goal_distance_m <= settings.task.goal_tolerance_m {
        AgentState::Reached
    } else {
        AgentState::Driving
    };
    agent.clearance_m =
        if motion.is_collision { 0.0 } else { clearance_m(agent.pose, settings, world, scratch) };
    let result = StepResult {
        progress_m: before_m - agent.goal_distance_m,
        state: agent.state,
        velocity: agent.velocity,
        clearance_m: agent.clearance_m,
    };
    agent.reward_terms = reward_terms(&result, robot, &settings.reward);
}

fn clearance_m(
    pose: Pose2,
    settings: &NavigationSettings,
    world: &NavigationWorld,
    scratch: &mut Scratch,
) -> f64 {
    let max_m = settings.reward.clearance_distance_m;
    let footprint = settings.robot.footprint();
    let nearest_m = world.free_space().min_distance_m([pose.x_m, pose.y_m]);
    if nearest_m - footprint.circumscribed_radius_m() >= max_m {
        return max_m;
    }
    let placed = footprint.placed(pose, &mut scratch.corners);
    world.obstacles().distance_to_footprint_m(&placed, max_m)
}

/// Stops the agents whose footprints overlap, those at their goals excepted.
fn collide_with_each_other(
    agents: &mut [Agent],
    settings: &NavigationSettings,
    scratch: &mut Scratch,
) {
    let footprint = settings.robot.footprint();
    for one in 1..agents.len() {
        for other in 0..one {
            let (a, b) = (agents[one], agents[other]);
            let is_present = |agent: &Agent| agent.state != AgentState::Reached;
            let (from, to) = ([a.pose.x_m, a.pose.y_m], [b.pose.x_m, b.pose.y_m]);
            let reach_m = 2.0 * footprint.circumscribed_radius_m();
            if !is_present(&a) || !is_present(&b) || squared_distance(from, to).sqrt() > reach_m {
                continue;
            }
            let placed = footprint.placed(a.pose, &mut scratch.corners);
            let met = footprint.placed(b.pose, &mut scratch.other_corners);
            if placed.distance_to_footprint_m(&met) == 0.0 {
                for at in [one, other] {
                    if agents[at].state == AgentState::Driving {
                        agents[at].state = AgentState::Collided;
                        agents[at].clearance_m = 0.0;
                        agents[at].reward_terms[2] += settings.reward.collision;
                    }
                }
            }
        }
    }
}
