//! Contact stiffness: distributes load over all contact points.
//!
//! The solver makes a contact's stiffness proportional to the effective mass of the two bodies at
//! the contact point. A caster fixed to a heavy base is then fifty times as stiff as a light wheel
//! beside it and carries all load, so the wheels spin. Here all contacts of a model with joints have
//! the same stiffness [N/m], independent of the link's mass. Gazebo achieves the same with ODE's
//! surface layer, in which contacts are not corrected, and with `kp`.

use rapier3d_f64::dynamics::{IntegrationParameters, RigidBody, SpringCoefficients};
use rapier3d_f64::math::Vector;

/// Gravity that defines the depth under load, in every world [m/s²].
const REFERENCE_GRAVITY_M_S2: f64 = 9.81;
/// Number of contacts that share the weight of a model.
const SUPPORT_COUNT: f64 = 4.0;
/// Penetration depth of each of these contacts [m]. With 0.6 mm a wheel between two casters that are
/// 1 mm too low still presses on the floor, and one between casters 1.5 mm too low does not, as with
/// ODE in Gazebo, whose surface layer is 1 mm (`casters` in `benches/RESULTS.md`).
const DEPTH_M: f64 = 0.6e-3;
/// ODE's surface layer in Gazebo, corresponding to [`DEPTH_M`] [m]. A larger `min_depth` increases
/// the depth proportionally.
const SURFACE_LAYER_M: f64 = 1e-3;
/// Maximum effective `min_depth` [m].
const MAX_LAYER_M: f64 = 5e-3;
/// Depth of the same contacts with the softest effective `kp` [m]; with a softer one, models would
/// sink into the floor.
const MAX_DEPTH_M: f64 = 0.02;
/// Maximum fraction of a depth that is corrected per step; more would overshoot.
const MAX_CORRECTION_PER_STEP: f64 = 0.2;
/// Maximum depth that a stiffer contact reports to the solver [m], unless its own is larger.
const MAX_RAISED_DEPTH_M: f64 = 2e-3;

/// Returns the stiffness of the contacts of a collision [N/m]; `None` for the solver's own.
/// `is_jointed` is true for models of several bodies.
pub(crate) fn stiffness(
    model_mass_kg: f64,
    is_jointed: bool,
    kp: f64,
    min_depth_m: f64,
) -> Option<f64> {
    let share_n = model_mass_kg * REFERENCE_GRAVITY_M_S2 / SUPPORT_COUNT;
    if !(share_n.is_finite() && share_n > 0.0) {
        return None;
    }
    let layer_m = min_depth_m.clamp(SURFACE_LAYER_M, MAX_LAYER_M);
    let usual = share_n / (DEPTH_M * layer_m / SURFACE_LAYER_M);
    let softest = share_n / MAX_DEPTH_M;
    let given = if kp > 0.0 { kp.max(softest) } else { f64::INFINITY };
    // All contacts of a single body have the same stiffness already.
    (is_jointed || given < usual).then_some(given.min(usual))
}

/// Returns the stiffness of two springs in series [N/m].
pub(crate) fn in_series(one: Option<f64>, two: Option<f64>) -> Option<f64> {
    match (one, two) {
        (Some(one), Some(two)) => Some(1.0 / (1.0 / one + 1.0 / two)),
        (one, two) => one.or(two),
    }
}

/// Returns the depth that is passed to the solver [m], for a contact of a stiffness [N/m] between
/// bodies of an [`effective_mass`] [kg].
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

/// Returns the effective mass of two bodies for an impulse along a direction at a point [kg];
/// infinite for two immovable bodies.
pub(crate) fn effective_mass(bodies: [Option<&RigidBody>; 2], at_m: Vector, along: Vector) -> f64 {
    let advanced: f64 = bodies
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
    1.0 / advanced
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
        // 2.4 N / 20 mm, the minimum stiffness.
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
