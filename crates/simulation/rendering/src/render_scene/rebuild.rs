//! From things to the world that rays meet.

use std::ops::Range;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_raycast::{BadInstance, InstanceId, Tags, World, WorldBuilder};

use super::Surroundings;
use crate::body::Body;

/// A world without anything.
pub(super) fn nothing() -> World {
    // No triangles are never too many.
    World::builder().build(1).unwrap_or_else(|_| unreachable!("an empty world can be built"))
}

impl Surroundings {
    /// Makes the rays' world from all things, static meshes in one tree.
    pub(super) fn build(&mut self, diagnostics: &mut Diagnostics) {
        let (builder, numbers) = self.collect(0..self.things.len(), diagnostics);
        match builder.build(self.threads) {
            Ok(world) => {
                self.rays = world;
                self.number(0, &numbers);
            }
            Err(error) => too_many(error, diagnostics),
        }
    }

    /// Adds things to the rays' world; the trees that are there stay.
    pub(super) fn insert(&mut self, things: Range<usize>, diagnostics: &mut Diagnostics) {
        let (builder, numbers) = self.collect(things, diagnostics);
        match self.rays.insert(builder, self.threads) {
            Ok(InstanceId(first)) => self.number(first, &numbers),
            Err(error) => too_many(error, diagnostics),
        }
    }

    /// What is to be built of some things, and which of them are in it.
    fn collect(
        &self,
        things: Range<usize>,
        diagnostics: &mut Diagnostics,
    ) -> (WorldBuilder, Vec<usize>) {
        let mut builder = World::builder();
        let mut numbers = Vec::new();
        for number in things {
            let thing = &self.things[number];
            let Some(body) = &thing.body else { continue };
            let part = &self.parts[thing.part as usize];
            let world_from_body = part.world_from_link * thing.link_from_body;
            let added =
                put(&mut builder, body, part.fixed, &world_from_body, thing.tags, self.threads);
            match added {
                Ok(_) => numbers.push(number),
                Err(error) => diagnostics.push(Diagnostic::error(
                    "shape-impossible",
                    format!("`{}::{}`: {error}", part.name, thing.name),
                )),
            }
        }
        (builder, numbers)
    }

    /// Writes down which instances from `first` on are which things.
    fn number(&mut self, first: u32, things: &[usize]) {
        for (instance, &thing) in (first..).zip(things) {
            self.things[thing].instance = Some(InstanceId(instance));
            // Things are counted in 32 bits.
            #[expect(clippy::cast_possible_truncation, reason = "see above")]
            self.thing_of.push(thing as u32);
        }
    }
}

fn too_many(error: BadInstance, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Diagnostic::error("too-many-triangles", format!("no sensor sees these: {error}"))
            .help("use simpler meshes"),
    );
}

/// Adds a body to what is to be built.
pub(super) fn put(
    builder: &mut WorldBuilder,
    body: &Body,
    fixed: bool,
    world_from_body: &Pose,
    tags: Tags,
    threads: usize,
) -> Result<InstanceId, BadInstance> {
    match body {
        Body::Form(form) => builder.add_shape(form, world_from_body, tags),
        Body::Mesh(mesh) if fixed => {
            let selected = &mesh.selected;
            builder.add_fixed(&selected.positions_m, &selected.triangles, world_from_body, tags)
        }
        Body::Mesh(mesh) => {
            let tree = mesh.tree(threads).map_err(BadInstance::Mesh)?;
            builder.add_mesh(tree, world_from_body, tags)
        }
        Body::Ground(heights) => builder.add_heightfield(heights.clone(), world_from_body, tags),
    }
}
