//! Conversion of models to shape records.

use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Pose;
use periplus_images::Image;
use periplus_meshes::MeshTexture;
use periplus_raycast::{RaycastWorld, Tags};
use periplus_scene::{Material, MeshShape, Model, Plugin, Shape, Visual, builtin_material};

use super::rebuild::put;
use super::{
    Label, ModelRecord, PartRecord, RenderModelId, RenderScene, SHADOW_MASK, SensedGeometry,
    ShapeRecord,
};
use crate::assets::AssetLoader;
use crate::body::{RenderBody, ShapeProblem, body_of};
use crate::label::label_of;
use crate::light::LightSource;
use crate::links::{ScopedLink, scoped_links};
use crate::phong::PhongMaterial;

/// Common properties of a collision or visual.
struct ShapeSource<'a> {
    name: &'a str,
    shape: &'a Shape,
    link_from_shape: Pose,
    laser_retro: f64,
    visual: Option<&'a Visual>,
    origin: Origin,
}

impl RenderScene {
    /// Appends a model; its shapes are not yet in the ray-cast world.
    pub(super) fn assemble(
        &mut self,
        model: &Model,
        world_from_model: Pose,
        shapes: &dyn AssetLoader,
        diagnostics: &mut Diagnostics,
    ) -> RenderModelId {
        let number = count(self.models.len());
        let first_part = count(self.parts.len());
        let mut labels = Labels::default();
        for scoped_link in scoped_links(model) {
            let first_thing = count(self.shape_records.len());
            let part = count(self.parts.len());
            let world_from_link = world_from_model * scoped_link.model_from_link;
            if world_from_link.is_finite() {
                self.link(&scoped_link, part, model.is_static, shapes, &mut labels, diagnostics);
            } else {
                diagnostics.push(
                    Diagnostic::error(
                        "pose-not-finite",
                        format!("the pose of link `{}` is not finite", scoped_link.name),
                    )
                    .at(scoped_link.link.origin),
                );
            }
            let lights = scoped_link.link.lights.iter().cloned();
            self.light_sources.extend(lights.map(|light| LightSource { light, part: Some(part) }));
            self.parts.push(PartRecord {
                model: number,
                name: scoped_link.name,
                world_from_link,
                shape_records: first_thing..count(self.shape_records.len()),
                fixed: model.is_static,
            });
        }
        self.models.push(ModelRecord {
            name: model.name.clone(),
            parts: first_part..count(self.parts.len()),
            removed: false,
        });
        RenderModelId(number)
    }

