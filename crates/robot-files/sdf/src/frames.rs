//! Resolution of frames: from poses relative to named frames to poses relative to fixed parents.
//!
//! The rules are SDF's ("Pose Frame Semantics", SDF 1.7 and later): without `relative_to`, the pose of a
//! link, a frame or a nested model is relative to its model, that of a frame with `attached_to` to that
//! frame, that of a joint to its child, that of a part of a link to the link. Names inside a nested model
//! are `model::name`. Only names of the same model and of models nested in it are visible.

mod body;
mod graph;
mod names;
mod scope;

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Diagnostics};
use periplus_geometry::Pose;
use periplus_scene::{Actor, Joint, Light, Model, World};

use crate::draft::{ActorDraft, FrameDraft, JointDraft, LightDraft, ModelDraft, WorldDraft};
use crate::pose::Reference;
use graph::{Base, Vertex};
pub(crate) use scope::Scope;

/// Model with resolved content; its own pose is as written.
pub(crate) struct ResolvedModel {
    pub(crate) model: Model,
    scope: Scope,
    relative_to: Option<Reference>,
    placement_frame: Option<Reference>,
}

impl ResolvedModel {
    /// Placement frame in the model frame.
    pub(crate) fn model_from_placement(&self, diagnostics: &mut Diagnostics) -> Pose {
        let Some(frame) = &self.placement_frame else { return Pose::IDENTITY };
        self.scope.parent_from(&frame.name).unwrap_or_else(|| {
            scope::report_unknown(frame, &self.scope, diagnostics);
            Pose::IDENTITY
        })
    }

    /// Resolves a model at the top of a file.
    pub(crate) fn stand_alone(mut self, diagnostics: &mut Diagnostics) -> Model {
        if let Some(frame) = &self.relative_to
            && frame.name != "world"
        {
            scope::report_unknown(frame, &Scope::new("world"), diagnostics);
        }
        let placement = self.model_from_placement(diagnostics);
        self.model.parent_from_model = placed_by(self.model.parent_from_model, placement);
        self.model
    }
}

/// Pose of a model whose placement frame is at `pose`.
fn placed_by(pose: Pose, model_from_placement: Pose) -> Pose {
    if model_from_placement == Pose::IDENTITY {
        return pose;
    }
    pose * model_from_placement.inverse()
}

/// Resolves the content of a model.
pub(crate) fn resolve_model(mut draft: ModelDraft, diagnostics: &mut Diagnostics) -> ResolvedModel {
    names::make_unique(&mut draft, diagnostics);
    let mut model = draft.model;
    let mut scope = Scope::new("__model__");
    let mut nested = Vec::new();
    for inner in draft.models {
        let mut resolved = resolve_model(inner, diagnostics);
        let placement = resolved.model_from_placement(diagnostics);
        resolved.model.parent_from_model = placed_by(resolved.model.parent_from_model, placement);
        nested.push(resolved);
    }
    let mut vertices = Vec::new();
    for link in &draft.links {
        vertices.push(Vertex::new(
            &link.link.name,
            link.link.model_from_link,
            Base::or_root(&link.relative_to),
        ));
    }
    for inner in &nested {
        vertices.push(Vertex {
            inside: Some(&inner.scope),
            ..Vertex::new(
                &inner.model.name,
                inner.model.parent_from_model,
                Base::or_root(&inner.relative_to),
            )
        });
    }
    push_frames_and_joints(&mut vertices, &draft.frames, &draft.joints);
    let poses = graph::resolve(&scope, &vertices, diagnostics);
    scope.fill(&vertices, &poses);
    attachments(&scope, &draft.frames, &draft.joints, &vertices, diagnostics);

    let mut poses = poses.into_iter();
    let mut pose = || poses.next().unwrap_or_default();
    for link in &mut draft.links {
        link.link.model_from_link = pose();
    }
    for inner in &mut nested {
        inner.model.parent_from_model = pose();
    }
    model.models = Vec::with_capacity(nested.len());
    for inner in nested {
        scope.nest(&inner.model.name, inner.scope);
        model.models.push(inner.model);
    }
    model.frames = place_frames(draft.frames, "__model__", &mut pose);
    model.joints = place_joints(draft.joints, &scope, &mut pose, diagnostics);
    for link in draft.links {
        model.links.push(body::place_link(link, &scope, diagnostics));
    }
    model.canonical_link = canonical_link(&model, draft.canonical_link, &scope, diagnostics);
    ResolvedModel {
        model,
        scope,
        relative_to: draft.relative_to,
        placement_frame: draft.placement_frame,
    }
}

