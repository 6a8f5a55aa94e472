//! Costmaps on a graph, as other nodes see them.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use std::sync::Arc;

use periplus_costmap::{CostmapConfig, LayeredCostmap, Nav2Release};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{
    Arguments, Graph, LifecycleNode, Mailbox, Node, NodeSettings, ParameterFileError, Publisher,
    Qos,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus};
use periplus_msgs::geometry_msgs::{
    Polygon, PolygonStamped, PoseStamped, Quaternion, Transform, TransformStamped, Vector3,
};
use periplus_msgs::nav_msgs::{MapMetaData, OccupancyGrid, Odometry, Path};
use periplus_msgs::nav2_msgs::*;
use periplus_msgs::rcl_interfaces::{
    Log, Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::std_srvs::{SetBool, SetBoolRequest};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::visualization_msgs::Marker;
use periplus_msgs::{Service, map_msgs, nav2_msgs_main as main};
use periplus_nav_nodes::costmap_2d::{CostmapNode, VoxelMarkers};

const LOCAL: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      rolling_window: true
      width: 3
      height: 3
      resolution: 0.1
      update_frequency: 10.0
      publish_frequency: 10.0
      robot_radius: 0.1
      plugins: [voxel_layer, inflation_layer]
      voxel_layer:
        plugin: nav2_costmap_2d::VoxelLayer
        publish_voxel_map: true
        observation_sources: scan
        scan: {max_obstacle_height: 1.0, clearing: true, raytrace_max_range: 5.0}
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.3}
";

const GLOBAL: &str = "
global_costmap:
  global_costmap:
    ros__parameters:
      update_frequency: 10.0
      publish_frequency: 10.0
      plugins: [static_layer]
      static_layer: {plugin: 'nav2_costmap_2d::StaticLayer', subscribe_to_updates: true}
";

fn config(text: &str, node: &str, compat: Nav2Release) -> CostmapConfig {
    config_and_text(text, node, compat).0
}

fn config_and_text(text: &str, node: &str, compat: Nav2Release) -> (CostmapConfig, SourceMap) {
    let mut sources = SourceMap::new();
    let file = sources.add("params.yaml", text);
    let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
    let mut diagnostics = Diagnostics::new();
    let config = CostmapConfig::read_yaml(&tree, node, Some(compat), &mut diagnostics);
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.iter().next());
    (config, sources)
}

struct Stage {
    graph: Graph,
    user: Node,
    costmap: LifecycleNode<CostmapNode>,
    tf: Publisher<TFMessage>,
    scan: Publisher<LaserScan>,
    now_ns: i64,
}

impl Stage {
    fn new(text: &str, name: &str, compat: Nav2Release) -> Self {
        Self::on(Graph::new(), text, name, compat)
    }

    fn on(graph: Graph, text: &str, name: &str, compat: Nav2Release) -> Self {
        let costmap = CostmapNode::new(&graph, name, config(text, name, compat)).unwrap();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let tf = user.publisher("/tf", Qos::reliable(100)).unwrap();
        let scan = user.publisher("/scan", Qos::sensor_data()).unwrap();
        Self { graph, user, costmap, tf, scan, now_ns: 0 }
    }

    fn local() -> Self {
        let stage = Self::new(LOCAL, "local_costmap", Nav2Release::Main);
        stage.costmap.start();
        stage
    }

    fn stamp(&self) -> Time {
        Time { sec: 0, nanosec: 0 }.later(self.now_ns)
    }

    /// The robot is at x in `parent`.
    fn place(&self, parent: &str, x: f64) {
        let transform = |parent: &str, child: &str, [x, y, z]: [f64; 3]| TransformStamped {
            header: Header { stamp: self.stamp(), frame_id: parent.into() },
            child_frame_id: child.into(),
            transform: Transform {
                translation: Vector3 { x, y, z },
                rotation: Quaternion { w: 1.0, ..Quaternion::default() },
            },
        };
        let transforms = vec![
            transform(parent, "base_link", [x, 0.05, 0.0]),
            transform("base_link", "laser", [0.0, 0.0, 0.2]),
        ];
        self.tf.publish(TFMessage { transforms });
    }

