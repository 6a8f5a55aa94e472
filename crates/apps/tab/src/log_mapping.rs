//! Mapping of a log in slices, as `periplus slam LOG`.
#![expect(clippy::disallowed_methods, reason = "a tab is an edge: its files are in memory")]

use std::path::{Path, PathBuf};
use std::time::Duration;

use periplus_os::{Stopwatch, fs};
use periplus_session::log_mapping::{LogMapping, LogMappingRequest, MappingStep};
use periplus_session::scan_log::LogSelection;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::call_error::TabCallError;

/// Largest log. It is in memory as a file and again as scans, beside the map, and a module of 32 bits has 4 GiB.
const MAX_LOG_BYTES: u64 = 1 << 30;

/// Number of log errors in the report.
const MAX_FAULTS: usize = 20;

/// Options of mapping a log, as those of `periplus slam`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogMappingOptions {
    /// CARMEN log, or recording of ROS 1 or ROS 2.
    pub log: PathBuf,
    /// Folder of the results.
    pub out: PathBuf,
    /// SLAM method: `graph` or `gmapping`.
    #[serde(default)]
    pub method: Option<String>,
    /// Parameter file of `slam_toolbox` or `slam_gmapping`.
    #[serde(default)]
    pub params_file: Option<PathBuf>,
    /// Parameters as `name:=value`; they override the file.
    #[serde(default)]
    pub parameters: Vec<String>,
    /// Seed of the random numbers of `gmapping`.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Cell size of the map \[m\].
    #[serde(default)]
    pub resolution_m: Option<f64>,
    /// Maximum range of readings that are used \[m\].
    #[serde(default)]
    pub range_max_m: Option<f32>,
    /// True without loop closure.
    #[serde(default)]
    pub no_loops: bool,
    /// Topic of the scans; by default the one with the most messages.
    #[serde(default)]
    pub scan_topic: Option<String>,
    /// Frame of odometry; `odom` by default.
    #[serde(default)]
    pub odom_frame: Option<String>,
    /// Frame of the robot; `base_footprint` or `base_link` by default.
    #[serde(default)]
    pub base_frame: Option<String>,
    /// Session file that is continued.
    #[serde(default)]
    pub session: Option<PathBuf>,
    /// Session file to write.
    #[serde(default)]
    pub session_out: Option<PathBuf>,
    /// Pose graph in the format of g2o to write.
    #[serde(default)]
    pub g2o_out: Option<PathBuf>,
}

impl LogMappingOptions {
    fn request(self) -> Result<LogMappingRequest, TabCallError> {
        let usual = LogSelection::default();
        Ok(LogMappingRequest {
            log: self.log,
            input: LogSelection {
                scan_topic: self.scan_topic,
                odom_frame: self.odom_frame.unwrap_or(usual.odom_frame),
                base_frame: self.base_frame,
                preferred_topic: None,
                preferred_base: None,
            },
            out: self.out,
            method: self
                .method
                .map(|name| name.parse())
                .transpose()
                .map_err(TabCallError::Argument)?,
            parameters: self.parameters,
            params_file: self.params_file,
            seed: self.seed,
            threads: None,
            resolution_m: self.resolution_m,
            range_max_m: self.range_max_m,
            is_without_loops: self.no_loops,
            session: self.session,
            session_out: self.session_out,
            g2o_out: self.g2o_out,
        })
    }
}

/// State of a mapping run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Scans are added.
    Mapping,
    /// All scans are added; the next step optimizes the map, which takes longer than a slice.
    Finishing,
    /// The map is complete.
    Complete,
}

impl Phase {
    fn name(self) -> &'static str {
        match self {
            Self::Mapping => "mapping",
            Self::Finishing => "finishing",
            Self::Complete => "complete",
        }
    }
}

/// A log that is mapped in slices.
pub struct LogMappingTask {
    mapping: LogMapping,
    phase: Phase,
}

