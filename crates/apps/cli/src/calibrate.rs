//! `periplus calibrate`.

mod plot;
mod report;
mod robot;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_bags::files::Bag;
use periplus_calibration::{
    DriveCalibration, OdometryErrorModel, RmsError, ScannerDisplacement, WheelSample, WheelTrack,
    calibrate_drive, lidar_noise, match_scans,
};
use periplus_geometry::Pose2;
use periplus_msgs::sensor_msgs::JointState;

use self::report::{Prediction, Report};
use self::robot::{NominalRobot, nominal_robot};
use crate::error::CliError;
use crate::log::bag::{each, has_type};
use crate::log::{Log, LogOptions};
use crate::options::SearchOptions;
use crate::run_options::positive;
use crate::terminal::{complain, say};
use crate::{paths, score};

/// Calibrate wheels, scanner and delay of a robot with two driven wheels from a recorded drive
///
/// RECORDING has scans, joint states of both wheels, and transforms (.mcap, .db3, .bag, or a folder of `ros2 bag`). The
/// robot's file has the nominal values, with which the results are compared; it is not changed. The drive has to turn and to
/// change its speed: values that it does not determine are refused by name, with exit code 1.
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
    let log = Log::open(&options.recording, &options.log)?;
    log.faults.iter().for_each(|fault| complain(fault));
    let bag = paths::bag(&options.recording)?;
    let track = wheels(&bag, &options.recording, &nominal)?;
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
    let calibrate = |displacements: &[ScannerDisplacement]| {
        calibrate_drive(&track, displacements, &nominal.drive, options.max_delay)
    };
    let found = calibrate(&displacements)
        .map_err(|error| CliError::failed(format!("{}: {error}", options.recording.display())))?;
    let report = Report {
        prediction: prediction(&track, &displacements, calibrate),
        found,
        base_from_scanner,
        lidar: lidar_noise(&scans),
        nominal,
    };
    if let Some(path) = &options.plot {
        plot::write(path, &report.found.residuals)?;
    }
    if options.json {
        score::put_json(&report.to_json())?;
        return Ok(ExitCode::SUCCESS);
    }
    report.print(&mut anstream::stdout().lock())?;
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

/// Prediction of the second half from the first; none if the first half does not determine all values.
fn prediction<E>(
    track: &WheelTrack,
    displacements: &[ScannerDisplacement],
    calibrate: impl Fn(&[ScannerDisplacement]) -> Result<DriveCalibration, E>,
) -> Option<Prediction> {
    let (first, second) = displacements.split_at(displacements.len() / 2);
    let found = calibrate(first).ok()?;
    let model = OdometryErrorModel::fit(&found.errors(track, first))?;
    let errors = found.errors(track, second);
    let motions: Vec<Pose2> = errors.iter().map(|it| it.motion).collect();
    Some(Prediction { expected: model.predict(&motions)?, measured: RmsError::of(&errors)? })
}
