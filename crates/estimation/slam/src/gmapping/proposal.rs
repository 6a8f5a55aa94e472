//! Proposal distribution: pose samples from odometry and the scan on the particle's own map.

use periplus_geometry::{Pose2, Stream, normalize_angle};
use periplus_scan_matching::Symmetric3;

use super::fit::{Fit, Guess};
use super::settings::GmappingSettings;

/// A pose that was drawn, and what it does to the particle's weight.
pub(super) struct Drawn {
    pub(super) map_from_base: Pose2,
    /// Logarithm of how likely the scan is given where the particle was.
    pub(super) likelihood: f64,
}

/// Points around the best fit on either side of each axis, at most.
const MAX_AXIS_POINT_COUNT: f64 = 4.0;

/// Draws from the normal distribution that fits what is likely around the best fit (Grisetti,
/// Stachniss, Burgard 2007, equations (13) to (15): mean and covariance of sampled poses weighted by
/// scan and motion; their sum is the weight, (16) and (17)).
pub(super) fn around(
    fit: &Fit,
    guess: &Guess,
    settings: &GmappingSettings,
    stream: &mut Stream,
) -> Drawn {
    let [shifts, turns] = [0, 1].map(|kind| {
        let (range, step) = (settings.sample_range[kind], settings.sample_step[kind]);
        let steps = (range / step + 1e-9).floor().min(MAX_AXIS_POINT_COUNT);
        let steps = if steps.is_finite() { steps as i32 } else { 0 };
        (-steps..=steps).map(|at| f64::from(at) * step).collect::<Vec<f64>>()
    });
    let best = fit.map_from_base;
    let from_guess = [
        best.x_m - guess.map_from_base.x_m,
        best.y_m - guess.map_from_base.y_m,
        normalize_angle(best.yaw_rad - guess.map_from_base.yaw_rad),
    ];
    let mut samples: Vec<([f64; 3], f64)> =
        Vec::with_capacity(shifts.len() * shifts.len() * turns.len());
    for &turn in &turns {
        for &y in &shifts {
            for &x in &shifts {
                let shift = [x, y, turn];
                let motion = guess.log(std::array::from_fn(|axis| from_guess[axis] + shift[axis]));
                samples.push((shift, fit.likelihood(shift, settings) + motion));
            }
        }
    }
    let most = samples.iter().map(|it| it.1).fold(f64::NEG_INFINITY, f64::max);
    let mut sum = 0.0;
    let mut mean = [0.0; 3];
    for (shift, log) in &mut samples {
        *log = libm::exp(*log - most);
        sum += *log;
        for (mean, shift) in mean.iter_mut().zip(*shift) {
            *mean += *log * shift;
        }
    }
    let mean = mean.map(|it| it / sum);
    let mut covariance = Symmetric3::ZERO;
    for (shift, weight) in &samples {
        let off: [f64; 3] = std::array::from_fn(|axis| shift[axis] - mean[axis]);
        covariance.add_outer(off, weight / sum);
    }
    let noise = match open(fit, guess, settings) {
        Some(covariance) => drift(&covariance, guess, stream),
        None => draw(&covariance, stream),
    };
    Drawn {
        map_from_base: Pose2::new(
            best.x_m + mean[0] + noise[0],
            best.y_m + mean[1] + noise[1],
            normalize_angle(best.yaw_rad + mean[2] + noise[2]),
        ),
        likelihood: most + libm::log(sum / samples.len() as f64),
    }
}

/// Covariance of front end and map together where it exceeds that of the samples around the best match:
/// along a corridor only odometry measures the distance, and particles that all followed it would share its
/// error.
fn open(fit: &Fit, guess: &Guess, settings: &GmappingSettings) -> Option<Symmetric3> {
    let front = guess.front?.turned(guess.began_rad);
    let covariance = (front.inverse()? + fit.information(settings)).inverse()?;
    let sampled_m = settings.sample_range[0].max(LEAST_OPEN_M);
    (covariance.largest_shift() > sampled_m * sampled_m).then_some(covariance)
}

/// Draws an error of which a part is that of the step before: wheels are too small, or a floor is slippery,
/// for a while and not for a step.
fn drift(covariance: &Symmetric3, guess: &Guess, stream: &mut Stream) -> [f64; 3] {
    let along = root(&covariance.turned(-guess.began_rad));
    let fresh = [stream.normal(), stream.normal(), stream.normal()];
    let units: [f64; 3] = std::array::from_fn(|axis| {
        FRESH_ERROR_RATIO * fresh[axis] + LASTING_ERROR_RATIO * guess.lasting[axis]
    });
    let [x, y, turn] = along.map(|row| row.iter().zip(units).map(|(a, b)| a * b).sum());
    let (s, c) = libm::sincos(guess.began_rad);
    [c * x - s * y, s * x + c * y, turn]
}

/// Less than this is never taken for open \[m\].
const LEAST_OPEN_M: f64 = 0.01;
/// Parts of an error that are new and that last; their squares add up to 1.
const FRESH_ERROR_RATIO: f64 = 0.6;
const LASTING_ERROR_RATIO: f64 = 0.8;

