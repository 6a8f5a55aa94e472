//! Request of a map.

use std::path::PathBuf;

use periplus_slam::Method;

use crate::scan_log::LogSelection;

/// A log to map, its parameters, and the results to write.
#[derive(Clone, Debug, Default)]
pub struct LogMappingRequest {
    /// CARMEN log, or recording of ROS 1 or ROS 2.
    pub log: PathBuf,
    /// Topics and frames of the log.
    pub input: LogSelection,
    /// Folder of the results.
    pub out: PathBuf,
    /// SLAM method; by default that of the parameters, or a pose graph.
    pub method: Option<Method>,
    /// Parameters as `name:=value`; they override the file.
    pub parameters: Vec<String>,
    /// Parameter file of `slam_toolbox` or `slam_gmapping`.
    pub params_file: Option<PathBuf>,
    /// Seed of the random numbers of `gmapping`.
    pub seed: Option<u64>,
    /// Number of threads of `gmapping`; results do not depend on it.
    pub threads: Option<usize>,
    /// Cell size of the map \[m\].
    pub resolution_m: Option<f64>,
    /// Maximum range of readings that are used \[m\].
    pub range_max_m: Option<f32>,
    /// True without loop closure.
    pub is_without_loops: bool,
    /// Session file that is continued.
    pub session: Option<PathBuf>,
    /// Session file to write; it does not contain the final refinement.
    pub session_out: Option<PathBuf>,
    /// Pose graph in the format of g2o to write.
    pub g2o_out: Option<PathBuf>,
}
