//! Properties of every robot.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::Pose;
use periplus_scene::{DVec3, Model, Scene, carrying_link, tf_tree};
use periplus_sdf::{NoIncludes, SdfContext};
use periplus_urdf::{
    ConversionOptions, Dynamics, Extra, GazeboBlock, JointType, Limit, Rotation, UrdfCollision,
    UrdfGeometry, UrdfInertial, UrdfJoint, UrdfLink, UrdfMaterial, UrdfOrigin, UrdfRobot,
    UrdfVisual, from_model, read, to_model, write,
};
use periplus_xml::Element;
use proptest::prelude::*;
use proptest::sample::select;

fn placements() -> impl Strategy<Value = UrdfOrigin> {
    let xyz = prop::array::uniform3(-3.0..3.0f64);
    let rpy = (-3.0..3.0f64, -1.5..1.5f64, -3.0..3.0f64);
    (xyz, rpy, 0..3u8).prop_map(|(xyz_m, (roll, pitch, yaw), kind)| UrdfOrigin {
        xyz_m: if kind == 0 { [0.0; 3] } else { xyz_m },
        rotation: Rotation::Rpy(if kind == 2 { [roll, pitch, yaw] } else { [0.0; 3] }),
        extra: Extra::default(),
    })
}

/// A solid box, so the inertia is one that a body can have.
fn inertials() -> impl Strategy<Value = UrdfInertial> {
    let sizes = prop::array::uniform3(0.1..2.0f64);
    (placements(), 0.1..9.0f64, sizes).prop_map(|(link_from_inertial, mass_kg, [x, y, z])| {
        let moment = |a: f64, b: f64| mass_kg / 12.0 * (a * a + b * b);
        UrdfInertial {
            link_from_inertial,
            mass_kg,
            inertia_kg_m2: [moment(y, z), 0.0, 0.0, moment(x, z), 0.0, moment(x, y)],
            ..UrdfInertial::default()
        }
    })
}

fn geometries() -> impl Strategy<Value = UrdfGeometry> {
    let size = 0.1..2.0f64;
    prop_oneof![
        prop::array::uniform3(size.clone()).prop_map(|size_m| UrdfGeometry::Box { size_m }),
        size.clone().prop_map(|radius_m| UrdfGeometry::Sphere { radius_m }),
        (size.clone(), size)
            .prop_map(|(radius_m, length_m)| UrdfGeometry::Cylinder { radius_m, length_m }),
        Just(UrdfGeometry::Mesh {
            filename: "package://robot/mesh.stl".into(),
            scale: [1.0, 2.0, 0.5],
            origin: periplus_diagnostics::Origin::default(),
        }),
    ]
}

fn links() -> impl Strategy<Value = UrdfLink> {
    let shapes = prop::collection::vec((geometries(), placements(), any::<bool>()), 0..3);
    (prop::option::weighted(0.7, inertials()), shapes, any::<bool>()).prop_map(
        |(inertial, shapes, painted)| {
            let name = |named: bool, index: usize| named.then(|| format!("shape{index}"));
            let material = UrdfMaterial { name: "paint".into(), ..UrdfMaterial::default() };
            let mut link = UrdfLink { inertial, ..UrdfLink::default() };
            for (index, (geometry, placement, named)) in shapes.into_iter().enumerate() {
                link.collisions.push(UrdfCollision {
                    name: name(named, index),
                    link_from_collision: placement.clone(),
                    geometry: geometry.clone(),
                    extra: Extra::default(),
                    origin: periplus_diagnostics::Origin::default(),
                });
                link.visuals.push(UrdfVisual {
                    name: name(!named, index),
                    link_from_visual: placement,
                    geometry,
                    material: painted.then(|| material.clone()),
                    extra: Extra::default(),
                    origin: periplus_diagnostics::Origin::default(),
                });
            }
            link
        },
    )
}

fn joints() -> impl Strategy<Value = UrdfJoint> {
    let kinds = vec![
        JointType::Fixed,
        JointType::Fixed,
        JointType::Revolute,
        JointType::Continuous,
        JointType::Prismatic,
    ];
    let axis = prop::option::of(select(vec![[0.0, 0.0, 1.0], [0.0, 3.0, 0.0], [1.0, 0.0, -1.0]]));
    let numbers = prop::array::uniform4(0.1..5.0f64);
    (select(kinds), placements(), axis, any::<bool>(), numbers).prop_map(
        |(kind, parent_from_joint, axis, damped, [lower, upper, effort, velocity])| UrdfJoint {
            kind,
            parent_from_joint,
            axis: axis.map(|xyz| (xyz, Extra::default())),
            limit: matches!(kind, JointType::Revolute | JointType::Prismatic).then(|| Limit {
                lower: -lower,
                upper,
                effort,
                velocity,
                ..Limit::default()
            }),
            dynamics: damped.then(|| Dynamics {
                damping: lower,
                friction: upper,
                extra: Extra::default(),
            }),
            ..UrdfJoint::default()
        },
    )
}

