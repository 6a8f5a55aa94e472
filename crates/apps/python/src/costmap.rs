//! Layered costmaps.

mod layer;
mod parameters;
mod report;

use std::any::Any;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::thread::ThreadId;

use numpy::{PyArrayDyn, PyReadonlyArrayDyn, PyUntypedArrayMethods as _};
use periplus::costmap::clear::{Region, clear};
use periplus::costmap::layers::{RangeLayer, RangeReading, StaticLayer};
use periplus::costmap::{
    CostmapConfig, Footprint, LayeredCostmap, NoTransforms, Projector, ScanGeometry, cost,
};
use periplus::diagnostics::{
    Diagnostic, DiagnosticCause, Diagnostics, Severity, SourceMap, closest,
};
use periplus::geometry::Pose2;
use periplus::grid::{Grid, GridInfo};
use periplus::images::{Layout, write_png};
use periplus::maps::palette::{Scheme, paint};
use periplus::os::Machine;
use periplus::params::Given;
use periplus::resources::Host as _;
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyString};

use crate::arrays::{contiguous, input, moved, require_finite, shared};
use crate::errors::{file_error, finding_error, require_file, require_no_errors, value_error};
use crate::maps::{PyOccupancyGrid, html_picture};
use crate::poses::{pose_argument, pose2_argument};
use crate::work::{lock, released, with_locked};
use layer::{Failure, PyUpdateBounds, PythonLayer};
use report::PyCellReport;

/// Costs of an array of points or poses, shape (..., 2) or (..., 3), as uint8 of shape (...); yaw is 0 without a third
/// column.
pub(crate) fn costs_at<'py>(
    poses: &Bound<'py, PyAny>,
    costs_of: impl FnOnce(&[Pose2]) -> PyResult<Vec<u8>>,
) -> PyResult<Bound<'py, PyAny>> {
    let array = contiguous::<f64>(poses, "poses")?;
    let shape = array.shape();
    let Some((axes @ (2 | 3), lead)) = shape.split_last() else {
        return Err(PyValueError::new_err(format!(
            "`poses` must have the shape (..., 2) or (..., 3), not {shape:?}"
        )));
    };
    let values = array.as_slice()?;
    require_finite(values, "poses")?;
    let pose = |row: &[f64]| Pose2::new(row[0], row[1], row.get(2).copied().unwrap_or(0.0));
    let all: Vec<Pose2> = values.chunks_exact(*axes).map(pose).collect();
    Ok(moved(poses.py(), costs_of(&all)?, lead)?.into_any())
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyCostmap>()?;
    module.add_class::<PyCellReport>()?;
    module.add_class::<PyUpdateBounds>()
}

/// Layered costmap with the behaviour of ``nav2_costmap_2d``.
///
/// Parameters
/// ----------
/// parameters : dict, optional
///     Parameters by their names in the YAML files of Nav2, nested or with dots.
/// plugins : sequence, optional
///     Layers from the lowest: names, whose parameters have a ``plugin``, and layers written in Python.
/// **settings
///     Parameters as keywords: ``width``, ``height``, ``resolution``, ``rolling_window``, ``robot_radius``, and a dict
///     for each layer. They override those in ``parameters``.
///
/// A layer written in Python is an object with ``update_costs(costs, min_i, min_j, max_i, max_j)``. ``costs`` is a
/// writable uint8 array of shape (height, width), valid during the call; only the rows ``min_j:max_j`` and columns
/// ``min_i:max_i`` are used. Optional: ``update_bounds(robot_x, robot_y, robot_yaw, bounds)`` with an ``UpdateBounds``
/// (without it the layer updates all cells), ``reset()``, ``name`` and ``enabled``. Its exceptions leave ``update``.
///
/// Costs: 0 free, 1 to 252 graded, 253 inscribed, 254 lethal, 255 unknown. Row 0 has the lowest y. Raises ``TypeError``
/// for unknown parameters and ``ValueError`` for wrong values.
///
/// >>> import periplus
/// >>> costmap = periplus.Costmap(
/// ...     width=4, height=4, resolution=0.05, rolling_window=True, robot_radius=0.2,
/// ...     plugins=["obstacle_layer", "inflation_layer"],
/// ...     obstacle_layer={"plugin": "nav2_costmap_2d::ObstacleLayer", "observation_sources": "scan",
/// ...                     "scan": {"max_obstacle_height": 2.0}},
/// ...     inflation_layer={"plugin": "nav2_costmap_2d::InflationLayer", "inflation_radius": 0.6})
/// >>> costmap.observe("obstacle_layer", "scan", [[1.0, 0.0, 0.0]], sensor_pose=(0, 0, 0.2, 0, 0, 0))
/// >>> _ = costmap.update(robot_pose=(0, 0, 0))
/// >>> costmap.cost_at([[1.0, 0.0], [0.9, 0.0], [0.2, 0.0]]).tolist()
/// [254, 253, 0]
#[pyclass(name = "Costmap", module = "periplus", frozen)]
pub(crate) struct PyCostmap {
    state: Mutex<State>,
    failure: Failure,
    /// Thread that updates the costmap: its layers must not wait for it.
    updating: Mutex<Option<ThreadId>>,
}

