//! Cells along lines.

use periplus_grid::Line;

use super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

/// Lines from cell to cell, with limits of their length.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for line in case.expect().get("lines")?.list()? {
        let (start, end) = (line.get("start")?.cell()?, line.get("end")?.cell()?);
        let length = |name: &str, usual: u32| match line.find(name) {
            Some(cells) => cells.count().map(|it| u32::try_from(it).unwrap_or(u32::MAX)),
            None => Ok(usual),
        };
        let (shortest, longest) = (length("min_length", 0)?, length("max_length", u32::MAX)?);
        let cells: Vec<_> = Line::within(start, end, shortest, longest).collect();
        let expected = line.get("cells")?.each(Reader::cell)?;
        differences.same(format_args!("from {start:?} to {end:?}"), &cells, &expected);
    }
    Ok(())
}
