//! Behaviour: goals, stays, queues and doors, and the velocity that an agent would like to have.

use glam::DVec2;
use periplus_geometry::Stream;

use super::{Crowd, Party, Phase};
use crate::agent::{PersonGoalId, PersonPlan, PersonState};

/// Steps between two looks for the next point of a route; agents take turns.
const LOOK_STEPS: u64 = 5;

/// Time in which the remaining distance to a goal is walked, so that people slow down there \[s\].
const APPROACH_TIME_S: f64 = 0.5;

/// Speed below this part of the preferred one counts as blocked.
const BLOCKED_RATIO: f64 = 0.05;

/// Time without progress after which wandering people choose another goal, away from where they cannot get on \[s\].
const GIVE_UP_AFTER_S: f64 = 3.0;

/// Time for which wandering people keep to a goal \[s\].
const MIN_TRY_S: f64 = 4.0;

/// A goal that others occupy counts as reached within this additional distance \[m\].
const OCCUPIED_RANGE_M: f64 = 1.5;

/// Distance to a closed door, or to the last of a queue, at which people stop \[m\].
const QUEUE_GAP_M: f64 = 0.7;

/// Distance from a closed door within which people queue \[m\].
const QUEUE_RANGE_M: f64 = 4.0;

impl Crowd {
    /// Starts the plan of a group.
    pub(super) fn start(&mut self, group: usize) {
        let phase = match self.parties[group].plan {
            PersonPlan::Stand => Phase::Done,
            PersonPlan::Direction(_) => Phase::Walking(None),
            PersonPlan::Visit { .. } | PersonPlan::Wander => self.next_phase(group, None),
        };
        self.parties[group].phase = phase;
    }

    /// Chooses the next goal of a group, one that leads away from a direction if it is blocked there.
    fn next_phase(&mut self, group: usize, blocked: Option<DVec2>) -> Phase {
        let Party { members, plan, visits, .. } = &self.parties[group];
        let visit = *visits;
        let goal = match plan {
            PersonPlan::Visit { goals, repeats } => {
                #[expect(clippy::cast_possible_truncation, reason = "an index of the list")]
                let number = match goals.len() as u64 {
                    0 => None,
                    count if visit < count || *repeats => Some((visit % count) as usize),
                    _ => None,
                };
                number.map(|number| goals[number])
            }
            PersonPlan::Wander => {
                let first = members.first().map(|member| self.agents[*member].position);
                first.and_then(|from| self.random_goal(group, visit, from, blocked))
            }
            PersonPlan::Stand | PersonPlan::Direction(_) => None,
        };
        self.parties[group].visits += 1;
        self.parties[group].chosen_at_s = self.time_s;
        for member in self.parties[group].members.clone() {
            self.agents[member].target = None;
            self.agents[member].blocked_s = 0.0;
        }
        goal.map_or(Phase::Done, |goal| Phase::Walking(Some(goal)))
    }