fn push_frames_and_joints<'a>(
    vertices: &mut Vec<Vertex<'a>>,
    frames: &'a [FrameDraft],
    joints: &'a [JointDraft],
) {
    for frame in frames {
        let base = frame.relative_to.as_ref().or(frame.attached_to.as_ref());
        let local = frame.frame.parent_from_frame;
        vertices.push(Vertex::new(&frame.frame.name, local, base.map_or(Base::Root, Base::Frame)));
    }
    for joint in joints {
        let base = joint.relative_to.as_ref().unwrap_or(&joint.child);
        vertices.push(Vertex::new(
            &joint.joint.name,
            joint.joint.child_from_joint,
            Base::Frame(base),
        ));
    }
}

/// Reports frames that are attached in a circle or to nothing although their poses can be resolved.
fn attachments(
    scope: &Scope,
    frames: &[FrameDraft],
    joints: &[JointDraft],
    placed: &[Vertex<'_>],
    diagnostics: &mut Diagnostics,
) {
    let hidden = |frame: &FrameDraft| frame.relative_to.is_some() && frame.attached_to.is_some();
    if !frames.iter().any(hidden) && !joints.iter().any(|joint| joint.relative_to.is_some()) {
        return;
    }
    let first_frame = placed.len() - frames.len() - joints.len();
    let mut vertices: Vec<Vertex<'_>> = placed[..first_frame]
        .iter()
        .map(|vertex| Vertex { base: Base::Root, ..vertex.clone() })
        .collect();
    for frame in frames {
        let base = frame.attached_to.as_ref().map_or(Base::Root, Base::Frame);
        vertices.push(Vertex::new(&frame.frame.name, Pose::IDENTITY, base));
    }
    for joint in joints {
        vertices.push(Vertex::new(&joint.joint.name, Pose::IDENTITY, Base::Frame(&joint.child)));
    }
    graph::resolve(scope, &vertices, diagnostics);
}

fn place_frames(
    drafts: Vec<FrameDraft>,
    root: &str,
    pose: &mut impl FnMut() -> Pose,
) -> Vec<periplus_scene::NamedFrame> {
    drafts
        .into_iter()
        .map(|draft| {
            let mut frame = draft.frame;
            frame.parent_from_frame = pose();
            frame.attached_to =
                draft.attached_to.map_or_else(|| root.to_owned(), |it| it.name.to_string());
            frame
        })
        .collect()
}

fn place_joints(
    drafts: Vec<JointDraft>,
    scope: &Scope,
    pose: &mut impl FnMut() -> Pose,
    diagnostics: &mut Diagnostics,
) -> Vec<Joint> {
    drafts
        .into_iter()
        .map(|draft| {
            let model_from_joint = pose();
            body::place_joint(draft, model_from_joint, scope, diagnostics)
        })
        .collect()
}

/// Canonical link: the link that the file names, or else the first one, a model's own links before those of
/// nested models.
fn canonical_link(
    model: &Model,
    named: Option<Reference>,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let first = first_link(model);
    if let Some(named) = named {
        if has_link(model, &named.name) {
            return Some(named.name.to_string());
        }
        let finding = Diagnostic::error(
            "unknown-frame",
            format!("model `{}` has no link `{}` to be canonical", model.name, named.name),
        );
        diagnostics.push(scope::with_candidates(finding.at(named.origin), &named, scope));
    } else if first.is_none() && !model.is_static {
        diagnostics.push(
            Diagnostic::warning("no-links", format!("model `{}` has no link", model.name))
                .caused_by(DiagnosticCause::NoLinks)
                .at(model.origin)
                .note("Gazebo refuses a model without links unless it is static"),
        );
    }
    first
}

/// First link of a model, its own before those of nested models; scoped name.
pub(crate) fn first_link(model: &Model) -> Option<String> {
    if let Some(link) = model.links.first() {
        return Some(link.name.clone());
    }
    model
        .models
        .iter()
        .find_map(|inner| first_link(inner).map(|link| format!("{}::{link}", inner.name)))
}

fn has_link(model: &Model, name: &str) -> bool {
    model.links.iter().any(|link| link.name == name)
        || model.models.iter().any(|inner| {
            name.strip_prefix(&*inner.name)
                .and_then(|rest| rest.strip_prefix("::"))
                .is_some_and(|rest| has_link(inner, rest))
        })
}

/// Resolves the content of a world.
pub(crate) fn resolve_world(mut draft: WorldDraft, diagnostics: &mut Diagnostics) -> World {
    names::make_unique_in_world(&mut draft, diagnostics);
    let mut world = draft.world;
    let mut scope = Scope::new("world");
    let mut nested = Vec::with_capacity(draft.models.len());
    for inner in draft.models {
        let mut resolved = resolve_model(inner, diagnostics);
        let placement = resolved.model_from_placement(diagnostics);
        resolved.model.parent_from_model = placed_by(resolved.model.parent_from_model, placement);
        nested.push(resolved);
    }
    let mut vertices: Vec<Vertex<'_>> = nested
        .iter()
        .map(|inner| Vertex {
            inside: Some(&inner.scope),
            ..Vertex::new(
                &inner.model.name,
                inner.model.parent_from_model,
                Base::or_root(&inner.relative_to),
            )
        })
        .collect();
    push_frames_and_joints(&mut vertices, &draft.frames, &draft.joints);
    let poses = graph::resolve(&scope, &vertices, diagnostics);
    scope.fill(&vertices, &poses);
    attachments(&scope, &draft.frames, &draft.joints, &vertices, diagnostics);

    let mut poses = poses.into_iter();
    let mut pose = || poses.next().unwrap_or_default();
    for inner in &mut nested {
        inner.model.parent_from_model = pose();
    }
    for inner in nested {
        scope.nest(&inner.model.name, inner.scope);
        world.models.push(inner.model);
    }
    world.frames = place_frames(draft.frames, "world", &mut pose);
    world.joints = place_joints(draft.joints, &scope, &mut pose, diagnostics);
    for light in draft.lights {
        world.lights.push(place_light(light, &scope, diagnostics));
    }
    for actor in draft.actors {
        world.actors.push(place_actor(actor, &scope, diagnostics));
    }
    world
}

/// Resolves a light at the top of a file.
pub(crate) fn resolve_light(draft: LightDraft, diagnostics: &mut Diagnostics) -> Light {
    place_light(draft, &Scope::new("world"), diagnostics)
}

/// Resolves an actor at the top of a file.
pub(crate) fn resolve_actor(draft: ActorDraft, diagnostics: &mut Diagnostics) -> Actor {
    place_actor(draft, &Scope::new("world"), diagnostics)
}

fn place_light(draft: LightDraft, scope: &Scope, diagnostics: &mut Diagnostics) -> Light {
    let mut light = draft.light;
    let base = scope.base(&draft.relative_to, diagnostics);
    light.parent_from_light = base * light.parent_from_light;
    light
}

fn place_actor(draft: ActorDraft, scope: &Scope, diagnostics: &mut Diagnostics) -> Actor {
    let mut actor = draft.actor;
    let base = scope.base(&draft.relative_to, diagnostics);
    actor.world_from_actor = base * actor.world_from_actor;
    // The links of an actor form their own model.
    let mut model = ModelDraft::from_model(Model::new(actor.name.clone()));
    model.model.is_static = true;
    model.links = draft.links;
    model.joints = draft.joints;
    let model = resolve_model(model, diagnostics).model;
    actor.links = model.links;
    actor.joints = model.joints;
    actor
}
