//! Folder of a sweep: plans, copies of files, results by their keys, artifacts of runs that failed.

use std::fs;
use std::path::{Path, PathBuf};

use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_session::files;

use crate::error::SweepError;
use crate::inputs::SweepInputs;
use crate::plan::{SweepJob, SweepPlan};
use crate::result::JobResult;

/// Folder of a sweep:
///
/// | path | content |
/// |---|---|
/// | `plan-ID.json` | plan |
/// | `inputs/HASH` | copy of the files that the runs read |
/// | `results/KEY.json` | result of a run |
/// | `failures/KEY` | artifacts of a run that failed |
#[derive(Clone, Debug)]
pub struct SweepFolder {
    path: PathBuf,
}

impl SweepFolder {
    /// Folder at a path. It is created when a plan is made.
    #[must_use]
    pub fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// Creates the folder, unless it exists.
    pub(crate) fn create(&self) -> Result<(), SweepError> {
        files::make_folder(&self.path.join("results"))?;
        files::make_folder(&self.path.join("inputs"))?;
        Ok(())
    }

    /// Folder of a plan file.
    #[must_use]
    pub fn of_plan(plan: &Path) -> Self {
        Self { path: plan.parent().unwrap_or(Path::new("")).to_owned() }
    }

    /// Path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Folder with the copy of files.
    #[must_use]
    pub fn tree(&self, inputs: &SweepInputs) -> PathBuf {
        self.path.join("inputs").join(inputs.tree_name())
    }

    /// Path of the file of a plan.
    #[must_use]
    pub fn plan_file(&self, plan: &SweepPlan) -> PathBuf {
        self.path.join(format!("plan-{}.json", plan.id()))
    }

    /// Path of the result of a job.
    #[must_use]
    pub fn result_file(&self, job: &SweepJob) -> PathBuf {
        self.path.join("results").join(format!("{}.json", job.key))
    }

    /// Folder of the artifacts of a job.
    #[must_use]
    pub fn failure_folder(&self, job: &SweepJob) -> PathBuf {
        self.path.join("failures").join(&job.key)
    }

    /// Writes a plan.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_plan(&self, plan: &SweepPlan) -> Result<PathBuf, SweepError> {
        let path = self.plan_file(plan);
        files::write(&path, plan.to_json().as_bytes())?;
        Ok(path)
    }

    /// Returns true if a job has a result.
    #[must_use]
    pub fn has_result(&self, job: &SweepJob) -> bool {
        Machine.kind(&self.result_file(job)).is_some()
    }

    /// Result of a job; `None` if there is none.
    ///
    /// # Errors
    /// A file that is not the result of this job.
    pub fn result(&self, job: &SweepJob) -> Result<Option<JobResult>, SweepError> {
        let path = self.result_file(job);
        if Machine.kind(&path).is_none() {
            return Ok(None);
        }
        let result = JobResult::from_json(&files::text(&path)?, &job.key);
        result.map(Some).map_err(|error| {
            SweepError::Failed(format!(
                "{}: {error}; remove the file to run it again",
                path.display()
            ))
        })
    }

    /// Stores the result of a job: a reader sees a whole file or none.
    ///
    /// # Errors
    /// A failed write.
    pub fn store(&self, job: &SweepJob, result: &JobResult) -> Result<(), SweepError> {
        files::write(&self.result_file(job), result.to_json().as_bytes())?;
        Ok(())
    }

    /// Removes the results of these jobs and their artifacts.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn forget(&self, jobs: &[SweepJob]) -> Result<(), SweepError> {
        for job in jobs.iter().filter(|job| self.has_result(job)) {
            let path = self.result_file(job);
            fs::remove_file(&path).map_err(|error| {
                SweepError::Failed(format!("cannot remove {}: {error}", path.display()))
            })?;
            let _ = fs::remove_dir_all(self.failure_folder(job));
        }
        Ok(())
    }

    /// Runs a job in this process and stores its result. Artifacts appear under their name before the result does.
    ///
    /// # Errors
    /// As for [`crate::run_job`], and a failed write.
    pub fn run(
        &self,
        plan: &SweepPlan,
        index: usize,
        keeps_artifacts: bool,
    ) -> Result<(), SweepError> {
        let failed = |error: crate::JobFailure| SweepError::Failed(error.0);
        let Some(job) = plan.jobs.get(index) else {
            let count = plan.jobs.len();
            return Err(SweepError::Usage(format!(
                "the plan has {count} jobs, and no job {index}"
            )));
        };
        let tree = self.tree(&plan.inputs);
        if !keeps_artifacts {
            let result = crate::run_job(plan, index, &tree, None).map_err(failed)?;
            return self.store(job, &result);
        }
        let folder = self.failure_folder(job);
        let part = folder.with_extension(format!("{}.part", std::process::id()));
        let result = crate::run_job(plan, index, &tree, Some(&part));
        if result.is_err() {
            let _ = fs::remove_dir_all(&part);
        }
        let result = result.map_err(failed)?;
        if Machine.kind(&part).is_some() {
            // The artifacts of an earlier run of the same job are equal.
            let _ = fs::remove_dir_all(&folder);
            fs::rename(&part, &folder).map_err(|error| {
                SweepError::Failed(format!("cannot rename {}: {error}", part.display()))
            })?;
        }
        self.store(job, &result)
    }
}
