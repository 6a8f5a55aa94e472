//! Robots of any mass, with inertias as files have them, stay at rest.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod common;

use common::{at, flat_world, joint, model, run, solid_ball, solid_box, state};
use periplus_geometry::DQuat;
use periplus_physics::NoMeshes;
use periplus_scene::{Axis, DVec3, JointKind, Model, Pose, Shape};

/// Moments of inertia of a body of a mass [kg].
type Inertia = fn(f64) -> [f64; 6];

/// A base of 20 cm between two rows of wheels of 2 cm radius; `ratio` is a wheel's mass over the
/// base's.
fn tracked(pairs: u32, mass_kg: f64, ratio: f64, base: Inertia, wheels: Inertia) -> Model {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let across = DQuat::from_xyzw(half, 0.0, 0.0, half);
    let mut body = at(0.0, 0.0, 0.05, solid_box("base", mass_kg, DVec3::new(0.2, 0.15, 0.05)));
    body.inertial.inertia_kg_m2 = base(mass_kg);
    let (mut links, mut joints) = (vec![body], Vec::new());
    for pair in 0..pairs {
        let x = -0.08 + 0.16 * f64::from(pair) / f64::from(pairs - 1);
        for side in [-1.0, 1.0] {
            let name = format!("wheel{pair}{side}");
            let mut wheel = at(x, 0.09 * side, 0.02, solid_ball(&name, mass_kg * ratio, 0.02));
            wheel.inertial.inertia_kg_m2 = wheels(mass_kg * ratio);
            wheel.collisions[0].shape = Shape::Cylinder { radius_m: 0.02, length_m: 0.02 };
            wheel.collisions[0].link_from_collision =
                Pose { translation: DVec3::ZERO, rotation: across };
            links.push(wheel);
            let axis = Axis { direction_in_joint: DVec3::Y, ..Axis::default() };
            let name_of_joint = format!("{name}_joint");
            joints.push(joint(&name_of_joint, JointKind::Continuous, "base", &name, axis));
        }
    }
    model("cart", links, joints)
}

fn round(mass_kg: f64, gyration_m: f64) -> [f64; 6] {
    let moment = mass_kg * gyration_m * gyration_m;
    [moment, 0.0, 0.0, moment, 0.0, moment]
}

/// Inertias of a base and its wheels.
const INERTIAS: [(&str, Inertia, Inertia); 6] = [
    ("right", |mass| round(mass, 0.06), |mass| round(mass, 0.012)),
    ("far too small", |mass| round(mass, 1e-4), |mass| round(mass, 1e-4)),
    ("none", |_| [0.0; 6], |_| [0.0; 6]),
    ("copied", |_| [1e-9, 0.0, 0.0, 1e-9, 0.0, 1e-9], |_| [1e-9, 0.0, 0.0, 1e-9, 0.0, 1e-9]),
    (
        "one moment beyond the others",
        |mass| [1e-6 * mass, 0.0, 0.0, 1e-6 * mass, 0.0, mass],
        |mass| [1e-6 * mass, 0.0, 0.0, 1e-3 * mass, 0.0, 1e-6 * mass],
    ),
    (
        "one moment beyond the others, along",
        |mass| [mass, 0.0, 0.0, 1e-6 * mass, 0.0, 1e-6 * mass],
        |mass| [1e-2 * mass, 0.0, 0.0, 1e-6 * mass, 0.0, 1e-6 * mass],
    ),
];

#[test]
fn robots_of_a_milligram_to_a_hundred_tonnes_stay_on_the_ground() {
    for (what, base, wheels) in INERTIAS {
        for (pairs, mass_kg, ratio) in
            [(2, 1e-6, 1.0), (4, 1e-3, 0.1), (8, 1e-3, 1.0), (4, 1.0, 10.0), (8, 1e5, 0.1)]
        {
            let mut world = flat_world();
            let cart = tracked(pairs, mass_kg, ratio, base, wheels);
            let added = world.add(&cart, Pose::IDENTITY, &NoMeshes);
            assert!(added.model.is_some(), "{what}: {:?}", added.diagnostics);
            for _ in 0..8 {
                run(&mut world, 0.1);
                let at = state(&world, "cart", "base").world_from_link.translation;
                let stays = (0.04..0.06).contains(&at.z) && at.truncate().length() < 0.01;
                assert!(stays, "{what}, {pairs} pairs, {mass_kg} kg, {ratio}: at {at}");
            }
        }
    }
}

#[test]
fn inertias_that_were_raised_are_told() {
    let codes = |(_, base, wheels): (&str, Inertia, Inertia)| -> Vec<&str> {
        let added =
            flat_world().add(&tracked(2, 1.0, 0.1, base, wheels), Pose::IDENTITY, &NoMeshes);
        added.diagnostics.iter().map(|found| found.code).collect()
    };
    assert_eq!(codes(INERTIAS[0]), Vec::<&str>::new());
    assert_eq!(codes(INERTIAS[1]), ["inertia-raised"; 5]);
    assert_eq!(codes(INERTIAS[2]), ["no-inertia"; 5]);
    assert!(codes(INERTIAS[4]).contains(&"inertia-raised"));
}
