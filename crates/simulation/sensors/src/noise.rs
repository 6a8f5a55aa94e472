//! Sensor noise.

use periplus_geometry::Stream;
use periplus_scene::{NoiseKind, NoiseSpec};

/// Random streams of a sensor, keyed by the run's seed and the sensor's full name, so that adding a
/// sensor does not change the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Streams {
    seed: u64,
    name: String,
}

impl Streams {
    /// Creates the streams of a sensor. The name must be unique in the world: `model::link::sensor`.
    #[must_use]
    pub fn new(seed: u64, name: impl Into<String>) -> Self {
        Self { seed, name: name.into() }
    }

    /// Returns the stream of one measurement, counted from 0.
    #[must_use]
    pub fn tick(&self, number: u64) -> Stream {
        Stream::keyed(self.seed, &self.name, number)
    }

    /// Returns the stream of a quantity that is drawn once, such as a bias.
    #[must_use]
    pub fn once(&self, quantity: &str) -> Stream {
        Stream::keyed(self.seed, &format!("{}/{quantity}", self.name), 0)
    }
}

/// Noise of one quantity, with its bias.
///
/// The model is that of gz-sensors' `GaussianNoiseModel` (and Classic's): a bias is drawn once from
/// a normal distribution, with its sign flipped every other time; it drifts as a Gauss-Markov
/// process; white noise is added; quantized output is rounded last.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseModel {
    spec: NoiseSpec,
    first_bias: f64,
    bias: f64,
}

impl NoiseModel {
    /// Draws the bias. `quantity` distinguishes noises of the same sensor.
    #[must_use]
    pub fn new(spec: &NoiseSpec, streams: &Streams, quantity: &str) -> Self {
        let mut bias = 0.0;
        if spec.kind != NoiseKind::None && (spec.bias_mean != 0.0 || spec.bias_stddev != 0.0) {
            let mut stream = streams.once(quantity);
            bias = spec.bias_mean + spec.bias_stddev * stream.normal();
            if stream.unit() < 0.5 {
                bias = -bias;
            }
        }
        Self { spec: *spec, first_bias: bias, bias }
    }

    /// Returns the specification.
    #[must_use]
    pub fn spec(&self) -> &NoiseSpec {
        &self.spec
    }

    /// Returns true if values are not changed.
    #[must_use]
    pub fn is_none(&self) -> bool {
        let NoiseSpec { kind, mean, stddev, dynamic_bias_stddev, precision, .. } = self.spec;
        kind == NoiseKind::None
            || mean == 0.0
                && stddev == 0.0
                && self.bias == 0.0
                && dynamic_bias_stddev == 0.0
                && (kind == NoiseKind::Gaussian || precision == 0.0)
    }

    /// Advances the bias by a time [s]; zero time has no effect.
    ///
    /// `b ← φ b + N(0, σ_d)` with `φ = exp(-dt/τ)` and `σ_d² = -σ_b² τ/2 expm1(-2 dt/τ)` (Kalibr's
    /// IMU noise model).
    pub fn advance_bias(&mut self, dt_s: f64, stream: &mut Stream) {
        let (sigma, tau_s) =
            (self.spec.dynamic_bias_stddev, self.spec.dynamic_bias_correlation_time_s);
        let drifts = self.spec.kind != NoiseKind::None && sigma > 0.0 && tau_s > 0.0 && dt_s > 0.0;
        if drifts {
            let variance = -sigma * sigma * tau_s / 2.0 * libm::expm1(-2.0 * dt_s / tau_s);
            self.bias = libm::exp(-dt_s / tau_s) * self.bias + variance.sqrt() * stream.normal();
        }
    }

    /// Adds the current bias and white noise to a value.
    pub fn apply_bias_and_noise(&self, value: f64, stream: &mut Stream) -> f64 {
        if self.spec.kind == NoiseKind::None {
            return value;
        }
        let mut white = self.spec.mean;
        if self.spec.stddev != 0.0 {
            white += self.spec.stddev * stream.normal();
        }
        let spoiled = value + self.bias + white;
        if self.spec.kind == NoiseKind::GaussianQuantized && self.spec.precision > 0.0 {
            (spoiled / self.spec.precision).round() * self.spec.precision
        } else {
            spoiled
        }
    }

    /// Adds noise to a value that is measured every `dt_s`: advances the bias, then applies it.
    pub fn apply(&mut self, value: f64, dt_s: f64, stream: &mut Stream) -> f64 {
        self.advance_bias(dt_s, stream);
        self.apply_bias_and_noise(value, stream)
    }

