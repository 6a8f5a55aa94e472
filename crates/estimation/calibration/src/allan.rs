//! Noise of an inertial sensor at rest.

use crate::estimated::Estimated;

/// Minimum number of samples.
const MIN_SAMPLE_COUNT: usize = 100;

/// Factor between the minimum of the Allan deviation and the bias instability: the root of 2 ln(2) / pi.
const INSTABILITY_RATIO: f64 = 0.664;

/// Allan deviation at an averaging time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllanPoint {
    /// Averaging time \[s\].
    pub tau_s: f64,
    /// Deviation, in the unit of the samples, with its standard error.
    pub deviation: Estimated,
}

/// Noise of a gyroscope or accelerometer axis, in the unit U of its samples (rad/s or m/s²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuNoise {
    /// Mean of the samples \[U\]. Its standard error is that of white noise: a bias that walks has no
    /// single value, see `random_walk`.
    pub bias: Estimated,
    /// White noise \[U s½\]: the Allan deviation at 1 s on the slope of -1/2. The standard deviation of samples
    /// at a rate is this times the root of the rate.
    pub noise_density: Estimated,
    /// Bias instability \[U\]: minimum of the Allan deviation over 0.664; none if the minimum is at
    /// the longest averaging time, so that the recording is too short for it.
    pub bias_instability: Option<Estimated>,
    /// Random walk of the bias \[U / s½\]: the Allan deviation at 3 s on the slope of +1/2; none without such
    /// a slope.
    pub random_walk: Option<Estimated>,
}

/// Returns the overlapping Allan deviation of samples at a constant period \[s\], at averaging times that
/// double, up to a quarter of the recording.
///
/// IEEE Std 952-1997, annex C; standard errors for white noise, `deviation / sqrt(2 (N / n - 1))` for clusters
/// of n of N samples.
#[must_use]
pub fn allan_deviation(samples: &[f64], period_s: f64) -> Vec<AllanPoint> {
    allan_of_parts(&[samples], period_s)
}

/// Allan deviation over several parts of a recording, up to a quarter of the longest.
fn allan_of_parts(parts: &[&[f64]], period_s: f64) -> Vec<AllanPoint> {
    let total: usize = parts.iter().map(|it| it.len()).sum();
    let longest = parts.iter().map(|it| it.len()).max().unwrap_or(0);
    let mean = parts.iter().copied().flatten().sum::<f64>() / total.max(1) as f64;
    // The integrals, so that each mean is a difference.
    let integral = |samples: &&[f64]| {
        let mut sum = 0.0;
        let steps = samples.iter().map(|sample| {
            sum += (sample - mean) * period_s;
            sum
        });
        std::iter::once(0.0).chain(steps).collect()
    };
    let integrals: Vec<Vec<f64>> = parts.iter().map(integral).collect();
    let mut points = Vec::new();
    let mut size = 1;
    while 4 * size <= longest {
        let tau_s = size as f64 * period_s;
        let (mut squares, mut count, mut clusters) = (0.0, 0, 0.0);
        for integral in integrals.iter().filter(|it| it.len() > 2 * size) {
            let differences = integral.len() - 2 * size;
            squares += (0..differences)
                .map(|at| integral[at + 2 * size] - 2.0 * integral[at + size] + integral[at])
                .map(|it| it * it)
                .sum::<f64>();
            count += differences;
            clusters += (integral.len() - 1) as f64 / size as f64 - 1.0;
        }
        let value = (squares / (2.0 * tau_s * tau_s * count as f64)).sqrt();
        let standard_error = value / (2.0 * clusters).sqrt();
        points.push(AllanPoint { tau_s, deviation: Estimated { value, standard_error } });
        size *= 2;
    }
    points
}

/// Returns the noise of one axis from samples at rest at a constant period \[s\]; none with fewer than 100
/// samples.
#[must_use]
pub fn imu_noise(samples: &[f64], period_s: f64) -> Option<ImuNoise> {
    imu_noise_of_parts(&[samples], period_s)
}

/// Noise of one axis from several parts at rest.
pub(crate) fn imu_noise_of_parts(parts: &[&[f64]], period_s: f64) -> Option<ImuNoise> {
    let count = parts.iter().map(|it| it.len()).sum::<usize>();
    let samples = || parts.iter().copied().flatten();
    if count < MIN_SAMPLE_COUNT || !samples().all(|it| it.is_finite()) {
        return None;
    }
    let points = allan_of_parts(parts, period_s);
    let first = points.first()?;
    let lowest = points
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.deviation.value.total_cmp(&b.1.deviation.value))
        .map(|(index, _)| index)?;
    // The shortest averaging time has the most clusters, and there the white noise is the largest part.
    let scale = first.tau_s.sqrt();
    let noise_density = scaled(first.deviation, scale);
    let is_inside = lowest + 1 < points.len();
    let bias_instability =
        is_inside.then(|| scaled(points[lowest].deviation, 1.0 / INSTABILITY_RATIO));
    let count = count as f64;
    let mean = samples().sum::<f64>() / count;
    let standard_error = noise_density.value / (count * period_s).sqrt();
    Some(ImuNoise {
        bias: Estimated { value: mean, standard_error },
        noise_density,
        bias_instability,
        random_walk: random_walk(points.get(lowest + 1..).unwrap_or_default(), noise_density.value),
    })
}

