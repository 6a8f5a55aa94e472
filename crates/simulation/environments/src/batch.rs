//! Many environments, stepped together.

mod environment;
mod observe;

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use periplus_geometry::Pose2;
use periplus_raycast::Ray;

pub use environment::Agent;

use self::environment::{EnvironmentOutputs, EnvironmentRecord, Phase};
use crate::observation::{ObservationError, ObservationSlice, observation_layout};
use crate::parameters::{NavigationRewardParams, NavigationTaskParams};
use crate::robot::EnvironmentRobot;
use crate::world::NavigationWorld;

/// Number of chunks of work for each thread, so that no thread waits long for another.
const CHUNKS_PER_THREAD: usize = 4;

/// Settings that all environments of a batch share.
#[derive(Clone, Debug)]
pub struct NavigationSettings {
    /// Worlds; each episode is in one of them, drawn at random.
    pub worlds: Vec<Arc<NavigationWorld>>,
    /// Robot.
    pub robot: EnvironmentRobot,
    /// Task.
    pub task: NavigationTaskParams,
    /// Weights of the reward.
    pub reward: NavigationRewardParams,
    /// Number of robots in each environment, which see each other and can collide.
    pub agents: usize,
    /// Autoreset as gymnasium's `NEXT_STEP`: the step after the end of an episode ignores the action and resets.
    pub resets_in_next_step: bool,
}

/// Environments that are stepped together. Each has its own seed; results do not depend on the number of threads.
///
/// Arrays have one row for each agent, environment by environment.
#[derive(Debug)]
pub struct NavigationBatch {
    settings: NavigationSettings,
    layout: Vec<ObservationSlice>,
    environments: Vec<EnvironmentRecord>,
    agents: Vec<Agent>,
    /// Storage of each thread.
    scratch: Vec<Scratch>,
}

/// Storage of a thread, so that a step allocates nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    rays: Vec<Ray>,
    ranges: Vec<f32>,
    corners: Vec<[f64; 2]>,
    other_corners: Vec<[f64; 2]>,
}

/// Arrays into which a step is written: a row for each agent.
#[derive(Debug)]
pub struct StepOutputs<'a> {
    /// Observations, row by row.
    pub observations: &'a mut [f32],
    /// Rewards.
    pub rewards: &'a mut [f64],
    /// True if the episode ended at the goal or in a collision.
    pub terminated: &'a mut [bool],
    /// True if the episode was cut off after the maximum number of steps.
    pub truncated: &'a mut [bool],
}

/// Selection of the environments to reset, and their starts.
#[derive(Clone, Copy, Debug, Default)]
pub struct ResetRequest<'a> {
    /// Seed of each environment; without seeds the next episodes follow.
    pub seeds: Option<&'a [u64]>,
    /// True for the environments to reset; all without a mask.
    pub mask: Option<&'a [bool]>,
    /// Start of each agent in the world instead of a random one.
    pub starts: Option<&'a [Pose2]>,
    /// Goal of each agent in the world instead of a random one \[m\].
    pub goals_m: Option<&'a [[f64; 2]]>,
}

