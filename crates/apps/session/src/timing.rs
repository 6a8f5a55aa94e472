//! Time measurements of a run.

use std::path::Path;

use periplus_os::Machine;
use periplus_resources::Host as _;
use serde_json::{Value, json};

/// CPU time of this thread \[s\], on Linux.
#[must_use]
pub fn cpu_s() -> Option<f64> {
    let ns: f64 = words("/proc/thread-self/schedstat")?.split_whitespace().next()?.parse().ok()?;
    Some(ns * 1e-9)
}

fn words(path: &str) -> Option<String> {
    String::from_utf8(Machine.read(Path::new(path)).ok()?).ok()
}

/// Step times in milliseconds: mean, 99th percentile, maximum.
#[must_use]
pub fn steps_ms(spent_s: &[f64]) -> Value {
    let mut sorted = spent_s.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |part: f64| {
        let place = (part * sorted.len().saturating_sub(1) as f64) as usize;
        sorted.get(place).map(|it| 1e3 * it)
    };
    json!({
        "mean": 1e3 * spent_s.iter().sum::<f64>() / spent_s.len().max(1) as f64,
        "p99": at(0.99),
        "worst": at(1.0),
    })
}