impl LogMappingTask {
    /// Reads parameters and log.
    ///
    /// # Errors
    /// When the log is too large, or cannot be read.
    pub fn open(options: LogMappingOptions) -> Result<Self, TabCallError> {
        let bytes = size(&options.log);
        if bytes > MAX_LOG_BYTES {
            return Err(TabCallError::TooLarge(options.log, bytes >> 20, MAX_LOG_BYTES >> 20));
        }
        for file in [&options.session_out, &options.g2o_out].into_iter().flatten() {
            let folder = file.parent().unwrap_or(Path::new("/"));
            fs::create_dir_all(folder)
                .map_err(|error| TabCallError::File(folder.to_owned(), error))?;
        }
        let mapping = LogMapping::open(options.request()?)?;
        Ok(Self { mapping, phase: Phase::Mapping })
    }

    /// Works for about this time, and returns the progress. The last optimization is one step, however long it
    /// takes; a call that returns the phase `finishing` precedes it.
    ///
    /// # Errors
    /// When the log can no longer be read.
    pub fn step(&mut self, budget: Duration) -> Result<Value, TabCallError> {
        let watch = Stopwatch::start();
        while self.phase != Phase::Complete {
            let (done, total) = self.mapping.position();
            if self.phase == Phase::Mapping && done >= total {
                self.phase = Phase::Finishing;
                break;
            }
            self.phase = match self.mapping.step()? {
                MappingStep::Scan | MappingStep::Restarted(_) => Phase::Mapping,
                MappingStep::Complete => Phase::Complete,
            };
            if watch.elapsed() >= budget {
                break;
            }
        }
        Ok(self.progress())
    }

    /// Returns the progress.
    fn progress(&self) -> Value {
        let progress = self.mapping.progress();
        let (done, total) = progress.scans;
        let pose = progress.map_from_base;
        json!({
            "phase": self.phase.name(),
            "is_rebuilt": progress.is_rebuilt,
            "fraction": done as f64 / total.max(1) as f64,
            "scans": done,
            "scans_total": total,
            "map_from_base": [pose.x_m, pose.y_m, pose.yaw_rad],
            "kept_scans": progress.counts.kept,
            "lost_scans": progress.counts.lost,
        })
    }

    /// Draws the present map with the trajectory as PNG.
    ///
    /// # Errors
    /// When there is no map yet, or it is too large to draw.
    pub fn preview(&self) -> Result<Vec<u8>, TabCallError> {
        self.mapping.preview().ok_or(TabCallError::NotReady("there is no map to draw yet"))
    }

    /// Writes the results, and returns the report: its JSON, its text, faults of the log, and why the map must not
    /// be used, if so.
    ///
    /// # Errors
    /// When the map is not complete, or a file cannot be written.
    pub fn write(&self) -> Result<Value, TabCallError> {
        if self.phase != Phase::Complete {
            return Err(TabCallError::NotReady(
                "the map is not complete; step until the phase is `complete`",
            ));
        }
        let report = self.mapping.report();
        self.mapping.write(&report)?;
        let mut text = Vec::new();
        report.write_text(&mut text, true).map_err(TabCallError::Output)?;
        let faults = self.mapping.faults();
        Ok(json!({
            "report": report.to_json(),
            "text": String::from_utf8_lossy(&text),
            "faults": faults.iter().take(MAX_FAULTS).collect::<Vec<_>>(),
            "failure": report.failure(),
        }))
    }
}

/// Size of a file, or of the files in a folder \[bytes\].
fn size(path: &Path) -> u64 {
    if !fs::is_dir(path) {
        return fs::metadata(path).map_or(0, |it| it.len());
    }
    let Ok(entries) = fs::read_dir(path) else { return 0 };
    let files = entries.filter_map(|entry| fs::metadata(entry.ok()?.path()).ok());
    files.map(|it| it.len()).sum()
}
