//! `periplus slam`.

mod live;
mod options;
mod parameters;
mod report;
mod session;

use std::path::Path;
use std::process::ExitCode;

use periplus_geometry::Pose2;
use periplus_maps::{Distro, PgmRows, Saving, render_yaml};
use periplus_os::Stopwatch;
use periplus_params::Params as _;
use periplus_session::picture::draw_by;
use periplus_slam::tables::MountingParams;
use periplus_slam::{CorrectedInput, Mapper, MountingCorrection};

use crate::error::CliError;
use crate::log::{Log, LogOptions};
use crate::{paths, terminal};
use parameters::Parameters;
use report::Report;
use session::SelectedMapper;

pub(crate) use options::SlamOptions;

pub(crate) fn run(options: &SlamOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    if options.live.live {
        return live::run(options, ros);
    }
    if !ros.is_empty() {
        return Err(CliError::usage("`--ros-args` require `periplus slam --live`"));
    }
    from_log(options)
}

fn from_log(options: &SlamOptions) -> Result<ExitCode, CliError> {
    let watch = Stopwatch::start();
    let parameters = Parameters::read(options).map_err(CliError::failed)?;
    let findings = &parameters.diagnostics;
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &parameters.sources)?;
    if findings.has_errors() {
        return Ok(ExitCode::FAILURE);
    }
    let input = parameters.input(&options.input);
    let mut run = map(options, &parameters, &input, None)?;
    let is_corrected = MountingParams::from_values(&parameters.values).correct_mounting;
    let remedy = MountingCorrection::of(run.selected.mapper().remarks())
        .filter(|_| options.session.is_none() && is_corrected);
    if remedy.is_some() {
        // An error of mounting or axes is certain: the map is rebuilt with corrected data.
        drop(run);
        run = map(options, &parameters, &input, remedy)?;
    }
    let Run { log, selected, before, spent_s, used, saved, loaded_s, finish_s } = run;
    let slam = selected.mapper();
    let stamps: Vec<String> = used.iter().map(|&number| log.scans[number].stamp()).collect();
    let report = Report {
        options,
        slam,
        parameters: &parameters,
        log: &log,
        loaded_s,
        finish_s,
        wall_s: watch.elapsed().as_secs_f64(),
        spent_s: &spent_s,
        remedy,
    };
    // The report is last, so that it contains the peak memory.
    let written = saved
        .and_then(|()| match (&options.g2o, selected.graph()) {
            (Some(path), Some(graph)) => put(path, graph.to_g2o().as_bytes()),
            _ => Ok(()),
        })
        .and_then(|()| write(&options.out, slam, (&stamps, before), &report));
    if !options.quiet {
        report.tell(&mut anstream::stdout().lock(), written.is_ok())?;
    }
    if let Err(why) = written {
        return Err(CliError::failed(why));
    }
    for fault in log.faults.iter().take(MAX_PRINTED) {
        terminal::complain(fault);
    }
    if let Some(why) = report.failure() {
        return Err(CliError::failed(why));
    }
    Ok(if log.faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Result of mapping a log.
struct Run {
    /// The log without its ranges: they are most of its memory, and the map has copied what it
    /// needs.
    log: Log,
    selected: SelectedMapper,
    /// Number of poses of the session, which precede those of the log in the trajectory.
    before: usize,
    /// CPU time per scan \[s\].
    spent_s: Vec<f64>,
    /// Indices in the log of the scans in the trajectory.
    used: Vec<usize>,
    /// Result of writing the requested session.
    saved: Result<(), String>,
    /// Time to read the log, and of the last optimization \[s\].
    loaded_s: f64,
    finish_s: f64,
}

/// Maps the log, with corrected data when an error of it is known.
fn map(
    options: &SlamOptions,
    parameters: &Parameters,
    input: &LogOptions,
    remedy: Option<MountingCorrection>,
) -> Result<Run, CliError> {
    let watch = Stopwatch::start();
    let mut log = Log::open(&options.log, input)?;
    if log.scans.is_empty() {
        return Err(CliError::failed(format!("{} has no scans", options.log.display())));
    }
    let mut selected = SelectedMapper::new(options, parameters)?;
    let before = selected.mapper().trajectory().len();
    let loaded_s = watch.elapsed().as_secs_f64();
    let bar = terminal::bar(log.scans.len() as u64, "scans", options.quiet);
    let mut cure = remedy.map(CorrectedInput::new);
    let (mut spent_s, mut used) = (Vec::with_capacity(log.scans.len()), Vec::new());
    let slam = selected.mapper_mut();
    for (number, logged) in log.scans.iter_mut().enumerate().step_by(parameters.every()) {
        bar.set_position(number as u64);
        let one = Stopwatch::start();
        let ignored = slam.counts().ignored;
        let _ = match &mut cure {
            Some(cure) => {
                let (scan, odom_from_base) = cure.apply(&logged.scan, logged.odom_from_base);
                slam.add_scan(&scan, odom_from_base)
            }
            None => slam.add_scan(&logged.scan, logged.odom_from_base),
        };
        spent_s.push(one.elapsed().as_secs_f64());
        if slam.counts().ignored == ignored {
            used.push(number);
        }
        logged.scan.ranges_m = Vec::new();
    }
    bar.finish_and_clear();
    let saved = save(options, &selected);
    let last = Stopwatch::start();
    selected.mapper_mut().finish();
    let finish_s = last.elapsed().as_secs_f64();
    Ok(Run { log, selected, before, spent_s, used, saved, loaded_s, finish_s })
}

/// Writes the requested session.
fn save(options: &SlamOptions, selected: &SelectedMapper) -> Result<(), String> {
    match (&options.save_session, selected.graph()) {
        (Some(path), Some(graph)) => put(path, &graph.save()),
        _ => Ok(()),
    }
}

/// Number of log errors that are printed.
const MAX_PRINTED: usize = 20;

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    paths::write(path, bytes).map_err(|error| error.to_string())
}

