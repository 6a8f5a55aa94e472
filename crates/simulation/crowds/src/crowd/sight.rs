//! Perception: the surroundings of each agent, and the velocity that it chooses.

use glam::DVec2;

use super::Crowd;
use crate::perception::{GroupView, Neighbour, Perception};

/// Walls beyond this distance have no influence \[m\].
const WALL_RANGE_M: f64 = 1.5;

/// Time between two looks at the people ahead; agents take turns \[s\].
const DECISION_S: f64 = 0.05;

/// Distance of the bodies within which others oppose an agent \[m\].
const OPPOSED_GAP_M: f64 = 0.3;

/// Cosine of the headings below which others oppose an agent.
const OPPOSED_COSINE_RATIO: f64 = -0.3;

/// Cosine of the headings below which an agent in a deadlock squeezes past others: more than 60 degrees.
const SQUEEZE_COSINE_RATIO: f64 = 0.5;

/// Choice of an agent in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Choice {
    /// Velocity \[m/s\].
    pub(super) velocity: DVec2,
    /// Preferred velocity with regard to the people ahead \[m/s\].
    pub(super) adapted: DVec2,
    /// True if another directly ahead comes towards it or does not avoid it.
    pub(super) is_opposed: bool,
}

/// Buffers of one thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    near: Vec<(u32, DVec2)>,
    neighbours: Vec<Neighbour>,
    wall_numbers: Vec<u32>,
    walls: Vec<DVec2>,
}

