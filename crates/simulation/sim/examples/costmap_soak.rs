//! An hour of simulated time among moving obstacles, with the costmaps of the tutorial's robot:
//! memory after ten and after sixty minutes, and whether every mark can be explained.
//! `costmap_soak [MINUTES]`.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a small program for people")]
#![allow(clippy::disallowed_methods, reason = "it reads a file and its own memory")]

#[path = "../tests/costmaps/tutorial.rs"]
mod tutorial;

use periplus_costmap::cost::LETHAL;
use periplus_geometry::Pose;
use periplus_graph::{LifecycleNode, Qos};
use periplus_msgs::geometry_msgs::{Twist, Vector3};
use periplus_nav_nodes::costmap_2d::CostmapNode;
use periplus_sim::PhysicsMode;

use tutorial::Run;

/// Period at which the obstacles are moved \[ms\].
const STEP_MS: i64 = 100;

/// Half a side of the cube \[m\].
const CUBE_M: f64 = 0.5;

/// Radius of the sphere where the lidar cuts it \[m\].
const SPHERE_M: f64 = 0.44;

/// Maximum distance from a mark to the surface that made it: a cell's diagonal, the noise of the lidar,
/// and the motion during a step \[m\].
const SLACK_M: f64 = 0.15;

/// More memory than this between the tenth and the last minute is a leak \[MB\].
const MOST_MB: f64 = 1.0;

/// Returns the positions of the cube and the sphere at a time, in the plane \[m\].
fn places(time_ns: i64) -> [(f64, f64); 2] {
    let time_s = time_ns as f64 / 1e9;
    let on_circle = |radius_m: f64, speed: f64| {
        let (sine, cosine) = libm::sincos(time_s * speed);
        (radius_m * cosine, radius_m * sine)
    };
    [on_circle(2.0, 0.11), on_circle(1.8, -0.07)]
}

/// Returns the distance of a point from the obstacles at a time \[m\].
fn to_surface(x_m: f64, y_m: f64, time_ns: i64) -> f64 {
    let [cube, sphere] = places(time_ns);
    let [dx, dy] = [x_m - cube.0, y_m - cube.1].map(f64::abs);
    let outside = libm::hypot((dx - CUBE_M).max(0.0), (dy - CUBE_M).max(0.0));
    let to_cube = if outside > 0.0 { outside } else { CUBE_M - dx.max(dy) };
    let to_sphere = (libm::hypot(x_m - sphere.0, y_m - sphere.1) - SPHERE_M).abs();
    to_cube.min(to_sphere)
}

/// Marks of a costmap, by the result of its inspector.
#[derive(Default)]
struct Marks {
    /// All of them.
    all: usize,
    /// Past positions of an obstacle that have not been observed since.
    of_the_past: usize,
    /// Without a reading, or with one that cannot have been.
    unexplained: usize,
}

fn marks(node: &LifecycleNode<CostmapNode>, now_ns: i64) -> Marks {
    let mut marks = Marks::default();
    let lethal = node.with(|node| {
        let costmap = node.costmap()?;
        let info = *costmap.costmap().info();
        let costs = costmap.costmap().costs().iter().enumerate();
        let lethal = costs.filter(|(_, cost)| **cost == LETHAL);
        Some(lethal.map(|(index, _)| info.centre_of(info.cell(index))).collect::<Vec<_>>())
    });
    for (x_m, y_m) in lethal.unwrap() {
        marks.all += 1;
        let report = node.with(|node| node.inspect(x_m, y_m)).unwrap();
        let cause = report.layers.iter().find_map(|layer| layer.explanation.cause.as_ref());
        match cause.filter(|cause| cause.is_mark) {
            Some(cause) if to_surface(x_m, y_m, cause.time_ns) < SLACK_M => {
                marks.of_the_past += usize::from(to_surface(x_m, y_m, now_ns) > SLACK_M);
            }
            _ => {
                marks.unexplained += 1;
                println!("{report}");
            }
        }
    }
    marks
}

/// Resident memory of this process \[MB\], if the system reports it.
fn memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1e3
}

/// One step among the moving obstacles; the robot drives a circle of 0.3 m.
fn step(run: &mut Run, are_things_there: bool) {
    if are_things_there {
        let [cube, sphere] = places(run.simulation.time_ns());
        for (name, (x_m, y_m)) in [("cube", cube), ("sphere", sphere)] {
            assert!(run.simulation.set_pose(name, Pose::from_xyz(x_m, y_m, 0.5)));
        }
    }
    run.go_on(STEP_MS);
}

fn main() {
    let minutes = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(60);
    let mut run = Run::new(PhysicsMode::Kinematic);
    run.let_infinite_ranges_clear();
    let wheels = run.user.publisher::<Twist>("/cmd_vel", Qos::reliable(1)).unwrap();
    let forward = Vector3 { x: 0.06, ..Vector3::default() };
    let turning = Vector3 { z: 0.2, ..Vector3::default() };
    println!("minute  memory [MB]  marks: local, global  of the past  unexplained");
    let mut early_mb = f64::NAN;
    let mut unexplained = 0;
    for second in 0..60 * minutes {
        wheels.publish(Twist { linear: forward.clone(), angular: turning.clone() });
        (0..1000 / STEP_MS).for_each(|_| step(&mut run, true));
        let now_ns = run.simulation.time_ns();
        let [local, global] = run.costmaps.each_ref().map(|node| marks(node, now_ns));
        unexplained += local.unexplained + global.unexplained;
        if second % 300 == 299 {
            println!(
                "{:6}  {:11.2}  {:12}, {:6}  {:11}  {:11}",
                second / 60 + 1,
                memory_mb(),
                local.all,
                global.all,
                local.of_the_past + global.of_the_past,
                unexplained,
            );
        }
        if second + 1 == 600 {
            early_mb = memory_mb();
        }
    }
    let late_mb = memory_mb();
    for name in ["cube", "sphere"] {
        assert!(run.simulation.delete(name));
    }
    (0..60_000 / STEP_MS).for_each(|_| step(&mut run, false));
    let now_ns = run.simulation.time_ns();
    let left = run.costmaps.each_ref().map(|node| marks(node, now_ns).all);
    println!("marks a minute after everything has gone: {} and {}", left[0], left[1]);
    println!("memory from minute 10 to {minutes}: {:+.2} MB", late_mb - early_mb);
    let has_leaked = late_mb - early_mb > MOST_MB;
    std::process::exit(i32::from(has_leaked || unexplained > 0 || left != [0, 0]));
}
