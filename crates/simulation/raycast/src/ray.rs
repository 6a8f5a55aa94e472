//! Rays and hits.

use periplus_geometry::DVec3;

/// A half line, or a segment of it. Distances are multiples of the length of the direction: metres
/// when the direction has length 1, as in all scans and images of this workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin \[m\].
    pub origin_m: DVec3,
    /// Direction.
    pub direction: DVec3,
    /// Minimum distance of a hit \[m\].
    pub min_m: f64,
    /// Maximum distance of a hit \[m\].
    pub max_m: f64,
}

impl Ray {
    /// Returns a ray without a maximum distance.
    #[must_use]
    pub fn new(origin_m: DVec3, direction: DVec3) -> Self {
        Self { origin_m, direction, min_m: 0.0, max_m: f64::INFINITY }
    }

    /// The point at a distance \[m\].
    #[must_use]
    pub fn at(&self, distance_m: f64) -> DVec3 {
        self.origin_m + self.direction * distance_m
    }

    /// Returns true if the numbers are finite, the direction is not zero and the range is not empty.
    /// Any other ray hits nothing.
    #[inline]
    pub(crate) fn is_sound(&self) -> bool {
        // Comparisons with NaN are false. No short-circuit operators: in practice all rays are
        // sound.
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

/// Index of an instance in a [`crate::RaycastWorld`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstanceId(pub u32);

/// The first hit of a ray. Faces are hit from both sides, and a ray that starts inside a solid hits
/// its far wall. Among hits at equal distance the lowest instance wins, then the lowest primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray \[m\].
    pub distance_m: f64,
    /// Unit normal of the surface, on the side of the ray's origin.
    pub normal: DVec3,
    /// Instance that was hit.
    pub instance: InstanceId,
    /// Index of a mesh triangle in the order of input, or of a face of a shape (see
    /// [`crate::RaycastShape`]).
    pub primitive: u32,
}
