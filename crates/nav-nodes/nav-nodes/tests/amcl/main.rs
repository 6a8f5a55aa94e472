//! The node as others see it: a robot in a room that it knows.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_geometry::{Pose, Pose2};
use periplus_graph::{
    Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos, Transition,
};
use periplus_grid::{Grid, GridInfo, OccupancyGrid as Map, occupancy};
use periplus_localization::{AMCL, Settings};
use periplus_maps::to_message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus};
use periplus_msgs::geometry_msgs::{
    PoseArray, PoseWithCovarianceStamped, Quaternion, Transform, TransformStamped, Vector3,
};
use periplus_msgs::nav_msgs::{GetMap, GetMapResponse, OccupancyGrid, SetMap, SetMapRequest};
use periplus_msgs::nav2_msgs::{ParticleCloud, SetInitialPose, SetInitialPoseRequest};
use periplus_msgs::rcl_interfaces::{
    Log, Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::std_srvs::{Empty, EmptyRequest};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Message, Service};
use periplus_nav_nodes::amcl::AmclNode;
use periplus_params::Given;
use periplus_resources::{EntryKind, FileReadError, FileWriteError, Host, MemoryHost, Store};

/// A room of 6 by 4 metres with a pillar and a cut corner, without symmetries.
fn room() -> Map {
    let info = GridInfo::new(0.05, 120, 80, Pose2::new(-1.0, -1.0, 0.0)).unwrap();
    let mut map = Grid::new(info, occupancy::FREE);
    let boxes = [
        (0, 0, 120, 2),
        (0, 78, 120, 80),
        (0, 0, 2, 80),
        (118, 0, 120, 80),
        (30, 50, 38, 58),
        (90, 0, 120, 16),
    ];
    for (left, low, right, high) in boxes {
        for row in low..high {
            for column in left..right {
                map[(column, row)] = occupancy::OCCUPIED;
            }
        }
    }
    map
}

/// Ranges of a scanner at the center of the robot.
fn look(map: &Map, map_from_laser: Pose2) -> Vec<f32> {
    const BEAMS: usize = 120;
    let finder = map.info.finder();
    let range = |beam: usize| {
        let angle = map_from_laser.yaw_rad - PI + beam as f64 * TAU / BEAMS as f64;
        let (sine, cosine) = libm::sincos(angle);
        let hit = (1..400).map(|step| 0.02 * f64::from(step)).find(|range| {
            let (x, y) = (map_from_laser.x_m + range * cosine, map_from_laser.y_m + range * sine);
            finder.cell_of(x, y).is_none_or(|cell| map[cell] == occupancy::OCCUPIED)
        });
        hit.map_or(f32::INFINITY, |range| range as f32)
    };
    (0..BEAMS).map(range).collect()
}

/// Files that are there, and files that are written.
#[derive(Default)]
struct Files {
    host: MemoryHost,
    written: Mutex<BTreeMap<PathBuf, Vec<u8>>>,
}

impl Host for Files {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        match self.written.lock().unwrap().get(path) {
            Some(bytes) => Ok(bytes.clone()),
            None => self.host.read(path),
        }
    }
    fn kind(&self, path: &Path) -> Option<EntryKind> {
        if self.written.lock().unwrap().contains_key(path) {
            return Some(EntryKind::File);
        }
        self.host.kind(path)
    }
    fn list(&self, folder: &Path) -> Vec<String> {
        self.host.list(folder)
    }
    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.host.canonical(path)
    }
    fn variable(&self, name: &str) -> Option<String> {
        self.host.variable(name)
    }
}

impl Store for Files {
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), FileWriteError> {
        if path.starts_with("/full") {
            return Err(FileWriteError::Other("the disk is full".into()));
        }
        self.written.lock().unwrap().insert(path.to_owned(), content.to_vec());
        Ok(())
    }
}

