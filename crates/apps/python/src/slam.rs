//! Mapping with a laser scanner, by both methods.

mod grid;
mod log;
mod mapper;
mod parameters;
mod records;

use std::path::PathBuf;
use std::sync::Arc;

use periplus::diagnostics::plain_words;
use periplus::geometry::{LaserScan2, Pose2};
use periplus::params::{ParamValues, Params as _};
use periplus::scan_matching::Symmetric3;
use periplus::slam::tables::{GmappingParams, MountingParams, SlamToolboxParams};
use periplus::slam::{AnyMapper, CorrectedInput, Method, MountingCorrection, Settings, Slam};
use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyType};

use crate::arrays::{moved, require_finite};
use crate::background::{Restore, SharedState};
use crate::errors::{FileError, file_error, require_file, runtime_error, value_error};
use crate::estimator_parameters::{parameter_list, values_dict};
use crate::laser_scanner::{LaserScanner, scan_argument};
use crate::maps::PyOccupancyGrid;
use crate::poses::{PyPose, pose2_argument};
use crate::transforms::{seconds, time_argument, times_argument};
use mapper::Mapping;
use records::{PoseGraph, SlamRemark, SlamUpdate};

pub(crate) use grid::grid_argument;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PySlam>()?;
    module.add_class::<SlamUpdate>()?;
    module.add_class::<SlamRemark>()?;
    module.add_class::<PoseGraph>()
}

/// Number of cells of a map that are drawn between two checks for Ctrl-C.
const MAP_CELLS_PER_SLICE: usize = 1 << 20;

/// Map and trajectory from laser scans, with odometry where there is some.
///
/// Parameters
/// ----------
/// method : {"graph", "gmapping"}, optional
///     Pose graph with the parameters of ``slam_toolbox``, or particle filter with those of ``slam_gmapping``. If not
///     given: the method whose parameters are given, else the graph.
/// yaml : path, optional
///     Parameter file of ROS 2 (``slam_toolbox: ros__parameters:``) or ROS 1 (``slam_gmapping:``), or a plain mapping.
/// scanner : LaserScanner, optional
///     Beams and mounting of the scanner, for scans that come as arrays.
/// **parameters
///     Parameters by their names, such as ``resolution=0.1``; they override the file. ``Slam.parameters(method)``
///     lists all. Those of the node (topics, frames, periods) are accepted and have no effect here.
///
/// The first scan is at its odometry pose, or at the origin. The same scans give the same map, bit for bit, and the
/// same as ``periplus slam``. Times are seconds (``time_s``) or nanoseconds (``time_ns``). Long calls let other
/// threads run, and Ctrl-C works in them: ``process`` stops between slices of some milliseconds and the rest of its
/// work is done by the next call.
///
/// Raises ``TypeError`` for an unknown parameter, ``ValueError`` for a wrong value, ``FileError`` with line and column
/// for a wrong value or a misspelled name in a file; other unknown names in a file are warnings.
///
/// >>> import numpy as np
/// >>> from periplus import LaserScanner, Slam
/// >>> angles = np.radians(np.arange(360))
/// >>> slam = Slam(scanner=LaserScanner.from_angles(angles, range_max=10.0))
/// >>> for step in range(11):  # a room of 6 m by 4 m, without odometry
/// ...     x = 0.1 * step
/// ...     to_x = (3.0 * np.sign(np.cos(angles)) - x) / np.cos(angles)
/// ...     to_y = 2.0 / np.maximum(np.abs(np.sin(angles)), 1e-9)
/// ...     update = slam.process(np.minimum(to_x, to_y), time_s=0.1 * step)
/// >>> round(update.map_from_base.x, 1)
/// 1.0
/// >>> slam.finish()
/// >>> slam.trajectory().shape
/// (11, 4)
#[pyclass(frozen, name = "Slam", module = "periplus")]
pub(crate) struct PySlam {
    state: SharedState<Mapping>,
    method: Method,
    values: ParamValues,
    scanner: Option<Py<LaserScanner>>,
    /// Every Nth scan is used.
    every: usize,
}

#[pymethods]
impl PySlam {
    #[new]
    #[pyo3(signature = (method=None, yaml=None, *, scanner=None, **parameters))]
    fn new(
        py: Python<'_>,
        method: Option<&str>,
        yaml: Option<PathBuf>,
        scanner: Option<Py<LaserScanner>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let method = method.map(parse_method).transpose()?;
        let (method, values) = parameters::read(py, method, yaml.as_deref(), parameters)?;
        Ok(Self::of(mapper::empty(method, &values), method, values, scanner))
    }

