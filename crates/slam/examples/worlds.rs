//! Hard worlds with known truth, in one table: long rings, crossings that all look the same, wheels
//! that lie. `worlds [--out DIR] [--only NAME]`.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that measures time and says how it went"
)]

#[path = "../tests/worlds/mod.rs"]
mod worlds;

use std::time::Instant;

use periplus_base::{Pose2, normalize_angle};
use periplus_slam::{Settings, Slam};
use worlds::{Moment, ROBOT, Robot, World};

const BAD: Robot = Robot { way_error: 0.15, turn_error: 0.2, bias_rad_per_m: 0.04, ..ROBOT };

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| {
        arguments.iter().position(|it| it == name).and_then(|at| arguments.get(at + 1)).cloned()
    };
    let only = after("--only");
    println!(
        "{:<26} {:>6} {:>6} | {:>7} {:>7} {:>7} | {:>6} {:>6} | {:>9} {:>6} {:>5}",
        "world",
        "scans",
        "way m",
        "rms m",
        "max m",
        "deg",
        "ms",
        "worst",
        "closures",
        "wrong",
        "ties"
    );
    let ring = |width: f64, height: f64, laps: usize| {
        let mut corners = vec![(6.0, 0.0)];
        for _ in 0..laps {
            corners.extend([(width, 0.0), (width, height), (0.0, height), (0.0, 0.0), (6.0, 0.0)]);
        }
        corners.push((width - 4.0, 0.0));
        corners
    };
    for seed in 0..3 {
        for (how, robot) in [("fair", ROBOT), ("bad", BAD)] {
            let go = |name: &str, world: &World, corners: &[(f64, f64)], step: f64| {
                let name = format!("{name} {how} {seed}");
                if only.as_ref().is_none_or(|only| name.contains(only.as_str())) {
                    race(&name, &world.drive(corners, step, &robot, seed));
                }
            };
            go("ring 40x25", &World::ring(40.0, 25.0, 2.4, seed), &ring(40.0, 25.0, 1), 0.6);
            go("ring 120x80", &World::ring(120.0, 80.0, 2.6, seed), &ring(120.0, 80.0, 1), 0.7);
            if seed == 0 {
                // Growth with the length of the way.
                for laps in [4, 12] {
                    let world = World::ring(120.0, 80.0, 2.6, seed);
                    go(&format!("ring 120x80, {laps} laps"), &world, &ring(120.0, 80.0, laps), 0.7);
                }
            }
            let bare = World::blocks(1, 1, 30.0, 2.4);
            go(
                "bare ring",
                &bare,
                &[(5.0, 0.0), (32.4, 0.0), (32.4, 32.4), (0.0, 32.4), (0.0, 0.0), (25.0, 0.0)],
                0.6,
            );
            let blocks = World::blocks(4, 4, 10.0, 2.4);
            let p = 12.4;
            let at = |c: usize, r: usize| (c as f64 * p, r as f64 * p);
            let weave = [
                at(0, 0),
                at(4, 0),
                at(4, 1),
                at(0, 1),
                at(0, 2),
                at(4, 2),
                at(4, 3),
                at(0, 3),
                at(0, 4),
                at(4, 4),
                at(4, 0),
                at(3, 0),
                at(3, 4),
                at(2, 4),
                at(2, 0),
                at(1, 0),
                at(1, 4),
                at(0, 4),
                at(0, 0),
            ];
            go("blocks 4x4", &blocks, &weave, 0.6);
            let outer = [
                at(0, 0),
                at(4, 0),
                at(4, 4),
                at(0, 4),
                at(0, 0),
                at(2, 0),
                at(2, 4),
                at(0, 4),
                at(0, 2),
                at(4, 2),
            ];
            go("blocks outer", &blocks, &outer, 0.6);
        }
    }
}

fn race(name: &str, moments: &[Moment]) {
    let mut slam = Slam::new(Settings {
        refine_sweeps: std::env::var("SWEEPS").map_or(4, |it| it.parse().unwrap()),
        ..Settings::default()
    });
    let begin = Instant::now();
    let mut worst = 0.0_f64;
    for moment in moments {
        let one = Instant::now();
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
        worst = worst.max(one.elapsed().as_secs_f64());
    }
    slam.finish();
    let spent = begin.elapsed().as_secs_f64();
    let trajectory = slam.trajectory();
    let truth_from_map = moments[0].truth * trajectory[0].1.inverse();
    let (mut squares, mut most, mut turn, mut way) = (0.0, 0.0_f64, 0.0_f64, 0.0);
    for (index, ((_, found), moment)) in trajectory.iter().zip(moments).enumerate() {
        let off = moment.truth.inverse() * (truth_from_map * *found);
        let metres = libm::hypot(off.x_m, off.y_m);
        squares += metres * metres;
        most = most.max(metres);
        turn = turn.max(normalize_angle(off.yaw_rad).abs());
        if index > 0 {
            let step = moments[index - 1].truth.inverse() * moment.truth;
            way += libm::hypot(step.x_m, step.y_m);
        }
    }
    // Every scan here is a key, or nearly: keys are told by number of scan.
    let keys = slam.kept();
    let mut wrong = 0;
    for closure in slam.closures().iter().filter(|it| it.is_accepted) {
        let (old, new) = (keys[closure.keys.0], keys[closure.keys.1]);
        let truth = moments[old].truth.inverse() * moments[new].truth;
        let off: Pose2 = truth.inverse() * closure.old_from_new;
        if libm::hypot(off.x_m, off.y_m) > 0.5 || normalize_angle(off.yaw_rad).abs() > 0.2 {
            wrong += 1;
            println!("    wrong: {truth:?} {closure:?}");
        }
    }
    let accepted = slam.closures().iter().filter(|it| it.is_accepted).count();
    println!(
        "{:<26} {:>6} {:>6.0} | {:>7.3} {:>7.3} {:>7.2} | {:>6.2} {:>6.0} | {:>9} {:>6} {:>5}",
        name,
        moments.len(),
        way,
        (squares / moments.len() as f64).sqrt(),
        most,
        turn.to_degrees(),
        1e3 * spent / moments.len() as f64,
        1e3 * worst,
        format!("{accepted}/{}", slam.closures().len()),
        wrong,
        slam.counts().ties
    );
}
