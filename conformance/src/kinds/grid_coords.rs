//! Coordinates of cells.

use periplus_geometry::Pose2;
use periplus_grid::{Grid, GridInfo};
use serde_json::{Value, json};

use super::Setting;
use crate::{Case, Differences, Unreadable, numbers};

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
    let info = GridInfo::new(resolution.number()?, width, height, Pose2::new(x_m, y_m, 0.0))
        .map_err(|error| resolution.unreadable(&error.to_string()))?;
    let default = given.find("default").map_or(Ok(0), |it| it.integer())?;
    let mut named: Vec<(&[&str], Value)> = Vec::new();
    if let Some(points) = given.find_any(&["world", "points"]) {
        let cells = points.each(|point| {
            let [x_m, y_m] = point.array()?;
            Ok(json!(info.cell_of(x_m, y_m)))
        })?;
        named.push((&["cells"], Value::Array(cells)));
    }
    if let Some(cells) = given.find_any(&["cells", "map"]) {
        let points = cells.each(|cell| {
            // Cells beside the grid have centres, too.
            let [column, row] = cell.array()?;
            let (x_m, y_m) = info.point_at(column + 0.5, row + 0.5);
            Ok(numbers([x_m, y_m]))
        })?;
        named.push((&["world", "centres", "centers", "points"], Value::Array(points)));
    }
    let Some(moves) = expect.find("moves") else {
        differences.compare_members(&named, &expect);
        return Ok(());
    };
    if let Some(fill) = given.find("fill") {
        let formula = format!("cell value = 1 + x + {width}*y");
        if fill.text()? != formula {
            return Err(fill.unreadable(&format!("`{formula}`")));
        }
    }
    for (name, expected) in expect.members()?.into_iter().filter(|(name, _)| *name != "moves") {
        let found = named.iter().find(|(names, _)| names.contains(&name));
        match found {
            Some((_, got)) => differences.compare(name, got, &expected),
            None => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    for step in moves.distinct()? {
        let [x_m, y_m] = step.get("new_origin")?.input().array()?;
        let cells = (1..=info.len() as i64).collect();
        let mut grid = Grid { info, cells };
        grid.roll_to(x_m, y_m, default);
        let origin = grid.info.origin;
        let rows: Value = grid.rows().map(|row| json!(row)).collect();
        let got = json!({
            "new_origin": step.get("new_origin")?.input().whole(),
            "grid_origin": numbers([origin.x_m, origin.y_m]),
            "grid": rows,
        });
        differences.compare(format_args!("moved to ({x_m}, {y_m})"), &got, &step);
    }
    Ok(())
}
