//! Maps that are gone on with elsewhere, only used, driven through for ever, and put right by hand.

mod worlds;

use std::collections::BTreeMap;

use periplus_geometry::Pose2;
use periplus_scan_matching::Symmetric3;
use periplus_slam::{ConstraintKind, Localizer, Mapper, ScanOutcome, Settings, Slam};
use worlds::{Moment, ROBOT, Robot, World};

const ROUND: Robot = Robot { beams: 240, field_rad: std::f64::consts::TAU, ..ROBOT };

fn world() -> World {
    World::ring(12.0, 8.0, 2.4, 1)
}

fn laps(laps: usize) -> Vec<(f64, f64)> {
    let mut corners = vec![(4.0, 0.0)];
    for _ in 0..laps {
        corners.extend([(12.0, 0.0), (12.0, 8.0), (0.0, 8.0), (0.0, 0.0), (4.0, 0.0)]);
    }
    corners
}

fn add(slam: &mut Slam, moments: &[Moment]) {
    for moment in moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
}

/// One lap, finished. The map begins where the truth does.
fn stored() -> Slam {
    let moments = world().drive(&laps(1), 0.4, &ROUND, 3);
    let mut slam = Slam::new(Settings::default());
    add(&mut slam, &moments);
    slam.finish();
    slam
}

fn off(found: Pose2, truth: Pose2) -> f64 {
    libm::hypot(found.x_m - truth.x_m, found.y_m - truth.y_m)
}

/// A start that is wrong by half a metre, and what people believe of it.
fn said(truth: Pose2) -> (Pose2, Symmetric3) {
    let pose = truth * Pose2::new(0.3, -0.35, 0.15);
    (pose.normalized(), Symmetric3::diagonal(0.25, 0.25, 0.07))
}

#[test]
fn a_stored_graph_is_used_and_stays_as_it_is() {
    let slam = stored();
    let poses = slam.poses().to_vec();
    let map = slam.map();
    let saved = slam.save();
    let mut localizer =
        Localizer::new(Slam::resume(&saved, Settings::default()).expect("a session"), 3);
    // Another day: other noise, odometry from zero, and another start pose.
    let corners = [(12.0, 2.0), (12.0, 8.0), (0.0, 8.0), (0.0, 0.0), (12.0, 0.0), (12.0, 6.0)];
    let moments = world().drive(&corners, 0.2, &ROUND, 7);
    let (pose, covariance) = said(moments[0].truth);
    localizer.place(pose, covariance);
    let mut worst: f64 = 0.0;
    for moment in &moments {
        let odometry = moments[0].odometry.inverse() * moment.odometry;
        let update = localizer.add_scan(&moment.scan, Some(odometry));
        assert_ne!(update.outcome, ScanOutcome::NoMatch);
        worst = worst.max(off(update.map_from_base, moment.truth));
        assert!(localizer.own_scans() <= 3);
        let again = update.map_from_odom * odometry;
        assert!(off(again, update.map_from_base) < 1e-9);
    }
    assert!(worst < 0.1, "{worst}");
    assert_eq!(localizer.stored().poses(), poses);
    assert_eq!(localizer.map(), map);
    assert_eq!(localizer.stored().save(), saved);
}

#[test]
fn a_map_is_gone_on_with_from_elsewhere() {
    let mut slam = stored();
    let before = slam.poses().len();
    let moments = world().drive(&[(0.0, 6.0), (0.0, 0.0), (12.0, 0.0)], 0.4, &ROUND, 9);
    let (pose, covariance) = said(moments[0].truth);
    slam.place(pose, covariance);
    for moment in &moments {
        let odometry = moments[0].odometry.inverse() * moment.odometry;
        let update = slam.add_scan(&moment.scan, Some(odometry));
        assert!(off(update.map_from_base, moment.truth) < 0.12, "{update:?} {:?}", moment.truth);
    }
    slam.finish();
    assert!(slam.poses().len() > before + 20);
    let proximity = slam
        .links()
        .filter(|it| it.1 >= before && it.0 < before && it.2 != ConstraintKind::Sequential);
    assert!(proximity.count() > 5, "the new scans are tied to the old ones");
}

