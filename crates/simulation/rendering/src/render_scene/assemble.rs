//! From a model as plain data to things.

use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Pose;
use periplus_images::Image;
use periplus_meshes::Texture;
use periplus_raycast::{Tags, World};
use periplus_scene::{Material, Mesh, Model, Plugin, Shape, Visual, builtin_material};

use super::rebuild::put;
use super::{Geometry, Label, ModelId, ModelRecord, PartRecord, SHADOW_MASK, Surroundings, Thing};
use crate::body::{Body, Problem, body_of};
use crate::label::label_of;
use crate::light::Lamp;
use crate::look::Look;
use crate::shapes::Shapes;
use crate::walk::{Walked, walk};

/// What one shape brings along, collision or visual.
struct Found<'a> {
    name: &'a str,
    shape: &'a Shape,
    link_from_shape: Pose,
    laser_retro: f64,
    visual: Option<&'a Visual>,
    origin: Origin,
}

impl Surroundings {
    /// Appends a model; its things are not yet among the rays.
    pub(super) fn assemble(
        &mut self,
        model: &Model,
        world_from_model: Pose,
        shapes: &dyn Shapes,
        diagnostics: &mut Diagnostics,
    ) -> ModelId {
        let number = count(self.models.len());
        let first_part = count(self.parts.len());
        let mut labels = Labels::default();
        for walked in walk(model) {
            let first_thing = count(self.things.len());
            let part = count(self.parts.len());
            let world_from_link = world_from_model * walked.model_from_link;
            if world_from_link.is_finite() {
                self.link(&walked, part, model.is_static, shapes, &mut labels, diagnostics);
            } else {
                diagnostics.push(
                    Diagnostic::error(
                        "pose-not-finite",
                        format!("the pose of link `{}` is not finite", walked.name),
                    )
                    .at(walked.link.origin),
                );
            }
            let lights = walked.link.lights.iter().cloned();
            self.lamps.extend(lights.map(|light| Lamp { light, part: Some(part) }));
            self.parts.push(PartRecord {
                model: number,
                name: walked.name,
                world_from_link,
                things: first_thing..count(self.things.len()),
                fixed: model.is_static,
            });
        }
        self.models.push(ModelRecord {
            name: model.name.clone(),
            parts: first_part..count(self.parts.len()),
            removed: false,
        });
        ModelId(number)
    }

