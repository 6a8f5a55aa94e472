//! Planning times on maps of Nav2's planner benchmark, inflated by the costmap crate. On Linux the times are
//! those of the processor, so that other programs hardly disturb them.
//!
//! `cargo run --release -p periplus-planners --example bench_planners [-- FOLDER [REPETITIONS [PLANNER]]]`

#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    reason = "a program that reads maps and measures times"
)]

use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use periplus_costmap::inflation::{CostTable, InflationBuffers, InflationSettings, inflate};
use periplus_costmap::{CellWindow, Costmap, CostmapView, Footprint, InflationLaw, Nav2Release};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_params::{ParamValue, ParamValues};
use periplus_planners::{PlanRequest, PlannedPath, Planner, PlannerKind};

/// Radius of the robot, and the inflation around obstacles.
const ROBOT_RADIUS_M: f64 = 0.22;
const INFLATION: InflationLaw = InflationLaw { radius_m: 0.55, scaling_per_m: 3.0 };
const RESOLUTION_M: f64 = 0.05;

/// Map with a start and a goal.
struct Task {
    map: &'static str,
    /// True if bright pixels are obstacles.
    is_negated: bool,
    start: Pose2,
    goal: Pose2,
}

const TASKS: [Task; 5] = [
    task("100by100_10", true, [12.0, 50.0], [87.0, 52.0]),
    task("100by100_15", true, [12.0, 50.0], [87.0, 52.0]),
    task("100by100_20", true, [12.0, 50.0], [87.0, 52.0]),
    task("depot", false, [4.0, 4.0], [26.0, 12.0]),
    task("warehouse", false, [4.0, 5.0], [16.0, 40.0]),
];

const fn task(map: &'static str, is_negated: bool, start: [f64; 2], goal: [f64; 2]) -> Task {
    let start = Pose2::new(start[0], start[1], 0.0);
    Task { map, is_negated, start, goal: Pose2::new(goal[0], goal[1], 0.0) }
}

/// Reads a grey image (PGM, also with gzip) as a costmap of lethal, free and unknown cells.
fn read_map(folder: &Path, task: &Task) -> Result<Costmap, Box<dyn Error>> {
    let plain = folder.join(format!("{}.pgm", task.map));
    let bytes = if plain.exists() {
        std::fs::read(plain)?
    } else {
        let packed = folder.join(format!("{}.pgm.gz", task.map));
        Command::new("gzip").arg("-dc").arg(packed).output()?.stdout
    };
    let mut numbers = Vec::new();
    let mut at = 0;
    while numbers.len() < 4 {
        let end = bytes[at..].iter().position(u8::is_ascii_whitespace).ok_or("no header")?;
        let word = std::str::from_utf8(&bytes[at..at + end])?;
        at += end + 1;
        if word.starts_with('#') {
            at += bytes[at..].iter().position(|byte| *byte == b'\n').ok_or("no line")? + 1;
        } else if !word.is_empty() {
            numbers.push(word.trim_start_matches('P').parse::<usize>()?);
        }
    }
    let (width, height) = (numbers[1], numbers[2]);
    let info = GridInfo::new(RESOLUTION_M, width, height, Pose2::IDENTITY)?;
    let mut map = Costmap::new(info, 0);
    let pixels = bytes.get(at..at + width * height).ok_or("too few pixels")?;
    for (row, line) in pixels.chunks(width).rev().enumerate() {
        for (column, pixel) in line.iter().enumerate() {
            let brightness = f64::from(*pixel) / 255.0;
            let occupancy = if task.is_negated { brightness } else { 1.0 - brightness };
            let cost = match occupancy {
                at if at > 0.65 => 254,
                at if at < 0.196 => 0,
                _ => 255,
            };
            map.set((column, row), cost);
        }
    }
    Ok(map)
}

fn inflated(mut map: Costmap) -> Costmap {
    let table = CostTable::new(
        RESOLUTION_M,
        INFLATION.radius_m,
        ROBOT_RADIUS_M,
        INFLATION.scaling_per_m,
        Nav2Release::Main,
    );
    let all = CellWindow::all(map.info());
    inflate(&mut map, &all, &table, InflationSettings::default(), &mut InflationBuffers::default());
    map
}

/// Centre of the free cell nearest to a point.
fn nearest_free(map: &Costmap, near: Pose2) -> Pose2 {
    let info = map.info();
    let free = (0..info.len()).filter(|index| map.costs()[*index] < 100);
    let centres = free.map(|index| info.centre_of(info.cell(index)));
    let distance = |(x, y): (f64, f64)| (x - near.x_m).powi(2) + (y - near.y_m).powi(2);
    let nearest = centres.min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    nearest.map_or(near, |(x_m, y_m)| Pose2 { x_m, y_m, ..near })
}

/// Time that this thread has run \[ms\], or the time of the clock where the system has no such counter.
fn processor_ms(clock: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let ran_ns = text.split(' ').next().and_then(|word| word.parse::<f64>().ok());
    ran_ns.map_or_else(|| clock.elapsed().as_secs_f64() * 1e3, |ran_ns| ran_ns / 1e6)
}

