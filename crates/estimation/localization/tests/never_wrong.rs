//! A robot off the map, or kidnapped, does not report a wrong pose as known, and searches the map with
//! bounded work per scan.

#![allow(clippy::unwrap_used, reason = "a test")]

#[path = "../examples/starts/courses.rs"]
#[allow(dead_code, clippy::disallowed_methods, reason = "each test uses its part")]
mod courses;
#[path = "../examples/worlds/mod.rs"]
#[allow(dead_code, reason = "each test uses its part")]
mod worlds;

use courses::{Course, Cover, erased, rearranged};
use periplus_geometry::Stream;
use periplus_grid::{OccupancyGrid, occupancy};
use periplus_localization::{Amcl, LocalizationState, Settings};
use worlds::{Wanderer, World, initial_pose_at, off};

/// Maximum number of scans with a wrong known pose before it is detected.
const NOTICED: usize = 2;
/// Maximum error of a right pose \[m\], \[rad\].
const RIGHT: (f64, f64) = (1.0, 0.52);

fn amcl(map: &OccupancyGrid, seed: u64) -> Amcl {
    let mut amcl = Amcl::new(Settings { seed, ..Settings::default() });
    amcl.set_map("map", map).unwrap();
    amcl
}

/// True if the pose is known, and true if it is known and wrong.
fn is_sure(amcl: &Amcl, robot: &Wanderer) -> (bool, bool) {
    let is_sure = amcl.status().state == LocalizationState::Tracking;
    let found = amcl.map_from_odom().map(|it| it * robot.odom_from_base);
    let is_right = found.is_some_and(|found| {
        let (metres, radians) = off(robot.truth, found);
        metres < RIGHT.0 && radians < RIGHT.1
    });
    (is_sure, is_sure && !is_right)
}

#[test]
fn on_a_wrong_map_the_pose_is_not_known() {
    let pairs = [
        (World::house(), World::office(), true),
        (World::office(), World::house(), false),
        (World::office(), World::cave(), true),
    ];
    for (seed, (world, other, has_initial_pose)) in (0..).zip(pairs) {
        let (map, wrong) = (world.map(), other.map());
        let mut stream = Stream::keyed(seed, "foreign", 0);
        let mut amcl = amcl(&wrong, seed);
        let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
        if has_initial_pose {
            amcl.set_pose(&initial_pose_at(other.random_pose(&wrong, &mut stream))).unwrap();
        }
        let mut sure = 0;
        for _ in 0..160 {
            robot.step(&world, &mut stream);
            let scan = world.scan(robot.truth, &mut stream);
            let _ = amcl.update(robot.odom_from_base, &scan);
            sure += usize::from(amcl.status().state == LocalizationState::Tracking);
        }
        assert!(sure <= NOTICED, "{} on {}: sure {sure} times", world.name, other.name);
    }
}

#[test]
fn off_the_map_the_pose_is_not_known() {
    for (seed, world) in (0..).zip([World::office(), World::store()]) {
        let whole = world.map();
        let mut stream = Stream::keyed(seed, "off the map", 0);
        let mut robot = Wanderer::new(world.random_pose(&whole, &mut stream), &mut stream);
        // The map ends 1 m to the right of the initial pose.
        let mut known = whole.clone();
        let end_m = robot.truth.x_m + 1.0;
        let (mut is_known, info) = (0, known.info);
        for index in 0..known.cells.len() {
            let (column, row) = info.cell(index);
            if info.point_at(column as f64, row as f64).0 > end_m {
                known.cells[index] = occupancy::UNKNOWN;
            }
            is_known += usize::from(known.cells[index] == occupancy::OCCUPIED);
        }
        assert!(is_known > 100);
        let mut amcl = amcl(&known, seed);
        amcl.set_pose(&initial_pose_at(robot.truth)).unwrap();
        let (mut sure, mut wrong) = (0, 0);
        for _ in 0..330 {
            robot.step(&world, &mut stream);
            amcl.update(robot.odom_from_base, &world.scan(robot.truth, &mut stream)).unwrap();
            let (is_sure, is_wrong) = is_sure(&amcl, &robot);
            // Beyond the last known wall.
            sure += usize::from(is_sure && robot.truth.x_m > end_m + 1.0);
            wrong += usize::from(is_wrong);
        }
        assert!(sure <= NOTICED && wrong <= NOTICED, "{}: {sure}, {wrong}", world.name);
    }
}

