//! Joints with results in closed form.
#![allow(missing_docs, reason = "tests")]

mod common;

use std::f64::consts::{FRAC_PI_2, PI};

use common::*;
use periplus_physics::{JointCommand, PhysicsMode, PhysicsWorld};
use periplus_scene::{Axis, DVec3, Joint, JointKind, Mimic, Model, Pose};

/// A weight of 1 kg and 0.1 kg m², 1 m from a hinge along y through the origin of the world.
fn pendulum(direction: DVec3) -> Model {
    let mut hinge = hinge("hinge", "world", "bob", DVec3::Y);
    hinge.child_from_joint = Pose { translation: -direction, ..Pose::IDENTITY };
    let bob = solid_ball("bob", 1.0, 0.5);
    model("pendulum", vec![at(direction.x, direction.y, direction.z, bob)], vec![hinge])
}

#[test]
fn a_pendulum_of_one_metre_swings_in_two_seconds() {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    let (sine, cosine) = libm::sincos(0.1);
    put(&mut world, &pendulum(DVec3::new(sine, 0.0, -cosine)), Pose::IDENTITY);
    let hinge = find_joint(&world, "pendulum", "hinge");
    let mut crossings = Vec::new();
    let mut before = 0.0;
    for _ in 0..9000 {
        world.step(STEP_NS).unwrap();
        // Positive about y swings from x towards -z, so the lowest point is at 0.1 rad.
        let now = world.axis_state(hinge).unwrap().position - 0.1;
        if before < 0.0 && now >= 0.0 {
            crossings.push(world.time_ns() as f64 / 1e9);
        }
        before = now;
    }
    let period = (crossings[3] - crossings[0]) / 3.0;
    // 2 pi sqrt(1.1 / 9.8) = 2.1051 s, and 1/16 of 0.01 rad² longer for the amplitude.
    assert!((period - 2.1051 * (1.0 + 0.01 / 16.0)).abs() < 0.003, "{period}");
}

#[test]
fn holding_a_pendulum_out_takes_its_weight_times_its_arm() {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    put(&mut world, &pendulum(DVec3::X), Pose::IDENTITY);
    let hinge = find_joint(&world, "pendulum", "hinge");
    let hold = JointCommand::Position { target: 0.0, max_speed: 1.0, max_effort: 100.0 };
    assert!(world.command(hinge, hold));
    run(&mut world, 1.0);
    let held = world.axis_state(hinge).unwrap();
    assert!(held.position.abs() < 1e-3 && (held.effort + 9.8).abs() < 0.05, "{held:?}");
    // With less it falls.
    world.command(hinge, JointCommand::Position { target: 0.0, max_speed: 1.0, max_effort: 5.0 });
    run(&mut world, 0.5);
    assert!(world.axis_state(hinge).unwrap().position > 0.3);
}

fn slider(axis: Axis) -> (PhysicsWorld, periplus_physics::JointId) {
    let mut world = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Rigid);
    let axis = Axis { direction_in_joint: DVec3::X, ..axis };
    let slide = joint("slide", JointKind::Prismatic, "world", "cart", axis);
    put(
        &mut world,
        &model("cart", vec![solid_box("cart", 2.0, DVec3::ONE)], vec![slide]),
        Pose::IDENTITY,
    );
    let slide = find_joint(&world, "cart", "slide");
    (world, slide)
}

#[test]
fn a_slide_ends_at_its_limits() {
    let (mut world, slide) = slider(Axis { lower: -0.1, upper: 0.3, ..Axis::default() });
    for (apply_force, end) in [(10.0, 0.3), (-10.0, -0.1)] {
        world.command(slide, JointCommand::Effort(apply_force));
        run(&mut world, 1.5);
        let state = world.axis_state(slide).unwrap();
        assert!((state.position - end).abs() < 2e-4 && state.velocity.abs() < 1e-3, "{state:?}");
    }
}

#[test]
fn an_effort_is_mass_times_acceleration() {
    let (mut world, slide) = slider(Axis::default());
    world.command(slide, JointCommand::Effort(4.0));
    run(&mut world, 1.0);
    // 4 N on 2 kg: 2 m/s and 1 m after a second.
    let state = world.axis_state(slide).unwrap();
    assert!(
        (state.velocity - 2.0).abs() < 1e-6 && (state.position - 1.0).abs() < 2e-3,
        "{state:?}"
    );
    assert_eq!(state.effort, 4.0);
    world.command(slide, JointCommand::Free);
    run(&mut world, 1.0);
    assert!((world.axis_state(slide).unwrap().velocity - 2.0).abs() < 1e-6);
}

#[test]
fn damping_ends_at_force_by_coefficient() {
    let (mut world, slide) = slider(Axis { damping: 4.0, ..Axis::default() });
    world.command(slide, JointCommand::Effort(2.0));
    run(&mut world, 6.0);
    assert!((world.axis_state(slide).unwrap().velocity - 0.5).abs() < 1e-4);
}

