//! Colours.

use std::ops::Range;

use periplus_geometry::DVec3;
use periplus_raycast::{Filter, Hit, Ray};

use super::{SHADOWS, Scratch};
use crate::light::{Beam, Shine};
use crate::look::Look;
use crate::surroundings::{Met, Surroundings};

/// Through so many panes one sees at most.
const PANES: usize = 8;

/// All that the colours of a picture need besides what each ray meets.
pub(super) struct Shader<'a> {
    surroundings: &'a Surroundings,
    shines: Vec<Shine>,
    ambient: [f32; 3],
    background: [f32; 3],
    shadows: bool,
}

/// Neighbouring rays of a band that met one face, so that what is the same for all is found once.
#[derive(Clone, Debug)]
pub(super) struct Patch<'a> {
    /// Which of the band's rays.
    pixels: Range<usize>,
    look: &'a Look,
    /// For light; where a mesh is smooth, that of its corners.
    normal: DVec3,
    /// What the texture multiplies with, and opacity.
    tint: [f32; 4],
}

impl<'a> Shader<'a> {
    pub(super) fn new(surroundings: &'a Surroundings) -> Self {
        let sky = surroundings.sky();
        Self {
            surroundings,
            shines: surroundings.shines(),
            ambient: sky.ambient,
            background: sky.background,
            shadows: sky.shadows,
        }
    }

