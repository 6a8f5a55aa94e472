//! Screws, gearboxes, and joints between models, in both modes.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod common;

use std::f64::consts::TAU;
use std::path::Path;

use common::*;
use periplus_loader::{LoadContext, load_bytes};
use periplus_physics::{JointCommand, NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_resources::{MemoryHost, Resolver};
use periplus_scene::{Axis, DVec3, Element, Joint, JointKind, Model, Pose};

const MODES: [PhysicsMode; 2] = [PhysicsMode::Rigid, PhysicsMode::Kinematic];

fn x_axis() -> Axis {
    Axis { direction_in_joint: DVec3::X, ..Axis::default() }
}

#[test]
fn a_screw_slides_by_its_pitch_for_each_turn_and_carries_its_load() {
    for mode in MODES {
        let mut screw = joint("screw", JointKind::Screw, "world", "nut", Axis::default());
        screw.thread_pitch_m = Some(0.02);
        let nut = solid_box("nut", 2.0, DVec3::splat(0.1));
        let mut world = PhysicsWorld::empty(DOWN, mode);
        let id =
            put(&mut world, &model("m", vec![nut], vec![screw]), Pose::from_xyz(0.0, 0.0, 1.0));
        let screw = world.find_joint(id, "screw").unwrap();
        // Two turns a second for five seconds: 0.2 m up.
        world.command(screw, JointCommand::Velocity { target: 2.0 * TAU, max_effort: 1e3 });
        run(&mut world, 5.0);
        let up = state(&world, "m", "nut").world_from_link.translation.z - 1.0;
        let turned = world.axis_state(screw).unwrap().position;
        assert!((turned - 10.0 * TAU).abs() < 0.01 * turned, "{mode:?} {turned}");
        assert!((up - 0.02 * turned / TAU).abs() < 1e-3, "{mode:?} {up}");
        assert_eq!(world.joint_state(screw).len(), 2);
        world.command(screw, JointCommand::Velocity { target: 0.0, max_effort: 1e3 });
        run(&mut world, 2.0);
        let held = state(&world, "m", "nut").world_from_link.translation.z - 1.0;
        assert!((held - up).abs() < 2e-3, "{mode:?} {up} {held}");
    }
}

/// Two discs on a frame that is fixed to the world, the second geared to the first.
fn gears(ratio: &str, second: DVec3) -> Model {
    let mut box_ = Joint::new("gearbox", JointKind::Gearbox, "one", "two");
    box_.axis = Some(x_axis());
    box_.axis2 = Some(x_axis());
    box_.extra = vec![
        Element::new("gearbox_ratio").with_text(ratio),
        Element::new("gearbox_reference_body").with_text("frame"),
    ];
    let mut links = vec![solid_box("frame", 5.0, DVec3::splat(0.2))];
    for (name, y) in [("one", 0.5), ("two", -0.5)] {
        links.push(at(0.3, y, 0.0, solid_box(name, 1.0, DVec3::splat(0.2))));
    }
    let turning = |name: &str, child: &str, direction_in_joint: DVec3| {
        let axis = Axis { direction_in_joint, ..Axis::default() };
        joint(name, JointKind::Continuous, "frame", child, axis)
    };
    let hinges = vec![
        Joint::new("hold", JointKind::Fixed, "world", "frame"),
        turning("first", "one", DVec3::X),
        turning("second", "two", second),
        box_,
    ];
    model("m", links, hinges)
}

#[test]
fn a_gearbox_turns_the_second_by_its_ratio_the_other_way() {
    for mode in MODES {
        for (second, expected) in [(DVec3::X, -8.0), (DVec3::NEG_X, 8.0)] {
            let mut world = PhysicsWorld::empty(DVec3::ZERO, mode);
            put(&mut world, &gears("2", second), Pose::IDENTITY);
            let first = find_joint(&world, "m", "first");
            world.command(first, JointCommand::Velocity { target: 2.0, max_effort: 100.0 });
            run(&mut world, 2.0);
            let turned = world.axis_state(find_joint(&world, "m", "second")).unwrap().position;
            assert!((turned - expected).abs() < 0.1, "{mode:?} {second:?}: {turned}");
        }
    }
}

#[test]
fn a_gearbox_without_its_body_binds_nothing_and_says_so() {
    let mut broken = gears("2", DVec3::X);
    broken.joints[3].extra.pop();
    let added =
        PhysicsWorld::empty(DOWN, PhysicsMode::Rigid).add(&broken, Pose::IDENTITY, &NoMeshes);
    assert!(added.model.is_some());
    assert_eq!(added.diagnostics.iter().next().unwrap().code, "joint-not-simulated");
}

/// Two boxes, a metre apart, each a separate model.
fn two_boxes(joints: Vec<Joint>) -> periplus_scene::World {
    let stone = |name: &str, x: f64| Model {
        parent_from_model: Pose::from_xyz(x, 0.0, 2.0),
        ..model(name, vec![solid_box("link", 1.0, DVec3::splat(0.8))], vec![])
    };
    let host = MemoryHost::new();
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/w".into(),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let empty = b"<sdf version='1.11'><world name='w'/></sdf>";
    let loaded = load_bytes(Path::new("w.sdf"), empty, &setting);
    let world = loaded.scene.unwrap().worlds.remove(0);
    let models = vec![stone("a", 0.0), stone("b", 1.0)];
    periplus_scene::World { models, joints, gravity_m_s2: DOWN, ..world }
}

#[test]
fn joints_between_models_hold() {
    let hold = Joint::new("hold", JointKind::Fixed, "world", "a::link");
    let mut arm = joint("arm", JointKind::Revolute, "a::link", "b::link", Axis::default());
    arm.axis.as_mut().unwrap().direction_in_joint = DVec3::Y;
    arm.child_from_joint = Pose::from_xyz(-1.0, 0.0, 0.0);
    for mode in MODES {
        let scene = two_boxes(vec![hold.clone(), arm.clone()]);
        let (mut world, diagnostics) = PhysicsWorld::new(&scene, mode, &NoMeshes);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let joint = world.find_world_joint("arm").unwrap();
        world.command(joint, JointCommand::Velocity { target: 1.0, max_effort: 1e3 });
        run(&mut world, 1.0);
        let turned = world.axis_state(joint).unwrap().position;
        assert!((turned - 1.0).abs() < 0.05, "{mode:?} {turned}");
        // It hangs a metre out, turned about y.
        let b = state(&world, "b", "link").world_from_link.translation;
        let expected = DVec3::new(libm::cos(turned), 0.0, 2.0 - libm::sin(turned));
        assert!(b.distance(expected) < 5e-3, "{mode:?} {b:?} {expected:?}");
        let a = state(&world, "a", "link").world_from_link.translation;
        assert!(a.distance(DVec3::new(0.0, 0.0, 2.0)) < 1e-3, "{mode:?} {a:?}");
    }
}

#[test]
fn a_joint_to_a_model_that_is_not_there_is_an_error_and_the_rest_runs() {
    let wrong = Joint::new("hold", JointKind::Fixed, "world", "c::link");
    let (mut world, diagnostics) =
        PhysicsWorld::new(&two_boxes(vec![wrong]), PhysicsMode::Rigid, &NoMeshes);
    assert_eq!(diagnostics.iter().next().unwrap().code, "joint-end-unknown");
    run(&mut world, 0.1);
    assert_eq!(world.models().count(), 2);
}
