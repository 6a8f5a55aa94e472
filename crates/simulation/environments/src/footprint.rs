//! Footprints of robots.

use std::fmt;

use periplus_geometry::{Pose2, normalize_angle};

use crate::obstacles::ObstacleArea;
use crate::plane::{
    Point2, contains, distance_of_outlines, distance_to_outline, sides, squared_distance_to_segment,
};

/// Outline of a robot on the floor, in its base frame.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotFootprint {
    outline: Outline,
    circumscribed_radius_m: f64,
    inscribed_radius_m: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum Outline {
    Circle,
    Polygon(Vec<Point2>),
}

/// Reasons that an outline is no footprint.
#[derive(Clone, Debug, PartialEq)]
pub enum RobotFootprintError {
    /// The radius is not a positive number.
    Radius(f64),
    /// Fewer than three corners.
    TooFewCorners(usize),
    /// A corner is not finite.
    BadCorner(usize),
    /// The origin of the base frame is outside.
    OriginOutside,
}

impl fmt::Display for RobotFootprintError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radius(radius) => write!(f, "a footprint's radius must be above 0, not {radius}"),
            Self::TooFewCorners(count) => {
                write!(f, "a footprint needs at least 3 corners, as x1 y1 x2 y2 x3 y3, not {count}")
            }
            Self::BadCorner(at) => write!(f, "corner {at} of the footprint is not finite"),
            Self::OriginOutside => {
                write!(f, "the footprint must contain the origin of the base frame, (0, 0)")
            }
        }
    }
}

impl std::error::Error for RobotFootprintError {}

impl RobotFootprint {
    /// Creates a disc about the origin of the base frame.
    ///
    /// # Errors
    /// When the radius \[m\] is not a positive number.
    pub fn circle(radius_m: f64) -> Result<Self, RobotFootprintError> {
        if !(radius_m > 0.0 && radius_m.is_finite()) {
            return Err(RobotFootprintError::Radius(radius_m));
        }
        let (circumscribed_radius_m, inscribed_radius_m) = (radius_m, radius_m);
        Ok(Self { outline: Outline::Circle, circumscribed_radius_m, inscribed_radius_m })
    }

    /// Creates a simple polygon from its corners in order \[m\]; it need not be convex.
    ///
    /// # Errors
    /// When there are fewer than three corners, one is not finite, or the origin is outside.
    pub fn polygon(corners: Vec<[f64; 2]>) -> Result<Self, RobotFootprintError> {
        if corners.len() < 3 {
            return Err(RobotFootprintError::TooFewCorners(corners.len()));
        }
        if let Some(at) = corners.iter().position(|corner| !corner.iter().all(|it| it.is_finite()))
        {
            return Err(RobotFootprintError::BadCorner(at));
        }
        if !contains(&corners, [0.0; 2]) {
            return Err(RobotFootprintError::OriginOutside);
        }
        let radii = corners.iter().map(|[x, y]| libm::hypot(*x, *y));
        let circumscribed_radius_m = radii.fold(0.0, f64::max);
        let to_sides = sides(&corners).map(|side| squared_distance_to_segment([0.0; 2], side));
        let inscribed_radius_m = to_sides.fold(f64::INFINITY, f64::min).sqrt();
        let outline = Outline::Polygon(corners);
        Ok(Self { outline, circumscribed_radius_m, inscribed_radius_m })
    }

    /// Returns the radius of the smallest circle about the origin that contains the footprint \[m\].
    #[must_use]
    pub fn circumscribed_radius_m(&self) -> f64 {
        self.circumscribed_radius_m
    }

    /// Returns the radius of the largest circle about the origin inside the footprint \[m\].
    #[must_use]
    pub fn inscribed_radius_m(&self) -> f64 {
        self.inscribed_radius_m
    }

    /// Returns the corners in the base frame \[m\]; none of a circle.
    #[must_use]
    pub fn corners(&self) -> Option<&[[f64; 2]]> {
        match &self.outline {
            Outline::Circle => None,
            Outline::Polygon(corners) => Some(corners),
        }
    }

    /// Returns the footprint at a pose; `corners` is storage for the corners in the world.
    #[must_use]
    pub fn placed<'a>(
        &self,
        world_from_base: Pose2,
        corners: &'a mut Vec<[f64; 2]>,
    ) -> PlacedFootprint<'a> {
        corners.clear();
        if let Outline::Polygon(in_base) = &self.outline {
            let (sine, cosine) = libm::sincos(world_from_base.yaw_rad);
            corners.extend(in_base.iter().map(|[x, y]| {
                [
                    world_from_base.x_m + cosine * x - sine * y,
                    world_from_base.y_m + sine * x + cosine * y,
                ]
            }));
        }
        PlacedFootprint {
            centre: [world_from_base.x_m, world_from_base.y_m],
            radius_m: self.circumscribed_radius_m,
            corners,
        }
    }
}

/// RobotFootprint at a pose in the world.
#[derive(Clone, Copy, Debug)]
pub struct PlacedFootprint<'a> {
    centre: Point2,
    radius_m: f64,
    /// Corners in the world; empty for a circle.
    corners: &'a [Point2],
}

