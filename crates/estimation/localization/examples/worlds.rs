//! Localization in worlds with known truth: tracking, global localization, kidnapping. `worlds
//! [tracking|starts|kidnapped|large] [NAME=VALUE ...]`, with names of parameters.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that measures time and prints results"
)]

#[path = "worlds/mod.rs"]
#[allow(dead_code, reason = "each tool uses its part")]
mod worlds;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::Stream;
use periplus_localization::{Amcl, LocalizationState, Settings};
use periplus_params::Given;
use worlds::{Wanderer, World, cpu_s, initial_pose_at, off};

/// Maximum error of a right pose \[m\], \[rad\].
const MAX_RIGHT_ERROR_M: f64 = 0.5;
const MAX_RIGHT_ERROR_RAD: f64 = 0.26;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut given = Vec::new();
    let mut only = None;
    let (mut seeds, mut starts) = (10, 100);
    for word in &words {
        match word.split_once('=') {
            Some(("seeds", count)) => seeds = count.parse().unwrap(),
            Some(("starts", count)) => starts = count.parse().unwrap(),
            Some((name, value)) => given.push(Given::new(name, value)),
            None => only = Some(word.as_str()),
        }
    }
    let mut diagnostics = Diagnostics::new();
    let (_, settings) = Settings::read(given, &mut diagnostics);
    diagnostics.iter().for_each(|it| println!("{}", it.message));
    let wants = |name: &str| only.is_none_or(|only| only == name);
    if wants("tracking") {
        tracking(&settings, seeds);
    }
    if wants("starts") {
        carried("starts anywhere", &World::all(), &settings, starts, false);
    }
    if wants("kidnapped") {
        carried("kidnapped", &World::all(), &settings, starts, true);
    }
    if wants("large") {
        carried(
            "starts anywhere, large",
            &[World::block_of_offices()],
            &settings,
            starts.min(20),
            false,
        );
    }
}

/// Drives of 60 m with a known initial pose: the error at every scan.
fn tracking(settings: &Settings, seeds: u64) {
    println!(
        "\n| tracking, {seeds} seeds | scans | RMS m | worst m | RMS degrees | worst degrees | not tracking % | CPU ms a scan |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for world in World::all() {
        let map = world.map();
        let (mut squares, mut worst, mut turns, mut worst_turn) = (0.0, 0.0_f64, 0.0, 0.0_f64);
        let (mut scans, mut unsure, mut spent_s) = (0, 0, 0.0);
        for seed in 0..seeds {
            let mut stream = Stream::keyed(seed, "tracking", 0);
            let mut amcl = Amcl::new(Settings { seed, ..settings.clone() });
            amcl.set_map("map", &map).unwrap();
            let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
            amcl.set_pose(&initial_pose_at(robot.truth)).unwrap();
            for step in 0..600 {
                robot.step(&world, &mut stream);
                let scan = world.scan(robot.truth, &mut stream);
                let begin = cpu_s();
                amcl.update(robot.odom_from_base, &scan).unwrap();
                spent_s += cpu_s() - begin;
                if step < 20 {
                    continue;
                }
                let found = amcl.map_from_odom().unwrap() * robot.odom_from_base;
                let (metres, radians) = off(robot.truth, found);
                squares += metres * metres;
                turns += radians * radians;
                worst = worst.max(metres);
                worst_turn = worst_turn.max(radians);
                scans += 1;
                unsure += usize::from(amcl.status().state != LocalizationState::Tracking);
            }
        }
        let count = f64::from(scans);
        println!(
            "| {} | {scans} | {:.4} | {:.3} | {:.3} | {:.2} | {:.2} | {:.2} |",
            world.name,
            (squares / count).sqrt(),
            worst,
            (turns / count).sqrt().to_degrees(),
            worst_turn.to_degrees(),
            100.0 * unsure as f64 / count,
            1e3 * spent_s / (600.0 * seeds as f64),
        );
    }
}

/// Drives of 5 m from an unknown pose.
fn carried(what: &str, worlds: &[World], settings: &Settings, starts: u64, is_kidnapped: bool) {
    println!(
        "\n| {what}, {starts} each | right % | wrong and sure % | not sure % | wrong scans while sure % | m to right | worst | CPU s to right | worst |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let is_verbose = std::env::var("VERBOSE").is_ok();
    for world in worlds {
        let map = world.map();
        let (mut right, mut wrong, mut unsure) = (0, 0, 0);
        let (mut sure_scans, mut wrong_scans) = (0, 0);
        let (mut ways, mut costs) = (Vec::new(), Vec::new());
        for seed in 0..starts {
            let mut stream = Stream::keyed(seed, "starts", 0);
            let mut amcl = Amcl::new(Settings { seed, ..settings.clone() });
            amcl.set_map("map", &map).unwrap();
            let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
            if is_kidnapped {
                amcl.set_pose(&initial_pose_at(robot.truth)).unwrap();
                for _ in 0..30 {
                    robot.step(world, &mut stream);
                    let scan = world.scan(robot.truth, &mut stream);
                    amcl.update(robot.odom_from_base, &scan).unwrap();
                }
                robot.truth = world.random_pose(&map, &mut stream);
            }
            let (mut way_m, mut spent_s) = (0.0, 0.0);
            let mut first = None;
            let (mut is_right, mut is_sure) = (false, false);
            // Rotation in place adds no distance, so the number of scans is limited, too.
            for _ in 0..300 {
                if way_m >= 5.0 {
                    break;
                }
                let before = robot.truth;
                robot.step(world, &mut stream);
                way_m += off(before, robot.truth).0;
                let scan = world.scan(robot.truth, &mut stream);
                let begin = cpu_s();
                let _ = amcl.update(robot.odom_from_base, &scan);
                spent_s += cpu_s() - begin;
                is_sure = amcl.status().state == LocalizationState::Tracking;
                let Some(map_from_odom) = amcl.map_from_odom() else { continue };
                let (metres, radians) = off(robot.truth, map_from_odom * robot.odom_from_base);
                is_right = metres < MAX_RIGHT_ERROR_M && radians < MAX_RIGHT_ERROR_RAD;
                if is_sure {
                    sure_scans += 1;
                    wrong_scans += usize::from(!is_right);
                }
                if is_sure && is_right && first.is_none() {
                    first = Some((way_m, spent_s));
                }
            }
            match (is_sure, is_right) {
                (true, true) => right += 1,
                (true, false) => wrong += 1,
                (false, _) => unsure += 1,
            }
            if is_verbose && !(is_sure && is_right) {
                println!(
                    "  {} {seed}: sure {is_sure} right {is_right} {:?} truth {:?} {:?}",
                    world.name,
                    amcl.status().state,
                    robot.truth,
                    amcl.status().reason
                );
            }
            if let Some((way_m, spent_s)) = first {
                ways.push(way_m);
                costs.push(spent_s);
            }
        }
        let share = |count: usize| 100.0 * count as f64 / starts as f64;
        let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len().max(1) as f64;
        let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        println!(
            "| {} | {:.0} | {:.0} | {:.0} | {:.2} | {:.2} | {:.1} | {:.3} | {:.3} |",
            world.name,
            share(right),
            share(wrong),
            share(unsure),
            100.0 * wrong_scans as f64 / (sure_scans as f64).max(1.0),
            mean(&ways),
            most(&ways),
            mean(&costs),
            most(&costs),
        );
    }
}
