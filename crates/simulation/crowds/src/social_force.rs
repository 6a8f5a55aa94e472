//! Social force model.
//!
//! D. Helbing, I. Farkas, T. Vicsek, "Simulating dynamical features of escape panic", Nature 407, 2000, equations 1 to 3,
//! per mass of 80 kg. The acceleration is a sum of four terms, with `n` the unit vector away from the other, `t` the
//! tangent, `d` the distance of the centres, `r` the sum of the radii, and `g(x) = max(x, 0)`:
//!
//! - driving: `(v0 e - v) / tau`;
//! - others: `(A exp((r - d) / B) + k g(r - d)) n + kappa g(r - d) dv_t t`: repulsion, body force, sliding friction;
//! - walls: the same with the distance from the nearest point of the wall and the radius of the agent;
//!
//! `A = 2000 N` and `B = 0.08 m` of the paper are for people in panic, and keep discs 0.18 m apart that would like to walk
//! on at 1.34 m/s: two do not fit into a passage of 1 m. The defaults are `A / m = 3 m/s²` (M. Moussaid, D. Helbing, S.
//! Garnier, A. Johansson, M. Combe, G. Theraulaz, Proc. R. Soc. B 276, 2009, for walls) and `B = 0.2 m`, which lies between
//! the ranges of both papers (0.08 m and 0.35 m) and gives lanes in the corridor of the module `experiments`.
//!
//! The fourth term is the force of a group: see the module `group`.
//!
//! The optional [`Headway`] lowers the preferred speed behind others. Without it the model is that of the papers.

use glam::DVec2;

use crate::group::group_acceleration;
use crate::headway::Headway;
use crate::perception::Perception;

/// Longest step for which the stiff forces of touch are stable \[s\].
pub(crate) const MAX_STEP_S: f64 = 0.01;

/// Others are not seen from farther away \[m\].
pub(crate) const RANGE_M: f64 = 5.0;

/// Distance in ranges beyond which the repulsion is below a thousandth of its strength.
const NEGLIGIBLE_RANGES_RATIO: f64 = 7.0;

/// Parameters of the social force model, with the published values as defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SocialForceParams {
    /// Time in which the preferred velocity is assumed, `tau` (default 0.5 s) \[s\].
    pub relaxation_time_s: f64,
    /// Repulsion of bodies in touch per mass, `A / m` (default 3 m/s²) \[m/s²\].
    pub repulsion_m_per_s2: f64,
    /// Range of the repulsion, `B` (default 0.2 m) \[m\].
    pub repulsion_range_m: f64,
    /// Stiffness of bodies per mass, `k / m` (default 1.2e5 / 80 per s²) \[1/s²\].
    pub body_stiffness_per_s2: f64,
    /// Sliding friction per mass and overlap, `kappa / m` (default 2.4e5 / 80 per m s) \[1/(m s)\].
    pub sliding_friction_per_m_s: f64,
    /// Distance to the one ahead (default [`Headway::default`]); none as in the paper.
    pub headway: Option<Headway>,
}

impl Default for SocialForceParams {
    fn default() -> Self {
        Self {
            relaxation_time_s: 0.5,
            repulsion_m_per_s2: 3.0,
            repulsion_range_m: 0.2,
            body_stiffness_per_s2: 1500.0,
            sliding_friction_per_m_s: 3000.0,
            headway: Some(Headway::default()),
        }
    }
}

impl SocialForceParams {
    /// Returns the velocity after a step \[m/s\].
    pub(crate) fn steer(&self, view: &Perception<'_>) -> DVec2 {
        let mut acceleration = (view.preferred - view.velocity) / self.relaxation_time_s;
        for other in view.neighbours {
            // An obstacle that does not avoid needs the avoidance of two.
            let weight = 2.0 * other.share_ratio;
            let radius_m = view.radius_m + other.radius_m;
            let relative = other.velocity - view.velocity;
            acceleration += self.body(other.offset, radius_m, relative, weight);
        }
        for &wall in view.walls {
            acceleration += self.body(wall, view.radius_m, -view.velocity, 1.0);
        }
        if let Some(group) = view.group {
            acceleration += group_acceleration(group, view.preferred, view.velocity);
        }
        (view.velocity + acceleration * view.step_s).clamp_length_max(view.max_speed_m_per_s)
    }

