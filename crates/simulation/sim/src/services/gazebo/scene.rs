//! Conversion of the world to Gazebo messages.

use periplus_geometry::{DVec3, Pose};
use periplus_gz_msgs as gz;
use periplus_gz_msgs::{
    BoxGeom, CapsuleGeom, Color, ConeGeom, CylinderGeom, EllipsoidGeom, Geometry, GeometryKind,
    Header, LightKind, MeshGeom, PlaneGeom, PoseV, Quaternion, Scene, SphereGeom, Time, Vector2d,
    Vector3d,
};
use periplus_scene::{Colour, Light, Link, Material, Model, Shape, Visual};

use crate::Simulation;
use crate::simulation::RunningModel;

/// Id of the first entity; the world has the id before it, entities count in the order of the world.
const FIRST_ENTITY_ID: u32 = 2;

/// Counter of entity ids, in one order for all messages.
struct Numbers(u32);

impl Numbers {
    fn next(&mut self) -> u32 {
        let number = self.0;
        self.0 += 1;
        number
    }
}

fn vector(vector: DVec3) -> Option<Vector3d> {
    Some(Vector3d::new(vector.x, vector.y, vector.z))
}

fn pose(pose: Pose) -> gz::Pose {
    let turned = pose.rotation;
    gz::Pose {
        position: vector(pose.translation),
        orientation: Some(Quaternion::new(turned.x, turned.y, turned.z, turned.w)),
        ..gz::Pose::default()
    }
}

#[expect(clippy::cast_possible_truncation, reason = "messages carry colours in single precision")]
fn colour(Colour([r, g, b, a]): Colour) -> Option<Color> {
    Some(Color { header: None, r: r as f32, g: g as f32, b: b as f32, a: a as f32 })
}

fn header(simulation: &Simulation) -> Option<Header> {
    let stamp = Some(Time::of_ns(simulation.time_ns()));
    Some(Header { stamp, data: Vec::new() })
}

/// Returns the poses of models and their links.
pub(super) fn poses(simulation: &Simulation) -> PoseV {
    let mut numbers = Numbers(FIRST_ENTITY_ID);
    let mut all = Vec::new();
    let motion = simulation.motion();
    for running in &simulation.running {
        let id = numbers.next();
        let Some(world_from_model) = motion.model_pose(running.model) else { continue };
        let name = running.member.name.clone();
        all.push(gz::Pose { name, id, ..pose(world_from_model) });
        let model_from_world = world_from_model.inverse();
        for link in motion.links(running.model) {
            let id = numbers.next();
            let (Some(name), Some(state)) = (motion.link_name(link), motion.link_state(link))
            else {
                continue;
            };
            let name = name.to_owned();
            let model_from_link = model_from_world * state.world_from_link;
            all.push(gz::Pose { name, id, ..pose(model_from_link) });
        }
    }
    PoseV { header: header(simulation), pose: all }
}

/// Returns the name of the model with this id.
pub(super) fn name_of(simulation: &Simulation, id: u32) -> Option<String> {
    let mut numbers = Numbers(FIRST_ENTITY_ID);
    for running in &simulation.running {
        let own = numbers.next();
        if own == id {
            return Some(running.member.name.clone());
        }
        simulation.motion().links(running.model).for_each(|_| _ = numbers.next());
    }
    None
}

/// Returns the whole scene.
pub(super) fn scene(simulation: &Simulation) -> Scene {
    let world = &simulation.scene;
    let mut numbers = Numbers(FIRST_ENTITY_ID);
    let model = simulation.running.iter().map(|it| running(simulation, it, &mut numbers)).collect();
    let light = world.lights.iter().map(|light| self::light(light, numbers.next(), 1)).collect();
    Scene {
        header: header(simulation),
        name: world.name.clone(),
        ambient: colour(world.ambient),
        background: colour(world.background),
        shadows: world.shadows,
        grid: world.grid,
        model,
        light,
        ..Scene::default()
    }
}

fn running(simulation: &Simulation, running: &RunningModel, numbers: &mut Numbers) -> gz::Model {
    let motion = simulation.motion();
    let id = numbers.next();
    let world_from_model = motion.model_pose(running.model).unwrap_or_default();
    let model_from_world = world_from_model.inverse();
    let mut made = model(
        &running.member.model,
        numbers,
        Some(&|name| {
            let link = motion.find_link(running.model, name)?;
            Some(model_from_world * motion.link_state(link)?.world_from_link)
        }),
    );
    made.name.clone_from(&running.member.name);
    made.id = id;
    made.pose = Some(pose(world_from_model));
    made
}

/// Lookup of a link's current pose in its model.
type Now<'a> = &'a dyn Fn(&str) -> Option<Pose>;

/// Converts a model; nested models keep their initial poses.
fn model(model: &Model, numbers: &mut Numbers, now: Option<Now<'_>>) -> gz::Model {
    let links = model.links.iter().map(|one| {
        let model_from_link = now.and_then(|now| now(&one.name)).unwrap_or(one.model_from_link);
        link(one, model_from_link, numbers.next())
    });
    gz::Model {
        name: model.name.clone(),
        is_static: model.is_static,
        pose: Some(pose(model.parent_from_model)),
        link: links.collect(),
        self_collide: model.self_collide,
        model: inner(model),
        ..gz::Model::default()
    }
}

