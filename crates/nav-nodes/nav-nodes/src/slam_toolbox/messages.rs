//! Conversion between messages and types of the mapper.

use periplus_geometry::{DQuat, Pose, Pose2};
use periplus_grid::OccupancyGrid;
use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
use periplus_msgs::geometry_msgs::{self, PoseWithCovariance, PoseWithCovarianceStamped};
use periplus_msgs::std_msgs::Header;
use periplus_scan_matching::Symmetric3;
use periplus_tf_ros::pose;

/// Maximum deviation of the norm of a quaternion from 1.
const OFF: f64 = 0.01;
/// Default standard deviations of an initial pose \[m, rad\], as RViz sends them.
const USUAL: [f64; 2] = [0.5, 0.26];

/// Minimum occupancy of a published cell that is a wall \[%\]: more hits than passes.
const WALL: i8 = 50;

/// Converts a map as `slam_toolbox` and `slam_gmapping` publish it: occupied, free and unknown cells.
/// By default, Nav2's static layer treats only cells of 100 as occupied.
pub(crate) fn published(map: &OccupancyGrid) -> OccupancyGrid {
    map.map(|&cell| match cell {
        UNKNOWN => UNKNOWN,
        WALL.. => OCCUPIED,
        _ => FREE,
    })
}

/// Returns the planar pose of a message, or the reason for which there is none.
pub(crate) fn pose2(pose: &geometry_msgs::Pose) -> Result<Pose2, String> {
    let geometry_msgs::Pose { position, orientation: q } = pose;
    let rotation = DQuat::from_xyzw(q.x, q.y, q.z, q.w);
    let length = rotation.length();
    // What is not a number is off, too.
    let is_rotation = (length - 1.0).abs() < OFF;
    if !is_rotation || !position.x.is_finite() || !position.y.is_finite() {
        return Err(format!(
            "its position ({}, {}) must be finite, and its orientation ({}, {}, {}, {}) a quaternion \
             of length one; this one has {length:.3}",
            position.x, position.y, q.x, q.y, q.z, q.w
        ));
    }
    let xyz = [position.x, position.y, position.z];
    Ok(Pose2::from(Pose::from_xyz_quaternion(xyz, rotation)))
}

/// Rows of six: x, y, z and the turns about them.
const XX: usize = 0;
const XY: usize = 1;
const XT: usize = 5;
const YX: usize = 6;
const YY: usize = 7;
const YT: usize = 11;
const TX: usize = 30;
const TY: usize = 31;
const TT: usize = 35;

pub(crate) fn pose_with_covariance(
    map_from_base: Pose2,
    covariance: &Symmetric3,
    time_ns: i64,
    frame: &str,
) -> PoseWithCovarianceStamped {
    let mut rows = [0.0; 36];
    let Symmetric3 { xx, xy, xt, yy, yt, tt } = *covariance;
    for (at, value) in
        [(XX, xx), (XY, xy), (XT, xt), (YX, xy), (YY, yy), (YT, yt), (TX, xt), (TY, yt), (TT, tt)]
    {
        rows[at] = value;
    }
    PoseWithCovarianceStamped {
        header: Header::at(time_ns, frame),
        pose: PoseWithCovariance { pose: pose(map_from_base), covariance: rows },
    }
}

/// Covariance of a message; missing or invalid values are replaced by the defaults.
pub(crate) fn covariance(rows: &[f64; 36]) -> Symmetric3 {
    let variance = |at: usize, usual: f64| {
        let given = rows[at];
        if given.is_finite() && given > 0.0 { given } else { usual * usual }
    };
    Symmetric3::diagonal(variance(XX, USUAL[0]), variance(YY, USUAL[0]), variance(TT, USUAL[1]))
}