fn scaled(it: Estimated, factor: f64) -> Estimated {
    Estimated { value: it.value * factor, standard_error: it.standard_error * factor }
}

/// Mean of the random walks of points beyond the minimum, without the white noise:
/// `deviation² = N² / tau + K² tau / 3`, weighted by the standard errors.
fn random_walk(points: &[AllanPoint], noise_density: f64) -> Option<Estimated> {
    let walk = |it: &AllanPoint| {
        let white = noise_density * noise_density / it.tau_s;
        let rest = it.deviation.value * it.deviation.value - white;
        (rest > 0.0).then(|| {
            let value = (3.0 * rest / it.tau_s).sqrt();
            let slope = 3.0 * it.deviation.value / (it.tau_s * value);
            (value, slope * it.deviation.standard_error)
        })
    };
    let walks: Vec<(f64, f64)> = points.iter().filter_map(walk).filter(|it| it.1 > 0.0).collect();
    let weight: f64 = walks.iter().map(|it| libm::pow(it.1, -2.0)).sum();
    if weight <= 0.0 {
        return None;
    }
    let value =
        walks.iter().map(|(value, error)| value * libm::pow(*error, -2.0)).sum::<f64>() / weight;
    // Overlapping averages of neighbouring times are of the same samples: the best one's error counts.
    let standard_error = walks.iter().map(|it| it.1).fold(f64::INFINITY, f64::min);
    Some(Estimated { value, standard_error })
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;

    use super::*;

    #[test]
    fn two_levels_have_half_of_their_difference() {
        // Means of neighbouring pairs are 0 and 0, and single samples alternate by 2.
        let points = allan_deviation(&[1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0], 0.5);
        assert_eq!(points.len(), 2);
        assert_eq!((points[0].tau_s, points[0].deviation.value), (0.5, 2_f64.sqrt()));
        assert_eq!((points[1].tau_s, points[1].deviation.value), (1.0, 0.0));
    }

    #[test]
    fn white_noise_and_random_walk_are_recovered() {
        let mut stream = Stream::keyed(3, "imu", 0);
        // 2000 s at 100 Hz.
        let (period_s, density, walk, bias) = (0.01_f64, 1e-3, 1e-4, 0.02);
        let mut drift = 0.0;
        let samples: Vec<f64> = (0..200_000)
            .map(|_| {
                drift += walk * period_s.sqrt() * stream.normal();
                bias + drift + density / period_s.sqrt() * stream.normal()
            })
            .collect();
        let noise = imu_noise(&samples, period_s).unwrap();
        assert!((noise.noise_density.value / density - 1.0).abs() < 0.01, "{noise:?}");
        assert!((noise.random_walk.unwrap().value / walk - 1.0).abs() < 0.3, "{noise:?}");
        // The bias walks by 1e-4 per root of a second, 4.5e-3 in 2000 s.
        assert!((noise.bias.value - bias).abs() < 4.5e-3, "{noise:?}");
        // The minimum of N²/tau + K² tau/3 is at tau = sqrt(3) N/K.
        let lowest = (2.0 * density * walk / 3_f64.sqrt()).sqrt() / INSTABILITY_RATIO;
        assert!((noise.bias_instability.unwrap().value / lowest - 1.0).abs() < 0.15, "{noise:?}");
    }

    #[test]
    fn white_noise_alone_has_no_random_walk_of_its_size() {
        let mut stream = Stream::keyed(4, "imu", 0);
        let samples: Vec<f64> = (0..20_000).map(|_| 0.1 * stream.normal()).collect();
        let noise = imu_noise(&samples, 0.01).unwrap();
        assert!((noise.noise_density.value - 0.01).abs() < 2e-4, "{noise:?}");
        assert!((noise.bias.standard_error - 0.01 / 200_f64.sqrt()).abs() < 1e-5, "{noise:?}");
        assert!(noise.bias.value.abs() < 3.0 * noise.bias.standard_error, "{noise:?}");
        assert!(noise.random_walk.is_none_or(|it| it.value < 2e-3), "{noise:?}");
        assert_eq!(imu_noise(&samples[..50], 0.01), None);
        assert_eq!(imu_noise(&[f64::NAN; 200], 0.01), None);
    }
}
