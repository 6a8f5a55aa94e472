//! Physics engine in a separate process.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

use super::{Order, Outcome};

/// Sends the orders to a program and reads its name and answers, a JSON line each.
pub(super) fn drive_all(
    program: &Path,
    arguments: &[&OsStr],
    orders: &[Order],
) -> Result<(String, Vec<Outcome>), String> {
    let name = program.display();
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("`{name}` cannot be started: {error}"))?;
    let lines: String = orders.iter().map(line).collect();
    if let Some(mut stdin) = child.stdin.take() {
        // A process that ends early reports the reason on its standard error.
        let _ = stdin.write_all(lines.as_bytes());
    }
    let output = child.wait_with_output().map_err(|error| format!("`{name}`: {error}"))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{name}` failed: {}", said.lines().last().unwrap_or("no word")));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let mut answers = text.lines().map(|line| {
        serde_json::from_str::<Value>(line)
            .map_err(|error| format!("`{name}` said {line}: {error}"))
    });
    let engine = answers.next().ok_or_else(|| format!("`{name}` said nothing"))??;
    let engine = engine["engine"].as_str().unwrap_or("unknown engine").to_owned();
    let mut outcomes = Vec::new();
    for (order, answer) in orders.iter().zip(answers) {
        outcomes.push(outcome(order, &answer?).ok_or_else(|| format!("`{name}`: wrong answer"))?);
    }
    if outcomes.len() < orders.len() {
        return Err(format!("`{name}` answered {} of {} orders", outcomes.len(), orders.len()));
    }
    Ok((engine, outcomes))
}

fn line(order: &Order) -> String {
    let Order { name, ahead_m_s, turn_rad_s, time_s, block } = order;
    format!("{name} {ahead_m_s} {turn_rad_s} {time_s} {}\n", block.name())
}

fn outcome(order: &Order, answer: &Value) -> Option<Outcome> {
    if answer["test"].as_str()? != order.name {
        return None;
    }
    let number = |key: &str| answer[key].as_f64();
    Some(Outcome {
        along_m: number("along_m")?,
        aside_m: number("aside_m")?,
        turned_rad: number("turned_rad")?,
        wheels_rad: [number("left_rad")?, number("right_rad")?],
        height_m: number("height_m")?,
        us_per_step: number("us_per_step")?,
    })
}