impl PlacedFootprint<'_> {
    pub(crate) fn bounds(&self) -> [Point2; 2] {
        let ([x, y], radius_m) = (self.centre, self.radius_m);
        [[x - radius_m, y - radius_m], [x + radius_m, y + radius_m]]
    }

    /// Returns the distance to an area; zero if they overlap \[m\].
    pub(crate) fn distance_to_area_m(&self, area: &ObstacleArea) -> f64 {
        match (area, self.corners) {
            (ObstacleArea::Circle { centre, radius_m }, []) => {
                let between_m = libm::hypot(self.centre[0] - centre[0], self.centre[1] - centre[1]);
                (between_m - radius_m - self.radius_m).max(0.0)
            }
            (ObstacleArea::Circle { centre, radius_m }, corners) => {
                (distance_to_outline(corners, *centre) - radius_m).max(0.0)
            }
            (ObstacleArea::Polygon(outline), []) => {
                (distance_to_outline(outline, self.centre) - self.radius_m).max(0.0)
            }
            (ObstacleArea::Polygon(outline), corners) => distance_of_outlines(outline, corners),
        }
    }

    /// Returns the distance to another footprint; zero if they overlap \[m\].
    pub(crate) fn distance_to_footprint_m(&self, other: &Self) -> f64 {
        match (self.corners, other.corners) {
            ([], _) => (other.distance_to_point_m(self.centre) - self.radius_m).max(0.0),
            (_, []) => (self.distance_to_point_m(other.centre) - other.radius_m).max(0.0),
            (one, another) => distance_of_outlines(one, another),
        }
    }

    fn distance_to_point_m(&self, point: Point2) -> f64 {
        if self.corners.is_empty() {
            let between_m = libm::hypot(self.centre[0] - point[0], self.centre[1] - point[1]);
            (between_m - self.radius_m).max(0.0)
        } else {
            distance_to_outline(self.corners, point)
        }
    }

    /// Returns the distance along a ray to the footprint; infinite without a hit, zero inside \[m\].
    pub(crate) fn range_m(&self, origin: Point2, direction: Point2) -> f64 {
        let (dx, dy) = (self.centre[0] - origin[0], self.centre[1] - origin[1]);
        let along = dx * direction[0] + dy * direction[1];
        let across = dx * direction[1] - dy * direction[0];
        let half_squared = self.radius_m * self.radius_m - across * across;
        if half_squared < 0.0 {
            return f64::INFINITY;
        }
        let half = half_squared.sqrt();
        if along + half < 0.0 {
            return f64::INFINITY;
        }
        if self.corners.is_empty() {
            return (along - half).max(0.0);
        }
        if contains(self.corners, origin) {
            return 0.0;
        }
        sides(self.corners).fold(f64::INFINITY, |nearest, [a, b]| {
            let (side, to_a) = ([b[0] - a[0], b[1] - a[1]], [a[0] - origin[0], a[1] - origin[1]]);
            let determinant = direction[0] * side[1] - direction[1] * side[0];
            let range_m = (to_a[0] * side[1] - to_a[1] * side[0]) / determinant;
            let fraction = (to_a[0] * direction[1] - to_a[1] * direction[0]) / determinant;
            let is_hit = range_m >= 0.0 && (0.0..=1.0).contains(&fraction);
            if is_hit { nearest.min(range_m) } else { nearest }
        })
    }
}

/// Returns the direction from one point to another relative to a heading, in (-π, π] \[rad\].
pub(crate) fn bearing_rad(from: Pose2, to: Point2) -> f64 {
    normalize_angle(libm::atan2(to[1] - from.y_m, to[0] - from.x_m) - from.yaw_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_of_a_rectangle() {
        let corners = vec![[0.4, 0.3], [-0.4, 0.3], [-0.4, -0.3], [0.4, -0.3]];
        let footprint = RobotFootprint::polygon(corners).expect("a footprint");
        assert_eq!(footprint.circumscribed_radius_m(), 0.5);
        assert_eq!(footprint.inscribed_radius_m(), 0.3);
    }

    #[test]
    fn outlines_that_are_no_footprint() {
        assert_eq!(RobotFootprint::circle(0.0), Err(RobotFootprintError::Radius(0.0)));
        assert_eq!(
            RobotFootprint::polygon(vec![[0.0; 2]; 2]),
            Err(RobotFootprintError::TooFewCorners(2))
        );
        let beside = vec![[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]];
        assert_eq!(RobotFootprint::polygon(beside), Err(RobotFootprintError::OriginOutside));
    }

    #[test]
    fn ranges_to_other_robots() {
        let corners = vec![[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]];
        let check = |footprint: &RobotFootprint, direction, expected: f64| {
            let mut storage = Vec::new();
            let placed = footprint.placed(Pose2::new(3.0, 0.0, 0.0), &mut storage);
            let found = placed.range_m([0.0; 2], direction);
            assert!(found == expected || (found - expected).abs() < 1e-12, "{found}");
        };
        let square = RobotFootprint::polygon(corners).expect("a footprint");
        let circle = RobotFootprint::circle(0.5).expect("a radius");
        check(&square, [1.0, 0.0], 2.5);
        check(&circle, [1.0, 0.0], 2.5);
        check(&square, [-1.0, 0.0], f64::INFINITY);
        check(&circle, [-1.0, 0.0], f64::INFINITY);
        check(&circle, [0.6, 0.8], f64::INFINITY);
    }
}
