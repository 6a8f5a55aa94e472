//! Euclidean distance transform.

use crate::grid::Grid;

/// Squared distance where the grid has no site.
pub const NO_SITE_CELLS: u32 = u32::MAX;

/// Column distance without a site. Its square is above any real one, and twice the square fits into
/// 64 bits.
const FAR_CELLS: u32 = 1 << 30;

/// Returns the square of the exact Euclidean distance \[cells²\], between cell centres, to the
/// nearest cell for which `is_site` holds; [`NO_SITE_CELLS`] if there is no such cell. Larger
/// squares are clamped to one less; they do not occur on grids with fewer than 46,000 cells on a
/// side.
/// Exact integers, in time linear in the number of cells: first distances along columns, then along
/// each row the lower envelope of their parabolas.
///
/// Sources: Meijster, Roerdink, Hesselink, "A general algorithm for computing distance transforms in
/// linear time", 2000; Felzenszwalb, Huttenlocher, "Distance transforms of sampled functions", 2012.
#[must_use]
pub fn squared_distances<T>(grid: &Grid<T>, mut is_site: impl FnMut(&T) -> bool) -> Grid<u32> {
    let info = grid.info;
    let width = info.width;
    let mut cells = vec![FAR_CELLS; info.len()];
    if width == 0 {
        return Grid { info, cells };
    }
    // All columns at once, first down and then up: rows are contiguous in memory.
    for (distance, value) in cells.iter_mut().zip(&grid.cells) {
        if is_site(value) {
            *distance = 0;
        }
    }
    for row in 1..info.height {
        let (below, here) = cells.split_at_mut(row * width);
        nearer(&mut here[..width], &below[(row - 1) * width..]);
    }
    for row in (1..info.height).rev() {
        let (below, here) = cells.split_at_mut(row * width);
        nearer(&mut below[(row - 1) * width..], &here[..width]);
    }
    let mut envelope = Envelope::default();
    for row in cells.chunks_exact_mut(width) {
        envelope.lower(row);
    }
    Grid { info, cells }
}

/// The distance of a cell is at most one above that of its neighbour in the column.
fn nearer(row: &mut [u32], neighbours: &[u32]) {
    for (distance, neighbour) in row.iter_mut().zip(neighbours) {
        *distance = (*distance).min(*neighbour + 1).min(FAR_CELLS);
    }
}

/// Lower envelope of the parabolas of a row, from left to right.
#[derive(Default)]
struct Envelope {
    parabolas: Vec<Parabola>,
}

struct Parabola {
    /// Column of the minimum.
    column: i64,
    /// Value at the minimum.
    height: i64,
    /// First column in which this parabola is the lowest.
    first: i64,
}

impl Parabola {
    fn at(&self, column: i64) -> i64 {
        (column - self.column).pow(2) + self.height
    }
}

impl Envelope {
    /// Replaces distances along columns with squared distances.
    fn lower(&mut self, row: &mut [u32]) {
        self.parabolas.clear();
        let width = row.len() as i64;
        for (column, &distance) in row.iter().enumerate() {
            if distance == FAR_CELLS {
                continue;
            }
            self.push(column as i64, i64::from(distance).pow(2), width);
        }
        if self.parabolas.is_empty() {
            row.fill(NO_SITE_CELLS);
            return;
        }
        let mut lowest = 0;
        for (column, distance) in row.iter_mut().enumerate() {
            let column = column as i64;
            while self.parabolas.get(lowest + 1).is_some_and(|next| next.first <= column) {
                lowest += 1;
            }
            let squared = self.parabolas[lowest].at(column);
            *distance =
                u32::try_from(squared).map_or(NO_SITE_CELLS - 1, |it| it.min(NO_SITE_CELLS - 1));
        }
    }

    fn push(&mut self, column: i64, height: i64, width: i64) {
        // A parabola that is not lower at the start of its interval is lower nowhere.
        while let Some(last) = self.parabolas.last() {
            let here = (last.first - column).pow(2) + height;
            if here > last.at(last.first) {
                break;
            }
            self.parabolas.pop();
        }
        let first = match self.parabolas.last() {
            None => 0,
            // The new parabola is lower beyond the column of the intersection.
            Some(last) => {
                let rise = column.pow(2) - last.column.pow(2) + height - last.height;
                rise.div_euclid(2 * (column - last.column)) + 1
            }
        };
        if first < width {
            self.parabolas.push(Parabola { column, height, first });
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;
    use crate::info::GridInfo;

    fn sites(width: usize, height: usize, cells: Vec<bool>) -> Grid<bool> {
        let info = GridInfo::new(1.0, width, height, Pose2::IDENTITY).unwrap();
        Grid::from_cells(info, cells).unwrap()
    }

    #[test]
    fn squares_around_one_cell() {
        let mut grid = sites(3, 3, vec![false; 9]);
        grid[(0, 1)] = true;
        let squares = squared_distances(&grid, |&is| is);
        assert_eq!(squares.cells, [1, 2, 5, 0, 1, 4, 1, 2, 5]);
    }

    #[test]
    fn nothing_to_be_near_to() {
        let squares = squared_distances(&sites(2, 2, vec![false; 4]), |&is| is);
        assert_eq!(squares.cells, [NO_SITE_CELLS; 4]);
        assert!(squared_distances(&sites(0, 5, vec![]), |&is| is).cells.is_empty());
    }

    proptest! {
        #[test]
        fn as_when_all_are_compared((width, height, cells) in (1..24_usize, 1..24_usize)
            .prop_flat_map(|(width, height)| {
                let cells = prop::collection::vec(prop::bool::weighted(0.06), width * height);
                (Just(width), Just(height), cells)
            })
        ) {
            let grid = sites(width, height, cells);
            let squares = squared_distances(&grid, |&is| is);
            for index in 0..squares.cells.len() {
                let (x, y) = grid.info.cell(index);
                let nearest = (0..grid.cells.len()).filter(|&site| grid.cells[site]).map(|site| {
                    let (site_x, site_y) = grid.info.cell(site);
                    (x.abs_diff(site_x).pow(2) + y.abs_diff(site_y).pow(2)) as u32
                }).min();
                prop_assert_eq!(squares.cells[index], nearest.unwrap_or(NO_SITE_CELLS));
            }
        }
    }
}
