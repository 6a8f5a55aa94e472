//! `periplus ros1`: the master of ROS 1, its parameters and its nodes.

mod call;
mod master;
mod node;
mod param;
mod yaml;

use std::process::ExitCode;

use clap::Subcommand;
use periplus_os::Machine;
use periplus_ros1::{MasterClient, Ros1Error, Ros1Reach, RpcError, Settings};

use crate::error::CliError;
use crate::terminal;

/// Name under which a command calls the master.
const CALLER: &str = "/periplus_cli";

/// Run a master of ROS 1, and use the parameters and nodes of one
///
/// The master is the one at ROS_MASTER_URI, by default http://localhost:11311. Topics and services of ROS 1 are those
/// of `periplus topic --ros1` and `periplus service --ros1`. `roscore`, `rosparam` and `rosnode` behind `periplus` are
/// these commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Ros1Command {
    Master(master::MasterOptions),
    Call(call::CallOptions),
    #[command(subcommand)]
    Param(param::ParamCommand),
    #[command(subcommand)]
    Node(node::NodeCommand),
}

pub(crate) fn run(command: &Ros1Command) -> Result<ExitCode, CliError> {
    match command {
        Ros1Command::Master(options) => master::run(options),
        Ros1Command::Call(options) => call::run(options),
        Ros1Command::Param(command) => param::run(command),
        Ros1Command::Node(command) => node::run(command),
    }
}

/// Client of the master that the environment names.
fn client() -> Result<MasterClient, CliError> {
    let (settings, findings) = Settings::from_environment(&Machine, Ros1Reach::Machine);
    terminal::print_findings(&findings)?;
    settings.master().map_err(CliError::failed)?;
    Ok(MasterClient::new(&settings.master_uri, CALLER))
}

/// Full name of a node, parameter or service.
fn full(name: &str) -> String {
    if name.starts_with('/') { name.to_owned() } else { format!("/{name}") }
}

/// Error of a call to the master.
fn failed(client: &MasterClient, error: RpcError) -> CliError {
    match error {
        RpcError::Refused(why) => CliError::failed(why),
        why => CliError::failed(Ros1Error::Master { uri: client.uri().to_owned(), why }),
    }
}
