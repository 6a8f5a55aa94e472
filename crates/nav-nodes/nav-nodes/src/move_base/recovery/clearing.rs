//! Clearing of costmaps, and limits of the speed after it.

use periplus_costmap::clear::{Region, clear};
use periplus_geometry::Pose2;
use periplus_graph::{Level, LifecycleNode, Node};
use periplus_params::ParamValue;

use super::{ClearCostmapParams, MoveSlowAndClearParams};
use crate::costmap_2d::CostmapNode;
use crate::move_base::node::MoveBase;

/// Limits of the speed that end once the robot has moved.
pub(in crate::move_base) struct SlowMotion {
    from: Pose2,
    distance_m: f64,
    /// Parameters of the local planner, and their values without limits.
    normal: Vec<(String, ParamValue)>,
}

/// Layer that recoveries clear by default.
const DEFAULT_LAYER: &str = "obstacles";

/// Clears layers in a costmap. By default a layer `obstacles`, or all that can be cleared.
fn clear_layers(
    costmap: &mut CostmapNode,
    names: &[String],
    region: impl Fn(Pose2) -> Region,
    now_ns: i64,
) -> Result<(), String> {
    let robot = MoveBase::robot_in(costmap, now_ns)?;
    let Some(layered) = &mut costmap.costmap else {
        return Err("the costmap is not configured".to_owned());
    };
    let is_default = names == [DEFAULT_LAYER];
    let has_default = layered.all().any(|layer| layer.name() == DEFAULT_LAYER);
    let names = if is_default && !has_default { &[] } else { names };
    clear(layered, region(robot), names).map_err(|error| error.to_string())?;
    if let Some(outputs) = &mut costmap.outputs {
        outputs.request_full();
    }
    Ok(())
}

impl MoveBase {
    /// Clears the costmaps of a recovery outside, or inside, of a square around the robot.
    pub(in crate::move_base) fn clear_costmaps(&self, params: &ClearCostmapParams, node: &Node) {
        let side_m = params.reset_distance_m;
        let region = |Pose2 { x_m, y_m, .. }: Pose2| match params.invert_area_to_clear {
            true => Region::Around { x_m, y_m, side_m },
            false => Region::Except { x_m, y_m, side_m },
        };
        if params.affected_maps != "local" {
            self.clear_one(&self.global_costmap, &params.layer_names, region, node);
        }
        if params.affected_maps != "global" {
            self.clear_one(&self.local_costmap, &params.layer_names, region, node);
        }
    }

    fn clear_one(
        &self,
        costmap: &LifecycleNode<CostmapNode>,
        names: &[String],
        region: impl Fn(Pose2) -> Region,
        node: &Node,
    ) {
        let cleared = costmap.with(|costmap| clear_layers(costmap, names, region, node.now_ns()));
        if let Err(why) = cleared {
            let text = format!("{} is not cleared: {why}", costmap.node().full_name());
            node.log(Level::Error, text);
        }
    }

    /// Clears all obstacles of sensors in a square around the robot in the global costmap.
    pub(in crate::move_base) fn clear_around_robot(&self, radius_m: f64, node: &Node) {
        let around =
            |Pose2 { x_m, y_m, .. }: Pose2| Region::Around { x_m, y_m, side_m: 2.0 * radius_m };
        self.clear_one(&self.global_costmap, &[], around, node);
    }

    /// Clears around the robot, and limits the speed of the local planner until the robot has moved.
    pub(in crate::move_base) fn move_slowly(
        &mut self,
        params: &MoveSlowAndClearParams,
        node: &Node,
    ) {
        let around = |Pose2 { x_m, y_m, .. }: Pose2| Region::Around {
            x_m,
            y_m,
            side_m: 2.0 * params.clearing_distance_m,
        };
        self.clear_one(&self.global_costmap, &params.layer_names, around, node);
        self.clear_one(&self.local_costmap, &params.layer_names, around, node);
        if params.planner_namespace != self.local_planner.name {
            let text = format!(
                "the speed is not limited: `planner_namespace` is `{}`, and the local planner is `{}`",
                params.planner_namespace, self.local_planner.name
            );
            return node.log(Level::Error, text);
        }
        let robot = self.global_costmap.with(|it| Self::robot_in(it, node.now_ns()));
        let Ok(from) = robot else { return };
        self.end_slow_motion(node);
        let limits = [
            (&params.max_trans_param_name, params.limited_trans_speed_m_s),
            (&params.max_rot_param_name, params.limited_rot_speed_rad_s),
        ];
        let mut normal = Vec::new();
        for (name, limit) in limits {
            let old = self.local_planner.values().and_then(|values| values.get(name));
            let changed = self.local_planner.change(name, ParamValue::Number(limit));
            match (old, changed) {
                (Some(old), Ok(())) => normal.push((name.clone(), old)),
                (_, Err(why)) => node.log(Level::Error, format!("the speed is not limited: {why}")),
                (None, Ok(())) => {}
            }
        }
        self.slow = Some(SlowMotion { from, distance_m: params.limited_distance_m, normal });
    }

    /// Ends the limits of the speed once the robot has moved.
    pub(in crate::move_base) fn check_slow_motion(&mut self, robot: Pose2, node: &Node) {
        let has_moved = |slow: &SlowMotion| {
            libm::hypot(robot.x_m - slow.from.x_m, robot.y_m - slow.from.y_m) >= slow.distance_m
        };
        if self.slow.as_ref().is_some_and(has_moved) {
            self.end_slow_motion(node);
        }
    }

    /// Ends the limits of the speed.
    pub(in crate::move_base) fn end_slow_motion(&mut self, node: &Node) {
        let Some(slow) = self.slow.take() else { return };
        for (name, value) in slow.normal {
            if let Err(why) = self.local_planner.change(&name, value) {
                node.log(Level::Error, format!("the speed stays limited: {why}"));
            }
        }
    }
}
