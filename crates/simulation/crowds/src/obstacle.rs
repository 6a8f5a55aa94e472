//! Obstacles that move: robots, carts, vehicles.

use glam::DVec2;

/// Obstacle as a capsule around the segment between two points; equal points are a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingObstacle {
    /// Ends of the axis \[m\].
    pub axis: [DVec2; 2],
    /// Radius around the axis \[m\].
    pub radius_m: f64,
    /// Velocity \[m/s\].
    pub velocity: DVec2,
    /// True if it avoids people as they avoid each other. Otherwise people do all of the avoidance.
    pub is_reciprocal: bool,
}

impl MovingObstacle {
    /// Disc that does not avoid people.
    #[must_use]
    pub fn disc(centre: DVec2, radius_m: f64, velocity: DVec2) -> Self {
        Self { axis: [centre; 2], radius_m, velocity, is_reciprocal: false }
    }

    /// Returns the point of the axis that is nearest to a point.
    #[must_use]
    pub fn nearest_axis_point(&self, point: DVec2) -> DVec2 {
        let [start, end] = self.axis;
        crate::wall::Wall { start, end }.nearest_point(point)
    }

    /// Distance of a point to the obstacle, negative inside \[m\].
    #[must_use]
    pub fn distance_m(&self, point: DVec2) -> f64 {
        self.nearest_axis_point(point).distance(point) - self.radius_m
    }
}
