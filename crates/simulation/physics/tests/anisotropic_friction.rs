//! Anisotropic friction: skates and wheels with rollers.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]

mod common;

use common::{
    DOWN, at, find_joint, flat_world, hinge, model, put, run, solid_ball, solid_box, state,
};
use periplus_physics::{JointCommand, NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_scene::{DVec3, Friction, Link, Model, Pose};

fn rough(link: &mut Link, fdir1: DVec3, frame: Option<&str>) {
    link.collisions[0].surface.friction = Friction {
        mu: 1.0,
        mu2: 0.0,
        fdir1,
        fdir1_expressed_in: frame.map(str::to_owned),
        ..Friction::default()
    };
}

/// A runner that was pushed along x and y at 1 m/s each: it stops along x after 5.1 cm (v² / 2 mu
/// g), and slides along y without end.
#[test]
fn a_skate_slides_one_way() {
    let mut runner = at(0.0, 0.0, 0.05, solid_box("runner", 2.0, DVec3::new(0.2, 0.2, 0.1)));
    rough(&mut runner, DVec3::X, None);
    let mut world = flat_world();
    let skate = put(&mut world, &model("skate", vec![runner], Vec::new()), Pose::IDENTITY);
    run(&mut world, 0.1);
    world.set_model_velocity(skate, DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO);
    run(&mut world, 0.2);
    let stopped = state(&world, "skate", "runner");
    let way_m = stopped.world_from_link.translation.x;
    assert!((way_m - 0.051).abs() < 0.003, "stopped after {way_m} m");
    run(&mut world, 0.8);
    let slid = state(&world, "skate", "runner");
    let way_m = slid.world_from_link.translation.y;
    assert!((way_m - 1.0).abs() < 0.02, "slid {way_m} m");
    // Braking turns the body a little, and with it the direction of larger friction.
    let along_m_s = slid.linear_m_s.dot(slid.world_from_link.rotation * DVec3::X);
    assert!(along_m_s.abs() < 1e-3, "{along_m_s}");
}

/// Regression test: the next step and the contacts before it panicked, since the solver kept the
/// pair of the removed shape.
#[test]
fn what_a_skate_rests_on_is_removed() {
    let mut plate = at(0.0, 0.0, 0.05, solid_box("plate", 2.0, DVec3::new(1.0, 1.0, 0.1)));
    plate.collisions[0].surface.friction.mu = 0.5;
    let mut runner = at(0.0, 0.0, 0.15, solid_box("runner", 2.0, DVec3::new(0.2, 0.2, 0.1)));
    rough(&mut runner, DVec3::X, None);
    let mut world = flat_world();
    let plate = put(&mut world, &model("plate", vec![plate], Vec::new()), Pose::IDENTITY);
    put(&mut world, &model("skate", vec![runner], Vec::new()), Pose::IDENTITY);
    run(&mut world, 0.1);
    let before = world.contacts().len();
    world.remove(plate);
    assert!(world.contacts().len() < before);
    run(&mut world, 0.5);
    let height_m = state(&world, "skate", "runner").world_from_link.translation.z;
    assert!((height_m - 0.05).abs() < 0.002, "{height_m}");
}

/// The clone of a world in motion does the same, to the bit, also after the original went on.
#[test]
fn a_clone_does_the_same() {
    let mut world = flat_world();
    let robot = put(&mut world, &mecanum(), Pose::from_xyz(0.0, 0.0, 0.02));
    let turn = |world: &mut PhysicsWorld, number: usize| {
        for (index, joint) in world.joints(robot).enumerate().collect::<Vec<_>>() {
            let target = 3.0 - (index * number % 5) as f64;
            world.command(joint, JointCommand::Velocity { target, max_effort: 5.0 });
        }
        run(world, 0.1);
    };
    (0..3).for_each(|number| turn(&mut world, number));
    let saved = world.clone();
    (3..9).for_each(|number| turn(&mut world, number));
    for _ in 0..2 {
        let mut again = saved.clone();
        (3..9).for_each(|number| turn(&mut again, number));
        assert_eq!(again.snapshot(), world.snapshot());
        assert_eq!(again.contacts(), world.contacts());
    }
    let mut other = saved.clone();
    other.remove(robot);
    run(&mut other, 0.1);
    assert!(saved.model_pose(robot).is_some() && other.model_pose(robot).is_none());
}

/// Four balls as wheels, their rollers in the X of a mecanum drive.
fn mecanum() -> Model {
    let mut links = vec![at(0.0, 0.0, 0.15, solid_box("chassis", 10.0, DVec3::new(0.5, 0.3, 0.1)))];
    let mut joints = Vec::new();
    for (name, x, y) in [("fl", 0.2, 0.2), ("fr", 0.2, -0.2), ("rl", -0.2, 0.2), ("rr", -0.2, -0.2)]
    {
        let mut wheel = at(x, y, 0.1, solid_ball(name, 0.5, 0.1));
        let lean = if x * y > 0.0 { -1.0 } else { 1.0 };
        rough(&mut wheel, DVec3::new(1.0, lean, 0.0), Some("chassis"));
        links.push(wheel);
        joints.push(hinge(&format!("{name}_joint"), "chassis", name, DVec3::Y));
    }
    model("mecanum", links, joints)
}

fn driven(speeds_rad_s: [f64; 4]) -> (DVec3, f64) {
    let mut world = flat_world();
    put(&mut world, &mecanum(), Pose::IDENTITY);
    run(&mut world, 0.2);
    for (name, speed_rad_s) in ["fl", "fr", "rl", "rr"].into_iter().zip(speeds_rad_s) {
        let joint = find_joint(&world, "mecanum", &format!("{name}_joint"));
        world.command(joint, JointCommand::Velocity { target: speed_rad_s, max_effort: 100.0 });
    }
    run(&mut world, 2.0);
    let chassis = state(&world, "mecanum", "chassis");
    let yaw_rad = chassis.world_from_link.rotation.to_scaled_axis().z;
    (chassis.world_from_link.translation, yaw_rad)
}

/// Wheels of 0.1 m at 5 rad/s roll 0.5 m/s: 1 m in 2 s, forward, or to the left when the wheels
/// of one diagonal turn backward.
#[test]
fn rollers_strafe() {
    let (place, yaw_rad) = driven([5.0; 4]);
    assert!((place.x - 1.0).abs() < 0.05 && place.y.abs() < 0.02, "{place}");
    assert!(yaw_rad.abs() < 0.02);
    let (place, yaw_rad) = driven([-5.0, 5.0, 5.0, -5.0]);
    assert!((place.y - 1.0).abs() < 0.05 && place.x.abs() < 0.02, "{place}");
    assert!(yaw_rad.abs() < 0.02);
}

#[test]
fn a_frame_that_is_not_there_is_told() {
    let mut runner = at(0.0, 0.0, 0.05, solid_box("runner", 2.0, DVec3::new(0.2, 0.2, 0.1)));
    rough(&mut runner, DVec3::X, Some("chasis"));
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    let added = world.add(&model("skate", vec![runner], Vec::new()), Pose::IDENTITY, &NoMeshes);
    let told: Vec<_> = added.diagnostics.iter().map(|found| found.code).collect();
    assert_eq!(told, ["unknown-frame"]);
}
