//! Inflation: costs that decrease with the distance from obstacles.
//!
//! [`inflate`] is exact: every cell gets the cost of its Euclidean distance to the nearest
//! obstacle. The result equals that of the distance transform of Nav2's main branch, and of the
//! wavefront of earlier releases but for the wavefront's rare detours.

mod near;
mod table;

pub use table::CostTable;

use periplus_grid::{Grid, GridInfo, squared_distances};

use crate::cost::{LETHAL, UNKNOWN};
use crate::{CellWindow, Costmap};

use near::{NearBuffers, Squares};

/// Maximum radius of the fast algorithm \[cells\]: squares of larger radii do not fit into 16 bits.
const MAX_FAST_RADIUS_CELLS: u32 = 254;

/// Maximum radius whose squares fit into a byte \[cells\].
const MAX_BYTE_RADIUS_CELLS: u32 = 15;

/// Inflation settings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InflationSettings {
    /// True if unknown cells get all costs, false if only certain collisions.
    pub into_unknown: bool,
    /// True if unknown cells are inflated like obstacles.
    pub around_unknown: bool,
}

/// Reusable buffers.
#[derive(Clone, Debug, Default)]
pub struct InflationBuffers {
    near: NearBuffers,
}

/// Sets each cell of a window to the cost of its distance to the nearest lethal cell, unless its
/// cost is higher. Obstacles outside the window count up to the radius of the table.
/// The run time is that of reading the window and its margin a few times, whatever the size of the
/// map.
pub fn inflate(
    master: &mut Costmap,
    window: &CellWindow,
    table: &CostTable,
    how: InflationSettings,
    scratch: &mut InflationBuffers,
) {
    let info = *master.info();
    let window = window.intersection(&CellWindow::all(&info));
    if window.is_empty() || table.radius_cells() == 0 {
        return;
    }
    if table.radius_cells() > MAX_FAST_RADIUS_CELLS {
        return inflate_far(master, &window, table, how);
    }
    let lowest_of_unknown = if how.into_unknown { 1 } else { crate::cost::INSCRIBED };
    let write = Write { costs: table.costs(), lowest_of_unknown };
    let area = window.grown(table.radius_cells() as usize, &info);
    let near = &mut scratch.near;
    let costs = master.costs_mut();
    if table.radius_cells() <= MAX_BYTE_RADIUS_CELLS {
        near.run::<u8>(costs, info.width, &window, &area, table, how, &write);
    } else {
        near.run::<u16>(costs, info.width, &window, &area, table, how, &write);
    }
}

/// Writer of costs.
struct Write<'a> {
    /// By squared distance \[cells\].
    costs: &'a [u8],
    /// Minimum cost that overwrites an unknown cell.
    lowest_of_unknown: u8,
}

impl Write<'_> {
    #[inline(always)]
    fn combine(&self, old: u8, cost: u8) -> u8 {
        if old == UNKNOWN {
            if cost >= self.lowest_of_unknown { cost } else { UNKNOWN }
        } else {
            old.max(cost)
        }
    }

    #[inline(always)]
    fn row<S: Squares>(&self, cells: &mut [u8], squares: &[S]) {
        for (cell, square) in cells.iter_mut().zip(squares) {
            // Distances beyond the table have no cost.
            let cost = self.costs.get(square.index()).copied().unwrap_or(0);
            *cell = self.combine(*cell, cost);
        }
    }
}

fn is_obstacle(cost: u8, how: InflationSettings) -> bool {
    cost == LETHAL || (how.around_unknown && cost == UNKNOWN)
}

