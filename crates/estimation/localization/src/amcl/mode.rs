//! States of the localization state machine.

use periplus_geometry::Pose2;

use crate::hypotheses::Hypotheses;
use crate::particles::Covariance2;
use crate::scan_refinement::PoseBelief;

/// State of [`Amcl`](super::Amcl).
///
/// ```text
/// Uninitialized --initial pose--> Tracking --another pose fits--> Relocalizing
///       |                            ^  ^                           |
///       +--global localization--> Hypotheses     decided, or fallback
/// ```
#[derive(Clone, Debug)]
pub(super) enum Mode {
    /// No pose: waits for a map, an initial pose or the result of global localization.
    Uninitialized {
        /// Initial pose that waits for a map.
        initial_pose: Option<(Pose2, Covariance2)>,
    },
    /// Several poses are possible, and none was known before.
    Hypotheses(Hypotheses),
    /// One pose, estimated by particles and refined by scan matching.
    Tracking {
        /// Result of the last refinement.
        refined: Option<RefinedPose>,
    },
    /// The robot may have been kidnapped: several poses are possible.
    Relocalizing {
        /// Possible poses, the tracked one among them.
        hypotheses: Hypotheses,
        /// Pose that was tracked before, predicted by odometry.
        fallback: RefinedPose,
    },
}

impl Mode {
    /// Hypotheses, with the pose that was tracked before, if any.
    pub(super) fn with_hypotheses(hypotheses: Hypotheses, fallback: Option<RefinedPose>) -> Self {
        match fallback {
            Some(fallback) => Self::Relocalizing { hypotheses, fallback },
            None => Self::Hypotheses(hypotheses),
        }
    }

    /// Hypotheses that are being tracked.
    pub(super) fn hypotheses(&self) -> Option<&Hypotheses> {
        match self {
            Self::Hypotheses(hypotheses) | Self::Relocalizing { hypotheses, .. } => {
                Some(hypotheses)
            }
            Self::Uninitialized { .. } | Self::Tracking { .. } => None,
        }
    }

    /// Refined pose of [`Mode::Tracking`].
    pub(super) fn refined(&self) -> Option<&RefinedPose> {
        match self {
            Self::Tracking { refined } => refined.as_ref(),
            _ => None,
        }
    }

    /// Drops all that depends on the origin of odometry.
    pub(super) fn reset_odometry(&mut self) {
        *self = match std::mem::replace(self, Self::Tracking { refined: None }) {
            Self::Uninitialized { initial_pose } => Self::Uninitialized { initial_pose },
            Self::Tracking { .. } => Self::Tracking { refined: None },
            Self::Hypotheses(hypotheses) | Self::Relocalizing { hypotheses, .. } => {
                Self::Hypotheses(hypotheses)
            }
        };
    }
}

/// Pose refined by scan matching.
#[derive(Clone, Copy, Debug)]
pub(super) struct RefinedPose {
    pub(super) belief: PoseBelief,
    /// Odometry at the time of the refinement.
    pub(super) odom_from_base: Pose2,
    /// Pose by scans while odometry reports no motion.
    pub(super) standstill: Option<PoseBelief>,
    /// Motion by scans between the last two refinements.
    pub(super) last_step: Option<Pose2>,
}

impl RefinedPose {
    pub(super) fn new(belief: PoseBelief, odom_from_base: Pose2) -> Self {
        Self { belief, odom_from_base, standstill: None, last_step: None }
    }
}
