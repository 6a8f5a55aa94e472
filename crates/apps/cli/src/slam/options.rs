//! Options of `periplus slam`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser as _};
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_session::log_mapping::LogMappingRequest;
use periplus_slam::Method;

use crate::log::LogOptions;
use crate::run_options::LiveNetworkOptions;

/// Build a map and a trajectory from a log of laser scans
///
/// The default method is a pose graph with the parameters of slam_toolbox; `--method gmapping` is a
/// particle filter with one map per particle and the parameters of slam_gmapping.
///
/// LOG is a CARMEN log or a recording of ROS 1 or ROS 2 (.bag, .mcap, .db3, a folder of `ros2
/// bag`). DIR receives map.yaml and map.pgm, trajectory.txt (one line per scan: `stamp x y theta`),
/// trajectory.png and report.json. Damaged parts are reported, the rest is used, and the exit code
/// is 1.
#[derive(Debug, Args)]
pub(crate) struct SlamOptions {
    /// CARMEN log, or recording of ROS 1 or ROS 2
    #[arg(
        value_name = "LOG",
        required_unless_present = "live",
        default_value = "",
        hide_default_value = true,
        value_parser = OsStringValueParser::new().map(PathBuf::from)
    )]
    pub(crate) log: PathBuf,
    /// Output folder
    #[arg(
        long,
        short,
        value_name = "DIR",
        required_unless_present = "live",
        default_value = "",
        hide_default_value = true,
        value_parser = OsStringValueParser::new().map(PathBuf::from)
    )]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) live: LiveOptions,
    /// SLAM method [default: that of the parameters, or `graph`]
    #[arg(long, value_name = "graph|gmapping")]
    pub(crate) method: Option<Method>,
    /// Parameter; overrides files
    #[arg(long = "param", short = 'p', value_name = "NAME:=VALUE")]
    pub(crate) parameters: Vec<String>,
    /// Seed of the random numbers; `graph` uses none
    #[arg(long)]
    pub(crate) seed: Option<u64>,
    /// Number of threads for `gmapping`; results do not depend on it
    #[arg(long)]
    pub(crate) threads: Option<usize>,
    /// Cell size of the map [m] [default: 0.05]
    #[arg(long, value_name = "M", value_parser = side)]
    pub(crate) resolution: Option<f64>,
    /// Maximum range of readings that are used [m]
    #[arg(long, value_name = "M")]
    pub(crate) max_range: Option<f32>,
    /// Disable loop closure (`graph`)
    #[arg(long)]
    pub(crate) no_loops: bool,
    #[command(flatten)]
    pub(crate) input: LogOptions,
    /// Continue the map of a session, as if both logs were one
    #[arg(long, value_name = "FILE")]
    pub(crate) session: Option<PathBuf>,
    /// Save a session to continue later; it does not contain the final refinement
    #[arg(long, value_name = "FILE")]
    pub(crate) save_session: Option<PathBuf>,
    /// Write the pose graph in the format of g2o: poses, edges, information matrices
    #[arg(long, value_name = "FILE")]
    pub(crate) g2o: Option<PathBuf>,
    /// Print only errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

impl SlamOptions {
    /// Log, parameters and results.
    pub(super) fn request(&self) -> LogMappingRequest {
        LogMappingRequest {
            log: self.log.clone(),
            input: self.input.selection(),
            out: self.out.clone(),
            method: self.method,
            parameters: self.parameters.clone(),
            params_file: self.live.params_file.clone(),
            seed: self.seed,
            threads: self.threads,
            resolution_m: self.resolution,
            range_max_m: self.max_range,
            is_without_loops: self.no_loops,
            session: self.session.clone(),
            session_out: self.save_session.clone(),
            g2o_out: self.g2o.clone(),
        }
    }
}

/// Options of mapping on ROS 2.
#[derive(Debug, Args)]
pub(crate) struct LiveOptions {
    /// Run as a SLAM node on ROS 2: subscribe to scans, `/tf` and `/tf_static`; publish `/map` and
    /// `map -> odom`
    #[arg(long, conflicts_with = "log")]
    pub(crate) live: bool,
    /// Parameter file of `slam_toolbox` or `slam_gmapping`
    #[arg(long, value_name = "FILE")]
    pub(crate) params_file: Option<PathBuf>,
    /// Node to run: async, sync, localization, lifelong or gmapping [default: the one of the
    /// parameter file]
    #[arg(long, value_name = "PROGRAM", requires = "live")]
    pub(crate) node: Option<Program>,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

fn side(text: &str) -> Result<f64, String> {
    let side: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
    if (0.005..=2.0).contains(&side) {
        Ok(side)
    } else {
        Err("the cell size must be 0.005 to 2 m".into())
    }
}
