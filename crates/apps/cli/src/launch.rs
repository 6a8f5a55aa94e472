//! `periplus launch`.

mod named;
mod outside;
mod play;
mod python;
mod show;
mod tools;

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;
use periplus_diagnostics::{DiagnosticCause, Diagnostics, Severity, SourceMap};
use periplus_launch::{
    LaunchPlan, MissingInput, PlanStep, Request, ShutdownHandlers, What, dialect, plan_with_ending,
};
use periplus_os::{Machine, Stopwatch};
use periplus_resources::Resolver;

use self::named::Found;
use self::tools::Tools;
pub(crate) use self::tools::{XACRO_VERB, run_xacro};
use crate::arguments;
use crate::error::CliError;
use crate::options::{SearchOptions, split};
use crate::run_options::positive;
use crate::terminal::{self, working_folder};

/// Run a launch file of ROS 1 or ROS 2
///
/// Runs XML of roslaunch, and XML, YAML and Python of ROS 2, without a ROS installation; Python files are
/// evaluated by the python3 on the PATH. Gazebo becomes the simulation, and known nodes become built-in
/// ones; your own nodes in Python run from their sources, without a build. Other programs run if they are
/// installed, and missing ones are reported. With `--duration` it runs as fast as possible, and the same
/// files, options and seed give the same bag, byte for byte; without it at the world's real-time factor
/// until Ctrl-C, on ROS 2 on this machine.
#[derive(Debug, Args)]
pub(crate) struct LaunchOptions {
    /// Launch file, or a package and the name of a launch file in it; then `name:=value`
    #[arg(required = true, value_name = "PACKAGE FILE|FILE|NAME:=VALUE")]
    words: Vec<String>,
    /// List the arguments of the file without starting anything
    #[arg(short, long, visible_alias = "show-arguments")]
    show_args: bool,
    /// Print the plan as JSON without starting anything
    #[arg(short, long, conflicts_with = "show_args")]
    print: bool,
    /// Print what each node and program of the file becomes without starting anything
    #[arg(long, conflicts_with_all = ["show_args", "print"])]
    dry_run: bool,
    /// Run no code of the launch file: no Python, and no program that it calls; xacro is built in
    #[arg(long)]
    no_code: bool,
    /// Time limit of Python and of each program while the launch file is evaluated [s]
    #[arg(long, value_name = "SECONDS", value_parser = positive, default_value = "60")]
    evaluation_limit: f64,
    #[command(flatten)]
    play: play::PlayOptions,
    #[command(flatten)]
    search: SearchOptions,
}

/// Runs a launch file; `recorded` is the command for its recording.
pub(crate) fn run(
    options: &LaunchOptions,
    ros: Vec<String>,
    recorded: String,
) -> Result<ExitCode, CliError> {
    let start = Stopwatch::start();
    let to_nodes = arguments::read(ros)?;
    let (words, arguments) = split(&options.words);
    let host = Machine;
    let here = working_folder();
    let folders: Vec<PathBuf> =
        options.search.resource_path.iter().map(|folder| here.join(folder)).collect();
    let resolver = Resolver::new(&host, &folders);
    let mut sources = SourceMap::new();
    // Generated files exist as long as the run.
    let limits = options.limits();
    let tools = limits.runs_code.then(|| Tools::make(&options.search.resource_path)).flatten();
    let mut outside = outside::Programs::new(&resolver, &here, limits, tools.as_ref());
    let evaluated = match named::file(&words, &resolver, &here) {
        Ok(Found::File(file)) => {
            let request = Request {
                file: file.clone(),
                arguments,
                host: &host,
                resolver: &resolver,
                outside: &mut outside,
            };
            let (plan, findings, ending) = plan_with_ending(request, &mut sources);
            Evaluated { plan, findings, ending, file }
        }
        Ok(Found::Replacement(file)) => Evaluated {
            plan: only(&file, arguments),
            findings: Diagnostics::new(),
            ending: ShutdownHandlers::default(),
            file: PathBuf::from(file),
        },
        Err(wrong) => {
            let mut findings = Diagnostics::new();
            findings.push(*wrong);
            terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &sources)?;
            return Ok(ExitCode::FAILURE);
        }
    };
    options.print_findings(&evaluated.findings, &sources)?;
    if let Some(code) = options.show(&evaluated)? {
        return Ok(code);
    }
    let Evaluated { plan, ending, file, .. } = evaluated;
    let launched = play::Launched {
        plan,
        dialect: dialect(&host, &file),
        arguments: to_nodes,
        tools: tools.as_ref().map(|tools| tools.folder().to_owned()),
        start,
        recorded,
    };
    if options.dry_run {
        return play::preview(&launched, &options.play, &options.search);
    }
    let outcome = play::play(launched, &options.play, &options.search);
    shut_down(ending);
    outcome
}

/// Launch file after its evaluation.
struct Evaluated {
    plan: LaunchPlan,
    findings: Diagnostics,
    ending: ShutdownHandlers,
    file: PathBuf,
}

impl LaunchOptions {
    fn limits(&self) -> outside::Limits {
        outside::Limits {
            is_kept: self.print,
            runs_code: !self.no_code,
            longest: Duration::from_secs_f64(self.evaluation_limit.min(MAX_EVALUATION_S)),
        }
    }

