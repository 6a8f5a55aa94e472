//! Contacts: bodies never pass through walls or obstacles, and do not overlap more than the model allows.

use glam::DVec2;

use super::Crowd;
use crate::neighbours::nearest_image;

/// Rounds of corrections in a step.
const ROUND_COUNT: usize = 2;

/// Part of the radius that a wall keeps free of a body that has turned sideways.
const WALL_RADIUS_RATIO: f64 = 0.9;

/// Distance at which a body is stopped in front of a wall that it would have crossed \[m\].
const STOP_GAP_M: f64 = 0.02;

impl Crowd {
    /// Separates bodies. All corrections of a round start from the same positions, so that their order has no
    /// influence.
    pub(super) fn separate(&mut self, before: &[DVec2]) {
        let period_m = self.floor.period_m;
        let allowed_m = self.settings.model.allowed_overlap_m();
        let mut near = Vec::new();
        let mut corrected = Vec::with_capacity(self.agents.len());
        for _ in 0..ROUND_COUNT {
            let positions: Vec<DVec2> = self.agents.iter().map(|agent| agent.position).collect();
            // The index has the positions before the move: bodies within reach moved by centimetres since.
            corrected.clear();
            for (number, agent) in self.agents.iter().enumerate() {
                let radius_m = agent.body_radius_m();
                let mut correction = DVec2::ZERO;
                self.index.near(before[number], 2.5 * radius_m + 0.3, before, &mut near);
                for &(other, _) in &near {
                    let other = other as usize;
                    if other == number {
                        continue;
                    }
                    let offset = nearest_image(positions[other] - positions[number], period_m);
                    let sum_m = radius_m + self.agents[other].body_radius_m() - allowed_m;
                    let distance_m = offset.length();
                    if distance_m < sum_m {
                        // Two at one point part by their numbers.
                        let side = if other > number { 1.0 } else { -1.0 };
                        let towards =
                            if distance_m < 1e-9 { DVec2::X * side } else { offset / distance_m };
                        correction -= towards * (0.5 * (sum_m - distance_m));
                    }
                }
                corrected.push(positions[number] + correction.clamp_length_max(0.1));
            }
            for (agent, position) in self.agents.iter_mut().zip(&corrected) {
                agent.position = *position;
            }
            self.leave_obstacles_and_walls(before);
        }
    }

    fn leave_obstacles_and_walls(&mut self, before: &[DVec2]) {
        let mut numbers = Vec::new();
        for (agent, before) in self.agents.iter_mut().zip(before) {
            let radius_m = agent.body_radius_m();
            for obstacle in &self.obstacles {
                let nearest = obstacle.nearest_axis_point(agent.position);
                agent.position = outside(agent.position, nearest, radius_m + obstacle.radius_m);
            }
            let reach_m = radius_m + 0.1 + before.distance(agent.position);
            self.floor.walls.near(agent.position, reach_m, &mut numbers);
            let walls = numbers.iter().map(|number| self.floor.walls()[*number as usize]);
            let doors = self.doors.iter().filter(|record| !record.door.is_open);
            let walls: Vec<_> = walls.chain(doors.map(|record| record.door.leaf)).collect();
            for _ in 0..ROUND_COUNT {
                for wall in &walls {
                    if wall.crosses(*before, agent.position) && *before != agent.position {
                        // Back to the side from which it came.
                        let nearest = wall.nearest_point(*before);
                        let away = (*before - nearest).normalize_or(-agent.heading);
                        let through = (agent.position - nearest).dot(away);
                        agent.position += away * (STOP_GAP_M - through);
                    }
                    let nearest = wall.nearest_point(agent.position);
                    agent.position = outside(agent.position, nearest, WALL_RADIUS_RATIO * radius_m);
                }
            }
            if walls.iter().any(|wall| wall.crosses(*before, agent.position)) {
                agent.position = *before;
            }
        }
    }
}

/// Returns the nearest position at a distance from a point.
fn outside(position: DVec2, point: DVec2, distance_m: f64) -> DVec2 {
    let offset = position - point;
    let length_m = offset.length();
    if length_m >= distance_m {
        position
    } else if length_m < 1e-9 {
        point + DVec2::X * distance_m
    } else {
        point + offset * (distance_m / length_m)
    }
}
