//! A simulated world.

mod commands;
mod faults;
mod motion;
mod names;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose};
use periplus_scene::Model;

use crate::build::{add_world_joint, append};
use crate::engine::Engine;
use crate::exact::Exact;
use crate::limits::{MAX_GRAVITY_M_S2, is_within};
use crate::records::{Mark, Records};
use crate::rigid::{DivergedBody, Rigid};
use crate::shapes::Meshes;
use crate::state::{Diverged, ModelId};

/// Kind of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PhysicsMode {
    /// Physics: masses, forces, contacts. Steps of one or two milliseconds.
    #[default]
    Rigid,
    /// Exactly as commanded, without forces and contacts: robots follow the arcs of their twists in
    /// the plane ([`PhysicsWorld::follow`]), joints their commands; everything else stays. Steps of any
    /// length.
    Kinematic,
}

/// Result of adding a model.
#[derive(Debug)]
pub struct AddOutcome {
    /// Id of the model; `None` if it cannot be simulated.
    pub model: Option<ModelId>,
    /// Problems of the model.
    pub diagnostics: Diagnostics,
}

/// Bodies, joints and contacts, moved step by step.
///
/// # Wheels
///
/// A cylinder on its side has a line contact with the floor, which scrubs: the robot turns in place
/// up to 20 % less than commanded, with erratic solver results. A cylinder whose link turns about
/// the cylinder's own axis is therefore replaced by a ball of its radius, whose contacts count only
/// within the width of the tread, and a core of 0.9 of the radius, whose flat sides collide with
/// objects beside the wheel. Turning in place then agrees with the commanded angle to 0.5 %.
///
/// # Clones
///
/// A clone is an exact copy: the same calls give the same bits on both. It includes contacts with
/// their impulses, commands and forces that act in the next step. Shapes are shared, not copied.
#[derive(Clone)]
pub struct PhysicsWorld {
    pub(crate) records: Records,
    pub(crate) engine: Engine,
    time_ns: i64,
    diverged: Option<Diverged>,
    gravity_m_s2: DVec3,
}

impl PhysicsWorld {
    /// Creates the world of a file with its models. Models that cannot be simulated are omitted,
    /// each with an error.
    #[must_use]
    pub fn new(
        world: &periplus_scene::World,
        mode: PhysicsMode,
        meshes: &dyn Meshes,
    ) -> (Self, Diagnostics) {
        let mut diagnostics = Diagnostics::new();
        let mut gravity = world.gravity_m_s2;
        if !is_within(gravity, MAX_GRAVITY_M_S2) {
            diagnostics.push(
                Diagnostic::error(
                    "gravity-out-of-range",
                    format!(
                        "gravity is not finite, or more than {MAX_GRAVITY_M_S2} m/s²; it is set to zero"
                    ),
                )
                .at(world.origin),
            );
            gravity = DVec3::ZERO;
        }
        let mut made = Self::empty(gravity, mode);
        for model in &world.models {
            diagnostics.append(made.add(model, model.parent_from_model, meshes).diagnostics);
        }
        let before = made.records.mark();
        for joint in &world.joints {
            add_world_joint(&mut made.records, joint, &mut diagnostics);
        }
        made.engine.insert(&made.records, before);
        (made, diagnostics)
    }

    /// Creates an empty world with gravity in its frame [m/s²].
    #[must_use]
    pub fn empty(gravity_m_s2: DVec3, mode: PhysicsMode) -> Self {
        let engine = match mode {
            PhysicsMode::Rigid => Engine::Rigid(Box::new(Rigid::new(gravity_m_s2))),
            PhysicsMode::Kinematic => Engine::Exact(Exact::default()),
        };
        let mut world =
            Self { records: Records::new(), engine, time_ns: 0, diverged: None, gravity_m_s2 };
        world.engine.insert(&world.records, Mark::default());
        world
    }

    /// Returns the kind of motion.
    #[must_use]
    pub fn mode(&self) -> PhysicsMode {
        match self.engine {
            Engine::Rigid(_) => PhysicsMode::Rigid,
            Engine::Exact(_) => PhysicsMode::Kinematic,
        }
    }

