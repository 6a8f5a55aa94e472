//! Occupancy grids as arrays.

use periplus::geometry::Pose2;
use periplus::grid::{Grid, GridInfo, OccupancyGrid};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::value_error;
use crate::poses::pose2_argument;
use crate::transforms::whole_numbers;

/// Reads a map: (cells, resolution, origin), or an object with these attributes.
///
/// # Errors
/// `TypeError` or `ValueError` that names what is wrong.
pub(crate) fn grid_argument(argument: &Bound<'_, PyAny>) -> PyResult<OccupancyGrid> {
    let parts: [Bound<'_, PyAny>; 3] = match argument.extract() {
        Ok(parts) => parts,
        Err(_) => of_attributes(argument)?,
    };
    let [cells, resolution, origin] = parts;
    let resolution_m: f64 = resolution
        .extract()
        .map_err(|_| PyTypeError::new_err("the resolution of the map must be a number [m]"))?;
    let origin: Pose2 = pose2_argument(&origin, "origin")?;
    let (numbers, shape) = whole_numbers(&cells, "cells", &[None, None])?;
    if numbers.is_empty() {
        return Err(PyValueError::new_err("`cells` is empty"));
    }
    let cells: Result<Vec<i8>, _> = numbers.into_iter().map(i8::try_from).collect();
    let cells = cells.map_err(|_| {
        PyValueError::new_err("`cells` must be -1 (unknown), or 0 (free) to 100 (occupied)")
    })?;
    let info = GridInfo::new(resolution_m, shape[1], shape[0], origin).map_err(value_error)?;
    Grid::from_cells(info, cells).map_err(|_| PyValueError::new_err("`cells` has a wrong size"))
}

fn of_attributes<'py>(argument: &Bound<'py, PyAny>) -> PyResult<[Bound<'py, PyAny>; 3]> {
    let wrong = || {
        PyTypeError::new_err(
            "`map` must be (cells, resolution, origin), or an object with the attributes cells, resolution_m and \
             origin",
        )
    };
    let attribute = |names: &[&str]| {
        names.iter().find_map(|name| argument.getattr(*name).ok()).ok_or_else(wrong)
    };
    Ok([
        attribute(&["cells"])?,
        attribute(&["resolution_m", "resolution"])?,
        attribute(&["origin"])?,
    ])
}
