//! Cell values of `nav_msgs/OccupancyGrid`: -1 unknown, 0 (free) to 100 (occupied).

use crate::Grid;

/// Unknown cell.
pub const UNKNOWN: i8 = -1;
/// Free cell.
pub const FREE: i8 = 0;
/// Occupied cell.
pub const OCCUPIED: i8 = 100;

/// An occupancy grid map as in `nav_msgs/OccupancyGrid`. Values outside -1 to 100 from other
/// programs are kept.
pub type OccupancyGrid = Grid<i8>;
