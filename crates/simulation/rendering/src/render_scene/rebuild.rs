//! Building of the ray-cast world from shape records.

use std::ops::Range;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_raycast::{InstanceError, InstanceId, RaycastWorld, RaycastWorldBuilder, Tags};

use super::RenderScene;
use crate::body::RenderBody;

/// Returns an empty world.
pub(super) fn nothing() -> RaycastWorld {
    // Zero triangles never exceed the limit.
    RaycastWorld::builder().build(1).unwrap_or_else(|_| unreachable!("an empty world can be built"))
}

impl RenderScene {
    /// Builds the ray-cast world from all shapes, static meshes in one tree.
    pub(super) fn build(&mut self, diagnostics: &mut Diagnostics) {
        let (builder, numbers) = self.collect(0..self.shape_records.len(), diagnostics);
        match builder.build(self.threads) {
            Ok(world) => {
                self.rays = world;
                self.number(0, &numbers);
            }
            Err(error) => too_many(error, diagnostics),
        }
    }

    /// Adds shapes to the ray-cast world; existing trees are kept.
    pub(super) fn insert(&mut self, shape_records: Range<usize>, diagnostics: &mut Diagnostics) {
        let (builder, numbers) = self.collect(shape_records, diagnostics);
        match self.rays.insert(builder, self.threads) {
            Ok(InstanceId(first)) => self.number(first, &numbers),
            Err(error) => too_many(error, diagnostics),
        }
    }

    /// Collects a builder for some shapes, and the indices of the shapes in it.
    fn collect(
        &self,
        shape_records: Range<usize>,
        diagnostics: &mut Diagnostics,
    ) -> (RaycastWorldBuilder, Vec<usize>) {
        let mut builder = RaycastWorld::builder();
        let mut numbers = Vec::new();
        for number in shape_records {
            let record = &self.shape_records[number];
            let Some(body) = &record.body else { continue };
            let part = &self.parts[record.part as usize];
            let world_from_body = part.world_from_link * record.link_from_body;
            let added =
                put(&mut builder, body, part.fixed, &world_from_body, record.tags, self.threads);
            match added {
                Ok(_) => numbers.push(number),
                Err(error) => diagnostics.push(Diagnostic::error(
                    "shape-impossible",
                    format!("`{}::{}`: {error}", part.name, record.name),
                )),
            }
        }
        (builder, numbers)
    }

    /// Records which instances from `first` on belong to which shapes.
    fn number(&mut self, first: u32, shape_records: &[usize]) {
        for (instance, &record) in (first..).zip(shape_records) {
            self.shape_records[record].instance = Some(InstanceId(instance));
            // Shape counts fit into 32 bits.
            #[expect(clippy::cast_possible_truncation, reason = "see above")]
            self.record_of_instance.push(record as u32);
        }
    }
}

fn too_many(error: InstanceError, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Diagnostic::error(
            "too-many-triangles",
            format!("sensors do not see these shapes: {error}"),
        )
        .help("use simpler meshes"),
    );
}

/// Adds a body to a builder.
pub(super) fn put(
    builder: &mut RaycastWorldBuilder,
    body: &RenderBody,
    fixed: bool,
    world_from_body: &Pose,
    tags: Tags,
    threads: usize,
) -> Result<InstanceId, InstanceError> {
    match body {
        RenderBody::Shape(form) => builder.add_shape(form, world_from_body, tags),
        RenderBody::Mesh(mesh) if fixed => {
            let selected = &mesh.selected;
            builder.add_fixed(&selected.positions_m, &selected.triangles, world_from_body, tags)
        }
        RenderBody::Mesh(mesh) => {
            let tree = mesh.tree(threads).map_err(InstanceError::Mesh)?;
            builder.add_mesh(tree, world_from_body, tags)
        }
        RenderBody::Heightmap(heights) => {
            builder.add_heightfield(heights.clone(), world_from_body, tags)
        }
    }
}
