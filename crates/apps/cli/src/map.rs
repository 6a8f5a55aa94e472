//! `periplus map`.

mod draw;
mod options;
mod serve;

use std::process::ExitCode;
use std::time::Duration;

use periplus_maps::{CompareOptions, Wish};
use periplus_ros2cli::map::{self, Convert, Diff, SaverCommand};

use crate::error::CliError;
use crate::terminal::{complain, say};
use crate::verbs::{Common, with_session, without_network};

pub(crate) use options::MapCommand;
use options::{ConvertOptions, DiffOptions, SaveOptions};

pub(crate) fn run(command: &MapCommand, ros: Vec<String>) -> Result<ExitCode, CliError> {
    if !ros.is_empty() && !matches!(command, MapCommand::Serve(_) | MapCommand::Save(_)) {
        return Err(CliError::usage("`--ros-args` require `periplus map serve` and `save`"));
    }
    let common = |json: bool| Common { json, ..Common::default() };
    match command {
        MapCommand::Draw(options) => draw::run(options),
        MapCommand::Save(options) => save(options, &ros),
        MapCommand::Serve(options) => serve::run(options, ros),
        MapCommand::Info(options) => without_network(&common(options.json), |session| {
            map::info(session, &options.path, options.distro)
        }),
        MapCommand::Convert(options) => without_network(&common(options.json), |session| {
            map::convert(session, &conversion(options))
        }),
        MapCommand::Diff(options) => without_network(&common(options.json), |session| {
            map::diff(session, &difference(options))
        }),
    }
}

/// The arguments are those of the ROS map savers, whose parsers read them.
fn save(options: &SaveOptions, ros: &[String]) -> Result<ExitCode, CliError> {
    let timeout = options.timeout.map(Duration::from_secs_f64);
    match map::saver_command(&options.words, ros, options.distro, timeout) {
        SaverCommand::Save(save) => {
            let common = Common { network: options.network, ..Common::default() };
            with_session(&common, |session| map::save(session, &save))
        }
        SaverCommand::Help(text) => {
            say(&text);
            Ok(ExitCode::SUCCESS)
        }
        SaverCommand::Wrong { message, exit_code } => {
            complain(&message);
            Err(CliError::Reported(exit_code))
        }
    }
}

fn conversion(options: &ConvertOptions) -> Convert {
    Convert {
        path: options.path.clone(),
        from: options.from,
        wish: Wish {
            name: options.output.clone(),
            image_format: options.fmt.clone().unwrap_or_default(),
            mode: options.mode.clone().unwrap_or_default(),
            occupied_thresh: options.occ.unwrap_or_default(),
            free_thresh: options.free.unwrap_or_default(),
        },
        to: options.to,
    }
}

fn difference(options: &DiffOptions) -> Diff {
    Diff {
        first: options.first.clone(),
        other: options.other.clone(),
        distro: options.distro,
        options: CompareOptions {
            align: !options.no_align,
            window_m: options.window,
            window_rad: options.turn.to_radians(),
        },
        picture: options.picture.clone(),
    }
}
