//! Localization on a known map, with the parameters of Nav2's AMCL.

mod estimate;

use std::path::PathBuf;

use numpy::PyArray1;
use periplus::diagnostics::{Diagnostic, DiagnosticCause, Diagnostics, SourceMap};
use periplus::geometry::Pose2;
use periplus::grid::OccupancyGrid;
use periplus::localization::{
    AMCL, Amcl, AmclParams, AmclUpdate, Covariance2, InitialPose, Settings,
};
use periplus::nav_nodes::amcl::read_parameters;
use periplus::params::ParamValues;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::{moved, require_finite};
use crate::background::{Restore, SharedState};
use crate::errors::value_error;
use crate::estimator_parameters::{
    keyword_texts, parameter_list, read_yaml, require_valid, sentence, values_dict, warn,
};
use crate::laser_scanner::{LaserScanner, scan_argument};
use crate::poses::pose2_argument;
use crate::slam::grid_argument;
use crate::transforms::time_argument;
use estimate::{AmclEstimate, PLANAR, state_word};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyAmcl>()?;
    module.add_class::<AmclEstimate>()
}

/// Adaptive Monte Carlo localization on a known map, with the parameters of Nav2.
///
/// Parameters
/// ----------
/// map : OccupancyGrid or (cells, resolution, origin), optional
///     Cells of shape (height, width), the row of lowest y first: 100 occupied, 0 free, anything else unknown; size
///     of a cell [m]; pose of the lower left corner. Also an object with the attributes ``cells``, ``resolution_m``
///     and ``origin``. The cells of ``Slam.map`` are percents: use ``slam.map().trinary()``.
/// yaml : path, optional
///     Parameter file of ROS 2 (``amcl: ros__parameters:``) or ROS 1, or a plain mapping.
/// scanner : LaserScanner, optional
///     Beams and mounting of the scanner, for scans that come as arrays.
/// **parameters
///     Parameters by their names, such as ``max_particles=5000``; they override the file. ``Amcl.parameters()`` lists
///     all. Those of the node (topics, frames) are accepted and have no effect here.
///
/// Source: *Probabilistic Robotics* (Thrun, Burgard, Fox), tables 5.6, 6.1, 6.3, 8.3 and 8.4. In addition the estimate
/// is refined by scan matching, and the robot is found on the map without an initial pose (``global_start``) and after
/// it was carried away (``search_when_lost``). The same calls give the same bits (``random_seed``).
///
/// Raises ``TypeError`` for an unknown parameter, ``ValueError`` for a wrong value, ``FileError`` with line and column
/// for a wrong value or a misspelled name in a file; other unknown names in a file are warnings.
///
/// >>> import numpy as np
/// >>> from periplus import Amcl, LaserScanner
/// >>> cells = np.zeros((30, 40), np.int8)  # a room of 4 m by 3 m
/// >>> cells[[0, -1], :] = cells[:, [0, -1]] = 100
/// >>> scanner = LaserScanner(0.0, np.pi / 2, range_max=9.0)
/// >>> amcl = Amcl((cells, 0.1, (0.0, 0.0, 0.0)), scanner=scanner)
/// >>> amcl.set_initial_pose((2.0, 1.5, 0.0))
/// >>> estimate = amcl.update([1.9, 1.4, 1.9, 1.4], odom_from_base=(0.0, 0.0, 0.0))
/// >>> estimate.has_pose, abs(estimate.pose.x - 2.0) < 0.1
/// (True, True)
#[pyclass(frozen, name = "Amcl", module = "periplus")]
pub(crate) struct PyAmcl {
    state: SharedState<Localization>,
    values: ParamValues,
    scanner: Option<Py<LaserScanner>>,
}

/// The filter, and odometry at its last scan.
#[derive(Clone)]
struct Localization {
    amcl: Amcl,
    odom_from_base: Option<Pose2>,
}

impl Localization {
    fn estimate(&self, update: Option<AmclUpdate>) -> AmclEstimate {
        let amcl = &self.amcl;
        let map_from_odom = amcl.map_from_odom().filter(|_| amcl.estimate().is_some());
        let map_from_base = map_from_odom
            .zip(self.odom_from_base)
            .map(|(map_from_odom, odom_from_base)| (map_from_odom * odom_from_base).normalized());
        AmclEstimate {
            map_from_base,
            map_from_odom,
            covariance: amcl.estimate().map(|it| it.covariance),
            has_pose: amcl.has_pose(),
            status: amcl.status().clone(),
            update,
        }
    }
}

