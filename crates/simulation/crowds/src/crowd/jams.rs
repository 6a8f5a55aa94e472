//! Jams: how people who cannot get on find their path, and how others let them.
//!
//! With the time without progress they walk round a robot, give way or squeeze through by turns of direction, try to pass
//! at the side, and at last walk to where there is space.

use glam::DVec2;
use periplus_geometry::Stream;

use super::Crowd;
use super::behaviour::{key, rotate};
use crate::agent::{Person, PersonState};

/// Sway of the direction that breaks symmetric encounters \[rad\].
const SWAY_RAD: f64 = 0.05;

/// Time without progress after which others make room \[s\].
const MAKE_ROOM_AFTER_S: f64 = 1.5;

/// Distance at which people at rest make room for others \[m\].
const MAKE_ROOM_RANGE_M: f64 = 0.8;

/// Speed with which they do \[m/s\].
const MAKE_ROOM_SPEED_M_PER_S: f64 = 0.5;

/// Time without progress after which they do \[s\].
const ROUND_AFTER_S: f64 = 0.5;

/// Distance of the bodies within which people who cannot get on walk round a robot ahead \[m\].
const ROUND_GAP_M: f64 = 0.4;

/// Time for which one direction has priority in a deadlock \[s\].
const PRIORITY_S: f64 = 2.5;

/// Smallest and largest angle to the right at which people give way: aside and back \[rad\].
const GIVE_WAY_RAD: [f64; 2] = [1.4, 2.6];

/// Time without progress after which people try to pass at the side \[s\].
const SIDESTEP_AFTER_S: f64 = 3.0;

/// Time for one try \[s\].
const SIDESTEP_S: f64 = 1.5;

/// Range of the angles of a try at the side, beyond half a radian \[rad\].
const SIDESTEP_RAD: f64 = 1.0;

/// Time without progress after which people squeeze through without priority \[s\].
const MAX_PATIENCE_S: f64 = 6.0;

/// Time without leaving a circle of half a metre after which people walk to where there is space \[s\].
const SPACE_AFTER_S: f64 = 5.0;

/// Distance over which people whose patience is over look for space \[m\].
const SPACE_RANGE_M: f64 = 0.8;

/// Part of the distance of two bodies in touch that others leave to them.
const YIELDING_RATIO: f64 = 0.7;

/// Directions in which they look.
const SPACE_DIRECTION_COUNT: u32 = 16;

/// Free distance that a direction must have in addition, per turn \[m/rad\].
const TURN_COST_M_PER_RAD: f64 = 0.05;

impl Crowd {
    /// Lets people at rest step aside for others that cannot get on, out of the line in which these walk.
    pub(super) fn make_room(&mut self) {
        for walker in 0..self.agents.len() {
            let Person { position, preferred, state, .. } = self.agents[walker];
            let ahead = preferred.normalize_or_zero();
            if state != PersonState::Walking
                || self.agents[walker].without_progress_s() < MAKE_ROOM_AFTER_S
                || ahead == DVec2::ZERO
            {
                continue;
            }
            for agent in &mut self.agents {
                let offset = agent.position - position;
                let stands = matches!(agent.state, PersonState::Waiting | PersonState::Standing);
                if stands && offset.length() < MAKE_ROOM_RANGE_M && offset.dot(ahead) > 0.0 {
                    let side = if ahead.perp_dot(offset) < 0.0 { -1.0 } else { 1.0 };
                    agent.preferred = ahead.perp() * (side * MAKE_ROOM_SPEED_M_PER_S);
                }
            }
        }
    }

    /// Angle by which an agent's direction is turned: a little sway, tries to pass at the side where it is blocked, and
    /// steps aside and back where it gives way.
    pub(super) fn sway(&self, number: usize, state: PersonState, preferred: DVec2) -> f64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
        let second = self.time_s as u64;
        let draw = |name: &str, count: u64| {
            Stream::keyed(self.settings.seed, name, key(number, count)).unit()
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
        let tries = (self.time_s / SIDESTEP_S) as u64;
        let without_progress_s = self.agents[number].without_progress_s();
        if state == PersonState::Walking
            && (ROUND_AFTER_S..SIDESTEP_AFTER_S).contains(&without_progress_s)
            && let Some(angle_rad) = self.angle_round_obstacle(number, preferred)
        {
            return angle_rad;
        }
        if state == PersonState::Walking && self.agents[number].still_s > SPACE_AFTER_S {
            return self.angle_to_space(number, preferred);
        }
        if state != PersonState::Walking
            || without_progress_s < self.settings.model.deadlock_after_s()
        {
            return SWAY_RAD * (2.0 * draw("crowd sway", second) - 1.0);
        }
        if self.is_in_deadlock(number) && !self.may_squeeze(number, preferred) {
            let [low_rad, high_rad] = GIVE_WAY_RAD;
            return -(low_rad + (high_rad - low_rad) * draw("crowd give way", tries));
        }
        if without_progress_s < SIDESTEP_AFTER_S {
            return SWAY_RAD * (2.0 * draw("crowd sway", second) - 1.0);
        }
        let angle_rad = 0.5 + SIDESTEP_RAD * draw("crowd sidestep", 2 * tries);
        if draw("crowd sidestep", 2 * tries + 1) < 0.6 { -angle_rad } else { angle_rad }
    }

