//! CARMEN log files: text with one line per odometry or laser reading.
//!
//! Source: the header of every such log (`message formats defined`), and the CARMEN toolkit's
//! `logger/logger_io`. The old kinds of lines contain no angles; the convention here is that of the
//! published corrected logs: an even number of beams begins at -90 degrees and ends one step before
//! 90, an odd number includes both.

use std::f64::consts::PI;
use std::io::{self, BufRead};

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};

/// Content of a log, with the lines that could not be parsed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CarmenLog {
    /// Laser scans in the order of the log.
    pub scans: Vec<CarmenScan>,
    /// Odometry from odometry and laser lines, in the order of the log.
    pub odometry: Vec<CarmenOdometry>,
    /// Line numbers, from 1, with the error.
    pub faults: Vec<(usize, String)>,
}

/// An odometry pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarmenOdometry {
    /// Time stamp of the sender \[s\].
    pub time_s: f64,
    /// Pose of the robot.
    pub odom_from_base: Pose2,
}

/// Kind of line of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CarmenScanKind {
    /// `FLASER`.
    FrontLaser,
    /// `ROBOTLASER1`.
    RobotLaser,
    /// `RAWLASER1`, without poses.
    RawLaser,
}

impl CarmenScanKind {
    /// First word of the line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::FrontLaser => "FLASER",
            Self::RobotLaser => "ROBOTLASER1",
            Self::RawLaser => "RAWLASER1",
        }
    }
}

/// A laser scan.
#[derive(Clone, Debug, PartialEq)]
pub struct CarmenScan {
    /// Kind of line.
    pub kind: CarmenScanKind,
    /// Time stamp of the sender \[s\].
    pub time_s: f64,
    /// Odometry pose of the robot; none if the line has none.
    pub odom_from_base: Option<Pose2>,
    /// Pose of the laser on the robot.
    pub base_from_laser: Pose2,
    /// Direction of the first beam \[rad\].
    pub angle_min_rad: f64,
    /// Angle between beams \[rad\].
    pub angle_increment_rad: f64,
    /// Readings at or above this are not returns \[m\].
    pub range_max_m: f32,
    /// Ranges \[m\].
    pub ranges_m: Vec<f32>,
}

/// Minimum range of the scanners that wrote such logs; lines do not contain it \[m\].
const RANGE_MIN_M: f32 = 0.02;

/// The stamp is rounded to the microsecond, and all beams have the same.
impl From<CarmenScan> for LaserScan2 {
    fn from(scan: CarmenScan) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "a stamp fits for 292 years")]
        let stamp_us = (scan.time_s * 1e6).round() as i64;
        Self {
            time_ns: stamp_us.saturating_mul(1000),
            mounting: ScannerMounting::upright(scan.base_from_laser),
            angle_min_rad: scan.angle_min_rad,
            angle_increment_rad: scan.angle_increment_rad,
            time_increment_s: 0.0,
            range_min_m: RANGE_MIN_M,
            range_max_m: scan.range_max_m,
            ranges_m: scan.ranges_m,
        }
    }
}

impl CarmenLog {
    /// Kind of the first scan, and the scans of that kind: a log may contain each scan in lines of
    /// two kinds.
    #[must_use]
    pub fn scans_of_first_kind(self) -> (Option<CarmenScanKind>, Vec<CarmenScan>) {
        let kind = self.scans.first().map(|scan| scan.kind);
        let mut scans = self.scans;
        scans.retain(|scan| Some(scan.kind) == kind);
        (kind, scans)
    }

    fn push(&mut self, scan: CarmenScan) {
        if let Some(odom_from_base) = scan.odom_from_base {
            self.odometry.push(CarmenOdometry { time_s: scan.time_s, odom_from_base });
        }
        self.scans.push(scan);
    }
}

/// Maximum number of beams of a laser.
const MOST_BEAMS: usize = 100_000;
/// Maximum number of errors reported.
const MOST_FAULTS: usize = 100;
/// Minimum number of readings that share the maximum range for it to count as the no-return value.
const NOTHING: usize = 3;

/// Parses a log. Unknown lines are skipped; malformed ones are reported.
#[must_use]
pub fn read_carmen(text: &[u8]) -> CarmenLog {
    let mut reading = Reading::default();
    for line in text.split(|&byte| byte == b'\n') {
        reading.take(line);
    }
    reading.finish()
}

/// Parses a log as [`read_carmen`] does, line by line, without loading it into memory.
///
/// # Errors
/// When the text cannot be read.
pub fn read_carmen_from(text: &mut dyn BufRead) -> io::Result<CarmenLog> {
    let mut reading = Reading::default();
    let mut line = Vec::new();
    while text.read_until(b'\n', &mut line)? > 0 {
        reading.take(&line);
        line.clear();
    }
    Ok(reading.finish())
}