    /// Goal that can be reached from a position and is not there, drawn by the group's number and visit. After a blocked
    /// direction it is one to which another leads, if there is any: people turn round where they cannot get on,
    /// as at a full doorway.
    fn random_goal(
        &self,
        group: usize,
        visit: u64,
        from: DVec2,
        blocked: Option<DVec2>,
    ) -> Option<PersonGoalId> {
        let mut reachable: Vec<usize> = (0..self.goals.len())
            .filter(|goal| {
                let record = &self.goals[*goal];
                let is_there = record.goal.centre.distance(from) <= record.goal.radius_m + 0.5;
                !is_there && record.route.cost_m(&self.floor, from).is_some()
            })
            .collect();
        if let Some(blocked) = blocked {
            let leads_away = |goal: &usize| {
                let next = self.goals[*goal].route.next_point(&self.floor, from);
                next.is_some_and(|next| (next - from).dot(blocked) < 0.0)
            };
            if reachable.iter().any(leads_away) {
                reachable.retain(leads_away);
            }
        }
        if reachable.is_empty() {
            return None;
        }
        let mut stream = Stream::keyed(self.settings.seed, "crowd goal", key(group, visit));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "an index of a list"
        )]
        let number = (stream.unit() * reachable.len() as f64) as usize;
        Some(PersonGoalId(reachable[number.min(reachable.len() - 1)]))
    }

    /// Advances automatic doors.
    pub(super) fn step_doors(&mut self, step_s: f64) {
        for record in &mut self.doors {
            let distances_m = self.agents.iter().map(|agent| {
                record.door.leaf.nearest_point(agent.position).distance(agent.position)
            });
            record.step(distances_m.fold(f64::INFINITY, f64::min), 0.3, step_s);
        }
    }

    /// Updates the phases of all plans, then states and preferred velocities of all agents.
    pub(super) fn decide(&mut self, step_s: f64) {
        for group in 0..self.parties.len() {
            match self.parties[group].phase {
                Phase::Walking(Some(goal)) if self.has_arrived(group, goal) => {
                    let [low_s, high_s] = self.goals[goal.0].goal.stay_s;
                    let visit = self.parties[group].visits;
                    let mut stream =
                        Stream::keyed(self.settings.seed, "crowd stay", key(group, visit));
                    let until_s = self.time_s + low_s + (high_s - low_s) * stream.unit();
                    self.parties[group].phase = Phase::Staying(goal, until_s);
                }
                Phase::Walking(Some(_)) if self.gives_up(group) => {
                    let first = self.parties[group].members.first();
                    let first = first.map(|member| &self.agents[*member]);
                    let blocked = first.and_then(|first| Some(first.target? - first.position));
                    self.parties[group].phase = self.next_phase(group, blocked);
                }
                Phase::Staying(_, until_s) if self.time_s >= until_s => {
                    self.parties[group].phase = self.next_phase(group, None);
                }
                Phase::Walking(_) | Phase::Staying(..) | Phase::Done => {}
            }
        }
        for number in 0..self.agents.len() {
            self.decide_agent(number, step_s);
        }
        self.make_room();
    }

    /// True once all members of a group are at the goal.
    fn has_arrived(&self, group: usize, goal: PersonGoalId) -> bool {
        let members = &self.parties[group].members;
        members.iter().all(|member| self.is_at(*member, goal))
    }

    fn is_at(&self, number: usize, goal: PersonGoalId) -> bool {
        let agent = &self.agents[number];
        let goal = &self.goals[goal.0].goal;
        let distance_m = agent.position.distance(goal.centre);
        let group_m = 0.4 * (self.parties[agent.group].members.len() - 1) as f64;
        let is_occupied = agent.blocked_s > 1.0;
        let range_m = goal.radius_m + group_m + if is_occupied { OCCUPIED_RANGE_M } else { 0.0 };
        distance_m <= range_m && !self.floor.walls.blocks(agent.position, goal.centre)
    }

    fn gives_up(&self, group: usize) -> bool {
        let party = &self.parties[group];
        party.plan == PersonPlan::Wander
            && self.time_s - party.chosen_at_s > MIN_TRY_S
            && party.members.iter().any(|member| {
                let agent = &self.agents[*member];
                agent.without_progress_s() > GIVE_UP_AFTER_S
            })
    }

    fn decide_agent(&mut self, number: usize, step_s: f64) {
        let group = self.agents[number].group;
        let speed = self.preferred_speed_m_per_s(group);
        let (state, preferred) = match self.parties[group].phase {
            Phase::Done => (PersonState::Standing, DVec2::ZERO),
            Phase::Staying(..) => (PersonState::Waiting, DVec2::ZERO),
            Phase::Walking(None) => match self.parties[group].plan {
                PersonPlan::Direction(direction) => (PersonState::Walking, direction * speed),
                _ => (PersonState::Standing, DVec2::ZERO),
            },
            Phase::Walking(Some(goal)) => self.walk_to(number, goal, speed),
        };
        let sway = self.sway(number, state, preferred);
        let agent = &mut self.agents[number];
        agent.state = state;
        agent.preferred = rotate(preferred, sway);
        let is_blocked = state == PersonState::Walking
            && preferred != DVec2::ZERO
            && agent.velocity.dot(preferred.normalize()) < BLOCKED_RATIO * speed;
        agent.blocked_s = if is_blocked {
            agent.blocked_s + step_s
        } else {
            (agent.blocked_s - 2.0 * step_s).max(0.0)
        };
    }

    /// A group walks at the pace of its slowest member.
    fn preferred_speed_m_per_s(&self, group: usize) -> f64 {
        let members = &self.parties[group].members;
        let speeds =
            members.iter().map(|member| self.agents[*member].settings.preferred_speed_m_per_s);
        speeds.fold(f64::INFINITY, f64::min)
    }

    /// State and preferred velocity on the way to a goal.
    fn walk_to(&mut self, number: usize, goal: PersonGoalId, speed: f64) -> (PersonState, DVec2) {
        let record = &self.goals[goal.0];
        let agent = &self.agents[number];
        let is_turn = (self.steps + number as u64).is_multiple_of(LOOK_STEPS);
        if agent.target.is_none() || is_turn {
            let target = record.route.next_point(&self.floor, agent.position);
            self.agents[number].target = target;
        }
        let agent = &self.agents[number];
        let Some(target) = agent.target else {
            return (PersonState::Standing, DVec2::ZERO);
        };
        let offset = target - agent.position;
        let distance_m = offset.length();
        if distance_m < 1e-6 {
            return (PersonState::Walking, DVec2::ZERO);
        }
        let direction = offset / distance_m;
        if let Some(gap_m) = self.gap_to_closed_door_m(agent.position, target) {
            let velocity = if gap_m > QUEUE_GAP_M && !self.is_behind_queue(number, direction) {
                direction * speed.min((gap_m - QUEUE_GAP_M) / APPROACH_TIME_S)
            } else {
                DVec2::ZERO
            };
            return (PersonState::Queueing, velocity);
        }
        let is_last = target == self.goals[goal.0].goal.centre;
        let limit = if is_last { distance_m / APPROACH_TIME_S } else { f64::INFINITY };
        (PersonState::Walking, direction * speed.min(limit))
    }

    /// Distance to the closed door between two points; none without a closed door near the first.
    fn gap_to_closed_door_m(&self, from: DVec2, to: DVec2) -> Option<f64> {
        let closed = self.doors.iter().filter(|record| !record.door.is_open);
        let crossed = closed.filter(|record| record.door.leaf.crosses(from, to));
        let gaps = crossed.map(|record| record.door.leaf.nearest_point(from).distance(from));
        gaps.reduce(f64::min).filter(|gap_m| *gap_m <= QUEUE_RANGE_M)
    }

    /// True if a queueing agent is directly ahead.
    fn is_behind_queue(&self, number: usize, direction: DVec2) -> bool {
        let position = self.agents[number].position;
        self.agents.iter().enumerate().any(|(other, agent)| {
            let offset = agent.position - position;
            other != number
                && agent.state == PersonState::Queueing
                && offset.length() < QUEUE_GAP_M
                && offset.dot(direction) > 0.5 * offset.length()
        })
    }
}

/// Number of a random stream from two numbers.
pub(super) fn key(first: usize, second: u64) -> u64 {
    ((first as u64) << 40) ^ second
}

pub(super) fn rotate(vector: DVec2, angle_rad: f64) -> DVec2 {
    let (sine, cosine) = libm::sincos(angle_rad);
    DVec2::new(cosine * vector.x - sine * vector.y, sine * vector.x + cosine * vector.y)
}