#[pymethods]
impl PyAmcl {
    #[new]
    #[pyo3(signature = (map=None, yaml=None, *, scanner=None, **parameters))]
    fn new(
        py: Python<'_>,
        map: Option<&Bound<'_, PyAny>>,
        yaml: Option<PathBuf>,
        scanner: Option<Py<LaserScanner>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut sources = SourceMap::new();
        let mut findings = Diagnostics::new();
        let tree = yaml.map(|path| read_yaml(py, &path, &mut sources)).transpose()?.flatten();
        let keywords = keyword_texts(parameters)?;
        let values = read_parameters(tree.as_ref(), "amcl", &keywords, &mut findings);
        require_valid(py, &findings, &sources)?;
        let amcl = Amcl::new(Settings::from_values(&values));
        let state = SharedState::new(Localization { amcl, odom_from_base: None });
        let created = Self { state, values, scanner };
        if let Some(map) = map {
            created.set_map(py, map)?;
        }
        Ok(created)
    }

    /// Returns all parameters as a list of dictionaries: ``name``, ``type``, ``unit``, ``default``, ``is_required``,
    /// ``minimum``, ``maximum``, ``excludes_minimum``, ``choices``, ``aliases``, ``doc``.
    ///
    /// >>> from periplus import Amcl
    /// >>> [row["default"] for row in Amcl.parameters() if row["name"] == "max_particles"]
    /// [2000]
    #[staticmethod]
    #[pyo3(name = "parameters")]
    fn parameter_table(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
        parameter_list(py, &AMCL, "")
    }

