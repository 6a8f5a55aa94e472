//! Surface properties that vary from point to point, and lights.

use periplus_geometry::{DVec3, Pose};
use periplus_images::Image;
use periplus_raycast::{Hit, InstanceId, RaycastWorld, Tags};
use periplus_scene::{Light, World};

use super::rebuild::put;
use super::{PartId, RenderScene};
use crate::body::RenderBody;
use crate::light::{LightSource, WorldLight};
use crate::mesh::SelectedMesh;
use crate::objects::ObjectLabel;
use crate::phong::{PhongMaterial, rgb};

/// Ambient light and background colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sky {
    pub(crate) ambient: [f32; 3],
    pub(crate) background: [f32; 3],
    pub(crate) shadows: bool,
}

impl Default for Sky {
    /// SDF's defaults.
    fn default() -> Self {
        Self { ambient: [0.4; 3], background: [0.7; 3], shadows: true }
    }
}

impl Sky {
    pub(super) fn of(world: &World) -> Self {
        Self {
            ambient: rgb(world.ambient),
            background: rgb(world.background),
            shadows: world.shadows,
        }
    }
}

/// Properties of a hit face that are constant over the face.
#[derive(Clone, Copy)]
pub(crate) struct HitMaterial<'a> {
    pub(crate) instance: InstanceId,
    pub(crate) primitive: u32,
    pub(crate) material: &'a PhongMaterial,
    /// True if [`RenderScene::detail`] adds nothing.
    pub(crate) is_plain: bool,
}

/// Shape of an object with a label.
pub(crate) struct LabelledShape<'a> {
    pub(crate) label: ObjectLabel,
    pub(crate) model: &'a str,
    pub(crate) world_from_link: Pose,
    pub(crate) world_from_body: Pose,
    pub(crate) body: &'a RenderBody,
    tags: Tags,
}

impl RenderScene {
    /// Adds a light to the world or replaces the light of the same name; its pose is
    /// `world_from_light`. Lights on links are added and removed with their models.
    pub fn set_light(&mut self, light: &Light) {
        self.remove_light(&light.name);
        self.light_sources.push(LightSource { light: light.clone(), part: None });
    }

    /// Replaces the light of the same name on a link; returns false if there is none.
    pub fn set_light_on(&mut self, PartId(part): PartId, light: &Light) -> bool {
        let mut light_sources =
            self.light_sources.iter_mut().filter(|lamp| lamp.part == Some(part));
        let known = light_sources.find(|lamp| lamp.light.name == light.name);
        known.map(|lamp| lamp.light = light.clone()).is_some()
    }

    /// Removes a light of the world; returns false if there is none of this name.
    pub fn remove_light(&mut self, name: &str) -> bool {
        let before = self.light_sources.len();
        self.light_sources.retain(|lamp| lamp.part.is_some() || lamp.light.name != name);
        self.light_sources.len() < before
    }

    pub(crate) fn sky(&self) -> Sky {
        self.sky
    }

    /// Returns all active lights at their current poses.
    pub(crate) fn active_lights(&self) -> Vec<WorldLight> {
        let placed = |lamp: &LightSource| {
            let world_from_parent = match lamp.part {
                None => Pose::IDENTITY,
                Some(part) => self.world_from_part(PartId(part))?,
            };
            WorldLight::of(&lamp.light, world_from_parent * lamp.light.parent_from_light)
        };
        self.light_sources.iter().filter_map(placed).collect()
    }

