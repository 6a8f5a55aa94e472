//! Registration of scans with each other.

use numpy::PyUntypedArrayMethods as _;
use periplus::geometry::{Pose, Pose2, normalize_angle};
use periplus::scan_matching::{
    Cloud, CloudSettings, FieldSettings, Fit, Placed, RegisterSettings, ScoreField, Symmetric3,
    Window, register as register_clouds,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{contiguous, moved};
use crate::poses::{PyPose, pose2_argument};
use crate::work::released;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyScanMatch>()?;
    module.add_function(wrap_pyfunction!(scan_match, module)?)?;
    module.add_function(wrap_pyfunction!(scan_search, module)?)
}

/// Result of ``scan_match``.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> line = np.stack([np.full(50, 2.0), np.linspace(-1, 1, 50)], axis=1)
/// >>> match = periplus.scan_match(line, line - [0.05, 0.0])
/// >>> round(match.pose.x, 2), match.matched
/// (0.05, 1.0)
#[pyclass(name = "ScanMatch", module = "periplus", frozen)]
pub(crate) struct PyScanMatch(Fit);

#[pymethods]
impl PyScanMatch {
    /// Pose of the points in the frame of the reference, ``reference_from_points``.
    #[getter]
    fn pose(&self) -> PyPose {
        PyPose(Pose::from(self.0.target_from_moving))
    }

    /// Information matrix over x, y, yaw from the points, float64, shape (3, 3) [1/m^2, 1/(m rad), 1/rad^2]. Errors are
    /// a translation along the axes of the reference and a rotation about the origin of the points.
    #[getter]
    fn information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        matrix(py, self.0.information)
    }

    /// Covariance over x, y, yaw, float64, shape (3, 3) [m^2, m rad, rad^2]; all NaN if the points leave a direction
    /// undetermined, as in a corridor (see ``observability``).
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self.0.information.inverse() {
            Some(covariance) => matrix(py, covariance),
            None => Ok(moved(py, vec![f64::NAN; 9], &[3, 3])?.into_any()),
        }
    }

    /// Fraction of the points with a correspondence, 0 to 1.
    #[getter]
    fn matched(&self) -> f64 {
        self.0.matched
    }

    /// Weighted root mean square distance of matched points from the lines of the reference [m].
    #[getter]
    fn rms_m(&self) -> f64 {
        self.0.rms_m
    }

    /// Robust cost in squared standard deviations: comparable between guesses for the same points.
    #[getter]
    fn cost(&self) -> f64 {
        self.0.cost
    }

    /// 0 if the points leave some direction undetermined, 1 if they determine all.
    #[getter]
    fn observability(&self) -> f64 {
        self.0.firmness
    }

    fn __repr__(&self) -> String {
        let Pose2 { x_m, y_m, yaw_rad } = self.0.target_from_moving;
        format!(
            "ScanMatch(x={x_m:.4}, y={y_m:.4}, yaw={yaw_rad:.4}, matched={:.2}, rms_m={:.4})",
            self.0.matched, self.0.rms_m
        )
    }
}

