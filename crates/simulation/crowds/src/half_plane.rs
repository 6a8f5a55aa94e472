//! Linear programmes in the plane of velocities.
//!
//! Source: J. van den Berg, S. J. Guy, M. Lin, D. Manocha, "Reciprocal n-body collision avoidance", Robotics Research,
//! 2011, section 5.3: constraints are added one after the other, and where no velocity satisfies all of them, the
//! largest violation is minimised (a linear programme in three dimensions).

use glam::DVec2;

/// Lines whose directions have a smaller cross product count as parallel.
const PARALLEL_RATIO: f64 = 1e-5;

/// Half-plane of allowed velocities: those to the left of a directed line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HalfPlane {
    /// Point on the line \[m/s\].
    pub(crate) point: DVec2,
    /// Unit vector along the line.
    pub(crate) direction: DVec2,
}

impl HalfPlane {
    /// Half-plane of the velocities `v` with `(v - point) . normal >= 0`.
    pub(crate) fn with_normal(point: DVec2, normal: DVec2) -> Self {
        Self { point, direction: DVec2::new(normal.y, -normal.x) }
    }

    /// Distance of a velocity outside the half-plane, negative inside \[m/s\].
    pub(crate) fn violation(&self, velocity: DVec2) -> f64 {
        self.direction.perp_dot(self.point - velocity)
    }
}

/// Aim of an optimisation in the disc of velocities.
#[derive(Clone, Copy)]
enum Aim {
    /// As near as possible to a velocity.
    Nearest(DVec2),
    /// As far as possible along a unit vector.
    Farthest(DVec2),
}

/// Returns the velocity nearest to `preferred` within all half-planes and the speed limit. Where there is none, the
/// first `hard_count` half-planes hold and the largest violation of the others is least.
pub(crate) fn nearest_allowed(
    planes: &[HalfPlane],
    hard_count: usize,
    max_speed: f64,
    preferred: DVec2,
) -> DVec2 {
    match solve(planes, max_speed, Aim::Nearest(preferred)) {
        (velocity, None) => velocity,
        (velocity, Some(failed)) => {
            least_violation(planes, hard_count, failed, max_speed, velocity)
        }
    }
}

/// Adds the half-planes in their order. Returns the optimum, or the last velocity and the first half-plane that
/// cannot be satisfied.
fn solve(planes: &[HalfPlane], max_speed: f64, aim: Aim) -> (DVec2, Option<usize>) {
    let mut velocity = match aim {
        Aim::Nearest(velocity) => velocity.clamp_length_max(max_speed),
        Aim::Farthest(direction) => direction * max_speed,
    };
    for (number, plane) in planes.iter().enumerate() {
        if plane.violation(velocity) > 0.0 {
            match best_on_line(&planes[..number], plane, max_speed, aim) {
                Some(better) => velocity = better,
                None => return (velocity, Some(number)),
            }
        }
    }
    (velocity, None)
}

/// Returns the best velocity on the line of a half-plane that satisfies the others and the speed limit.
fn best_on_line(
    others: &[HalfPlane],
    plane: &HalfPlane,
    max_speed: f64,
    aim: Aim,
) -> Option<DVec2> {
    let HalfPlane { point, direction } = *plane;
    let along = point.dot(direction);
    let discriminant = along * along + max_speed * max_speed - point.length_squared();
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let (mut low, mut high) = (-along - root, -along + root);
    for other in others {
        let denominator = direction.perp_dot(other.direction);
        let numerator = other.direction.perp_dot(point - other.point);
        if denominator.abs() <= PARALLEL_RATIO {
            if numerator < 0.0 {
                return None;
            }
            continue;
        }
        let at = numerator / denominator;
        if denominator >= 0.0 {
            high = high.min(at);
        } else {
            low = low.max(at);
        }
        if low > high {
            return None;
        }
    }
    let at = match aim {
        Aim::Nearest(velocity) => direction.dot(velocity - point).clamp(low, high),
        Aim::Farthest(towards) if direction.dot(towards) > 0.0 => high,
        Aim::Farthest(_) => low,
    };
    Some(point + direction * at)
}

