//! Options of `periplus localize`.

use std::path::{Path, PathBuf};

use clap::Args;
use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;
use periplus_maps::{Distro, load};
use periplus_params::ParamValues;
use periplus_session::RunError;
use periplus_session::nodes::{ParameterFile, amcl_parameters};

use crate::error::CliError;
use crate::log::LogOptions;
use crate::run_options::{LiveNetworkOptions, finite_numbers};
use crate::terminal;

/// Localize a robot on a known map, from a log of laser scans or live
///
/// LOG is a CARMEN log or a recording of ROS 1 or ROS 2 (.bag, .mcap, .db3, a folder of `ros2
/// bag`). DIR receives trajectory.txt (one line per scan: `stamp x y theta`), trajectory.png and
/// report.json with each change of the localization state and its reason. With `--live` it runs as
/// the node `amcl` on ROS 2. The exit code is 1 if the robot was never localized.
#[derive(Debug, Args)]
pub(crate) struct LocalizeOptions {
    /// CARMEN log, or recording of ROS 1 or ROS 2
    #[arg(value_name = "LOG", required_unless_present = "live", conflicts_with = "live")]
    pub(crate) log: Option<PathBuf>,
    /// Run as the node `amcl` on ROS 2
    #[arg(long)]
    pub(crate) live: bool,
    /// YAML of the map; with `--live` it is also served [default with --live: the map topic]
    #[arg(long, value_name = "MAP.yaml", required_unless_present = "live")]
    pub(crate) map: Option<PathBuf>,
    /// Output folder
    #[arg(long, short, value_name = "DIR", required_unless_present = "live")]
    pub(crate) out: Option<PathBuf>,
    /// Parameter file of `amcl`, in the format of Nav2 or ROS 1
    #[arg(long, value_name = "FILE")]
    pub(crate) params_file: Option<PathBuf>,
    /// Parameter of `amcl`; overrides the file
    #[arg(long = "param", short = 'p', value_name = "NAME:=VALUE", value_parser = word)]
    pub(crate) parameters: Vec<(String, String)>,
    /// Seed of the random numbers
    #[arg(long, value_name = "NUMBER")]
    pub(crate) seed: Option<i64>,
    /// Initial pose of the robot [m, rad] [default: global localization]
    #[arg(long, value_name = "X,Y,YAW", value_parser = pose, allow_hyphen_values = true)]
    pub(crate) initial_pose: Option<Pose2>,
    /// Skip this many seconds at the beginning of the log
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0)]
    pub(crate) skip: f64,
    #[command(flatten)]
    pub(crate) input: LogOptions,
    /// Print only errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

fn word(word: &str) -> Result<(String, String), String> {
    let (name, value) = word.split_once(":=").ok_or("expected NAME:=VALUE")?;
    // `--ros-args` accepts `amcl:name`.
    let name = name.strip_prefix("amcl:").unwrap_or(name);
    Ok((name.to_owned(), value.to_owned()))
}

fn pose(word: &str) -> Result<Pose2, String> {
    match finite_numbers(word).as_deref() {
        Some(&[x, y, yaw]) => Ok(Pose2::new(x, y, yaw)),
        _ => Err(format!("`{word}` is not a pose; write X,Y,YAW")),
    }
}

impl LocalizeOptions {
    /// All parameters of `amcl`; prints the findings.
    pub(crate) fn values(&self) -> Result<ParamValues, CliError> {
        let mut words = self.parameters.clone();
        let mut word = |name: &str, value: String| words.push((name.to_owned(), value));
        if let Some(Pose2 { x_m, y_m, yaw_rad }) = self.initial_pose {
            word("set_initial_pose", "true".into());
            for (name, value) in [("x", x_m), ("y", y_m), ("yaw", yaw_rad)] {
                word(&format!("initial_pose.{name}"), value.to_string());
            }
        }
        if let Some(seed) = self.seed {
            word("random_seed", seed.to_string());
        }
        let file = self.params_file.as_deref().map(ParameterFile::read).transpose();
        amcl_parameters(file.map_err(CliError::usage)?, &words).map_err(|error| match error {
            RunError::Reported => CliError::Reported(2),
            error => error.into(),
        })
    }
}

/// Reads a map and prints its findings.
pub(crate) fn map_grid(path: &Path) -> Result<OccupancyGrid, CliError> {
    let loaded = load(&path.to_string_lossy(), Distro::Jazzy, &periplus_os::Machine);
    let mut err = anstream::stderr().lock();
    terminal::diagnostics(&mut err, &loaded.diagnostics, &loaded.sources)?;
    let unusable = || CliError::failed(format!("{} is not a usable map", path.display()));
    loaded.map.map(|map| map.grid).ok_or_else(unusable)
}
