//! Robots with navigation as a fleet of Open-RMF.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use periplus_graph::{Mailbox, NodeSettings, Publisher, Qos};
use periplus_msgs::rmf_fleet_msgs::{
    FleetState, Location, PathRequest, PauseRequest, RobotMode, RobotState,
};
use periplus_os::Stopwatch;
use periplus_session::nodes::{
    EstimatorRequest, Navigation, NavigationDefaults, NavigationRequest, PlanningMap,
};
use periplus_session::{
    ProgressLine, RunSettings, SessionBuilder, SessionTask, SimulationSession, terminal,
};
use periplus_sim::{
    Options, PhysicsMode, PlacementPose, RobotPlacement, Simulation, Tick, compose,
};

/// A session with a robot in the demo room, which drives in its odometry frame, and a fleet adapter.
struct Bench {
    session: SimulationSession,
    _navigation: Vec<Navigation>,
    states: Mailbox<FleetState>,
    paths: Publisher<PathRequest>,
    pauses: Publisher<PauseRequest>,
}

struct Idle;

impl SessionTask for Idle {
    fn before_step(&mut self, _simulation: &mut Simulation, _line: &ProgressLine) -> Tick {
        Tick::Go
    }
}

impl Bench {
    fn new() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
        let placement = RobotPlacement {
            file: root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro"),
            pose: PlacementPose::OnGround([0.0, 0.8, 0.0]),
            ..RobotPlacement::default()
        };
        let world = root.join("worlds/demo_room.sdf");
        let composition = terminal::search(&[]).with_context(true, |context| {
            compose(&world, std::slice::from_ref(&placement), context)
        });
        let defaults =
            NavigationDefaults { map: PlanningMap::Absent, ..NavigationDefaults::for_robots(2) };
        let request = EstimatorRequest {
            detects_robot: true,
            navigation: Some(NavigationRequest { parameters: None, defaults }),
            ..EstimatorRequest::default()
        };
        let options = Options { mode: PhysicsMode::Kinematic, ..Options::default() };
        let mut session = SessionBuilder::new(composition, options, Stopwatch::start())
            .quiet(true)
            .estimators(request)
            .open_rmf(Some("fleet".into()))
            .build()
            .unwrap();
        let node = session.graph().node(NodeSettings::new("adapter")).unwrap();
        Self {
            _navigation: session.take_navigation(),
            states: node.mailbox("/fleet_states", Qos::reliable(100)).unwrap(),
            paths: node.publisher("/robot_path_requests", Qos::reliable(10)).unwrap(),
            pauses: node.publisher("/robot_pause_requests", Qos::reliable(10)).unwrap(),
            session,
        }
    }

    /// Runs up to a time, and returns the last state of the robot.
    fn run_to(&mut self, time_s: f64) -> RobotState {
        let stop = Arc::new(AtomicBool::new(false));
        let settings = RunSettings { duration_s: Some(time_s), stop: &stop, is_paused: false };
        self.session.run(settings, &mut Idle);
        let state = self.states.latest().unwrap();
        assert_eq!(state.name, "fleet");
        state.robots[0].clone()
    }

    fn send(&self, task: &str, points: &[[f32; 2]]) {
        let path = points.iter().enumerate().map(|(index, [x, y])| Location {
            x: *x,
            y: *y,
            index: index as u64,
            ..Location::default()
        });
        self.paths.publish(PathRequest {
            fleet_name: "fleet".into(),
            robot_name: "sam_bot".into(),
            path: path.collect(),
            task_id: task.into(),
        });
    }
}

#[test]
fn a_robot_drives_the_paths_of_a_fleet_adapter() {
    let mut bench = Bench::new();
    let state = bench.run_to(2.0);
    assert_eq!((state.name.as_str(), state.mode.mode), ("sam_bot", RobotMode::MODE_IDLE));
    bench.send("one", &[[0.0, 0.0], [0.6, 0.0], [1.0, 0.3]]);
    let state = bench.run_to(3.5);
    assert_eq!((state.task_id.as_str(), state.mode.mode), ("one", RobotMode::MODE_MOVING));
    bench.pauses.publish(PauseRequest {
        robot_name: "sam_bot".into(),
        mode_request_id: 4,
        r#type: PauseRequest::TYPE_PAUSE_IMMEDIATELY,
        ..PauseRequest::default()
    });
    let paused = bench.run_to(6.0);
    assert_eq!((paused.mode.mode, paused.mode.mode_request_id), (RobotMode::MODE_PAUSED, 4));
    let state = bench.run_to(9.0);
    assert!((state.location.x - paused.location.x).abs() < 0.02, "{state:?}");
    assert!(!state.path.is_empty());
    bench.pauses.publish(PauseRequest {
        robot_name: "sam_bot".into(),
        r#type: PauseRequest::TYPE_RESUME,
        ..PauseRequest::default()
    });
    let state = bench.run_to(30.0);
    assert_eq!((state.mode.mode, state.path.len()), (RobotMode::MODE_IDLE, 0), "{state:?}");
    let (dx, dy) = (state.location.x - 1.0, state.location.y - 0.3);
    assert!(dx * dx + dy * dy < 0.09, "{state:?}");
    bench.send("two", &[[5.0, 0.0], [5.5, 0.0]]);
    let state = bench.run_to(31.0);
    assert_eq!((state.task_id.as_str(), state.mode.mode), ("two", RobotMode::MODE_ADAPTER_ERROR));
}
