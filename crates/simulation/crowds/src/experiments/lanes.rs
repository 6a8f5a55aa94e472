//! Lanes in a corridor with two directions.
//!
//! People who walk against each other segregate into lanes. The order parameter is that of M. Rex, H. Loewen, "Lane
//! formation in oppositely charged colloids driven by an electric field", Phys. Rev. E 75, 051402, 2007, which C.
//! Feliciani and K. Nishinari ("Empirical analysis of the lane formation process in bidirectional pedestrian flow", Phys.
//! Rev. E 94, 032304, 2016) apply to people: in rows along the corridor as wide as a person,
//! `phi = ((n_right - n_left) / (n_right + n_left))^2`, averaged over the people. It is 1 in perfect lanes. J. Zhang,
//! W. Klingsch, A. Schadschneider, A. Seyfried ("Ordering in bidirectional pedestrian flows and its influence on the
//! fundamental diagram", J. Stat. Mech. P02002, 2012) see stable lanes and no jam at densities up to 2.5 per m² in a
//! corridor of 3.6 m width, with speeds near those of one direction below 1 per m².

use glam::DVec2;
use periplus_geometry::Stream;

use super::{STUDENT_SPEED_M_PER_S, walker};
use crate::agent::PersonPlan;
use crate::crowd::{Crowd, CrowdSettings};
use crate::error::CrowdError;
use crate::floor::Floor;
use crate::model::SteeringModel;
use crate::wall::Wall;

/// Length of the corridor, whose ends are joined \[m\].
const LENGTH_M: f64 = 15.0;

/// Width of the corridor, as in Zhang et al. 2012 \[m\].
const WIDTH_M: f64 = 3.6;

/// Number of rows of the order parameter, each 0.6 m wide.
const ROWS: usize = 6;

/// Result of a corridor with two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LanesRun {
    /// Order parameter at the start, mixed at random.
    pub order_at_start: f64,
    /// Mean order parameter in the last quarter of the run.
    pub order_at_end: f64,
    /// Time at which the order parameter first reached 0.8; none if it did not \[s\].
    pub ordered_after_s: Option<f64>,
    /// Mean speed along the direction of each person in the last quarter \[m/s\].
    pub speed_m_per_s: f64,
}

/// Lets people walk in two directions, half of them in each, for a time.
///
/// # Errors
///
/// None for real models; those of [`Floor::periodic`].
pub fn lanes(
    model: SteeringModel,
    density_per_m2: f64,
    duration_s: f64,
    seed: u64,
) -> Result<LanesRun, CrowdError> {
    let walls = [0.0, WIDTH_M].map(|y| Wall::new([-2.0, y], [LENGTH_M + 2.0, y]));
    let floor = Floor::periodic(walls.to_vec(), LENGTH_M)?;
    let mut crowd = Crowd::new(floor, CrowdSettings { model, seed, threads: 1 });
    let mut is_right = Vec::new();
    for (number, position) in mixed_places(density_per_m2, seed).into_iter().enumerate() {
        let direction = if number % 2 == 0 { DVec2::X } else { -DVec2::X };
        is_right.push(number % 2 == 0);
        let settings = walker(position, STUDENT_SPEED_M_PER_S, seed, number as u64);
        crowd.add_agent(settings, PersonPlan::Direction(direction))?;
    }
    let order_at_start = order(&crowd, &is_right);
    let mut ordered_after_s = None;
    let (mut speeds, mut orders, mut samples) = (0.0, 0.0, 0.0);
    while crowd.time_s() < duration_s {
        crowd.step(0.05);
        let order = order(&crowd, &is_right);
        if order >= 0.8 && ordered_after_s.is_none() {
            ordered_after_s = Some(crowd.time_s());
        }
        if crowd.time_s() > 0.75 * duration_s {
            orders += order;
            samples += 1.0;
            speeds += mean_speed_m_per_s(&crowd, &is_right);
        }
    }
    Ok(LanesRun {
        order_at_start,
        order_at_end: orders / samples,
        ordered_after_s,
        speed_m_per_s: speeds / samples,
    })
}

#[expect(clippy::cast_precision_loss, reason = "small numbers")]
fn mean_speed_m_per_s(crowd: &Crowd, is_right: &[bool]) -> f64 {
    let along =
        crowd.agents().iter().zip(is_right).map(|(agent, is_right)| {
            if *is_right { agent.velocity().x } else { -agent.velocity().x }
        });
    along.sum::<f64>() / is_right.len() as f64
}

/// Order parameter of people in rows along the corridor.
fn order(crowd: &Crowd, is_right: &[bool]) -> f64 {
    let mut counts = [[0.0; 2]; ROWS];
    for (agent, is_right) in crowd.agents().iter().zip(is_right) {
        counts[row_of(agent.position().y)][usize::from(*is_right)] += 1.0;
    }
    let mut sum = 0.0;
    for [left, right] in counts {
        if left + right > 0.0 {
            let balance: f64 = (right - left) / (left + right);
            sum += balance * balance * (left + right);
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let people = is_right.len() as f64;
    sum / people
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "clamped to the rows"
)]
fn row_of(y_m: f64) -> usize {
    ((y_m / WIDTH_M * ROWS as f64).max(0.0) as usize).min(ROWS - 1)
}

/// Random positions at least 0.45 m apart; fewer where there is no space.
fn mixed_places(density_per_m2: f64, seed: u64) -> Vec<DVec2> {
    let mut stream = Stream::keyed(seed, "experiment places", 0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
    let count = (density_per_m2 * LENGTH_M * WIDTH_M).round() as usize;
    let mut places: Vec<DVec2> = Vec::new();
    for _ in 0..count * 2000 {
        let place = DVec2::new(stream.unit() * LENGTH_M, 0.25 + stream.unit() * (WIDTH_M - 0.5));
        let is_free = places.iter().all(|other| {
            let offset = crate::neighbours::nearest_image(*other - place, Some(LENGTH_M));
            offset.length() >= 0.45
        });
        if is_free {
            places.push(place);
        }
        if places.len() == count {
            break;
        }
    }
    places
}