    /// Returns the values of all parameters, by name.
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        values_dict(py, &self.values)
    }

    /// Sets the map; see the class. A known pose stays. Returns False if ``first_map_only`` is set and there is a map
    /// already. Raises ``ValueError`` for a map without obstacles, and if the known pose is outside of it.
    fn set_map(&self, py: Python<'_>, map: &Bound<'_, PyAny>) -> PyResult<bool> {
        let grid: OccupancyGrid = grid_argument(map)?;
        let result = self.state.with(py, "Amcl.set_map", |it| {
            let frame = it.amcl.settings().global_frame.clone();
            it.amcl.set_map(&frame, &grid)
        })?;
        result.map_err(|finding| raised(&finding))
    }

    /// Sets the initial pose. Without a map it waits for one. A doubtful pose is a warning.
    ///
    /// Parameters
    /// ----------
    /// pose : Pose
    ///     Pose of the robot in the map; also (x, y, yaw) [m, rad].
    /// covariance : array of shape (3, 3), (3,), (6, 6) or (36,), optional
    ///     Covariance of x, y, yaw, its diagonal, or that of a ``PoseWithCovariance``; ``initial_cov_xx``,
    ///     ``initial_cov_yy`` and ``initial_cov_aa`` if not given.
    ///
    /// Raises ``ValueError`` for a pose outside of the map and for an impossible covariance.
    #[pyo3(signature = (pose, covariance=None))]
    fn set_initial_pose(
        &self,
        py: Python<'_>,
        pose: &Bound<'_, PyAny>,
        covariance: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let pose = pose2_argument(pose, "pose")?;
        let covariance = match covariance {
            Some(covariance) => covariance_argument(covariance)?,
            None => {
                let params = AmclParams::from_values(&self.values);
                let usual = Covariance2 {
                    xx: params.initial_cov_xx_m2,
                    xy: 0.0,
                    yy: params.initial_cov_yy_m2,
                    yaw: params.initial_cov_aa_rad2,
                };
                usual.to_rows()
            }
        };
        let result = self.state.with(py, "Amcl.set_initial_pose", |it| {
            let frame = it.amcl.settings().global_frame.clone();
            let then_from_now = Pose2::IDENTITY;
            it.amcl.set_pose(&InitialPose { frame, pose, covariance, then_from_now })
        })?;
        match result.map_err(|finding| raised(&finding))? {
            Some(warning) if warning.cause != Some(DiagnosticCause::MissingMap) => {
                warn(py, &sentence(&warning))
            }
            _ => Ok(()),
        }
    }

    /// Distributes the particles over the free cells of the map, as the service ``reinitialize_global_localization``
    /// of Nav2. ``localize_globally`` finds the robot with one scan instead. Raises ``RuntimeError`` without a map.
    fn global_localization(&self, py: Python<'_>) -> PyResult<()> {
        self.state
            .with(py, "Amcl.global_localization", |it| it.amcl.distribute_uniformly())?
            .map_err(|finding| raised(&finding))
    }

    /// Searches the whole map for a scan, and tracks all poses that fit about as well as the best one until one of
    /// them remains.
    ///
    /// Parameters
    /// ----------
    /// scan : array of shape (B,), or a ``sensor_msgs/LaserScan`` message
    ///     Ranges [m].
    /// scanner : LaserScanner, optional
    ///     Beams and mounting for this scan, in place of those given to the constructor.
    ///
    /// Returns
    /// -------
    /// array of shape (K, 4)
    ///     Poses, best first: x, y [m], yaw [rad], score (0 to 1).
    ///
    /// Ctrl-C raises ``KeyboardInterrupt`` at once, and the filter is as it was before. Raises ``RuntimeError`` without
    /// a map, or if the scan fits nowhere.
    #[pyo3(signature = (scan, *, scanner=None))]
    fn localize_globally<'py>(
        &self,
        py: Python<'py>,
        scan: &Bound<'py, PyAny>,
        scanner: Option<Py<LaserScanner>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let scanner = scanner.as_ref().or(self.scanner.as_ref()).map(Py::get);
        let scan = scan_argument(scan, scanner, Some(0))?;
        let backup = |it: &Localization| -> Option<Restore<Localization>> {
            let copy = it.clone();
            Some(Box::new(move || Some(copy)))
        };
        let peaks = self
            .state
            .interruptible(py, "Amcl.localize_globally", backup, move |it| {
                it.amcl.localize_globally(&scan)
            })?
            .map_err(|finding| raised(&finding))?;
        let rows: Vec<f64> = peaks
            .iter()
            .flat_map(|it| [it.pose.x_m, it.pose.y_m, it.pose.yaw_rad, it.score])
            .collect();
        Ok(moved(py, rows, &[peaks.len(), 4])?.into_any())
    }

    /// Updates the filter with a scan and odometry at its time.
    ///
    /// Parameters
    /// ----------
    /// scan : array of shape (B,), or a ``sensor_msgs/LaserScan`` message
    ///     Ranges [m]; NaN is dropped, infinity hit nothing.
    /// odom_from_base : Pose
    ///     Pose of the robot by odometry; also (x, y, yaw) [m, rad].
    /// time_s : float, optional
    ///     Time of the scan [s]; or ``time_ns`` [ns].
    /// scanner : LaserScanner, optional
    ///     Beams and mounting for this scan, in place of those given to the constructor.
    ///
    /// Raises ``RuntimeError`` without a map, or without an initial pose if ``global_start`` is off; ``ValueError`` for
    /// a scan that cannot be used.
    #[pyo3(signature = (scan, odom_from_base, *, time_s=None, time_ns=None, scanner=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn update(
        &self,
        py: Python<'_>,
        scan: &Bound<'_, PyAny>,
        odom_from_base: &Bound<'_, PyAny>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        scanner: Option<Py<LaserScanner>>,
    ) -> PyResult<AmclEstimate> {
        let scanner = scanner.as_ref().or(self.scanner.as_ref()).map(Py::get);
        let time_ns = time_argument(time_s, time_ns)?.unwrap_or(0);
        let scan = scan_argument(scan, scanner, Some(time_ns))?;
        let odom_from_base = pose2_argument(odom_from_base, "odom_from_base")?;
        let result = self.state.with(py, "Amcl.update", |it| {
            let update = it.amcl.update(odom_from_base, &scan)?;
            it.odom_from_base = Some(odom_from_base);
            Ok(it.estimate(update))
        })?;
        py.check_signals()?;
        result.map_err(|finding: Box<Diagnostic>| raised(&finding))
    }

    /// Uses the next scan even if the robot did not move.
    fn request_update(&self, py: Python<'_>) -> PyResult<()> {
        self.state.with(py, "Amcl", |it| it.amcl.request_update())
    }

    /// Resets odometry: its origin changed.
    fn reset_odometry(&self, py: Python<'_>) -> PyResult<()> {
        self.state.with(py, "Amcl", |it| {
            it.amcl.reset_odometry();
            it.odom_from_base = None;
        })
    }

    /// Present estimate.
    #[getter]
    fn estimate(&self, py: Python<'_>) -> PyResult<AmclEstimate> {
        self.state.with(py, "Amcl", |it| it.estimate(None))
    }

    /// Particles, shape (N, 4): x, y [m], yaw [rad], weight; the weights sum to 1. Empty before an initial pose or
    /// global localization.
    #[getter]
    fn particles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let particles = self.state.with(py, "Amcl", |it| it.amcl.particles().clone())?;
        let rows: Vec<f64> = (0..particles.len())
            .flat_map(|at| {
                [particles.x_m[at], particles.y_m[at], particles.yaw_rad[at], particles.weight[at]]
            })
            .collect();
        Ok(moved(py, rows, &[particles.len(), 4])?.into_any())
    }

    /// Returns the likelihood of a scan at each particle, shape (N,), up to a common factor. Nothing changes.
    /// Arguments as for ``localize_globally``.
    #[pyo3(signature = (scan, *, scanner=None))]
    fn likelihoods<'py>(
        &self,
        py: Python<'py>,
        scan: &Bound<'py, PyAny>,
        scanner: Option<Py<LaserScanner>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let scanner = scanner.as_ref().or(self.scanner.as_ref()).map(Py::get);
        let scan = scan_argument(scan, scanner, Some(0))?;
        let likelihoods = self.state.with(py, "Amcl", |it| it.amcl.likelihoods(&scan))?;
        Ok(PyArray1::from_vec(py, likelihoods.map_err(|finding| raised(&finding))?))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        self.state.with(py, "Amcl", |it| {
            let state = state_word(it.amcl.status().state);
            format!("Amcl(state={state:?}) with {} particles", it.amcl.particles().len())
        })
    }
}