struct State {
    config: CostmapConfig,
    costmap: LayeredCostmap,
    warnings: Vec<String>,
    /// Costs since the last change, for arrays.
    costs: Option<Arc<Vec<u8>>>,
    projector: Projector,
}

#[pymethods]
impl PyCostmap {
    #[new]
    #[pyo3(signature = (parameters=None, *, plugins=None, **settings))]
    fn new(
        py: Python<'_>,
        parameters: Option<&Bound<'_, PyDict>>,
        plugins: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut flat = Vec::new();
        for given in parameters.into_iter().chain(settings) {
            parameters::flatten(given, "", &mut flat)?;
        }
        // The last value of a name applies.
        let mut kept: Vec<(String, String)> = Vec::new();
        for (name, text) in flat {
            kept.retain(|(known, _)| *known != name);
            kept.push((name, text));
        }
        let failure = Failure::default();
        let mut order: Vec<Result<String, PythonLayer>> = Vec::new();
        let mut is_listed = false;
        if let Some(plugins) = plugins {
            if plugins.is_instance_of::<PyString>() {
                return Err(PyTypeError::new_err("`plugins` must be a list, not a text"));
            }
            is_listed = true;
            for plugin in plugins.try_iter()? {
                let plugin = plugin?;
                order.push(match plugin.extract::<String>() {
                    Ok(name) => Ok(name),
                    Err(_) => Err(PythonLayer::new(&plugin, failure.clone())?),
                });
            }
            let names: Vec<&str> = order.iter().flatten().map(String::as_str).collect();
            kept.retain(|(name, _)| name != "plugins");
            kept.push(("plugins".to_owned(), format!("[{}]", names.join(", "))));
        }
        let given = kept.iter().map(|(name, text)| Given::new(name, text.as_str()));
        let mut findings = Diagnostics::new();
        let config = CostmapConfig::read(given, None, &mut findings);
        for finding in findings.iter() {
            let is_unknown = finding.cause == Some(DiagnosticCause::UnknownParameter);
            if is_unknown || finding.severity == Severity::Error {
                let text = described(finding);
                return Err(if is_unknown {
                    PyTypeError::new_err(text)
                } else {
                    PyValueError::new_err(text)
                });
            }
        }
        let warnings = findings.iter().map(described).collect();
        let own = order.into_iter();
        let costmap = released(py, "the costmap", || {
            if !is_listed {
                return config.build();
            }
            let mut costmap = LayeredCostmap::new(config.frame(), config.info());
            for layer in own {
                match layer {
                    Err(layer) => costmap.add_layer(Box::new(layer)),
                    Ok(name) => {
                        let known = config.layers.iter().find(|layer| layer.name == name);
                        known.into_iter().for_each(|it| costmap.add_layer(config.build_layer(it)));
                    }
                }
            }
            for filter in &config.filters {
                costmap.add_filter(config.build_layer(filter));
            }
            costmap.set_footprint(config.footprint.clone());
            costmap
        })?;
        Ok(Self::of(config, costmap, warnings, failure))
    }

    /// Reads the parameters of a costmap from a YAML file of Nav2 or ROS 1.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     File.
    /// node : str
    ///     Section of the file.
    ///
    /// Raises ``FileNotFoundError``, ``KeyError`` for a section that is not there, or ``FileError`` with file, line and
    /// column; ``warnings`` has what is doubtful.
    ///
    /// >>> import pathlib, tempfile
    /// >>> import periplus
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "nav2.yaml"
    /// >>> _ = file.write_text("local_costmap: {local_costmap: {ros__parameters: {width: 3, height: 2, plugins: []}}}")
    /// >>> periplus.Costmap.from_yaml(file, "local_costmap").costs.shape
    /// (20, 30)
    #[staticmethod]
    #[pyo3(signature = (path, node="local_costmap"))]
    fn from_yaml(py: Python<'_>, path: PathBuf, node: &str) -> PyResult<Self> {
        require_file(&path)?;
        let bytes = Machine.read(&path).map_err(|error| file_error(py, &path, error))?;
        let text = String::from_utf8(bytes).map_err(|error| file_error(py, &path, error))?;
        Self::read(py, &path.display().to_string(), text, node)
    }