/// Minimises the largest violation of the half-planes after the first `hard_count`, from the first that failed on.
fn least_violation(
    planes: &[HalfPlane],
    hard_count: usize,
    failed: usize,
    max_speed: f64,
    mut velocity: DVec2,
) -> DVec2 {
    let mut largest = 0.0;
    let mut projected = Vec::with_capacity(planes.len());
    for (number, plane) in planes.iter().enumerate().skip(failed) {
        if plane.violation(velocity) <= largest {
            continue;
        }
        projected.clear();
        projected.extend_from_slice(&planes[..hard_count.min(number)]);
        projected.extend(
            planes[hard_count.min(number)..number]
                .iter()
                .filter_map(|other| equal_violation(plane, other)),
        );
        let inward = DVec2::new(-plane.direction.y, plane.direction.x);
        // Failure has numerical causes only: the velocity so far stays.
        if let (better, None) = solve(&projected, max_speed, Aim::Farthest(inward)) {
            velocity = better;
        }
        largest = plane.violation(velocity);
    }
    velocity
}

/// Half-plane of the velocities that violate `other` at most as much as `plane`.
fn equal_violation(plane: &HalfPlane, other: &HalfPlane) -> Option<HalfPlane> {
    let determinant = plane.direction.perp_dot(other.direction);
    let point = if determinant.abs() <= PARALLEL_RATIO {
        if plane.direction.dot(other.direction) > 0.0 {
            return None;
        }
        (plane.point + other.point) * 0.5
    } else {
        let at = other.direction.perp_dot(plane.point - other.point) / determinant;
        plane.point + plane.direction * at
    };
    Some(HalfPlane { point, direction: (other.direction - plane.direction).normalize() })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn plane(point: [f64; 2], normal: [f64; 2]) -> HalfPlane {
        HalfPlane::with_normal(point.into(), DVec2::from(normal).normalize())
    }

    #[test]
    fn the_nearest_velocity_is_a_projection() {
        let check = |planes: &[HalfPlane], preferred: [f64; 2], expected: [f64; 2]| {
            let found = nearest_allowed(planes, 0, 2.0, preferred.into());
            assert!(found.distance(expected.into()) < 1e-9, "{found}");
        };
        check(&[], [1.0, 0.0], [1.0, 0.0]);
        check(&[], [4.0, 0.0], [2.0, 0.0]);
        // x at most 0.5.
        check(&[plane([0.5, 0.0], [-1.0, 0.0])], [1.0, 0.3], [0.5, 0.3]);
        // x at most 0.5, y at least 1.
        check(
            &[plane([0.5, 0.0], [-1.0, 0.0]), plane([0.0, 1.0], [0.0, 1.0])],
            [1.0, 0.0],
            [0.5, 1.0],
        );
    }

    #[test]
    fn contradictions_are_violated_equally() {
        // x at least 1 and x at most -1: both are violated by 1.
        let planes = [plane([1.0, 0.0], [1.0, 0.0]), plane([-1.0, 0.0], [-1.0, 0.0])];
        let found = nearest_allowed(&planes, 0, 2.0, DVec2::ZERO);
        assert!(found.x.abs() < 1e-9, "{found}");
        // The first is hard: it holds.
        let found = nearest_allowed(&planes, 1, 2.0, DVec2::ZERO);
        assert!((found.x - 1.0).abs() < 1e-9, "{found}");
    }

    proptest! {
        #[test]
        fn no_velocity_of_a_raster_is_better(
            numbers in prop::collection::vec((-1.0..1.0_f64, 0.0..6.2_f64), 1..7),
            preferred in (-1.5..1.5_f64, -1.5..1.5_f64),
        ) {
            let planes: Vec<HalfPlane> = numbers
                .iter()
                .map(|&(offset, angle)| {
                    let normal = DVec2::new(libm::cos(angle), libm::sin(angle));
                    HalfPlane::with_normal(normal * offset, normal)
                })
                .collect();
            let preferred = DVec2::from(preferred);
            let found = nearest_allowed(&planes, 0, 1.5, preferred);
            prop_assert!(found.length() <= 1.5 + 1e-9);
            let worst = |velocity: DVec2| {
                planes.iter().map(|plane| plane.violation(velocity)).fold(0.0, f64::max)
            };
            let (violation, distance) = (worst(found), found.distance(preferred));
            for i in -15..=15 {
                for j in -15..=15 {
                    let other = DVec2::new(f64::from(i), f64::from(j)) * 0.1;
                    if other.length() > 1.5 {
                        continue;
                    }
                    prop_assert!(worst(other) >= violation - 1e-3);
                    if violation < 1e-9 && worst(other) == 0.0 {
                        prop_assert!(other.distance(preferred) >= distance - 1e-6);
                    }
                }
            }
        }
    }
}
