//! Light sources in the world frame.

use periplus_geometry::{DVec3, Pose};
use periplus_scene::{Colour, Light, LightKind};

use crate::phong::PhongMaterial;

/// A light and the link that carries it.
#[derive(Clone, Debug)]
pub(crate) struct LightSource {
    pub(crate) light: Light,
    /// Link of the light; `None` for lights of the world.
    pub(crate) part: Option<u32>,
}

/// A light in the world's frame.
#[derive(Clone, Debug)]
pub(crate) struct WorldLight {
    /// Position, unused for directional light \[m\].
    pub(crate) position_m: DVec3,
    /// Direction, of length 1.
    pub(crate) direction: DVec3,
    pub(crate) is_directional: bool,
    pub(crate) casts_shadows: bool,
    diffuse: [f32; 3],
    specular: [f32; 3],
    range_m: f64,
    /// Constant, linear, quadratic.
    attenuation: [f64; 3],
    /// Cosines of half the inner and outer angle, falloff.
    spot: Option<[f64; 3]>,
}

/// Light at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample {
    /// Unit vector to the light.
    pub(crate) to_light: DVec3,
    /// Infinite for directional light \[m\].
    pub(crate) distance_m: f64,
    /// Intensity after attenuation, 0 to 1.
    pub(crate) intensity: f64,
}

impl WorldLight {
    /// Returns `None` for a light that is off or has invalid numbers.
    pub(crate) fn of(light: &Light, world_from_light: Pose) -> Option<Self> {
        let sound =
            world_from_light.is_finite() && light.intensity.is_finite() && light.intensity > 0.0;
        if !(light.is_on && sound) {
            return None;
        }
        let towards = if light.direction_in_light == DVec3::ZERO {
            DVec3::NEG_Z
        } else {
            light.direction_in_light
        };
        let colour = |Colour([r, g, b, _]): Colour| {
            #[expect(clippy::cast_possible_truncation, reason = "colours need no more")]
            [r, g, b].map(|x| (x * light.intensity).clamp(0.0, 1e6) as f32)
        };
        let fading = &light.attenuation;
        Some(Self {
            position_m: world_from_light.translation,
            direction: (world_from_light.rotation * towards).try_normalize()?,
            is_directional: light.kind == LightKind::Directional,
            casts_shadows: light.cast_shadows,
            diffuse: colour(light.diffuse),
            specular: colour(light.specular),
            range_m: fading.range_m,
            attenuation: [fading.constant, fading.linear, fading.quadratic],
            spot: match light.kind {
                LightKind::Spot(spot) => Some([
                    libm::cos(spot.inner_angle_rad / 2.0),
                    libm::cos(spot.outer_angle_rad / 2.0),
                    spot.falloff.max(0.0),
                ]),
                _ => None,
            },
        })
    }

    /// Returns the light at a point with this normal, before shadows; `None` if the point is not
    /// lit. A spot fades from its inner to its outer cone as in OGRE: the ratio of the cosines to
    /// the power of the falloff.
    pub(crate) fn beam(&self, point: DVec3, normal: DVec3) -> Option<LightSample> {
        if self.is_directional {
            let to_light = -self.direction;
            return (normal.dot(to_light) > 0.0).then_some(LightSample {
                to_light,
                distance_m: f64::INFINITY,
                intensity: 1.0,
            });
        }
        let way = self.position_m - point;
        let distance_m = way.length();
        let to_light = way / distance_m;
        if !(normal.dot(to_light) > 0.0 && distance_m <= self.range_m) {
            return None;
        }
        let [constant, linear, quadratic] = self.attenuation;
        let fading = constant + distance_m * (linear + distance_m * quadratic);
        let mut intensity = if fading > 0.0 { (1.0 / fading).min(1.0) } else { 1.0 };
        if let Some([inner, outer, falloff]) = self.spot {
            let cosine = -to_light.dot(self.direction);
            if cosine <= outer {
                return None;
            }
            if cosine < inner {
                let part = (cosine - outer) / (inner - outer);
                intensity *= if falloff == 1.0 { part } else { libm::pow(part, falloff) };
            }
        }
        Some(LightSample { to_light, distance_m, intensity })
    }

    /// Returns the diffuse reflection (Lambert).
    #[expect(clippy::cast_possible_truncation, reason = "colours need no more")]
    pub(crate) fn diffuse_light(
        &self,
        beam: &LightSample,
        material: &PhongMaterial,
        normal: DVec3,
    ) -> [f32; 3] {
        let intensity = (beam.intensity * normal.dot(beam.to_light)) as f32;
        std::array::from_fn(|channel| material.diffuse[channel] * self.diffuse[channel] * intensity)
    }

