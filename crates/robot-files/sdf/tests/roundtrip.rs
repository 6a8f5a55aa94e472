//! Written scenes read back as the same scene.

mod common;

use common::{Files, read_with, told};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DQuat, DVec3, Pose, Rpy};
use periplus_scene::{
    Axis, Camera, CameraKind, Collision, Colour, Distortion, Element, FrameRole, ImuSpec, Joint,
    JointKind, LidarSpec, Light, LightKind, Link, Material, MaterialScript, MeshShape, Mimic,
    Model, NamedFrame, NoiseKind, NoiseSpec, Origin, Plugin, Polyline, RadarNoise, RadarSpec,
    ScanAxis, Scene, Sensor, SensorKind, Shape, Spot, SurfaceProperties, Visual,
};
use proptest::prelude::*;

fn numbers() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0f64, Just(0.0), Just(0.1), Just(-2.5), 1e-9..1e9f64]
}

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![1e-3..100.0f64, Just(1.0), Just(0.5)]
}

fn vectors() -> impl Strategy<Value = DVec3> {
    [numbers(), numbers(), numbers()].prop_map(DVec3::from_array)
}

fn poses() -> impl Strategy<Value = Pose> {
    let angle = || prop_oneof![-3.1..3.1f64, Just(0.0), Just(1.25), Just(-0.1)];
    let simple = (vectors(), angle(), angle(), angle()).prop_map(|(xyz, roll, pitch, yaw)| {
        Pose::from_xyz_rpy(xyz.to_array(), Rpy { roll, pitch, yaw })
    });
    let quaternion = [-1.0..1.0f64, -1.0..1.0, -1.0..1.0, 0.01..1.0];
    let turned = (vectors(), quaternion)
        .prop_map(|(xyz, q)| Pose::from_xyz_quaternion(xyz.to_array(), DQuat::from_array(q)));
    prop_oneof![Just(Pose::IDENTITY), simple, turned]
}

fn words() -> impl Strategy<Value = String> {
    "[a-zA-Z][a-z0-9_/<&\"']{0,6}"
}

fn extras() -> impl Strategy<Value = Vec<Element>> {
    prop_oneof![
        4 => Just(Vec::new()),
        1 => words().prop_map(|text| {
            let inner = Element::new("inner").with_attribute("a", text.as_str());
            vec![Element::new("gz:extra").with_child(inner), Element::new("gz:text").with_text(text)]
        }),
    ]
}

fn plugins() -> impl Strategy<Value = Vec<Plugin>> {
    let plugin = (words(), words(), words()).prop_map(|(name, filename, text)| Plugin {
        name,
        filename,
        content: vec![Element::new("topic").with_text(text), Element::new("empty")],
        origin: Origin::default(),
    });
    prop::collection::vec(plugin, 0..2)
}

fn shapes() -> impl Strategy<Value = Shape> {
    let sizes = || [positive(), positive(), positive()].prop_map(DVec3::from_array);
    let mesh = (words(), prop::option::of(words()), any::<bool>(), sizes()).prop_map(
        |(uri, submesh, center_submesh, scale)| {
            Shape::Mesh(MeshShape {
                uri,
                path: None,
                submesh,
                center_submesh,
                scale,
                extra: Vec::new(),
                origin: Origin::default(),
            })
        },
    );
    let points = prop::collection::vec([numbers(), numbers()], 3..5);
    let outline =
        (points, positive()).prop_map(|(points_m, height_m)| Polyline { points_m, height_m });
    prop_oneof![
        Just(Shape::Empty),
        sizes().prop_map(|size_m| Shape::Box { size_m }),
        (positive(), positive())
            .prop_map(|(radius_m, length_m)| Shape::Cylinder { radius_m, length_m }),
        (positive(), positive())
            .prop_map(|(radius_m, length_m)| Shape::Cone { radius_m, length_m }),
        (positive(), positive())
            .prop_map(|(radius_m, length_m)| Shape::Capsule { radius_m, length_m }),
        positive().prop_map(|radius_m| Shape::Sphere { radius_m }),
        sizes().prop_map(|radii_m| Shape::Ellipsoid { radii_m }),
        sizes()
            .prop_map(|size| Shape::Plane { normal: size.normalize(), size_m: [size.x, size.y] }),
        mesh,
        prop::collection::vec(outline, 1..3).prop_map(Shape::Polylines),
    ]
}

fn colours() -> impl Strategy<Value = Colour> {
    let part = || prop_oneof![0.0..1.0f64, Just(0.0), Just(1.0)];
    [part(), part(), part(), part()].prop_map(Colour)
}

