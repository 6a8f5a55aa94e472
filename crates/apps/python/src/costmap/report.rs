//! Reasons for the cost of a cell.

use periplus::costmap::{CellReport, Explanation};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Reasons for the cost of a cell, from ``Costmap.explain``; ``print`` shows them.
///
/// >>> import periplus
/// >>> costmap = periplus.Costmap(width=2, height=2, resolution=0.5, plugins=["inflation_layer"],
/// ...     inflation_layer={"plugin": "nav2_costmap_2d::InflationLayer"})
/// >>> report = costmap.explain(0.3, 0.3)
/// >>> report.cost, report.cell, [layer["name"] for layer in report.layers]
/// (0, (0, 0), ['inflation_layer'])
#[pyclass(name = "CellReport", module = "periplus", frozen)]
pub(super) struct PyCellReport(pub(super) CellReport);

#[pymethods]
impl PyCellReport {
    /// Column and row.
    #[getter]
    fn cell(&self) -> (usize, usize) {
        self.0.cell
    }

    /// Centre of the cell in the global frame: x, y [m].
    #[getter]
    fn center(&self) -> (f64, f64) {
        self.0.centre_m
    }

    /// Cost, 0 to 255.
    #[getter]
    fn cost(&self) -> u8 {
        self.0.cost
    }

    /// Contributions of the layers and filters, lowest first: dicts with ``name``, ``enabled``, ``cost`` (None where the
    /// layer does not affect the cell), ``reason``, ``parameter``, and ``cause``: the reading that set the cell, with
    /// ``source``, ``is_mark``, ``time_s``, ``origin`` and ``end`` [m].
    #[getter]
    fn layers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let layers = PyList::empty(py);
        for layer in &self.0.layers {
            let entry = contribution(py, &layer.name, &layer.explanation)?;
            entry.set_item("enabled", layer.is_enabled)?;
            layers.append(entry)?;
        }
        Ok(layers)
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        let (column, row) = self.0.cell;
        format!("CellReport(cell=({column}, {row}), cost={})", self.0.cost)
    }
}

fn contribution<'py>(
    py: Python<'py>,
    name: &str,
    about: &Explanation,
) -> PyResult<Bound<'py, PyDict>> {
    let entry = PyDict::new(py);
    entry.set_item("name", name)?;
    entry.set_item("cost", about.value)?;
    entry.set_item("reason", &about.reason)?;
    entry.set_item("parameter", &about.parameter)?;
    let cause = about.cause.as_ref().map(|cause| {
        let reading = PyDict::new(py);
        reading.set_item("source", &cause.source)?;
        reading.set_item("is_mark", cause.is_mark)?;
        reading.set_item("time_s", cause.time_ns as f64 / 1e9)?;
        let [x, y, z] = cause.origin;
        reading.set_item("origin", (x, y, z))?;
        let [x, y] = cause.end;
        reading.set_item("end", (x, y))?;
        Ok::<_, PyErr>(reading)
    });
    entry.set_item("cause", cause.transpose()?)?;
    let within: Vec<_> = about
        .within
        .iter()
        .map(|(name, about)| contribution(py, name, about))
        .collect::<PyResult<_>>()?;
    entry.set_item("within", within)?;
    Ok(entry)
}
