//! Distance of a robot to walls.

use periplus_grid::{CellFinder, Grid, NO_SITE_CELLS, OccupancyGrid, squared_distances};

use crate::statistics::quantile;

/// Minimum occupancy of walls \[%\]: `occupied_thresh` 0.65 of Nav2.
const OCCUPIED_PERCENT: i8 = 65;

/// Distances of the outline of a robot to walls over a run \[m\]; negative in walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Minimum.
    pub min_m: f64,
    /// 5th percentile.
    pub p05_m: f64,
    /// Mean.
    pub mean_m: f64,
}

impl Clearance {
    /// Returns the statistics of distances \[m\]; none without distances.
    #[must_use]
    pub fn of(distances_m: &[f64]) -> Option<Self> {
        Some(Self {
            min_m: quantile(distances_m, 0.0)?,
            p05_m: quantile(distances_m, 0.05)?,
            mean_m: distances_m.iter().sum::<f64>() / distances_m.len() as f64,
        })
    }

    /// Returns the clearance of a circle of `radius_m` along positions in the frame of a map \[m\]: the
    /// distances of the positions to the sides of occupied cells, minus the radius. Exact for the
    /// cells of the map. None without occupied cells, and without positions in the map.
    #[must_use]
    pub fn on_map(map: &OccupancyGrid, positions_m: &[[f64; 2]], radius_m: f64) -> Option<Self> {
        let field = WallField::new(map);
        let distance_m = |&[x_m, y_m]: &[f64; 2]| field.distance_m(x_m, y_m);
        let distances = positions_m.iter().filter_map(distance_m).map(|it| it - radius_m);
        Self::of(&distances.collect::<Vec<f64>>())
    }
}

/// Exact distances to the sides of occupied cells.
struct WallField<'a> {
    map: &'a OccupancyGrid,
    finder: CellFinder,
    squares: Grid<u32>,
}

impl<'a> WallField<'a> {
    fn new(map: &'a OccupancyGrid) -> Self {
        let squares = squared_distances(map, |cell| *cell >= OCCUPIED_PERCENT);
        Self { map, finder: map.info.finder(), squares }
    }

    /// Distance of a point to the nearest occupied cell \[m\]; none outside the map, and without one.
    fn distance_m(&self, x_m: f64, y_m: f64) -> Option<f64> {
        let cell = self.finder.cell_of(x_m, y_m)?;
        let square = self.squares[cell];
        if square == NO_SITE_CELLS {
            return None;
        }
        let (x, y) = self.finder.cells_to(x_m, y_m);
        // The point is within half a diagonal of the centre of its cell, and so is the nearest side of
        // the centre of the nearest occupied cell.
        let between = f64::from(square).sqrt();
        let reach = between + std::f64::consts::SQRT_2;
        let inner = (between - 2.0 * std::f64::consts::SQRT_2).max(0.0);
        let (column, row) = (cell.0 as i64, cell.1 as i64);
        let mut nearest = f64::INFINITY;
        let rows = reach.ceil() as i64;
        for up in -rows..=rows {
            // The columns of the ring between both radii.
            let height = up as f64;
            let half = |radius: f64| (radius * radius - height * height).max(0.0).sqrt();
            let (low, high) = (half(inner).floor() as i64, half(reach).ceil() as i64);
            for right in (-high..=-low).chain(low..=high) {
                let at = (column + right, row + up);
                let (Ok(u), Ok(v)) = (usize::try_from(at.0), usize::try_from(at.1)) else {
                    continue;
                };
                if self.map.get((u, v)).is_some_and(|cell| *cell >= OCCUPIED_PERCENT) {
                    let outside = |at: f64, low: f64| (low - at).max(at - low - 1.0).max(0.0);
                    let away = libm::hypot(outside(x, u as f64), outside(y, v as f64));
                    nearest = nearest.min(away);
                }
            }
        }
        nearest.is_finite().then_some(nearest * self.map.info.resolution_m)
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_grid::GridInfo;
    use periplus_grid::occupancy::{FREE, OCCUPIED};
    use proptest::prelude::*;

    use super::*;

    fn map(occupied: &[(usize, usize)]) -> OccupancyGrid {
        let info = GridInfo::new(0.5, 20, 10, Pose2::new(-1.0, 0.0, 0.0)).unwrap();
        let mut map = Grid::new(info, FREE);
        for &cell in occupied {
            map[cell] = OCCUPIED;
        }
        map
    }

    #[test]
    fn distances_are_to_the_side_of_the_cell() {
        // Cell (0, 0) is from -1 to -0.5 m along x.
        let positions = [[1.5, 0.25], [0.5, 0.25], [2.5, 0.25]];
        let found = Clearance::on_map(&map(&[(0, 0)]), &positions, 0.25).unwrap();
        assert_eq!(found, Clearance { min_m: 0.75, p05_m: 0.85, mean_m: 1.75 });
    }

    #[test]
    fn a_robot_in_a_wall_has_a_negative_clearance() {
        let found = Clearance::on_map(&map(&[(0, 0)]), &[[-0.75, 0.25]], 0.25).unwrap();
        assert_eq!(found.min_m, -0.25);
    }

    #[test]
    fn clearance_without_walls_or_positions_is_undefined() {
        assert_eq!(Clearance::on_map(&map(&[]), &[[0.0, 1.0]], 0.1), None);
        assert_eq!(Clearance::on_map(&map(&[(0, 0)]), &[[99.0, 1.0]], 0.1), None);
        assert_eq!(Clearance::of(&[]), None);
    }

    proptest! {
        #[test]
        fn distances_are_those_of_a_search(
            occupied in prop::collection::vec((0..20_usize, 0..10_usize), 1..9),
            x_m in -1.0..9.0,
            y_m in 0.0..5.0,
        ) {
            let map = map(&occupied);
            let expected = occupied.iter().map(|&cell| {
                let (u, v) = map.info.centre_of(cell);
                let outside = |away: f64| (away.abs() - 0.25).max(0.0);
                libm::hypot(outside(x_m - u), outside(y_m - v))
            }).fold(f64::INFINITY, f64::min);
            let found = WallField::new(&map).distance_m(x_m, y_m).unwrap();
            prop_assert!((found - expected).abs() < 1e-9, "{} {}", found, expected);
        }
    }
}