    fn link(
        &mut self,
        walked: &Walked<'_>,
        part: u32,
        fixed: bool,
        shapes: &dyn Shapes,
        labels: &mut Labels,
        diagnostics: &mut Diagnostics,
    ) {
        let found: Vec<Found<'_>> = match self.geometry {
            Geometry::Collision => walked.link.collisions.iter().map(Found::collision).collect(),
            Geometry::Visual => walked.link.visuals.iter().map(Found::visual).collect(),
        };
        for found in found {
            let scoped = format!("{}::{}", walked.name, found.name);
            let Some(mut thing) = self.thing_from(&found, &scoped, fixed, shapes, diagnostics)
            else {
                continue;
            };
            thing.part = part;
            thing.label = self.label(&found, walked, labels, diagnostics);
            self.things.push(thing);
        }
    }

    /// None where there is nothing to meet, which is told if it is not meant.
    fn thing_from(
        &mut self,
        found: &Found<'_>,
        scoped: &str,
        fixed: bool,
        shapes: &dyn Shapes,
        diagnostics: &mut Diagnostics,
    ) -> Option<Thing> {
        let kind = if found.visual.is_some() { "visual" } else { "collision" };
        let mut tell = |problem| {
            let diagnostic = match problem {
                Problem::Impossible(why) => {
                    Diagnostic::error("shape-impossible", format!("{kind} `{scoped}` {why}"))
                }
                Problem::Unseen(why) => Diagnostic::warning(
                    "shape-not-seen",
                    format!("{kind} `{scoped}` {why}; no sensor sees it"),
                ),
            };
            diagnostics.push(diagnostic.at(found.origin));
        };
        let placed = match body_of(found.shape, self.geometry, shapes, &mut self.store) {
            Ok(placed) => placed?,
            Err(problem) => {
                tell(problem);
                return None;
            }
        };
        let link_from_body = found.link_from_shape * placed.shape_from_body;
        if !link_from_body.is_finite() {
            tell(Problem::Impossible("has a pose that is not finite".into()));
            return None;
        }
        // Whether it can be put at all shows best by putting it, meshes that are only copied aside.
        if !(fixed && matches!(placed.body, Body::Mesh(_))) {
            let tried = put(
                &mut World::builder(),
                &placed.body,
                fixed,
                &link_from_body,
                Tags::default(),
                self.threads,
            );
            if let Err(error) = tried {
                tell(Problem::Impossible(format!("cannot be: {error}")));
                return None;
            }
        }
        let looks = match found.visual {
            Some(visual) => self.looks(visual, &placed.body, shapes, diagnostics),
            None => vec![Look::default()],
        };
        let opacity = looks.iter().map(|look| look.opacity).fold(0.0, f32::max);
        if opacity == 0.0 {
            return None;
        }
        let mut mask = !SHADOW_MASK;
        if let Some(visual) = found.visual {
            mask = visual.visibility_flags & !SHADOW_MASK;
            // Glass gives no shadow.
            if visual.cast_shadows && opacity > 0.5 {
                mask |= SHADOW_MASK;
            }
        }
        Some(Thing {
            part: 0,
            name: found.name.to_owned(),
            link_from_body,
            body: Some(placed.body),
            tags: Tags { mask, group: ModelId(count(self.models.len())).group().0 },
            laser_retro: if found.laser_retro.is_finite() { found.laser_retro } else { 0.0 },
            label: None,
            looks,
            instance: None,
        })
    }

    /// One look for each part of a mesh that keeps its own materials, otherwise one.
    fn looks(
        &mut self,
        visual: &Visual,
        body: &Body,
        shapes: &dyn Shapes,
        diagnostics: &mut Diagnostics,
    ) -> Vec<Look> {
        let through = visual.transparency;
        let own = visual
            .material
            .as_ref()
            .and_then(|material| self.look(material, visual.origin, shapes, diagnostics));
        if let Some(look) = own {
            return vec![look.fainter(through)];
        }
        let (Body::Mesh(prepared), Shape::Mesh(mesh)) = (body, &visual.shape) else {
            return vec![Look::default().fainter(through)];
        };
        let materials = prepared.selected.parts.iter().map(|(_, material)| material.as_deref());
        let looks = materials.map(|material| {
            let look = material.map_or_else(Look::default, |material| {
                let texture = material.texture.as_ref();
                let texture =
                    texture.and_then(|it| self.mesh_texture(mesh, it, shapes, diagnostics));
                Look::of_mesh(material, texture)
            });
            look.fainter(through)
        });
        looks.collect()
    }

    /// The look of a material in a scene; none where it says nothing that is understood here.
    fn look(
        &mut self,
        material: &Material,
        origin: Origin,
        shapes: &dyn Shapes,
        diagnostics: &mut Diagnostics,
    ) -> Option<Look> {
        let mut told = material.clone();
        let script =
            material.script.as_ref().map(|script| script.name.as_str()).unwrap_or_default();
        let known = builtin_material(script);
        if let Some(known) = &known {
            told.ambient = told.ambient.or(known.ambient);
            told.diffuse = told.diffuse.or(known.diffuse);
            told.specular = told.specular.or(known.specular);
            told.emissive = told.emissive.or(known.emissive);
        }
        let albedo = material.pbr.as_ref().and_then(|pbr| pbr.albedo_map.as_deref());
        let texture = albedo.and_then(|uri| {
            let bytes = shapes.image(uri, origin);
            self.texture(uri, bytes, origin, diagnostics)
        });
        let colours = [told.ambient, told.diffuse, told.emissive];
        let says = texture.is_some() || colours.iter().any(Option::is_some);
        if !says && !script.is_empty() {
            diagnostics.push(
                Diagnostic::hint(
                    "material-not-known",
                    format!("`{script}` is no built-in material; grey stands for it"),
                )
                .at(origin)
                .help("add <diffuse> beside <script>: OGRE scripts are not read"),
            );
        }
        says.then(|| Look::of_material(&told, texture))
    }

    fn mesh_texture(
        &mut self,
        mesh: &Mesh,
        texture: &Texture,
        shapes: &dyn Shapes,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Image>> {
        match texture {
            Texture::File(name) => {
                self.texture(name, shapes.texture(mesh, name), mesh.origin, diagnostics)
            }
            Texture::Embedded { bytes, .. } => {
                self.texture("embedded", Some(bytes.clone()), mesh.origin, diagnostics)
            }
        }
    }

    fn texture(
        &mut self,
        name: &str,
        bytes: Option<Arc<[u8]>>,
        origin: Origin,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Image>> {
        let why = match bytes.map(|bytes| self.store.image(bytes)) {
            Some(Ok(image)) => return Some(image),
            Some(Err(error)) => error.to_string(),
            None => "it was not read".into(),
        };
        diagnostics.push(
            Diagnostic::hint("texture-not-shown", format!("texture `{name}`: {why}")).at(origin),
        );
        None
    }

    /// A visual's own label counts before those of the models around it, of which the innermost.
    fn label(
        &mut self,
        found: &Found<'_>,
        walked: &Walked<'_>,
        labels: &mut Labels,
        diagnostics: &mut Diagnostics,
    ) -> Option<Label> {
        let own = found.visual.and_then(|visual| label_of(&visual.plugins, diagnostics));
        if let Some(class) = own {
            return Some(self.next_label(class));
        }
        for &plugins in walked.scopes.iter().rev() {
            let known = labels.of_scopes.iter().find(|(scope, _)| std::ptr::eq(*scope, plugins));
            let label = match known {
                Some(&(_, label)) => label,
                None => {
                    let label = label_of(plugins, diagnostics).map(|class| self.next_label(class));
                    labels.of_scopes.push((plugins, label));
                    label
                }
            };
            if label.is_some() {
                return label;
            }
        }
        None
    }

    fn next_label(&mut self, class: u8) -> Label {
        let count = &mut self.instances_of_label[class as usize];
        *count = count.saturating_add(1);
        Label { class, number: *count }
    }
}

/// The labels of models met so far, by their lists of plugins.
#[derive(Default)]
struct Labels {
    of_scopes: Vec<(*const [Plugin], Option<Label>)>,
}

impl<'a> Found<'a> {
    fn collision(collision: &'a periplus_scene::Collision) -> Self {
        Self {
            name: &collision.name,
            shape: &collision.shape,
            link_from_shape: collision.link_from_collision,
            laser_retro: collision.laser_retro,
            visual: None,
            origin: collision.origin,
        }
    }

    fn visual(visual: &'a Visual) -> Self {
        Self {
            name: &visual.name,
            shape: &visual.shape,
            link_from_shape: visual.link_from_visual,
            laser_retro: visual.laser_retro,
            visual: Some(visual),
            origin: visual.origin,
        }
    }
}

/// Things are fewer than the bytes of the file they come from.
fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
