//! Adjustment of inertias and joints for a stable solver.
//!
//! A body with moments of inertia far below those of any body of its mass and extent spins up
//! without bound under forces at its joints and contacts. So does a body that violates the triangle
//! inequality. Both are common in hand-written files. ODE simulates some of them and diverges on
//! others; here they are raised, with a warning.

use periplus_diagnostics::Diagnostic;
use rapier3d_f64::dynamics::SpringCoefficients;
use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::mass_properties::MassProperties;

use super::Builder;
use crate::records::{Body, BodyKind};

/// Minimum radius of gyration about an axis, relative to the maximum distance from this axis at
/// which forces act: joints and corners of shapes. A solid box has at least 0.4.
const MIN_GYRATION_RATIO: f64 = 0.1;
/// Maximum moment of inertia relative to the sum of the other two. No body exceeds 1; up to this
/// factor the given values are used.
const MAX_MOMENT_RATIO: f64 = 2.0;
/// Ratio of mass or moment of inertia of neighbouring bodies above which a body's joints are
/// softened: rigid joints would correct each other's errors indefinitely.
const HEAVY_NEIGHBOURS_RATIO: f64 = 4.0;
/// Minimum number of such joints; two joints are stable.
const MIN_JOINT_COUNT: usize = 3;
/// Softness of such joints: the stiffest with which a base carries eight wheels of ten times its
/// mass each.
const HEAVY_NEIGHBOURS_SPRING: SpringCoefficients<f64> =
    SpringCoefficients { natural_frequency: 200.0, damping_ratio: 5.0 };

impl Builder<'_, '_> {
    /// Raises moments of inertia that are impossible for a body's mass and extent.
    pub(super) fn stabilize_inertias(&mut self, first_body: usize, first_axis: usize) {
        for number in first_body..self.records.bodies.len() {
            let body = &self.records.bodies[number];
            if body.kind != BodyKind::Dynamic || body.mass.mass() <= 0.0 {
                continue;
            }
            let reach = reach_squared(body, &self.held(number, first_axis));
            let Some(mass) = raised(&body.mass, reach) else { continue };
            let (before, after) = (body.mass.principal_inertia(), mass.principal_inertia());
            let origin = self.records.links.iter().position(|link| link.body == number);
            let origin = origin.and_then(|link| self.flat.links.get(link - self.first_link));
            self.records.bodies[number].mass = mass;
            if self.without_inertia.contains(&number) {
                continue;
            }
            let body = &self.records.bodies[number];
            let mut found = Diagnostic::warning(
                "inertia-raised",
                format!(
                    "the moments of inertia of `{}`, {} kg m², are too small for its mass of {} kg and its \
                     extent; {} kg m² are used",
                    body.name,
                    list(before),
                    body.mass.mass(),
                    list(after)
                ),
            )
            .help("a box of sides a, b, c has m (b² + c²) / 12 about a");
            if let Some((_, link, _)) = origin {
                found = found.at(link.origin);
            }
            self.diagnostics.push(found);
        }
    }

    /// Softens the joints of light bodies with several heavy neighbours.
    pub(super) fn stabilize_joints(&mut self, first_body: usize, first_axis: usize) {
        for number in first_body..self.records.bodies.len() {
            let body = &self.records.bodies[number];
            if body.kind != BodyKind::Dynamic {
                continue;
            }
            let held = self.held(number, first_axis);
            if held.len() < MIN_JOINT_COUNT {
                continue;
            }
            let masses_kg: f64 = held.iter().map(|(_, other)| other.mass()).sum();
            let moments = held.iter().fold(Vector::ZERO, |sum, (anchor, other)| {
                let own = Vector::splat(other.principal_inertia().max_element());
                sum + across_squared(&body.mass, *anchor) * other.mass() + own
            });
            let limits = body.mass.principal_inertia() * HEAVY_NEIGHBOURS_RATIO;
            let is_light = masses_kg > body.mass.mass() * HEAVY_NEIGHBOURS_RATIO
                || moments.cmpgt(limits).any();
            if !is_light {
                continue;
            }
            for axis in &mut self.records.axes[first_axis..] {
                if axis.body1 == number || axis.body2 == number {
                    axis.data.softness = HEAVY_NEIGHBOURS_SPRING;
                }
            }
        }
    }

