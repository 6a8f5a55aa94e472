//! Small scenes for tests, read from text that resembles SDF. The real reader is on the same level as this
//! crate, so tests here cannot use it.

use expect_test::Expect;
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_scene::*;
use periplus_xml::parse;

/// Reads a plugin.
pub(crate) fn plugin(text: &str) -> Plugin {
    let mut sources = SourceMap::new();
    let file = sources.add("plugin.sdf", text);
    let document = parse(file, &sources, &mut Diagnostics::new()).unwrap();
    read_plugin(&document.root)
}

/// Lints a scene and compares the findings. The root is `<world>`, `<model>` or `<sdf>`.
pub(crate) fn check(text: &str, expected: Expect) {
    let mut sources = SourceMap::new();
    let file = sources.add("test.sdf", text);
    let mut diagnostics = Diagnostics::new();
    let document = parse(file, &sources, &mut diagnostics).unwrap();
    let scene = read(&document.root);
    crate::lint(&scene, &mut diagnostics);
    let said: String =
        diagnostics.iter().map(|d| render(d, &sources, RenderStyle::Plain)).collect();
    expected.assert_eq(&said);
}

/// Reads a scene.
pub(crate) fn scene(text: &str) -> Scene {
    let mut sources = SourceMap::new();
    let file = sources.add("test.sdf", text);
    read(&parse(file, &sources, &mut Diagnostics::new()).unwrap().root)
}

fn read(root: &Element) -> Scene {
    match &*root.name {
        "world" => Scene { worlds: vec![read_world(root)], ..Scene::default() },
        "model" => Scene { models: vec![read_model(root)], ..Scene::default() },
        _ => Scene {
            worlds: root.named("world").map(read_world).collect(),
            models: root.named("model").map(read_model).collect(),
            ..Scene::default()
        },
    }
}

fn read_world(element: &Element) -> World {
    World {
        name: name(element),
        gravity_m_s2: DVec3::ZERO,
        magnetic_field_t: DVec3::ZERO,
        wind_m_s: DVec3::ZERO,
        physics: vec![Physics::default()],
        ambient: Colour::BLACK,
        background: Colour::BLACK,
        shadows: true,
        grid: true,
        spherical_coordinates: None,
        gui: element.child("gui").map(|gui| Gui {
            fullscreen: false,
            world_from_camera: None,
            camera_extra: Vec::new(),
            plugins: gui.named("plugin").map(read_plugin).collect(),
            extra: Vec::new(),
        }),
        frames: Vec::new(),
        models: element.named("model").map(read_model).collect(),
        joints: Vec::new(),
        lights: Vec::new(),
        actors: Vec::new(),
        plugins: element.named("plugin").map(read_plugin).collect(),
        extra: Vec::new(),
        origin: element.origin,
    }
}

fn read_model(element: &Element) -> Model {
    let mut model = Model::new(name(element));
    model.origin = element.origin;
    model.plugins = element.named("plugin").map(read_plugin).collect();
    for link in element.named("link") {
        model.links.push(read_link(link));
    }
    for joint in element.named("joint") {
        let text = |name: &str| joint.child(name).map(|child| child.text().into_owned());
        let mut read = Joint::new(
            name(joint),
            JointKind::Continuous,
            text("parent").unwrap_or_default(),
            text("child").unwrap_or_default(),
        );
        read.axis = Some(Axis { direction_in_joint: DVec3::Y, ..Axis::default() });
        read.origin = joint.origin;
        model.joints.push(read);
    }
    for (kind, role) in [
        ("frame", FrameRole::Declared),
        ("merged_link", FrameRole::MergedLink),
        ("merged_joint", FrameRole::MergedJoint),
    ] {
        for frame in element.named(kind) {
            model.frames.push(NamedFrame {
                name: name(frame),
                parent_from_frame: Pose::IDENTITY,
                attached_to: "__model__".into(),
                role,
                origin: frame.origin,
            });
        }
    }
    model
}

fn read_link(element: &Element) -> Link {
    let mut link = Link::new(name(element));
    link.origin = element.origin;
    if let Some(pose) = element.child("pose") {
        let xyz: Vec<f64> = pose.text().split_whitespace().map(|x| x.parse().unwrap()).collect();
        link.model_from_link = Pose::from_xyz(xyz[0], xyz[1], xyz[2]);
    }
    if let Some(radius) = element.child("radius") {
        let radius_m = radius.text().parse().unwrap();
        link.collisions.push(Collision::new("c", Shape::Cylinder { radius_m, length_m: 0.04 }));
    }
    for sensor in element.named("sensor") {
        link.sensors.push(Sensor {
            name: name(sensor),
            parent_from_sensor: Pose::IDENTITY,
            type_name: sensor.value("type").unwrap_or_default().into(),
            kind: SensorKind::Other,
            update_rate_hz: 0.0,
            always_on: false,
            visualize: false,
            enable_metrics: false,
            topic: sensor.child("topic").map(|topic| topic.text().into_owned()),
            frame_id: None,
            plugins: sensor.named("plugin").map(read_plugin).collect(),
            kind_extra: Vec::new(),
            extra: Vec::new(),
            origin: sensor.origin,
        });
    }
    link
}

fn read_plugin(element: &Element) -> Plugin {
    Plugin {
        name: name(element),
        filename: element.value("filename").unwrap_or_default().to_owned(),
        content: element.elements().cloned().collect(),
        origin: element.origin,
    }
}

fn name(element: &Element) -> String {
    element.value("name").unwrap_or_default().to_owned()
}