fn materials() -> impl Strategy<Value = Material> {
    let script = (prop::collection::vec(words(), 0..3), words())
        .prop_map(|(uris, name)| MaterialScript { uris, name });
    (
        prop::option::of(words()),
        prop::array::uniform4(prop::option::of(colours())),
        prop::option::of(script),
        prop::option::of(any::<bool>()),
        any::<bool>(),
        extras().boxed(),
    )
        .prop_map(|(name, colours, script, lighting, double_sided, extra)| {
            let [ambient, diffuse, specular, emissive] = colours;
            Material {
                name,
                ambient,
                diffuse,
                specular,
                emissive,
                script,
                lighting,
                double_sided,
                extra,
                ..Material::default()
            }
        })
}

fn surfaces() -> impl Strategy<Value = SurfaceProperties> {
    let mu = || prop_oneof![Just(1.0), positive(), Just(f64::INFINITY)];
    (mu(), mu(), vectors(), positive(), any::<bool>(), any::<u32>()).prop_map(
        |(mu, mu2, fdir1, kp, flag, mask)| {
            let mut surface = SurfaceProperties::default();
            surface.friction.mu = mu;
            surface.friction.mu2 = mu2;
            surface.friction.fdir1 = fdir1;
            let framed = flag && fdir1 != DVec3::ZERO;
            surface.friction.fdir1_expressed_in = framed.then(|| "chassis".to_owned());
            surface.contact.kp = kp;
            surface.contact.collide_without_contact = flag;
            surface.contact.collide_bitmask = mask;
            // As a reader keeps `<friction><torsional/></friction>`.
            let torsional =
                Element::new("torsional").with_child(Element::new("coefficient").with_text("0.5"));
            if flag {
                surface.extra.push(Element::new("friction").with_child(torsional));
            }
            surface
        },
    )
}

fn noises() -> impl Strategy<Value = NoiseSpec> {
    let kind = prop_oneof![Just(NoiseKind::Gaussian), Just(NoiseKind::GaussianQuantized)];
    let some = (kind, numbers(), positive(), numbers(), positive()).prop_map(
        |(kind, mean, stddev, bias_mean, precision)| NoiseSpec {
            kind,
            mean,
            stddev,
            bias_mean,
            precision,
            ..NoiseSpec::default()
        },
    );
    prop_oneof![Just(NoiseSpec::default()), some]
}

fn cameras(kind: CameraKind) -> impl Strategy<Value = Camera> {
    let lens = [numbers(), numbers(), numbers(), numbers(), numbers()]
        .prop_map(|[k1, k2, k3, p1, p2]| Distortion { k1, k2, k3, p1, p2, center: [0.5, 0.25] });
    (
        (prop::option::of(words()), poses(), 0.1..3.0f64, 1..4000u32, 1..4000u32),
        (prop::option::of([0.1..1.0f64, 2.0..9.0]), noises().boxed(), prop::option::of(lens)),
        (prop::option::of(words()), any::<bool>(), any::<u32>(), extras().boxed()),
    )
        .prop_map(
            move |(
                (name, sensor_from_camera, horizontal_fov_rad, width, height),
                (depth_clip_m, noise, distortion),
                (text, triggered, visibility_mask, extra),
            )| Camera {
                name,
                kind,
                sensor_from_camera,
                horizontal_fov_rad,
                width,
                height,
                format: "L8".into(),
                near_m: 0.05,
                far_m: 20.0,
                depth_clip_m,
                noise,
                distortion,
                camera_info_topic: text.clone(),
                optical_frame_id: text.clone(),
                triggered,
                visibility_mask,
                label_type: matches!(kind, CameraKind::Segmentation | CameraKind::BoundingBox)
                    .then_some(text)
                    .flatten(),
                others: Vec::new(),
                extra,
            },
        )
}

