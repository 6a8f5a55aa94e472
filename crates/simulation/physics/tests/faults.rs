//! Seized joints and slippery surfaces.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{find_joint, flat_world, link, put, run, state, two_wheels};
use periplus_physics::{JointCommand, PhysicsWorld};
use periplus_scene::Pose;

/// The robot of the tests on a floor, with both wheels commanded to turn at 2 rad/s: 0.2 m/s.
fn driving() -> PhysicsWorld {
    let mut world = flat_world();
    put(&mut world, &two_wheels(), Pose::IDENTITY);
    run(&mut world, 0.2);
    command(&mut world, 2.0);
    world
}

fn command(world: &mut PhysicsWorld, target: f64) {
    for name in ["left_joint", "right_joint"] {
        let joint = find_joint(world, "robot", name);
        world.command(joint, JointCommand::Velocity { target, max_effort: 20.0 });
    }
}

fn x_m(world: &PhysicsWorld) -> f64 {
    state(world, "robot", "base").world_from_link.translation.x
}

#[test]
fn a_robot_with_one_seized_wheel_turns_about_it() {
    let mut world = driving();
    let left = find_joint(&world, "robot", "left_joint");
    assert!(world.set_seized(left, true));
    command(&mut world, 2.0);
    run(&mut world, 1.0);
    let turned = state(&world, "robot", "base").angular_rad_s.z;
    // The right wheel moves at 0.2 m/s, 0.36 m beside the left one.
    assert!((turned - 0.2 / 0.36).abs() < 0.05, "{turned} rad/s");
    assert!(world.axis_state(left).unwrap().velocity.abs() < 0.01);
    world.set_seized(left, false);
    command(&mut world, 2.0);
    run(&mut world, 1.0);
    assert!((world.axis_state(left).unwrap().velocity - 2.0).abs() < 0.05);
}

/// On a surface without friction the wheels turn and the robot stays; with the limit removed it drives.
#[test]
fn wheels_without_friction_turn_in_place() {
    let mut world = flat_world();
    put(&mut world, &two_wheels(), Pose::IDENTITY);
    run(&mut world, 0.2);
    for name in ["left", "right"] {
        let wheel = link(&world, "robot", name);
        assert!(world.limit_friction(wheel, Some(0.0)));
    }
    let from_m = x_m(&world);
    command(&mut world, 2.0);
    run(&mut world, 1.0);
    assert!((x_m(&world) - from_m).abs() < 0.005, "{} m", x_m(&world) - from_m);
    let right = find_joint(&world, "robot", "right_joint");
    assert!((world.axis_state(right).unwrap().velocity - 2.0).abs() < 0.05);
    for name in ["left", "right"] {
        let wheel = link(&world, "robot", name);
        world.limit_friction(wheel, None);
    }
    let from_m = x_m(&world);
    run(&mut world, 1.0);
    assert!((x_m(&world) - from_m - 0.2).abs() < 0.02, "{} m", x_m(&world) - from_m);
}

#[test]
fn faults_of_parts_that_do_not_exist_are_refused() {
    let mut world = driving();
    let base = link(&world, "robot", "base");
    assert!(!world.limit_friction(base, Some(-1.0)) && !world.limit_friction(base, Some(f64::NAN)));
    let fixed = find_joint(&world, "robot", "caster_joint");
    assert!(!world.set_seized(fixed, true));
}