/// A setting of Gazebo about a link or joint, from text.
fn settings() -> impl Strategy<Value = Element> {
    let leaf = |name: &str, text: &str| Element::new(name).with_text(text);
    select(vec![
        leaf("mu1", "0.25"),
        leaf("kp", "1000"),
        leaf("turnGravityOff", "true"),
        leaf("selfCollide", "true"),
        leaf("material", "Gazebo/Grey"),
        Element::new("sensor")
            .with_attribute("name", "imu")
            .with_attribute("type", "imu")
            .with_child(leaf("pose", "1 0 0 0 0 1"))
            .with_child(leaf("update_rate", "50")),
        leaf("preserveFixedJoint", "true"),
        leaf("provideFeedback", "true"),
    ])
}

prop_compose! {
    /// A tree: the parent of each link is one before it.
    fn robots()(
        links in prop::collection::vec((links(), joints(), any::<prop::sample::Index>()), 1..9),
        blocks in prop::collection::vec((settings(), any::<prop::sample::Index>()), 0..6),
        on_world in prop::bool::weighted(0.2),
    ) -> UrdfRobot {
        let paint = UrdfMaterial {
            name: "paint".into(),
            colour: Some(periplus_urdf::ColourAsWritten {
                rgba: [0.4, 1.0, 0.0, 0.5],
                extra: Extra::default(),
            }),
            ..UrdfMaterial::default()
        };
        let mut robot =
            UrdfRobot { name: "robot".into(), materials: vec![paint], ..UrdfRobot::default() };
        let name = |index: usize| match index {
            0 if on_world => "world".to_owned(),
            index => format!("link{index}"),
        };
        for (index, (link, joint, parent)) in links.into_iter().enumerate() {
            let own = UrdfLink { name: name(index), ..link };
            let world = own.name == "world";
            robot.links.push(if world { UrdfLink { name: own.name, ..UrdfLink::default() } } else { own });
            if index > 0 {
                robot.joints.push(UrdfJoint {
                    name: format!("joint{}", (index * 7) % 11),
                    parent: name(parent.index(index)),
                    child: name(index),
                    ..joint
                });
            }
        }
        for (setting, target) in blocks {
            let of_joint = ["preserveFixedJoint", "provideFeedback"].contains(&&*setting.name);
            let index = target.index(robot.links.len());
            let reference = match robot.joints.get(index) {
                Some(joint) if of_joint => joint.name.clone(),
                _ => name(index),
            };
            robot.gazebo.push(GazeboBlock {
                reference: Some(reference),
                content: vec![setting],
                ..GazeboBlock::default()
            });
        }
        robot
    }
}

fn model_of(robot: &UrdfRobot) -> (Model, Diagnostics) {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let model = to_model(robot, ConversionOptions::default(), &mut context);
    (model, diagnostics)
}

/// Frames of all links by the joints alone.
fn model_from_links(robot: &UrdfRobot) -> BTreeMap<&str, Pose> {
    let mut poses = BTreeMap::new();
    for link in &robot.links {
        let above = robot.joints.iter().find(|joint| joint.child == link.name);
        let pose = match above {
            // The parent of each link is one before it.
            Some(joint) => poses[&*joint.parent] * joint.parent_from_joint.pose(),
            None => Pose::IDENTITY,
        };
        poses.insert(&*link.name, pose);
    }
    poses
}

fn near(a: Pose, b: Pose) -> bool {
    let (metres, radians) = a.distance_to(b);
    metres < 1e-9 && radians < 1e-7
}