struct Stage {
    graph: Graph,
    user: Node,
    amcl: LifecycleNode<AmclNode>,
    map: Map,
    maps: Publisher<OccupancyGrid>,
    tf: Publisher<TFMessage>,
    scans: Publisher<LaserScan>,
    guesses: Publisher<PoseWithCovarianceStamped>,
    poses: Mailbox<PoseWithCovarianceStamped>,
    states: Mailbox<DiagnosticStatus>,
    transforms: Mailbox<TFMessage>,
    logs: Mailbox<Log>,
    now_ns: i64,
}

/// Start pose of odometry, on the map.
const MAP_FROM_ODOM: Pose2 = Pose2::new(0.5, 0.25, 0.5);

fn time(time_ns: i64) -> Time {
    Time { sec: (time_ns / 1_000_000_000) as i32, nanosec: (time_ns % 1_000_000_000) as u32 }
}

fn ns(time: &Time) -> i64 {
    i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec)
}

fn x_y_yaw(pose: &periplus_msgs::geometry_msgs::Pose) -> (f64, f64, f64) {
    let q = &pose.orientation;
    (pose.position.x, pose.position.y, 2.0 * libm::atan2(q.z, q.w))
}

/// Initial pose as a message.
fn guess(stamp_ns: i64, pose: Pose2) -> PoseWithCovarianceStamped {
    let mut guess = PoseWithCovarianceStamped {
        header: Header { stamp: time(stamp_ns), frame_id: "map".into() },
        ..PoseWithCovarianceStamped::default()
    };
    let (sine, cosine) = libm::sincos(0.5 * pose.yaw_rad);
    let to = &mut guess.pose;
    (to.pose.position.x, to.pose.position.y) = (pose.x_m, pose.y_m);
    to.pose.orientation = Quaternion { x: 0.0, y: 0.0, z: sine, w: cosine };
    (to.covariance[0], to.covariance[7], to.covariance[35]) = (0.06, 0.06, 0.03);
    guess
}

