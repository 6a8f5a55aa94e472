//! A cart between two casters.

use periplus_geometry::DQuat;
use periplus_physics::{JointCommand, PhysicsWorld};
use periplus_scene::{Axis, DVec3, Inertial, Joint, JointKind, Link, Model, Pose, Shape};

use crate::common::{
    STEP_NS, at, find_joint, flat_world, joint, model, put, run, solid_ball, solid_box, state,
};

/// Commanded speed [m/s], reached with 1 m/s².
const SPEED_M_S: f64 = 0.3;
const DRIVE_S: f64 = 5.0;
/// Distance travelled by a cart whose wheels do not slip [m].
pub(crate) const FULL_M: f64 = SPEED_M_S * DRIVE_S - SPEED_M_S * SPEED_M_S / 2.0;

/// The deck and wheels of `robots/kbot`, the axle in the middle and a caster at either end, each
/// too low by `drop_m`; `scale` multiplies all masses.
pub(crate) fn cart(drop_m: f64, caster_mu: f64, scale: f64) -> Model {
    const RADIUS_M: f64 = 0.035;
    let mut deck = solid_box("deck", 2.5 * scale, DVec3::new(0.16, 0.16, 0.01));
    deck.model_from_link = Pose::from_xyz(0.0, 0.0, 0.04);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = DQuat::from_xyzw(half, 0.0, 0.0, half);
    let wheel = |name: &str, side: f64| {
        let mut wheel = at(0.0, 0.087 * side, RADIUS_M, solid_ball(name, 0.06 * scale, RADIUS_M));
        wheel.inertial = Inertial {
            mass_kg: 0.06 * scale,
            inertia_kg_m2: [1.85e-5, 0.0, 0.0, 3.675e-5, 0.0, 1.85e-5].map(|it| it * scale),
            ..Inertial::default()
        };
        wheel.collisions[0].shape = Shape::Cylinder { radius_m: RADIUS_M, length_m: 0.005 };
        wheel.collisions[0].link_from_collision =
            Pose { translation: DVec3::ZERO, rotation: turned };
        wheel
    };
    let caster = |name: &str, x: f64| {
        let mut caster = at(x, 0.0, 0.0175 - drop_m, solid_ball(name, 0.03 * scale, 0.0175));
        caster.collisions[0].surface.friction.mu = caster_mu;
        caster.collisions[0].surface.friction.mu2 = caster_mu;
        caster
    };
    let turning = |child: &str| {
        let axis = Axis { direction_in_joint: DVec3::Y, ..Axis::default() };
        joint(&format!("{child}_joint"), JointKind::Continuous, "deck", child, axis)
    };
    let fixed = |child: &str| Joint::new(format!("{child}_joint"), JointKind::Fixed, "deck", child);
    let links: Vec<Link> = vec![
        deck,
        wheel("left", 1.0),
        wheel("right", -1.0),
        caster("front", 0.052),
        caster("back", -0.052),
    ];
    let joints = vec![turning("left"), turning("right"), fixed("front"), fixed("back")];
    model("cart", links, joints)
}

/// Distance travelled by the cart [m] after one second at rest.
pub(crate) fn drive(cart: &Model, height_m: f64) -> f64 {
    let torque_n_m = 8.0 * cart.links[0].inertial.mass_kg;
    let mut world = flat_world();
    put(&mut world, cart, Pose::from_xyz(0.0, 0.0, height_m));
    let wheels = ["left_joint", "right_joint"].map(|name| find_joint(&world, "cart", name));
    let turn = |world: &mut PhysicsWorld, speed_m_s: f64| {
        for wheel in wheels {
            let target = speed_m_s / 0.035;
            assert!(
                world.command(wheel, JointCommand::Velocity { target, max_effort: torque_n_m })
            );
        }
    };
    turn(&mut world, 0.0);
    run(&mut world, 1.0);
    let start = state(&world, "cart", "deck").world_from_link.translation;
    for tick in 0..5000 {
        turn(&mut world, SPEED_M_S.min(f64::from(tick) * 1e-3));
        world.step(STEP_NS).unwrap();
    }
    let end = state(&world, "cart", "deck").world_from_link.translation;
    (end - start).x
}
