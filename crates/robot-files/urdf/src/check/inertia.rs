//! Physical validity of masses and inertias.

use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::robot::{UrdfInertial, UrdfRobot};

/// Tolerance for rounded inertias, as a fraction of the trace.
const TOLERANCE_RATIO: f64 = 1e-6;

pub(super) fn check(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    for link in &robot.links {
        let Some(inertial) = &link.inertial else { continue };
        let name = &link.name;
        if inertial.mass_kg < 0.0 {
            diagnostics.push(
                Diagnostic::error("negative-mass", format!("the link `{name}` has negative mass"))
                    .at(inertial.origin)
                    .help("write a positive mass, or leave the whole `inertial` out"),
            );
        } else if inertial.mass_kg == 0.0 {
            diagnostics.push(
                Diagnostic::warning("zero-mass", format!("the link `{name}` has no mass"))
                    .at(inertial.origin)
                    .label("Gazebo treats this as no `inertial` at all")
                    .help("write a positive mass, or leave the whole `inertial` out"),
            );
        } else if let Some(fault) = fault(inertial) {
            diagnostics.push(
                Diagnostic::warning(
                    "impossible-inertia",
                    format!("the inertia of the link `{name}` is impossible: {fault}"),
                )
                .at(inertial.origin)
                .note(
                    "physics engines refuse such a link, or it spins without cause; libsdformat \
                     refuses it",
                )
                .help(format!(
                    "a solid box of edges x, y, z has ixx = m/12 (y² + z²) and so on; here m is \
                     {}",
                    periplus_geometry::format_number(inertial.mass_kg)
                )),
            );
        }
    }
}

/// Returns the fault of an inertia: it must be positive definite, and no principal moment may exceed the
/// sum of the other two.
fn fault(inertial: &UrdfInertial) -> Option<&'static str> {
    let [xx, xy, xz, yy, yz, zz] = inertial.inertia_kg_m2;
    let moments = principal_moments([xx, xy, xz, yy, yz, zz]);
    let slack = TOLERANCE_RATIO * (xx.abs() + yy.abs() + zz.abs());
    if moments == [0.0; 3] {
        return Some("all moments are zero");
    }
    if moments[0] < -slack {
        return Some("it is not positive definite");
    }
    if moments[0] + moments[1] < moments[2] - slack {
        return Some("the greatest principal moment exceeds the sum of the other two");
    }
    None
}

/// Eigenvalues of a symmetric matrix, ascending, by Jacobi rotations (Golub and Van Loan, Matrix
/// Computations, section 8.5).
fn principal_moments([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 3] {
    let mut a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    // Each sweep squares the off-diagonal part; six reach rounding from anywhere.
    for _ in 0..6 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let sign = if theta < 0.0 { -1.0 } else { 1.0 };
            let t = sign / (theta.abs() + root(theta));
            let c = 1.0 / root(t);
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (upper, lower) = (a[p], a[q]);
            for ((u, l), (out_u, out_l)) in upper.iter().zip(lower).zip(ends(&mut a, p, q)) {
                (*out_u, *out_l) = (c * u - s * l, s * u + c * l);
            }
        }
    }
    let mut moments = [a[0][0], a[1][1], a[2][2]];
    moments.sort_by(f64::total_cmp);
    moments
}

/// Rows `p` and `q` (`p < q`) of a matrix, side by side.
fn ends(a: &mut [[f64; 3]; 3], p: usize, q: usize) -> impl Iterator<Item = (&mut f64, &mut f64)> {
    let (above, below) = a.split_at_mut(q);
    above[p].iter_mut().zip(&mut below[0])
}

/// `sqrt(x² + 1)`.
fn root(x: f64) -> f64 {
    (x * x + 1.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_a_turned_box() {
        // diag(1, 2, 3) turned by 45 degrees about z: the xy block becomes [[1.5, .5], [.5, 1.5]].
        let moments = principal_moments([1.5, 0.5, 0.0, 1.5, 0.0, 3.0]);
        for (moment, expected) in moments.iter().zip([1.0, 2.0, 3.0]) {
            assert!((moment - expected).abs() < 1e-12, "{moments:?}");
        }
    }

    #[test]
    fn a_rod_and_a_disk_are_possible_and_a_needle_of_one_axis_is_not() {
        let fault = |inertia_kg_m2| {
            fault(&UrdfInertial { mass_kg: 1.0, inertia_kg_m2, ..UrdfInertial::default() })
        };
        assert_eq!(fault([0.0, 0.0, 0.0, 1.0, 0.0, 1.0]), None);
        assert_eq!(fault([1.0, 0.0, 0.0, 1.0, 0.0, 2.0]), None);
        assert!(fault([1.0, 0.0, 0.0, 1.0, 0.0, 2.1]).is_some());
        assert!(fault([1.0, 0.0, 0.0, 1.0, 0.0, -1.0]).is_some());
        assert!(fault([1.0, 2.0, 0.0, 1.0, 0.0, 1.0]).is_some());
        assert!(fault([0.0; 6]).is_some());
    }
}
