//! Plans of the node.

use std::any::Any;

use periplus_costmap::Layer;
use periplus_costmap::cost::FREE;
use periplus_costmap::layers::StaticLayer;
use periplus_geometry::Pose2;
use periplus_graph::Node;
use periplus_msgs::std_msgs::Header;

use super::node::MoveBase;
use crate::costmap_2d::{CostmapNode, blame};

/// Reason why a costmap has not started yet; none once it has. ROS waits for the first map then.
fn not_ready(costmap: &CostmapNode, now_ns: i64) -> Option<String> {
    let Some(layered) = costmap.costmap() else {
        return Some("it is not configured".to_owned());
    };
    let has_no_map = |layer: &&dyn Layer| {
        let is_static = (*layer as &dyn Any).is::<StaticLayer>();
        is_static && layer.is_enabled() && !layer.is_current(now_ns)
    };
    if let Some(layer) = layered.all().find(has_no_map) {
        return Some(format!(
            "its layer `{}` has no map; start a map server or SLAM",
            layer.name()
        ));
    }
    (!layered.is_initialized()).then(|| "it has not been updated yet".to_owned())
}

impl MoveBase {
    /// Pose of the robot in the frame of a costmap.
    ///
    /// # Errors
    /// A sentence with the missing transform and advice.
    pub(super) fn robot_in(costmap: &mut CostmapNode, now_ns: i64) -> Result<Pose2, String> {
        costmap.robot_pose(now_ns).map_err(|finding| {
            let help: String = finding.help.iter().map(|help| format!("; {help}")).collect();
            format!("{}{help}", finding.message)
        })
    }

    /// Plans from a pose, or from that of the robot, and publishes the plan.
    ///
    /// # Errors
    /// A sentence with the reason, and the layer that marked the blocking cell.
    pub(super) fn plan(
        &mut self,
        start: Option<Pose2>,
        goal: Pose2,
        node: &Node,
    ) -> Result<(Header, Vec<Pose2>), String> {
        let planner = &mut self.global_planner;
        let now_ns = node.now_ns();
        let planned = self.global_costmap.with(|costmap| {
            let start = match start {
                Some(start) => start,
                None => Self::robot_in(costmap, now_ns)?,
            };
            if let Some(why) = not_ready(costmap, now_ns) {
                return Err(format!("the global costmap is not ready: {why}"));
            }
            let Some(view) = costmap.view() else {
                return Err("the global costmap is not configured".to_owned());
            };
            let planned = planner.plan(view, start, goal).map_err(|error| {
                let blocking = error.obstruction.blocking;
                let layer = blocking.and_then(|it| blame(costmap.costmap()?, it.cell));
                let layer = layer.map(|layer| format!("; the blocking cell comes from {layer}"));
                format!("{}: {error}{}", planner.name, layer.unwrap_or_default())
            })?;
            let header = Header::at(now_ns, &costmap.params().global_frame);
            // NavFn sets the cell of the robot free in the costmap itself.
            if let (Some(cell), Some(layered)) = (planned.cleared_cell, &mut costmap.costmap) {
                layered.costmap_mut().set(cell, FREE);
            }
            Ok((header, planned.poses))
        });
        let (header, poses) = planned?;
        if poses.is_empty() {
            return Err(format!("{}: the plan is empty", planner.name));
        }
        self.outputs.publish_plan(&header, &poses);
        Ok((header, poses))
    }
}
