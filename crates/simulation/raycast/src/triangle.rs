//! Watertight ray-triangle intersection.

use crate::simd::V8;

/// Returns distances to eight triangles (or of eight rays to one), and a mask of the hits in
/// `min..=best`, edges and corners included.
///
/// The watertight test of Woop, Benthin and Wald 2013 ("Watertight Ray/Triangle Intersection", JCGT
/// 2/1): a shear turns the ray into the z axis, and the signs of three areas decide. The area of an
/// edge is exactly negated for the adjacent triangle, since products commute and differences change
/// sign exactly. Therefore no ray passes between the two. Zero counts as either sign, which spares
/// the paper's fallback to double precision: a ray on an edge then hits both triangles instead of
/// one. Fused multiply-add would break the symmetry.
///
/// `corners` are relative to the ray's origin, with axes ordered as in `LocalRay::axes`.
#[inline(always)]
pub(crate) fn intersect<V: V8>(corners: [[V; 3]; 3], shear: [V; 3], min: V, best: V) -> (V, V) {
    let [a, b, c] = corners;
    let (a, b, c) = (sheared(a, shear), sheared(b, shear), sheared(c, shear));
    let (u, v, w) = (area(c, b), area(a, c), area(b, a));
    let zero = V::splat(0.0);
    let min_lane = u.min(v).min(w);
    let most = u.max(v).max(w);
    let inside = zero.le(min_lane).or(most.le(zero));
    let whole = u.add(v).add(w);
    let depth = u.mul(a[2]).add(v.mul(b[2])).add(w.mul(c[2])).mul(shear[2]);
    let distance = depth.div(whole);
    // A triangle seen edge-on has no area: 0/0 is outside every range.
    let within = min.le(distance).and(distance.le(best));
    (inside.and(within), distance)
}

#[inline(always)]
fn sheared<V: V8>([x, y, z]: [V; 3], shear: [V; 3]) -> [V; 3] {
    [x.sub(shear[0].mul(z)), y.sub(shear[1].mul(z)), z]
}

/// Returns twice the signed area spanned by the ray and an edge.
#[inline(always)]
fn area<V: V8>(p: [V; 3], q: [V; 3]) -> V {
    p[0].mul(q[1]).sub(p[1].mul(q[0]))
}
