//! CPU time of a cycle of MPPI on one core, and where it goes.
//!
//! Set-ups: the stock controller of Jazzy (2000 samples, 56 steps) on a local costmap of 3 x 3 m with two
//! obstacles, and the benchmark of Nav2 (`nav2_mppi_controller/benchmark`: 300 samples, 12 steps, 2 iterations,
//! 40 x 40 cells of 0.1 m, an obstacle of 8 x 8 cells at the centre, 50 path points).
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that measures time and prints results"
)]

use std::time::Instant;

use periplus_controllers::mppi::{Mppi, MppiSetup, create};
use periplus_controllers::{ControlInput, Controller, GoalTolerance};
use periplus_costmap::inflation::{CostTable, InflationBuffers, InflationSettings, inflate};
use periplus_costmap::{CellWindow, Costmap, CostmapView, Footprint, InflationLaw, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2};
use periplus_grid::GridInfo;
use periplus_params::Given;

/// Critics of the stock files.
const STOCK_CRITICS: [&str; 8] = [
    "ConstraintCritic",
    "CostCritic",
    "GoalCritic",
    "GoalAngleCritic",
    "PathAlignCritic",
    "PathFollowCritic",
    "PathAngleCritic",
    "PreferForwardCritic",
];

/// Parameters of the stock files that differ from the defaults.
const STOCK: [(&str, &str); 8] = [
    ("batch_size", "2000"),
    ("regenerate_noises", "true"),
    ("CostCritic.near_goal_distance", "1.0"),
    ("PathAlignCritic.cost_weight", "14.0"),
    ("PathAlignCritic.max_path_occupancy_ratio", "0.05"),
    ("PathFollowCritic.offset_from_furthest", "5"),
    ("PathAngleCritic.cost_weight", "2.0"),
    ("PathAngleCritic.max_angle_to_furthest", "1.0"),
];

struct World {
    costmap: Costmap,
    footprint: Footprint,
    is_circular: bool,
    inflation: Option<InflationLaw>,
    pose: Pose2,
    velocity: Twist2,
    plan: Vec<Pose2>,
}

impl World {
    /// A robot of the size of a TurtleBot in a room with two obstacles beside its path.
    fn turtlebot(is_circular: bool) -> Self {
        let info = GridInfo::new(0.05, 60, 60, Pose2::new(-1.5, -1.5, 0.0)).unwrap();
        let mut costmap = Costmap::new(info, 0);
        for cell in 0..6 {
            costmap.set((44, 36 + cell), 254);
            costmap.set((52, 18 + cell), 254);
        }
        let footprint = if is_circular {
            Footprint::circle(0.22)
        } else {
            Footprint::new(vec![[0.2, 0.15], [0.2, -0.15], [-0.2, -0.15], [-0.2, 0.15]])
        };
        let law = InflationLaw { radius_m: 0.7, scaling_per_m: 3.0 };
        let inscribed_m = footprint.inscribed_radius_m;
        let table =
            CostTable::new(0.05, law.radius_m, inscribed_m, law.scaling_per_m, Nav2Release::Main);
        let all = CellWindow::all(&info);
        let how = InflationSettings::default();
        inflate(&mut costmap, &all, &table, how, &mut InflationBuffers::default());
        let point = |i: i32| {
            let x = 0.03 * f64::from(i);
            Pose2::new(x, 0.1 * libm::sin(2.0 * x), 0.2 * libm::cos(2.0 * x))
        };
        Self {
            costmap,
            footprint,
            is_circular,
            inflation: Some(law),
            pose: Pose2::new(0.0, 0.0, 0.1),
            velocity: Twist2::new(0.4, 0.0, 0.1),
            plan: (0..50).map(point).collect(),
        }
    }

