//! A robot in a room, and a client that listens to its mapper.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose, Pose2};
use periplus_graph::{Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Quaternion, Transform, TransformStamped, Vector3};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::rcl_interfaces::Log;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Message, Service};
use periplus_nav_nodes::slam_toolbox::{Pace, Program, SlamNode};
use periplus_params::Given;
use periplus_resources::{EntryKind, FileReadError, FileWriteError, Host, MemoryHost, Store};

/// Walls of a room of 6 by 4 metres, with a pillar and a corner cut off.
pub(crate) const WALLS: [[f64; 4]; 10] = [
    [-1.0, -1.0, 5.0, -1.0],
    [5.0, -1.0, 5.0, 3.0],
    [5.0, 3.0, -1.0, 3.0],
    [-1.0, 3.0, -1.0, -1.0],
    [0.5, 1.5, 0.9, 1.5],
    [0.9, 1.5, 0.9, 1.9],
    [0.9, 1.9, 0.5, 1.9],
    [0.5, 1.9, 0.5, 1.5],
    [3.5, -1.0, 3.5, -0.2],
    [3.5, -0.2, 5.0, -0.2],
];
pub(crate) const BEAMS: usize = 180;
pub(crate) const BASE_FROM_LASER: Pose2 = Pose2::new(0.1, 0.0, 0.0);
/// Odometry origin in the room.
pub(crate) const START: Pose2 = Pose2::new(0.2, 0.1, 0.3);

/// Returns a scan of the walls.
pub(crate) fn look(walls: &[[f64; 4]], room_from_laser: Pose2) -> Vec<f32> {
    let range = |beam: usize| {
        let angle = room_from_laser.yaw_rad - PI + beam as f64 * TAU / BEAMS as f64;
        let (s, c) = libm::sincos(angle);
        let hits = walls.iter().filter_map(|[x0, y0, x1, y1]| {
            let (ux, uy) = (x1 - x0, y1 - y0);
            let cross = c * uy - s * ux;
            let (dx, dy) = (x0 - room_from_laser.x_m, y0 - room_from_laser.y_m);
            let (range, along) = ((dx * uy - dy * ux) / cross, (dx * s - dy * c) / cross);
            (range > 0.0 && (0.0..=1.0).contains(&along)).then_some(range)
        });
        hits.fold(f64::INFINITY, f64::min) as f32
    };
    (0..BEAMS).map(range).collect()
}

/// A round through the room, in the room's frame.
pub(crate) fn round() -> Vec<Pose2> {
    let corners =
        [(0.2, 0.1), (2.8, 0.2), (3.9, 1.0), (3.6, 2.3), (1.6, 2.4), (1.5, 1.0), (0.2, 0.1)];
    [&[START][..], &path(&corners)].concat()
}

/// Poses along straight lines.
pub(crate) fn path(corners: &[(f64, f64)]) -> Vec<Pose2> {
    let mut poses = Vec::new();
    for pair in corners.windows(2) {
        let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let (length, yaw) = (libm::hypot(dx, dy), libm::atan2(dy, dx));
        let steps = (length / 0.15).ceil();
        for step in 1..=steps as usize {
            let part = step as f64 / steps;
            poses.push(Pose2::new(pair[0].0 + part * dx, pair[0].1 + part * dy, yaw));
        }
    }
    poses
}

/// Files that are there, and files that are written.
#[derive(Default)]
pub(crate) struct Files {
    host: MemoryHost,
    pub(crate) written: Mutex<BTreeMap<PathBuf, Vec<u8>>>,
}

impl Host for Files {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        match self.written.lock().unwrap().get(path) {
            Some(bytes) => Ok(bytes.clone()),
            None => self.host.read(path),
        }
    }
    fn kind(&self, path: &Path) -> Option<EntryKind> {
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

pub(crate) struct Stage {
    pub(crate) graph: Graph,
    pub(crate) user: Node,
    pub(crate) slam: LifecycleNode<SlamNode>,
    tf: Publisher<TFMessage>,
    scans: Publisher<LaserScan>,
    pub(crate) maps: Mailbox<OccupancyGrid>,
    transforms: Mailbox<TFMessage>,
    logs: Mailbox<Log>,
    pub(crate) now_ns: i64,
    /// Walls of the room.
    pub(crate) walls: Vec<[f64; 4]>,
    /// Start pose; odometry relative to it has too large wheels.
    pub(crate) start: Pose2,
    pub(crate) odometry: fn(Pose2) -> Pose2,
    /// True if the scanner is mounted upside down without a roll in its transform.
    pub(crate) is_upside_down: bool,
}

pub(crate) fn time(time_ns: i64) -> Time {
    Time { sec: (time_ns / 1_000_000_000) as i32, nanosec: (time_ns % 1_000_000_000) as u32 }
}

pub(crate) fn ns(time: &Time) -> i64 {
    i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec)
}