    /// Reads the parameters of a costmap from the text of a YAML file. Otherwise as ``from_yaml``.
    ///
    /// >>> import periplus
    /// >>> text = "local_costmap: {ros__parameters: {width: 3, height: 2, resolution: 0.5, plugins: []}}"
    /// >>> periplus.Costmap.from_text(text).costs.shape
    /// (4, 6)
    #[staticmethod]
    #[pyo3(signature = (text, node="local_costmap"))]
    fn from_text(py: Python<'_>, text: String, node: &str) -> PyResult<Self> {
        Self::read(py, "<text>", text, node)
    }

    /// Adds a layer written in Python on top of the other layers.
    ///
    /// >>> import periplus
    /// >>> class Speckle:
    /// ...     def update_costs(self, costs, min_i, min_j, max_i, max_j):
    /// ...         costs[0, 0] = 7
    /// >>> costmap = periplus.Costmap(width=2, height=2, plugins=[])
    /// >>> costmap.add_layer(Speckle())
    /// >>> _ = costmap.update()
    /// >>> costmap.costs[0, 0].item(), costmap.layers
    /// (7, ['Speckle'])
    fn add_layer(&self, layer: &Bound<'_, PyAny>) -> PyResult<()> {
        let added = PythonLayer::new(layer, self.failure.clone())?;
        self.with(layer.py(), |state| state.costmap.add_layer(Box::new(added)))
    }

    /// Sets the map of a static layer, from the next update on.
    ///
    /// Parameters
    /// ----------
    /// grid : OccupancyGrid
    ///     Map in the global frame. Unless the costmap rolls, it takes the size of the map.
    /// layer : str, optional
    ///     Name of the static layer; default: the first one.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(plugins=["static_layer"],
    /// ...     static_layer={"plugin": "nav2_costmap_2d::StaticLayer"})
    /// >>> costmap.set_map(periplus.OccupancyGrid([[0, 100, -1]], 0.5))
    /// >>> _ = costmap.update()
    /// >>> costmap.costs.tolist()
    /// [[0, 254, 0]]
    #[pyo3(signature = (grid, layer=None))]
    fn set_map(&self, grid: &Bound<'_, PyOccupancyGrid>, layer: Option<&str>) -> PyResult<()> {
        let map = (*grid.get().0).clone();
        let set = self.with(grid.py(), |state| {
            let name = match layer {
                Some(name) => name.to_owned(),
                None => first_of::<StaticLayer>(&state.costmap)?,
            };
            let frame = state.costmap.frame().global_frame.clone();
            let found = state.costmap.find_as::<StaticLayer>(&name)?;
            Some(found.set_map(map, &frame))
        })?;
        match set {
            Some(set) => set.map_err(value_error),
            None => Err(PyKeyError::new_err(format!(
                "the costmap has no static layer{}",
                layer.map(|name| format!(" `{name}`")).unwrap_or_default()
            ))),
        }
    }

    /// Inserts the points of a scan or a cloud into a source of an obstacle or voxel layer.
    ///
    /// Parameters
    /// ----------
    /// layer, source : str
    ///     Names, as in ``observation_sources``. Raises ``KeyError`` for unknown ones.
    /// points : array_like, shape (N, 3) or (N, 2)
    ///     Points in the frame of the sensor [m]; NaN is dropped. z is 0 without a third column.
    /// sensor_pose : Pose or (x, y, yaw) or (x, y, z, roll, pitch, yaw)
    ///     Pose of the sensor in the global frame, where the rays begin.
    /// time_s : float
    ///     Time of the measurement [s].
    ///
    /// See the example of ``Costmap``.
    #[pyo3(signature = (layer, source, points, sensor_pose, time_s=0.0))]
    fn observe(
        &self,
        layer: &str,
        source: &str,
        points: &Bound<'_, PyAny>,
        sensor_pose: &Bound<'_, PyAny>,
        time_s: f64,
    ) -> PyResult<()> {
        let pose = pose_argument(sensor_pose, "sensor_pose")?;
        let time_ns = nanoseconds(time_s)?;
        let (values, shape) = singles(points, "points")?;
        let [_, axes @ (2 | 3)] = shape[..] else {
            return Err(PyValueError::new_err(format!(
                "`points` must have the shape (N, 3) or (N, 2), not {shape:?}"
            )));
        };
        let values = values.as_slice()?;
        let found = self.with(points.py(), |state| {
            let found = state.costmap.source_mut(layer, source)?;
            let point = |row: &[f32]| [row[0], row[1], row.get(2).copied().unwrap_or(0.0)];
            let points = values.chunks_exact(axes).map(point);
            found.insert(time_ns, time_ns, pose, pose.translation, points);
            Some(())
        })?;
        found.ok_or_else(|| self.no_source(points.py(), layer, source))
    }