impl Stage {
    fn with_files(given: &[(&'static str, &'static str)], files: Arc<Files>) -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let logs = user.mailbox("/rosout", Qos::latched(100)).unwrap();
        let mut diagnostics = periplus_diagnostics::Diagnostics::new();
        let base = [Given::new("base_frame_id", "base_link")];
        let given =
            base.into_iter().chain(given.iter().map(|&(name, text)| Given::new(name, text)));
        let (values, _) = Settings::read(given, &mut diagnostics);
        assert!(!diagnostics.has_errors(), "{:?}", diagnostics.iter().next());
        let amcl = AmclNode::new(&graph, values, files).unwrap();
        Self {
            maps: user.publisher("map", Qos::latched(1)).unwrap(),
            tf: user.publisher("/tf", Qos::reliable(100)).unwrap(),
            scans: user.publisher("scan", Qos::sensor_data()).unwrap(),
            guesses: user.publisher("initialpose", Qos::reliable(10)).unwrap(),
            poses: user.mailbox("amcl_pose", Qos::latched(10)).unwrap(),
            states: user.mailbox("localization_status", Qos::latched(100)).unwrap(),
            transforms: user.mailbox("/tf", Qos::reliable(1000)).unwrap(),
            graph,
            user,
            amcl,
            map: room(),
            logs,
            now_ns: 1_000_000_000,
        }
    }

    /// A running node with a map.
    fn new(given: &[(&'static str, &'static str)]) -> Self {
        let mut stage = Self::with_files(given, Arc::default());
        stage.amcl.start();
        stage.maps.publish(to_message(&stage.map, "map", Time::default()));
        stage.advance(10);
        stage
    }

    fn advance(&mut self, milliseconds: i64) {
        self.now_ns += milliseconds * 1_000_000;
        self.graph.advance_to(self.now_ns);
    }

    fn send(&self, parent: &str, child: &str, pose: Pose2) {
        let Pose { translation: t, rotation: q } = Pose::from(pose);
        let transform = TransformStamped {
            header: Header { stamp: time(self.now_ns), frame_id: parent.into() },
            child_frame_id: child.into(),
            transform: Transform {
                translation: Vector3 { x: t.x, y: t.y, z: t.z },
                rotation: Quaternion { x: q.x, y: q.y, z: q.z, w: q.w },
            },
        };
        self.tf.publish(TFMessage { transforms: vec![transform] });
    }

    /// Publishes the transforms of odometry and scanner for a true pose.
    fn publish_transforms(&self, map_from_base: Pose2) {
        self.send("odom", "base_link", MAP_FROM_ODOM.inverse() * map_from_base);
        self.send("base_link", "laser", Pose2::new(0.1, 0.0, 0.0));
    }

    fn scan(&self, ranges: Vec<f32>) {
        self.scans.publish(LaserScan {
            header: Header { stamp: time(self.now_ns), frame_id: "laser".into() },
            angle_min: -PI as f32,
            angle_increment: (TAU / 120.0) as f32,
            range_min: 0.05,
            range_max: 10.0,
            ranges,
            ..LaserScan::default()
        });
    }

    /// Publishes the transforms and the scan for a true pose, and waits 0.1 s.
    fn see(&mut self, map_from_base: Pose2) {
        self.publish_transforms(map_from_base);
        self.scan(look(&self.map, map_from_base * Pose2::new(0.1, 0.0, 0.0)));
        self.advance(100);
    }

    /// Drives to [`START`] for global localization: a single scan also fits with the opposite
    /// heading.
    fn drive_to_start(&mut self) {
        for distance_m in [0.6, 0.3, 0.0] {
            self.see(START * Pose2::new(-distance_m, 0.0, 0.0));
        }
    }

    /// Latest transform `map` to `odom` with its time.
    fn transform(&self) -> Option<(i64, TransformStamped)> {
        let all = self.transforms.drain();
        let mut found =
            all.iter().flat_map(|it| &it.transforms).filter(|it| it.child_frame_id == "odom");
        found.next_back().map(|it| (ns(&it.header.stamp), it.clone()))
    }

    fn logged(&self) -> String {
        let lines = self.logs.drain();
        lines.iter().filter(|it| it.name == "amcl").map(|it| format!("{}\n", it.msg)).collect()
    }

    fn state(&self) -> String {
        self.states.latest().map(|it| it.message.clone()).unwrap_or_default()
    }

    fn receive<T: Message>(&self, topic: &str) -> Mailbox<T> {
        self.user.mailbox(topic, Qos::sensor_data()).unwrap()
    }

    fn call<S: Service>(&self, name: &str, request: S::Request) -> Arc<S::Response> {
        let asked = self.user.client::<S>(name).unwrap().call(request);
        self.graph.settle();
        asked.take().unwrap().unwrap()
    }

    fn set(&self, name: &str, value: ParameterValue) -> String {
        let parameters = vec![Parameter { name: name.into(), value }];
        let request = SetParametersRequest { parameters };
        self.call::<SetParameters>("amcl/set_parameters", request).results[0].reason.clone()
    }
}

fn number(value: f64) -> ParameterValue {
    ParameterValue {
        r#type: ParameterType::PARAMETER_DOUBLE,
        double_value: value,
        ..ParameterValue::default()
    }
}

const START: Pose2 = Pose2::new(1.0, 0.5, 0.3);

