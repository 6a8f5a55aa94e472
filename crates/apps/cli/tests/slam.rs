//! `periplus slam` on logs of every kind: those of the project, those of PyPI's `rosbags` (`peers/slam.py`,
//! skipped with a message if it is not installed), and damaged ones.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;
#[path = "../../../estimation/slam/tests/worlds/mod.rs"]
mod worlds;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use common::Folder;
use periplus_bags::files::{Bag, BagWriter, Conversion, Storage, WriteSettings, convert};
use periplus_bags::{BagTopic, Selection, Stamp};
use periplus_geometry::Pose2;
use periplus_msgs::Message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::tf2_msgs::TFMessage;
use serde_json::Value;
use worlds::{Moment, ROBOT, World};

/// Position of the scanner on the robot \[m\].
const AHEAD_M: f64 = 0.1;
/// Start time of the drive \[ns\].
const BEGIN_NS: i64 = 1_000_000_000_000;

/// A path around the corner of a corridor, with a scanner in front of the robot's center.
fn drive() -> Vec<Moment> {
    let world = World::ring(12.0, 8.0, 2.4, 1);
    let mut moments = world.drive(&[(2.0, 0.0), (12.0, 0.0), (12.0, 6.0)], 0.3, &ROBOT, 1);
    let mut stream = periplus_geometry::Stream::keyed(1, "ahead", 0);
    for moment in &mut moments {
        let laser = moment.truth * Pose2::new(AHEAD_M, 0.0, 0.0);
        moment.scan = world.scan(laser, &ROBOT, BEGIN_NS + moment.scan.time_ns, &mut stream);
    }
    moments
}

fn transform(time_ns: i64, parent: &str, child: &str, pose: Pose2, z_m: f64) -> TFMessage {
    let mut it = TransformStamped::default();
    it.header.stamp = Time::of_ns(time_ns);
    it.header.frame_id = parent.into();
    it.child_frame_id = child.into();
    (it.transform.translation.x, it.transform.translation.y) = (pose.x_m, pose.y_m);
    it.transform.translation.z = z_m;
    let (s, c) = (0.5 * pose.yaw_rad).sin_cos();
    (it.transform.rotation.z, it.transform.rotation.w) = (s, c);
    TFMessage { transforms: vec![it] }
}

fn scan(moment: &Moment) -> LaserScan {
    let mut scan = LaserScan {
        angle_min: moment.scan.angle_min_rad as f32,
        angle_max: -moment.scan.angle_min_rad as f32,
        angle_increment: moment.scan.angle_increment_rad as f32,
        range_min: 0.05,
        range_max: 20.0,
        ranges: moment.scan.ranges_m.clone(),
        ..LaserScan::default()
    };
    scan.header.stamp = Time::of_ns(moment.scan.time_ns);
    scan.header.frame_id = "laser".into();
    scan
}

/// The drive as MCAP.
fn write_mcap(path: &Path, moments: &[Moment]) {
    let mut bag = BagWriter::create(path, WriteSettings::new(Storage::Mcap)).unwrap();
    let mut topic = |name: &str, type_name: &str, schema: &str| {
        bag.topic(&BagTopic {
            name: name.into(),
            type_name: type_name.into(),
            encoding: "cdr".into(),
            schema_encoding: "ros2msg".into(),
            schema: schema.into(),
            metadata: [].into(),
        })
        .unwrap()
    };
    let fixed = topic("/tf_static", TFMessage::TYPE_NAME, TFMessage::schema_text());
    let moving = topic("/tf", TFMessage::TYPE_NAME, TFMessage::schema_text());
    let scans = topic("/scan", LaserScan::TYPE_NAME, LaserScan::schema_text());
    let mounted = Pose2::new(AHEAD_M, 0.0, 0.0);
    let first = transform(BEGIN_NS, "base_link", "laser", mounted, 0.2);
    bag.write(fixed, Stamp::at(BEGIN_NS), &first.to_cdr().unwrap()).unwrap();
    for moment in moments {
        let time_ns = moment.scan.time_ns;
        let pose = transform(time_ns, "odom", "base_link", moment.odometry, 0.0);
        bag.write(moving, Stamp::at(time_ns), &pose.to_cdr().unwrap()).unwrap();
        bag.write(scans, Stamp::at(time_ns), &scan(moment).to_cdr().unwrap()).unwrap();
    }
    bag.finish().unwrap();
}

