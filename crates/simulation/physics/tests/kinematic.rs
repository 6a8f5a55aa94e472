//! A world without physics.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod common;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use common::*;
use periplus_physics::{JointCommand, PhysicsMode, PhysicsWorld, Twist};
use periplus_scene::{Axis, DVec3, JointKind, Link, Model, Pose};
use proptest::prelude::*;

fn world_with(model: &Model, pose: Pose) -> PhysicsWorld {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Kinematic);
    put(&mut world, &ground(), Pose::IDENTITY);
    put(&mut world, model, pose);
    world
}

fn near(found: Pose, expected: Pose) {
    let (metres, radians) = found.distance_to(expected);
    assert!(metres < 1e-9 && radians < 1e-9, "{found:?} instead of {expected:?}");
}

fn at_yaw(x: f64, y: f64, z: f64, yaw: f64) -> Pose {
    Pose::from_xyz_rpy([x, y, z], periplus_geometry::Rpy { roll: 0.0, pitch: 0.0, yaw })
}

const SECOND_NS: i64 = 1_000_000_000;

#[test]
fn a_quarter_circle_in_one_step() {
    let mut world = world_with(&two_wheels(), Pose::IDENTITY);
    let robot = world.find_model("robot").unwrap();
    let twist = Twist { x_m_s: FRAC_PI_2, yaw_rad_s: FRAC_PI_2, ..Twist::default() };
    assert!(world.follow(robot, twist));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(robot).unwrap(), at_yaw(1.0, 1.0, 0.0, FRAC_PI_2));
    // The base is 0.15 m up, the left wheel 0.12 m behind and 0.18 m to the left.
    let base = state(&world, "robot", "base");
    near(base.world_from_link, at_yaw(1.0, 1.0, 0.15, FRAC_PI_2));
    assert!(base.linear_m_s.distance(DVec3::new(0.0, FRAC_PI_2, 0.0)) < 1e-9, "{base:?}");
    let wheel = state(&world, "robot", "left");
    near(wheel.world_from_link, at_yaw(0.82, 0.88, 0.1, FRAC_PI_2));
    // Its middle runs on a circle of 0.82 m by 0.12 m: v = w x r.
    let expected = DVec3::new(0.12 * FRAC_PI_2, 0.82 * FRAC_PI_2, 0.0);
    assert!(wheel.linear_m_s.distance(expected) < 1e-9, "{wheel:?}");
    assert_eq!(world.time_ns(), SECOND_NS);
    // It moves until the next command, and stops when commanded.
    world.step(3 * SECOND_NS).unwrap();
    near(world.model_pose(robot).unwrap(), Pose::IDENTITY);
    assert!(world.follow(robot, Twist::default()));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(robot).unwrap(), Pose::IDENTITY);
    assert_eq!(state(&world, "robot", "base").linear_m_s, DVec3::ZERO);
}

#[test]
fn ten_turns_about_the_middle_of_the_axle() {
    let mut world = world_with(&two_wheels(), at_yaw(3.0, -2.0, 0.0, 0.7));
    let robot = world.find_model("robot").unwrap();
    let wheels = Wheels::of(&world);
    let middle = world.middle_of(robot, &[wheels.left, wheels.right]).unwrap();
    assert!(middle.distance(DVec3::new(-0.12, 0.0, 0.1)) < 1e-12, "{middle:?}");
    let start = world.model_pose(robot).unwrap();
    let twist = Twist { yaw_rad_s: 1.0, ..Twist::default() };
    let step_ns = 1_000_000;
    for _ in 0..(20.0 * PI * 1e3) as usize {
        world.follow_about(robot, middle, twist);
        wheels.turn(&mut world, -1.8, 1.8);
        world.step(step_ns).unwrap();
        let now = world.model_pose(robot).unwrap();
        let drift = now.transform_point(middle).distance(start.transform_point(middle));
        assert!(drift < 1e-9, "{drift}");
    }
    let turned_rad = world.time_ns() as f64 / 1e9;
    let way = libm::remainder(world.model_pose(robot).unwrap().rpy().yaw - 0.7 - turned_rad, TAU);
    assert!(way.abs() < 1e-9, "{way}");
    // Encoders: 1.8 rad/s each way.
    let left = world.axis_state(wheels.left).unwrap();
    assert!((left.position + 1.8 * turned_rad).abs() < 1e-6 && left.velocity == -1.8, "{left:?}");
}

