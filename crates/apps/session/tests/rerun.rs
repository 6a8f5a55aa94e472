//! Estimators over a recording of a drive through a room.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "reads written files")]

use std::cell::Cell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use periplus_bags::files::Bag;
use periplus_bags::{Settings, Stamp, Topic, TopicId, Writer};
use periplus_geometry::Pose2;
use periplus_msgs::Message;
use periplus_msgs::nav_msgs::{self, OccupancyGrid};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_session::recorded::each_at;
use periplus_session::rerun::{RerunError, RerunKind, RerunRequest, RerunSummary, rerun};
use periplus_tf_ros::transform;
use serde_json::{Value, json};

/// Time of the first message [ns].
const START_NS: i64 = 1_700_000_000_000_000_000;

const PERIOD_NS: i64 = 200_000_000;

/// Half of the sides of the room, with one corner cut off so that it has one orientation [m].
const ROOM_M: [f64; 2] = [3.0, 2.0];

/// Range of a beam from a point in the room [m].
fn range_m(x: f64, y: f64, angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let to = |wall: f64, at: f64, step: f64| {
        let range = (wall - at) / step;
        if range > 0.0 { range } else { f64::INFINITY }
    };
    let [w, h] = ROOM_M;
    let walls = [to(w, x, cos), to(-w, x, cos), to(h, y, sin), to(-h, y, sin)];
    // The wall x + y = 4.
    let corner = to(4.0, x + y, cos + sin);
    walls.into_iter().fold(corner, f64::min)
}

/// Pose of the robot at a step: it drives 0.1 m along a circle each.
fn pose_at(step: i64) -> Pose2 {
    let angle = step as f64 * 0.1;
    Pose2::new(angle.sin(), 1.0 - angle.cos() - 1.0, angle)
}

struct Drive {
    bag: Writer<BufWriter<File>>,
    topics: BTreeMap<String, TopicId>,
    /// Time of recording minus stamp [ns].
    delay_ns: i64,
}

impl Drive {
    fn put<M: Message>(&mut self, name: &str, time_ns: i64, message: &M) {
        let id = *self
            .topics
            .entry(name.to_owned())
            .or_insert_with(|| self.bag.topic(Topic::of::<M>(name, &[])).unwrap());
        self.bag.write(id, Stamp::at(time_ns + self.delay_ns), &message.to_cdr().unwrap()).unwrap();
    }
}

