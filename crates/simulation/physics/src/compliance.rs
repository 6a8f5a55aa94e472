//! Stiffness of contacts: a load is shared by all points that carry it.
//!
//! The solver gives a contact a stiffness in proportion to the mass of the two bodies that touch,
//! seen from the contact point. A caster fixed to a heavy deck is then fifty times as stiff as a
//! light wheel beside it, carries everything, and the wheels spin. Here each contact of a model
//! with joints has one stiffness [N/m], whatever its link weighs. Gazebo reaches the same with
//! ODE's surface layer, in which contacts are not corrected, and with `kp`.

use rapier3d_f64::dynamics::{IntegrationParameters, RigidBody, SpringCoefficients};
use rapier3d_f64::math::Vector;

/// Gravity that the depth under load refers to, in every world [m/s²].
const REFERENCE_GRAVITY_M_S2: f64 = 9.81;
/// Number of contacts over which the weight of a model is assumed to be spread.
const SUPPORTS: f64 = 4.0;
/// Depth of each of these contacts [m]. With 0.6 mm a wheel between two casters that are 1 mm too
/// low still presses on the floor, and one between casters 1.5 mm too low does not, as with ODE
/// in Gazebo, whose surface layer is 1 mm (`casters` in `benches/RESULTS.md`).
const DEPTH_M: f64 = 0.6e-3;
/// ODE's surface layer in Gazebo, to which [`DEPTH_M`] belongs [m]. A larger `min_depth` gives a
/// proportionally larger depth.
const SURFACE_LAYER_M: f64 = 1e-3;
/// Largest `min_depth` that counts [m].
const MAX_LAYER_M: f64 = 5e-3;
/// Depth of the same contacts with the softest `kp` that counts [m]; with a softer one, models would
/// sink into the floor.
const MAX_DEPTH_M: f64 = 0.02;
/// Largest part of a depth that is corrected in one step; more would overshoot.
const MAX_CORRECTION_PER_STEP: f64 = 0.2;
/// A stiffer contact reports at most this depth to the solver [m], or its own.
const MAX_RAISED_DEPTH_M: f64 = 2e-3;

/// Stiffness of the contacts of one collision [N/m]; none where the solver's own is to be used.
/// `is_jointed` tells models of several bodies from single ones.
pub(crate) fn stiffness(
    model_mass_kg: f64,
    is_jointed: bool,
    kp: f64,
    min_depth_m: f64,
) -> Option<f64> {
    let share_n = model_mass_kg * REFERENCE_GRAVITY_M_S2 / SUPPORTS;
    if !(share_n.is_finite() && share_n > 0.0) {
        return None;
    }
    let layer_m = min_depth_m.clamp(SURFACE_LAYER_M, MAX_LAYER_M);
    let usual = share_n / (DEPTH_M * layer_m / SURFACE_LAYER_M);
    let softest = share_n / MAX_DEPTH_M;
    let given = if kp > 0.0 { kp.max(softest) } else { f64::INFINITY };
    // A single body has one stiffness at all its contacts already.
    (is_jointed || given < usual).then_some(given.min(usual))
}

/// Stiffness of two springs, one behind the other [N/m].
pub(crate) fn in_series(one: Option<f64>, two: Option<f64>) -> Option<f64> {
    match (one, two) {
        (Some(one), Some(two)) => Some(1.0 / (1.0 / one + 1.0 / two)),
        (one, two) => one.or(two),
    }
}

/// A depth as the solver is to see it [m], for a contact of a stiffness [N/m] between bodies of
/// the effective mass [kg] that [`effective_mass`] gives.
pub(crate) fn seen_depth(
    depth_m: f64,
    stiffness_n_m: f64,
    effective_mass_kg: f64,
    spring: &SpringCoefficients<f64>,
    parameters: &IntegrationParameters,
) -> f64 {
    let omega = spring.angular_frequency();
    // The solver's spring is `mass omega²`, so scaling the depth scales the force.
    let factor = stiffness_n_m / (effective_mass_kg * omega * omega);
    let limit = MAX_CORRECTION_PER_STEP / (spring.erp_inv_dt(parameters.dt) * parameters.dt);
    let factor = if factor.is_finite() { factor.min(limit.max(1.0)) } else { 1.0 };
    if factor > 1.0 {
        (depth_m * factor).min(depth_m.max(MAX_RAISED_DEPTH_M))
    } else {
        depth_m * factor
    }
}

/// Mass that an impulse along a direction at a point sets in motion [kg]; infinite for two bodies
/// that nothing moves.
pub(crate) fn effective_mass(bodies: [Option<&RigidBody>; 2], at_m: Vector, along: Vector) -> f64 {
    let moved: f64 = bodies
        .into_iter()
        .flatten()
        .filter(|body| body.is_dynamic())
        .map(|body| {
            let mass = body.mass_properties();
            let lever = (at_m - mass.world_com).cross(along);
            along.dot(mass.effective_inv_mass * along)
                + lever.dot(mass.effective_world_inv_inertia * lever)
        })
        .sum();
    1.0 / moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_of_the_weight_sinks_by_the_depth() {
        // 2.4 N on each of four contacts: 2.4 N / 0.6 mm.
        let mass_kg = 4.0 * 2.4 / 9.81;
        let found = stiffness(mass_kg, true, 1e12, 0.0).unwrap_or_default();
        assert!((found - 4000.0).abs() < 1e-6, "{found}");
        let layered = stiffness(mass_kg, true, 1e12, 0.002).unwrap_or_default();
        assert!((layered - 2000.0).abs() < 1e-6, "{layered}");
        assert_eq!(stiffness(mass_kg, true, 1000.0, 0.0), Some(1000.0));
        // 2.4 N / 20 mm, however soft.
        let soft = stiffness(mass_kg, true, 1e-3, 0.0).unwrap_or_default();
        assert!((soft - 120.0).abs() < 1e-6, "{soft}");
    }

    #[test]
    fn a_single_body_keeps_the_stiffness_of_the_solver() {
        assert_eq!(stiffness(1.0, false, 1e12, 0.0), None);
        assert_eq!(stiffness(1.0, false, 1000.0, 0.0), Some(1000.0));
        assert_eq!(stiffness(0.0, true, 1e12, 0.0), None);
    }

    #[test]
    fn two_equal_springs_are_half_as_stiff() {
        assert_eq!(in_series(Some(2.0), Some(2.0)), Some(1.0));
        assert_eq!(in_series(None, Some(3.0)), Some(3.0));
        assert_eq!(in_series(None, None), None);
    }
}
