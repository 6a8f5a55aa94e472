//! Typical tasks and typical mistakes.

use expect_test::{Expect, expect};
use periplus_costmap::clear::{Region, clear};
use periplus_costmap::filters::{FilterMask, KeepoutFilter, MaskFilter};
use periplus_costmap::layers::{RangeLayer, RangeReading, StaticLayer};
use periplus_costmap::{CostmapConfig, LayeredCostmap, MapError, Nav2Release, NoTransforms};
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_grid::{Grid, GridInfo, OccupancyGrid};

/// Reads YAML and returns the configuration with its messages.
fn read(text: &str, node: &str) -> (CostmapConfig, String) {
    let mut sources = SourceMap::new();
    let file = sources.add("params.yaml", text);
    let mut diagnostics = Diagnostics::new();
    let tree = periplus_yaml::parse(file, &sources).expect("YAML").expect("something");
    let config = CostmapConfig::read_yaml(&tree, node, None, &mut diagnostics);
    let said = diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain)).collect();
    (config, said)
}

fn check(text: &str, expected: Expect) -> CostmapConfig {
    let (config, said) = read(text, "local_costmap");
    expected.assert_eq(&said);
    config
}

const LOCAL: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      width: 3
      height: 3
      resolution: 0.1
      plugins: [obstacle_layer, inflation_layer]
      obstacle_layer:
        plugin: nav2_costmap_2d::ObstacleLayer
        observation_sources: scan
        scan: {topic: /scan, max_obstacle_height: 1.0, clearing: true}
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.3}
";

/// Inserts points seen by a sensor at the centre, in its frame.
fn look(costmap: &mut LayeredCostmap, now_ns: i64, points: &[[f32; 3]]) {
    let sensor = Pose::from_xyz(1.55, 1.55, 0.2);
    let source = costmap.source_mut("obstacle_layer", "scan").expect("a source");
    source.insert(now_ns, now_ns, sensor, sensor.translation, points.iter().copied());
    costmap.update(now_ns, Pose2::new(1.55, 1.55, 0.0), &NoTransforms);
}

#[test]
fn an_obstacle_appears_and_goes() {
    let mut costmap = check(LOCAL, expect![[""]]).build();
    look(&mut costmap, 0, &[[0.5, 0.0, 0.0]]);
    let cost = |costmap: &LayeredCostmap, x| costmap.cost_at(Pose2::new(x, 1.55, 0.0), false);
    assert_eq!(cost(&costmap, 2.05), 254);
    assert_eq!(cost(&costmap, 2.15), 253);
    assert!((1..253).contains(&cost(&costmap, 2.25)));
    // A wall further away: rays cross the former obstacle.
    look(&mut costmap, 1, &[[1.0, 0.0, 0.0]]);
    assert_eq!(cost(&costmap, 2.05), 0);
    assert_eq!(cost(&costmap, 2.55), 254);
}

