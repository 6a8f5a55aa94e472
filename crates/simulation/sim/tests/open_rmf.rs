//! Doors, lifts and slotcars of Open-RMF's worlds, moved by their topics.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::f32::consts::PI;
use std::path::Path;
use std::sync::Arc;

use periplus_geometry::{Pose, Pose2};
use periplus_graph::{Node, NodeSettings, Publisher, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::Message;
use periplus_msgs::rmf_door_msgs::{DoorMode, DoorRequest, DoorState};
use periplus_msgs::rmf_fleet_msgs::{Location, PathRequest, PauseRequest, RobotMode, RobotState};
use periplus_msgs::rmf_lift_msgs::{LiftRequest, LiftState};
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{AssetFiles, Options, PhysicsMode, Simulation, compose};

/// Floors at 0 m and 3 m, a sliding door, a lift with doors on both floors, and a slotcar.
const WORLD: &str = include_str!("../../../../worlds/two_floors.sdf");

/// A running world with a node of Open-RMF beside it.
struct Bench {
    simulation: Simulation,
    node: Node,
}

impl Bench {
    fn new(mode: PhysicsMode) -> Self {
        let host = MemoryHost::new().with_file("/w.sdf", WORLD);
        let resolver = Resolver::new(&host, &[]);
        let setting = LoadContext {
            host: &host,
            resolver: &resolver,
            working_folder: "/".into(),
            arguments: Vec::new(),
            open_meshes: true,
        };
        let mut composition = compose(Path::new("/w.sdf"), &[], &setting);
        let options = Options { mode, ..Options::default() };
        let simulation =
            Simulation::new(&mut composition, Arc::new(AssetFiles::default()), options);
        let findings: Vec<String> = composition
            .files
            .iter()
            .flat_map(|file| file.diagnostics.iter())
            .filter(|finding| finding.severity >= periplus_diagnostics::Severity::Warning)
            .map(|finding| finding.message.clone())
            .collect();
        assert_eq!(findings, [] as [&str; 0]);
        let node = simulation.graph().node(NodeSettings::new("rmf")).unwrap();
        Self { simulation, node }
    }

    fn publisher<T: Message>(&self, topic: &str) -> Publisher<T> {
        self.node.publisher(topic, Qos::reliable(10)).unwrap()
    }

    /// Runs for a time, and returns the messages of a topic.
    fn run<T: Message + Clone>(&mut self, topic: &str, duration_s: f64) -> Vec<T> {
        let mailbox = self.node.mailbox::<T>(topic, Qos::reliable(1000)).unwrap();
        let end_ns = self.simulation.time_ns() + (duration_s * 1e9) as i64;
        while self.simulation.time_ns() < end_ns {
            self.simulation.step().unwrap();
        }
        mailbox.drain().iter().map(|message| (**message).clone()).collect()
    }

    fn pose(&self, model: &str) -> Pose {
        self.simulation.model_pose(model).unwrap()
    }

    fn send_path(&self, points: &[[f32; 3]], task: &str) {
        let path = points.iter().enumerate().map(|(index, [x, y, yaw])| Location {
            x: *x,
            y: *y,
            yaw: *yaw,
            index: index as u64,
            ..Location::default()
        });
        self.publisher("/robot_path_requests").publish(PathRequest {
            fleet_name: "fleet".into(),
            robot_name: "car".into(),
            path: path.collect(),
            task_id: task.into(),
        });
    }

    fn request_lift(&self, floor: &str, session: &str, opens: bool) {
        self.publisher("/lift_requests").publish(LiftRequest {
            lift_name: "lift_1".into(),
            session_id: session.into(),
            request_type: LiftRequest::REQUEST_AGV_MODE,
            destination_floor: floor.into(),
            door_state: if opens { LiftRequest::DOOR_OPEN } else { LiftRequest::DOOR_CLOSED },
            ..LiftRequest::default()
        });
    }
}

const MODES: [PhysicsMode; 2] = [PhysicsMode::Kinematic, PhysicsMode::Rigid];

#[test]
fn a_door_opens_and_closes_at_requests() {
    for mode in MODES {
        let mut bench = Bench::new(mode);
        let modes = |states: Vec<DoorState>| {
            let mut modes: Vec<u32> = states.iter().map(|state| state.current_mode.value).collect();
            modes.dedup();
            modes
        };
        assert_eq!(modes(bench.run("/door_states", 2.5)), [DoorMode::MODE_CLOSED], "{mode:?}");
        let requests = bench.publisher::<DoorRequest>("/door_requests");
        let request = |value: u32, door: &str| DoorRequest {
            door_name: door.into(),
            requester_id: "test".into(),
            requested_mode: DoorMode { value },
            ..DoorRequest::default()
        };
        // 0.5 m at 0.5 m/s²: 2 s.
        requests.publish(request(DoorMode::MODE_OPEN, "main_door"));
        let all = [DoorMode::MODE_CLOSED, DoorMode::MODE_MOVING, DoorMode::MODE_OPEN];
        let found = modes(bench.run("/door_states", 3.0));
        assert!(found.ends_with(&all[1..]), "{mode:?}: {found:?}");
        requests.publish(request(DoorMode::MODE_OPEN, "shaft_door_L1"));
        requests.publish(request(DoorMode::MODE_CLOSED, "main_door"));
        let found = modes(bench.run("/door_states", 3.0));
        assert!(
            found.ends_with(&[DoorMode::MODE_MOVING, DoorMode::MODE_CLOSED]),
            "{mode:?}: {found:?}"
        );
        // Doors of lifts do not obey these requests.
        let lift: Vec<LiftState> = bench.run("/lift_states", 1.5);
        assert!(lift.iter().all(|state| state.door_state == LiftState::DOOR_CLOSED), "{mode:?}");
    }
}

#[test]
fn a_lift_carries_a_slotcar_to_another_floor() {
    for mode in MODES {
        let mut bench = Bench::new(mode);
        bench.request_lift("L1", "car", true);
        let states: Vec<LiftState> = bench.run("/lift_states", 4.0);
        let last = states.last().unwrap();
        assert_eq!(last.door_state, LiftState::DOOR_OPEN, "{mode:?}: {last:?}");
        assert_eq!((last.current_floor.as_str(), last.session_id.as_str()), ("L1", "car"));
        assert_eq!(last.available_floors, ["L1", "L2"]);
        bench.publisher("/door_requests").publish(DoorRequest {
            door_name: "main_door".into(),
            requested_mode: DoorMode { value: DoorMode::MODE_OPEN },
            ..DoorRequest::default()
        });
        bench.send_path(&[[0.0, 0.0, 0.0], [10.0, 0.0, PI]], "to the lift");
        // 10 m at 0.5 m/s, and half a turn.
        bench.run::<RobotState>("/robot_state", 32.0);
        assert!((bench.pose("car").translation.x - 10.0).abs() < 0.05, "{mode:?}");
        bench.request_lift("L2", "car", true);
        let states: Vec<LiftState> = bench.run("/lift_states", 1.0);
        assert_eq!(states.last().unwrap().door_state, LiftState::DOOR_MOVING, "{mode:?}");
        assert!(bench.pose("car").translation.z < 0.05, "it moves with open doors");
        // A request of another is ignored meanwhile.
        bench.request_lift("L1", "other", true);
        let states: Vec<LiftState> = bench.run("/lift_states", 10.0);
        let moved: Vec<u8> = states.iter().map(|state| state.motion_state).collect();
        assert!(moved.contains(&LiftState::MOTION_UP), "{mode:?}: {moved:?}");
        let last = states.last().unwrap();
        assert_eq!(last.motion_state, LiftState::MOTION_STOPPED, "{mode:?}");
        assert_eq!(last.door_state, LiftState::DOOR_OPEN, "{mode:?}");
        assert_eq!((last.current_floor.as_str(), last.session_id.as_str()), ("L2", "car"));
        let pose = bench.pose("car");
        assert!((pose.translation.z - 3.0).abs() < 0.05, "{mode:?}: {pose:?}");
        let states: Vec<RobotState> = bench.run("/robot_state", 1.5);
        assert_eq!(states.last().unwrap().location.level_name, "L2", "{mode:?}");
        bench.send_path(&[[10.0, 0.0, PI], [5.0, 0.0, PI]], "out");
        bench.run::<RobotState>("/robot_state", 16.0);
        let pose = bench.pose("car");
        assert!((pose.translation.x - 5.0).abs() < 0.05, "{mode:?}: {pose:?}");
        assert!((pose.translation.z - 3.0).abs() < 0.05, "{mode:?}: {pose:?}");
    }
}

#[test]
fn a_slotcar_follows_paths_and_reports_its_state() {
    let mut bench = Bench::new(PhysicsMode::Rigid);
    let states: Vec<RobotState> = bench.run("/robot_state", 2.0);
    let first = states.last().unwrap();
    // It is at a charger.
    assert_eq!(first.mode.mode, RobotMode::MODE_CHARGING);
    assert_eq!((first.name.as_str(), first.location.level_name.as_str()), ("car", "L1"));
    bench.send_path(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 1.0]], "one");
    let states: Vec<RobotState> = bench.run("/robot_state", 2.0);
    let moving = states.last().unwrap();
    assert_eq!((moving.mode.mode, moving.path.len()), (RobotMode::MODE_MOVING, 2), "{moving:?}");
    let states: Vec<RobotState> = bench.run("/robot_state", 20.0);
    let last = states.last().unwrap();
    assert_eq!((last.mode.mode, last.path.len()), (RobotMode::MODE_IDLE, 0), "{last:?}");
    assert_eq!(last.task_id, "one");
    assert!(last.battery_percent < 100.5 && last.battery_percent > 99.0, "{last:?}");
    let pose = Pose2::from(bench.pose("car"));
    assert!((pose.x_m - 2.0).hypot(pose.y_m - 2.0) < 0.05, "{pose:?}");
    assert!((pose.yaw_rad - 1.0).abs() < 0.02, "{pose:?}");
    // A path from elsewhere is impossible.
    bench.send_path(&[[9.0, 9.0, 0.0], [8.0, 9.0, 0.0]], "two");
    let states: Vec<RobotState> = bench.run("/robot_state", 1.0);
    let last = states.last().unwrap();
    assert_eq!((last.mode.mode, last.task_id.as_str()), (RobotMode::MODE_ADAPTER_ERROR, "two"));
}