    /// Returns the material of a hit.
    pub(crate) fn hit_material(&self, hit: &Hit) -> HitMaterial<'_> {
        let record = self.record(hit.instance);
        let material = record.material(hit.primitive);
        let is_plain = match &record.body {
            Some(RenderBody::Mesh(mesh)) => {
                let SelectedMesh { normals, uvs, .. } = &mesh.selected;
                normals.is_empty() && (material.texture.is_none() || uvs.is_empty())
            }
            _ => true,
        };
        HitMaterial { instance: hit.instance, primitive: hit.primitive, material, is_plain }
    }

    /// Returns class and instance number of a hit.
    pub(crate) fn label_of(&self, instance: InstanceId) -> Option<(u8, u16)> {
        self.record(instance).label.map(|label| (label.class, label.number))
    }

    /// Returns all shapes with a label other than the background.
    pub(crate) fn labelled_shapes(&self) -> impl Iterator<Item = LabelledShape<'_>> {
        self.shape_records.iter().filter_map(|record| {
            let label = record.label.filter(|label| label.class != 0)?;
            let part = &self.parts[record.part as usize];
            Some(LabelledShape {
                label: ObjectLabel { class: label.class, instance: label.number },
                model: &self.models[part.model as usize].name,
                world_from_link: part.world_from_link,
                world_from_body: part.world_from_link * record.link_from_body,
                body: record.body.as_ref()?,
                tags: record.tags,
            })
        })
    }

    /// Returns the shapes of one object as a ray-cast world; `None` if it has none that can be cast.
    pub(crate) fn rays_of(&self, label: ObjectLabel) -> Option<RaycastWorld> {
        let mut builder = RaycastWorld::builder();
        for shape in self.labelled_shapes().filter(|shape| shape.label == label) {
            // Problems of shapes were reported when the scene was built.
            put(&mut builder, shape.body, false, &shape.world_from_body, shape.tags, self.threads)
                .ok()?;
        }
        builder.build(self.threads).ok()
    }

    /// Returns the shading normal, and the colour factor of the texture with the total opacity.
    pub(crate) fn detail(&self, hit: &Hit, point: DVec3) -> (DVec3, [f32; 4]) {
        let record = self.record(hit.instance);
        let material = record.material(hit.primitive);
        let plain = (hit.normal, [1.0, 1.0, 1.0, material.opacity]);
        let Some(RenderBody::Mesh(mesh)) = &record.body else { return plain };
        let selected = &mesh.selected;
        let textured = material.texture.as_ref().filter(|_| !selected.uvs.is_empty());
        if textured.is_none() && selected.normals.is_empty() {
            return plain;
        }
        let part = &self.parts[record.part as usize];
        let world_from_body = part.world_from_link * record.link_from_body;
        let point = world_from_body.inverse().transform_point(point);
        let Some(corners) = selected.triangles.get(hit.primitive as usize) else { return plain };
        let Some(barycentric) = barycentric(selected, *corners, point) else { return plain };
        let mut normal = hit.normal;
        if !selected.normals.is_empty() {
            let blended =
                blend(*corners, barycentric, |corner| selected.normals[corner].map(f64::from));
            let smooth = world_from_body.rotation * DVec3::from_array(blended);
            // Interpolated normals that face away from the eye are replaced by the flat one.
            let smooth = smooth.normalize_or_zero();
            let facing = smooth.dot(hit.normal);
            if facing.abs() > 0.2 {
                normal = if facing < 0.0 { -smooth } else { smooth };
            }
        }
        let mut tint = plain.1;
        if let Some(image) = textured {
            let [u, v, _] = blend(*corners, barycentric, |corner| {
                let [u, v] = selected.uvs[corner].map(f64::from);
                [u, v, 0.0]
            });
            let [r, g, b, a] = sample(image, u, v);
            tint = [r, g, b, a * material.opacity];
        }
        (normal, tint)
    }
}

/// Returns the barycentric coordinates of a point; `None` for a degenerate triangle.
fn barycentric(selected: &SelectedMesh, corners: [u32; 3], point: DVec3) -> Option<[f64; 3]> {
    let [a, b, c] = corners.map(|corner| DVec3::from_array(selected.positions_m[corner as usize]));
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    if area == 0.0 {
        return None;
    }
    let of_b = ap.cross(ac).dot(normal) / area;
    let of_c = ab.cross(ap).dot(normal) / area;
    Some([1.0 - of_b - of_c, of_b, of_c])
}

fn blend(corners: [u32; 3], barycentric: [f64; 3], of: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(|corner| of(corner as usize));
    [0, 1, 2].map(|k: usize| a[k] * barycentric[0] + b[k] * barycentric[1] + c[k] * barycentric[2])
}

/// Returns the colour of an image at texture coordinates, v upwards, repeated, with bilinear
/// interpolation.
#[expect(clippy::cast_possible_truncation, reason = "pixel numbers are within the image")]
fn sample(image: &Image, u: f64, v: f64) -> [f32; 4] {
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    if !(u.is_finite() && v.is_finite()) {
        return [1.0; 4];
    }
    let x = (u - u.floor()) * width - 0.5;
    let y = (1.0 - (v - v.floor())) * height - 0.5;
    let (left, top) = (x.floor(), y.floor());
    let (dx, dy) = ((x - left) as f32, (y - top) as f32);
    let wrap = |k: f64, n: u32| (k as i64).rem_euclid(i64::from(n)) as usize;
    let pixel = |column: f64, row: f64| {
        let index = wrap(row, image.height) * image.width as usize + wrap(column, image.width);
        image.rgba[index].map(|byte| f32::from(byte) / 255.0)
    };
    let corners = [
        pixel(left, top),
        pixel(left + 1.0, top),
        pixel(left, top + 1.0),
        pixel(left + 1.0, top + 1.0),
    ];
    [0, 1, 2, 3].map(|k: usize| {
        let upper = corners[0][k] + (corners[1][k] - corners[0][k]) * dx;
        let lower = corners[2][k] + (corners[3][k] - corners[2][k]) * dx;
        upper + (lower - upper) * dy
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_lies_with_v_upwards() {
        let image = Image {
            width: 2,
            height: 2,
            rgba: vec![[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255; 4]],
        };
        assert_eq!(sample(&image, 0.25, 0.75), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(sample(&image, 0.25, 0.25), [0.0, 0.0, 1.0, 1.0]);
        assert_eq!(sample(&image, 5.75, -0.25), [0.0, 1.0, 0.0, 1.0]);
        assert_eq!(sample(&image, 0.5, 0.75), [0.5, 0.5, 0.0, 1.0]);
    }
}
