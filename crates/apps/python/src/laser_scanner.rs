//! Laser scanners, and scans as arrays or messages.

use numpy::PyUntypedArrayMethods as _;
use periplus::geometry::{LaserScan2, Pose, Pose2, ScannerMounting};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{input, require_finite};
use crate::poses::{PyPose, pose_argument, pose2_argument};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<LaserScanner>()
}

/// Largest deviation of an angle from even spacing, as a fraction of the increment.
const MAX_SPACING_ERROR_RATIO: f64 = 0.05;

/// Beams and mounting of a planar laser scanner. Immutable.
///
/// Parameters
/// ----------
/// angle_min : float
///     Angle of the first beam in the frame of the scanner [rad].
/// angle_increment : float
///     Angle between beams [rad]; may be negative.
/// range_min, range_max : float
///     Shorter readings are invalid; readings at or above the maximum hit nothing [m].
/// time_increment : float
///     Time between beams [s]; 0 if all are measured at once.
/// base_from_laser : Pose
///     Pose of the scanner on the robot; also (x, y, yaw). A z axis that points down stands for a scanner that is
///     mounted upside down.
///
/// The names are those of ``sensor_msgs/LaserScan``. Raises ``ValueError`` for values that are not finite, except an
/// infinite ``range_max``.
///
/// >>> import math
/// >>> from periplus import LaserScanner
/// >>> scanner = LaserScanner(-math.pi, math.radians(1), range_max=12.0, base_from_laser=(0.2, 0.0, 0.0))
/// >>> scanner.base_from_laser.x
/// 0.2
#[pyclass(frozen, module = "periplus", eq)]
#[derive(PartialEq)]
pub(crate) struct LaserScanner {
    angle_min_rad: f64,
    angle_increment_rad: f64,
    range_min_m: f64,
    range_max_m: f64,
    time_increment_s: f64,
    base_from_laser: Pose,
    mounting: ScannerMounting,
}

#[pymethods]
impl LaserScanner {
    #[new]
    #[pyo3(signature = (
        angle_min, angle_increment, *, range_min=0.0, range_max=f64::INFINITY, time_increment=0.0, base_from_laser=None
    ))]
    fn new(
        angle_min: f64,
        angle_increment: f64,
        range_min: f64,
        range_max: f64,
        time_increment: f64,
        base_from_laser: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let numbers = [
            ("angle_min", angle_min),
            ("angle_increment", angle_increment),
            ("range_min", range_min),
            ("time_increment", time_increment),
        ];
        for (name, number) in numbers {
            require_finite(&[number], name)?;
        }
        if angle_increment == 0.0 {
            return Err(PyValueError::new_err("`angle_increment` must not be 0"));
        }
        if range_min < 0.0 || range_max.is_nan() || range_max <= range_min {
            return Err(PyValueError::new_err(format!(
                "`range_min` must be from 0 and below `range_max`, not {range_min} and {range_max}"
            )));
        }
        let (pose, mounting) = mounting(base_from_laser)?;
        Ok(Self {
            angle_min_rad: angle_min,
            angle_increment_rad: angle_increment,
            range_min_m: range_min,
            range_max_m: range_max,
            time_increment_s: time_increment,
            base_from_laser: pose,
            mounting,
        })
    }

    /// Scanner from the angles of its beams, shape (N,) with N at least 2 [rad]. Other parameters as for the class.
    /// Raises ``ValueError`` if the angles are not evenly spaced.
    ///
    /// >>> import numpy as np
    /// >>> from periplus import LaserScanner
    /// >>> LaserScanner.from_angles(np.linspace(-1.0, 1.0, 5)).angle_increment
    /// 0.5
    #[staticmethod]
    #[pyo3(signature = (
        angles, *, range_min=0.0, range_max=f64::INFINITY, time_increment=0.0, base_from_laser=None
    ))]
    fn from_angles(
        angles: &Bound<'_, PyAny>,
        range_min: f64,
        range_max: f64,
        time_increment: f64,
        base_from_laser: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let angles = input::<f64>(angles, "angles", &[None])?;
        let angles = angles.as_slice()?;
        require_finite(angles, "angles")?;
        let [first, .., last] = *angles else {
            return Err(PyValueError::new_err("`angles` must have at least 2 values"));
        };
        let increment = (last - first) / (angles.len() - 1) as f64;
        for (index, angle) in angles.iter().enumerate() {
            let expected = first + index as f64 * increment;
            if (angle - expected).abs() > MAX_SPACING_ERROR_RATIO * increment.abs() {
                return Err(PyValueError::new_err(format!(
                    "`angles` must be evenly spaced: angle {index} is {angle}, not {expected}"
                )));
            }
        }
        Self::new(first, increment, range_min, range_max, time_increment, base_from_laser)
    }

    /// Scanner of a ``sensor_msgs/LaserScan`` message, or of any object with its fields.
    #[staticmethod]
    #[pyo3(signature = (message, base_from_laser=None))]
    fn from_message(
        message: &Bound<'_, PyAny>,
        base_from_laser: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (base_from_laser, mounting) = mounting(base_from_laser)?;
        Self::of_message(message, base_from_laser, mounting)
    }

    /// Angle of the first beam [rad].
    #[getter]
    fn angle_min(&self) -> f64 {
        self.angle_min_rad
    }

    /// Angle between beams [rad].
    #[getter]
    fn angle_increment(&self) -> f64 {
        self.angle_increment_rad
    }

    /// Minimum range [m].
    #[getter]
    fn range_min(&self) -> f64 {
        self.range_min_m
    }

    /// Maximum range [m].
    #[getter]
    fn range_max(&self) -> f64 {
        self.range_max_m
    }

    /// Time between beams [s].
    #[getter]
    fn time_increment(&self) -> f64 {
        self.time_increment_s
    }

    /// Pose of the scanner on the robot.
    #[getter]
    fn base_from_laser(&self) -> PyPose {
        PyPose(self.base_from_laser)
    }

    fn __repr__(&self) -> String {
        format!(
            "LaserScanner(angle_min={:?}, angle_increment={:?}, range_min={:?}, range_max={:?}, time_increment={:?}, \
             base_from_laser={})",
            self.angle_min_rad,
            self.angle_increment_rad,
            self.range_min_m,
            self.range_max_m,
            self.time_increment_s,
            PyPose(self.base_from_laser).__repr__(),
        )
    }
}