#[test]
fn a_robot_with_an_initial_pose_is_tracked() {
    let mut stage = Stage::new(&[("transform_tolerance", "0.5")]);
    let cloud = stage.receive::<ParticleCloud>("particle_cloud");
    let ros1 = stage.receive::<PoseArray>("particlecloud");
    let diagnostics = stage.receive::<DiagnosticArray>("/diagnostics");
    stage.publish_transforms(START);
    stage.advance(10);
    stage.guesses.publish(guess(stage.now_ns, START * Pose2::new(0.1, -0.1, 0.1)));
    stage.advance(10);
    let mut place = START;
    for _ in 0..4 {
        place = place * Pose2::new(0.3, 0.0, 0.1);
        stage.see(place);
    }
    let pose = stage.poses.latest().unwrap();
    let (x, y, yaw) = x_y_yaw(&pose.pose.pose);
    assert!((x - place.x_m).abs() < 0.05 && (y - place.y_m).abs() < 0.05, "{x} {y} {place:?}");
    assert!((yaw - place.yaw_rad).abs() < 0.02, "{yaw} {place:?}");
    assert_eq!(pose.header.frame_id, "map");
    assert!(pose.pose.covariance[0] > 0.0 && pose.pose.covariance[14] == 0.0);
    // The transform holds half a second longer than the scan, and is sent again without motion.
    let (stamp_ns, transform) = stage.transform().unwrap();
    assert_eq!(
        (stamp_ns, transform.header.frame_id.as_str()),
        (ns(&pose.header.stamp) + 500_000_000, "map")
    );
    assert!((transform.transform.translation.x - MAP_FROM_ODOM.x_m).abs() < 0.15, "{transform:?}");
    stage.see(place);
    assert!(stage.poses.latest().is_none(), "it has not moved");
    assert_eq!(stage.transform().unwrap().0, stamp_ns + 100_000_000);
    let particles = &cloud.latest().unwrap().particles;
    let weight: f64 = particles.iter().map(|it| it.weight).sum();
    assert!(particles.len() >= 500 && (weight - 1.0).abs() < 1e-9);
    assert_eq!(ros1.latest().unwrap().poses.len(), particles.len());
    assert!(stage.state().starts_with("tracking: "), "{}", stage.state());
    let status = &diagnostics.latest().unwrap().status[0];
    assert_eq!((status.level, status.name.as_str()), (DiagnosticStatus::OK, "amcl: localization"));
}

#[test]
fn a_robot_without_an_initial_pose_is_localized_globally() {
    let mut stage = Stage::new(&[]);
    let hypotheses = stage.receive::<PoseArray>("pose_hypotheses");
    let old = stage.receive::<PoseArray>("localization_rivals");
    stage.see(START * Pose2::new(-0.6, 0.0, 0.0));
    assert_eq!(hypotheses.latest().unwrap().poses.len(), 1, "besides the best one");
    assert_eq!(old.latest().unwrap().poses.len(), 1);
    let logged = stage.logged();
    assert!(logged.contains("topic `localization_rivals` is deprecated"), "{logged}");
    assert!(stage.state().starts_with("ambiguous: 2 poses are possible"), "{}", stage.state());
    assert!(stage.transform().is_none(), "a hypothesis among others is not a pose");
    stage.drive_to_start();
    let (x, y, yaw) = x_y_yaw(&stage.poses.latest().unwrap().pose.pose);
    assert!(libm::hypot(x - START.x_m, y - START.y_m) < 0.1 && (yaw - START.yaw_rad).abs() < 0.1);
    assert!(stage.logged().contains("global localization found the pose"), "{}", stage.logged());
}

#[test]
fn without_global_localization_nothing_is_published() {
    let mut stage = Stage::new(&[("global_start", "false")]);
    stage.see(START);
    assert!(stage.poses.latest().is_none() && stage.transform().is_none());
    assert!(stage.logged().contains("no initial pose is set; set the initial pose"));
    assert!(stage.state().starts_with("unset: no initial pose is set"), "{}", stage.state());
    // What comes by a service is as good.
    let pose = guess(0, START);
    stage.call::<SetInitialPose>("set_initial_pose", SetInitialPoseRequest { pose });
    stage.see(START);
    assert!(stage.poses.latest().is_some());
}