/// Registers two scans from a good guess: robust point-to-line ICP.
///
/// Parameters
/// ----------
/// reference_points, points : array_like, shape (N, 2) or (N, 3)
///     End points of the beams of each scan [m], in the order of the beams; z is ignored. Beams without a return are
///     NaN or infinite.
/// guess : Pose or (x, y, yaw), optional
///     Initial ``reference_from_points``.
/// origin : (float, float), optional
///     Position of the scanner in the frame of its points [m]; default: the origin.
/// angle_increment : float, optional
///     Angle between beams [rad]; default: the median of the scan.
/// reach_m, scale_m : (float, float), optional
///     Maximum distance of correspondences, and scale of the robust kernel, at the start and at the end [m].
/// steps : int, optional
///     Number of iterations.
/// sigma_m : float, optional
///     Standard deviation of the distance of a point from its line [m].
/// independent, degenerate : float, optional
///     Fraction of the points that count as independent; ratio of the information along the weakest direction to that
///     along the strongest below which the weakest is dropped.
/// spacing_m : float, optional
///     Minimum distance between points that are used [m].
/// max_points : int, optional
///     Maximum number of points that are used.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> angles = np.radians(np.arange(360))
/// >>> directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
/// >>> def scan(x):  # of a room of 6 m by 4 m
/// ...     to_x = (3 * np.sign(directions[:, 0]) - x) / directions[:, 0]
/// ...     to_y = 2 / np.abs(directions[:, 1] + 1e-12)
/// ...     return directions * np.minimum(to_x, to_y)[:, None]
/// >>> round(periplus.scan_match(scan(0.0), scan(0.2)).pose.x, 2)
/// 0.2
#[pyfunction]
#[pyo3(signature = (reference_points, points, guess=None, *, origin=None, angle_increment=None, reach_m=None,
                    scale_m=None, steps=None, sigma_m=None, independent=None, degenerate=None, spacing_m=None,
                    max_points=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn scan_match(
    py: Python<'_>,
    reference_points: &Bound<'_, PyAny>,
    points: &Bound<'_, PyAny>,
    guess: Option<&Bound<'_, PyAny>>,
    origin: Option<[f32; 2]>,
    angle_increment: Option<f64>,
    reach_m: Option<[f64; 2]>,
    scale_m: Option<[f64; 2]>,
    steps: Option<usize>,
    sigma_m: Option<f64>,
    independent: Option<f64>,
    degenerate: Option<f64>,
    spacing_m: Option<f64>,
    max_points: Option<usize>,
) -> PyResult<PyScanMatch> {
    let guess = guess.map_or(Ok(Pose2::IDENTITY), |guess| pose2_argument(guess, "guess"))?;
    let mut settings = RegisterSettings::default();
    let mut cloud_settings = CloudSettings::default();
    for (name, given, pair) in
        [("reach_m", reach_m, &mut settings.reach_m), ("scale_m", scale_m, &mut settings.scale_m)]
    {
        if let Some([first, last]) = given {
            *pair = [positive(name, first)? as f32, positive(name, last)? as f32];
        }
    }
    for (name, given, value) in [
        ("sigma_m", sigma_m, &mut settings.sigma_m),
        ("independent", independent, &mut settings.independent),
        ("degenerate", degenerate, &mut settings.degenerate),
    ] {
        if let Some(given) = given {
            *value = positive(name, given)?;
        }
    }
    if let Some(spacing_m) = spacing_m {
        cloud_settings.spacing_m = positive("spacing_m", spacing_m)? as f32;
    }
    settings.steps = steps.unwrap_or(settings.steps).clamp(1, 10_000);
    cloud_settings.most_points = max_points.unwrap_or(cloud_settings.most_points);
    let origin = origin.unwrap_or_default();
    if !origin.iter().all(|value| value.is_finite()) {
        return Err(PyValueError::new_err("`origin` must be finite"));
    }
    if let Some(angle) = angle_increment
        && !(angle.is_finite() && angle != 0.0)
    {
        return Err(PyValueError::new_err("`angle_increment` must be finite and not 0"));
    }
    let reference = beams(reference_points, "reference_points")?;
    let moving = beams(points, "points")?;
    let fit = released(py, "scan matching", || {
        let cloud = |beams: Vec<Option<[f32; 2]>>| {
            let step_rad = angle_increment.unwrap_or_else(|| usual_step_rad(&beams, origin));
            Cloud::new(beams, origin, step_rad as f32, &cloud_settings)
        };
        let (reference, moving) = (cloud(reference), cloud(moving));
        register_clouds(
            &[Placed::alone(&moving)],
            &[Placed::alone(&reference)],
            guess,
            None,
            &settings,
        )
    })?;
    Ok(PyScanMatch(fit))
}

