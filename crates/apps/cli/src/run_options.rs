//! Options and exit codes that all simulating commands share.

use std::path::Path;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use periplus_bags::Compression;
use periplus_graph::Arguments;
use periplus_gz_msgs::Dialect;
use periplus_gz_transport::DiscoveryReach;
use periplus_os::Machine;
use periplus_ros1::{MasterClient, RpcError, Settings};
use periplus_session::{LiveGraph, RecordingRequest, Ros1Reach, Ros2Reach, RunEnd};
use periplus_sim::Composition;

use crate::error::CliError;
use crate::terminal;

/// Selection of recorded topics.
#[derive(Debug, Args)]
pub(crate) struct TopicSelection {
    /// Record only topics that match this regular expression
    #[arg(long, value_name = "REGEX")]
    topics: Option<regex::Regex>,
    /// Do not record topics that match this regular expression
    #[arg(long, value_name = "REGEX")]
    exclude: Option<regex::Regex>,
    /// Record the true poses of all models, too, on /gazebo/model_states: `periplus score` and `periplus compare` read them
    #[arg(long, requires = "record")]
    record_truth: bool,
    /// Compression of the bag
    #[arg(long, value_enum, default_value_t, value_name = "KIND", requires = "record")]
    bag_compression: BagCompression,
}

impl TopicSelection {
    /// Returns true if the true poses are recorded.
    pub(crate) fn records_truth(&self) -> bool {
        self.record_truth
    }

    /// Recording of the selected topics, if there is a file for it.
    pub(crate) fn recording(&self, path: Option<&Path>) -> Option<RecordingRequest> {
        let path = path?.to_owned();
        let (topics, exclude) = (self.topics.clone(), self.exclude.clone());
        let wanted = Box::new(move |name: &str| {
            topics.as_ref().is_none_or(|topics| topics.is_match(name))
                && !exclude.as_ref().is_some_and(|exclude| exclude.is_match(name))
        });
        let compression = self.bag_compression.into();
        Some(RecordingRequest { compression, ..RecordingRequest::new(path, wanted) })
    }
}

/// Compression of the messages of a bag.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum BagCompression {
    /// Larger files, quickest
    None,
    /// LZ4 frames, which are fast to write
    Lz4,
    /// Smallest files
    #[default]
    Zstd,
}

impl From<BagCompression> for Compression {
    fn from(compression: BagCompression) -> Self {
        match compression {
            BagCompression::None => Self::None,
            BagCompression::Lz4 => Self::Lz4,
            BagCompression::Zstd => Self::Zstd,
        }
    }
}

/// Real-time factor: simulated seconds per second of wall time.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Factor {
    /// As fast as possible.
    Max,
    /// Fixed factor.
    Of(f64),
}

impl Factor {
    /// Requested factor. By default a run with a duration is as fast as possible, any other at the
    /// rate of the world. `None` is as fast as possible.
    pub(crate) fn of_run(
        requested: Option<Self>,
        duration_s: Option<f64>,
        composition: &Composition,
    ) -> Option<f64> {
        match (requested, duration_s) {
            (Some(Self::Of(factor)), _) => Some(factor),
            (Some(Self::Max), _) | (None, Some(_)) => None,
            (None, None) => composition.real_time_factor(),
        }
    }
}

/// Visibility of a run on ROS 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Reach {
    /// No program
    Off,
    /// ROS 2 programs on this machine
    Loopback,
    /// ROS 2 programs in the range of multicast or named by `ROS_STATIC_PEERS`
    Network,
    /// ROS 2 programs that use `rmw_zenoh`, through its router
    Zenoh,
}

impl From<Reach> for Ros2Reach {
    fn from(reach: Reach) -> Self {
        match reach {
            Reach::Off => Self::Off,
            Reach::Loopback => Self::Loopback,
            Reach::Network => Self::Network,
            Reach::Zenoh => Self::Zenoh,
        }
    }
}

/// Visibility of a run on ROS 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Ros1Choice {
    /// No program
    Off,
    /// ROS 1 programs on this machine
    Loopback,
    /// ROS 1 programs that reach this machine
    Network,
    /// ROS 1 programs on this machine, if a master answers
    Auto,
}

/// Option of commands whose nodes can join ROS 1.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Ros1Options {
    /// Join ROS 1: the master at ROS_MASTER_URI, or a master in this program if none answers;
    /// `--ros1=network` beyond this machine, `--ros1=auto` only if a master answers
    #[arg(
        long,
        value_enum,
        value_name = "off|loopback|network|auto",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "loopback"
    )]
    ros1: Option<Ros1Choice>,
}

