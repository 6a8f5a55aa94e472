//! Velocities of the local planner.

use periplus_controllers::{ControlError, ControlInput, GoalQuery, GoalStatus};
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::Node;
use periplus_msgs::std_msgs::Header;

use super::node::MoveBase;
use crate::costmap_2d::{CostmapNode, blame};

/// Outcome of a control cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ControlOutcome {
    /// The robot is at the goal.
    Reached,
    /// Velocity in the base frame.
    Velocity(Twist2),
}

impl MoveBase {
    /// Computes the velocity for the plan, whose poses are in a frame.
    ///
    /// # Errors
    /// A sentence with the reason, and the layer that marked the blocking cell.
    pub(super) fn control(
        &mut self,
        plan_frame: &str,
        node: &Node,
    ) -> Result<ControlOutcome, String> {
        let now_ns = node.now_ns();
        let (planner, outputs, velocity) = (&mut self.local_planner, &self.outputs, self.odometry);
        self.local_costmap.with(|costmap: &mut CostmapNode| {
            let robot = Self::robot_in(costmap, now_ns)?;
            let costmap_from_plan = costmap.global_pose_of(plan_frame, Pose2::IDENTITY, 0)?;
            let header = Header::at(now_ns, &costmap.params().global_frame);
            let Some(view) = costmap.view() else {
                return Err("the local costmap is not configured".to_owned());
            };
            let end = planner.handler.goal().unwrap_or_default();
            let goal = costmap_from_plan * end;
            let info = view.costs.info();
            let plan = planner.handler.local_plan(robot, costmap_from_plan, info);
            let plan = plan.map_err(|error| error.to_string())?;
            outputs.publish_global_plan(&header, &plan);
            let query = GoalQuery { pose: robot, goal, velocity, plan: &plan };
            let status = planner.checker.check(&query);
            if status == GoalStatus::Reached {
                return Ok(ControlOutcome::Reached);
            }
            let computed = planner.controller.compute_velocity(&ControlInput {
                time_ns: now_ns,
                pose: robot,
                velocity,
                costmap: view,
                plan: &plan,
                goal,
                tolerance: planner.checker.tolerance(),
                is_position_reached: status >= GoalStatus::AtPosition,
            });
            let report = planner.controller.report();
            outputs.publish_report(&header, &report);
            computed.map(ControlOutcome::Velocity).map_err(|error: ControlError| {
                let cell = report.blocked().and_then(|blocked| blocked.cell);
                let layer = cell.and_then(|cell| blame(costmap.costmap()?, cell));
                let layer = layer.map(|layer| format!("; the cell comes from {layer}"));
                format!("{}: {error}{}", planner.name, layer.unwrap_or_default())
            })
        })
    }
}
