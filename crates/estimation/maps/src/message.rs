//! Conversion of maps from and to messages.

use std::fmt;

use periplus_geometry::{DQuat, Pose, Pose2};
use periplus_grid::{Grid, GridInfo, GridInfoError, OccupancyGrid};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{self, Point, Quaternion};
use periplus_msgs::nav_msgs::{self, MapMetaData};
use periplus_msgs::std_msgs::Header;

/// Reason for which a message is not a valid map.
#[derive(Clone, Debug, PartialEq)]
pub enum BadMap {
    /// The number of values differs from the number of cells.
    Length {
        /// Number of columns.
        width: u32,
        /// Number of rows.
        height: u32,
        /// Number of values.
        values: usize,
    },
    /// Resolution, size or origin are invalid.
    GridInfo(GridInfoError),
    /// The quaternion of the orientation is not a rotation.
    Orientation([f64; 4]),
}

impl fmt::Display for BadMap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { width, height, values } => write!(
                f,
                "the map has {values} values for {width} by {height} cells; correct its \
                 publisher"
            ),
            Self::GridInfo(error) => error.fmt(f),
            Self::Orientation(xyzw) => {
                write!(f, "the orientation of the map's origin, {xyzw:?}, is not a rotation")
            }
        }
    }
}

impl std::error::Error for BadMap {}

/// Converts a message, without its frame and times. Only the yaw of the origin is used; a
/// quaternion of zeros, a frequent omission, is the identity.
/// # Errors
/// When the message is malformed.
pub fn from_message(message: &nav_msgs::OccupancyGrid) -> Result<OccupancyGrid, BadMap> {
    let MapMetaData { resolution, width, height, ref origin, .. } = message.info;
    let info = grid_info_of(resolution, width, height, origin)?;
    Grid::from_cells(info, message.data.clone()).map_err(|cells| BadMap::Length {
        width,
        height,
        values: cells.len(),
    })
}

fn grid_info_of(
    resolution: f32,
    width: u32,
    height: u32,
    origin: &geometry_msgs::Pose,
) -> Result<GridInfo, BadMap> {
    let Quaternion { x, y, z, w } = origin.orientation;
    let length = (x * x + y * y + z * z + w * w).sqrt();
    let yaw_rad = if length == 0.0 {
        0.0
    } else if length.is_finite() {
        let rotation = DQuat::from_xyzw(x / length, y / length, z / length, w / length);
        periplus_geometry::rpy_from_quaternion(rotation).yaw
    } else {
        return Err(BadMap::Orientation([x, y, z, w]));
    };
    // Decimal resolutions were meant: 0.05 is not exact in single precision.
    let resolution_m = nearest_decimal(resolution);
    let origin = Pose2::new(origin.position.x, origin.position.y, yaw_rad);
    GridInfo::new(resolution_m, width as usize, height as usize, origin).map_err(BadMap::GridInfo)
}

/// Returns the shortest decimal number that rounds to this value in single precision.
fn nearest_decimal(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

/// Creates a message in a frame, with the stamp as load time and header stamp.
#[must_use]
pub fn to_message(map: &OccupancyGrid, frame_id: &str, stamp: Time) -> nav_msgs::OccupancyGrid {
    let info = map.info;
    let side = |cells: usize| u32::try_from(cells).unwrap_or(u32::MAX);
    let Pose { translation, rotation } = info.origin.into();
    nav_msgs::OccupancyGrid {
        header: Header { stamp: stamp.clone(), frame_id: frame_id.into() },
        info: MapMetaData {
            map_load_time: stamp,
            resolution: info.resolution_m as f32,
            width: side(info.width),
            height: side(info.height),
            origin: geometry_msgs::Pose {
                position: Point { x: translation.x, y: translation.y, z: 0.0 },
                orientation: Quaternion { x: 0.0, y: 0.0, z: rotation.z, w: rotation.w },
            },
        },
        data: map.cells.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let info = GridInfo::new(0.05, 2, 1, Pose2::new(1.0, -2.0, 1.0)).unwrap();
        let map = Grid { info, cells: vec![-1, 100] };
        let message = to_message(&map, "map", Time::default());
        assert!((message.info.origin.orientation.z - 0.479425538604203).abs() < 1e-15);
        let back = from_message(&message).unwrap();
        assert_eq!((back.cells, back.info.resolution_m), (vec![-1, 100], 0.05));
        assert!((back.info.origin.yaw_rad - 1.0).abs() < 1e-15);
    }

    #[test]
    fn malformed_ones_are_told() {
        let info = GridInfo::new(0.05, 2, 1, Pose2::IDENTITY).unwrap();
        let good = to_message(&Grid { info, cells: vec![0, 0] }, "map", Time::default());
        let mut short = good.clone();
        short.data.pop();
        assert!(from_message(&short).unwrap_err().to_string().contains("1 values for 2 by 1"));
        let mut flat = good.clone();
        flat.info.resolution = f32::NAN;
        assert!(matches!(from_message(&flat), Err(BadMap::GridInfo(_))));
        let mut giant = good.clone();
        (giant.info.width, giant.info.height) = (u32::MAX, u32::MAX);
        assert!(from_message(&giant).is_err());
        let mut forgotten = good;
        forgotten.info.origin.orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 0.0 };
        assert_eq!(from_message(&forgotten).unwrap().info.origin.yaw_rad, 0.0);
    }
}