/// Reasons that a batch cannot be made, reset or stepped.
#[derive(Clone, Debug, PartialEq)]
pub enum BatchError {
    /// No world, no environment or no agent.
    Empty(&'static str),
    /// The names of the observation are wrong.
    Observation(ObservationError),
    /// An array has the wrong length: its name, length and the length that is needed.
    Length(&'static str, usize, usize),
    /// A number of an array is not finite: its name and index.
    NotFinite(&'static str, usize),
    /// A start is in collision: the index of its agent.
    StartInCollision(usize),
    /// An environment was stepped before its first reset: its index.
    NotReset(usize),
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty(what) => write!(f, "there must be at least one {what}"),
            Self::Observation(error) => error.fmt(f),
            Self::Length(name, found, needed) => {
                write!(f, "`{name}` has {found} entries, not {needed}")
            }
            Self::NotFinite(name, at) => write!(f, "entry {at} of `{name}` is not finite"),
            Self::StartInCollision(agent) => {
                write!(f, "the start of agent {agent} is in collision; choose a free one")
            }
            Self::NotReset(environment) => {
                write!(f, "environment {environment} has not been reset: call reset() first")
            }
        }
    }
}

impl std::error::Error for BatchError {}

impl NavigationBatch {
    /// Creates `count` environments that are stepped by this many threads.
    ///
    /// # Errors
    /// When there is no world, environment or agent, or the observation is unknown.
    pub fn new(
        settings: NavigationSettings,
        count: usize,
        threads: usize,
    ) -> Result<Self, BatchError> {
        for (number, what) in
            [(settings.worlds.len(), "world"), (count, "environment"), (settings.agents, "agent")]
        {
            if number == 0 {
                return Err(BatchError::Empty(what));
            }
        }
        let layout =
            observation_layout(&settings.robot, &settings.task).map_err(BatchError::Observation)?;
        let environments = vec![EnvironmentRecord::default(); count];
        let agents = vec![Agent::default(); count * settings.agents];
        let scratch = vec![Scratch::default(); threads.max(1)];
        Ok(Self { settings, layout, environments, agents, scratch })
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &NavigationSettings {
        &self.settings
    }

    /// Returns the parts of an observation.
    #[must_use]
    pub fn layout(&self) -> &[ObservationSlice] {
        &self.layout
    }

    /// Returns the number of numbers in an observation.
    #[must_use]
    pub fn observation_size(&self) -> usize {
        self.layout.last().map_or(0, |last| last.start + last.low.len())
    }

    /// Returns the number of environments.
    #[must_use]
    pub fn environment_count(&self) -> usize {
        self.environments.len()
    }

    /// Returns all agents, environment by environment.
    #[must_use]
    pub fn agents(&self) -> &[Agent] {
        &self.agents
    }

    /// Returns the world of an environment's episode.
    #[must_use]
    pub fn world_of(&self, environment: usize) -> &Arc<NavigationWorld> {
        &self.settings.worlds[self.environments[environment].world]
    }

    /// Returns the number of steps in an environment's episode.
    #[must_use]
    pub fn steps_of(&self, environment: usize) -> usize {
        self.environments[environment].steps
    }

    /// Returns the distance between the footprint at a pose and the obstacles in the world of an environment, at most
    /// `max_m` \[m\]; zero in collision.
    #[must_use]
    pub fn clearance_m(&self, environment: usize, world_from_base: Pose2, max_m: f64) -> f64 {
        let mut corners = Vec::new();
        let placed = self.settings.robot.footprint().placed(world_from_base, &mut corners);
        self.world_of(environment).obstacles().distance_to_footprint_m(&placed, max_m)
    }

    /// Resets environments and writes the first observations of their episodes; other rows keep their values.
    ///
    /// # Errors
    /// When an array has a wrong length, a number is not finite or a start is in collision.
    pub fn reset(
        &mut self,
        request: ResetRequest<'_>,
        observations: &mut [f32],
    ) -> Result<(), BatchError> {
        let (count, agents) = (self.environments.len(), self.agents.len());
        check_length("observations", observations.len(), agents * self.observation_size())?;
        check_length("seeds", request.seeds.map_or(count, <[u64]>::len), count)?;
        check_length("mask", request.mask.map_or(count, <[bool]>::len), count)?;
        check_length("starts", request.starts.map_or(agents, <[Pose2]>::len), agents)?;
        check_length("goals", request.goals_m.map_or(agents, <[[f64; 2]]>::len), agents)?;
        if let Some(at) = request.starts.and_then(|all| all.iter().position(|it| !it.is_finite())) {
            return Err(BatchError::NotFinite("starts", at));
        }
        let is_infinite = |goal: &[f64; 2]| !goal.iter().all(|it| it.is_finite());
        if let Some(at) = request.goals_m.and_then(|all| all.iter().position(is_infinite)) {
            return Err(BatchError::NotFinite("goals", at));
        }
        let row = self.settings.agents * self.observation_size();
        for at in (0..count).filter(|at| request.mask.is_none_or(|mask| mask[*at])) {
            self.reset_environment(at, &request)?;
            let chunk = &mut observations[at * row..(at + 1) * row];
            let rows = at * self.settings.agents..(at + 1) * self.settings.agents;
            let (record, agents) = (&self.environments[at], &self.agents[rows]);
            observe::write_all(
                record,
                agents,
                &self.settings,
                &self.layout,
                &mut self.scratch[0],
                chunk,
            );
        }
        Ok(())
    }

    fn reset_environment(
        &mut self,
        environment: usize,
        request: &ResetRequest<'_>,
    ) -> Result<(), BatchError> {
        let Self { settings, environments, agents, scratch, .. } = self;
        let (record, scratch) = (&mut environments[environment], &mut scratch[0]);
        match request.seeds {
            Some(seeds) => record.seed_with(seeds[environment]),
            None => record.next_episode(),
        }
        let rows = environment * settings.agents..(environment + 1) * settings.agents;
        let agents = &mut agents[rows.clone()];
        environment::reset(record, agents, settings, scratch);
        let world = &settings.worlds[record.world];
        for (row, agent) in rows.zip(agents) {
            if let Some(goals_m) = request.goals_m {
                agent.set_goal(goals_m[row]);
            }
            if let Some(starts) = request.starts
                && !agent.set_start(starts[row], settings, world, scratch)
            {
                record.phase = Phase::New;
                return Err(BatchError::StartInCollision(row));
            }
        }
        Ok(())
    }

    /// Steps all environments with one action for each agent, numbers from -1 to 1.
    ///
    /// # Errors
    /// When an array has a wrong length, an action is not finite, or an environment was never reset.
    pub fn step(&mut self, actions: &[f32], outputs: StepOutputs<'_>) -> Result<(), BatchError> {
        let (environment_count, agents) = (self.environments.len(), self.agents.len());
        let action_size = self.settings.robot.action_size();
        let StepOutputs { observations, rewards, terminated, truncated } = outputs;
        check_length("actions", actions.len(), agents * action_size)?;
        check_length("observations", observations.len(), agents * self.observation_size())?;
        check_length("rewards", rewards.len(), agents)?;
        check_length("terminated", terminated.len(), agents)?;
        check_length("truncated", truncated.len(), agents)?;
        if let Some(at) = actions.iter().position(|action| !action.is_finite()) {
            return Err(BatchError::NotFinite("actions", at));
        }
        if let Some(at) = self.environments.iter().position(|it| it.phase == Phase::New) {
            return Err(BatchError::NotReset(at));
        }
        let Self { settings, layout, environments, agents, scratch, .. } = self;
        let (settings, layout) = (&*settings, &**layout);
        let (rows, chunk) =
            (settings.agents, environments.len().div_ceil(scratch.len() * CHUNKS_PER_THREAD));
        let columns = layout.last().map_or(0, |last| last.start + last.low.len());
        let work = Mutex::new(
            environments
                .chunks_mut(chunk)
                .zip(agents.chunks_mut(chunk * rows))
                .zip(actions.chunks(chunk * rows * action_size))
                .zip(observations.chunks_mut(chunk * rows * columns))
                .zip(rewards.chunks_mut(chunk * rows))
                .zip(terminated.chunks_mut(chunk * rows))
                .zip(truncated.chunks_mut(chunk * rows)),
        );
        let next = || work.lock().unwrap_or_else(PoisonError::into_inner).next();
        let help = |scratch: &mut Scratch| {
            while let Some((
                (((((records, agents), actions), observations), rewards), ends),
                cuts,
            )) = next()
            {
                let each = records
                    .iter_mut()
                    .zip(agents.chunks_mut(rows))
                    .zip(actions.chunks(rows * action_size))
                    .zip(observations.chunks_mut(rows * columns))
                    .zip(rewards.chunks_mut(rows))
                    .zip(ends.chunks_mut(rows))
                    .zip(cuts.chunks_mut(rows));
                for ((((((record, agents), actions), observations), rewards), ends), cuts) in each {
                    let outcome = EnvironmentOutputs { rewards, terminated: ends, truncated: cuts };
                    environment::step(record, agents, actions, settings, scratch, outcome);
                    observe::write_all(record, agents, settings, layout, scratch, observations);
                }
            }
        };
        let (first, others) = scratch.split_at_mut(1);
        if others.is_empty() || environment_count < 2 {
            help(&mut first[0]);
            return Ok(());
        }
        std::thread::scope(|scope| {
            for scratch in others.iter_mut().take(environment_count.div_ceil(chunk) - 1) {
                scope.spawn(|| help(scratch));
            }
            help(&mut first[0]);
        });
        Ok(())
    }
}

fn check_length(name: &'static str, found: usize, needed: usize) -> Result<(), BatchError> {
    if found == needed { Ok(()) } else { Err(BatchError::Length(name, found, needed)) }
}
