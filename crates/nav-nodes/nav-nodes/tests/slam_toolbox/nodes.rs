//! The nodes as others see them: a robot in a room that it does not know yet.

use std::path::Path;
use std::sync::Arc;

use crate::stage::{BASE_FROM_LASER, Files, START, Stage, message_pose, ns, off, round};
use periplus_geometry::Pose2;
use periplus_graph::Qos;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::{GetMap, GetMapRequest, MapMetaData, OccupancyGrid};
use periplus_msgs::rcl_interfaces::ParameterType;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::slam_toolbox::{
    Clear, ClearQueue, ClearQueueRequest, ClearRequest, DeserializePoseGraph,
    DeserializePoseGraphRequest, LoopClosure, LoopClosureRequest, Pause, PauseRequest, Reset,
    ResetRequest, SaveMap, SaveMapRequest, SerializePoseGraph, SerializePoseGraphRequest,
    ToggleInteractive, ToggleInteractiveRequest,
};
use periplus_msgs::std_msgs::{Float64, String as Text};
use periplus_msgs::visualization_msgs::{
    GetInteractiveMarkers, GetInteractiveMarkersRequest, InteractiveMarkerFeedback, Marker,
    MarkerArray,
};
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_slam::{ConstraintKind, Slam};

/// Pose in the map of a pose in the room: the map begins at the start.
fn in_map(room: Pose2) -> Pose2 {
    START.inverse() * room
}