    /// Returns the specular reflection towards `-from_eye` (of any length) by Blinn's model. Only
    /// the cosine of the half vector to the normal is needed, which follows from the two cosines.
    #[expect(clippy::cast_possible_truncation, reason = "colours need no more")]
    pub(crate) fn specular_highlight(
        &self,
        beam: &LightSample,
        material: &PhongMaterial,
        normal: DVec3,
        from_eye: DVec3,
    ) -> [f32; 3] {
        let per_length = 1.0 / (from_eye.length_squared() as f32).sqrt();
        let normal_eye = -(normal.dot(from_eye) as f32) * per_length;
        let light_eye = -(beam.to_light.dot(from_eye) as f32) * per_length;
        let sum = normal.dot(beam.to_light) as f32 + normal_eye;
        let half_squared = 2.0 + 2.0 * light_eye;
        if !(sum > 0.0 && half_squared > 0.0) {
            return [0.0; 3];
        }
        let cosine = (sum / half_squared.sqrt()).min(1.0);
        let intensity = power(cosine, material.shininess) * beam.intensity as f32;
        std::array::from_fn(|channel| {
            material.specular[channel] * self.specular[channel] * intensity
        })
    }
}

/// Returns a base from 0 to 1 to the power of a shininess. Integer exponents, the common case, are
/// computed by squaring, which is several times faster.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 128")]
fn power(base: f32, exponent: f32) -> f32 {
    if exponent != libm::truncf(exponent) || !(0.0..256.0).contains(&exponent) {
        return libm::powf(base, exponent);
    }
    let (mut left, mut square, mut result) = (exponent as u32, base, 1.0);
    while left > 0 {
        if left & 1 == 1 {
            result *= square;
        }
        square *= square;
        left >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use periplus_scene::{Attenuation, Spot};

    use super::*;

    fn lamp(kind: LightKind) -> Light {
        Light {
            name: "lamp".into(),
            parent_from_light: Pose::IDENTITY,
            kind,
            direction_in_light: DVec3::NEG_Z,
            is_on: true,
            visualize: true,
            cast_shadows: true,
            intensity: 1.0,
            diffuse: Colour::WHITE,
            specular: Colour::BLACK,
            attenuation: Attenuation { range_m: 10.0, constant: 1.0, linear: 0.5, quadratic: 0.25 },
            extra: Vec::new(),
            origin: periplus_scene::Origin::default(),
        }
    }

    fn intensity(kind: LightKind, point: [f64; 3]) -> Option<f64> {
        let light = WorldLight::of(&lamp(kind), Pose::from_xyz(0.0, 0.0, 2.0))?;
        light.beam(DVec3::from_array(point), DVec3::Z).map(|beam| beam.intensity)
    }

    #[test]
    fn powers_by_squaring() {
        assert_eq!(power(0.5, 3.0), 0.125);
        assert_eq!(power(0.0, 1.0), 0.0);
        for exponent in [0.0, 1.0, 5.0, 20.0, 127.0, 128.0, 2.5] {
            for base in [0.0, 0.3, 0.99, 1.0] {
                let (ours, libm) = (power(base, exponent), libm::powf(base, exponent));
                assert!((ours - libm).abs() < 1e-5, "{base}^{exponent}: {ours} {libm}");
            }
        }
    }

    #[test]
    fn light_fades_with_distance() {
        // 1 / (1 + 0.5 * 2 + 0.25 * 4)
        assert_eq!(intensity(LightKind::Point, [0.0; 3]), Some(1.0 / 3.0));
        assert_eq!(intensity(LightKind::Point, [0.0, 0.0, -9.0]), None);
        assert_eq!(intensity(LightKind::Point, [0.0, 0.0, 3.0]), None);
        assert_eq!(intensity(LightKind::Directional, [0.0, 0.0, -9.0]), Some(1.0));
    }

    #[test]
    fn a_spot_ends() {
        let spot = Spot {
            inner_angle_rad: 1.0,
            outer_angle_rad: std::f64::consts::FRAC_PI_2,
            falloff: 1.0,
        };
        assert_eq!(intensity(LightKind::Spot(spot), [0.0; 3]), Some(1.0 / 3.0));
        assert_eq!(intensity(LightKind::Spot(spot), [2.1, 0.0, 0.0]), None);
        let rim = intensity(LightKind::Spot(spot), [1.9, 0.0, 0.0]).unwrap();
        assert!(rim > 0.0 && rim < 0.05, "{rim}");
    }
}
