//! Crowd: agents on a floor, stepped together.

mod behaviour;
mod contacts;
mod jams;
mod sight;

use std::sync::Arc;

use glam::DVec2;

use crate::agent::{
    GroupId, Person, PersonGoalId, PersonId, PersonPlan, PersonSettings, PersonState,
};
use crate::door::{Door, DoorId, DoorRecord};
use crate::error::CrowdError;
use crate::floor::Floor;
use crate::model::SteeringModel;
use crate::neighbours::AgentIndex;
use crate::obstacle::MovingObstacle;
use crate::route::Route;

use self::sight::{Choice, Scratch};

/// Agents for which a thread pays.
const MIN_AGENTS_PER_THREAD: usize = 32;

/// Speed below which a walking agent keeps its heading \[m/s\].
const HEADING_SPEED_M_PER_S: f64 = 0.1;

/// Time for which an agent counts as opposed after another was in front of it \[s\].
const OPPOSED_S: f64 = 1.5;

/// Radius within which an agent counts as still \[m\].
const STILL_RADIUS_M: f64 = 0.5;

/// Settings of a crowd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrowdSettings {
    /// Model that chooses the velocities.
    pub model: SteeringModel,
    /// Seed of all random choices.
    pub seed: u64,
    /// Number of threads; does not change the result.
    pub threads: usize,
}

/// Area that agents visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PersonGoal {
    /// Centre \[m\].
    pub centre: DVec2,
    /// Distance from the centre at which the goal is reached (default 0.5 m) \[m\].
    pub radius_m: f64,
    /// Shortest and longest stay; each visit draws a time between them (default 0 s) \[s\].
    pub stay_s: [f64; 2],
}

impl PersonGoal {
    /// Goal that is passed without a stay.
    #[must_use]
    pub fn at(centre: DVec2) -> Self {
        Self { centre, radius_m: 0.5, stay_s: [0.0; 2] }
    }
}

#[derive(Clone, Debug)]
struct GoalRecord {
    goal: PersonGoal,
    /// Shared by clones of the crowd.
    route: Arc<Route>,
}

/// Agents with one plan; those that were added alone have one each.
#[derive(Clone, Debug)]
struct Party {
    members: Vec<usize>,
    plan: PersonPlan,
    phase: Phase,
    /// Number of goals that were chosen.
    visits: u64,
    /// Time of the last choice \[s\].
    chosen_at_s: f64,
}

/// Phase of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// On the way to a goal, or along a direction.
    Walking(Option<PersonGoalId>),
    /// At a goal until a time.
    Staying(PersonGoalId, f64),
    /// At the end of the plan.
    Done,
}

/// Crowd on a floor.
#[derive(Clone, Debug)]
pub struct Crowd {
    /// Shared by clones of the crowd.
    floor: Arc<Floor>,
    settings: CrowdSettings,
    goals: Vec<GoalRecord>,
    doors: Vec<DoorRecord>,
    agents: Vec<Person>,
    parties: Vec<Party>,
    obstacles: Vec<MovingObstacle>,
    time_s: f64,
    steps: u64,
    index: AgentIndex,
    positions: Vec<DVec2>,
    /// Choices of all agents in this step.
    choices: Vec<Choice>,
    scratch: Vec<Scratch>,
}

impl Crowd {
    /// Crowd without agents.
    #[must_use]
    pub fn new(floor: Floor, settings: CrowdSettings) -> Self {
        Self {
            floor: Arc::new(floor),
            settings,
            goals: Vec::new(),
            doors: Vec::new(),
            agents: Vec::new(),
            parties: Vec::new(),
            obstacles: Vec::new(),
            time_s: 0.0,
            steps: 0,
            index: AgentIndex::default(),
            positions: Vec::new(),
            choices: Vec::new(),
            scratch: vec![Scratch::default(); settings.threads.max(1)],
        }
    }