    /// Returns the positions of a body's joints in its frame, and the bodies at their other ends.
    fn held(&self, body: usize, first_axis: usize) -> Vec<(Vector, MassProperties)> {
        let mass_of = |other: usize| self.records.bodies[other].mass;
        let axes = self.records.axes[first_axis..].iter();
        axes.filter_map(|axis| match (axis.body1 == body, axis.body2 == body) {
            (true, _) => Some((axis.body1_from_axis.translation, mass_of(axis.body2))),
            (_, true) => Some((axis.body2_from_axis.translation, mass_of(axis.body1))),
            _ => None,
        })
        .collect()
    }
}

/// Returns the squared distance of a point from each principal axis [m²].
fn across_squared(mass: &MassProperties, point: Vector) -> Vector {
    let at = mass.principal_inertia_local_frame.inverse() * (point - mass.local_com);
    let square = at * at;
    Vector::splat(square.element_sum()) - square
}

/// Returns the squared maximum distance of forces from each principal axis [m²].
fn reach_squared(body: &Body, held: &[(Vector, MassProperties)]) -> Vector {
    let mut reach = Vector::ZERO;
    let mut add = |point: Vector| {
        let across = across_squared(&body.mass, point);
        if across.is_finite() {
            reach = reach.max(across);
        }
    };
    held.iter().for_each(|&(point, _)| add(point));
    for collider in &body.colliders {
        let bounds = collider.shape.compute_aabb(&collider.position);
        bounds.vertices().into_iter().for_each(&mut add);
    }
    reach
}

/// Returns the mass with raised moments of inertia; `None` if they are sufficient.
fn raised(mass: &MassProperties, reach_squared: Vector) -> Option<MassProperties> {
    let given = mass.principal_inertia();
    let least = reach_squared * (mass.mass() * MIN_GYRATION_RATIO * MIN_GYRATION_RATIO);
    let mut moments = given.max(least);
    let largest = moments.max_element();
    let others = moments.element_sum() - largest;
    let missing = largest / MAX_MOMENT_RATIO - others;
    if missing > 0.0 {
        // The deficit is added to the two others in equal parts.
        let is_other = moments.cmplt(Vector::splat(largest));
        moments = Vector::select(is_other, moments + Vector::splat(missing / 2.0), moments);
    }
    (moments != given && moments.is_finite()).then(|| {
        MassProperties::with_principal_inertia_frame(
            mass.local_com,
            mass.mass(),
            moments,
            mass.principal_inertia_local_frame,
        )
    })
}

fn list(moments: Vector) -> String {
    format!("{:.3e}, {:.3e}, {:.3e}", moments.x, moments.y, moments.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mass(moments: [f64; 3]) -> MassProperties {
        MassProperties::new(Vector::ZERO, 2.0, Vector::from_array(moments))
    }

    #[test]
    fn sound_moments_stay() {
        assert!(raised(&mass([1.0, 1.0, 1.9]), Vector::splat(1.0)).is_none());
        // Physically impossible, and used as given.
        assert!(raised(&mass([1.0, 1.0, 3.9]), Vector::splat(1.0)).is_none());
    }

    #[test]
    fn too_small_ones_are_raised() {
        // 2 kg, a tenth of 0.5 m: 2 * 0.05².
        let found =
            raised(&mass([1e-9, 1.0, 1.0]), Vector::splat(0.25)).map(|it| it.principal_inertia());
        assert!(
            found.is_some_and(|it| it.distance(Vector::new(0.005, 1.0, 1.0)) < 1e-9),
            "{found:?}"
        );
    }

    #[test]
    fn one_that_exceeds_the_others_lifts_them() {
        // 8 may be twice 4: 3 are missing.
        let found = raised(&mass([0.5, 0.5, 8.0]), Vector::ZERO).map(|it| it.principal_inertia());
        assert!(
            found.is_some_and(|it| it.distance(Vector::new(2.0, 2.0, 8.0)) < 1e-9),
            "{found:?}"
        );
    }
}
