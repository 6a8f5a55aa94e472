//! Shapes from files and outlines: bodies rest on their surfaces.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod common;

use common::*;
use periplus_physics::{
    AddOutcome, Heights, Meshes, NoMeshes, PhysicsMode, PhysicsWorld, Triangles,
};
use periplus_scene::{
    Axis, Collision, DVec3, Heightmap, JointKind, Link, MeshShape, Model, Polyline, Pose, Shape,
};

/// A pyramid of 2 m by 2 m, 1 m high, on its base; and a slope that rises with x.
struct Files;

impl Meshes for Files {
    fn triangles(&self, _: &MeshShape) -> Option<Triangles> {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let points_m = vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
            DVec3::Z,
        ];
        let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]];
        Some(Triangles { points_m, triangles })
    }

    fn heights(&self, _: &Heightmap) -> Option<Heights> {
        // Five columns along x by three rows: 0, 0.1, ... 0.4 m high; the last row half a metre more.
        let row = |more: f64| (0..5).map(move |x| f64::from(x) * 0.1 + more);
        let heights_m = row(0.0).chain(row(0.0)).chain(row(0.5)).collect();
        Some(Heights { columns: 5, rows: 3, heights_m, size_m: [4.0, 8.0] })
    }
}

fn mesh() -> Shape {
    Shape::Mesh(MeshShape {
        uri: "pyramid.stl".into(),
        path: None,
        submesh: None,
        center_submesh: false,
        scale: DVec3::ONE,
        extra: Vec::new(),
        origin: Default::default(),
    })
}

fn fixed(shape: Shape) -> Model {
    let link = Link { collisions: vec![Collision::new("shape", shape)], ..Link::new("link") };
    Model { is_static: true, ..model("fixed", vec![link], vec![]) }
}

fn add(world: &mut PhysicsWorld, model: &Model, pose: Pose) {
    let AddOutcome { model, diagnostics } = world.add(model, pose, &Files);
    assert!(model.is_some() && diagnostics.is_empty(), "{diagnostics:?}");
}

/// Returns the rest height of a ball of 2 cm that slides down a plumb line onto a shape.
fn rest(shape: Shape, x: f64, y: f64) -> f64 {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    add(&mut world, &fixed(shape), Pose::IDENTITY);
    let plumb = joint("plumb", JointKind::Prismatic, "world", "ball", Axis::default());
    let ball = model("ball", vec![solid_ball("ball", 1.0, 0.02)], vec![plumb]);
    add(&mut world, &ball, Pose::from_xyz(x, y, 1.1));
    run(&mut world, 2.0);
    state(&world, "ball", "ball").world_from_link.translation.z - 0.02
}

#[test]
fn a_mesh_that_stands_is_its_triangles() {
    for (x, y, height) in [(0.5, 0.0, 0.5), (0.0, -0.25, 0.75), (0.25, 0.75, 0.25)] {
        let found = rest(mesh(), x, y);
        assert!((found - height).abs() < 0.02, "{found} instead of {height}");
    }
}

#[test]
fn a_mesh_that_moves_is_its_hull() {
    // The pyramid comes to rest on its base: its top is 1 m up, its frame at the floor.
    let mut pyramid = solid_box("link", 1.0, DVec3::ONE);
    pyramid.collisions[0].shape = mesh();
    let mut world = flat_world();
    add(&mut world, &model("pyramid", vec![pyramid], vec![]), Pose::from_xyz(0.0, 0.0, 0.3));
    run(&mut world, 2.0);
    let pose = state(&world, "pyramid", "link").world_from_link;
    assert!(pose.translation.z.abs() < 2e-3, "{pose:?}");
    // What falls on a corner of its box beside the slope meets the slope.
    let ball = model("ball", vec![solid_ball("ball", 0.1, 0.05)], vec![]);
    add(&mut world, &ball, Pose::from_xyz(0.8, 0.0, 0.9));
    run(&mut world, 0.35);
    let low = state(&world, "ball", "ball").world_from_link.translation.z;
    assert!(low < 0.6, "{low}");
}

#[test]
fn a_ground_is_as_high_as_its_heights_say() {
    let ground = || {
        Shape::Heightmap(Box::new(Heightmap {
            uri: "ground.png".into(),
            path: None,
            size_m: DVec3::new(4.0, 8.0, 1.0),
            position_m: DVec3::ZERO,
            sampling: 1,
            extra: Vec::new(),
            origin: Default::default(),
        }))
    };
    // Along x it rises by 0.1 m a metre from x = -2; the last row, at y = 4, is half a metre higher.
    for (x, y, height) in [(-1.0, -2.0, 0.1), (1.5, -3.0, 0.35), (0.0, 0.0, 0.2)] {
        let found = rest(ground(), x, y);
        assert!((found - height).abs() < 0.02, "{found} instead of {height}");
    }
}

#[test]
fn outlines_are_solid_and_their_holes_are_open() {
    let square = |size: f64| {
        let points_m = vec![[-size, -size], [size, -size], [size, size], [-size, size]];
        Polyline { points_m, height_m: 0.5 }
    };
    let frame = || Shape::Polylines(vec![square(1.0), square(0.5)]);
    assert!((rest(frame(), 0.75, 0.0) - 0.5).abs() < 2e-3);
    assert!((rest(frame(), -0.2, -0.75) - 0.5).abs() < 2e-3);
    // Through the hole it falls for two seconds.
    assert!(rest(frame(), 0.0, 0.0) < -10.0);
    // One that moves lies on the floor.
    let mut link = solid_box("link", 1.0, DVec3::new(2.0, 2.0, 0.5));
    link.collisions[0].shape = frame();
    let mut world = flat_world();
    add(&mut world, &model("frame", vec![link], vec![]), Pose::from_xyz(0.0, 0.0, 0.2));
    run(&mut world, 2.0);
    let pose = state(&world, "frame", "link").world_from_link;
    assert!(pose.translation.z.abs() < 2e-3, "{pose:?}");
}

#[test]
fn files_that_were_not_read_are_a_warning() {
    let added = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid).add(
        &fixed(mesh()),
        Pose::IDENTITY,
        &NoMeshes,
    );
    assert!(added.model.is_some());
    assert_eq!(added.diagnostics.iter().next().unwrap().code, "shape-not-simulated");
}
