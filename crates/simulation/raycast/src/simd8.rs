//! Eight rays against one shape, in double precision. Every number is computed by the steps of
//! [`Solid::cast`], bit for bit.

use periplus_geometry::DVec3;

use crate::shape::Solid;
use crate::simd::{V4, V8};

/// Eight vectors, one row per coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DVec3x8(pub(crate) [[f64; 8]; 3]);

impl DVec3x8 {
    #[inline(always)]
    pub(crate) fn splat(v: DVec3) -> Self {
        Self([[v.x; 8], [v.y; 8], [v.z; 8]])
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: DVec3) {
        let [x, y, z] = &mut self.0;
        (x[lane], y[lane], z[lane]) = (v.x, v.y, v.z);
    }

    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> DVec3 {
        let [x, y, z] = &self.0;
        DVec3::new(x[lane], y[lane], z[lane])
    }

    /// Transforms from the world into a frame at `origin` whose axes are these columns.
    #[inline(always)]
    pub(crate) fn into_frame<V: V8>(self, origin: DVec3, columns: &[DVec3; 3]) -> Self {
        let mut turned = [[0.0; 8]; 3];
        for half in 0..2 {
            let x = V::Four::load(&self.0[0], half).sub(V::Four::splat(origin.x));
            let y = V::Four::load(&self.0[1], half).sub(V::Four::splat(origin.y));
            let z = V::Four::load(&self.0[2], half).sub(V::Four::splat(origin.z));
            for axis in 0..3 {
                let column = columns[axis];
                let (a, b) = (V::Four::splat(column.x).mul(x), V::Four::splat(column.y).mul(y));
                let sum = a.add(b).add(V::Four::splat(column.z).mul(z));
                sum.store(&mut turned[axis], half);
            }
        }
        Self(turned)
    }
}

/// Distances and faces at which rays enter or leave a shape.
#[derive(Clone, Copy)]
pub(crate) struct HitDetail {
    /// NaN without a hit.
    pub(crate) distance: [f64; 8],
    pub(crate) face: [f64; 8],
}

impl Solid {
    /// Returns the results of [`Solid::cast`] for eight rays.
    #[inline(always)]
    pub(crate) fn cast8<V: V8>(
        &self,
        o: &DVec3x8,
        d: &DVec3x8,
        min: &[f64; 8],
        max: &[f64; 8],
    ) -> HitDetail {
        let mut met = HitDetail { distance: [f64::NAN; 8], face: [0.0; 8] };
        match self {
            Self::Plane { half } => {
                for part in 0..2 {
                    plane::<V::Four>(*half, part, o, d, [min, max], &mut met);
                }
            }
            Self::Box { half } => {
                for part in 0..2 {
                    cuboid::<V::Four>(*half, part, o, d, [min, max], &mut met);
                }
            }
            _ => self.one_by_one(o, d, [min, max], &mut met),
        }
        met
    }

    #[inline(never)]
    fn one_by_one(
        &self,
        o: &DVec3x8,
        d: &DVec3x8,
        [min, max]: [&[f64; 8]; 2],
        met: &mut HitDetail,
    ) {
        for lane in 0..8 {
            if let Some((t, face)) = self.cast(o.get(lane), d.get(lane), min[lane], max[lane]) {
                (met.distance[lane], met.face[lane]) = (t, face.into());
            }
        }
    }
}

#[inline(always)]
fn plane<F: V4>(
    half: Option<[f64; 2]>,
    part: usize,
    DVec3x8([ox, oy, oz]): &DVec3x8,
    DVec3x8([dx, dy, dz]): &DVec3x8,
    [min, max]: [&[f64; 8]; 2],
    met: &mut HitDetail,
) {
    let t = F::load(oz, part).mul(F::splat(-1.0)).div(F::load(dz, part));
    let mut hit = F::load(min, part).le(t).and(t.le(F::load(max, part)));
    if let Some([half_x, half_y]) = half {
        let x = F::load(ox, part).add(t.mul(F::load(dx, part)));
        let y = F::load(oy, part).add(t.mul(F::load(dy, part)));
        hit = hit.and(within(x, half_x)).and(within(y, half_y));
    }
    t.select(F::splat(f64::NAN), hit).store(&mut met.distance, part);
}

/// Returns a mask of the values in `-half..=half`.
#[inline(always)]
fn within<F: V4>(value: F, half: f64) -> F {
    F::splat(-half).le(value).and(value.le(F::splat(half)))
}

