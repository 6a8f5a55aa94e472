//! Mass and inertia of links.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DQuat;
use periplus_scene::{Inertial, Link};
use rapier3d_f64::math::{Matrix, Pose as RapierPose, Vector};
use rapier3d_f64::parry::mass_properties::MassProperties;

use crate::limits::{MAX_INERTIA_KG_M2, MAX_MASS_KG, is_pose};

/// Default radius of gyration of a body without inertia [m].
const DEFAULT_GYRATION_M: f64 = 0.01;

/// Returns the mass properties of a link about its own frame, zero for a massless link; reports an
/// error and returns `None` for invalid ones.
pub(crate) fn mass_properties(
    link: &Link,
    name: &str,
    diagnostics: &mut Diagnostics,
) -> Option<MassProperties> {
    let Inertial { mass_kg, link_from_inertial, inertia_kg_m2, .. } = &link.inertial;
    let sound = mass_kg.abs() <= MAX_MASS_KG
        && is_pose(*link_from_inertial)
        && inertia_kg_m2.iter().all(|value| value.abs() <= MAX_INERTIA_KG_M2);
    if !sound {
        diagnostics.push(
            Diagnostic::error(
                "inertia-out-of-range",
                format!(
                    "mass or inertia of `{name}` is not finite, or beyond {MAX_MASS_KG:e} kg or \
                     {MAX_INERTIA_KG_M2:e} kg m²"
                ),
            )
            .at(link.origin)
            .help("set mass [kg] and inertia [kg m²] to finite numbers"),
        );
        return None;
    }
    if *mass_kg < 0.0 {
        diagnostics.push(no_mass(link, name));
        return None;
    }
    if *mass_kg == 0.0 {
        // A problem only if the body has no other mass.
        return Some(MassProperties::default());
    }
    let [xx, xy, xz, yy, yz, zz] = *inertia_kg_m2;
    let columns = [Vector::new(xx, xy, xz), Vector::new(xy, yy, yz), Vector::new(xz, yz, zz)];
    let inertia = Matrix::from_cols(columns[0], columns[1], columns[2]);
    let turn: DQuat = link_from_inertial.rotation;
    let to_link = Matrix::from_quat(turn);
    let about_com = to_link * inertia * to_link.transpose();
    let mut mass =
        MassProperties::with_inertia_matrix(link_from_inertial.translation, *mass_kg, about_com);
    let principal = mass.principal_inertia();
    let smallest = mass_kg * DEFAULT_GYRATION_M * DEFAULT_GYRATION_M * 1e-6;
    if principal.min_element() <= smallest {
        diagnostics.push(
            Diagnostic::warning(
                "no-inertia",
                format!("the inertia of `{name}` is not positive about every axis"),
            )
            .at(link.origin)
            .note("a radius of gyration of 1 cm about such an axis is assumed, or more as its joints and shapes require")
            .help("use the inertia of its shape: a box of sides a, b, c has m (b² + c²) / 12 about a"),
        );
        let least = Vector::splat(mass_kg * DEFAULT_GYRATION_M * DEFAULT_GYRATION_M);
        let raised = Vector::select(principal.cmple(Vector::splat(smallest)), least, principal);
        mass = MassProperties::with_principal_inertia_frame(
            mass.local_com,
            *mass_kg,
            raised,
            mass.principal_inertia_local_frame,
        );
    }
    Some(mass)
}

/// Returns the warning for a body without mass.
pub(crate) fn no_mass(link: &Link, name: &str) -> Diagnostic {
    let mass_kg = link.inertial.mass_kg;
    Diagnostic::error(
        "no-mass",
        format!("`{name}` has a mass of {mass_kg} kg and cannot be moved by forces"),
    )
    .at(link.origin)
    .help(
        "add an <inertial> with a positive mass, fix it to another link, or make its model static",
    )
}

/// Transforms mass properties to another frame.
pub(crate) fn transformed(mass: MassProperties, body_from_link: &RapierPose) -> MassProperties {
    mass.transform_by(body_from_link)
}