pub(crate) fn message_pose(pose: Pose2) -> periplus_msgs::geometry_msgs::Pose {
    let (sine, cosine) = libm::sincos(0.5 * pose.yaw_rad);
    let mut message = periplus_msgs::geometry_msgs::Pose::default();
    (message.position.x, message.position.y) = (pose.x_m, pose.y_m);
    message.orientation = Quaternion { x: 0.0, y: 0.0, z: sine, w: cosine };
    message
}

pub(crate) fn off(a: Pose2, b: Pose2) -> f64 {
    libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m)
}

impl Stage {
    pub(crate) fn with_files(
        program: Program,
        given: &[(&'static str, &'static str)],
        files: Arc<Files>,
    ) -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let logs = user.mailbox("/rosout", Qos::latched(100)).unwrap();
        let mut diagnostics = Diagnostics::new();
        let base = [Given::new("base_frame", "base_link")];
        let given =
            base.into_iter().chain(given.iter().map(|&(name, text)| Given::new(name, text)));
        let values = program.table().check(given, None, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{:?}", diagnostics.iter().next());
        let slam = SlamNode::new(&graph, program, values, files, Pace::Whole).unwrap();
        slam.start();
        graph.settle();
        Self {
            tf: user.publisher("/tf", Qos::reliable(100)).unwrap(),
            scans: user.publisher("scan", Qos::sensor_data()).unwrap(),
            maps: user.mailbox("map", Qos::latched(1)).unwrap(),
            transforms: user.mailbox("/tf", Qos::reliable(1000)).unwrap(),
            graph,
            user,
            slam,
            logs,
            now_ns: 1_000_000_000,
            walls: WALLS.to_vec(),
            start: START,
            odometry: |moved| Pose2::new(1.03 * moved.x_m, 1.03 * moved.y_m, moved.yaw_rad),
            is_upside_down: false,
        }
    }

    pub(crate) fn new(program: Program, given: &[(&'static str, &'static str)]) -> Self {
        Self::with_files(program, given, Arc::default())
    }

    pub(crate) fn advance(&mut self, milliseconds: i64) {
        self.now_ns += milliseconds * 1_000_000;
        self.graph.advance_to(self.now_ns);
    }

    pub(crate) fn send(&self, parent: &str, child: &str, pose: Pose2) {
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

    pub(crate) fn scan(&self, room_from_base: Pose2) {
        let mut ranges = look(&self.walls, room_from_base * BASE_FROM_LASER);
        if self.is_upside_down {
            // From the left to the right; the first beam is straight behind.
            ranges[1..].reverse();
        }
        self.scans.publish(LaserScan {
            header: Header { stamp: time(self.now_ns), frame_id: "laser".into() },
            angle_min: -PI as f32,
            angle_increment: (TAU / BEAMS as f64) as f32,
            range_min: 0.05,
            range_max: 10.0,
            ranges,
            ..LaserScan::default()
        });
    }

    /// The robot at a pose scans what is there, a tenth of a second later.
    pub(crate) fn see(&mut self, room_from_base: Pose2) {
        let moved = self.start.inverse() * room_from_base;
        self.send("odom", "base_link", (self.odometry)(moved));
        self.send("base_link", "laser", BASE_FROM_LASER);
        self.scan(room_from_base);
        self.advance(100);
    }

    pub(crate) fn drive(&mut self, poses: &[Pose2]) {
        for &pose in poses {
            self.see(pose);
        }
    }

    /// The newest `map_from_odom`, and its time.
    pub(crate) fn transform(&self) -> Option<(i64, Pose2)> {
        let all = self.transforms.drain();
        let mut found =
            all.iter().flat_map(|it| &it.transforms).filter(|it| it.child_frame_id == "odom");
        let it = found.next_back()?;
        assert_eq!(it.header.frame_id, "map");
        let (t, q) = (&it.transform.translation, &it.transform.rotation);
        Some((ns(&it.header.stamp), Pose2::new(t.x, t.y, 2.0 * libm::atan2(q.z, q.w))))
    }

    pub(crate) fn said(&self) -> String {
        let own = self.slam.node().logger();
        let lines = self.logs.drain();
        lines.iter().filter(|it| it.name == own).map(|it| format!("{}\n", it.msg)).collect()
    }

    pub(crate) fn hear<T: Message>(&self, topic: &str, qos: Qos) -> Mailbox<T> {
        self.user.mailbox(topic, qos).unwrap()
    }

    pub(crate) fn ask<S: Service>(&self, name: &str, request: S::Request) -> Arc<S::Response> {
        let asked = self.user.client::<S>(name).unwrap().call(request);
        self.graph.settle();
        asked.take().unwrap().unwrap()
    }

    pub(crate) fn poses(&self) -> Vec<Pose2> {
        self.slam.with(|it| it.graph().map(|slam| slam.poses().to_vec())).unwrap()
    }
}