    /// Four beams, to the front, left, back and right.
    fn see(&self, ranges: [f32; 4]) {
        self.scan.publish(LaserScan {
            header: Header { stamp: self.stamp(), frame_id: "laser".into() },
            angle_increment: std::f32::consts::FRAC_PI_2,
            range_min: 0.1,
            range_max: 10.0,
            ranges: ranges.to_vec(),
            ..LaserScan::default()
        });
    }

    fn advance(&mut self, milliseconds: i64) {
        self.now_ns += milliseconds * 1_000_000;
        self.graph.advance_to(self.now_ns);
    }

    fn hear<T: periplus_msgs::Message>(&self, topic: &str) -> Mailbox<T> {
        self.user.mailbox(topic, Qos::latched(10)).unwrap()
    }

    fn ask<S: Service>(&self, name: &str, request: S::Request) -> Arc<S::Response> {
        let asked = self.user.client::<S>(name).unwrap().call(request);
        self.graph.settle();
        asked.take().unwrap().unwrap()
    }
}

trait Later {
    fn later(self, ns: i64) -> Self;
}

impl Later for Time {
    fn later(self, ns: i64) -> Self {
        Self { sec: (ns / 1_000_000_000) as i32, nanosec: (ns % 1_000_000_000) as u32 }
    }
}

/// The value of a grid at a point.
fn at(grid: &OccupancyGrid, x: f64, y: f64) -> i8 {
    let MapMetaData { resolution, width, origin, .. } = &grid.info;
    let column = ((x - origin.position.x) / f64::from(*resolution)) as usize;
    let row = ((y - origin.position.y) / f64::from(*resolution)) as usize;
    grid.data[row * *width as usize + column]
}

#[test]
fn an_obstacle_is_seen_published_and_cleared() {
    let mut stage = Stage::local();
    let grids = stage.hear::<OccupancyGrid>("/local_costmap/costmap");
    let updates = stage.hear::<map_msgs::OccupancyGridUpdate>("/local_costmap/costmap_updates");
    let markers = VoxelMarkers::new(&stage.graph, "/local_costmap").unwrap();
    let marker = "/local_costmap/visualization_marker";
    let cubes = stage.user.mailbox::<Marker>(marker, Qos::reliable(10)).unwrap();
    stage.advance(1);
    stage.place("odom", 0.05);
    stage.see([1.0, 9.0, 9.0, 9.0]);
    stage.advance(100);
    let grid = grids.latest().unwrap();
    assert_eq!((grid.info.width, grid.info.height), (30, 30));
    assert_eq!(grid.header.frame_id, "odom");
    assert_eq!(at(&grid, 1.05, 0.05), 100);
    assert!((1..100).contains(&at(&grid, 0.85, 0.05)));
    assert_eq!(cubes.latest().unwrap().points.len(), 1);
    // It goes away: a wall further off.
    stage.place("odom", 0.05);
    stage.see([1.4, 9.0, 9.0, 9.0]);
    stage.advance(100);
    assert!(grids.latest().is_none(), "only what has changed");
    let update = updates.latest().unwrap();
    assert!(update.data.contains(&100));
    assert_eq!(stage.costmap.with(|it| it.inspect(1.05, 0.05)).unwrap().cost, 0);
    // It rolls on: another grid.
    stage.place("odom", 1.05);
    stage.advance(100);
    assert!(grids.latest().unwrap().info.origin.position.x > -0.6);
    drop(markers);
}

#[test]
fn it_waits_for_the_robot_and_says_so() {
    let mut stage = Stage::local();
    stage.see([1.0; 4]);
    stage.advance(500);
    let status = stage.costmap.with(|it| it.status());
    assert_eq!(status.updates, 0);
    assert!(status.trouble.unwrap().contains("`base_link` to `odom`"));
    stage.place("odom", 0.0);
    stage.advance(100);
    let status = stage.costmap.with(|it| it.status());
    assert!(status.updates > 0 && status.trouble.is_none());
    assert_eq!(status.sources[0].1, "/scan", "beside the costmap, not in it");
    // The pose gets old.
    stage.advance(1000);
    assert!(stage.costmap.with(|it| it.status()).trouble.unwrap().contains("old"));
}

