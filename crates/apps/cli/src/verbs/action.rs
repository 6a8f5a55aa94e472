//! `periplus action`.

use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::action;

use super::common::Common;
use super::service::read_stdin;
use super::with_session;

use crate::error::CliError;

/// List actions and send goals, as `ros2 action` does
#[derive(Debug, Args)]
pub(crate) struct ActionOptions {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// List the actions of a type
    Find {
        action_type: String,
        /// Print only the count
        #[arg(long, short = 'c', alias = "count")]
        count_actions: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Show servers and clients of an action
    Info {
        action_name: String,
        /// Show types
        #[arg(long, short = 't')]
        show_types: bool,
        /// Print only the count
        #[arg(long, short = 'c')]
        count: bool,
        #[command(flatten)]
        common: Common,
    },
    /// List actions
    List {
        /// Show types
        #[arg(long, short = 't')]
        show_types: bool,
        /// Print only the count
        #[arg(long, short = 'c', alias = "count")]
        count_actions: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Send a goal and wait for its result; Ctrl-C cancels it
    #[command(name = "send_goal", alias = "send-goal")]
    SendGoal {
        action_name: String,
        action_type: String,
        /// Goal, as YAML; missing fields have their defaults
        #[arg(default_value = "{}")]
        goal: String,
        /// Read the goal from standard input
        #[arg(long, conflicts_with = "goal")]
        stdin: bool,
        /// Print feedback
        #[arg(long, short = 'f')]
        feedback: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Print the type of an action
    Type {
        action_name: String,
        #[command(flatten)]
        common: Common,
    },
}

impl ActionOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        match &self.verb {
            Verb::Find { action_type, count_actions, common } => {
                with_session(common, |session| action::find(session, action_type, *count_actions))
            }
            Verb::Info { action_name, show_types, count, common } => {
                with_session(common, |session| {
                    action::info(session, action_name, *show_types, *count)
                })
            }
            Verb::List { show_types, count_actions, common } => {
                with_session(common, |session| action::list(session, *show_types, *count_actions))
            }
            Verb::SendGoal { action_name, action_type, goal, stdin, feedback, common } => {
                let goal = if *stdin { read_stdin()? } else { goal.clone() };
                with_session(common, |session| {
                    action::send_goal(session, action_name, action_type, &goal, *feedback)
                })
            }
            Verb::Type { action_name, common } => {
                with_session(common, |session| action::type_of(session, action_name))
            }
        }
    }
}
