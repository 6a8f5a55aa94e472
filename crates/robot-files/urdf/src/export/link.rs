//! Links, including those that were merged.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Pose;
use periplus_scene::{FrameRole, Link as SceneLink, SensorKind};
use periplus_xml::Element;

use super::shape::{self, Rest, Source};
use super::{Export, lost, push_block};
use crate::lump::WORLD;
use crate::robot::{UrdfInertial, UrdfLink, UrdfMaterial, UrdfOrigin, UrdfRobot};

/// Link of the resulting URDF, with the data of its shapes that URDF cannot express.
struct ExportedLink {
    link: UrdfLink,
    model_from_link: Pose,
    collisions: Vec<Rest>,
    visuals: Vec<Rest>,
}

impl ExportedLink {
    fn new(name: &str, model_from_link: Pose, origin: Origin) -> Self {
        let link = UrdfLink { name: name.to_owned(), origin, ..UrdfLink::default() };
        Self { link, model_from_link, collisions: Vec::new(), visuals: Vec::new() }
    }

    /// Body frame in this link's frame; exactly the same for the body's own link.
    fn link_from_body(&self, body: &SceneLink) -> Pose {
        if self.link.name == body.name {
            Pose::IDENTITY
        } else {
            self.model_from_link.inverse() * body.model_from_link
        }
    }
}

/// Link that may receive shapes of a body.
#[derive(Clone, Copy)]
struct CandidateLink<'a> {
    name: &'a str,
    /// Index among the links of the URDF.
    place: usize,
}

impl Export<'_> {
    /// One link for the world if it has children, for each link, and for each frame.
    pub(super) fn links(&self, robot: &mut UrdfRobot, diagnostics: &mut Diagnostics) {
        let mut made: Vec<ExportedLink> = Vec::new();
        if self.tree.iter().any(|edge| edge.parent == WORLD) {
            made.push(ExportedLink::new(WORLD, Pose::IDENTITY, self.model.origin));
        }
        for link in &self.model.links {
            made.push(ExportedLink::new(&link.name, link.model_from_link, link.origin));
        }
        for frame in &self.model.frames {
            if frame.role != FrameRole::MergedJoint {
                made.push(ExportedLink::new(&frame.name, frame.parent_from_frame, frame.origin));
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
        let mut looks = shape::ExportedMaterials::default();
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

    /// Links of each body, in Gazebo's order.
    fn members<'p>(
        &'p self,
        places: &BTreeMap<String, usize>,
    ) -> BTreeMap<&'p str, Vec<CandidateLink<'p>>> {
        let above: BTreeMap<&str, &str> =
            self.tree.iter().map(|edge| (&*edge.child, &*edge.parent)).collect();
        let links: BTreeSet<&str> = self.model.links.iter().map(|link| &*link.name).collect();
        let mut bodies: BTreeMap<&str, &str> = BTreeMap::new();
        let mut members: BTreeMap<&str, Vec<CandidateLink<'_>>> = BTreeMap::new();
        for name in self.order() {
            let body = match above.get(name).and_then(|above| bodies.get(above)) {
                Some(&body) if !links.contains(name) => body,
                _ => name,
            };
            bodies.insert(name, body);
            if let Some(&place) = places.get(name) {
                members.entry(body).or_default().push(CandidateLink { name, place });
            }
        }
        members
    }

    /// Order in which Gazebo visits links: parents first, children by the name of their joint.
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

/// Assigns the collisions of a body to the links that they came from.
fn collisions(
    body: &SceneLink,
    written: Option<&Element>,
    members: &[CandidateLink<'_>],
    made: &mut [ExportedLink],
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
    let places = links_of_shapes(&sources, &rests, members);
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

/// Assigns the visuals of a body to the links that they came from.
fn visuals(
    body: &SceneLink,
    written: Option<&Element>,
    members: &[CandidateLink<'_>],
    made: &mut [ExportedLink],
    looks: &mut shape::ExportedMaterials,
    diagnostics: &mut Diagnostics,
) {
    let parts = written.into_iter().flat_map(|link| link.named("visual"));
    let mut rests: Vec<Rest> = parts.map(shape::rest).collect();
    let mut painted: Vec<Option<UrdfMaterial>> = Vec::new();
    for (visual, rest) in body.visuals.iter().zip(&mut rests) {
        painted.push(visual.material.as_ref().and_then(|look| {
            let written = rest.iter_mut().find(|part| part.name == "material");
            looks.of(look, written)
        }));
        rest.retain(|part| part.name != "material" || part.elements().next().is_some());
    }
    let names = body.visuals.iter().map(|visual| &*visual.name);
    let sources = shape::sources(&body.name, names, "visual");
    let places = links_of_shapes(&sources, &rests, members);
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

/// Link of each shape of a body. Gazebo numbers shapes in the order of the links, so indices never
/// decrease. A shape whose name does not identify its link goes to the first link whose shapes have the
/// same settings.
fn links_of_shapes(
    sources: &[Source],
    rests: &[Rest],
    members: &[CandidateLink<'_>],
) -> Vec<usize> {
    let ranks: BTreeMap<&str, usize> =
        members.iter().enumerate().map(|(rank, home)| (home.name, rank)).collect();
    let known: Vec<Option<usize>> =
        sources.iter().map(|source| ranks.get(&*source.base).copied()).collect();
    // Next identified link, from the back.
    let mut next = vec![members.len().saturating_sub(1); known.len() + 1];
    for index in (0..known.len()).rev() {
        next[index] = known[index].unwrap_or(next[index + 1]);
    }
    let mut first: BTreeMap<usize, &Rest> = BTreeMap::new();
    let mut here = 0;
    let mut chosen = Vec::new();
    for (index, rest) in rests.iter().enumerate() {
        here = known[index].filter(|rank| *rank >= here).unwrap_or_else(|| {
            let fits = |rank: &usize| first.get(rank).is_none_or(|first| *first == rest);
            (here..=next[index].max(here)).find(fits).unwrap_or(here)
        });
        first.entry(here).or_insert(rest);
        chosen.push(members.get(here).map_or(0, |home| home.place));
    }
    chosen
}

/// Children of an SDF link that are written differently.
const KNOWN: [&str; 4] = ["pose", "inertial", "collision", "visual"];

fn inertial(link: &SceneLink, diagnostics: &mut Diagnostics) -> UrdfInertial {
    let from = &link.inertial;
    if from.auto {
        let what = format!("URDF cannot compute the mass of `{}` from its shapes", link.name);
        diagnostics.push(lost(what).at(link.origin).help("write mass and inertia out"));
    }
    for extra in &from.extra {
        let what = format!("URDF has no `{}` for `{}`", extra.name, link.name);
        diagnostics.push(lost(what).at(extra.origin));
    }
    UrdfInertial {
        link_from_inertial: UrdfOrigin::from_pose(from.link_from_inertial),
        mass_kg: from.mass_kg,
        inertia_kg_m2: from.inertia_kg_m2,
        origin: link.origin,
        ..UrdfInertial::default()
    }
}
