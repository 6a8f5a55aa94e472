//! Colours.

use periplus_base::DVec3;
use periplus_raycast::{Filter, Hit, Ray};

use super::{SHADOWS, Scratch, Shot};
use crate::light::Shine;
use crate::look::Look;
use crate::surroundings::Surroundings;

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
pub(super) struct Spot {
    hit: Hit,
    point: DVec3,
    /// For light; where a mesh is smooth, that of its corners.
    normal: DVec3,
    to_eye: DVec3,
    /// Off the surface by more than rounding.
    above: DVec3,
    /// What the texture multiplies with, and opacity.
    tint: [f32; 4],
    matt: [f32; 3],
    highlights: [f32; 3],
}

impl<'a> Shader<'a> {
    pub(super) fn new(surroundings: &'a Surroundings, _: &Shot<'_>) -> Self {
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
        scratch: &mut Scratch,
        columns: usize,
        seen: Filter,
        rgb: &mut [u8],
    ) {
        scratch.spots.clear();
        // Pixels without a hit have no spot; `hits` tells which.
        for (ray, hit) in scratch.rays.iter().zip(&scratch.hits) {
            if let Some(hit) = hit {
                scratch.spots.push(self.spot(ray, hit));
            }
        }
        for shine in &self.shines {
            self.light(shine, scratch, columns);
        }
        let mut spots = scratch.spots.iter();
        for ((ray, hit), pixel) in
            scratch.rays.iter().zip(&scratch.hits).zip(rgb.chunks_exact_mut(3))
        {
            let colour = match hit.as_ref().and_then(|_| spots.next()) {
                None => self.background,
                Some(spot) => {
                    let front = self.colour(spot);
                    if spot.tint[3] < 1.0 { self.through(ray, spot, front, seen) } else { front }
                }
            };
            for (byte, value) in pixel.iter_mut().zip(colour) {
                *byte = byte_of(value);
            }
        }
    }

    fn look(&self, hit: &Hit) -> &'a Look {
        self.surroundings.look_of(hit.instance, hit.primitive)
    }

    fn spot(&self, ray: &Ray, hit: &Hit) -> Spot {
        let point = ray.at(hit.distance_m);
        let to_eye = -ray.direction.normalize_or_zero();
        let (normal, tint) = self.surroundings.detail(hit, point);
        let off_m = 1e-4 + 2e-6 * (hit.distance_m + point.abs().max_element());
        Spot {
            hit: *hit,
            point,
            normal,
            to_eye,
            above: point + hit.normal * off_m,
            tint,
            matt: [0.0; 3],
            highlights: [0.0; 3],
        }
    }

    /// Adds one light to all spots, where it is not in shadow.
    fn light(&self, shine: &Shine, scratch: &mut Scratch, columns: usize) {
        let shadows = self.shadows && shine.casts_shadows;
        if shadows && !shine.is_directional {
            // From the light to the surfaces: rays of one origin, that can be traced together.
            scratch.light_rays.clear();
            let mut spots = scratch.spots.iter();
            let mut direction = DVec3::X;
            for hit in &scratch.hits {
                let mut max_m = 0.0;
                if let Some(spot) = hit.as_ref().and_then(|_| spots.next()) {
                    let way = spot.above - shine.position_m;
                    if way != DVec3::ZERO {
                        (direction, max_m) = (way, 1.0);
                    }
                }
                let ray = Ray { origin_m: shine.position_m, direction, min_m: 0.0, max_m };
                scratch.light_rays.push(ray);
            }
            scratch.light_m.resize(scratch.light_rays.len(), 0.0);
            let rays = self.surroundings.rays();
            rays.cast_grid(&scratch.light_rays, columns, SHADOWS, 1, &mut scratch.light_m);
        }
        let met = scratch.hits.iter().enumerate().filter(|(_, hit)| hit.is_some());
        for ((pixel, _), spot) in met.zip(&mut scratch.spots) {
            let look = self.look(&spot.hit);
            if !look.is_lit {
                continue;
            }
            let Some(beam) = shine.beam(spot.point, spot.normal) else { continue };
            if shadows {
                let dark = if shine.is_directional {
                    self.surroundings.rays().occluded(&Ray::new(spot.above, beam.to_light), SHADOWS)
                } else {
                    scratch.light_m[pixel].is_finite()
                };
                if dark {
                    continue;
                }
            }
            let Spot { normal, to_eye, matt, highlights, .. } = spot;
            shine.reflect(&beam, look, *normal, *to_eye, matt, highlights);
        }
    }

    /// Phong's sum.
    fn colour(&self, spot: &Spot) -> [f32; 3] {
        let look = self.look(&spot.hit);
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
    fn through(&self, ray: &Ray, first: &Spot, front: [f32; 3], seen: Filter) -> [f32; 3] {
        let mut colour = front.map(|value| value * first.tint[3]);
        let mut left = 1.0 - first.tint[3];
        let mut last = first.hit;
        let mut pane = first.hit.instance;
        for _ in 0..2 * PANES {
            let min_m = last.distance_m * (1.0 + 1e-6) + 1e-4 / ray.direction.length();
            let beyond = Ray { min_m, ..*ray };
            let Some(hit) = self.surroundings.rays().cast(&beyond, seen) else { break };
            last = hit;
            let other_face = hit.instance == pane;
            if other_face && self.look(&hit).opacity < 1.0 {
                continue;
            }
            pane = hit.instance;
            let mut spot = self.spot(ray, &hit);
            self.light_alone(&mut spot);
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
    fn light_alone(&self, spot: &mut Spot) {
        let look = self.look(&spot.hit);
        if !look.is_lit {
            return;
        }
        for shine in &self.shines {
            let Some(beam) = shine.beam(spot.point, spot.normal) else { continue };
            let way = Ray { max_m: beam.distance_m, ..Ray::new(spot.above, beam.to_light) };
            let shadow = self.shadows && shine.casts_shadows;
            if shadow && self.surroundings.rays().occluded(&way, SHADOWS) {
                continue;
            }
            let Spot { normal, to_eye, matt, highlights, .. } = spot;
            shine.reflect(&beam, look, *normal, *to_eye, matt, highlights);
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "within 0 and 255.5")]
fn byte_of(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
