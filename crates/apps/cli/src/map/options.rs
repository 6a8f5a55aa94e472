//! What can be typed behind `periplus map`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use periplus_maps::Distro;

use crate::verbs::seconds;

/// Save, serve, show, convert and compare maps
#[derive(Debug, Subcommand)]
pub(crate) enum MapCommand {
    Save(SaveOptions),
    Serve(ServeOptions),
    Info(InfoOptions),
    Convert(ConvertOptions),
    Diff(DiffOptions),
}

/// Save the map of a topic, with the words of `map_saver_cli`, or with `--distro noetic` those of
/// `map_saver`
///
/// `periplus map save -f maps/room` writes `maps/room.yaml` and `maps/room.pgm`, byte for byte as the
/// saver of ROS does. `periplus map save -h` lists all words. Exit code 1 when there is no map, 255
/// for wrong words.
#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub(crate) struct SaveOptions {
    /// As whose saver: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Wait so long for the map; 2 without it, in ROS 1 until it comes
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) timeout: Option<f64>,
    /// The words of the saver: `-t TOPIC -f NAME --occ SHARE --free SHARE --fmt FORMAT --mode MODE`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "WORD")]
    pub(crate) words: Vec<String>,
}

/// Serve a map, as the node `map_server`: on `/map` and `/map_metadata`, through the services
/// `/map_server/map` and `/map_server/load_map`
///
/// It is a managed node that configures and activates itself, unless `--managed` leaves that to a
/// lifecycle manager. All of `--ros-args` is understood: `-p yaml_filename:=room.yaml`,
/// `-r __node:=other`.
#[derive(Debug, Args)]
pub(crate) struct ServeOptions {
    /// The YAML of the map
    pub(crate) path: Option<String>,
    /// The topic of the map
    #[arg(long, value_name = "TOPIC")]
    pub(crate) topic_name: Option<String>,
    /// The frame of the map
    #[arg(long, value_name = "FRAME")]
    pub(crate) frame_id: Option<String>,
    /// Whose rules apply to the files: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Wait until others configure and activate it
    #[arg(long)]
    pub(crate) managed: bool,
    /// Rename a topic or the node: `from:=to`
    #[arg(long = "remap", short = 'r', value_name = "FROM:=TO")]
    pub(crate) remaps: Vec<String>,
    /// What some tutorials write for `map save -f`
    #[arg(short = 'f', value_name = "NAME", hide = true)]
    pub(crate) file: Option<String>,
}

/// Tell what a map is: size, place, how much is free, occupied and unknown
#[derive(Debug, Args)]
pub(crate) struct InfoOptions {
    /// The YAML of the map
    pub(crate) path: String,
    /// Whose rules apply: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Save a map in another format or mode, or as another saver does
#[derive(Debug, Args)]
pub(crate) struct ConvertOptions {
    /// The YAML of the map
    pub(crate) path: String,
    /// Path of the new files, without ending
    #[arg(long, short, value_name = "NAME")]
    pub(crate) output: String,
    /// pgm, png or bmp; png in mode scale, else pgm
    #[arg(long, value_name = "FORMAT")]
    pub(crate) fmt: Option<String>,
    /// trinary, scale or raw
    #[arg(long, value_name = "MODE")]
    pub(crate) mode: Option<String>,
    /// From this share on a cell is occupied, 0 to 1
    #[arg(long, value_name = "SHARE")]
    pub(crate) occ: Option<f64>,
    /// Up to this share a cell is free, 0 to 1
    #[arg(long, value_name = "SHARE")]
    pub(crate) free: Option<f64>,
    /// Whose rules apply to the map: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) from: Distro,
    /// As whose saver the new files are written
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) to: Distro,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Tell how two maps differ
///
/// The second map is laid over the first so that walls meet walls, then cells are compared:
/// intersection over union of walls, of walls within a cell, of free and of known cells; and how far
/// the walls of each are from those of the other.
#[derive(Debug, Args)]
pub(crate) struct DiffOptions {
    /// The YAML of the first map
    pub(crate) first: String,
    /// The YAML of the other map
    pub(crate) other: String,
    /// Compare the maps where their files put them
    #[arg(long)]
    pub(crate) no_align: bool,
    /// How far the other map may be shifted \[m\]
    #[arg(long, value_name = "METRES", default_value_t = 1.5, value_parser = window)]
    pub(crate) window: f64,
    /// How far the other map may be turned \[deg\]
    #[arg(long, value_name = "DEGREES", default_value_t = 10.0, value_parser = window)]
    pub(crate) turn: f64,
    /// Write a picture of both (PNG)
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    /// Whose rules apply: jazzy (and later), humble, noetic
    #[arg(long, value_name = "NAME", default_value = "jazzy", value_parser = distro)]
    pub(crate) distro: Distro,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

fn distro(word: &str) -> Result<Distro, String> {
    Distro::from_name(word).ok_or_else(|| "it has to be jazzy, humble or noetic".into())
}

/// A size of a window that a search can end in.
fn window(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if (0.0..=360.0).contains(&number) => Ok(number),
        _ => Err("it has to be a number from 0 to 360".into()),
    }
}
