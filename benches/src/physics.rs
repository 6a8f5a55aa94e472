//! The repository's robot driven by us, by MuJoCo and by ODE: the same orders, what became of them,
//! and how long a step took.

mod ours;
mod peer;

use std::path::Path;

use serde_json::{Value, json};

/// Command sequence of a robot, after one second at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    name: &'static str,
    ahead_m_s: f64,
    turn_rad_s: f64,
    time_s: f64,
    block: Block,
}

/// Obstacle in front of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Block {
    Nothing,
    /// Two metres from the middle of the robot, one high.
    Wall,
    /// One centimetre high, from one metre on.
    Step,
}

impl Block {
    fn name(self) -> &'static str {
        match self {
            Self::Nothing => "none",
            Self::Wall => "wall",
            Self::Step => "step",
        }
    }
}

const ORDERS: [Order; 5] = [
    Order {
        name: "straight",
        ahead_m_s: 0.5,
        turn_rad_s: 0.0,
        time_s: 60.0,
        block: Block::Nothing,
    },
    Order { name: "turns", ahead_m_s: 0.0, turn_rad_s: 1.0, time_s: 62.8, block: Block::Nothing },
    Order { name: "rest", ahead_m_s: 0.0, turn_rad_s: 0.0, time_s: 60.0, block: Block::Nothing },
    Order { name: "wall", ahead_m_s: 0.5, turn_rad_s: 0.0, time_s: 10.0, block: Block::Wall },
    Order { name: "step", ahead_m_s: 0.5, turn_rad_s: 0.0, time_s: 4.0, block: Block::Step },
];

/// Radius of a driven wheel [m].
const RADIUS_M: f64 = 0.1;
/// Distance between the driven wheels [m].
const SEPARATION_M: f64 = 0.36;

/// Result of an order, relative to the pose before it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    along_m: f64,
    aside_m: f64,
    turned_rad: f64,
    /// Turns of the wheels by their encoders, left and right [rad].
    wheels_rad: [f64; 2],
    /// Height of the middle of the body over the floor at the end [m].
    height_m: f64,
    us_per_step: f64,
}

/// An engine and its outcomes, in the order of [`ORDERS`].
struct Row {
    engine: String,
    outcomes: Vec<Outcome>,
}

/// Runs all engines that are there, one after the other. `ode` is the program built from
/// `benches/oracles/physics_ode.cc`, `mujoco` a Python that has MuJoCo.
///
/// # Errors
/// When our own robot cannot be run; a missing peer is only reported.
pub(crate) fn run(oracles: &Path, ode: &Path, python: &Path) -> Result<(String, Value), String> {
    let mut rows = vec![Row { engine: "Periplus".into(), outcomes: ours::drive_all(&ORDERS)? }];
    for tyre in ["ball", "cylinder"] {
        let script = oracles.join("physics_mujoco.py");
        let mujoco = peer::drive_all(python, &[script.as_os_str(), tyre.as_ref()], &ORDERS);
        let ode = peer::drive_all(ode, &[tyre.as_ref()], &ORDERS);
        for (name, outcome) in [("MuJoCo", mujoco), ("ODE", ode)] {
            match outcome {
                Ok((engine, outcomes)) => {
                    rows.push(Row { engine: format!("{engine}, {tyre} wheels"), outcomes });
                }
                Err(why) => eprintln!("MISSING PEER {name}: {why}"),
            }
        }
    }
    let kinematic_us = ours::kinematic_us_per_step()?;
    let mut table = String::from(
        "| engine | 30 m straight: way, aside | ten turns: turned, error | creep at rest [mm/min] | wall: stops at | 1 cm step | encoder error, straight, turns | us a step, driving |\n|---|---|---|---|---|---|---|---|\n",
    );
    for row in &rows {
        table.push_str(&line(row));
    }
    table.push_str(&format!("\nPeriplus, kinematic mode: {kinematic_us:.3} us a step.\n"));
    let lines: Vec<Value> = rows.iter().flat_map(as_json).collect();
    Ok((table, json!({ "rows": lines, "kinematic_us_per_step": kinematic_us })))
}

fn line(row: &Row) -> String {
    let [straight, turns, rest, wall, step] = row.outcomes[..] else {
        return String::new();
    };
    let percent = |part: f64, whole: f64| 100.0 * part / whole;
    let told_rad = ORDERS[1].time_s * ORDERS[1].turn_rad_s;
    let encoder_m = (straight.wheels_rad[0] + straight.wheels_rad[1]) / 2.0 * RADIUS_M;
    let encoder_rad = (turns.wheels_rad[1] - turns.wheels_rad[0]) * RADIUS_M / SEPARATION_M;
    let climbed = step.along_m > 1.5 && step.height_m > 0.15 + 0.008;
    // At rest we sleep; that is not a race.
    let driving_us = (straight.us_per_step + turns.us_per_step) / 2.0;
    format!(
        "| {} | {:.3} m, {:+.1} mm ({:.3} %) | {:.2} of {told_rad:.1} rad, {:+.2} % | {:.4} | {:.3} m | {} | {:+.2} %, {:+.2} % | {driving_us:.1} |\n",
        row.engine,
        straight.along_m,
        straight.aside_m * 1e3,
        percent(straight.aside_m.abs(), straight.along_m),
        turns.turned_rad,
        percent(turns.turned_rad - told_rad, told_rad),
        1e3 * (rest.along_m * rest.along_m + rest.aside_m * rest.aside_m).sqrt(),
        wall.along_m,
        if climbed { "climbed" } else { "NOT climbed" },
        percent(encoder_m - straight.along_m, straight.along_m),
        percent(encoder_rad - turns.turned_rad, turns.turned_rad),
    )
}

fn as_json(row: &Row) -> Vec<Value> {
    let outcomes = ORDERS.iter().zip(&row.outcomes);
    outcomes
        .map(|(order, it)| {
            json!({ "engine": row.engine, "test": order.name, "along_m": it.along_m,
                "aside_m": it.aside_m, "turned_rad": it.turned_rad, "left_rad": it.wheels_rad[0],
                "right_rad": it.wheels_rad[1], "height_m": it.height_m, "us_per_step": it.us_per_step })
        })
        .collect()
}