    /// Returns the parameters of a method as a list of dictionaries: ``name``, ``type``, ``unit``, ``default``,
    /// ``is_required``, ``minimum``, ``maximum``, ``excludes_minimum``, ``choices``, ``aliases``, ``doc``.
    ///
    /// >>> from periplus import Slam
    /// >>> [row["default"] for row in Slam.parameters("gmapping") if row["name"] == "particles"]
    /// [30]
    #[staticmethod]
    #[pyo3(name = "parameters", signature = (method="graph"))]
    fn parameter_table<'py>(py: Python<'py>, method: &str) -> PyResult<Bound<'py, PyList>> {
        parameter_list(py, parse_method(method)?.table(), "")
    }

    /// Maps a CARMEN log (``.log``, ``.clf``), as ``periplus slam`` does.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The log.
    /// method, yaml, **parameters
    ///     As for the class.
    /// finish : bool
    ///     Run ``finish`` at the end. If an error of the scanner's mounting or of the odometry axes is certain then
    ///     and ``correct_mounting`` is set, the log is mapped again without it; see ``mounting_correction``.
    ///
    /// >>> import pathlib, tempfile
    /// >>> from periplus import Slam
    /// >>> scan = " ".join(["2.0"] * 180)
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     path = pathlib.Path(folder, "run.log")
    /// ...     _ = path.write_text(f"FLASER 180 {scan} 0 0 0 0 0 0 1.5 host 0\n")
    /// ...     slam = Slam.from_log(path, resolution=0.1)
    /// >>> slam.trajectory().tolist()
    /// [[1.5, 0.0, 0.0, 0.0]]
    ///
    /// Malformed lines are warnings. Raises ``FileNotFoundError``, and ``FileError`` for a file without scans or of
    /// another kind: recordings (``.bag``, ``.mcap``, ``.db3``) are mapped by ``periplus slam``, or scan by scan.
    /// Ctrl-C works between scans.
    #[classmethod]
    #[pyo3(signature = (path, method=None, yaml=None, *, finish=true, **parameters))]
    fn from_log(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        path: PathBuf,
        method: Option<&str>,
        yaml: Option<PathBuf>,
        finish: bool,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let slam = Self::new(py, method, yaml, None, parameters)?;
        let scans = log::read(py, &path)?;
        slam.map_log(py, &scans, None, finish)?;
        let corrects = MountingParams::from_values(&slam.values).correct_mounting;
        let correction = slam.correction(py)?.filter(|_| finish && corrects);
        let Some(correction) = correction else { return Ok(slam) };
        let Self { method, values, .. } = slam;
        let slam = Self::of(mapper::empty(method, &values), method, values, None);
        slam.map_log(py, &scans, Some(correction), finish)?;
        slam.state.with(py, "Slam.from_log", |mapping| mapping.correction = Some(correction))?;
        Ok(slam)
    }

    /// Processes a scan.
    ///
    /// Parameters
    /// ----------
    /// scan : array of shape (B,), or a ``sensor_msgs/LaserScan`` message
    ///     Ranges [m]; NaN, 0 and infinity are beams without a return. A message, or any object with its fields, has
    ///     its beams and its time with it.
    /// odom_from_base : Pose, optional
    ///     Pose of the robot by odometry at the time of the scan; also (x, y, yaw) [m, rad].
    /// time_s : float
    ///     Time of the first beam [s]; or ``time_ns`` [ns].
    /// scanner : LaserScanner, optional
    ///     Beams and mounting for this scan, in place of those given to the constructor.
    ///
    /// Ctrl-C raises ``KeyboardInterrupt`` after the scan is used; background work that is left, such as a loop
    /// closure, is done by the next call.
    #[pyo3(signature = (scan, odom_from_base=None, *, time_s=None, time_ns=None, scanner=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn process(
        &self,
        py: Python<'_>,
        scan: &Bound<'_, PyAny>,
        odom_from_base: Option<&Bound<'_, PyAny>>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        scanner: Option<Py<LaserScanner>>,
    ) -> PyResult<SlamUpdate> {
        let scanner = scanner.as_ref().or(self.scanner.as_ref()).map(Py::get);
        let scan = scan_argument(scan, scanner, time_argument(time_s, time_ns)?)?;
        let odom_from_base =
            odom_from_base.map(|it| pose2_argument(it, "odom_from_base")).transpose()?;
        self.process_scan(py, &scan, odom_from_base)
    }

    /// Processes many scans, and returns the list of their updates.
    ///
    /// Parameters
    /// ----------
    /// ranges : array of shape (N, B)
    ///     Ranges of each scan [m].
    /// odom_from_base : array of shape (N, 3), optional
    ///     Odometry at each scan: x, y [m], yaw [rad]. A row of NaN has none.
    /// times_s : array of shape (N,)
    ///     Times [s]; or ``times_ns`` [ns], whole numbers.
    /// scanner : LaserScanner, optional
    ///     Beams and mounting, in place of those given to the constructor.
    #[pyo3(signature = (ranges, odom_from_base=None, *, times_s=None, times_ns=None, scanner=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn process_many(
        &self,
        py: Python<'_>,
        ranges: &Bound<'_, PyAny>,
        odom_from_base: Option<&Bound<'_, PyAny>>,
        times_s: Option<&Bound<'_, PyAny>>,
        times_ns: Option<&Bound<'_, PyAny>>,
        scanner: Option<Py<LaserScanner>>,
    ) -> PyResult<Vec<SlamUpdate>> {
        let scanner = scanner.as_ref().or(self.scanner.as_ref()).map(Py::get);
        let scanner = scanner.ok_or_else(|| {
            PyTypeError::new_err("give `scanner=LaserScanner(...)` here or to the constructor")
        })?;
        let scans = scanner.scans(ranges, &times_argument(times_s, times_ns)?)?;
        let odometry = match odom_from_base {
            None => vec![None; scans.len()],
            Some(argument) => odometry_argument(argument, scans.len())?,
        };
        let both = scans.iter().zip(odometry);
        both.map(|(scan, odom_from_base)| self.process_scan(py, scan, odom_from_base)).collect()
    }

    /// Finishes the map: all poses are refined together, and the map is audited, which adds remarks. More scans may
    /// follow.
    ///
    /// This takes seconds for a large map. Ctrl-C raises ``KeyboardInterrupt`` at once: the graph is then as it was
    /// before ``finish``, and the abandoned work ends in a thread in the background. With ``gmapping`` the next call
    /// waits until that thread has finished the map.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        self.work(py)?;
        let backup = |mapping: &Mapping| -> Option<Restore<Mapping>> {
            let slam = mapping.mapper.graph()?;
            let (bytes, rest) = (slam.save(), mapping.without_mapper());
            let settings = mapping.settings.clone()?;
            Some(Box::new(move || {
                let slam = Slam::resume(&bytes, settings).ok()?;
                Some(rest.with(AnyMapper::Graph(Box::new(slam))))
            }))
        };
        self.state.interruptible(py, "Slam.finish", backup, |mapping| {
            mapping.mapper.get_mut().finish();
        })
    }

    /// Method: ``"graph"`` or ``"gmapping"``.
    #[getter]
    fn method(&self) -> &'static str {
        self.method.word()
    }

    /// Pose of the robot in the map at the last scan.
    #[getter]
    fn map_from_base(&self, py: Python<'_>) -> PyResult<PyPose> {
        let pose = self.read(py, |mapping| mapping.mapper.get().map_from_base())?;
        Ok(PyPose(pose.into()))
    }

    /// Covariance of the last pose relative to the surrounding scans, along the axes of the map, shape (3, 3): x, y [m],
    /// yaw [rad]. Raises ``ValueError`` for ``gmapping``.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let covariance = self.read(py, |mapping| mapping.mapper.graph().map(Slam::covariance))?;
        let Symmetric3 { xx, xy, xt, yy, yt, tt } =
            covariance.ok_or_else(|| no_graph("covariance"))?;
        Ok(moved(py, vec![xx, xy, xt, xy, yy, yt, xt, yt, tt], &[3, 3])?.into_any())
    }

    /// Sets the pose of the robot in the map, as ``/initialpose`` does: the next scan is matched around it. Before
    /// the first scan it defines the origin of the map. Only with ``method="graph"``.
    ///
    /// Parameters
    /// ----------
    /// pose : Pose
    ///     Pose in the map; also (x, y, yaw).
    /// variances : tuple of three floats
    ///     Variances of x, y [m^2] and yaw [rad^2].
    #[pyo3(signature = (pose, variances=(0.25, 0.25, 0.07)))]
    fn set_pose(
        &self,
        py: Python<'_>,
        pose: &Bound<'_, PyAny>,
        variances: (f64, f64, f64),
    ) -> PyResult<()> {
        let pose = pose2_argument(pose, "pose")?;
        let (xx, yy, yaw) = variances;
        require_finite(&[xx, yy, yaw], "variances")?;
        if xx <= 0.0 || yy <= 0.0 || yaw <= 0.0 {
            return Err(PyValueError::new_err("`variances` must be above 0"));
        }
        let is_set = self.state.with(py, "Slam.set_pose", |mapping| {
            let AnyMapper::Graph(slam) = &mut mapping.mapper else { return false };
            slam.place(pose, Symmetric3::diagonal(xx, yy, yaw));
            true
        })?;
        if is_set { Ok(()) } else { Err(no_graph("set_pose")) }
    }

    /// Returns the map as it is now. Its cells are percents: -1 unknown, 0 free to 100 occupied.
    ///
    /// >>> from periplus import LaserScanner, Slam
    /// >>> slam = Slam(scanner=LaserScanner(-1.5, 0.1, range_max=10.0), resolution=0.1)
    /// >>> _ = slam.process([2.0] * 31, (0.0, 0.0, 0.0), time_s=0.0)
    /// >>> grid = slam.map()
    /// >>> grid.resolution_m, bool(grid.cells.max() > 50)
    /// (0.1, True)
    ///
    /// Raises ``RuntimeError`` before the first scan, and ``MemoryError`` for a map that is too large to hold.
    fn map(&self, py: Python<'_>) -> PyResult<PyOccupancyGrid> {
        let drawing = self.read(py, Mapping::drawing)?;
        Ok(PyOccupancyGrid(Arc::new(drawing.draw(py, MAP_CELLS_PER_SLICE)?)))
    }

    /// Returns the pose at each scan that was not rejected, shape (N, 4): time [s], x, y [m], yaw [rad].
    fn trajectory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let trajectory = self.read(py, |mapping| mapping.mapper.get().trajectory())?;
        let rows: Vec<f64> = trajectory
            .iter()
            .flat_map(|(time_ns, it)| [seconds(*time_ns), it.x_m, it.y_m, it.yaw_rad])
            .collect();
        Ok(moved(py, rows, &[trajectory.len(), 4])?.into_any())
    }

    /// Returns the exact times of the rows of ``trajectory``, shape (N,), int64 [ns].
    fn trajectory_times_ns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let trajectory = self.read(py, |mapping| mapping.mapper.get().trajectory())?;
        let times: Vec<i64> = trajectory.iter().map(|(time_ns, _)| *time_ns).collect();
        let count = times.len();
        Ok(moved(py, times, &[count])?.into_any())
    }

    /// Returns keyframes and constraints as arrays. Raises ``ValueError`` for ``gmapping``.
    fn graph(&self, py: Python<'_>) -> PyResult<PoseGraph> {
        self.read(py, |mapping| mapping.mapper.graph().map(PoseGraph::of))?
            .ok_or_else(|| no_graph("graph"))
    }

    /// Returns the pose graph as text in the format of g2o. Raises ``ValueError`` for ``gmapping``.
    fn g2o(&self, py: Python<'_>) -> PyResult<String> {
        self.read(py, |mapping| mapping.mapper.graph().map(Slam::to_g2o))?
            .ok_or_else(|| no_graph("g2o"))
    }

    /// Warnings and notices so far, in the order of detection.
    #[getter]
    fn remarks(&self, py: Python<'_>) -> PyResult<Vec<SlamRemark>> {
        self.read(py, |mapping| {
            mapping.mapper.get().remarks().iter().map(|it| SlamRemark(it.clone())).collect()
        })
    }

    /// Returns where two passes through the same area contradict each other, after ``finish``: a list of
    /// dictionaries with ``position`` (x, y) [m], ``agreeing_ratio``, ``keyframes`` and ``times_s`` (first and last
    /// of the stretch), and the same of the ``earlier`` pass.
    fn contradictions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let found = self.read(py, |mapping| mapping.mapper.get().contradictions())?;
        records::contradictions(py, &found)
    }

    /// Returns the loop closure candidates with the decision on each: a list of dictionaries with ``keyframes``
    /// (old, new), ``old_from_new`` (a Pose), ``is_accepted``, ``region_m`` (three standard deviations of the
    /// relative position before it), ``agreeing_ratio`` and ``reason``. Empty for ``gmapping``.
    fn closures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let found = self.read(py, |mapping| mapping.mapper.get().closures().to_vec())?;
        records::closures(py, &found)
    }

    /// Counts: a dictionary with ``scans``, ``keyframes`` (inserted), ``unmatched``, ``rejected``,
    /// ``proximity_constraints``, ``loop_closures``, ``loop_searches``, ``resamplings`` and ``memory_bytes``.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (counts, closures, resamplings, size) = self.read(py, |mapping| {
            let mapper = mapping.mapper.get();
            let closures = mapper.closures().iter().filter(|it| it.is_accepted).count();
            (mapper.counts(), closures, mapper.resamplings(), mapper.size())
        })?;
        let row = PyDict::new(py);
        row.set_item("scans", counts.scans)?;
        row.set_item("keyframes", counts.kept)?;
        row.set_item("unmatched", counts.lost)?;
        row.set_item("rejected", counts.ignored)?;
        row.set_item("proximity_constraints", counts.proximity)?;
        row.set_item("loop_closures", closures)?;
        row.set_item("loop_searches", counts.searches)?;
        row.set_item("resamplings", resamplings)?;
        row.set_item("memory_bytes", size)?;
        Ok(row)
    }

    /// Error of the scanner's mounting or of the odometry axes that the remarks report for certain, as text, or None.
    /// ``from_log`` corrects it.
    #[getter]
    fn mounting_correction(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let corrected = self.read(py, |mapping| mapping.correction)?;
        let correction = match corrected {
            Some(corrected) => Some(corrected),
            None => self.correction(py)?,
        };
        Ok(correction.map(|it| it.to_string()))
    }

    /// Returns the values of all parameters, by name.
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        values_dict(py, &self.values)
    }

    /// Returns the session: the whole state as bytes, without the parameters. Raises ``ValueError`` for ``gmapping``.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = self.session(py, "to_bytes")?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Writes the session to a file, as ``periplus slam --save-session``. To go on with it to the bit, save before
    /// ``finish`` and load with the same parameters. Raises ``OSError``; ``ValueError`` for ``gmapping``.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let bytes = self.session(py, "save")?;
        let written = py.detach(|| std::fs::write(&path, bytes));
        written.map_err(|error| match error.raw_os_error() {
            // The constructor of Python picks the subclass, such as `FileNotFoundError`.
            Some(number) => PyOSError::new_err((number, plain_words(&error), path)),
            None => PyOSError::new_err(format!("{}: {error}", path.display())),
        })
    }

    /// Continues the session of a file. Other parameters as for the class; the method is the graph.
    ///
    /// Raises ``FileNotFoundError``, and ``FileError`` for a damaged session or one of another version.
    #[classmethod]
    #[pyo3(signature = (path, yaml=None, *, scanner=None, **parameters))]
    fn load(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        path: PathBuf,
        yaml: Option<PathBuf>,
        scanner: Option<Py<LaserScanner>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        require_file(&path)?;
        let bytes = periplus_session::files::read(&path);
        let bytes = bytes.map_err(|error| file_error(py, &path, error))?;
        Self::resumed(py, &bytes, yaml, scanner, parameters)?
            .map_err(|error| file_error(py, &path, error))
    }

    /// Continues the session of ``to_bytes``. Other parameters as for the class; the method is the graph.
    ///
    /// Raises ``FileError`` for damaged bytes or those of another version.
    #[classmethod]
    #[pyo3(signature = (data, yaml=None, *, scanner=None, **parameters))]
    fn from_bytes(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        data: &[u8],
        yaml: Option<PathBuf>,
        scanner: Option<Py<LaserScanner>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        Self::resumed(py, data, yaml, scanner, parameters)?
            .map_err(|error| FileError::new_err(error.to_string()))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let counts = self.read(py, |mapping| mapping.mapper.get().counts())?;
        Ok(format!(
            "Slam(method={:?}) after {} scans, {} keyframes",
            self.method.word(),
            counts.scans,
            counts.kept
        ))
    }
}