    /// The world of Nav2's benchmark.
    fn benchmark() -> Self {
        let info = GridInfo::new(0.1, 40, 40, Pose2::IDENTITY).unwrap();
        let mut costmap = Costmap::new(info, 0);
        for column in 16..24 {
            for row in 16..24 {
                costmap.set((column, row), 250);
            }
        }
        let corner = 0.01;
        let footprint = Footprint::new(vec![
            [corner, corner],
            [-corner, corner],
            [-corner, -corner],
            [corner, -corner],
        ]);
        Self {
            costmap,
            footprint,
            is_circular: false,
            inflation: None,
            pose: Pose2::new(2.0, 2.0, 0.0),
            velocity: Twist2::ZERO,
            plan: (0..50)
                .map(|i| Pose2::new(2.0 + 0.1 * f64::from(i), 2.0 + 0.1 * f64::from(i), 0.0))
                .filter(|pose| pose.x_m < 4.0)
                .collect(),
        }
    }

    fn input(&self, time_ns: i64) -> ControlInput<'_> {
        ControlInput {
            time_ns,
            pose: self.pose,
            velocity: self.velocity,
            costmap: CostmapView {
                costs: &self.costmap,
                footprint: &self.footprint,
                is_circular: self.is_circular,
                tracks_unknown: false,
                inflation: self.inflation,
            },
            plan: &self.plan,
            goal: Pose2::new(6.0, 0.0, 0.0),
            tolerance: GoalTolerance { xy_m: Some(0.25), yaw_rad: Some(0.25) },
            is_position_reached: false,
        }
    }
}

fn controller(release: Nav2Release, params: &[(&str, &str)], critics: &[&str]) -> Mppi {
    let mut named: Vec<(String, String)> = params
        .iter()
        .map(|(name, text)| (format!("FollowPath.{name}"), (*text).to_owned()))
        .collect();
    named.push(("FollowPath.critics".to_owned(), critics.join(" ")));
    let given = named.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let setup = MppiSetup {
        group: "FollowPath",
        release,
        controller_frequency_hz: 20.0,
        seed: 1,
        others: &[],
    };
    let mut diagnostics = Diagnostics::new();
    let controller = create(&setup, given, &mut diagnostics);
    for finding in diagnostics.iter().filter(|it| it.severity.name() == "error") {
        println!("{}", finding.message);
    }
    let mut controller = controller.unwrap();
    // The CPU time is that of one thread.
    controller.set_threads(1);
    controller
}

/// CPU time of this thread \[s\].
fn cpu_s() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-9
}

/// Least mean CPU time of a cycle in several series \[ms\].
fn measure(controller: &mut Mppi, world: &World) -> f64 {
    const SERIES_COUNT: usize = 5;
    let cycles = if controller.config().params().batch_size > 1000 { 100 } else { 1000 };
    let mut least_s = f64::INFINITY;
    for _ in 0..SERIES_COUNT {
        // Each cycle starts alike, so that all series do the same work.
        let begin_s = cpu_s();
        for cycle in 0..cycles {
            let _ = controller.compute_velocity(&world.input(cycle * 50_000_000));
        }
        least_s = least_s.min((cpu_s() - begin_s) / cycles as f64);
    }
    least_s * 1e3
}

fn stock() {
    println!("| stock controller, 2000 x 56 | ms a cycle |");
    println!("|---|---|");
    let circular = World::turtlebot(true);
    let outlined = World::turtlebot(false);
    for (name, release, model, world, footprint) in [
        ("Jazzy, DiffDrive", Nav2Release::Jazzy, "DiffDrive", &circular, "false"),
        ("Jazzy, Omni", Nav2Release::Jazzy, "Omni", &circular, "false"),
        ("Jazzy, Ackermann", Nav2Release::Jazzy, "Ackermann", &circular, "false"),
        ("Jazzy, DiffDrive, footprint", Nav2Release::Jazzy, "DiffDrive", &outlined, "true"),
        ("Main, DiffDrive", Nav2Release::Main, "DiffDrive", &circular, "false"),
        ("Humble, DiffDrive", Nav2Release::Humble, "DiffDrive", &circular, "false"),
    ] {
        let extra = [("motion_model", model), ("CostCritic.consider_footprint", footprint)];
        let mut controller = controller(release, &[&STOCK[..], &extra].concat(), &STOCK_CRITICS);
        println!("| {name} | {:.3} |", measure(&mut controller, world));
    }
    let kept = [&STOCK[..], &[("regenerate_noises", "false")]].concat();
    let mut same_noise = controller(Nav2Release::Jazzy, &kept, &STOCK_CRITICS);
    println!(
        "| Jazzy, DiffDrive, regenerate_noises false | {:.3} |",
        measure(&mut same_noise, &circular)
    );
}

