//! `periplus topic`.

use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Subcommand};
use periplus_msgs::YamlStyle;
use periplus_ros2cli::show::{Form, Show};
use periplus_ros2cli::topic::{self, Publish, Rate, TopicEchoOptions, TopicListOptions};

use super::common::{Common, QosOptions, count, rate, seconds};
use super::{gazebo, with_session};

use crate::error::CliError;

/// List, print, measure and publish topics, as `ros2 topic` does
#[derive(Debug, Args)]
pub(crate) struct TopicOptions {
    /// Include hidden topics: those with a part that begins with `_`
    #[arg(long)]
    include_hidden_topics: bool,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Measure the bytes per second of a topic
    Bw(RateOptions),
    /// Measure the age of the stamps of a topic on arrival
    Delay(RateOptions),
    Echo(Box<EchoOptions>),
    Find(FindOptions),
    Hz(HzOptions),
    Info(InfoOptions),
    List(ListOptions),
    Pub(Box<PubOptions>),
    Type(TypeOptions),
}

/// List topics
#[derive(Debug, Args)]
struct ListOptions {
    /// Show types
    #[arg(long, short = 't')]
    show_types: bool,
    /// Print only the count
    #[arg(long, short = 'c', alias = "count")]
    count_topics: bool,
    /// Include hidden ones
    #[arg(long = "include-hidden-topics", short = 'a', alias = "all")]
    include_hidden: bool,
    /// Show the number of publishers and subscribers
    #[arg(long, short = 'v')]
    verbose: bool,
    /// List the topics of Gazebo Transport instead of those of ROS 2
    #[arg(long)]
    gz: bool,
    #[command(flatten)]
    common: Common,
}

/// Show publishers and subscribers of a topic
#[derive(Debug, Args)]
struct InfoOptions {
    topic_name: String,
    /// Show nodes, types, hashes and QoS
    #[arg(long, short = 'v')]
    verbose: bool,
    #[command(flatten)]
    common: Common,
}

/// Print the type of a topic
#[derive(Debug, Args)]
struct TypeOptions {
    topic_name: String,
    #[command(flatten)]
    common: Common,
}

/// List the topics of a type
#[derive(Debug, Args)]
struct FindOptions {
    /// Type, such as `sensor_msgs/msg/LaserScan`
    topic_type: String,
    /// Print only the count
    #[arg(long, short = 'c', alias = "count")]
    count_topics: bool,
    /// Include hidden ones
    #[arg(long)]
    include_hidden_topics: bool,
    #[command(flatten)]
    common: Common,
}

/// Print the messages of a topic
///
/// The QoS is chosen to be compatible with all publishers. Lists and strings longer than 128 are
/// truncated, except in JSON. `--filter` takes a Python expression over the message `m`.
#[derive(Debug, Args)]
struct EchoOptions {
    topic_name: String,
    /// Message type [default: that of the topic]
    message_type: Option<String>,
    /// Print only this part of the message, such as `pose.pose.position` or `ranges[0]`
    #[arg(long, value_name = "FIELD")]
    field: Option<String>,
    /// Print all values on one line, separated by commas
    #[arg(long, conflicts_with_all = ["json", "raw"])]
    csv: bool,
    /// Do not truncate
    #[arg(long, short = 'f')]
    full_length: bool,
    /// Truncate lists and strings after this many elements
    #[arg(long, short = 'l', value_name = "COUNT")]
    truncate_length: Option<usize>,
    /// Print only the lengths of lists
    #[arg(long)]
    no_arr: bool,
    /// Print only the lengths of strings
    #[arg(long)]
    no_str: bool,
    /// Print each message on one line, in braces
    #[arg(long)]
    flow_style: bool,
    /// Do not report lost messages
    #[arg(long)]
    no_lost_messages: bool,
    /// Print the serialized bytes
    #[arg(long, conflicts_with_all = ["json", "field", "filter"])]
    raw: bool,
    /// Print only messages that match an expression, such as `m.range < 0.5`
    #[arg(long, value_name = "EXPR")]
    filter: Option<String>,
    /// Print one message and exit
    #[arg(long)]
    once: bool,
    /// Exit after this many seconds without a message; exit code 1 if none came at all
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    timeout: Option<f64>,
    #[command(flatten)]
    qos: QosOptions,
    #[command(flatten)]
    common: Common,
}

/// Measure the rate of messages
#[derive(Debug, Args)]
struct HzOptions {
    #[arg(required = true)]
    topic_name: Vec<String>,
    /// Number of messages in the measurement window
    #[arg(long, short = 'w', value_name = "COUNT", value_parser = count)]
    window: Option<usize>,
    /// Count only messages that match an expression, such as `m.data > 3`
    #[arg(long, value_name = "EXPR")]
    filter: Option<String>,
    /// Accepted for compatibility with scripts; the wall clock is always used
    #[arg(long, hide = true)]
    wall_time: bool,
    #[command(flatten)]
    qos: QosOptions,
    #[command(flatten)]
    common: Common,
}

// The description is that of each command.
#[derive(Debug, Args)]
struct RateOptions {
    topic_name: String,
    /// Number of messages in the measurement window
    #[arg(long, short = 'w', value_name = "COUNT", value_parser = count)]
    window: Option<usize>,
    #[command(flatten)]
    qos: QosOptions,
    #[command(flatten)]
    common: Common,
}