/// Records a drive of 80 steps with transforms and a map of another estimator, which are wrong.
fn record(path: &Path, delay_ns: i64, map: Option<&OccupancyGrid>) {
    let file = BufWriter::new(File::create(path).unwrap());
    let bag = Writer::new(file, Settings::new("drive.mcap")).unwrap();
    let mut drive = Drive { bag, topics: BTreeMap::new(), delay_ns };
    let wrong = OccupancyGrid {
        header: Header::at(START_NS, "map"),
        info: nav_msgs::MapMetaData { resolution: 7.0, ..Default::default() },
        ..Default::default()
    };
    drive.put("/map", START_NS, map.unwrap_or(&wrong));
    let mounting = transform("base_link", "laser", Pose2::new(0.1, 0.0, 0.0), START_NS);
    drive.put("/tf_static", START_NS, &mounting);
    for step in 0..80 {
        let time_ns = START_NS + step * PERIOD_NS;
        let pose = pose_at(step);
        drive.put("/tf", time_ns, &transform("map", "odom", Pose2::new(100.0, 0.0, 0.0), time_ns));
        drive.put("/tf", time_ns, &transform("odom", "base_link", pose, time_ns));
        let laser = pose * Pose2::new(0.1, 0.0, 0.0);
        let increment = TAU / 180.0;
        let ranges = (0..180).map(|beam| {
            range_m(laser.x_m, laser.y_m, laser.yaw_rad + beam as f64 * increment) as f32
        });
        let scan = LaserScan {
            header: Header::at(time_ns, "laser"),
            angle_max: (179.0 * increment) as f32,
            angle_increment: increment as f32,
            range_min: 0.05,
            range_max: 10.0,
            ranges: ranges.collect(),
            ..LaserScan::default()
        };
        drive.put("/front/scan", time_ns, &scan);
    }
    drive.bag.finish().unwrap();
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn run(
    kind: RerunKind,
    recording: &Path,
    out: &Path,
    parameters: &[(&str, Value)],
) -> Result<RerunSummary, RerunError> {
    let _ = std::fs::remove_file(out);
    let parameters = parameters.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
    let request = RerunRequest {
        kind,
        recording: recording.to_owned(),
        parameters: parameters.collect(),
        out: out.to_owned(),
    };
    let last = Cell::new(0.0);
    let done = rerun(&request, &|part| last.set(part), &AtomicBool::new(false));
    assert!(done.is_err() || last.get() == 1.0);
    done
}

/// All messages of a topic with their times of recording.
fn messages<M: Message>(path: &Path, topic: &str) -> Vec<(i64, M)> {
    let mut all = Vec::new();
    let bag = Bag::open(path).unwrap();
    each_at(&bag, &[topic], |_, time_ns, message| all.push((time_ns, message))).unwrap();
    all
}

fn edges(path: &Path, child: &str) -> Vec<(String, f64)> {
    let of = |message: TFMessage| message.transforms.into_iter();
    let all = messages::<TFMessage>(path, "/tf").into_iter().flat_map(|(_, message)| of(message));
    all.filter(|it| it.child_frame_id == child)
        .map(|it| (it.header.frame_id, it.transform.translation.x))
        .collect()
}

#[test]
fn a_map_has_the_resolution_that_is_asked_for() {
    let (recording, out) = (file("slam.mcap"), file("slam_out.mcap"));
    record(&recording, 0, None);
    let parameters = [("resolution", json!(0.1)), ("map_update_interval", json!(2.0))];
    let summary = run(RerunKind::Slam, &recording, &out, &parameters).unwrap();
    assert_eq!(summary.faults, Vec::<String>::new());
    let maps = messages::<OccupancyGrid>(&out, "/map");
    assert!(maps.len() >= 7, "{} maps in 16 s", maps.len());
    assert!(maps.iter().all(|(_, map)| (map.info.resolution - 0.1).abs() < 1e-6));
    // On the time base of the recording.
    let end_ns = START_NS + 79 * PERIOD_NS;
    assert!(maps.iter().all(|(time_ns, _)| (START_NS..=end_ns).contains(time_ns)));
    // The room has 6 m by 4 m.
    let (_, last) = maps.last().unwrap();
    let width = last.info.width as usize;
    let walls = last.data.iter().enumerate().filter(|(_, value)| **value == 100);
    let (columns, rows): (Vec<usize>, Vec<usize>) =
        walls.map(|(index, _)| (index % width, index / width)).unzip();
    let span = |cells: &[usize]| cells.iter().max().unwrap() - cells.iter().min().unwrap();
    assert!((59..=62).contains(&span(&columns)), "{}", span(&columns));
    assert!((39..=42).contains(&span(&rows)), "{}", span(&rows));
    // The old estimate is not there, the new one and the robot's frames are.
    let corrections = edges(&out, "odom");
    assert!(!corrections.is_empty() && corrections.iter().all(|(_, x)| x.abs() < 0.2));
    assert_eq!(edges(&out, "base_link").len(), 80);
    let path = messages::<nav_msgs::Path>(&out, "/trajectory").pop().unwrap().1;
    let end = &path.poses.last().unwrap().pose.position;
    let truth = pose_at(79);
    assert!((end.x - truth.x_m).hypot(end.y - truth.y_m) < 0.15, "{end:?}");
    assert!(!messages::<LaserScan>(&out, "/front/scan").iter().any(|_| true));
}

#[test]
fn equal_runs_have_equal_bytes() {
    let recording = file("equal.mcap");
    record(&recording, 0, None);
    // A recording has its own name in it.
    let out = file("equal_out.mcap");
    let bytes = || {
        run(RerunKind::Slam, &recording, &out, &[]).unwrap();
        std::fs::read(&out).unwrap()
    };
    assert!(bytes() == bytes());
}

#[test]
fn stamps_of_another_clock_are_those_of_the_nodes() {
    // A simulation at second 1,700,000,000, recorded a day later.
    let day_ns = 86_400_000_000_000;
    let (recording, out) = (file("delayed.mcap"), file("delayed_out.mcap"));
    record(&recording, day_ns, None);
    let summary = run(RerunKind::Slam, &recording, &out, &[]).unwrap();
    assert_eq!(summary.faults, Vec::<String>::new());
    let maps = messages::<OccupancyGrid>(&out, "/map");
    assert!(!maps.is_empty());
    let span_ns = START_NS + day_ns..=START_NS + day_ns + 79 * PERIOD_NS;
    for (time_ns, map) in maps {
        assert!(span_ns.contains(&time_ns));
        assert!(map.header.stamp.ns() < START_NS + day_ns);
    }
}

#[test]
fn a_robot_is_localized_on_the_recorded_map() {
    let (first, mapped) = (file("first.mcap"), file("first_out.mcap"));
    record(&first, 0, None);
    run(RerunKind::Slam, &first, &mapped, &[]).unwrap();
    let map = messages::<OccupancyGrid>(&mapped, "/map").pop().unwrap().1;
    let (recording, out) = (file("amcl.mcap"), file("amcl_out.mcap"));
    record(&recording, 0, Some(&map));
    let parameters = [("set_initial_pose", json!(true)), ("max_particles", json!(500))];
    let summary = run(RerunKind::Amcl, &recording, &out, &parameters).unwrap();
    assert_eq!(summary.faults, Vec::<String>::new());
    assert!(edges(&out, "odom").iter().all(|(_, x)| x.abs() < 0.3));
    let path = messages::<nav_msgs::Path>(&out, "/trajectory").pop().unwrap().1;
    let end = path.poses.last().unwrap();
    let truth = pose_at((end.header.stamp.ns() - START_NS) / PERIOD_NS);
    let end = &end.pose.position;
    assert!((end.x - truth.x_m).hypot(end.y - truth.y_m) < 0.2, "{end:?}");
    // The result can be drawn alone.
    assert_eq!(messages::<OccupancyGrid>(&out, "/map").len(), 1);
}

#[test]
fn costmaps_have_the_size_that_is_asked_for() {
    let (recording, out) = (file("costmap.mcap"), file("costmap_out.mcap"));
    record(&recording, 0, None);
    let parameters = [("local_costmap.width", json!(4)), ("local_costmap.height", json!(2))];
    run(RerunKind::Costmap, &recording, &out, &parameters).unwrap();
    let costmaps = messages::<OccupancyGrid>(&out, "/local_costmap/costmap");
    let (_, first) = costmaps.first().unwrap();
    assert_eq!((first.info.width, first.info.height), (80, 40));
    assert!(costmaps.iter().any(|(_, map)| map.data.contains(&100)), "walls are marked");
}

#[test]
fn what_is_missing_or_wrong_is_named() {
    let (recording, out) = (file("errors.mcap"), file("errors_out.mcap"));
    record(&recording, 0, None);
    let error = |kind, parameters: &[(&str, Value)]| {
        let error = run(kind, &recording, &out, parameters).unwrap_err().to_string();
        assert!(!out.exists());
        error
    };
    let topic = error(RerunKind::Slam, &[("scan_topic", json!("/rear/scan"))]);
    assert_eq!(topic, "no scans on `/rear/scan`; topics with scans: /front/scan");
    let frame = error(RerunKind::Slam, &[("odom_frame", json!("odometry"))]);
    assert!(frame.contains("`odom_frame`") && frame.contains("base_link"), "{frame}");
    let file = error(RerunKind::Amcl, &[("map_file", json!("/no/map.yaml"))]);
    assert!(file.contains("/no/map.yaml"), "{file}");
    let request = RerunRequest {
        kind: RerunKind::Slam,
        recording: recording.clone(),
        parameters: BTreeMap::new(),
        out: out.clone(),
    };
    let cancelled = rerun(&request, &|_| (), &AtomicBool::new(true));
    assert!(matches!(cancelled, Err(RerunError::Cancelled)) && !out.exists());
}
