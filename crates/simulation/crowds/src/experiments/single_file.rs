//! Speed by density in a single file.
//!
//! A. Seyfried, B. Steffen, W. Klingsch, M. Boltes, "The fundamental diagram of pedestrian movement revisited", J. Stat.
//! Mech. P10002, 2005: people walk in a closed corridor of 0.8 m width and 17.3 m length. The distance to the one ahead
//! is `d = 0.36 m + 1.06 s v` for densities from 0.5 to 1.9 per m.

use glam::DVec2;

use super::walker;
use crate::agent::PersonPlan;
use crate::crowd::{Crowd, CrowdSettings};
use crate::error::CrowdError;
use crate::floor::Floor;
use crate::model::SteeringModel;
use crate::wall::Wall;

/// Length of the corridor \[m\].
const LENGTH_M: f64 = 17.3;

/// Half of the width of the corridor: the paper's 0.8 m leave no space to pass for people with shoulders. Discs without
/// shoulders have as little space in 0.6 m \[m\].
const HALF_WIDTH_M: f64 = 0.3;

/// Free speed of the participants and its standard deviation \[m/s\].
const FREE_SPEED_M_PER_S: [f64; 2] = [1.24, 0.15];

/// Time until the measurement begins \[s\].
const SETTLE_S: f64 = 30.0;

/// Duration of the measurement \[s\].
const MEASURE_S: f64 = 60.0;

/// Result of a single file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingleFileRun {
    /// People per length \[1/m\].
    pub density_per_m: f64,
    /// Mean speed along the corridor \[m/s\].
    pub speed_m_per_s: f64,
    /// Number of times that one person passed another, which people in the experiment did not.
    pub overtakings: usize,
}

/// Mean speed in a single file by Seyfried et al. 2005, at most the free speed of 1.24 m/s that they measured \[m/s\].
#[must_use]
pub fn seyfried_speed_m_per_s(density_per_m: f64) -> f64 {
    ((1.0 / density_per_m - 0.36) / 1.06).clamp(0.0, FREE_SPEED_M_PER_S[0])
}

/// Mean speed in a single file by Chattaraj, Seyfried, Chakroborty 2009 in India: `d = 0.22 m + 0.89 s v`, at most 1.27
/// m/s \[m/s\].
#[must_use]
pub fn chattaraj_speed_m_per_s(density_per_m: f64) -> f64 {
    ((1.0 / density_per_m - 0.22) / 0.89).clamp(0.0, 1.27)
}

/// Lets people walk in a single file.
///
/// # Errors
///
/// None for real models; those of [`Floor::periodic`].
pub fn single_file(
    model: SteeringModel,
    people: usize,
    seed: u64,
) -> Result<SingleFileRun, CrowdError> {
    let walls = [-HALF_WIDTH_M, HALF_WIDTH_M].map(|y| Wall::new([-2.0, y], [LENGTH_M + 2.0, y]));
    let floor = Floor::periodic(walls.to_vec(), LENGTH_M)?;
    let mut crowd = Crowd::new(floor, CrowdSettings { model, seed, threads: 1 });
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let count = people as f64;
    for number in 0..people {
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        let position = DVec2::new(number as f64 * LENGTH_M / count, 0.0);
        let settings = walker(position, FREE_SPEED_M_PER_S, seed, number as u64);
        crowd.add_agent(settings, PersonPlan::Direction(DVec2::X))?;
    }
    let order = |crowd: &Crowd| {
        let mut numbers: Vec<usize> = (0..people).collect();
        let x = |agent: &usize| crowd.agents()[*agent].position().x;
        numbers.sort_by(|a, b| x(a).total_cmp(&x(b)));
        let first = numbers.iter().position(|agent| *agent == 0).unwrap_or_default();
        numbers.rotate_left(first);
        numbers
    };
    while crowd.time_s() < SETTLE_S {
        crowd.step(0.05);
    }
    let mut last = order(&crowd);
    let (mut sum, mut samples, mut overtakings) = (0.0, 0.0, 0);
    while crowd.time_s() < SETTLE_S + MEASURE_S {
        crowd.step(0.05);
        for agent in crowd.agents() {
            sum += agent.velocity().x;
            samples += 1.0;
        }
        let now = order(&crowd);
        if now != last {
            overtakings += 1;
        }
        last = now;
    }
    Ok(SingleFileRun { density_per_m: count / LENGTH_M, speed_m_per_s: sum / samples, overtakings })
}
