//! Cells over the plane, as maps and costmaps have them: where each is, which ones a line crosses,
//! how far each is from the nearest obstacle.
//!
//! A [`Lattice`] says where cells are, and a [`Grid`] has a value in each, row by row from the lower
//! left corner, as `nav_msgs/OccupancyGrid` does. Cell `(0, 0)` lies at the corner, and its centre
//! half a cell further.
//!
//! ```
//! use periplus_geometry::Pose2;
//! use periplus_grid::{Grid, Lattice, Line, occupancy};
//!
//! let lattice = Lattice::new(0.5, 4, 3, Pose2::new(-1.0, 0.0, 0.0))?;
//! let mut map = Grid::new(lattice, occupancy::UNKNOWN);
//! assert_eq!(lattice.cell_of(-0.3, 1.2), Some((1, 2)));
//! assert_eq!(lattice.centre_of((1, 2)), (-0.25, 1.25));
//! for cell in Line::between((0, 0), (3, 0)) {
//!     map[cell] = occupancy::FREE;
//! }
//! map[(3, 0)] = occupancy::OCCUPIED;
//! assert_eq!(&map.cells[..4], [0, 0, 0, 100]);
//! # Ok::<(), periplus_grid::LatticeError>(())
//! ```

mod distance;
mod grid;
mod lattice;
mod line;
pub mod occupancy;

pub use distance::{NOWHERE, squared_distances};
pub use grid::Grid;
pub use lattice::{
    Cell, CellFinder, Lattice, LatticeError, MAX_ORIGIN_M, MOST_CELLS, RESOLUTION_RANGE_M,
    is_origin, is_resolution,
};
pub use line::Line;
pub use occupancy::OccupancyGrid;
