//! `periplus slam`.

mod live;
mod options;
mod parameters;
mod report;
mod session;

use std::io;
use std::path::Path;
use std::process::ExitCode;

use periplus_host::Stopwatch;
use periplus_maps::{Distro, Saving, render};
use periplus_slam::Mapper;

use crate::log::Log;
use crate::{paths, picture, terminal};
use parameters::Parameters;
use report::Report;
use session::Made;

pub(crate) use options::SlamOptions;

pub(crate) fn run(options: &SlamOptions, ros: Vec<String>) -> io::Result<ExitCode> {
    if options.live.live {
        return live::run(options, ros);
    }
    if !ros.is_empty() {
        terminal::complain("`--ros-args` are for `periplus slam --live`");
        return Ok(ExitCode::from(2));
    }
    from_log(options)
}

fn from_log(options: &SlamOptions) -> io::Result<ExitCode> {
    let watch = Stopwatch::start();
    let parameters = match Parameters::read(options) {
        Ok(parameters) => parameters,
        Err(why) => {
            terminal::complain(&why);
            return Ok(ExitCode::FAILURE);
        }
    };
    let findings = &parameters.diagnostics;
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &parameters.sources)?;
    if findings.has_errors() {
        return Ok(ExitCode::FAILURE);
    }
    let input = parameters.input(&options.input);
    let mut log = match Log::open(&options.log, &input)? {
        Ok(log) => log,
        Err(why) => {
            terminal::complain(&why);
            return Ok(ExitCode::FAILURE);
        }
    };
    if log.scans.is_empty() {
        terminal::complain(&format!("{} holds no scans", options.log.display()));
        return Ok(ExitCode::FAILURE);
    }
    let mut made = match Made::new(options, &parameters) {
        Ok(made) => made,
        Err(why) => {
            terminal::complain(&why);
            return Ok(ExitCode::FAILURE);
        }
    };
    let slam = made.mapper_mut();
    // Poses of the session have their places in the trajectory before those of the log.
    let before = slam.trajectory().len();
    let loaded_s = watch.elapsed().as_secs_f64();
    let mut spent_s = Vec::with_capacity(log.scans.len());
    // Which scans have a line in the trajectory.
    let mut stamps = Vec::with_capacity(log.scans.len());
    let bar = terminal::bar(log.scans.len() as u64, "scans", options.quiet);
    for (number, logged) in log.scans.iter().enumerate().step_by(parameters.every()) {
        bar.set_position(number as u64);
        let one = Stopwatch::start();
        let before = slam.counts().ignored;
        let _ = slam.add_scan(&logged.scan, logged.odom_from_base);
        spent_s.push(one.elapsed().as_secs_f64());
        if slam.counts().ignored == before {
            stamps.push(logged.stamp.as_str());
        }
    }
    bar.finish_and_clear();
    let saved = match (&options.save_session, made.graph()) {
        (Some(path), Some(graph)) => put(path, &graph.save()),
        _ => Ok(()),
    };
    let last = Stopwatch::start();
    made.mapper_mut().finish();
    let slam = made.mapper();
    let report = Report {
        options,
        slam,
        parameters: &parameters,
        log: &log,
        loaded_s,
        finish_s: last.elapsed().as_secs_f64(),
        wall_s: watch.elapsed().as_secs_f64(),
        spent_s: &spent_s,
    };
    let written = saved
        .and_then(|()| write(&options.out, slam, (&stamps, before), &report))
        .and_then(|()| match (&options.g2o, made.graph()) {
            (Some(path), Some(graph)) => put(path, graph.to_g2o().as_bytes()),
            _ => Ok(()),
        });
    if !options.quiet {
        report.tell(&mut anstream::stdout().lock(), written.is_ok())?;
    }
    if let Err(why) = written {
        terminal::complain(&why);
        return Ok(ExitCode::FAILURE);
    }
    log.faults.truncate(MOST_TOLD);
    for fault in &log.faults {
        terminal::complain(fault);
    }
    Ok(if log.faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// So many faults of a log are told one by one.
const MOST_TOLD: usize = 20;

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    paths::write(path, bytes)
}

/// Writes all that comes of a run.
///
/// The trajectory has the scans of this log; `before` poses of a session come before theirs.
fn write(
    out: &Path,
    slam: &dyn Mapper,
    (stamps, before): (&[&str], usize),
    report: &Report<'_>,
) -> Result<(), String> {
    paths::make_folder(out)?;
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
    put("report.json", format!("{:#}\n", report.to_json()).as_bytes())?;
    let Some(map) = slam.map() else {
        return Err("the map is too large to draw; try `--max-range 30` or a coarser \
                    `--resolution`. The trajectory is written"
            .into());
    };
    let files = render(&map, &Saving::new("map", Distro::Jazzy));
    put(&files.image_path, &files.image)?;
    put(&files.yaml_path, files.yaml.as_bytes())?;
    let poses: Vec<_> = trajectory.iter().map(|(_, pose)| *pose).collect();
    put("trajectory.png", &picture::draw(&map, &poses))
}
