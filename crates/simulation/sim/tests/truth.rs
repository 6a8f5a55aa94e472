//! Comparison of maps with the true world at the height of a lidar.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::path::Path;
use std::sync::Arc;

use periplus_geometry::Pose2;
use periplus_graph::{NodeSettings, Publisher, Qos};
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use periplus_loader::LoadContext;
use periplus_maps::to_message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus};
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::nav_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{AssetFiles, DriveScore, Options, Search, Services, Simulation, compose};

/// A room of 4 by 4 m inside, its walls 0.1 m thick; in it a robot with a lidar 0.3 m above the
/// floor, a box that it measures and one that is too low.
const ROOM: &str = r#"<sdf version="1.9"><world name="room">
<model name="walls"><static>true</static><link name="l">
  <collision name="e"><pose>2.05 0 0.5 0 0 0</pose><geometry><box><size>0.1 4.2 1</size></box></geometry></collision>
  <collision name="w"><pose>-2.05 0 0.5 0 0 0</pose><geometry><box><size>0.1 4.2 1</size></box></geometry></collision>
  <collision name="n"><pose>0 2.05 0.5 0 0 0</pose><geometry><box><size>4.2 0.1 1</size></box></geometry></collision>
  <collision name="s"><pose>0 -2.05 0.5 0 0 0</pose><geometry><box><size>4.2 0.1 1</size></box></geometry></collision>
</link></model>
<model name="box"><static>true</static><link name="l">
  <collision name="c"><pose>1.25 1.25 0.5 0 0 0</pose><geometry><box><size>0.5 0.5 1</size></box></geometry></collision>
  <collision name="low"><pose>-1 -1 0.05 0 0 0</pose><geometry><box><size>0.5 0.5 0.1</size></box></geometry></collision>
</link></model>
<model name="robot"><pose>0.5 0 0.1 0 0 1.5707963267948966</pose>
  <link name="base_link"><gravity>false</gravity>
    <inertial><mass>1</mass></inertial>
    <collision name="c"><geometry><box><size>0.2 0.2 0.6</size></box></geometry></collision>
    <sensor name="s" type="ray"><pose>0 0 0.2 0 0 0</pose><ray><scan><horizontal><samples>4</samples>
      <min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
      <range><min>0.1</min><max>9</max></range></ray></sensor>
  </link>
</model>
</world></sdf>"#;

fn room() -> Simulation {
    let host = MemoryHost::new().with_file("/room.sdf", ROOM);
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/".into(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let mut composition = compose(Path::new("/room.sdf"), &[], &setting);
    let simulation =
        Simulation::new(&mut composition, Arc::new(AssetFiles::default()), Options::default());
    assert!(!composition.has_errors(), "{:?}", composition.files[0].diagnostics);
    simulation
}

fn info(side_m: f64) -> GridInfo {
    let cells = (side_m / 0.1).round() as usize;
    GridInfo::new(0.1, cells, cells, Pose2::new(-side_m / 2.0, -side_m / 2.0, 0.0)).unwrap()
}

#[test]
fn the_truth_is_a_slice_of_the_world() {
    let truth = room().truth_map(info(5.0)).unwrap();
    let of = |x_m: f64, y_m: f64| truth[truth.info.cell_of(x_m, y_m).unwrap()];
    for wall in
        [(2.05, 0.05), (-2.05, 1.95), (0.05, 2.05), (1.05, -2.05), (1.05, 1.25), (1.45, 1.05)]
    {
        assert_eq!(of(wall.0, wall.1), 100, "{wall:?}");
    }
    // Beside the walls; the robot, at (0.5, 0), and what is below the lidar are not walls.
    for free in
        [(1.95, 0.05), (-1.95, -1.95), (0.55, 0.05), (0.45, 0.15), (-1.05, -1.05), (0.85, 1.25)]
    {
        assert_eq!(of(free.0, free.1), 0, "{free:?}");
    }
    for unknown in [(2.35, 0.05), (1.25, 1.25)] {
        assert_eq!(of(unknown.0, unknown.1), -1, "{unknown:?}");
    }
    // 40 by 40 cells are inside, and 5 by 5 of them are in the box.
    assert_eq!(truth.cells.iter().filter(|&&cell| cell == 0).count(), 1600 - 25);
}

