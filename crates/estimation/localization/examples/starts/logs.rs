//! Drives from logs, with maps and references from SLAM.

use std::path::Path;

use periplus_bags::read_carmen;
use periplus_geometry::{LaserScan2, Pose2};
use periplus_grid::{OccupancyGrid, occupancy};
use periplus_slam::Slam;

use crate::courses::{Course, Sight};

/// CARMEN log: every `every`-th scan of its first scanner.
pub(crate) fn course_of_log(name: &str, path: &Path, every: usize) -> Result<Course, String> {
    let bytes = std::fs::read(path).map_err(|why| format!("{}: {why}", path.display()))?;
    let (_, scans) = read_carmen(&bytes).scans_of_first_kind();
    let mut slam = Slam::new(periplus_slam::Settings::default());
    let mut taken = Vec::new();
    for (number, scan) in scans.into_iter().step_by(every).enumerate() {
        let Some(odom_from_base) = scan.odom_from_base else { continue };
        let time_ns = number as i64 * 100_000_000;
        let scan = LaserScan2 { time_ns, ..scan.into() };
        let _ = slam.add_scan(&scan, Some(odom_from_base));
        taken.push((time_ns, odom_from_base, scan));
    }
    slam.finish();
    let map = slam.map().ok_or_else(|| format!("{name}: no map"))?;
    let way: std::collections::BTreeMap<i64, Pose2> = slam.trajectory().into_iter().collect();
    let sights = taken.into_iter().filter_map(|(time_ns, odom_from_base, scan)| {
        let map_from_base = *way.get(&time_ns)?;
        Some(Sight { odom_from_base, map_from_base, scan })
    });
    Ok(Course { name: name.to_owned(), map: trinary(map), sights: sights.collect() })
}

/// Map as published by a map server.
fn trinary(mut map: OccupancyGrid) -> OccupancyGrid {
    for cell in &mut map.cells {
        *cell = match *cell {
            65.. => occupancy::OCCUPIED,
            0..=25 => occupancy::FREE,
            _ => occupancy::UNKNOWN,
        };
    }
    map
}