/// Finds the best pose of a scan in a window with certainty, without a good guess: correlative scan matching by branch
/// and bound.
///
/// Parameters
/// ----------
/// reference_points, points : array_like, shape (N, 2) or (N, 3)
///     Points of each scan or map [m], in any order; z is ignored, points that are NaN or infinite as well.
/// guess : Pose or (x, y, yaw), optional
///     Centre of the window, ``reference_from_points``.
/// half_m : (float, float)
///     Half widths of the window along x and y [m].
/// half_rad : float
///     Half width of the window in yaw [rad].
/// step_rad : float, optional
///     Step of the yaw [rad]; default: one cell at the farthest point.
/// min_score : float
///     Minimum mean likelihood of the points, 0 to 1.
/// resolution_m, sigma_m : float, optional
///     Cell size of the likelihood field, and standard deviation of the distance between corresponding points [m].
///
/// Returns the pose and its score, 0 to 1, or None if no pose reaches ``min_score``. The pose is exact to a cell:
/// refine it with ``scan_match``. Sources: Olson, "Real-time correlative scan matching", 2009; Hess et al., "Real-time
/// loop closure in 2D LIDAR SLAM", 2016.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> corner = np.array([[x, 0.0] for x in np.arange(0, 4, 0.05)] + [[0.0, y] for y in np.arange(0, 2, 0.05)])
/// >>> pose, score = periplus.scan_search(corner, corner - [0.8, -0.4], half_m=(1.0, 1.0), half_rad=0.2)
/// >>> abs(pose.x - 0.8) < 0.1, abs(pose.y + 0.4) < 0.1, score > 0.8
/// (True, True, True)
#[pyfunction]
#[pyo3(signature = (reference_points, points, guess=None, *, half_m, half_rad, step_rad=None, min_score=0.3,
                    resolution_m=None, sigma_m=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn scan_search(
    py: Python<'_>,
    reference_points: &Bound<'_, PyAny>,
    points: &Bound<'_, PyAny>,
    guess: Option<&Bound<'_, PyAny>>,
    half_m: [f64; 2],
    half_rad: f64,
    step_rad: Option<f64>,
    min_score: f64,
    resolution_m: Option<f64>,
    sigma_m: Option<f64>,
) -> PyResult<Option<(PyPose, f64)>> {
    let middle = guess.map_or(Ok(Pose2::IDENTITY), |guess| pose2_argument(guess, "guess"))?;
    let mut field_settings = FieldSettings::default();
    if let Some(resolution_m) = resolution_m {
        field_settings.resolution_m = positive("resolution_m", resolution_m)? as f32;
    }
    if let Some(sigma_m) = sigma_m {
        field_settings.sigma_m = positive("sigma_m", sigma_m)? as f32;
    }
    let half_m = [not_negative("half_m", half_m[0])?, not_negative("half_m", half_m[1])?];
    let half_rad = not_negative("half_rad", half_rad)?.min(std::f64::consts::PI);
    if !(0.0..=1.0).contains(&min_score) {
        return Err(PyValueError::new_err("`min_score` must be from 0 to 1"));
    }
    let present = |argument, name| -> PyResult<Vec<[f32; 2]>> {
        Ok(beams(argument, name)?.into_iter().flatten().collect())
    };
    let reference = present(reference_points, "reference_points")?;
    let points = present(points, "points")?;
    let reach = |points: &[[f32; 2]], x_m: f64, y_m: f64| {
        let from = |[x, y]: &[f32; 2]| libm::hypot(f64::from(*x) - x_m, f64::from(*y) - y_m);
        points.iter().map(from).fold(0.0, f64::max)
    };
    let reach_m = reach(&points, 0.0, 0.0);
    let cell_m = f64::from(field_settings.resolution_m);
    let window_m = half_m[0].max(half_m[1]) + reach_m;
    if window_m / cell_m > MAX_HALF_CELLS {
        return Err(PyValueError::new_err(format!(
            "the window and the points reach {window_m:.1} m, more than {MAX_HALF_CELLS} cells of {cell_m} m"
        )));
    }
    // All of the reference that a point can meet.
    let around_m = reach(&reference, middle.x_m, middle.y_m).min(window_m) + 1.0;
    field_settings.most_half_m = around_m as f32;
    let step_rad = match step_rad {
        Some(step_rad) => positive("step_rad", step_rad)?,
        None => (cell_m / reach_m.max(cell_m)).min(0.2),
    };
    let headings = (2.0 * half_rad / step_rad).min(8000.0) + 1.0;
    if headings * points.len() as f64 > MAX_WORK_COUNT {
        return Err(PyValueError::new_err(format!(
            "{} points at {headings:.0} headings are too many; raise `step_rad` or thin the points",
            points.len()
        )));
    }
    let window = Window { middle, half_m, half_rad, step_rad };
    let found = released(py, "the search", || {
        let middle = [middle.x_m as f32, middle.y_m as f32];
        let field = ScoreField::new(&reference, middle, &field_settings);
        field.search(&points, &window, min_score, None).0
    })?;
    Ok(found.map(|peak| (PyPose(Pose::from(peak.pose)), peak.score)))
}

