//! Triangulation of polygons in space.

use glam::{DVec2, DVec3};

use crate::limits::Budget;
use crate::notes::Notes;

/// Splits the polygon with these corners (counter-clockwise from outside) and passes each triangle as
/// indices into `corners`.
///
/// A convex polygon becomes a fan; a concave one is triangulated by ear clipping (Meisters 1975, "Polygons
/// have ears"). A self-intersecting rest without ears becomes a fan with a note.
pub(crate) fn triangulate(
    corners: &[DVec3],
    budget: &mut Budget,
    notes: &mut Notes,
    emit: &mut dyn FnMut([usize; 3]),
) {
    let fan = |ring: &[usize], emit: &mut dyn FnMut([usize; 3])| {
        for pair in ring.get(1..).unwrap_or(&[]).windows(2) {
            emit([ring[0], pair[0], pair[1]]);
        }
    };
    let ring: Vec<usize> = (0..corners.len()).collect();
    if corners.len() <= 3 {
        return fan(&ring, emit);
    }
    let flat = project(corners);
    if is_convex(&flat) {
        return fan(&ring, emit);
    }
    let rest = cut_ears(&flat, ring, budget, emit);
    if rest.len() > 3 {
        notes.add("polygon crosses itself or is too large to split well: made a fan of it");
    }
    fan(&rest, emit);
}

/// Projects the polygon along its normal (Newell's method), counter-clockwise.
fn project(corners: &[DVec3]) -> Vec<DVec2> {
    let next = corners.iter().cycle().skip(1);
    // Relative to the first corner, so that a polygon far from the origin keeps its precision.
    let normal = corners
        .iter()
        .zip(next)
        .fold(DVec3::ZERO, |sum, (&a, &b)| sum + (a - corners[0]).cross(b - corners[0]));
    let axis = [normal.x, normal.y, normal.z].map(f64::abs);
    let flatten: fn(DVec3) -> DVec2 = if axis[2] >= axis[0] && axis[2] >= axis[1] {
        if normal.z >= 0.0 { |p| DVec2::new(p.x, p.y) } else { |p| DVec2::new(p.y, p.x) }
    } else if axis[1] >= axis[0] {
        if normal.y >= 0.0 { |p| DVec2::new(p.z, p.x) } else { |p| DVec2::new(p.x, p.z) }
    } else if normal.x >= 0.0 {
        |p| DVec2::new(p.y, p.z)
    } else {
        |p| DVec2::new(p.z, p.y)
    };
    corners.iter().map(|&p| flatten(p)).collect()
}

/// Twice the signed area of a triangle: positive if counter-clockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

fn is_convex(flat: &[DVec2]) -> bool {
    let n = flat.len();
    (0..n).all(|i| turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) >= 0.0)
}

/// Clips ears until three corners, no ear, or no budget is left.
fn cut_ears(
    flat: &[DVec2],
    mut ring: Vec<usize>,
    budget: &mut Budget,
    emit: &mut dyn FnMut([usize; 3]),
) -> Vec<usize> {
    let mut start = 0;
    while ring.len() > 3 {
        let n = ring.len();
        let ear = (0..n)
            .map(|k| (start + k) % n)
            .find(|&i| budget.ear_steps > 0 && is_ear(flat, &ring, i, &mut budget.ear_steps));
        let Some(i) = ear else { break };
        emit([ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]]);
        ring.remove(i);
        // Continuing next to the ear, not at corner 0, avoids long thin fans.
        start = i % ring.len();
    }
    ring
}

