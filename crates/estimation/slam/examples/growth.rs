//! Growth of CPU time and memory with path length: `growth [--km 10] [--lifelong] [--slices 2] [--finish]`.
//! A robot drives up and down the aisles of a warehouse of 56 m by 44 m and sees every area repeatedly.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that measures time and prints results"
)]

#[path = "../tests/worlds/mod.rs"]
mod worlds;

use std::fs;

use periplus_geometry::Pose2;
use periplus_slam::{Settings, Slam};
use worlds::{Moment, ROBOT, Robot, World};

const ROWS: usize = 10;
const LONG_M: f64 = 48.0;
const SCANNER: Robot =
    Robot { beams: 360, field_rad: 359.0 / 180.0 * std::f64::consts::PI, ..ROBOT };

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |name: &str, default: f64| {
        let at = arguments.iter().position(|it| it == name);
        at.and_then(|at| arguments.get(at + 1)?.parse().ok()).unwrap_or(default)
    };
    let has = |name: &str| arguments.iter().any(|it| it == name);
    let way_m = 1000.0 * number("--km", 10.0);
    let slices = number("--slices", 2.0) as usize;
    let world = World::warehouse(ROWS, LONG_M, 1);
    let corners = World::rounds(ROWS, LONG_M, way_m, 1);
    let mut slam = Slam::new(Settings {
        slices_per_scan: 0,
        is_lifelong: has("--lifelong"),
        ..Settings::default()
    });
    println!(
        "{:>6} {:>7} {:>7} | {:>7} {:>7} {:>7} {:>7} | {:>8} {:>8} | {:>7} {:>7} {:>6}",
        "way km",
        "scans",
        "kept",
        "ms",
        "p99",
        "worst",
        "slice",
        "map MB",
        "most MB",
        "rms m",
        "max m",
        "loops"
    );
    let mut spent: Vec<u64> = Vec::new();
    let mut longest_slice = 0;
    let mut truth: Vec<[f32; 2]> = Vec::new();
    let mut before: Option<Pose2> = None;
    let (mut gone_m, mut told_m) = (0.0, 500.0);
    let mut step = |moment: Moment| {
        let begin = cpu_ns();
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
        for _ in 0..slices {
            let slice = cpu_ns();
            slam.work_slices(1);
            longest_slice = longest_slice.max(cpu_ns() - slice);
        }
        spent.push(cpu_ns() - begin);
        truth.push([moment.truth.x_m as f32, moment.truth.y_m as f32]);
        let last = before.replace(moment.truth).unwrap_or(moment.truth);
        gone_m += libm::hypot(moment.truth.x_m - last.x_m, moment.truth.y_m - last.y_m);
        if gone_m >= told_m {
            told_m *= 2.0;
            tell(&slam, gone_m, &mut spent, &mut longest_slice, &truth);
        }
    };
    world.follow(&corners, 0.25, &SCANNER, 1, &mut step);
    tell(&slam, gone_m, &mut spent, &mut longest_slice, &truth);
    if has("--finish") {
        let begin = cpu_ns();
        slam.finish();
        println!("the last refinement: {:.1} s", (cpu_ns() - begin) as f64 * 1e-9);
        tell(&slam, gone_m, &mut vec![0], &mut 0, &truth);
    }
}

fn tell(slam: &Slam, way_m: f64, spent: &mut Vec<u64>, slice: &mut u64, truth: &[[f32; 2]]) {
    spent.sort_unstable();
    let ms = |ns: u64| ns as f64 * 1e-6;
    let mean = ms(spent.iter().sum::<u64>()) / spent.len() as f64;
    let (rms_m, most_m) = error(slam, truth);
    println!(
        "{:>6.2} {:>7} {:>7} | {:>7.2} {:>7.2} {:>7.1} {:>7.1} | {:>8.1} {:>8.1} | {:>7.3} {:>7.3} {:>6}",
        1e-3 * way_m,
        truth.len(),
        slam.poses().len(),
        mean,
        ms(spent[spent.len() * 99 / 100]),
        ms(spent[spent.len() - 1]),
        ms(*slice),
        slam.size() as f64 * 1e-6,
        memory_mb(),
        rms_m,
        most_m,
        slam.closures().iter().filter(|it| it.is_accepted).count()
    );
    spent.clear();
    *slice = 0;
}

/// Root mean square and largest position error relative to the first pose, of the scans whose poses are
/// kept.
fn error(slam: &Slam, truth: &[[f32; 2]]) -> (f64, f64) {
    let (mut squares, mut most, mut count) = (0.0, 0.0_f64, 0);
    for (time_ns, pose) in slam.trajectory() {
        // A scan every half second.
        let [x, y] = truth[(time_ns / 500_000_000) as usize];
        let off = libm::hypot(pose.x_m - f64::from(x), pose.y_m - f64::from(y));
        squares += off * off;
        most = most.max(off);
        count += 1;
    }
    ((squares / f64::from(count.max(1))).sqrt(), most)
}

/// Nanoseconds of this thread on a CPU.
fn cpu_ns() -> u64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|it| it.parse().ok()).unwrap_or(0)
}

/// The most memory that the whole program has had \[MB\].
fn memory_mb() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) * 1.024e-3
}