/// Row-major 6 by 6 covariance from that of a planar pose or of a pose in space.
fn covariance_argument(argument: &Bound<'_, PyAny>) -> PyResult<[f64; 36]> {
    let array = crate::arrays::contiguous::<f64>(argument, "covariance")?;
    let values = array.as_slice()?;
    require_finite(values, "covariance")?;
    let mut rows = [0.0; 36];
    match numpy::PyUntypedArrayMethods::shape(&*array) {
        [6, 6] | [36] => rows.copy_from_slice(values),
        [3] => {
            for (at, value) in PLANAR.iter().zip(values) {
                rows[at * 7] = *value;
            }
        }
        [3, 3] => {
            for (at, value) in values.iter().enumerate() {
                rows[PLANAR[at / 3] * 6 + PLANAR[at % 3]] = *value;
            }
        }
        shape => {
            return Err(PyValueError::new_err(format!(
                "`covariance` must have the shape (3, 3), (3,), (6, 6) or (36,), not {shape:?}"
            )));
        }
    }
    Ok(rows)
}

/// Error of the filter: a missing map or pose is a `RuntimeError`, anything else a `ValueError`.
fn raised(finding: &Diagnostic) -> PyErr {
    match finding.cause {
        Some(DiagnosticCause::MissingMap) => {
            PyRuntimeError::new_err("there is no map: give `map`, or call `set_map`")
        }
        Some(DiagnosticCause::MissingInitialPose) => PyRuntimeError::new_err(
            "no initial pose is set: call `set_initial_pose` or `localize_globally`, or set `global_start=True`",
        ),
        Some(DiagnosticCause::MapWithoutWalls) => PyValueError::new_err(format!(
            "{}; the cells of `Slam.map` are percents: use `slam.map().trinary()`",
            finding.message
        )),
        Some(DiagnosticCause::NoPossiblePose) => PyRuntimeError::new_err(sentence(finding)),
        _ => value_error(sentence(finding)),
    }
}
