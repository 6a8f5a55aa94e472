//! How far each cell is from the nearest of some.

use crate::grid::Grid;

/// The squared distance where there is nothing to be near to.
pub const NOWHERE: u32 = u32::MAX;

/// Column distance to nothing. Its square is above any real one and fits into 64 bits twice.
const FAR: u32 = 1 << 30;

/// The square of the exact Euclidean distance, from centre to centre in cells, to the nearest cell
/// for which `is_site` holds; [`NOWHERE`] when it holds for none. Squares that do not fit are one
/// less than that: no lattice with fewer than 46,000 cells on a side has such.
///
/// Exact whole numbers, in time linear in the cells whatever they say: distances along columns first,
/// then along each row the lower envelope of the parabolas that stand on them.
///
/// Sources: Meijster, Roerdink, Hesselink, "A general algorithm for computing distance transforms in
/// linear time", 2000; Felzenszwalb, Huttenlocher, "Distance transforms of sampled functions", 2012.
#[must_use]
pub fn squared_distances<T>(grid: &Grid<T>, mut is_site: impl FnMut(&T) -> bool) -> Grid<u32> {
    let lattice = grid.lattice;
    let width = lattice.width;
    let mut cells = vec![FAR; lattice.len()];
    if width == 0 {
        return Grid { lattice, cells };
    }
    // Down and up all columns at once, a row at a time, as rows lie together in memory.
    for (distance, value) in cells.iter_mut().zip(&grid.cells) {
        if is_site(value) {
            *distance = 0;
        }
    }
    for row in 1..lattice.height {
        let (below, here) = cells.split_at_mut(row * width);
        nearer(&mut here[..width], &below[(row - 1) * width..]);
    }
    for row in (1..lattice.height).rev() {
        let (below, here) = cells.split_at_mut(row * width);
        nearer(&mut below[(row - 1) * width..], &here[..width]);
    }
    let mut envelope = Envelope::default();
    for row in cells.chunks_exact_mut(width) {
        envelope.lower(row);
    }
    Grid { lattice, cells }
}

/// A cell is at most one further from a site than its neighbour in the column.
fn nearer(row: &mut [u32], neighbours: &[u32]) {
    for (distance, neighbour) in row.iter_mut().zip(neighbours) {
        *distance = (*distance).min(*neighbour + 1).min(FAR);
    }
}

/// Parabolas that are lowest somewhere along a row, from left to right.
#[derive(Default)]
struct Envelope {
    parabolas: Vec<Parabola>,
}

struct Parabola {
    /// Where it is lowest.
    column: i64,
    /// How high it is there.
    height: i64,
    /// The first column in which it is the lowest of all.
    first: i64,
}

impl Parabola {
    fn at(&self, column: i64) -> i64 {
        (column - self.column).pow(2) + self.height
    }
}

impl Envelope {
    /// Distances along columns become squared distances.
    fn lower(&mut self, row: &mut [u32]) {
        self.parabolas.clear();
        let width = row.len() as i64;
        for (column, &distance) in row.iter().enumerate() {
            if distance == FAR {
                continue;
            }
            self.push(column as i64, i64::from(distance).pow(2), width);
        }
        if self.parabolas.is_empty() {
            row.fill(NOWHERE);
            return;
        }
        let mut lowest = 0;
        for (column, distance) in row.iter_mut().enumerate() {
            let column = column as i64;
            while self.parabolas.get(lowest + 1).is_some_and(|next| next.first <= column) {
                lowest += 1;
            }
            let squared = self.parabolas[lowest].at(column);
            *distance = u32::try_from(squared).map_or(NOWHERE - 1, |it| it.min(NOWHERE - 1));
        }
    }

    fn push(&mut self, column: i64, height: i64, width: i64) {
        // Whoever is not lower where its own reign begins is lowest nowhere.
        while let Some(last) = self.parabolas.last() {
            let here = (last.first - column).pow(2) + height;
            if here > last.at(last.first) {
                break;
            }
            self.parabolas.pop();
        }
        let first = match self.parabolas.last() {
            None => 0,
            // Behind the column where both are equally high the new one is the lower.
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
    use crate::lattice::Lattice;

    fn sites(width: usize, height: usize, cells: Vec<bool>) -> Grid<bool> {
        let lattice = Lattice::new(1.0, width, height, Pose2::IDENTITY).unwrap();
        Grid::from_cells(lattice, cells).unwrap()
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
        assert_eq!(squares.cells, [NOWHERE; 4]);
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
                let (x, y) = grid.lattice.cell(index);
                let nearest = (0..grid.cells.len()).filter(|&site| grid.cells[site]).map(|site| {
                    let (site_x, site_y) = grid.lattice.cell(site);
                    (x.abs_diff(site_x).pow(2) + y.abs_diff(site_y).pow(2)) as u32
                }).min();
                prop_assert_eq!(squares.cells[index], nearest.unwrap_or(NOWHERE));
            }
        }
    }
}
