//! Collision monitor and detector as drivers and robots see them.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

mod stage;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{Graph, NodeSettings, Qos, Transition};
use periplus_msgs::geometry_msgs::{Point32, PolygonInstanceStamped, PolygonStamped};
use periplus_msgs::nav2_msgs::{
    AddExclusionZone, AddExclusionZoneRequest, CollisionDetectorState, CollisionMonitorState,
    Costmap, ExclusionZoneDescription, RemoveExclusionZone, RemoveExclusionZoneRequest, Toggle,
    ToggleRequest,
};
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2, PointField, Range};
use periplus_msgs::std_msgs::Float32;
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};
use periplus_msgs::{Message, Service};
use periplus_nav_nodes::collision_monitor::{
    CollisionDetectorNode, CollisionMonitorNode, MonitorConfig,
};
use periplus_params::Given;

use stage::{SCAN, STOP, Stage, config};

/// Response of a service.
fn call<S: Service>(stage: &Stage, name: &str, request: S::Request) -> S::Response {
    let pending = stage.user.client::<S>(name).unwrap().call(request);
    stage.graph.settle();
    (*pending.take().unwrap().unwrap()).clone()
}

fn corners(all: &[[f32; 2]]) -> Vec<Point32> {
    all.iter().map(|[x, y]| Point32 { x: *x, y: *y, z: 0.0 }).collect()
}

#[test]
fn points_in_a_zone_stop_the_robot() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        // The flat list of Humble is accepted by all.
        let flat = [("Stop.points", "[0.5, 0.5, 0.5, -0.5, -0.5, -0.5, -0.5, 0.5]")];
        let stage = Stage::of(release, &[&STOP, &SCAN, &flat]);
        stage.scan(0.6);
        assert_eq!(stage.command([0.5, 0.1, 0.2]), Some([0.5, 0.1, 0.2]), "{release}");
        stage.scan(0.4);
        assert_eq!(stage.command([0.5, 0.1, 0.2]), Some([0.0; 3]), "{release}");
        stage.scan(f32::INFINITY);
        assert_eq!(stage.command([0.5, 0.1, 0.2]), Some([0.5, 0.1, 0.2]), "{release}");
    }
}

#[test]
fn changes_are_reported_and_zeros_end_after_a_time() {
    let stage = Stage::new(&[&STOP, &SCAN]);
    stage.scan(0.4);
    assert_eq!(stage.speed(), 0.0);
    let state = stage.states.latest().unwrap();
    let expected = (CollisionMonitorState::STOP, "Stop");
    assert_eq!((state.action_type, state.polygon_name.as_str()), expected);
    stage.wait(1.0);
    stage.stand_at(0.0);
    assert_eq!(stage.command([1.0, 0.0, 0.0]), Some([0.0; 3]));
    assert!(stage.states.latest().is_none(), "nothing changed");
    stage.wait(0.1);
    stage.stand_at(0.0);
    assert_eq!(stage.command([1.0, 0.0, 0.0]), None, "`stop_pub_timeout` is over");
    stage.scan(2.0);
    assert_eq!(stage.speed(), 1.0);
    assert_eq!(stage.states.latest().unwrap().action_type, CollisionMonitorState::DO_NOTHING);
}

#[test]
fn a_silent_source_stops_the_robot() {
    let check = |release: Nav2Release, given: &[(&str, &str)], expected: [f64; 3]| {
        let stage = Stage::of(release, &[&STOP, &SCAN, given]);
        let before = stage.speed();
        stage.scan(2.0);
        assert_eq!(stage.speed(), 1.0);
        stage.wait(1.9);
        stage.stand_at(0.0);
        let still = stage.speed();
        stage.wait(0.2);
        stage.stand_at(0.0);
        assert_eq!([before, still, stage.speed()], expected, "{release} {given:?}");
    };
    check(Nav2Release::Main, &[], [0.0, 1.0, 0.0]);
    check(Nav2Release::Jazzy, &[], [0.0, 1.0, 0.0]);
    check(Nav2Release::Humble, &[], [1.0, 1.0, 1.0]);
    check(Nav2Release::Main, &[("scan.source_timeout", "1.0")], [0.0, 0.0, 0.0]);
    check(Nav2Release::Main, &[("scan.source_timeout", "0.0")], [1.0, 1.0, 1.0]);
    check(Nav2Release::Main, &[("scan.enabled", "false")], [1.0, 1.0, 1.0]);
    let stage = Stage::new(&[&STOP, &SCAN]);
    stage.speed();
    assert_eq!(stage.states.latest().unwrap().polygon_name, "invalid source");
    // Without transforms the data is of no use.
    stage.scan(2.0);
    stage.wait(0.5);
    assert_eq!(stage.speed(), 0.0);
}