impl Crowd {
    /// Lets an agent choose its velocity.
    pub(super) fn velocity_of(&self, number: usize, step_s: f64, scratch: &mut Scratch) -> Choice {
        let agent = &self.agents[number];
        let Scratch { near, neighbours, wall_numbers, walls } = scratch;
        let range_m = self.settings.model.range_m();
        let position = agent.position;
        self.index.near(position, range_m, &self.positions, near);
        neighbours.clear();
        // Within the clearance there is no wall to look through.
        let clear_m = self.floor.clearance_m(position) - 0.1;
        for &(other, offset) in near.iter() {
            if other as usize == number || self.is_hidden(position, offset, clear_m) {
                continue;
            }
            let other = &self.agents[other as usize];
            neighbours.push(Neighbour {
                offset,
                velocity: other.velocity,
                heading: other.preferred.normalize_or(other.heading),
                radius_m: other.body_radius_m(),
                share_ratio: 0.5,
            });
        }
        neighbours.sort_by(|a, b| a.offset.length_squared().total_cmp(&b.offset.length_squared()));
        neighbours.truncate(self.settings.model.max_neighbours());
        for obstacle in &self.obstacles {
            let share_ratio = if obstacle.is_reciprocal { 0.5 } else { 1.0 };
            let nearest = obstacle.nearest_axis_point(position);
            let mut points = [nearest, obstacle.axis[0], obstacle.axis[1]];
            points[1..].sort_by(|a, b| {
                a.distance_squared(nearest).total_cmp(&b.distance_squared(nearest))
            });
            for (order, &point) in points.iter().enumerate() {
                let offset = point - position;
                let is_same = points[..order].iter().any(|other| other.distance(point) < 0.05);
                if is_same || offset.length() > range_m + obstacle.radius_m {
                    continue;
                }
                if self.is_hidden(position, offset, clear_m) {
                    continue;
                }
                neighbours.push(Neighbour {
                    offset,
                    velocity: obstacle.velocity,
                    heading: obstacle.velocity.normalize_or_zero(),
                    radius_m: obstacle.radius_m,
                    share_ratio,
                });
            }
        }
        walls.clear();
        self.floor.walls.near(position, WALL_RANGE_M, wall_numbers);
        let all = self.floor.walls();
        walls.extend(
            wall_numbers.iter().map(|wall| all[*wall as usize].nearest_point(position) - position),
        );
        for record in self.doors.iter().filter(|record| !record.door.is_open) {
            let offset = record.door.leaf.nearest_point(position) - position;
            if offset.length() <= WALL_RANGE_M {
                walls.push(offset);
            }
        }
        remove_hidden_walls(walls);
        let radius_m = agent.body_radius_m();
        let opposes = |other: &Neighbour, cosine_ratio: f64| {
            opposes(radius_m, agent.preferred, other, cosine_ratio)
        };
        let is_opposed = neighbours.iter().any(|other| opposes(other, OPPOSED_COSINE_RATIO));
        let squeezes = self.is_in_deadlock(number) && self.may_squeeze(number, agent.preferred);
        if squeezes {
            // It walks on until it touches them, and past them as they make room; robots are avoided still.
            neighbours
                .retain(|other| other.share_ratio > 0.5 || !opposes(other, SQUEEZE_COSINE_RATIO));
        }
        let mut view = Perception {
            velocity: agent.velocity,
            radius_m,
            preferred: agent.preferred,
            max_speed_m_per_s: agent.settings.max_speed_m_per_s,
            neighbours,
            walls,
            group: self.group_view(number),
            step_s,
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive")]
        let decision_steps = (DECISION_S / step_s).round().max(1.0) as u64;
        let is_turn = (self.steps + number as u64).is_multiple_of(decision_steps);
        let is_new = (agent.adapted == DVec2::ZERO) != (agent.preferred == DVec2::ZERO);
        let adapted = if squeezes {
            // People keep no distance any more.
            agent.preferred
        } else if is_turn || is_new {
            self.settings.model.adapt(&view)
        } else {
            agent.adapted
        };
        view.preferred = adapted;
        Choice { velocity: self.settings.model.steer(&view), adapted, is_opposed }
    }

    /// True where a wall or a closed door is in the line of sight.
    fn is_hidden(&self, from: DVec2, offset: DVec2, clear_m: f64) -> bool {
        let to = from + offset;
        let is_behind_wall = offset.length_squared() > clear_m.max(0.0) * clear_m.max(0.0)
            && self.floor.walls.blocks(from, to);
        is_behind_wall
            || self
                .doors
                .iter()
                .any(|record| !record.door.is_open && record.door.leaf.crosses(from, to))
    }

    fn group_view(&self, number: usize) -> Option<GroupView> {
        let agent = &self.agents[number];
        let members = &self.parties[agent.group].members;
        if members.len() < 2 || agent.preferred == DVec2::ZERO {
            return None;
        }
        let sum: DVec2 = members.iter().map(|member| self.agents[*member].position).sum();
        #[expect(clippy::cast_precision_loss, reason = "groups are small")]
        let count = members.len() as f64;
        let to_centre = sum / count - agent.position;
        let to_others = (sum - agent.position) / (count - 1.0) - agent.position;
        Some(GroupView { to_centre, to_others, members: members.len() })
    }
}

/// True if another is directly ahead and walks in a direction with at most this cosine, or does not avoid the agent.
fn opposes(radius_m: f64, preferred: DVec2, other: &Neighbour, cosine_ratio: f64) -> bool {
    let ahead = preferred.normalize_or_zero();
    let gap_m = other.offset.length() - radius_m - other.radius_m;
    let is_ahead = other.offset.dot(ahead) > 0.0;
    let is_against = other.heading.dot(ahead) < cosine_ratio || other.share_ratio > 0.5;
    gap_m < OPPOSED_GAP_M && is_ahead && is_against
}

/// Keeps the nearest of wall points that are almost the same, as those of two walls that meet in a corner are.
fn remove_hidden_walls(walls: &mut Vec<DVec2>) {
    /// Distance within which two points are one \[m\].
    const SAME_M: f64 = 0.02;
    walls.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let mut kept = 0;
    for number in 0..walls.len() {
        let wall = walls[number];
        if walls[..kept].iter().all(|other| other.distance(wall) > SAME_M) {
            walls[kept] = wall;
            kept += 1;
        }
    }
    walls.truncate(kept);
}
