//! Conversion of grids and poses from and to messages.

use periplus_costmap::{CellWindow, Costmap, cost};
use periplus_geometry::{DQuat, Pose, Pose2};
use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{geometry_msgs, map_msgs, nav_msgs, nav2_msgs};

/// Converts a pose to the plane, with its yaw.
pub(crate) fn pose2(pose: &geometry_msgs::Pose) -> Pose2 {
    let geometry_msgs::Pose { position, orientation } = pose;
    let rotation = DQuat::from_xyzw(orientation.x, orientation.y, orientation.z, orientation.w);
    let xyz = [position.x, position.y, position.z];
    // Messages written by hand often have a quaternion of zeros.
    if rotation.length_squared() < 1e-12 {
        return Pose2::new(position.x, position.y, 0.0);
    }
    Pose2::from(Pose::from_xyz_quaternion(xyz, rotation))
}

fn point_pose(x: f64, y: f64, z: f64) -> geometry_msgs::Pose {
    geometry_msgs::Pose {
        position: geometry_msgs::Point { x, y, z },
        orientation: geometry_msgs::Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 },
    }
}

/// Converts a map.
/// # Errors
/// The reason, for a malformed map.
pub(crate) fn map(message: &nav_msgs::OccupancyGrid) -> Result<OccupancyGrid, String> {
    let info = &message.info;
    let (width, height) = (info.width as usize, info.height as usize);
    let info = GridInfo::new(info.resolution.into(), width, height, pose2(&info.origin))
        .map_err(|error| error.to_string())?;
    OccupancyGrid::from_cells(info, message.data.clone())
        .map_err(|cells| format!("it has {} cells and should have {width} x {height}", cells.len()))
}

/// Converts costs to an occupancy grid.
pub(crate) fn occupancy_grid(
    costmap: &Costmap,
    frame: &str,
    now_ns: i64,
    z_m: f64,
) -> nav_msgs::OccupancyGrid {
    let GridInfo { resolution_m, width, height, origin } = *costmap.info();
    nav_msgs::OccupancyGrid {
        header: Header::at(now_ns, frame),
        info: nav_msgs::MapMetaData {
            map_load_time: Time::default(),
            resolution: resolution_m as f32,
            width: width as u32,
            height: height as u32,
            origin: point_pose(origin.x_m, origin.y_m, z_m),
        },
        data: costmap.costs().iter().map(|cost| cost::occupancy_of(*cost)).collect(),
    }
}

/// Converts costs to a `nav2_msgs/Costmap`.
pub(crate) fn raw(costmap: &Costmap, frame: &str, now_ns: i64, layer: &str) -> nav2_msgs::Costmap {
    let GridInfo { resolution_m, width, height, origin } = *costmap.info();
    nav2_msgs::Costmap {
        header: Header::at(now_ns, frame),
        metadata: nav2_msgs::CostmapMetaData {
            map_load_time: Time::default(),
            update_time: Time::of_ns(now_ns),
            layer: layer.to_owned(),
            resolution: resolution_m as f32,
            size_x: width as u32,
            size_y: height as u32,
            origin: point_pose(origin.x_m, origin.y_m, 0.0),
        },
        data: costmap.costs().to_vec(),
    }
}

/// Converts a window to an occupancy grid update.
pub(crate) fn occupancy_update(
    costmap: &Costmap,
    window: &CellWindow,
    frame: &str,
    now_ns: i64,
) -> map_msgs::OccupancyGridUpdate {
    map_msgs::OccupancyGridUpdate {
        header: Header::at(now_ns, frame),
        x: window.x0 as i32,
        y: window.y0 as i32,
        width: window.width() as u32,
        height: window.height() as u32,
        data: cells(costmap, window).map(cost::occupancy_of).collect(),
    }
}

/// Converts a window to a costmap update.
pub(crate) fn raw_update(
    costmap: &Costmap,
    window: &CellWindow,
    frame: &str,
    now_ns: i64,
) -> nav2_msgs::CostmapUpdate {
    nav2_msgs::CostmapUpdate {
        header: Header::at(now_ns, frame),
        x: window.x0 as u32,
        y: window.y0 as u32,
        size_x: window.width() as u32,
        size_y: window.height() as u32,
        data: cells(costmap, window).collect(),
    }
}

fn cells<'a>(costmap: &'a Costmap, window: &CellWindow) -> impl Iterator<Item = u8> + use<'a> {
    let spans = window.spans(costmap.info().width);
    spans.flat_map(move |span| costmap.costs()[span].iter().copied())
}

/// Converts a footprint.
pub(crate) fn polygon(
    points: &[[f64; 2]],
    frame: &str,
    now_ns: i64,
) -> geometry_msgs::PolygonStamped {
    let point = |[x, y]: &[f64; 2]| geometry_msgs::Point32 { x: *x as f32, y: *y as f32, z: 0.0 };
    geometry_msgs::PolygonStamped {
        header: Header::at(now_ns, frame),
        polygon: geometry_msgs::Polygon { points: points.iter().map(point).collect() },
    }
}