/// Returns the nested models, flattened: they can be nested deeper than the call stack allows.
fn inner(outer: &Model) -> Vec<gz::Model> {
    let mut open: Vec<(String, Pose, &Model)> = Vec::new();
    open.extend(outer.models.iter().map(|one| (one.name.clone(), one.parent_from_model, one)));
    let mut made = Vec::new();
    while let Some((name, outer_from_model, one)) = open.pop() {
        open.extend(one.models.iter().map(|deeper| {
            let scoped = format!("{name}::{}", deeper.name);
            (scoped, outer_from_model * deeper.parent_from_model, deeper)
        }));
        let link = one.links.iter().map(|it| link(it, it.model_from_link, 0)).collect();
        let (pose, is_static) = (Some(pose(outer_from_model)), one.is_static);
        made.push(gz::Model { name, pose, is_static, link, ..gz::Model::default() });
    }
    made
}

fn link(link: &Link, model_from_link: Pose, id: u32) -> gz::Link {
    gz::Link {
        id,
        name: link.name.clone(),
        self_collide: link.self_collide,
        gravity: link.gravity,
        kinematic: link.kinematic,
        enabled: true,
        pose: Some(pose(model_from_link)),
        visual: link.visuals.iter().map(|it| visual(it, &link.name, id)).collect(),
        light: link.lights.iter().map(|it| light(it, 0, id)).collect(),
        ..gz::Link::default()
    }
}

fn visual(visual: &Visual, parent_name: &str, parent_id: u32) -> gz::Visual {
    gz::Visual {
        name: visual.name.clone(),
        parent_name: parent_name.to_owned(),
        parent_id,
        transparency: visual.transparency,
        pose: Some(pose(visual.link_from_visual)),
        geometry: geometry(&visual.shape),
        material: visual.material.as_ref().map(material),
        visible: true,
        ..gz::Visual::default()
    }
}

fn material(material: &Material) -> gz::Material {
    gz::Material {
        ambient: material.ambient.and_then(colour),
        diffuse: material.diffuse.and_then(colour),
        specular: material.specular.and_then(colour),
        emissive: material.emissive.and_then(colour),
        lighting: material.lighting.unwrap_or(true),
        double_sided: material.double_sided,
        ..gz::Material::default()
    }
}

/// Returns `None` for shapes with vertices in other files.
fn geometry(shape: &Shape) -> Option<Geometry> {
    let blank = |r#type| Geometry { r#type, ..Geometry::default() };
    Some(match shape {
        Shape::Box { size_m } => Geometry {
            r#box: Some(BoxGeom { header: None, size: vector(*size_m) }),
            ..blank(GeometryKind::BOX)
        },
        Shape::Cylinder { radius_m: radius, length_m: length } => Geometry {
            cylinder: Some(CylinderGeom { header: None, radius: *radius, length: *length }),
            ..blank(GeometryKind::CYLINDER)
        },
        Shape::Sphere { radius_m } => Geometry {
            sphere: Some(SphereGeom { header: None, radius: *radius_m }),
            ..blank(GeometryKind::SPHERE)
        },
        Shape::Capsule { radius_m: radius, length_m: length } => Geometry {
            capsule: Some(CapsuleGeom { header: None, radius: *radius, length: *length }),
            ..blank(GeometryKind::CAPSULE)
        },
        Shape::Cone { radius_m: radius, length_m: length } => Geometry {
            cone: Some(ConeGeom { header: None, radius: *radius, length: *length }),
            ..blank(GeometryKind::CONE)
        },
        Shape::Ellipsoid { radii_m } => Geometry {
            ellipsoid: Some(EllipsoidGeom { header: None, radii: vector(*radii_m) }),
            ..blank(GeometryKind::ELLIPSOID)
        },
        Shape::Plane { normal, size_m: [x, y] } => Geometry {
            plane: Some(PlaneGeom {
                normal: vector(*normal),
                size: Some(Vector2d { header: None, x: *x, y: *y }),
                ..PlaneGeom::default()
            }),
            ..blank(GeometryKind::PLANE)
        },
        Shape::Mesh(mesh) => Geometry {
            mesh: Some(MeshGeom {
                header: None,
                filename: mesh.uri.clone(),
                scale: vector(mesh.scale),
                submesh: mesh.submesh.clone().unwrap_or_default(),
                center_submesh: mesh.center_submesh,
            }),
            ..blank(GeometryKind::MESH)
        },
        Shape::Empty => blank(GeometryKind::EMPTY),
        _ => return None,
    })
}

#[expect(clippy::cast_possible_truncation, reason = "messages carry lights in single precision")]
fn light(light: &Light, id: u32, parent_id: u32) -> gz::Light {
    use periplus_scene::LightKind as Kind;
    let spot = match &light.kind {
        Kind::Spot(spot) => Some(*spot),
        Kind::Point | Kind::Directional => None,
    };
    gz::Light {
        name: light.name.clone(),
        r#type: match &light.kind {
            Kind::Point => LightKind::POINT,
            Kind::Spot(_) => LightKind::SPOT,
            Kind::Directional => LightKind::DIRECTIONAL,
        },
        pose: Some(pose(light.parent_from_light)),
        diffuse: colour(light.diffuse),
        specular: colour(light.specular),
        attenuation_constant: light.attenuation.constant as f32,
        attenuation_linear: light.attenuation.linear as f32,
        attenuation_quadratic: light.attenuation.quadratic as f32,
        direction: vector(light.direction_in_light),
        range: light.attenuation.range_m as f32,
        cast_shadows: light.cast_shadows,
        spot_inner_angle: spot.map_or(0.0, |spot| spot.inner_angle_rad as f32),
        spot_outer_angle: spot.map_or(0.0, |spot| spot.outer_angle_rad as f32),
        spot_falloff: spot.map_or(0.0, |spot| spot.falloff as f32),
        id,
        parent_id,
        intensity: light.intensity as f32,
        is_light_off: !light.is_on,
        ..gz::Light::default()
    }
}
