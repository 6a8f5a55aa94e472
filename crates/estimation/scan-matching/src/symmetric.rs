//! Symmetric matrices over x, y and yaw.

use std::ops::{Add, AddAssign, Mul};

/// Symmetric matrix over (x, y, yaw): an information [1/m², 1/(m rad), 1/rad²] or a covariance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric3 {
    /// x with x.
    pub xx: f64,
    /// x with y.
    pub xy: f64,
    /// x with yaw.
    pub xt: f64,
    /// y with y.
    pub yy: f64,
    /// y with yaw.
    pub yt: f64,
    /// yaw with yaw.
    pub tt: f64,
}

impl Symmetric3 {
    /// No information, or no uncertainty.
    pub const ZERO: Self = Self { xx: 0.0, xy: 0.0, xt: 0.0, yy: 0.0, yt: 0.0, tt: 0.0 };

    /// Diagonal matrix.
    #[must_use]
    pub const fn diagonal(xx: f64, yy: f64, tt: f64) -> Self {
        Self { xx, xy: 0.0, xt: 0.0, yy, yt: 0.0, tt }
    }

    /// Adds `weight` times the outer product of a row with itself.
    #[inline]
    pub fn add_outer(&mut self, row: [f64; 3], weight: f64) {
        let [a, b, c] = row;
        let (wa, wb) = (weight * a, weight * b);
        self.xx += wa * a;
        self.xy += wa * b;
        self.xt += wa * c;
        self.yy += wb * b;
        self.yt += wb * c;
        self.tt += weight * c * c;
    }

    /// Matrix times column.
    #[must_use]
    pub fn times(&self, v: [f64; 3]) -> [f64; 3] {
        [
            self.xx * v[0] + self.xy * v[1] + self.xt * v[2],
            self.xy * v[0] + self.yy * v[1] + self.yt * v[2],
            self.xt * v[0] + self.yt * v[1] + self.tt * v[2],
        ]
    }

    /// Quadratic form: with an information matrix, the squared Mahalanobis distance.
    #[must_use]
    pub fn quadratic(&self, v: [f64; 3]) -> f64 {
        let w = self.times(v);
        v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
    }

    /// The determinant.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.xx * (self.yy * self.tt - self.yt * self.yt)
            - self.xy * (self.xy * self.tt - self.yt * self.xt)
            + self.xt * (self.xy * self.yt - self.yy * self.xt)
    }

    /// The inverse; none when the matrix is not positive definite to within rounding.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        // A Cholesky factorization first: its pivots decide definiteness at the scale of the
        // matrix.
        let l11 = self.xx;
        let pivot2 = self.yy - self.xy * self.xy / l11;
        let determinant = self.determinant();
        let is_definite = l11 > 0.0
            && pivot2 > 1e-13 * self.yy
            && determinant > 1e-13 * self.xx * self.yy * self.tt
            && determinant.is_finite();
        if !is_definite {
            return None;
        }
        let scale = 1.0 / determinant;
        Some(Self {
            xx: (self.yy * self.tt - self.yt * self.yt) * scale,
            xy: (self.xt * self.yt - self.xy * self.tt) * scale,
            xt: (self.xy * self.yt - self.xt * self.yy) * scale,
            yy: (self.xx * self.tt - self.xt * self.xt) * scale,
            yt: (self.xt * self.xy - self.xx * self.yt) * scale,
            tt: (self.xx * self.yy - self.xy * self.xy) * scale,
        })
    }

    /// Solves for the vector that this matrix maps to `b`; none if the matrix is not positive
    /// definite.
    #[must_use]
    pub fn solve(&self, b: [f64; 3]) -> Option<[f64; 3]> {
        Some(self.inverse()?.times(b))
    }

    /// Rotates the coordinates: with `yaw_rad` of `a_from_b`, a matrix over coordinates of `b`
    /// becomes one over coordinates of `a`.
    #[must_use]
    pub fn turned(&self, yaw_rad: f64) -> Self {
        let (s, c) = libm::sincos(yaw_rad);
        let Self { xx, xy, xt, yy, yt, tt } = *self;
        Self {
            xx: c * c * xx - 2.0 * c * s * xy + s * s * yy,
            xy: c * s * (xx - yy) + (c * c - s * s) * xy,
            xt: c * xt - s * yt,
            yy: s * s * xx + 2.0 * c * s * xy + c * c * yy,
            yt: s * xt + c * yt,
            tt,
        }
    }

    /// Covariance of `a_from_c` from those of `a_from_b` (self) and `b_from_c` (`next`), to first
    /// order. Errors of a pose are a translation along the axes of its parent and a rotation.
    #[must_use]
    pub fn compounded(
        &self,
        a_from_b: periplus_geometry::Pose2,
        b_from_c: periplus_geometry::Pose2,
        next: &Self,
    ) -> Self {
        // A rotation of b moves c perpendicular to the line between them.
        let (s, c) = libm::sincos(a_from_b.yaw_rad);
        let across = [-(s * b_from_c.x_m + c * b_from_c.y_m), c * b_from_c.x_m - s * b_from_c.y_m];
        let Self { xx, xy, xt, yy, yt, tt } = *self;
        let moved = Self {
            xx: xx + 2.0 * across[0] * xt + across[0] * across[0] * tt,
            xy: xy + across[0] * yt + across[1] * xt + across[0] * across[1] * tt,
            xt: xt + across[0] * tt,
            yy: yy + 2.0 * across[1] * yt + across[1] * across[1] * tt,
            yt: yt + across[1] * tt,
            tt,
        };
        moved + next.turned(a_from_b.yaw_rad)
    }

    /// Maximum variance of the position in any direction.
    #[must_use]
    pub fn largest_shift(&self) -> f64 {
        let mean = 0.5 * (self.xx + self.yy);
        let half = 0.5 * (self.xx - self.yy);
        mean + (half * half + self.xy * self.xy).sqrt()
    }

    /// Information about x and y with unknown yaw: the smaller and the larger eigenvalue, and the
    /// direction of the smaller one.
    #[must_use]
    pub fn weakest_shift(&self) -> (f64, f64, [f64; 2]) {
        let share = if self.tt > 0.0 { 1.0 / self.tt } else { 0.0 };
        let xx = self.xx - self.xt * self.xt * share;
        let xy = self.xy - self.xt * self.yt * share;
        let yy = self.yy - self.yt * self.yt * share;
        let mean = 0.5 * (xx + yy);
        let half = 0.5 * (xx - yy);
        let spread = (half * half + xy * xy).sqrt();
        let (low, high) = ((mean - spread).max(0.0), mean + spread);
        // Either row of (matrix - low) is perpendicular to the direction; the longer one is more
        // accurate.
        let (a, b) = ((xx - low, xy), (xy, yy - low));
        let (u, v) = if a.0 * a.0 + a.1 * a.1 > b.0 * b.0 + b.1 * b.1 { a } else { b };
        let length = (u * u + v * v).sqrt();
        let direction = if length > 0.0 { [-v / length, u / length] } else { [1.0, 0.0] };
        (low, high, direction)
    }
}

