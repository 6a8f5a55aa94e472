//! The shapes of a world as ray-cast geometry.

mod assemble;
mod detail;
mod lookup;
mod rebuild;

use std::ops::Range;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_raycast::{Filter, InstanceId, Tags};
use periplus_scene::Model;

pub(crate) use detail::HitMaterial;
pub use lookup::{HitSurface, TracedGeometry, TracedShape};

use crate::asset_cache::AssetCache;
use crate::assets::AssetLoader;
use crate::body::RenderBody;
use crate::light::LightSource;
use crate::phong::PhongMaterial;

/// Kind of shapes that rays hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensedGeometry {
    /// Collision shapes: Gazebo's `ray` and `sonar`.
    Collision,
    /// Visual shapes: cameras, `gpu_ray`, `gpu_lidar`.
    Visual,
}

/// A model in a [`RenderScene`]. Ids count in the order of adding and are never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RenderModelId(pub(crate) u32);

/// A link in a [`RenderScene`], the unit of motion. Ids are never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PartId(pub(crate) u32);

impl RenderModelId {
    /// Returns the group that sensors of this model ignore: the model itself, since lidars are often
    /// inside a housing that is a separate link.
    #[must_use]
    pub fn group(self) -> ModelGroup {
        ModelGroup(self.0 + 1)
    }
}

/// Group of shapes that a sensor ignores, see [`filter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ModelGroup(pub u32);

/// Bit of [`Tags::mask`] for shadow casters. It replaces the highest bit of SDF's visibility flags;
/// Gazebo reserves the four highest anyway.
pub const SHADOW_MASK: u32 = 1 << 31;

/// Returns the filter of a sensor's rays: shapes of other models that share a bit with its visibility
/// mask.
#[must_use]
pub fn filter(visibility_mask: u32, own: Option<ModelGroup>) -> Filter {
    Filter {
        mask: visibility_mask & !SHADOW_MASK,
        except_group: own.map_or(0, |ModelGroup(number)| number),
    }
}

/// Result of adding a model.
#[derive(Debug)]
pub struct AddedModel {
    /// Id of the model.
    pub model: RenderModelId,
    /// Ids of its links, in the order of `periplus_physics`.
    pub parts: Vec<PartId>,
    /// Problems of its shapes; valid shapes are added.
    pub diagnostics: Diagnostics,
}

/// The shapes of a world as ray-cast geometry: they move with links, and hits map to their shapes.
///
/// Meshes of static models are in one tree, the fastest to trace. All other shapes are instances,
/// whose motion rebuilds only a small tree.
#[derive(Debug)]
pub struct RenderScene {
    geometry: SensedGeometry,
    threads: usize,
    models: Vec<ModelRecord>,
    parts: Vec<PartRecord>,
    shape_records: Vec<ShapeRecord>,
    /// Index in `shape_records` of each instance of `rays`.
    record_of_instance: Vec<u32>,
    rays: periplus_raycast::RaycastWorld,
    assets: AssetCache,
    /// Number of instances of each label.
    instances_of_label: [u16; 256],
    light_sources: Vec<LightSource>,
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
    /// Scoped name within its model.
    name: String,
    world_from_link: Pose,
    shape_records: Range<u32>,
    /// True if its meshes are among the fixed triangles.
    fixed: bool,
}

/// A collision or visual.
#[derive(Debug)]
struct ShapeRecord {
    part: u32,
    name: String,
    link_from_body: Pose,
    /// `None` after removal.
    body: Option<RenderBody>,
    tags: Tags,
    laser_retro: f64,
    label: Option<Label>,
    /// One per submesh, otherwise one.
    materials: Vec<PhongMaterial>,
    /// Instance in `rays`.
    instance: Option<InstanceId>,
}

/// Segmentation label of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Label {
    class: u8,
    /// Instance number within the class, from 1.
    number: u16,
}

