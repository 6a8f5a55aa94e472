//! Comparison of a scene with the oracle's result.

use periplus_scene::{Collision, DVec3, Joint, Link, Model, Pose, Scene, Sensor, Shape, World};
use serde_json::Value;

const NEAR: f64 = 1e-6;

/// Difference between two scenes.
#[derive(Default)]
pub(crate) struct Differences {
    pub(crate) found: Vec<String>,
    place: Vec<String>,
}

impl Differences {
    fn say(&mut self, what: &str, ours: impl std::fmt::Debug, theirs: impl std::fmt::Debug) {
        let place = self.place.join("/");
        self.found.push(format!("{place}: {what}: ours {ours:?}, theirs {theirs:?}"));
    }

    fn within(&mut self, name: &str, compare: impl FnOnce(&mut Self)) {
        self.place.push(name.to_owned());
        compare(self);
        self.place.pop();
    }

    fn number(&mut self, what: &str, ours: f64, theirs: &Value) {
        let theirs = number(theirs);
        let scale = theirs.abs().max(1.0);
        if !(ours == theirs || (ours - theirs).abs() <= NEAR * scale) {
            self.say(what, ours, theirs);
        }
    }

    fn numbers(&mut self, what: &str, ours: &[f64], theirs: &Value) {
        let theirs: Vec<f64> = list(theirs).iter().map(number).collect();
        let near = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= NEAR * b.abs().max(1.0);
        if ours.len() != theirs.len() || !ours.iter().zip(&theirs).all(near) {
            self.say(what, ours, theirs);
        }
    }

    fn pose(&mut self, what: &str, ours: Pose, theirs: &Value) {
        let Some(pose) = pose(theirs) else { return };
        let (metres, radians) = ours.distance_to(pose);
        let scale = pose.translation.length().max(1.0);
        if !(metres <= NEAR * scale && radians <= NEAR) {
            self.say(what, ours, pose);
        }
    }

    fn text(&mut self, what: &str, ours: &str, theirs: &Value) {
        if theirs.as_str() != Some(ours) {
            self.say(what, ours, theirs);
        }
    }

    /// Compares lists of named things, in order.
    fn named<T>(
        &mut self,
        what: &str,
        ours: &[T],
        theirs: &Value,
        name: impl Fn(&T) -> &str,
        compare: impl Fn(&T, &Value, &mut Self),
    ) {
        let theirs = list(theirs);
        let our_names: Vec<&str> = ours.iter().map(&name).collect();
        let their_names: Vec<&str> = theirs
            .iter()
            .map(|it| it["name"].as_str().or(it.as_str()).unwrap_or_default())
            .collect();
        let (mut ours_sorted, mut theirs_sorted) = (our_names.clone(), their_names.clone());
        ours_sorted.sort_unstable();
        theirs_sorted.sort_unstable();
        if ours_sorted != theirs_sorted {
            self.say(what, our_names, their_names);
            return;
        }
        for one in ours {
            let other =
                theirs.iter().find(|it| it["name"].as_str().or(it.as_str()) == Some(name(one)));
            if let Some(other) = other {
                self.within(name(one), |d| compare(one, other, d));
            }
        }
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap_or(f64::NAN),
        other => other.as_f64().unwrap_or(f64::NAN),
    }
}

fn pose(value: &Value) -> Option<Pose> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(number).collect();
    let [x, y, z, qw, qx, qy, qz] = numbers[..] else { return None };
    let rotation = periplus_geometry::DQuat::from_xyzw(qx, qy, qz, qw);
    Some(Pose { translation: DVec3::new(x, y, z), rotation })
}

pub(crate) fn scene(ours: &Scene, theirs: &Value, d: &mut Differences) {
    d.named("worlds", &ours.worlds, &theirs["worlds"], |it| &it.name, world);
    // libsdformat knows one model, light or actor a file, we all of them.
    let one = |what| list(&theirs[what]).len().min(1);
    let models = &ours.models[..ours.models.len().min(one("models"))];
    d.named("models", models, &theirs["models"], |it| &it.name, model);
    let lights = &ours.lights[..ours.lights.len().min(one("lights"))];
    d.named("lights", lights, &theirs["lights"], |it| &it.name, |_, _, _| {});
    let actors = &ours.actors[..ours.actors.len().min(one("actors"))];
    d.named("actors", actors, &theirs["actors"], |it| &it.name, |_, _, _| {});
}