    /// Adds a model at a pose in the world.
    pub fn add(
        &mut self,
        model: &Model,
        world_from_model: Pose,
        meshes: &dyn Meshes,
    ) -> AddOutcome {
        let mut diagnostics = Diagnostics::new();
        let (before, number) = (self.records.mark(), self.records.models.len());
        append(&mut self.records, model, world_from_model, meshes, &mut diagnostics);
        if self.records.models.len() == number {
            return AddOutcome { model: None, diagnostics };
        }
        self.engine.insert(&self.records, before);
        AddOutcome { model: Some(ModelId(number as u32)), diagnostics }
    }

    /// Removes a model. Its ids become invalid: queries return `None`.
    pub fn remove(&mut self, model: ModelId) {
        self.engine.remove(&self.records, model.0);
        for body in self.records.bodies_of(model.0) {
            self.records.bodies[body].removed = true;
        }
        if let Some(record) = self.records.models.get_mut(model.0 as usize) {
            record.removed = true;
        }
        if self.diverged.as_ref().is_some_and(|diverged| diverged.model == Some(model)) {
            self.diverged = None;
        }
    }

    /// Resets all models to the poses at which they were added, at rest and without commands. The
    /// same steps then give the same bits as in a new world. Removed models stay removed.
    pub fn reset(&mut self) {
        for axis in &mut self.records.axes {
            (axis.command, axis.state, axis.changed) = Default::default();
            axis.is_seized = false;
        }
        let empty = Self::empty(self.gravity_m_s2, self.mode());
        self.time_ns = 0;
        self.diverged = None;
        self.engine = empty.engine;
        // The body of the world exists already.
        self.engine.insert(&self.records, Mark { bodies: 1, ..Mark::default() });
    }

    /// Returns the simulated time since the start or the last reset [ns].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.time_ns
    }

    /// Returns gravity in the world's frame [m/s²].
    #[must_use]
    pub fn gravity_m_s2(&self) -> DVec3 {
        self.gravity_m_s2
    }

    /// Changes gravity permanently [m/s²]. A value beyond [`MAX_GRAVITY_M_S2`] is ignored.
    pub fn set_gravity(&mut self, gravity_m_s2: DVec3) {
        if is_within(gravity_m_s2, MAX_GRAVITY_M_S2) {
            self.gravity_m_s2 = gravity_m_s2;
            if let Engine::Rigid(rigid) = &mut self.engine {
                rigid.set_gravity(gravity_m_s2);
            }
        }
    }

    /// Advances the world by a time [ns]. In [`PhysicsMode::Rigid`] use a constant step: worlds and the
    /// tests use 1 ms. A step that is not positive does nothing.
    ///
    /// # Errors
    /// When a body's motion is no longer finite, or faster than
    /// [`MAX_SPEED_M_S`](crate::limits::MAX_SPEED_M_S). The world then stops, and each further step
    /// returns the same error, until its model is [removed](Self::remove) or the world is
    /// [reset](Self::reset).
    pub fn step(&mut self, step_ns: i64) -> Result<(), Diverged> {
        if let Some(diverged) = &self.diverged {
            return Err(diverged.clone());
        }
        if step_ns <= 0 {
            return Ok(());
        }
        let dt_s = step_ns as f64 / 1e9;
        self.time_ns = self.time_ns.saturating_add(step_ns);
        let outcome = match &mut self.engine {
            Engine::Rigid(rigid) => rigid.step(&mut self.records, dt_s),
            Engine::Exact(exact) => {
                exact.step(&mut self.records, dt_s);
                Ok(())
            }
        };
        outcome.map_err(|lost| {
            let link = self.records.bodies[lost.body].name.clone();
            let model = self.records.model_of_body(lost.body).map(ModelId);
            let DivergedBody { speed_m_s, .. } = lost;
            let diverged = Diverged { model, link, time_ns: self.time_ns, speed_m_s };
            self.diverged = Some(diverged.clone());
            diverged
        })
    }
}
