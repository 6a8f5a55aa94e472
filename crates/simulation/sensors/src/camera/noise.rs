//! Noise of images.

use periplus_geometry::Stream;
use periplus_scene::{NoiseKind, NoiseSpec};

/// Pixel noise. As in Gazebo only mean and standard deviation apply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageNoise {
    mean: f64,
    stddev: f64,
}

impl ImageNoise {
    /// Returns `None` for a specification without noise.
    #[must_use]
    pub fn new(noise: &NoiseSpec) -> Option<Self> {
        let NoiseSpec { kind, mean, stddev, .. } = *noise;
        (kind != NoiseKind::None && (mean != 0.0 || stddev != 0.0)).then_some(Self { mean, stddev })
    }

    /// Adds noise to every channel of every pixel; the specification is in units of full scale, 0 to
    /// 1.
    pub fn colours(&self, channels: &mut [u8], stream: &mut Stream) {
        for channel in channels {
            let value = f64::from(*channel) + 255.0 * self.draw(stream);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "clamped to 0..255"
            )]
            let spoiled = (value + 0.5).clamp(0.0, 255.0) as u8;
            *channel = spoiled;
        }
    }

    /// Adds noise to depths [m], clamped to their range; infinities are kept.
    pub fn depths(&self, depths_m: &mut [f32], range_m: [f64; 2], stream: &mut Stream) {
        for depth_m in depths_m.iter_mut().filter(|depth_m| depth_m.is_finite()) {
            let spoiled = f64::from(*depth_m) + self.draw(stream);
            #[expect(clippy::cast_possible_truncation, reason = "images have single precision")]
            let spoiled = spoiled.max(range_m[0]).min(range_m[1]) as f32;
            *depth_m = spoiled;
        }
    }

    fn draw(&self, stream: &mut Stream) -> f64 {
        self.mean + self.stddev * stream.normal()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_get_the_noise_that_is_asked_for() {
        let spec = NoiseSpec {
            kind: NoiseKind::Gaussian,
            mean: 0.1,
            stddev: 0.02,
            ..NoiseSpec::default()
        };
        let noise = ImageNoise::new(&spec).unwrap();
        let mut pixels = vec![100_u8; 100_000];
        noise.colours(&mut pixels, &mut Stream::keyed(0, "camera", 0));
        let mean = pixels.iter().map(|&p| f64::from(p)).sum::<f64>() / 1e5;
        let square = pixels.iter().map(|&p| libm::pow(f64::from(p) - mean, 2.0)).sum::<f64>() / 1e5;
        assert!((mean - 125.5).abs() < 0.1 && (square.sqrt() - 5.1).abs() < 0.1, "{mean} {square}");
        let mut white = [255_u8];
        noise.colours(&mut white, &mut Stream::keyed(0, "camera", 0));
        assert_eq!(white, [255]);
        assert_eq!(ImageNoise::new(&NoiseSpec::default()), None);
    }

    #[test]
    fn infinite_depths_stay() {
        let spec =
            NoiseSpec { kind: NoiseKind::Gaussian, mean: 9.0, stddev: 0.0, ..NoiseSpec::default() };
        let mut depths_m = [f32::NEG_INFINITY, 2.0, f32::INFINITY];
        let mut stream = Stream::keyed(0, "", 0);
        ImageNoise::new(&spec).unwrap().depths(&mut depths_m, [0.1, 10.0], &mut stream);
        assert_eq!(depths_m, [f32::NEG_INFINITY, 10.0, f32::INFINITY]);
    }
}
