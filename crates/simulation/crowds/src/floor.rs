//! Floor on which agents walk: walls, and the clearance of each cell of a grid over it.

use glam::DVec2;
use periplus_geometry::Pose2;
use periplus_grid::{Cell, Grid, GridInfo, NO_SITE_CELLS, squared_distances};

use crate::error::CrowdError;
use crate::wall::{Wall, WallIndex};

/// Cells of routes \[m\].
const RESOLUTION_M: f64 = 0.1;

/// Free space around the walls that still belongs to the floor \[m\].
const MARGIN_M: f64 = 1.0;

/// Most cells of a floor: 400 m by 400 m.
const MAX_CELL_COUNT: f64 = 1.6e7;

/// Clearance below which a cell is too narrow for a body: half the depth of a person, who turns sideways in narrow
/// passages \[m\].
const MIN_CLEARANCE_M: f64 = 0.2;

/// Floor: walls, and cells with their distance to the next wall.
#[derive(Clone, Debug)]
pub struct Floor {
    pub(crate) walls: WallIndex,
    pub(crate) period_m: Option<f64>,
    /// Distance of each cell's centre to the next wall \[m\].
    pub(crate) clearance_m: Grid<f32>,
}

impl Floor {
    /// Floor within and 1 m around walls.
    ///
    /// # Errors
    ///
    /// A wall whose ends are not finite, or walls farther apart than 400 m.
    pub fn new(walls: Vec<Wall>) -> Result<Self, CrowdError> {
        Self::with_period(walls, None)
    }

    /// Floor that repeats along x after a length, as the corridors of experiments do: agents that leave it at one end enter
    /// at the other \[m\]. Walls reach from 0 to the period.
    ///
    /// # Errors
    ///
    /// As [`Floor::new`]; also a period that is not positive.
    pub fn periodic(walls: Vec<Wall>, period_m: f64) -> Result<Self, CrowdError> {
        if !(period_m.is_finite() && period_m > 0.0) {
            return Err(CrowdError::Period(period_m));
        }
        Self::with_period(walls, Some(period_m))
    }

    fn with_period(walls: Vec<Wall>, period_m: Option<f64>) -> Result<Self, CrowdError> {
        let (mut low, mut high) = (DVec2::splat(f64::INFINITY), DVec2::splat(f64::NEG_INFINITY));
        for (number, wall) in walls.iter().enumerate() {
            if !(wall.start.is_finite() && wall.end.is_finite()) {
                return Err(CrowdError::Wall(number));
            }
            low = low.min(wall.start).min(wall.end);
            high = high.max(wall.start).max(wall.end);
        }
        if walls.is_empty() {
            (low, high) = (DVec2::splat(-20.0), DVec2::splat(20.0));
        }
        (low, high) = (low - MARGIN_M, high + MARGIN_M);
        let cells = ((high - low) / RESOLUTION_M).ceil();
        if cells.x * cells.y > MAX_CELL_COUNT {
            return Err(CrowdError::Size([high.x - low.x, high.y - low.y]));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked above"
        )]
        let (columns, rows) = (cells.x as usize, cells.y as usize);
        let info = GridInfo::new(RESOLUTION_M, columns, rows, Pose2::new(low.x, low.y, 0.0))
            .map_err(|_| CrowdError::Size([high.x - low.x, high.y - low.y]))?;
        let clearance_m = clearance(info, &walls);
        Ok(Self { walls: WallIndex::new(walls), period_m, clearance_m })
    }

    /// Returns the walls.
    #[must_use]
    pub fn walls(&self) -> &[Wall] {
        self.walls.walls()
    }

    /// Returns the distance from a point to the next wall, exact up to one cell (0.1 m); zero outside of the floor.
    #[must_use]
    pub fn clearance_m(&self, point: DVec2) -> f64 {
        self.clearance_m.at(point.x, point.y).map_or(0.0, |clearance| f64::from(*clearance))
    }

    /// True where a body can be, from the cells alone.
    pub(crate) fn is_passable(&self, cell: Cell) -> bool {
        self.clearance_m.get(cell).is_some_and(|clearance| f64::from(*clearance) >= MIN_CLEARANCE_M)
    }

    /// Returns the cells of the largest connected passable area with at least a clearance, in the order of the grid.
    /// The area outside of all walls, which the border of the grid belongs to, counts only where there is no other.
    pub(crate) fn largest_area(&self, clearance_m: f64) -> Vec<Cell> {
        let info = self.clearance_m.info;
        let mut area_of = vec![u32::MAX; info.len()];
        let mut best: (bool, usize, u32) = (false, 0, u32::MAX);
        let mut next_area = 0;
        let mut stack = Vec::new();
        for start in 0..info.len() {
            if area_of[start] != u32::MAX || !self.is_passable(info.cell(start)) {
                continue;
            }
            area_of[start] = next_area;
            stack.push(start);
            let (mut count, mut is_inside) = (0, true);
            while let Some(index) = stack.pop() {
                count += 1;
                let (column, row) = info.cell(index);
                let is_border =
                    column == 0 || row == 0 || column + 1 == info.width || row + 1 == info.height;
                is_inside &= !is_border;
                let sides = [
                    (column.wrapping_sub(1), row),
                    (column + 1, row),
                    (column, row.wrapping_sub(1)),
                    (column, row + 1),
                ];
                for side in sides {
                    if info.contains(side) && self.is_passable(side) {
                        let side = info.index(side);
                        if area_of[side] == u32::MAX {
                            area_of[side] = next_area;
                            stack.push(side);
                        }
                    }
                }
            }
            if (is_inside, count) > (best.0, best.1) {
                best = (is_inside, count, next_area);
            }
            next_area += 1;
        }
        (0..info.len())
            .filter(|index| area_of[*index] == best.2 && best.2 != u32::MAX)
            .map(|index| info.cell(index))
            .filter(|cell| f64::from(self.clearance_m[*cell]) >= clearance_m)
            .collect()
    }

    /// Returns points of the largest connected area that is enclosed by walls, each at the centre of a cell (0.1 m) and
    /// at least a clearance from all walls; empty where there are none.
    #[must_use]
    pub fn free_points(&self, clearance_m: f64) -> Vec<DVec2> {
        let info = self.clearance_m.info;
        self.largest_area(clearance_m).into_iter().map(|cell| info.centre_of(cell).into()).collect()
    }
}