/// Option of commands whose nodes are either in ROS 2 or in ROS 1.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct LiveNetworkOptions {
    /// Use ROS 1 in place of ROS 2, with the master at ROS_MASTER_URI; `--ros1=auto` only if a
    /// master answers there
    #[arg(
        long,
        value_enum,
        value_name = "on|auto",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "on"
    )]
    ros1: Option<Ros1Use>,
}

/// When a command uses ROS 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Ros1Use {
    /// In any case
    On,
    /// If a master answers
    Auto,
}

impl LiveNetworkOptions {
    /// ROS 1 in any case.
    pub(crate) const ROS1: Self = Self { ros1: Some(Ros1Use::On) };

    /// Returns true if ROS 1 is used; prints a note if it was requested and is not.
    pub(crate) fn is_ros1(self) -> bool {
        let Some(choice) = self.ros1 else { return false };
        let applies = choice == Ros1Use::On || has_master();
        if !applies {
            terminal::say("no ROS 1 master answers: using ROS 2");
        }
        applies
    }

    /// Joins the network of the command.
    pub(crate) fn open(self, arguments: Arguments) -> Result<LiveGraph, CliError> {
        if self.is_ros1() {
            Ok(LiveGraph::open_ros1(arguments)?)
        } else {
            Ok(LiveGraph::open(arguments)?)
        }
    }
}

/// True if a master answers at `ROS_MASTER_URI`.
fn has_master() -> bool {
    let (settings, _) = Settings::from_environment(&Machine, Ros1Reach::Machine);
    let client = MasterClient::new(&settings.master_uri, "/periplus_cli");
    !matches!(client.ask("getPid", Vec::new()), Err(RpcError::Unreachable(_)))
}

impl Ros1Options {
    /// Requested visibility; `None` if the run does not join.
    pub(crate) fn reach(self) -> Option<Ros1Reach> {
        match self.ros1? {
            Ros1Choice::Off => None,
            Ros1Choice::Loopback => Some(Ros1Reach::Machine),
            Ros1Choice::Network => Some(Ros1Reach::Network),
            Ros1Choice::Auto => has_master().then_some(Ros1Reach::Machine),
        }
    }
}

/// Visibility of a run on Gazebo Transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GzReach {
    /// Gazebo programs on this machine
    Loopback,
    /// Gazebo programs in the range of multicast
    Network,
}

impl From<GzReach> for DiscoveryReach {
    fn from(reach: GzReach) -> Self {
        match reach {
            GzReach::Loopback => Self::Machine,
            GzReach::Network => Self::Network,
        }
    }
}

/// Prefix of message types on Gazebo Transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GzTypes {
    /// `gz.msgs.LaserScan`: Garden, Harmonic and later
    Gz,
    /// `ignition.msgs.LaserScan`: Fortress and before, and Debian
    Ignition,
}

impl From<GzTypes> for Dialect {
    fn from(types: GzTypes) -> Self {
        match types {
            GzTypes::Gz => Self::Gz,
            GzTypes::Ignition => Self::Ignition,
        }
    }
}

/// Exit code of a run.
pub(crate) fn exit_code(end: RunEnd) -> Result<ExitCode, CliError> {
    match end {
        RunEnd::Complete => Ok(ExitCode::SUCCESS),
        RunEnd::Interrupted => Ok(ExitCode::from(terminal::INTERRUPTED)),
        // The reason is printed already.
        RunEnd::RecordingIncomplete => Err(CliError::Reported(1)),
        // Findings name each of them.
        RunEnd::ModelRemoved(diverged) => {
            Err(CliError::Failed(format!("{diverged}; its model was removed")))
        }
        RunEnd::Diverged(diverged) => Err(CliError::failed(diverged)),
    }
}

/// Parses numbers between commas, such as a pose; none if one of them is no finite number.
pub(crate) fn finite_numbers(word: &str) -> Option<Vec<f64>> {
    word.split(',').map(|part| part.trim().parse().ok().filter(|it: &f64| it.is_finite())).collect()
}

/// Parses a number above 0.
pub(crate) fn positive(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("expected a number above 0".into()),
    }
}

/// Parses a real-time factor.
pub(crate) fn factor(word: &str) -> Result<Factor, String> {
    if word == "max" {
        return Ok(Factor::Max);
    }
    positive(word).map(Factor::Of).map_err(|_| "expected a number above 0, or `max`".into())
}