/// Samples from the front end or odometry alone, where the scan does not match.
pub(super) fn blind(
    fit: &Fit,
    guess: &Guess,
    settings: &GmappingSettings,
    stream: &mut Stream,
) -> Drawn {
    let pose = guess.map_from_base;
    if let Some(front) = guess.front {
        let [x, y, turn] = drift(&front.turned(guess.began_rad), guess, stream);
        let yaw_rad = normalize_angle(pose.yaw_rad + turn);
        return Drawn {
            map_from_base: Pose2::new(pose.x_m + x, pose.y_m + y, yaw_rad),
            likelihood: fit.likelihood([0.0; 3], settings),
        };
    }
    let mut normal = |sigma: f64| sigma * stream.normal();
    let (x, y) = (normal(guess.sigma_m), normal(guess.sigma_m));
    let yaw = normal(guess.sigma_rad);
    Drawn {
        map_from_base: Pose2::new(pose.x_m + x, pose.y_m + y, normalize_angle(pose.yaw_rad + yaw)),
        likelihood: fit.likelihood([0.0; 3], settings),
    }
}

impl Guess {
    /// Logarithm of how likely a pose is that is off by this, but for a constant.
    fn log(&self, off: [f64; 3]) -> f64 {
        let place = (off[0] * off[0] + off[1] * off[1]) / (self.sigma_m * self.sigma_m);
        let heading = off[2] * off[2] / (self.sigma_rad * self.sigma_rad);
        -0.5 * (place + heading)
    }
}

/// Three numbers of a normal distribution around 0.
fn draw(covariance: &Symmetric3, stream: &mut Stream) -> [f64; 3] {
    let units = [stream.normal(), stream.normal(), stream.normal()];
    root(covariance).map(|row| row.iter().zip(units).map(|(a, b)| a * b).sum())
}

/// The Cholesky factor of a covariance, row by row.
fn root(covariance: &Symmetric3) -> [[f64; 3]; 3] {
    let root = |square: f64| square.max(0.0).sqrt();
    let part = |of: f64, by: f64| if by > 0.0 { of / by } else { 0.0 };
    let xx = root(covariance.xx);
    let yx = part(covariance.xy, xx);
    let tx = part(covariance.xt, xx);
    let yy = root(covariance.yy - yx * yx);
    let ty = part(covariance.yt - tx * yx, yy);
    let tt = root(covariance.tt - tx * tx - ty * ty);
    [[xx, 0.0, 0.0], [yx, yy, 0.0], [tx, ty, tt]]
}

#[cfg(test)]
mod tests {
    use periplus_scan_matching::Point;

    use super::*;
    use crate::gmapping::cells::Cells;
    use crate::gmapping::fit::climb;

    #[test]
    fn draws_have_the_covariance_that_was_asked_for() {
        let asked = Symmetric3 { xx: 4.0, xy: 2.0, yy: 5.0, xt: -2.0, yt: 1.0, tt: 6.0 };
        let mut stream = Stream::keyed(3, "", 0);
        let count = 20_000;
        let draws: Vec<[f64; 3]> = (0..count).map(|_| draw(&asked, &mut stream)).collect();
        let mean = |a: usize, b: usize| {
            draws.iter().map(|it| it[a] * it[b]).sum::<f64>() / f64::from(count)
        };
        let found = [mean(0, 0), mean(0, 1), mean(1, 1), mean(0, 2), mean(1, 2), mean(2, 2)];
        for (found, asked) in found.iter().zip([4.0, 2.0, 5.0, -2.0, 1.0, 6.0]) {
            assert!((found - asked).abs() < 0.2, "{found} {asked}");
        }
    }

    /// A corridor along x, seen from its middle.
    fn corridor() -> (Cells, Vec<Point>) {
        let points: Vec<Point> = (-60..=60_i8)
            .flat_map(|at| {
                let x = 0.1 * f32::from(at);
                [1.22, -1.22_f32].map(|y| Point { x, y, nx: 0.0, ny: -y.signum() })
            })
            .collect();
        (Cells::of_points(&points), points)
    }

    #[test]
    fn along_a_corridor_particles_are_spread_as_widely_as_odometry_errs() {
        let (cells, points) = corridor();
        let settings = GmappingSettings::default();
        let front = Symmetric3::diagonal(0.09 * 0.09, 0.01 * 0.01, 0.003 * 0.003);
        let mut stream = Stream::keyed(1, "corridor", 0);
        let mut squares = [0.0; 3];
        let count = 2000;
        for _ in 0..count {
            let lasting = [stream.normal(), stream.normal(), stream.normal()];
            let guess = Guess {
                map_from_base: Pose2::IDENTITY,
                sigma_m: 0.1,
                sigma_rad: 0.1,
                front: Some(front),
                began_rad: 0.0,
                lasting,
            };
            let fit = climb(&cells, &points, &guess, &settings);
            let pose = around(&fit, &guess, &settings, &mut stream).map_from_base;
            for (sum, off) in squares.iter_mut().zip([pose.x_m, pose.y_m, pose.yaw_rad]) {
                *sum += off * off / f64::from(count);
            }
        }
        let [x, y, turn] = squares.map(f64::sqrt);
        assert!((x - 0.09).abs() < 0.02, "{x}");
        assert!(y < 0.011 && turn < 0.004, "{y} {turn}");
    }

    #[test]
    fn nothing_uncertain_draws_nothing() {
        let nothing = Symmetric3::ZERO;
        assert_eq!(draw(&nothing, &mut Stream::keyed(0, "", 0)), [0.0; 3]);
    }
}
