//! What is asked and what is answered.

use periplus_geometry::DVec3;

/// A half line, or a piece of it. Distances count in lengths of the direction: in metres when that
/// is of length 1, as all of this crate's own scans and images make it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts \[m\].
    pub origin_m: DVec3,
    /// Where it goes.
    pub direction: DVec3,
    /// Nothing nearer counts \[m\].
    pub min_m: f64,
    /// Nothing farther counts \[m\].
    pub max_m: f64,
}

impl Ray {
    /// An endless ray.
    #[must_use]
    pub fn new(origin_m: DVec3, direction: DVec3) -> Self {
        Self { origin_m, direction, min_m: 0.0, max_m: f64::INFINITY }
    }

    /// The point at a distance \[m\].
    #[must_use]
    pub fn at(&self, distance_m: f64) -> DVec3 {
        self.origin_m + self.direction * distance_m
    }

    /// Whether there is anything to ask: finite numbers, some direction, a range. All others hit
    /// nothing.
    #[inline]
    pub(crate) fn is_sound(&self) -> bool {
        // No number is less or more than anything; without short cuts, as all are sound in practice.
        let length_squared = self.direction.length_squared();
        let near = |coordinate: f64| coordinate.abs() < 1e15;
        near(self.origin_m.x)
            & near(self.origin_m.y)
            & near(self.origin_m.z)
            & (length_squared > 1e-30)
            & (length_squared < 1e30)
            & (self.min_m.max(0.0) <= self.max_m)
    }
}

/// An instance in a [`crate::World`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstanceId(pub u32);

/// The nearest thing a ray meets. Faces are hit from both sides, and a ray that starts inside a
/// solid hits its far wall. Of several hits at the very same distance the one of the lowest
/// instance counts, and of that the lowest primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// How far along the ray \[m\].
    pub distance_m: f64,
    /// Unit normal of the surface, on the side the ray comes from.
    pub normal: DVec3,
    /// What was hit.
    pub instance: InstanceId,
    /// Which triangle of a mesh, in the order given; which face of a shape (see [`crate::Shape`]).
    pub primitive: u32,
}
