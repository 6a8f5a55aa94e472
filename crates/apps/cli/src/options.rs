//! Command-line options.

use std::path::PathBuf;

use anstream::ColorChoice;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::bag::BagCommand;
use crate::bridge::BridgeOptions;
use crate::calibrate::CalibrateOptions;
use crate::compare::RunComparisonOptions;
use crate::conformance::ConformanceOptions;
use crate::costmap::serve::CostmapServeOptions;
use crate::dataset::DatasetOptions;
use crate::demo::DemoOptions;
use crate::doctor::DoctorOptions;
use crate::launch::LaunchOptions;
use crate::localize::LocalizeOptions;
use crate::look::LookOptions;
use crate::map::MapCommand;
use crate::mcp::McpOptions;
use crate::navigate::NavigateOptions;
use crate::new::NewCommand;
use crate::program::RunOptions;
use crate::report::ReportOptions;
use crate::rerun::RerunOptions;
use crate::ros1::Ros1Command;
use crate::scenario::ScenarioOptions;
use crate::schema::SchemaOptions;
use crate::score::ScoreOptions;
use crate::sim::SimOptions;
use crate::slam::SlamOptions;
use crate::sweep::SweepOptions;
use crate::teleop::TeleopOptions;
use crate::verbs::{
    ActionOptions, InterfaceOptions, LifecycleOptions, NodeOptions, ParamOptions, ServiceOptions,
    TfOptions, TopicOptions,
};
use crate::view::ViewOptions;

