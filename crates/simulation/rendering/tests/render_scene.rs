//! Scenes with intersections in closed form.
#![allow(missing_docs, reason = "tests")]

use std::sync::Arc;

use periplus_diagnostics::Origin;
use periplus_meshes::Submesh;
use periplus_raycast::{Hit, Ray};
use periplus_rendering::{
    AddedModel, AssetLoader, NoAssets, PartId, RenderModelId, RenderScene, SensedGeometry, filter,
};
use periplus_scene::{
    Collision, Colour, DVec3, Element, Link, Material, MeshShape, Model, Plugin, Pose, Shape,
    Visual,
};

/// A mesh reader whose only file is a triangle in the plane x = 0.
struct OneTriangle;

impl AssetLoader for OneTriangle {
    fn mesh(&self, mesh: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>> {
        let triangle = Submesh {
            name: "sail".into(),
            positions_m: vec![[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 1, 2]],
            ..Submesh::default()
        };
        let file = periplus_meshes::Mesh { submeshes: vec![triangle], ..Default::default() };
        (mesh.uri == "sail.stl").then(|| Arc::new(file))
    }
    fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
        None
    }
    fn texture(&self, _: &MeshShape, _: &str) -> Option<Arc<[u8]>> {
        None
    }
}

fn mesh(uri: &str) -> Shape {
    Shape::Mesh(MeshShape {
        uri: uri.into(),
        path: Some(uri.into()),
        submesh: None,
        center_submesh: false,
        scale: DVec3::new(1.0, 2.0, 1.0),
        extra: Vec::new(),
        origin: Origin::default(),
    })
}

/// A model of one link with a collision and a visual of one shape.
fn model(name: &str, shape: Shape) -> Model {
    let mut link = Link::new("link");
    link.collisions.push(Collision::new("touch", shape.clone()));
    link.visuals.push(Visual::new("sight", shape));
    let mut model = Model::new(name);
    model.links.push(link);
    model
}

fn with(geometry: SensedGeometry, model: &Model, x: f64) -> (RenderScene, AddedModel) {
    let mut scene = RenderScene::empty(geometry, 1);
    let parts = scene.add(model, Pose::from_xyz(x, 0.0, 0.0), &OneTriangle);
    (scene, parts)
}

fn material(scene: &RenderScene, origin: [f64; 3], towards: [f64; 3]) -> Option<Hit> {
    let ray = Ray::new(DVec3::from_array(origin), DVec3::from_array(towards).normalize());
    scene.rays().cast(&ray, filter(u32::MAX, None))
}

/// Distance to the first hit along x from the origin.
fn ahead(scene: &RenderScene) -> Option<f64> {
    material(scene, [0.0; 3], [1.0, 0.0, 0.0]).map(|hit| (hit.distance_m * 1e9).round() / 1e9)
}

#[test]
fn every_shape_stands_where_it_should() {
    let size_m = DVec3::new(1.0, 2.0, 4.0);
    let check = |shape, distance_m| {
        for geometry in [SensedGeometry::Collision, SensedGeometry::Visual] {
            for is_static in [false, true] {
                let mut model = model("it", Shape::clone(&shape));
                model.is_static = is_static;
                let (scene, parts) = with(geometry, &model, 3.0);
                assert!(parts.diagnostics.is_empty(), "{:?}", parts.diagnostics);
                assert_eq!(ahead(&scene), Some(distance_m), "{shape:?} {geometry:?}");
            }
        }
    };
    check(Shape::Box { size_m }, 2.5);
    check(Shape::Sphere { radius_m: 0.5 }, 2.5);
    check(Shape::Cylinder { radius_m: 0.5, length_m: 0.1 }, 2.5);
    check(Shape::Capsule { radius_m: 0.5, length_m: 0.1 }, 2.5);
    // Half way up it is half as wide.
    check(Shape::Cone { radius_m: 1.0, length_m: 1.0 }, 2.5);
    check(Shape::Ellipsoid { radii_m: size_m }, 2.0);
    check(mesh("sail.stl"), 3.0);
    check(Shape::Plane { normal: DVec3::NEG_X, size_m: [1.0, 1.0] }, 3.0);
    let points_m = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let outline = periplus_scene::Polyline { points_m, height_m: 1.0 };
    let (scene, _) =
        with(SensedGeometry::Visual, &model("it", Shape::Polylines(vec![outline])), 3.0);
    let hit = material(&scene, [0.0, 0.0, 0.5], [1.0, 0.0, 0.0]).unwrap();
    assert!((hit.distance_m - 2.0).abs() < 1e-6);
    // From z = 0 to its height, and closed above.
    let hit = material(&scene, [3.3, 0.2, 5.0], [0.0, 0.0, -1.0]).unwrap();
    assert!((hit.distance_m - 4.0).abs() < 1e-6);
}

#[test]
fn meshes_are_scaled() {
    let (scene, _) = with(SensedGeometry::Visual, &model("it", mesh("sail.stl")), 3.0);
    // The lower edge reaches from y = -2 to y = 2.
    assert!(material(&scene, [0.0, 1.9, -0.99], [1.0, 0.0, 0.0]).is_some());
    assert!(material(&scene, [0.0, 2.1, -0.99], [1.0, 0.0, 0.0]).is_none());
}