    /// Paints what the rays of a band met.
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
        for shine in &self.shines {
            self.light(shine, scratch, columns);
        }
        for patch in scratch.patches.iter().filter(|patch| patch.tint[3] < 1.0) {
            for pixel in patch.pixels.clone() {
                let Some(hit) = scratch.hits[pixel] else { continue };
                let front = scratch.colours[pixel];
                scratch.colours[pixel] =
                    self.through(&scratch.rays[pixel], hit, patch.tint[3], front, seen);
            }
        }
        for (pixel, colour) in rgb.chunks_exact_mut(3).zip(&scratch.colours) {
            pixel.copy_from_slice(&colour.map(byte_of));
        }
    }

    fn find_patches(&self, scratch: &mut Scratch<'a>) {
        let Scratch { rays, hits, patches, .. } = scratch;
        patches.clear();
        // Neighbours mostly meet the same thing.
        let mut last = None;
        for (pixel, (ray, hit)) in rays.iter().zip(hits).enumerate() {
            let Some(hit) = hit else { continue };
            let patch = self.patch(pixel, ray, hit, &mut last);
            match patches.last_mut() {
                Some(open) if open.goes_on_with(&patch) => open.pixels.end = pixel + 1,
                _ => patches.push(patch),
            }
        }
    }

    fn patch(&self, pixel: usize, ray: &Ray, hit: &Hit, last: &mut Option<Met<'a>>) -> Patch<'a> {
        let met = match last {
            Some(met) if (met.instance, met.primitive) == (hit.instance, hit.primitive) => *met,
            _ => *last.insert(self.surroundings.met(hit)),
        };
        let (normal, tint) = if met.is_plain {
            (hit.normal, [1.0, 1.0, 1.0, met.look.opacity])
        } else {
            self.surroundings.detail(hit, ray.at(hit.distance_m))
        };
        Patch { pixels: pixel..pixel + 1, look: met.look, normal, tint }
    }

    /// Adds one light to all that a band sees, where it is not in shadow.
    fn light(&self, shine: &Shine, scratch: &mut Scratch<'a>, columns: usize) {
        let shadows = self.shadows && shine.casts_shadows;
        if shadows {
            self.darken(shine, scratch, columns);
        }
        let Scratch { rays, hits, patches, dark, colours, .. } = scratch;
        for patch in patches.iter().filter(|patch| patch.look.is_lit) {
            // The sun meets all of a face alike.
            let sun = if shine.is_directional {
                let Some(beam) = shine.beam(DVec3::ZERO, patch.normal) else { continue };
                Some((beam, patch.matt(shine, &beam)))
            } else {
                None
            };
            let gleams = patch.look.gleams();
            for pixel in patch.pixels.clone() {
                let Some(hit) = hits[pixel].filter(|_| !(shadows && dark[pixel])) else { continue };
                let ray = &rays[pixel];
                let (beam, matt) = match sun {
                    Some(sun) => sun,
                    None => match shine.beam(ray.at(hit.distance_m), patch.normal) {
                        Some(beam) => (beam, patch.matt(shine, &beam)),
                        None => continue,
                    },
                };
                let colour = &mut colours[pixel];
                add(colour, matt);
                if gleams {
                    add(colour, shine.gleam(&beam, patch.look, patch.normal, ray.direction));
                }
            }
        }
    }

    /// Finds where in a band a light does not reach, with neighbours traced together: from a lamp to
    /// the surfaces, so that rays share the origin; to the sun they share the direction.
    fn darken(&self, shine: &Shine, scratch: &mut Scratch<'a>, columns: usize) {
        let Scratch { rays: eyes, hits, patches, light_rays, light_m, dark, .. } = scratch;
        let rays = self.surroundings.rays();
        // What ends before it begins costs nothing.
        let none = Ray { max_m: -1.0, ..Ray::new(DVec3::ZERO, DVec3::X) };
        light_rays.clear();
        light_rays.resize(hits.len(), none);
        dark.clear();
        dark.resize(hits.len(), false);
        for patch in patches.iter().filter(|patch| patch.look.is_lit) {
            if shine.is_directional && shine.beam(DVec3::ZERO, patch.normal).is_none() {
                continue;
            }
            for pixel in patch.pixels.clone() {
                let Some(hit) = hits[pixel] else { continue };
                let above = above(&hit, eyes[pixel].at(hit.distance_m));
                let ray = &mut light_rays[pixel];
                if shine.is_directional {
                    *ray = Ray::new(above, -shine.direction);
                    continue;
                }
                let way = above - shine.position_m;
                if way != DVec3::ZERO {
                    *ray = Ray { max_m: 1.0, ..Ray::new(shine.position_m, way) };
                }
            }
        }
        if shine.is_directional {
            rays.occluded_grid(light_rays, columns, SHADOWS, 1, dark);
        } else {
            light_m.resize(light_rays.len(), 0.0);
            rays.cast_grid(light_rays, columns, SHADOWS, 1, light_m);
            for (dark, light_m) in dark.iter_mut().zip(light_m) {
                *dark = light_m.is_finite();
            }
        }
    }

    /// Without the light of lamps and of the sun.
    fn unlit(&self, patch: &Patch<'_>) -> [f32; 3] {
        let look = patch.look;
        std::array::from_fn(|channel| {
            let own = if look.is_lit {
                look.ambient[channel] * self.ambient[channel]
            } else {
                look.diffuse[channel]
            };
            own * patch.tint[channel] + look.emissive[channel]
        })
    }

    /// What is seen through glass: the panes on the way, each once though it has two faces.
    fn through(
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
        for _ in 0..2 * PANES {
            let min_m = last.distance_m * (1.0 + 1e-6) + 1e-4 / ray.direction.length();
            let beyond = Ray { min_m, ..*ray };
            let Some(hit) = self.surroundings.rays().cast(&beyond, seen) else { break };
            last = hit;
            let other_face = hit.instance == pane;
            let met = self.surroundings.met(&hit);
            if other_face && met.look.opacity < 1.0 {
                continue;
            }
            pane = hit.instance;
            let patch = self.patch(0, ray, &hit, &mut Some(met));
            let opacity = patch.tint[3];
            add(&mut colour, self.alone(ray, &hit, &patch).map(|value| value * left * opacity));
            left *= 1.0 - opacity;
            if left < 1.0 / 512.0 {
                return colour;
            }
        }
        add(&mut colour, self.background.map(|value| value * left));
        colour
    }

    /// The colour of a single ray's surface under all lights.
    fn alone(&self, ray: &Ray, hit: &Hit, patch: &Patch<'_>) -> [f32; 3] {
        let mut colour = self.unlit(patch);
        if !patch.look.is_lit {
            return colour;
        }
        let point = ray.at(hit.distance_m);
        for shine in &self.shines {
            let Some(beam) = shine.beam(point, patch.normal) else { continue };
            let way = Ray { max_m: beam.distance_m, ..Ray::new(above(hit, point), beam.to_light) };
            let shadow = self.shadows && shine.casts_shadows;
            if shadow && self.surroundings.rays().occluded(&way, SHADOWS) {
                continue;
            }
            add(&mut colour, patch.matt(shine, &beam));
            if patch.look.gleams() {
                add(&mut colour, shine.gleam(&beam, patch.look, patch.normal, ray.direction));
            }
        }
        colour
    }
}

impl Patch<'_> {
    /// Whether `next` is the next pixel of the same face.
    fn goes_on_with(&self, next: &Patch<'_>) -> bool {
        self.pixels.end == next.pixels.start
            && std::ptr::eq(self.look, next.look)
            && self.normal == next.normal
            && self.tint == next.tint
    }

    /// What it scatters of a light.
    fn matt(&self, shine: &Shine, beam: &Beam) -> [f32; 3] {
        let matt = shine.matt(beam, self.look, self.normal);
        std::array::from_fn(|channel| matt[channel] * self.tint[channel])
    }
}

fn add(sum: &mut [f32; 3], colour: [f32; 3]) {
    for (sum, value) in sum.iter_mut().zip(colour) {
        *sum += value;
    }
}

/// Off the surface by more than rounding.
fn above(hit: &Hit, point: DVec3) -> DVec3 {
    let off_m = 1e-4 + 2e-6 * (hit.distance_m + point.abs().max_element());
    point + hit.normal * off_m
}

#[expect(clippy::cast_possible_truncation, reason = "within 0 and 255.5")]
fn byte_of(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