#[test]
fn readings_wait_for_their_frame_but_not_for_ever() {
    let mut stage = Stage::local();
    stage.advance(1);
    stage.see([1.0, 9.0, 9.0, 9.0]);
    stage.advance(200);
    // Its transform comes late, and it counts.
    stage.now_ns = 1_000_000;
    stage.place("odom", 0.05);
    stage.now_ns = 250_000_000;
    stage.place("odom", 0.05);
    stage.advance(100);
    assert_eq!(stage.costmap.with(|it| it.inspect(1.05, 0.05)).unwrap().cost, 254);
    // This frame never comes.
    stage.scan.publish(LaserScan {
        header: Header { stamp: stage.stamp(), frame_id: "nowhere".into() },
        ranges: vec![1.0],
        ..LaserScan::default()
    });
    for _ in 0..20 {
        stage.place("odom", 0.05);
        stage.advance(100);
    }
    let advice = stage.costmap.with(|it| it.status()).advice;
    assert!(advice.iter().any(|one| one.parameter.ends_with("scan.sensor_frame")), "{advice:?}");
}

/// Status of a part on `/diagnostics`: level, message and values.
struct Told {
    level: u8,
    message: String,
    values: Vec<(String, String)>,
}

impl Told {
    fn latest(all: &Mailbox<DiagnosticArray>, part: &str) -> Self {
        let array = all.latest().unwrap();
        let name = format!("local_costmap/local_costmap: {part}");
        let status = array.status.iter().find(|status| status.name == name).unwrap();
        let values = status.values.iter().map(|pair| (pair.key.clone(), pair.value.clone()));
        Self { level: status.level, message: status.message.clone(), values: values.collect() }
    }

    fn value(&self, key: &str) -> &str {
        self.values.iter().find(|(name, _)| name == key).map_or("", |(_, value)| value)
    }
}

#[test]
fn diagnostics_name_what_is_wrong_and_the_parameter() {
    let mut stage = Stage::new(LOCAL, "local_costmap", Nav2Release::Main);
    let all = stage.user.mailbox::<DiagnosticArray>("/diagnostics", Qos::reliable(10)).unwrap();
    let part = "voxel_layer.scan";
    stage.advance(1000);
    let idle = Told::latest(&all, "costmap");
    assert_eq!(idle.level, DiagnosticStatus::WARN);
    assert!(idle.message.contains("activates"), "{}", idle.message);
    stage.costmap.start();
    stage.advance(1000);
    let array = all.latest().unwrap();
    let levels: Vec<u8> = array.status.iter().map(|status| status.level).collect();
    assert_eq!(levels, [DiagnosticStatus::ERROR, DiagnosticStatus::ERROR]);
    assert!(array.status[0].message.contains("`base_link` to `odom`"), "{array:?}");
    assert!(
        array.status[1].message.contains("no message came on /scan (`voxel_layer.scan.topic`)")
    );
    // One second of scans with a frame, and stamps that are later than now.
    let see = |stage: &mut Stage, frame: &str, late_ns: i64| {
        for _ in 0..10 {
            stage.place("odom", 0.05);
            stage.scan.publish(LaserScan {
                header: Header {
                    stamp: Time::of_ns(stage.now_ns + late_ns),
                    frame_id: frame.into(),
                },
                angle_increment: std::f32::consts::FRAC_PI_2,
                range_min: 0.1,
                range_max: 10.0,
                ranges: vec![1.0, 9.0, f32::INFINITY, 1.2],
                ..LaserScan::default()
            });
            stage.advance(100);
        }
    };
    see(&mut stage, "laser", 0);
    let fine = Told::latest(&all, part);
    assert_eq!((fine.level, fine.message.as_str()), (DiagnosticStatus::OK, "20 points marked"));
    assert_eq!((fine.value("messages"), fine.value("points")), ("10", "30"));
    assert_eq!(fine.value("points dropped by range"), "10");
    assert!(fine.value("voxel_layer.scan.inf_is_valid").starts_with("10 of 40 had no return"));
    // A scanner above what the source takes.
    let parameters = vec![Parameter {
        name: "voxel_layer.scan.max_obstacle_height".into(),
        value: ParameterValue {
            r#type: ParameterType::PARAMETER_DOUBLE,
            double_value: 0.1,
            ..ParameterValue::default()
        },
    }];
    let set = "/local_costmap/local_costmap/set_parameters";
    stage.ask::<SetParameters>(set, SetParametersRequest { parameters });
    see(&mut stage, "laser", 0);
    let high = Told::latest(&all, part);
    assert_eq!(high.level, DiagnosticStatus::ERROR);
    assert!(
        high.message.starts_with("30 of 30 were above `max_obstacle_height` of the source"),
        "{}",
        high.message
    );
    assert!(high.message.contains("(`voxel_layer.scan.max_obstacle_height`)"));
    assert_eq!(high.value("points dropped by height"), "30");
    // An unknown frame, and a clock that is ahead.
    for (frame, late_ns, parameter, key) in [
        ("nowhere", 0, "voxel_layer.scan.sensor_frame", "messages dropped by frame"),
        ("laser", 900_000_000_000, "use_sim_time", "messages dropped by time"),
    ] {
        see(&mut stage, frame, late_ns);
        see(&mut stage, frame, late_ns);
        see(&mut stage, frame, late_ns);
        let lost = Told::latest(&all, part);
        assert_eq!(lost.level, DiagnosticStatus::ERROR, "{}", lost.message);
        assert!(lost.message.contains(parameter), "{}", lost.message);
        assert_ne!(lost.value(key), "0");
    }
    // Silence; what waited is dropped first.
    for _ in 0..80 {
        stage.place("odom", 0.05);
        stage.advance(100);
    }
    assert_eq!(Told::latest(&all, "costmap").level, DiagnosticStatus::OK);
    let mut quiet = Stage::local();
    let all = quiet.user.mailbox::<DiagnosticArray>("/diagnostics", Qos::reliable(10)).unwrap();
    see(&mut quiet, "laser", 0);
    for _ in 0..60 {
        quiet.place("odom", 0.05);
        quiet.advance(100);
    }
    let silent = Told::latest(&all, part);
    assert_eq!(silent.level, DiagnosticStatus::STALE);
    assert!(silent.message.starts_with("silent on /scan for 6."), "{}", silent.message);
}

