//! Decomposition of the walls of a map into rectangles.

use periplus_grid::OccupancyGrid;

/// Occupancy from which a cell is a wall, in percent: Nav2's `occupied_thresh` of 0.65.
pub const MIN_WALL_PERCENT: i8 = 65;

/// A rectangle of wall cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WallBox {
    /// Leftmost column.
    pub column: usize,
    /// Lowest row.
    pub row: usize,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
}

/// Covers all cells of at least [`MIN_WALL_PERCENT`] with disjoint rectangles that contain no other
/// cells. From each remaining cell the larger of two rectangles is used: extended first along x and
/// then along y, or the reverse. The run time is linear in the number of cells.
#[must_use]
pub fn wall_boxes(map: &OccupancyGrid) -> Vec<WallBox> {
    let (width, height) = (map.info.width, map.info.height);
    let mut is_left: Vec<bool> = map.cells.iter().map(|cell| *cell >= MIN_WALL_PERCENT).collect();
    let mut boxes = Vec::new();
    for row in 0..height {
        for column in 0..width {
            if !is_left[row * width + column] {
                continue;
            }
            let at = |c: usize, r: usize| c < width && r < height && is_left[r * width + c];
            let wide = {
                let columns = (1..).find(|n| !at(column + n, row)).unwrap_or(1);
                let is_row = |r: usize| (column..column + columns).all(|c| at(c, r));
                let rows = (1..).find(|n| !is_row(row + n)).unwrap_or(1);
                WallBox { column, row, columns, rows }
            };
            let high = {
                let rows = (1..).find(|n| !at(column, row + n)).unwrap_or(1);
                let is_column = |c: usize| (row..row + rows).all(|r| at(c, r));
                let columns = (1..).find(|n| !is_column(column + n)).unwrap_or(1);
                WallBox { column, row, columns, rows }
            };
            let larger =
                if high.columns * high.rows > wide.columns * wide.rows { high } else { wide };
            for r in row..row + larger.rows {
                let start = r * width + column;
                is_left[start..start + larger.columns].fill(false);
            }
            boxes.push(larger);
        }
    }
    boxes
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{Pose2, Stream};
    use periplus_grid::{Grid, GridInfo};

    use super::*;

    fn map(rows_from_above: &[&str]) -> OccupancyGrid {
        let (width, height) = (rows_from_above[0].len(), rows_from_above.len());
        let info = GridInfo::new(0.5, width, height, Pose2::default()).expect("a valid grid");
        let cells = rows_from_above.iter().rev().flat_map(|row| row.bytes());
        let cells = cells.map(|byte| if byte == b'#' { 100 } else { 0 }).collect();
        Grid::from_cells(info, cells).expect("as many cells")
    }

    #[test]
    fn a_room_is_four_boxes() {
        assert_eq!(wall_boxes(&map(&["#####", "#...#", "#...#", "#####"])).len(), 4);
        assert_eq!(
            wall_boxes(&map(&["....", ".##.", ".##.", "...."])),
            [WallBox { column: 1, row: 1, columns: 2, rows: 2 }]
        );
        assert_eq!(wall_boxes(&map(&["...", "..."])), []);
    }

    #[test]
    fn every_wall_cell_is_covered_once_and_nothing_else() {
        let mut stream = Stream::keyed(7, "boxes", 0);
        for _ in 0..50 {
            let info = GridInfo::new(0.1, 17, 23, Pose2::default()).expect("a valid grid");
            let cells = (0..17 * 23).map(|_| if stream.unit() < 0.6 { 100 } else { -1 }).collect();
            let map: OccupancyGrid = Grid::from_cells(info, cells).expect("as many cells");
            let mut covered = vec![0_u32; map.cells.len()];
            for one in wall_boxes(&map) {
                for row in one.row..one.row + one.rows {
                    for column in one.column..one.column + one.columns {
                        covered[row * 17 + column] += 1;
                    }
                }
            }
            let expected: Vec<u32> = map.cells.iter().map(|cell| u32::from(*cell == 100)).collect();
            assert_eq!(covered, expected);
        }
    }
}
