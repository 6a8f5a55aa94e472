//! Time of one step of a robot with two wheels on this machine, and the bits of its final pose, which are
//! the same in every build on every machine.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "it measures time and prints it"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::Instant;

use common::*;
use periplus_physics::{PhysicsMode, PhysicsWorld, Twist};
use periplus_scene::{DVec3, Pose};

fn main() {
    for boxes in [0, 20] {
        let mut world = flat_world();
        put(&mut world, &two_wheels(), Pose::IDENTITY);
        for number in 0..boxes {
            let stone = model("box", vec![solid_box("box", 1.0, DVec3::splat(0.3))], vec![]);
            put(&mut world, &stone, Pose::from_xyz(-2.0 - f64::from(number), 0.0, 0.15));
        }
        let wheels = Wheels::of(&world);
        wheels.turn(&mut world, 5.0, 5.0);
        run(&mut world, 3.0);
        let mut best = f64::INFINITY;
        for _ in 0..10 {
            let start = Instant::now();
            run(&mut world, 1.0);
            best = best.min(start.elapsed().as_secs_f64() / 1000.0);
        }
        let pose = state(&world, "robot", "base").world_from_link;
        let bits = pose.translation.to_array().map(f64::to_bits);
        println!("{boxes} sleeping boxes: {:.1} us/step, ends at {bits:x?}", best * 1e6);
    }
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Kinematic);
    put(&mut world, &ground(), Pose::IDENTITY);
    let robot = put(&mut world, &two_wheels(), Pose::IDENTITY);
    let wheels = Wheels::of(&world);
    let mut best = f64::INFINITY;
    for _ in 0..10 {
        let start = Instant::now();
        for _ in 0..100_000 {
            world.follow(robot, Twist { x_m_s: 0.5, y_m_s: 0.0, yaw_rad_s: 0.2 });
            wheels.turn(&mut world, 4.0, 6.0);
            world.step(STEP_NS).unwrap();
        }
        best = best.min(start.elapsed().as_secs_f64() / 1e5);
    }
    let bits = world.model_pose(robot).unwrap().translation.to_array().map(f64::to_bits);
    println!("kinematic: {:.3} us/step, ends at {bits:x?}", best * 1e6);
}
