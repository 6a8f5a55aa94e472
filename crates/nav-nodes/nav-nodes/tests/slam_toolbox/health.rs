//! The audit of the map and faults of the data, as a client sees them while the robot drives.

use crate::stage::{Stage, message_pose, off, path};
use periplus_geometry::Pose2;
use periplus_graph::{Mailbox, Qos};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus};
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::slam_toolbox::{Reset, ResetRequest};
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};
use periplus_nav_nodes::slam_toolbox::Program;

/// Walls of a hall of 16 by 10 metres, with one corner cut off so that it looks the same from nowhere else.
const HALL: [[f64; 4]; 6] = [
    [0.0, 0.0, 16.0, 0.0],
    [16.0, 0.0, 16.0, 10.0],
    [16.0, 10.0, 0.0, 10.0],
    [0.0, 10.0, 0.0, 0.0],
    [0.0, 7.0, 2.0, 7.0],
    [2.0, 7.0, 2.0, 10.0],
];

/// Walls of a rectangle.
fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> [[f64; 4]; 4] {
    [[x0, y0, x1, y0], [x1, y0, x1, y1], [x1, y1, x0, y1], [x0, y1, x0, y0]]
}

/// The hall with two long shelves, and the aisle between them; its mirror image is another one.
fn hall() -> Vec<[f64; 4]> {
    let (low, high) = (rectangle(3.5, 3.0, 12.5, 3.9), rectangle(4.5, 6.4, 11.0, 8.0));
    let pillar = rectangle(13.5, 8.0, 14.0, 8.5);
    [&HALL[..], &low, &high, &pillar].concat()
}

/// A round through the aisle and back along a wall.
fn rounds() -> Vec<Pose2> {
    path(&[(2.0, 5.0), (14.0, 5.0), (14.0, 1.5), (2.0, 1.5), (2.0, 5.0)])
}

/// The mapper in that hall, and a monitor.
struct Monitored {
    stage: Stage,
    diagnostics: Mailbox<DiagnosticArray>,
    markers: Mailbox<MarkerArray>,
    /// The newest status of each name.
    latest: Vec<DiagnosticStatus>,
    /// All that the mapper logged: lines on `/rosout` expire.
    said: String,
}

impl Monitored {
    fn new(program: Program, given: &[(&'static str, &'static str)]) -> Self {
        let mut stage = Stage::new(program, given);
        stage.walls = hall();
        stage.start = rounds()[0];
        let diagnostics = stage.hear("/diagnostics", Qos::reliable(1000));
        let markers = stage.hear("slam_toolbox/contradictions", Qos::latched(10));
        Self { stage, diagnostics, markers, latest: Vec::new(), said: String::new() }
    }

    /// Levels of all statuses but those that are fine, by the part after the node's name.
    fn drive(&mut self, poses: &[Pose2]) -> Vec<String> {
        let mut raised = Vec::new();
        for pose in poses {
            self.stage.see(*pose);
            self.said += &self.stage.said();
            for array in self.diagnostics.drain() {
                self.latest.clone_from(&array.status);
                for status in array.status.iter().filter(|it| it.level != DiagnosticStatus::OK) {
                    let part = status.name.split(": ").nth(1).unwrap().to_owned();
                    if !raised.contains(&part) {
                        raised.push(part);
                    }
                }
            }
        }
        raised
    }

    /// The newest status of a part.
    fn status(&self, part: &str) -> &DiagnosticStatus {
        let name = format!("slam_toolbox: {part}");
        self.latest.iter().find(|it| it.name == name).unwrap()
    }
}

#[test]
fn a_sound_drive_raises_nothing() {
    let mut it = Monitored::new(Program::Sync, &[]);
    it.stage.odometry = |moved| Pose2::new(1.01 * moved.x_m, 1.01 * moved.y_m, moved.yaw_rad);
    for _ in 0..2 {
        assert_eq!(it.drive(&rounds()), [""; 0], "{:?}", it.latest);
    }
    let parts = ["mapping", "scans", "odometry", "mounting", "components", "contradictions"];
    for part in parts {
        assert_eq!(it.status(part).level, DiagnosticStatus::OK, "{part}");
    }
    assert!(it.markers.drain().is_empty());
    assert_eq!(it.said, "");
}

/// The room as the map has it: its frame begins where the robot began.
fn in_map(stage: &Stage, room_from_base: Pose2) -> Pose2 {
    stage.start.inverse() * room_from_base
}