fn kinds() -> impl Strategy<Value = (&'static str, SensorKind)> {
    let three = || prop::array::uniform3(noises().boxed());
    let camera = |name: &'static str, kind| {
        cameras(kind).boxed().prop_map(move |camera| (name, SensorKind::Camera(Box::new(camera))))
    };
    let multi =
        prop::collection::vec(cameras(CameraKind::Multi).boxed(), 1..3).prop_map(|mut all| {
            let mut first = all.remove(0);
            first.others = all;
            ("multicamera", SensorKind::Camera(Box::new(first)))
        });
    let lidar = (1..1000u32, positive(), noises().boxed(), any::<bool>(), extras().boxed())
        .prop_map(|(samples, resolution, noise, old, extra)| {
            let axis = ScanAxis { samples, resolution, min_angle_rad: -1.25, max_angle_rad: 2.5 };
            let lidar = LidarSpec {
                horizontal: axis,
                vertical: ScanAxis { samples: 3, ..axis },
                range_min_m: 0.1,
                range_max_m: if old { f64::INFINITY } else { 8.0 },
                range_resolution_m: 0.01,
                noise,
                visibility_mask: samples,
                extra,
            };
            (if old { "ray" } else { "gpu_lidar" }, SensorKind::Lidar(Box::new(lidar)))
        });
    let radar =
        (positive(), any::<bool>(), extras().boxed()).prop_map(|(resolution, is_custom, extra)| {
            let radar = RadarSpec {
                range_resolution_m: resolution,
                elevation_resolution_rad: 0.05,
                noise: RadarNoise { doppler_stddev_m_per_s: resolution, ..RadarNoise::default() },
                extra,
                ..RadarSpec::default()
            };
            (if is_custom { "custom" } else { "radar" }, SensorKind::Radar(Box::new(radar)))
        });
    let imu = (three(), three(), any::<bool>(), prop::option::of(words())).prop_map(
        |(angular_velocity, linear_acceleration, enable_orientation, localization)| {
            let extra = Vec::new();
            let imu = ImuSpec {
                angular_velocity,
                linear_acceleration,
                enable_orientation,
                localization,
                extra,
            };
            ("imu", SensorKind::Imu(Box::new(imu)))
        },
    );
    let navsat = prop::array::uniform4(noises().boxed()).prop_map(|[a, b, c, d]| {
        let kind = SensorKind::NavSat {
            position_horizontal: a,
            position_vertical: b,
            velocity_horizontal: c,
            velocity_vertical: d,
        };
        ("navsat", kind)
    });
    let force_torque = (three(), three()).prop_map(|(force, torque)| {
        let kind = SensorKind::ForceTorque {
            frame: "sensor".into(),
            measure_direction: "parent_to_child".into(),
            force: Box::new(force),
            torque: Box::new(torque),
        };
        ("force_torque", kind)
    });
    let contact = (prop::collection::vec(words(), 0..3), prop::option::of(words()))
        .prop_map(|(collisions, topic)| ("contact", SensorKind::Contact { collisions, topic }));
    prop_oneof![
        camera("camera", CameraKind::Colour).boxed(),
        camera("depth", CameraKind::Depth),
        camera("segmentation", CameraKind::Segmentation),
        camera("boundingbox_camera", CameraKind::BoundingBox),
        multi.boxed(),
        lidar.boxed(),
        radar.boxed(),
        imu.boxed(),
        navsat.boxed(),
        force_torque.boxed(),
        contact.boxed(),
        three().prop_map(|noises| ("magnetometer", SensorKind::Magnetometer(noises))),
        positive().prop_map(|max_m| {
            let geometry = "sphere".into();
            ("sonar", SensorKind::Sonar { geometry, min_m: 0.0, max_m, radius_m: 0.25 })
        }),
        Just(("dvl", SensorKind::Other)),
    ]
}

fn sensors() -> impl Strategy<Value = Sensor> {
    (
        kinds().boxed(),
        poses(),
        positive(),
        any::<bool>(),
        prop::option::of(words()),
        plugins().boxed(),
        extras().boxed(),
    )
        .prop_map(|((type_name, kind), pose, update_rate_hz, flag, text, plugins, extra)| {
            Sensor {
                name: format!("{type_name}_sensor"),
                parent_from_sensor: pose,
                type_name: type_name.into(),
                kind,
                update_rate_hz,
                always_on: flag,
                visualize: !flag,
                enable_metrics: flag,
                topic: text.clone(),
                frame_id: text,
                plugins,
                kind_extra: Vec::new(),
                extra,
                origin: Origin::default(),
            }
        })
}

fn lights() -> impl Strategy<Value = Light> {
    let spot = positive().prop_map(|angle| {
        LightKind::Spot(Spot { inner_angle_rad: angle, outer_angle_rad: angle, falloff: 1.0 })
    });
    let kind = prop_oneof![Just(LightKind::Point), Just(LightKind::Directional), spot];
    (kind, poses(), vectors(), any::<bool>(), colours(), positive()).prop_map(
        |(kind, parent_from_light, direction_in_light, flag, diffuse, range_m)| Light {
            name: "light".into(),
            parent_from_light,
            kind,
            direction_in_light,
            is_on: flag,
            visualize: flag,
            cast_shadows: flag,
            intensity: range_m,
            diffuse,
            specular: Colour::WHITE,
            attenuation: periplus_scene::Attenuation {
                range_m,
                constant: 0.5,
                linear: 0.25,
                quadratic: 0.125,
            },
            extra: Vec::new(),
            origin: Origin::default(),
        },
    )
}