#[test]
fn zones_slow_down_limit_and_approach() {
    let check = |given: &[(&str, &str)], range: f32, command: [f64; 3], expected: [f64; 3]| {
        let stage = Stage::new(&[&STOP, &SCAN, given]);
        stage.scan(range);
        let velocity = stage.command(command).unwrap();
        for (got, expected) in velocity.iter().zip(expected) {
            assert!((got - expected).abs() < 1e-9, "{velocity:?}, {given:?}");
        }
    };
    let slowdown = [("Stop.action_type", "slowdown"), ("Stop.slowdown_ratio", "0.3")];
    check(&slowdown, 0.4, [1.0, 0.0, 0.5], [0.3, 0.0, 0.15]);
    let limit = [("Stop.action_type", "limit"), ("Stop.linear_limit", "0.4")];
    check(&limit, 0.4, [0.5, 0.0, 0.2], [0.4, 0.0, 0.16]);
    let approach = [("Stop.action_type", "approach"), ("Stop.time_before_collision", "2.0")];
    // At 0.5 m/s the point at 0.73 m is inside after 0.46 s: in the fifth step of 0.1 s.
    check(&approach, 0.73, [0.5, 0.0, 0.0], [0.5 * 0.4 / 2.0, 0.0, 0.0]);
    let few = [("Stop.min_points", "2")];
    check(&few, 0.4, [0.5, 0.0, 0.0], [0.5, 0.0, 0.0]);
}

#[test]
fn a_zone_of_another_velocity_has_another_shape() {
    let parts = [
        ("Stop.type", "velocity_polygon"),
        ("Stop.velocity_polygons", "[slow, fast]"),
        ("Stop.slow.points", "[[0.3, 0.3], [0.3, -0.3], [-0.3, -0.3], [-0.3, 0.3]]"),
        ("Stop.slow.linear_min", "0.0"),
        ("Stop.slow.linear_max", "0.4"),
        ("Stop.slow.theta_min", "-1.0"),
        ("Stop.slow.theta_max", "1.0"),
        ("Stop.fast.points", "[[0.9, 0.3], [0.9, -0.3], [-0.3, -0.3], [-0.3, 0.3]]"),
        ("Stop.fast.linear_min", "0.4"),
        ("Stop.fast.linear_max", "2.0"),
        ("Stop.fast.theta_min", "-1.0"),
        ("Stop.fast.theta_max", "1.0"),
    ];
    let stage = Stage::new(&[&STOP, &SCAN, &parts]);
    stage.scan(0.6);
    assert_eq!(stage.command([0.2, 0.0, 0.0]).unwrap()[0], 0.2);
    assert_eq!(stage.command([0.8, 0.0, 0.0]).unwrap()[0], 0.0);
}

#[test]
fn the_monitor_can_be_switched_off() {
    let stage = Stage::new(&[&STOP, &SCAN]);
    stage.scan(0.4);
    assert_eq!(stage.speed(), 0.0);
    let response =
        call::<Toggle>(&stage, "collision_monitor/toggle", ToggleRequest { enable: false });
    assert!(response.success);
    assert_eq!(stage.speed(), 1.0);
    call::<Toggle>(&stage, "collision_monitor/toggle", ToggleRequest { enable: true });
    assert_eq!(stage.speed(), 0.0);
    assert!(stage.monitor.with(|monitor| monitor.is_enabled()));
}

#[test]
fn points_are_moved_by_the_motion_of_the_robot() {
    let check = |given: &[(&str, &str)], expected: f64| {
        let stage = Stage::new(&[&STOP, &SCAN, given]);
        stage.scan(0.8);
        stage.wait(0.1);
        // The point is 0.4 m ahead by now.
        stage.stand_at(0.4);
        assert_eq!(stage.speed(), expected);
    };
    check(&[], 0.0);
    check(&[("base_shift_correction", "false")], 1.0);
}

