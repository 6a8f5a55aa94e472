//! Laser scans with odometry, from CARMEN logs and recordings.

mod bag;

use std::io::BufRead as _;
use std::path::Path;

use clap::Args;
use periplus_bags::{CarmenLog, CarmenScan, CarmenScanKind, is_carmen, read_carmen_from};
use periplus_diagnostics::plain_words;
use periplus_geometry::{LaserScan2, Pose2};

use crate::error::CliError;
use crate::paths;

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
    /// Topic and frame from a parameter file; used if the log has them.
    #[arg(skip)]
    pub(crate) told_topic: Option<String>,
    #[arg(skip)]
    pub(crate) told_base: Option<String>,
}

/// Scan of a log.
pub(crate) struct LoggedScan {
    pub(crate) scan: LaserScan2,
    pub(crate) odom_from_base: Option<Pose2>,
}

impl LoggedScan {
    /// Stamp as written in the log, to the microsecond \[s\].
    pub(crate) fn stamp(&self) -> String {
        stamp(self.scan.time_ns)
    }
}

/// Text of a stamp, to the microsecond \[s\].
pub(crate) fn stamp(time_ns: i64) -> String {
    let time_us = time_ns.div_euclid(1000);
    format!("{}.{:06}", time_us.div_euclid(1_000_000), time_us.rem_euclid(1_000_000))
}

/// Contents of a log.
#[derive(Default)]
pub(crate) struct Log {
    /// Format of the log.
    pub(crate) kind: String,
    pub(crate) scans: Vec<LoggedScan>,
    /// Damaged parts.
    pub(crate) faults: Vec<String>,
    /// Missing data and its consequence.
    pub(crate) warnings: Vec<String>,
}

impl Log {
    /// Reads a log and prints the findings.
    pub(crate) fn open(path: &Path, options: &LogOptions) -> Result<Self, CliError> {
        let is_recording = path.is_dir()
            || path.extension().is_some_and(|it| {
                ["bag", "mcap", "db3", "zstd"].iter().any(|other| it.eq_ignore_ascii_case(other))
            });
        if is_recording {
            return bag::read(path, options);
        }
        let mut text = paths::reader(path)?;
        let log = match text.fill_buf() {
            Ok(head) if !is_carmen(head) => return bag::read(path, options),
            Ok(_) => read_carmen_from(&mut text),
            Err(error) => Err(error),
        };
        log.map(carmen).map_err(|error| {
            CliError::failed(format!("cannot read {}: {}", path.display(), plain_words(&error)))
        })
    }

    /// Time from the first scan to the last \[s\].
    pub(crate) fn span_s(&self) -> f64 {
        let stamps = || self.scans.iter().map(|it| it.scan.time_ns);
        let span_ns = stamps().max().unwrap_or(0).saturating_sub(stamps().min().unwrap_or(0));
        span_ns as f64 * 1e-9
    }
}

fn carmen(log: CarmenLog) -> Log {
    let faults = log.faults.iter().map(|(line, what)| format!("line {line}: {what}"));
    let faults = faults.collect();
    let (kind, scans) = log.scans_of_first_kind();
    let scans = scans.into_iter().map(logged).collect();
    let name = kind.map_or("", CarmenScanKind::name);
    Log { kind: format!("CARMEN, {name}"), scans, faults, warnings: Vec::new() }
}

fn logged(scan: CarmenScan) -> LoggedScan {
    LoggedScan { odom_from_base: scan.odom_from_base, scan: scan.into() }
}
