//! Navigation of ROS 1, as a launch file in the layout of `turtlebot3_navigation` starts it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_graph::{NodeSettings, Qos};
use periplus_launch::Dialect;
use periplus_loader::LoadContext;
use periplus_msgs::actionlib_msgs::GoalStatus;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::move_base_msgs::MoveBaseActionResult;
use periplus_os::Machine;
use periplus_resources::Resolver;
use periplus_sim::{Options, Simulation, compose};

use crate::running::{bringup_with, top};

/// Walls of `closed_room.world`: smallest x and y, largest x and y \[m\]. A door leads through the last two.
const WALLS_M: [[f64; 4]; 7] = [
    [-1.6, -2.9, -1.45, 4.1],
    [3.25, -2.9, 3.4, 4.1],
    [-1.6, 3.95, 3.4, 4.1],
    [-1.6, -2.9, 3.4, -2.75],
    [0.425, -2.9, 0.575, -1.15],
    [-1.6, 1.2, 1.45, 1.35],
    [2.35, 1.2, 3.4, 1.35],
];

/// Writes a map of the room and returns its file.
fn map_of_room() -> PathBuf {
    let (width, height) = (120, 160);
    let mut picture = format!("P2\n{width} {height}\n255\n");
    for row in (0..height).rev() {
        for column in 0..width {
            let x_m = -2.0 + 0.05 * (f64::from(column) + 0.5);
            let y_m = -3.3 + 0.05 * (f64::from(row) + 0.5);
            let is_wall = WALLS_M
                .iter()
                .any(|[x0, y0, x1, y1]| (*x0..*x1).contains(&x_m) && (*y0..*y1).contains(&y_m));
            let is_inside = (-1.6..3.4).contains(&x_m) && (-2.9..4.1).contains(&y_m);
            let shade = if is_wall {
                0
            } else if is_inside {
                254
            } else {
                205
            };
            let _ = write!(picture, "{shade} ");
        }
        picture.push('\n');
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("move_base");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("room.pgm"), picture).unwrap();
    let text = "image: room.pgm\nresolution: 0.05\norigin: [-2.0, -3.3, 0.0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    let file = folder.join("room.yaml");
    std::fs::write(&file, text).unwrap();
    file
}

/// Runs the launch file, with a goal after two seconds, until a goal is over. Returns its state, the position of the
/// robot \[m\] and the log.
fn drive_to(x_m: f64, y_m: f64, max_s: i64) -> (Option<GoalStatus>, [f64; 2], Vec<String>) {
    let folder = top().canonicalize().unwrap();
    let map = map_of_room().display().to_string();
    let arguments = vec![("map_file".to_owned(), map)];
    let mut bringup = bringup_with("navigation.launch", &folder, Dialect::Ros1, arguments);
    let resolver = Resolver::new(&Machine, &[folder.join("robots"), folder.join("worlds")]);
    let setting = LoadContext {
        host: &Machine,
        resolver: &resolver,
        working_folder: folder,
        arguments: Vec::new(),
        open_meshes: false,
    };
    let world = bringup.world().and_then(|wish| wish.file.clone()).unwrap();
    let mut composition = compose(Path::new(&world), &[], &setting);
    let mut simulation = Simulation::new(&mut composition, Arc::default(), Options::default());
    let node = simulation.graph().node(NodeSettings::new("user").bare()).unwrap();
    let qos = Qos::reliable(10);
    let goals = node.publisher::<PoseStamped>("/move_base_simple/goal", qos).unwrap();
    let results = node.mailbox::<MoveBaseActionResult>("/move_base/result", qos).unwrap();
    let mut is_sent = false;
    let mut log = Vec::new();
    let mut ended = None;
    while simulation.time_ns() < max_s * 1_000_000_000 && ended.is_none() {
        let graph = simulation.graph().clone();
        let now_ns = simulation.time_ns();
        bringup.work(&graph, now_ns, Some(&mut simulation));
        log.extend(bringup.take_log().into_iter().map(|one| one.text));
        if now_ns >= 2_000_000_000 && !is_sent {
            let mut goal = PoseStamped::default();
            goal.header.frame_id = "map".into();
            (goal.pose.position.x, goal.pose.position.y) = (x_m, y_m);
            goal.pose.orientation.w = 1.0;
            goals.publish(goal);
            is_sent = true;
        }
        simulation.step().unwrap();
        ended = results.latest().map(|result| result.status.clone());
    }
    let robot = simulation.motion().models().find(|(_, name)| *name == "kbot");
    let pose = robot.and_then(|(id, _)| simulation.motion().model_pose(id)).unwrap();
    (ended, [pose.translation.x, pose.translation.y], log)
}

#[test]
fn a_launch_file_of_ros_1_drives_through_a_door() {
    let (ended, [x_m, y_m], log) = drive_to(1.9, 2.6, 60);
    let ended = ended.unwrap_or_else(|| panic!("the goal is not over at ({x_m}, {y_m}): {log:#?}"));
    assert_eq!(ended.status, GoalStatus::SUCCEEDED, "{}: {log:#?}", ended.text);
    let complaints: Vec<&String> = log.iter().filter(|text| text.contains("ignored")).collect();
    assert!(complaints.is_empty(), "{complaints:#?}");
    let away_m = ((x_m - 1.9).powi(2) + (y_m - 2.6).powi(2)).sqrt();
    assert!(away_m < 0.25, "{away_m} m from the goal, at ({x_m}, {y_m})");
}
