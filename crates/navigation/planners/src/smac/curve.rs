//! Curves of bounded curvature between two poses.

use std::f64::consts::PI;

use periplus_geometry::Pose2;

use super::{dubins, reeds_shepp};

/// Direction of a part of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Steer {
    Left,
    Straight,
    Right,
}

impl Steer {
    /// Returns the mirrored direction.
    pub(crate) fn mirrored(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Straight => Self::Straight,
            Self::Right => Self::Left,
        }
    }
}

/// Part of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CurvePart {
    pub(crate) steer: Steer,
    /// Length in multiples of the radius, which is the angle of an arc \[rad\]; negative backwards.
    pub(crate) length: f64,
}

/// Maximum number of parts of a curve.
pub(crate) const MAX_PART_COUNT: usize = 5;

/// Curve of arcs of one radius and straight parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curve {
    parts: [CurvePart; MAX_PART_COUNT],
    radius: f64,
}

/// Family of curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CurveFamily {
    /// Forwards only.
    Dubins,
    /// Forwards and backwards.
    ReedsShepp,
}

impl CurveFamily {
    /// Returns the shortest curve between two poses, in any unit of length.
    pub(crate) fn shortest(self, from: Pose2, to: Pose2, radius: f64) -> Curve {
        self.cheapest(from, to, radius, 0.0)
    }

    /// Returns the curve between two poses with the lowest sum of its length and a length for each cusp.
    pub(crate) fn cheapest(self, from: Pose2, to: Pose2, radius: f64, cusp_cost: f64) -> Curve {
        let parts = match self {
            Self::Dubins => dubins::shortest(from, to, radius),
            Self::ReedsShepp => reeds_shepp::cheapest(from, to, radius, cusp_cost),
        };
        Curve { parts, radius }
    }
}

/// Part of no length.
pub(crate) const NO_PART: CurvePart = CurvePart { steer: Steer::Straight, length: 0.0 };

impl Curve {
    /// Returns the length of the curve, in the unit of the radius.
    pub(crate) fn length(&self) -> f64 {
        self.radius * self.parts.iter().map(|part| part.length.abs()).sum::<f64>()
    }

    /// Returns the fractions of the length at which the curve changes between forwards and backwards.
    pub(crate) fn cusps(&self) -> impl Iterator<Item = f64> {
        let total: f64 = self.parts.iter().map(|part| part.length.abs()).sum();
        let parts = self.parts.iter().map(|part| part.length).filter(|length| *length != 0.0);
        let mut travelled = 0.0;
        let mut last = 0.0;
        parts.filter_map(move |length| {
            let before = travelled;
            let is_cusp = last * length < 0.0;
            travelled += length.abs();
            last = length;
            is_cusp.then_some(before / total)
        })
    }

    /// Returns the pose at a fraction of the length of a curve that begins at a pose.
    pub(crate) fn pose_at(&self, from: Pose2, fraction: f64) -> Pose2 {
        let mut rest = fraction * self.length() / self.radius;
        let mut pose = from;
        for CurvePart { steer, length } in self.parts {
            let travel = length.signum() * length.abs().min(rest);
            rest -= travel.abs();
            pose = advanced(pose, steer, travel, self.radius);
            if rest <= 0.0 {
                break;
            }
        }
        pose
    }
}

/// Returns the pose after a part of a curve.
fn advanced(from: Pose2, steer: Steer, travel: f64, radius: f64) -> Pose2 {
    let (sine, cosine) = libm::sincos(from.yaw_rad);
    let side = match steer {
        Steer::Straight => {
            let distance = travel * radius;
            let (x_m, y_m) = (from.x_m + distance * cosine, from.y_m + distance * sine);
            return Pose2 { x_m, y_m, ..from };
        }
        Steer::Left => 1.0,
        Steer::Right => -1.0,
    };
    let yaw_rad = from.yaw_rad + side * travel;
    let (end_sine, end_cosine) = libm::sincos(yaw_rad);
    Pose2 {
        x_m: from.x_m + side * radius * (end_sine - sine),
        y_m: from.y_m + side * radius * (cosine - end_cosine),
        yaw_rad,
    }
}

/// Returns an equivalent angle in [0, 2π) \[rad\]; angles that miss 2π by rounding only are 0.
pub(crate) fn positive_angle(angle_rad: f64) -> f64 {
    const ROUNDING_RAD: f64 = 1e-9;
    let turn = 2.0 * PI;
    let angle = angle_rad - turn * libm::floor(angle_rad / turn);
    if turn - angle < ROUNDING_RAD { 0.0 } else { angle }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::normalize_angle;
    use proptest::prelude::*;

    use super::*;

    fn check(family: CurveFamily, from: Pose2, to: Pose2, length: f64) {
        let curve = family.shortest(from, to, 1.0);
        assert!((curve.length() - length).abs() < 1e-9, "{curve:?}: {}", curve.length());
    }

    #[test]
    fn lengths_that_are_known() {
        let origin = Pose2::IDENTITY;
        for family in [CurveFamily::Dubins, CurveFamily::ReedsShepp] {
            check(family, origin, Pose2::new(5.0, 0.0, 0.0), 5.0);
            check(family, origin, Pose2::new(1.0, 1.0, PI / 2.0), PI / 2.0);
            check(family, origin, Pose2::new(0.0, 2.0, PI), PI);
            check(family, origin, origin, 0.0);
        }
        check(CurveFamily::ReedsShepp, origin, Pose2::new(-3.0, 0.0, 0.0), 3.0);
        // Three arcs of a right angle each turn a car around on the spot, if it may reverse.
        check(CurveFamily::ReedsShepp, origin, Pose2::new(0.0, 0.0, PI), PI);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn curves_end_at_their_goal(
            x in -6.0..6.0, y in -6.0..6.0, start in -4.0..4.0, end in -4.0..4.0_f64,
            radius in 0.3..3.0_f64,
        ) {
            let (from, to) = (Pose2::new(0.5, -0.25, start), Pose2::new(x, y, end));
            let families = [CurveFamily::Dubins, CurveFamily::ReedsShepp];
            let curves = families.map(|family| family.shortest(from, to, radius));
            for curve in curves {
                let last = curve.pose_at(from, 1.0);
                let miss = libm::hypot(last.x_m - x, last.y_m - y);
                prop_assert!(miss < 1e-6, "{curve:?} misses by {miss}");
                prop_assert!(normalize_angle(last.yaw_rad - end).abs() < 1e-6);
                prop_assert!(curve.length() >= libm::hypot(x - 0.5, y + 0.25) - 1e-9);
            }
            prop_assert!(curves[1].length() <= curves[0].length() + 1e-6, "reversing never hurts");
            let cost = |curve: Curve| curve.length() + 2.0 * curve.cusps().count() as f64;
            let cheapest = CurveFamily::ReedsShepp.cheapest(from, to, radius, 2.0);
            prop_assert!(cost(cheapest) <= cost(curves[1]) + 1e-6, "{cheapest:?}");
            prop_assert!(cheapest.length() >= curves[1].length() - 1e-9);
        }
    }
}