#[test]
fn diagnostics_say_that_a_map_is_missing() {
    let mut stage = Stage::new(GLOBAL, "global_costmap", Nav2Release::Main);
    let all = stage.user.mailbox::<DiagnosticArray>("/diagnostics", Qos::reliable(10)).unwrap();
    stage.costmap.start();
    for _ in 0..10 {
        stage.place("map", 0.2);
        stage.advance(100);
    }
    let status = &all.latest().unwrap().status[0];
    assert_eq!(status.level, DiagnosticStatus::WARN);
    let expected = "`static_layer` waits for a map on /map (`static_layer.map_topic`)";
    assert_eq!(status.message, expected);
}

const NARROW: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      rolling_window: true
      width: 1
      height: 1
      update_frequency: 10.0
      plugins: [static_layer, obstacle_layer]
      static_layer:
        plugin: nav2_costmap_2d::StaticLayer
        map_topic: /plan_of_the_house
      obstacle_layer:
        plugin: nav2_costmap_2d::ObstacleLayer
        observation_sources: scan
        scan: {topic: /scan, max_obstacle_height: 1.0, clearing: true}
";

#[test]
fn what_goes_wrong_while_it_runs_names_parameter_file_and_line() {
    let mut stage = Stage::new(NARROW, "local_costmap", Nav2Release::Main);
    let (_, text) = config_and_text(NARROW, "local_costmap", Nav2Release::Main);
    stage.costmap.with(|it| it.name_lines_of(text));
    let log = stage.user.mailbox::<Log>("/rosout", Qos::reliable(100)).unwrap();
    let said = |words: &str, place: &str| {
        let lines: Vec<String> = log.drain().iter().map(|line| line.msg.clone()).collect();
        let found = lines.iter().any(|line| line.contains(words) && line.contains(place));
        assert!(found, "`{words}` at {place} is not in {lines:?}");
    };
    stage.costmap.start();
    stage.advance(100);
    said("`base_link` to `odom`", "check `robot_base_frame`");
    let maps =
        stage.user.publisher::<OccupancyGrid>("/plan_of_the_house", Qos::latched(1)).unwrap();
    maps.publish(OccupancyGrid {
        info: MapMetaData { resolution: 0.5, width: 3, height: 2, ..MapMetaData::default() },
        data: vec![0; 5],
        ..OccupancyGrid::default()
    });
    stage.place("odom", 0.05);
    stage.advance(100);
    said("(`static_layer.map_topic`) is refused: it has 5 cells", "(params.yaml:13)");
    // The scanner is 2 m ahead of a costmap of 1 m.
    let mut far = TransformStamped {
        header: Header { stamp: stage.stamp(), frame_id: "odom".into() },
        child_frame_id: "far".into(),
        ..TransformStamped::default()
    };
    far.transform.translation.x = 2.0;
    far.transform.rotation.w = 1.0;
    stage.tf.publish(TFMessage { transforms: vec![far] });
    let see = |stage: &Stage, frame: &str| {
        stage.scan.publish(LaserScan {
            header: Header { stamp: stage.stamp(), frame_id: frame.into() },
            range_max: 10.0,
            ranges: vec![1.0],
            ..LaserScan::default()
        });
    };
    see(&stage, "far");
    stage.place("odom", 0.05);
    stage.advance(100);
    said("out of map bounds", "(params.yaml:17)");
    see(&stage, "nowhere");
    for _ in 0..15 {
        stage.place("odom", 0.05);
        stage.advance(100);
    }
    said("in frame `nowhere` are dropped", "(params.yaml:17)");
}