fn stages() {
    println!("\n| stage of the stock controller (Jazzy, DiffDrive) | ms |");
    println!("|---|---|");
    let world = World::turtlebot(true);
    let release = Nav2Release::Jazzy;
    let all = measure(&mut controller(release, &STOCK, &STOCK_CRITICS), &world);
    let bare = measure(&mut controller(release, &STOCK, &[]), &world);
    let kept = [&STOCK[..], &[("regenerate_noises", "false")]].concat();
    let without_noise = measure(&mut controller(release, &kept, &[]), &world);
    println!("| noise | {:.3} |", bare - without_noise);
    println!("| rollout, update, filter | {without_noise:.3} |");
    // Each critic alone: with others the samples would differ. Critics of the path each find its furthest point.
    for name in STOCK_CRITICS {
        let alone = measure(&mut controller(release, &STOCK, &[name]), &world);
        println!("| {name} | {:.3} |", alone - bare);
    }
    println!("| all | {all:.3} |");
}

/// Prints the time on the clock of a cycle by the number of threads: the tenth percentile, since other programs
/// disturb it.
fn threads() {
    const CYCLES: i64 = 400;
    println!("\n| threads, stock controller (Jazzy, DiffDrive) | ms a cycle on the clock |");
    println!("|---|---|");
    let world = World::turtlebot(true);
    for threads in [1, 2] {
        let mut controller = controller(Nav2Release::Jazzy, &STOCK, &STOCK_CRITICS);
        controller.set_threads(threads);
        let mut times_s: Vec<f64> = (0..CYCLES)
            .map(|cycle| {
                let begin = Instant::now();
                let _ = controller.compute_velocity(&world.input(cycle * 50_000_000));
                begin.elapsed().as_secs_f64()
            })
            .collect();
        times_s.sort_by(f64::total_cmp);
        println!("| {threads} | {:.3} |", times_s[times_s.len() / 10] * 1e3);
    }
}

fn benchmark() {
    println!("\n| Nav2's benchmark, 300 x 12 x 2 | ms a cycle |");
    println!("|---|---|");
    let world = World::benchmark();
    let size = [
        ("batch_size", "300"),
        ("time_steps", "12"),
        ("iteration_count", "2"),
        ("CostCritic.consider_footprint", "true"),
        ("ObstaclesCritic.consider_footprint", "true"),
    ];
    let common = ["GoalCritic", "GoalAngleCritic", "ObstaclesCritic"];
    let driving =
        [&common[..], &["PathAngleCritic", "PathFollowCritic", "PreferForwardCritic"]].concat();
    let omni =
        [&common[..], &["TwirlingCritic", "PathFollowCritic", "PreferForwardCritic"]].concat();
    for (model, critics) in [("DiffDrive", &driving), ("Omni", &omni), ("Ackermann", &driving)] {
        let params = [&size[..], &[("motion_model", model)]].concat();
        let mut controller = controller(Nav2Release::Main, &params, critics);
        println!("| {model} | {:.3} |", measure(&mut controller, &world));
    }
    let params = [&size[..], &[("motion_model", "Ackermann")]].concat();
    for critic in STOCK_CRITICS.into_iter().chain(["ObstaclesCritic", "TwirlingCritic"]) {
        let mut controller = controller(Nav2Release::Main, &params, &[critic]);
        println!("| Ackermann, {critic} | {:.3} |", measure(&mut controller, &world));
    }
}

fn main() {
    // With the argument `profile` only the stock controller runs, for a profiler.
    if std::env::args().nth(1).as_deref() == Some("profile") {
        let mut controller = controller(Nav2Release::Jazzy, &STOCK, &STOCK_CRITICS);
        let ms = measure(&mut controller, &World::turtlebot(true));
        return println!("{ms:.3} ms");
    }
    stock();
    stages();
    threads();
    benchmark();
}
