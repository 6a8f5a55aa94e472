//! Paths that fleet adapters of Open-RMF request.

use std::fmt;

use periplus_geometry::Pose2;
use periplus_msgs::rmf_fleet_msgs::Location;

/// Distance of the first point of a path within which the robot is on it \[m\], as of Open-RMF's slotcar.
const ON_PATH_M: f64 = 1.0;

/// Reason why a requested path is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FleetPathError {
    /// A number is not finite.
    NotFinite,
    /// There are no points.
    Empty,
    /// The first point is this far from the robot \[m\].
    Elsewhere(f64),
}

impl fmt::Display for FleetPathError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("a number is not finite"),
            Self::Empty => f.write_str("it has no points"),
            Self::Elsewhere(away_m) => write!(f, "it begins {away_m:.1} m from the robot"),
        }
    }
}

impl std::error::Error for FleetPathError {}

/// Checks a requested path, whose first point is where the robot is, and returns the points after that.
///
/// # Errors
/// When there are no points, a number is not finite, or the robot is not there.
pub fn fleet_path_from(points: &[Location], pose: Pose2) -> Result<&[Location], FleetPathError> {
    let is_finite = |at: &Location| at.x.is_finite() && at.y.is_finite() && at.yaw.is_finite();
    if !points.iter().all(is_finite) {
        return Err(FleetPathError::NotFinite);
    }
    let Some((first, rest)) = points.split_first() else {
        return Err(FleetPathError::Empty);
    };
    let away_m = fleet_point_distance_m(pose, first);
    if away_m > ON_PATH_M {
        return Err(FleetPathError::Elsewhere(away_m));
    }
    Ok(rest)
}

/// Distance of a robot from a point \[m\].
#[must_use]
pub fn fleet_point_distance_m(pose: Pose2, point: &Location) -> f64 {
    libm::hypot(f64::from(point.x) - pose.x_m, f64::from(point.y) - pose.y_m)
}
