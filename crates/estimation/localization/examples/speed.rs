//! Time per scan on one core: the sensor models alone, and whole updates.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that measures time and prints results"
)]

#[path = "worlds/mod.rs"]
#[allow(dead_code, reason = "each tool uses its part")]
mod worlds;

use std::time::Instant;

use periplus_geometry::Stream;
use periplus_localization::{Amcl, SensorModel, Settings};
use worlds::{Wanderer, World, initial_pose_at};

fn main() {
    println!("| work | map | least ms | median ms |");
    println!("|---|---|---|---|");
    for world in [World::house(), World::block_of_offices()] {
        let map = world.map();
        for (name, model) in [
            ("likelihood_field", SensorModel::LikelihoodField),
            ("likelihood_field_prob", SensorModel::LikelihoodFieldProb),
            ("beam", SensorModel::Beam),
        ] {
            for beams in [60, 360] {
                let mut settings = Settings {
                    sensor_model: model,
                    localizes_globally: false,
                    refines_by_scan_matching: false,
                    searches_when_lost: false,
                    ..Settings::default()
                };
                settings.beams.max_beams = beams;
                // Fixed number of particles.
                (settings.kld_sampling.min_particles, settings.kld_sampling.max_particles) =
                    (2000, 2000);
                let mut stream = Stream::keyed(1, "speed", 0);
                let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
                let mut amcl = Amcl::new(settings);
                amcl.set_map("map", &map).unwrap();
                amcl.set_pose(&initial_pose_at(robot.truth)).unwrap();
                let (mut models, mut updates) = (Vec::new(), Vec::new());
                for _ in 0..60 {
                    robot.step(&world, &mut stream);
                    let scan = world.scan(robot.truth, &mut stream);
                    let begin = Instant::now();
                    let said = amcl.likelihoods(&scan).unwrap();
                    models.push(begin.elapsed().as_secs_f64());
                    assert_eq!(said.len(), 2000);
                    amcl.request_update();
                    let begin = Instant::now();
                    amcl.update(robot.odom_from_base, &scan).unwrap();
                    updates.push(begin.elapsed().as_secs_f64());
                }
                for (what, mut times) in [("model", models), ("update", updates)] {
                    times.sort_by(f64::total_cmp);
                    println!(
                        "| {name}, 2000 x {beams}, {what} | {} | {:.3} | {:.3} |",
                        world.name,
                        1e3 * times[0],
                        1e3 * times[times.len() / 2],
                    );
                }
            }
        }
    }
}
