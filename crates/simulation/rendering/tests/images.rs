//! Images whose pixels are known in closed form.
#![allow(missing_docs, reason = "tests")]

use periplus_rendering::{
    ImageOutputs, Lens, NoAssets, RenderRequest, RenderScene, RenderedImages, SensedGeometry,
};
use periplus_scene::{
    Attenuation, Camera, CameraKind, Colour, DVec3, Distortion, Element, Light, LightKind, Link,
    Material, Model, NoiseSpec, Origin, Pose, Shape, Visual,
};

const ALL: ImageOutputs = ImageOutputs { colour: true, depth: true, labels: true };

fn request(lens: &Lens, outputs: ImageOutputs, threads: usize) -> RenderRequest<'_> {
    RenderRequest {
        lens,
        world_from_camera: Pose::IDENTITY,
        near_m: 0.1,
        far_m: 100.0,
        visibility_mask: u32::MAX,
        own: None,
        outputs,
        threads,
    }
}

fn visual(shape: Shape, colour: [f64; 3]) -> Visual {
    let [r, g, b] = colour;
    let colour = Some(Colour([r, g, b, 1.0]));
    let mut visual = Visual::new("visual", shape);
    visual.material = Some(Material { ambient: colour, diffuse: colour, ..Material::default() });
    visual
}

fn put(scene: &mut RenderScene, visual: Visual, at: [f64; 3]) {
    let mut link = Link::new("link");
    link.visuals.push(visual);
    let mut model = Model::new("model");
    model.links.push(link);
    let [x, y, z] = at;
    let parts = scene.add(&model, Pose::from_xyz(x, y, z), &NoAssets);
    assert!(parts.diagnostics.is_empty());
}

fn lamp(kind: LightKind, at: [f64; 3]) -> Light {
    let [x, y, z] = at;
    Light {
        name: "lamp".into(),
        parent_from_light: Pose::from_xyz(x, y, z),
        kind,
        direction_in_light: DVec3::X,
        is_on: true,
        visualize: true,
        cast_shadows: true,
        intensity: 1.0,
        diffuse: Colour([0.5, 0.5, 0.5, 1.0]),
        specular: Colour::BLACK,
        attenuation: Attenuation { range_m: 100.0, constant: 1.0, linear: 0.0, quadratic: 0.0 },
        extra: Vec::new(),
        origin: Origin::default(),
    }
}

fn wall(size: f64) -> Shape {
    Shape::Box { size_m: DVec3::new(1.0, size, size) }
}

#[test]
fn depth_is_that_of_the_pinhole_formula() {
    let normal = DVec3::new(-0.8, 0.6, 0.0);
    let (middle, radius) = (DVec3::new(2.0, 0.1, -0.2), 0.3);
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    let plane = Shape::Plane { normal, size_m: [1000.0; 2] };
    put(&mut scene, visual(plane, [1.0; 3]), [3.0, 0.0, 0.0]);
    let ball = Shape::Sphere { radius_m: radius };
    put(&mut scene, visual(ball, [1.0; 3]), middle.to_array());
    let (width, height, fov) = (160_u32, 120_u32, 1.2_f64);
    let lens = Lens::pinhole(width, height, fov).unwrap();
    let mut picture = RenderedImages::default();
    scene.render(
        &request(&lens, ImageOutputs { depth: true, ..ImageOutputs::default() }, 1),
        &mut picture,
    );
    let focal = f64::from(width) / 2.0 / libm::tan(fov / 2.0);
    let mut of_ball = 0;
    for row in 0..height {
        for column in 0..width {
            let right = (f64::from(column) + 0.5 - f64::from(width) / 2.0) / focal;
            let down = (f64::from(row) + 0.5 - f64::from(height) / 2.0) / focal;
            let towards = DVec3::new(1.0, -right, -down);
            let mut expected = normal.x * 3.0 / normal.dot(towards);
            // The nearer root of |t towards - middle| = radius.
            let (a, b) = (towards.length_squared(), towards.dot(middle));
            let root = b * b - a * (middle.length_squared() - radius * radius);
            if root >= 0.0 {
                expected = (b - root.sqrt()) / a;
                of_ball += 1;
            }
            let source = f64::from(picture.depth_m[(row * width + column) as usize]);
            let seen = expected > 0.1 && expected < 100.0;
            if seen {
                assert!((source - expected).abs() < 1e-5, "{column} {row}: {source} {expected}");
            } else {
                assert_eq!(source, f64::INFINITY);
            }
        }
    }
    assert!(of_ball > 100, "{of_ball}");
    // Depth alone takes another way.
    let mut all = RenderedImages::default();
    scene.render(&request(&lens, ALL, 1), &mut all);
    assert_eq!(all.depth_m, picture.depth_m);
    assert!(picture.rgb.is_empty() && picture.classes.is_empty());
}