#[test]
fn it_is_managed() {
    let mut stage = Stage::new(LOCAL, "local_costmap", Nav2Release::Main);
    stage.place("odom", 0.0);
    stage.advance(500);
    assert!(stage.costmap.with(|it| it.costmap().map(|_| ())).is_none(), "not configured");
    stage.costmap.start();
    stage.advance(1);
    stage.place("odom", 0.0);
    stage.advance(200);
    assert!(stage.costmap.with(|it| it.status()).updates > 0);
    assert!(stage.costmap.lifecycle().is_active());
}

#[test]
fn services_answer() {
    let mut stage = Stage::local();
    stage.advance(1);
    stage.place("odom", 0.05);
    stage.see([1.0, 9.0, 9.0, 9.0]);
    stage.advance(100);
    let grid = stage.ask::<GetCostmap>("/local_costmap/get_costmap", GetCostmapRequest::default());
    assert!(grid.map.data.contains(&254));
    let layer =
        stage.ask::<GetCostmap>("/local_costmap/get_voxel_layer", GetCostmapRequest::default());
    assert_eq!(layer.map.data.iter().filter(|cost| **cost == 254).count(), 1);
    let mut request = GetCostsRequest { use_footprint: false, poses: vec![] };
    for (frame, x) in [("odom", 1.05), ("base_link", 1.0), ("odom", 99.0), ("mars", 0.0)] {
        let mut pose = periplus_msgs::geometry_msgs::PoseStamped::default();
        pose.header.frame_id = frame.into();
        (pose.pose.position.x, pose.pose.position.y) = (x, 0.0);
        if frame == "odom" {
            pose.pose.position.y = 0.05;
        }
        request.poses.push(pose);
    }
    let costs = stage.ask::<GetCosts>("/local_costmap/get_cost_local_costmap", request);
    assert_eq!((costs.costs.as_slice(), costs.success), (&[254.0, 254.0, 254.0, 255.0][..], false));
    let around = "/local_costmap/clear_around_local_costmap";
    let clear = |stage: &Stage, plugins: &[&str]| {
        let plugins = plugins.iter().map(|&name| name.to_owned()).collect();
        let request = main::ClearCostmapAroundRobotRequest { reset_distance: 5.0, plugins };
        stage.ask::<main::ClearCostmapAroundRobot>(around, request).success
    };
    assert!(
        !clear(&stage, &["voxel_layer", "inflation_layer"]),
        "the inflation layer is not clearable"
    );
    assert!(clear(&stage, &["voxel_layer"]));
    stage.place("odom", 0.05);
    stage.see([9.0; 4]);
    stage.advance(100);
    assert_ne!(stage.costmap.with(|it| it.inspect(1.05, 0.05)).unwrap().cost, 254);
}

