//! Steps per second of many environments in a world, by one thread and by two, and the memory of each environment.
//!
//! `cargo run --release -p periplus-environments --example step_rate -- worlds/house.sdf`
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "it measures time and prints it"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use periplus_environments::{
    EnvironmentRobot, EnvironmentRobotParams, NavigationBatch, NavigationRewardParams,
    NavigationSettings, NavigationTaskParams, NavigationWorld, ResetRequest, StepOutputs,
};
use periplus_geometry::Stream;
use periplus_loader::{LoadContext, load};
use periplus_os::Machine;
use periplus_rendering::NoAssets;
use periplus_resources::Resolver;

const COUNT: usize = 1024;
const STEPS: usize = 20;

fn main() {
    let path = PathBuf::from(std::env::args().nth(1).expect("the path of a world"));
    let models = path.parent().unwrap_or(Path::new(".")).join("models");
    let context = LoadContext {
        host: &Machine,
        resolver: &Resolver::new(&Machine, &[models]),
        working_folder: std::env::current_dir().unwrap(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let loaded = load(&path, &context);
    let world = loaded.scene.expect("a world").worlds.remove(0);
    let robot = EnvironmentRobot::new(EnvironmentRobotParams::default()).unwrap();
    let start = Instant::now();
    let (world, findings) = NavigationWorld::new(&world, &robot, &NoAssets, 1);
    println!("world in {:.1} ms", start.elapsed().as_secs_f64() * 1e3);
    assert!(!findings.has_errors(), "{findings:?}");
    let world = Arc::new(world);
    for threads in [1, 2] {
        let settings = NavigationSettings {
            worlds: vec![Arc::clone(&world)],
            robot: robot.clone(),
            task: NavigationTaskParams::default(),
            reward: NavigationRewardParams::default(),
            agents: 1,
            resets_in_next_step: true,
        };
        let mut batch = NavigationBatch::new(settings, COUNT, threads).unwrap();
        let mut observations = vec![0.0; COUNT * batch.observation_size()];
        let seeds: Vec<u64> = (0..COUNT as u64).collect();
        let request = ResetRequest { seeds: Some(&seeds), ..ResetRequest::default() };
        batch.reset(request, &mut observations).unwrap();
        let (mut rewards, mut terminated) = (vec![0.0; COUNT], vec![false; COUNT]);
        let mut truncated = terminated.clone();
        let mut stream = Stream::keyed(0, "actions", 0);
        let mut best_s = f64::INFINITY;
        for _ in 0..5 {
            let start = Instant::now();
            for _ in 0..STEPS {
                let actions: Vec<f32> =
                    (0..2 * COUNT).map(|_| (stream.unit() * 2.0 - 1.0) as f32).collect();
                let outputs = StepOutputs {
                    observations: &mut observations,
                    rewards: &mut rewards,
                    terminated: &mut terminated,
                    truncated: &mut truncated,
                };
                batch.step(&actions, outputs).unwrap();
            }
            best_s = best_s.min(start.elapsed().as_secs_f64());
        }
        println!("{threads} threads: {:.0} steps/s", (COUNT * STEPS) as f64 / best_s);
    }
}