    /// Adds a goal, and computes the paths to it.
    ///
    /// # Errors
    ///
    /// The goal is in a wall or outside of the floor.
    pub fn add_goal(&mut self, goal: PersonGoal) -> Result<PersonGoalId, CrowdError> {
        let route = Route::new(&self.floor, goal.centre, goal.radius_m)
            .ok_or(CrowdError::GoalInWall(goal.centre.to_array()))?;
        self.goals.push(GoalRecord { goal, route: Arc::new(route) });
        Ok(PersonGoalId(self.goals.len() - 1))
    }

    /// Adds a door.
    pub fn add_door(&mut self, door: Door) -> DoorId {
        self.doors.push(DoorRecord { door, requested_s: 0.0 });
        DoorId(self.doors.len() - 1)
    }

    /// Opens or closes a door.
    pub fn set_door_open(&mut self, door: DoorId, is_open: bool) {
        self.doors[door.0].door.is_open = is_open;
    }

    /// Returns a door.
    #[must_use]
    pub fn door(&self, door: DoorId) -> &Door {
        &self.doors[door.0].door
    }

    /// Adds an agent with a plan.
    ///
    /// # Errors
    ///
    /// A number of the agent is out of its range, or the plan names goals that do not exist.
    pub fn add_agent(
        &mut self,
        agent: PersonSettings,
        plan: PersonPlan,
    ) -> Result<PersonId, CrowdError> {
        self.add_group(&[agent], plan)?;
        Ok(PersonId(self.agents.len() - 1))
    }

    /// Adds a group: agents that walk together by one plan. Their numbers follow each other.
    ///
    /// # Errors
    ///
    /// As [`Crowd::add_agent`]; nothing is added then.
    pub fn add_group(
        &mut self,
        agents: &[PersonSettings],
        plan: PersonPlan,
    ) -> Result<GroupId, CrowdError> {
        for agent in agents {
            agent.check()?;
        }
        match &plan {
            PersonPlan::Visit { goals, .. } => {
                if let Some(goal) = goals.iter().find(|goal| goal.0 >= self.goals.len()) {
                    return Err(CrowdError::Goal(goal.0));
                }
            }
            PersonPlan::Wander if self.goals.is_empty() => return Err(CrowdError::NoGoals),
            PersonPlan::Wander | PersonPlan::Stand | PersonPlan::Direction(_) => {}
        }
        let group = self.parties.len();
        let first = self.agents.len();
        self.agents.extend(agents.iter().map(|agent| Person::new(*agent, group)));
        let members = (first..self.agents.len()).collect();
        self.parties.push(Party { members, plan, phase: Phase::Done, visits: 0, chosen_at_s: 0.0 });
        self.start(group);
        Ok(GroupId(group))
    }

    /// Sets the obstacles that move, such as robots, for the steps that follow.
    pub fn set_obstacles(&mut self, obstacles: Vec<MovingObstacle>) {
        self.obstacles = obstacles;
    }

    /// Returns the obstacles that move.
    #[must_use]
    pub fn obstacles(&self) -> &[MovingObstacle] {
        &self.obstacles
    }