/// Inflation with any radius.
fn inflate_far(
    master: &mut Costmap,
    window: &CellWindow,
    table: &CostTable,
    how: InflationSettings,
) {
    let info = *master.info();
    let radius = usize::try_from(table.radius_cells()).unwrap_or(usize::MAX);
    let area = window.grown(radius, &info);
    let part = GridInfo { width: area.width(), height: area.height(), ..info };
    let cells: Vec<u8> =
        area.spans(info.width).flat_map(|span| master.costs()[span].iter().copied()).collect();
    let squares = squared_distances(&Grid { info: part, cells }, |cost| is_obstacle(*cost, how));
    let lowest_of_unknown = if how.into_unknown { 1 } else { crate::cost::INSCRIBED };
    let write = Write { costs: &[], lowest_of_unknown };
    for (row, span) in (window.y0..window.yn).zip(window.spans(info.width)) {
        let first = (row - area.y0) * part.width + window.x0 - area.x0;
        let squares = &squares.cells[first..first + window.width()];
        for (cell, square) in master.costs_mut()[span].iter_mut().zip(squares) {
            *cell = write.combine(*cell, table.cost(*square));
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;
    use crate::Nav2Release;
    use crate::cost::INSCRIBED;

    fn costmap(width: usize, cells: &[u8]) -> Costmap {
        let info = GridInfo::new(0.1, width, cells.len() / width, Pose2::IDENTITY).unwrap();
        let mut costmap = Costmap::new(info, 0);
        costmap.costs_mut().copy_from_slice(cells);
        costmap
    }

    /// By the definition: for every cell of the window all cells of the grid.
    fn brute_force(
        before: &Costmap,
        window: &CellWindow,
        table: &CostTable,
        how: InflationSettings,
    ) -> Vec<u8> {
        let width = before.info().width;
        let mut after = before.costs().to_vec();
        for y in window.y0..window.yn {
            for x in window.x0..window.xn {
                let nearest = (0..after.len())
                    .filter(|index| is_obstacle(before.costs()[*index], how))
                    .map(|i| {
                        ((i % width).abs_diff(x).pow(2) + (i / width).abs_diff(y).pow(2)) as u32
                    })
                    .min();
                let cost = nearest.map_or(0, |square| table.cost(square));
                let old = before.costs()[y * width + x];
                after[y * width + x] = match old {
                    UNKNOWN if how.into_unknown && cost > 0 => cost,
                    UNKNOWN if cost >= INSCRIBED => cost,
                    UNKNOWN => UNKNOWN,
                    _ => old.max(cost),
                };
            }
        }
        after
    }

    fn cells() -> impl Strategy<Value = Vec<u8>> {
        let cell = prop_oneof![
            30 => Just(0_u8), 2 => Just(LETHAL), 1 => Just(UNKNOWN), 1 => Just(INSCRIBED), 1 => 1..253_u8
        ];
        proptest::collection::vec(cell, 70 * 9)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn inflation_equals_brute_force(
            cells in cells(), radius_m in prop_oneof![0.05..1.5, 1.5..7.0, 26.0..27.0],
            inscribed_m in 0.0..0.6, x0 in 0..70_usize, y0 in 0..9_usize,
            into_unknown: bool, around_unknown: bool, is_wide: bool,
        ) {
            let mut costmap = costmap(if is_wide { 70 } else { 9 }, &cells);
            let info = *costmap.info();
            let (x0, y0) = (x0.min(info.width - 1), y0.min(info.height - 1));
            let window = CellWindow { x0, y0, xn: info.width, yn: info.height };
            let table = CostTable::new(0.1, radius_m, inscribed_m, 2.0, Nav2Release::Main);
            let how = InflationSettings { into_unknown, around_unknown };
            let expected = brute_force(&costmap, &window, &table, how);
            inflate(&mut costmap, &window, &table, how, &mut InflationBuffers::default());
            prop_assert_eq!(costmap.costs(), expected);
        }

        #[test]
        fn costs_grow_with_the_radius(cells in cells(), small_m in 0.05..1.0, more_m in 0.0..1.0) {
            let inflated = |radius_m| {
                let mut costmap = costmap(70, &cells);
                let all = CellWindow::all(costmap.info());
                let table = CostTable::new(0.1, radius_m, 0.15, 2.0, Nav2Release::Main);
                let how = InflationSettings::default();
                inflate(&mut costmap, &all, &table, how, &mut InflationBuffers::default());
                costmap
            };
            let (small, large) = (inflated(small_m), inflated(small_m + more_m));
            for (small, large) in small.costs().iter().zip(large.costs()) {
                // Unknown is the lowest knowledge, although its number is the highest.
                prop_assert!(small <= large || *small == UNKNOWN);
            }
        }

        #[test]
        fn a_part_at_a_time_is_the_same_as_all_at_once(cells in cells(), cut in 1..70_usize) {
            let table = CostTable::new(0.1, 0.55, 0.15, 2.0, Nav2Release::Main);
            let (mut whole, mut parts) = (costmap(70, &cells), costmap(70, &cells));
            let all = CellWindow::all(whole.info());
            let mut scratch = InflationBuffers::default();
            let how = InflationSettings::default();
            inflate(&mut whole, &all, &table, how, &mut scratch);
            inflate(&mut parts, &CellWindow { xn: cut, ..all }, &table, how, &mut scratch);
            inflate(&mut parts, &CellWindow { x0: cut, ..all }, &table, how, &mut scratch);
            prop_assert_eq!(whole, parts);
        }
    }
}