#[test]
fn services_distribute_particles_and_request_updates() {
    let mut stage = Stage::new(&[]);
    stage.drive_to_start();
    assert!(stage.poses.latest().is_some());
    stage.see(START);
    assert!(stage.poses.latest().is_none());
    stage.call::<Empty>("request_nomotion_update", EmptyRequest::default());
    stage.see(START);
    assert!(stage.poses.latest().is_some());
    for name in ["reinitialize_global_localization", "global_localization"] {
        stage.call::<Empty>(name, EmptyRequest::default());
        let spread = stage
            .amcl
            .with(|it| it.amcl().map(|amcl| amcl.estimate().unwrap().covariance))
            .unwrap();
        assert!(spread.radius_m() > 1.0, "{name}: {spread:?}");
    }
}

#[test]
fn past_initial_poses_are_predicted_by_odometry() {
    let mut stage = Stage::new(&[]);
    let then_ns = stage.now_ns;
    stage.publish_transforms(START);
    stage.advance(1000);
    let now = START * Pose2::new(1.0, 0.0, 0.0);
    stage.publish_transforms(now);
    stage.advance(10);
    stage.guesses.publish(guess(then_ns, START));
    stage.advance(10);
    let pose = stage.amcl.with(|it| it.amcl().map(|amcl| amcl.estimate().unwrap().pose)).unwrap();
    assert!(libm::hypot(pose.x_m - now.x_m, pose.y_m - now.y_m) < 0.1, "{pose:?} {now:?}");
    // Older than anything that is known of odometry.
    for milliseconds in [20_000, 10, 10] {
        stage.advance(milliseconds);
        stage.publish_transforms(now);
    }
    stage.advance(10);
    stage.guesses.publish(guess(then_ns, START));
    stage.advance(10);
    let said = stage.logged();
    assert!(said.contains("older than the odometry buffer"), "{said}");
}

#[test]
fn invalid_inputs_are_reported() {
    let mut stage = Stage::with_files(&[], Arc::default());
    stage.amcl.start();
    stage.advance(10);
    stage.see(START);
    let said = stage.logged();
    assert!(
        said.contains("no map received yet on `/map`; start and activate a map server"),
        "{said}"
    );
    assert!(stage.state().contains("no map received yet"), "{}", stage.state());
    stage.maps.publish(to_message(&stage.map, "world", Time::default()));
    stage.advance(100);
    let said = stage.logged();
    assert!(said.contains("the map is in frame `world`, `global_frame_id` is `map`"), "{said}");
    let mut short = to_message(&stage.map, "map", Time::default());
    short.data.pop();
    stage.maps.publish(short);
    stage.advance(100);
    assert!(
        stage.logged().contains("the map is invalid: the map has 9599 values for 120 by 80 cells")
    );
    stage.maps.publish(to_message(&stage.map, "map", Time::default()));
    stage.advance(100);

    let refused = |stage: &mut Stage, wrong: PoseWithCovarianceStamped| {
        stage.logged();
        stage.guesses.publish(wrong);
        stage.advance(100);
        stage.logged()
    };
    let good = guess(0, START);
    let mut wrong = good.clone();
    wrong.header.frame_id = "odom".into();
    assert!(refused(&mut stage, wrong).contains("given in `odom`, the map is `map`"));
    let mut wrong = good.clone();
    wrong.pose.covariance[7] = f64::NAN;
    assert!(refused(&mut stage, wrong).contains("entry 7 of the covariance"));
    let mut wrong = good.clone();
    wrong.pose.pose.position.x = 77.0;
    assert!(refused(&mut stage, wrong).contains("outside of the map"));
    let mut wrong = good.clone();
    wrong.pose.pose.orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 0.0 };
    assert!(refused(&mut stage, wrong).contains("is not a rotation"));
    let mut wrong = good;
    wrong.pose.pose.position.y = f64::NAN;
    assert!(refused(&mut stage, wrong).contains("not finite"));

    stage.publish_transforms(START);
    stage.scan(Vec::new());
    stage.advance(100);
    assert!(stage.logged().contains("the scan has no ranges"));
    assert!(stage.poses.latest().is_none(), "never a silent wrong pose");
    stage.drive_to_start();
    assert!(stage.poses.latest().is_some(), "and the next good scan is used");
}

