//! `periplus rerun`.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use clap::{Args, ValueEnum};
use periplus_session::rerun::{RerunKind, RerunRequest, job_parameters, rerun};
use serde_json::{Value, json};

use crate::error::CliError;
use crate::score::put_json;
use crate::terminal::{self, complain, say};

/// Run SLAM, AMCL or costmaps over a recording with other parameters, and record their results
///
/// The nodes of slam_toolbox, amcl or Nav2's costmaps get the sensor data of the recording in its time, and their topics are
/// written to an MCAP file on the same time base: map over time, transforms, poses, particles, costmaps, and the trajectory on
/// /trajectory. The recording's own estimates do not reach them: the transform to the odometry frame, and for SLAM the map. The
/// same recording and parameters give the same bytes. Exit code 1: the recording lacks something, or there is no estimate.
#[derive(Debug, Args)]
pub(crate) struct RerunOptions {
    /// Estimators
    #[arg(value_enum)]
    kind: Kind,
    /// Recording (.mcap, .db3, .bag, or a folder of `ros2 bag`)
    #[arg(value_name = "RECORDING", required_unless_present = "list")]
    recording: Option<PathBuf>,
    /// MCAP file to write [default: RECORDING with `_slam`, `_amcl` or `_costmap`]
    #[arg(long, short = 'o', value_name = "FILE.mcap")]
    output: Option<PathBuf>,
    /// Parameter of a node; repeatable
    #[arg(long = "param", short = 'p', value_name = "NAME:=VALUE")]
    parameters: Vec<String>,
    /// Print all parameters with type, default, range and description as JSON
    #[arg(long)]
    list: bool,
    /// Print no progress and no summary
    #[arg(long, short)]
    quiet: bool,
}

/// Estimators of a rerun.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    /// Mapping by the node of slam_toolbox
    Slam,
    /// Localization on the last map of the recording, or on that of the parameter `map_file`
    Amcl,
    /// Both costmaps of Nav2
    Costmap,
}

/// Steps of the progress bar.
const PROGRESS_STEPS: u64 = 1000;

pub(crate) fn run(options: &RerunOptions) -> Result<ExitCode, CliError> {
    let kind = match options.kind {
        Kind::Slam => RerunKind::Slam,
        Kind::Amcl => RerunKind::Amcl,
        Kind::Costmap => RerunKind::Costmap,
    };
    if options.list {
        put_json(&job_parameters(kind).map_err(CliError::failed)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let Some(recording) = &options.recording else {
        return Err(CliError::usage("name a recording"));
    };
    let mut parameters: BTreeMap<String, Value> = BTreeMap::new();
    for word in &options.parameters {
        let Some((name, value)) = word.split_once(":=").filter(|(name, _)| !name.is_empty()) else {
            return Err(CliError::usage(format!(
                "`-p {word}`: write a parameter as `name:=value`"
            )));
        };
        parameters.insert(name.to_owned(), json!(value));
    }
    let out = options.output.clone().unwrap_or_else(|| {
        let stem = recording.file_stem().unwrap_or_default().to_string_lossy();
        recording.with_file_name(format!("{stem}_{}.mcap", kind.name()))
    });
    let request = RerunRequest { kind, recording: recording.clone(), parameters, out };
    let bar = terminal::bar(PROGRESS_STEPS, "per mille", options.quiet);
    let shown = Cell::new(0);
    let progress = |part: f32| {
        let step = (f64::from(part) * PROGRESS_STEPS as f64) as u64;
        if shown.replace(step) != step {
            bar.set_position(step);
        }
    };
    let done = rerun(&request, &progress, &AtomicBool::new(false));
    bar.finish_and_clear();
    let summary = done.map_err(CliError::failed)?;
    summary.faults.iter().for_each(|fault| complain(fault));
    if !options.quiet {
        say(&format!(
            "{}: {} messages from {} of the recording",
            request.out.display(),
            summary.recorded,
            summary.played
        ));
    }
    Ok(if summary.faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