/// Largest distance of a window and its points from the guess, in cells: the limit of the search is 16384.
const MAX_HALF_CELLS: f64 = 2500.0;
/// Largest number of points times headings: their cells fill 800 MB.
const MAX_WORK_COUNT: f64 = 1e8;

fn positive(name: &str, value: f64) -> PyResult<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(PyValueError::new_err(format!("`{name}` must be finite and above 0, not {value}")))
}

fn not_negative(name: &str, value: f64) -> PyResult<f64> {
    if value.is_finite() && value >= 0.0 {
        return Ok(value);
    }
    Err(PyValueError::new_err(format!("`{name}` must be finite and at least 0, not {value}")))
}

/// End points of beams; none without a return.
fn beams(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Option<[f32; 2]>>> {
    let array = contiguous::<f64>(argument, name)?;
    let [_, axes @ (2 | 3)] = array.shape() else {
        return Err(PyValueError::new_err(format!(
            "`{name}` must have the shape (N, 2) or (N, 3), not {:?}",
            array.shape()
        )));
    };
    if array.shape()[0] > MAX_BEAM_COUNT {
        return Err(PyValueError::new_err(format!(
            "`{name}` has more than {MAX_BEAM_COUNT} points"
        )));
    }
    let point = |row: &[f64]| {
        let [x, y] = [row[0] as f32, row[1] as f32];
        (x.abs() < MAX_RANGE_M && y.abs() < MAX_RANGE_M).then_some([x, y])
    };
    Ok(array.as_slice()?.chunks_exact(*axes).map(point).collect())
}

/// Largest scan.
const MAX_BEAM_COUNT: usize = 1 << 24;
/// Largest coordinate of a point; farther ones count as no return.
const MAX_RANGE_M: f32 = 1e6;

/// Median angle between the bearings of consecutive beams, negative for clockwise scans.
fn usual_step_rad(beams: &[Option<[f32; 2]>], origin: [f32; 2]) -> f64 {
    let bearing = |point: [f32; 2]| {
        libm::atan2(f64::from(point[1] - origin[1]), f64::from(point[0] - origin[0]))
    };
    let mut steps: Vec<f64> = beams
        .windows(2)
        .filter_map(|pair| Some(normalize_angle(bearing(pair[1]?) - bearing(pair[0]?))))
        .collect();
    if steps.is_empty() {
        return std::f64::consts::TAU / 360.0;
    }
    steps.sort_by(f64::total_cmp);
    steps[steps.len() / 2]
}

fn matrix(py: Python<'_>, of: Symmetric3) -> PyResult<Bound<'_, PyAny>> {
    let Symmetric3 { xx, xy, xt, yy, yt, tt } = of;
    Ok(moved(py, vec![xx, xy, xt, xy, yy, yt, xt, yt, tt], &[3, 3])?.into_any())
}
