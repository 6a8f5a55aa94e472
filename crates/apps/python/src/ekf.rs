//! Extended Kalman filter with the parameters of `robot_localization`.

mod estimate;
mod parameters;
mod readings;

use std::path::PathBuf;
use std::sync::Mutex;

use numpy::PyArray1;
use periplus::ekf::{
    Covariance, Ekf, Estimate, ImuReading, Intake, Kind, Measurement, PoseReading, Refusal,
    STATE_DIMENSIONS, State, TwistReading,
};
use periplus::geometry::Pose;
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use crate::arrays::{input, require_finite};
use crate::poses::{PyPose, pose_argument};
use crate::transforms::time_argument;
use crate::work::{lock, with_locked};
use estimate::EkfEstimate;
use readings::{NAMES, covariance_argument, rotation_argument, variable, vector_argument};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyEkf>()?;
    module.add_class::<EkfEstimate>()
}

/// Number of measurements that the filter queues.
const MAX_QUEUED_COUNT: usize = 10_000;

/// The filter and its inputs.
struct Filter {
    ekf: Ekf,
    intakes: Vec<Intake>,
    /// Times of queued measurements \[ns\].
    queued_ns: Vec<i64>,
}

impl Filter {
    /// Queues measurements; False if there are none.
    fn push(&mut self, measurements: impl IntoIterator<Item = Measurement>) -> PyResult<bool> {
        let mut is_any = false;
        for measurement in measurements {
            if self.queued_ns.len() >= MAX_QUEUED_COUNT {
                return Err(PyRuntimeError::new_err(format!(
                    "{MAX_QUEUED_COUNT} measurements wait: call `update` with a time after them"
                )));
            }
            if !measurement.is_finite() {
                return Err(PyValueError::new_err("the measurement is not finite"));
            }
            if !measurement.is_empty() {
                self.queued_ns.push(measurement.time_ns);
                is_any = true;
            }
            self.ekf.push(measurement);
        }
        Ok(is_any)
    }
}

/// Extended Kalman filter that fuses odometry, IMU, poses and velocities, with the parameters of ``ekf_node`` in
/// ``robot_localization``.
///
/// Parameters
/// ----------
/// yaml : path, optional
///     Parameter file of ROS 2 (``ekf_filter_node: ros__parameters:``, ``/**:``), or a plain mapping.
/// node : str
///     Name of the node in the file.
/// **parameters
///     Parameters by their names, such as ``two_d_mode=True``; they override the file. An input has a name (``odom0``,
///     ``pose0``, ``twist0``, ``imu0``, ...) and parameters that begin with it: ``odom0_config`` is a list of 15
///     booleans, see ``Ekf.VARIABLES``. ``Ekf.parameters()`` lists all.
///
/// Measurements are queued by ``add_*`` in any order; ``update`` uses those up to a time in the order of their times.
/// Times are seconds (``time_s``) or nanoseconds (``time_ns``). Parameters of the node (frames, topics, rates) are
/// accepted and have no effect here. Equations: Moore and Stouch, "A Generalized Extended Kalman Filter
/// Implementation for the Robot Operating System" (2014).
///
/// Raises ``TypeError`` for an unknown parameter, ``ValueError`` for a wrong value, ``FileError`` with line and column
/// for a wrong value or a misspelled name in a file; other unknown names in a file are warnings.
///
/// >>> from periplus import Ekf
/// >>> use = [name in ("vx", "vyaw") for name in Ekf.VARIABLES]
/// >>> ekf = Ekf(two_d_mode=True, odom0_config=use)
/// >>> for step in range(51):
/// ...     _ = ekf.add_twist("odom0", (0.5, 0, 0), (0, 0, 0), [1e-4] * 6, time_s=0.02 * step)
/// >>> ekf.update(1.0)
/// True
/// >>> round(ekf.pose.x, 2)
/// 0.5
#[pyclass(frozen, name = "Ekf", module = "periplus")]
pub(crate) struct PyEkf {
    filter: Mutex<Filter>,
}

#[pymethods]
impl PyEkf {
    /// Names of the 15 variables, in the order of the state.
    #[classattr]
    #[pyo3(name = "VARIABLES")]
    fn variables(py: Python<'_>) -> PyResult<Py<PyTuple>> {
        PyTuple::new(py, NAMES).map(Bound::unbind)
    }

