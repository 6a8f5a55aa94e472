//! Optimal reciprocal collision avoidance.
//!
//! Source: J. van den Berg, S. J. Guy, M. Lin, D. Manocha, "Reciprocal n-body collision avoidance", Robotics Research
//! (STAR 70), 2011. Each other agent forbids the velocities that lead to a collision within a time horizon; the agent
//! leaves that set by its share of the smallest change (section 4). Walls use the optimisation velocity zero, so that
//! the programme always has a solution for them (section 5.4): the speed towards a wall is at most the distance per
//! horizon.
//!
//! The paper's agents keep their preferred speed until bodies touch, which no crowd does: the optional [`Headway`] lowers
//! the preferred speed, as Curtis and Manocha ("Pedestrian simulation using geometric reasoning in velocity space", PED
//! 2012) do by the length of a stride. Without it the model is that of the paper.

use glam::DVec2;

use crate::group::group_acceleration;
use crate::half_plane::{HalfPlane, nearest_allowed};
use crate::headway::Headway;
use crate::perception::{Neighbour, Perception};

/// Longest step \[s\].
pub(crate) const MAX_STEP_S: f64 = 0.05;

/// Time in which the acceleration of a group acts on the preferred velocity \[s\].
const GROUP_TIME_S: f64 = 0.5;

/// Parameters of ORCA.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrcaParams {
    /// Horizon within which no collision with others may occur (default 2 s) \[s\].
    pub time_horizon_s: f64,
    /// Horizon for walls (default 0.15 s) \[s\].
    pub wall_time_horizon_s: f64,
    /// Range within which others are seen (default 5 m) \[m\].
    pub neighbour_range_m: f64,
    /// Maximum number of others that are considered, the nearest first (default 12).
    pub max_neighbours: usize,
    /// Distance to the one ahead (default [`Headway::default`]); none as in the paper.
    pub headway: Option<Headway>,
}

impl Default for OrcaParams {
    fn default() -> Self {
        Self {
            time_horizon_s: 2.0,
            wall_time_horizon_s: 0.15,
            neighbour_range_m: 5.0,
            max_neighbours: 12,
            headway: Some(Headway::default()),
        }
    }
}

impl OrcaParams {
    /// Returns the velocity after a step \[m/s\].
    pub(crate) fn steer(&self, view: &Perception<'_>) -> DVec2 {
        let mut preferred = view.preferred;
        if let Some(group) = view.group {
            let wanted = preferred.length();
            preferred += group_acceleration(group, preferred, view.velocity) * GROUP_TIME_S;
            preferred = preferred.clamp_length_max(wanted.max(0.5));
        }
        let walls = view.walls.iter().map(|offset| self.wall(view, *offset, view.step_s));
        let mut planes: Vec<HalfPlane> = walls.collect();
        let hard_count = planes.len();
        planes.extend(view.neighbours.iter().map(|other| self.agent(view, other)));
        nearest_allowed(&planes, hard_count, view.max_speed_m_per_s, preferred)
    }

    /// Velocities that do not reach a wall within the horizon.
    fn wall(&self, view: &Perception<'_>, offset: DVec2, step_s: f64) -> HalfPlane {
        let distance_m = offset.length();
        let away = if distance_m < 1e-9 { DVec2::X } else { -offset / distance_m };
        let gap_m = distance_m - view.radius_m;
        let horizon_s = if gap_m < 0.0 { step_s } else { self.wall_time_horizon_s };
        // A body in a wall leaves it at no more than half of its speed limit, so that the programme stays feasible.
        let speed = (gap_m / horizon_s).max(-0.5 * view.max_speed_m_per_s);
        HalfPlane::with_normal(away * -speed, away)
    }

    /// Velocities that do not lead to a collision with another agent within the horizon, by the agent's share.
    fn agent(&self, view: &Perception<'_>, other: &Neighbour) -> HalfPlane {
        let relative = view.velocity - other.velocity;
        let radius_m = view.radius_m + other.radius_m;
        let (change, outward) =
            leave_obstacle(other.offset, relative, radius_m, self.time_horizon_s, view.step_s);
        HalfPlane::with_normal(view.velocity + change * other.share_ratio, outward)
    }
}

