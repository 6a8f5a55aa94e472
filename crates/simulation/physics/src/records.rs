//! What a world is made of, as it was added. What moves is the engine's.

use std::ops::Range;

use periplus_geometry::Pose;
use rapier3d_f64::geometry::ColliderBuilder;
use rapier3d_f64::parry::mass_properties::MassProperties;

use crate::grain::Grain;
use crate::joints::{AxisRecord, Hold};

/// The body that joints to the world hold on to.
pub(crate) const WORLD_BODY: usize = 0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BodyKind {
    Fixed,
    Kinematic,
    Dynamic,
}

/// A rigid body: one link, or several on fixed joints. Its frame is that of the first.
#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) kind: BodyKind,
    pub(crate) world_from_body: Pose,
    pub(crate) mass: MassProperties,
    /// The mass that gravity pulls [kg].
    pub(crate) weight_share: f64,
    pub(crate) damping: [f64; 2],
    pub(crate) can_sleep: bool,
    pub(crate) colliders: Vec<ColliderBuilder>,
    /// Which of the colliders are rougher one way.
    pub(crate) grains: Vec<(usize, Grain)>,
    /// Its model was taken out.
    pub(crate) removed: bool,
}

impl Body {
    /// What everything fixed to the world hangs on.
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
            grains: Vec::new(),
            removed: false,
        }
    }
}

pub(crate) struct LinkRecord {
    pub(crate) model: u32,
    pub(crate) name: String,
    pub(crate) body: usize,
    pub(crate) body_from_link: Pose,
    pub(crate) collisions: Vec<String>,
    /// Stiffness of the contacts of each collision [N/m]; none for the solver's own.
    pub(crate) stiffness_n_m: Vec<Option<f64>>,
}

pub(crate) struct JointRecord {
    pub(crate) model: u32,
    pub(crate) name: String,
    pub(crate) axes: Range<usize>,
}

pub(crate) struct ModelRecord {
    pub(crate) name: String,
    pub(crate) world_from_model: Pose,
    pub(crate) links: Range<u32>,
    pub(crate) joints: Range<u32>,
    pub(crate) bodies: Range<u32>,
    pub(crate) canonical: u32,
    pub(crate) removed: bool,
}

/// All that a reset starts from again. Nothing is ever taken out, so numbers stay valid.
pub(crate) struct Records {
    pub(crate) models: Vec<ModelRecord>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) links: Vec<LinkRecord>,
    pub(crate) joints: Vec<JointRecord>,
    pub(crate) axes: Vec<AxisRecord>,
    pub(crate) holds: Vec<Hold>,
    /// The model of each link, for the questions of the solver.
    pub(crate) model_of_link: Vec<u32>,
}

impl Records {
    /// The world itself, and nothing in it.
    pub(crate) fn new() -> Self {
        Self {
            models: Vec::new(),
            bodies: vec![Body::world()],
            links: Vec::new(),
            joints: Vec::new(),
            axes: Vec::new(),
            holds: Vec::new(),
            model_of_link: Vec::new(),
        }
    }

    pub(crate) fn present(&self, model: u32) -> Option<&ModelRecord> {
        self.models.get(model as usize).filter(|model| !model.removed)
    }

    /// The body that carries a model's frame, and the frame in it.
    pub(crate) fn canonical(&self, model: u32) -> Option<(usize, Pose)> {
        let record = self.present(model)?;
        let body = self.links.get(record.canonical as usize)?.body;
        let body_from_world = self.bodies[body].world_from_body.inverse();
        Some((body, body_from_world * record.world_from_model))
    }

    /// The numbers of the bodies of a model that is there.
    pub(crate) fn bodies_of(&self, model: u32) -> Range<usize> {
        self.present(model)
            .map_or(0..0, |model| model.bodies.start as usize..model.bodies.end as usize)
    }

    /// The model that a body is a part of; none for the world's, and for what is removed.
    pub(crate) fn model_of_body(&self, body: usize) -> Option<u32> {
        (0..self.models.len() as u32).find(|&model| self.bodies_of(model).contains(&body))
    }

    /// How much there is, to come back to.
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            bodies: self.bodies.len(),
            links: self.links.len(),
            joints: self.joints.len(),
            axes: self.axes.len(),
            holds: self.holds.len(),
        }
    }

    /// Forgets what came after a mark.
    pub(crate) fn back_to(&mut self, mark: Mark) {
        self.bodies.truncate(mark.bodies);
        self.links.truncate(mark.links);
        self.joints.truncate(mark.joints);
        self.axes.truncate(mark.axes);
        self.holds.truncate(mark.holds);
    }
}

/// Counts of records.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Mark {
    pub(crate) bodies: usize,
    pub(crate) links: usize,
    pub(crate) joints: usize,
    pub(crate) axes: usize,
    pub(crate) holds: usize,
}
