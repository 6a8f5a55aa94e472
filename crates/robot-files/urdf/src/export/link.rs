//! Links, and the links that were merged into them.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Pose;
use periplus_scene::{FrameRole, Link as SceneLink, SensorKind};
use periplus_xml::Element;

use super::shape::{self, Rest, Source};
use super::{Export, lost, push_block};
use crate::lump::WORLD;
use crate::robot::{Inertial, Link, Material, Placement, Robot};

/// A link of the URDF to be, and what its shapes have beyond URDF.
struct Made {
    link: Link,
    model_from_link: Pose,
    collisions: Vec<Rest>,
    visuals: Vec<Rest>,
}

impl Made {
    fn new(name: &str, model_from_link: Pose, origin: Origin) -> Self {
        let link = Link { name: name.to_owned(), origin, ..Link::default() };
        Self { link, model_from_link, collisions: Vec::new(), visuals: Vec::new() }
    }

    /// The body's frame in this link's; for the body's own link exactly the same.
    fn link_from_body(&self, body: &SceneLink) -> Pose {
        if self.link.name == body.name {
            Pose::IDENTITY
        } else {
            self.model_from_link.inverse() * body.model_from_link
        }
    }
}

/// A link that may take shapes of a body.
#[derive(Clone, Copy)]
struct Home<'a> {
    name: &'a str,
    /// Where it stands among the links of the URDF.
    place: usize,
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
        let members = self.members(&places);
        let written: BTreeMap<&str, &Element> = self
            .written
            .named("link")
            .filter_map(|link| Some((link.value("name")?, link)))
            .collect();
        let mut looks = shape::Looks::default();
        for link in &self.model.links {
            let Some(members) = members.get(&*link.name) else { continue };
            let element = written.get(&*link.name).copied();
            if let Some(&place) = places.get(&link.name) {
                made[place].link.inertial = Some(inertial(link, diagnostics));
            }
            collisions(link, element, members, &mut made, diagnostics);
            visuals(link, element, members, &mut made, &mut looks, diagnostics);
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

    /// The links of each body, in the order in which Gazebo comes to them.
    fn members<'p>(&'p self, places: &BTreeMap<String, usize>) -> BTreeMap<&'p str, Vec<Home<'p>>> {
        let above: BTreeMap<&str, &str> =
            self.tree.iter().map(|edge| (&*edge.child, &*edge.parent)).collect();
        let links: BTreeSet<&str> = self.model.links.iter().map(|link| &*link.name).collect();
        let mut bodies: BTreeMap<&str, &str> = BTreeMap::new();
        let mut members: BTreeMap<&str, Vec<Home<'_>>> = BTreeMap::new();
        for name in self.order() {
            let body = match above.get(name).and_then(|above| bodies.get(above)) {
                Some(&body) if !links.contains(name) => body,
                _ => name,
            };
            bodies.insert(name, body);
            if let Some(&place) = places.get(name) {
                members.entry(body).or_default().push(Home { name, place });
            }
        }
        members
    }

    /// The order in which Gazebo goes through links: parents first, children by name of joint.
    fn order(&self) -> Vec<&str> {
        let mut below: BTreeMap<&str, Vec<(&str, &str)>> = BTreeMap::new();
        for edge in self.tree {
            let joint = self.joint_above.get(&*edge.child).map_or("", String::as_str);
            below.entry(&edge.parent).or_default().push((joint, &edge.child));
        }
        let root = if below.contains_key(WORLD) { Some(WORLD) } else { self.root() };
        let mut order = Vec::new();
        let mut open: Vec<&str> = root.into_iter().collect();
        while let Some(link) = open.pop() {
            order.push(link);
            let mut children = below.remove(link).unwrap_or_default();
            children.sort_unstable_by(|a, b| b.cmp(a));
            open.extend(children.into_iter().map(|(_, child)| child));
        }
        order
    }
}

