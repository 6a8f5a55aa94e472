//! Path smoothers.
//!
//! Source of the rules: `nav2_smoother/src/simple_smoother.cpp`, `savitzky_golay_smoother.cpp`,
//! `nav2_util/smoother_utils.hpp`.

pub(crate) mod relaxation;
mod savitzky_golay;
pub(crate) mod segments;
mod simple;

pub use savitzky_golay::SavitzkyGolaySmoother;
pub use simple::SimpleSmoother;

use std::fmt;

use periplus_costmap::CostmapView;
use periplus_geometry::Pose2;
use periplus_params::ParamValue;

use crate::ParameterRejected;

/// Inputs of one smoothing.
pub struct SmoothRequest<'a> {
    /// Path in the frame of the costmap.
    pub path: &'a [Pose2],
    /// Costmap that keeps the path away from obstacles; none to smooth without one.
    pub costmap: Option<CostmapView<'a>>,
    /// Returns true when the maximum duration has passed. Smoothers read no clock.
    pub is_out_of_time: &'a mut dyn FnMut() -> bool,
}

impl fmt::Debug for SmoothRequest<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SmoothRequest").field("path", &self.path).finish_non_exhaustive()
    }
}

/// Kind of failure: one for each error code of `SmoothPath`.
///
/// Source: `nav2_msgs/action/SmoothPath.action`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SmoothErrorKind {
    /// `UNKNOWN`.
    Unknown,
    /// `INVALID_SMOOTHER`: there is no smoother of the requested id, or its parameters are unusable.
    InvalidSmoother,
    /// `TIMEOUT`.
    Timeout,
    /// `SMOOTHED_PATH_IN_COLLISION`; the server checks this.
    Collision,
    /// `FAILED_TO_SMOOTH_PATH`.
    Failed,
    /// `INVALID_PATH`: a path without poses.
    InvalidPath,
}

impl SmoothErrorKind {
    /// Returns the error code in the result of `SmoothPath`.
    #[must_use]
    pub fn code(self) -> u16 {
        match self {
            Self::Unknown => 500,
            Self::InvalidSmoother => 501,
            Self::Timeout => 502,
            Self::Collision => 503,
            Self::Failed => 504,
            Self::InvalidPath => 505,
        }
    }
}

/// Reason why a path was not smoothed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SmoothError {
    /// Kind of failure, which has the error code.
    pub kind: SmoothErrorKind,
    /// Text of Nav2 for this failure.
    pub message: String,
}

impl SmoothError {
    /// Creates an error.
    #[must_use]
    pub fn new(kind: SmoothErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    pub(crate) fn timeout() -> Self {
        Self::new(SmoothErrorKind::Timeout, "Smoothing time exceed allowed duration")
    }
}

impl fmt::Display for SmoothError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for SmoothError {}

/// A path smoother. It keeps the number of poses and the ends of the path.
pub trait Smoother: Send {
    /// Returns the smoothed path.
    ///
    /// # Errors
    /// When the path has no poses or the time is over.
    fn smooth(&mut self, request: SmoothRequest<'_>) -> Result<Vec<Pose2>, SmoothError>;

    /// Changes a parameter. The smoothers of Nav2 read all of theirs once.
    ///
    /// # Errors
    /// When there is no such parameter, or it is fixed.
    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected>;
}

/// Returns the index of the first pose of a path at which the robot collides: the check of a smoother server
/// with `check_for_collisions`. Poses outside the costmap collide.
#[must_use]
pub fn first_collision(costmap: &CostmapView<'_>, path: &[Pose2]) -> Option<usize> {
    use periplus_costmap::cost::{INSCRIBED, LETHAL, UNKNOWN};

    path.iter().position(|pose| {
        let centre = costmap.costs.cost_at(pose.x_m, pose.y_m);
        let is_free = match centre {
            None => false,
            Some(UNKNOWN) => !costmap.tracks_unknown,
            Some(cost) if costmap.is_circular => cost < INSCRIBED,
            Some(cost) => {
                let outline = costmap.footprint.cost(costmap.costs, *pose);
                cost < LETHAL && (outline < LETHAL || outline == UNKNOWN && !costmap.tracks_unknown)
            }
        };
        !is_free
    })
}

/// Checks the input of a smoother.
fn poses(path: &[Pose2]) -> Result<&[Pose2], SmoothError> {
    if path.is_empty() {
        return Err(SmoothError::new(
            SmoothErrorKind::InvalidPath,
            "Requested path to smooth is empty",
        ));
    }
    Ok(path)
}
