//! Where a line crosses a surface of second order.

use periplus_geometry::DVec3;

use crate::wide::Wide;

/// The surface `w.x x² + w.y y² + w.z z² = c` about a centre on the z axis: spheres, ellipsoids,
/// endless cylinders and double cones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Quadric {
    weights: [Wide; 3],
    constant: Wide,
    /// Height of the centre.
    centre_z: f64,
}

/// How a line meets a [`Quadric`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Crossing {
    /// It stays outside.
    Outside,
    /// It stays inside.
    Inside,
    /// It is inside from the first to the second.
    Between(f64, f64),
    /// It is outside from the first to the second: a cone met steeply.
    Beyond(f64, f64),
}

impl Quadric {
    pub(crate) fn new(weights: [Wide; 3], constant: Wide, centre_z: f64) -> Self {
        Self { weights, constant, centre_z }
    }

    pub(crate) fn sphere(radius: f64, centre_z: f64) -> Self {
        let one = Wide::of(1.0);
        Self::new([one; 3], Wide::product(radius, radius), centre_z)
    }

    pub(crate) fn cylinder(radius: f64) -> Self {
        let one = Wide::of(1.0);
        Self::new([one, one, Wide::ZERO], Wide::product(radius, radius), 0.0)
    }

    /// A double cone about its tip.
    pub(crate) fn cone(radius: f64, length: f64, tip_z: f64) -> Self {
        let (r2, h2) = (Wide::product(radius, radius), Wide::product(length, length));
        Self::new([h2, h2, Wide::ZERO.sub(r2)], Wide::ZERO, tip_z)
    }

    pub(crate) fn ellipsoid(radii: DVec3) -> Self {
        let [x, y, z] = radii.to_array().map(|r| Wide::product(r, r));
        Self::new([y.mul(z), x.mul(z), x.mul(y)], x.mul(y).mul(z), 0.0)
    }

    /// The gradient at a point, outwards, of any length.
    pub(crate) fn gradient(&self, point: DVec3) -> DVec3 {
        let [x, y, z] = self.weights.map(|w| w.high);
        DVec3::new(x * point.x, y * point.y, z * (point.z - self.centre_z))
    }

    /// Where the line `origin + t direction` is inside.
    ///
    /// With `a t² + 2 b t + c = 0` the roots are `q / a` and `c / q`, `q = -b - sign(b) √(b² - ac)`.
    /// What cancels in `b² - ac` (a near miss, a far origin) or in `c` (an origin on the surface)
    /// is computed again with twice the digits.
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
        // Terms of both signs (a cone's) or a cone's tip need care as well.
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
        let o = [Wide::of(origin.x), Wide::of(origin.y), Wide::sum(origin.z, -self.centre_z)];
        let d = direction.to_array().map(Wide::of);
        let form = |p: &[Wide; 3], q: &[Wide; 3]| {
            let term = |axis: usize| self.weights[axis].mul(p[axis]).mul(q[axis]);
            term(0).add(term(1)).add(term(2))
        };
        let (a, b) = (form(&d, &d), form(&o, &d));
        let c = form(&o, &o).sub(self.constant);
        let discriminant = b.mul(b).sub(a.mul(c));
        if a.high == 0.0 {
            // Along a cylinder's axis or a cone's side.
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
        // A cone met steeply is met: a root of less than nothing is rounding at the tip.
        let root = discriminant.sqrt();
        let sum = if b.high < 0.0 { b.sub(root) } else { b.add(root) };
        let q = Wide::ZERO.sub(sum);
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
