//! Bodies with results in closed form.
#![allow(missing_docs, reason = "tests")]

mod common;

use common::*;
use periplus_physics::{NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_scene::{Collision, DVec3, Link, Pose, Shape};

#[test]
fn a_second_of_free_fall_is_4_9_metres() {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    put(&mut world, &model("stone", vec![solid_ball("ball", 1.0, 0.1)], vec![]), Pose::IDENTITY);
    run(&mut world, 1.0);
    let state = state(&world, "stone", "ball");
    // Semi-implicit Euler falls g t dt / 2 too far: 1.2 mm with four solver steps in 1 ms.
    let error = state.world_from_link.translation.z + 4.9;
    assert!(error.abs() < 0.0015, "{error}");
    assert!((state.linear_m_s.z + 9.8).abs() < 1e-9);
}

#[test]
fn a_box_at_rest_stays() {
    let mut world = flat_world();
    let stone = model("stone", vec![solid_box("box", 2.0, DVec3::splat(0.5))], vec![]);
    put(&mut world, &stone, Pose::from_xyz(0.0, 0.0, 0.25));
    run(&mut world, 1.0);
    let before = state(&world, "stone", "box").world_from_link;
    run(&mut world, 10.0);
    let (metres, radians) = state(&world, "stone", "box").world_from_link.distance_to(before);
    assert!(metres < 1e-6 && radians < 1e-6, "{metres} {radians}");
    assert!((before.translation.z - 0.25).abs() < 2e-4, "{before:?}");
}

#[test]
fn a_box_that_may_not_sleep_stays_too() {
    let mut world = flat_world();
    let mut stone = model("stone", vec![solid_box("box", 2.0, DVec3::splat(0.5))], vec![]);
    stone.allow_auto_disable = false;
    put(&mut world, &stone, Pose::from_xyz(0.0, 0.0, 0.25));
    run(&mut world, 1.0);
    let before = state(&world, "stone", "box").world_from_link;
    run(&mut world, 10.0);
    let (metres, radians) = state(&world, "stone", "box").world_from_link.distance_to(before);
    assert!(metres < 1e-6 && radians < 1e-6, "{metres} {radians}");
}

#[test]
fn a_ball_rolls_without_slipping() {
    let mut world = flat_world();
    put(
        &mut world,
        &model("ball", vec![solid_ball("ball", 1.0, 0.1)], vec![]),
        Pose::from_xyz(0.0, 0.0, 0.1),
    );
    let ball = world.find_model("ball").unwrap();
    world.set_model_velocity(ball, DVec3::X, DVec3::new(0.0, 10.0, 0.0));
    run(&mut world, 2.0);
    let state = state(&world, "ball", "ball");
    // 1 m/s is 10 rad/s on 0.1 m; 2 m in 2 s.
    assert!((state.world_from_link.translation.x - 2.0).abs() < 0.002, "{state:?}");
    assert!((state.angular_rad_s.y - 10.0).abs() < 0.02, "{state:?}");
}

#[test]
fn a_sliding_box_stops_after_v_squared_by_two_mu_g() {
    let mut world = flat_world();
    let mut stone = solid_box("box", 1.0, DVec3::new(0.4, 0.4, 0.1));
    // The smaller friction applies: 0.5 here, 1 of the floor.
    stone.collisions[0].surface.friction.mu = 0.5;
    stone.collisions[0].surface.friction.mu2 = 0.5;
    put(&mut world, &model("stone", vec![stone], vec![]), Pose::from_xyz(0.0, 0.0, 0.05));
    let stone = world.find_model("stone").unwrap();
    world.set_model_velocity(stone, DVec3::new(1.4, 0.0, 0.0), DVec3::ZERO);
    run(&mut world, 2.0);
    // 1.96 / (2 * 0.5 * 9.8) = 0.2 m.
    let x = state(&world, "stone", "box").world_from_link.translation.x;
    assert!((x - 0.2).abs() < 0.004, "{x}");
}

#[test]
fn masks_decide_who_touches() {
    let height = |mask: u32| {
        let mut world = flat_world();
        let mut stone = solid_box("box", 1.0, DVec3::splat(0.2));
        stone.collisions[0].surface.contact.collide_bitmask = mask;
        put(&mut world, &model("stone", vec![stone], vec![]), Pose::from_xyz(0.0, 0.0, 0.1));
        run(&mut world, 0.5);
        state(&world, "stone", "box").world_from_link.translation.z
    };
    assert!(height(0x1) > 0.09);
    // The floor has 0xffff: the body falls 1.2 m in half a second.
    assert!(height(0x10000) < -1.0);
}

#[test]
fn what_only_reports_contacts_falls_through_and_is_told() {
    let mut world = flat_world();
    let mut ghost = solid_box("box", 1.0, DVec3::splat(0.2));
    ghost.collisions[0].surface.contact.collide_without_contact = true;
    put(&mut world, &model("ghost", vec![ghost], vec![]), Pose::from_xyz(0.0, 0.0, 0.15));
    run(&mut world, 0.15);
    assert!(state(&world, "ghost", "box").world_from_link.translation.z < 0.06);
    assert!(world.contacts().iter().any(|contact| contact.force_n == 0.0));
}

#[test]
fn links_without_weight_float() {
    let mut world = PhysicsWorld::empty(DOWN, PhysicsMode::Rigid);
    let light = Link { gravity: false, ..solid_ball("balloon", 1.0, 0.1) };
    put(&mut world, &model("balloon", vec![light], vec![]), Pose::IDENTITY);
    run(&mut world, 1.0);
    assert_eq!(state(&world, "balloon", "balloon").world_from_link, Pose::IDENTITY);
}

#[test]
fn a_kinematic_body_moves_by_its_velocity_alone() {
    let mut world = flat_world();
    let belt = Link { kinematic: true, ..solid_box("belt", 1.0, DVec3::splat(1.0)) };
    put(&mut world, &model("belt", vec![belt], vec![]), Pose::from_xyz(0.0, 0.0, 3.0));
    let belt = world.find_model("belt").unwrap();
    world.set_model_velocity(belt, DVec3::X, DVec3::ZERO);
    run(&mut world, 1.0);
    let at = state(&world, "belt", "belt").world_from_link.translation;
    assert!(at.distance(DVec3::new(1.0, 0.0, 3.0)) < 1e-9, "{at}");
}

#[test]
fn the_weight_of_a_box_is_what_its_contact_pushes() {
    let mut world = flat_world();
    let mut stone = model("stone", vec![solid_box("box", 2.0, DVec3::splat(0.5))], vec![]);
    stone.allow_auto_disable = false;
    put(&mut world, &stone, Pose::from_xyz(0.0, 0.0, 0.25));
    run(&mut world, 2.0);
    let contacts = world.contacts();
    assert_eq!(contacts.len(), 1);
    let contact = &contacts[0];
    let names = [contact.one, contact.two].map(|end| world.link_name(end.link).unwrap());
    assert!(names == ["link", "box"] || names == ["box", "link"]);
    assert!(contact.normal.z.abs() > 0.999 && contact.points.len() == 4, "{contact:?}");
    assert!((contact.force_n - 19.6).abs() < 0.2, "{contact:?}");
}

#[test]
fn compound_links_and_every_convex_shape_stand() {
    let shapes = [
        (Shape::Cylinder { radius_m: 0.2, length_m: 0.4 }, 0.2),
        (Shape::Cone { radius_m: 0.2, length_m: 0.4 }, 0.2),
        (Shape::Capsule { radius_m: 0.1, length_m: 0.2 }, 0.2),
        (Shape::Ellipsoid { radii_m: DVec3::new(0.3, 0.3, 0.2) }, 0.2),
        (Shape::Sphere { radius_m: 0.2 }, 0.2),
    ];
    for (shape, height) in shapes {
        let mut world = flat_world();
        let mut link = solid_box("body", 1.0, DVec3::splat(0.3));
        // A wide foot keeps the capsule upright: two collisions on one link.
        let mut foot = Collision::new("foot", Shape::Box { size_m: DVec3::new(1.0, 1.0, 0.1) });
        foot.link_from_collision = Pose::from_xyz(0.0, 0.0, -height + 0.06);
        link.collisions = vec![Collision::new("shape", shape.clone()), foot];
        put(&mut world, &model("thing", vec![link], vec![]), Pose::from_xyz(0.0, 0.0, height));
        run(&mut world, 2.0);
        let pose = state(&world, "thing", "body").world_from_link;
        // The foot ends a centimetre above the floor: the shape itself touches it, or the rim of the foot.
        let z = pose.translation.z;
        assert!((height - 0.012..height + 0.001).contains(&z), "{shape:?} {pose:?}");
    }
}

#[test]
fn put_down_taken_away_and_put_back() {
    let mut world = flat_world();
    let id = put(
        &mut world,
        &model("stone", vec![solid_ball("ball", 1.0, 0.1)], vec![]),
        Pose::from_xyz(0.0, 0.0, 5.0),
    );
    run(&mut world, 0.1);
    assert!(world.set_pose(id, Pose::from_xyz(1.0, 2.0, 3.0)));
    assert_eq!(world.model_pose(id), Some(Pose::from_xyz(1.0, 2.0, 3.0)));
    assert!(!world.set_pose(id, Pose::from_xyz(f64::NAN, 0.0, 0.0)));
    world.reset();
    assert_eq!((world.time_ns(), world.model_pose(id)), (0, Some(Pose::from_xyz(0.0, 0.0, 5.0))));
    world.remove(id);
    assert_eq!((world.model_pose(id), world.find_model("stone")), (None, None));
    run(&mut world, 0.01);
    let again = world.add(
        &model("stone", vec![solid_ball("ball", 1.0, 0.1)], vec![]),
        Pose::IDENTITY,
        &NoMeshes,
    );
    assert_ne!(again.model, Some(id));
    world.reset();
    assert_eq!(world.model_pose(id), None);
}

#[test]
fn a_bounce_keeps_its_share_of_speed() {
    let height_after = |restitution: f64| {
        let mut world = PhysicsWorld::empty(DVec3::new(0.0, 0.0, -10.0), PhysicsMode::Rigid);
        let bouncy = |mut model: periplus_scene::Model| {
            let contact = &mut model.links[0].collisions[0].surface.contact;
            (contact.restitution, contact.bounce_threshold_m_s) = (restitution, 0.1);
            model
        };
        put(&mut world, &bouncy(ground()), Pose::IDENTITY);
        let ball = bouncy(model("ball", vec![solid_ball("ball", 1.0, 0.1)], vec![]));
        // 0.8 m above the floor: 4 m/s after 0.4 s.
        put(&mut world, &ball, Pose::from_xyz(0.0, 0.0, 0.9));
        run(&mut world, 0.6);
        state(&world, "ball", "ball").world_from_link.translation.z - 0.1
    };
    // Up again with 2 m/s, and 0.2 s later at the top, 0.2 m high.
    let height = height_after(0.5);
    assert!((height - 0.2).abs() < 0.01, "{height}");
    // What is not a number bounces nothing.
    assert!(height_after(f64::NAN).abs() < 0.002);
}
