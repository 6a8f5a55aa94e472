//! What the cells of `nav_msgs/OccupancyGrid` say: -1 unknown, else 0 (free) to 100 (occupied).

use crate::Grid;

/// Nobody knows.
pub const UNKNOWN: i8 = -1;
/// Nothing is there.
pub const FREE: i8 = 0;
/// Something is there.
pub const OCCUPIED: i8 = 100;

/// A map as `nav_msgs/OccupancyGrid` holds it. Other values than -1 to 100 come in from others, and
/// stay as they are.
pub type OccupancyGrid = Grid<i8>;
