//! A planner of your own: straight to the goal, or an error that names the first blocked position. The planner server finds it
//! by its class, and clients use the same action as with the planners of Nav2.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::sync::Arc;

use periplus::diagnostics::{Diagnostics, SourceMap};
use periplus::geometry::{Pose, Pose2};
use periplus::graph::{GoalProgress, Graph, NodeSettings, Qos};
use periplus::msgs::geometry_msgs::PoseStamped;
use periplus::msgs::nav_msgs::OccupancyGrid;
use periplus::msgs::nav2_msgs::{ComputePathToPose, ComputePathToPoseGoal};
use periplus::nav_nodes::navigation::{NavigationServer, NavigationSetup};
use periplus::nav_nodes::navigation_plugins::NavigationPlugins;
use periplus::params::ParamValue;
use periplus::planners::{
    ParameterRejected, PlanError, PlanErrorKind, PlanRequest, PlannedPath, Planner,
};

const PARAMETERS: &str = "
planner_server:
  ros__parameters:
    planner_plugins: [Straight]
    Straight: {plugin: 'my_package/StraightLine', step: 0.5}
global_costmap:
  global_costmap:
    ros__parameters:
      plugins: [static_layer]
      static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'}
";

/// Poses on the line to the goal, at most `step_m` apart.
struct StraightLine {
    step_m: f64,
}

impl Planner for StraightLine {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let (start, goal, costs) = (request.start, request.goal, request.costmap.costs);
        let (dx_m, dy_m) = (goal.x_m - start.x_m, goal.y_m - start.y_m);
        let (length_m, yaw_rad) = (libm::hypot(dx_m, dy_m), libm::atan2(dy_m, dx_m));
        let count = (length_m / self.step_m).ceil().max(1.0);
        let at = |part: f64| (start.x_m + part * dx_m, start.y_m + part * dy_m);
        for cell in 0..=(length_m / costs.resolution_m()) as u32 {
            let (x_m, y_m) = at(f64::from(cell) * costs.resolution_m() / length_m);
            if costs.cost_at(x_m, y_m).is_none_or(|cost| cost >= 253) {
                let text = format!("there is an obstacle at ({x_m:.2}, {y_m:.2})");
                return Err(PlanError::new(PlanErrorKind::NoValidPath, text));
            }
        }
        let mut poses: Vec<Pose2> = (0..count as u32)
            .map(|index| at(f64::from(index) / count))
            .map(|(x_m, y_m)| Pose2::new(x_m, y_m, yaw_rad))
            .collect();
        poses.push(goal);
        Ok(PlannedPath { poses, ..PlannedPath::default() })
    }

    fn set_parameter(&mut self, name: &str, _: &ParamValue) -> Result<(), ParameterRejected> {
        Err(ParameterRejected::Unknown(name.to_owned(), None))
    }
}

/// A map of 6 m x 4 m with a wall at x = 4 m, which ends at y = 2 m.
fn map() -> OccupancyGrid {
    let mut map = OccupancyGrid::default();
    map.header.frame_id = "map".into();
    (map.info.width, map.info.height, map.info.resolution) = (60, 40, 0.1);
    map.info.origin.orientation.w = 1.0;
    let is_wall = |index: i32| index % 60 == 40 && index / 60 < 20;
    map.data = (0..60 * 40).map(|index| if is_wall(index) { 100 } else { 0 }).collect();
    map
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let plugins =
        NavigationPlugins::new().planner("my_package::StraightLine", |setup, _findings| {
            let step_m = setup.given.text("step").and_then(|text| text.parse().ok());
            Some(Box::new(StraightLine { step_m: step_m.unwrap_or(0.1) }))
        });

    let mut sources = SourceMap::new();
    let file = sources.add("nav2_params.yaml", PARAMETERS);
    let tree = periplus::yaml::parse(file, &sources).map_err(|finding| finding.message)?;
    let graph = Graph::new();
    let setup = NavigationSetup {
        graph: &graph,
        file: tree.as_ref(),
        release: None,
        stamped_velocities: None,
        files: Arc::new(periplus::os::Machine),
        save_photo: Arc::new(|_, _| Ok(())),
        plugins,
    };
    let node = graph.node(NodeSettings::new("planner_server"))?;
    let mut findings = Diagnostics::new();
    let server =
        setup.create(NavigationServer::Planner, node, |it| graph.node(it), &mut findings)?;
    assert!(!findings.has_errors(), "{findings:?}");
    server.start();

    let user = graph.node(NodeSettings::new("user"))?;
    let transforms = user.publisher("/tf_static", Qos::latched(1))?;
    let robot = Pose::from_xyz(1.05, 1.05, 0.0);
    transforms.publish(periplus::tf_ros::transform("map", "base_link", robot, 0));
    let maps = user.publisher("/map", Qos::latched(1))?;
    maps.publish(map());
    let client = user.action_client::<ComputePathToPose>("compute_path_to_pose")?;
    graph.advance_to(1_000_000_000);

    let mut results = Vec::new();
    for [x_m, y_m] in [[1.05, 3.05], [5.05, 1.05]] {
        let mut goal = PoseStamped::default();
        goal.header.frame_id = "map".into();
        goal.pose = periplus::tf_ros::pose(Pose2::new(x_m, y_m, 0.0));
        let sent = client.send(ComputePathToPoseGoal { goal, ..ComputePathToPoseGoal::default() });
        let result = loop {
            graph.advance_to(graph.now_ns() + 10_000_000);
            match sent.look() {
                GoalProgress::Over(_, result) => break result,
                _ if graph.now_ns() < 10_000_000_000 => {}
                progress => return Err(format!("no result: {progress:?}").into()),
            }
        };
        println!("{} poses {}", result.path.poses.len(), result.error_msg);
        results.push(result);
    }
    // 2 m in steps of 0.5 m, and then a wall.
    assert_eq!(results[0].path.poses.len(), 5);
    assert_eq!(results[1].error_code, 208, "NO_VALID_PATH");
    assert!(results[1].error_msg.contains("there is an obstacle at (4.05, 1.05)"));
    Ok(())
}
