//! Drives through worlds whose truth is known.

mod worlds;

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting, normalize_angle};
use periplus_slam::{ScanOutcome, Settings, Slam};
use worlds::{Moment, ROBOT, Robot, World};

fn map_of(moments: &[Moment], with_odometry: bool) -> Slam {
    let mut slam = Slam::new(Settings::default());
    for moment in moments {
        let _ = slam.add_scan(&moment.scan, with_odometry.then_some(moment.odometry));
    }
    slam.finish();
    slam
}

/// Largest error of position \[m\] and heading \[rad\], relative to the first pose.
fn worst(slam: &Slam, moments: &[Moment]) -> (f64, f64) {
    let trajectory = slam.trajectory();
    assert_eq!(trajectory.len(), moments.len());
    let truth_from_map = moments[0].truth * trajectory[0].1.inverse();
    let errors = trajectory.iter().zip(moments).map(|((_, found), moment)| {
        let off = moment.truth.inverse() * (truth_from_map * *found);
        (libm::hypot(off.x_m, off.y_m), normalize_angle(off.yaw_rad).abs())
    });
    errors.fold((0.0, 0.0), |worst, it| (f64::max(worst.0, it.0), f64::max(worst.1, it.1)))
}

fn round(laps: usize) -> Vec<(f64, f64)> {
    let mut corners = vec![(6.0, 0.0)];
    for _ in 0..laps {
        corners.extend([(24.0, 0.0), (24.0, 14.0), (0.0, 14.0), (0.0, 0.0), (6.0, 0.0)]);
    }
    corners.push((14.0, 0.0));
    corners
}

#[test]
fn a_loop_closes() {
    let world = World::ring(24.0, 14.0, 2.4, 1);
    let moments = world.drive(&round(1), 0.5, &ROBOT, 1);
    let slam = map_of(&moments, true);
    let (metres, radians) = worst(&slam, &moments);
    assert!(metres < 0.08 && radians < 0.02, "{metres} {radians} {:?}", slam.closures());
}

#[test]
fn the_same_input_gives_the_same_poses_whatever_the_slices() {
    let world = World::ring(24.0, 14.0, 2.4, 2);
    let moments = world.drive(&round(1), 0.5, &ROBOT, 2);
    let (first, second) = (map_of(&moments, true), map_of(&moments, true));
    assert_eq!(first.trajectory(), second.trajectory());
    let mut sliced = Slam::new(Settings { slices_per_scan: 2, ..Settings::default() });
    for moment in &moments {
        let _ = sliced.add_scan(&moment.scan, Some(moment.odometry));
    }
    sliced.finish();
    assert!(worst(&sliced, &moments).0 < 0.08);
}

#[test]
fn a_scanner_all_around_needs_no_odometry() {
    let robot = Robot { beams: 360, field_rad: std::f64::consts::TAU, ..ROBOT };
    let world = World::ring(12.0, 8.0, 2.4, 3);
    let moments = world.drive(&[(2.0, 0.0), (12.0, 0.0), (12.0, 6.0)], 0.15, &robot, 3);
    let slam = map_of(&moments, false);
    let (metres, radians) = worst(&slam, &moments);
    assert!(metres < 0.15 && radians < 0.03, "{metres} {radians}");
}

#[test]
fn hanging_upside_down_and_off_centre_changes_nothing() {
    let world = World::ring(24.0, 14.0, 2.4, 4);
    let base_from_scanner = Pose2::new(0.2, -0.1, 0.4);
    let mut moments = world.drive(&[(6.0, 0.0), (24.0, 0.0), (24.0, 9.0)], 0.5, &ROBOT, 4);
    let mut stream = periplus_geometry::Stream::keyed(4, "again", 0);
    for moment in &mut moments {
        let time_ns = moment.scan.time_ns;
        let laser = moment.truth * base_from_scanner;
        let mut scan = world.scan(laser, &ROBOT, time_ns, &mut stream);
        // Seen from above its beams run the other way round.
        scan.ranges_m.reverse();
        moment.scan = LaserScan2 {
            mounting: ScannerMounting { base_from_scanner, is_upside_down: true },
            ..scan
        };
    }
    let slam = map_of(&moments, true);
    let (metres, radians) = worst(&slam, &moments);
    assert!(metres < 0.1 && radians < 0.02, "{metres} {radians}");
}

#[test]
fn bad_scans_say_nothing_and_break_nothing() {
    let world = World::ring(24.0, 14.0, 2.4, 5);
    let mut moments = world.drive(&[(6.0, 0.0), (20.0, 0.0)], 0.5, &ROBOT, 5);
    let count = moments.len();
    for (index, moment) in moments.iter_mut().enumerate() {
        match index % 7 {
            1 => moment.scan.ranges_m.fill(f32::NAN),
            2 => moment.scan.ranges_m.iter_mut().step_by(2).for_each(|it| *it = 0.0),
            3 => moment.scan.time_ns -= 3_000_000_000,
            4 => moment.scan.ranges_m.iter_mut().step_by(3).for_each(|it| *it = f32::INFINITY),
            _ => {}
        }
    }
    let slam = map_of(&moments, true);
    assert_eq!(slam.trajectory().len(), count);
    assert!(worst(&slam, &moments).0 < 0.25, "{:?}", worst(&slam, &moments));

    let mut slam = Slam::new(Settings::default());
    let empty = LaserScan2 { ranges_m: Vec::new(), ..moments[0].scan.clone() };
    for _ in 0..3 {
        let _ = slam.add_scan(&empty, None);
    }
    let broken = LaserScan2 { angle_min_rad: f64::NAN, ..moments[0].scan.clone() };
    assert!(matches!(slam.add_scan(&broken, None).outcome, ScanOutcome::Rejected(_)));
    let _ = slam.add_scan(&moments[0].scan, Some(Pose2::new(f64::NAN, 0.0, 0.0)));
    slam.finish();
    assert!(slam.map().is_some());
}

#[test]
fn walls_are_drawn_where_they_are() {
    let world = World::ring(24.0, 14.0, 2.4, 6);
    let moments = world.drive(&[(6.0, 0.0), (20.0, 0.0)], 0.5, &ROBOT, 6);
    let slam = map_of(&moments, true);
    let map = slam.map().unwrap();
    // The map begins where odometry has the robot, and that is the truth at the start.
    let mut occupied = 0;
    for x in 10..18 {
        let x_m = f64::from(x) + 0.02;
        assert_eq!(map.at(x_m, 0.0).copied().map(|it| it < 20), Some(true));
        occupied += i32::from(
            (-2..=2).any(|row| map.at(x_m, 1.2 + 0.05 * f64::from(row)).is_some_and(|&it| it > 60)),
        );
    }
    assert!(occupied >= 7, "{occupied}");
}
