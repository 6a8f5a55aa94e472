//! The shapes of a world, as rays meet them.

mod assemble;
mod detail;
mod lookup;
mod rebuild;

use std::ops::Range;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_raycast::{Filter, InstanceId, Tags};
use periplus_scene::Model;

pub(crate) use detail::Met;
pub use lookup::Surface;

use crate::body::Body;
use crate::light::Lamp;
use crate::look::Look;
use crate::shapes::Shapes;
use crate::store::Store;

/// Which shapes rays meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// What touches: Gazebo's `ray` and `sonar`.
    Collision,
    /// What is seen: cameras, `gpu_ray`, `gpu_lidar`.
    Visual,
}

/// A model in [`Surroundings`]. Numbers follow the order of adding and are never used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ModelId(pub(crate) u32);

/// A link in [`Surroundings`]: what moves as one. Numbers are never used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PartId(pub(crate) u32);

impl ModelId {
    /// What a sensor on this model looks past: the model itself, whose lidars often sit inside a
    /// housing that is a link of its own.
    #[must_use]
    pub fn group(self) -> ModelGroup {
        ModelGroup(self.0 + 1)
    }
}

/// What a sensor looks past, for rays: see [`filter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ModelGroup(pub u32);

/// The bit of [`Tags::mask`] by which rays to a light see what casts shadows. Of SDF's visibility
/// flags the uppermost is lost to this; Gazebo keeps the four uppermost for itself anyhow.
pub const SHADOW_MASK: u32 = 1 << 31;

/// What a sensor's rays look for: what shares a bit with its visibility mask, and is not of its own
/// model.
#[must_use]
pub fn filter(visibility_mask: u32, own: Option<ModelGroup>) -> Filter {
    Filter {
        mask: visibility_mask & !SHADOW_MASK,
        except_group: own.map_or(0, |ModelGroup(number)| number),
    }
}

/// What became of a model.
#[derive(Debug)]
pub struct Parts {
    /// The model.
    pub model: ModelId,
    /// Its links, in the order in which `periplus_physics` numbers them.
    pub parts: Vec<PartId>,
    /// What is wrong with its shapes; what is not is there.
    pub diagnostics: Diagnostics,
}

/// The shapes of a world, as rays meet them: moved with links, told apart by hits.
///
/// Meshes of static models are one tree, the fastest to trace; all else is an instance that moves
/// at the cost of a small tree made anew.
#[derive(Debug)]
pub struct Surroundings {
    geometry: Geometry,
    threads: usize,
    models: Vec<ModelRecord>,
    parts: Vec<PartRecord>,
    things: Vec<Thing>,
    /// The thing of every instance of `rays`.
    thing_of: Vec<u32>,
    rays: periplus_raycast::World,
    store: Store,
    /// How many instances each label has.
    instances_of_label: [u16; 256],
    lamps: Vec<Lamp>,
    sky: detail::Sky,
    moves: Vec<(InstanceId, Pose)>,
}

#[derive(Debug)]
struct ModelRecord {
    name: String,
    parts: Range<u32>,
    removed: bool,
}

#[derive(Debug)]
struct PartRecord {
    model: u32,
    /// Scoped within its model.
    name: String,
    world_from_link: Pose,
    things: Range<u32>,
    /// Whether its meshes are among the fixed triangles.
    fixed: bool,
}

/// One collision or visual.
#[derive(Debug)]
struct Thing {
    part: u32,
    name: String,
    link_from_body: Pose,
    /// None once it was removed.
    body: Option<Body>,
    tags: Tags,
    laser_retro: f64,
    label: Option<Label>,
    /// One for each part of a mesh, otherwise one.
    looks: Vec<Look>,
    /// Its number among the instances of `rays`.
    instance: Option<InstanceId>,
}

/// What segmentation says of a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Label {
    class: u8,
    /// From 1 on, among the instances of this class.
    number: u16,
}

impl Surroundings {
    /// Nothing yet. Trees are built with `threads` threads; the outcome is the same for any number.
    #[must_use]
    pub fn empty(geometry: Geometry, threads: usize) -> Self {
        Self {
            geometry,
            threads,
            models: Vec::new(),
            parts: Vec::new(),
            things: Vec::new(),
            thing_of: Vec::new(),
            rays: rebuild::nothing(),
            store: Store::default(),
            instances_of_label: [0; 256],
            lamps: Vec::new(),
            sky: detail::Sky::default(),
            moves: Vec::new(),
        }
    }

