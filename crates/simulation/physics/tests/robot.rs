//! A robot with two wheels and a caster.
#![allow(missing_docs, reason = "tests")]

mod common;

use std::f64::consts::{PI, TAU};

use common::*;
use periplus_physics::PhysicsWorld;
use periplus_scene::{Collision, DVec3, Link, Model, Pose, Shape};

fn settled() -> (PhysicsWorld, Wheels) {
    let mut world = flat_world();
    put(&mut world, &two_wheels(), Pose::IDENTITY);
    let wheels = Wheels::of(&world);
    wheels.turn(&mut world, 0.0, 0.0);
    // Contacts give way under the load, in half a second.
    run(&mut world, 3.0);
    (world, wheels)
}

fn base(world: &PhysicsWorld) -> Pose {
    state(world, "robot", "base").world_from_link
}

#[test]
fn straight_ahead() {
    let (mut world, wheels) = settled();
    let start = base(&world);
    let angle =
        |world: &PhysicsWorld, wheels: &Wheels| world.axis_state(wheels.left).unwrap().position;
    let before = angle(&world, &wheels);
    wheels.turn(&mut world, 5.0, 5.0);
    run(&mut world, 10.0);
    let way = start.inverse() * base(&world);
    println!("straight: {way:?} yaw {}", way.rpy().yaw);
    // 5 rad/s on 0.1 m for 10 s.
    assert!((way.translation.x - 5.0).abs() < 0.05, "{way:?}");
    assert!(way.translation.y.abs() < 0.005 * 5.0, "{way:?}");
    assert!(way.rpy().yaw.abs() < 0.005, "{way:?}");
    // The encoders report the commanded wheel rotation; the difference is slip.
    let turned = angle(&world, &wheels) - before;
    assert!((turned - 50.0).abs() < 0.1, "{turned}");
}

#[test]
fn two_turns_on_the_spot() {
    let (mut world, wheels) = settled();
    // 1 rad/s of yaw is 0.18 m/s at each wheel.
    wheels.turn(&mut world, -1.8, 1.8);
    let mut yaw = 0.0;
    let mut before = base(&world).rpy().yaw;
    let steps = (2.0 * TAU / STEP_S).round() as usize;
    for _ in 0..steps {
        world.step(STEP_NS).unwrap();
        let now = base(&world).rpy().yaw;
        yaw += libm::remainder(now - before, TAU);
        before = now;
    }
    println!("in place: {yaw} of {}", 2.0 * TAU);
    assert!((yaw - 4.0 * PI).abs() < 0.01 * 4.0 * PI, "{yaw}");
}

#[test]
fn at_rest_it_does_not_creep() {
    let (mut world, wheels) = settled();
    let start = base(&world);
    run(&mut world, 10.0);
    let (metres, radians) = start.distance_to(base(&world));
    println!("rest: {metres} m {radians} rad in 10 s");
    // Under a tenth of a millimetre in a minute: it falls asleep.
    assert!(metres < 1e-4 / 6.0 && radians < 1e-4, "{metres} {radians}");
    assert_eq!(state(&world, "robot", "base").linear_m_s, DVec3::ZERO);
    // A slow command wakes it, and it stays awake under it: 0.1 rad/s on 0.1 m for 10 s.
    wheels.turn(&mut world, 0.1, 0.1);
    run(&mut world, 10.0);
    let way = start.inverse() * base(&world);
    assert!((way.translation.x - 0.1).abs() < 0.002, "{way:?}");
    // So does one far below what counts as rest.
    let start = base(&world);
    wheels.turn(&mut world, 0.005, 0.005);
    run(&mut world, 20.0);
    let way = start.inverse() * base(&world);
    assert!((way.translation.x - 0.01).abs() < 0.002, "{way:?}");
    // And a change of gravity.
    wheels.turn(&mut world, 0.0, 0.0);
    run(&mut world, 3.0);
    world.set_gravity(DVec3::new(0.0, 0.0, 1.0));
    run(&mut world, 1.0);
    assert!(base(&world).translation.z > 0.5);
}

