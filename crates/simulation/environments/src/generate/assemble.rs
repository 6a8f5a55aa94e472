//! Worlds from floor plans.

use periplus_diagnostics::Origin;
use periplus_geometry::{DQuat, DVec3, Pose, Pose2};
use periplus_scene::{
    Attenuation, Collision, Colour, Light, LightKind, Link, Material, Model, Physics, Shape,
    Visual, World,
};

use super::WorldGeneratorParams;
use super::plan::FloorPlan;

/// Margin of the floor beyond the walls \[m\].
const FLOOR_MARGIN_M: f64 = 5.0;
/// Colour of the floor.
const FLOOR_COLOUR: Colour = Colour([0.45, 0.45, 0.45, 1.0]);
/// Colour of walls and obstacles.
const WALL_COLOUR: Colour = Colour([0.7, 0.7, 0.65, 1.0]);

/// Returns the world of a floor plan.
pub(super) fn world(plan: &FloorPlan, params: &WorldGeneratorParams, name: &str) -> World {
    let mut world = World::empty(name);
    world.physics.push(Physics::default());
    world.lights.push(sun());
    let floor = Shape::Plane {
        normal: DVec3::Z,
        size_m: [params.size_x_m, params.size_y_m].map(|side| side + 2.0 * FLOOR_MARGIN_M),
    };
    world.models.push(static_model("ground_plane", vec![(Pose::IDENTITY, floor)], FLOOR_COLOUR));
    let boxes = plan.boxes.iter().map(|one| {
        let size_m = DVec3::new(one.size_m[0], one.size_m[1], one.height_m);
        let pose = Pose::from(Pose2::new(one.centre[0], one.centre[1], one.yaw_rad));
        (raised(pose, one.height_m), Shape::Box { size_m })
    });
    let cylinders = plan.cylinders.iter().map(|one| {
        let shape = Shape::Cylinder { radius_m: one.radius_m, length_m: one.height_m };
        (raised(Pose::from_xyz(one.centre[0], one.centre[1], 0.0), one.height_m), shape)
    });
    let shapes = boxes.chain(cylinders).collect();
    world.models.push(static_model("walls", shapes, WALL_COLOUR));
    world
}

/// Pose of a shape whose lower end is on the floor.
fn raised(pose: Pose, height_m: f64) -> Pose {
    Pose { translation: pose.translation + DVec3::Z * (height_m / 2.0), ..pose }
}

fn static_model(name: &str, shapes: Vec<(Pose, Shape)>, colour: Colour) -> Model {
    let mut link = Link::new("link");
    for (index, (pose, shape)) in shapes.into_iter().enumerate() {
        let name = format!("part_{index}");
        link.collisions.push(Collision {
            link_from_collision: pose,
            ..Collision::new(name.clone(), shape.clone())
        });
        let material =
            Material { ambient: Some(colour), diffuse: Some(colour), ..Material::default() };
        link.visuals.push(Visual {
            link_from_visual: pose,
            material: Some(material),
            ..Visual::new(name, shape)
        });
    }
    Model {
        is_static: true,
        canonical_link: Some("link".to_owned()),
        links: vec![link],
        ..Model::new(name)
    }
}

fn sun() -> Light {
    Light {
        name: "sun".to_owned(),
        parent_from_light: Pose { translation: DVec3::Z * 10.0, rotation: DQuat::IDENTITY },
        kind: LightKind::Directional,
        direction_in_light: DVec3::new(-0.5, 0.1, -0.9),
        is_on: true,
        visualize: true,
        cast_shadows: true,
        intensity: 1.0,
        diffuse: Colour([0.8, 0.8, 0.8, 1.0]),
        specular: Colour([0.2, 0.2, 0.2, 1.0]),
        attenuation: Attenuation { range_m: 1000.0, constant: 0.9, linear: 0.01, quadratic: 0.001 },
        extra: Vec::new(),
        origin: Origin::default(),
    }
}
