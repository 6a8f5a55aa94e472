//! Combined mass and inertia of links on fixed joints.

use periplus_geometry::{DVec3, Pose};

use super::matrix::Matrix;
use crate::robot::UrdfInertial;

/// Mass and inertia of a body in the frame of the link that carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Combined {
    /// Mass [kg].
    pub(crate) mass_kg: f64,
    /// Centre of mass and axes of the inertia.
    pub(crate) link_from_inertial: Pose,
    /// `xx, xy, xz, yy, yz, zz` [kg m²].
    pub(crate) inertia_kg_m2: [f64; 6],
}

/// Adds inertials, each with the frame of its link in the carrier's, the carrier's own first. A single one
/// is returned exact to the last bit. The axes of the sum are those of the carrier's inertial, as in
/// libsdformat (`ReduceInertialToParent`).
pub(crate) fn combine<'a>(
    own: Option<&'a UrdfInertial>,
    others: impl Iterator<Item = (Pose, &'a UrdfInertial)>,
) -> Option<Combined> {
    let own = own.map(|inertial| (Pose::IDENTITY, inertial));
    let axes = own.map_or(Pose::IDENTITY, |(_, inertial)| Pose {
        translation: DVec3::ZERO,
        ..inertial.link_from_inertial.pose()
    });
    let parts: Vec<Combined> = own
        .into_iter()
        .chain(others)
        .map(|(carrier_from_link, inertial)| Combined {
            mass_kg: inertial.mass_kg,
            link_from_inertial: carrier_from_link * inertial.link_from_inertial.pose(),
            inertia_kg_m2: inertial.inertia_kg_m2,
        })
        .collect();
    if let [only] = &*parts
        && only.mass_kg > 0.0
    {
        return Some(*only);
    }
    let mass_kg: f64 = parts.iter().map(|part| part.mass_kg).sum();
    if mass_kg.is_nan() || mass_kg <= 0.0 {
        return None;
    }
    let moment: DVec3 =
        parts.iter().map(|part| part.mass_kg * part.link_from_inertial.translation).sum();
    let centre = moment / mass_kg;
    let mut about_centre = Matrix::ZERO;
    for part in &parts {
        let turned = Matrix::symmetric(part.inertia_kg_m2).turned(part.link_from_inertial.rotation);
        // The parallel axis theorem: m (d² 1 - d dᵀ).
        let d = part.link_from_inertial.translation - centre;
        about_centre = about_centre.plus(turned).plus(Matrix::of_point(part.mass_kg, d));
    }
    let in_axes = about_centre.turned(axes.rotation.conjugate());
    Some(Combined {
        mass_kg,
        link_from_inertial: Pose { translation: centre, rotation: axes.rotation },
        inertia_kg_m2: in_axes.upper(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Rotation, UrdfOrigin};

    fn point(mass_kg: f64, xyz_m: [f64; 3]) -> UrdfInertial {
        UrdfInertial {
            mass_kg,
            link_from_inertial: UrdfOrigin { xyz_m, ..UrdfOrigin::default() },
            ..UrdfInertial::default()
        }
    }

    #[test]
    fn two_equal_points_balance_in_the_middle() {
        let points = [point(1.0, [1.0, 0.0, 0.0]), point(1.0, [0.0; 3])];
        let there = Pose::from_xyz(-1.0, 0.0, 0.0);
        let sum = combine(Some(&points[0]), [(there, &points[1])].into_iter()).unwrap();
        assert_eq!(sum.mass_kg, 2.0);
        assert_eq!(sum.link_from_inertial, Pose::IDENTITY);
        // Each 1 kg at 1 m: 2 kg m² about y and z, none about x.
        assert_eq!(sum.inertia_kg_m2, [0.0, 0.0, 0.0, 2.0, 0.0, 2.0]);
    }

    #[test]
    fn a_turned_rod_lies_along_y() {
        let rod = UrdfInertial {
            mass_kg: 1.0,
            inertia_kg_m2: [0.0, 0.0, 0.0, 1.0, 0.0, 1.0],
            ..UrdfInertial::default()
        };
        let quarter = UrdfOrigin {
            rotation: Rotation::Rpy([0.0, 0.0, std::f64::consts::FRAC_PI_2]),
            ..UrdfOrigin::default()
        };
        let sum = combine(Some(&point(1.0, [0.0; 3])), [(quarter.pose(), &rod)].into_iter());
        for (found, expected) in
            sum.unwrap().inertia_kg_m2.iter().zip([1.0, 0.0, 0.0, 0.0, 0.0, 1.0])
        {
            assert!((found - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn nothing_weighs_nothing() {
        assert_eq!(combine(None, std::iter::empty()), None);
        assert_eq!(combine(Some(&point(0.0, [1.0; 3])), std::iter::empty()), None);
    }
}
