//! Table, picture and summary of a sweep.

use std::io::{self, Write as _};
use std::process::ExitCode;

use periplus_session::files;
use periplus_sweeps::{
    JobFailure, JobResult, PointStatistics, SweepFolder, SweepPlan, SweepTable, overview_svg,
    statistics, write_parquet,
};
use serde_json::json;

use super::{Counts, SweepOptions, failed};
use crate::error::CliError;
use crate::terminal;

/// Names of the files.
const TABLE_FILE: &str = "sweep.parquet";
const PICTURE_FILE: &str = "overview.svg";

/// Maximum number of runs without a result that are listed.
const MAX_LISTED: usize = 5;

/// Maximum number of points that are listed as text.
const MAX_POINTS: usize = 40;

impl SweepOptions {
    /// Writes the table and the picture, and prints the summary.
    pub(super) fn finish(
        &self,
        folder: &SweepFolder,
        plan: &SweepPlan,
        failures: &[Option<String>],
        counts: &Counts,
    ) -> Result<ExitCode, CliError> {
        let mut results: Vec<Result<JobResult, JobFailure>> = Vec::with_capacity(plan.jobs.len());
        for (job, failure) in plan.jobs.iter().zip(failures) {
            let result = folder.result(job).map_err(failed)?;
            let reason =
                || JobFailure(failure.clone().unwrap_or_else(|| "it left no result".to_owned()));
            results.push(result.ok_or_else(reason));
        }
        let table = SweepTable::assemble(plan, &results);
        let created_by = format!("periplus version {}", plan.version);
        let bytes = write_parquet(&table, &created_by, &[("periplus.scenario", &plan.name)]);
        let (table_file, picture) =
            (folder.path().join(TABLE_FILE), folder.path().join(PICTURE_FILE));
        files::write(&table_file, &bytes)?;
        files::write(&picture, overview_svg(plan, &table).as_bytes())?;
        let points = statistics(plan, &table);
        let not_run: Vec<(usize, &JobFailure)> = results
            .iter()
            .enumerate()
            .filter_map(|(index, result)| Some((index, result.as_ref().err()?)))
            .collect();
        if self.json {
            let point = |it: &PointStatistics| {
                let values = plan.names.iter().cloned().zip(it.values.iter().map(|it| json!(it)));
                json!({
                    "values": values.collect::<serde_json::Map<_, _>>(),
                    "runs": it.runs,
                    "metrics": it.metrics,
                })
            };
            let not_run =
                not_run.iter().map(|(run, reason)| json!({ "run": run, "reason": reason.0 }));
            let summary = json!({
                "scenario": plan.name,
                "runs": plan.jobs.len(),
                "reused": counts.reused,
                "ran": counts.ran,
                "started": counts.started,
                "not_run": not_run.collect::<Vec<_>>(),
                "table": table_file,
                "picture": picture,
                "points": points.iter().map(point).collect::<Vec<_>>(),
            });
            writeln!(io::stdout().lock(), "{summary:#}")?;
        } else if !self.quiet {
            for line in text(plan, &points, counts) {
                terminal::say(&line);
            }
            terminal::say(&format!("table: {}", table_file.display()));
            terminal::say(&format!("picture: {}", picture.display()));
        }
        if not_run.is_empty() {
            return Ok(ExitCode::SUCCESS);
        }
        for (index, reason) in not_run.iter().take(MAX_LISTED) {
            let job = &plan.jobs[*index];
            let values =
                plan.names.iter().zip(&job.values).map(|(name, value)| format!(" {name}={value}"));
            let values: String = values.collect();
            terminal::complain(&format!("run {index} (seed {}{values}): {reason}", job.seed));
        }
        let (count, all) = (not_run.len(), plan.jobs.len());
        terminal::complain(&format!(
            "{count} of {all} runs have no result; the same command tries them again"
        ));
        Ok(ExitCode::FAILURE)
    }
}

/// Lines of the summary: for each point the share of runs that passed.
fn text(plan: &SweepPlan, points: &[PointStatistics], counts: &Counts) -> Vec<String> {
    let mut lines = Vec::new();
    for point in points.iter().take(MAX_POINTS) {
        let values =
            plan.names.iter().zip(&point.values).map(|(name, value)| format!("{name}={value}"));
        let values: Vec<String> = values.collect();
        let passed = point.metrics.iter().find(|it| it.name == "passed");
        let count = passed.map_or(0.0, |it| it.mean * it.count as f64).round();
        let all = if values.is_empty() { "all seeds".to_owned() } else { values.join(" ") };
        lines.push(format!("  {all}: {count} of {} passed", point.runs));
    }
    if points.len() > MAX_POINTS {
        lines.push(format!("  and {} more points", points.len() - MAX_POINTS));
    }
    let Counts { reused, ran, started } = counts;
    let mut line = format!("{ran} runs done, {reused} were there");
    let lost = started.map(|started| started.saturating_sub(*ran)).filter(|lost| *lost > 0);
    if let Some(lost) = lost {
        line.push_str(&format!(", {lost} were lost and repeated"));
    }
    lines.push(line);
    lines
}
