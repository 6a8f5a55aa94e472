//! Rooms as drawings: `#` is wall, `.` is free, `?` is unknown; a cell is 0.1 m.

use periplus_exploration::{Explorer, Mood, Reach, Robot, Settings, Velocity, follow, frontiers};
use periplus_geometry::Pose2;
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use proptest::prelude::*;

const CELL_M: f64 = 0.1;

const ROBOT: Robot = Robot { radius_m: 0.15, comfort_m: 0.3 };

fn room(drawing: &[&str]) -> OccupancyGrid {
    let info = GridInfo::new(CELL_M, drawing[0].len(), drawing.len(), Pose2::default());
    let info = info.expect("a valid grid");
    let value = |letter| match letter {
        b'#' => 100,
        b'.' => 0,
        _ => -1,
    };
    // The first line is the highest.
    let cells = drawing.iter().rev().flat_map(|line| line.bytes().map(value)).collect();
    Grid::from_cells(info, cells).expect("as many cells as there are")
}

/// Pose in the middle of a cell, by column and line from below.
fn at(column: usize, row: usize) -> Pose2 {
    let middle = |cell: usize| (cell as f64 + 0.5) * CELL_M;
    Pose2 { x_m: middle(column), y_m: middle(row), yaw_rad: 0.0 }
}

const OPEN_TO_THE_RIGHT: &[&str] = &[
    "############",
    "#..........?",
    "#..........?",
    "#..........?",
    "#..........?",
    "#..........?",
    "#..........?",
    "############",
];

const CLOSED: &[&str] = &[
    "###########",
    "#.........#",
    "#.........#",
    "#.........#",
    "#.........#",
    "#.........#",
    "###########",
];

#[test]
fn a_frontier_is_where_free_meets_unknown() {
    let map = room(OPEN_TO_THE_RIGHT);
    let pose = at(2, 3);
    let reach = Reach::new(&map, &ROBOT, pose.x_m, pose.y_m).expect("on the map");
    let found = frontiers(&reach, 0.2);
    assert_eq!(found.len(), 1);
    // The cells next to the walls are too near for the robot.
    assert!((found[0].length_m - 0.4).abs() < 1e-9, "{found:?}");
    assert!((found[0].place_m[0] - 1.05).abs() < 1e-9, "{found:?}");
    assert!(frontiers(&reach, 0.5).is_empty(), "too short");
}

#[test]
fn a_closed_room_has_none_and_the_explorer_is_done() {
    let map = room(CLOSED);
    let pose = at(4, 3);
    let reach = Reach::new(&map, &ROBOT, pose.x_m, pose.y_m).expect("on the map");
    assert!(frontiers(&reach, 0.1).is_empty());
    let mut explorer = Explorer::new(Settings { robot: ROBOT, look_ns: 0, ..Settings::default() });
    explorer.see(&map, pose);
    assert_eq!(explorer.mood(), Mood::Done);
    assert_eq!(explorer.drive(1, pose, 9.0), Velocity::default());
}

#[test]
fn a_map_that_says_nothing_yet_is_waited_for() {
    let map = room(&["??????", "??????", "??#???", "??????"]);
    let mut explorer = Explorer::new(Settings { robot: ROBOT, look_ns: 0, ..Settings::default() });
    explorer.see(&map, at(4, 0));
    assert_eq!(explorer.mood(), Mood::Looks);
    let velocity = explorer.drive(1, at(4, 0), 9.0);
    assert!(velocity.left_rad_s > 0.0 && velocity.forward_m_s == 0.0, "it turns");
}

#[test]
fn nothing_is_reached_through_a_gap_that_is_too_narrow() {
    let map = room(&[
        "###########",
        "#....#....?",
        "#....#....?",
        "#.........?",
        "#....#....?",
        "#....#....?",
        "###########",
    ]);
    let pose = at(2, 3);
    let slim = Robot { radius_m: 0.05, comfort_m: 0.1 };
    let reach = |robot: &Robot| {
        let reach = Reach::new(&map, robot, pose.x_m, pose.y_m).expect("on the map");
        frontiers(&reach, 0.2).len()
    };
    assert_eq!((reach(&slim), reach(&ROBOT)), (1, 0));
}

#[test]
fn a_place_that_is_given_up_is_not_chosen_again() {
    let map = room(OPEN_TO_THE_RIGHT);
    let settings = Settings { robot: ROBOT, look_ns: 0, patience_ns: 10, ..Settings::default() };
    let mut explorer = Explorer::new(settings);
    explorer.see(&map, at(2, 3));
    assert_eq!(explorer.mood(), Mood::Goes);
    // Nothing moves.
    for time_ns in 0..20 {
        let _ = explorer.drive(time_ns, at(2, 3), 9.0);
    }
    explorer.see(&map, at(2, 3));
    assert_eq!(explorer.mood(), Mood::Done, "it stands where it began");
}

