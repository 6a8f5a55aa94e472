//! What can be typed after `periplus slam`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser as _};
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_slam::Method;

use crate::log::LogOptions;

/// Make a map and a trajectory from a log of laser scans
///
/// By default with a graph of poses, which takes the parameters of slam_toolbox; with `--method
/// gmapping` by particles with a map each, and the parameters of slam_gmapping.
///
/// LOG is a log of CARMEN or a recording of ROS 1 or ROS 2 (.bag, .mcap, .db3, a folder of `ros2
/// bag`). DIR receives map.yaml and map.pgm, trajectory.txt (a line for each scan: `stamp x y
/// theta`), trajectory.png and report.json. What is damaged is told, the rest is used, and the exit
/// code is 1.
#[derive(Debug, Args)]
pub(crate) struct SlamOptions {
    /// The log
    #[arg(
        value_name = "LOG",
        required_unless_present = "live",
        default_value = "",
        hide_default_value = true,
        value_parser = OsStringValueParser::new().map(PathBuf::from)
    )]
    pub(crate) log: PathBuf,
    /// Where the results go
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
    /// How the map is made; without it as the parameters say, or `graph`
    #[arg(long, value_name = "graph|gmapping")]
    pub(crate) method: Option<Method>,
    /// One parameter; it wins over files
    #[arg(long = "param", short = 'p', value_name = "NAME:=VALUE")]
    pub(crate) parameters: Vec<String>,
    /// Seed of all randomness; `graph` has none
    #[arg(long)]
    pub(crate) seed: Option<u64>,
    /// Threads for `gmapping`; the result is the same
    #[arg(long)]
    pub(crate) threads: Option<usize>,
    /// Side of a cell of the map, 0.05 by default [m]
    #[arg(long, value_name = "M", value_parser = side)]
    pub(crate) resolution: Option<f64>,
    /// Readings from farther away are not used [m]
    #[arg(long, value_name = "M")]
    pub(crate) max_range: Option<f32>,
    /// Close no loops (`graph`)
    #[arg(long)]
    pub(crate) no_loops: bool,
    #[command(flatten)]
    pub(crate) input: LogOptions,
    /// Go on with the map of a session, as if the logs were one
    #[arg(long, value_name = "FILE")]
    pub(crate) session: Option<PathBuf>,
    /// Save a session, to go on with later; the last refinement is not part of it
    #[arg(long, value_name = "FILE")]
    pub(crate) save_session: Option<PathBuf>,
    /// Write the graph for g2o: poses, edges, information
    #[arg(long, value_name = "FILE")]
    pub(crate) g2o: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

/// Mapping of what is heard on ROS 2.
#[derive(Debug, Args)]
pub(crate) struct LiveOptions {
    /// Map what is heard on ROS 2: scans, `/tf` and `/tf_static`; publish `/map` and `map -> odom`
    #[arg(long, conflicts_with = "log")]
    pub(crate) live: bool,
    /// Parameters as `slam_toolbox` or `slam_gmapping` have them in files
    #[arg(long, value_name = "FILE")]
    pub(crate) params_file: Option<PathBuf>,
    /// Which program's part it plays: async, sync, localization, lifelong or gmapping; without it the
    /// one that the file is for
    #[arg(long, value_name = "PROGRAM", requires = "live")]
    pub(crate) node: Option<Program>,
}

fn side(text: &str) -> Result<f64, String> {
    let side: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    if (0.005..=2.0).contains(&side) {
        Ok(side)
    } else {
        Err("cells have sides of 0.005 to 2 m".into())
    }
}