    fn link(
        &mut self,
        scoped_link: &ScopedLink<'_>,
        part: u32,
        fixed: bool,
        shapes: &dyn AssetLoader,
        labels: &mut Labels,
        diagnostics: &mut Diagnostics,
    ) {
        let source: Vec<ShapeSource<'_>> = match self.geometry {
            SensedGeometry::Collision => {
                scoped_link.link.collisions.iter().map(ShapeSource::collision).collect()
            }
            SensedGeometry::Visual => {
                scoped_link.link.visuals.iter().map(ShapeSource::visual).collect()
            }
        };
        for source in source {
            let scoped = format!("{}::{}", scoped_link.name, source.name);
            let Some(mut record) = self.shape_record(&source, &scoped, fixed, shapes, diagnostics)
            else {
                continue;
            };
            record.part = part;
            record.label = self.label(&source, scoped_link, labels, diagnostics);
            self.shape_records.push(record);
        }
    }

    /// Returns `None` for an empty shape, and for an invalid one after reporting it.
    fn shape_record(
        &mut self,
        source: &ShapeSource<'_>,
        scoped: &str,
        fixed: bool,
        shapes: &dyn AssetLoader,
        diagnostics: &mut Diagnostics,
    ) -> Option<ShapeRecord> {
        let kind = if source.visual.is_some() { "visual" } else { "collision" };
        let mut report = |problem| {
            let diagnostic = match problem {
                ShapeProblem::Invalid(why) => {
                    Diagnostic::error("shape-impossible", format!("{kind} `{scoped}` {why}"))
                }
                ShapeProblem::Unsupported(why) => Diagnostic::warning(
                    "shape-not-seen",
                    format!("{kind} `{scoped}` {why}; sensors do not see it"),
                ),
            };
            diagnostics.push(diagnostic.at(source.origin));
        };
        let placed = match body_of(source.shape, self.geometry, shapes, &mut self.assets) {
            Ok(placed) => placed?,
            Err(problem) => {
                report(problem);
                return None;
            }
        };
        let link_from_body = source.link_from_shape * placed.shape_from_body;
        if !link_from_body.is_finite() {
            report(ShapeProblem::Invalid("has a pose that is not finite".into()));
            return None;
        }
        // A trial insertion shows any problem of the shape; meshes are only copied, so they are
        // excluded.
        if !(fixed && matches!(placed.body, RenderBody::Mesh(_))) {
            let tried = put(
                &mut RaycastWorld::builder(),
                &placed.body,
                fixed,
                &link_from_body,
                Tags::default(),
                self.threads,
            );
            if let Err(error) = tried {
                report(ShapeProblem::Invalid(format!("is invalid: {error}")));
                return None;
            }
        }
        let materials = match source.visual {
            Some(visual) => self.materials(visual, &placed.body, shapes, diagnostics),
            None => vec![PhongMaterial::default()],
        };
        let opacity = materials.iter().map(|material| material.opacity).fold(0.0, f32::max);
        if opacity == 0.0 {
            return None;
        }
        let mut mask = !SHADOW_MASK;
        if let Some(visual) = source.visual {
            mask = visual.visibility_flags & !SHADOW_MASK;
            // Transparent shapes cast no shadow.
            if visual.cast_shadows && opacity > 0.5 {
                mask |= SHADOW_MASK;
            }
        }
        Some(ShapeRecord {
            part: 0,
            name: source.name.to_owned(),
            link_from_body,
            body: Some(placed.body),
            tags: Tags { mask, group: RenderModelId(count(self.models.len())).group().0 },
            laser_retro: if source.laser_retro.is_finite() { source.laser_retro } else { 0.0 },
            label: None,
            materials,
            instance: None,
        })
    }

    /// Returns one material per submesh of a mesh with its own materials, otherwise one.
    fn materials(
        &mut self,
        visual: &Visual,
        body: &RenderBody,
        shapes: &dyn AssetLoader,
        diagnostics: &mut Diagnostics,
    ) -> Vec<PhongMaterial> {
        let shade_transparent = visual.transparency;
        let own = visual
            .material
            .as_ref()
            .and_then(|material| self.material(material, visual.origin, shapes, diagnostics));
        if let Some(material) = own {
            return vec![material.with_transparency(shade_transparent)];
        }
        let (RenderBody::Mesh(prepared), Shape::Mesh(mesh)) = (body, &visual.shape) else {
            return vec![PhongMaterial::default().with_transparency(shade_transparent)];
        };
        let materials = prepared.selected.parts.iter().map(|(_, material)| material.as_deref());
        let materials = materials.map(|material| {
            let material = material.map_or_else(PhongMaterial::default, |material| {
                let texture = material.texture.as_ref();
                let texture =
                    texture.and_then(|it| self.mesh_texture(mesh, it, shapes, diagnostics));
                PhongMaterial::of_mesh(material, texture)
            });
            material.with_transparency(shade_transparent)
        });
        materials.collect()
    }

    /// Returns the converted material; `None` if it has no supported property.
    fn material(
        &mut self,
        material: &Material,
        origin: Origin,
        shapes: &dyn AssetLoader,
        diagnostics: &mut Diagnostics,
    ) -> Option<PhongMaterial> {
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
                    format!("`{script}` is not a built-in material; grey is used instead"),
                )
                .at(origin)
                .help("add <diffuse> beside <script>: OGRE scripts are not supported"),
            );
        }
        says.then(|| PhongMaterial::of_material(&told, texture))
    }

    fn mesh_texture(
        &mut self,
        mesh: &MeshShape,
        texture: &MeshTexture,
        shapes: &dyn AssetLoader,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Image>> {
        match texture {
            MeshTexture::File(name) => {
                self.texture(name, shapes.texture(mesh, name), mesh.origin, diagnostics)
            }
            MeshTexture::Embedded { bytes, .. } => {
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
        let why = match bytes.map(|bytes| self.assets.image(bytes)) {
            Some(Ok(image)) => return Some(image),
            Some(Err(error)) => error.to_string(),
            None => "it was not read".into(),
        };
        diagnostics.push(
            Diagnostic::hint("texture-not-shown", format!("texture `{name}`: {why}")).at(origin),
        );
        None
    }

    /// The visual's own label has priority, then those of the models around it from the innermost
    /// out.
    fn label(
        &mut self,
        source: &ShapeSource<'_>,
        scoped_link: &ScopedLink<'_>,
        labels: &mut Labels,
        diagnostics: &mut Diagnostics,
    ) -> Option<Label> {
        let own = source.visual.and_then(|visual| label_of(&visual.plugins, diagnostics));
        if let Some(class) = own {
            return Some(self.next_label(class));
        }
        for &plugins in scoped_link.scopes.iter().rev() {
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

/// Labels of visited models, by their lists of plugins.
#[derive(Default)]
struct Labels {
    of_scopes: Vec<(*const [Plugin], Option<Label>)>,
}

impl<'a> ShapeSource<'a> {
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

/// Shapes are fewer than the bytes of the file they come from.
fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