/// Five rounds in one ring: kept scans stop growing, and so do bytes.
#[test]
fn a_life_in_one_building_is_bounded() {
    let moments = world().drive(&laps(6), 0.4, &ROUND, 5);
    let settings = Settings { is_lifelong: true, ..Settings::default() };
    let mut slam = Slam::new(settings);
    let lap = moments.len() / 6;
    let mut told = Vec::new();
    for (index, moment) in moments.iter().enumerate() {
        let update = slam.add_scan(&moment.scan, Some(moment.odometry));
        assert!(off(update.map_from_base, moment.truth) < 0.25, "{index} {update:?}");
        if index % lap == lap - 1 {
            told.push((slam.poses().len(), slam.links().count(), slam.save().len()));
        }
    }
    let mut inlier_ratio = Slam::new(Settings::default());
    add(&mut inlier_ratio, &moments);
    let all = inlier_ratio.poses().len();
    let (second, last) = (told[1], told[told.len() - 1]);
    assert!(last.0 < second.0 + second.0 / 5, "{told:?}, without it {all}");
    assert!(last.1 < second.1 * 3 / 2 && last.2 < second.2 * 3 / 2, "{told:?}");
    assert!(all > 3 * last.0, "{told:?}, without it {all}");
    // What is left is a map still: every line of the trajectory that is kept has its scan.
    assert_eq!(slam.kept().len(), slam.poses().len());
    slam.finish();
    let found = slam.trajectory();
    let (time_ns, pose) = found[found.len() - 1];
    let truth = moments.iter().find(|it| it.scan.time_ns == time_ns).unwrap().truth;
    assert!(off(pose, truth) < 0.1, "{pose:?} {truth:?}");
    // And a session of it is one like any other.
    let saved = slam.save();
    assert_eq!(Slam::resume(&saved, Settings::default()).unwrap().save(), saved);
}

#[test]
fn a_scan_that_is_moved_by_hand_bends_the_map() {
    let robot = Robot { bias_rad_per_m: 0.0, ..ROUND };
    // A bare ring: along the corridors only odometry measures the distance.
    let mut world = World { walls: Vec::new() };
    world.rectangle([-1.2, -1.2, 25.2, 15.2]);
    world.rectangle([1.2, 1.2, 22.8, 12.8]);
    let corners =
        [(6.0, 0.0), (24.0, 0.0), (24.0, 14.0), (0.0, 14.0), (0.0, 0.0), (6.0, 0.0), (7.0, 0.0)];
    let moments = world.drive(&corners, 0.5, &robot, 5);
    let mut slam = Slam::new(Settings { closes_loops: false, ..Settings::default() });
    for moment in &moments {
        // Wheels that are too large.
        let odometry =
            Pose2::new(1.1 * moment.odometry.x_m, moment.odometry.y_m, moment.odometry.yaw_rad);
        let _ = slam.add_scan(&moment.scan, Some(odometry));
    }
    let keyframe = slam.poses().len() - 1;
    let at = slam.kept()[keyframe];
    // The map begins where odometry does.
    let truth_of = |index: usize| {
        Pose2::new(6.6, 0.0, 0.0) * (moments[0].truth.inverse() * moments[index].truth)
    };
    let before = off(slam.poses()[keyframe], truth_of(at));
    let moved = BTreeMap::from([(keyframe, truth_of(at))]);
    assert_eq!(slam.add_manual_constraints(&moved), 1);
    slam.work_slices(usize::MAX);
    let after = off(slam.poses()[keyframe], truth_of(at));
    assert!(after < 0.3 && after < 0.7 * before, "{before} {after}");
    let told = slam.closures().last().unwrap();
    assert!(told.is_accepted && told.reason.starts_with("moved by hand"), "{told:?}");
    assert!(slam.links().any(|it| it.2 == ConstraintKind::LoopClosure));
    // What is not there cannot be moved.
    assert_eq!(slam.add_manual_constraints(&BTreeMap::from([(9999, Pose2::IDENTITY)])), 0);
}