#[test]
fn it_stops_at_a_wall() {
    let (mut world, wheels) = settled();
    let wall = Link {
        collisions: vec![Collision::new("wall", Shape::Box { size_m: DVec3::new(0.2, 4.0, 1.0) })],
        ..Link::new("wall")
    };
    let wall = Model { is_static: true, ..model("wall", vec![wall], vec![]) };
    put(&mut world, &wall, Pose::from_xyz(2.1, 0.0, 0.5));
    wheels.turn(&mut world, 5.0, 5.0);
    run(&mut world, 8.0);
    // The wall's face is at 2 m, the front of the body 0.21 m ahead of its centre.
    let pose = base(&world);
    println!("wall: {pose:?}");
    assert!((pose.translation.x - 1.79).abs() < 0.01, "{pose:?}");
    assert!(pose.rpy().yaw.abs() < 0.05, "{pose:?}");
    assert!(state(&world, "robot", "base").linear_m_s.length() < 0.2);
}

#[test]
fn a_step_of_one_centimetre_is_climbed() {
    let (mut world, wheels) = settled();
    let step = Link {
        collisions: vec![Collision::new("step", Shape::Box { size_m: DVec3::new(2.0, 4.0, 0.02) })],
        ..Link::new("step")
    };
    put(
        &mut world,
        &Model { is_static: true, ..model("step", vec![step], vec![]) },
        Pose::from_xyz(2.0, 0.0, 0.0),
    );
    wheels.turn(&mut world, 5.0, 5.0);
    run(&mut world, 4.0);
    let pose = base(&world);
    assert!(pose.translation.x > 1.5 && (pose.translation.z - 0.16).abs() < 0.003, "{pose:?}");
}

#[test]
fn a_wheel_touches_a_wall_beside_it_where_its_face_is() {
    // The outer face of the left wheel is at 0.20 m; a ball of the same radius would reach 0.28 m.
    let (mut world, wheels) = settled();
    let wall = |y: f64| {
        let link = Link {
            collisions: vec![Collision::new(
                "wall",
                Shape::Box { size_m: DVec3::new(8.0, 0.1, 1.0) },
            )],
            ..Link::new("wall")
        };
        (
            Model { is_static: true, ..model("wall", vec![link], vec![]) },
            Pose::from_xyz(0.0, y, 0.5),
        )
    };
    for y in [0.26, -0.26] {
        let (wall, pose) = wall(y);
        put(&mut world, &wall, pose);
    }
    // A corridor of 0.42 m for a robot of 0.40 m.
    wheels.turn(&mut world, 5.0, 5.0);
    run(&mut world, 4.0);
    let pose = base(&world);
    assert!(pose.translation.x > 1.9 && pose.translation.y.abs() < 0.005, "{pose:?}");
    let touched = |world: &PhysicsWorld| {
        let contacts = world.contacts();
        contacts.iter().any(|contact| contact.normal.y.abs() > 0.5)
    };
    assert!(!touched(&world));
    // Pushed sideways at its axle it meets the wall 1 cm further on.
    wheels.turn(&mut world, 0.0, 0.0);
    let left = link(&world, "robot", "left");
    for _ in 0..1000 {
        let DVec3 { x, y, .. } = base(&world).translation;
        let low = DVec3::new(x - 0.12, y, 0.02);
        world.apply_force(left, low, DVec3::new(0.0, 250.0, 0.0), DVec3::ZERO);
        world.step(STEP_NS).unwrap();
    }
    let face = world.link_state(left).unwrap().world_from_link.translation.y + 0.02;
    println!("pushed to {face} {:?}", base(&world));
    assert!((0.208..0.213).contains(&face), "{face}");
    assert!(touched(&world));
}

#[test]
fn two_runs_are_equal_bit_for_bit_and_names_play_no_part() {
    let drive = |rename: &str, with_reset: bool| {
        let mut world = flat_world();
        let other = model(rename, vec![solid_box("box", 1.0, DVec3::splat(0.3))], vec![]);
        put(&mut world, &other, Pose::from_xyz(1.0, 0.02, 0.15));
        put(&mut world, &two_wheels(), Pose::IDENTITY);
        let wheels = Wheels::of(&world);
        let mut out = Vec::new();
        for _ in 0..if with_reset { 2 } else { 1 } {
            world.reset();
            out.clear();
            wheels.turn(&mut world, 6.0, 5.5);
            for _ in 0..3000 {
                world.step(STEP_NS).unwrap();
                let Pose { translation, rotation } = base(&world);
                out.extend(translation.to_array().map(f64::to_bits));
                out.extend(rotation.to_array().map(f64::to_bits));
            }
        }
        out
    };
    let first = drive("aaa", false);
    assert!(first == drive("aaa", false));
    assert!(first == drive("zzz", false));
    assert!(first == drive("aaa", true), "a reset world differs from a new one");
}