#[test]
fn a_report_explains_a_marked_cell() {
    let mut costmap = read(LOCAL, "local_costmap").0.build();
    look(&mut costmap, 2_500_000_000, &[[0.5, 0.0, 0.0]]);
    let told = |costmap: &LayeredCostmap, x| {
        let cell = costmap.cell_of(x, 1.55).unwrap();
        costmap.inspect(cell).unwrap().to_string()
    };
    expect![[r#"
        cell (20, 15) at (2.050, 1.550) m: 254, lethal
          obstacle_layer: 254, lethal; `scan` observed an obstacle here
            marked by `scan` at 2.500 s: ray from (1.55, 1.55, 0.20) to (2.05, 1.55)
          inflation_layer: 254, lethal; the nearest obstacle is cell (20, 15), 0.000 m away [inflation_layer.inflation_radius]
    "#]]
    .assert_eq(&told(&costmap, 2.05));
    expect![[r#"
        cell (18, 15) at (1.850, 1.550) m: 100, near an obstacle
          obstacle_layer: 0, free; a ray of `scan` crossed this cell [obstacle_layer.scan.raytrace_max_range]
            cleared by `scan` at 2.500 s: ray from (1.55, 1.55, 0.20) to (2.05, 1.55)
          inflation_layer: 100, near an obstacle; the nearest obstacle is cell (20, 15), 0.200 m away [inflation_layer.inflation_radius]
    "#]]
    .assert_eq(&told(&costmap, 1.85));
}

#[test]
fn lost_points_name_the_parameter() {
    let mut costmap = read(LOCAL, "local_costmap").0.build();
    look(&mut costmap, 0, &[[0.5, 0.0, 2.0], [0.5, 0.1, 2.0], [2.6, 0.0, 0.0], [1.6, 0.0, 0.0]]);
    look(&mut costmap, 1, &[]);
    let advice: Vec<String> = costmap.advice().iter().map(ToString::to_string).collect();
    expect![[r#"
        obstacle_layer.scan: 2 of 4 were above `max_obstacle_height` of the source, for marking and clearing (`obstacle_layer.scan.max_obstacle_height`): it is measured in the global frame and is 0 unless set; set it to the robot's height
        obstacle_layer.scan: 1 of 4 were too far away to mark (`obstacle_layer.scan.obstacle_max_range`): raise it, and `raytrace_max_range` beyond it
        obstacle_layer.scan: 1 of 4 were outside the costmap (`width`): enlarge the costmap to use them"#]]
    .assert_eq(&advice.join("\n"));
}

#[test]
fn mistakes_are_located_and_the_rest_is_built() {
    let config = check(
        "
local_costmap:
  local_costmap:
    ros__parameters:
      width: 3.0
      footprint: '[[1, 2], [3]]'
      plugins: [obstacle_layer, camera_layer, inflation_layer]
      obstacle_layer:
        plugin: nav2_costmap_2d::ObstacleLayer
        observation_sources: scan
        scan: {topic: /scan}
      camera_layer: {plugin: 'spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer', x: 1}
      inflation_layer:
        plugin: nav2_costmap_2d::InflationLayer
        inflaton_radius: 0.3
",
        expect![[r#"
            warning[not-whole]: `width` is written as 3.0, and must be a whole number
             --> params.yaml:5:14
              |
            5 |       width: 3.0
              |              ^^^
              |
              = note: Nav2 refuses to start with `parameter has invalid type`
            help: write `3`
              |
            5 -       width: 3.0
            5 +       width: 3
              |
            warning[nothing-fits]: `obstacle_layer.scan` accepts points from 0 m to 0 m: none, or hardly any
              --> params.yaml:10:30
               |
            10 |         observation_sources: scan
               |                              ^^^^
               |
               = note: heights are measured in the global frame; points outside are dropped for marking and clearing
               = help: set `obstacle_layer.scan.max_obstacle_height`, for example to 2.0
            error[unknown-plugin]: `camera_layer.plugin`: `spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer` is not a supported layer
              --> params.yaml:12:30
               |
            12 |       camera_layer: {plugin: 'spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer', x: 1}
               |                              ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
               |
               = note: the layer is left out, the others are built
            warning[unknown-parameter]: an inflation layer has no parameter `inflaton_radius`
              --> params.yaml:15:9
               |
            15 |         inflaton_radius: 0.3
               |         ^^^^^^^^^^^^^^^ this is ignored
               |
            help: did you mean `inflation_radius`?
               |
            15 |         inflation_radius: 0.3
               |               +
            error[bad-footprint]: `footprint`: a corner needs x and y, and one has 1 numbers
             --> params.yaml:6:18
              |
            6 |       footprint: '[[1, 2], [3]]'
              |                  ^^^^^^^^^^^^^^^
              |
              = note: `robot_radius` is used instead
              = help: write corners in order, such as "[[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]]"
        "#]],
    );
    let names: Vec<&str> = config.layers.iter().map(|layer| &*layer.name).collect();
    assert_eq!(names, ["obstacle_layer", "inflation_layer"]);
    assert_eq!(config.node.integer("width"), Some(3));
}

#[test]
fn a_file_of_ros_1_is_understood() {
    let config = check(
        "
local_costmap:
  global_frame: odom
  rolling_window: true
  footprint: [[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]]
  plugins:
    - {name: obstacles, type: 'costmap_2d::ObstacleLayer'}
    - {name: inflation, type: 'costmap_2d::InflationLayer'}
  obstacles:
    observation_sources: scan
    scan: {data_type: LaserScan, topic: /scan, max_obstacle_height: 2.0, obstacle_range: 2.0}
",
        expect![[r#"
            hint[ros1-name]: a list of names and types is the syntax of ROS 1
             --> params.yaml:6:3
              |
            6 |   plugins:
              |   ^^^^^^^
              |
              = help: in Nav2 `plugins` is a list of names, and each layer has a `plugin`
            hint[ros1-name]: `costmap_2d::ObstacleLayer` is a ROS 1 name
             --> params.yaml:7:31
              |
            7 |     - {name: obstacles, type: 'costmap_2d::ObstacleLayer'}
              |                               ^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
            help: Nav2 calls it `nav2_costmap_2d::ObstacleLayer`
              |
            7 -     - {name: obstacles, type: 'costmap_2d::ObstacleLayer'}
            7 +     - {name: obstacles, type: nav2_costmap_2d::ObstacleLayer}
              |
            hint[ros1-name]: `obstacles.scan.obstacle_range` is a ROS 1 name
              --> params.yaml:11:74
               |
            11 |     scan: {data_type: LaserScan, topic: /scan, max_obstacle_height: 2.0, obstacle_range: 2.0}
               |                                                                          ^^^^^^^^^^^^^^
               |
            help: Nav2 calls it `obstacle_max_range`
               |
            11 |     scan: {data_type: LaserScan, topic: /scan, max_obstacle_height: 2.0, obstacle_max_range: 2.0}
               |                                                                                   ++++
            hint[ros1-name]: `costmap_2d::InflationLayer` is a ROS 1 name
             --> params.yaml:8:31
              |
            8 |     - {name: inflation, type: 'costmap_2d::InflationLayer'}
              |                               ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
            help: Nav2 calls it `nav2_costmap_2d::InflationLayer`
              |
            8 -     - {name: inflation, type: 'costmap_2d::InflationLayer'}
            8 +     - {name: inflation, type: nav2_costmap_2d::InflationLayer}
              |
        "#]],
    );
    let scan = config.layers[0].sources[0].settings();
    assert_eq!(scan.marks.max_m, 2.0);
    assert_eq!(config.footprint.points().len(), 4);
}

#[test]
fn the_last_value_applies() {
    let text =
        "/**:\n  ros__parameters:\n    resolution: 0.1\n    resolution: 0.2\n    plugins: []\n";
    let (config, said) = read(text, "local_costmap");
    assert_eq!(config.info().resolution_m, 0.2);
    assert!(said.contains("`resolution` is set twice; the last value applies"), "{said}");
}

#[test]
fn the_tutorial_file_needs_no_change() {
    let shared = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    let file =
        shared.join("navigation2_tutorials@humble/sam_bot_description/config/nav2_params.yaml");
    let Ok(text) = read_file(&file) else {
        println!("SKIPPED: {} is not there", file.display());
        return;
    };
    for (node, layers) in [
        ("local_costmap", &["voxel_layer", "inflation_layer"][..]),
        ("global_costmap", &["static_layer", "obstacle_layer", "inflation_layer"][..]),
    ] {
        let (config, said) = read(&text, node);
        let names: Vec<&str> = config.layers.iter().map(|layer| &*layer.name).collect();
        assert_eq!(names, layers);
        assert!(!said.contains("error"), "{said}");
    }
}

#[expect(clippy::disallowed_methods, reason = "a test that reads a file")]
fn read_file(path: &std::path::Path) -> std::io::Result<String> {
    std::fs::read_to_string(path)
}

fn map(width: usize, height: usize, cells: Vec<i8>, origin: Pose2) -> OccupancyGrid {
    Grid { info: GridInfo { resolution_m: 1.0, width, height, origin }, cells }
}

#[test]
fn a_map_sets_the_size_and_changes_once() {
    let (config, _) = read(
        "/**:\n  ros__parameters:\n    plugins: [static_layer]\n    static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'}\n",
        "global_costmap",
    );
    let mut costmap = config.build();
    let robot = Pose2::new(0.5, 0.5, 0.0);
    assert_eq!(costmap.update(0, robot, &NoTransforms), None, "no map was received");
    let layer = costmap.find_as::<StaticLayer>("static_layer").unwrap();
    layer.set_map(map(3, 2, vec![0, 100, 0, 0, 0, -1], Pose2::IDENTITY), "map").unwrap();
    assert!(costmap.update(1, robot, &NoTransforms).is_some());
    assert_eq!(costmap.costmap().costs(), [0, 254, 0, 0, 0, 0]);
    assert_eq!(costmap.update(2, robot, &NoTransforms), None, "nothing has changed");
    // A smaller map replaces it.
    let layer = costmap.find_as::<StaticLayer>("static_layer").unwrap();
    layer.set_map(map(1, 2, vec![100, 0], Pose2::IDENTITY), "map").unwrap();
    costmap.update(3, robot, &NoTransforms);
    assert_eq!(costmap.costmap().costs(), [254, 0]);
}

#[test]
fn the_rotation_of_a_map_is_applied() {
    let (config, _) = read(
        "/**:\n  ros__parameters:\n    plugins: [static_layer]\n    static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'}\n",
        "global_costmap",
    );
    let mut costmap = config.build();
    let turned = Pose2::new(10.0, 0.0, std::f64::consts::FRAC_PI_2);
    let layer = costmap.find_as::<StaticLayer>("static_layer").unwrap();
    layer.set_map(map(3, 1, vec![0, 0, 100], turned), "map").unwrap();
    costmap.update(0, Pose2::IDENTITY, &NoTransforms);
    assert_eq!(costmap.cost_at(Pose2::new(9.5, 2.5, 0.0), false), 254, "the row runs up");
    assert_eq!(costmap.cost_at(Pose2::new(9.5, 0.5, 0.0), false), 0);
}

#[test]
fn malformed_maps_are_rejected() {
    let (config, _) = read(
        "/**:\n  ros__parameters:\n    plugins: [static_layer]\n    static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'}\n",
        "global_costmap",
    );
    let mut costmap = config.build();
    let layer = costmap.find_as::<StaticLayer>("static_layer").unwrap();
    let good = map(2, 2, vec![0; 4], Pose2::IDENTITY);
    let mut short = good.clone();
    short.cells.pop();
    assert_eq!(
        layer.set_map(short, "map"),
        Err(MapError::CellCount { count: 3, width: 2, height: 2 })
    );
    assert!(layer.set_map(good.clone(), "").is_err());
    let mut fine = good.clone();
    fine.info.resolution_m = 1e-9;
    assert!(layer.set_map(fine, "map").is_err());
    let mut lost = good;
    lost.info.origin.x_m = f64::NAN;
    assert!(layer.set_map(lost, "map").is_err());
}

#[test]
fn zones_are_not_inflated_and_appear_at_once() {
    let (config, said) = read(
        "/**:\n  ros__parameters:\n    resolution: 1.0\n    plugins: [inflation_layer]\n    inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer'}\n    filters: [zones]\n    zones: {plugin: 'nav2_costmap_2d::KeepoutFilter', filter_info_topic: /info}\n",
        "local_costmap",
    );
    assert_eq!(said, "");
    let mut costmap = config.build();
    let robot = Pose2::new(0.5, 0.5, 0.0);
    costmap.update(0, robot, &NoTransforms);
    let filter = costmap.find_as::<KeepoutFilter>("zones").unwrap();
    let grid = map(1, 1, vec![100], Pose2::new(2.0, 2.0, 0.0));
    filter.set_mask(FilterMask { grid, frame: "map".to_owned() });
    for now_ns in 1..4 {
        costmap.update(now_ns, robot, &NoTransforms);
        let lethal = costmap.costmap().costs().iter().filter(|cost| **cost == 254).count();
        let other = costmap.costmap().costs().iter().filter(|cost| **cost != 0).count();
        assert_eq!((lethal, other), (1, 1));
    }
}

#[test]
fn clearing_lasts_until_the_next_observation() {
    let mut costmap = read(LOCAL, "local_costmap").0.build();
    look(&mut costmap, 0, &[[0.5, 0.0, 0.0]]);
    let around = Region::Around { x_m: 1.55, y_m: 1.55, side_m: 2.0 };
    assert!(clear(&mut costmap, around, &["inflation_layer".to_owned()]).is_err());
    clear(&mut costmap, around, &[]).unwrap();
    assert!(!costmap.is_current(1));
    let source = costmap.source_mut("obstacle_layer", "scan").unwrap();
    source.insert(1, 1, Pose::IDENTITY, DVec3::new(1.55, 1.55, 0.2), []);
    costmap.update(1, Pose2::new(1.55, 1.55, 0.0), &NoTransforms);
    assert_eq!(costmap.cost_at(Pose2::new(2.05, 1.55, 0.0), false), 0);
    assert!(costmap.is_current(1));
}

#[test]
fn a_sensor_outside_is_reported_once() {
    let mut costmap = read(LOCAL, "local_costmap").0.build();
    for now_ns in 0..3 {
        let source = costmap.source_mut("obstacle_layer", "scan").unwrap();
        source.insert(
            now_ns,
            now_ns,
            Pose::IDENTITY,
            DVec3::new(-1.0, 0.0, 0.2),
            [[1.0, 1.0, 0.2]],
        );
        costmap.update(now_ns, Pose2::new(1.0, 1.0, 0.0), &NoTransforms);
    }
    let said: Vec<String> = costmap.diagnostics().iter().map(|one| one.message.clone()).collect();
    assert_eq!(
        said,
        [
            "sensor origin at (-1.00, 0.00) is out of map bounds (0.00, 0.00) to (3.00, 3.00); the costmap cannot raytrace for it"
        ]
    );
    let outside = costmap.source_mut("obstacle_layer", "scan").unwrap().counters.sensor_outside;
    assert_eq!(outside, 3);
}

#[test]
fn a_sonar_marks_and_clears() {
    let (config, said) = read(
        "/**:\n  ros__parameters:\n    resolution: 0.1\n    plugins: [sonar]\n    sonar: {plugin: 'nav2_costmap_2d::RangeSensorLayer', topics: [/sonar], clear_on_max_reading: true}\n",
        "local_costmap",
    );
    assert_eq!(said, "");
    let mut costmap = config.build();
    let read_range = |costmap: &mut LayeredCostmap, range_m, now_ns| {
        let layer = costmap.find_as::<RangeLayer>("sonar").unwrap();
        layer.insert(RangeReading {
            global_from_sensor: Pose::from_xyz(1.05, 1.05, 0.0),
            range_m,
            min_range_m: 0.1,
            max_range_m: 2.0,
            field_of_view_rad: 0.2,
        });
        costmap.update(now_ns, Pose2::new(1.05, 1.05, 0.0), &NoTransforms);
    };
    let cost = |costmap: &LayeredCostmap| costmap.cost_at(Pose2::new(1.55, 1.05, 0.0), false);
    read_range(&mut costmap, 0.5, 0);
    assert_eq!(cost(&costmap), 254);
    read_range(&mut costmap, 2.0, 1);
    assert_eq!(cost(&costmap), 0, "nothing in sight");
    read_range(&mut costmap, f64::NAN, 2);
    read_range(&mut costmap, 5.0, 3);
    assert_eq!(cost(&costmap), 0, "readings outside the limits are ignored");
}

#[test]
fn parameters_change_while_it_runs() {
    let (mut config, _) = read(LOCAL, "local_costmap");
    let mut costmap = config.build();
    look(&mut costmap, 0, &[[0.5, 0.0, 0.0]]);
    let mut values = config.node.clone();
    values.set("robot_radius", periplus_params::ParamValue::Number(0.35));
    config.change(&mut costmap, values.clone(), &NoTransforms).unwrap();
    look(&mut costmap, 1, &[[0.5, 0.0, 0.0]]);
    assert_eq!(costmap.cost_at(Pose2::new(1.75, 1.55, 0.0), false), 253, "now within the robot");
    values.set("rolling_window", periplus_params::ParamValue::Bool(true));
    let refused = config.change(&mut costmap, values, &NoTransforms).unwrap_err();
    assert_eq!(refused.to_string(), "`rolling_window` cannot be changed while the costmap runs");
    assert_eq!(config.compat, Nav2Release::Main);
}

#[test]
fn missing_parameters_are_located() {
    let told = |text: &str| {
        let mut sources = SourceMap::new();
        let file = sources.add("params.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).expect("YAML").expect("something");
        let mut diagnostics = Diagnostics::new();
        CostmapConfig::read_yaml(&tree, "local_costmap", None, &mut diagnostics);
        let place = |finding: &periplus_diagnostics::Diagnostic| {
            finding.span.map_or(0, |span| sources.locate(span).1.line)
        };
        diagnostics.iter().map(|one| (one.code, place(one))).collect::<Vec<_>>()
    };
    let text = "
local_costmap:
  local_costmap:
    ros__parameters:
      robot_radius: 0.0
      plugins: [nameless, blind]
      filters: [keepout]
      blind:
        plugin: nav2_costmap_2d::ObstacleLayer
      keepout:
        plugin: nav2_costmap_2d::KeepoutFilter
";
    assert_eq!(
        told(text),
        [("no-plugin", 6), ("no-sources", 9), ("missing-parameter", 11), ("empty-footprint", 5)]
    );
    let large = "
local_costmap:
  local_costmap:
    ros__parameters: {plugins: [], resolution: 0.01, width: 1000000, height: 1000000}
";
    assert_eq!(told(large), [("bad-size", 4)]);
}
