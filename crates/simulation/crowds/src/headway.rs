//! Headway: people keep a distance to the one ahead that grows with their speed, and choose the direction in which they
//! get on best.
//!
//! Neither the social forces of 2009 nor ORCA slow a dense stream of equal speed: forces from ahead and from behind
//! cancel, and no collision is foreseen. In experiments the distance of centres in a single file is linear in the speed:
//! `d = 0.36 m + 1.06 s v` in Germany (A. Seyfried, B. Steffen, W. Klingsch, M. Boltes, "The fundamental diagram of
//! pedestrian movement revisited", J. Stat. Mech. P10002, 2005), `d = 0.22 m + 0.89 s v` in India (U. Chattaraj, A.
//! Seyfried, P. Chakroborty, "Comparison of pedestrian fundamental diagram across cultures", Adv. Complex Systems 12,
//! 2009). The default is the latter, which fits the flow through bottlenecks better. The distance shrinks for those at the side, as an ellipse does, since people in
//! a stream walk in layers 0.45 m apart, each in the gaps of the next (S. Hoogendoorn, W. Daamen, "Pedestrian behavior at
//! bottlenecks", Transportation Science 39, 2005). The choice of the direction with the best progress is the first heuristic of M. Moussaid, D. Helbing, G. Theraulaz, "How simple rules
//! determine pedestrian behavior and crowd disasters", PNAS 108, 2011.

use glam::DVec2;

use crate::perception::{Neighbour, Perception};

/// Distance at the side beyond which people are not followed, as a part of the distance of two bodies in touch.
const ASIDE_RATIO: f64 = 1.25;

/// Distances to the side of the lines on which people look for better progress \[m\].
const SIDE_STEPS_M: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Distance in which a side step is made \[m\].
const SIDE_STEP_LENGTH_M: f64 = 1.5;

/// Gain of progress for which people leave their direction, as a part of the preferred speed per direction.
const MIN_GAIN_RATIO: f64 = 0.04;

/// People follow one that walks away at this part of its speed, however near: they start together. Below 0.9 queues flow
/// through bottlenecks at two thirds of the published rates.
const PURSUIT_RATIO: f64 = 0.95;

/// Weight of the speed of people that are met: more than 1 turns people aside early.
const MET_RATIO: f64 = 2.0;

/// Cosine of the headings below which another is met.
const MET_COSINE_RATIO: f64 = -0.5;

/// Others beyond this distance are not considered \[m\].
const SIGHT_M: f64 = 5.0;

/// Maximum number of others that are considered, the nearest first.
const MAX_AHEAD_COUNT: usize = 32;

/// Law by which people keep a distance to the one ahead: `distance = standing + time * speed`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Headway {
    /// Distance of the centres at rest (default 0.22 m) \[m\].
    pub standing_m: f64,
    /// Additional distance per speed (default 0.89 s) \[s\].
    pub time_s: f64,
}

impl Default for Headway {
    fn default() -> Self {
        Self { standing_m: 0.22, time_s: 0.89 }
    }
}

/// Person or robot ahead.
#[derive(Clone, Copy)]
struct Ahead {
    offset: DVec2,
    velocity: DVec2,
    /// Distance by which its surface is nearer than that of a person \[m\].
    bulge_m: f64,
    /// Distance at the side beyond which it has no effect \[m\].
    aside_m: f64,
    /// Speed with which it comes towards the agent, zero if it is followed \[m/s\].
    met_m_per_s: f64,
}

impl Ahead {
    /// Distance to keep for in a direction, and the speed of the approach; none where it has no effect.
    fn in_direction(&self, from: DVec2, direction: DVec2) -> Option<f64> {
        let offset = self.offset - from;
        let along_m = offset.dot(direction);
        let ratio = direction.perp_dot(offset) / self.aside_m;
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
        let mut ahead = [None; MAX_AHEAD_COUNT];
        let others = view.neighbours.iter().filter_map(|other| in_the_way(view, other, straight));
        for (slot, other) in ahead.iter_mut().zip(others) {
            *slot = Some(other);
        }
        let [mut limit, mut best] = self.limits_m_per_s(&ahead, DVec2::ZERO, straight);
        let mut chosen = straight;
        best = best.min(speed);
        for (number, step_m) in SIDE_STEPS_M.into_iter().enumerate() {
            // The right side first: it wins where both are equal.
            for side in [-1.0, 1.0] {
                let aside = straight.perp() * (side * step_m);
                if is_wall_in(view, straight, aside) {
                    continue;
                }
                let direction = (straight * SIDE_STEP_LENGTH_M + aside).normalize();
                let [followed, way] = self.limits_m_per_s(&ahead, DVec2::ZERO, direction);
                let [_, line] = self.limits_m_per_s(&ahead, aside, straight);
                #[expect(clippy::cast_precision_loss, reason = "four steps")]
                let cost = MIN_GAIN_RATIO * speed * (number + 1) as f64;
                let progress = way.min(line).min(speed) - cost;
                if progress > best {
                    (best, limit, chosen) = (progress, followed, direction);
                }
            }
        }
        chosen * limit.min(speed)
    }