impl PySlam {
    fn of(
        mapper: AnyMapper,
        method: Method,
        values: ParamValues,
        scanner: Option<Py<LaserScanner>>,
    ) -> Self {
        let every = match method {
            Method::Graph => SlamToolboxParams::from_values(&values).throttle_scans,
            Method::Gmapping => GmappingParams::from_values(&values).throttle_scans,
        };
        let settings = (method == Method::Graph).then(|| mapper::settings(&values));
        let state = SharedState::new(Mapping::new(mapper, settings));
        Self { state, method, values, scanner, every: every.max(1) }
    }

    fn resumed(
        py: Python<'_>,
        bytes: &[u8],
        yaml: Option<PathBuf>,
        scanner: Option<Py<LaserScanner>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Result<Self, periplus::slam::SessionError>> {
        let (method, values) =
            parameters::read(py, Some(Method::Graph), yaml.as_deref(), parameters)?;
        let settings: Settings = mapper::settings(&values);
        let slam = crate::work::released(py, "Slam.load", || Slam::resume(bytes, settings))?;
        Ok(slam.map(|slam| Self::of(AnyMapper::Graph(Box::new(slam)), method, values, scanner)))
    }

    fn read<R: Send>(
        &self,
        py: Python<'_>,
        read: impl FnOnce(&Mapping) -> R + Send,
    ) -> PyResult<R> {
        self.state.with(py, "Slam", |mapping| read(mapping))
    }

    /// Does the background work that is left, in slices.
    fn work(&self, py: Python<'_>) -> PyResult<()> {
        while self.state.with(py, "Slam.process", Mapping::work_slices)? {
            py.check_signals()?;
        }
        Ok(())
    }

    fn process_scan(
        &self,
        py: Python<'_>,
        scan: &LaserScan2,
        odom_from_base: Option<Pose2>,
    ) -> PyResult<SlamUpdate> {
        py.check_signals()?;
        let is_used =
            self.state.with(py, "Slam.process", |mapping| mapping.counts_in(self.every))?;
        if !is_used {
            return self.read(py, |mapping| mapping.skipped(odom_from_base));
        }
        self.work(py)?;
        let begun = self.state.with(py, "Slam.process", |mapping| {
            let begun = mapping.add_scan(scan, odom_from_base);
            (begun, mapping.work_slices())
        })?;
        let (begun, has_more) = begun;
        if has_more {
            py.check_signals()?;
            self.work(py)?;
        }
        self.state.with(py, "Slam.process", |mapping| mapping.end_scan(begun, odom_from_base))
    }

    fn map_log(
        &self,
        py: Python<'_>,
        scans: &[(LaserScan2, Option<Pose2>)],
        correction: Option<MountingCorrection>,
        finish: bool,
    ) -> PyResult<()> {
        let mut corrected = correction.map(CorrectedInput::new);
        for (scan, odom_from_base) in scans {
            match &mut corrected {
                None => self.process_scan(py, scan, *odom_from_base)?,
                Some(input) => {
                    let (scan, odom_from_base) = input.apply(scan, *odom_from_base);
                    self.process_scan(py, &scan, odom_from_base)?
                }
            };
        }
        if finish { self.finish(py) } else { Ok(()) }
    }

    fn correction(&self, py: Python<'_>) -> PyResult<Option<MountingCorrection>> {
        self.read(py, |mapping| MountingCorrection::of(mapping.mapper.get().remarks()))
    }

    fn session(&self, py: Python<'_>, what: &str) -> PyResult<Vec<u8>> {
        self.read(py, |mapping| mapping.mapper.graph().map(Slam::save))?
            .ok_or_else(|| no_graph(what))
    }
}

fn parse_method(method: &str) -> PyResult<Method> {
    method.parse().map_err(|error: String| value_error(error))
}

fn no_graph(what: &str) -> PyErr {
    PyValueError::new_err(format!("`{what}` needs method=\"graph\": gmapping has no graph"))
}

/// Odometry of many scans, shape (N, 3); a row of NaN has none.
fn odometry_argument(argument: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Option<Pose2>>> {
    let array = crate::arrays::input::<f64>(argument, "odom_from_base", &[Some(count), Some(3)])?;
    let rows = array.as_slice()?.chunks_exact(3);
    rows.map(|row| {
        if row.iter().all(|it| it.is_nan()) {
            return Ok(None);
        }
        require_finite(row, "odom_from_base")?;
        Ok(Some(Pose2::new(row[0], row[1], row[2])))
    })
    .collect()
}

/// A map that is too large to hold.
fn too_large() -> PyErr {
    pyo3::exceptions::PyMemoryError::new_err(
        "the map is too large to hold; use a shorter maximum range or a coarser resolution",
    )
}

/// A map without a scan.
fn no_scan() -> PyErr {
    runtime_error("there is no map before the first scan")
}
