//! `periplus lifecycle`.

use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::lifecycle;

use super::common::Common;
use super::with_session;

use crate::error::CliError;

/// Manage lifecycle nodes, as `ros2 lifecycle` does
#[derive(Debug, Args)]
pub(crate) struct LifecycleOptions {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Print the state of a node, or of all lifecycle nodes
    Get {
        node_name: Option<String>,
        #[command(flatten)]
        common: Common,
    },
    /// List the transitions that are available to a node
    List {
        node_name: String,
        /// Show all transitions
        #[arg(long, short = 'a')]
        all: bool,
        #[command(flatten)]
        common: Common,
    },
    /// List lifecycle nodes
    Nodes {
        /// Include hidden ones
        #[arg(long, short = 'a')]
        all: bool,
        /// Print only the count
        #[arg(long, short = 'c', alias = "count")]
        count_nodes: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Trigger a transition of a node, by name or number
    Set {
        node_name: String,
        transition: String,
        #[command(flatten)]
        common: Common,
    },
}

impl LifecycleOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        match &self.verb {
            Verb::Get { node_name, common } => {
                with_session(common, |session| lifecycle::get(session, node_name.as_deref()))
            }
            Verb::List { node_name, all, common } => {
                with_session(common, |session| lifecycle::list(session, node_name, *all))
            }
            Verb::Nodes { all, count_nodes, common } => {
                with_session(common, |session| lifecycle::nodes(session, *all, *count_nodes))
            }
            Verb::Set { node_name, transition, common } => {
                with_session(common, |session| lifecycle::set(session, node_name, transition))
            }
        }
    }
}