    /// Name of the model that chooses the velocities.
    #[must_use]
    pub fn model_name(&self) -> &'static str {
        self.settings.model.name()
    }

    /// Returns the floor.
    #[must_use]
    pub fn floor(&self) -> &Floor {
        &self.floor
    }

    /// Returns the agents, in the order in which they were added.
    #[must_use]
    pub fn agents(&self) -> &[Person] {
        &self.agents
    }

    /// Returns an agent.
    #[must_use]
    pub fn agent(&self, agent: PersonId) -> &Person {
        &self.agents[agent.0]
    }

    /// Returns the group of an agent and the agents in it.
    #[must_use]
    pub fn group_of(&self, agent: PersonId) -> (GroupId, &[usize]) {
        let group = self.agents[agent.0].group;
        (GroupId(group), &self.parties[group].members)
    }

    /// Number of goals that an agent's plan has set out for.
    #[must_use]
    pub fn visits(&self, agent: PersonId) -> usize {
        usize::try_from(self.parties[self.agents[agent.0].group].visits).unwrap_or(usize::MAX)
    }

    /// Simulated time since the start \[s\].
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Advances the crowd, in equal parts that the model can integrate. Obstacles move by their velocities meanwhile.
    pub fn step(&mut self, duration_s: f64) {
        if !(duration_s.is_finite() && duration_s > 0.0) {
            return;
        }
        // A millionth less, so that a step that is longer by rounding is not split.
        let parts = (duration_s / self.settings.model.max_step_s() - 1e-6).ceil().max(1.0);
        let step_s = duration_s / parts;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "positive and finite"
        )]
        for _ in 0..parts as u64 {
            self.step_once(step_s);
        }
    }

    fn step_once(&mut self, step_s: f64) {
        self.step_doors(step_s);
        self.decide(step_s);
        self.positions.clear();
        self.positions.extend(self.agents.iter().map(|agent| agent.position));
        self.index.build(&self.positions, self.settings.model.range_m(), self.floor.period_m);
        self.choose_velocities(step_s);
        for obstacle in &mut self.obstacles {
            let moved = obstacle.velocity * step_s;
            obstacle.axis = obstacle.axis.map(|end| end + moved);
        }
        self.move_agents(step_s);
        self.time_s += step_s;
        self.steps += 1;
    }

    /// Lets each agent choose its velocity from the same state, on all threads.
    fn choose_velocities(&mut self, step_s: f64) {
        let mut choices = std::mem::take(&mut self.choices);
        let mut scratch = std::mem::take(&mut self.scratch);
        choices.clear();
        choices.resize(self.agents.len(), Choice::default());
        let threads = scratch.len().min(self.agents.len() / MIN_AGENTS_PER_THREAD).max(1);
        let chunk = self.agents.len().div_ceil(threads).max(1);
        let this = &*self;
        let work = |first: usize, choices: &mut [Choice], scratch: &mut Scratch| {
            for (number, choice) in choices.iter_mut().enumerate() {
                *choice = this.velocity_of(first + number, step_s, scratch);
            }
        };
        let mut parts = choices.chunks_mut(chunk).zip(&mut scratch).enumerate();
        let own = parts.next();
        std::thread::scope(|scope| {
            for (part, (choices, scratch)) in parts {
                let work = &work;
                scope.spawn(move || work(part * chunk, choices, scratch));
            }
            if let Some((_, (choices, scratch))) = own {
                work(0, choices, scratch);
            }
        });
        self.choices = choices;
        self.scratch = scratch;
    }

    /// Moves the agents by their velocities and separates bodies that overlap.
    fn move_agents(&mut self, step_s: f64) {
        let before = std::mem::take(&mut self.positions);
        for (agent, choice) in self.agents.iter_mut().zip(&self.choices) {
            agent.position += choice.velocity * step_s;
            agent.adapted = choice.adapted;
            agent.opposed_s =
                if choice.is_opposed { OPPOSED_S } else { (agent.opposed_s - step_s).max(0.0) };
        }
        self.separate(&before);
        for (agent, (before, choice)) in
            self.agents.iter_mut().zip(before.iter().zip(&self.choices))
        {
            let moved = agent.position - *before;
            agent.walked_m += moved.length();
            // A push by a contact is not a walk: the velocity of the next step is at most the chosen one.
            agent.velocity = (moved / step_s).clamp_length_max(choice.velocity.length());
            let speed = agent.velocity.length();
            if speed > HEADING_SPEED_M_PER_S {
                agent.heading = agent.velocity / speed;
            }
            if let Some(period_m) = self.floor.period_m {
                let wrapped = agent.position.x - (agent.position.x / period_m).floor() * period_m;
                agent.anchor.x += wrapped - agent.position.x;
                agent.position.x = wrapped;
            }
            if agent.state != PersonState::Walking
                || agent.anchor.distance(agent.position) > STILL_RADIUS_M
            {
                agent.anchor = agent.position;
                agent.still_s = 0.0;
            } else {
                agent.still_s += step_s;
            }
        }
        self.positions = before;
    }
}
