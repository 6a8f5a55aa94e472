//! The `periplus` command as a library: [`run`] is the whole program, which the binary and the Python package
//! start.

mod arguments;
mod bag;
mod bridge;
mod calibrate;
mod check;
mod compare;
mod conformance;
mod convert;
mod costmap;
mod dataset;
mod demo;
mod doctor;
mod error;
pub mod files;
mod foreign_commands;
mod help;
mod launch;
mod localize;
mod log;
mod look;
mod map;
mod mapping;
mod mcp;
mod navigate;
mod new;
mod offered_qos;
mod options;
mod own_command;
mod page;
mod paths;
mod program;
mod recorded_command;
mod report;
mod rerun;
mod ros1;
mod run_options;
mod scenario;
mod schema;
mod score;
mod sim;
mod slam;
mod sweep;
mod teleop;
mod terminal;
mod verbs;
mod view;

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use periplus_diagnostics::plain_words;
use periplus_graph::split_arguments;
use periplus_launch::bringup::{GUARD_VERB, guard};
use periplus_session::stop;
use periplus_sim::Composition;

use demo::DemoOptions;
use options::Command;

use crate::error::CliError;
use crate::recorded_command::recorded_command;

pub use report::{ReportError, report_html};

/// Prints the completion script in one write, so that a closed pipe is an error that [`run`] handles.
fn completions(shell: clap_complete::Shell) -> Result<ExitCode, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut help::command(), "periplus", &mut script);
    std::io::stdout().lock().write_all(&script)?;
    Ok(ExitCode::SUCCESS)
}

/// Prints the manual page of the program, or writes those of all its commands to a folder.
fn manual(folder: Option<&Path>) -> Result<ExitCode, CliError> {
    let command = help::command();
    if let Some(folder) = folder {
        paths::make_folder(folder)?;
        clap_mangen::generate_to(command, folder).map_err(|error| {
            format!("cannot write to {}: {}", folder.display(), plain_words(&error))
        })?;
        terminal::say(&format!(
            "the manual pages are in {}: `man -l {}`",
            folder.display(),
            folder.join("periplus.1").display()
        ));
        return Ok(ExitCode::SUCCESS);
    }
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page)?;
    std::io::stdout().lock().write_all(&page)?;
    Ok(ExitCode::SUCCESS)
}

/// World of the demo with its robot, which are part of the program.
#[must_use]
pub fn demo_composition() -> Composition {
    demo::composition()
}

/// Runs the command `words`, whose first is the name of the program. `own_command` starts this program in
/// another process, such as `/usr/bin/periplus` or `python3 -m periplus`; without it the programs of a
/// launch file have no guard and no `xacro`. `interpreter` is the Python in which this program runs, if any;
/// it also runs users' own nodes.
#[must_use]
pub fn run(words: Vec<String>, own_command: Vec<String>, interpreter: Option<String>) -> ExitCode {
    own_command::set_own_command(own_command);
    own_command::set_interpreter(interpreter);
    if words.get(1).is_some_and(|word| word == GUARD_VERB) {
        guard(std::io::stdin().lock());
        return ExitCode::SUCCESS;
    }
    if words.get(1).is_some_and(|word| word == launch::XACRO_VERB) {
        return ended(launch::run_xacro(words.get(2..).unwrap_or_default()));
    }
    if words.get(1).is_some_and(|word| word == sweep::JOB_VERB) {
        return ended(sweep::run_jobs(words.get(2..).unwrap_or_default()));
    }
    let words = match foreign_commands::translate(words) {
        Ok(Ok(words)) => words,
        Ok(Err(code)) => return code,
        Err(error) => return ended(Err(error.into())),
    };
    let recorded = recorded_command(&words);
    let (words, ros) = split_arguments(words);
    let options = match help::parse(words) {
        Ok(options) => options,
        Err(code) => return code,
    };
    options.colour.apply();
    let command = options.command.unwrap_or_else(|| Command::Demo(DemoOptions::default()));
    let outcome = match command {
        Command::Sim(options) => sim::run(&options, ros, recorded),
        Command::Launch(options) => launch::run(&options, ros, recorded),
        Command::Teleop(options) => teleop::run(&options, ros),
        Command::View(options) => view::run(&options, ros),
        Command::Localize(options) => localize::run(&options, ros),
        Command::Navigate(options) => navigate::run(&options, ros),
        Command::Map(command) => map::run(&command, ros),
        Command::Slam(options) => slam::run(&options, ros),
        Command::Costmap(options) => costmap::serve::run(&options, ros),
        Command::Run(options) => program::run(&options, ros),
        Command::Bridge(options) => bridge::run(&options, ros),
        _ if !ros.is_empty() => Err(CliError::usage(
            "`--ros-args` require a command that runs nodes: `periplus sim`, `launch`, `navigate`, `localize`, `teleop`, \
             `view`, `map`, `costmap` and `slam --live`",
        )),
        Command::Bag(command) => bag::run(&command),
        Command::Ros1(command) => ros1::run(&command),
        Command::Calibrate(options) => calibrate::run(&options),
        Command::Check(options) => check::run(&options),
        Command::Compare(options) => compare::run(&options),
        Command::Report(options) => report::run(&options),
        Command::Rerun(options) => rerun::run(&options),
        Command::Score(options) => score::run(&options),
        Command::Conformance(options) => conformance::run(&options),
        Command::Dataset(options) => dataset::run(&options),
        Command::Demo(options) => demo::run(&options),
        Command::Look(options) => look::run(&options),
        Command::Mcp(options) => mcp::run(&options),
        Command::Schema(options) => schema::run(&options),
        Command::Convert(options) => convert::run(&options),
        Command::Doctor(options) => doctor::run(&options),
        Command::New(command) => new::run(&command),
        Command::Scenario(options) => scenario::run(&options),
        Command::Sweep(options) => sweep::run(&options),
        Command::Action(options) => options.run(),
        Command::Interface(options) => options.run(),
        Command::Lifecycle(options) => options.run(),
        Command::Node(options) => options.run(),
        Command::Param(options) => options.run(),
        Command::Service(options) => options.run(),
        Command::Tf(options) => options.run(),
        Command::Topic(options) => options.run(),
        Command::Completions { shell } => completions(shell),
        Command::Man { folder } => manual(folder.as_deref()),
    };
    ended(outcome)
}

/// Exit code of a command; prints its error.
fn ended(outcome: Result<ExitCode, CliError>) -> ExitCode {
    match outcome {
        // A failure takes precedence over the signal that ended the run.
        Ok(code) if code == ExitCode::FAILURE => code,
        Ok(code) => stop::exit_code().map_or(code, ExitCode::from),
        Err(error) => error.report(),
    }
}
