//! Rasterization of polygons.
//!
//! Source: `Costmap2D::convexFillCells`: lines of cells along the outline, and in each column all
//! cells between the lowest and the highest.

use periplus_grid::{Cell, Line};

use crate::Costmap;

/// Columns of a polygon: first and last row of each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PolygonColumns {
    first: usize,
    rows: Vec<(usize, usize)>,
}

impl PolygonColumns {
    /// Rasterizes a convex polygon \[m\]; none unless all corners are inside the grid, as the
    /// reference requires.
    pub(crate) fn of(costmap: &Costmap, corners: &[[f64; 2]]) -> Option<Self> {
        let finder = costmap.finder();
        let cells: Option<Vec<Cell>> =
            corners.iter().map(|[x_m, y_m]| finder.cell_of(*x_m, *y_m)).collect();
        let cells = cells?;
        if cells.len() < 3 {
            return None;
        }
        let first = cells.iter().map(|cell| cell.0).min()?;
        let last = cells.iter().map(|cell| cell.0).max()?;
        let mut rows = vec![(usize::MAX, 0); last - first + 1];
        for (index, cell) in cells.iter().enumerate() {
            for (x, y) in Line::between(*cell, cells[(index + 1) % cells.len()]) {
                let (low, high) = &mut rows[x - first];
                *low = (*low).min(y);
                *high = (*high).max(y);
            }
        }
        Some(Self { first, rows })
    }

    /// Iterates over the cells.
    pub(crate) fn cells(&self) -> impl Iterator<Item = Cell> + '_ {
        self.rows.iter().enumerate().flat_map(move |(column, &(low, high))| {
            (low..=high).map(move |row| (self.first + column, row))
        })
    }
}