/// A partly parsed log.
#[derive(Default)]
struct Reading {
    log: CarmenLog,
    offset_m: f64,
    lines: usize,
}

impl Reading {
    fn take(&mut self, line: &[u8]) {
        let Self { log, offset_m, lines } = self;
        *lines += 1;
        let line = String::from_utf8_lossy(line);
        let mut words = line.split_ascii_whitespace();
        let Some(kind) = words.next() else { return };
        let rest: Vec<&str> = words.collect();
        let read = match kind {
            "ODOM" => odometry(&rest).map(|it| log.odometry.push(it)),
            "FLASER" => old_laser(&rest, *offset_m).map(|it| log.push(it)),
            "ROBOTLASER1" => new_laser(&rest, CarmenScanKind::RobotLaser).map(|it| log.push(it)),
            "RAWLASER1" => new_laser(&rest, CarmenScanKind::RawLaser).map(|it| log.push(it)),
            "PARAM" => {
                if let ["robot_frontlaser_offset" | "robot_front_laser_offset", value, ..] =
                    rest[..]
                {
                    *offset_m = value.parse().unwrap_or(*offset_m);
                }
                Ok(())
            }
            _ => Ok(()),
        };
        if let Err(what) = read
            && log.faults.len() < MOST_FAULTS
        {
            log.faults.push((*lines, format!("{kind}: {what}")));
        }
    }

    fn finish(mut self) -> CarmenLog {
        fill_limits(&mut self.log.scans);
        self.log
    }
}

/// True if a text looks like a CARMEN log.
#[must_use]
pub fn is_carmen(text: &[u8]) -> bool {
    let head = &text[..text.len().min(64 * 1024)];
    head.split(|&byte| byte == b'\n').take(200).any(|line| {
        [&b"FLASER "[..], b"ROBOTLASER1 ", b"RAWLASER1 ", b"ODOM "]
            .iter()
            .any(|it| line.starts_with(it))
    })
}

fn odometry(words: &[&str]) -> Result<CarmenOdometry, String> {
    let numbers = numbers(words.get(..7).ok_or("it ends before its stamp")?)?;
    Ok(CarmenOdometry {
        time_s: numbers[6],
        odom_from_base: Pose2::new(numbers[0], numbers[1], numbers[2]),
    })
}

/// Parses `FLASER n ranges.. x y theta odom_x odom_y odom_theta stamp host stamp`.
fn old_laser(words: &[&str], offset_m: f64) -> Result<CarmenScan, String> {
    let (ranges_m, rest) = counted(words)?;
    let it = numbers(rest.get(..7).ok_or("it ends before its stamp")?)?;
    let (laser, odom) = (Pose2::new(it[0], it[1], it[2]), Pose2::new(it[3], it[4], it[5]));
    // Logs contain the odometry pose of the laser; corrected logs contain an estimate.
    let between = (odom.inverse() * laser).normalized();
    let is_offset = (between.x_m - offset_m).abs() < 1e-3
        && between.y_m.abs() < 1e-3
        && between.yaw_rad.abs() < 1e-3;
    let count = ranges_m.len();
    let steps = if count % 2 == 0 { count } else { count - 1 };
    Ok(CarmenScan {
        kind: CarmenScanKind::FrontLaser,
        time_s: it[6],
        odom_from_base: Some(odom),
        base_from_laser: if is_offset { between } else { Pose2::IDENTITY },
        angle_min_rad: -0.5 * PI,
        angle_increment_rad: PI / steps.max(1) as f64,
        range_max_m: f32::INFINITY,
        ranges_m,
    })
}

/// Parses `type start field resolution maximum accuracy mode n ranges.. n remissions..`, then for a
/// robot laser `laser (x y theta) robot (x y theta) tv rv forward side axis`, then `stamp host stamp`.
fn new_laser(words: &[&str], kind: CarmenScanKind) -> Result<CarmenScan, String> {
    let has_poses = kind == CarmenScanKind::RobotLaser;
    let head = numbers(words.get(..7).ok_or("it ends in its header")?)?;
    let (ranges_m, rest) = counted(&words[7..])?;
    let (_, rest) = counted(rest)?;
    let count = if has_poses { 12 } else { 1 };
    let it = numbers(rest.get(..count).ok_or("it ends before its stamp")?)?;
    let pose = |at: usize| Pose2::new(it[at], it[at + 1], it[at + 2]);
    Ok(CarmenScan {
        kind,
        time_s: it[count - 1],
        odom_from_base: has_poses.then(|| pose(3)),
        base_from_laser: if has_poses {
            (pose(3).inverse() * pose(0)).normalized()
        } else {
            Pose2::IDENTITY
        },
        angle_min_rad: head[1],
        angle_increment_rad: head[3],
        range_max_m: if head[4] > 0.0 { head[4] as f32 } else { f32::INFINITY },
        ranges_m,
    })
}

