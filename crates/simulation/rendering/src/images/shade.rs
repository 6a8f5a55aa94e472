//! Shading.

use std::ops::Range;

use periplus_geometry::DVec3;
use periplus_raycast::{Filter, Hit, Ray};

use super::{SHADOWS, Scratch};
use crate::light::{LightSample, WorldLight};
use crate::phong::PhongMaterial;
use crate::render_scene::{HitMaterial, RenderScene};

/// Maximum number of transparent layers in front of a surface.
const MAX_TRANSPARENT_LAYERS: usize = 8;

/// Inputs of shading besides the hits.
pub(super) struct Shader<'a> {
    scene: &'a RenderScene,
    active_lights: Vec<WorldLight>,
    ambient: [f32; 3],
    background: [f32; 3],
    shadows: bool,
}

/// Adjacent rays of a band that hit the same face, with their common properties.
#[derive(Clone, Debug)]
pub(super) struct Patch<'a> {
    /// Indices of the band's rays.
    pixels: Range<usize>,
    material: &'a PhongMaterial,
    /// Shading normal; interpolated from the corners of a smooth mesh.
    normal: DVec3,
    /// Colour factor of the texture, and opacity.
    tint: [f32; 4],
}

impl<'a> Shader<'a> {
    pub(super) fn new(scene: &'a RenderScene) -> Self {
        let sky = scene.sky();
        Self {
            scene,
            active_lights: scene.active_lights(),
            ambient: sky.ambient,
            background: sky.background,
            shadows: sky.shadows,
        }
    }

    /// Shades the hits of a band.
    pub(super) fn paint(
        &self,
        scratch: &mut Scratch<'a>,
        columns: usize,
        seen: Filter,
        rgb: &mut [u8],
    ) {
        self.find_patches(scratch);
        scratch.colours.clear();
        scratch.colours.resize(scratch.rays.len(), self.background);
        for patch in &scratch.patches {
            scratch.colours[patch.pixels.clone()].fill(self.unlit(patch));
        }
        for light in &self.active_lights {
            self.light(light, scratch, columns);
        }
        for patch in scratch.patches.iter().filter(|patch| patch.tint[3] < 1.0) {
            for pixel in patch.pixels.clone() {
                let Some(hit) = scratch.hits[pixel] else { continue };
                let front = scratch.colours[pixel];
                scratch.colours[pixel] =
                    self.shade_transparent(&scratch.rays[pixel], hit, patch.tint[3], front, seen);
            }
        }
        for (pixel, colour) in rgb.chunks_exact_mut(3).zip(&scratch.colours) {
            pixel.copy_from_slice(&colour.map(byte_of));
        }
    }

    fn find_patches(&self, scratch: &mut Scratch<'a>) {
        let Scratch { rays, hits, patches, .. } = scratch;
        patches.clear();
        // Neighbours mostly hit the same face.
        let mut last = None;
        for (pixel, (ray, hit)) in rays.iter().zip(hits).enumerate() {
            let Some(hit) = hit else { continue };
            let patch = self.patch(pixel, ray, hit, &mut last);
            match patches.last_mut() {
                Some(open) if open.continues(&patch) => open.pixels.end = pixel + 1,
                _ => patches.push(patch),
            }
        }
    }

