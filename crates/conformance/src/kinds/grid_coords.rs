//! Where cells are.

use periplus_base::Pose2;
use periplus_grid::{Grid, Lattice};

use super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

/// Cells of points, points of cells, and windows that roll.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let (width, height) = given.get("size")?.cell()?;
    let resolution = given.get("resolution")?;
    let [x_m, y_m] = given.get("origin")?.array()?;
    let lattice = Lattice::new(resolution.number()?, width, height, Pose2::new(x_m, y_m, 0.0))
        .map_err(|error| resolution.unreadable(&error.to_string()))?;
    if let (Some(points), Some(cells)) = (given.find("world"), expect.find("cells")) {
        let cells = cells.list()?;
        differences.same("number of cells", &points.list()?.len(), &cells.len());
        for (point, expected) in points.list()?.iter().zip(&cells) {
            let [x_m, y_m] = point.array()?;
            let expected = if expected.is_null() { None } else { Some(expected.cell()?) };
            differences.same(
                format_args!("cell of ({x_m}, {y_m})"),
                &lattice.cell_of(x_m, y_m),
                &expected,
            );
        }
    }
    if let Some(cells) = given.find("cells").or(given.find("map")) {
        let names = ["world", "centres", "centers", "points"];
        let points = names.iter().find_map(|name| expect.find(name));
        let points = points.ok_or_else(|| expect.unreadable("points of the cells"))?.list()?;
        differences.same("number of points", &cells.list()?.len(), &points.len());
        for (cell, expected) in cells.list()?.iter().zip(&points) {
            let (x_m, y_m) = lattice.centre_of(cell.cell()?);
            let what = format!("centre of {}", cell.value());
            differences.all_near(what, &[x_m, y_m], &expected.array::<2>()?);
        }
    }
    if let Some(moves) = expect.find("moves") {
        let fresh = given.find("default").map_or(Ok(0), |it| it.integer())?;
        for step in moves.list()? {
            roll(lattice, fresh, &step, differences)?;
        }
    }
    Ok(())
}

/// Each cell holds its number, and the window moves.
fn roll(
    lattice: Lattice,
    fresh: i64,
    step: &Reader<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let cells = (1..=lattice.len() as i64).collect();
    let mut grid = Grid { lattice, cells };
    let [x_m, y_m] = step.get("new_origin")?.array()?;
    grid.roll_to(x_m, y_m, fresh);
    let to = format!("moved to ({x_m}, {y_m})");
    let origin = [grid.lattice.origin.x_m, grid.lattice.origin.y_m];
    differences.all_near(&to, &origin, &step.get("grid_origin")?.array::<2>()?);
    let rows = step.get("grid")?.each(|row| row.each(Reader::integer))?;
    for (row, (got, expected)) in grid.rows().zip(&rows).enumerate() {
        differences.same(format_args!("{to}, row {row}"), got, expected);
    }
    differences.same(format_args!("{to}, rows"), &grid.lattice.height, &rows.len());
    Ok(())
}