/// Publish a message repeatedly or once
///
/// Values are YAML: `periplus topic pub /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.5}}'`. A
/// header `auto` and a stamp `now` are replaced by the current time.
#[derive(Debug, Args)]
struct PubOptions {
    topic_name: String,
    message_type: String,
    /// Message, as YAML; missing fields have their defaults
    #[arg(default_value = "{}")]
    values: String,
    /// Rate [Hz]
    #[arg(long, short = 'r', value_name = "HZ", default_value_t = 1.0, value_parser = rate)]
    rate: f64,
    /// Print only every Nth message
    #[arg(long, short = 'p', value_name = "N", default_value_t = 1)]
    print: u64,
    /// Publish one message and exit
    #[arg(long, short = '1', conflicts_with = "times")]
    once: bool,
    /// Publish this many messages and exit
    #[arg(long, short = 't', value_name = "N")]
    times: Option<u64>,
    /// Wait for this many subscribers [default: 1 with `--once` and `--times`, else 0]
    #[arg(long, short = 'w', value_name = "N")]
    wait_matching_subscriptions: Option<usize>,
    /// Give up after this time without enough subscribers [s]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    max_wait_time_secs: Option<f64>,
    /// Time to keep running after the last message [s]
    #[arg(long, value_name = "SECONDS", default_value_t = 0.1, value_parser = seconds)]
    keep_alive: f64,
    /// Name of the node that publishes
    #[arg(long, short = 'n', value_name = "NAME")]
    node_name: Option<String>,
    #[command(flatten)]
    qos: QosOptions,
    #[command(flatten)]
    common: Common,
}

impl TopicOptions {
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        let hidden = self.include_hidden_topics;
        match &self.verb {
            Verb::List(options) if options.gz => {
                gazebo::topics(&options.common, options.show_types, options.count_topics)
            }
            Verb::List(options) => with_session(&options.common, |session| {
                topic::list(
                    session,
                    TopicListOptions {
                        show_types: options.show_types,
                        count: options.count_topics,
                        include_hidden: options.include_hidden || hidden,
                        verbose: options.verbose,
                    },
                )
            }),
            Verb::Info(options) => with_session(&options.common, |session| {
                topic::info(session, &options.topic_name, options.verbose)
            }),
            Verb::Type(options) => with_session(&options.common, |session| {
                topic::type_of(session, &options.topic_name)
            }),
            Verb::Find(options) => with_session(&options.common, |session| {
                let hidden = options.include_hidden_topics || hidden;
                topic::find(session, &options.topic_type, options.count_topics, hidden)
            }),
            Verb::Echo(options) => with_session(&options.common, |session| {
                topic::echo(session, &options.topic_name, &options.echo())
            }),
            Verb::Hz(options) => with_session(&options.common, |session| {
                let rate = Rate {
                    window: options.window,
                    filter: options.filter.clone(),
                    qos: options.qos.wish(),
                };
                topic::hz(session, &options.topic_name, &rate)
            }),
            Verb::Bw(options) => with_session(&options.common, |session| {
                topic::bandwidth(session, &options.topic_name, &options.rate())
            }),
            Verb::Delay(options) => with_session(&options.common, |session| {
                topic::delay(session, &options.topic_name, &options.rate())
            }),
            Verb::Pub(options) => with_session(&options.common, |session| {
                let (name, type_name) = (&options.topic_name, &options.message_type);
                topic::publish(session, name, type_name, &options.values, &options.publish())
            }),
        }
    }
}

impl EchoOptions {
    fn echo(&self) -> TopicEchoOptions {
        let form = match (self.csv, self.common.json) {
            (true, _) => Form::Csv,
            (_, true) => Form::Json,
            _ => Form::Yaml,
        };
        let by_itself = YamlStyle::default().longest.filter(|_| form != Form::Json);
        let longest = self.truncate_length.or(by_itself).filter(|_| !self.full_length);
        TopicEchoOptions {
            type_name: self.message_type.clone(),
            show: Show {
                form,
                style: YamlStyle {
                    longest,
                    no_arrays: self.no_arr,
                    no_texts: self.no_str,
                    flow: self.flow_style,
                },
                field: self.field.clone(),
            },
            raw: self.raw,
            once: self.once,
            filter: self.filter.clone(),
            timeout: self.timeout.map(Duration::from_secs_f64),
            no_lost_messages: self.no_lost_messages,
            qos: self.qos.wish(),
        }
    }
}

impl RateOptions {
    fn rate(&self) -> Rate {
        Rate { window: self.window, filter: None, qos: self.qos.wish() }
    }
}

impl PubOptions {
    fn publish(&self) -> Publish {
        Publish {
            rate_hz: self.rate,
            times: if self.once { Some(1) } else { self.times.filter(|times| *times > 0) },
            print: self.print,
            wait_matching: self.wait_matching_subscriptions,
            most_wait: self.max_wait_time_secs.map(Duration::from_secs_f64),
            keep_alive: Duration::from_secs_f64(self.keep_alive),
            node_name: self.node_name.clone(),
            qos: self.qos.wish(),
        }
    }
}