#[test]
fn a_slotcar_pauses_and_stops_for_others() {
    let mut bench = Bench::new(PhysicsMode::Rigid);
    let pauses = bench.publisher::<PauseRequest>("/robot_pause_requests");
    let pause = |kind: u32, number: u64| PauseRequest {
        robot_name: "car".into(),
        r#type: kind,
        mode_request_id: number,
        ..PauseRequest::default()
    };
    bench.send_path(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0]], "one");
    bench.run::<RobotState>("/robot_state", 3.0);
    pauses.publish(pause(PauseRequest::TYPE_PAUSE_IMMEDIATELY, 7));
    let states: Vec<RobotState> = bench.run("/robot_state", 3.0);
    let last = states.last().unwrap();
    assert_eq!((last.mode.mode, last.mode.mode_request_id), (RobotMode::MODE_PAUSED, 7));
    let paused_m = bench.pose("car").translation.x;
    assert!(paused_m > 0.5 && paused_m < 2.0, "{paused_m}");
    bench.run::<RobotState>("/robot_state", 2.0);
    assert!((bench.pose("car").translation.x - paused_m).abs() < 0.01);
    // A crate ahead: it stops 0.75 m and 0.75 m before its centre.
    assert!(bench.simulation.set_pose("crate", Pose::from_xyz(3.5, 0.0, 0.3)));
    pauses.publish(pause(PauseRequest::TYPE_RESUME, 8));
    let states: Vec<RobotState> = bench.run("/robot_state", 6.0);
    assert_eq!(states.last().unwrap().mode.mode, RobotMode::MODE_WAITING);
    let stopped_m = bench.pose("car").translation.x;
    assert!((1.9..2.4).contains(&stopped_m), "{stopped_m}");
    assert!(bench.simulation.set_pose("crate", Pose::from_xyz(3.5, -3.0, 0.3)));
    bench.run::<RobotState>("/robot_state", 8.0);
    assert!((bench.pose("car").translation.x - 4.0).abs() < 0.05);
}
