//! Particles in worlds whose truth is known.

mod worlds;

use periplus_geometry::{LaserScan2, Pose2, normalize_angle};
use periplus_slam::{Gmapping, GmappingSettings, Mapper, ScanOutcome};
use worlds::{Moment, ROBOT, Robot, World};

fn map_of(moments: &[Moment], settings: GmappingSettings) -> Gmapping {
    let mut slam = Gmapping::new(settings);
    for moment in moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
    slam.finish();
    slam
}

fn few() -> GmappingSettings {
    GmappingSettings { particles: 8, ..GmappingSettings::default() }
}

/// Largest error of position \[m\] and heading \[rad\], relative to the first pose.
fn worst(slam: &Gmapping, moments: &[Moment]) -> (f64, f64) {
    let trajectory = slam.trajectory();
    assert_eq!(trajectory.len(), moments.len());
    let truth_from_map = moments[0].truth * trajectory[0].1.inverse();
    let errors = trajectory.iter().zip(moments).map(|((_, found), moment)| {
        let off = moment.truth.inverse() * (truth_from_map * *found);
        (libm::hypot(off.x_m, off.y_m), normalize_angle(off.yaw_rad).abs())
    });
    errors.fold((0.0, 0.0), |worst, it| (f64::max(worst.0, it.0), f64::max(worst.1, it.1)))
}

/// A room of 8 m by 6 m with a box in it.
fn room() -> World {
    let mut world = World { walls: Vec::new() };
    world.rectangle([0.0, 0.0, 8.0, 6.0]);
    world.rectangle([5.0, 4.0, 6.0, 5.0]);
    world
}

const ROUND: [(f64, f64); 6] =
    [(1.0, 1.0), (7.0, 1.0), (7.0, 3.0), (1.0, 3.0), (1.0, 1.0), (4.0, 1.0)];

#[test]
fn a_room_is_mapped() {
    let moments = room().drive(&ROUND, 0.3, &ROBOT, 1);
    let slam = map_of(&moments, few());
    let (metres, radians) = worst(&slam, &moments);
    assert!(metres < 0.06 && radians < 0.02, "{metres} {radians}");
    // The map begins where odometry has the robot, and that is the truth at the start.
    let map = slam.map().unwrap();
    let is_wall = |x: f64, y: f64| {
        (-2..=2).any(|dx| {
            (-2..=2)
                .any(|dy| map.at(x + 0.05 * f64::from(dx), y + 0.05 * f64::from(dy)) == Some(&100))
        })
    };
    for step in 2..38 {
        let along = 0.2 * f64::from(step);
        assert!(is_wall(along, 0.0) && is_wall(along, 6.0), "{along}");
        assert!(along > 5.8 || (is_wall(0.0, along) && is_wall(8.0, along)), "{along}");
    }
    assert!(is_wall(5.0, 4.5) && is_wall(5.5, 4.0));
    // Free within, unknown outside and in the box.
    assert_eq!(map.at(3.0, 2.0), Some(&0));
    assert_eq!(map.at(5.5, 4.5), Some(&-1));
    assert_eq!(map.at(-0.15, 3.0), Some(&-1));
}

#[test]
fn a_loop_closes() {
    let world = World::ring(24.0, 14.0, 2.4, 1);
    let corners =
        [(6.0, 0.0), (24.0, 0.0), (24.0, 14.0), (0.0, 14.0), (0.0, 0.0), (6.0, 0.0), (14.0, 0.0)];
    let moments = world.drive(&corners, 0.5, &ROBOT, 1);
    let slam = map_of(&moments, GmappingSettings::default());
    let (metres, radians) = worst(&slam, &moments);
    assert!(metres < 0.35 && radians < 0.05, "{metres} {radians}");
}

/// Wheels that turn in and slip: at the end of a long round odometry is metres off.
const BAD: Robot = Robot { way_error: 0.1, turn_error: 0.1, bias_rad_per_m: 0.03, ..ROBOT };

#[test]
fn a_long_round_closes_with_every_seed() {
    let world = World::ring(50.0, 30.0, 2.4, 3);
    let corners =
        [(6.0, 0.0), (50.0, 0.0), (50.0, 30.0), (0.0, 30.0), (0.0, 0.0), (6.0, 0.0), (30.0, 0.0)];
    let moments = world.drive(&corners, 0.5, &BAD, 1);
    for seed in 0..3 {
        let slam = map_of(&moments, GmappingSettings { seed, ..few() });
        let (metres, radians) = worst(&slam, &moments);
        assert!(metres < 0.2 && radians < 0.03, "seed {seed}: {metres} {radians}");
        // The map is that of this way: walls of the first and of the last round are the same ones.
        let map = slam.map().unwrap();
        let walls = map.cells.iter().filter(|&&cell| cell == 100).count() as f64 * 0.05;
        assert!(walls < 1.6 * world.walls_m(), "seed {seed}: {walls} m of {}", world.walls_m());
    }
}

