//! Distance travelled by a cart between two casters that are too low, compared with ODE and MuJoCo.
//!
//! `casters ODE PYTHON MUJOCO RESULTS.md`: the program built from `benches/oracles/casters_ode.cc`, a
//! Python that has `mujoco`, `benches/oracles/casters_mujoco.py`, and the file that gets the table.
//! `cargo xtask bench casters` runs it.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a program that measures"
)]

#[path = "../tests/casters/cart.rs"]
mod cart;
#[path = "../tests/common/mod.rs"]
mod common;

use std::ffi::OsString;
use std::io::Write as _;
use std::process::{Command, ExitCode, Stdio};

/// Height error of the casters [mm], downwards.
const DROPS_MM: [f64; 6] = [0.0, 0.25, 0.5, 1.0, 1.5, 2.0];
const FRICTION_RATIO: [f64; 3] = [0.001, 0.2, 0.5];
const SECTION: [&str; 2] =
    ["<!-- casters: written by `cargo xtask bench casters` -->\n", "<!-- end of casters -->\n"];

fn main() -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().skip(1).collect();
    let [ode, python, mujoco, results] = &words[..] else {
        eprintln!("usage: casters ODE PYTHON MUJOCO.py RESULTS.md");
        return ExitCode::from(2);
    };
    let ours = jobs().map(|(drop_mm, mu)| cart::drive(&cart::cart(drop_mm * 1e-3, mu, 1.0), 0.0));
    let mut rows = vec![("Periplus", Ok(ours.collect::<Vec<f64>>()))];
    rows.push(("ODE as Gazebo sets it up (`kp` 1e12, `kd` 1)", peer(ode, &["1e12", "1"])));
    rows.push(("ODE, `kp` 1e6, `kd` 100", peer(ode, &["1e6", "100"])));
    rows.push(("MuJoCo", peer(python, &[&mujoco.to_string_lossy()])));
    let mut table = String::from("| engine | friction of the casters |");
    for drop_mm in DROPS_MM {
        table += &format!(" {drop_mm} mm |");
    }
    table += "\n|---|---|---|---|---|---|---|---|\n";
    for (name, ways) in &rows {
        let ways = match ways {
            Ok(ways) => ways,
            Err(why) => {
                eprintln!("MISSING PEER {name}: {why}");
                continue;
            }
        };
        for (mu, ways) in FRICTION_RATIO.iter().zip(ways.chunks(DROPS_MM.len())) {
            table += &format!("| {name} | {mu} |");
            for way_m in ways {
                // Not -0.00.
                table += &format!(" {:.2} |", (way_m * 100.0).round() / 100.0 + 0.0);
            }
            table += "\n";
        }
    }
    println!("Distance travelled [m]; {} m without slip.\n\n{table}", cart::FULL_M);
    if rows.iter().any(|(_, ways)| ways.is_err()) {
        println!("A peer is missing, so the file stays as it is.");
        return ExitCode::SUCCESS;
    }
    let text = std::fs::read_to_string(results).unwrap();
    let (before, after) = match (text.split_once(SECTION[0]), text.split_once(SECTION[1])) {
        (Some((before, _)), Some((_, after))) => (before, after),
        _ => (&*text, ""),
    };
    std::fs::write(results, format!("{before}{}\n{table}\n{}{after}", SECTION[0], SECTION[1]))
        .unwrap();
    ExitCode::SUCCESS
}

fn jobs() -> impl Iterator<Item = (f64, f64)> {
    FRICTION_RATIO.into_iter().flat_map(|mu| DROPS_MM.into_iter().map(move |drop_mm| (drop_mm, mu)))
}

/// Runs a program that answers each line `DROP_M FRICTION` with a distance travelled [m].
fn peer(program: &OsString, arguments: &[&str]) -> Result<Vec<f64>, String> {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| error.to_string())?;
    let lines: String = jobs().map(|(mm, mu)| format!("{} {mu}\n", mm * 1e-3)).collect();
    if let Some(mut stdin) = child.stdin.take() {
        let _ = stdin.write_all(lines.as_bytes());
    }
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    let ways: Vec<f64> = text.lines().filter_map(|line| line.trim().parse().ok()).collect();
    if ways.len() == jobs().count() { Ok(ways) } else { Err("it did not answer every job".into()) }
}