    /// Inserts a laser scan into a source of an obstacle or voxel layer.
    ///
    /// Parameters
    /// ----------
    /// layer, source : str
    ///     Names, as for ``observe``.
    /// ranges : array_like, shape (N,)
    ///     Ranges [m]; NaN and values outside the limits are no returns; inf clears with ``inf_is_valid``.
    /// angle_min, angle_increment : float
    ///     Angle of the first beam, and between beams [rad].
    /// range_min, range_max : float
    ///     Limits of valid ranges [m].
    /// sensor_pose, time_s
    ///     As for ``observe``.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(width=4, height=4, rolling_window=True, plugins=["obstacles"],
    /// ...     obstacles={"plugin": "nav2_costmap_2d::ObstacleLayer", "observation_sources": "scan"},
    /// ...     **{"obstacles.scan.max_obstacle_height": 2.0})
    /// >>> costmap.observe_scan("obstacles", "scan", [1.05, 1.05], 0.0, 1.57, 0.1, 10.0, (0, 0, 0))
    /// >>> _ = costmap.update(robot_pose=(0, 0, 0))
    /// >>> int((costmap.costs == 254).sum())
    /// 2
    #[pyo3(signature = (layer, source, ranges, angle_min, angle_increment, range_min, range_max, sensor_pose,
                        time_s=0.0))]
    #[expect(clippy::too_many_arguments, reason = "fields of a message")]
    fn observe_scan(
        &self,
        layer: &str,
        source: &str,
        ranges: &Bound<'_, PyAny>,
        angle_min: f32,
        angle_increment: f32,
        range_min: f32,
        range_max: f32,
        sensor_pose: &Bound<'_, PyAny>,
        time_s: f64,
    ) -> PyResult<()> {
        let pose = pose_argument(sensor_pose, "sensor_pose")?;
        let time_ns = nanoseconds(time_s)?;
        let (values, shape) = singles(ranges, "ranges")?;
        if shape.len() != 1 {
            return Err(PyValueError::new_err(format!(
                "`ranges` must have the shape (N,), not {shape:?}"
            )));
        }
        let ranges_m = values.as_slice()?;
        for (name, value) in [
            ("angle_min", angle_min),
            ("angle_increment", angle_increment),
            ("range_min", range_min),
            ("range_max", range_max),
        ] {
            require_finite(&[f64::from(value)], name)?;
        }
        let beams = ScanGeometry {
            angle_min_rad: angle_min,
            angle_increment_rad: angle_increment,
            range_min_m: range_min,
            range_max_m: range_max,
        };
        let found = self.with(ranges.py(), |state| {
            let State { costmap, projector, .. } = state;
            let found = costmap.source_mut(layer, source)?;
            let inf_is_valid = found.settings.inf_is_valid;
            let points = projector.points(beams, ranges_m, inf_is_valid);
            found.insert(time_ns, time_ns, pose, pose.translation, points);
            Some(())
        })?;
        found.ok_or_else(|| self.no_source(ranges.py(), layer, source))
    }

    /// Inserts a reading of a sonar or infrared sensor into a range sensor layer.
    ///
    /// Parameters
    /// ----------
    /// layer : str
    ///     Name of the layer. Raises ``KeyError`` for an unknown one.
    /// range_m, min_range_m, max_range_m : float
    ///     Reading and limits of the sensor [m].
    /// field_of_view : float
    ///     Width of the beam [rad].
    /// sensor_pose
    ///     Pose of the sensor in the global frame; the beam is along x.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(width=4, height=4, rolling_window=True, plugins=["sonar"],
    /// ...     sonar={"plugin": "nav2_costmap_2d::RangeSensorLayer", "topics": ["/sonar"]})
    /// >>> costmap.observe_range("sonar", 1.0, 0.1, 2.0, 0.4, (0, 0, 0))
    #[pyo3(signature = (layer, range_m, min_range_m, max_range_m, field_of_view, sensor_pose))]
    fn observe_range(
        &self,
        layer: &str,
        range_m: f64,
        min_range_m: f64,
        max_range_m: f64,
        field_of_view: f64,
        sensor_pose: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let global_from_sensor = pose_argument(sensor_pose, "sensor_pose")?;
        if range_m.is_nan() {
            return Err(PyValueError::new_err("`range_m` must not be NaN"));
        }
        for (name, value) in [
            ("min_range_m", min_range_m),
            ("max_range_m", max_range_m),
            ("field_of_view", field_of_view),
        ] {
            require_finite(&[value], name)?;
        }
        let reading = RangeReading {
            global_from_sensor,
            range_m,
            min_range_m,
            max_range_m,
            field_of_view_rad: field_of_view,
        };
        let found = self.with(sensor_pose.py(), |state| {
            state.costmap.find_as::<RangeLayer>(layer)?.insert(reading);
            Some(())
        })?;
        found.ok_or_else(|| {
            PyKeyError::new_err(format!("the costmap has no range sensor layer `{layer}`"))
        })
    }

    /// Updates the costs where a layer has changed, and returns the window of these cells: ``(min_i, min_j, max_i,
    /// max_j)``, columns and rows, the maxima excluded; None if nothing has changed.
    ///
    /// Parameters
    /// ----------
    /// time_s : float
    ///     Time [s].
    /// robot_pose : Pose or (x, y, yaw)
    ///     Pose of the robot in the global frame; a rolling costmap is centred on it.
    ///
    /// An exception of a layer written in Python leaves this call; the costs of its window are then incomplete.
    ///
    /// >>> import periplus
    /// >>> class Half:
    /// ...     name = "half"
    /// ...     def update_costs(self, costs, min_i, min_j, max_i, max_j):
    /// ...         costs[min_j:max_j, min_i : (min_i + max_i) // 2] = 50
    /// >>> costmap = periplus.Costmap(width=2, height=1, resolution=0.5, plugins=[Half()])
    /// >>> costmap.update(0.0, (1, 1, 0))
    /// (0, 0, 4, 2)
    /// >>> costmap.costs.tolist()
    /// [[50, 50, 0, 0], [50, 50, 0, 0]]
    #[pyo3(signature = (time_s=0.0, robot_pose=None))]
    fn update(
        &self,
        py: Python<'_>,
        time_s: f64,
        robot_pose: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Option<(usize, usize, usize, usize)>> {
        let now_ns = nanoseconds(time_s)?;
        let robot =
            robot_pose.map_or(Ok(Pose2::IDENTITY), |it| pose2_argument(it, "robot_pose"))?;
        let window = self.with_layers(py, |state| {
            let window = state.costmap.update(now_ns, robot, &NoTransforms);
            state.costs = None;
            let found = state.costmap.diagnostics();
            state.note(&found);
            window
        })?;
        Ok(window.map(|it| (it.x0, it.y0, it.xn, it.yn)))
    }

    /// Costs: uint8, shape (height, width), read-only. Taken at the last update: later updates make a new array. Row 0
    /// has the lowest y.
    #[getter]
    fn costs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (costs, shape) = self.with(py, |state| {
            let grid = state.costmap.costmap();
            let shape = [grid.info().height, grid.info().width];
            let costs = state.costs.get_or_insert_with(|| Arc::new(grid.costs().to_vec()));
            (Arc::clone(costs), shape)
        })?;
        let values = (costs.as_ptr(), costs.len());
        shared(py, costs, values, &shape)
    }

    /// Highest cost at poses, or on the outline of the footprint there.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, shape (..., 2) or (..., 3)
    ///     x, y [m] and yaw [rad] in the global frame; yaw is 0 without a third column.
    /// footprint : bool
    ///     Returns the highest cost on the outline of the robot instead of that of the cell.
    ///
    /// Returns uint8 of shape (...); 254 outside the costmap.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(width=2, height=2, plugins=[])
    /// >>> costmap.cost_at([[1.0, 1.0], [9.0, 9.0]]).tolist()
    /// [0, 254]
    #[pyo3(signature = (poses, footprint=false))]
    fn cost_at<'py>(
        &self,
        poses: &Bound<'py, PyAny>,
        footprint: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        costs_at(poses, |all| {
            self.with(poses.py(), |state| {
                let at = |pose: &Pose2| state.costmap.cost_at(*pose, footprint);
                all.iter().map(at).collect()
            })
        })
    }

    /// Explains the cost at a point of the global frame [m]: the contribution of each layer, with the reading or
    /// parameter behind it. Raises ``ValueError`` outside the costmap.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(width=2, height=2, plugins=[])
    /// >>> print(costmap.explain(0.5, 0.5))
    /// cell (5, 5) at (0.550, 0.550) m: 0, free
    /// <BLANKLINE>
    fn explain(&self, py: Python<'_>, x: f64, y: f64) -> PyResult<PyCellReport> {
        let report = self.with(py, |state| {
            let cell = state.costmap.cell_of(x, y)?;
            state.costmap.inspect(cell)
        })?;
        let report = report.map(PyCellReport);
        report.ok_or_else(|| PyValueError::new_err(format!("({x}, {y}) is outside the costmap")))
    }

    /// Corners of the robot with padding in its base frame [m]: float64, shape (N, 2).
    #[getter]
    fn footprint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let corners = self.with(py, |state| state.costmap.footprint().points().to_vec())?;
        Ok(moved(py, corners.as_flattened().to_vec(), &[corners.len(), 2])?.into_any())
    }

    /// Radii of the footprint: of the largest circle inside it and of the smallest around it, both about the base [m].
    #[getter]
    fn radii_m(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.with(py, |state| {
            let footprint = state.costmap.footprint();
            (footprint.inscribed_radius_m, footprint.circumscribed_radius_m)
        })
    }

    /// Sets the corners of the robot in its base frame [m], shape (N, 2) with at least three, in order around the robot;
    /// no padding is added.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(plugins=[])
    /// >>> costmap.set_footprint([[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]])
    /// >>> round(costmap.radii_m[0], 6)
    /// 0.1
    fn set_footprint(&self, corners: &Bound<'_, PyAny>) -> PyResult<()> {
        let array = input::<f64>(corners, "corners", &[None, Some(2)])?;
        let values = array.as_slice()?;
        require_finite(values, "corners")?;
        if values.len() < 6 {
            return Err(PyValueError::new_err("`corners` must have at least three corners"));
        }
        let footprint = Footprint::new(values.as_chunks::<2>().0.to_vec());
        self.with_layers(corners.py(), |state| state.costmap.set_footprint(footprint))
    }

    /// Clears obstacles, as the clear services of Nav2; the next update shows it.
    ///
    /// Parameters
    /// ----------
    /// layers : sequence of str, optional
    ///     Names of layers; default: all that can be cleared.
    /// around : (x, y, side), optional
    ///     Clears a square with this centre and side length [m].
    /// outside : (x, y, side), optional
    ///     Clears everything outside of a square.
    ///
    /// Clears everything without ``around`` and ``outside``. Raises ``ValueError`` for layers that cannot be cleared.
    ///
    /// >>> import periplus
    /// >>> periplus.Costmap(plugins=[]).clear()
    #[pyo3(signature = (layers=None, around=None, outside=None))]
    fn clear(
        &self,
        py: Python<'_>,
        layers: Option<Vec<String>>,
        around: Option<[f64; 3]>,
        outside: Option<[f64; 3]>,
    ) -> PyResult<()> {
        require_finite(around.as_ref().map_or(&[], |it| &it[..]), "around")?;
        require_finite(outside.as_ref().map_or(&[], |it| &it[..]), "outside")?;
        let region = match (around, outside) {
            (None, None) => Region::Everything,
            (Some([x_m, y_m, side_m]), None) => Region::Around { x_m, y_m, side_m },
            (None, Some([x_m, y_m, side_m])) => Region::Except { x_m, y_m, side_m },
            (Some(_), Some(_)) => {
                return Err(PyValueError::new_err("give either `around` or `outside`"));
            }
        };
        let cleared = self.with_layers(py, |state| {
            state.costs = None;
            clear(&mut state.costmap, region, &layers.unwrap_or_default())
        })?;
        cleared.map_err(value_error)
    }

    /// Returns the value of a parameter by its name, with those of its layer and source, such as
    /// ``inflation_layer.inflation_radius``. Raises ``KeyError`` for an unknown name.
    ///
    /// >>> import periplus
    /// >>> periplus.Costmap(width=3, plugins=[]).get_parameter("width")
    /// 3
    fn get_parameter<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let groups =
            self.with(py, |state| parameters::groups(&state.config.node, &state.costmap))?;
        for (prefix, values) in &groups {
            if let Some(own) = name.strip_prefix(prefix.as_str())
                && values.find(own).is_some()
            {
                return parameters::to_python(py, values.get(own));
            }
        }
        let names: Vec<String> = groups
            .iter()
            .flat_map(|(prefix, values)| values.names().map(move |name| format!("{prefix}{name}")))
            .collect();
        Err(parameters::unknown(name, &names))
    }

    /// Sets a parameter of the running costmap by its name. Raises ``KeyError`` for an unknown name and ``ValueError``
    /// for a wrong value, or one that cannot change while the costmap runs.
    ///
    /// >>> import periplus
    /// >>> costmap = periplus.Costmap(plugins=["inflation_layer"],
    /// ...     inflation_layer={"plugin": "nav2_costmap_2d::InflationLayer"})
    /// >>> costmap.set_parameter("inflation_layer.inflation_radius", 0.7)
    /// >>> costmap.get_parameter("inflation_layer.inflation_radius")
    /// 0.7
    fn set_parameter(&self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = value.py();
        let text = parameters::text_of(value, name)?;
        let groups =
            self.with(py, |state| parameters::groups(&state.config.node, &state.costmap))?;
        let (prefix, values) = parameters::changed(groups, name, &text)?;
        let changed = self.with_layers(py, |state| {
            state.costs = None;
            let State { config, costmap, .. } = state;
            if prefix.is_empty() {
                return config.change(costmap, values, &NoTransforms).map_err(|it| it.to_string());
            }
            match parameters::owner(costmap, &prefix) {
                Some((layer, None)) => layer.configure(values).map_err(|error| error.to_string()),
                Some((layer, Some(source))) => {
                    let mut sources = layer.sources_mut().iter_mut();
                    if let Some(found) = sources.find(|known| known.name == source) {
                        found.configure(values);
                    }
                    Ok(())
                }
                None => Err(format!("there is no layer `{prefix}`")),
            }
        })?;
        changed.map_err(PyValueError::new_err)
    }

    /// All parameters with their values, by name.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let groups =
            self.with(py, |state| parameters::groups(&state.config.node, &state.costmap))?;
        let all = PyDict::new(py);
        for (prefix, values) in &groups {
            for name in values.names() {
                let value = parameters::to_python(py, values.get(&name))?;
                all.set_item(format!("{prefix}{name}"), value)?;
            }
        }
        Ok(all)
    }

    /// Names of the layers and filters, lowest first.
    #[getter]
    fn layers(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |state| {
            let all = state.costmap.layers().iter().chain(state.costmap.filters());
            all.map(|layer| layer.name().to_owned()).collect()
        })
    }

    /// Findings about the parameters and warnings of updates so far, the newest last; at most a thousand.
    #[getter]
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |state| state.warnings.clone())
    }

    /// Returns true if all enabled layers have current data at a time [s].
    fn is_current(&self, py: Python<'_>, time_s: f64) -> PyResult<bool> {
        let now_ns = nanoseconds(time_s)?;
        self.with(py, |state| state.costmap.is_current(now_ns))
    }

    /// Resets all layers and the costs.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.with_layers(py, |state| {
            state.costs = None;
            state.costmap.reset();
        })
    }

    /// Side length of a cell [m].
    #[getter]
    fn resolution_m(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.info(py)?.resolution_m)
    }

    /// Lower left corner in the global frame: x, y [m].
    #[getter]
    fn origin(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        let origin = self.info(py)?.origin;
        Ok((origin.x_m, origin.y_m))
    }

    /// The costs as a map, with the values that Nav2 publishes: 0 free, 1 to 98 graded, 99 inscribed, 100 lethal, -1
    /// unknown.
    ///
    /// >>> import periplus
    /// >>> periplus.Costmap(width=2, height=1, resolution=1, plugins=[]).to_grid().cells.tolist()
    /// [[0, 0]]
    fn to_grid(&self, py: Python<'_>) -> PyResult<PyOccupancyGrid> {
        let grid = self.with(py, |state| {
            let grid = state.costmap.costmap();
            let cells = grid.costs().iter().map(|it| cost::occupancy_of(*it)).collect();
            Grid { info: *grid.info(), cells }
        })?;
        Ok(PyOccupancyGrid(Arc::new(grid)))
    }

    /// PNG for notebooks, in the colours of RViz.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let grid = self.to_grid(py)?.0;
        let GridInfo { width, height, .. } = grid.info;
        if grid.info.is_empty() {
            return Ok(None);
        }
        let pixels = (600 / width.max(height)).clamp(1, 8);
        let png = released(py, "the picture", || {
            let samples = paint(&Scheme::Costmap.palette(), width, &grid.cells, pixels);
            let side = |cells: usize| u32::try_from(cells * pixels).unwrap_or(u32::MAX);
            write_png(side(width), side(height), Layout::Rgb, &samples)
        })?;
        Ok(Some(PyBytes::new(py, &png)))
    }

    /// Picture and size for notebooks.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html_picture(py, self._repr_png_(py)?, &self.__repr__(py)?)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let GridInfo { resolution_m, width, height, .. } = self.info(py)?;
        let layers = self.layers(py)?.join(", ");
        Ok(format!("Costmap({height} x {width} cells of {resolution_m} m, layers: {layers})"))
    }
}

