//! Localization of a robot that drives through a known room.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::f64::consts::{PI, TAU};

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting, Stream, normalize_angle};
use periplus_grid::{Grid, GridInfo, OccupancyGrid, occupancy};
use periplus_localization::{
    Amcl, AmclCompat, InitialPose, LocalizationState, MotionModel, SensorModel, Settings,
    expected_range_m,
};

/// Map of a room of 12 by 8 metres without symmetries.
fn room(origin: Pose2) -> OccupancyGrid {
    let info = GridInfo::new(0.05, 240, 160, origin).unwrap();
    let mut map = Grid::new(info, occupancy::FREE);
    let boxes = [
        (0, 0, 240, 4),
        (0, 156, 240, 160),
        (0, 0, 4, 160),
        (236, 0, 240, 160),
        (60, 90, 74, 104),
        (150, 0, 156, 70),
        (200, 120, 240, 160),
        (0, 0, 30, 20),
    ];
    for (left, low, right, high) in boxes {
        for row in low..high {
            for column in left..right {
                map[(column, row)] = occupancy::OCCUPIED;
            }
        }
    }
    map
}

const BEAMS: usize = 180;

/// Scan of a scanner at the center of the robot: steps of 0.01 m along each beam.
fn simulate_scan(map: &OccupancyGrid, map_from_base: Pose2, stream: &mut Stream) -> LaserScan2 {
    let cell_transform = map.info.finder();
    let range = |beam: usize, stream: &mut Stream| {
        let angle = map_from_base.yaw_rad - PI + beam as f64 * TAU / BEAMS as f64;
        let (sine, cosine) = libm::sincos(angle);
        let hit = (1..1000).map(|step| 0.01 * f64::from(step)).find(|range| {
            let (x, y) = (map_from_base.x_m + range * cosine, map_from_base.y_m + range * sine);
            cell_transform.cell_of(x, y).is_none_or(|cell| map[cell] == occupancy::OCCUPIED)
        });
        hit.map_or(f32::INFINITY, |range| (range + 0.01 * stream.normal()) as f32)
    };
    LaserScan2 {
        time_ns: 0,
        time_increment_s: 0.0,
        mounting: ScannerMounting::upright(Pose2::IDENTITY),
        angle_min_rad: -PI,
        angle_increment_rad: TAU / BEAMS as f64,
        range_min_m: 0.05,
        range_max_m: 10.0,
        ranges_m: (0..BEAMS).map(|beam| range(beam, stream)).collect(),
    }
}

/// True pose of the robot after a number of steps of its round.
fn truth(step: usize) -> Pose2 {
    let angle = 0.08 * step as f64;
    let (sine, cosine) = libm::sincos(angle);
    Pose2::new(3.5 + 1.8 * cosine, 3.0 + 0.9 * sine, normalize_angle(angle + 0.5 * PI))
}

fn initial_pose_at(pose: Pose2) -> InitialPose {
    let mut covariance = [0.0; 36];
    (covariance[0], covariance[7], covariance[35]) = (0.06, 0.06, 0.03);
    InitialPose { frame: "map".into(), pose, covariance, then_from_now: Pose2::IDENTITY }
}

/// Settings without the extensions to Nav2.
fn nav2() -> Settings {
    Settings {
        localizes_globally: false,
        refines_by_scan_matching: false,
        searches_when_lost: false,
        ..Settings::default()
    }
}