#[test]
fn older_distributions_have_other_forms() {
    let mut stage = Stage::new(LOCAL, "local_costmap", Nav2Release::Humble);
    stage.costmap.start();
    stage.place("odom", 0.05);
    stage.advance(200);
    assert_eq!(stage.costmap.with(|it| it.status()).sources[0].1, "/local_costmap/scan");
    let request = GetCostRequest { x: 0.0, y: 0.0, ..GetCostRequest::default() };
    let answer = stage.ask::<GetCost>("/local_costmap/get_cost_local_costmap", request);
    assert_eq!(answer.cost, 0.0);
    let services = stage.graph.services();
    assert!(services.iter().all(|one| !one.name.contains("clear_around_pose")));
    assert!(stage.graph.topics().iter().all(|topic| topic.name != "/local_costmap/voxel_layer"));
}

#[test]
fn jazzy_answers_minus_one_outside_and_kilted_has_forms_of_both() {
    let mut stage = Stage::new(LOCAL, "local_costmap", Nav2Release::Jazzy);
    stage.costmap.start();
    stage.place("odom", 0.05);
    stage.advance(200);
    let request = GetCostRequest { x: 99.0, y: 0.0, ..GetCostRequest::default() };
    let answer = stage.ask::<GetCost>("/local_costmap/get_cost_local_costmap", request);
    assert_eq!(answer.cost, -1.0);

    let mut stage = Stage::new(LOCAL, "local_costmap", Nav2Release::Kilted);
    stage.costmap.start();
    stage.place("odom", 0.05);
    stage.advance(200);
    assert_eq!(stage.costmap.with(|it| it.status()).sources[0].1, "/scan");
    let mut pose = periplus_msgs::geometry_msgs::PoseStamped::default();
    pose.header.frame_id = "odom".into();
    pose.pose.position.x = 99.0;
    let request = GetCostsRequest { use_footprint: false, poses: vec![pose] };
    let answer = stage.ask::<GetCosts>("/local_costmap/get_cost_local_costmap", request);
    assert_eq!((answer.costs.as_slice(), answer.success), (&[254.0][..], false));
    let services = stage.graph.services();
    let find = |name: &str| services.iter().find(|one| one.name.ends_with(name));
    let entirely = find("clear_entirely_local_costmap").unwrap();
    assert_eq!(entirely.type_hash.as_deref(), Some(ClearEntireCostmap::TYPE_HASH));
    assert!(find("clear_around_pose_local_costmap").is_none());
}

#[test]
fn the_frame_of_the_robot_must_have_a_transform() {
    let mut stage = Stage::local();
    stage.advance(1);
    stage.place("odom", 0.05);
    stage.advance(200);
    let set = |stage: &Stage, frame: &str| {
        let value = ParameterValue {
            r#type: ParameterType::PARAMETER_STRING,
            string_value: frame.into(),
            ..ParameterValue::default()
        };
        let parameters = vec![Parameter { name: "robot_base_frame".into(), value }];
        let name = "/local_costmap/local_costmap/set_parameters";
        let answer = stage.ask::<SetParameters>(name, SetParametersRequest { parameters });
        answer.results[0].clone()
    };
    let refused = set(&stage, "nowhere");
    assert!(!refused.successful);
    assert!(refused.reason.contains("no transform from `nowhere` to `odom`"), "{}", refused.reason);
    let before = stage.costmap.with(|it| it.status()).updates;
    stage.place("odom", 0.05);
    stage.advance(400);
    assert!(stage.costmap.with(|it| it.status()).updates > before, "the costmap goes on");
    assert!(set(&stage, "odom").successful);
}

#[test]
fn without_a_word_services_have_the_messages_of_jazzy() {
    let mut diagnostics = Diagnostics::new();
    let untold = CostmapConfig::read([], None, &mut diagnostics);
    assert_eq!((untold.compat, untold.forms), (Nav2Release::Main, Nav2Release::Jazzy));
    let graph = Graph::new();
    let _costmap = CostmapNode::new(&graph, "global_costmap", untold).unwrap();
    let hash = |name: &str| {
        let services = graph.services();
        let found = services.into_iter().find(|one| one.name == format!("/global_costmap/{name}"));
        found.and_then(|one| one.type_hash).unwrap()
    };
    assert_eq!(hash("clear_entirely_global_costmap"), ClearEntireCostmap::TYPE_HASH);
    assert_eq!(hash("clear_around_pose_global_costmap"), ClearCostmapAroundPose::TYPE_HASH);
    assert_eq!(hash("get_cost_global_costmap"), GetCost::TYPE_HASH);
    assert_ne!(ClearEntireCostmap::TYPE_HASH, main::ClearEntireCostmap::TYPE_HASH);
}