    /// Angle from a direction to the one in which there is most space \[rad\].
    fn angle_to_space(&self, number: usize, preferred: DVec2) -> f64 {
        let agent = &self.agents[number];
        let position = agent.position;
        let others = self.agents.iter().enumerate().filter(|(other, _)| *other != number);
        let radius_m = agent.body_radius_m();
        let others = others.map(|(_, other)| {
            (other.position - position, YIELDING_RATIO * (other.body_radius_m() + radius_m))
        });
        let robots = self.obstacles.iter().map(|obstacle| {
            (obstacle.nearest_axis_point(position) - position, obstacle.radius_m + radius_m)
        });
        let near: Vec<(DVec2, f64)> = others
            .chain(robots)
            .filter(|(offset, reach_m)| offset.length() < SPACE_RANGE_M + reach_m)
            .collect();
        let space_m = |direction: DVec2| {
            let free_m = near.iter().map(|(offset, reach_m)| {
                let (along_m, aside_m) = (offset.dot(direction), direction.perp_dot(*offset).abs());
                if along_m <= 0.0 || aside_m >= *reach_m {
                    return SPACE_RANGE_M;
                }
                (along_m - (reach_m * reach_m - aside_m * aside_m).sqrt()).max(0.0)
            });
            self.free_to_wall_m(position, direction, radius_m)
                .min(free_m.fold(SPACE_RANGE_M, f64::min))
        };
        let angles = (0..SPACE_DIRECTION_COUNT).map(|turn| {
            let ratio = f64::from(turn) / f64::from(SPACE_DIRECTION_COUNT);
            (ratio - 0.5) * std::f64::consts::TAU
        });
        // On from where it came: without that it would go to and fro.
        let left_m = position - agent.anchor;
        let score = |angle_rad: f64| {
            let direction = rotate(preferred, angle_rad).normalize_or_zero();
            space_m(direction) + left_m.dot(direction) - TURN_COST_M_PER_RAD * angle_rad.abs()
        };
        let best = angles.map(|angle_rad| (score(angle_rad), angle_rad));
        best.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, angle_rad)| angle_rad)
    }

    /// Distance in a direction to a wall, in steps of a cell \[m\].
    fn free_to_wall_m(&self, position: DVec2, direction: DVec2, radius_m: f64) -> f64 {
        const STEP_M: f64 = 0.1;
        // A person that touches a wall may leave it.
        let needed_m = self.floor.clearance_m(position).min(radius_m);
        let mut free_m = 0.0;
        while free_m < SPACE_RANGE_M {
            let point = position + direction * (free_m + STEP_M);
            if self.floor.walls.blocks(position, point) || self.floor.clearance_m(point) < needed_m
            {
                break;
            }
            free_m += STEP_M;
        }
        free_m
    }

    /// Angle from a direction to the tangent of a robot that is directly ahead, on the side of the smaller turn \[rad\].
    fn angle_round_obstacle(&self, number: usize, preferred: DVec2) -> Option<f64> {
        let agent = &self.agents[number];
        let ahead = preferred.try_normalize()?;
        let offsets = self.obstacles.iter().filter_map(|obstacle| {
            let offset = obstacle.nearest_axis_point(agent.position) - agent.position;
            let reach_m = obstacle.radius_m + agent.body_radius_m();
            let is_ahead = offset.dot(ahead) > 0.0 && ahead.perp_dot(offset).abs() < reach_m;
            (is_ahead && offset.length() < reach_m + ROUND_GAP_M).then_some(offset)
        });
        let offset = offsets.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
        let side = if ahead.perp_dot(offset) < 0.0 { 1.0 } else { -1.0 };
        let tangent = offset.perp() * side;
        Some(libm::atan2(ahead.perp_dot(tangent), ahead.dot(tangent)))
    }

    /// True if an agent has not got on for a while because another was in front of it.
    pub(super) fn is_in_deadlock(&self, number: usize) -> bool {
        let agent = &self.agents[number];
        agent.opposed_s > 0.0 && agent.without_progress_s() > self.settings.model.deadlock_after_s()
    }

    /// True if an agent that would walk in a direction squeezes through in a deadlock. The four directions of the plane
    /// take turns, so that all people of one direction get on together while the others make room; the patience of
    /// those that make room ends at last.
    pub(super) fn may_squeeze(&self, number: usize, direction: DVec2) -> bool {
        const TURNS: [DVec2; 4] = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
        let turn = (self.time_s / PRIORITY_S) as usize % TURNS.len();
        direction.dot(TURNS[turn]) > 0.0
            || self.agents[number].without_progress_s() > MAX_PATIENCE_S
    }
}