#[inline(always)]
fn cuboid<F: V4>(
    half: DVec3,
    part: usize,
    o: &DVec3x8,
    d: &DVec3x8,
    [min, max]: [&[f64; 8]; 2],
    met: &mut HitDetail,
) {
    let half = half.to_array();
    let zero = F::splat(0.0);
    let (mut enter, mut leave) = (F::splat(f64::NEG_INFINITY), F::splat(f64::INFINITY));
    let (mut enter_face, mut leave_face) = (zero, zero);
    for (axis, lower) in [0.0, 2.0, 4.0].into_iter().enumerate() {
        let (half, lower, upper) = (half[axis], F::splat(lower), F::splat(lower + 1.0));
        let (o, d) = (F::load(&o.0[axis], part), F::load(&d.0[axis], part));
        let low = F::splat(-half).sub(o).div(d);
        let high = F::splat(half).sub(o).div(d);
        let along = zero.lt(d);
        let (mut near, mut far) = (low.select(high, along), high.select(low, along));
        let level = d.le(zero).and(zero.le(d));
        if level.bits() != 0 {
            // A ray parallel to a pair of faces is between them everywhere or nowhere.
            let inside = within(o, half);
            let (endless, never) = (F::splat(f64::INFINITY), F::splat(f64::NEG_INFINITY));
            near = never.select(endless, inside).select(near, level);
            far = endless.select(never, inside).select(far, level);
        }
        let (later, sooner) = (enter.lt(near), far.lt(leave));
        enter = near.select(enter, later);
        enter_face = lower.select(upper, along).select(enter_face, later);
        leave = far.select(leave, sooner);
        leave_face = upper.select(lower, along).select(leave_face, sooner);
    }
    let (min, max) = (F::load(min, part), F::load(max, part));
    let crosses = enter.le(leave);
    let first = crosses.and(min.le(enter)).and(enter.le(max));
    let second = crosses.and(min.le(leave)).and(leave.le(max));
    let far = leave.select(F::splat(f64::NAN), second);
    enter.select(far, first).store(&mut met.distance, part);
    enter_face.select(leave_face, first).store(&mut met.face, part);
}

#[cfg(test)]
mod tests {
    use periplus_geometry::DVec3;
    use proptest::prelude::*;

    use super::{DVec3x8, HitDetail};
    use crate::RaycastShape;
    use crate::shape::Solid;
    use crate::simd::{Task, V8, dispatch, without_vectors};

    struct Cast<'a>(&'a Solid, &'a DVec3x8, &'a DVec3x8, [&'a [f64; 8]; 2]);

    impl Task for Cast<'_> {
        type Output = HitDetail;
        #[inline(always)]
        fn run<V: V8>(self) -> HitDetail {
            let Self(solid, o, d, [min, max]) = self;
            solid.cast8::<V>(o, d, min, max)
        }
    }

    /// Integer coordinates, so that rays run along faces and through edges.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), Just(-0.0), Just(1.0), Just(-1.0), Just(0.5), Just(-2.0), -3.0..3.0,]
    }

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(coordinate()).prop_map(DVec3::from_array)
    }

    proptest! {
        /// Batched or one by one: the same bits.
        #[test]
        fn eight_meet_what_each_meets(
            rays in prop::array::uniform8((vector(), vector(), coordinate(), 0.0_f64..9.0)),
            which in 0_usize..5,
        ) {
            let shape = [
                RaycastShape::Box { size_m: DVec3::new(2.0, 1.0, 3.0) },
                RaycastShape::Box { size_m: DVec3::new(2.0, 0.0, 3.0) },
                RaycastShape::Plane { size_m: None },
                RaycastShape::Plane { size_m: Some([2.0, 1.0]) },
                RaycastShape::Cylinder { radius_m: 1.0, length_m: 2.0 },
            ][which];
            let solid = Solid::new(&shape).unwrap();
            let (mut o, mut d) = (DVec3x8::splat(DVec3::ZERO), DVec3x8::splat(DVec3::ZERO));
            let (mut min, mut max) = ([0.0; 8], [0.0; 8]);
            for (lane, &(origin, direction, nearest, farthest)) in rays.iter().enumerate() {
                o.set(lane, origin);
                d.set(lane, direction);
                (min[lane], max[lane]) = (nearest.abs(), farthest);
            }
            let cast = || dispatch(Cast(&solid, &o, &d, [&min, &max]));
            for met in [cast(), without_vectors(cast)] {
                for lane in 0..8 {
                    let alone = solid.cast(o.get(lane), d.get(lane), min[lane], max[lane]);
                    let told = !met.distance[lane].is_nan();
                    let here = told.then_some((met.distance[lane].to_bits(), met.face[lane]));
                    prop_assert_eq!(here, alone.map(|(t, face)| (t.to_bits(), face.into())));
                }
            }
        }
    }
}
