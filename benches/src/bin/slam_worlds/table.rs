//! Table of the results.

use crate::score::Score;

/// All scores.
pub(crate) struct Table {
    rows: Vec<(&'static str, Score)>,
}

impl Table {
    pub(crate) fn new() -> Self {
        println!(
            "{:<18} {:>5} {:>6} | {:>7} {:>7} {:>7} {:>6} | {:>7} {:>7} {:>7} {:>7} | {:>5} {:>6} {:>5} {:>5}",
            "world, seed",
            "scans",
            "way m",
            "ATE m",
            "best m",
            "worst",
            "deg",
            "wall mm",
            "right %",
            "best %",
            "found %",
            "ms",
            "p99",
            "MB",
            "loops"
        );
        Self { rows: Vec::new() }
    }

    pub(crate) fn take(&mut self, world: &'static str, seed: u64, score: Score) {
        line(&format!("{world} {seed}"), &score);
        self.rows.push((world, score));
    }

    /// Mean and worst of each world.
    pub(crate) fn sum_up(&self) {
        println!();
        let mut worlds: Vec<&str> = self.rows.iter().map(|it| it.0).collect();
        worlds.dedup();
        for world in worlds {
            let scores: Vec<Score> =
                self.rows.iter().filter(|it| it.0 == world).map(|it| it.1).collect();
            line(
                &format!("{world} mean"),
                &joined(
                    &scores,
                    |it| it.iter().sum::<f64>() / it.len() as f64,
                    |it| it.iter().sum::<f64>() / it.len() as f64,
                ),
            );
            let most = |it: &[f64]| it.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let least = |it: &[f64]| it.iter().copied().fold(f64::INFINITY, f64::min);
            line(&format!("{world} worst"), &joined(&scores, most, least));
        }
    }
}

/// One score of many: `of` joins what is better small, `other` what is better large.
fn joined(scores: &[Score], of: fn(&[f64]) -> f64, other: fn(&[f64]) -> f64) -> Score {
    let small = |value: fn(&Score) -> f64| of(&scores.iter().map(value).collect::<Vec<_>>());
    let large = |value: fn(&Score) -> f64| other(&scores.iter().map(value).collect::<Vec<_>>());
    Score {
        scans: small(|it| it.scans as f64) as usize,
        way_m: small(|it| it.way_m),
        ate_m: small(|it| it.ate_m),
        ate_best_m: small(|it| it.ate_best_m),
        worst_m: small(|it| it.worst_m),
        turn_deg: small(|it| it.turn_deg),
        wall_m: small(|it| it.wall_m),
        right: large(|it| it.right),
        right_best: large(|it| it.right_best),
        found: large(|it| it.found),
        scan_ms: small(|it| it.scan_ms),
        p99_ms: small(|it| it.p99_ms),
        memory_mb: small(|it| it.memory_mb),
        closures: large(|it| it.closures as f64) as u64,
    }
}

fn line(name: &str, it: &Score) {
    println!(
        "{:<18} {:>5} {:>6.0} | {:>7.4} {:>7.4} {:>7.4} {:>6.3} | {:>7.1} {:>7.2} {:>7.2} {:>7.2} | {:>5.2} {:>6.1} {:>5.0} {:>5}",
        name,
        it.scans,
        it.way_m,
        it.ate_m,
        it.ate_best_m,
        it.worst_m,
        it.turn_deg,
        1e3 * it.wall_m,
        100.0 * it.right,
        100.0 * it.right_best,
        100.0 * it.found,
        it.scan_ms,
        it.p99_ms,
        it.memory_mb,
        it.closures
    );
}