#[test]
fn a_plane_is_endless_to_touch_and_of_a_size_to_see() {
    let plane = Shape::Plane { normal: DVec3::Z, size_m: [2.0, 4.0] };
    let down = [0.0, 0.0, -1.0];
    for (geometry, x, y, seen) in [
        (SensedGeometry::Visual, 0.9, 1.9, true),
        (SensedGeometry::Visual, 1.1, 0.0, false),
        (SensedGeometry::Visual, 0.0, 2.1, false),
        (SensedGeometry::Collision, 1000.0, 1000.0, true),
    ] {
        let (scene, _) = with(geometry, &model("ground", plane.clone()), 0.0);
        assert_eq!(material(&scene, [x, y, 1.0], down).is_some(), seen, "{geometry:?} {x} {y}");
    }
}

#[test]
fn links_move_alone() {
    let mut robot = model("robot", Shape::Sphere { radius_m: 0.5 });
    let mut arm = robot.links[0].clone();
    arm.name = "arm".into();
    arm.model_from_link = Pose::from_xyz(5.0, 0.0, 0.0);
    robot.links.push(arm);
    let (mut scene, parts) = with(SensedGeometry::Collision, &robot, 3.0);
    assert_eq!(ahead(&scene), Some(2.5));
    scene.set_link_poses(&[(parts.parts[0], Pose::from_xyz(0.0, 9.0, 0.0))]);
    assert_eq!(ahead(&scene), Some(7.5));
    scene.set_link_poses(&[(parts.parts[1], Pose::from_xyz(f64::NAN, 0.0, 0.0))]);
    assert_eq!(ahead(&scene), Some(7.5));
    let hit = material(&scene, [0.0; 3], [1.0, 0.0, 0.0]).unwrap();
    assert_eq!(scene.surface(&hit).link, "arm");
}

#[test]
fn a_sensor_looks_past_its_own_model() {
    let mut robot = model("robot", Shape::Sphere { radius_m: 0.5 });
    // A housing that is a separate link.
    let mut housing = robot.links[0].clone();
    housing.name = "housing".into();
    robot.links.push(housing);
    let (scene, parts) = with(SensedGeometry::Collision, &robot, 0.0);
    let ray = Ray::new(DVec3::ZERO, DVec3::X);
    let past = filter(u32::MAX, Some(parts.model.group()));
    assert!(scene.rays().cast(&ray, filter(u32::MAX, None)).is_some());
    assert!(scene.rays().cast(&ray, past).is_none());
}

#[test]
fn models_come_and_go_and_numbers_stay() {
    let ball = |name: &str| model(name, Shape::Sphere { radius_m: 0.5 });
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    let mut wall = model("wall", mesh("sail.stl"));
    wall.is_static = true;
    scene.add(&wall, Pose::from_xyz(9.0, 0.0, 0.0), &OneTriangle);
    let near = scene.add(&ball("near"), Pose::from_xyz(3.0, 0.0, 0.0), &NoAssets);
    let far = scene.add(&ball("far"), Pose::from_xyz(6.0, 0.0, 0.0), &NoAssets);
    assert_eq!(ahead(&scene), Some(2.5));
    scene.remove(near.model);
    scene.remove(near.model);
    assert_eq!(ahead(&scene), Some(5.5));
    assert_eq!(scene.find_model("near"), None);
    assert_eq!(scene.parts(near.model).count(), 0);
    scene.set_link_poses(&[
        (far.parts[0], Pose::from_xyz(7.0, 0.0, 0.0)),
        (near.parts[0], Pose::IDENTITY),
    ]);
    assert_eq!(ahead(&scene), Some(6.5));
    scene.remove(far.model);
    assert_eq!(ahead(&scene), Some(9.0));
    let wall = scene.find_model("wall").unwrap();
    // A service may move what is static.
    let part = scene.parts(wall).next().unwrap();
    scene.set_link_poses(&[(part, Pose::from_xyz(8.0, 0.0, 0.0))]);
    assert_eq!(ahead(&scene), Some(8.0));
    scene.set_link_poses(&[(part, Pose::from_xyz(4.0, 0.0, 0.0))]);
    assert_eq!(ahead(&scene), Some(4.0));
    scene.remove(wall);
    assert_eq!(ahead(&scene), None);
}

#[test]
fn a_missing_mesh_is_told_and_the_rest_is_there() {
    let mut robot = model("robot", mesh("gone.stl"));
    robot.links[0].visuals.push(Visual::new("ball", Shape::Sphere { radius_m: 0.5 }));
    robot.links[0].visuals.push(Visual::new("flat", Shape::Sphere { radius_m: -1.0 }));
    robot.links[0].visuals.push(Visual::new("odd", Shape::Unknown(Element::new("teapot"))));
    let (scene, parts) = with(SensedGeometry::Visual, &robot, 3.0);
    let told: Vec<_> =
        parts.diagnostics.iter().map(|d| (d.severity.name(), d.code, d.message.as_str())).collect();
    assert_eq!(told.len(), 3, "{told:?}");
    assert_eq!(told[0].0, "warning");
    assert!(told[0].2.contains("link::sight") && told[0].2.contains("gone.stl"), "{told:?}");
    assert_eq!((told[1].0, told[1].1), ("error", "shape-impossible"));
    assert!(told[2].2.contains("<teapot>"), "{told:?}");
    assert_eq!(ahead(&scene), Some(2.5));
}

