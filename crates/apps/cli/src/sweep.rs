//! `periplus sweep`.

mod job;
mod python;
mod report;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use periplus_session::{files, stop};
use periplus_sweeps::{
    LocalPool, ParameterRange, ParameterTarget, RangeError, SweepError, SweepFolder, SweepPlan,
    SweepRequest, grid, slurm_script,
};

use crate::error::CliError;
use crate::options::SearchOptions;
use crate::own_command::own_command;
use crate::{scenario, terminal};

pub(crate) use job::{JOB_VERB, run_jobs};

/// Run a scenario over a grid of parameters and seeds, into one table
///
/// Each run is a separate process, in simulated time; its result is kept under the hash of everything that it depends on,
/// so that a sweep continues where it ended. The table (`sweep.parquet`) is the same to the byte whatever ran the runs:
/// this machine, Ray (`--ray`) or SLURM (`--slurm`). NAME of a parameter is a variable of the scenario, or the end of
/// `NODE.PARAMETER`. Exit code 1: a run could not start or end; assertions that do not hold are results.
#[derive(Debug, Args)]
pub(crate) struct SweepOptions {
    /// Scenario file
    #[arg(value_name = "FILE.yaml")]
    scenario: PathBuf,
    /// Values of a parameter; several parameters are a full grid; repeatable
    #[arg(long = "param", value_name = "NAME=LOW:HIGH:COUNT|NAME=A,B", value_parser = range)]
    parameters: Vec<ParameterRange>,
    /// Points in place of a grid: a JSON list such as `[{"loss": 0.1}, {"loss": 0.2}]`
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["parameters", "search"])]
    points: Option<PathBuf>,
    /// Number of seeds of each point
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    seeds: u32,
    /// First seed [default: that of the scenario]
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Value of a variable of the scenario for all runs; repeatable
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = scenario::variable)]
    variables: Vec<(String, String)>,
    /// Folder of the sweep [default: sweep-SCENARIO]
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of processes at a time [default: number of processors]
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..))]
    workers: Option<u32>,
    /// Run on a Ray cluster at this address, or `auto` for that of this machine
    #[arg(long, value_name = "ADDRESS", conflicts_with_all = ["workers", "slurm", "collect"])]
    ray: Option<String>,
    /// Write a script with an array job for SLURM's sbatch, and run nothing
    #[arg(long, value_name = "FILE", conflicts_with_all = ["workers", "collect"])]
    slurm: Option<PathBuf>,
    /// Gather the results that are there, and run nothing
    #[arg(long)]
    collect: bool,
    /// Search the parameters (NAME=LOW:HIGH, or a list) for the best mean of this column with Optuna; `:max` for the largest
    #[arg(long, value_name = "COLUMN[:min|:max]", conflicts_with_all = ["slurm", "collect"], requires = "parameters")]
    search: Option<String>,
    /// Number of points of a search
    #[arg(long, value_name = "NUMBER", default_value_t = 30, requires = "search", value_parser = clap::value_parser!(u32).range(1..))]
    trials: u32,
    /// Run everything again, also where results are there
    #[arg(long, conflicts_with = "collect")]
    fresh: bool,
    /// Do not keep recording, map, picture and log of runs that fail
    #[arg(long)]
    no_artifacts: bool,
    /// Print the statistics of all points as JSON
    #[arg(long)]
    json: bool,
    /// Print only errors
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    search_options: SearchOptions,
}

fn range(text: &str) -> Result<ParameterRange, RangeError> {
    text.parse()
}

/// Numbers of runs by what happened to them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Counts {
    /// Runs that had a result before.
    reused: usize,
    /// Runs that got a result.
    ran: usize,
    /// Starts of runs, with those that were lost; `None` where they are not counted.
    started: Option<usize>,
}

pub(crate) fn run(options: &SweepOptions) -> Result<ExitCode, CliError> {
    let stop = stop::on_signal();
    if let Some(metric) = &options.search {
        return options.search_with_optuna(metric);
    }
    let folder = SweepFolder::at(&options.folder()?);
    let plan = options.plan(&folder)?;
    let plan_file = folder.write_plan(&plan).map_err(failed)?;
    options.announce(&plan);
    if options.fresh {
        folder.forget(&plan.jobs).map_err(failed)?;
    }
    if let Some(script) = &options.slurm {
        return options.write_script(script, &plan, &plan_file);
    }
    let missing: Vec<usize> =
        (0..plan.jobs.len()).filter(|index| !folder.has_result(&plan.jobs[*index])).collect();
    let mut counts = Counts { reused: plan.jobs.len() - missing.len(), ..Counts::default() };
    let mut failures = vec![None; plan.jobs.len()];
    if options.collect || missing.is_empty() {
        for index in missing {
            failures[index] = Some("it has no result yet".to_owned());
        }
    } else if let Some(address) = &options.ray {
        let work = python::RayWork { address, plan_file: &plan_file, missing: &missing };
        counts.started = options.run_on_ray(&work, &mut failures, &stop)?;
    } else {
        options.run_here(&plan_file, &missing, &mut failures, &stop)?;
    }
    let has_result = |index: &usize| folder.has_result(&plan.jobs[*index]);
    let complete = (0..plan.jobs.len()).filter(has_result).count();
    counts.ran = complete - counts.reused;
    if stop.load(Ordering::Relaxed) {
        let count = plan.jobs.len();
        let words = format!("{complete} of {count} runs are complete; the same command continues");
        terminal::say(&words);
        return Ok(ExitCode::from(terminal::INTERRUPTED));
    }
    options.finish(&folder, &plan, &failures, &counts)
}

