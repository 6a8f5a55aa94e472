//! Symmetric 3×3 matrices.

use periplus_geometry::{DQuat, DVec3};

/// A 3×3 matrix by columns.
#[derive(Clone, Copy)]
pub(super) struct Matrix([DVec3; 3]);

impl Matrix {
    pub(super) const ZERO: Self = Self([DVec3::ZERO; 3]);

    pub(super) fn symmetric([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Self {
        Self([DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz)])
    }

    /// The inertia of a point mass at `d` about the origin.
    pub(super) fn of_point(mass_kg: f64, d: DVec3) -> Self {
        let square = d.length_squared();
        let column = |axis: DVec3, part: f64| mass_kg * (square * axis - part * d);
        Self([column(DVec3::X, d.x), column(DVec3::Y, d.y), column(DVec3::Z, d.z)])
    }

    pub(super) fn plus(self, other: Self) -> Self {
        let [a, b, c] = self.0;
        let [d, e, f] = other.0;
        Self([a + d, b + e, c + f])
    }

    /// `R self Rᵀ`.
    pub(super) fn turned(self, rotation: DQuat) -> Self {
        let times = |vector: DVec3| {
            let [a, b, c] = self.0;
            a * vector.x + b * vector.y + c * vector.z
        };
        let back = rotation.conjugate();
        Self([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| rotation * times(back * axis)))
    }

    pub(super) fn upper(self) -> [f64; 6] {
        let [a, b, c] = self.0;
        [a.x, b.x, c.x, b.y, c.y, c.z]
    }
}