#[test]
fn joints_follow_their_commands_and_links_follow_joints() {
    let links = vec![Link::new("base"), at(1.0, 0.0, 0.0, Link::new("arm"))];
    let limited = Axis { direction_in_joint: DVec3::Z, upper: 1.0, ..Axis::default() };
    let links = links
        .into_iter()
        .chain([at(2.0, 0.0, 0.0, Link::new("hand")), at(2.0, 0.0, 0.0, Link::new("other"))]);
    let mut masses: Vec<Link> = links.collect();
    for link in &mut masses {
        link.inertial = solid_ball("", 1.0, 0.1).inertial;
    }
    let mut follower = joint("other_joint", JointKind::Revolute, "base", "other", Axis::default());
    follower.axis.as_mut().unwrap().mimic = Some(periplus_scene::Mimic {
        joint: "shoulder".into(),
        axis: "axis".into(),
        multiplier: -2.0,
        offset: 0.5,
        reference: 0.0,
    });
    let slide = Axis { direction_in_joint: DVec3::X, upper: 0.5, ..Axis::default() };
    let arm = model(
        "robot",
        masses,
        vec![
            joint("shoulder", JointKind::Revolute, "base", "arm", limited),
            joint("hand_joint", JointKind::Prismatic, "arm", "hand", slide),
            follower,
        ],
    );
    let mut world = world_with(&arm, Pose::IDENTITY);
    let shoulder = find_joint(&world, "robot", "shoulder");
    let hand = find_joint(&world, "robot", "hand_joint");
    world.command(shoulder, JointCommand::Velocity { target: 0.5, max_effort: 1.0 });
    let (target, max_speed) = (0.3, 10.0);
    world.command(hand, JointCommand::Position { target, max_speed, max_effort: 1.0 });
    world.step(SECOND_NS).unwrap();
    // The arm turns about its own origin; the hand slides out of it.
    let expected = at_yaw(1.0, 0.0, 0.0, 0.5) * Pose::from_xyz(1.3, 0.0, 0.0);
    near(state(&world, "robot", "hand").world_from_link, expected);
    near(state(&world, "robot", "other").world_from_link, at_yaw(2.0, 0.0, 0.0, -0.5));
    let speed = state(&world, "robot", "hand").linear_m_s;
    let across = at_yaw(0.0, 0.0, 0.0, 0.5).transform_point(DVec3::new(0.0, 0.65, 0.0));
    assert!(speed.distance(across) < 1e-9, "{speed:?}");
    // The limit holds the joint, which is then at rest.
    world.step(5 * SECOND_NS).unwrap();
    let held = world.axis_state(shoulder).unwrap();
    assert_eq!((held.position, held.velocity), (1.0, 0.0));
    // An effort moves nothing here.
    world.command(shoulder, JointCommand::Effort(-10.0));
    world.step(SECOND_NS).unwrap();
    assert_eq!(world.axis_state(shoulder).unwrap().position, 1.0);
    // A limb that is put elsewhere comes back to its joint.
    let link = link(&world, "robot", "hand");
    let before = world.link_state(link).unwrap();
    assert!(world.set_link_pose(link, Pose::IDENTITY));
    world.step(1).unwrap();
    near(world.link_state(link).unwrap().world_from_link, before.world_from_link);
}

#[test]
fn a_robot_whose_wheel_is_the_parent_stays_whole() {
    let mut reversed = two_wheels();
    reversed.canonical_link = Some("base".into());
    let left = &mut reversed.joints[0];
    std::mem::swap(&mut left.parent, &mut left.child);
    // The joint stays at the wheel: its frame is given in the frame of the child, which is now the base.
    left.child_from_joint = Pose::from_xyz(-0.12, 0.18, -0.05);
    let mut world = world_with(&reversed, Pose::IDENTITY);
    let robot = world.find_model("robot").unwrap();
    world.command(
        find_joint(&world, "robot", "left_joint"),
        JointCommand::Velocity { target: 1.0, max_effort: 1.0 },
    );
    assert!(world.follow(robot, Twist { x_m_s: 1.0, ..Twist::default() }));
    world.step(SECOND_NS).unwrap();
    near(state(&world, "robot", "base").world_from_link, Pose::from_xyz(1.0, 0.0, 0.15));
    let wheel = state(&world, "robot", "left").world_from_link;
    assert!(wheel.translation.distance(DVec3::new(0.88, 0.18, 0.1)) < 1e-9, "{wheel:?}");
    assert!((wheel.rpy().pitch + 1.0).abs() < 1e-9, "{wheel:?}");
}

