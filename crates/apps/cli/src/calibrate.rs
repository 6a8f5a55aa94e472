//! `periplus calibrate`.

mod edit;
mod plot;
mod report;
mod robot;
mod targets;

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_bags::files::Bag;
use periplus_calibration::{
    DifferentialDrive, ImuSample, WheelSample, WheelTrack, calibrate_drive, calibrate_imu,
    lidar_noise, match_scans, predict_second_half, range_bias, refine_with_slam,
};
use periplus_diagnostics::unified_diff;
use periplus_loader::load;
use periplus_msgs::sensor_msgs::{Imu, JointState};

use self::report::Report;
use self::robot::{NominalRobot, nominal_robot};
use crate::error::CliError;
use crate::log::LogOptions;
use crate::options::{SearchOptions, split};
use crate::run_options::positive;
use crate::terminal::{complain, say, with_setting};
use crate::{paths, score};
use periplus_session::recorded::{each, has_type};
use periplus_session::scan_log::{LoggedScan, ScanLog};

/// Calibrate wheels, scanner and IMU of a robot with two driven wheels from a recorded drive
///
/// RECORDING has scans, joint states of both wheels, and transforms (.mcap, .db3, .bag, or a folder of `ros2 bag`), or
/// scans with odometry (CARMEN log), which then is taken for that of the nominal wheels. The robot's file has the
/// nominal values, with which the results are compared. The changes of its texts are printed as a diff; `--write`
/// writes them. The drive has to turn and to change its speed: values that it does not determine are refused by name, with
/// exit code 1.
#[derive(Debug, Args)]
pub(crate) struct CalibrateOptions {
    /// Recording
    #[arg(value_name = "RECORDING")]
    recording: PathBuf,
    /// Robot, and `name:=value` for its xacro
    #[arg(long, required = true, num_args = 1.., value_name = "FILE|NAME:=VALUE")]
    robot: Vec<String>,
    /// Joint of the left wheel [default: the wheels of the robot, if there are two]
    #[arg(long, value_name = "NAME", requires = "right_joint")]
    left_joint: Option<String>,
    /// Joint of the right wheel
    #[arg(long, value_name = "NAME", requires = "left_joint")]
    right_joint: Option<String>,
    /// Nominal radius of the wheels [m] [default: that of their collision shape]
    #[arg(long, value_name = "METRES", value_parser = positive)]
    wheel_radius: Option<f64>,
    /// Maximum delay of the scans [s]
    #[arg(long, value_name = "SECONDS", default_value_t = 0.3, value_parser = positive)]
    max_delay: f64,
    #[command(flatten)]
    log: LogOptions,
    /// Write a plot of the residuals
    #[arg(long, value_name = "FILE.png")]
    plot: Option<PathBuf>,
    /// Write the values into the robot's files
    #[arg(long)]
    write: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    search: SearchOptions,
}

/// Minimum time between matched scans \[s\]: the robot moves by more than the error of a match.
const MATCH_PERIOD_S: f64 = 0.4;