/// Drives a round and returns the maximum error after convergence \[m\], \[rad\].
fn drive(settings: Settings) -> (f64, f64) {
    let map = room(Pose2::IDENTITY);
    let mut amcl = Amcl::new(settings);
    amcl.set_map("map", &map).unwrap();
    let mut stream = Stream::keyed(5, "drive", 0);
    amcl.set_pose(&initial_pose_at(truth(0) * Pose2::new(0.1, -0.1, 0.1))).unwrap();
    // Odometry has another origin and reports distances 3 % too long.
    let mut odom_from_base = Pose2::new(-2.0, 7.0, 1.0);
    let mut worst = (0.0_f64, 0.0_f64);
    for step in 0..60 {
        if step > 0 {
            let moved = truth(step - 1).inverse() * truth(step);
            let counted = Pose2 { x_m: 1.03 * moved.x_m, ..moved };
            odom_from_base = odom_from_base * counted;
        }
        amcl.request_update();
        let scan = simulate_scan(&map, truth(step), &mut stream);
        let update = amcl.update(odom_from_base, &scan).unwrap().unwrap();
        if step < 15 {
            continue;
        }
        assert_eq!(
            update.status.state,
            LocalizationState::Tracking,
            "step {step}: {:?}",
            update.status
        );
        let error = truth(step).inverse() * update.estimate.pose;
        worst.0 = worst.0.max(libm::hypot(error.x_m, error.y_m));
        worst.1 = worst.1.max(normalize_angle(error.yaw_rad).abs());
        let base = update.map_from_odom * odom_from_base;
        assert!((base.x_m - update.estimate.pose.x_m).abs() < 1e-9);
    }
    worst
}