/// Writes all results of a run.
///
/// The trajectory contains the scans of this log; `before` poses of a session precede them.
fn write(
    out: &Path,
    slam: &dyn Mapper,
    (stamps, before): (&[String], usize),
    report: &Report<'_>,
) -> Result<(), String> {
    paths::make_folder(out).map_err(|error| error.to_string())?;
    let put = |name: &str, bytes: &[u8]| put(&out.join(name), bytes);
    let trajectory = slam.trajectory();
    let lines: String = stamps
        .iter()
        .zip(trajectory.iter().skip(before))
        .map(|(stamp, (_, pose))| {
            format!("{stamp} {:.6} {:.6} {:.6}\n", pose.x_m, pose.y_m, pose.yaw_rad)
        })
        .collect();
    put("trajectory.txt", lines.as_bytes())?;
    let drawn = draw(out, slam, &trajectory);
    put("report.json", format!("{:#}\n", report.to_json()).as_bytes())?;
    drawn
}

/// Draws the map, the trajectory, and a ring where passes contradict each other, some rows at a
/// time: large maps are never in memory as a whole.
fn draw(out: &Path, slam: &dyn Mapper, trajectory: &[(i64, Pose2)]) -> Result<(), String> {
    let Some(plan) = slam.plan() else {
        return Err("the map is too large to draw; try `--max-range 30` or a coarser \
                    `--resolution`. The trajectory is written"
            .into());
    };
    let info = plan.info();
    let saving = Saving::new("map", Distro::Jazzy);
    let (image_path, yaml_path, yaml) = render_yaml(&info, &saving);
    let poses: Vec<_> = trajectory.iter().map(|(_, pose)| *pose).collect();
    let marked = slam.contradictions().into_iter().map(|it| it.map_from_base);
    let marked: Vec<_> = marked.map(|it| (it.x_m, it.y_m)).collect();
    let mut png = Vec::new();
    paths::write_by(&out.join(image_path), |image| {
        let mut rows = PgmRows::begin(image, &info, &saving)?;
        png = draw_by(info, &poses, &marked, |picture| {
            let at_once = (CELLS_AT_ONCE / info.width.max(1)).max(1);
            let mut top = info.height;
            while top > 0 {
                let low = top.saturating_sub(at_once);
                for row in plan.rows(low..top).rows().rev() {
                    rows.push(row)?;
                    picture.push(row)?;
                }
                top = low;
            }
            Ok(())
        })?;
        Ok(())
    })
    .map_err(|error| error.to_string())?;
    put(&out.join(yaml_path), yaml.as_bytes())?;
    put(&out.join("trajectory.png"), &png)
}

/// Number of cells drawn at once, about 3 MB.
const CELLS_AT_ONCE: usize = 1 << 20;