#[test]
fn a_robot_maps_a_room() {
    let mut stage = Stage::new(Program::Sync, &[("map_update_interval", "1")]);
    let poses = stage.hear::<PoseWithCovarianceStamped>("pose", Qos::reliable(100));
    let graph = stage.hear::<MarkerArray>("slam_toolbox/graph_visualization", Qos::reliable(10));
    let kept = stage.hear::<LaserScan>("slam_toolbox/scan_visualization", Qos::reliable(100));
    let round = round();
    stage.drive(&round);
    let end = round[round.len() - 1];
    // Where it is, with the covariance in its six numbers.
    let pose = poses.drain().pop().unwrap();
    let found = Pose2::new(pose.pose.pose.position.x, pose.pose.pose.position.y, 0.0);
    assert!(off(found, in_map(end)) < 0.05, "{found:?} {:?}", in_map(end));
    assert!(pose.pose.covariance[0] > 0.0 && pose.pose.covariance[35] > 0.0);
    assert_eq!(pose.header.frame_id, "map");
    // `map -> odom` makes up for the wheels, and holds a fifth of a second longer than the scan.
    let (stamp_ns, map_from_odom) = stage.transform().unwrap();
    assert_eq!(stamp_ns, ns(&pose.header.stamp) + 200_000_000);
    let moved = in_map(end);
    let odom = Pose2::new(1.03 * moved.x_m, 1.03 * moved.y_m, moved.yaw_rad);
    assert!(off(map_from_odom * odom, found) < 1e-9);
    // The map is kept for latecomers, with its description.
    let late = stage.hear::<OccupancyGrid>("/map", Qos::latched(1)).latest().unwrap();
    let info = stage.hear::<MapMetaData>("/map_metadata", Qos::latched(1)).latest().unwrap();
    assert_eq!((&late.info, late.header.frame_id.as_str()), (&*info, "map"));
    assert!(stage.maps.latest().is_some());
    let map = periplus_maps::from_message(&late).unwrap();
    let at = |x, y| {
        let (x, y) = START.inverse().transform_point(x, y);
        map.at(x, y).copied().unwrap_or(-1)
    };
    // Nav2's static layer takes nothing below 100 for a wall.
    assert!(late.data.iter().all(|cell| matches!(cell, -1 | 0 | 100)));
    assert!(late.data.contains(&100));
    assert_eq!(at(2.0, 1.0), 0, "free");
    assert_eq!(at(4.5, -0.7), -1, "behind the cut corner nobody saw");
    let wall = (-2..=2).map(|step| at(2.0, 3.0 + 0.05 * f64::from(step))).max().unwrap();
    assert!(wall > 60, "{wall}");
    // The graph as spheres and lines.
    let markers = graph.drain().pop().unwrap().markers.clone();
    let spheres = markers.iter().find(|it| it.r#type == Marker::SPHERE_LIST).unwrap();
    assert!(spheres.points.len() > 10 && spheres.header.frame_id == "map");
    assert!(markers.iter().any(|it| it.ns == "chain" && !it.points.is_empty()));
    assert_eq!(kept.drain().len(), stage.poses().len());
    // Nothing is wrong, but for the wheels.
    let said = stage.said();
    assert!(said.lines().all(|line| line.starts_with("odometry reports")), "{said}");
    assert_eq!(stage.slam.with(|it| it.status()).trouble, None);
}

#[test]
fn the_same_run_gives_the_same_map() {
    let run = || {
        let mut stage = Stage::new(Program::Async, &[]);
        stage.drive(&round());
        stage.slam.with(|it| it.graph().map(Slam::save)).unwrap()
    };
    assert!(run() == run());
}

#[test]
fn the_transform_that_is_missing_is_named() {
    let mut stage = Stage::new(Program::Async, &[]);
    for _ in 0..30 {
        stage.send("base_link", "laser", BASE_FROM_LASER);
        stage.scan(START);
        stage.advance(100);
    }
    let said = stage.said();
    assert!(said.contains("no transform from `base_link` to `odom`"), "{said}");
    assert!(said.contains("the frame `odom` is not published"), "{said}");
    assert!(stage.slam.with(|it| it.status()).trouble.unwrap().contains("odometry"));
    // Once it is there all is well.
    stage.drive(&round()[..5]);
    assert_eq!(stage.slam.with(|it| it.status()).trouble, None);
    assert!(stage.slam.with(|it| it.status()).dropped > 0);

    let mut stage = Stage::new(Program::Async, &[("scan_topic", "/front/scan")]);
    stage.advance(3000);
    let said = stage.said();
    assert!(said.contains("there are scans on `/scan`: set `scan_topic`"), "{said}");
}

#[test]
fn scans_that_were_asked_to_be_left_out_are() {
    let scans = |given: &[(&'static str, &'static str)]| {
        let mut stage = Stage::new(Program::Sync, given);
        stage.drive(&round()[..20]);
        let status = stage.slam.with(|it| it.status());
        assert_eq!((status.left_out, status.dropped), (0, 0));
        status.counts.scans
    };
    assert_eq!(scans(&[]), 20, "by itself the engine takes every scan");
    assert_eq!(scans(&[("throttle_scans", "4")]), 5);
    assert_eq!(scans(&[("minimum_time_interval", "0.5")]), 4);
}

#[test]
fn maps_and_sessions_are_saved_and_gone_on_with() {
    let files = Arc::new(Files::default());
    let mut stage = Stage::with_files(Program::Sync, &[], files.clone());
    let save = |stage: &Stage, name: &str| {
        let name = Text { data: name.into() };
        stage.ask::<SaveMap>("/slam_toolbox/save_map", SaveMapRequest { name }).result
    };
    assert_eq!(save(&stage, "/maps/early"), 1, "there is no map yet");
    let round = round();
    stage.drive(&round[..20]);
    assert_eq!(save(&stage, "/maps/room"), 0);
    assert_eq!(save(&stage, "/full/room"), 255);
    let written = files.written.lock().unwrap().clone();
    assert!(written[Path::new("/maps/room.pgm")].starts_with(b"P5"));
    let yaml = String::from_utf8(written[Path::new("/maps/room.yaml")].clone()).unwrap();
    assert!(yaml.contains("image: room.pgm") && yaml.contains("resolution: 0.05"), "{yaml}");
    let map = stage.ask::<GetMap>("/slam_toolbox/dynamic_map", GetMapRequest::default());
    assert!(map.map.data.len() > 1000);

    let serialize = |stage: &Stage, filename: &str| {
        let filename = filename.into();
        let request = SerializePoseGraphRequest { filename };
        stage.ask::<SerializePoseGraph>("/slam_toolbox/serialize_map", request).result
    };
    assert_eq!(serialize(&stage, "/full/room"), 255);
    assert_eq!(serialize(&stage, "/maps/room"), 0);
    let before = stage.poses();

    // Another day, from another pose: the map continues.
    let mut stage = Stage::with_files(Program::Sync, &[], files);
    let load = |stage: &Stage, filename: &str, match_type: i8, pose: Pose2| {
        let mut request = DeserializePoseGraphRequest {
            filename: filename.into(),
            match_type,
            ..DeserializePoseGraphRequest::default()
        };
        let to = &mut request.initial_pose;
        (to.x, to.y, to.theta) = (pose.x_m, pose.y_m, pose.yaw_rad);
        stage.ask::<DeserializePoseGraph>("/slam_toolbox/deserialize_map", request);
        stage.said()
    };
    assert!(load(&stage, "/maps/none", 1, START).contains("cannot read /maps/none.session"));
    assert!(load(&stage, "/maps/room", 0, START).contains("match_type is 0"));
    let here = in_map(round[10]) * Pose2::new(0.2, 0.1, 0.1);
    assert!(load(&stage, "/maps/room", 2, here).contains("is loaded"));
    stage.drive(&round[10..30]);
    let after = stage.poses();
    assert!(after.len() > before.len());
    let found = stage.slam.with(|it| it.status()).map_from_base;
    assert!(off(found, in_map(round[29])) < 0.1, "{found:?} {:?}", in_map(round[29]));
}

#[test]
fn a_robot_is_found_on_a_stored_graph() {
    let files = Arc::new(Files::default());
    let round = round();
    let mut stage = Stage::with_files(Program::Sync, &[], files.clone());
    stage.drive(&round);
    let filename = "/maps/room.session".to_owned();
    let request = SerializePoseGraphRequest { filename };
    stage.ask::<SerializePoseGraph>("/slam_toolbox/serialize_map", request);
    let stored = stage.poses();

    let none = [("mode", "localization")];
    let mut stage = Stage::with_files(Program::Localization, &none, files.clone());
    stage.drive(&round[..3]);
    assert!(stage.said().contains("set `map_file_name` to a session"));

    let given = [("mode", "localization"), ("map_file_name", "/maps/room")];
    let mut stage = Stage::with_files(Program::Localization, &given, files);
    stage.advance(100);
    assert!(stage.maps.latest().is_some(), "the stored map is there before any scan");
    // The robot is not at the origin of the graph; a client sets an inexact pose.
    let initial = stage.user.publisher("initialpose", Qos::reliable(10)).unwrap();
    let mut said = PoseWithCovarianceStamped::default();
    said.header.frame_id = "odom".into();
    said.pose.pose = message_pose(in_map(round[20]) * Pose2::new(0.25, -0.2, 0.15));
    initial.publish(said.clone());
    stage.advance(10);
    assert!(stage.said().contains("must be in `map`"));
    said.header.frame_id = "map".into();
    initial.publish(said);
    stage.advance(10);
    stage.drive(&round[20..]);
    let found = stage.slam.with(|it| it.status()).map_from_base;
    assert!(off(found, in_map(round[round.len() - 1])) < 0.08, "{found:?}");
    assert_eq!(stage.poses(), stored);
    assert_eq!(stage.slam.with(|it| it.status()).counts.lost, 0);
}

#[test]
fn a_run_can_be_paused_reset_and_put_right_by_hand() {
    let mut stage = Stage::new(Program::Sync, &[("do_loop_closing", "false")]);
    let round = round();
    stage.drive(&round[..10]);
    let kept = stage.poses().len();
    assert!(stage.ask::<Pause>("/slam_toolbox/pause_new_measurements", PauseRequest {}).status);
    stage.drive(&round[10..14]);
    assert_eq!(stage.poses().len(), kept, "new scans are left out");
    stage.ask::<Pause>("/slam_toolbox/pause_new_measurements", PauseRequest {});
    assert!(stage.ask::<ClearQueue>("/slam_toolbox/clear_queue", ClearQueueRequest {}).status);
    stage.drive(&round[14..]);
    assert!(stage.poses().len() > kept);

    // A kept scan is dragged.
    let close = |stage: &Stage| {
        stage.ask::<LoopClosure>("/slam_toolbox/manual_loop_closure", LoopClosureRequest {});
        stage.said()
    };
    let toggle = |stage: &Stage| {
        let request = ToggleInteractiveRequest {};
        stage.ask::<ToggleInteractive>("/slam_toolbox/toggle_interactive_mode", request);
    };
    let drags = stage.user.publisher("slam_toolbox/feedback", Qos::reliable(10)).unwrap();
    let last = stage.poses().len() - 1;
    let drag = |stage: &mut Stage, name: String| {
        let pose = stage.poses()[last] * Pose2::new(0.1, 0.05, 0.0);
        drags.publish(InteractiveMarkerFeedback {
            marker_name: name,
            event_type: InteractiveMarkerFeedback::MOUSE_UP,
            pose: message_pose(pose),
            ..InteractiveMarkerFeedback::default()
        });
        stage.advance(10);
    };
    drag(&mut stage, last.to_string());
    assert!(stage.said().contains("interactive mode is off"));
    toggle(&stage);
    let request = GetInteractiveMarkersRequest::default();
    let name = "/slam_toolbox/get_interactive_markers";
    let handles = stage.ask::<GetInteractiveMarkers>(name, request);
    assert_eq!(handles.markers.len(), last + 1);
    assert_eq!(handles.markers[last].name, last.to_string());
    drag(&mut stage, "nonsense".into());
    assert!(stage.said().contains("`nonsense` is not a stored scan"));
    drag(&mut stage, last.to_string());
    stage.ask::<Clear>("/slam_toolbox/clear_changes", ClearRequest {});
    assert!(close(&stage).contains("no scan was moved"));
    drag(&mut stage, last.to_string());
    assert!(close(&stage).contains("1 of 1 moved scans are tied"));
    let closures =
        |slam: &Slam| slam.links().filter(|it| it.2 == ConstraintKind::LoopClosure).count();
    assert_eq!(stage.slam.with(|it| it.graph().map(closures)), Some(1));

    let reset = ResetRequest { pause_new_measurements: true };
    assert_eq!(stage.ask::<Reset>("/slam_toolbox/reset", reset).result, 0);
    stage.drive(&round[..3]);
    assert!(stage.poses().is_empty(), "it waits");
}

/// `slam_toolbox` 2.7.0 has these as parameters: others read from them whether it maps.
#[test]
fn states_are_shown_and_the_start_on_a_map_is_chosen_by_parameters() {
    let shown = |stage: &Stage, name: &str| {
        let value = stage.slam.node().parameter(name).unwrap();
        assert_eq!(value.r#type, ParameterType::PARAMETER_BOOL, "{name}");
        value.bool_value
    };
    let files = Arc::new(Files::default());
    let round = round();
    let given = [("interactive_mode", "true")];
    let mut stage = Stage::with_files(Program::Sync, &given, files.clone());
    stage.drive(&round[..10]);
    for name in ["interactive_mode", "paused_processing", "paused_new_measurements"] {
        assert!(!shown(&stage, name), "{name}");
    }
    let pause =
        |stage: &Stage| stage.ask::<Pause>("/slam_toolbox/pause_new_measurements", PauseRequest {});
    pause(&stage);
    assert!(shown(&stage, "paused_new_measurements"));
    pause(&stage);
    assert!(!shown(&stage, "paused_new_measurements"));
    let toggle = |stage: &Stage| {
        let request = ToggleInteractiveRequest {};
        stage.ask::<ToggleInteractive>("/slam_toolbox/toggle_interactive_mode", request);
    };
    toggle(&stage);
    assert!(shown(&stage, "interactive_mode") && shown(&stage, "paused_processing"));
    let kept = stage.poses().len();
    stage.drive(&round[10..16]);
    assert_eq!(stage.poses().len(), kept, "scans wait while poses are moved by hand");
    toggle(&stage);
    assert!(!shown(&stage, "paused_processing"));
    stage.drive(&round[16..]);
    assert!(stage.poses().len() > kept);
    let filename = "/maps/room.session".to_owned();
    let request = SerializePoseGraphRequest { filename };
    stage.ask::<SerializePoseGraph>("/slam_toolbox/serialize_map", request);

    let start = |given: &[(&'static str, &'static str)]| {
        let all = [&[("map_file_name", "/maps/room")], given].concat();
        let mut stage = Stage::with_files(Program::Localization, &all, files.clone());
        stage.advance(10);
        (stage.slam.with(|it| it.status()).map_from_base, stage.said())
    };
    let pose = Pose2::new(0.5, -0.25, 0.1);
    let (found, said) =
        start(&[("map_start_pose", "0.5 -0.25 0.1"), ("map_start_at_dock", "true")]);
    assert!(off(found, pose) < 1e-9, "{found:?}");
    assert!(said.contains("`map_start_at_dock` has no effect beside `map_start_pose`"), "{said}");
    let (found, said) = start(&[("map_start_pose", "1 2")]);
    assert!(off(found, Pose2::IDENTITY) < 1e-9, "{found:?}");
    assert!(said.contains("`map_start_pose` has 2 numbers and needs three"), "{said}");
    let (found, _) = start(&[("map_start_at_dock", "true")]);
    let first = stage.poses()[0];
    assert!(off(found, first) < 1e-9, "{found:?} {first:?}");
}

#[test]
fn a_life_is_lived_and_ros_1_is_heard() {
    let mut stage = Stage::new(Program::Lifelong, &[]);
    let round = round();
    stage.drive(&round);
    stage.drive(&round);
    let second = stage.poses().len();
    for _ in 0..3 {
        stage.drive(&round);
    }
    let last = stage.poses().len();
    assert!(last <= second + 2, "{second} {last}");

    let mut stage = Stage::new(Program::Gmapping, &[("transform_publish_period", "0.05")]);
    assert_eq!(stage.slam.node().full_name(), "/slam_gmapping");
    let entropy = stage.hear::<Float64>("/slam_gmapping/entropy", Qos::reliable(10));
    stage.drive(&round[..30]);
    let entropy = entropy.drain().pop().unwrap().data;
    // Thirty particles, none of which knows better yet.
    assert!(entropy > 0.0 && entropy <= libm::log(30_f64) + 1e-9, "{entropy}");
    let found = stage.slam.with(|it| it.status()).map_from_base;
    assert!(off(found, in_map(round[29])) < 0.1, "{found:?} {:?}", in_map(round[29]));
    assert!(stage.maps.latest().is_some());
    assert!(stage.transform().unwrap().0 > stage.now_ns, "`tf_delay` is in the future");
    let map = stage.ask::<GetMap>("/dynamic_map", GetMapRequest::default());
    assert!(!map.map.data.is_empty());
    // The particles do not support it, and the reason is logged.
    let initial = stage.user.publisher("initialpose", Qos::reliable(10)).unwrap();
    initial.publish(PoseWithCovarianceStamped::default());
    stage.advance(10);
    assert!(stage.said().contains("the initial pose is ignored: each particle"));
}

#[test]
fn the_orientation_of_the_scanner_is_read_from_its_transform() {
    let map = |inverted_laser: &'static str| {
        let given = [("particles", "3"), ("inverted_laser", inverted_laser)];
        let mut stage = Stage::new(Program::Gmapping, &given);
        stage.drive(&round()[..8]);
        stage.slam.with(|slam| slam.map()).map(|map| map.cells)
    };
    let expected = map("false");
    assert!(expected.is_some());
    assert!(map("true") == expected, "`inverted_laser` has no effect, as documented");
}
