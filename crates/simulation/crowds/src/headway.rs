//! Headway: people keep a distance to the one ahead that grows with their speed, and choose the direction in which they
//! get on best.
//!
//! Neither the social forces of 2009 nor ORCA slow a dense stream of equal speed: forces from ahead and from behind
//! cancel, and no collision is foreseen. In experiments the distance of centres in a single file is linear in the speed:
//! `d = 0.36 m + 1.06 s v` in Germany (A. Seyfried, B. Steffen, W. Klingsch, M. Boltes, "The fundamental diagram of
//! pedestrian movement revisited", J. Stat. Mech. P10002, 2005), `d = 0.22 m + 0.89 s v` in India (U. Chattaraj, A.
//! Seyfried, P. Chakroborty, "Comparison of pedestrian fundamental diagram across cultures", Adv. Complex Systems 12,
//! 2009). The default is the mean of both. The distance shrinks for those at the side, as an ellipse does, since people in
//! a stream walk in layers 0.45 m apart, each in the gaps of the next (S. Hoogendoorn, W. Daamen, "Pedestrian behavior at
//! bottlenecks", Transportation Science 39, 2005). The choice of the direction with the best progress is the first heuristic of M. Moussaid, D. Helbing, G. Theraulaz, "How simple rules
//! determine pedestrian behavior and crowd disasters", PNAS 108, 2011.

use glam::DVec2;

use crate::perception::{Neighbour, Perception};

/// Distance at the side beyond which nobody is followed, as a part of the distance of two bodies in touch.
const ASIDE_RATIO: f64 = 1.25;

/// Sines and cosines of the directions beside the preferred one: 15, 30, 45 and 60 degrees.
const DIRECTIONS: [[f64; 2]; 4] = [
    [0.258_819_045_102_520_74, 0.965_925_826_289_068_3],
    [0.5, 0.866_025_403_784_438_6],
    [0.707_106_781_186_547_6, 0.707_106_781_186_547_6],
    [0.866_025_403_784_438_6, 0.5],
];

/// Gain of progress for which people leave their direction, as a part of the preferred speed per direction.
const MIN_GAIN_RATIO: f64 = 0.04;

/// Time in which the distance to a wall is walked at most \[s\].
const WALL_TIME_S: f64 = 1.0;

/// Weight of the speed of those who are met: more than 1 turns people aside early.
const MET_RATIO: f64 = 2.0;

/// Cosine of the headings below which somebody is met.
const MET_COSINE: f64 = -0.5;

/// Others beyond this distance are not considered \[m\].
const SIGHT_M: f64 = 5.0;

/// Maximum number of others that are considered, the nearest first.
const MAX_AHEAD: usize = 32;

/// Law by which people keep a distance to the one ahead: `distance = standing + time * speed`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Headway {
    /// Distance of the centres at rest (default 0.29 m) \[m\].
    pub standing_m: f64,
    /// Additional distance per speed (default 0.975 s) \[s\].
    pub time_s: f64,
}

impl Default for Headway {
    fn default() -> Self {
        Self { standing_m: 0.29, time_s: 0.975 }
    }
}

/// Somebody in the way.
#[derive(Clone, Copy)]
struct Ahead {
    offset: DVec2,
    /// Distance by which its surface is nearer than that of a person \[m\].
    bulge_m: f64,
    /// Distance at the side beyond which it is not in the way \[m\].
    aside_m: f64,
    /// Speed with which it comes towards the agent, zero if it is followed \[m/s\].
    met_m_per_s: f64,
}

impl Ahead {
    /// Distance to keep for in a direction, and the speed of the approach; none where it is not in the way.
    fn in_direction(&self, direction: DVec2) -> Option<f64> {
        let along_m = self.offset.dot(direction);
        let ratio = direction.perp_dot(self.offset) / self.aside_m;
        (along_m > 0.0 && ratio.abs() < 1.0)
            .then(|| (along_m - self.bulge_m) / (1.0 - ratio * ratio).sqrt())
    }
}

impl Headway {
    /// Returns the preferred velocity with regard to the people ahead: slower, or in a direction beside the preferred
    /// one \[m/s\].
    pub(crate) fn adapt(self, view: &Perception<'_>, preferred: DVec2) -> DVec2 {
        let speed = preferred.length();
        if speed <= 0.0 {
            return preferred;
        }
        let straight = preferred / speed;
        let mut ahead = [None; MAX_AHEAD];
        let others = view.neighbours.iter().filter_map(|other| in_the_way(view, other, straight));
        for (slot, other) in ahead.iter_mut().zip(others) {
            *slot = Some(other);
        }
        let [mut limit, mut best] = self.limits_m_per_s(&ahead, straight);
        let mut chosen = straight;
        best = best.min(speed);
        for (number, [sine, cosine]) in DIRECTIONS.into_iter().enumerate() {
            // The right side first: it wins where both are equal.
            for side in [-1.0, 1.0] {
                let direction = straight * cosine + straight.perp() * (side * sine);
                let wall = wall_limit_m_per_s(view, direction);
                let [followed, foreseen] = self.limits_m_per_s(&ahead, direction);
                #[expect(clippy::cast_precision_loss, reason = "four directions")]
                let cost = MIN_GAIN_RATIO * speed * (number + 1) as f64;
                let progress = foreseen.min(wall).min(speed) * cosine - cost;
                if progress > best {
                    (best, limit, chosen) = (progress, followed.min(wall), direction);
                }
            }
        }
        chosen * limit.min(speed)
    }