#[test]
fn a_missing_transform_is_named() {
    let mut stage = Stage::new(&[]);
    stage.send("odom", "base_link", Pose2::IDENTITY);
    stage.scan(vec![1.0; 120]);
    stage.advance(2000);
    let said = stage.logged();
    assert!(
        said.contains(
            "no transform from `laser` to `base_link`: the frame `laser` is not published"
        ),
        "{said}"
    );
    stage.advance(5000);
    stage.send("mount", "laser", Pose2::IDENTITY);
    stage.send("odom", "base_link", Pose2::IDENTITY);
    stage.scan(vec![1.0; 120]);
    stage.advance(2000);
    let said = stage.logged();
    assert!(
        said.contains("the root of `base_link` is `odom`, the root of `laser` is `mount`"),
        "{said}"
    );
    stage.advance(6000);
    let said = stage.logged();
    assert!(
        said.contains(
            "no scan received on `/scan` for 2 s; the publisher of `/scan` sends nothing"
        ),
        "{said}"
    );
}

#[test]
fn parameters_change_at_run_time() {
    let mut stage = Stage::new(&[]);
    stage.drive_to_start();
    assert!(stage.poses.latest().is_some());
    assert!(stage.set("sigma_hit", number(-1.0)).contains("above 0"), "out of its range");
    assert_eq!(stage.set("sigma_hit", number(0.1)), "");
    let most = |value: i64| ParameterValue {
        r#type: ParameterType::PARAMETER_INTEGER,
        integer_value: value,
        ..ParameterValue::default()
    };
    assert!(stage.set("max_particles", most(100)).contains("more than `max_particles`"));
    assert_eq!(stage.set("max_particles", most(800)), "");
    assert_eq!(stage.set("update_min_d", number(0.01)), "");
    stage.see(START * Pose2::new(0.05, 0.0, 0.0));
    assert!(stage.poses.latest().is_some(), "a short motion suffices now");
    assert!(stage.amcl.with(|it| it.amcl().map(|amcl| amcl.particles().len())).unwrap() <= 800);
    let text = |text: &str| ParameterValue {
        r#type: ParameterType::PARAMETER_STRING,
        string_value: text.into(),
        ..ParameterValue::default()
    };
    assert_eq!(stage.set("scan_topic", text("other")), "");
    stage.see(START * Pose2::new(1.0, 0.0, 0.0));
    assert!(stage.poses.latest().is_none(), "it hears another topic");
    assert_eq!(AMCL.find("scan_topic").unwrap().name, "scan_topic");
}

#[test]
fn the_pose_survives_a_restart() {
    let files: Arc<Files> = Arc::default();
    let given = [
        ("saved_pose_filepath", "/home/pose"),
        ("initialize_at_saved_pose", "true"),
        ("global_start", "false"),
    ];
    let mut stage = Stage::with_files(&given, files.clone());
    stage.amcl.start();
    stage.maps.publish(to_message(&stage.map, "map", Time::default()));
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_none() && stage.logged().contains("there is no saved pose"));
    stage.guesses.publish(guess(0, START));
    stage.advance(10);
    stage.see(START);
    stage.advance(3000);
    let text =
        String::from_utf8(files.written.lock().unwrap()[Path::new("/home/pose")].clone()).unwrap();
    assert!(
        text.contains("frame_id: map\nx: 1.0") || text.contains("frame_id: map\nx: 0.9"),
        "{text}"
    );

    let mut stage = Stage::with_files(&given, files.clone());
    stage.amcl.start();
    stage.maps.publish(to_message(&stage.map, "map", Time::default()));
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_some(), "{}", stage.logged());

    files.written.lock().unwrap().insert("/home/pose".into(), b"hello".to_vec());
    let mut stage = Stage::with_files(&given, files);
    stage.amcl.start();
    stage.advance(10);
    let said = stage.logged();
    assert!(said.contains("the saved pose /home/pose is not used: line 1"), "{said}");

    let given = [("saved_pose_filepath", "/full/pose")];
    let mut stage = Stage::new(&given);
    stage.drive_to_start();
    stage.advance(3000);
    assert!(stage.logged().contains("cannot be saved to /full/pose: the disk is full"));
}

