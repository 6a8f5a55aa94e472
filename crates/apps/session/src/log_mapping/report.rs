//! Report of a mapping run.

use std::io::{self, Write};

use periplus_os::peak_memory_bytes;
use periplus_slam::tables::GmappingParams;
use periplus_slam::{ConstraintKind, Mapper, Method, MountingCorrection, Remark, RemarkKind};
use serde_json::{Value, json};

use super::parameters::SlamParameters;
use super::request::LogMappingRequest;
use crate::scan_log::{ScanLog, stamp};
use crate::timing::{cpu_s, steps_ms};

/// Report of a mapping run.
pub struct MappingReport<'a> {
    pub(super) request: &'a LogMappingRequest,
    pub(super) slam: &'a dyn Mapper,
    pub(super) parameters: &'a SlamParameters,
    pub(super) log: &'a ScanLog,
    /// Time to read the log.
    pub(super) loaded_s: f64,
    /// Time of the last optimization.
    pub(super) finish_s: f64,
    /// Total time.
    pub(super) wall_s: f64,
    /// Time per scan.
    pub(super) spent_s: &'a [f64],
    /// Error of the data that was corrected before the map was rebuilt.
    pub(super) remedy: Option<MountingCorrection>,
}

impl MappingReport<'_> {
    /// JSON report. Called last, so that the peak memory includes the whole run.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let counts = self.slam.counts();
        let closures: Vec<Value> = self
            .slam
            .closures()
            .iter()
            .map(|it| {
                json!({
                    "keys": [it.keyframes.0, it.keyframes.1],
                    "old_from_new": [it.old_from_new.x_m, it.old_from_new.y_m, it.old_from_new.yaw_rad],
                    "accepted": it.is_accepted,
                    "region_m": it.region_m,
                    "agreeing": it.agreeing,
                    "reason": it.reason,
                })
            })
            .collect();
        json!({
            "log": self.request.log,
            "method": self.slam.method().word(),
            "parameters": self.given(),
            "kind": self.log.kind,
            "wall_s": self.wall_s,
            "cpu_s": cpu_s(),
            "peak_memory_bytes": peak_memory_bytes(),
            "load_s": self.loaded_s,
            "finish_s": self.finish_s,
            "scan_ms": steps_ms(self.spent_s),
            "scans": counts.scans,
            "kept_scans": counts.kept,
            "lost_scans": counts.lost,
            "ignored_scans": counts.ignored,
            "path_m": self.path_m(),
            "log_s": self.log.span_s(),
            "ties": counts.proximity,
            "loop_closures": self.accepted(),
            "loop_searches": counts.searches,
            "resamplings": self.slam.resamplings(),
            "map_memory_bytes": self.slam.size(),
            "closures": closures,
            "edges": self.edges(),
            "contradictions": self.contradictions(),
            "remedy": self.remedy.map(|it| it.to_string()),
            "warnings": self.warnings(),
            "faults": self.log.faults,
        })
    }

    /// Edges of the graph, as `--g2o` writes them: both keyframes, the source, and the residual
    /// \[m, rad\].
    fn edges(&self) -> Vec<Value> {
        let edges = self.slam.edges().into_iter();
        let told = edges.map(|edge| {
            let link = match edge.link {
                ConstraintKind::Sequential => "chain",
                ConstraintKind::Proximity => "tie",
                ConstraintKind::LoopClosure => "closure",
            };
            json!({
                "keys": [edge.keyframes.0, edge.keyframes.1],
                "link": link,
                "residual": [edge.residual_m, edge.residual_rad],
            })
        });
        told.collect()
    }

    /// Regions where two passes contradict each other: position in the map \[m\], fraction of
    /// agreement of the commonly seen area, and for both passes the keyframes and stamps of the
    /// stretch, as in the trajectory.
    fn contradictions(&self) -> Vec<Value> {
        let pass = |keys: (usize, usize), times_ns: (i64, i64)| json!({ "keys": [keys.0, keys.1], "stamps": [stamp(times_ns.0), stamp(times_ns.1)] });
        let found = self.slam.contradictions().into_iter();
        let told = found.map(|it| {
            json!({
                "position": [it.map_from_base.x_m, it.map_from_base.y_m],
                "agreeing": it.agreeing_ratio,
                "pass": pass(it.keyframes, it.times_ns),
                "earlier_pass": pass(it.earlier_keyframes, it.earlier_times_ns),
            })
        });
        told.collect()
    }

    /// Reason for which the map must not be used.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        let counts = self.slam.counts();
        let is_unfitting = |remark: &Remark| matches!(remark.kind, RemarkKind::UnmatchedScans(_));
        self.slam.remarks().iter().any(is_unfitting).then(|| {
            format!(
                "{} of {} scans match nothing in the map: do not use the map; check the scanner's transform \
                 (`periplus doctor`), the time stamps, and spurious readings",
                counts.lost, counts.scans
            )
        })
    }

    /// Prints the report as text.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_text(&self, out: &mut dyn Write, is_written: bool) -> io::Result<()> {
        let counts = self.slam.counts();
        for warning in self.warnings() {
            writeln!(out, "warning: {warning}")?;
        }
        let how = match self.slam.method() {
            Method::Graph => format!("{} loops closed, {} ties", self.accepted(), counts.proximity),
            Method::Gmapping => format!(
                "{} particles, resampled {} times",
                GmappingParams::from_values(&self.parameters.values).particles,
                self.slam.resamplings()
            ),
        };
        writeln!(
            out,
            "{} scans over {:.0} m and {:.0} s in {:.2} s: {:.0} x real time; {how}",
            counts.scans,
            self.path_m(),
            self.log.span_s(),
            self.wall_s,
            self.log.span_s() / self.wall_s.max(1e-9),
        )?;
        if counts.lost + counts.ignored > 0 {
            writeln!(
                out,
                "  {} scans did not match, {} had no usable range",
                counts.lost, counts.ignored
            )?;
        }
        if is_written {
            writeln!(out, "  map and trajectory: {}", self.request.out.display())?;
        }
        Ok(())
    }

    /// Warnings on the log, and on what its drive shows.
    fn warnings(&self) -> Vec<String> {
        let begin_ns = self.log.scans.first().map_or(0, |it| it.scan.time_ns);
        let remarks = self.slam.remarks().iter().map(|remark| {
            let after_s = remark.time_ns.saturating_sub(begin_ns) as f64 * 1e-9;
            format!("{remark} (noticed after {after_s:.0} s)")
        });
        let remedy = self.remedy.map(|it| format!("the map was rebuilt: {it}"));
        self.log.warnings.iter().cloned().chain(remedy).chain(remarks).collect()
    }

    /// Parameters set by the user.
    fn given(&self) -> serde_json::Map<String, Value> {
        let values = &self.parameters.values;
        let given = values.table().names().filter(|name| values.is_given(name));
        given
            .filter_map(|name| Some((name.to_owned(), json!(values.get(name)?.to_string()))))
            .collect()
    }

    fn accepted(&self) -> usize {
        self.slam.closures().iter().filter(|it| it.is_accepted).count()
    }

    fn path_m(&self) -> f64 {
        let trajectory = self.slam.trajectory();
        trajectory
            .windows(2)
            .map(|pair| libm::hypot(pair[1].1.x_m - pair[0].1.x_m, pair[1].1.y_m - pair[0].1.y_m))
            .sum()
    }
}
