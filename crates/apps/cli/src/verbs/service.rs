//! `periplus service`.

use std::io::{self, Read as _};
use std::process::ExitCode;

use clap::{Args, Subcommand};
use periplus_ros2cli::service;
use periplus_ros2cli::topic::{self, TopicEchoOptions};

use super::common::{Common, rate};
use super::{gazebo, with_session};

use crate::error::CliError;

/// List and call services, as `ros2 service` does
#[derive(Debug, Args)]
pub(crate) struct ServiceOptions {
    /// Include hidden services: those with a part that begins with `_`
    #[arg(long)]
    include_hidden_services: bool,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Call a service
    ///
    /// Values are YAML, such as `{data: true}`.
    Call {
        service_name: String,
        service_type: String,
        /// Request, as YAML; missing fields have their defaults
        #[arg(default_value = "{}")]
        values: String,
        /// Read the values from standard input
        #[arg(long, conflicts_with = "values")]
        stdin: bool,
        /// Repeat the call at this rate [Hz]
        #[arg(long, short = 'r', value_name = "HZ", value_parser = rate)]
        rate: Option<f64>,
        #[command(flatten)]
        common: Common,
    },
    /// Print requests and responses of a service with introspection enabled
    Echo {
        service_name: String,
        #[command(flatten)]
        common: Common,
    },
    /// List the services of a type
    Find {
        service_type: String,
        /// Print only the count
        #[arg(long, short = 'c', alias = "count")]
        count_services: bool,
        /// Include hidden ones
        #[arg(long)]
        include_hidden_services: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Print the number of servers and clients of a service
    Info {
        service_name: String,
        /// Show their names
        #[arg(long, short = 'v')]
        verbose: bool,
        #[command(flatten)]
        common: Common,
    },
    /// List services
    List {
        /// Show types
        #[arg(long, short = 't')]
        show_types: bool,
        /// Print only the count
        #[arg(long, short = 'c', alias = "count")]
        count_services: bool,
        /// Include hidden ones
        #[arg(long)]
        include_hidden_services: bool,
        /// List the services of Gazebo Transport instead of those of ROS 2
        #[arg(long)]
        gz: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Print the type of a service
    Type {
        service_name: String,
        #[command(flatten)]
        common: Common,
    },
}

impl ServiceOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        let all = self.include_hidden_services;
        match &self.verb {
            Verb::Call { service_name, service_type, values, stdin, rate, common } => {
                let values = if *stdin { read_stdin()? } else { values.clone() };
                with_session(common, |session| {
                    service::call(session, service_name, service_type, &values, *rate)
                })
            }
            Verb::Echo { service_name, common } => with_session(common, |session| {
                let topic = format!("{}/_service_event", service_name.trim_end_matches('/'));
                topic::echo(session, &topic, &TopicEchoOptions::default())
            }),
            Verb::Find { service_type, count_services, include_hidden_services, common } => {
                let hidden = all || *include_hidden_services;
                with_session(common, |session| {
                    service::find(session, service_type, *count_services, hidden)
                })
            }
            Verb::Info { service_name, verbose, common } => {
                with_session(common, |session| service::info(session, service_name, *verbose))
            }
            Verb::List { show_types, count_services, gz: true, common, .. } => {
                gazebo::services(common, *show_types, *count_services)
            }
            Verb::List { show_types, count_services, include_hidden_services, common, .. } => {
                let hidden = all || *include_hidden_services;
                with_session(common, |session| {
                    service::list(session, *show_types, *count_services, hidden)
                })
            }
            Verb::Type { service_name, common } => {
                with_session(common, |session| service::type_of(session, service_name))
            }
        }
    }
}

pub(super) fn read_stdin() -> io::Result<String> {
    let mut text = String::new();
    io::stdin().lock().take(16 << 20).read_to_string(&mut text)?;
    Ok(text)
}