#[test]
fn the_map_service_of_ros1_works() {
    let mut stage = Stage::with_files(&[("use_map_topic", "false")], Arc::default());
    stage.amcl.start();
    stage.advance(10);
    stage.see(START);
    assert!(stage.logged().contains("no map received yet from the service `/static_map`"));
    let map = to_message(&stage.map, "map", Time::default());
    let calls = stage.user.server::<GetMap>("static_map").unwrap();
    stage.advance(1500);
    while let Some(call) = calls.take() {
        call.answer(GetMapResponse { map: map.clone() });
    }
    stage.advance(100);
    stage.drive_to_start();
    assert!(stage.poses.latest().is_some(), "{}", stage.logged());
    let initial_pose = guess(0, Pose2::new(2.0, 1.0, 1.0));
    let request = SetMapRequest { map: map.clone(), initial_pose: initial_pose.clone() };
    assert!(stage.call::<SetMap>("set_map", request).success);
    let x_m =
        stage.amcl.with(|it| it.amcl().map(|amcl| amcl.estimate().unwrap().pose.x_m)).unwrap();
    assert!((x_m - 2.0).abs() < 0.1);
    let mut far = initial_pose;
    far.pose.pose.position.x = 99.0;
    let request = SetMapRequest { map, initial_pose: far };
    assert!(!stage.call::<SetMap>("set_map", request).success);
}

#[test]
fn the_lifecycle_is_managed() {
    let mut stage = Stage::with_files(&[("global_start", "false")], Arc::default());
    stage.maps.publish(to_message(&stage.map, "map", Time::default()));
    stage.guesses.publish(guess(0, START));
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_none(), "nobody has started it");
    stage.call::<Empty>("request_nomotion_update", EmptyRequest::default());
    assert!(stage.logged().contains("the node is not active"));
    stage.amcl.start();
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_some(), "the pose that came before counts");
    let life = stage.amcl.lifecycle().clone();
    life.change(Transition::Deactivate);
    stage.advance(10);
    stage.see(START * Pose2::new(0.5, 0.0, 0.0));
    assert!(stage.poses.latest().is_none());
    life.change(Transition::Cleanup);
    stage.amcl.start();
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_some(), "it remembers where it was");
}

#[test]
fn always_reset_resets_each_activation() {
    let given = [("global_start", "false"), ("always_reset_initial_pose", "true")];
    let mut stage = Stage::new(&given);
    stage.guesses.publish(guess(0, START));
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_some());
    stage.amcl.lifecycle().change(Transition::Deactivate);
    stage.amcl.lifecycle().change(Transition::Activate);
    stage.advance(10);
    stage.see(START);
    assert!(stage.poses.latest().is_none(), "it has to be told again");
}

#[test]
fn the_same_seed_gives_the_same_messages() {
    let run = |seed: &'static str| {
        let mut stage = Stage::new(&[("random_seed", seed)]);
        let cloud = stage.receive::<ParticleCloud>("particle_cloud");
        stage.see(START);
        stage.see(START * Pose2::new(0.3, 0.0, 0.0));
        cloud.latest().unwrap().particles.clone()
    };
    assert_eq!(run("1"), run("1"));
    assert_ne!(run("1"), run("2"));
}
