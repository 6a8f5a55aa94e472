//! `periplus node`.

use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::node;

use super::common::Common;
use super::with_session;

use crate::error::CliError;

/// List nodes, as `ros2 node` does
#[derive(Debug, Args)]
pub(crate) struct NodeOptions {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Show topics, services and actions of a node
    Info {
        node_name: String,
        /// Include hidden topics, services and actions
        #[arg(long)]
        include_hidden: bool,
        #[command(flatten)]
        common: Common,
    },
    /// List nodes
    List {
        /// Include hidden ones
        #[arg(long, short = 'a')]
        all: bool,
        /// Print only the count
        #[arg(long, short = 'c', alias = "count")]
        count_nodes: bool,
        #[command(flatten)]
        common: Common,
    },
}

impl NodeOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        match &self.verb {
            Verb::Info { node_name, include_hidden, common } => {
                with_session(common, |session| node::info(session, node_name, *include_hidden))
            }
            Verb::List { all, count_nodes, common } => {
                with_session(common, |session| node::list(session, *all, *count_nodes))
            }
        }
    }
}
