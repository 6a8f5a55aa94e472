//! Maps drawn from the shapes of a world.

use std::fmt;

use periplus_geometry::Pose2;
use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use periplus_rendering::SensedGeometry;

use crate::Simulation;
use crate::truth_map::{flood, mark_walls};

/// Side of the first square around the start \[m\]; it grows until the walls enclose the floor.
const FIRST_SIDE_M: f64 = 40.0;

/// Room around the outermost walls of a floor without an end \[m\].
const OPEN_MARGIN_M: f64 = 2.0;

/// Maximum number of cells along a side.
const MAX_SIDE_CELL_COUNT: f64 = 8000.0;

/// Map to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapDrawing {
    /// Point of the floor, from which everything on the map can be reached, in the world \[m\].
    pub start_m: [f64; 2],
    /// Height of the slice above the origin of the world \[m\].
    pub height_m: f64,
    /// Side of a cell \[m\].
    pub resolution_m: f64,
    /// Maximum side of the map \[m\].
    pub max_side_m: f64,
}

/// Reason for which no map can be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapDrawingError {
    /// The start is in a shape.
    StartInShape([f64; 2]),
    /// No shape is at the height of the slice, at any distance that the map can have.
    NoShapes,
    /// The map would have too many cells.
    Size,
}

impl fmt::Display for MapDrawingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StartInShape([x_m, y_m]) => {
                write!(f, "the start ({x_m:.2}, {y_m:.2}) is in a shape; give a point of the free floor")
            }
            Self::NoShapes => f.write_str(
                "no shape of the world is at this height within the largest map; choose another height or a larger map",
            ),
            Self::Size => write!(
                f,
                "the map would have more than {MAX_SIDE_CELL_COUNT} cells along a side; choose larger cells or a \
                 smaller map"
            ),
        }
    }
}

impl std::error::Error for MapDrawingError {}

impl Simulation {
    /// Draws the map of a floor: walls are where a collision is at the height, free is what can be reached from the
    /// start without crossing one, the rest is unknown. Its frame is that of the world. A floor that no walls enclose
    /// ends 2 m outside of the outermost ones.
    ///
    /// # Errors
    /// When there is no such map.
    pub fn draw_map(&mut self, drawing: MapDrawing) -> Result<OccupancyGrid, MapDrawingError> {
        let mut side_m = FIRST_SIDE_M.min(drawing.max_side_m);
        loop {
            let map = self.draw_square(drawing, side_m)?;
            let is_open = touches_border(&map);
            if is_open && side_m < drawing.max_side_m {
                side_m = (2.0 * side_m).min(drawing.max_side_m);
                continue;
            }
            let margin_m = if is_open { OPEN_MARGIN_M } else { drawing.resolution_m };
            return cropped(&map, margin_m).ok_or(MapDrawingError::NoShapes);
        }
    }

    fn draw_square(
        &mut self,
        drawing: MapDrawing,
        side_m: f64,
    ) -> Result<OccupancyGrid, MapDrawingError> {
        let count = libm::ceil(side_m / drawing.resolution_m);
        if !(1.0..=MAX_SIDE_CELL_COUNT).contains(&count) {
            return Err(MapDrawingError::Size);
        }
        let [x_m, y_m] = drawing.start_m;
        // Borders of cells are at multiples of their side, where the walls of many worlds are.
        let low = |value_m: f64| {
            libm::floor((value_m - 0.5 * side_m) / drawing.resolution_m) * drawing.resolution_m
        };
        let info = GridInfo {
            resolution_m: drawing.resolution_m,
            width: count as usize,
            height: count as usize,
            origin: Pose2::new(low(x_m), low(y_m), 0.0),
        };
        let seen = self.views.at(SensedGeometry::Collision, self.time_ns(), &self.motion);
        let mut map = Grid::new(info, UNKNOWN);
        mark_walls(&mut map, seen, drawing.height_m, &|_| false);
        let from = info.cell_of(x_m, y_m).filter(|from| map[*from] != OCCUPIED);
        flood(&mut map, from.ok_or(MapDrawingError::StartInShape(drawing.start_m))?);
        Ok(map)
    }
}

