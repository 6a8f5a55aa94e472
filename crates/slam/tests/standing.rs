//! A robot that stands still costs no memory.

mod worlds;

use periplus_slam::{Scan, Settings, Slam};
use worlds::{ROBOT, World};

/// The size of a session after a short drive and these many scans at its end.
fn session_bytes(settings: &Settings, standing: usize) -> usize {
    let world = World::ring(12.0, 8.0, 2.4, 1);
    let moments = world.drive(&[(4.0, 0.0), (8.0, 0.0)], 0.5, &ROBOT, 1);
    let mut slam = Slam::new(settings.clone());
    for moment in &moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
    let last = moments.last().expect("a drive");
    for number in 1..=standing {
        let time_ns = last.scan.time_ns + 100_000_000 * i64::try_from(number).expect("few");
        let scan = Scan { time_ns, ..last.scan.clone() };
        let _ = slam.add_scan(&scan, Some(last.odometry));
    }
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
