//! `periplus bridge`.

mod config;
mod services;
mod spec;

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, Node, NodeSettings};
use periplus_gz_transport::{BridgeDirection, GzBridge, Settings, TopicPair, Transport};
use periplus_msgs::rcl_interfaces::ParameterValue;
use periplus_os::{Machine, sleep};

use crate::arguments;
use crate::error::CliError;
use crate::live::Live;
use crate::stop;
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
    let words = options.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
    let parameters = options.parameters.iter().flat_map(|one| ["-p".to_owned(), one.clone()]);
    let arguments = arguments::read(words.chain(parameters).chain(ros).collect()).map_err(
        |error| match error {
            CliError::Reported(_) => CliError::Reported(USAGE_EXIT_CODE),
            error => error,
        },
    )?;
    let mut specs = Vec::new();
    for word in &options.words {
        match Spec::read(word) {
            Ok(spec) => specs.push(spec),
            Err(why) => {
                terminal::complain(&format!("`{word}`: {why}"));
                terminal::say("see `periplus bridge --help`");
                return Err(CliError::Reported(USAGE_EXIT_CODE));
            }
        }
    }
    let stop = stop::on_signal();
    let (settings, findings) = Settings::from_environment(&Machine);
    tell(&findings)?;
    let opened = Live::open(arguments.clone()).and_then(|live| {
        let made = live.graph.node(NodeSettings::new("ros_gz_bridge").any_parameters());
        let node = made.map_err(|error| error.to_string())?;
        let transport = Transport::open(&settings).map_err(|error| error.to_string())?;
        Ok((live, node, Arc::new(transport)))
    });
    let (live, node, transport) = opened.map_err(CliError::failed)?;
    let told = BridgeParameters::of(options, &arguments, &node);
    let mut pairs = Vec::new();
    let mut services = Services::new(&node, &transport);
    for spec in specs {
        match spec {
            Spec::Topic(pair) => pairs.push(TopicPair { is_lazy: told.is_lazy, ..pair }),
            Spec::Service(service) => {
                if let Err(why) = services.offer(&service) {
                    terminal::complain(&why);
                    return Err(CliError::Reported(USAGE_EXIT_CODE));
                }
            }
        }
    }
    if let Some(path) = &told.config {
        match config::read(path, told.is_lazy) {
            Ok((read, findings, sources)) => {
                terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &sources)?;
                pairs.extend(read);
            }
            Err(why) => {
                return Err(CliError::failed(why));
            }
        }
    }
    if pairs.is_empty() && services.is_empty() {
        terminal::complain(
            "nothing to bridge; name a topic such as \
             /lidar@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan, or a file with --config",
        );
        return Err(CliError::Reported(USAGE_EXIT_CODE));
    }
    let link = GzBridge::new(&live.graph, &transport);
    for mut pair in pairs {
        if told.expands && !pair.gz_topic.starts_with('/') {
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
        live.tell();
        tell(&link.take_findings())?;
        services.serve();
        sleep(POLL_PERIOD);
    }
    drop(link);
    live.end(FLUSH_TIMEOUT);
    Ok(ExitCode::SUCCESS)
}

fn tell(findings: &Diagnostics) -> io::Result<()> {
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())
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
