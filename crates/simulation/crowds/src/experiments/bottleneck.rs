//! Flow through a bottleneck by its width.
//!
//! A. Seyfried, O. Passon, B. Steffen, M. Boltes, T. Rupprecht, W. Klingsch, "New insights into pedestrian flow through
//! bottlenecks", Transportation Science 43(3), 2009: 60 people stand 3 m in front of a passage of 2.8 m length and 0.8 m
//! to 1.2 m width at a density of 3.3 per m². T. Kretz, A. Gruenebohm, M. Schreckenberg, "Experimental study of
//! pedestrian flow through a bottleneck", J. Stat. Mech. P10014, 2006: 100 people, a passage of 0.4 m length.

use glam::DVec2;

use super::{STUDENT_SPEED_M_PER_S, walker};
use crate::agent::PersonPlan;
use crate::crowd::{Crowd, CrowdSettings, PersonGoal};
use crate::error::CrowdError;
use crate::floor::Floor;
use crate::model::SteeringModel;
use crate::wall::Wall;

/// Range of the specific flow of Kretz et al. 2006 and Seyfried et al. 2009 for passages from 0.8 m \[1/(m s)\].
pub const KRETZ_SPECIFIC_FLOW_PER_M_S: [f64; 2] = [1.6, 1.9];

/// Length of the passage \[m\].
const PASSAGE_M: f64 = 2.8;

/// Half of the width of the hall \[m\].
const HALL_M: f64 = 4.0;

/// Density of the people at the start \[1/m²\].
const START_DENSITY_PER_M2: f64 = 3.3;

/// Time after which a run counts as jammed \[s\].
const LIMIT_S: f64 = 300.0;

/// Flow by width of Seyfried et al. 2009, linear with 1.9 per m and s for widths from 0.8 m to 1.2 m \[1/s\].
#[must_use]
pub fn seyfried_flow_per_s(width_m: f64) -> f64 {
    1.9 * width_m
}

/// Result of a bottleneck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BottleneckRun {
    /// Width of the passage \[m\].
    pub width_m: f64,
    /// People who passed.
    pub passed: usize,
    /// Flow between the first and the last person \[1/s\].
    pub flow_per_s: f64,
    /// Flow per width \[1/(m s)\].
    pub specific_flow_per_m_s: f64,
}

/// Lets people pass a bottleneck.
///
/// # Errors
///
/// A width that is not positive gives no path to the goal.
pub fn bottleneck(
    model: SteeringModel,
    width_m: f64,
    people: usize,
    seed: u64,
) -> Result<BottleneckRun, CrowdError> {
    let half = width_m / 2.0;
    // The hall to the left of x = 0, the passage to x = 2.8 m, free space behind it.
    let mut walls = vec![
        Wall::new([-16.0, -HALL_M], [-16.0, HALL_M]),
        Wall::new([12.0, -HALL_M], [12.0, HALL_M]),
        Wall::new([-16.0, -HALL_M], [0.0, -HALL_M]),
        Wall::new([-16.0, HALL_M], [0.0, HALL_M]),
        Wall::new([PASSAGE_M, -HALL_M], [12.0, -HALL_M]),
        Wall::new([PASSAGE_M, HALL_M], [12.0, HALL_M]),
    ];
    for side in [-1.0, 1.0] {
        walls.push(Wall::new([0.0, side * HALL_M], [0.0, side * half]));
        walls.push(Wall::new([0.0, side * half], [PASSAGE_M, side * half]));
        walls.push(Wall::new([PASSAGE_M, side * half], [PASSAGE_M, side * HALL_M]));
    }
    let mut crowd = Crowd::new(Floor::new(walls)?, CrowdSettings { model, seed, threads: 1 });
    let goal = crowd.add_goal(PersonGoal::at(DVec2::new(10.5, 0.0)))?;
    let goals = [goal];
    let spacing_m = (1.0 / START_DENSITY_PER_M2).sqrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
    let in_row = ((2.0 * HALL_M - 1.0) / spacing_m).floor() as usize;
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    for number in 0..people {
        let (row, column) = ((number / in_row) as f64, (number % in_row) as f64);
        let y = (column - (in_row as f64 - 1.0) / 2.0) * spacing_m;
        let position = DVec2::new(-3.0 - row * spacing_m, y);
        let plan = PersonPlan::Visit { goals: goals.to_vec(), repeats: false };
        crowd.add_agent(walker(position, STUDENT_SPEED_M_PER_S, seed, number as u64), plan)?;
    }
    let mut times_s = Vec::new();
    let mut has_passed = vec![false; people];
    while times_s.len() < people && crowd.time_s() < LIMIT_S {
        crowd.step(0.05);
        for (agent, has_passed) in crowd.agents().iter().zip(&mut has_passed) {
            // Counted in the middle of the passage, as the paper does.
            if !*has_passed && agent.position().x > PASSAGE_M / 2.0 {
                *has_passed = true;
                times_s.push(crowd.time_s());
            }
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let flow_per_s = match (times_s.first(), times_s.last()) {
        (Some(first), Some(last)) if last > first => (times_s.len() - 1) as f64 / (last - first),
        _ => 0.0,
    };
    Ok(BottleneckRun {
        width_m,
        passed: times_s.len(),
        flow_per_s,
        specific_flow_per_m_s: flow_per_s / width_m,
    })
}