    /// Greatest speed in a direction behind the people who are followed, and the one that is foreseen with regard to
    /// those who are met too. People see the first in their way only \[m/s\].
    fn limits_m_per_s(self, ahead: &[Option<Ahead>], direction: DVec2) -> [f64; 2] {
        let mut limits = [f64::INFINITY; 2];
        let mut nearest_m = f64::INFINITY;
        for other in ahead.iter().flatten() {
            let Some(distance_m) = other.in_direction(direction) else { continue };
            let speed = ((distance_m - self.standing_m) / self.time_s).max(0.0);
            if other.met_m_per_s == 0.0 {
                limits[0] = limits[0].min(speed);
            }
            if distance_m < nearest_m {
                nearest_m = distance_m;
                limits[1] = (speed - MET_RATIO * other.met_m_per_s).max(0.0);
            }
        }
        limits
    }
}

/// Returns another agent as one to follow or to meet; none for those who are behind or follow the agent.
fn in_the_way(view: &Perception<'_>, other: &Neighbour, straight: DVec2) -> Option<Ahead> {
    let along_m = other.offset.dot(straight);
    let towards = other.velocity.dot(straight);
    let is_met = other.heading.dot(straight) < MET_COSINE && towards < 0.0;
    // Where paths merge, the one who is farther behind follows.
    let follows = other.heading.dot(-other.offset) > along_m && !is_met;
    if follows || other.offset.length_squared() > SIGHT_M * SIGHT_M {
        return None;
    }
    let touch_m = view.radius_m + other.radius_m;
    Some(Ahead {
        offset: other.offset,
        bulge_m: (other.radius_m - view.radius_m).max(0.0),
        aside_m: if is_met { touch_m } else { ASIDE_RATIO * touch_m },
        met_m_per_s: if is_met { -towards } else { 0.0 },
    })
}

/// Greatest speed towards the walls \[m/s\].
fn wall_limit_m_per_s(view: &Perception<'_>, ahead: DVec2) -> f64 {
    let walls = view.walls.iter().map(|offset| {
        let distance_m = offset.length();
        let towards = offset.dot(ahead);
        if towards <= 0.0 {
            return f64::INFINITY;
        }
        let gap_m = (distance_m - view.radius_m).max(0.0);
        gap_m / WALL_TIME_S * distance_m / towards
    });
    walls.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn other(x: f64, y: f64, speed: f64) -> Neighbour {
        Neighbour {
            offset: DVec2::new(x, y),
            velocity: DVec2::new(speed, 0.0),
            heading: DVec2::X * speed.signum(),
            radius_m: 0.2,
            share_ratio: 0.5,
        }
    }

    fn view<'a>(neighbours: &'a [Neighbour], walls: &'a [DVec2]) -> Perception<'a> {
        Perception {
            velocity: DVec2::ZERO,
            radius_m: 0.2,
            preferred: DVec2::X,
            max_speed_m_per_s: 2.0,
            neighbours,
            walls,
            group: None,
            step_s: 0.05,
        }
    }

    /// Walls at both sides of the body, so that it cannot turn.
    const PASSAGE: [DVec2; 2] = [DVec2::new(0.0, 0.2), DVec2::new(0.0, -0.2)];

    #[test]
    fn the_speed_is_that_of_the_distance() {
        let check = |other: Neighbour, speed: f64| {
            let found = Headway::default().adapt(&view(&[other], &PASSAGE), DVec2::X);
            assert!(found.distance(DVec2::X * speed) < 1e-12, "{found} {speed}");
        };
        // (0.68 - 0.29) / 0.975
        check(other(0.68, 0.0, 0.3), 0.4);
        check(other(0.2, 0.0, 0.1), 0.0);
        // At the side by 0.6 of the range the distance counts 1 / 0.8: (0.85 - 0.29) / 0.975.
        check(other(0.68, 0.3, 0.3), 0.56 / 0.975);
        // Nobody is followed who is far at the side, behind, or comes towards the agent.
        check(other(0.68, 0.5, 0.3), 1.0);
        check(other(-0.68, 0.0, 0.3), 1.0);
        check(other(0.68, 0.0, -0.3), 1.0);
    }

    #[test]
    fn one_who_is_slow_or_comes_near_is_passed_where_there_is_space() {
        for (x, speed) in [(0.68, 0.3), (3.0, -1.0)] {
            let passed = Headway::default().adapt(&view(&[other(x, 0.0, speed)], &[]), DVec2::X);
            assert!(passed.length() > 0.9 && passed.y < -0.2, "{passed}");
        }
    }

    #[test]
    fn of_two_who_merge_the_one_behind_follows() {
        let follows = |x: f64| {
            let merging = Neighbour {
                heading: DVec2::new(0.8, -0.6),
                velocity: DVec2::new(0.8, -0.6),
                ..other(x, 0.3, 1.0)
            };
            Headway::default().adapt(&view(&[merging], &PASSAGE), DVec2::X).x < 1.0
        };
        assert!(follows(0.4));
        assert!(!follows(0.05));
    }
}