    /// The models of a world, each where the file has it. What is wrong with a shape is told, and
    /// the rest is there.
    #[must_use]
    pub fn new(
        world: &periplus_scene::World,
        geometry: Geometry,
        shapes: &dyn Shapes,
        threads: usize,
    ) -> (Self, Diagnostics) {
        let mut made = Self::empty(geometry, threads);
        let mut diagnostics = Diagnostics::new();
        for model in &world.models {
            made.assemble(model, model.parent_from_model, shapes, &mut diagnostics);
        }
        for actor in &world.actors {
            diagnostics.push(
                Diagnostic::warning(
                    "actor-not-seen",
                    format!("actor `{}` is not animated here; no sensor sees it", actor.name),
                )
                .at(actor.origin),
            );
        }
        made.sky = detail::Sky::of(world);
        world.lights.iter().for_each(|light| made.set_light(light));
        made.build(&mut diagnostics);
        (made, diagnostics)
    }

    /// Adds a model with its frame somewhere in the world.
    pub fn add(&mut self, model: &Model, world_from_model: Pose, shapes: &dyn Shapes) -> Parts {
        let mut diagnostics = Diagnostics::new();
        let first = self.things.len();
        let id = self.assemble(model, world_from_model, shapes, &mut diagnostics);
        self.insert(first..self.things.len(), &mut diagnostics);
        Parts { model: id, parts: self.parts(id).collect(), diagnostics }
    }

    /// Takes a model out. Its numbers become void.
    pub fn remove(&mut self, model: ModelId) {
        let Some(record) = self.models.get_mut(model.0 as usize) else { return };
        if std::mem::replace(&mut record.removed, true) {
            return;
        }
        let parts = record.parts.clone();
        let mut gone = Vec::new();
        for part in &self.parts[range(&parts)] {
            for thing in &mut self.things[range(&part.things)] {
                gone.extend(thing.instance.take());
                thing.body = None;
                thing.looks = Vec::new();
            }
        }
        let removed = self.rays.remove(&gone);
        debug_assert!(removed.is_ok(), "every thing knows its own instance");
        self.lamps.retain(|lamp| lamp.part.is_none_or(|part| !parts.contains(&part)));
    }

    /// Moves links. What is not finite or was removed stays as it is. A link of a static model
    /// leaves the fixed triangles when it is first moved.
    pub fn place(&mut self, poses: &[(PartId, Pose)]) {
        let mut loosened = Vec::new();
        self.moves.clear();
        for &(PartId(number), world_from_link) in poses {
            let Some(part) = self.parts.get_mut(number as usize) else { continue };
            if part.world_from_link == world_from_link || !world_from_link.is_finite() {
                continue;
            }
            part.world_from_link = world_from_link;
            if std::mem::replace(&mut part.fixed, false) {
                loosened.push(range(&part.things));
                continue;
            }
            for thing in &self.things[range(&part.things)] {
                if let Some(instance) = thing.instance {
                    self.moves.push((instance, world_from_link * thing.link_from_body));
                }
            }
        }
        if !self.moves.is_empty() {
            let moved = self.rays.move_to(&self.moves);
            debug_assert!(moved.is_ok(), "fixed triangles have no part in moves");
        }
        for things in loosened {
            let gone: Vec<InstanceId> =
                self.things[things.clone()].iter_mut().filter_map(|t| t.instance.take()).collect();
            let removed = self.rays.remove(&gone);
            debug_assert!(removed.is_ok(), "every thing knows its own instance");
            self.insert(things, &mut Diagnostics::new());
        }
    }

    /// What rays meet. Use [`filter`] to look for it.
    #[must_use]
    pub fn rays(&self) -> &periplus_raycast::World {
        &self.rays
    }

    /// Which shapes these are.
    #[must_use]
    pub fn geometry(&self) -> Geometry {
        self.geometry
    }
}

fn range(numbers: &Range<u32>) -> Range<usize> {
    numbers.start as usize..numbers.end as usize
}
