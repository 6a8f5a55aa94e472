//! Models and worlds before their frames are resolved: every pose is as written, next to the frame that it
//! is relative to.

use periplus_diagnostics::Origin;
use periplus_scene::{Actor, Joint, Light, Link, Model, NamedFrame, World};

use crate::pose::Reference;

/// Part of a link or joint whose pose is relative to a named frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part {
    Collision(usize),
    Visual(usize),
    Sensor(usize),
    /// Index of the sensor, and of its camera.
    Camera(usize, usize),
    Light(usize),
}

#[derive(Clone, Debug)]
pub(crate) struct LinkDraft {
    pub(crate) link: Link,
    pub(crate) relative_to: Option<Reference>,
    pub(crate) parts: Vec<(Part, Reference)>,
}

#[derive(Clone, Debug)]
pub(crate) struct JointDraft {
    pub(crate) joint: Joint,
    pub(crate) relative_to: Option<Reference>,
    pub(crate) parent: Reference,
    pub(crate) child: Reference,
    /// Frames in which the directions of the two axes are expressed.
    pub(crate) expressed_in: [Option<Reference>; 2],
    pub(crate) parts: Vec<(Part, Reference)>,
}

#[derive(Clone, Debug)]
pub(crate) struct FrameDraft {
    pub(crate) frame: NamedFrame,
    pub(crate) relative_to: Option<Reference>,
    pub(crate) attached_to: Option<Reference>,
}

/// Model; the lists of `model` are empty until its frames are resolved.
#[derive(Clone, Debug)]
pub(crate) struct ModelDraft {
    pub(crate) model: Model,
    pub(crate) relative_to: Option<Reference>,
    pub(crate) placement_frame: Option<Reference>,
    pub(crate) canonical_link: Option<Reference>,
    pub(crate) links: Vec<LinkDraft>,
    pub(crate) joints: Vec<JointDraft>,
    pub(crate) frames: Vec<FrameDraft>,
    pub(crate) models: Vec<Self>,
    /// Before SDF 1.7 a link and a joint could share a name.
    pub(crate) lenient_names: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct LightDraft {
    pub(crate) light: Light,
    pub(crate) relative_to: Option<Reference>,
}

#[derive(Clone, Debug)]
pub(crate) struct ActorDraft {
    pub(crate) actor: Actor,
    pub(crate) relative_to: Option<Reference>,
    pub(crate) links: Vec<LinkDraft>,
    pub(crate) joints: Vec<JointDraft>,
}

/// World; the lists of `world` that are repeated here are empty until its frames are resolved.
#[derive(Clone, Debug)]
pub(crate) struct WorldDraft {
    pub(crate) world: World,
    pub(crate) frames: Vec<FrameDraft>,
    pub(crate) models: Vec<ModelDraft>,
    pub(crate) joints: Vec<JointDraft>,
    pub(crate) lights: Vec<LightDraft>,
    pub(crate) actors: Vec<ActorDraft>,
}

impl ModelDraft {
    /// Converts a resolved model back to an equivalent draft.
    pub(crate) fn from_model(mut model: Model) -> Self {
        let reference = |name: &str, origin: Origin| Reference { name: name.into(), origin };
        let links = std::mem::take(&mut model.links)
            .into_iter()
            .map(|link| LinkDraft { link, relative_to: None, parts: Vec::new() })
            .collect();
        let joints = std::mem::take(&mut model.joints)
            .into_iter()
            .map(|joint| JointDraft {
                relative_to: None,
                parent: reference(&joint.parent, joint.origin),
                child: reference(&joint.child, joint.origin),
                expressed_in: [None, None],
                parts: Vec::new(),
                joint,
            })
            .collect();
        let frames = std::mem::take(&mut model.frames)
            .into_iter()
            .map(|frame| FrameDraft {
                relative_to: Some(reference("__model__", frame.origin)),
                attached_to: Some(reference(&frame.attached_to, frame.origin)),
                frame,
            })
            .collect();
        let models = std::mem::take(&mut model.models).into_iter().map(Self::from_model).collect();
        let canonical_link = model.canonical_link.take().map(|name| reference(&name, model.origin));
        Self {
            model,
            relative_to: None,
            placement_frame: None,
            canonical_link,
            links,
            joints,
            frames,
            models,
            lenient_names: false,
        }
    }
}