pub(crate) fn run(options: &CalibrateOptions) -> Result<ExitCode, CliError> {
    let nominal = nominal_robot(options)?;
    let log = ScanLog::open(&options.recording, &options.log.selection())?;
    log.faults.iter().for_each(|fault| complain(fault));
    let is_carmen = log.kind.starts_with("CARMEN");
    let imu = if is_carmen { Vec::new() } else { imu_samples(&paths::bag(&options.recording)?)? };
    let track = if is_carmen {
        say("the log has no joint states: its odometry is taken for that of the nominal wheels");
        odometry_wheels(&log, &nominal.drive)
    } else {
        wheels(&paths::bag(&options.recording)?, &options.recording, &nominal)?
    };
    let scans: Vec<_> = log.scans.into_iter().map(|it| it.scan).collect();
    let Some(first) = scans.first() else {
        return Err(CliError::failed(format!("{} has no scans", options.recording.display())));
    };
    let base_from_scanner = first.mounting.base_from_scanner;
    let axle_from_scanner = nominal.base_from_axle.inverse() * base_from_scanner;
    let start = |from_s: f64, to_s: f64| {
        let motion = track.motion(&nominal.drive, from_s, to_s)?;
        Some(axle_from_scanner.inverse() * motion * axle_from_scanner)
    };
    let displacements = match_scans(&scans, MATCH_PERIOD_S, start);
    let found = calibrate_drive(&track, &displacements, &nominal.drive, options.max_delay)
        .map_err(|error| CliError::failed(format!("{}: {error}", options.recording.display())))?;
    let found = refine_with_slam(&found, &track, &scans).unwrap_or_else(|why| {
        complain(&format!(
            "the values are of matches of successive scans, which corridors falsify, and not of SLAM: {why}"
        ));
        found
    });
    let second_half =
        predict_second_half(&track, &scans, &displacements, &nominal.drive, options.max_delay);
    let lidar = lidar_noise(&scans);
    let delay_s = found.delay_s.value;
    let mut report = Report {
        imu: calibrate_imu(&imu, Some(&track), &displacements, delay_s, options.max_delay),
        range_bias: lidar.and_then(|it| range_bias(&scans, &it)),
        second_half,
        found,
        base_from_scanner,
        lidar,
        nominal,
        outcomes: Vec::new(),
        missing: Vec::new(),
    };
    let plan = edit_robot(options, &mut report)?;
    if let Some(path) = &options.plot {
        plot::write(path, &report.found.residuals)?;
    }
    if options.write {
        for (path, (_, after)) in &plan.texts {
            paths::write(path, after.as_bytes())?;
            say(&format!("wrote {}", shown(path)));
        }
    }
    if options.json {
        score::put_json(&report.to_json())?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = anstream::stdout().lock();
    report.print(&mut out)?;
    if !options.write {
        for (path, (before, after)) in &plan.texts {
            write!(out, "{}", unified_diff(&shown(path), before, after))?;
        }
        if !plan.texts.is_empty() {
            say("`--write` writes these changes");
        }
    }
    if let Some(path) = &options.plot {
        say(&format!("{} shows the residuals of x, y and yaw over time", path.display()));
    }
    Ok(ExitCode::SUCCESS)
}

/// Angles of both wheels from all joint states.
fn wheels(bag: &Bag, path: &Path, nominal: &NominalRobot) -> Result<WheelTrack, CliError> {
    let topics: Vec<&str> = bag
        .topics()
        .iter()
        .filter(|topic| has_type(topic, "JointState"))
        .map(|topic| topic.name.as_str())
        .collect();
    let mut samples = Vec::new();
    let faults = each::<JointState>(bag, &topics, |_, message| {
        let angle = |joint: &str| {
            let index = message.name.iter().position(|name| name == joint)?;
            message.position.get(index).copied()
        };
        let both = (angle(&nominal.left_joint), angle(&nominal.right_joint));
        if let (Some(left_rad), Some(right_rad)) = both {
            let stamp_s = message.header.stamp.ns() as f64 * 1e-9;
            samples.push(WheelSample { stamp_s, left_rad, right_rad });
        }
    })?;
    faults.iter().for_each(|fault| complain(fault));
    if samples.is_empty() {
        return Err(CliError::failed(format!(
            "{} has no joint states of `{}` and `{}`; record `joint_states`, or name the joints with `--left-joint` and \
             `--right-joint`",
            path.display(),
            nominal.left_joint,
            nominal.right_joint
        )));
    }
    Ok(WheelTrack::new(samples))
}

/// Samples of the IMU with the most messages; none without one.
fn imu_samples(bag: &Bag) -> Result<Vec<ImuSample>, CliError> {
    let topics = bag.topics().iter().zip(bag.counts());
    let topic = topics
        .filter(|(topic, _)| has_type(topic, "Imu"))
        .max_by_key(|(_, count)| **count)
        .map(|(topic, _)| topic.name.as_str());
    let mut samples = Vec::new();
    let faults = each::<Imu>(bag, topic.as_slice(), |_, message| {
        let (rate, acceleration) = (message.angular_velocity, message.linear_acceleration);
        samples.push(ImuSample {
            stamp_s: message.header.stamp.ns() as f64 * 1e-9,
            angular_velocity_rad_s: [rate.x, rate.y, rate.z],
            acceleration_m_s2: [acceleration.x, acceleration.y, acceleration.z],
        });
    })?;
    faults.iter().for_each(|fault| complain(fault));
    Ok(samples)
}

/// Wheels that would have turned as the odometry of the log has it.
fn odometry_wheels(log: &ScanLog, drive: &DifferentialDrive) -> WheelTrack {
    let pose = |it: &LoggedScan| Some((it.scan.time_ns as f64 * 1e-9, it.odom_from_base?));
    WheelTrack::from_odometry(log.scans.iter().filter_map(pose), drive)
}

/// Plans the changes of the robot's texts, and adds them to the report.
fn edit_robot(options: &CalibrateOptions, report: &mut Report) -> Result<edit::Plan, CliError> {
    let (files, arguments) = split(&options.robot);
    let [file] = &files[..] else {
        return Err(CliError::usage("name one file with `--robot`"));
    };
    let plan = with_setting(&options.search.resource_path, arguments, |context| {
        let loaded = load(file, context);
        let document = loaded.document.as_ref()?;
        let found = targets::targets(document, report);
        report.missing = found.missing;
        Some(edit::plan(file, context, document, &loaded.sources, &found.targets, &found.owned))
    });
    let mut plan = plan.unwrap_or_default();
    report.outcomes = std::mem::take(&mut plan.outcomes);
    Ok(plan)
}

/// Path relative to the working folder, if it is below it.
fn shown(path: &Path) -> String {
    let folder = std::env::current_dir().and_then(|it| it.canonicalize());
    let inside = folder.ok().and_then(|it| path.strip_prefix(it).ok().map(Path::to_owned));
    inside.as_deref().unwrap_or(path).display().to_string()
}
