//! Scores of runs.

use std::collections::BTreeMap;
use std::fmt;

use serde_json::Value;
use sha2::{Digest as _, Sha256};

use super::course::Course;

/// Outcome of a run.
pub(super) struct Outcome {
    optimal_s: f64,
    /// Time from the first motion to the arrival without a collision \[s\].
    time_s: Option<f64>,
    has_collided: bool,
}

impl Outcome {
    /// Reads the report of `periplus navigate --json`.
    pub(super) fn read(report: &Value, optimal_s: f64) -> Self {
        let truth = &report["truth"];
        let has_collided = truth["collisions"].as_u64().is_none_or(|count| count > 0);
        let time_s = truth["arrival_s"].as_f64().filter(|_| !has_collided);
        Self { optimal_s, time_s, has_collided }
    }

    /// `success × OT / clip(T, fastest OT, 8 OT)`: 2 OT by the present formula, 4 OT by that of 2022.
    fn score(&self, fastest: f64) -> f64 {
        self.time_s.map_or(0.0, |time_s| {
            self.optimal_s / time_s.clamp(fastest * self.optimal_s, 8.0 * self.optimal_s)
        })
    }
}

/// Means over runs.
pub(super) struct Summary<'a> {
    name: &'a str,
    runs: usize,
    success: f64,
    collision: f64,
    score: f64,
    old_score: f64,
    time_s: f64,
}

impl<'a> Summary<'a> {
    pub(super) fn of<'b>(name: &'a str, outcomes: impl Iterator<Item = &'b Outcome>) -> Self {
        let outcomes: Vec<&Outcome> = outcomes.collect();
        let runs = outcomes.len();
        let mean = |value: &dyn Fn(&Outcome) -> f64| {
            outcomes.iter().map(|one| value(one)).sum::<f64>() / runs.max(1) as f64
        };
        let times: Vec<f64> = outcomes.iter().filter_map(|one| one.time_s).collect();
        Self {
            name,
            runs,
            success: mean(&|one| f64::from(u8::from(one.time_s.is_some()))),
            collision: mean(&|one| f64::from(u8::from(one.has_collided))),
            score: mean(&|one| one.score(2.0)),
            old_score: mean(&|one| one.score(4.0)),
            time_s: times.iter().sum::<f64>() / times.len().max(1) as f64,
        }
    }
}

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {} runs, success {:.3}, collision {:.3}, timeout {:.3}, score {:.4} of 0.5, by the formula of 2022 \
             {:.4} of 0.25, mean time {:.1} s",
            self.name,
            self.runs,
            self.success,
            self.collision,
            1.0 - self.success - self.collision,
            self.score,
            self.old_score,
            self.time_s
        )
    }
}

/// Prints the worlds with a failure or a low score.
pub(super) fn print_table(worlds: &BTreeMap<u64, Vec<&Outcome>>) {
    println!("world  success  collision  score  mean time [s]");
    for (world, outcomes) in worlds {
        let one = Summary::of("", outcomes.iter().copied());
        println!(
            "{world:>5}  {:>7.2}  {:>9.2}  {:.3}  {:>6.1}",
            one.success, one.collision, one.score, one.time_s
        );
    }
}

/// Prints the scores of the published runs of DWA, recomputed: a line has world, success, collision, timeout, time and
/// an old score.
pub(super) fn print_baseline(text: &str, courses: &[Course]) {
    let optimal_s: BTreeMap<u64, f64> =
        courses.iter().map(|course| (course.world, course.optimal_s)).collect();
    let outcomes: Vec<Outcome> = text
        .lines()
        .filter_map(|line| {
            let fields: Vec<f64> =
                line.split_whitespace().map_while(|word| word.parse().ok()).collect();
            let &[world, success, collision, _, time_s, ..] = fields.as_slice() else {
                return None;
            };
            let optimal_s = *optimal_s.get(&(world as u64))?;
            let time_s = (success > 0.0).then_some(time_s);
            Some(Outcome { optimal_s, time_s, has_collided: collision > 0.0 })
        })
        .collect();
    if !outcomes.is_empty() {
        println!("{}", Summary::of("published runs of DWA on these worlds", outcomes.iter()));
    }
}

/// Checksum of a bag.
pub(super) fn digest(bytes: &[u8]) -> Vec<u8> {
    Sha256::digest(bytes).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_are_clipped() {
        let run = |time_s: Option<f64>| Outcome { optimal_s: 5.0, time_s, has_collided: false };
        assert_eq!(run(Some(1.0)).score(2.0), 0.5);
        assert_eq!(run(Some(1.0)).score(4.0), 0.25);
        assert_eq!(run(Some(20.0)).score(2.0), 0.25);
        assert_eq!(run(Some(90.0)).score(2.0), 0.125);
        assert_eq!(run(None).score(2.0), 0.0);
    }
}
