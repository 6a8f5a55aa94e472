//! Poses.

use numpy::{PyArray1, PyArray2};
use periplus::geometry::{DQuat, DVec3, Pose, Pose2, Rpy};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{input, moved};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPose>()
}

/// Position and orientation of one frame in another. Immutable.
///
/// Parameters
/// ----------
/// x, y, z : float
///     Position [m].
/// roll, pitch, yaw : float
///     Fixed-axis angles [rad]: first roll about x, then pitch about y, then yaw about z (REP 103, as URDF).
///
/// The product ``a_from_b * b_from_c`` is ``a_from_c``. Raises ``ValueError`` if a value is not finite.
///
/// >>> from periplus import Pose
/// >>> odom_from_base = Pose(1.0, 2.0, yaw=0.5)
/// >>> base_from_lidar = Pose(0.2, 0.0, 0.1)
/// >>> round((odom_from_base * base_from_lidar).x, 3)
/// 1.176
#[pyclass(name = "Pose", module = "periplus", frozen, eq)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct PyPose(pub(crate) Pose);

#[pymethods]
impl PyPose {
    #[new]
    #[pyo3(signature = (x=0.0, y=0.0, z=0.0, roll=0.0, pitch=0.0, yaw=0.0))]
    fn new(x: f64, y: f64, z: f64, roll: f64, pitch: f64, yaw: f64) -> PyResult<Self> {
        finite(Pose::from_xyz_rpy([x, y, z], Rpy { roll, pitch, yaw }))
    }

    /// Pose from a position [m] and a quaternion (x, y, z, w), which is normalized. Raises ``ValueError`` for a
    /// quaternion of length zero.
    ///
    /// >>> from periplus import Pose
    /// >>> Pose.from_quaternion([0, 0, 1], [0, 0, 0, 2]).z
    /// 1.0
    #[staticmethod]
    fn from_quaternion(
        position: &Bound<'_, PyAny>,
        quaternion: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let position = input::<f64>(position, "position", &[Some(3)])?;
        let quaternion = input::<f64>(quaternion, "quaternion", &[Some(4)])?;
        let (p, q) = (position.as_slice()?, quaternion.as_slice()?);
        let rotation = DQuat::from_xyzw(q[0], q[1], q[2], q[3]);
        let length = rotation.length();
        if !length.is_finite() || length < 1e-9 {
            return Err(PyValueError::new_err("`quaternion` has no direction"));
        }
        finite(Pose::from_xyz_quaternion([p[0], p[1], p[2]], rotation.normalize()))
    }

    /// x [m].
    #[getter]
    fn x(&self) -> f64 {
        self.0.translation.x
    }

    /// y [m].
    #[getter]
    fn y(&self) -> f64 {
        self.0.translation.y
    }

    /// z [m].
    #[getter]
    fn z(&self) -> f64 {
        self.0.translation.z
    }

    /// Roll [rad].
    #[getter]
    fn roll(&self) -> f64 {
        self.0.rpy().roll
    }

    /// Pitch [rad].
    #[getter]
    fn pitch(&self) -> f64 {
        self.0.rpy().pitch
    }

    /// Yaw [rad].
    #[getter]
    fn yaw(&self) -> f64 {
        self.0.rpy().yaw
    }