/// Speed after a source published a message that has an obstacle 0.4 m ahead.
fn sees<T: Message>(given: &[(&str, &str)], message: impl Fn(&Stage) -> T) -> f64 {
    let sources = [("observation_sources", "[sensor]"), ("sensor.topic", "sensor")];
    let stage = Stage::new(&[&STOP, &sources, given]);
    let publisher = stage.user.publisher::<T>("sensor", Qos::reliable(1)).unwrap();
    publisher.publish(message(&stage));
    stage.graph.settle();
    stage.speed()
}

fn cloud(stage: &Stage, height_m: f32) -> PointCloud2 {
    let field = |(index, name): (u32, &str)| PointField {
        name: name.to_owned(),
        offset: 4 * index,
        datatype: PointField::FLOAT32,
        count: 1,
    };
    PointCloud2 {
        header: stage.now("base_link"),
        height: 1,
        width: 1,
        fields: (0..).zip(["x", "y", "z"]).map(field).collect(),
        point_step: 12,
        row_step: 12,
        data: [0.4, 0.0, height_m].iter().flat_map(|it| it.to_le_bytes()).collect(),
        ..PointCloud2::default()
    }
}

fn range(stage: &Stage, range: f32) -> Range {
    let header = stage.now("base_link");
    Range { header, field_of_view: 0.2, min_range: 0.1, max_range: 3.0, range, ..Range::default() }
}

#[test]
fn all_kinds_of_sources_are_seen() {
    let clouds = [("sensor.type", "pointcloud")];
    assert_eq!(sees(&clouds, |stage| cloud(stage, 0.2)), 0.0);
    assert_eq!(sees(&clouds, |stage| cloud(stage, 0.6)), 1.0);
    let tall = [("sensor.type", "pointcloud"), ("sensor.max_height", "1.0")];
    assert_eq!(sees(&tall, |stage| cloud(stage, 0.6)), 0.0);
    let far = [("sensor.type", "pointcloud"), ("sensor.min_range", "0.5")];
    assert_eq!(sees(&far, |stage| cloud(stage, 0.2)), 1.0);

    let ranges = [("sensor.type", "range")];
    assert_eq!(sees(&ranges, |stage| range(stage, 0.4)), 0.0);
    assert_eq!(sees(&ranges, |stage| range(stage, 1.0)), 1.0);
    // Nothing in the cone, and an obstacle that is too close to be measured.
    assert_eq!(sees(&ranges, |stage| range(stage, f32::INFINITY)), 1.0);
    assert_eq!(sees(&ranges, |stage| range(stage, 0.05)), 0.0);

    let polygon = |stage: &Stage, x: f32| {
        let mut polygon =
            PolygonInstanceStamped { header: stage.now("odom"), ..Default::default() };
        polygon.polygon.polygon.points = corners(&[[x, -1.0], [x, 1.0], [3.0, 0.0]]);
        polygon
    };
    let polygons = [("sensor.type", "polygon")];
    assert_eq!(sees(&polygons, |stage| polygon(stage, 0.4)), 0.0);
    assert_eq!(sees(&polygons, |stage| polygon(stage, 0.6)), 1.0);

    let costmap = |stage: &Stage, cost: u8| {
        let mut costmap = Costmap { header: stage.now("odom"), ..Costmap::default() };
        costmap.metadata.resolution = 0.1;
        (costmap.metadata.size_x, costmap.metadata.size_y) = (1, 1);
        costmap.metadata.origin.position.x = 0.35;
        costmap.metadata.origin.orientation.w = 1.0;
        costmap.data = vec![cost];
        costmap
    };
    let costmaps = [("sensor.type", "costmap")];
    assert_eq!(sees(&costmaps, |stage| costmap(stage, 254)), 0.0);
    assert_eq!(sees(&costmaps, |stage| costmap(stage, 252)), 1.0);
    assert_eq!(sees(&costmaps, |stage| costmap(stage, 255)), 0.0);
}