#[test]
fn a_spring_rests_at_force_by_stiffness() {
    let axis =
        Axis { spring_stiffness: 100.0, spring_reference: 0.1, damping: 20.0, ..Axis::default() };
    let (mut world, slide) = slider(axis);
    world.command(slide, JointCommand::Effort(10.0));
    run(&mut world, 5.0);
    // 10 N / 100 N/m beyond 0.1 m.
    let position = world.axis_state(slide).unwrap().position;
    assert!((position - 0.2).abs() < 1e-4, "{position}");
}

#[test]
fn dry_friction_holds_up_to_its_force() {
    let (mut world, slide) = slider(Axis { friction: 3.0, ..Axis::default() });
    world.command(slide, JointCommand::Effort(2.9));
    run(&mut world, 1.0);
    assert!(world.axis_state(slide).unwrap().position < 1e-4);
    world.command(slide, JointCommand::Effort(5.0));
    run(&mut world, 1.0);
    // 2 N are left for 2 kg.
    assert!((world.axis_state(slide).unwrap().velocity - 1.0).abs() < 0.01);
}

/// A disc of 0.1 kg m² on an axle along z.
fn disc(axis: Axis, kind: JointKind) -> (PhysicsWorld, periplus_physics::JointId) {
    let mut world = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Rigid);
    let mut wheel = solid_ball("disc", 1.0, 0.5);
    wheel.collisions.clear();
    let axle = joint("axle", kind, "world", "disc", axis);
    put(&mut world, &model("disc", vec![wheel], vec![axle]), Pose::IDENTITY);
    let axle = find_joint(&world, "disc", "axle");
    (world, axle)
}

#[test]
fn a_motor_reaches_its_speed_as_fast_as_its_torque_allows() {
    let (mut world, axle) = disc(Axis::default(), JointKind::Continuous);
    world.command(axle, JointCommand::Velocity { target: 10.0, max_effort: 0.5 });
    run(&mut world, 1.0);
    // 0.5 N m on 0.1 kg m²: 5 rad/s after one second, 10 after two.
    assert!((world.axis_state(axle).unwrap().velocity - 5.0).abs() < 1e-3);
    run(&mut world, 1.5);
    assert!((world.axis_state(axle).unwrap().velocity - 10.0).abs() < 1e-6);
}

#[test]
fn a_joint_keeps_to_its_own_speed_and_effort() {
    let axis = Axis { velocity: 3.0, effort: 0.1, ..Axis::default() };
    let (mut world, axle) = disc(axis, JointKind::Continuous);
    world.command(axle, JointCommand::Velocity { target: 10.0, max_effort: f64::INFINITY });
    run(&mut world, 1.0);
    assert!((world.axis_state(axle).unwrap().velocity - 1.0).abs() < 1e-3);
    run(&mut world, 3.0);
    assert!((world.axis_state(axle).unwrap().velocity - 3.0).abs() < 1e-6);
}

#[test]
fn turns_are_counted() {
    let (mut world, axle) = disc(Axis::default(), JointKind::Continuous);
    let target = 6.0 * PI;
    world.command(axle, JointCommand::Position { target, max_speed: 10.0, max_effort: 100.0 });
    run(&mut world, 3.0);
    assert!((world.axis_state(axle).unwrap().position - target).abs() < 1e-6);
}

#[test]
fn turning_limits_hold_narrow_wide_and_beyond_a_turn() {
    for (lower, upper) in [(-0.5, 1.0), (0.0, 3.0), (-3.1, 3.1), (-7.0, 10.0)] {
        let axis = Axis { lower, upper, ..Axis::default() };
        let (mut world, axle) = disc(axis, JointKind::Revolute);
        for (apply_force, end) in [(0.5, upper), (-0.5, lower)] {
            world.command(axle, JointCommand::Effort(apply_force));
            run(&mut world, 4.0);
            let state = world.axis_state(axle).unwrap();
            assert!((state.position - end).abs() < 2e-3, "{lower} {upper}: {state:?}");
        }
    }
}

#[test]
fn a_follower_follows() {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    let finger = |name: &str, y: f64| at(0.0, y, 0.0, solid_box(name, 0.2, DVec3::splat(0.05)));
    let slide = |name: &str, child: &str, mimic| {
        joint(
            name,
            JointKind::Prismatic,
            "world",
            child,
            Axis { direction_in_joint: DVec3::Y, mimic, ..Axis::default() },
        )
    };
    let mimic = Mimic {
        joint: "one".into(),
        axis: "axis".into(),
        multiplier: -2.0,
        offset: 0.01,
        reference: 0.0,
    };
    let hand = model(
        "hand",
        vec![finger("a", 0.5), finger("b", -0.5)],
        vec![slide("one", "a", None), slide("two", "b", Some(mimic))],
    );
    put(&mut world, &hand, Pose::IDENTITY);
    let one = find_joint(&world, "hand", "one");
    world.command(one, JointCommand::Position { target: 0.2, max_speed: 1.0, max_effort: 10.0 });
    run(&mut world, 2.0);
    let two = world.axis_state(find_joint(&world, "hand", "two")).unwrap();
    assert!((two.position + 0.39).abs() < 1e-4, "{two:?}");
}

