//! Lattice files of the State Lattice planner.

use std::fmt::Write as _;

use periplus_diagnostics::Diagnostics;
use periplus_graph::{GoalState, LifecycleState, NodeSettings};
use periplus_msgs::nav2_msgs_main::ComputePathToPoseGoal;
use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
use periplus_nav_nodes::planner_server::PlannerServer;
use periplus_params::Given;
use periplus_resources::MemoryHost;

use crate::Planning;
use crate::common::{GLOBAL_COSTMAP, Stage, costmap, map, pose_in};
use periplus_costmap::Nav2Release;

/// A robot that drives along the axes of the map and turns on the spot.
fn turning_on_the_spot() -> String {
    let mut primitives = String::new();
    for (start, [x, y]) in
        [[0.1, 0.0], [0.0, 0.1], [-0.1, 0.0], [0.0, -0.1]].into_iter().enumerate()
    {
        let yaw = start as f64 * std::f64::consts::FRAC_PI_2;
        let mut add = |end: usize, length: f64, [x, y]: [f64; 2], end_yaw: f64| {
            let comma = if primitives.is_empty() { "" } else { "," };
            let _ = write!(
                primitives,
                r#"{comma}{{"start_angle_index": {start}, "end_angle_index": {end}, "left_turn": true,
                "trajectory_length": {length}, "arc_length": 0.0, "poses": [[0, 0, {yaw}], [{x}, {y}, {end_yaw}]]}}"#
            );
        };
        add(start, 0.1, [x, y], yaw);
        for turn in [1, 3] {
            let end = (start + turn) % 4;
            add(end, 0.0, [0.0, 0.0], end as f64 * std::f64::consts::FRAC_PI_2);
        }
    }
    format!(
        r#"{{"lattice_metadata": {{"turning_radius": 50.0, "grid_resolution": 0.1,
        "heading_angles": [0.0, 1.5707963267948966, 3.141592653589793, 4.71238898038469]}},
        "primitives": [{primitives}]}}"#
    )
}

fn planning(path: &str, found: &mut Diagnostics) -> Planning {
    let release = Nav2Release::Main;
    let mut stage = Stage::new();
    let costmap = costmap(&stage.graph, "global_costmap", GLOBAL_COSTMAP, release);
    let node = stage.graph.node(NodeSettings::new("planner_server")).unwrap();
    let given = [
        Given::new("GridBased.plugin", "nav2_smac_planner::SmacPlannerLattice"),
        Given::new("GridBased.lattice_filepath", path),
        Given::new("GridBased.smooth_path", "false"),
    ];
    let files = MemoryHost::new()
        .with_file("/turns.json", turning_on_the_spot())
        .with_file("/broken.json", "{");
    let from = (&NavigationPlugins::new(), &files as _);
    let server = PlannerServer::with_plugins(&node, given, costmap, from, found).unwrap();
    stage.map.publish(map(|_, _| false));
    server.start();
    stage.advance(300);
    Planning { stage, server, release }
}

#[test]
fn the_motions_of_a_lattice_file_are_used() {
    let mut found = Diagnostics::new();
    let mut planning = planning("/turns.json", &mut found);
    assert!(found.is_empty(), "{:?}", found.iter().next());
    let goal = ComputePathToPoseGoal {
        start: pose_in("map", 1.05, 1.05, 0.0),
        goal: pose_in("map", 2.05, 2.05, std::f64::consts::FRAC_PI_2),
        use_start: true,
        ..ComputePathToPoseGoal::default()
    };
    let (state, result) = planning.plan_to(goal);
    assert_eq!(state, GoalState::Succeeded, "{}", result.error_msg);
    let path = result.path.poses;
    assert!(path.len() >= 18, "{}", path.len());
    for pair in path.windows(2) {
        let [from, to] = [&pair[0].pose.position, &pair[1].pose.position];
        let along = (to.x - from.x).abs().min((to.y - from.y).abs());
        assert!(along < 1e-6, "each motion is along an axis: {from:?}, {to:?}");
    }
}

#[test]
fn a_lattice_file_that_cannot_be_used_is_named() {
    for (path, why) in
        [("/none.json", "/none.json cannot be used"), ("/broken.json", "the lattice file")]
    {
        let mut found = Diagnostics::new();
        let planning = planning(path, &mut found);
        assert_eq!(planning.server.lifecycle().state(), LifecycleState::Unconfigured);
        let finding = found.iter().next().expect("a finding");
        assert_eq!(finding.code, "lattice-file");
        assert!(finding.message.contains(why), "{}", finding.message);
    }
}
