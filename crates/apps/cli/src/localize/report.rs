//! Report of a localization run.

use std::io::{self, Write};
use std::path::Path;

use periplus_localization::Amcl;
use periplus_os::peak_memory_bytes;
use periplus_session::scan_log::ScanLog;
use periplus_session::timing::{cpu_s, steps_ms};
use serde_json::{Map, Value, json};

use super::offline::Outcome;

/// Report of a localization run.
pub(super) struct Report<'a> {
    pub(super) log_path: &'a Path,
    pub(super) map_path: &'a Path,
    pub(super) out: &'a Path,
    pub(super) amcl: &'a Amcl,
    pub(super) log: &'a ScanLog,
    pub(super) outcome: &'a Outcome,
    /// Time to read the log and the map.
    pub(super) loaded_s: f64,
    /// Total time.
    pub(super) wall_s: f64,
}

impl Report<'_> {
    /// JSON report. Called last, so that the peak memory includes the whole run.
    pub(super) fn to_json(&self) -> Value {
        let Outcome { settled, states, changes, refused, .. } = self.outcome;
        let changes: Vec<Value> = changes
            .iter()
            .map(|(stamp, state, why)| json!({"stamp": stamp, "state": state, "why": why}))
            .collect();
        let refused: Map<String, Value> = refused
            .iter()
            .map(|(code, (why, count))| ((*code).to_owned(), json!({"why": why, "scans": count})))
            .collect();
        let status = self.amcl.status();
        let last = self.amcl.estimate().map(|estimate| {
            let (pose, spread) = (estimate.pose, estimate.covariance);
            json!({
                "pose": [pose.x_m, pose.y_m, pose.yaw_rad],
                "spread_m": spread.radius_m(),
                "spread_rad": spread.yaw.sqrt(),
                "particles": self.amcl.particles().len(),
            })
        });
        json!({
            "log": self.log_path,
            "kind": self.log.kind,
            "map": self.map_path,
            "wall_s": self.wall_s,
            "cpu_s": cpu_s(),
            "peak_memory_bytes": peak_memory_bytes(),
            "load_s": self.loaded_s,
            "update_ms": steps_ms(&self.outcome.spent_s),
            "scans": self.log.scans.len(),
            "used_scans": self.outcome.spent_s.len(),
            "scans_without_odometry": self.outcome.without_odometry,
            "refused": refused,
            "log_s": self.log.span_s(),
            "path_m": self.path_m(),
            "settled_after_s": settled.map(|it| it.0),
            "settled_after_m": settled.map(|it| it.1),
            "scans_in_state": states,
            "scan_on_walls": self.fit(),
            "state_changes": changes,
            "last": last,
            "last_state": status.reason,
            "warnings": self.log.warnings,
            "faults": self.log.faults,
        })
    }

    /// Prints the report as text.
    pub(super) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
        for warning in &self.log.warnings {
            writeln!(out, "warning: {warning}")?;
        }
        let Outcome { settled, states, refused, spent_s, .. } = self.outcome;
        writeln!(
            out,
            "{} scans over {:.0} m and {:.0} s, {} of them used, in {:.2} s: {:.0} x real time",
            self.log.scans.len(),
            self.path_m(),
            self.log.span_s(),
            spent_s.len(),
            self.wall_s,
            self.log.span_s() / self.wall_s.max(1e-9),
        )?;
        match settled {
            Some((after_s, after_m)) => {
                writeln!(out, "  localized after {after_s:.1} s and {after_m:.2} m")?;
            }
            None => writeln!(out, "  never localized: {}", self.amcl.status().reason)?,
        }
        let all = self.log.scans.len().max(1) as f64;
        let share = |(state, count): (&&str, &usize)| {
            format!("{state} {:.1} %", 100.0 * *count as f64 / all)
        };
        writeln!(out, "  {}", states.iter().map(share).collect::<Vec<_>>().join(", "))?;
        if let Some(fit) = self.fit() {
            writeln!(out, "  {:.0} % of the scan points are on walls of the map", 100.0 * fit)?;
        }
        for (why, count) in refused.values() {
            writeln!(out, "  {count} scans could not be used: {why}")?;
        }
        if self.outcome.without_odometry > 0 {
            writeln!(
                out,
                "  {} scans have no odometry at their stamp and were left out",
                self.outcome.without_odometry
            )?;
        }
        writeln!(out, "  trajectory and report are in {}", self.out.display())
    }

    fn fit(&self) -> Option<f64> {
        let (sum, count) = self.outcome.fits;
        (count > 0).then(|| sum / count as f64)
    }

    fn path_m(&self) -> f64 {
        let poses = self.outcome.trajectory.windows(2);
        poses.map(|it| libm::hypot(it[1].1.x_m - it[0].1.x_m, it[1].1.y_m - it[0].1.y_m)).sum()
    }
}