fn links(name: &'static str) -> impl Strategy<Value = Link> {
    (
        (poses(), poses(), positive(), any::<bool>()),
        prop::option::of((shapes().boxed(), poses(), surfaces().boxed(), extras().boxed())),
        prop::option::of((
            shapes().boxed(),
            poses(),
            prop::option::of(materials().boxed()),
            plugins().boxed(),
        )),
        prop::option::of(sensors().boxed()),
        prop::option::of(lights().boxed()),
        extras().boxed(),
    )
        .prop_map(
            move |((pose, inertial, mass_kg, flag), collision, visual, sensor, light, extra)| {
                let mut link = Link::new(name);
                link.model_from_link = pose;
                link.inertial.link_from_inertial = inertial;
                link.inertial.mass_kg = mass_kg;
                link.inertial.inertia_kg_m2 = [mass_kg, 0.0, 0.0, mass_kg, 0.0, mass_kg];
                link.gravity = flag;
                link.velocity_decay = [mass_kg, 0.0];
                link.collisions.extend(collision.map(|(shape, pose, surface, extra)| {
                    let mut collision = Collision::new("c", shape);
                    collision.link_from_collision = pose;
                    collision.surface = surface;
                    collision.extra = extra;
                    collision
                }));
                link.visuals.extend(visual.map(|(shape, pose, material, plugins)| {
                    let mut visual = Visual::new("v", shape);
                    visual.link_from_visual = pose;
                    visual.material = material;
                    visual.plugins = plugins;
                    visual
                }));
                link.sensors.extend(sensor);
                link.lights.extend(light);
                link.extra = extra;
                link
            },
        )
}

fn axes() -> impl Strategy<Value = Axis> {
    let mimic = (words(), numbers(), numbers()).prop_map(|(joint, multiplier, offset)| Mimic {
        joint,
        axis: "axis".into(),
        multiplier,
        offset,
        reference: 0.0,
    });
    let limit = || prop_oneof![Just(f64::INFINITY), positive()];
    (vectors(), limit(), limit(), limit(), numbers(), prop::option::of(mimic)).prop_map(
        |(direction, lower, upper, effort, damping, mimic)| Axis {
            direction_in_joint: direction.try_normalize().unwrap_or(DVec3::X),
            lower: -lower,
            upper,
            effort,
            damping,
            mimic,
            ..Axis::default()
        },
    )
}

fn joints() -> impl Strategy<Value = Joint> {
    let kind = prop_oneof![
        Just(JointKind::Fixed),
        Just(JointKind::Revolute),
        Just(JointKind::Prismatic),
        Just(JointKind::Universal),
        Just(JointKind::Screw),
        Just(JointKind::Continuous),
    ];
    (kind, poses(), axes().boxed(), axes().boxed(), numbers()).prop_map(
        |(kind, pose, axis, axis2, pitch)| {
            let mut joint = Joint::new("j", kind, "base", "tip");
            joint.child_from_joint = pose;
            joint.axis = (kind != JointKind::Fixed).then_some(axis);
            joint.axis2 = (kind == JointKind::Universal).then_some(axis2);
            joint.thread_pitch_m = (kind == JointKind::Screw).then_some(pitch);
            joint
        },
    )
}

fn frames() -> impl Strategy<Value = NamedFrame> {
    let attached_to = prop_oneof![Just("__model__"), Just("base"), Just("j")];
    let role = prop_oneof![
        Just(FrameRole::Declared),
        Just(FrameRole::MergedLink),
        Just(FrameRole::MergedJoint)
    ];
    (poses(), attached_to, role).prop_map(|(parent_from_frame, attached_to, role)| NamedFrame {
        name: "f".into(),
        parent_from_frame,
        attached_to: attached_to.into(),
        role,
        origin: Origin::default(),
    })
}

