//! Transforms of scans.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{LaserScan2, Pose, Pose2, ScannerMounting};
use periplus_msgs::sensor_msgs::LaserScan;

use crate::Frames;

/// Frames of a robot, and the parameters that name them.
#[derive(Clone, Copy, Debug)]
pub struct RobotFrames<'a> {
    /// Odometry frame.
    pub odom: &'a str,
    /// Base frame of the robot.
    pub base: &'a str,
    /// Parameter with the odometry frame.
    pub odom_parameter: &'static str,
    /// Parameter with the base frame.
    pub base_parameter: &'static str,
}

/// Transforms of the stamp of a scan.
#[derive(Clone, Copy, Debug)]
pub struct ScanTransforms {
    /// The time \[ns\].
    pub time_ns: i64,
    /// Mounting pose of the scanner.
    pub base_from_laser: Pose,
    /// Odometry pose of the robot.
    pub odom_from_base: Pose2,
}

/// Converts a scan, with the mounting pose of its scanner.
#[must_use]
pub fn laser_scan(message: &LaserScan, base_from_scanner: Pose) -> LaserScan2 {
    LaserScan2 {
        time_ns: message.header.stamp.ns(),
        mounting: ScannerMounting::from(base_from_scanner),
        angle_min_rad: message.angle_min.into(),
        angle_increment_rad: message.angle_increment.into(),
        time_increment_s: message.time_increment.into(),
        range_min_m: message.range_min,
        range_max_m: message.range_max,
        ranges_m: message.ranges.clone(),
    }
}

/// Transform that a scan lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissingTransform {
    /// The `frame_id` of the scan is empty.
    Frame,
    /// The mounting pose of the scanner.
    Laser,
    /// The odometry pose of the robot.
    Odometry,
}

/// Looks up the transforms of a scan.
///
/// # Errors
/// The first transform that is not available.
pub fn scan_transforms(
    message: &LaserScan,
    frames: &Frames,
    robot: &RobotFrames<'_>,
) -> Result<ScanTransforms, MissingTransform> {
    let time_ns = message.header.stamp.ns();
    let (laser, base) = (message.header.frame_id.as_str(), robot.base);
    if laser.is_empty() {
        return Err(MissingTransform::Frame);
    }
    // The mounting pose rarely changes; the latest one is used if none is available at that time.
    let base_from_laser = frames.at(base, laser, time_ns).or_else(|_| frames.at(base, laser, 0));
    let (base_from_laser, _) = base_from_laser.map_err(|_| MissingTransform::Laser)?;
    let found = frames.at(robot.odom, base, time_ns);
    let odom_from_base = Pose2::from(found.map_err(|_| MissingTransform::Odometry)?.0);
    Ok(ScanTransforms { time_ns, base_from_laser, odom_from_base })
}

impl MissingTransform {
    /// Finding that describes the missing transform, and what to start or set.
    #[must_use]
    pub fn finding(self, laser: &str, frames: &Frames, robot: &RobotFrames<'_>) -> Diagnostic {
        let RobotFrames { odom, base, odom_parameter, base_parameter } = robot;
        match self {
            Self::Frame => Diagnostic::error("scan-without-frame", "scans have no `frame_id`")
                .help("set the frame in which the driver measures"),
            Self::Laser => {
                let why = frames.missing(base, laser);
                Diagnostic::error(
                    "no-laser-transform",
                    format!("scans are dropped: no transform from `{laser}` to `{base}`: {why}"),
                )
                .help(format!(
                    "start robot_state_publisher or a static transform, or set `{base_parameter}`"
                ))
            }
            Self::Odometry => {
                let why = frames.missing(odom, base);
                Diagnostic::error(
                    "no-odometry",
                    format!(
                        "scans are dropped: no transform from `{base}` to `{odom}` at their time: \
                         {why}"
                    ),
                )
                .help(format!(
                    "start a publisher of odometry, or set `{odom_parameter}` and `{base_parameter}`"
                ))
            }
        }
    }
}
