//! A robot that stands still costs no memory.

mod worlds;

use periplus_geometry::LaserScan2;
use periplus_slam::{Gmapping, GmappingSettings, Mapper, Settings, Slam};
use worlds::{ROBOT, World};

/// A short drive, and N scans at its end.
fn drive_and_stand(slam: &mut dyn Mapper, standing: usize) {
    let world = World::ring(12.0, 8.0, 2.4, 1);
    let moments = world.drive(&[(4.0, 0.0), (8.0, 0.0)], 0.5, &ROBOT, 1);
    for moment in &moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
    let last = moments.last().expect("a drive");
    for number in 1..=standing {
        let time_ns = last.scan.time_ns + 100_000_000 * i64::try_from(number).expect("few");
        let scan = LaserScan2 { time_ns, ..last.scan.clone() };
        let _ = slam.add_scan(&scan, Some(last.odometry));
    }
}

/// The size of a session after a short drive and N scans at its end.
fn session_bytes(settings: &Settings, standing: usize) -> usize {
    let mut slam = Slam::new(settings.clone());
    drive_and_stand(&mut slam, standing);
    slam.save().len()
}

#[test]
fn scans_of_a_robot_that_stands_still_leave_a_session_as_large_as_it_is() {
    for is_lifelong in [false, true] {
        let settings = Settings { keeps_each_pose: false, is_lifelong, ..Settings::default() };
        let (short, long) = (session_bytes(&settings, 10), session_bytes(&settings, 500));
        assert!(long <= short + 64, "{short} bytes became {long}, lifelong: {is_lifelong}");
    }
    // Logs are read for the pose of each scan.
    let each = Settings::default();
    assert!(session_bytes(&each, 500) > session_bytes(&each, 10) + 10_000);
}

#[test]
fn particles_keep_no_pose_for_each_scan_of_a_robot_that_stands_still() {
    let poses = |keeps_each_pose, standing| {
        let settings = GmappingSettings { particles: 2, keeps_each_pose, ..Default::default() };
        let mut slam = Gmapping::new(settings);
        drive_and_stand(&mut slam, standing);
        let trajectory = slam.trajectory();
        (trajectory.len(), trajectory.last().copied())
    };
    let (short, long) = (poses(false, 10), poses(false, 100));
    assert!(long.0 <= short.0 + 2, "{} poses became {}", short.0, long.0);
    // The newest pose is kept whatever is left out, and logs are read for the pose of each scan.
    let each = poses(true, 100);
    assert_eq!(each.1, long.1);
    assert_eq!(each.0, poses(true, 10).0 + 90);
}