/// Plans several times; returns the mean time and that of the first plan \[ms\].
fn measure(
    planner: &mut dyn Planner,
    map: &Costmap,
    [start, goal]: [Pose2; 2],
    repetitions: usize,
) -> (f64, f64, Result<PlannedPath, String>) {
    let footprint = Footprint::circle(ROBOT_RADIUS_M);
    let costmap = CostmapView {
        costs: map,
        footprint: &footprint,
        is_circular: true,
        tracks_unknown: true,
        inflation: Some(INFLATION),
    };
    let clock = Instant::now();
    let mut last = Err("not planned".to_owned());
    let mut marks_ms = vec![processor_ms(clock)];
    for repetition in 0..=repetitions {
        let (is_cancelled, is_out_of_time) = (&mut || false, &mut || false);
        let request = PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time };
        last = planner.plan(request).map_err(|error| error.to_string());
        // The system counts in steps of some milliseconds, so that only sums are exact.
        if repetition == 0 || repetition == repetitions {
            marks_ms.push(processor_ms(clock));
        }
    }
    let mean_ms = (marks_ms[2] - marks_ms[1]) / repetitions.max(1) as f64;
    (mean_ms, marks_ms[1] - marks_ms[0], last)
}

fn row(map: &str, name: &str, result: &(f64, f64, Result<PlannedPath, String>)) {
    let (mean_ms, first_ms, plan) = result;
    match plan {
        Ok(plan) => println!(
            "{map:<14} {name:<22} {mean_ms:>9.2} {first_ms:>9.2} {:>8.2} {:>9}",
            plan.length_m(),
            plan.expansion_count
        ),
        Err(error) => println!("{map:<14} {name:<22} {mean_ms:>9.2} {first_ms:>9.2}  {error}"),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../../shared/nav/maps");
    let folder = arguments.next().unwrap_or_else(|| default.to_owned());
    let repetitions = arguments.next().map_or(Ok(20), |word| word.parse())?;
    let only = arguments.next();
    println!("map            planner                 mean [ms] first [ms] path [m]  expanded");
    for task in &TASKS {
        let map = match read_map(Path::new(&folder), task) {
            Ok(map) => inflated(map),
            Err(error) => {
                println!("SKIPPED: {} in {folder}: {error}", task.map);
                continue;
            }
        };
        let ends = [nearest_free(&map, task.start), nearest_free(&map, task.goal)];
        for (name, class, settings) in PLANNERS {
            if only.as_ref().is_some_and(|only| only != name) {
                continue;
            }
            let kind = PlannerKind::of_class(class)?;
            let values = ParamValues::defaults(kind.table());
            let mut planner = kind.build(values, Nav2Release::Main);
            for (parameter, value) in settings {
                planner.set_parameter(parameter, &value.value())?;
            }
            row(task.map, name, &measure(planner.as_mut(), &map, ends, repetitions));
        }
    }
    let info = GridInfo::new(RESOLUTION_M, 4000, 4000, Pose2::IDENTITY)?;
    let open = Costmap::new(info, 0);
    let ends = [Pose2::new(20.0, 20.0, 0.0), Pose2::new(180.0, 180.0, 0.0)];
    let kind = PlannerKind::NavFn;
    let mut planner = kind.build(ParamValues::defaults(kind.table()), Nav2Release::Main);
    row("open 4000x4000", "NavFn", &measure(planner.as_mut(), &open, ends, repetitions));
    Ok(())
}

/// Value of a parameter in the table below.
#[derive(Clone, Copy)]
enum Setting {
    Flag(bool),
    Text(&'static str),
}

impl Setting {
    fn value(self) -> ParamValue {
        match self {
            Self::Flag(flag) => ParamValue::Bool(flag),
            Self::Text(text) => ParamValue::Text(text.to_owned()),
        }
    }
}

/// Name, class, and parameters that differ from the defaults.
type Row = (&'static str, &'static str, &'static [(&'static str, Setting)]);

const PLANNERS: [Row; 7] = [
    ("NavFn", "nav2_navfn_planner::NavfnPlanner", &[]),
    ("NavFn A*", "nav2_navfn_planner::NavfnPlanner", &[("use_astar", Setting::Flag(true))]),
    ("Theta*", "nav2_theta_star_planner::ThetaStarPlanner", &[]),
    ("Smac 2D", "nav2_smac_planner::SmacPlanner2D", &[]),
    ("Hybrid-A* Dubin", "nav2_smac_planner::SmacPlannerHybrid", &[]),
    (
        "Hybrid-A* Reeds-Shepp",
        "nav2_smac_planner::SmacPlannerHybrid",
        &[("motion_model_for_search", Setting::Text("REEDS_SHEPP"))],
    ),
    ("State Lattice", "nav2_smac_planner::SmacPlannerLattice", &[]),
];