/// True if the free floor goes on beyond the map.
fn touches_border(map: &OccupancyGrid) -> bool {
    let (width, height) = (map.info.width, map.info.height);
    let is_free = |cell| map[cell] == FREE;
    (0..width).any(|x| is_free((x, 0)) || is_free((x, height - 1)))
        || (0..height).any(|y| is_free((0, y)) || is_free((width - 1, y)))
}

/// The part of a map with walls that the floor reaches, and a margin; none without walls.
fn cropped(map: &OccupancyGrid, margin_m: f64) -> Option<OccupancyGrid> {
    let info = map.info;
    let borders_free = |(x, y): (usize, usize)| {
        let around = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
        around.into_iter().any(|cell| info.contains(cell) && map[cell] == FREE)
    };
    let cells = (0..info.len()).map(|index| info.cell(index));
    let walls = cells.filter(|cell| map[*cell] == OCCUPIED && borders_free(*cell));
    let (mut low, mut high) = ((usize::MAX, usize::MAX), (0, 0));
    for (x, y) in walls {
        low = (low.0.min(x), low.1.min(y));
        high = (high.0.max(x), high.1.max(y));
    }
    if low.0 == usize::MAX {
        return None;
    }
    let margin = libm::ceil(margin_m / info.resolution_m) as usize;
    let low = (low.0.saturating_sub(margin), low.1.saturating_sub(margin));
    let high = ((high.0 + margin).min(info.width - 1), (high.1 + margin).min(info.height - 1));
    let (x_m, y_m) = info.point_at(low.0 as f64, low.1 as f64);
    let part = GridInfo {
        width: high.0 - low.0 + 1,
        height: high.1 - low.1 + 1,
        origin: Pose2::new(x_m, y_m, 0.0),
        ..info
    };
    let mut drawn = Grid::new(part, UNKNOWN);
    for y in low.1..=high.1 {
        for x in low.0..=high.0 {
            drawn[(x - low.0, y - low.1)] = map[(x, y)];
        }
    }
    Some(drawn)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 10 cells of 1 m, with a wall around the cells from 3 to 6 where `closed`, and without its right side
    /// otherwise.
    fn square(is_closed: bool) -> OccupancyGrid {
        let info = GridInfo {
            resolution_m: 1.0,
            width: 10,
            height: 10,
            origin: Pose2::new(-5.0, -5.0, 0.0),
        };
        let mut map = Grid::new(info, UNKNOWN);
        for at in 3..=6 {
            map[(at, 3)] = OCCUPIED;
            map[(at, 6)] = OCCUPIED;
            map[(3, at)] = OCCUPIED;
            if is_closed {
                map[(6, at)] = OCCUPIED;
            }
        }
        flood(&mut map, (4, 4));
        map
    }

    #[test]
    fn an_enclosed_floor_ends_at_its_walls() {
        let map = square(true);
        assert!(!touches_border(&map));
        let map = cropped(&map, 0.0).unwrap();
        assert_eq!((map.info.width, map.info.height), (4, 4));
        assert_eq!((map.info.origin.x_m, map.info.origin.y_m), (-2.0, -2.0));
        assert_eq!([map[(0, 1)], map[(1, 1)], map[(2, 2)]], [OCCUPIED, FREE, FREE]);
    }

    #[test]
    fn an_open_floor_ends_outside_of_the_outermost_walls() {
        let map = square(false);
        assert!(touches_border(&map));
        let map = cropped(&map, OPEN_MARGIN_M).unwrap();
        assert_eq!((map.info.width, map.info.height), (8, 8));
        assert_eq!(map[(0, 0)], FREE);
    }
}