/// The drive in CARMEN's format: `ROBOTLASER1 type start field step max accuracy mode n ranges..
/// m remissions.. laser robot tv rv distances.. stamp host stamp`.
fn carmen(moments: &[Moment]) -> String {
    let mut text = String::from("# CARMEN Logfile\n");
    for moment in moments {
        let it = &moment.scan;
        let time_s = it.time_ns as f64 * 1e-9;
        let laser = moment.odometry * Pose2::new(AHEAD_M, 0.0, 0.0);
        let count = it.ranges_m.len();
        let _ = write!(
            text,
            "ROBOTLASER1 0 {} {} {} 20 0.01 0 {count}",
            it.angle_min_rad,
            it.angle_increment_rad * (count - 1) as f64,
            it.angle_increment_rad
        );
        for range in &it.ranges_m {
            let _ = write!(text, " {:.4}", range.min(20.0));
        }
        let pose = |it: Pose2| format!("{} {} {}", it.x_m, it.y_m, it.yaw_rad);
        let _ = writeln!(
            text,
            " 0 {} {} 0 0 0.2 0.2 1000 {time_s:.6} test {time_s:.6}",
            pose(laser),
            pose(moment.odometry)
        );
    }
    text
}

struct Mapped {
    code: Option<i32>,
    trajectory: Vec<[f64; 4]>,
    report: Value,
}