#[test]
fn shapes_are_received() {
    let polygon = [("Stop.points", ""), ("Stop.polygon_sub_topic", "shape")];
    let stage = Stage::new(&[&STOP, &SCAN, &polygon]);
    stage.scan(0.8);
    assert_eq!(stage.speed(), 1.0, "there is no shape yet");
    let shapes = stage.user.publisher::<PolygonStamped>("shape", Qos::reliable(1)).unwrap();
    let mut shape = PolygonStamped { header: stage.now("odom"), ..PolygonStamped::default() };
    shape.polygon.points = corners(&[[1.0, 1.0], [1.0, -1.0], [-1.0, 0.0]]);
    shapes.publish(shape);
    stage.graph.settle();
    assert_eq!(stage.speed(), 0.0);

    let circle = [("Stop.type", "circle"), ("Stop.polygon_sub_topic", "radius")];
    let stage = Stage::new(&[&STOP, &SCAN, &circle]);
    stage.scan(0.8);
    assert_eq!(stage.speed(), 1.0);
    let radii = stage.user.publisher::<Float32>("radius", Qos::reliable(1)).unwrap();
    radii.publish(Float32 { data: 0.9 });
    stage.graph.settle();
    assert_eq!(stage.speed(), 0.0);

    let footprint =
        [("Stop.points", ""), ("Stop.action_type", "approach"), ("Stop.footprint_topic", "feet")];
    let stage = Stage::new(&[&STOP, &SCAN, &footprint]);
    stage.scan(0.8);
    assert_eq!(stage.speed(), 1.0);
    let feet = stage.user.publisher::<PolygonStamped>("feet", Qos::reliable(1)).unwrap();
    let mut outline = PolygonStamped { header: stage.now("odom"), ..PolygonStamped::default() };
    outline.polygon.points = corners(&[[0.2, 0.2], [0.2, -0.2], [-0.2, -0.2], [-0.2, 0.2]]);
    feet.publish(outline);
    stage.graph.settle();
    // 0.6 m at 1 m/s: the collision is in the seventh step, 0.6 s of 2 s.
    assert!((stage.speed() - 0.3).abs() < 0.051, "{}", stage.speed());
}

#[test]
fn exclusion_zones_hide_points() {
    let stage = Stage::new(&[&STOP, &SCAN]);
    stage.scan(0.4);
    assert_eq!(stage.speed(), 0.0);
    let zone = ExclusionZoneDescription {
        zone_name: "charger".to_owned(),
        r#type: "circle".to_owned(),
        radius: 0.5,
        enabled: true,
        ..ExclusionZoneDescription::default()
    };
    let add = "collision_monitor/scan/add_exclusion_zone";
    let request = || AddExclusionZoneRequest { zone: zone.clone() };
    assert!(call::<AddExclusionZone>(&stage, add, request()).success);
    assert_eq!(stage.speed(), 1.0);
    let again = call::<AddExclusionZone>(&stage, add, request());
    assert!(!again.success && again.message.contains("exists"), "{}", again.message);
    let remove = "collision_monitor/scan/remove_exclusion_zone";
    let request = RemoveExclusionZoneRequest { zone_name: "charger".to_owned(), remove_all: false };
    assert!(call::<RemoveExclusionZone>(&stage, remove, request.clone()).success);
    assert_eq!(stage.speed(), 0.0);
    assert!(!call::<RemoveExclusionZone>(&stage, remove, request).success);

    let named = [
        ("scan.exclusion_zones", "[dock]"),
        ("dock.enabled", "true"),
        ("dock.points", "[[0.3, 0.1], [0.5, 0.1], [0.5, -0.1], [0.3, -0.1]]"),
    ];
    let stage = Stage::new(&[&STOP, &SCAN, &named]);
    stage.scan(0.4);
    assert_eq!(stage.speed(), 1.0);
}

