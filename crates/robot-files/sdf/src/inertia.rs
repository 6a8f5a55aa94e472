//! Physical validity of masses and inertias.

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Diagnostics};
use periplus_scene::Inertial;
use periplus_xml::Element;

/// Warns about a mass or inertia that no rigid body can have. `element` is the element that holds them.
pub fn check(inertial: &Inertial, link: &str, element: &Element, diagnostics: &mut Diagnostics) {
    if inertial.auto {
        return;
    }
    if inertial.mass_kg <= 0.0 {
        let place = element.child("mass").map_or(element.origin, Element::text_origin);
        diagnostics.push(
            Diagnostic::warning("bad-inertia", format!("link `{link}` has no mass"))
                .caused_by(DiagnosticCause::Inertia)
                .at(place)
                .help("give a link that moves a mass above 0"),
        );
        return;
    }
    let place = element.child("inertia").map_or(element.origin, |child| child.origin);
    match judge(inertial.inertia_kg_m2) {
        Verdict::Possible => {}
        Verdict::NotPositive => diagnostics.push(
            Diagnostic::warning(
                "bad-inertia",
                format!("the inertia of link `{link}` is not positive definite"),
            )
            .caused_by(DiagnosticCause::Inertia)
            .at(place)
            .note("every principal moment of inertia must be above 0")
            .help("for a box of mass m: ixx = m/12 (y² + z²), and so on"),
        ),
        Verdict::NotTriangle => diagnostics.push(
            Diagnostic::warning(
                "bad-inertia",
                format!("the inertia of link `{link}` breaks the triangle inequality"),
            )
            .caused_by(DiagnosticCause::Inertia)
            .at(place)
            .note("the sum of any two principal moments must be at least the third")
            .help("for a box of mass m: ixx = m/12 (y² + z²), and so on"),
        ),
    }
}

#[derive(Debug, PartialEq)]
enum Verdict {
    Possible,
    NotPositive,
    NotTriangle,
}

/// Classifies `xx, xy, xz, yy, yz, zz` without computing the principal moments: all are positive if the
/// leading minors are (Sylvester), and they satisfy the triangle inequality if the covariance `tr(I)/2 E -
/// I`, whose eigenvalues are half the excess of two moments over the third, has no negative eigenvalue.
fn judge([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Verdict {
    let scale = xx.abs().max(yy.abs()).max(zz.abs()).max(xy.abs()).max(xz.abs()).max(yz.abs());
    if scale == 0.0 {
        return Verdict::NotPositive;
    }
    let [xx, xy, xz, yy, yz, zz] = [xx, xy, xz, yy, yz, zz].map(|value| value / scale);
    let least = |minor: f64, slack: f64| minor > slack;
    let minors = |xx: f64, yy: f64, zz: f64, sign: f64| {
        let (xy, xz, yz) = (sign * xy, sign * xz, sign * yz);
        let cofactors = [yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy];
        let determinant =
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        (cofactors, determinant)
    };
    let (cofactors, determinant) = minors(xx, yy, zz, 1.0);
    let positive = [xx, yy, zz].iter().all(|value| least(*value, 0.0))
        && cofactors.iter().all(|value| least(*value, 0.0))
        && least(determinant, 0.0);
    if !positive {
        return Verdict::NotPositive;
    }
    let half = (xx + yy + zz) / 2.0;
    let (xx, yy, zz) = (half - xx, half - yy, half - zz);
    let (cofactors, determinant) = minors(xx, yy, zz, -1.0);
    // Values are rounded to a few digits, and a flat plate is exactly on the limit.
    let slack = -1e-3;
    let triangle = [xx, yy, zz].iter().all(|value| least(*value, slack))
        && cofactors.iter().all(|value| least(*value, slack))
        && least(determinant, slack);
    if triangle { Verdict::Possible } else { Verdict::NotTriangle }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_told_from_nonsense() {
        let diagonal = |xx, yy, zz| judge([xx, 0.0, 0.0, yy, 0.0, zz]);
        assert_eq!(diagonal(1.0, 1.0, 1.0), Verdict::Possible);
        // A flat plate: the third moment is the sum of the others.
        assert_eq!(diagonal(1.0, 1.0, 2.0), Verdict::Possible);
        assert_eq!(diagonal(1.0, 1.0, 2.1), Verdict::NotTriangle);
        assert_eq!(diagonal(1e-9, 1e-9, 3e-9), Verdict::NotTriangle);
        assert_eq!(diagonal(0.0, 1.0, 1.0), Verdict::NotPositive);
        assert_eq!(judge([1.0, 2.0, 0.0, 1.0, 0.0, 1.0]), Verdict::NotPositive);
        // A thin rod along (1, 1, 0): moments 1 across, nearly 0 along.
        assert_eq!(judge([0.505, -0.495, 0.0, 0.505, 0.0, 1.0]), Verdict::Possible);
    }
}
