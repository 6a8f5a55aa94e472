//! Frontier exploration: selection of goals at the border of explored space, and path following.
//!
//! Frontiers are the borders between free and unknown space (Yamauchi, "A frontier-based approach
//! for autonomous exploration", 1997). [`frontiers`] returns the reachable ones with path costs; an
//! [`Explorer`] selects one, follows the path, selects again when the map has grown, and abandons
//! goals that it cannot reach. The crate has no clock and no topics: all inputs are arguments.
//!
//! ```
//! use periplus_exploration::{Reach, Robot, frontiers};
//! use periplus_geometry::Pose2;
//! use periplus_grid::{Grid, GridInfo, occupancy};
//!
//! // A room of 4 m by 1 m, of which the left half is explored.
//! let mut map = Grid::new(GridInfo::new(0.1, 40, 10, Pose2::IDENTITY)?, occupancy::UNKNOWN);
//! for index in (0..map.cells.len()).filter(|index| index % 40 < 20) {
//!     map.cells[index] = occupancy::FREE;
//! }
//! let robot = Robot { radius_m: 0.2, comfort_m: 0.4 };
//! let reach = Reach::new(&map, &robot, 0.5, 0.5).expect("a position on the map");
//! let frontiers = frontiers(&reach, 0.3);
//! assert_eq!(frontiers.len(), 1);
//! assert!((frontiers[0].place_m[0] - 1.95).abs() < 1e-9);
//! # Ok::<(), periplus_grid::GridInfoError>(())
//! ```

mod explorer;
mod follow;
mod frontier;
mod reach;

pub use explorer::{Explorer, Mood, Settings};
pub use follow::{Velocity, follow};
pub use frontier::{Frontier, frontiers};
pub use reach::{Reach, Robot};
