//! Jobs of a sweep in this process: `periplus sweep-job PLAN INDEX`, which the pool and SLURM start.

use std::path::Path;
use std::process::ExitCode;

use periplus_session::files;
use periplus_sweeps::{SweepFolder, SweepPlan};

use super::failed;
use crate::error::CliError;

/// Word that runs jobs of a plan.
pub(crate) const JOB_VERB: &str = "sweep-job";

/// Option that keeps no artifacts.
pub(super) const NO_ARTIFACTS: &str = "--no-artifacts";

/// Runs the job of a number, and with `--step N` each Nth one behind it. Jobs with results are left out.
pub(crate) fn run_jobs(words: &[String]) -> Result<ExitCode, CliError> {
    let usage = || CliError::usage(format!("{JOB_VERB} PLAN INDEX [--step N] [{NO_ARTIFACTS}]"));
    let number = |word: &String| word.parse::<usize>().map_err(|_| usage());
    let [plan_file, first, options @ ..] = words else { return Err(usage()) };
    let first = number(first)?;
    let (mut step, mut keeps_artifacts) = (None, true);
    let mut options = options.iter();
    while let Some(word) = options.next() {
        match word.as_str() {
            NO_ARTIFACTS => keeps_artifacts = false,
            "--step" => step = Some(number(options.next().ok_or_else(usage)?)?.max(1)),
            _ => return Err(usage()),
        }
    }
    let plan_file = Path::new(plan_file);
    let plan = SweepPlan::from_json(&files::text(plan_file)?).map_err(failed)?;
    let folder = SweepFolder::of_plan(plan_file);
    let mut outcome = Ok(());
    let mut index = first;
    while let Some(job) = plan.jobs.get(index) {
        if !folder.has_result(job) {
            // The other runs of this task do not depend on one that fails.
            let run = folder.run(&plan, index, keeps_artifacts).map_err(failed);
            outcome = outcome.and(run);
        }
        match step {
            Some(step) => index += step,
            None => break,
        }
    }
    outcome.map(|()| ExitCode::SUCCESS)
}
