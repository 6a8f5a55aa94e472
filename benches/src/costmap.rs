//! Costmaps: inflation beside the wavefront of the reference and OpenCV's distance transform, and
//! what an update takes.

mod cycles;
mod inflation;
mod wavefront;

use std::path::Path;

use serde_json::Value;

/// Measures, and gives a table; `python` may have `cv2`, and `cells` is a file for it.
pub(crate) fn compare(python: &Path, script: &Path, work: &Path) -> Result<String, String> {
    let mut rows = inflation::run(python, script, work)?;
    rows.extend(cycles::run());
    let mut table = String::from("| work | program | ms |\n|---|---|---|\n");
    for row in rows {
        table += &format!("| {} | {} | {:.3} |\n", row.work, row.who, row.seconds * 1e3);
    }
    Ok(table)
}

/// A measurement.
pub(crate) struct Row {
    pub(crate) work: String,
    pub(crate) who: String,
    pub(crate) seconds: f64,
}

/// The fastest of some turns \[s\].
pub(crate) fn fastest(turns: usize, mut work: impl FnMut() -> f64) -> f64 {
    (0..turns).map(|_| work()).fold(f64::INFINITY, f64::min)
}

/// The middle of some turns \[s\].
pub(crate) fn median(turns: usize, mut work: impl FnMut() -> f64) -> f64 {
    let mut taken: Vec<f64> = (0..turns).map(|_| work()).collect();
    taken.sort_by(f64::total_cmp);
    taken[turns / 2]
}

/// Duration of a function \[s\].
pub(crate) fn seconds(work: impl FnOnce()) -> f64 {
    let start = std::time::Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// A number of a line of JSON.
pub(crate) fn number(line: &str, name: &str) -> Option<f64> {
    serde_json::from_str::<Value>(line).ok()?.get(name)?.as_f64()
}
