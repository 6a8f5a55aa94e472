//! Options that select topics and frames of a log.

use clap::Args;
use periplus_session::scan_log::LogSelection;

/// Selection of topics and frames of a log.
#[derive(Clone, Debug, Args)]
pub(crate) struct LogOptions {
    /// Topic of the scans [default: the scan topic with the most messages]
    #[arg(long, value_name = "TOPIC")]
    pub(crate) scan_topic: Option<String>,
    /// Frame of odometry
    #[arg(long, default_value = "odom", value_name = "FRAME")]
    pub(crate) odom_frame: String,
    /// Frame of the robot [default: `base_footprint` or `base_link`, whichever the log has]
    #[arg(long, value_name = "FRAME")]
    pub(crate) base_frame: Option<String>,
}

impl LogOptions {
    /// Selection without those of parameters.
    pub(crate) fn selection(&self) -> LogSelection {
        LogSelection {
            scan_topic: self.scan_topic.clone(),
            odom_frame: self.odom_frame.clone(),
            base_frame: self.base_frame.clone(),
            ..LogSelection::default()
        }
    }
}
