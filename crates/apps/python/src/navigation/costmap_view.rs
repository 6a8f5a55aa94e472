//! Costmaps as plugins get them.

use numpy::{PyArray1, PyArray2, PyArrayMethods as _};
use periplus::costmap::{Costmap, CostmapView, Footprint, cost};
use periplus::geometry::Pose2;
use pyo3::prelude::*;

use crate::arrays::moved;
use crate::costmap::costs_at;

/// Costmap at the moment in which a planner or controller is called. It is a copy: changes of its array have no effect.
///
/// ``costs[row, column]`` is the cost of the cell whose lower left corner is
/// ``origin + resolution * (column, row)``. 0 is free, 253 closer to an obstacle than the inscribed radius of the
/// robot, 254 an obstacle, 255 unknown.
///
/// >>> from periplus.navigation import CostmapView, Planner
/// >>> class Direct(Planner):
/// ...     def plan(self, costmap: CostmapView, start, goal):
/// ...         assert costmap.cost_at([start])[0] < 253
/// ...         return [start, goal]
#[pyclass(name = "CostmapView", module = "periplus.navigation", frozen)]
pub(crate) struct PyCostmapView {
    costmap: Costmap,
    footprint: Footprint,
    is_circular: bool,
    array: Py<PyArray2<u8>>,
}

impl PyCostmapView {
    pub(super) fn new(py: Python<'_>, view: &CostmapView<'_>) -> PyResult<Self> {
        let info = *view.costs.info();
        let array = PyArray1::from_slice(py, view.costs.costs());
        Ok(Self {
            costmap: view.costs.clone(),
            footprint: view.footprint.clone(),
            is_circular: view.is_circular,
            array: array.reshape([info.height, info.width])?.unbind(),
        })
    }
}

#[pymethods]
impl PyCostmapView {
    /// Costs: uint8, shape (rows, columns).
    #[getter]
    fn costs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u8>> {
        self.array.bind(py).clone()
    }

    /// Side of a cell [m].
    #[getter]
    fn resolution(&self) -> f64 {
        self.costmap.resolution_m()
    }

    /// Position of the lower left corner of the costmap in its frame [m]: (x, y).
    #[getter]
    fn origin(&self) -> (f64, f64) {
        let origin = self.costmap.info().origin;
        (origin.x_m, origin.y_m)
    }

    /// Corners of the robot with padding in its base frame [m]: float64, shape (N, 2).
    #[getter]
    fn footprint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let corners = self.footprint.points();
        Ok(moved(py, corners.as_flattened().to_vec(), &[corners.len(), 2])?.into_any())
    }

    /// Costs at points or poses.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, shape (..., 2) or (..., 3)
    ///     x, y [m] and yaw [rad] in the frame of the costmap; yaw is 0 without a third column.
    /// footprint : bool
    ///     Returns the highest cost on the outline of the robot instead of that of the cell. A robot that is given by
    ///     a radius collides where the cost of its cell is 253 or more, so that cost is returned.
    ///
    /// Returns uint8 of shape (...); 254 outside the costmap.
    #[pyo3(signature = (poses, footprint=false))]
    fn cost_at<'py>(
        &self,
        poses: &Bound<'py, PyAny>,
        footprint: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let at = |pose: &Pose2| {
            if footprint && !self.is_circular {
                return self.footprint.cost(&self.costmap, *pose);
            }
            self.costmap.cost_at(pose.x_m, pose.y_m).unwrap_or(cost::LETHAL)
        };
        costs_at(poses, |poses| Ok(poses.iter().map(at).collect()))
    }

    fn __repr__(&self) -> String {
        let info = self.costmap.info();
        format!(
            "<periplus.navigation.CostmapView of {} x {} cells of {} m>",
            info.width, info.height, info.resolution_m
        )
    }
}
