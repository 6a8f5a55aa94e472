//! Cells along lines.

use periplus_grid::Line;
use serde_json::json;

use super::Setting;
use crate::{Case, Differences, Unreadable};

/// Lines from cell to cell, with limits of their length.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    // Cells of a line do not depend on the width of the grid.
    case.given().find("width").map_or(Ok(0), |width| width.count())?;
    for (name, expected) in case.expect().members()? {
        if name != "lines" {
            differences.not_known(format!("`{}` (known: `lines`)", expected.path()));
            continue;
        }
        for line in expected.distinct()? {
            let input = line.input();
            let (start, end) = (input.get("start")?.cell()?, input.get("end")?.cell()?);
            let length = |name: &str, usual: u32| match input.find(name) {
                Some(cells) => cells.count().map(|it| u32::try_from(it).unwrap_or(u32::MAX)),
                None => Ok(usual),
            };
            let (shortest, longest) = (length("min_length", 0)?, length("max_length", u32::MAX)?);
            let cells: Vec<_> = Line::within(start, end, shortest, longest).collect();
            let what = format!("from {start:?} to {end:?}");
            differences.compare(what, &json!(cells), &line.get("cells")?);
        }
    }
    Ok(())
}