fn models() -> impl Strategy<Value = Model> {
    let nested = (poses(), links("inner").boxed()).prop_map(|(pose, link)| {
        let mut model = Model::new("nested");
        model.parent_from_model = pose;
        model.canonical_link = Some("inner".into());
        model.links.push(link);
        model
    });
    (
        (poses(), any::<bool>(), any::<bool>(), prop::option::of(words())),
        (links("base").boxed(), links("tip").boxed(), joints().boxed(), frames().boxed()),
        (prop::option::of(nested), plugins().boxed(), extras().boxed(), 0..3usize),
    )
        .prop_map(
            |(
                (pose, is_static, self_collide, included_from),
                (base, tip, joint, frame),
                (nested, plugins, extra, canonical),
            )| {
                let mut model = Model::new("m");
                model.parent_from_model = pose;
                model.is_static = is_static;
                model.self_collide = self_collide;
                model.included_from = included_from;
                let names = ["base", "tip", if nested.is_some() { "nested::inner" } else { "tip" }];
                model.canonical_link = Some(names[canonical].into());
                model.links = vec![base, tip];
                model.joints = vec![joint];
                model.frames = vec![frame];
                model.models.extend(nested);
                model.plugins = plugins;
                model.extra = extra;
                model
            },
        )
}

fn again(scene: &Scene) -> (Scene, String) {
    let mut diagnostics = Diagnostics::new();
    let text = periplus_xml::write_document(&periplus_sdf::write(scene, &mut diagnostics));
    let (again, diagnostics, sources) = read_with(&text, &mut Files::default());
    assert!(!diagnostics.has_errors(), "{}\n{text}", told(&diagnostics, &sources));
    (again, text)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn models_come_back(model in models().boxed(), light in lights().boxed()) {
        let scene = Scene { models: vec![model], lights: vec![light], ..Scene::default() };
        let (again, text) = again(&scene);
        prop_assert_eq!(&again, &scene, "{}", text);
    }

    #[test]
    fn worlds_come_back(model in models().boxed(), gravity in vectors(), frame in frames().boxed(), degrees in -180.0..180.0f64) {
        let bare = common::read(r#"<sdf version="1.9"><world name="w"/></sdf>"#);
        let mut scene = bare;
        let world = &mut scene.worlds[0];
        world.gravity_m_s2 = gravity;
        world.models.push(model);
        world.frames.push(NamedFrame { attached_to: "m::base".into(), ..frame });
        world.spherical_coordinates = Some(periplus_scene::SphericalCoordinates {
            surface_model: "EARTH_WGS84".into(),
            frame_orientation: "ENU".into(),
            latitude_rad: degrees.to_radians(),
            longitude_rad: -degrees.to_radians(),
            elevation_m: 3.0,
            heading_rad: 0.0,
            extra: Vec::new(),
        });
        let (again, text) = again(&scene);
        prop_assert_eq!(&again, &scene, "{}", text);
    }

    #[test]
    fn any_text_is_survived(text in "(<(sdf version='1.[0-9]'|/?(world|model|link|joint|frame|sensor|pose|include|uri|state)( name='[ab]')?)>|[ab0-9. ]){0,40}") {
        let _ = common::findings(&text);
    }
}

#[test]
fn joints_that_sdf_lacks_are_left_out_with_a_warning() {
    let mut model = Model::new("m");
    model.links = vec![Link::new("a"), Link::new("b")];
    model.joints = vec![Joint::new("j", JointKind::Floating, "a", "b")];
    let mut diagnostics = Diagnostics::new();
    let scene = Scene { models: vec![model], ..Scene::default() };
    periplus_sdf::write(&scene, &mut diagnostics);
    assert_eq!(diagnostics.iter().map(|it| it.code).collect::<Vec<_>>(), ["not-in-sdf"]);
}

#[test]
fn a_scene_is_json_with_infinities_as_null() {
    let scene = common::read(&common::model(
        r#"<link name="a"/><link name="b"/>
        <joint name="j" type="continuous"><parent>a</parent><child>b</child>
          <axis><xyz>0 0 1</xyz></axis></joint>
        <gripper name="g"><palm_link>a</palm_link></gripper>"#,
    ));
    let json = serde_json::to_value(&scene).unwrap();
    let model = &json["models"][0];
    assert_eq!(model["joints"][0]["axis"]["upper"], serde_json::Value::Null);
    assert_eq!(model["joints"][0]["kind"], "continuous");
    assert_eq!(model["links"][0]["model_from_link"]["quat_xyzw"][3], 1.0);
    let extra = model["extra"][0].as_str().unwrap();
    assert!(extra.starts_with("<gripper name=\"g\">"), "{extra}");
    assert!(model.get("origin").is_none());
}