#[test]
fn a_changed_world_contradicts_the_map_until_it_is_reset() {
    let mut it = Monitored::new(Program::Sync, &[("map_update_interval", "1")]);
    it.stage.odometry = |moved| moved;
    assert_eq!(it.drive(&rounds()), [""; 0]);
    it.stage.walls = HALL.to_vec();
    assert_eq!(it.drive(&rounds()), ["contradictions"]);

    // On `/diagnostics`: position, times of both passes, share, advice.
    let status = it.status("contradictions");
    assert!(status.message.starts_with("two passes contradict each other around ("), "{status:?}");
    assert!(status.message.contains("drive there once more"), "{status:?}");
    let value = |key: &str| {
        let found = status.values.iter().find(|it| it.key == key);
        let words = found.unwrap_or_else(|| panic!("{key}: {status:?}")).value.clone();
        words.split(' ').map(|it| it.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    let position = value("1 position [m]");
    // In the aisle, which is 9 m long and begins 1.5 m from the start.
    assert!((1.0..11.0).contains(&position[0]) && position[1].abs() < 0.5, "{position:?}");
    assert!(value("1 agreeing [%]")[0] < 70.0);
    // The round before took the time from 1 s on, and this one came after it.
    let (earlier, later) = (value("1 earlier pass [s]"), value("1 pass [s]"));
    assert!(earlier[0] < 10.0 && earlier[1] < later[0] && later[0] > 20.0, "{earlier:?} {later:?}");

    // As a marker: a ring and a text at that position, in red.
    let markers = it.markers.drain().pop().unwrap().markers.clone();
    assert_eq!(markers[0].action, Marker::DELETEALL);
    let ring = markers.iter().find(|it| it.ns == "places").unwrap();
    assert_eq!((ring.r#type, ring.header.frame_id.as_str()), (Marker::LINE_STRIP, "map"));
    assert_eq!([ring.color.r, ring.color.g, ring.color.b, ring.color.a], [1.0, 0.0, 0.0, 1.0]);
    for corner in &ring.points {
        let radius_m = libm::hypot(corner.x - position[0], corner.y - position[1]);
        assert!((radius_m - 1.5).abs() < 0.01, "{radius_m}");
    }
    let text = markers.iter().find(|it| it.r#type == Marker::TEXT_VIEW_FACING).unwrap();
    assert!(text.text.contains("% of what both passes see agrees"), "{}", text.text);
    assert!(markers.iter().any(|it| it.ns == "passes" && it.points.len() > 3));

    // It is logged once, however often the robot comes by.
    it.drive(&rounds());
    let said = &it.said;
    assert_eq!(said.matches("two passes contradict").count(), 1, "{said}");
    assert_eq!(it.status("contradictions").level, DiagnosticStatus::WARN);

    let reset = ResetRequest { pause_new_measurements: false };
    it.stage.ask::<Reset>("/slam_toolbox/reset", reset);
    it.drive(&rounds()[..20]);
    assert_eq!(it.status("contradictions").level, DiagnosticStatus::OK);
    let markers = it.markers.drain().pop().unwrap().markers.clone();
    assert_eq!(markers.iter().map(|it| it.action).collect::<Vec<_>>(), [Marker::DELETEALL]);
}

#[test]
fn a_map_that_follows_changes_gets_sound_again() {
    let mut it = Monitored::new(Program::Lifelong, &[]);
    it.stage.odometry = |moved| moved;
    it.drive(&rounds());
    it.stage.walls = HALL.to_vec();
    let raised: Vec<String> = (0..3).flat_map(|_| it.drive(&rounds())).collect();
    assert!(raised.iter().all(|it| it == "contradictions") && !raised.is_empty(), "{raised:?}");
    // Scans of the old shelves have gone meanwhile.
    assert_eq!(it.status("contradictions").level, DiagnosticStatus::OK);
    assert_eq!(it.markers.drain().pop().unwrap().markers.len(), 1);
}

#[test]
fn a_robot_that_was_carried_unnoticed_is_reported() {
    let mut it = Monitored::new(Program::Sync, &[]);
    it.stage.odometry = |moved| moved;
    it.drive(&rounds());
    // It is set down 6 m further on in the aisle, and odometry has only 3 m to the left of that.
    it.stage.odometry = |moved| Pose2::new(moved.x_m - 6.0, moved.y_m + 3.0, moved.yaw_rad);
    let raised = it.drive(&rounds()[40..]);
    let found = it.stage.slam.with(|it| it.status()).map_from_base;
    let end = in_map(&it.stage, rounds()[rounds().len() - 1]);
    assert!(off(found, end) > 2.0, "the map would be right: {found:?} {end:?}");
    assert_eq!(raised, ["contradictions"]);
    assert!(it.markers.drain().pop().unwrap().markers.len() > 1);
}

#[test]
fn a_separate_piece_is_reported_until_a_closure_joins_it() {
    let mut it = Monitored::new(Program::Sync, &[]);
    it.stage.odometry = |moved| moved;
    it.drive(&rounds());
    // Carried meanwhile: it goes on 6 m further in the aisle, and odometry does not know.
    it.stage.advance(30_000);
    it.stage.odometry = |moved| Pose2::new(moved.x_m - 6.0, moved.y_m, moved.yaw_rad);
    let raised = it.drive(&rounds()[40..]);
    assert!(raised.contains(&"components".to_owned()), "{raised:?}");
    it.drive(&rounds());
    assert_eq!(
        it.status("components").level,
        DiagnosticStatus::OK,
        "{:?}",
        it.status("components")
    );
}

#[test]
fn odometry_that_stands_still_is_reported_until_it_moves() {
    let mut it = Monitored::new(Program::Sync, &[]);
    it.stage.odometry = |_| Pose2::IDENTITY;
    let way = path(&[(2.0, 5.0), (8.0, 5.0), (14.0, 5.0)]);
    let half = way.len() / 2;
    assert_eq!(it.drive(&way[..half]), ["odometry"]);
    let status = it.status("odometry").clone();
    assert!(status.message.contains("odometry is constant while scans show"), "{status:?}");
    it.stage.odometry = |moved| Pose2::new(moved.x_m - 6.0, moved.y_m, moved.yaw_rad);
    it.drive(&way[half..]);
    assert_eq!(it.status("odometry").level, DiagnosticStatus::OK, "{:?}", it.latest);
}

/// Walls of a map that are within 0.15 m of those of the room, of all.
fn right_walls(stage: &Stage) -> f64 {
    let map = stage.slam.with(|it| it.map()).unwrap();
    let info = map.info;
    let (mut right, mut all) = (0, 0);
    for row in 0..info.height {
        for column in (0..info.width).filter(|&column| map[(column, row)] > 60) {
            let (x, y) = info.centre_of((column, row));
            let (x, y) = stage.start.transform_point(x, y);
            let away = stage.walls.iter().map(|&[x0, y0, x1, y1]| {
                let nearest = |value: f64, a: f64, b: f64| value.clamp(a.min(b), a.max(b));
                libm::hypot(x - nearest(x, x0, x1), y - nearest(y, y0, y1))
            });
            all += 1;
            right += usize::from(away.fold(f64::INFINITY, f64::min) < 0.15);
        }
    }
    right as f64 / f64::from(all)
}

#[test]
fn a_scanner_upside_down_is_corrected_and_the_map_begins_again() {
    let mut it = Monitored::new(Program::Sync, &[]);
    it.stage.odometry = |moved| moved;
    it.stage.is_upside_down = true;
    assert_eq!(it.drive(&rounds()), ["mounting"]);
    it.drive(&rounds());
    let said = &it.said;
    assert_eq!(said.matches("the map begins again: scans are taken").count(), 1, "{said}");
    let status = it.status("mounting");
    assert_eq!(status.level, DiagnosticStatus::WARN);
    assert!(status.message.starts_with("corrected: scans are taken"), "{status:?}");
    // The frame is that of the first beginning, and the map is right.
    let end = in_map(&it.stage, rounds()[rounds().len() - 1]);
    let found = it.stage.slam.with(|it| it.status()).map_from_base;
    assert!(off(found, end) < 0.1, "{found:?} {end:?}");
    assert!(right_walls(&it.stage) > 0.95, "{}", right_walls(&it.stage));

    // With the correction disabled the map is that of the uncorrected data, with a warning.
    let mut it = Monitored::new(Program::Sync, &[("correct_mounting", "false")]);
    it.stage.is_upside_down = true;
    it.drive(&rounds());
    let said = &it.said;
    assert!(!said.contains("begins again:"), "{said}");
    assert_eq!(said.matches("since `correct_mounting` is false").count(), 1, "{said}");
    assert_eq!(it.status("mounting").level, DiagnosticStatus::WARN);
    assert!(right_walls(&it.stage) < 0.85, "{}", right_walls(&it.stage));
}

#[test]
fn swapped_axes_are_corrected_in_the_frame_that_was_set() {
    let mut it = Monitored::new(Program::Sync, &[]);
    it.stage.odometry = |moved| Pose2::new(moved.y_m, moved.x_m, moved.yaw_rad);
    // The map is to have the frame of the hall.
    let initial = it.stage.user.publisher("initialpose", Qos::reliable(10)).unwrap();
    let mut said = PoseWithCovarianceStamped::default();
    said.header.frame_id = "map".into();
    said.pose.pose = message_pose(it.stage.start);
    initial.publish(said);
    it.stage.advance(10);
    assert_eq!(it.drive(&rounds()), ["mounting"]);
    let end = rounds()[rounds().len() - 1];
    let found = it.stage.slam.with(|it| it.status()).map_from_base;
    assert!(off(found, end) < 0.1, "{found:?} {end:?}");
    assert!(it.said.contains("x and y of odometry are swapped back"));
    // `map -> odom` makes up for the odometry that others get.
    let (_, map_from_odom) = it.stage.transform().unwrap();
    let odom_from_base = (it.stage.odometry)(in_map(&it.stage, end));
    assert!(off(map_from_odom * odom_from_base, found) < 1e-9);
}

#[test]
fn particles_are_corrected_too() {
    let mut it = Monitored::new(Program::Gmapping, &[("particles", "5")]);
    it.stage.odometry = |moved| moved;
    it.stage.is_upside_down = true;
    assert_eq!(it.drive(&rounds()), ["mounting"]);
    assert!(it.said.contains("the map begins again: scans are taken"));
    let end = in_map(&it.stage, rounds()[rounds().len() - 1]);
    let found = it.stage.slam.with(|it| it.status()).map_from_base;
    assert!(off(found, end) < 0.15, "{found:?} {end:?}");
}
