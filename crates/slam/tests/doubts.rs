//! Drives with something broken: which one is told.

mod worlds;

use std::f64::consts::{FRAC_PI_2, PI};

use periplus_base::Pose2;
use periplus_slam::{Doubt, Settings, Slam};
use worlds::{Moment, ROBOT, Robot, World};

/// A scanner all around, and wheels that are good but for what a test breaks.
const GOOD: Robot = Robot {
    beams: 360,
    field_rad: 2.0 * PI,
    way_error: 0.02,
    turn_error: 0.02,
    bias_rad_per_m: 0.0,
    ..ROBOT
};

fn drive() -> Vec<Moment> {
    let world = World::ring(16.0, 10.0, 2.4, 1);
    let corners = [(6.0, 0.0), (16.0, 0.0), (16.0, 10.0), (0.0, 10.0), (0.0, 0.0), (6.0, 0.0)];
    world.drive(&corners, 0.3, &GOOD, 1)
}

/// Odometry with each step changed.
fn steps(moments: &mut [Moment], change: impl Fn(Pose2) -> Pose2) {
    let mut before = moments[0].odometry;
    let mut pose = before;
    for moment in moments.iter_mut().skip(1) {
        let step = (before.inverse() * moment.odometry).normalized();
        before = moment.odometry;
        pose = (pose * change(step)).normalized();
        moment.odometry = pose;
    }
}

fn doubts(moments: &[Moment]) -> Vec<Doubt> {
    let mut slam = Slam::new(Settings { closes_loops: false, ..Settings::default() });
    for moment in moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
    slam.remarks().iter().map(|remark| remark.doubt).collect()
}

/// Odometry that goes the other way leads scans astray along walls for a while.
fn but_corridors(doubts: &[Doubt]) -> Vec<Doubt> {
    doubts.iter().copied().filter(|it| !matches!(it, Doubt::Corridor(_))).collect()
}

#[test]
fn a_sound_robot_raises_no_doubt() {
    assert_eq!(doubts(&drive()), []);
}

#[test]
fn wheels_of_another_radius_are_told() {
    let mut moments = drive();
    steps(&mut moments, |it| Pose2::new(1.1 * it.x_m, 1.1 * it.y_m, 1.1 * it.yaw_rad));
    let doubts = doubts(&moments);
    let [Doubt::WayScale(way), Doubt::TurnScale(turn, _)] = doubts[..] else {
        panic!("{doubts:?}")
    };
    assert!((way - 1.1).abs() < 0.02 && (turn - 1.1).abs() < 0.02, "{way} {turn}");
}

#[test]
fn another_distance_between_wheels_is_told() {
    let mut moments = drive();
    steps(&mut moments, |it| Pose2 { yaw_rad: 0.85 * it.yaw_rad, ..it });
    let doubts = doubts(&moments);
    let [Doubt::TurnScale(turn, way)] = doubts[..] else { panic!("{doubts:?}") };
    assert!((turn - 0.85).abs() < 0.02 && (way - 1.0).abs() < 0.02, "{turn} {way}");
}

#[test]
fn swapped_axes_are_told() {
    let mut moments = drive();
    for moment in &mut moments {
        let it = moment.odometry;
        moment.odometry = Pose2 { x_m: it.y_m, y_m: it.x_m, ..it };
    }
    assert_eq!(doubts(&moments), [Doubt::AxesSwapped]);
}

#[test]
fn axes_of_the_wrong_sign_are_told() {
    let mut moments = drive();
    moments.iter_mut().for_each(|it| it.odometry.x_m *= -1.0);
    assert_eq!(but_corridors(&doubts(&moments)), [Doubt::XNegated]);
    let mut moments = drive();
    moments.iter_mut().for_each(|it| it.odometry.y_m *= -1.0);
    assert_eq!(doubts(&moments), [Doubt::YNegated]);
}

#[test]
fn a_mirrored_scan_is_told() {
    let mut moments = drive();
    // Upside down, and nobody said so: beams run the other way round.
    moments.iter_mut().for_each(|it| it.scan.ranges_m.reverse());
    assert_eq!(doubts(&moments), [Doubt::Mirrored]);
}

#[test]
fn a_scanner_that_points_elsewhere_is_told() {
    for turn_rad in [FRAC_PI_2, -0.3] {
        let mut moments = drive();
        // The scanner is turned to the right of where its transform says.
        moments.iter_mut().for_each(|it| it.scan.base_from_laser = Pose2::new(0.0, 0.0, turn_rad));
        let doubts = doubts(&moments);
        let [Doubt::ScannerTurned(told)] = doubts[..] else { panic!("{doubts:?}") };
        assert!((told + turn_rad).abs() < 0.05, "{told} {turn_rad}");
    }
}

#[test]
fn wheels_that_count_backwards_are_told() {
    let mut moments = drive();
    steps(&mut moments, |it| Pose2::new(-it.x_m, -it.y_m, -it.yaw_rad));
    let doubts = doubts(&moments);
    assert_eq!(but_corridors(&doubts), [Doubt::Backwards]);
}

#[test]
fn odometry_that_stands_still_is_told() {
    let world = World::ring(16.0, 10.0, 2.4, 1);
    let mut moments = world.drive(&[(6.0, 0.0), (16.0, 0.0), (16.0, 8.0)], 0.1, &GOOD, 1);
    let start = moments[0].odometry;
    moments.iter_mut().for_each(|it| it.odometry = start);
    assert_eq!(doubts(&moments), [Doubt::Disagreeing]);
}

#[test]
fn a_bare_corridor_is_told() {
    let mut world = World { walls: Vec::new() };
    world.rectangle([-5.0, -1.2, 45.0, 1.2]);
    // Ends beyond the range of the scanner, walls without anything on them for 24 m.
    let robot = Robot { range_max_m: 8.0, ..GOOD };
    let moments = world.drive(&[(0.0, 0.0), (40.0, 0.0)], 0.3, &robot, 3);
    let doubts = doubts(&moments);
    let [Doubt::Corridor(metres)] = doubts[..] else { panic!("{doubts:?}") };
    assert!((25.0..38.0).contains(&metres), "{metres}");
}