    /// Returns true if the plan or its arguments are printed and nothing starts.
    fn is_read_only(&self) -> bool {
        self.print || self.show_args || self.dry_run
    }

    /// Prints the findings of the evaluation. Missing packages matter when a plan is printed; a
    /// run reports them for each node.
    fn print_findings(&self, findings: &Diagnostics, sources: &SourceMap) -> Result<(), CliError> {
        let is_read_only = self.is_read_only();
        let mut printed = Diagnostics::new();
        for finding in findings.iter().filter(|one| is_read_only || one.severity != Severity::Hint)
        {
            let mut finding = finding.clone();
            if !is_read_only && MissingInput::of(&finding).is_some() {
                finding.severity = Severity::Error;
            }
            printed.push(finding);
        }
        if !self.play.quiet || printed.has_errors() {
            terminal::diagnostics(&mut anstream::stderr().lock(), &printed, sources)?;
        }
        Ok(())
    }

    /// Prints the arguments or the plan, if requested. Returns the exit code of the command if
    /// nothing is to be started.
    ///
    /// # Errors
    /// When inputs of the launch are missing on this machine, or a write fails.
    fn show(&self, evaluated: &Evaluated) -> Result<Option<ExitCode>, CliError> {
        let Evaluated { plan, findings, .. } = evaluated;
        let mut out = anstream::AutoStream::auto(io::stdout().lock());
        if self.show_args {
            // A launch file with missing arguments has findings only up to that point.
            show::arguments(&mut out, plan)?;
            let is_complete = findings.iter().all(|finding| {
                finding.cause == Some(DiagnosticCause::MissingArgument)
                    || finding.severity != Severity::Error
            });
            return Ok(Some(if is_complete { ExitCode::SUCCESS } else { ExitCode::FAILURE }));
        }
        if findings.has_errors() {
            return Ok(Some(ExitCode::FAILURE));
        }
        if self.print {
            print(&mut out, plan)?;
            return Ok(Some(ExitCode::SUCCESS));
        }
        if self.dry_run {
            return Ok(None);
        }
        match missing_inputs(findings) {
            0 => Ok(None),
            // As with ROS: without its description or parameters a robot or node would run in a
            // different configuration than intended.
            missing => Err(CliError::failed(format!(
                "the launch was not started: {missing} of its inputs {} not on this machine; \
                 `--print` shows the plan without {}",
                if missing == 1 { "is" } else { "are" },
                if missing == 1 { "it" } else { "them" },
            ))),
        }
    }
}

/// Calls the shutdown handlers of the launch file and prints their errors.
fn shut_down(ending: ShutdownHandlers) {
    for error in ending.run() {
        let line = error.line.map(|line| format!("{line}: ")).unwrap_or_default();
        terminal::complain(&format!("error at shutdown of the launch: {line}{}", error.message));
    }
}

/// Number of missing inputs of a plan.
fn missing_inputs(found: &Diagnostics) -> usize {
    found.iter().filter(|finding| MissingInput::of(finding).is_some()).count()
}

/// Findings of planning a launch file; starts nothing.
pub(crate) fn examine(
    file: &Path,
    arguments: Vec<(String, String)>,
    resource_path: &[PathBuf],
) -> (Diagnostics, SourceMap) {
    let (host, here) = (Machine, working_folder());
    let folders: Vec<PathBuf> = resource_path.iter().map(|folder| here.join(folder)).collect();
    let resolver = Resolver::new(&host, &folders);
    let mut sources = SourceMap::new();
    let tools = Tools::make(resource_path);
    let limits = outside::Limits::EXAMINED;
    let mut outside = outside::Programs::new(&resolver, &here, limits, tools.as_ref());
    let found = match named::file(&[file.to_owned()], &resolver, &here) {
        Ok(Found::File(file)) => {
            let request = Request {
                file,
                arguments,
                host: &host,
                resolver: &resolver,
                outside: &mut outside,
            };
            strict(periplus_launch::plan(request, &mut sources).1)
        }
        Ok(Found::Replacement(_)) => Diagnostics::new(),
        Err(wrong) => {
            let mut found = Diagnostics::new();
            found.push(*wrong);
            found
        }
    };
    (found, sources)
}

/// Raises a missing file to an error: its package exists, so the path is wrong or the file has to
/// be built.
fn strict(found: Diagnostics) -> Diagnostics {
    let mut strict = Diagnostics::new();
    for finding in found.iter() {
        let mut finding = finding.clone();
        if MissingInput::of(&finding) == Some(MissingInput::File) {
            finding.severity = Severity::Error;
        }
        strict.push(finding);
    }
    strict
}

/// Upper limit of `--evaluation-limit`, one day.
const MAX_EVALUATION_S: f64 = 86_400.0;

/// Plan that includes one launch file that is missing here.
fn only(file: &str, arguments: Vec<(String, String)>) -> LaunchPlan {
    let what = What::Include { file: file.to_owned(), arguments: arguments.into_iter().collect() };
    LaunchPlan {
        steps: vec![PlanStep {
            id: 0,
            after: Vec::new(),
            what,
            written: None,
            environment: std::collections::BTreeMap::new(),
        }],
        ..LaunchPlan::default()
    }
}

fn print(out: &mut dyn io::Write, plan: &LaunchPlan) -> io::Result<()> {
    let text = serde_json::to_string_pretty(plan).map_err(io::Error::other)?;
    writeln!(out, "{text}")
}