    /// Resets to the initial bias.
    pub fn reset(&mut self) {
        self.bias = self.first_bias;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GAUSSIAN: NoiseSpec = NoiseSpec {
        kind: NoiseKind::Gaussian,
        mean: 0.5,
        stddev: 0.1,
        bias_mean: 0.0,
        bias_stddev: 0.0,
        dynamic_bias_stddev: 0.0,
        dynamic_bias_correlation_time_s: 0.0,
        precision: 0.0,
    };

    /// Mean and standard deviation.
    fn spread(values: &[f64]) -> (f64, f64) {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
        (mean, variance.sqrt())
    }

    fn model(spec: NoiseSpec, sensor: u64) -> NoiseModel {
        NoiseModel::new(&spec, &Streams::new(7, format!("s{sensor}")), "x")
    }

    #[test]
    fn no_noise_changes_nothing() {
        let model = model(NoiseSpec { kind: NoiseKind::None, ..GAUSSIAN }, 0);
        assert!(model.is_none());
        assert_eq!(model.apply_bias_and_noise(1.25, &mut Stream::keyed(0, "", 0)), 1.25);
    }

    #[test]
    fn white_noise_has_its_mean_and_deviation() {
        let (model, streams) = (model(GAUSSIAN, 0), Streams::new(7, "s"));
        let values: Vec<f64> = (0..100_000)
            .map(|tick| model.apply_bias_and_noise(2.0, &mut streams.tick(tick)))
            .collect();
        let (mean, sigma) = spread(&values);
        assert!((mean - 2.5).abs() < 0.002 && (sigma - 0.1).abs() < 0.001, "{mean} {sigma}");
    }

    /// Half of the biases are about 3, half about -3.
    #[test]
    fn a_bias_is_drawn_once_and_flipped_every_other_time() {
        let spec =
            NoiseSpec { mean: 0.0, stddev: 0.0, bias_mean: 3.0, bias_stddev: 0.25, ..GAUSSIAN };
        let mut biases: Vec<f64> = Vec::new();
        for sensor in 0..10_000 {
            let model = model(spec, sensor);
            let measured =
                |tick| model.apply_bias_and_noise(0.0, &mut Stream::keyed(1, "any", tick));
            assert_eq!(measured(0), measured(1));
            biases.push(measured(0));
        }
        let (up, down): (Vec<f64>, Vec<f64>) = biases.into_iter().partition(|bias| *bias > 0.0);
        assert!((4800..5200).contains(&up.len()), "{}", up.len());
        for (side, middle) in [(up, 3.0), (down, -3.0)] {
            let (mean, sigma) = spread(&side);
            assert!((mean - middle).abs() < 0.02 && (sigma - 0.25).abs() < 0.02, "{mean} {sigma}");
        }
    }

    /// In the long run the drifting bias has variance σ² τ/2 and decorrelates within τ.
    #[test]
    fn a_drifting_bias_wanders_as_far_as_it_may() {
        let spec = NoiseSpec {
            mean: 0.0,
            stddev: 0.0,
            dynamic_bias_stddev: 0.2,
            dynamic_bias_correlation_time_s: 2.0,
            ..GAUSSIAN
        };
        let (mut model, mut stream) = (model(spec, 0), Stream::keyed(5, "drift", 0));
        let values: Vec<f64> = (0..200_000).map(|_| model.apply(0.0, 0.5, &mut stream)).collect();
        let (mean, sigma) = spread(&values);
        assert!(mean.abs() < 0.01 && (sigma - 0.2).abs() < 0.005, "{mean} {sigma}");
        let after_tau: f64 =
            values.windows(5).map(|w| w[0] * w[4]).sum::<f64>() / 200_000.0 / (0.2 * 0.2);
        assert!((after_tau - libm::exp(-1.0_f64)).abs() < 0.03, "{after_tau}");
        model.reset();
        assert_eq!(model.apply(1.0, 0.0, &mut stream), 1.0);
    }

    #[test]
    fn quantized_output_lies_on_steps() {
        let spec = NoiseSpec { kind: NoiseKind::GaussianQuantized, precision: 0.25, ..GAUSSIAN };
        let model = model(spec, 0);
        let mut stream = Stream::keyed(1, "q", 0);
        for _ in 0..100 {
            let value = model.apply_bias_and_noise(1.0, &mut stream);
            assert_eq!(value % 0.25, 0.0, "{value}");
        }
    }
}
