//! Links, and the links that were merged into them.

use std::collections::BTreeMap;

use periplus_base::Pose;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{FrameRole, Link as SceneLink, SensorKind};
use periplus_xml::Element;

use super::shape::{self, Rest};
use super::{Export, lost, push_block};
use crate::lump::WORLD;
use crate::robot::{Inertial, Link, Placement, Robot};

/// A link of the URDF to be, and what its shapes have beyond URDF.
struct Made {
    link: Link,
    model_from_link: Pose,
    collisions: Vec<Rest>,
    visuals: Vec<Rest>,
}

impl Made {
    fn new(name: &str, model_from_link: Pose, origin: periplus_diagnostics::Origin) -> Self {
        let link = Link { name: name.to_owned(), origin, ..Link::default() };
        Self { link, model_from_link, collisions: Vec::new(), visuals: Vec::new() }
    }
}

impl Export<'_> {
    /// One link for the world if something hangs on it, for each link, and for each frame.
    pub(super) fn links(&self, robot: &mut Robot, diagnostics: &mut Diagnostics) {
        let mut made: Vec<Made> = Vec::new();
        if self.tree.iter().any(|edge| edge.parent == WORLD) {
            made.push(Made::new(WORLD, Pose::IDENTITY, self.model.origin));
        }
        for link in &self.model.links {
            made.push(Made::new(&link.name, link.model_from_link, link.origin));
        }
        for frame in &self.model.frames {
            if frame.role != FrameRole::MergedJoint {
                made.push(Made::new(&frame.name, frame.parent_from_frame, frame.origin));
            }
        }
        let places: BTreeMap<String, usize> =
            made.iter().enumerate().map(|(place, one)| (one.link.name.clone(), place)).collect();
        let bodies = self.bodies();
        let written: BTreeMap<&str, &Element> = self
            .written
            .named("link")
            .filter_map(|link| Some((link.value("name")?, link)))
            .collect();
        let mut looks = shape::Looks::default();
        for link in &self.model.links {
            let Some(&place) = places.get(&link.name) else { continue };
            made[place].link.inertial = Some(inertial(link, diagnostics));
            let element = written.get(&*link.name).copied();
            let home = |base: &str| {
                let place = *places.get(base)?;
                (bodies.get(base) == Some(&&*link.name)).then_some(place)
            };
            self.shapes(link, element, home, place, &mut made, &mut looks, diagnostics);
            let settings = element.into_iter().flat_map(Element::elements);
            let settings = settings.filter(|part| !KNOWN.contains(&&*part.name)).cloned();
            push_block(robot, Some(&link.name), settings.collect());
        }
        for one in made {
            let name = one.link.name.clone();
            let mut content = Vec::new();
            content.extend(shape::common("collision", &one.collisions, &name, diagnostics));
            content.extend(shape::common("visual", &one.visuals, &name, diagnostics));
            push_block(robot, Some(&name), content);
            robot.links.push(one.link);
        }
    }

    /// The link that carries each merged link, and each link itself.
    fn bodies(&self) -> BTreeMap<&str, &str> {
        let mut bodies: BTreeMap<&str, &str> =
            self.model.links.iter().map(|link| (&*link.name, &*link.name)).collect();
        // Parents come first in the tree.
        for edge in self.tree {
            let merged = self.model.link(&edge.child).is_none();
            if merged && let Some(&body) = bodies.get(&*edge.parent) {
                bodies.insert(&edge.child, body);
            }
        }
        bodies
    }

    /// Gives the shapes of a body back to the links they came from, which their names tell.
    #[allow(clippy::too_many_arguments, reason = "one step of the loop above, split for reading")]
    fn shapes(
        &self,
        link: &SceneLink,
        written: Option<&Element>,
        home: impl Fn(&str) -> Option<usize>,
        own: usize,
        made: &mut [Made],
        looks: &mut shape::Looks,
        diagnostics: &mut Diagnostics,
    ) {
        let parts = |kind: &'static str| written.into_iter().flat_map(move |link| link.named(kind));
        let mut renamed = false;
        for (index, collision) in link.collisions.iter().enumerate() {
            let origin = shape::Source::of(&link.name, &collision.name, "collision", index);
            renamed |= !origin.by_rule;
            let place = home(&origin.base).unwrap_or(own);
            let to = &mut made[place];
            let to_from_head = to.model_from_link.inverse() * link.model_from_link;
            let pose = if place == own {
                collision.link_from_collision
            } else {
                to_from_head * collision.link_from_collision
            };
            let name = origin.name_on(&to.link.name);
            if let Some(shape) = shape::collision(collision, name, pose, diagnostics) {
                to.link.collisions.push(shape);
                to.collisions.push(shape::rest(parts("collision").nth(index)));
            }
        }
        for (index, visual) in link.visuals.iter().enumerate() {
            let origin = shape::Source::of(&link.name, &visual.name, "visual", index);
            let place = home(&origin.base).unwrap_or(own);
            let to = &mut made[place];
            let to_from_head = to.model_from_link.inverse() * link.model_from_link;
            let pose = if place == own {
                visual.link_from_visual
            } else {
                to_from_head * visual.link_from_visual
            };
            let name = origin.name_on(&to.link.name);
            let mut rest = shape::rest(parts("visual").nth(index));
            let look = visual.material.as_ref().and_then(|look| {
                let written = rest.iter_mut().find(|part| part.name == "material");
                looks.of(look, written)
            });
            rest.retain(|part| part.name != "material" || part.elements().next().is_some());
            if let Some(shape) = shape::visual(visual, look, name, pose, diagnostics) {
                to.link.visuals.push(shape);
                to.visuals.push(rest);
            }
        }
        let watched =
            link.sensors.iter().any(|sensor| matches!(sensor.kind, SensorKind::Contact { .. }));
        if renamed && watched {
            diagnostics.push(
                Diagnostic::warning(
                    "renamed-collisions",
                    format!(
                        "Gazebo renames the collisions of a URDF, and a contact sensor on \
                             `{}` names some",
                        link.name
                    ),
                )
                .at(link.origin)
                .note("a collision `NAME` becomes `NAME_collision`, the second `NAME_collision_1`")
                .help("correct the names in the sensor"),
            );
        }
    }
}

/// Parts of a link of SDF that are written otherwise.
const KNOWN: [&str; 4] = ["pose", "inertial", "collision", "visual"];

fn inertial(link: &SceneLink, diagnostics: &mut Diagnostics) -> Inertial {
    let from = &link.inertial;
    if from.auto {
        let what = format!("URDF cannot leave the mass of `{}` to its shapes", link.name);
        diagnostics.push(lost(what).at(link.origin).help("write mass and inertia out"));
    }
    for extra in &from.extra {
        let what = format!("URDF cannot say `{}` of `{}`", extra.name, link.name);
        diagnostics.push(lost(what).at(extra.origin));
    }
    Inertial {
        link_from_inertial: Placement::from_pose(from.link_from_inertial),
        mass_kg: from.mass_kg,
        inertia_kg_m2: from.inertia_kg_m2,
        origin: link.origin,
        ..Inertial::default()
    }
}
