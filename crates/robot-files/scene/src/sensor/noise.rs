//! Sensor noise.

use serde::Serialize;

/// Distribution of noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseKind {
    /// No noise.
    #[default]
    None,
    /// Normal distribution with bias.
    Gaussian,
    /// Normal distribution with bias, rounded to the precision.
    GaussianQuantized,
}

/// Noise of one quantity, in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct NoiseSpec {
    /// Distribution.
    pub kind: NoiseKind,
    /// Mean of the noise.
    pub mean: f64,
    /// Standard deviation of the noise.
    pub stddev: f64,
    /// Mean of the bias, which is constant in a run.
    pub bias_mean: f64,
    /// Standard deviation of the bias.
    pub bias_stddev: f64,
    /// Standard deviation of the drifting bias.
    pub dynamic_bias_stddev: f64,
    /// Correlation time of the drifting bias [s].
    pub dynamic_bias_correlation_time_s: f64,
    /// Resolution of quantized output.
    pub precision: f64,
}
