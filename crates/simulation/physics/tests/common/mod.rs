//! Scenes for the tests, built in code.
#![allow(dead_code, clippy::unwrap_used, reason = "each test file uses a part; a test may panic")]

use periplus_physics::{
    AddOutcome, JointCommand, JointId, LinkId, LinkState, ModelId, NoMeshes, PhysicsMode,
    PhysicsWorld,
};
use periplus_scene::{
    Axis, Collision, DVec3, Inertial, Joint, JointKind, Link, Model, Pose, Shape,
};

pub(crate) const STEP_S: f64 = 0.001;
pub(crate) const STEP_NS: i64 = 1_000_000;
pub(crate) const DOWN: DVec3 = DVec3::new(0.0, 0.0, -9.8);

pub(crate) fn solid_box(name: &str, mass_kg: f64, size_m: DVec3) -> Link {
    let DVec3 { x, y, z } = size_m;
    let moment = |a: f64, b: f64| mass_kg * (a * a + b * b) / 12.0;
    let inertia_kg_m2 = [moment(y, z), 0.0, 0.0, moment(x, z), 0.0, moment(x, y)];
    Link {
        inertial: Inertial { mass_kg, inertia_kg_m2, ..Inertial::default() },
        collisions: vec![Collision::new("shape", Shape::Box { size_m })],
        ..Link::new(name)
    }
}

pub(crate) fn solid_ball(name: &str, mass_kg: f64, radius_m: f64) -> Link {
    let moment = 0.4 * mass_kg * radius_m * radius_m;
    let inertia_kg_m2 = [moment, 0.0, 0.0, moment, 0.0, moment];
    Link {
        inertial: Inertial { mass_kg, inertia_kg_m2, ..Inertial::default() },
        collisions: vec![Collision::new("shape", Shape::Sphere { radius_m })],
        ..Link::new(name)
    }
}

pub(crate) fn at(x: f64, y: f64, z: f64, link: Link) -> Link {
    Link { model_from_link: Pose::from_xyz(x, y, z), ..link }
}

pub(crate) fn model(name: &str, links: Vec<Link>, joints: Vec<Joint>) -> Model {
    Model { links, joints, ..Model::new(name) }
}

pub(crate) fn hinge(name: &str, parent: &str, child: &str, direction: DVec3) -> Joint {
    joint(
        name,
        JointKind::Revolute,
        parent,
        child,
        Axis { direction_in_joint: direction, ..Axis::default() },
    )
}

pub(crate) fn joint(name: &str, kind: JointKind, parent: &str, child: &str, axis: Axis) -> Joint {
    Joint { axis: Some(axis), ..Joint::new(name, kind, parent, child) }
}

pub(crate) fn ground() -> Model {
    let plane = Shape::Plane { normal: DVec3::Z, size_m: [100.0, 100.0] };
    let link = Link { collisions: vec![Collision::new("plane", plane)], ..Link::new("link") };
    Model { is_static: true, ..model("ground", vec![link], vec![]) }
}

pub(crate) fn flat_world() -> PhysicsWorld {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    put(&mut world, &ground(), Pose::IDENTITY);
    world
}

pub(crate) fn put(world: &mut PhysicsWorld, model: &Model, pose: Pose) -> ModelId {
    let AddOutcome { model, diagnostics } = world.add(model, pose, &NoMeshes);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    model.unwrap()
}

pub(crate) fn run(world: &mut PhysicsWorld, time_s: f64) {
    for _ in 0..(time_s / STEP_S).round() as usize {
        world.step(STEP_NS).unwrap();
    }
}

pub(crate) fn link(world: &PhysicsWorld, model: &str, link: &str) -> LinkId {
    world.find_link(world.find_model(model).unwrap(), link).unwrap()
}

pub(crate) fn state(world: &PhysicsWorld, model: &str, name: &str) -> LinkState {
    world.link_state(link(world, model, name)).unwrap()
}

pub(crate) fn find_joint(world: &PhysicsWorld, model: &str, name: &str) -> JointId {
    world.find_joint(world.find_model(model).unwrap(), name).unwrap()
}

/// Similar to `robots/sam_bot`, with round numbers: wheels of 0.1 m, 0.36 m apart.
pub(crate) fn two_wheels() -> Model {
    let mut base = solid_box("base", 15.0, DVec3::new(0.42, 0.31, 0.18));
    base.model_from_link = Pose::from_xyz(0.0, 0.0, 0.15);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = Pose {
        translation: DVec3::ZERO,
        rotation: periplus_geometry::DQuat::from_xyzw(half, 0.0, 0.0, half),
    };
    let wheel = |name: &str, side: f64| {
        let mut shape = Collision::new("tyre", Shape::Cylinder { radius_m: 0.1, length_m: 0.04 });
        shape.link_from_collision = turned;
        Link {
            model_from_link: Pose::from_xyz(-0.12, 0.18 * side, 0.1),
            // m r² / 2 about the axle, m (3 r² + w²) / 12 across.
            inertial: Inertial {
                mass_kg: 0.5,
                inertia_kg_m2: [0.00131667, 0.0, 0.0, 0.0025, 0.0, 0.00131667],
                ..Inertial::default()
            },
            collisions: vec![shape],
            ..Link::new(name)
        }
    };
    let mut caster = at(0.14, 0.0, 0.06, solid_ball("caster", 0.5, 0.06));
    caster.collisions[0].surface.friction.mu = 0.001;
    caster.collisions[0].surface.friction.mu2 = 0.001;
    let turning = |name: &str, child: &str| {
        joint(
            name,
            JointKind::Continuous,
            "base",
            child,
            Axis { direction_in_joint: DVec3::Y, ..Axis::default() },
        )
    };
    model(
        "robot",
        vec![base, wheel("left", 1.0), wheel("right", -1.0), caster],
        vec![
            turning("left_joint", "left"),
            turning("right_joint", "right"),
            Joint::new("caster_joint", JointKind::Fixed, "base", "caster"),
        ],
    )
}

pub(crate) struct Wheels {
    pub(crate) left: JointId,
    pub(crate) right: JointId,
}

impl Wheels {
    pub(crate) fn of(world: &PhysicsWorld) -> Self {
        Self {
            left: find_joint(world, "robot", "left_joint"),
            right: find_joint(world, "robot", "right_joint"),
        }
    }

    pub(crate) fn turn(&self, world: &mut PhysicsWorld, left: f64, right: f64) {
        for (joint, target) in [(self.left, left), (self.right, right)] {
            assert!(world.command(joint, JointCommand::Velocity { target, max_effort: 20.0 }));
        }
    }
}
