//! What spoils a measurement.

use serde::Serialize;

/// The distribution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseKind {
    /// No noise.
    #[default]
    None,
    /// Normal noise and bias.
    Gaussian,
    /// The same, rounded to the precision.
    GaussianQuantized,
}

/// Noise of one quantity, in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Noise {
    /// The distribution.
    pub kind: NoiseKind,
    /// Mean of the noise.
    pub mean: f64,
    /// Standard deviation of the noise.
    pub stddev: f64,
    /// Mean of the bias, which is drawn once.
    pub bias_mean: f64,
    /// Standard deviation of the bias.
    pub bias_stddev: f64,
    /// Standard deviation of the bias that drifts.
    pub dynamic_bias_stddev: f64,
    /// Time in which the drifting bias forgets itself [s].
    pub dynamic_bias_correlation_time_s: f64,
    /// Step of quantized output.
    pub precision: f64,
}
