//! Colours.

use periplus_base::DVec3;
use periplus_raycast::{Filter, Hit, Ray};

use super::{SHADOWS, Scratch};
use crate::light::Shine;
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

/// A surface that a ray met.
#[derive(Clone, Copy)]
pub(super) struct Spot<'a> {
    /// Which of the band's rays met it.
    pixel: usize,
    look: &'a Look,
    point: DVec3,
    /// For light; where a mesh is smooth, that of its corners.
    normal: DVec3,
    /// What the texture multiplies with, and opacity.
    tint: [f32; 4],
    matt: [f32; 3],
    highlights: [f32; 3],
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
        scratch.spots.clear();
        // Neighbours mostly meet the same thing.
        let mut last = None;
        for (pixel, (ray, hit)) in scratch.rays.iter().zip(&scratch.hits).enumerate() {
            if let Some(hit) = hit {
                scratch.spots.push(self.spot(pixel, ray, hit, &mut last));
            }
        }
        for shine in &self.shines {
            self.light(shine, scratch, columns);
        }
        let background = self.background.map(byte_of);
        let (mut pixels, mut next) = (rgb.chunks_exact_mut(3), 0);
        for spot in &scratch.spots {
            for pixel in pixels.by_ref().take(spot.pixel - next) {
                pixel.copy_from_slice(&background);
            }
            next = spot.pixel + 1;
            let front = self.colour(spot);
            let colour = if spot.tint[3] < 1.0 {
                let hit = scratch.hits[spot.pixel];
                hit.map_or(front, |hit| {
                    self.through(&scratch.rays[spot.pixel], hit, spot.tint[3], front, seen)
                })
            } else {
                front
            };
            if let Some(pixel) = pixels.next() {
                pixel.copy_from_slice(&colour.map(byte_of));
            }
        }
        for pixel in pixels {
            pixel.copy_from_slice(&background);
        }
    }

    fn spot(&self, pixel: usize, ray: &Ray, hit: &Hit, last: &mut Option<Met<'a>>) -> Spot<'a> {
        let met = match last {
            Some(met) if (met.instance, met.primitive) == (hit.instance, hit.primitive) => *met,
            _ => *last.insert(self.surroundings.met(hit)),
        };
        let point = ray.at(hit.distance_m);
        let (normal, tint) = if met.is_plain {
            (hit.normal, [1.0, 1.0, 1.0, met.look.opacity])
        } else {
            self.surroundings.detail(hit, point)
        };
        Spot { pixel, look: met.look, point, normal, tint, matt: [0.0; 3], highlights: [0.0; 3] }
    }

    /// Adds one light to all spots, where it is not in shadow.
    fn light(&self, shine: &Shine, scratch: &mut Scratch<'a>, columns: usize) {
        let shadows = self.shadows && shine.casts_shadows;
        if shadows {
            self.darken(shine, scratch, columns);
        }
        for spot in &mut scratch.spots {
            if !spot.look.is_lit || shadows && scratch.dark[spot.pixel] {
                continue;
            }
            let Some(beam) = shine.beam(spot.point, spot.normal) else { continue };
            shine.reflect(
                &beam,
                spot.look,
                spot.normal,
                scratch.rays[spot.pixel].direction,
                &mut spot.matt,
                &mut spot.highlights,
            );
        }
    }

    /// Finds which spots of a band a light does not reach, with neighbours traced together: from a
    /// lamp to the surfaces, so that rays share the origin; to the sun they share the direction.
    fn darken(&self, shine: &Shine, scratch: &mut Scratch<'a>, columns: usize) {
        let Scratch { hits, spots, light_rays, light_m, dark, .. } = scratch;
        let rays = self.surroundings.rays();
        // What ends before it begins costs nothing.
        let none = Ray { max_m: -1.0, ..Ray::new(DVec3::ZERO, DVec3::X) };
        light_rays.clear();
        light_rays.resize(hits.len(), none);
        dark.clear();
        dark.resize(hits.len(), false);
        for spot in spots.iter().filter(|spot| spot.look.is_lit) {
            let Some(hit) = hits[spot.pixel] else { continue };
            let above = above(&hit, spot.point);
            let ray = &mut light_rays[spot.pixel];
            if shine.is_directional {
                if shine.beam(spot.point, spot.normal).is_some() {
                    *ray = Ray::new(above, -shine.direction);
                }
            } else {
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

    /// Phong's sum.
    fn colour(&self, spot: &Spot<'_>) -> [f32; 3] {
        let look = spot.look;
        let mut colour = [0.0; 3];
        for (channel, value) in colour.iter_mut().enumerate() {
            let lit = if look.is_lit {
                look.ambient[channel] * self.ambient[channel] + spot.matt[channel]
            } else {
                look.diffuse[channel]
            };
            *value = lit * spot.tint[channel] + look.emissive[channel] + spot.highlights[channel];
        }
        colour
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
            let mut spot = self.spot(0, ray, &hit, &mut Some(met));
            self.light_alone(ray, &hit, &mut spot);
            for (sum, value) in colour.iter_mut().zip(self.colour(&spot)) {
                *sum += value * left * spot.tint[3];
            }
            left *= 1.0 - spot.tint[3];
            if left < 1.0 / 512.0 {
                return colour;
            }
        }
        for (sum, value) in colour.iter_mut().zip(self.background) {
            *sum += value * left;
        }
        colour
    }

    /// All lights on one spot.
    fn light_alone(&self, ray: &Ray, hit: &Hit, spot: &mut Spot<'_>) {
        if !spot.look.is_lit {
            return;
        }
        for shine in &self.shines {
            let Some(beam) = shine.beam(spot.point, spot.normal) else { continue };
            let above = above(hit, spot.point);
            let way = Ray { max_m: beam.distance_m, ..Ray::new(above, beam.to_light) };
            let shadow = self.shadows && shine.casts_shadows;
            if shadow && self.surroundings.rays().occluded(&way, SHADOWS) {
                continue;
            }
            let Spot { look, normal, matt, highlights, .. } = spot;
            shine.reflect(&beam, look, *normal, ray.direction, matt, highlights);
        }
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