/// Parses `n` followed by n numbers; returns the rest.
fn counted<'a, 'b>(words: &'a [&'b str]) -> Result<(Vec<f32>, &'a [&'b str]), String> {
    let (count, rest) = words.split_first().ok_or("it ends before a number of readings")?;
    let count: usize =
        count.parse().map_err(|_| format!("`{count}` is not a number of readings"))?;
    if count > MOST_BEAMS {
        return Err(format!("{count} readings are more than {MOST_BEAMS}"));
    }
    if rest.len() < count {
        return Err(format!("{count} readings are declared, but {} words follow", rest.len()));
    }
    let (readings, rest) = rest.split_at(count);
    // A log has thousands of scans: not more memory for each than it needs.
    let mut ranges_m = Vec::with_capacity(count);
    for reading in readings {
        ranges_m.push(reading.parse().map_err(|_| format!("`{reading}` is not a range"))?);
    }
    Ok((ranges_m, rest))
}

fn numbers(words: &[&str]) -> Result<Vec<f64>, String> {
    words
        .iter()
        .map(|it| match it.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("`{it}` is not a number")),
        })
        .collect()
}

/// Sets the maximum range of lines that have none: the largest reading of the log, if it repeats.
fn fill_limits(scans: &mut [CarmenScan]) {
    let readings = || {
        scans.iter().filter(|scan| scan.range_max_m.is_infinite()).flat_map(|scan| &scan.ranges_m)
    };
    let most = readings().copied().filter(|it| it.is_finite()).fold(0.0, f32::max);
    let limit = 0.99 * most;
    if most <= 0.0 || readings().filter(|&&it| it >= limit).count() < NOTHING {
        return;
    }
    for scan in scans.iter_mut().filter(|scan| scan.range_max_m.is_infinite()) {
        scan.range_max_m = limit;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_by_line_it_is_the_same() {
        let text: &[u8] =
            b"PARAM robot_frontlaser_offset 0.1 host 0\r\nODOM 1 2 0.5 0 0 0 9.5 h 0.1\n\n\
              FLASER 2 1.5 80 1.1 2 0 1 2 0 10.25 h 0.2\nFLASER x\nODOM 1 2\n\xff\xfe\nFLASER";
        for text in [text, &text[..text.len() - 6], b"", b"\n"] {
            // Three bytes at once: lines arrive in pieces.
            let mut reader = std::io::BufReader::with_capacity(3, text);
            assert_eq!(read_carmen_from(&mut reader).unwrap(), read_carmen(text));
        }
    }

    #[test]
    fn both_kinds_of_lines() {
        let log = read_carmen(
            b"# a remark\nPARAM robot_frontlaser_offset 0.1 host 0\nODOM 1 2 0.5 0 0 0 9.5 host 0.1\n\
              FLASER 2 1.5 80 1.1 2 0 1 2 0 10.25 host 0.2\n\
              FLASER 2 80 80 7 7 7 1 2 0 10.5 host 0.2\n\
              ROBOTLASER1 0 -1.5 3.0 1.5 8 0.01 0 3 1 2 8 0 1.2 2 0 1 2 0 0 0 0 0 0 11.5 host 0.3\n",
        );
        assert_eq!(log.faults, []);
        assert_eq!(log.scans.len(), 3);
        assert_eq!(log.odometry.len(), 4);
        let [first, second, third] = &log.scans[..] else { panic!() };
        assert_eq!((first.time_s, first.ranges_m.len()), (10.25, 2));
        assert!((first.base_from_laser.x_m - 0.1).abs() < 1e-9);
        assert_eq!(second.base_from_laser, Pose2::IDENTITY);
        assert!(first.range_max_m > 79.0 && first.range_max_m < 80.0);
        assert!((third.base_from_laser.x_m - 0.2).abs() < 1e-9);
        assert_eq!((third.angle_min_rad, third.range_max_m), (-1.5, 8.0));
        let scan = LaserScan2::from(third.clone());
        assert_eq!((scan.time_ns, scan.beam_angle_rad(0)), (11_500_000_000, -1.5));
        assert_eq!(scan.mounting, ScannerMounting::upright(third.base_from_laser));
    }

    #[test]
    fn broken_lines_are_told_and_passed() {
        let log = read_carmen(
            b"FLASER 180 1 2\nFLASER x\nODOM 1 2 nan 0 0 0 1 h 0\nODOM 1 2\nFLASER 99999999 1\n\xff\xfe\nFLASER",
        );
        assert_eq!(log.faults.len(), 6);
        assert_eq!(log.faults[0].0, 1);
        assert!(log.scans.is_empty() && log.odometry.is_empty());
    }
}