impl PyCostmap {
    fn of(
        config: CostmapConfig,
        costmap: LayeredCostmap,
        warnings: Vec<String>,
        failure: Failure,
    ) -> Self {
        let projector = Projector::default();
        let state = State { config, costmap, warnings, costs: None, projector };
        Self { state: Mutex::new(state), failure, updating: Mutex::new(None) }
    }

    fn read(py: Python<'_>, name: &str, text: String, node: &str) -> PyResult<Self> {
        let mut sources = SourceMap::new();
        let file = sources.add(name, text);
        let tree = periplus::yaml::parse(file, &sources)
            .map_err(|finding| finding_error(py, &finding, &sources))?
            .ok_or_else(|| file_error(py, name.as_ref(), "the file is empty"))?;
        let keys = || {
            let keys = tree.entries().unwrap_or_default().iter();
            keys.filter_map(|(key, _)| key.text())
        };
        let table = &periplus::costmap::tables::COSTMAP;
        let is_flat = keys().any(|key| table.find(key).is_some());
        let is_wildcard = keys().any(|key| key.trim_start_matches('/') == "**");
        if !CostmapConfig::is_in(&tree, node) && !is_flat && !is_wildcard {
            let near = closest(node, keys()).map(|near| format!("; did you mean {near:?}?"));
            return Err(PyKeyError::new_err(format!(
                "{name} has no section {node:?}{}",
                near.unwrap_or_default()
            )));
        }
        let mut findings = Diagnostics::new();
        let config = CostmapConfig::read_yaml(&tree, node, None, &mut findings);
        require_no_errors(py, &findings, &sources)?;
        let place = |finding: &Diagnostic| {
            let span = finding.span.filter(|span| sources.holds(*span))?;
            let (file, at) = sources.locate(span);
            Some(format!("{file}:{}:{}: ", at.line, at.column))
        };
        let warning = |finding: &Diagnostic| {
            format!("{}{}", place(finding).unwrap_or_default(), described(finding))
        };
        let warnings = findings.iter().map(warning).collect();
        let costmap = released(py, "the costmap", || config.build())?;
        Ok(Self::of(config, costmap, warnings, Failure::default()))
    }