impl SweepOptions {
    fn is_silent(&self) -> bool {
        self.quiet || self.json
    }

    fn folder(&self) -> Result<PathBuf, CliError> {
        if let Some(out) = &self.out {
            return Ok(out.clone());
        }
        let name = self.scenario.file_name().map(|it| it.to_string_lossy().into_owned());
        let name = name.ok_or_else(|| {
            CliError::usage(format!("`{}` names no scenario file", self.scenario.display()))
        })?;
        let name = name.trim_end_matches(".yaml").trim_end_matches(".yml");
        Ok(PathBuf::from(format!("sweep-{}", name.trim_end_matches(".scenario"))))
    }

    fn plan(&self, folder: &SweepFolder) -> Result<SweepPlan, CliError> {
        let request = SweepRequest {
            scenario: self.scenario.clone(),
            set: self.variables.clone(),
            first_seed: self.seed,
            seed_count: self.seeds as usize,
            search_folders: self.search_options.resource_path.clone(),
            ..SweepRequest::default()
        };
        let request = match &self.points {
            Some(path) => request.with_points(&files::text(path)?).map_err(failed)?,
            None => SweepRequest {
                names: self.parameters.iter().map(|it| it.name().to_owned()).collect(),
                points: grid(&self.parameters).map_err(CliError::usage)?,
                ..request
            },
        };
        SweepPlan::make(&request, folder).map_err(failed)
    }

    /// Prints the number of runs and what each name sets.
    fn announce(&self, plan: &SweepPlan) {
        if self.is_silent() {
            return;
        }
        for (name, target) in plan.names.iter().zip(&plan.targets) {
            let sets = match target {
                ParameterTarget::Variable(name) => format!("the variable `{name}`"),
                ParameterTarget::Parameters(all) => {
                    let full = |(node, name): &(String, String)| {
                        format!("{}.{name}", node.trim_start_matches('/'))
                    };
                    all.iter().map(full).collect::<Vec<_>>().join(", ")
                }
            };
            terminal::say(&format!("{name} sets {sets}"));
        }
        let (runs, seeds) = (plan.jobs.len(), self.seeds);
        terminal::say(&format!(
            "{runs} runs: {} points, {seeds} seeds each",
            runs / seeds as usize
        ));
    }

    fn write_script(
        &self,
        script: &Path,
        plan: &SweepPlan,
        plan_file: &Path,
    ) -> Result<ExitCode, CliError> {
        let program = own_command();
        if program.is_empty() {
            return Err(CliError::failed("the path of this program is unknown"));
        }
        let options: &[&str] = if self.no_artifacts { &["--no-artifacts"] } else { &[] };
        let plan_file = terminal::working_folder().join(plan_file);
        let text = slurm_script(&plan.name, program, &plan_file, options, plan.jobs.len());
        files::write(script, text.as_bytes())?;
        if !self.is_silent() {
            let path = script.display();
            terminal::say(&format!(
                "submit {path} with sbatch; then the same command with --collect"
            ));
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Runs jobs in processes of this machine.
    fn run_here(
        &self,
        plan_file: &Path,
        missing: &[usize],
        failures: &mut [Option<String>],
        stop: &AtomicBool,
    ) -> Result<(), CliError> {
        let [program, words @ ..] = own_command() else {
            return Err(CliError::failed("the path of this program is unknown"));
        };
        let command = |index: usize| {
            let mut command = Command::new(program);
            command.args(words).arg(JOB_VERB).arg(plan_file).arg(index.to_string());
            if self.no_artifacts {
                command.arg(job::NO_ARTIFACTS);
            }
            command
        };
        let bar = terminal::bar(missing.len() as u64, "runs", self.is_silent());
        let workers = self.workers.map_or_else(terminal::processors, |it| it as usize);
        LocalPool { workers, stop }.run(missing, command, |end| {
            failures[end.index] = end.outcome.err();
            bar.inc(1);
        });
        bar.finish_and_clear();
        Ok(())
    }
}

fn failed(error: SweepError) -> CliError {
    match error {
        SweepError::Findings(error) => {
            let mut err = anstream::stderr().lock();
            match terminal::diagnostics(&mut err, &error.diagnostics, &error.sources) {
                Ok(()) => CliError::Reported(1),
                Err(error) => error.into(),
            }
        }
        SweepError::Scenario(error) => scenario::failed(error),
        SweepError::File(error) => error.into(),
        SweepError::Usage(message) => CliError::Usage(message),
        SweepError::Failed(message) => CliError::Failed(message),
    }
}
