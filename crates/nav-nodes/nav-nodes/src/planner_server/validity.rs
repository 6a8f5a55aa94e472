//! Service `is_path_valid`: test of a path for collisions.
//!
//! Source: `nav2_planner/is_path_valid_service.hpp` (main), `planner_server.cpp` (jazzy, humble).

use periplus_costmap::cost::{FREE, INSCRIBED, LETHAL, UNKNOWN};
use periplus_costmap::{Costmap, Footprint, Nav2Release};
use periplus_geometry::Pose2;
use periplus_graph::{Io, Level};
use periplus_msgs::nav2_msgs_main::{IsPathValidRequest, IsPathValidResponse};

use super::node::PlannerServer;
use crate::costmap_2d::{CostmapNode, pose2_of};

/// Rules of a test.
struct PathTest<'a> {
    costs: &'a Costmap,
    /// Footprint; none if the cost of the centre decides.
    footprint: Option<&'a Footprint>,
    max_cost: u8,
    unknown_blocks: bool,
    stops_at_first: bool,
}

impl PathTest<'_> {
    /// Indices of the invalid poses.
    fn invalid(&self, poses: &[Pose2], range: std::ops::Range<usize>) -> Vec<i32> {
        let mut invalid = Vec::new();
        for index in range {
            if self.blocks(self.cost(poses[index])) {
                invalid.push(i32::try_from(index).unwrap_or(i32::MAX));
                if self.stops_at_first {
                    break;
                }
            }
        }
        invalid
    }

    fn cost(&self, pose: Pose2) -> u8 {
        match self.footprint {
            Some(footprint) => footprint.cost(self.costs, pose),
            None => self.costs.cost_at(pose.x_m, pose.y_m).unwrap_or(LETHAL),
        }
    }

    fn blocks(&self, cost: u8) -> bool {
        let cost = match cost {
            UNKNOWN if self.unknown_blocks => LETHAL,
            UNKNOWN => FREE,
            cost => cost,
        };
        cost == LETHAL || cost >= self.max_cost || self.footprint.is_none() && cost == INSCRIBED
    }
}

/// End of the poses from `first` on whose distance along the path is within a limit \[m\].
fn end_within(poses: &[Pose2], first: usize, limit_m: f64) -> usize {
    let mut length_m = 0.0;
    for index in first + 1..poses.len() {
        let (from, to) = (poses[index - 1], poses[index]);
        length_m += libm::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
        if length_m > limit_m {
            return index;
        }
    }
    poses.len()
}

impl PlannerServer {
    /// Answers a request. Invalid indices are reported by main only.
    pub(super) fn check_path(
        &mut self,
        request: &IsPathValidRequest,
        io: &mut Io<'_, Self>,
    ) -> IsPathValidResponse {
        let is_main = self.release == Nav2Release::Main;
        let now_ns = io.now_ns();
        let checked = if !io.node().is_active() {
            Err("the server is not active".to_owned())
        } else if request.path.poses.is_empty() {
            Err("Received empty path. Cannot validate path.".to_owned())
        } else {
            self.costmap.with(|costmap| {
                if is_main
                    && self.params.costmap_update_timeout_s > 0.0
                    && let Some(why) = costmap.delay(now_ns)
                {
                    return Err(format!("Failed to wait for costmap: {why}"));
                }
                match costmap.robot_pose(now_ns) {
                    Ok(robot) => check(costmap, request, robot),
                    Err(finding) if is_main => Err(format!(
                        "Failed to get robot pose. Cannot validate path: {}",
                        finding.message
                    )),
                    // Without the pose of the robot nothing is tested.
                    Err(_) => Ok(Vec::new()),
                }
            })
        };
        match checked {
            Ok(invalid) => IsPathValidResponse {
                success: true,
                is_valid: invalid.is_empty(),
                invalid_pose_indices: if is_main { invalid } else { Vec::new() },
            },
            Err(why) => {
                io.node().log(Level::Error, why);
                IsPathValidResponse::default()
            }
        }
    }
}

/// Tests a path from the pose nearest to the robot on, so that passed poses do not count.
fn check(
    costmap: &CostmapNode,
    request: &IsPathValidRequest,
    robot: Pose2,
) -> Result<Vec<i32>, String> {
    let (Some(layered), Some(view)) = (costmap.costmap(), costmap.view()) else {
        return Err("the costmap is not configured".to_owned());
    };
    let costs = if request.layer_name.is_empty() {
        view.costs
    } else {
        let layer = layered.all().find(|layer| layer.name() == request.layer_name);
        layer.and_then(|layer| layer.grid()).ok_or_else(|| {
            let layer = &request.layer_name;
            format!("Requested layer '{layer}' not found or does not provide a costmap.")
        })?
    };
    let given = match request.footprint.as_str() {
        "" => None,
        text => Some(Footprint::read(text).map_err(|error| {
            format!("Invalid footprint string '{text}': {error}. Cannot validate path.")
        })?),
    };
    let own = (!view.is_circular).then_some(view.footprint);
    let test = PathTest {
        costs,
        footprint: given.as_ref().or(own),
        max_cost: request.max_cost,
        unknown_blocks: request.consider_unknown_as_obstacle,
        stops_at_first: request.stop_at_first_collision,
    };
    let poses: Vec<Pose2> = request.path.poses.iter().map(|pose| pose2_of(&pose.pose)).collect();
    let distance_m = |pose: &Pose2| libm::hypot(pose.x_m - robot.x_m, pose.y_m - robot.y_m);
    let nearest = (0..poses.len())
        .min_by(|left, right| distance_m(&poses[*left]).total_cmp(&distance_m(&poses[*right])))
        .unwrap_or_default();
    let end = match request.max_lookahead_distance {
        limit_m if limit_m > 0.0 => end_within(&poses, nearest, limit_m),
        _ => poses.len(),
    };
    Ok(test.invalid(&poses, nearest..end))
}