/// Gives the collisions of a body back to the links they came from.
fn collisions(
    body: &SceneLink,
    written: Option<&Element>,
    members: &[Home<'_>],
    made: &mut [Made],
    diagnostics: &mut Diagnostics,
) {
    let parts = written.into_iter().flat_map(|link| link.named("collision"));
    let rests: Vec<Rest> = parts.map(shape::rest).collect();
    let names = body.collisions.iter().map(|collision| &*collision.name);
    let sources = shape::sources(&body.name, names, "collision");
    let renamed = sources.iter().any(|source| !source.by_rule);
    let watches =
        body.sensors.iter().any(|sensor| matches!(sensor.kind, SensorKind::Contact { .. }));
    if renamed && watches {
        let name = &body.name;
        diagnostics.push(
            Diagnostic::warning(
                "renamed-collisions",
                format!(
                    "Gazebo renames collisions of a URDF, and a contact sensor on `{name}` \
                         may name one"
                ),
            )
            .at(body.origin)
            .note("a collision `NAME` becomes `NAME_collision`, the second `NAME_collision_1`")
            .help("correct the names in the sensor"),
        );
    }
    let places = homes(&sources, &rests, members);
    for (((collision, source), rest), place) in
        body.collisions.iter().zip(sources).zip(rests).zip(places)
    {
        let to = &mut made[place];
        let pose = to.link_from_body(body) * collision.link_from_collision;
        let name = source.name_on(&to.link.name);
        if let Some(shape) = shape::collision(collision, name, pose, diagnostics) {
            to.link.collisions.push(shape);
            to.collisions.push(rest);
        }
    }
}

/// Gives the visuals of a body back to the links they came from.
fn visuals(
    body: &SceneLink,
    written: Option<&Element>,
    members: &[Home<'_>],
    made: &mut [Made],
    looks: &mut shape::Looks,
    diagnostics: &mut Diagnostics,
) {
    let parts = written.into_iter().flat_map(|link| link.named("visual"));
    let mut rests: Vec<Rest> = parts.map(shape::rest).collect();
    let mut painted: Vec<Option<Material>> = Vec::new();
    for (visual, rest) in body.visuals.iter().zip(&mut rests) {
        painted.push(visual.material.as_ref().and_then(|look| {
            let written = rest.iter_mut().find(|part| part.name == "material");
            looks.of(look, written)
        }));
        rest.retain(|part| part.name != "material" || part.elements().next().is_some());
    }
    let names = body.visuals.iter().map(|visual| &*visual.name);
    let sources = shape::sources(&body.name, names, "visual");
    let places = homes(&sources, &rests, members);
    for ((((visual, source), rest), look), place) in
        body.visuals.iter().zip(sources).zip(rests).zip(painted).zip(places)
    {
        let to = &mut made[place];
        let pose = to.link_from_body(body) * visual.link_from_visual;
        let name = source.name_on(&to.link.name);
        if let Some(shape) = shape::visual(visual, look, name, pose, diagnostics) {
            to.link.visuals.push(shape);
            to.visuals.push(rest);
        }
    }
}

/// The link for each shape of a body. Gazebo numbers shapes in the order of the links, so the
/// links never go back. A shape whose name does not tell its link goes to the first whose shapes
/// have the same settings.
fn homes(sources: &[Source], rests: &[Rest], members: &[Home<'_>]) -> Vec<usize> {
    let ranks: BTreeMap<&str, usize> =
        members.iter().enumerate().map(|(rank, home)| (home.name, rank)).collect();
    let told: Vec<Option<usize>> =
        sources.iter().map(|source| ranks.get(&*source.base).copied()).collect();
    // The next link that is told, from the back.
    let mut next = vec![members.len().saturating_sub(1); told.len() + 1];
    for index in (0..told.len()).rev() {
        next[index] = told[index].unwrap_or(next[index + 1]);
    }
    let mut first: BTreeMap<usize, &Rest> = BTreeMap::new();
    let mut here = 0;
    let mut chosen = Vec::new();
    for (index, rest) in rests.iter().enumerate() {
        here = told[index].filter(|rank| *rank >= here).unwrap_or_else(|| {
            let fits = |rank: &usize| first.get(rank).is_none_or(|first| *first == rest);
            (here..=next[index].max(here)).find(fits).unwrap_or(here)
        });
        first.entry(here).or_insert(rest);
        chosen.push(members.get(here).map_or(0, |home| home.place));
    }
    chosen
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
