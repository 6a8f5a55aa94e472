//! Records of a world in the order of insertion. The engine holds the motion.

use std::ops::Range;

use periplus_geometry::Pose;
use rapier3d_f64::geometry::ColliderBuilder;
use rapier3d_f64::parry::mass_properties::MassProperties;

use crate::anisotropic_friction::AnisotropicFriction;
use crate::joints::{AxisRecord, Constraint};

/// The body of the world, to which joints can be attached.
pub(crate) const WORLD_BODY_INDEX: usize = 0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BodyKind {
    Fixed,
    Kinematic,
    Dynamic,
}

/// A rigid body: one link, or several on fixed joints. Its frame is that of the first link.
#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) kind: BodyKind,
    pub(crate) world_from_body: Pose,
    pub(crate) mass: MassProperties,
    /// Mass that gravity acts on [kg].
    pub(crate) weight_share: f64,
    pub(crate) damping: [f64; 2],
    pub(crate) can_sleep: bool,
    pub(crate) colliders: Vec<ColliderBuilder>,
    /// Colliders with anisotropic friction.
    pub(crate) anisotropic_colliders: Vec<(usize, AnisotropicFriction)>,
    /// True after the removal of its model.
    pub(crate) removed: bool,
}

impl Body {
    /// Returns the body of the world.
    fn world() -> Self {
        Self {
            name: "world".into(),
            kind: BodyKind::Fixed,
            world_from_body: Pose::IDENTITY,
            mass: MassProperties::default(),
            weight_share: 0.0,
            damping: [0.0; 2],
            can_sleep: true,
            colliders: Vec::new(),
            anisotropic_colliders: Vec::new(),
            removed: false,
        }
    }
}

#[derive(Clone)]
pub(crate) struct LinkRecord {
    pub(crate) model: u32,
    pub(crate) name: String,
    pub(crate) body: usize,
    pub(crate) body_from_link: Pose,
    pub(crate) collisions: Vec<String>,
    /// Stiffness of the contacts of each collision [N/m]; `None` for the solver's own.
    pub(crate) stiffness_n_m: Vec<Option<f64>>,
}

#[derive(Clone)]
pub(crate) struct JointRecord {
    pub(crate) model: u32,
    pub(crate) name: String,
    pub(crate) axes: Range<usize>,
}

#[derive(Clone)]
pub(crate) struct ModelRecord {
    pub(crate) name: String,
    pub(crate) world_from_model: Pose,
    pub(crate) links: Range<u32>,
    pub(crate) joints: Range<u32>,
    pub(crate) bodies: Range<u32>,
    pub(crate) canonical: u32,
    pub(crate) removed: bool,
}

/// All records, from which a reset starts. Records are never deleted, so indices stay valid.
#[derive(Clone)]
pub(crate) struct Records {
    pub(crate) models: Vec<ModelRecord>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) links: Vec<LinkRecord>,
    pub(crate) joints: Vec<JointRecord>,
    pub(crate) axes: Vec<AxisRecord>,
    pub(crate) constraints: Vec<Constraint>,
    /// Model of each link, for the contact filter.
    pub(crate) model_of_link: Vec<u32>,
}

impl Records {
    /// Returns the records of an empty world.
    pub(crate) fn new() -> Self {
        Self {
            models: Vec::new(),
            bodies: vec![Body::world()],
            links: Vec::new(),
            joints: Vec::new(),
            axes: Vec::new(),
            constraints: Vec::new(),
            model_of_link: Vec::new(),
        }
    }

    pub(crate) fn present(&self, model: u32) -> Option<&ModelRecord> {
        self.models.get(model as usize).filter(|model| !model.removed)
    }

    /// Returns the body that carries a model's frame, and the frame in it.
    pub(crate) fn canonical(&self, model: u32) -> Option<(usize, Pose)> {
        let record = self.present(model)?;
        let body = self.links.get(record.canonical as usize)?.body;
        let body_from_world = self.bodies[body].world_from_body.inverse();
        Some((body, body_from_world * record.world_from_model))
    }

    /// Returns the indices of the bodies of a present model.
    pub(crate) fn bodies_of(&self, model: u32) -> Range<usize> {
        self.present(model)
            .map_or(0..0, |model| model.bodies.start as usize..model.bodies.end as usize)
    }

    /// Returns the model of a body; `None` for the world's body and for removed models.
    pub(crate) fn model_of_body(&self, body: usize) -> Option<u32> {
        (0..self.models.len() as u32).find(|&model| self.bodies_of(model).contains(&body))
    }

    /// Returns the current counts, for [`Self::truncate`].
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            bodies: self.bodies.len(),
            links: self.links.len(),
            joints: self.joints.len(),
            axes: self.axes.len(),
            constraints: self.constraints.len(),
        }
    }

    /// Truncates the records to a mark.
    pub(crate) fn truncate(&mut self, mark: Mark) {
        self.bodies.truncate(mark.bodies);
        self.links.truncate(mark.links);
        self.joints.truncate(mark.joints);
        self.axes.truncate(mark.axes);
        self.constraints.truncate(mark.constraints);
    }
}

/// Counts of records.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Mark {
    pub(crate) bodies: usize,
    pub(crate) links: usize,
    pub(crate) joints: usize,
    pub(crate) axes: usize,
    pub(crate) constraints: usize,
}
