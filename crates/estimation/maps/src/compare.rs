//! Comparison of two maps.

use periplus_geometry::Pose2;
use periplus_grid::occupancy::UNKNOWN;
use periplus_grid::{
    Grid, GridInfo, GridInfoError, NO_SITE_CELLS, OccupancyGrid, squared_distances,
};

use crate::align::{Alignment, align, is_wall};

/// Options of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompareOptions {
    /// True to align the other map first, false to use the origins in the files.
    pub align: bool,
    /// Maximum translation \[m\].
    pub window_m: f64,
    /// Maximum rotation \[rad\].
    pub window_rad: f64,
}

impl Default for CompareOptions {
    fn default() -> Self {
        Self { align: true, window_m: 1.5, window_rad: 0.175 }
    }
}

/// Cell counts of one kind in both maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Overlap {
    /// In both maps.
    pub both: usize,
    /// In the first map only.
    pub first_only: usize,
    /// In the other map only.
    pub other_only: usize,
}

impl Overlap {
    /// Returns the intersection over union; 1 for two empty sets.
    #[must_use]
    pub fn iou(&self) -> f64 {
        let union = self.both + self.first_only + self.other_only;
        if union == 0 { 1.0 } else { self.both as f64 / union as f64 }
    }

    fn count(&mut self, first: bool, other: bool) {
        self.both += usize::from(first && other);
        self.first_only += usize::from(first && !other);
        self.other_only += usize::from(other && !first);
    }
}

/// Distances of the walls of one map to those of another \[m\], between cell centres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Walls {
    /// Number of wall cells.
    pub count: usize,
    /// Mean.
    pub mean_m: f64,
    /// Median.
    pub median_m: f64,
    /// 95th percentile.
    pub p95_m: f64,
    /// Maximum.
    pub largest_m: f64,
}

/// Result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct MapComparison {
    /// Pose of the other map relative to the first.
    pub alignment: Alignment,
    /// Grid of the first map, enlarged to contain both.
    pub info: GridInfo,
    /// Wall cells.
    pub walls: Overlap,
    /// Wall cells, where a neighbouring wall cell counts as a match.
    pub walls_nearby: Overlap,
    /// Free cells.
    pub free: Overlap,
    /// Known cells.
    pub known: Overlap,
    /// Distances from the walls of the first map to those of the other.
    pub first_to_other: Walls,
    /// Distances from the walls of the other map to those of the first.
    pub other_to_first: Walls,
    first: OccupancyGrid,
    other: OccupancyGrid,
}

/// Compares two maps on the grid of the first.
/// # Errors
/// When the common grid would have too many cells.
pub fn compare(
    first: &OccupancyGrid,
    other: &OccupancyGrid,
    options: CompareOptions,
) -> Result<MapComparison, GridInfoError> {
    let alignment = if options.align {
        align(first, other, options.window_m, options.window_rad)
    } else {
        Alignment { reference_from_other: Pose2::IDENTITY, score: f64::NAN }
    };
    let mut laid = other.clone();
    laid.info.origin = alignment.reference_from_other * other.info.origin;
    let info = around(first.info, laid.info)?;
    let (first, other) = (sampled(first, info), sampled(&laid, info));
    let (to_first, to_other) = (distances(&first), distances(&other));

    let (mut walls, mut free, mut known) =
        (Overlap::default(), Overlap::default(), Overlap::default());
    for index in 0..info.len() {
        let (a, b) = (first.cells[index], other.cells[index]);
        walls.count(is_wall(a), is_wall(b));
        let is_free = |cell: i8| cell >= 0 && !is_wall(cell);
        free.count(is_free(a), is_free(b));
        known.count(a >= 0, b >= 0);
    }
    // Diagonal neighbours are at a distance of the square root of two.
    let walls_nearby = walls_within([&first, &other], [&to_first, &to_other], 2.0);
    Ok(MapComparison {
        alignment,
        info,
        walls,
        walls_nearby,
        free,
        known,
        first_to_other: statistics(&first, &to_other),
        other_to_first: statistics(&other, &to_first),
        first,
        other,
    })
}