fn is_ear(flat: &[DVec2], ring: &[usize], i: usize, steps: &mut usize) -> bool {
    let n = ring.len();
    let (before, after) = ((i + n - 1) % n, (i + 1) % n);
    let [a, b, c] = [before, i, after].map(|k| flat[ring[k]]);
    if turn(a, b, c) < 0.0 {
        return false;
    }
    ring.iter().enumerate().all(|(k, &corner)| {
        *steps = steps.saturating_sub(1);
        let p = flat[corner];
        // A corner at the position of one of the ear's (a bridge to a hole) does not block it.
        let own = [before, i, after].contains(&k) || p == a || p == b || p == c;
        own || turn(a, b, p) < 0.0 || turn(b, c, p) < 0.0 || turn(c, a, p) < 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::MeshLimits;

    fn split(corners: &[[f64; 3]]) -> Vec<[usize; 3]> {
        let corners: Vec<DVec3> = corners.iter().map(|&p| p.into()).collect();
        let (mut budget, mut out) = (Budget::new(MeshLimits::default()), Vec::new());
        triangulate(&corners, &mut budget, &mut Notes::default(), &mut |t| out.push(t));
        out
    }

    #[test]
    fn a_square_is_a_fan() {
        let square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
        assert_eq!(split(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn an_arrowhead_keeps_its_notch_in_every_plane() {
        // Area of the arrowhead (0,0) (2,-2) (0,2)... notch at the origin: 2*4/2 - 0 = 4.
        let flat = [[0., 0.], [2., -2.], [0., 2.], [-2., -2.]];
        for turn_axes in 0..3usize {
            for mirrored in [false, true] {
                let mut corners: Vec<[f64; 3]> = flat
                    .iter()
                    .map(|&[u, v]| {
                        let mut p = [u, v, 5.0];
                        p.rotate_right(turn_axes);
                        p
                    })
                    .collect();
                if mirrored {
                    corners.reverse();
                }
                let triangles = split(&corners);
                assert_eq!(triangles.len(), 2);
                let normals: Vec<DVec3> = triangles
                    .iter()
                    .map(|t| {
                        let [a, b, c] = t.map(|i| DVec3::from_array(corners[i]));
                        (b - a).cross(c - a) / 2.0
                    })
                    .collect();
                // The areas add up only if no triangle covers the notch or is inverted.
                let total: f64 = normals.iter().map(|n| n.length()).sum();
                assert_eq!((total, (normals[0] + normals[1]).length()), (4.0, 4.0));
            }
        }
    }

    #[test]
    fn collinear_corners_do_not_hang_or_vanish() {
        assert_eq!(split(&[[0.; 3], [1., 0., 0.], [2., 0., 0.], [3., 0., 0.]]).len(), 2);
        assert_eq!(split(&[[0.; 3]; 6]).len(), 4);
    }

    proptest::proptest! {
        #[test]
        fn star_shaped_polygons_are_covered_exactly(
            radii in proptest::collection::vec(0.1f64..10.0, 4..60),
            tilt in -3.0f64..3.0,
        ) {
            let step = std::f64::consts::TAU / radii.len() as f64;
            let plane = glam::DQuat::from_euler(glam::EulerRot::XYZ, tilt, tilt * 0.7, 0.3);
            let corners: Vec<[f64; 3]> = (0u32..)
                .zip(&radii)
                .map(|(i, r)| {
                    let (sin, cos) = libm::sincos(f64::from(i) * step);
                    (plane * DVec3::new(r * cos, r * sin, 2.0)).to_array()
                })
                .collect();
            let triangles = split(&corners);
            proptest::prop_assert_eq!(triangles.len(), corners.len() - 2);
            let area = |[a, b, c]: [DVec3; 3]| (plane.inverse() * (b - a).cross(c - a)).z / 2.0;
            let areas = triangles.iter().map(|t| area(t.map(|i| corners[i].into())));
            let n = radii.len();
            let whole: f64 = (0..n).map(|i| radii[i] * radii[(i + 1) % n] * libm::sin(step) / 2.0).sum();
            let (mut total, mut least) = (0.0, f64::INFINITY);
            for area in areas {
                total += area;
                least = least.min(area);
            }
            proptest::prop_assert!((total - whole).abs() < 1e-9 * whole, "{total} {whole}");
            proptest::prop_assert!(least > -1e-9, "a triangle is turned over: {least}");
        }
    }
}
