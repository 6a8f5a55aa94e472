//! Keeps a costmap with parameters in the format of Nav2: marks an obstacle, inflates it, and
//! explains the cost of a cell.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;

use periplus::costmap::{CostmapConfig, NoTransforms, cost};
use periplus::diagnostics::{Diagnostics, SourceMap};
use periplus::geometry::{Pose, Pose2};

const PARAMETERS: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      rolling_window: true
      width: 4
      height: 4
      resolution: 0.05
      robot_radius: 0.2
      plugins: [obstacle_layer, inflation_layer]
      obstacle_layer:
        plugin: 'nav2_costmap_2d::ObstacleLayer'
        observation_sources: scan
        scan: {max_obstacle_height: 2.0, clearing: true}
      inflation_layer:
        plugin: 'nav2_costmap_2d::InflationLayer'
        inflation_radius: 0.6
        cost_scaling_factor: 3.0
";

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut sources = SourceMap::new();
    let file = sources.add("nav2_params.yaml", PARAMETERS);
    let tree = periplus::yaml::parse(file, &sources).map_err(|finding| finding.message)?;
    let tree = tree.ok_or("the file is empty")?;
    let mut findings = Diagnostics::new();
    let config = CostmapConfig::read_yaml(&tree, "local_costmap", None, &mut findings);
    assert!(!findings.has_errors());

    let mut costmap = config.build();
    let source = costmap.source_mut("obstacle_layer", "scan").ok_or("no source `scan`")?;
    // A lidar 0.2 m above the floor sees a point 1 m ahead.
    let odom_from_lidar = Pose::from_xyz(0.0, 0.0, 0.2);
    source.insert(0, 0, odom_from_lidar, odom_from_lidar.translation, [[1.0, 0.0, 0.0]]);
    costmap.update(0, Pose2::IDENTITY, &NoTransforms);

    let at = |x_m: f64| costmap.cost_at(Pose2::new(x_m, 0.0, 0.0), false);
    let costs = [1.0, 0.9, 0.6, 0.2].map(at);
    println!("costs at 1.0, 0.9, 0.6 and 0.2 m ahead: {costs:?}");
    assert_eq!(costs[0], cost::LETHAL, "the obstacle");
    assert_eq!(costs[1], cost::INSCRIBED, "nearer to it than the radius of the robot");
    assert!((1..cost::INSCRIBED).contains(&costs[2]), "within the inflation radius: {}", costs[2]);
    assert_eq!(costs[3], cost::FREE, "beyond the inflation radius");
    Ok(())
}