    /// Greatest speed in a direction behind the people who are followed, and the one that is foreseen with regard to
    /// those that are met too. People see the first ahead only \[m/s\].
    fn limits_m_per_s(self, ahead: &[Option<Ahead>], from: DVec2, direction: DVec2) -> [f64; 2] {
        let mut limits = [f64::INFINITY; 2];
        let mut nearest_m = f64::INFINITY;
        for other in ahead.iter().flatten() {
            let Some(distance_m) = other.in_direction(from, direction) else { continue };
            let speed = ((distance_m - self.standing_m) / self.time_s).max(0.0);
            let speed = speed.max(PURSUIT_RATIO * other.velocity.dot(direction));
            if other.met_m_per_s == 0.0 {
                limits[0] = limits[0].min(speed);
            }
            if distance_m < nearest_m {
                nearest_m = distance_m;
                limits[1] = speed - MET_RATIO * other.met_m_per_s;
            }
        }
        limits
    }
}

/// Returns another agent as one to follow or to meet; none for those that are behind or follow the agent.
fn in_the_way(view: &Perception<'_>, other: &Neighbour, straight: DVec2) -> Option<Ahead> {
    let along_m = other.offset.dot(straight);
    let towards = other.velocity.dot(straight);
    let is_met = other.heading.dot(straight) < MET_COSINE_RATIO && towards < 0.0;
    // Where paths merge, the one farther behind follows.
    let follows = other.heading.dot(-other.offset) > along_m && !is_met;
    if follows || other.offset.length_squared() > SIGHT_M * SIGHT_M {
        return None;
    }
    let touch_m = view.radius_m + other.radius_m;
    Some(Ahead {
        offset: other.offset,
        velocity: other.velocity,
        bulge_m: (other.radius_m - view.radius_m).max(0.0),
        aside_m: if is_met { touch_m } else { ASIDE_RATIO * touch_m },
        met_m_per_s: if is_met { -towards } else { 0.0 },
    })
}

/// True where a wall is beside the agent, nearer than a step to the side.
fn is_wall_in(view: &Perception<'_>, straight: DVec2, aside: DVec2) -> bool {
    let step_m = aside.length();
    view.walls.iter().any(|offset| {
        let aside_m = offset.dot(aside) / step_m;
        let along_m = offset.dot(straight);
        aside_m > 0.0
            && aside_m < step_m + view.radius_m
            && (-view.radius_m..SIDE_STEP_LENGTH_M).contains(&along_m)
    })
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
        // (0.68 - 0.22) / 0.89
        check(other(0.68, 0.0, 0.3), 0.46 / 0.89);
        check(other(0.2, 0.0, 0.0), 0.0);
        // Near, but walking away.
        check(other(0.2, 0.0, 0.4), 0.38);
        // At the side by 0.6 of the range the distance counts 1 / 0.8: (0.85 - 0.22) / 0.89.
        check(other(0.68, 0.3, 0.3), 0.63 / 0.89);
        // People far at the side, behind, or coming towards the agent are not followed.
        check(other(0.68, 0.5, 0.3), 1.0);
        check(other(-0.68, 0.0, 0.3), 1.0);
        check(other(0.68, 0.0, -0.3), 1.0);
    }

    #[test]
    fn one_who_is_slow_or_comes_near_is_passed_where_there_is_space() {
        for (x, speed) in [(1.0, 0.3), (2.0, -1.0)] {
            let passed = Headway::default().adapt(&view(&[other(x, 0.0, speed)], &[]), DVec2::X);
            assert!(passed.length() > 0.8 && passed.y < -0.2, "{passed}");
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