#[test]
fn it_stops_before_what_stands_there() {
    let map = room(OPEN_TO_THE_RIGHT);
    let mut explorer = Explorer::new(Settings { robot: ROBOT, look_ns: 0, ..Settings::default() });
    explorer.see(&map, at(2, 3));
    let free = explorer.drive(0, at(2, 3), 9.0);
    assert!(free.forward_m_s > 0.3, "{free:?}");
    assert_eq!(explorer.drive(1, at(2, 3), 0.1), Velocity::default());
    assert!(explorer.drive(2, at(2, 3), 0.1).forward_m_s < 0.0, "back a little");
}

#[test]
fn a_whole_room_is_seen() {
    // What is within 0.8 m of the robot becomes known.
    let truth = room(&[
        "####################",
        "#........#.........#",
        "#........#.........#",
        "#........#.........#",
        "#..................#",
        "#..................#",
        "#..................#",
        "#........#.........#",
        "#........#.........#",
        "####################",
    ]);
    let mut map = Grid::new(truth.info, -1_i8);
    let mut pose = at(4, 4);
    let settings = Settings {
        robot: ROBOT,
        shortest_m: 0.2,
        look_ns: 0,
        tolerance_m: 0.15,
        ..Settings::default()
    };
    let mut explorer = Explorer::new(settings);
    for step in 0..3000_i64 {
        for index in 0..map.cells.len() {
            let (x, y) = truth.info.centre_of(truth.info.cell(index));
            if libm::hypot(x - pose.x_m, y - pose.y_m) < 0.8 {
                map.cells[index] = truth.cells[index];
            }
        }
        if step % 10 == 0 {
            explorer.see(&map, pose);
        }
        let velocity = explorer.drive(step * 50_000_000, pose, 9.0);
        pose.yaw_rad += velocity.left_rad_s * 0.05;
        pose.x_m += velocity.forward_m_s * 0.05 * libm::cos(pose.yaw_rad);
        pose.y_m += velocity.forward_m_s * 0.05 * libm::sin(pose.yaw_rad);
        let (column, row) = truth.info.cell_of(pose.x_m, pose.y_m).expect("inside");
        assert_eq!(*truth.get((column, row)).expect("a cell"), 0, "it drove into a wall");
        if explorer.mood() == Mood::Done {
            let unseen = truth.cells.iter().zip(&map.cells).filter(|(t, m)| **t == 0 && **m != 0);
            assert!(unseen.count() <= 4, "corners only");
            assert!(libm::hypot(pose.x_m - 0.45, pose.y_m - 0.45) < 0.2, "home again");
            return;
        }
    }
    panic!("it never ended: {:?}", explorer.mood());
}

proptest! {
    /// For any map there is no panic, and every path stays on free cells.
    #[test]
    fn ways_stay_on_free_cells(cells in prop::collection::vec(prop::sample::select(vec![-1_i8, 0, 0, 0, 100, 40, -7, 127]), 144), column in 0..12_usize, row in 0..12_usize) {
        let info = GridInfo::new(CELL_M, 12, 12, Pose2::default()).expect("a valid grid");
        let map = Grid::from_cells(info, cells).expect("as many as there are");
        let pose = at(column, row);
        let reach = Reach::new(&map, &Robot { radius_m: 0.1, comfort_m: 0.2 }, pose.x_m, pose.y_m).expect("on the map");
        for found in frontiers(&reach, 0.0) {
            for [x, y] in reach.way(found.cell) {
                let value = *map.at(x, y).expect("on the map");
                prop_assert!((0..=25).contains(&value));
            }
        }
        let mut explorer = Explorer::new(Settings::default());
        explorer.see(&map, pose);
        let velocity = explorer.drive(10_000_000_000, pose, 1.0);
        prop_assert!(velocity.forward_m_s.is_finite() && velocity.left_rad_s.is_finite());
    }

    /// A robot that follows a path from its pose reaches the end.
    #[test]
    fn who_follows_comes_there(yaw in -3.0..3.0_f64, x in -3.0..3.0_f64, y in -3.0..3.0_f64) {
        let most = Velocity { forward_m_s: 0.5, left_rad_s: 1.0 };
        let mut way: Vec<[f64; 2]> = (0..=50).map(|i| [x * f64::from(i) / 50.0, y * f64::from(i) / 50.0]).collect();
        let mut pose = Pose2 { x_m: 0.0, y_m: 0.0, yaw_rad: yaw };
        for _ in 0..1500 {
            let velocity = follow(&mut way, pose, most);
            pose.yaw_rad += velocity.left_rad_s * 0.05;
            pose.x_m += velocity.forward_m_s * 0.05 * libm::cos(pose.yaw_rad);
            pose.y_m += velocity.forward_m_s * 0.05 * libm::sin(pose.yaw_rad);
        }
        prop_assert!(libm::hypot(pose.x_m - x, pose.y_m - y) < 0.15, "{pose:?}");
    }
}
