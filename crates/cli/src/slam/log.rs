//! A log of either kind as scans with odometry.

use std::io;

use periplus_bags::{CarmenScan, is_carmen, read_carmen};
use periplus_base::Pose2;
use periplus_host::Machine;
use periplus_resources::Host as _;
use periplus_slam::Scan;

use super::bag;
use super::options::SlamOptions;

/// A scan of a log.
pub(super) struct Logged {
    /// As the log writes it, to the microsecond \[s\].
    pub(super) stamp: String,
    pub(super) scan: Scan,
    pub(super) odom_from_base: Option<Pose2>,
}

/// What a log holds.
#[derive(Default)]
pub(super) struct Log {
    /// What it is.
    pub(super) kind: String,
    pub(super) scans: Vec<Logged>,
    /// What was damaged.
    pub(super) faults: Vec<String>,
    /// What is missing, and what that means.
    pub(super) warnings: Vec<String>,
}

impl Log {
    /// Reads a log; in words why it cannot be.
    pub(super) fn open(options: &SlamOptions) -> io::Result<Result<Self, String>> {
        let path = &options.log;
        let is_recording = path.is_dir()
            || path.extension().is_some_and(|it| {
                ["bag", "mcap", "db3", "zstd"].iter().any(|other| it.eq_ignore_ascii_case(other))
            });
        if is_recording {
            return bag::read(options);
        }
        let text = match Machine.read(path) {
            Ok(text) => text,
            Err(why) => return Ok(Err(format!("cannot read {}: {why}", path.display()))),
        };
        if !is_carmen(&text) {
            return bag::read(options);
        }
        Ok(Ok(carmen(&text)))
    }
}

fn carmen(text: &[u8]) -> Log {
    let log = read_carmen(text);
    let faults = log.faults.iter().map(|(line, what)| format!("line {line}: {what}"));
    let faults = faults.collect();
    let mut kinds: Vec<&str> = log.scans.iter().map(|scan| scan.kind.as_str()).collect();
    kinds.dedup();
    // A log may tell the same laser twice, in lines of two kinds; the first kind counts.
    let kind = kinds.first().map_or(String::new(), |kind| (*kind).to_owned());
    let scans = log.scans.into_iter().filter(|scan| scan.kind == kind).map(logged);
    Log { kind: format!("CARMEN, {kind}"), scans: scans.collect(), faults, warnings: Vec::new() }
}

fn logged(scan: CarmenScan) -> Logged {
    #[expect(clippy::cast_possible_truncation, reason = "a stamp fits for 292 years")]
    let micros = (scan.time_s * 1e6).round() as i64;
    Logged {
        stamp: format!("{:.6}", scan.time_s),
        odom_from_base: scan.odom_from_base,
        scan: Scan {
            time_ns: micros.saturating_mul(1000),
            base_from_laser: scan.base_from_laser,
            is_flipped: false,
            angle_min_rad: scan.angle_min_rad,
            angle_increment_rad: scan.angle_increment_rad,
            time_increment_s: 0.0,
            range_min_m: 0.02,
            range_max_m: scan.range_max_m,
            ranges_m: scan.ranges_m,
        },
    }
}
