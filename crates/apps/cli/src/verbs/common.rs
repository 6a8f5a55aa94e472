//! Common options of verbs.

use clap::Args;
use periplus_ros2cli::QosRequest;

use crate::run_options::LiveNetworkOptions;

#[derive(Clone, Debug, Default, Args)]
pub(crate) struct Common {
    /// Print JSON: one object, or one object per line of a stream
    #[arg(long)]
    pub(crate) json: bool,
    /// Discovery time [s] [default: as long as discovery takes]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) spin_time: Option<f64>,
    /// Folder of packages with .msg, .srv and .action files, in addition to AMENT_PREFIX_PATH;
    /// repeatable
    #[arg(long, value_name = "DIR")]
    pub(crate) interfaces: Vec<std::path::PathBuf>,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
    /// Accepted for compatibility with scripts; there is no daemon
    #[arg(long, hide = true)]
    pub(crate) no_daemon: bool,
    /// Accepted for compatibility with scripts; rates use the wall clock
    #[arg(long, short = 's', hide = true)]
    pub(crate) use_sim_time: bool,
}

/// Values of `--qos-profile`.
const PROFILES: [&str; 6] = [
    "default",
    "sensor_data",
    "system_default",
    "services_default",
    "parameters",
    "parameter_events",
];

/// Values of each policy; the last two leave the choice to the profile, as in ROS 2.
const HISTORIES: [&str; 4] = ["keep_last", "keep_all", "system_default", "best_available"];
const RELIABILITIES: [&str; 4] = ["reliable", "best_effort", "system_default", "best_available"];
const DURABILITIES: [&str; 4] = ["volatile", "transient_local", "system_default", "best_available"];
const LIVELINESSES: [&str; 4] =
    ["automatic", "manual_by_topic", "system_default", "best_available"];

#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Quality of service")]
pub(crate) struct QosOptions {
    /// Profile with the default of the other policies
    #[arg(long, value_name = "NAME", value_parser = PROFILES)]
    qos_profile: Option<String>,
    /// Maximum number of queued messages
    #[arg(long, value_name = "COUNT")]
    qos_depth: Option<usize>,
    /// History: old messages are dropped or kept
    #[arg(long, value_name = "POLICY", value_parser = HISTORIES)]
    qos_history: Option<String>,
    /// Reliability: retransmission of lost messages
    #[arg(long, value_name = "POLICY", value_parser = RELIABILITIES)]
    qos_reliability: Option<String>,
    /// Durability: delivery of earlier messages to late subscribers
    #[arg(long, value_name = "POLICY", value_parser = DURABILITIES)]
    qos_durability: Option<String>,
    /// Liveliness: assertion by publishers that they are alive
    #[arg(long, value_name = "POLICY", value_parser = LIVELINESSES)]
    qos_liveliness: Option<String>,
    /// Maximum time between liveliness assertions of a publisher [s]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    qos_liveliness_lease_duration_seconds: Option<f64>,
}

impl QosOptions {
    pub(crate) fn wish(&self) -> QosRequest {
        QosRequest {
            profile: self.qos_profile.clone(),
            depth: self.qos_depth,
            history: self.qos_history.clone(),
            reliability: self.qos_reliability.clone(),
            durability: self.qos_durability.clone(),
            liveliness: self.qos_liveliness.clone(),
            lease_s: self.qos_liveliness_lease_duration_seconds,
        }
    }
}

/// Parses a duration \[s\].
pub(crate) fn seconds(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if (0.0..=1e9).contains(&number) => Ok(number),
        _ => Err("expected a number of seconds, 0 or more".into()),
    }
}

/// Parses a rate \[Hz\].
pub(crate) fn rate(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if (1e-6..=1e6).contains(&number) => Ok(number),
        _ => Err("expected a number above 0".into()),
    }
}

/// Parses a count above zero.
pub(crate) fn count(word: &str) -> Result<usize, String> {
    match word.parse() {
        Ok(0) | Err(_) => Err("expected a whole number above 0".into()),
        Ok(number) => Ok(number),
    }
}
