//! Frontiers of a map and paths to them.

use periplus::exploration::{Reach, Robot, Settings, frontiers as find_frontiers};
use periplus::grid::GridInfo;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::moved;
use crate::maps::PyOccupancyGrid;
use crate::poses::pose2_argument;
use crate::work::released;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyFrontier>()?;
    module.add_function(wrap_pyfunction!(frontiers, module)?)
}

/// Border between free and unknown space that a robot can reach, from ``frontiers``.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> cells = np.full((10, 40), -1, np.int8)
/// >>> cells[:, :20] = 0
/// >>> frontier, = periplus.frontiers(periplus.OccupancyGrid(cells, 0.1), (0.5, 0.5, 0.0))
/// >>> round(frontier.length_m, 3), frontier.cell[0]
/// (1.0, 19)
#[pyclass(name = "Frontier", module = "periplus", frozen)]
pub(crate) struct PyFrontier {
    cell: (usize, usize),
    position: [f64; 2],
    cost_m: f64,
    length_m: f64,
    cells: Vec<[i64; 2]>,
    centroid: (f64, f64),
    path: Vec<[f64; 2]>,
}

#[pymethods]
impl PyFrontier {
    /// Column and row of the cell of the frontier with the cheapest path.
    #[getter]
    fn cell(&self) -> (usize, usize) {
        self.cell
    }

    /// Position of that cell in the map frame: x, y [m].
    #[getter]
    fn position(&self) -> (f64, f64) {
        (self.position[0], self.position[1])
    }

    /// Cost of the path to it [m]: its length, increased near walls.
    #[getter]
    fn cost_m(&self) -> f64 {
        self.cost_m
    }

    /// Length of the frontier [m].
    #[getter]
    fn length_m(&self) -> f64 {
        self.length_m
    }

    /// Columns and rows of all its cells: int64, shape (N, 2).
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let cells = self.cells.as_flattened().to_vec();
        Ok(moved(py, cells, &[self.cells.len(), 2])?.into_any())
    }

    /// Mean of the centres of its cells in the map frame: x, y [m].
    #[getter]
    fn centroid(&self) -> (f64, f64) {
        self.centroid
    }

    /// Path from the robot to it in the map frame [m]: float64, shape (N, 2), from cell to cell. Empty if the robot is
    /// there.
    #[getter]
    fn path<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let points: Vec<f64> = self.path.as_flattened().to_vec();
        Ok(moved(py, points, &[self.path.len(), 2])?.into_any())
    }

    fn __repr__(&self) -> String {
        let [x, y] = self.position;
        format!(
            "Frontier(position=({x:.2}, {y:.2}), length_m={:.2}, cost_m={:.2})",
            self.length_m, self.cost_m
        )
    }
}

/// Finds the frontiers that a robot can reach, with paths: the borders between free and unknown space.
///
/// Parameters
/// ----------
/// grid : OccupancyGrid
///     Map.
/// robot_pose : Pose or (x, y, yaw)
///     Pose of the robot in the map frame. Raises ``ValueError`` outside the map.
/// radius_m, comfort_m : float, optional
///     Minimum distance of the robot's centre from walls, and distance below which costs increase [m].
/// min_length_m : float, optional
///     Minimum length of a frontier [m].
///
/// Defaults suit a robot of half a metre. Returns a list of ``Frontier``, the cheapest path first. Source: Yamauchi,
/// "A frontier-based approach for autonomous exploration", 1997.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> cells = np.full((10, 40), -1, np.int8)
/// >>> cells[:, :20] = 0
/// >>> room = periplus.OccupancyGrid(cells, 0.1)
/// >>> [frontier.path.shape for frontier in periplus.frontiers(room, (0.5, 0.5, 0.0))]
/// [(14, 2)]
#[pyfunction]
#[pyo3(signature = (grid, robot_pose, radius_m=None, comfort_m=None, min_length_m=None))]
fn frontiers(
    grid: &Bound<'_, PyOccupancyGrid>,
    robot_pose: &Bound<'_, PyAny>,
    radius_m: Option<f64>,
    comfort_m: Option<f64>,
    min_length_m: Option<f64>,
) -> PyResult<Vec<PyFrontier>> {
    let pose = pose2_argument(robot_pose, "robot_pose")?;
    let defaults = Settings::default();
    let robot = Robot {
        radius_m: radius_m.unwrap_or(defaults.robot.radius_m),
        comfort_m: comfort_m.unwrap_or(defaults.robot.comfort_m),
    };
    let shortest_m = min_length_m.unwrap_or(defaults.shortest_m);
    for (name, value) in
        [("radius_m", robot.radius_m), ("comfort_m", robot.comfort_m), ("min_length_m", shortest_m)]
    {
        if !(value.is_finite() && value >= 0.0) {
            return Err(PyValueError::new_err(format!("`{name}` must be finite and at least 0")));
        }
    }
    let map = &*grid.get().0;
    let found = released(grid.py(), "frontiers", || {
        let reach = Reach::new(map, &robot, pose.x_m, pose.y_m)?;
        let mut found = find_frontiers(&reach, shortest_m);
        found.sort_by(|a, b| a.cost_m.total_cmp(&b.cost_m));
        let whole = |count: usize| i64::try_from(count).unwrap_or(i64::MAX);
        let with_path = found.into_iter().map(|one| PyFrontier {
            cells: one
                .cells
                .iter()
                .map(|index| map.info.cell(*index))
                .map(|(column, row)| [whole(column), whole(row)])
                .collect(),
            centroid: centroid(&map.info, &one.cells),
            cell: map.info.cell(one.cell),
            position: one.place_m,
            cost_m: one.cost_m,
            length_m: one.length_m,
            path: reach.way(one.cell),
        });
        Some(with_path.collect())
    })?;
    found.ok_or_else(|| {
        PyValueError::new_err(format!(
            "`robot_pose` ({:.3}, {:.3}) is outside the map",
            pose.x_m, pose.y_m
        ))
    })
}

/// Mean of the centres of cells \[m\].
fn centroid(info: &GridInfo, cells: &[usize]) -> (f64, f64) {
    let count = cells.len().max(1) as f64;
    let centres = cells.iter().map(|index| info.centre_of(info.cell(*index)));
    let (x_m, y_m) = centres.fold((0.0, 0.0), |sum, (x_m, y_m)| (sum.0 + x_m, sum.1 + y_m));
    (x_m / count, y_m / count)
}