    #[new]
    #[pyo3(signature = (yaml=None, *, node="ekf_filter_node", **parameters))]
    fn new(
        py: Python<'_>,
        yaml: Option<PathBuf>,
        node: &str,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let settings = parameters::read(py, yaml.as_deref(), node, parameters)?;
        let intakes = settings.sources.iter().cloned().map(Intake::new).collect();
        let filter = Filter { ekf: Ekf::new(settings), intakes, queued_ns: Vec::new() };
        Ok(Self { filter: Mutex::new(filter) })
    }

    /// Returns all parameters as a list of dictionaries: ``name``, ``type``, ``unit``, ``default``, ``is_required``,
    /// ``minimum``, ``maximum``, ``excludes_minimum``, ``choices``, ``aliases``, ``doc``. Those of an input are
    /// listed for ``odom0``.
    ///
    /// >>> from periplus import Ekf
    /// >>> [row["default"] for row in Ekf.parameters() if row["name"] == "frequency"]
    /// [30.0]
    #[staticmethod]
    #[pyo3(name = "parameters")]
    fn parameter_table(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
        parameters::list(py)
    }

    /// Names of the inputs, such as ``odom0``.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        lock(&self.filter).intakes.iter().map(|it| it.source().name.clone()).collect()
    }

    /// Queues a pose of an input ``odomN`` or ``poseN``.
    ///
    /// Parameters
    /// ----------
    /// input : str
    ///     Name of the input; its ``_config`` selects the variables.
    /// pose : Pose
    ///     Pose of the base in the frame of the input.
    /// covariance : array of shape (6, 6), (36,) or (6,)
    ///     Row-major covariance of x, y, z [m] and the rotations about them [rad], as in ROS; (6,) is its diagonal.
    /// time_s : float
    ///     Time [s]; or ``time_ns`` [ns].
    /// world_from_frame : Pose, optional
    ///     Transform of the frame of the input into the world frame.
    ///
    /// Returns False if nothing of it is used, as for the first pose of a differential input.
    #[pyo3(signature = (input, pose, covariance, time_s=None, *, time_ns=None, world_from_frame=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn add_pose(
        &self,
        input: &str,
        pose: &Bound<'_, PyAny>,
        covariance: &Bound<'_, PyAny>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        world_from_frame: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<bool> {
        let reading = PoseReading {
            time_ns: required_time(time_s, time_ns)?,
            frame_from_base: pose_argument(pose, "pose")?,
            covariance: covariance_argument::<36>(covariance, "covariance", 6)?,
            world_from_frame: pose_or_identity(world_from_frame, "world_from_frame")?,
        };
        let mut filter = lock(&self.filter);
        let index = self.index(&filter, input, &[Kind::Odometry, Kind::Pose])?;
        let measurement = filter.intakes[index].pose(&reading);
        filter.push(measurement)
    }

    /// Queues velocities of an input ``odomN`` or ``twistN``.
    ///
    /// Parameters
    /// ----------
    /// input : str
    ///     Name of the input; its ``_config`` selects the variables.
    /// linear, angular : array of shape (3,)
    ///     Velocities in the frame of the sensor [m/s, rad/s].
    /// covariance : array of shape (6, 6), (36,) or (6,)
    ///     Row-major covariance of both, as in ROS; (6,) is its diagonal.
    /// time_s : float
    ///     Time [s]; or ``time_ns`` [ns].
    /// base_from_sensor : Pose, optional
    ///     Pose of the sensor on the robot.
    ///
    /// Returns False if nothing of it is used.
    #[pyo3(signature = (input, linear, angular, covariance, time_s=None, *, time_ns=None, base_from_sensor=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn add_twist(
        &self,
        input: &str,
        linear: &Bound<'_, PyAny>,
        angular: &Bound<'_, PyAny>,
        covariance: &Bound<'_, PyAny>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        base_from_sensor: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<bool> {
        let reading = TwistReading {
            time_ns: required_time(time_s, time_ns)?,
            linear: vector_argument(linear, "linear")?,
            angular: vector_argument(angular, "angular")?,
            covariance: covariance_argument::<36>(covariance, "covariance", 6)?,
            base_from_sensor: pose_or_identity(base_from_sensor, "base_from_sensor")?,
        };
        let mut filter = lock(&self.filter);
        let index = self.index(&filter, input, &[Kind::Odometry, Kind::Twist])?;
        let Filter { ekf, intakes, .. } = &mut *filter;
        let measurement = intakes[index].twist(&reading, ekf.estimate());
        filter.push(measurement)
    }

    /// Queues odometry of an input ``odomN``: a pose and velocities, as in ``nav_msgs/Odometry``. Arguments as for
    /// ``add_pose`` and ``add_twist``.
    #[pyo3(signature = (
        input, pose, pose_covariance, linear, angular, twist_covariance, time_s=None, *, time_ns=None,
        world_from_frame=None, base_from_sensor=None
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn add_odometry(
        &self,
        input: &str,
        pose: &Bound<'_, PyAny>,
        pose_covariance: &Bound<'_, PyAny>,
        linear: &Bound<'_, PyAny>,
        angular: &Bound<'_, PyAny>,
        twist_covariance: &Bound<'_, PyAny>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        world_from_frame: Option<&Bound<'_, PyAny>>,
        base_from_sensor: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<bool> {
        self.index(&lock(&self.filter), input, &[Kind::Odometry])?;
        // Both are read before one is queued.
        vector_argument(linear, "linear")?;
        vector_argument(angular, "angular")?;
        covariance_argument::<36>(twist_covariance, "twist_covariance", 6)?;
        covariance_argument::<36>(pose_covariance, "pose_covariance", 6)?;
        pose_or_identity(base_from_sensor, "base_from_sensor")?;
        let is_pose =
            self.add_pose(input, pose, pose_covariance, time_s, time_ns, world_from_frame)?;
        let is_twist = self.add_twist(
            input,
            linear,
            angular,
            twist_covariance,
            time_s,
            time_ns,
            base_from_sensor,
        )?;
        Ok(is_pose || is_twist)
    }

    /// Queues a reading of an input ``imuN``, as in ``sensor_msgs/Imu``.
    ///
    /// Parameters
    /// ----------
    /// input : str
    ///     Name of the input; its ``_config`` selects the variables.
    /// orientation : array of shape (4,), optional
    ///     Orientation of the sensor in the world frame as quaternion (x, y, z, w).
    /// angular_velocity, linear_acceleration : array of shape (3,), optional
    ///     In the frame of the sensor [rad/s, m/s^2]. Set ``imu0_remove_gravitational_acceleration`` if the
    ///     acceleration has gravity in it.
    /// orientation_covariance, angular_velocity_covariance, linear_acceleration_covariance : array, optional
    ///     Covariance of each, shape (3, 3), (9,) or (3,) for the diagonal. One that begins with -1 marks a missing
    ///     reading, as in ROS.
    /// time_s : float
    ///     Time [s]; or ``time_ns`` [ns].
    /// base_from_sensor : Pose, optional
    ///     Pose of the sensor on the robot.
    ///
    /// Raises ``ValueError`` if ``_config`` selects a reading that is missing.
    #[pyo3(signature = (
        input, orientation=None, orientation_covariance=None, angular_velocity=None,
        angular_velocity_covariance=None, linear_acceleration=None, linear_acceleration_covariance=None,
        time_s=None, *, time_ns=None, base_from_sensor=None
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn add_imu(
        &self,
        input: &str,
        orientation: Option<&Bound<'_, PyAny>>,
        orientation_covariance: Option<&Bound<'_, PyAny>>,
        angular_velocity: Option<&Bound<'_, PyAny>>,
        angular_velocity_covariance: Option<&Bound<'_, PyAny>>,
        linear_acceleration: Option<&Bound<'_, PyAny>>,
        linear_acceleration_covariance: Option<&Bound<'_, PyAny>>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        base_from_sensor: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<bool> {
        let orientation = readings::with_covariance(
            (orientation, "orientation"),
            (orientation_covariance, "orientation_covariance"),
            rotation_argument,
        )?;
        let angular = readings::with_covariance(
            (angular_velocity, "angular_velocity"),
            (angular_velocity_covariance, "angular_velocity_covariance"),
            vector_argument,
        )?;
        let acceleration = readings::with_covariance(
            (linear_acceleration, "linear_acceleration"),
            (linear_acceleration_covariance, "linear_acceleration_covariance"),
            vector_argument,
        )?;
        let reading = ImuReading {
            time_ns: required_time(time_s, time_ns)?,
            world_from_sensor: orientation,
            angular,
            acceleration,
            base_from_sensor: pose_or_identity(base_from_sensor, "base_from_sensor")?,
        };
        let mut filter = lock(&self.filter);
        let index = self.index(&filter, input, &[Kind::Imu])?;
        let mask = filter.intakes[index].source().mask;
        let parts = [
            (3..6, reading.world_from_sensor.is_none(), "orientation"),
            (9..12, reading.angular.is_none(), "angular velocity"),
            (12..15, reading.acceleration.is_none(), "linear acceleration"),
        ];
        for (variables, is_missing, name) in parts {
            if is_missing && mask[variables].contains(&true) {
                return Err(PyValueError::new_err(format!(
                    "`{input}_config` selects the {name}, which is missing"
                )));
            }
        }
        let gravity_mps2 = filter.ekf.settings().gravity_mps2;
        let Filter { ekf, intakes, .. } = &mut *filter;
        let measurements = intakes[index].imu(&reading, ekf.estimate(), gravity_mps2);
        filter.push(measurements)
    }

    /// Queues a measurement of some variables, without an input.
    ///
    /// Parameters
    /// ----------
    /// values : dict of str to float
    ///     Values by the names of ``Ekf.VARIABLES``.
    /// covariance : float or array
    ///     One variance for all, a variance for each in the order of ``values``, or a matrix.
    /// time_s : float
    ///     Time [s]; or ``time_ns`` [ns].
    /// rejection_threshold : float
    ///     Mahalanobis distance from which on the measurement is rejected.
    #[pyo3(signature = (values, covariance, time_s=None, *, time_ns=None, rejection_threshold=f64::INFINITY))]
    fn add_measurement(
        &self,
        values: &Bound<'_, PyDict>,
        covariance: &Bound<'_, PyAny>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        rejection_threshold: f64,
    ) -> PyResult<()> {
        if rejection_threshold.is_nan() || rejection_threshold <= 0.0 {
            return Err(PyValueError::new_err("`rejection_threshold` must be above 0"));
        }
        let mut numbers = Vec::with_capacity(values.len());
        for (name, value) in values {
            let name: String = name.extract()?;
            let value: f64 = value
                .extract()
                .map_err(|_| PyTypeError::new_err(format!("`{name}` must be a number")))?;
            require_finite(&[value], &name)?;
            numbers.push((variable(&name)?, value));
        }
        if numbers.is_empty() {
            return Err(PyValueError::new_err("`values` is empty"));
        }
        let count = numbers.len();
        let variances = readings::covariance_values(covariance, "covariance", count)?;
        let mut measurement = Measurement::of(required_time(time_s, time_ns)?, &numbers, 0.0);
        for (row, (of_row, _)) in numbers.iter().enumerate() {
            for (column, (of_column, _)) in numbers.iter().enumerate() {
                measurement.covariance[(of_row.at(), of_column.at())] =
                    variances[row * count + column];
            }
        }
        measurement.most_deviations = rejection_threshold;
        lock(&self.filter).push([measurement]).map(|_| ())
    }

    /// Uses the queued measurements up to a time, in the order of their times; after ``sensor_timeout`` without one
    /// it predicts the state to this time. Returns True if the estimate has changed.
    ///
    /// Parameters
    /// ----------
    /// time_s : float
    ///     Time [s]; or ``time_ns`` [ns].
    #[pyo3(signature = (time_s=None, *, time_ns=None))]
    fn update(&self, py: Python<'_>, time_s: Option<f64>, time_ns: Option<i64>) -> PyResult<bool> {
        let now_ns = required_time(time_s, time_ns)?;
        with_locked(py, "Ekf.update", &self.filter, |filter| {
            filter.queued_ns.retain(|queued_ns| *queued_ns > now_ns);
            filter.ekf.run_until(now_ns)
        })
    }

    /// Returns the estimate predicted to a time without further measurements, which changes nothing. A time before
    /// the estimate returns the estimate. Raises ``RuntimeError`` before the first measurement.
    #[pyo3(signature = (time_s=None, *, time_ns=None))]
    fn predict(
        &self,
        py: Python<'_>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
    ) -> PyResult<EkfEstimate> {
        let time_ns = required_time(time_s, time_ns)?;
        with_locked(py, "Ekf.predict", &self.filter, |filter| filter.ekf.predicted(time_ns))?
            .map(EkfEstimate)
            .ok_or_else(nothing_yet)
    }

    /// The estimate, or None before the first measurement.
    #[getter]
    fn estimate(&self) -> Option<EkfEstimate> {
        lock(&self.filter).ekf.estimate().cloned().map(EkfEstimate)
    }

    /// Mean of the state, shape (15,); see ``EkfEstimate.state``. Raises ``RuntimeError`` before the first
    /// measurement.
    #[getter]
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.estimate().ok_or_else(nothing_yet).map(|it| it.state(py))
    }

    /// Covariance of the state, shape (15, 15). Raises ``RuntimeError`` before the first measurement.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.estimate().ok_or_else(nothing_yet)?.covariance(py)
    }

    /// Pose of the base in the world frame. Raises ``RuntimeError`` before the first measurement.
    #[getter]
    fn pose(&self) -> PyResult<PyPose> {
        self.estimate().ok_or_else(nothing_yet).map(|it| it.pose())
    }

    /// Sets the estimate and drops queued measurements.
    ///
    /// Parameters
    /// ----------
    /// state : array of shape (15,)
    ///     Mean, see ``EkfEstimate.state``.
    /// covariance : array of shape (15, 15), (225,) or (15,), optional
    ///     Its covariance, or the diagonal; that of ``initial_estimate_covariance`` if not given.
    /// time_s : float
    ///     Time [s]; or ``time_ns`` [ns].
    #[pyo3(signature = (state, covariance=None, time_s=None, *, time_ns=None))]
    fn set_state(
        &self,
        state: &Bound<'_, PyAny>,
        covariance: Option<&Bound<'_, PyAny>>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
    ) -> PyResult<()> {
        let state = input::<f64>(state, "state", &[Some(STATE_DIMENSIONS)])?;
        require_finite(state.as_slice()?, "state")?;
        let covariance = covariance
            .map(|it| covariance_argument::<225>(it, "covariance", STATE_DIMENSIONS))
            .transpose()?;
        let mut filter = lock(&self.filter);
        let estimate = Estimate {
            time_ns: required_time(time_s, time_ns)?,
            state: State::from_row_slice(state.as_slice()?),
            covariance: covariance.map_or(filter.ekf.settings().start_covariance, |it| {
                Covariance::from_row_slice(&it)
            }),
        };
        filter.intakes.iter_mut().for_each(Intake::forget);
        filter.queued_ns.clear();
        filter.ekf.set_estimate(estimate);
        Ok(())
    }

    /// Takes the measurements that were rejected since the last call: a list of dictionaries with ``input``,
    /// ``reason`` (``"too_far"``, ``"invalid"``) and ``mahalanobis_distance`` (None if invalid).
    fn take_rejections<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let refusals = lock(&self.filter).ekf.take_refusals();
        let rows = PyList::empty(py);
        for refusal in refusals {
            let (source, reason, distance) = match refusal {
                Refusal::TooFar { source, deviations } => (source, "too_far", Some(deviations)),
                Refusal::Broken { source } => (source, "invalid", None),
            };
            let row = PyDict::new(py);
            row.set_item("input", source)?;
            row.set_item("reason", reason)?;
            row.set_item("mahalanobis_distance", distance)?;
            rows.append(row)?;
        }
        Ok(rows)
    }

    /// Resets everything except the parameters.
    fn reset(&self) {
        let mut filter = lock(&self.filter);
        filter.ekf.reset();
        filter.intakes.iter_mut().for_each(Intake::forget);
        filter.queued_ns.clear();
    }

    fn __repr__(&self) -> String {
        let inputs = self.inputs().join(", ");
        match self.estimate() {
            Some(estimate) => format!("Ekf(inputs=[{inputs}], estimate={})", estimate.__repr__()),
            None => format!("Ekf(inputs=[{inputs}]) without a measurement"),
        }
    }
}