    fn patch(
        &self,
        pixel: usize,
        ray: &Ray,
        hit: &Hit,
        last: &mut Option<HitMaterial<'a>>,
    ) -> Patch<'a> {
        let hit_material = match last {
            Some(hit_material)
                if (hit_material.instance, hit_material.primitive)
                    == (hit.instance, hit.primitive) =>
            {
                *hit_material
            }
            _ => *last.insert(self.scene.hit_material(hit)),
        };
        let (normal, tint) = if hit_material.is_plain {
            (hit.normal, [1.0, 1.0, 1.0, hit_material.material.opacity])
        } else {
            self.scene.detail(hit, ray.at(hit.distance_m))
        };
        Patch { pixels: pixel..pixel + 1, material: hit_material.material, normal, tint }
    }

    /// Adds the light of one source to all hits of a band that are not in shadow.
    fn light(&self, light: &WorldLight, scratch: &mut Scratch<'a>, columns: usize) {
        let shadows = self.shadows && light.casts_shadows;
        if shadows {
            self.mark_shadowed(light, scratch, columns);
        }
        let Scratch { rays, hits, patches, dark, colours, .. } = scratch;
        for patch in patches.iter().filter(|patch| patch.material.is_lit) {
            // Directional light is the same on all of a face.
            let sun = if light.is_directional {
                let Some(beam) = light.beam(DVec3::ZERO, patch.normal) else { continue };
                Some((beam, patch.diffuse_light(light, &beam)))
            } else {
                None
            };
            let has_specular = patch.material.has_specular();
            for pixel in patch.pixels.clone() {
                let Some(hit) = hits[pixel].filter(|_| !(shadows && dark[pixel])) else { continue };
                let ray = &rays[pixel];
                let (beam, diffuse_light) = match sun {
                    Some(sun) => sun,
                    None => match light.beam(ray.at(hit.distance_m), patch.normal) {
                        Some(beam) => (beam, patch.diffuse_light(light, &beam)),
                        None => continue,
                    },
                };
                let colour = &mut colours[pixel];
                add(colour, diffuse_light);
                if has_specular {
                    add(
                        colour,
                        light.specular_highlight(
                            &beam,
                            patch.material,
                            patch.normal,
                            ray.direction,
                        ),
                    );
                }
            }
        }
    }

    /// Computes the shadows of a light in a band, with neighbouring rays traced together: rays from
    /// a point light to the surfaces share the origin, rays to the sun share the direction.
    fn mark_shadowed(&self, light: &WorldLight, scratch: &mut Scratch<'a>, columns: usize) {
        let Scratch { rays: eyes, hits, patches, light_rays, light_m, dark, .. } = scratch;
        let rays = self.scene.rays();
        // A ray with an empty range costs nothing.
        let none = Ray { max_m: -1.0, ..Ray::new(DVec3::ZERO, DVec3::X) };
        light_rays.clear();
        light_rays.resize(hits.len(), none);
        dark.clear();
        dark.resize(hits.len(), false);
        for patch in patches.iter().filter(|patch| patch.material.is_lit) {
            if light.is_directional && light.beam(DVec3::ZERO, patch.normal).is_none() {
                continue;
            }
            for pixel in patch.pixels.clone() {
                let Some(hit) = hits[pixel] else { continue };
                let above = above(&hit, eyes[pixel].at(hit.distance_m));
                let ray = &mut light_rays[pixel];
                if light.is_directional {
                    *ray = Ray::new(above, -light.direction);
                    continue;
                }
                let way = above - light.position_m;
                if way != DVec3::ZERO {
                    *ray = Ray { max_m: 1.0, ..Ray::new(light.position_m, way) };
                }
            }
        }
        if light.is_directional {
            rays.occluded_grid(light_rays, columns, SHADOWS, 1, dark);
        } else {
            light_m.resize(light_rays.len(), 0.0);
            rays.cast_grid(light_rays, columns, SHADOWS, 1, light_m);
            for (dark, light_m) in dark.iter_mut().zip(light_m) {
                *dark = light_m.is_finite();
            }
        }
    }

    /// Returns ambient and emitted light.
    fn unlit(&self, patch: &Patch<'_>) -> [f32; 3] {
        let material = patch.material;
        std::array::from_fn(|channel| {
            let own = if material.is_lit {
                material.ambient[channel] * self.ambient[channel]
            } else {
                material.diffuse[channel]
            };
            own * patch.tint[channel] + material.emissive[channel]
        })
    }

    /// Blends transparent surfaces along a ray, each body once though it has two faces.
    fn shade_transparent(
        &self,
        ray: &Ray,
        first: Hit,
        opacity: f32,
        front: [f32; 3],
        seen: Filter,
    ) -> [f32; 3] {
        let mut colour = front.map(|value| value * opacity);
        let mut left = 1.0 - opacity;
        let mut last = first;
        let mut pane = first.instance;
        for _ in 0..2 * MAX_TRANSPARENT_LAYERS {
            let min_m = last.distance_m * (1.0 + 1e-6) + 1e-4 / ray.direction.length();
            let beyond = Ray { min_m, ..*ray };
            let Some(hit) = self.scene.rays().cast(&beyond, seen) else { break };
            last = hit;
            let other_face = hit.instance == pane;
            let hit_material = self.scene.hit_material(&hit);
            if other_face && hit_material.material.opacity < 1.0 {
                continue;
            }
            pane = hit.instance;
            let patch = self.patch(0, ray, &hit, &mut Some(hit_material));
            let opacity = patch.tint[3];
            add(
                &mut colour,
                self.shade_single(ray, &hit, &patch).map(|value| value * left * opacity),
            );
            left *= 1.0 - opacity;
            if left < 1.0 / 512.0 {
                return colour;
            }
        }
        add(&mut colour, self.background.map(|value| value * left));
        colour
    }

    /// Returns the colour of a single hit under all lights.
    fn shade_single(&self, ray: &Ray, hit: &Hit, patch: &Patch<'_>) -> [f32; 3] {
        let mut colour = self.unlit(patch);
        if !patch.material.is_lit {
            return colour;
        }
        let point = ray.at(hit.distance_m);
        for light in &self.active_lights {
            let Some(beam) = light.beam(point, patch.normal) else { continue };
            let way = Ray { max_m: beam.distance_m, ..Ray::new(above(hit, point), beam.to_light) };
            let shadow = self.shadows && light.casts_shadows;
            if shadow && self.scene.rays().occluded(&way, SHADOWS) {
                continue;
            }
            add(&mut colour, patch.diffuse_light(light, &beam));
            if patch.material.has_specular() {
                add(
                    &mut colour,
                    light.specular_highlight(&beam, patch.material, patch.normal, ray.direction),
                );
            }
        }
        colour
    }
}

impl Patch<'_> {
    /// Returns true if `next` is the next pixel of the same face.
    fn continues(&self, next: &Patch<'_>) -> bool {
        self.pixels.end == next.pixels.start
            && std::ptr::eq(self.material, next.material)
            && self.normal == next.normal
            && self.tint == next.tint
    }

    /// Returns the diffuse reflection of a light.
    fn diffuse_light(&self, light: &WorldLight, beam: &LightSample) -> [f32; 3] {
        let diffuse_light = light.diffuse_light(beam, self.material, self.normal);
        std::array::from_fn(|channel| diffuse_light[channel] * self.tint[channel])
    }
}

fn add(sum: &mut [f32; 3], colour: [f32; 3]) {
    for (sum, value) in sum.iter_mut().zip(colour) {
        *sum += value;
    }
}

/// Returns a point off the surface by more than rounding.
fn above(hit: &Hit, point: DVec3) -> DVec3 {
    let off_m = 1e-4 + 2e-6 * (hit.distance_m + point.abs().max_element());
    point + hit.normal * off_m
}

#[expect(clippy::cast_possible_truncation, reason = "within 0 and 255.5")]
fn byte_of(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