#[test]
fn links_on_fixed_joints_are_one_body() {
    let mut world = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Rigid);
    let weld = Joint::new("weld", JointKind::Fixed, "a", "b");
    let bar = model(
        "bar",
        vec![solid_ball("a", 1.0, 0.1), at(2.0, 0.0, 0.0, solid_ball("b", 1.0, 0.1))],
        vec![weld],
    );
    put(&mut world, &bar, Pose::IDENTITY);
    // Pushed at one end across: the middle goes F/m, and it turns about z.
    let a = link(&world, "bar", "a");
    world.apply_force(a, DVec3::ZERO, DVec3::new(0.0, 2000.0, 0.0), DVec3::ZERO);
    run(&mut world, 0.001);
    let (a, b) = (state(&world, "bar", "a"), state(&world, "bar", "b"));
    // 2 N s on 2 kg: 1 m/s; 2 N m s on 2 kg m² (and 0.008 of the balls): -1 rad/s.
    assert!((a.angular_rad_s.z + 1.0).abs() < 0.01, "{a:?}");
    assert!((a.linear_m_s.y - 2.0).abs() < 0.01 && b.linear_m_s.y.abs() < 0.01, "{a:?} {b:?}");
    run(&mut world, 3.0);
    let between = state(&world, "bar", "a").world_from_link.inverse()
        * state(&world, "bar", "b").world_from_link;
    assert!(between.distance_to(Pose::from_xyz(2.0, 0.0, 0.0)).0 < 1e-12);
}

#[test]
fn a_ball_joint_lets_turn_and_holds_its_place() {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    let mut ball = Joint::new("ball", JointKind::Ball, "world", "bob");
    ball.child_from_joint = Pose::from_xyz(-1.0, 0.0, 0.0);
    put(
        &mut world,
        &model("bob", vec![at(1.0, 0.0, 0.0, solid_ball("bob", 1.0, 0.1))], vec![ball]),
        Pose::IDENTITY,
    );
    run(&mut world, 0.3);
    let at = state(&world, "bob", "bob").world_from_link.translation;
    assert!((at.length() - 1.0).abs() < 1e-3 && at.z < -0.3, "{at}");
}

#[test]
fn a_universal_joint_turns_about_both_axes_and_no_third() {
    let mut world = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Rigid);
    let mut cross = joint(
        "cross",
        JointKind::Universal,
        "world",
        "arm",
        Axis { direction_in_joint: DVec3::X, ..Axis::default() },
    );
    cross.axis2 = Some(Axis { direction_in_joint: DVec3::Y, ..Axis::default() });
    put(
        &mut world,
        &model("arm", vec![solid_box("arm", 1.0, DVec3::splat(0.5))], vec![cross]),
        Pose::IDENTITY,
    );
    let cross = find_joint(&world, "arm", "cross");
    for (axis, target) in [(0, 1.0), (1, 0.5)] {
        world.command_axis(
            cross,
            axis,
            JointCommand::Position { target, max_speed: 2.0, max_effort: 10.0 },
        );
    }
    run(&mut world, 2.0);
    let angles: Vec<f64> = world.joint_state(cross).iter().map(|axis| axis.position).collect();
    assert!((angles[0] - 1.0).abs() < 1e-3 && (angles[1] - 0.5).abs() < 1e-3, "{angles:?}");
    // First about x, then about the y that was turned with it.
    let (sx, cx) = libm::sincos(0.5);
    let (sy, cy) = libm::sincos(0.25);
    let expected = periplus_geometry::DQuat::from_xyzw(sx, 0.0, 0.0, cx)
        * periplus_geometry::DQuat::from_xyzw(0.0, sy, 0.0, cy);
    let found = state(&world, "arm", "arm").world_from_link;
    let radians = found.distance_to(Pose { translation: DVec3::ZERO, rotation: expected }).1;
    assert!(radians < 2e-3, "{radians}");
}

#[test]
fn a_quarter_turn_carries_the_link_along() {
    let mut world = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Rigid);
    put(&mut world, &pendulum(DVec3::X), Pose::IDENTITY);
    let hinge = find_joint(&world, "pendulum", "hinge");
    world.command(
        hinge,
        JointCommand::Position { target: FRAC_PI_2, max_speed: 5.0, max_effort: 1e3 },
    );
    run(&mut world, 2.0);
    // About y from x to -z.
    let at = state(&world, "pendulum", "bob").world_from_link.translation;
    assert!(at.distance(DVec3::NEG_Z) < 1e-3, "{at}");
}
