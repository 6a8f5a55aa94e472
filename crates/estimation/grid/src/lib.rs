//! Grids over the plane, as maps and costmaps use them: conversion between cells and coordinates,
//! ray tracing along lines, and distance transforms.
//!
//! A [`GridInfo`] defines resolution, size and origin. A [`Grid`] has a value for each cell, row by
//! row from the lower left corner, as `nav_msgs/OccupancyGrid` does. The origin is the lower left
//! corner of cell `(0, 0)`; the centre of the cell is half a cell further.
//!
//! ```
//! use periplus_geometry::Pose2;
//! use periplus_grid::{Grid, GridInfo, Line, occupancy};
//!
//! let info = GridInfo::new(0.5, 4, 3, Pose2::new(-1.0, 0.0, 0.0))?;
//! let mut map = Grid::new(info, occupancy::UNKNOWN);
//! assert_eq!(info.cell_of(-0.3, 1.2), Some((1, 2)));
//! assert_eq!(info.centre_of((1, 2)), (-0.25, 1.25));
//! for cell in Line::between((0, 0), (3, 0)) {
//!     map[cell] = occupancy::FREE;
//! }
//! map[(3, 0)] = occupancy::OCCUPIED;
//! assert_eq!(&map.cells[..4], [0, 0, 0, 100]);
//! # Ok::<(), periplus_grid::GridInfoError>(())
//! ```

mod distance;
mod grid;
mod info;
mod line;
pub mod occupancy;

pub use distance::{NO_SITE_CELLS, squared_distances};
pub use grid::Grid;
pub use info::{
    Cell, CellFinder, GridInfo, GridInfoError, MAX_CELL_COUNT, MAX_ORIGIN_M, RESOLUTION_RANGE_M,
    is_origin, is_resolution,
};
pub use line::Line;
pub use occupancy::OccupancyGrid;