impl RenderScene {
    /// Returns an empty scene. Trees are built with `threads` threads; the result is the same for
    /// any number.
    #[must_use]
    pub fn empty(geometry: SensedGeometry, threads: usize) -> Self {
        Self {
            geometry,
            threads,
            models: Vec::new(),
            parts: Vec::new(),
            shape_records: Vec::new(),
            record_of_instance: Vec::new(),
            rays: rebuild::nothing(),
            assets: AssetCache::default(),
            instances_of_label: [0; 256],
            light_sources: Vec::new(),
            sky: detail::Sky::default(),
            moves: Vec::new(),
        }
    }

    /// Returns the scene of a world with all models at their initial poses. Problems of shapes are
    /// reported, and valid shapes are added.
    #[must_use]
    pub fn new(
        world: &periplus_scene::World,
        geometry: SensedGeometry,
        shapes: &dyn AssetLoader,
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
                    format!("actor `{}` is not animated; sensors do not see it", actor.name),
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
    pub fn add(
        &mut self,
        model: &Model,
        world_from_model: Pose,
        shapes: &dyn AssetLoader,
    ) -> AddedModel {
        let mut diagnostics = Diagnostics::new();
        let first = self.shape_records.len();
        let id = self.assemble(model, world_from_model, shapes, &mut diagnostics);
        self.insert(first..self.shape_records.len(), &mut diagnostics);
        AddedModel { model: id, parts: self.parts(id).collect(), diagnostics }
    }

    /// Removes a model. Its ids become invalid.
    pub fn remove(&mut self, model: RenderModelId) {
        let Some(record) = self.models.get_mut(model.0 as usize) else { return };
        if std::mem::replace(&mut record.removed, true) {
            return;
        }
        let parts = record.parts.clone();
        let mut gone = Vec::new();
        for part in &self.parts[range(&parts)] {
            for record in &mut self.shape_records[range(&part.shape_records)] {
                gone.extend(record.instance.take());
                record.body = None;
                record.materials = Vec::new();
            }
        }
        let removed = self.rays.remove(&gone);
        debug_assert!(removed.is_ok(), "every shape has its own instance");
        self.light_sources.retain(|lamp| lamp.part.is_none_or(|part| !parts.contains(&part)));
    }

    /// Moves links. Non-finite poses and removed links are ignored. The first move of a static
    /// model's link takes its meshes out of the fixed triangles.
    pub fn set_link_poses(&mut self, poses: &[(PartId, Pose)]) {
        let mut loosened = Vec::new();
        self.moves.clear();
        for &(PartId(number), world_from_link) in poses {
            let Some(part) = self.parts.get_mut(number as usize) else { continue };
            if part.world_from_link == world_from_link || !world_from_link.is_finite() {
                continue;
            }
            part.world_from_link = world_from_link;
            if std::mem::replace(&mut part.fixed, false) {
                loosened.push(range(&part.shape_records));
                continue;
            }
            for record in &self.shape_records[range(&part.shape_records)] {
                if let Some(instance) = record.instance {
                    self.moves.push((instance, world_from_link * record.link_from_body));
                }
            }
        }
        if !self.moves.is_empty() {
            let moved = self.rays.move_to(&self.moves);
            debug_assert!(moved.is_ok(), "fixed triangles have no part in moves");
        }
        for shape_records in loosened {
            let gone: Vec<InstanceId> = self.shape_records[shape_records.clone()]
                .iter_mut()
                .filter_map(|t| t.instance.take())
                .collect();
            let removed = self.rays.remove(&gone);
            debug_assert!(removed.is_ok(), "every shape has its own instance");
            self.insert(shape_records, &mut Diagnostics::new());
        }
    }

    /// Returns the ray-cast world. Use [`filter`] for queries.
    #[must_use]
    pub fn rays(&self) -> &periplus_raycast::RaycastWorld {
        &self.rays
    }

    /// Returns the kind of the shapes.
    #[must_use]
    pub fn geometry(&self) -> SensedGeometry {
        self.geometry
    }
}

fn range(numbers: &Range<u32>) -> Range<usize> {
    numbers.start as usize..numbers.end as usize
}
