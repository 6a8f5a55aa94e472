//! Rotation by a full turn.

use std::f64::consts::TAU;

use periplus_controllers::footprint_collision;
use periplus_controllers::ros1::{TRAJECTORY_PLANNER, TrajectoryPlannerParams};
use periplus_costmap::CostmapView;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, normalize_angle};

use super::RotateRecoveryParams;
use crate::move_base::values::{PrivateParameters, reading};

/// Limits of a rotation, those of TrajectoryPlannerROS whichever local planner is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::move_base) struct RotationLimits {
    /// Minimum turn rate \[rad/s\].
    pub(super) min_rad_s: f64,
    /// Maximum turn rate \[rad/s\].
    pub(super) max_rad_s: f64,
    /// Angular acceleration \[rad/s²\].
    pub(super) acc_rad_s2: f64,
}

impl RotationLimits {
    pub(super) fn read(node: &PrivateParameters) -> Self {
        let group = node.group("TrajectoryPlannerROS");
        // The planner itself reports findings about the same parameters.
        let values = reading(&mut Diagnostics::new(), |found| {
            TRAJECTORY_PLANNER.check_given(group.given(), found)
        });
        let params = TrajectoryPlannerParams::from_values(&values);
        Self {
            min_rad_s: params.min_in_place_vel_theta_rad_s,
            max_rad_s: params.max_rotational_vel_rad_s,
            acc_rad_s2: params.acc_lim_theta_rad_s2,
        }
    }
}

/// Rotation that runs.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::move_base) struct Rotation {
    last_yaw_rad: Option<f64>,
    turned_rad: f64,
}

impl Rotation {
    /// Returns the turn rate \[rad/s\] at a pose in the frame of the local costmap; none at the end of the turn.
    ///
    /// # Errors
    /// A sentence, if the footprint would collide on the rest of the turn.
    pub(in crate::move_base) fn rate_rad_s(
        &mut self,
        pose: Pose2,
        costmap: &CostmapView<'_>,
        params: &RotateRecoveryParams,
        limits: RotationLimits,
    ) -> Result<Option<f64>, String> {
        let before_rad = self.last_yaw_rad.replace(pose.yaw_rad).unwrap_or(pose.yaw_rad);
        self.turned_rad += normalize_angle(pose.yaw_rad - before_rad);
        let left_rad = TAU - self.turned_rad;
        if left_rad <= params.yaw_goal_tolerance_rad {
            return Ok(None);
        }
        let steps = libm::ceil(left_rad.min(TAU) / params.sim_granularity_rad) as usize;
        for step in 0..steps {
            let yaw_rad = pose.yaw_rad + step as f64 * params.sim_granularity_rad;
            if let Some(blocked) = footprint_collision(costmap, Pose2 { yaw_rad, ..pose }) {
                return Err(format!("the robot cannot rotate in place: {blocked}"));
            }
        }
        let stoppable_rad_s = libm::sqrt(2.0 * limits.acc_rad_s2 * left_rad);
        Ok(Some(stoppable_rad_s.min(limits.max_rad_s).max(limits.min_rad_s)))
    }
}

#[cfg(test)]
mod tests {
    use periplus_costmap::cost::LETHAL;
    use periplus_costmap::{Costmap, Footprint};
    use periplus_grid::GridInfo;

    use super::*;

    const LIMITS: RotationLimits =
        RotationLimits { min_rad_s: 0.4, max_rad_s: 1.0, acc_rad_s2: 3.2 };

    fn rates(
        obstacle: Option<(usize, usize)>,
        yaws_rad: &[f64],
    ) -> Vec<Result<Option<f64>, String>> {
        let corner = Pose2::new(-1.0, -1.0, 0.0);
        let info = GridInfo::new(0.1, 20, 20, corner).unwrap_or_else(|error| panic!("{error}"));
        let mut costs = Costmap::new(info, 0);
        if let Some(cell) = obstacle {
            costs.set(cell, LETHAL);
        }
        // A long robot.
        let corners = [[0.6, 0.1], [0.6, -0.1], [-0.1, -0.1], [-0.1, 0.1]];
        let footprint = Footprint::new(corners.to_vec());
        let view = CostmapView {
            costs: &costs,
            footprint: &footprint,
            is_circular: false,
            tracks_unknown: false,
            inflation: None,
        };
        let (mut rotation, params) = (Rotation::default(), RotateRecoveryParams::default());
        let rate = |yaw_rad: &f64| {
            rotation.rate_rad_s(Pose2::new(0.05, 0.05, *yaw_rad), &view, &params, LIMITS)
        };
        yaws_rad.iter().map(rate).collect()
    }

    #[test]
    fn a_full_turn_slows_down_at_its_end() {
        let found = rates(None, &[0.0, 2.0, 4.0 - TAU, 6.0 - TAU, 6.2 - TAU]);
        let expected = [Ok(Some(1.0)), Ok(Some(1.0)), Ok(Some(1.0)), Ok(Some(1.0)), Ok(None)];
        assert_eq!(found, expected);
    }

    #[test]
    fn an_obstacle_beside_the_robot_stops_it() {
        // At (0.05, 0.55), a quarter turn to the left.
        let found = rates(Some((10, 15)), &[0.0]);
        let why = found[0].as_ref().err().map(String::as_str).unwrap_or_default();
        assert!(why.contains("cannot rotate") && why.contains("(10, 15)"), "{found:?}");
    }
}
