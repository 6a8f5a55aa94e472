//! Localization of a log, scan by scan.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;
use periplus_localization::{Amcl, LocalizationState, LocalizationStatus, Settings};
use periplus_os::Stopwatch;
use periplus_session::files::FileError;
use periplus_session::picture;
use periplus_session::scan_log::{LogSelection, ScanLog};

use super::options::{self, LocalizeOptions};
use super::report::Report;
use crate::error::CliError;
use crate::terminal;

/// Number of log errors that are printed; the others are counted.
const MAX_PRINTED: usize = 20;
/// Number of state changes that are listed; the others are counted.
const MAX_CHANGES: usize = 1000;

/// Result of localizing a log.
#[derive(Default)]
pub(super) struct Outcome {
    /// Stamp and `map_from_base` of each scan while localized.
    pub(super) trajectory: Vec<(String, Pose2)>,
    /// Update time of each used scan \[s\].
    pub(super) spent_s: Vec<f64>,
    /// Unusable scans, by reason.
    pub(super) refused: BTreeMap<&'static str, (String, usize)>,
    pub(super) without_odometry: usize,
    /// Number of scans in each state.
    pub(super) states: BTreeMap<&'static str, usize>,
    /// State changes: stamp, new state, reason.
    pub(super) changes: Vec<(String, &'static str, String)>,
    /// Time \[s\] and distance \[m\] until localized.
    pub(super) settled: Option<(f64, f64)>,
    /// Sum and count of the fraction of scan points on walls.
    pub(super) fits: (f64, usize),
}

pub(super) fn run(
    options: &LocalizeOptions,
    log_path: &Path,
    map_path: &Path,
    out: &Path,
) -> Result<ExitCode, CliError> {
    let watch = Stopwatch::start();
    let values = options.values()?;
    let map = options::map_grid(map_path)?;
    let frame = |name: &str| values.is_given(name).then(|| values.text(name)).flatten();
    let input = LogSelection {
        odom_frame: frame("odom_frame_id").unwrap_or_else(|| options.input.odom_frame.clone()),
        base_frame: options.input.base_frame.clone().or_else(|| frame("base_frame_id")),
        ..options.input.selection()
    };
    let mut log = ScanLog::open(log_path, &input)?;
    if let Some(begin_ns) = log.scans.first().map(|it| it.scan.time_ns) {
        let skip_ns = (options.skip * 1e9) as i64;
        log.scans.retain(|it| it.scan.time_ns - begin_ns >= skip_ns);
    }
    if log.scans.is_empty() {
        return Err(CliError::failed(format!("{} has no scans", log_path.display())));
    }
    let loaded_s = watch.elapsed().as_secs_f64();
    let mut amcl = Amcl::new(Settings::from_values(&values));
    let frame = amcl.settings().global_frame.clone();
    if let Err(why) = amcl.set_map(&frame, &map) {
        terminal::complain(&why.message);
        why.notes.iter().for_each(|note| terminal::say(&format!("note: {note}")));
        why.help.iter().for_each(|help| terminal::say(&format!("help: {help}")));
        return Err(CliError::Reported(1));
    }
    let outcome = localize(&mut amcl, &log);
    let wall_s = watch.elapsed().as_secs_f64();
    let report = Report {
        log_path,
        map_path,
        out,
        amcl: &amcl,
        log: &log,
        outcome: &outcome,
        loaded_s,
        wall_s,
    };
    let written = write(out, &map, &report);
    if !options.quiet {
        report.tell(&mut anstream::stdout().lock())?;
    }
    if let Err(why) = &written {
        terminal::complain(&why.to_string());
    }
    for fault in log.faults.iter().take(MAX_PRINTED) {
        terminal::complain(fault);
    }
    let is_good = written.is_ok() && log.faults.is_empty() && outcome.settled.is_some();
    Ok(if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Localizes one scan after the other.
fn localize(amcl: &mut Amcl, log: &ScanLog) -> Outcome {
    let mut outcome = Outcome::default();
    let mut way_m = 0.0;
    let mut before: Option<Pose2> = None;
    let begin_ns = log.scans.first().map_or(0, |it| it.scan.time_ns);
    let mut state = LocalizationState::Unset;
    for logged in &log.scans {
        let Some(odom_from_base) = logged.odom_from_base else {
            outcome.without_odometry += 1;
            continue;
        };
        if let Some(before) = before.replace(odom_from_base) {
            let moved = before.inverse() * odom_from_base;
            way_m += libm::hypot(moved.x_m, moved.y_m);
        }
        let one = Stopwatch::start();
        match amcl.update(odom_from_base, &logged.scan) {
            Ok(Some(update)) => {
                outcome.spent_s.push(one.elapsed().as_secs_f64());
                if let Some(fit) = update.status.inlier_ratio {
                    outcome.fits.0 += fit;
                    outcome.fits.1 += 1;
                }
            }
            Ok(None) => {}
            Err(why) => {
                let (_, count) = outcome.refused.entry(why.code).or_insert((why.message, 0));
                *count += 1;
            }
        }
        let LocalizationStatus { state: now, reason, .. } = amcl.status();
        *outcome.states.entry(word(*now)).or_default() += 1;
        if std::mem::replace(&mut state, *now) != *now && outcome.changes.len() < MAX_CHANGES {
            outcome.changes.push((logged.stamp(), word(*now), reason.clone()));
        }
        if let Some(map_from_odom) = amcl.map_from_odom().filter(|_| amcl.has_pose()) {
            let after_s = (logged.scan.time_ns - begin_ns) as f64 * 1e-9;
            outcome.settled.get_or_insert((after_s, way_m));
            let map_from_base = (map_from_odom * odom_from_base).normalized();
            outcome.trajectory.push((logged.stamp(), map_from_base));
        }
    }
    outcome
}

fn word(state: LocalizationState) -> &'static str {
    match state {
        LocalizationState::Unset => "unset",
        LocalizationState::Tracking => "tracking",
        LocalizationState::Ambiguous => "ambiguous",
        LocalizationState::Lost => "lost",
    }
}

/// Writes all results of a run.
fn write(out: &Path, map: &OccupancyGrid, report: &Report<'_>) -> Result<(), FileError> {
    crate::paths::make_folder(out)?;
    let put = |name: &str, bytes: &[u8]| crate::paths::write(&out.join(name), bytes);
    let trajectory = &report.outcome.trajectory;
    let line = |(stamp, pose): &(String, Pose2)| {
        format!("{stamp} {:.6} {:.6} {:.6}\n", pose.x_m, pose.y_m, pose.yaw_rad)
    };
    put("trajectory.txt", trajectory.iter().map(line).collect::<String>().as_bytes())?;
    let poses: Vec<_> = trajectory.iter().map(|(_, pose)| *pose).collect();
    let drawn = put("trajectory.png", &picture::draw(map, &poses, &[]));
    put("report.json", format!("{:#}\n", report.to_json()).as_bytes())?;
    drawn
}
