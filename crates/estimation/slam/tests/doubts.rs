//! Drives with a fault, and the remark it must give.

mod worlds;

use std::f64::consts::{FRAC_PI_2, PI};

use periplus_geometry::Pose2;
use periplus_slam::{RemarkKind, Settings, Slam};
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

fn diagnostics(moments: &[Moment]) -> Vec<RemarkKind> {
    let mut slam = Slam::new(Settings { closes_loops: false, ..Settings::default() });
    for moment in moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
    slam.remarks().iter().map(|remark| remark.kind).collect()
}

/// Reversed odometry misleads scan matching along walls for a while.
fn but_corridors(diagnostics: &[RemarkKind]) -> Vec<RemarkKind> {
    diagnostics.iter().copied().filter(|it| !matches!(it, RemarkKind::Corridor(_))).collect()
}

#[test]
fn a_sound_robot_raises_no_doubt() {
    assert_eq!(diagnostics(&drive()), []);
}

#[test]
fn wheels_of_another_radius_are_told() {
    let mut moments = drive();
    steps(&mut moments, |it| Pose2::new(1.1 * it.x_m, 1.1 * it.y_m, 1.1 * it.yaw_rad));
    let diagnostics = diagnostics(&moments);
    let [RemarkKind::DistanceScale(way), RemarkKind::RotationScale(turn, _)] = diagnostics[..]
    else {
        panic!("{diagnostics:?}")
    };
    assert!((way - 1.1).abs() < 0.02 && (turn - 1.1).abs() < 0.02, "{way} {turn}");
}

#[test]
fn another_distance_between_wheels_is_told() {
    let mut moments = drive();
    steps(&mut moments, |it| Pose2 { yaw_rad: 0.85 * it.yaw_rad, ..it });
    let diagnostics = diagnostics(&moments);
    let [RemarkKind::RotationScale(turn, way)] = diagnostics[..] else { panic!("{diagnostics:?}") };
    assert!((turn - 0.85).abs() < 0.02 && (way - 1.0).abs() < 0.02, "{turn} {way}");
}

#[test]
fn swapped_axes_are_told() {
    let mut moments = drive();
    for moment in &mut moments {
        let it = moment.odometry;
        moment.odometry = Pose2 { x_m: it.y_m, y_m: it.x_m, ..it };
    }
    assert_eq!(diagnostics(&moments), [RemarkKind::OdometryAxesSwapped]);
}

#[test]
fn axes_of_the_wrong_sign_are_told() {
    let mut moments = drive();
    moments.iter_mut().for_each(|it| it.odometry.x_m *= -1.0);
    assert_eq!(but_corridors(&diagnostics(&moments)), [RemarkKind::OdometryXNegated]);
    let mut moments = drive();
    moments.iter_mut().for_each(|it| it.odometry.y_m *= -1.0);
    assert_eq!(diagnostics(&moments), [RemarkKind::OdometryYNegated]);
}

#[test]
fn a_mirrored_scan_is_told() {
    let mut moments = drive();
    // Mounted upside down without a roll in the transform: beams run the other way round.
    moments.iter_mut().for_each(|it| it.scan.ranges_m.reverse());
    assert_eq!(diagnostics(&moments), [RemarkKind::ScanMirrored]);
}

#[test]
fn a_scanner_that_points_elsewhere_is_told() {
    for turn_rad in [FRAC_PI_2, -0.3] {
        let mut moments = drive();
        // The scanner points to the right of its transform.
        moments
            .iter_mut()
            .for_each(|it| it.scan.mounting.base_from_scanner = Pose2::new(0.0, 0.0, turn_rad));
        let diagnostics = diagnostics(&moments);
        let [RemarkKind::ScannerYaw(told)] = diagnostics[..] else { panic!("{diagnostics:?}") };
        assert!((told + turn_rad).abs() < 0.05, "{told} {turn_rad}");
    }
}

#[test]
fn wheels_that_count_backwards_are_told() {
    let mut moments = drive();
    steps(&mut moments, |it| Pose2::new(-it.x_m, -it.y_m, -it.yaw_rad));
    let diagnostics = diagnostics(&moments);
    assert_eq!(but_corridors(&diagnostics), [RemarkKind::OdometryReversed]);
}