    /// Repulsion by a body or a wall, and the forces of touch \[m/s²\].
    fn body(&self, offset: DVec2, radius_m: f64, relative_velocity: DVec2, weight: f64) -> DVec2 {
        let distance_m = offset.length();
        let overlap_m = radius_m - distance_m;
        if distance_m < 1e-9 || -overlap_m > NEGLIGIBLE_RANGES_RATIO * self.repulsion_range_m {
            return DVec2::ZERO;
        }
        let away = -offset / distance_m;
        // Deeper overlaps are for the body force: the exponential would throw people apart.
        let exponent = (overlap_m / self.repulsion_range_m).min(0.0);
        let repulsion = away * (weight * self.repulsion_m_per_s2 * libm::exp(exponent));
        if overlap_m <= 0.0 {
            return repulsion;
        }
        let tangent = away.perp();
        let sliding = relative_velocity.dot(tangent);
        repulsion
            + away * (self.body_stiffness_per_s2 * overlap_m)
            + tangent * (self.sliding_friction_per_m_s * overlap_m * sliding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perception::Neighbour;

    fn alone(velocity: DVec2) -> Perception<'static> {
        Perception {
            velocity,
            radius_m: 0.2,
            preferred: DVec2::new(1.34, 0.0),
            max_speed_m_per_s: 2.0,
            neighbours: &[],
            walls: &[],
            group: None,
            step_s: 0.01,
        }
    }

    #[test]
    fn alone_an_agent_accelerates_by_its_lack_of_speed_per_relaxation_time() {
        let velocity = SocialForceParams::default().steer(&alone(DVec2::new(0.84, 0.0)));
        // 0.84 + (1.34 - 0.84) / 0.5 * 0.01
        assert!(velocity.distance(DVec2::new(0.85, 0.0)) < 1e-12, "{velocity}");
    }

    #[test]
    fn repulsion_falls_with_the_distance() {
        let velocity = DVec2::new(1.34, 0.0);
        let check = |share_ratio: f64, offset: [f64; 2], acceleration: [f64; 2]| {
            let other = Neighbour {
                offset: offset.into(),
                velocity,
                heading: DVec2::X,
                radius_m: 0.2,
                share_ratio,
            };
            let model = SocialForceParams { headway: None, ..SocialForceParams::default() };
            let found = model.steer(&Perception { neighbours: &[other], ..alone(velocity) });
            let expected = velocity + DVec2::from(acceleration) * 0.01;
            assert!(found.distance(expected) < 1e-9, "{found} {expected}");
        };
        // A gap of one range: 3 exp(-1).
        check(0.5, [0.6, 0.0], [-3.0 * libm::exp(-1.0), 0.0]);
        // A robot that does not avoid: twice as much.
        check(1.0, [0.0, 0.6], [0.0, -6.0 * libm::exp(-1.0)]);
        // Bodies that overlap by 0.01 m: 3 + 1500 * 0.01.
        check(0.5, [0.39, 0.0], [-18.0, 0.0]);
        check(0.5, [2.0, 0.0], [0.0, 0.0]);
    }

    #[test]
    fn bodies_that_slide_along_each_other_slow_down() {
        let still = Neighbour {
            offset: DVec2::new(0.0, 0.39),
            velocity: DVec2::ZERO,
            heading: DVec2::X,
            radius_m: 0.2,
            share_ratio: 0.5,
        };
        let velocity = DVec2::new(1.34, 0.0);
        let view = Perception { neighbours: &[still], ..alone(velocity) };
        let model = SocialForceParams { headway: None, ..SocialForceParams::default() };
        // 3000 * 0.01 * 1.34 for 0.01 s.
        let found = model.steer(&view);
        assert!((found.x - 1.34 * 0.7).abs() < 1e-9, "{found}");
    }

    #[test]
    fn a_wall_pushes_away_from_it() {
        let walls = [DVec2::new(0.0, 0.4)];
        let velocity = DVec2::new(1.34, 0.0);
        let found =
            SocialForceParams::default().steer(&Perception { walls: &walls, ..alone(velocity) });
        assert!((found.y + 3.0 * libm::exp(-1.0) * 0.01).abs() < 1e-12, "{found}");
    }
}
