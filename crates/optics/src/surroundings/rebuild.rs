//! From things to the world that rays meet.

use periplus_base::Pose;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_raycast::{BadInstance, InstanceId, Tags, World, WorldBuilder};

use super::Surroundings;
use crate::body::Body;

/// A world without anything.
pub(super) fn nothing() -> World {
    // No triangles are never too many.
    World::builder().build(1).unwrap_or_else(|_| unreachable!("an empty world can be built"))
}

impl Surroundings {
    /// Makes the rays' world from all things.
    pub(super) fn rebuild(&mut self, diagnostics: &mut Diagnostics) {
        let mut builder = World::builder();
        self.thing_of.clear();
        for (number, thing) in (0_u32..).zip(&mut self.things) {
            thing.instance = None;
            let Some(body) = &thing.body else { continue };
            let part = &self.parts[thing.part as usize];
            let world_from_body = part.world_from_link * thing.link_from_body;
            let added =
                put(&mut builder, body, part.fixed, &world_from_body, thing.tags, self.threads);
            match added {
                Ok(instance) => {
                    thing.instance = Some(instance);
                    self.thing_of.push(number);
                }
                Err(error) => diagnostics.push(Diagnostic::error(
                    "shape-impossible",
                    format!("`{}::{}`: {error}", part.name, thing.name),
                )),
            }
        }
        self.rays = builder.build(self.threads).unwrap_or_else(|error| {
            diagnostics.push(
                Diagnostic::error("too-many-triangles", format!("nothing can be seen: {error}"))
                    .help("use simpler meshes for static models"),
            );
            self.thing_of.clear();
            nothing()
        });
    }
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
