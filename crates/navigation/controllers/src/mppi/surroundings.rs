//! Path and costs of a cycle, in single precision.

use periplus_geometry::{Pose2, normalize_angle};

use super::cost_grid::CostGrid;
use super::path::LocalPath;
use crate::ControlInput;

/// Side length of the squares whose corners are anchors \[m\]: within half of it coordinates are those of the
/// frame itself, beyond it they stay precise.
const ANCHOR_SPACING_M: f64 = 256.0;

/// Path and costs, relative to an anchor.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surroundings {
    pub(crate) path: LocalPath,
    pub(crate) grid: CostGrid,
    /// Position of the anchor in the frame of the costmap \[m\].
    anchor: [f64; 2],
}

impl Surroundings {
    /// Copies the inputs of a cycle.
    pub(crate) fn copy(&mut self, input: &ControlInput<'_>) {
        let anchor = |at_m: f64| libm::round(at_m / ANCHOR_SPACING_M) * ANCHOR_SPACING_M;
        self.anchor = [anchor(input.pose.x_m), anchor(input.pose.y_m)];
        self.grid.copy(&input.costmap, self.anchor);
        self.path = LocalPath::new(input.plan.iter().map(|pose| self.near(*pose)));
    }

    /// Pose relative to the anchor: x \[m\], y \[m\], yaw \[rad\].
    pub(crate) fn near(&self, pose: Pose2) -> [f32; 3] {
        [
            (pose.x_m - self.anchor[0]) as f32,
            (pose.y_m - self.anchor[1]) as f32,
            normalize_angle(pose.yaw_rad) as f32,
        ]
    }

    /// Pose in the frame of the costmap.
    pub(crate) fn pose(&self, [x, y, yaw]: [f32; 3]) -> Pose2 {
        Pose2::new(f64::from(x) + self.anchor[0], f64::from(y) + self.anchor[1], f64::from(yaw))
    }
}
