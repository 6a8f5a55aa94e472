//! Options of `periplus map`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use periplus_maps::Distro;

use crate::options::SearchOptions;
use crate::run_options::{LiveNetworkOptions, finite_numbers, positive};
use crate::verbs::seconds;

/// Draw, save, serve, inspect, convert and compare maps
#[derive(Debug, Subcommand)]
pub(crate) enum MapCommand {
    Draw(DrawOptions),
    Save(SaveOptions),
    Serve(ServeOptions),
    Info(InfoOptions),
    Convert(ConvertOptions),
    Diff(DiffOptions),
}

/// Draw the map of a world from its shapes, without driving there
///
/// Walls are where a collision is at the height of a lidar; free is what can be reached from the start. The frame of
/// the map is that of the world.
#[derive(Debug, Args)]
pub(crate) struct DrawOptions {
    /// World, and `name:=value` for its xacro
    #[arg(value_name = "WORLD|NAME:=VALUE", required = true)]
    pub(crate) words: Vec<String>,
    /// Name of the files: NAME.yaml and NAME.pgm
    #[arg(long = "file", short = 'f', value_name = "NAME", default_value = "map")]
    pub(crate) name: PathBuf,
    /// Point of the free floor [m]
    #[arg(long, value_name = "X,Y", default_value = "0,0", allow_hyphen_values = true, value_parser = point)]
    pub(crate) start: [f64; 2],
    /// Height of the slice above the origin of the world [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.2, allow_hyphen_values = true)]
    pub(crate) height: f64,
    /// Side of a cell [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.05, value_parser = positive)]
    pub(crate) resolution: f64,
    /// Maximum side of the map [m]; matters for a floor that no walls enclose
    #[arg(long, value_name = "METRES", default_value_t = 160.0, value_parser = positive)]
    pub(crate) max_side: f64,
    #[command(flatten)]
    pub(crate) search: SearchOptions,
}

/// Parses a point \[m\].
fn point(word: &str) -> Result<[f64; 2], String> {
    match finite_numbers(word).as_deref() {
        Some(&[x_m, y_m]) => Ok([x_m, y_m]),
        _ => Err(format!("`{word}` is not a point; write X,Y")),
    }
}

/// Save the map of a topic, with the arguments of `map_saver_cli`, or with `--distro noetic` those
/// of `map_saver`
///
/// `periplus map save -f maps/room` writes `maps/room.yaml` and `maps/room.pgm`, byte for byte as
/// the saver of ROS does. `periplus map save -h` lists all arguments. Exit code 1: no map; 255:
/// wrong arguments.
#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub(crate) struct SaveOptions {
    /// Saver to reproduce: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Time to wait for the map [s] [default: 2; for ROS 1 unlimited]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) timeout: Option<f64>,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
    /// Arguments of the saver: `-t TOPIC -f NAME --occ SHARE --free SHARE --fmt FORMAT --mode MODE`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "WORD")]
    pub(crate) words: Vec<String>,
}

/// Serve a map as the node `map_server`: on `/map`, `/map_metadata` and the services
/// `/map_server/map` and `/map_server/load_map`
///
/// A lifecycle node that configures and activates itself; with `--managed` it waits for a lifecycle
/// manager. `--ros-args` is understood: `-p yaml_filename:=room.yaml`, `-r __node:=other`.
#[derive(Debug, Args)]
pub(crate) struct ServeOptions {
    /// YAML of the map
    pub(crate) path: Option<String>,
    /// Topic of the map
    #[arg(long, value_name = "TOPIC")]
    pub(crate) topic_name: Option<String>,
    /// Frame of the map
    #[arg(long, value_name = "FRAME")]
    pub(crate) frame_id: Option<String>,
    /// Rules for reading the files: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Wait for a lifecycle manager to configure and activate it
    #[arg(long)]
    pub(crate) managed: bool,
    /// Remap a topic or the node: `from:=to`
    #[arg(long = "remap", short = 'r', value_name = "FROM:=TO")]
    pub(crate) remaps: Vec<String>,
    /// Hidden option of tutorials that mean `map save -f`
    #[arg(short = 'f', value_name = "NAME", hide = true)]
    pub(crate) file: Option<String>,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

/// Show size, origin, and the shares of free, occupied and unknown cells of a map
#[derive(Debug, Args)]
pub(crate) struct InfoOptions {
    /// YAML of the map
    pub(crate) path: String,
    /// Rules for reading the map: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Convert a map to another format or mode, or to the rules of another saver
#[derive(Debug, Args)]
pub(crate) struct ConvertOptions {
    /// YAML of the map
    pub(crate) path: String,
    /// Path of the output files, without extension
    #[arg(long, short, value_name = "NAME")]
    pub(crate) output: String,
    /// Image format: pgm, png or bmp (default png in mode scale, else pgm)
    #[arg(long, value_name = "FORMAT")]
    pub(crate) fmt: Option<String>,
    /// trinary, scale or raw
    #[arg(long, value_name = "MODE")]
    pub(crate) mode: Option<String>,
    /// Minimum occupancy of occupied cells, 0 to 1
    #[arg(long, value_name = "SHARE")]
    pub(crate) occ: Option<f64>,
    /// Maximum occupancy of free cells, 0 to 1
    #[arg(long, value_name = "SHARE")]
    pub(crate) free: Option<f64>,
    /// Rules for reading the map: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) from: Distro,
    /// Saver to reproduce for the new files
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) to: Distro,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Compare two maps
///
/// The second map is aligned with the first, then cells are compared: intersection over union of
/// walls, of walls with a tolerance of one cell, of free and of known cells; and the distances
/// between the walls of both maps.
#[derive(Debug, Args)]
pub(crate) struct DiffOptions {
    /// YAML of the first map
    pub(crate) first: String,
    /// YAML of the second map
    pub(crate) other: String,
    /// Compare the maps at the origins of their files, without alignment
    #[arg(long)]
    pub(crate) no_align: bool,
    /// Maximum shift between the maps \[m\]
    #[arg(long, value_name = "METRES", default_value_t = 1.5, value_parser = window)]
    pub(crate) window: f64,
    /// Maximum rotation between the maps \[deg\]
    #[arg(long, value_name = "DEGREES", default_value_t = 10.0, value_parser = window)]
    pub(crate) turn: f64,
    /// Write an image of both maps (PNG)
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    /// Rules for reading the map: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

fn distro(word: &str) -> Result<Distro, String> {
    Distro::from_name(word).ok_or_else(|| "expected jazzy, humble or noetic".into())
}

/// Size of a search window.
fn window(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if (0.0..=360.0).contains(&number) => Ok(number),
        _ => Err("expected a number from 0 to 360".into()),
    }
}
