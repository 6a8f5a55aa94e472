//! `periplus doctor costmap`.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use periplus_costmap::Nav2Release;
use periplus_session::nodes::read_costmaps;

use crate::error::CliError;
use crate::terminal;

/// Check the costmaps of a Nav2 parameter file
///
/// Reports unread parameters, unknown layers, and sources that can never mark or clear, each with
/// its line and a correction. `periplus sim WORLD --costmap FILE` runs the costmaps and reports
/// dropped points. Exit code 1: an error.
#[derive(Debug, Args)]
pub(crate) struct DoctorCostmapOptions {
    /// Parameter file
    #[arg(value_name = "nav2_params.yaml")]
    file: PathBuf,
    /// Release of Nav2 whose behaviour is reproduced where releases differ
    #[arg(long, value_name = "humble|jazzy|main")]
    compat: Option<Nav2Release>,
}

pub(crate) fn run(options: &DoctorCostmapOptions) -> Result<ExitCode, CliError> {
    let mut file = read_costmaps(&options.file, options.compat)?;
    file.add_layer_findings();
    let mut out = anstream::stdout().lock();
    terminal::diagnostics(&mut out, &file.diagnostics, &file.sources)?;
    for (name, config) in &file.configs {
        let info = config.info();
        let frame = config.frame();
        writeln!(
            out,
            "{name}: {} x {} cells of {} m in `{}`{}, as {}",
            info.width,
            info.height,
            info.resolution_m,
            frame.global_frame,
            if frame.is_rolling { ", moving with the robot" } else { "" },
            config.compat,
        )?;
        for layer in config.layers.iter().chain(&config.filters) {
            writeln!(out, "  {} ({:?})", layer.name, layer.kind)?;
            for source in &layer.sources {
                let settings = source.settings();
                writeln!(
                    out,
                    "    {}: {:?} on {}, {}{} from {} m to {} m above the floor",
                    source.name,
                    settings.data_type,
                    settings.topic,
                    if settings.is_marking { "marks" } else { "does not mark" },
                    if settings.is_clearing { " and clears" } else { " and does not clear" },
                    settings.heights.min_m,
                    settings.heights.max_m,
                )?;
            }
        }
    }
    let is_sick = file.diagnostics.has_errors();
    Ok(if is_sick { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