/// Returns the smallest change of a relative velocity to the boundary of the velocity obstacle of a disc, and the
/// normal of the boundary there, away from the obstacle (the paper, section 4, figure 2).
fn leave_obstacle(
    offset: DVec2,
    relative: DVec2,
    radius_m: f64,
    horizon_s: f64,
    step_s: f64,
) -> (DVec2, DVec2) {
    let distance_squared = offset.length_squared();
    let radius_squared = radius_m * radius_m;
    let to_circle = |horizon_s: f64| {
        let from_centre = relative - offset / horizon_s;
        let length = from_centre.length();
        let outward =
            if length < 1e-9 { -offset.normalize_or(DVec2::X) } else { from_centre / length };
        (outward * (radius_m / horizon_s - length), outward)
    };
    if distance_squared <= radius_squared {
        return to_circle(step_s);
    }
    let from_centre = relative - offset / horizon_s;
    let towards = from_centre.dot(offset);
    if towards < 0.0 && towards * towards > radius_squared * from_centre.length_squared() {
        return to_circle(horizon_s);
    }
    // A leg of the cone: the tangents from the origin to the disc.
    let leg_m = (distance_squared - radius_squared).sqrt();
    let is_left = offset.perp_dot(from_centre) > 0.0;
    let side = if is_left { 1.0 } else { -1.0 };
    let along = (offset * leg_m + offset.perp() * (side * radius_m)) / distance_squared;
    let outward = along.perp() * side;
    (along * relative.dot(along) - relative, outward)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(velocity: DVec2, neighbours: &[Neighbour]) -> Perception<'_> {
        Perception {
            velocity,
            radius_m: 0.25,
            preferred: velocity,
            max_speed_m_per_s: 2.0,
            neighbours,
            walls: &[],
            group: None,
            step_s: 0.05,
        }
    }

    #[test]
    fn the_velocity_obstacle_is_left_by_the_shortest_change() {
        let check = |offset: [f64; 2], relative: [f64; 2], expected: [f64; 2]| {
            let (change, outward) = leave_obstacle(offset.into(), relative.into(), 0.5, 2.0, 0.05);
            assert!(change.distance(expected.into()) < 1e-9, "{change}");
            assert!((outward.length() - 1.0).abs() < 1e-9);
        };
        // The circle around (2, 0) with radius 0.25: a velocity of 1.8 must fall to 1.75.
        check([4.0, 0.0], [1.8, 0.0], [-0.05, 0.0]);
        // Bodies that overlap by 0.1 separate within one step of 0.05 s.
        check([0.4, 0.0], [0.0, 0.0], [-2.0, 0.0]);
        // The leg of an obstacle at (1.3, 0): its half angle has sine 5/13, cosine 12/13.
        let (sine, cosine) = (5.0 / 13.0, 12.0 / 13.0);
        check([1.3, 0.0], [2.0, 0.0], [-2.0 * sine * sine, -2.0 * sine * cosine]);
    }

    #[test]
    fn two_who_meet_share_the_avoidance_and_one_who_meets_a_robot_does_all() {
        let velocity = DVec2::new(1.0, 0.0);
        let other = |share_ratio| Neighbour {
            offset: DVec2::new(3.0, 0.1),
            velocity: -velocity,
            heading: -DVec2::X,
            radius_m: 0.25,
            share_ratio,
        };
        let model = OrcaParams { headway: None, ..OrcaParams::default() };
        let half = model.steer(&view(velocity, &[other(0.5)]));
        let whole = model.steer(&view(velocity, &[other(1.0)]));
        // Away from the side of the other.
        assert!(half.y < -1e-3 && whole.y < -1e-3, "{half} {whole}");
        assert!(((whole - velocity) - (half - velocity) * 2.0).length() < 1e-6, "{half} {whole}");
    }

    #[test]
    fn the_speed_towards_a_wall_is_the_distance_per_horizon() {
        let walls = [DVec2::new(0.34, 0.0)];
        let view = Perception { walls: &walls, ..view(DVec2::new(1.0, 0.2), &[]) };
        let found = OrcaParams::default().steer(&view);
        // The body is 0.09 m from the wall; the horizon is 0.15 s.
        assert!(found.distance(DVec2::new(0.6, 0.2)) < 1e-9, "{found}");
    }
}
