//! `periplus interface`.

use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::interface::{self, Comments};
use periplus_rosidl::InterfaceKind;

use super::common::Common;
use super::without_network;

use crate::error::CliError;

/// Show types of messages, services and actions, as `ros2 interface` does
#[derive(Debug, Args)]
pub(crate) struct InterfaceOptions {
    #[command(subcommand)]
    verb: Verb,
}

/// Selected kinds; all if none is given.
#[derive(Clone, Debug, Args)]
struct Kinds {
    /// Show messages
    #[arg(long, short = 'm')]
    only_msgs: bool,
    /// Show services
    #[arg(long, short = 's')]
    only_srvs: bool,
    /// Show actions
    #[arg(long, short = 'a')]
    only_actions: bool,
}

impl Kinds {
    fn kinds(&self) -> Vec<InterfaceKind> {
        let wanted = [
            (self.only_msgs, InterfaceKind::Message),
            (self.only_srvs, InterfaceKind::Service),
            (self.only_actions, InterfaceKind::Action),
        ];
        wanted.into_iter().filter(|(is_wanted, _)| *is_wanted).map(|(_, kind)| kind).collect()
    }
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// List all types
    List {
        #[command(flatten)]
        kinds: Kinds,
        #[command(flatten)]
        common: InterfaceCommon,
    },
    /// List the types of a package
    Package {
        package_name: String,
        #[command(flatten)]
        common: InterfaceCommon,
    },
    /// List packages with types
    Packages {
        #[command(flatten)]
        kinds: Kinds,
        #[command(flatten)]
        common: InterfaceCommon,
    },
    /// Print a message with default values, to edit and publish
    Proto {
        r#type: String,
        /// Omit the quotes of strings
        #[arg(long)]
        no_quotes: bool,
        #[command(flatten)]
        common: InterfaceCommon,
    },
    /// Show the definition of a type
    Show {
        r#type: String,
        /// Show the comments of nested types too
        #[arg(long)]
        all_comments: bool,
        /// Omit comments
        #[arg(long, conflicts_with = "all_comments")]
        no_comments: bool,
        #[command(flatten)]
        common: InterfaceCommon,
    },
}

/// [`Common`] options that apply without a network.
#[derive(Clone, Debug, Args)]
struct InterfaceCommon {
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Folder of packages with .msg, .srv and .action files, in addition to AMENT_PREFIX_PATH;
    /// repeatable
    #[arg(long, value_name = "DIR")]
    interfaces: Vec<std::path::PathBuf>,
}

impl InterfaceCommon {
    fn common(&self) -> Common {
        Common { json: self.json, interfaces: self.interfaces.clone(), ..Common::default() }
    }
}

impl InterfaceOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        match &self.verb {
            Verb::List { kinds, common } => without_network(&common.common(), |session| {
                interface::list(session, &kinds.kinds())
            }),
            Verb::Package { package_name, common } => {
                without_network(&common.common(), |session| {
                    interface::package(session, package_name)
                })
            }
            Verb::Packages { kinds, common } => without_network(&common.common(), |session| {
                interface::packages(session, &kinds.kinds())
            }),
            Verb::Proto { r#type, no_quotes, common } => {
                without_network(&common.common(), |session| {
                    interface::proto(session, r#type, !no_quotes)
                })
            }
            Verb::Show { r#type, all_comments, no_comments, common } => {
                let comments = match (all_comments, no_comments) {
                    (true, _) => Comments::All,
                    (_, true) => Comments::None,
                    _ => Comments::Own,
                };
                without_network(&common.common(), |session| {
                    interface::show(session, r#type, comments)
                })
            }
        }
    }
}
