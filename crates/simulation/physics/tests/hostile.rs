//! Invalid and extreme scenes.
#![allow(missing_docs, reason = "tests")]

mod common;

use common::*;
use periplus_diagnostics::{Origin, Severity, SourceMap};
use periplus_physics::{NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_scene::{Axis, DVec3, Friction, Inertial, Joint, JointKind, Link, Model, Pose, Shape};
use proptest::prelude::*;

/// Adds a model; returns true if it was accepted, and the codes of the findings.
fn check(model: &Model) -> (bool, Vec<&'static str>) {
    let mut world = flat_world();
    let added = world.add(model, Pose::from_xyz(0.0, 0.0, 1.0), &NoMeshes);
    for _ in 0..20 {
        let _ = world.step(STEP_NS);
    }
    let taken = added.model.is_some();
    (taken, added.diagnostics.iter().map(|found| found.code).collect())
}

fn heavy(mass_kg: f64) -> Link {
    Link { inertial: Inertial { mass_kg, ..Inertial::default() }, ..solid_ball("a", 1.0, 0.1) }
}

#[test]
fn no_mass_is_refused_where_it_is_written() {
    let mut sources = SourceMap::new();
    let file = sources.add("robot.sdf", "<link name='a'/>");
    let link = Link { origin: Origin(Some(sources.whole(file))), ..heavy(0.0) };
    let mut world = flat_world();
    let added = world.add(&model("m", vec![link], vec![]), Pose::IDENTITY, &NoMeshes);
    assert_eq!(added.model, None);
    let found = added.diagnostics.iter().next().unwrap();
    assert_eq!((found.severity, found.code), (Severity::Error, "no-mass"));
    assert_eq!(found.span, Some(sources.whole(file)));
    // The world goes on without it.
    run(&mut world, 0.01);
    assert_eq!(world.find_model("m"), None);
}

#[test]
fn a_frame_without_mass_on_a_link_with_mass_is_no_error() {
    let footprint = Joint::new("fixed", JointKind::Fixed, "footprint", "base");
    let robot = model(
        "m",
        vec![
            Link { name: "footprint".into(), ..heavy(0.0) },
            Link { name: "base".into(), ..heavy(2.0) },
        ],
        vec![footprint],
    );
    assert_eq!(check(&robot), (true, vec![]));
}

#[test]
fn numbers_that_are_none() {
    assert_eq!(
        check(&model("m", vec![heavy(f64::NAN)], vec![])),
        (false, vec!["inertia-out-of-range"])
    );
    assert_eq!(
        check(&model("m", vec![heavy(f64::INFINITY)], vec![])),
        (false, vec!["inertia-out-of-range"])
    );
    let lost = at(f64::NAN, 0.0, 0.0, solid_ball("a", 1.0, 0.1));
    assert_eq!(check(&model("m", vec![lost], vec![])), (false, vec!["pose-out-of-range"]));
    let mut sick = solid_ball("a", 1.0, 0.1);
    sick.collisions[0].shape = Shape::Sphere { radius_m: f64::NAN };
    assert_eq!(check(&model("m", vec![sick], vec![])), (true, vec!["shape-impossible"]));
    let axis = Axis { damping: f64::NAN, ..Axis::default() };
    let links = || vec![solid_ball("a", 1.0, 0.1), solid_ball("b", 1.0, 0.1)];
    let shaky = joint("j", JointKind::Revolute, "a", "b", axis);
    assert_eq!(check(&model("m", links(), vec![shaky])), (false, vec!["joint-impossible"]));
    let nowhere = hinge("j", "a", "b", DVec3::ZERO);
    assert_eq!(check(&model("m", links(), vec![nowhere])), (false, vec!["joint-impossible"]));
}

#[test]
fn inertia_of_nothing_is_told_and_replaced() {
    let mut point = solid_ball("a", 1.0, 0.1);
    point.inertial.inertia_kg_m2 = [0.0; 6];
    assert_eq!(check(&model("m", vec![point], vec![])), (true, vec!["no-inertia"]));
}

#[test]
fn a_joint_to_nobody() {
    let links = vec![solid_ball("base", 1.0, 0.1)];
    let joints = vec![Joint::new("j", JointKind::Fixed, "bace", "base")];
    let (taken, codes) = check(&model("m", links, joints));
    assert_eq!((taken, codes), (true, vec!["joint-end-unknown"]));
}

#[test]
fn a_mountain_on_a_needle_is_worth_a_warning() {
    let links =
        vec![solid_ball("needle", 0.001, 0.1), at(0.0, 0.0, 0.5, solid_ball("mountain", 1e6, 0.1))];
    let joints = vec![hinge("j", "needle", "mountain", DVec3::Y)];
    assert_eq!(check(&model("m", links, joints)), (true, vec!["steep-masses"]));
}

#[test]
fn shapes_that_nothing_can_touch_are_told() {
    let mut plane = solid_ball("a", 1.0, 0.1);
    plane.collisions[0].shape = Shape::Plane { normal: DVec3::Z, size_m: [1.0, 1.0] };
    assert_eq!(check(&model("m", vec![plane], vec![])), (true, vec!["shape-not-simulated"]));
    let mut flat = solid_ball("a", 1.0, 0.1);
    flat.collisions[0].shape = Shape::Box { size_m: DVec3::new(1.0, 1.0, 0.0) };
    assert_eq!(check(&model("m", vec![flat], vec![])), (true, vec!["shape-impossible"]));
}

#[test]
fn joints_in_a_circle_hold_without_a_panic() {
    let links = vec![solid_ball("a", 1.0, 0.1), at(1.0, 0.0, 0.0, solid_ball("b", 1.0, 0.1))];
    let joints = vec![
        Joint::new("one", JointKind::Fixed, "a", "b"),
        Joint::new("two", JointKind::Fixed, "b", "a"),
        hinge("three", "a", "b", DVec3::Z),
    ];
    assert_eq!(check(&model("m", links, joints)), (true, vec!["joint-inside-a-body"]));
}

#[test]
fn a_motion_that_is_none_is_told_with_the_bodys_name() {
    let mut world = flat_world();
    put(
        &mut world,
        &model("m", vec![solid_ball("rocket", 1.0, 0.1)], vec![]),
        Pose::from_xyz(0.0, 0.0, 1.0),
    );
    let rocket = link(&world, "m", "rocket");
    assert!(!world.apply_force(rocket, DVec3::ZERO, DVec3::splat(f64::NAN), DVec3::ZERO));
    world.apply_force(rocket, DVec3::Z, DVec3::new(0.0, 0.0, 1e9), DVec3::ZERO);
    let diverged = world.step(STEP_NS).unwrap_err();
    assert_eq!(diverged.link, "m::rocket");
    assert!(diverged.to_string().contains("`m::rocket` moves at "), "{diverged}");
    assert_eq!(world.step(STEP_NS), Err(diverged));
    world.reset();
    assert_eq!(world.step(STEP_NS), Ok(()));
}

#[test]
fn commands_that_are_none_are_refused() {
    use periplus_physics::JointCommand;
    let mut world = flat_world();
    put(&mut world, &two_wheels(), Pose::IDENTITY);
    let wheels = Wheels::of(&world);
    assert!(!world.command(wheels.left, JointCommand::Effort(f64::NAN)));
    assert!(
        !world.command(
            wheels.left,
            JointCommand::Velocity { target: f64::INFINITY, max_effort: 1.0 }
        )
    );
    let fixed = find_joint(&world, "robot", "caster_joint");
    assert!(!world.command(fixed, JointCommand::Effort(1.0)));
    assert_eq!(world.joint_state(fixed), vec![]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn whatever_the_numbers_nothing_panics(
        mass in prop_oneof![Just(0.0), Just(-1.0), Just(f64::NAN), Just(1e-30), Just(1e30), 0.1..10.0f64],
        moment in prop_oneof![Just(0.0), Just(-1.0), Just(1e-30), Just(1e30), 0.01..1.0f64],
        size in prop_oneof![Just(0.0), Just(-1.0), Just(1e-12), Just(1e12), 0.01..1.0f64],
        lower in prop_oneof![Just(f64::NAN), Just(1e16), Just(-1e300), -4.0..4.0f64],
        upper in prop_oneof![Just(f64::INFINITY), Just(-1e16), Just(f64::MIN_POSITIVE), -4.0..4.0f64],
        damping in prop_oneof![Just(-1.0), Just(1e300), 0.0..1.0f64],
        kind in 0..5usize,
    ) {
        let kind = [JointKind::Revolute, JointKind::Prismatic, JointKind::Ball, JointKind::Universal, JointKind::Planar][kind];
        let mut link = heavy(mass);
        link.inertial.inertia_kg_m2 = [moment, 0.1, 0.0, 1.0, 0.0, 1.0];
        link.collisions[0].shape = Shape::Cylinder { radius_m: size, length_m: 0.1 };
        let axis = Axis { lower, upper, damping, friction: damping, ..Axis::default() };
        let mut knuckle = joint("j", kind, "a", "b", axis.clone());
        knuckle.axis2 = Some(axis);
        check(&model("m", vec![link, at(0.0, 0.0, 0.5, solid_ball("b", 1.0, 0.1))], vec![knuckle]));
    }
}

#[test]
fn world_of_nan_gravity() {
    let world = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Rigid);
    assert_eq!(world.gravity_m_s2(), DVec3::ZERO);
}

#[test]
fn rough_ground_may_be_rougher_one_way() {
    let with = |is_static: bool, mu: f64, mu2: f64| {
        let mut link = heavy(1.0);
        link.collisions[0].surface.friction = Friction { mu, mu2, ..Friction::default() };
        check(&Model { is_static, ..model("m", vec![link], vec![]) }).1
    };
    // As nearly every world has it.
    assert_eq!(with(true, 100.0, 50.0), Vec::<&str>::new());
    assert_eq!(with(true, 100.0, 0.5), ["friction-one-direction"]);
    assert_eq!(with(false, 100.0, 50.0), ["friction-one-direction"]);
}

#[test]
fn absurd_numbers_are_refused_as_nan_is() {
    assert_eq!(
        check(&model("m", vec![heavy(1e308)], vec![])),
        (false, vec!["inertia-out-of-range"])
    );
    let mut spun = solid_ball("a", 1.0, 0.1);
    spun.inertial.inertia_kg_m2[0] = 1e300;
    assert_eq!(check(&model("m", vec![spun], vec![])), (false, vec!["inertia-out-of-range"]));
    let far = at(1e308, 0.0, 0.0, solid_ball("a", 1.0, 0.1));
    assert_eq!(check(&model("m", vec![far], vec![])), (false, vec!["pose-out-of-range"]));
    let mut huge = solid_ball("a", 1.0, 0.1);
    huge.collisions[0].shape = Shape::Sphere { radius_m: 1e200 };
    assert_eq!(check(&model("m", vec![huge], vec![])), (true, vec!["shape-impossible"]));

    let mut world = flat_world();
    let ball = model("ball", vec![solid_ball("a", 1.0, 0.1)], vec![]);
    let id = put(&mut world, &ball, Pose::from_xyz(0.0, 0.0, 1.0));
    let a = link(&world, "ball", "a");
    let beyond = DVec3::new(0.0, 1e308, 0.0);
    world.set_gravity(beyond);
    assert_eq!(world.gravity_m_s2(), DOWN);
    assert!(!world.set_pose(id, Pose::from_xyz(0.0, 1e308, 0.0)));
    assert!(!world.set_link_pose(a, Pose::from_xyz(1e300, 0.0, 0.0)));
    assert!(!world.set_model_velocity(id, beyond, DVec3::ZERO));
    assert!(!world.set_model_velocity(id, DVec3::ZERO, beyond));
    assert!(!world.apply_force(a, DVec3::Z, beyond, DVec3::ZERO));
    assert!(!world.apply_force(a, DVec3::Z, DVec3::ZERO, beyond));
    assert!(!world.apply_force(a, beyond, DVec3::Z, DVec3::ZERO));
    run(&mut world, 0.5);
}

#[test]
fn the_rest_goes_on_when_a_diverged_model_is_removed() {
    let mut world = flat_world();
    let at_height = |x: f64| Pose::from_xyz(x, 0.0, 0.1);
    let rocket = model("m", vec![solid_ball("rocket", 1.0, 0.1)], vec![]);
    let rocket = put(&mut world, &rocket, at_height(0.0));
    put(&mut world, &model("n", vec![solid_ball("ball", 1.0, 0.1)], vec![]), at_height(1.0));
    world.apply_force(
        link(&world, "m", "rocket"),
        DVec3::Z,
        DVec3::new(0.0, 0.0, 1e9),
        DVec3::ZERO,
    );
    let diverged = world.step(STEP_NS).unwrap_err();
    assert_eq!(diverged.model, Some(rocket));
    world.remove(rocket);
    run(&mut world, 0.5);
    assert!((state(&world, "n", "ball").world_from_link.translation.z - 0.1).abs() < 1e-3);
}
