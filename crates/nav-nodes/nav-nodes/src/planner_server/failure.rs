//! Failures of plans, as sentences.

use periplus_geometry::Pose2;
use periplus_planners::PlanError;

/// Plan that could not be made.
pub(super) struct LegFailure {
    /// Reason, with the error code.
    pub(super) error: PlanError,
    /// Start and goal of the leg that failed, if they are known.
    pub(super) leg: Option<(Pose2, Pose2)>,
    /// Layer and source of the blocking cell.
    pub(super) blame: Option<String>,
}

impl From<PlanError> for Box<LegFailure> {
    fn from(error: PlanError) -> Self {
        Self::new(LegFailure { error, leg: None, blame: None })
    }
}

impl LegFailure {
    /// Sentence with the planner, the poses, the reason, and the layer that is responsible.
    pub(super) fn text(&self, planner: &str) -> String {
        let shown =
            |pose: Pose2| format!("({:.2}, {:.2}) (yaw: {:.2})", pose.x_m, pose.y_m, pose.yaw_rad);
        let leg =
            self.leg.map(|(start, goal)| format!(" from {} to {}", shown(start), shown(goal)));
        let leg = leg.unwrap_or_default();
        let mut text = format!("{planner} plugin failed to plan{leg}: {}", self.error);
        if let Some(blame) = &self.blame {
            text += &format!("; the blocking cell comes from {blame}");
        }
        text
    }
}
