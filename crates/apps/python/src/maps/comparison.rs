//! Comparison of two maps.

use periplus::geometry::Pose2;
use periplus::images::{Layout, write_png};
use periplus::maps::{MapComparison, Overlap, Walls, picture};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use super::{dictionary, html_picture};
use crate::arrays::moved;
use crate::work::released;

/// Comparison of two maps, from ``OccupancyGrid.diff``.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> cells = np.zeros((20, 20), np.int8)
/// >>> cells[5] = 100
/// >>> one, other = (periplus.OccupancyGrid(cells, 0.1, (0, y, 0)) for y in (0.0, 0.2))
/// >>> diff = one.diff(other, align=False)
/// >>> diff.walls["both"], round(diff.first_to_other["mean_m"], 3)
/// (0, 0.2)
#[pyclass(name = "MapComparison", module = "periplus", frozen)]
pub(crate) struct PyMapComparison(pub(super) MapComparison);

#[pymethods]
impl PyMapComparison {
    /// Pose of the other map in the frame of the first, found by the alignment: x [m], y [m], yaw [rad].
    #[getter]
    fn alignment(&self) -> (f64, f64, f64) {
        let Pose2 { x_m, y_m, yaw_rad } = self.0.alignment.reference_from_other;
        (x_m, y_m, yaw_rad)
    }

    /// Score of the alignment: 1 if each wall point is on a wall of the other map; NaN without alignment.
    #[getter]
    fn score(&self) -> f64 {
        self.0.alignment.score
    }

    /// Wall cells: ``both``, ``first_only``, ``other_only`` [cells], and ``iou``, 0 to 1.
    #[getter]
    fn walls<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        overlap(py, self.0.walls)
    }

    /// As ``walls``, where a neighbouring wall cell counts as a match.
    #[getter]
    fn walls_nearby<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        overlap(py, self.0.walls_nearby)
    }

    /// Free cells, as ``walls``.
    #[getter]
    fn free<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        overlap(py, self.0.free)
    }

    /// Known cells, as ``walls``.
    #[getter]
    fn known<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        overlap(py, self.0.known)
    }

    /// Distances from the walls of the first map to those of the other: ``count`` [cells], ``mean_m``, ``median_m``,
    /// ``p95_m``, ``max_m`` [m].
    #[getter]
    fn first_to_other<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        walls(py, self.0.first_to_other)
    }

    /// Distances from the walls of the other map to those of the first, as ``first_to_other``.
    #[getter]
    fn other_to_first<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        walls(py, self.0.other_to_first)
    }

    /// Picture of both maps: uint8, shape (height, width, 3), top row first. Walls of both are black, of the first only
    /// blue, of the other only red.
    #[getter]
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (width, height, pixels) = released(py, "the picture", || picture(&self.0))?;
        let shape = [height as usize, width as usize, 3];
        Ok(moved(py, pixels, &shape)?.into_any())
    }

    /// PNG for notebooks, as ``image``.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        if self.0.info.is_empty() {
            return Ok(None);
        }
        let png = released(py, "the picture", || {
            let (width, height, pixels) = picture(&self.0);
            write_png(width, height, Layout::Rgb, &pixels)
        })?;
        Ok(Some(PyBytes::new(py, &png)))
    }

    /// Picture and figures for notebooks.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html_picture(py, self._repr_png_(py)?, &self.__repr__())
    }

    fn __repr__(&self) -> String {
        format!(
            "MapComparison(walls_nearby iou {:.3}, free iou {:.3}, walls {:.3} m apart)",
            self.0.walls_nearby.iou(),
            self.0.free.iou(),
            self.0.other_to_first.mean_m
        )
    }
}

fn overlap(py: Python<'_>, cells: Overlap) -> PyResult<Bound<'_, PyDict>> {
    let found = PyDict::new(py);
    found.set_item("both", cells.both)?;
    found.set_item("first_only", cells.first_only)?;
    found.set_item("other_only", cells.other_only)?;
    found.set_item("iou", cells.iou())?;
    Ok(found)
}

fn walls(py: Python<'_>, walls: Walls) -> PyResult<Bound<'_, PyDict>> {
    let Walls { count, mean_m, median_m, p95_m, largest_m } = walls;
    let found = dictionary(
        py,
        [("mean_m", mean_m), ("median_m", median_m), ("p95_m", p95_m), ("max_m", largest_m)],
    )?;
    found.set_item("count", count)?;
    Ok(found)
}