    /// Works with the costmap, without the interpreter. Fails in a layer that this costmap is calling.
    fn with<R: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut State) -> R + Send,
    ) -> PyResult<R> {
        if *lock(&self.updating) == Some(std::thread::current().id()) {
            return Err(PyRuntimeError::new_err(
                "a layer cannot use its costmap while the costmap calls it",
            ));
        }
        with_locked(py, "the costmap", &self.state, work)
    }

    /// As `with`, for work that calls layers written in Python: raises their exceptions.
    fn with_layers<R: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut State) -> R + Send,
    ) -> PyResult<R> {
        let (updating, failure) = (&self.updating, &self.failure);
        let (result, error) = self.with(py, |state| {
            lock(failure).take();
            *lock(updating) = Some(std::thread::current().id());
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| work(state)));
            *lock(updating) = None;
            (result, lock(failure).take())
        })?;
        match (result, error) {
            (_, Some(error)) => Err(error),
            (Ok(result), None) => Ok(result),
            (Err(panic), None) => released(py, "the costmap", || std::panic::resume_unwind(panic)),
        }
    }

    fn info(&self, py: Python<'_>) -> PyResult<GridInfo> {
        self.with(py, |state| *state.costmap.costmap().info())
    }

    fn no_source(&self, py: Python<'_>, layer: &str, source: &str) -> PyErr {
        let known = self.with(py, |state| {
            let all = state.costmap.all().flat_map(|layer| {
                layer.sources().iter().map(move |it| format!("{}.{}", layer.name(), it.name))
            });
            all.collect::<Vec<String>>()
        });
        let known = known.unwrap_or_default().join(", ");
        PyKeyError::new_err(format!(
            "the costmap has no source `{layer}.{source}`; it has {}",
            if known.is_empty() { "none" } else { &known }
        ))
    }
}