const SLOW: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      rolling_window: true
      update_frequency: 10.0
      plugins: [obstacle_layer]
      filters: [slow]
      obstacle_layer: {plugin: 'nav2_costmap_2d::ObstacleLayer', observation_sources: scan, scan: {clearing: true, max_obstacle_height: 1.0}}
      slow:
        plugin: nav2_costmap_2d::SpeedFilter
        filter_info_topic: slow_info
        enable_path_lookahead: true
";

#[test]
fn a_limit_on_the_way_ahead_counts_when_braking_takes_as_far_and_filters_are_switched() {
    let mut stage = Stage::new(SLOW, "local_costmap", Nav2Release::Main);
    stage.costmap.start();
    let limits = stage.user.mailbox::<SpeedLimit>("/speed_limit", Qos::reliable(10)).unwrap();
    let info = stage.user.publisher::<CostmapFilterInfo>("/slow_info", Qos::latched(1)).unwrap();
    let masks = stage.user.publisher::<OccupancyGrid>("/slow_mask", Qos::latched(1)).unwrap();
    let paths = stage.user.publisher::<Path>("/plan", Qos::reliable(1)).unwrap();
    let odometry = stage.user.publisher::<Odometry>("/odom", Qos::reliable(1)).unwrap();
    let header = Header { stamp: Time::default(), frame_id: "odom".into() };
    info.publish(CostmapFilterInfo {
        r#type: 1,
        filter_mask_topic: "slow_mask".into(),
        base: 100.0,
        multiplier: -1.0,
        ..CostmapFilterInfo::default()
    });
    // Full speed for a metre, then 30 %.
    masks.publish(OccupancyGrid {
        header: header.clone(),
        info: MapMetaData { resolution: 1.0, width: 3, height: 1, ..MapMetaData::default() },
        data: vec![0, 70, 70],
    });
    let drive = |stage: &mut Stage, speed: f64| {
        let mut moving = Odometry::default();
        moving.twist.twist.linear.x = speed;
        odometry.publish(moving);
        let point = |x: f64| {
            let mut pose = PoseStamped { header: header.clone(), ..PoseStamped::default() };
            (pose.pose.position.x, pose.pose.position.y) = (x, 0.05);
            pose
        };
        let poses = (5..25).map(|step| point(f64::from(step) / 10.0)).collect();
        paths.publish(Path { header: header.clone(), poses });
        for _ in 0..3 {
            stage.place("odom", 0.5);
            stage.advance(100);
        }
        limits.latest().map(|limit| limit.speed_limit)
    };
    // At 0.5 m/s the braking distance is 0.25 m, at 1 m/s one metre.
    assert_eq!(drive(&mut stage, 0.5), None);
    assert_eq!(drive(&mut stage, 1.0), Some(30.0));
    let toggle = "/local_costmap/slow/toggle_filter";
    let answer = stage.ask::<SetBool>(toggle, SetBoolRequest { data: false });
    assert_eq!((answer.success, answer.message.as_str()), (true, "Disabled"));
    let off = |stage: &Stage| {
        let is_off = |costmap: &LayeredCostmap| {
            costmap.all().any(|layer| layer.name() == "slow" && !layer.is_enabled())
        };
        stage.costmap.with(|it| it.costmap().map(is_off)).unwrap()
    };
    assert!(off(&stage));
    stage.ask::<SetBool>(toggle, SetBoolRequest { data: true });
    assert!(!off(&stage));
}