proptest! {
    #[test]
    fn a_written_robot_reads_back(robot in robots()) {
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let id = sources.add("r.urdf", periplus_xml::write_document(&write(&robot)));
        let document = periplus_xml::parse(id, &sources, &mut diagnostics).unwrap();
        let again = read(&document, &mut diagnostics);
        prop_assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        prop_assert_eq!(again.as_ref(), Some(&robot));
    }

    #[test]
    fn a_model_survives_sdf(robot in robots()) {
        let (model, _) = model_of(&robot);
        let scene = Scene { models: vec![model], ..Scene::default() };
        let document = periplus_sdf::write(&scene, &mut Diagnostics::new());
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let mut context = SdfContext {
            sources: &mut sources,
            diagnostics: &mut diagnostics,
            includes: &mut NoIncludes,
        };
        prop_assert_eq!(periplus_sdf::read_document(&document, &mut context), scene);
    }

    #[test]
    fn the_tree_is_that_of_the_robot(robot in robots()) {
        let (model, _) = model_of(&robot);
        let expected = model_from_links(&robot);
        let world_stands_alone =
            |joint: &&UrdfJoint| joint.parent != "world" || model.link(&joint.child).is_some();
        let wanted: BTreeSet<(&str, &str)> = robot
            .joints
            .iter()
            .filter(world_stands_alone)
            .map(|joint| (&*joint.parent, &*joint.child))
            .collect();
        let tree = tf_tree(&model);
        let found: BTreeSet<(&str, &str)> =
            tree.iter().map(|edge| (&*edge.parent, &*edge.child)).collect();
        prop_assert!(wanted.is_subset(&found), "{wanted:?} {found:?}");
        prop_assert_eq!(found.len(), robot.joints.len());
        for edge in &tree {
            let between = expected[&*edge.parent].inverse() * expected[&*edge.child];
            prop_assert!(near(edge.parent_from_child, between), "{edge:?} is {between:?}");
        }
    }

    #[test]
    fn merging_moves_no_mass_and_no_shape(robot in robots()) {
        let (model, _) = model_of(&robot);
        let poses = model_from_links(&robot);
        let carried = |link: &&UrdfLink| carrying_link(&model, &link.name).is_some();
        let lost = robot.links.iter().filter(|link| !carried(link)).count();
        if lost > usize::from(robot.links[0].name == "world") {
            return Ok(());
        }
        let mut mass_kg = 0.0;
        let mut moment = DVec3::ZERO;
        let mut balls = 0;
        for link in robot.links.iter().filter(carried) {
            // Links on a movable joint and without mass are not part of its carrier.
            balls += link.collisions.len();
            if let Some(inertial) = &link.inertial {
                let centre = inertial.link_from_inertial.pose().translation;
                mass_kg += inertial.mass_kg;
                moment += inertial.mass_kg * poses[&*link.name].transform_point(centre);
            }
        }
        let sum: f64 = model.links.iter().map(|link| link.inertial.mass_kg).sum();
        let sums: DVec3 = model
            .links
            .iter()
            .map(|link| {
                let centre = link.inertial.link_from_inertial.translation;
                link.inertial.mass_kg * link.model_from_link.transform_point(centre)
            })
            .sum();
        let shapes: usize = model.links.iter().map(|link| link.collisions.len()).sum();
        let massless_part = model.frames.iter().any(|frame| {
            frame.attached_to == "__model__" ||
            robot.joints.iter().any(|joint| joint.name == frame.name && joint.kind != JointType::Fixed)
        });
        if !massless_part {
            prop_assert!((sum - mass_kg).abs() < 1e-9, "{sum} is {mass_kg}");
            prop_assert!(sums.distance(moment) < 1e-8, "{sums} is {moment}");
            prop_assert_eq!(shapes, balls);
        }
    }

    #[test]
    fn a_model_survives_urdf(robot in robots()) {
        let (model, _) = model_of(&robot);
        let mut diagnostics = Diagnostics::new();
        let Some(again) = from_model(&model, &mut diagnostics) else {
            // Only branches without any mass cannot come back.
            prop_assert!(model.links.is_empty(), "{diagnostics:?}");
            return Ok(());
        };
        prop_assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        let (again, _) = model_of(&again);
        prop_assert_eq!(again.links.len(), model.links.len());
        prop_assert_eq!(again.frames.len(), model.frames.len());
        for link in &model.links {
            let other = again.link(&link.name).unwrap();
            prop_assert!(near(link.model_from_link, other.model_from_link));
            prop_assert_eq!(link.gravity, other.gravity);
            prop_assert_eq!(link.self_collide, other.self_collide);
            let names = |link: &periplus_scene::Link| -> Vec<String> {
                let collisions = link.collisions.iter().map(|one| one.name.clone());
                collisions.chain(link.visuals.iter().map(|one| one.name.clone())).collect()
            };
            prop_assert_eq!(names(link), names(other));
            for (one, two) in link.collisions.iter().zip(&other.collisions) {
                prop_assert!(near(one.link_from_collision, two.link_from_collision));
                prop_assert_eq!(&one.surface, &two.surface);
                prop_assert_eq!(&one.shape, &two.shape);
            }
            for (one, two) in link.visuals.iter().zip(&other.visuals) {
                prop_assert!(near(one.link_from_visual, two.link_from_visual));
                prop_assert_eq!(&one.material, &two.material);
            }
            for (one, two) in link.sensors.iter().zip(&other.sensors) {
                prop_assert!(near(one.parent_from_sensor, two.parent_from_sensor));
            }
        }
        for joint in &model.joints {
            let other = again.joint(&joint.name).unwrap();
            prop_assert_eq!((&joint.parent, &joint.child), (&other.parent, &other.child));
            prop_assert_eq!((joint.kind, &joint.axis), (other.kind, &other.axis));
            prop_assert_eq!(&joint.extra, &other.extra);
        }
    }
}
