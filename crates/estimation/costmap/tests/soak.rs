//! One hour among moving obstacles.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test states its preconditions")]

use periplus_costmap::{CostmapConfig, LayeredCostmap, NoTransforms, Projector, ScanGeometry};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose, Pose2};
use periplus_params::Given;

const SECONDS: i64 = 3600;
const BEAMS: usize = 180;

/// A post that moves on a circle.
#[derive(Clone, Copy)]
struct Post {
    x_m: f64,
    y_m: f64,
    radius_m: f64,
}

/// Half the length of the room \[m\].
const WALL_M: f64 = 4.0;

/// Returns the length of a ray from a position in the room \[m\].
fn range(x_m: f64, y_m: f64, angle_rad: f64, posts: &[Post]) -> f32 {
    let (dy, dx) = libm::sincos(angle_rad);
    let to_wall = |at: f64, along: f64| {
        if along > 0.0 { (WALL_M - at) / along } else { (-WALL_M - at) / along }
    };
    let mut nearest = f64::INFINITY;
    for (at, along) in [(x_m, dx), (y_m, dy)] {
        if along.abs() > 1e-9 {
            nearest = nearest.min(to_wall(at, along));
        }
    }
    for post in posts {
        let (px, py) = (post.x_m - x_m, post.y_m - y_m);
        let along = px * dx + py * dy;
        let aside_squared = px * px + py * py - along * along;
        let half_squared = post.radius_m * post.radius_m - aside_squared;
        if half_squared > 0.0 && along - half_squared.sqrt() > 0.0 {
            nearest = nearest.min(along - half_squared.sqrt());
        }
    }
    nearest as f32
}

fn posts(second: i64) -> Vec<Post> {
    let at = |speed: f64, distance_m: f64, radius_m: f64| {
        let (sine, cosine) = libm::sincos(second as f64 * speed);
        Post { x_m: distance_m * cosine, y_m: distance_m * sine, radius_m }
    };
    vec![at(0.11, 2.5, 0.2), at(-0.07, 3.0, 0.3), at(0.023, 1.8, 0.1)]
}

fn costmap(layer: &'static str) -> LayeredCostmap {
    let given = [
        ("global_frame", "odom"),
        ("rolling_window", "true"),
        ("width", "5"),
        ("height", "5"),
        ("resolution", "0.1"),
        ("plugins", "seen inflation_layer"),
        ("seen.plugin", layer),
        ("seen.observation_sources", "scan"),
        ("seen.scan.max_obstacle_height", "2.0"),
        ("seen.scan.clearing", "true"),
        ("seen.scan.raytrace_max_range", "10.0"),
        ("seen.scan.obstacle_max_range", "9.0"),
        ("inflation_layer.plugin", "nav2_costmap_2d::InflationLayer"),
    ];
    let given = given.map(|(name, text)| Given::new(name, text));
    let mut diagnostics = Diagnostics::new();
    let config = CostmapConfig::read(given, None, &mut diagnostics);
    assert!(diagnostics.is_empty());
    config.build()
}

/// Inserts one scan and returns the pose of the robot.
fn look(
    costmap: &mut LayeredCostmap,
    projector: &mut Projector,
    second: i64,
    posts: &[Post],
) -> Pose2 {
    let now_ns = second * 1_000_000_000;
    let (sine, cosine) = libm::sincos(second as f64 * 0.05);
    let robot = Pose2::new(0.8 * cosine, 0.8 * sine, second as f64 * 0.013);
    let step_rad = 2.0 * std::f64::consts::PI / BEAMS as f64;
    let ranges: Vec<f32> = (0..BEAMS)
        .map(|beam| range(robot.x_m, robot.y_m, robot.yaw_rad + beam as f64 * step_rad, posts))
        .collect();
    let beams = ScanGeometry {
        angle_min_rad: 0.0,
        angle_increment_rad: step_rad as f32,
        range_min_m: 0.05,
        range_max_m: 30.0,
    };
    let sensor = Pose::from(robot) * Pose::from_xyz(0.0, 0.0, 0.3);
    if let Some(source) = costmap.source_mut("seen", "scan") {
        let points = projector.points(beams, &ranges, false);
        source.insert(now_ns, now_ns, sensor, sensor.translation, points);
    }
    costmap.update(now_ns, robot, &NoTransforms);
    robot
}

/// Returns the distance of the nearest surface from a position \[m\].
fn to_surface(x_m: f64, y_m: f64, posts: &[Post]) -> f64 {
    let to_wall = (WALL_M - x_m.abs()).min(WALL_M - y_m.abs()).abs();
    let to_post = posts
        .iter()
        .map(|post| (libm::hypot(x_m - post.x_m, y_m - post.y_m) - post.radius_m).abs());
    to_post.fold(to_wall, f64::min)
}

/// Distance beyond which nothing is marked: more than the diagonal of a cell \[m\].
const SLACK_M: f64 = 0.25;

/// Returns the reports of marked cells without an obstacle nearby. Each mark must have a reading,
/// and an obstacle at the time of that reading.
fn stuck(costmap: &LayeredCostmap, posts_now: &[Post]) -> Vec<String> {
    let info = *costmap.costmap().info();
    let mut stuck = Vec::new();
    for index in (0..info.len()).filter(|index| costmap.costmap().costs()[*index] == 254) {
        let cell = info.cell(index);
        let (x_m, y_m) = info.centre_of(cell);
        let report = costmap.inspect(cell).unwrap();
        let cause = report.layers[0].explanation.cause.as_ref();
        let cause = cause.filter(|cause| cause.is_mark).unwrap_or_else(|| panic!("{report}"));
        let then = posts(cause.time_ns / 1_000_000_000);
        assert!(to_surface(x_m, y_m, &then) < SLACK_M, "nothing was there:\n{report}");
        if to_surface(x_m, y_m, posts_now) > SLACK_M {
            stuck.push(report.to_string());
        }
    }
    stuck
}

fn check(layer: &'static str) {
    let mut costmap = costmap(layer);
    let mut projector = Projector::default();
    let mut behind = 0;
    for second in 0..SECONDS {
        let posts = posts(second);
        look(&mut costmap, &mut projector, second, &posts);
        // A mark behind a post stays until a ray reaches it.
        behind += stuck(&costmap, &posts).len();
    }
    assert!(behind > 0, "a test without such marks proves nothing");
    // The posts are gone, and the robot drives one round.
    for second in SECONDS..SECONDS + 130 {
        look(&mut costmap, &mut projector, second, &[]);
    }
    let stuck = stuck(&costmap, &[]);
    assert!(stuck.is_empty(), "{} cells, such as\n{}", stuck.len(), stuck[0]);
    assert!(costmap.diagnostics().is_empty());
}

#[test]
fn no_cell_stays_marked_in_an_obstacle_layer() {
    check("nav2_costmap_2d::ObstacleLayer");
}

#[test]
fn no_cell_stays_marked_in_a_voxel_layer() {
    check("nav2_costmap_2d::VoxelLayer");
}