#[test]
fn points_and_shapes_are_displayed() {
    let visible = [("Stop.visualize", "true")];
    let stage = Stage::new(&[&STOP, &SCAN, &visible]);
    let mailbox = |topic: &str| stage.user.mailbox::<MarkerArray>(topic, Qos::reliable(1)).unwrap();
    let points = mailbox("collision_monitor/collision_points_marker");
    let triggering = mailbox("collision_monitor/triggering_points");
    let shapes = stage.user.mailbox::<PolygonStamped>("Stop", Qos::reliable(1)).unwrap();
    stage.scan(0.4);
    stage.speed();
    let markers = points.latest().unwrap();
    assert_eq!(markers.markers[0].ns, "collision_points_scan");
    assert!((markers.markers[0].points[0].x - 0.4).abs() < 1e-6);
    let markers = triggering.latest().unwrap();
    assert_eq!(markers.markers[0].action, Marker::DELETEALL);
    assert_eq!(markers.markers[1].ns, "Stop/scan");
    assert_eq!(shapes.latest().unwrap().polygon.points.len(), 4);
}

#[test]
fn mistakes_in_the_parameters_fail_to_configure() {
    let check = |release: Nav2Release, given: &[(&str, &str)]| {
        let graph = Graph::new();
        let all: [&[(&str, &str)]; 3] = [&STOP, &SCAN, given];
        let monitor = CollisionMonitorNode::new(&graph, config(release, &all)).unwrap();
        monitor.start();
        graph.settle();
        assert!(!monitor.lifecycle().is_active(), "{given:?}");
    };
    check(Nav2Release::Main, &[("Stop.action_type", "halt")]);
    check(Nav2Release::Humble, &[("Stop.action_type", "limit")]);
    check(Nav2Release::Main, &[("Stop.type", "square")]);
    check(Nav2Release::Main, &[("Stop.points", "[[1, 1], [1, -1], [-1, 0]]")]);
    check(Nav2Release::Main, &[("Stop.sources_names", "[lidar]")]);
    check(Nav2Release::Main, &[("scan.type", "sonar")]);
    check(Nav2Release::Jazzy, &[("scan.type", "costmap")]);
    check(Nav2Release::Main, &[("observation_sources", "[]")]);
    check(Nav2Release::Main, &[("scan.exclusion_zones", "[a]"), ("a.type", "circle")]);
}

#[test]
fn the_detector_reports_zones_with_points() {
    let graph = Graph::new();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let given: Vec<Given<'_>> = [
        ("base_frame_id", "base_link"),
        ("base_shift_correction", "false"),
        ("polygons", "[Near, Far]"),
        ("Near.type", "circle"),
        ("Near.radius", "0.5"),
        ("Near.action_type", "none"),
        ("Near.min_points", "1"),
        ("Far.type", "circle"),
        ("Far.radius", "2.0"),
        ("Far.action_type", "none"),
        ("Far.min_points", "1"),
        ("observation_sources", "[scan]"),
    ]
    .iter()
    .map(|(name, text)| Given::new(name, *text))
    .collect();
    let mut diagnostics = Diagnostics::new();
    let config = MonitorConfig::read_detector(given, None, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    let detector = CollisionDetectorNode::new(&graph, config).unwrap();
    let states = user
        .mailbox::<CollisionDetectorState>("collision_detector_state", Qos::reliable(100))
        .unwrap();
    let scans = user.publisher::<LaserScan>("scan", Qos::reliable(1)).unwrap();
    detector.start();
    graph.settle();
    let scan = LaserScan { range_max: 10.0, ranges: vec![1.0], ..LaserScan::default() };
    let header = periplus_msgs::std_msgs::Header::at(0, "base_link");
    scans.publish(LaserScan { header, ..scan });
    graph.advance_to(1_000_000_000);
    let all = states.drain();
    assert_eq!(all.len(), 10);
    assert_eq!(all[0].polygons, ["Near", "Far"]);
    assert_eq!(all[0].detections, [false, true]);
}

#[test]
fn a_monitor_that_is_stopped_stops_the_robot() {
    for transition in [Transition::Deactivate, Transition::Shutdown] {
        for (range, stopped) in [(2.0, Some([0.0; 3])), (0.4, None)] {
            let stage = Stage::new(&[&STOP, &SCAN]);
            stage.scan(range);
            // A robot that stands is left alone.
            assert_eq!(stage.speed() > 0.0, stopped.is_some());
            stage.monitor.lifecycle().change(transition);
            stage.graph.settle();
            assert_eq!(stage.command([1.0, 0.0, 0.0]), stopped, "{transition:?} {range}");
            assert_eq!(stage.command([1.0, 0.0, 0.0]), None);
        }
    }
}
