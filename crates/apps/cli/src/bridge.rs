//! `periplus bridge`.

mod config;
mod ros1;
mod services;
mod spec;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use periplus_graph::{Arguments, Node, NodeSettings};
use periplus_gz_transport::{BridgeDirection, GzBridge, Settings, TopicPair, Transport};
use periplus_msgs::rcl_interfaces::ParameterValue;
use periplus_os::{Machine, sleep};
use periplus_session::{LiveGraph, stop};

use crate::arguments;
use crate::error::CliError;
use crate::terminal;
use services::Services;
use spec::Spec;

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

/// Exit code of `parameter_bridge` for arguments that it cannot parse.
const USAGE_EXIT_CODE: u8 = 255;

/// Bridge topics and services between ROS 2 and Gazebo, as `parameter_bridge` of `ros_gz_bridge`
/// does
///
/// A topic is `/topic@ROS_TYPE@GZ_TYPE` for both directions; `[` before the Gazebo type means from
/// Gazebo to ROS, `]` from ROS to Gazebo. A service is `/service@ROS_TYPE`, optionally with
/// `@GZ_REQUEST@GZ_RESPONSE`: ROS nodes call services of Gazebo. `-r /lidar:=/laser_scan` remaps on
/// the ROS side only. `--ros-args` is understood; parameters are `config_file`, `lazy` and
/// `expand_gz_topic_names`.
///
/// `periplus bridge ros1` bridges ROS 1, with the master at ROS_MASTER_URI, and ROS 2: topics that
/// one side publishes and the other subscribes to, and all services, if both types are known.
#[derive(Debug, Args)]
pub(crate) struct BridgeOptions {
    /// Topics and services to bridge
    #[arg(value_name = "/TOPIC@ROS_TYPE(@|[|])GZ_TYPE")]
    words: Vec<String>,
    /// Topics as YAML, like the parameter `config_file`
    #[arg(long, value_name = "FILE.yaml")]
    config: Option<PathBuf>,
    /// Remap a topic, service or node on the ROS side: `from:=to`
    #[arg(long = "remap", short = 'r', value_name = "FROM:=TO")]
    remaps: Vec<String>,
    /// With `ros1`: bridge topics without subscribers, too
    #[arg(long)]
    all: bool,
    /// Parameter: `name:=value`
    #[arg(long = "param", short = 'p', value_name = "NAME:=VALUE")]
    parameters: Vec<String>,
}

/// Parameters of the bridge.
struct BridgeParameters {
    config: Option<PathBuf>,
    is_lazy: bool,
    expands: bool,
}

impl BridgeParameters {
    fn of(options: &BridgeOptions, arguments: &Arguments, node: &Node) -> Self {
        let told = arguments.parameters_of(node.full_name());
        let truth = |name: &str| told.get(name).is_some_and(|value| value.bool_value);
        let file = told.get("config_file").map(|value: &ParameterValue| &value.string_value);
        let file = file.filter(|file| !file.is_empty()).map(PathBuf::from);
        Self {
            config: options.config.clone().or(file),
            is_lazy: truth("lazy"),
            expands: truth("expand_gz_topic_names"),
        }
    }
}

pub(crate) fn run(options: &BridgeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    match options.words.as_slice() {
        [first] if first == "ros1" => return ros1::run(options.all),
        [first, ..] if first == "ros1" => {
            return Err(CliError::usage(
                "`periplus bridge ros1` bridges all topics and services that both sides know; it takes no names",
            ));
        }
        _ if options.all => {
            return Err(CliError::usage("`--all` belongs to `periplus bridge ros1`"));
        }
        _ => {}
    }
    let arguments = options.arguments(ros)?;
    let specs = options.specs()?;
    let stop = stop::on_signal();
    let (settings, findings) = Settings::from_environment(&Machine);
    terminal::print_findings(&findings)?;
    let live = LiveGraph::open(arguments.clone())?;
    let node = live.graph.node(NodeSettings::new("ros_gz_bridge").any_parameters())?;
    let transport = Arc::new(Transport::open(&settings).map_err(CliError::failed)?);
    let parameters = BridgeParameters::of(options, &arguments, &node);
    let mut services = Services::new(&node, &transport);
    let pairs = parameters.pairs(specs, &mut services)?;
    let link = GzBridge::new(&live.graph, &transport);
    for mut pair in pairs {
        if parameters.expands && !pair.gz_topic.starts_with('/') {
            let space = node.names().namespace().trim_end_matches('/');
            pair.gz_topic = format!("{space}/{}", pair.gz_topic);
        }
        // As in `parameter_bridge`, one bad entry does not stop the others.
        match link.bridge(&node, &pair) {
            Ok(()) => terminal::say(&described(&pair)),
            Err(error) => terminal::complain(&format!("`{}`: {error}", pair.gz_topic)),
        }
    }
    terminal::say(&format!("Gazebo: partition {}", settings.partition));
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        live.print_findings();
        terminal::print_findings(&link.take_findings())?;
        services.serve();
        sleep(POLL_PERIOD);
    }
    drop(link);
    live.end(FLUSH_TIMEOUT);
    Ok(ExitCode::SUCCESS)
}

/// Error in the arguments, with the exit code of `parameter_bridge`.
fn wrong_usage(message: impl Into<String>) -> CliError {
    CliError::Exit(message.into(), USAGE_EXIT_CODE)
}

impl BridgeOptions {
    /// Remaps and parameters of the node.
    fn arguments(&self, ros: Vec<String>) -> Result<Arguments, CliError> {
        let remaps = self.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
        let parameters = self.parameters.iter().flat_map(|one| ["-p".to_owned(), one.clone()]);
        let words = remaps.chain(parameters).chain(ros).collect();
        arguments::read(words).map_err(|error| match error {
            CliError::Reported(_) => CliError::Reported(USAGE_EXIT_CODE),
            error => error,
        })
    }

    /// Topics and services of the command line.
    fn specs(&self) -> Result<Vec<Spec>, CliError> {
        let read = |word: &String| {
            Spec::read(word).map_err(|why| {
                wrong_usage(format!("`{word}`: {why}\nsee `periplus bridge --help`"))
            })
        };
        self.words.iter().map(read).collect()
    }
}

impl BridgeParameters {
    /// Offers the services, and returns the topics of the command line and of the file.
    fn pairs(&self, specs: Vec<Spec>, services: &mut Services) -> Result<Vec<TopicPair>, CliError> {
        let mut pairs = Vec::new();
        for spec in specs {
            match spec {
                Spec::Topic(pair) => pairs.push(TopicPair { is_lazy: self.is_lazy, ..pair }),
                Spec::Service(service) => services.offer(&service).map_err(wrong_usage)?,
            }
        }
        if let Some(path) = &self.config {
            let (read, findings, sources) = config::read(path, self.is_lazy)?;
            terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &sources)?;
            pairs.extend(read);
        }
        if pairs.is_empty() && services.is_empty() {
            return Err(wrong_usage(
                "nothing to bridge; name a topic such as \
                 /lidar@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan, or a file with --config",
            ));
        }
        Ok(pairs)
    }
}

/// One line that describes a bridged pair.
fn described(pair: &TopicPair) -> String {
    let TopicPair { ros_topic, gz_topic, ros_type, gz_type, direction, .. } = pair;
    let arrow = match direction {
        BridgeDirection::Both => "<->",
        BridgeDirection::ToRos => "->",
        BridgeDirection::ToGazebo => "<-",
    };
    format!("Gazebo {gz_topic} ({gz_type}) {arrow} ROS {ros_topic} ({ros_type})")
}