/// Simulates mobile robots, builds maps, localizes and keeps costmaps from existing URDF, SDF and
/// launch files. It needs no ROS, Gazebo or GPU, and appears on the network as ordinary ROS 2,
/// Gazebo and Foxglove nodes.
///
/// Without a command it runs `periplus demo`: a robot in a room, on a page in the browser.
#[derive(Debug, Parser)]
#[command(name = "periplus", version, max_term_width = 100)]
pub(crate) struct Options {
    /// Use of colours
    #[arg(long = "color", value_enum, default_value_t = Colour::Auto, global = true, value_name = "WHEN")]
    pub(crate) colour: Colour,
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    #[command(subcommand)]
    Bag(BagCommand),
    Calibrate(Box<CalibrateOptions>),
    Check(CheckOptions),
    Compare(RunComparisonOptions),
    Convert(ConvertOptions),
    Demo(DemoOptions),
    Launch(LaunchOptions),
    #[command(subcommand)]
    New(NewCommand),
    Report(Box<ReportOptions>),
    Rerun(RerunOptions),
    Run(RunOptions),
    Sim(Box<SimOptions>),
    Score(ScoreOptions),
    Slam(SlamOptions),
    Localize(LocalizeOptions),
    Look(Box<LookOptions>),
    Dataset(Box<DatasetOptions>),
    Navigate(Box<NavigateOptions>),
    Scenario(Box<ScenarioOptions>),
    Sweep(Box<SweepOptions>),
    Topic(TopicOptions),
    Node(NodeOptions),
    Service(ServiceOptions),
    Param(ParamOptions),
    Action(ActionOptions),
    Lifecycle(LifecycleOptions),
    Interface(InterfaceOptions),
    Tf(TfOptions),
    /// Print the completion script for a shell
    Completions {
        /// Shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or write one per command to a folder
    Man {
        /// Output folder, such as /usr/local/share/man/man1
        folder: Option<PathBuf>,
    },
    Teleop(TeleopOptions),
    View(ViewOptions),
    #[command(subcommand)]
    Map(MapCommand),
    Mcp(McpOptions),
    Costmap(CostmapServeOptions),
    Bridge(BridgeOptions),
    #[command(subcommand)]
    Ros1(Ros1Command),
    Conformance(ConformanceOptions),
    Schema(SchemaOptions),
    Doctor(Box<DoctorOptions>),
}

/// Check robots, worlds and other files, and show their contents
///
/// Reads URDF, xacro (expanded with `name:=value`), SDF and worlds of every version, launch files,
/// map YAML, parameter files, RViz files, and meshes (STL, OBJ, COLLADA, glTF). Exit code 1: an
/// error.
#[derive(Debug, Args)]
pub(crate) struct CheckOptions {
    /// Files, and `name:=value` for xacro
    #[arg(required = true, value_name = "FILE|NAME:=VALUE")]
    pub(crate) words: Vec<String>,
    /// Print findings and contents as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print findings only, without the contents
    #[arg(long, short)]
    pub(crate) quiet: bool,
    /// Exit with 1 for warnings, too
    #[arg(long)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) search: SearchOptions,
}

/// Convert a file: expand xacro, convert URDF to SDF, upgrade old SDF, resolve all poses, or build
/// a world from a map or floor plan
///
/// The result is written to stdout or to `--output`, findings to stderr. The occupied cells of a
/// map YAML, or of an image with `--resolution`, become walls, merged to boxes, in the frame of the
/// map.
#[derive(Debug, Args)]
pub(crate) struct ConvertOptions {
    /// File, and `name:=value` for xacro
    #[arg(required = true, value_name = "FILE|NAME:=VALUE")]
    pub(crate) words: Vec<String>,
    /// Output format
    #[arg(long, value_enum)]
    pub(crate) to: Format,
    /// Convert only this model of the file
    #[arg(long, value_name = "NAME")]
    pub(crate) model: Option<String>,
    /// Output file
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Output folder of `--to harmonic`: the new files, MIGRATION.md, migration.json and topics for ros_gz_bridge
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Convert to harmonic without simulating the old and the new files side by side
    #[arg(long)]
    pub(crate) no_compare: bool,
    /// Print the report of `--to harmonic` as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Pixel size of a floor plan [m]; dark pixels become walls
    #[arg(long, value_name = "METRES", value_parser = positive_metres)]
    pub(crate) resolution: Option<f64>,
    /// Height of the walls [m]
    #[arg(long, value_name = "METRES", default_value_t = 2.5, value_parser = positive_metres)]
    pub(crate) wall_height: f64,
    #[command(flatten)]
    pub(crate) search: SearchOptions,
}

/// Maximum length of an option \[m\].
const MAX_LENGTH_M: f64 = 1e4;

fn positive_metres(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length_m) if length_m > 0.0 && length_m <= MAX_LENGTH_M => Ok(length_m),
        _ => Err(format!("expected a length above 0 and at most {MAX_LENGTH_M} m")),
    }
}

#[derive(Debug, Args)]
pub(crate) struct SearchOptions {
    /// Folder to search for packages, models and meshes, before GZ_SIM_RESOURCE_PATH,
    /// GAZEBO_MODEL_PATH, ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and the folders around the file;
    /// repeatable
    #[arg(long, value_name = "DIR")]
    pub(crate) resource_path: Vec<PathBuf>,
}

/// Output format of a conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A robot description; a xacro file is expanded
    Urdf,
    /// World or model
    Sdf,
    /// Resolved scene as JSON
    Json,
    /// Files of Gazebo Classic for Gazebo Harmonic, with a report and a comparison run
    Harmonic,
}

/// Use of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

impl Colour {
    /// Applies the choice to all output.
    pub(crate) fn apply(self) {
        match self {
            Self::Auto => ColorChoice::Auto,
            Self::Always => ColorChoice::Always,
            Self::Never => ColorChoice::Never,
        }
        .write_global();
    }
}

/// Splits words into files and `name:=value`.
pub(crate) fn split(words: &[String]) -> (Vec<PathBuf>, Vec<(String, String)>) {
    let mut files = Vec::new();
    let mut arguments = Vec::new();
    for word in words {
        match word.split_once(":=") {
            Some((name, value)) => arguments.push((name.to_owned(), value.to_owned())),
            None => files.push(PathBuf::from(word)),
        }
    }
    (files, arguments)
}
