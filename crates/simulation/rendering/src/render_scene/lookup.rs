//! Lookup by name, and the surface of a hit.

use periplus_geometry::Pose;
use periplus_raycast::{Heightfield, Hit, InstanceId, RaycastShape};
use periplus_scene::Colour;

use super::{PartId, RenderModelId, RenderScene, ShapeRecord, range};
use crate::body::RenderBody;
use crate::phong::PhongMaterial;

/// Surface of a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitSurface<'a> {
    /// Id of the link.
    pub part: PartId,
    /// Name of the model.
    pub model: &'a str,
    /// Name of the link, scoped within the model.
    pub link: &'a str,
    /// Name of the collision or visual.
    pub name: &'a str,
    /// Laser intensity (`laser_retro`).
    pub laser_retro: f64,
    /// Segmentation class; `None` without a label.
    pub label: Option<u8>,
    /// Instance number within the class, from 1; 0 without a label.
    pub instance: u16,
    /// Colour under direct light, and opacity, without textures.
    pub colour: Colour,
}

/// Geometry of a shape, in the frame of its body.
#[derive(Clone, Copy, Debug)]
pub enum TracedGeometry<'a> {
    /// Shape in closed form.
    Shape(&'a RaycastShape),
    /// Triangles.
    Triangles {
        /// Corners \[m\].
        positions_m: &'a [[f64; 3]],
        /// Three corner indices each.
        triangles: &'a [[u32; 3]],
    },
    /// Height field.
    Heightfield(&'a Heightfield),
}

/// Collision or visual of a scene with its pose.
#[derive(Clone, Copy, Debug)]
pub struct TracedShape<'a> {
    /// Model.
    pub model: &'a str,
    /// Link, scoped within the model.
    pub link: &'a str,
    /// Collision or visual.
    pub name: &'a str,
    /// Pose of the geometry.
    pub world_from_body: Pose,
    /// Geometry.
    pub geometry: TracedGeometry<'a>,
}

impl RenderScene {
    /// Returns the surface of a hit of [`Self::rays`].
    ///
    /// # Panics
    /// When the hit is of another world, or older than a change of this one.
    #[must_use]
    pub fn surface(&self, hit: &Hit) -> HitSurface<'_> {
        let record = self.record(hit.instance);
        let part = &self.parts[record.part as usize];
        let material = record.material(hit.primitive);
        let [r, g, b] = material.diffuse.map(f64::from);
        HitSurface {
            part: PartId(record.part),
            model: &self.models[part.model as usize].name,
            link: &part.name,
            name: &record.name,
            laser_retro: record.laser_retro,
            label: record.label.map(|label| label.class),
            instance: record.label.map_or(0, |label| label.number),
            colour: Colour([r, g, b, material.opacity.into()]),
        }
    }

    /// Returns the laser intensity of a hit; faster than [`Self::surface`].
    ///
    /// # Panics
    /// As [`Self::surface`].
    #[must_use]
    pub fn laser_retro(&self, instance: InstanceId) -> f64 {
        self.record(instance).laser_retro
    }

    /// Returns true if any shape has a laser intensity other than 0.
    #[must_use]
    pub fn has_laser_retro(&self) -> bool {
        self.shape_records.iter().any(|record| record.body.is_some() && record.laser_retro != 0.0)
    }

    pub(super) fn record(&self, InstanceId(number): InstanceId) -> &ShapeRecord {
        &self.shape_records[self.record_of_instance[number as usize] as usize]
    }

    /// Returns all shapes in the order of adding, with their last poses.
    pub fn shapes(&self) -> impl Iterator<Item = TracedShape<'_>> {
        self.shape_records.iter().filter_map(|record| {
            let part = &self.parts[record.part as usize];
            let geometry = match record.body.as_ref()? {
                RenderBody::Shape(shape) => TracedGeometry::Shape(shape),
                RenderBody::Mesh(mesh) => TracedGeometry::Triangles {
                    positions_m: &mesh.selected.positions_m,
                    triangles: &mesh.selected.triangles,
                },
                RenderBody::Heightmap(heights) => TracedGeometry::Heightfield(heights),
            };
            Some(TracedShape {
                model: &self.models[part.model as usize].name,
                link: &part.name,
                name: &record.name,
                world_from_body: part.world_from_link * record.link_from_body,
                geometry,
            })
        })
    }

    /// Returns all models in the order of adding.
    pub fn models(&self) -> impl Iterator<Item = RenderModelId> {
        let present = (0_u32..).zip(&self.models).filter(|(_, model)| !model.removed);
        present.map(|(number, _)| RenderModelId(number))
    }

    /// Returns the first model of a name.
    #[must_use]
    pub fn find_model(&self, name: &str) -> Option<RenderModelId> {
        self.models().find(|&RenderModelId(number)| self.models[number as usize].name == name)
    }

    /// Returns the name of a model.
    #[must_use]
    pub fn model_name(&self, RenderModelId(number): RenderModelId) -> Option<&str> {
        self.models.get(number as usize).map(|model| model.name.as_str())
    }

    /// Returns the links of a model in the order of `periplus_physics`; empty for a removed model.
    pub fn parts(
        &self,
        RenderModelId(number): RenderModelId,
    ) -> impl Iterator<Item = PartId> + use<> {
        let model = self.models.get(number as usize).filter(|model| !model.removed);
        model.map_or(0..0, |model| model.parts.clone()).map(PartId)
    }

    /// Returns a link of a model by its scoped name.
    #[must_use]
    pub fn find_part(&self, model: RenderModelId, name: &str) -> Option<PartId> {
        self.parts(model).find(|&part| self.part_name(part) == Some(name))
    }

    /// Returns the model of a link.
    #[must_use]
    pub fn model_of(&self, PartId(number): PartId) -> Option<RenderModelId> {
        self.parts.get(number as usize).map(|part| RenderModelId(part.model))
    }

    /// Returns the name of a link, scoped within its model.
    #[must_use]
    pub fn part_name(&self, PartId(number): PartId) -> Option<&str> {
        self.parts.get(number as usize).map(|part| part.name.as_str())
    }

    /// Returns the last pose of a link.
    #[must_use]
    pub fn world_from_part(&self, PartId(number): PartId) -> Option<Pose> {
        self.parts.get(number as usize).map(|part| part.world_from_link)
    }

    /// Returns the number of collisions or visuals of a link.
    #[must_use]
    pub fn shape_count(&self, PartId(number): PartId) -> usize {
        self.parts.get(number as usize).map_or(0, |part| range(&part.shape_records).len())
    }
}

impl ShapeRecord {
    /// Returns the material of a primitive.
    pub(super) fn material(&self, primitive: u32) -> &PhongMaterial {
        let part = match &self.body {
            Some(RenderBody::Mesh(mesh)) if self.materials.len() > 1 => {
                mesh.selected.parts.partition_point(|&(first, _)| first <= primitive).max(1) - 1
            }
            _ => 0,
        };
        &self.materials[part.min(self.materials.len() - 1)]
    }
}
