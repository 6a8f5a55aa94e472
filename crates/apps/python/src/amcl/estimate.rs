//! Estimates of the filter.

use periplus::geometry::Pose2;
use periplus::localization::{AmclUpdate, Covariance2, LocalizationState, LocalizationStatus};
use pyo3::prelude::*;

use crate::arrays::moved;
use crate::poses::PyPose;

/// Indices of x, y and yaw among x, y, z, roll, pitch, yaw.
pub(super) const PLANAR: [usize; 3] = [0, 1, 5];

/// Localization of a robot on a map, after a scan.
///
/// >>> from periplus import Amcl
/// >>> amcl = Amcl()
/// >>> amcl.estimate.state, amcl.estimate.pose
/// ('unset', None)
#[pyclass(frozen, module = "periplus")]
pub(crate) struct AmclEstimate {
    pub(super) map_from_base: Option<Pose2>,
    pub(super) map_from_odom: Option<Pose2>,
    pub(super) covariance: Option<Covariance2>,
    pub(super) has_pose: bool,
    pub(super) status: LocalizationStatus,
    pub(super) update: Option<AmclUpdate>,
}

#[pymethods]
impl AmclEstimate {
    /// Pose of the robot in the map: that of the last update moved by odometry since. None before the first update
    /// of the filter. Before ``has_pose`` it is one hypothesis among others.
    #[getter]
    fn pose(&self) -> Option<PyPose> {
        self.map_from_base.map(|it| PyPose(it.into()))
    }

    /// Correction of odometry, or None before the first update.
    #[getter]
    fn map_from_odom(&self) -> Option<PyPose> {
        self.map_from_odom.map(|it| PyPose(it.into()))
    }

    /// Covariance of x, y [m] and yaw [rad] at the last update, shape (3, 3), or None.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(rows) = self.covariance.map(Covariance2::to_rows) else { return Ok(None) };
        let planar =
            PLANAR.iter().flat_map(|row| PLANAR.iter().map(move |column| rows[row * 6 + column]));
        Ok(Some(moved(py, planar.collect::<Vec<f64>>(), &[3, 3])?.into_any()))
    }

    /// Covariance of x, y, z, roll, pitch, yaw, shape (6, 6), as in ``geometry_msgs/PoseWithCovariance``, or None.
    #[getter]
    fn pose_covariance<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let rows = self.covariance.map(Covariance2::to_rows);
        rows.map(|rows| Ok(moved(py, rows.to_vec(), &[6, 6])?.into_any())).transpose()
    }

    /// Confidence: ``"unset"`` (no initial pose, or no scan since), ``"tracking"`` (the pose is known),
    /// ``"ambiguous"`` (several poses are possible, or the covariance is large) or ``"lost"`` (scans contradict it).
    #[getter]
    fn state(&self) -> &'static str {
        state_word(self.status.state)
    }

    /// Reason of the state, as a sentence.
    #[getter]
    fn reason(&self) -> &str {
        &self.status.reason
    }

    /// True once an initial pose was set or global localization converged.
    #[getter]
    fn has_pose(&self) -> bool {
        self.has_pose
    }

    /// Fraction of the hits of the last scan at walls of the map, or None without hits.
    #[getter]
    fn inlier_ratio(&self) -> Option<f64> {
        self.status.inlier_ratio
    }

    /// Other poses that are possible, most likely first, shape (K, 4): x, y [m], yaw [rad], weight.
    #[getter]
    fn hypotheses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let hypotheses = &self.status.hypotheses;
        let rows: Vec<f64> = hypotheses
            .iter()
            .flat_map(|it| [it.mean.x_m, it.mean.y_m, it.mean.yaw_rad, it.weight])
            .collect();
        Ok(moved(py, rows, &[hypotheses.len(), 4])?.into_any())
    }

    /// True if this scan updated the filter; False if the robot hardly moved since the last update, or while global
    /// localization runs.
    #[getter]
    fn is_updated(&self) -> bool {
        self.update.is_some()
    }

    /// True if the particles were resampled.
    #[getter]
    fn is_resampled(&self) -> bool {
        self.update.as_ref().is_some_and(|it| it.is_resampled)
    }

    /// Mean likelihood of the scan over the particles, or None without an update.
    #[getter]
    fn likelihood(&self) -> Option<f64> {
        self.update.as_ref().map(|it| it.likelihood)
    }

    /// Probability with which particles were drawn from the whole map, or None without an update.
    #[getter]
    fn random_fraction(&self) -> Option<f64> {
        self.update.as_ref().map(|it| it.random_fraction)
    }

    fn __repr__(&self) -> String {
        let pose = self.map_from_base.map_or_else(
            || "None".to_owned(),
            |it| format!("({:?}, {:?}, {:?})", it.x_m, it.y_m, it.yaw_rad),
        );
        format!(
            "AmclEstimate(state={:?}, pose={pose}, reason={:?})",
            self.state(),
            self.status.reason
        )
    }
}

pub(super) const fn state_word(state: LocalizationState) -> &'static str {
    match state {
        LocalizationState::Unset => "unset",
        LocalizationState::Tracking => "tracking",
        LocalizationState::Ambiguous => "ambiguous",
        LocalizationState::Lost => "lost",
    }
}