#[test]
fn odometry_that_stands_still_is_told() {
    let world = World::ring(16.0, 10.0, 2.4, 1);
    let mut moments = world.drive(&[(6.0, 0.0), (16.0, 0.0), (16.0, 8.0)], 0.1, &GOOD, 1);
    let start = moments[0].odometry;
    moments.iter_mut().for_each(|it| it.odometry = start);
    let diagnostics = diagnostics(&moments);
    let [RemarkKind::OdometryStuck(metres)] = diagnostics[..] else { panic!("{diagnostics:?}") };
    assert!((1.0..1.5).contains(&metres), "{metres}");
}

/// The map of a drive whose odometry never moves is as right as that of one without odometry.
#[test]
fn odometry_that_never_moves_is_none() {
    let mut moments = drive();
    let end = |moments: &[Moment], has_odometry: bool| {
        let mut slam = Slam::new(Settings::default());
        for moment in moments {
            let _ = slam.add_scan(&moment.scan, has_odometry.then_some(moment.odometry));
        }
        slam.finish();
        slam.map_from_base()
    };
    let blind = end(&moments, false);
    let start = moments[0].odometry;
    moments.iter_mut().for_each(|it| it.odometry = start);
    let still = end(&moments, true);
    let begin = moments[0].truth;
    let last = moments[moments.len() - 1].truth;
    let truth = (begin.inverse() * last).normalized();
    let off = |found: Pose2, from: Pose2| {
        let found = from.inverse() * found;
        libm::hypot(found.x_m - truth.x_m, found.y_m - truth.y_m)
    };
    assert!(off(still, start) < 0.1, "{}", off(still, start));
    assert!(off(blind, Pose2::IDENTITY) < 0.1, "{}", off(blind, Pose2::IDENTITY));
}

/// A robot carried across the building: the map continues as a component, which closures connect.
#[test]
fn a_carried_robot_begins_a_piece_that_closures_join() {
    let world = World::ring(16.0, 10.0, 2.4, 1);
    let corners = [(6.0, 0.0), (16.0, 0.0), (16.0, 10.0), (0.0, 10.0), (0.0, 0.0), (16.0, 0.0)];
    let corners = [&corners[..], &[(16.0, 10.0), (0.0, 10.0), (0.0, 0.0)]].concat();
    let moments = world.drive(&corners, 0.3, &GOOD, 1);
    // From the first corner to the third, while nothing was recorded and the wheels stood still.
    let is_cut = |index: usize| (40..90).contains(&index);
    let held = moments[39].odometry;
    let landed = moments[90].odometry;
    let mut slam = Slam::new(Settings::default());
    for (index, moment) in moments.iter().enumerate().filter(|it| !is_cut(it.0)) {
        let odometry =
            if index < 90 { moment.odometry } else { held * (landed.inverse() * moment.odometry) };
        let _ = slam.add_scan(&moment.scan, Some(odometry));
    }
    slam.finish();
    let diagnostics: Vec<RemarkKind> = slam.remarks().iter().map(|it| it.kind).collect();
    assert!(diagnostics.contains(&RemarkKind::Kidnapped), "{diagnostics:?}");
    let is_unjoined = diagnostics.iter().any(|it| matches!(it, RemarkKind::Disconnected(_)));
    let truth = moments[0].truth.inverse() * moments[moments.len() - 1].truth;
    let found = moments[0].odometry.inverse() * slam.map_from_base();
    let off_m = libm::hypot(found.x_m - truth.x_m, found.y_m - truth.y_m);
    assert!(off_m < 0.15 && !is_unjoined, "{off_m} {diagnostics:?} {:?}", slam.closures());
}

#[test]
fn a_bare_corridor_is_told() {
    let mut world = World { walls: Vec::new() };
    world.rectangle([-5.0, -1.2, 45.0, 1.2]);
    // Ends beyond the range of the scanner, walls without anything on them for 24 m.
    let robot = Robot { range_max_m: 8.0, ..GOOD };
    let moments = world.drive(&[(0.0, 0.0), (40.0, 0.0)], 0.3, &robot, 3);
    let diagnostics = diagnostics(&moments);
    let [RemarkKind::Corridor(metres)] = diagnostics[..] else { panic!("{diagnostics:?}") };
    assert!((25.0..38.0).contains(&metres), "{metres}");
}