#[test]
fn maps_of_all_particles_stay_within_their_memory() {
    // A hall in fine cells: thirty maps of it would take far more.
    let mut hall = World { walls: Vec::new() };
    hall.rectangle([0.0, 0.0, 50.0, 40.0]);
    for at in 0..4_i8 {
        let x = 10.0 + 8.0 * f64::from(at);
        hall.rectangle([x, 14.0, x + 1.0, 15.5]);
    }
    let far = Robot { beams: 541, range_max_m: 80.0, field_rad: 6.0, ..ROBOT };
    let moments = hall.drive(&[(15.0, 10.0), (25.0, 10.0)], 0.5, &far, 1);
    let settings = GmappingSettings { resolution_m: 0.02, ..GmappingSettings::default() };
    let mut slam = Gmapping::new(settings);
    let mut most = 0;
    for moment in &moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
        most = most.max(slam.size());
    }
    assert!(most < 110_000_000, "{most} bytes");
    let told: Vec<String> = slam.remarks().iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|it| it.contains("too much memory")), "{told:?}");
    assert!(worst(&slam, &moments).0 < 0.2, "{:?}", worst(&slam, &moments));
}

#[test]
fn the_same_seed_gives_the_same_map_at_any_number_of_threads() {
    let moments = room().drive(&ROUND[..4], 0.3, &ROBOT, 2);
    // Resampling after every scan, so that the choice of ancestors matters.
    let often = GmappingSettings { resample_share: 1.0, ..few() };
    let of = |settings: GmappingSettings| {
        let slam = map_of(&moments, settings);
        assert!(slam.resamplings() > 3, "{}", slam.resamplings());
        (slam.trajectory(), slam.map())
    };
    let one = of(often.clone());
    assert!(one == of(often.clone()), "the second run is another");
    for threads in [2, 3, 64] {
        assert!(one == of(GmappingSettings { threads, ..often.clone() }), "{threads} threads");
    }
    assert!(one.0 != of(GmappingSettings { seed: 1, ..often }).0, "the seed changes nothing");
}

#[test]
fn particles_are_drawn_from_what_is_left_when_odometry_and_scans_say_nothing_new() {
    let moments = room().drive(&ROUND[..2], 0.3, &ROBOT, 3);
    let mut slam = Gmapping::new(few());
    let first = slam.add_scan(&moments[0].scan, Some(moments[0].odometry));
    assert_eq!(first.outcome, ScanOutcome::Inserted);
    // A robot that stands still changes nothing, however long.
    let pose = slam.map_from_base();
    for _ in 0..20 {
        let told = slam.add_scan(&moments[0].scan, Some(moments[0].odometry));
        assert_eq!(told.outcome, ScanOutcome::BelowMotionThreshold);
    }
    assert_eq!(slam.counts().kept, 1);
    let now = slam.map_from_base();
    assert!(libm::hypot(now.x_m - pose.x_m, now.y_m - pose.y_m) < 0.02);
    // With an update in time it does.
    let timed = GmappingSettings { update_time_s: Some(0.0), ..few() };
    let mut slam = Gmapping::new(timed);
    for _ in 0..3 {
        let _ = slam.add_scan(&moments[0].scan, Some(moments[0].odometry));
    }
    assert_eq!(slam.counts().kept, 3);
}

#[test]
fn bad_scans_say_nothing_and_break_nothing() {
    let mut moments = room().drive(&ROUND, 0.3, &ROBOT, 4);
    for (index, moment) in moments.iter_mut().enumerate() {
        match index % 7 {
            1 => moment.scan.ranges_m.fill(f32::NAN),
            2 => moment.scan.ranges_m.iter_mut().step_by(2).for_each(|it| *it = 0.0),
            3 => moment.scan.time_ns -= 3_000_000_000,
            4 => moment.scan.ranges_m.iter_mut().step_by(3).for_each(|it| *it = f32::INFINITY),
            5 => moment.odometry = Pose2::new(f64::NAN, 0.0, 0.0),
            _ => {}
        }
    }
    let slam = map_of(&moments, few());
    assert!(worst(&slam, &moments).0 < 0.25, "{:?}", worst(&slam, &moments));

    let mut slam = Gmapping::new(few());
    assert!(slam.map().is_some() && slam.trajectory().is_empty());
    let broken = LaserScan2 { angle_min_rad: f64::NAN, ..moments[0].scan.clone() };
    assert!(matches!(slam.add_scan(&broken, None).outcome, ScanOutcome::Rejected(_)));
    let empty = LaserScan2 { ranges_m: Vec::new(), ..moments[0].scan.clone() };
    for _ in 0..3 {
        let _ = slam.add_scan(&empty, None);
    }
    let far = Pose2::new(1e12, -1e300, 0.0);
    for odometry in [Some(far), None, Some(Pose2::IDENTITY)] {
        let _ = slam.add_scan(&moments[0].scan, odometry);
    }
    slam.finish();
    assert_eq!(slam.trajectory().len(), 6);
    let _ = slam.map();
}

#[test]
fn beams_beyond_the_drawn_range_free_cells_up_to_it() {
    let moments = room().drive(&ROUND[..2], 0.3, &ROBOT, 5);
    let near = GmappingSettings { range_used_m: 2.0, range_max_m: Some(10.0), ..few() };
    let mut slam = Gmapping::new(near);
    let _ = slam.add_scan(&moments[0].scan, Some(moments[0].truth));
    // From (1, 1) along x: free up to 3, unknown beyond; the wall at y = 0 is within.
    let map = slam.map().unwrap();
    assert_eq!(map.at(2.9, 1.1), Some(&0));
    assert_eq!(map.at(3.12, 1.1), Some(&-1));
    assert!((-1..=1).any(|row| map.at(1.5, 0.05 * f64::from(row)) == Some(&100)));
}