#[test]
fn what_is_not_told_stays_and_what_is_put_elsewhere_is_there() {
    let stone = model("stone", vec![solid_box("box", 1.0, DVec3::splat(0.3))], vec![]);
    let mut world = world_with(&two_wheels(), Pose::IDENTITY);
    let stone = put(&mut world, &stone, Pose::from_xyz(0.5, 0.0, 4.0));
    let robot = world.find_model("robot").unwrap();
    let forward = Twist { x_m_s: 1.0, ..Twist::default() };
    assert!(world.follow(robot, forward));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(stone).unwrap(), Pose::from_xyz(0.5, 0.0, 4.0));
    // After a new pose it is at rest, and moves from there at the next command.
    assert!(world.set_pose(robot, at_yaw(5.0, 5.0, 0.2, FRAC_PI_2)));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(robot).unwrap(), at_yaw(5.0, 5.0, 0.2, FRAC_PI_2));
    near(
        state(&world, "robot", "left").world_from_link,
        at_yaw(5.0, 5.0, 0.2, FRAC_PI_2) * Pose::from_xyz(-0.12, 0.18, 0.1),
    );
    assert!(world.follow(robot, forward));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(robot).unwrap(), at_yaw(5.0, 6.0, 0.2, FRAC_PI_2));
    // A velocity in world axes moves and turns it as one piece.
    assert!(world.set_model_velocity(stone, DVec3::new(0.0, 1.0, -1.0), DVec3::Z * FRAC_PI_2));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(stone).unwrap(), at_yaw(0.5, 1.0, 3.0, FRAC_PI_2));
    // A reset restores the initial state, and clears the commands.
    world.reset();
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(stone).unwrap(), Pose::from_xyz(0.5, 0.0, 4.0));
    near(world.model_pose(robot).unwrap(), Pose::IDENTITY);
    // Models come and go.
    world.remove(stone);
    assert!(world.model_pose(stone).is_none() && !world.follow(stone, forward));
    let again = put(&mut world, &two_wheels(), Pose::from_xyz(0.0, 9.0, 0.0));
    assert!(world.follow(again, forward) && world.follow(robot, forward));
    world.step(SECOND_NS).unwrap();
    near(world.model_pose(again).unwrap(), Pose::from_xyz(1.0, 9.0, 0.0));
    near(world.model_pose(robot).unwrap(), Pose::from_xyz(1.0, 0.0, 0.0));
    // What is fixed to the world goes nowhere.
    let ground = world.find_model("ground").unwrap();
    assert!(!world.follow(ground, forward));
    assert!(!world.follow(robot, Twist { x_m_s: f64::NAN, ..Twist::default() }));
}

#[test]
fn physics_does_not_follow() {
    let mut world = flat_world();
    let robot = put(&mut world, &two_wheels(), Pose::IDENTITY);
    assert!(!world.follow(robot, Twist { x_m_s: 1.0, ..Twist::default() }));
}

proptest! {
    #[test]
    fn long_steps_and_short_ones_meet(
        x in -1.0..1.0f64, y in -1.0..1.0f64, yaw in -2.0..2.0f64, wheel in -9.0..9.0f64,
        cuts in prop::collection::vec(1..SECOND_NS, 1..20),
    ) {
        let twist = Twist { x_m_s: x, y_m_s: y, yaw_rad_s: yaw };
        let go = |steps: &[i64]| {
            let mut world = world_with(&two_wheels(), at_yaw(1.0, 2.0, 0.0, 3.0));
            let robot = world.find_model("robot").unwrap();
            world.follow_about(robot, DVec3::new(-0.12, 0.0, 0.1), twist);
            Wheels::of(&world).turn(&mut world, wheel, -wheel);
            for &step in steps {
                world.step(step).unwrap();
            }
            let pose = |name: &str| state(&world, "robot", name).world_from_link;
            (world.time_ns(), pose("base"), pose("left"), pose("caster"))
        };
        let short = go(&cuts);
        let long = go(&[cuts.iter().sum()]);
        prop_assert_eq!(short.0, long.0);
        near(short.1, long.1);
        near(short.2, long.2);
        near(short.3, long.3);
    }
}