/// Counts wall cells; a wall cell of the other map within the root of `max_square_cells` counts as a match.
fn walls_within(
    [first, other]: [&OccupancyGrid; 2],
    [to_first, to_other]: [&Grid<u32>; 2],
    max_square_cells: f64,
) -> Overlap {
    let mut walls = Overlap::default();
    let is_near = |square: u32| square != NO_SITE_CELLS && f64::from(square) <= max_square_cells;
    for index in 0..first.cells.len() {
        let (a, b) = (is_wall(first.cells[index]), is_wall(other.cells[index]));
        walls.count(
            a || b && is_near(to_first.cells[index]),
            b || a && is_near(to_other.cells[index]),
        );
    }
    walls
}

impl MapComparison {
    /// Counts wall cells, where a wall cell of the other map within `tolerance_m` metres between the
    /// centres counts as a match.
    #[must_use]
    pub fn walls_within(&self, tolerance_m: f64) -> Overlap {
        let cells = tolerance_m.max(0.0) / self.info.resolution_m;
        let distances = [distances(&self.first), distances(&self.other)];
        // A tolerance of two cells of 0.05 m includes them in spite of rounding.
        let max_square_cells = cells * cells * (1.0 + 1e-9);
        walls_within([&self.first, &self.other], [&distances[0], &distances[1]], max_square_cells)
    }
}

/// Returns the grid of the first map, enlarged to contain both.
fn around(first: GridInfo, other: GridInfo) -> Result<GridInfo, GridInfoError> {
    let finder = first.finder();
    let (mut low, mut high) = ((0_i64, 0_i64), (first.width as i64, first.height as i64));
    for (columns, rows) in
        [(0, 0), (other.width, 0), (0, other.height), (other.width, other.height)]
    {
        let (x_m, y_m) = other.point_at(columns as f64, rows as f64);
        let (column, row) = finder.cells_to(x_m, y_m);
        low = (low.0.min(column.floor() as i64), low.1.min(row.floor() as i64));
        high = (high.0.max(column.ceil() as i64), high.1.max(row.ceil() as i64));
    }
    let size = |low: i64, high: i64| usize::try_from(high.saturating_sub(low)).unwrap_or(0);
    let GridInfo { origin, .. } = first.moved(low.0, low.1);
    GridInfo::new(first.resolution_m, size(low.0, high.0), size(low.1, high.1), origin)
}

/// Resamples a map. A cell larger than those of the map gets the highest occupancy that it
/// contains, which preserves thin walls.
fn sampled(map: &OccupancyGrid, info: GridInfo) -> OccupancyGrid {
    let finder = map.info.finder();
    let per_side = (info.resolution_m / map.info.resolution_m).round().clamp(1.0, 16.0) as usize;
    let part = 1.0 / per_side as f64;
    let cells = (0..info.len()).map(|index| {
        let (column, row) = info.cell(index);
        let mut value = UNKNOWN;
        for step in 0..per_side * per_side {
            let right = (column as f64) + ((step % per_side) as f64 + 0.5) * part;
            let up = (row as f64) + ((step / per_side) as f64 + 0.5) * part;
            let (x_m, y_m) = info.point_at(right, up);
            if let Some(&found) = finder.cell_of(x_m, y_m).and_then(|cell| map.get(cell)) {
                value = value.max(found);
            }
        }
        value
    });
    Grid { info, cells: cells.collect() }
}

fn distances(map: &OccupancyGrid) -> Grid<u32> {
    squared_distances(map, |&cell| is_wall(cell))
}

fn statistics(map: &OccupancyGrid, squares: &Grid<u32>) -> Walls {
    let mut found: Vec<u32> = map
        .cells
        .iter()
        .zip(&squares.cells)
        .filter(|&(&cell, &square)| is_wall(cell) && square != NO_SITE_CELLS)
        .map(|(_, &square)| square)
        .collect();
    let count = found.len();
    if count == 0 {
        let count = map.cells.iter().filter(|&&cell| is_wall(cell)).count();
        let nothing = f64::NAN;
        return Walls {
            count,
            mean_m: nothing,
            median_m: nothing,
            p95_m: nothing,
            largest_m: nothing,
        };
    }
    found.sort_unstable();
    let metres = |square: u32| f64::from(square).sqrt() * map.info.resolution_m;
    let at = |share: f64| metres(found[((count - 1) as f64 * share).round() as usize]);
    Walls {
        count,
        mean_m: found.iter().map(|&square| metres(square)).sum::<f64>() / count as f64,
        median_m: at(0.5),
        p95_m: at(0.95),
        largest_m: at(1.0),
    }
}