/// Pose of a scanner and its projection. (x, y, yaw) keeps all digits of its yaw.
fn mounting(base_from_laser: Option<&Bound<'_, PyAny>>) -> PyResult<(Pose, ScannerMounting)> {
    let Some(argument) = base_from_laser else {
        return Ok((Pose::IDENTITY, ScannerMounting::upright(Pose2::IDENTITY)));
    };
    let pose = pose_argument(argument, "base_from_laser")?;
    let mounting = match argument.extract::<[f64; 3]>() {
        Ok(_) => ScannerMounting::upright(pose2_argument(argument, "base_from_laser")?),
        Err(_) => ScannerMounting::from(pose),
    };
    Ok((pose, mounting))
}

impl LaserScanner {
    fn of_message(
        message: &Bound<'_, PyAny>,
        base_from_laser: Pose,
        mounting: ScannerMounting,
    ) -> PyResult<Self> {
        let number = |name: &str| message.getattr(name)?.extract::<f64>();
        let beams = Self::new(
            number("angle_min")?,
            number("angle_increment")?,
            number("range_min")?.max(0.0),
            number("range_max")?,
            number("time_increment")?,
            None,
        )?;
        Ok(Self { base_from_laser, mounting, ..beams })
    }

    fn scan(&self, time_ns: i64, ranges_m: Vec<f32>) -> LaserScan2 {
        LaserScan2 {
            time_ns,
            mounting: self.mounting,
            angle_min_rad: self.angle_min_rad,
            angle_increment_rad: self.angle_increment_rad,
            time_increment_s: self.time_increment_s,
            range_min_m: self.range_min_m as f32,
            range_max_m: self.range_max_m as f32,
            ranges_m,
        }
    }

    /// Scans that are the rows of an array of shape (N, B).
    pub(crate) fn scans(
        &self,
        ranges: &Bound<'_, PyAny>,
        times_ns: &[i64],
    ) -> PyResult<Vec<LaserScan2>> {
        let array = input::<f32>(ranges, "ranges", &[None, None])?;
        let (count, beams) = (array.shape()[0], array.shape()[1]);
        if count != times_ns.len() {
            return Err(PyValueError::new_err(format!(
                "there are {count} scans and {} times",
                times_ns.len()
            )));
        }
        if beams == 0 {
            return Err(PyValueError::new_err("`ranges` has no beams"));
        }
        let rows = array.as_slice()?.chunks_exact(beams);
        Ok(rows.zip(times_ns).map(|(row, time_ns)| self.scan(*time_ns, row.to_vec())).collect())
    }
}

/// Scan from an array of ranges, with the scanner of this call or of the object; or from a `LaserScan` message,
/// which has its beams and, unless one is given, its time with it.
///
/// # Errors
/// `TypeError` or `ValueError` that names the argument.
pub(crate) fn scan_argument(
    scan: &Bound<'_, PyAny>,
    scanner: Option<&LaserScanner>,
    time_ns: Option<i64>,
) -> PyResult<LaserScan2> {
    if scan.hasattr("angle_min")? && scan.hasattr("ranges")? {
        let upright = ScannerMounting::upright(Pose2::IDENTITY);
        let (pose, mounting) =
            scanner.map_or((Pose::IDENTITY, upright), |it| (it.base_from_laser, it.mounting));
        let scanner = LaserScanner::of_message(scan, pose, mounting)?;
        let time_ns = time_ns.map_or_else(|| message_time(scan), Ok)?;
        return Ok(scanner.scan(time_ns, ranges(&scan.getattr("ranges")?)?));
    }
    let ranges_m = ranges(scan)?;
    let scanner = scanner.ok_or_else(|| {
        PyTypeError::new_err(
            "give `scanner=LaserScanner(...)` here or to the constructor: an array has no angles",
        )
    })?;
    let time_ns = time_ns.ok_or_else(|| PyTypeError::new_err("give `time_s` or `time_ns`"))?;
    Ok(scanner.scan(time_ns, ranges_m))
}

fn ranges(argument: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let ranges = input::<f32>(argument, "ranges", &[None])?;
    if ranges.is_empty() {
        return Err(PyValueError::new_err("`ranges` has no beams"));
    }
    Ok(ranges.as_slice()?.to_vec())
}

/// Stamp of a message \[ns\], or time of a reading.
fn message_time(message: &Bound<'_, PyAny>) -> PyResult<i64> {
    if message.hasattr("time_ns")? {
        return message.getattr("time_ns")?.extract();
    }
    let stamp = message.getattr("header")?.getattr("stamp")?;
    let (seconds, rest_ns): (i64, i64) =
        (stamp.getattr("sec")?.extract()?, stamp.getattr("nanosec")?.extract()?);
    Ok(seconds.saturating_mul(1_000_000_000).saturating_add(rest_ns))
}
