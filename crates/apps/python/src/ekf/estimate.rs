//! Estimated states.

use numpy::PyArray1;
use periplus::ekf::{Estimate, STATE_DIMENSIONS, Variable};
use pyo3::prelude::*;

use crate::arrays::moved;
use crate::poses::PyPose;
use crate::transforms::seconds;

/// State estimated by an ``Ekf`` at a time.
///
/// >>> from periplus import Ekf
/// >>> ekf = Ekf()
/// >>> ekf.add_measurement({"x": 1.5, "yaw": 0.0}, 0.01, time_s=0.0)
/// >>> ekf.update(0.0)
/// True
/// >>> ekf.estimate.pose.x
/// 1.5
#[pyclass(frozen, module = "periplus")]
pub(crate) struct EkfEstimate(pub(super) Estimate);

#[pymethods]
impl EkfEstimate {
    /// Time of the estimate [s].
    #[getter]
    fn time_s(&self) -> f64 {
        seconds(self.0.time_ns)
    }

    /// Time of the estimate [ns].
    #[getter]
    fn time_ns(&self) -> i64 {
        self.0.time_ns
    }

    /// Mean of the variables ``Ekf.VARIABLES``, shape (15,): x, y, z [m], roll, pitch, yaw [rad] in the world frame;
    /// vx, vy, vz [m/s], vroll, vpitch, vyaw [rad/s], ax, ay, az [m/s^2] in the base frame.
    #[getter]
    pub(super) fn state<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.0.state.as_slice())
    }

    /// Covariance of the state, shape (15, 15).
    #[getter]
    pub(super) fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        square(py, self.0.covariance.transpose().as_slice().to_vec(), STATE_DIMENSIONS)
    }

    /// Pose of the base in the world frame.
    #[getter]
    pub(super) fn pose(&self) -> PyPose {
        PyPose(self.0.world_from_base())
    }

    /// Linear velocity in the base frame, shape (3,) [m/s].
    #[getter]
    fn linear_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.twist().0.to_array())
    }

    /// Angular velocity in the base frame, shape (3,) [rad/s].
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.twist().1.to_array())
    }

    /// Linear acceleration in the base frame, shape (3,) [m/s^2].
    #[getter]
    fn acceleration<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.acceleration().to_array())
    }

    /// Covariance of x, y, z, roll, pitch, yaw, shape (6, 6), as in ``geometry_msgs/PoseWithCovariance``.
    #[getter]
    fn pose_covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        square(py, self.0.covariance_of(Variable::X).to_vec(), 6)
    }

    /// Covariance of the velocities, shape (6, 6), as in ``geometry_msgs/TwistWithCovariance``.
    #[getter]
    fn twist_covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        square(py, self.0.covariance_of(Variable::Vx).to_vec(), 6)
    }

    pub(super) fn __repr__(&self) -> String {
        format!("EkfEstimate(time_s={:?}, pose={})", self.time_s(), self.pose().__repr__())
    }
}

fn square(py: Python<'_>, values: Vec<f64>, size: usize) -> PyResult<Bound<'_, PyAny>> {
    Ok(moved(py, values, &[size, size])?.into_any())
}