    /// Position [m], shape (3,).
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.translation.to_array())
    }

    /// Orientation as quaternion (x, y, z, w), shape (4,).
    #[getter]
    fn quaternion<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.rotation.to_array())
    }

    /// Homogeneous transform, shape (4, 4).
    #[getter]
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.0.rotation * axis);
        let offset = self.0.translation;
        let row = |of: fn(DVec3) -> f64| [of(axes[0]), of(axes[1]), of(axes[2]), of(offset)];
        let rows = [row(|it| it.x), row(|it| it.y), row(|it| it.z), [0.0, 0.0, 0.0, 1.0]];
        Ok(moved(py, rows.concat(), &[4, 4])?.into_any())
    }

    /// The inverse: ``b_from_a`` of ``a_from_b``.
    fn inverse(&self) -> Self {
        Self(self.0.inverse())
    }

    /// Transforms points of shape (N, 3) or (3,) from frame b to frame a; returns the same shape.
    ///
    /// >>> from periplus import Pose
    /// >>> Pose(1.0).transform([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]]).tolist()
    /// [[1.0, 0.0, 0.0], [2.0, 2.0, 3.0]]
    fn transform<'py>(&self, points: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = points.py();
        let array = crate::arrays::contiguous::<f64>(points, "points")?;
        let shape = numpy::PyUntypedArrayMethods::shape(&*array).to_vec();
        if shape.is_empty() || shape.len() > 2 || shape.last() != Some(&3) {
            return Err(PyValueError::new_err(format!(
                "`points` must have the shape (N, 3) or (3,), not {shape:?}"
            )));
        }
        let moved_points: Vec<f64> = array
            .as_slice()?
            .chunks_exact(3)
            .flat_map(|point| {
                self.0.transform_point(DVec3::new(point[0], point[1], point[2])).to_array()
            })
            .collect();
        Ok(moved(py, moved_points, &shape)?.into_any())
    }

    fn __mul__(&self, other: &Self) -> Self {
        Self(self.0 * other.0)
    }

    fn __hash__(&self) -> u64 {
        let values = self.0.translation.to_array().into_iter().chain(self.0.rotation.to_array());
        values.fold(0, |hash, value| hash.rotate_left(7) ^ (value + 0.0).to_bits())
    }

    pub(crate) fn __repr__(&self) -> String {
        let (p, r) = (self.0.translation, self.0.rpy());
        format!(
            "Pose(x={:?}, y={:?}, z={:?}, roll={:?}, pitch={:?}, yaw={:?})",
            p.x, p.y, p.z, r.roll, r.pitch, r.yaw
        )
    }

    fn __getnewargs__(&self) -> (f64, f64, f64, f64, f64, f64) {
        let (p, r) = (self.0.translation, self.0.rpy());
        (p.x, p.y, p.z, r.roll, r.pitch, r.yaw)
    }
}

fn finite(pose: Pose) -> PyResult<PyPose> {
    if pose.is_finite() {
        Ok(PyPose(pose))
    } else {
        Err(PyValueError::new_err("a pose must be finite"))
    }
}

/// Argument that is a pose in space: a `Pose`, (x, y, yaw) or (x, y, z, roll, pitch, yaw).
pub(crate) fn pose_argument(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<Pose> {
    if let Ok(pose) = argument.cast::<PyPose>() {
        return Ok(pose.get().0);
    }
    let values: Vec<f64> = argument.extract().map_err(|_| wrong(name))?;
    let pose = match values[..] {
        [x, y, yaw] => Pose::from_xyz_rpy([x, y, 0.0], Rpy { roll: 0.0, pitch: 0.0, yaw }),
        [x, y, z, roll, pitch, yaw] => Pose::from_xyz_rpy([x, y, z], Rpy { roll, pitch, yaw }),
        _ => return Err(wrong(name)),
    };
    Ok(finite(pose)?.0)
}

/// Argument that is a planar pose: a `Pose`, or (x, y, yaw), whose yaw keeps all its digits.
pub(crate) fn pose2_argument(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<Pose2> {
    if let Ok([x_m, y_m, yaw_rad]) = argument.extract::<[f64; 3]>() {
        let pose = Pose2::new(x_m, y_m, yaw_rad);
        finite(Pose::from(pose))?;
        return Ok(pose);
    }
    Ok(Pose2::from(pose_argument(argument, name)?))
}

fn wrong(name: &str) -> PyErr {
    PyTypeError::new_err(format!(
        "`{name}` must be a periplus.Pose, (x, y, yaw), or (x, y, z, roll, pitch, yaw)"
    ))
}

/// Planar poses as an array of shape (N, 3): x [m], y [m], yaw [rad].
pub(crate) fn poses2_array<'py>(
    py: Python<'py>,
    poses: &[Pose2],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    use numpy::PyArrayMethods as _;
    let values: Vec<f64> =
        poses.iter().flat_map(|pose| [pose.x_m, pose.y_m, pose.yaw_rad]).collect();
    PyArray1::from_vec(py, values).reshape([poses.len(), 3])
}