fn world(ours: &World, theirs: &Value, d: &mut Differences) {
    d.numbers("gravity", &ours.gravity_m_s2.to_array(), &theirs["gravity"]);
    d.named("models", &ours.models, &theirs["models"], |it| &it.name, model);
    d.named("lights", &ours.lights, &theirs["lights"], |it| &it.name, |_, _, _| {});
    d.named("actors", &ours.actors, &theirs["actors"], |it| &it.name, |_, _, _| {});
    d.named("frames", &ours.frames, &theirs["frames"], |it| &it.name, frame);
}

fn frame(ours: &periplus_scene::NamedFrame, theirs: &Value, d: &mut Differences) {
    d.pose("pose", ours.parent_from_frame, &theirs["pose"]);
}

fn model(ours: &Model, theirs: &Value, d: &mut Differences) {
    d.pose("pose", ours.parent_from_model, &theirs["pose"]);
    if theirs["static"] != ours.is_static {
        d.say("static", ours.is_static, &theirs["static"]);
    }
    d.text(
        "canonical link",
        ours.canonical_link.as_deref().unwrap_or(""),
        &theirs["canonical_link"],
    );
    d.named("links", &ours.links, &theirs["links"], |it| &it.name, link);
    d.named(
        "joints",
        &ours.joints,
        &theirs["joints"],
        |it| &it.name,
        |joint, theirs, d| {
            compare_joint(joint, ours, theirs, d);
        },
    );
    d.named("frames", &ours.frames, &theirs["frames"], |it| &it.name, frame);
    d.named("models", &ours.models, &theirs["models"], |it| &it.name, model);
}

fn link(ours: &Link, theirs: &Value, d: &mut Differences) {
    d.pose("pose", ours.model_from_link, &theirs["pose"]);
    d.number("mass", ours.inertial.mass_kg, &theirs["mass"]);
    d.pose("inertial pose", ours.inertial.link_from_inertial, &theirs["inertial_pose"]);
    d.numbers("inertia", &ours.inertial.inertia_kg_m2, &theirs["inertia"]);
    d.named("collisions", &ours.collisions, &theirs["collisions"], |it| &it.name, collision);
    d.named(
        "visuals",
        &ours.visuals,
        &theirs["visuals"],
        |it| &it.name,
        |ours, theirs, d| {
            d.pose("pose", ours.link_from_visual, &theirs["pose"]);
            shape(&ours.shape, &theirs["geometry"], d);
        },
    );
    d.named("sensors", &ours.sensors, &theirs["sensors"], |it| &it.name, sensor);
    d.named("lights", &ours.lights, &theirs["lights"], |it| &it.name, |_, _, _| {});
}

fn collision(ours: &Collision, theirs: &Value, d: &mut Differences) {
    d.pose("pose", ours.link_from_collision, &theirs["pose"]);
    shape(&ours.shape, &theirs["geometry"], d);
}

fn sensor(ours: &Sensor, theirs: &Value, d: &mut Differences) {
    d.pose("pose", ours.parent_from_sensor, &theirs["pose"]);
    d.text("type", &ours.type_name, &theirs["type_xml"]);
    d.number("update rate", ours.update_rate_hz, &theirs["update_rate"]);
}