/// Limit of `warnings`.
const MAX_WARNING_COUNT: usize = 1000;

impl State {
    fn note(&mut self, findings: &Diagnostics) {
        self.warnings.extend(findings.iter().map(described));
        let surplus = self.warnings.len().saturating_sub(MAX_WARNING_COUNT);
        self.warnings.drain(..surplus);
    }
}

/// Message, notes and advice of a finding.
fn described(finding: &Diagnostic) -> String {
    let more = finding.notes.iter().chain(&finding.help);
    more.fold(finding.message.clone(), |text, line| format!("{text}; {line}"))
}

fn first_of<L: Any>(costmap: &LayeredCostmap) -> Option<String> {
    let mut all = costmap.all();
    all.find(|layer| (*layer as &dyn Any).is::<L>()).map(|layer| layer.name().to_owned())
}

/// Single-precision values of an array.
enum Singles<'py> {
    Borrowed(PyReadonlyArrayDyn<'py, f32>),
    Converted(Vec<f32>),
}

impl Singles<'_> {
    fn as_slice(&self) -> PyResult<&[f32]> {
        match self {
            Self::Borrowed(array) => Ok(array.as_slice()?),
            Self::Converted(values) => Ok(values),
        }
    }
}

/// Argument in single precision, and its shape. Numpy would warn of values that become infinite.
fn singles<'py>(argument: &Bound<'py, PyAny>, name: &str) -> PyResult<(Singles<'py>, Vec<usize>)> {
    if argument.cast::<PyArrayDyn<f32>>().is_ok() {
        let array = contiguous::<f32>(argument, name)?;
        let shape = array.shape().to_vec();
        return Ok((Singles::Borrowed(array), shape));
    }
    let array = contiguous::<f64>(argument, name)?;
    let values = array.as_slice()?.iter().map(|value| *value as f32).collect();
    Ok((Singles::Converted(values), array.shape().to_vec()))
}

/// Time in nanoseconds.
fn nanoseconds(time_s: f64) -> PyResult<i64> {
    if time_s.abs() < 9e9 {
        return Ok((time_s * 1e9).round() as i64);
    }
    Err(PyValueError::new_err(format!("`time_s` must be a time in seconds, not {time_s}")))
}
