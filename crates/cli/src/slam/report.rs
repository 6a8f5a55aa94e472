//! How a run went.

use std::io::{self, Write};
use std::path::Path;

use periplus_host::Machine;
use periplus_resources::Host as _;
use periplus_slam::Slam;
use serde_json::{Value, json};

use super::log::Log;
use super::options::SlamOptions;

/// How a run went.
pub(super) struct Report<'a> {
    pub(super) options: &'a SlamOptions,
    pub(super) slam: &'a Slam,
    pub(super) log: &'a Log,
    /// Reading the log.
    pub(super) loaded_s: f64,
    /// The last refinement.
    pub(super) finish_s: f64,
    /// All together.
    pub(super) wall_s: f64,
    /// For each scan.
    pub(super) spent_s: &'a [f64],
}

impl Report<'_> {
    /// For a program.
    pub(super) fn to_json(&self) -> Value {
        let counts = self.slam.counts();
        let closures: Vec<Value> = self
            .slam
            .closures()
            .iter()
            .map(|it| {
                json!({
                    "keys": [it.keys.0, it.keys.1],
                    "old_from_new": [it.old_from_new.x_m, it.old_from_new.y_m, it.old_from_new.yaw_rad],
                    "accepted": it.is_accepted,
                    "region_m": it.region_m,
                    "agreeing": it.agreeing,
                    "reason": it.reason,
                })
            })
            .collect();
        let mut sorted = self.spent_s.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |part: f64| sorted.get((part * (sorted.len() - 1) as f64) as usize).copied();
        json!({
            "log": self.options.log,
            "kind": self.log.kind,
            "wall_s": self.wall_s,
            "cpu_s": cpu_s(),
            "peak_memory_bytes": peak_bytes(),
            "load_s": self.loaded_s,
            "finish_s": self.finish_s,
            "scan_ms": {
                "mean": 1e3 * self.spent_s.iter().sum::<f64>() / self.spent_s.len().max(1) as f64,
                "p99": at(0.99).map(|it| 1e3 * it),
                "worst": at(1.0).map(|it| 1e3 * it),
            },
            "scans": counts.scans,
            "kept_scans": counts.kept,
            "lost_scans": counts.lost,
            "ignored_scans": counts.ignored,
            "path_m": self.path_m(),
            "log_s": self.log_s(),
            "ties": counts.ties,
            "loop_closures": self.accepted(),
            "loop_searches": counts.searches,
            "map_memory_bytes": self.slam.size(),
            "closures": closures,
            "warnings": self.warnings(),
            "faults": self.log.faults,
        })
    }

    /// For a person.
    pub(super) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
        let counts = self.slam.counts();
        for warning in self.warnings() {
            writeln!(out, "warning: {warning}")?;
        }
        writeln!(
            out,
            "{} scans over {:.0} m and {:.0} s in {:.2} s: {:.0} x real time; {} loops closed, {} ties",
            counts.scans,
            self.path_m(),
            self.log_s(),
            self.wall_s,
            self.log_s() / self.wall_s.max(1e-9),
            self.accepted(),
            counts.ties
        )?;
        if counts.lost + counts.ignored > 0 {
            writeln!(out, "  {} scans did not fit, {} said nothing", counts.lost, counts.ignored)?;
        }
        writeln!(out, "  map and trajectory are in {}", self.options.out.display())
    }

    /// What is odd about the log, and about what the drive in it shows.
    fn warnings(&self) -> Vec<String> {
        let begin_ns = self.log.scans.first().map_or(0, |it| it.scan.time_ns);
        let remarks = self.slam.remarks().iter().map(|remark| {
            let after_s = remark.time_ns.saturating_sub(begin_ns) as f64 * 1e-9;
            format!("{remark} (noticed after {after_s:.0} s)")
        });
        self.log.warnings.iter().cloned().chain(remarks).collect()
    }

    fn accepted(&self) -> usize {
        self.slam.closures().iter().filter(|it| it.is_accepted).count()
    }

    fn path_m(&self) -> f64 {
        let trajectory = self.slam.trajectory();
        trajectory
            .windows(2)
            .map(|pair| (pair[1].1.x_m - pair[0].1.x_m).hypot(pair[1].1.y_m - pair[0].1.y_m))
            .sum()
    }

    fn log_s(&self) -> f64 {
        let stamps = || self.log.scans.iter().map(|it| it.scan.time_ns);
        let span_ns = stamps().max().unwrap_or(0).saturating_sub(stamps().min().unwrap_or(0));
        span_ns as f64 * 1e-9
    }
}

/// Seconds of this thread on a CPU, where Linux tells.
fn cpu_s() -> Option<f64> {
    let ns: f64 = words("/proc/thread-self/schedstat")?.split_whitespace().next()?.parse().ok()?;
    Some(ns * 1e-9)
}

/// Most memory that was ever held, where Linux tells \[bytes\].
fn peak_bytes() -> Option<u64> {
    let status = words("/proc/self/status")?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}

fn words(path: &str) -> Option<String> {
    String::from_utf8(Machine.read(Path::new(path)).ok()?).ok()
}