/// Returns width, height and RGB pixels of an image of both maps, top row first: walls of both are
/// black, of the first only blue, of the other only red; free in both is white, free in one only a
/// light tint of its colour; unknown cells are grey.
#[must_use]
pub fn picture(comparison: &MapComparison) -> (u32, u32, Vec<u8>) {
    let GridInfo { width, height, .. } = comparison.info;
    let rows = comparison.first.rows().rev().zip(comparison.other.rows().rev());
    let pixels = rows.flat_map(|(first, other)| first.iter().zip(other));
    let bytes = pixels.flat_map(|(&a, &b)| match (is_wall(a), is_wall(b), a >= 0, b >= 0) {
        (true, true, ..) => [0, 0, 0],
        (true, false, ..) => [0, 90, 255],
        (false, true, ..) => [235, 30, 30],
        (_, _, true, true) => [255, 255, 255],
        (_, _, true, false) => [214, 228, 255],
        (_, _, false, true) => [255, 222, 222],
        _ => [190, 190, 190],
    });
    let side = |cells: usize| u32::try_from(cells).unwrap_or(u32::MAX);
    (side(width), side(height), bytes.collect())
}

#[cfg(test)]
mod tests {
    use periplus_grid::occupancy::{FREE, OCCUPIED};

    use super::*;

    fn map(width: usize, height: usize, x_m: f64, cells: &[i8]) -> OccupancyGrid {
        let info = GridInfo::new(1.0, width, height, Pose2::new(x_m, 0.0, 0.0)).unwrap();
        Grid::from_cells(info, cells.to_vec()).unwrap()
    }

    const AS_IT_LIES: CompareOptions =
        CompareOptions { align: false, window_m: 0.0, window_rad: 0.0 };

    #[test]
    fn a_map_is_like_itself() {
        let map = map(3, 1, 0.0, &[OCCUPIED, FREE, UNKNOWN]);
        let same = compare(&map, &map, AS_IT_LIES).unwrap();
        assert_eq!([same.walls.iou(), same.free.iou(), same.known.iou()], [1.0; 3]);
        assert_eq!(same.first_to_other.largest_m, 0.0);
        assert_eq!(picture(&same), (3, 1, vec![0, 0, 0, 255, 255, 255, 190, 190, 190]));
    }

    #[test]
    fn a_wall_beside() {
        let first = map(3, 1, 0.0, &[OCCUPIED, FREE, FREE]);
        let other = map(3, 1, 1.0, &[OCCUPIED, FREE, FREE]);
        let found = compare(&first, &other, AS_IT_LIES).unwrap();
        assert_eq!((found.info.width, found.walls.iou()), (4, 0.0));
        assert_eq!(found.walls_nearby.iou(), 1.0);
        assert_eq!((found.free.both, found.free.first_only, found.free.other_only), (1, 1, 1));
        assert_eq!((found.first_to_other.mean_m, found.other_to_first.median_m), (1.0, 1.0));
    }

    #[test]
    fn thin_walls_of_a_finer_map_stay() {
        let fine = GridInfo::new(0.25, 8, 4, Pose2::IDENTITY).unwrap();
        let mut thin = Grid::new(fine, FREE);
        thin[(1, 2)] = OCCUPIED;
        let found = compare(&map(2, 1, 0.0, &[OCCUPIED, FREE]), &thin, AS_IT_LIES).unwrap();
        assert_eq!(found.walls, Overlap { both: 1, first_only: 0, other_only: 0 });
    }

    #[test]
    fn without_walls_nothing_is_measured() {
        let empty = map(2, 1, 0.0, &[FREE, FREE]);
        let found =
            compare(&map(2, 1, 0.0, &[OCCUPIED, FREE]), &empty, CompareOptions::default()).unwrap();
        assert_eq!(found.first_to_other.count, 1);
        assert!(found.first_to_other.mean_m.is_nan() && found.other_to_first.count == 0);
    }

    #[test]
    fn maps_far_apart_are_refused() {
        let map = map(1, 1, 0.0, &[OCCUPIED]);
        let far = Grid { info: map.info.moved(1 << 40, 1 << 40), ..map.clone() };
        assert!(compare(&map, &far, AS_IT_LIES).is_err());
    }
}
