//! Laser scans with odometry, from CARMEN logs and recordings.

mod recording;

use std::fmt;
use std::io::{self, BufRead as _};
use std::path::{Path, PathBuf};

use periplus_bags::files::BagError;
use periplus_bags::{CarmenLog, CarmenScan, CarmenScanKind, is_carmen, read_carmen_from};
use periplus_diagnostics::plain_words;
use periplus_geometry::{LaserScan2, Pose2};
use periplus_os::fs;

use crate::files::{self, FileError};
use crate::recorded::ScanTopicError;

/// Topics and frames of a log.
#[derive(Clone, Debug)]
pub struct LogSelection {
    /// Topic of the scans; by default the one with the most messages.
    pub scan_topic: Option<String>,
    /// Frame of odometry.
    pub odom_frame: String,
    /// Frame of the robot; by default `base_footprint` or `base_link`.
    pub base_frame: Option<String>,
    /// Topic that is used if the log has it, such as that of a parameter file.
    pub preferred_topic: Option<String>,
    /// Frame of the robot that is used if the log has it.
    pub preferred_base: Option<String>,
}

impl Default for LogSelection {
    fn default() -> Self {
        Self {
            scan_topic: None,
            odom_frame: "odom".to_owned(),
            base_frame: None,
            preferred_topic: None,
            preferred_base: None,
        }
    }
}

/// Reason for which a log has no scans to read.
#[derive(Debug)]
#[non_exhaustive]
pub enum ScanLogError {
    /// The file cannot be read.
    File(FileError),
    /// Reading failed in the middle.
    Read(PathBuf, io::Error),
    /// The recording cannot be read.
    Recording(PathBuf, BagError),
    /// The recording has no topic of scans.
    Topic(ScanTopicError),
    /// Findings cannot be printed.
    Output(io::Error),
}

impl fmt::Display for ScanLogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(error) => error.fmt(f),
            Self::Read(path, error) => {
                write!(f, "cannot read {}: {}", path.display(), plain_words(error))
            }
            Self::Recording(path, error) => write!(f, "{error}{}", files::advice(path)),
            Self::Topic(error) => error.fmt(f),
            Self::Output(error) => write!(f, "cannot write the output: {}", plain_words(error)),
        }
    }
}

impl std::error::Error for ScanLogError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::File(error) => Some(error),
            Self::Read(_, error) | Self::Output(error) => Some(error),
            Self::Recording(_, error) => Some(error),
            Self::Topic(error) => Some(error),
        }
    }
}

/// Scan of a log.
#[derive(Clone, Debug)]
pub struct LoggedScan {
    /// The scan.
    pub scan: LaserScan2,
    /// Pose of the robot in odometry at the stamp of the scan.
    pub odom_from_base: Option<Pose2>,
}

impl LoggedScan {
    /// Stamp as written in the log, to the microsecond \[s\].
    #[must_use]
    pub fn stamp(&self) -> String {
        stamp(self.scan.time_ns)
    }
}

/// Text of a stamp, to the microsecond \[s\].
#[must_use]
pub fn stamp(time_ns: i64) -> String {
    let time_us = time_ns.div_euclid(1000);
    format!("{}.{:06}", time_us.div_euclid(1_000_000), time_us.rem_euclid(1_000_000))
}

/// Contents of a log.
#[derive(Debug, Default)]
pub struct ScanLog {
    /// Format of the log.
    pub kind: String,
    /// Scans in their order.
    pub scans: Vec<LoggedScan>,
    /// Damaged parts.
    pub faults: Vec<String>,
    /// Missing data and its consequence.
    pub warnings: Vec<String>,
}

/// Extensions of recordings.
const RECORDING_EXTENSIONS: [&str; 4] = ["bag", "mcap", "db3", "zstd"];

impl ScanLog {
    /// Reads a log and prints the findings.
    ///
    /// # Errors
    /// When the log cannot be read, or has no topic of scans.
    pub fn open(path: &Path, selection: &LogSelection) -> Result<Self, ScanLogError> {
        let is_recording = fs::is_dir(path)
            || path.extension().is_some_and(|it| {
                RECORDING_EXTENSIONS.iter().any(|other| it.eq_ignore_ascii_case(other))
            });
        if is_recording {
            return recording::read(path, selection);
        }
        let mut text = files::reader(path).map_err(ScanLogError::File)?;
        let log = match text.fill_buf() {
            Ok(head) if !is_carmen(head) => return recording::read(path, selection),
            Ok(_) => read_carmen_from(&mut text),
            Err(error) => Err(error),
        };
        log.map(carmen).map_err(|error| ScanLogError::Read(path.to_owned(), error))
    }

    /// Time from the first scan to the last \[s\].
    #[must_use]
    pub fn span_s(&self) -> f64 {
        let stamps = || self.scans.iter().map(|it| it.scan.time_ns);
        let span_ns = stamps().max().unwrap_or(0).saturating_sub(stamps().min().unwrap_or(0));
        span_ns as f64 * 1e-9
    }
}

fn carmen(log: CarmenLog) -> ScanLog {
    let faults = log.faults.iter().map(|(line, what)| format!("line {line}: {what}"));
    let faults = faults.collect();
    let (kind, scans) = log.scans_of_first_kind();
    let scans = scans.into_iter().map(logged).collect();
    let name = kind.map_or("", CarmenScanKind::name);
    ScanLog { kind: format!("CARMEN, {name}"), scans, faults, warnings: Vec::new() }
}

fn logged(scan: CarmenScan) -> LoggedScan {
    LoggedScan { odom_from_base: scan.odom_from_base, scan: scan.into() }
}