#[test]
fn colours_are_ambient_and_direct_light_times_material() {
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    put(&mut scene, visual(wall(10.0), [1.0, 0.5, 0.0]), [3.0, 0.0, 0.0]);
    let lens = Lens::pinhole(8, 8, 1.0).unwrap();
    let mut picture = RenderedImages::default();
    // SDF's ambient light is 0.4.
    scene.render(&request(&lens, ALL, 1), &mut picture);
    assert_eq!(picture.rgb[..3], [102, 51, 0]);
    assert_eq!(picture.depth_m[0], 2.5);
    // Straight from behind the camera: 0.4 + 0.5.
    scene.set_light(&lamp(LightKind::Directional, [0.0; 3]));
    scene.render(&request(&lens, ALL, 1), &mut picture);
    assert_eq!(picture.rgb[..3], [230, 115, 0]);
    // From behind the wall.
    scene.set_light(&lamp(LightKind::Point, [9.0, 0.0, 0.0]));
    scene.render(&request(&lens, ALL, 1), &mut picture);
    assert_eq!(picture.rgb[..3], [102, 51, 0]);
    assert!(scene.remove_light("lamp") && !scene.remove_light("lamp"));
}

#[test]
fn what_stands_in_the_light_throws_a_shadow_if_it_may() {
    for kind in [LightKind::Directional, LightKind::Point] {
        for (cast_shadows, transparency, brightness) in
            [(true, 0.0, 102), (false, 0.0, 230), (true, 0.9, 230)]
        {
            let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
            put(&mut scene, visual(wall(10.0), [1.0; 3]), [3.0, 0.0, 0.0]);
            // Behind the camera, in front of the light.
            let mut screen = visual(wall(1.0), [1.0; 3]);
            screen.cast_shadows = cast_shadows;
            screen.transparency = transparency;
            put(&mut scene, screen, [-2.0, 0.0, 0.0]);
            scene.set_light(&lamp(kind, [-20.0, 0.0, 0.0]));
            let lens = Lens::pinhole(2, 2, 0.01).unwrap();
            let mut picture = RenderedImages::default();
            scene.render(&request(&lens, ALL, 1), &mut picture);
            assert_eq!(picture.rgb[0], brightness, "{kind:?} {cast_shadows} {transparency}");
        }
    }
}

