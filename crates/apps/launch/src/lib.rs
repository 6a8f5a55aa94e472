//! Launch files of ROS 1 and ROS 2 as plans: nodes and programs with their parameters, names and
//! environment, after conditions and includes are evaluated.
//!
//! A plan is data. Files in Python are evaluated by an [`Interpreter`] of the caller, which has the
//! modules of [`MODULES`]. The module `bringup` executes a plan; without the feature of that name
//! the crate only makes plans, and needs neither a simulation nor a graph.

#[cfg(feature = "bringup")]
pub mod bringup;
mod context;
mod dialect;
mod ending;
mod evaluate;
mod front;
mod modules;
mod outside;
mod perform;
mod plan;
mod python;
mod rewrite;
mod roslaunch;
mod stand_in;
mod suggest;
mod tree;
mod truth;
mod words;

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_resources::{Host, Resolver};

use crate::suggest::Suggest as _;
pub use dialect::{Dialect, dialect};
pub use ending::ShutdownHandlers;
pub use outside::{
    Answer, Interpreter, LaunchError, MissingInput, Nothing, Outside, OutsideError, Printed,
};
pub use plan::{
    Argument, Component, Identity, LaunchPlan, PlanNode, PlanParameters, PlanStep, PlanVariable,
    Process, Running, Trigger, What,
};
pub use stand_in::{BOOT, MAX_MEMORY_BYTES, MODULES};

/// Launch file with its arguments and environment.
pub struct Request<'a> {
    /// Absolute path of the file.
    pub file: PathBuf,
    /// `name:=value` of the command line.
    pub arguments: Vec<(String, String)>,
    /// Files and environment.
    pub host: &'a dyn Host,
    /// Packages.
    pub resolver: &'a Resolver<'a>,
    /// Programs.
    pub outside: &'a mut dyn Outside,
}

/// Evaluates a launch file into a plan. On an error the plan is complete up to that point.
pub fn plan(request: Request<'_>, sources: &mut SourceMap) -> (LaunchPlan, Diagnostics) {
    let (plan, found, _) = plan_with_ending(request, sources);
    (plan, found)
}

/// Evaluates a launch file that is to run, with the functions to call at shutdown.
pub fn plan_with_ending(
    request: Request<'_>,
    sources: &mut SourceMap,
) -> (LaunchPlan, Diagnostics, ShutdownHandlers) {
    let Request { file, arguments, host, resolver, outside } = request;
    let mut evaluation = evaluate::Evaluation::new(host, resolver, outside, sources);
    let dialect = dialect(host, &file);
    evaluation.context.usual = context::usual(dialect, &file);
    evaluation.context.command_line =
        arguments.iter().map(|(name, value)| format!("{name}:={value}")).collect();
    let outcome = match dialect {
        Dialect::Ros1 => roslaunch::launch(&mut evaluation, &file, &arguments),
        Dialect::Ros2 => {
            evaluation.context.configurations = arguments.iter().cloned().collect();
            evaluation.launch(&file, &arguments).and_then(|()| evaluation.events())
        }
    };
    if let Err(wrong) = outcome {
        evaluation.found.push(*wrong);
    }
    unused(&mut evaluation, &arguments, &file);
    let ending = evaluation.ending();
    (evaluation.plan, evaluation.found, ending)
}

/// Reports command-line arguments that no file declares, which could be typing errors.
fn unused(evaluation: &mut evaluate::Evaluation<'_>, given: &[(String, String)], file: &Path) {
    if evaluation.found.has_errors() {
        return;
    }
    for (name, _) in given {
        let known: Vec<&str> =
            evaluation.plan.arguments.iter().map(|argument| argument.name.as_str()).collect();
        if !known.contains(&name.as_str()) {
            let finding = periplus_diagnostics::Diagnostic::warning(
                "launch-argument",
                format!("{} has no argument `{name}`", file.display()),
            )
            .suggest(name, known)
            .help("`--show-args` lists its arguments");
            evaluation.found.push(finding);
        }
    }
}