/// Status of a map at this pose in the world, while the estimated pose of the robot is wrong by
/// 0.1 m.
fn told(map: &OccupancyGrid, world_from_map: Pose2) -> DiagnosticStatus {
    let mut simulation = room();
    let search = Search::default();
    let mut services = Services::new(&simulation, search).unwrap();
    services.show(&simulation, Vec::new()).unwrap();
    let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
    let maps: Publisher<nav_msgs::OccupancyGrid> = node.publisher("/map", Qos::latched(1)).unwrap();
    let frames: Publisher<TFMessage> = node.publisher("/tf_static", Qos::latched(1)).unwrap();
    let heard = node.mailbox::<DiagnosticArray>("/world/room/truth", Qos::latched(1)).unwrap();
    let mut map = map.clone();
    map.info.origin = world_from_map.inverse() * map.info.origin;
    maps.publish(to_message(&map, "map", Time::default()));
    let wrong = Pose2::new(0.6, 0.0, std::f64::consts::FRAC_PI_2);
    let map_from_robot = world_from_map.inverse() * wrong;
    let mut one = TransformStamped { child_frame_id: "base_link".into(), ..Default::default() };
    one.header = Header::at(0, "map");
    (one.transform.translation.x, one.transform.translation.y) =
        (map_from_robot.x_m, map_from_robot.y_m);
    one.transform.rotation.z = libm::sin(map_from_robot.yaw_rad / 2.0);
    one.transform.rotation.w = libm::cos(map_from_robot.yaw_rad / 2.0);
    frames.publish(TFMessage { transforms: vec![one] });
    for _ in 0..3 {
        services.serve(&mut simulation);
        simulation.step().unwrap();
    }
    let told = heard.latest().expect("a comparison");
    let [status] = told.status.as_slice() else { panic!("{:?}", told.status) };
    status.clone()
}

fn value(status: &DiagnosticStatus, key: &str) -> f64 {
    status.values.iter().find(|one| one.key == key).unwrap().value.parse().unwrap()
}

#[test]
fn a_true_map_agrees_wherever_its_frame_is() {
    let truth = room().truth_map(info(5.0)).unwrap();
    for world_from_map in [Pose2::IDENTITY, Pose2::new(3.0, -1.0, 0.0)] {
        let status = told(&truth, world_from_map);
        assert_eq!((status.name.as_str(), status.level), ("/map", DiagnosticStatus::OK));
        assert!((value(&status, "shift_m") - 0.1).abs() < 0.01, "{status:?}");
        assert!(
            value(&status, "free_iou") > 0.95 && value(&status, "walls_iou") > 0.95,
            "{status:?}"
        );
        assert!(value(&status, "wall_mean_m") < 0.02, "{status:?}");
        assert!(value(&status, "explored") > 0.98, "{status:?}");
    }
}

#[test]
fn a_map_of_one_half_is_half_explored() {
    let truth = room().truth_map(info(5.0)).unwrap();
    let half = GridInfo { width: 25, ..truth.info };
    let cells = truth.rows().flat_map(|row| row[..25].to_vec()).collect();
    let status = told(&Grid::from_cells(half, cells).unwrap(), Pose2::IDENTITY);
    // 20 of 40 columns; the box is in the other half.
    assert!((value(&status, "explored") - 800.0 / 1575.0).abs() < 0.03, "{status:?}");
    assert!(value(&status, "free_iou") > 0.93, "{status:?}");
}

/// Collisions of a robot that is put at x \[m\], 0.1 m in front of the first of its sides.
fn check_collisions(x_m: f64, expected: usize, clearance_m: f64) {
    let mut simulation = room();
    assert!(simulation.set_pose("robot", Pose2::new(x_m, 0.0, 0.0).into()));
    // Its cells are centred on the face of the wall.
    let mut score = DriveScore::new(&mut simulation, info(4.9)).unwrap();
    score.sample(&mut simulation);
    assert_eq!(score.collisions.len(), expected, "{x_m}");
    let found_m = score.min_clearance_m;
    assert!((found_m - clearance_m).abs() < 1e-3, "{x_m}: {found_m}");
}

#[test]
fn a_robot_beside_a_wall_in_one_cell_with_it_does_not_collide() {
    check_collisions(1.88, 0, 0.02);
    check_collisions(1.91, 1, 0.0);
    check_collisions(2.05, 1, 0.0);
    check_collisions(1.5, 0, 0.4);
}