impl PyEkf {
    /// Index of an input of one of these kinds.
    fn index(&self, filter: &Filter, name: &str, kinds: &[Kind]) -> PyResult<usize> {
        let found = filter.intakes.iter().position(|it| it.source().name == name);
        let Some(index) = found else {
            let known: Vec<&str> =
                filter.intakes.iter().map(|it| it.source().name.as_str()).collect();
            return Err(PyValueError::new_err(if known.is_empty() {
                format!("there is no input `{name}`: give `{name}_config` to the constructor")
            } else {
                format!("there is no input `{name}`; the inputs are {}", known.join(", "))
            }));
        };
        if kinds.contains(&filter.intakes[index].source().kind) {
            return Ok(index);
        }
        Err(PyValueError::new_err(format!("the input `{name}` takes no such readings")))
    }
}

fn nothing_yet() -> PyErr {
    PyRuntimeError::new_err("there is no estimate before the first measurement: call `update`")
}

fn required_time(time_s: Option<f64>, time_ns: Option<i64>) -> PyResult<i64> {
    time_argument(time_s, time_ns)?
        .ok_or_else(|| PyTypeError::new_err("give `time_s` or `time_ns`"))
}

fn pose_or_identity(argument: Option<&Bound<'_, PyAny>>, name: &str) -> PyResult<Pose> {
    argument.map_or(Ok(Pose::IDENTITY), |argument| pose_argument(argument, name))
}
