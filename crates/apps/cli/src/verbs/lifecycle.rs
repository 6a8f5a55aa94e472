//! `periplus lifecycle`.

use std::io;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::lifecycle;

use super::common::Common;
use super::with_session;

/// Lead managed nodes through their lives, as `ros2 lifecycle` does
#[derive(Debug, Args)]
pub(crate) struct LifecycleOptions {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// The state of a node, or of all managed nodes
    Get {
        node_name: Option<String>,
        #[command(flatten)]
        common: Common,
    },
    /// The transitions that a node can make now
    List {
        node_name: String,
        /// All of its life
        #[arg(long, short = 'a')]
        all: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Which nodes are managed
    Nodes {
        /// Hidden ones as well
        #[arg(long, short = 'a')]
        all: bool,
        /// Only say how many there are
        #[arg(long, short = 'c', alias = "count")]
        count_nodes: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Let a node make a transition, by name or number
    Set {
        node_name: String,
        transition: String,
        #[command(flatten)]
        common: Common,
    },
}

impl LifecycleOptions {
    pub(crate) fn run(&self) -> io::Result<ExitCode> {
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
