//! A world that moves.

mod motion;
mod names;
mod told;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose};
use periplus_scene::Model;

use crate::build::{append, join};
use crate::engine::Engine;
use crate::exact::Exact;
use crate::limits::{MAX_GRAVITY_M_S2, is_within};
use crate::records::{Mark, Records};
use crate::rigid::{Lost, Rigid};
use crate::shapes::Meshes;
use crate::state::{Diverged, ModelId};

/// How a world moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// By physics: masses, forces, contacts. Steps of a millisecond or two.
    #[default]
    Rigid,
    /// Exactly as told, without forces and contacts: robots on flat ground follow the arcs of their
    /// twists ([`World::follow`]), joints their commands; all else stays where it is. Steps of any
    /// length.
    Kinematic,
}

/// What became of a model.
#[derive(Debug)]
pub struct Added {
    /// Its number; none if it cannot be simulated at all.
    pub model: Option<ModelId>,
    /// What is wrong with it.
    pub diagnostics: Diagnostics,
}

/// Bodies, joints and contacts, moved step by step.
///
/// # Wheels
///
/// A cylinder that rests on its side touches the ground along a line, and a line scrubs: in place it
/// turns up to 20 % less than told, more or less by the solver's mood. A cylinder whose link turns
/// about the cylinder's own axis therefore touches by a ball of its radius, whose contacts count
/// only within the width of the tread; a core of 0.9 of the radius touches with its flat sides what
/// stands beside the wheel. Turning in place then agrees with the commanded angle to 0.5 %.
pub struct World {
    pub(crate) records: Records,
    pub(crate) engine: Engine,
    time_ns: i64,
    diverged: Option<Diverged>,
    gravity_m_s2: DVec3,
}

impl World {
    /// A world of a file with its models. Models that cannot be simulated are left out, each with
    /// an error.
    #[must_use]
    pub fn new(
        world: &periplus_scene::World,
        mode: Mode,
        meshes: &dyn Meshes,
    ) -> (Self, Diagnostics) {
        let mut diagnostics = Diagnostics::new();
        let mut gravity = world.gravity_m_s2;
        if !is_within(gravity, MAX_GRAVITY_M_S2) {
            diagnostics.push(
                Diagnostic::error(
                    "gravity-out-of-range",
                    format!(
                        "gravity is no number, or more than {MAX_GRAVITY_M_S2} m/s²; there is none"
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
            join(&mut made.records, joint, &mut diagnostics);
        }
        made.engine.insert(&made.records, before);
        (made, diagnostics)
    }

    /// A world with nothing in it, and gravity in its frame [m/s²].
    #[must_use]
    pub fn empty(gravity_m_s2: DVec3, mode: Mode) -> Self {
        let engine = match mode {
            Mode::Rigid => Engine::Rigid(Box::new(Rigid::new(gravity_m_s2))),
            Mode::Kinematic => Engine::Exact(Exact::default()),
        };
        let mut world =
            Self { records: Records::new(), engine, time_ns: 0, diverged: None, gravity_m_s2 };
        world.engine.insert(&world.records, Mark::default());
        world
    }

    /// How it moves.
    #[must_use]
    pub fn mode(&self) -> Mode {
        match self.engine {
            Engine::Rigid(_) => Mode::Rigid,
            Engine::Exact(_) => Mode::Kinematic,
        }
    }

    /// Adds a model with its frame somewhere in the world.
    pub fn add(&mut self, model: &Model, world_from_model: Pose, meshes: &dyn Meshes) -> Added {
        let mut diagnostics = Diagnostics::new();
        let (before, number) = (self.records.mark(), self.records.models.len());
        append(&mut self.records, model, world_from_model, meshes, &mut diagnostics);
        if self.records.models.len() == number {
            return Added { model: None, diagnostics };
        }
        self.engine.insert(&self.records, before);
        Added { model: Some(ModelId(number as u32)), diagnostics }
    }

    /// Takes a model out. Its numbers become void: questions about it are answered with none.
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

    /// Everything back to where it was added, at rest and without commands. The same steps then
    /// give the same bits as in a new world. Removed models stay away.
    pub fn reset(&mut self) {
        for axis in &mut self.records.axes {
            (axis.command, axis.state, axis.changed) = Default::default();
        }
        let empty = Self::empty(self.gravity_m_s2, self.mode());
        self.time_ns = 0;
        self.diverged = None;
        self.engine = empty.engine;
        // The body of the world is there already.
        self.engine.insert(&self.records, Mark { bodies: 1, ..Mark::default() });
    }

    /// Simulated time since the start or the last reset [ns].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.time_ns
    }

    /// Gravity in the world's frame [m/s²].
    #[must_use]
    pub fn gravity_m_s2(&self) -> DVec3 {
        self.gravity_m_s2
    }

    /// Changes gravity [m/s²], for good. One beyond [`MAX_GRAVITY_M_S2`] changes nothing.
    pub fn set_gravity(&mut self, gravity_m_s2: DVec3) {
        if is_within(gravity_m_s2, MAX_GRAVITY_M_S2) {
            self.gravity_m_s2 = gravity_m_s2;
            if let Engine::Rigid(rigid) = &mut self.engine {
                rigid.set_gravity(gravity_m_s2);
            }
        }
    }

    /// Moves everything on by a time [ns]. In [`Mode::Rigid`] use the same step throughout: 1 ms is
    /// what worlds ask for and what the tests hold. A step that is not positive does nothing.
    ///
    /// # Errors
    /// When a body's motion is no longer finite, or faster than
    /// [`MAX_SPEED_M_S`](crate::limits::MAX_SPEED_M_S). The world then stands still, and each further
    /// step gives the same answer, until its model is [removed](Self::remove) or the world is
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
            let Lost { speed_m_s, .. } = lost;
            let diverged = Diverged { model, link, time_ns: self.time_ns, speed_m_s };
            self.diverged = Some(diverged.clone());
            diverged
        })
    }
}
