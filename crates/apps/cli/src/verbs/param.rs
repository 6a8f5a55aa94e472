//! `periplus param`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::param::{self, ParamListOptions};

use super::common::Common;
use super::with_session;
use crate::error::CliError;
use crate::{paths, terminal};

/// List, get and set parameters, as `ros2 param` does
#[derive(Debug, Args)]
pub(crate) struct ParamOptions {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Delete a parameter of a node
    Delete {
        node_name: String,
        name: String,
        #[command(flatten)]
        common: Common,
    },
    /// Describe parameters: purpose, type and range
    Describe {
        node_name: String,
        #[arg(required = true)]
        parameter_names: Vec<String>,
        #[command(flatten)]
        common: Common,
    },
    /// Print all parameters of a node, as a file for `--params-file`
    Dump {
        node_name: String,
        #[command(flatten)]
        common: Common,
    },
    /// Print the value of a parameter
    Get {
        node_name: String,
        parameter_name: String,
        /// Print only the value
        #[arg(long)]
        hide_type: bool,
        #[command(flatten)]
        common: Common,
    },
    /// List the parameters of a node, or of all nodes
    List {
        node_name: Option<String>,
        /// Include hidden nodes
        #[arg(long)]
        include_hidden_nodes: bool,
        /// Include only parameters with this prefix
        #[arg(long, num_args = 1.., value_name = "PREFIX")]
        param_prefixes: Vec<String>,
        /// Show types
        #[arg(long)]
        param_type: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Load the parameters of a file into a node
    Load {
        node_name: String,
        parameter_file: PathBuf,
        /// Ignore the wildcard section of the file
        #[arg(long)]
        no_use_wildcard: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Set a parameter; the value is YAML
    Set {
        node_name: String,
        parameter_name: String,
        #[arg(allow_hyphen_values = true)]
        value: String,
        #[command(flatten)]
        common: Common,
    },
}

impl ParamOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        match &self.verb {
            Verb::Delete { node_name, name, common } => {
                with_session(common, |session| param::delete(session, node_name, name))
            }
            Verb::Describe { node_name, parameter_names, common } => {
                with_session(common, |session| param::describe(session, node_name, parameter_names))
            }
            Verb::Dump { node_name, common } => {
                with_session(common, |session| param::dump(session, node_name))
            }
            Verb::Get { node_name, parameter_name, hide_type, common } => {
                with_session(common, |session| {
                    param::get(session, node_name, parameter_name, *hide_type)
                })
            }
            Verb::List { node_name, include_hidden_nodes, param_prefixes, param_type, common } => {
                let options = ParamListOptions {
                    node: node_name.clone(),
                    include_hidden: *include_hidden_nodes,
                    prefixes: param_prefixes.clone(),
                    show_types: *param_type,
                };
                with_session(common, |session| param::list(session, &options))
            }
            Verb::Load { node_name, parameter_file, no_use_wildcard, common } => {
                let file = terminal::working_folder().join(parameter_file);
                let text = paths::text(&file).map_err(CliError::failed)?;
                with_session(common, |session| {
                    param::load(session, node_name, parameter_file, &text, !no_use_wildcard)
                })
            }
            Verb::Set { node_name, parameter_name, value, common } => {
                with_session(common, |session| {
                    param::set(session, node_name, parameter_name, value)
                })
            }
        }
    }
}