#[test]
fn parameters_are_read_and_set() {
    let mut stage = Stage::local();
    stage.advance(1);
    stage.place("odom", 0.05);
    stage.see([1.0, 9.0, 9.0, 9.0]);
    stage.advance(100);
    let set = |stage: &Stage, name: &str, value: ParameterValue| {
        let parameters = vec![Parameter { name: name.into(), value }];
        let name = "/local_costmap/local_costmap/set_parameters";
        let answer = stage.ask::<SetParameters>(name, SetParametersRequest { parameters });
        answer.results[0].successful
    };
    let double = |double_value| ParameterValue {
        r#type: ParameterType::PARAMETER_DOUBLE,
        double_value,
        ..ParameterValue::default()
    };
    assert!(set(&stage, "inflation_layer.inflation_radius", double(0.6)));
    assert!(!set(&stage, "inflation_layer.inflation_radius", double(-1.0)));
    assert!(!set(&stage, "publish_frequency", double(-1.0)));
    assert!(set(&stage, "voxel_layer.scan.obstacle_max_range", double(0.5)));
    stage.place("odom", 0.05);
    stage.see([1.0, 9.0, 9.0, 9.0]);
    stage.advance(100);
    assert_ne!(
        stage.costmap.with(|it| it.inspect(0.55, 0.05)).unwrap().cost,
        0,
        "further than before"
    );
}

#[test]
fn a_map_sets_the_size_and_a_footprint_comes_by_topic() {
    let mut stage = Stage::new(GLOBAL, "global_costmap", Nav2Release::Main);
    stage.costmap.start();
    let maps = stage.user.publisher::<OccupancyGrid>("/map", Qos::latched(1)).unwrap();
    let outlines =
        stage.user.publisher::<Polygon>("/global_costmap/footprint", Qos::reliable(1)).unwrap();
    stage.advance(1);
    maps.publish(OccupancyGrid {
        header: Header { stamp: Time::default(), frame_id: "map".into() },
        info: MapMetaData { resolution: 0.5, width: 3, height: 2, ..MapMetaData::default() },
        data: vec![0, 100, 0, 0, 0, -1],
    });
    let point = |x, y| periplus_msgs::geometry_msgs::Point32 { x, y, z: 0.0 };
    let points = vec![point(1.0, 1.0), point(1.0, -1.0), point(-1.0, 0.0)];
    outlines.publish(Polygon { points });
    stage.place("map", 0.2);
    stage.advance(200);
    stage.place("map", 0.2);
    stage.advance(100);
    let (costs, corners) = stage
        .costmap
        .with(|it| {
            it.costmap().map(|costmap| {
                (costmap.costmap().costs().to_vec(), costmap.footprint().points().len())
            })
        })
        .unwrap();
    assert_eq!(costs, [0, 254, 0, 0, 0, 0]);
    assert_eq!(corners, 3);
}

/// Graph with parameter overrides, as from `--ros-args`.
fn overridden(words: &[&str]) -> Graph {
    let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
    let mut findings = Diagnostics::new();
    let no_file = &mut |_: &std::path::Path| Err(ParameterFileError::Missing);
    let arguments = Arguments::read(&words, &mut SourceMap::new(), &mut findings, no_file);
    assert!(findings.is_empty(), "{findings:?}");
    let graph = Graph::new();
    graph.set_arguments(arguments);
    graph
}

#[test]
fn arguments_select_the_type_of_the_footprint() {
    let other = {
        let config = config(LOCAL, "local_costmap", Nav2Release::Main);
        !config.params().subscribe_to_stamped_footprint
    };
    let graph = overridden(&["-p", &format!("subscribe_to_stamped_footprint:={other}")]);
    let stage = Stage::on(graph, LOCAL, "local_costmap", Nav2Release::Main);
    let topic = "/local_costmap/footprint";
    let is_stamped = stage.user.publisher::<PolygonStamped>(topic, Qos::reliable(1)).is_ok();
    assert_eq!(is_stamped, other, "the node subscribes to the type that its argument selects");
}

#[test]
fn arguments_apply_to_the_update_frequency() {
    let overrides = ["-p", "update_frequency:=2.0", "-p", "always_send_full_costmap:=true"];
    let graph = overridden(&overrides);
    let mut stage = Stage::on(graph, LOCAL, "local_costmap", Nav2Release::Main);
    stage.costmap.start();
    let costmaps = stage.hear::<OccupancyGrid>("/local_costmap/costmap");
    for _ in 0..20 {
        stage.place("odom", 0.0);
        stage.see([1.0; 4]);
        stage.advance(50);
    }
    let count = costmaps.drain().len();
    assert!((1..=3).contains(&count), "{count} costmaps in a second at 2 Hz");
}
