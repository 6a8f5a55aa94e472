//! Options of `periplus topic`, `node`, `service` and others, and their dispatch.

mod action;
mod common;
mod connection;
mod gazebo;
mod interface;
mod lifecycle;
mod node;
mod param;
mod ros1;
mod service;
mod tf;
mod topic;

use std::io::{self, Write as _};
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::Graph;
use periplus_loader::load_interfaces;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_ros2cli::{Failure, InGraph, Network, Outcome, Ros2Line, Session, Types};
use periplus_session::stop;

use crate::error::CliError;
use crate::foreign_commands;
use crate::terminal;

pub(crate) use action::ActionOptions;
pub(crate) use interface::InterfaceOptions;
pub(crate) use lifecycle::LifecycleOptions;
pub(crate) use node::NodeOptions;
pub(crate) use param::ParamOptions;
pub(crate) use service::ServiceOptions;
pub(crate) use tf::TfOptions;
pub(crate) use topic::TopicOptions;

pub(crate) use common::{Common, seconds};
use connection::NetworkConnection;
use ros1::Ros1Connection;

/// Joins the network and runs a verb.
pub(crate) fn with_session(
    common: &Common,
    verb: impl FnOnce(&mut Session<'_>) -> Outcome,
) -> Result<ExitCode, CliError> {
    let types = types(common)?;
    if common.network.is_ros1() {
        let mut connection = Ros1Connection::open().map_err(CliError::failed)?;
        let outcome = run_verb(&connection, &types, common, verb);
        tell(&connection.take_findings())?;
        return end(outcome);
    }
    let mut connection = NetworkConnection::open().map_err(CliError::failed)?;
    let outcome = run_verb(&connection, &types, common, verb);
    tell(&connection.take_findings())?;
    end(outcome)
}

fn run_verb(
    network: &dyn Network,
    types: &Types,
    common: &Common,
    verb: impl FnOnce(&mut Session<'_>) -> Outcome,
) -> Outcome {
    let stop = stop::on_signal();
    let mut out = io::BufWriter::new(io::stdout().lock());
    verb(&mut Session {
        network,
        types,
        out: &mut out,
        talk: &mut anstream::stderr(),
        stop: &stop,
        json: common.json,
        spin_time: common.spin_time.map(Duration::from_secs_f64),
    })
}

/// Built-in types and those of the user's packages; prints their findings.
fn types(common: &Common) -> io::Result<Types> {
    let has_prefix = Machine.variable("AMENT_PREFIX_PATH").is_some_and(|path| !path.is_empty());
    if common.interfaces.is_empty() && !has_prefix {
        return Ok(Types::Builtin);
    }
    let folder = terminal::working_folder();
    let folders = common.interfaces.iter().map(|path| folder.join(path));
    let loaded = load_interfaces(&Machine, &folders.collect::<Vec<_>>());
    terminal::diagnostics(&mut anstream::stderr().lock(), &loaded.diagnostics, &loaded.sources)?;
    Ok(Types::With(Box::new(loaded.types)))
}

/// Runs a verb that needs no network.
pub(crate) fn without_network(
    common: &Common,
    verb: impl FnOnce(&mut Session<'_>) -> Outcome,
) -> Result<ExitCode, CliError> {
    let types = types(common)?;
    let mut out = io::BufWriter::new(io::stdout().lock());
    let outcome = verb(&mut Session {
        network: &InGraph(Graph::new()),
        types: &types,
        out: &mut out,
        talk: &mut anstream::stderr(),
        stop: &AtomicBool::new(false),
        json: common.json,
        spin_time: None,
    });
    end(outcome)
}

/// Exit code of an outcome; prints its error.
fn end(outcome: Outcome) -> Result<ExitCode, CliError> {
    match outcome {
        Ok(()) => Ok(ExitCode::SUCCESS),
        Err(Failure::Output(error)) => Err(error.into()),
        // Scripts for ROS parse the output, not the exit code.
        Err(Failure::Refused(refusal)) if foreign_commands::is_ros2() => {
            match refusal.ros2 {
                Ros2Line::Nothing => {}
                Ros2Line::Stdout(line) => writeln!(io::stdout().lock(), "{line}")?,
                Ros2Line::Stderr(line) => terminal::say(&line),
            }
            Ok(ExitCode::SUCCESS)
        }
        Err(failure) => {
            if !matches!(failure, Failure::Interrupted) {
                terminal::complain(&failure.to_string());
            }
            Ok(ExitCode::from(failure.exit_code()))
        }
    }
}

fn tell(findings: &Diagnostics) -> io::Result<()> {
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())
}