#[test]
fn every_model_tracks_the_pose() {
    for model in [SensorModel::LikelihoodField, SensorModel::LikelihoodFieldProb, SensorModel::Beam]
    {
        for motion_model in [MotionModel::Differential, MotionModel::Omnidirectional] {
            let mut settings = Settings {
                sensor_model: model,
                motion_model,
                motion_noise: [0.05; 5],
                ..Settings::default()
            };
            settings.kld_sampling.max_particles =
                if model == SensorModel::Beam { 300 } else { 1000 };
            settings.kld_sampling.min_particles = 300;
            let (metres, radians) = drive(settings);
            assert!(
                metres < 0.06 && radians < 0.03,
                "{model:?} {motion_model:?}: {metres} m, {radians} rad"
            );
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let run = |seed| {
        let map = room(Pose2::IDENTITY);
        let mut amcl = Amcl::new(Settings { seed, ..Settings::default() });
        amcl.set_map("map", &map).unwrap();
        amcl.set_pose(&initial_pose_at(truth(0))).unwrap();
        for step in 0..4 {
            let scan = simulate_scan(&map, truth(step), &mut Stream::keyed(1, "scan", step as u64));
            amcl.request_update();
            amcl.update(truth(step), &scan).unwrap();
        }
        amcl.particles().clone()
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

#[test]
fn global_localization_finds_the_pose() {
    let map = room(Pose2::new(-3.0, 20.0, 0.4));
    for step in [0, 20, 50] {
        // The room is rotated in the map frame.
        let truth = map.info.origin * truth(step);
        let mut amcl = Amcl::new(Settings::default());
        amcl.set_map("map", &map).unwrap();
        let scan = simulate_scan(&map, truth, &mut Stream::keyed(3, "scan", 0));
        let places = amcl.localize_globally(&scan).unwrap();
        assert!(!amcl.has_pose());
        let update = amcl.update(Pose2::IDENTITY, &scan).unwrap().unwrap();
        let error = truth.inverse() * update.estimate.pose;
        let is_near = libm::hypot(error.x_m, error.y_m) < 0.15;
        assert!(is_near && normalize_angle(error.yaw_rad).abs() < 0.1, "{places:?} {error:?}");
        assert!(amcl.has_pose());
        // The first update does the same on its own.
        let mut other = Amcl::new(Settings::default());
        other.set_map("map", &map).unwrap();
        assert_eq!(other.update(Pose2::IDENTITY, &scan), Ok(Some(update)));
    }
}

#[test]
fn uniform_particles_are_ambiguous_and_a_wrong_pose_is_lost() {
    let map = room(Pose2::IDENTITY);
    let mut amcl = Amcl::new(Settings::default());
    amcl.set_map("map", &map).unwrap();
    amcl.distribute_uniformly().unwrap();
    assert_eq!(amcl.particles().len(), 2000);
    let scan = simulate_scan(&map, truth(0), &mut Stream::keyed(4, "scan", 0));
    let update = amcl.update(Pose2::IDENTITY, &scan).unwrap().unwrap();
    // The search starts at once, since no particle is at a matching pose.
    let error = truth(0).inverse() * update.estimate.pose;
    assert_eq!(update.status.state, LocalizationState::Tracking, "{:?}", update.status);
    assert!(libm::hypot(error.x_m, error.y_m) < 0.1, "{error:?}");
    // Without the search it does not report a known pose.
    let plain = Settings { compat: AmclCompat::Nav2, ..nav2() };
    let mut amcl = Amcl::new(plain);
    amcl.set_map("map", &map).unwrap();
    amcl.distribute_uniformly().unwrap();
    let update = amcl.update(Pose2::IDENTITY, &scan).unwrap().unwrap();
    assert_ne!(update.status.state, LocalizationState::Tracking, "{:?}", update.status);
    // In open space, where the scan does not match.
    let mut sure = initial_pose_at(Pose2::new(9.5, 4.5, 2.0));
    sure.covariance = [0.0; 36];
    amcl.set_pose(&sure).unwrap();
    let update = amcl.update(Pose2::IDENTITY, &scan).unwrap().unwrap();
    assert_eq!(update.status.state, LocalizationState::Lost, "{:?}", update.status);
}

#[test]
fn augmented_mcl_reacts_to_kidnapping() {
    let map = room(Pose2::IDENTITY);
    let settings = Settings { recovery_alphas: [0.001, 0.5], ..nav2() };
    let mut amcl = Amcl::new(settings);
    amcl.set_map("map", &map).unwrap();
    amcl.set_pose(&initial_pose_at(truth(0))).unwrap();
    let mut stream = Stream::keyed(6, "scan", 0);
    let mut shares = Vec::new();
    for step in 0..8 {
        // Kidnapped after the fourth scan.
        let place = if step < 4 { truth(0) } else { Pose2::new(9.5, 4.5, 2.0) };
        let scan = simulate_scan(&map, place, &mut stream);
        amcl.request_update();
        shares.push(amcl.update(Pose2::IDENTITY, &scan).unwrap().unwrap().random_fraction);
    }
    assert!(shares[..4].iter().all(|share| *share < 0.1), "{shares:?}");
    assert!(shares[4..].iter().any(|share| *share > 0.1), "{shares:?}");
}

#[test]
fn a_kidnapped_robot_is_relocalized() {
    let map = room(Pose2::IDENTITY);
    let mut amcl = Amcl::new(Settings::default());
    amcl.set_map("map", &map).unwrap();
    amcl.set_pose(&initial_pose_at(truth(0))).unwrap();
    let mut stream = Stream::keyed(6, "scan", 0);
    let elsewhere = Pose2::new(9.5, 4.5, 2.0);
    let mut last = None;
    let mut truth = truth(0);
    let ahead = Pose2::new(0.2, 0.0, 0.0);
    let mut odom_from_base = Pose2::IDENTITY;
    for step in 0..12 {
        (truth, odom_from_base) = (truth * ahead, odom_from_base * ahead);
        if step == 4 {
            // Kidnapped.
            truth = elsewhere;
        }
        let scan = simulate_scan(&map, truth, &mut stream);
        amcl.request_update();
        last = amcl.update(odom_from_base, &scan).unwrap();
    }
    let last = last.unwrap();
    let error = truth.inverse() * last.estimate.pose;
    assert_eq!(last.status.state, LocalizationState::Tracking, "{:?}", last.status);
    assert!(libm::hypot(error.x_m, error.y_m) < 0.1 && error.yaw_rad.abs() < 0.05, "{error:?}");
}

#[test]
fn off_the_map_odometry_continues_and_the_pose_is_doubted() {
    let whole = room(Pose2::IDENTITY);
    // The map ends behind the wall into the room.
    let mut known = whole.clone();
    for row in 0..160 {
        for column in 150..240 {
            known[(column, row)] = occupancy::UNKNOWN;
        }
    }
    let mut amcl = Amcl::new(Settings::default());
    amcl.set_map("map", &known).unwrap();
    let mut place = Pose2::new(2.0, 5.8, 0.0);
    let mut sure = initial_pose_at(place);
    sure.covariance.iter_mut().for_each(|it| *it *= 0.05);
    amcl.set_pose(&sure).unwrap();
    let mut stream = Stream::keyed(11, "scan", 0);
    let mut states = Vec::new();
    for step in 0..60 {
        // There and back, with a half turn in place in between.
        let moved = match step {
            0..28 => Pose2::new(0.25, 0.0, 0.0),
            28..36 => Pose2::new(0.0, 0.0, PI / 8.0),
            _ => Pose2::new(0.25, 0.0, 0.0),
        };
        place = place * moved;
        let update = amcl.update(place, &simulate_scan(&whole, place, &mut stream)).unwrap();
        let found = amcl.map_from_odom().unwrap() * place;
        let off = libm::hypot(found.x_m - place.x_m, found.y_m - place.y_m);
        assert!(off < if step < 59 { 1.0 } else { 0.05 }, "step {step}: {off} m, {update:?}");
        states.push(amcl.status().state);
    }
    assert_eq!(
        (states[2], states[59]),
        (LocalizationState::Tracking, LocalizationState::Tracking),
        "{states:?}"
    );
    assert_ne!(states[30], LocalizationState::Tracking, "{states:?}");
}

#[test]
fn similar_poses_are_ambiguous_until_one_remains() {
    // Two rooms side by side, alike but for a box in the corner of one, behind its pillar.
    let info = GridInfo::new(0.05, 200, 80, Pose2::IDENTITY).unwrap();
    let mut map = Grid::new(info, occupancy::FREE);
    let boxes = [
        (0, 0, 200, 2),
        (0, 78, 200, 80),
        (0, 0, 2, 80),
        (99, 0, 101, 80),
        (198, 0, 200, 80),
        (40, 30, 48, 60),
        (139, 30, 147, 60),
        (56, 60, 76, 76),
    ];
    for (left, low, right, high) in boxes {
        for row in low..high {
            for column in left..right {
                map[(column, row)] = occupancy::OCCUPIED;
            }
        }
    }
    let mut amcl = Amcl::new(Settings::default());
    amcl.set_map("map", &map).unwrap();
    let mut stream = Stream::keyed(8, "scan", 0);
    let mut states = Vec::new();
    let mut offset_m = None;
    for step in 0..16 {
        let truth = Pose2::new(1.0 + 0.2 * f64::from(step), 0.9, 0.0);
        let scan = simulate_scan(&map, truth, &mut stream);
        amcl.request_update();
        let update = amcl.update(truth, &scan).unwrap().unwrap();
        states.push(update.status.state);
        if update.status.state == LocalizationState::Ambiguous {
            assert!(!amcl.has_pose());
            offset_m = update
                .status
                .hypotheses
                .first()
                .map(|other| other.mean.x_m - truth.x_m)
                .or(offset_m);
        } else {
            let x_m = update.estimate.pose.x_m;
            assert!((x_m - truth.x_m).abs() < 0.1, "step {step}: sure of a wrong place {x_m}");
        }
    }
    assert_eq!(
        (states[0], states[15]),
        (LocalizationState::Ambiguous, LocalizationState::Tracking),
        "{states:?}"
    );
    assert!(offset_m.is_some_and(|aside| (aside.abs() - 4.95).abs() < 0.1), "{offset_m:?}");
}

#[test]
fn updates_need_motion() {
    let map = room(Pose2::IDENTITY);
    let mut amcl = Amcl::new(Settings::default());
    amcl.set_map("map", &map).unwrap();
    amcl.set_pose(&initial_pose_at(truth(0))).unwrap();
    let scan = simulate_scan(&map, truth(0), &mut Stream::keyed(3, "scan", 0));
    let mut is_used =
        |x_m, yaw_rad| amcl.update(Pose2::new(x_m, 0.0, yaw_rad), &scan).unwrap().is_some();
    assert!(is_used(0.0, 0.0), "the first");
    assert!(!is_used(0.25, 0.0), "exactly the threshold");
    assert!(is_used(0.26, 0.0));
    assert!(!is_used(0.26, 0.2));
    assert!(is_used(0.26, 0.21));
    assert!(!is_used(0.26, 0.21));
    amcl.request_update();
    assert!(amcl.update(Pose2::new(0.26, 0.0, 0.21), &scan).unwrap().is_some());
}

#[test]
fn invalid_inputs_are_errors_and_change_nothing() {
    let map = room(Pose2::IDENTITY);
    let scan = simulate_scan(&map, truth(0), &mut Stream::keyed(3, "scan", 0));
    let mut amcl = Amcl::new(Settings { localizes_globally: false, ..Settings::default() });
    assert_eq!(amcl.update(Pose2::IDENTITY, &scan).unwrap_err().code, "no-map");
    assert_eq!(amcl.distribute_uniformly().unwrap_err().code, "no-map");
    assert_eq!(amcl.set_map("world", &map).unwrap_err().code, "map-in-other-frame");
    let info = GridInfo::new(0.05, 4, 4, Pose2::IDENTITY).unwrap();
    let bare = Grid::new(info, occupancy::FREE);
    assert_eq!(amcl.set_map("map", &bare).unwrap_err().code, "map-without-walls");
    let none = Grid::new(GridInfo::new(0.05, 0, 4, Pose2::IDENTITY).unwrap(), 0);
    assert_eq!(amcl.set_map("map", &none).unwrap_err().code, "empty-map");
    amcl.set_map("map", &map).unwrap();
    assert_eq!(amcl.update(Pose2::IDENTITY, &scan).unwrap_err().code, "no-initial-pose");

    let good = initial_pose_at(truth(0));
    let code = |amcl: &mut Amcl, initial_pose_at: InitialPose| {
        amcl.set_pose(&initial_pose_at).unwrap_err().code
    };
    let other = InitialPose { frame: "odom".into(), ..good.clone() };
    assert_eq!(code(&mut amcl, other), "guess-in-other-frame");
    for (entry, value) in [(0, f64::NAN), (35, -1.0), (7, 1e10), (1, 9.0), (14, f64::INFINITY)] {
        let mut bad = good.clone();
        bad.covariance[entry] = value;
        assert_eq!(code(&mut amcl, bad), "bad-covariance", "entry {entry} {value}");
    }
    let outside = InitialPose { pose: Pose2::new(12.1, 3.0, 0.0), ..good.clone() };
    assert_eq!(code(&mut amcl, outside), "guess-outside-of-map");
    let wild = InitialPose { pose: Pose2::new(f64::NAN, 3.0, 0.0), ..good.clone() };
    assert_eq!(code(&mut amcl, wild), "bad-guess");
    assert!(amcl.particles().is_empty());
    let wall = InitialPose { pose: Pose2::new(0.1, 3.0, 0.0), ..good.clone() };
    assert_eq!(amcl.set_pose(&wall).unwrap().unwrap().code, "guess-not-free");
    assert_eq!(amcl.set_pose(&good).unwrap(), None);
    let empty = LaserScan2 { ranges_m: vec![], ..scan.clone() };
    assert_eq!(amcl.update(Pose2::IDENTITY, &empty).unwrap_err().code, "empty-scan");
    let wild = Pose2::new(f64::NAN, 0.0, 0.0);
    assert_eq!(amcl.update(wild, &scan).unwrap_err().code, "bad-odometry");
    assert!(amcl.update(Pose2::IDENTITY, &scan).unwrap().is_some());
    // A scan without hits is not an error: odometry continues.
    let blind = LaserScan2 { ranges_m: vec![f32::INFINITY; 9], ..scan };
    let update = amcl.update(Pose2::new(1.0, 0.0, 0.0), &blind).unwrap().unwrap();
    assert_eq!(update.status.inlier_ratio, None);
    assert_eq!(amcl.localize_globally(&blind).unwrap_err().code, "fits-nowhere");
}

#[test]
fn an_initial_pose_waits_for_a_map_and_survives_a_new_one() {
    let map = room(Pose2::IDENTITY);
    let mut amcl = Amcl::new(Settings { first_map_only: true, ..Settings::default() });
    assert_eq!(amcl.set_pose(&initial_pose_at(truth(7))).unwrap().unwrap().code, "no-map");
    assert_eq!(amcl.set_map("map", &map), Ok(true));
    let near = |amcl: &Amcl| (amcl.estimate().unwrap().pose.x_m - truth(7).x_m).abs() < 0.2;
    assert!(near(&amcl));
    assert_eq!(amcl.set_map("map", &map), Ok(false), "only the first");
    amcl.set_settings(Settings { localizes_globally: false, ..Settings::default() }).unwrap();
    assert_eq!(amcl.set_map("map", &map), Ok(true));
    assert!(near(&amcl));
    // A map that does not contain the pose of the robot.
    let elsewhere = room(Pose2::new(50.0, 0.0, 0.0));
    assert_eq!(amcl.set_map("map", &elsewhere).unwrap_err().code, "guess-outside-of-map");
    let scan = simulate_scan(&map, truth(7), &mut Stream::keyed(3, "scan", 0));
    assert_eq!(amcl.update(Pose2::IDENTITY, &scan).unwrap_err().code, "no-initial-pose");
}

#[test]
fn nav2_compatibility_shifts_the_map_by_half_a_cell() {
    let map = room(Pose2::IDENTITY);
    let range = |compat| {
        let settings = Settings { compat, ..Settings::default() };
        let mut amcl = Amcl::new(settings);
        amcl.set_map("map", &map).unwrap();
        let known = amcl.map().unwrap();
        (known.cell_center((2, 3)), expected_range_m(known, (3.51, 7.01), 0.5 * PI, 10.0))
    };
    let (right, shifted) = (range(AmclCompat::None), range(AmclCompat::Nav2));
    assert!((right.0.0 - 0.125).abs() < 1e-12 && (shifted.0.0 - 0.1).abs() < 1e-12);
    assert!((right.1 - 0.8).abs() < 1e-9, "{right:?}");
}

/// Drives the round from its left end, with an error of odometry in one step. Returns the maximum error
/// \[m\], \[rad\], and the minimum inlier ratio.
fn follow(map: &OccupancyGrid, slip: Pose2) -> (f64, f64, f64) {
    let mut amcl = Amcl::new(Settings::default());
    amcl.set_map("map", map).unwrap();
    amcl.set_pose(&initial_pose_at(truth(39))).unwrap();
    let mut stream = Stream::keyed(8, "follow", 0);
    let mut odom_from_base = Pose2::IDENTITY;
    let mut worst = (0.0_f64, 0.0_f64, 1.0_f64);
    for step in 40..118 {
        odom_from_base = odom_from_base * (truth(step - 1).inverse() * truth(step));
        if step == 60 {
            odom_from_base = odom_from_base * slip;
        }
        amcl.update(
            odom_from_base,
            &simulate_scan(&room(Pose2::IDENTITY), truth(step), &mut stream),
        )
        .unwrap();
        // Odometry and the scan contradict each other once: the pose is doubted.
        let is_doubted = step == 60 && slip != Pose2::IDENTITY;
        let state =
            if is_doubted { LocalizationState::Ambiguous } else { LocalizationState::Tracking };
        assert_eq!(amcl.status().state, state, "step {step}: {:?}", amcl.status());
        let error = truth(step).inverse() * (amcl.map_from_odom().unwrap() * odom_from_base);
        worst.0 = worst.0.max(libm::hypot(error.x_m, error.y_m));
        worst.1 = worst.1.max(normalize_angle(error.yaw_rad).abs());
        worst.2 = worst.2.min(amcl.status().inlier_ratio.unwrap());
    }
    worst
}

#[test]
fn a_gross_error_of_odometry_does_not_lose_the_robot() {
    let (metres, radians, _) = follow(&room(Pose2::IDENTITY), Pose2::new(0.2, 0.1, 0.35));
    assert!(metres < 0.1 && radians < 0.03, "{metres} m, {radians} rad");
}

#[test]
fn hits_beyond_the_edge_of_the_map_are_no_contradiction() {
    let mut map = room(Pose2::IDENTITY);
    for index in 0..map.cells.len() {
        // The right part of the room is unknown: a third of the beams ends there.
        if map.info.cell(index).0 > 160 {
            map.cells[index] = occupancy::UNKNOWN;
        }
    }
    let (metres, radians, fit) = follow(&map, Pose2::IDENTITY);
    assert!(metres < 0.1 && radians < 0.03, "{metres} m, {radians} rad");
    assert!(fit > 0.85, "{fit}");
}