/// Distance of each cell to the next wall: exact to the cells that a wall crosses.
fn clearance(info: GridInfo, walls: &[Wall]) -> Grid<f32> {
    let mut grid = Grid::new(info, false);
    for wall in walls {
        let length_m = wall.start.distance(wall.end);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "bounded by the floor"
        )]
        let steps = (length_m / (0.5 * RESOLUTION_M)).ceil() as u32;
        for step in 0..=steps {
            let point = wall.start.lerp(wall.end, f64::from(step) / f64::from(steps.max(1)));
            if let Some(cell) = info.cell_of(point.x, point.y) {
                grid[cell] = true;
            }
        }
    }
    squared_distances(&grid, |is_wall| *is_wall).map(|squared| {
        if *squared == NO_SITE_CELLS {
            return f32::INFINITY;
        }
        #[expect(clippy::cast_possible_truncation, reason = "metres of a building")]
        let distance_m = (f64::from(*squared).sqrt() * RESOLUTION_M) as f32;
        distance_m
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clearance_is_the_distance_to_the_next_wall() {
        let floor = Floor::new(Wall::rectangle([0.0, 0.0], [10.0, 4.0]).to_vec()).unwrap();
        let check = |point: [f64; 2], expected: f64| {
            let found = floor.clearance_m(point.into());
            assert!((found - expected).abs() < 0.11, "{point:?}: {found}");
        };
        check([5.0, 2.0], 2.0);
        check([0.5, 2.0], 0.5);
        check([50.0, 2.0], 0.0);
    }

    #[test]
    fn free_points_are_within_the_walls() {
        let floor = Floor::new(Wall::rectangle([0.0, 0.0], [10.0, 4.0]).to_vec()).unwrap();
        let points = floor.free_points(0.5);
        // 9 m by 3 m at a hundred cells per square metre, up to a row of cells.
        assert!((2600..=2900).contains(&points.len()), "{}", points.len());
        let is_inside =
            |point: &DVec2| (0.4..9.6).contains(&point.x) && (0.4..3.6).contains(&point.y);
        assert!(points.iter().all(is_inside));
    }

    #[test]
    fn what_cannot_be_a_floor_is_refused() {
        let far = Wall::new([0.0, 0.0], [1e6, 1e6]);
        assert!(matches!(Floor::new(vec![far]), Err(CrowdError::Size(_))));
        let nan = Wall::new([0.0, 0.0], [f64::NAN, 0.0]);
        assert_eq!(Floor::new(vec![nan]).err(), Some(CrowdError::Wall(0)));
        assert!(matches!(Floor::periodic(Vec::new(), 0.0), Err(CrowdError::Period(_))));
    }
}