impl Add for Symmetric3 {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl AddAssign for Symmetric3 {
    fn add_assign(&mut self, other: Self) {
        self.xx += other.xx;
        self.xy += other.xy;
        self.xt += other.xt;
        self.yy += other.yy;
        self.yt += other.yt;
        self.tt += other.tt;
    }
}

impl Mul<f64> for Symmetric3 {
    type Output = Self;

    fn mul(self, k: f64) -> Self {
        Self {
            xx: self.xx * k,
            xy: self.xy * k,
            xt: self.xt * k,
            yy: self.yy * k,
            yt: self.yt * k,
            tt: self.tt * k,
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;

    fn definite() -> impl Strategy<Value = Symmetric3> {
        prop::array::uniform9(-2.0..2.0_f64).prop_map(|rows| {
            let mut sum = Symmetric3::diagonal(0.1, 0.1, 0.1);
            for row in rows.chunks_exact(3) {
                sum.add_outer([row[0], row[1], row[2]], 1.0);
            }
            sum
        })
    }

    #[test]
    fn a_rotation_moves_a_distant_pose_sideways() {
        let turn = Symmetric3::diagonal(0.0, 0.0, 0.01);
        let far = turn.compounded(Pose2::IDENTITY, Pose2::new(10.0, 0.0, 0.0), &Symmetric3::ZERO);
        assert!((far.yy - 1.0).abs() < 1e-12 && far.xx.abs() < 1e-12);
        assert!((far.largest_shift() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_corridor_has_no_information_along_itself() {
        let mut walls = Symmetric3::ZERO;
        for at in [-3.0, -1.0, 2.0] {
            walls.add_outer([0.0, 1.0, at], 100.0);
        }
        let (low, high, along) = walls.weakest_shift();
        assert!(low.abs() < 1e-9 && high > 10.0);
        assert!(along[0].abs() > 0.999_999 && along[1].abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn a_matrix_times_its_inverse_is_one(m in definite(), b in prop::array::uniform3(-3.0..3.0_f64)) {
            let x = m.solve(b).unwrap();
            let again = m.times(x);
            for i in 0..3 {
                prop_assert!((again[i] - b[i]).abs() < 1e-7);
            }
        }

        #[test]
        fn turning_keeps_lengths(m in definite(), v in prop::array::uniform3(-3.0..3.0_f64), yaw in -3.0..3.0_f64) {
            let (x, y) = Pose2::new(0.0, 0.0, yaw).transform_point(v[0], v[1]);
            prop_assert!((m.turned(yaw).quadratic([x, y, v[2]]) - m.quadratic(v)).abs() < 1e-9);
        }
    }
}