fn slam(log: &Path, out: &Path) -> Mapped {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    let command = command.arg("slam").arg(log).arg("--out").arg(out);
    let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status().unwrap();
    let text = std::fs::read_to_string(out.join("trajectory.txt")).unwrap();
    let line = |line: &str| -> [f64; 4] {
        let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    for name in ["map.yaml", "map.pgm", "trajectory.png"] {
        assert!(out.join(name).metadata().unwrap().len() > 0, "{name}");
    }
    Mapped {
        code: status.code(),
        trajectory: text.lines().map(line).collect(),
        report: serde_json::from_slice(&std::fs::read(out.join("report.json")).unwrap()).unwrap(),
    }
}

/// Asserts that a trajectory follows the true path.
fn check(mapped: &Mapped, moments: &[Moment]) {
    let [_, x, y, yaw] = mapped.trajectory[0];
    let truth_from_map = moments[0].truth * Pose2::new(x, y, yaw).inverse();
    for ([time_s, x, y, _], moment) in mapped.trajectory.iter().zip(moments) {
        assert!((time_s - moment.scan.time_ns as f64 * 1e-9).abs() < 1e-6);
        let (x, y) = truth_from_map.transform_point(*x, *y);
        let off = (x - moment.truth.x_m).hypot(y - moment.truth.y_m);
        assert!(off < 0.06, "{off} at {time_s}");
    }
}

#[test]
fn a_drive_is_the_same_in_logs_of_every_kind() {
    let folder = Folder::new("slam-kinds");
    let moments = drive();
    let mcap = folder.path("ours.mcap");
    write_mcap(&mcap, &moments);
    let first = slam(&mcap, &folder.path("out"));
    assert_eq!((first.code, first.trajectory.len()), (Some(0), moments.len()));
    check(&first, &moments);
    for (name, storage) in
        [("ours.bag", Storage::Ros1), ("folder", Storage::Sqlite), ("ours.db3", Storage::Sqlite)]
    {
        let path = folder.path(name);
        let write = WriteSettings::new(storage);
        let conversion = Conversion { selection: Selection::default(), write };
        convert(&[Bag::open(&mcap).unwrap()], &path, conversion, &mut |_| {}).unwrap();
        let other = slam(&path, &folder.path(&format!("out-{name}")));
        assert_eq!(other.code, Some(0), "{name}");
        assert_eq!(other.trajectory, first.trajectory, "{name}");
    }
    // Text has fewer digits.
    let log = folder.path("ours.log");
    std::fs::write(&log, carmen(&moments)).unwrap();
    let other = slam(&log, &folder.path("out-carmen"));
    assert_eq!((other.code, other.trajectory.len()), (Some(0), moments.len()));
    check(&other, &moments);
}

/// Wheels counted with the wrong sign: the log is mapped again with corrected odometry, which is reported;
/// the report has the edges that g2o reads.
#[test]
fn a_log_with_reversed_wheels_is_mapped_again() {
    let folder = Folder::new("slam-reversed");
    let world = World::ring(12.0, 8.0, 2.4, 1);
    let corners = [(2.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0), (0.0, 0.0), (2.0, 0.0)];
    let mut moments = world.drive(&corners, 0.3, &ROBOT, 1);
    let mut stream = periplus_geometry::Stream::keyed(1, "ahead", 0);
    let (mut before, mut pose) = (moments[0].odometry, moments[0].odometry);
    for moment in &mut moments {
        let laser = moment.truth * Pose2::new(AHEAD_M, 0.0, 0.0);
        moment.scan = world.scan(laser, &ROBOT, BEGIN_NS + moment.scan.time_ns, &mut stream);
        let step = before.inverse() * moment.odometry;
        before = moment.odometry;
        pose = (pose * Pose2::new(-step.x_m, -step.y_m, -step.yaw_rad)).normalized();
        moment.odometry = pose;
    }
    let log = folder.path("reversed.log");
    std::fs::write(&log, carmen(&moments)).unwrap();
    let (out, g2o) = (folder.path("out"), folder.path("graph.g2o"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    let command = command.arg("slam").arg(&log).arg("--out").arg(&out).arg("--g2o").arg(&g2o);
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("the map was rebuilt"), "{said}");
    let mapped = slam(&log, &out);
    assert_eq!(mapped.code, Some(0));
    check(&mapped, &moments);
    let graph = std::fs::read_to_string(&g2o).unwrap();
    let edges = graph.lines().filter(|line| line.starts_with("EDGE_SE2")).count();
    assert_eq!(mapped.report["edges"].as_array().unwrap().len(), edges);
    assert!(mapped.report["remedy"].is_string());

    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    let command = command.arg("slam").arg(&log).arg("--out").arg(&out);
    let output = command.args(["-p", "correct_mounting:=false"]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("both wheels have the wrong sign"), "{said}");
    assert!(!said.contains("the map was rebuilt"), "{said}");
}

/// Two shelves are missing when the robot passes for the second time: the report has the position and the
/// times of both passes, and the picture a red ring.
#[test]
fn passes_that_contradict_each_other_are_in_the_report_and_in_the_picture() {
    let folder = Folder::new("slam-contradiction");
    let mut empty = World { walls: Vec::new() };
    empty.rectangle([0.0, 0.0, 16.0, 10.0]);
    empty.rectangle([0.0, 7.0, 2.0, 10.0]);
    let mut full = World { walls: empty.walls.clone() };
    full.rectangle([3.5, 3.0, 12.5, 3.9]);
    full.rectangle([4.5, 6.4, 11.0, 8.0]);
    let round = [(2.0, 5.0), (14.0, 5.0), (14.0, 1.5), (2.0, 1.5)];
    let corners = [&round[..], &round, &round[..1]].concat();
    let mut moments = full.drive(&corners, 0.3, &ROBOT, 1);
    let half = moments.len() / 2;
    let mut stream = periplus_geometry::Stream::keyed(1, "ahead", 0);
    for (index, moment) in moments.iter_mut().enumerate() {
        let laser = moment.truth * Pose2::new(AHEAD_M, 0.0, 0.0);
        let world = if index < half { &full } else { &empty };
        moment.scan = world.scan(laser, &ROBOT, BEGIN_NS + moment.scan.time_ns, &mut stream);
    }
    let log = folder.path("changed.log");
    std::fs::write(&log, carmen(&moments)).unwrap();
    let mapped = slam(&log, &folder.path("out"));
    check(&mapped, &moments);
    let warnings = mapped.report["warnings"].to_string();
    assert!(warnings.contains("two passes contradict each other around"), "{warnings}");
    let found = mapped.report["contradictions"].as_array().unwrap();
    assert!(!found.is_empty());
    let half_s = moments[half].scan.time_ns as f64 * 1e-9;
    for it in found {
        let number = |value: &Value| value.as_f64().unwrap();
        // The map has the frame of odometry, which begins at the truth.
        let (x_m, y_m) = (number(&it["position"][0]), number(&it["position"][1]));
        assert!((2.0..14.5).contains(&x_m) && (1.0..6.0).contains(&y_m), "({x_m}, {y_m})");
        assert!(number(&it["agreeing"]) < 0.7, "{it}");
        // Stamps are those of lines of the trajectory, one pass before the change and one after it.
        let stamp = |pass: &str, end: usize| {
            let text = it[pass]["stamps"][end].as_str().unwrap();
            let stamp_s: f64 = text.parse().unwrap();
            assert!(
                mapped.trajectory.iter().any(|line| (line[0] - stamp_s).abs() < 1e-6),
                "{text}"
            );
            stamp_s
        };
        let (first, last) = (stamp("earlier_pass", 1), stamp("pass", 1));
        assert!(first < half_s && half_s <= last, "{first} {half_s} {last}");
    }
    let picture = std::fs::read(folder.path("out").join("trajectory.png")).unwrap();
    let picture = periplus_images::Raster::decode(&picture).unwrap();
    let pixels = (picture.width * picture.height) as usize;
    let red = (0..pixels).filter(|&pixel| picture.sample(pixel) == [255, 0, 0]).count();
    // A line of 3 pixels around 1.5 m.
    assert!(red > 300, "{red}");
}

/// Scans of a building in which every second one was taken elsewhere: no map, and exit code 1.
#[test]
fn a_log_whose_scans_fit_nothing_fails() {
    let folder = Folder::new("slam-unfitting");
    let mut moments = drive();
    let mut stream = periplus_geometry::Stream::keyed(2, "elsewhere", 0);
    for moment in moments.iter_mut().skip(10).step_by(2) {
        let ranges = moment.scan.ranges_m.iter_mut();
        ranges.for_each(|range| *range = (0.5 + 9.0 * stream.unit()) as f32);
    }
    let log = folder.path("unfitting.log");
    std::fs::write(&log, carmen(&moments)).unwrap();
    let mapped = slam(&log, &folder.path("out"));
    assert_eq!(
        mapped.code,
        Some(1),
        "{:?} of {}: {}",
        mapped.report["lost_scans"],
        mapped.report["scans"],
        mapped.report["warnings"]
    );
    let warnings = mapped.report["warnings"].to_string();
    assert!(warnings.contains("match nothing in the map"), "{warnings}");
}

#[test]
fn a_damaged_log_is_used_as_far_as_it_goes() {
    let folder = Folder::new("slam-damaged");
    let moments = drive();
    let mcap = folder.path("whole.mcap");
    write_mcap(&mcap, &moments);
    let bag = folder.path("whole.bag");
    let write = WriteSettings::new(Storage::Ros1);
    let conversion = Conversion { selection: Selection::default(), write };
    convert(&[Bag::open(&mcap).unwrap()], &bag, conversion, &mut |_| {}).unwrap();
    let database = folder.path("whole.db3");
    let write = WriteSettings::new(Storage::Sqlite);
    let conversion = Conversion { selection: Selection::default(), write };
    convert(&[Bag::open(&mcap).unwrap()], &database, conversion, &mut |_| {}).unwrap();
    let log = folder.path("whole.log");
    std::fs::write(&log, carmen(&moments)).unwrap();
    for whole in [&mcap, &bag, &database, &log] {
        let mut bytes = std::fs::read(whole).unwrap();
        bytes.truncate(bytes.len() * 7 / 10);
        let name = whole.file_name().unwrap().to_string_lossy().replace("whole", "cut");
        let cut = folder.path(&name);
        std::fs::write(&cut, bytes).unwrap();
        let mapped = slam(&cut, &folder.path(&format!("out-{name}")));
        let scans = mapped.trajectory.len();
        assert_eq!(mapped.code, Some(1), "{name}");
        // Of a database scans in between are lost, too.
        let is_database = name == "cut.db3";
        let least = moments.len() / if is_database { 3 } else { 2 };
        assert!(scans > least && scans < moments.len(), "{name}: {scans}");
        assert!(!mapped.report["faults"].as_array().unwrap().is_empty(), "{name}");
        if !is_database {
            check(&mapped, &moments);
        }
    }
}

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/peers/slam.py");

/// A Python with PyPI's `rosbags`.
fn python() -> Option<PathBuf> {
    let given = std::env::var_os("PERIPLUS_PYTHON").map(PathBuf::from);
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../.venv/bin/python");
    let has = |python: &PathBuf| {
        let mut asked = Command::new(python);
        asked.args([SCRIPT, "probe"]).stderr(Stdio::null());
        asked.status().is_ok_and(|status| status.success())
    };
    let found = given.into_iter().chain(["python3".into(), own]).find(has);
    if found.is_none() {
        eprintln!("SKIPPED: no Python with rosbags (PERIPLUS_PYTHON); pip install rosbags");
    }
    found
}

#[test]
fn bags_of_rosbags_are_mapped() {
    let Some(python) = python() else { return };
    let folder = Folder::new("slam-rosbags");
    let moments = drive();
    let lines: Vec<Value> = moments
        .iter()
        .map(|it| {
            let pose = [it.odometry.x_m, it.odometry.y_m, it.odometry.yaw_rad];
            let ranges: Vec<f32> = it.scan.ranges_m.iter().map(|it| it.min(20.0)).collect();
            serde_json::json!([it.scan.time_ns, pose, ranges])
        })
        .collect();
    let drive = folder.path("drive.json");
    std::fs::write(&drive, Value::from(lines).to_string()).unwrap();
    let mut command = Command::new(python);
    let status = command.args([SCRIPT, "write"]).arg(&drive).arg(&folder.0).status().unwrap();
    assert!(status.success());
    let mut trajectories = Vec::new();
    for name in ["ros1.bag", "sqlite3", "mcap"] {
        let mapped = slam(&folder.path(name), &folder.path(&format!("out-{name}")));
        assert_eq!((mapped.code, mapped.trajectory.len()), (Some(0), moments.len()), "{name}");
        check(&mapped, &moments);
        trajectories.push(mapped.trajectory);
    }
    assert!(trajectories.iter().all(|it| *it == trajectories[0]));
}
