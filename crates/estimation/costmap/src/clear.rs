//! Clear services of a costmap.
//!
//! Source: `nav2_costmap_2d/src/clear_costmap_service.cpp`, `costmap_layer.cpp`.

use periplus_grid::GridInfo;

use crate::cost::UNKNOWN;
use crate::costmap::cell_clamped;
use crate::{CellWindow, ClearError, Costmap, LayeredCostmap, Nav2Release, UnclearableLayer};

/// Area that a clear service clears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// A square around a point of the global frame \[m\].
    Around {
        /// Centre, x.
        x_m: f64,
        /// Centre, y.
        y_m: f64,
        /// Side length.
        side_m: f64,
    },
    /// Everything outside a square.
    Except {
        /// Centre, x.
        x_m: f64,
        /// Centre, y.
        y_m: f64,
        /// Side length.
        side_m: f64,
    },
    /// The whole layer.
    Everything,
}

/// Clears an area of the named layers, or of all clearable layers when no name is given. Only the
/// grids of the layers change; the next update copies the change into the costmap.
/// # Errors
/// The reason for which no layer was cleared: at least one layer is unknown or not clearable.
pub fn clear(
    costmap: &mut LayeredCostmap,
    region: Region,
    names: &[String],
) -> Result<(), ClearError> {
    refuse_unfit(costmap, names)?;
    if names.is_empty() && region == Region::Everything {
        costmap.reset();
        return Ok(());
    }
    let compat = costmap.frame().compat;
    let info = *costmap.costmap().info();
    for layer in costmap.all_mut() {
        let is_meant = names.is_empty() || names.iter().any(|name| name == layer.name());
        if !is_meant || !layer.is_clearable() {
            continue;
        }
        // The grid of a layer may lag behind a rolling costmap; its own cells apply.
        let cells = *layer.grid().map_or(&info, Costmap::info);
        let corner = |x_m, y_m, side_m| corners(&cells, [x_m, y_m], side_m, compat);
        match region {
            Region::Around { x_m, y_m, side_m } => {
                let (start, end) = corner(x_m, y_m, side_m);
                layer.clear_area(start, end, false, compat);
            }
            Region::Except { x_m, y_m, side_m } => {
                let (start, end) = corner(x_m, y_m, side_m);
                layer.clear_area(start, end, true, compat);
            }
            Region::Everything => layer.reset(),
        }
    }
    if region == Region::Everything {
        costmap.reset_costs();
    }
    Ok(())
}

/// Returns the cells of the lower left and the upper right corner of a square around a point.
fn corners(
    cells: &GridInfo,
    [x_m, y_m]: [f64; 2],
    side_m: f64,
    compat: Nav2Release,
) -> ((i64, i64), (i64, i64)) {
    let (x_m, y_m) = (x_m - side_m / 2.0, y_m - side_m / 2.0);
    let cell = |x_m, y_m| {
        if compat.clamps_cleared_areas() {
            return cells.whole_cells_to(x_m, y_m);
        }
        let (x, y) = cell_clamped(cells, x_m, y_m);
        (x as i64, y as i64)
    };
    (cell(x_m, y_m), cell(x_m + side_m, y_m + side_m))
}

fn refuse_unfit(costmap: &LayeredCostmap, names: &[String]) -> Result<(), ClearError> {
    let mut unfit = Vec::new();
    for name in names {
        match costmap.layers().iter().find(|layer| layer.name() == name) {
            None => unfit.push(UnclearableLayer::Unknown(name.clone())),
            Some(layer) if !layer.is_clearable() => {
                unfit.push(UnclearableLayer::NotClearable(name.clone()));
            }
            Some(_) => {}
        }
    }
    if unfit.is_empty() {
        return Ok(());
    }
    let clearable = costmap
        .layers()
        .iter()
        .filter(|layer| layer.is_clearable())
        .map(|layer| layer.name().to_owned())
        .collect();
    Err(ClearError { layers: unfit, clearable })
}

/// Sets the cells strictly between two corners to unknown, or with `invert` all other cells.
pub fn clear_cells(
    grid: &mut Costmap,
    start: (i64, i64),
    end: (i64, i64),
    invert: bool,
    compat: Nav2Release,
) {
    let info = *grid.info();
    let (width, height) = (info.width as i64, info.height as i64);
    let (mut start, mut end) = (start, end);
    if compat.clamps_cleared_areas() {
        start = (start.0.clamp(0, width), start.1.clamp(0, height));
        end = (end.0.clamp(0, width), end.1.clamp(0, height));
    }
    let within = |first: i64, last: i64, size: i64| {
        let first = first.saturating_add(1).clamp(0, size);
        (first as usize, last.clamp(first, size) as usize)
    };
    let (x0, xn) = within(start.0, end.0, width);
    let (y0, yn) = within(start.1, end.1, height);
    let inside = CellWindow { x0, y0, xn, yn };
    let mut clear = |window: CellWindow| {
        for span in window.spans(info.width) {
            grid.costs_mut()[span].fill(UNKNOWN);
        }
    };
    if !invert {
        return clear(inside);
    }
    if inside.is_empty() {
        return clear(CellWindow::all(&info));
    }
    clear(CellWindow { x0: 0, y0: 0, xn: info.width, yn: y0 });
    clear(CellWindow { x0: 0, y0: yn, xn: info.width, yn: info.height });
    clear(CellWindow { x0: 0, y0, xn: x0, yn });
    clear(CellWindow { x0: xn, y0, xn: info.width, yn });
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_grid::GridInfo;

    use super::*;

    fn cleared(start: (i64, i64), end: (i64, i64), invert: bool, compat: Nav2Release) -> String {
        let info = GridInfo::new(1.0, 4, 3, Pose2::IDENTITY).unwrap();
        let mut grid = Costmap::new(info, 0);
        clear_cells(&mut grid, start, end, invert, compat);
        let row = |row: &[u8]| row.iter().map(|c| if *c == 255 { '?' } else { '.' }).collect();
        let rows: Vec<String> = grid.costs().chunks(4).map(row).collect();
        rows.join(" ")
    }

    #[test]
    fn cells_strictly_between_are_cleared() {
        assert_eq!(cleared((0, 0), (3, 2), false, Nav2Release::Main), ".... .??. ....");
        assert_eq!(cleared((0, 0), (3, 2), true, Nav2Release::Main), "???? ?..? ????");
        assert_eq!(cleared((2, 2), (2, 2), true, Nav2Release::Main), "???? ???? ????");
    }

    #[test]
    fn the_first_row_and_column_are_cleared_before_main() {
        assert_eq!(cleared((-9, -9), (9, 9), false, Nav2Release::Main), ".... .??? .???");
        assert_eq!(cleared((-9, -9), (9, 9), false, Nav2Release::Jazzy), "???? ???? ????");
    }
}
