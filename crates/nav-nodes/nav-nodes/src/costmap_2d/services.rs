//! Services of a costmap.

mod clearing;

use periplus_costmap::{Costmap, Nav2Release};
use periplus_geometry::Pose2;
use periplus_graph::{Actor, GraphError};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs::{
    GetCost, GetCostResponse, GetCostmap, GetCostmapResponse, GetCosts, GetCostsResponse,
};
use periplus_msgs::std_srvs::{SetBool, SetBoolResponse};
use periplus_params::ParamValue;

use crate::costmap_2d::messages::{pose2, raw};
use crate::costmap_2d::node::CostmapNode;

/// Serves the services of a costmap, its layers and its filters, with the types of a distribution.
pub(crate) fn serve(
    actor: &mut Actor<CostmapNode>,
    name: &str,
    layers: &[String],
    filters: &[String],
    forms: Nav2Release,
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
    clearing::serve(actor, name, forms)?;
    for filter in filters {
        let name = filter.clone();
        actor.serve::<SetBool>(&format!("{filter}/toggle_filter"), move |state, request, _| {
            state.toggle(&name, request.data)
        })?;
    }
    if forms.answers_several_costs() {
        actor.serve::<GetCosts>(&format!("get_cost_{name}"), |state, request, _| {
            state.costs(&request.poses, request.use_footprint)
        })
    } else {
        actor.serve::<GetCost>(&format!("get_cost_{name}"), move |state, request, _| {
            let [x, y, yaw] = [request.x, request.y, request.theta].map(f64::from);
            let Some(costmap) = &state.costmap else { return GetCostResponse { cost: 255.0 } };
            let is_outside = !request.use_footprint && costmap.cell_of(x, y).is_none();
            let cost = if is_outside {
                forms.cost_outside()
            } else {
                costmap.cost_at(Pose2::new(x, y, yaw), request.use_footprint).into()
            };
            GetCostResponse { cost }
        })
    }
}

fn answer_grid(
    shown: Option<(&Costmap, &str)>,
    state: &CostmapNode,
    now_ns: i64,
) -> GetCostmapResponse {
    let frame = state.costmap.as_ref().map(|costmap| costmap.frame().global_frame.clone());
    match (shown, frame) {
        (Some((grid, layer)), Some(frame)) => {
            GetCostmapResponse { map: raw(grid, &frame, now_ns, layer) }
        }
        _ => GetCostmapResponse::default(),
    }
}

impl CostmapNode {
    /// Enables or disables a filter.
    fn toggle(&mut self, filter: &str, is_on: bool) -> SetBoolResponse {
        let layer = self.costmap.as_mut().and_then(|costmap| costmap.find_mut(filter));
        let Some((layer, mut values)) = layer.and_then(|layer| {
            let values = layer.values()?.clone();
            Some((layer, values))
        }) else {
            let message = "the costmap is not configured".to_owned();
            return SetBoolResponse { success: false, message };
        };
        values.set("enabled", ParamValue::Bool(is_on));
        match layer.configure(values) {
            Ok(()) => {
                let message = if is_on { "Enabled" } else { "Disabled" };
                SetBoolResponse { success: true, message: message.to_owned() }
            }
            Err(error) => SetBoolResponse { success: false, message: error.to_string() },
        }
    }

    /// Transforms a pose to the global frame; none without a transform.
    fn placed(&self, pose: &PoseStamped) -> Option<Pose2> {
        let global_frame = &self.costmap.as_ref()?.frame().global_frame;
        let own = pose2(&pose.pose);
        let frame = pose.header.frame_id.as_str();
        if frame == global_frame {
            return Some(own);
        }
        let stamp_ns = pose.header.stamp.ns();
        let (global_from_frame, _) = self.tf.at(global_frame, frame, stamp_ns).ok()?;
        Some(Pose2::from(global_from_frame) * own)
    }

    /// Returns the costs of poses in any frame: lethal outside the costmap, unknown without a
    /// transform.
    fn costs(&self, poses: &[PoseStamped], uses_footprint: bool) -> GetCostsResponse {
        let mut response = GetCostsResponse { costs: Vec::new(), success: true };
        let Some(costmap) = &self.costmap else {
            return GetCostsResponse { success: false, ..response };
        };
        for pose in poses {
            let Some(placed) = self.placed(pose) else {
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
