//! Services `~/make_plan` and `~/clear_costmaps`.

use periplus_costmap::clear::{Region, clear};
use periplus_geometry::Pose2;
use periplus_graph::{Level, Node};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::{GetPlanRequest, GetPlanResponse};
use periplus_msgs::std_srvs::EmptyResponse;

use super::node::MoveBase;
use super::outputs::path;
use crate::costmap_2d::pose2_of;

/// Distance of the positions around a goal that `make_plan` tries, in cells.
const SEARCH_STEP_CELLS: f64 = 3.0;

/// Maximum number of rings of positions that `make_plan` tries.
const MAX_RING_COUNT: usize = 100;

impl MoveBase {
    /// Clears all layers with obstacles of sensors.
    pub(super) fn clear_all(&mut self, node: &Node) -> EmptyResponse {
        for costmap in [&self.global_costmap, &self.local_costmap] {
            let cleared = costmap.with(|costmap| {
                let Some(layered) = &mut costmap.costmap else {
                    return Err("the costmap is not configured".to_owned());
                };
                clear(layered, Region::Everything, &[]).map_err(|error| error.to_string())?;
                if let Some(outputs) = &mut costmap.outputs {
                    outputs.request_full();
                }
                Ok(())
            });
            if let Err(why) = cleared {
                let name = costmap.node().full_name();
                node.log(Level::Error, format!("{name} is not cleared: {why}"));
            }
        }
        EmptyResponse::default()
    }

    /// Plans for a user. The plan is empty while a goal runs, and if there is none.
    pub(super) fn plan_for_user(
        &mut self,
        request: &GetPlanRequest,
        node: &Node,
    ) -> GetPlanResponse {
        match self.user_plan(request, node) {
            Ok(response) => response,
            Err(why) => {
                node.log(Level::Error, format!("`make_plan` has no plan: {why}"));
                GetPlanResponse::default()
            }
        }
    }

    fn user_plan(
        &mut self,
        request: &GetPlanRequest,
        node: &Node,
    ) -> Result<GetPlanResponse, String> {
        if self.job.is_some() {
            return Err("a goal is running; cancel it first".to_owned());
        }
        let now_ns = node.now_ns();
        let start = match request.start.header.frame_id.as_str() {
            "" => self.global_costmap.with(|costmap| Self::robot_in(costmap, now_ns))?,
            _ => self.in_global_frame(&request.start)?,
        };
        let goal = self.in_global_frame(&request.goal)?;
        if self.params.make_plan_clear_costmap {
            let own = self
                .global_costmap
                .with(|costmap| costmap.view().map(|view| view.footprint.circumscribed_radius_m));
            let radius_m = self.params.clearing_radius_m.or(own).unwrap_or_default();
            self.clear_around_robot(radius_m, node);
        }
        let reached = match self.plan(Some(start), goal, node) {
            Ok(plan) => Ok(plan),
            Err(why) => self.plan_near(start, goal, f64::from(request.tolerance), node).ok_or(why),
        };
        let (header, mut poses) = reached?;
        let is_away = poses.last().is_some_and(|end| (end.x_m, end.y_m) != (goal.x_m, goal.y_m));
        if is_away && self.params.make_plan_add_unreachable_goal {
            poses.push(goal);
        }
        Ok(GetPlanResponse { plan: path(&header, &poses) })
    }

    fn in_global_frame(&self, pose: &PoseStamped) -> Result<Pose2, String> {
        let frame = pose.header.frame_id.trim_start_matches('/');
        let pose = pose2_of(&pose.pose);
        self.global_costmap.with(|costmap| costmap.global_pose_of(frame, pose, 0))
    }

    /// Plans to the positions on squares around a goal, the nearest square first.
    fn plan_near(
        &mut self,
        start: Pose2,
        goal: Pose2,
        tolerance_m: f64,
        node: &Node,
    ) -> Option<(periplus_msgs::std_msgs::Header, Vec<Pose2>)> {
        let resolution_m =
            self.global_costmap.with(|costmap| costmap.params().resolution_m).max(1e-3);
        let step_m = (SEARCH_STEP_CELLS * resolution_m).min(tolerance_m);
        if step_m <= 0.0 {
            return None;
        }
        let ring_count = ((tolerance_m / step_m) as usize).min(MAX_RING_COUNT) as i64;
        for ring in 1..=ring_count {
            for (column, row) in ring_offsets(ring) {
                let at = Pose2 {
                    x_m: goal.x_m + column as f64 * step_m,
                    y_m: goal.y_m + row as f64 * step_m,
                    ..goal
                };
                if let Ok(plan) = self.plan(Some(start), at, node) {
                    return Some(plan);
                }
            }
        }
        None
    }
}

/// Offsets of the positions on a square around a centre.
fn ring_offsets(ring: i64) -> Vec<(i64, i64)> {
    let all = (-ring..=ring).flat_map(|row| (-ring..=ring).map(move |column| (column, row)));
    all.filter(|(column, row)| column.abs().max(row.abs()) == ring).collect()
}

#[test]
fn a_ring_has_the_cells_at_its_border() {
    assert_eq!(ring_offsets(1).len(), 8);
    assert_eq!(ring_offsets(2).len(), 16);
    assert!(ring_offsets(2).contains(&(-2, 1)));
}
