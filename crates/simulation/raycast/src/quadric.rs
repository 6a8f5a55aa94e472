//! Intersection of a line with a quadric surface.

use periplus_geometry::DVec3;

use crate::double_double::DoubleDouble;

/// The surface `w.x x² + w.y y² + w.z z² = c` about a centre on the z axis: spheres, ellipsoids,
/// infinite cylinders and double cones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Quadric {
    weights: [DoubleDouble; 3],
    constant: DoubleDouble,
    /// Z coordinate of the centre.
    centre_z: f64,
}

/// Intersection of a line with a [`Quadric`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Crossing {
    /// The line is outside everywhere.
    Outside,
    /// The line is inside everywhere.
    Inside,
    /// The line is inside between the two.
    Between(f64, f64),
    /// The line is outside between the two: a line steeper than a cone's side.
    Beyond(f64, f64),
}

impl Quadric {
    pub(crate) fn new(weights: [DoubleDouble; 3], constant: DoubleDouble, centre_z: f64) -> Self {
        Self { weights, constant, centre_z }
    }

    pub(crate) fn sphere(radius: f64, centre_z: f64) -> Self {
        let one = DoubleDouble::of(1.0);
        Self::new([one; 3], DoubleDouble::product(radius, radius), centre_z)
    }

    pub(crate) fn cylinder(radius: f64) -> Self {
        let one = DoubleDouble::of(1.0);
        Self::new([one, one, DoubleDouble::ZERO], DoubleDouble::product(radius, radius), 0.0)
    }

    /// A double cone about its tip.
    pub(crate) fn cone(radius: f64, length: f64, tip_z: f64) -> Self {
        let (r2, h2) =
            (DoubleDouble::product(radius, radius), DoubleDouble::product(length, length));
        Self::new([h2, h2, DoubleDouble::ZERO.sub(r2)], DoubleDouble::ZERO, tip_z)
    }

    pub(crate) fn ellipsoid(radii: DVec3) -> Self {
        let [x, y, z] = radii.to_array().map(|r| DoubleDouble::product(r, r));
        Self::new([y.mul(z), x.mul(z), x.mul(y)], x.mul(y).mul(z), 0.0)
    }

    /// Returns the gradient at a point: outwards, of any length.
    pub(crate) fn gradient(&self, point: DVec3) -> DVec3 {
        let [x, y, z] = self.weights.map(|w| w.high);
        DVec3::new(x * point.x, y * point.y, z * (point.z - self.centre_z))
    }

    /// Returns the part of the line `origin + t direction` that is inside.
    ///
    /// With `a t² + 2 b t + c = 0` the roots are `q / a` and `c / q`, `q = -b - sign(b) √(b² - ac)`.
    /// Cancellation in `b² - ac` (a near miss, a far origin) or in `c` (an origin on the surface)
    /// triggers a second computation in double-double precision.
    #[inline]
    pub(crate) fn crossing(&self, origin: DVec3, direction: DVec3) -> Crossing {
        let [wx, wy, wz] = self.weights.map(|w| w.high);
        let o = DVec3::new(origin.x, origin.y, origin.z - self.centre_z);
        let w = DVec3::new(wx, wy, wz);
        let a = (w * direction).dot(direction);
        let b = (w * o).dot(direction);
        let oo = (w * o).dot(o);
        let c = oo - self.constant.high;
        let discriminant = b * b - a * c;
        let scale = b * b + (a * c).abs();
        // Terms of both signs (a cone) and the tip of a cone need double-double precision as well.
        let magnitude = (w * o).abs().dot(o.abs()) + self.constant.high;
        let steep = (w * direction).abs().dot(direction.abs());
        if discriminant.abs() <= 1e-8 * scale.max(magnitude * steep)
            || c.abs() <= 1e-5 * magnitude
            || a.abs() <= 1e-5 * steep
        {
            return self.crossing_wide(origin, direction);
        }
        if discriminant < 0.0 {
            return if a < 0.0 { Crossing::Inside } else { Crossing::Outside };
        }
        let q = -(b + discriminant.sqrt().copysign(b));
        order(a, q / a, c / q)
    }

    #[cold]
    fn crossing_wide(&self, origin: DVec3, direction: DVec3) -> Crossing {
        let o = [
            DoubleDouble::of(origin.x),
            DoubleDouble::of(origin.y),
            DoubleDouble::sum(origin.z, -self.centre_z),
        ];
        let d = direction.to_array().map(DoubleDouble::of);
        let form = |p: &[DoubleDouble; 3], q: &[DoubleDouble; 3]| {
            let term = |axis: usize| self.weights[axis].mul(p[axis]).mul(q[axis]);
            term(0).add(term(1)).add(term(2))
        };
        let (a, b) = (form(&d, &d), form(&o, &d));
        let c = form(&o, &o).sub(self.constant);
        let discriminant = b.mul(b).sub(a.mul(c));
        if a.high == 0.0 {
            // Parallel to a cylinder's axis or a cone's side.
            if b.high == 0.0 {
                return if c.high <= 0.0 { Crossing::Inside } else { Crossing::Outside };
            }
            let root = -c.div(b).high / 2.0;
            return if b.high > 0.0 {
                Crossing::Between(f64::NEG_INFINITY, root)
            } else {
                Crossing::Between(root, f64::INFINITY)
            };
        }
        if discriminant.high < 0.0 && a.high > 0.0 {
            return Crossing::Outside;
        }
        // A line steeper than the cone's side always meets it: a negative root is rounding at the
        // tip.
        let root = discriminant.sqrt();
        let sum = if b.high < 0.0 { b.sub(root) } else { b.add(root) };
        let q = DoubleDouble::ZERO.sub(sum);
        let first = q.div(a).high;
        let second = if q.high == 0.0 { first } else { c.div(q).high };
        order(a.high, first, second)
    }
}

fn order(a: f64, first: f64, second: f64) -> Crossing {
    let (low, high) = if first < second { (first, second) } else { (second, first) };
    if a < 0.0 { Crossing::Beyond(low, high) } else { Crossing::Between(low, high) }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::DVec3;
    use proptest::prelude::*;

    use super::{Crossing, Quadric};

    fn ends(crossing: Crossing) -> Option<(f64, f64)> {
        match crossing {
            Crossing::Between(a, b) | Crossing::Beyond(a, b) => Some((a, b)),
            Crossing::Outside | Crossing::Inside => None,
        }
    }

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
    }

    proptest! {
        #[test]
        fn half_the_digits_are_enough_where_they_are_used(
            o in vector(20.0), d in vector(1.0), sizes in prop::array::uniform3(0.01..3.0),
            kind in 0..4,
        ) {
            let [a, b, c] = sizes;
            let quadric = match kind {
                0 => Quadric::sphere(a, b),
                1 => Quadric::cylinder(a),
                2 => Quadric::cone(a, b, c),
                _ => Quadric::ellipsoid(DVec3::new(a, b, c)),
            };
            let (quick, wide) = (quadric.crossing(o, d), quadric.crossing_wide(o, d));
            match (ends(quick), ends(wide)) {
                (Some((a0, a1)), Some((b0, b1))) => {
                    prop_assert!((a0 - b0).abs() <= 1e-9 * b0.abs(), "{a0} {b0}");
                    prop_assert!((a1 - b1).abs() <= 1e-9 * b1.abs(), "{a1} {b1}");
                }
                (quick, wide) => prop_assert_eq!(quick, wide),
            }
        }
    }
}
