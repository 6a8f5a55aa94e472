//! Names, and what a hit is.

use periplus_geometry::Pose;
use periplus_raycast::{Hit, InstanceId};
use periplus_scene::Colour;

use super::{ModelId, PartId, Surroundings, Thing, range};
use crate::body::Body;
use crate::look::Look;

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<'a> {
    /// The link.
    pub part: PartId,
    /// The model's name.
    pub model: &'a str,
    /// The link's name, scoped within the model.
    pub link: &'a str,
    /// The collision's or visual's name.
    pub name: &'a str,
    /// Brightness to a laser.
    pub laser_retro: f64,
    /// The class for segmentation; none where no plugin gives one.
    pub label: Option<u8>,
    /// Counts the labelled models or visuals of one class, from 1 on; 0 without a label.
    pub instance: u16,
    /// Colour under direct light, and opacity; textures left aside.
    pub colour: Colour,
}

impl Surroundings {
    /// What a ray of [`Self::rays`] met.
    ///
    /// # Panics
    /// When the hit is one of another world, or older than a change of this.
    #[must_use]
    pub fn surface(&self, hit: &Hit) -> Surface<'_> {
        let thing = self.thing(hit.instance);
        let part = &self.parts[thing.part as usize];
        let look = thing.look(hit.primitive);
        let [r, g, b] = look.diffuse.map(f64::from);
        Surface {
            part: PartId(thing.part),
            model: &self.models[part.model as usize].name,
            link: &part.name,
            name: &thing.name,
            laser_retro: thing.laser_retro,
            label: thing.label.map(|label| label.class),
            instance: thing.label.map_or(0, |label| label.number),
            colour: Colour([r, g, b, look.opacity.into()]),
        }
    }

    /// Brightness to a laser of what a ray met; quicker than [`Self::surface`].
    ///
    /// # Panics
    /// As [`Self::surface`].
    #[must_use]
    pub fn laser_retro(&self, instance: InstanceId) -> f64 {
        self.thing(instance).laser_retro
    }

    /// Whether anything here has a brightness to a laser other than 0; if not, nobody need ask.
    #[must_use]
    pub fn has_laser_retro(&self) -> bool {
        self.things.iter().any(|thing| thing.body.is_some() && thing.laser_retro != 0.0)
    }

    pub(super) fn thing(&self, InstanceId(number): InstanceId) -> &Thing {
        &self.things[self.thing_of[number as usize] as usize]
    }

    /// All models that are there, in the order of adding.
    pub fn models(&self) -> impl Iterator<Item = ModelId> {
        let present = (0_u32..).zip(&self.models).filter(|(_, model)| !model.removed);
        present.map(|(number, _)| ModelId(number))
    }

    /// The first model of a name.
    #[must_use]
    pub fn find_model(&self, name: &str) -> Option<ModelId> {
        self.models().find(|&ModelId(number)| self.models[number as usize].name == name)
    }

    /// The name of a model.
    #[must_use]
    pub fn model_name(&self, ModelId(number): ModelId) -> Option<&str> {
        self.models.get(number as usize).map(|model| model.name.as_str())
    }

    /// The links of a model, in the order in which `periplus_physics` numbers them; none of a model
    /// that was removed.
    pub fn parts(&self, ModelId(number): ModelId) -> impl Iterator<Item = PartId> + use<> {
        let model = self.models.get(number as usize).filter(|model| !model.removed);
        model.map_or(0..0, |model| model.parts.clone()).map(PartId)
    }

    /// A link of a model by its scoped name.
    #[must_use]
    pub fn find_part(&self, model: ModelId, name: &str) -> Option<PartId> {
        self.parts(model).find(|&part| self.part_name(part) == Some(name))
    }

    /// The model of a link.
    #[must_use]
    pub fn model_of(&self, PartId(number): PartId) -> Option<ModelId> {
        self.parts.get(number as usize).map(|part| ModelId(part.model))
    }

    /// The name of a link, scoped within its model.
    #[must_use]
    pub fn part_name(&self, PartId(number): PartId) -> Option<&str> {
        self.parts.get(number as usize).map(|part| part.name.as_str())
    }

    /// Where a link was put last.
    #[must_use]
    pub fn world_from_part(&self, PartId(number): PartId) -> Option<Pose> {
        self.parts.get(number as usize).map(|part| part.world_from_link)
    }

    /// How many collisions or visuals a link has here.
    #[must_use]
    pub fn shapes_of(&self, PartId(number): PartId) -> usize {
        self.parts.get(number as usize).map_or(0, |part| range(&part.things).len())
    }
}

impl Thing {
    /// The look of a primitive.
    pub(super) fn look(&self, primitive: u32) -> &Look {
        let part = match &self.body {
            Some(Body::Mesh(mesh)) if self.looks.len() > 1 => {
                mesh.selected.parts.partition_point(|&(first, _)| first <= primitive).max(1) - 1
            }
            _ => 0,
        };
        &self.looks[part.min(self.looks.len() - 1)]
    }
}
