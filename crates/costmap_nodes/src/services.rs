//! The services of a costmap.

use periplus_base::Pose2;
use periplus_costmap::clear::{Region, clear};
use periplus_costmap::{Compat, Costmap};
use periplus_graph::{Actor, GraphError, Level, Node};
use periplus_msgs::nav2_msgs::{
    ClearCostmapAroundRobot, ClearCostmapAroundRobotResponse, ClearCostmapExceptRegion,
    ClearCostmapExceptRegionResponse, ClearEntireCostmap, ClearEntireCostmapResponse, GetCost,
    GetCostResponse, GetCostmap, GetCostmapResponse, GetCosts, GetCostsResponse,
};

use crate::messages::{nanoseconds, pose2, raw};
use crate::node::State;

/// Answers for a costmap of a name and its layers. Clear services have the forms of humble and jazzy,
/// which answer nothing; what could not be cleared is logged.
pub(crate) fn serve(
    actor: &mut Actor<State>,
    name: &str,
    layers: &[String],
    compat: Compat,
) -> Result<(), GraphError> {
    actor.serve::<GetCostmap>("get_costmap", |state, _, io| {
        let shown = state.costmap.as_ref().map(|it| (it.costmap(), "master"));
        answer_grid(shown, state, io.now_ns())
    })?;
    for layer in layers {
        let layer = layer.clone();
        actor.serve::<GetCostmap>(&format!("get_{layer}"), move |state, _, io| {
            let all = state.costmap.as_ref().map(|costmap| costmap.layers()).unwrap_or_default();
            let found = all.iter().find(|one| one.name() == layer);
            let shown = found.and_then(|one| one.grid()).map(|grid| (grid, layer.as_str()));
            answer_grid(shown, state, io.now_ns())
        })?;
    }
    actor.serve::<ClearEntireCostmap>(&format!("clear_entirely_{name}"), |state, _, io| {
        state.clear(Some(Region::Everything), io.node());
        ClearEntireCostmapResponse::default()
    })?;
    actor.serve::<ClearCostmapAroundRobot>(
        &format!("clear_around_{name}"),
        |state, request, io| {
            let side_m = f64::from(request.reset_distance);
            let region =
                state.robot.map(|Pose2 { x_m, y_m, .. }| Region::Around { x_m, y_m, side_m });
            state.clear(region, io.node());
            ClearCostmapAroundRobotResponse::default()
        },
    )?;
    actor.serve::<ClearCostmapExceptRegion>(
        &format!("clear_except_{name}"),
        |state, request, io| {
            let side_m = f64::from(request.reset_distance);
            let region =
                state.robot.map(|Pose2 { x_m, y_m, .. }| Region::Except { x_m, y_m, side_m });
            state.clear(region, io.node());
            ClearCostmapExceptRegionResponse::default()
        },
    )?;
    if compat == Compat::Main {
        actor.serve::<GetCosts>(&format!("get_cost_{name}"), |state, request, _| {
            state.costs(&request.poses, request.use_footprint)
        })
    } else {
        actor.serve::<GetCost>(&format!("get_cost_{name}"), |state, request, _| {
            let [x, y, yaw] = [request.x, request.y, request.theta].map(f64::from);
            let cost = state.costmap.as_ref().map_or(255, |costmap| {
                costmap.cost_at(Pose2::new(x, y, yaw), request.use_footprint)
            });
            GetCostResponse { cost: cost.into() }
        })
    }
}

fn answer_grid(shown: Option<(&Costmap, &str)>, state: &State, now_ns: i64) -> GetCostmapResponse {
    let frame = state.costmap.as_ref().map(|costmap| costmap.frame().global_frame.clone());
    match (shown, frame) {
        (Some((grid, layer)), Some(frame)) => {
            GetCostmapResponse { map: raw(grid, &frame, now_ns, layer) }
        }
        _ => GetCostmapResponse::default(),
    }
}

impl State {
    fn clear(&mut self, region: Option<Region>, node: &Node) {
        let done = match (&mut self.costmap, region) {
            (None, _) => Err("the costmap is not configured".to_owned()),
            (_, None) => Err("nobody knows where the robot is".to_owned()),
            (Some(costmap), Some(region)) => clear(costmap, region, &[]),
        };
        match done {
            Ok(()) => node.log(Level::Info, "cleared"),
            Err(why) => node.log(Level::Error, format_args!("cannot clear: {why}")),
        }
    }

    /// Costs of poses in any frame. Outside they are lethal, and unknown where nobody knows the frame.
    fn costs(
        &self,
        poses: &[periplus_msgs::geometry_msgs::PoseStamped],
        uses_footprint: bool,
    ) -> GetCostsResponse {
        let mut response = GetCostsResponse { costs: Vec::new(), success: true };
        let Some(costmap) = &self.costmap else {
            return GetCostsResponse { success: false, ..response };
        };
        let global_frame = &costmap.frame().global_frame;
        for pose in poses {
            let own = pose2(&pose.pose);
            let frame = pose.header.frame_id.as_str();
            let placed = if frame == global_frame {
                Some(own)
            } else {
                let stamp_ns = nanoseconds(&pose.header.stamp);
                let found = self.tf.at(global_frame, frame, stamp_ns).ok();
                found.map(|(global_from_frame, _)| Pose2::from(global_from_frame) * own)
            };
            let Some(placed) = placed else {
                response.costs.push(255.0);
                response.success = false;
                continue;
            };
            response.costs.push(costmap.cost_at(placed, uses_footprint).into());
            if !uses_footprint && costmap.cell_of(placed.x_m, placed.y_m).is_none() {
                response.success = false;
            }
        }
        response
    }
}