#[test]
fn surfaces_tell_colour_and_brightness() {
    let mut red = model("red", Shape::Sphere { radius_m: 0.5 });
    let visual = &mut red.links[0].visuals[0];
    visual.laser_retro = 2.0;
    visual.transparency = 0.25;
    visual.material =
        Some(Material { diffuse: Some(Colour([1.0, 0.0, 0.0, 1.0])), ..Material::default() });
    let (scene, _) = with(SensedGeometry::Visual, &red, 3.0);
    let hit = material(&scene, [0.0; 3], [1.0, 0.0, 0.0]).unwrap();
    let surface = scene.surface(&hit);
    assert_eq!((surface.model, surface.link, surface.name), ("red", "link", "sight"));
    assert_eq!(surface.colour, Colour([1.0, 0.0, 0.0, 0.75]));
    assert_eq!(surface.laser_retro, 2.0);
    assert_eq!((surface.label, surface.instance), (None, 0));
}

#[test]
fn masks_and_full_transparency_hide() {
    let mut ghost = model("ghost", Shape::Sphere { radius_m: 0.5 });
    ghost.links[0].visuals[0].visibility_flags = 0b10;
    let (scene, _) = with(SensedGeometry::Visual, &ghost, 3.0);
    let ray = Ray::new(DVec3::ZERO, DVec3::X);
    assert!(scene.rays().cast(&ray, filter(0b01, None)).is_none());
    assert!(scene.rays().cast(&ray, filter(0b11, None)).is_some());
    ghost.links[0].visuals[0].transparency = 1.0;
    assert_eq!(ahead(&with(SensedGeometry::Visual, &ghost, 3.0).0), None);
    assert_eq!(ahead(&with(SensedGeometry::Collision, &ghost, 3.0).0), Some(2.5));
}

fn label(text: &str) -> Plugin {
    let element = Element::new("label").with_text(text);
    Plugin {
        name: "gz::sim::systems::Label".into(),
        filename: "gz-sim-label-system".into(),
        content: vec![element],
        origin: Origin::default(),
    }
}

#[test]
fn labels_count_instances() {
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    let mut put = |x: f64, of_model: Option<&str>, of_visual: Option<&str>| {
        let mut ball = model("ball", Shape::Sphere { radius_m: 0.5 });
        let mut second = ball.links[0].visuals[0].clone();
        second.link_from_visual = Pose::from_xyz(0.0, 2.0, 0.0);
        second.plugins.extend(of_visual.map(label));
        ball.links[0].visuals.push(second);
        ball.plugins.extend(of_model.map(label));
        let parts = scene.add(&ball, Pose::from_xyz(x, 0.0, 0.0), &NoAssets);
        let at = |y: f64| {
            let hit = material(&scene, [x, y, 5.0], [0.0, 0.0, -1.0]).unwrap();
            let surface = scene.surface(&hit);
            (surface.label, surface.instance)
        };
        ([at(0.0), at(2.0)], parts.diagnostics.iter().count())
    };
    assert_eq!(put(0.0, None, None), ([(None, 0), (None, 0)], 0));
    // A model is one instance, whatever its visuals.
    assert_eq!(put(10.0, Some("10"), None), ([(Some(10), 1), (Some(10), 1)], 0));
    assert_eq!(put(20.0, Some("10"), Some("7")), ([(Some(10), 2), (Some(7), 1)], 0));
    assert_eq!(put(30.0, Some("300"), None), ([(None, 0), (None, 0)], 1));
}

#[test]
fn links_have_the_names_and_the_order_of_the_dynamics() {
    let named = |name: &str, links: &[&str]| {
        let mut model = Model::new(name);
        model.links.extend(links.iter().map(|name| Link::new(*name)));
        model
    };
    let mut outer = named("outer", &["a", "b"]);
    let mut first = named("first", &["c"]);
    first.models.push(named("inmost", &["d"]));
    outer.models.extend([first, named("second", &["e", "f"])]);
    let (scene, parts) = with(SensedGeometry::Visual, &outer, 0.0);
    let names: Vec<&str> = parts.parts.iter().filter_map(|&part| scene.part_name(part)).collect();
    // `periplus_physics` numbers them so.
    assert_eq!(names, ["a", "b", "first::c", "first::inmost::d", "second::e", "second::f"]);
    let model: RenderModelId = scene.find_model("outer").unwrap();
    let inmost: PartId = scene.find_part(model, "first::inmost::d").unwrap();
    assert_eq!(inmost, parts.parts[3]);
}
