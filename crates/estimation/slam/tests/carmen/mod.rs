//! Scans of CARMEN logs, for tests and tools.

use periplus_bags::CarmenScan;
use periplus_slam::Scan;

/// A scan as a mapper takes it.
pub(crate) fn scan_of(scan: &CarmenScan) -> Scan {
    Scan {
        time_ns: (scan.time_s * 1e6).round() as i64 * 1000,
        base_from_laser: scan.base_from_laser,
        is_flipped: false,
        angle_min_rad: scan.angle_min_rad,
        angle_increment_rad: scan.angle_increment_rad,
        time_increment_s: 0.0,
        range_min_m: 0.05,
        range_max_m: scan.range_max_m,
        ranges_m: scan.ranges_m.clone(),
    }
}