#[test]
fn glass_lets_half_through() {
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    put(&mut scene, visual(wall(10.0), [1.0, 0.0, 0.0]), [6.0, 0.0, 0.0]);
    let mut glass = visual(wall(10.0), [0.0, 0.0, 1.0]);
    glass.transparency = 0.5;
    put(&mut scene, glass, [3.0, 0.0, 0.0]);
    let lens = Lens::pinhole(2, 2, 0.5).unwrap();
    let mut picture = RenderedImages::default();
    scene.render(&request(&lens, ALL, 1), &mut picture);
    // Half of 0.4 each; both faces of the pane count once. Depth is that of the glass.
    assert_eq!(picture.rgb[..3], [51, 0, 51]);
    assert_eq!(picture.depth_m[0], 2.5);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    for number in 0..30 {
        let at = f64::from(number);
        let ball = Shape::Sphere { radius_m: 0.2 + 0.01 * at };
        let set_link_poses = [3.0 + 0.2 * at, (at * 0.7) % 4.0 - 2.0, (at * 1.3) % 3.0 - 1.5];
        put(&mut scene, visual(ball, [0.03 * at, 1.0 - 0.03 * at, 0.5]), set_link_poses);
    }
    scene.set_light(&lamp(LightKind::Point, [0.0, 2.0, 3.0]));
    let lens = Lens::pinhole(67, 45, 1.2).unwrap();
    let mut one = RenderedImages::default();
    scene.render(&request(&lens, ALL, 1), &mut one);
    assert!(one.depth_m.iter().filter(|depth| depth.is_finite()).count() > 500);
    for threads in [0, 2, 3, 8, 1000] {
        let mut other = RenderedImages::default();
        scene.render(&request(&lens, ALL, threads), &mut other);
        assert_eq!(one, other, "{threads}");
    }
}

fn camera(kind: CameraKind, distortion: Option<Distortion>) -> Camera {
    Camera {
        name: None,
        kind,
        sensor_from_camera: Pose::IDENTITY,
        horizontal_fov_rad: 1.2,
        width: 64,
        height: 48,
        format: "R8G8B8".into(),
        near_m: 0.1,
        far_m: 100.0,
        depth_clip_m: None,
        noise: NoiseSpec::default(),
        distortion,
        camera_info_topic: None,
        optical_frame_id: None,
        triggered: false,
        visibility_mask: u32::MAX,
        label_type: None,
        others: Vec::new(),
        extra: Vec::new(),
    }
}

#[test]
fn lenses_bend_the_image_and_keep_depth() {
    let mut scene = RenderScene::empty(SensedGeometry::Visual, 1);
    put(&mut scene, visual(wall(100.0), [1.0; 3]), [3.0, 0.0, 0.0]);
    let barrel = Distortion { k1: -0.1, k2: 0.0, k3: 0.0, p1: 0.0, p2: 0.0, center: [0.5, 0.5] };
    let plain = Lens::of(&camera(CameraKind::Depth, None)).unwrap();
    let distorted = Lens::of(&camera(CameraKind::Depth, Some(barrel))).unwrap();
    let wide = Lens::of(&camera(CameraKind::WideAngle, None)).unwrap();
    // A barrel shows more at the rim.
    let side = |lens: &Lens| lens.direction(0, 24).unwrap().normalize().y;
    assert!(side(&distorted) > side(&plain));
    // A stereographic lens is spread to the same angle at the rim.
    assert!((side(&wide) - side(&plain)).abs() < 0.02, "{} {}", side(&wide), side(&plain));
    for lens in [plain, distorted, wide] {
        let mut picture = RenderedImages::default();
        scene.render(&request(&lens, ALL, 1), &mut picture);
        for depth in picture.depth_m {
            assert!((depth - 2.5).abs() < 1e-5, "{depth}");
        }
    }
}

#[test]
fn a_custom_lens_with_the_tangent_is_a_pinhole() {
    let child = |name: &str, text: &str| Element::new(name).with_text(text);
    let wide = |children: &[(&str, &str)]| {
        let own = Element::new("custom_function");
        let own = children.iter().fold(own, |own, (name, text)| own.with_child(child(name, text)));
        let lens = Element::new("lens").with_child(child("type", "custom")).with_child(own);
        Lens::of(&Camera { extra: vec![lens], ..camera(CameraKind::WideAngle, None) })
    };
    let plain = Lens::of(&camera(CameraKind::Depth, None)).unwrap();
    let own = wide(&[("c1", "3"), ("f", "2"), ("fun", "tan")]).unwrap();
    let first = |lens: &Lens| lens.direction(0, 0).unwrap().normalize();
    assert!((first(&own) - first(&plain)).length() < 1e-12, "{}", first(&own));
    assert!(wide(&[("c2", "0")]).is_err());
    assert!(wide(&[("fun", "cosh")]).is_err());
}
