//! Conversion between messages and types of the mapper.

use periplus_grid::OccupancyGrid;
use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
use periplus_scan_matching::Symmetric3;

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

/// Rows of the covariance of a message.
pub(crate) fn covariance_rows(covariance: &Symmetric3) -> [f64; 36] {
    let mut rows = [0.0; 36];
    let Symmetric3 { xx, xy, xt, yy, yt, tt } = *covariance;
    for (at, value) in
        [(XX, xx), (XY, xy), (XT, xt), (YX, xy), (YY, yy), (YT, yt), (TX, xt), (TY, yt), (TT, tt)]
    {
        rows[at] = value;
    }
    rows
}

/// Covariance of a message; missing or invalid values are replaced by the defaults.
pub(crate) fn covariance(rows: &[f64; 36]) -> Symmetric3 {
    let variance = |at: usize, usual: f64| {
        let given = rows[at];
        if given.is_finite() && given > 0.0 { given } else { usual * usual }
    };
    Symmetric3::diagonal(variance(XX, USUAL[0]), variance(YY, USUAL[0]), variance(TT, USUAL[1]))
}
