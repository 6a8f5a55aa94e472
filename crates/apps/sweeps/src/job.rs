//! A job: one run of the scenario on a copy of its files.

use std::fmt;
use std::path::{Path, PathBuf};

use periplus_os::{FileLog, Machine};
use periplus_resources::Host as _;
use periplus_scenarios::{
    RunOutcome, Scenario, ScenarioFolders, ScenarioRunOptions, below_root, run,
};
use periplus_session::files;
use periplus_sim::Search;

use crate::inputs::sha256;
use crate::plan::{SweepJob, SweepPlan};
use crate::result::JobResult;

/// Reason that a job has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JobFailure(pub String);

impl fmt::Display for JobFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for JobFailure {}

/// Runs the job `index` of a plan in this thread, on the copy of the files in the folder `tree`. Of a run that fails the
/// artifacts are kept in the folder `artifacts`, if it is given. No other job may run in this process at the same time.
///
/// # Errors
/// A copy that is damaged or incomplete, and a scenario that cannot start. A run whose assertions fail is a result.
pub fn run_job(
    plan: &SweepPlan,
    index: usize,
    tree: &Path,
    artifacts: Option<&Path>,
) -> Result<JobResult, JobFailure> {
    let count = plan.jobs.len();
    let job = plan.jobs.get(index);
    let job =
        job.ok_or_else(|| JobFailure(format!("the plan has {count} jobs, and no job {index}")))?;
    let tree = periplus_os::plain(tree);
    check_copy(plan, job, &tree)?;
    FileLog::start();
    let result = run_on_copy(plan, job, &tree, artifacts);
    let log = FileLog::take();
    let result = result?;
    check_reads(plan, job, &tree, &log)?;
    Ok(result)
}

fn run_on_copy(
    plan: &SweepPlan,
    job: &SweepJob,
    tree: &Path,
    artifacts: Option<&Path>,
) -> Result<JobResult, JobFailure> {
    let moved = |path: &Path| tree.join(below_root(path));
    let file = moved(&plan.scenario_file);
    let text = files::text(&file).map_err(|error| JobFailure(error.to_string()))?;
    let mut scenario = Scenario::read(&plan.scenario, text, &job.set).map_err(|error| {
        let first = error.diagnostics.iter().next().map(|it| it.message.clone());
        JobFailure(first.unwrap_or_else(|| "the scenario cannot be read".to_owned()))
    })?;
    let working = moved(&plan.working_folder);
    let folders = ScenarioFolders {
        scenario: file.parent().unwrap_or(tree).to_owned(),
        working: working.clone(),
        root: Some(tree.to_owned()),
    };
    scenario.folders = folders;
    let options = ScenarioRunOptions {
        seed: Some(job.seed),
        artifacts: artifacts.map(Path::to_owned),
        has_digest: true,
        threads: 1,
        search: Search {
            folders: plan.search_folders.iter().map(|folder| moved(folder)).collect(),
            working_folder: working,
            variables: plan.inputs.environment_in(tree),
            advice: None,
        },
        set: job.set.clone(),
        parameters: job.parameters.clone(),
        ..ScenarioRunOptions::default()
    };
    let prefix = tree.display().to_string();
    let plain = |text: &str| text.replace(&prefix, "");
    let report = run(&scenario, &options).map_err(|error| JobFailure(plain(&error.to_string())))?;
    if report.outcome == RunOutcome::Interrupted {
        return Err(JobFailure("the run was interrupted".to_owned()));
    }
    Ok(JobResult::of_report(job, &report, plain))
}

/// Checks that the files of the copy are those of the plan.
fn check_copy(plan: &SweepPlan, job: &SweepJob, tree: &Path) -> Result<(), JobFailure> {
    for number in &plan.file_lists[job.file_list] {
        let file = &plan.inputs.files[*number];
        let copy = tree.join(below_root(&file.path));
        let content = files::read(&copy).map_err(|error| JobFailure(error.to_string()))?;
        if sha256(&content) != file.sha256 {
            return Err(JobFailure(format!(
                "{} has changed: it is the copy of a file that the sweep read; remove the folder {} and start again",
                copy.display(),
                tree.display()
            )));
        }
    }
    Ok(())
}

/// Checks that the run read no file besides those of its key: otherwise its result could be that of other contents.
fn check_reads(
    plan: &SweepPlan,
    job: &SweepJob,
    tree: &Path,
    log: &FileLog,
) -> Result<(), JobFailure> {
    let list = &plan.file_lists[job.file_list];
    let copies: std::collections::BTreeSet<PathBuf> =
        list.iter().map(|number| tree.join(below_root(&plan.inputs.files[*number].path))).collect();
    let is_system =
        |path: &&PathBuf| ["/proc", "/sys", "/dev"].iter().any(|it| path.starts_with(it));
    // The resolver may follow links of the folder in which the copy is.
    let real = Machine.canonical(tree).unwrap_or_else(|| tree.to_owned());
    let foreign = log.read.iter().filter(|path| !is_system(path)).find(|path| {
        let inside = path.strip_prefix(&real).map(|rest| tree.join(rest));
        !copies.contains(*path) && !inside.is_ok_and(|path| copies.contains(&path))
    });
    match foreign {
        None => Ok(()),
        Some(path) => Err(JobFailure(format!(
            "the run read {}, which was not read when the sweep was planned: name the file in the scenario, not in \
             another file by its absolute path",
            path.strip_prefix(tree)
                .map_or(path.clone(), |rest| Path::new("/").join(rest))
                .display()
        ))),
    }
}