/// Localizes part of a drive through the store on a changed map. Returns the number of scans with a known
/// pose, with a wrong known pose, and with a wrong known pose off the map.
fn sure_and_wrong(course: &Course, map: &OccupancyGrid, first: usize, count: usize) -> [usize; 3] {
    let cover = Cover::new(map);
    let mut amcl = amcl(map, 0);
    amcl.set_pose(&initial_pose_at(course.sights[first].map_from_base)).unwrap();
    let mut counts = [0; 3];
    for sight in &course.sights[first..first + count] {
        amcl.update(sight.odom_from_base, &sight.scan).unwrap();
        if amcl.status().state == LocalizationState::Tracking {
            let found = amcl.map_from_odom().unwrap() * sight.odom_from_base;
            let (metres, radians) = off(sight.map_from_base, found);
            let is_right = metres < RIGHT.0 && radians < RIGHT.1;
            counts[0] += 1;
            counts[1] += usize::from(!is_right);
            counts[2] += usize::from(!is_right && !cover.covers(sight));
        }
    }
    counts
}

#[test]
fn at_the_edge_of_the_map_scan_matching_does_not_hold_the_pose() {
    // Between two shelves all poses look alike, except at the ends of the known ones.
    let course = Course::of_world(&World::store(), 0);
    let map = erased(&course, std::f64::consts::FRAC_PI_2 * 2.3);
    let cover = Cover::new(&map);
    let first = course.sights.iter().position(|sight| cover.covers(sight)).unwrap();
    let [sure, wrong, off_map] = sure_and_wrong(&course, &map, first, 500);
    assert!(sure > 50 && wrong <= NOTICED && off_map <= NOTICED, "{sure} {wrong} {off_map}");
}

#[test]
fn with_moved_furniture_a_known_pose_is_right() {
    let course = Course::of_world(&World::store(), 0);
    for (number, share, least) in [(0, 0.1, 100), (1, 0.25, 50)] {
        let map = rearranged(&course, share, &mut Stream::keyed(0, "moved", number));
        let [sure, wrong, _] = sure_and_wrong(&course, &map, 0, 900);
        assert!(sure > least && wrong <= NOTICED, "{share} moved: {wrong} of {sure} are wrong");
    }
}

#[test]
fn a_kidnapped_robot_is_relocalized_or_not_known() {
    let mut found = 0;
    for world in [World::office(), World::store()] {
        let map = world.map();
        for seed in 0..4 {
            let mut stream = Stream::keyed(seed, "carried", 0);
            let mut amcl = amcl(&map, seed);
            let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
            amcl.set_pose(&initial_pose_at(robot.truth)).unwrap();
            let (mut are_sure, mut is_wrong) = (false, false);
            for step in 0..110 {
                if step == 30 {
                    // Kidnapped.
                    robot.truth = world.random_pose(&map, &mut stream);
                }
                robot.step(&world, &mut stream);
                amcl.update(robot.odom_from_base, &world.scan(robot.truth, &mut stream)).unwrap();
                (are_sure, is_wrong) = is_sure(&amcl, &robot);
            }
            assert!(!is_wrong, "{} {seed}: {:?}", world.name, amcl.status());
            found += usize::from(are_sure);
        }
    }
    // Rooms are similar, so that not all are found.
    assert!(found >= 6, "{found} of 8 are found");
}

#[test]
fn the_search_of_the_map_is_sliced() {
    // A robot off the map searches repeatedly.
    let (world, other) = (World::cave(), World::office());
    let map = world.map();
    let mut stream = Stream::keyed(1, "budget", 0);
    let mut amcl = amcl(&other.map(), 1);
    let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
    let mut searched = Vec::new();
    for _ in 0..120 {
        robot.step(&world, &mut stream);
        let _ = amcl.update(robot.odom_from_base, &world.scan(robot.truth, &mut stream));
        searched.push(amcl.search_lookup_count());
    }
    // The first slice is larger.
    let (first, later) = searched.split_first().unwrap();
    assert!(*first > 100_000 && *first < 14_000_000, "{first}");
    let most = later.iter().max().unwrap();
    let sum: u64 = later.iter().sum();
    assert!(sum > 1_000_000 && *most < 4_000_000, "at most {most}, in all {sum}");
    // Without motion or change no new search starts.
    let scan = world.scan(robot.truth, &mut stream);
    let again: u64 = (0..60)
        .map(|_| {
            let _ = amcl.update(robot.odom_from_base, &scan);
            amcl.search_lookup_count()
        })
        .skip(40)
        .sum();
    assert_eq!(again, 0);
}
