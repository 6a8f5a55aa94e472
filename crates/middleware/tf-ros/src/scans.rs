//! Where scans were taken.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose, Pose2};
use periplus_msgs::sensor_msgs::LaserScan;

use crate::Frames;

/// Frames of a robot, and the parameters that name them.
#[derive(Clone, Copy, Debug)]
pub struct Robot<'a> {
    /// The frame of odometry.
    pub odom: &'a str,
    /// The frame of the robot.
    pub base: &'a str,
    /// The parameter with the frame of odometry.
    pub odom_parameter: &'static str,
    /// The parameter with the frame of the robot.
    pub base_parameter: &'static str,
}

/// Where everything was at the time of a scan.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// The time \[ns\].
    pub time_ns: i64,
    /// Where the scanner is on the robot.
    pub base_from_laser: Pose,
    /// Where the robot was by odometry.
    pub odom_from_base: Pose2,
}

/// What a scan lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// Its own frame.
    Frame,
    /// Where its scanner is on the robot.
    Laser,
    /// Where the robot was by odometry.
    Odometry,
}

/// Where everything was at the time of a scan.
///
/// # Errors
/// What nobody knows.
pub fn places(message: &LaserScan, frames: &Frames, robot: &Robot<'_>) -> Result<Places, Lack> {
    let time_ns = message.header.stamp.ns();
    let (laser, base) = (message.header.frame_id.as_str(), robot.base);
    if laser.is_empty() {
        return Err(Lack::Frame);
    }
    // The scanner seldom moves on the robot; what is known of it may be older or newer.
    let base_from_laser = frames.at(base, laser, time_ns).or_else(|_| frames.at(base, laser, 0));
    let (base_from_laser, _) = base_from_laser.map_err(|_| Lack::Laser)?;
    let found = frames.at(robot.odom, base, time_ns);
    let odom_from_base = Pose2::from(found.map_err(|_| Lack::Odometry)?.0);
    Ok(Places { time_ns, base_from_laser, odom_from_base })
}

impl Lack {
    /// Says which transform is missing.
    #[must_use]
    pub fn told(self, laser: &str, frames: &Frames, robot: &Robot<'_>) -> Diagnostic {
        let Robot { odom, base, odom_parameter, base_parameter } = robot;
        match self {
            Self::Frame => Diagnostic::error("scan-without-frame", "scans have no `frame_id`")
                .help("have the driver say in which frame it measures"),
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
                    "start what publishes odometry, or set `{odom_parameter}` and `{base_parameter}`"
                ))
            }
        }
    }
}
