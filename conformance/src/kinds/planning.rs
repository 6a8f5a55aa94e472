//! Global planners and path smoothers.

mod navfn;
mod smac;
mod smoothers;

pub(super) use navfn::{check_grid_coords, check_navfn};
pub(super) use smac::{check_primitives, check_traversal_cost};
pub(super) use smoothers::check as check_smoother;

use periplus_geometry::Pose2;
use periplus_params::{Given, ParamValues, Table};

use crate::{CaseReader, Unreadable};

/// Values of a table from members of a case.
///
/// # Errors
/// When a member is missing, or its value does not fit.
fn values_of(
    table: &'static Table,
    given: &CaseReader<'_>,
    names: &[&'static str],
) -> Result<ParamValues, Unreadable> {
    let mut diagnostics = periplus_diagnostics::Diagnostics::new();
    let written: Result<Vec<(&str, String)>, Unreadable> =
        names.iter().map(|name| Ok((*name, given.get(name)?.written()))).collect();
    let written = written?;
    let read = written.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let values = table.check(read, None, &mut diagnostics);
    match diagnostics.iter().next() {
        Some(diagnostic) => Err(given.unreadable(&diagnostic.message)),
        None => Ok(values),
    }
}

/// A point as a pose without a turn.
fn point(reader: &CaseReader<'_>) -> Result<Pose2, Unreadable> {
    let [x_m, y_m] = reader.array()?;
    Ok(Pose2::new(x_m, y_m, 0.0))
}