fn compare_joint(ours: &Joint, model: &Model, theirs: &Value, d: &mut Differences) {
    d.text("parent", &ours.parent, &theirs["parent"]);
    d.text("child", &ours.child, &theirs["child"]);
    if let Some(model_from_child) = pose_in(model, &ours.child, 10) {
        d.pose("pose", model_from_child * ours.child_from_joint, &theirs["pose"]);
    }
    let axes: Vec<_> = ours.axis.iter().chain(&ours.axis2).collect();
    let their_axes = list(&theirs["axes"]);
    if axes.len() != their_axes.len() {
        d.say("axes", axes.len(), their_axes.len());
        return;
    }
    for (axis, theirs) in axes.iter().zip(their_axes) {
        d.numbers("axis", &axis.direction_in_joint.to_array(), &theirs["xyz"]);
        // Theirs are at most 1e16 or 1.8e308, as the file writes it.
        let free = |value: &Value| match number(value) {
            far if far.abs() >= 1e16 => {
                Value::String(if far > 0.0 { "inf" } else { "-inf" }.into())
            }
            _ => value.clone(),
        };
        d.number("lower", axis.lower, &free(&theirs["lower"]));
        d.number("upper", axis.upper, &free(&theirs["upper"]));
        d.number("effort", axis.effort, &theirs["effort"]);
        d.number("velocity", axis.velocity, &theirs["velocity"]);
        d.number("damping", axis.damping, &theirs["damping"]);
        d.number("friction", axis.friction, &theirs["friction"]);
    }
}

/// A frame of a model by its scoped name.
fn pose_in(model: &Model, name: &str, steps: usize) -> Option<Pose> {
    // Joints in broken files may depend on each other.
    let steps = steps.checked_sub(1)?;
    if name == "__model__" {
        return Some(Pose::IDENTITY);
    }
    if let Some(link) = model.link(name) {
        return Some(link.model_from_link);
    }
    if let Some(frame) = model.frames.iter().find(|it| it.name == name) {
        return Some(frame.parent_from_frame);
    }
    if let Some(joint) = model.joint(name) {
        return Some(pose_in(model, &joint.child, steps)? * joint.child_from_joint);
    }
    if let Some(inner) = model.models.iter().find(|it| it.name == name) {
        return Some(inner.parent_from_model);
    }
    let (inner, rest) = name.split_once("::")?;
    let inner = model.models.iter().find(|it| it.name == inner)?;
    Some(inner.parent_from_model * pose_in(inner, rest, steps)?)
}

fn shape(ours: &Shape, theirs: &Value, d: &mut Differences) {
    let name = match ours {
        Shape::Empty => "empty",
        Shape::Box { .. } => "box",
        Shape::Cylinder { .. } => "cylinder",
        Shape::Sphere { .. } => "sphere",
        Shape::Capsule { .. } => "capsule",
        Shape::Cone { .. } => "cone",
        Shape::Ellipsoid { .. } => "ellipsoid",
        Shape::Plane { .. } => "plane",
        Shape::Mesh(_) => "mesh",
        Shape::Polylines(_) => "polyline",
        Shape::Heightmap(_) => "heightmap",
        Shape::Image(_) => "image",
        Shape::Unknown(element) => &element.name,
    };
    let their_name = theirs["type"].as_str().unwrap_or_default();
    if name != their_name && !(name == "empty" && their_name == "none") {
        d.say("shape", name, their_name);
        return;
    }
    match ours {
        Shape::Box { size_m } => d.numbers("size", &size_m.to_array(), &theirs["size"]),
        Shape::Cylinder { radius_m, length_m } | Shape::Capsule { radius_m, length_m } => {
            d.number("radius", *radius_m, &theirs["radius"]);
            d.number("length", *length_m, &theirs["length"]);
        }
        Shape::Sphere { radius_m } => d.number("radius", *radius_m, &theirs["radius"]),
        Shape::Ellipsoid { radii_m } => d.numbers("radii", &radii_m.to_array(), &theirs["radii"]),
        Shape::Plane { normal, size_m } => {
            d.numbers("normal", &normal.to_array(), &theirs["normal"]);
            d.numbers("size", size_m, &theirs["size"]);
        }
        Shape::Mesh(mesh) => {
            // They do not know `<filename>` of SDF 1.2, we do.
            if theirs["uri"] != "__default__" {
                d.text("uri", &mesh.uri, &theirs["uri"]);
            }
            d.numbers("scale", &mesh.scale.to_array(), &theirs["scale"]);
            d.text("submesh", mesh.submesh.as_deref().unwrap_or(""), &theirs["submesh"]);
        }
        Shape::Heightmap(map) => {
            d.text("uri", &map.uri, &theirs["uri"]);
            d.numbers("size", &map.size_m.to_array(), &theirs["size"]);
        }
        _ => {}
    }
}
