//! Speed by density in the plane.
//!
//! U. Weidmann, "Transporttechnik der Fussgaenger", ETH Zuerich, Schriftenreihe des IVT 90, 1993: a fit to 25 studies,
//! `v = 1.34 m/s (1 - exp(-1.913 (1 / rho - 1 / 5.4)))`. The free speeds of people have a standard deviation of 0.26 m/s,
//! and the studies scatter about as much.

use glam::DVec2;

use super::{FREE_SPEED_M_PER_S, walker};
use crate::agent::PersonPlan;
use crate::crowd::{Crowd, CrowdSettings};
use crate::error::CrowdError;
use crate::floor::Floor;
use crate::model::SteeringModel;
use crate::wall::Wall;

/// Length of the corridor, whose ends are joined \[m\].
const LENGTH_M: f64 = 12.0;

/// Width of the corridor \[m\].
const WIDTH_M: f64 = 4.0;

/// Time until the measurement begins \[s\].
const SETTLE_S: f64 = 20.0;

/// Duration of the measurement \[s\].
const MEASURE_S: f64 = 30.0;

/// Mean speed at a density by Weidmann 1993, not negative \[m/s\].
#[must_use]
pub fn weidmann_speed_m_per_s(density_per_m2: f64) -> f64 {
    let exponent = -1.913 * (1.0 / density_per_m2 - 1.0 / 5.4);
    (1.34 * (1.0 - libm::exp(exponent))).max(0.0)
}

/// Mean speed of people who walk in one direction at a density \[m/s\].
///
/// # Errors
///
/// None for real models; those of [`Floor::periodic`].
pub fn plane_speed_m_per_s(
    model: SteeringModel,
    density_per_m2: f64,
    seed: u64,
) -> Result<f64, CrowdError> {
    let walls = [0.0, WIDTH_M].map(|y| Wall::new([-2.0, y], [LENGTH_M + 2.0, y]));
    let floor = Floor::periodic(walls.to_vec(), LENGTH_M)?;
    let mut crowd = Crowd::new(floor, CrowdSettings { model, seed, threads: 1 });
    for (number, position) in hexagonal_places(density_per_m2).into_iter().enumerate() {
        let settings = walker(position, FREE_SPEED_M_PER_S, seed, number as u64);
        crowd.add_agent(settings, PersonPlan::Direction(DVec2::X))?;
    }
    while crowd.time_s() < SETTLE_S {
        crowd.step(0.05);
    }
    let (mut sum, mut samples) = (0.0, 0.0);
    while crowd.time_s() < SETTLE_S + MEASURE_S {
        crowd.step(0.05);
        for agent in crowd.agents() {
            sum += agent.velocity().x;
            samples += 1.0;
        }
    }
    Ok(sum / samples)
}

/// Positions in rows that are shifted against each other.
fn hexagonal_places(density_per_m2: f64) -> Vec<DVec2> {
    let count = density_per_m2 * LENGTH_M * WIDTH_M;
    let usable_m = WIDTH_M - 0.4;
    let rows = (usable_m * (density_per_m2 * WIDTH_M / usable_m).sqrt()).round().max(1.0);
    let in_row = count / rows;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
    let count = count.round() as u32;
    (0..count)
        .map(|number| {
            let along = f64::from(number) / in_row;
            let row = along.floor();
            let shift = if row % 2.0 == 0.0 { 0.0 } else { 0.5 / in_row };
            let x = (along - row + shift) * LENGTH_M;
            DVec2::new(x % LENGTH_M, 0.2 + usable_m * (row + 0.5) / rows)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_of_weidmann_has_its_known_points() {
        assert!((weidmann_speed_m_per_s(0.01) - 1.34).abs() < 1e-9);
        assert!((weidmann_speed_m_per_s(1.0) - 1.06).abs() < 0.01);
        assert_eq!(weidmann_speed_m_per_s(5.4), 0.0);
    }

    #[test]
    fn places_have_the_density_and_are_in_the_corridor() {
        for density in [0.3, 1.0, 4.0] {
            let places = hexagonal_places(density);
            #[expect(clippy::cast_precision_loss, reason = "small numbers")]
            let found = places.len() as f64 / (LENGTH_M * WIDTH_M);
            assert!((found - density).abs() < 0.02);
            assert!(
                places
                    .iter()
                    .all(|it| (0.0..LENGTH_M).contains(&it.x) && (0.2..3.8).contains(&it.y))
            );
        }
    }
}
